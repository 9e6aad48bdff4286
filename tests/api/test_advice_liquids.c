/* Advice of liquids: pools, what floats on them, walls that they slip on, and volume that they lost. */
#include <math.h>
#include <string.h>

#include "advised.h"

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

/* ---- what is foreseen ---- */

/* The pool is as deep as it is, whatever its compression; the remedy makes the figure keep to its bound. */
static void test_a_pool_too_deep_for_the_rate(void)
{
    pbmpm_world_def def = default_world(2, 0.01f, 60000);
    def.domain_enabled = 1;
    const pbmpm_world_id world = create_world(&def);
    set_gravity(world, 0, -9.81f, 0);
    fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0.5f, 0.25f, 0, 0.5f, 0.25f, 0.5f), STILL);
    const pbmpm_advice *advice = expect(world, PBMPM_ADVICE_POOL_TOO_DEEP);
    TEST_ASSERT_FLOAT_WITHIN(0.05f * 13.6f, 9.81f * DT * DT * 0.5f / (0.01f * 0.01f), advice->figure);
    TEST_ASSERT_EQUAL_INT(PBMPM_CHANGE_SUBSTEPS, advice->change);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 100.0f * (advice->value - 1.0f), advice->price);
    set_rate(world, (int32_t)advice->value, 5);
    expect_none(world, PBMPM_ADVICE_POOL_TOO_DEEP);
}

/* With the paper's solver: the strain at the bottom, rho g depth over the modulus that acts, may be a tenth. */
static void test_a_pool_too_deep_for_the_papers_solver(void)
{
    for (int deep = 0; deep < 2; deep++) {
        pbmpm_world_def def = default_world(2, 0.1f, 8192);
        def.domain_enabled = 1;
        for (int a = 0; a < 2; a++) def.domain_max[a] = 4;
        const pbmpm_world_id world = create_world(&def);
        const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
        const float depth = deep ? 1.8f : 1.0f;
        pbmpm_effective effective = {.size = sizeof effective};
        set_gravity(world, 0, -9.81f, 0);
        set_solver(world, PBMPM_SOLVER_PAPER);
        set_rate(world, 1, 20);
        fill_shape(world, water, box_shape(2, 0.5f * depth, 0, 2, 0.5f * depth, 1), STILL);
        OK(pbmpm_material_effective(world, water, DT, &effective));
        const float strain = 1000 * 9.81f * depth / effective.bulk_modulus;
        if (deep) TEST_ASSERT_FLOAT_WITHIN(0.1f * strain, strain, expect(world, PBMPM_ADVICE_POOL_TOO_DEEP)->figure);
        else expect_none(world, PBMPM_ADVICE_POOL_TOO_DEEP);
    }
}

/* Speeds by the law of docs/choosing.md, with f = g dt^2 depth / dx^2: a share of f cells per substep, of f^2 above 3, more there with fewer than five iterations. */
static void test_how_fast_a_pool_stirs(void)
{
    static const struct {
        int32_t dimension, iterations, cells;
        float bulk_modulus, angle, linear, square; /* 0: not told */
    } cases[] = {{2, 5, 36, 0, 0, 0, 0},           {2, 5, 53, 0, 0, 0.0013f, 0},         {2, 2, 53, 0, 0, 0.0013f, 0}, {2, 5, 64, 0, 0, 0, 0.0015f},
                 {2, 2, 64, 0, 0, 0, 6.25f * 0.0015f}, {3, 5, 58, 0, 0, 0, 0.0015f},     {2, 5, 24, 0, 0.3f, 0.0045f, 0}, {2, 5, 12, 1e6f, 0, 0, 0.012f}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const float cell = 0.05f, depth = cell * (float)cases[i].cells, f = 9.81f * DT * DT * depth / (cell * cell);
        pbmpm_world_def def = default_world(cases[i].dimension, cell, 32768);
        pbmpm_material_def water = default_material(PBMPM_LIQUID);
        def.domain_enabled = 1;
        def.domain_max[0] = def.domain_max[2] = 8 * cell;
        def.domain_max[1] = 4;
        water.bulk_modulus = cases[i].bulk_modulus;
        const pbmpm_world_id world = create_world(&def);
        set_gravity(world, 9.81f * sinf(cases[i].angle), -9.81f * cosf(cases[i].angle), 0);
        set_rate(world, 1, cases[i].iterations);
        fill_shape(world, add_material(world, &water), box_shape(4 * cell, 0.5f * depth, 4 * cell, 4 * cell, 0.5f * depth, 4 * cell), STILL);
        const float speed = (cases[i].linear * f + cases[i].square * f * f) * cell / DT;
        if (speed == 0.0f) {
            expect_none(world, PBMPM_ADVICE_POOL_STIRS);
            continue;
        }
        const pbmpm_advice *advice = expect(world, PBMPM_ADVICE_POOL_STIRS);
        TEST_ASSERT_FLOAT_WITHIN(0.05f * speed, speed, advice->figure);
        TEST_ASSERT_EQUAL_INT(PBMPM_CHANGE_SUBSTEPS, advice->change);
        set_rate(world, (int32_t)advice->value, cases[i].iterations);
        expect_none(world, PBMPM_ADVICE_POOL_STIRS);
        set_rate(world, (int32_t)advice->value - 1, cases[i].iterations);
        expect(world, PBMPM_ADVICE_POOL_STIRS);
        set_gravity(world, 0, 0, 0);
        expect_none(world, PBMPM_ADVICE_POOL_STIRS);
    }
}

/* On ground that leans it stirs at ten times the speed. A step in a level floor is no slope, and a pool of two cells is too shallow. */
static void test_a_pool_on_a_slope(void)
{
    static const struct {
        int32_t dimension;
        float angle, depth;
        bool step, told;
    } cases[] = {{2, 0.15f, 0.4f, false, true}, {3, 0.15f, 0.4f, false, true}, {2, 0, 0.4f, false, false}, {2, 0, 0.4f, true, false}, {2, 0.15f, 0.1f, false, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        pbmpm_world_def def = default_world(cases[i].dimension, 0.05f, 32768);
        const float deep = cases[i].depth, c = cosf(0.5f * cases[i].angle), s = sinf(0.5f * cases[i].angle);
        def.domain_enabled = 1;
        def.domain_max[1] = 2;
        const pbmpm_world_id world = create_world(&def);
        pbmpm_shape ground = box_shape(0.5f, 0, 0.5f, 2, 0.2f, 2);
        if (cases[i].dimension == 2) ground.rotation[2] = s;
        else ground.rotation[0] = s;
        ground.rotation[3] = c;
        set_gravity(world, 0, -9.81f, 0);
        create_collider(world, ground, false);
        if (cases[i].step) create_collider(world, box_shape(0.25f, 0, 0.5f, 0.25f, 0.3f, 2), false);
        fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0.5f, 0.3f + 0.5f * deep, 0.5f, 0.5f, 0.5f * deep, 0.5f), STILL);
        if (cases[i].told) {
            const pbmpm_advice *advice = expect(world, PBMPM_ADVICE_POOL_STIRS);
            const float f = 9.81f * DT * DT * deep / (0.05f * 0.05f), speed = 0.016f * f * 0.05f / DT;
            TEST_ASSERT_FLOAT_WITHIN(0.1f * speed, speed, advice->figure);
            TEST_ASSERT_NOT_NULL(strstr(advice->text, "leans"));
            set_rate(world, (int32_t)advice->value, 5);
        }
        expect_none(world, PBMPM_ADVICE_POOL_STIRS);
    }
}

/* A pool that moves as slowly as no wave is seen. Not one that rests, that sloshes, that may be settling or that something drains; nor one that does not lie level, as a wave does while it turns. */
static void test_a_pool_that_moves(void)
{
    static const struct {
        float speed, pull;
        bool stepped, drained, told;
    } cases[] = {{0.03f, 0, true, false, true}, {0.03f, 0, false, false, false}, {0.03f, 0, true, true, false}, {0.008f, 0, true, false, false}, {0.15f, 0, true, false, false}, {0.03f, 1.5f, true, false, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        pbmpm_world_def def = default_world(2, 0.05f, 8192);
        pbmpm_drain_def drain;
        pbmpm_drain_id id;
        def.domain_enabled = 1;
        const pbmpm_world_id world = create_world(&def);
        const pbmpm_shape hole = box_shape(0.5f, 0.9f, 0, 0.1f, 0.05f, 1);
        const float velocity[3] = {cases[i].speed, 0, 0};
        set_gravity(world, cases[i].pull, -9.81f, 0);
        fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0.5f, 0.2f, 0, 0.5f, 0.2f, 1), velocity);
        OK(pbmpm_drain_def_init(&drain, sizeof drain));
        if (cases[i].drained) OK(pbmpm_drain_create(world, &drain, &hole, &id));
        for (int step = 0; step < (cases[i].stepped ? 300 : 299); step++) OK(pbmpm_world_step(world, 1e-6f)); /* 5 s if they were of DT */
        if (!cases[i].told) {
            expect_none(world, PBMPM_ADVICE_POOL_STIRS);
            continue;
        }
        const pbmpm_advice *advice = expect(world, PBMPM_ADVICE_POOL_STIRS);
        TEST_ASSERT_EQUAL_INT32(1, advice->came_true);
        const pbmpm_stats stats = world_stats(world);
        TEST_ASSERT_FLOAT_WITHIN(1e-4f, (float)sqrt(2 * stats.kinetic_energy / stats.mass), advice->figure);
    }
}

static pbmpm_shape turned_box(float x, float y, float half_width, float half_height, float angle)
{
    pbmpm_shape box = box_shape(x * cosf(angle) - y * sinf(angle), x * sinf(angle) + y * cosf(angle), 0, half_width, half_height, 1);
    box.rotation[2] = sinf(0.5f * angle);
    box.rotation[3] = cosf(0.5f * angle);
    return box;
}

/* A glass that is turned together with gravity: its water lies level, however thin its walls. */
static void test_a_pool_that_moves_in_a_thin_glass(void)
{
    const float angle = 0.35f, velocity[3] = {0.03f, 0, 0};
    for (int thick = 0; thick < 2; thick++) {
        const float half = thick ? 0.1f : 0.0025f; /* a tenth of a cell */
        const pbmpm_world_id world = falling_world(2, 0.05f);
        create_collider(world, turned_box(0.6f, -half, 0.6f + 2 * half, half, angle), false);
        for (int side = 0; side < 2; side++) create_collider(world, turned_box(side ? 1.2f + half : -half, 0.4f, half, 0.4f, angle), false);
        set_gravity(world, 9.81f * sinf(angle), -9.81f * cosf(angle), 0);
        fill_shape(world, create_material(world, PBMPM_LIQUID), turned_box(0.6f, 0.3f, 0.6f, 0.3f, angle), velocity);
        for (int step = 0; step < 301; step++) OK(pbmpm_world_step(world, 1e-6f)); /* 5 s if they were of DT */
        TEST_ASSERT_EQUAL_INT32(1, expect(world, PBMPM_ADVICE_POOL_STIRS)->came_true);
    }
}

/* In a pool that rests the predicted error is that of pressures which move nothing. */
static void test_a_pool_at_rest_is_solved(void)
{
    pbmpm_world_def def = default_world(2, 0.02f, 8192);
    def.domain_enabled = 1;
    def.domain_max[0] = 0.4f;
    const pbmpm_world_id world = create_world(&def);
    set_gravity(world, 0, -9.81f, 0);
    fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0.2f, 0.2f, 0, 0.2f, 0.2f, 1), STILL);
    for (int step = 0; step < 60; step++) OK(pbmpm_world_step(world, DT));
    TEST_ASSERT_TRUE(world_stats(world).predicted_error > 0.05f);
    expect_none(world, PBMPM_ADVICE_NOT_SOLVED);
}

/* A glass of 20 cells of 2.5 cm in 3D rests, and so do pools around a raft that is held, and one that floats. */
static void test_a_calm_pool_and_a_raft(void)
{
    pbmpm_world_def def = default_world(3, 0.025f, 60000);
    def.domain_enabled = 1;
    const pbmpm_world_id glass = create_world(&def);
    set_gravity(glass, 0, -9.81f, 0);
    fill_shape(glass, create_material(glass, PBMPM_LIQUID), box_shape(0.1f, 0.25f, 0.1f, 0.1f, 0.25f, 0.1f), STILL);
    expect_none(glass, PBMPM_ADVICE_POOL_STIRS);
    def = default_world(2, 0.05f, 60000);
    def.domain_enabled = 1;
    const pbmpm_world_id tank = create_world(&def);
    set_gravity(tank, 0, -9.81f, 0);
    fill_shape(tank, create_material(tank, PBMPM_LIQUID), box_shape(0.5f, 0.325f, 0, 0.5f, 0.325f, 0.5f), STILL);
    const pbmpm_shape shape = box_shape(0.5f, 0.66f, 0, 0.2f, 0.05f, 0.5f);
    pbmpm_collider_def raft = default_collider();
    pbmpm_collider_id id;
    raft.kinematic = 1;
    OK(pbmpm_collider_create(tank, &raft, &shape, &id));
    expect_none(tank, PBMPM_ADVICE_POOL_STIRS);
    OK(pbmpm_collider_destroy(tank, id));
    raft.measures_impulse = 1;
    OK(pbmpm_collider_create(tank, &raft, &shape, &id));
    expect_none(tank, PBMPM_ADVICE_POOL_STIRS);
}

/* A ball that a wall parts from the pool stays dry, one in the way of what will flow does not. One under a pool that lies level is no matter. */
static void test_a_dry_ball(void)
{
    for (int parted = 0; parted < 3; parted++) {
        pbmpm_world_def def = default_world(2, 0.05f, 8192);
        def.domain_enabled = 1;
        def.domain_max[0] = 3;
        def.domain_max[1] = 2;
        const pbmpm_world_id world = create_world(&def);
        set_gravity(world, 0, -9.81f, 0);
        fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0.5f, 0.35f, 0, 0.5f, 0.35f, 1), STILL);
        create_collider(world, sphere_shape(parted == 2 ? 0.5f : 2, 0.3f, 0, 0.2f), false);
        if (parted == 1) create_collider(world, box_shape(1.1f, 0.5f, 0, 0.1f, 1, 1), false);
        if (parted) expect_none(world, PBMPM_ADVICE_POOL_STIRS);
        else expect(world, PBMPM_ADVICE_POOL_STIRS);
    }
}

/* Honey among walls that it slips on; one wall that holds it is enough, and without any nothing is said. An obstacle that does not act on it does not count. */
static void test_a_viscous_liquid_slips(void)
{
    static const struct Walls {
        pbmpm_friction friction[2];
        uint32_t meets;
        int walls;
        pbmpm_solver solver;
        bool told;
    } cases[] = {
        {{0}, 0, 0, PBMPM_SOLVER_CONVERGENT, false},
        {{PBMPM_FRICTION_SLIP}, 0, 1, PBMPM_SOLVER_CONVERGENT, true},
        {{PBMPM_FRICTION_COULOMB}, 0, 1, PBMPM_SOLVER_CONVERGENT, false},
        {{PBMPM_FRICTION_COULOMB}, 0, 1, PBMPM_SOLVER_PAPER, true},
        {{PBMPM_FRICTION_COULOMB}, 0, 1, PBMPM_SOLVER_PRIMAL, true},
        {{PBMPM_FRICTION_SLIP, PBMPM_FRICTION_STICK}, 0, 2, PBMPM_SOLVER_PAPER, false},
        {{PBMPM_FRICTION_SLIP, PBMPM_FRICTION_STICK}, 2, 2, PBMPM_SOLVER_CONVERGENT, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        pbmpm_world_def def = default_world(2, 0.05f, 8192);
        pbmpm_material_def honey = default_material(PBMPM_LIQUID);
        const pbmpm_shape slab = box_shape(0.5f, -0.1f, 0, 1, 0.1f, 1);
        pbmpm_collider_def floor = {0};
        pbmpm_collider_id id;
        const pbmpm_world_id world = create_world(&def);
        honey.kinematic_viscosity = 0.005f;
        set_gravity(world, 0, -9.81f, 0);
        set_solver(world, cases[i].solver);
        fill_shape(world, add_material(world, &honey), box_shape(0.5f, 0.25f, 0, 0.5f, 0.25f, 1), STILL);
        OK(pbmpm_collider_def_init(&floor, sizeof floor));
        for (int k = 0; k < cases[i].walls; k++) {
            floor.friction = cases[i].friction[k];
            floor.meets = k == 1 ? cases[i].meets : 0;
            OK(pbmpm_collider_create(world, &floor, &slab, &id));
        }
        if (cases[i].told) expect(world, PBMPM_ADVICE_NO_FRICTION);
        else expect_none(world, PBMPM_ADVICE_NO_FRICTION);
    }
}

/* A block afloat with a film of one particle on it, with none, and under a cell and a half of water. */
static void test_a_film_on_what_floats(void)
{
    for (int film = 0; film < 3; film++) {
        pbmpm_world_def def = default_world(2, 0.05f, 8192);
        pbmpm_material_def wood = default_material(PBMPM_ELASTIC);
        def.domain_enabled = 1;
        def.domain_max[0] = def.domain_max[1] = 2;
        wood.density = 800;
        const pbmpm_world_id world = create_world(&def);
        const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
        set_gravity(world, 0, -9.81f, 0);
        fill_shape(world, water, box_shape(0.35f, 0.25f, 0, 0.35f, 0.25f, 1), STILL);
        fill_shape(world, water, box_shape(1.65f, 0.25f, 0, 0.35f, 0.25f, 1), STILL);
        fill_shape(world, add_material(world, &wood), box_shape(1, 0.35f, 0, 0.25f, 0.25f, 1), STILL);
        if (film == 1) fill_shape(world, water, box_shape(1, 0.6125f, 0, 0.25f, 0.0125f, 1), STILL);
        if (film == 2) fill_shape(world, water, box_shape(1, 0.7f, 0, 0.25f, 0.1f, 1), STILL);
        ask(world);
        TEST_ASSERT_EQUAL_INT(film == 1, tells("a film of liquid"));
    }
}

/* The grid misses a tenth of the lift of a box of four cells in 2D: one of 0.95 of water's density needs eight. What is far above the water, or heavier, or has not been advanced, is told nothing. */
static void test_a_rigid_body_that_may_sink(void)
{
    static const struct {
        float side, height, density;
        bool advanced, told;
    } cases[] = {{0.2f, 0.6f, 950, true, true},  {0.2f, 0.6f, 850, true, false}, {0.5f, 0.8f, 950, true, false},
                 {0.2f, 2.0f, 950, true, false}, {0.2f, 0.6f, 1050, true, false}, {0.2f, 0.6f, 950, false, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const pbmpm_world_id world = falling_world(2, 0.05f);
        const pbmpm_shape box = box_shape(1, cases[i].height, 0, 0.5f * cases[i].side, 0.5f * cases[i].side, 1);
        fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(1, 0.25f, 0, 1, 0.25f, 1), STILL);
        create_body(world, &box, cases[i].density * cases[i].side * cases[i].side, cases[i].advanced);
        if (!cases[i].told) {
            expect_none(world, PBMPM_ADVICE_BODY_TOO_THIN);
            continue;
        }
        const pbmpm_advice *advice = expect(world, PBMPM_ADVICE_BODY_TOO_THIN);
        TEST_ASSERT_FLOAT_WITHIN(1e-3f, 4.0f, advice->figure);
        TEST_ASSERT_FLOAT_WITHIN(1e-2f, 8.0f, advice->bound);
    }
}

static void test_a_rigid_ball_that_turns_by_itself(void)
{
    static const struct {
        float radius, height;
        bool told;
    } cases[] = {{0.15f, 0.6f, true}, {0.15f, 2.0f, false}, {0.6f, 1.1f, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const pbmpm_world_id world = falling_world(2, 0.05f);
        const pbmpm_shape ball = sphere_shape(1, cases[i].height, 0, cases[i].radius);
        fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(1, 0.25f, 0, 1, 0.25f, 1), STILL);
        create_body(world, &ball, 30, true);
        ask(world);
        TEST_ASSERT_EQUAL_INT(cases[i].told, tells("turns by itself"));
    }
}

/* A crate in a pool, by its distance from the floor of the domain and its density. */
static void test_a_light_rigid_body_that_stays_down(void)
{
    static const struct {
        float above, density;
        bool told;
    } cases[] = {{0.0f, 400, true}, {0.025f, 400, true}, {0.1f, 400, false}, {0.0f, 1500, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        pbmpm_world_def def = default_world(2, 0.05f, 20000);
        def.domain_enabled = 1;
        def.domain_max[0] = def.domain_max[1] = 2;
        const pbmpm_world_id world = create_world(&def);
        const pbmpm_shape crate = box_shape(1, cases[i].above + 0.2f, 0, 0.2f, 0.2f, 1);
        set_gravity(world, 0, -9.81f, 0);
        create_body(world, &crate, cases[i].density * 0.16f, true);
        fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0.3f, 0.1f, 0, 0.3f, 0.1f, 1), STILL);
        ask(world);
        TEST_ASSERT_EQUAL_INT(cases[i].told, tells("stays there when liquid comes"));
    }
}

/* ---- what came true ---- */

/* Twice as many particles as there is room for. */
static void check_volume(int32_t dimension)
{
    pbmpm_world_def def = default_world(dimension, 0.1f, 60000);
    def.domain_enabled = 1;
    const pbmpm_world_id world = create_world(&def);
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    fill_shape(world, water, box_shape(0.5f, 0.4f, 0.5f, 0.5f, 0.4f, 0.5f), STILL);
    expect_none(world, PBMPM_ADVICE_VOLUME_LOST);
    fill_shape(world, water, box_shape(0.5f, 0.4f, 0.5f, 0.5f, 0.4f, 0.5f), STILL);
    OK(pbmpm_world_step(world, 1e-4f));
    const pbmpm_advice *advice = expect(world, PBMPM_ADVICE_VOLUME_LOST);
    TEST_ASSERT_EQUAL_INT32(1, advice->came_true);
    TEST_ASSERT_FLOAT_WITHIN(0.05f, 0.5f, advice->figure);
}

static void test_volume_that_is_lost(void)
{
    check_volume(2);
    check_volume(3);
}

/* Two full cells of 27 are filled twice: the mean is 0.07 too high, and known to 0.05. */
static void test_volume_that_chance_may_have_lost(void)
{
    pbmpm_world_def def = default_world(2, 0.1f, 4000);
    def.domain_enabled = 1;
    const pbmpm_world_id world = create_world(&def);
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    fill_shape(world, water, box_shape(0.5f, 0.2f, 0, 0.5f, 0.2f, 0.5f), STILL);
    for (int extra = 0; extra < 2; extra++) fill_shape(world, water, box_shape(extra ? 0.2f : 0.5f, 0.2f, 0, 0.05f, 0.05f, 0.5f), STILL);
    OK(pbmpm_world_step(world, 1e-4f));
    expect_none(world, PBMPM_ADVICE_VOLUME_LOST);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_pool_too_deep_for_the_rate);
    RUN_TEST(test_a_pool_too_deep_for_the_papers_solver);
    RUN_TEST(test_how_fast_a_pool_stirs);
    RUN_TEST(test_a_pool_on_a_slope);
    RUN_TEST(test_a_pool_that_moves);
    RUN_TEST(test_a_pool_that_moves_in_a_thin_glass);
    RUN_TEST(test_a_pool_at_rest_is_solved);
    RUN_TEST(test_a_calm_pool_and_a_raft);
    RUN_TEST(test_a_dry_ball);
    RUN_TEST(test_a_viscous_liquid_slips);
    RUN_TEST(test_a_film_on_what_floats);
    RUN_TEST(test_a_rigid_body_that_may_sink);
    RUN_TEST(test_a_rigid_ball_that_turns_by_itself);
    RUN_TEST(test_a_light_rigid_body_that_stays_down);
    RUN_TEST(test_volume_that_is_lost);
    RUN_TEST(test_volume_that_chance_may_have_lost);
    return UNITY_END();
}
