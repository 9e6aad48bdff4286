/* Values outside their documented range in every field of the structures of worlds, materials and obstacles: refused, and
 * nothing is changed; the ends of the range are taken. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "rules.h"

void setUp(void)
{
    rules_set_up();
}

void tearDown(void)
{
    pbmpm_shutdown();
}

/* ---- worlds and settings ---- */

static pbmpm_result use_world_def(const void *structure)
{
    pbmpm_world_def def;
    pbmpm_world_id world;
    memcpy(&def, structure, sizeof def);
    if (def.particle_capacity == PBMPM_MAX_PARTICLES)
        return PBMPM_OK; /* legal, but more memory than a test should take */
    const pbmpm_result result = pbmpm_world_create(&def, &world);
    if (result == PBMPM_OK)
        OK(pbmpm_world_destroy(world));
    return result;
}

static void test_world_definitions(void)
{
    static const rule rules[] = {
        {FIELD(pbmpm_world_def, dimension), INT32, 2, 3, false, false},
        {FIELD(pbmpm_world_def, cell_size), FLOAT32, (double)1e-6f, (double)1e6f, false, false},
        {FIELD(pbmpm_world_def, particle_capacity), UINT32, 1, PBMPM_MAX_PARTICLES, false, false},
        {FIELD(pbmpm_world_def, origin[0]), FLOAT64, -INFINITY, INFINITY, false, false},
        {FIELD(pbmpm_world_def, origin[1]), FLOAT64, -INFINITY, INFINITY, false, false},
        {FIELD(pbmpm_world_def, origin[2]), FLOAT64, -INFINITY, INFINITY, false, false},
        {FIELD(pbmpm_world_def, thread_count), INT32, 0, 256, false, false},
        {FIELD(pbmpm_world_def, domain_enabled), INT32, 0, 1, false, false},
    };
    const pbmpm_world_def def = default_world(3, 0.1f, 16);
    CHECK_RULES(rules, def, use_world_def);
}

static void test_definitions_of_the_domain(void)
{
    static const rule rules[] = {
        {FIELD(pbmpm_world_def, domain_min[0]), FLOAT32, -INFINITY, 1, false, false},
        {FIELD(pbmpm_world_def, domain_min[1]), FLOAT32, -INFINITY, 1, false, false},
        {FIELD(pbmpm_world_def, domain_min[2]), FLOAT32, -INFINITY, 1, false, false},
        {FIELD(pbmpm_world_def, domain_max[0]), FLOAT32, 1, INFINITY, false, false},
        {FIELD(pbmpm_world_def, domain_max[1]), FLOAT32, 1, INFINITY, false, false},
        {FIELD(pbmpm_world_def, domain_max[2]), FLOAT32, 1, INFINITY, false, false},
        {FIELD(pbmpm_world_def, domain_friction), FLOAT32, 0, INFINITY, false, false},
    };
    pbmpm_world_def def = default_world(3, 0.25f, 16); /* 4 cells of 0.25 are 1 m, exactly */
    def.domain_enabled = 1;
    for (int a = 0; a < 3; a++)
        def.domain_max[a] = 2;
    CHECK_RULES(rules, def, use_world_def);
}

static void *no_memory(size_t size, size_t alignment, void *user)
{
    (void)size, (void)alignment, (void)user;
    return NULL;
}

static void no_release(void *memory, size_t size, void *user)
{
    (void)memory, (void)size, (void)user;
}

static void *no_enqueue(pbmpm_task *task, int32_t count, void *context, void *user)
{
    (void)task, (void)count, (void)context, (void)user;
    return NULL;
}

static void no_finish(void *handle, void *user)
{
    (void)handle, (void)user;
}

static void test_half_given_callbacks(void)
{
    const pbmpm_allocator allocators[] = {
        {sizeof *allocators, no_memory, NULL, NULL}, {sizeof *allocators, NULL, no_release, NULL}, {.size = sizeof *allocators}};
    const pbmpm_task_hooks hooks[] = {
        {sizeof *hooks, 0, no_enqueue, NULL, NULL}, {sizeof *hooks, 1, NULL, no_finish, NULL}, {.size = sizeof *hooks},
        {sizeof *hooks, 2, no_enqueue, no_finish, NULL}, {sizeof *hooks, -1, no_enqueue, no_finish, NULL}};
    pbmpm_world_def def = default_world(2, 0.1f, 16);
    pbmpm_world_id world;
    for (int i = 0; i < 3; i++) {
        def.allocator = &allocators[i];
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_create(&def, &world));
    }
    def.allocator = NULL;
    for (size_t i = 0; i < sizeof hooks / sizeof *hooks; i++) {
        def.tasks = &hooks[i];
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_create(&def, &world));
    }
}

static pbmpm_result use_settings(const void *structure)
{
    const pbmpm_result result = pbmpm_world_set_settings(good.world, structure);
    if (result == PBMPM_OK)
        OK(pbmpm_world_set_settings(good.world, &before.settings));
    return result;
}

static void test_settings(void)
{
    static const rule rules[] = {
        {FIELD(pbmpm_settings, substeps), INT32, 1, PBMPM_MAX_SUBSTEPS, false, false},
        {FIELD(pbmpm_settings, iterations), INT32, 1, PBMPM_MAX_ITERATIONS, false, false},
        {FIELD(pbmpm_settings, gravity[0]), FLOAT32, -INFINITY, INFINITY, false, false},
        {FIELD(pbmpm_settings, gravity[1]), FLOAT32, -INFINITY, INFINITY, false, false},
        {FIELD(pbmpm_settings, max_displacement), FLOAT32, (double)0.1f, PBMPM_MAX_CELLS_PER_SUBSTEP, false, false},
        {FIELD(pbmpm_settings, solver), INT32, PBMPM_SOLVER_PAPER, PBMPM_SOLVER_CONVERGENT, false, false},
        {FIELD(pbmpm_settings, pressure), INT32, PBMPM_PRESSURE_PARTICLES, PBMPM_PRESSURE_CELLS, false, false},
        {FIELD(pbmpm_settings, integrator), INT32, PBMPM_INTEGRATOR_EULER, PBMPM_INTEGRATOR_BDF2, false, false},
        {FIELD(pbmpm_settings, flip), FLOAT32, 0, 1, false, false},
        {FIELD(pbmpm_settings, target_error), FLOAT32, 0, 1, false, false},
        {FIELD(pbmpm_settings, time_budget_ms), FLOAT32, 0, 1e6, false, false},
        {FIELD(pbmpm_settings, sleeping), INT32, 0, 1, false, false},
        {FIELD(pbmpm_settings, sleep_speed), FLOAT32, 0, 1e9, false, false},
        {FIELD(pbmpm_settings, sleep_time), FLOAT32, 0, 1e6, false, false},
    };
    const pbmpm_settings settings = default_settings();
    CHECK_RULES(rules, settings, use_settings);
}

static void test_lengths_of_step(void)
{
    static const float wrong[] = {NAN, INFINITY, -INFINITY, 0.0f, -0.0f, -0.01f, -1e-40f, 10.000001f, FLT_MAX};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step(good.world, wrong[i]));
        pbmpm_effective effective = {.size = sizeof effective};
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_material_effective(good.world, good.material, wrong[i], &effective));
        snapshot_expect_same(&before, good.world, "length of step");
    }
}

/* A substep lasts at least 1e-25 s, and 1e-25 s/m times the cell size. */
static void test_substeps_that_are_too_short(void)
{
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step(good.world, 0.9e-25f));
    snapshot_expect_same(&before, good.world, "short step");
    set_rate(good.world, 4, 1);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step(good.world, 3.9e-25f));
    OK(pbmpm_world_step(good.world, 4.1e-25f));
    const pbmpm_world_def def = default_world(2, 1e3f, 16);
    const pbmpm_world_id coarse = create_world(&def);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step(coarse, 0.9e-22f));
    OK(pbmpm_world_step(coarse, 1.1e-22f));
    OK(pbmpm_world_destroy(coarse));
}

/* Without one a liquid is incompressible, which the explicit solver cannot be. */
static void test_the_explicit_solver_needs_moduli(void)
{
    set_solver(good.world, PBMPM_SOLVER_EXPLICIT);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step(good.world, 1e-4f));
    pbmpm_material_def liquid = default_material(PBMPM_LIQUID);
    liquid.bulk_modulus = 1e4f;
    OK(pbmpm_material_set(good.world, good.spare, &liquid));
    OK(pbmpm_world_step(good.world, 1e-4f));
}

/* ---- materials ---- */

static pbmpm_result use_new_material(const void *structure)
{
    pbmpm_material_id material;
    const pbmpm_result result = pbmpm_material_create(good.world, structure, &material);
    if (result == PBMPM_OK)
        OK(pbmpm_material_destroy(good.world, material));
    return result;
}

static pbmpm_result use_changed_material(const void *structure)
{
    pbmpm_material_def old = {.size = sizeof old}, now = {.size = sizeof now};
    OK(pbmpm_material_get(good.world, good.material, &old));
    const pbmpm_result result = pbmpm_material_set(good.world, good.material, structure);
    OK(pbmpm_material_get(good.world, good.material, &now));
    if (result == PBMPM_OK)
        OK(pbmpm_material_set(good.world, good.material, &old));
    else
        TEST_ASSERT_EQUAL_MEMORY(&old, &now, sizeof now);
    return result;
}

static void test_unknown_kinds_of_material_are_unsupported(void)
{
    pbmpm_material_def def = default_material((pbmpm_material_kind)7);
    pbmpm_material_id material;
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_material_create(good.world, &def, &material));
    snapshot_expect_same(&before, good.world, "unknown kind");
}

static void test_materials(void)
{
    static const rule rules[] = {
        {FIELD(pbmpm_material_def, density), FLOAT32, (double)1e-3f, 1e6, false, false},
        {FIELD(pbmpm_material_def, relaxation), FLOAT32, 0, 2, true, true},
        {FIELD(pbmpm_material_def, viscosity), FLOAT32, 0, 1, false, false},
        {FIELD(pbmpm_material_def, volume_feedback), FLOAT32, 0, 1, false, false},
        {FIELD(pbmpm_material_def, elasticity_ratio), FLOAT32, 0, 1, false, false},
        {FIELD(pbmpm_material_def, strain_min), FLOAT32, (double)1e-3f, 1, false, false},
        {FIELD(pbmpm_material_def, strain_max), FLOAT32, 1, 1e4, false, false},
        {FIELD(pbmpm_material_def, condition_max), FLOAT32, 10, 1e6, false, false},
        {FIELD(pbmpm_material_def, rebound_max), FLOAT32, 0, 10, true, false},
        {FIELD(pbmpm_material_def, bulk_modulus), FLOAT32, 0, (double)1e15f, false, false},
        {FIELD(pbmpm_material_def, kinematic_viscosity), FLOAT32, 0, 1e6, false, false},
        {FIELD(pbmpm_material_def, young_modulus), FLOAT32, (double)1e-3f, (double)1e15f, false, false},
        {FIELD(pbmpm_material_def, poisson_ratio), FLOAT32, 0, (double)0.495f, false, false},
        {FIELD(pbmpm_material_def, friction_angle), FLOAT32, 0, (double)1.4f, false, false},
        {FIELD(pbmpm_material_def, cohesion), FLOAT32, 0, 0.5, false, false},
        {FIELD(pbmpm_material_def, yield_strain), FLOAT32, 0, 10, false, false},
        {FIELD(pbmpm_material_def, flow_rate), FLOAT32, 0, 1e9, false, false},
    };
    static const rule enums[] = {
        {FIELD(pbmpm_material_def, kind), INT32, PBMPM_LIQUID, PBMPM_VISCO, false, false},
        {FIELD(pbmpm_material_def, strain_policy), INT32, PBMPM_STRAIN_CLAMP, PBMPM_STRAIN_DELETE, false, false},
        {FIELD(pbmpm_material_def, volume_correction), INT32, 0, 1, false, false},
        {FIELD(pbmpm_material_def, elastic_model), INT32, PBMPM_FIXED_COROTATED, PBMPM_NEO_HOOKEAN, false, false},
    };
    const pbmpm_material_def def = default_material(PBMPM_ELASTIC);
    CHECK_RULES(rules, def, use_new_material);
    CHECK_RULES(enums, def, use_new_material);
    check_rules(rules + 1, sizeof rules / sizeof *rules - 1, &def, sizeof def, use_changed_material); /* density cannot change */
}

/* 0 stands for incompressible; between it and the least modulus there is nothing. */
static void test_a_bulk_modulus_is_none_or_large_enough(void)
{
    pbmpm_material_def def = default_material(PBMPM_LIQUID);
    pbmpm_material_id material;
    def.bulk_modulus = 0.9e-3f;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_material_create(good.world, &def, &material));
    snapshot_expect_same(&before, good.world, "small bulk modulus");
    def.bulk_modulus = 1e-3f;
    OK(pbmpm_material_create(good.world, &def, &material));
}

/* ---- shapes, in all the calls that take one ---- */

static pbmpm_result use_collider_shape(const void *structure)
{
    const pbmpm_collider_def def = default_collider();
    pbmpm_collider_id collider;
    const pbmpm_result result = pbmpm_collider_create(good.world, &def, structure, &collider);
    if (result == PBMPM_OK)
        OK(pbmpm_collider_destroy(good.world, collider));
    return result;
}

static pbmpm_result use_query_shape(const void *structure)
{
    uint32_t count;
    return pbmpm_query_shape(good.world, structure, NULL, 0, &count);
}

static pbmpm_result use_removal_shape(const void *structure)
{
    return pbmpm_particles_remove_in(good.world, structure, NULL);
}

static pbmpm_result use_fill_shape(const void *structure)
{
    const pbmpm_fill_def fill = default_fill(good.material);
    return pbmpm_particles_fill(good.world, &fill, structure, NULL);
}

static void check_shapes_with(use *apply, bool planes)
{
    static const rule poses[] = {
        {FIELD(pbmpm_shape, position[0]), FLOAT32, -INFINITY, INFINITY, false, false},
        {FIELD(pbmpm_shape, position[1]), FLOAT32, -INFINITY, INFINITY, false, false},
        {FIELD(pbmpm_shape, rotation[0]), FLOAT32, 0, 0, false, false}, /* the world is 2D */
        {FIELD(pbmpm_shape, rotation[1]), FLOAT32, 0, 0, false, false},
        {FIELD(pbmpm_shape, rotation[2]), FLOAT32, -INFINITY, INFINITY, false, false},
        {FIELD(pbmpm_shape, rotation[3]), FLOAT32, 0.5, 2, false, false},
        {FIELD(pbmpm_shape, kind), INT32, PBMPM_PLANE, PBMPM_CAPSULE, false, false},
    };
    static const rule boxes[] = {
        {FIELD(pbmpm_shape, half_extents[0]), FLOAT32, 0, INFINITY, true, false},
        {FIELD(pbmpm_shape, half_extents[1]), FLOAT32, 0, INFINITY, true, false},
    };
    static const rule balls[] = {
        {FIELD(pbmpm_shape, radius), FLOAT32, 0, INFINITY, true, false},
    };
    static const rule capsules[] = {
        {FIELD(pbmpm_shape, half_extents[0]), FLOAT32, 0, INFINITY, false, false},
        {FIELD(pbmpm_shape, radius), FLOAT32, 0, INFINITY, true, false},
    };
    static const rule normals[] = {
        {FIELD(pbmpm_shape, normal[0]), FLOAT32, -INFINITY, INFINITY, false, false},
        {FIELD(pbmpm_shape, normal[1]), FLOAT32, (double)2e-6f, INFINITY, false, false},
    };
    pbmpm_shape shape = box_shape(0.2f, 0.2f, 0, 0.05f, 0.05f, 0.05f); /* where no particle is */
    shape.radius = 0.05f;
    check_rules(poses, sizeof poses / sizeof *poses - (planes ? 0 : 1), &shape, sizeof shape, apply);
    CHECK_RULES(boxes, shape, apply);
    shape.kind = PBMPM_SPHERE;
    CHECK_RULES(balls, shape, apply);
    shape.kind = PBMPM_CAPSULE;
    CHECK_RULES(capsules, shape, apply);
    if (!planes)
        return;
    shape = plane_shape(-1, -1, 0, 0, 1, 0);
    check_rules(normals, 1, &shape, sizeof shape, apply);
    shape.normal[1] = 1e-7f;
    REFUSED(apply(&shape));
    shape.normal[1] = 1e30f;
    OK(apply(&shape));
}

static void test_shapes(void)
{
    check_shapes_with(use_collider_shape, true);
    check_shapes_with(use_query_shape, true);
    check_shapes_with(use_removal_shape, true);
}

static void test_shapes_of_fills(void)
{
    static const pbmpm_shape_kind solid[] = {PBMPM_BOX, PBMPM_SPHERE, PBMPM_CAPSULE};
    for (size_t k = 0; k < sizeof solid / sizeof *solid; k++) {
        static const float wrong[] = {NAN, INFINITY, -INFINITY, -1.0f};
        for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
            pbmpm_shape shape = sphere_shape(1, 1, 0, wrong[i]);
            shape.kind = solid[k];
            shape.half_extents[0] = wrong[i];
            REFUSED(use_fill_shape(&shape));
            snapshot_expect_same(&before, good.world, "fill");
        }
    }
    const pbmpm_shape plane = plane_shape(0, 0, 0, 0, 1, 0);
    REFUSED(use_fill_shape(&plane));
    snapshot_expect_same(&before, good.world, "fill of a plane");
}

static pbmpm_result use_collider(const void *structure)
{
    const pbmpm_shape shape = default_shape();
    pbmpm_collider_id collider;
    const pbmpm_result result = pbmpm_collider_create(good.world, structure, &shape, &collider);
    if (result == PBMPM_OK)
        OK(pbmpm_collider_destroy(good.world, collider));
    return result;
}

static void test_colliders(void)
{
    static const rule rules[] = {
        {FIELD(pbmpm_collider_def, friction_coefficient), FLOAT32, 0, 100, false, false},
        {FIELD(pbmpm_collider_def, friction), INT32, PBMPM_FRICTION_COULOMB, PBMPM_FRICTION_SLIP, false, false},
        {FIELD(pbmpm_collider_def, kinematic), INT32, 0, 1, false, false},
        {FIELD(pbmpm_collider_def, measures_impulse), INT32, 0, 1, false, false},
    };
    const pbmpm_collider_def def = default_collider();
    CHECK_RULES(rules, def, use_collider);
}

static void test_poses(void)
{
    static const float wrong[] = {NAN, INFINITY, -INFINITY};
    pbmpm_shape old = {.size = sizeof old}, now = {.size = sizeof now};
    OK(pbmpm_collider_get(good.world, good.collider, NULL, &old));
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        for (int a = 0; a < 4; a++) {
            float position[3] = {0.5f, 0.5f, 0}, rotation[4] = {0, 0, 0, 1};
            if (a < 2) {
                position[a] = wrong[i];
                EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_move(good.world, good.collider, position, NULL));
                EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_teleport(good.world, good.collider, position, NULL));
                position[a] = 0;
            }
            rotation[a] = wrong[i];
            EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_move(good.world, good.collider, position, rotation));
            EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_teleport(good.world, good.collider, position, rotation));
        }
    const float position[3] = {0.5f, 0.5f, 0}, vanishing[4] = {0, 0, 0, 0.4f}, tilted[4] = {0.6f, 0, 0, 0.8f};
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_move(good.world, good.collider, position, vanishing));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_move(good.world, good.collider, position, tilted));
    OK(pbmpm_collider_get(good.world, good.collider, NULL, &now));
    TEST_ASSERT_EQUAL_MEMORY(&old, &now, sizeof now);
    snapshot_expect_same(&before, good.world, "poses");
}

/* ---- enumerations ---- */

/* No enumeration of this version has these, whether the compiler takes it for signed or unsigned. */
static const int32_t no_value[] = {-1, INT32_MIN, INT32_MIN + 3, INT32_MAX, INT32_MAX - 1, 99, 0x10000, -2};
enum { NO_VALUES = sizeof no_value / sizeof *no_value };

static void check_field(pbmpm_field field)
{
    static const float values[1024];
    pbmpm_view view = {.size = sizeof view}, same = view;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_view(good.world, field, &view));
    TEST_ASSERT_EQUAL_MEMORY(&same, &view, sizeof view);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_set(good.world, field, &good.particle, 1, values));
    for (uint32_t count = 1; count <= 3; count++) {
        const pbmpm_field fields[3] = {count == 1 ? field : PBMPM_MASS, count == 2 ? field : PBMPM_MATERIAL, field};
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_publish(good.world, fields, count));
    }
    snapshot_expect_same(&before, good.world, "a field that is none");
}

static void test_fields_that_are_none(void)
{
    check_field((pbmpm_field)(PBMPM_USER_VALUE + 1));
    for (int i = 0; i < NO_VALUES; i++)
        check_field((pbmpm_field)no_value[i]);
    OK(pbmpm_world_step_begin(good.world, 0.001f)); /* the fields that are in view meanwhile are another list */
    for (int i = 0; i < NO_VALUES; i++) {
        pbmpm_view view = {.size = sizeof view};
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_view(good.world, (pbmpm_field)no_value[i], &view));
    }
    OK(pbmpm_world_step_end(good.world, 1));
}

static void test_names_of_values_that_are_none(void)
{
    for (int i = 0; i < NO_VALUES; i++) {
        TEST_ASSERT_EQUAL_STRING("unknown result", pbmpm_result_name((pbmpm_result)no_value[i]));
        TEST_ASSERT_EQUAL_STRING("unknown", pbmpm_isa_name((pbmpm_isa)no_value[i]));
        TEST_ASSERT_EQUAL_STRING("PBMPM_ADVICE_UNKNOWN", pbmpm_advice_name((pbmpm_advice_code)no_value[i]));
    }
}

static pbmpm_result offer_force(const pbmpm_force_def *def, const pbmpm_shape *shape)
{
    pbmpm_force_id force;
    const pbmpm_result result = pbmpm_force_create(good.world, def, shape, &force);
    if (result == PBMPM_OK)
        OK(pbmpm_force_destroy(good.world, force));
    return result;
}

static pbmpm_force_def resting_force(void)
{
    pbmpm_force_def def;
    OK(pbmpm_force_def_init(&def, sizeof def));
    def.enabled = 0; /* a change of what acts would wake */
    return def;
}

static pbmpm_result use_force(const void *structure)
{
    const pbmpm_shape shape = default_shape();
    return offer_force(structure, &shape);
}

static pbmpm_result use_force_shape(const void *structure)
{
    const pbmpm_force_def def = resting_force();
    return offer_force(&def, structure);
}

static pbmpm_result offer_emitter(const pbmpm_emitter_def *def, const pbmpm_shape *shape)
{
    pbmpm_emitter_id emitter;
    const pbmpm_result result = pbmpm_emitter_create(good.world, def, shape, &emitter);
    if (result == PBMPM_OK)
        OK(pbmpm_emitter_destroy(good.world, emitter));
    return result;
}

static pbmpm_emitter_def resting_emitter(void)
{
    pbmpm_emitter_def def;
    OK(pbmpm_emitter_def_init(&def, sizeof def));
    def.material = good.material;
    return def;
}

static pbmpm_result use_emitter(const void *structure)
{
    const pbmpm_shape shape = default_shape();
    return offer_emitter(structure, &shape);
}

static pbmpm_result use_emitter_shape(const void *structure)
{
    const pbmpm_emitter_def def = resting_emitter();
    return offer_emitter(&def, structure);
}

/* Puts each of no_value[] and the first one past the end at `offset` into a sound structure. */
static void check_enum(const void *sound, size_t size, size_t offset, int32_t last, use *apply, const char *label)
{
    unsigned char copy[512];
    OK(apply(sound));
    for (int i = -1; i < NO_VALUES; i++) {
        const int32_t value = i < 0 ? last + 1 : no_value[i];
        memcpy(copy, sound, size);
        memcpy(copy + offset, &value, sizeof value);
        REFUSED(apply(copy));
        snapshot_expect_same(&before, good.world, label);
    }
}
#define CHECK_ENUM(sound, member, last, apply) check_enum(&(sound), sizeof(sound), offsetof(__typeof__(sound), member), last, apply, #member)

static void test_enumerations_in_structures(void)
{
    const pbmpm_settings settings = default_settings();
    CHECK_ENUM(settings, solver, PBMPM_SOLVER_CONVERGENT, use_settings);
    CHECK_ENUM(settings, pressure, PBMPM_PRESSURE_CELLS, use_settings);
    CHECK_ENUM(settings, integrator, PBMPM_INTEGRATOR_BDF2, use_settings);
    const pbmpm_material_def material = default_material(PBMPM_ELASTIC);
    CHECK_ENUM(material, kind, PBMPM_VISCO, use_new_material);
    CHECK_ENUM(material, kind, PBMPM_VISCO, use_changed_material);
    CHECK_ENUM(material, strain_policy, PBMPM_STRAIN_DELETE, use_new_material);
    CHECK_ENUM(material, elastic_model, PBMPM_NEO_HOOKEAN, use_new_material);
    const pbmpm_shape shape = box_shape(0.2f, 0.2f, 0, 0.05f, 0.05f, 0.05f);
    CHECK_ENUM(shape, kind, PBMPM_BAKED, use_query_shape);
    CHECK_ENUM(shape, kind, PBMPM_BAKED, use_removal_shape);
    CHECK_ENUM(shape, kind, PBMPM_BAKED, use_collider_shape);
    CHECK_ENUM(shape, kind, PBMPM_BAKED, use_force_shape);
    CHECK_ENUM(shape, kind, PBMPM_BAKED, use_emitter_shape);
    const pbmpm_collider_def collider = default_collider();
    CHECK_ENUM(collider, friction, PBMPM_FRICTION_SLIP, use_collider);
    const pbmpm_force_def force = resting_force();
    CHECK_ENUM(force, kind, PBMPM_FORCE_GRAB, use_force);
    CHECK_ENUM(force, falloff, PBMPM_FALLOFF_INVERSE_SQUARE, use_force);
    const pbmpm_emitter_def emitter = resting_emitter();
    CHECK_ENUM(emitter, region, PBMPM_EMIT_DISC, use_emitter);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_world_definitions);
    RUN_TEST(test_definitions_of_the_domain);
    RUN_TEST(test_half_given_callbacks);
    RUN_TEST(test_settings);
    RUN_TEST(test_lengths_of_step);
    RUN_TEST(test_substeps_that_are_too_short);
    RUN_TEST(test_the_explicit_solver_needs_moduli);
    RUN_TEST(test_unknown_kinds_of_material_are_unsupported);
    RUN_TEST(test_materials);
    RUN_TEST(test_a_bulk_modulus_is_none_or_large_enough);
    RUN_TEST(test_shapes);
    RUN_TEST(test_shapes_of_fills);
    RUN_TEST(test_colliders);
    RUN_TEST(test_poses);
    RUN_TEST(test_fields_that_are_none);
    RUN_TEST(test_names_of_values_that_are_none);
    RUN_TEST(test_enumerations_in_structures);
    return UNITY_END();
}
