#include "world/forces.h"

#include <math.h>
#include <string.h>

#include "base/numbers.h"
#include "base/result.h"

pbmpm_force_def force_defaults(void)
{
    return (pbmpm_force_def){.size = sizeof(pbmpm_force_def),
                             .enabled = 1,
                             .everywhere = 1,
                             .strength = 1.0f,
                             .direction = {0.0f, 1.0f, 0.0f}};
}

const char *force_problem(const pbmpm_force_def *def, const pbmpm_shape *shape, int dimension)
{
    double length = 0.0;
    if (!in_enum(def->kind, PBMPM_FORCE_UNIFORM, PBMPM_FORCE_GRAB)) return "force.kind is unknown";
    if (def->enabled != 0 && def->enabled != 1) return "force.enabled must be 0 or 1";
    if (def->everywhere != 0 && def->everywhere != 1) return "force.everywhere must be 0 or 1";
    if (!in_enum(def->falloff, PBMPM_FALLOFF_NONE, PBMPM_FALLOFF_INVERSE_SQUARE)) return "force.falloff is unknown";
    if (!in_range(def->range, 0.0, 1e9)) return "force.range must be in [0, 1e9]";
    if (def->falloff == PBMPM_FALLOFF_INVERSE_SQUARE && !(def->range > 0.0f)) return "force.range of an inverse square must be greater than 0";
    if (!in_range(def->strength, def->kind == PBMPM_FORCE_DRAG ? 0.0 : -1e9, 1e9))
        return "force.strength must be in [-1e9, 1e9], that of a drag in [0, 1e9]";
    if (!all_in_range(def->velocity, (size_t)dimension, -1e9, 1e9)) return "force.velocity must be in [-1e9, 1e9]";
    if (!in_range(def->spin, -1e6, 1e6)) return "force.spin must be in [-1e6, 1e6]";
    if (!all_finite(def->direction, (size_t)dimension)) return "force.direction must be finite";
    for (int a = 0; a < dimension; a++) length += (double)def->direction[a] * (double)def->direction[a];
    if (!(length > 1e-12)) return "force.direction must be longer than 1e-6";
    return shape_problem(shape, dimension);
}

/* ---- Slots ---- */

void forces_free(Forces *forces, Memory *memory)
{
    memory_give(memory, forces->slot, PBMPM_MAX_FORCES * sizeof(Force));
    array_free(memory, &forces->share);
    array_free(memory, &forces->before);
    *forces = (Forces){0};
}

void force_set(Force *force, const pbmpm_force_def *def, const pbmpm_shape *shape, int dimension)
{
    double length = 0.0;
    force->def = *def;
    force->shape = *shape;
    force->solid = solid_of(shape, dimension);
    memset(force->axis, 0, sizeof force->axis);
    if (dimension == 2 && def->kind != PBMPM_FORCE_UNIFORM) {
        force->axis[2] = 1.0;
        return;
    }
    for (int a = 0; a < dimension; a++) length += (double)def->direction[a] * (double)def->direction[a];
    for (int a = 0; a < dimension; a++) force->axis[a] = (double)def->direction[a] / sqrt(length);
}

pbmpm_result forces_add(Forces *forces, Memory *memory, const pbmpm_force_def *def, const pbmpm_shape *shape, int dimension, uint32_t generation,
                        pbmpm_force_id *id)
{
    if (!forces->slot && !(forces->slot = memory_take(memory, PBMPM_MAX_FORCES * sizeof(Force))))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for forces");
    for (uint32_t slot = 0; slot < PBMPM_MAX_FORCES; slot++) {
        Force *force = &forces->slot[slot];
        if (force->generation != 0) continue;
        *force = (Force){.generation = generation};
        force_set(force, def, shape, dimension);
        if (slot >= forces->used) forces->used = slot + 1;
        *id = (pbmpm_force_id){slot, generation};
        return PBMPM_OK;
    }
    return fail(PBMPM_ERROR_CAPACITY, "a world holds at most %d forces", PBMPM_MAX_FORCES);
}

Force *forces_find(const Forces *forces, pbmpm_force_id id)
{
    if (id.index >= forces->used || id.generation == 0) return NULL;
    Force *force = &forces->slot[id.index];
    return force->generation == id.generation ? force : NULL;
}

double force_reach(const Force *force)
{
    return force->def.everywhere || force->def.falloff == PBMPM_FALLOFF_INVERSE_SQUARE ? INFINITY : (double)force->def.range;
}

void forces_begin_step(Forces *forces)
{
    for (uint32_t slot = 0; slot < forces->used; slot++) {
        memset(forces->slot[slot].impulse, 0, sizeof forces->slot[slot].impulse);
        forces->slot[slot].nodes = 0;
    }
}
