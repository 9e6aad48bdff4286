#include "probes.h"

#define DECLARE(isa)                                                                                                          \
    RotateAll rotate_all2##isa, rotate_all3##isa;                                                                           \
    DecomposeAll decompose_all2##isa, decompose_all3##isa;                                                                  \
    StressAll stress_all2##isa, stress_all3##isa;                                                                           \
    PressureAll pressure_all2##isa, pressure_all3##isa;                                                                     \
    EnergyAll energy_all2##isa, energy_all3##isa;                                                                           \
    CloseAll close_all2##isa, close_all3##isa;                                                                              \
    YieldAll yield_all2##isa, yield_all3##isa, cut_all2##isa, cut_all3##isa;                                              \
    GiveUpAll give_up_all2##isa, give_up_all3##isa, close_voids_all2##isa, close_voids_all3##isa;                                                                              \
    WriteLayout layout_of_material3##isa, layout_of_args3##isa;
#define MATRICES(isa)                                                                                                         \
    {{rotate_all2##isa, decompose_all2##isa, stress_all2##isa, pressure_all2##isa, energy_all2##isa, close_all2##isa, yield_all2##isa, cut_all2##isa,                     \
      give_up_all2##isa, close_voids_all2##isa},                                                                                                      \
     {rotate_all3##isa, decompose_all3##isa, stress_all3##isa, pressure_all3##isa, energy_all3##isa, close_all3##isa, yield_all3##isa, cut_all3##isa,                     \
      give_up_all3##isa, close_voids_all3##isa}}
#define LAYOUTS(isa) {layout_of_material3##isa, layout_of_args3##isa}

#if defined(__aarch64__) /* with a single target ISPC puts nothing behind names */

DECLARE()

const Probes *probes_for(pbmpm_isa isa, int dimension)
{
    static const Probes table[] = MATRICES();
    (void)isa;
    return &table[dimension - 2];
}

const LayoutProbes *layout_probes_for(pbmpm_isa isa)
{
    static const LayoutProbes table = LAYOUTS();
    (void)isa;
    return &table;
}

#else

DECLARE(_sse4)
DECLARE(_avx2)
DECLARE(_avx512skx)

const Probes *probes_for(pbmpm_isa isa, int dimension)
{
    static const Probes table[][2] = {
        [PBMPM_ISA_SSE4] = MATRICES(_sse4), [PBMPM_ISA_AVX2] = MATRICES(_avx2), [PBMPM_ISA_AVX512] = MATRICES(_avx512skx)};
    return &table[isa][dimension - 2];
}

const LayoutProbes *layout_probes_for(pbmpm_isa isa)
{
    static const LayoutProbes table[] = {
        [PBMPM_ISA_SSE4] = LAYOUTS(_sse4), [PBMPM_ISA_AVX2] = LAYOUTS(_avx2), [PBMPM_ISA_AVX512] = LAYOUTS(_avx512skx)};
    return &table[isa];
}

#endif
