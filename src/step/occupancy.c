#include "step/occupancy.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "contact/open_volume.h"

double occupancy_nodes(const Occupancy *occupancy) { return (double)occupancy->size[0] * (double)occupancy->size[1] * (double)occupancy->size[2]; }

/* Quadratic B-spline weights of the nodes below, at and above the nearest; f in [-1/2, 1/2). */
static void weights_of(double f, double w[3])
{
    w[0] = 0.5 * (0.5 - f) * (0.5 - f);
    w[1] = 0.75 - f * f;
    w[2] = 0.5 * (0.5 + f) * (0.5 + f);
}

/* False: some node that it touches is not among those of the occupancy. `place` in cells. */
bool occupancy_find(const Occupancy *occupancy, int dimension, const double place[3], Spot *spot)
{
    size_t stride = 1;
    *spot = (Spot){.w = {[2] = {1.0, 0.0, 0.0}}};
    for (int a = 0; a < dimension; a++) {
        const double node = floor(place[a] + 0.5);
        const double first = node - 1.0 - occupancy->low[a];
        if (first < 0.0 || first + 3.0 > occupancy->size[a]) return false;
        weights_of(place[a] - node, spot->w[a]);
        spot->corner += (size_t)first * stride;
        stride *= (size_t)occupancy->size[a];
    }
    return true;
}

static size_t spot_node(const Occupancy *occupancy, const Spot *spot, int i, int j, int k)
{
    return spot->corner + (size_t)i + (size_t)occupancy->size[0] * ((size_t)j + (size_t)occupancy->size[1] * (size_t)k);
}

void occupancy_add(Occupancy *occupancy, int dimension, const Spot *spot, double volume)
{
    for (int k = 0; k < (dimension == 3 ? 3 : 1); k++)
        for (int j = 0; j < 3; j++)
            for (int i = 0; i < 3; i++)
                occupancy->volume[spot_node(occupancy, spot, i, j, k)] += (float)(volume * spot->w[0][i] * spot->w[1][j] * spot->w[2][k]);
    occupancy->held += volume;
}

/* Adds the particles of the rows [begin, end). */
static void measure_rows(const World *world, Occupancy *occupancy, uint32_t begin, uint32_t end)
{
    const Particles *p = &world->particles;
    for (uint32_t row = begin; row < end; row++) {
        bool near = true;
        for (int a = 0; a < p->dimension; a++) {
            const int32_t from_low = p->cell[a][row] - occupancy->low[a];
            near = near && from_low >= 1 && from_low < occupancy->size[a] - 1;
        }
        double place[3] = {0};
        Spot spot;
        if (!near) continue;
        for (int a = 0; a < p->dimension; a++) place[a] = particles_coordinate(p, row, a);
        if (!occupancy_find(occupancy, p->dimension, place, &spot)) continue;
        occupancy_add(occupancy, p->dimension, &spot, (double)(p->mass[row] * world->materials.kernel[p->material[row]].inverse_density));
    }
}

/* Whether a block that is asleep can touch the nodes. */
static bool is_block_near(const World *world, const Occupancy *occupancy, const SleepBlock *block)
{
    for (int a = 0; a < world->def.dimension; a++) {
        const int32_t first = block->place[a] * K_BLOCK_AXIS + world->sleep.phase[a] - occupancy->low[a];
        if (first + K_BLOCK_AXIS <= 1 || first >= occupancy->size[a] - 1) return false;
    }
    return true;
}

static void node_place(const World *world, const int32_t node[3], double place[3])
{
    for (int a = 0; a < 3; a++) place[a] = a < world->def.dimension ? node[a] * (double)world->def.cell_size : 0.0;
}

static double open_share_of(const World *world, uint32_t groups, const int32_t node[3])
{
    double place[3];
    node_place(world, node, place);
    const ContactFrame frame = {.colliders = (Colliders *)(uintptr_t)&world->colliders, .grid = &world->grid, .cell_size = (double)world->def.cell_size};
    return open_share_at(&frame, place, groups);
}

/* Farther inside of an obstacle than this [cells] a node has no room, and open_share_at() says no more than that it is small. */
static const double CLOSED = 1.001;

static double room_at(const World *world, uint32_t groups, const int32_t node[3])
{
    double point[3], normal[3];
    node_place(world, node, point);
    for (int i = 0; i < world->colliders.obstacle_count; i++) {
        const Obstacle *o = &world->colliders.obstacle[i];
        if (obstacle_meets(o, groups) && obstacle_distance(o, point, normal) < -CLOSED * (double)world->def.cell_size) return 0.0;
    }
    return open_share_of(world, groups, node);
}

/* The volume that obstacles leave open if they enclose it: whatever the gaps between particles look like, more does not fit. The outermost two nodes to
 * each side do not know all of their particles and are left out; where one of the next is open, so is the room. */
static double room_of(const World *world, const Occupancy *occupancy)
{
    const int d = world->def.dimension;
    int32_t at[3] = {0}, first[3] = {0}, last[3] = {0};
    double room = 0.0;
    for (int a = 0; a < d; a++) {
        first[a] = 2;
        last[a] = occupancy->size[a] - 3;
    }
    for (at[2] = first[2]; at[2] <= last[2]; at[2]++)
        for (at[1] = first[1]; at[1] <= last[1]; at[1]++)
            for (at[0] = first[0]; at[0] <= last[0]; at[0]++) {
                int32_t node[3] = {0};
                bool outermost = false;
                for (int a = 0; a < d; a++) {
                    node[a] = occupancy->low[a] + at[a];
                    outermost = outermost || at[a] == first[a] || at[a] == last[a];
                }
                const double share = room_at(world, occupancy->groups, node);
                if (outermost && share > 0.0) return INFINITY;
                room += share;
            }
    return room;
}

void occupancy_measure(const World *world, Occupancy *occupancy)
{
    const SleepPiece *piece = world->sleep.piece.data;
    occupancy->held = 0.0;
    occupancy->room = world->colliders.obstacle_count > 0 ? room_of(world, occupancy) : INFINITY;
    memset(occupancy->volume, 0, (size_t)occupancy_nodes(occupancy) * sizeof(float));
    for (uint32_t i = 0; i < world->sleep.pieces; i++)
        if (is_block_near(world, occupancy, sleep_list_block(&world->sleep.asleep, piece[i].block)))
            measure_rows(world, occupancy, piece[i].begin, piece[i].begin + piece[i].count);
    measure_rows(world, occupancy, world->sleep.rows, world->particles.count);
}

/* How full the surroundings of a place are: rest volume per volume that obstacles leave open. Of the nodes up to OCCUPANCY_WIDE away, weighed by a tent:
 * where particles lie at random single nodes hold a tenth more or less, and matter that moves would let an emitter find
 * a gap for ever. Obstacles are looked at only if `walled`. */
double occupancy_filling(const World *world, const Occupancy *occupancy, const double place[3], bool walled)
{
    const int d = world->def.dimension, depth = d == 3 ? OCCUPANCY_WIDE : 0;
    double held = 0.0, open = 0.0;
    for (int k = -depth; k <= depth; k++)
        for (int j = -OCCUPANCY_WIDE; j <= OCCUPANCY_WIDE; j++)
            for (int i = -OCCUPANCY_WIDE; i <= OCCUPANCY_WIDE; i++) {
                const int offset[3] = {i, j, k};
                int32_t node[3] = {0};
                size_t at = 0, stride = 1;
                double weight = 1.0;
                for (int a = 0; a < d; a++) {
                    node[a] = (int32_t)floor(place[a] + 0.5) + offset[a];
                    at += (size_t)(node[a] - occupancy->low[a]) * stride;
                    stride *= (size_t)occupancy->size[a];
                    weight *= OCCUPANCY_WIDE + 1 - abs(offset[a]);
                }
                held += weight * (double)occupancy->volume[at];
                open += weight * (walled ? open_share_of(world, occupancy->groups, node) : 1.0);
            }
    return held / open;
}

/* How full the space is that matter takes around a place: the mean of what its nodes hold, each weighed with that, and by the same tent. What is empty beside a stream counts for nothing: of an even stream that is rho full
 * its middle measures rho and its edge 0.8 rho, where the mean over all nodes has half of it. */
double occupancy_crowding(const Occupancy *occupancy, int dimension, const double place[3])
{
    const int depth = dimension == 3 ? OCCUPANCY_WIDE : 0;
    double held = 0.0, square = 0.0;
    for (int k = -depth; k <= depth; k++)
        for (int j = -OCCUPANCY_WIDE; j <= OCCUPANCY_WIDE; j++)
            for (int i = -OCCUPANCY_WIDE; i <= OCCUPANCY_WIDE; i++) {
                const int offset[3] = {i, j, k};
                size_t at = 0, stride = 1;
                double weight = 1.0;
                for (int a = 0; a < dimension; a++) {
                    at += (size_t)((int32_t)floor(place[a] + 0.5) + offset[a] - occupancy->low[a]) * stride;
                    stride *= (size_t)occupancy->size[a];
                    weight *= OCCUPANCY_WIDE + 1 - abs(offset[a]);
                }
                const double volume = (double)occupancy->volume[at];
                held += weight * volume;
                square += weight * volume * volume;
            }
    return held > 0.0 ? square / held : 0.0;
}

/* Rest volume per volume of the nodes that a particle there touches, obstacles or not: particles shall not be put on top of each other. */
double occupancy_density(const Occupancy *occupancy, int dimension, const Spot *spot)
{
    double held = 0.0;
    for (int k = 0; k < (dimension == 3 ? 3 : 1); k++)
        for (int j = 0; j < 3; j++)
            for (int i = 0; i < 3; i++)
                held += spot->w[0][i] * spot->w[1][j] * spot->w[2][k] * (double)occupancy->volume[spot_node(occupancy, spot, i, j, k)];
    return held;
}

/* How near the next obstacle is [cells]; negative inside. */
double occupancy_clearance(const World *world, const Occupancy *occupancy, const double point[3])
{
    double nearest = INFINITY, normal[3];
    for (int i = 0; i < world->colliders.obstacle_count; i++) {
        const Obstacle *o = &world->colliders.obstacle[i];
        if (obstacle_meets(o, occupancy->groups)) nearest = fmin(nearest, obstacle_distance(o, point, normal));
    }
    return nearest / (double)world->def.cell_size;
}
