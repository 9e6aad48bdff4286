/* Snapshots: a world goes on from one bit for bit, and whatever is wrong with one is found before anything changes. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "calls.h"
#include "solvers.h"

#ifdef PBMPM_SANITIZED
enum { BEFORE = 20, AFTER = 40, AFTER_3D = 20, AGAIN = 20, COMPARED_EVERY = 20, CHANGED_EVERY = 17 };
#else
enum { BEFORE = 20, AFTER = 60, AFTER_3D = 20, AGAIN = 20, COMPARED_EVERY = 20, CHANGED_EVERY = 1 };
#endif

/* A snapshot in memory of exactly its size. */
typedef struct saved {
    unsigned char *data;
    uint64_t bytes;
} saved;

static saved kept[4]; /* freed after each test, also after a failed one */
static int kept_count;

void setUp(void)
{
    kept_count = 0;
}

void tearDown(void)
{
    for (int i = 0; i < kept_count; i++)
        free(kept[i].data);
    pbmpm_shutdown();
}

static saved save(pbmpm_world_id world)
{
    saved made = {NULL, 0};
    uint64_t written = 0;
    TEST_ASSERT_TRUE(kept_count < (int)(sizeof kept / sizeof *kept));
    OK(pbmpm_snapshot_size(world, &made.bytes, NULL));
    made.data = malloc(made.bytes);
    TEST_ASSERT_NOT_NULL(made.data);
    kept[kept_count++] = made;
    OK(pbmpm_snapshot_save(world, made.data, made.bytes, &written));
    TEST_ASSERT_EQUAL_UINT64(made.bytes, written);
    return made;
}

static void restore(pbmpm_world_id world, const saved *from)
{
    OK(pbmpm_snapshot_restore(world, from->data, from->bytes, 0));
}

/* ---- going on ---- */

typedef void runner(const stage *made, int from, int to);

/* Runs on and compares with the hashes of the run that was not interrupted; writes them when `fresh`. */
static void run_and_compare(const stage *made, runner *run, int steps, uint64_t hashes[AFTER / COMPARED_EVERY], bool fresh, const char *label)
{
    for (int part = 0; part < steps / COMPARED_EVERY; part++) {
        run(made, BEFORE + part * COMPARED_EVERY, BEFORE + (part + 1) * COMPARED_EVERY);
        const uint64_t hash = world_hash(made->world);
        if (fresh)
            hashes[part] = hash;
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(hashes[part], hash, label);
    }
}

/* Saves `first` in the middle, runs it to the end, and for a while from the snapshot again; then `twin`, which is somewhere else, to the end. Both are left there. */
static void check_going_on(const stage *first, const stage *twin, runner *run, int steps, const char *name)
{
    char label[160];
    uint64_t hashes[AFTER / COMPARED_EVERY] = {0};
    run(first, 0, BEFORE);
    const saved middle = save(first->world);
    const uint64_t there = world_hash(first->world);
    run_and_compare(first, run, steps, hashes, true, name);
    TEST_ASSERT_TRUE_MESSAGE(there != hashes[steps / COMPARED_EVERY - 1], "nothing moves");
    const saved end = save(first->world);

    restore(first->world, &middle);
    TEST_ASSERT_EQUAL_HEX64_MESSAGE(there, world_hash(first->world), name);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(BEFORE, world_stats(first->world).step_count, name);
    snprintf(label, sizeof label, "%s, the same world again", name);
    run_and_compare(first, run, AGAIN, hashes, false, label);

    run(twin, 0, 3);
    restore(twin->world, &middle);
    TEST_ASSERT_EQUAL_HEX64_MESSAGE(there, world_hash(twin->world), name);
    snprintf(label, sizeof label, "%s, another world", name);
    run_and_compare(twin, run, steps, hashes, false, label);

    TEST_ASSERT_EQUAL_UINT64_MESSAGE(end.bytes, save(twin->world).bytes, name);
    restore(first->world, &end);
}

static void check_ways(int32_t dimension)
{
    for (int w = 0; w < way_count; w++) {
        const stage first = stirred_pool(dimension, &ways[w], NULL, NULL);
        const stage twin = stirred_pool(dimension, &ways[w], three_threads, NULL);
        check_going_on(&first, &twin, stirred_pool_run, dimension == 2 ? AFTER : AFTER_3D, ways[w].name);
        tearDown();
        setUp();
    }
}

static void test_every_solver_goes_on_in_2d(void)
{
    check_ways(2);
}

static void test_every_solver_goes_on_in_3d(void)
{
    check_ways(3);
}

static const scene *running;

static void run_scene(const stage *made, int from, int to)
{
    scene_run(running, made, from, to);
}

static void test_every_scene_goes_on(void)
{
    for (int i = 0; i < scene_count; i++) {
        running = &scenes[i];
        const stage first = running->build(NULL, NULL), twin = running->build(three_threads, NULL);
        check_going_on(&first, &twin, run_scene, AFTER, running->name);
        tearDown();
        setUp();
    }
}

/* An emitter that moves, a drain of one material, a vortex and kill bounds in the stirred pool. */
static stage busy_pool(scene_tweak *tweak)
{
    const stage made = stirred_pool(2, &ways[0], tweak, NULL);
    pbmpm_material_id water = create_material(made.world, PBMPM_LIQUID);
    pbmpm_emitter_def source;
    pbmpm_drain_def drain;
    pbmpm_force_def force;
    pbmpm_kill_bounds bounds;
    pbmpm_emitter_id emitter;
    pbmpm_drain_id hole;
    pbmpm_force_id vortex;
    const float there[3] = {0.5f, 1.0f, 0};
    const pbmpm_shape spout = sphere_shape(0.3f, 1.0f, 0, 0.05f), low = sphere_shape(0.6f, 0.1f, 0, 0.2f), middle = sphere_shape(0.6f, 0.4f, 0, 0.2f);
    OK(pbmpm_emitter_def_init(&source, sizeof source));
    source.material = water;
    source.rate = 0.2f;
    source.speed = 1.0f;
    source.spread = 0.4f;
    OK(pbmpm_emitter_create(made.world, &source, &spout, &emitter));
    OK(pbmpm_emitter_move(made.world, emitter, there, NULL));
    OK(pbmpm_drain_def_init(&drain, sizeof drain));
    drain.material = water;
    OK(pbmpm_drain_create(made.world, &drain, &low, &hole));
    OK(pbmpm_force_def_init(&force, sizeof force));
    force.kind = PBMPM_FORCE_VORTEX;
    OK(pbmpm_force_create(made.world, &force, &middle, &vortex));
    OK(pbmpm_kill_bounds_init(&bounds, sizeof bounds));
    bounds.enabled = 1;
    bounds.low[0] = -1;
    bounds.high[0] = 1.1f;
    bounds.high[1] = 2;
    OK(pbmpm_world_set_kill_bounds(made.world, &bounds));
    return made;
}

static pbmpm_flow flow_of(pbmpm_world_id world)
{
    pbmpm_flow flow = {.size = sizeof flow};
    OK(pbmpm_world_get_flow(world, &flow));
    return flow;
}

static void test_emitters_drains_and_forces_go_on(void)
{
    const stage first = busy_pool(NULL), twin = busy_pool(three_threads);
    check_going_on(&first, &twin, stirred_pool_run, AFTER, "emitters, drains, forces");
    const pbmpm_flow one = flow_of(first.world), other = flow_of(twin.world);
    TEST_ASSERT_TRUE(one.emitted > 0 && one.drained > 0 && one.killed > 0);
    TEST_ASSERT_EQUAL_UINT64(one.emitted, other.emitted);
    TEST_ASSERT_EQUAL_UINT64(one.drained, other.drained);
    TEST_ASSERT_EQUAL_UINT64(one.killed, other.killed);
    TEST_ASSERT_TRUE(one.emitted_mass == other.emitted_mass && one.drained_mass == other.drained_mass);
}

/* The settings, too, are those of the snapshot, and what a solver left behind that was used since is gone. */
static void test_settings_and_solver_come_back(void)
{
    const way dual = {"dual", PBMPM_SOLVER_DUAL, PBMPM_PRESSURE_PARTICLES, PBMPM_INTEGRATOR_EULER, 0};
    const pbmpm_world_id world = tank_2d(NULL, NULL), alone = tank_2d(NULL, NULL);
    for (int i = 0; i < BEFORE; i++) {
        OK(pbmpm_world_step(world, 0.01f));
        OK(pbmpm_world_step(alone, 0.01f));
    }
    const saved paper = save(world);
    const pbmpm_settings before = snapshot_take(world).settings;
    use_way(world, &dual);
    set_gravity(world, 3, 4, 0);
    for (int i = 0; i < BEFORE; i++)
        OK(pbmpm_world_step(world, 0.02f));
    restore(world, &paper);
    const pbmpm_settings after = snapshot_take(world).settings;
    TEST_ASSERT_EQUAL_MEMORY(&before, &after, sizeof before);
    for (int i = 0; i < AFTER; i++) {
        OK(pbmpm_world_step(world, 0.01f));
        OK(pbmpm_world_step(alone, 0.01f));
    }
    TEST_ASSERT_EQUAL_HEX64(world_hash(alone), world_hash(world));
}

/* ---- identifiers ---- */

static pbmpm_particle_id id_at(pbmpm_world_id world, uint32_t row)
{
    const pbmpm_view view = view_of(world, PBMPM_PARTICLE);
    return (pbmpm_particle_id){view_uint(&view, row, 0), view_uint(&view, row, 1)};
}

static bool is_zero(pbmpm_world_id world, pbmpm_field field)
{
    const pbmpm_view view = view_of(world, field);
    for (uint32_t row = 0; row < view.count; row++)
        if (view_uint(&view, row, 0) != 0)
            return false;
    return view.count > 0;
}

/* What the world did not have when it was saved is as new. */
static void test_fields_of_later_are_at_rest_again(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    set_solver(world, PBMPM_SOLVER_PAPER);
    const saved before = save(world);
    const pbmpm_particle_id first = id_at(world, 0);
    const uint32_t seven = 7;
    OK(pbmpm_particles_set(world, PBMPM_USER_VALUE, &first, 1, &seven));
    set_solver(world, PBMPM_SOLVER_DUAL);
    OK(pbmpm_world_step(world, 1.0f / 60));
    TEST_ASSERT_FALSE(is_zero(world, PBMPM_USER_VALUE));
    TEST_ASSERT_FALSE(is_zero(world, PBMPM_PRESSURE));
    restore(world, &before);
    TEST_ASSERT_TRUE(is_zero(world, PBMPM_USER_VALUE));
    TEST_ASSERT_TRUE(is_zero(world, PBMPM_PRESSURE));
}

static void test_identifiers_come_back_and_later_ones_are_gone(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_particle_id removed[3] = {id_at(world, 7), id_at(world, 3), id_at(world, 100)};
    uint32_t row;
    OK(pbmpm_particles_remove(world, removed, 3)); /* leaves free identifiers behind */
    const uint32_t count = world_count(world);
    const pbmpm_particle_id stays = id_at(world, 50);
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    const float position[2] = {0.5f, 0.9f};
    pbmpm_particles_def def;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.count = 1;
    def.positions = position;
    def.material = water;
    const saved middle = save(world);
    pbmpm_particle_id later, again;
    OK(pbmpm_particles_add(world, &def, &later));
    OK(pbmpm_particles_remove(world, &stays, 1));
    restore(world, &middle);
    TEST_ASSERT_EQUAL_UINT32(count, world_count(world));
    OK(pbmpm_particles_find(world, &stays, 1, &row));
    TEST_ASSERT_EQUAL_UINT32(50, row);
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_particles_find(world, &later, 1, &row));
    for (int i = 0; i < 3; i++)
        EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_particles_find(world, &removed[i], 1, &row));
    OK(pbmpm_particles_add(world, &def, &again)); /* the same place, another particle */
    TEST_ASSERT_EQUAL_UINT32(later.index, again.index);
    TEST_ASSERT_TRUE(later.generation != again.generation);
}

/* The snapshot of an empty world, and of one that was emptied. */
static void test_empty_worlds(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const saved full = save(world);
    const pbmpm_shape everywhere = box_shape(0, 0, 0, 9, 9, 9);
    OK(pbmpm_particles_remove_in(world, &everywhere, NULL));
    const saved emptied = save(world);
    restore(world, &full);
    TEST_ASSERT_TRUE(world_count(world) > 0);
    restore(world, &emptied);
    TEST_ASSERT_EQUAL_UINT32(0, world_count(world));
    OK(pbmpm_world_step(world, 0.01f));
    restore(world, &full);
    OK(pbmpm_world_step(world, 0.01f));
    world_expect_finite(world, "after emptying and restoring");
}

/* ---- size ---- */

static void check_bytes_per_particle(int32_t dimension, pbmpm_material_kind kind, bool with_pressure, uint32_t expected)
{
    const pbmpm_world_def def = default_world(dimension, 0.1f, 10000);
    const pbmpm_world_id world = create_world(&def);
    const pbmpm_material_id material = create_material(world, kind);
    uint64_t bytes[2];
    uint32_t each[2];
    pbmpm_settings settings = default_settings();
    settings.solver = with_pressure ? PBMPM_SOLVER_DUAL : PBMPM_SOLVER_PAPER;
    OK(pbmpm_world_set_settings(world, &settings));
    fill_shape(world, material, box_shape(5, 5, 5, 0.1f, 0.1f, 0.1f), (const float[3]){0, 0, 0});
    OK(pbmpm_world_step(world, 0.01f));
    OK(pbmpm_snapshot_size(world, &bytes[0], &each[0]));
    const uint32_t added = fill_shape(world, material, box_shape(0, 0, 0, 0.5f, 0.5f, 0.5f), (const float[3]){0, 0, 0});
    OK(pbmpm_snapshot_size(world, &bytes[1], &each[1]));
    TEST_ASSERT_EQUAL_UINT32(expected, each[0]);
    TEST_ASSERT_EQUAL_UINT32(expected, each[1]);
    TEST_ASSERT_TRUE(added % 2 == 0); /* sections are padded to 8 bytes */
    TEST_ASSERT_EQUAL_UINT64((uint64_t)added * expected, bytes[1] - bytes[0]);
    OK(pbmpm_world_destroy(world));
}

static void test_bytes_per_particle_are_as_documented(void)
{
    check_bytes_per_particle(2, PBMPM_LIQUID, false, 60);
    check_bytes_per_particle(3, PBMPM_LIQUID, false, 92);
    check_bytes_per_particle(2, PBMPM_ELASTIC, false, 76);
    check_bytes_per_particle(3, PBMPM_ELASTIC, false, 128);
    check_bytes_per_particle(2, PBMPM_LIQUID, true, 64);
    check_bytes_per_particle(3, PBMPM_LIQUID, true, 96);
}

static void test_capacity_of_the_buffer(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const saved whole = save(world);
    uint64_t needed = 0;
    unsigned char *copy = malloc(whole.bytes + 1);
    TEST_ASSERT_NOT_NULL(copy);
    memset(copy, 0x5a, whole.bytes + 1);
    const pbmpm_result refused = pbmpm_snapshot_save(world, copy, whole.bytes - 1, &needed);
    const bool untouched = copy[0] == 0x5a && copy[whole.bytes - 1] == 0x5a;
    const pbmpm_result taken = pbmpm_snapshot_save(world, copy + 1, whole.bytes, NULL); /* of any alignment */
    const bool same = memcmp(copy + 1, whole.data, whole.bytes) == 0;
    const pbmpm_result restored = pbmpm_snapshot_restore(world, copy + 1, whole.bytes, 0);
    free(copy);
    EXPECT(PBMPM_ERROR_CAPACITY, refused);
    TEST_ASSERT_TRUE(untouched);
    TEST_ASSERT_EQUAL_UINT64(whole.bytes, needed);
    OK(taken);
    TEST_ASSERT_TRUE(same);
    OK(restored);
}

/* ---- damage ---- */

static pbmpm_world_id damaged_world;
static snapshot unchanged;

static void expect_damage(const unsigned char *data, uint64_t bytes, const char *what)
{
    const pbmpm_result result = pbmpm_snapshot_restore(damaged_world, data, bytes, 0);
    TEST_ASSERT_EQUAL_STRING_MESSAGE("PBMPM_ERROR_DAMAGED", pbmpm_result_name(result), what);
    TEST_ASSERT_TRUE_MESSAGE(pbmpm_last_error()[0] != '\0', what);
}

/* A world that is elsewhere than its snapshot, so that a restore would show. */
static saved prepare_damage(void)
{
    damaged_world = tank_2d(NULL, NULL);
    create_collider(damaged_world, sphere_shape(0.5f, 0.1f, 0, 0.1f), true);
    OK(pbmpm_world_step(damaged_world, 0.01f));
    const saved middle = save(damaged_world);
    OK(pbmpm_world_step(damaged_world, 0.01f));
    unchanged = snapshot_take(damaged_world);
    return middle;
}

static void test_every_changed_byte_is_found(void)
{
    char what[64];
    const saved middle = prepare_damage();
    uint32_t stream = 42;
    for (uint64_t i = 0; i < middle.bytes; i += CHANGED_EVERY) {
        const unsigned char old = middle.data[i];
        middle.data[i] ^= (unsigned char)(i < 64 ? 1u << (i % 8) : 1 + random_next(&stream) % 255);
        snprintf(what, sizeof what, "byte %llu", (unsigned long long)i);
        expect_damage(middle.data, middle.bytes, what);
        middle.data[i] = old;
    }
    for (uint64_t bit = 0; bit < 32 * 8; bit++) { /* the header, bit by bit */
        middle.data[bit / 8] ^= (unsigned char)(1u << bit % 8);
        expect_damage(middle.data, middle.bytes, "a bit of the header");
        middle.data[bit / 8] ^= (unsigned char)(1u << bit % 8);
    }
    snapshot_expect_same(&unchanged, damaged_world, "changed bytes");
    restore(damaged_world, &middle); /* the control */
}

static void test_every_truncation_is_found(void)
{
    const saved middle = prepare_damage();
    for (uint64_t bytes = 0; bytes < middle.bytes; bytes += bytes < 200 ? 1 : 131) {
        unsigned char *part = malloc(bytes ? bytes : 1); /* of that size, so that a sanitizer sees what is read beyond */
        TEST_ASSERT_NOT_NULL(part);
        memcpy(part, middle.data, bytes);
        const pbmpm_result result = pbmpm_snapshot_restore(damaged_world, part, bytes, 0);
        free(part);
        EXPECT(PBMPM_ERROR_DAMAGED, result);
    }
    snapshot_expect_same(&unchanged, damaged_world, "truncated");
}

/* Several places at once, exchanged words, and noise. */
static void test_random_damage_is_found(void)
{
    const saved middle = prepare_damage();
    unsigned char *copy = malloc(middle.bytes);
    bool found = true;
    uint32_t stream = 7;
    TEST_ASSERT_NOT_NULL(copy);
    for (int round = 0; round < 300; round++) {
        memcpy(copy, middle.data, middle.bytes);
        const uint64_t places = 1 + random_next(&stream) % 40, words = middle.bytes / 8;
        for (uint64_t k = 0; k < places; k++)
            copy[random_next(&stream) % middle.bytes] = (unsigned char)random_next(&stream);
        const uint64_t a = random_next(&stream) % words, b = random_next(&stream) % words;
        memcpy(copy + a * 8, middle.data + b * 8, 8);
        memcpy(copy + b * 8, middle.data + a * 8, 8);
        found &= memcmp(copy, middle.data, middle.bytes) == 0 ||
                 pbmpm_snapshot_restore(damaged_world, copy, middle.bytes, 0) == PBMPM_ERROR_DAMAGED;
    }
    for (int round = 0; round < 300; round++) {
        for (uint64_t i = 0; i < middle.bytes; i++)
            copy[i] = (unsigned char)random_next(&stream);
        if (round % 2)
            memcpy(copy, middle.data, 32); /* behind a sound header */
        found &= pbmpm_snapshot_restore(damaged_world, copy, middle.bytes, 0) == PBMPM_ERROR_DAMAGED;
    }
    free(copy);
    TEST_ASSERT_TRUE(found);
    snapshot_expect_same(&unchanged, damaged_world, "random damage");
}

/* ---- foreign worlds ---- */

static void expect_foreign(pbmpm_world_id world, const saved *from, pbmpm_result expected, const char *word)
{
    const snapshot before = snapshot_take(world);
    EXPECT(expected, pbmpm_snapshot_restore(world, from->data, from->bytes, 0));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(pbmpm_last_error(), word), pbmpm_last_error());
    snapshot_expect_same(&before, world, word);
}

static void change_world(pbmpm_world_def *def, void *user)
{
    switch (*(const char *)user) {
    case 'd': def->dimension = 3; break;
    case 'c': def->cell_size = 0.0625f; break;
    case 'b': def->domain_max[1] = 3.0f; break;
    case 'u': def->domain_enabled = 0; break;
    case 'f': def->domain_friction = 0.5f; break;
    default: def->particle_capacity = 10; break;
    }
}

static pbmpm_world_id changed_tank(const char *what)
{
    pbmpm_world_def def = default_world(2, 0.05f, 8192);
    def.domain_enabled = 1;
    def.domain_max[0] = def.domain_max[1] = def.domain_max[2] = 1.0f;
    change_world(&def, (void *)(uintptr_t)what);
    const pbmpm_world_id world = create_world(&def);
    create_material(world, PBMPM_LIQUID);
    return world;
}

static void test_foreign_worlds_are_refused(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const saved from = save(world);
    expect_foreign(changed_tank("d"), &from, PBMPM_ERROR_FOREIGN, "2D, not 3D");
    expect_foreign(changed_tank("c"), &from, PBMPM_ERROR_FOREIGN, "cell size");
    expect_foreign(changed_tank("b"), &from, PBMPM_ERROR_FOREIGN, "domain");
    expect_foreign(changed_tank("u"), &from, PBMPM_ERROR_FOREIGN, "domain");
    expect_foreign(changed_tank("f"), &from, PBMPM_ERROR_FOREIGN, "domain");
    expect_foreign(changed_tank("p"), &from, PBMPM_ERROR_CAPACITY, "room for 10");
}

static void test_other_materials_are_refused(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL), more = tank_2d(NULL, NULL), other = tank_2d(NULL, NULL);
    const saved from = save(world);
    create_material(more, PBMPM_LIQUID);
    expect_foreign(more, &from, PBMPM_ERROR_FOREIGN, "index 1");
    const saved two = save(more);
    expect_foreign(world, &two, PBMPM_ERROR_FOREIGN, "more materials");
    pbmpm_material_def thick = default_material(PBMPM_LIQUID);
    pbmpm_material_id material;
    thick.viscosity = 0.5f;
    OK(pbmpm_material_create(other, &thick, &material));
    const saved changed = save(other);
    expect_foreign(more, &changed, PBMPM_ERROR_FOREIGN, "material 1");
}

static void test_other_colliders_are_refused(void)
{
    const pbmpm_world_id with_ball = tank_2d(NULL, NULL), with_box = tank_2d(NULL, NULL), with_none = tank_2d(NULL, NULL);
    const pbmpm_collider_id ball = create_collider(with_ball, sphere_shape(0.5f, 0.1f, 0, 0.1f), true);
    create_collider(with_box, box_shape(0.5f, 0.1f, 0, 0.1f, 0.1f, 0.1f), true);
    const saved from = save(with_ball), none = save(with_none);
    expect_foreign(with_box, &from, PBMPM_ERROR_FOREIGN, "collider 0");
    expect_foreign(with_none, &from, PBMPM_ERROR_FOREIGN, "more colliders");
    expect_foreign(with_ball, &none, PBMPM_ERROR_FOREIGN, "index 0");
    /* the pose may differ: it comes back */
    const float elsewhere[3] = {0.25f, 0.5f, 0};
    pbmpm_shape shape = {.size = sizeof shape};
    OK(pbmpm_collider_teleport(with_ball, ball, elsewhere, NULL));
    restore(with_ball, &from);
    OK(pbmpm_collider_get(with_ball, ball, NULL, &shape));
    TEST_ASSERT_TRUE(shape.position[0] == 0.5f && shape.position[1] == 0.1f);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_every_solver_goes_on_in_2d);
    RUN_TEST(test_every_solver_goes_on_in_3d);
    RUN_TEST(test_every_scene_goes_on);
    RUN_TEST(test_emitters_drains_and_forces_go_on);
    RUN_TEST(test_settings_and_solver_come_back);
    RUN_TEST(test_fields_of_later_are_at_rest_again);
    RUN_TEST(test_identifiers_come_back_and_later_ones_are_gone);
    RUN_TEST(test_empty_worlds);
    RUN_TEST(test_bytes_per_particle_are_as_documented);
    RUN_TEST(test_capacity_of_the_buffer);
    RUN_TEST(test_every_changed_byte_is_found);
    RUN_TEST(test_every_truncation_is_found);
    RUN_TEST(test_random_damage_is_found);
    RUN_TEST(test_foreign_worlds_are_refused);
    RUN_TEST(test_other_materials_are_refused);
    RUN_TEST(test_other_colliders_are_refused);
    return UNITY_END();
}
