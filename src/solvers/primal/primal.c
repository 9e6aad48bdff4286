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

static const double ARMIJO = 1e-4;          /* share of the promised decrease of energy that is enough */
static const double SLOPE_SHARE = 0.8;      /* share of the first slope, either way, that the last one may have */
static const double SMALLEST_STEP = 1e-6;   /* share of a step: below, displacements change by their rounding */
static const double TOO_LONG = 0.4;         /* of the first slope, that the last one may have on the other side where nothing comes after it */
static const double FAR_FROM_DONE = 0.1;    /* residual over what forces changed: BDF2 extrapolates no error that is more than a tenth of the motion */
static const float LOOSE = 10.0f;            /* stiffness over mass with which a node of a liquid joins half in the levels' corrections; by trial, see share_of_levels() */
static const float JOINS_MIN = 1e-20f;      /* of the levels' corrections: less is none, and no float may overflow */
static const double CURVATURE_MIN = 1e-6;   /* cosine between a step and the change of the gradient */

/* LANES: floats that a pass takes at once, four nodes; every block is a multiple of it. */
enum { BLOCK_GRAIN = 8, VECTORS = 4 + 2 * PRIMAL_MEMORY, LANES = 4 * W };

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
    Array *arrays[] = {&s->force, &s->block_energy, &s->vectors, &s->accepted_energy, &s->fed, &s->inverse, &s->kept, &s->among_liquid, &s->sums, &s->body_sums, &s->rigid, &s->friction, &s->moves};
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

static void add_pass(Primal *p, Loops *loops, BlockPass *pass)
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
    add_pass(p, &loops, pass);
    run_and_sum(p, &loops);
}

/* Over one block, whose few products per lane are added in single precision. The last float of a node is 0 in one of the two. */
static double dot(const float *restrict a, const float *restrict b, size_t begin, size_t end)
{
    float lane[LANES] = {0};
    double sum = 0.0;
    for (size_t i = begin; i < end; i += LANES)
        for (size_t k = 0; k < LANES; k++) lane[k] += a[i + k] * b[i + k];
    for (int k = 0; k < LANES; k++) sum += (double)lane[k];
    return sum;
}

/* to = a - b, with 0 for the last float of a node, which is no motion. */
static void subtract(float *restrict to, const float *restrict a, const float *restrict b, size_t begin, size_t end)
{
    for (size_t i = begin; i < end; i += LANES) {
        for (size_t k = 0; k < LANES; k++) to[i + k] = a[i + k] - b[i + k];
        for (size_t k = 3; k < LANES; k += W) to[i + k] = 0.0f;
    }
}

/* to += factor * vector */
static void add(float *restrict to, double factor, const float *restrict vector, size_t begin, size_t end)
{
    const float f = (float)factor;
    for (size_t i = begin; i < end; i += LANES)
        for (size_t k = 0; k < LANES; k++) to[i + k] += f * vector[i + k];
}

/* ---- Energy and gradient ---- */

static void finish_gradient(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    static const float MOTION[W] = {1.0f, 1.0f, 1.0f, 0.0f};
    const float *restrict node = p->node, *restrict base = p->base, *restrict best = p->best, *restrict gradient = p->gradient;
    float *restrict force = p->force;
    double energy[W] = {0}, before[W] = {0}, after[W] = {0};
    if (p->rubs) sum[0] += constraints_friction(p->contacts, node, force, 1.0f, p->slip_min, block);
    for (size_t i = begin; i < end; i += W) {
        const float mass = base[i + 3];
        for (size_t c = 0; c < W; c++) {
            const float away = MOTION[c] * (node[i + c] - base[i + c]), moved = MOTION[c] * (node[i + c] - best[i + c]);
            force[i + c] += mass * away;
            energy[c] += (double)(mass * away) * (double)away;
            before[c] += (double)(gradient[i + c] * moved);
            after[c] += (double)(force[i + c] * moved);
        }
    }
    for (int c = 0; c < 3; c++) {
        sum[0] += 0.5 * energy[c];
        sum[1] += before[c];
        sum[2] += after[c];
    }
}

static double sum_energies(const Primal *p)
{
    const float *energy = p->world->primal.block_energy.data;
    double sum = 0.0;
    for (int32_t block = 0; block < p->world->grid.particle_blocks; block++, energy += K_ENERGIES) sum += (double)energy[0] + (double)energy[1] + (double)energy[4];
    return sum;
}

/* At p->node, which the loops leave. */
static void evaluate_after(Primal *p, Loops *loops, Kernel *force)
{
    World *world = p->world;
    solver_add_rows(loops, world, force, &world->args);
    solver_add_nodes(loops, world, world->kernels->force_nodes, &world->args, NULL);
    add_pass(p, loops, finish_gradient);
    run_and_sum(p, loops);
    p->trial_energy = p->total[0] + sum_energies(p);
    p->slope_before = p->total[1];
    p->slope_after = p->total[2];
    primal_yield_evaluate(p);
}

void primal_evaluate(Primal *p)
{
    Loops loops;
    loops_open(&loops, p->world->pool);
    evaluate_after(p, &loops, p->world->kernels->force);
}

/* Levels straddle what has come apart: a droplet that feels no pressure would be flung by the correction of matter around it that does. So nodes of
 * a body with liquid take part by the share k / (m LOOSE + k), k their stiffness: where sound crosses some cells per substep a tenth of a node's mass
 * under pressure already makes k larger than m, and what is flung then is the rest. Solids always have stiffness. LOOSE is by trial, on liquids crushed
 * between boxes: with 1 droplets are flung still, with 20 pools take longer to come to rest. */
static float share_of_levels(const Primal *p, const BodySum *body, size_t node)
{
    if (!body->with_liquid) return 1.0f;
    const float inert = p->base[node * W + 3] * ((const float *)p->world->primal.inverse.data)[node]; /* m / (m + k) */
    return fmaxf(0.0f, 1.0f - inert) / (1.0f + (LOOSE - 1.0f) * inert);
}

/* The preconditioner's N = m + k, the nodes' mass and stiffness; and for the multilevel one the mass per axis, which where a node is held is
 * the stiffness of the jump, and the stiffness. Not less than the mass: a contact that holds now may let go in a later step, and liquid
 * that has come apart has no stiffness. These stand in p->change[0] and [1] while there are no pairs. After the first pass and
 * constraints_find_active(). */
static void weigh_nodes(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const BodySum *body = primal_body_of(p, block);
    float *inverse = p->world->primal.inverse.data, *share = p->step[0], *weight = p->change[0], *stiff = p->change[1];
    memset(share + begin, 0, (end - begin) * sizeof *share);
    constraints_held_share(p->contacts, share, block, block + 1);
    for (size_t i = begin; i < end; i += W) {
        const float mass = p->base[i + 3], stiffness = p->force[i + 3];
        inverse[i / W] = mass > 0.0f ? 1.0f / (mass + stiffness) : 0.0f;
        const float joins = share_of_levels(p, body, i / W), counts = joins * joins;
        for (size_t c = 0; c < 3; c++) weight[i + c] = counts * (mass + share[i + c] * fmaxf(stiffness - mass, 0.0f));
        weight[i + 3] = counts * mass;
        stiff[i / W] = counts * stiffness;
        sum[0] += (double)mass;
        sum[1] += (double)stiffness;
    }
    if (p->rubs) constraints_friction_diagonal(p->contacts, p->best, weight, p->slip_min, block);
}

/* ---- Accepting displacements ---- */

/* Without friction: see renew_friction(). */
static void take_over_bare(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const size_t bytes = (end - begin) * sizeof(float);
    memcpy(p->best + begin, p->node + begin, bytes);
    memcpy(p->gradient + begin, p->force + begin, bytes);
    for (size_t i = begin; i < end; i += W) p->gradient[i + 3] = 0.0f;
    if (p->rubs) sum[0] = constraints_friction(p->contacts, p->best, p->gradient, -1.0f, p->slip_min, block);
    memcpy(p->right + begin, p->gradient + begin, bytes);
    constraints_find_active(p->contacts, p->best, p->right, block, block + 1);
    for (size_t i = begin; i < end && p->rubs; i += W)
        for (size_t c = 0; c < 3; c++) sum[1 + c] += (double)p->base[i + 3] * ((double)p->best[i + c] - (double)p->base[i + c]);
}

static void take_over(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    take_over_bare(p, block, begin, end, sum);
    for (int i = 0; i < p->pairs; i++) sum[i] = dot(p->step[i], p->right, begin, end);
}

static void add_friction(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    sum[SUMS - 1] = constraints_friction(p->contacts, p->best, p->gradient, 1.0f, p->slip_min, block);
    constraints_friction(p->contacts, p->best, p->right, 1.0f, p->slip_min, block);
    constraints_remove(p->contacts, p->right, block, block + 1);
    for (int i = 0; i < p->pairs; i++) sum[i] = dot(p->step[i], p->right, begin, end);
}

/* Friction of the impulses at the accepted displacements, in place of that in the energy before. */
static void renew_friction(Primal *p)
{
    PrimalState *state = &p->world->primal;
    BodyFriction *body = state->friction.data;
    const int32_t *of_block = p->world->grid.body.data;
    const double *sums = state->sums.data;
    p->energy -= p->total[0];
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        body[i].held = false;
        memset(body[i].gained, 0, sizeof body[i].gained);
        for (int k = 0; k < body[i].groups; k++) memset(body[i].group[k].push, 0, sizeof body[i].group[k].push);
    }
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        for (int c = 0; c < 3; c++) body[of_block[block]].gained[c] += sums[(size_t)block * SUMS + 1 + (size_t)c];
        constraints_sum_push(p->contacts, p->best, p->gradient, p->slip_min, block, &body[of_block[block]]);
    }
    constraints_scale(body, p->world->grid.bodies);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) constraints_set_limits(p->contacts, block, &body[of_block[block]]);
    primal_over_blocks(p, add_friction);
    p->energy += p->total[SUMS - 1];
}

static void keep_pair(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    (void)block;
    float *step = p->step[0], *change = p->change[0];
    subtract(step, p->node, p->best, begin, end);
    subtract(change, p->force, p->gradient, begin, end);
    for (int i = 0; i < p->pairs; i++) sum[i] = dot(change, p->step[i], begin, end);
    sum[SUMS - 1] = dot(step, step, begin, end);
    sum[SUMS - 2] = dot(change, change, begin, end);
}

/* The oldest pair makes room for a new one at the front. */
static void shift_pairs(Primal *p)
{
    float *step = p->step[PRIMAL_MEMORY - 1], *change = p->change[PRIMAL_MEMORY - 1];
    for (int i = PRIMAL_MEMORY - 1; i > 0; i--) {
        p->step[i] = p->step[i - 1];
        p->change[i] = p->change[i - 1];
        for (int j = PRIMAL_MEMORY - 1; j > 0; j--) p->product[i][j] = p->product[i - 1][j - 1];
    }
    p->step[0] = step;
    p->change[0] = change;
    p->pairs = p->pairs < PRIMAL_MEMORY ? p->pairs + 1 : PRIMAL_MEMORY;
}

static void drop_newest_pair(Primal *p)
{
    float *step = p->step[0], *change = p->change[0];
    for (int i = 0; i + 1 < PRIMAL_MEMORY; i++) {
        p->step[i] = p->step[i + 1];
        p->change[i] = p->change[i + 1];
        for (int j = 0; j + 1 < PRIMAL_MEMORY; j++) p->product[i][j] = p->product[i + 1][j + 1];
    }
    p->step[PRIMAL_MEMORY - 1] = step;
    p->change[PRIMAL_MEMORY - 1] = change;
    p->pairs--;
    primal_yield_drop_pair(p);
}

/* Makes p->node the accepted displacements. */
void primal_accept(Primal *p, bool with_pair)
{
    PrimalState *state = &p->world->primal;
    if (with_pair) {
        shift_pairs(p);
        primal_over_blocks(p, keep_pair);
        primal_yield_keep_pair(p);
        memcpy(p->product[0], p->total, sizeof p->product[0]);
        if (!(p->product[0][0] > CURVATURE_MIN * sqrt(p->total[SUMS - 1] * p->total[SUMS - 2]))) drop_newest_pair(p);
    } else {
        p->pairs = 0;
    }
    p->energy = p->trial_energy;
    primal_over_blocks(p, p->rubs ? take_over_bare : take_over);
    if (p->rubs) renew_friction(p);
    memcpy(p->first, p->total, sizeof p->first);
    primal_yield_accept(p);
    memcpy(state->accepted_energy.data, state->block_energy.data, K_ENERGIES * (size_t)p->world->grid.particle_blocks * sizeof(float));
}

/* ---- The direction: two loops over the pairs, with the preconditioner between them ---- */

static void join_levels(Primal *p, int32_t block, size_t begin, size_t end)
{
    const float *inverse = p->world->primal.inverse.data;
    const BodySum *body = primal_body_of(p, block);
    const float *restrict right = p->right;
    float *restrict joining = p->force, *restrict direction = p->direction;
    for (size_t i = begin; i < end; i += W) {
        const float joins = share_of_levels(p, body, i / W);
        const float own = joins > JOINS_MIN ? inverse[i / W] / joins : 0.0f; /* project_direction() multiplies it with what the levels add */
        for (size_t c = 0; c < W; c++) joining[i + c] = joins * right[i + c];
        for (size_t c = 0; c < W; c++) direction[i + c] = own * right[i + c];
    }
    if (p->rubs) constraints_soften(p->contacts, p->best, inverse, direction, p->slip_min, block);
}

static void add_changes(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    for (int k = 0; k < p->pairs; k++) add(p->right, -p->first[k], p->change[k], begin, end);
    constraints_remove(p->contacts, p->right, block, block + 1);
    if (p->rigid)
        primal_sum_rigid(p, block, p->right + begin, sum);
    else
        join_levels(p, block, begin, end);
}

static void deflate(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    (void)sum;
    primal_deflate(p, block, begin, end);
    join_levels(p, block, begin, end);
}

static void add_rigid(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    primal_add_rigid(p, block, begin, end);
    for (int k = 0; k < p->pairs; k++) sum[k] = dot(p->change[k], p->direction, begin, end);
}

static void project_direction(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const float *inverse = p->world->primal.inverse.data;
    const BodySum *body = primal_body_of(p, block);
    for (size_t i = begin; i < end; i += W) {
        const float joins = inverse[i / W] > 0.0f ? share_of_levels(p, body, i / W) : 0.0f;
        for (size_t c = 0; c < W; c++) p->direction[i + c] = joins > JOINS_MIN ? joins * p->direction[i + c] : inverse[i / W] * p->right[i + c];
    }
    constraints_remove(p->contacts, p->direction, block, block + 1);
    if (p->rigid) {
        primal_sum_inertia(p, block, begin, end, sum);
        return;
    }
    for (int k = 0; k < p->pairs; k++) sum[k] = dot(p->change[k], p->direction, begin, end);
}

static void add_steps(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    for (int k = 0; k < p->pairs; k++) add(p->direction, p->second[k], p->step[k], begin, end);
    constraints_remove(p->contacts, p->direction, block, block + 1);
    sum[0] = dot(p->gradient, p->direction, begin, end);
}

/* p->direction from p->right; p->first holds step . right of each pair. Returns gradient . direction. */
double primal_find_direction(Primal *p)
{
    double coefficient[PRIMAL_MEMORY];
    Loops loops;
    loops_open(&loops, p->world->pool);
    for (int i = 0; i < p->pairs; i++) {
        double along = p->first[i]; /* of what is left of the gradient */
        for (int j = 0; j < i; j++) along -= p->first[j] * p->product[j][i];
        p->first[i] = along / p->product[i][i];
    }
    if (p->rigid) primal_weigh_rigid(p);
    primal_yield_add_changes(p);
    add_pass(p, &loops, add_changes);
    if (p->rigid) {
        run_and_sum(p, &loops);
        primal_solve_rigid(p);
        add_pass(p, &loops, deflate);
    }
    multilevel_add(&p->world->primal.multilevel, &loops, p->force, p->direction);
    add_pass(p, &loops, project_direction);
    run_and_sum(p, &loops);
    if (p->rigid) {
        primal_correct_rigid(p);
        primal_over_blocks(p, add_rigid);
    }
    primal_yield_find_direction(p);
    memcpy(coefficient, p->total, sizeof coefficient);
    for (int i = p->pairs - 1; i >= 0; i--) {
        double along = coefficient[i];
        for (int j = i + 1; j < p->pairs; j++) along += p->second[j] * p->product[i][j];
        p->second[i] = p->first[i] - along / p->product[i][i];
    }
    primal_over_blocks(p, add_steps);
    primal_yield_add_steps(p);
    return p->total[0];
}

/* ---- Descent ---- */

static void try_step(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    (void)sum;
    memcpy(p->node + begin, p->best + begin, (end - begin) * sizeof(float));
    add(p->node, -(double)p->share, p->direction, begin, end);
    constraints_project(p->contacts, p->node, block, block + 1);
}

static bool is_good(const Primal *p)
{
    if (!isfinite(p->trial_energy) || !isfinite(p->slope_after)) return false;
    if (p->trial_energy <= p->energy + ARMIJO * p->slope_before) return true;
    const bool rounding = p->trial_energy - p->energy <= ENERGY_ROUNDING * fabs(p->energy);
    return rounding && p->slope_before < 0.0 && fabs(p->slope_after) <= SLOPE_SHARE * fabs(p->slope_before);
}

/* Whether the step went far beyond the lowest point on its way. */
static bool is_too_long(const Primal *p) { return p->slope_after > TOO_LONG * fabs(p->slope_before); }

/* How much of a step that was too long is tried next: where the slope would vanish if it changed evenly. */
static float shorter(const Primal *p)
{
    const double vanishes = p->slope_before / (p->slope_before - p->slope_after);
    return isfinite(vanishes) ? (float)fmin(is_good(p) ? 1.0 : 0.5, fmax(0.1, vanishes)) : 0.1f;
}

/* Follows the direction, with at most `most` evaluations. False if nothing was found. A single iteration of a liquid has no other after it that mends what
 * it did too much of: with one more evaluation it is shortened. */
bool primal_descend(Primal *p, uint32_t *passes, uint32_t most)
{
    bool last = *passes == 0 && most == 1 && solver_holds_liquid(p->world);
    Loops loops;
    loops_open(&loops, p->world->pool);
    for (p->share = 1.0f; *passes < most && (double)p->share > SMALLEST_STEP; p->share *= shorter(p)) {
        primal_yield_try(p);
        add_pass(p, &loops, try_step);
        evaluate_after(p, &loops, p->world->kernels->force);
        ++*passes;
        const bool shortens = last && is_good(p) && is_too_long(p);
        if (shortens) most++;
        last = false;
        if (shortens || !is_good(p)) continue;
        primal_accept(p, true);
        return true;
    }
    primal_yield_return(p);
    return false;
}

/* The same without the pairs. */
double primal_find_plain_direction(Primal *p)
{
    p->pairs = 0;
    memcpy(p->right, p->gradient, (size_t)p->world->grid.node_blocks * (size_t)p->floats * sizeof *p->right);
    primal_yield_begin_plain(p);
    return primal_find_direction(p);
}

/* Near the lowest point the differences of gradients are rounding, and a direction made of such pairs may lead nowhere and be a hundred times too long. Where no step along
 * it is good the one without pairs is followed, and says what is left. */
static void minimise(Primal *p)
{
    StepRecord *record = &p->world->record;
    for (bool plain = false;;) {
        double decrement = plain ? primal_find_plain_direction(p) : primal_find_direction(p);
        if (decrement <= 0.0 && p->pairs > 0) decrement = primal_find_plain_direction(p);
        record->residual = sqrt(fmax(decrement, 0.0) / p->mass);
        if (!solver_may_go_on(p->world, PRIMAL_ERROR_PER_RESIDUAL * record->residual)) return;
        const bool goes = decrement > 0.0 && primal_descend(p, &record->iterations_used, (uint32_t)p->world->settings.iterations);
        if (!goes && p->pairs == 0) return;
        plain = !goes;
    }
}

/* What floats or sinks moves a pool: as in the dual's guess three steps come first that are no iterations. At 60 Hz x 5 a block half again as dense as water sank
 * through 10 cells in 2.0 s without them, in 1.2 with them, in 1.2 where the solution is converged; one step brought 1.7 s, two 1.45. */
static void lead(Primal *p)
{
    enum { STEPS = 3 }; /* by trial, see above */
    uint32_t passes = 0;
    while (p->mixed && passes < STEPS && !solver_time_is_up(p->world) && primal_find_direction(p) > 0.0)
        if (!primal_descend(p, &passes, STEPS)) return;
}

/* Goes on along p->direction, without stop rules, for what the energy check asks for. */
void primal_descend_further(Primal *p)
{
    uint32_t *passes = &p->world->record.iterations_used;
    const uint32_t most = *passes + (uint32_t)p->world->settings.iterations + 1;
    while (primal_descend(p, passes, most) && *passes < most && primal_find_direction(p) > 0.0) {}
}

/* ---- The substep ---- */

/* What forces changed: the mean square of u - u*, times the mass. */
static void sum_change(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    (void)block;
    for (size_t i = begin; i < end; i++) {
        const double change = (double)p->best[i] - (double)p->base[i];
        if (i % W != 3) sum[0] += (double)p->base[i - i % W + 3] * change * change;
    }
}

/* See multistep.h. A solution that is far from done must not be extrapolated either: its error would feed the next step. */
static void forget_past(Primal *p)
{
    if (!p->world->args.primal.block_share) return;
    primal_over_blocks(p, sum_change);
    const bool done = p->world->record.residual <= FAR_FROM_DONE * sqrt(p->total[0] / p->mass);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++)
        if (!done || primal_body_of(p, block)->touches || primal_body_of(p, block)->unsound) multistep_forget(p->world, block);
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

/* Up to the iterations. */
static Primal begin_solve(World *world, const ContactFrame *contacts, bool sketches)
{
    Primal p = open_solve(world, contacts);
    p.sketches = sketches;
    find_friction(&p);
    primal_yield_open(&p);
    primal_find_leaning(&p);
    primal_find_rigid(&p);
    bind_couples(&p);
    p.mixed = primal_is_mixed(world) && !p.joint;
    Loops loops;
    loops_open(&loops, world->pool);
    add_pass(&p, &loops, start);
    if (p.yields) {
        loops_run(&loops);
        primal_yield_start(&p);
        add_pass(&p, &loops, project_start);
    }
    evaluate_after(&p, &loops, world->kernels->force_first);
    primal_accept(&p, false);
    add_pass(&p, &loops, weigh_nodes);
    multilevel_weigh(&world->primal.multilevel, &loops, p.change[0], p.change[1], OVERLAP);
    run_and_sum(&p, &loops);
    p.mass = fmax(p.total[0], 1e-30);
    primal_note_stiffness(&p);
    primal_choose_start(&p);
    return p;
}

void primal_sketch(World *world, const ContactFrame *contacts)
{
    Primal p = begin_solve(world, contacts, true);
    const uint32_t most = ((uint32_t)world->settings.iterations + 1) / 2;
    uint32_t passes = 0;
    while (passes < most && !solver_time_is_up(world) && primal_find_direction(&p) > 0.0 && primal_descend(&p, &passes, most)) {}
    primal_over_blocks(&p, write_motion);
}

void primal_solve(World *world, const ContactFrame *contacts)
{
    Primal p = begin_solve(world, contacts, false);
    lead(&p);
    minimise(&p);
    if (p.joint)
        primal_balance_momentum(&p);
    else
        primal_let_fly(&p);
    primal_keep_momentum(&p);
    primal_keep_energy(&p);
    primal_find_kept(&p);
    forget_past(&p);
    if ((solver_holds_liquid(world) && !p.joint) || world->record.energy_checks_failed > 0) primal_keep_momentum(&p);
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
