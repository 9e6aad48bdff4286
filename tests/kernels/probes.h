/* The exports of the probes, by instruction set and dimension. */
#ifndef PBMPM_TESTS_PROBES_H
#define PBMPM_TESTS_PROBES_H

#include "kernel_types.h"
#include "pbmpm/base.h"

/* `count` matrices of nine floats each, row-major with stride 3. */
typedef void RotateAll(const float *f, float *rotation, int32_t count);
/* `s`: three floats per matrix. */
typedef void DecomposeAll(const float *f, float *u, float *s, float *v, int32_t count);
/* The proximal steps of the dual solver. `f`, `d`, `y`, `s`: matrices as above. */
typedef void StressAll(const KernelMaterial *material, const float *f, const float *d, const float *y, float *s, int32_t count);
typedef void PressureAll(const KernelMaterial *material, const float *ratio, const float *second, const float *trace, const float *y, float *s, int32_t count);
/* Elastic energies and stresses at the displacement gradients `d`: matrices as above. */
typedef void EnergyAll(const KernelMaterial *material, const float *f, const float *d, float *stress, float *energy, int32_t count);
/* The energies of what the displacement gradients `d` close, and their stresses: matrices as above. */
typedef void CloseAll(const float *d, float *stress, float *energy, int32_t count);
/* Deformations after the return of a plastic material, and multipliers after the cut: matrices as above. */
typedef void YieldAll(const KernelMaterial *material, const float *before, float *after, int32_t count);
/* Deformations after giving up volume for which there is `room`, one number per matrix. */
typedef void GiveUpAll(const KernelMaterial *material, const float *room, const float *before, float *after, int32_t count);
/* `out`: see LAYOUT_VALUES. */
typedef void WriteLayout(int32_t *out);

typedef struct Probes {
    RotateAll *rotate_all;
    DecomposeAll *decompose_all;
    StressAll *stress_all;
    PressureAll *pressure_all;
    EnergyAll *energy_all;
    CloseAll *close_all;
    YieldAll *yield_all, *cut_all;
    GiveUpAll *give_up_all, *close_voids_all;
} Probes;

const Probes *probes_for(pbmpm_isa isa, int dimension);

typedef struct LayoutProbes {
    WriteLayout *material, *args;
} LayoutProbes;

const LayoutProbes *layout_probes_for(pbmpm_isa isa);

#endif
