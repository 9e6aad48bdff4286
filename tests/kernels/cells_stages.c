/* The kernels of pressures in cells, compared with the reference. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "bounds.h"
#include "check.h"
#include "solvers/dual/dual.h"
#include "dual_stages.h"
#include "matrices.h"

enum { CENTRE_ROUNDINGS = 14 }; /* a weight: 3 differences, 3 products; with mass, lightness, J and the multiplier 8 more */

static size_t node_count(const RefGrid *grid) { return (size_t)grid->size[0] * (size_t)grid->size[1] * (size_t)grid->size[2]; }

/* Whose particles a sum is over. */
typedef enum Whose { LIQUIDS, SOLIDS, LIQUIDS_AND_SAND, ALL } Whose;

static bool counts(Whose whose, const RefParticle *p)
{
    const bool liquid = p->material.kind == K_LIQUID;
    if (whose == LIQUIDS_AND_SAND) return liquid || p->material.yields == K_SAND;
    return whose == ALL || (whose == LIQUIDS) == liquid;
}

/* Sums over particles of h m times up to four quantities, and how many they are. */
typedef struct CellSum {
    double value[4], size[4];
    int terms;
} CellSum;

typedef void Quantities(const DualStage *stage, uint32_t row, const RefParticle *p, double value[4]);

static CellSum *sum_cells(const DualStage *stage, Whose whose, Quantities *quantities, const RefGrid *extent)
{
    CellSum *sums = calloc(node_count(extent), sizeof *sums);
    for (uint32_t i = 0; i < stage->scene.world->particles.count; i++) {
        const RefParticle p = scene_particle(&stage->scene, i);
        const RefCentres centres = reference_centres(extent->dimension, &p);
        double value[4] = {0};
        if (!counts(whose, &p)) continue;
        quantities(stage, i, &p, value);
        for (int c = 0; c < centres.count; c++) {
            CellSum *sum = &sums[reference_index(extent, centres.cell[c])];
            sum->terms++;
            for (int k = 0; k < 4; k++) {
                sum->value[k] += centres.weight[c] * p.mass * value[k];
                sum->size[k] += (centres.weight[c] + UNIT_ROUNDOFF) * p.mass * fabs(value[k]);
            }
        }
    }
    return sums;
}

/* ---- What cells hold ---- */

/* A cell holds the pressure of the lightest liquid; others count by their volume. */
static double lightness_of(const RefParticle *p) { return (double)p->material.lightness; }

static void first_quantities(const DualStage *stage, uint32_t row, const RefParticle *p, double value[4])
{
    const double light = lightness_of(p);
    value[0] = light;
    value[1] = light * p->volume_ratio;
    value[2] = light * light * (double)p->material.inverse_stiffness / (p->volume_ratio * p->volume_ratio);
    value[3] = dual_first_pressure(stage, row, stage->scene.world->particles.pressure[row]);
}

/* Runs a kernel that leaves four sums per cell in the tiles. */
static void check_sums(DualStage *stage, Kernel *kernel, Whose whose, Quantities *quantities)
{
    Scene *scene = &stage->scene;
    scene_run_particles(scene, kernel);
    RefGrid sizes, sum = scene_tiles(scene, &sizes);
    CellSum *expected = sum_cells(stage, whose, quantities, &sum);
    for (size_t i = 0; i < node_count(&sum); i++) {
        const double actual[4] = {sum.node[i].u[0], sum.node[i].u[1], sum.node[i].u[2], sum.node[i].mass};
        for (int k = 0; k < 4; k++) {
            const double bound = (CENTRE_ROUNDINGS + expected[i].terms) * UNIT_ROUNDOFF * expected[i].size[k] + FLUSHED;
            check_near(expected[i].value[k], actual[k], bound, "what a cell holds", (long)i);
        }
    }
    free(expected);
    reference_grid_free(&sum);
    reference_grid_free(&sizes);
}

void cells_check_begin(DualStage *stage) { check_sums(stage, stage->scene.kernels->cells_begin, LIQUIDS, first_quantities); }

/* What a cell asks for: its growth with its softness, or the bound without where its pressure explains too little of the growth. True: rounding may decide. */
static bool bound_growth(double most, double pressure, double *growth, double *soft)
{
    const double beyond = *growth - *soft * pressure - most;
    if (beyond > 0.0) {
        *growth = most;
        *soft = 0.0;
    }
    return fabs(beyond) < 1e-4 * (most + *soft * pressure);
}

/* Growth is that of the mean J, from nothing on; softness and first pressure are means. A cell adds up to 8 tiles. */
void cells_check_mean(DualStage *stage)
{
    Scene *scene = &stage->scene;
    KernelArgs *a = &scene->world->args;
    RefGrid sizes, sum = scene_tiles(scene, &sizes);
    scene_run_nodes(scene, scene->kernels->cells_mean);
    RefGrid mass = scene_scalars_of(scene, a->cells.mass), growth = scene_scalars_of(scene, a->cells.growth);
    RefGrid soft = scene_scalars_of(scene, a->cells.softness), pressure = scene_scalars_of(scene, a->cells.pressure);
    RefGrid old = scene_scalars_of(scene, a->cells.pressure_old);
    const double each = 20.0 * UNIT_ROUNDOFF;
    for (size_t i = 0; i < node_count(&sum); i++) {
        const double m = sum.node[i].u[0];
        check_near(m, mass.node[i].mass, each * m, "mass of a cell", (long)i);
        check_true(pressure.node[i].mass == old.node[i].mass, "the first pressure is the one before as well", (long)i);
        if (!(m > 1e-30)) continue;
        const double ratio = sum.node[i].u[1] / m, first = sum.node[i].mass / m;
        double wanted = fmax(1.0 / ratio - 1.0, 0.0), softness = sum.node[i].u[2] / m;
        check_near(first, pressure.node[i].mass, each * first + FLUSHED, "first pressure of a cell", (long)i);
        if (bound_growth(REF_GROWTH_MAX, first, &wanted, &softness)) continue;
        check_near(wanted, growth.node[i].mass, each * (1.0 + 1.0 / ratio), "growth of a cell", (long)i);
        check_near(softness, soft.node[i].mass, each * softness + FLUSHED, "softness of a cell", (long)i);
    }
    RefGrid *const all[] = {&sizes, &sum, &mass, &growth, &soft, &pressure, &old};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) reference_grid_free(all[i]);
}

/* ---- What solids add for the guess ---- */

/* 1 / (c K J^2) with the bulk modulus K = lambda + 2 mu / d, from the definition of the material. */
static void solid_quantities(const DualStage *stage, uint32_t row, const RefParticle *p, double value[4])
{
    const World *world = stage->scene.world;
    const pbmpm_material_def *def = &world->materials.def[world->particles.material[row]];
    const double shear = 0.5 * (double)def->young_modulus / (1.0 + (double)def->poisson_ratio);
    const double lambda = 2.0 * shear * (double)def->poisson_ratio / (1.0 - 2.0 * (double)def->poisson_ratio);
    const double bulk = reference_scale(&stage->scene.step, (double)def->density) * (lambda + 2.0 * shear / stage->scene.step.dimension);
    const double ratio = fmax(p->volume_ratio, (double)K_LIQUID_RATIO_MIN);
    const double light = lightness_of(p);
    value[0] = light;
    value[1] = light * ratio;
    value[2] = light * light / (bulk * ratio * ratio);
    value[3] = 0.0;
}

/* Liquids and solids count by their masses; a pressure is that of the liquid share. What has come apart may close where there is no liquid. */
void cells_check_solids(DualStage *stage)
{
    Scene *scene = &stage->scene;
    KernelArgs *a = &scene->world->args;
    check_sums(stage, scene->kernels->solids_begin, SOLIDS, solid_quantities);
    RefGrid sizes, sum = scene_tiles(scene, &sizes), mass = scene_scalars_of(scene, a->cells.mass);
    RefGrid growth = scene_scalars_of(scene, a->cells.growth), soft = scene_scalars_of(scene, a->cells.softness);
    RefGrid pressure = scene_scalars_of(scene, a->cells.pressure);
    scene_run_nodes(scene, scene->kernels->solids_mean);
    RefGrid all_mass = scene_scalars_of(scene, a->cells.mass), strain = scene_scalars_of(scene, a->cells.solid_growth);
    RefGrid less = scene_scalars_of(scene, a->cells.growth), softness = scene_scalars_of(scene, a->cells.softness);
    RefGrid start = scene_scalars_of(scene, a->cells.pressure), old = scene_scalars_of(scene, a->cells.pressure_old);
    const double each = 24.0 * UNIT_ROUNDOFF;
    for (size_t i = 0; i < node_count(&sum); i++) {
        const double solid = sum.node[i].u[0], liquid = mass.node[i].mass, m = solid + liquid;
        check_near(m, all_mass.node[i].mass, each * m, "mass of a cell with solids", (long)i);
        check_true(start.node[i].mass == old.node[i].mass, "the first pressure is the one before as well", (long)i);
        if (!(m > 1e-30)) continue;
        const double least = liquid > 0.0 ? 0.0 : -1.0;
        const double ratio = solid > 1e-30 ? sum.node[i].u[1] / solid : 1.0, share = solid / m, first = liquid / m * pressure.node[i].mass;
        double wanted = share * fmax(1.0 / ratio - 1.0, least), yields = sum.node[i].u[2] / m;
        check_near(first, start.node[i].mass, each * first + FLUSHED, "first pressure of a cell with solids", (long)i);
        check_near(liquid / m * growth.node[i].mass, less.node[i].mass, each, "growth of a cell with solids", (long)i);
        if (bound_growth(share * REF_GROWTH_MAX, first, &wanted, &yields)) continue;
        check_near(wanted, strain.node[i].mass, each * share * (1.0 + 1.0 / ratio) + FLUSHED, "strain of a cell", (long)i);
        const double mixed = liquid / m * soft.node[i].mass + yields;
        check_near(mixed, softness.node[i].mass, each * mixed + FLUSHED, "softness of a cell with solids", (long)i);
    }
    RefGrid *const all[] = {&sizes, &sum, &mass, &growth, &soft, &pressure, &all_mass, &strain, &less, &softness, &start, &old};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) reference_grid_free(all[i]);
}

/* ---- Pressures to nodes ---- */

/* A solid that takes part in the guess has S = p I, both now and before. */
static void check_isotropic(const DualStage *stage, uint32_t row, double expected, double bound)
{
    const int n = stage->scene.step.dimension;
    double S[9], Y[9];
    dual_multiplier(stage, row, S);
    dual_extrapolated(stage, row, Y);
    for (int k = 0; k < n * n; k++) {
        const int at = k / n * 3 + k % n;
        const bool diagonal = k / n == k % n;
        check_near(diagonal ? expected : 0.0, S[at], diagonal ? bound : 0.0, "multiplier of a solid in the guess", (long)row);
        check_true(Y[at] == S[at], "it is the one before as well", (long)row);
    }
}

/* Particles take the extrapolated pressure at their place; the stress of elastic ones that do not is extrapolated here as well. */
void cells_check_push(DualStage *stage)
{
    Scene *scene = &stage->scene;
    KernelArgs *a = &scene->world->args;
    const int n = scene->step.dimension;
    const double momentum = (double)a->dual.momentum;
    scene_run_particles(scene, scene->kernels->cells_push);
    RefGrid sizes, sum = scene_tiles(scene, &sizes), pushed = reference_grid(n, scene->low, scene->high);
    RefGrid pressure = scene_scalars_of(scene, a->cells.pressure), old = scene_scalars_of(scene, a->cells.pressure_old);
    BoundNode *bounds = calloc(node_count(&sum), sizeof *bounds);
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle p = scene_particle(scene, i);
        const RefCentres centres = reference_centres(n, &p);
        const double light = lightness_of(&p);
        double Y[9] = {0}, S[9], expected = 0.0, bound = 0.0, error = 0.0;
        const bool liquid = p.material.kind == K_LIQUID;
        for (int c = 0; c < centres.count && (liquid || a->cells.solid_growth); c++) {
            const int64_t at = reference_index(&sum, centres.cell[c]);
            const double now = pressure.node[at].mass, change = momentum * (now - old.node[at].mass);
            expected += light * centres.weight[c] * (now + change);
            bound += light * (centres.weight[c] * CENTRE_ROUNDINGS + 1.0) * UNIT_ROUNDOFF * (fabs(now) + 2.0 * fabs(change)) + FLUSHED;
        }
        if (liquid) {
            check_near(expected, (double)a->dual.pressure[i], bound, "pressure of a particle", (long)i);
            for (int k = 0; k < n; k++) Y[k * 4] = (double)a->dual.pressure[i];
        } else {
            if (a->cells.solid_growth) check_isotropic(stage, i, expected, bound);
            dual_extrapolated(stage, i, Y);
        }
        dual_multiplier(stage, i, S);
        for (int k = 0; k < 9; k++) error = fmax(error, 4.0 * UNIT_ROUNDOFF * (fabs(Y[k]) + fabs(S[k])));
        reference_push(&pushed, &p, Y);
        bound_push(&pushed, bounds, &p, Y, error);
    }
    for (size_t i = 0; i < node_count(&sum); i++)
        for (int k = 0; k < 3; k++)
            check_near(pushed.node[i].u[k], sum.node[i].u[k], bound_of_sum(&bounds[i], k), "pressures and stresses in tiles", (long)i);
    free(bounds);
    RefGrid *const all[] = {&sizes, &sum, &pushed, &pressure, &old};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) reference_grid_free(all[i]);
}

/* ---- The guess is added to the pressures of particles ---- */

/* A field of cells at a particle, and the error of it. */
static double at_particle(const RefGrid *cells, const RefParticle *p, double *error)
{
    const RefCentres centres = reference_centres(cells->dimension, p);
    double sum = 0.0;
    *error = 0.0;
    for (int c = 0; c < centres.count; c++) {
        const double value = cells->node[reference_index(cells, centres.cell[c])].mass;
        sum += lightness_of(p) * centres.weight[c] * value;
        *error += lightness_of(p) * (centres.weight[c] * CENTRE_ROUNDINGS + 1.0) * UNIT_ROUNDOFF * fabs(value) + FLUSHED;
    }
    return sum;
}

static bool is_sand(const DualStage *stage, uint32_t row) { return scene_particle(&stage->scene, row).material.yields == K_SAND; }

/* The pressure that sand starts from. */
static double borne_pressure(const DualStage *stage, uint32_t row)
{
    const int dimension = stage->scene.world->def.dimension;
    double S[9], sum = 0.0;
    dual_multiplier_before(stage, row, S);
    for (int k = 0; k < dimension; k++) sum += S[k * 4];
    return sum / dimension;
}

/* Liquids and sand start from the mean of the cells and the share `fine` of what they have beside it, others from cells alone. */
void cells_check_carry(DualStage *stage, float fine)
{
    Scene *scene = &stage->scene;
    World *world = scene->world;
    KernelArgs *a = &world->args;
    const uint32_t count = world->particles.count;
    double *own = malloc(count * sizeof *own);
    for (uint32_t i = 0; i < count; i++) own[i] = is_sand(stage, i) ? borne_pressure(stage, i) : dual_first_pressure(stage, i, a->dual.pressure[i]);
    RefGrid pressure = scene_scalars_of(scene, a->cells.pressure);
    a->dual.fine_carried = a->dual.grains_carried = fine;
    scene_run_particles(scene, scene->kernels->cells_carry);
    for (uint32_t i = 0; i < count; i++) {
        const RefParticle p = scene_particle(scene, i);
        double error;
        if (p.material.kind != K_LIQUID && !is_sand(stage, i)) continue;
        const double mean = at_particle(&pressure, &p, &error), expected = mean + (double)fine * (own[i] - mean);
        if (is_sand(stage, i)) {
            const double rounding = 2.0 * error + 16.0 * UNIT_ROUNDOFF * (fabs(own[i]) + mean);
            check_near(fmax(0.0, expected), borne_pressure(stage, i), rounding, "what sand carries", (long)i);
            continue;
        }
        check_near(fmax(0.0, expected), (double)a->dual.pressure[i], 2.0 * error + 8.0 * UNIT_ROUNDOFF * (own[i] + mean), "what is carried", (long)i);
        check_true(a->dual.pressure[i] == a->dual.pressure_old[i], "it is the one before as well", (long)i);
    }
    dual_check_tiles(stage, "what is carried in tiles");
    free(own);
    reference_grid_free(&pressure);
}

/* What changed in cells since is added to it, and what was carried is kept. */
void cells_check_add(DualStage *stage, Random *random)
{
    Scene *scene = &stage->scene;
    World *world = scene->world;
    KernelArgs *a = &world->args;
    const size_t cells = (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells;
    memcpy(a->cells.pressure_old, a->cells.pressure, cells * sizeof(float));
    for (size_t i = 0; i < cells; i++)
        if (a->cells.mass[i] > 0.0f) a->cells.pressure[i] = (float)((double)a->cells.pressure[i] * random_in(random, 0.0, 2.0) + random_in(random, 0.0, 0.05));
    RefGrid before = scene_scalars_of(scene, a->cells.pressure_old), now = scene_scalars_of(scene, a->cells.pressure);
    scene_run_particles(scene, scene->kernels->cells_add);
    for (uint32_t i = 0; i < world->particles.count; i++) {
        const RefParticle p = scene_particle(scene, i);
        double errors[2];
        if (p.material.kind != K_LIQUID) continue;
        const double old = (double)a->dual.pressure_old[i], change = at_particle(&now, &p, &errors[0]) - at_particle(&before, &p, &errors[1]);
        check_near(fmax(0.0, old + change), (double)a->dual.pressure[i], errors[0] + errors[1] + 4.0 * UNIT_ROUNDOFF * old, "what the guess adds", (long)i);
    }
    dual_check_tiles(stage, "what the guess adds in tiles");
    reference_grid_free(&before);
    reference_grid_free(&now);
}

/* ---- Traces to cells ---- */

static const RefGrid *nodes_now; /* what the traces are taken of */

static void trace_of(const DualStage *stage, uint32_t row, const RefParticle *p, double value[4])
{
    double d[3], D[9];
    (void)stage;
    (void)row;
    reference_gather(nodes_now, p, d, D);
    value[0] = 0.0;
    for (int k = 0; k < nodes_now->dimension; k++) value[0] += lightness_of(p) * D[k * 4];
    value[1] = lightness_of(p) * nodes_now->dimension * bound_gather(nodes_now, p).D;
}

/* Sums of h m of a quantity, of the displacements `nodes`. value[1] is its error. */
static void check_means(DualStage *stage, Whose whose, Quantities *quantities, const RefGrid *nodes)
{
    RefGrid sizes, sum = scene_scalar_tiles(&stage->scene, &sizes);
    nodes_now = nodes;
    CellSum *expected = sum_cells(stage, whose, quantities, &sum);
    for (size_t i = 0; i < node_count(&sum); i++) {
        const double rounded = (CENTRE_ROUNDINGS + expected[i].terms) * UNIT_ROUNDOFF * expected[i].size[0];
        check_near(expected[i].value[0], sum.node[i].mass, expected[i].value[1] + rounded + FLUSHED, "mean of a cell", (long)i);
    }
    free(expected);
    reference_grid_free(&sum);
    reference_grid_free(&sizes);
}

/* Elastic particles take their next step in the same kernel. */
void cells_check_trace(DualStage *stage)
{
    RefGrid nodes = scene_nodes(&stage->scene);
    dual_check_multipliers(stage, stage->scene.kernels->cells_trace, false);
    check_means(stage, LIQUIDS, trace_of, &nodes);
    reference_grid_free(&nodes);
}

/* In the guess they count as liquids do, and take no step. */
void cells_check_guess_trace(DualStage *stage)
{
    Scene *scene = &stage->scene;
    RefGrid nodes = scene_nodes(scene);
    scene->world->args.cells.probing = 1;
    scene_run_particles(scene, scene->kernels->cells_trace);
    scene->world->args.cells.probing = 0;
    check_means(stage, ALL, trace_of, &nodes);
    reference_grid_free(&nodes);
}

/* det (I + S) - 1 - tr S, S = sym D, within the bound of growth. Entries that are off by e move each of its products: the derivative of det is a cofactor, of a norm of
 * at most (1 + |S|)^(n-1). */
static double second_order_of(const DualStage *stage, const RefParticle *p, double *error)
{
    const int n = nodes_now->dimension;
    const double most = (double)stage->scene.world->args.dual.growth_max;
    const bool comes = p->material.kind == K_LIQUID; /* with its velocities */
    double d[3], D[9], S[9];
    if (comes)
        reference_start(&stage->scene.step, p, d, D);
    else
        reference_gather(nodes_now, p, d, D);
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) S[r * 3 + c] = 0.5 * (D[r * 3 + c] + D[c * 3 + r]) + (r == c ? 1.0 : 0.0);
    const double beyond = matrix_determinant(n, S) - 1.0 - matrix_trace(n, D), reach = pow(1.0 + matrix_norm(n, D), n - 1);
    const double off = comes ? 4.0 * UNIT_ROUNDOFF * matrix_norm(n, D) : bound_gather(nodes_now, p).D;
    *error = off * n * (reach + 1.0) + 16.0 * UNIT_ROUNDOFF * matrix_norm(n, D) * reach;
    return fmax(-most, fmin(most, beyond));
}

static void light_second_order_of(const DualStage *stage, uint32_t row, const RefParticle *p, double value[4])
{
    double error;
    (void)row;
    value[0] = lightness_of(p) * second_order_of(stage, p, &error);
    value[1] = lightness_of(p) * error;
}

/* What liquids keep; the rows of all others, which have stresses there, are left alone. */
static void check_kept_second_order(const DualStage *stage, const RefGrid *nodes)
{
    nodes_now = nodes;
    for (uint32_t i = 0; i < stage->scene.world->particles.count; i++) {
        const RefParticle p = scene_particle(&stage->scene, i);
        double error;
        const double expected = second_order_of(stage, &p, &error);
        if (p.material.kind == K_LIQUID)
            check_near(expected, (double)stage->second_order[i], error, "second order of a particle", (long)i);
        else
            check_true(isnan(stage->second_order[i]), "row of another", (long)i);
    }
}

void cells_check_second_order(DualStage *stage)
{
    Scene *scene = &stage->scene;
    RefGrid nodes = scene_nodes(scene);
    scene->world->args.dual.second_order = stage->second_order;
    scene_run_particles(scene, scene->kernels->second_order);
    check_means(stage, LIQUIDS_AND_SAND, light_second_order_of, &nodes);
    check_kept_second_order(stage, &nodes);
    reference_grid_free(&nodes);
}

/* ---- Proximal step ---- */

/* Sums over the cells of all blocks against what they report. */
static void check_reports(const DualStage *stage, double change2, double uphill, double error)
{
    const World *world = stage->scene.world;
    double reported[2] = {0};
    for (int32_t block = 0; block < world->grid.node_blocks; block++) {
        reported[0] += (double)world->args.cells.change2[block];
        reported[1] += (double)world->args.cells.uphill[block];
    }
    check_near(change2, reported[0], error, "change of cells", 0);
    check_near(uphill, reported[1], error, "uphill of cells", 0);
}

void cells_check_update(DualStage *stage)
{
    Scene *scene = &stage->scene;
    KernelArgs *a = &scene->world->args;
    const int n = scene->step.dimension;
    const double momentum = (double)a->dual.momentum, w = (double)a->cells.relaxation;
    RefGrid sizes, sum = scene_scalar_tiles(scene, &sizes), mass = scene_scalars_of(scene, a->cells.mass);
    RefGrid growth = scene_scalars_of(scene, a->cells.growth), soft = scene_scalars_of(scene, a->cells.softness);
    RefGrid now = scene_scalars_of(scene, a->cells.pressure), old = scene_scalars_of(scene, a->cells.pressure_old);
    scene_run_nodes(scene, scene->kernels->cells_update);
    RefGrid next = scene_scalars_of(scene, a->cells.pressure), kept = scene_scalars_of(scene, a->cells.pressure_old);
    double change2 = 0.0, uphill = 0.0, error = 0.0;
    for (size_t i = 0; i < node_count(&sum); i++) {
        const double m = mass.node[i].mass, p = now.node[i].mass, y = p + momentum * (p - old.node[i].mass), s = soft.node[i].mass;
        const double actual = next.node[i].mass, change = actual - y;
        check_true(kept.node[i].mass == p, "the pressure before is kept", (long)i);
        check_true(m > 0.0 || actual == 0.0, "an empty cell has no pressure", (long)i);
        if (!(m > 1e-30)) continue;
        const double mean = sum.node[i].mass / m, expected = reference_cell_pressure(n, w, growth.node[i].mass, s, mean, y);
        const double terms = growth.node[i].mass + 8.0 * sizes.node[i].mass / m + fabs(y) * s;
        const double y_error = 4.0 * UNIT_ROUNDOFF * (fabs(y) + momentum * (fabs(p) + fabs(old.node[i].mass)));
        check_near(expected, actual, 8.0 * UNIT_ROUNDOFF * terms / (n / w + s) + y_error + FLUSHED, "pressure of a cell", (long)i);
        change2 += 0.25 * n * m * change * change;
        uphill -= 0.25 * n * m * change * (actual - p);
        const double change_error = y_error + UNIT_ROUNDOFF * fabs(actual), way = fabs(actual - p);
        error += 0.25 * n * m * (2.0 * fabs(change) + way + change_error) * (change_error + 64.0 * UNIT_ROUNDOFF * (fabs(change) + way));
    }
    check_reports(stage, change2, uphill, error + FLUSHED);
    RefGrid *const all[] = {&sizes, &sum, &mass, &growth, &soft, &now, &old, &next, &kept};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) reference_grid_free(all[i]);
}
