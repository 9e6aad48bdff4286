#include "dual_stages.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "bounds.h"
#include "check.h"
#include "solvers/dual/dual.h"
#include "isas.h"
#include "matrices.h"

static size_t node_count(const RefGrid *grid) { return (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2]; }

/* ---- Opening and closing ---- */

static float *filled(size_t count, float value)
{
    float *values = malloc(count * sizeof *values);
    TEST_ASSERT_NOT_NULL(values);
    for (size_t i = 0; i < count; i++) values[i] = value;
    return values;
}

static void bind(DualStage *stage)
{
    World *world = stage->scene.world;
    KernelArgs *a = &world->args;
    const size_t rows = world->particles.count + K_MAX_GANG, nodes = (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells;
    float **memory = stage->memory;
    int used = 0;
    a->dual.pressure = world->particles.pressure;
    a->dual.pressure_old = memory[used++] = filled(rows, NAN);
    for (int i = 0; i < 6; i++) {
        a->dual.stress[i] = memory[used++] = filled(rows, NAN);
        a->dual.stress_old[i] = memory[used++] = filled(rows, NAN);
    }
    a->dual.node_push = memory[used++] = filled(nodes * K_NODE_WIDTH, 7.0f); /* a substep before may have left anything finite */
    a->dual.change2 = memory[used++] = filled((size_t)world->grid.node_blocks, NAN);
    a->dual.uphill = memory[used++] = filled((size_t)world->grid.node_blocks, NAN);
    float **const cells[] = {&a->cells.mass,         &a->cells.growth,  &a->cells.softness, &a->cells.pressure,
                             &a->cells.pressure_old, &a->cells.change2, &a->cells.uphill};
    for (size_t i = 0; i < sizeof cells / sizeof *cells; i++) *cells[i] = memory[used++] = filled(nodes, NAN);
    stage->strain = memory[used++] = filled(nodes, NAN);
    stage->second_order = memory[used++] = filled(rows, NAN);
    a->cells.settle = 1.0f;
    a->cells.elastic_guesses = 1;
    a->cells.relaxation = 1.3f;
    a->dual.growth_max = (float)REF_GROWTH_MAX;
    a->dual.crushed_carried = 0.5f;
    a->dual.momentum = 0.0f;
}

DualStage dual_open(const SceneSpec *spec, pbmpm_isa isa, int dimension, uint32_t seed)
{
    Random random = {seed + 1000};
    DualStage stage = {.scene = scene_open(spec, isa, dimension, seed)};
    Scene *scene = &stage.scene;
    const Particles *p = &scene->world->particles;
    for (uint32_t i = 0; i < p->count; i++) {
        const KernelMaterial *material = &scene->world->materials.kernel[p->material[i]];
        const double scale = reference_scale(&scene->step, (double)scene->world->materials.def[p->material[i]].density);
        p->pressure[i] = material->kind == K_LIQUID ? (float)(random_in(&random, 0.0, 0.2) / scale) : 0.0f;
    }
    bind(&stage);
    scene_run_particles(scene, scene->kernels->scatter);
    scene_run_nodes(scene, scene->kernels->predict_nodes);
    stage.base = scene_nodes_of(scene, scene->world->args.grid.node_base);
    return stage;
}

void dual_close(DualStage *stage)
{
    for (int i = 0; i < DUAL_ARRAYS; i++) free(stage->memory[i]);
    reference_grid_free(&stage->base);
    scene_close(&stage->scene);
}

void dual_check_once(const SceneSpec *spec, pbmpm_isa isa, int dimension, uint32_t seed, CheckDual *check)
{
    check_subject(spec->name, isa, dimension);
    DualStage stage = dual_open(spec, isa, dimension, seed);
    check(&stage);
    dual_close(&stage);
}

void dual_check_spec(const SceneSpec *spec, int seeds, CheckDual *check)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
            for (int seed = 1; seed <= seeds; seed++) dual_check_once(spec, isa, dimension, (uint32_t)seed, check);
    check_report(spec->name);
}

/* ---- Multipliers ---- */

/* Row by row through the upper triangle, or the pressure of a liquid. */
static void read_multiplier(const DualStage *stage, uint32_t row, const float *pressure, float *const stress[6], double S[9])
{
    const World *world = stage->scene.world;
    const int n = stage->scene.step.dimension;
    const bool liquid = world->materials.kernel[world->particles.material[row]].kind == K_LIQUID;
    int next = 0;
    memset(S, 0, 9 * sizeof *S);
    for (int r = 0; r < n; r++)
        for (int c = r; c < n; c++) {
            const float entry = liquid ? (r == c ? pressure[row] : 0.0f) : stress[next++][row];
            S[r * 3 + c] = S[c * 3 + r] = (double)entry;
        }
}

void dual_multiplier(const DualStage *stage, uint32_t row, double S[9])
{
    const KernelArgs *a = &stage->scene.world->args;
    read_multiplier(stage, row, a->dual.pressure, a->dual.stress, S);
}

void dual_multiplier_before(const DualStage *stage, uint32_t row, double S[9])
{
    const KernelArgs *a = &stage->scene.world->args;
    read_multiplier(stage, row, a->dual.pressure_old, a->dual.stress_old, S);
}

void dual_extrapolated(const DualStage *stage, uint32_t row, double Y[9])
{
    const double momentum = (double)stage->scene.world->args.dual.momentum;
    double now[9], old[9];
    dual_multiplier(stage, row, now);
    dual_multiplier_before(stage, row, old);
    for (int k = 0; k < 9; k++) Y[k] = now[k] + momentum * (now[k] - old[k]);
}

/* ---- Tiles ---- */

void dual_check_tiles(const DualStage *stage, const char *what)
{
    const Scene *scene = &stage->scene;
    RefGrid expected = reference_grid(scene->step.dimension, scene->low, scene->high), sizes, sum = scene_tiles(scene, &sizes);
    BoundNode *bounds = calloc(node_count(&expected), sizeof *bounds);
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle p = scene_particle(scene, i);
        double S[9];
        dual_multiplier(stage, i, S);
        reference_push(&expected, &p, S);
        bound_push(&expected, bounds, &p, S, 0.0);
    }
    for (size_t i = 0; i < node_count(&sum); i++) {
        for (int a = 0; a < 3; a++) check_near(expected.node[i].u[a], sum.node[i].u[a], bound_of_sum(&bounds[i], a), what, (long)i);
        check_true(sum.node[i].mass == 0.0, "multipliers carry no mass", (long)i);
    }
    free(bounds);
    reference_grid_free(&expected);
    reference_grid_free(&sizes);
    reference_grid_free(&sum);
}

/* ---- The first push ---- */

/* A block's mass is what residuals are measured by. */
static void check_block_mass(const DualStage *stage)
{
    const World *world = stage->scene.world;
    const uint32_t *begin = world->grid.block_begin.data;
    for (int32_t block = 0; block < world->grid.particle_blocks; block++) {
        double mass = 0.0;
        for (uint32_t i = begin[block]; i < begin[block + 1]; i++) mass += (double)world->particles.mass[i];
        check_near(mass, (double)world->args.dual.change2[block], (begin[block + 1] - begin[block]) * UNIT_ROUNDOFF * mass, "mass of a block", block);
    }
}

double dual_first_pressure(const DualStage *stage, uint32_t row, float pascal)
{
    const World *world = stage->scene.world;
    const RefParticle p = scene_particle(&stage->scene, row);
    const double scale = reference_scale(&stage->scene.step, (double)world->materials.def[world->particles.material[row]].density);
    const double start = dual_carried_share(world) * scale * (double)pascal;
    const double missing = 1.0 / p.volume_ratio - 1.0 - start * (double)p.material.inverse_stiffness / (p.volume_ratio * p.volume_ratio);
    return p.material.kind == K_LIQUID && missing > REF_GROWTH_MAX ? (double)world->args.dual.crushed_carried * start : start;
}

/* Liquids start from their pressures, others from nothing. */
void dual_check_begin(DualStage *stage)
{
    Scene *scene = &stage->scene;
    World *world = scene->world;
    const uint32_t count = world->particles.count;
    double *start = malloc(count * sizeof *start);
    for (uint32_t i = 0; i < count; i++) start[i] = dual_first_pressure(stage, i, world->particles.pressure[i]);
    scene_run_particles(scene, scene->kernels->dual_begin);
    for (uint32_t i = 0; i < count; i++) {
        const double expected = start[i];
        double S[9], Y[9];
        dual_multiplier(stage, i, S);
        check_near(expected, S[0], 4.0 * UNIT_ROUNDOFF * expected, "first multiplier", (long)i);
        world->args.dual.momentum = 0.5f;
        dual_extrapolated(stage, i, Y);
        world->args.dual.momentum = 0.0f;
        for (int k = 0; k < 9; k++) {
            check_true(S[k] == Y[k], "the first multiplier is the one before as well", (long)i);
            if (scene_particle(scene, i).material.kind == K_SOLID) check_true(S[k] == 0.0, "no stress at first", (long)i);
        }
    }
    free(start);
    check_block_mass(stage);
    dual_check_tiles(stage, "first push in tiles");
}

/* ---- Nodes ---- */

/* u = u* + (q + momentum (q - q_old)) / m; a node adds up to 27 tiles. */
void dual_check_push(DualStage *stage)
{
    Scene *scene = &stage->scene;
    KernelArgs *a = &scene->world->args;
    const double momentum = (double)a->dual.momentum;
    RefGrid sizes, sum = scene_tiles(scene, &sizes), old = reference_grid(scene->step.dimension, scene->low, scene->high);
    if (momentum > 0.0) {
        reference_grid_free(&old);
        old = scene_nodes_of(scene, a->dual.node_push);
    }
    scene_run_nodes(scene, scene->kernels->push_nodes);
    RefGrid node = scene_nodes_of(scene, a->grid.node), push = scene_nodes_of(scene, a->dual.node_push);
    for (size_t i = 0; i < node_count(&sum); i++) {
        const double mass = stage->base.node[i].mass;
        check_true(node.node[i].mass == mass, "a node keeps its mass", (long)i);
        for (int k = 0; k < 3; k++) {
            const double q = sum.node[i].u[k], base = stage->base.node[i].u[k], before = old.node[i].u[k];
            check_near(q, push.node[i].u[k], 27.0 * UNIT_ROUNDOFF * sizes.node[i].u[k] + FLUSHED, "sum of the tiles", (long)i);
            const double expected = mass > 0.0 ? base + (q + momentum * (q - before)) / mass : 0.0;
            const double size = mass > 0.0 ? ((1.0 + momentum) * 32.0 * sizes.node[i].u[k] + 4.0 * momentum * fabs(before)) / mass : 0.0;
            check_near(expected, node.node[i].u[k], UNIT_ROUNDOFF * (size + 2.0 * fabs(expected) + fabs(base)) + FLUSHED, "pushed node", (long)i);
        }
    }
    reference_grid_free(&sizes);
    reference_grid_free(&sum);
    reference_grid_free(&old);
    reference_grid_free(&node);
    reference_grid_free(&push);
}

void dual_check_displacements(DualStage *stage, double momentum)
{
    const Scene *scene = &stage->scene;
    const float kept = scene->world->args.dual.momentum;
    RefGrid node = scene_nodes(scene), q = reference_grid(scene->step.dimension, scene->low, scene->high);
    BoundNode *bounds = calloc(node_count(&q), sizeof *bounds);
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle p = scene_particle(scene, i);
        double Y[9], S[9];
        scene->world->args.dual.momentum = (float)momentum;
        dual_extrapolated(stage, i, Y);
        dual_multiplier(stage, i, S);
        reference_push(&q, &p, Y);
        for (int k = 0; k < 9; k++) S[k] = fabs(S[k]) + 2.0 * fabs(Y[k] - S[k]);
        bound_push(&q, bounds, &p, S, 0.0);
    }
    scene->world->args.dual.momentum = kept;
    for (size_t i = 0; i < node_count(&q); i++) {
        const double mass = stage->base.node[i].mass;
        for (int k = 0; k < 3 && mass > 0.0; k++) {
            const double expected = stage->base.node[i].u[k] + q.node[i].u[k] / mass;
            const double bound = 2.0 * bound_of_sum(&bounds[i], k) / mass + 4.0 * UNIT_ROUNDOFF * fabs(expected);
            check_near(expected, node.node[i].u[k], bound, "predictor and scatter of what was extrapolated", (long)i);
        }
    }
    free(bounds);
    reference_grid_free(&node);
    reference_grid_free(&q);
}

/* ---- Iteration ---- */

/* Compares one particle's new multiplier with the reference, given the nodes, what its strain does beyond its trace, and Y before. */
static void check_step(const RefGrid *nodes, const RefParticle *p, double second, const double Y[9], double Y_error, const double S[9], long index)
{
    const int n = nodes->dimension;
    const BoundParticle error = bound_gather(nodes, p);
    double d[3], D[9], expected[9] = {0}, next[9] = {0};
    reference_gather(nodes, p, d, D);
    if (p->material.kind == K_LIQUID) {
        const double trace = matrix_trace(n, D), s = reference_pressure(n, &p->material, p->volume_ratio, second, trace, Y[0]);
        const double bound = bound_pressure(n, &p->material, p->volume_ratio, second, trace, Y[0], bound_trace(nodes, p)) + Y_error;
        check_near(s, S[0], bound, "pressure", index);
        return;
    }
    double near[9];
    reference_near(n, D, near);
    matrix_multiply(n, near, p->deformation, next);
    for (int k = 0; k < 9; k++) next[k] += p->deformation[k];
    const double turned = bound_rotation(n, next, bound_advance(n, p->deformation, near, error.D));
    const double bound = bound_stress(n, &p->material, p->deformation, D, Y, n * error.D, turned) + n * Y_error;
    reference_stress(n, &p->material, p->deformation, D, Y, NULL, expected);
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) check_near(expected[r * 3 + c], S[r * 3 + c], bound, "stress", index);
}

/* What a block reports: m/4 |S' - Y|^2 and -m/4 <S' - Y, S' - S>, of what the particles have now, with the errors of float terms. */
typedef struct Tally {
    double change2, uphill, change2_error, uphill_error;
} Tally;

static void tally_add(Tally *tally, double m, const double next[9], const double Y[9], const double now[9])
{
    for (int k = 0; k < 9; k++) {
        const double change = next[k] - Y[k], way = next[k] - now[k];
        const double change_error = 4.0 * UNIT_ROUNDOFF * (fabs(next[k]) + fabs(Y[k]) + fabs(now[k])), way_error = UNIT_ROUNDOFF * fabs(way);
        tally->change2 += 0.25 * m * change * change;
        tally->uphill -= 0.25 * m * change * way;
        tally->change2_error += 0.25 * m * (2.0 * fabs(change) + change_error) * change_error + 64.0 * UNIT_ROUNDOFF * 0.25 * m * change * change;
        tally->uphill_error += 0.25 * m * (fabs(way) * change_error + fabs(change) * way_error) + 64.0 * UNIT_ROUNDOFF * 0.25 * m * fabs(change * way);
    }
}

/* Multipliers and what was extrapolated from them, of all particles. */
static double *keep(const DualStage *stage, void (*read)(const DualStage *, uint32_t, double *))
{
    const uint32_t count = stage->scene.world->particles.count;
    double *kept = malloc(count * 9 * sizeof *kept);
    for (uint32_t i = 0; i < count; i++) read(stage, i, kept + 9 * i);
    return kept;
}

void dual_check_multipliers(DualStage *stage, Kernel *kernel, bool liquids)
{
    Scene *scene = &stage->scene;
    const World *world = scene->world;
    const uint32_t *begin = world->grid.block_begin.data;
    const float *second_order = world->args.dual.second_order;
    RefGrid nodes = scene_nodes(scene);
    double *now = keep(stage, dual_multiplier), *Y = keep(stage, dual_extrapolated);
    scene_run_particles(scene, kernel);
    for (int32_t block = 0; block < world->grid.particle_blocks; block++) {
        Tally tally = {0};
        for (uint32_t i = begin[block]; i < begin[block + 1]; i++) {
            const RefParticle p = scene_particle(scene, i);
            double S[9], Y_error = 0.0;
            if (p.material.kind == K_LIQUID && !liquids) continue;
            dual_multiplier(stage, i, S);
            for (int k = 0; k < 9; k++) Y_error = fmax(Y_error, 4.0 * UNIT_ROUNDOFF * (fabs(now[9 * i + k]) + fabs(Y[9 * i + k])));
            check_step(&nodes, &p, second_order ? (double)second_order[i] : 0.0, Y + 9 * i, Y_error, S, (long)i);
            tally_add(&tally, p.mass, S, Y + 9 * i, now + 9 * i);
        }
        check_near(tally.change2, (double)world->args.dual.change2[block], tally.change2_error + FLUSHED, "change of a block", block);
        check_near(tally.uphill, (double)world->args.dual.uphill[block], tally.uphill_error + FLUSHED, "uphill of a block", block);
    }
    free(now);
    free(Y);
    reference_grid_free(&nodes);
}

void dual_check_iterate(DualStage *stage)
{
    dual_check_multipliers(stage, stage->scene.kernels->dual_iterate, true);
    dual_check_tiles(stage, "multipliers in tiles");
}
