#include "services/origin.h"

#include <math.h>
#include <string.h>

#include "base/numbers.h"
#include "base/result.h"
#include "world/stirred.h"

/* The lattice of what sleeps moves by whole blocks too, so no particle changes its place in one. */
enum { SHIFT_CELLS = K_BLOCK_AXIS };

static const float BOUNDS_LIMIT = 1e9f; /* [m], see pbmpm_kill_bounds */

typedef struct Shift {
    int dimension;
    int32_t cells[3];
    double by[3]; /* [m] */
} Shift;

static void shift_point(const Shift *shift, float point[3])
{
    for (int a = 0; a < shift->dimension; a++) point[a] = (float)((double)point[a] - shift->by[a]);
}

static pbmpm_shape shifted(const Shift *shift, const pbmpm_shape *shape)
{
    pbmpm_shape moved = *shape;
    shift_point(shift, moved.position);
    return moved;
}

static pbmpm_world_def shifted_def(const Shift *shift, const pbmpm_world_def *def)
{
    pbmpm_world_def moved = *def;
    for (int a = 0; a < shift->dimension; a++) moved.origin[a] += shift->by[a];
    if (!moved.domain_enabled) return moved;
    shift_point(shift, moved.domain_min);
    shift_point(shift, moved.domain_max);
    return moved;
}

static pbmpm_kill_bounds shifted_bounds(const Shift *shift, const pbmpm_kill_bounds *bounds)
{
    pbmpm_kill_bounds moved = *bounds;
    if (!moved.enabled) return moved;
    shift_point(shift, moved.low);
    shift_point(shift, moved.high);
    for (int a = 0; a < shift->dimension; a++) { /* what was at the end of the range stays there */
        moved.low[a] = fmaxf(moved.low[a], -BOUNDS_LIMIT);
        moved.high[a] = fminf(moved.high[a], BOUNDS_LIMIT);
    }
    return moved;
}

/* ---- Whether all is in range afterwards ---- */

static const char *particles_problem(const World *world, const Shift *shift)
{
    const Particles *p = &world->particles;
    for (int a = 0; a < shift->dimension; a++)
        for (uint32_t row = 0; row < p->count; row++) {
            const int64_t cell = (int64_t)p->cell[a][row] - shift->cells[a];
            if (cell < -CELL_LIMIT || cell > CELL_LIMIT) return "a particle would be out of range: more than 2^22 cells from the origin";
        }
    return NULL;
}

static const char *things_problem(const World *world, const Shift *shift)
{
    const int d = shift->dimension;
    const char *problem = NULL;
    for (uint32_t i = 0; i < world->colliders.used && !problem; i++) {
        const Collider *collider = &world->colliders.slot[i];
        const pbmpm_shape moved = shifted(shift, &collider->shape);
        if (collider->generation != 0) problem = shape_problem_among(&moved, d, &world->baked);
    }
    for (uint32_t i = 0; i < world->emitters.used && !problem; i++) {
        const Emitter *emitter = &world->emitters.slot[i];
        const pbmpm_shape moved = shifted(shift, &emitter->shape);
        if (emitter->generation != 0) problem = emitter_problem(&emitter->def, &moved, d, (double)world->def.cell_size);
    }
    for (uint32_t i = 0; i < world->sinks.used && !problem; i++) {
        const Drain *drain = &world->sinks.slot[i];
        const pbmpm_shape moved = shifted(shift, &drain->shape);
        if (drain->generation != 0) problem = drain_problem(&drain->def, &moved, d);
    }
    for (uint32_t i = 0; i < world->forces.used && !problem; i++) {
        const Force *force = &world->forces.slot[i];
        const pbmpm_shape moved = shifted(shift, &force->shape);
        if (force->generation != 0) problem = force_problem(&force->def, &moved, d);
    }
    return problem;
}

static const char *shift_problem(const World *world, const Shift *shift)
{
    const pbmpm_world_def def = shifted_def(shift, &world->def);
    const pbmpm_kill_bounds bounds = shifted_bounds(shift, &world->sinks.bounds);
    const char *problem = world_def_problem(&def);
    if (!problem) problem = kill_bounds_problem(&bounds, shift->dimension);
    if (!problem) problem = things_problem(world, shift);
    return problem ? problem : particles_problem(world, shift);
}

/* ---- Moving ---- */

static void move_domain(World *world, const Shift *shift)
{
    world->def = shifted_def(shift, &world->def);
    for (int place = 0; place < 2 * shift->dimension; place++) {
        const pbmpm_domain_wall wall = world->domain.wall[place];
        domain_set_wall(&world->domain, &world->def, place, &wall);
    }
    world->sinks.bounds = shifted_bounds(shift, &world->sinks.bounds);
}

static void move_things(World *world, const Shift *shift)
{
    for (uint32_t i = 0; i < world->colliders.used; i++) {
        shift_point(shift, world->colliders.slot[i].shape.position);
        shift_point(shift, world->colliders.slot[i].target_position);
        FreeBody *body = world->colliders.slot[i].body;
        for (int a = 0; a < shift->dimension && body; a++) {
            body->centre[a] -= shift->by[a];
            body->begins[a] -= shift->by[a];
        }
    }
    for (uint32_t i = 0; i < world->emitters.used; i++) {
        shift_point(shift, world->emitters.slot[i].shape.position);
        shift_point(shift, world->emitters.slot[i].target_position);
    }
    for (uint32_t i = 0; i < world->sinks.used; i++) {
        Drain *drain = &world->sinks.slot[i];
        const pbmpm_shape moved = shifted(shift, &drain->shape);
        if (drain->generation != 0) drain_set(drain, &drain->def, &moved, shift->dimension);
    }
    for (uint32_t i = 0; i < world->forces.used; i++) {
        Force *force = &world->forces.slot[i];
        const pbmpm_shape moved = shifted(shift, &force->shape);
        if (force->generation != 0) force_set(force, &force->def, &moved, shift->dimension);
    }
    impulses_shift(&world->colliders.impulses, shift->by);
    for (uint32_t i = 0; i < world->events.count; i++) shift_point(shift, world->events.list[i].position);
}

static void move_particles(World *world, const Shift *shift)
{
    Particles *p = &world->particles;
    for (int a = 0; a < shift->dimension; a++)
        for (uint32_t row = 0; row < p->count; row++) p->cell[a][row] -= shift->cells[a];
    particles_changed(p);
}

static void move_sleeping(SleepList *list, const Shift *shift)
{
    for (uint32_t i = 0; i < list->count; i++)
        for (int a = 0; a < shift->dimension; a++) sleep_list_block(list, i)->place[a] -= shift->cells[a] / SHIFT_CELLS;
    if (list->count > 0) sleep_list_index(list);
}

pbmpm_result origin_shift(World *world, const double wanted[3], double moved[3])
{
    const double block = SHIFT_CELLS * (double)world->def.cell_size, most = 2.0 * PBMPM_MAX_CELL / SHIFT_CELLS;
    Shift shift = {.dimension = world->def.dimension};
    for (int a = 0; a < shift.dimension; a++) {
        const double blocks = round(wanted[a] / block);
        if (!in_range(blocks, -most, most)) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "a shift must be finite and at most 2^23 cells along each axis");
        shift.cells[a] = (int32_t)blocks * SHIFT_CELLS;
        shift.by[a] = blocks * block + 0.0; /* no -0 */
    }
    const char *problem = shift_problem(world, &shift);
    if (problem) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "after the shift: %s", problem);
    move_domain(world, &shift);
    move_things(world, &shift);
    move_particles(world, &shift);
    stirred_shift(world, shift.by);
    move_sleeping(&world->sleep.asleep, &shift);
    move_sleeping(&world->sleep.active, &shift);
    grid_clear(&world->grid);
    world->islands.groups = 0;
    world_expire_views(world);
    memcpy(moved, shift.by, sizeof shift.by);
    return PBMPM_OK;
}
