#include "skin/skin_kernels.h"

#define DECLARE(suffix)                      \
    SurfaceSplat surface_splat##suffix;      \
    SurfaceFiltering surface_filter##suffix; \
    SurfaceAdd surface_add##suffix;          \
    SurfaceWeigh surface_weigh##suffix;      \
    SurfaceMeans surface_means##suffix;      \
    SurfaceBound surface_bound##suffix;
#define TABLE(suffix)                                                                                                                           \
    {                                                                                                                                           \
        surface_splat##suffix, surface_filter##suffix, surface_add##suffix, surface_weigh##suffix, surface_means##suffix, surface_bound##suffix \
    }

#if defined(__aarch64__) || defined(__wasm__) /* with a single target ISPC puts nothing behind names */

DECLARE()

const SkinKernels *skin_kernels_for(pbmpm_isa isa)
{
    static const SkinKernels table = TABLE();
    (void)isa;
    return &table;
}

#else

DECLARE(_sse4)
DECLARE(_avx2)
DECLARE(_avx512skx)

const SkinKernels *skin_kernels_for(pbmpm_isa isa)
{
    static const SkinKernels table[] = {
        [PBMPM_ISA_SSE4] = TABLE(_sse4),
        [PBMPM_ISA_AVX2] = TABLE(_avx2),
        [PBMPM_ISA_AVX512] = TABLE(_avx512skx),
    };
    return &table[isa];
}

#endif
