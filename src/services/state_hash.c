#include "services/state_hash.h"

static uint64_t mix(uint64_t hash, const void *array, uint32_t count)
{
    const uint32_t *words = array;
    for (uint32_t i = 0; i < count; i++) {
        hash = (hash ^ words[i]) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

/* A world that has room for pressures, but none yet, is as one that has no room. */
static bool any_pressure(const Particles *p)
{
    for (uint32_t i = 0; i < p->count && p->pressure; i++)
        if (p->pressure[i] != 0.0f) return true;
    return false;
}

uint64_t state_hash(const World *world)
{
    const Particles *p = &world->particles;
    uint64_t hash = mix(0x243f6a8885a308d3u, &p->count, 1);
    for (int a = 0; a < p->dimension; a++) {
        hash = mix(hash, p->cell[a], p->count);
        hash = mix(hash, p->fraction[a], p->count);
        hash = mix(hash, p->velocity[a], p->count);
        for (int c = 0; c < p->dimension; c++) {
            hash = mix(hash, p->affine[a * 3 + c], p->count);
            if (p->deformation[0]) hash = mix(hash, p->deformation[a * 3 + c], p->count);
        }
    }
    hash = mix(hash, p->volume_ratio, p->count);
    if (any_pressure(p)) hash = mix(hash, p->pressure, p->count);
    hash = mix(hash, p->material, p->count);
    return mix(hash, p->mass, p->count);
}
