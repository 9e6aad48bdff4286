/* The exported functions of solid.h, and those that read impulses. */
#include "pbmpm/pbmpm.h"

#include "api/api_call.h"
#include "base/cpu.h"
#include "base/generations.h"
#include "shape/bake.h"
#include "world/sleep_wake.h"
#include "world/stirred.h"

/* ---- Baking: no world ---- */

pbmpm_result pbmpm_mesh_def_init(pbmpm_mesh_def *def, size_t size)
{
    INIT(pbmpm_mesh_def, def, size, mesh_defaults());
}

pbmpm_result pbmpm_heights_def_init(pbmpm_heights_def *def, size_t size)
{
    INIT(pbmpm_heights_def, def, size, heights_defaults());
}

static pbmpm_result bake(const pbmpm_mesh_def *def, bool hull, void *buffer, uint64_t capacity, uint64_t *bytes)
{
    const uint32_t float_mode = float_mode_enter_from_host();
    const pbmpm_result result = bake_mesh(def, hull, buffer, capacity, bytes);
    float_mode_leave_to_host(float_mode);
    return result;
}

pbmpm_result pbmpm_bake_mesh(const pbmpm_mesh_def *def, void *buffer, uint64_t capacity, uint64_t *bytes)
{
    READ(pbmpm_mesh_def, own, def, mesh_defaults());
    REQUIRE(bytes);
    return bake(&own, false, buffer, capacity, bytes);
}

pbmpm_result pbmpm_bake_hull(const pbmpm_mesh_def *def, void *buffer, uint64_t capacity, uint64_t *bytes)
{
    READ(pbmpm_mesh_def, own, def, mesh_defaults());
    REQUIRE(bytes);
    return bake(&own, true, buffer, capacity, bytes);
}

pbmpm_result pbmpm_bake_heights(const pbmpm_heights_def *def, void *buffer, uint64_t capacity, uint64_t *bytes)
{
    READ(pbmpm_heights_def, own, def, heights_defaults());
    REQUIRE(bytes);
    const uint32_t float_mode = float_mode_enter_from_host();
    const pbmpm_result result = bake_heights(&own, buffer, capacity, bytes);
    float_mode_leave_to_host(float_mode);
    return result;
}

pbmpm_result pbmpm_baked_inspect(const void *data, uint64_t size, pbmpm_baked_info *info)
{
    DistanceGrid grid;
    const void *values;
    REQUIRE(data);
    REQUIRE_SIZE(pbmpm_baked_info, info);
    const uint32_t float_mode = float_mode_enter_from_host();
    const pbmpm_result result = distance_grid_read(data, size, &grid, &values);
    const pbmpm_baked_info own = result == PBMPM_OK ? baked_describe(&grid) : (pbmpm_baked_info){0};
    float_mode_leave_to_host(float_mode);
    if (result == PBMPM_OK) WRITE(pbmpm_baked_info, info, &own);
    return result;
}

/* ---- Solids of a world ---- */

pbmpm_result pbmpm_baked_create(pbmpm_world_id world, const void *data, uint64_t size, pbmpm_baked_id *baked)
{
    REQUIRE(baked);
    *baked = (pbmpm_baked_id){0, 0};
    REQUIRE(data);
    HOLD(world);
    LET_GO(baked_add(&w->baked, &w->memory, w->def.dimension, data, size, generation_next(), baked));
}

pbmpm_result pbmpm_baked_get(pbmpm_world_id world, pbmpm_baked_id baked, pbmpm_baked_info *info)
{
    REQUIRE_SIZE(pbmpm_baked_info, info);
    HOLD_READING(world);
    const DistanceGrid *grid = baked_find(&w->baked, baked);
    if (!grid) LET_GO(api_gone(w, "this baked solid", baked.generation));
    const pbmpm_baked_info own = baked_describe(grid);
    WRITE(pbmpm_baked_info, info, &own);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_baked_destroy(pbmpm_world_id world, pbmpm_baked_id baked)
{
    HOLD(world);
    const DistanceGrid *grid = baked_find(&w->baked, baked);
    if (!grid) LET_GO(api_gone(w, "this baked solid", baked.generation));
    if (colliders_use(&w->colliders, grid)) LET_GO(fail(PBMPM_ERROR_IN_USE, "a collider still has this shape"));
    baked_remove(&w->baked, &w->memory, baked.index);
    ended_add(&w->ended, baked.generation);
    for (int kinds = 0; kinds <= ISLAND_GROUPS; kinds++) obstacle_cache_forget(&w->obstacle_cache[kinds]); /* another may come to stand where it was in memory */
    LET_GO(PBMPM_OK);
}

/* ---- Impulses ---- */

static void read_impulse(const World *world, uint32_t place, const float about[3], pbmpm_impulse *impulse)
{
    double point[3] = {0};
    for (int a = 0; about && a < world->def.dimension; a++) point[a] = (double)about[a];
    const pbmpm_impulse own = impulse_about(&world->colliders.impulses.sum[place], point, world->def.dimension);
    WRITE(pbmpm_impulse, impulse, &own);
}

pbmpm_result pbmpm_collider_impulse(pbmpm_world_id world, pbmpm_collider_id collider, pbmpm_impulse *impulse)
{
    REQUIRE_SIZE(pbmpm_impulse, impulse);
    HOLD_READING(world);
    const Collider *found = colliders_find(&w->colliders, collider);
    if (!found) LET_GO(api_gone(w, "this collider", collider.generation));
    if (!found->def.measures_impulse) LET_GO(api_invalid("this collider measures no impulse: set collider.measures_impulse"));
    read_impulse(w, collider.index, found->shape.position, impulse);
    LET_GO(PBMPM_OK);
}

static const char *wrong_wall(const World *w, int32_t axis, int32_t upper)
{
    if (axis < 0 || axis >= w->def.dimension || upper < 0 || upper > 1) return "there is no such wall: axis is below the dimension, upper 0 or 1";
    return w->def.domain_enabled ? NULL : "there are no walls: set world.domain_enabled";
}

pbmpm_result pbmpm_domain_wall_get(pbmpm_world_id world, int32_t axis, int32_t upper, pbmpm_domain_wall *wall)
{
    REQUIRE_SIZE(pbmpm_domain_wall, wall);
    HOLD_READING(world);
    const char *problem = wrong_wall(w, axis, upper);
    if (problem) LET_GO(api_invalid(problem));
    WRITE(pbmpm_domain_wall, wall, &w->domain.wall[domain_place(axis, upper)]);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_domain_wall_set(pbmpm_world_id world, int32_t axis, int32_t upper, const pbmpm_domain_wall *wall)
{
    HOLD(world);
    const char *problem = wrong_wall(w, axis, upper);
    if (problem) LET_GO(api_invalid(problem));
    READ_HELD(pbmpm_domain_wall, own, wall, w->domain.wall[domain_place(axis, upper)]);
    problem = domain_wall_problem(&own);
    if (problem) LET_GO(api_invalid(problem));
    domain_set_wall(&w->domain, &w->def, domain_place(axis, upper), &own);
    sleep_wake_all(w);
    stirred_add(w, NULL, 0.0);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_domain_impulse(pbmpm_world_id world, int32_t axis, int32_t upper, pbmpm_impulse *impulse)
{
    REQUIRE_SIZE(pbmpm_impulse, impulse);
    HOLD_READING(world);
    const char *problem = wrong_wall(w, axis, upper);
    if (!problem && !w->def.domain_measures_impulse) problem = "the walls measure no impulse: set world.domain_measures_impulse";
    if (problem) LET_GO(api_invalid(problem));
    read_impulse(w, (uint32_t)(PBMPM_MAX_COLLIDERS + domain_place(axis, upper)), NULL, impulse);
    LET_GO(PBMPM_OK);
}
