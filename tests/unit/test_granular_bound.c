/* The energy bound of sand in the dual solver: what stresses gain beyond what growth takes is taken back, see src/solvers/dual/granular_bound.h. */
#include <math.h>
#include <unity.h>

#include "random.h"
#include "services/lifecycle.h"
#include "solvers/dual/dual_gains.h"
#include "step/step.h"
#include "world/world.h"

void setUp(void) {}
void tearDown(void) {}

enum { SIDE = 6 }; /* cells of a block, two particles per cell and axis */

static const float DT = 1.0f / 60;

/* A block in free flight, weightless, whose particles move at random and bear the pressure of before. */
static World *open_block(int dimension, pbmpm_material_kind kind, float pressure)
{
    pbmpm_world_def def = world_def_defaults();
    pbmpm_material_def material = material_defaults();
    pbmpm_material_id id;
    World *world = NULL;
    Random random = {17};
    const int per_axis = 2 * SIDE, deep = dimension == 3 ? per_axis : 1;
    def.dimension = dimension;
    def.cell_size = 0.05f;
    def.particle_capacity = (uint32_t)(per_axis * per_axis * deep);
    def.thread_count = 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_create(&def, &world));
    world->settings.solver = PBMPM_SOLVER_DUAL;
    world->settings.iterations = 2;
    for (int a = 0; a < 3; a++) world->settings.gravity[a] = 0.0f;
    material.kind = kind;
    material.young_modulus = 1e6f;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &material, 1, &id));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_make_room_for(world, id.index));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_enable_pressure(&world->particles, &world->memory));
    for (int i = 0; i < per_axis * per_axis * deep; i++) {
        const int place[3] = {i % per_axis, i / per_axis % per_axis, i / (per_axis * per_axis)};
        NewParticle particle = {.mass = 1.0f, .material = id.index};
        for (int a = 0; a < dimension; a++) {
            particle.position[a] = 0.25 + 0.5 * place[a];
            particle.velocity[a] = (float)random_in(&random, -0.5, 0.5);
        }
        particles_append(&world->particles, &particle, (uint32_t)i + 1);
        world->particles.pressure[i] = pressure;
    }
    return world;
}

/* Grains are not crushed, so growth takes nothing: with the share that is kept the stresses gain exactly nothing. */
static void test_stresses_of_before_drive_nothing(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (float pressure = 1e4f; pressure < 1e7f; pressure *= 10.0f) {
            World *world = open_block(dimension, PBMPM_SAND, pressure);
            TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_step(world, DT));
            const DualGain *gain = dual_gain_in(world, 0);
            TEST_ASSERT_TRUE(gain->brought > 0.0 && gain->mass > 0.0);
            TEST_ASSERT_DOUBLE_WITHIN(1e-4 * gain->brought, 0.0, gain->gain); /* sums of floats */
            TEST_ASSERT_DOUBLE_WITHIN(1e-4 * gain->brought, gain->brought, gain->kinetic);
            world_destroy(world);
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_stresses_of_before_drive_nothing);
    return UNITY_END();
}
