#include "grid/multilevel.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#include "grid/bodies.h"

/* What a block is found by: its place and its body. */
enum { BODY = 3, KEY };

/* The places of a body's blocks. */
typedef struct Range {
    int32_t least[3], most[3];
} Range;

enum { BLOCK_GRAIN = 8, W = K_NODE_WIDTH, HALO = 2 * K_BLOCK_AXIS + 1, COARSE = K_BLOCK_AXIS / 2 + 1 };

/* ---- Lists of blocks ---- */

static uint64_t pack(const int32_t c[KEY])
{
    return (uint64_t)(uint32_t)c[0] << (2 * GRID_COORDINATE_BITS) | (uint64_t)(uint32_t)c[1] << GRID_COORDINATE_BITS | (uint64_t)(uint32_t)c[2];
}

/* The slot of a block in the table, or the free slot where it belongs; slots hold an index + 1. */
static uint32_t *find_slot(const Multilevel *m, const Level *level, const int32_t c[KEY])
{
    const size_t mask = m->table.bytes / sizeof(uint32_t) - 1;
    const int32_t *coordinate = level->coordinate.data;
    uint32_t *table = m->table.data;
    uint64_t mixed = (pack(c) + (uint64_t)c[BODY] * 0xbf58476d1ce4e5b9u) * 0x9e3779b97f4a7c15u;
    mixed = (mixed ^ mixed >> 32) * 0x9e3779b97f4a7c15u;
    for (size_t slot = (size_t)(mixed >> 32) & mask;; slot = (slot + 1) & mask)
        if (table[slot] == 0 || memcmp(coordinate + KEY * (table[slot] - 1), c, KEY * sizeof *c) == 0) return &table[slot];
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

/* The level is listed. */
static bool reserve_level(const Multilevel *m, Memory *memory, Level *level)
{
    const size_t blocks = (size_t)level->blocks, floats = blocks * (size_t)m->block_cells * (size_t)m->width;
    return array_reserve(memory, &level->child, blocks * (size_t)children_of(m), sizeof(int32_t)) &&
           array_reserve(memory, &level->vector, floats, sizeof(float)) && array_reserve(memory, &level->inverse, floats, sizeof(float));
}

static bool add_block(Level *level, Memory *memory, const int32_t key[KEY])
{
    const size_t block = sizeof(int32_t[KEY]), blocks = (size_t)level->blocks;
    if (!array_grow(memory, &level->coordinate, blocks + 1, block, blocks * block)) return false;
    memcpy((int32_t *)level->coordinate.data + KEY * level->blocks++, key, block);
    return true;
}

/* Whether hats cover the body of this block already: a block of the finer level, or two of a coarser one, the second what reaches over the first's end. */
static bool is_covered(const Multilevel *m, const int32_t *key)
{
    const Range *of = (const Range *)m->range.data + key[BODY];
    bool covered = true;
    for (int a = 0; a < 3; a++) covered = covered && of->most[a] - of->least[a] < (m->levels > 1 ? 2 : 1);
    return covered;
}

/* Lists the blocks over those of the finer level, and the next ones that its odd blocks reach into: none over bodies that are covered, so that what is elsewhere
 * changes nothing. False: no memory. */
static bool list_parents(Multilevel *m, Memory *memory, Level *level, const Level *finer)
{
    const size_t most = (size_t)finer->blocks * (size_t)parents_of(m); /* all could be different ones */
    if (!array_reserve(memory, &level->parent, most, sizeof(int32_t)) || !open_table(m, memory, most)) return false;
    int32_t *parent = level->parent.data;
    level->blocks = 0;
    for (int32_t b = 0; b < finer->blocks; b++) {
        const int32_t *c = (const int32_t *)finer->coordinate.data + KEY * b;
        const bool covered = is_covered(m, c);
        for (int n = 0; n < parents_of(m); n++) {
            int32_t up[KEY] = {[BODY] = c[BODY]};
            bool reaches = !covered;
            for (int a = 0; a < 3; a++) {
                const int next = n >> a & 1;
                reaches = reaches && !(next && (c[a] & 1) == 0);
                up[a] = (c[a] >> 1) + next;
            }
            parent[b * parents_of(m) + n] = -1;
            if (!reaches) continue;
            uint32_t *slot = find_slot(m, level, up);
            if (*slot == 0) {
                if (!add_block(level, memory, up)) return false;
                *slot = (uint32_t)level->blocks;
            }
            parent[b * parents_of(m) + n] = (int32_t)*slot - 1;
        }
    }
    return true;
}

static void list_children(const Multilevel *m, Level *level, const Level *finer)
{
    int32_t *child = level->child.data;
    for (int32_t i = 0; i < level->blocks * children_of(m); i++) child[i] = -1;
    for (int32_t b = 0; b < finer->blocks; b++) {
        const int32_t *c = (const int32_t *)finer->coordinate.data + KEY * b;
        const int32_t *parent = (const int32_t *)level->parent.data + b * parents_of(m);
        for (int n = 0; n < parents_of(m); n++) {
            if (parent[n] < 0) continue;
            int place = 0;
            for (int a = m->dimension - 1; a >= 0; a--) place = 3 * place + ((n >> a & 1) ? 0 : 1 + (c[a] & 1));
            child[parent[n] * children_of(m) + place] = b;
        }
    }
}

static void clear_ranges(Range *range, int32_t bodies)
{
    for (int32_t i = 0; i < bodies; i++) range[i] = (Range){{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
}

static void widen_range(Range *range, const int32_t *place, int axes)
{
    for (int a = 0; a < axes; a++) {
        range->least[a] = place[a] < range->least[a] ? place[a] : range->least[a];
        range->most[a] = place[a] > range->most[a] ? place[a] : range->most[a];
    }
}

/* Finds where the bodies' blocks of a level are. False if all are covered. */
static bool find_ranges(Multilevel *m, const Level *level, int32_t bodies)
{
    bool any = false;
    clear_ranges(m->range.data, bodies);
    for (int32_t b = 0; b < level->blocks; b++) {
        const int32_t *key = (const int32_t *)level->coordinate.data + KEY * b;
        widen_range((Range *)m->range.data + key[BODY], key, 3);
    }
    for (int32_t b = 0; b < level->blocks && !any; b++) any = !is_covered(m, (const int32_t *)level->coordinate.data + KEY * b);
    return any;
}

/* Where the particles of the bodies begin: there their hats do. */
static bool find_origins(Multilevel *m, Memory *memory, const Grid *grid)
{
    if (!array_reserve(memory, &m->range, (size_t)grid->bodies, sizeof(Range)) || !array_reserve(memory, &m->origin, (size_t)grid->bodies, sizeof(Range))) return false;
    clear_ranges(m->origin.data, grid->bodies);
    for (int32_t b = 0; b < grid->particle_blocks; b++)
        widen_range((Range *)m->origin.data + body_of_block(grid, b), (const int32_t *)grid->coordinate.data + 3 * b, grid->dimension);
    return true;
}

static void key_of(const Multilevel *m, const Grid *grid, int32_t block, int32_t shift, int32_t key[KEY])
{
    const int32_t *place = (const int32_t *)grid->coordinate.data + 3 * block;
    key[BODY] = body_of_block(grid, block);
    const Range *of = (const Range *)m->origin.data + key[BODY];
    for (int a = 0; a < 3; a++) key[a] = a < grid->dimension ? place[a] - of->least[a] + shift : 0;
}

/* The finest level: the blocks of the grid, moved by `shift` from where the particles begin. */
static bool list_finest(Multilevel *m, Memory *memory, const Grid *grid, int32_t shift)
{
    Level *level = &m->level[0];
    if (!array_reserve(memory, &level->coordinate, KEY * (size_t)grid->node_blocks, sizeof(int32_t))) return false;
    for (int32_t b = 0; b < grid->node_blocks; b++) key_of(m, grid, b, shift, (int32_t *)level->coordinate.data + KEY * b);
    level->blocks = grid->node_blocks;
    return true;
}

/* Whether the levels are those of the last substep: it had the same blocks. */
static bool is_built(const Multilevel *m, const Grid *grid, int width, int32_t shift)
{
    const int32_t *before = m->level[0].coordinate.data;
    bool same = m->built && m->width == width && m->shift == shift && m->level[0].blocks == grid->node_blocks;
    for (int32_t b = 0; b < grid->node_blocks && same; b++) {
        int32_t key[KEY];
        key_of(m, grid, b, shift, key);
        same = memcmp(before + KEY * b, key, sizeof key) == 0;
    }
    return same;
}

bool multilevel_build(Multilevel *m, Memory *memory, const Grid *grid, int width, LevelsEnd end)
{
    enum { LEVELS_FAR_BEYOND = 8 }; /* hats of 256 blocks, a thousand cells: wider matter has a mean that these no longer see as one; by trial */
    const int most_levels = end == LEVELS_BEYOND ? LEVELS_FAR_BEYOND : MULTILEVEL_MAX;
    /* Blocks below those with the lowest particles have -1, and would have it on all levels. */
    const int32_t shift = end == LEVELS_BEYOND ? 0 : 1;
    if (!find_origins(m, memory, grid)) return false;
    if (is_built(m, grid, width, shift)) return true;
    m->built = false;
    m->shift = shift;
    m->width = width;
    m->dimension = grid->dimension;
    m->block_cells = grid->block_cells;
    m->levels = 1;
    if (!list_finest(m, memory, grid, shift)) return false;
    while (m->levels < most_levels) {
        const Level *finer = &m->level[m->levels - 1];
        Level *level = &m->level[m->levels];
        if (!find_ranges(m, finer, grid->bodies)) break;
        if (!list_parents(m, memory, level, finer) || !reserve_level(m, memory, level)) return false;
        list_children(m, level, finer);
        m->levels++;
    }
    m->built = true;
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
    array_free(memory, &m->range);
    array_free(memory, &m->origin);
    m->built = false;
}

/* ---- Up: sums with the weights 1/2, 1, 1/2 per axis ---- */

typedef struct TransferJob {
    const Multilevel *m;
    const Level *level;  /* the coarser one */
    const Level *finer;
    const float *from;
    float *to;
    const float *factor; /* null: 1. Up: of the sums; down: of what is added to */
    int width;
} TransferJob;

/* What follows is written once for any width and compiled for each of the two that there are. */

/* A block is summed from HALO finer nodes per axis: the last one of the child below, then all of the next two. First along the third axis, then along the second,
 * whole lines of all three children at once; of the child below only the last node counts. */
enum { LINE = 3 * K_BLOCK_AXIS, UNUSED = K_BLOCK_AXIS - 1 };

/* The nodes of a child along one axis: the first that is in the halo, where it is there, and how many are. */
typedef struct Part {
    int from, to, size;
} Part;

static const Part part_of[3] = {{K_BLOCK_AXIS - 1, 0, 1}, {0, 1, K_BLOCK_AXIS}, {0, 1 + K_BLOCK_AXIS, K_BLOCK_AXIS}};

/* Sums the three children that are neighbours along the third axis to the lines of K_BLOCK_AXIS planes. */
static inline void sum_children(const float *const child[3], Part y, float *restrict lines, int width)
{
    const int length = K_BLOCK_AXIS * width, stride = LINE * width;
    const float *plane[HALO];
    for (int n = 0; n < 3; n++)
        for (int k = 0; k < part_of[n].size; k++) plane[part_of[n].to + k] = child[n] + ((part_of[n].from + k) * K_BLOCK_AXIS + y.from) * length;
    for (int k = 0; k < K_BLOCK_AXIS; k++) {
        const float *before = plane[2 * k], *at = plane[2 * k + 1], *behind = plane[2 * k + 2];
        float *restrict to = lines + (k * HALO + y.to) * stride;
        for (int j = 0; j < y.size; j++)
            for (int i = 0; i < length; i++) to[j * stride + i] = 0.5f * (before[j * length + i] + behind[j * length + i]) + at[j * length + i];
    }
}

static inline void copy_child(const float *child, Part y, float *restrict lines, int width)
{
    const int length = K_BLOCK_AXIS * width, stride = LINE * width;
    for (int j = 0; j < y.size; j++)
        for (int i = 0; i < length; i++) lines[(y.to + j) * stride + i] = child[(y.from + j) * length + i];
}

/* From HALO elements of `size` floats to K_BLOCK_AXIS. */
static inline void sum_axis(const float *restrict from, float *restrict to, int size)
{
    for (int j = 0; j < K_BLOCK_AXIS; j++) {
        const float *f = from + 2 * j * size;
        for (int c = 0; c < size; c++) to[j * size + c] = 0.5f * (f[c] + f[2 * size + c]) + f[size + c];
    }
}

static inline void restrict_block(const TransferJob *job, int32_t block, int width)
{
    static const float none[K_BLOCK_AXIS * K_BLOCK_AXIS * K_BLOCK_AXIS * W];
    const bool deep = job->m->dimension == 3;
    const int floats = job->m->block_cells * width;
    const int32_t *child = (const int32_t *)job->level->child.data + block * children_of(job->m);
    float lines[K_BLOCK_AXIS * HALO * LINE * W], flat[K_BLOCK_AXIS * LINE * W], *to = job->to + (ptrdiff_t)block * floats;
    for (int n = 0; n < 9; n++) {
        const float *of[3] = {none, none, none};
        for (int z = 0; z < (deep ? 3 : 1); z++)
            if (child[9 * z + n] >= 0) of[z] = job->from + (ptrdiff_t)child[9 * z + n] * floats;
        if (deep)
            sum_children(of, part_of[n / 3], lines + n % 3 * K_BLOCK_AXIS * width, width);
        else
            copy_child(of[0], part_of[n / 3], lines + n % 3 * K_BLOCK_AXIS * width, width);
    }
    for (int k = 0; k < (deep ? K_BLOCK_AXIS : 1); k++) {
        sum_axis(lines + k * HALO * LINE * width, flat, LINE * width);
        for (int j = 0; j < K_BLOCK_AXIS; j++) sum_axis(flat + (j * LINE + UNUSED) * width, to + (k * K_BLOCK_AXIS + j) * K_BLOCK_AXIS * width, width);
    }
}

static void scale_block(const TransferJob *job, int32_t block)
{
    const size_t floats = (size_t)(job->m->block_cells * job->width), begin = (size_t)block * floats;
    if (!job->factor) return;
    float *restrict to = job->to + begin;
    const float *restrict factor = job->factor + begin;
    for (size_t i = 0; i < floats; i++) to[i] *= factor[i];
}

static void restrict_blocks(void *context, int32_t begin, int32_t end)
{
    const TransferJob *job = context;
    for (int32_t block = begin; block < end; block++) {
        if (job->width == 1)
            restrict_block(job, block, 1);
        else
            restrict_block(job, block, W);
        scale_block(job, block);
    }
}

static Span span_of(const Multilevel *m, int l, int width)
{
    const int32_t blocks = m->level[l].blocks;
    return (Span){blocks, BLOCK_GRAIN, (int64_t)blocks * m->block_cells * width * NODE_NS};
}

static void restrict_to(const Multilevel *m, Loops *loops, int l, int width, const float *from, float *to, const float *factor)
{
    const TransferJob job = {m, &m->level[l], &m->level[l - 1], from, to, factor, width};
    LOOPS_ADD(loops, span_of(m, l, width), restrict_blocks, &job);
}

/* ---- Down: interpolation ---- */

static inline void load_coarse(const TransferJob *job, int32_t block, float *coarse, int width)
{
    const Multilevel *m = job->m;
    const int depth = m->dimension == 3 ? COARSE : 1;
    const int32_t *c = (const int32_t *)job->finer->coordinate.data + KEY * block;
    const int32_t *parent = (const int32_t *)job->level->parent.data + block * parents_of(m);
    for (int k = 0; k < depth; k++)
        for (int j = 0; j < COARSE; j++)
            for (int i = 0; i < COARSE; i++) {
                const int at[3] = {i + 2 * (c[0] & 1), j + 2 * (c[1] & 1), k + 2 * (c[2] & 1)};
                const int n = (at[0] >> 2) | (at[1] >> 2) << 1 | (at[2] >> 2) << 2;
                const int node = ((at[2] & 3) * K_BLOCK_AXIS + (at[1] & 3)) * K_BLOCK_AXIS + (at[0] & 3);
                const float *from = job->from + (parent[n] * m->block_cells + node) * (ptrdiff_t)width;
                memcpy(coarse + ((k * COARSE + j) * COARSE + i) * width, from, (size_t)width * sizeof(float));
            }
}

/* Lengthens one axis: lines of COARSE elements become lines of K_BLOCK_AXIS. */
static inline void spread_axis(const float *from, float *to, int lines, int width)
{
    for (int line = 0; line < lines; line++)
        for (int j = 0; j < K_BLOCK_AXIS; j++) {
            const float *f = from + (line * COARSE + j / 2) * width, *next = f + (j % 2) * width;
            float *t = to + (line * K_BLOCK_AXIS + j) * width;
            for (int c = 0; c < width; c++) t[c] = 0.5f * (f[c] + next[c]);
        }
}

static inline void prolong_block(const TransferJob *job, int32_t block, int width)
{
    const bool deep = job->m->dimension == 3;
    const int floats = job->m->block_cells * width;
    float coarse[COARSE * COARSE * COARSE * W], flat[COARSE * COARSE * K_BLOCK_AXIS * W], thin[COARSE * K_BLOCK_AXIS * K_BLOCK_AXIS * W];
    float fine[K_BLOCK_AXIS * K_BLOCK_AXIS * K_BLOCK_AXIS * W], *to = job->to + (size_t)block * (size_t)floats;
    load_coarse(job, block, coarse, width);
    spread_axis(coarse, flat, deep ? COARSE * COARSE : COARSE, width);
    spread_axis(flat, deep ? thin : fine, deep ? COARSE : 1, K_BLOCK_AXIS * width);
    if (deep) spread_axis(thin, fine, 1, K_BLOCK_AXIS * K_BLOCK_AXIS * width);
    for (int i = 0; i < floats; i++) to[i] += fine[i];
}

static void prolong_blocks(void *context, int32_t begin, int32_t end)
{
    const TransferJob *job = context;
    const int32_t *parent = job->level->parent.data;
    for (int32_t block = begin; block < end; block++) {
        scale_block(job, block);
        if (parent[block * parents_of(job->m)] < 0) continue; /* its body has no coarser hats */
        if (job->width == 1)
            prolong_block(job, block, 1);
        else
            prolong_block(job, block, W);
    }
}

static void prolong_from(const Multilevel *m, Loops *loops, int l, const float *from, float *to, const float *factor)
{
    const TransferJob job = {m, &m->level[l], &m->level[l - 1], from, to, factor, m->width};
    LOOPS_ADD(loops, span_of(m, l - 1, m->width), prolong_blocks, &job);
}

/* ---- The operator ---- */

typedef struct InvertJob {
    const float *stiffness; /* restricted, one per node */
    float *inverse;         /* in: the restricted masses */
    float mass_factor, stiffness_factor;
    int cells, width;
} InvertJob;

static void invert_blocks(void *context, int32_t begin, int32_t end)
{
    const InvertJob *job = context;
    for (int32_t node = begin * job->cells; node < end * job->cells; node++)
        for (int c = 0; c < job->width; c++) {
            float *value = job->inverse + (ptrdiff_t)node * job->width + c;
            const float energy = job->mass_factor * *value + job->stiffness_factor * job->stiffness[node];
            *value = energy > 1e-30f ? 1.0f / energy : 0.0f;
        }
}

void multilevel_weigh(const Multilevel *m, Loops *loops, const float *mass, const float *stiffness, double overlap)
{
    const double d = m->dimension;
    for (int l = 1; l < m->levels; l++) {
        const Level *level = &m->level[l], *finer = &m->level[l - 1];
        restrict_to(m, loops, l, m->width, l == 1 ? mass : finer->inverse.data, level->inverse.data, NULL);
        restrict_to(m, loops, l, 1, l == 1 ? stiffness : finer->vector.data, level->vector.data, NULL);
    }
    for (int l = 1; l < m->levels; l++) {
        const InvertJob job = {m->level[l].vector.data, m->level[l].inverse.data, (float)pow(2.0 / 3.0, d),
                               (float)(overlap * 0.5 * d * pow(2.0 / 3.0, d - 1.0) * pow(0.25, l)), m->block_cells, m->width};
        LOOPS_ADD(loops, span_of(m, l, m->width), invert_blocks, &job);
    }
}

/* On the way down each level is scaled before the next coarser one is added; nothing comes to the coarsest, which is scaled at once. */
void multilevel_add(const Multilevel *m, Loops *loops, const float *r, float *z)
{
    const int last = m->levels - 1;
    for (int l = 1; l <= last; l++)
        restrict_to(m, loops, l, m->width, l == 1 ? r : m->level[l - 1].vector.data, m->level[l].vector.data, l == last ? m->level[l].inverse.data : NULL);
    for (int l = last; l > 1; l--) prolong_from(m, loops, l, m->level[l].vector.data, m->level[l - 1].vector.data, m->level[l - 1].inverse.data);
    if (last >= 1) prolong_from(m, loops, 1, m->level[1].vector.data, z, NULL);
}
