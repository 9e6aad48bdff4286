#include "skin/field.h"

#include <string.h>

enum { FIELD_GRAIN = 4 };

void field_volume(const SkinMatter *matter, uint32_t row, uint32_t count, int channel, float *amount)
{
    (void)channel;
    for (uint32_t i = 0; i < count; i++) amount[i] = matter_volume(matter, row + i);
}

/* ---- Particles to points ---- */

void field_splat_rest(const FieldWork *work, FieldSplat *splat)
{
    if (splat->count > 0) work->kernels->splat(splat->place[0], splat->place[1], splat->place[2], splat->amount, splat->count, splat->box);
    splat->count = 0;
}

void field_splat(const FieldWork *work, FieldSplat *splat, const float local[3], float amount)
{
    for (int a = 0; a < 3; a++) splat->place[a][splat->count] = local[a];
    splat->amount[splat->count++] = amount;
    if (splat->count == SPLAT_MOST) field_splat_rest(work, splat);
}

typedef struct SplatJob {
    const FieldWork *work;
    FieldAmount *amount;
    int channel;
    int axis;
    const float *from;
    float *to, *changed; /* where numbers go, in the end also those of blocks that are changed */
} SplatJob;

float field_points_per_cell(const SkinBlocks *blocks)
{
    return (float)(blocks->subdivision * blocks->subdivision * blocks->subdivision);
}

static void splat_rows(const SplatJob *job, const SkinBlock *block, uint32_t row, uint32_t count, FieldSplat *splat)
{
    const SkinBlocks *blocks = job->work->blocks;
    const float scale = field_points_per_cell(blocks), spacing = (float)blocks->subdivision;
    const Particles *p = job->work->matter->particles;
    for (int a = 0; a < 3; a++) {
        const int32_t first = lattice_first(blocks->subdivision, block->place[a]), *cell = p->cell[a] + row;
        const float *fraction = p->fraction[a] + row;
        for (uint32_t i = 0; i < count; i++) splat->place[a][i] = spacing * ((float)(cell[i] - first) + fraction[i]);
    }
    job->amount(job->work->matter, row, count, job->channel, splat->amount);
    for (uint32_t i = 0; i < count; i++) splat->amount[i] *= scale;
    splat->count = (int)count;
    field_splat_rest(job->work, splat);
}

static void splat_blocks(void *context, int32_t begin, int32_t end)
{
    const SplatJob *job = context;
    const SkinBlocks *blocks = job->work->blocks;
    for (int32_t i = begin; i < end; i++) {
        SkinBlock *block = blocks_at(blocks, blocks_number(blocks, i));
        FieldSplat splat = {.box = job->work->boxes + (size_t)i * BOX_POINTS, .count = 0};
        block->splatted = block->helps ? block->cells : cells_none();
        if (!cells_any(&block->splatted)) continue;
        memset(splat.box, 0, BOX_POINTS * sizeof *splat.box);
        for (uint32_t r = 0; r < block->runs; r++) {
            const SiteRun *run = blocks_run(blocks, block->first_run + r);
            for (uint32_t row = run->begin; row < run->end; row += SPLAT_MOST)
                splat_rows(job, block, row, run->end - row < SPLAT_MOST ? run->end - row : SPLAT_MOST, &splat);
        }
    }
}

/* ---- Points to the lattice ---- */

static void sum_blocks(void *context, int32_t begin, int32_t end)
{
    const SplatJob *job = context;
    const SkinBlocks *blocks = job->work->blocks;
    for (int32_t i = begin; i < end; i++) {
        const int32_t b = blocks_number(blocks, i);
        SkinBlock *block = blocks_at(blocks, b);
        block->wanted = false;
        if (!block->helps) continue;
        blocks_find_reached(blocks, block);
        block->wanted = cells_any(&block->reached);
        if (block->wanted) blocks_sum(blocks, job->work->kernels, block, job->work->boxes, job->work->sums + (size_t)b * BLOCK_POINTS);
    }
}

/* That of S; and (1, 3, 3, 1) / 8 and that of S in one. */
static const SurfaceFilter filter_of[3] = {{0}, {2, -1, 1, {-0.125f, 0.625f}}, {4, -4, 3, {-1 / 64.0f, -3 / 64.0f, 7 / 64.0f, 29 / 64.0f}}};

/* The points of a neighbour along an axis, -1, 0 or 1. */
static const float *points_beside(const SplatJob *job, const SkinBlock *block, int side)
{
    static const int step[3] = {1, 3, 9};
    static const float nothing[BLOCK_POINTS];
    const int32_t other = block->neighbour[BLOCK_NEIGHBOURS / 2 + side * step[job->axis]];
    return other != GRID_NOWHERE && blocks_at(job->work->blocks, other)->wanted ? job->from + (size_t)other * BLOCK_POINTS : nothing;
}

void field_close_off(const SkinBlock *block, float values[BLOCK_POINTS])
{
    for (int n = 0; n < BLOCK_NEIGHBOURS / 2; n++) {
        int32_t way[3];
        if (block->neighbour[n] != GRID_NOWHERE) continue;
        grid_neighbour_offset(n, 3, way);
        if (way[0] > 0 || way[1] > 0 || way[2] > 0) continue;
        for (int z = 0; z < (way[2] ? 1 : BLOCK_AXIS); z++)
            for (int y = 0; y < (way[1] ? 1 : BLOCK_AXIS); y++)
                for (int x = 0; x < (way[0] ? 1 : BLOCK_AXIS); x++) values[(z * BLOCK_AXIS + y) * BLOCK_AXIS + x] = 0.0f;
    }
}

/* Whether the rows along x within a range are all that a block has: the filter writes whole rows. */
static bool covers_planes(const CellBox *range)
{
    return range->low[1] == 0 && range->high[1] == BLOCK_AXIS - 1 && range->low[2] == 0 && range->high[2] == BLOCK_AXIS - 1;
}

static void filter_blocks(void *context, int32_t begin, int32_t end)
{
    const SplatJob *job = context;
    const SkinBlocks *blocks = job->work->blocks;
    for (int32_t i = begin; i < end; i++) {
        const int32_t b = blocks_number(blocks, i);
        const SkinBlock *block = blocks_at(blocks, b);
        const float *const beside[3] = {points_beside(job, block, -1), points_beside(job, block, 0), points_beside(job, block, 1)};
        float *out = (job->axis == 2 && block->changed ? job->changed : job->to) + (size_t)b * BLOCK_POINTS;
        if (!block->wanted || (job->axis == 2 && !block->due)) continue; /* who only helps keeps its values */
        if (!covers_planes(&block->reached)) memset(out, 0, BLOCK_POINTS * sizeof *out);
        job->work->kernels->filter(&filter_of[blocks->subdivision], &block->reached, job->axis, beside, out);
    }
}

/* Along x to `lines`, along y back, along z to where it goes. */
static void collect(SplatJob *job, float *values, float *changed)
{
    const FieldWork *work = job->work;
    float *stage[4] = {work->sums, work->lines, work->sums, values};
    job->changed = changed;
    pool_for(work->pool, work->blocks->count, FIELD_GRAIN, sum_blocks, job);
    for (job->axis = 0; job->axis < 3; job->axis++) {
        job->from = stage[job->axis];
        job->to = stage[job->axis + 1];
        pool_for(work->pool, work->blocks->count, FIELD_GRAIN, filter_blocks, job);
    }
}

void field_collect(const FieldWork *work, float *values, float *changed)
{
    SplatJob job = {.work = work};
    collect(&job, values, changed);
}

bool field_store(float kept[BLOCK_POINTS], const float made[BLOCK_POINTS])
{
    if (memcmp(kept, made, BLOCK_POINTS * sizeof *made) == 0) return false;
    memcpy(kept, made, BLOCK_POINTS * sizeof *made);
    return true;
}

static void make(SplatJob *job, float *values)
{
    pool_for(job->work->pool, job->work->blocks->with_rows, FIELD_GRAIN, splat_blocks, job);
    collect(job, values, values);
}

static void bound_blocks(void *context, int32_t begin, int32_t end)
{
    const FieldWork *work = context;
    for (int32_t i = begin; i < end; i++) {
        const int32_t b = blocks_number(work->blocks, i);
        SkinBlock *block = blocks_at(work->blocks, b);
        float *values = work->filling + (size_t)b * BLOCK_POINTS;
        block->changed = block->due;
        if (!block->due) continue;
        field_close_off(block, values);
        work->kernels->bound(values, &block->filling_least, &block->filling_most);
    }
}

void field_fill(const FieldWork *work)
{
    SplatJob job = {.work = work, .amount = field_volume};
    blocks_spread(work->blocks, work->pool, offsetof(SkinBlock, changed), offsetof(SkinBlock, due));
    blocks_spread(work->blocks, work->pool, offsetof(SkinBlock, due), offsetof(SkinBlock, helps));
    make(&job, work->filling);
    pool_for(work->pool, work->blocks->count, FIELD_GRAIN, bound_blocks, (void *)(uintptr_t)work);
}

static void choose_near_surface(void *context, int32_t begin, int32_t end)
{
    const SkinBlocks *blocks = context;
    for (int32_t i = begin; i < end; i++) {
        SkinBlock *block = blocks_at(blocks, blocks_number(blocks, i));
        block->due = block->helps = blocks_near_surface(blocks, block);
    }
}

void field_make(const FieldWork *work, FieldAmount *amount, int channel, float *values)
{
    SplatJob job = {.work = work, .amount = amount, .channel = channel};
    pool_for(work->pool, work->blocks->count, FIELD_GRAIN, choose_near_surface, work->blocks);
    make(&job, values);
}
