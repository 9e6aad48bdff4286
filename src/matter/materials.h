/* Materials of a world, and their parameters as the kernels want them. */
#ifndef PBMPM_SRC_MATTER_MATERIALS_H
#define PBMPM_SRC_MATTER_MATERIALS_H

#include <math.h>
#include <stdbool.h>

#include "kernel_types.h"
#include "matter/particles.h"
#include "pbmpm/material.h"

typedef struct Materials {
    pbmpm_material_def def[PBMPM_MAX_MATERIALS];
    uint32_t generation[PBMPM_MAX_MATERIALS]; /* 0: free slot */
    KernelMaterial kernel[PBMPM_MAX_MATERIALS];
} Materials;

/* Share by which J follows the volume that the grid holds, per 1/60 s, of materials that say nothing else. */
static const float VOLUME_FEEDBACK = 0.1f;

pbmpm_material_def material_defaults(void);

/* Bit k: materials of kind k are in this build. */
uint32_t materials_built(void);

/* OK, or UNSUPPORTED for a kind that is unknown or that the build leaves out. */
pbmpm_result material_kind_usable(pbmpm_material_kind kind);

/* Null if valid, else what is wrong; whether the kind is usable is not asked. */
const char *material_problem(const pbmpm_material_def *def);

pbmpm_result materials_add(Materials *materials, const pbmpm_material_def *def, uint32_t generation, pbmpm_material_id *id);
void materials_set(Materials *materials, uint32_t slot, const pbmpm_material_def *def);

/* Whether particles of a live material have a deformation gradient: all but liquids. */
static inline bool material_is_solid(const Materials *materials, uint32_t slot) { return materials->kernel[slot].kind != K_LIQUID; }

/* Whether it keeps no shape, so that its volume is told by the grid: see pbmpm_material_def.volume_feedback. */
static inline bool material_flows(const pbmpm_material_def *def) { return def->kind == PBMPM_LIQUID || def->kind == PBMPM_VISCO; }

/* Lame's moduli [Pa]. */
typedef struct Lame {
    double mu, lambda;
} Lame;

static inline Lame lame_of(double young, double poisson)
{
    const double mu = 0.5 * young / (1.0 + poisson);
    return (Lame){mu, 2.0 * mu * poisson / (1.0 - 2.0 * poisson)};
}

/* Of waves of pressure in a solid [m/s]: c^2 = (lambda + 2 mu) / rho. Nothing that happens in it is known farther off sooner. */
static inline double material_wave_speed(const pbmpm_material_def *def)
{
    const Lame lame = lame_of((double)def->young_modulus, (double)def->poisson_ratio);
    return sqrt((lame.lambda + 2.0 * lame.mu) / (double)def->density);
}

/* Whether there is a particle whose material asks for the volume on the grid. */
bool materials_want_volume(const Materials *materials, const Particles *particles);

/* Whether there is visco. */
bool materials_hold_visco(const Materials *materials, const Particles *particles);

/* Density of the lightest liquid with particles; 0 without any. */
double materials_lightest(const Materials *materials, const Particles *particles);

/* Density of the densest liquid with particles over that of the lightest; 1 without any. */
double materials_density_contrast(const Materials *materials, const Particles *particles);

/* Whether there is a liquid without a bulk modulus. */
bool materials_want_modulus(const Materials *materials);

static inline bool material_is_live(const Materials *materials, pbmpm_material_id id)
{
    return id.index < PBMPM_MAX_MATERIALS && id.generation != 0 && materials->generation[id.index] == id.generation;
}

#endif
