/* What all solvers share: parameters of a substep, and the rules that end its iterations. */
#include <float.h>
#include <math.h>
#include <string.h>
#include <unity.h>

#include "base/clock.h"
#include "grid/build.h"
#include "random.h"
#include "services/lifecycle.h"
#include "solvers/dual/dual.h"
#include "solvers/dual/dual_error.h"
#include "solvers/dual/rounds.h"
#include "solvers/passes.h"
#include "solvers/solver.h"
#include "world/depth.h"

void setUp(void) {}
void tearDown(void) {}

static World *open_world(int dimension, float cell_size)
{
    pbmpm_world_def def = world_def_defaults();
    World *world = NULL;
    def.dimension = dimension;
    def.cell_size = cell_size;
    def.particle_capacity = 128;
    def.thread_count = 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_create(&def, &world));
    return world;
}

static void bind_for(World *world, float dt, bool with_volume)
{
    world->substep = world_substep(world, (double)dt);
    solver_bind(world, with_volume);
}

static double share_of(const World *world, const pbmpm_material_def *def, double dt)
{
    const Substep substep = world_substep(world, dt);
    return dual_stiffness_share(world, def, &substep);
}

static double cap_of(const World *world, const pbmpm_material_def *def, double dt)
{
    const Substep substep = world_substep(world, dt);
    return dual_stiffness_cap(world, def, &substep);
}

static const KernelMaterial *bound_material(World *world, const pbmpm_material_def *def, pbmpm_solver solver, float dt)
{
    pbmpm_material_id id;
    TEST_ASSERT_NULL(material_problem(def));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, def, 1, &id));
    world->record.solver = world->settings.solver = solver;
    bind_for(world, dt, false);
    return &world->materials.kernel[id.index];
}

/* The value times what the product of a few roundings may add. */
#define NEAR(expected, actual) TEST_ASSERT_DOUBLE_WITHIN(4e-7 * fabs(expected), expected, (double)(actual))

static double random_size(Random *random, double low, double high) { return exp(random_in(random, log(low), log(high))); }

/* ---- Moduli ---- */

/* A modulus without unit is the square of twice the cells that its wave travels per substep. */
static double twice_courant_squared(double modulus, double density, double dt, double cell)
{
    const double speed = sqrt(modulus / density), cells = speed * dt / cell;
    return 4.0 * cells * cells;
}

static void test_moduli_of_liquids(void)
{
    Random random = {1};
    for (int i = 0; i < 200; i++) {
        const float cell = (float)random_size(&random, 1e-3, 10.0), dt = (float)random_size(&random, 1e-5, 0.1);
        World *world = open_world(2 + i % 2, cell);
        pbmpm_material_def def = material_defaults();
        def.density = (float)random_size(&random, 1.0, 1e4);
        def.bulk_modulus = (float)random_size(&random, 1.0, 1e9);
        def.relaxation = (float)random_in(&random, 0.1, 1.9);
        const KernelMaterial *material = bound_material(world, &def, PBMPM_SOLVER_DUAL, dt);
        const double L = twice_courant_squared((double)def.bulk_modulus, (double)def.density, (double)dt, (double)cell);
        NEAR(L, material->dilation);
        NEAR(1.0 / L, material->inverse_stiffness);
        NEAR(L / (double)def.bulk_modulus / 2.0, material->multiplier_per_pascal); /* a pressure K gives the multiplier L; half of it is carried over */
        NEAR((double)def.bulk_modulus / L, material->pascal_per_multiplier);
        TEST_ASSERT_EQUAL_FLOAT(def.relaxation, material->relaxation);
        world->settings.iterations = 1;
        bind_for(world, dt, true);
        NEAR(L / (double)def.bulk_modulus * 0.45, material->multiplier_per_pascal); /* a single one carries less, so that it damps */
        world_destroy(world);
    }
}

/* What yields answers to a deviator by the share beta of what it answers to a volume strain in the paper's solver. */
static void test_what_yields_is_softer_to_shear(void)
{
    for (int kind = PBMPM_SAND; kind <= PBMPM_VISCO; kind++)
        for (int i = 1; i <= 8; i++) {
            World *world = open_world(2 + i % 2, 0.1f);
            pbmpm_material_def def = material_defaults();
            def.kind = (pbmpm_material_kind)kind;
            def.elasticity_ratio = 0.125f * (float)i;
            NEAR(8.0 / i, bound_material(world, &def, PBMPM_SOLVER_PAPER, 0.01f)->bulk_over_shear);
            world_destroy(world);
        }
}

static void test_an_incompressible_liquid(void)
{
    World *world = open_world(3, 0.1f);
    const pbmpm_material_def def = material_defaults();
    const KernelMaterial *material = bound_material(world, &def, PBMPM_SOLVER_DUAL, 1.0f / 60);
    TEST_ASSERT_TRUE(material->inverse_stiffness == 0.0f && material->dilation == FLT_MAX);
    world_destroy(world);
}

/* Cells hold the pressure of the lightest liquid there is, if liquids differ and no iterations of the cells themselves need safe steps. */
static void test_lightness(void)
{
    static const float densities[] = {1000.0f, 200.0f, 50.0f, 10.0f};
    World *world = open_world(2, 0.1f);
    const KernelMaterial *material = world->materials.kernel;
    for (int i = 0; i < 4; i++) {
        pbmpm_material_def def = material_defaults();
        def.density = densities[i];
        def.kind = i == 2 ? PBMPM_ELASTIC : PBMPM_LIQUID;
        bound_material(world, &def, PBMPM_SOLVER_DUAL, 1.0f / 60);
    }
    world->particles.of_material[0] = world->particles.of_material[2] = 1;
    bind_for(world, 1.0f / 60, false);
    for (int i = 0; i < 4; i++) TEST_ASSERT_EQUAL_FLOAT(1.0f, material[i].lightness); /* one liquid has particles */
    world->particles.of_material[1] = 1;
    bind_for(world, 1.0f / 60, false);
    for (int i = 0; i < 3; i++) TEST_ASSERT_EQUAL_FLOAT(200.0f / densities[i], material[i].lightness);
    world->settings.pressure = PBMPM_PRESSURE_CELLS;
    bind_for(world, 1.0f / 60, false);
    for (int i = 0; i < 3; i++) TEST_ASSERT_EQUAL_FLOAT(1.0f, material[i].lightness);
    world_destroy(world);
}

/* Feedback fades in the liquid of the dual and the primal solver where it is slower than 2.4 cells per second. */
static void test_feedback_of_calm_liquid(void)
{
    const pbmpm_material_def def = material_defaults();
    for (pbmpm_solver solver = PBMPM_SOLVER_PAPER; solver <= PBMPM_SOLVER_EXPLICIT; solver++) {
        World *world = open_world(2, 0.1f);
        bound_material(world, &def, solver, 1.0f / 60);
        TEST_ASSERT_FLOAT_WITHIN(1e-8f, solver == PBMPM_SOLVER_DUAL ? 0.04f : 0.0f, world->args.feedback_way);
        TEST_ASSERT_FLOAT_WITHIN(1e-8f, solver == PBMPM_SOLVER_PRIMAL ? 0.04f : 0.0f, world->args.quiet_way);
        world_destroy(world);
    }
}

/* Stiffest and softest, longest and shortest: no infinity, no NaN. */
static void test_moduli_stay_finite(void)
{
    static const float cells[] = {1e-6f, 1e6f}, steps[] = {1e-20f, 10.0f}, moduli[] = {1e-3f, 1e15f}, densities[] = {1e-3f, 1e6f};
    for (int i = 0; i < 32; i++) {
        World *world = open_world(3, cells[i & 1]);
        pbmpm_material_def def = material_defaults();
        def.kind = i & 16 ? PBMPM_ELASTIC : PBMPM_LIQUID;
        def.bulk_modulus = def.young_modulus = moduli[i >> 2 & 1];
        def.density = densities[i >> 3 & 1];
        def.poisson_ratio = 0.495f;
        for (pbmpm_solver solver = PBMPM_SOLVER_DUAL; solver <= PBMPM_SOLVER_EXPLICIT; solver++) {
            world->materials.generation[0] = 0;
            const KernelMaterial *m = bound_material(world, &def, solver, steps[i >> 1 & 1]);
            TEST_ASSERT_TRUE(isfinite(m->shear) && isfinite(m->dilation) && isfinite(m->multiplier_per_pascal) && isfinite(m->pascal_per_multiplier));
            TEST_ASSERT_TRUE(m->shear >= 0.0f && m->dilation >= 0.0f && m->multiplier_per_pascal >= 0.0f && m->pascal_per_multiplier >= 0.0f && m->volume_feedback >= 0.0f);
        }
        world_destroy(world);
    }
}

/* mu and lambda of E and nu; the dual solver has as much of them as it can hold. */
static void test_moduli_of_elastic_bodies(void)
{
    Random random = {2};
    for (int i = 0; i < 200; i++) {
        const float cell = (float)random_size(&random, 1e-3, 10.0), dt = (float)random_size(&random, 1e-4, 0.1);
        World *world = open_world(2 + i % 2, cell);
        pbmpm_material_def def = material_defaults();
        def.kind = PBMPM_ELASTIC;
        def.density = (float)random_size(&random, 1.0, 1e4);
        def.young_modulus = (float)random_size(&random, 1.0, 1e9);
        def.poisson_ratio = (float)random_in(&random, 0.0, 0.49);
        world->settings.iterations = 1 + i % 40;
        const pbmpm_solver solver = i % 3 ? PBMPM_SOLVER_PRIMAL : PBMPM_SOLVER_DUAL;
        const KernelMaterial *material = bound_material(world, &def, solver, dt);
        const double nu = (double)def.poisson_ratio, E = (double)def.young_modulus, rho = (double)def.density;
        const double share = solver == PBMPM_SOLVER_DUAL ? cap_of(world, &def, (double)dt) : 1.0;
        TEST_ASSERT_TRUE(share > 0.0 && share <= 1.0);
        NEAR(share * twice_courant_squared(E / (2.0 * (1.0 + nu)), rho, (double)dt, (double)cell), material->shear);
        NEAR(share * twice_courant_squared(E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), rho, (double)dt, (double)cell), material->dilation);
        world_destroy(world);
    }
}

/* The share of a stiff body goes with the square of the iterations and of 1/dt, so that what it holds does not depend on dt; a soft one is held whole. */
static void test_what_the_dual_solver_holds(void)
{
    World *world = open_world(2, 0.05f);
    pbmpm_material_def def = material_defaults();
    def.kind = PBMPM_ELASTIC;
    def.young_modulus = 1e9f;
    world->settings.iterations = 50;
    const double once = share_of(world, &def, 1.0 / 60);
    NEAR(4.0 * once, share_of(world, &def, 1.0 / 120));
    world->settings.iterations = 100;
    TEST_ASSERT_TRUE(share_of(world, &def, 1.0 / 60) > 3.9 * once && once < 1.0);
    def.young_modulus = 1.0f;
    TEST_ASSERT_EQUAL_DOUBLE(1.0, share_of(world, &def, 1.0 / 60));
    world_destroy(world);
}

/* The stress in an even strain of 1 that so many iterations reach, with Nesterov's extrapolation: each solves S / M + 1 = 0 with its own answer 1. */
static double reached_by(double modulus, int iterations)
{
    double stress = 0.0, last = 0.0, t = 1.0, extrapolation = 0.0;
    for (int i = 0; i < iterations; i++) {
        const double from = stress + extrapolation * (stress - last), next = 0.5 * (1.0 + sqrt(1.0 + 4.0 * t * t));
        last = stress;
        stress = from - (from / modulus + 1.0) / (1.0 / modulus + 1.0);
        extrapolation = (t - 1.0) / next;
        t = next;
    }
    return -stress;
}

/* Bodies of raised iterations begin with what the old ones held of (n / 2.5)^2, and stiffen as slowly as they swing; fewer count at once. */
static void test_raised_iterations_take_effect_slowly(void)
{
    World *world = open_world(2, 0.05f);
    pbmpm_material_def def = material_defaults();
    def.kind = PBMPM_ELASTIC;
    def.young_modulus = 1e9f;
    world->record.solver = PBMPM_SOLVER_DUAL;
    world->settings.gravity[1] = 0.0f;
    world->settings.iterations = 10;
    const double ten = share_of(world, &def, 1.0 / 60);
    bind_for(world, 1.0f / 60, false);
    NEAR(ten, share_of(world, &def, 1.0 / 60));
    world->settings.iterations = 40;
    NEAR(ten, share_of(world, &def, 1.0 / 60));
    bind_for(world, 1.0f / 60, false);
    const double asked = 16.0 / ten * share_of(world, &def, 1.0 / 60);
    NEAR(reached_by(16.0, 10), reached_by(asked, 40));
    bind_for(world, 1.0f / 60, false);
    NEAR(asked * exp(sqrt(asked) / 192.0), 16.0 / ten * share_of(world, &def, 1.0 / 60));
    for (int i = 0; i < 120; i++) bind_for(world, 1.0f / 60, false);
    NEAR(16.0 * ten, share_of(world, &def, 1.0 / 60));
    world->settings.iterations = 10;
    bind_for(world, 1.0f / 60, false);
    NEAR(ten, share_of(world, &def, 1.0 / 60));
    world_destroy(world);
}

/* Where gravity pulls, solids by themselves are asked for more than they hold, so that a column of the world's depth is compressed by 1/20 at most:
 * c (2 mu + lambda) >= 20 * 4 g dt^2/dx per cell of depth, 5 per iteration at most, and half of that where g dt^2 is 0.2 cells or more. Liquid
 * and weightlessness end that. */
static void test_what_solids_are_asked_to_bear(void)
{
    World *world = open_world(2, 0.05f);
    pbmpm_material_def def = material_defaults();
    def.kind = PBMPM_ELASTIC;
    def.young_modulus = 1e9f;
    world->settings.iterations = 5;
    world->settings.gravity[0] = world->settings.gravity[1] = 0.0f;
    const double held = share_of(world, &def, 1.0 / 60);
    NEAR(held, cap_of(world, &def, 1.0 / 60));
    world->settings.gravity[1] = -9.81f;
    TEST_ASSERT_TRUE(matter_depth(world) > 0.0);
    const double fall = (double)9.81f / (60.0 * 60.0) / (double)0.05f, weight = 80.0 * fall * matter_depth(world);
    const double most = 25.0;
    NEAR(fmax(1.0, fmin(weight, most) / 4.0) * held, cap_of(world, &def, 1.0 / 60)); /* 5 iterations hold (5 / 2.5)^2 */
    static const double fallen[] = {0.1, 0.125, 0.2, 1000.0}, shares[] = {1.0, 0.8, 0.5, 0.5};
    for (int i = 0; i < 4; i++) {
        world->settings.gravity[1] = -(float)(fallen[i] * 60.0 * 60.0 * 0.05);
        NEAR(fmin(80.0 * fallen[i] * matter_depth(world), shares[i] * most) / 4.0 * held, cap_of(world, &def, 1.0 / 60));
    }
    world->settings.iterations = 1;
    NEAR(2.5 / 4.0 * held, cap_of(world, &def, 1.0 / 60));
    world_destroy(world);
}

/* Beside sand a body is asked for what the iterations hold, as by itself; beside liquid for (4 n)^2. */
static void test_solids_beside_sand_are_asked_for_what_is_held(void)
{
    World *world = open_world(2, 0.05f);
    pbmpm_material_def body = material_defaults(), other = material_defaults();
    pbmpm_material_id solid, beside;
    body.kind = PBMPM_ELASTIC;
    body.young_modulus = 1e9f;
    body.poisson_ratio = 0.0f;
    other.kind = PBMPM_SAND;
    world->settings.iterations = 5;
    memset(world->settings.gravity, 0, sizeof world->settings.gravity);
    world->record.solver = PBMPM_SOLVER_DUAL;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &body, 1, &solid));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &other, 1, &beside));
    world->particles.of_material[solid.index] = world->particles.of_material[beside.index] = 1;
    const double stiffness = 2.0 * twice_courant_squared(0.5e9, 1000.0, 1.0 / 60, 0.05);
    NEAR(share_of(world, &body, 1.0 / 60), cap_of(world, &body, 1.0 / 60));
    other.kind = PBMPM_LIQUID;
    materials_set(&world->materials, beside.index, &other);
    NEAR(16.0 * 25.0 / stiffness, cap_of(world, &body, 1.0 / 60));
    memset(world->particles.of_material, 0, sizeof world->particles.of_material);
    world_destroy(world);
}

/* What bodies are asked to bear under great weight, M, grows by the factor e per three of the slowest swings, each of which takes 64 / root M substeps.
 * In the end all that 50 are asked for is there. */
static void test_what_is_asked_of_raised_iterations_grows_with_their_swing(void)
{
    World *world = open_world(2, 0.05f);
    pbmpm_material_def def = material_defaults();
    def.kind = PBMPM_ELASTIC;
    def.young_modulus = 1e9f;
    world->settings.gravity[1] = -1e6f;
    world->record.solver = PBMPM_SOLVER_DUAL;
    world->settings.iterations = 50;
    const double all = cap_of(world, &def, 1.0 / 60), stiffness = 400.0 / all; /* 50 iterations hold (50 / 2.5)^2 */
    world->settings.iterations = 1;
    bind_for(world, 1.0f / 60, false);
    NEAR(2.5, stiffness * cap_of(world, &def, 1.0 / 60));
    world->settings.iterations = 50;
    bind_for(world, 1.0f / 60, false);
    double before = stiffness * cap_of(world, &def, 1.0 / 60);
    NEAR(2.5 / 3.5, reached_by(before, 50)); /* a single one held M / (1 + M) */
    for (int i = 0; i < 600 && before < 400.0; i++) {
        const double swings = 3.0 * 64.0 / sqrt(before);
        bind_for(world, 1.0f / 60, false);
        const double asked = stiffness * cap_of(world, &def, 1.0 / 60);
        TEST_ASSERT_TRUE(asked > before && asked < (1.0 + 1e-6) * exp(1.0 / swings) * before);
        before = asked;
    }
    NEAR(400.0, before);
    world_destroy(world);
}

/* Nodes at walls follow others where a liquid leans on the walls, and for what a single iteration lays on the floor; never with the primal and the paper's. */
static void test_whose_nodes_follow_at_walls(void)
{
    World *world = open_world(2, 0.05f);
    pbmpm_material_def body = material_defaults(), water = material_defaults();
    pbmpm_material_id solid, liquid;
    body.kind = PBMPM_ELASTIC;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &body, 1, &solid));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &water, 1, &liquid));
    world->settings.iterations = 5;
    world->particles.of_material[solid.index] = 1;
    world->record.solver = PBMPM_SOLVER_EXPLICIT;
    TEST_ASSERT_FALSE(solver_follows_walls(world));
    world->record.solver = PBMPM_SOLVER_DUAL;
    TEST_ASSERT_FALSE(solver_follows_walls(world));
    world->settings.iterations = 1;
    TEST_ASSERT_TRUE(solver_follows_walls(world));
    world->settings.iterations = 5;
    world->particles.of_material[liquid.index] = 1;
    TEST_ASSERT_TRUE(solver_follows_walls(world));
    static const pbmpm_solver others[] = {PBMPM_SOLVER_PRIMAL, PBMPM_SOLVER_PAPER};
    for (int i = 0; i < 2; i++) {
        world->record.solver = others[i];
        TEST_ASSERT_FALSE(solver_follows_walls(world));
    }
    memset(world->particles.of_material, 0, sizeof world->particles.of_material);
    world_destroy(world);
}

/* Sound crosses half a root of the stiffness cells per substep; a body takes that many iterations 2.5 / 0.5 times, and at most 16 rounds more
 * than all matter does. A world without liquid takes none. */
/* What a step leaves of the stress of a lone particle, which answers it in full: the 200th, all of them with the extrapolation of the last iteration. */
static double lone_stress(int iterations, double relaxation)
{
    double t = 1.0, b = 0.0, before = 1.0, now = 1.0;
    for (int i = 1; i < iterations; i++) {
        const double next = 0.5 * (1.0 + sqrt(1.0 + 4.0 * t * t));
        b = (t - 1.0) / next;
        t = next;
    }
    for (int i = 0; i < 200; i++) {
        const double next = (1.0 - relaxation) * (now + b * (now - before));
        before = now;
        now = next;
    }
    return fabs(now / before);
}

static void test_a_lone_solid_comes_to_rest_with_any_number_of_iterations(void)
{
    for (int iterations = 1; iterations <= 1000; iterations++) {
        const double longest = (double)dual_longest_relaxation(iterations);
        TEST_ASSERT_TRUE(longest > 1.2 && longest < 2.0);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.8, lone_stress(iterations, longest)); /* float */
    }
    TEST_ASSERT_TRUE(lone_stress(20, 1.5) > 1.0); /* the control */
}

static void test_rounds_of_solids_among_liquids(void)
{
    TEST_ASSERT_EQUAL_INT(0, rounds_wanted(0.0, 3));
    TEST_ASSERT_EQUAL_INT(0, rounds_wanted(1.44, 3));
    TEST_ASSERT_EQUAL_INT(7, rounds_wanted(16.0, 3));
    TEST_ASSERT_EQUAL_INT(2, rounds_wanted(16.0, 8));
    TEST_ASSERT_EQUAL_INT(16, rounds_wanted(1e9, 3));
    World *world = open_world(2, 0.05f);
    pbmpm_material_def body = material_defaults(), water = material_defaults();
    pbmpm_material_id solid, liquid;
    body.kind = PBMPM_ELASTIC;
    body.young_modulus = 1e9f;
    world->settings.iterations = 5;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &body, 1, &solid));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &water, 1, &liquid));
    world->particles.of_material[solid.index] = 1;
    const double alone = share_of(world, &body, 1.0 / 60);
    world->particles.of_material[liquid.index] = 1;
    NEAR(21.0 * 21.0 / 25.0 * alone, share_of(world, &body, 1.0 / 60)); /* 5 iterations and 16 rounds; steps of the guess are none */
    world->settings.pressure = PBMPM_PRESSURE_CELLS;
    NEAR(alone, share_of(world, &body, 1.0 / 60));
    memset(world->particles.of_material, 0, sizeof world->particles.of_material);
    world_destroy(world);
}

/* Blocks that solids have left are listed no longer: rounds cost what they work on. */
static void test_rounds_list_the_blocks_with_solids(void)
{
    World *world = open_world(2, 0.05f);
    pbmpm_material_def body = material_defaults(), water = material_defaults();
    pbmpm_material_id solid, liquid;
    int32_t touched[3];
    body.kind = PBMPM_ELASTIC;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &body, 1, &solid));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &water, 1, &liquid));
    world->settings.solver = world->record.solver = PBMPM_SOLVER_DUAL;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_make_room_for(world, solid.index));
    for (int solids = 2; solids >= 0; solids--) { /* of two lone particles */
        world->particles.count = 0;
        for (int i = 0; i < 2; i++) {
            NewParticle particle = {.position = {2.0 + 40.0 * i, 2.0}, .mass = 1.0f, .material = (uint16_t)(i < solids ? solid : liquid).index};
            particles_append(&world->particles, &particle, (uint32_t)i + 1);
        }
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, grid_build(&world->grid, &world->memory, &world->particles, world->pool, false));
        bind_for(world, 1.0f / 60, false);
        TEST_ASSERT_TRUE(rounds_reserve(world));
        rounds_begin(world);
        TEST_ASSERT_EQUAL_INT(solids, world->dual.rounds.solids);
        touched[solids] = world->dual.rounds.touches;
    }
    TEST_ASSERT_EQUAL_INT32(0, touched[0]);
    TEST_ASSERT_EQUAL_INT32(touched[2], 2 * touched[1]);
    world->particles.count = 0;
    memset(world->particles.of_material, 0, sizeof world->particles.of_material);
    world_destroy(world);
}

/* Of pressures all is carried where the guess corrects them, half where nothing does or liquids differ in density, a little less before a single iteration. */
static void test_what_is_carried_of_pressures(void)
{
    World *world = open_world(2, 0.05f);
    pbmpm_material_def water = material_defaults();
    pbmpm_material_id liquid, oil;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &water, 1, &liquid));
    world->settings.iterations = 5;
    world->settings.gravity[1] = -9.81f;
    TEST_ASSERT_EQUAL_DOUBLE(0.5, dual_carried_share(world)); /* nothing that has pressures */
    world->particles.of_material[liquid.index] = 1;
    TEST_ASSERT_EQUAL_DOUBLE(1.0, dual_carried_share(world));
    world->settings.pressure = PBMPM_PRESSURE_CELLS;
    TEST_ASSERT_EQUAL_DOUBLE(0.5, dual_carried_share(world));
    world->settings.pressure = PBMPM_PRESSURE_PARTICLES;
    world->settings.iterations = 3;
    TEST_ASSERT_EQUAL_DOUBLE(1.0, dual_carried_share(world));
    water.density *= 0.8f;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &water, 1, &oil));
    world->particles.of_material[oil.index] = 1;
    TEST_ASSERT_EQUAL_DOUBLE(0.5, dual_carried_share(world));
    world->particles.of_material[oil.index] = 0;
    TEST_ASSERT_EQUAL_DOUBLE(1.0, dual_carried_share(world));
    memset(world->settings.gravity, 0, sizeof world->settings.gravity);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, dual_carried_share(world)); /* free flight, few iterations */
    world->settings.iterations = 1;
    TEST_ASSERT_EQUAL_DOUBLE(0.45, dual_carried_share(world));
    memset(world->particles.of_material, 0, sizeof world->particles.of_material);
    world_destroy(world);
}

/* Solids by themselves are asked for what bears their weight with a strain of 1/20, up to 5 per iteration; never for less than is held, nor for more
 * than they have. A grid without particles counts as one cell deep. */
static void test_solids_are_asked_to_bear_their_weight(void)
{
    World *world = open_world(2, 0.05f);
    pbmpm_material_def body = material_defaults();
    pbmpm_material_id solid;
    const double dt = 1.0 / 60, weight = 4.0 * 9.81 * dt * dt / 0.05 / 0.05;
    body.kind = PBMPM_ELASTIC;
    body.young_modulus = 1e9f;
    body.poisson_ratio = 0.0f;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &body, 1, &solid));
    world->particles.of_material[solid.index] = 1;
    world->settings.iterations = 5;
    memset(world->settings.gravity, 0, sizeof world->settings.gravity);
    const double stiffness = 2.0 * twice_courant_squared(0.5e9, 1000.0, dt, 0.05), held = 4.0 / stiffness;
    NEAR(held, cap_of(world, &body, dt));
    world->settings.gravity[1] = -9.81f;
    NEAR(weight / stiffness, cap_of(world, &body, dt)); /* 4.4, and 4 are held */
    world->settings.gravity[1] = -98.1f; /* a fall of 0.5 cells */
    NEAR(12.5 / stiffness, cap_of(world, &body, dt));
    NEAR(held, share_of(world, &body, dt));
    world->settings.iterations = 1;
    NEAR(2.5 / stiffness, cap_of(world, &body, dt));
    body.young_modulus = 1e3f;
    world->settings.iterations = 5;
    TEST_ASSERT_EQUAL_DOUBLE(1.0, cap_of(world, &body, dt));
    memset(world->particles.of_material, 0, sizeof world->particles.of_material);
    world_destroy(world);
}

/* ---- Volume feedback ---- */

/* k substeps of 1/60 s / k leave as much of an error as one of 1/60 s; a longer one takes no more. */
static void test_volume_feedback_is_a_share_per_second(void)
{
    for (float share = 0.0f; share <= 1.0f; share += 0.125f)
        for (int parts = 1; parts <= 64; parts *= 4) {
            World *world = open_world(2, 0.1f);
            pbmpm_material_def def = material_defaults();
            def.volume_feedback = share;
            const double left = 1.0 - (double)bound_material(world, &def, PBMPM_SOLVER_DUAL, 1.0f / (60.0f * (float)parts))->volume_feedback;
            TEST_ASSERT_DOUBLE_WITHIN(1e-5, 1.0 - (double)share, pow(left, parts));
            bind_for(world, 0.5f, false);
            TEST_ASSERT_FLOAT_WITHIN(1e-6f, share, world->materials.kernel[0].volume_feedback);
            world_destroy(world);
        }
}

/* J of a block follows the grid by a fifth of what that of a particle does, at any rate and with every solver; other matter's does not, and none without gravity. */
static void test_volume_control_is_a_part_of_the_feedback(void)
{
    static const pbmpm_solver solvers[] = {PBMPM_SOLVER_PAPER, PBMPM_SOLVER_DUAL, PBMPM_SOLVER_PRIMAL};
    for (int i = 0; i < 3; i++) {
        World *world = open_world(2, 0.1f);
        pbmpm_material_def def = material_defaults();
        def.volume_feedback = 0.5f;
        TEST_ASSERT_EQUAL_FLOAT(0.0f, bound_material(world, &def, solvers[i], 1.0f / 60.0f)->volume_share);
        world->settings.gravity[1] = -9.81f;
        bind_for(world, 1.0f / 60.0f, false);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.1f, world->materials.kernel[0].volume_share);
        bind_for(world, 1.0f / 240.0f, false);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.2f * (1.0f - powf(0.5f, 0.25f)), world->materials.kernel[0].volume_share);
        def.kind = PBMPM_ELASTIC;
        TEST_ASSERT_EQUAL_FLOAT(0.0f, bound_material(world, &def, solvers[i], 1.0f / 60.0f)->volume_share);
        world_destroy(world);
    }
}

/* The paper's liquid is evened out in its cells where gravity could not move it: by all of the feedback's share at twice that stiffness,
 * w N dx / (g dt^2). */
static void test_stiff_liquid_is_evened_out(void)
{
    static const double stiffness[] = {275.0, 1.4e5, 2.25e5, 3.1e5, 1e9}, share[] = {0.0, 0.0, 0.05, 0.1, 0.1};
    for (int i = 0; i < 5; i++) {
        World *world = open_world(2, 1.0f);
        const pbmpm_material_def def = material_defaults();
        const double gravity = 1.5 * 20.0 * 480.0 * 480.0 / stiffness[i];
        world->settings.iterations = 20;
        world->slow_iterations = 20.0;
        world->settings.gravity[1] = (float)-gravity;
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, (float)share[i], bound_material(world, &def, PBMPM_SOLVER_PAPER, 1.0f / 480.0f)->even_share);
        world->settings.gravity[1] = 0.0f;
        bind_for(world, 1.0f / 480.0f, false);
        TEST_ASSERT_EQUAL_FLOAT(0.0f, world->materials.kernel[0].even_share);
        world_destroy(world);
    }
}

/* ---- How high matter stands ---- */

/* The depth of a column grows with it, not by the grid's blocks of 4 cells, whatever gravity's axis is, and a drop far away does not count. Within its cell a
 * particle may lie anywhere, so where a cell is half full that end errs by less than half a cell and a fiftieth; 0.1 more is for the drop, and the bins. */
static void test_the_depth_of_a_column_grows_with_it(void)
{
    for (int axis = 0; axis < 2; axis++) {
        World *world = open_world(2, 0.1f);
        const pbmpm_material_def water = material_defaults();
        pbmpm_material_id liquid;
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &water, 1, &liquid));
        world->settings.gravity[axis] = 9.81f;
        world->settings.gravity[1 - axis] = 0.0f;
        for (int rows = 14; rows <= 30; rows++) { /* two a cell */
            for (int i = 0; i < 4 * rows; i++) {
                NewParticle particle = {.mass = 1.0f, .material = liquid.index};
                particle.position[axis] = 0.75 + 0.5 * (i / 4); /* rows fill cells, but for the last if they are odd */
                particle.position[1 - axis] = 0.5 * (i % 4);
                particles_append(&world->particles, &particle, (uint32_t)i + 1);
            }
            NewParticle drop = {.mass = 1.0f, .material = liquid.index, .position = {500.0, 500.0}};
            particles_append(&world->particles, &drop, 100);
            TEST_ASSERT_EQUAL_INT(PBMPM_OK, grid_build(&world->grid, &world->memory, &world->particles, world->pool, false));
            matter_depth_find(world);
            TEST_ASSERT_DOUBLE_WITHIN(0.6 + 0.01 * rows, 0.5 * rows, matter_depth(world));
            TEST_ASSERT_DOUBLE_WITHIN(0.6 + 0.01 * rows, 0.5 * rows, liquid_depth(world));
            for (uint32_t i = 0; i < world->particles.count; i++) world->particles.status[i] = K_REMOVED;
            particles_compact(&world->particles, 0);
        }
        memset(world->particles.of_material, 0, sizeof world->particles.of_material);
        world_destroy(world);
    }
}

/* ---- Stop rules ---- */

typedef struct Rule {
    int iterations, used;
    float target, budget;
    double error;
    bool late, goes_on;
    pbmpm_stop stop;
} Rule;

static void test_stop_rules(void)
{
    static const Rule rules[] = {
        {10, 9, 0.0f, 0.0f, 0.0, true, true, PBMPM_STOP_ITERATIONS},   /* no other rule is set */
        {10, 10, 0.0f, 0.0f, 1.0, false, false, PBMPM_STOP_ITERATIONS},
        {10, 11, 0.0f, 0.0f, 1.0, false, false, PBMPM_STOP_ITERATIONS}, /* the last iteration may have been several */
        {10, 1, 0.01f, 0.0f, 0.02, false, true, PBMPM_STOP_ITERATIONS},
        {10, 1, 0.01f, 0.0f, 0.005, false, false, PBMPM_STOP_ERROR},
        {10, 1, 0.01f, 1e6f, 0.005, false, false, PBMPM_STOP_ERROR},
        {10, 1, 0.0f, 1.0f, 1.0, true, false, PBMPM_STOP_TIME},
        {10, 1, 0.01f, 1.0f, 0.02, true, false, PBMPM_STOP_TIME},
        {10, 1, 0.01f, 1.0f, 0.02, false, true, PBMPM_STOP_ITERATIONS},
        {10, 10, 0.01f, 1.0f, 0.005, true, false, PBMPM_STOP_ITERATIONS}, /* they were all done */
        {10, 1, 0.01f, 1.0f, NAN, false, true, PBMPM_STOP_ITERATIONS},
    };
    World *world = open_world(2, 0.1f);
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) {
        const Rule *rule = &rules[i];
        world->settings.iterations = rule->iterations;
        world->settings.target_error = rule->target;
        world->settings.time_budget_ms = rule->budget;
        world->record.iterations_used = (uint32_t)rule->used;
        world->record.deadline_ms = now_ms() + (rule->late ? -1.0 : 1e9);
        TEST_ASSERT_EQUAL_INT_MESSAGE(rule->goes_on, solver_may_go_on(world, rule->error), "goes on");
        TEST_ASSERT_EQUAL_INT_MESSAGE(rule->stop, world->record.stop, "what ended the iterations");
        TEST_ASSERT_EQUAL_MEMORY(&rule->error, &world->record.predicted_error, sizeof rule->error);
    }
    world_destroy(world);
}

/* ---- The error that the dual solver predicts ---- */

/* Residuals of modes with known eigenvalues, of a liquid without and with a modulus: the truth lies between the bounds whose mean is predicted. */
static void test_the_predicted_error_lies_between_its_bounds(void)
{
    Random random = {5};
    for (int i = 0; i < 1000; i++) {
        const double slowest = random_size(&random, 1e-3, 0.3), w = random_in(&random, 0.5, 1.9);
        double residual2 = 0.0, moved2 = 0.0, error2 = 0.0;
        for (int mode = 0; mode < 4; mode++) {
            const double root = slowest * (mode == 0 ? 1.0 : random_in(&random, 1.0, 1.0 / slowest)), r = random_size(&random, 1e-3, 1.0);
            residual2 += r * r;
            moved2 += root * root * r * r;
            error2 += r * r / (w * w * root * root);
        }
        DualModes modes = {.slowest = slowest, .relaxation = w, .response = slowest};
        const double residual = sqrt(residual2), most = dual_predicted_error(&modes, residual), momentum = random_in(&random, 0.0, 0.9);
        dual_find_response(&modes, residual, sqrt(moved2) / (1.0 - momentum), momentum);
        const double predicted = dual_predicted_error(&modes, residual), least = predicted * predicted / most;
        NEAR(residual2 / (w * sqrt(moved2)), least);
        TEST_ASSERT_TRUE(least <= sqrt(error2) * (1.0 + 1e-9) && sqrt(error2) <= most * (1.0 + 1e-9));
    }
}

/* All in one mode: the error is exact, with any modulus. Of a residual that moves less than in the slowest mode only what moves counts. */
static void test_the_predicted_error_of_one_mode(void)
{
    DualModes modes = {.slowest = 0.05, .relaxation = 1.5, .softness = 0.01, .response = 0.05};
    const double error = 0.05 / (1.5 * (0.05 * 0.05 + 0.01));
    NEAR(error, dual_predicted_error(&modes, 1.0));
    dual_find_response(&modes, 2.0, 2.0 * 0.05, 0.0);
    NEAR(3.0 * error, dual_predicted_error(&modes, 3.0));
    dual_find_response(&modes, 2.0, 2.0 * 0.0125, 0.0);
    NEAR(0.25 * error, dual_predicted_error(&modes, 1.0));
    dual_find_response(&modes, 2.0, 0.0, 0.0);
    TEST_ASSERT_TRUE(dual_predicted_error(&modes, 1.0) == 0.0);
    dual_find_response(&modes, 0.0, 0.0, 0.5); /* nothing is left to do */
    TEST_ASSERT_TRUE(dual_predicted_error(&modes, 0.0) == 0.0);
}

/* ---- Pressures of particles ---- */

/* They exist once asked for, start at 0, and move with their particles. */
static void test_pressures_follow_their_particles(void)
{
    World *world = open_world(3, 0.1f);
    Particles *p = &world->particles;
    const uint32_t order[] = {2, 0, 3, 1};
    for (uint32_t i = 0; i < 3; i++) particles_append(p, &(NewParticle){.mass = 1.0f}, i + 1);
    TEST_ASSERT_NULL(p->pressure);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_enable_pressure(p, &world->memory));
    const uint64_t used = world->memory.used;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_enable_pressure(p, &world->memory));
    TEST_ASSERT_EQUAL_UINT64(used, world->memory.used);
    for (uint32_t i = 0; i < 3; i++) {
        TEST_ASSERT_EQUAL_FLOAT(0.0f, p->pressure[i]);
        p->pressure[i] = (float)(i + 1);
    }
    p->pressure[3] = 77.0f; /* what an earlier particle left */
    particles_append(p, &(NewParticle){.mass = 1.0f}, 4);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, p->pressure[3]);
    Loops loops;
    loops_open(&loops, world->pool);
    particles_reorder(p, order, 0, &loops);
    loops_run(&loops);
    const float turned[] = {3.0f, 1.0f, 0.0f, 2.0f};
    TEST_ASSERT_EQUAL_FLOAT_ARRAY(turned, p->pressure, 4);
    p->status[1] = K_REMOVED;
    particles_compact(p, 0);
    const float kept[] = {3.0f, 0.0f, 2.0f};
    TEST_ASSERT_EQUAL_FLOAT_ARRAY(kept, p->pressure, 3);
    for (uint32_t i = 0; i < 12; i++) /* spare arrays do not overlap with each other or with what particles have */
        for (uint32_t k = 0; k < i; k++) {
            const float *a = particles_spare(p, i < 9 ? CLASS_MATRIX : CLASS_VECTOR, (int)(i < 9 ? i : i - 9));
            const float *b = particles_spare(p, k < 9 ? CLASS_MATRIX : CLASS_VECTOR, (int)(k < 9 ? k : k - 9));
            TEST_ASSERT_TRUE(a + 16 + K_MAX_GANG <= b || b + 16 + K_MAX_GANG <= a);
        }
    world_destroy(world);
}

/* How soft matter is: the softest of the liquids that are there, whatever else there is or could be. */
static void test_modes_are_those_of_the_liquids_there_are(void)
{
    static const float moduli[] = {1e5f, 1e6f, 1e3f, 1e4f};
    World *world = open_world(2, 0.1f);
    double softness[4];
    for (int i = 0; i < 4; i++) {
        pbmpm_material_def def = material_defaults();
        def.kind = i == 3 ? PBMPM_ELASTIC : PBMPM_LIQUID;
        def.bulk_modulus = def.young_modulus = moduli[i];
        softness[i] = (double)bound_material(world, &def, PBMPM_SOLVER_DUAL, 0.01f)->inverse_stiffness;
    }
    world->particles.of_material[0] = world->particles.of_material[1] = world->particles.of_material[3] = 5;
    TEST_ASSERT_TRUE(softness[2] > softness[0] && softness[0] > softness[1] && softness[1] > 0.0);
    TEST_ASSERT_TRUE(dual_modes_of(world, 1.5).softness == softness[0]);
    world->particles.of_material[0] = 0;
    TEST_ASSERT_TRUE(dual_modes_of(world, 1.5).softness == softness[1]);
    world->particles.of_material[2] = 1;
    TEST_ASSERT_TRUE(dual_modes_of(world, 1.5).softness == softness[2]);
    memset(world->particles.of_material, 0, sizeof world->particles.of_material);
    TEST_ASSERT_TRUE(dual_modes_of(world, 1.5).softness == 0.0);
    world_destroy(world);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_moduli_of_liquids);
    RUN_TEST(test_an_incompressible_liquid);
    RUN_TEST(test_what_yields_is_softer_to_shear);
    RUN_TEST(test_lightness);
    RUN_TEST(test_feedback_of_calm_liquid);
    RUN_TEST(test_moduli_stay_finite);
    RUN_TEST(test_moduli_of_elastic_bodies);
    RUN_TEST(test_what_the_dual_solver_holds);
    RUN_TEST(test_raised_iterations_take_effect_slowly);
    RUN_TEST(test_what_solids_are_asked_to_bear);
    RUN_TEST(test_solids_beside_sand_are_asked_for_what_is_held);
    RUN_TEST(test_what_is_asked_of_raised_iterations_grows_with_their_swing);
    RUN_TEST(test_whose_nodes_follow_at_walls);
    RUN_TEST(test_a_lone_solid_comes_to_rest_with_any_number_of_iterations);
    RUN_TEST(test_rounds_of_solids_among_liquids);
    RUN_TEST(test_rounds_list_the_blocks_with_solids);
    RUN_TEST(test_what_is_carried_of_pressures);
    RUN_TEST(test_solids_are_asked_to_bear_their_weight);
    RUN_TEST(test_volume_feedback_is_a_share_per_second);
    RUN_TEST(test_volume_control_is_a_part_of_the_feedback);
    RUN_TEST(test_stiff_liquid_is_evened_out);
    RUN_TEST(test_the_depth_of_a_column_grows_with_it);
    RUN_TEST(test_stop_rules);
    RUN_TEST(test_the_predicted_error_lies_between_its_bounds);
    RUN_TEST(test_the_predicted_error_of_one_mode);
    RUN_TEST(test_modes_are_those_of_the_liquids_there_are);
    RUN_TEST(test_pressures_follow_their_particles);
    return UNITY_END();
}
