/* Gaps that know what the nodes carry.
 *
 * A node feels matter up to 3/2 cells away, so nodes at the surface of an obstacle carry some that has not reached it. Held at the surface they would stop
 * a body before it arrives, and make a ball stand on a patch three cells wide, which does not roll. So a node may sink by the least room
 * that a particle which feels it has left: no particle comes closer than its own radius then, for each of its nodes allows no more. */
#include <float.h>
#include <math.h>

#include "holds.h"
#include "primal_solve.h"

static const double RADIUS = 0.25; /* [cells] of a particle, with two per cell and axis as fill() puts them */
static const double FAR = 2.5;     /* [cells]: particles with more room than nodes are ever given are not looked at */
static const double CELL_REACH = 0.87; /* [cells]: half the diagonal of a cell, rounded up */

enum { TILE = K_TILE_AXIS, BLOCK = K_BLOCK_AXIS };

typedef struct GapJob {
    Primal *p;
    float *tile; /* per particle block and tile node: the least room */
    size_t stride;
} GapJob;

/* [cells], to the nearest obstacle that is not farther than FAR. */
static double room_at(const ContactFrame *frame, const double point[3])
{
    double least = FAR, normal[3];
    for (int i = 0; i < frame->colliders->obstacle_count; i++) {
        const Solid *solid = &frame->colliders->obstacle[i].start;
        if (solid->grid && solid_least(solid, point) / frame->cell_size > least) continue;
        least = fmin(least, solid_distance(solid, point, normal) / frame->cell_size);
    }
    return least;
}

static void lower(const GapJob *job, int32_t block, uint32_t cell, float room)
{
    const int dimension = job->p->world->grid.dimension;
    float *tile = job->tile + (size_t)block * job->stride;
    const uint32_t x = cell & 3, y = cell >> 2 & 3, z = cell >> 4;
    for (uint32_t k = 0; k < (dimension == 3 ? 3u : 1u); k++)
        for (uint32_t j = 0; j < 3; j++)
            for (uint32_t i = 0; i < 3; i++) {
                float *least = tile + ((z + k) * TILE + y + j) * TILE + x + i;
                *least = fminf(*least, room);
            }
}

/* The least room of the particles of a run: of one cell. */
static float room_of_run(const Primal *p, uint32_t run, double cell_size)
{
    const Grid *grid = &p->world->grid;
    const Particles *particles = &p->world->particles;
    double least = FAR, point[3] = {0};
    const uint32_t first = grid->run_begin[run];
    for (int a = 0; a < grid->dimension; a++) point[a] = (double)particles->cell[a][first] * cell_size;
    if (room_at(p->contacts, point) > FAR - CELL_REACH) return (float)FAR;
    for (uint32_t row = first; row < grid->run_begin[run + 1]; row++) {
        for (int a = 0; a < grid->dimension; a++) point[a] = ((double)particles->cell[a][row] + (double)particles->fraction[a][row]) * cell_size;
        least = fmin(least, room_at(p->contacts, point));
    }
    return (float)fmax(0.0, least - RADIUS);
}

static bool any_contact(const Primal *p, int32_t block)
{
    const Grid *grid = &p->world->grid;
    const int32_t *neighbour = (const int32_t *)grid->neighbour.data + (size_t)block * (size_t)grid->neighbours;
    for (int n = 0; n < grid->neighbours; n++)
        if (neighbour[n] >= 0 && holds_contacts(p->contacts, neighbour[n]) > 0) return true;
    return false;
}

static void measure_blocks(void *context, int32_t begin, int32_t end)
{
    const GapJob *job = context;
    const Grid *grid = &job->p->world->grid;
    const uint32_t *block_run = grid->block_run.data;
    for (int32_t block = begin; block < end; block++) {
        float *tile = job->tile + (size_t)block * job->stride;
        for (int i = 0; i < grid->tile_nodes; i++) tile[i] = FLT_MAX;
        if (!any_contact(job->p, block)) continue;
        for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++)
            lower(job, block, grid->run_key[run] & K_RUN_CELL_MASK, room_of_run(job->p, run, job->p->contacts->cell_size));
    }
}

/* Of a node of a block, from the tiles that overlap it. */
static float least_at(const GapJob *job, int32_t block, int node)
{
    const Grid *grid = &job->p->world->grid;
    const int32_t *neighbour = (const int32_t *)grid->neighbour.data + (size_t)block * (size_t)grid->neighbours;
    const int local[3] = {node & 3, node >> 2 & 3, node >> 4};
    float least = FLT_MAX;
    for (int n = 0; n < grid->neighbours; n++) {
        int32_t offset[3];
        int at[3] = {0, 0, 0};
        bool inside = neighbour[n] >= 0 && neighbour[n] < grid->particle_blocks;
        grid_neighbour_offset(n, grid->dimension, offset);
        for (int a = 0; a < grid->dimension; a++) {
            at[a] = local[a] - BLOCK * (int)offset[a] + 1; /* a tile begins one node before its block */
            inside = inside && at[a] >= 0 && at[a] < TILE;
        }
        if (inside) least = fminf(least, job->tile[(size_t)neighbour[n] * job->stride + (size_t)((at[2] * TILE + at[1]) * TILE + at[0])]);
    }
    return least;
}

static void widen_blocks(void *context, int32_t begin, int32_t end)
{
    const GapJob *job = context;
    const Primal *p = job->p;
    const Colliders *colliders = p->contacts->colliders;
    const uint32_t *contact_begin = colliders->contact_begin.data;
    for (int32_t block = begin; block < end; block++) {
        if (primal_body_of(p, block)->with_liquid) continue;
        for (uint32_t i = contact_begin[block]; i < contact_begin[block + 1]; i++) {
            Contact *contact = (Contact *)colliders->contact.data + i;
            if (holds_whole(contact)) continue;
            const float room = least_at(job, block, contact->node);
            if (room < (float)FAR) contact->gap = fmaxf(contact->gap, room);
        }
    }
}

void primal_widen_gaps(Primal *p)
{
    World *world = p->world;
    GapJob job = {p, world->grid.tile.data, (size_t)world->grid.tile_nodes * W + K_TILE_PAD};
    if (p->contacts->colliders->contacts == 0 || p->contacts->colliders->obstacle_count == 0) return;
    pool_for(world->pool, world->grid.particle_blocks, 4, measure_blocks, &job);
    pool_for(world->pool, world->grid.node_blocks, 8, widen_blocks, &job);
}
