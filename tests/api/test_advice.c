/* Advice: what the call promises, and what is foreseen of a scene, its settings, its emitters and its obstacles. */
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

/* ---- the call ---- */

static void test_a_tank_of_water_at_defaults_needs_no_advice(void)
{
    pbmpm_world_def def = default_world(2, 0.05f, 8192);
    def.domain_enabled = 1;
    const pbmpm_world_id world = create_world(&def);
    set_gravity(world, 0, -9.81f, 0);
    fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0.5f, 0.15f, 0, 0.5f, 0.15f, 0.5f), STILL);
    for (int step = 0; step < 120; step++) OK(pbmpm_world_step(world, DT));
    ask(world);
    TEST_ASSERT_EQUAL_UINT32_MESSAGE(0, told_count, told_count ? told[0].text : "");
}

static void test_arguments_are_checked(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    uint32_t count = 77;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_advice(world, DT, told, ROOM, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_advice(world, DT, NULL, 1, &count));
    told[0].size = 4;
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_world_advice(world, DT, told, ROOM, &count));
    told[0].size = sizeof told[0];
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_advice(world, 0.0f, told, ROOM, &count));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_advice(world, NAN, told, ROOM, &count));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_advice(world, 10.1f, told, ROOM, &count));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_world_advice((pbmpm_world_id){0, 0}, DT, told, ROOM, &count));
    TEST_ASSERT_EQUAL_UINT32(77, count);
}

static void test_every_code_has_a_name(void)
{
    for (int code = PBMPM_ADVICE_NO_GRAVITY; code <= PBMPM_ADVICE_COLLIDER_TOO_COARSE; code++)
        TEST_ASSERT_EQUAL_INT(0, strncmp(pbmpm_advice_name((pbmpm_advice_code)code), "PBMPM_ADVICE_", 13));
    TEST_ASSERT_EQUAL_STRING("PBMPM_ADVICE_NO_GRAVITY", pbmpm_advice_name(PBMPM_ADVICE_NO_GRAVITY));
    TEST_ASSERT_EQUAL_STRING("PBMPM_ADVICE_UNKNOWN", pbmpm_advice_name((pbmpm_advice_code)9999));
    TEST_ASSERT_EQUAL_STRING("Pa", pbmpm_advice_unit(PBMPM_ADVICE_MODULUS_NOT_HELD));
    TEST_ASSERT_EQUAL_STRING("cells", pbmpm_advice_unit(PBMPM_ADVICE_BODY_TOO_THIN));
    TEST_ASSERT_EQUAL_STRING("", pbmpm_advice_unit(PBMPM_ADVICE_NO_GRAVITY));
    TEST_ASSERT_EQUAL_STRING("", pbmpm_advice_unit((pbmpm_advice_code)9999));
}

/* Both parts of the answer: how many there are, and as many of the first as there is room for. Nothing that is read back changes. */
static void test_it_writes_what_there_is_room_for_and_changes_nothing(void)
{
    const pbmpm_world_id world = block_2d(NULL, NULL);
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.flip = 0.5f;
    OK(pbmpm_world_set_settings(world, &settings));
    const uint64_t hash = world_hash(world);
    const pbmpm_stats before = world_stats(world);
    uint32_t count = 0;
    ask(world);
    TEST_ASSERT_TRUE(told_count >= 2);
    TEST_ASSERT_EQUAL_INT(PBMPM_ADVICE_NO_GRAVITY, told[0].code);
    memset(told, 0xA5, sizeof told);
    told[0].size = sizeof told[0];
    OK(pbmpm_world_advice(world, DT, told, 1, &count));
    TEST_ASSERT_EQUAL_UINT32(told_count, count);
    TEST_ASSERT_EQUAL_INT(PBMPM_ADVICE_NO_GRAVITY, told[0].code);
    TEST_ASSERT_EQUAL_HEX32(0xA5A5A5A5, told[1].size);
    TEST_ASSERT_EQUAL_HEX64(hash, world_hash(world));
    TEST_ASSERT_EQUAL_UINT64(before.memory_bytes, world_stats(world).memory_bytes);
}

static void watched(pbmpm_world_def *def, void *user)
{
    def->allocator = ledger_allocator(user);
}

static void test_without_memory_it_says_so(void)
{
    static ledger book;
    uint32_t count = 77;
    book = (ledger){0};
    const pbmpm_world_id world = tank_2d(watched, &book);
    book.fail_at = book.calls + 1;
    EXPECT(PBMPM_ERROR_OUT_OF_MEMORY, pbmpm_world_advice(world, DT, NULL, 0, &count));
    TEST_ASSERT_EQUAL_UINT32(77, count);
    OK(pbmpm_world_advice(world, DT, NULL, 0, &count));
    OK(pbmpm_world_destroy(world));
    ledger_expect_clean(&book, "after advice");
}

/* ---- the scene ---- */

static void test_no_gravity(void)
{
    const pbmpm_world_id world = block_2d(NULL, NULL);
    TEST_ASSERT_EQUAL_INT(PBMPM_CHANGE_GRAVITY, expect(world, PBMPM_ADVICE_NO_GRAVITY)->change);
    expect_none(world, PBMPM_ADVICE_FALLS_FOREVER);
    set_gravity(world, 0, -9.81f, 0);
    expect_none(world, PBMPM_ADVICE_NO_GRAVITY);
}

/* A uniform force stands for gravity while it is on. */
static void test_no_gravity_but_a_force(void)
{
    const pbmpm_world_id world = block_2d(NULL, NULL);
    const pbmpm_force_id force = create_force(world);
    pbmpm_force_def def = {.size = sizeof def};
    pbmpm_shape shape = {.size = sizeof shape};
    OK(pbmpm_force_get(world, force, &def, &shape));
    def.kind = PBMPM_FORCE_UNIFORM;
    def.strength = 9.81f;
    OK(pbmpm_force_set(world, force, &def, &shape));
    expect(world, PBMPM_ADVICE_NO_GRAVITY);
    def.enabled = 1;
    OK(pbmpm_force_set(world, force, &def, &shape));
    expect_none(world, PBMPM_ADVICE_NO_GRAVITY);
}

static void check_falling(int32_t dimension)
{
    const pbmpm_world_id world = falling_world(dimension, 0.1f);
    fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0, 2, 0, 0.5f, 0.5f, 0.5f), STILL);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, expect(world, PBMPM_ADVICE_FALLS_FOREVER)->figure);
    const pbmpm_collider_id beside = create_collider(world, box_shape(5, 0, 0, 0.5f, 0.5f, 0.5f), false);
    expect(world, PBMPM_ADVICE_FALLS_FOREVER);
    OK(pbmpm_collider_destroy(world, beside));
    const pbmpm_collider_id below = create_collider(world, box_shape(0, -50, 0, 1, 0.5f, 1), false);
    expect_none(world, PBMPM_ADVICE_FALLS_FOREVER);
    OK(pbmpm_collider_destroy(world, below));
    pbmpm_kill_bounds bounds;
    OK(pbmpm_kill_bounds_init(&bounds, sizeof bounds));
    bounds.enabled = 1;
    OK(pbmpm_world_set_kill_bounds(world, &bounds));
    expect_none(world, PBMPM_ADVICE_FALLS_FOREVER); /* all of it is meant to fall */
    create_collider(world, box_shape(-0.04f, 0, 0, 0.5f, 0.5f, 2), false); /* some of it sticks out beyond */
    TEST_ASSERT_FLOAT_WITHIN(0.02f, 0.05f, expect(world, PBMPM_ADVICE_FALLS_FOREVER)->figure);
    OK(pbmpm_world_step(world, DT));
    expect_none(world, PBMPM_ADVICE_FALLS_FOREVER);
}

static void test_matter_that_falls_for_ever(void)
{
    check_falling(2);
    check_falling(3);
}

static void test_parameters_that_do_nothing(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    pbmpm_material_def jelly = default_material(PBMPM_ELASTIC);
    expect_none(world, PBMPM_ADVICE_IGNORED);
    jelly.young_modulus = 2e5f;
    jelly.elasticity_ratio = 0.5f;
    jelly.elastic_model = PBMPM_NEO_HOOKEAN;
    fill_shape(world, add_material(world, &jelly), box_shape(0.5f, 0.75f, 0, 0.2f, 0.2f, 0.2f), STILL);
    check_ignored(world, "elasticity_ratio");
    set_solver(world, PBMPM_SOLVER_DUAL);
    check_ignored(world, "elastic_model");
    set_solver(world, PBMPM_SOLVER_PAPER);
    check_ignored(world, "young_modulus");
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    settings.flip = 0.5f;
    settings.integrator = PBMPM_INTEGRATOR_BDF2;
    settings.target_error = 0.01f;
    settings.pressure = PBMPM_PRESSURE_CELLS;
    OK(pbmpm_world_set_settings(world, &settings));
    check_ignored(world, "settings.flip");
    check_ignored(world, "settings.integrator");
    check_ignored(world, "settings.target_error");
    check_ignored(world, "settings.pressure");
    set_solver(world, PBMPM_SOLVER_PRIMAL);
    ask(world);
    for (uint32_t i = 0; i < told_count; i++) TEST_ASSERT_TRUE(strncmp(told[i].text, "settings.integrator", 19) != 0);
    const pbmpm_shape shape = default_shape();
    pbmpm_collider_def wall = default_collider();
    wall.friction = PBMPM_FRICTION_SLIP;
    wall.friction_coefficient = 0.7f;
    pbmpm_collider_id id;
    OK(pbmpm_collider_create(world, &wall, &shape, &id));
    check_ignored(world, "friction_coefficient");
}

/* Beyond a wall with all of it; a part inside is enough. */
static void test_an_emitter_outside_of_the_domain(void)
{
    pbmpm_world_def def = default_world(2, 0.05f, 8192);
    def.domain_enabled = 1; /* from 0 to 1 m */
    const pbmpm_world_id world = create_world(&def);
    const pbmpm_shape inside = box_shape(0.5f, 0.5f, 0, 0.1f, 0.1f, 0.1f), partly = box_shape(1.05f, 0.5f, 0, 0.1f, 0.1f, 0.1f);
    const pbmpm_shape outside = box_shape(1.2f, 0.5f, 0, 0.1f, 0.1f, 0.1f); /* 0.1 m, two cells */
    pbmpm_emitter_def jet = {0};
    pbmpm_emitter_id emitter;
    OK(pbmpm_emitter_def_init(&jet, sizeof jet));
    set_gravity(world, 0, -9.81f, 0);
    jet.material = create_material(world, PBMPM_LIQUID);
    jet.rate = 1.0f;
    OK(pbmpm_emitter_create(world, &jet, &inside, &emitter));
    expect_none(world, PBMPM_ADVICE_EMITTER_OUTSIDE);
    OK(pbmpm_emitter_set(world, emitter, NULL, &partly));
    expect_none(world, PBMPM_ADVICE_EMITTER_OUTSIDE);
    OK(pbmpm_emitter_set(world, emitter, NULL, &outside));
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 2.0f, expect(world, PBMPM_ADVICE_EMITTER_OUTSIDE)->figure);
    OK(pbmpm_emitter_destroy(world, emitter));
    expect_none(world, PBMPM_ADVICE_EMITTER_OUTSIDE);
}

/* A box on the floor that gives as much as flows out of it, in water as deep as itself: part of it finds no space. Above the water all does. */
static void test_an_emitter_whose_place_is_full(void)
{
    for (int lifted = 0; lifted < 2; lifted++) {
        pbmpm_world_def def = default_world(2, 0.05f, 8192);
        pbmpm_emitter_def jet = {0};
        pbmpm_emitter_id emitter;
        pbmpm_emitter_status status = {.size = sizeof status};
        def.domain_enabled = 1;
        def.domain_max[0] = 4;
        const pbmpm_world_id world = create_world(&def);
        const pbmpm_shape nozzle = box_shape(2, lifted ? 0.7f : 0.1f, 0, 0.2f, 0.1f, 0.1f);
        set_gravity(world, 0, -9.81f, 0);
        OK(pbmpm_emitter_def_init(&jet, sizeof jet));
        jet.material = create_material(world, PBMPM_LIQUID);
        jet.rate = 0.4f;
        jet.speed = lifted ? 2.0f : 0.0f;
        jet.direction[0] = 0;
        jet.direction[1] = -1;
        OK(pbmpm_emitter_create(world, &jet, &nozzle, &emitter));
        expect_none(world, PBMPM_ADVICE_EMITTER_REFUSED);
        for (int step = 0; step < 60; step++) OK(pbmpm_world_step(world, 1.0f / 60));
        OK(pbmpm_emitter_status_get(world, emitter, &status));
        const double refused = (double)status.refused_full / (double)(status.emitted + status.refused_full);
        if (lifted) {
            TEST_ASSERT_TRUE(refused < 0.1);
            expect_none(world, PBMPM_ADVICE_EMITTER_REFUSED);
        } else {
            TEST_ASSERT_TRUE(refused > 0.1 && refused < 0.9);
            TEST_ASSERT_FLOAT_WITHIN(1e-4f, (float)refused, expect(world, PBMPM_ADVICE_EMITTER_REFUSED)->figure);
        }
    }
}

/* A jelly where there is water, off the grid; beside it nothing is too much. After a step it is too late to tell. */
static void test_matter_in_other_matter(void)
{
    static const float beside[] = {2.013f, 0.513f}, inside[] = {0.513f, 0.413f};
    for (int dimension = 2; dimension <= 3; dimension++) {
        const pbmpm_world_id world = falling_world(dimension, 0.05f);
        const pbmpm_material_id water = create_material(world, PBMPM_LIQUID), jelly = create_material(world, PBMPM_ELASTIC);
        fill_shape(world, water, box_shape(0.517f, 0.431f, 0, 0.5f, 0.4f, 0.3f), STILL);
        fill_shape(world, jelly, box_shape(beside[0], beside[1], 0, 0.2f, 0.2f, 0.2f), STILL);
        expect_none(world, PBMPM_ADVICE_OVERLAPS);
        fill_shape(world, jelly, box_shape(inside[0], inside[1], 0, 0.2f, 0.2f, 0.2f), STILL);
        const pbmpm_advice *advice = expect(world, PBMPM_ADVICE_OVERLAPS);
        TEST_ASSERT_EQUAL_UINT32(water.generation, advice->material.generation);
        TEST_ASSERT_FLOAT_WITHIN(0.05f, dimension == 2 ? 0.2f : 0.133f, advice->figure);
        OK(pbmpm_world_step(world, DT));
        expect_none(world, PBMPM_ADVICE_OVERLAPS);
    }
}

static void test_obstacles(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    create_collider(world, box_shape(0.2f, 0.9f, 0, 0.1f, 0.01f, 0.1f), false); /* over the water: it parts nothing */
    expect_none(world, PBMPM_ADVICE_COLLIDER_TOO_THIN);
    const pbmpm_collider_id thin = create_collider(world, box_shape(0.2f, 0.1f, 0, 0.1f, 0.01f, 0.1f), false);
    const pbmpm_collider_id fast = create_collider(world, sphere_shape(0.7f, 0.9f, 0, 0.05f), true);
    const pbmpm_advice *advice = expect(world, PBMPM_ADVICE_COLLIDER_TOO_THIN);
    TEST_ASSERT_EQUAL_UINT32(thin.generation, advice->collider.generation);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.4f, advice->figure);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 3.0f, advice->bound);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.15f, advice->value);
    expect_none(world, PBMPM_ADVICE_COLLIDER_TOO_FAST);
    OK(pbmpm_collider_move(world, fast, (const float[3]){0.55f, 0.9f, 0}, NULL));
    advice = expect(world, PBMPM_ADVICE_COLLIDER_TOO_FAST);
    TEST_ASSERT_EQUAL_UINT32(fast.generation, advice->collider.generation);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 3.0f, advice->figure);
    TEST_ASSERT_EQUAL_FLOAT(3.0f, advice->value);
}

static void test_a_step_that_is_too_long(void)
{
    const pbmpm_world_id world = falling_world(2, 0.1f);
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    fill_shape(world, water, box_shape(0, 0, 0, 0.3f, 0.3f, 0.3f), (const float[3]){100, 0, 0});
    expect_none(world, PBMPM_ADVICE_STEP_TOO_LONG);
    fill_shape(world, water, box_shape(0, 1, 0, 0.3f, 0.3f, 0.3f), (const float[3]){300, 0, 0});
    const pbmpm_advice *advice = expect(world, PBMPM_ADVICE_STEP_TOO_LONG);
    TEST_ASSERT_FLOAT_WITHIN(0.1f, 50.0f, advice->figure);
    TEST_ASSERT_EQUAL_INT(PBMPM_CHANGE_KILL_BOUNDS, advice->change); /* nothing is below */
    create_collider(world, box_shape(0, -50, 0, 1, 0.5f, 1), false);
    TEST_ASSERT_EQUAL_INT(PBMPM_CHANGE_SUBSTEPS, expect(world, PBMPM_ADVICE_STEP_TOO_LONG)->change);
}

/* Water and a jelly that meet at 1.5 and at 2.5 cells per substep; not sand, nor what passes by or is farther than four cells. */
static void test_what_enters_bodies(void)
{
    static const struct {
        pbmpm_material_kind other;
        float cells, down, high;
        bool told;
    } cases[] = {{PBMPM_ELASTIC, 2.5f, 1, 0.8f, true}, {PBMPM_ELASTIC, 1.5f, 1, 0.8f, false}, {PBMPM_VISCO, 2.5f, 1, 0.8f, true}, {PBMPM_SAND, 2.5f, 1, 0.8f, false},
                 {PBMPM_LIQUID, 2.5f, 1, 0.8f, false}, {PBMPM_ELASTIC, 2.5f, 0, 0.8f, false}, {PBMPM_ELASTIC, 2.5f, 1, 1.2f, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const pbmpm_world_id world = falling_world(2, 0.1f);
        fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0, cases[i].high, 0, 0.3f, 0.3f, 1),
                   (const float[3]){(1 - cases[i].down) * cases[i].cells * 0.1f / DT, -cases[i].down * cases[i].cells * 0.1f / DT, 0});
        fill_shape(world, create_material(world, cases[i].other), box_shape(0, 0, 0, 0.3f, 0.3f, 1), STILL);
        if (!cases[i].told) {
            expect_none(world, PBMPM_ADVICE_STEP_TOO_LONG);
            continue;
        }
        const pbmpm_advice *advice = expect(world, PBMPM_ADVICE_STEP_TOO_LONG);
        TEST_ASSERT_FLOAT_WITHIN(1e-3f, cases[i].cells, advice->figure);
        TEST_ASSERT_EQUAL_FLOAT(2.0f, advice->value);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_tank_of_water_at_defaults_needs_no_advice);
    RUN_TEST(test_arguments_are_checked);
    RUN_TEST(test_every_code_has_a_name);
    RUN_TEST(test_it_writes_what_there_is_room_for_and_changes_nothing);
    RUN_TEST(test_without_memory_it_says_so);
    RUN_TEST(test_no_gravity);
    RUN_TEST(test_no_gravity_but_a_force);
    RUN_TEST(test_matter_that_falls_for_ever);
    RUN_TEST(test_parameters_that_do_nothing);
    RUN_TEST(test_an_emitter_outside_of_the_domain);
    RUN_TEST(test_an_emitter_whose_place_is_full);
    RUN_TEST(test_matter_in_other_matter);
    RUN_TEST(test_obstacles);
    RUN_TEST(test_a_step_that_is_too_long);
    RUN_TEST(test_what_enters_bodies);
    return UNITY_END();
}
