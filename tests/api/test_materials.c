/* Materials: each public call of material.h keeps its word. */
#include <math.h>
#include <string.h>

#include "scenes.h"

static pbmpm_world_id world;

void setUp(void)
{
    const pbmpm_world_def def = default_world(2, 0.1f, 1000);
    world = create_world(&def);
}

void tearDown(void)
{
    pbmpm_shutdown();
}

static void test_definition_has_the_documented_defaults(void)
{
    pbmpm_material_def def;
    memset(&def, 0xA5, sizeof def);
    OK(pbmpm_material_def_init(&def, sizeof def));
    TEST_ASSERT_EQUAL_UINT32(sizeof def, def.size);
    TEST_ASSERT_EQUAL_INT(PBMPM_LIQUID, def.kind);
    TEST_ASSERT_EQUAL_FLOAT(1000.0f, def.density);
    TEST_ASSERT_EQUAL_FLOAT(1.5f, def.relaxation);
    TEST_ASSERT_TRUE(def.viscosity == 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(0.1f, def.volume_feedback);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, def.elasticity_ratio);
    TEST_ASSERT_EQUAL_INT(PBMPM_STRAIN_CLAMP, def.strain_policy);
    TEST_ASSERT_EQUAL_FLOAT(0.1f, def.strain_min);
    TEST_ASSERT_EQUAL_FLOAT(20.0f, def.strain_max);
    TEST_ASSERT_EQUAL_FLOAT(1e6f, def.condition_max);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, def.rebound_max);
    TEST_ASSERT_TRUE(def.bulk_modulus == 0.0f);
    TEST_ASSERT_TRUE(def.kinematic_viscosity == 0.0f);
    TEST_ASSERT_EQUAL_INT(PBMPM_FIXED_COROTATED, def.elastic_model);
    TEST_ASSERT_EQUAL_FLOAT(1e5f, def.young_modulus);
    TEST_ASSERT_EQUAL_FLOAT(0.3f, def.poisson_ratio);
}

static void test_material_is_read_back_and_changed(void)
{
    pbmpm_material_def def = default_material(PBMPM_ELASTIC), read = default_material(PBMPM_LIQUID);
    pbmpm_material_id material;
    def.density = 2500;
    def.elasticity_ratio = 0.25f;
    OK(pbmpm_material_create(world, &def, &material));
    OK(pbmpm_material_get(world, material, &read));
    TEST_ASSERT_EQUAL_MEMORY(&def, &read, sizeof def);
    def.relaxation = 1.0f;
    def.strain_policy = PBMPM_STRAIN_DELETE;
    def.condition_max = 100;
    OK(pbmpm_material_set(world, material, &def));
    OK(pbmpm_material_get(world, material, &read));
    TEST_ASSERT_EQUAL_MEMORY(&def, &read, sizeof def);
}

static void test_kind_and_density_cannot_change(void)
{
    pbmpm_material_def def = default_material(PBMPM_LIQUID), read = def;
    pbmpm_material_id material;
    OK(pbmpm_material_create(world, &def, &material));
    def.density = 999;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_material_set(world, material, &def));
    def.density = 1000;
    def.kind = PBMPM_ELASTIC;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_material_set(world, material, &def));
    OK(pbmpm_material_get(world, material, &read));
    TEST_ASSERT_EQUAL_INT(PBMPM_LIQUID, read.kind);
    TEST_ASSERT_EQUAL_FLOAT(1000, read.density);
}

static void test_material_in_use_stays(void)
{
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    const pbmpm_shape ball = sphere_shape(0, 0, 0, 0.3f);
    fill_shape(world, water, ball, (const float[3]){0, 0, 0});
    EXPECT(PBMPM_ERROR_IN_USE, pbmpm_material_destroy(world, water));
    OK(pbmpm_world_step(world, 0.001f));
    EXPECT(PBMPM_ERROR_IN_USE, pbmpm_material_destroy(world, water));
    const pbmpm_shape all = sphere_shape(0, 0, 0, 10);
    OK(pbmpm_particles_remove_in(world, &all, NULL));
    OK(pbmpm_material_destroy(world, water));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_material_destroy(world, water));
}

static void test_identifiers_of_materials_are_never_reused(void)
{
    pbmpm_material_id last = {0, 0};
    for (int i = 0; i < 3 * PBMPM_MAX_MATERIALS; i++) {
        pbmpm_material_def read = default_material(PBMPM_LIQUID);
        const pbmpm_material_id next = create_material(world, PBMPM_LIQUID);
        TEST_ASSERT_TRUE(next.generation != last.generation);
        OK(pbmpm_material_destroy(world, next));
        EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_material_get(world, next, &read));
        last = next;
    }
}

/* ---- how stiff a material is ---- */

static pbmpm_effective effective_at(pbmpm_material_id material, float dt)
{
    pbmpm_effective effective = {.size = sizeof effective};
    OK(pbmpm_material_effective(world, material, dt, &effective));
    TEST_ASSERT_EQUAL_UINT32(sizeof effective, effective.size);
    return effective;
}

static void use_solver(pbmpm_solver solver, int substeps, int iterations)
{
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.solver = solver;
    settings.substeps = substeps;
    settings.iterations = iterations;
    OK(pbmpm_world_set_settings(world, &settings));
}

/* The laws of the header, with dx = 0.1 and a substep of 0.01 s: density w N dx^2 / (4 dt^2) = 1000 * 1.5 * 8 * 25. */
static void test_stiffness_of_the_papers_solver_follows_from_the_rate(void)
{
    pbmpm_material_def def = default_material(PBMPM_LIQUID);
    pbmpm_material_id water;
    def.viscosity = 0.5f;
    OK(pbmpm_material_create(world, &def, &water));
    const pbmpm_material_id jelly = create_material(world, PBMPM_ELASTIC);
    const float young = 1000.0f * 1.5f * 8 * 25;
    use_solver(PBMPM_SOLVER_PAPER, 2, 8);
    const pbmpm_effective liquid = effective_at(water, 0.02f), elastic = effective_at(jelly, 0.02f);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f * young, young / 2, liquid.bulk_modulus);
    TEST_ASSERT_TRUE(liquid.young_modulus == 0.0f);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 8 * 0.5f * 0.01f / (8 * 0.01f), liquid.kinematic_viscosity);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, sqrtf(young / 2 / 1000) * 0.01f / 0.1f, liquid.courant);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f * young, young, elastic.young_modulus);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f * young, young / 2, elastic.bulk_modulus);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, sqrtf(1.5f * 8) / 2, elastic.courant); /* half the root of w N cells per substep */
}

static void test_stiffness_of_the_other_solvers_is_the_materials_own(void)
{
    pbmpm_material_def water_def = default_material(PBMPM_LIQUID), jelly_def = default_material(PBMPM_ELASTIC);
    pbmpm_material_id water, jelly;
    water_def.bulk_modulus = 4e5f;
    water_def.kinematic_viscosity = 0.25f;
    jelly_def.young_modulus = 2.6e6f; /* with nu = 0.3: mu = 1 MPa, lambda = 1.5 MPa */
    OK(pbmpm_material_create(world, &water_def, &water));
    OK(pbmpm_material_create(world, &jelly_def, &jelly));
    static const pbmpm_solver solvers[] = {PBMPM_SOLVER_PRIMAL, PBMPM_SOLVER_EXPLICIT};
    for (int i = 0; i < 2; i++) {
        use_solver(solvers[i], 1, 8);
        const pbmpm_effective liquid = effective_at(water, 0.001f), elastic = effective_at(jelly, 0.001f);
        TEST_ASSERT_EQUAL_FLOAT(4e5f, liquid.bulk_modulus);
        TEST_ASSERT_EQUAL_FLOAT(0.25f, liquid.kinematic_viscosity);
        TEST_ASSERT_FLOAT_WITHIN(1e-4f, 20 * 0.001f / 0.1f, liquid.courant); /* sqrt(K / rho) = 20 m/s */
        TEST_ASSERT_EQUAL_FLOAT(2.6e6f, elastic.young_modulus);
        TEST_ASSERT_FLOAT_WITHIN(1e2f, 1.5e6f + 1e6f, elastic.bulk_modulus);              /* 2D: lambda + mu */
        TEST_ASSERT_FLOAT_WITHIN(1e-4f, sqrtf(3.5e3f) * 0.001f / 0.1f, elastic.courant); /* lambda + 2 mu */
    }
}

static void test_an_incompressible_liquid_has_no_wave(void)
{
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    use_solver(PBMPM_SOLVER_DUAL, 1, 8);
    const pbmpm_effective effective = effective_at(water, 0.01f);
    TEST_ASSERT_TRUE(effective.bulk_modulus == 0.0f && effective.courant == 0.0f && effective.young_modulus == 0.0f);
}

/* ---- what the parameters do ---- */

/* A box of one material after a step from a state of pure shear. */
static pbmpm_world_id sheared_box(pbmpm_material_def def)
{
    static float affine[4 * 1000];
    const pbmpm_world_def world_def = default_world(2, 0.1f, 1000);
    const pbmpm_world_id made = papers_world(&world_def);
    pbmpm_material_id material;
    OK(pbmpm_material_create(made, &def, &material));
    const uint32_t count = fill_shape(made, material, box_shape(0, 0, 0, 0.5f, 0.5f, 0.5f), (const float[3]){0, 0, 0});
    for (uint32_t i = 0; i < count; i++)
        affine[4 * i + 1] = affine[4 * i + 2] = 1.0f; /* pure shear */
    OK(pbmpm_particles_set(made, PBMPM_AFFINE_VELOCITY, NULL, count, affine));
    OK(pbmpm_world_step(made, 0.001f));
    return made;
}

static double mean_shear_rate(pbmpm_world_id made)
{
    const pbmpm_view affine = view_of(made, PBMPM_AFFINE_VELOCITY);
    double sum = 0;
    for (uint32_t i = 0; i < affine.count; i++)
        sum += fabs((double)view_float(&affine, i, 1) + (double)view_float(&affine, i, 2));
    return sum / affine.count;
}

static void test_viscosity_takes_shear_away(void)
{
    pbmpm_material_def thin = default_material(PBMPM_LIQUID), thick = thin;
    thick.viscosity = 0.9f;
    TEST_ASSERT_TRUE(mean_shear_rate(sheared_box(thick)) < 0.5 * mean_shear_rate(sheared_box(thin)));
}

static double squeezed_ratio_after_a_step(float relaxation)
{
    static float ratios[1000];
    const pbmpm_world_def world_def = default_world(2, 0.1f, 1000);
    const pbmpm_world_id made = papers_world(&world_def);
    pbmpm_material_def def = default_material(PBMPM_LIQUID);
    pbmpm_material_id material;
    def.relaxation = relaxation;
    OK(pbmpm_material_create(made, &def, &material));
    const uint32_t count = fill_shape(made, material, box_shape(0, 0, 0, 0.5f, 0.5f, 0.5f), (const float[3]){0, 0, 0});
    for (uint32_t i = 0; i < count; i++)
        ratios[i] = 0.95f;
    OK(pbmpm_particles_set(made, PBMPM_VOLUME_RATIO, NULL, count, ratios));
    set_rate(made, 1, 1);
    OK(pbmpm_world_step(made, 0.01f));
    const pbmpm_view ratio = view_of(made, PBMPM_VOLUME_RATIO);
    double sum = 0;
    for (uint32_t i = 0; i < ratio.count; i++)
        sum += (double)view_float(&ratio, i, 0);
    return sum / ratio.count;
}

/* Squeezed liquid swells back, and faster with more relaxation. */
static void test_relaxation_brings_the_volume_back(void)
{
    const double slow = squeezed_ratio_after_a_step(0.5f), fast = squeezed_ratio_after_a_step(1.5f);
    TEST_ASSERT_TRUE(slow > 0.9501);
    TEST_ASSERT_TRUE(fast > slow + 0.003);
    TEST_ASSERT_TRUE(fast < 1.05);
}

/* A stretched elastic particle is brought back under strain_max within one step. */
static void test_strain_is_clamped(void)
{
    pbmpm_material_def def = default_material(PBMPM_ELASTIC);
    pbmpm_material_id material;
    const float position[2] = {0, 0}, stretched[4] = {50, 0, 0, 0.5f};
    pbmpm_particles_def particles;
    pbmpm_particle_id id;
    def.strain_max = 4;
    OK(pbmpm_material_create(world, &def, &material));
    OK(pbmpm_particles_def_init(&particles, sizeof particles));
    particles.material = material;
    particles.count = 1;
    particles.positions = position;
    OK(pbmpm_particles_add(world, &particles, &id));
    OK(pbmpm_particles_set(world, PBMPM_DEFORMATION, &id, 1, stretched));
    OK(pbmpm_world_step(world, 0.001f));
    TEST_ASSERT_EQUAL_UINT32(1, world_count(world));
    const pbmpm_view deformation = view_of(world, PBMPM_DEFORMATION);
    for (uint32_t c = 0; c < 4; c++)
        TEST_ASSERT_TRUE(fabsf(view_float(&deformation, 0, c)) <= 4.001f);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_definition_has_the_documented_defaults);
    RUN_TEST(test_material_is_read_back_and_changed);
    RUN_TEST(test_kind_and_density_cannot_change);
    RUN_TEST(test_material_in_use_stays);
    RUN_TEST(test_identifiers_of_materials_are_never_reused);
    RUN_TEST(test_stiffness_of_the_papers_solver_follows_from_the_rate);
    RUN_TEST(test_stiffness_of_the_other_solvers_is_the_materials_own);
    RUN_TEST(test_an_incompressible_liquid_has_no_wave);
    RUN_TEST(test_viscosity_takes_shear_away);
    RUN_TEST(test_relaxation_brings_the_volume_back);
    RUN_TEST(test_strain_is_clamped);
    return UNITY_END();
}
