/* The exported functions, and nothing else: check the arguments, hold the world, forward, let go. */
#include "pbmpm/pbmpm.h"

#include <string.h>
#include <unistd.h>

#include "api/api_call.h"
#include "api/layout.h"
#include "base/assertion.h"
#include "base/cpu.h"
#include "base/generations.h"
#include "base/numbers.h"
#include "services/background.h"
#include "services/collider_touches.h"
#include "services/copy.h"
#include "services/edit_particles.h"
#include "services/effective_moduli.h"
#include "services/lifecycle.h"
#include "services/origin.h"
#include "services/query.h"
#include "services/readers.h"
#include "services/registry.h"
#include "services/state_hash.h"
#include "services/stats.h"
#include "services/views.h"
#include "step/step.h"
#include "world/colliders.h"
#include "world/keyed.h"
#include "world/sleep_wake.h"
#include "world/stirred.h"

pbmpm_result api_hold(pbmpm_world_id id, int kind, Hold *held)
{
    held->id = id;
    const pbmpm_result result = kind & HOLD_TO_READ ? registry_enter_to_read(id, &held->world) : registry_enter(id, &held->world);
    if (result != PBMPM_OK) return result;
    if (held->world->owner != getpid()) {
        registry_leave(id);
        return fail(PBMPM_ERROR_FORKED, "this world belongs to the parent process");
    }
    held->float_mode = float_mode_enter_from_host();
    if (kind & HOLD_WHILE_STEPPING || !background_is_stepping(held->world)) return PBMPM_OK;
    return api_let_go(held, fail(PBMPM_ERROR_BUSY, "a step of this world is under way: end it first"));
}

pbmpm_result api_let_go(const Hold *held, pbmpm_result result)
{
    float_mode_leave_to_host(held->float_mode);
    registry_leave(held->id);
    return result;
}

pbmpm_result api_gone(const World *world, const char *what, uint32_t generation)
{
    return fail(PBMPM_ERROR_INVALID_ID, "%s %s", what, ended_tell(&world->ended, generation));
}

pbmpm_result api_invalid(const char *problem) { return fail(PBMPM_ERROR_INVALID_ARGUMENT, "%s", problem); }

/* ---- base.h ---- */

const char *pbmpm_result_name(pbmpm_result result) { return result_name(result); }

const char *pbmpm_last_error(void) { return result_message(); }

pbmpm_result pbmpm_set_log_callback(pbmpm_log_callback *callback, void *user)
{
    result_set_log(callback, user);
    return PBMPM_OK;
}

pbmpm_result pbmpm_set_assert_callback(pbmpm_assert_callback *callback, void *user)
{
    if (!ASSERTS) return fail(PBMPM_ERROR_UNSUPPORTED, "the library was built without assertions (PBMPM_ASSERTS)");
    assertion_set_callback(callback, user);
    return PBMPM_OK;
}

uint32_t pbmpm_version(void)
{
    return PBMPM_VERSION_MAJOR * 1000000u + PBMPM_VERSION_MINOR * 1000u + PBMPM_VERSION_PATCH;
}

uint32_t pbmpm_abi_version(void) { return PBMPM_ABI_VERSION; }

pbmpm_isa pbmpm_active_isa(void) { return cpu_isa(); }

const char *pbmpm_isa_name(pbmpm_isa isa) { return cpu_isa_name(isa); }

int32_t pbmpm_build_is_strict(void) { return PBMPM_STRICT; }

pbmpm_result pbmpm_layout_table(const pbmpm_layout_entry **entries, uint32_t *count)
{
    REQUIRE(entries);
    REQUIRE(count);
    *entries = layout_table(count);
    return PBMPM_OK;
}

pbmpm_result pbmpm_shutdown(void)
{
    registry_clear();
    return PBMPM_OK;
}

/* A library that is unloaded must not leave threads in its code. */
__attribute__((destructor)) static void clear_at_unload(void) { registry_clear_at_unload(); }

/* ---- world.h ---- */

/* Shorter substeps leave the range of floats: velocities are displacements divided by them. */
static const double SHORTEST_SUBSTEP = 1e-25;

pbmpm_result pbmpm_world_def_init(pbmpm_world_def *def, size_t size)
{
    INIT(pbmpm_world_def, def, size, world_def_defaults());
}

pbmpm_result pbmpm_settings_init(pbmpm_settings *settings, size_t size)
{
    INIT(pbmpm_settings, settings, size, settings_defaults());
}

static pbmpm_result create_world(const pbmpm_world_def *def, pbmpm_world_id *world)
{
    const char *problem = world_def_problem(def);
    if (problem) return api_invalid(problem);
    World *created;
    pbmpm_result result = world_create(def, &created);
    if (result != PBMPM_OK) return result;
    const int threads = pool_thread_count(created->pool); /* afterwards another thread may destroy it */
    result = registry_add(created, world);
    if (result != PBMPM_OK) {
        world_destroy(created);
        return result;
    }
    result_log(PBMPM_LOG_INFO, "world %u: %dD, cells of %g m, room for %u particles, %s, %d threads", world->index, def->dimension, (double)def->cell_size,
               def->particle_capacity, cpu_isa_name(cpu_isa()), threads);
    return PBMPM_OK;
}

pbmpm_result pbmpm_world_create(const pbmpm_world_def *def, pbmpm_world_id *world)
{
    REQUIRE(world);
    *world = (pbmpm_world_id){0, 0};
    READ(pbmpm_world_def, own, def, world_def_defaults());
    pbmpm_allocator allocator = {.size = sizeof allocator};
    pbmpm_task_hooks tasks = {.size = sizeof tasks};
    pbmpm_result read = PBMPM_OK;
    if (own.allocator) read = sized_read(SIZED_pbmpm_allocator, __func__, "def.allocator", own.allocator, &allocator);
    if (own.tasks && read == PBMPM_OK) read = sized_read(SIZED_pbmpm_task_hooks, __func__, "def.tasks", own.tasks, &tasks);
    if (read != PBMPM_OK) return read;
    if (own.allocator) own.allocator = &allocator;
    if (own.tasks) own.tasks = &tasks;
    const uint32_t float_mode = float_mode_enter_from_host();
    const pbmpm_result result = create_world(&own, world);
    float_mode_leave_to_host(float_mode);
    return result;
}

pbmpm_result pbmpm_world_destroy(pbmpm_world_id world)
{
    World *removed;
    const pbmpm_result result = registry_remove(world, &removed);
    if (result == PBMPM_OK) world_destroy(removed);
    return result;
}

pbmpm_result pbmpm_world_get_def(pbmpm_world_id world, pbmpm_world_def *def)
{
    REQUIRE_SIZE(pbmpm_world_def, def);
    HOLD_READING_STEPPING(world);
    WRITE(pbmpm_world_def, def, &w->def);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_world_get_settings(pbmpm_world_id world, pbmpm_settings *settings)
{
    REQUIRE_SIZE(pbmpm_settings, settings);
    HOLD_READING(world);
    WRITE(pbmpm_settings, settings, &w->settings);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_world_set_settings(pbmpm_world_id world, const pbmpm_settings *settings)
{
    HOLD(world);
    READ_HELD(pbmpm_settings, own, settings, w->settings);
    const char *problem = settings_problem(&own, w->def.dimension);
    if (problem) LET_GO(api_invalid(problem));
    if (settings_change_motion(&w->settings, &own)) sleep_wake_all(w);
    w->settings = own;
    LET_GO(PBMPM_OK);
}

const char *api_step_problem(const World *world, float dt)
{
    const double part = (double)dt / world->settings.substeps;
    if (!(dt > 0.0f && dt <= 10.0f)) return "dt must be in (0, 10] seconds";
    if (part < SHORTEST_SUBSTEP || part < SHORTEST_SUBSTEP * (double)world->def.cell_size)
        return "dt is too short: a substep must last 1e-25 s, and 1e-25 s per metre of cell size";
    if (world->settings.solver == PBMPM_SOLVER_EXPLICIT && materials_want_modulus(&world->materials))
        return "the explicit solver needs a bulk_modulus for every liquid";
    return NULL;
}

pbmpm_result pbmpm_world_step(pbmpm_world_id world, float dt)
{
    HOLD(world);
    const char *problem = api_step_problem(w, dt);
    if (problem) LET_GO(api_invalid(problem));
    LET_GO(world_step(w, dt));
}

pbmpm_result pbmpm_world_shift_origin(pbmpm_world_id world, const double wanted[3], double moved[3])
{
    REQUIRE(wanted);
    REQUIRE(moved);
    HOLD(world);
    LET_GO(origin_shift(w, wanted, moved));
}

pbmpm_result pbmpm_world_generation(pbmpm_world_id world, uint64_t *generation)
{
    REQUIRE(generation);
    HOLD_READING_STEPPING(world);
    *generation = background_is_stepping(w) ? background_generation(w) : w->generation;
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_world_hash(pbmpm_world_id world, uint64_t *hash)
{
    REQUIRE(hash);
    HOLD_READING(world);
    *hash = state_hash(w);
    LET_GO(PBMPM_OK);
}

/* ---- material.h ---- */

uint32_t pbmpm_materials_built(void) { return materials_built(); }

pbmpm_result pbmpm_material_def_init(pbmpm_material_def *def, size_t size)
{
    INIT(pbmpm_material_def, def, size, material_defaults());
}

pbmpm_result pbmpm_material_create(pbmpm_world_id world, const pbmpm_material_def *def, pbmpm_material_id *material)
{
    REQUIRE(material);
    *material = (pbmpm_material_id){0, 0};
    READ(pbmpm_material_def, own, def, material_defaults());
    HOLD(world);
    const pbmpm_result usable = material_kind_usable(own.kind);
    if (usable != PBMPM_OK) LET_GO(usable);
    const char *problem = material_problem(&own);
    if (!problem) problem = keyed_problem(w, KEYED_MATERIALS, own.key, -1);
    if (problem) LET_GO(api_invalid(problem));
    const pbmpm_result result = materials_add(&w->materials, &own, generation_next(), material);
    if (result == PBMPM_OK) colliders_forget_material(&w->colliders, material->index);
    LET_GO(result);
}

pbmpm_result pbmpm_material_get(pbmpm_world_id world, pbmpm_material_id material, pbmpm_material_def *def)
{
    REQUIRE_SIZE(pbmpm_material_def, def);
    HOLD_READING(world);
    if (!material_is_live(&w->materials, material)) LET_GO(api_gone(w, "this material", material.generation));
    WRITE(pbmpm_material_def, def, &w->materials.def[material.index]);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_material_effective(pbmpm_world_id world, pbmpm_material_id material, float dt, pbmpm_effective *effective)
{
    REQUIRE_SIZE(pbmpm_effective, effective);
    HOLD(world);
    if (!(dt > 0.0f && dt <= 10.0f)) LET_GO(api_invalid("dt must be in (0, 10] seconds"));
    if (!material_is_live(&w->materials, material)) LET_GO(api_gone(w, "this material", material.generation));
    const Substep substep = world_substep(w, (double)dt / w->settings.substeps);
    const pbmpm_effective found = effective_modulus(w, material.index, &substep);
    WRITE(pbmpm_effective, effective, &found);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_material_set(pbmpm_world_id world, pbmpm_material_id material, const pbmpm_material_def *def)
{
    HOLD(world);
    if (!material_is_live(&w->materials, material)) LET_GO(api_gone(w, "this material", material.generation));
    const pbmpm_material_def *old = &w->materials.def[material.index];
    READ_HELD(pbmpm_material_def, own, def, *old);
    const char *problem = material_problem(&own);
    if (!problem) problem = keyed_problem(w, KEYED_MATERIALS, own.key, (int32_t)material.index);
    if (problem) LET_GO(api_invalid(problem));
    if (old->kind != own.kind || old->density != own.density)
        LET_GO(api_invalid("the kind and the density of a material cannot be changed"));
    materials_set(&w->materials, material.index, &own);
    sleep_wake_all(w);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_material_destroy(pbmpm_world_id world, pbmpm_material_id material)
{
    HOLD(world);
    if (!material_is_live(&w->materials, material)) LET_GO(api_gone(w, "this material", material.generation));
    if (w->particles.of_material[material.index] > 0) LET_GO(fail(PBMPM_ERROR_IN_USE, "particles still use this material"));
    if (emitters_use(&w->emitters, material)) LET_GO(fail(PBMPM_ERROR_IN_USE, "an emitter still uses this material"));
    w->materials.generation[material.index] = 0;
    ended_add(&w->ended, material.generation);
    LET_GO(PBMPM_OK);
}

/* ---- shape.h, collider.h ---- */

pbmpm_result pbmpm_shape_init(pbmpm_shape *shape, size_t size)
{
    INIT(pbmpm_shape, shape, size, shape_defaults());
}

pbmpm_result pbmpm_collider_def_init(pbmpm_collider_def *def, size_t size)
{
    INIT(pbmpm_collider_def, def, size, collider_defaults());
}

static void wake_near_collider(World *w, const Collider *collider)
{
    if (collider->def.sensor) return;
    const Solid solid = solid_among(&collider->shape, w->def.dimension, &w->baked);
    sleep_wake_near(w, &solid, SLEEP_FELT);
    stirred_add(w, &solid, SLEEP_FELT);
}

/* `slot`: -1 for a new one. */
static const char *wrong_collider(const World *w, const pbmpm_collider_def *def, const pbmpm_shape *shape, int32_t slot)
{
    const char *problem = collider_problem(def);
    if (!problem) problem = keyed_problem(w, KEYED_COLLIDERS, def->key, slot);
    return problem ? problem : shape_problem_among(shape, w->def.dimension, &w->baked);
}

static const DistanceGrid *grid_of(const World *w, const pbmpm_shape *shape)
{
    return shape->kind == PBMPM_BAKED ? baked_find(&w->baked, shape->baked) : NULL;
}

pbmpm_result pbmpm_collider_create(pbmpm_world_id world, const pbmpm_collider_def *def, const pbmpm_shape *shape, pbmpm_collider_id *collider)
{
    REQUIRE(collider);
    *collider = (pbmpm_collider_id){0, 0};
    READ(pbmpm_collider_def, own, def, collider_defaults());
    READ(pbmpm_shape, form, shape, shape_defaults());
    HOLD(world);
    const char *problem = wrong_collider(w, &own, &form, -1);
    if (problem) LET_GO(api_invalid(problem));
    const pbmpm_result result = colliders_add(&w->colliders, &w->memory, &own, &form, grid_of(w, &form), generation_next(), collider);
    if (result == PBMPM_OK) wake_near_collider(w, colliders_find(&w->colliders, *collider));
    LET_GO(result);
}

pbmpm_result pbmpm_collider_destroy(pbmpm_world_id world, pbmpm_collider_id collider)
{
    HOLD(world);
    Collider *found = colliders_find(&w->colliders, collider);
    if (!found) LET_GO(api_gone(w, "this collider", collider.generation));
    wake_near_collider(w, found);
    found->generation = 0;
    ended_add(&w->ended, collider.generation);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_collider_get(pbmpm_world_id world, pbmpm_collider_id collider, pbmpm_collider_def *def, pbmpm_shape *shape)
{
    if (def) REQUIRE_SIZE(pbmpm_collider_def, def);
    if (shape) REQUIRE_SIZE(pbmpm_shape, shape);
    HOLD_READING(world);
    const Collider *found = colliders_find(&w->colliders, collider);
    if (!found) LET_GO(api_gone(w, "this collider", collider.generation));
    if (def) WRITE(pbmpm_collider_def, def, &found->def);
    if (shape) WRITE(pbmpm_shape, shape, &found->shape);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_collider_set(pbmpm_world_id world, pbmpm_collider_id collider, const pbmpm_collider_def *def, const pbmpm_shape *shape)
{
    HOLD(world);
    Collider *found = colliders_find(&w->colliders, collider);
    if (!found) LET_GO(api_gone(w, "this collider", collider.generation));
    READ_OR_KEEP(pbmpm_collider_def, own, def, found->def);
    READ_OR_KEEP(pbmpm_shape, form, shape, found->shape);
    const char *problem = wrong_collider(w, &own, &form, (int32_t)collider.index);
    if (problem) LET_GO(api_invalid(problem));
    const Collider before = *found;
    const pbmpm_result result = colliders_set(&w->colliders, &w->memory, found, &own, shape ? &form : NULL, grid_of(w, &form));
    if (result != PBMPM_OK) LET_GO(result);
    wake_near_collider(w, &before);
    wake_near_collider(w, found);
    LET_GO(PBMPM_OK);
}

static pbmpm_result place_collider(World *w, pbmpm_collider_id collider, const float *position, const float *rotation, bool at_once)
{
    Collider *found = colliders_find(&w->colliders, collider);
    if (!found) return api_gone(w, "this collider", collider.generation);
    if (!at_once && !found->def.kinematic) return api_invalid("only kinematic colliders move");
    pbmpm_shape shape = found->shape;
    memcpy(shape.position, position, sizeof shape.position);
    if (rotation) memcpy(shape.rotation, rotation, sizeof shape.rotation);
    const char *problem = shape_problem_among(&shape, w->def.dimension, &w->baked);
    if (problem) return api_invalid(problem);
    if (at_once) wake_near_collider(w, found);
    collider_place(found, position, rotation, at_once);
    if (at_once) wake_near_collider(w, found);
    return PBMPM_OK;
}

pbmpm_result pbmpm_collider_move(pbmpm_world_id world, pbmpm_collider_id collider, const float position[3], const float rotation[4])
{
    REQUIRE(position);
    HOLD(world);
    LET_GO(place_collider(w, collider, position, rotation, false));
}

pbmpm_result pbmpm_collider_teleport(pbmpm_world_id world, pbmpm_collider_id collider, const float position[3], const float rotation[4])
{
    REQUIRE(position);
    HOLD(world);
    LET_GO(place_collider(w, collider, position, rotation, true));
}

pbmpm_result pbmpm_world_touches(pbmpm_world_id world, pbmpm_touch *touches, uint32_t capacity, uint32_t *count)
{
    REQUIRE(count);
    if (capacity) REQUIRE_SIZE(pbmpm_touch, touches);
    HOLD(world);
    LET_GO(collider_touches_find(w, touches, capacity, count));
}

pbmpm_result pbmpm_query_collider(pbmpm_world_id world, pbmpm_collider_id collider, pbmpm_particle_id *ids, uint32_t capacity, uint32_t *count)
{
    REQUIRE(count);
    if (capacity) REQUIRE(ids);
    HOLD_READING(world);
    const Collider *found = colliders_find(&w->colliders, collider);
    if (!found) LET_GO(api_gone(w, "this collider", collider.generation));
    const Solid solid = solid_among(&found->shape, w->def.dimension, &w->baked);
    LET_GO(query_inside(w, &solid, -0.01 * (double)w->def.cell_size, ids, capacity, count));
}

pbmpm_result pbmpm_query_shape(pbmpm_world_id world, const pbmpm_shape *shape, pbmpm_particle_id *ids, uint32_t capacity, uint32_t *count)
{
    READ(pbmpm_shape, own, shape, shape_defaults());
    REQUIRE(count);
    if (capacity) REQUIRE(ids);
    HOLD_READING(world);
    const char *problem = shape_problem_among(&own, w->def.dimension, &w->baked);
    if (problem) LET_GO(api_invalid(problem));
    const Solid solid = solid_among(&own, w->def.dimension, &w->baked);
    LET_GO(query_inside(w, &solid, 0.0, ids, capacity, count));
}

/* ---- particles.h ---- */

pbmpm_result pbmpm_particles_def_init(pbmpm_particles_def *def, size_t size)
{
    INIT(pbmpm_particles_def, def, size, particles_def_defaults());
}

pbmpm_result pbmpm_fill_def_init(pbmpm_fill_def *def, size_t size)
{
    INIT(pbmpm_fill_def, def, size, fill_def_defaults());
}

pbmpm_result pbmpm_particles_add(pbmpm_world_id world, const pbmpm_particles_def *def, pbmpm_particle_id *ids)
{
    READ(pbmpm_particles_def, own, def, particles_def_defaults());
    HOLD(world);
    LET_GO(edit_add(w, &own, generation_next_of_particles(), ids));
}

pbmpm_result pbmpm_particles_fill(pbmpm_world_id world, const pbmpm_fill_def *def, const pbmpm_shape *shape, uint32_t *added)
{
    READ(pbmpm_fill_def, own, def, fill_def_defaults());
    READ(pbmpm_shape, form, shape, shape_defaults());
    HOLD(world);
    LET_GO(edit_fill(w, &own, &form, generation_next_of_particles(), added));
}

pbmpm_result pbmpm_particles_remove(pbmpm_world_id world, const pbmpm_particle_id *ids, uint32_t count)
{
    if (count) REQUIRE(ids);
    HOLD(world);
    LET_GO(edit_remove(w, ids, count));
}

pbmpm_result pbmpm_particles_remove_in(pbmpm_world_id world, const pbmpm_shape *shape, uint32_t *removed)
{
    READ(pbmpm_shape, own, shape, shape_defaults());
    HOLD(world);
    LET_GO(edit_remove_in(w, &own, removed));
}

pbmpm_result pbmpm_particles_count(pbmpm_world_id world, uint32_t *count)
{
    REQUIRE(count);
    HOLD_READING_STEPPING(world);
    *count = background_is_stepping(w) ? background_count(w) : w->particles.count;
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_particles_view(pbmpm_world_id world, pbmpm_field field, pbmpm_view *view)
{
    REQUIRE_SIZE(pbmpm_view, view);
    HOLD_READING_STEPPING(world);
    pbmpm_view own;
    const pbmpm_result result = background_is_stepping(w) ? background_view(w, field, &own) : views_get(w, field, &own);
    if (result == PBMPM_OK) WRITE(pbmpm_view, view, &own);
    LET_GO(result);
}

pbmpm_result pbmpm_copy_def_init(pbmpm_copy_def *def, size_t size)
{
    INIT(pbmpm_copy_def, def, size, copy_def_defaults());
}

pbmpm_result pbmpm_particles_copy(pbmpm_world_id world, const pbmpm_copy_def *def, void *buffer, uint64_t capacity, uint32_t *count)
{
    READ_OR_DEFAULT(pbmpm_copy_def, own, def, copy_def_defaults());
    REQUIRE(count);
    if (capacity) REQUIRE(buffer);
    const char *problem = copy_problem(&own);
    if (problem) return api_invalid(problem);
    HOLD_READING_STEPPING(world);
    LET_GO(copy_particles(w, &own, buffer, capacity, count));
}

pbmpm_result pbmpm_particles_set(pbmpm_world_id world, pbmpm_field field, const pbmpm_particle_id *ids, uint32_t count, const void *values)
{
    if (count) REQUIRE(values);
    HOLD(world);
    LET_GO(edit_set(w, field, ids, count, values));
}

pbmpm_result pbmpm_particles_find(pbmpm_world_id world, const pbmpm_particle_id *ids, uint32_t count, uint32_t *rows)
{
    if (count) REQUIRE(ids);
    if (count) REQUIRE(rows);
    HOLD_READING(world);
    uint32_t row;
    readers_find_rows(w);
    for (uint32_t i = 0; i < count; i++)
        if (!particles_row(&w->particles, ids[i], &row))
            LET_GO(edit_no_particle(ids[i], i));
    for (uint32_t i = 0; i < count; i++) particles_row(&w->particles, ids[i], &rows[i]);
    LET_GO(PBMPM_OK);
}

/* ---- stats.h ---- */

pbmpm_result pbmpm_world_get_stats(pbmpm_world_id world, pbmpm_stats *stats)
{
    REQUIRE_SIZE(pbmpm_stats, stats);
    HOLD_READING(world);
    pbmpm_stats own;
    stats_of_world(w, &own);
    WRITE(pbmpm_stats, stats, &own);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_world_get_step_stats(pbmpm_world_id world, pbmpm_stats *stats)
{
    REQUIRE_SIZE(pbmpm_stats, stats);
    HOLD_READING_STEPPING(world);
    pbmpm_stats own;
    if (background_is_stepping(w))
        own = *background_step_stats(w);
    else
        stats_of_step(w, &own);
    WRITE(pbmpm_stats, stats, &own);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_world_events(pbmpm_world_id world, pbmpm_event *events, uint32_t capacity, uint32_t *count, uint32_t *missed)
{
    REQUIRE(count);
    if (capacity) REQUIRE_SIZE(pbmpm_event, events);
    HOLD_READING(world);
    for (uint32_t i = 0; i < w->events.count && i < capacity; i++) sized_put(SIZED_pbmpm_event, events, i, &w->events.list[i]);
    *count = w->events.count;
    if (missed) *missed = w->events.missed;
    LET_GO(PBMPM_OK);
}
