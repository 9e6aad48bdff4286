#include "grid/build.h"

#include <string.h>

#include "base/assertion.h"
#include "base/result.h"
#include "grid/block_cells.h"
#include "grid/bodies.h"

enum { BLOCK_GRAIN = 4, ROW_GRAIN = 1024, CELL_IN_BLOCK = K_BLOCK_AXIS - 1 };

/* ---- Finding blocks: a hash table from block coordinates to the order of discovery. ---- */

/* The slot of a block, or the free slot where it belongs. */
static uint32_t *find_slot(const Grid *grid, const int32_t c[3])
{
    const size_t mask = grid->table.bytes / sizeof(uint32_t) - 1; /* a power of two, see reserve_found() */
    uint32_t *table = grid->table.data;
    const FoundBlock *found = grid->found.data;
    for (size_t slot = (size_t)grid_hash(c) & mask;; slot = (slot + 1) & mask) {
        if (table[slot] == 0) return &table[slot];
        const int32_t *other = found[table[slot] - 1].coordinate;
        if (other[0] == c[0] && other[1] == c[1] && other[2] == c[2]) return &table[slot];
    }
}

/* A power of two: for as many blocks as all particles may touch, at most a thousand or so. */
static size_t first_room(const Grid *grid)
{
    enum { MOST = 1024 };
    size_t room = 1;
    while (room < MOST && room < (size_t)grid->capacity << grid->dimension) room *= 2;
    return room;
}

/* Room for at least one more block, with the table at most half full. Growing keeps what was found. */
static bool reserve_found(Grid *grid, Memory *memory)
{
    if ((size_t)grid->found_count + 1 <= grid->found.bytes / sizeof(FoundBlock)) return true;
    const size_t room = grid->found.bytes ? 2 * (grid->found.bytes / sizeof(FoundBlock)) : first_room(grid);
    FoundBlock *found = memory_take(memory, room * sizeof(FoundBlock));
    uint32_t *table = found ? memory_take(memory, 2 * room * sizeof(uint32_t)) : NULL;
    if (!table) {
        memory_give(memory, found, room * sizeof(FoundBlock));
        return false;
    }
    if (grid->found_count) memcpy(found, grid->found.data, grid->found_count * sizeof(FoundBlock));
    array_free(memory, &grid->found);
    array_free(memory, &grid->table);
    grid->found = (Array){found, room * sizeof(FoundBlock)};
    grid->table = (Array){table, 2 * room * sizeof(uint32_t)};
    for (uint32_t i = 0; i < grid->found_count; i++) *find_slot(grid, found[i].coordinate) = i + 1;
    return true;
}

/* The block in order of discovery, or -1 without memory. */
static int32_t find_or_add(Grid *grid, Memory *memory, const int32_t c[3])
{
    if (!reserve_found(grid, memory)) return -1;
    uint32_t *slot = find_slot(grid, c);
    if (*slot == 0) {
        ((FoundBlock *)grid->found.data)[grid->found_count] = (FoundBlock){.coordinate = {c[0], c[1], c[2]}};
        *slot = ++grid->found_count;
    }
    return (int32_t)*slot - 1;
}

/* The bit of a cell in FoundBlock.cells; cells are counted from the anchor. */
static uint64_t cell_bit(const int32_t cell[3])
{
    return (uint64_t)1 << ((cell[0] & CELL_IN_BLOCK) | (cell[1] & CELL_IN_BLOCK) << 2 | (cell[2] & CELL_IN_BLOCK) << 4);
}

/* A block that was asked for not long ago. Particles come in almost sorted order, in turns from a block and its neighbours;
 * those differ in the parity of a coordinate, so one place per parity answers nearly every question. */
typedef struct Seen {
    int32_t coordinate[3];
    int32_t block;
} Seen;

void grid_drop_anchor(const Particles *p, int32_t anchor[3])
{
    for (int a = 0; a < p->dimension; a++) {
        int32_t lowest = INT32_MAX;
        for (uint32_t i = 0; i < p->count; i++) lowest = p->cell[a][i] < lowest ? p->cell[a][i] : lowest;
        anchor[a] = lowest;
    }
}

bool grid_begin(Grid *grid, Memory *memory, const int32_t anchor[3])
{
    for (int a = 0; a < grid->dimension; a++) grid->anchor[a] = anchor[a];
    if (!reserve_found(grid, memory)) return false;
    memset(grid->table.data, 0, grid->table.bytes);
    grid->found_count = 0;
    return true;
}

static void see_none(Seen seen[8])
{
    for (int k = 0; k < 8; k++) seen[k] = (Seen){.coordinate = {-1, -1, -1}}; /* no particle's block */
}

static inline bool add_row(Grid *grid, Memory *memory, const Particles *p, uint32_t i, Seen seen[8])
{
    int32_t cell[3] = {0}, c[3] = {0};
    for (int a = 0; a < p->dimension; a++) {
        cell[a] = p->cell[a][i] - grid->anchor[a];
        c[a] = cell[a] / K_BLOCK_AXIS;
    }
    Seen *near = &seen[(c[0] & 1) | (c[1] & 1) << 1 | (c[2] & 1) << 2];
    if (c[0] != near->coordinate[0] || c[1] != near->coordinate[1] || c[2] != near->coordinate[2]) {
        *near = (Seen){{c[0], c[1], c[2]}, find_or_add(grid, memory, c)};
        if (near->block < 0) return false;
    }
    FoundBlock *found = (FoundBlock *)grid->found.data + near->block;
    found->particles++;
    found->cells |= cell_bit(cell);
    grid->block_of[i] = near->block;
    return true;
}

bool grid_add_rows(Grid *grid, Memory *memory, const Particles *p, uint32_t begin, uint32_t end)
{
    Seen seen[8];
    bool added = true;
    see_none(seen);
    for (uint32_t i = begin; i < end && added; i++) added = add_row(grid, memory, p, i, seen);
    return added;
}

FoundBlock *grid_found(const Grid *grid, const int32_t place[3])
{
    const uint32_t slot = *find_slot(grid, place);
    return slot ? (FoundBlock *)grid->found.data + (slot - 1) : NULL;
}

/* Whether one of the cells lies at the lowest side of each axis where the offset is negative, and at the highest where it is positive. */
static bool touches(uint64_t cells, const int32_t offset[3])
{
    for (int a = 0; a < 3; a++)
        if (offset[a] != 0) cells &= block_cells_slice(a, offset[a] < 0 ? 0 : K_BLOCK_AXIS - 1);
    return cells != 0;
}

static bool find_touched_blocks(Grid *grid, Memory *memory)
{
    const uint32_t with_particles = grid->found_count;
    for (uint32_t b = 0; b < with_particles; b++) {
        for (int n = 0; n < grid->neighbours; n++) {
            const FoundBlock *block = (FoundBlock *)grid->found.data + b;
            int32_t c[3];
            grid_neighbour_offset(n, grid->dimension, c);
            if (block->particles == 0 || !touches(block->cells, c)) continue; /* not those that its particles left */
            for (int a = 0; a < 3; a++) c[a] += block->coordinate[a];
            const int32_t touched = find_or_add(grid, memory, c);
            if (touched < 0) return false;
            ((FoundBlock *)grid->found.data)[touched].touched = 1;
        }
    }
    return true;
}

/* ---- Order of blocks: Morton order keeps neighbours close in memory, and does not depend on who came first. ---- */

static uint64_t spread_bits(uint32_t value)
{
    uint64_t x = value & 0x1fffff;
    x = (x | x << 32) & 0x1f00000000ffffu;
    x = (x | x << 16) & 0x1f0000ff0000ffu;
    x = (x | x << 8) & 0x100f00f00f00f00fu;
    x = (x | x << 4) & 0x10c30c30c30c30c3u;
    return (x | x << 2) & 0x1249249249249249u;
}

/* What has neither particles nor nodes of any is left over from particles that fly. */
static bool is_wanted(const FoundBlock *block) { return block->particles > 0 || block->touched; }

static bool comes_before(const FoundBlock *a, const FoundBlock *b)
{
    const bool full_a = a->particles > 0, full_b = b->particles > 0;
    if (full_a != full_b) return full_a;
    return a->rank != b->rank ? a->rank < b->rank : a->morton < b->morton;
}

/* Bottom-up merge sort of the indices of the `count` blocks that are wanted; returns the sorted half of grid->sorted. */
static const uint32_t *sort_blocks(Grid *grid, uint32_t count)
{
    FoundBlock *found = grid->found.data;
    uint32_t *from = grid->sorted.data, *to = count ? from + count : from; /* if all fly there may be no memory */
    for (uint32_t i = 0, wanted = 0; i < grid->found_count; i++) {
        const int32_t *c = found[i].coordinate;
        found[i].index = GRID_NOWHERE;
        if (!is_wanted(&found[i])) continue;
        found[i].morton = spread_bits((uint32_t)(c[0] + 1)) | spread_bits((uint32_t)(c[1] + 1)) << 1 | spread_bits((uint32_t)(c[2] + 1)) << 2;
        from[wanted++] = i;
    }
    for (uint32_t width = 1; width < count; width *= 2) {
        for (uint32_t begin = 0; begin < count; begin += 2 * width) {
            const uint32_t middle = begin + width < count ? begin + width : count;
            const uint32_t end = middle + width < count ? middle + width : count;
            uint32_t left = begin, right = middle;
            for (uint32_t i = begin; i < end; i++) {
                const bool take_right = left == middle || (right < end && comes_before(&found[from[right]], &found[from[left]]));
                to[i] = take_right ? from[right++] : from[left++];
            }
        }
        uint32_t *swap = from;
        from = to;
        to = swap;
    }
    return from;
}

/* Counts the blocks and takes their memory. */
static bool reserve_blocks(Grid *grid, Memory *memory, bool with_volume)
{
    const FoundBlock *found = grid->found.data;
    grid->particle_blocks = grid->node_blocks = 0;
    for (uint32_t i = 0; i < grid->found_count; i++) {
        grid->particle_blocks += found[i].particles > 0;
        grid->node_blocks += is_wanted(&found[i]);
    }
    const size_t nodes = (size_t)grid->node_blocks, full = (size_t)grid->particle_blocks, all = full + (size_t)grid->flights;
    const size_t tile = (size_t)grid->tile_nodes * K_NODE_WIDTH + K_TILE_PAD;
    bool ok = array_reserve(memory, &grid->sorted, 2 * nodes, sizeof(uint32_t)) &&
              array_reserve(memory, &grid->coordinate, 3 * nodes, sizeof(int32_t)) &&
              array_reserve(memory, &grid->neighbour, nodes * (size_t)grid->neighbours, sizeof(int32_t)) &&
              array_reserve(memory, &grid->block_begin, all + 1, sizeof(uint32_t)) &&
              array_reserve(memory, &grid->block_run, all + 1, sizeof(uint32_t)) &&
              array_reserve(memory, &grid->tile, full * tile, sizeof(float)) &&
              array_reserve(memory, &grid->counts, GRID_COUNTS * all, sizeof(uint32_t)) &&
              array_reserve(memory, &grid->travel, all, sizeof(float));
    if (ok && with_volume) ok = array_reserve(memory, &grid->tile_volume, full * ((size_t)grid->tile_nodes + K_TILE_PAD), sizeof(float));
    return ok;
}

/* Gives every block its final index and sets where its particles begin. */
static void place_blocks(Grid *grid)
{
    const uint32_t *sorted = sort_blocks(grid, (uint32_t)grid->node_blocks);
    FoundBlock *found = grid->found.data;
    int32_t *coordinate = grid->coordinate.data;
    uint32_t *begin = grid->block_begin.data, particles = grid->first_row;
    grid->still_blocks = 0;
    for (int32_t i = 0; i < grid->node_blocks; i++) {
        FoundBlock *block = &found[sorted[i]];
        block->index = i;
        memcpy(coordinate + 3 * i, block->coordinate, sizeof block->coordinate);
        if (block->particles == 0) continue;
        begin[i] = particles;
        particles += block->particles;
        grid->still_blocks += block->rank != GRID_MOVING;
    }
    grid->flight_row = particles;
    for (int32_t flight = 0; flight < grid->flights; flight++) begin[grid->particle_blocks + flight] = particles + (uint32_t)flight * FLIGHT_ROWS;
    begin[grid_row_blocks(grid)] = grid->end_row;
}

/* For loops over blocks. */
typedef struct SortJob {
    Grid *grid;
    Particles *particles;
} SortJob;

static void link_neighbours(void *context, int32_t begin, int32_t end)
{
    const SortJob *job = context;
    const Grid *grid = job->grid;
    const FoundBlock *found = grid->found.data;
    for (int32_t b = begin; b < end; b++) {
        const int32_t *own = (int32_t *)grid->coordinate.data + 3 * b;
        for (int n = 0; n < grid->neighbours; n++) {
            int32_t c[3];
            grid_neighbour_offset(n, grid->dimension, c);
            for (int a = 0; a < 3; a++) c[a] += own[a];
            const uint32_t slot = *find_slot(grid, c);
            ((int32_t *)grid->neighbour.data)[b * grid->neighbours + n] = slot ? found[slot - 1].index : -1;
        }
    }
}

/* ---- Order of particles: stable counting sorts, by block, then inside each block by material and cell. ---- */

static void order_by_block(Grid *grid, bool listed)
{
    const FoundBlock *found = grid->found.data;
    uint32_t *begin = grid->block_begin.data, flying = grid->flight_row;
    for (uint32_t i = grid->first_row; i < grid->end_row; i++) {
        const uint32_t row = listed ? grid->order_scratch[i] : i;
        if (grid->block_of[row] < 0)
            grid->order[flying++] = row;
        else
            grid->order[begin[found[grid->block_of[row]].index]++] = row;
    }
    for (int32_t b = grid->particle_blocks - 1; b > 0; b--) begin[b] = begin[b - 1]; /* each ended where the next one began */
    if (grid->particle_blocks > 0) begin[0] = grid->first_row;
}

static uint32_t cell_in_block(const SortJob *job, uint32_t i)
{
    uint32_t cell = 0;
    for (int a = 0; a < job->particles->dimension; a++)
        cell |= (uint32_t)((job->particles->cell[a][i] - job->grid->anchor[a]) & CELL_IN_BLOCK) << (2 * a);
    return cell;
}

/* The particles are in order. Those that fly have no stencil to share. */
static uint32_t run_key_of(const SortJob *job, uint32_t i)
{
    const uint32_t cell = i < job->grid->flight_row ? cell_in_block(job, i) : 0;
    return cell | job->particles->material[i] << K_RUN_CELL_BITS;
}

enum { BUCKETS = 256 };
_Static_assert((int)BUCKETS >= (int)PBMPM_MAX_MATERIALS && BUCKETS > K_RUN_CELL_MASK, "one bucket per material or cell");

/* One stable counting pass over `count` entries of `from` with these keys: material slots, or cells in the block. Returns how many keys there are. */
static uint32_t counting_pass(const uint32_t *key, const uint32_t *from, uint32_t *to, uint32_t count)
{
    uint32_t start[BUCKETS + 1] = {0}, keys = 0;
    for (uint32_t i = 0; i < count; i++) start[key[i] + 1]++;
    for (int k = 0; k < BUCKETS; k++) {
        keys += start[k + 1] > 0;
        start[k + 1] += start[k];
    }
    for (uint32_t i = 0; i < count; i++) to[start[key[i]]++] = from[i];
    return keys;
}

/* Where keys are kept while particles are sorted: no run is listed yet. */
static uint32_t *keys_from(const Grid *grid, uint32_t row) { return grid->run_key + (row - grid->first_row); }

static uint32_t sort_by_material(const SortJob *job, uint32_t first, const uint32_t *from, uint32_t *to, uint32_t count)
{
    uint32_t *key = keys_from(job->grid, first);
    for (uint32_t i = 0; i < count; i++) key[i] = job->particles->material[from[i]];
    return counting_pass(key, from, to, count);
}

static uint32_t sort_by_cell(const SortJob *job, uint32_t first, const uint32_t *from, uint32_t *to, uint32_t count)
{
    uint32_t *key = keys_from(job->grid, first);
    for (uint32_t i = 0; i < count; i++) key[i] = cell_in_block(job, from[i]);
    return counting_pass(key, from, to, count);
}

/* Of particles in the order of their cells, each of which has them in the order of their materials. */
static uint32_t count_mixed_runs(const SortJob *job, const uint32_t *order, uint32_t count)
{
    const uint32_t *material = job->particles->material;
    uint32_t runs = 1;
    for (uint32_t i = 1; i < count; i++)
        runs += material[order[i]] != material[order[i - 1]] || cell_in_block(job, order[i]) != cell_in_block(job, order[i - 1]);
    return runs;
}

/* Leaves in block_run how many runs each block has. */
static void sort_inside_blocks(void *context, int32_t begin, int32_t end)
{
    const SortJob *job = context;
    const uint32_t *block_begin = job->grid->block_begin.data, *material = job->particles->material;
    uint32_t *runs = (uint32_t *)job->grid->block_run.data + 1;
    for (int32_t b = begin; b < end; b++) {
        const uint32_t first = block_begin[b], count = block_begin[b + 1] - first;
        uint32_t *order = job->grid->order + first, *scratch = job->grid->order_scratch + first;
        bool mixed = false;
        for (uint32_t i = 1; i < count; i++) mixed |= material[order[i]] != material[order[0]];
        if (mixed) {
            sort_by_material(job, first, order, scratch, count);
            sort_by_cell(job, first, scratch, order, count);
            runs[b] = count_mixed_runs(job, order, count);
        } else {
            runs[b] = sort_by_cell(job, first, order, scratch, count);
            memcpy(order, scratch, count * sizeof *order);
        }
    }
}

static void sort_flying(const SortJob *job)
{
    const uint32_t first = job->grid->flight_row, count = job->grid->end_row - first;
    uint32_t *order = job->grid->order + first, *scratch = job->grid->order_scratch + first;
    sort_by_material(job, first, order, scratch, count);
    memcpy(order, scratch, count * sizeof *order);
}

/* Particles are in order: a run ends where the key changes. */
static void count_flying_runs(void *context, int32_t begin, int32_t end)
{
    const SortJob *job = context;
    const uint32_t *block_begin = job->grid->block_begin.data;
    uint32_t *block_run = job->grid->block_run.data;
    for (int32_t b = job->grid->particle_blocks + begin; b < job->grid->particle_blocks + end; b++) {
        uint32_t runs = 1;
        for (uint32_t i = block_begin[b] + 1; i < block_begin[b + 1]; i++)
            runs += run_key_of(job, i) != run_key_of(job, i - 1);
        block_run[b + 1] = runs;
    }
}

static void write_runs(void *context, int32_t begin, int32_t end)
{
    const SortJob *job = context;
    Grid *grid = job->grid;
    const uint32_t *block_begin = grid->block_begin.data, *block_run = grid->block_run.data;
    for (int32_t b = begin; b < end; b++) {
        uint32_t run = block_run[b];
        for (uint32_t i = block_begin[b]; i < block_begin[b + 1]; i++) {
            const uint32_t key = run_key_of(job, i);
            if (i > block_begin[b] && key == grid->run_key[run - 1]) continue;
            grid->run_begin[run] = i;
            grid->run_key[run++] = key;
        }
    }
}

/* From how many runs blocks have to where theirs begin. */
static void place_runs(void *context, int32_t begin, int32_t end)
{
    const SortJob *job = context;
    Grid *grid = job->grid;
    uint32_t *block_run = grid->block_run.data;
    const int32_t blocks = grid_row_blocks(grid);
    (void)begin;
    (void)end;
    block_run[0] = 0;
    for (int32_t block = 0; block < blocks; block++) block_run[block + 1] += block_run[block];
    grid->runs = block_run[blocks];
    grid->run_begin[grid->runs] = grid->end_row;
}

/* ---- Particles that share no node with another one ---- */

typedef struct FlightJob {
    Grid *grid;
    const Particles *particles;
    bool listed;
} FlightJob;

/* No more such particles fit into a block: the cells of two differ by three or more along an axis. */
static uint32_t most_apart(const Grid *grid) { return 1u << grid->dimension; }

/* A cell with two particles makes the bits fewer; its block is left as it is. */
static bool may_hold_lone(const Grid *grid, const FoundBlock *block)
{
    return block->particles <= most_apart(grid) && (uint32_t)__builtin_popcountll(block->cells) == block->particles;
}

static void cell_of(const Grid *grid, const Particles *p, uint32_t row, int32_t cell[3])
{
    for (int a = 0; a < 3; a++) cell[a] = a < grid->dimension ? p->cell[a][row] - grid->anchor[a] : 0;
}

static bool is_alone(const Grid *grid, const FoundBlock *block, const int32_t cell[3])
{
    const uint64_t own = cell_bit(cell);
    for (int n = 0; n < grid->neighbours; n++) {
        int32_t offset[3], there[3];
        grid_neighbour_offset(n, grid->dimension, offset);
        const uint64_t near = block_cells_near(cell, offset, grid->dimension);
        if (near == 0) continue;
        const bool home = n == grid->neighbours / 2;
        for (int a = 0; a < 3; a++) there[a] = block->coordinate[a] + offset[a];
        const FoundBlock *other = home ? block : grid_found(grid, there);
        if (other && near & other->cells & ~(home ? own : 0)) return false;
    }
    return true;
}

/* Marks those that fly by a negative block. */
static void mark_flying(void *context, int32_t begin, int32_t end)
{
    const FlightJob *job = context;
    Grid *grid = job->grid;
    for (int32_t i = begin; i < end; i++) {
        const uint32_t at = grid->first_row + (uint32_t)i, row = job->listed ? grid->order_scratch[at] : at;
        const FoundBlock *block = (const FoundBlock *)grid->found.data + grid->block_of[row];
        int32_t cell[3];
        if (!may_hold_lone(grid, block) || block->rank != GRID_MOVING) continue;
        cell_of(grid, job->particles, row, cell);
        if (is_alone(grid, block, cell) && grid->flies(grid->flies_context, row)) grid->block_of[row] = -1 - grid->block_of[row];
    }
}

/* Takes a particle that flies out of its block. */
static void leave_block(Grid *grid, const Particles *p, uint32_t row)
{
    FoundBlock *block = (FoundBlock *)grid->found.data + (-1 - grid->block_of[row]);
    int32_t cell[3];
    cell_of(grid, p, row, cell);
    block->cells &= ~cell_bit(cell);
    block->particles--;
    grid->left_blocks += block->particles == 0;
}

static void let_fly(Grid *grid, const Particles *p, Pool *pool, bool listed)
{
    FlightJob job = {grid, p, listed};
    const FoundBlock *found = grid->found.data;
    uint32_t flying = 0;
    bool any = false;
    grid->flights = grid->left_blocks = 0;
    for (uint32_t i = 0; i < grid->found_count && grid->flies && !any; i++) any = may_hold_lone(grid, &found[i]);
    if (!any) return;
    pool_for(pool, (int32_t)(grid->end_row - grid->first_row), ROW_GRAIN, mark_flying, &job);
    for (uint32_t i = grid->first_row; i < grid->end_row; i++) {
        const uint32_t row = listed ? grid->order_scratch[i] : i;
        if (grid->block_of[row] >= 0) continue;
        leave_block(grid, p, row);
        flying++;
    }
    grid->flights = (int32_t)((flying + FLIGHT_ROWS - 1) / FLIGHT_ROWS);
}

static bool arrange_blocks(Grid *grid, Memory *memory, Pool *pool, bool with_volume)
{
    SortJob job = {.grid = grid};
    if (!find_touched_blocks(grid, memory) || !reserve_blocks(grid, memory, with_volume)) return false;
    place_blocks(grid);
    pool_for(pool, grid->node_blocks, BLOCK_GRAIN, link_neighbours, &job);
    return bodies_part(grid, memory) && grid_reserve_nodes(grid, memory, with_volume);
}

static pbmpm_result arrange(Grid *grid, Memory *memory, Particles *p, Loops *loops, bool with_volume, bool listed)
{
    let_fly(grid, p, loops->pool, listed);
    if (!arrange_blocks(grid, memory, loops->pool, with_volume)) {
        grid_clear(grid);
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a grid of %u blocks", grid->found_count);
    }
    const SortJob job = {grid, p};
    order_by_block(grid, listed);
    LOOPS_ADD(loops, grid_rows(grid, BLOCK_GRAIN), sort_inside_blocks, &job);
    if (grid->flights > 0) sort_flying(&job);
    return PBMPM_OK;
}

static void link_all(Grid *grid, Particles *p, Loops *loops)
{
    const SortJob job = {grid, p};
    const Span flights = {grid->flights, BLOCK_GRAIN, (int64_t)(grid->end_row - grid->flight_row) * PARTICLE_NS};
    if (grid->flights > 0) LOOPS_ADD(loops, flights, count_flying_runs, &job);
    LOOPS_ADD(loops, span_once(), place_runs, &job);
    LOOPS_ADD(loops, grid_rows_and_flights(grid, BLOCK_GRAIN), write_runs, &job);
}

pbmpm_result grid_finish(Grid *grid, Memory *memory, Particles *p, Pool *pool, bool with_volume, uint32_t first)
{
    grid->first_row = first;
    grid->end_row = p->count;
    Loops loops;
    loops_open(&loops, pool);
    const pbmpm_result result = arrange(grid, memory, p, &loops, with_volume, false);
    if (result != PBMPM_OK) return result;
    particles_reorder(p, grid->order, first, &loops);
    link_all(grid, p, &loops);
    loops_run(&loops);
    ASSERT(grid_is_sound(grid));
    return PBMPM_OK;
}

/* ---- Parts: grids of some of the particles each ---- */

pbmpm_result grid_arrange_part(Grid *part, Memory *memory, Particles *p, Pool *pool, bool with_volume)
{
    Loops loops;
    int32_t anchor[3];
    loops_open(&loops, pool);
    const uint32_t *row = part->order_scratch;
    Seen seen[8];
    see_none(seen);
    for (int a = 0; a < p->dimension; a++) {
        anchor[a] = INT32_MAX;
        for (uint32_t i = part->first_row; i < part->end_row; i++) anchor[a] = p->cell[a][row[i]] < anchor[a] ? p->cell[a][row[i]] : anchor[a];
    }
    bool added = grid_begin(part, memory, anchor);
    for (uint32_t i = part->first_row; i < part->end_row && added; i++) added = add_row(part, memory, p, row[i], seen);
    if (added) {
        const pbmpm_result result = arrange(part, memory, p, &loops, with_volume, true);
        loops_run(&loops);
        return result;
    }
    grid_clear(part);
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a grid of %u blocks", part->found_count);
}

void grid_link_part(Grid *part, Particles *p, Loops *loops) { link_all(part, p, loops); }

pbmpm_result grid_build(Grid *grid, Memory *memory, Particles *p, Pool *pool, bool with_volume)
{
    int32_t anchor[3];
    grid_drop_anchor(p, anchor);
    if (grid_begin(grid, memory, anchor) && grid_add_rows(grid, memory, p, 0, p->count))
        return grid_finish(grid, memory, p, pool, with_volume, 0);
    grid_clear(grid);
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a grid of %u blocks", grid->found_count);
}
