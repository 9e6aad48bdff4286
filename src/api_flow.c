/* The exported functions of emitter.h, drain.h and force.h. */
#include <math.h>
#include <string.h>

#include "api_call.h"
#include "emitters.h"
#include "forces.h"
#include "registry.h"
#include "sinks.h"
#include "sleep.h"

/* ---- emitter.h ---- */

pbmpm_result pbmpm_emitter_def_init(pbmpm_emitter_def *def, size_t size)
{
    const pbmpm_emitter_def defaults = emitter_defaults();
    INIT(def, size, defaults);
}

static pbmpm_result check_emitter(const World *w, const pbmpm_emitter_def *def)
{
    const char *problem = emitter_problem(def, w->def.dimension, (double)w->def.cell_size);
    if (problem) return api_invalid(problem);
    if (material_is_live(&w->materials, def->material)) return PBMPM_OK;
    return fail(PBMPM_ERROR_INVALID_ID, "emitter.material is not of this world");
}

pbmpm_result pbmpm_emitter_create(pbmpm_world_id world, const pbmpm_emitter_def *def, pbmpm_emitter_id *emitter)
{
    REQUIRE(emitter);
    *emitter = (pbmpm_emitter_id){0, 0};
    REQUIRE_FILLED(def, pbmpm_emitter_def_init);
    HOLD(world);
    const pbmpm_result checked = check_emitter(w, def);
    if (checked != PBMPM_OK) LET_GO(checked);
    LET_GO(emitters_add(&w->emitters, &w->memory, def, registry_next_generation(), emitter));
}

static pbmpm_result no_emitter(void) { return fail(PBMPM_ERROR_INVALID_ID, "no such emitter in this world"); }

pbmpm_result pbmpm_emitter_destroy(pbmpm_world_id world, pbmpm_emitter_id emitter)
{
    HOLD(world);
    Emitter *found = emitters_find(&w->emitters, emitter);
    if (!found) LET_GO(no_emitter());
    found->generation = 0;
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_emitter_get(pbmpm_world_id world, pbmpm_emitter_id emitter, pbmpm_emitter_def *def)
{
    REQUIRE_SIZE(def);
    HOLD(world);
    const Emitter *found = emitters_find(&w->emitters, emitter);
    if (!found) LET_GO(no_emitter());
    *def = found->def;
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_emitter_set(pbmpm_world_id world, pbmpm_emitter_id emitter, const pbmpm_emitter_def *def)
{
    REQUIRE_FILLED(def, pbmpm_emitter_def_init);
    HOLD(world);
    Emitter *found = emitters_find(&w->emitters, emitter);
    if (!found) LET_GO(no_emitter());
    const pbmpm_result checked = check_emitter(w, def);
    if (checked == PBMPM_OK) emitter_set(found, def);
    LET_GO(checked);
}

pbmpm_result pbmpm_emitter_move(pbmpm_world_id world, pbmpm_emitter_id emitter, const float position[3], const float rotation[4])
{
    REQUIRE(position);
    HOLD(world);
    Emitter *found = emitters_find(&w->emitters, emitter);
    if (!found) LET_GO(no_emitter());
    pbmpm_emitter_def moved = found->def;
    memcpy(moved.shape.position, position, sizeof moved.shape.position);
    if (rotation) memcpy(moved.shape.rotation, rotation, sizeof moved.shape.rotation);
    const pbmpm_result checked = check_emitter(w, &moved);
    if (checked == PBMPM_OK) emitter_move(found, position, rotation);
    LET_GO(checked);
}

pbmpm_result pbmpm_emitter_status_get(pbmpm_world_id world, pbmpm_emitter_id emitter, pbmpm_emitter_status *status)
{
    REQUIRE_SIZE(status);
    HOLD(world);
    const Emitter *found = emitters_find(&w->emitters, emitter);
    if (!found) LET_GO(no_emitter());
    emitter_report(found, status);
    LET_GO(PBMPM_OK);
}

/* ---- drain.h ---- */

pbmpm_result pbmpm_drain_def_init(pbmpm_drain_def *def, size_t size)
{
    const pbmpm_drain_def defaults = drain_defaults();
    INIT(def, size, defaults);
}

static pbmpm_result check_drain(const World *w, const pbmpm_drain_def *def)
{
    const char *problem = drain_problem(def, w->def.dimension);
    const bool everything = def->material.index == 0 && def->material.generation == 0;
    if (problem) return api_invalid(problem);
    if (everything || material_is_live(&w->materials, def->material)) return PBMPM_OK;
    return fail(PBMPM_ERROR_INVALID_ID, "drain.material is not of this world");
}

pbmpm_result pbmpm_drain_create(pbmpm_world_id world, const pbmpm_drain_def *def, pbmpm_drain_id *drain)
{
    REQUIRE(drain);
    *drain = (pbmpm_drain_id){0, 0};
    REQUIRE_FILLED(def, pbmpm_drain_def_init);
    HOLD(world);
    const pbmpm_result checked = check_drain(w, def);
    if (checked != PBMPM_OK) LET_GO(checked);
    const pbmpm_result result = sinks_add(&w->sinks, &w->memory, def, w->def.dimension, registry_next_generation(), drain);
    if (result == PBMPM_OK) sleep_wake_near(w, &sinks_find(&w->sinks, *drain)->solid, SLEEP_FELT);
    LET_GO(result);
}

static pbmpm_result no_drain(void) { return fail(PBMPM_ERROR_INVALID_ID, "no such drain in this world"); }

pbmpm_result pbmpm_drain_destroy(pbmpm_world_id world, pbmpm_drain_id drain)
{
    HOLD(world);
    Drain *found = sinks_find(&w->sinks, drain);
    if (!found) LET_GO(no_drain());
    found->generation = 0;
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_drain_get(pbmpm_world_id world, pbmpm_drain_id drain, pbmpm_drain_def *def)
{
    REQUIRE_SIZE(def);
    HOLD(world);
    const Drain *found = sinks_find(&w->sinks, drain);
    if (!found) LET_GO(no_drain());
    *def = found->def;
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_drain_set(pbmpm_world_id world, pbmpm_drain_id drain, const pbmpm_drain_def *def)
{
    REQUIRE_FILLED(def, pbmpm_drain_def_init);
    HOLD(world);
    Drain *found = sinks_find(&w->sinks, drain);
    if (!found) LET_GO(no_drain());
    const pbmpm_result checked = check_drain(w, def);
    if (checked == PBMPM_OK) {
        drain_set(found, def, w->def.dimension);
        sleep_wake_near(w, &found->solid, SLEEP_FELT);
    }
    LET_GO(checked);
}

pbmpm_result pbmpm_drain_status_get(pbmpm_world_id world, pbmpm_drain_id drain, pbmpm_drain_status *status)
{
    REQUIRE_SIZE(status);
    HOLD(world);
    const Drain *found = sinks_find(&w->sinks, drain);
    if (!found) LET_GO(no_drain());
    *status = (pbmpm_drain_status){.size = sizeof *status, .drained = found->drained, .drained_mass = found->drained_mass};
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_kill_bounds_init(pbmpm_kill_bounds *bounds, size_t size)
{
    const pbmpm_kill_bounds defaults = kill_bounds_defaults();
    INIT(bounds, size, defaults);
}

pbmpm_result pbmpm_world_set_kill_bounds(pbmpm_world_id world, const pbmpm_kill_bounds *bounds)
{
    REQUIRE_FILLED(bounds, pbmpm_kill_bounds_init);
    HOLD(world);
    const char *problem = kill_bounds_problem(bounds, w->def.dimension);
    if (problem) LET_GO(api_invalid(problem));
    w->sinks.bounds = *bounds;
    sleep_wake_all(w);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_world_get_kill_bounds(pbmpm_world_id world, pbmpm_kill_bounds *bounds)
{
    REQUIRE_SIZE(bounds);
    HOLD(world);
    *bounds = w->sinks.bounds;
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_world_get_flow(pbmpm_world_id world, pbmpm_flow *flow)
{
    REQUIRE_SIZE(flow);
    HOLD(world);
    *flow = w->flow;
    LET_GO(PBMPM_OK);
}

/* ---- force.h ---- */

pbmpm_result pbmpm_force_def_init(pbmpm_force_def *def, size_t size)
{
    const pbmpm_force_def defaults = force_defaults();
    INIT(def, size, defaults);
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

pbmpm_result pbmpm_force_create(pbmpm_world_id world, const pbmpm_force_def *def, pbmpm_force_id *force)
{
    REQUIRE(force);
    *force = (pbmpm_force_id){0, 0};
    REQUIRE_FILLED(def, pbmpm_force_def_init);
    HOLD(world);
    const char *problem = force_problem(def, w->def.dimension);
    if (problem) LET_GO(api_invalid(problem));
    const pbmpm_result result = forces_add(&w->forces, &w->memory, def, w->def.dimension, registry_next_generation(), force);
    if (result == PBMPM_OK) wake_in_reach(w, forces_find(&w->forces, *force));
    LET_GO(result);
}

static pbmpm_result no_force(void) { return fail(PBMPM_ERROR_INVALID_ID, "no such force in this world"); }

pbmpm_result pbmpm_force_destroy(pbmpm_world_id world, pbmpm_force_id force)
{
    HOLD(world);
    Force *found = forces_find(&w->forces, force);
    if (!found) LET_GO(no_force());
    wake_in_reach(w, found);
    found->generation = 0;
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_force_get(pbmpm_world_id world, pbmpm_force_id force, pbmpm_force_def *def)
{
    REQUIRE_SIZE(def);
    HOLD(world);
    const Force *found = forces_find(&w->forces, force);
    if (!found) LET_GO(no_force());
    *def = found->def;
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_force_set(pbmpm_world_id world, pbmpm_force_id force, const pbmpm_force_def *def)
{
    REQUIRE_FILLED(def, pbmpm_force_def_init);
    HOLD(world);
    Force *found = forces_find(&w->forces, force);
    if (!found) LET_GO(no_force());
    const char *problem = force_problem(def, w->def.dimension);
    if (problem) LET_GO(api_invalid(problem));
    if (memcmp(&found->def, def, sizeof *def) == 0) LET_GO(PBMPM_OK); /* nothing changes, nothing wakes */
    wake_in_reach(w, found);
    force_set(found, def, w->def.dimension);
    wake_in_reach(w, found);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_force_status_get(pbmpm_world_id world, pbmpm_force_id force, pbmpm_force_status *status)
{
    REQUIRE_SIZE(status);
    HOLD(world);
    const Force *found = forces_find(&w->forces, force);
    if (!found) LET_GO(no_force());
    *status = (pbmpm_force_status){.size = sizeof *status, .nodes = found->nodes};
    memcpy(status->impulse, found->impulse, sizeof status->impulse);
    LET_GO(PBMPM_OK);
}
