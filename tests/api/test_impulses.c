/* Impulses on obstacles and walls through the public interface: the momentum that matter and obstacles exchange, to the last part in 100,000. */
#include <math.h>

#include "rules.h"
#include "solids.h"

void setUp(void) {}

void tearDown(void)
{
    bake_forget();
    pbmpm_shutdown();
}

typedef struct exchange {
    pbmpm_world_id world;
    pbmpm_collider_id collider;
    pbmpm_stats stats;
    double angular[3]; /* of matter, from all forces but gravity */
} exchange;

static pbmpm_impulse impulse_of(pbmpm_world_id world, pbmpm_collider_id collider)
{
    pbmpm_impulse impulse = {.size = sizeof impulse};
    OK(pbmpm_collider_impulse(world, collider, &impulse));
    return impulse;
}

static pbmpm_impulse wall_impulse(pbmpm_world_id world, int32_t axis, int32_t upper)
{
    pbmpm_impulse impulse = {.size = sizeof impulse};
    OK(pbmpm_domain_impulse(world, axis, upper, &impulse));
    return impulse;
}

static const float DT = 1.0f / 120, PULL = -9.81f;

static exchange make_threaded_exchange(int32_t threads, int32_t dimension, pbmpm_solver solver, pbmpm_material_kind kind, float wall_friction,
                                       int32_t substeps, bool measure)
{
    pbmpm_world_def def = default_world(dimension, 0.1f, 9000);
    def.domain_enabled = 1;
    for (int a = 0; a < 3; a++) def.domain_max[a] = 1.6f;
    def.domain_friction = wall_friction;
    def.domain_measures_impulse = measure;
    def.thread_count = threads;
    exchange e = {.world = create_world(&def)};
    pbmpm_settings settings = default_settings();
    settings.gravity[1] = PULL;
    settings.solver = solver;
    settings.substeps = substeps;
    settings.iterations = solver == PBMPM_SOLVER_EXPLICIT ? 1 : 6;
    OK(pbmpm_world_set_settings(e.world, &settings));
    pbmpm_material_def material;
    pbmpm_material_id id;
    OK(pbmpm_material_def_init(&material, sizeof material));
    material.kind = kind;
    material.young_modulus = 2e4f;
    if (kind == PBMPM_LIQUID && solver >= PBMPM_SOLVER_PRIMAL) material.bulk_modulus = 2e4f;
    if (kind == PBMPM_LIQUID && solver == PBMPM_SOLVER_DUAL) material.kinematic_viscosity = 0.02f;
    OK(pbmpm_material_create(e.world, &material, &id));
    fill_shape(e.world, id, box_shape(0.5f, 0.6f, 0.6f, 0.4f, 0.4f, 0.4f), (const float[3]){2, -1, 0.5f});
    pbmpm_collider_def collider = default_collider();
    bake_ball(dimension, 0.35);
    const pbmpm_shape ball = baked_shape(load_baked(e.world), 0.9f, 0.3f, 0.7f);
    collider.kinematic = 1;
    collider.friction_coefficient = 0.5f;
    collider.measures_impulse = measure;
    OK(pbmpm_collider_create(e.world, &collider, &ball, &e.collider));
    return e;
}

static exchange make_exchange(int32_t dimension, pbmpm_solver solver, pbmpm_material_kind kind, float wall_friction, int32_t substeps, bool measure)
{
    return make_threaded_exchange(1, dimension, solver, kind, wall_friction, substeps, measure);
}

static void step_exchange(exchange *e, int step)
{
    const float angle = 0.02f * (float)step;
    const float position[3] = {0.9f - 0.004f * (float)step, 0.3f + 0.002f * (float)step, 0.7f}, rotation[4] = {0, 0, sinf(angle), cosf(angle)};
    OK(pbmpm_collider_move(e->world, e->collider, position, rotation));
    OK(pbmpm_world_step(e->world, DT));
    e->stats = world_stats(e->world);
}

/* Matter's momentum changes by gravity * mass * dt less what colliders and walls got, in each step, to 1e-5 of all that was exchanged. */
static void check_books(int32_t dimension, pbmpm_solver solver, pbmpm_material_kind kind, float wall_friction)
{
    exchange e = make_exchange(dimension, solver, kind, wall_friction, solver == PBMPM_SOLVER_EXPLICIT ? 8 : 2, true);
    double touched = 0.0;
    e.stats = world_stats(e.world);
    const int steps = dimension == 3 ? 30 : 60;
    for (int step = 1; step <= steps; step++) {
        const pbmpm_stats old = e.stats;
        step_exchange(&e, step);
        TEST_ASSERT_EQUAL_UINT64(0, e.stats.clamped_total + e.stats.deleted_total);
        pbmpm_impulse all = impulse_of(e.world, e.collider);
        const double weight = e.stats.mass * (double)PULL * (double)DT;
        double size = fabs(weight);
        for (int a = 0; a < dimension; a++) touched += fabs(all.linear[a]);
        for (int32_t axis = 0; axis < dimension; axis++)
            for (int32_t upper = 0; upper < 2; upper++) {
                const pbmpm_impulse one = wall_impulse(e.world, axis, upper);
                for (int a = 0; a < 3; a++) {
                    all.linear[a] += one.linear[a];
                    size += fabs(one.linear[a]);
                }
            }
        for (int a = 0; a < dimension; a++) {
            const double missing = e.stats.momentum[a] - old.momentum[a] + all.linear[a] - (a == 1 ? weight : 0.0);
            TEST_ASSERT_DOUBLE_WITHIN(1e-5 * (size + fabs(impulse_of(e.world, e.collider).linear[a])), 0.0, missing);
        }
    }
    TEST_ASSERT_TRUE(touched > 0.0);
}

static void check_books_of(pbmpm_solver solver)
{
    for (int32_t d = 2; d <= 3; d++) {
        check_books(d, solver, PBMPM_LIQUID, 0.0f);
        check_books(d, solver, PBMPM_LIQUID, 0.3f);
        check_books(d, solver, PBMPM_ELASTIC, 0.3f);
    }
}

static void test_books_of_the_papers_solver(void) { check_books_of(PBMPM_SOLVER_PAPER); }
static void test_books_of_the_dual_solver(void) { check_books_of(PBMPM_SOLVER_DUAL); }
static void test_books_of_the_primal_solver(void) { check_books_of(PBMPM_SOLVER_PRIMAL); }
static void test_books_of_the_explicit_solver(void) { check_books_of(PBMPM_SOLVER_EXPLICIT); }

/* Measuring changes nothing else, and does not depend on threads. In 3D there are enough particles for more than one. */
static void run_exchange(int32_t threads, bool measure, uint64_t *hash, pbmpm_impulse *impulse)
{
    exchange e = make_threaded_exchange(threads, 3, PBMPM_SOLVER_PAPER, PBMPM_LIQUID, 0.3f, 2, measure);
    for (int step = 1; step <= 40; step++) step_exchange(&e, step);
    *hash = world_hash(e.world);
    if (measure) *impulse = impulse_of(e.world, e.collider);
}

static void test_measuring_changes_nothing(void)
{
    uint64_t with, without, shared;
    pbmpm_impulse impulse, of_threads;
    run_exchange(1, true, &with, &impulse);
    run_exchange(1, false, &without, NULL);
    run_exchange(3, true, &shared, &of_threads);
    TEST_ASSERT_EQUAL_HEX64(without, with);
    TEST_ASSERT_EQUAL_HEX64(with, shared);
    TEST_ASSERT_EQUAL_MEMORY(impulse.linear, of_threads.linear, sizeof impulse.linear); /* not the whole: what lies between the fields is nobody's */
    TEST_ASSERT_EQUAL_MEMORY(impulse.angular, of_threads.angular, sizeof impulse.angular);
}

static void test_impulses_that_nobody_measures(void)
{
    const exchange e = make_exchange(2, PBMPM_SOLVER_PAPER, PBMPM_LIQUID, 0.0f, 1, false);
    pbmpm_impulse impulse = {.size = sizeof impulse};
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_impulse(e.world, e.collider, &impulse));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_domain_impulse(e.world, 0, 0, &impulse));
    const exchange measured = make_exchange(2, PBMPM_SOLVER_PAPER, PBMPM_LIQUID, 0.0f, 1, true);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_domain_impulse(measured.world, 2, 0, &impulse));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_domain_impulse(measured.world, 0, 2, &impulse));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_collider_impulse(measured.world, e.collider, &impulse));
    impulse.size--;
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_collider_impulse(measured.world, measured.collider, &impulse));
}

/* Water at rest on a floor of many plates presses on each with its weight; more plates meet in one block than it has notes for. */
static void test_many_plates_share_the_weight(void)
{
    enum { PLATES = 16 };
    pbmpm_world_def def = default_world(2, 0.1f, 4000);
    const pbmpm_world_id world = papers_world(&def);
    pbmpm_collider_id plate[PLATES];
    set_gravity(world, 0, -10, 0);
    set_rate(world, 2, 10);
    for (int i = 0; i < PLATES; i++) {
        pbmpm_collider_def made = default_collider();
        const pbmpm_shape shape = box_shape(0.05f + 0.1f * (float)i, -0.2f, 0, 0.05f, 0.2f, 0.5f);
        made.measures_impulse = 1;
        OK(pbmpm_collider_create(world, &made, &shape, &plate[i]));
    }
    for (int side = 0; side < 2; side++) {
        pbmpm_collider_def made = default_collider();
        pbmpm_collider_id wall;
        const pbmpm_shape shape = plane_shape(side ? 1.6f : 0, 0, 0, side ? -1 : 1, 0, 0);
        made.friction = PBMPM_FRICTION_SLIP; /* bears no weight */
        OK(pbmpm_collider_create(world, &made, &shape, &wall));
    }
    fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0.8f, 0.3f, 0, 0.8f, 0.3f, 0.5f), (const float[3]){0, 0, 0});
    double sum = 0.0, mass = 0.0;
    for (int step = 0; step < 240; step++) {
        OK(pbmpm_world_step(world, 1.0f / 120));
        for (int i = 0; i < PLATES && step >= 120; i++) sum += impulse_of(world, plate[i]).linear[1];
        mass = world_stats(world).mass;
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.02 * mass * 10, -mass * 10, sum); /* over a second */
}

/* A turned force: what a spinning stick-rough ball gives to matter around it is taken from its own angular impulse. */
static void check_torque(pbmpm_solver solver)
{
    pbmpm_world_def def = default_world(2, 0.1f, 4000);
    const pbmpm_world_id world = create_world(&def);
    pbmpm_settings settings = default_settings();
    settings.solver = solver;
    settings.iterations = 6;
    OK(pbmpm_world_set_settings(world, &settings));
    pbmpm_collider_def made = default_collider();
    pbmpm_collider_id ball;
    const pbmpm_shape shape = sphere_shape(1.0f, 0.5f, 0, 0.4f);
    made.kinematic = made.measures_impulse = 1;
    made.friction = PBMPM_FRICTION_STICK;
    OK(pbmpm_collider_create(world, &made, &shape, &ball));
    const pbmpm_material_id jelly = create_material(world, PBMPM_ELASTIC);
    const pbmpm_shape hole = sphere_shape(1.0f, 0.5f, 0, 0.4f);
    fill_shape(world, jelly, sphere_shape(1.0f, 0.5f, 0, 0.9f), (const float[3]){0, 0, 0});
    OK(pbmpm_particles_remove_in(world, &hole, NULL));
    const float position[3] = {1.0f, 0.5f, 0};
    double given = 0.0;
    for (int step = 1; step <= 10; step++) {
        const float angle = 0.01f * (float)step, rotation[4] = {0, 0, sinf(0.5f * angle), cosf(0.5f * angle)};
        const pbmpm_stats old = world_stats(world);
        OK(pbmpm_collider_move(world, ball, position, rotation));
        OK(pbmpm_world_step(world, 1.0f / 120));
        const pbmpm_stats now = world_stats(world);
        const pbmpm_impulse impulse = impulse_of(world, ball);
        const double about_origin = impulse.angular[2] + (double)position[0] * impulse.linear[1] - (double)position[1] * impulse.linear[0];
        TEST_ASSERT_DOUBLE_WITHIN(1e-3 * (fabs(about_origin) + 1.0), -about_origin, now.angular_momentum[2] - old.angular_momentum[2]);
        TEST_ASSERT_TRUE(impulse.angular[0] == 0.0 && impulse.angular[1] == 0.0);
        given -= impulse.angular[2];
    }
    TEST_ASSERT_TRUE(given > 10.0); /* it did turn */
}

static void test_angular_impulses(void)
{
    check_torque(PBMPM_SOLVER_PAPER);
    check_torque(PBMPM_SOLVER_DUAL);
}

#ifndef PBMPM_SANITIZED

/* ---- A body that floats ---- */

/* The mean height of a box's middle over the last seconds. The box has `share` of the water's density, half extents of 0.25 and 0.3 m, and
 * moves up and down alone. */
static double float_box(double share, double *level)
{
    enum { RATE = 120, SECONDS = 7, MEASURED = 4 };
    pbmpm_world_def def = default_world(2, 0.05f, 9000);
    def.domain_enabled = 1;
    for (int a = 0; a < 2; a++) def.domain_min[a] = -1;
    def.domain_max[0] = 1;
    def.domain_max[1] = 1.5f;
    const pbmpm_world_id world = create_world(&def);
    pbmpm_settings settings = default_settings();
    settings.gravity[1] = PULL;
    settings.solver = PBMPM_SOLVER_DUAL;
    settings.substeps = 2;
    settings.iterations = 20;
    OK(pbmpm_world_set_settings(world, &settings));
    const uint32_t count = fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0, -0.5f, 0, 1, 0.5f, 0), (const float[3]){0, 0, 0});
    pbmpm_collider_def made = default_collider();
    pbmpm_collider_id box;
    const pbmpm_shape shape = box_shape(0, 0.35f, 0, 0.25f, 0.3f, 0);
    made.kinematic = made.measures_impulse = 1;
    made.friction_coefficient = 0;
    OK(pbmpm_collider_create(world, &made, &shape, &box));
    const double area = 0.5 * 0.6, mass = share * 1000.0 * area, dt = 1.0 / RATE;
    double y = 0.35, v = 0.0, sum = 0.0;
    for (int step = 0; step < SECONDS * RATE; step++) {
        y = fmax(y + v * dt, -0.7); /* the ground */
        v = y > -0.7 ? v : 0.0;
        const float position[3] = {0, (float)y, 0};
        OK(pbmpm_collider_move(world, box, position, NULL));
        OK(pbmpm_world_step(world, (float)dt));
        v += (double)PULL * dt + impulse_of(world, box).linear[1] / mass;
        if (step >= (SECONDS - MEASURED) * RATE) sum += y;
    }
    *level = -1.0 + (count * 0.025 * 0.025 + fmin(share, 1.0) * area) / 2.0; /* what it displaces stands beside it */
    return sum / (MEASURED * RATE);
}

static void test_a_light_box_floats_at_its_depth(void)
{
    double level;
    const double y = float_box(0.5, &level);
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.3, 0.3, level - (y - 0.3)); /* half of 0.6 m, within 5 % */
}

static void test_a_heavy_box_sinks(void)
{
    double level;
    TEST_ASSERT_DOUBLE_WITHIN(0.01, -0.7, float_box(2.0, &level));
}

#endif

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_books_of_the_papers_solver);
    RUN_TEST(test_books_of_the_dual_solver);
    RUN_TEST(test_books_of_the_primal_solver);
    RUN_TEST(test_books_of_the_explicit_solver);
    RUN_TEST(test_measuring_changes_nothing);
    RUN_TEST(test_impulses_that_nobody_measures);
    RUN_TEST(test_many_plates_share_the_weight);
    RUN_TEST(test_angular_impulses);
#ifndef PBMPM_SANITIZED /* 840 steps of what the tests above run too */
    RUN_TEST(test_a_light_box_floats_at_its_depth);
    RUN_TEST(test_a_heavy_box_sinks);
#endif
    return UNITY_END();
}
