#include "skin/field.h"

#include <string.h>

enum { FIELD_GRAIN = 4 };

float field_volume(const SkinMatter *matter, uint32_t row, int channel)
{
    (void)channel;
    return matter_volume(matter, row);
}

/* ---- Particles to points ---- */

/* Adds to the 27 points around a place; four at a time along x, where the last gets 0. */
static void splat(float *box, const float local[3], float amount)
{
    float w[3][4];
    int first[3];
    for (int a = 0; a < 3; a++) {
        first[a] = (int)(local[a] + (float)BOX_MARGIN + 0.5f) - 1;
        const float r = local[a] + (float)(BOX_MARGIN - 1) - (float)first[a];
        w[a][0] = 0.5f * (0.5f - r) * (0.5f - r);
        w[a][1] = 0.75f - r * r;
        w[a][2] = 0.5f * (0.5f + r) * (0.5f + r);
        w[a][3] = 0.0f;
    }
    float *corner = &box[(first[2] * BOX_AXIS + first[1]) * BOX_AXIS + first[0]];
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < 3; j++) {
            const float share = amount * w[2][k] * w[1][j];
            float *row = &corner[(k * BOX_AXIS + j) * BOX_AXIS];
            for (int i = 0; i < 4; i++) row[i] += share * w[0][i];
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
        block->splatted = !job->at_surface || blocks_near_surface(work->blocks, block);
        if (!block->splatted) continue;
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
    for (int32_t b = begin; b < end; b++) blocks_at(blocks, b)->summed = blocks_sum(blocks, b, job->work->boxes, job->work->sums + (size_t)b * BLOCK_POINTS);
}

static void choose_blocks(void *context, int32_t begin, int32_t end)
{
    const SplatJob *job = context;
    const SkinBlocks *blocks = job->work->blocks;
    for (int32_t b = begin; b < end; b++) {
        SkinBlock *block = blocks_at(blocks, b);
        block->wanted = job->at_surface ? blocks_near_surface(blocks, block) : !job->adds || blocks_near_sums(blocks, block);
    }
}

enum { TAPS = 8, LINE = 3 * BLOCK_AXIS };

/* The filter of S, and that of (1, 3, 3, 1) / 8 and S. A tap is for the point that is so far below: the first for that `below` points below. */
static const struct {
    int taps, below;
    float tap[TAPS];
} filter_of[3] = {{0},
                  {3, 1, {-0.125f, 1.25f, -0.125f}},
                  {8, 4, {-1 / 64.0f, -3 / 64.0f, 7 / 64.0f, 29 / 64.0f, 29 / 64.0f, 7 / 64.0f, -3 / 64.0f, -1 / 64.0f}}};

/* The points of a neighbour along an axis, -1, 0 or 1; null if nothing is there. */
static const float *points_beside(const SplatJob *job, const SkinBlock *block, int side)
{
    static const int step[3] = {1, 3, 9};
    const int32_t other = block->neighbour[BLOCK_NEIGHBOURS / 2 + side * step[job->axis]];
    return other != GRID_NOWHERE && blocks_at(job->work->blocks, other)->wanted ? job->from + (size_t)other * BLOCK_POINTS : NULL;
}

static void filter_along_x(const SplatJob *job, const float *const beside[3], float out[BLOCK_POINTS])
{
    const int subdivision = job->work->blocks->subdivision, taps = filter_of[subdivision].taps, first = BLOCK_AXIS - filter_of[subdivision].below;
    for (int row = 0; row < BLOCK_POINTS; row += BLOCK_AXIS) {
        float line[LINE], sum[BLOCK_AXIS] = {0};
        for (int side = 0; side < 3; side++)
            for (int i = 0; i < BLOCK_AXIS; i++) line[side * BLOCK_AXIS + i] = beside[side] ? beside[side][row + i] : 0.0f;
        for (int t = 0; t < taps; t++)
            for (int i = 0; i < BLOCK_AXIS; i++) sum[i] += filter_of[subdivision].tap[t] * line[first + t + i];
        memcpy(out + row, sum, sizeof sum);
    }
}

/* Rows along x at once; `step` leads from one point of the axis to the next. */
static void filter_across_x(const SplatJob *job, const float *const beside[3], int step, float out[BLOCK_POINTS])
{
    const int subdivision = job->work->blocks->subdivision, taps = filter_of[subdivision].taps;
    for (int row = 0; row < BLOCK_POINTS; row += BLOCK_AXIS) {
        const int at = row / step % BLOCK_AXIS, others = row - at * step;
        float sum[BLOCK_AXIS] = {0};
        for (int t = 0; t < taps; t++) {
            const int point = at + t - filter_of[subdivision].below + BLOCK_AXIS;
            const float *points = beside[point / BLOCK_AXIS];
            if (!points) continue;
            points += others + point % BLOCK_AXIS * step;
            for (int i = 0; i < BLOCK_AXIS; i++) sum[i] += filter_of[subdivision].tap[t] * points[i];
        }
        memcpy(out + row, sum, sizeof sum);
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

static void filter_blocks(void *context, int32_t begin, int32_t end)
{
    const SplatJob *job = context;
    static const int step[3] = {1, BLOCK_AXIS, BLOCK_AXIS * BLOCK_AXIS};
    for (int32_t b = begin; b < end; b++) {
        SkinBlock *block = blocks_at(job->work->blocks, b);
        if (!block->wanted) continue;
        const float *beside[3];
        float out[BLOCK_POINTS], *to = job->to + (size_t)b * BLOCK_POINTS;
        for (int side = 0; side < 3; side++) beside[side] = points_beside(job, block, side - 1);
        if (job->axis == 0)
            filter_along_x(job, beside, out);
        else
            filter_across_x(job, beside, step[job->axis], out);
        for (int i = 0; i < BLOCK_POINTS; i++) to[i] = job->adds && job->axis == 2 ? to[i] + out[i] : out[i];
        if (job->axis == 2 && !job->at_surface) bound_block(block, to);
    }
}

/* Along x to `lines`, along y back, along z to the values. */
static void collect(SplatJob *job)
{
    const FieldWork *work = job->work;
    const int32_t count = work->blocks->count;
    float *stage[4] = {work->sums, work->lines, work->sums, job->values};
    pool_for(work->pool, count, FIELD_GRAIN, sum_blocks, job);
    pool_for(work->pool, count, FIELD_GRAIN, choose_blocks, job);
    for (job->axis = 0; job->axis < 3; job->axis++) {
        job->from = stage[job->axis];
        job->to = stage[job->axis + 1];
        pool_for(work->pool, count, FIELD_GRAIN, filter_blocks, job);
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

static const float THIN_SHARE = 116.0f / 105.0f, THICKEN_MOST = 4.0f;

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

static void thicken_block(const SplatJob *job, SkinBlock *block, float *box)
{
    const FieldWork *work = job->work;
    const float enough = THIN_SHARE * job->level, scale = points_per_cell(work->blocks), shift = field_shift(work->blocks);
    float near[BOX_POINTS];
    blocks_gather(block, job->values, near);
    memset(box, 0, BOX_POINTS * sizeof *box);
    for (uint32_t r = 0; r < block->runs; r++) {
        const BlockRun *run = blocks_run(work->blocks, block->first_run + r);
        for (uint32_t row = run->begin; row < run->end; row++) {
            float local[3];
            blocks_locate(work->blocks, block, work->matter->particles, row, local);
            const float filling = between(near, local, shift);
            if (filling >= enough) continue;
            const float times = THICKEN_MOST * filling > enough ? enough / filling : THICKEN_MOST;
            splat(box, local, (times - 1.0f) * scale * matter_volume(work->matter, row));
            block->splatted = true;
        }
    }
}

static void thicken_blocks(void *context, int32_t begin, int32_t end)
{
    const SplatJob *job = context;
    for (int32_t b = begin; b < end; b++) {
        SkinBlock *block = blocks_at(job->work->blocks, b);
        block->splatted = false;
        if (!is_thick(job->work->blocks, block, THIN_SHARE * job->level)) thicken_block(job, block, job->work->boxes + (size_t)b * BOX_POINTS);
    }
}

void field_thicken(const FieldWork *work, float level, float *values)
{
    SplatJob job = {.work = work, .level = level, .values = values, .adds = true};
    pool_for(work->pool, work->blocks->with_rows, FIELD_GRAIN, thicken_blocks, &job);
    collect(&job);
}
