#include "mirror.h"

#include <math.h>
#include <string.h>

/* Two nodes, as indices of all nodes: `image` behind the wall, `real` as far before it. Both have the mass of what pairs before this one mirrored there, too. */
typedef struct MirrorPair {
    uint32_t image, real;
    float image_mass, real_mass;
} MirrorPair;

/* Twice the place of a wall of a mirror domain, in cells. */
static int32_t half_cells(const Domain *domain, double cell_size, int axis, int upper)
{
    return (int32_t)round(2.0 * (upper ? domain->high[axis] : domain->low[axis]) / cell_size);
}

Domain mirror_domain(const Domain *domain, int dimension, double cell_size)
{
    static const double SLACK = 2e-3; /* [half cells]: corners are given in single precision */
    Domain inside = *domain;
    for (int axis = 0; domain->enabled && axis < dimension; axis++) {
        inside.low[axis] = 0.5 * cell_size * ceil(2.0 * domain->low[axis] / cell_size - SLACK);
        inside.high[axis] = 0.5 * cell_size * floor(2.0 * domain->high[axis] / cell_size + SLACK);
    }
    return inside;
}

/* The node `way` cells from node `local` of a block along an axis, or -1 where it does not exist. */
static int64_t across(const Grid *grid, int32_t block, const int local[3], int axis, int way)
{
    int at[3] = {local[0], local[1], local[2]}, side[3] = {1, 1, grid->dimension == 3 ? 1 : 0};
    at[axis] += way;
    if (at[axis] < 0) side[axis] = 0;
    if (at[axis] >= K_BLOCK_AXIS) side[axis] = 2;
    at[axis] &= K_BLOCK_AXIS - 1;
    const int32_t *neighbour = (const int32_t *)grid->neighbour.data + (size_t)block * (size_t)grid->neighbours;
    const int32_t other = neighbour[(side[2] * 3 + side[1]) * 3 + side[0]];
    return other < 0 ? -1 : (int64_t)other * grid->block_cells + (at[2] * K_BLOCK_AXIS + at[1]) * K_BLOCK_AXIS + at[0];
}

/* Pairs of one block at one wall; writes them if `out` is not null, and returns their number. */
static uint32_t pairs_of_block(const Grid *grid, int32_t block, int axis, int32_t behind, int way, MirrorPair *out)
{
    const float *node = grid->node.data;
    const int32_t *corner = (const int32_t *)grid->coordinate.data + 3 * block;
    const int32_t local_behind = behind - grid->anchor[axis] - corner[axis] * K_BLOCK_AXIS;
    uint32_t count = 0;
    if (local_behind < 0 || local_behind >= K_BLOCK_AXIS) return 0;
    for (int i = 0; i < grid->block_cells; i++) {
        const int local[3] = {i & 3, i >> 2 & 3, i >> 4};
        const int64_t image = (int64_t)block * grid->block_cells + i;
        if (local[axis] != local_behind || !(node[image * K_NODE_WIDTH + 3] > 0.0f)) continue;
        const int64_t real = across(grid, block, local, axis, way);
        if (real < 0 || !(node[real * K_NODE_WIDTH + 3] > 0.0f)) continue;
        if (out) out[count] = (MirrorPair){.image = (uint32_t)image, .real = (uint32_t)real};
        count++;
    }
    return count;
}

static uint32_t pairs_of_wall(const Grid *grid, const Domain *domain, double cell_size, int axis, int upper, MirrorPair *out)
{
    const int32_t line = half_cells(domain, cell_size, axis, upper);
    const int apart = line & 1 ? 1 : 2; /* nodes at -1/2 and 1/2, or at -1 and 1 */
    const int32_t behind = upper ? (line + apart) / 2 : (line - apart) / 2; /* exact: line and apart are both even or both odd */
    uint32_t count = 0;
    for (int32_t block = 0; block < grid->node_blocks; block++)
        count += pairs_of_block(grid, block, axis, behind, upper ? -apart : apart, out ? out + count : NULL);
    return count;
}

/* The lower wall's pairs stand first. */
static uint32_t pairs_of_axis(const Grid *grid, const Domain *domain, double cell_size, int axis, MirrorPair *out)
{
    const uint32_t lower = pairs_of_wall(grid, domain, cell_size, axis, 0, out);
    return lower + pairs_of_wall(grid, domain, cell_size, axis, 1, out ? out + lower : NULL);
}

/* The nodes at an edge are images of each other behind two walls: all of them move as one, with the mass of all. So each pair hands its mass on to the real node, and
 * what has done so is not paired again: its mass is marked by its sign until all are found. */
static void hand_on_masses(const Grid *grid, MirrorPair *pair, uint32_t count)
{
    float *node = grid->node.data;
    for (uint32_t i = 0; i < count; i++) {
        float *image = node + (size_t)pair[i].image * K_NODE_WIDTH + 3, *real = node + (size_t)pair[i].real * K_NODE_WIDTH + 3;
        pair[i].image_mass = *image;
        pair[i].real_mass = *real;
        *real += *image;
        *image = -*image;
    }
}

static void give_masses_back(const Mirrors *mirrors, const Grid *grid)
{
    float *node = grid->node.data;
    for (int axis = grid->dimension - 1; axis >= 0; axis--) {
        const MirrorPair *pair = mirrors->pair[axis].data;
        for (uint32_t i = mirrors->count[axis]; i-- > 0;) {
            node[(size_t)pair[i].image * K_NODE_WIDTH + 3] = pair[i].image_mass;
            node[(size_t)pair[i].real * K_NODE_WIDTH + 3] = pair[i].real_mass;
        }
    }
}

bool mirrors_find(Mirrors *mirrors, Memory *memory, const Grid *grid, const Domain *domain, double cell_size)
{
    bool found = true;
    mirrors_clear(mirrors);
    for (int axis = 0; found && domain->enabled && axis < grid->dimension; axis++) {
        const uint32_t count = pairs_of_axis(grid, domain, cell_size, axis, NULL);
        found = array_reserve(memory, &mirrors->pair[axis], count, sizeof(MirrorPair));
        if (!found || count == 0) continue;
        mirrors->count[axis] = pairs_of_axis(grid, domain, cell_size, axis, mirrors->pair[axis].data);
        mirrors->lower[axis] = pairs_of_wall(grid, domain, cell_size, axis, 0, NULL);
        hand_on_masses(grid, mirrors->pair[axis].data, mirrors->count[axis]);
    }
    give_masses_back(mirrors, grid);
    return found;
}

void mirrors_clear(Mirrors *mirrors)
{
    for (int axis = 0; axis < 3; axis++) mirrors->count[axis] = mirrors->lower[axis] = 0;
    mirrors->books = false;
}

void mirrors_free(Mirrors *mirrors, Memory *memory)
{
    for (int axis = 0; axis < 3; axis++) {
        array_free(memory, &mirrors->pair[axis]);
        array_free(memory, &mirrors->booked[axis]);
    }
    mirrors_clear(mirrors);
}

bool mirrors_measure(Mirrors *mirrors, Memory *memory, bool measures)
{
    mirrors->books = measures;
    for (int axis = 0; axis < 3 && measures; axis++) {
        if (!array_reserve(memory, &mirrors->booked[axis], 6 * (size_t)mirrors->count[axis], sizeof(double))) return false;
        if (mirrors->booked[axis].data) memset(mirrors->booked[axis].data, 0, mirrors->booked[axis].bytes);
    }
    return true;
}

static void book_pair(double *booked, const MirrorPair *pair, const float before[6], const float *image, const float *real)
{
    for (int a = 0; a < 3; a++) {
        booked[a] = (double)pair->image_mass * ((double)image[a] - (double)before[a]);
        booked[3 + a] = (double)pair->real_mass * ((double)real[a] - (double)before[3 + a]);
    }
}

/* What the wall got from node `index` of all nodes. */
static void book_node(const ContactFrame *frame, uint32_t index, const double *booked, double scale, ImpulseSum *sum)
{
    double point[3], gained[3];
    const uint32_t cells = (uint32_t)frame->grid->block_cells;
    contacts_node_position(frame, (int32_t)(index / cells), (int)(index % cells), point);
    for (int a = 0; a < 3; a++) gained[a] = scale * booked[a];
    impulse_add(sum, point, gained);
}

void mirrors_book(const Mirrors *mirrors, const ContactFrame *frame, double dt)
{
    const double scale = contacts_momentum_scale(frame, dt);
    for (int axis = 0; axis < 3 && mirrors->books; axis++) {
        const MirrorPair *pair = mirrors->pair[axis].data;
        const double *booked = mirrors->booked[axis].data;
        for (uint32_t i = 0; i < mirrors->count[axis]; i++) {
            ImpulseSum *sum = &frame->colliders->impulses.sum[PBMPM_MAX_COLLIDERS + 2 * axis + (i < mirrors->lower[axis] ? 0 : 1)];
            book_node(frame, pair[i].image, booked + 6 * (size_t)i, scale, sum);
            book_node(frame, pair[i].real, booked + 6 * (size_t)i + 3, scale, sum);
        }
    }
}

void mirrors_close(const Mirrors *mirrors, const Grid *grid, uint8_t *mark)
{
    const uint32_t cells = (uint32_t)grid->block_cells;
    for (bool grown = true; grown;) { /* an image of an image lies behind another wall */
        grown = false;
        for (int axis = 0; axis < grid->dimension; axis++) {
            const MirrorPair *pair = mirrors->pair[axis].data;
            for (uint32_t i = 0; i < mirrors->count[axis]; i++) {
                uint8_t *image = mark + pair[i].image / cells, *real = mark + pair[i].real / cells;
                grown = grown || *image != *real;
                *image = *real = *image | *real;
            }
        }
    }
}

/* Each real node takes the mean of its own motion and its image's. */
static void meet(const Mirrors *mirrors, const Grid *grid, const uint8_t *mark, int axis)
{
    const uint32_t cells = (uint32_t)grid->block_cells;
    const MirrorPair *pair = mirrors->pair[axis].data;
    float *node = grid->node.data;
    for (uint32_t i = 0; i < mirrors->count[axis]; i++) {
        if (mark && !mark[pair[i].real / cells]) continue;
        float *image = node + (size_t)pair[i].image * K_NODE_WIDTH, *real = node + (size_t)pair[i].real * K_NODE_WIDTH;
        const float before[6] = {image[0], image[1], image[2], real[0], real[1], real[2]};
        const float share = pair[i].image_mass / (pair[i].image_mass + pair[i].real_mass);
        for (int a = 0; a < grid->dimension; a++) {
            const float sign = a == axis ? -1.0f : 1.0f;
            const float mean = real[a] + share * (sign * image[a] - real[a]);
            real[a] = mean;
            image[a] = sign * mean;
        }
        if (mirrors->books) book_pair((double *)mirrors->booked[axis].data + 6 * (size_t)i, &pair[i], before, image, real);
    }
}

/* Images follow what their real nodes did at the walls of the axes after. Those walls booked the image as if it had moved along; of its motion
 * through its own wall the opposite is true. */
static void follow(const Mirrors *mirrors, const Grid *grid, const uint8_t *mark, int axis)
{
    const uint32_t cells = (uint32_t)grid->block_cells;
    const MirrorPair *pair = mirrors->pair[axis].data;
    float *node = grid->node.data;
    for (uint32_t i = mirrors->count[axis]; i-- > 0;) {
        if (mark && !mark[pair[i].real / cells]) continue;
        float *image = node + (size_t)pair[i].image * K_NODE_WIDTH;
        const float *real = node + (size_t)pair[i].real * K_NODE_WIDTH;
        const double since = (double)real[axis] + (double)image[axis];
        if (mirrors->books) ((double *)mirrors->booked[axis].data)[6 * (size_t)i + (size_t)axis] -= 2.0 * (double)pair[i].image_mass * since;
        for (int a = 0; a < grid->dimension; a++) image[a] = a == axis ? -real[a] : real[a];
    }
}

/* One axis after the other, as an edge has the image of an image; and back. At an edge the mean over two nodes, and then over two others with shares of their own, is
 * no orthogonal projection: the walls did work, and pools in a box rolled and swelled without end. */
void mirrors_apply(const Mirrors *mirrors, const Grid *grid, const uint8_t *mark)
{
    for (int axis = 0; axis < grid->dimension; axis++) meet(mirrors, grid, mark, axis);
    for (int axis = grid->dimension - 2; axis >= 0; axis--) follow(mirrors, grid, mark, axis);
}
