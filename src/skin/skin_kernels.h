/* The ISPC kernels of surfaces, see ispc/surface.ispc. */
#ifndef PBMPM_SRC_SKIN_SKIN_KERNELS_H
#define PBMPM_SRC_SKIN_SKIN_KERNELS_H

#include "pbmpm/base.h"
#include "surface_types.h"

/* Adds the amounts of particles at these places, in points from the first of a block, to the 27 points around each in the block's box. */
typedef void SurfaceSplat(const float *x, const float *y, const float *z, const float *amount, int32_t count, float *box);

typedef struct SurfaceFilter SurfaceFilter;
typedef struct SurfaceRange SurfaceRange;

/* Writes the points of a block that are `within`, filtered along an axis. `beside`: the block before it, itself and the one behind. */
typedef void SurfaceFiltering(const SurfaceFilter *filter, const SurfaceRange *within, int32_t axis, const float *const beside[3], float *out);

/* Adds what boxes of three blocks side by side along x say of `rows` times `planes` rows of points: each begins at the first row, and may be null. */
typedef void SurfaceAdd(const float *const box[3], int32_t rows, int32_t planes, float *sum);

/* Of the points of a block where T (`more`) is not 0: adds to `enclosed`, for each share k, the room of those with F + k T >= level; and to *held that of F. */
typedef void SurfaceWeigh(const float *own, const float *more, const float *room, float level, float share_step, float *enclosed, float *held);

/* Means over the corners of the cubes above a block's points; `box` has the block and what is around it. */
typedef void SurfaceMeans(const float *box, float *mean);

/* The least and the most of a block's points. */
typedef void SurfaceBound(const float *values, float *least, float *most);

typedef struct SkinKernels {
    SurfaceSplat *splat;
    SurfaceFiltering *filter;
    SurfaceAdd *add;
    SurfaceWeigh *weigh;
    SurfaceMeans *means;
    SurfaceBound *bound;
} SkinKernels;

/* `isa` is supported. */
const SkinKernels *skin_kernels_for(pbmpm_isa isa);

#endif
