/* Saves survive a patch: things are found by their keys, parameters may change on request, and formats stay readable. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scenes.h"

enum { ROOM = 1 << 20 };

static const float at_rest[3];
static unsigned char saved[ROOM];
static uint64_t saved_bytes;

void setUp(void) {}
void tearDown(void) { pbmpm_shutdown(); }

/* What a game might make, with or without keys; in another order and with changes after a patch. */
typedef struct game {
    pbmpm_world_id world;
    pbmpm_material_id water, jelly;
    pbmpm_collider_id ramp, ball;
    pbmpm_emitter_id tap;
    pbmpm_drain_id sink;
    pbmpm_force_id wind;
} game;

typedef struct plan {
    uint64_t key; /* of the first thing of each kind; 0: none has a key */
    bool reversed;
    float viscosity, friction, ramp_width, rate, jelly_density;
    bool extra; /* one more material and collider */
} plan;

static const plan before = {.key = 100, .viscosity = 0.0f, .friction = 0.2f, .ramp_width = 0.5f, .rate = 0.1f, .jelly_density = 500};

static pbmpm_material_id add_material(const game *made, const plan *how, int which)
{
    pbmpm_material_def def = default_material(which ? PBMPM_ELASTIC : PBMPM_LIQUID);
    pbmpm_material_id id;
    def.key = how->key ? how->key + (uint64_t)which : 0;
    if (which)
        def.density = how->jelly_density;
    else
        def.kinematic_viscosity = how->viscosity;
    OK(pbmpm_material_create(made->world, &def, &id));
    return id;
}

static pbmpm_collider_id add_collider(const game *made, const plan *how, int which)
{
    pbmpm_collider_def def = default_collider();
    const pbmpm_shape shape = which ? sphere_shape(2.0f, 0.5f, 0, 0.3f) : box_shape(1.0f, 0.2f, 0, how->ramp_width, 0.1f, 0.1f);
    pbmpm_collider_id id;
    def.key = how->key ? how->key + (uint64_t)which : 0;
    def.kinematic = which;
    def.friction_coefficient = how->friction;
    def.user_data = which ? 0 : 7;
    OK(pbmpm_collider_create(made->world, &def, &shape, &id));
    return id;
}

static void add_flow(game *made, const plan *how)
{
    pbmpm_emitter_def tap;
    pbmpm_drain_def sink;
    pbmpm_force_def wind;
    OK(pbmpm_emitter_def_init(&tap, sizeof tap));
    OK(pbmpm_drain_def_init(&sink, sizeof sink));
    OK(pbmpm_force_def_init(&wind, sizeof wind));
    const pbmpm_shape box = box_shape(0.5f, 2.5f, 0, 0.2f, 0.1f, 0.1f), corner = box_shape(2.9f, 0.1f, 0, 0.1f, 0.1f, 0.1f);
    tap.material = made->water;
    tap.rate = how->rate;
    tap.key = sink.key = wind.key = how->key;
    OK(pbmpm_emitter_create(made->world, &tap, &box, &made->tap));
    OK(pbmpm_drain_create(made->world, &sink, &corner, &made->sink));
    OK(pbmpm_force_create(made->world, &wind, &corner, &made->wind));
}

static game make_game(const plan *how)
{
    pbmpm_world_def def = default_world(2, 0.1f, 5000);
    game made = {{0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}};
    def.domain_enabled = 1;
    def.domain_max[0] = def.domain_max[1] = 3.0f;
    def.thread_count = 1;
    made.world = create_world(&def);
    set_gravity(made.world, 0, -10, 0);
    if (how->extra) create_material(made.world, PBMPM_LIQUID);
    for (int k = 0; k < 2; k++) {
        const int which = how->reversed ? 1 - k : k;
        *(which ? &made.jelly : &made.water) = add_material(&made, how, which);
        *(which ? &made.ball : &made.ramp) = add_collider(&made, how, which);
    }
    if (how->extra) create_collider(made.world, sphere_shape(0.3f, 0.3f, 0, 0.1f), false);
    add_flow(&made, how);
    return made;
}

static void run(const game *made, int steps)
{
    const float place[3] = {1.5f, 0.5f, 0};
    OK(pbmpm_collider_move(made->world, made->ball, place, NULL));
    for (int i = 0; i < steps; i++) OK(pbmpm_world_step(made->world, 0.01f));
}

static void save(const game *made) { OK(pbmpm_snapshot_save(made->world, saved, ROOM, &saved_bytes)); }

static game saved_game(const plan *how)
{
    const game made = make_game(how);
    fill_shape(made.world, made.water, box_shape(1.5f, 1.0f, 0, 1.0f, 0.2f, 0.1f), at_rest);
    fill_shape(made.world, made.jelly, box_shape(1.5f, 1.6f, 0, 0.2f, 0.2f, 0.1f), at_rest);
    run(&made, 30);
    save(&made);
    return made;
}

static uint32_t count_of(const game *made, pbmpm_material_id material)
{
    const pbmpm_view view = view_of(made->world, PBMPM_MATERIAL);
    uint32_t count = 0;
    for (uint32_t i = 0; i < view.count; i++) count += view_uint(&view, i, 0) == material.index;
    return count;
}

static void expect_taken(const game *old, const plan *how, uint32_t flags)
{
    const game made = make_game(how);
    pbmpm_shape theirs = default_shape(), own = default_shape();
    pbmpm_emitter_status due = {.size = sizeof due}, status = {.size = sizeof status};
    OK(pbmpm_snapshot_restore(made.world, saved, saved_bytes, flags));
    TEST_ASSERT_EQUAL_HEX64(world_hash_unordered(old->world), world_hash_unordered(made.world));
    TEST_ASSERT_EQUAL_UINT32(count_of(old, old->water), count_of(&made, made.water));
    TEST_ASSERT_EQUAL_UINT32(count_of(old, old->jelly), count_of(&made, made.jelly));
    OK(pbmpm_collider_get(old->world, old->ball, NULL, &theirs));
    OK(pbmpm_collider_get(made.world, made.ball, NULL, &own));
    TEST_ASSERT_EQUAL_MEMORY(theirs.position, own.position, sizeof own.position);
    OK(pbmpm_emitter_status_get(old->world, old->tap, &due));
    OK(pbmpm_emitter_status_get(made.world, made.tap, &status));
    TEST_ASSERT_TRUE(due.emitted > 0);
    TEST_ASSERT_EQUAL_UINT64(due.emitted, status.emitted);
    run(&made, 5);
    world_expect_finite(made.world, "after a restore");
}

static void expect_foreign(const plan *how, uint32_t flags, const char *label)
{
    const game made = make_game(how);
    fill_shape(made.world, made.water, box_shape(1.5f, 1.0f, 0, 0.5f, 0.2f, 0.1f), at_rest);
    const snapshot unchanged = snapshot_take(made.world);
    EXPECT(PBMPM_ERROR_FOREIGN, pbmpm_snapshot_restore(made.world, saved, saved_bytes, flags));
    snapshot_expect_same(&unchanged, made.world, label);
}

static void test_keys_find_things_in_other_slots(void)
{
    const game old = saved_game(&before);
    plan how = before;
    expect_taken(&old, &how, 0);
    how.reversed = true;
    expect_taken(&old, &how, 0);
}

/* A collider that was destroyed and made again stands in another slot. */
static void test_a_collider_that_was_made_again(void)
{
    const game old = saved_game(&before);
    game made = make_game(&before);
    create_collider(made.world, sphere_shape(0.3f, 0.3f, 0, 0.1f), false);
    OK(pbmpm_collider_destroy(made.world, made.ramp));
    OK(pbmpm_collider_destroy(made.world, made.ball));
    made.ball = add_collider(&made, &before, 1);
    made.ramp = add_collider(&made, &before, 0);
    TEST_ASSERT_NOT_EQUAL(old.ball.index, made.ball.index);
    EXPECT(PBMPM_ERROR_FOREIGN, pbmpm_snapshot_restore(made.world, saved, saved_bytes, 0)); /* the sphere is one too many */
    OK(pbmpm_snapshot_restore(made.world, saved, saved_bytes, PBMPM_RESTORE_KEEP_PARAMETERS));
    TEST_ASSERT_EQUAL_HEX64(world_hash(old.world), world_hash(made.world));
}

static void test_without_keys_places_count(void)
{
    plan how = before;
    how.key = 0;
    const game old = saved_game(&how);
    expect_taken(&old, &how, 0);
    how.reversed = true;
    expect_foreign(&how, 0, "other places");
    how.reversed = false;
    how.key = 5; /* a patch gives keys */
    expect_taken(&old, &how, 0);
}

static void test_changed_parameters_are_kept_on_request(void)
{
    const game old = saved_game(&before);
    plan how = before;
    how.viscosity = 0.01f;
    expect_foreign(&how, 0, "another viscosity");
    expect_taken(&old, &how, PBMPM_RESTORE_KEEP_PARAMETERS);
    how = before;
    how.friction = 0.7f;
    expect_foreign(&how, 0, "another friction");
    expect_taken(&old, &how, PBMPM_RESTORE_KEEP_PARAMETERS);
    how.ramp_width = 0.8f;
    how.rate = 0.2f;
    expect_taken(&old, &how, PBMPM_RESTORE_KEEP_PARAMETERS);
    how.reversed = how.extra = true;
    expect_foreign(&how, 0, "more things");
    expect_taken(&old, &how, PBMPM_RESTORE_KEEP_PARAMETERS);
    how = before;
    how.jelly_density = 600;
    expect_foreign(&how, 0, "another density");
    expect_foreign(&how, PBMPM_RESTORE_KEEP_PARAMETERS, "another density, with the world's parameters");
}

static void test_the_worlds_parameters_stay(void)
{
    pbmpm_material_def material = {.size = sizeof material};
    pbmpm_collider_def collider = {.size = sizeof collider};
    pbmpm_emitter_def emitter = {.size = sizeof emitter};
    pbmpm_settings settings = {.size = sizeof settings};
    pbmpm_shape shape = default_shape();
    plan how = before;
    saved_game(&before);
    how.viscosity = 0.01f;
    how.friction = 0.7f;
    how.ramp_width = 0.8f;
    how.rate = 0.3f;
    const game made = make_game(&how);
    set_gravity(made.world, 0, -5, 0);
    OK(pbmpm_snapshot_restore(made.world, saved, saved_bytes, PBMPM_RESTORE_KEEP_PARAMETERS));
    OK(pbmpm_material_get(made.world, made.water, &material));
    OK(pbmpm_collider_get(made.world, made.ramp, &collider, &shape));
    OK(pbmpm_emitter_get(made.world, made.tap, &emitter, NULL));
    OK(pbmpm_world_get_settings(made.world, &settings));
    TEST_ASSERT_EQUAL_FLOAT(0.01f, material.kinematic_viscosity);
    TEST_ASSERT_EQUAL_FLOAT(0.7f, collider.friction_coefficient);
    TEST_ASSERT_EQUAL_UINT64(7, collider.user_data);
    TEST_ASSERT_EQUAL_FLOAT(0.8f, shape.half_extents[0]);
    TEST_ASSERT_EQUAL_FLOAT(0.3f, emitter.rate);
    TEST_ASSERT_EQUAL_FLOAT(-5.0f, settings.gravity[1]);
}

/* Materials that particles have must be there. */
/* What emitters, drains and forces are defined by is the save's, or on request the world's own; where they stand is the save's. */
static void test_effects_are_the_saves_or_ones_own(void)
{
    const pbmpm_shape wide = box_shape(0.7f, 1.1f, 0, 0.15f, 0.25f, 0.1f);
    const game old = saved_game(&before);
    OK(pbmpm_world_destroy(old.world));
    for (uint32_t keeps = 0; keeps < 2; keeps++) {
        const game made = make_game(&before);
        pbmpm_emitter_def tap = {.size = sizeof tap};
        pbmpm_drain_def sink = {.size = sizeof sink};
        pbmpm_force_def wind = {.size = sizeof wind};
        pbmpm_shape shape[3] = {{.size = sizeof *shape}, {.size = sizeof *shape}, {.size = sizeof *shape}};
        OK(pbmpm_emitter_get(made.world, made.tap, &tap, NULL));
        OK(pbmpm_drain_get(made.world, made.sink, &sink, NULL));
        OK(pbmpm_force_get(made.world, made.wind, &wind, NULL));
        const float usual = wind.strength;
        tap.speed = 3;
        sink.material = made.jelly;
        wind.strength = 7;
        OK(pbmpm_emitter_set(made.world, made.tap, &tap, &wide));
        OK(pbmpm_drain_set(made.world, made.sink, &sink, &wide));
        OK(pbmpm_force_set(made.world, made.wind, &wind, &wide));
        OK(pbmpm_snapshot_restore(made.world, saved, saved_bytes, keeps ? PBMPM_RESTORE_KEEP_PARAMETERS : 0));
        OK(pbmpm_emitter_get(made.world, made.tap, &tap, &shape[0]));
        OK(pbmpm_drain_get(made.world, made.sink, &sink, &shape[1]));
        OK(pbmpm_force_get(made.world, made.wind, &wind, &shape[2]));
        TEST_ASSERT_EQUAL_FLOAT(keeps ? 3 : 0, tap.speed);
        TEST_ASSERT_EQUAL_UINT32(keeps ? made.jelly.generation : 0, sink.material.generation);
        TEST_ASSERT_EQUAL_FLOAT(keeps ? 7 : usual, wind.strength);
        for (int i = 0; i < 3; i++) {
            TEST_ASSERT_EQUAL_FLOAT(keeps ? 0.15f : i == 0 ? 0.2f : 0.1f, shape[i].half_extents[0]);
            TEST_ASSERT_EQUAL_FLOAT(i == 0 ? 0.5f : 2.9f, shape[i].position[0]);
        }
        OK(pbmpm_world_destroy(made.world));
    }
}

static void test_matter_without_material(void)
{
    const game old = saved_game(&before);
    pbmpm_world_def def = {.size = sizeof def};
    OK(pbmpm_world_get_def(old.world, &def));
    const pbmpm_world_id empty = create_world(&def);
    EXPECT(PBMPM_ERROR_FOREIGN, pbmpm_snapshot_restore(empty, saved, saved_bytes, PBMPM_RESTORE_KEEP_PARAMETERS));
    TEST_ASSERT_EQUAL_UINT32(0, world_count(empty));
}

static void test_keys_are_unique(void)
{
    const game made = make_game(&before);
    pbmpm_material_def material = default_material(PBMPM_LIQUID);
    pbmpm_collider_def collider = default_collider();
    pbmpm_emitter_def emitter;
    pbmpm_drain_def drain;
    pbmpm_force_def force;
    pbmpm_material_id material_id;
    pbmpm_collider_id collider_id;
    pbmpm_emitter_id emitter_id;
    pbmpm_drain_id drain_id;
    pbmpm_force_id force_id;
    const pbmpm_shape shape = default_shape();
    OK(pbmpm_emitter_def_init(&emitter, sizeof emitter));
    OK(pbmpm_drain_def_init(&drain, sizeof drain));
    OK(pbmpm_force_def_init(&force, sizeof force));
    emitter.material = made.water;
    material.key = collider.key = emitter.key = drain.key = force.key = before.key;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_material_create(made.world, &material, &material_id));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_create(made.world, &collider, &shape, &collider_id));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_emitter_create(made.world, &emitter, &shape, &emitter_id));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_drain_create(made.world, &drain, &shape, &drain_id));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_force_create(made.world, &force, &shape, &force_id));
    OK(pbmpm_emitter_set(made.world, made.tap, &emitter, NULL)); /* its own */
    OK(pbmpm_drain_set(made.world, made.sink, &drain, NULL));
    OK(pbmpm_force_set(made.world, made.wind, &force, NULL));
}

static void test_unknown_flags(void)
{
    const game made = saved_game(&before);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_snapshot_restore(made.world, saved, saved_bytes, 2));
}

/* The save that version 0.2 wrote, which every later version reads. It is made by this program with --write FOLDER. */
static void test_saves_of_older_versions_are_read(void)
{
    const game made = make_game(&before);
    uint64_t hash = 0;
    FILE *file = fopen(PBMPM_TEST_SAVES "/0.2/game.snapshot", "rb");
    TEST_ASSERT_NOT_NULL(file);
    TEST_ASSERT_EQUAL_size_t(1, fread(&hash, sizeof hash, 1, file));
    saved_bytes = fread(saved, 1, ROOM, file);
    fclose(file);
    OK(pbmpm_snapshot_restore(made.world, saved, saved_bytes, 0));
    TEST_ASSERT_EQUAL_HEX64(hash, world_hash_unordered(made.world));
    run(&made, 5);
    world_expect_finite(made.world, "after an old save");
}

static int write_save(const char *folder)
{
    char path[1024];
    const game made = saved_game(&before);
    const uint64_t hash = world_hash_unordered(made.world);
    snprintf(path, sizeof path, "%s/game.snapshot", folder);
    FILE *file = fopen(path, "wb");
    if (!file) return perror(path), 1;
    fwrite(&hash, sizeof hash, 1, file);
    fwrite(saved, 1, saved_bytes, file);
    return fclose(file);
}

int main(int argc, char **argv)
{
    UNITY_BEGIN();
    if (argc > 2 && strcmp(argv[1], "--write") == 0) return write_save(argv[2]);
    RUN_TEST(test_keys_find_things_in_other_slots);
    RUN_TEST(test_a_collider_that_was_made_again);
    RUN_TEST(test_without_keys_places_count);
    RUN_TEST(test_changed_parameters_are_kept_on_request);
    RUN_TEST(test_the_worlds_parameters_stay);
    RUN_TEST(test_effects_are_the_saves_or_ones_own);
    RUN_TEST(test_matter_without_material);
    RUN_TEST(test_keys_are_unique);
    RUN_TEST(test_unknown_flags);
    RUN_TEST(test_saves_of_older_versions_are_read);
    return UNITY_END();
}
