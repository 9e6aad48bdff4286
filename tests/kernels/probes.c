#include "probes.h"

#define DECLARE(isa)                                                                                                          \
    RotateAll rotate_all2_##isa, rotate_all3_##isa;                                                                           \
    DecomposeAll decompose_all2_##isa, decompose_all3_##isa;                                                                  \
    StressAll stress_all2_##isa, stress_all3_##isa;                                                                           \
    PressureAll pressure_all2_##isa, pressure_all3_##isa;                                                                     \
    EnergyAll energy_all2_##isa, energy_all3_##isa;                                                                           \
    CloseAll close_all2_##isa, close_all3_##isa;                                                                              \
    YieldAll yield_all2_##isa, yield_all3_##isa, cut_all2_##isa, cut_all3_##isa;                                              \
    GiveUpAll give_up_all2_##isa, give_up_all3_##isa;                                                                         \
    WriteLayout layout_of_material3_##isa, layout_of_args3_##isa;
#define MATRICES(isa)                                                                                                         \
    {{rotate_all2_##isa, decompose_all2_##isa, stress_all2_##isa, pressure_all2_##isa, energy_all2_##isa, close_all2_##isa, yield_all2_##isa, cut_all2_##isa,                     \
      give_up_all2_##isa},                                                                                                    \
     {rotate_all3_##isa, decompose_all3_##isa, stress_all3_##isa, pressure_all3_##isa, energy_all3_##isa, close_all3_##isa, yield_all3_##isa, cut_all3_##isa,                     \
      give_up_all3_##isa}}
#define LAYOUTS(isa) {layout_of_material3_##isa, layout_of_args3_##isa}

DECLARE(sse4)
DECLARE(avx2)
DECLARE(avx512skx)

const Probes *probes_for(pbmpm_isa isa, int dimension)
{
    static const Probes table[][2] = {
        [PBMPM_ISA_SSE4] = MATRICES(sse4), [PBMPM_ISA_AVX2] = MATRICES(avx2), [PBMPM_ISA_AVX512] = MATRICES(avx512skx)};
    return &table[isa][dimension - 2];
}

const LayoutProbes *layout_probes_for(pbmpm_isa isa)
{
    static const LayoutProbes table[] = {
        [PBMPM_ISA_SSE4] = LAYOUTS(sse4), [PBMPM_ISA_AVX2] = LAYOUTS(avx2), [PBMPM_ISA_AVX512] = LAYOUTS(avx512skx)};
    return &table[isa];
}
