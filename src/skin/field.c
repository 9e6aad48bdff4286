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
    bool adds, at_surface;
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
    const FieldWork *work = job->work;
    for (int32_t b = begin; b < end; b++) {
        blocks_at(work->blocks, b)->summed = blocks_sum(work->blocks, b, work->boxes, work->sums + (size_t)b * BLOCK_POINTS);
    }
}

/* Point k of a block from those at k - 2 to k + 1, one axis after the other: in place, since what is read lies behind what is written. */
static void filter(float box[BOX_POINTS])
{
    const int row = BOX_AXIS, plane = BOX_AXIS * BOX_AXIS;
    for (int at = 0; at + 3 * plane < BOX_POINTS; at++) box[at] = 0.125f * (box[at] + box[at + 3 * plane]) + 0.375f * (box[at + plane] + box[at + 2 * plane]);
    for (int at = 0; at + 3 * row < BLOCK_AXIS * plane; at++)
        box[at] = 0.125f * (box[at] + box[at + 3 * row]) + 0.375f * (box[at + row] + box[at + 2 * row]);
    for (int at = 0; at + 3 < (BLOCK_AXIS - 1) * plane + BLOCK_AXIS * row; at++)
        box[at] = 0.125f * (box[at] + box[at + 3]) + 0.375f * (box[at + 1] + box[at + 2]);
}

/* Whether anything was given to a block or one beside it. */
static bool has_sums(const SkinBlocks *blocks, const SkinBlock *block)
{
    for (int n = 0; n < BLOCK_NEIGHBOURS; n++)
        if (block->neighbour[n] != GRID_NOWHERE && blocks_at(blocks, block->neighbour[n])->summed) return true;
    return false;
}

static void filter_blocks(void *context, int32_t begin, int32_t end)
{
    const SplatJob *job = context;
    const FieldWork *work = job->work;
    for (int32_t b = begin; b < end; b++) {
        float box[BOX_POINTS];
        float *values = job->values + (size_t)b * BLOCK_POINTS;
        if (job->adds && !has_sums(work->blocks, blocks_at(work->blocks, b))) continue;
        blocks_gather(blocks_at(work->blocks, b), work->sums, box);
        /* After it point k of the block stands at k of the box. */
        if (work->blocks->subdivision == 2) filter(box);
        const int first = work->blocks->subdivision == 2 ? 0 : BOX_MARGIN;
        for (int k = 0; k < BLOCK_AXIS; k++)
            for (int j = 0; j < BLOCK_AXIS; j++) {
                const float *from = &box[((k + first) * BOX_AXIS + j + first) * BOX_AXIS + first];
                float *to = &values[(k * BLOCK_AXIS + j) * BLOCK_AXIS];
                for (int i = 0; i < BLOCK_AXIS; i++) to[i] = job->adds ? to[i] + from[i] : from[i];
            }
    }
}

static void collect(SplatJob *job)
{
    const FieldWork *work = job->work;
    pool_for(work->pool, work->blocks->count, FIELD_GRAIN, sum_blocks, job);
    pool_for(work->pool, work->blocks->count, FIELD_GRAIN, filter_blocks, job);
}

void field_make(const FieldWork *work, FieldAmount *amount, int channel, bool at_surface, float *values)
{
    SplatJob job = {.work = work, .amount = amount, .channel = channel, .at_surface = at_surface, .values = values};
    pool_for(work->pool, work->blocks->with_rows, FIELD_GRAIN, splat_blocks, &job);
    collect(&job);
}

/* ---- Bounds ---- */

static void bound_blocks(void *context, int32_t begin, int32_t end)
{
    const SplatJob *job = context;
    for (int32_t b = begin; b < end; b++) {
        SkinBlock *block = blocks_at(job->work->blocks, b);
        const float *values = job->values + (size_t)b * BLOCK_POINTS;
        block->least = block->most = values[0];
        for (int i = 1; i < BLOCK_POINTS; i++) {
            block->least = values[i] < block->least ? values[i] : block->least;
            block->most = values[i] > block->most ? values[i] : block->most;
        }
    }
}

void field_bound(const FieldWork *work, const float *values)
{
    SplatJob job = {.work = work, .values = (float *)values};
    pool_for(work->pool, work->blocks->count, FIELD_GRAIN, bound_blocks, &job);
}

/* ---- Thin matter ----
 *
 * A layer of single particles fills no more than 3/8, and F = 1/2 is nowhere. So particles in thin matter count more: s = max(1, c L / F(x_p)) times, at the level L. A layer
 * of particles a cell's half apart has the profile F(z) = F(0) w(z) / w(0), and w(0) / w(1/4) = 12/11. So with c = 12/11 the surface F = L is 1/4 from
 * its middle, where it belongs. On a thread of particles it is 1 % of a cell too near. Inside matter and at flat surfaces, where F(x_p) is 0.68, s is 1;
 * at edges and corners, which the spline rounds, it is larger.
 * A thread asks for s = 3.9, and a particle alone for 10: a ball that the lattice would catch by chance. s is at most 4, so it is no part of the surface but spray; see splats.h. */

static const float THIN_SHARE = 12.0f / 11.0f, THICKEN_MOST = 4.0f;

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
