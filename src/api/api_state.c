/* Exported functions of snapshot.h, async.h, query.h and advice.h: check the arguments, hold the world, forward, let go. */
#include "pbmpm/pbmpm.h"

#include "api/api_call.h"
#include "services/advice.h"
#include "services/background.h"
#include "services/query.h"
#include "snapshot/snapshot.h"
#include "world/sleep_wake.h"

/* ---- snapshot.h ---- */

pbmpm_result pbmpm_snapshot_size(pbmpm_world_id world, uint64_t *bytes, uint32_t *bytes_per_particle)
{
    REQUIRE(bytes);
    HOLD_READING(world);
    *bytes = snapshot_size(w);
    if (bytes_per_particle) *bytes_per_particle = snapshot_bytes_per_particle(w);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_snapshot_save(pbmpm_world_id world, void *buffer, uint64_t capacity, uint64_t *bytes)
{
    REQUIRE(buffer);
    HOLD_READING(world);
    const uint64_t needed = snapshot_size(w);
    if (bytes) *bytes = needed;
    if (needed > capacity)
        LET_GO(fail(PBMPM_ERROR_CAPACITY, "the snapshot needs %llu bytes; there are %llu", (unsigned long long)needed,
                    (unsigned long long)capacity));
    snapshot_save(w, buffer);
    LET_GO(PBMPM_OK);
}

pbmpm_result pbmpm_snapshot_restore(pbmpm_world_id world, const void *snapshot, uint64_t bytes, uint32_t flags)
{
    REQUIRE(snapshot);
    if (flags & ~(uint32_t)PBMPM_RESTORE_KEEP_PARAMETERS) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "%s: flags %u are not known", __func__, flags);
    HOLD(world);
    LET_GO(snapshot_restore(w, snapshot, bytes, flags));
}

/* ---- async.h ---- */

pbmpm_result pbmpm_world_publish(pbmpm_world_id world, const pbmpm_field *fields, uint32_t count)
{
    if (count) REQUIRE(fields);
    HOLD(world);
    const char *problem = background_fields_problem(fields, count);
    if (problem) LET_GO(api_invalid(problem));
    LET_GO(background_publish(w, fields, count));
}

pbmpm_result pbmpm_world_step_begin(pbmpm_world_id world, float dt)
{
    HOLD(world);
    const char *problem = api_step_problem(w, dt);
    if (problem) LET_GO(api_invalid(problem));
    LET_GO(background_begin(w, dt));
}

pbmpm_result pbmpm_world_step_end(pbmpm_world_id world, int32_t wait)
{
    HOLD_STEPPING(world);
    LET_GO(background_end(w, wait != 0));
}

pbmpm_result pbmpm_world_step_done(pbmpm_world_id world, int32_t *done)
{
    REQUIRE(done);
    HOLD_READING_STEPPING(world);
    LET_GO(background_done(w, done));
}

/* ---- sleep.h ---- */

pbmpm_result pbmpm_world_wake(pbmpm_world_id world, const pbmpm_shape *shape)
{
    HOLD(world);
    if (!shape) {
        sleep_wake_all(w);
        LET_GO(PBMPM_OK);
    }
    READ_HELD(pbmpm_shape, own, shape, shape_defaults());
    const char *problem = shape_problem_among(&own, w->def.dimension, &w->baked);
    if (problem) LET_GO(api_invalid(problem));
    const Solid solid = solid_among(&own, w->def.dimension, &w->baked);
    sleep_wake_near(w, &solid, SLEEP_FELT);
    LET_GO(PBMPM_OK);
}

/* ---- query.h ---- */

pbmpm_result pbmpm_ray_init(pbmpm_ray *ray, size_t size)
{
    INIT(pbmpm_ray, ray, size, query_ray_defaults());
}

pbmpm_result pbmpm_query_region(pbmpm_world_id world, const pbmpm_shape *shape, pbmpm_region_share *shares, uint32_t capacity,
                                uint32_t *count)
{
    READ(pbmpm_shape, own, shape, shape_defaults());
    REQUIRE(count);
    if (capacity) REQUIRE_SIZE(pbmpm_region_share, shares);
    HOLD_READING(world);
    const char *problem = shape_problem_among(&own, w->def.dimension, &w->baked);
    if (problem) LET_GO(api_invalid(problem));
    const Solid solid = solid_among(&own, w->def.dimension, &w->baked);
    LET_GO(query_region(w, &solid, shares, capacity, count));
}

pbmpm_result pbmpm_query_points(pbmpm_world_id world, const float *points, uint32_t count, float *filling, float *density, float *velocity)
{
    if (count) REQUIRE(points);
    HOLD_READING(world);
    const char *problem = query_points_problem(w, points, count);
    if (problem) LET_GO(api_invalid(problem));
    LET_GO(query_points(w, points, count, filling, density, velocity));
}

pbmpm_result pbmpm_query_heights(pbmpm_world_id world, const float *points, uint32_t count, const float *direction, float level,
                                 float *heights)
{
    if (count) REQUIRE(points);
    if (count) REQUIRE(heights);
    HOLD_READING(world);
    double up[3];
    const char *problem = query_points_problem(w, points, count);
    if (!problem) problem = query_level_problem(level);
    if (!problem && !query_direction(w, direction, up))
        problem = "the direction must be finite and longer than 1e-6; without one there must be gravity";
    if (problem) LET_GO(api_invalid(problem));
    LET_GO(query_heights(w, points, count, up, level, heights));
}

pbmpm_result pbmpm_query_ray(pbmpm_world_id world, const pbmpm_ray *ray, pbmpm_ray_hit *hit)
{
    READ(pbmpm_ray, own, ray, query_ray_defaults());
    REQUIRE_SIZE(pbmpm_ray_hit, hit);
    HOLD_READING(world);
    const char *problem = query_ray_problem(w, &own);
    if (problem) LET_GO(api_invalid(problem));
    pbmpm_ray_hit found;
    const pbmpm_result result = query_ray(w, &own, &found);
    if (result == PBMPM_OK) WRITE(pbmpm_ray_hit, hit, &found);
    LET_GO(result);
}

/* ---- advice.h ---- */

pbmpm_result pbmpm_world_advice(pbmpm_world_id world, float dt, pbmpm_advice *array, uint32_t capacity, uint32_t *count)
{
    REQUIRE(count);
    if (capacity) REQUIRE_SIZE(pbmpm_advice, array);
    HOLD(world);
    if (!(dt > 0.0f && dt <= 10.0f)) LET_GO(api_invalid("dt must be in (0, 10] seconds"));
    LET_GO(advice_give(w, (double)dt, array, capacity, count));
}

const char *pbmpm_advice_name(pbmpm_advice_code code) { return advice_name(code); }

const char *pbmpm_advice_unit(pbmpm_advice_code code) { return advice_unit(code); }
