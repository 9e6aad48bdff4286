/* Values outside their documented range in every field of every structure: refused, and nothing is changed; the ends of
 * the range are taken. */
#include <float.h>
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "calls.h"

static target good;
static snapshot before;

void setUp(void)
{
    good = target_create(NULL, NULL);
    OK(pbmpm_world_step(good.world, 0.001f));
    before = snapshot_take(good.world);
}

void tearDown(void)
{
    pbmpm_shutdown();
}

/* ---- the tables ---- */

typedef enum value_type { FLOAT32, FLOAT64, INT32, UINT32 } value_type;

/* A number field and its range. An open end is itself refused; an end of INFINITY is not tried. */
typedef struct rule {
    const char *name;
    size_t offset;
    value_type type;
    double low, high;
    bool low_open, high_open;
} rule;

static void write_value(void *structure, const rule *field, double value)
{
    unsigned char *place = (unsigned char *)structure + field->offset;
    const float single = (float)value;
    const int32_t integer = (int32_t)(value < INT32_MIN ? INT32_MIN : value > INT32_MAX ? INT32_MAX : value);
    const uint32_t whole = (uint32_t)(value < 0 ? 0 : value > UINT32_MAX ? UINT32_MAX : value);
    switch (field->type) {
    case FLOAT32: memcpy(place, &single, sizeof single); break;
    case FLOAT64: memcpy(place, &value, sizeof value); break;
    case INT32: memcpy(place, &integer, sizeof integer); break;
    case UINT32: memcpy(place, &whole, sizeof whole); break;
    }
}

static double next_below(const rule *field, double value)
{
    return field->type == FLOAT32 ? (double)nextafterf((float)value, -INFINITY) : field->type == FLOAT64 ? nextafter(value, -INFINITY) : value - 1;
}

static double next_above(const rule *field, double value)
{
    return field->type == FLOAT32 ? (double)nextafterf((float)value, INFINITY) : field->type == FLOAT64 ? nextafter(value, INFINITY) : value + 1;
}

/* How a structure is used: `structure` is a copy of a good one with one field changed. */
typedef pbmpm_result use(const void *structure);

static void expect_use(use *apply, const void *structure, const rule *field, double value, bool taken)
{
    char label[200];
    const pbmpm_result result = apply(structure);
    const bool right = taken ? result == PBMPM_OK : result == PBMPM_ERROR_INVALID_ARGUMENT || result == PBMPM_ERROR_UNSUPPORTED;
    snprintf(label, sizeof label, "%s = %.9g gave %s", field->name, value, pbmpm_result_name(result));
    TEST_ASSERT_TRUE_MESSAGE(right, label);
    if (!taken)
        snapshot_expect_same(&before, good.world, label);
}

/* Tries NaN, the infinities, the ends of the range and what lies just outside, on every field of the table. */
static void check_rules(const rule *rules, size_t count, const void *sound, size_t size, use *apply)
{
    unsigned char copy[512];
    TEST_ASSERT_TRUE(size <= sizeof copy);
    for (size_t i = 0; i < count; i++) {
        const rule *field = &rules[i];
        const bool real = field->type == FLOAT32 || field->type == FLOAT64;
        const struct {
            double value;
            bool tried, taken;
        } cases[] = {
            {NAN, real, false},
            {INFINITY, real, false},
            {-INFINITY, real, false},
            {next_below(field, field->low), isfinite(field->low), false},
            {next_above(field, field->high), isfinite(field->high), false},
            {field->low, isfinite(field->low), !field->low_open},
            {field->high, isfinite(field->high), !field->high_open},
            {INT32_MIN, field->type == INT32, false},
            {INT32_MAX, field->type == INT32, false},
            {UINT32_MAX, field->type == UINT32, false},
        };
        for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
            if (!cases[k].tried)
                continue;
            memcpy(copy, sound, size);
            write_value(copy, field, cases[k].value);
            expect_use(apply, copy, field, cases[k].value, cases[k].taken);
        }
    }
}
#define CHECK_RULES(rules, sound, apply) check_rules(rules, sizeof(rules) / sizeof *(rules), &(sound), sizeof(sound), apply)
#define FIELD(structure, member) #structure "." #member, offsetof(structure, member)

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
    const pbmpm_world_def plain = default_world(2, 0.1f, 16);
    pbmpm_world_def def = plain;
    pbmpm_world_id world;
    def.allocator.allocate = no_memory;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_create(&def, &world));
    def = plain;
    def.allocator.release = no_release;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_create(&def, &world));
    def = plain;
    def.tasks.enqueue = no_enqueue;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_create(&def, &world));
    def = plain;
    def.tasks.finish = no_finish;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_create(&def, &world));
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
    };
    const pbmpm_settings settings = default_settings();
    CHECK_RULES(rules, settings, use_settings);
}

static void test_lengths_of_step(void)
{
    static const float wrong[] = {NAN, INFINITY, -INFINITY, 0.0f, -0.0f, -0.01f, -1e-40f, 10.000001f, FLT_MAX};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step(good.world, wrong[i]));
        snapshot_expect_same(&before, good.world, "length of step");
    }
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
    };
    static const rule enums[] = {
        {FIELD(pbmpm_material_def, kind), INT32, PBMPM_LIQUID, PBMPM_ELASTIC, false, false},
        {FIELD(pbmpm_material_def, strain_policy), INT32, PBMPM_STRAIN_CLAMP, PBMPM_STRAIN_DELETE, false, false},
    };
    const pbmpm_material_def def = default_material(PBMPM_ELASTIC);
    CHECK_RULES(rules, def, use_new_material);
    CHECK_RULES(enums, def, use_new_material);
    check_rules(rules + 1, sizeof rules / sizeof *rules - 1, &def, sizeof def, use_changed_material); /* density cannot change */
}

/* ---- shapes, in all the calls that take one ---- */

static pbmpm_result use_collider_shape(const void *structure)
{
    pbmpm_collider_def def;
    pbmpm_collider_id collider;
    OK(pbmpm_collider_def_init(&def, sizeof def));
    memcpy(&def.shape, structure, sizeof def.shape);
    const pbmpm_result result = pbmpm_collider_create(good.world, &def, &collider);
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
    pbmpm_fill_def fill;
    OK(pbmpm_fill_def_init(&fill, sizeof fill));
    fill.material = good.material;
    memcpy(&fill.shape, structure, sizeof fill.shape);
    return pbmpm_particles_fill(good.world, &fill, NULL);
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
        {FIELD(pbmpm_shape, kind), INT32, PBMPM_BOX, PBMPM_CAPSULE, false, false},
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
    pbmpm_collider_id collider;
    const pbmpm_result result = pbmpm_collider_create(good.world, structure, &collider);
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
    };
    pbmpm_collider_def def;
    OK(pbmpm_collider_def_init(&def, sizeof def));
    CHECK_RULES(rules, def, use_collider);
}

static void test_poses(void)
{
    static const float wrong[] = {NAN, INFINITY, -INFINITY};
    pbmpm_collider_def old = {.size = sizeof old}, now = {.size = sizeof now};
    OK(pbmpm_collider_get(good.world, good.collider, &old));
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
    OK(pbmpm_collider_get(good.world, good.collider, &now));
    TEST_ASSERT_EQUAL_MEMORY(&old, &now, sizeof now);
    snapshot_expect_same(&before, good.world, "poses");
}

/* ---- particles ---- */

/* Adds 8 particles with one wrong number in one array. */
static void check_arrays(float wrong, uint32_t place, int which, bool refused)
{
    enum { COUNT = 8 };
    float positions[2 * COUNT], velocities[2 * COUNT], volumes[COUNT];
    float *const arrays[] = {positions, velocities, volumes};
    pbmpm_particles_def def;
    for (int i = 0; i < 2 * COUNT; i++) {
        positions[i] = 0.25f;
        velocities[i] = 0;
    }
    for (int i = 0; i < COUNT; i++)
        volumes[i] = 0.0025f;
    arrays[which][place] = wrong;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.material = good.material;
    def.count = COUNT;
    def.positions = positions;
    def.velocities = velocities;
    def.volumes = volumes;
    if (refused) {
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_add(good.world, &def, NULL));
        snapshot_expect_same(&before, good.world, "arrays");
    } else {
        OK(pbmpm_particles_add(good.world, &def, NULL));
    }
}

static void test_arrays_of_particles(void)
{
    static const float wrong[] = {NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        for (uint32_t place = 0; place < 16; place++) {
            check_arrays(wrong[i], place, 0, true);
            check_arrays(wrong[i], place, 1, true);
            check_arrays(wrong[i], place % 8, 2, true);
        }
    check_arrays(-0.0625f, 5, 0, true); /* outside the domain */
    check_arrays(2.0625f, 15, 0, true);
    check_arrays(1e30f, 3, 0, true);
    check_arrays(0.0f, 7, 2, true);
    check_arrays(-1.0f, 0, 2, true);
    check_arrays(2.0f, 15, 0, false); /* the wall itself is inside */
}

static pbmpm_result use_particles(const void *structure)
{
    static const float position[2] = {0.25f, 0.25f};
    pbmpm_particles_def def;
    pbmpm_particle_id id;
    memcpy(&def, structure, sizeof def);
    def.positions = position;
    const pbmpm_result result = pbmpm_particles_add(good.world, &def, &id);
    if (result == PBMPM_OK)
        OK(pbmpm_particles_remove(good.world, &id, 1));
    before.generation = snapshot_take(good.world).generation; /* adding and removing counts as a change */
    before.hash = world_hash(good.world);
    return result;
}

static void test_volume_of_particles(void)
{
    static const rule rules[] = {{FIELD(pbmpm_particles_def, volume), FLOAT32, 0, INFINITY, false, false}};
    pbmpm_particles_def def;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.material = good.material;
    def.count = 1;
    CHECK_RULES(rules, def, use_particles);
}

/* A count beyond all room must be refused before the arrays are read: these are far too short for it. */
static void test_counts_beyond_all_room(void)
{
    static const uint32_t counts[] = {2049, 1u << 28, (1u << 28) + 1, 1u << 30, 1u << 31, UINT32_MAX};
    const float position[2] = {0.25f, 0.25f};
    pbmpm_particles_def def;
    uint32_t row;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.material = good.material;
    def.positions = def.velocities = def.volumes = position;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        def.count = counts[i];
        EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_particles_add(good.world, &def, NULL));
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_set(good.world, PBMPM_POSITION, NULL, counts[i], position));
        snapshot_expect_same(&before, good.world, "counts");
    }
    OK(pbmpm_particles_remove(good.world, NULL, 0));
    OK(pbmpm_particles_find(good.world, NULL, 0, &row));
    OK(pbmpm_particles_set(good.world, PBMPM_VELOCITY, &good.particle, 0, position));
}

static pbmpm_result use_fill(const void *structure)
{
    const pbmpm_result result = pbmpm_particles_fill(good.world, structure, NULL);
    if (result == PBMPM_OK) { /* back to the state before */
        const pbmpm_shape corner = box_shape(0.25f, 0.25f, 0, 0.25f, 0.25f, 0.25f);
        OK(pbmpm_particles_remove_in(good.world, &corner, NULL));
    }
    before.generation = snapshot_take(good.world).generation;
    before.hash = world_hash(good.world);
    return result;
}

static void test_fills(void)
{
    static const rule rules[] = {
        {FIELD(pbmpm_fill_def, particles_per_axis), FLOAT32, 0.25, 16, false, false},
        {FIELD(pbmpm_fill_def, jitter), FLOAT32, 0, 1, false, false},
        {FIELD(pbmpm_fill_def, velocity[0]), FLOAT32, -INFINITY, INFINITY, false, false},
        {FIELD(pbmpm_fill_def, velocity[1]), FLOAT32, -INFINITY, INFINITY, false, false},
    };
    pbmpm_fill_def fill;
    OK(pbmpm_fill_def_init(&fill, sizeof fill));
    fill.material = good.material;
    fill.shape = box_shape(0.25f, 0.25f, 0, 0.1f, 0.1f, 0.1f);
    CHECK_RULES(rules, fill, use_fill);
}

/* Shapes that would need more particles than can be counted are refused at once. */
static void test_immense_fills(void)
{
    static const float sizes[] = {1e4f, 1e10f, 1e20f, 1e38f};
    for (int dimension = 2; dimension <= 3; dimension++) {
        const pbmpm_world_def def = default_world(dimension, 0.01f, 100);
        const pbmpm_world_id world = create_world(&def);
        pbmpm_fill_def fill;
        OK(pbmpm_fill_def_init(&fill, sizeof fill));
        fill.material = create_material(world, PBMPM_LIQUID);
        for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
            fill.shape = box_shape(0, 0, 0, sizes[i], sizes[i], sizes[i]);
            const pbmpm_result result = pbmpm_particles_fill(world, &fill, NULL);
            TEST_ASSERT_TRUE(result == PBMPM_ERROR_CAPACITY || result == PBMPM_ERROR_INVALID_ARGUMENT);
            TEST_ASSERT_EQUAL_UINT32(0, world_count(world));
        }
    }
}

static void test_values_of_setters(void)
{
    static const struct {
        pbmpm_field field;
        uint32_t components;
    } settable[] = {{PBMPM_POSITION, 2}, {PBMPM_VELOCITY, 2}, {PBMPM_AFFINE_VELOCITY, 4}, {PBMPM_DEFORMATION, 4}};
    static const float wrong[] = {NAN, INFINITY, -INFINITY};
    for (size_t f = 0; f < sizeof settable / sizeof *settable; f++)
        for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
            for (uint32_t c = 0; c < settable[f].components; c++) {
                float values[4] = {1, 1, 1, 1};
                values[c] = wrong[i];
                EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_set(good.world, settable[f].field, &good.particle, 1, values));
                snapshot_expect_same(&before, good.world, "setter");
            }
    const float outside[2] = {1, 2.5f}, wild[4] = {1, 2e6f, 0, 1};
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_set(good.world, PBMPM_POSITION, &good.particle, 1, outside));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_set(good.world, PBMPM_DEFORMATION, &good.particle, 1, wild));
    REFUSED(pbmpm_particles_set(good.world, PBMPM_MATERIAL, &good.particle, 1, wild));
    REFUSED(pbmpm_particles_set(good.world, PBMPM_PARTICLE, &good.particle, 1, wild));
    REFUSED(pbmpm_particles_set(good.world, PBMPM_MASS, &good.particle, 1, wild));
    REFUSED(pbmpm_particles_set(good.world, (pbmpm_field)8, &good.particle, 1, wild));
    REFUSED(pbmpm_particles_set(good.world, (pbmpm_field)-1, &good.particle, 1, wild));
    snapshot_expect_same(&before, good.world, "setters");
}

static void test_volume_ratio_setter(void)
{
    static const float wrong[] = {NAN, INFINITY, 0, -1, 0.0099f, 100.1f};
    const float position[2] = {0.25f, 0.25f}, ends[2] = {0.01f, 100};
    pbmpm_particles_def def;
    pbmpm_particle_id id;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.material = good.spare;
    def.count = 1;
    def.positions = position;
    OK(pbmpm_particles_add(good.world, &def, &id));
    before = snapshot_take(good.world);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_set(good.world, PBMPM_VOLUME_RATIO, &id, 1, &wrong[i]));
    snapshot_expect_same(&before, good.world, "volume ratio");
    OK(pbmpm_particles_set(good.world, PBMPM_VOLUME_RATIO, &id, 1, &ends[0]));
    OK(pbmpm_particles_set(good.world, PBMPM_VOLUME_RATIO, &id, 1, &ends[1]));
}

static void test_unknown_fields(void)
{
    static const int wrong[] = {8, -1, 1000, INT_MAX, INT_MIN};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        pbmpm_view view = {.size = sizeof view};
        REFUSED(pbmpm_particles_view(good.world, (pbmpm_field)wrong[i], &view));
    }
}

/* ---- values that are legal, but absurd ---- */

/* Whatever the answer, the world stays finite and no particle goes missing without being counted. */
static void survive(pbmpm_world_id world, uint32_t added, const char *label)
{
    for (int i = 0; i < 5; i++)
        OK(pbmpm_world_step(world, 0.01f));
    world_expect_finite(world, label);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(added, world_count(world) + world_stats(world).deleted_total, label);
    TEST_ASSERT_TRUE_MESSAGE(isfinite(world_stats(world).mass), label);
    OK(pbmpm_world_destroy(world));
}

static void test_absurd_but_finite_numbers(void)
{
    static const float numbers[] = {1e6f, 1e12f, 1e20f, 1e30f, FLT_MAX, -FLT_MAX, 1e-30f, 1e-44f};
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; i++)
        for (int which = 0; which < 5; which++) {
            const pbmpm_world_id world = which == 4 ? tank_2d(NULL, NULL) : block_2d(NULL, NULL);
            const uint32_t before_adding = world_count(world);
            float position[2] = {0, 0}, velocity[2] = {0, 0}, volume = 0.0025f;
            const pbmpm_shape shape = sphere_shape(which == 3 ? numbers[i] : 0, 0, 0, fabsf(numbers[i]));
            pbmpm_particles_def def;
            OK(pbmpm_particles_def_init(&def, sizeof def));
            def.material = create_material(world, PBMPM_LIQUID);
            def.count = 1;
            def.positions = position;
            def.velocities = velocity;
            def.volumes = &volume;
            position[0] = which == 0 ? numbers[i] : 0.05f;
            velocity[1] = which == 1 ? numbers[i] : 0;
            volume = which == 2 ? numbers[i] : volume;
            if (which == 3)
                create_collider(world, shape, false);
            if (which == 4)
                set_gravity(world, numbers[i], 0, 0);
            const pbmpm_result result = pbmpm_particles_add(world, &def, NULL);
            TEST_ASSERT_TRUE(result == PBMPM_OK || result == PBMPM_ERROR_INVALID_ARGUMENT);
            survive(world, before_adding + (result == PBMPM_OK), "absurd numbers");
        }
}

/* Structures full of random bits: any answer will do, but the library lives, and what it takes it can handle. */
static void test_random_bits(void)
{
    uint32_t seed = 88172645u;
    for (int round = 0; round < 3000; round++) {
        pbmpm_settings settings;
        pbmpm_material_def material;
        pbmpm_collider_def collider;
        pbmpm_material_id material_id;
        pbmpm_collider_id collider_id;
        pbmpm_world_def def;
        pbmpm_world_id world;
        uint32_t *const words[] = {(void *)&settings, (void *)&material, (void *)&collider, (void *)&def};
        const size_t sizes[] = {sizeof settings, sizeof material, sizeof collider, offsetof(pbmpm_world_def, allocator)};
        def = default_world(2, 0.1f, 64);
        for (size_t s = 0; s < 4; s++)
            for (size_t w = 0; w < sizes[s] / 4; w++)
                if (s < 3 || random_next(&seed) % 8 == 0)
                    words[s][w] = random_next(&seed);
        settings.size = sizeof settings;
        material.size = sizeof material;
        collider.size = sizeof collider;
        collider.shape.size = sizeof collider.shape;
        def.size = sizeof def;
        def.particle_capacity = def.particle_capacity % 1024;
        def.thread_count %= 4;
        if (pbmpm_world_create(&def, &world) == PBMPM_OK) {
            OK(pbmpm_world_step(world, 0.01f));
            OK(pbmpm_world_destroy(world));
        }
        pbmpm_world_set_settings(good.world, &settings);
        if (pbmpm_material_create(good.world, &material, &material_id) == PBMPM_OK)
            OK(pbmpm_material_destroy(good.world, material_id));
        if (pbmpm_collider_create(good.world, &collider, &collider_id) == PBMPM_OK)
            OK(pbmpm_collider_destroy(good.world, collider_id));
    }
    OK(pbmpm_world_set_settings(good.world, &before.settings));
    OK(pbmpm_world_step(good.world, 0.01f));
    world_expect_finite(good.world, "after random bits");
    TEST_ASSERT_EQUAL_UINT32(before.count, world_count(good.world));
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
    RUN_TEST(test_materials);
    RUN_TEST(test_shapes);
    RUN_TEST(test_shapes_of_fills);
    RUN_TEST(test_colliders);
    RUN_TEST(test_poses);
    RUN_TEST(test_arrays_of_particles);
    RUN_TEST(test_volume_of_particles);
    RUN_TEST(test_counts_beyond_all_room);
    RUN_TEST(test_fills);
    RUN_TEST(test_immense_fills);
    RUN_TEST(test_values_of_setters);
    RUN_TEST(test_volume_ratio_setter);
    RUN_TEST(test_unknown_fields);
    RUN_TEST(test_absurd_but_finite_numbers);
    RUN_TEST(test_random_bits);
    return UNITY_END();
}
