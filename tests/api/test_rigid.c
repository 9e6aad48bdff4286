/* Rigid bodies without matter: how they move, what walls do to them, what is refused, and saves. */
#include <math.h>

#include "rigid.h"

void setUp(void) {}

void tearDown(void)
{
    pbmpm_shutdown();
}

/* ---- Motion ---- */

static void test_a_fall_is_as_stated(void)
{
    enum { STEPS = 60 };
    rigid body = make_rigid(empty_world(3, 0.1f), box_shape(0, 100, 0, 0.2f, 0.2f, 0.2f), 500, NULL);
    set_gravity(body.world, 1, -10, 0);
    body.state.velocity[2] = 3;
    for (int n = 0; n < STEPS; n++) step(&body);
    const double dt = (double)DT, fallen = dt * dt * STEPS * (STEPS + 1) / 2;
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, fallen, body.state.position[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 100 - 10 * fallen, body.state.position[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 3 * dt * STEPS, body.state.position[2]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, -10 * dt * STEPS, body.state.velocity[1]);
    pbmpm_shape shape = {.size = sizeof shape};
    OK(pbmpm_collider_get(body.world, body.collider, NULL, &shape));
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, (float)body.state.position[1], shape.position[1]);
}

/* The inertia in the world, times a vector. */
static void momentum_of(const rigid *body, double momentum[3], double *energy)
{
    const double *q = body->state.rotation, x = q[0], y = q[1], z = q[2], w = q[3];
    const double turn[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                               {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                               {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
    *energy = 0;
    momentum[0] = momentum[1] = momentum[2] = 0;
    for (int c = 0; c < 3; c++) {
        double own = 0;
        for (int r = 0; r < 3; r++) own += turn[r][c] * body->state.angular_velocity[r];
        *energy += 0.5 * body->def.inertia[c] * own * own;
        for (int r = 0; r < 3; r++) momentum[r] += turn[r][c] * body->def.inertia[c] * own;
    }
}

/* About its middle axis, where the smallest push makes it tumble (L. Poinsot; V. Dzhanibekov). */
static void test_an_asymmetric_top_keeps_its_momentum(void)
{
    rigid body = make_rigid(empty_world(3, 0.1f), box_shape(0, 0, 0, 0.1f, 0.2f, 0.4f), 500, NULL);
    body.state.angular_velocity[1] = 12.0;
    body.state.angular_velocity[0] = 0.05;
    double first[3], now[3], energy, before, least = 12.0;
    momentum_of(&body, first, &before);
    for (int n = 0; n < 3000; n++) {
        step(&body);
        momentum_of(&body, now, &energy);
        for (int a = 0; a < 3; a++) TEST_ASSERT_DOUBLE_WITHIN(1e-9 * first[1], first[a], now[a]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-3 * before, before, energy);
        const double *q = body.state.rotation;
        least = fmin(least, 1 - 2 * (q[0] * q[0] + q[2] * q[2]));
    }
    TEST_ASSERT_TRUE_MESSAGE(least < -0.9, "it turns over");
}

/* Where a point of the body is. */
static void place_of(const rigid *body, const double own[3], double place[3])
{
    const double *q = body->state.rotation;
    double twice[3], turned[3];
    for (int a = 0; a < 3; a++) twice[a] = 2 * (q[(a + 1) % 3] * own[(a + 2) % 3] - q[(a + 2) % 3] * own[(a + 1) % 3]);
    for (int a = 0; a < 3; a++) turned[a] = q[(a + 1) % 3] * twice[(a + 2) % 3] - q[(a + 2) % 3] * twice[(a + 1) % 3];
    for (int a = 0; a < 3; a++) place[a] = body->state.position[a] + own[a] + q[3] * twice[a] + turned[a];
}

static void test_a_hinge_keeps_its_point_and_axis(void)
{
    rigid body = make_rigid(empty_world(3, 0.1f), box_shape(0, 1, 0, 0.4f, 0.1f, 0.2f), 500, hang_on_a_hinge);
    set_gravity(body.world, 0, -9.81f, 0);
    double place[3], lowest = 0;
    for (int n = 0; n < 1000; n++) {
        step(&body);
        place_of(&body, body.def.pivot, place);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.4, place[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, 1.1, place[1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.0, place[2]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.3 * body.state.angular_velocity[2], body.state.angular_velocity[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, body.state.angular_velocity[1]);
        lowest = fmin(lowest, body.state.position[1] - 1);
    }
    TEST_ASSERT_TRUE_MESSAGE(lowest < -0.25, "it swings");
}

/* Small swings last 2 pi sqrt(I / (m g l)). */
static void test_a_pendulum_keeps_time(void)
{
    rigid body = make_rigid(empty_world(3, 0.1f), box_shape(0, 1, 0, 0.1f, 0.5f, 0.1f), 500, short_pendulum);
    set_gravity(body.world, 0, -9.81f, 0);
    body.state.angular_velocity[2] = 0.1;
    const double inertia = body.def.inertia[2] + body.def.mass * 0.25, period = 2 * PI * sqrt(inertia / (body.def.mass * 9.81 * 0.5));
    int turns = 0;
    double last = 0, first_time = 0, last_time = 0;
    for (int n = 1; n <= 1200; n++) {
        const double before = last;
        step(&body);
        last = body.state.position[0];
        if (!(before < 0 && last >= 0)) continue;
        last_time = (n - last / (last - before)) * (double)DT;
        if (turns++ == 0) first_time = last_time;
    }
    TEST_ASSERT_TRUE(turns > 5);
    TEST_ASSERT_DOUBLE_WITHIN(0.01 * period, period, (last_time - first_time) / (turns - 1));
}

static void slide(pbmpm_rigid_def *def)
{
    def->moves = PBMPM_FREEDOM_AXIS;
    def->turns = PBMPM_FREEDOM_NONE;
    def->move_axis[0] = 1;
    def->torque[2] = 5;
}

static void test_a_slider_keeps_its_line(void)
{
    rigid body = make_rigid(empty_world(3, 0.1f), box_shape(0, 0, 0.5f, 0.1f, 0.1f, 0.1f), 500, slide);
    set_gravity(body.world, 0, -10, 3);
    for (int n = 0; n < 1000; n++) {
        step(&body);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9 * n, body.state.position[0], body.state.position[1]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5, body.state.position[2]);
        TEST_ASSERT_EQUAL_DOUBLE(1.0, body.state.rotation[3]);
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, -5.0 * (double)DT * 1000, body.state.velocity[1]);
}

static void roll_in_a_plane(pbmpm_rigid_def *def)
{
    def->moves = def->turns = PBMPM_FREEDOM_PLANE; /* not along y, and not about z */
    def->torque[0] = def->torque[1] = def->torque[2] = 0.1;
}

static void test_a_plane_locks_one_axis(void)
{
    rigid body = make_rigid(empty_world(3, 0.1f), box_shape(0, 2, 0, 0.1f, 0.3f, 0.2f), 500, roll_in_a_plane);
    set_gravity(body.world, 1, -10, 2);
    for (int n = 0; n < 200; n++) step(&body);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2.0, body.state.position[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 200 * (double)DT, body.state.velocity[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.0, body.state.angular_velocity[2]);
    TEST_ASSERT_TRUE(fabs(body.state.angular_velocity[0]) > 1e-3 && fabs(body.state.angular_velocity[1]) > 1e-3);
}

/* ---- Walls ---- */

static void test_walls_stop_a_body(void)
{
    pbmpm_world_def def = default_world(2, 0.1f, 16);
    def.domain_enabled = 1;
    def.domain_max[0] = def.domain_max[1] = 4;
    rigid body = make_rigid(create_world(&def), box_shape(1, 1, 0, 0.2f, 0.1f, 0), 500, NULL);
    set_gravity(body.world, 0, -10, 0);
    body.state.velocity[0] = 30;
    for (int n = 0; n < 100; n++) step(&body);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 3.8, body.state.position[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.1, body.state.position[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12 * 30.0, 0.0, body.state.velocity[0]); /* rounding of the speed that it had */
    body.def.stays_inside = 0;
    for (int n = 0; n < 100; n++) step(&body);
    TEST_ASSERT_TRUE(body.state.position[1] < -1);
}

static double energy_of(const rigid *body, double pull)
{
    double speed2 = 0.0;
    for (int a = 0; a < 3; a++) speed2 += body->state.velocity[a] * body->state.velocity[a];
    return 0.5 * body->def.mass * speed2 + 0.5 * body->def.inertia[2] * body->state.angular_velocity[2] * body->state.angular_velocity[2] + body->def.mass * pull * body->state.position[1];
}

/* A plank that falls on a corner turns about it and comes to lie flat. Walls that only stopped its centre let it go on turning: it stood up by itself. */
static void test_a_plank_that_falls_on_a_corner_lies_down(void)
{
    pbmpm_world_def def = default_world(2, 0.1f, 16);
    def.domain_enabled = 1;
    def.domain_max[0] = def.domain_max[1] = 4;
    pbmpm_shape shape = box_shape(2, 1.5f, 0, 0.5f, 0.05f, 0);
    shape.rotation[2] = 0.2f;
    shape.rotation[3] = 0.98f;
    rigid body = make_rigid(create_world(&def), shape, 500, NULL);
    set_gravity(body.world, 0, -10, 0);
    double energy = energy_of(&body, 10.0);
    for (int n = 0; n < 240; n++) {
        step(&body);
        const double now = energy_of(&body, 10.0);
        TEST_ASSERT_TRUE(now <= energy + body.def.mass * 10.0 * 10.0 * (double)DT * (double)DT); /* a step's fall, by which it is put back */
        energy = now;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.05, body.state.position[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-2, 0.0, body.state.rotation[2]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.0, body.state.angular_velocity[2]);
}

/* Coulomb's law: 5 m/s on a floor with 0.5 (of 0.4 and 0.625) end after 1 s. In 3D askew, where a law for each axis would bend the way. */
static void test_walls_brake_what_slides(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        rigid body = put_on_floor(dimension, box_shape(5, 0.1f, 5, 0.6f, 0.1f, 0.6f), 0.4f, 0.625f);
        body.state.velocity[0] = dimension == 3 ? 4 : 5;
        body.state.velocity[2] = dimension == 3 ? 3 : 0;
        for (int n = 0; n < 30; n++) step(&body);
        const double half = 2.5 / 5.0; /* of the speed is left after 30 steps */
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, half * (dimension == 3 ? 4 : 5), body.state.velocity[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, half * (dimension == 3 ? 3 : 0), body.state.velocity[2]);
        for (int n = 0; n < 60; n++) step(&body);
        for (int a = 0; a < dimension; a++) TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, body.state.velocity[a]);
        for (int a = 0; a < 3; a++) TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.0, body.state.angular_velocity[a]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.1, body.state.position[1]);
        const double stands = body.state.position[0];
        set_gravity(body.world, 4.9f, -10, 0);
        for (int n = 0; n < 30; n++) step(&body);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-9, 0.0, body.state.velocity[0], "it stands on less than the friction angle");
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-9, stands, body.state.position[0], "and does not creep");
        set_gravity(body.world, 6, -10, 0);
        for (int n = 0; n < 60; n++) step(&body);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-5, 1.0, body.state.velocity[0], "and slides on more");
    }
}

/* A ball that slides comes to roll, with 5/7 of its speed, a disc with 2/3 (J. A. Greenwood, Classical Dynamics): the moment about the floor's points is kept. */
static void test_friction_of_walls_makes_balls_roll(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        rigid body = put_on_floor(dimension, sphere_shape(5, 0.5f, 5, 0.5f), 0.5f, 0.5f);
        const double rolls = dimension == 3 ? 5.0 / 7 : 2.0 / 3;
        body.state.velocity[0] = 3;
        for (int n = 0; n < 120; n++) step(&body);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 3 * rolls, body.state.velocity[0]);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, -3 * rolls / 0.5, body.state.angular_velocity[2]);
    }
}

static void test_a_wall_without_friction_lets_glide(void)
{
    rigid body = put_on_floor(2, box_shape(5, 0.1f, 0, 0.2f, 0.1f, 0), 0.4f, 0);
    body.state.velocity[0] = 2;
    for (int n = 0; n < 60; n++) step(&body);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, body.state.velocity[0]);
    pbmpm_domain_wall wall = {.size = sizeof wall};
    OK(pbmpm_domain_wall_get(body.world, 1, 0, &wall));
    wall.friction = PBMPM_FRICTION_STICK;
    OK(pbmpm_domain_wall_set(body.world, 1, 0, &wall));
    step(&body);
    const double foot = body.state.velocity[0] + 0.1 * body.state.angular_velocity[2];
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-6, 0.0, foot, "its foot sticks; it tips");
}

/* ---- Refusals and saves ---- */

static void test_bodies_that_cannot_be(void)
{
    const pbmpm_world_id world = empty_world(3, 0.1f);
    const rigid body = make_rigid(world, box_shape(0, 0, 0, 1, 1, 1), 1, NULL);
    pbmpm_rigid_state state = body.state;
    const pbmpm_collider_id still = create_collider(world, box_shape(5, 0, 0, 1, 1, 1), false);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_rigid_begin(world, still, &body.def, &state));
#define BAD_DEF(change)                                                                                                                          \
    do {                                                                                                                                         \
        pbmpm_rigid_def bad = body.def;                                                                                                          \
        bad.change;                                                                                                                              \
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_rigid_begin(world, body.collider, &bad, &state));                                             \
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_rigid_advance(world, body.collider, &bad, &state, DT));                                       \
    } while (0)
    BAD_DEF(mass = 0);
    BAD_DEF(mass = NAN);
    BAD_DEF(stays_inside = 2);
    BAD_DEF(moves = (pbmpm_freedom)4);
    BAD_DEF(turns = (pbmpm_freedom)-1);
    BAD_DEF(inertia[1] = 0);
    BAD_DEF(products[2] = 1e9);
    BAD_DEF(centre[0] = INFINITY);
    BAD_DEF(pivot[2] = 2e9);
    BAD_DEF(force[1] = NAN);
    BAD_DEF(torque[1] = 1e31);
    BAD_DEF(move_axis[1] = 0);
    BAD_DEF(turn_axis[2] = 1e-7);
#define BAD_STATE(change)                                                                                                                        \
    do {                                                                                                                                         \
        pbmpm_rigid_state bad = body.state;                                                                                                      \
        bad.change;                                                                                                                              \
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_rigid_advance(world, body.collider, &body.def, &bad, DT));                                    \
    } while (0)
    BAD_STATE(position[0] = NAN);
    BAD_STATE(point[0] = 2e9);
    BAD_STATE(rotation[3] = 0);
    BAD_STATE(velocity[1] = INFINITY);
    BAD_STATE(angular_velocity[1] = 1e10);
    BAD_STATE(velocity_change[1] = NAN);
    BAD_STATE(reserved = 1);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_rigid_advance(world, body.collider, &body.def, &state, 0.0f));
    state.position[0] = 9.99e8;
    state.velocity[0] = 9e8;
    const pbmpm_rigid_state before = state;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_rigid_advance(world, body.collider, &body.def, &state, 1.0f));
    TEST_ASSERT_EQUAL_MEMORY(&before, &state, sizeof state);
}

/* A body that is copied with a save goes on bit for bit. */
static void test_a_body_goes_on_from_a_save(void)
{
    static char saved[1 << 20];
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    pbmpm_collider_def def = default_collider();
    pbmpm_collider_id box;
    pbmpm_rigid_def body;
    pbmpm_rigid_state state = {.size = sizeof state}, kept;
    const pbmpm_shape shape = box_shape(0.5f, 0.5f, 0, 0.1f, 0.1f, 0.1f);
    uint64_t bytes, hash[2];
    def.kinematic = def.measures_impulse = 1;
    OK(pbmpm_collider_create(world, &def, &shape, &box));
    OK(pbmpm_rigid_def_init(&body, sizeof body));
    body.mass = 20;
    OK(pbmpm_rigid_begin(world, box, &body, &state));
    for (int round = 0; round < 3; round++) { /* up to the save, then twice from there */
        if (round == 1) {
            OK(pbmpm_snapshot_save(world, saved, sizeof saved, &bytes));
            kept = state;
        }
        if (round == 2) {
            OK(pbmpm_snapshot_restore(world, saved, bytes, 0));
            state = kept;
        }
        for (int step = 0; step < 20; step++) {
            OK(pbmpm_rigid_advance(world, box, &body, &state, 1.0f / 60));
            OK(pbmpm_world_step(world, 1.0f / 60));
        }
        if (round > 0) hash[round - 1] = world_hash(world);
    }
    TEST_ASSERT_EQUAL_HEX64(hash[0], hash[1]);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_a_fall_is_as_stated);
    RUN_TEST(test_an_asymmetric_top_keeps_its_momentum);
    RUN_TEST(test_a_hinge_keeps_its_point_and_axis);
    RUN_TEST(test_a_pendulum_keeps_time);
    RUN_TEST(test_a_slider_keeps_its_line);
    RUN_TEST(test_a_plane_locks_one_axis);
    RUN_TEST(test_walls_stop_a_body);
    RUN_TEST(test_a_plank_that_falls_on_a_corner_lies_down);
    RUN_TEST(test_walls_brake_what_slides);
    RUN_TEST(test_friction_of_walls_makes_balls_roll);
    RUN_TEST(test_a_wall_without_friction_lets_glide);
    RUN_TEST(test_bodies_that_cannot_be);
    RUN_TEST(test_a_body_goes_on_from_a_save);
    return UNITY_END();
}
