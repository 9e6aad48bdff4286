/* Emitters, drains, kill bounds and forces through the public interface: ranges, refusals, and books that balance. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "rules.h"

void setUp(void) { rules_set_up(); }
void tearDown(void) { pbmpm_shutdown(); }

static pbmpm_emitter_def default_emitter(pbmpm_material_id material)
{
    pbmpm_emitter_def def;
    OK(pbmpm_emitter_def_init(&def, sizeof def));
    def.material = material;
    return def;
}

static pbmpm_drain_def default_drain(void)
{
    pbmpm_drain_def def;
    OK(pbmpm_drain_def_init(&def, sizeof def));
    return def;
}

static pbmpm_force_def default_force(pbmpm_force_kind kind)
{
    pbmpm_force_def def;
    OK(pbmpm_force_def_init(&def, sizeof def));
    def.kind = kind;
    return def;
}

/* ---- Ranges ---- */

static pbmpm_result offer_emitter(const pbmpm_emitter_def *def, const pbmpm_shape *shape)
{
    pbmpm_emitter_id emitter;
    const pbmpm_result result = pbmpm_emitter_create(good.world, def, shape, &emitter);
    if (result == PBMPM_OK) OK(pbmpm_emitter_destroy(good.world, emitter));
    return result;
}

static pbmpm_result use_emitter(const void *structure)
{
    const pbmpm_shape shape = sphere_shape(1, 1, 0, 0.1f);
    return offer_emitter(structure, &shape);
}

static pbmpm_result use_emitter_shape(const void *structure)
{
    const pbmpm_emitter_def def = default_emitter(good.material);
    return offer_emitter(&def, structure);
}

static void test_ranges_of_emitters(void)
{
    static const rule rules[] = {
        {FIELD(pbmpm_emitter_def, region), INT32, PBMPM_EMIT_VOLUME, PBMPM_EMIT_DISC, false, false},
        {FIELD(pbmpm_emitter_def, enabled), INT32, 0, 1, false, false},
        {FIELD(pbmpm_emitter_def, rate), FLOAT32, 0, 1e12f, false, false},
        {FIELD(pbmpm_emitter_def, speed), FLOAT32, 0, 1e6f, false, false},
        {FIELD(pbmpm_emitter_def, spread), FLOAT32, 0, (float)M_PI, false, false},
        {FIELD(pbmpm_emitter_def, particles_per_axis), FLOAT32, 0.25, 16, false, false},
        {FIELD(pbmpm_emitter_def, fill_limit), FLOAT32, 0.1f, 100, false, false},
        {FIELD(pbmpm_emitter_def, direction[0]), FLOAT32, -INFINITY, INFINITY, false, false},
    };
    static const rule places[] = {{FIELD(pbmpm_shape, radius), FLOAT32, 0, INFINITY, true, false}};
    const pbmpm_emitter_def def = default_emitter(good.material);
    const pbmpm_shape shape = sphere_shape(1, 1, 0, 0.1f);
    CHECK_RULES(rules, def, use_emitter);
    CHECK_RULES(places, shape, use_emitter_shape);
}

static pbmpm_result use_force(const void *structure)
{
    const pbmpm_shape shape = default_shape();
    pbmpm_force_id force;
    const pbmpm_result result = pbmpm_force_create(good.world, structure, &shape, &force);
    if (result == PBMPM_OK) OK(pbmpm_force_destroy(good.world, force));
    return result;
}

static void test_ranges_of_forces(void)
{
    static const rule rules[] = {
        {FIELD(pbmpm_force_def, kind), INT32, PBMPM_FORCE_UNIFORM, PBMPM_FORCE_GRAB, false, false},
        {FIELD(pbmpm_force_def, enabled), INT32, 0, 1, false, false},
        {FIELD(pbmpm_force_def, everywhere), INT32, 0, 1, false, false},
        {FIELD(pbmpm_force_def, falloff), INT32, PBMPM_FALLOFF_NONE, PBMPM_FALLOFF_INVERSE_SQUARE, false, false},
        {FIELD(pbmpm_force_def, range), FLOAT32, 0, 1e9f, false, false},
        {FIELD(pbmpm_force_def, strength), FLOAT32, -1e9f, 1e9f, false, false},
        {FIELD(pbmpm_force_def, direction[1]), FLOAT32, -INFINITY, INFINITY, false, false},
        {FIELD(pbmpm_force_def, velocity[1]), FLOAT32, -1e9f, 1e9f, false, false},
        {FIELD(pbmpm_force_def, spin), FLOAT32, -1e6f, 1e6f, false, false},
    };
    pbmpm_force_def def = default_force(PBMPM_FORCE_UNIFORM);
    def.range = 1.0f;
    CHECK_RULES(rules, def, use_force);
    def = default_force(PBMPM_FORCE_DRAG);
    def.strength = -1e-3f;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, use_force(&def));
    def = default_force(PBMPM_FORCE_UNIFORM);
    def.falloff = PBMPM_FALLOFF_INVERSE_SQUARE; /* its range is 0 */
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, use_force(&def));
}

static pbmpm_result use_bounds(const void *structure) { return pbmpm_world_set_kill_bounds(good.world, structure); }

static void test_ranges_of_kill_bounds(void)
{
    static const rule rules[] = {
        {FIELD(pbmpm_kill_bounds, enabled), INT32, 0, 1, false, false},
        {FIELD(pbmpm_kill_bounds, low[0]), FLOAT32, -1e9f, 10, false, true},
        {FIELD(pbmpm_kill_bounds, high[1]), FLOAT32, -10, 1e9f, true, false},
    };
    pbmpm_kill_bounds bounds;
    OK(pbmpm_kill_bounds_init(&bounds, sizeof bounds));
    for (int a = 0; a < 3; a++) {
        bounds.low[a] = -10;
        bounds.high[a] = 10;
    }
    CHECK_RULES(rules, bounds, use_bounds);
}

/* What an emitter cannot be: endless, huge, or so far away that its particles leave the range of cells. */
static void test_shapes_of_emitters(void)
{
    pbmpm_shape shape = plane_shape(0, 0, 0, 0, 1, 0);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, use_emitter_shape(&shape));
    shape = box_shape(0, 0, 0, 103, 103, 1); /* 2060^2 cells: more than 2^22 */
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, use_emitter_shape(&shape));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_emitter_set(good.world, good.emitter, NULL, &shape));
    shape = box_shape(3e5f, 0, 0, 1, 1, 1);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, use_emitter_shape(&shape));
    const float far_away[3] = {3e5f, 0, 0};
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_emitter_move(good.world, good.emitter, far_away, NULL));
    shape = box_shape(0, 0, 0, 102, 102, 1);
    OK(use_emitter_shape(&shape));
    snapshot_expect_same(&before, good.world, "emitters");
}

static void test_null_pointers_and_sizes(void)
{
    const pbmpm_world_id w = good.world;
    const pbmpm_shape shape = default_shape();
    pbmpm_emitter_id emitter;
    pbmpm_drain_id drain;
    pbmpm_force_id force;
    pbmpm_emitter_def emitter_def = default_emitter(good.material);
    pbmpm_drain_def drain_def = default_drain();
    pbmpm_force_def force_def = default_force(PBMPM_FORCE_RADIAL);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_emitter_def_init(NULL, sizeof emitter_def));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_drain_def_init(NULL, sizeof drain_def));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_force_def_init(NULL, sizeof force_def));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_kill_bounds_init(NULL, sizeof(pbmpm_kill_bounds)));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_emitter_def_init(&emitter_def, 3));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_drain_def_init(&drain_def, 3));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_force_def_init(&force_def, 3));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_kill_bounds_init(&(pbmpm_kill_bounds){0}, 3));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_emitter_create(w, NULL, &shape, &emitter));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_emitter_create(w, &emitter_def, NULL, &emitter));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_emitter_create(w, &emitter_def, &shape, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_emitter_move(w, good.emitter, NULL, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_emitter_status_get(w, good.emitter, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_drain_create(w, NULL, &shape, &drain));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_drain_create(w, &drain_def, NULL, &drain));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_drain_create(w, &drain_def, &shape, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_drain_status_get(w, good.drain, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_set_kill_bounds(w, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_get_kill_bounds(w, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_get_flow(w, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_force_create(w, NULL, &shape, &force));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_force_create(w, &force_def, NULL, &force));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_force_create(w, &force_def, &shape, NULL));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_force_status_get(w, good.force, NULL));
    pbmpm_shape odd = shape;
    odd.size = emitter_def.size = drain_def.size = force_def.size = 5;
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_emitter_create(w, &emitter_def, &shape, &emitter));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_emitter_get(w, good.emitter, &emitter_def, NULL));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_emitter_set(w, good.emitter, &emitter_def, NULL));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_emitter_get(w, good.emitter, NULL, &odd));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_emitter_set(w, good.emitter, NULL, &odd));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_drain_create(w, &drain_def, &shape, &drain));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_drain_get(w, good.drain, &drain_def, NULL));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_drain_set(w, good.drain, &drain_def, NULL));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_drain_get(w, good.drain, NULL, &odd));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_drain_set(w, good.drain, NULL, &odd));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_force_create(w, &force_def, &shape, &force));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_force_get(w, good.force, &force_def, NULL));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_force_set(w, good.force, &force_def, NULL));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_force_get(w, good.force, NULL, &odd));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_force_set(w, good.force, NULL, &odd));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_emitter_status_get(w, good.emitter, &(pbmpm_emitter_status){.size = 5}));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_drain_status_get(w, good.drain, &(pbmpm_drain_status){.size = 5}));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_force_status_get(w, good.force, &(pbmpm_force_status){.size = 5}));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_world_get_flow(w, &(pbmpm_flow){.size = 5}));
    snapshot_expect_same(&before, w, "null pointers and sizes");
}

static void test_capacities(void)
{
    const pbmpm_shape shape = default_shape();
    const pbmpm_emitter_def emitter_def = default_emitter(good.material);
    const pbmpm_drain_def drain_def = default_drain();
    const pbmpm_force_def force_def = default_force(PBMPM_FORCE_UNIFORM);
    pbmpm_emitter_id emitter;
    pbmpm_drain_id drain;
    pbmpm_force_id force;
    for (int i = 1; i < PBMPM_MAX_EMITTERS; i++) OK(pbmpm_emitter_create(good.world, &emitter_def, &shape, &emitter));
    EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_emitter_create(good.world, &emitter_def, &shape, &emitter));
    for (int i = 1; i < PBMPM_MAX_DRAINS; i++) OK(pbmpm_drain_create(good.world, &drain_def, &shape, &drain));
    EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_drain_create(good.world, &drain_def, &shape, &drain));
    for (int i = 1; i < PBMPM_MAX_FORCES; i++) OK(pbmpm_force_create(good.world, &force_def, &shape, &force));
    EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_force_create(good.world, &force_def, &shape, &force));
}

/* ---- What is read back is what was set ---- */

static void test_definitions_are_kept(void)
{
    const pbmpm_shape shape = sphere_shape(5, 5, 0, 0.5f);
    pbmpm_shape back = {.size = sizeof back};
    pbmpm_emitter_def emitter = default_emitter(good.material), emitter_back = {.size = sizeof emitter_back};
    emitter.rate = 0.25f;
    emitter.budget = 7;
    emitter.user_data = UINT64_MAX;
    OK(pbmpm_emitter_set(good.world, good.emitter, &emitter, &shape));
    OK(pbmpm_emitter_get(good.world, good.emitter, &emitter_back, &back));
    TEST_ASSERT_EQUAL_MEMORY(&emitter, &emitter_back, sizeof emitter);
    TEST_ASSERT_EQUAL_MEMORY(&shape, &back, sizeof shape);
    pbmpm_drain_def drain = default_drain(), drain_back = {.size = sizeof drain_back};
    drain.material = good.spare;
    drain.user_data = UINT64_MAX;
    back = (pbmpm_shape){.size = sizeof back};
    OK(pbmpm_drain_set(good.world, good.drain, &drain, &shape));
    pbmpm_drain_def foreign_drain = drain;
    foreign_drain.material.generation++;
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_drain_set(good.world, good.drain, &foreign_drain, NULL));
    OK(pbmpm_drain_get(good.world, good.drain, &drain_back, &back));
    TEST_ASSERT_EQUAL_MEMORY(&drain, &drain_back, sizeof drain);
    TEST_ASSERT_EQUAL_MEMORY(&shape, &back, sizeof shape);
    pbmpm_force_def force = default_force(PBMPM_FORCE_VORTEX), force_back = {.size = sizeof force_back};
    force.strength = 3.5f;
    force.user_data = UINT64_MAX;
    back = (pbmpm_shape){.size = sizeof back};
    OK(pbmpm_force_set(good.world, good.force, &force, &shape));
    OK(pbmpm_force_get(good.world, good.force, &force_back, &back));
    TEST_ASSERT_EQUAL_MEMORY(&force, &force_back, sizeof force);
    TEST_ASSERT_EQUAL_MEMORY(&shape, &back, sizeof shape);
}

/* A definition or a shape that is not given stays as it is, and is not asked for. */
#define CHECK_HALVES(kind, id, changed)                                                                                 \
    do {                                                                                                                \
        const pbmpm_shape ball = sphere_shape(5, 5, 0, 0.5f);                                                           \
        pbmpm_##kind##_def def = {.size = sizeof def};                                                                  \
        pbmpm_shape shape = {.size = sizeof shape};                                                                     \
        OK(pbmpm_##kind##_get(good.world, id, NULL, &shape));                                                           \
        OK(pbmpm_##kind##_set(good.world, id, &(changed), NULL));                                                       \
        pbmpm_shape same = {.size = sizeof same};                                                                       \
        OK(pbmpm_##kind##_get(good.world, id, &def, &same));                                                            \
        TEST_ASSERT_EQUAL_MEMORY(&(changed), &def, sizeof def);                                                         \
        TEST_ASSERT_EQUAL_MEMORY(&shape, &same, sizeof same);                                                           \
        OK(pbmpm_##kind##_set(good.world, id, NULL, &ball));                                                            \
        OK(pbmpm_##kind##_set(good.world, id, NULL, NULL));                                                             \
        OK(pbmpm_##kind##_get(good.world, id, NULL, NULL));                                                             \
        def = (pbmpm_##kind##_def){.size = sizeof def};                                                                 \
        OK(pbmpm_##kind##_get(good.world, id, &def, NULL));                                                             \
        OK(pbmpm_##kind##_get(good.world, id, NULL, &same));                                                            \
        TEST_ASSERT_EQUAL_MEMORY(&(changed), &def, sizeof def);                                                         \
        TEST_ASSERT_EQUAL_MEMORY(&ball, &same, sizeof same);                                                            \
    } while (0)

static void test_halves_are_kept(void)
{
    pbmpm_emitter_def emitter = default_emitter(good.material);
    pbmpm_drain_def drain = default_drain();
    pbmpm_force_def force = default_force(PBMPM_FORCE_VORTEX);
    emitter.rate = 0.25f;
    drain.material = good.spare;
    force.strength = 3.5f;
    CHECK_HALVES(emitter, good.emitter, emitter);
    CHECK_HALVES(drain, good.drain, drain);
    CHECK_HALVES(force, good.force, force);
}

static void test_a_material_in_an_emitter_is_in_use(void)
{
    const pbmpm_emitter_id emitter = create_emitter(good.world, good.spare);
    EXPECT(PBMPM_ERROR_IN_USE, pbmpm_material_destroy(good.world, good.spare));
    OK(pbmpm_emitter_destroy(good.world, emitter));
    OK(pbmpm_material_destroy(good.world, good.spare));
}

/* ---- Books ---- */

static pbmpm_world_id open_world(uint32_t capacity, pbmpm_material_id *material)
{
    pbmpm_world_def def = default_world(2, 0.1f, capacity);
    const pbmpm_world_id world = create_world(&def);
    *material = create_material(world, PBMPM_LIQUID);
    return world;
}

static pbmpm_emitter_status emitter_status(pbmpm_world_id world, pbmpm_emitter_id emitter)
{
    pbmpm_emitter_status status = {.size = sizeof status};
    OK(pbmpm_emitter_status_get(world, emitter, &status));
    return status;
}

static pbmpm_flow flow_of(pbmpm_world_id world)
{
    pbmpm_flow flow = {.size = sizeof flow};
    OK(pbmpm_world_get_flow(world, &flow));
    return flow;
}

/* 40 particles of 0.05^2 m^2 per second: after whole seconds exactly 40 each, for any cut of the time. */
static void test_emission_does_not_depend_on_the_steps(void)
{
    static const int cuts[][2] = {{1, 1}, {2, 3}, {60, 1}, {240, 5}};
    for (size_t k = 0; k < sizeof cuts / sizeof *cuts; k++) {
        pbmpm_material_id water;
        const pbmpm_world_id world = open_world(1000, &water);
        pbmpm_emitter_def def = default_emitter(water);
        pbmpm_emitter_id emitter;
        const pbmpm_shape shape = box_shape(0, 0, 0, 1, 1, 1);
        def.rate = 40 * 0.05f * 0.05f;
        def.fill_limit = 100;
        OK(pbmpm_emitter_create(world, &def, &shape, &emitter));
        set_rate(world, cuts[k][1], 2);
        for (int i = 1; i <= 3 * cuts[k][0]; i++) {
            OK(pbmpm_world_step(world, 1.0f / (float)cuts[k][0]));
            const double due = 40.0 * i / cuts[k][0];
            TEST_ASSERT_TRUE(fabs((double)emitter_status(world, emitter).emitted - due) <= 0.5 + 1e-4);
        }
        const pbmpm_emitter_status status = emitter_status(world, emitter);
        TEST_ASSERT_EQUAL_UINT64(120, status.emitted);
        TEST_ASSERT_DOUBLE_WITHIN(1e-7 * 300, 300.0, status.emitted_mass); /* 1000 kg/m^3, 0.3 m^2: to the rounding of one mass */
        TEST_ASSERT_EQUAL_UINT32(120, world_count(world));
        OK(pbmpm_world_destroy(world));
    }
}

static void test_refusals_are_counted_by_reason(void)
{
    pbmpm_material_id water;
    const pbmpm_world_id world = open_world(50, &water);
    pbmpm_emitter_def def = default_emitter(water);
    pbmpm_emitter_id emitter;
    pbmpm_event event;
    const pbmpm_shape shape = box_shape(0, 0, 0, 2, 2, 1);
    def.rate = 100 * 0.05f * 0.05f;
    def.budget = 30;
    def.fill_limit = 100;
    OK(pbmpm_emitter_create(world, &def, &shape, &emitter));
    OK(pbmpm_world_step(world, 1.0f));
    TEST_ASSERT_EQUAL_UINT64(30, emitter_status(world, emitter).emitted);
    TEST_ASSERT_EQUAL_UINT64(70, emitter_status(world, emitter).refused_budget);
    TEST_ASSERT_EQUAL_UINT32(1, world_events_of(world, PBMPM_EVENT_EMISSION_REFUSED, &event));
    TEST_ASSERT_EQUAL_UINT32(70, event.count);
    def.budget = 0;
    OK(pbmpm_emitter_set(world, emitter, &def, NULL));
    OK(pbmpm_world_step(world, 1.0f));
    const pbmpm_emitter_status status = emitter_status(world, emitter);
    TEST_ASSERT_EQUAL_UINT64(50, status.emitted);
    TEST_ASSERT_EQUAL_UINT64(80, status.refused_capacity);
    TEST_ASSERT_EQUAL_UINT64(150, flow_of(world).refused);
    def.enabled = 0;
    OK(pbmpm_emitter_set(world, emitter, &def, NULL));
    OK(pbmpm_world_step(world, 1.0f));
    TEST_ASSERT_EQUAL_UINT64(150, flow_of(world).refused); /* no time passes for it */
    TEST_ASSERT_EQUAL_UINT32(0, world_events_of(world, PBMPM_EVENT_EMISSION_REFUSED, NULL));
}

/* Fills a room of `side` [m] to five times its volume per second; without a lid it is open above. Returns the share of it that was emitted. */
static double filled_share(int dimension, float side, bool lid, float fill_limit)
{
    pbmpm_world_def room = default_world(dimension, 0.1f, 20000);
    const pbmpm_world_id world = create_world(&room);
    pbmpm_emitter_def def = default_emitter(create_material(world, PBMPM_LIQUID));
    pbmpm_emitter_id emitter;
    const float half = 0.5f * side, volume = dimension == 3 ? side * side * side : side * side;
    for (int axis = 0; axis < dimension; axis++) {
        const float n[3] = {axis == 0, axis == 1, axis == 2};
        create_collider(world, plane_shape(0, 0, 0, n[0], n[1], n[2]), false);
        if (axis != 1 || lid) create_collider(world, plane_shape(side * n[0], side * n[1], side * n[2], -n[0], -n[1], -n[2]), false);
    }
    set_gravity(world, 0, -9.81f, 0);
    const pbmpm_shape shape = box_shape(half, half, half, half, half, half);
    def.rate = 5 * volume;
    def.fill_limit = fill_limit;
    OK(pbmpm_emitter_create(world, &def, &shape, &emitter));
    for (int i = 0; i < 180; i++) OK(pbmpm_world_step(world, 1.0f / 60));
    const double share = emitter_status(world, emitter).emitted * pow(0.05, dimension) / (double)volume;
    OK(pbmpm_world_destroy(world));
    return share;
}

/* However often matter that moves leaves a gap: a closed room takes what it holds, and all of it but for the last particles. Its walls may stand
 * anywhere between the nodes. */
static void test_a_closed_room_takes_no_more_than_it_holds(void)
{
    static const float sides[] = {0.6f, 0.65f, 0.72f};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (size_t i = 0; i < sizeof sides / sizeof *sides; i++) {
            const double share = filled_share(dimension, sides[i], true, 1);
            TEST_ASSERT_TRUE_MESSAGE(share <= 1.0 + 1e-3 && share > 0.96, "a full room");
        }
    const double loose = filled_share(2, 0.6f, true, 0.5f);
    TEST_ASSERT_TRUE_MESSAGE(loose <= 0.5 + 1e-3 && loose > 0.45, "filled by half");
    TEST_ASSERT_TRUE_MESSAGE(filled_share(2, 0.6f, false, 1) > 1.05, "without a lid matter rises");
}

/* A rate that would bring more particles than can be counted to one by one is refused at once. */
static void test_a_monstrous_rate_ends(void)
{
    pbmpm_material_id water;
    const pbmpm_world_id world = open_world(100, &water);
    pbmpm_emitter_def def = default_emitter(water);
    pbmpm_emitter_id emitter;
    const pbmpm_shape shape = default_shape();
    def.rate = 1e12f;
    OK(pbmpm_emitter_create(world, &def, &shape, &emitter));
    for (int i = 0; i < 10; i++) OK(pbmpm_world_step(world, 0.1f));
    const pbmpm_emitter_status status = emitter_status(world, emitter);
    TEST_ASSERT_EQUAL_UINT64(world_count(world), status.emitted);
    TEST_ASSERT_TRUE(status.refused_capacity > 1000000000000u);
    world_expect_finite(world, "monstrous rate");
}

/* Particles fall through a drain; each is counted once, in order of slots, and those of another material pass. */
static void test_drains_count_what_they_take(void)
{
    pbmpm_material_id water;
    const pbmpm_world_id world = open_world(5000, &water);
    const pbmpm_material_id jelly = create_material(world, PBMPM_ELASTIC);
    const float down[3] = {0, -2, 0};
    const uint32_t wet = fill_shape(world, water, box_shape(0, 1, 0, 0.5f, 0.5f, 1), down);
    const uint32_t firm = fill_shape(world, jelly, box_shape(2, 1, 0, 0.5f, 0.5f, 1), down);
    const double mass = world_stats(world).mass;
    pbmpm_drain_def def = default_drain();
    pbmpm_drain_id drains[2];
    const pbmpm_shape shape = plane_shape(0, -0.5f, 0, 0, 1, 0);
    def.material = water;
    for (int k = 0; k < 2; k++) OK(pbmpm_drain_create(world, &def, &shape, &drains[k]));
    for (int i = 0; i < 100; i++) OK(pbmpm_world_step(world, 0.02f));
    pbmpm_drain_status first = {.size = sizeof first}, second = {.size = sizeof second};
    OK(pbmpm_drain_status_get(world, drains[0], &first));
    OK(pbmpm_drain_status_get(world, drains[1], &second));
    TEST_ASSERT_EQUAL_UINT64(wet, first.drained);
    TEST_ASSERT_EQUAL_UINT64(0, second.drained);
    TEST_ASSERT_EQUAL_UINT32(firm, world_count(world));
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * mass, mass, first.drained_mass + world_stats(world).mass);
    TEST_ASSERT_EQUAL_UINT64(wet, flow_of(world).drained);
    TEST_ASSERT_EQUAL_UINT64(0, world_stats(world).deleted_total);
    def.material = (pbmpm_material_id){0, 0};
    OK(pbmpm_drain_set(world, drains[1], &def, NULL));
    OK(pbmpm_world_step(world, 0.02f));
    TEST_ASSERT_EQUAL_UINT32(0, world_count(world));
}

static void test_kill_bounds_tell_of_what_they_take(void)
{
    pbmpm_material_id water;
    const pbmpm_world_id world = open_world(5000, &water);
    const float away[3] = {3, 0, 0};
    const uint32_t all = fill_shape(world, water, box_shape(0, 0, 0, 0.5f, 0.5f, 1), away);
    const double mass = world_stats(world).mass;
    pbmpm_kill_bounds bounds;
    OK(pbmpm_kill_bounds_init(&bounds, sizeof bounds));
    bounds.enabled = 1;
    for (int a = 0; a < 2; a++) {
        bounds.low[a] = -1;
        bounds.high[a] = 1;
    }
    OK(pbmpm_world_set_kill_bounds(world, &bounds));
    uint32_t told = 0;
    for (int i = 0; i < 60; i++) {
        pbmpm_event event;
        const uint32_t was = world_count(world);
        OK(pbmpm_world_step(world, 0.01f));
        if (world_events_of(world, PBMPM_EVENT_KILLED, &event) == 0) continue;
        TEST_ASSERT_EQUAL_UINT32(was - world_count(world), event.count);
        TEST_ASSERT_TRUE(event.position[0] > 1.0f && event.position[0] < 1.1f);
        told += event.count;
        const pbmpm_view places = view_of(world, PBMPM_POSITION);
        for (uint32_t row = 0; row < places.count; row++) TEST_ASSERT_TRUE(view_float(&places, row, 0) <= 1.0f);
    }
    TEST_ASSERT_EQUAL_UINT32(all, told);
    TEST_ASSERT_EQUAL_UINT64(all, flow_of(world).killed);
    TEST_ASSERT_DOUBLE_WITHIN(1e-9 * mass, mass, flow_of(world).killed_mass);
}

/* From one end of the range of cells to the other in a step: it jumps, and the step is none the worse. */
static void test_a_move_across_the_world(void)
{
    pbmpm_material_id water;
    const pbmpm_world_id world = open_world(1000, &water);
    pbmpm_emitter_def def = default_emitter(water);
    pbmpm_emitter_id emitter;
    const pbmpm_shape shape = default_shape();
    def.rate = 100 * 0.05f * 0.05f;
    OK(pbmpm_emitter_create(world, &def, &shape, &emitter));
    OK(pbmpm_emitter_move(world, emitter, (const float[3]){2e5f, -2e5f, 0}, NULL));
    OK(pbmpm_world_step(world, 1.0f));
    TEST_ASSERT_EQUAL_UINT64(100, emitter_status(world, emitter).emitted);
    const pbmpm_view places = view_of(world, PBMPM_POSITION);
    for (uint32_t row = 0; row < places.count; row++) TEST_ASSERT_TRUE(fabsf(view_float(&places, row, 0) - 2e5f) <= 0.6f);
}

/* ---- Memory ---- */

static void use_ledger(pbmpm_world_def *def, void *user) { def->allocator = ledger_allocator(user); }

/* Emission, drains and forces allocate nothing once warm, and what they took is given back. */
static void test_warm_steps_take_no_memory(void)
{
    static ledger book;
    book = (ledger){0};
    const pbmpm_world_id world = tank_2d(use_ledger, &book);
    pbmpm_emitter_def def = default_emitter(create_material(world, PBMPM_LIQUID));
    pbmpm_emitter_id emitter;
    const pbmpm_shape shape = sphere_shape(0.5f, 0.9f, 0, 0.05f);
    def.region = PBMPM_EMIT_DISC;
    def.speed = 1;
    def.rate = 0.1f;
    OK(pbmpm_emitter_create(world, &def, &shape, &emitter));
    create_drain(world, box_shape(0.1f, 0.1f, 0, 0.1f, 0.1f, 1));
    pbmpm_force_def force = default_force(PBMPM_FORCE_VORTEX);
    const pbmpm_shape middle = default_shape();
    pbmpm_force_id whirl;
    OK(pbmpm_force_create(world, &force, &middle, &whirl));
    for (int i = 0; i < 200; i++) OK(pbmpm_world_step(world, 0.005f));
    const uint64_t calls = book.calls;
    for (int i = 0; i < 100; i++) OK(pbmpm_world_step(world, 0.005f));
    TEST_ASSERT_EQUAL_UINT64(calls, book.calls);
    TEST_ASSERT_TRUE(emitter_status(world, emitter).emitted > 10 && flow_of(world).drained > 10);
    OK(pbmpm_world_destroy(world));
    ledger_expect_clean(&book, "emitters, drains and forces");
}

/* Without memory a step is refused, and what it can do later is what it would have done at once. */
static void test_a_step_without_memory_is_made_up_for(void)
{
    static ledger book;
    uint64_t hash[2];
    for (int failing = 0; failing < 2; failing++) {
        book = (ledger){0};
        const pbmpm_world_id world = tank_2d(use_ledger, &book);
        pbmpm_emitter_def def = default_emitter(create_material(world, PBMPM_LIQUID));
        pbmpm_emitter_id emitter;
        pbmpm_force_def force = default_force(PBMPM_FORCE_RADIAL);
        pbmpm_force_id push;
        const pbmpm_shape shape = sphere_shape(0.5f, 0.8f, 0, 0.1f), middle = default_shape();
        def.rate = 1;
        OK(pbmpm_emitter_create(world, &def, &shape, &emitter));
        OK(pbmpm_force_create(world, &force, &middle, &push));
        for (uint64_t step = 0; step < 12; step++) {
            pbmpm_result result = PBMPM_ERROR_OUT_OF_MEMORY;
            for (uint64_t nth = 1; failing && result != PBMPM_OK; nth++) {
                book.fail_at = book.calls + nth;
                book.sticky = false;
                result = pbmpm_world_step(world, 0.01f);
            }
            book.fail_at = 0;
            if (!failing) OK(pbmpm_world_step(world, 0.01f));
        }
        TEST_ASSERT_EQUAL_UINT64(192, emitter_status(world, emitter).emitted + emitter_status(world, emitter).refused_full);
        hash[failing] = world_hash_unordered(world);
        OK(pbmpm_world_destroy(world));
    }
    TEST_ASSERT_EQUAL_UINT64(hash[0], hash[1]);
}

/* What a drain takes and what the library deletes in the same step are both gone. */
static void test_a_drain_beside_a_deletion(void)
{
    const float positions[8] = {0, 0, 5, 0, 0, 5, 5, 5}, torn[4] = {5000, 0, 0, 1e-3f};
    const pbmpm_world_def def = default_world(2, 1.0f, 10);
    const pbmpm_world_id world = create_world(&def);
    pbmpm_material_def jelly = default_material(PBMPM_ELASTIC);
    pbmpm_particles_def particles;
    pbmpm_particle_id ids[4];
    pbmpm_flow flow = {.size = sizeof flow};
    jelly.strain_policy = PBMPM_STRAIN_DELETE;
    set_solver(world, PBMPM_SOLVER_DUAL);
    OK(pbmpm_particles_def_init(&particles, sizeof particles));
    OK(pbmpm_material_create(world, &jelly, &particles.material));
    particles.positions = positions;
    particles.count = 4;
    OK(pbmpm_particles_add(world, &particles, ids));
    OK(pbmpm_particles_set(world, PBMPM_DEFORMATION, &ids[1], 1, torn));
    create_drain(world, box_shape(0, 5, 0, 0.5f, 0.5f, 0.5f));
    OK(pbmpm_world_step(world, 1.0f / 60));
    OK(pbmpm_world_get_flow(world, &flow));
    TEST_ASSERT_EQUAL_UINT64(1, flow.drained);
    TEST_ASSERT_EQUAL_UINT64(1, world_stats(world).deleted_total);
    TEST_ASSERT_EQUAL_UINT32(2, world_count(world));
}

/* A thin nozzle 1/200 cell behind a wall: that is on it, and what comes out is in the domain. */
static void test_particles_are_born_in_the_domain(void)
{
    for (int32_t dimension = 2; dimension <= 3; dimension++)
        for (int place = 0; place < 2 * dimension; place++) {
            const int axis = place / 2, upper = place % 2;
            pbmpm_world_def def = default_world(dimension, 0.1f, 4000);
            pbmpm_emitter_id emitter;
            def.domain_enabled = 1;
            for (int a = 0; a < 3; a++) def.domain_max[a] = 2.0f;
            const pbmpm_world_id world = create_world(&def);
            pbmpm_emitter_def nozzle = default_emitter(create_material(world, PBMPM_LIQUID));
            pbmpm_shape shape = box_shape(1, 1, 1, 0.3f, 0.3f, 0.3f);
            shape.half_extents[axis] = 1e-6f;
            shape.position[axis] = upper ? 2.0005f : -0.0005f;
            nozzle.rate = 100.0f;
            OK(pbmpm_emitter_create(world, &nozzle, &shape, &emitter));
            for (int step = 0; step < 4; step++) {
                OK(pbmpm_world_step(world, 1.0f / 60));
                const pbmpm_view places = view_of(world, PBMPM_POSITION);
                for (uint32_t row = 0; row < places.count; row++) {
                    const float x = view_float(&places, row, (uint32_t)axis);
                    TEST_ASSERT_TRUE_MESSAGE(x >= 0.0f && x <= 2.0f, "outside of the domain");
                }
            }
            TEST_ASSERT_TRUE(world_count(world) > 0);
            OK(pbmpm_world_destroy(world));
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_ranges_of_emitters);
    RUN_TEST(test_ranges_of_forces);
    RUN_TEST(test_ranges_of_kill_bounds);
    RUN_TEST(test_shapes_of_emitters);
    RUN_TEST(test_null_pointers_and_sizes);
    RUN_TEST(test_capacities);
    RUN_TEST(test_definitions_are_kept);
    RUN_TEST(test_halves_are_kept);
    RUN_TEST(test_a_material_in_an_emitter_is_in_use);
    RUN_TEST(test_emission_does_not_depend_on_the_steps);
    RUN_TEST(test_refusals_are_counted_by_reason);
    RUN_TEST(test_a_closed_room_takes_no_more_than_it_holds);
    RUN_TEST(test_a_monstrous_rate_ends);
    RUN_TEST(test_drains_count_what_they_take);
    RUN_TEST(test_kill_bounds_tell_of_what_they_take);
    RUN_TEST(test_a_move_across_the_world);
    RUN_TEST(test_particles_are_born_in_the_domain);
    RUN_TEST(test_warm_steps_take_no_memory);
    RUN_TEST(test_a_step_without_memory_is_made_up_for);
    RUN_TEST(test_a_drain_beside_a_deletion);
    return UNITY_END();
}
