#include "grid/kernels.h"

#define EACH_KERNEL(DO, suffix)                                                                                         \
    DO(scatter, suffix)                                                                                                 \
    DO(predict_nodes, suffix)                                                                                           \
    DO(iterate, suffix)                                                                                                 \
    DO(update_nodes, suffix)                                                                                            \
    DO(dual_begin, suffix)                                                                                              \
    DO(dual_iterate, suffix)                                                                                            \
    DO(push_nodes, suffix)                                                                                              \
    DO(cells_begin, suffix)                                                                                             \
    DO(cells_mean, suffix)                                                                                              \
    DO(solids_begin, suffix)                                                                                            \
    DO(solids_mean, suffix)                                                                                             \
    DO(cells_push, suffix)                                                                                              \
    DO(cells_carry, suffix)                                                                                             \
    DO(cells_add, suffix)                                                                                               \
    DO(cells_trace, suffix)                                                                                             \
    DO(second_order, suffix)                                                                                            \
    DO(cells_update, suffix)                                                                                            \
    DO(respond_nodes, suffix)                                                                                           \
    DO(cells_respond, suffix)                                                                                           \
    DO(force_first, suffix)                                                                                             \
    DO(force, suffix)                                                                                                   \
    DO(force_nodes, suffix)                                                                                             \
    DO(hold_pressure, suffix)                                                                                                \
    DO(end_sketch, suffix)                                                                                               \
    DO(viscous, suffix)                                                                                                 \
    DO(viscous_nodes, suffix)                                                                                          \
    DO(fly, suffix)                                                                                                     \
    DO(drift, suffix)                                                                                                   \
    DO(integrate, suffix)

#define DECLARE_ONE(name, suffix) Kernel name##suffix;
#define DECLARE(suffix) EACH_KERNEL(DECLARE_ONE, suffix)
#define ENTRY(name, suffix) .name = name##suffix,
#define TABLE(suffix, gang) {EACH_KERNEL(ENTRY, suffix).lanes = gang}

#if defined(__aarch64__) || defined(__wasm__) /* with a single target ISPC puts nothing behind names */

DECLARE(2)
DECLARE(3)

const Kernels *kernels_for(pbmpm_isa isa, int dimension)
{
    static const Kernels table[] = {TABLE(2, 4), TABLE(3, 4)};
    (void)isa;
    return &table[dimension - 2];
}

#else

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

#endif
