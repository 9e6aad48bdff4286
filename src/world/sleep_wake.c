#include "world/sleep_wake.h"

#include <math.h>

const double SLEEP_FELT = 2.0;

/* A call that touches a block that is awake keeps it so for another sleep_time. */
static void wake(Sleep *sleep, SleepBlock *block)
{
    if (!block) return;
    block->quiet = 0.0f;
    block->disturbed = 1;
    if (block->stage == SLEEP_AWAKE || block->woken) return;
    block->woken = 1;
    sleep->woken_blocks++;
    sleep->stirred = true;
}

typedef bool WakeTest(const World *world, const SleepBlock *block, const void *context);

static void wake_where(World *world, WakeTest *test, const void *context)
{
    SleepList *lists[] = {&world->sleep.asleep, &world->sleep.active};
    for (int l = 0; l < 2 && world->sleep.on; l++) {
        for (uint32_t i = 0; i < lists[l]->count; i++) {
            SleepBlock *block = sleep_list_block(lists[l], i);
            if (test(world, block, context)) wake(&world->sleep, block);
        }
    }
}

static bool always(const World *world, const SleepBlock *block, const void *context)
{
    (void)world;
    (void)block;
    (void)context;
    return true;
}

void sleep_wake_all(World *world) { wake_where(world, always, NULL); }

void sleep_wake_row(World *world, uint32_t row)
{
    Sleep *sleep = &world->sleep;
    if (!sleep->on) return;
    int32_t cell[3] = {0}, place[3];
    for (int a = 0; a < world->def.dimension; a++) cell[a] = world->particles.cell[a][row];
    sleep_place(sleep, cell, world->def.dimension, place);
    wake(sleep, sleep_list_find(&sleep->asleep, place));
    wake(sleep, sleep_list_find(&sleep->active, place));
}

/* The middle of a block [m], and how far its particles are from it at most. */
static double around(const World *world, const int32_t place[3], double centre[3])
{
    const double dx = (double)world->def.cell_size;
    for (int a = 0; a < 3; a++)
        centre[a] = a < world->def.dimension ? dx * (world->sleep.phase[a] + place[a] * K_BLOCK_AXIS + 0.5 * (K_BLOCK_AXIS - 1)) : 0.0;
    return dx * 0.5 * K_BLOCK_AXIS * sqrt((double)world->def.dimension);
}

typedef struct NearSolid {
    const Solid *solid;
    double reach; /* [m] */
} NearSolid;

static bool is_near(const World *world, const SleepBlock *block, const void *context)
{
    const NearSolid *near = context;
    double centre[3];
    const double radius = around(world, block->place, centre);
    return solid_least(near->solid, centre) <= radius + near->reach;
}

void sleep_wake_near(World *world, const Solid *solid, double reach)
{
    const NearSolid near = {solid, reach * (double)world->def.cell_size};
    wake_where(world, is_near, &near);
}

/* A collider on its way from start to end may pass between blocks that are far from both. */
static bool is_on_way(const World *world, const SleepBlock *block, const void *context)
{
    const Obstacle *o = context;
    const double dx = (double)world->def.cell_size;
    double centre[3], way = 0.0;
    float motion[3];
    const double radius = around(world, block->place, centre);
    obstacle_motion(o, centre, dx, (float)PBMPM_MAX_CELL, motion);
    for (int a = 0; a < 3; a++) way += (double)motion[a] * (double)motion[a];
    const double nearest = fmin(solid_least(&o->start, centre), solid_least(&o->end, centre));
    return nearest <= radius + (SLEEP_FELT + sqrt(way)) * dx;
}

/* Whether a force takes matter along. */
static bool carries(const Force *force)
{
    const pbmpm_force_def *def = &force->def;
    const float *v = def->velocity;
    return force->generation != 0 && def->enabled && def->kind == PBMPM_FORCE_GRAB && !def->everywhere && (v[0] != 0.0f || v[1] != 0.0f || v[2] != 0.0f || def->spin != 0.0f);
}

void sleep_begin_substep(World *world, int part)
{
    const Colliders *colliders = &world->colliders;
    if (world->sleep.asleep.count + world->sleep.active.count == 0) return;
    for (uint32_t slot = 0; slot < world->forces.used; slot++)
        if (carries(&world->forces.slot[slot])) sleep_wake_near(world, &world->forces.slot[slot].solid, 0.0);
    for (uint32_t slot = 0; slot < colliders->used; slot++) {
        if (!collider_moves(&colliders->slot[slot]) || !world_feels(world, &colliders->slot[slot])) continue;
        const Obstacle o = collider_obstacle(&colliders->slot[slot], world->def.dimension, part, world->settings.substeps);
        wake_where(world, is_on_way, &o);
    }
}

/* A load that is measured is that of matter in the solution. */
bool sleep_is_measured(const World *world, const int32_t place[3])
{
    const double dx = (double)world->def.cell_size;
    const Colliders *colliders = &world->colliders;
    double centre[3];
    const double reach = around(world, place, centre) + SLEEP_FELT * dx;
    for (uint32_t slot = 0; slot < colliders->used; slot++) {
        const Collider *collider = &colliders->slot[slot];
        if (!collider->def.measures_impulse || !world_feels(world, collider)) continue;
        const Obstacle o = collider_obstacle(collider, world->def.dimension, 0, 1);
        if (solid_least(&o.start, centre) <= reach) return true;
    }
    for (int a = 0; a < world->def.dimension && world->domain.measures; a++)
        if (centre[a] - world->domain.low[a] <= reach || world->domain.high[a] - centre[a] <= reach) return true;
    return false;
}
