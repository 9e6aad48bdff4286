#include "solvers/dual/pressure_guess.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/result.h"
#include "solvers/passes.h"
#include "world/depth.h"

/* Arrays of cells: residual, preconditioned residual, direction, response, mask, softness. */
enum { GUESS_ARRAYS = 6 };

/* Sums of a loop over cells; blocks that a thread takes at once; sums side by side, which divide the cells of a block. */
enum { SUMS = 2, GRAIN = 8, LANES = 4 };

pbmpm_result guess_prepare(World *world)
{
    Grid *grid = &world->grid;
    GuessState *guess = &world->guess;
    const size_t nodes = (size_t)grid->node_blocks * (size_t)grid->block_cells;
    if (array_reserve(&world->memory, &guess->cells, GUESS_ARRAYS * nodes, sizeof(float)) &&
        array_reserve(&world->memory, &guess->sums, SUMS * (size_t)grid->node_blocks, sizeof(double)) &&
        multilevel_build(&guess->multilevel, &world->memory, grid, 1, LEVELS_BEYOND))
        return PBMPM_OK;
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the coarse grids of %d blocks", grid->node_blocks);
}

void guess_free(World *world)
{
    array_free(&world->memory, &world->guess.cells);
    array_free(&world->memory, &world->guess.sums);
    multilevel_free(&world->guess.multilevel, &world->memory);
}

double guess_density(const World *world)
{
    const bool differ = materials_density_contrast(&world->materials, &world->particles) > 1.0;
    return differ && world->settings.pressure != PBMPM_PRESSURE_CELLS ? materials_lightest(&world->materials, &world->particles) : 0.0;
}

/* All pressures yield a little, a tenth as much as the slowest mode: a guess that is exact there answers the errors of the last substep with
 * its full weight, and so they may grow. Where liquids differ in density the slowest mode moves the densest: by their ratio less, for a pressure that is measured
 * by the lightest. If pressures yielded as among the lightest alone, none would bear a heavy liquid: at 1:10,000 the guess would find a thousandth of it, and light
 * liquid below would stay crushed. */
static float least_softness(const World *world)
{
    const double root = slowest_pressure(world);
    const double contrast = guess_density(world) > 0.0 ? materials_density_contrast(&world->materials, &world->particles) : 1.0;
    return (float)(0.1 * root * root / contrast);
}

/* Volume that is missing is given back in 1/60 s, and crushed matter grows by no more than GUESS_GROWTH_MAX per substep: the guess acts on all of a body at
 * once, and what it gives back in one substep becomes a velocity, missing volume * depth / dt. By trial. */
static const float GUESS_GROWTH_MAX = 0.05f;

/* A column of n cells that is short of e per cell has sunk by n e, and its top is thrown up by n a / dt if it is asked for a. Where a light liquid gives way
 * below a heavy one e is large, and the heavy one would come up higher than it fell from. So (n a / dt)^2 is at most g n e, half of what that fall gives: the
 * iterations after the guess ask for the rest. */
static GuessAsked asked_of(const World *world)
{
    const double fall = gravity_fall(world, &world->substep);
    const bool gives_way = materials_density_contrast(&world->materials, &world->particles) > 1.0 && fall > 0.0;
    return (GuessAsked){fminf(1.0f, (float)world->substep.reference_steps), gives_way ? (float)(fall / matter_depth(world)) : FLT_MAX};
}

/* The arrays of the conjugate gradients, one value per cell, and the numbers of an iteration. */
typedef struct Guess {
    World *world;
    const ContactFrame *contacts;
    float *residual, *better, *direction, *response, *mask, *soft;
    Loops loops;                   /* that have not run yet */
    KernelArgs probe;              /* for the responses of nodes and cells to pressures alone */
    GuessMeasures measures;        /* of the substep */
    float step, keep, mean;        /* of conjugate gradients; of a field over the mask */
} Guess;

/* Of a full cell's mass. What a few particles at the edge of their reach say of a cell behind a wall would count as much as what a full cell says. By trial. */
static const double LITTLE = 0.01;

static GuessMeasures measures_of(const World *world)
{
    const double lightest = materials_lightest(&world->materials, &world->particles);
    return (GuessMeasures){asked_of(world), (float)guess_density(world), (float)(LITTLE * lightest), least_softness(world)};
}

static void open_guess(Guess *g, World *world, const ContactFrame *contacts)
{
    const size_t n = (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells;
    float *cells = world->guess.cells.data;
    g->world = world;
    g->contacts = contacts;
    g->residual = cells;
    g->better = cells + n;
    g->direction = cells + 2 * n;
    g->response = cells + 3 * n;
    g->mask = cells + 4 * n;
    g->soft = cells + 5 * n;
    g->measures = world->guess.measures;
    g->step = g->keep = g->mean = 0.0f;
    g->probe = world->args;
    g->probe.cells.probing = 1;
    g->probe.cells.trace = g->response;
    loops_open(&g->loops, world->pool);
}

/* ---- Loops over cells: per block, with sums that are the same for any number of threads ---- */

/* Works on the cells [begin, end) of a block, and adds what they contribute to the sums. */
typedef void CellWork(const Guess *g, size_t begin, size_t end, double *sum);

typedef struct CellJob {
    const Guess *guess;
    CellWork *work;
    bool sums;
} CellJob;

static void work_on_blocks(void *context, int32_t begin, int32_t end)
{
    const CellJob *job = context;
    const World *world = job->guess->world;
    const size_t cells = (size_t)world->grid.block_cells;
    for (int32_t block = begin; block < end; block++) {
        double none[SUMS], *sum = job->sums ? (double *)world->guess.sums.data + SUMS * (size_t)block : none;
        for (int k = 0; k < SUMS; k++) sum[k] = 0.0;
        job->work(job->guess, (size_t)block * cells, ((size_t)block + 1) * cells, sum);
    }
}

static void over_cells(Guess *g, CellWork *work)
{
    const CellJob job = {g, work, false};
    LOOPS_ADD(&g->loops, grid_nodes(&g->world->grid, GRAIN), work_on_blocks, &job);
}

/* The sums, in the order of the blocks. */
typedef struct Totals {
    double sum[SUMS];
} Totals;

/* Of the last loop that summed. */
static Totals totals_of(const World *world)
{
    const double *sums = world->guess.sums.data;
    Totals totals = {{0}};
    for (int32_t block = 0; block < world->grid.node_blocks; block++)
        for (int k = 0; k < SUMS; k++) totals.sum[k] += sums[SUMS * (size_t)block + (size_t)k];
    return totals;
}

/* Adds a loop that sums, which one that runs with it must not do after it. */
static void sum_over_cells(Guess *g, CellWork *work)
{
    const CellJob job = {g, work, true};
    LOOPS_ADD(&g->loops, grid_nodes(&g->world->grid, GRAIN), work_on_blocks, &job);
}

/* Runs the loops, the last of which sums. */
static Totals run_and_sum(Guess *g, CellWork *work)
{
    sum_over_cells(g, work);
    loops_run(&g->loops);
    return totals_of(g->world);
}

static double dot(const Guess *g, const float *a, const float *b, size_t begin, size_t end)
{
    const float *mass = g->world->args.cells.mass;
    double sum[LANES] = {0};
    for (size_t i = begin; i < end; i += LANES)
        for (size_t k = 0; k < LANES; k++) sum[k] += (double)(mass[i + k] * a[i + k] * b[i + k]);
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* Displacements of the nodes from the pressures `of` alone, the same in all loops that run together. */
static void respond(Guess *g, float *of)
{
    const World *world = g->world;
    g->probe.cells.pressure = g->probe.cells.pressure_old = of;
    solver_add_rows(&g->loops, world, world->kernels->cells_push, &g->probe);
    solver_add_nodes(&g->loops, world, world->kernels->respond_nodes, &g->probe, NULL);
    walls_add(&world->walls, g->contacts, &g->loops, true, NULL);
}

/* response = means of tr D of the displacements that the nodes have. */
static void trace(Guess *g)
{
    const World *world = g->world;
    solver_add_rows(&g->loops, world, world->kernels->cells_trace, &g->probe);
    solver_add_nodes(&g->loops, world, world->kernels->cells_respond, &g->probe, NULL);
}

/* 4 m |u|^2. */
static float energy_of_node(const float *u) { return 4.0f * u[3] * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]); }

/* 4 p . u, with p the momentum that pressures gave to a node and u what the walls leave of it; elsewhere p = m u. Over nodes that hold the response to pressures s it
 * sums up to sum_c m_c s_c r_c, with r the means of tr D: both transfers are each other's transpose. */
static float work_on_node(const Guess *g, size_t node)
{
    const float *u = g->world->args.grid.node + node * K_NODE_WIDTH;
    return walls_list(&g->world->walls, (uint32_t)node) ? 4.0f * walls_work(&g->world->walls, (uint32_t)node, u) : energy_of_node(u);
}

/* ---- The preconditioner ---- */

/* In a closed box that is full a constant pressure moves nothing, and no pressure answers to a volume that does not fit: the solution would
 * grow without bound. The surface of matter n cells deep gives a constant pressure an energy of about 0.45 / n per mass. */
static bool is_closed(const World *world, double energy, double mass) { return energy * matter_depth(world) < 0.05 * mass; }

static void press_everywhere(const Guess *g, size_t begin, size_t end, double *sum)
{
    (void)sum;
    const float *mass = g->world->args.cells.mass;
    for (size_t i = begin; i < end; i++) g->response[i] = mass[i] > 0.0f ? 1.0f : 0.0f;
}

/* What a node answers to a pressure of cells with, over what one of the measured density does. */
static float lightness_of(const Guess *g, size_t node)
{
    const float *density = g->world->args.grid.node_density;
    return g->measures.density > 0.0f && density && density[node] > 0.0f ? g->measures.density / density[node] : 1.0f;
}

/* The energy of a pressure field s is 4 sum_i m_i |u_i|^2 with m_i u_i = sum_p m w s (x_i - x_p). Where matter is all around, that is
 * -m_i grad s / 4; at a surface s itself counts, by the displacement that a pressure of 1 everywhere gives. */
static void weigh_cells(const Guess *g, size_t begin, size_t end, double *sum)
{
    const float *node = g->world->grid.node.data, *mass = g->world->args.cells.mass;
    float *stiffness = g->better, *load = g->direction;
    for (size_t i = begin; i < end; i++) {
        const float *u = node + i * K_NODE_WIDTH;
        const float light = lightness_of(g, i), energy = energy_of_node(u);
        g->soft[i] = g->world->args.cells.softness[i] + g->measures.least;
        stiffness[i] = u[3] * light * light;
        load[i] = energy + mass[i] * g->soft[i];
        sum[0] += (double)(work_on_node(g, i) / (light * light) + mass[i] / light * g->soft[i]); /* as if all were as dense */
        sum[1] += (double)(mass[i] / light);
    }
}

void guess_begin(World *world, const ContactFrame *contacts)
{
    Guess g;
    world->guess.measures = measures_of(world);
    open_guess(&g, world, contacts);
    over_cells(&g, press_everywhere);
    respond(&g, g.response);
    sum_over_cells(&g, weigh_cells);
    multilevel_weigh(&world->guess.multilevel, &g.loops, g.direction, g.better, 1.0);
    loops_run(&g.loops);
    const Totals totals = totals_of(world);
    world->guess.closed = is_closed(world, totals.sum[0], totals.sum[1]);
}

static void sum_over_mask(const Guess *g, const float *field, size_t begin, size_t end, double *sum)
{
    sum[0] += dot(g, field, g->mask, begin, end);
    sum[1] += dot(g, g->mask, g->mask, begin, end);
}

static void sum_residual(const Guess *g, size_t begin, size_t end, double *sum) { sum_over_mask(g, g->residual, begin, end, sum); }

static void sum_better(const Guess *g, size_t begin, size_t end, double *sum) { sum_over_mask(g, g->better, begin, end, sum); }

static float mean_of(Totals totals) { return (float)(totals.sum[0] / fmax(totals.sum[1], 1e-300)); }

static void mask_better(const Guess *g, size_t begin, size_t end, double *sum)
{
    for (size_t i = begin; i < end; i++) g->better[i] *= g->mask[i];
    sum[0] += dot(g, g->residual, g->better, begin, end);
}

static void take_mean_of_better(const Guess *g, size_t begin, size_t end, double *sum)
{
    for (size_t i = begin; i < end; i++) g->better[i] -= g->mean * g->mask[i];
    sum[0] += dot(g, g->residual, g->better, begin, end);
}

/* What the levels do not do, and what they are given. */
static void scale_residual(const Guess *g, size_t begin, size_t end)
{
    const float *mass = g->world->args.cells.mass;
    const float own = (float)g->world->def.dimension;
    for (size_t i = begin; i < end; i++) {
        g->better[i] = g->residual[i] / (own * lightness_of(g, i) + g->soft[i]);
        g->response[i] = mass[i] * g->residual[i];
    }
}

/* better = B residual, among the cells of the mask, after scale_residual(). Returns <residual, better>. */
static double precondition(Guess *g)
{
    multilevel_add(&g->world->guess.multilevel, &g->loops, g->response, g->better);
    const double size = run_and_sum(g, mask_better).sum[0];
    if (!g->world->guess.closed) return size;
    g->mean = mean_of(run_and_sum(g, sum_better));
    return run_and_sum(g, take_mean_of_better).sum[0];
}

/* ---- The solution ---- */

/* By how much the matter in a cell is to grow: liquid too dense, solids crushed. */
static float growth_of(const KernelArgs *a, GuessAsked asked, size_t cell)
{
    const float missing = a->cells.growth[cell];
    const float fallen = sqrtf(asked.fallen2 * missing), most = fallen < GUESS_GROWTH_MAX ? fallen : GUESS_GROWTH_MAX, share = asked.share * missing;
    const float solid = a->cells.solid_growth ? a->cells.solid_growth[cell] : 0.0f, second = a->cells.second_order ? a->cells.second_order[cell] : 0.0f;
    return (share < most ? share : most) + solid - second;
}

static void find_residual(const Guess *g, size_t begin, size_t end, double *sum)
{
    (void)sum;
    const KernelArgs *a = &g->world->args;
    for (size_t i = begin; i < end; i++) {
        const float r = growth_of(a, g->measures.asked, i) - g->response[i] - a->cells.pressure[i] * a->cells.softness[i];
        g->mask[i] = a->cells.mass[i] > g->measures.little && (a->cells.pressure[i] > 0.0f || r > 0.0f) ? 1.0f : 0.0f;
        g->residual[i] = r * g->mask[i];
    }
}

static void start_direction(const Guess *g, size_t begin, size_t end, double *sum)
{
    (void)sum;
    for (size_t i = begin; i < end; i++) g->residual[i] -= g->mean * g->mask[i];
    scale_residual(g, begin, end);
    memset(g->direction + begin, 0, (end - begin) * sizeof(float));
}

static void turn_direction(const Guess *g, size_t begin, size_t end, double *sum)
{
    (void)sum;
    for (size_t i = begin; i < end; i++) g->direction[i] = g->better[i] + g->keep * g->direction[i];
}

/* The curvature along the direction, from the response to it. */
static void soften_response(const Guess *g, size_t begin, size_t end, double *sum)
{
    for (size_t i = begin; i < end; i++) g->response[i] = (g->response[i] + g->soft[i] * g->direction[i]) * g->mask[i];
    sum[0] += dot(g, g->direction, g->response, begin, end);
}

/* The same from the nodes alone, where the response itself is not wanted any more. */
static void sum_curvature(const Guess *g, size_t begin, size_t end, double *sum)
{
    const float *mass = g->world->args.cells.mass;
    for (size_t i = begin; i < end; i++) {
        const float s = g->direction[i];
        sum[0] += (double)(work_on_node(g, i) + mass[i] * g->soft[i] * s * s);
    }
}

static void step_and_go_on(const Guess *g, size_t begin, size_t end, double *sum)
{
    (void)sum;
    float *pressure = g->world->args.cells.pressure;
    for (size_t i = begin; i < end; i++) {
        pressure[i] += g->step * g->direction[i];
        g->residual[i] -= g->step * g->response[i];
    }
    scale_residual(g, begin, end);
}

static void step_and_stop(const Guess *g, size_t begin, size_t end, double *sum)
{
    (void)sum;
    float *pressure = g->world->args.cells.pressure;
    for (size_t i = begin; i < end; i++) {
        const float next = pressure[i] + g->step * g->direction[i];
        pressure[i] = next > 0.0f && next < K_INCREMENT_MAX ? next : 0.0f;
    }
}

/* Conjugate gradients; the last iteration finds no new residual, for nobody would use it. */
void guess_solve(World *world, const ContactFrame *contacts, int iterations)
{
    Guess g;
    open_guess(&g, world, contacts);
    trace(&g);
    over_cells(&g, find_residual);
    if (world->guess.closed) g.mean = mean_of(run_and_sum(&g, sum_residual));
    over_cells(&g, start_direction);
    double size = precondition(&g);
    for (int left = iterations; left > 0 && size > 0.0 && !solver_time_is_up(world); left--) {
        over_cells(&g, turn_direction);
        respond(&g, g.direction);
        if (left > 1) trace(&g);
        const double curvature = run_and_sum(&g, left > 1 ? soften_response : sum_curvature).sum[0];
        g.step = curvature > 0.0 ? (float)(size / curvature) : 0.0f;
        if (left == 1 || !(curvature > 0.0)) break;
        over_cells(&g, step_and_go_on);
        const double next = precondition(&g);
        g.keep = (float)(next / size);
        g.step = 0.0f;
        size = next;
    }
    over_cells(&g, step_and_stop);
    loops_run(&g.loops);
}

/* With u the best displacements for the pressures p among those that are admissible, the value of
 *     sum_i m_i/2 |u_i - u*_i|^2 - q_i . u_i + sum_c m_c/4 p_c (growth_c - softness_c p_c / 2),
 * of which the pressures that are sought are the maximum. Nodes at walls count by their lumped masses, see walls_value(). */
static void sum_gain(const Guess *g, size_t begin, size_t end, double *sum)
{
    const KernelArgs *a = &g->world->args;
    for (size_t i = begin; i < end; i++) {
        const float *u = a->grid.node + i * K_NODE_WIDTH, *base = a->grid.node_base + i * K_NODE_WIDTH, *q = a->dual.node_push + i * K_NODE_WIDTH;
        const float growth = growth_of(a, g->measures.asked, i), p = a->cells.pressure[i];
        float gain = 0.25f * a->cells.mass[i] * p * (growth - 0.5f * a->cells.softness[i] * p);
        if (walls_list(&g->world->walls, (uint32_t)i))
            gain += walls_value(&g->world->walls, (uint32_t)i, u, base, q);
        else
            for (int k = 0; k < 3; k++) gain += 0.5f * u[3] * (u[k] - base[k]) * (u[k] - base[k]) - q[k] * u[k];
        sum[0] += (double)gain;
    }
}

double guess_gain(World *world, Loops *loops)
{
    Guess g;
    open_guess(&g, world, NULL);
    const CellJob job = {&g, sum_gain, true};
    LOOPS_ADD(loops, grid_nodes(&world->grid, GRAIN), work_on_blocks, &job);
    loops_run(loops);
    return totals_of(world).sum[0];
}

static void take_back(void *context, int32_t begin, int32_t end)
{
    const World *world = *(World **)context;
    const size_t cells = (size_t)world->grid.block_cells, first = (size_t)begin * cells, count = (size_t)(end - begin) * cells;
    memcpy(world->args.cells.pressure + first, world->args.cells.pressure_old + first, count * sizeof(float));
}

void guess_take_back(World *world, Loops *loops) { LOOPS_ADD(loops, grid_nodes(&world->grid, GRAIN), take_back, &world); }
