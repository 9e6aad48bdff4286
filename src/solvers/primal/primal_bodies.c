#include <math.h>
#include <string.h>

#include "contact/contact_constraints.h"
#include "solvers/eddy_damping.h"
#include "solvers/passes.h"
#include "solvers/primal/primal_solve.h"

/* ---- The energy check ---- */

BodySum *primal_body_of(const Primal *p, int32_t block)
{
    const PrimalState *state = &p->world->primal;
    return (BodySum *)state->body_sums.data + body_of_block(&p->world->grid, block);
}

bool primal_has_failed(const Primal *p, int32_t body) { return ((const BodySum *)p->world->primal.body_sums.data)[body].failed; }
bool primal_is_unsound(const Primal *p, int32_t body) { return ((const BodySum *)p->world->primal.body_sums.data)[body].unsound; }

bool primal_is_multistep(const Primal *p, int32_t block)
{
    const float *share = p->world->args.primal.block_share;
    return share && share[block] < 1.0f;
}

/* Sums over the nodes of a block, for sum_bodies(). Forces do work as gravity does. */
static void sum_motion(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const bool multistep = primal_is_multistep(p, block);
    const float *pull = p->world->args.gravity, *without_forces = p->world->args.grid.node_before;
    for (size_t i = begin; i < end; i += W) {
        const double mass = (double)p->base[i + 3];
        sum[3] += mass;
        for (size_t c = 0; c < 3; c++) {
            const double u = (double)p->best[i + c], free = (double)p->base[i + c];
            const double g = (double)pull[c] + (free - (double)without_forces[i + c]);
            if (multistep) { /* the energy that the step minimises */
                sum[0] += 0.5 * mass * (u - free) * (u - free);
                sum[1] += 0.5 * mass * free * free;
            } else {
                sum[0] += 0.5 * mass * u * u - mass * g * u;
                sum[1] += mass > 0.0 ? 0.5 * mass * (free - g) * (free - g) : 0.0;
            }
            sum[4 + c] += mass * free;
            sum[8] += 0.5 * mass * u * u;
            sum[12] += 0.5 * mass * free * free;
            sum[9 + c] += mass * u;
        }
    }
    ContactExchange exchange = {0};
    if (!p->as_sent) sum[2] = constraints_work(p->contacts, p->gradient, p->best, p->slip_min, block);
    if (p->as_sent || p->joint) constraints_exchange(p->contacts, p->gradient, p->best, p->slip_min, block, &exchange);
    memcpy(sum + CHECK_SUMS, &exchange, sizeof exchange);
    sum[7] = (double)constraints_active(p->contacts, block);
}

static void add_exchange(ContactExchange *all, const double sum[EXCHANGE_SUMS])
{
    ContactExchange own;
    memcpy(&own, sum, sizeof own);
    all->work += own.work;
    all->size += own.size;
    for (int c = 0; c < 3; c++) {
        all->given[c] += own.given[c];
        all->surface[c] += own.surface[c];
    }
}

static bool has_liquid(const World *world, int32_t block)
{
    const uint32_t *block_run = world->grid.block_run.data;
    for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++)
        if (world->materials.kernel[world->grid.run_key[run] >> K_RUN_CELL_BITS].kind == K_LIQUID) return true;
    return false;
}

/* What rounding F, whose distance from the identity is the strain, may do to the energy of a strain: stress times 2^-24, with the body's stiffness k
 * about sqrt(k Psi) 2^-24. */
static double rounding_of(const BodySum *body)
{
    return ENERGY_ROUNDING * (body->before + body->still + body->pressed_rest) + ldexp(1.0, -24) * sqrt(body->before * body->stiff);
}

/* Whether more energy came out than went in, or than the joint solver's liquid gave. The primal alone judges the elastic energy of matter with liquid: what a truncated
 * solution leaves in the pressure of a liquid is an error of its volume, and no energy that anything can be driven with. What it fell may have gone into that: of a
 * body that starts at rest and without strain nothing else could. */
static bool gained(const Primal *p, const BodySum *body)
{
    const double after = body->with_liquid && !p->joint ? body->elastic - body->fallen : body->after + body->pressed;
    return after > body->before + body->pressed_rest + body->work + rounding_of(body);
}

void primal_note_stiffness(Primal *p)
{
    const double *sums = p->world->primal.sums.data;
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) primal_body_of(p, block)->stiff += sums[(size_t)block * SUMS + 1];
}

void primal_note_driven(Primal *p)
{
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) constraints_exchange_staying(p->contacts, p->gradient, block, &primal_body_of(p, block)->driven);
}

/* What else a body gained of momentum came from nodes that stay, or a solution that is not finished has left it. Seen from the walls it does no work. So the check does not
 * depend on who looks: a float in a tank that sank or rose by two cells per step went elsewhere by five. What no wall holds is looked at from its mean motion. */
static double driven_work(const BodySum *body, const double gained[3])
{
    const ContactExchange *driven = &body->driven;
    double work = driven->work;
    for (int c = 0; c < 3; c++) work += (gained[c] - body->exchange.given[c] - driven->given[c]) * (driven->size > 0.0 ? driven->surface[c] / driven->size : body->start[c]);
    return work;
}

/* Whether all obstacles go where the host sends them: not as matter pushes them. */
static bool move_as_sent(const ContactFrame *frame)
{
    for (int i = 0; i < frame->colliders->obstacle_count; i++)
        if (frame->colliders->obstacle[i].body) return false;
    return true;
}

uint32_t primal_check_bodies(Primal *p)
{
    p->as_sent = !p->joint && move_as_sent(p->contacts);
    const PrimalState *state = &p->world->primal;
    const double *sums = state->sums.data;
    const float *energy = state->accepted_energy.data, *rest = state->block_energy.data;
    BodySum *body = state->body_sums.data;
    uint32_t failed = 0;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) body[i] = (BodySum){.unsound = body[i].unsound, .leans = body[i].leans, .meets = body[i].meets, .held = body[i].held, .stiff = body[i].stiff, .driven = body[i].driven, .with_liquid = body[i].with_liquid};
    primal_over_blocks(p, sum_motion);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        BodySum *b = primal_body_of(p, block);
        const double *sum = sums + (size_t)block * SUMS;
        b->after += sum[0];
        b->before += sum[1];
        b->work += sum[2];
        b->mass += sum[3];
        b->kinetic += sum[8];
        b->still += sum[12];
        if (!primal_is_multistep(p, block)) b->fallen += sum[8] - sum[0];
        for (int c = 0; c < 3; c++) {
            b->momentum[c] += sum[4 + c];
            b->moved[c] += sum[9 + c];
        }
        b->touches = b->touches || sum[7] > 0.0;
        add_exchange(&b->exchange, sum + CHECK_SUMS);
        if (block >= p->world->grid.particle_blocks) continue;
        const double elastic = (double)energy[K_ENERGIES * block], liquid = (double)energy[K_ENERGIES * block + 1], liquid_rest = (double)rest[K_ENERGIES * block + 3];
        b->elastic += elastic;
        b->after += elastic + (p->joint ? 0.0 : liquid); /* the dual's liquid stores none */
        b->before += (double)rest[K_ENERGIES * block + 2] + (p->joint ? 0.0 : liquid_rest);
        b->pressed += p->joint ? liquid : 0.0;
        b->pressed_rest += p->joint ? liquid_rest : 0.0;
    }
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        double gave[3];
        for (int c = 0; c < 3; c++) gave[c] = body[i].moved[c] - body[i].momentum[c];
        for (int c = 0; c < 3 && body[i].mass > 0.0; c++) body[i].start[c] = body[i].momentum[c] / body[i].mass;
        body[i].work += p->joint ? driven_work(&body[i], gave) : constraints_exchanged_work(&body[i].exchange, gave);
        body[i].failed = gained(p, &body[i]);
        body[i].unsound = body[i].unsound || body[i].failed;
        failed += body[i].failed;
    }
    for (int32_t block = 0; block < p->world->grid.node_blocks && failed > 0; block++)
        if (primal_body_of(p, block)->failed) constraints_turn_aside(p->contacts, block, primal_body_of(p, block)->start);
    for (int32_t block = 0; block < p->world->grid.node_blocks && failed > 0; block++) {
        BodySum *b = primal_body_of(p, block);
        if (!b->failed) continue;
        const double share = constraints_free_share(p->contacts, block, b->start);
        for (int c = 0; c < 3; c++) b->start[c] *= share;
    }
    return failed;
}

/* A mean motion may lead through a floor; a liquid that touches something starts from standing still. */
static void pull_back(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const BodySum *body = primal_body_of(p, block);
    (void)sum;
    if (body->failed && p->turned && primal_rigid_of(p, block)->turns) {
        primal_write_rigid(p, block, begin, end, p->node);
        for (size_t i = begin; i < end; i++) p->node[i] = i % W == 3 ? p->base[i] : p->node[i] + p->share * (p->best[i] - p->node[i]);
        constraints_project(p->contacts, p->node, block, block + 1);
        return;
    }
    for (size_t i = begin; i < end; i++) {
        const size_t c = i % W;
        if (c == 3 || p->base[i - c + 3] == 0.0f) continue;
        const float start = body->with_liquid && body->touches ? 0.0f : (float)body->start[c];
        p->node[i] = body->failed ? start + p->share * (p->best[i] - start) : p->best[i];
    }
    constraints_project(p->contacts, p->node, block, block + 1);
}

void primal_pull_back_to(Primal *p, float share)
{
    p->share = share;
    primal_over_blocks(p, pull_back);
    primal_evaluate(p);
    p->world->record.iterations_used++;
    primal_accept(p, primal_has_failed);
}

double primal_own_motion(const BodySum *body)
{
    double own = body->kinetic;
    for (int c = 0; c < 3 && body->mass > 0.0; c++) own -= 0.5 * body->moved[c] * body->moved[c] / body->mass;
    return own;
}

/* Whether eddies can make up for what a body with liquid gained, and for what is owed: primal_find_kept() takes it. */
static bool eddies_pay(const Primal *p, const BodySum *body, double gain)
{
    return p->joint && body->with_liquid && body->meets && eddy_damping_share(gain + eddy_damping_owed(p->world), primal_own_motion(body)) > 0.0f;
}

/* A body that gained little goes where the solution leads, and pays with its velocities: they keep the share s of what they differ from its mean, with
 * 1 - s^2 the gain over that kinetic energy. In the joint solver eddies pay. Returns how many failed bodies are left. */
static uint32_t let_pay(Primal *p)
{
    const PrimalState *state = &p->world->primal;
    RigidBody *rigid = state->rigid.data;
    BodySum *body = state->body_sums.data;
    uint32_t failed = 0;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        const BodySum *b = &body[i];
        if (!b->failed) continue;
        const double gain = b->after - b->before - b->work, own = primal_own_motion(b);
        const bool pays = rigid[i].turns && gain <= own;
        if (pays) {
            rigid[i].kept = sqrt(1.0 - gain / own);
            for (int c = 0; c < 3; c++) rigid[i].mean[c] = b->moved[c] / b->mass;
        }
        body[i].failed = !pays && !eddies_pay(p, b, gain);
        failed += body[i].failed;
    }
    return failed;
}

/* Where a body ends it has its momentum: what it gained, and the mean that its velocities differ from, are those of that motion. Judged before, stale means let a
 * body that pays lose or gain momentum, by (1 - s) of what it still missed, and go faster than max_displacement. */
static uint32_t find_failed(Primal *p)
{
    RigidBody *rigid = p->world->primal.rigid.data;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) rigid[i].kept = 1.0;
    primal_keep_momentum(p, primal_has_failed);
    return primal_check_bodies(p);
}

/* What failed goes on, without stop rules. */
static void search_further(Primal *p)
{
    p->world->record.iterations_used += primal_search(p, (uint32_t)p->world->settings.iterations + 1, primal_has_failed, false);
}

/* True if no body is left that gained. */
static bool search_on(Primal *p)
{
    memcpy(p->node, p->best, (size_t)p->world->grid.node_blocks * (size_t)p->floats * sizeof *p->node); /* bodies were moved since */
    primal_evaluate(p);
    primal_accept(p, primal_has_failed);
    search_further(p); /* nearly there */
    return find_failed(p) == 0;
}

/* For bodies that gained energy: see primal.h. Eddies pay last: the motion that counts as theirs is also that of a body beside its liquid. Asked after one search of the joint
 * solver, they let a stiff body that hit water gain a tenth of all energy in a substep; after two, a twentieth. */
static void mend(Primal *p)
{
    enum { JOINT_ROUNDS = 4 }; /* by trial, see above */
    const int searches = p->joint ? JOINT_ROUNDS : 1;
    for (int search = 0; search < searches; search++)
        if (search_on(p)) return;
    if (let_pay(p) == 0) return;
    p->turned = true;
    primal_pull_back_to(p, 0.0f);
    search_further(p);
    for (int halving = 0; find_failed(p) > 0 && let_pay(p) > 0; halving++) {
        p->turned = halving < 2;
        primal_pull_back_to(p, halving < 2 ? 0.5f : 0.0f);
        if (halving == 2) return;
    }
}

void primal_keep_energy(Primal *p)
{
    StepRecord *record = &p->world->record;
    record->energy_checks_failed = primal_check_bodies(p);
    if (record->energy_checks_failed == 0) return;
    mend(p);
    record->residual = primal_plain_residual(p, primal_is_unsound);
    record->predicted_error = PRIMAL_ERROR_PER_RESIDUAL * record->residual;
}

/* What gravity moves in the substep [cells]. */
static float fall_of(const World *world)
{
    const float *g = world->args.gravity;
    return sqrtf(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
}

void primal_find_leaning(Primal *p)
{
    const float fall = fall_of(p->world);
    memset(p->world->primal.body_sums.data, 0, (size_t)p->world->grid.bodies * sizeof(BodySum));
    for (int32_t block = 0; block < p->world->grid.particle_blocks; block++)
        if (has_liquid(p->world, block)) primal_body_of(p, block)->with_liquid = true;
    if (!p->sketches) primal_widen_gaps(p); /* the dual needs the spare array */
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        BodySum *body = primal_body_of(p, block);
        body->leans = body->leans || constraints_within(p->contacts, body->with_liquid ? 0.0f : fall, block) != 0;
        body->held = body->held || constraints_any_stick(p->contacts, block);
        body->meets = body->meets || constraints_count(p->contacts, block) > 0;
    }
}
