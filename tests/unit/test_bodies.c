/* Bodies: blocks of particles that touch the same nodes belong together. */
#include <unity.h>

#include "grid/bodies.h"
#include "books.h"

void setUp(void) {}
void tearDown(void) {}

enum { CAPACITY = 4000 };

typedef struct Matter {
    Books books;
    Memory memory;
    Pool *pool;
    Particles particles;
    Grid grid;
    Bodies bodies;
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
    bodies_free(&m->bodies, &m->memory);
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
    TEST_ASSERT_TRUE(bodies_find(&m->bodies, &m->memory, &m->grid));
    for (int32_t b = 0; b < m->grid.node_blocks; b++) {
        const int32_t body = ((const int32_t *)m->bodies.of_block.data)[b];
        TEST_ASSERT_TRUE(body >= 0 && body < m->bodies.count);
    }
}

static int32_t body_of_row(const Matter *m, uint32_t row)
{
    const uint32_t *begin = m->grid.block_begin.data;
    int32_t block = 0;
    while (begin[block + 1] <= row) block++;
    return ((const int32_t *)m->bodies.of_block.data)[block];
}

static void test_a_long_body_is_one(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        Matter m;
        matter_open(&m, dimension);
        add_row(&m, -40, 200, 3);
        find(&m);
        TEST_ASSERT_EQUAL_INT32(1, m.bodies.count);
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
        TEST_ASSERT_EQUAL_INT32(3, m.bodies.count);
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
    TEST_ASSERT_EQUAL_INT32(2, m.bodies.count);
    add_row(&m, 8, 32, 0);
    find(&m);
    TEST_ASSERT_EQUAL_INT32(1, m.bodies.count);
    matter_close(&m);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_long_body_is_one);
    RUN_TEST(test_bodies_that_are_apart);
    RUN_TEST(test_a_bridge_joins);
    return UNITY_END();
}
