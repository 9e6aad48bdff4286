#include "step/draining.h"

#include <math.h>

#include "world/sleep_rows.h"

/* A ball around all particles of a block [m]: where they were when the grid was built, what they have moved since, and what
 * obstacles pushed them back by, which is no more than that, or a cell. */
typedef struct Around {
    double centre[3], radius;
} Around;

static Around around_block(const World *world, int32_t block)
{
    const Grid *grid = &world->grid;
    const int32_t *corner = (const int32_t *)grid->coordinate.data + 3 * block;
    const double dx = (double)world->def.cell_size, travel = (double)((const float *)grid->travel.data)[block];
    Around around = {.radius = dx * (0.5 * K_BLOCK_AXIS * sqrt((double)grid->dimension) + 2.0 * travel + 1.0)};
    for (int a = 0; a < grid->dimension; a++) /* the cell of a node reaches half a cell to either side of it */
        around.centre[a] = dx * ((double)(grid->anchor[a] + corner[a] * K_BLOCK_AXIS) + 0.5 * (K_BLOCK_AXIS - 1));
    return around;
}

/* The particles of a flight lie anywhere. */
static bool is_block(const World *world, int32_t block) { return block < world->grid.particle_blocks; }

static void place_of(const World *world, uint32_t row, double point[3])
{
    for (int a = 0; a < 3; a++)
        point[a] = a < world->def.dimension ? particles_coordinate(&world->particles, row, a) * (double)world->def.cell_size : 0.0;
}

static bool takes(const World *world, const Drain *drain, uint32_t row)
{
    const pbmpm_material_id wanted = drain->def.material;
    return wanted.generation == 0 ||
           (wanted.index == world->particles.material[row] && material_is_live(&world->materials, wanted));
}

static uint32_t drain_block(World *world, Drain *drain, int32_t block)
{
    Particles *p = &world->particles;
    const uint32_t *begin = world->grid.block_begin.data;
    double mass = 0.0;
    uint32_t count = 0;
    if (is_block(world, block)) {
        const Around around = around_block(world, block);
        if (solid_gap(&drain->solid, around.centre) > around.radius) return 0;
    }
    for (uint32_t row = begin[block]; row < begin[block + 1]; row++) {
        double point[3];
        if (p->status[row] != K_ALIVE || !takes(world, drain, row)) continue;
        place_of(world, row, point);
        if (solid_gap(&drain->solid, point) > 0.0) continue;
        p->status[row] = K_REMOVED;
        mass += (double)p->mass[row];
        count++;
    }
    drain->drained += count;
    drain->drained_mass += mass * world_cell_volume(world);
    world->flow.drained += count;
    world->flow.drained_mass += mass * world_cell_volume(world);
    return count;
}

static bool inside(const World *world, const double point[3], double margin)
{
    const pbmpm_kill_bounds *bounds = &world->sinks.bounds;
    for (int a = 0; a < world->def.dimension; a++)
        if (point[a] - margin < (double)bounds->low[a] || point[a] + margin > (double)bounds->high[a]) return false;
    return true;
}

/* Adds to `event`, which becomes that of the first particle. */
static uint32_t kill_in_block(World *world, int32_t block, pbmpm_event *event)
{
    Particles *p = &world->particles;
    const uint32_t *begin = world->grid.block_begin.data;
    uint32_t count = 0;
    if (is_block(world, block)) {
        const Around around = around_block(world, block);
        if (inside(world, around.centre, around.radius)) return 0;
    }
    for (uint32_t row = begin[block]; row < begin[block + 1]; row++) {
        double point[3];
        place_of(world, row, point);
        if (p->status[row] != K_ALIVE || inside(world, point, 0.0)) continue;
        if (event->count == 0 && count == 0) {
            event->particle = p->id[row];
            for (int a = 0; a < 3; a++) event->position[a] = (float)point[a];
        }
        p->status[row] = K_REMOVED;
        world->flow.killed_mass += (double)p->mass[row] * world_cell_volume(world);
        count++;
    }
    event->count += count;
    return count;
}

uint32_t sinks_mark(World *world, uint32_t substep)
{
    Sinks *sinks = &world->sinks;
    uint32_t count = 0;
    for (uint32_t slot = 0; slot < sinks->used; slot++) {
        Drain *drain = &sinks->slot[slot];
        if (drain->generation == 0 || !drain->def.enabled) continue;
        for (int32_t block = 0; block < grid_row_blocks(&world->grid); block++)
            if (!sleep_is_still(world, block)) count += drain_block(world, drain, block);
    }
    if (!sinks->bounds.enabled) return count;
    pbmpm_event event = {.kind = PBMPM_EVENT_KILLED, .substep = substep, .step = world->step_count};
    for (int32_t block = 0; block < grid_row_blocks(&world->grid); block++)
        if (!sleep_is_still(world, block)) count += kill_in_block(world, block, &event);
    world->flow.killed += event.count;
    if (event.count) events_add(&world->events, &event);
    return count;
}
