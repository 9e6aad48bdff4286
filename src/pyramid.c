#include "pyramid.h"

#include <string.h>

#include "kernel_types.h"

enum { AXIS = K_BLOCK_AXIS };

static int32_t nodes_per_block(const Pyramid *pyramid) { return pyramid->dimension == 3 ? AXIS * AXIS * AXIS : AXIS * AXIS; }

static int32_t corners(const Pyramid *pyramid) { return 1 << pyramid->dimension; }

static size_t level_nodes(const Pyramid *pyramid, int l) { return (size_t)pyramid->level[l].blocks * (size_t)nodes_per_block(pyramid); }

/* ---- Building ---- */

static uint32_t hash(const int32_t c[3]) { return ((uint32_t)c[0] * 73856093u) ^ ((uint32_t)c[1] * 19349663u) ^ ((uint32_t)c[2] * 83492791u); }

/* The index of the block at c, added to the level if it is new. The table is larger than all that can be added. */
static int32_t find_or_add(Pyramid *pyramid, PyramidLevel *level, const int32_t c[3], uint32_t mask)
{
    uint32_t *table = pyramid->table.data;
    int32_t *coordinate = level->coordinate.data;
    uint32_t slot = hash(c) & mask;
    for (; table[slot] != 0; slot = (slot + 1) & mask) {
        const int32_t *other = coordinate + 3 * (table[slot] - 1);
        if (other[0] == c[0] && other[1] == c[1] && other[2] == c[2]) return (int32_t)table[slot] - 1;
    }
    memcpy(coordinate + 3 * (size_t)level->blocks, c, 3 * sizeof *c);
    table[slot] = (uint32_t)++level->blocks;
    return level->blocks - 1;
}

static bool add_level(Pyramid *pyramid, Memory *memory)
{
    PyramidLevel *fine = &pyramid->level[pyramid->levels - 1], *coarse = fine + 1;
    const size_t most = (size_t)fine->blocks * (size_t)corners(pyramid);
    size_t slots = 16;
    while (slots < 2 * most) slots *= 2;
    if (!array_reserve(memory, &fine->parent, most, sizeof(int32_t)) || !array_reserve(memory, &coarse->coordinate, 3 * most, sizeof(int32_t)) ||
        !array_reserve(memory, &pyramid->table, slots, sizeof(uint32_t)))
        return false;
    memset(pyramid->table.data, 0, slots * sizeof(uint32_t));
    coarse->blocks = 0;
    int32_t *parent = fine->parent.data;
    for (int32_t b = 0; b < fine->blocks; b++) {
        const int32_t *at = (const int32_t *)fine->coordinate.data + 3 * b;
        for (int corner = 0; corner < corners(pyramid); corner++) {
            int32_t c[3] = {0};
            for (int a = 0; a < pyramid->dimension; a++) c[a] = (at[a] + (corner >> a & 1)) >> 1;
            *parent++ = find_or_add(pyramid, coarse, c, (uint32_t)slots - 1);
        }
    }
    pyramid->levels++;
    const size_t nodes = level_nodes(pyramid, pyramid->levels - 1);
    return array_reserve(memory, &coarse->value, nodes, sizeof(float)) && array_reserve(memory, &coarse->scale, nodes, sizeof(float));
}

bool pyramid_build(Pyramid *pyramid, Memory *memory, int dimension, const int32_t *coordinate, int32_t blocks)
{
    pyramid->dimension = dimension;
    pyramid->levels = 1;
    pyramid->level[0].blocks = blocks;
    if (!array_reserve(memory, &pyramid->level[0].coordinate, 3 * (size_t)blocks, sizeof(int32_t))) return false;
    memcpy(pyramid->level[0].coordinate.data, coordinate, 3 * (size_t)blocks * sizeof(int32_t));
    while (pyramid->levels < PYRAMID_LEVELS && pyramid->level[pyramid->levels - 1].blocks > corners(pyramid))
        if (!add_level(pyramid, memory)) return false;
    return true;
}

void pyramid_free(Pyramid *pyramid, Memory *memory)
{
    for (int l = 0; l < PYRAMID_LEVELS; l++) {
        Array *arrays[] = {&pyramid->level[l].coordinate, &pyramid->level[l].parent, &pyramid->level[l].value, &pyramid->level[l].scale};
        for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(memory, arrays[i]);
    }
    array_free(memory, &pyramid->table);
}

/* ---- From level to level ---- */

/* The coarse nodes that a fine node at `local` lies on or between, along one axis, in a block at an even or odd coordinate. */
typedef struct Between {
    int count;      /* 1: on a node, 2: halfway */
    int carry[2];   /* whether in the next coarse block */
    int local[2];
} Between;

static Between between(int32_t coordinate, int local)
{
    const int first = (coordinate & 1) * (AXIS / 2) + local / 2;
    return (Between){1 + (local & 1), {0, (first + 1) / AXIS}, {first, (first + 1) % AXIS}};
}

/* Passes the values of one fine block up to its coarse blocks (weights transposed) or down from them, added to what is there. */
static void pass_block(const Pyramid *pyramid, const PyramidLevel *fine, int32_t b, float *fine_value, float *coarse_value, bool up)
{
    const int32_t *at = (const int32_t *)fine->coordinate.data + 3 * b, *parent = (const int32_t *)fine->parent.data + b * corners(pyramid);
    const int nodes = nodes_per_block(pyramid), depth = pyramid->dimension == 3 ? AXIS : 1;
    float *value = fine_value + (size_t)b * (size_t)nodes;
    for (int z = 0; z < depth; z++) {
        const Between bz = pyramid->dimension == 3 ? between(at[2], z) : (Between){1, {0, 0}, {0, 0}};
        for (int y = 0; y < AXIS; y++) {
            const Between by = between(at[1], y);
            for (int x = 0; x < AXIS; x++, value++) {
                const Between bx = between(at[0], x);
                const float weight = 1.0f / (float)(bx.count * by.count * bz.count);
                float sum = 0.0f;
                for (int k = 0; k < bz.count; k++)
                    for (int j = 0; j < by.count; j++)
                        for (int i = 0; i < bx.count; i++) {
                            const int32_t block = parent[bx.carry[i] + 2 * by.carry[j] + 4 * bz.carry[k]];
                            float *coarse = coarse_value + (size_t)block * (size_t)nodes + (bz.local[k] * AXIS + by.local[j]) * AXIS + bx.local[i];
                            if (up)
                                *coarse += weight * *value;
                            else
                                sum += *coarse;
                        }
                if (!up) *value += weight * sum;
            }
        }
    }
}

/* From level l to l + 1. */
static void restrict_level(Pyramid *pyramid, int l, float *fine_value)
{
    PyramidLevel *fine = &pyramid->level[l], *coarse = fine + 1;
    memset(coarse->value.data, 0, level_nodes(pyramid, l + 1) * sizeof(float));
    for (int32_t b = 0; b < fine->blocks; b++) pass_block(pyramid, fine, b, fine_value, coarse->value.data, true);
}

static void prolong_level(Pyramid *pyramid, int l, float *fine_value)
{
    PyramidLevel *fine = &pyramid->level[l], *coarse = fine + 1;
    for (int32_t b = 0; b < fine->blocks; b++) pass_block(pyramid, fine, b, fine_value, coarse->value.data, false);
}

/* ---- The preconditioner ---- */

/* Restricts a field through all levels and adds factor(l) times it to the scales. Per axis a hat of width H = 2^l has the integrals
 * sum P = H, sum P^2 = 2H/3, sum P'^2 = 2/H. */
static void add_energy(Pyramid *pyramid, const float *field, bool of_gradient)
{
    const double d = pyramid->dimension, square = 2.0 / 3.0;
    for (int l = 1; l < pyramid->levels; l++) {
        const double width = (double)(1 << l);
        const double volume = pyramid->dimension == 3 ? square * square * square : square * square;
        const double factor = of_gradient ? 2.0 * d / (width * width) * volume / square : volume;
        restrict_level(pyramid, l - 1, l == 1 ? (float *)(uintptr_t)field : pyramid->level[l - 1].value.data); /* read only */
        const float *value = pyramid->level[l].value.data;
        float *scale = pyramid->level[l].scale.data;
        for (size_t i = 0; i < level_nodes(pyramid, l); i++) scale[i] += (float)(factor * (double)value[i]);
    }
}

void pyramid_set_energy(Pyramid *pyramid, const float *stiffness, const float *load)
{
    for (int l = 1; l < pyramid->levels; l++) memset(pyramid->level[l].scale.data, 0, level_nodes(pyramid, l) * sizeof(float));
    add_energy(pyramid, stiffness, true);
    add_energy(pyramid, load, false);
    for (int l = 1; l < pyramid->levels; l++) {
        float *scale = pyramid->level[l].scale.data;
        for (size_t i = 0; i < level_nodes(pyramid, l); i++) scale[i] = scale[i] > 1e-20f ? 1.0f / scale[i] : 0.0f;
    }
}

void pyramid_precondition(Pyramid *pyramid, const float *r, float *z)
{
    const int last = pyramid->levels - 1;
    for (int l = 0; l < last; l++) restrict_level(pyramid, l, l == 0 ? (float *)(uintptr_t)r : pyramid->level[l].value.data); /* read only */
    for (int l = last; l >= 1; l--) {
        float *value = pyramid->level[l].value.data;
        const float *scale = pyramid->level[l].scale.data;
        for (size_t i = 0; i < level_nodes(pyramid, l); i++) value[i] *= scale[i];
        if (l < last) prolong_level(pyramid, l, value);
    }
    if (last >= 1) prolong_level(pyramid, 0, z);
}
