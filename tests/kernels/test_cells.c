/* The kernels of the dual solver with pressures in cells: each against the reference, and what their equations promise. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "bounds.h"
#include "check.h"
#include "dual_stages.h"
#include "isas.h"

void setUp(void) {}
void tearDown(void) {}

static SceneSpec liquid_scene(const char *name)
{
    SceneSpec spec = {.name = name,
                      .material = {scene_material(PBMPM_LIQUID), scene_material(PBMPM_LIQUID), scene_material(PBMPM_ELASTIC)},
                      .materials = 3,
                      .cells = 60,
                      .most_per_cell = 12,
                      .spread = 5,
                      .speed = 0.4,
                      .gradient = 0.2,
                      .ratio_min = 0.6,
                      .ratio_max = 1.2,
                      .solver = PBMPM_SOLVER_DUAL};
    spec.material[1].bulk_modulus = 3e4f;
    spec.material[1].density = 700.0f;
    return spec;
}

/* The momentum of the nodes is in the multipliers already. */
static void push_nodes(DualStage *stage)
{
    const float momentum = stage->scene.world->args.dual.momentum;
    stage->scene.world->args.dual.momentum = 0.0f;
    dual_check_push(stage);
    stage->scene.world->args.dual.momentum = momentum;
}

static void check_rounds(DualStage *stage)
{
    static const float momenta[] = {0.0f, 0.28f, 0.9f};
    cells_check_begin(stage);
    cells_check_mean(stage);
    cells_check_push(stage);
    push_nodes(stage);
    for (size_t k = 0; k < sizeof momenta / sizeof *momenta; k++) {
        cells_check_trace(stage);
        cells_check_update(stage);
        stage->scene.world->args.dual.momentum = momenta[k];
        cells_check_push(stage);
        push_nodes(stage);
    }
}

/* The guess of a world with liquids and solids. */
static void check_guess(DualStage *stage)
{
    cells_check_begin(stage);
    cells_check_mean(stage);
    stage->scene.world->args.cells.solid_growth = stage->strain;
    cells_check_solids(stage);
    cells_check_push(stage);
    push_nodes(stage);
    cells_check_guess_trace(stage);
    cells_check_second_order(stage);
}

/* Before and after the guess of pressures that particles keep. */
static void check_kept(DualStage *stage)
{
    static const float fine[] = {0.8f, 0.0f, 1.0f};
    static uint64_t calls;
    Random random = {++calls};
    const size_t count = stage->scene.world->particles.count;
    float *pascal = malloc(count * sizeof *pascal);
    TEST_ASSERT_NOT_NULL(pascal);
    memcpy(pascal, stage->scene.world->args.dual.pressure, count * sizeof *pascal);
    cells_check_begin(stage);
    cells_check_mean(stage);
    stage->scene.world->args.cells.solid_growth = stage->strain;
    cells_check_solids(stage);
    for (size_t k = 0; k < sizeof fine / sizeof *fine; k++) {
        memcpy(stage->scene.world->args.dual.pressure, pascal, count * sizeof *pascal);
        cells_check_carry(stage, fine[k]);
        push_nodes(stage);
        cells_check_add(stage, &random);
        push_nodes(stage);
    }
    free(pascal);
}

static void test_the_guess_is_added_to_what_particles_keep(void)
{
    SceneSpec spec = liquid_scene("cells: kept pressures");
    dual_check_spec(&spec, 3, check_kept);
    spec.material[0] = scene_material(PBMPM_SAND);
    dual_check_spec(&spec, 1, check_kept);
    spec_crowded(&spec);
    dual_check_spec(&spec, 1, check_kept);
}

static void test_solids_in_the_guess(void)
{
    SceneSpec spec = liquid_scene("cells: solids in the guess");
    dual_check_spec(&spec, 3, check_guess);
    spec.material[0] = scene_material(PBMPM_SAND);
    dual_check_spec(&spec, 1, check_guess);
    spec_crowded(&spec);
    dual_check_spec(&spec, 1, check_guess);
}

static void test_mixed_materials(void)
{
    const SceneSpec spec = liquid_scene("cells: mixed materials");
    dual_check_spec(&spec, 3, check_rounds);
}

static void test_single_particles_far_apart(void)
{
    SceneSpec spec = liquid_scene("cells: single particles far apart");
    spec_far_apart(&spec);
    dual_check_spec(&spec, 1, check_rounds);
}

static void test_crowded_cells(void)
{
    SceneSpec spec = liquid_scene("cells: crowded cells");
    spec_crowded(&spec);
    dual_check_spec(&spec, 1, check_rounds);
}

static void test_all_densities(void)
{
    SceneSpec spec = liquid_scene("cells: all densities");
    spec.ratio_min = 0.05;
    spec.gradient = 0.8;
    dual_check_spec(&spec, 2, check_rounds);
}

/* Each lies between centres of other blocks. */
static void test_each_cell_of_a_block(void)
{
    SceneSpec spec = liquid_scene("cells: each cell of a block");
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int cell = 0; cell < cells_of_a_block(dimension); cell++) {
            spec_in_cell(&spec, cell);
            EACH_ISA(isa) dual_check_once(&spec, isa, dimension, (uint32_t)cell + 1, check_rounds);
        }
    check_report(spec.name);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_mixed_materials);
    RUN_TEST(test_solids_in_the_guess);
    RUN_TEST(test_the_guess_is_added_to_what_particles_keep);
    RUN_TEST(test_single_particles_far_apart);
    RUN_TEST(test_crowded_cells);
    RUN_TEST(test_all_densities);
    RUN_TEST(test_each_cell_of_a_block);
    return UNITY_END();
}
