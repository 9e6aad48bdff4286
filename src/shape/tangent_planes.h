/* What a node may not cross near a solid that need not be convex: a few planes instead of one. */
#ifndef PBMPM_SRC_SHAPE_TANGENT_PLANES_H
#define PBMPM_SRC_SHAPE_TANGENT_PLANES_H

#include "shape/shapes.h"

enum { PLANES_MAX = 4 };

/* Lengths in cells. A displacement u of the node keeps off if normal . u >= -gap. */
typedef struct Plane {
    double normal[3];
    double gap; /* 0 inside */
} Plane;

/* The planes for a node at `point` [m] that wants to go `way` [cells] and may go `margin` cells aside; returns their number, 0 if it
 * does not come within the margin. `nearest`: the solid's normal and, as the gap, its distance at the point [cells]. */
int tangent_planes(const Solid *solid, double cell_size, const double point[3], const Plane *nearest, const double way[3], double margin,
                   Plane planes[PLANES_MAX]);

#endif
