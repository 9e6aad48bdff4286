/* The sparse grid: order of particles, blocks, runs and neighbours. */
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "books.h"
#include "grid/bodies.h"
#include "grid/build.h"
#include "random.h"

void setUp(void) {}
void tearDown(void) {}

enum { CAPACITY = 6000 };

/* Storage of particles with a grid. */
typedef struct Sorted {
    Books books;
    Memory memory;
    Pool *pool;
    Particles particles;
    Grid grid;
} Sorted;

static void sorted_open(Sorted *s, int dimension, int threads)
{
    s->memory = books_memory(&s->books, 0);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, pool_create(&s->memory, threads, NULL, &s->pool));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_init(&s->particles, &s->memory, dimension, CAPACITY));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, grid_init(&s->grid, &s->memory, dimension, CAPACITY));
}

static void sorted_close(Sorted *s)
{
    grid_free(&s->grid, &s->memory);
    particles_free(&s->particles, &s->memory);
    pool_destroy(&s->memory, s->pool, true);
    books_expect_closed(&s->books, &s->memory);
}

static void sorted_build(Sorted *s, bool with_volume)
{
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, grid_build(&s->grid, &s->memory, &s->particles, s->pool, with_volume));
}

/* The mass says in which order particles came. */
static void add_at(Sorted *s, const int32_t cell[3], uint32_t material)
{
    const NewParticle particle = {.position = {cell[0], cell[1], cell[2]}, .mass = (float)s->particles.count, .material = material};
    particles_append(&s->particles, &particle, s->particles.count + 1);
}

typedef struct Cloud {
    int32_t centre[3];
    uint32_t spread, cells, most_per_cell, materials;
} Cloud;

static void add_cloud(Sorted *s, Random *random, const Cloud *cloud)
{
    for (uint32_t i = 0; i < cloud->cells; i++) {
        int32_t cell[3] = {0};
        for (int a = 0; a < s->particles.dimension; a++)
            cell[a] = cloud->centre[a] + (int32_t)random_below(random, 2 * cloud->spread + 1) - (int32_t)cloud->spread;
        for (uint32_t n = 1 + random_below(random, cloud->most_per_cell); n > 0; n--) add_at(s, cell, random_below(random, cloud->materials));
    }
}

static const Cloud clouds[] = {
    {{0, 0, 0}, 9, 200, 12, 1},      {{-3, 2, -1}, 5, 200, 12, 5},       {{1000, -1000, 77}, 60, 400, 3, 256},
    {{-1, -1, -1}, 0, 1, 40, 3},     {{1048000, -1048000, 1048000}, 2, 20, 5, 2}, {{0, 0, 0}, 1040000, 50, 2, 2},
};
enum { CLOUDS = sizeof clouds / sizeof *clouds };

/* ---- What must hold for every grid ---- */

static const int32_t *coordinate_of(const Grid *grid, int32_t block) { return (const int32_t *)grid->coordinate.data + 3 * block; }

static const int32_t *neighbours_of(const Grid *grid, int32_t block)
{
    return (const int32_t *)grid->neighbour.data + (size_t)block * (size_t)grid->neighbours;
}

/* Block coordinate and cell in the block, per axis. */
static void locate(const Sorted *s, uint32_t row, int32_t block[3], int32_t local[3])
{
    for (int a = 0; a < 3; a++) {
        const int32_t cell = a < s->particles.dimension ? s->particles.cell[a][row] - s->grid.anchor[a] : 0;
        local[a] = ((cell % K_BLOCK_AXIS) + K_BLOCK_AXIS) % K_BLOCK_AXIS;
        block[a] = (cell - local[a]) / K_BLOCK_AXIS;
    }
}

/* Every particle is in the block and run that list it. */
static void check_particles_are_where_they_belong(const Sorted *s)
{
    const Grid *grid = &s->grid;
    const uint32_t *block_begin = grid->block_begin.data, *block_run = grid->block_run.data;
    TEST_ASSERT_TRUE(block_begin[0] == 0 && block_begin[grid->particle_blocks] == s->particles.count);
    TEST_ASSERT_TRUE(block_run[0] == 0 && block_run[grid->particle_blocks] == grid->runs);
    TEST_ASSERT_TRUE(grid->run_begin[grid->runs] == s->particles.count);
    for (int32_t b = 0; b < grid->particle_blocks; b++) {
        TEST_ASSERT_TRUE(block_begin[b] < block_begin[b + 1] && block_run[b] < block_run[b + 1]);
        TEST_ASSERT_EQUAL_UINT32(block_begin[b], grid->run_begin[block_run[b]]);
        for (uint32_t r = block_run[b]; r < block_run[b + 1]; r++) {
            TEST_ASSERT_TRUE(grid->run_begin[r] < grid->run_begin[r + 1]);
            for (uint32_t row = grid->run_begin[r]; row < grid->run_begin[r + 1]; row++) {
                int32_t block[3], local[3];
                locate(s, row, block, local);
                const uint32_t cell = (uint32_t)(local[0] + 4 * local[1] + (s->particles.dimension == 3 ? 16 * local[2] : 0));
                if (memcmp(block, coordinate_of(grid, b), sizeof block) != 0) TEST_FAIL_MESSAGE("particle in a wrong block");
                if (grid->run_key[r] != (cell | s->particles.material[row] << K_RUN_CELL_BITS)) TEST_FAIL_MESSAGE("particle in a wrong run");
            }
        }
    }
}

/* Cells and, inside them, materials ascend in a block: so no two runs of a block are of the same sort. */
static void check_runs_ascend(const Grid *grid)
{
    const uint32_t *block_run = grid->block_run.data;
    for (int32_t b = 0; b < grid->particle_blocks; b++)
        for (uint32_t r = block_run[b] + 1; r < block_run[b + 1]; r++) {
            const uint32_t before = grid->run_key[r - 1], after = grid->run_key[r];
            const uint32_t cells[2] = {before & K_RUN_CELL_MASK, after & K_RUN_CELL_MASK};
            TEST_ASSERT_TRUE(cells[0] < cells[1] || (cells[0] == cells[1] && before >> K_RUN_CELL_BITS < after >> K_RUN_CELL_BITS));
        }
}

/* Particles of one run keep the order they came in, and nobody is lost or doubled. */
static void check_stable_permutation(const Sorted *s)
{
    static bool seen[CAPACITY];
    memset(seen, 0, sizeof seen);
    for (uint32_t i = 0; i < s->particles.count; i++) {
        const uint32_t number = (uint32_t)s->particles.mass[i];
        TEST_ASSERT_TRUE(number < s->particles.count && !seen[number]);
        seen[number] = true;
    }
    for (uint32_t r = 0; r < s->grid.runs; r++)
        for (uint32_t row = s->grid.run_begin[r] + 1; row < s->grid.run_begin[r + 1]; row++)
            TEST_ASSERT_TRUE(s->particles.mass[row] > s->particles.mass[row - 1]);
}

/* Neighbours are where they should be, all of the same body that exist are linked, and links go both ways. */
static void check_neighbours(const Grid *grid)
{
    const int centre = grid->neighbours / 2;
    for (int32_t b = 0; b < grid->node_blocks; b++) {
        TEST_ASSERT_EQUAL_INT32(b, neighbours_of(grid, b)[centre]);
        for (int n = 0; n < grid->neighbours; n++) {
            const int32_t other = neighbours_of(grid, b)[n];
            if (other < 0) continue;
            const int32_t step[3] = {n % 3 - 1, n / 3 % 3 - 1, grid->dimension == 3 ? n / 9 - 1 : 0};
            TEST_ASSERT_TRUE(other < grid->node_blocks && body_of_block(grid, other) == body_of_block(grid, b));
            for (int a = 0; a < 3; a++) TEST_ASSERT_EQUAL_INT32(coordinate_of(grid, b)[a] + step[a], coordinate_of(grid, other)[a]);
            TEST_ASSERT_EQUAL_INT32(b, neighbours_of(grid, other)[grid->neighbours - 1 - n]);
        }
    }
    for (int32_t b = 0; b < grid->node_blocks; b++)
        for (int32_t c = 0; c < b; c++) {
            int distance = 0, index = 0;
            for (int a = 2; a >= 0; a--) {
                const int32_t step = coordinate_of(grid, c)[a] - coordinate_of(grid, b)[a];
                distance = abs(step) > distance ? abs(step) : distance;
                if (a < grid->dimension) index = index * 3 + step + 1;
            }
            if (body_of_block(grid, b) != body_of_block(grid, c)) continue;
            TEST_ASSERT_TRUE(distance > 0); /* no block twice */
            if (distance == 1) TEST_ASSERT_EQUAL_INT32(c, neighbours_of(grid, b)[index]);
        }
}

/* Each of the 3^d nodes around each particle is in its block or in a neighbour that exists, and each block has such a node. */
static void check_touched_nodes_exist(const Sorted *s)
{
    const Grid *grid = &s->grid;
    const uint32_t *block_begin = grid->block_begin.data;
    static bool touched[27 * CAPACITY];
    memset(touched, 0, sizeof touched);
    for (int32_t b = 0; b < grid->particle_blocks; b++)
        for (uint32_t row = block_begin[b]; row < block_begin[b + 1]; row++) {
            int32_t block[3], local[3];
            locate(s, row, block, local);
            for (int n = 0; n < grid->neighbours; n++) {
                const int step[3] = {n % 3 - 1, n / 3 % 3 - 1, grid->dimension == 3 ? n / 9 - 1 : 0};
                int index = 0;
                for (int a = grid->dimension - 1; a >= 0; a--) {
                    const int node = local[a] + step[a];
                    index = index * 3 + (node < 0 ? 0 : node >= K_BLOCK_AXIS ? 2 : 1);
                }
                if (neighbours_of(grid, b)[index] < 0) TEST_FAIL_MESSAGE("a node that a particle touches does not exist");
                touched[neighbours_of(grid, b)[index]] = true;
            }
        }
    for (int32_t b = 0; b < grid->node_blocks; b++)
        if (!touched[b]) TEST_FAIL_MESSAGE("a block that no particle touches exists");
}

static uint64_t morton(const int32_t c[3])
{
    uint64_t code = 0;
    for (int bit = 0; bit < 21; bit++)
        for (int a = 0; a < 3; a++) code |= (uint64_t)((uint32_t)(c[a] + 1) >> bit & 1u) << (3 * bit + a);
    return code;
}

static bool is_before(const Grid *grid, int32_t b) { return morton(coordinate_of(grid, b - 1)) < morton(coordinate_of(grid, b)); }

/* The first block in the place of one. */
static int32_t first_there(const Grid *grid, int32_t b)
{
    int32_t first = 0;
    while (memcmp(coordinate_of(grid, first), coordinate_of(grid, b), 3 * sizeof(int32_t)) != 0) first++;
    return first;
}

/* Blocks with particles first, then others, both in Morton order; then copies in the order of these; blocks nobody touches do not exist. */
static void check_order_of_blocks(const Grid *grid)
{
    int32_t b = 1;
    while (b < grid->particle_blocks && is_before(grid, b)) b++;
    TEST_ASSERT_EQUAL_INT32(grid->particle_blocks, b);
    do b++;
    while (b < grid->node_blocks && is_before(grid, b));
    for (const int32_t copies = b; b < grid->node_blocks; b++)
        TEST_ASSERT_TRUE(first_there(grid, b) < copies && (b == copies || first_there(grid, b - 1) <= first_there(grid, b)));
    for (b = grid->particle_blocks; b < grid->node_blocks; b++) {
        bool near = false;
        for (int n = 0; n < grid->neighbours; n++) {
            const int32_t other = neighbours_of(grid, b)[n];
            near |= other >= 0 && other < grid->particle_blocks;
        }
        TEST_ASSERT_TRUE(near);
    }
}

static void check_grid(const Sorted *s)
{
    check_particles_are_where_they_belong(s);
    check_runs_ascend(&s->grid);
    check_stable_permutation(s);
    check_neighbours(&s->grid);
    check_touched_nodes_exist(s);
    check_order_of_blocks(&s->grid);
}

/* ---- Tests ---- */

static void test_clouds(void)
{
    static Sorted s;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int c = 0; c < CLOUDS; c++) {
            Random random = {(uint64_t)c};
            sorted_open(&s, dimension, 1 + c % 3);
            add_cloud(&s, &random, &clouds[c]);
            sorted_build(&s, c % 2);
            check_grid(&s);
            sorted_close(&s);
        }
}

/* Sorting what is sorted changes nothing; and one grid serves clouds of all sizes. */
static void test_building_again(void)
{
    static Sorted s;
    static float masses[CAPACITY];
    Random random = {5};
    sorted_open(&s, 3, 2);
    for (int c = 0; c < CLOUDS; c++) {
        for (uint32_t i = 0; i < s.particles.count; i++) s.particles.status[i] = K_REMOVED;
        particles_compact(&s.particles, 0);
        add_cloud(&s, &random, &clouds[c]);
        sorted_build(&s, false);
        check_grid(&s);
        memcpy(masses, s.particles.mass, s.particles.count * sizeof *masses);
        const uint64_t calls = s.books.calls;
        sorted_build(&s, false);
        TEST_ASSERT_EQUAL_MEMORY(masses, s.particles.mass, s.particles.count * sizeof *masses);
        TEST_ASSERT_EQUAL_UINT64(calls, s.books.calls); /* warm: no allocation */
    }
    sorted_close(&s);
}

/* Blocks, runs and neighbours depend on where the particles are, not on who came first. */
static void test_order_of_insertion_does_not_matter(void)
{
    static Sorted first, second;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int c = 0; c < CLOUDS; c++) {
            Random random = {(uint64_t)c + 50};
            sorted_open(&first, dimension, 1);
            sorted_open(&second, dimension, 3);
            add_cloud(&first, &random, &clouds[c]);
            for (uint32_t i = first.particles.count; i > 0; i--) {
                int32_t cell[3] = {0};
                for (int a = 0; a < dimension; a++) cell[a] = first.particles.cell[a][i - 1];
                add_at(&second, cell, first.particles.material[i - 1]);
            }
            sorted_build(&first, false);
            sorted_build(&second, false);
            const Grid *a = &first.grid, *b = &second.grid;
            TEST_ASSERT_TRUE(a->node_blocks == b->node_blocks && a->particle_blocks == b->particle_blocks && a->runs == b->runs);
            TEST_ASSERT_EQUAL_MEMORY(a->coordinate.data, b->coordinate.data, (size_t)a->node_blocks * 12);
            TEST_ASSERT_EQUAL_MEMORY(a->neighbour.data, b->neighbour.data, (size_t)(a->node_blocks * a->neighbours) * 4);
            TEST_ASSERT_EQUAL_MEMORY(a->run_key, b->run_key, a->runs * 4);
            TEST_ASSERT_EQUAL_MEMORY(a->run_begin, b->run_begin, (a->runs + 1) * 4);
            sorted_close(&first);
            sorted_close(&second);
        }
}

/* A scene that is shifted by whole cells is sorted the same way. */
static void test_shifting_does_not_matter(void)
{
    static const int32_t shifts[][3] = {{1, 0, 0}, {-7, 3, 2}, {100001, -99999, 5}};
    static Sorted s;
    static float masses[CAPACITY];
    static uint32_t keys[CAPACITY];
    for (int k = -1; k < 3; k++) {
        Random random = {8};
        sorted_open(&s, 3, 2);
        add_cloud(&s, &random, &clouds[1]);
        for (uint32_t i = 0; i < s.particles.count && k >= 0; i++)
            for (int a = 0; a < 3; a++) s.particles.cell[a][i] += shifts[k][a];
        sorted_build(&s, false);
        if (k < 0) {
            memcpy(masses, s.particles.mass, s.particles.count * sizeof *masses);
            memcpy(keys, s.grid.run_key, s.grid.runs * sizeof *keys);
        }
        TEST_ASSERT_EQUAL_MEMORY(masses, s.particles.mass, s.particles.count * sizeof *masses);
        TEST_ASSERT_EQUAL_MEMORY(keys, s.grid.run_key, s.grid.runs * sizeof *keys);
        sorted_close(&s);
    }
}

static void test_single_particle(void)
{
    static Sorted s;
    for (int dimension = 2; dimension <= 3; dimension++) {
        const int32_t cell[3] = {-1, -4, 3};
        sorted_open(&s, dimension, 1);
        add_at(&s, cell, 9);
        sorted_build(&s, true);
        check_grid(&s);
        TEST_ASSERT_EQUAL_INT32(1, s.grid.particle_blocks);
        TEST_ASSERT_EQUAL_UINT32(1, s.grid.runs);
        sorted_close(&s);
    }
}

/* Whichever allocation of the build fails: an error, particles and identifiers untouched, and the next try succeeds. */
static void test_failing_build_leaves_particles_alone(void)
{
    static Sorted s;
    static float masses[CAPACITY];
    uint64_t refused = 0;
    for (uint64_t fail = 1; refused + 1 == fail; fail++) {
        Random random = {4};
        sorted_open(&s, 3, 1);
        add_cloud(&s, &random, &clouds[2]);
        memcpy(masses, s.particles.mass, s.particles.count * sizeof *masses);
        s.books.fail_at = s.books.calls + fail;
        const pbmpm_result result = grid_build(&s.grid, &s.memory, &s.particles, s.pool, true);
        if (result != PBMPM_OK) {
            refused++;
            TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_OUT_OF_MEMORY, result);
            TEST_ASSERT_EQUAL_MEMORY(masses, s.particles.mass, s.particles.count * sizeof *masses);
            TEST_ASSERT_TRUE(s.grid.particle_blocks == 0 && s.grid.node_blocks == 0);
            for (uint32_t i = 0; i < s.particles.count; i++) {
                uint32_t row;
                TEST_ASSERT_TRUE(particles_row(&s.particles, s.particles.id[i], &row) && row == i);
            }
            sorted_build(&s, true);
        }
        check_grid(&s);
        sorted_close(&s);
    }
    TEST_ASSERT_TRUE(refused >= 10);
}

static void test_failing_init_leaves_nothing_behind(void)
{
    bool done = false;
    for (uint64_t fail_at = 1; !done; fail_at++) {
        Books books;
        Memory memory = books_memory(&books, 0);
        Grid grid;
        books.fail_at = fail_at;
        done = grid_init(&grid, &memory, 3, 100) == PBMPM_OK;
        if (done) grid_free(&grid, &memory);
        books_expect_closed(&books, &memory);
        TEST_ASSERT_TRUE(fail_at < 20);
    }
}

/* ---- Flight ---- */

static bool always(const void *context, uint32_t row)
{
    (void)context;
    (void)row;
    return true;
}

/* Particles fly that share no node with another one: where cells are more than two apart along some axis, wherever the borders of blocks are. */
static void test_only_lone_particles_fly(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int n = 0; n < 4 * (dimension == 2 ? 81 : 729); n++) {
            const int way = n / 4, deep = dimension == 3;
            const int32_t corner[3] = {-20, -20, deep ? -20 : 0}, from[3] = {n % 4, (n + 2) % 4, deep * (n + 1) % 4};
            const int32_t offset[3] = {way % 9 - 4, way / 9 % 9 - 4, deep ? way / 81 - 4 : 0};
            int32_t to[3];
            bool touch = true;
            for (int a = 0; a < 3; a++) to[a] = from[a] + offset[a];
            for (int a = 0; a < 3; a++) touch = touch && abs(offset[a]) <= 2;
            Sorted s = {0};
            sorted_open(&s, dimension, 1);
            s.grid.flies = always;
            add_at(&s, corner, 0); /* blocks are counted from it; it flies */
            add_at(&s, from, 0);
            add_at(&s, to, 0);
            sorted_build(&s, false);
            TEST_ASSERT_EQUAL_UINT32(touch ? 2 : 0, s.grid.flight_row);
            TEST_ASSERT_EQUAL_INT32(1, s.grid.flights);
            sorted_close(&s);
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_clouds);
    RUN_TEST(test_building_again);
    RUN_TEST(test_order_of_insertion_does_not_matter);
    RUN_TEST(test_shifting_does_not_matter);
    RUN_TEST(test_single_particle);
    RUN_TEST(test_failing_build_leaves_particles_alone);
    RUN_TEST(test_failing_init_leaves_nothing_behind);
    RUN_TEST(test_only_lone_particles_fly);
    return UNITY_END();
}
