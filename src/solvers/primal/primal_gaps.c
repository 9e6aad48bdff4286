/* Gaps that know what the nodes carry.
 *
 * A node feels matter up to 3/2 cells away, so nodes at the surface of an obstacle carry some that has not reached it. Held at the surface they would stop
 * a body before it arrives, and make a ball stand on a patch three cells wide, which does not roll. So a node may sink by the least room
 * that a particle which feels it has left: no particle comes closer than its own radius then, for each of its nodes allows no more.
 *
 * Sand has no more room than its nodes: neither do they in the dual solver, which hands flowing sand over once it rests (granular.h). With room that the dual does not
 * know, heaps spread into their walls by a quarter of a cell then, at 35 mm/s, and went on to creep. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "contact/contact_constraints.h"
#include "solvers/primal/primal_solve.h"

static const double RADIUS = 0.25; /* [cells] of a particle, with two per cell and axis as fill() puts them; who has that much more room than the nearest is not at the surface */
static const double FAR = 2.5;     /* [cells]: particles with more room than nodes are ever given are not looked at */
static const double CELL_REACH = 0.87; /* [cells]: half the diagonal of a cell, rounded up */

enum { TILE = K_TILE_AXIS, BLOCK = K_BLOCK_AXIS };

typedef struct GapJob {
    Primal *p;
    float *tile;  /* per particle block and tile node: the least room; then sums of weights and of weights times rooms */
    float *least; /* per node */
    size_t stride;
} GapJob;

/* [cells], to the nearest obstacle that is not farther than FAR. */
static double room_at(const ContactFrame *frame, const double point[3], uint32_t groups)
{
    double least = FAR;
    for (int i = 0; i < frame->colliders->obstacle_count; i++) {
        const Solid *solid = &frame->colliders->obstacle[i].start;
        if (!obstacle_meets(&frame->colliders->obstacle[i], groups)) continue;
        if (solid->grid && solid_least(solid, point) / frame->cell_size > least) continue;
        least = fmin(least, solid_gap(solid, point) / frame->cell_size);
    }
    return least;
}

static float weight_at(float f, int i)
{
    const float below = 0.5f - f, above = 0.5f + f;
    return i == 0 ? 0.5f * below * below : (i == 1 ? 0.75f - f * f : 0.5f * above * above);
}

static float *rooms_of(const Primal *p) { return particles_spare(&p->world->particles, CLASS_SCALAR, 0); }

/* Notes the rooms of the particles of a run, which is of one cell; false: all are far. */
static bool measure_run(const Primal *p, uint32_t run)
{
    const Grid *grid = &p->world->grid;
    const Particles *particles = &p->world->particles;
    const double cell_size = p->contacts->cell_size;
    const uint32_t first = grid->run_begin[run], groups = contacts_row_groups(p->contacts, particles, first);
    const bool sand = p->world->materials.kernel[grid->run_key[run] >> K_RUN_CELL_BITS].yields == K_SAND;
    float *room = rooms_of(p);
    double point[3] = {0};
    for (int a = 0; a < grid->dimension; a++) point[a] = (double)particles->cell[a][first] * cell_size;
    room[first] = (float)FAR;
    if (room_at(p->contacts, point, groups) > FAR - CELL_REACH) return false;
    for (uint32_t row = first; row < grid->run_begin[run + 1] && sand; row++) room[row] = 0.0f;
    if (sand) return true;
    for (uint32_t row = first; row < grid->run_begin[run + 1]; row++) {
        for (int a = 0; a < grid->dimension; a++) point[a] = ((double)particles->cell[a][row] + (double)particles->fraction[a][row]) * cell_size;
        room[row] = (float)(room_at(p->contacts, point, groups) - RADIUS);
    }
    return true;
}

static bool any_contact(const Primal *p, int32_t block)
{
    const Grid *grid = &p->world->grid;
    const int32_t *neighbour = (const int32_t *)grid->neighbour.data + (size_t)block * (size_t)grid->neighbours;
    for (int n = 0; n < grid->neighbours; n++)
        if (neighbour[n] >= 0 && constraints_count(p->contacts, neighbour[n]) > 0) return true;
    return false;
}

/* Where a run's stencil begins in a tile. */
static int corner_of_run(const Grid *grid, uint32_t run)
{
    const int cell = (int)(grid->run_key[run] & K_RUN_CELL_MASK);
    return ((cell >> 4) * TILE + (cell >> 2 & 3)) * TILE + (cell & 3);
}

static void measure_blocks(void *context, int32_t begin, int32_t end)
{
    const GapJob *job = context;
    const Grid *grid = &job->p->world->grid;
    const uint32_t *block_run = grid->block_run.data;
    const float *room = rooms_of(job->p);
    const int layers = grid->dimension == 3 ? 3 : 1;
    for (int32_t block = begin; block < end; block++) {
        float *tile = job->tile + (size_t)block * job->stride;
        for (int i = 0; i < grid->tile_nodes; i++) tile[i] = FLT_MAX;
        if (!any_contact(job->p, block)) continue;
        for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++) {
            if (!measure_run(job->p, run)) continue;
            float least = FLT_MAX, *corner = tile + corner_of_run(grid, run);
            for (uint32_t row = grid->run_begin[run]; row < grid->run_begin[run + 1]; row++) least = fminf(least, room[row]);
            for (int i = 0; i < 9 * layers; i++) {
                float *node = corner + ((i / 9) * TILE + i / 3 % 3) * TILE + i % 3;
                *node = fminf(*node, least);
            }
        }
    }
}

/* Of a node of a block, from the tiles that overlap it. */
static void gather_at(const GapJob *job, int32_t block, int node, int width, float value[2])
{
    const Grid *grid = &job->p->world->grid;
    const int32_t *neighbour = (const int32_t *)grid->neighbour.data + (size_t)block * (size_t)grid->neighbours;
    const int local[3] = {node & 3, node >> 2 & 3, node >> 4};
    int low[3] = {0, 0, 0}, high[3] = {0, 0, 0};
    for (int a = 0; a < grid->dimension; a++) {
        low[a] = local[a] == 0 ? -1 : 0; /* the next block's tile reaches one node into this one */
        high[a] = local[a] == BLOCK - 1 ? 1 : 0;
    }
    for (int z = low[2]; z <= high[2]; z++)
        for (int y = low[1]; y <= high[1]; y++)
            for (int x = low[0]; x <= high[0]; x++) {
                const int32_t there = neighbour[grid->dimension == 3 ? ((z + 1) * 3 + y + 1) * 3 + x + 1 : (y + 1) * 3 + x + 1];
                if (there < 0 || there >= grid->particle_blocks) continue;
                const int tz = grid->dimension == 3 ? local[2] - BLOCK * z + 1 : 0;
                const int at = (tz * TILE + local[1] - BLOCK * y + 1) * TILE + local[0] - BLOCK * x + 1;
                const float *from = job->tile + (size_t)there * job->stride + (size_t)(width * at);
                if (width == 1) value[0] = fminf(value[0], from[0]);
                for (int k = 0; k < width && width == 2; k++) value[k] += from[k];
            }
}

/* NONE: no contact asks for it. */
static const float NONE = -1e30f;

static void gather_least(void *context, int32_t begin, int32_t end)
{
    const GapJob *job = context;
    const Grid *grid = &job->p->world->grid;
    const Colliders *colliders = job->p->contacts->colliders;
    const uint32_t *contact_begin = colliders->contact_begin.data;
    for (int32_t block = begin; block < end; block++) {
        float *least = job->least + (size_t)block * (size_t)grid->block_cells;
        for (int i = 0; i < grid->block_cells; i++) least[i] = NONE;
        for (uint32_t i = contact_begin[block]; i < contact_begin[block + 1]; i++) {
            const int node = ((const Contact *)colliders->contact.data)[i].node;
            float value[2] = {FLT_MAX, 0.0f};
            if (least[node] != NONE) continue;
            gather_at(job, block, node, 1, value);
            least[node] = value[0];
        }
    }
}

/* The least room of a tile node of a particle block. */
static float least_of(const GapJob *job, int32_t block, int x, int y, int z)
{
    const Grid *grid = &job->p->world->grid;
    const int at[3] = {x - 1, y - 1, z - 1};
    int n = 0, node = 0;
    for (int a = grid->dimension - 1; a >= 0; a--) {
        const int side = at[a] < 0 ? 0 : (at[a] < BLOCK ? 1 : 2);
        n = 3 * n + side;
        node = BLOCK * node + at[a] - BLOCK * (side - 1);
    }
    const int32_t there = ((const int32_t *)grid->neighbour.data)[(ptrdiff_t)block * grid->neighbours + n];
    return there < 0 ? NONE : job->least[(ptrdiff_t)there * grid->block_cells + node];
}

static void spread_run(const GapJob *job, int32_t block, uint32_t run, float *tile)
{
    const Grid *grid = &job->p->world->grid;
    const Particles *particles = &job->p->world->particles;
    const float *room = rooms_of(job->p);
    const int cell = (int)(grid->run_key[run] & K_RUN_CELL_MASK), layers = grid->dimension == 3 ? 3 : 1, corner = corner_of_run(grid, run);
    float least[27], sums[27][2];
    bool any = false;
    for (int i = 0; i < 9 * layers; i++) {
        least[i] = least_of(job, block, (cell & 3) + i % 3, (cell >> 2 & 3) + i / 3 % 3, layers == 3 ? (cell >> 4) + i / 9 : 1);
        any = any || least[i] != NONE;
        sums[i][0] = sums[i][1] = 0.0f;
    }
    for (uint32_t row = grid->run_begin[run]; row < grid->run_begin[run + 1] && any; row++) {
        float w[3][3] = {{1.0f, 1.0f, 1.0f}, {1.0f, 1.0f, 1.0f}, {1.0f, 1.0f, 1.0f}};
        for (int a = 0; a < grid->dimension; a++)
            for (int i = 0; i < 3; i++) w[a][i] = weight_at(particles->fraction[a][row], i);
        for (int i = 0; i < 9 * layers; i++) {
            const float near = 2.0f - (room[row] - least[i]) * (float)(1.0 / RADIUS), share = w[0][i % 3] * w[1][i / 3 % 3] * w[2][i / 9] * (near > 1.0f ? 1.0f : (near > 0.0f ? near : 0.0f));
            sums[i][0] += share;
            sums[i][1] += share * room[row];
        }
    }
    for (int i = 0; i < 9 * layers && any; i++) {
        float *sum = tile + 2 * (corner + ((i / 9) * TILE + i / 3 % 3) * TILE + i % 3);
        sum[0] += sums[i][0];
        sum[1] += sums[i][1];
    }
}

static void spread_blocks(void *context, int32_t begin, int32_t end)
{
    const GapJob *job = context;
    const Grid *grid = &job->p->world->grid;
    const uint32_t *block_run = grid->block_run.data;
    for (int32_t block = begin; block < end; block++) {
        float *tile = job->tile + (size_t)block * job->stride;
        memset(tile, 0, 2 * (size_t)grid->tile_nodes * sizeof *tile);
        if (!any_contact(job->p, block)) continue;
        for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++)
            if (rooms_of(job->p)[grid->run_begin[run]] < (float)FAR) spread_run(job, block, run, tile);
    }
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
            float sum[2] = {0.0f, 0.0f};
            if (constraints_stick(contact)) continue;
            gather_at(job, block, contact->node, 2, sum);
            if (sum[0] > 0.0f) contact->gap = fmaxf(contact->gap, sum[1] / sum[0]);
        }
    }
}

void primal_widen_gaps(Primal *p)
{
    World *world = p->world;
    const GapJob job = {p, world->grid.tile.data, p->force, (size_t)world->grid.tile_nodes * W + K_TILE_PAD};
    if (p->contacts->colliders->contacts == 0 || p->contacts->colliders->obstacle_count == 0) return;
    Loops loops;
    loops_open(&loops, world->pool);
    LOOPS_ADD(&loops, grid_rows(&world->grid, 4), measure_blocks, &job);
    LOOPS_ADD(&loops, grid_nodes(&world->grid, 8), gather_least, &job);
    LOOPS_ADD(&loops, grid_rows(&world->grid, 4), spread_blocks, &job);
    LOOPS_ADD(&loops, grid_nodes(&world->grid, 8), widen_blocks, &job);
    loops_run(&loops);
}
