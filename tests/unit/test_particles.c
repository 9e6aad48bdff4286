/* Particle storage: adding, removing, reordering; every identifier finds its particle through all of it. */
#include <math.h>
#include <string.h>
#include <unity.h>

#include "books.h"
#include "matter/particles.h"
#include "random.h"

void setUp(void) {}
void tearDown(void) {}

enum { CAPACITY = 500 };

static Books books;
static Memory memory;
static Pool *pool;
static Particles particles;

static void open_particles(int dimension, bool with_deformation)
{
    memory = books_memory(&books, 0);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, pool_create(&memory, 2, NULL, &pool));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_init(&particles, &memory, dimension, CAPACITY));
    if (with_deformation) TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_enable_deformation(&particles, &memory));
}

static void close_particles(void)
{
    particles_free(&particles, &memory);
    pool_destroy(&memory, pool, true);
    books_expect_closed(&books, &memory);
}

/* A particle all of whose values follow from one number. */
static pbmpm_particle_id add_numbered(uint32_t number)
{
    const float n = (float)number;
    const uint32_t row = particles.count;
    const NewParticle particle = {{n, -n - 0.25, 2 * n}, {n, n + 1, n + 2}, n + 3, number % 7, 0};
    const pbmpm_particle_id id = particles_append(&particles, &particle, number + 1);
    particles.volume_ratio[row] = n + 4;
    for (int r = 0; r < particles.dimension; r++)
        for (int c = 0; c < particles.dimension; c++) {
            particles.affine[r * 3 + c][row] = n + (float)(5 + r * 3 + c);
            if (particles.deformation[0]) particles.deformation[r * 3 + c][row] = n - (float)(r * 3 + c);
        }
    return id;
}

static void expect_numbered(uint32_t row, uint32_t number)
{
    const float n = (float)number;
    bool same = particles.mass[row] == n + 3 && particles.volume_ratio[row] == n + 4 && particles.material[row] == number % 7 &&
                particles.cell[0][row] == (int32_t)number && particles.fraction[1][row] == -0.25f &&
                particles.cell[1][row] == -(int32_t)number && particles.status[row] == K_ALIVE;
    for (int r = 0; r < particles.dimension; r++) {
        same &= particles.velocity[r][row] == n + (float)r;
        for (int c = 0; c < particles.dimension; c++) {
            same &= particles.affine[r * 3 + c][row] == n + (float)(5 + r * 3 + c);
            if (particles.deformation[0]) same &= particles.deformation[r * 3 + c][row] == n - (float)(r * 3 + c);
        }
    }
    if (!same) TEST_FAIL_MESSAGE("a particle has another one's values");
}

static void expect_found(pbmpm_particle_id id, uint32_t number)
{
    uint32_t row = UINT32_MAX;
    TEST_ASSERT_TRUE(particles_row(&particles, id, &row));
    TEST_ASSERT_TRUE(row < particles.count && particles.id[row].index == id.index);
    expect_numbered(row, number);
}

/* ---- Positions ---- */

/* Cell and fraction add up to the position, and the fraction is in [-1/2, 1/2), also where rounding to float would leave it. */
static void test_positions(void)
{
    static const double special[] = {0, 0.5, -0.5, 0.49999999999, -0.49999999999, 1e6 + 0.5, -1e6 - 0.5, 1e6 + 0.49999999, 7.5, -7.5};
    Random random = {1};
    open_particles(3, false);
    particles.count = 1;
    for (int i = 0; i < 20000; i++) {
        double position[3];
        for (int a = 0; a < 3; a++)
            position[a] = i < 10 ? special[(i + a) % 10] : random_in(&random, -1.0, 1.0) * pow(10.0, random_in(&random, -3.0, 6.0));
        particles_set_position(&particles, 0, position);
        for (int a = 0; a < 3; a++) {
            const float fraction = particles.fraction[a][0];
            TEST_ASSERT_TRUE(fraction >= -0.5f && fraction < 0.5f);
            TEST_ASSERT_TRUE(fabs(particles_coordinate(&particles, 0, a) - position[a]) <= 3e-8);
        }
    }
    close_particles();
}

/* ---- Adding and removing ---- */

static void test_new_particles_start_undeformed_at_rest(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        open_particles(dimension, true);
        for (uint32_t i = 0; i < CAPACITY; i++) { /* the storage is used, not fresh */
            add_numbered(i);
            particles.status[i] = K_REMOVED;
        }
        particles_compact(&particles, 0);
        const NewParticle particle = {{1.25, 2.5, 3}, {4, 5, 6}, 7, 1, 0};
        const pbmpm_particle_id id = particles_append(&particles, &particle, 5000);
        TEST_ASSERT_EQUAL_UINT32(1, particles.count);
        TEST_ASSERT_EQUAL_UINT32(5000, id.generation);
        TEST_ASSERT_EQUAL_FLOAT(1.0f, particles.volume_ratio[0]);
        TEST_ASSERT_EQUAL_INT32(K_ALIVE, particles.status[0]);
        for (int r = 0; r < dimension; r++)
            for (int c = 0; c < dimension; c++) {
                TEST_ASSERT_EQUAL_FLOAT(0.0f, particles.affine[r * 3 + c][0]);
                TEST_ASSERT_EQUAL_FLOAT(r == c ? 1.0f : 0.0f, particles.deformation[r * 3 + c][0]);
            }
        close_particles();
    }
}

/* Elastic materials may come when there are particles already: those are undeformed, and nothing else changes. */
static void test_deformation_can_come_later(void)
{
    open_particles(3, false);
    pbmpm_particle_id ids[50];
    for (uint32_t i = 0; i < 50; i++) ids[i] = add_numbered(i);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_enable_deformation(&particles, &memory));
    const uint64_t calls = books.calls;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_enable_deformation(&particles, &memory)); /* the second time it does nothing */
    TEST_ASSERT_EQUAL_UINT64(calls, books.calls);
    for (uint32_t i = 0; i < 50; i++) {
        uint32_t row;
        TEST_ASSERT_TRUE(particles_row(&particles, ids[i], &row));
        for (int k = 0; k < 9; k++) {
            TEST_ASSERT_EQUAL_FLOAT(k % 4 == 0 ? 1.0f : 0.0f, particles.deformation[k][row]);
            particles.deformation[k][row] = (float)i - (float)k;
        }
        expect_found(ids[i], i);
    }
    close_particles();
}

static void test_removing_keeps_the_others_in_order(void)
{
    pbmpm_particle_id ids[CAPACITY];
    open_particles(2, true);
    for (uint32_t i = 0; i < CAPACITY; i++) ids[i] = add_numbered(i);
    for (uint32_t i = 0; i < CAPACITY; i++)
        if (i % 3 != 1) particles.status[i] = 1 + (int32_t)(i % 4);
    particles_compact(&particles, 0);
    TEST_ASSERT_EQUAL_UINT32((CAPACITY + 1) / 3, particles.count);
    for (uint32_t i = 0; i < CAPACITY; i++) {
        uint32_t row;
        if (i % 3 == 1) {
            expect_found(ids[i], i);
            TEST_ASSERT_TRUE(particles_row(&particles, ids[i], &row) && row == i / 3);
        } else {
            TEST_ASSERT_FALSE(particles_row(&particles, ids[i], &row));
        }
    }
    close_particles();
}

static void test_made_up_identifiers_are_refused(void)
{
    uint32_t row;
    open_particles(3, false);
    const pbmpm_particle_id id = add_numbered(4);
    TEST_ASSERT_TRUE(particles_row(&particles, id, &row));
    TEST_ASSERT_FALSE(particles_row(&particles, (pbmpm_particle_id){0}, &row));
    TEST_ASSERT_FALSE(particles_row(&particles, (pbmpm_particle_id){id.index, id.generation + 1}, &row));
    TEST_ASSERT_FALSE(particles_row(&particles, (pbmpm_particle_id){id.index, 0}, &row));
    TEST_ASSERT_FALSE(particles_row(&particles, (pbmpm_particle_id){CAPACITY, id.generation}, &row));
    TEST_ASSERT_FALSE(particles_row(&particles, (pbmpm_particle_id){UINT32_MAX, id.generation}, &row));
    close_particles();
}

/* ---- Order ---- */

static void shuffle(Random *random, uint32_t *order, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++) order[i] = i;
    for (uint32_t i = count; i > 1; i--) {
        const uint32_t j = random_below(random, i), kept = order[j];
        order[j] = order[i - 1];
        order[i - 1] = kept;
    }
}

static void reorder(const uint32_t *order)
{
    Loops loops;
    loops_open(&loops, pool);
    particles_reorder(&particles, order, 0, &loops);
    loops_run(&loops);
}

static void test_reordering_moves_all_fields(void)
{
    static uint32_t order[CAPACITY];
    for (int dimension = 2; dimension <= 3; dimension++) {
        Random random = {3};
        open_particles(dimension, dimension == 3);
        for (uint32_t i = 0; i < CAPACITY; i++) add_numbered(i);
        shuffle(&random, order, CAPACITY);
        reorder(order);
        for (uint32_t i = 0; i < CAPACITY; i++) expect_numbered(i, order[i]);
        close_particles();
    }
}

/* Adding, removing and reordering in any sequence: identifiers of the living find them, those of the dead find nothing. */
static void test_identifiers_through_a_long_life(void)
{
    enum { LIVES = 4000 };
    static pbmpm_particle_id ids[LIVES];
    static bool alive[LIVES];
    static uint32_t order[CAPACITY];
    Random random = {17};
    uint32_t born = 0;
    memset(alive, 0, sizeof alive);
    open_particles(3, true);
    for (int round = 0; round < 200; round++) {
        for (uint32_t n = random_below(&random, 40); n > 0 && particles.count < CAPACITY && born < LIVES; n--) {
            ids[born] = add_numbered(born);
            alive[born++] = true;
        }
        for (uint32_t i = 0; i < born; i++) {
            uint32_t row;
            if (!alive[i] || random_below(&random, 12) != 0) continue;
            TEST_ASSERT_TRUE(particles_row(&particles, ids[i], &row));
            particles.status[row] = K_REMOVED;
            alive[i] = false;
        }
        particles_compact(&particles, 0);
        shuffle(&random, order, particles.count);
        reorder(order);
        uint32_t living = 0, row;
        for (uint32_t i = 0; i < born; i++) {
            living += alive[i];
            if (alive[i])
                expect_found(ids[i], i);
            else
                TEST_ASSERT_FALSE(particles_row(&particles, ids[i], &row));
        }
        TEST_ASSERT_EQUAL_UINT32(living, particles.count);
        TEST_ASSERT_EQUAL_UINT32(CAPACITY - living, particles.free_count);
    }
    TEST_ASSERT_TRUE(born > CAPACITY); /* indices were used again */
    close_particles();
}

/* ---- Views ---- */

static void test_views_follow_changes(void)
{
    open_particles(2, false);
    for (uint32_t i = 0; i < 10; i++) add_numbered(i);
    const float *positions = particles_positions(&particles, 0.5, pool);
    TEST_ASSERT_TRUE(positions[2 * 4] == 2.0f && positions[2 * 4 + 1] == -2.125f);
    const float *kilograms = particles_kilograms(&particles, 0.25);
    TEST_ASSERT_TRUE(kilograms[5] == 2.0f);
    const double moved[3] = {100, 200, 0};
    particles_set_position(&particles, 4, moved);
    particles.mass[5] = 80.0f;
    particles_changed(&particles);
    TEST_ASSERT_TRUE(particles_positions(&particles, 0.5, pool)[2 * 4] == 50.0f);
    TEST_ASSERT_TRUE(particles_kilograms(&particles, 0.25)[5] == 20.0f);
    close_particles();
}

/* ---- Failure ---- */

static void test_every_refused_allocation_leaves_nothing_behind(void)
{
    bool done = false;
    for (uint64_t fail_at = 1; !done; fail_at++) {
        memory = books_memory(&books, 0);
        books.fail_at = fail_at;
        done = particles_init(&particles, &memory, 3, CAPACITY) == PBMPM_OK;
        if (done) particles_free(&particles, &memory);
        books_expect_closed(&books, &memory);
        TEST_ASSERT_TRUE(fail_at < 100);
    }
}

static void test_particles_survive_without_memory_for_deformation(void)
{
    open_particles(3, false);
    pbmpm_particle_id ids[20];
    for (uint32_t i = 0; i < 20; i++) ids[i] = add_numbered(i);
    books.fail_at = books.calls + 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_OUT_OF_MEMORY, particles_enable_deformation(&particles, &memory));
    TEST_ASSERT_NULL(particles.deformation[0]);
    for (uint32_t i = 0; i < 20; i++) expect_found(ids[i], i);
    close_particles();
}

static void test_fields_that_cannot_be_switched_on(void)
{
    static const FieldTag tags[] = {(FieldTag)0, FIELD_CELL, FIELD_STATUS, FIELD_ID, (FieldTag)99};
    open_particles(2, false);
    const int fields = particles.field_count;
    for (size_t i = 0; i < sizeof tags / sizeof *tags; i++)
        TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_UNSUPPORTED, particles_enable(&particles, &memory, tags[i]));
    TEST_ASSERT_EQUAL_INT(fields, particles.field_count);
    close_particles();
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_fields_that_cannot_be_switched_on);
    RUN_TEST(test_positions);
    RUN_TEST(test_new_particles_start_undeformed_at_rest);
    RUN_TEST(test_deformation_can_come_later);
    RUN_TEST(test_removing_keeps_the_others_in_order);
    RUN_TEST(test_made_up_identifiers_are_refused);
    RUN_TEST(test_reordering_moves_all_fields);
    RUN_TEST(test_identifiers_through_a_long_life);
    RUN_TEST(test_views_follow_changes);
    RUN_TEST(test_every_refused_allocation_leaves_nothing_behind);
    RUN_TEST(test_particles_survive_without_memory_for_deformation);
    return UNITY_END();
}
