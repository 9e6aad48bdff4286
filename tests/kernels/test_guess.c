/* The guess of the pressure: its last step, which knows the response from the nodes alone, and what it takes for better. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "check.h"
#include "world/depth.h"
#include "dual_stages.h"
#include "solvers/dual/pressure_guess.h"
#include "isas.h"

void setUp(void) {}
void tearDown(void) {}

/* Compressed liquid at rest: all cells want to grow, so pressures rise from 0 and none is cut off. */
static SceneSpec compressed_liquid(void)
{
    SceneSpec spec = {.name = "guess",
                      .material = {scene_material(PBMPM_LIQUID)},
                      .materials = 1,
                      .cells = 60,
                      .most_per_cell = 12,
                      .spread = 3,
                      .ratio_min = 0.8,
                      .ratio_max = 0.95,
                      .solver = PBMPM_SOLVER_DUAL};
    return spec;
}

static size_t cell_count(const World *world) { return (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells; }

/* Displacements of the pressures start + t (end - start), and how good they are. */
static double gain_at(Scene *scene, const float *start, const float *end, float t)
{
    World *world = scene->world;
    for (size_t i = 0; i < cell_count(world); i++)
        world->args.cells.pressure[i] = world->args.cells.pressure_old[i] = start[i] + t * (end[i] - start[i]);
    scene_run_particles(scene, scene->kernels->cells_push);
    scene_run_nodes(scene, scene->kernels->push_nodes);
    Loops none;
    loops_open(&none, world->pool);
    return guess_gain(world, &none);
}

static float *copy_of(const float *values, size_t count)
{
    float *copy = malloc(count * sizeof *copy);
    TEST_ASSERT_NOT_NULL(copy);
    memcpy(copy, values, count * sizeof *copy);
    return copy;
}

/* Along its way from the start the gain is the parabola b t - c t^2 / 2. The step ends where that is greatest, but for the softness that all cells have
 * in the guess, a tenth of the slowest mode's square: it adds sum_c m_c/4 softness change^2 to c. The gain is a sum of floats: 1e-3. */
static void check_last_step(DualStage *stage)
{
    Scene *scene = &stage->scene;
    World *world = scene->world;
    const size_t cells = cell_count(world);
    const ContactFrame contacts = {.colliders = &world->colliders, .grid = &world->grid, .cell_size = (double)world->def.cell_size};
    world->kernels = scene->kernels;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, guess_prepare(world));
    scene_run_particles(scene, scene->kernels->cells_begin);
    scene_run_nodes(scene, scene->kernels->cells_mean);
    memset(world->args.cells.pressure, 0, cells * sizeof(float));
    float *start = copy_of(world->args.cells.pressure, cells);
    guess_begin(world, &contacts);
    const double before = gain_at(scene, start, start, 0.0f);
    guess_solve(world, &contacts, 1);
    float *end = copy_of(world->args.cells.pressure, cells);
    check_true(memcmp(world->args.cells.pressure_old, start, cells * sizeof(float)) == 0, "the guess keeps the pressures before it", 0);
    const double after = gain_at(scene, start, end, 1.0f), beyond = gain_at(scene, start, end, 2.0f);
    const double slope = 0.5 * (4.0 * after - 3.0 * before - beyond), curvature = 2.0 * after - before - beyond;
    double soft = 0.0;
    for (size_t i = 0; i < cells; i++) soft += 0.25 * (double)world->args.cells.mass[i] * (double)end[i] * (double)end[i];
    soft *= 0.1 * slowest_pressure(world) * slowest_pressure(world);
    check_true(curvature > 0.0 && after > before, "the step is uphill", 0);
    check_near(1.0 + soft / curvature, slope / curvature, 1e-3, "where the gain is greatest", 0);
    memcpy(world->args.cells.pressure_old, start, cells * sizeof(float)); /* as guess_solve() left it */
    Loops loops;
    loops_open(&loops, world->pool);
    guess_take_back(world, &loops);
    loops_run(&loops);
    check_true(memcmp(world->args.cells.pressure, start, cells * sizeof(float)) == 0, "pressures taken back", 0);
    free(start);
    free(end);
}

static void test_the_last_step_ends_where_the_gain_is_greatest(void)
{
    SceneSpec spec = compressed_liquid();
    dual_check_spec(&spec, 3, check_last_step);
    spec.material[0].bulk_modulus = 3e4f; /* the pressures of a cell soften it */
    dual_check_spec(&spec, 1, check_last_step);
    spec_crowded(&spec);
    dual_check_spec(&spec, 1, check_last_step);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_last_step_ends_where_the_gain_is_greatest);
    return UNITY_END();
}
