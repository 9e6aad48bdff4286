/* Baked solids and impulses through the public interface: the life of a solid, hollows that hold matter, and momentum that matter and
 * obstacles exchange, to the last part in 100,000. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "meshes.h"
#include "rules.h"

static Mesh mesh;
static struct {
    void *data;
    uint64_t bytes;
} baked;

void setUp(void) {}

void tearDown(void)
{
    free(baked.data);
    baked.data = NULL;
    pbmpm_shutdown();
}

static void bake_now(int32_t resolution)
{
    const pbmpm_mesh_def def = mesh_def_of(&mesh, resolution);
    free(baked.data);
    OK(pbmpm_bake_mesh(&def, NULL, 0, &baked.bytes));
    baked.data = malloc(baked.bytes);
    OK(pbmpm_bake_mesh(&def, baked.data, baked.bytes, &baked.bytes));
}

static void bake_ball(int32_t dimension, double radius)
{
    mesh_clear(&mesh, dimension);
    mesh_add_ball(&mesh, 0, 0, 0, radius, 16);
    bake_now(24);
}

static pbmpm_baked_id load(pbmpm_world_id world)
{
    pbmpm_baked_id id;
    OK(pbmpm_baked_create(world, baked.data, baked.bytes, &id));
    return id;
}

static pbmpm_shape baked_shape(pbmpm_baked_id id, float x, float y, float z)
{
    pbmpm_shape shape;
    OK(pbmpm_shape_init(&shape, sizeof shape));
    shape.kind = PBMPM_BAKED;
    shape.baked = id;
    shape.position[0] = x;
    shape.position[1] = y;
    shape.position[2] = z;
    return shape;
}

static pbmpm_world_id open_world(int32_t dimension, uint32_t capacity)
{
    const pbmpm_world_def def = default_world(dimension, 0.1f, capacity);
    return create_world(&def);
}

/* ---- Definitions ---- */

static pbmpm_result use_mesh(const void *structure)
{
    uint64_t bytes;
    return pbmpm_bake_mesh(structure, NULL, 0, &bytes);
}

static pbmpm_result use_heights(const void *structure)
{
    uint64_t bytes;
    return pbmpm_bake_heights(structure, NULL, 0, &bytes);
}

static void test_ranges(void)
{
    static float heights[6] = {0, 1, 2, 1, 0, 1};
    static const rule of_meshes[] = {
        {FIELD(pbmpm_mesh_def, dimension), INT32, 2, 3, false, false},
        {FIELD(pbmpm_mesh_def, resolution), INT32, 4, INFINITY, false, false}, /* the largest depends on the form */
        {FIELD(pbmpm_mesh_def, vertex_count), UINT32, 1, INFINITY, true, false},
        {FIELD(pbmpm_mesh_def, element_count), UINT32, 1, INFINITY, false, false},
    };
    static const rule of_heights[] = {
        {FIELD(pbmpm_heights_def, dimension), INT32, 2, 3, false, false},
        {FIELD(pbmpm_heights_def, up), INT32, 0, 2, false, false},
        {FIELD(pbmpm_heights_def, count[0]), UINT32, 2, INFINITY, false, false},
        {FIELD(pbmpm_heights_def, count[1]), UINT32, 2, INFINITY, false, false},
        {FIELD(pbmpm_heights_def, spacing[1]), FLOAT32, (double)1e-6f, 1e6, false, false},
        {FIELD(pbmpm_heights_def, thickness), FLOAT32, (double)1e-6f, 1e6, false, false},
    };
    rules_set_up();
    mesh_clear(&mesh, 3);
    mesh_add_ball(&mesh, 0, 0, 0, 1, 6);
    const pbmpm_mesh_def made = mesh_def_of(&mesh, 8);
    CHECK_RULES(of_meshes, made, use_mesh);
    pbmpm_heights_def field;
    OK(pbmpm_heights_def_init(&field, sizeof field));
    field.count[0] = 2;
    field.count[1] = 2;
    field.heights = heights;
    field.resolution = 4;
    CHECK_RULES(of_heights, field, use_heights);
}

/* ---- The life of a solid ---- */

static void test_definitions_have_the_documented_defaults(void)
{
    pbmpm_mesh_def made;
    pbmpm_heights_def heights;
    memset(&made, 0xA5, sizeof made);
    memset(&heights, 0xA5, sizeof heights);
    OK(pbmpm_mesh_def_init(&made, sizeof made));
    OK(pbmpm_heights_def_init(&heights, sizeof heights));
    TEST_ASSERT_TRUE(made.dimension == 3 && made.resolution == 64 && !made.vertices && !made.elements && !made.vertex_count && !made.element_count);
    TEST_ASSERT_TRUE(heights.dimension == 3 && heights.up == 1 && heights.resolution == 0 && !heights.heights && !heights.count[0]);
    TEST_ASSERT_TRUE(heights.spacing[0] == 1.0f && heights.spacing[1] == 1.0f && heights.thickness == 1.0f);
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_mesh_def_init(&made, sizeof made - 1));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_heights_def_init(NULL, sizeof heights));
}

static void test_a_solid_is_inspected_loaded_shared_and_destroyed(void)
{
    pbmpm_baked_info info = {.size = sizeof info}, loaded = {.size = sizeof loaded};
    const pbmpm_world_id world = open_world(3, 100);
    bake_ball(3, 1.5);
    OK(pbmpm_baked_inspect(baked.data, baked.bytes, &info));
    TEST_ASSERT_EQUAL_INT32(3, info.dimension);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.125f, info.spacing);
    TEST_ASSERT_EQUAL_UINT64(baked.bytes, info.bytes);
    for (int a = 0; a < 3; a++) {
        TEST_ASSERT_EQUAL_UINT32(29, info.count[a]);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, -1.75f, info.minimum[a]);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, 1.75f, info.maximum[a]);
    }
    const pbmpm_baked_id id = load(world);
    memset(baked.data, 0, baked.bytes); /* the world has a copy */
    OK(pbmpm_baked_get(world, id, &loaded));
    TEST_ASSERT_EQUAL_MEMORY(&info, &loaded, sizeof info);
    const pbmpm_collider_id one = create_collider(world, baked_shape(id, 0, 0, 0), true), two = create_collider(world, baked_shape(id, 5, 0, 0), false);
    EXPECT(PBMPM_ERROR_IN_USE, pbmpm_baked_destroy(world, id));
    OK(pbmpm_collider_destroy(world, one));
    EXPECT(PBMPM_ERROR_IN_USE, pbmpm_baked_destroy(world, id));
    OK(pbmpm_collider_destroy(world, two));
    OK(pbmpm_baked_destroy(world, id));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_baked_destroy(world, id));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_baked_get(world, id, &loaded));
}

static void test_solids_that_do_not_fit(void)
{
    const pbmpm_world_id world = open_world(3, 100), other = open_world(3, 100);
    pbmpm_baked_id id;
    pbmpm_collider_def def;
    pbmpm_collider_id collider;
    bake_ball(2, 1.0);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_baked_create(world, baked.data, baked.bytes, &id));
    EXPECT(PBMPM_ERROR_DAMAGED, pbmpm_baked_create(world, baked.data, baked.bytes - 1, &id));
    TEST_ASSERT_TRUE(id.index == 0 && id.generation == 0);
    bake_ball(3, 1.0);
    id = load(other);
    OK(pbmpm_collider_def_init(&def, sizeof def));
    def.shape = baked_shape(id, 0, 0, 0);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_create(world, &def, &collider)); /* another world's */
    OK(pbmpm_baked_destroy(other, id));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_create(other, &def, &collider)); /* stale */
}

static void test_as_many_solids_as_documented(void)
{
    const pbmpm_world_id world = open_world(2, 100);
    pbmpm_baked_id id;
    mesh_clear(&mesh, 2);
    mesh_add_ball(&mesh, 0, 0, 0, 1, 3);
    bake_now(4);
    for (int i = 0; i < PBMPM_MAX_BAKED; i++) load(world);
    EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_baked_create(world, baked.data, baked.bytes, &id));
}

static void test_memory_of_solids(void)
{
    static ledger book;
    book = (ledger){0};
    pbmpm_world_def def = default_world(2, 0.1f, 100);
    pbmpm_baked_id id;
    def.allocator = ledger_allocator(&book);
    const pbmpm_world_id world = create_world(&def);
    bake_ball(2, 1.0);
    for (int refused = 1; refused <= 2; refused++) { /* the table, then the values */
        book.fail_at = book.calls + (uint64_t)refused;
        EXPECT(PBMPM_ERROR_OUT_OF_MEMORY, pbmpm_baked_create(world, baked.data, baked.bytes, &id));
    }
    book.fail_at = 0;
    const pbmpm_baked_id first = load(world);
    load(world);
    OK(pbmpm_baked_destroy(world, first));
    OK(pbmpm_world_destroy(world));
    ledger_expect_clean(&book, "solids");
}

/* Particles fill, and are found in, a baked ball as they would a real one: pi r^2, 4/3 pi r^3. */
static void test_solids_are_filled_queried_and_emptied(void)
{
    static const double content[] = {0, 0, 3.14159, 4.18879};
    for (int32_t d = 2; d <= 3; d++) {
        const pbmpm_world_id world = open_world(d, 60000);
        bake_ball(d, 1.0);
        const pbmpm_shape ball = baked_shape(load(world), 0.3f, 0.2f, 0.1f);
        const uint32_t added = fill_shape(world, create_material(world, PBMPM_LIQUID), ball, (const float[3]){0, 0, 0});
        TEST_ASSERT_DOUBLE_WITHIN(0.03 * content[d], content[d], added * pow(0.05, d));
        uint32_t count = 0;
        OK(pbmpm_query_shape(world, &ball, NULL, 0, &count));
        TEST_ASSERT_TRUE(count > 0.95 * added && count <= added); /* jitter */
        const pbmpm_collider_id collider = create_collider(world, ball, false);
        OK(pbmpm_query_collider(world, collider, NULL, 0, &count));
        TEST_ASSERT_TRUE(count > 0.9 * added && count <= added);
        OK(pbmpm_particles_remove_in(world, &ball, &count));
        TEST_ASSERT_EQUAL_UINT32(added - count, world_count(world));
    }
}

/* ---- Hollows ---- */

/* A box of walls `thick` with a hollow of half width 1. */
static void bake_container(int32_t dimension, double thick)
{
    static const double centre[3] = {0};
    const double outer[3] = {1 + thick, 1 + thick, 1 + thick}, inner[3] = {1, 1, 1};
    mesh_clear(&mesh, dimension);
    mesh_add_box(&mesh, centre, outer);
    const uint32_t first = mesh.elements;
    mesh_add_box(&mesh, centre, inner);
    mesh_turn_over(&mesh, first);
    bake_now(48);
}

/* How far [m] a particle is outside the hollow of a turned container, at most. */
static double outside(pbmpm_world_id world, const float position[3], double angle)
{
    const pbmpm_view view = view_of(world, PBMPM_POSITION);
    double most = 0.0;
    for (uint32_t i = 0; i < view.count; i++) {
        const double x = (double)view_float(&view, i, 0) - (double)position[0], y = (double)view_float(&view, i, 1) - (double)position[1];
        const double local[2] = {x * cos(angle) + y * sin(angle), y * cos(angle) - x * sin(angle)};
        most = fmax(most, fmax(fabs(local[0]), fabs(local[1])) - 1.0);
        if (view.components == 3) most = fmax(most, fabs((double)view_float(&view, i, 2)) - 1.0);
    }
    return most;
}

/* A container that turns and shakes keeps all that is in it; grid error and rounded corners are within a tenth of a cell, and what
 * pushing out allows is a cell. */
static void check_container(int32_t dimension, pbmpm_solver solver, pbmpm_friction friction)
{
    const pbmpm_world_id world = open_world(dimension, 21000);
    bake_container(dimension, 0.3);
    pbmpm_settings settings = default_settings();
    settings.solver = solver;
    settings.gravity[1] = -9.81f;
    settings.iterations = 8;
    settings.substeps = 2;
    OK(pbmpm_world_set_settings(world, &settings));
    pbmpm_collider_def def;
    pbmpm_collider_id collider;
    OK(pbmpm_collider_def_init(&def, sizeof def));
    def.shape = baked_shape(load(world), 0, 0, 0);
    def.kinematic = 1;
    def.friction = friction;
    OK(pbmpm_collider_create(world, &def, &collider));
    const uint32_t added = fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0, -0.4f, 0, 0.9f, 0.4f, 0.9f), (const float[3]){3, 2, 0});
    const int steps = dimension == 3 ? 60 : 240;
    for (int i = 1; i <= steps; i++) {
        const double angle = 0.02 * i;
        const float position[3] = {0.3f * sinf(0.1f * (float)i), 0, 0}, rotation[4] = {0, 0, (float)sin(0.5 * angle), (float)cos(0.5 * angle)};
        OK(pbmpm_collider_move(world, collider, position, rotation));
        OK(pbmpm_world_step(world, 1.0f / 60));
        TEST_ASSERT_TRUE(outside(world, position, angle) < 0.1);
    }
    TEST_ASSERT_EQUAL_UINT32(added, world_count(world));
    uint32_t inside = 0;
    OK(pbmpm_query_collider(world, collider, NULL, 0, &inside));
    TEST_ASSERT_TRUE(inside < added / 50);
}

static void test_a_turning_container_keeps_its_contents(void)
{
    check_container(2, PBMPM_SOLVER_PAPER, PBMPM_FRICTION_COULOMB);
    check_container(2, PBMPM_SOLVER_DUAL, PBMPM_FRICTION_COULOMB);
    check_container(2, PBMPM_SOLVER_PAPER, PBMPM_FRICTION_SLIP);
    check_container(2, PBMPM_SOLVER_PAPER, PBMPM_FRICTION_STICK);
    check_container(3, PBMPM_SOLVER_PAPER, PBMPM_FRICTION_COULOMB);
}

/* Fast matter meets the far wall of a hollow, and passes the end of a wall, where planes that a convex solid would allow would hold it. */
static double fly(pbmpm_world_id world, float x, float y, float vx, int steps)
{
    const pbmpm_material_id matter = create_material(world, PBMPM_ELASTIC);
    fill_shape(world, matter, box_shape(x, y, 0, 0.1f, 0.1f, 0.1f), (const float[3]){vx, 0, 0});
    for (int i = 0; i < steps; i++)
        OK(pbmpm_world_step(world, 1.0f / 60));
    const pbmpm_view position = view_of(world, PBMPM_POSITION);
    double most = -INFINITY;
    for (uint32_t i = 0; i < position.count; i++) most = fmax(most, (double)view_float(&position, i, 0));
    return most;
}

static void test_fast_matter_stops_at_the_far_wall(void)
{
    const pbmpm_world_id world = open_world(2, 100);
    bake_container(2, 0.3);
    create_collider(world, baked_shape(load(world), 0, 0, 0), false);
    TEST_ASSERT_TRUE(fly(world, -0.8f, 0, 90, 3) < 1.01); /* 15 cells per step */
}

static void test_fast_matter_passes_beside_a_bump(void)
{
    const pbmpm_world_id world = open_world(2, 100);
    mesh_clear(&mesh, 2); /* an L: a floor with a wall at its left end that does not reach the matter */
    mesh_add_box(&mesh, (const double[3]){0, -1, 0}, (const double[3]){2, 0.3, 0});
    mesh_add_box(&mesh, (const double[3]){-1.5, -0.6, 0}, (const double[3]){0.3, 0.8, 0});
    bake_now(64);
    create_collider(world, baked_shape(load(world), 0, 0, 0), false);
    TEST_ASSERT_DOUBLE_WITHIN(0.15, -2.5 + 0.1 + 60.0 * 5 / 60, fly(world, -2.5f, 0.55f, 60, 5));
}

/* ---- Impulses ---- */

typedef struct exchange {
    pbmpm_world_id world;
    pbmpm_collider_id collider;
    pbmpm_stats stats;
    double angular[3]; /* of matter, from all forces but gravity */
} exchange;

static pbmpm_impulse impulse_of(pbmpm_world_id world, pbmpm_collider_id collider)
{
    pbmpm_impulse impulse = {.size = sizeof impulse};
    OK(pbmpm_collider_impulse(world, collider, &impulse));
    return impulse;
}

static pbmpm_impulse wall_impulse(pbmpm_world_id world, int32_t axis, int32_t upper)
{
    pbmpm_impulse impulse = {.size = sizeof impulse};
    OK(pbmpm_domain_impulse(world, axis, upper, &impulse));
    return impulse;
}

static const float DT = 1.0f / 120, PULL = -9.81f;

static exchange make_exchange(int32_t dimension, pbmpm_solver solver, pbmpm_material_kind kind, float wall_friction, int32_t substeps, bool measure)
{
    pbmpm_world_def def = default_world(dimension, 0.1f, 9000);
    def.domain_enabled = 1;
    for (int a = 0; a < 3; a++) def.domain_max[a] = 1.6f;
    def.domain_friction = wall_friction;
    def.domain_measures_impulse = measure;
    exchange e = {.world = create_world(&def)};
    pbmpm_settings settings = default_settings();
    settings.gravity[1] = PULL;
    settings.solver = solver;
    settings.substeps = substeps;
    settings.iterations = solver == PBMPM_SOLVER_EXPLICIT ? 1 : 6;
    OK(pbmpm_world_set_settings(e.world, &settings));
    pbmpm_material_def material;
    pbmpm_material_id id;
    OK(pbmpm_material_def_init(&material, sizeof material));
    material.kind = kind;
    material.young_modulus = 2e4f;
    if (kind == PBMPM_LIQUID && solver >= PBMPM_SOLVER_PRIMAL) material.bulk_modulus = 2e4f;
    if (kind == PBMPM_LIQUID && solver == PBMPM_SOLVER_DUAL) material.kinematic_viscosity = 0.02f;
    OK(pbmpm_material_create(e.world, &material, &id));
    fill_shape(e.world, id, box_shape(0.5f, 0.6f, 0.6f, 0.4f, 0.4f, 0.4f), (const float[3]){2, -1, 0.5f});
    pbmpm_collider_def collider;
    OK(pbmpm_collider_def_init(&collider, sizeof collider));
    bake_ball(dimension, 0.35);
    collider.shape = baked_shape(load(e.world), 0.9f, 0.3f, 0.7f);
    collider.kinematic = 1;
    collider.friction_coefficient = 0.5f;
    collider.measures_impulse = measure;
    OK(pbmpm_collider_create(e.world, &collider, &e.collider));
    return e;
}

static void step_exchange(exchange *e, int step)
{
    const float angle = 0.02f * (float)step;
    const float position[3] = {0.9f - 0.004f * (float)step, 0.3f + 0.002f * (float)step, 0.7f}, rotation[4] = {0, 0, sinf(angle), cosf(angle)};
    OK(pbmpm_collider_move(e->world, e->collider, position, rotation));
    OK(pbmpm_world_step(e->world, DT));
    e->stats = world_stats(e->world);
}

/* Matter's momentum changes by gravity * mass * dt less what colliders and walls got, in each step, to 1e-5 of all that was exchanged. */
static void check_books(int32_t dimension, pbmpm_solver solver, pbmpm_material_kind kind, float wall_friction)
{
    exchange e = make_exchange(dimension, solver, kind, wall_friction, solver == PBMPM_SOLVER_EXPLICIT ? 8 : 2, true);
    double touched = 0.0;
    e.stats = world_stats(e.world);
    const int steps = dimension == 3 ? 30 : 60;
    for (int step = 1; step <= steps; step++) {
        const pbmpm_stats old = e.stats;
        step_exchange(&e, step);
        TEST_ASSERT_EQUAL_UINT64(0, e.stats.clamped_total + e.stats.deleted_total);
        pbmpm_impulse all = impulse_of(e.world, e.collider);
        const double weight = e.stats.mass * (double)PULL * (double)DT;
        double size = fabs(weight);
        for (int a = 0; a < dimension; a++) touched += fabs(all.linear[a]);
        for (int32_t axis = 0; axis < dimension; axis++)
            for (int32_t upper = 0; upper < 2; upper++) {
                const pbmpm_impulse one = wall_impulse(e.world, axis, upper);
                for (int a = 0; a < 3; a++) {
                    all.linear[a] += one.linear[a];
                    size += fabs(one.linear[a]);
                }
            }
        for (int a = 0; a < dimension; a++) {
            const double missing = e.stats.momentum[a] - old.momentum[a] + all.linear[a] - (a == 1 ? weight : 0.0);
            TEST_ASSERT_DOUBLE_WITHIN(1e-5 * (size + fabs(impulse_of(e.world, e.collider).linear[a])), 0.0, missing);
        }
    }
    TEST_ASSERT_TRUE(touched > 0.0);
}

static void check_books_of(pbmpm_solver solver)
{
    for (int32_t d = 2; d <= 3; d++) {
        check_books(d, solver, PBMPM_LIQUID, 0.0f);
        check_books(d, solver, PBMPM_LIQUID, 0.3f);
        check_books(d, solver, PBMPM_ELASTIC, 0.3f);
    }
}

static void test_books_of_the_papers_solver(void) { check_books_of(PBMPM_SOLVER_PAPER); }
static void test_books_of_the_dual_solver(void) { check_books_of(PBMPM_SOLVER_DUAL); }
static void test_books_of_the_primal_solver(void) { check_books_of(PBMPM_SOLVER_PRIMAL); }
static void test_books_of_the_explicit_solver(void) { check_books_of(PBMPM_SOLVER_EXPLICIT); }

/* Measuring changes nothing else, and does not depend on threads. */
static void run_exchange(int32_t threads, bool measure, uint64_t *hash, pbmpm_impulse *impulse)
{
    exchange e = make_exchange(2, PBMPM_SOLVER_PAPER, PBMPM_LIQUID, 0.3f, 2, measure);
    (void)threads;
    for (int step = 1; step <= 40; step++) step_exchange(&e, step);
    *hash = world_hash(e.world);
    if (measure) *impulse = impulse_of(e.world, e.collider);
}

static void test_measuring_changes_nothing(void)
{
    uint64_t with, without;
    pbmpm_impulse impulse;
    run_exchange(1, true, &with, &impulse);
    run_exchange(1, false, &without, &impulse);
    TEST_ASSERT_EQUAL_HEX64(without, with);
}

static void test_impulses_that_nobody_measures(void)
{
    const exchange e = make_exchange(2, PBMPM_SOLVER_PAPER, PBMPM_LIQUID, 0.0f, 1, false);
    pbmpm_impulse impulse = {.size = sizeof impulse};
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_collider_impulse(e.world, e.collider, &impulse));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_domain_impulse(e.world, 0, 0, &impulse));
    const exchange measured = make_exchange(2, PBMPM_SOLVER_PAPER, PBMPM_LIQUID, 0.0f, 1, true);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_domain_impulse(measured.world, 2, 0, &impulse));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_domain_impulse(measured.world, 0, 2, &impulse));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_collider_impulse(measured.world, e.collider, &impulse));
    impulse.size--;
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_collider_impulse(measured.world, measured.collider, &impulse));
}

/* Water at rest on a floor of many plates presses on each with its weight; more plates meet in one block than it has notes for. */
static void test_many_plates_share_the_weight(void)
{
    enum { PLATES = 16 };
    pbmpm_world_def def = default_world(2, 0.1f, 4000);
    const pbmpm_world_id world = create_world(&def);
    pbmpm_collider_id plate[PLATES];
    set_gravity(world, 0, -10, 0);
    set_rate(world, 2, 10);
    for (int i = 0; i < PLATES; i++) {
        pbmpm_collider_def made;
        OK(pbmpm_collider_def_init(&made, sizeof made));
        made.shape = box_shape(0.05f + 0.1f * (float)i, -0.2f, 0, 0.05f, 0.2f, 0.5f);
        made.measures_impulse = 1;
        OK(pbmpm_collider_create(world, &made, &plate[i]));
    }
    for (int side = 0; side < 2; side++) {
        pbmpm_collider_def made;
        pbmpm_collider_id wall;
        OK(pbmpm_collider_def_init(&made, sizeof made));
        made.shape = plane_shape(side ? 1.6f : 0, 0, 0, side ? -1 : 1, 0, 0);
        made.friction = PBMPM_FRICTION_SLIP; /* bears no weight */
        OK(pbmpm_collider_create(world, &made, &wall));
    }
    fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0.8f, 0.3f, 0, 0.8f, 0.3f, 0.5f), (const float[3]){0, 0, 0});
    double sum = 0.0, mass = 0.0;
    for (int step = 0; step < 240; step++) {
        OK(pbmpm_world_step(world, 1.0f / 120));
        for (int i = 0; i < PLATES && step >= 120; i++) sum += impulse_of(world, plate[i]).linear[1];
        mass = world_stats(world).mass;
    }
    TEST_ASSERT_DOUBLE_WITHIN(0.02 * mass * 10, -mass * 10, sum); /* over a second */
}

/* A turned force: what a spinning stick-rough ball gives to matter around it is taken from its own angular impulse. */
static void check_torque(pbmpm_solver solver)
{
    pbmpm_world_def def = default_world(2, 0.1f, 4000);
    const pbmpm_world_id world = create_world(&def);
    pbmpm_settings settings = default_settings();
    settings.solver = solver;
    settings.iterations = 6;
    OK(pbmpm_world_set_settings(world, &settings));
    pbmpm_collider_def made;
    pbmpm_collider_id ball;
    OK(pbmpm_collider_def_init(&made, sizeof made));
    made.shape = sphere_shape(1.0f, 0.5f, 0, 0.4f);
    made.kinematic = made.measures_impulse = 1;
    made.friction = PBMPM_FRICTION_STICK;
    OK(pbmpm_collider_create(world, &made, &ball));
    const pbmpm_material_id jelly = create_material(world, PBMPM_ELASTIC);
    const pbmpm_shape hole = sphere_shape(1.0f, 0.5f, 0, 0.4f);
    fill_shape(world, jelly, sphere_shape(1.0f, 0.5f, 0, 0.9f), (const float[3]){0, 0, 0});
    OK(pbmpm_particles_remove_in(world, &hole, NULL));
    const float position[3] = {1.0f, 0.5f, 0};
    double given = 0.0;
    for (int step = 1; step <= 10; step++) {
        const float angle = 0.01f * (float)step, rotation[4] = {0, 0, sinf(0.5f * angle), cosf(0.5f * angle)};
        const pbmpm_stats old = world_stats(world);
        OK(pbmpm_collider_move(world, ball, position, rotation));
        OK(pbmpm_world_step(world, 1.0f / 120));
        const pbmpm_stats now = world_stats(world);
        const pbmpm_impulse impulse = impulse_of(world, ball);
        const double about_origin = impulse.angular[2] + (double)position[0] * impulse.linear[1] - (double)position[1] * impulse.linear[0];
        TEST_ASSERT_DOUBLE_WITHIN(1e-3 * (fabs(about_origin) + 1.0), -about_origin, now.angular_momentum[2] - old.angular_momentum[2]);
        TEST_ASSERT_TRUE(impulse.angular[0] == 0.0 && impulse.angular[1] == 0.0);
        given -= impulse.angular[2];
    }
    TEST_ASSERT_TRUE(given > 10.0); /* it did turn */
}

static void test_angular_impulses(void)
{
    check_torque(PBMPM_SOLVER_PAPER);
    check_torque(PBMPM_SOLVER_DUAL);
}

/* ---- A body that floats ---- */

/* The mean height of a box's middle over the last seconds. The box has `share` of the water's density, half extents of 0.25 and 0.3 m, and
 * moves up and down alone. */
static double float_box(double share, double *level)
{
    enum { RATE = 120, SECONDS = 7, MEASURED = 4 };
    pbmpm_world_def def = default_world(2, 0.05f, 9000);
    def.domain_enabled = 1;
    for (int a = 0; a < 2; a++) def.domain_min[a] = -1;
    def.domain_max[0] = 1;
    def.domain_max[1] = 1.5f;
    const pbmpm_world_id world = create_world(&def);
    pbmpm_settings settings = default_settings();
    settings.gravity[1] = PULL;
    settings.solver = PBMPM_SOLVER_DUAL;
    settings.substeps = 2;
    settings.iterations = 20;
    OK(pbmpm_world_set_settings(world, &settings));
    const uint32_t count = fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0, -0.5f, 0, 1, 0.5f, 0), (const float[3]){0, 0, 0});
    pbmpm_collider_def made;
    pbmpm_collider_id box;
    OK(pbmpm_collider_def_init(&made, sizeof made));
    made.shape = box_shape(0, 0.35f, 0, 0.25f, 0.3f, 0);
    made.kinematic = made.measures_impulse = 1;
    made.friction_coefficient = 0;
    OK(pbmpm_collider_create(world, &made, &box));
    const double area = 0.5 * 0.6, mass = share * 1000.0 * area, dt = 1.0 / RATE;
    double y = 0.35, v = 0.0, sum = 0.0;
    for (int step = 0; step < SECONDS * RATE; step++) {
        y = fmax(y + v * dt, -0.7); /* the ground */
        v = y > -0.7 ? v : 0.0;
        const float position[3] = {0, (float)y, 0};
        OK(pbmpm_collider_move(world, box, position, NULL));
        OK(pbmpm_world_step(world, (float)dt));
        v += (double)PULL * dt + impulse_of(world, box).linear[1] / mass;
        if (step >= (SECONDS - MEASURED) * RATE) sum += y;
    }
    *level = -1.0 + (count * 0.025 * 0.025 + fmin(share, 1.0) * area) / 2.0; /* what it displaces stands beside it */
    return sum / (MEASURED * RATE);
}

static void test_a_light_box_floats_at_its_depth(void)
{
    double level;
    const double y = float_box(0.5, &level);
    TEST_ASSERT_DOUBLE_WITHIN(0.05 * 0.3, 0.3, level - (y - 0.3)); /* half of 0.6 m, within 5 % */
}

static void test_a_heavy_box_sinks(void)
{
    double level;
    TEST_ASSERT_DOUBLE_WITHIN(0.01, -0.7, float_box(2.0, &level));
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_ranges);
    RUN_TEST(test_definitions_have_the_documented_defaults);
    RUN_TEST(test_a_solid_is_inspected_loaded_shared_and_destroyed);
    RUN_TEST(test_solids_that_do_not_fit);
    RUN_TEST(test_as_many_solids_as_documented);
    RUN_TEST(test_memory_of_solids);
    RUN_TEST(test_solids_are_filled_queried_and_emptied);
    RUN_TEST(test_a_turning_container_keeps_its_contents);
    RUN_TEST(test_fast_matter_stops_at_the_far_wall);
    RUN_TEST(test_fast_matter_passes_beside_a_bump);
    RUN_TEST(test_books_of_the_papers_solver);
    RUN_TEST(test_books_of_the_dual_solver);
    RUN_TEST(test_books_of_the_primal_solver);
    RUN_TEST(test_books_of_the_explicit_solver);
    RUN_TEST(test_measuring_changes_nothing);
    RUN_TEST(test_impulses_that_nobody_measures);
    RUN_TEST(test_many_plates_share_the_weight);
    RUN_TEST(test_angular_impulses);
    RUN_TEST(test_a_light_box_floats_at_its_depth);
    RUN_TEST(test_a_heavy_box_sinks);
    return UNITY_END();
}
