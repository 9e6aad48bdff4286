/* What the method conserves: mass exactly, linear and angular momentum to rounding, and independence of the place. */
#include <math.h>
#include <stdio.h>

#include "scenes.h"

enum { STEPS = 1000 };

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

static void cross(const double a[3], const double b[3], double product[3])
{
    for (int i = 0; i < 3; i++)
        product[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

static double length(const double a[3])
{
    return sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

/* ---- momentum ---- */

typedef struct moments {
    double mass, linear[3], angular[3];
    double moving; /* sum of m |v|: what rounding errors of the linear momentum are measured against */
} moments;

typedef struct particle_state {
    double mass, place[3], speed[3];
    double spin[3]; /* velocity gradient's, twice: axl(C - C^T) */
} particle_state;

typedef struct state_views {
    pbmpm_view position, velocity, gradient, mass;
} state_views;

static state_views state_views_of(pbmpm_world_id world)
{
    return (state_views){view_of(world, PBMPM_POSITION), view_of(world, PBMPM_VELOCITY), view_of(world, PBMPM_AFFINE_VELOCITY),
                         view_of(world, PBMPM_MASS)};
}

static particle_state state_of(const state_views *views, uint32_t row)
{
    const uint32_t d = views->position.components;
    particle_state state = {.mass = (double)view_float(&views->mass, row, 0)};
    double gradient[3][3] = {{0}};
    for (uint32_t a = 0; a < d; a++) {
        state.place[a] = (double)view_float(&views->position, row, a);
        state.speed[a] = (double)view_float(&views->velocity, row, a);
        for (uint32_t b = 0; b < d; b++)
            gradient[a][b] = (double)view_float(&views->gradient, row, a * d + b);
    }
    for (int a = 0; a < 3; a++)
        state.spin[a] = gradient[(a + 2) % 3][(a + 1) % 3] - gradient[(a + 1) % 3][(a + 2) % 3];
    return state;
}

/* Sums over the views; the angular momentum is about the centre of mass. The affine part is m dx^2/4 times the spin. */
static moments moments_of(pbmpm_world_id world, double cell_size)
{
    const state_views views = state_views_of(world);
    double centre[3] = {0};
    moments sum = {0};
    for (uint32_t i = 0; i < views.mass.count; i++) {
        const particle_state p = state_of(&views, i);
        sum.mass += p.mass;
        sum.moving += p.mass * length(p.speed);
        for (int a = 0; a < 3; a++) {
            centre[a] += p.mass * p.place[a];
            sum.linear[a] += p.mass * p.speed[a];
        }
    }
    for (uint32_t i = 0; i < views.mass.count; i++) {
        particle_state p = state_of(&views, i);
        double moment[3];
        for (int a = 0; a < 3; a++)
            p.place[a] -= centre[a] / sum.mass;
        cross(p.place, p.speed, moment);
        for (int a = 0; a < 3; a++)
            sum.angular[a] += p.mass * (moment[a] + cell_size * cell_size / 4 * p.spin[a]);
    }
    return sum;
}

/* Gives every particle the velocity of a rigid motion, its neighbourhood included. */
static void set_rigid_motion(pbmpm_world_id world, const double drift[3], const double spin[3])
{
    enum { ROOM = 24576 };
    static float velocities[3 * ROOM], gradients[9 * ROOM];
    const pbmpm_view x = view_of(world, PBMPM_POSITION);
    const uint32_t d = x.components, count = x.count;
    TEST_ASSERT_TRUE(count <= ROOM);
    for (uint32_t i = 0; i < count; i++) {
        double place[3] = {0}, turn[3];
        for (uint32_t a = 0; a < d; a++)
            place[a] = (double)view_float(&x, i, a);
        cross(spin, place, turn);
        for (uint32_t a = 0; a < d; a++) {
            velocities[i * d + a] = (float)(drift[a] + turn[a]);
            for (uint32_t b = 0; b < d; b++) {
                double axis[3] = {0}, column[3];
                axis[b] = 1;
                cross(spin, axis, column);
                gradients[(i * d + a) * d + b] = (float)column[a];
            }
        }
    }
    OK(pbmpm_particles_set(world, PBMPM_VELOCITY, NULL, count, velocities));
    OK(pbmpm_particles_set(world, PBMPM_AFFINE_VELOCITY, NULL, count, gradients));
}

static void expect_conserved(const moments *first, const moments *now, int step)
{
    char label[160];
    double linear[3], angular[3];
    for (int a = 0; a < 3; a++) {
        linear[a] = now->linear[a] - first->linear[a];
        angular[a] = now->angular[a] - first->angular[a];
    }
    snprintf(label, sizeof label, "step %d: linear off by %.2e, angular by %.2e", step, length(linear) / first->moving,
             length(angular) / length(first->angular));
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-13 * first->mass, first->mass, now->mass, label); /* the order of the sum may change */
    TEST_ASSERT_TRUE_MESSAGE(length(linear) <= 1e-6 * first->moving, label);
    TEST_ASSERT_TRUE_MESSAGE(length(angular) <= 1e-5 * length(first->angular), label);
}

/* What remains of the drift is round-off: a random walk, mostly from the rounding of the nodes' masses, that falls with the root
 * of their number. The body has 1,000 to 2,000 cells. */
static void check_momentum(int32_t dimension)
{
    const double cell_size = dimension == 3 ? 0.0625 : 0.025, dt = cell_size / 10;
    const double drift[3] = {0.3, -0.2, dimension == 3 ? 0.1 : 0}, spin[3] = {dimension == 3 ? 1.0 : 0, dimension == 3 ? -0.5 : 0, 2.0};
    const pbmpm_world_def def = default_world(dimension, (float)cell_size, 24576);
    const pbmpm_world_id world = papers_world(&def);
    const pbmpm_material_id jelly = create_material(world, PBMPM_ELASTIC);
    fill_shape(world, jelly, box_shape(0, 0, 0, 0.5f, 0.3f, 0.4f), (const float[3]){0, 0, 0});
    set_rigid_motion(world, drift, spin);
    const moments first = moments_of(world, cell_size);
    for (int step = 1; step <= STEPS; step++) {
        OK(pbmpm_world_step(world, (float)dt));
        if (step % 100 == 0) {
            const moments now = moments_of(world, cell_size);
            expect_conserved(&first, &now, step);
        }
    }
    TEST_ASSERT_EQUAL_UINT64(0, world_stats(world).deleted_total);
}

static void test_momentum_of_a_free_elastic_body_in_2d(void)
{
    check_momentum(2);
}

static void test_momentum_of_a_free_elastic_body_in_3d(void)
{
    check_momentum(3);
}

/* ---- mass ---- */

static void test_mass_is_density_times_rest_volume(void)
{
    const float positions[6] = {0, 0, 0.1f, 0, 0.2f, 0.1f}, volumes[3] = {0.25f, 0.5f, 0.125f};
    const pbmpm_world_def def = default_world(2, 0.125f, 8); /* powers of two: no rounding */
    const pbmpm_world_id world = papers_world(&def);
    pbmpm_material_def material = default_material(PBMPM_LIQUID);
    pbmpm_particles_def particles;
    material.density = 512;
    OK(pbmpm_particles_def_init(&particles, sizeof particles));
    OK(pbmpm_material_create(world, &material, &particles.material));
    particles.count = 3;
    particles.positions = positions;
    particles.volumes = volumes;
    OK(pbmpm_particles_add(world, &particles, NULL));
    for (int i = 0; i < 10; i++) {
        OK(pbmpm_world_step(world, 0.01f));
        TEST_ASSERT_TRUE(world_stats(world).mass == 512.0 * 0.875);
    }
}

static void test_scenes_keep_their_mass(void)
{
    for (int s = 0; s < scene_count; s++) {
        const stage made = scenes[s].build(NULL, NULL);
        const double first = world_stats(made.world).mass;
        scene_run(&scenes[s], &made, 0, 50);
        TEST_ASSERT_EQUAL_UINT64(0, world_stats(made.world).deleted_total);
        TEST_ASSERT_DOUBLE_WITHIN(1e-13 * first, first, world_stats(made.world).mass);
        OK(pbmpm_world_destroy(made.world));
    }
}

/* ---- removal ---- */

/* The kernels load whole gangs: what lies behind the last particle must not matter, wherever the matter is. */
static void remove_some(int32_t dimension, pbmpm_material_kind kind, float place, uint32_t removed)
{
    enum { MOST = 64 };
    const pbmpm_world_def def = default_world(dimension, 0.125f, 8192);
    const pbmpm_world_id world = papers_world(&def);
    pbmpm_particle_id ids[MOST];
    uint32_t found = 0;
    char label[96];
    fill_shape(world, create_material(world, kind), box_shape(place, place, place, 0.5f, 0.5f, 0.5f), (const float[3]){0, 0, 0});
    OK(pbmpm_world_step(world, 1.0f / 60));
    const pbmpm_shape everything = sphere_shape(place, place, place, 10);
    OK(pbmpm_query_shape(world, &everything, ids, MOST, &found));
    OK(pbmpm_particles_remove(world, ids, removed));
    for (int step = 0; step < 10; step++)
        OK(pbmpm_world_step(world, 1.0f / 60));
    snprintf(label, sizeof label, "%dD, kind %d, at %g m, %u removed", (int)dimension, (int)kind, (double)place, removed);
    TEST_ASSERT_EQUAL_UINT32_MESSAGE(found - removed, world_count(world), label);
    world_expect_finite(world, label);
    OK(pbmpm_world_destroy(world));
}

static void test_removal_does_not_touch_the_others(void)
{
    static const uint32_t counts[] = {1, 3, 5, 40};
    static const float places[] = {-5, 0, 5};
    for (int32_t dimension = 2; dimension <= 3; dimension++)
        for (size_t c = 0; c < sizeof counts / sizeof *counts; c++)
            for (size_t p = 0; p < sizeof places / sizeof *places; p++) {
                remove_some(dimension, PBMPM_LIQUID, places[p], counts[c]);
                remove_some(dimension, PBMPM_ELASTIC, places[p], counts[c]);
            }
}

/* ---- free fall ---- */

/* After the time t the speed is g t, and the way differs from g t^2/2 by no more than g t dt/2. The body keeps its
 * shape. */
static void check_free_fall(int32_t dimension, pbmpm_material_kind kind)
{
    const double g = 9.81, dt = 1.0 / 128, t = 1;
    const pbmpm_world_def def = default_world(dimension, 0.1f, 8192);
    const pbmpm_world_id world = papers_world(&def);
    const pbmpm_material_id matter = create_material(world, kind);
    fill_shape(world, matter, box_shape(0.3f, 0.2f, 0.1f, 0.4f, 0.4f, 0.4f), (const float[3]){0, 0, 0});
    set_gravity(world, 0, (float)-g, 0);
    const pbmpm_view start = view_of(world, PBMPM_POSITION);
    double before = 0, after = 0;
    for (uint32_t i = 0; i < start.count; i++)
        before += (double)view_float(&start, i, 1) / start.count;
    for (int i = 0; i < 128; i++)
        OK(pbmpm_world_step(world, (float)dt));
    const pbmpm_view end = view_of(world, PBMPM_POSITION), velocity = view_of(world, PBMPM_VELOCITY);
    for (uint32_t i = 0; i < end.count; i++) {
        after += (double)view_float(&end, i, 1) / end.count;
        TEST_ASSERT_FLOAT_WITHIN(1e-3f, (float)(-g * t), view_float(&velocity, i, 1));
        TEST_ASSERT_FLOAT_WITHIN(1e-3f, 0, view_float(&velocity, i, 0));
    }
    TEST_ASSERT_DOUBLE_WITHIN(g * t * dt / 2 * 1.01, g * t * t / 2, before - after);
    /* The liquid's volume feedback evens out the jittered filling. */
    TEST_ASSERT_TRUE(world_stats(world).volume_error_max < (kind == PBMPM_ELASTIC ? 1e-5f : 1e-2f));
}

static void test_free_fall(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        check_free_fall(dimension, PBMPM_ELASTIC);
        check_free_fall(dimension, PBMPM_LIQUID);
    }
}

/* ---- whole-cell translation ---- */

enum { MOVED_COUNT = 600, TRANSLATED_STEPS = 100 };

typedef struct moved_world {
    pbmpm_world_id world;
    pbmpm_particle_id ids[MOVED_COUNT];
} moved_world;

/* A heap of liquid and elastic particles that falls on a ledge, all of it shifted by whole cells of 1/8 m. Every number in
 * it is a multiple of 2^-10, so that the shifted one is exact. */
static moved_world build_moved(int32_t dimension, const int32_t cells[3])
{
    static float positions[3 * MOVED_COUNT];
    const float cell_size = 0.125f;
    const uint32_t d = (uint32_t)dimension;
    const pbmpm_world_def def = default_world(dimension, cell_size, MOVED_COUNT);
    moved_world made = {.world = papers_world(&def)};
    float shift[3];
    uint32_t seed = 17;
    for (int a = 0; a < 3; a++)
        shift[a] = (float)cells[a] * cell_size;
    for (uint32_t i = 0; i < MOVED_COUNT * d; i++)
        positions[i] = shift[i % d] + (float)(random_next(&seed) % 640) / 1024.0f;
    create_collider(made.world, box_shape(shift[0], shift[1] - 0.25f, shift[2], 1, 0.125f, 1), false);
    for (uint32_t half = 0; half < 2; half++) {
        pbmpm_particles_def particles;
        OK(pbmpm_particles_def_init(&particles, sizeof particles));
        particles.material = create_material(made.world, half ? PBMPM_ELASTIC : PBMPM_LIQUID);
        particles.count = MOVED_COUNT / 2;
        particles.positions = positions + half * d * MOVED_COUNT / 2;
        OK(pbmpm_particles_add(made.world, &particles, made.ids + half * MOVED_COUNT / 2));
    }
    set_gravity(made.world, 1, -9.81f, 0);
    for (int i = 0; i < TRANSLATED_STEPS; i++)
        OK(pbmpm_world_step(made.world, 1.0f / 128));
    return made;
}

/* Fails unless a field of all particles has the same bits in both worlds. */
static void expect_same_bits(const moved_world *one, const moved_world *two, pbmpm_field field, const char *label)
{
    static uint32_t rows_one[MOVED_COUNT], rows_two[MOVED_COUNT];
    OK(pbmpm_particles_find(one->world, one->ids, MOVED_COUNT, rows_one));
    OK(pbmpm_particles_find(two->world, two->ids, MOVED_COUNT, rows_two));
    const pbmpm_view first = view_of(one->world, field), second = view_of(two->world, field);
    for (uint32_t i = 0; i < MOVED_COUNT; i++)
        for (uint32_t c = 0; c < first.components; c++)
            TEST_ASSERT_EQUAL_HEX32_MESSAGE(view_uint(&first, rows_one[i], c), view_uint(&second, rows_two[i], c), label);
}

static void expect_shifted(const moved_world *one, const moved_world *two, const int32_t cells[3], const char *label)
{
    static uint32_t rows_one[MOVED_COUNT], rows_two[MOVED_COUNT];
    OK(pbmpm_particles_find(one->world, one->ids, MOVED_COUNT, rows_one));
    OK(pbmpm_particles_find(two->world, two->ids, MOVED_COUNT, rows_two));
    const pbmpm_view first = view_of(one->world, PBMPM_POSITION), second = view_of(two->world, PBMPM_POSITION);
    for (uint32_t i = 0; i < MOVED_COUNT; i++)
        for (uint32_t a = 0; a < first.components; a++) {
            const float shifted = view_float(&first, rows_one[i], a) + (float)cells[a] * 0.125f;
            TEST_ASSERT_FLOAT_WITHIN_MESSAGE(1e-6f + 2.5e-7f * fabsf(shifted), shifted, view_float(&second, rows_two[i], a), label);
        }
}

static void check_translation(int32_t dimension)
{
    static const int32_t shifts[][3] = {{1, 0, 0}, {0, -1, 2}, {4, 8, -4}, {-64, 37, 5}, {1000, -4096, 12345}};
    static const pbmpm_field fields[] = {PBMPM_VELOCITY, PBMPM_AFFINE_VELOCITY, PBMPM_VOLUME_RATIO, PBMPM_DEFORMATION};
    const int32_t none[3] = {0, 0, 0};
    const moved_world here = build_moved(dimension, none);
    for (size_t s = 0; s < sizeof shifts / sizeof *shifts; s++) {
        char label[64];
        const moved_world there = build_moved(dimension, shifts[s]);
        snprintf(label, sizeof label, "shifted by %d, %d, %d cells", (int)shifts[s][0], (int)shifts[s][1], (int)shifts[s][2]);
        for (size_t f = 0; f < sizeof fields / sizeof *fields; f++)
            expect_same_bits(&here, &there, fields[f], label);
        expect_shifted(&here, &there, shifts[s], label);
        OK(pbmpm_world_destroy(there.world));
    }
}

static void test_whole_cell_translation_in_2d(void)
{
    check_translation(2);
}

static void test_whole_cell_translation_in_3d(void)
{
    check_translation(3);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_momentum_of_a_free_elastic_body_in_2d);
    RUN_TEST(test_momentum_of_a_free_elastic_body_in_3d);
    RUN_TEST(test_mass_is_density_times_rest_volume);
    RUN_TEST(test_scenes_keep_their_mass);
    RUN_TEST(test_removal_does_not_touch_the_others);
    RUN_TEST(test_free_fall);
    RUN_TEST(test_whole_cell_translation_in_2d);
    RUN_TEST(test_whole_cell_translation_in_3d);
    return UNITY_END();
}
