/* Rigid bodies through the public interface: mass properties, what is under matter, and motion. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scenes.h"
#include "solids.h"

static const double PI = 3.14159265358979323846;
static const float DT = 1.0f / 60, STILL[3] = {0};

void setUp(void) {}

void tearDown(void)
{
    bake_forget();
    pbmpm_shutdown();
}

/* ---- Mass ---- */

static pbmpm_mass_properties mass_of(pbmpm_world_id world, pbmpm_shape shape, float density)
{
    pbmpm_mass_properties mass = {.size = sizeof mass};
    OK(pbmpm_shape_mass(world, &shape, density, &mass));
    return mass;
}

static pbmpm_world_id empty_world(int32_t dimension, float dx)
{
    const pbmpm_world_def def = default_world(dimension, dx, 16);
    return create_world(&def);
}

static pbmpm_shape capsule_shape(float half_length, float radius)
{
    pbmpm_shape shape = default_shape();
    shape.kind = PBMPM_CAPSULE;
    shape.half_extents[0] = half_length;
    shape.radius = radius;
    return shape;
}

static void test_masses_have_formulas(void)
{
    const pbmpm_world_id deep = empty_world(3, 0.1f), flat = empty_world(2, 0.1f);
    const pbmpm_mass_properties box = mass_of(deep, box_shape(1, 2, 3, 0.5f, 1.0f, 2.0f), 100.0f);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 800.0, box.mass);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 800.0 / 3 * (1 + 4), box.inertia[0]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 800.0 / 3 * (0.25 + 4), box.inertia[1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 800.0 / 3 * (0.25 + 1), box.inertia[2]);
    const pbmpm_mass_properties ball = mass_of(deep, sphere_shape(0, 0, 0, 0.5f), 8.0f);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 8.0 * 4 / 3 * PI / 8, ball.mass);
    for (int a = 0; a < 3; a++) TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.4 * ball.mass / 4, ball.inertia[a]);
    const pbmpm_mass_properties disc = mass_of(flat, sphere_shape(0, 0, 0, 0.5f), 8.0f);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 2 * PI, disc.mass);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9, 0.5 * disc.mass / 4, disc.inertia[2]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, disc.inertia[0]);
}

/* Sums over a lattice, which know nothing of the formulas. */
static void test_the_mass_of_a_capsule_is_that_of_its_points(void)
{
    const double a = 0.6, r = 0.4;
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        const int N = dimension == 2 ? 1000 : 120;
        const double h = 2 * (a + r) / N;
        const pbmpm_mass_properties mass = mass_of(empty_world(dimension, 0.1f), capsule_shape(0.6f, 0.4f), 10.0f);
        double volume = 0, moment[3] = {0};
        for (int i = 0; i < N; i++)
            for (int j = 0; j < N; j++)
                for (int k = 0; k < (dimension == 3 ? N : 1); k++) {
                    const double x = (i + 0.5) * h - a - r, y = (j + 0.5) * h - a - r, z = dimension == 3 ? (k + 0.5) * h - a - r : 0.0;
                    const double over = fmax(0.0, fabs(x) - a);
                    if (over * over + y * y + z * z > r * r) continue;
                    const double cell = dimension == 3 ? h * h * h : h * h;
                    volume += cell;
                    moment[0] += cell * (y * y + z * z);
                    moment[1] += cell * (x * x + z * z);
                    moment[2] += cell * (x * x + y * y);
                }
        TEST_ASSERT_DOUBLE_WITHIN(4e-3 * volume, volume, mass.volume);
        for (int i = dimension == 2 ? 2 : 0; i < 3; i++) TEST_ASSERT_DOUBLE_WITHIN(5e-3 * 10 * moment[i], 10 * moment[i], mass.inertia[i]);
    }
}

static void bake_fine_ball(int32_t dimension, double radius)
{
    mesh_clear(&mesh, dimension);
    mesh_add_ball(&mesh, 0, 0, 0, radius, 64);
    bake_now(64);
}

static void test_a_baked_ball_weighs_what_a_ball_does(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        const pbmpm_world_id world = empty_world(dimension, 0.1f);
        bake_fine_ball(dimension, 0.5);
        const pbmpm_mass_properties found = mass_of(world, baked_shape(load_baked(world), 3, 4, 5), 10.0f);
        const pbmpm_mass_properties exact = mass_of(world, sphere_shape(0, 0, 0, 0.5f), 10.0f);
        TEST_ASSERT_DOUBLE_WITHIN(0.01 * exact.mass, exact.mass, found.mass);
        for (int a = 0; a < 3; a++) {
            TEST_ASSERT_DOUBLE_WITHIN(0.02 * exact.inertia[2], exact.inertia[a], found.inertia[a]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-3 * exact.inertia[2], 0.0, found.products[a]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-3, 0.0, found.centre[a]);
        }
        bake_forget();
    }
}

/* ---- What is under matter ---- */

enum { WIDE = 20 }; /* cells of a tank */
static const float DX = 0.1f;

/* A tank with liquid up to a level around an obstacle; `low` floor at 0. */
static pbmpm_world_id tank_around(int32_t dimension, float level, pbmpm_shape shape, pbmpm_collider_id *collider)
{
    pbmpm_world_def def = default_world(dimension, DX, 60000);
    def.domain_enabled = 1;
    for (int a = 0; a < dimension; a++) def.domain_max[a] = WIDE * DX;
    const pbmpm_world_id world = create_world(&def);
    if (shape.kind == PBMPM_BAKED) {
        bake_fine_ball(dimension, (double)shape.radius);
        shape.baked = load_baked(world);
        bake_forget();
    }
    *collider = create_collider(world, shape, true);
    const float half = WIDE * DX / 2;
    if (level > 0) fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(half, level / 2, half, half, level / 2, half), STILL);
    return world;
}

static bool is_inside(const pbmpm_shape *shape, const double x[3])
{
    const double c = cos(2 * asin((double)shape->rotation[2])), s = sin(2 * asin((double)shape->rotation[2]));
    const double dx = x[0] - (double)shape->position[0], dy = x[1] - (double)shape->position[1], dz = x[2] - (double)shape->position[2];
    const double along = c * dx + s * dy, up = c * dy - s * dx;
    if (shape->kind != PBMPM_BOX) return dx * dx + dy * dy + dz * dz < (double)shape->radius * (double)shape->radius;
    return fabs(along) < (double)shape->half_extents[0] && fabs(up) < (double)shape->half_extents[1] && fabs(dz) < (double)shape->half_extents[2];
}

/* By counting points; `across`: the largest area of a level. */
static double volume_below(const pbmpm_shape *shape, int32_t dimension, double level, double *across, double *height)
{
    enum { N = 100 };
    const double h = WIDE * (double)DX / N;
    double volume = 0, moment = 0;
    *across = 0;
    for (int j = 0; j < N; j++) {
        double row = 0;
        const double y = (j + 0.5) * h;
        for (int i = 0; i < N; i++)
            for (int k = 0; k < (dimension == 3 ? N : 1); k++) {
                const double x[3] = {(i + 0.5) * h, y, dimension == 3 ? (k + 0.5) * h : 0.0};
                row += is_inside(shape, x) ? pow(h, dimension) : 0.0;
            }
        volume += y < level ? row : 0.0;
        moment += y < level ? row * y : 0.0;
        *across = fmax(*across, row / h);
    }
    *height = volume > 0 ? moment / volume : 0.0;
    return volume;
}

static pbmpm_submersion under(pbmpm_world_id world, pbmpm_collider_id collider)
{
    pbmpm_submersion found = {.size = sizeof found};
    OK(pbmpm_collider_submerged(world, collider, NULL, &found));
    return found;
}

static void expect_submerged(int32_t dimension, pbmpm_shape shape, float level, double cells)
{
    pbmpm_collider_id collider;
    if (dimension == 2) shape.position[2] = 0;
    pbmpm_shape same = shape;
    if (shape.kind == PBMPM_BAKED) same.kind = PBMPM_SPHERE;
    double across, height;
    const pbmpm_world_id world = tank_around(dimension, level, shape, &collider);
    const double exact = volume_below(&same, dimension, (double)level, &across, &height), all = volume_below(&same, dimension, 1e9, &(double){0}, &(double){0});
    const pbmpm_submersion found = under(world, collider);
    char label[160];
    snprintf(label, sizeof label, "%dD, kind %d, level %g: %g, not %g; centre at %g, not %g", (int)dimension, (int)shape.kind, (double)level, found.volume, exact,
             found.centre[1], height);
    TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(cells * (double)DX * across, exact, found.volume, label);
    if (exact > 0.3 * all) {
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(cells * (double)DX, height, found.centre[1], label);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(0.4 * (double)DX, (double)shape.position[0], found.centre[0], label);
        TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(1e-3, 1000.0, found.density, label);
    }
    OK(pbmpm_world_destroy(world));
}

static void test_what_is_under_matter(void)
{
    static const float levels[] = {0.2f, 0.7f, 0.85f, 1.0f, 1.15f, 1.3f, 1.9f}; /* the shapes reach from 0.6 to 1.4 or so */
    for (int32_t dimension = 2; dimension <= 3; dimension++)
        for (size_t i = 0; i < sizeof levels / sizeof *levels; i++) {
            const pbmpm_shape box = box_shape(1.03f, 1, 1, 0.4f, 0.4f, 0.4f);
            pbmpm_shape turned = box, baked_one = sphere_shape(1, 1.02f, 1, 0.4f);
            turned.rotation[2] = sinf(0.3f);
            turned.rotation[3] = cosf(0.3f);
            baked_one.kind = PBMPM_BAKED;
            expect_submerged(dimension, box, levels[i], 0.4);
            expect_submerged(dimension, turned, levels[i], 0.4);
            expect_submerged(dimension, sphere_shape(1.03f, 1, 1, 0.4f), levels[i], 0.4);
            expect_submerged(dimension, baked_one, levels[i], 0.4);
            expect_submerged(dimension, box_shape(1.03f, 0.4f, 1, 0.4f, 0.4f, 0.4f), levels[i], 0.8); /* on the floor */
        }
}

static void test_a_material_alone_counts(void)
{
    pbmpm_collider_id collider;
    const pbmpm_world_id world = tank_around(2, 1.0f, box_shape(1, 1, 0, 0.4f, 0.4f, 0.4f), &collider);
    const pbmpm_material_id other = create_material(world, PBMPM_ELASTIC);
    pbmpm_submersion found = {.size = sizeof found};
    OK(pbmpm_collider_submerged(world, collider, &other, &found));
    TEST_ASSERT_EQUAL_DOUBLE(0.0, found.share);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, found.density);
    TEST_ASSERT_TRUE(under(world, collider).share > 0.4);
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_collider_submerged(world, collider, &(pbmpm_material_id){7, 7}, &found));
}

static void test_planes_have_no_inside(void)
{
    const pbmpm_world_id world = empty_world(2, 0.1f);
    const pbmpm_collider_id plane = create_collider(world, plane_shape(0, 0, 0, 0, 1, 0), false);
    const pbmpm_shape shape = plane_shape(0, 0, 0, 0, 1, 0);
    pbmpm_submersion found = {.size = sizeof found};
    pbmpm_mass_properties mass = {.size = sizeof mass};
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_submerged(world, plane, NULL, &found));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_shape_mass(world, &shape, 1.0f, &mass));
}

/* ---- Motion without matter ---- */

typedef struct rigid {
    pbmpm_world_id world;
    pbmpm_collider_id collider;
    pbmpm_rigid_def def;
    pbmpm_rigid_state state;
} rigid;

static pbmpm_collider_id add_body(pbmpm_world_id world, pbmpm_shape shape)
{
    pbmpm_collider_def def = default_collider();
    pbmpm_collider_id collider;
    def.kinematic = def.measures_impulse = 1;
    def.friction = PBMPM_FRICTION_SLIP;
    OK(pbmpm_collider_create(world, &def, &shape, &collider));
    return collider;
}

/* Of a density, at rest; `hold` may be null. */
static rigid make_rigid(pbmpm_world_id world, pbmpm_shape shape, float density, void (*hold)(pbmpm_rigid_def *def))
{
    rigid body = {.world = world, .collider = add_body(world, shape), .state = {.size = sizeof body.state}};
    const pbmpm_mass_properties mass = mass_of(world, shape, density);
    OK(pbmpm_rigid_def_init(&body.def, sizeof body.def));
    body.def.mass = mass.mass;
    memcpy(body.def.centre, mass.centre, sizeof mass.centre);
    memcpy(body.def.inertia, mass.inertia, sizeof mass.inertia);
    memcpy(body.def.products, mass.products, sizeof mass.products);
    if (hold) hold(&body.def);
    OK(pbmpm_rigid_begin(world, body.collider, &body.def, &body.state));
    return body;
}

static void advance(rigid *body) { OK(pbmpm_rigid_advance(body->world, body->collider, &body->def, &body->state, DT)); }

static void step(rigid *body)
{
    advance(body);
    OK(pbmpm_world_step(body->world, DT));
}

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

static void hang_on_a_hinge(pbmpm_rigid_def *def)
{
    def->moves = PBMPM_FREEDOM_NONE;
    def->turns = PBMPM_FREEDOM_AXIS;
    def->turn_axis[0] = 0.3;
    def->pivot[0] = 0.4;
    def->pivot[1] = 0.1;
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

static void short_pendulum(pbmpm_rigid_def *def)
{
    hang_on_a_hinge(def);
    def->turn_axis[0] = 0;
    def->pivot[0] = 0;
    def->pivot[1] = 0.5;
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

/* A world of 40 m with a floor, whose friction a body of a shape on it shares. */
static rigid put_on_floor(int32_t dimension, pbmpm_shape shape, float of_body, float of_floor)
{
    pbmpm_world_def def = default_world(dimension, 0.1f, 16);
    def.domain_enabled = 1;
    def.domain_friction = of_floor;
    for (int a = 0; a < dimension; a++) def.domain_max[a] = 40;
    rigid body = {.world = create_world(&def), .state = {.size = sizeof body.state}};
    pbmpm_collider_def rough;
    OK(pbmpm_collider_def_init(&rough, sizeof rough));
    rough.kinematic = rough.measures_impulse = 1;
    rough.friction_coefficient = of_body;
    OK(pbmpm_collider_create(body.world, &rough, &shape, &body.collider));
    const pbmpm_mass_properties mass = mass_of(body.world, shape, 500);
    OK(pbmpm_rigid_def_init(&body.def, sizeof body.def));
    body.def.mass = mass.mass;
    memcpy(body.def.inertia, mass.inertia, sizeof mass.inertia);
    OK(pbmpm_rigid_begin(body.world, body.collider, &body.def, &body.state));
    set_gravity(body.world, 0, -10, 0);
    return body;
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

/* ---- On solids ---- */

static pbmpm_material_id create_elastic(pbmpm_world_id world, float modulus)
{
    pbmpm_material_def matter = default_material(PBMPM_ELASTIC);
    pbmpm_material_id material;
    matter.young_modulus = modulus;
    OK(pbmpm_material_create(world, &matter, &material));
    return material;
}

/* Two crates of 0.4 m on a floor, with room above. */
static pbmpm_world_id two_crates(int32_t dimension, float modulus)
{
    pbmpm_world_def def = default_world(dimension, dimension == 2 ? 0.05f : 0.1f, 20000);
    def.domain_enabled = 1;
    def.domain_max[0] = def.domain_max[1] = 2;
    def.domain_max[2] = 0.8f;
    const pbmpm_world_id world = create_world(&def);
    const pbmpm_material_id material = create_elastic(world, modulus);
    for (int i = 0; i < 2; i++) fill_shape(world, material, box_shape(0.5f + (float)i, 0.2f, 0.4f, 0.2f, 0.2f, 0.2f), STILL);
    set_gravity(world, 0, -10, 0);
    set_rate(world, 1, 5);
    return world;
}

/* Of matter and the body, but the elastic part, which is what they fell in. */
static double energy_with(const rigid *body)
{
    pbmpm_stats stats = {.size = sizeof stats};
    double motion = 0.0;
    OK(pbmpm_world_get_stats(body->world, &stats));
    for (int a = 0; a < 3; a++) motion += 0.5 * body->def.mass * body->state.velocity[a] * body->state.velocity[a];
    motion += 0.5 * body->def.inertia[2] * body->state.angular_velocity[2] * body->state.angular_velocity[2];
    return stats.kinetic_energy + stats.potential_energy + motion + 10.0 * body->def.mass * body->state.position[1];
}

/* A plank is laid on the crates, for a second: its energy never grows, and in the end it rests. A hundredth is the step's fall of all, 1e-3 of it, and what is elastic. */
static void lay_plank(int32_t dimension, float modulus, float density)
{
    rigid body = make_rigid(two_crates(dimension, modulus), box_shape(1.0f, 0.45f, 0.4f, 0.7f, 0.05f, 0.2f), density, NULL);
    char what[64];
    double first = 0.0, fastest = 0.0;
    snprintf(what, sizeof what, "%dD, %g Pa, %g kg/m^3", (int)dimension, (double)modulus, (double)density);
    for (int n = 0; n < 90; n++) {
        step(&body);
        if (n == 0) first = energy_with(&body);
        TEST_ASSERT_TRUE_MESSAGE(energy_with(&body) <= 1.01 * first, what);
        TEST_ASSERT_TRUE_MESSAGE(body.state.position[1] > 0.3 && body.state.position[1] < 0.46, what);
        if (n >= 75) fastest = fmax(fastest, fabs(body.state.velocity[1]));
    }
    if (modulus > 2e5f) TEST_ASSERT_TRUE_MESSAGE(fastest < 0.03, what); /* what is softer still swings */
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 1.0, body.state.position[0]);
    OK(pbmpm_world_destroy(body.world));
}

/* Light or heavy, on soft or stiff ones. One step late k dt^2 / m, up to 1e5 here, threw off what it was above 4 for. */
static void test_planks_rest_on_crates(void)
{
    static const float modulus[] = {1e5f, 1e6f, 1e7f}, density[] = {50, 500, 5000};
    for (int e = 0; e < 3; e++)
        for (int d = 0; d < 3; d++) lay_plank(2, modulus[e], density[d]);
    lay_plank(3, 1e6f, 50);
    lay_plank(3, 1e7f, 500);
}

/* A crate that lies on a body that lies on a floor lies still: what walls of the domain hold does not yield. */
static void test_a_crate_lies_on_what_lies_on_a_floor(void)
{
    pbmpm_world_def def = default_world(2, 0.05f, 4000);
    def.domain_enabled = 1;
    def.domain_max[0] = def.domain_max[1] = 2;
    rigid body = make_rigid(create_world(&def), box_shape(1, 0.05f, 0, 0.6f, 0.05f, 0), 50, NULL);
    pbmpm_stats stats = {.size = sizeof stats};
    fill_shape(body.world, create_elastic(body.world, 1e6f), box_shape(1, 0.3f, 0, 0.2f, 0.2f, 0), STILL);
    set_gravity(body.world, 0, -10, 0);
    set_rate(body.world, 1, 5);
    for (int n = 0; n < 60; n++) step(&body);
    OK(pbmpm_world_get_stats(body.world, &stats));
    TEST_ASSERT_TRUE(stats.max_speed < 0.01f);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.05, body.state.position[1]);
    TEST_ASSERT_DOUBLE_WITHIN(2e-3, 1.0, body.state.position[0]);
}

/* A crate flies into a body: what one loses the other gets, to rounding, along both axes and about the origin. */
static void test_a_hit_keeps_momentum(void)
{
    const pbmpm_world_def def = default_world(2, 0.05f, 4000);
    static const float speed[3] = {2, 0, 0};
    rigid body = make_rigid(create_world(&def), box_shape(0.4f, 0.1f, 0, 0.15f, 0.2f, 0), 200, NULL);
    pbmpm_stats stats = {.size = sizeof stats};
    fill_shape(body.world, create_elastic(body.world, 1e6f), box_shape(0, 0, 0, 0.2f, 0.2f, 0), speed);
    set_rate(body.world, 1, 5);
    for (int n = 0; n < 30; n++) step(&body);
    OK(pbmpm_world_get_stats(body.world, &stats));
    advance(&body); /* it has the last step's impulse now */
    TEST_ASSERT_TRUE(body.state.velocity[0] > 1.0);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 2.0 * stats.mass, stats.momentum[0] + body.def.mass * body.state.velocity[0]);
    TEST_ASSERT_DOUBLE_WITHIN(0.01, 0.0, stats.momentum[1] + body.def.mass * body.state.velocity[1]);
}

/* Whether advice of an obstacle has these words. */
static bool advised(pbmpm_world_id world, float dt, const char *words)
{
    enum { ROOM = 32 };
    static pbmpm_advice told[ROOM];
    uint32_t count = 0;
    bool found = false;
    told[0].size = sizeof told[0];
    OK(pbmpm_world_advice(world, dt, told, ROOM, &count));
    for (uint32_t i = 0; i < count; i++) found = found || (told[i].collider.generation != 0 && strstr(told[i].text, words));
    return found;
}

/* What is advised of a plank of this density on a block of 1e6 Pa, at this step; `pool`: there is water in the world. */
static bool told_that_it_is_thrown_off(float density, float dt, bool pool)
{
    pbmpm_world_def def = default_world(2, 0.05f, 4000);
    def.domain_enabled = 1;
    def.domain_max[0] = def.domain_max[1] = 4;
    rigid body = make_rigid(create_world(&def), box_shape(2, 0.66f, 0, 0.6f, 0.1f, 0), density, NULL);
    fill_shape(body.world, create_elastic(body.world, 1e6f), box_shape(2, 0.3f, 0, 0.3f, 0.25f, 0), STILL);
    if (pool) fill_shape(body.world, create_material(body.world, PBMPM_LIQUID), box_shape(3.5f, 0.2f, 0, 0.5f, 0.2f, 0), STILL);
    set_gravity(body.world, 0, -10, 0);
    advance(&body);
    const bool found = advised(body.world, dt, "thrown off");
    OK(pbmpm_world_destroy(body.world));
    return found;
}

/* k dt^2 / m = (c dt / T)^2 M / m is 1.11 * 300 kg / m at 60 Hz: the block is 0.5 m thick, its sound goes at 31.6 m/s. Planks of 0.24 m^2.
 * Among solids alone they yield within the step. */
static void test_it_is_told_where_solids_throw_it_off(void)
{
    TEST_ASSERT_TRUE(told_that_it_is_thrown_off(100.0f, 1.0f / 60.0f, true));
    TEST_ASSERT_FALSE(told_that_it_is_thrown_off(100.0f, 1.0f / 60.0f, false));
    TEST_ASSERT_FALSE(told_that_it_is_thrown_off(2000.0f, 1.0f / 60.0f, true));
    TEST_ASSERT_FALSE(told_that_it_is_thrown_off(100.0f, 1.0f / 240.0f, true));
}

/* It lies on a floor without friction; before it got there, and with friction, nothing is told. */
static void test_it_is_told_where_a_body_glides(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++)
        for (int rough = 0; rough < 2; rough++) {
            rigid body = put_on_floor(dimension, box_shape(5, 0.3f, 5, 0.2f, 0.1f, 0.2f), 0.2f, rough ? 0.1f : 0.0f);
            step(&body);
            TEST_ASSERT_FALSE(advised(body.world, DT, "glides"));
            for (int n = 0; n < 30; n++) step(&body);
            TEST_ASSERT_EQUAL(!rough, advised(body.world, DT, "glides"));
        }
}

/* A box that falls onto a box, onto a plane, and onto a box that is a body, too. Beside an obstacle nothing is told; nor of a wheel about its axle. */
static void test_it_is_told_where_a_body_enters_another(void)
{
    static const char *const what[] = {"a box", "a plane", "a body", "beside"};
    for (int32_t dimension = 2; dimension <= 3; dimension++)
        for (int other = 0; other < 4; other++) {
            rigid body = make_rigid(empty_world(dimension, 0.1f), box_shape(0, 0.35f, 0, 0.2f, 0.1f, 0.2f), 500, NULL), below;
            const pbmpm_shape box = box_shape(other == 3 ? 1 : 0, 0, 0, 0.4f, 0.2f, 0.4f);
            if (other == 0 || other == 3) create_collider(body.world, box, false);
            if (other == 1) create_collider(body.world, plane_shape(0, 0.2f, 0, 0, 1, 0), false);
            if (other == 2) below = make_rigid(body.world, box, 500, NULL);
            advance(&body);
            if (other == 2) advance(&below);
            TEST_ASSERT_FALSE(advised(body.world, DT, "has entered"));
            set_gravity(body.world, 0, -10, 0);
            for (int n = 0; n < 15; n++) step(&body);
            TEST_ASSERT_EQUAL_INT_MESSAGE(other != 3, advised(body.world, DT, "has entered"), what[other]);
        }
    rigid wheel = make_rigid(empty_world(2, 0.1f), box_shape(0, -0.5f, 0, 0.1f, 0.6f, 0), 500, short_pendulum);
    create_collider(wheel.world, sphere_shape(0, 0, 0, 0.05f), false); /* where it turns */
    advance(&wheel);
    TEST_ASSERT_FALSE(advised(wheel.world, DT, "has entered"));
}

/* ---- In water ---- */

/* A box of 0.1 of the liquid's density, held under at `start` and let go, in seconds 5 to 9: its mean height, and how far it bobs. */
static void let_a_light_box_go(float start, double *mean, double *bob)
{
    pbmpm_world_def def = default_world(2, 0.05f, 20000);
    def.domain_enabled = 1;
    def.domain_max[0] = 1.6f;
    def.domain_max[1] = 3.0f;
    const pbmpm_world_id world = create_world(&def);
    set_gravity(world, 0, -9.81f, 0);
    set_rate(world, 1, 5);
    rigid body = make_rigid(world, box_shape(0.8f, start, 0, 0.2f, 0.2f, 0), 100, NULL);
    fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0.8f, 0.4f, 0, 0.8f, 0.4f, 0), STILL);
    double low = 9, high = 0;
    *mean = 0;
    for (int n = 0; n < 60; n++) OK(pbmpm_world_step(world, DT));
    for (int n = 0; n < 480; n++) {
        step(&body);
        TEST_ASSERT_TRUE(body.state.position[1] < 1.3); /* it does not leap */
        if (n < 240) continue;
        low = fmin(low, body.state.position[1]);
        high = fmax(high, body.state.position[1]);
        *mean += body.state.position[1] / 240;
    }
    *bob = high - low;
}

/* It comes up and comes to lie still. How the tank sloshes on depends on the last bit: single starts bob by 0.03 to 0.21 m, many by 0.1 on average. */
static void test_light_boxes_let_go_under_water_are_stable(void)
{
    enum { STARTS = 9 };
    const double level = (1.6 * 0.8 - 0.16 + 0.016) / 1.6; /* of the liquid and what the box displaces */
    double bobs = 0;
    for (int i = 0; i < STARTS; i++) {
        double mean, bob;
        let_a_light_box_go(0.36f + 0.01f * (float)i, &mean, &bob);
        TEST_ASSERT_DOUBLE_WITHIN(0.4 * 0.05, level + 0.2 - 0.04, mean);
        bobs += bob;
    }
    TEST_ASSERT_TRUE(bobs / STARTS < 0.15); /* less and less: 0.6 m at first */
}

/* ---- Refusals ---- */

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

/* The same of one that solids make yield, in another world. */
static void test_a_body_on_crates_goes_on_from_a_save(void)
{
    static char saved[1 << 21];
    uint64_t bytes, hash[2];
    rigid body[2];
    for (int i = 0; i < 2; i++) body[i] = make_rigid(two_crates(2, 1e6f), box_shape(1.0f, 0.47f, 0.4f, 0.7f, 0.05f, 0.2f), 100, NULL);
    for (int n = 0; n < 20; n++) step(&body[0]);
    OK(pbmpm_snapshot_save(body[0].world, saved, sizeof saved, &bytes));
    OK(pbmpm_snapshot_restore(body[1].world, saved, bytes, 0));
    body[1].state = body[0].state;
    for (int i = 0; i < 2; i++) {
        for (int n = 0; n < 20; n++) step(&body[i]);
        hash[i] = world_hash(body[i].world);
    }
    TEST_ASSERT_EQUAL_HEX64(hash[0], hash[1]);
    TEST_ASSERT_EQUAL_MEMORY(&body[0].state, &body[1].state, sizeof body[0].state);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_masses_have_formulas);
    RUN_TEST(test_the_mass_of_a_capsule_is_that_of_its_points);
    RUN_TEST(test_a_baked_ball_weighs_what_a_ball_does);
    RUN_TEST(test_what_is_under_matter);
    RUN_TEST(test_a_material_alone_counts);
    RUN_TEST(test_planes_have_no_inside);
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
    RUN_TEST(test_planks_rest_on_crates);
    RUN_TEST(test_a_crate_lies_on_what_lies_on_a_floor);
    RUN_TEST(test_a_hit_keeps_momentum);
    RUN_TEST(test_a_body_on_crates_goes_on_from_a_save);
    RUN_TEST(test_it_is_told_where_solids_throw_it_off);
    RUN_TEST(test_it_is_told_where_a_body_glides);
    RUN_TEST(test_it_is_told_where_a_body_enters_another);
    RUN_TEST(test_bodies_that_cannot_be);
    RUN_TEST(test_light_boxes_let_go_under_water_are_stable);
    RUN_TEST(test_a_body_goes_on_from_a_save);
    return UNITY_END();
}
