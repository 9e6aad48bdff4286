#include "kernels.h"

#define DECLARE(suffix)                                                                                                 \
    Kernel scatter##suffix, predict_nodes##suffix, iterate##suffix, update_nodes##suffix, integrate##suffix;
#define TABLE(suffix, lanes)                                                                                            \
    {scatter##suffix, predict_nodes##suffix, iterate##suffix, update_nodes##suffix, integrate##suffix, lanes}

DECLARE(2_sse4)
DECLARE(3_sse4)
DECLARE(2_avx2)
DECLARE(3_avx2)
DECLARE(2_avx512skx)
DECLARE(3_avx512skx)

const Kernels *kernels_for(pbmpm_isa isa, int dimension)
{
    static const Kernels table[][2] = {
        [PBMPM_ISA_SSE4] = {TABLE(2_sse4, 4), TABLE(3_sse4, 4)},
        [PBMPM_ISA_AVX2] = {TABLE(2_avx2, 8), TABLE(3_avx2, 8)},
        [PBMPM_ISA_AVX512] = {TABLE(2_avx512skx, 8), TABLE(3_avx512skx, 8)},
    };
    return &table[isa][dimension - 2];
}
