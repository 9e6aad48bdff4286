/* Worlds with every number drawn from the whole of its legal range: nothing may become NaN, and nobody may go missing. */
#include <math.h>
#include <stdio.h>

#include "solvers.h"

#ifdef PBMPM_SANITIZED
enum { WORLDS = 10 };
#else
enum { WORLDS = 100 };
#endif
enum { PARTICLES = 40, STEPS = 12 };

static uint32_t stream; /* of random numbers; the number of the world is its seed */

void setUp(void)
{
}

void tearDown(void)
{
}

/* Between low and high, all orders of magnitude alike. */
static float spread(double low, double high)
{
    return (float)exp((double)random_float(&stream, (float)log(low), (float)log(high)));
}

static float either_sign(float value)
{
    return random_next(&stream) & 1 ? value : -value;
}

static pbmpm_world_id random_world(const way *chosen, float *cell_size)
{
    const int32_t dimension = 2 + (int32_t)(random_next(&stream) & 1);
    pbmpm_world_def def = default_world(dimension, spread(1e-5, 1e5), 512);
    pbmpm_settings settings = default_settings();
    def.domain_enabled = (int32_t)(random_next(&stream) & 1);
    for (int a = 0; a < 3; a++) {
        def.domain_min[a] = -20 * def.cell_size;
        def.domain_max[a] = 20 * def.cell_size;
        settings.gravity[a] = either_sign(spread(1e-9, 1e8));
    }
    settings.iterations = 1 + (int32_t)(random_next(&stream) % 6);
    settings.substeps = 1 + (int32_t)(random_next(&stream) % 3);
    settings.max_displacement = spread(0.1, 64);
    settings.solver = chosen->solver;
    settings.pressure = chosen->pressure;
    settings.integrator = chosen->integrator;
    settings.flip = chosen->flip > 0 ? random_float(&stream, 0, 1) : 0;
    settings.target_error = random_next(&stream) & 1 ? spread(1e-6, 1) : 0;
    *cell_size = def.cell_size;
    const pbmpm_world_id world = create_world(&def);
    OK(pbmpm_world_set_settings(world, &settings));
    return world;
}

static pbmpm_material_id random_material(pbmpm_world_id world, pbmpm_material_kind kind, bool compressible)
{
    pbmpm_material_def def = default_material(kind);
    pbmpm_material_id material;
    def.density = spread(1e-3, 1e6);
    def.relaxation = random_float(&stream, 0.01f, 1.99f);
    def.viscosity = random_float(&stream, 0, 1);
    def.volume_feedback = random_float(&stream, 0, 1);
    def.elasticity_ratio = random_float(&stream, 0.01f, 1);
    def.strain_policy = random_next(&stream) & 1 ? PBMPM_STRAIN_DELETE : PBMPM_STRAIN_CLAMP;
    def.strain_min = spread(1e-3, 1);
    def.strain_max = spread(1, 1e4);
    def.rebound_max = spread(0.01, 10);
    def.bulk_modulus = compressible || random_next(&stream) & 1 ? spread(1e-3, 1e15) : 0;
    def.kinematic_viscosity = random_next(&stream) & 1 ? spread(1e-9, 1e6) : 0;
    def.elastic_model = random_next(&stream) & 1 ? PBMPM_NEO_HOOKEAN : PBMPM_FIXED_COROTATED;
    def.young_modulus = spread(1e-3, 1e15);
    def.poisson_ratio = random_float(&stream, 0, 0.495f);
    def.friction_angle = random_float(&stream, 0, 1.4f);
    def.cohesion = random_next(&stream) & 1 ? random_float(&stream, 0, 0.5f) : 0;
    def.volume_correction = random_next(&stream) & 1;
    def.yield_strain = random_next(&stream) & 1 ? spread(1e-6, 10) : 0;
    def.flow_rate = random_next(&stream) & 1 ? spread(1e-6, 1e9) : 0;
    OK(pbmpm_material_create(world, &def, &material));
    return material;
}

/* A clump of a few cells, with speeds up to the limit and any F. */
static void add_clump(pbmpm_world_id world, pbmpm_material_kind kind, bool compressible, float cell_size)
{
    float positions[3 * PARTICLES], velocities[3 * PARTICLES], deformations[9 * PARTICLES];
    pbmpm_particle_id ids[PARTICLES];
    pbmpm_particles_def def;
    const double fastest = random_next(&stream) & 1 ? 1e9 : 1e2;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    for (int i = 0; i < 3 * PARTICLES; i++) {
        positions[i] = cell_size * random_float(&stream, -3, 3);
        velocities[i] = either_sign(spread(1e-3, fastest));
    }
    for (int i = 0; i < 9 * PARTICLES; i++)
        deformations[i] = either_sign(spread(1e-6, 1e3));
    def.material = random_material(world, kind, compressible);
    def.count = PARTICLES;
    def.positions = positions;
    def.velocities = velocities;
    OK(pbmpm_particles_add(world, &def, ids));
    if (kind != PBMPM_LIQUID)
        OK(pbmpm_particles_set(world, PBMPM_DEFORMATION, ids, PARTICLES, deformations));
}

static void add_obstacle(pbmpm_world_id world, float cell_size, pbmpm_collider_id *collider)
{
    const float half = cell_size * random_float(&stream, 0.5f, 4), place = cell_size * random_float(&stream, -8, 8);
    const pbmpm_shape box = box_shape(place, 0, 0, half, half, half), ball = sphere_shape(place, 0, 0, half);
    *collider = create_collider(world, random_next(&stream) & 1 ? box : ball, true);
}

static void live_through(const way *chosen, uint32_t seed)
{
    char label[96];
    float cell_size;
    pbmpm_collider_id collider;
    stream = seed * 2654435761u + 1;
    const bool compressible = chosen->solver == PBMPM_SOLVER_EXPLICIT;
    snprintf(label, sizeof label, "%s, world %u", chosen->name, seed);
    const pbmpm_world_id world = random_world(chosen, &cell_size);
    add_clump(world, PBMPM_LIQUID, compressible, cell_size);
    add_clump(world, PBMPM_ELASTIC, compressible, cell_size);
    add_clump(world, random_next(&stream) & 1 ? PBMPM_SAND : PBMPM_VISCO, compressible, cell_size);
    add_obstacle(world, cell_size, &collider);
    for (int step = 0; step < STEPS; step++) {
        const float target[3] = {cell_size * random_float(&stream, -10, 10), 0, 0};
        OK(pbmpm_collider_move(world, collider, target, NULL));
        OK(pbmpm_world_step(world, spread(1e-6, 10)));
        TEST_ASSERT_EQUAL_UINT64_MESSAGE(3 * PARTICLES, world_count(world) + world_stats(world).deleted_total, label);
        TEST_ASSERT_EQUAL_UINT32_MESSAGE(0, world_events_of(world, PBMPM_EVENT_DELETED_NOT_FINITE, NULL), label);
        world_expect_finite(world, label);
    }
    OK(pbmpm_world_destroy(world));
}

static void test_any_legal_world_stays_finite(void)
{
    for (int w = 0; w < way_count; w++)
        for (uint32_t seed = 0; seed < WORLDS; seed++)
            live_through(&ways[w], seed);
}

/* In world 1251 a body with BDF2 gained energy at an obstacle and paid with its velocities: it has no torque, and was given a rotation of 0/0. */
static void test_worlds_that_once_were_lost(void)
{
    static const uint32_t seeds[] = {1251};
    for (int w = 0; w < way_count; w++)
        for (size_t s = 0; s < sizeof seeds / sizeof *seeds; s++) live_through(&ways[w], seeds[s]);
}

int main(void)
{
    UNITY_BEGIN();
    support_skip_without_isa();
    RUN_TEST(test_any_legal_world_stays_finite);
    RUN_TEST(test_worlds_that_once_were_lost);
    return UNITY_END();
}
