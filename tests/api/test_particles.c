/* Particles: adding, filling, removing, reading, changing, finding; each public call of particles.h keeps its word. */
#include <math.h>
#include <string.h>

#include "scenes.h"

static const float at_rest[3] = {0, 0, 0};

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

static pbmpm_world_id empty_world(int32_t dimension)
{
    const pbmpm_world_def def = default_world(dimension, 0.125f, 4096);
    return create_world(&def);
}

static pbmpm_particles_def arrays(pbmpm_material_id material, uint32_t count, const float *positions)
{
    pbmpm_particles_def def;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.material = material;
    def.count = count;
    def.positions = positions;
    return def;
}

/* ---- definitions ---- */

static void test_definitions_have_the_documented_defaults(void)
{
    pbmpm_particles_def particles;
    pbmpm_fill_def fill;
    memset(&particles, 0xA5, sizeof particles);
    memset(&fill, 0xA5, sizeof fill);
    OK(pbmpm_particles_def_init(&particles, sizeof particles));
    TEST_ASSERT_EQUAL_UINT32(sizeof particles, particles.size);
    TEST_ASSERT_EQUAL_UINT32(0, particles.count);
    TEST_ASSERT_TRUE(particles.material.index == 0 && particles.material.generation == 0);
    TEST_ASSERT_TRUE(!particles.positions && !particles.velocities && !particles.volumes);
    TEST_ASSERT_TRUE(particles.volume == 0.0f);
    OK(pbmpm_fill_def_init(&fill, sizeof fill));
    TEST_ASSERT_EQUAL_UINT32(sizeof fill, fill.size);
    TEST_ASSERT_EQUAL_UINT32(1, fill.seed);
    TEST_ASSERT_TRUE(fill.material.index == 0 && fill.material.generation == 0);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, fill.particles_per_axis);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, fill.jitter);
    for (int a = 0; a < 3; a++)
        TEST_ASSERT_TRUE(fill.velocity[a] == 0.0f);
}

/* ---- adding ---- */

static void check_added(int32_t dimension)
{
    enum { COUNT = 5 };
    const uint32_t d = (uint32_t)dimension;
    const pbmpm_world_id world = empty_world(dimension);
    pbmpm_material_def liquid = default_material(PBMPM_LIQUID);
    pbmpm_material_id material;
    float positions[COUNT * 3], velocities[COUNT * 3], volumes[COUNT];
    pbmpm_particle_id ids[COUNT];
    uint32_t rows[COUNT];
    liquid.density = 500;
    OK(pbmpm_material_create(world, &liquid, &material));
    for (uint32_t i = 0; i < COUNT * d; i++) {
        positions[i] = 0.3f * (float)i - 1.0f;
        velocities[i] = 0.125f * (float)i;
    }
    for (uint32_t i = 0; i < COUNT; i++)
        volumes[i] = 0.01f * (float)(i + 1);
    pbmpm_particles_def def = arrays(material, COUNT, positions);
    def.velocities = velocities;
    def.volumes = volumes;
    OK(pbmpm_particles_add(world, &def, ids));
    TEST_ASSERT_EQUAL_UINT32(COUNT, world_count(world));
    OK(pbmpm_particles_find(world, ids, COUNT, rows));
    const pbmpm_view position = view_of(world, PBMPM_POSITION), velocity = view_of(world, PBMPM_VELOCITY);
    const pbmpm_view mass = view_of(world, PBMPM_MASS), kind = view_of(world, PBMPM_MATERIAL);
    const pbmpm_view ratio = view_of(world, PBMPM_VOLUME_RATIO), affine = view_of(world, PBMPM_AFFINE_VELOCITY);
    TEST_ASSERT_EQUAL_UINT32(d, position.components);
    TEST_ASSERT_EQUAL_UINT32(d, velocity.components);
    TEST_ASSERT_EQUAL_UINT32(d * d, affine.components);
    for (uint32_t i = 0; i < COUNT; i++) {
        for (uint32_t a = 0; a < d; a++) {
            TEST_ASSERT_FLOAT_WITHIN(1e-6f, positions[i * d + a], view_float(&position, rows[i], a));
            TEST_ASSERT_EQUAL_FLOAT(velocities[i * d + a], view_float(&velocity, rows[i], a));
        }
        for (uint32_t c = 0; c < d * d; c++)
            TEST_ASSERT_TRUE(view_float(&affine, rows[i], c) == 0.0f);
        TEST_ASSERT_EQUAL_FLOAT(500 * volumes[i], view_float(&mass, rows[i], 0));
        TEST_ASSERT_TRUE(view_float(&ratio, rows[i], 0) == 1.0f);
        TEST_ASSERT_EQUAL_UINT32(material.index, view_uint(&kind, rows[i], 0));
    }
}

static void test_arrays_arrive_in_2d(void)
{
    check_added(2);
}

static void test_arrays_arrive_in_3d(void)
{
    check_added(3);
}

static void test_default_volume_is_half_a_cell_per_axis(void)
{
    const pbmpm_world_id world = empty_world(3);
    const float position[3] = {0, 0, 0};
    const pbmpm_particles_def def = arrays(create_material(world, PBMPM_LIQUID), 1, position);
    OK(pbmpm_particles_add(world, &def, NULL));
    const pbmpm_view mass = view_of(world, PBMPM_MASS), velocity = view_of(world, PBMPM_VELOCITY);
    TEST_ASSERT_EQUAL_FLOAT(1000.0f * 0.0625f * 0.0625f * 0.0625f, view_float(&mass, 0, 0));
    for (uint32_t a = 0; a < 3; a++)
        TEST_ASSERT_TRUE(view_float(&velocity, 0, a) == 0.0f);
}

/* ---- filling ---- */

static void check_fill(pbmpm_shape shape, double volume, int32_t dimension)
{
    const pbmpm_world_id world = empty_world(dimension);
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    const uint32_t added = fill_shape(world, water, shape, (const float[3]){1, 2, 3});
    const double per_cell = dimension == 2 ? 4 : 8;
    const double expected = per_cell * volume / pow(0.125, dimension);
    uint32_t inside = 0;
    TEST_ASSERT_EQUAL_UINT32(added, world_count(world));
    TEST_ASSERT_DOUBLE_WITHIN(0.1 * expected, expected, (double)added);
    OK(pbmpm_query_shape(world, &shape, NULL, 0, &inside));
    TEST_ASSERT_UINT32_WITHIN(added / 20, added, inside); /* jitter may carry a few over the surface */
    OK(pbmpm_world_step(world, 1e-6f));
    TEST_ASSERT_DOUBLE_WITHIN(0.1 * 1000 * volume, 1000 * volume, world_stats(world).mass);
    const pbmpm_view velocity = view_of(world, PBMPM_VELOCITY);
    for (uint32_t a = 0; a < (uint32_t)dimension; a++)
        TEST_ASSERT_FLOAT_WITHIN(1e-4f, (float)(a + 1), view_float(&velocity, added / 2, a));
}

static void test_fill_covers_each_shape(void)
{
    const double pi = 3.14159265358979;
    pbmpm_shape capsule = sphere_shape(0.1f, 0.2f, 0.3f, 0.3f);
    capsule.kind = PBMPM_CAPSULE;
    capsule.half_extents[0] = 0.4f;
    pbmpm_shape turned = box_shape(0, 0, 0, 0.5f, 0.25f, 0.4f);
    turned.rotation[2] = 0.38268343f;
    turned.rotation[3] = 0.92387953f;
    check_fill(box_shape(0.5f, 0.5f, 0, 0.5f, 0.5f, 0.5f), 1.0, 2);
    check_fill(box_shape(0.25f, 0.25f, 0.25f, 0.25f, 0.5f, 0.25f), 0.25, 3);
    check_fill(turned, 0.5, 2);
    check_fill(turned, 0.4, 3);
    check_fill(sphere_shape(1, 2, 3, 0.5f), pi * 0.25, 2);
    check_fill(sphere_shape(1, 2, 3, 0.5f), pi / 6, 3);
    check_fill(capsule, pi * 0.09 + 0.8 * 0.6, 2);
    check_fill(capsule, pi * 0.036 + 0.8 * pi * 0.09, 3);
}

static void test_fill_depends_on_its_seed_only(void)
{
    const pbmpm_shape shape = default_shape();
    pbmpm_world_id worlds[3];
    uint64_t hashes[3];
    for (int i = 0; i < 3; i++) {
        worlds[i] = empty_world(2);
        pbmpm_fill_def fill = default_fill(create_material(worlds[i], PBMPM_LIQUID));
        fill.seed = i == 2 ? 7 : 3;
        OK(pbmpm_particles_fill(worlds[i], &fill, &shape, NULL));
        hashes[i] = world_hash(worlds[i]);
    }
    TEST_ASSERT_EQUAL_HEX64(hashes[0], hashes[1]);
    TEST_ASSERT_TRUE(hashes[0] != hashes[2]);
}

static void test_fill_without_jitter_is_a_lattice(void)
{
    const pbmpm_world_id world = empty_world(2);
    const pbmpm_shape shape = default_shape();
    pbmpm_fill_def fill = default_fill(create_material(world, PBMPM_LIQUID));
    uint32_t added = 0;
    fill.particles_per_axis = 4;
    fill.jitter = 0;
    OK(pbmpm_particles_fill(world, &fill, &shape, &added));
    TEST_ASSERT_EQUAL_UINT32(32 * 32, added);
    const pbmpm_view position = view_of(world, PBMPM_POSITION);
    const float spacing = 0.125f / 4, phase = fmodf(view_float(&position, 0, 0) + 100, spacing);
    for (uint32_t i = 0; i < added; i++) {
        const float offset = fmodf(view_float(&position, i, 0) + 100 - phase + spacing / 2, spacing);
        TEST_ASSERT_FLOAT_WITHIN(1e-4f, spacing / 2, offset);
    }
}

static void test_fill_leaves_out_what_lies_outside_the_domain(void)
{
    pbmpm_world_def def = default_world(2, 0.125f, 4096);
    def.domain_enabled = 1;
    const pbmpm_world_id world = create_world(&def);
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    const uint32_t added = fill_shape(world, water, box_shape(0, 0, 0, 0.5f, 0.5f, 0.5f), at_rest);
    TEST_ASSERT_UINT32_WITHIN(8, 64, added);
    const pbmpm_view position = view_of(world, PBMPM_POSITION);
    for (uint32_t i = 0; i < added; i++)
        for (uint32_t a = 0; a < 2; a++)
            TEST_ASSERT_TRUE(view_float(&position, i, a) >= 0.0f && view_float(&position, i, a) <= 1.0f);
}

/* As a stranger fills a pool: over what stands in it. */
static void test_fill_leaves_out_what_lies_in_obstacles(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        const pbmpm_world_id world = empty_world(dimension);
        const float spacing = 0.125f / 2, half = 4 * spacing;
        pbmpm_fill_def fill = default_fill(create_material(world, PBMPM_LIQUID));
        pbmpm_shape shape = box_shape(0, 0, 0, 2 * half, 2 * half, 2 * half);
        uint32_t added = 0;
        create_collider(world, box_shape(0, 0, 0, half, half, half), true);
        fill.jitter = 0;
        OK(pbmpm_particles_fill(world, &fill, &shape, &added));
        TEST_ASSERT_EQUAL_UINT32(dimension == 3 ? 16 * 16 * 16 - 8 * 8 * 8 : 16 * 16 - 8 * 8, added);
        shape = box_shape(0, 0, 0, 0.5f * half, 0.5f * half, 0.5f * half);
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_fill(world, &fill, &shape, &added));
        TEST_ASSERT_EQUAL_UINT32(0, added);
    }
}

/* ---- removing ---- */

static void test_remove_by_identifier(void)
{
    const pbmpm_world_id world = empty_world(2);
    const float positions[] = {0, 0, 1, 0, 2, 0, 3, 0};
    pbmpm_particle_id ids[4];
    uint32_t row;
    const pbmpm_particles_def def = arrays(create_material(world, PBMPM_LIQUID), 4, positions);
    OK(pbmpm_particles_add(world, &def, ids));
    const pbmpm_particle_id gone[2] = {ids[2], ids[0]};
    OK(pbmpm_particles_remove(world, gone, 2));
    TEST_ASSERT_EQUAL_UINT32(2, world_count(world));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_particles_find(world, &ids[0], 1, &row));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_particles_find(world, &ids[2], 1, &row));
    OK(pbmpm_particles_find(world, &ids[3], 1, &row));
    const pbmpm_view position = view_of(world, PBMPM_POSITION);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 3.0f, view_float(&position, row, 0));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_particles_remove(world, (const pbmpm_particle_id[2]){ids[1], ids[0]}, 2));
    TEST_ASSERT_EQUAL_UINT32(2, world_count(world));
}

static void test_remove_in_a_shape(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_shape ball = sphere_shape(0.5f, 0.25f, 0, 0.2f);
    const uint32_t before = world_count(world);
    uint32_t inside = 0, removed = 0;
    OK(pbmpm_query_shape(world, &ball, NULL, 0, &inside));
    TEST_ASSERT_TRUE(inside > 0 && inside < before);
    OK(pbmpm_particles_remove_in(world, &ball, &removed));
    TEST_ASSERT_EQUAL_UINT32(inside, removed);
    TEST_ASSERT_EQUAL_UINT32(before - removed, world_count(world));
    OK(pbmpm_query_shape(world, &ball, NULL, 0, &inside));
    TEST_ASSERT_EQUAL_UINT32(0, inside);
    const pbmpm_shape below = plane_shape(0, 0.25f, 0, 0, 1, 0);
    OK(pbmpm_particles_remove_in(world, &below, &removed));
    const pbmpm_view position = view_of(world, PBMPM_POSITION);
    for (uint32_t i = 0; i < position.count; i++)
        TEST_ASSERT_TRUE(view_float(&position, i, 1) >= 0.25f);
    TEST_ASSERT_EQUAL_UINT64(0, world_stats(world).deleted_total); /* calls are not counted as deletions */
}

/* ---- views ---- */

/* Row i of every view is the same particle, through steps that reorder and removals: a mass of its own marks each. */
static void test_views_keep_to_one_order(void)
{
    enum { COUNT = 64 };
    const pbmpm_world_id world = empty_world(2);
    const pbmpm_shape corner = sphere_shape(0, 0, 0, 0.2f);
    float positions[2 * COUNT], volumes[COUNT];
    pbmpm_particle_id ids[COUNT];
    uint32_t seed = 11;
    for (int i = 0; i < COUNT; i++) {
        positions[2 * i] = random_float(&seed, 0, 1);
        positions[2 * i + 1] = random_float(&seed, 0, 1);
        volumes[i] = 0.004f + 0.0001f * (float)i;
    }
    pbmpm_particles_def def = arrays(create_material(world, PBMPM_LIQUID), COUNT, positions);
    def.volumes = volumes;
    OK(pbmpm_particles_add(world, &def, ids));
    for (int i = 0; i < 20; i++)
        OK(pbmpm_world_step(world, 0.02f));
    OK(pbmpm_particles_remove_in(world, &corner, NULL));
    const pbmpm_view identity = view_of(world, PBMPM_PARTICLE), mass = view_of(world, PBMPM_MASS);
    TEST_ASSERT_EQUAL_UINT32(2, identity.components);
    for (uint32_t row = 0; row < identity.count; row++) {
        uint32_t which = 0, found = UINT32_MAX;
        while (which < COUNT && (ids[which].index != view_uint(&identity, row, 0) || ids[which].generation != view_uint(&identity, row, 1)))
            which++;
        TEST_ASSERT_TRUE(which < COUNT);
        OK(pbmpm_particles_find(world, &ids[which], 1, &found));
        TEST_ASSERT_EQUAL_UINT32(row, found);
        TEST_ASSERT_EQUAL_FLOAT(1000 * volumes[which], view_float(&mass, row, 0));
    }
}

static void test_deformation_needs_an_elastic_particle(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    pbmpm_view view = {.size = sizeof view};
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_particles_view(world, PBMPM_DEFORMATION, &view));
    const float place[2] = {1, 1};
    pbmpm_particles_def jelly;
    OK(pbmpm_particles_def_init(&jelly, sizeof jelly));
    jelly.material = create_material(world, PBMPM_ELASTIC);
    OK(pbmpm_particles_add(world, &jelly, NULL)); /* none */
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_particles_view(world, PBMPM_DEFORMATION, &view));
    jelly.count = 1;
    jelly.positions = place;
    OK(pbmpm_particles_add(world, &jelly, NULL));
    OK(pbmpm_world_step(world, 0.01f));
    view = view_of(world, PBMPM_DEFORMATION);
    TEST_ASSERT_EQUAL_UINT32(world_count(world), view.count);
    TEST_ASSERT_EQUAL_UINT32(4, view.components);
    static const float identity[4] = {1, 0, 0, 1};
    const pbmpm_view material = view_of(world, PBMPM_MATERIAL);
    for (uint32_t i = 0; i < view.count; i++)
        for (uint32_t c = 0; c < 4 && view_uint(&material, i, 0) != jelly.material.index; c++)
            TEST_ASSERT_TRUE(view_float(&view, i, c) == identity[c]);
}

static void test_every_change_expires_views(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_shape ball = sphere_shape(0.5f, 0.25f, 0, 0.1f);
    const float position[2] = {0.5f, 0.9f}, velocity[2] = {0, 1};
    pbmpm_view view = view_of(world, PBMPM_MATERIAL);
    pbmpm_particle_id id;
    uint64_t generation;
#define EXPECT_EXPIRED()                                                                                                                     \
    do {                                                                                                                                     \
        OK(pbmpm_world_generation(world, &generation));                                                                                      \
        TEST_ASSERT_TRUE(generation != view.generation);                                                                                     \
        view = view_of(world, PBMPM_MATERIAL);                                                                                               \
        TEST_ASSERT_EQUAL_UINT64(generation, view.generation);                                                                               \
    } while (0)
    const pbmpm_particles_def def = arrays(create_material(world, PBMPM_LIQUID), 1, position);
    OK(pbmpm_particles_add(world, &def, &id));
    EXPECT_EXPIRED();
    OK(pbmpm_particles_set(world, PBMPM_VELOCITY, &id, 1, velocity));
    EXPECT_EXPIRED();
    OK(pbmpm_particles_remove(world, &id, 1));
    EXPECT_EXPIRED();
    OK(pbmpm_particles_remove_in(world, &ball, NULL));
    EXPECT_EXPIRED();
    OK(pbmpm_world_step(world, 0.001f));
    EXPECT_EXPIRED();
#undef EXPECT_EXPIRED
}

/* ---- setters ---- */

static void check_set(pbmpm_world_id world, pbmpm_field field, pbmpm_particle_id id, uint32_t components, const float *values)
{
    uint32_t row;
    OK(pbmpm_particles_set(world, field, &id, 1, values));
    OK(pbmpm_particles_find(world, &id, 1, &row));
    const pbmpm_view view = view_of(world, field);
    TEST_ASSERT_EQUAL_UINT32(components, view.components);
    for (uint32_t c = 0; c < components; c++)
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, values[c], view_float(&view, row, c));
}

static void check_setters(int32_t dimension)
{
    const uint32_t d = (uint32_t)dimension;
    const pbmpm_world_id world = empty_world(dimension);
    const float positions[6] = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f};
    const float values[9] = {0.7f, 0.1f, -0.2f, 0.3f, 1.25f, 0.5f, -0.125f, 0.0625f, 1.5f};
    pbmpm_particle_id wet[2], firm[2];
    const pbmpm_particles_def liquid = arrays(create_material(world, PBMPM_LIQUID), 2, positions);
    const pbmpm_particles_def elastic = arrays(create_material(world, PBMPM_ELASTIC), 2, positions);
    OK(pbmpm_particles_add(world, &liquid, wet));
    OK(pbmpm_particles_add(world, &elastic, firm));
    for (int i = 0; i < 2; i++) {
        check_set(world, PBMPM_POSITION, wet[i], d, values);
        check_set(world, PBMPM_VELOCITY, firm[i], d, values);
        check_set(world, PBMPM_AFFINE_VELOCITY, wet[i], d * d, values);
        check_set(world, PBMPM_VOLUME_RATIO, wet[i], 1, values);
        check_set(world, PBMPM_DEFORMATION, firm[i], d * d, values);
    }
    REFUSED(pbmpm_particles_set(world, PBMPM_VOLUME_RATIO, firm, 1, values));
    REFUSED(pbmpm_particles_set(world, PBMPM_DEFORMATION, wet, 1, values));
}

static void test_settable_fields_in_2d(void)
{
    check_setters(2);
}

static void test_settable_fields_in_3d(void)
{
    check_setters(3);
}

static void test_set_all_in_storage_order(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    static float values[2 * 4096];
    OK(pbmpm_world_step(world, 0.01f));
    const uint32_t count = world_count(world);
    for (uint32_t i = 0; i < 2 * count; i++)
        values[i] = (float)i;
    OK(pbmpm_particles_set(world, PBMPM_VELOCITY, NULL, count, values));
    const pbmpm_view view = view_of(world, PBMPM_VELOCITY);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t a = 0; a < 2; a++)
            TEST_ASSERT_TRUE(view_float(&view, i, a) == values[2 * i + a]);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_particles_set(world, PBMPM_VELOCITY, NULL, count - 1, values));
}

/* ---- finding ---- */

static void test_query_reports_the_full_number(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_shape ball = sphere_shape(0.5f, 0.25f, 0, 0.2f);
    const pbmpm_particle_id untouched = {0xABCDEF, 0xFEDCBA};
    pbmpm_particle_id some[8], all[4096];
    uint32_t full = 0, count = 0, rows[4096];
    OK(pbmpm_query_shape(world, &ball, NULL, 0, &full));
    TEST_ASSERT_TRUE(full > 7);
    some[7] = untouched;
    OK(pbmpm_query_shape(world, &ball, some, 7, &count));
    TEST_ASSERT_EQUAL_UINT32(full, count);
    TEST_ASSERT_EQUAL_MEMORY(&untouched, &some[7], sizeof untouched);
    OK(pbmpm_query_shape(world, &ball, all, 4096, &count));
    TEST_ASSERT_EQUAL_UINT32(full, count);
    TEST_ASSERT_EQUAL_MEMORY(all, some, 7 * sizeof *some);
    OK(pbmpm_particles_find(world, all, full, rows));
    const pbmpm_view position = view_of(world, PBMPM_POSITION);
    uint32_t inside = 0;
    for (uint32_t i = 0; i < position.count; i++)
        inside += hypotf(view_float(&position, i, 0) - 0.5f, view_float(&position, i, 1) - 0.25f) < 0.2f;
    TEST_ASSERT_UINT32_WITHIN(2, inside, full); /* a particle on the edge may fall to either side */
    for (uint32_t i = 0; i < full; i++) {
        TEST_ASSERT_TRUE(i == 0 || rows[i - 1] < rows[i]); /* storage order */
        const float x = view_float(&position, rows[i], 0) - 0.5f, y = view_float(&position, rows[i], 1) - 0.25f;
        TEST_ASSERT_TRUE(hypotf(x, y) < 0.2001f);
    }
}

/* Identifiers stay with their particles while steps reorder the storage. */
static void test_identifiers_survive_steps(void)
{
    const pbmpm_world_id world = empty_world(2);
    float positions[64 * 2], velocities[64 * 2];
    pbmpm_particle_id ids[64];
    uint32_t rows[64], seed = 5;
    for (int i = 0; i < 64; i++) { /* far apart, so that each flies on its own */
        positions[2 * i] = (float)(i % 8) * 4;
        positions[2 * i + 1] = (float)(i / 8) * 4;
        velocities[2 * i] = random_float(&seed, -1, 1);
        velocities[2 * i + 1] = random_float(&seed, -1, 1);
    }
    pbmpm_particles_def def = arrays(create_material(world, PBMPM_LIQUID), 64, positions);
    def.velocities = velocities;
    OK(pbmpm_particles_add(world, &def, ids));
    for (int i = 0; i < 50; i++)
        OK(pbmpm_world_step(world, 0.02f));
    OK(pbmpm_particles_find(world, ids, 64, rows));
    const pbmpm_view position = view_of(world, PBMPM_POSITION);
    for (int i = 0; i < 64; i++)
        for (uint32_t a = 0; a < 2; a++)
            TEST_ASSERT_FLOAT_WITHIN(2e-3f, positions[2 * i + (int)a] + velocities[2 * i + (int)a],
                                     view_float(&position, rows[i], a));
}

/* ---- user values ---- */

static uint32_t user_value_of(pbmpm_world_id world, pbmpm_particle_id id)
{
    uint32_t row;
    OK(pbmpm_particles_find(world, &id, 1, &row));
    const pbmpm_view view = view_of(world, PBMPM_USER_VALUE);
    return view_uint(&view, row, 0);
}

static void test_user_values_go_with_their_particles(void)
{
    enum { COUNT = 64 };
    float positions[2 * COUNT];
    uint32_t values[COUNT], seed = 3;
    pbmpm_particle_id ids[COUNT];
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    for (int i = 0; i < COUNT; i++) {
        positions[2 * i] = random_float(&seed, 0.1f, 0.9f);
        positions[2 * i + 1] = random_float(&seed, 0.6f, 0.9f);
        values[i] = random_next(&seed);
    }
    pbmpm_particles_def def = arrays(create_material(world, PBMPM_LIQUID), COUNT, positions);
    def.user_values = values;
    OK(pbmpm_particles_add(world, &def, ids));
    const pbmpm_view view = view_of(world, PBMPM_USER_VALUE);
    for (uint32_t row = 0; row < view.count - COUNT; row++) TEST_ASSERT_EQUAL_UINT32(0, view_uint(&view, row, 0)); /* those of before */
    for (int i = 0; i < 60; i++) OK(pbmpm_world_step(world, 1.0f / 60));
    OK(pbmpm_particles_remove(world, ids, 1));
    for (int i = 1; i < COUNT; i++) TEST_ASSERT_EQUAL_UINT32(values[i], user_value_of(world, ids[i]));
}

static uint64_t held(pbmpm_world_id world) { return world_stats(world).memory_bytes; }

static void test_user_values_cost_nothing_until_there_is_one(void)
{
    const pbmpm_world_id world = block_2d(NULL, NULL);
    const uint64_t bytes = held(world), hash = world_hash(world);
    pbmpm_view view = {.size = sizeof view};
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_particles_view(world, PBMPM_USER_VALUE, &view));
    const pbmpm_view ids = view_of(world, PBMPM_PARTICLE);
    const uint32_t nine = 9;
    OK(pbmpm_particles_set(world, PBMPM_USER_VALUE, ids.data, 1, &nine));
    TEST_ASSERT_TRUE(held(world) > bytes);
    TEST_ASSERT_EQUAL_HEX64(hash, world_hash(world)); /* the simulation knows nothing of it */
}

static void test_fills_and_emitters_give_user_values(void)
{
    const pbmpm_world_id world = empty_world(2);
    pbmpm_fill_def fill = default_fill(create_material(world, PBMPM_LIQUID));
    const pbmpm_shape left = box_shape(-2, 0, 0, 0.5f, 0.5f, 0), right = box_shape(2, 0, 0, 0.5f, 0.5f, 0);
    pbmpm_emitter_def tap;
    pbmpm_emitter_id emitter;
    fill.user_value = 0xC0FFEEu;
    OK(pbmpm_particles_fill(world, &fill, &left, NULL));
    OK(pbmpm_emitter_def_init(&tap, sizeof tap));
    tap.material = fill.material;
    tap.rate = 1.0f;
    tap.user_value = 5;
    OK(pbmpm_emitter_create(world, &tap, &right, &emitter));
    for (int i = 0; i < 20; i++) OK(pbmpm_world_step(world, 0.01f));
    const pbmpm_view position = view_of(world, PBMPM_POSITION), value = view_of(world, PBMPM_USER_VALUE);
    uint32_t born = 0;
    for (uint32_t row = 0; row < value.count; row++) {
        const bool emitted = view_float(&position, row, 0) > 0.0f;
        TEST_ASSERT_EQUAL_UINT32(emitted ? 5 : 0xC0FFEEu, view_uint(&value, row, 0));
        born += emitted;
    }
    TEST_ASSERT_TRUE(born > 20);
}

static void test_user_values_are_saved(void)
{
    static char saved[1 << 18];
    const pbmpm_world_id world = block_2d(NULL, NULL), other = block_2d(NULL, NULL);
    uint32_t values[256];
    uint64_t bytes;
    for (uint32_t i = 0; i < 256; i++) values[i] = i * 0x01010101u; /* some are no finite floats */
    OK(pbmpm_particles_set(world, PBMPM_USER_VALUE, NULL, 256, values));
    OK(pbmpm_snapshot_save(world, saved, sizeof saved, &bytes));
    OK(pbmpm_snapshot_restore(other, saved, bytes, 0));
    const pbmpm_view view = view_of(other, PBMPM_USER_VALUE);
    for (uint32_t i = 0; i < 256; i++) TEST_ASSERT_EQUAL_UINT32(values[i], view_uint(&view, i, 0));
}

/* ---- expired views ---- */

/* What a field's values are, or were, in a world where no two fields have values alike. A world's memory begins cleared, and ends of arrays are. */
typedef struct kept_view {
    pbmpm_field field;
    float low[3], high[3];
    pbmpm_view view;
} kept_view;

static bool is_of_field(const kept_view *kept, uint32_t row, uint32_t component)
{
    if (kept->field == PBMPM_MATERIAL) return view_uint(&kept->view, row, 0) <= 2;
    const float value = view_float(&kept->view, row, component);
    return value == 0.0f || (value >= kept->low[component] && value <= kept->high[component]);
}

static bool is_identifier(const kept_view *kept, uint32_t row, uint32_t capacity, uint32_t first)
{
    const uint32_t index = view_uint(&kept->view, row, 0), generation = view_uint(&kept->view, row, 1);
    return index < capacity && (generation == 0 || (generation >= first && generation <= first + 2));
}

/* Liquid and jelly fly through cell after cell, so each substep sorts; far from the origin, heavy, and fast. */
static void check_expired_views(int32_t dimension, pbmpm_solver solver)
{
    enum { CAPACITY = 6000 };
    kept_view kept[] = {{.field = PBMPM_POSITION, .low = {200, 300, 400}, .high = {240, 340, 440}},
                        {.field = PBMPM_VELOCITY, .low = {40, 50, 60}, .high = {44, 54, 64}},
                        {.field = PBMPM_VOLUME_RATIO, .low = {0.8f}, .high = {1.2f}},
                        {.field = PBMPM_MASS, .low = {5000}, .high = {20000}},
                        {.field = PBMPM_MATERIAL},
                        {.field = PBMPM_PARTICLE}};
    enum { FIELDS = sizeof kept / sizeof *kept };
    pbmpm_world_def def = default_world(dimension, 1.0f, CAPACITY);
    const pbmpm_world_id world = create_world(&def);
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.solver = solver;
    OK(pbmpm_world_set_settings(world, &settings));
    pbmpm_material_def heavy = default_material(PBMPM_LIQUID);
    pbmpm_material_id liquid, jelly;
    heavy.density = dimension == 3 ? 80000 : 40000;
    OK(pbmpm_material_create(world, &heavy, &liquid));
    heavy.kind = PBMPM_ELASTIC;
    OK(pbmpm_material_create(world, &heavy, &jelly));
    fill_shape(world, liquid, box_shape(210, 310, 410, 4, 4, 4), (const float[]){42, 52, 62});
    fill_shape(world, jelly, box_shape(222, 322, 422, 3, 3, 3), (const float[]){42, 52, 62});
    for (int f = 0; f < FIELDS; f++) kept[f].view = view_of(world, kept[f].field);
    const uint32_t first = view_uint(&kept[5].view, 0, 1);
    for (int step = 0; step < 8; step++) {
        OK(pbmpm_world_step(world, 0.05f));
        if (step == 3) view_of(world, PBMPM_POSITION); /* made anew, where the old one is */
        if (step == 5) {
            const pbmpm_shape some = box_shape(230, 330, 430, 9, 9, 9);
            OK(pbmpm_particles_remove_in(world, &some, NULL));
        }
        for (int f = 0; f < FIELDS; f++)
            for (uint32_t row = 0; row < kept[f].view.count; row++) {
                bool right = kept[f].field == PBMPM_PARTICLE && is_identifier(&kept[f], row, CAPACITY, first);
                for (uint32_t c = 0; c < kept[f].view.components && kept[f].field != PBMPM_PARTICLE; c++)
                    right = (c == 0 || right) && is_of_field(&kept[f], row, c);
                if (!right) TEST_FAIL_MESSAGE("an expired view shows what its field never was");
            }
    }
    TEST_ASSERT_TRUE(world_stats(world).cell_changes > 0.5f);
    OK(pbmpm_world_destroy(world));
}

static void test_expired_views_show_values_of_their_field(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++) {
        check_expired_views(dimension, PBMPM_SOLVER_PAPER);
        check_expired_views(dimension, PBMPM_SOLVER_CONVERGENT);
    }
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_definitions_have_the_documented_defaults);
    RUN_TEST(test_arrays_arrive_in_2d);
    RUN_TEST(test_arrays_arrive_in_3d);
    RUN_TEST(test_default_volume_is_half_a_cell_per_axis);
    RUN_TEST(test_fill_covers_each_shape);
    RUN_TEST(test_fill_depends_on_its_seed_only);
    RUN_TEST(test_fill_without_jitter_is_a_lattice);
    RUN_TEST(test_fill_leaves_out_what_lies_outside_the_domain);
    RUN_TEST(test_fill_leaves_out_what_lies_in_obstacles);
    RUN_TEST(test_remove_by_identifier);
    RUN_TEST(test_remove_in_a_shape);
    RUN_TEST(test_views_keep_to_one_order);
    RUN_TEST(test_deformation_needs_an_elastic_particle);
    RUN_TEST(test_every_change_expires_views);
    RUN_TEST(test_settable_fields_in_2d);
    RUN_TEST(test_settable_fields_in_3d);
    RUN_TEST(test_set_all_in_storage_order);
    RUN_TEST(test_query_reports_the_full_number);
    RUN_TEST(test_identifiers_survive_steps);
    RUN_TEST(test_user_values_go_with_their_particles);
    RUN_TEST(test_user_values_cost_nothing_until_there_is_one);
    RUN_TEST(test_fills_and_emitters_give_user_values);
    RUN_TEST(test_user_values_are_saved);
    RUN_TEST(test_expired_views_show_values_of_their_field);
    return UNITY_END();
}
