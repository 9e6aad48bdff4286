/* The particles that a surface is made of. */
#ifndef PBMPM_SRC_SKIN_MATTER_H
#define PBMPM_SRC_SKIN_MATTER_H

#include "matter/materials.h"
#include "matter/particles.h"

typedef struct SkinMatter {
    const Particles *particles;
    float cells_per_mass[PBMPM_MAX_MATERIALS]; /* per slot: rest volume per mass; 0: its particles do not count */
    uint8_t stretches[PBMPM_MAX_MATERIALS];    /* 1: its volume is that times the volume ratio */
} SkinMatter;

static inline bool matter_has(const SkinMatter *matter, uint32_t row) { return matter->cells_per_mass[matter->particles->material[row]] != 0.0f; }

/* In cells. What flows keeps no shape: how much space it has the lattice tells, so its rest volume counts. */
static inline float matter_volume(const SkinMatter *matter, uint32_t row)
{
    const uint32_t slot = matter->particles->material[row];
    const float rest = matter->particles->mass[row] * matter->cells_per_mass[slot];
    return matter->stretches[slot] ? rest * matter->particles->volume_ratio[row] : rest;
}

#endif
