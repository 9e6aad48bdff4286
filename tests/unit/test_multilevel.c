/* The multilevel preconditioner: a symmetric, positive operator, whose levels interpolate linear fields exactly. */
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "books.h"
#include "grid/build.h"
#include "grid/multilevel.h"
#include "random.h"

void setUp(void) {}
void tearDown(void) {}

enum { CAPACITY = 6000 };

typedef struct Hats {
    Books books;
    Memory memory;
    Pool *pool;
    Particles particles;
    Grid grid;
    Multilevel levels;
    size_t floats;
    float *mass, *stiffness, *a, *b, *za, *zb;
} Hats;

/* The fourth value of vectors. */
static bool unused(const Hats *h, size_t i) { return h->levels.width > 1 && i % (size_t)h->levels.width == 3; }

static void weigh(Hats *h, double overlap)
{
    Loops loops;
    loops_open(&loops, h->pool);
    multilevel_weigh(&h->levels, &loops, h->mass, h->stiffness, overlap);
    loops_run(&loops);
}

/* A ragged cloud of cells: blocks with holes, and neighbours that are missing. */
static void hats_open(Hats *h, int dimension, int width, int threads, uint32_t seed, int spread)
{
    Random random = {seed};
    *h = (Hats){0};
    h->memory = books_memory(&h->books, 0);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, pool_create(&h->memory, threads, NULL, &h->pool));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_init(&h->particles, &h->memory, dimension, CAPACITY));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, grid_init(&h->grid, &h->memory, dimension, CAPACITY));
    for (int i = 0; i < 800; i++) {
        NewParticle particle = {.mass = 1.0f};
        for (int a = 0; a < dimension; a++) particle.position[a] = (double)random_below(&random, (uint32_t)spread);
        particles_append(&h->particles, &particle, (uint32_t)i + 1);
    }
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, grid_build(&h->grid, &h->memory, &h->particles, h->pool, false));
    TEST_ASSERT_TRUE(multilevel_build(&h->levels, &h->memory, &h->grid, width, width == 1 ? LEVELS_BEYOND : LEVELS_OVER_MATTER));
    h->floats = (size_t)h->grid.node_blocks * (size_t)h->grid.block_cells * (size_t)width;
    float **arrays[] = {&h->mass, &h->stiffness, &h->a, &h->b, &h->za, &h->zb};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        *arrays[i] = calloc(h->floats, sizeof(float));
        for (size_t k = 0; k < h->floats; k++) (*arrays[i])[k] = unused(h, k) ? 0.0f : (float)random_in(&random, i < 2 ? 0.1 : -1.0, 1.0);
    }
    weigh(h, 1.0);
}

static void hats_close(Hats *h)
{
    float *arrays[] = {h->mass, h->stiffness, h->a, h->b, h->za, h->zb};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) free(arrays[i]);
    multilevel_free(&h->levels, &h->memory);
    grid_free(&h->grid, &h->memory);
    particles_free(&h->particles, &h->memory);
    pool_destroy(&h->memory, h->pool, true);
    books_expect_closed(&h->books, &h->memory);
}

static void apply(Hats *h, const float *r, float *z)
{
    memset(z, 0, h->floats * sizeof *z);
    Loops loops;
    loops_open(&loops, h->pool);
    multilevel_add(&h->levels, &loops, r, z);
    loops_run(&loops);
}

static double dot(const Hats *h, const float *x, const float *y)
{
    double sum = 0.0;
    for (size_t i = 0; i < h->floats; i++) sum += unused(h, i) ? 0.0 : (double)x[i] * (double)y[i];
    return sum;
}

/* <a, B b> = <B a, b> and <a, B a> > 0: otherwise L-BFGS would have no descent. Rounding: sums of some 1e4 terms of single precision. */
static void test_symmetric_and_positive(void)
{
    for (int kind = 0; kind < 4; kind++)
        for (int spread = 3; spread <= 96; spread *= 2) {
            Hats h;
            hats_open(&h, 2 + kind / 2, kind % 2 ? K_NODE_WIDTH : 1, 1, 7, spread);
            apply(&h, h.a, h.za);
            apply(&h, h.b, h.zb);
            const double left = dot(&h, h.b, h.za), right = dot(&h, h.a, h.zb);
            const double size = sqrt(dot(&h, h.a, h.za) * dot(&h, h.b, h.zb));
            TEST_ASSERT_TRUE(h.levels.levels >= 2);
            TEST_ASSERT_TRUE(dot(&h, h.a, h.za) > 0.0 && dot(&h, h.b, h.zb) > 0.0);
            TEST_ASSERT_DOUBLE_WITHIN(1e-5 * size, left, right);
            hats_close(&h);
        }
}

/* A force on one node moves others as far as the coarsest hats reach, more than the hats of width 2 that a node is in, and always along the
 * force. */
static void test_a_force_reaches_far(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        Hats h;
        hats_open(&h, dimension, K_NODE_WIDTH, 1, 3, dimension == 3 ? 16 : 24);
        TEST_ASSERT_EQUAL_INT32(1, h.grid.bodies); /* hats end where a body does */
        memset(h.a, 0, h.floats * sizeof *h.a);
        h.a[(size_t)(h.grid.particle_blocks / 2 * h.grid.block_cells) * K_NODE_WIDTH] = 1.0f;
        apply(&h, h.a, h.za);
        size_t moved = 0;
        for (size_t i = 0; i < h.floats; i++) {
            TEST_ASSERT_TRUE(i % K_NODE_WIDTH == 0 ? h.za[i] >= 0.0f : h.za[i] == 0.0f);
            moved += h.za[i] > 0.0f;
        }
        TEST_ASSERT_TRUE(moved > (dimension == 3 ? 7u * 7u * 7u : 7u * 7u));
        hats_close(&h);
    }
}

/* The diagonal of the first coarse level is the energy of its hats: for m = k = 1 in the middle of a solid block, where they are not cut off,
 * (2/3)^d 2^d and overlap d/2 (1/4) (2/3)^(d-1) 2^d. */
static void test_the_diagonal_is_the_energy_of_hats(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        Hats h;
        hats_open(&h, dimension, 1, 1, 7, 3);
        for (size_t i = 0; i < h.floats; i++) h.mass[i] = h.stiffness[i] = 1.0f;
        weigh(&h, 3.0);
        const double d = dimension, volume = pow(2.0, d);
        const double expected = volume * (pow(2.0 / 3.0, d) + 3.0 * 0.5 * d * 0.25 * pow(2.0 / 3.0, d - 1.0));
        const float *inverse = h.levels.level[1].inverse.data;
        float least = INFINITY;
        for (size_t i = 0; i < (size_t)h.levels.level[1].blocks * (size_t)h.grid.block_cells; i++)
            if (inverse[i] > 0.0f) least = fminf(least, inverse[i]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 / expected, 1.0 / expected, (double)least);
        hats_close(&h);
    }
}

/* Sums have one order: the same bits with any number of threads. */
static void test_threads_change_nothing(void)
{
    Hats one, four;
    hats_open(&one, 3, 1, 1, 11, 40);
    hats_open(&four, 3, 1, 4, 11, 40);
    apply(&one, one.a, one.za);
    apply(&four, four.a, four.za);
    TEST_ASSERT_EQUAL_size_t(one.floats, four.floats);
    TEST_ASSERT_EQUAL_MEMORY(one.za, four.za, one.floats * sizeof *one.za);
    hats_close(&one);
    hats_close(&four);
}

/* Without memory it says so and leaves nothing behind. */
static void test_no_memory(void)
{
    for (uint64_t refused = 1; refused < 12; refused++) {
        Hats h;
        hats_open(&h, 2, 1, 1, 5, 96);
        Multilevel fresh = {0};
        h.books.fail_at = h.books.calls + refused;
        const bool built = multilevel_build(&fresh, &h.memory, &h.grid, K_NODE_WIDTH, LEVELS_OVER_MATTER);
        TEST_ASSERT_TRUE(built || h.books.calls >= h.books.fail_at);
        h.books.fail_at = 0;
        multilevel_free(&fresh, &h.memory);
        hats_close(&h);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_symmetric_and_positive);
    RUN_TEST(test_a_force_reaches_far);
    RUN_TEST(test_the_diagonal_is_the_energy_of_hats);
    RUN_TEST(test_threads_change_nothing);
    RUN_TEST(test_no_memory);
    return UNITY_END();
}
