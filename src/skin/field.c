#include "skin/field.h"

#include <string.h>

enum { FIELD_GRAIN = 4 };

float field_volume(const SkinMatter *matter, uint32_t row, int channel)
{
    (void)channel;
    return matter_volume(matter, row);
}

/* ---- Particles to points ---- */

/* Four numbers that are worked on at once; gcc and clang have them on any machine. */
typedef float Four __attribute__((vector_size(16)));

/* The quadratic spline at three points, the middle one of which is at -r. */
static Four spline(float r)
{
    const float low = 0.5f - r, high = 0.5f + r;
    return (Four){0.5f * low * low, 0.75f - r * r, 0.5f * high * high, 0.0f};
}

/* Adds to the 27 points around a place; four at a time along x, where the last gets 0. */
static void splat(float *box, const float local[3], float amount)
{
    Four w[3];
    int first[3];
    for (int a = 0; a < 3; a++) {
        first[a] = (int)(local[a] + (float)BOX_MARGIN + 0.5f) - 1;
        w[a] = spline(local[a] + (float)(BOX_MARGIN - 1) - (float)first[a]);
    }
    float *corner = &box[(first[2] * BOX_AXIS + first[1]) * BOX_AXIS + first[0]];
    const Four beside[3] = {w[0] * w[1][0], w[0] * w[1][1], w[0] * w[1][2]};
    for (int k = 0; k < 3; k++) {
        const float share = amount * w[2][k];
        for (int j = 0; j < 3; j++) {
            float *row = &corner[(k * BOX_AXIS + j) * BOX_AXIS];
            Four sum;
            memcpy(&sum, row, sizeof sum);
            sum += share * beside[j];
            memcpy(row, &sum, sizeof sum);
        }
    }
}

typedef struct SplatJob {
    const FieldWork *work;
    FieldAmount *amount;
    int channel;
    float level;
    float *values;
    bool adds, at_surface; /* to what is there; only near the surface */
    int axis;
    const float *from;
    float *to;
    uint8_t *outside;
} SplatJob;

/* A particle's amount is per cell; per point it is as many times as much as there are points in a cell. */
static float points_per_cell(const SkinBlocks *blocks)
{
    return (float)(blocks->subdivision * blocks->subdivision * blocks->subdivision);
}

static void splat_blocks(void *context, int32_t begin, int32_t end)
{
    const SplatJob *job = context;
    const FieldWork *work = job->work;
    const float scale = points_per_cell(work->blocks);
    for (int32_t b = begin; b < end; b++) {
        SkinBlock *block = blocks_at(work->blocks, b);
        float *box = work->boxes + (size_t)b * BOX_POINTS;
        block->splatted = !job->at_surface || blocks_near_surface(work->blocks, block) ? block->cells : cells_none();
        if (!cells_any(&block->splatted)) continue;
        memset(box, 0, BOX_POINTS * sizeof *box);
        for (uint32_t r = 0; r < block->runs; r++) {
            const BlockRun *run = blocks_run(work->blocks, block->first_run + r);
            for (uint32_t row = run->begin; row < run->end; row++) {
                float local[3];
                blocks_locate(work->blocks, block, work->matter->particles, row, local);
                splat(box, local, scale * job->amount(work->matter, row, job->channel));
            }
        }
    }
}

/* ---- Points to the lattice ---- */

static void sum_blocks(void *context, int32_t begin, int32_t end)
{
    const SplatJob *job = context;
    const SkinBlocks *blocks = job->work->blocks;
    for (int32_t b = begin; b < end; b++) {
        SkinBlock *block = blocks_at(blocks, b);
        blocks_find_reached(blocks, block);
        block->wanted = cells_any(&block->reached) && (!job->at_surface || blocks_near_surface(blocks, block));
        if (block->wanted) blocks_sum(blocks, b, job->work->boxes, job->work->sums + (size_t)b * BLOCK_POINTS);
    }
}

/* A symmetric filter: the taps that lie as far from its ends, the outer ones first, and where it begins. */
typedef struct Filter {
    int pairs, first, last;
    float tap[4];
} Filter;

/* That of S; and (1, 3, 3, 1) / 8 and that of S in one. */
static const Filter filter_of[3] = {{0}, {2, -1, 1, {-0.125f, 0.625f}}, {4, -4, 3, {-1 / 64.0f, -3 / 64.0f, 7 / 64.0f, 29 / 64.0f}}};

enum { LINE = 3 * BLOCK_AXIS };

/* The points of a neighbour along an axis, -1, 0 or 1. */
static const float *points_beside(const SplatJob *job, const SkinBlock *block, int side)
{
    static const int step[3] = {1, 3, 9};
    static const float nothing[BLOCK_POINTS];
    const int32_t other = block->neighbour[BLOCK_NEIGHBOURS / 2 + side * step[job->axis]];
    return other != GRID_NOWHERE && blocks_at(job->work->blocks, other)->wanted ? job->from + (size_t)other * BLOCK_POINTS : nothing;
}

/* Eight sums at once: of what the pointers point to, for each tap. */
static inline void add_pair(const Filter *filter, int pair, const float *low, const float *high, float sum[BLOCK_AXIS])
{
    for (int i = 0; i < BLOCK_AXIS; i++) sum[i] += filter->tap[pair] * (low[i] + high[i]);
}

/* Lines are laid out first: what has just been written cannot be read at another offset without waiting. */
static void filter_along_x(const Filter *filter, const CellBox *within, const float *const beside[3], float out[BLOCK_POINTS])
{
    enum { ROWS = BLOCK_AXIS * BLOCK_AXIS };
    float line[ROWS][LINE];
    for (int row = within->low[2] * BLOCK_AXIS; row < (within->high[2] + 1) * BLOCK_AXIS; row++)
        for (int side = 0; side < 3; side++) memcpy(line[row] + side * BLOCK_AXIS, beside[side] + row * BLOCK_AXIS, BLOCK_AXIS * sizeof **line);
    for (int z = within->low[2]; z <= within->high[2]; z++)
        for (int y = within->low[1]; y <= within->high[1]; y++) {
            const float *own = line[z * BLOCK_AXIS + y] + BLOCK_AXIS;
            float sum[BLOCK_AXIS] = {0};
            for (int p = 0; p < filter->pairs; p++) add_pair(filter, p, own + filter->first + p, own + filter->last - p, sum);
            memcpy(out + (z * BLOCK_AXIS + y) * BLOCK_AXIS, sum, sizeof sum);
        }
}

/* Along the axis 1 or 2; rows along x at once. */
static void filter_across_x(const Filter *filter, const CellBox *within, int axis, const float *const beside[3], float out[BLOCK_POINTS])
{
    static const int step[3] = {1, BLOCK_AXIS, BLOCK_AXIS * BLOCK_AXIS};
    const int third = 3 - axis;
    for (int plane = within->low[third]; plane <= within->high[third]; plane++) {
        const float *line[LINE];
        for (int i = 0; i < LINE; i++) line[i] = beside[i / BLOCK_AXIS] + plane * step[third] + i % BLOCK_AXIS * step[axis];
        for (int at = within->low[axis]; at <= within->high[axis]; at++) {
            float sum[BLOCK_AXIS] = {0};
            const float *const *low = &line[BLOCK_AXIS + at + filter->first], *const *high = &line[BLOCK_AXIS + at + filter->last];
            for (int p = 0; p < filter->pairs; p++) add_pair(filter, p, low[p], high[-p], sum);
            memcpy(out + plane * step[third] + at * step[axis], sum, sizeof sum);
        }
    }
}

static void bound_block(SkinBlock *block, const float values[BLOCK_POINTS])
{
    float least[BLOCK_AXIS], most[BLOCK_AXIS];
    memcpy(least, values, sizeof least);
    memcpy(most, values, sizeof most);
    for (int row = BLOCK_AXIS; row < BLOCK_POINTS; row += BLOCK_AXIS)
        for (int i = 0; i < BLOCK_AXIS; i++) {
            least[i] = values[row + i] < least[i] ? values[row + i] : least[i];
            most[i] = values[row + i] > most[i] ? values[row + i] : most[i];
        }
    block->least = least[0];
    block->most = most[0];
    for (int i = 1; i < BLOCK_AXIS; i++) {
        block->least = least[i] < block->least ? least[i] : block->least;
        block->most = most[i] > block->most ? most[i] : block->most;
    }
}

/* Points next to a missing block below are out of all particles' reach, though S may leave a ripple there. They are outside, so that the missing block
 * has no vertices: thus the surface is closed whatever the field is. */
static void close_off(const SkinBlock *block, float values[BLOCK_POINTS])
{
    for (int n = 0; n < BLOCK_NEIGHBOURS / 2; n++) {
        int32_t way[3];
        grid_neighbour_offset(n, 3, way);
        if (block->neighbour[n] != GRID_NOWHERE || way[0] > 0 || way[1] > 0 || way[2] > 0) continue;
        for (int z = 0; z < (way[2] ? 1 : BLOCK_AXIS); z++)
            for (int y = 0; y < (way[1] ? 1 : BLOCK_AXIS); y++)
                for (int x = 0; x < (way[0] ? 1 : BLOCK_AXIS); x++) values[(z * BLOCK_AXIS + y) * BLOCK_AXIS + x] = 0.0f;
    }
}

static void filter_line(const SplatJob *job, const SkinBlock *block, float out[BLOCK_POINTS])
{
    const Filter *filter = &filter_of[job->work->blocks->subdivision];
    const float *beside[3];
    for (int side = 0; side < 3; side++) beside[side] = points_beside(job, block, side - 1);
    memset(out, 0, BLOCK_POINTS * sizeof *out);
    if (job->axis == 0)
        filter_along_x(filter, &block->reached, beside, out);
    else
        filter_across_x(filter, &block->reached, job->axis, beside, out);
}

static void filter_blocks(void *context, int32_t begin, int32_t end)
{
    const SplatJob *job = context;
    for (int32_t b = begin; b < end; b++) {
        const SkinBlock *block = blocks_at(job->work->blocks, b);
        if (block->wanted) filter_line(job, block, job->to + (size_t)b * BLOCK_POINTS);
    }
}

static void filter_last(void *context, int32_t begin, int32_t end)
{
    const SplatJob *job = context;
    for (int32_t b = begin; b < end; b++) {
        SkinBlock *block = blocks_at(job->work->blocks, b);
        float more[BLOCK_POINTS], *to = job->to + (size_t)b * BLOCK_POINTS;
        if (!block->wanted) continue;
        filter_line(job, block, job->adds ? more : to);
        for (int i = 0; i < BLOCK_POINTS && job->adds; i++) to[i] += more[i];
        if (job->at_surface) continue;
        close_off(block, to);
        bound_block(block, to);
    }
}

/* Along x to `lines`, along y back, along z to the values. */
static void collect(SplatJob *job)
{
    const FieldWork *work = job->work;
    const int32_t count = work->blocks->count;
    float *stage[4] = {work->sums, work->lines, work->sums, job->values};
    pool_for(work->pool, count, FIELD_GRAIN, sum_blocks, job);
    for (job->axis = 0; job->axis < 3; job->axis++) {
        job->from = stage[job->axis];
        job->to = stage[job->axis + 1];
        pool_for(work->pool, count, FIELD_GRAIN, job->axis == 2 ? filter_last : filter_blocks, job);
    }
}

void field_make(const FieldWork *work, FieldAmount *amount, int channel, bool at_surface, float *values)
{
    SplatJob job = {.work = work, .amount = amount, .channel = channel, .at_surface = at_surface, .values = values};
    pool_for(work->pool, work->blocks->with_rows, FIELD_GRAIN, splat_blocks, &job);
    collect(&job);
}

/* ---- Thin matter ----
 *
 * A layer of single particles fills no more than 0.45, and F = 1/2 is nowhere. So particles in thin matter count more: s = max(1, c L / F(x_p)) times, at the level L.
 * A layer of particles a cell's half apart has the profile F(z) = s/2 g(z) with g = S W: g(0) = 29/32, g(1/4) = 105/128. So with c = g(0) / g(1/4) = 116/105 the surface F = L
 * is 1/4 from its middle, where it belongs. Inside matter and at flat surfaces, where F(x_p) is 0.74, s is 1; at corners, which the spline rounds, it is larger.
 * A thread of particles asks for s = 2.7, and a particle alone for 6: a ball that the lattice would catch by chance. s is at most 4, so that one is no part of the
 * surface but spray; see points.c. */

static const float THIN_SHARE = 116.0f / 105.0f; /* c */
static const float THICKEN_MOST = 4.0f;          /* between the 2.7 of a thread and the 6 of a lone particle */

/* F at a place, between the 8 points around it. */
static float between(const float box[BOX_POINTS], const float local[3], float shift)
{
    int first[3];
    float t[3], along[4];
    for (int a = 0; a < 3; a++) {
        const float at = local[a] + shift + (float)BOX_MARGIN;
        first[a] = (int)at;
        t[a] = at - (float)first[a];
    }
    const float *corner = &box[(first[2] * BOX_AXIS + first[1]) * BOX_AXIS + first[0]];
    for (int k = 0; k < 4; k++) {
        const float *pair = corner + (k / 2 * BOX_AXIS + k % 2) * BOX_AXIS;
        along[k] = pair[0] + t[0] * (pair[1] - pair[0]);
    }
    const float near = along[0] + t[1] * (along[1] - along[0]), far = along[2] + t[1] * (along[3] - along[2]);
    return near + t[2] * (far - near);
}

static void find_outside(void *context, int32_t begin, int32_t end)
{
    const SplatJob *job = context;
    const FieldWork *work = job->work;
    for (int32_t b = begin; b < end; b++) {
        const SkinBlock *block = blocks_at(work->blocks, b);
        float near[BOX_POINTS], local[3];
        blocks_gather(block, job->values, near);
        for (uint32_t r = 0; r < block->runs; r++) {
            const BlockRun *run = blocks_run(work->blocks, block->first_run + r);
            for (uint32_t row = run->begin; row < run->end; row++) {
                blocks_locate(work->blocks, block, work->matter->particles, row, local);
                job->outside[row] = between(near, local, field_shift(work->blocks)) < job->level;
            }
        }
    }
}

void field_find_outside(const FieldWork *work, float level, const float *values, uint8_t *outside)
{
    SplatJob job = {.work = work, .level = level, .values = (float *)values, .outside = outside};
    pool_for(work->pool, work->blocks->with_rows, FIELD_GRAIN, find_outside, &job);
}

/* Whether F is large enough wherever a particle of the block may be. */
static bool is_thick(const SkinBlocks *blocks, const SkinBlock *block, float enough)
{
    for (int n = 0; n < BLOCK_NEIGHBOURS; n++)
        if (block->neighbour[n] == GRID_NOWHERE || blocks_at(blocks, block->neighbour[n])->least < enough) return false;
    return true;
}

static void take_least(float *least, const float *other, int count)
{
    for (int i = 0; i < count; i++) least[i] = other[i] < least[i] ? other[i] : least[i];
}

/* The least of the points around each cell of a block, axis by axis: F of a particle in it is no less. */
static void least_of_cells(const SkinBlocks *blocks, const float near[BOX_POINTS], float cell[BLOCK_POINTS])
{
    const int cells = blocks_cells(blocks), points = blocks->subdivision + 2, plane = BOX_AXIS * BOX_AXIS;
    for (int z = 0; z < cells; z++) {
        float slab[BOX_AXIS * BOX_AXIS];
        const float *from = near + (z * blocks->subdivision + BOX_MARGIN - 1) * plane;
        memcpy(slab, from, sizeof slab);
        for (int k = 1; k < points; k++) take_least(slab, from + k * plane, plane);
        for (int y = 0; y < cells; y++) {
            float row[BOX_AXIS];
            const float *beside = slab + (y * blocks->subdivision + BOX_MARGIN - 1) * BOX_AXIS;
            memcpy(row, beside, sizeof row);
            for (int k = 1; k < points; k++) take_least(row, beside + k * BOX_AXIS, BOX_AXIS);
            for (int x = 0; x < cells; x++) {
                float *least = &cell[(z * BLOCK_AXIS + y) * BLOCK_AXIS + x];
                const float *along = row + x * blocks->subdivision + BOX_MARGIN - 1;
                *least = along[0];
                for (int k = 1; k < points; k++) take_least(least, along + k, 1);
            }
        }
    }
}

static void thicken_block(const SplatJob *job, SkinBlock *block, float *box)
{
    const FieldWork *work = job->work;
    const float enough = THIN_SHARE * job->level, scale = points_per_cell(work->blocks), shift = field_shift(work->blocks);
    float near[BOX_POINTS], least[BLOCK_POINTS];
    blocks_gather(block, job->values, near);
    least_of_cells(work->blocks, near, least);
    for (uint32_t r = 0; r < block->runs; r++) {
        const BlockRun *run = blocks_run(work->blocks, block->first_run + r);
        for (uint32_t row = run->begin; row < run->end; row++) {
            float local[3];
            int32_t cell[3];
            blocks_cell(work->blocks, block, work->matter->particles, row, cell);
            if (least[(cell[2] * BLOCK_AXIS + cell[1]) * BLOCK_AXIS + cell[0]] >= enough) continue;
            blocks_locate(work->blocks, block, work->matter->particles, row, local);
            const float filling = between(near, local, shift);
            if (filling >= enough) continue;
            if (!cells_any(&block->splatted)) memset(box, 0, BOX_POINTS * sizeof *box);
            const float times = THICKEN_MOST * filling > enough ? enough / filling : THICKEN_MOST;
            splat(box, local, (times - 1.0f) * scale * matter_volume(work->matter, row));
            cells_add(&block->splatted, cell);
        }
    }
}

static void thicken_blocks(void *context, int32_t begin, int32_t end)
{
    const SplatJob *job = context;
    for (int32_t b = begin; b < end; b++) {
        SkinBlock *block = blocks_at(job->work->blocks, b);
        block->splatted = cells_none();
        if (!is_thick(job->work->blocks, block, THIN_SHARE * job->level)) thicken_block(job, block, job->work->boxes + (size_t)b * BOX_POINTS);
    }
}

void field_thicken(const FieldWork *work, float level, float *values)
{
    SplatJob job = {.work = work, .level = level, .values = values, .adds = true};
    pool_for(work->pool, work->blocks->with_rows, FIELD_GRAIN, thicken_blocks, &job);
    collect(&job);
}
