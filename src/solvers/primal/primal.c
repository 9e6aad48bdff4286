#include "solvers/primal/primal.h"

#include <math.h>
#include <string.h>

#include "base/result.h"
#include "contact/contact_constraints.h"
#include "solvers/moduli.h"
#include "solvers/passes.h"
#include "solvers/primal/multistep.h"
#include "solvers/primal/primal_solve.h"
#include "solvers/primal/primal_yield.h"

/* Levels overlap: smooth motion is corrected by each of them. With 1 steps were too long by about the factor 2; iterations for the bar and the
 * cantilever of the accuracy cases were fewest around 2, by trial. */
static const double OVERLAP = 2.0;

enum { BLOCK_GRAIN = 8, VECTORS = 4 + 2 * PRIMAL_MEMORY };

/* ---- What passes keep of particles: couples of solids among liquid, see primal.h; then voids of visco, see close_voids() in ispc/plastic.isph ---- */

/* Skew entries of a matrix. */
static size_t couples_of(const World *world)
{
    if (!primal_is_mixed(world)) return 0;
    return world->def.dimension == 3 ? 3 : 1;
}

static bool prepare_kept(World *world)
{
    PrimalState *state = &world->primal;
    const size_t kept = couples_of(world) + materials_hold_visco(&world->materials, &world->particles), blocks = (size_t)world->grid.particle_blocks;
    return (kept == 0 || array_reserve(&world->memory, &state->kept, kept * world->particles.count + K_MAX_GANG, sizeof(float))) &&
           (couples_of(world) == 0 || array_reserve(&world->memory, &state->among_liquid, blocks, sizeof(uint32_t)));
}

static void bind_couples(Primal *p)
{
    World *world = p->world;
    uint32_t *among_liquid = world->primal.among_liquid.data;
    if (!primal_is_mixed(world)) return;
    for (int32_t block = 0; block < world->grid.particle_blocks; block++) among_liquid[block] = primal_body_of(p, block)->with_liquid;
    for (size_t k = 0; k < couples_of(world); k++) world->args.primal.couple[k] = (float *)world->primal.kept.data + k * world->particles.count;
    world->args.primal.among_liquid = among_liquid;
}

static void bind_voids(World *world)
{
    const bool measured = world->args.grid.node_volume && materials_hold_visco(&world->materials, &world->particles);
    world->args.primal.void_room = measured ? (float *)world->primal.kept.data + couples_of(world) * world->particles.count : NULL;
}

/* ---- Memory ---- */

void primal_set_materials(World *world)
{
    moduli_set(world, primal_liquid_dilation(world, &world->substep));
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        KernelMaterial *material = &world->materials.kernel[slot];
        if (world->materials.generation[slot] == 0) continue;
        if (material->yields == K_SAND) moduli_set_solid(world, slot, moduli_sand_share(&world->materials.def[slot], &world->substep));
    }
}

pbmpm_result primal_prepare(World *world)
{
    PrimalState *state = &world->primal;
    Memory *memory = &world->memory;
    const size_t blocks = (size_t)world->grid.node_blocks, nodes = blocks * (size_t)world->grid.block_cells;
    const bool ok = array_reserve(memory, &state->force, nodes * W, sizeof(float)) &&
                    array_reserve(memory, &state->block_energy, K_ENERGIES * blocks, sizeof(float)) &&
                    array_reserve(memory, &state->accepted_energy, K_ENERGIES * blocks, sizeof(float)) &&
                    array_reserve(memory, &state->fed, blocks, sizeof(float)) &&
                    array_reserve(memory, &state->vectors, VECTORS * nodes * W, sizeof(float)) &&
                    array_reserve(memory, &state->inverse, nodes, sizeof(float)) &&
                    array_reserve(memory, &state->sums, SUMS * blocks, sizeof(double)) &&
                    array_reserve(memory, &state->body_sums, (size_t)world->grid.bodies, sizeof(BodySum)) &&
                    array_reserve(memory, &state->searches, (size_t)world->grid.bodies, sizeof(Search)) &&
                    array_reserve(memory, &state->friction, (size_t)world->grid.bodies, sizeof(BodyFriction)) &&
                    array_reserve(memory, &state->moves, (size_t)world->grid.bodies, sizeof(BodyMove)) &&
                    array_reserve(memory, &state->rigid, (size_t)world->grid.bodies, sizeof(RigidBody)) &&
                    multilevel_build(&state->multilevel, memory, &world->grid, W, LEVELS_OVER_MATTER);
    if (!ok || !prepare_kept(world)) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the primal solver on %d blocks", world->grid.node_blocks);
    return multistep_prepare(world);
}

void primal_free(World *world)
{
    PrimalState *s = &world->primal;
    Array *arrays[] = {&s->force, &s->block_energy, &s->vectors, &s->accepted_energy, &s->fed, &s->inverse, &s->kept, &s->among_liquid, &s->follower, &s->sums, &s->body_sums, &s->searches, &s->rigid, &s->friction, &s->moves};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(&world->memory, arrays[i]);
    multistep_free(world);
    multilevel_free(&s->multilevel, &world->memory);
}

static Primal open_solve(World *world, const ContactFrame *contacts)
{
    PrimalState *state = &world->primal;
    const size_t length = (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells * W;
    float *vector = state->vectors.data;
    Primal p = {.world = world, .contacts = contacts, .floats = world->grid.block_cells * W};
    p.node = world->grid.node.data;
    p.base = world->grid.node_base.data;
    p.force = state->force.data;
    p.best = vector;
    p.gradient = vector + length;
    p.right = vector + 2 * length;
    p.direction = vector + 3 * length;
    for (int i = 0; i < PRIMAL_MEMORY; i++) {
        p.step[i] = vector + (size_t)(4 + 2 * i) * length;
        p.change[i] = p.step[i] + length;
    }
    world->args.primal.node_force = p.force;
    world->args.primal.block_energy = state->block_energy.data;
    bind_voids(world);
    p.search = state->searches.data;
    p.joint = joint_is_chosen(world);
    world->args.primal.fed = p.joint ? NULL : state->fed.data;
    return p;
}

const float *primal_gradient(const World *world)
{
    return (const float *)world->primal.vectors.data + (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells * W;
}

/* ---- Passes over the nodes ---- */

typedef struct PassJob {
    Primal *p;
    BlockPass *pass;
} PassJob;

static void run_pass(void *context, int32_t begin, int32_t end)
{
    const PassJob *job = context;
    double *sums = job->p->world->primal.sums.data;
    const size_t floats = (size_t)job->p->floats;
    for (int32_t block = begin; block < end; block++) {
        double *sum = sums + (size_t)block * SUMS;
        memset(sum, 0, SUMS * sizeof *sum);
        job->pass(job->p, block, (size_t)block * floats, ((size_t)block + 1) * floats, sum);
    }
}

void primal_add_pass(Primal *p, Loops *loops, BlockPass *pass)
{
    const PassJob job = {p, pass};
    const Span nodes = grid_nodes(&p->world->grid, BLOCK_GRAIN);
    LOOPS_ADD(loops, nodes, run_pass, &job);
}

/* Runs the loops, and sums what the last pass did. The sums of the blocks are added in order, so they do not depend on the number of threads. */
static void run_and_sum(Primal *p, Loops *loops)
{
    const int32_t blocks = p->world->grid.node_blocks;
    const double *sums = p->world->primal.sums.data;
    loops_run(loops);
    double total[SUMS] = {0};
    for (int32_t block = 0; block < blocks; block++)
        for (int i = 0; i < SUMS; i++) total[i] += sums[(size_t)block * SUMS + (size_t)i];
    memcpy(p->total, total, sizeof total);
}

void primal_over_blocks(Primal *p, BlockPass *pass)
{
    Loops loops;
    loops_open(&loops, p->world->pool);
    primal_add_pass(p, &loops, pass);
    run_and_sum(p, &loops);
}

/* ---- The substep ---- */

/* See multistep.h. */
static bool forgets(const Primal *p, int32_t block) { return primal_body_of(p, block)->touches || primal_body_of(p, block)->unsound; }

static void forget_past(Primal *p)
{
    if (!p->world->args.primal.block_share) return;
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++)
        if (forgets(p, block)) multistep_forget(p->world, block);
}

static void write_motion(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    (void)block;
    (void)sum;
    for (size_t i = begin; i < end; i += W)
        for (size_t c = i; c < i + 3; c++) p->node[c] = p->best[c];
}

/* First displacements: those of the predictor, or for a solid body that leans on something, without what gravity and forces add in the
 * substep, which are most likely balanced: a beam at rest starts at rest. Liquid leans on the floor while it falls over; but where solids float in it, what is at
 * rest is most of it, and started in free fall its pressure would have to be found anew in each substep: bodies sank as in honey, two cells too high after 3 s. */
static void start(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    (void)sum;
    if (primal_is_multistep(p, block)) {
        multistep_predict(p->world, block, block + 1);
        memcpy(p->node + begin, p->base + begin, (end - begin) * sizeof *p->node);
    }
    const BodySum *body = primal_body_of(p, block);
    const bool balanced = body->leans && (!body->with_liquid || p->mixed);
    if (!body->with_liquid) memcpy(p->node + begin, p->base + begin, (end - begin) * sizeof *p->node);
    for (size_t i = begin; i < end && balanced; i += W)
        for (size_t c = i; c < i + 3; c++) p->node[c] = p->world->args.grid.node_before[c] - p->world->args.gravity[c - i];
    if (!p->yields) constraints_project(p->contacts, p->node, block, block + 1);
    for (size_t i = begin; i < end; i++) p->best[i] = p->gradient[i] = 0.0f;
}

static void project_start(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    (void)begin;
    (void)end;
    (void)sum;
    constraints_project(p->contacts, p->node, block, block + 1);
}

static void find_friction(Primal *p)
{
    PrimalState *state = &p->world->primal;
    BodyFriction *body = state->friction.data;
    p->slip_min = constraints_slip_min(&p->world->substep);
    p->rubs = constraints_have_friction(p->contacts);
    if (!p->rubs) return;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) body[i].groups = 0;
    constraints_group(p->contacts, p->world->grid.body.data, body);
}

static void note_masses(Primal *p)
{
    double sum = 0.0;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        p->search[i].mass = fmax(p->search[i].total[0], 1e-30);
        sum += p->search[i].total[0];
    }
    p->mass = fmax(sum, 1e-30);
}

/* Up to the iterations. */
static Primal begin_solve(World *world, const ContactFrame *contacts, bool sketches)
{
    Primal p = open_solve(world, contacts);
    p.sketches = sketches;
    find_friction(&p);
    primal_yield_open(&p);
    primal_find_leaning(&p);
    primal_find_rigid(&p);
    primal_open_searches(&p);
    bind_couples(&p);
    p.mixed = primal_is_mixed(world) && !p.joint;
    Loops loops;
    loops_open(&loops, world->pool);
    primal_add_pass(&p, &loops, start);
    if (p.yields) {
        loops_run(&loops);
        primal_yield_start(&p);
        primal_add_pass(&p, &loops, project_start);
    }
    primal_evaluate_first(&p, &loops);
    primal_accept(&p, NULL);
    if (p.joint) primal_note_driven(&p);
    primal_add_pass(&p, &loops, primal_weigh_nodes);
    multilevel_weigh(&world->primal.multilevel, &loops, p.change[0], p.change[1], OVERLAP);
    primal_run_and_gather(&p, &loops);
    note_masses(&p);
    primal_note_stiffness(&p);
    primal_choose_start(&p);
    return p;
}

/* What floats or sinks moves a pool: as in the dual's guess, steps come first that are no iterations. At 60 Hz x 5 a block half again as dense as water sank
 * through 10 cells in 2.0 s without them, in 1.2 with them, in 1.2 where the solution is converged; one step brought 1.7 s, two 1.45. */
static void lead(Primal *p)
{
    if (p->mixed) primal_search(p, LEADING_STEPS, NULL, true);
}

static void minimise(Primal *p)
{
    StepRecord *record = &p->world->record;
    record->iterations_used += primal_search(p, (uint32_t)p->world->settings.iterations, NULL, true);
    primal_find_residual(p);
    record->residual = primal_residual(p);
    solver_may_go_on(p->world, PRIMAL_ERROR_PER_RESIDUAL * record->residual);
}

uint32_t primal_sketch(World *world, const ContactFrame *contacts)
{
    Primal p = begin_solve(world, contacts, true);
    const uint32_t most = ((uint32_t)world->settings.iterations + 1) / 2;
    primal_search(&p, most, NULL, true);
    primal_over_blocks(&p, write_motion);
    return primal_check_bodies(&p);
}

bool primal_sketch_gained(const World *world, int32_t block)
{
    return ((const BodySum *)world->primal.body_sums.data)[body_of_block(&world->grid, block)].failed;
}

/* Whether a body was moved after it had got its momentum. */
static bool was_changed(const Primal *p, int32_t body)
{
    const BodySum *of = (const BodySum *)p->world->primal.body_sums.data + body;
    return of->unsound || (of->with_liquid && !p->joint);
}

void primal_solve(World *world, const ContactFrame *contacts)
{
    Primal p = begin_solve(world, contacts, false);
    lead(&p);
    minimise(&p);
    if (p.joint) primal_balance_momentum(&p);
    primal_keep_momentum(&p, NULL);
    primal_keep_energy(&p);
    primal_find_kept(&p);
    forget_past(&p);
    primal_keep_momentum(&p, was_changed);
    primal_yield_keep_momentum(&p);
    primal_find_spin(&p);
    primal_over_blocks(&p, write_motion);
    primal_find_bounces(&p); /* before impulses are booked, which uses up the gradient */
    if (p.yields)
        primal_yield_book(&p, primal_kept_motion(&p));
    else
        constraints_book_impulses(contacts, p.gradient, p.best, primal_kept_motion(&p), p.base, p.slip_min);
    primal_yield_close(&p);
}
