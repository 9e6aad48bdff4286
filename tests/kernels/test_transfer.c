/* Transfers between particles and nodes: every occupancy, cell, block border and mixture of materials. */
#include <unity.h>

#include "check.h"
#include "isas.h"
#include "stages.h"

void setUp(void) {}
void tearDown(void) {}

/* Two liquids and two elastic materials of different densities. */
static SceneSpec mixed_scene(const char *name)
{
    SceneSpec spec = {.name = name,
                      .material = {scene_material(PBMPM_LIQUID), scene_material(PBMPM_ELASTIC), scene_material(PBMPM_LIQUID),
                                   scene_material(PBMPM_ELASTIC)},
                      .materials = 4,
                      .cells = 60,
                      .most_per_cell = 12,
                      .spread = 6,
                      .speed = 0.4,
                      .gradient = 0.2,
                      .ratio_min = 0.6,
                      .ratio_max = 1.4};
    spec.material[2].density = 2.0f;
    spec.material[3].density = 7800.0f;
    return spec;
}

static void test_mixed_materials(void)
{
    const SceneSpec spec = mixed_scene("mixed materials");
    stages_check_spec(&spec, 2);
}

static void test_single_particles_far_apart(void)
{
    SceneSpec spec = mixed_scene("single particles far apart");
    spec_far_apart(&spec);
    stages_check_spec(&spec, 1);
}

static void test_crowded_cells(void)
{
    SceneSpec spec = mixed_scene("crowded cells");
    spec_crowded(&spec);
    stages_check_spec(&spec, 1);
}

static void test_one_material(void)
{
    SceneSpec spec = mixed_scene("one material");
    for (int i = 0; i < 2; i++) {
        spec.material[0] = spec.material[i];
        spec.materials = 1;
        stages_check_spec(&spec, 1);
        spec = mixed_scene("one material");
    }
}

/* Coordinates of all signs, and up to the limit of the world. */
static void test_anywhere(void)
{
    static const int32_t centres[][3] = {{-5, -5, -5}, {-1000, 999, 17}, {1048000, -1048000, 1048000}};
    SceneSpec spec = mixed_scene("anywhere");
    spec.spread = 3;
    for (int i = 0; i < 3; i++) {
        for (int a = 0; a < 3; a++) spec.centre[a] = centres[i][a];
        stages_check_spec(&spec, 1);
    }
}

static void test_each_cell_of_a_block(void)
{
    SceneSpec spec = mixed_scene("each cell of a block");
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int cell = 0; cell < cells_of_a_block(dimension); cell++) {
            spec_in_cell(&spec, cell);
            EACH_ISA(isa)
            {
                check_subject(spec.name, isa, dimension);
                Scene scene = scene_open(&spec, isa, dimension, (uint32_t)cell);
                stages_check(&scene);
                scene_close(&scene);
            }
        }
    check_report(spec.name);
}

/* Faster than max_displacement: every such particle is slowed to it and counted. */
static void test_speed_limit(void)
{
    SceneSpec spec = mixed_scene("speed limit");
    spec.speed = 20.0;
    spec.gradient = 2.0;
    spec.max_displacement = 3.0f;
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject(spec.name, isa, dimension);
            Scene scene = scene_open(&spec, isa, dimension, 5);
            stages_check(&scene);
            const Grid *grid = &scene.world->grid;
            uint32_t slowed = 0, counted = 0;
            for (uint32_t i = 0; i < scene.world->particles.count; i++) {
                const RefParticle p = scene_particle(&scene, i);
                const double scale = scene.step.dt * scene.step.cells_per_metre;
                double length2 = 0.0;
                for (int a = 0; a < dimension; a++) length2 += p.velocity[a] * scale * p.velocity[a] * scale;
                slowed += length2 > 9.0 * (1.0 - 1e-5);
                check_true(length2 <= 9.0 * (1.0 + 1e-5), "speed is limited", (long)i);
            }
            for (int32_t b = 0; b < grid->particle_blocks; b++) counted += scene.world->args.grid.clamped[b];
            TEST_ASSERT_TRUE(slowed > 0);
            TEST_ASSERT_EQUAL_UINT32(slowed, counted);
            scene_close(&scene);
        }
}

/* A particle that leaves the range of cells is marked. */
static void test_out_of_range(void)
{
    SceneSpec spec = mixed_scene("out of range");
    spec.spread = 1;
    spec.speed = 2.5;
    for (int a = 0; a < 3; a++) spec.centre[a] = a == 1 ? -CELL_LIMIT + 1 : CELL_LIMIT - 1;
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject(spec.name, isa, dimension);
            Scene scene = scene_open(&spec, isa, dimension, 5);
            stages_check(&scene);
            uint32_t outside = 0;
            for (uint32_t i = 0; i < scene.world->particles.count; i++) {
                const RefParticle p = scene_particle(&scene, i);
                bool is_outside = false;
                for (int a = 0; a < dimension; a++) is_outside |= p.cell[a] > CELL_LIMIT || p.cell[a] < -CELL_LIMIT;
                check_true(is_outside == (p.status == K_OUT_OF_RANGE), "marked when out of range", (long)i);
                outside += is_outside;
            }
            TEST_ASSERT_TRUE(outside > 0 && outside < scene.world->particles.count);
            scene_close(&scene);
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_mixed_materials);
    RUN_TEST(test_single_particles_far_apart);
    RUN_TEST(test_crowded_cells);
    RUN_TEST(test_one_material);
    RUN_TEST(test_anywhere);
    RUN_TEST(test_each_cell_of_a_block);
    RUN_TEST(test_speed_limit);
    RUN_TEST(test_out_of_range);
    return UNITY_END();
}
