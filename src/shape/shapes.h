/* Signed distances of the public shapes. */
#ifndef PBMPM_SRC_SHAPE_SHAPES_H
#define PBMPM_SRC_SHAPE_SHAPES_H

#include <stdbool.h>

#include "pbmpm/shape.h"
#include "shape/baked.h"

/* A shape at rest, ready for distance queries. Lengths in metres, relative to the world's origin. */
typedef struct Solid {
    pbmpm_shape_kind kind;
    int dimension;
    double position[3];
    double rotation[9]; /* row-major; columns are the local axes */
    double half_extents[3];
    double radius;
    double normal[3]; /* plane: outward, in world axes */
    const DistanceGrid *grid; /* baked; else null */
} Solid;

pbmpm_shape shape_defaults(void);

/* Null if valid, else what is wrong. A baked solid is looked for in `table`; without one (null) it is not valid. */
const char *shape_problem(const pbmpm_shape *shape, int dimension);
const char *shape_problem_among(const pbmpm_shape *shape, int dimension, const BakedTable *table);

Solid solid_of(const pbmpm_shape *shape, int dimension);
Solid solid_among(const pbmpm_shape *shape, int dimension, const BakedTable *table);
/* The matrix, row-major, of a quaternion of any length. */
void rotation_from_quaternion(const double q[4], double r[9]);
void normalise_quaternion(float q[4]);

/* A shape on its way to another pose, at the share `t` of the way: positions along a line, quaternions along the shorter arc. */
pbmpm_shape shape_between(const pbmpm_shape *start, const float position[3], const float rotation[4], float t);

/* Distance of a point from the surface, negative inside, and the outward unit normal of the nearest surface point. In
 * 2D the third component is neither read nor written to anything but 0. */
double solid_distance(const Solid *solid, const double point[3], double normal[3]);
/* The distance alone. */
double solid_gap(const Solid *solid, const double point[3]);

/* Of a point in a box: the outward unit normals of the faces that it is within `reach` [m] of, but for the nearest one; how many they are. Each
 * axis has one, on the nearer side. Other shapes have no faces. */
int solid_other_faces(const Solid *solid, const double point[3], double reach, double normals[2][3]);

/* A number that the distance is not less than: for all but baked solids the distance itself. */
double solid_least(const Solid *solid, const double point[3]);

/* [m] where it is thinnest; infinite of a plane, and of what is baked, whose grid nobody searched. */
double solid_breadth(const Solid *solid);

/* Corners of the axis-aligned box around a bounded shape. */
void solid_bounds(const Solid *solid, double low[3], double high[3]);

#endif
