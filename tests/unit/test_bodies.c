/* Bodies: blocks of particles that touch the same nodes belong together, and each body has its own node blocks. */
#include <string.h>

#include <unity.h>

#include "grid/bodies.h"
#include "books.h"
#include "grid/build.h"

void setUp(void) {}
void tearDown(void) {}

enum { CAPACITY = 4000 };

typedef struct Matter {
    Books books;
    Memory memory;
    Pool *pool;
    Particles particles;
    Grid grid;
} Matter;

static void matter_open(Matter *m, int dimension)
{
    *m = (Matter){0};
    m->memory = books_memory(&m->books, 0);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, pool_create(&m->memory, 1, NULL, &m->pool));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_init(&m->particles, &m->memory, dimension, CAPACITY));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, grid_init(&m->grid, &m->memory, dimension, CAPACITY));
}

static void matter_close(Matter *m)
{
    grid_free(&m->grid, &m->memory);
    particles_free(&m->particles, &m->memory);
    pool_destroy(&m->memory, m->pool, true);
    books_expect_closed(&m->books, &m->memory);
}

/* One particle per cell in a row of `cells` along the first axis. */
static void add_row(Matter *m, int first, int cells, int height)
{
    for (int i = 0; i < cells; i++) {
        const NewParticle particle = {.position = {first + i, height, 0.0}, .mass = 1.0f};
        particles_append(&m->particles, &particle, m->particles.count + 1);
    }
}

static void find(Matter *m)
{
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, grid_build(&m->grid, &m->memory, &m->particles, m->pool, false));
    for (int32_t b = 0; b < m->grid.node_blocks; b++) {
        const int32_t body = body_of_block(&m->grid, b);
        TEST_ASSERT_TRUE(body >= 0 && body < m->grid.bodies);
    }
}

static int32_t body_of_row(const Matter *m, uint32_t row)
{
    const uint32_t *begin = m->grid.block_begin.data;
    int32_t block = 0;
    while (begin[block + 1] <= row) block++;
    return body_of_block(&m->grid, block);
}

static void test_a_long_body_is_one(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        Matter m;
        matter_open(&m, dimension);
        add_row(&m, -40, 200, 3);
        find(&m);
        TEST_ASSERT_EQUAL_INT32(1, m.grid.bodies);
        matter_close(&m);
    }
}

/* Far apart they are three, whatever the order of their particles. */
static void test_bodies_that_are_apart(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        Matter m;
        matter_open(&m, dimension);
        for (int i = 0; i < 10; i++) {
            add_row(&m, 100 + 2 * i, 2, 0);
            add_row(&m, 0 + 2 * i, 2, 0);
            add_row(&m, 0 + 2 * i, 2, 50);
        }
        find(&m);
        TEST_ASSERT_EQUAL_INT32(3, m.grid.bodies);
        for (uint32_t i = 0; i < m.particles.count; i++)
            for (uint32_t k = 0; k < i; k++) {
                const bool same = (m.particles.cell[0][i] < 60) == (m.particles.cell[0][k] < 60) &&
                                  (m.particles.cell[1][i] < 25) == (m.particles.cell[1][k] < 25);
                TEST_ASSERT_EQUAL_INT(same, body_of_row(&m, i) == body_of_row(&m, k));
            }
        matter_close(&m);
    }
}

/* Matter joins what it is put between. */
static void test_a_bridge_joins(void)
{
    Matter m;
    matter_open(&m, 2);
    add_row(&m, 0, 8, 0);
    add_row(&m, 40, 8, 0);
    find(&m);
    TEST_ASSERT_EQUAL_INT32(2, m.grid.bodies);
    add_row(&m, 8, 32, 0);
    find(&m);
    TEST_ASSERT_EQUAL_INT32(1, m.grid.bodies);
    matter_close(&m);
}

/* Places of node blocks that a body has, and how often. */
static int blocks_at(const Matter *m, int32_t body, const int32_t place[3])
{
    int count = 0;
    for (int32_t b = 0; b < m->grid.node_blocks; b++)
        count += body_of_block(&m->grid, b) == body && memcmp((const int32_t *)m->grid.coordinate.data + 3 * b, place, 3 * sizeof *place) == 0;
    return count;
}

/* The blocks at the places that the particles of a block touch are its neighbours, of its own body, and there are no others. */
static void expect_own_nodes(const Matter *m)
{
    const Grid *grid = &m->grid;
    for (int32_t b = 0; b < grid->particle_blocks; b++) {
        const int32_t *own = (const int32_t *)grid->coordinate.data + 3 * b, *neighbour = (const int32_t *)grid->neighbour.data + b * grid->neighbours;
        for (int n = 0; n < grid->neighbours; n++) {
            int32_t place[3];
            grid_neighbour_offset(n, grid->dimension, place);
            for (int a = 0; a < 3; a++) place[a] += own[a];
            const int known = blocks_at(m, body_of_block(grid, b), place);
            TEST_ASSERT_EQUAL_INT(neighbour[n] >= 0, known);
            if (known) TEST_ASSERT_EQUAL_INT32(body_of_block(grid, b), body_of_block(grid, neighbour[n]));
            if (known) TEST_ASSERT_EQUAL_MEMORY(place, (const int32_t *)grid->coordinate.data + 3 * neighbour[n], sizeof place);
        }
    }
}

/* Rows of cells that are three apart share no node, two apart they do; wherever the blocks begin. Of rows in one block there is one body. */
static void test_near_bodies_have_nodes_of_their_own(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int start = 0; start < K_BLOCK_AXIS; start++)
            for (int apart = 1; apart < 2 * K_BLOCK_AXIS; apart++) {
                Matter m;
                matter_open(&m, dimension);
                add_row(&m, 0, 1, 0);
                add_row(&m, start, 30, 2 * K_BLOCK_AXIS + start);
                add_row(&m, start, 30, 2 * K_BLOCK_AXIS + start + apart);
                find(&m);
                const bool in_one_block = start + apart < K_BLOCK_AXIS;
                TEST_ASSERT_EQUAL_INT32(1 + (apart > 2 && !in_one_block ? 2 : 1), m.grid.bodies);
                expect_own_nodes(&m);
                matter_close(&m);
            }
}

/* A ring around a ball: their blocks are mixed along all axes. */
static void test_a_ball_in_a_ring(void)
{
    Matter m;
    matter_open(&m, 2);
    for (int y = -20; y <= 20; y++)
        for (int x = -20; x <= 20; x++) {
            const int square = x * x + y * y;
            if (square < 8 * 8 || (square > 15 * 15 && square < 19 * 19)) add_row(&m, x, 1, y);
        }
    find(&m);
    TEST_ASSERT_EQUAL_INT32(2, m.grid.bodies);
    expect_own_nodes(&m);
    matter_close(&m);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_long_body_is_one);
    RUN_TEST(test_bodies_that_are_apart);
    RUN_TEST(test_a_bridge_joins);
    RUN_TEST(test_near_bodies_have_nodes_of_their_own);
    RUN_TEST(test_a_ball_in_a_ring);
    return UNITY_END();
}
