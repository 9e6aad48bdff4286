#include "solvers/passes.h"

#include <math.h>

#include "base/clock.h"

enum { BLOCK_GRAIN = 2 };

/* ---- What a substep is of ---- */

bool solver_uses_dual(const World *world)
{
    return world->record.solver == PBMPM_SOLVER_DUAL || world->record.solver == SOLVER_JOINT;
}

bool solver_holds_liquid(const World *world)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (world->particles.of_material[slot] > 0 && !material_is_solid(&world->materials, slot)) return true;
    return false;
}

/* Whether there are particles of sand. */
bool solver_holds_sand(const World *world)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (world->particles.of_material[slot] > 0 && world->materials.kernel[slot].yields == K_SAND) return true;
    return false;
}

bool solver_follows_grid(const World *world, uint32_t slot)
{
    const bool sand = world->materials.kernel[slot].yields == K_SAND;
    return material_flows(&world->materials.def[slot]) || (sand && solver_uses_dual(world));
}

/* The share per substep that makes the same share per 1/60 s at any rate: what J is corrected by becomes a velocity, correction / dt, and
 * so noise of the density heats liquid the more the shorter the substep. */
float solver_feedback_share(const World *world, const pbmpm_material_def *def)
{
    return (float)per_reference_step((double)def->volume_feedback, &world->substep);
}

double solver_joule(const World *world)
{
    const double cells = world->substep.dt * (double)(float)world->substep.cells_per_metre;
    return 1.0 / (cells * cells);
}

/* ---- Running kernels ---- */

typedef struct KernelJob {
    Kernel *kernel;
    KernelArgs *args;
    const ContactFrame *contacts; /* for kernels that update nodes; else null */
} KernelJob;

static void run_kernel(void *context, int32_t begin, int32_t end)
{
    const KernelJob *job = context;
    job->kernel(job->args, begin, end);
    if (job->contacts) contacts_apply(job->contacts, begin, end);
}

void solver_add_rows(Loops *loops, const World *world, Kernel *kernel, KernelArgs *args)
{
    const KernelJob job = {kernel, args, NULL};
    LOOPS_ADD(loops, grid_rows(&world->grid, BLOCK_GRAIN), run_kernel, &job);
}

void solver_add_nodes(Loops *loops, const World *world, Kernel *kernel, KernelArgs *args, const ContactFrame *contacts)
{
    const bool follows = contacts && walls_any(&world->walls); /* which needs all nodes */
    const KernelJob job = {kernel, args, follows ? NULL : contacts};
    LOOPS_ADD(loops, grid_nodes(&world->grid, 2 * BLOCK_GRAIN), run_kernel, &job);
    if (follows) walls_add(&world->walls, contacts, loops, false, NULL);
}

void solver_over_particles(World *world, Kernel *kernel)
{
    Loops loops;
    loops_open(&loops, world->pool);
    solver_add_rows(&loops, world, kernel, &world->args);
    loops_run(&loops);
}

void solver_over_still(World *world, Kernel *kernel)
{
    KernelJob job = {kernel, &world->args, NULL};
    pool_for(world->pool, world->grid.still_blocks, BLOCK_GRAIN, run_kernel, &job);
}

void solver_obey(World *world, const ContactFrame *contacts) { walls_apply(&world->walls, contacts, world->pool, false, NULL); }

void solver_over_both(World *world, Kernel *rows, Kernel *nodes, const ContactFrame *contacts)
{
    Loops loops;
    loops_open(&loops, world->pool);
    solver_add_rows(&loops, world, rows, &world->args);
    solver_add_nodes(&loops, world, nodes, &world->args, contacts);
    loops_run(&loops);
}

/* ---- Stop rules ---- */

bool solver_time_is_up(const World *world)
{
    return world->settings.time_budget_ms > 0.0f && now_ms() > world->record.deadline_ms;
}

bool solver_may_go_on(World *world, double predicted_error)
{
    const pbmpm_settings *settings = &world->settings;
    StepRecord *record = &world->record;
    record->predicted_error = predicted_error;
    record->stop = PBMPM_STOP_ITERATIONS;
    if (record->iterations_used >= (uint32_t)settings->iterations) return false;
    if (settings->target_error > 0.0f && predicted_error < (double)settings->target_error) record->stop = PBMPM_STOP_ERROR;
    if (solver_time_is_up(world)) record->stop = PBMPM_STOP_TIME;
    return record->stop == PBMPM_STOP_ITERATIONS;
}
