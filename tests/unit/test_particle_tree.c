/* Looking particles up by place: every stretch that matters is visited, in order, and lines enter where a pass over all boxes says,
 * whatever order the particles are stored in. */
#include <math.h>
#include <unity.h>

#include "books.h"
#include "matter/particle_tree.h"
#include "random.h"

enum { CAPACITY = 6000 };

static Books books;
static Memory memory;
static Pool *pool;
static Particles particles;
static ParticleTree tree;

void setUp(void)
{
    memory = books_memory(&books, 0);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, pool_create(&memory, 3, NULL, &pool));
}

void tearDown(void)
{
    particle_tree_free(&tree, &memory);
    particles_free(&particles, &memory);
    pool_destroy(&memory, pool, true);
    books_expect_closed(&books, &memory);
}

/* Particles in a lump and a few far away; `mixed`: in no order at all. */
static void scatter(Random *random, int dimension, uint32_t count, bool mixed)
{
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_init(&particles, &memory, dimension, CAPACITY));
    for (uint32_t i = 0; i < count; i++) {
        const double along = mixed ? random_in(random, -40.0, 40.0) : -40.0 + 80.0 * i / count;
        NewParticle particle = {{along, random_in(random, -5.0, 5.0), random_in(random, -5.0, 5.0)}, {0}, 1.0f, 0, 0};
        if (i % 997 == 996) particle.position[1] += 2000.0;
        particles_append(&particles, &particle, 1);
    }
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particle_tree_build(&tree, &memory, &particles, 7, pool));
}

/* ---- Visits ---- */

typedef struct Ball {
    double centre[3];
    uint32_t next, visited; /* rows are visited in order */
    bool seen[CAPACITY];
} Ball;

static bool near_ball(const ParticleBox *box, void *context)
{
    const Ball *ball = context;
    for (int a = 0; a < particles.dimension; a++)
        if (ball->centre[a] < box->low[a] - 2.0 || ball->centre[a] > box->high[a] + 2.0) return false;
    return true;
}

static void note_rows(const ParticleBox *box, uint32_t begin, uint32_t end, void *context)
{
    Ball *ball = context;
    TEST_ASSERT_TRUE(begin >= ball->next && begin < end && end <= particles.count);
    for (uint32_t row = begin; row < end; row++) {
        for (int a = 0; a < particles.dimension; a++)
            TEST_ASSERT_TRUE(particles.cell[a][row] >= box->low[a] && particles.cell[a][row] <= box->high[a]);
        ball->seen[row] = true;
    }
    ball->next = end;
    ball->visited += end - begin;
}

static void check_visits(int dimension, uint32_t count, bool mixed)
{
    Random random = {count + (uint32_t)dimension};
    static Ball ball;
    uint64_t visited = 0;
    enum { QUESTIONS = 50 };
    scatter(&random, dimension, count, mixed);
    for (int k = 0; k < QUESTIONS; k++) {
        ball = (Ball){{random_in(&random, -44.0, 44.0), random_in(&random, -7.0, 7.0), random_in(&random, -7.0, 7.0)}, 0, 0, {false}};
        particle_tree_visit(&tree, near_ball, note_rows, &ball);
        for (uint32_t row = 0; row < count; row++) {
            bool near = true;
            for (int a = 0; a < dimension; a++) near &= fabs(particles_coordinate(&particles, row, a) - ball.centre[a]) < 1.5;
            TEST_ASSERT_TRUE(!near || ball.seen[row]);
        }
        visited += ball.visited;
    }
    if (!mixed && count > 2000) TEST_ASSERT_TRUE(visited < (uint64_t)QUESTIONS * count / 4); /* what lies in order is not searched through */
    tearDown();
    setUp();
}

static void test_visits(void)
{
    static const uint32_t counts[] = {1, 63, 64, 65, 511, 512, 513, 5000};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++)
        for (int mixed = 0; mixed < 2; mixed++) {
            check_visits(2, counts[i], mixed);
            check_visits(3, counts[i], mixed);
        }
}

static void test_nothing_to_visit(void)
{
    Random random = {1};
    static Ball ball;
    scatter(&random, 3, 0, false);
    particle_tree_visit(&tree, near_ball, note_rows, &ball);
    TEST_ASSERT_EQUAL_UINT32(0, ball.visited);
    TEST_ASSERT_TRUE(isinf(particle_tree_entry(&tree, &particles, ball.centre, (double[3]){1, 0, 0}, 0.0, 2.0)));
}

/* ---- Lines ---- */

/* The same for a single cell, without boxes of boxes. */
static double entry_of_cell(uint32_t row, const double start[3], const double direction[3], double from, double margin)
{
    double enter = from, leave = INFINITY;
    for (int a = 0; a < particles.dimension; a++) {
        const double way = particles.cell[a][row] - start[a];
        if (direction[a] == 0.0) {
            if (fabs(way) > margin) return INFINITY;
            continue;
        }
        const double near = (way - copysign(margin, direction[a])) / direction[a], far = (way + copysign(margin, direction[a])) / direction[a];
        enter = fmax(enter, near);
        leave = fmin(leave, far);
    }
    return enter <= leave ? enter : INFINITY;
}

/* A box holds more than its cells, so a line may enter it earlier than any cell, but never later; and never before `from`. */
static void test_lines_enter_no_later_than_cells(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        Random random = {5};
        scatter(&random, dimension, 3000, false);
        for (int k = 0; k < 200; k++) {
            const double start[3] = {random_in(&random, -60.0, 60.0), random_in(&random, -20.0, 20.0), random_in(&random, -20.0, 20.0)};
            double direction[3] = {random_in(&random, -1.0, 1.0), random_in(&random, -1.0, 1.0), random_in(&random, -1.0, 1.0)};
            if (k % 4 == 0) direction[0] = 0.0;
            if (k % 4 == 1) direction[1] = direction[2] = 0.0;
            const double from = k % 3 ? 0.0 : -INFINITY;
            double first = INFINITY;
            for (uint32_t row = 0; row < particles.count; row++) first = fmin(first, entry_of_cell(row, start, direction, from, 2.0));
            const double entry = particle_tree_entry(&tree, &particles, start, direction, from, 2.0);
            TEST_ASSERT_TRUE(entry >= from);
            if (!(entry <= first + 1e-9)) TEST_FAIL_MESSAGE("a line meets a cell before it enters a box");
        }
        tearDown();
        setUp();
    }
}

/* A line along a row of cells enters exactly where the row begins. */
static void test_a_line_through_a_single_box(void)
{
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_init(&particles, &memory, 3, CAPACITY));
    for (uint32_t i = 0; i < 10; i++) particles_append(&particles, &(NewParticle){{10.0 + i, 0, 0}, {0}, 1.0f, 0, 0}, 1);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particle_tree_build(&tree, &memory, &particles, 1, pool));
    const double along[3] = {1, 0, 0}, back[3] = {-1, 0, 0}, start[3] = {0, 0, 0}, beside[3] = {0, 2.5, 0}, behind[3] = {30, 0, 0};
    TEST_ASSERT_TRUE(particle_tree_entry(&tree, &particles, start, along, 0.0, 2.0) == 8.0);
    TEST_ASSERT_TRUE(particle_tree_entry(&tree, &particles, start, along, 12.5, 2.0) == 12.5);
    TEST_ASSERT_TRUE(isinf(particle_tree_entry(&tree, &particles, start, along, 21.5, 2.0)));
    TEST_ASSERT_TRUE(isinf(particle_tree_entry(&tree, &particles, start, back, 0.0, 2.0)));
    TEST_ASSERT_TRUE(isinf(particle_tree_entry(&tree, &particles, beside, along, 0.0, 2.0)));
    TEST_ASSERT_TRUE(particle_tree_entry(&tree, &particles, behind, back, -INFINITY, 2.0) == 9.0);
}

/* Between particles far from each other a box is empty: the line enters at the next of them. */
static void test_a_line_through_an_empty_box(void)
{
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_init(&particles, &memory, 2, CAPACITY));
    for (uint32_t i = 0; i < 10; i++) particles_append(&particles, &(NewParticle){{20000.0 * i, 0, 0}, {0}, 1.0f, 0, 0}, 1);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particle_tree_build(&tree, &memory, &particles, 1, pool));
    const double along[3] = {1, 0, 0}, start[3] = {0, 0, 0}, above[3] = {0, 2.5, 0};
    TEST_ASSERT_TRUE(particle_tree_entry(&tree, &particles, start, along, 0.0, 2.0) == 0.0);
    TEST_ASSERT_TRUE(particle_tree_entry(&tree, &particles, start, along, 2.5, 2.0) == 19998.0);
    TEST_ASSERT_TRUE(particle_tree_entry(&tree, &particles, start, along, 100002.5, 2.0) == 119998.0);
    TEST_ASSERT_TRUE(isinf(particle_tree_entry(&tree, &particles, start, along, 180002.5, 2.0)));
    TEST_ASSERT_TRUE(isinf(particle_tree_entry(&tree, &particles, above, along, 0.0, 2.0)));
}

/* ---- Life ---- */

static void test_boxes_are_made_once_per_generation(void)
{
    Random random = {2};
    scatter(&random, 2, 1000, false);
    const ParticleBox before = *(ParticleBox *)tree.box.data;
    particles.cell[0][0] = 77;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particle_tree_build(&tree, &memory, &particles, 7, pool));
    TEST_ASSERT_EQUAL_INT32(before.high[0], ((ParticleBox *)tree.box.data)->high[0]);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particle_tree_build(&tree, &memory, &particles, 8, pool));
    TEST_ASSERT_EQUAL_INT32(77, ((ParticleBox *)tree.box.data)->high[0]);
}

static void test_without_memory_the_next_question_tries_again(void)
{
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_init(&particles, &memory, 2, CAPACITY));
    particles_append(&particles, &(NewParticle){{0}, {0}, 1.0f, 0, 0}, 1);
    books.fail_at = books.calls + 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_OUT_OF_MEMORY, particle_tree_build(&tree, &memory, &particles, 3, pool));
    books.fail_at = 0;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particle_tree_build(&tree, &memory, &particles, 3, pool));
    TEST_ASSERT_EQUAL_UINT32(1, tree.count[0]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_visits);
    RUN_TEST(test_nothing_to_visit);
    RUN_TEST(test_lines_enter_no_later_than_cells);
    RUN_TEST(test_a_line_through_a_single_box);
    RUN_TEST(test_a_line_through_an_empty_box);
    RUN_TEST(test_boxes_are_made_once_per_generation);
    RUN_TEST(test_without_memory_the_next_question_tries_again);
    return UNITY_END();
}
