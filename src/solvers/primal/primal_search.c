/* The search for the lowest energy: L-BFGS, see primal.h, for each body by itself.
 *
 * Bodies share no node (grid/bodies.h), so the energy is a sum of theirs. One search for all would minimise the sum, but with one set of coefficients, one
 * step and one end for all: what is soft would wait for what is stiff, and each would change with what happens elsewhere. So each body has its own pairs, its
 * own share of a step and its own end. Evaluations serve all at once: a body that is done, or waits, is evaluated where it stands.
 *
 * Rigid bodies that yield (primal_yield.h) join what they touch: that is searched as one. */
#include <math.h>
#include <string.h>

#include "contact/contact_constraints.h"
#include "solvers/passes.h"
#include "solvers/primal/primal_followers.h"
#include "solvers/primal/primal_solve.h"
#include "solvers/primal/primal_yield.h"

static const double ARMIJO = 1e-4;          /* share of the promised decrease of energy that is enough */
static const double SLOPE_SHARE = 0.8;      /* share of the first slope, either way, that the last one may have */
static const double SMALLEST_STEP = 1e-6;   /* share of a step: below, displacements change by their rounding */
static const double TOO_LONG = 0.4;         /* of the first slope, that the last one may have on the other side where nothing comes after it; by trial */
static const double CURVATURE_MIN = 1e-6;   /* cosine between a step and the change of the gradient */

enum { LANES = 4 * W }; /* floats that a pass takes at once, four nodes; every block is a multiple of it */

/* ---- Searches ---- */

Search *primal_search_of(const Primal *p, int32_t block) { return &p->search[p->search[body_of_block(&p->world->grid, block)].own]; }

/* The next one from *body on; null: there is none. */
static Search *next_search(const Primal *p, int32_t *body)
{
    while (*body < p->world->grid.bodies && p->search[*body].own != *body) ++*body;
    return *body < p->world->grid.bodies ? &p->search[(*body)++] : NULL;
}

static bool any_is(const Primal *p, SearchPhase phase)
{
    for (int32_t i = 0; i < p->world->grid.bodies; i++)
        if (p->search[i].phase == phase) return true;
    return false;
}

static void change_phases(Primal *p, SearchPhase from, SearchPhase to)
{
    for (int32_t i = 0; i < p->world->grid.bodies; i++)
        if (p->search[i].phase == from) p->search[i].phase = to;
}

/* Gives those that the test chooses this phase, all if it is null. The others end. */
static void choose(Primal *p, BodyTest *chosen, SearchPhase phase)
{
    for (int32_t i = 0; i < p->world->grid.bodies; i++) p->search[i].phase = SEARCH_ENDED;
    for (int32_t i = 0; i < p->world->grid.bodies; i++)
        if (!chosen || chosen(p, i)) p->search[p->search[i].own].phase = phase;
}

static bool joined_is(const Primal *p, SearchPhase phase) { return p->joined && p->joined->phase == phase; }

void primal_open_searches(Primal *p)
{
    const BodySum *body = p->world->primal.body_sums.data;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) p->search[i] = (Search){.own = i, .with_liquid = body[i].with_liquid};
    p->joined = primal_yield_join(p);
}

void primal_run_and_gather(Primal *p, Loops *loops)
{
    const double *sums = p->world->primal.sums.data;
    loops_run(loops);
    for (int32_t i = 0; i < p->world->grid.bodies; i++) memset(p->search[i].total, 0, sizeof p->search[i].total);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++, sums += SUMS) {
        double *total = primal_search_of(p, block)->total;
        for (int i = 0; i < SUMS; i++) total[i] += sums[i];
    }
}

void primal_over_searches(Primal *p, BlockPass *pass)
{
    Loops loops;
    loops_open(&loops, p->world->pool);
    primal_add_pass(p, &loops, pass);
    primal_run_and_gather(p, &loops);
}

/* Pair i of a search, the newest first. */
float *primal_step_of(const Primal *p, const Search *search, int i) { return p->step[(search->newest + i) % PRIMAL_MEMORY]; }
float *primal_change_of(const Primal *p, const Search *search, int i) { return p->change[(search->newest + i) % PRIMAL_MEMORY]; }

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

/* At p->node, which the loops leave. */
static void evaluate_after(Primal *p, Loops *loops, Kernel *force)
{
    World *world = p->world;
    const float *energy = world->primal.block_energy.data;
    primal_add_followers(p, loops);
    solver_add_rows(loops, world, force, &world->args);
    solver_add_nodes(loops, world, world->kernels->force_nodes, &world->args, NULL);
    primal_add_pass(p, loops, finish_gradient);
    primal_add_fold(p, loops);
    primal_run_and_gather(p, loops);
    for (int32_t i = 0; i < world->grid.bodies; i++) {
        Search *search = &p->search[i];
        search->trial_energy = search->total[0];
        search->slope_before = search->total[1];
        search->slope_after = search->total[2];
    }
    for (int32_t block = 0; block < world->grid.particle_blocks; block++, energy += K_ENERGIES)
        primal_search_of(p, block)->trial_energy += (double)energy[0] + (double)energy[1] + (double)energy[4];
    primal_yield_evaluate(p);
}

void primal_evaluate(Primal *p)
{
    Loops loops;
    loops_open(&loops, p->world->pool);
    evaluate_after(p, &loops, p->world->kernels->force);
}

void primal_evaluate_first(Primal *p, Loops *loops) { evaluate_after(p, loops, p->world->kernels->force_first); }

/* The preconditioner's N = m + k, the nodes' mass and stiffness; and for the multilevel one the mass per axis, which where a node is held is
 * the stiffness of the jump, and the stiffness. Not less than the mass: a contact that holds now may let go in a later step, and liquid
 * that has come apart has no stiffness. These stand in p->change[0] and [1] while there are no pairs. After the first pass and
 * constraints_find_active(). */
void primal_weigh_nodes(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    float *inverse = p->world->primal.inverse.data, *share = p->step[0], *weight = p->change[0], *stiff = p->change[1];
    memset(share + begin, 0, (end - begin) * sizeof *share);
    constraints_held_share(p->contacts, share, block, block + 1);
    for (size_t i = begin; i < end; i += W) {
        const float mass = p->base[i + 3], stiffness = p->force[i + 3];
        inverse[i / W] = mass > 0.0f ? 1.0f / (mass + stiffness) : 0.0f;
        for (size_t c = 0; c < 3; c++) weight[i + c] = mass + share[i + c] * fmaxf(stiffness - mass, 0.0f);
        weight[i + 3] = mass;
        stiff[i / W] = stiffness;
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
    if (primal_search_of(p, block)->phase != SEARCH_ACCEPTS) return;
    memcpy(p->best + begin, p->node + begin, bytes);
    memcpy(p->gradient + begin, p->force + begin, bytes);
    for (size_t i = begin; i < end; i += W) p->gradient[i + 3] = 0.0f;
    if (p->rubs) sum[0] = constraints_friction(p->contacts, p->best, p->gradient, -1.0f, p->slip_min, block);
    memcpy(p->right + begin, p->gradient + begin, bytes);
    constraints_find_active(p->contacts, p->best, p->right, block, block + 1);
    for (size_t i = begin; i < end && p->rubs; i += W)
        for (size_t c = 0; c < 3; c++) sum[1 + c] += (double)p->base[i + 3] * ((double)p->best[i + c] - (double)p->base[i + c]);
}

static void sum_steps(const Primal *p, const Search *search, size_t begin, size_t end, double *sum)
{
    for (int i = 0; i < search->pairs; i++) sum[i] = dot(primal_step_of(p, search, i), p->right, begin, end);
}

static void take_over(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const Search *search = primal_search_of(p, block);
    if (search->phase != SEARCH_ACCEPTS) return;
    take_over_bare(p, block, begin, end, sum);
    sum_steps(p, search, begin, end, sum);
}

static void add_friction(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const Search *search = primal_search_of(p, block);
    if (search->phase != SEARCH_ACCEPTS) return;
    sum[SUMS - 1] = constraints_friction(p->contacts, p->best, p->gradient, 1.0f, p->slip_min, block);
    constraints_friction(p->contacts, p->best, p->right, 1.0f, p->slip_min, block);
    constraints_remove(p->contacts, p->right, block, block + 1);
    sum_steps(p, search, begin, end, sum);
}

/* Friction of the impulses at the accepted displacements, in place of that in the energy before. */
static void renew_friction(Primal *p)
{
    PrimalState *state = &p->world->primal;
    BodyFriction *body = state->friction.data;
    const int32_t *of_block = p->world->grid.body.data, bodies = p->world->grid.bodies;
    const double *sums = state->sums.data;
    for (int32_t i = 0; i < bodies; i++) {
        if (p->search[p->search[i].own].phase != SEARCH_ACCEPTS) continue;
        p->search[i].energy -= p->search[i].total[0];
        body[i].held = false;
        memset(body[i].gained, 0, sizeof body[i].gained);
        for (int k = 0; k < body[i].groups; k++) memset(body[i].group[k].push, 0, sizeof body[i].group[k].push);
    }
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        if (primal_search_of(p, block)->phase != SEARCH_ACCEPTS) continue;
        for (int c = 0; c < 3; c++) body[of_block[block]].gained[c] += sums[(size_t)block * SUMS + 1 + (size_t)c];
        constraints_sum_push(p->contacts, p->best, p->gradient, p->slip_min, block, &body[of_block[block]]);
    }
    for (int32_t i = 0; i < bodies; i++)
        if (p->search[p->search[i].own].phase == SEARCH_ACCEPTS) constraints_scale(&body[i]);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++)
        if (primal_search_of(p, block)->phase == SEARCH_ACCEPTS) constraints_set_limits(p->contacts, block, &body[of_block[block]]);
    primal_over_searches(p, add_friction);
    for (int32_t i = 0; i < bodies; i++)
        if (p->search[i].phase == SEARCH_ACCEPTS) p->search[i].energy += p->search[i].total[SUMS - 1];
}

static void keep_pair(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const Search *search = primal_search_of(p, block);
    if (search->phase != SEARCH_ACCEPTS) return;
    float *step = primal_step_of(p, search, 0), *change = primal_change_of(p, search, 0);
    subtract(step, p->node, p->best, begin, end);
    if (p->joint) constraints_remove_led(p->contacts, step, block); /* nodes that follow do not move by themselves */
    subtract(change, p->force, p->gradient, begin, end);
    for (int i = 0; i < search->pairs; i++) sum[i] = dot(change, primal_step_of(p, search, i), begin, end);
    sum[SUMS - 1] = dot(step, step, begin, end);
    sum[SUMS - 2] = dot(change, change, begin, end);
}

/* The oldest pair makes room for a new one at the front. */
static void shift_pairs(Search *search)
{
    search->newest = (search->newest + PRIMAL_MEMORY - 1) % PRIMAL_MEMORY;
    for (int i = PRIMAL_MEMORY - 1; i > 0; i--)
        for (int j = PRIMAL_MEMORY - 1; j > 0; j--) search->product[i][j] = search->product[i - 1][j - 1];
    search->pairs = search->pairs < PRIMAL_MEMORY ? search->pairs + 1 : PRIMAL_MEMORY;
}

static void drop_newest_pair(Search *search)
{
    search->newest = (search->newest + 1) % PRIMAL_MEMORY;
    for (int i = 0; i + 1 < PRIMAL_MEMORY; i++)
        for (int j = 0; j + 1 < PRIMAL_MEMORY; j++) search->product[i][j] = search->product[i + 1][j + 1];
    search->pairs--;
}

static void keep_pairs(Primal *p)
{
    Search *search;
    for (int32_t i = 0; (search = next_search(p, &i));)
        if (search->phase == SEARCH_ACCEPTS) shift_pairs(search);
    primal_over_searches(p, keep_pair);
    if (joined_is(p, SEARCH_ACCEPTS)) primal_yield_keep_pair(p);
    for (int32_t i = 0; (search = next_search(p, &i));) {
        if (search->phase != SEARCH_ACCEPTS) continue;
        const double *total = search->total;
        memcpy(search->product[0], total, sizeof search->product[0]);
        if (total[0] > CURVATURE_MIN * sqrt(total[SUMS - 1] * total[SUMS - 2])) continue;
        drop_newest_pair(search);
        if (search == p->joined) primal_yield_drop_pair(p);
    }
}

static void keep_energies(Primal *p)
{
    const PrimalState *state = &p->world->primal;
    const float *energy = state->block_energy.data;
    float *accepted = state->accepted_energy.data;
    for (int32_t block = 0; block < p->world->grid.particle_blocks; block++)
        if (primal_search_of(p, block)->phase == SEARCH_ACCEPTS) memcpy(accepted + K_ENERGIES * block, energy + K_ENERGIES * block, K_ENERGIES * sizeof *energy);
}

/* Makes p->node the accepted displacements of the searches that accept it. */
static void accept(Primal *p)
{
    for (int32_t i = 0; i < p->world->grid.bodies; i++)
        if (p->search[i].phase == SEARCH_ACCEPTS) p->search[i].energy = p->search[i].trial_energy;
    primal_over_searches(p, p->rubs ? take_over_bare : take_over);
    if (p->rubs) renew_friction(p);
    for (int32_t i = 0; i < p->world->grid.bodies; i++)
        if (p->search[i].phase == SEARCH_ACCEPTS) memcpy(p->search[i].first, p->search[i].total, sizeof p->search[i].first);
    if (joined_is(p, SEARCH_ACCEPTS)) primal_yield_accept(p);
    keep_energies(p);
}

void primal_accept(Primal *p, BodyTest *chosen)
{
    choose(p, chosen, SEARCH_ACCEPTS);
    for (int32_t i = 0; i < p->world->grid.bodies; i++)
        if (p->search[i].phase == SEARCH_ACCEPTS) p->search[i].pairs = 0;
    accept(p);
    change_phases(p, SEARCH_ACCEPTS, SEARCH_SEEKS);
}

/* ---- The direction: two loops over the pairs, with the preconditioner between them ---- */

static void join_levels(Primal *p, int32_t block, size_t begin, size_t end)
{
    const float *inverse = p->world->primal.inverse.data;
    const float *restrict right = p->right;
    float *restrict direction = p->direction;
    memcpy(p->force + begin, right + begin, (end - begin) * sizeof *right);
    for (size_t i = begin; i < end; i += W)
        for (size_t c = 0; c < W; c++) direction[i + c] = inverse[i / W] * right[i + c];
    if (p->rubs) constraints_soften(p->contacts, p->best, inverse, direction, p->slip_min, block);
}

/* Others keep their direction: the levels add nothing to it. */
static void stay_out(Primal *p, size_t begin, size_t end) { memset(p->force + begin, 0, (end - begin) * sizeof *p->force); }

static void add_changes(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const Search *search = primal_search_of(p, block);
    if (search->phase != SEARCH_SEEKS) {
        stay_out(p, begin, end);
        return;
    }
    for (int k = 0; k < search->pairs; k++) add(p->right, -search->first[k], primal_change_of(p, search, k), begin, end);
    constraints_remove(p->contacts, p->right, block, block + 1);
    if (p->rigid)
        primal_sum_rigid(p, block, p->right + begin, sum);
    else
        join_levels(p, block, begin, end);
}

static void deflate(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    (void)sum;
    if (primal_search_of(p, block)->phase != SEARCH_SEEKS) return;
    primal_deflate(p, block, begin, end);
    join_levels(p, block, begin, end);
}

static void sum_changes(const Primal *p, const Search *search, size_t begin, size_t end, double *sum)
{
    for (int k = 0; k < search->pairs; k++) sum[k] = dot(primal_change_of(p, search, k), p->direction, begin, end);
}

static void add_rigid(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const Search *search = primal_search_of(p, block);
    if (search->phase != SEARCH_SEEKS) return;
    primal_add_rigid(p, block, begin, end);
    sum_changes(p, search, begin, end, sum);
}

static void project_direction(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const float *inverse = p->world->primal.inverse.data;
    const Search *search = primal_search_of(p, block);
    if (search->phase != SEARCH_SEEKS) return;
    for (size_t i = begin; i < end; i += W)
        for (size_t c = 0; c < W && !(inverse[i / W] > 0.0f); c++) p->direction[i + c] = 0.0f; /* the levels reach beyond matter */
    constraints_remove(p->contacts, p->direction, block, block + 1);
    if (p->rigid)
        primal_sum_inertia(p, block, begin, end, sum);
    else
        sum_changes(p, search, begin, end, sum);
}

static void add_steps(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const Search *search = primal_search_of(p, block);
    if (search->phase != SEARCH_SEEKS) return;
    for (int k = 0; k < search->pairs; k++) add(p->direction, search->second[k], primal_step_of(p, search, k), begin, end);
    constraints_remove(p->contacts, p->direction, block, block + 1);
    sum[0] = dot(p->gradient, p->direction, begin, end);
}

/* search->first holds step . right of each pair; then the coefficients of the changes. */
static void find_first(Search *search)
{
    for (int i = 0; i < search->pairs; i++) {
        double along = search->first[i]; /* of what is left of the gradient */
        for (int j = 0; j < i; j++) along -= search->first[j] * search->product[j][i];
        search->first[i] = along / search->product[i][i];
    }
}

/* search->total holds change . direction of each pair. */
static void find_second(Search *search)
{
    for (int i = search->pairs - 1; i >= 0; i--) {
        double along = search->total[i];
        for (int j = i + 1; j < search->pairs; j++) along += search->second[j] * search->product[i][j];
        search->second[i] = search->first[i] - along / search->product[i][i];
    }
}

/* B of what is right, and its products with the pairs' changes. */
static void precondition(Primal *p)
{
    Loops loops;
    loops_open(&loops, p->world->pool);
    primal_add_pass(p, &loops, add_changes);
    if (p->rigid) {
        loops_run(&loops);
        primal_solve_rigid(p);
        primal_add_pass(p, &loops, deflate);
    }
    multilevel_add(&p->world->primal.multilevel, &loops, p->force, p->direction);
    primal_add_pass(p, &loops, project_direction);
    primal_run_and_gather(p, &loops);
    if (!p->rigid) return;
    primal_correct_rigid(p);
    primal_over_searches(p, add_rigid);
}

static void take_gradients(Primal *p)
{
    const size_t floats = (size_t)p->floats;
    Search *search;
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++)
        if (primal_search_of(p, block)->plain) memcpy(p->right + (size_t)block * floats, p->gradient + (size_t)block * floats, floats * sizeof *p->right);
    if (p->joined && p->joined->plain) primal_yield_begin_plain(p);
    for (int32_t i = 0; (search = next_search(p, &i));) search->plain = false;
}

/* The directions of those that seek one: p->direction from p->right, and its product with the gradient. */
static void find_directions(Primal *p)
{
    Search *search;
    const bool joined = joined_is(p, SEARCH_SEEKS);
    bool plain = false;
    if (!any_is(p, SEARCH_SEEKS)) return;
    for (int32_t i = 0; (search = next_search(p, &i));) {
        plain = plain || search->plain;
        if (search->phase == SEARCH_SEEKS) find_first(search);
    }
    if (plain) take_gradients(p);
    if (p->rigid) primal_weigh_rigid(p);
    if (joined) primal_yield_add_changes(p);
    precondition(p);
    if (joined) primal_yield_find_direction(p);
    for (int32_t i = 0; (search = next_search(p, &i));)
        if (search->phase == SEARCH_SEEKS) find_second(search);
    primal_over_searches(p, add_steps);
    if (joined) primal_yield_add_steps(p);
    for (int32_t i = 0; (search = next_search(p, &i));)
        if (search->phase == SEARCH_SEEKS) search->decrement = search->total[0];
}

/* The next direction is found without pairs, from the gradient. */
static void begin_plain(Search *search)
{
    search->pairs = 0;
    search->plain = true;
    search->phase = SEARCH_SEEKS;
}

double primal_residual(const Primal *p)
{
    double sum = 0.0;
    Search *search;
    for (int32_t i = 0; (search = next_search(p, &i));) sum += fmax(search->decrement, 0.0);
    return sqrt(sum / p->mass);
}

double primal_plain_residual(Primal *p, BodyTest *chosen)
{
    choose(p, chosen, SEARCH_SEEKS);
    for (int32_t i = 0; i < p->world->grid.bodies; i++)
        if (p->search[i].phase == SEARCH_SEEKS) begin_plain(&p->search[i]);
    find_directions(p);
    return primal_residual(p);
}

/* ---- Descent ---- */

static void try_step(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const Search *search = primal_search_of(p, block);
    (void)sum;
    memcpy(p->node + begin, p->best + begin, (end - begin) * sizeof(float));
    if (search->phase != SEARCH_TRIES) return;
    add(p->node, -(double)search->share, p->direction, begin, end);
    constraints_project(p->contacts, p->node, block, block + 1);
}

static bool is_good(const Search *search)
{
    if (!isfinite(search->trial_energy) || !isfinite(search->slope_after)) return false;
    if (search->trial_energy <= search->energy + ARMIJO * search->slope_before) return true;
    const bool rounding = search->trial_energy - search->energy <= ENERGY_ROUNDING * fabs(search->energy);
    return rounding && search->slope_before < 0.0 && fabs(search->slope_after) <= SLOPE_SHARE * fabs(search->slope_before);
}

/* Whether the step went far beyond the lowest point on its way. */
static bool is_too_long(const Search *search) { return search->slope_after > TOO_LONG * fabs(search->slope_before); }

/* How much of a step that was too long is tried next: where the slope would vanish if it changed evenly. */
static float shorter(const Search *search)
{
    const double vanishes = search->slope_before / (search->slope_before - search->slope_after);
    return isfinite(vanishes) ? (float)fmin(is_good(search) ? 1.0 : 0.5, fmax(0.1, vanishes)) : 0.1f;
}

/* Near the lowest point the differences of gradients are rounding, and a direction made of such pairs may lead nowhere and be a hundred times too long. Where no step along
 * it is good the one without pairs is followed, and says what is left. */
static void give_up(Primal *p, Search *search)
{
    if (search == p->joined) primal_yield_return(p);
    if (search->pairs > 0)
        begin_plain(search);
    else
        search->phase = SEARCH_ENDED;
}

/* What a search does after its step was tried. A single iteration of a liquid has no other after it that mends what it did too much of: with one more evaluation it
 * is shortened. */
static void judge(Primal *p, Search *search)
{
    const bool good = is_good(search), shortens = search->passes++ == 0 && search->most == 1 && search->with_liquid && good && is_too_long(search);
    if (shortens) search->most++;
    if (good && !shortens) {
        search->phase = SEARCH_ACCEPTS;
        return;
    }
    search->share *= shorter(search);
    if (search->passes == search->most) {
        if (search == p->joined) primal_yield_return(p);
        search->phase = SEARCH_ENDED;
    } else if (!((double)search->share > SMALLEST_STEP)) {
        give_up(p, search);
    }
}

/* One evaluation, for all that try a step. */
static void try_all(Primal *p)
{
    Search *search;
    Loops loops;
    loops_open(&loops, p->world->pool);
    primal_yield_try(p);
    primal_add_pass(p, &loops, try_step);
    evaluate_after(p, &loops, p->world->kernels->force);
    for (int32_t i = 0; (search = next_search(p, &i));)
        if (search->phase == SEARCH_TRIES) judge(p, search);
    if (!any_is(p, SEARCH_ACCEPTS)) return;
    keep_pairs(p);
    accept(p);
    for (int32_t i = 0; (search = next_search(p, &i));)
        if (search->phase == SEARCH_ACCEPTS) search->phase = search->passes < search->most ? SEARCH_SEEKS : SEARCH_SPENT;
}

static void start_along(Search *search)
{
    search->share = 1.0f;
    search->phase = search->decrement > 0.0 ? SEARCH_TRIES : SEARCH_ENDED;
}

/* Whether a search has no more error than is asked for. */
static bool is_close(const Primal *p, const Search *search)
{
    return PRIMAL_ERROR_PER_RESIDUAL * sqrt(fmax(search->decrement, 0.0) / search->mass) < (double)p->world->settings.target_error;
}

/* Those that seek a direction find one, and follow it unless they are done. */
static void go_on(Primal *p, bool stops)
{
    Search *search;
    find_directions(p);
    for (int32_t i = 0; (search = next_search(p, &i));)
        if (search->phase == SEARCH_SEEKS && !(search->decrement > 0.0) && search->pairs > 0) begin_plain(search);
        else if (search->phase == SEARCH_SEEKS) start_along(search);
    find_directions(p);
    for (int32_t i = 0; (search = next_search(p, &i));) {
        if (search->phase == SEARCH_SEEKS) start_along(search);
        if (search->phase == SEARCH_TRIES && stops && is_close(p, search)) search->phase = SEARCH_ENDED;
    }
}

uint32_t primal_search(Primal *p, uint32_t most, BodyTest *chosen, bool stops)
{
    uint32_t passes = 0;
    Search *search;
    choose(p, chosen, SEARCH_SEEKS);
    for (int32_t i = 0; (search = next_search(p, &i));) {
        search->passes = 0;
        search->most = most;
    }
    while (most > 0 && !(stops && solver_time_is_up(p->world))) {
        go_on(p, stops);
        if (!any_is(p, SEARCH_TRIES)) break;
        try_all(p);
        passes++;
    }
    if (joined_is(p, SEARCH_TRIES)) primal_yield_return(p); /* the time was up before its step was good */
    return passes;
}

void primal_find_residual(Primal *p)
{
    change_phases(p, SEARCH_SPENT, SEARCH_SEEKS);
    find_directions(p);
}

void primal_follow(Primal *p, uint32_t most)
{
    Search *search;
    for (int32_t i = 0; (search = next_search(p, &i));) {
        search->pairs = 0;
        search->passes = 0;
        search->most = most;
        search->decrement = search->total[0];
        start_along(search);
    }
    while (any_is(p, SEARCH_TRIES)) try_all(p);
}
