#include "solvers/dual/dual.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/result.h"
#include "solvers/dual/acceleration.h"
#include "solvers/dual/dual_error.h"
#include "solvers/dual/dual_gains.h"
#include "solvers/dual/granular_bound.h"
#include "solvers/dual/pressure_guess.h"
#include "solvers/dual/rounds.h"
#include "solvers/eddy_damping.h"
#include "solvers/moduli.h"
#include "solvers/passes.h"
#include "world/depth.h"

/* Floats per node of the arrays of cells: mass, growth, softness, pressure, pressure_old. */
enum { CELL_ARRAYS = 5 };

static bool in_cells(const World *world) { return world->settings.pressure == PBMPM_PRESSURE_CELLS && !joint_is_chosen(world); }

/* Whether bodies share the world with liquid or sand, or these with each other. Solids then take part in the guess of the pressure, which would push them as if they
 * had no stiffness, and take rounds by themselves but in the joint solver. */
static bool shares_world(const World *world)
{
    bool bodies = false;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        bodies = bodies || (world->particles.of_material[slot] > 0 && material_is_solid(&world->materials, slot) && world->materials.kernel[slot].yields != K_SAND);
    return solver_holds_liquid(world) ? bodies || solver_holds_sand(world) : bodies && solver_holds_sand(world);
}

/* Steps of the guess before the iterations, for liquids and sand. Without gravity any guess does harm in free flight, where no more iterations follow than it takes.
 * Before a single one it does to liquid; but sand that nothing else bears was crushed to a tenth at 60 Hz x 1, and stands with it.
 * Where a substep finds less than half of the pressure that a mode lacks, the mode grows: docs/method.md, "Why few
 * steps are not enough". Pressures where liquid meets solids differ from cell to cell, which takes the first steps:
 * with three, pools with a body in them heaved at 0.1 m/s and more. With as many as there are iterations they heave
 * less, and with ten hardly. */
static int guess_iterations(const World *world)
{
    const int iterations = world->settings.iterations;
    if (joint_is_chosen(world)) return iterations;
    if (!solver_holds_sand(world) && (!solver_holds_liquid(world) || iterations == 1)) return 0;
    if (iterations <= LEADING_STEPS && gravity_strength(world) == 0.0) return 0;
    return iterations < LEADING_STEPS ? iterations : LEADING_STEPS;
}

/* Pressure carried over without a guess is integral control: unstable where the solution is truncated. Half of it was stable at any number of
 * iterations that was tried, and worth twice as many: by trial. */
static const double CARRIED_SHARE = 0.5;

/* With a single iteration the pressure of slow motion is -k sum_j CARRIED^j e_(n+1-j), with e_(n+1) = e_n + v the strain that the predictor leads to. What is
 * carried lags by CARRIED / (1 - CARRIED) substeps behind that, which is one ahead: the force answers to the strain (1 - 2 CARRIED) / (1 - CARRIED)
 * substeps from now and damps if that is positive. With a half nothing damps, and pools bounce for ever; this leads by a fifth of a substep. By trial. */
static const double CARRIED_SHARE_OF_ONE = 0.45;

/* The guess finds the pressures of cells anew, as a correction: all is kept, but see fine_carried(). Not where liquids differ in density: there the guess is
 * truncated too, by what the heavy one may rise (pressure_guess.c). With all kept liquids of 1:10 to 1:10,000 gained 0.3 to 111 % of energy at 60 Hz x 2, with three
 * quarters 0.1 %, with a half nothing. The price: oil on 6 cells of water stirs at 9 mm/s at 60 Hz x 5, not at 3.
 * Nor of liquid so crushed that growth_max() cuts short what it asks for (crushed_carried). In a slit between walls nothing answers to that, and it would add up from
 * substep to substep: 180 times what one asks for, which threw it out at 82 m/s at 240 Hz x 2 when the walls opened. With a half it leaves at 6 to 11. */
double dual_carried_share(const World *world)
{
    if (world->settings.iterations == 1 && guess_iterations(world) == 0) return CARRIED_SHARE_OF_ONE;
    const bool corrected = guess_iterations(world) > 0 && !in_cells(world) && guess_density(world) == 0.0;
    return corrected ? 1.0 : CARRIED_SHARE;
}

/* What particles ask for beside their cells cannot be had in part, see carry_liquid_gang() in ispc/cells.isph; it grows with each iteration. Kept by the share g, what n
 * iterations per substep add comes to n / (1 - g) of them. Pools of 12 cells rest best with about 25, at 30, 60 and 240 Hz, 2 to 20 iterations. */
static float fine_carried(const World *world)
{
    static const double ITERATIONS_KEPT = 25.0; /* by trial, on pools: see above */
    return (float)fmax(0.0, 1.0 - world->settings.iterations / ITERATIONS_KEPT);
}

/* What solids are asked to hold follows them, slowly where they were raised; see solver.c. */
static double trusted_iterations(const World *world)
{
    const double share = world->slow_iterations > 0.0 ? fmin(1.0, world->slow_iterations / (double)world->settings.iterations) : 1.0;
    return share * world->settings.iterations;
}

static bool takes_rounds(const World *world) { return !joint_is_chosen(world) && guess_iterations(world) > 0 && !in_cells(world) && shares_world(world); }

/* Whether solids take part in the guess: sand always, elastic bodies where they share the world with liquid. */
static bool guesses_solids(const World *world)
{
    return guess_iterations(world) > 0 && !in_cells(world) && (shares_world(world) || solver_holds_sand(world));
}

/* Whether what strain does beyond its trace is asked for, see ispc/granular.isph. It is found where the guess begins; in the joint solver the sketch of solids has moved sand by then. */
static bool finds_second_order(const World *world) { return guess_iterations(world) > 0 && !in_cells(world) && !joint_is_chosen(world); }

static bool is_bounded(const World *world) { return solver_holds_sand(world) && !joint_is_chosen(world); }

static bool measures_gains(const World *world) { return is_bounded(world) || (eddy_damping_acts(world) && !joint_is_chosen(world)); }

pbmpm_result dual_prepare(World *world)
{
    DualState *dual = &world->dual;
    const Grid *grid = &world->grid;
    const size_t blocks = (size_t)grid->node_blocks, nodes = blocks * (size_t)grid->block_cells;
    bool ok = array_reserve(&world->memory, &dual->node_push, nodes * K_NODE_WIDTH, sizeof(float)) &&
              array_reserve(&world->memory, &dual->change2, blocks, sizeof(float)) &&
              array_reserve(&world->memory, &dual->uphill, blocks, sizeof(float));
    if (ok)
        ok = array_reserve(&world->memory, &dual->cells, CELL_ARRAYS * nodes, sizeof(float)) &&
             array_reserve(&world->memory, &dual->cell_change2, blocks, sizeof(float)) &&
             array_reserve(&world->memory, &dual->cell_uphill, blocks, sizeof(float));
    if (ok && guesses_solids(world)) ok = array_reserve(&world->memory, &dual->cell_solid_growth, nodes, sizeof(float));
    if (ok && finds_second_order(world)) ok = array_reserve(&world->memory, &dual->cell_second_order, nodes, sizeof(float));
    if (ok && takes_rounds(world)) ok = rounds_reserve(world);
    ok = ok && dual_error_prepare(world) && eddy_damping_prepare(world);
    if (ok && measures_gains(world)) ok = dual_gains_prepare(world);
    if (ok && is_bounded(world)) ok = granular_bound_prepare(world);
    if (!ok) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the dual solver on %d blocks", grid->node_blocks);
    const pbmpm_result result = guess_prepare(world);
    return result == PBMPM_OK ? particles_enable_pressure(&world->particles, &world->memory) : result;
}

void dual_free(World *world)
{
    DualState *dual = &world->dual;
    RoundsState *rounds = &dual->rounds;
    Array *arrays[] = {&dual->node_push,    &dual->change2,     &dual->uphill,  &dual->cells,     &dual->cell_solid_growth, &dual->cell_second_order,
                       &dual->cell_change2, &dual->cell_uphill, &rounds->solid, &rounds->touched, &rounds->mark};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(&world->memory, arrays[i]);
    dual_error_free(world);
    eddy_damping_free(world);
    dual_gains_free(world);
    granular_bound_free(world);
}

static float smallest_relaxation(const World *world)
{
    float smallest = 2.0f;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (world->particles.of_material[slot] > 0 && (!material_is_solid(&world->materials, slot) || world->materials.kernel[slot].yields == K_SAND))
            smallest = fminf(smallest, world->materials.kernel[slot].relaxation);
    return smallest;
}

/* Sand that is compressed beyond what its pressure explains gets VOLUME_FEEDBACK of that back per 1/60 s, as J follows the grid by default. What comes back at
 * once bounces: with 0.2 heaps below a funnel end at 15.6 to 16.8 degrees, not at 17.1 to 17.7. With 0.05 a block that falls two thirds of a metre onto cells of
 * 1.25 cm has 0.88 of its volume a second later, not 0.95 (tests/field/run.py funnel falls --settings 60x5). */
static void bind_cells(World *world)
{
    KernelArgs *a = &world->args;
    const size_t nodes = (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells;
    float *cells = world->dual.cells.data;
    a->cells.mass = cells;
    a->cells.growth = cells + nodes;
    a->cells.softness = cells + 2 * nodes;
    a->cells.pressure = cells + 3 * nodes;
    a->cells.pressure_old = cells + 4 * nodes;
    a->cells.solid_growth = guesses_solids(world) ? world->dual.cell_solid_growth.data : NULL;
    /* Found as a mean of cells, as traces are: see guess(). */
    a->cells.second_order = a->cells.trace = finds_second_order(world) ? world->dual.cell_second_order.data : NULL;
    a->cells.settle = solver_holds_sand(world) ? (float)per_reference_step((double)VOLUME_FEEDBACK, &world->substep) : 1.0f;
    a->cells.elastic_guesses = shares_world(world);
    a->cells.change2 = world->dual.cell_change2.data;
    a->cells.uphill = world->dual.cell_uphill.data;
    a->cells.relaxation = smallest_relaxation(world);
}

/* The largest growth that crushed liquid is asked for in 1/60 s, and per substep of a single iteration. What grows by a share per substep moves faster the
 * shorter the substep is: a sheet of liquid that was let go at 480 Hz grew 1.3-fold in each, up to 45 m/s at its edges. Liquid that stores no energy has no speed of
 * its own to leave at. One that bears a heavier one leaves faster, by the root of their densities (Torricelli). But little of what a single iteration asks for
 * comes: a growth that is asked for everywhere pushes surfaces alone. Its pressure is what it asks for times its stiffness, and a bound of the one bounds the other: a
 * column at 240 Hz x 1 sank by 59 %, not 18 %. The stiffness of accelerated iterations grows with N^2; so N may ask for that much less. What the guess asks for comes at
 * once. A pool that a single iteration had left crushed met sand, with which there is a guess, and leapt with 7 % more energy than the scene had (random scene 801271). */
static float growth_max(const World *world)
{
    const double heavier = materials_density_contrast(&world->materials, &world->particles);
    const double in_time = world->substep.reference_steps * sqrt(heavier), iterations = (double)world->settings.iterations;
    const double lost = guess_iterations(world) > 0 ? 0.0 : 1.0 / (iterations * iterations);
    return (float)(CRUSHED_GROWTH * fmin(1.0, fmax(in_time, lost)));
}

/* The multipliers of elastic particles and what an iteration changed need memory for this substep only: the spare arrays, which
 * nobody uses between the sort and the next. What liquid keeps for the iterations shares one with stresses, of which its rows have none. guess() writes
 * it for all rows of liquid that iterate, rounds included, and none is read without one: solids by themselves, sleepers and the still have no iterations. */
static void bind(World *world)
{
    KernelArgs *a = &world->args;
    Particles *p = &world->particles;
    a->dual.pressure = p->pressure;
    a->dual.pressure_old = particles_spare(p, CLASS_SCALAR, 0);
    a->dual.second_order = finds_second_order(world) ? particles_spare(p, CLASS_MATRIX, 0) : NULL;
    a->dual.node_push = world->dual.node_push.data;
    a->dual.change2 = world->dual.change2.data;
    a->dual.uphill = world->dual.uphill.data;
    a->dual.momentum = 0.0f;
    a->dual.growth_max = growth_max(world);
    a->dual.crushed_carried = (float)fmin(1.0, CARRIED_SHARE / dual_carried_share(world));
    a->dual.fine_carried = fine_carried(world);
    const int d = p->dimension, parts = d * (d + 1) / 2;
    for (int i = 0; i < 2 * parts && p->deformation[0]; i++) {
        float *array = i < d * d ? particles_spare(p, CLASS_MATRIX, i) : particles_spare(p, CLASS_VECTOR, i - d * d);
        if (i < parts)
            a->dual.stress[i] = array;
        else
            a->dual.stress_old[i - parts] = array;
    }
}

static double sum_blocks(const Array *array, int32_t blocks)
{
    const float *value = array->data;
    double sum = 0.0;
    for (int32_t block = 0; block < blocks; block++) sum += (double)value[block];
    return sum;
}

/* Displacements from the multipliers, extrapolated by args.dual.momentum. *still is for the arguments of nodes, and has to live until the loops run. */
static void add_push(World *world, Loops *loops, const ContactFrame *contacts, KernelArgs *still)
{
    const Kernels *kernels = world->kernels;
    *still = world->args;
    if (in_cells(world)) {
        solver_add_rows(loops, world, kernels->cells_push, &world->args); /* of the extrapolated multipliers */
        still->dual.momentum = 0.0f;
    }
    solver_add_nodes(loops, world, kernels->push_nodes, still, contacts);
}

/* Displacements from the pressures that the guess starts from or has found. */
static void add_guess(World *world, Loops *loops, const ContactFrame *contacts, Kernel *kernel)
{
    solver_add_rows(loops, world, in_cells(world) ? world->kernels->cells_push : kernel, &world->args);
    solver_add_nodes(loops, world, world->kernels->push_nodes, &world->args, contacts);
}

static void add_solids(World *world, Loops *loops)
{
    solver_add_rows(loops, world, world->kernels->solids_begin, &world->args);
    solver_add_nodes(loops, world, world->kernels->solids_mean, &world->args, NULL);
}

/* Pressures that balance what is wrong over the depth of a pool. Where that fails they are taken back. Meanwhile elastic particles have no
 * stress, and with pressures in cells what liquids remember is not asked for. Nothing is extrapolated. */
static void guess(World *world, const ContactFrame *contacts, int iterations, DualSketch *sketch)
{
    const Kernels *kernels = world->kernels;
    KernelArgs *a = &world->args;
    Loops loops;
    loops_open(&loops, world->pool);
    guess_begin(world, contacts);
    a->cells.probing = in_cells(world);
    add_guess(world, &loops, contacts, kernels->cells_carry);
    if (sketch) {
        loops_run(&loops);
        sketch(world, contacts);
        add_solids(world, &loops);
    }
    if (a->cells.second_order) {
        solver_add_rows(&loops, world, kernels->second_order, a);
        solver_add_nodes(&loops, world, kernels->cells_respond, a, NULL);
    }
    const double before = guess_gain(world, &loops);
    a->cells.probing = 0;
    guess_solve(world, contacts, iterations);
    add_guess(world, &loops, contacts, kernels->cells_add);
    if (!(guess_gain(world, &loops) >= before)) {
        guess_take_back(world, &loops);
        add_guess(world, &loops, contacts, kernels->cells_add);
        loops_run(&loops);
    }
    const size_t cells = (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells;
    memcpy(a->cells.pressure_old, a->cells.pressure, cells * sizeof(float));
}

/* First multipliers, and the displacements that they make. Returns the mass of the particles. */
static double start(World *world, const ContactFrame *contacts, DualSketch *sketch)
{
    const Kernels *kernels = world->kernels;
    const int guesses = guess_iterations(world);
    KernelArgs still;
    Loops loops;
    loops_open(&loops, world->pool);
    if (in_cells(world) || guesses > 0) {
        solver_add_rows(&loops, world, kernels->cells_begin, &world->args);
        solver_add_nodes(&loops, world, kernels->cells_mean, &world->args, NULL);
        if (world->args.cells.solid_growth && !joint_is_chosen(world)) add_solids(world, &loops);
    } else {
        solver_add_rows(&loops, world, kernels->dual_begin, &world->args);
    }
    loops_run(&loops);
    const double mass = sum_blocks(&world->dual.change2, world->grid.particle_blocks);
    if (guesses > 0) {
        guess(world, contacts, guesses, sketch);
        return mass;
    }
    add_push(world, &loops, contacts, &still);
    loops_run(&loops);
    return mass;
}

static void add_iterate(World *world, Loops *loops)
{
    const Kernels *kernels = world->kernels;
    solver_add_rows(loops, world, in_cells(world) ? kernels->cells_trace : kernels->dual_iterate, &world->args);
    if (in_cells(world)) solver_add_nodes(loops, world, kernels->cells_update, &world->args, NULL);
}

/* What an iteration changed. */
typedef struct Change {
    double change2, uphill;
} Change;

static Change change_of(const World *world)
{
    const DualState *dual = &world->dual;
    const int32_t blocks = world->grid.particle_blocks, node_blocks = world->grid.node_blocks;
    Change change = {sum_blocks(&dual->change2, blocks), sum_blocks(&dual->uphill, blocks)};
    if (in_cells(world)) {
        change.change2 += sum_blocks(&dual->cell_change2, node_blocks);
        change.uphill += sum_blocks(&dual->cell_uphill, node_blocks);
    }
    return change;
}

/* A particle that shares its nodes with no other answers S by D = -S. After an extrapolation by b the error of its stress obeys
 * e'' = (1 - w) (e' + b (e' - e)). Of the roots one is negative; it is -r for w = 1 + r^2 / ((1 + b) r + b). With r = 1 the particle trembles for ever
 * (w = 4/3 after many iterations); with this r it comes to rest though it is not linear. The last iteration has the largest b. By trial. */
static const double LONE_DECAY = 0.8;

float dual_longest_relaxation(int iterations)
{
    const double b = acceleration_last(iterations);
    return (float)(1.0 + LONE_DECAY * LONE_DECAY / ((1.0 + b) * LONE_DECAY + b));
}

/* Friction has no guess: what bears sand is carried on from substep to substep by some cells per iteration. For deep sand more follow, so that it crosses
 * the matter in 1/60 s, up to as many as solids among liquids get. Half as many let a silo of 96 cells flow 15 % faster when it is half empty. */
static int sand_rounds(const World *world)
{
    static const double CELLS_PER_ITERATION = 4.0; /* by trial, on silos: see above */
    if (!solver_holds_sand(world)) return 0;
    const double wanted = ceil(matter_depth(world) * world->substep.reference_steps / CELLS_PER_ITERATION) - world->settings.iterations;
    return (int)fmax(0.0, fmin(wanted, ROUNDS_MOST));
}

static void iterate_all(World *world, const ContactFrame *contacts, double mass)
{
    StepRecord *record = &world->record;
    DualModes modes = dual_modes_of(world, (double)smallest_relaxation(world));
    const bool watched = world->settings.target_error > 0.0f; /* else the last displacements alone are compared */
    Acceleration acceleration = acceleration_begin(world);
    KernelArgs still;
    Loops loops;
    bool more = true;
    int further = shares_world(world) ? 0 : sand_rounds(world);
    loops_open(&loops, world->pool);
    if (watched) dual_compare_displacements(world, &loops);
    add_iterate(world, &loops);
    loops_run(&loops);
    while (more) {
        const Change change = change_of(world);
        const double residual = sqrt(change.change2 / mass);
        record->iterations_used++;
        record->residual = residual;
        more = solver_may_go_on(world, dual_predicted_error(&modes, residual));
        more = more || (record->stop == PBMPM_STOP_ITERATIONS && further-- > 0);
        acceleration_next(&acceleration, change.uphill > 0.0, more);
        if (!more && !watched) dual_compare_displacements(world, &loops);
        add_push(world, &loops, contacts, &still);
        if (!more || watched) dual_compare_displacements(world, &loops);
        if (more) add_iterate(world, &loops); /* the next one; nobody decides in between */
        loops_run(&loops);
        if (!more || watched) dual_find_response(&modes, residual, sqrt(dual_compared(world) / mass), (double)world->args.dual.momentum);
    }
    /* What ended the iterations stands as it was found. */
    if (record->stop != PBMPM_STOP_ERROR) record->predicted_error = dual_predicted_error(&modes, record->residual);
}

/* c (2 mu + lambda) of the stiffest body, as it is asked for. */
static double stiffest(const World *world)
{
    double most = 0.0;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const KernelMaterial *material = &world->materials.kernel[slot];
        if (world->particles.of_material[slot] > 0 && material_is_solid(&world->materials, slot) && material->yields != K_SAND)
            most = fmax(most, 2.0 * (double)material->shear + (double)material->dilation);
    }
    return most;
}

void dual_solve(World *world, const ContactFrame *contacts) { dual_solve_with(world, contacts, NULL); }

void dual_solve_with(World *world, const ContactFrame *contacts, DualSketch *sketch)
{
    bind(world);
    bind_cells(world);
    const double mass = fmax(start(world, contacts, sketch), 1e-300);
    const int bodies = rounds_wanted(stiffest(world), world->settings.iterations), sand = sand_rounds(world);
    const int rounds = !takes_rounds(world) ? 0 : bodies > sand ? bodies : sand;
    if (rounds > 0) rounds_begin(world);
    rounds_run(world, contacts, (rounds + 1) / 2);
    iterate_all(world, contacts, mass);
    rounds_run(world, contacts, rounds / 2);
    if (!measures_gains(world)) return;
    if (is_bounded(world))
        granular_bound_keep(world, contacts);
    else
        dual_gains_find(world);
    eddy_damping_find(world);
}

void dual_set_solids(World *world)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        KernelMaterial *material = &world->materials.kernel[slot];
        if (world->materials.generation[slot] == 0 || material->kind == K_LIQUID) continue;
        moduli_set_solid(world, slot, dual_stiffness_cap(world, def, &world->substep));
        material->relaxation = fminf(def->relaxation, dual_longest_relaxation(world->settings.iterations));
    }
}

void dual_set_materials(World *world)
{
    const double measure = guess_density(world), carried = dual_carried_share(world);
    moduli_set(world, FLT_MAX);
    dual_set_solids(world);
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        KernelMaterial *material = &world->materials.kernel[slot];
        if (world->materials.generation[slot] == 0) continue;
        material->lightness = measure > 0.0 ? (float)(measure / (double)def->density) : 1.0f;
        if (material->kind == K_LIQUID || material->yields == K_SAND) material->multiplier_per_pascal = (float)fmin(carried * moduli_unit(def, &world->substep), 1e30);
    }
}

double dual_stiffness_of(const pbmpm_material_def *def, const Substep *substep)
{
    const Lame lame = lame_of((double)def->young_modulus, (double)def->poisson_ratio);
    return moduli_unit(def, substep) * (2.0 * lame.mu + lame.lambda);
}

/* Bodies by themselves may gain energy if they are asked for more than the iterations hold. Bodies in a liquid hold together better if they
 * are asked for more, and best above about (4 n)^2 (by trial); see dual_stiffness_cap(). Beside sand they are by themselves: asked for (4 n)^2 one of 2.3 MPa landed with 1.06 times its energy. */
double dual_stiffness_share(const World *world, const pbmpm_material_def *def, const Substep *substep)
{
    if (def->kind == PBMPM_SAND) return moduli_sand_share(def, substep);
    const double stiffness = dual_stiffness_of(def, substep), iterations = trusted_iterations(world);
    const double rounds = takes_rounds(world) ? rounds_wanted(stiffness, world->settings.iterations) : 0.0;
    const double held = (iterations + rounds) / DUAL_ITERATIONS_PER_ROOT;
    return fmin(1.0, held * held / stiffness);
}

/* Solids that are too soft for their own weight end crushed in a row of cells. Where gravity pulls, those by themselves are therefore
 * asked for what is compressed by WEIGHT_STRAIN at most below matter of this depth, as far as the iterations bear that: c times the
 * pressure there is 4 g dt^2/dx per cell of depth. By trial: with 0.02 one whose iterations rise from 2 to 50 at 60 Hz gains 3 % of its energy (H11). */
static const double WEIGHT_STRAIN = 0.05;

static double weight_stiffness(const World *world, const Substep *substep)
{
    const double fall = gravity_fall(world, substep);
    return fall > 0.0 ? 4.0 * fall * matter_depth(world) / WEIGHT_STRAIN : 0.0;
}

/* More would be more than they stop: stiff bodies that fall would come to tremble. And half of it where a body falls by 0.2 cells per substep or more: what
 * the iterations do not hold is crushed by as much at once, unevenly, and its particles go on holding strains against each other (J 0.2 off the mean). The
 * stiffer they are held, the higher the body stands once iterations rise: asked for 5 at 15 Hz x 10 by 2 to 10 % of the energy it fell with (cells of 0.2 m,
 * eight seedings), asked for 2.5 by 0.6 % at most. */
static double asked_per_iteration(const World *world, const Substep *substep)
{
    static const double LEAST = 2.5, LONG_FALL = 0.2; /* cells; by trial, on blocks that fall: see above */
    return LEAST * fmax(1.0, LONG_FALL / fmax(gravity_fall(world, substep), 0.5 * LONG_FALL));
}

static double asked_for_weight(const World *world, const Substep *substep, double iterations)
{
    return fmin(weight_stiffness(world, substep), asked_per_iteration(world, substep) * iterations);
}

/* What bodies by themselves are asked for by so many iterations, and the least iterations that ask for so much. */
static double asked_of(const World *world, const Substep *substep, double iterations)
{
    const double root = iterations / DUAL_ITERATIONS_PER_ROOT;
    return fmax(root * root, asked_for_weight(world, substep, iterations));
}

static double iterations_that_ask(const World *world, const Substep *substep, double asked)
{
    const double by_root = DUAL_ITERATIONS_PER_ROOT * sqrt(asked);
    return asked > weight_stiffness(world, substep) ? by_root : fmin(by_root, asked / asked_per_iteration(world, substep));
}

/* What n iterations ask for, M, may rise by the factor e in the time that a block of 8 cells takes for three of its slowest swings on a floor, each of four ways of
 * its waves through it; they travel half the root of M cells per substep (see dual_stiffness_of()). The energy of a swing that stiffens slowly grows with its
 * frequency (an adiabatic invariant: L. Landau, E. Lifshitz, Mechanics, 1976, section 49), the root of M: by exp(1/6) per swing. Backward Euler takes from it the
 * share (2 pi / T)^2 per substep of the T that a swing has, exp(-4 pi^2 / T) per swing, which is exp(-1/4) for T = 160, M = 0.16, and more from there on. In one
 * swing it would grow by exp(1/2), in two by as much as is taken. The result is the n that asks for as much. */
double dual_stiffened(const World *world, const Substep *substep, double iterations)
{
    static const double THREE_SWINGS_CELLS = 3.0 * 4.0 * 8.0; /* three swings, of four ways each, through a block of eight cells */
    const double asked = asked_of(world, substep, iterations);
    return iterations_that_ask(world, substep, asked * exp(0.5 * sqrt(asked) / THREE_SWINGS_CELLS));
}

static double held_of(const World *world, const Substep *substep, double trusted, int iterations)
{
    const double asked = asked_of(world, substep, trusted);
    return asked * acceleration_reached(asked, iterations);
}

/* Few iterations hold less than the stiffness M that they ask for: a single one holds M / (1 + M). More iterations hold all of the same M. Up to six times as
 * much at once threw a body with 1.08 times its energy (H11, 60 Hz x 1). So bodies begin with the n for which the new iterations hold what the old ones held. */
double dual_continued(const World *world, const Substep *substep, int before, int now)
{
    enum { HALVINGS = 30 }; /* of the interval: what is left of it is less than floats tell */
    if (solver_holds_liquid(world)) return before; /* they are asked for far more there, see shared_stiffness_cap() */
    const double wanted = held_of(world, substep, before, before);
    double less = 0.0, enough = before;
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = 0.5 * (less + enough);
        if (held_of(world, substep, middle, now) < wanted)
            less = middle;
        else
            enough = middle;
    }
    return enough;
}

/* Of solids among liquids, by so many iterations. */
static double shared_stiffness_cap(double iterations, double stiffness)
{
    static const double PER_SQUARE = 16.0; /* by trial, see above dual_stiffness_share() */
    return fmin(1.0, PER_SQUARE * iterations * iterations / stiffness);
}

bool dual_holds_solids(const World *world, const Substep *substep)
{
    bool held = true;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        if (world->particles.of_material[slot] == 0 || !material_is_solid(&world->materials, slot) || def->kind == PBMPM_SAND) continue;
        held = held && dual_stiffness_share(world, def, substep) == 1.0;
    }
    return held;
}

double dual_stiffness_cap(const World *world, const pbmpm_material_def *def, const Substep *substep)
{
    const double stiffness = dual_stiffness_of(def, substep), iterations = trusted_iterations(world);
    if (def->kind == PBMPM_SAND) return moduli_sand_share(def, substep); /* it remembers what it bears, not strain: see ispc/granular.isph */
    if (solver_holds_liquid(world)) return shared_stiffness_cap(iterations, stiffness);
    const double share = dual_stiffness_share(world, def, substep);
    if (share == 1.0) return share;
    return fmax(share, fmin(1.0, asked_for_weight(world, substep, iterations) / stiffness));
}
