/* The phases of a step, in order. */
#define _POSIX_C_SOURCE 200809L
#include "step/step.h"

#include <math.h>

#include "base/clock.h"
#include "base/result.h"
#include "contact/contacts_find.h"
#include "contact/open_volume.h"
#include "contact/push_out.h"
#include "contact/reach.h"
#include "contact/wall_bodies.h"
#include "grid/build.h"
#include "solvers/granular.h"
#include "solvers/joint.h"
#include "solvers/passes.h"
#include "solvers/primal/primal_yield.h"
#include "solvers/solver.h"
#include "solvers/viscosity.h"
#include "step/build_groups.h"
#include "step/draining.h"
#include "step/emitting.h"
#include "step/flight.h"
#include "step/forcing.h"
#include "step/sleep.h"
#include "world/depth.h"
#include "world/island_groups.h"
#include "world/sleep_rows.h"
#include "world/sleep_wake.h"
#include "world/stirred.h"

/* With fewer particles waking threads costs more than it brings. */
enum { SERIAL_BELOW = 3000, BLOCK_GRAIN = 2 };

/* Adds the time since *since to *total and starts anew. */
static void lap(double *total, double *since)
{
    const double now = now_ms();
    *total += now - *since;
    *since = now;
}

static pbmpm_event particle_event(const World *world, pbmpm_event_kind kind, uint32_t row, uint32_t substep)
{
    const Particles *p = &world->particles;
    pbmpm_event event = {.kind = kind, .count = 1, .particle = p->id[row], .substep = substep, .step = world->step_count};
    for (int a = 0; a < p->dimension; a++)
        event.position[a] = (float)(particles_coordinate(p, row, a) * (double)world->def.cell_size);
    return event;
}

/* ---- Events ---- */

static void report_lost(World *world, int32_t block, uint32_t substep)
{
    static const pbmpm_event_kind kinds[] = {[K_NOT_FINITE] = PBMPM_EVENT_DELETED_NOT_FINITE,
                                             [K_OUT_OF_RANGE] = PBMPM_EVENT_DELETED_OUT_OF_RANGE,
                                             [K_CONDITION] = PBMPM_EVENT_DELETED_CONDITION};
    const uint32_t *begin = world->grid.block_begin.data;
    for (uint32_t row = begin[block]; row < begin[block + 1]; row++) {
        const int32_t status = world->particles.status[row];
        if (status == K_ALIVE || status == K_REMOVED) continue;
        const pbmpm_event event = particle_event(world, kinds[status], row, substep);
        events_add(&world->events, &event);
    }
}

static uint32_t fastest_row(const World *world, int32_t block)
{
    const Particles *p = &world->particles;
    const uint32_t *begin = world->grid.block_begin.data;
    uint32_t fastest = begin[block];
    float most = -1.0f;
    for (uint32_t row = begin[block]; row < begin[block + 1]; row++) {
        float speed2 = 0.0f;
        for (int a = 0; a < p->dimension; a++) speed2 += p->velocity[a][row] * p->velocity[a][row];
        if (speed2 <= most) continue;
        most = speed2;
        fastest = row;
    }
    return fastest;
}

/* Reports what the kernels counted. Returns how many particles have to go. */
static uint32_t collect_events(World *world, uint32_t substep)
{
    const uint32_t *lost = grid_counts(&world->grid, GRID_LOST), *clamped = grid_counts(&world->grid, GRID_CLAMPED), *moved = grid_counts(&world->grid, GRID_MOVED);
    const float *travel = world->grid.travel.data;
    uint32_t total_lost = 0, total_clamped = 0, total_moved = 0;
    pbmpm_event slowed = {0};
    world->record.travel = 0.0f;
    for (int32_t block = 0; block < grid_row_blocks(&world->grid); block++) {
        if (sleep_is_still(world, block)) continue;
        total_moved += moved[block];
        world->record.travel = travel[block] > world->record.travel ? travel[block] : world->record.travel;
        total_lost += lost[block];
        if (lost[block]) report_lost(world, block, substep);
        if (clamped[block] && total_clamped == 0)
            slowed = particle_event(world, PBMPM_EVENT_SPEED_CLAMPED, fastest_row(world, block), substep);
        total_clamped += clamped[block];
    }
    world->record.moved = (float)total_moved / (float)world->particles.count;
    if (total_clamped) {
        slowed.count = total_clamped;
        events_add(&world->events, &slowed);
    }
    world->clamped_total += total_clamped;
    world->deleted_total += total_lost;
    if (total_lost)
        result_log(PBMPM_LOG_WARNING, "%u particles deleted in step %llu", total_lost, (unsigned long long)world->step_count);
    return total_lost;
}

static void remove_marked(World *world)
{
    if (world->sleep.on) sleep_settle(world);
    particles_compact(&world->particles, world->sleep.rows);
    world_expire_views(world);
}

/* ---- Phases ---- */

typedef struct PushJob {
    World *world;
    const ContactFrame *frame;
    bool pushes_later; /* the solver has to see first where all particles went */
} PushJob;

static void push_out(const PushJob *job, int32_t begin, int32_t end)
{
    for (int32_t block = begin; block < end; block++) {
        if (sleep_is_still(job->world, block))
            contacts_pass_over(job->frame, block);
        else
            contacts_push_out(job->frame, &job->world->particles, block, block + 1);
    }
}

/* No block asks another one. */
static void go_blocks(void *context, int32_t begin, int32_t end)
{
    const PushJob *job = context;
    if (job->world->colliders.used > 0) contacts_keep_places(job->frame, &job->world->particles, begin, end);
    solver_integrate(job->world, begin, end);
    if (!job->pushes_later) push_out(job, begin, end);
}

static void push_out_blocks(void *context, int32_t begin, int32_t end) { push_out(context, begin, end); }

/* Without particles only the obstacles move. */
static pbmpm_result empty_substep(World *world, int part)
{
    grid_clear(&world->grid);
    colliders_begin_substep(&world->colliders, &world->domain, world->def.dimension, part, world->settings.substeps);
    return PBMPM_OK;
}

/* Where the particles are: order, blocks, runs, and which of them touch. */
static pbmpm_result build_grid(World *world)
{
    const bool with_volume = solver_may_want_volume(world);
    if (islands_wanted(world)) return islands_build(world);
    return world->sleep.on ? sleep_build(world, with_volume)
                           : grid_build(&world->grid, &world->memory, &world->particles, world->pool, with_volume);
}

static pbmpm_result find_places(World *world, int part)
{
    Flight flight;
    world->islands.groups = 1;
    world->islands.contacts = 0;
    colliders_begin_substep(&world->colliders, &world->domain, world->def.dimension, part, world->settings.substeps);
    flight_begin(&flight, world);
    world->grid.flies = flight.possible ? flight_is_free : NULL;
    world->grid.flies_context = &flight;
    const pbmpm_result result = build_grid(world);
    world->grid.flies = NULL;
    return result;
}

/* Where they would go if nothing held them. */
static pbmpm_result predict(World *world, bool with_volume)
{
    pbmpm_result result = solver_prepare(world);
    if (result != PBMPM_OK) return result;
    solver_bind(world, with_volume);
    if (world->sleep.on) result = sleep_prepare(world);
    if (result != PBMPM_OK) return result;
    solver_predict(world);
    return forces_apply(world);
}

/* What they may meet on the way. */
static pbmpm_result find_contacts(World *world, int part, bool with_volume, ContactFrame *contacts)
{
    const double cell_size = (double)world->def.cell_size;
    const pbmpm_solver solver = world->record.solver;
    /* In the paper's solver J is all that resists. If it fell where walls close in, crushed matter would burst when they part; and what lies between them
     * must not lie in one plane, which nothing parts again. The other solvers' J follows the grid, and liquid that stays would burst. */
    const bool by_ratio = solver == PBMPM_SOLVER_PAPER;
    const uint32_t kinds = islands_kinds(world);
    const bool mixed = (kinds & KIND_LIQUID) && kinds != KIND_LIQUID;
    ObstacleCache *cache = &world->obstacle_cache[kinds];
    *contacts = (ContactFrame){.colliders = &world->colliders,
                               .grid = &world->grid,
                               .cell_size = cell_size,
                               .substep = &world->substep,
                               .max_displacement = world->settings.max_displacement,
                               .fall = gravity_fall(world, &world->substep),
                               .held = world->sleep.holds ? world->sleep.held.data : NULL,
                               .grabbed = world->forces.holds ? world->forces.held : NULL,
                               .pressed = &world->particles,
                               .pressure = solver_uses_dual(world) ? world->particles.pressure : NULL,
                               .kernel = world->materials.kernel,
                               .liquid = kinds == KIND_LIQUID,
                               .viscous = viscosity_acts(world),
                               .slips = solver == SOLVER_JOINT,
                               .stays = by_ratio ? world->materials.kernel : NULL};
    colliders_begin_substep(&world->colliders, &world->domain, world->def.dimension, part, world->settings.substeps);
    world->colliders.measures = world->colliders.measures || world->forces.holds; /* a grab's impulse is always known */
    walls_clear(&world->walls);
    pbmpm_result result = reach_find_groups(contacts, world->materials.def, world->particles.of_material, &world->memory);
    if (result == PBMPM_OK) result = obstacle_cache_open(contacts, cache, &world->memory);
    if (result == PBMPM_OK) result = contacts_measure(contacts, &world->memory, world->pool);
    if (result == PBMPM_OK && mixed) result = reach_find(contacts, world->materials.kernel, &world->memory);
    if (result == PBMPM_OK && solver_follows_walls(world)) {
        result = walls_find(&world->walls, contacts, &world->memory, world->pool);
        contacts->walls = &world->walls;
    }
    if (result == PBMPM_OK) result = contacts_find(contacts, &world->memory, world->pool);
    if (result == PBMPM_OK) result = primal_yield_list(world, contacts);
    if (result == PBMPM_OK && solver == SOLVER_JOINT) result = joint_find_contacts(world, contacts);
    if (result == PBMPM_OK) result = contacts_prepare_push(contacts, &world->memory);
    if (result == PBMPM_OK && with_volume && !contacts_open_volume(contacts, &world->memory, world->pool, by_ratio))
        result = fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the open shares of %d blocks", world->grid.node_blocks);
    if (result != PBMPM_OK)
        obstacle_cache_forget(cache);
    else
        result = obstacle_cache_keep(contacts, contacts->walls ? &world->walls : NULL, with_volume ? contacts_opened(contacts, by_ratio) : 0, &world->memory);
    return result;
}

/* They go, and what happened on the way is booked. Returns how many have to be removed. */
static uint32_t go(World *world, int part, const ContactFrame *contacts)
{
    const PushJob push = {world, contacts, solver_ends_by_primal(world)};
    Loops loops;
    loops_open(&loops, world->pool);
    solver_before_going(world);
    LOOPS_ADD(&loops, grid_rows(&world->grid, BLOCK_GRAIN), go_blocks, &push);
    loops_run(&loops);
    solver_after_going(world, contacts);
    contacts_book(contacts); /* bodies that bounce off have scaled it */
    walls_book(&world->walls, contacts);
    wall_bodies_keep(&world->walls, contacts);
    if (push.pushes_later) LOOPS_ADD(&loops, grid_rows(&world->grid, BLOCK_GRAIN), push_out_blocks, &push);
    loops_run(&loops);
    contacts_book_push(contacts, &world->particles);
    forces_account(world, contacts);
    const uint32_t drained = sinks_mark(world, (uint32_t)part);
    return drained + collect_events(world, (uint32_t)part);
}

/* All that is in world->grid takes the substep. Adds to *marked how many particles have to be removed. */
static pbmpm_result take_substep(World *world, int part, uint32_t *marked)
{
    StepRecord *record = &world->record;
    double clock = now_ms();

    pbmpm_result result = granular_prepare(world);
    if (result != PBMPM_OK) return result;
    const bool with_volume = solver_wants_volume(world);
    result = predict(world, with_volume);
    if (result != PBMPM_OK) return result;
    lap(&record->ms_scatter, &clock);

    ContactFrame contacts;
    result = find_contacts(world, part, with_volume, &contacts);
    if (result != PBMPM_OK) return result;
    lap(&record->ms_contacts, &clock);

    /* Where their materials let them go. */
    if (world->grid.particle_blocks > 0) solver_solve(world, &contacts); /* else all fly */
    if (world->primal.yield_grips > 0) result = contacts_prepare_push(&contacts, &world->memory); /* bodies ended elsewhere */
    if (result != PBMPM_OK) return result;
    if (world->sleep.on) sleep_judge(world);
    lap(&record->ms_iterate, &clock);

    *marked += go(world, part, &contacts);
    granular_judge(world);
    lap(&record->ms_integrate, &clock);
    return PBMPM_OK;
}

/* ---- Groups of islands ---- */

/* Several groups are reported as the worst of them. */
static void report_with(StepRecord *record, const StepRecord *others)
{
    if (others->solver != record->solver) record->solver = PBMPM_SOLVER_CONVERGENT;
    if (others->stop == PBMPM_STOP_TIME || record->stop == PBMPM_STOP_ERROR) record->stop = others->stop;
    record->iterations_used = others->iterations_used > record->iterations_used ? others->iterations_used : record->iterations_used;
    record->energy_checks_failed += others->energy_checks_failed;
    record->residual = fmax(record->residual, others->residual);
    record->predicted_error = fmax(record->predicted_error, others->predicted_error);
    record->moved += others->moved;
    record->travel = fmaxf(record->travel, others->travel);
}

/* Until when a group may take: of the time that is left, the share that its particles have of those that are left. */
static double deadline_of(const World *world, int group, double deadline)
{
    const double begin = now_ms(), first = islands_grid(world, group)->first_row, rows = islands_grid(world, group)->end_row - first;
    return begin + (deadline - begin) * rows / (world->particles.count - first);
}

/* Each group as if it were all there is; see islands.h. */
static pbmpm_result take_by_groups(World *world, int part, uint32_t *marked)
{
    StepRecord *record = &world->record;
    const double deadline = record->deadline_ms, iterations = world->slow_iterations;
    const bool unchecked = world->strain_unchecked;
    pbmpm_result result = PBMPM_OK;
    for (int group = 0; group < world->islands.groups && result == PBMPM_OK; group++) {
        const StepRecord others = *record;
        record->deadline_ms = deadline_of(world, group, deadline);
        world->slow_iterations = iterations;
        world->strain_unchecked = unchecked;
        islands_enter(world, group);
        result = take_substep(world, part, marked);
        islands_leave(world, group);
        if (group > 0) report_with(record, &others);
        if (group + 1 < world->islands.groups) world->islands.contacts += colliders_contacts(&world->colliders);
    }
    record->deadline_ms = deadline;
    return result;
}

static pbmpm_result substep(World *world, int part)
{
    double clock = now_ms();
    uint32_t marked = 0;
    pbmpm_result result = find_places(world, part);
    if (result != PBMPM_OK) return result;
    if (grid_row_blocks(&world->grid) == 0) return empty_substep(world, part); /* all sleep */
    lap(&world->record.ms_sort, &clock);
    result = world->islands.groups > 1 ? take_by_groups(world, part, &marked) : take_substep(world, part, &marked);
    if (result == PBMPM_OK && marked > 0) remove_marked(world);
    return result;
}

pbmpm_result world_step(World *world, float dt)
{
    const double begin = now_ms();
    const int parts = world->settings.substeps;
    world->substep = world_substep(world, (double)(float)((double)dt / parts)); /* the kernels take it as a float */
    world->record = (StepRecord){.iterations = (uint32_t)world->settings.iterations};
    events_clear(&world->events);
    impulses_clear(&world->colliders.impulses);
    forces_begin_step(&world->forces);
    world_expire_views(world);
    sleep_begin_step(world);
    pool_set_serial(world->pool, world->particles.count - world->sleep.rows < SERIAL_BELOW);
    for (int part = 0; part < parts; part++) {
        world->record.deadline_ms = begin + (double)world->settings.time_budget_ms * (part + 1) / parts;
        if (world->sleep.on) sleep_begin_substep(world, part);
        pbmpm_result result = emitters_prepare(world, part);
        if (result == PBMPM_OK) result = world->particles.count ? substep(world, part) : empty_substep(world, part);
        if (result != PBMPM_OK) return result;
        emitters_run(world, part);
        world->simulated_seconds += world->substep.dt;
        world->record.substeps++;
    }
    colliders_end_step(&world->colliders);
    emitters_end_step(&world->emitters);
    world->record.blocks_woken = world->sleep.woken_blocks;
    world->sleep.woken_blocks = 0;
    world->step_count++;
    stirred_clear(world);
    world->record.seconds = dt;
    world->record.ms_total = now_ms() - begin;
    return PBMPM_OK;
}
