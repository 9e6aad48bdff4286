/* Islands: what touches is solved together, and what does not is solved as if it were all there is. */
#include <stdlib.h>
#include <unity.h>

#include "services/lifecycle.h"
#include "step/step.h"
#include "world/island_groups.h"
#include "world/world.h"

void setUp(void) {}
void tearDown(void) {}

enum { CAPACITY = 4000 };

static World *open_world(int dimension)
{
    pbmpm_world_def def = world_def_defaults();
    World *world = NULL;
    def.dimension = dimension;
    def.cell_size = 0.1f;
    def.particle_capacity = CAPACITY;
    def.thread_count = 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_create(&def, &world));
    world->settings.solver = PBMPM_SOLVER_CONVERGENT;
    return world;
}

static uint32_t add_material(World *world, pbmpm_material_kind kind)
{
    pbmpm_material_id id;
    pbmpm_material_def def = material_defaults();
    def.kind = kind;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &def, 1, &id));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_make_room_for(world, id.index));
    return id.index;
}

static void add_particle(World *world, uint32_t material, int x, int y, int z)
{
    const NewParticle particle = {.position = {x, y, z}, .mass = 1000.0f, .material = material};
    particles_append(&world->particles, &particle, world->particles.count + 1);
}

/* ---- What touches ---- */

/* Two particles share nodes if their cells are two apart at most, along every axis, wherever the borders of blocks are. */
static void test_two_particles(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        for (int x = -4; x <= 4; x++) {
            for (int y = -4; y <= 4; y++) {
                for (int z = dimension == 3 ? -4 : 0; z <= (dimension == 3 ? 4 : 0); z++) {
                    World *world = open_world(dimension);
                    const uint32_t solid = add_material(world, PBMPM_ELASTIC), liquid = add_material(world, PBMPM_LIQUID);
                    const bool touch = abs(x) <= 2 && abs(y) <= 2 && abs(z) <= 2;
                    add_particle(world, solid, 0, 0, 0);
                    add_particle(world, liquid, x, y, z);
                    TEST_ASSERT_TRUE(islands_wanted(world));
                    TEST_ASSERT_TRUE(islands_foresee(world));
                    TEST_ASSERT_EQUAL_INT(touch ? 1 : 2, world->islands.groups);
                    TEST_ASSERT_EQUAL_UINT32(touch ? KIND_SOLID | KIND_LIQUID : KIND_SOLID, world->islands.kinds[0]);
                    world_destroy(world);
                }
            }
        }
    }
}

/* A row of `cells` cells along x. */
static void add_row(World *world, uint32_t material, int first, int cells, int height)
{
    for (int x = first; x < first + cells; x++) add_particle(world, material, x, height, 0);
}

/* Touch is passed on: water that reaches a body by sand is of its island. */
static void test_chains(void)
{
    for (int gap = 2; gap <= 3; gap++) {
        World *world = open_world(2);
        const uint32_t solid = add_material(world, PBMPM_ELASTIC), liquid = add_material(world, PBMPM_LIQUID), sand = add_material(world, PBMPM_SAND);
        add_row(world, solid, 0, 20, 0);
        add_row(world, sand, 10, 30, gap);
        add_row(world, liquid, 35, 20, gap + 2);
        add_row(world, liquid, 0, 5, 100);
        TEST_ASSERT_TRUE(islands_foresee(world));
        TEST_ASSERT_EQUAL_INT(gap == 2 ? 2 : 3, world->islands.groups); /* water by itself; all, or the body and the others */
        const int last = world->islands.groups - 1;
        TEST_ASSERT_EQUAL_UINT32(gap == 2 ? 7 : KIND_LIQUID | KIND_SAND, world->islands.kinds[last]);
        TEST_ASSERT_EQUAL_UINT32(gap == 2 ? 20 : 0, world->islands.particles[last][solid]);
        TEST_ASSERT_EQUAL_UINT32(30, world->islands.particles[last][sand]);
        TEST_ASSERT_EQUAL_UINT32(20, world->islands.particles[last][liquid]);
        world_destroy(world);
    }
}

/* Where no more than one answer can come of it nobody looks. */
static void test_one_kind_has_no_islands(void)
{
    World *world = open_world(2);
    const uint32_t liquid = add_material(world, PBMPM_LIQUID), solid = add_material(world, PBMPM_ELASTIC);
    add_particle(world, liquid, 0, 0, 0);
    add_particle(world, liquid, 50, 0, 0);
    TEST_ASSERT_FALSE(islands_wanted(world));
    add_particle(world, solid, 90, 0, 0);
    TEST_ASSERT_TRUE(islands_wanted(world));
    world->settings.solver = PBMPM_SOLVER_DUAL;
    TEST_ASSERT_FALSE(islands_wanted(world));
    world_destroy(world);
}

/* ---- What is solved apart ---- */

static void fill(World *world, uint32_t material, int x, int y, int width, int height)
{
    for (int i = 0; i < width; i++)
        for (int k = 0; k < height; k++) add_particle(world, material, x + i, y + k, 0);
}

/* The block of jelly at the origin, by itself and with others, steps of it, and where its particles are then. */
static void run(bool others, uint32_t ids, pbmpm_particle_id *id, double (*place)[2], pbmpm_solver *solver)
{
    World *world = open_world(2);
    const uint32_t solid = add_material(world, PBMPM_ELASTIC);
    world->settings.gravity[1] = -9.81f;
    fill(world, solid, 0, 0, 8, 8);
    for (uint32_t row = 0; row < ids; row++) {
        world->particles.velocity[0][row] = 0.1f * (float)(row % 5);
        id[row] = world->particles.id[row];
    }
    if (others) {
        fill(world, add_material(world, PBMPM_LIQUID), -30, 40, 6, 6);
        fill(world, add_material(world, PBMPM_SAND), 40, -13, 6, 6);
        fill(world, solid, 80, 3, 4, 4);
        fill(world, 1, 80, 7, 4, 4); /* water on the last one */
    }
    for (int step = 0; step < 20; step++) TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_step(world, 1.0f / 60));
    TEST_ASSERT_EQUAL_INT(others ? 4 : 1, world->islands.groups);
    *solver = world->record.solver;
    for (uint32_t i = 0; i < ids; i++) {
        uint32_t row;
        TEST_ASSERT_TRUE(particles_row(&world->particles, id[i], &row));
        for (int a = 0; a < 2; a++) place[i][a] = particles_coordinate(&world->particles, row, a);
    }
    uint32_t counted = 0;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) counted += world->particles.of_material[slot];
    TEST_ASSERT_EQUAL_UINT32(world->particles.count, counted);
    world_destroy(world);
}

static void test_others_change_nothing(void)
{
    enum { PARTICLES = 64 };
    static pbmpm_particle_id id[PARTICLES];
    static double alone[PARTICLES][2], together[PARTICLES][2];
    pbmpm_solver one, several;
    run(false, PARTICLES, id, alone, &one);
    run(true, PARTICLES, id, together, &several);
    TEST_ASSERT_EQUAL_INT(PBMPM_SOLVER_PRIMAL, one);
    TEST_ASSERT_EQUAL_INT(PBMPM_SOLVER_CONVERGENT, several);
    TEST_ASSERT_EQUAL_MEMORY(alone, together, sizeof alone);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_two_particles);
    RUN_TEST(test_chains);
    RUN_TEST(test_one_kind_has_no_islands);
    RUN_TEST(test_others_change_nothing);
    return UNITY_END();
}
