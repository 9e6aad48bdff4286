#include "skin/blocks.h"

#include <string.h>

enum { BLOCK_GRAIN = 64 };

static void offset_of(int n, int32_t way[3]) { grid_neighbour_offset(n, 3, way); }

/* ---- Finding ---- */

/* Puts the block at a place into the list, unless it is there; GRID_NOWHERE: no memory. */
static int32_t list_block(SkinBlocks *blocks, Memory *memory, const int32_t place[3])
{
    const int32_t b = places_want(&blocks->block, memory, place);
    if (b == GRID_NOWHERE) return b;
    SkinBlock *block = blocks_at(blocks, b);
    if (block->listed == blocks->surface) return b;
    const size_t count = (size_t)blocks->count;
    if (!array_grow(memory, &blocks->list, count + 1, sizeof b, count * sizeof b)) return GRID_NOWHERE;
    ((int32_t *)blocks->list.data)[count] = b;
    block->anew = block->fresh = block->listed == 0;
    blocks->others |= block->fresh;
    block->listed = blocks->surface;
    block->at = blocks->count++;
    block->runs = 0;
    block->cells = block->splatted = cells_none();
    return b;
}

static bool list_sites(SkinBlocks *blocks, Memory *memory)
{
    for (int32_t s = 0; s < blocks->sites.site.count; s++) {
        const Site *site = sites_at(&blocks->sites, s);
        if (site->spray) continue;
        const int32_t b = list_block(blocks, memory, site->place);
        if (b == GRID_NOWHERE) return false;
        SkinBlock *block = blocks_at(blocks, b);
        block->first_run = site->first_run;
        block->runs = site->runs;
        for (int a = 0; a < 3; a++) {
            block->cells.low[a] = __builtin_ctz(site->cells[a]);
            block->cells.high[a] = 31 - __builtin_clz(site->cells[a]);
        }
    }
    blocks->with_rows = blocks->count;
    return true;
}

/* Points of the lattice beside that of a particle's cell. With subdivision 2 a particle is up to 1 point beside its cell's, the narrow spline reaches 1
 * farther, the filter of W 1 below and 2 above, and that of S 2 more; see field.h. */
typedef struct Reach {
    int32_t below, above;
} Reach;

/* What particles give to: the narrow spline with subdivision 2. */
static const Reach splatted[3] = {{0, 0}, {1, 2}, {1, 3}};
/* What W reaches, and one more below: the corners of all cubes that a surface may cut. */
static const Reach touched[3] = {{0, 0}, {2, 1}, {4, 4}};
/* All that a particle changes. */
static const Reach changed[3] = {{0, 0}, {2, 2}, {5, 6}};

/* Whether that of cells of a block leads into the neighbour at `way`. */
static bool leads_to(const SkinBlocks *blocks, const CellBox *cells, Reach reach, const int32_t way[3])
{
    if (!cells_any(cells)) return false;
    for (int a = 0; a < 3; a++) {
        if (way[a] < 0 && cells->low[a] * blocks->subdivision >= reach.below) return false;
        if (way[a] > 0 && cells->high[a] * blocks->subdivision + reach.above < BLOCK_AXIS) return false;
    }
    return true;
}

static bool list_touched(SkinBlocks *blocks, Memory *memory)
{
    for (int32_t i = 0; i < blocks->with_rows; i++)
        for (int n = 0; n < BLOCK_NEIGHBOURS; n++) {
            const SkinBlock *block = blocks_at(blocks, blocks_number(blocks, i));
            int32_t place[3];
            offset_of(n, place);
            if (!leads_to(blocks, &block->cells, touched[blocks->subdivision], place)) continue;
            for (int a = 0; a < 3; a++) place[a] += block->place[a];
            if (list_block(blocks, memory, place) == GRID_NOWHERE) return false;
        }
    return true;
}

/* Those of the last surface that this one has not. */
static void drop_others(SkinBlocks *blocks)
{
    for (int32_t b = 0; b < blocks->block.count; b++) {
        const uint64_t listed = blocks_at(blocks, b)->listed;
        if (!listed || listed == blocks->surface) continue;
        places_drop(&blocks->block, b);
        blocks->others = true;
    }
}

bool blocks_find(SkinBlocks *blocks, Memory *memory, const SkinMatter *matter)
{
    blocks->block.size = sizeof(SkinBlock);
    blocks->count = 0;
    blocks->others = false;
    blocks->surface++;
    if (!sites_find(&blocks->sites, memory, matter, blocks->subdivision) || !list_sites(blocks, memory) || !list_touched(blocks, memory)) return false;
    drop_others(blocks);
    return true;
}

/* ---- What changed ---- */

typedef struct CompareJob {
    const SkinBlocks *blocks;
    const SkinMatter *matter;
} CompareJob;

static void link_block(const SkinBlocks *blocks, SkinBlock *block)
{
    for (int n = 0; n < BLOCK_NEIGHBOURS; n++) {
        int32_t place[3];
        offset_of(n, place);
        for (int a = 0; a < 3; a++) place[a] += block->place[a];
        const int32_t other = places_find(&blocks->block, place);
        block->anew |= other != block->neighbour[n];
        block->neighbour[n] = other;
    }
}

static uint64_t pair_of(const void *low, const void *high)
{
    uint32_t word[2];
    memcpy(&word[0], low, sizeof word[0]);
    memcpy(&word[1], high, sizeof word[1]);
    return word[0] | (uint64_t)word[1] << 32;
}

/* All that the field takes from particles, in their order. Each step of it keeps two numbers apart that are apart, so with 64 bits one change in 2^64 goes
 * unseen. Four rows of steps need not wait for each other. */
static uint64_t print_of(const CompareJob *job, const SkinBlock *block)
{
    const Particles *p = job->matter->particles;
    uint64_t print[4] = {1, 2, 3, 4};
    for (uint32_t r = 0; r < block->runs; r++) {
        const SiteRun *run = blocks_run(job->blocks, block->first_run + r);
        for (uint32_t row = run->begin; row < run->end; row++) {
            const float volume = matter_volume(job->matter, row);
            print[0] = blocks_mix(print[0], pair_of(&p->cell[0][row], &p->cell[1][row]));
            print[2] = blocks_mix(print[2], pair_of(&p->fraction[0][row], &p->fraction[1][row]));
            print[3] = blocks_mix(print[3], pair_of(&volume, &volume));
            print[1] = blocks_mix(print[1], pair_of(&p->cell[2][row], &p->fraction[2][row]));
        }
    }
    return blocks_mix(blocks_mix(blocks_mix(print[0], print[1]), print[2]), print[3]);
}

static void compare_blocks(void *context, int32_t begin, int32_t end)
{
    const CompareJob *job = context;
    for (int32_t i = begin; i < end; i++) {
        SkinBlock *block = blocks_at(job->blocks, blocks_number(job->blocks, i));
        const uint64_t print = print_of(job, block);
        if (job->blocks->others) link_block(job->blocks, block);
        block->changed = block->anew || print != block->print;
        block->print = print;
    }
}

void blocks_compare(SkinBlocks *blocks, Pool *pool, const SkinMatter *matter)
{
    const CompareJob job = {blocks, matter};
    pool_for(pool, blocks->count, BLOCK_GRAIN, compare_blocks, (void *)(uintptr_t)&job);
}

void blocks_forget(SkinBlocks *blocks)
{
    places_clear(&blocks->block);
    blocks->count = blocks->with_rows = 0;
}

void blocks_free(SkinBlocks *blocks, Memory *memory)
{
    places_free(&blocks->block, memory);
    sites_free(&blocks->sites, memory);
    array_free(memory, &blocks->list);
}

/* ---- Neighbours ---- */

bool blocks_beside(const SkinBlocks *blocks, const SkinBlock *block, size_t flag)
{
    for (int n = 0; n < BLOCK_NEIGHBOURS; n++)
        if (block->neighbour[n] != GRID_NOWHERE && *((const bool *)(const void *)blocks_at(blocks, block->neighbour[n]) + flag)) return true;
    return false;
}

typedef struct SpreadJob {
    const SkinBlocks *blocks;
    size_t from, to;
} SpreadJob;

static void spread_over(void *context, int32_t begin, int32_t end)
{
    const SpreadJob *job = context;
    for (int32_t i = begin; i < end; i++) {
        SkinBlock *block = blocks_at(job->blocks, blocks_number(job->blocks, i));
        *((bool *)(void *)block + job->to) = blocks_beside(job->blocks, block, job->from);
    }
}

void blocks_spread(const SkinBlocks *blocks, Pool *pool, size_t from, size_t to)
{
    SpreadJob job = {blocks, from, to};
    pool_for(pool, blocks->count, BLOCK_GRAIN, spread_over, &job);
}

/* ---- Boxes ---- */

/* Along an axis: the points of the neighbour at -1, 0 and 1 that a box has, and where it has them. */
typedef struct Stretch {
    int of_block, of_box, count;
} Stretch;

static const Stretch seen[3] = {{BLOCK_AXIS - BOX_MARGIN, 0, BOX_MARGIN}, {0, BOX_MARGIN, BLOCK_AXIS}, {0, BOX_MARGIN + BLOCK_AXIS, BOX_MARGIN}};

/* Rows of all three neighbours along x at once. */
static void copy_rows(const Stretch *y, const Stretch *z, const float *const beside[3], float *box)
{
    for (int k = 0; k < z->count; k++)
        for (int j = 0; j < y->count; j++) {
            const int row = ((z->of_block + k) * BLOCK_AXIS + y->of_block + j) * BLOCK_AXIS;
            float *out = &box[((z->of_box + k) * BOX_AXIS + y->of_box + j) * BOX_AXIS];
            memcpy(out, beside[0] + row + BLOCK_AXIS - BOX_MARGIN, BOX_MARGIN * sizeof *out);
            memcpy(out + BOX_MARGIN, beside[1] + row, BLOCK_AXIS * sizeof *out);
            memcpy(out + BOX_MARGIN + BLOCK_AXIS, beside[2] + row, BOX_MARGIN * sizeof *out);
        }
}

const float *blocks_layer(const SkinBlocks *blocks, const Layer *layer, int32_t b)
{
    const char *block = (const char *)blocks_at(blocks, b);
    while (layer->below && !*(const bool *)(const void *)(block + layer->flag)) layer = layer->below;
    return layer->values + (size_t)b * BLOCK_POINTS;
}

void blocks_gather(const SkinBlocks *blocks, const SkinBlock *block, const Layer *layer, float box[BOX_POINTS])
{
    static const float nothing[BLOCK_POINTS];
    for (int n = 0; n < BLOCK_NEIGHBOURS; n += 3) {
        const float *beside[3];
        for (int side = 0; side < 3; side++) {
            const int32_t other = block->neighbour[n + side];
            beside[side] = other == GRID_NOWHERE ? nothing : blocks_layer(blocks, layer, other);
        }
        copy_rows(&seen[n / 3 % 3], &seen[n / 9], beside, box);
    }
}

/* The box of a neighbour, if what it says of the block is not nothing. */
static const float *box_beside(const SkinBlocks *blocks, const SkinBlock *block, int n, const float *boxes)
{
    int32_t way[3];
    if (block->neighbour[n] == GRID_NOWHERE) return NULL;
    const SkinBlock *other = blocks_at(blocks, block->neighbour[n]);
    offset_of(BLOCK_NEIGHBOURS - 1 - n, way);
    return leads_to(blocks, &other->splatted, splatted[blocks->subdivision], way) ? boxes + (size_t)other->at * BOX_POINTS : NULL;
}

void blocks_sum(const SkinBlocks *blocks, const SkinKernels *kernels, const SkinBlock *block, const float *boxes, float sum[BLOCK_POINTS])
{
    memset(sum, 0, BLOCK_POINTS * sizeof *sum);
    for (int n = 0; n < BLOCK_NEIGHBOURS; n += 3) {
        const Stretch *y = &seen[2 - n / 3 % 3], *z = &seen[2 - n / 9]; /* the neighbour at `way` sees this block at -way */
        const float *box[3];
        for (int side = 0; side < 3; side++) {
            box[side] = box_beside(blocks, block, n + side, boxes);
            if (box[side]) box[side] += (z->of_box * BOX_AXIS + y->of_box) * BOX_AXIS;
        }
        if (box[0] || box[1] || box[2]) kernels->add(box, y->count, z->count, sum + (z->of_block * BLOCK_AXIS + y->of_block) * BLOCK_AXIS);
    }
}

bool blocks_near_surface(const SkinBlocks *blocks, const SkinBlock *block)
{
    for (int n = 0; n < BLOCK_NEIGHBOURS; n++)
        if (block->neighbour[n] != GRID_NOWHERE && blocks_at(blocks, block->neighbour[n])->vertices) return true;
    return false;
}

/* The points of a block that particles in these cells of its neighbour at `way` change. */
static CellBox reached_from(const SkinBlocks *blocks, const CellBox *cells, const int32_t way[3])
{
    const Reach reach = changed[blocks->subdivision];
    CellBox box;
    for (int a = 0; a < 3; a++) {
        const int32_t low = way[a] * BLOCK_AXIS + cells->low[a] * blocks->subdivision - reach.below;
        const int32_t high = way[a] * BLOCK_AXIS + cells->high[a] * blocks->subdivision + reach.above;
        box.low[a] = low < 0 ? 0 : low;
        box.high[a] = high < BLOCK_AXIS ? high : BLOCK_AXIS - 1;
    }
    return box;
}

void blocks_find_reached(const SkinBlocks *blocks, SkinBlock *block)
{
    CellBox reached = cells_none();
    for (int n = 0; n < BLOCK_NEIGHBOURS; n++) {
        int32_t way[3], back[3];
        if (block->neighbour[n] == GRID_NOWHERE) continue;
        const CellBox *cells = &blocks_at(blocks, block->neighbour[n])->splatted;
        offset_of(n, way);
        offset_of(BLOCK_NEIGHBOURS - 1 - n, back);
        if (!leads_to(blocks, cells, changed[blocks->subdivision], back)) continue;
        const CellBox from = reached_from(blocks, cells, way);
        cells_add(&reached, from.low);
        cells_add(&reached, from.high);
    }
    block->reached = reached;
}
