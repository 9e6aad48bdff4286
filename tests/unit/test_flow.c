/* Emitters, sinks and forces from the inside: slots, poses on the way, and that whole blocks are left out for a reason only. */
#include <math.h>
#include <string.h>
#include <unity.h>

#include "books.h"
#include "grid/build.h"
#include "random.h"
#include "services/lifecycle.h"
#include "solvers/solver.h"
#include "step/draining.h"
#include "step/forcing.h"
#include "step/step.h"
#include "world/world.h"

enum { PARTICLES = 3000 };

static World *world;

/* A world of liquid particles at random places of a box of 8 m around the origin (cells of 0.25 m), with its grid built. */
static void make_world(int dimension, uint32_t seed)
{
    pbmpm_world_def def = world_def_defaults();
    def.dimension = dimension;
    def.cell_size = 0.25f;
    def.particle_capacity = PARTICLES;
    def.thread_count = 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_create(&def, &world));
    const pbmpm_material_def water = material_defaults();
    pbmpm_material_id id;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &water, 1, &id));
    Random random = (Random){seed};
    for (int i = 0; i < PARTICLES; i++) {
        NewParticle particle = {.mass = 125.0f, .material = id.index};
        for (int a = 0; a < dimension; a++) {
            particle.position[a] = random_in(&random, -16.0, 16.0);
            particle.velocity[a] = (float)random_in(&random, -1.0, 1.0);
        }
        particles_append(&world->particles, &particle, 1);
    }
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, grid_build(&world->grid, &world->memory, &world->particles, world->pool, false));
}

void setUp(void) { world = NULL; }

void tearDown(void)
{
    if (world) world_destroy(world);
}

static pbmpm_shape random_shape(Random *random, int dimension)
{
    pbmpm_shape shape = shape_defaults();
    const pbmpm_shape_kind kinds[] = {PBMPM_PLANE, PBMPM_BOX, PBMPM_SPHERE, PBMPM_CAPSULE};
    const double angle = random_in(random, -3.0, 3.0);
    shape.kind = kinds[random_below(random, 4)];
    shape.radius = (float)random_in(random, 0.1, 3.0);
    shape.rotation[2] = (float)sin(0.5 * angle);
    shape.rotation[3] = (float)cos(0.5 * angle);
    for (int a = 0; a < dimension; a++) {
        shape.position[a] = (float)random_in(random, -4.0, 4.0);
        shape.half_extents[a] = (float)random_in(random, 0.1, 3.0);
    }
    return shape;
}

/* ---- Sinks ---- */

static void check_marks(int dimension, uint32_t seed)
{
    make_world(dimension, seed);
    Random random = (Random){seed + 1000};
    const Particles *p = &world->particles;
    const pbmpm_drain_def def = drain_defaults();
    const pbmpm_shape shape = random_shape(&random, dimension);
    pbmpm_drain_id id;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, sinks_add(&world->sinks, &world->memory, &def, &shape, dimension, 1, &id));
    world->sinks.bounds.enabled = 1;
    for (int a = 0; a < 3; a++) {
        world->sinks.bounds.low[a] = (float)random_in(&random, -4.0, -2.0);
        world->sinks.bounds.high[a] = (float)random_in(&random, 1.0, 4.0);
    }
    const uint32_t marked = sinks_mark(world, 0);
    const Solid solid = solid_of(&shape, dimension);
    uint32_t drained = 0, killed = 0;
    for (uint32_t row = 0; row < p->count; row++) {
        double point[3] = {0}, normal[3];
        bool out = false;
        for (int a = 0; a < dimension; a++) {
            point[a] = particles_coordinate(p, row, a) * 0.25;
            out = out || point[a] < (double)world->sinks.bounds.low[a] || point[a] > (double)world->sinks.bounds.high[a];
        }
        const bool in_drain = solid_distance(&solid, point, normal) <= 0.0;
        drained += in_drain;
        killed += out && !in_drain;
        TEST_ASSERT_EQUAL_INT32(in_drain || out ? K_REMOVED : K_ALIVE, p->status[row]);
    }
    TEST_ASSERT_EQUAL_UINT32(drained + killed, marked);
    TEST_ASSERT_EQUAL_UINT64(drained, sinks_find(&world->sinks, id)->drained);
    TEST_ASSERT_EQUAL_UINT64(killed, world->flow.killed);
    TEST_ASSERT_EQUAL_UINT32(killed > 0, world->events.count);
    world_destroy(world);
    world = NULL;
}

/* Blocks that cannot hold a particle inside are not looked at: the result is that of looking at all. */
static void test_sinks_find_every_particle(void)
{
    for (uint32_t seed = 1; seed <= 40; seed++) check_marks(2 + (int)(seed & 1), seed);
}

/* ---- Emitters ---- */

/* The rate is a rest volume per second: so many particles, each with its share of the mass. */
static void check_rate(int dimension)
{
    pbmpm_world_def def = world_def_defaults();
    pbmpm_emitter_def emitter = emitter_defaults();
    pbmpm_material_def water = material_defaults();
    pbmpm_emitter_status status = {.size = sizeof status};
    pbmpm_emitter_id id;
    def.dimension = dimension;
    def.cell_size = 0.25f;
    def.particle_capacity = 4 * PARTICLES;
    def.thread_count = 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_create(&def, &world));
    water.density = 800.0f;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &water, 1, &emitter.material));
    emitter.rate = 0.5f;
    emitter.particles_per_axis = 8.0f;
    const pbmpm_shape box = shape_defaults();
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, emitters_add(&world->emitters, &world->memory, &emitter, &box, 1, &id));
    for (int step = 0; step < 10; step++) TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_step(world, 0.01f));
    const double each = pow(0.25 / 8.0, dimension);
    emitter_report(emitters_find(&world->emitters, id), &status);
    TEST_ASSERT_EQUAL_UINT64(world->particles.count, status.emitted);
    TEST_ASSERT_DOUBLE_WITHIN(1.0, 0.05 / each, (double)(status.emitted + status.refused_full));
    TEST_ASSERT_TRUE(status.emitted > status.refused_full);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 1.0, status.emitted_mass / (800.0 * each * (double)status.emitted));
    double mass = 0.0;
    for (uint32_t row = 0; row < world->particles.count; row++) mass += (double)world->particles.mass[row] * world_cell_volume(world);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 1.0, mass / status.emitted_mass);
    world_destroy(world);
    world = NULL;
}

static void test_rates_of_emitters(void)
{
    check_rate(2);
    check_rate(3);
}

/* ---- Forces ---- */

static void predict(void)
{
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, solver_prepare(world));
    world->substep = world_substep(world, (double)0.01f);
    solver_bind(world, false);
    solver_predict(world);
}

static size_t node_floats(void) { return (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells * K_NODE_WIDTH; }

static void place_of_node(int32_t block, int i, double point[3])
{
    const int32_t *corner = (const int32_t *)world->grid.coordinate.data + 3 * block;
    const int local[3] = {i & 3, i >> 2 & 3, i >> 4};
    for (int a = 0; a < 3; a++)
        point[a] = a < world->def.dimension ? 0.25 * (world->grid.anchor[a] + corner[a] * K_BLOCK_AXIS + local[a]) : 0.0;
}

/* See pbmpm_falloff. */
static double share_of(const pbmpm_force_def *def, double distance)
{
    const double part = distance / (double)def->range;
    if (distance <= 0.0) return 1.0;
    if (def->falloff == PBMPM_FALLOFF_INVERSE_SQUARE) return pow(1.0 + part, -2.0);
    if (part > 1.0) return 0.0;
    return def->falloff == PBMPM_FALLOFF_LINEAR ? 1.0 - part : def->falloff == PBMPM_FALLOFF_SMOOTH ? pow(1.0 - part * part, 2.0) : 1.0;
}

/* Every node gets the acceleration, to the rounding of a float, by its share; where that is 0 none changes a bit. */
static void check_reach(int dimension, uint32_t seed)
{
    static float before[1 << 20];
    make_world(dimension, seed);
    world->settings.solver = PBMPM_SOLVER_DUAL; /* has a node_base, too */
    predict();
    TEST_ASSERT_TRUE(node_floats() <= sizeof before / sizeof *before);
    memcpy(before, world->grid.node.data, node_floats() * sizeof(float));
    Random random = (Random){seed + 1000};
    const pbmpm_shape shape = random_shape(&random, dimension);
    pbmpm_force_def def = force_defaults();
    pbmpm_force_id id;
    def.everywhere = 0;
    def.range = (float)random_in(&random, 0.0, 1.0);
    def.falloff = (pbmpm_falloff)(seed / 2 % 4);
    def.strength = 500.0f; /* 0.2 cells per substep */
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, forces_add(&world->forces, &world->memory, &def, &shape, dimension, 1, &id));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, forces_apply(world));
    const float *node = world->grid.node.data;
    const Solid solid = solid_of(&shape, dimension);
    double impulse = 0.0;
    for (int32_t block = 0; block < world->grid.node_blocks; block++) {
        float reach = 0.0f;
        for (int i = 0; i < world->grid.block_cells; i++) {
            const size_t at = ((size_t)block * (size_t)world->grid.block_cells + (size_t)i) * K_NODE_WIDTH;
            double point[3], normal[3];
            place_of_node(block, i, point);
            const double share = before[at + 3] > 0.0f ? share_of(&def, solid_distance(&solid, point, normal)) : 0.0;
            TEST_ASSERT_EQUAL_FLOAT(before[at], node[at]);
            TEST_ASSERT_TRUE(fabs((double)node[at + 1] - (double)before[at + 1] - 0.2 * share) <= (share > 0.0 ? 1e-6 : 0.0));
            for (int a = 0; a < dimension; a++) reach = fmaxf(reach, fabsf(node[at + (size_t)a]));
            impulse += share * (double)before[at + 3] * world_cell_volume(world) * 5.0;
        }
        TEST_ASSERT_EQUAL_FLOAT(reach, ((const float *)world->grid.node_reach.data)[block]);
    }
    TEST_ASSERT_EQUAL_MEMORY(node, world->grid.node_base.data, node_floats() * sizeof(float));
    TEST_ASSERT_EQUAL_MEMORY(before, world->args.grid.node_before, node_floats() * sizeof(float));
    forces_account(world, &(ContactFrame){.colliders = &world->colliders, .grid = &world->grid});
    TEST_ASSERT_DOUBLE_WITHIN(1e-6 * impulse + 1e-9, impulse, forces_find(&world->forces, id)->impulse[1]);
    world_destroy(world);
    world = NULL;
}

static void test_forces_reach_every_node_and_no_further(void)
{
    for (uint32_t seed = 1; seed <= 20; seed++) check_reach(2 + (int)(seed & 1), seed);
}

/* The exact solution of v' = -k (v - w) with a wind that turns; a grab leaves nothing but the wind. */
static void check_drag(pbmpm_force_kind kind)
{
    static float before[1 << 18];
    make_world(2, 7);
    world->settings.solver = PBMPM_SOLVER_DUAL;
    predict();
    TEST_ASSERT_TRUE(node_floats() <= sizeof before / sizeof *before);
    memcpy(before, world->grid.node.data, node_floats() * sizeof(float));
    const pbmpm_shape box = shape_defaults();
    pbmpm_force_def def = force_defaults();
    pbmpm_force_id id;
    def.kind = kind;
    def.strength = 30.0f;
    def.velocity[0] = 1.0f;
    def.velocity[1] = -2.0f;
    def.spin = 0.5f;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, forces_add(&world->forces, &world->memory, &def, &box, 2, 1, &id));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, forces_apply(world));
    const float *node = world->grid.node.data;
    const double kept = kind == PBMPM_FORCE_GRAB ? 0.0 : exp(-0.3);
    double impulse[2] = {0}, size = 0.0;
    for (int32_t block = 0; block < world->grid.node_blocks; block++)
        for (int i = 0; i < world->grid.block_cells; i++) {
            const size_t at = ((size_t)block * (size_t)world->grid.block_cells + (size_t)i) * K_NODE_WIDTH;
            double point[3];
            place_of_node(block, i, point);
            const double wind[2] = {(1.0 - 0.5 * point[1]) * 0.04, (-2.0 + 0.5 * point[0]) * 0.04}; /* cells per substep */
            for (size_t a = 0; a < 2; a++) {
                const double expected = before[at + 3] > 0.0f ? wind[a] + kept * ((double)before[at + a] - wind[a]) : (double)before[at + a];
                TEST_ASSERT_DOUBLE_WITHIN(1e-6, expected, (double)node[at + a]);
                impulse[a] += (expected - (double)before[at + a]) * 25.0 * (double)before[at + 3] * world_cell_volume(world);
                size += fabs(expected - (double)before[at + a]) * 25.0 * (double)before[at + 3] * world_cell_volume(world);
            }
        }
    forces_account(world, &(ContactFrame){.colliders = &world->colliders, .grid = &world->grid});
    for (int a = 0; a < 2; a++) TEST_ASSERT_DOUBLE_WITHIN(1e-5 * size, impulse[a], forces_find(&world->forces, id)->impulse[a]);
    world_destroy(world);
    world = NULL;
}

static void test_drag_and_grab(void)
{
    check_drag(PBMPM_FORCE_DRAG);
    check_drag(PBMPM_FORCE_GRAB);
}

/* A world without forces that are on is not passed over: the predictor is what it was, and no memory is taken. */
static void test_forces_that_are_off_cost_nothing(void)
{
    make_world(2, 1);
    const pbmpm_shape shape = shape_defaults();
    pbmpm_force_def def = force_defaults();
    pbmpm_force_id id;
    def.enabled = 0;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, forces_add(&world->forces, &world->memory, &def, &shape, 2, 1, &id));
    predict();
    const uint64_t used = world->memory.used;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, forces_apply(world));
    TEST_ASSERT_EQUAL_UINT64(used, world->memory.used);
    TEST_ASSERT_NULL(world->forces.share.data);
}

/* ---- Poses and slots ---- */

static void test_a_shape_between_two_poses(void)
{
    const float position[3] = {2, 4, -6}, rotation[4] = {0, 0, -0.6f, -0.8f}; /* the long way round is not taken */
    const pbmpm_shape start = shape_defaults();
    const pbmpm_shape begin = shape_between(&start, position, rotation, 0.0f);
    const pbmpm_shape middle = shape_between(&start, position, rotation, 0.5f);
    const pbmpm_shape end = shape_between(&start, position, rotation, 1.0f);
    TEST_ASSERT_EQUAL_MEMORY(&start, &begin, sizeof start);
    TEST_ASSERT_EQUAL_MEMORY(position, end.position, sizeof position);
    TEST_ASSERT_EQUAL_MEMORY(rotation, end.rotation, sizeof rotation);
    TEST_ASSERT_EQUAL_FLOAT(2.0f, middle.position[1]);
    TEST_ASSERT_EQUAL_FLOAT(0.3f, middle.rotation[2]);
    TEST_ASSERT_EQUAL_FLOAT(0.9f, middle.rotation[3]);
}

static void test_slots_are_used_again_and_never_mistaken(void)
{
    Books books = {0};
    Memory memory = books_memory(&books, 0);
    Emitters emitters = {0};
    const pbmpm_emitter_def def = emitter_defaults();
    const pbmpm_shape shape = shape_defaults();
    pbmpm_emitter_id first, second, third;
    TEST_ASSERT_NULL(emitters_find(&emitters, (pbmpm_emitter_id){0, 1}));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, emitters_add(&emitters, &memory, &def, &shape, 7, &first));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, emitters_add(&emitters, &memory, &def, &shape, 8, &second));
    emitters_find(&emitters, first)->generation = 0;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, emitters_add(&emitters, &memory, &def, &shape, 9, &third));
    TEST_ASSERT_EQUAL_UINT32(first.index, third.index);
    TEST_ASSERT_NULL(emitters_find(&emitters, first));
    TEST_ASSERT_NOT_NULL(emitters_find(&emitters, second));
    TEST_ASSERT_TRUE(emitters_use(&emitters, def.material));
    emitters_free(&emitters, &memory);
    books_expect_closed(&books, &memory);
}

/* No slot is taken, and nothing is held, when there is no memory for the first one. */
static void test_no_memory_for_slots(void)
{
    Books books = {0};
    Memory memory = books_memory(&books, 0);
    books.fail_at = 1;
    Forces forces = {0};
    const pbmpm_force_def def = force_defaults();
    const pbmpm_shape shape = shape_defaults();
    pbmpm_force_id id;
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_OUT_OF_MEMORY, forces_add(&forces, &memory, &def, &shape, 2, 1, &id));
    TEST_ASSERT_EQUAL_UINT32(0, forces.used);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, forces_add(&forces, &memory, &def, &shape, 2, 1, &id));
    forces_free(&forces, &memory);
    books_expect_closed(&books, &memory);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_sinks_find_every_particle);
    RUN_TEST(test_rates_of_emitters);
    RUN_TEST(test_forces_reach_every_node_and_no_further);
    RUN_TEST(test_drag_and_grab);
    RUN_TEST(test_forces_that_are_off_cost_nothing);
    RUN_TEST(test_a_shape_between_two_poses);
    RUN_TEST(test_slots_are_used_again_and_never_mistaken);
    RUN_TEST(test_no_memory_for_slots);
    return UNITY_END();
}
