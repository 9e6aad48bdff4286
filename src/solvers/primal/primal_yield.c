#include "solvers/primal/primal_yield.h"

#include <stdio.h>
#include <stdlib.h>
#include <math.h>
#include <string.h>

#include "base/cholesky.h"
#include "base/result.h"
#include "contact/contact_constraints.h"
#include "solvers/passes.h"

enum { WAYS = FREE_BODY_WAYS, BLOCK_FLOATS = 64 * W, SWEEPS = 2 };

/* A contact of a body, in the order of contacts. */
typedef struct YieldGrip {
    int32_t block;
    uint32_t contact, body;
    float surface[3]; /* as its obstacle was sent */
    double move[WAYS][3]; /* C W */
} YieldGrip;

typedef struct YieldBody {
    Obstacle *obstacle;
    double unit; /* of q over that of velocities along the ways */
    double way[WAYS][6]; /* W */
    double aim[WAYS];    /* a */
    double at[WAYS], force[WAYS];        /* where the energy was evaluated, and its gradient */
    double best[WAYS], gradient[WAYS];   /* the same where it was accepted */
    double right[WAYS], direction[WAYS]; /* r, and D^-1 r with what pairs add */
    double step[PRIMAL_MEMORY][WAYS], change[PRIMAL_MEMORY][WAYS];
    SmallMatrix factor; /* of D */
} YieldBody;

static PrimalState *state_of(const Primal *p) { return &p->world->primal; }
static YieldBody *bodies_of(const Primal *p) { return state_of(p)->yield_body.data; }
static YieldGrip *grips_of(const Primal *p) { return state_of(p)->yield_grip.data; }
static Contact *contacts_of(const Primal *p) { return p->contacts->colliders->contact.data; }
static size_t node_of(const Primal *p, const YieldGrip *grip) { return (size_t)grip->block * (size_t)p->floats + (size_t)contacts_of(p)[grip->contact].node * W; }

static double product(const double a[WAYS], const double b[WAYS])
{
    double sum = 0.0;
    for (int k = 0; k < WAYS; k++) sum += a[k] * b[k];
    return sum;
}

/* ---- Listing ---- */

static bool may_yield(const Obstacle *o) { return o->body && o->body->yields; }

static void list_body(YieldBody *body, Obstacle *o, const ContactFrame *contacts)
{
    const double half = pow(contacts->cell_size, 0.5 * contacts->grid->dimension); /* see wall_bodies_list() */
    *body = (YieldBody){.obstacle = o, .unit = contacts->substep->dt / (half * contacts->cell_size)};
    for (int k = 0; k < o->body->ways; k++)
        for (int a = 0; a < 6; a++) body->way[k][a] = (a < 3 ? half : half * contacts->cell_size) * o->body->open[k][a];
}

static void list_grip(YieldGrip *grip, const YieldBody *body, const Contact *contact, const ContactFrame *contacts)
{
    double point[3], arm[3] = {0};
    memcpy(grip->surface, contact->surface, sizeof grip->surface);
    contacts_node_position(contacts, grip->block, contact->node, point);
    for (int a = 0; a < contacts->grid->dimension; a++) arm[a] = (point[a] - body->obstacle->body->centre[a]) / contacts->cell_size;
    for (int k = 0; k < WAYS; k++)
        for (int a = 0; a < 3; a++) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            grip->move[k][a] = body->way[k][a] + body->way[k][3 + b] * arm[c] - body->way[k][3 + c] * arm[b];
        }
}

static void list_grips(PrimalState *state, const ContactFrame *contacts, const uint32_t *body_of)
{
    const Contact *contact = contacts->colliders->contact.data;
    const uint32_t *begin = contacts->colliders->contact_begin.data;
    const int obstacles = contacts->colliders->obstacle_count;
    YieldGrip *grip = state->yield_grip.data;
    for (int32_t block = 0; block < contacts->grid->node_blocks; block++)
        for (uint32_t i = begin[block]; i < begin[block + 1]; i++) {
            if (contact[i].obstacle >= obstacles || !may_yield(&contacts->colliders->obstacle[contact[i].obstacle])) continue;
            grip[state->yield_grips] = (YieldGrip){.block = block, .contact = i, .body = body_of[contact[i].obstacle]};
            list_grip(&grip[state->yield_grips++], (YieldBody *)state->yield_body.data + body_of[contact[i].obstacle], &contact[i], contacts);
        }
}

pbmpm_result primal_yield_list(World *world, const ContactFrame *contacts)
{
    PrimalState *state = &world->primal;
    Colliders *colliders = contacts->colliders;
    uint32_t body_of[PBMPM_MAX_COLLIDERS + DOMAIN_WALLS + 1], bodies = 0;
    state->yield_bodies = state->yield_grips = 0;
    for (int i = 0; i < colliders->obstacle_count; i++) bodies += may_yield(&colliders->obstacle[i]);
    if (bodies == 0 || colliders->contacts == 0 || world->record.solver != PBMPM_SOLVER_PRIMAL || solver_holds_liquid(world)) return PBMPM_OK;
    if (!array_reserve(&world->memory, &state->yield_body, bodies, sizeof(YieldBody)) ||
        !array_reserve(&world->memory, &state->yield_grip, colliders->contacts, sizeof(YieldGrip)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for %u rigid bodies on solids", bodies);
    for (int i = 0; i < colliders->obstacle_count; i++) {
        if (!may_yield(&colliders->obstacle[i])) continue;
        body_of[i] = state->yield_bodies++;
        list_body((YieldBody *)state->yield_body.data + body_of[i], &colliders->obstacle[i], contacts);
    }
    list_grips(state, contacts, body_of);
    return PBMPM_OK;
}

void primal_yield_free(World *world)
{
    array_free(&world->memory, &world->primal.yield_body);
    array_free(&world->memory, &world->primal.yield_grip);
}

/* ---- Nodes that go along ---- */

static void motion_of(const YieldGrip *grip, const double q[WAYS], float out[3])
{
    double sum[3] = {0};
    for (int k = 0; k < WAYS; k++)
        for (int a = 0; a < 3; a++) sum[a] += grip->move[k][a] * q[k];
    for (int a = 0; a < 3; a++) out[a] = (float)sum[a];
}

static void add_push(const YieldGrip *grip, const float push[3], double factor, double sum[WAYS])
{
    for (int k = 0; k < WAYS; k++)
        for (int a = 0; a < 3; a++) sum[k] += factor * grip->move[k][a] * (double)push[a];
}

static bool carries(const Contact *contact) { return contact->active && (constraints_stick(contact) || constraints_friction_coefficient(contact) > 0.0f); }

/* The end of the grips of a block that begin at `first`. */
static uint32_t end_of_block(const Primal *p, uint32_t first)
{
    const YieldGrip *grip = grips_of(p);
    uint32_t end = first;
    while (end < state_of(p)->yield_grips && grip[end].block == grip[first].block) end++;
    return end;
}

/* One sweep over a block's active contacts. Each takes its part out of the vector; `takes`: grips add what that was to their bodies' sums. */
static void sweep_out(const Primal *p, uint32_t first, float *vector, double (*sums)[WAYS])
{
    const YieldGrip *grip = grips_of(p);
    const uint32_t *begin = p->contacts->colliders->contact_begin.data;
    uint32_t k = first;
    for (uint32_t i = begin[grip[first].block]; i < begin[grip[first].block + 1]; i++) {
        const bool grips = k < state_of(p)->yield_grips && grip[k].contact == i;
        const Contact *contact = contacts_of(p) + i;
        float *v = vector + (size_t)contact->node * W, out[3];
        if (grips) k++;
        if (!contact->active) continue;
        memcpy(out, v, sizeof out);
        constraints_take_out(contact, v);
        for (int a = 0; a < 3; a++) out[a] -= v[a];
        if (grips && sums) add_push(&grip[k - 1], out, 1.0, sums[grip[k - 1].body]);
    }
}

/* The same where each contact gives its part what the body's motion has: (1 - P) C W q. */
static void sweep_in(const Primal *p, uint32_t first, float *vector)
{
    const YieldGrip *grip = grips_of(p);
    const YieldBody *body = bodies_of(p);
    const uint32_t *begin = p->contacts->colliders->contact_begin.data;
    uint32_t k = first;
    for (uint32_t i = begin[grip[first].block]; i < begin[grip[first].block + 1]; i++) {
        const bool grips = k < state_of(p)->yield_grips && grip[k].contact == i;
        const Contact *contact = contacts_of(p) + i;
        float *v = vector + (size_t)contact->node * W, moved[3] = {0}, along[3];
        if (grips) k++;
        if (!contact->active) continue;
        if (grips) motion_of(&grip[k - 1], body[grip[k - 1].body].direction, moved);
        memcpy(along, moved, sizeof along);
        constraints_take_out(contact, v);
        constraints_take_out(contact, along);
        for (int a = 0; a < 3; a++) v[a] += moved[a] - along[a];
    }
}

/* W' sum C' (1 - P) v, to the bodies' right. */
static void fold(const Primal *p, uint32_t first, float *vector)
{
    double sums[PBMPM_MAX_COLLIDERS][WAYS];
    YieldBody *body = bodies_of(p);
    memset(sums, 0, state_of(p)->yield_bodies * sizeof *sums);
    for (int sweep = 0; sweep < SWEEPS; sweep++) sweep_out(p, first, vector, sums);
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++)
        for (int k = 0; k < WAYS; k++) body[b].right[k] += sums[b][k];
}

/* ---- Energy ---- */

/* Where surfaces are. */
static void move_surfaces(Primal *p, bool to_best)
{
    const YieldGrip *grip = grips_of(p);
    const YieldBody *body = bodies_of(p);
    for (uint32_t g = 0; g < state_of(p)->yield_grips; g++) {
        float moved[3];
        motion_of(&grip[g], to_best ? body[grip[g].body].best : body[grip[g].body].at, moved);
        for (int a = 0; a < 3; a++) contacts_of(p)[grip[g].contact].surface[a] = grip[g].surface[a] + moved[a];
    }
}

/* q - a - W' sum C' f at the displacements u. */
static void find_gradient(Primal *p, const float *u, bool at_best)
{
    const YieldGrip *grip = grips_of(p);
    YieldBody *body = bodies_of(p);
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++)
        for (int k = 0; k < WAYS; k++) {
            if (at_best)
                body[b].gradient[k] = body[b].best[k] - body[b].aim[k];
            else
                body[b].force[k] = body[b].at[k] - body[b].aim[k];
        }
    for (uint32_t g = 0; g < state_of(p)->yield_grips; g++) {
        YieldBody *of = &body[grip[g].body];
        float rub[3];
        if (constraints_rub(contacts_of(p) + grip[g].contact, u + node_of(p, &grip[g]), p->slip_min, rub)) add_push(&grip[g], rub, -1.0, at_best ? of->gradient : of->force);
    }
}

/* a: see the header. */
static void aim(const Primal *p, YieldBody *body)
{
    const Obstacle *o = body->obstacle;
    const FreeBody *free = o->body;
    const pbmpm_impulse given = impulse_about(&p->contacts->colliders->impulses.sum[o->place], free->centre, p->world->def.dimension);
    const double later = p->contacts->substep->dt * (o->parts - o->part - 1);
    double missing[6];
    memcpy(missing, given.linear, sizeof given.linear);
    memcpy(missing + 3, given.angular, sizeof given.angular);
    for (int a = 0; a < 6; a++) missing[a] -= free->expected[a] + later * free->push[a];
    for (int k = 0; k < free->ways; k++) {
        double sum = 0.0;
        for (int a = 0; a < 6; a++) sum += free->open[k][a] * missing[a];
        body->aim[k] = body->unit * (sum - free->change[k]);
    }
}

void primal_yield_open(Primal *p)
{
    YieldBody *body = bodies_of(p);
    p->yields = !p->joint && state_of(p)->yield_grips > 0;
    for (uint32_t b = 0; p->yields && b < state_of(p)->yield_bodies; b++) aim(p, &body[b]);
}

void primal_yield_evaluate(Primal *p)
{
    const YieldBody *body = bodies_of(p);
    if (!p->yields) return;
    find_gradient(p, p->node, false);
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++)
        for (int k = 0; k < WAYS; k++) {
            const double away = body[b].at[k] - body[b].aim[k], moved = body[b].at[k] - body[b].best[k];
            p->trial_energy += 0.5 * away * away;
            p->slope_before += body[b].gradient[k] * moved;
            p->slope_after += body[b].force[k] * moved;
        }
}

/* ---- Pairs ---- */

void primal_yield_keep_pair(Primal *p)
{
    YieldBody *body = bodies_of(p);
    for (uint32_t b = 0; p->yields && b < state_of(p)->yield_bodies; b++) {
        YieldBody *of = &body[b];
        memmove(of->step[1], of->step[0], sizeof of->step - sizeof of->step[0]);
        memmove(of->change[1], of->change[0], sizeof of->change - sizeof of->change[0]);
        for (int k = 0; k < WAYS; k++) {
            of->step[0][k] = of->at[k] - of->best[k];
            of->change[0][k] = of->force[k] - of->gradient[k];
        }
        for (int i = 0; i < p->pairs; i++) p->total[i] += product(of->change[0], of->step[i]);
        p->total[SUMS - 1] += product(of->step[0], of->step[0]);
        p->total[SUMS - 2] += product(of->change[0], of->change[0]);
    }
}

void primal_yield_drop_pair(Primal *p)
{
    YieldBody *body = bodies_of(p);
    for (uint32_t b = 0; p->yields && b < state_of(p)->yield_bodies; b++) {
        memmove(body[b].step[0], body[b].step[1], sizeof body[b].step - sizeof body[b].step[0]);
        memmove(body[b].change[0], body[b].change[1], sizeof body[b].change - sizeof body[b].change[0]);
    }
}

static void fold_blocks(Primal *p, const float *vector)
{
    for (uint32_t first = 0; first < state_of(p)->yield_grips; first = end_of_block(p, first)) {
        float own[BLOCK_FLOATS];
        memcpy(own, vector + (size_t)grips_of(p)[first].block * (size_t)p->floats, (size_t)p->floats * sizeof *own);
        fold(p, first, own);
    }
}

void primal_yield_accept(Primal *p)
{
    YieldBody *body = bodies_of(p);
    if (!p->yields) return;
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) memcpy(body[b].best, body[b].at, sizeof body[b].best);
    find_gradient(p, p->best, true);
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) memcpy(body[b].right, body[b].gradient, sizeof body[b].right);
    fold_blocks(p, p->gradient);
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++)
        for (int i = 0; i < p->pairs; i++) p->first[i] += product(body[b].step[i], body[b].right);
}

/* ---- The direction ---- */

void primal_yield_begin_plain(Primal *p)
{
    YieldBody *body = bodies_of(p);
    for (uint32_t b = 0; p->yields && b < state_of(p)->yield_bodies; b++) memcpy(body[b].right, body[b].gradient, sizeof body[b].right);
}

void primal_yield_add_changes(Primal *p)
{
    YieldBody *body = bodies_of(p);
    if (!p->yields) return;
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++)
        for (int i = 0; i < p->pairs; i++)
            for (int k = 0; k < WAYS; k++) body[b].right[k] -= p->first[i] * body[b].change[i][k];
    for (uint32_t first = 0; first < state_of(p)->yield_grips; first = end_of_block(p, first)) {
        const size_t begin = (size_t)grips_of(p)[first].block * (size_t)p->floats;
        float own[BLOCK_FLOATS];
        memcpy(own, p->right + begin, (size_t)p->floats * sizeof *own);
        for (int i = 0; i < p->pairs; i++)
            for (size_t j = 0; j < (size_t)p->floats; j++) own[j] -= (float)p->first[i] * p->change[i][begin + j];
        fold(p, first, own);
    }
}

/* D. */
static void weigh(Primal *p)
{
    const YieldGrip *grip = grips_of(p);
    const float *inverse = state_of(p)->inverse.data;
    YieldBody *body = bodies_of(p);
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++)
        for (int r = 0; r < WAYS; r++)
            for (int c = 0; c < WAYS; c++) body[b].factor[r][c] = r == c;
    for (uint32_t g = 0; g < state_of(p)->yield_grips; g++) {
        const Contact *contact = contacts_of(p) + grip[g].contact;
        const float own = inverse[node_of(p, &grip[g]) / W];
        double along[WAYS] = {0};
        if (!contact->active || !(own > 0.0f)) continue;
        for (int k = 0; k < WAYS; k++)
            for (int a = 0; a < 3; a++) along[k] += grip[g].move[k][a] * (double)contact->normal[a];
        for (int r = 0; r < WAYS; r++)
            for (int c = 0; c < WAYS; c++) {
                double both = along[r] * along[c];
                for (int a = 0; a < 3 && carries(contact); a++) both += a == 0 ? grip[g].move[r][a] * grip[g].move[c][a] - both : grip[g].move[r][a] * grip[g].move[c][a];
                body[grip[g].body].factor[r][c] += both / (double)own;
            }
    }
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) cholesky_factor(body[b].factor, WAYS, 1.0);
}

/* What goes along the surfaces, P C W q: its part of what is on the right, and then of the direction. */
static void fold_along(Primal *p)
{
    const YieldGrip *grip = grips_of(p);
    for (uint32_t g = 0; g < state_of(p)->yield_grips; g++)
        if (carries(contacts_of(p) + grip[g].contact)) add_push(&grip[g], p->right + node_of(p, &grip[g]), 1.0, bodies_of(p)[grip[g].body].direction);
}

static void spread_along(Primal *p, uint32_t first, uint32_t end, float *along)
{
    const YieldGrip *grip = grips_of(p);
    memset(along, 0, (size_t)p->floats * sizeof *along);
    for (uint32_t g = first; g < end; g++)
        if (carries(contacts_of(p) + grip[g].contact)) {
            float *v = along + (size_t)contacts_of(p)[grip[g].contact].node * W, moved[3];
            motion_of(&grip[g], bodies_of(p)[grip[g].body].direction, moved);
            for (int a = 0; a < 3; a++) v[a] += moved[a];
        }
    for (int sweep = 0; sweep < SWEEPS; sweep++) sweep_out(p, first, along, NULL);
}

void primal_yield_find_direction(Primal *p)
{
    YieldBody *body = bodies_of(p);
    if (!p->yields) return;
    weigh(p);
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) memcpy(body[b].direction, body[b].right, sizeof body[b].direction);
    fold_along(p);
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) {
        cholesky_forward(body[b].factor, body[b].direction, WAYS);
        cholesky_backward(body[b].factor, body[b].direction, WAYS);
        for (int i = 0; i < p->pairs; i++) p->total[i] += product(body[b].change[i], body[b].direction);
    }
    for (uint32_t first = 0, end; first < state_of(p)->yield_grips; first = end) {
        const size_t begin = (size_t)grips_of(p)[first].block * (size_t)p->floats;
        float along[BLOCK_FLOATS], in[BLOCK_FLOATS] = {0};
        end = end_of_block(p, first);
        spread_along(p, first, end, along);
        for (int sweep = 0; sweep < SWEEPS; sweep++) sweep_in(p, first, in);
        for (size_t j = 0; j < (size_t)p->floats; j++) {
            p->direction[begin + j] += along[j];
            for (int i = 0; i < p->pairs; i++) p->total[i] += (double)p->change[i][begin + j] * (double)(along[j] + in[j]);
        }
    }
}

void primal_yield_add_steps(Primal *p)
{
    YieldBody *body = bodies_of(p);
    if (!p->yields) return;
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) {
        for (int i = 0; i < p->pairs; i++)
            for (int k = 0; k < WAYS; k++) body[b].direction[k] += p->second[i] * body[b].step[i][k];
        p->total[0] += product(body[b].gradient, body[b].direction);
    }
    for (uint32_t first = 0; first < state_of(p)->yield_grips; first = end_of_block(p, first)) {
        const size_t begin = (size_t)grips_of(p)[first].block * (size_t)p->floats;
        float in[BLOCK_FLOATS] = {0};
        for (int sweep = 0; sweep < SWEEPS; sweep++) sweep_in(p, first, in);
        for (size_t j = 0; j < (size_t)p->floats; j++) {
            p->direction[begin + j] += in[j];
            p->total[0] += (double)p->gradient[begin + j] * (double)in[j];
        }
    }
}

/* ---- Steps ---- */

void primal_yield_try(Primal *p)
{
    YieldBody *body = bodies_of(p);
    if (!p->yields) return;
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++)
        for (int k = 0; k < WAYS; k++) body[b].at[k] = body[b].best[k] - (double)p->share * body[b].direction[k];
    move_surfaces(p, false);
}

void primal_yield_return(Primal *p)
{
    YieldBody *body = bodies_of(p);
    if (!p->yields) return;
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) memcpy(body[b].at, body[b].best, sizeof body[b].at);
    move_surfaces(p, true);
}

void primal_yield_close(Primal *p)
{
    YieldBody *body = bodies_of(p);
    const double dt = p->contacts->substep->dt;
    for (uint32_t b = 0; p->yields && b < state_of(p)->yield_bodies; b++) {
        Obstacle *o = body[b].obstacle;
        FreeBody *free = o->body;
        double more[6] = {0};
        for (int k = 0; k < free->ways; k++) {
            const double faster = body[b].best[k] / body[b].unit;
            free->change[k] += faster;
            for (int a = 0; a < 6; a++) more[a] += dt * faster * free->open[k][a];
        }
        for (int a = 0; a < 6; a++) free->pace[a] += more[a];
if (getenv("YDBG")) fprintf(stderr, "yield it %u fail %u aim %g q %g r %g (vel units; mass-scaled) grips %u active %d\n", p->world->record.iterations_used, p->world->record.energy_checks_failed, body[b].aim[1]/body[b].unit, body[b].best[1]/body[b].unit, body[b].right[1]/body[b].unit, state_of(p)->yield_grips, ({int c=0; for (uint32_t g=0; g<state_of(p)->yield_grips; g++) c+=contacts_of(p)[grips_of(p)[g].contact].active; c;}));
        free->met = 1;
        solid_displace(&o->end, free->centre, more);
        obstacle_set_turn(o);
    }
}
