/* The particles that a surface is made of. */
#ifndef PBMPM_SRC_SKIN_MATTER_H
#define PBMPM_SRC_SKIN_MATTER_H

#include "matter/materials.h"
#include "matter/particles.h"

typedef struct SkinMatter {
    const Particles *particles;
    const Materials *materials;
    uint8_t chosen[PBMPM_MAX_MATERIALS]; /* per slot: 1 if its particles count */
} SkinMatter;

static inline bool matter_has(const void *matter, uint32_t row)
{
    const SkinMatter *of = matter;
    return of->chosen[of->particles->material[row]];
}

/* In cells. What flows keeps no shape: how much space it has the lattice tells, so its rest volume counts. */
static inline float matter_volume(const SkinMatter *matter, uint32_t row)
{
    const uint32_t slot = matter->particles->material[row];
    const float rest = matter->particles->mass[row] * matter->materials->kernel[slot].inverse_density;
    return material_flows(&matter->materials->def[slot]) ? rest : rest * matter->particles->volume_ratio[row];
}

#endif
