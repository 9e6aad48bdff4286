/* The dual solver goes to the minimiser of the energy of a substep. Solved by the library's own loop, compared with a dense solution in double
 * precision (liquids), and with the derivative of the energy (elastic bodies). No walls, no obstacles. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "bounds.h"
#include "check.h"
#include "contact/contacts_find.h"
#include "dense.h"
#include "dual_stages.h"
#include "isas.h"
#include "matrices.h"
#include "solvers/solver.h"

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
    solved.stage.base = scene_nodes_of(scene, world->args.grid.node_base);
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

/* What a particle is asked to grow by, by the trace of its strain: what the strain does beyond it is of the velocities before the substep. */
static double missing_of(const Solved *solved, uint32_t row)
{
    const World *world = solved->stage.scene.world;
    return 1.0 / scene_particle(&solved->stage.scene, row).volume_ratio - 1.0 - (double)world->args.dual.second_order[row];
}

/* After 500 iterations the rest is rounding: the root mean square of the error of S is some U times the size of D, 0.1, and the fixed point enlarges
 * it by at most 1 + L: 1e-7 (1 + L) is 17 U. After 50 iterations less than a tenth of the way is left. */
static void check_liquid(const char *name, float bulk_modulus, pbmpm_pressure pressure)
{
    SceneSpec spec = cluster(name, bulk_modulus);
    const double L = 2.56e-5 * (double)bulk_modulus;
    spec.ratio_min = 0.94; /* what is missing stays below the bound of growth */
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
                const double lacking = fmin(missing_of(&solved, i), (double)solved.stage.scene.world->args.dual.growth_max) - matrix_trace(dimension, D);
                check_true(S[0] >= 0.0 && lacking <= 1e-4, "room enough", (long)i);
                check_true(S[0] < 1e-3 || fabs(lacking) <= 1e-4, "pressure only where matter is held", (long)i);
                pressed += S[0] > 0.0;
            }
            check_true(pressed > 5, "some particles press", pressed);
            solved_free(&solved);
        }
}

/* A soft liquid that misses more than it may grow by in a substep: each particle grows by as much as its pressure does not explain, or by the bound, and then presses
 * by no more than that. The rest is that of test_incompressible_liquid(). */
static void test_growth_is_bounded_not_the_strain_that_pressure_explains(void)
{
    const SceneSpec spec = cluster("converged: bounded growth", 1e5f);
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject(spec.name, isa, dimension);
            Solved solved = solve(&spec, isa, dimension, 1, PBMPM_PRESSURE_PARTICLES, 1000);
            const double most = (double)solved.stage.scene.world->args.dual.growth_max;
            int bounded = 0, explained = 0;
            for (uint32_t i = 0; i < solved.stage.scene.world->particles.count; i++) {
                const RefParticle p = scene_particle(&solved.stage.scene, i);
                double d[3], D[9], S[9];
                reference_gather(&solved.node, &p, d, D);
                dual_multiplier(&solved.stage, i, S);
                const double missing = missing_of(&solved, i), strain = S[0] * (double)p.material.inverse_stiffness / (p.volume_ratio * p.volume_ratio);
                const double lacking = fmin(missing - strain, most) - matrix_trace(dimension, D);
                check_true(S[0] >= 0.0 && lacking <= 1e-4, "room enough", (long)i);
                check_true(S[0] < 1e-3 || fabs(lacking) <= 1e-4, "pressure only where matter is held", (long)i);
                bounded += S[0] > 0.0 && missing - strain > most + 1e-3;
                explained += missing > most && missing - strain < most - 1e-3;
            }
            check_true(bounded > 0, "some grow by the bound", bounded);
            check_true(explained > 0, "some miss more than the bound, but their pressure explains it", explained);
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

/* ---- The way there ---- */

/* FISTA on the multipliers of elastic particles, in double precision: nine entries each of S, of S one iteration before, and of Y. */
typedef struct Fista {
    RefParticle *particle;
    uint32_t count;
    double *now, *old, *Y, t;
    int restarts;
} Fista;

static Fista fista_open(const Scene *scene)
{
    const uint32_t count = scene->world->particles.count;
    return (Fista){.particle = scene_particles(scene),
                   .count = count,
                   .now = calloc(9 * (size_t)count, sizeof(double)),
                   .old = calloc(9 * (size_t)count, sizeof(double)),
                   .Y = calloc(9 * (size_t)count, sizeof(double)),
                   .t = 1.0};
}

static void fista_close(Fista *fista)
{
    free(fista->particle);
    free(fista->now);
    free(fista->old);
    free(fista->Y);
}

/* A proximal step from Y, then t' = (1 + sqrt(1 + 4 t^2)) / 2 and Y = S' + (t - 1)/t' (S' - S); where the step went against the extrapolation, <Y - S',
 * S' - S> > 0 by mass, it starts anew with t = 1 and Y = S'. */
static void fista_iterate(Fista *fista, const RefGrid *base)
{
    const int n = base->dimension;
    RefGrid u = {.dimension = n, .low = {base->low[0], base->low[1], base->low[2]}, .size = {base->size[0], base->size[1], base->size[2]}};
    const size_t nodes = (size_t)u.size[0] * (size_t)u.size[1] * (size_t)u.size[2];
    double uphill = 0.0;
    u.node = calloc(nodes, sizeof *u.node);
    for (uint32_t i = 0; i < fista->count; i++) reference_push(&u, &fista->particle[i], fista->Y + 9 * i);
    for (size_t k = 0; k < nodes; k++)
        for (int a = 0; a < n; a++)
            u.node[k].u[a] = base->node[k].mass > 0.0 ? base->node[k].u[a] + u.node[k].u[a] / base->node[k].mass : 0.0;
    for (uint32_t i = 0; i < fista->count; i++) {
        const RefParticle *p = &fista->particle[i];
        double d[3], D[9], *Y = fista->Y + 9 * i, *now = fista->now + 9 * i, *old = fista->old + 9 * i;
        reference_gather(&u, p, d, D);
        memcpy(old, now, 9 * sizeof *old);
        reference_stress(n, &p->material, p->deformation, D, Y, NULL, now);
        for (int k = 0; k < 9; k++) uphill += p->mass * (Y[k] - now[k]) * (now[k] - old[k]);
    }
    const double next = 0.5 * (1.0 + sqrt(1.0 + 4.0 * fista->t * fista->t)), momentum = uphill > 0.0 ? 0.0 : (fista->t - 1.0) / next;
    fista->restarts += uphill > 0.0;
    fista->t = uphill > 0.0 ? 1.0 : next;
    for (size_t k = 0; k < 9 * (size_t)fista->count; k++) fista->Y[k] = fista->now[k] + momentum * (fista->now[k] - fista->old[k]);
    reference_grid_free(&u);
}

static SceneSpec elastic_cluster(void)
{
    SceneSpec spec = mixture("the loop", 1e6f);
    spec.material[0] = spec.material[1];
    spec.material[0].young_modulus = 1e5f;
    spec.material[0].relaxation = 1.0f;
    return spec;
}

/* After any number of iterations the library has the multipliers of the reference. Iterations enlarge no error but by the rounding of each: 1e-6 of
 * the size of a stress, some units, times how many there were. */
static int check_loop(const SceneSpec *spec, pbmpm_isa isa, int dimension)
{
    static const int stops[] = {1, 2, 3, 4, 6, 9, 14, 25, 40};
    Fista fista = {0};
    int done = 0;
    for (size_t k = 0; k < sizeof stops / sizeof *stops; k++) {
        Solved solved = solve(spec, isa, dimension, 5, PBMPM_PRESSURE_PARTICLES, stops[k]);
        const Scene *scene = &solved.stage.scene;
        if (k == 0) fista = fista_open(scene);
        for (uint32_t i = 0; i < fista.count; i++) fista.particle[i].material = scene_particle(scene, i).material; /* what so many can hold */
        check_true(scene->world->record.iterations_used == (uint32_t)stops[k], "all iterations are done", stops[k]);
        memset(fista.now, 0, 9 * fista.count * sizeof(double));
        memset(fista.Y, 0, 9 * fista.count * sizeof(double));
        fista.t = 1.0;
        for (done = 0; done < stops[k]; done++) fista_iterate(&fista, &solved.stage.base);
        for (uint32_t i = 0; i < fista.count; i++) {
            double S[9];
            dual_multiplier(&solved.stage, i, S);
            for (int e = 0; e < 9; e++)
                if (e % 3 < dimension && e / 3 < dimension) check_near(fista.now[9 * i + (uint32_t)e], S[e], 1e-6 * (3.0 + done), "multiplier", stops[k]);
        }
        dual_check_displacements(&solved.stage, 0.0);
        solved_free(&solved);
    }
    const int restarts = fista.restarts;
    fista_close(&fista);
    return restarts;
}

static void test_the_loop_is_fista(void)
{
    const SceneSpec spec = elastic_cluster();
    int restarts = 0;
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject(spec.name, isa, dimension);
            restarts += check_loop(&spec, isa, dimension);
        }
    check_true(restarts > 0, "it was started anew", restarts);
    check_report(spec.name);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_soft_liquid);
    RUN_TEST(test_stiff_liquid);
    RUN_TEST(test_soft_liquid_in_cells);
    RUN_TEST(test_stiff_liquid_in_cells);
    RUN_TEST(test_incompressible_liquid);
    RUN_TEST(test_growth_is_bounded_not_the_strain_that_pressure_explains);
    RUN_TEST(test_soft_mixture);
    RUN_TEST(test_stiff_mixture);
    RUN_TEST(test_mixture_in_cells);
    RUN_TEST(test_the_loop_is_fista);
    return UNITY_END();
}
