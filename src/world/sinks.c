#include "world/sinks.h"

#include "base/numbers.h"
#include "base/result.h"

pbmpm_drain_def drain_defaults(void)
{
    return (pbmpm_drain_def){.size = sizeof(pbmpm_drain_def), .enabled = 1};
}

pbmpm_kill_bounds kill_bounds_defaults(void)
{
    return (pbmpm_kill_bounds){.size = sizeof(pbmpm_kill_bounds), .high = {1.0f, 1.0f, 1.0f}};
}

const char *drain_problem(const pbmpm_drain_def *def, const pbmpm_shape *shape, int dimension)
{
    if (def->enabled != 0 && def->enabled != 1) return "drain.enabled must be 0 or 1";
    return shape_problem(shape, dimension);
}

const char *kill_bounds_problem(const pbmpm_kill_bounds *bounds, int dimension)
{
    if (bounds->enabled != 0 && bounds->enabled != 1) return "bounds.enabled must be 0 or 1";
    for (int a = 0; a < dimension; a++) {
        if (!in_range(bounds->low[a], -1e9, 1e9) || !in_range(bounds->high[a], -1e9, 1e9))
            return "bounds.low and bounds.high must be in [-1e9, 1e9]";
        if (!(bounds->high[a] > bounds->low[a])) return "bounds.high must be above bounds.low on every axis";
    }
    return NULL;
}

void sinks_free(Sinks *sinks, Memory *memory)
{
    memory_give(memory, sinks->slot, PBMPM_MAX_DRAINS * sizeof(Drain));
    *sinks = (Sinks){0};
}

void drain_set(Drain *drain, const pbmpm_drain_def *def, const pbmpm_shape *shape, int dimension)
{
    drain->def = *def;
    drain->shape = *shape;
    drain->solid = solid_of(shape, dimension);
}

pbmpm_result sinks_add(Sinks *sinks, Memory *memory, const pbmpm_drain_def *def, const pbmpm_shape *shape, int dimension, uint32_t generation,
                       pbmpm_drain_id *id)
{
    if (!sinks->slot && !(sinks->slot = memory_take(memory, PBMPM_MAX_DRAINS * sizeof(Drain))))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for drains");
    for (uint32_t slot = 0; slot < PBMPM_MAX_DRAINS; slot++) {
        Drain *drain = &sinks->slot[slot];
        if (drain->generation != 0) continue;
        *drain = (Drain){.generation = generation};
        drain_set(drain, def, shape, dimension);
        if (slot >= sinks->used) sinks->used = slot + 1;
        *id = (pbmpm_drain_id){slot, generation};
        return PBMPM_OK;
    }
    return fail(PBMPM_ERROR_CAPACITY, "a world holds at most %d drains", PBMPM_MAX_DRAINS);
}

Drain *sinks_find(const Sinks *sinks, pbmpm_drain_id id)
{
    if (id.index >= sinks->used || id.generation == 0) return NULL;
    Drain *drain = &sinks->slot[id.index];
    return drain->generation == id.generation ? drain : NULL;
}
