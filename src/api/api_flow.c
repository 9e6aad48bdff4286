/* The exported functions of emitter.h, drain.h and force.h. */
#include <math.h>
#include <string.h>

#include "api/api_call.h"
#include "base/generations.h"
#include "world/emitters.h"
#include "world/forces.h"
#include "world/keyed.h"
#include "world/sinks.h"
#include "world/sleep_wake.h"
#include "world/stirred.h"

/* ---- emitter.h ---- */

pbmpm_result pbmpm_emitter_def_init(pbmpm_emitter_def *def, size_t size)
{
    INIT(pbmpm_emitter_def, def, size, emitter_defaults());
}

/* `slot`: -1 for a new one. */
static pbmpm_result check_emitter(const World *w, const pbmpm_emitter_def *def, const pbmpm_shape *shape, int32_t slot)
{
    const char *problem = emitter_problem(def, shape, w->def.dimension, (double)w->def.cell_size);
    if (!problem) problem = keyed_problem(w, KEYED_EMITTERS, def->key, slot);
    if (problem) return api_invalid(problem);
    if (material_is_live(&w->materials, def->material)) return PBMPM_OK;
    return api_gone(w, "emitter.material", def->material.generation);
}

pbmpm_result pbmpm_emitter_create(pbmpm_world_id world, const pbmpm_emitter_def *def, const pbmpm_shape *shape, pbmpm_emitter_id *emitter)
{
    REQUIRE(emitter);
    *emitter = (pbmpm_emitter_id){0, 0};
    READ(pbmpm_emitter_def, own, def, emitter_defaults());
    READ(pbmpm_shape, form, shape, shape_defaults());
    HOLD(world);
    const pbmpm_result checked = check_emitter(w, &own, &form, -1);
    if (checked != PBMPM_OK) LET_GO(checked);
    LET_GO(emitters_add(&w->emitters, &w->memory, &own, &form, generation_next(), emitter));
}

pbmpm_result pbmpm_emitter_destroy(pbmpm_world_id world, pbmpm_emitter_id emitter)
{
    HOLD(world);
    Emitter *found = emitters_find(&w->emitters, emitter);
    if (!found) LET_GO(api_gone(w, "this emitter", emitter.generation));
    found->generation = 0;
    ended_add(&w->ended, emitter.generation);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_emitter_get(pbmpm_world_id world, pbmpm_emitter_id emitter, pbmpm_emitter_def *def, pbmpm_shape *shape)
{
    if (def) REQUIRE_SIZE(pbmpm_emitter_def, def);
    if (shape) REQUIRE_SIZE(pbmpm_shape, shape);
    HOLD_READING(world);
    const Emitter *found = emitters_find(&w->emitters, emitter);
    if (!found) LET_GO(api_gone(w, "this emitter", emitter.generation));
    if (def) WRITE(pbmpm_emitter_def, def, &found->def);
    if (shape) WRITE(pbmpm_shape, shape, &found->shape);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_emitter_set(pbmpm_world_id world, pbmpm_emitter_id emitter, const pbmpm_emitter_def *def, const pbmpm_shape *shape)
{
    HOLD(world);
    Emitter *found = emitters_find(&w->emitters, emitter);
    if (!found) LET_GO(api_gone(w, "this emitter", emitter.generation));
    READ_OR_KEEP(pbmpm_emitter_def, own, def, found->def);
    READ_OR_KEEP(pbmpm_shape, form, shape, found->shape);
    const pbmpm_result checked = check_emitter(w, &own, &form, (int32_t)emitter.index);
    if (checked == PBMPM_OK) emitter_set(found, &own, &form);
    LET_GO(checked);
}

pbmpm_result pbmpm_emitter_move(pbmpm_world_id world, pbmpm_emitter_id emitter, const float position[3], const float rotation[4])
{
    REQUIRE(position);
    HOLD(world);
    Emitter *found = emitters_find(&w->emitters, emitter);
    if (!found) LET_GO(api_gone(w, "this emitter", emitter.generation));
    pbmpm_shape moved = found->shape;
    memcpy(moved.position, position, sizeof moved.position);
    if (rotation) memcpy(moved.rotation, rotation, sizeof moved.rotation);
    const pbmpm_result checked = check_emitter(w, &found->def, &moved, (int32_t)emitter.index);
    if (checked == PBMPM_OK) emitter_move(found, position, rotation);
    LET_GO(checked);
}

pbmpm_result pbmpm_emitter_status_get(pbmpm_world_id world, pbmpm_emitter_id emitter, pbmpm_emitter_status *status)
{
    REQUIRE_SIZE(pbmpm_emitter_status, status);
    HOLD_READING(world);
    const Emitter *found = emitters_find(&w->emitters, emitter);
    if (!found) LET_GO(api_gone(w, "this emitter", emitter.generation));
    pbmpm_emitter_status own;
    emitter_report(found, &own);
    WRITE(pbmpm_emitter_status, status, &own);
    LET_GO(PBMPM_OK);
}

/* ---- drain.h ---- */

pbmpm_result pbmpm_drain_def_init(pbmpm_drain_def *def, size_t size)
{
    INIT(pbmpm_drain_def, def, size, drain_defaults());
}

static pbmpm_result check_drain(const World *w, const pbmpm_drain_def *def, const pbmpm_shape *shape, int32_t slot)
{
    const char *problem = drain_problem(def, shape, w->def.dimension);
    if (!problem) problem = keyed_problem(w, KEYED_DRAINS, def->key, slot);
    const bool everything = def->material.index == 0 && def->material.generation == 0;
    if (problem) return api_invalid(problem);
    if (everything || material_is_live(&w->materials, def->material)) return PBMPM_OK;
    return api_gone(w, "drain.material", def->material.generation);
}

static void wake_near_drain(World *w, const Drain *drain)
{
    sleep_wake_near(w, &drain->solid, SLEEP_FELT);
    stirred_add(w, &drain->solid, SLEEP_FELT);
}

pbmpm_result pbmpm_drain_create(pbmpm_world_id world, const pbmpm_drain_def *def, const pbmpm_shape *shape, pbmpm_drain_id *drain)
{
    REQUIRE(drain);
    *drain = (pbmpm_drain_id){0, 0};
    READ(pbmpm_drain_def, own, def, drain_defaults());
    READ(pbmpm_shape, form, shape, shape_defaults());
    HOLD(world);
    const pbmpm_result checked = check_drain(w, &own, &form, -1);
    if (checked != PBMPM_OK) LET_GO(checked);
    const pbmpm_result result = sinks_add(&w->sinks, &w->memory, &own, &form, w->def.dimension, generation_next(), drain);
    if (result == PBMPM_OK) wake_near_drain(w, sinks_find(&w->sinks, *drain));
    LET_GO(result);
}

pbmpm_result pbmpm_drain_destroy(pbmpm_world_id world, pbmpm_drain_id drain)
{
    HOLD(world);
    Drain *found = sinks_find(&w->sinks, drain);
    if (!found) LET_GO(api_gone(w, "this drain", drain.generation));
    found->generation = 0;
    ended_add(&w->ended, drain.generation);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_drain_get(pbmpm_world_id world, pbmpm_drain_id drain, pbmpm_drain_def *def, pbmpm_shape *shape)
{
    if (def) REQUIRE_SIZE(pbmpm_drain_def, def);
    if (shape) REQUIRE_SIZE(pbmpm_shape, shape);
    HOLD_READING(world);
    const Drain *found = sinks_find(&w->sinks, drain);
    if (!found) LET_GO(api_gone(w, "this drain", drain.generation));
    if (def) WRITE(pbmpm_drain_def, def, &found->def);
    if (shape) WRITE(pbmpm_shape, shape, &found->shape);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_drain_set(pbmpm_world_id world, pbmpm_drain_id drain, const pbmpm_drain_def *def, const pbmpm_shape *shape)
{
    HOLD(world);
    Drain *found = sinks_find(&w->sinks, drain);
    if (!found) LET_GO(api_gone(w, "this drain", drain.generation));
    READ_OR_KEEP(pbmpm_drain_def, own, def, found->def);
    READ_OR_KEEP(pbmpm_shape, form, shape, found->shape);
    const pbmpm_result checked = check_drain(w, &own, &form, (int32_t)drain.index);
    if (checked == PBMPM_OK) {
        drain_set(found, &own, &form, w->def.dimension);
        wake_near_drain(w, found);
    }
    LET_GO(checked);
}

pbmpm_result pbmpm_drain_status_get(pbmpm_world_id world, pbmpm_drain_id drain, pbmpm_drain_status *status)
{
    REQUIRE_SIZE(pbmpm_drain_status, status);
    HOLD_READING(world);
    const Drain *found = sinks_find(&w->sinks, drain);
    if (!found) LET_GO(api_gone(w, "this drain", drain.generation));
    const pbmpm_drain_status own = {.size = sizeof own, .drained = found->drained, .drained_mass = found->drained_mass};
    WRITE(pbmpm_drain_status, status, &own);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_kill_bounds_init(pbmpm_kill_bounds *bounds, size_t size)
{
    INIT(pbmpm_kill_bounds, bounds, size, kill_bounds_defaults());
}

pbmpm_result pbmpm_world_set_kill_bounds(pbmpm_world_id world, const pbmpm_kill_bounds *bounds)
{
    HOLD(world);
    READ_HELD(pbmpm_kill_bounds, own, bounds, w->sinks.bounds);
    const char *problem = kill_bounds_problem(&own, w->def.dimension);
    if (problem) LET_GO(api_invalid(problem));
    w->sinks.bounds = own;
    sleep_wake_all(w);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_world_get_kill_bounds(pbmpm_world_id world, pbmpm_kill_bounds *bounds)
{
    REQUIRE_SIZE(pbmpm_kill_bounds, bounds);
    HOLD_READING(world);
    WRITE(pbmpm_kill_bounds, bounds, &w->sinks.bounds);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_world_get_flow(pbmpm_world_id world, pbmpm_flow *flow)
{
    REQUIRE_SIZE(pbmpm_flow, flow);
    HOLD_READING(world);
    WRITE(pbmpm_flow, flow, &w->flow);
    LET_GO(PBMPM_OK);
}

/* ---- force.h ---- */

pbmpm_result pbmpm_force_def_init(pbmpm_force_def *def, size_t size)
{
    INIT(pbmpm_force_def, def, size, force_defaults());
}

/* What a force acts on; it may act everywhere. */
static void wake_in_reach(World *w, const Force *force)
{
    const double reach = force_reach(force);
    if (!force->def.enabled) return;
    if (reach == INFINITY)
        sleep_wake_all(w);
    else
        sleep_wake_near(w, &force->solid, reach / (double)w->def.cell_size + SLEEP_FELT);
}

pbmpm_result pbmpm_force_create(pbmpm_world_id world, const pbmpm_force_def *def, const pbmpm_shape *shape, pbmpm_force_id *force)
{
    REQUIRE(force);
    *force = (pbmpm_force_id){0, 0};
    READ(pbmpm_force_def, own, def, force_defaults());
    READ(pbmpm_shape, form, shape, shape_defaults());
    HOLD(world);
    const char *problem = force_problem(&own, &form, w->def.dimension);
    if (!problem) problem = keyed_problem(w, KEYED_FORCES, own.key, -1);
    if (problem) LET_GO(api_invalid(problem));
    const pbmpm_result result = forces_add(&w->forces, &w->memory, &own, &form, w->def.dimension, generation_next(), force);
    if (result == PBMPM_OK) wake_in_reach(w, forces_find(&w->forces, *force));
    LET_GO(result);
}

pbmpm_result pbmpm_force_destroy(pbmpm_world_id world, pbmpm_force_id force)
{
    HOLD(world);
    Force *found = forces_find(&w->forces, force);
    if (!found) LET_GO(api_gone(w, "this force", force.generation));
    wake_in_reach(w, found);
    found->generation = 0;
    ended_add(&w->ended, force.generation);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_force_get(pbmpm_world_id world, pbmpm_force_id force, pbmpm_force_def *def, pbmpm_shape *shape)
{
    if (def) REQUIRE_SIZE(pbmpm_force_def, def);
    if (shape) REQUIRE_SIZE(pbmpm_shape, shape);
    HOLD_READING(world);
    const Force *found = forces_find(&w->forces, force);
    if (!found) LET_GO(api_gone(w, "this force", force.generation));
    if (def) WRITE(pbmpm_force_def, def, &found->def);
    if (shape) WRITE(pbmpm_shape, shape, &found->shape);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_force_set(pbmpm_world_id world, pbmpm_force_id force, const pbmpm_force_def *def, const pbmpm_shape *shape)
{
    HOLD(world);
    Force *found = forces_find(&w->forces, force);
    if (!found) LET_GO(api_gone(w, "this force", force.generation));
    READ_OR_KEEP(pbmpm_force_def, own, def, found->def);
    READ_OR_KEEP(pbmpm_shape, form, shape, found->shape);
    const char *problem = force_problem(&own, &form, w->def.dimension);
    if (!problem) problem = keyed_problem(w, KEYED_FORCES, own.key, (int32_t)force.index);
    if (problem) LET_GO(api_invalid(problem));
    if (memcmp(&found->def, &own, sizeof own) == 0 && memcmp(&found->shape, &form, sizeof form) == 0)
        LET_GO(PBMPM_OK); /* nothing changes, nothing wakes */
    wake_in_reach(w, found);
    force_set(found, &own, &form, w->def.dimension);
    wake_in_reach(w, found);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_force_status_get(pbmpm_world_id world, pbmpm_force_id force, pbmpm_force_status *status)
{
    REQUIRE_SIZE(pbmpm_force_status, status);
    HOLD_READING(world);
    const Force *found = forces_find(&w->forces, force);
    if (!found) LET_GO(api_gone(w, "this force", force.generation));
    pbmpm_force_status own = {.size = sizeof own, .nodes = found->nodes};
    memcpy(own.impulse, found->impulse, sizeof own.impulse);
    WRITE(pbmpm_force_status, status, &own);
    LET_GO(PBMPM_OK);
}
