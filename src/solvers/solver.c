#include "solvers/solver.h"

#include <math.h>
#include <string.h>

#include "base/result.h"
#include "solvers/dual/dual.h"
#include "solvers/explicit.h"
#include "solvers/granular.h"
#include "solvers/joint.h"
#include "solvers/paper.h"
#include "solvers/passes.h"
#include "solvers/primal/multistep.h"
#include "solvers/primal/primal.h"
#include "solvers/viscosity.h"
#include "world/depth.h"
#include "world/island_groups.h"
#include "world/sleep_rows.h"

enum { BLOCK_GRAIN = 2 };

typedef struct SolverKind {
    void (*set_materials)(World *world);
    pbmpm_result (*prepare)(World *world); /* takes memory; the paper's needs none */
    void (*solve)(World *world, const ContactFrame *contacts);
} SolverKind;

static const SolverKind kinds[] = {
    [PBMPM_SOLVER_PAPER] = {paper_set_materials, NULL, paper_solve},
    [PBMPM_SOLVER_DUAL] = {dual_set_materials, dual_prepare, dual_solve},
    [PBMPM_SOLVER_PRIMAL] = {primal_set_materials, primal_prepare, primal_solve},
    [PBMPM_SOLVER_EXPLICIT] = {explicit_set_materials, explicit_prepare, explicit_solve},
    [SOLVER_JOINT] = {joint_set_materials, joint_prepare, joint_solve},
};

/* ---- Parameters of the substep ---- */

/* Of the feedback's share, that by which the mean of J over a block follows the grid. Pools of 4 to 48 cells kept their height with it, by trial; it takes 0.8 s. Without gravity
 * nothing presses gaps shut, and a drop that only goes along would come to breathe: what the control corrects is strain, for which it corrects more. */
static const double CONTROL_SHARE = 0.2;

static void set_volume_control(World *world)
{
    const double part = gravity_fall(world, &world->substep) > 0.0 ? CONTROL_SHARE : 0.0;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        KernelMaterial *material = &world->materials.kernel[slot];
        if (world->materials.generation[slot] == 0) continue;
        const bool controlled = solver_follows_grid(world, slot) && material->yields != K_VISCO;
        material->volume_share = controlled ? (float)part * solver_feedback_share(world, &world->materials.def[slot]) : 0.0f;
    }
}

/* Where the dual and the primal solver's liquid is slower than this [cells/s], feedback fades. By itself it moves matter by less: 6 per second (0.1 per 1/60 s) of
 * 5 % of noise are 0.3 cells/s. By trial. */
static const double CALM_SPEED = 2.4;

/* More iterations make matter stiffer with the paper's solver, and with the dual where it does not get the stiffness that it is asked for. A body that
 * carries its weight with the strain e stores M e^2 / 2: made stiffer at once, from M to r M, it holds r times as much and leaps. Made stiffer slowly it
 * rises through states of balance, with the work integral (dM) e^2 / 2 and e = p / M, which is (1 - 1/r) of what it held, whatever r is. Slowly: by
 * about the factor e in the time in which its waves cross it twice. With the paper's solver, where M goes with N, they travel sqrt(w N) / 2 cells per
 * substep, so a block of 8 cells takes 26 substeps for N = 1; for the dual see dual_stiffened(). Fewer iterations soften at once. */
static void follow_iterations(World *world)
{
    static const double GROWTH = 1.04; /* per substep: the factor e in 26 of them, see above */
    const double now = (double)world->settings.iterations, before = world->slow_iterations;
    const bool begins = before == floor(before) && before < now; /* in between they are no whole number */
    double risen = GROWTH * before;
    if (solver_uses_dual(world)) risen = begins ? dual_continued(world, &world->substep, (int)before, (int)now) : dual_stiffened(world, &world->substep, before);
    world->slow_iterations = before > 0.0 ? fmin(now, risen) : now;
}

/* Whether liquids find each other by their mass, see held_for() in ispc/liquids.isph. The paper's solver bounds what crushed liquid grows with instead. */
static bool weighs_liquids(const World *world)
{
    return world->record.solver != PBMPM_SOLVER_PAPER && materials_density_contrast(&world->materials, &world->particles) > 1.0;
}

void solver_bind(World *world, bool with_volume)
{
    Particles *p = &world->particles;
    Grid *grid = &world->grid;
    KernelArgs *a = &world->args;
    const Substep *substep = &world->substep;
    const float calm_way = (float)(CALM_SPEED * substep->dt);
    *a = (KernelArgs){.particles.volume_ratio = p->volume_ratio,
                      .particles.mass = p->mass,
                      .particles.identity = (const uint32_t *)(const void *)p->id,
                      .particles.status = p->status,
                      .grid.run_begin = grid->run_begin,
                      .grid.run_key = grid->run_key,
                      .grid.block_run = grid->block_run.data,
                      .grid.neighbour = grid->neighbour.data,
                      .grid.particle_blocks = grid->particle_blocks,
                      .grid.tile = grid->tile.data,
                      .grid.tile_volume = with_volume ? grid->tile_volume.data : NULL,
                      .grid.node = grid->node.data,
                      .grid.node_base = world->record.solver == PBMPM_SOLVER_PAPER ? NULL : grid->node_base.data,
                      .grid.node_before = world->record.solver == PBMPM_SOLVER_PAPER ? NULL : grid->node_base.data,
                      .grid.node_volume = with_volume ? grid->node_volume.data : NULL,
                      .grid.node_density = with_volume && weighs_liquids(world) ? grid->node_density.data : NULL,
                      .grid.node_reach = grid->node_reach.data,
                      .grid.edged = with_volume ? grid->edged.data : NULL,
                      .grid.clamped = grid_counts(grid, GRID_CLAMPED),
                      .grid.moved = grid_counts(grid, GRID_MOVED),
                      .grid.lost = grid_counts(grid, GRID_LOST),
                      .grid.travel = grid->travel.data,
                      .material = world->materials.kernel,
                      .iterations = world->record.solver == PBMPM_SOLVER_PAPER ? world->settings.iterations : 0,
                      .flip = world->settings.flip,
                      .feedback_way = solver_uses_dual(world) ? calm_way : 0.0f,
                      .quiet_way = world->record.solver == PBMPM_SOLVER_PRIMAL ? calm_way : 0.0f,
                      .dt = (float)substep->dt,
                      .cells_per_metre = (float)substep->cells_per_metre,
                      .max_displacement = world->settings.max_displacement,
                      .max_cell = CELL_LIMIT,
                      .salt = (uint32_t)world->step_count * PBMPM_MAX_SUBSTEPS + world->record.substeps,
                      .check_strain = world->strain_unchecked};
    if (world->record.solver != PBMPM_SOLVER_PAPER) matter_depth_find(world);
    follow_iterations(world);
    kinds[world->record.solver].set_materials(world);
    set_volume_control(world);
    memcpy(a->particles.fraction, p->fraction, sizeof a->particles.fraction);
    memcpy(a->particles.cell, p->cell, sizeof a->particles.cell);
    memcpy(a->particles.velocity, p->velocity, sizeof a->particles.velocity);
    memcpy(a->particles.affine, p->affine, sizeof a->particles.affine);
    memcpy(a->particles.deformation, p->deformation, sizeof a->particles.deformation);
    multistep_bind(world);
    granular_bind(world);
    for (int k = 0; k < world->def.dimension; k++) {
        const double pull = (double)world->settings.gravity[k] * substep->dt * substep->dt * substep->cells_per_metre;
        a->gravity[k] = fmaxf(-K_INCREMENT_MAX, fminf(K_INCREMENT_MAX, (float)pull));
    }
}

void solver_predict(World *world)
{
    solver_over_both(world, world->kernels->scatter, world->kernels->predict_nodes, NULL);
    world->strain_unchecked = false;
}

/* ---- Solving ---- */

bool solver_follows_walls(const World *world)
{
    if (!solver_uses_dual(world) && world->record.solver != PBMPM_SOLVER_EXPLICIT) return false;
    return solver_holds_liquid(world) || (solver_uses_dual(world) && world->settings.iterations == 1);
}

/* The dual solver reaches through any depth of liquid, which stays incompressible. But solids get no more of their stiffness than its iterations hold. Where they touch
 * liquid the two work together, see joint.h. A single iteration of the dual finds no pressure that bears water or solids: of 12 cells of it 4 were lost at 60 Hz, of
 * 24 ten. The primal's loses 0.2 and 0.3. So there it takes all but sand that flows. For sand see granular.h. */
pbmpm_solver solver_for(const World *world, uint32_t matter)
{
    if (matter & KIND_SAND) return granular_flows(world, matter) ? PBMPM_SOLVER_DUAL : PBMPM_SOLVER_PRIMAL;
    if (!(matter & KIND_LIQUID) || world->settings.iterations == 1) return PBMPM_SOLVER_PRIMAL;
    return matter == KIND_LIQUID ? PBMPM_SOLVER_DUAL : SOLVER_JOINT;
}

static pbmpm_solver chosen(const World *world)
{
    return world->settings.solver == PBMPM_SOLVER_CONVERGENT ? solver_for(world, islands_kinds(world)) : world->settings.solver;
}

bool solver_may_want_volume(const World *world) { return solver_wants_volume(world) || (solver_holds_sand(world) && !granular_goes_on(world)); }

bool solver_wants_volume(const World *world)
{
    return materials_want_volume(&world->materials, &world->particles) || (chosen(world) == PBMPM_SOLVER_DUAL && solver_holds_sand(world));
}

pbmpm_result solver_prepare(World *world)
{
    const pbmpm_solver solver = chosen(world);
    world->record.solver = solver;
    if (solver != PBMPM_SOLVER_PRIMAL) multistep_expire(world);
    if (solver == PBMPM_SOLVER_PAPER) return PBMPM_OK;
    const size_t nodes = (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells;
    if (!array_reserve(&world->memory, &world->grid.node_base, nodes * K_NODE_WIDTH, sizeof(float)) ||
        (weighs_liquids(world) && !array_reserve(&world->memory, &world->grid.node_density, nodes, sizeof(float))))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the predictor of %d blocks", world->grid.node_blocks);
    pbmpm_result result = viscosity_prepare(world);
    return result == PBMPM_OK ? kinds[solver].prepare(world) : result;
}

void solver_solve(World *world, const ContactFrame *contacts)
{
    StepRecord *record = &world->record;
    record->stop = PBMPM_STOP_ITERATIONS;
    record->iterations_used = record->energy_checks_failed = 0;
    record->residual = record->predicted_error = 0.0;
    contacts->colliders->impulses.adds_up = record->solver == PBMPM_SOLVER_PAPER;
    if (contacts->walls) walls_weigh(contacts->walls, contacts, world->args.gravity, world->grid.node_base.data);
    solver_obey(world, contacts); /* the predictor obeys them too */
    if (record->solver != PBMPM_SOLVER_PAPER) viscosity_apply(world, contacts);
    kinds[record->solver].solve(world, contacts);
}

bool solver_ends_by_primal(const World *world) { return world->record.solver == PBMPM_SOLVER_PRIMAL || joint_is_chosen(world); }

void solver_before_going(World *world)
{
    if (solver_ends_by_primal(world)) primal_before_going(world);
}

void solver_integrate(World *world, int32_t begin, int32_t end)
{
    if (world->grid.still_blocks == 0) {
        world->kernels->integrate(&world->args, begin, end);
        return;
    }
    for (int32_t block = begin, next; block < end; block = next) { /* stretches of blocks that move */
        next = block + 1;
        if (sleep_is_still(world, block)) continue;
        while (next < end && !sleep_is_still(world, next)) next++;
        world->kernels->integrate(&world->args, block, next);
    }
}

static void fly(void *context, int32_t begin, int32_t end)
{
    World *world = context;
    const int32_t first = world->grid.particle_blocks;
    world->kernels->fly(&world->args, first + begin, first + end);
}

static void let_fly(World *world)
{
    if (world->grid.flights == 0) return;
    world->args.dual.pressure = world->particles.pressure; /* that of none, and 0 in the paper's solver */
    pool_for(world->pool, world->grid.flights, BLOCK_GRAIN, fly, world);
}

void solver_after_going(World *world, const ContactFrame *contacts)
{
    if (solver_ends_by_primal(world)) primal_calm(world, contacts);
    let_fly(world);
}
