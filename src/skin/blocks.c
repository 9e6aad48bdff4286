#include "skin/blocks.h"

#include <string.h>

enum { LINK_GRAIN = 64, SLOTS_LEAST = 256 };

/* grid_neighbour_offset(), worked out once. */
static const int32_t way_of[BLOCK_NEIGHBOURS][3] = {
    {-1, -1, -1}, {0, -1, -1}, {1, -1, -1}, {-1, 0, -1}, {0, 0, -1}, {1, 0, -1}, {-1, 1, -1}, {0, 1, -1}, {1, 1, -1},
    {-1, -1, 0},  {0, -1, 0},  {1, -1, 0},  {-1, 0, 0},  {0, 0, 0},  {1, 0, 0},  {-1, 1, 0},  {0, 1, 0},  {1, 1, 0},
    {-1, -1, 1},  {0, -1, 1},  {1, -1, 1},  {-1, 0, 1},  {0, 0, 1},  {1, 0, 1},  {-1, 1, 1},  {0, 1, 1},  {1, 1, 1},
};

/* ---- Finding ---- */

static void place_beside(const SkinBlock *block, int n, int32_t place[3])
{
    for (int a = 0; a < 3; a++) place[a] = block->place[a] + way_of[n][a];
}

static int32_t *slot_of(const SkinBlocks *blocks, const int32_t place[3])
{
    int32_t *table = blocks->table.data;
    const uint64_t mask = (uint64_t)blocks->slots - 1;
    uint64_t slot = grid_hash(place) & mask;
    while (table[slot] && memcmp(blocks_at(blocks, table[slot] - 1)->place, place, 3 * sizeof *place) != 0) slot = (slot + 1) & mask;
    return &table[slot];
}

static int32_t block_at(const SkinBlocks *blocks, const int32_t place[3]) { return blocks->slots ? *slot_of(blocks, place) - 1 : GRID_NOWHERE; }

static void fill_table(SkinBlocks *blocks)
{
    if (blocks->slots) memset(blocks->table.data, 0, (size_t)blocks->slots * sizeof(int32_t));
    for (int32_t b = 0; b < blocks->count; b++) *slot_of(blocks, blocks_at(blocks, b)->place) = b + 1;
}

/* At least half of the slots stay free. */
static bool grow_table(SkinBlocks *blocks, Memory *memory)
{
    if (blocks->slots >= 2 * (blocks->count + 1)) return true;
    const int32_t slots = blocks->slots ? 2 * blocks->slots : SLOTS_LEAST;
    if (!array_reserve(memory, &blocks->table, (size_t)slots, sizeof(int32_t))) return false;
    blocks->slots = slots;
    fill_table(blocks);
    return true;
}

/* The block at a place, which is made if there is none; GRID_NOWHERE: no memory. */
static int32_t want_block(SkinBlocks *blocks, Memory *memory, const int32_t place[3])
{
    const int32_t found = block_at(blocks, place);
    if (found != GRID_NOWHERE) return found;
    const size_t count = (size_t)blocks->count;
    if (!grow_table(blocks, memory) || !array_grow(memory, &blocks->block, count + 1, sizeof(SkinBlock), count * sizeof(SkinBlock))) return GRID_NOWHERE;
    SkinBlock *block = blocks_at(blocks, blocks->count);
    *block = (SkinBlock){.cells = cells_none(), .splatted = cells_none()};
    memcpy(block->place, place, sizeof block->place);
    for (int n = 0; n < BLOCK_NEIGHBOURS; n++) block->neighbour[n] = GRID_NOWHERE;
    *slot_of(blocks, place) = ++blocks->count;
    return blocks->count - 1;
}

static int32_t floor_divide(int32_t a, int32_t b) { return a / b - (a % b < 0); }

/* The end of the rows from one on that count and are in the block; bit k of `cells` tells for each axis that one is in cell k. */
static uint32_t follow_rows(const SkinBlocks *blocks, SkinBlock *block, const SkinMatter *matter, uint32_t row)
{
    const Particles *p = matter->particles;
    const uint32_t cells = (uint32_t)blocks_cells(blocks);
    uint32_t found[3] = {0}, first[3];
    for (int a = 0; a < 3; a++) first[a] = (uint32_t)(blocks->anchor[a] + block->place[a] * (int32_t)cells);
    for (; row < p->count && matter_has(matter, row); row++) {
        const uint32_t x = (uint32_t)p->cell[0][row] - first[0], y = (uint32_t)p->cell[1][row] - first[1], z = (uint32_t)p->cell[2][row] - first[2];
        if ((x | y | z) >= cells) break; /* cells is a power of two */
        found[0] |= 1u << x;
        found[1] |= 1u << y;
        found[2] |= 1u << z;
    }
    for (int a = 0; a < 3; a++) block->found[a] |= (uint8_t)found[a];
    return row;
}

/* The run that begins with a row; false: no memory. */
static bool find_run(SkinBlocks *blocks, Memory *memory, const Particles *p, uint32_t row, BlockRun *run)
{
    int32_t place[3];
    for (int a = 0; a < 3; a++) place[a] = floor_divide(p->cell[a][row] - blocks->anchor[a], blocks_cells(blocks));
    *run = (BlockRun){want_block(blocks, memory, place), row, row + 1};
    return run->block != GRID_NOWHERE;
}

static bool find_runs(SkinBlocks *blocks, Memory *memory, const SkinMatter *matter)
{
    const Particles *p = matter->particles;
    uint32_t row = 0;
    while (row < p->count) {
        BlockRun run;
        if (!matter_has(matter, row)) {
            row++;
            continue;
        }
        if (!find_run(blocks, memory, p, row, &run)) return false;
        SkinBlock *block = blocks_at(blocks, run.block);
        run.end = row = follow_rows(blocks, block, matter, row);
        block->runs++;
        block->volume += (float)(run.end - run.begin) * matter_volume(matter, run.begin);
        const size_t count = (size_t)blocks->runs++;
        if (!array_grow(memory, &blocks->found_run, count + 1, sizeof run, count * sizeof run)) return false;
        ((BlockRun *)blocks->found_run.data)[count] = run;
    }
    return true;
}

static void bound_cells(SkinBlocks *blocks)
{
    for (int32_t b = 0; b < blocks->count; b++) {
        SkinBlock *block = blocks_at(blocks, b);
        for (int a = 0; a < 3; a++) {
            block->cells.low[a] = __builtin_ctz(block->found[a]);
            block->cells.high[a] = 31 - __builtin_clz(block->found[a]);
        }
    }
}

/* What it takes for more than spray [cells]: drops of fewer particles are better drawn as points. */
static const float SPRAY_MOST = 1.0f;

static bool is_spray(const SkinBlocks *blocks, const SkinBlock *block)
{
    float volume = block->volume;
    for (int n = 0; n < BLOCK_NEIGHBOURS && volume < SPRAY_MOST; n++) {
        if (n == BLOCK_NEIGHBOURS / 2) continue; /* that is itself */
        int32_t place[3];
        place_beside(block, n, place);
        const int32_t other = block_at(blocks, place);
        if (other != GRID_NOWHERE) volume += blocks_at(blocks, other)->volume;
    }
    return volume < SPRAY_MOST;
}

/* Leaves out the blocks of spray, and their runs. */
static void drop_spray(SkinBlocks *blocks)
{
    BlockRun *run = blocks->found_run.data;
    int32_t blocks_kept = 0, runs_kept = 0;
    for (int32_t b = 0; b < blocks->count; b++) blocks_at(blocks, b)->wanted = !is_spray(blocks, blocks_at(blocks, b));
    for (int32_t b = 0; b < blocks->count; b++) blocks_at(blocks, b)->kept_as = blocks_at(blocks, b)->wanted ? blocks_kept++ : GRID_NOWHERE;
    for (int32_t r = 0; r < blocks->runs; r++) {
        const int32_t block = blocks_at(blocks, run[r].block)->kept_as;
        if (block != GRID_NOWHERE) run[runs_kept++] = (BlockRun){block, run[r].begin, run[r].end};
    }
    for (int32_t b = 0; b < blocks->count; b++)
        if (blocks_at(blocks, b)->wanted) *blocks_at(blocks, blocks_at(blocks, b)->kept_as) = *blocks_at(blocks, b);
    blocks->count = blocks->with_rows = blocks_kept;
    blocks->runs = runs_kept;
    fill_table(blocks);
}

/* Block by block, each in the order of rows. */
static bool sort_runs(SkinBlocks *blocks, Memory *memory)
{
    if (!array_reserve(memory, &blocks->run, (size_t)blocks->runs, sizeof(BlockRun))) return false;
    uint32_t first = 0;
    for (int32_t b = 0; b < blocks->with_rows; b++) {
        SkinBlock *block = blocks_at(blocks, b);
        block->first_run = first;
        first += block->runs;
        block->runs = 0;
    }
    const BlockRun *found = blocks->found_run.data;
    for (int32_t r = 0; r < blocks->runs; r++) {
        SkinBlock *block = blocks_at(blocks, found[r].block);
        ((BlockRun *)blocks->run.data)[block->first_run + block->runs++] = found[r];
    }
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

static bool find_touched(SkinBlocks *blocks, Memory *memory)
{
    for (int32_t b = 0; b < blocks->with_rows; b++)
        for (int n = 0; n < BLOCK_NEIGHBOURS; n++) {
            const SkinBlock *block = blocks_at(blocks, b);
            int32_t place[3];
            place_beside(block, n, place);
            if (leads_to(blocks, &block->cells, touched[blocks->subdivision], way_of[n]) && want_block(blocks, memory, place) == GRID_NOWHERE) return false;
        }
    return true;
}

bool blocks_find(SkinBlocks *blocks, Memory *memory, const SkinMatter *matter)
{
    blocks->count = blocks->with_rows = blocks->runs = blocks->slots = 0;
    grid_drop_anchor(matter->particles, blocks->anchor);
    if (!find_runs(blocks, memory, matter)) return false;
    bound_cells(blocks);
    drop_spray(blocks);
    return sort_runs(blocks, memory) && find_touched(blocks, memory);
}

/* Each looks for half of its neighbours, and tells them. */
static void link_blocks(void *context, int32_t begin, int32_t end)
{
    const SkinBlocks *blocks = context;
    for (int32_t b = begin; b < end; b++) {
        SkinBlock *block = blocks_at(blocks, b);
        block->neighbour[BLOCK_NEIGHBOURS / 2] = b;
        for (int n = 0; n < BLOCK_NEIGHBOURS / 2; n++) {
            int32_t place[3];
            place_beside(block, n, place);
            const int32_t other = block->neighbour[n] = block_at(blocks, place);
            if (other != GRID_NOWHERE) blocks_at(blocks, other)->neighbour[BLOCK_NEIGHBOURS - 1 - n] = b;
        }
    }
}

void blocks_link(SkinBlocks *blocks, Pool *pool) { pool_for(pool, blocks->count, LINK_GRAIN, link_blocks, blocks); }

void blocks_free(SkinBlocks *blocks, Memory *memory)
{
    Array *arrays[] = {&blocks->block, &blocks->run, &blocks->found_run, &blocks->table};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(memory, arrays[i]);
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

void blocks_gather(const SkinBlock *block, const float *values, float box[BOX_POINTS])
{
    static const float nothing[BLOCK_POINTS];
    for (int n = 0; n < BLOCK_NEIGHBOURS; n += 3) {
        const float *beside[3];
        for (int side = 0; side < 3; side++) {
            const int32_t other = block->neighbour[n + side];
            beside[side] = other == GRID_NOWHERE ? nothing : values + (size_t)other * BLOCK_POINTS;
        }
        copy_rows(&seen[n / 3 % 3], &seen[n / 9], beside, box);
    }
}

/* The box of a neighbour, if what it says of the block is not nothing. */
static const float *box_beside(const SkinBlocks *blocks, const SkinBlock *block, int n, const float *boxes)
{
    const int32_t other = block->neighbour[n];
    if (other == GRID_NOWHERE || !leads_to(blocks, &blocks_at(blocks, other)->splatted, splatted[blocks->subdivision], way_of[BLOCK_NEIGHBOURS - 1 - n])) return NULL;
    return boxes + (size_t)other * BOX_POINTS;
}

void blocks_sum(const SkinBlocks *blocks, const SkinKernels *kernels, int32_t b, const float *boxes, float sum[BLOCK_POINTS])
{
    memset(sum, 0, BLOCK_POINTS * sizeof *sum);
    for (int n = 0; n < BLOCK_NEIGHBOURS; n += 3) {
        const Stretch *y = &seen[2 - n / 3 % 3], *z = &seen[2 - n / 9]; /* the neighbour at `way` sees this block at -way */
        const float *box[3];
        for (int side = 0; side < 3; side++) {
            box[side] = box_beside(blocks, blocks_at(blocks, b), n + side, boxes);
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
        if (block->neighbour[n] == GRID_NOWHERE) continue;
        const CellBox *cells = &blocks_at(blocks, block->neighbour[n])->splatted;
        if (!leads_to(blocks, cells, changed[blocks->subdivision], way_of[BLOCK_NEIGHBOURS - 1 - n])) continue;
        const CellBox from = reached_from(blocks, cells, way_of[n]);
        cells_add(&reached, from.low);
        cells_add(&reached, from.high);
    }
    block->reached = reached;
}
