/* A signed distance sampled at the nodes of a regular grid: what a baked solid is, and how it is stored. */
#ifndef PBMPM_SRC_SHAPE_DISTANCE_GRID_H
#define PBMPM_SRC_SHAPE_DISTANCE_GRID_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "pbmpm/base.h"

enum { DISTANCE_GRID_BORDER = 2 }; /* cells between the surface and the edge of the grid */

/* Of a volume: its size, its centre, and the integrals of x x, y y, z z, x y, y z, z x about the centre. */
typedef struct Moments {
    double volume, centre[3], square[3], product[3];
} Moments;

/* Lengths in metres, relative to the solid's own frame. The surface lies inside: at the border all values are positive. */
typedef struct DistanceGrid {
    int dimension;
    int32_t count[3]; /* nodes per axis, at least 2; 1 along the third axis in 2D */
    double spacing;
    double low[3];      /* of the first node */
    const float *value; /* x fastest, then y */
    Moments moments;    /* of the solid, once a world has loaded it */
} DistanceGrid;

size_t distance_grid_nodes(const DistanceGrid *grid);
static inline double distance_grid_high(const DistanceGrid *grid, int axis) { return grid->low[axis] + grid->spacing * (grid->count[axis] - 1); }

/* Distance and outward unit normal by multilinear interpolation. Outside the grid: to the surface point that the nearest point of the grid
 * knows of, which is never nearer than the true one. */
double distance_grid_at(const DistanceGrid *grid, const double local[3], double normal[3]);

/* A number that the true distance is not less than. */
double distance_grid_least(const DistanceGrid *grid, const double local[3]);

/* Sums over the nodes; a cell that the surface crosses counts by its share, which its distance tells. */
Moments distance_grid_moments(const DistanceGrid *grid);

/* The share of a cell around a place that lies in a solid whose surface is `distance` cells away, negative inside. */
static inline double share_inside(double distance) { return distance <= -0.5 ? 1.0 : distance >= 0.5 ? 0.0 : 0.5 - distance; }

/* ---- As bytes: a header, then the values ---- */

size_t distance_grid_bytes(const DistanceGrid *grid);

/* Writes distance_grid_bytes() bytes; `data` needs no alignment. */
void distance_grid_write(const DistanceGrid *grid, void *data);

/* Writes the checksum of stored bytes that are final otherwise; `size` is that of a header and whole values. */
void distance_grid_seal(void *data, uint64_t size);

/* Checks everything and describes the grid; `value` stays null, the values begin at *values (unaligned). */
pbmpm_result distance_grid_read(const void *data, uint64_t size, DistanceGrid *grid, const void **values);

#endif
