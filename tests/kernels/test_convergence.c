/* The dual solver goes to the minimiser of the energy of a substep. Solved by the library's own loop, compared with a dense solution in double
 * precision (liquids), and with the derivative of the energy (elastic bodies). No walls, no obstacles. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "bounds.h"
#include "check.h"
#include "dense.h"
#include "dual_stages.h"
#include "isas.h"
#include "matrices.h"
#include "solver.h"

void setUp(void) {}
void tearDown(void) {}

/* A small cluster of liquid, compressed to 0.85 to 1, that moves a little. c K = L is 2.56e-5 times the bulk modulus. */
static SceneSpec cluster(const char *name, float bulk_modulus)
{
    SceneSpec spec = {.name = name,
                      .material = {scene_material(PBMPM_LIQUID)},
                      .materials = 1,
                      .cells = 10,
                      .most_per_cell = 5,
                      .spread = 1,
                      .speed = 0.05,
                      .gradient = 0.02,
                      .ratio_min = 0.85,
                      .ratio_max = 1.0,
                      .solver = PBMPM_SOLVER_DUAL};
    spec.material[0].bulk_modulus = bulk_modulus;
    return spec;
}

/* A solved substep up to its last push. */
typedef struct Solved {
    DualStage stage; /* bound to the world's own arrays */
    RefGrid node;
} Solved;

static Solved solve(const SceneSpec *spec, pbmpm_isa isa, int dimension, uint32_t seed, pbmpm_pressure pressure, int iterations)
{
    Solved solved = {.stage = {.scene = scene_open(spec, isa, dimension, seed)}};
    Scene *scene = &solved.stage.scene;
    World *world = scene->world;
    world->kernels = scene->kernels;
    world->settings.pressure = pressure;
    world->settings.iterations = iterations;
    scene_bind(scene, false);
    const uint32_t mode = float_mode_enter();
    solver_predict(world);
    solved.stage.base = scene_nodes_of(scene, world->args.node_base);
    const ContactFrame nothing = {.colliders = &world->colliders, .grid = &world->grid, .cell_size = (double)world->def.cell_size, .max_displacement = 32.0f};
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, contacts_find(&nothing, &world->memory, world->pool));
    solver_solve(world, &nothing);
    float_mode_leave(mode);
    solved.node = scene_nodes(scene);
    return solved;
}

static void solved_free(Solved *solved)
{
    reference_grid_free(&solved->node);
    dual_close(&solved->stage);
}

/* Root mean square of the nodes' distance from the dense solution, by mass. */
static double distance(const Solved *solved, const Dense *dense)
{
    const int d = dense->base.dimension;
    double sum = 0.0, mass = 0.0;
    for (int j = 0; j < dense->unknowns; j++) {
        const double m = solved->node.node[j / d].mass, error = solved->node.node[j / d].u[j % d] - dense->u[j];
        sum += m * error * error;
        mass += m / d;
    }
    return sqrt(sum / mass);
}

/* How far the predictor is from the solution: what there is to be solved. */
static double to_be_solved(const Dense *dense)
{
    const int d = dense->base.dimension;
    double sum = 0.0, mass = 0.0;
    for (int j = 0; j < dense->unknowns; j++) {
        const RefNode *node = &dense->base.node[j / d];
        sum += node->mass * (node->u[j % d] - dense->u[j]) * (node->u[j % d] - dense->u[j]);
        mass += node->mass / d;
    }
    return sqrt(sum / mass);
}

/* ---- Liquids ---- */

/* After 500 iterations the rest is rounding: the root mean square of the error of S is some U times the size of D, 0.1, and the fixed point enlarges
 * it by at most 1 + L: 1e-7 (1 + L) is 17 U. After 50 iterations less than a tenth of the way is left. */
static void check_liquid(const char *name, float bulk_modulus, pbmpm_pressure pressure)
{
    const SceneSpec spec = cluster(name, bulk_modulus);
    const double L = 2.56e-5 * (double)bulk_modulus;
    for (int dimension = 2; dimension <= 3; dimension++)
        for (uint32_t seed = 1; seed <= 2; seed++)
            EACH_ISA(isa)
            {
                check_subject(name, isa, dimension);
                Solved good = solve(&spec, isa, dimension, seed, pressure, 500), rough = solve(&spec, isa, dimension, seed, pressure, 50);
                const bool cells = pressure == PBMPM_PRESSURE_CELLS;
                Dense dense = (cells ? dense_of_cells : dense_of_particles)(&good.stage.scene, &good.stage.base);
                check_true(dense_solve(&dense), "a dense solution", (long)seed);
                check_near(0.0, distance(&good, &dense), 1e-7 * (1.0 + L), "distance after 500 iterations", (long)seed);
                check_near(0.0, distance(&rough, &dense), 0.1 * to_be_solved(&dense), "distance after 50 iterations", (long)seed);
                check_true(to_be_solved(&dense) > 1e-3, "there is something to solve", (long)seed);
                dense_free(&dense);
                solved_free(&good);
                solved_free(&rough);
            }
    check_report(name);
}

static void test_soft_liquid(void) { check_liquid("converged: soft liquid", 1e4f, PBMPM_PRESSURE_PARTICLES); }
static void test_stiff_liquid(void) { check_liquid("converged: stiff liquid", 4e5f, PBMPM_PRESSURE_PARTICLES); }
static void test_soft_liquid_in_cells(void) { check_liquid("converged: soft liquid in cells", 1e4f, PBMPM_PRESSURE_CELLS); }
static void test_stiff_liquid_in_cells(void) { check_liquid("converged: stiff liquid in cells", 4e5f, PBMPM_PRESSURE_CELLS); }

/* An incompressible liquid: no particle has less room than it asks for, and only those that have just that press. What is left after 1000
 * iterations is a thousandth of the growth asked for, 0.1 on average. */
static void test_incompressible_liquid(void)
{
    const SceneSpec spec = cluster("converged: incompressible", 0.0f);
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject(spec.name, isa, dimension);
            Solved solved = solve(&spec, isa, dimension, 1, PBMPM_PRESSURE_PARTICLES, 1000);
            int pressed = 0;
            for (uint32_t i = 0; i < solved.stage.scene.world->particles.count; i++) {
                const RefParticle p = scene_particle(&solved.stage.scene, i);
                double d[3], D[9], S[9];
                reference_gather(&solved.node, &p, d, D);
                dual_multiplier(&solved.stage, i, S);
                const double lacking = fmin(1.0 / p.volume_ratio - 1.0, REF_GROWTH_MAX) - matrix_trace(dimension, D);
                check_true(S[0] >= 0.0 && lacking <= 1e-4, "room enough", (long)i);
                check_true(S[0] < 1e-3 || fabs(lacking) <= 1e-4, "pressure only where matter is held", (long)i);
                pressed += S[0] > 0.0;
            }
            check_true(pressed > 5, "some particles press", pressed);
            solved_free(&solved);
        }
}

/* ---- Elastic bodies, and liquids with them ---- */

static SceneSpec mixture(const char *name, float young_modulus)
{
    SceneSpec spec = cluster(name, 1e5f);
    spec.material[1] = scene_material(PBMPM_ELASTIC);
    spec.material[1].young_modulus = young_modulus;
    spec.material[1].relaxation = 1.3f;
    spec.materials = 2;
    return spec;
}

/* Turned, and larger or smaller alike in all directions. */
static void uniform_strain(Random *random, int dimension, double *F)
{
    const double size = random_in(random, 0.9, 1.1), s[3] = {size, size, size};
    matrix_random_with_singular_values(random, dimension, s, F);
}

/* Every particle's multiplier is where its step stays, and the nodes are where the multipliers push them: the fixed point, to the rounding of
 * D times the moduli.
 *
 * Where F F^T is a multiple of I that is the stress of the energy at D, with no linearisation, up to the squares of D. Else the part of the stress
 * that is skew, of size |S| |D|, is taken away, and the rest differs by as much: half of that is the bound. */
static void check_mixture(const char *name, float young_modulus, pbmpm_pressure pressure, MakeDeformation *deform)
{
    SceneSpec spec = mixture(name, young_modulus);
    spec.deform = deform;
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject(name, isa, dimension);
            Solved solved = solve(&spec, isa, dimension, 3, pressure, 500);
            dual_check_displacements(&solved.stage, 0.0);
            for (uint32_t i = 0; i < solved.stage.scene.world->particles.count; i++) {
                const RefParticle p = scene_particle(&solved.stage.scene, i);
                const double modulus = 2.0 * (double)p.material.shear + dimension * (double)p.material.dilation;
                double d[3], D[9], S[9], stays[9] = {0}, stress[9];
                if (p.material.kind == K_LIQUID) continue;
                reference_gather(&solved.node, &p, d, D);
                dual_multiplier(&solved.stage, i, S);
                reference_stress(dimension, &p.material, p.deformation, D, S, NULL, stays);
                reference_multiplier(dimension, &p, D, stress);
                const double size = matrix_norm(dimension, D), skew = deform ? size * size : 0.5 * size;
                for (int r = 0; r < dimension; r++)
                    for (int c = r; c < dimension; c++) {
                        check_near(stays[r * 3 + c], S[r * 3 + c], 1e-6 * (1.0 + modulus), "fixed point", (long)i);
                        check_near(stress[r * 3 + c], S[r * 3 + c], skew * matrix_norm(dimension, S) + 1e-6 * (1.0 + modulus), "stress", (long)i);
                    }
            }
            solved_free(&solved);
        }
    check_report(name);
}

static void test_soft_mixture(void)
{
    check_mixture("converged: soft mixture", 2e4f, PBMPM_PRESSURE_PARTICLES, NULL);
    check_mixture("converged: soft mixture of uniform strain", 2e4f, PBMPM_PRESSURE_PARTICLES, uniform_strain);
}

static void test_stiff_mixture(void)
{
    check_mixture("converged: stiff mixture", 1e6f, PBMPM_PRESSURE_PARTICLES, NULL);
    check_mixture("converged: stiff mixture of uniform strain", 1e6f, PBMPM_PRESSURE_PARTICLES, uniform_strain);
}

static void test_mixture_in_cells(void)
{
    check_mixture("converged: mixture in cells", 2e4f, PBMPM_PRESSURE_CELLS, NULL);
    check_mixture("converged: mixture in cells, uniform strain", 2e4f, PBMPM_PRESSURE_CELLS, uniform_strain);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_soft_liquid);
    RUN_TEST(test_stiff_liquid);
    RUN_TEST(test_soft_liquid_in_cells);
    RUN_TEST(test_stiff_liquid_in_cells);
    RUN_TEST(test_incompressible_liquid);
    RUN_TEST(test_soft_mixture);
    RUN_TEST(test_stiff_mixture);
    RUN_TEST(test_mixture_in_cells);
    return UNITY_END();
}
