/* Advice of sand: where it slides, lands and runs out, and what stands on it. */
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

/* What slides, what is poured, what lands fast, what rests in a bin, and what lies on a board that is thinner than a cell, between the middles of two. A wide bed slides, but not far.
 * With as many substeps as are asked for sand comes to rest as it should. */
static void test_sand_that_moves(void)
{
    static const struct {
        float floor, floor_thick, wall, thick, wide; /* below it, on both sides of it, half the obstacles' thickness, half its width */
        bool slides, far, too_flat, lands;
    } cases[] = {{0, 0.1f, 0, 0.1f, 0.2f, false, false, false, false},        {0, 0.1f, 0, 0.01f, 0.2f, false, false, false, false},
                 {0, 0.1f, 1, 0.1f, 0.2f, true, true, true, false},           {0, 0.1f, 1, 0.1f, 0.7f, true, false, true, false},
                 {0.4f, 0.1f, 1, 0.1f, 0.2f, false, false, false, false},     {2.4f, 0.1f, 0, 0.1f, 0.2f, false, false, true, true},
                 {0.004f, 0.007f, 0, 0.1f, 0.2f, false, false, false, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const pbmpm_world_id world = falling_world(2, 0.02f);
        create_collider(world, box_shape(0, -cases[i].floor_thick - cases[i].floor, 0, 3, cases[i].floor_thick, 1), false);
        create_collider(world, box_shape(0, -5, 0, 3, 0.1f, 1), false);
        for (int side = -1; side <= 1; side += 2)
            create_collider(world, box_shape((float)side * (cases[i].wide + cases[i].wall + cases[i].thick), 0, 0, cases[i].thick, 3, 1), false);
        fill_shape(world, create_material(world, PBMPM_SAND), box_shape(0, 0.15f, 0, cases[i].wide, 0.15f, 1), STILL);
        ask(world);
        TEST_ASSERT_EQUAL_INT(cases[i].slides, tells("sand starts to slide"));
        TEST_ASSERT_EQUAL_INT(cases[i].far, tells("sand that slides far"));
        TEST_ASSERT_EQUAL_INT(cases[i].lands, tells("is crushed there"));
        TEST_ASSERT_EQUAL_INT(cases[i].too_flat, tells("comes to rest too flat"));
        float substeps = 1;
        for (uint32_t n = 0; n < told_count; n++)
            if (told[n].code == PBMPM_ADVICE_SAND_NOT_HELD) substeps = fmaxf(substeps, told[n].value);
        set_rate(world, (int32_t)substeps, 5);
        expect_none(world, PBMPM_ADVICE_SAND_NOT_HELD);
    }
}

/* Sand may be either solver's: what one of the two goes by is not ignored. Alone it rests with the primal. */
static void test_sand_is_of_two_solvers(void)
{
    const pbmpm_world_id world = falling_world(2, 0.05f);
    pbmpm_material_def def = default_material(PBMPM_SAND);
    pbmpm_settings settings = {.size = sizeof settings};
    def.relaxation = 0.5f;
    fill_shape(world, add_material(world, &def), box_shape(0, 0.15f, 0, 0.2f, 0.15f, 1), STILL);
    OK(pbmpm_world_get_settings(world, &settings));
    settings.integrator = PBMPM_INTEGRATOR_BDF2;
    OK(pbmpm_world_set_settings(world, &settings));
    expect_none(world, PBMPM_ADVICE_IGNORED);
    set_solver(world, PBMPM_SOLVER_DUAL);
    check_ignored(world, "settings.integrator");
    set_solver(world, PBMPM_SOLVER_PRIMAL);
    check_ignored(world, "relaxation");
}

/* Steps in which matter falls by less than 0.02 cells hold a rigid body on sand: at 60 Hz with cells of 0.2 m, not with those of 0.1. What the host moves, a bucket that measures its load, is no such body;
 * nor does one count that stands beside the sand. */
static void test_a_rigid_body_on_sand(void)
{
    static const struct {
        float cell, at;
        bool advanced, told;
    } cases[] = {{0.2f, 2, true, false}, {0.1f, 2, true, true}, {0.1f, 2, false, false}, {0.1f, 6, true, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const pbmpm_world_id world = falling_world(2, cases[i].cell);
        const pbmpm_shape crate = box_shape(cases[i].at, 2, 0, 0.5f, 0.5f, 1);
        create_collider(world, plane_shape(0, 0, 0, 0, 1, 0), false);
        fill_shape(world, create_material(world, PBMPM_SAND), box_shape(2, 0.7f, 0, 2, 0.7f, 1), STILL);
        create_body(world, &crate, 600, cases[i].advanced);
        ask(world);
        TEST_ASSERT_EQUAL_INT(cases[i].told, tells("a rigid body on sand rocks"));
    }
}

static void test_sand_on_a_floor_without_friction(void)
{
    static const struct {
        pbmpm_material_kind kind;
        float friction;
        bool told;
    } cases[] = {{PBMPM_SAND, 0.0f, true}, {PBMPM_SAND, 0.04f, true}, {PBMPM_SAND, 0.06f, false}, {PBMPM_LIQUID, 0.0f, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        pbmpm_world_def def = default_world(2, 0.05f, 8192);
        def.domain_enabled = 1;
        def.domain_friction = cases[i].friction;
        const pbmpm_world_id world = create_world(&def);
        set_gravity(world, 0, -9.81f, 0);
        fill_shape(world, create_material(world, cases[i].kind), box_shape(0.5f, 0.15f, 0, 0.2f, 0.15f, 0.5f), STILL);
        if (cases[i].told) TEST_ASSERT_EQUAL_FLOAT(cases[i].friction, expect(world, PBMPM_ADVICE_NO_FRICTION)->figure);
        else expect_none(world, PBMPM_ADVICE_NO_FRICTION);
        create_collider(world, box_shape(0.5f, -0.1f, 0, 1, 0.11f, 1), false);
        expect_none(world, PBMPM_ADVICE_NO_FRICTION); /* it stands on that */
    }
}

/* A bin with a hole in its floor, 0.4 m above another one or above nothing. With holes of 8, 16 and 24 cells sand goes 1.3, 1.9 and 2.3 cells per substep: where it rests above them only the last
 * is too slow. What falls in does not rest, and goes as it should with 24 cells; with 36, 2.8, it is too fast. */
static void test_sand_that_runs_out(void)
{
    static const struct {
        float cells, high;
        bool told;
    } cases[] = {{8, 0, false}, {16, 0, false}, {24, 0, true}, {24, 0.2f, false}, {36, 0.2f, true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        for (int lands = 0; lands < 2; lands++) {
            const pbmpm_world_id world = falling_world(2, 0.0125f);
            const float half = 0.00625f * cases[i].cells;
            for (int side = -1; side <= 1; side += 2) {
                create_collider(world, box_shape((float)side * (half + 0.4f), -0.05f, 0, 0.4f, 0.05f, 1), false);
                create_collider(world, box_shape((float)side * 0.7f, 0.5f, 0, 0.1f, 0.5f, 1), false);
            }
            if (lands) create_collider(world, box_shape(0, -0.55f, 0, 1, 0.05f, 1), false);
            fill_shape(world, create_material(world, PBMPM_SAND), box_shape(0, 0.15f + cases[i].high, 0, 0.6f, 0.15f, 1), STILL);
            ask(world);
            TEST_ASSERT_EQUAL_INT(cases[i].told && cases[i].high > 0.0f, tells("too fast"));
            TEST_ASSERT_EQUAL_INT(cases[i].told && cases[i].high == 0.0f, tells("too slowly"));
            for (uint32_t n = 0; n < told_count; n++)
                if (strstr(told[n].text, "runs out of a hole")) TEST_ASSERT_FLOAT_WITHIN(1.01f, cases[i].cells, told[n].figure * told[n].figure / (9.81f / 3600 / 0.0125f)); /* to a cell */
        }
}

/* Sand that an obstacle 0.4 or 2.2 m below stops goes 2.3 or 5.5 cells of 0.02 m in a substep, and from an emitter there as fast: a stream is crushed from four on, a block from five. */
static void test_sand_that_lands(void)
{
    for (int high = 0; high < 2; high++)
        for (int emits = 0; emits < 2; emits++) {
            const pbmpm_world_id world = falling_world(2, 0.02f);
            const pbmpm_material_id sand = create_material(world, PBMPM_SAND);
            create_collider(world, box_shape(0, -0.1f, 0, 3, 0.1f, 1), false);
            pbmpm_emitter_def def;
            pbmpm_emitter_id emitter;
            const pbmpm_shape from = sphere_shape(0, high ? 2.3f : 0.4f, 0, 0.05f);
            OK(pbmpm_emitter_def_init(&def, sizeof def));
            def.material = sand;
            def.rate = 0.1f;
            def.region = PBMPM_EMIT_DISC;
            if (emits) OK(pbmpm_emitter_create(world, &def, &from, &emitter));
            else fill_shape(world, sand, box_shape(0, high ? 2.4f : 0.5f, 0, 0.02f, 0.1f, 1), STILL);
            ask(world);
            TEST_ASSERT_FALSE(tells("too flat") && emits);
            TEST_ASSERT_EQUAL_INT(high && !emits, tells("too flat"));
            TEST_ASSERT_EQUAL_INT(high, tells(emits ? "is poured" : "is crushed there"));
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_sand_that_moves);
    RUN_TEST(test_sand_is_of_two_solvers);
    RUN_TEST(test_a_rigid_body_on_sand);
    RUN_TEST(test_sand_on_a_floor_without_friction);
    RUN_TEST(test_sand_that_runs_out);
    RUN_TEST(test_sand_that_lands);
    return UNITY_END();
}
