/* Advice of solids: how they roll, bounce, tip and fall, what is too thin, and strain at its bounds. */
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

/* ---- what is foreseen ---- */

/* A disc rolls, a square does not, upright or tilted; two bodies of one material are looked at one by one. A remedy that costs more than half the cell size is none. */
static void test_what_is_round_rolls(void)
{
    static const struct {
        bool disc;
        float tilt, young_modulus;
        bool told, cheap;
    } cases[] = {{true, 0, 2e6f, true, true}, {true, 0, 1e9f, true, false}, {false, 0, 1e6f, false, false}, {false, 0.4f, 1e6f, false, false}, {false, 0.785f, 1e6f, false, false}};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
            const pbmpm_world_id world = falling_world(dimension, 0.05f);
            pbmpm_material_def def = default_material(PBMPM_ELASTIC);
            create_collider(world, box_shape(0, -0.1f, 0, 3, 0.1f, 3), false);
            def.young_modulus = cases[i].cheap && dimension == 2 ? 0.25f * cases[i].young_modulus : cases[i].young_modulus;
            const pbmpm_material_id material = add_material(world, &def);
            for (int body = 0; body < 2; body++) {
                const float at = 1.5f * (float)body;
                pbmpm_shape shape = cases[i].disc ? sphere_shape(at, 0.3f, 0, 0.3f) : box_shape(at, 0.4f, 0, 0.25f, 0.25f, 0.25f);
                shape.rotation[2] = sinf(0.5f * cases[i].tilt);
                shape.rotation[3] = cosf(0.5f * cases[i].tilt);
                fill_shape(world, material, shape, STILL);
            }
            if (!cases[i].told) {
                expect_none(world, PBMPM_ADVICE_ROLLING_BRAKED);
                continue;
            }
            const pbmpm_advice *advice = expect(world, PBMPM_ADVICE_ROLLING_BRAKED);
            TEST_ASSERT_EQUAL_INT(cases[i].cheap ? PBMPM_CHANGE_CELL_SIZE : PBMPM_CHANGE_NONE, advice->change);
            TEST_ASSERT_TRUE(advice->price <= 700.0f);
        }
}

/* Two discs, one of which moves: at 60 Hz they stay together. Where none moves nothing is told, nor where the world has water. */
static void test_bodies_that_hit_each_other(void)
{
    static const struct {
        bool moves, wet, told;
    } cases[] = {{true, false, true}, {false, false, false}, {true, true, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const pbmpm_world_def def = default_world(2, 0.025f, 8192);
        const pbmpm_world_id world = create_world(&def);
        const float speed[3] = {cases[i].moves ? 1.0f : 0.0f, 0, 0};
        for (int body = 0; body < 2; body++) {
            pbmpm_material_def soft = default_material(PBMPM_ELASTIC);
            soft.young_modulus = 1e5f;
            fill_shape(world, add_material(world, &soft), sphere_shape(body ? 0.3f : -0.3f, 0, 0, 0.2f), body ? STILL : speed);
        }
        if (cases[i].wet) fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0, -0.4f, 0, 0.6f, 0.15f, 1), STILL);
        if (!cases[i].told) {
            expect_none(world, PBMPM_ADVICE_BOUNCE_DAMPED);
            continue;
        }
        const pbmpm_advice *advice = expect(world, PBMPM_ADVICE_BOUNCE_DAMPED);
        TEST_ASSERT_EQUAL_INT(PBMPM_CHANGE_SUBSTEPS, advice->change);
        set_rate(world, (int32_t)advice->value, 5);
        expect_none(world, PBMPM_ADVICE_BOUNCE_DAMPED);
    }
}

/* A block on 20 degrees whose weight lies 1.3 cells beyond its edge, well within, or 3.2 and 2.4 cells beyond; leaning on a wall, or beside a ball. */
static void test_what_tips(void)
{
    static const struct {
        float wide;
        bool wall, told;
    } cases[] = {{0.075f, false, true}, {0.075f, true, false}, {0.18f, false, false}, {0.03f, false, false}, {0.05f, false, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const pbmpm_world_def def = default_world(2, 0.025f, 8192);
        const pbmpm_world_id world = create_world(&def);
        set_gravity(world, 9.81f * sinf(0.349f), -9.81f * cosf(0.349f), 0);
        create_collider(world, box_shape(0, -0.1f, 0, 3, 0.1f, 1), false);
        if (cases[i].wall) create_collider(world, box_shape(cases[i].wide + 0.22f, 0.5f, 0, 0.2f, 0.5f, 1), false);
        fill_shape(world, create_material(world, PBMPM_ELASTIC), box_shape(0, 0.3f, 0, cases[i].wide, 0.3f, 1), STILL);
        fill_shape(world, create_material(world, PBMPM_ELASTIC), sphere_shape(-1, 0.2f, 0, 0.2f), STILL);
        ask(world);
        TEST_ASSERT_EQUAL_INT(cases[i].told, tells("it tips too slowly"));
    }
}

/* A jelly lies on a step of sand and hangs over the lower one: it does not fall. */
static void test_a_body_that_hangs_over(void)
{
    for (int lies = 0; lies < 2; lies++) {
        const pbmpm_world_id world = falling_world(2, 0.05f);
        const pbmpm_material_id sand = create_material(world, PBMPM_SAND), jelly = create_material(world, PBMPM_ELASTIC);
        create_collider(world, box_shape(0, -0.1f, 0, 3, 0.1f, 1), false);
        fill_shape(world, sand, box_shape(0, 0.15f, 0, 1, 0.15f, 1), STILL);
        fill_shape(world, sand, box_shape(-0.5f, 0.45f, 0, 0.5f, 0.15f, 1), STILL);
        fill_shape(world, jelly, box_shape(lies ? -0.025f : 0.3f, 0.8f, 0, 0.25f, 0.2f, 1), STILL);
        ask(world);
        TEST_ASSERT_EQUAL_INT(!lies, tells("falls on sand"));
    }
}

/* A body that falls: into a liquid it stays strained and stirs, and a heavier one sinks; on sand it stops too high, soft or stiff. Sand in liquid. Each kind by itself has none. */
static void test_known_limits(void)
{
    static const struct {
        pbmpm_material_kind kind[2];
        float density, young_modulus;
        int limits;
    } cases[] = {{{PBMPM_LIQUID, PBMPM_ELASTIC}, 900, 1e5f, 2}, {{PBMPM_LIQUID, PBMPM_ELASTIC}, 1500, 1e5f, 3}, {{PBMPM_SAND, PBMPM_ELASTIC}, 900, 1e5f, 1},
                 {{PBMPM_SAND, PBMPM_ELASTIC}, 900, 1e8f, 1},   {{PBMPM_LIQUID, PBMPM_SAND}, 0, 1e5f, 1},     {{PBMPM_SAND, PBMPM_SAND}, 0, 1e5f, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const pbmpm_world_id world = falling_world(2, 0.05f);
        for (int k = 0; k < 2; k++) {
            pbmpm_material_def def = default_material(cases[i].kind[k]);
            if (k == 1 && cases[i].density > 0.0f) def.density = cases[i].density;
            def.young_modulus = cases[i].young_modulus;
            fill_shape(world, add_material(world, &def), box_shape(0.5f, 0.3f + (float)k, 0, 0.5f, 0.3f, 0.5f), STILL);
        }
        ask(world);
        int limits = 0;
        for (uint32_t n = 0; n < told_count; n++)
            limits += told[n].code == PBMPM_ADVICE_KNOWN_LIMIT && strncmp(told[n].text, "sand s", 6) != 0 &&
                      strncmp(told[n].text, "sand t", 6) != 0; /* its sides are free */
        TEST_ASSERT_EQUAL_INT(cases[i].limits, limits);
    }
}

/* From how high [cells] above other matter a body falls onto it: a cell of each is at the surface, and neither's. */
static void test_what_is_near_does_not_fall(void)
{
    static const struct {
        pbmpm_material_kind below;
        float high;
        const char *words;
        bool told;
    } cases[] = {{PBMPM_SAND, 3.0f, "falls on sand", false},
                 {PBMPM_SAND, 4.0f, "falls on sand", true},
                 {PBMPM_LIQUID, 1.25f, "fell into a liquid", false},
                 {PBMPM_LIQUID, 1.75f, "fell into a liquid", true},
                 {PBMPM_LIQUID, 1.75f, "goes on moving", false},
                 {PBMPM_LIQUID, 4.0f, "goes on moving", true}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const pbmpm_world_id world = falling_world(2, 0.05f);
        pbmpm_material_def sand = default_material(cases[i].below), body = default_material(PBMPM_ELASTIC);
        body.young_modulus = sand.young_modulus = 1e5f;
        body.density = 900;
        create_collider(world, plane_shape(0, 0, 0, 0, 1, 0), false);
        fill_shape(world, add_material(world, &sand), box_shape(0.5f, 0.3f, 0, 0.5f, 0.3f, 1), STILL);
        fill_shape(world, add_material(world, &body), box_shape(0.5f, 0.9f + 0.05f * cases[i].high, 0, 0.5f, 0.3f, 1), STILL);
        ask(world);
        TEST_ASSERT_EQUAL_INT(cases[i].told, tells(cases[i].words));
    }
}

/* A body that falls along the face of an obstacle falls all the same. */
static void test_a_body_that_falls_along_a_wall(void)
{
    for (int walled = 0; walled < 2; walled++) {
        const pbmpm_world_id world = falling_world(2, 0.05f);
        if (walled) create_collider(world, plane_shape(0, 0, 0, 1, 0, 0), false); /* through nodes, where the body's first cells have their middle */
        fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0.5f, 0.3f, 0, 0.5f, 0.3f, 1), STILL);
        fill_shape(world, create_material(world, PBMPM_ELASTIC), box_shape(0.25f, 1.3f, 0, 0.25f, 0.3f, 1), STILL);
        ask(world);
        TEST_ASSERT_TRUE(tells("fell into a liquid"));
    }
}

/* Below another block, of the same material or not, with so many cells between. Not one that a floor bears, nor one of sand. */
static void test_a_body_that_hangs_on_another(void)
{
    static const struct {
        float gap;
        bool floor, sand, same, told;
    } cases[] = {{0, false, false, false, true},  {1, false, false, false, true}, {2, false, false, false, false}, {3, false, false, false, false},
                 {1, true, false, false, false},  {1, false, true, false, false}, {1.5f, false, false, true, true}, {2, false, false, true, false},
                 {1.2f, false, false, true, true}, {0.8f, false, false, true, true},  {0, false, false, true, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const pbmpm_world_id world = falling_world(2, 0.05f);
        const pbmpm_material_id held = create_material(world, PBMPM_ELASTIC), free_one = cases[i].same ? held : create_material(world, cases[i].sand ? PBMPM_SAND : PBMPM_ELASTIC);
        fill_shape(world, held, box_shape(0, 1, 0, 0.2f, 0.2f, 1), STILL);
        fill_shape(world, free_one, box_shape(0, 0.6f - 0.05f * cases[i].gap, 0, 0.2f, 0.2f, 1), STILL);
        if (cases[i].floor) create_collider(world, plane_shape(0, 0.4f - 0.05f * cases[i].gap, 0, 0, 1, 0), false);
        ask(world);
        TEST_ASSERT_EQUAL_INT(cases[i].told, tells("hangs on the one above"));
    }
}

static void test_a_body_that_is_thin_for_the_grid(void)
{
    const pbmpm_world_id world = falling_world(2, 0.1f);
    const pbmpm_material_id thin = create_material(world, PBMPM_ELASTIC), thick = create_material(world, PBMPM_ELASTIC);
    fill_shape(world, thick, box_shape(0.05f, 0.03f, 0, 0.5f, 0.5f, 0.5f), STILL);
    fill_shape(world, thin, box_shape(3, 0, 0, 0.1f, 1, 0.5f), STILL);
    const pbmpm_advice *advice = expect(world, PBMPM_ADVICE_BODY_TOO_THIN);
    TEST_ASSERT_EQUAL_UINT32(thin.generation, advice->material.generation);
    TEST_ASSERT_FLOAT_WITHIN(0.3f, 2.0f, advice->figure);
    for (uint32_t i = 0; i < told_count; i++)
        TEST_ASSERT_TRUE(told[i].code != PBMPM_ADVICE_BODY_TOO_THIN || told[i].material.generation == thin.generation);
}

/* A ball of 0.2 m and 3e4 Pa is flattened by 6.5 cm under its weight: it bounces from 0.3 m, not from 0.2. */
static void test_a_ball_that_is_soft_for_its_fall(void)
{
    for (int low = 0; low < 2; low++) {
        const pbmpm_world_id world = falling_world(3, 0.05f);
        pbmpm_material_def ball = default_material(PBMPM_ELASTIC);
        ball.young_modulus = 3e4f;
        ball.poisson_ratio = 0.3f;
        create_collider(world, plane_shape(0, 0, 0, 0, 1, 0), false);
        fill_shape(world, add_material(world, &ball), sphere_shape(0, low ? 0.4f : 0.5f, 0, 0.2f), STILL);
        ask(world);
        TEST_ASSERT_EQUAL_INT(low, tells("hardly bounces"));
    }
}

/* ---- what came true ---- */

static void check_clamped(int32_t dimension)
{
    static float crushed[9 * 1000];
    const pbmpm_world_def def = default_world(dimension, 0.1f, 1000);
    const pbmpm_world_id world = create_world(&def);
    const uint32_t d = (uint32_t)dimension;
    const uint32_t count = fill_shape(world, create_material(world, PBMPM_ELASTIC), box_shape(0, 0, 0, 0.2f, 0.2f, 0.2f), STILL);
    expect_none(world, PBMPM_ADVICE_STRAIN_CLAMPED);
    memset(crushed, 0, sizeof crushed);
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t a = 0; a < d; a++) crushed[(i * d + a) * d + (a + 1) % d] = a == 0 && i % 4 == 0 ? 0.1f : 1.0f; /* turned, too */
    OK(pbmpm_particles_set(world, PBMPM_DEFORMATION, NULL, count, crushed));
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 0.25f, expect(world, PBMPM_ADVICE_STRAIN_CLAMPED)->figure);
}

static void test_strain_at_its_bounds(void)
{
    check_clamped(2);
    check_clamped(3);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_round_rolls);
    RUN_TEST(test_bodies_that_hit_each_other);
    RUN_TEST(test_what_tips);
    RUN_TEST(test_a_body_that_hangs_over);
    RUN_TEST(test_known_limits);
    RUN_TEST(test_what_is_near_does_not_fall);
    RUN_TEST(test_a_body_that_falls_along_a_wall);
    RUN_TEST(test_a_body_that_hangs_on_another);
    RUN_TEST(test_a_body_that_is_thin_for_the_grid);
    RUN_TEST(test_a_ball_that_is_soft_for_its_fall);
    RUN_TEST(test_strain_at_its_bounds);
    return UNITY_END();
}
