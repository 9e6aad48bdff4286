#include "world/emitters.h"

#include <math.h>
#include <string.h>

#include "base/numbers.h"
#include "base/result.h"
#include "shape/shapes.h"

/* How far from the origin an emitter may stand [cells]: its particles appear up to PBMPM_MAX_CELLS_PER_SUBSTEP further. */
static const double DISTANCE_MAX = 2097152.0;

pbmpm_emitter_def emitter_defaults(void)
{
    return (pbmpm_emitter_def){.size = sizeof(pbmpm_emitter_def),
                               .seed = 1,
                               .enabled = 1,
                               .direction = {0.0f, -1.0f, 0.0f},
                               .particles_per_axis = 2.0f,
                               .fill_limit = 1.0f};
}

/* ---- Checking ---- */

pbmpm_shape emitter_enclosing_shape(const pbmpm_emitter_def *def, const pbmpm_shape *shape)
{
    pbmpm_shape enclosing = *shape;
    if (def->region == PBMPM_EMIT_DISC) enclosing.kind = PBMPM_SPHERE;
    return enclosing;
}

static const char *shape_trouble(const pbmpm_emitter_def *def, const pbmpm_shape *given, int dimension, double cell_size)
{
    const pbmpm_shape shape = emitter_enclosing_shape(def, given);
    const char *problem = shape_problem(&shape, dimension);
    if (problem) return problem;
    if (shape.kind == PBMPM_PLANE) return "emitter.shape: a plane has no end";
    const Solid solid = solid_of(&shape, dimension);
    double low[3], high[3], cells = 1.0;
    solid_bounds(&solid, low, high);
    for (int a = 0; a < dimension; a++) {
        if (low[a] < -DISTANCE_MAX * cell_size || high[a] > DISTANCE_MAX * cell_size)
            return "emitter.shape must be within 2^21 cells of the origin";
        cells *= fmax(1.0, (high[a] - low[a]) / cell_size);
    }
    return cells <= EMITTER_CELLS_MAX ? NULL : "emitter.shape is too large: its bounds hold more than 2^22 cells";
}

const char *emitter_problem(const pbmpm_emitter_def *def, const pbmpm_shape *shape, int dimension, double cell_size)
{
    double length = 0.0;
    if (!in_enum(def->region, PBMPM_EMIT_VOLUME, PBMPM_EMIT_DISC)) return "emitter.region is unknown";
    if (def->enabled != 0 && def->enabled != 1) return "emitter.enabled must be 0 or 1";
    if (def->reserved != 0) return "emitter.reserved must be 0";
    if (!in_range(def->rate, 0.0, 1e12)) return "emitter.rate must be in [0, 1e12]";
    if (!in_range(def->speed, 0.0, 1e6)) return "emitter.speed must be in [0, 1e6]";
    if (!in_range(def->spread, 0.0, M_PI)) return "emitter.spread must be in [0, pi]";
    if (!in_range(def->particles_per_axis, 0.25, 16.0)) return "emitter.particles_per_axis must be in [0.25, 16]";
    if (!in_range(def->fill_limit, 0.1, 100.0)) return "emitter.fill_limit must be in [0.1, 100]";
    if (!all_finite(def->direction, (size_t)dimension)) return "emitter.direction must be finite";
    for (int a = 0; a < dimension; a++) length += (double)def->direction[a] * (double)def->direction[a];
    if (!(length > 1e-12)) return "emitter.direction must be longer than 1e-6";
    return shape_trouble(def, shape, dimension, cell_size);
}

/* ---- Slots ---- */

void emitters_free(Emitters *emitters, Memory *memory)
{
    memory_give(memory, emitters->slot, PBMPM_MAX_EMITTERS * sizeof(Emitter));
    array_free(memory, &emitters->occupancy);
    *emitters = (Emitters){0};
}

void emitter_set(Emitter *emitter, const pbmpm_emitter_def *def, const pbmpm_shape *shape)
{
    emitter->def = *def;
    emitter->shape = *shape;
    emitter->moving = false;
}

pbmpm_result emitters_add(Emitters *emitters, Memory *memory, const pbmpm_emitter_def *def, const pbmpm_shape *shape, uint32_t generation,
                           pbmpm_emitter_id *id)
{
    if (!emitters->slot && !(emitters->slot = memory_take(memory, PBMPM_MAX_EMITTERS * sizeof(Emitter))))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for emitters");
    for (uint32_t slot = 0; slot < PBMPM_MAX_EMITTERS; slot++) {
        Emitter *emitter = &emitters->slot[slot];
        if (emitter->generation != 0) continue;
        *emitter = (Emitter){.generation = generation, .state = {.due = 0.5}};
        emitter_set(emitter, def, shape);
        if (slot >= emitters->used) emitters->used = slot + 1;
        *id = (pbmpm_emitter_id){slot, generation};
        return PBMPM_OK;
    }
    return fail(PBMPM_ERROR_CAPACITY, "a world holds at most %d emitters", PBMPM_MAX_EMITTERS);
}

Emitter *emitters_find(const Emitters *emitters, pbmpm_emitter_id id)
{
    if (id.index >= emitters->used || id.generation == 0) return NULL;
    Emitter *emitter = &emitters->slot[id.index];
    return emitter->generation == id.generation ? emitter : NULL;
}

void emitter_move(Emitter *emitter, const float position[3], const float *rotation)
{
    memcpy(emitter->target_position, position, sizeof emitter->target_position);
    memcpy(emitter->target_rotation, rotation ? rotation : emitter->shape.rotation, sizeof emitter->target_rotation);
    emitter->moving = true;
}

void emitter_arrive(Emitter *emitter)
{
    memcpy(emitter->shape.position, emitter->target_position, sizeof emitter->target_position);
    memcpy(emitter->shape.rotation, emitter->target_rotation, sizeof emitter->target_rotation);
    emitter->moving = false;
}

void emitters_end_step(Emitters *emitters)
{
    for (uint32_t slot = 0; slot < emitters->used; slot++)
        if (emitters->slot[slot].moving) emitter_arrive(&emitters->slot[slot]);
}

bool emitters_use(const Emitters *emitters, pbmpm_material_id material)
{
    for (uint32_t slot = 0; slot < emitters->used; slot++) {
        const Emitter *emitter = &emitters->slot[slot];
        if (emitter->generation != 0 && emitter->def.material.index == material.index) return true;
    }
    return false;
}

void emitter_report(const Emitter *emitter, pbmpm_emitter_status *status)
{
    const EmitterState *state = &emitter->state;
    *status = (pbmpm_emitter_status){.size = sizeof *status,
                                     .emitted = state->emitted,
                                     .refused_full = state->refused_full,
                                     .refused_budget = state->refused_budget,
                                     .refused_capacity = state->refused_capacity,
                                     .emitted_mass = state->emitted_mass};
}
