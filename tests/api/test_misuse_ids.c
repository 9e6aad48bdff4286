/* Null, stale, random and foreign identifiers, null pointers and wrong structure sizes: refused by every call that
 * takes them, and nothing is changed. */
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

static void expect_invalid_id(const world_call *row, const target *ids, const char *what)
{
    char label[160];
    const pbmpm_result result = row->make(ids);
    snprintf(label, sizeof label, "%s with %s identifier gave %s", row->name, what, pbmpm_result_name(result));
    TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_ERROR_INVALID_ID, result, label);
    snapshot_expect_same(&before, good.world, label);
}

/* The control: with good identifiers every call of the table succeeds, so refusals below are the identifiers' fault. */
static void test_every_call_succeeds_with_good_identifiers(void)
{
    for (int i = 0; i < world_call_count; i++) {
        const pbmpm_result result = world_calls[i].make(&good);
        TEST_ASSERT_EQUAL_STRING_MESSAGE("PBMPM_OK", pbmpm_result_name(result), world_calls[i].name);
    }
}

/* Makes every call with a target whose world identifier is bad. */
static void refuse_world(pbmpm_world_id bad, const char *what)
{
    target ids = good;
    ids.world = bad;
    for (int i = 0; i < world_call_count; i++)
        expect_invalid_id(&world_calls[i], &ids, what);
}

/* Makes every call that takes one of the other identifiers, with those of `bad`. */
static void refuse_parts(const target *bad, const char *what)
{
    for (int i = 0; i < world_call_count; i++)
        if (world_calls[i].uses) {
            target ids = *bad;
            ids.world = good.world;
            expect_invalid_id(&world_calls[i], &ids, what);
        }
}

static void test_null_identifiers(void)
{
    const target none = {.world = {0, 0}};
    refuse_world(none.world, "a null world");
    refuse_parts(&none, "a null");
}

static void test_stale_identifiers(void)
{
    const target old = target_create(NULL, NULL);
    OK(pbmpm_world_destroy(old.world));
    refuse_world(old.world, "a stale world");
    const target renewed = target_create(NULL, NULL); /* takes the old one's place */
    refuse_world(old.world, "a stale world");
    OK(pbmpm_world_destroy(renewed.world));

    target gone = good;
    gone.spare = create_material(good.world, PBMPM_LIQUID);
    gone.material = gone.spare;
    gone.collider = create_collider(good.world, sphere_shape(0.2f, 0.2f, 0, 0.1f), true);
    gone.emitter = create_emitter(good.world, good.material);
    gone.drain = create_drain(good.world, sphere_shape(0.2f, 0.2f, 0, 0.1f));
    gone.force = create_force(good.world);
    OK(pbmpm_emitter_destroy(good.world, gone.emitter));
    OK(pbmpm_drain_destroy(good.world, gone.drain));
    OK(pbmpm_force_destroy(good.world, gone.force));
    OK(pbmpm_baked_destroy(good.world, gone.baked));
    OK(pbmpm_material_destroy(good.world, gone.spare));
    OK(pbmpm_collider_destroy(good.world, gone.collider));
    OK(pbmpm_particles_remove(good.world, &gone.particle, 1));
    before = snapshot_take(good.world);
    refuse_parts(&gone, "a stale");
    create_material(good.world, PBMPM_LIQUID);
    create_collider(good.world, sphere_shape(0.2f, 0.2f, 0, 0.1f), true);
    create_emitter(good.world, good.material);
    create_drain(good.world, sphere_shape(0.2f, 0.2f, 0, 0.1f));
    create_force(good.world);
    OK(load_triangle(good.world, &good.baked));
    before = snapshot_take(good.world);
    refuse_parts(&gone, "a stale");
}

static void test_foreign_identifiers(void)
{
    const target other = target_create(NULL, NULL);
    refuse_parts(&other, "a foreign");
    OK(pbmpm_world_destroy(other.world));
}

/* The first index that no object can have, one more, and the last number: a sanitizer sees who looks behind a table. */
static void test_identifiers_behind_tables(void)
{
    for (uint32_t k = 0; k < 3; k++) {
        target behind = good;
        behind.material.index = behind.spare.index = k == 2 ? UINT32_MAX : PBMPM_MAX_MATERIALS + k;
        behind.collider.index = k == 2 ? UINT32_MAX : PBMPM_MAX_COLLIDERS + k;
        behind.emitter.index = k == 2 ? UINT32_MAX : PBMPM_MAX_EMITTERS + k;
        behind.drain.index = k == 2 ? UINT32_MAX : PBMPM_MAX_DRAINS + k;
        behind.force.index = k == 2 ? UINT32_MAX : PBMPM_MAX_FORCES + k;
        behind.baked.index = k == 2 ? UINT32_MAX : PBMPM_MAX_BAKED + k;
        behind.particle.index = k == 2 ? UINT32_MAX : 2048 + k; /* the capacity */
        refuse_parts(&behind, "a made-up");
        pbmpm_world_id world = good.world;
        world.index = k == 2 ? UINT32_MAX : PBMPM_MAX_WORLDS + k;
        refuse_world(world, "a made-up world");
    }
}

/* Random numbers, half of them small as real ones are; those whose generation is one of a living object are left out. */
static void test_random_identifiers(void)
{
    uint32_t seed = 2463534242u;
    for (int round = 0; round < 2000; round++) {
        const uint32_t small = round % 2 ? 4096 : UINT32_MAX;
        const uint32_t index = random_next(&seed) % small, generation = random_next(&seed) % small;
        const world_call *row = &world_calls[random_next(&seed) % (uint32_t)world_call_count];
        target ids = good;
        if (generation == good.world.generation || generation == good.material.generation || generation == good.spare.generation ||
            generation == good.collider.generation || generation == good.emitter.generation ||
            generation == good.drain.generation || generation == good.force.generation ||
            generation == good.baked.generation)
            continue;
        ids.material = ids.spare = (pbmpm_material_id){index, generation};
        ids.collider = (pbmpm_collider_id){index, generation};
        ids.emitter = (pbmpm_emitter_id){index, generation};
        ids.drain = (pbmpm_drain_id){index, generation};
        ids.force = (pbmpm_force_id){index, generation};
        ids.baked = (pbmpm_baked_id){index, generation};
        ids.particle = (pbmpm_particle_id){index + before.count, generation}; /* beyond the slots ever used */
        if (!row->uses)
            ids.world = (pbmpm_world_id){index, generation};
        expect_invalid_id(row, &ids, "a random");
    }
}

/* One bad identifier among good ones spoils the call, wherever it stands. */
static void test_one_bad_particle_spoils_the_call(void)
{
    enum { COUNT = 16 };
    const pbmpm_view identity = view_of(good.world, PBMPM_PARTICLE);
    pbmpm_particle_id ids[COUNT];
    float values[2 * COUNT] = {0};
    uint32_t rows[COUNT];
    for (uint32_t bad = 0; bad < COUNT; bad++) {
        for (uint32_t i = 0; i < COUNT; i++)
            ids[i] = (pbmpm_particle_id){view_uint(&identity, i, 0), view_uint(&identity, i, 1)};
        ids[bad].generation++;
        EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_particles_set(good.world, PBMPM_VELOCITY, ids, COUNT, values));
        EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_particles_remove(good.world, ids, COUNT));
        EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_particles_find(good.world, ids, COUNT, rows));
        snapshot_expect_same(&before, good.world, "one bad particle");
    }
}

/* A particle that is listed twice is removed once or refused, never counted twice. */
static void test_a_particle_listed_twice(void)
{
    const pbmpm_particle_id twice[2] = {good.particle, good.particle};
    const pbmpm_result result = pbmpm_particles_remove(good.world, twice, 2);
    TEST_ASSERT_EQUAL_UINT32(result == PBMPM_OK ? before.count - 1 : before.count, world_count(good.world));
    for (int i = 0; i < 5; i++)
        OK(pbmpm_world_step(good.world, 0.001f));
}

static void test_null_pointers(void)
{
    const pbmpm_world_id w = good.world;
    const float position[3] = {1, 1, 0};
    pbmpm_world_def world_def = default_world(2, 0.1f, 10);
    pbmpm_world_id made;
    pbmpm_material_def material_def = default_material(PBMPM_LIQUID);
    pbmpm_material_id material;
    const pbmpm_collider_def collider_def = default_collider();
    pbmpm_collider_id collider;
    pbmpm_particles_def particles;
    const pbmpm_fill_def fill = default_fill(good.material);
    pbmpm_particle_id ids[1];
    const pbmpm_shape shape = sphere_shape(1, 1, 0, 0.3f);
    const pbmpm_layout_entry *entries;
    pbmpm_event event = {.size = sizeof event};
    uint32_t count;
    OK(pbmpm_particles_def_init(&particles, sizeof particles));
#define REFUSE(call) EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, call)
    REFUSE(pbmpm_world_def_init(NULL, sizeof world_def));
    REFUSE(pbmpm_settings_init(NULL, sizeof(pbmpm_settings)));
    REFUSE(pbmpm_material_def_init(NULL, sizeof material_def));
    REFUSE(pbmpm_collider_def_init(NULL, sizeof collider_def));
    REFUSE(pbmpm_particles_def_init(NULL, sizeof particles));
    REFUSE(pbmpm_fill_def_init(NULL, sizeof(pbmpm_fill_def)));
    REFUSE(pbmpm_shape_init(NULL, sizeof shape));
    REFUSE(pbmpm_layout_table(NULL, &count));
    REFUSE(pbmpm_layout_table(&entries, NULL));
    REFUSE(pbmpm_world_create(NULL, &made));
    REFUSE(pbmpm_world_create(&world_def, NULL));
    REFUSE(pbmpm_world_get_def(w, NULL));
    REFUSE(pbmpm_world_get_settings(w, NULL));
    REFUSE(pbmpm_world_set_settings(w, NULL));
    REFUSE(pbmpm_world_generation(w, NULL));
    REFUSE(pbmpm_world_hash(w, NULL));
    REFUSE(pbmpm_world_get_stats(w, NULL));
    REFUSE(pbmpm_world_events(w, NULL, 1, &count, &count));
    REFUSE(pbmpm_world_events(w, &event, 1, NULL, &count));
    REFUSE(pbmpm_material_create(w, NULL, &material));
    REFUSE(pbmpm_material_create(w, &material_def, NULL));
    REFUSE(pbmpm_material_get(w, good.material, NULL));
    REFUSE(pbmpm_material_set(w, good.material, NULL));
    REFUSE(pbmpm_collider_create(w, NULL, &shape, &collider));
    REFUSE(pbmpm_collider_create(w, &collider_def, NULL, &collider));
    REFUSE(pbmpm_collider_create(w, &collider_def, &shape, NULL));
    REFUSE(pbmpm_collider_move(w, good.collider, NULL, NULL));
    REFUSE(pbmpm_collider_teleport(w, good.collider, NULL, NULL));
    REFUSE(pbmpm_query_collider(w, good.collider, ids, 1, NULL));
    REFUSE(pbmpm_query_collider(w, good.collider, NULL, 1, &count));
    REFUSE(pbmpm_query_shape(w, NULL, ids, 1, &count));
    REFUSE(pbmpm_query_shape(w, &shape, ids, 1, NULL));
    REFUSE(pbmpm_query_shape(w, &shape, NULL, 1, &count));
    REFUSE(pbmpm_particles_add(w, NULL, ids));
    particles.material = good.material;
    particles.count = 1;
    REFUSE(pbmpm_particles_add(w, &particles, ids)); /* positions are null */
    REFUSE(pbmpm_particles_fill(w, NULL, &shape, &count));
    REFUSE(pbmpm_particles_fill(w, &fill, NULL, &count));
    REFUSE(pbmpm_query_region(w, NULL, NULL, 0, &count));
    REFUSE(pbmpm_query_region(w, &shape, NULL, 1, &count));
    REFUSE(pbmpm_query_region(w, &shape, NULL, 0, NULL));
    REFUSE(pbmpm_particles_remove(w, NULL, 1));
    REFUSE(pbmpm_particles_remove_in(w, NULL, &count));
    REFUSE(pbmpm_particles_count(w, NULL));
    REFUSE(pbmpm_particles_view(w, PBMPM_POSITION, NULL));
    REFUSE(pbmpm_particles_set(w, PBMPM_VELOCITY, &good.particle, 1, NULL));
    REFUSE(pbmpm_particles_set(w, PBMPM_VELOCITY, NULL, 1, position)); /* null means all, and there are more */
    REFUSE(pbmpm_particles_find(w, NULL, 1, &count));
    REFUSE(pbmpm_particles_find(w, &good.particle, 1, NULL));
#undef REFUSE
    snapshot_expect_same(&before, w, "null pointers");
}

/* ---- structure sizes that no version had ---- */

static void refuse_sizes_in_init(void)
{
    unsigned char room[8192];
    static const size_t wrong[] = {0, 1, 3, 4097, 5000, (size_t)-1};
    memset(room, 0x5A, sizeof room);
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_world_def_init((pbmpm_world_def *)(void *)room, wrong[i]));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_settings_init((pbmpm_settings *)(void *)room, wrong[i]));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_material_def_init((pbmpm_material_def *)(void *)room, wrong[i]));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_collider_def_init((pbmpm_collider_def *)(void *)room, wrong[i]));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_particles_def_init((pbmpm_particles_def *)(void *)room, wrong[i]));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_fill_def_init((pbmpm_fill_def *)(void *)room, wrong[i]));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_shape_init((pbmpm_shape *)(void *)room, wrong[i]));
    }
    TEST_ASSERT_EACH_EQUAL_HEX8(0x5A, room, sizeof room);
}

static void test_unknown_structure_sizes(void)
{
    static const uint32_t wrong[] = {0, 1, 4, 4097, 5000, UINT32_MAX};
    const pbmpm_world_id w = good.world;
    refuse_sizes_in_init();
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        pbmpm_world_def world_def = default_world(2, 0.1f, 10);
        pbmpm_world_id made;
        pbmpm_settings settings = default_settings();
        pbmpm_material_def material_def = default_material(PBMPM_ELASTIC);
        pbmpm_material_id material;
        const pbmpm_shape sound = sphere_shape(1, 1, 0, 0.3f);
        pbmpm_shape shape = sound;
        pbmpm_collider_def collider_def = default_collider();
        pbmpm_collider_id collider;
        pbmpm_particles_def particles;
        pbmpm_fill_def fill = default_fill(good.material);
        pbmpm_stats stats;
        pbmpm_view view;
        const float position[2] = {1, 1};
        uint32_t count;
        OK(pbmpm_particles_def_init(&particles, sizeof particles));
        particles.count = 1;
        particles.positions = position;
        particles.material = good.material;
        world_def.size = settings.size = material_def.size = particles.size = stats.size = view.size = shape.size = wrong[i];
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_world_create(&world_def, &made));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_world_get_def(w, &world_def));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_world_get_settings(w, &settings));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_world_set_settings(w, &settings));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_material_create(w, &material_def, &material));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_material_get(w, good.material, &material_def));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_material_set(w, good.material, &material_def));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_collider_create(w, &collider_def, &shape, &collider));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_collider_get(w, good.collider, NULL, &shape));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_particles_add(w, &particles, NULL));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_particles_fill(w, &fill, &shape, NULL));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_particles_remove_in(w, &shape, NULL));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_query_shape(w, &shape, NULL, 0, &count));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_world_get_stats(w, &stats));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_particles_view(w, PBMPM_POSITION, &view));
        collider_def.size = fill.size = wrong[i];
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_collider_create(w, &collider_def, &sound, &collider));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_collider_get(w, good.collider, &collider_def, NULL));
        EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_particles_fill(w, &fill, &sound, NULL));
    }
    snapshot_expect_same(&before, w, "unknown sizes");
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_every_call_succeeds_with_good_identifiers);
    RUN_TEST(test_null_identifiers);
    RUN_TEST(test_stale_identifiers);
    RUN_TEST(test_foreign_identifiers);
    RUN_TEST(test_identifiers_behind_tables);
    RUN_TEST(test_random_identifiers);
    RUN_TEST(test_one_bad_particle_spoils_the_call);
    RUN_TEST(test_a_particle_listed_twice);
    RUN_TEST(test_null_pointers);
    RUN_TEST(test_unknown_structure_sizes);
    return UNITY_END();
}
