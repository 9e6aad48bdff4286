#include "skin/thin.h"

#include <math.h>
#include <string.h>

enum { THIN_GRAIN = 4 };

/* F at a particle alone, which fills an eighth of a cell. */
static const float ALONE = 29.0f * 29.0f * 29.0f / (32.0f * 32.0f * 32.0f * 8.0f);
/* c and the most of s, see thin.h. */
static const float THIN_SHARE = 116.0f / 105.0f, THICKEN_MOST = 4.0f;
/* The most of k: with it s is up to 7, and a particle alone would ask for 6. */
static const float SHARE_MOST = 2.0f;

static size_t first_point(int32_t b) { return (size_t)b * BLOCK_POINTS; }

/* ---- T ---- */

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

/* Whether F is large enough wherever a particle of the block may be. */
static bool is_thick(const SkinBlocks *blocks, const SkinBlock *block, float enough)
{
    for (int n = 0; n < BLOCK_NEIGHBOURS; n++)
        if (block->neighbour[n] == GRID_NOWHERE || blocks_at(blocks, block->neighbour[n])->filling_least < enough) return false;
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

/* A row where F is not enough. */
typedef void WithRow(const FieldWork *work, SkinBlock *block, uint32_t row, const float local[3], float filling, void *context);

static float enough_of(const FieldWork *work) { return THIN_SHARE * work->level; }

static void visit_cells(const FieldWork *work, SkinBlock *block, WithRow *with, void *context)
{
    const float enough = enough_of(work), shift = field_shift(work->blocks);
    float near[BOX_POINTS], least[BLOCK_POINTS];
    blocks_gather(work->blocks, block, work->mirrored_layer, near);
    least_of_cells(work->blocks, near, least);
    for (uint32_t r = 0; r < block->runs; r++) {
        const SiteRun *run = blocks_run(work->blocks, block->first_run + r);
        for (uint32_t row = run->begin; row < run->end; row++) {
            float local[3];
            int32_t cell[3];
            blocks_cell(work->blocks, block, work->matter->particles, row, cell);
            if (least[(cell[2] * BLOCK_AXIS + cell[1]) * BLOCK_AXIS + cell[0]] >= enough) continue;
            blocks_locate(work->blocks, block, work->matter->particles, row, local);
            const float filling = between(near, local, shift);
            if (filling < enough) with(work, block, row, local, filling, context);
        }
    }
}

static void visit_rows(const FieldWork *work, SkinBlock *block, WithRow *with, void *context)
{
    if (block->runs > 0 && !is_thick(work->blocks, block, enough_of(work))) visit_cells(work, block, with, context);
}

/* Adds what a row gives to T, or counts it as spray. */
static void thicken_row(const FieldWork *work, SkinBlock *block, uint32_t row, const float local[3], float filling, void *context)
{
    FieldSplat *splat = context;
    const float enough = enough_of(work), amount = field_points_per_cell(work->blocks) * matter_volume(work->matter, row);
    const float times = THICKEN_MOST * filling > enough ? enough / filling : THICKEN_MOST;
    int32_t cell[3];
    if (filling <= ALONE) {
        block->spray += amount;
        return;
    }
    if (!cells_any(&block->splatted)) memset(splat->box, 0, BOX_POINTS * sizeof *splat->box);
    field_splat(work, splat, local, (times - 1.0f) * amount);
    blocks_cell(work->blocks, block, work->matter->particles, row, cell);
    cells_add(&block->splatted, cell);
}

/* Fills a block's box with what its particles give to T. */
static void thicken_block(const FieldWork *work, SkinBlock *block)
{
    FieldSplat splat = {.box = block->runs > 0 ? work->boxes + (size_t)block->at * BOX_POINTS : NULL, .count = 0};
    block->splatted = cells_none();
    block->spray = 0.0f;
    visit_rows(work, block, thicken_row, &splat);
    field_splat_rest(work, &splat);
    block->thickens = cells_any(&block->splatted);
}

static void thicken_due(void *context, int32_t begin, int32_t end)
{
    const FieldWork *work = context;
    for (int32_t i = begin; i < end; i++) {
        SkinBlock *block = blocks_at(work->blocks, blocks_number(work->blocks, i));
        const bool did = block->thickens;
        block->splatted = cells_none();
        if (block->due) thicken_block(work, block);
        block->told = block->due && (did || block->thickens || block->anew);
    }
}

/* Boxes are no more: those that others need are filled once more. */
static void thicken_helpers(void *context, int32_t begin, int32_t end)
{
    const FieldWork *work = context;
    for (int32_t i = begin; i < end; i++) {
        SkinBlock *block = blocks_at(work->blocks, blocks_number(work->blocks, i));
        if (block->helps && block->thickens && !cells_any(&block->splatted)) thicken_block(work, block);
    }
}

static void store_more(void *context, int32_t begin, int32_t end)
{
    const FieldWork *work = context;
    for (int32_t i = begin; i < end; i++) {
        const int32_t b = blocks_number(work->blocks, i);
        SkinBlock *block = blocks_at(work->blocks, b);
        const bool was = block->raised || block->anew;
        if (!block->due) continue;
        block->raised = block->wanted;
        if (block->wanted && !block->changed) block->changed = field_store(work->more + first_point(b), work->lines + first_point(b));
        if (block->wanted || !was) continue;
        memset(work->more + first_point(b), 0, BLOCK_POINTS * sizeof(float));
        block->changed = true;
    }
}

static void find_more(const FieldWork *work)
{
    const SkinBlocks *blocks = work->blocks;
    blocks_spread(blocks, work->pool, offsetof(SkinBlock, changed), offsetof(SkinBlock, due));
    pool_for(work->pool, blocks->count, THIN_GRAIN, thicken_due, (void *)(uintptr_t)work);
    blocks_spread(blocks, work->pool, offsetof(SkinBlock, told), offsetof(SkinBlock, due));
    blocks_spread(blocks, work->pool, offsetof(SkinBlock, due), offsetof(SkinBlock, helps));
    pool_for(work->pool, blocks->with_rows, THIN_GRAIN, thicken_helpers, (void *)(uintptr_t)work);
    field_collect(work, work->lines, work->more);
    pool_for(work->pool, blocks->count, THIN_GRAIN, store_more, (void *)(uintptr_t)work);
}

/* ---- Spray ---- */

typedef struct SprayJob {
    const FieldWork *work;
    uint8_t *spray;
} SprayJob;

static void note_spray(const FieldWork *work, SkinBlock *block, uint32_t row, const float local[3], float filling, void *context)
{
    (void)work, (void)block, (void)local;
    ((uint8_t *)context)[row] = filling <= ALONE;
}

static void find_spray(void *context, int32_t begin, int32_t end)
{
    const SprayJob *job = context;
    const SkinBlocks *blocks = job->work->blocks;
    for (int32_t i = begin; i < end; i++) {
        SkinBlock *block = blocks_at(blocks, blocks_number(blocks, i));
        for (uint32_t r = 0; r < block->runs; r++) {
            const SiteRun *run = blocks_run(blocks, block->first_run + r);
            memset(job->spray + run->begin, 0, run->end - run->begin);
        }
        visit_rows(job->work, block, note_spray, job->spray);
    }
}

void thin_find_spray(const FieldWork *work, uint8_t *spray)
{
    SprayJob job = {work, spray};
    if (work->matter->particles->count > 0) memset(spray, 1, work->matter->particles->count);
    pool_for(work->pool, work->blocks->with_rows, THIN_GRAIN, find_spray, &job);
}

/* ---- k ---- */

static float share_at(float step) { return step * SHARE_MOST / THICKENINGS; }

/* Simpson's rule for a cube: its middle counts 2/3, its corners 1/3 together. It is exact for cubic functions. */
static const float MIDDLE_WEIGHT = 2.0f / 3.0f, CORNER_WEIGHT = 1.0f / 3.0f;

/* Of places where F and T have these values: what there is, and what each share makes the surface enclose. `room`: what a place counts. */
static void weigh_places(const FieldWork *work, SkinBlock *block, const float own[BLOCK_POINTS], const float more[BLOCK_POINTS], const float room[BLOCK_POINTS])
{
    work->kernels->weigh(own, more, room, work->level, share_at(1.0f), block->enclosed, &block->thin);
}

/* 1 in the open, 0 in obstacles. */
static void find_open(const float *gaps, float *open, int count)
{
    for (int i = 0; i < count; i++) open[i] = gaps[i] > 0.0f ? 1.0f : 0.0f;
}

static void weigh_corners(const FieldWork *work, SkinBlock *block, int32_t b)
{
    float room[BLOCK_POINTS];
    for (int i = 0; i < BLOCK_POINTS; i++) room[i] = 1.0f;
    if (block->bounded) find_open(work->gaps + first_point(b), room, BLOCK_POINTS);
    for (int i = 0; i < BLOCK_POINTS; i++) room[i] *= CORNER_WEIGHT;
    weigh_places(work, block, blocks_layer(work->blocks, work->mirrored_layer, b), work->more + first_point(b), room);
}

static void weigh_middles(const FieldWork *work, SkinBlock *block)
{
    SurfaceMeans *means = work->kernels->means;
    float box[BOX_POINTS], own[BLOCK_POINTS], more[BLOCK_POINTS], room[BLOCK_POINTS];
    for (int i = 0; i < BLOCK_POINTS; i++) room[i] = 1.0f;
    if (block->bounded) {
        blocks_gather(work->blocks, block, &(Layer){.values = work->gaps}, box);
        find_open(box, box, BOX_POINTS);
        means(box, room);
    }
    for (int i = 0; i < BLOCK_POINTS; i++) room[i] *= MIDDLE_WEIGHT;
    blocks_gather(work->blocks, block, work->mirrored_layer, box);
    means(box, own);
    blocks_gather(work->blocks, block, &(Layer){.values = work->more}, box);
    means(box, more);
    weigh_places(work, block, own, more, room);
}

static void weigh_block(const FieldWork *work, SkinBlock *block, int32_t b)
{
    block->thin = block->runs > 0 ? -block->spray : 0.0f;
    memset(block->enclosed, 0, sizeof block->enclosed);
    if (!block->raised) return;
    weigh_corners(work, block, b);
    weigh_middles(work, block);
}

static void weigh_blocks(void *context, int32_t begin, int32_t end)
{
    const FieldWork *work = context;
    for (int32_t i = begin; i < end; i++) {
        const int32_t b = blocks_number(work->blocks, i);
        SkinBlock *block = blocks_at(work->blocks, b);
        float enclosed[THICKENINGS + 1];
        const float thin = block->thin;
        memcpy(enclosed, block->enclosed, sizeof enclosed);
        block->told = block->anew;
        if (!block->due) continue;
        weigh_block(work, block, b);
        if (thin != block->thin || memcmp(enclosed, block->enclosed, sizeof enclosed) != 0) block->told = true;
    }
}

static void choose_share(const SkinBlocks *blocks, SkinBlock *block)
{
    float thin = 0.0f, enclosed[THICKENINGS + 1] = {0};
    for (int n = 0; n < BLOCK_NEIGHBOURS; n++) {
        if (block->neighbour[n] == GRID_NOWHERE) continue;
        const SkinBlock *other = blocks_at(blocks, block->neighbour[n]);
        thin += other->thin;
        for (int k = 0; k <= THICKENINGS; k++) enclosed[k] += other->enclosed[k];
    }
    int k = 0;
    while (k < THICKENINGS && enclosed[k + 1] < thin) k++;
    const float rise = k < THICKENINGS ? enclosed[k + 1] - enclosed[k] : 0.0f;
    const float way = rise > 0.0f ? (thin - enclosed[k]) / rise : 0.0f;
    block->thickening = share_at((float)k + (way < 0.0f ? 0.0f : way));
}

static void choose_shares(void *context, int32_t begin, int32_t end)
{
    const FieldWork *work = context;
    for (int32_t i = begin; i < end; i++) {
        SkinBlock *block = blocks_at(work->blocks, blocks_number(work->blocks, i));
        const float thickening = block->thickening;
        if (block->due) choose_share(work->blocks, block);
        block->told = block->anew || thickening != block->thickening;
    }
}

static void find_shares(const FieldWork *work)
{
    const SkinBlocks *blocks = work->blocks;
    blocks_spread(blocks, work->pool, offsetof(SkinBlock, changed), offsetof(SkinBlock, due));
    pool_for(work->pool, blocks->count, THIN_GRAIN, weigh_blocks, (void *)(uintptr_t)work);
    blocks_spread(blocks, work->pool, offsetof(SkinBlock, told), offsetof(SkinBlock, due));
    pool_for(work->pool, blocks->count, THIN_GRAIN, choose_shares, (void *)(uintptr_t)work);
}

void thin_find(const FieldWork *work)
{
    find_more(work);
    find_shares(work);
}

/* ---- F + k T ---- */

/* How far a point is before (below 0) or behind (above 0) the middle of its block [blocks]. */
static const float from_middle[BLOCK_AXIS] = {-7 / 16.0f, -5 / 16.0f, -3 / 16.0f, -1 / 16.0f, 1 / 16.0f, 3 / 16.0f, 5 / 16.0f, 7 / 16.0f};

/* From three values at the middles of blocks along an axis: that at a point of the block between. */
static inline float from_middles(const float *value, int step, int point)
{
    const float before = from_middle[point] < 0.0f ? from_middle[point] : 0.0f, behind = from_middle[point] - before;
    return value[step] + before * (value[step] - value[0]) + behind * (value[2 * step] - value[step]);
}

void thin_add(const FieldWork *work, const SkinBlock *block, int32_t b, float values[BLOCK_POINTS])
{
    const float *own = blocks_layer(work->blocks, work->mirrored_layer, b), *more = work->more + first_point(b);
    float share[BLOCK_NEIGHBOURS], plane[9], line[3];
    for (int n = 0; n < BLOCK_NEIGHBOURS; n++) /* where no block is, there is none of its own */
        share[n] = block->neighbour[n] == GRID_NOWHERE ? block->thickening : blocks_at(work->blocks, block->neighbour[n])->thickening;
    for (int z = 0; z < BLOCK_AXIS; z++) {
        for (int i = 0; i < 9; i++) plane[i] = from_middles(share + i, 9, z);
        for (int y = 0; y < BLOCK_AXIS; y++) {
            const int row = (z * BLOCK_AXIS + y) * BLOCK_AXIS;
            for (int i = 0; i < 3; i++) line[i] = from_middles(plane + i, 3, y);
            float along[BLOCK_AXIS];
            for (int x = 0; x < BLOCK_AXIS; x++) along[x] = from_middles(line, 1, x);
            for (int x = 0; x < BLOCK_AXIS; x++) values[row + x] = own[row + x] + more[row + x] * along[x];
        }
    }
}
