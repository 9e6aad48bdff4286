#include "multilevel.h"

#include <math.h>
#include <string.h>

enum { BLOCK_GRAIN = 8, W = K_NODE_WIDTH, HALO = 2 * K_BLOCK_AXIS + 1, COARSE = K_BLOCK_AXIS / 2 + 1, COORDINATE_BITS = 21 };

/* ---- Lists of blocks ---- */

static uint64_t pack(const int32_t c[3])
{
    return (uint64_t)(uint32_t)c[0] << (2 * COORDINATE_BITS) | (uint64_t)(uint32_t)c[1] << COORDINATE_BITS | (uint64_t)(uint32_t)c[2];
}

/* The slot of a block in the table, or the free slot where it belongs; slots hold an index + 1. */
static uint32_t *find_slot(const Multilevel *m, const Level *level, const int32_t c[3])
{
    const size_t mask = m->table.bytes / sizeof(uint32_t) - 1;
    const int32_t *coordinate = level->coordinate.data;
    uint32_t *table = m->table.data;
    uint64_t mixed = pack(c) * 0x9e3779b97f4a7c15u;
    mixed = (mixed ^ mixed >> 32) * 0x9e3779b97f4a7c15u;
    for (size_t slot = (size_t)(mixed >> 32) & mask;; slot = (slot + 1) & mask)
        if (table[slot] == 0 || memcmp(coordinate + 3 * (table[slot] - 1), c, 3 * sizeof *c) == 0) return &table[slot];
}

/* An empty table for up to `blocks` blocks, at most half full; its size stays a power of two. */
static bool open_table(Multilevel *m, Memory *memory, size_t blocks)
{
    size_t slots = 64;
    while (slots < 2 * blocks) slots *= 2;
    if (slots * sizeof(uint32_t) > m->table.bytes) {
        uint32_t *table = memory_take(memory, slots * sizeof(uint32_t));
        if (!table) return false;
        array_free(memory, &m->table);
        m->table = (Array){table, slots * sizeof(uint32_t)};
    }
    memset(m->table.data, 0, m->table.bytes);
    return true;
}

static int parents_of(const Multilevel *m) { return m->dimension == 3 ? 8 : 4; }
static int children_of(const Multilevel *m) { return m->dimension == 3 ? 27 : 9; }

static bool reserve_level(const Multilevel *m, Memory *memory, Level *level, int32_t blocks, int32_t finer)
{
    const size_t nodes = (size_t)blocks * (size_t)m->block_cells;
    return array_reserve(memory, &level->coordinate, 3 * (size_t)blocks, sizeof(int32_t)) &&
           array_reserve(memory, &level->child, (size_t)blocks * (size_t)children_of(m), sizeof(int32_t)) &&
           array_reserve(memory, &level->parent, (size_t)finer * (size_t)parents_of(m), sizeof(int32_t)) &&
           array_reserve(memory, &level->vector, nodes * W, sizeof(float)) &&
           array_reserve(memory, &level->inverse, nodes * W, sizeof(float));
}

/* Lists the blocks over those of the finer level, and the next ones that its odd blocks reach into. */
static void list_parents(Multilevel *m, Level *level, const Level *finer)
{
    int32_t *coordinate = level->coordinate.data, *parent = level->parent.data;
    level->blocks = 0;
    for (int32_t b = 0; b < finer->blocks; b++) {
        const int32_t *c = (const int32_t *)finer->coordinate.data + 3 * b;
        for (int n = 0; n < parents_of(m); n++) {
            int32_t up[3];
            bool reaches = true;
            for (int a = 0; a < 3; a++) {
                const int next = n >> a & 1;
                reaches = reaches && !(next && (c[a] & 1) == 0);
                up[a] = (c[a] >> 1) + next;
            }
            parent[b * parents_of(m) + n] = -1;
            if (!reaches) continue;
            uint32_t *slot = find_slot(m, level, up);
            if (*slot == 0) {
                memcpy(coordinate + 3 * level->blocks, up, sizeof up);
                *slot = (uint32_t)++level->blocks;
            }
            parent[b * parents_of(m) + n] = (int32_t)*slot - 1;
        }
    }
}

static void list_children(const Multilevel *m, Level *level, const Level *finer)
{
    int32_t *child = level->child.data;
    for (int32_t i = 0; i < level->blocks * children_of(m); i++) child[i] = -1;
    for (int32_t b = 0; b < finer->blocks; b++) {
        const int32_t *c = (const int32_t *)finer->coordinate.data + 3 * b;
        const int32_t *parent = (const int32_t *)level->parent.data + b * parents_of(m);
        for (int n = 0; n < parents_of(m); n++) {
            if (parent[n] < 0) continue;
            int place = 0;
            for (int a = m->dimension - 1; a >= 0; a--) place = 3 * place + ((n >> a & 1) ? 0 : 1 + (c[a] & 1));
            child[parent[n] * children_of(m) + place] = b;
        }
    }
}

static int32_t extent_of(const Level *level)
{
    const int32_t *c = level->coordinate.data;
    int32_t most = 0;
    for (int32_t i = 0; i < 3 * level->blocks; i++) most = c[i] > most ? c[i] : most;
    return most + 1;
}

/* The finest level: the blocks of the grid, counted from those below the lowest with particles. */
static bool list_finest(Multilevel *m, Memory *memory, const Grid *grid)
{
    Level *level = &m->level[0];
    if (!array_reserve(memory, &level->coordinate, 3 * (size_t)grid->node_blocks, sizeof(int32_t))) return false;
    const int32_t *from = grid->coordinate.data;
    int32_t *to = level->coordinate.data;
    for (int32_t i = 0; i < 3 * grid->node_blocks; i++) to[i] = i % 3 < grid->dimension ? from[i] + 1 : 0;
    level->blocks = grid->node_blocks;
    return true;
}

bool multilevel_build(Multilevel *m, Memory *memory, const Grid *grid)
{
    m->dimension = grid->dimension;
    m->block_cells = grid->block_cells;
    m->levels = 1;
    if (!list_finest(m, memory, grid)) return false;
    while (m->levels < MULTILEVEL_MAX && extent_of(&m->level[m->levels - 1]) > 1) {
        const Level *finer = &m->level[m->levels - 1];
        Level *level = &m->level[m->levels];
        const int32_t most = finer->blocks * parents_of(m);
        if (!reserve_level(m, memory, level, most, finer->blocks) || !open_table(m, memory, (size_t)most)) return false;
        list_parents(m, level, finer);
        list_children(m, level, finer);
        m->levels++;
        if (extent_of(level) <= 2) break; /* one block, and what reaches over its end */
    }
    return true;
}

void multilevel_free(Multilevel *m, Memory *memory)
{
    for (int l = 0; l < MULTILEVEL_MAX; l++) {
        Level *level = &m->level[l];
        Array *arrays[] = {&level->coordinate, &level->child, &level->parent, &level->vector, &level->inverse};
        for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(memory, arrays[i]);
    }
    array_free(memory, &m->table);
}

/* ---- Up: sums with the weights 1/2, 1, 1/2 per axis ---- */

typedef struct TransferJob {
    const Multilevel *m;
    const Level *level;  /* the coarser one */
    const Level *finer;  /* null: the grid */
    const float *from;
    float *to;
} TransferJob;

/* The part of the halo that a child fills along one axis: the one below lends its last node. */
static void child_range(int side, int *from, int *to, int *size)
{
    *from = side == 0 ? K_BLOCK_AXIS - 1 : 0;
    *to = side == 0 ? 0 : 1 + (side - 1) * K_BLOCK_AXIS;
    *size = side == 0 ? 1 : K_BLOCK_AXIS;
}

static void load_halo(const TransferJob *job, int32_t block, float *halo)
{
    const Multilevel *m = job->m;
    const bool deep = m->dimension == 3;
    const int32_t *child = (const int32_t *)job->level->child.data + block * children_of(m);
    for (int n = 0; n < children_of(m); n++) {
        int fx, fy, fz = 0, tx, ty, tz = 0, sx, sy, sz = 1;
        child_range(n % 3, &fx, &tx, &sx);
        child_range(n / 3 % 3, &fy, &ty, &sy);
        if (deep) child_range(n / 9, &fz, &tz, &sz);
        const float *source = child[n] < 0 ? NULL : job->from + (size_t)child[n] * (size_t)m->block_cells * W;
        for (int k = 0; k < sz; k++)
            for (int j = 0; j < sy; j++) {
                float *row = halo + (((tz + k) * HALO + ty + j) * HALO + tx) * W;
                if (source)
                    memcpy(row, source + (((fz + k) * K_BLOCK_AXIS + fy + j) * K_BLOCK_AXIS + fx) * W, (size_t)sx * W * sizeof(float));
                else
                    memset(row, 0, (size_t)sx * W * sizeof(float));
            }
    }
}

/* Shortens one axis: `count` lines of HALO elements, `stride` floats apart, become lines of K_BLOCK_AXIS. An element has `width` floats. */
static void sum_axis(const float *from, float *to, int lines, int width)
{
    for (int line = 0; line < lines; line++)
        for (int j = 0; j < K_BLOCK_AXIS; j++) {
            const float *f = from + (line * HALO + 2 * j) * width;
            float *t = to + (line * K_BLOCK_AXIS + j) * width;
            for (int c = 0; c < width; c++) t[c] = 0.5f * (f[c] + f[2 * width + c]) + f[width + c];
        }
}

static void restrict_blocks(void *context, int32_t begin, int32_t end)
{
    const TransferJob *job = context;
    const bool deep = job->m->dimension == 3;
    float halo[HALO * HALO * HALO * W], flat[HALO * HALO * K_BLOCK_AXIS * W], thin[HALO * K_BLOCK_AXIS * K_BLOCK_AXIS * W];
    for (int32_t block = begin; block < end; block++) {
        float *to = job->to + (size_t)block * (size_t)job->m->block_cells * W;
        load_halo(job, block, halo);
        sum_axis(halo, flat, deep ? HALO * HALO : HALO, W);
        sum_axis(flat, deep ? thin : to, deep ? HALO : 1, K_BLOCK_AXIS * W);
        if (deep) sum_axis(thin, to, 1, K_BLOCK_AXIS * K_BLOCK_AXIS * W);
    }
}

static void restrict_to(const Multilevel *m, Pool *pool, int l, const float *from, float *to)
{
    TransferJob job = {m, &m->level[l], &m->level[l - 1], from, to};
    pool_for(pool, m->level[l].blocks, BLOCK_GRAIN, restrict_blocks, &job);
}

/* ---- Down: interpolation ---- */

static void load_coarse(const TransferJob *job, int32_t block, float *coarse)
{
    const Multilevel *m = job->m;
    const int depth = m->dimension == 3 ? COARSE : 1;
    const int32_t *c = (const int32_t *)job->finer->coordinate.data + 3 * block;
    const int32_t *parent = (const int32_t *)job->level->parent.data + block * parents_of(m);
    for (int k = 0; k < depth; k++)
        for (int j = 0; j < COARSE; j++)
            for (int i = 0; i < COARSE; i++) {
                const int at[3] = {i + 2 * (c[0] & 1), j + 2 * (c[1] & 1), k + 2 * (c[2] & 1)};
                const int n = (at[0] >> 2) | (at[1] >> 2) << 1 | (at[2] >> 2) << 2;
                const int node = ((at[2] & 3) * K_BLOCK_AXIS + (at[1] & 3)) * K_BLOCK_AXIS + (at[0] & 3);
                const float *from = job->from + ((size_t)parent[n] * (size_t)m->block_cells + (size_t)node) * W;
                memcpy(coarse + ((k * COARSE + j) * COARSE + i) * W, from, W * sizeof(float));
            }
}

/* Lengthens one axis: lines of COARSE elements become lines of K_BLOCK_AXIS. */
static void spread_axis(const float *from, float *to, int lines, int width)
{
    for (int line = 0; line < lines; line++)
        for (int j = 0; j < K_BLOCK_AXIS; j++) {
            const float *f = from + (line * COARSE + j / 2) * width, *next = f + (j % 2) * width;
            float *t = to + (line * K_BLOCK_AXIS + j) * width;
            for (int c = 0; c < width; c++) t[c] = 0.5f * (f[c] + next[c]);
        }
}

static void prolong_blocks(void *context, int32_t begin, int32_t end)
{
    const TransferJob *job = context;
    const bool deep = job->m->dimension == 3;
    const int floats = job->m->block_cells * W;
    float coarse[COARSE * COARSE * COARSE * W], flat[COARSE * COARSE * K_BLOCK_AXIS * W], thin[COARSE * K_BLOCK_AXIS * K_BLOCK_AXIS * W];
    float fine[K_BLOCK_AXIS * K_BLOCK_AXIS * K_BLOCK_AXIS * W];
    for (int32_t block = begin; block < end; block++) {
        float *to = job->to + (size_t)block * (size_t)floats;
        load_coarse(job, block, coarse);
        spread_axis(coarse, flat, deep ? COARSE * COARSE : COARSE, W);
        spread_axis(flat, deep ? thin : fine, deep ? COARSE : 1, K_BLOCK_AXIS * W);
        if (deep) spread_axis(thin, fine, 1, K_BLOCK_AXIS * K_BLOCK_AXIS * W);
        for (int i = 0; i < floats; i++) to[i] += fine[i];
    }
}

static void prolong_from(const Multilevel *m, Pool *pool, int l, const float *from, float *to)
{
    TransferJob job = {m, &m->level[l], &m->level[l - 1], from, to};
    pool_for(pool, m->level[l - 1].blocks, BLOCK_GRAIN, prolong_blocks, &job);
}

/* ---- The operator ---- */

/* Levels overlap: smooth motion is corrected by each of them. With 1 steps were too long by about the factor 2; iterations for the bar and the
 * cantilever of the accuracy cases were fewest around 2. */
static const double OVERLAP = 2.0;

void multilevel_weigh(Multilevel *m, Pool *pool, const float *weight)
{
    const double d = m->dimension;
    for (int l = 1; l < m->levels; l++) restrict_to(m, pool, l, l == 1 ? weight : m->level[l - 1].inverse.data, m->level[l].inverse.data);
    for (int l = 1; l < m->levels; l++) {
        const float mass = (float)pow(2.0 / 3.0, d);
        const float stiff = (float)(OVERLAP * 0.5 * d * pow(2.0 / 3.0, d - 1.0) * pow(0.25, l));
        float *inverse = m->level[l].inverse.data;
        const size_t nodes = (size_t)m->level[l].blocks * (size_t)m->block_cells;
        for (size_t i = 0; i < nodes; i++, inverse += W)
            for (int a = 0; a < 3; a++) {
                const float energy = mass * inverse[a] + stiff * inverse[3];
                inverse[a] = energy > 1e-30f ? 1.0f / energy : 0.0f;
            }
    }
}

typedef struct ScaleJob {
    const float *inverse;
    float *vector;
    int floats;
} ScaleJob;

static void scale_blocks(void *context, int32_t begin, int32_t end)
{
    const ScaleJob *job = context;
    for (size_t i = (size_t)begin * (size_t)job->floats; i < (size_t)end * (size_t)job->floats; i++)
        job->vector[i] *= i % W == 3 ? 0.0f : job->inverse[i];
}

void multilevel_add(Multilevel *m, Pool *pool, const float *r, float *z)
{
    for (int l = 1; l < m->levels; l++) restrict_to(m, pool, l, l == 1 ? r : m->level[l - 1].vector.data, m->level[l].vector.data);
    for (int l = m->levels - 1; l >= 1; l--) {
        Level *level = &m->level[l];
        ScaleJob job = {level->inverse.data, level->vector.data, m->block_cells * W};
        pool_for(pool, level->blocks, BLOCK_GRAIN, scale_blocks, &job);
        if (l + 1 < m->levels) prolong_from(m, pool, l + 1, m->level[l + 1].vector.data, level->vector.data);
    }
    if (m->levels > 1) prolong_from(m, pool, 1, m->level[1].vector.data, z);
}
