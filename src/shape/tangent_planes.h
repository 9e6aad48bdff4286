/* What a node may not cross near a solid that need not be convex: a few planes instead of one. */
#ifndef PBMPM_SRC_SHAPE_TANGENT_PLANES_H
#define PBMPM_SRC_SHAPE_TANGENT_PLANES_H

#include <stdbool.h>

#include "shape/shapes.h"

enum { PLANES_MAX = 4 };

/* Lengths in cells. A displacement u of the node keeps off if normal . u >= -gap. */
typedef struct Plane {
    double normal[3];
    double gap; /* 0 inside */
} Plane;

/* The planes around a point [m] that may go `margin` cells aside; returns their number, 0 if it does not come within the margin. `nearest`: the
 * solid's normal and, as the gap, its distance at the point [cells]. */
int tangent_planes(const Solid *solid, double cell_size, const double point[3], const Plane *nearest, double margin, Plane planes[PLANES_MAX]);

/* Where a point [m] wants to go [cells], and the planes that are known to be in its way. */
typedef struct Way {
    const double *point, *way;
    const Plane *known;
    int count;
} Way;

/* Follows a way to where it comes closest to a surface that no known plane stands for, or enters the solid. False: it stays farther off than the margin, or leaves.
 * The point is outside. */
bool plane_on_way(const Solid *solid, double cell_size, const Way *way, double margin, Plane *plane);

#endif
