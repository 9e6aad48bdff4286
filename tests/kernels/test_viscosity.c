/* Viscosity of liquids: what the stages make of the predictor, against Legendre polynomials of the viscous operator in double precision.
 *
 * With L u = (1/m_i) sum_p m_p w_ip S_p (x_i - x_p), S = -share dev(sym D), of liquid that bears nothing -share d/(d - 1) D+, s stages give
 * P_s(I + 2 L / (s^2 + s)) u, P_s Legendre's polynomial: first order in L, and between -1 and 1 as long as no eigenvalue of -L exceeds s^2 + s; its norm is at
 * most d/(d - 1) times the share. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "bounds.h"
#include "check.h"
#include "dual_reference.h"
#include "isas.h"
#include "matrices.h"
#include "scene.h"
#include "solvers/solver.h"
#include "solvers/viscosity.h"

void setUp(void) {}
void tearDown(void) {}

static size_t node_count(const RefGrid *grid) { return (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2]; }

/* A thick and a thin liquid and an elastic body, none of which is viscous in itself. `share` is of the thick one. */
static SceneSpec viscous_scene(const char *name, double share)
{
    SceneSpec spec = {.name = name,
                      .material = {scene_material(PBMPM_LIQUID), scene_material(PBMPM_LIQUID), scene_material(PBMPM_ELASTIC)},
                      .materials = 3,
                      .cells = 60,
                      .most_per_cell = 10,
                      .spread = 4,
                      .speed = 0.4,
                      .gradient = 0.2,
                      .ratio_min = 0.7,
                      .ratio_max = 1.1,
                      .solver = PBMPM_SOLVER_DUAL};
    const double cell = 0.05, dt = 0.004; /* those of all scenes */
    spec.material[0].kinematic_viscosity = (float)(share * cell * cell / (8.0 * dt));
    spec.material[1].kinematic_viscosity = 0.1f * spec.material[0].kinematic_viscosity;
    spec.material[1].density = 300.0f;
    return spec;
}

/* d/(d - 1) times the part of a symmetric matrix that stretches. Shifted by its size it has singular values. */
static void stretching(int n, const double strain[9], double out[9])
{
    const double size = matrix_norm(n, strain);
    double shifted[9], u[9], v[9], s[3];
    memcpy(shifted, strain, sizeof shifted);
    for (int a = 0; a < n; a++) shifted[a * 4] += size;
    matrix_decompose(n, shifted, u, s, v);
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) {
            out[r * 3 + c] = 0.0;
            for (int k = 0; k < n; k++) out[r * 3 + c] += n / (n - 1.0) * fmax(s[k] - size, 0.0) * v[r * 3 + k] * v[c * 3 + k];
        }
}

/* Adds x L u to `out`. */
static void add_viscous(const Scene *scene, const RefGrid *u, double x, RefGrid *out)
{
    const int n = u->dimension;
    RefGrid push = reference_grid(n, scene->low, scene->high);
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle p = scene_particle(scene, i);
        const double cell = 1.0 / scene->step.cells_per_metre, nu = (double)scene->world->materials.def[scene->world->particles.material[i]].kinematic_viscosity;
        const double share = p.material.kind == K_LIQUID ? 8.0 * nu * scene->step.dt / (cell * cell) : 0.0;
        const bool bare = p.volume_ratio >= 1.0 && !(scene->world->particles.pressure[i] > 0.0f);
        double d[3], D[9], E[9] = {0}, S[9] = {0};
        reference_gather(u, &p, d, D);
        const double mean = matrix_trace(n, D) / n;
        for (int r = 0; r < n; r++)
            for (int c = 0; c < n; c++) {
                E[r * 3 + c] = 0.5 * (D[r * 3 + c] + D[c * 3 + r]);
                S[r * 3 + c] = E[r * 3 + c] - (r == c ? mean : 0.0);
            }
        if (bare) stretching(n, E, S);
        for (int e = 0; e < 9; e++) S[e] *= -share;
        reference_push(&push, &p, S);
    }
    for (size_t i = 0; i < node_count(u); i++)
        for (int a = 0; a < n && u->node[i].mass > 0.0; a++) out->node[i].u[a] += x * push.node[i].u[a] / u->node[i].mass;
    reference_grid_free(&push);
}

static RefGrid copy_of(const RefGrid *grid)
{
    RefGrid copy = *grid;
    copy.node = malloc(node_count(grid) * sizeof *copy.node);
    memcpy(copy.node, grid->node, node_count(grid) * sizeof *copy.node);
    return copy;
}

/* One of some rounds: P_s(I + 2 L / (s^2 + s)) u, by j P_j(x) = (2j - 1) x P_(j-1)(x) - (j - 1) P_(j-2)(x). */
static RefGrid legendre(const Scene *scene, const RefGrid *u, int stages, int rounds)
{
    const double part = 2.0 / (rounds * (stages * stages + stages));
    RefGrid before = copy_of(u), last = copy_of(u);
    add_viscous(scene, u, part, &last);
    for (int j = 2; j <= stages; j++) {
        RefGrid next = copy_of(&last);
        add_viscous(scene, &last, part, &next);
        for (size_t i = 0; i < node_count(u); i++)
            for (int a = 0; a < u->dimension; a++)
                next.node[i].u[a] = ((2.0 * j - 1.0) * next.node[i].u[a] - (j - 1.0) * before.node[i].u[a]) / j;
        reference_grid_free(&before);
        before = last;
        last = next;
    }
    reference_grid_free(&before);
    return last;
}

typedef struct Sums {
    double linear[3], energy, size;
} Sums;

static Sums sums_of(const RefGrid *grid)
{
    Sums sums = {{0}, 0.0, 0.0};
    for (size_t i = 0; i < node_count(grid); i++)
        for (int a = 0; a < grid->dimension; a++) {
            const double m = grid->node[i].mass, u = grid->node[i].u[a];
            sums.linear[a] += m * u;
            sums.size += m * fabs(u);
            sums.energy += m * u * u;
        }
    return sums;
}

/* A stage rounds each node by 64 U of the largest displacement, about 1; stages carry the errors of those before them, of which there are at most
 * s^2 (the polynomials of Legendre and their recurrence grow no faster). */
static void check_viscosity(const char *name, double share)
{
    const SceneSpec spec = viscous_scene(name, share);
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            const double steep = dimension / (dimension - 1.0) * share, most = 0.5 * (VISCOUS_STAGES_MAX * VISCOUS_STAGES_MAX + VISCOUS_STAGES_MAX);
            const int rounds = (int)ceil(steep / most - 1e-6);
            const int stages = (int)ceil(0.5 * (sqrt(1.0 + 8.0 * steep / rounds) - 1.0) - 1e-6);
            check_subject(name, isa, dimension);
            Scene scene = scene_open(&spec, isa, dimension, 4);
            World *world = scene.world;
            world->kernels = scene.kernels;
            for (uint32_t i = 0; i < world->particles.count; i += 2) world->particles.pressure[i] = 100.0f; /* they bear something */
            const ContactFrame nothing = {.colliders = &world->colliders, .grid = &world->grid, .cell_size = (double)world->def.cell_size, .max_displacement = 32.0f};
            const uint32_t mode = float_mode_enter();
            solver_predict(world);
            RefGrid before = scene_nodes(&scene);
            viscosity_apply(world, &nothing);
            float_mode_leave(mode);
            RefGrid after = scene_nodes(&scene), base = scene_nodes_of(&scene, world->args.grid.node_base), expected = copy_of(&before);
            for (int round = 0; round < rounds; round++) {
                RefGrid next = legendre(&scene, &expected, stages, rounds);
                reference_grid_free(&expected);
                expected = next;
            }
            const double bound = 64.0 * UNIT_ROUNDOFF * rounds * stages * stages;
            for (size_t i = 0; i < node_count(&after); i++)
                for (int a = 0; a < dimension; a++) {
                    check_near(expected.node[i].u[a], after.node[i].u[a], bound, "viscous displacement", (long)i);
                    check_true(base.node[i].u[a] == after.node[i].u[a], "the predictor is the viscous one", (long)i);
                }
            const Sums first = sums_of(&before), last = sums_of(&after);
            check_true(last.energy < first.energy, "energy falls", 0);
            for (int a = 0; a < dimension; a++) check_near(first.linear[a], last.linear[a], bound * first.size, "momentum", a);
            RefGrid *const all[] = {&before, &after, &base, &expected};
            for (size_t i = 0; i < sizeof all / sizeof *all; i++) reference_grid_free(all[i]);
            scene_close(&scene);
        }
    check_report(name);
}

static void test_one_stage(void)
{
    check_viscosity("viscosity: a hundredth", 0.01);
    check_viscosity("viscosity: one stage", 0.49);
}

static void test_several_stages(void)
{
    check_viscosity("viscosity: two stages", 1.4);
    check_viscosity("viscosity: five stages", 7.4);
    check_viscosity("viscosity: thirteen stages", 45.0);
    check_viscosity("viscosity: two rounds", 500.0);
}

/* Beyond what all stages can do, the share is that: it is stable. */
static void test_the_most_that_is_done(void)
{
    SceneSpec spec = viscous_scene("viscosity: more than all stages", 1e7);
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject(spec.name, isa, dimension);
            Scene scene = scene_open(&spec, isa, dimension, 4);
            scene.world->kernels = scene.kernels;
            const ContactFrame nothing = {.colliders = &scene.world->colliders, .grid = &scene.world->grid, .cell_size = 0.05, .max_displacement = 32.0f};
            const uint32_t mode = float_mode_enter();
            solver_predict(scene.world);
            RefGrid before = scene_nodes(&scene);
            viscosity_apply(scene.world, &nothing);
            float_mode_leave(mode);
            RefGrid after = scene_nodes(&scene);
            check_true(sums_of(&after).energy < sums_of(&before).energy, "energy falls", 0);
            reference_grid_free(&before);
            reference_grid_free(&after);
            scene_close(&scene);
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_one_stage);
    RUN_TEST(test_several_stages);
    RUN_TEST(test_the_most_that_is_done);
    return UNITY_END();
}
