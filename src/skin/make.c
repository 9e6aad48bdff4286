#include "skin/make.h"

#include <string.h>

#include "skin/boundary.h"
#include "skin/thin.h"

enum { MAKE_GRAIN = 4 };

static void finish_block(const FieldWork *work, SkinBlock *block, int32_t b)
{
    const size_t point = (size_t)b * BLOCK_POINTS;
    float *values = work->field + point;
    block->ended = block->raised || block->bounded;
    block->least = block->filling_least;
    block->most = block->filling_most;
    if (!block->ended) return;
    if (block->raised) {
        thin_add(work, block, b, values);
        field_close_off(block, values);
    } else {
        memcpy(values, work->mirrored + point, BLOCK_POINTS * sizeof *values);
    }
    if (block->bounded) boundary_cut(work, values, work->gaps + point);
    work->kernels->bound(values, &block->least, &block->most);
}

static void finish_blocks(void *context, int32_t begin, int32_t end)
{
    const FieldWork *work = context;
    for (int32_t i = begin; i < end; i++) {
        const int32_t b = blocks_number(work->blocks, i);
        SkinBlock *block = blocks_at(work->blocks, b);
        block->changed = block->changed || (block->raised && block->due);
        if (block->changed) finish_block(work, block, b);
    }
}

void make_field(const FieldWork *work)
{
    field_fill(work);
    if (work->gaps) boundary_mirror(work);
    if (work->more) thin_find(work);
    blocks_spread(work->blocks, work->pool, offsetof(SkinBlock, told), offsetof(SkinBlock, due));
    pool_for(work->pool, work->blocks->count, MAKE_GRAIN, finish_blocks, (void *)(uintptr_t)work);
}
