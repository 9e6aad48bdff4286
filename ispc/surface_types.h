/* What C and the kernels of surfaces share; plain C and ISPC both read this file. */
#ifndef PBMPM_SURFACE_TYPES_H
#define PBMPM_SURFACE_TYPES_H

#include "kernel_types.h"

#define K_THICKENINGS 8 /* shares of T that are tried, see src/skin/thin.h */

/* A symmetric filter: the taps that lie as far from its ends, the outer ones first, and where it begins and ends beside the point [points]. */
struct SurfaceFilter {
    int32_t pairs, first, last;
    float tap[4];
};

/* Cells or points of a block, counted from its first; none if low is above high. */
struct SurfaceRange {
    int32_t low[3], high[3];
};

#endif
