/* The ISPC kernels of surfaces, see ispc/surface.ispc. */
#ifndef PBMPM_SRC_SKIN_SKIN_KERNELS_H
#define PBMPM_SRC_SKIN_SKIN_KERNELS_H

#include <stdint.h>

#include "pbmpm/base.h"

/* Adds the amounts of particles at these places, in points from the first of a block, to the 27 points around each in the block's box. */
typedef void SurfaceSplat(const float *x, const float *y, const float *z, const float *amount, int32_t count, float *box);

/* Rows of points, made of those around them in the list: tap p counts the rows at `first` + p and `last` - p. Those from `begin` to `end` are written, `step` numbers
 * from one to the next. */
typedef void SurfaceFilter(const float *const *line, const float *tap, int32_t pairs, int32_t first, int32_t last, int32_t begin, int32_t end, float *out, int32_t step);

/* A row, made of the points around each of it: the middle one of three in `line`. */
typedef void SurfaceFilterRow(const float *line, const float *tap, int32_t pairs, int32_t first, int32_t last, float *out);

typedef struct SkinKernels {
    SurfaceSplat *splat;
    SurfaceFilter *filter;
    SurfaceFilterRow *filter_row;
} SkinKernels;

/* `isa` is supported. */
const SkinKernels *skin_kernels_for(pbmpm_isa isa);

#endif
