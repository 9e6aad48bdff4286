#include "stages.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bounds.h"
#include "check.h"
#include "isas.h"
#include "matrices.h"

static const double NODE_MASS_MIN = 1e-20; /* below this a node counts as empty */

/* A grid of sums with their bounds. */
typedef struct Expected {
    RefGrid grid;
    BoundNode *bounds;
} Expected;

static size_t node_count(const RefGrid *grid) { return (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2]; }

static Expected expected_open(const Scene *scene)
{
    Expected expected = {.grid = reference_grid(scene->step.dimension, scene->low, scene->high)};
    expected.bounds = calloc(node_count(&expected.grid), sizeof *expected.bounds);
    return expected;
}

static void expected_close(Expected *expected)
{
    reference_grid_free(&expected->grid);
    free(expected->bounds);
}

static void expected_add(Expected *expected, const RefParticle *p, const double d[3], const double D[9], BoundParticle error)
{
    reference_scatter(&expected->grid, p, d, D);
    bound_scatter(&expected->grid, expected->bounds, p, d, D, error);
}

static void check_tiles(const Scene *scene, const Expected *expected, bool with_mass)
{
    RefGrid sizes, sum = scene_tiles(scene, &sizes);
    for (size_t i = 0; i < node_count(&sum); i++) {
        const BoundNode *bound = &expected->bounds[i];
        const RefNode *node = &expected->grid.node[i];
        const double relative = (TRANSFER_ROUNDINGS + bound->terms) * UNIT_ROUNDOFF;
        for (int a = 0; a < 3; a++) check_near(node->u[a], sum.node[i].u[a], bound_of_sum(bound, a), "momentum in tiles", (long)i);
        if (!with_mass) continue;
        check_near(node->mass, sum.node[i].mass, relative * node->mass + FLUSHED * 1e6 * bound->terms, "mass in tiles", (long)i);
        if (scene->step.with_volume)
            check_near(node->volume, sum.node[i].volume, relative * node->volume + FLUSHED * 1e6 * bound->terms, "volume in tiles",
                       (long)i);
    }
    reference_grid_free(&sum);
    reference_grid_free(&sizes);
}

/* ---- F ---- */

/* F is compared entry by entry; its singular values, which never move farther than F does, also where the clamp is too
 * sensitive for that. 1e-5 of the size is what the kernel's singular value decomposition may add. */
static void check_deformation(const Scene *scene, const RefParticle *expected, const RefParticle *actual, const double *unlimited,
                              double error, long index)
{
    const int n = scene->step.dimension;
    const double size = matrix_norm(n, expected->deformation), own = 1e-5 * fmax(size, matrix_norm(n, unlimited));
    const double gain = strain_limit_sensitivity(n, &expected->material, unlimited);
    double u[9], v[9], s[3], t[3];
    matrix_decompose(n, expected->deformation, u, s, v);
    matrix_decompose(n, actual->deformation, u, t, v);
    for (int a = 0; a < n; a++) check_near(s[a], t[a], error + own, "singular value of F", index);
    if (gain * (error + own) > size) return;
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) {
            const int k = r * 3 + c;
            check_near(expected->deformation[k], actual->deformation[k], gain * (error + own), "F", index);
        }
}

/* Where F is so close to the limit of its condition number that either answer is right. */
static bool condition_is_unclear(int n, const KernelMaterial *material, const double *F, double error)
{
    double u[9], s[3], v[9];
    const double limit = (double)material->condition_max;
    if (limit == 0.0) return false;
    matrix_decompose(n, F, u, s, v);
    const double own = error + 1e-5 * matrix_norm(n, F);
    return fabs(s[0] - limit * s[n - 1]) <= own * (1.0 + limit) || fabs(s[n - 1]) <= own;
}

/* ---- The kernels ---- */

void stages_check_scatter(Scene *scene)
{
    const bool check_strain = scene->world->args.check_strain;
    RefParticle *before = scene_particles(scene);
    Expected expected = expected_open(scene);
    scene_run_particles(scene, scene->kernels->scatter);
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle after = scene_particle(scene, i);
        RefParticle *p = &before[i];
        double d[3], D[9];
        if (after.status == K_NOT_FINITE) continue; /* see test_hard_cases.c */
        reference_start(&scene->step, p, d, D);
        expected_add(&expected, p, d, D, (BoundParticle){0});
        if (!check_strain || p->material.kind != K_SOLID) continue;
        const RefParticle unlimited = *p;
        reference_limit_strain(scene->step.dimension, &p->material, p->deformation);
        check_deformation(scene, p, &after, unlimited.deformation, 0.0, (long)i);
    }
    check_tiles(scene, &expected, true);
    expected_close(&expected);
    free(before);
}

/* A node sums at most 27 tiles. */
static void check_predicted_node(const Scene *scene, const RefNode *sum, const RefNode *size, const RefNode *node, long index)
{
    const double sums = 27.0 * UNIT_ROUNDOFF;
    check_near(sum->volume, node->volume, sums * size->volume, "volume of a node", index);
    if (fabs(sum->mass - NODE_MASS_MIN) < 1e-3 * NODE_MASS_MIN) return;
    if (sum->mass < NODE_MASS_MIN) {
        check_true(node->mass == 0.0 && node->u[0] == 0.0 && node->u[1] == 0.0 && node->u[2] == 0.0, "a node without mass is 0", index);
        return;
    }
    check_near(sum->mass, node->mass, sums * sum->mass, "mass of a node", index);
    for (int a = 0; a < scene->step.dimension; a++) {
        const double u = sum->u[a] / sum->mass, g = scene->step.gravity[a];
        const double bound = (2.0 * sums + 8.0 * UNIT_ROUNDOFF) * (size->u[a] / sum->mass) + 2.0 * UNIT_ROUNDOFF * fabs(g) + FLUSHED / sum->mass;
        check_near(u + g, node->u[a], bound, "predictor", index);
    }
}

/* The largest displacement in each block, exactly. */
static void check_reach(const Scene *scene)
{
    const KernelArgs *args = &scene->world->args;
    const Grid *grid = &scene->world->grid;
    for (int32_t block = 0; block < grid->node_blocks; block++) {
        float reach = 0.0f;
        for (int i = 0; i < grid->block_cells; i++)
            for (int a = 0; a < 3; a++)
                reach = fmaxf(reach, fabsf(args->grid.node[((size_t)block * (size_t)grid->block_cells + (size_t)i) * K_NODE_WIDTH + (size_t)a]));
        check_near((double)reach, (double)args->grid.node_reach[block], 0.0, "reach of a block", block);
    }
}

void stages_check_predict(Scene *scene)
{
    RefGrid sizes, sum = scene_tiles(scene, &sizes);
    scene_run_nodes(scene, scene->kernels->predict_nodes);
    RefGrid nodes = scene_nodes(scene);
    for (size_t i = 0; i < node_count(&sum); i++)
        check_predicted_node(scene, &sum.node[i], &sizes.node[i], &nodes.node[i], (long)i);
    check_reach(scene);
    reference_grid_free(&sum);
    reference_grid_free(&sizes);
    reference_grid_free(&nodes);
}

void stages_check_iterate(Scene *scene)
{
    const int n = scene->step.dimension;
    RefGrid nodes = scene_nodes(scene);
    Expected expected = expected_open(scene);
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle p = scene_particle(scene, i);
        BoundParticle error = bound_gather(&nodes, &p);
        double d[3], D[9];
        reference_gather(&nodes, &p, d, D);
        error.D = bound_project(n, &p, d, D, error);
        reference_project(n, &p, d, D);
        expected_add(&expected, &p, d, D, error);
    }
    scene_run_particles(scene, scene->kernels->iterate);
    check_tiles(scene, &expected, false);
    expected_close(&expected);
    reference_grid_free(&nodes);
}

void stages_check_update(Scene *scene)
{
    RefGrid sizes, sum = scene_tiles(scene, &sizes), before = scene_nodes(scene);
    scene_run_nodes(scene, scene->kernels->update_nodes);
    RefGrid after = scene_nodes(scene);
    for (size_t i = 0; i < node_count(&sum); i++) {
        const double mass = before.node[i].mass, inverse = mass > 0.0 ? 1.0 / mass : 0.0;
        check_near(mass, after.node[i].mass, 0.0, "mass stays", (long)i);
        for (int a = 0; a < 3; a++)
            check_near(sum.node[i].u[a] * inverse, after.node[i].u[a], 28.0 * UNIT_ROUNDOFF * sizes.node[i].u[a] * inverse + FLUSHED * (1.0 + inverse),
                       "displacement of a node", (long)i);
    }
    reference_grid_free(&sum);
    reference_grid_free(&sizes);
    reference_grid_free(&before);
    reference_grid_free(&after);
}

static bool uses_volume(const Scene *scene, const RefParticle *p)
{
    return scene->step.with_volume && p->material.kind == K_LIQUID && p->material.volume_feedback > 0.0f;
}

/* Where a liquid particle is so close to counting as crowded that either answer is right. */
static bool crowding_is_unclear(const Scene *scene, const RefGrid *nodes, const RefParticle *p)
{
    if (!uses_volume(scene, p)) return false;
    const double own = 2.0 * TRANSFER_ROUNDINGS * UNIT_ROUNDOFF;
    const double shown = fabs(reference_compression(nodes, p) - REF_CROWDED), held = fabs(reference_held(&scene->step, nodes, p) - REF_CROWDED);
    return fmin(shown, held) <= own * REF_CROWDED;
}

/* How much J may differ where it is so close to a threshold of the feedback that either answer is right; else 0. */
static double unclear_feedback(const Scene *scene, const RefGrid *nodes, const RefParticle *before, double trace, double error)
{
    double d[3], D[9];
    reference_gather(nodes, before, d, D);
    const double room = REF_COMPRESSED / reference_compression(nodes, before), seen = fmin(room, 1.0);
    const double claimed = reference_control(&scene->step, nodes, before, D) * before->volume_ratio * (1.0 + trace);
    const double doubt = scene->step.dimension * error * before->volume_ratio + 2.0 * TRANSFER_ROUNDINGS * UNIT_ROUNDOFF * (seen + fabs(claimed));
    const bool clear = fabs(room - 1.0) > doubt && fabs(claimed - seen) > doubt && fabs(claimed - reference_stale(&before->material) * seen) > doubt;
    return clear ? 0.0 : (double)before->material.volume_feedback * fabs(seen - claimed);
}

/* The same for feedback that grows with the square of the way, whose slope is at most 2 / quiet_way. There the share multiplies up to 0.15,
 * by which J may exceed 1, more than what is wrong. */
static double quiet_error(const Scene *scene, const RefParticle *before, double missing, BoundParticle error, double J_error)
{
    const double slope = fmin(fabs(missing), REF_WRONG_MAX + 0.15) / (REF_WRONG_MAX - REF_WRONG_MIN) * J_error;
    const double way = fabs(missing) * (2.0 * sqrt(3.0) * error.d / scene->step.quiet_way + 8.0 * UNIT_ROUNDOFF);
    return (double)before->material.volume_feedback * (slope + way);
}

/* What the share of the feedback adds to the error of J: by its slopes, 1 / feedback_way in the displacement, and in what J lacks one over the
 * range in which the share grows. It multiplies at most the error at the end of that range, or what is lacking at full share. */
static double share_error(const Scene *scene, const RefParticle *before, double missing, BoundParticle error, double J_error)
{
    if (scene->step.quiet_way > 0.0) return quiet_error(scene, before, missing, error, J_error);
    if (scene->step.feedback_way == 0.0) return 0.0;
    const double range = REF_WRONG_MAX - REF_WRONG_MIN, slope = fmin(fabs(missing), reference_noise(&scene->step, -missing) + range) / range * J_error;
    const double way = fabs(missing) * (sqrt(3.0) * error.d / scene->step.feedback_way + 8.0 * UNIT_ROUNDOFF);
    return (double)before->material.volume_feedback * (slope + way);
}

/* J: its error, and with feedback also that of the inverse of the compression, as far as that limits J. */
static double volume_error(const Scene *scene, const RefGrid *nodes, const RefParticle *before, const RefParticle *expected, double trace,
                           BoundParticle gathered)
{
    const int n = scene->step.dimension;
    const double error = gathered.D;
    double bound = before->volume_ratio * (n * error + 8.0 * UNIT_ROUNDOFF * (1.0 + fabs(trace)));
    if (uses_volume(scene, before)) {
        const double claimed = 1.0 + before->volume_ratio * (1.0 + fabs(trace));
        const double most = scene->step.tensionless ? claimed + 1.0 / reference_held(&scene->step, nodes, before)
                                                    : fmin(REF_CROWDED / reference_compression(nodes, before), claimed);
        bound += (TRANSFER_ROUNDINGS + 8.0) * UNIT_ROUNDOFF * (most + fabs(expected->volume_ratio));
        if (scene->step.tensionless) bound += share_error(scene, before, most + fabs(expected->volume_ratio), gathered, bound);
        if (!scene->step.tensionless) bound += unclear_feedback(scene, nodes, before, trace, error) + n * error; /* the last: of the strain */
    }
    return bound;
}

/* J moves to the mean of its run, weighed by mass, and its error with it. */
static void even_out(const Scene *scene, uint32_t begin, uint32_t end, RefParticle *p, double *error)
{
    double mass = 0.0, volume = 0.0, doubt = 0.0, most = 0.0;
    for (uint32_t i = begin; i < end; i++) {
        mass += p[i].mass;
        volume += p[i].mass * p[i].volume_ratio;
        doubt += p[i].mass * error[i];
        most = fmax(most, p[i].volume_ratio);
    }
    for (uint32_t i = begin; i < end; i++) {
        const bool evens = p[i].material.kind == K_LIQUID && !scene->step.tensionless;
        const double share = evens ? (double)p[i].material.even_share : 0.0;
        p[i].volume_ratio += share * (volume / mass - p[i].volume_ratio);
        error[i] += share * (doubt / mass + (2.0 * (end - begin) + 8.0) * UNIT_ROUNDOFF * most);
    }
}

static void check_elastic(const Scene *scene, const RefGrid *nodes, const RefParticle *before, const RefParticle *expected,
                          const RefParticle *actual, long index)
{
    const int n = scene->step.dimension;
    double unlimited[9] = {0}, change[9];
    const double error = TRANSFER_ROUNDINGS * UNIT_ROUNDOFF * reference_gradient(nodes, before, change) + FLUSHED;
    const double F_error = bound_advance(n, before->deformation, change, error);
    matrix_multiply(n, change, before->deformation, unlimited);
    for (int k = 0; k < 9; k++) unlimited[k] += before->deformation[k];
    check_deformation(scene, expected, actual, unlimited, F_error, index);
    const double size = matrix_norm(n, actual->deformation);
    check_near(matrix_determinant(n, actual->deformation), actual->volume_ratio, 8.0 * UNIT_ROUNDOFF * pow(size, n) + FLUSHED, "det F", index);
    if (!condition_is_unclear(n, &before->material, unlimited, F_error))
        check_true(expected->status == actual->status, "status", index);
}

/* What the affine motion multiplies an error of D by. S / (1 + g) differs by dS / (1 + g) - S dg / (1 + g)^2, S the symmetric part and g = tr D > 0. */
static double end_growth_error(const Scene *scene, const RefParticle *p, const double D[9])
{
    const int n = scene->step.dimension;
    const double growth = fmax(matrix_trace(n, D), 0.0);
    if (p->material.kind != K_LIQUID || !scene->step.tensionless) return 0.0;
    return n * matrix_norm(n, D) / ((1.0 + growth) * (1.0 + growth));
}

static void check_moved(const Scene *scene, const RefParticle *before, const RefParticle *expected, const RefParticle *actual,
                        const double D[9], BoundParticle error, long index)
{
    const RefStep *step = &scene->step;
    const int n = step->dimension;
    const double d_error = sqrt(n) * error.d + 8.0 * UNIT_ROUNDOFF * step->max_displacement; /* slowing down mixes the axes */
    for (int a = 0; a < n; a++) {
        const double travelled = (actual->cell[a] - before->cell[a]) + actual->fraction[a];
        const double wanted = (expected->cell[a] - before->cell[a]) + expected->fraction[a];
        const double bound = (fabs(wanted) <= 2.0 ? error.d * sqrt(n) : d_error) + 4.0 * UNIT_ROUNDOFF * (1.0 + fabs(wanted));
        check_near(wanted, travelled, bound, "position", index);
        check_true(fabs(actual->fraction[a]) <= 0.5 + UNIT_ROUNDOFF, "a particle is in its cell", index);
        const double speeds = fabs(expected->velocity[a]) + fabs(before->velocity[a]); /* the kernel adds the change */
        check_near(expected->velocity[a], actual->velocity[a],
                   bound / (step->dt * step->cells_per_metre) + 4.0 * UNIT_ROUNDOFF * speeds, "velocity", index);
        for (int c = a * 3; c < a * 3 + n; c++) {
            /* A spin that is cut keeps its axis: no error of its vector grows, but each of three components may have that of all. */
            const double shared = (expected->affine[c] != D[c] / step->dt ? 1.0 + sqrt(3.0) : 1.0) + end_growth_error(scene, before, D);
            check_near(expected->affine[c], actual->affine[c],
                       shared * (error.D / step->dt + 4.0 * UNIT_ROUNDOFF * (fabs(D[c]) / step->dt + fabs(before->affine[c]))),
                       "affine velocity", index);
        }
    }
}

/* The counts per block agree with what happened to its particles. */
static void check_counts(const Scene *scene, const RefParticle *before)
{
    const Grid *grid = &scene->world->grid;
    const uint32_t *begin = grid->block_begin.data;
    for (int32_t block = 0; block < grid->particle_blocks; block++) {
        uint32_t moved = 0, lost = 0;
        for (uint32_t i = begin[block]; i < begin[block + 1]; i++) {
            const RefParticle p = scene_particle(scene, i);
            moved += p.cell[0] != before[i].cell[0] || p.cell[1] != before[i].cell[1] || p.cell[2] != before[i].cell[2];
            lost += p.status != K_ALIVE;
        }
        check_true(moved == scene->world->args.grid.moved[block], "particles that left their cells", block);
        check_true(lost == scene->world->args.grid.lost[block], "particles that have to go", block);
    }
}

/* Adds what keeping fine motion rounds. Its size is that of the displacement before the transfer and after it. */
static void add_flip_error(const Scene *scene, const RefParticle *p, BoundParticle *error)
{
    if (!reference_flips(&scene->step, p)) return;
    const double largest = fmax(fabs(p->velocity[0]), fmax(fabs(p->velocity[1]), fabs(p->velocity[2])));
    const double gravity = fmax(fabs(scene->step.gravity[0]), fabs(scene->step.gravity[1]));
    double d[3], D[9];
    reference_gather(scene->step.base, p, d, D);
    const double sizes = largest * scene->step.dt * scene->step.cells_per_metre + fabs(d[0]) + fabs(d[1]) + fabs(d[2]) + 2.0 * gravity;
    error->d += scene->step.flip * (bound_gather(scene->step.base, p).d + 8.0 * UNIT_ROUNDOFF * sizes);
}

/* Adds what the way out of crowded places rounds: the share by the error of the strain, the gradient by that of a gather. */
static void add_shift_error(const Scene *scene, const RefGrid *nodes, const RefParticle *p, BoundParticle *error)
{
    if (!uses_volume(scene, p)) return;
    const int n = scene->step.dimension;
    double d[3], D[9], shift[3];
    reference_gather(nodes, p, d, D);
    const double size = reference_shift(nodes, p, D, shift), strain = reference_strain(n, D);
    const double share_error = 4.0 * (n * error->D + 8.0 * UNIT_ROUNDOFF * strain);
    error->d += size * (share_error + TRANSFER_ROUNDINGS * UNIT_ROUNDOFF * fmin(4.0 * strain, 0.1));
}

/* Where matter neither parts nor closes up, as far as can be told. */
static bool parting_is_unclear(const Scene *scene, const RefParticle *p, const double D[9], double error)
{
    const int n = scene->step.dimension;
    return reference_flips(&scene->step, p) && fabs(matrix_trace(n, D)) <= n * error;
}

/* What is expected of a particle before the cell is evened out, and how much J may differ. False: nothing can be told. */
static bool expect_integrated(const Scene *scene, const RefGrid *nodes, const RefParticle *before, RefParticle *expected, double *J_error)
{
    BoundParticle error = bound_gather(nodes, before);
    double d[3], D[9];
    *expected = *before;
    *J_error = INFINITY;
    reference_gather(nodes, before, d, D);
    reference_integrate(&scene->step, nodes, expected);
    if (crowding_is_unclear(scene, nodes, before) || parting_is_unclear(scene, before, D, error.D)) return false;
    add_flip_error(scene, before, &error);
    *J_error = volume_error(scene, nodes, before, expected, matrix_trace(scene->step.dimension, D), error);
    return true;
}

static void check_integrated(const Scene *scene, const RefGrid *nodes, const RefParticle *before, const RefParticle *expected, double J_error, long i)
{
    const RefParticle actual = scene_particle(scene, (uint32_t)i);
    BoundParticle error = bound_gather(nodes, before);
    double d[3], D[9];
    reference_gather(nodes, before, d, D);
    add_flip_error(scene, before, &error);
    add_shift_error(scene, nodes, before, &error);
    if (expected->material.kind == K_LIQUID)
        check_near(expected->volume_ratio, actual.volume_ratio, J_error, "J", i);
    else
        check_elastic(scene, nodes, before, expected, &actual, i);
    check_moved(scene, before, expected, &actual, D, error, i);
}

/* Whether a particle is so close to counting as one of the inside, or as crushed, that either answer is right. */
static bool inside_is_unclear(const RefGrid *nodes, const RefParticle *p)
{
    const double own = 2.0 * TRANSFER_ROUNDINGS * UNIT_ROUNDOFF;
    return fabs(reference_sparsest(nodes, p) - REF_INNER) <= own || fabs(reference_compression(nodes, p) - REF_CRUSHED) <= own * REF_CRUSHED;
}

/* How much the factor of the volume control may differ, given the relative error of the sums over the block. */
static double control_error(const Scene *scene, const RefGrid *nodes, const RefParticle *p, double doubt)
{
    const int n = scene->step.dimension;
    double d[3], D[9];
    reference_gather(nodes, p, d, D);
    const double strain_error = n * bound_gather(nodes, p).D + 8.0 * UNIT_ROUNDOFF * reference_strain(n, D);
    return (double)p->material.volume_share * doubt + 100.0 * strain_error * fabs(scene->step.excess);
}

/* What is expected of the particles of a block. Sums over them round once each, and both are of positive terms with the error of a gather. */
static void expect_block(Scene *scene, const RefGrid *nodes, const RefParticle *before, uint32_t count, RefParticle *expected, double *J_error,
                         bool *is_clear)
{
    const double doubt = 4.0 * (TRANSFER_ROUNDINGS + count + 4.0) * UNIT_ROUNDOFF;
    bool unclear = false;
    for (uint32_t i = 0; i < count; i++) unclear = unclear || (uses_volume(scene, &before[i]) && inside_is_unclear(nodes, &before[i]));
    scene->step.excess = reference_excess(nodes, before, count);
    for (uint32_t i = 0; i < count; i++) {
        is_clear[i] = expect_integrated(scene, nodes, &before[i], &expected[i], &J_error[i]) && !unclear;
        if (uses_volume(scene, &before[i])) J_error[i] += control_error(scene, nodes, &before[i], doubt) * expected[i].volume_ratio;
    }
}

void stages_check_integrate(Scene *scene)
{
    const uint32_t count = scene->world->particles.count;
    RefGrid nodes = scene_nodes(scene);
    RefParticle *before = scene_particles(scene), *expected = scene_particles(scene);
    double *J_error = calloc(count, sizeof *J_error);
    bool *is_clear = calloc(count, sizeof *is_clear);
    scene_run_particles(scene, scene->kernels->integrate);
    const Grid *grid = &scene->world->grid;
    const uint32_t *begin = grid->block_begin.data;
    for (int32_t block = 0; block < grid->particle_blocks; block++) {
        const uint32_t first = begin[block];
        expect_block(scene, &nodes, before + first, begin[block + 1] - first, expected + first, J_error + first, is_clear + first);
    }
    for (uint32_t run = 0; run < grid->runs; run++) even_out(scene, grid->run_begin[run], grid->run_begin[run + 1], expected, J_error);
    for (uint32_t i = 0; i < count; i++)
        if (is_clear[i]) check_integrated(scene, &nodes, &before[i], &expected[i], J_error[i], (long)i);
    check_counts(scene, before);
    free(is_clear);
    free(J_error);
    free(expected);
    free(before);
    reference_grid_free(&nodes);
}

void stages_check(Scene *scene)
{
    stages_check_scatter(scene);
    stages_check_predict(scene);
    for (int i = 0; i < 2; i++) {
        stages_check_iterate(scene);
        stages_check_update(scene);
    }
    stages_check_integrate(scene);
}

void stages_check_spec(const SceneSpec *spec, int seeds)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject(spec->name, isa, dimension);
            for (int seed = 1; seed <= seeds; seed++) {
                Scene scene = scene_open(spec, isa, dimension, (uint32_t)seed);
                stages_check(&scene);
                scene_close(&scene);
            }
        }
    check_report(spec->name);
}
