#include "solvers/primal/primal_yield.h"

#include <stdio.h>
#include <stdlib.h>
#include <math.h>
#include <string.h>

#include "base/cholesky.h"
#include "base/result.h"
#include "base/vector.h"
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

/* A translation of bodies and matter that touch: as BodyMove. */
typedef struct YieldHeap {
    bool stays;
    double mass, missing[3];
    int blocked;
    double normal[3][3];
    double way[3], pull[3], stiffness;
} YieldHeap;

typedef struct YieldBody {
    Obstacle *obstacle;
    double unit; /* of q over that of velocities along the ways */
    double way[WAYS][6], whole[WAYS][6]; /* W; the same if walls of the domain held nothing */
    double aim[WAYS];    /* a */
    double at[WAYS], force[WAYS];        /* where the energy was evaluated, and its gradient */
    double best[WAYS], gradient[WAYS];   /* the same where it was accepted */
    double right[WAYS], direction[WAYS]; /* r, and D^-1 r with what pairs add */
    double step[PRIMAL_MEMORY][WAYS], change[PRIMAL_MEMORY][WAYS];
    SmallMatrix factor; /* of D */
    double yields; /* to an impulse of 1 along a contact's normal, there, at most */
    uint32_t heap;  /* another body of its heap, or itself: then `move` is the heap's */
    YieldHeap move;
    bool alone; /* what it touches touches nothing else */
} YieldBody;

/* A body and a piece of matter that it presses, which goes along by the share f: see fit(). */
typedef struct YieldPair {
    int32_t matter;
    uint32_t body;
    double mean, slope[3], middle[3]; /* of f */
    double sum[8], square[3][3];
} YieldPair;

/* What a piece of matter was given by contacts, and those of them that belong to no body. */
typedef struct YieldAccount {
    double missing[3];
    double given, slack; /* sizes added up */
    uint32_t heap;       /* a body of it; UINT32_MAX: it touches none */
} YieldAccount;

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
        for (int a = 0; a < 6; a++) {
            const double scale = a < 3 ? half : half * contacts->cell_size;
            body->way[k][a] = scale * o->body->open[k][a];
            body->whole[k][a] = scale * o->body->way[k][a];
        }
}

static void motion_along(const double way[6], const double arm[3], double out[3])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        out[a] = way[a] + way[3 + b] * arm[c] - way[3 + c] * arm[b];
    }
}

static void list_grip(YieldGrip *grip, YieldBody *body, const Contact *contact, const ContactFrame *contacts)
{
    double point[3], arm[3] = {0};
    memcpy(grip->surface, contact->surface, sizeof grip->surface);
    contacts_node_position(contacts, grip->block, contact->node, point);
    for (int a = 0; a < contacts->grid->dimension; a++) arm[a] = (point[a] - body->obstacle->body->centre[a]) / contacts->cell_size;
    double yields = 0.0;
    for (int k = 0; k < WAYS; k++) {
        double whole[3], along = 0.0;
        motion_along(body->way[k], arm, grip->move[k]);
        motion_along(body->whole[k], arm, whole);
        for (int a = 0; a < 3; a++) along += (double)contact->normal[a] * whole[a];
        yields += along * along;
    }
    body->yields = fmax(body->yields, yields);
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
        !array_reserve(&world->memory, &state->yield_grip, colliders->contacts, sizeof(YieldGrip)) ||
        !array_reserve(&world->memory, &state->yield_pair, colliders->contacts, sizeof(YieldPair)) ||
        !array_reserve(&world->memory, &state->yield_account, (size_t)state->bodies.count, sizeof(YieldAccount)))
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
    array_free(&world->memory, &world->primal.yield_pair);
    array_free(&world->memory, &world->primal.yield_account);
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

/* A contact's part in the next Newton step of a start. */
static void add_stop(const Primal *p, const YieldGrip *grip, YieldBody *body)
{
    static const double HARD = 30.0; /* times what the body weighs at the contact that it yields to most: dozens stop it; and one beside a hinge does not throw it */
    const Contact *contact = contacts_of(p) + grip->contact;
    const float *u = p->node + node_of(p, grip);
    double along[WAYS] = {0}, room = (double)contact->gap;
    for (int a = 0; a < 3; a++) room += (double)contact->normal[a] * ((double)u[a] - (double)grip->surface[a]);
    if (!(body->yields > 0.0)) return;
    for (int k = 0; k < WAYS; k++)
        for (int a = 0; a < 3; a++) along[k] += (double)contact->normal[a] * grip->move[k][a];
    if (!(room < product(along, body->at))) return;
    const double hard = HARD / body->yields;
    for (int r = 0; r < WAYS; r++) {
        body->direction[r] += hard * room * along[r];
        for (int c = 0; c < WAYS; c++) body->factor[r][c] += hard * along[r] * along[c];
    }
}

/* Where matter that goes as it would without obstacles stops a body. What a body presses in before it is solved for strains one layer of nodes alone, and pushes as nothing
 * smooth does. */
void primal_yield_start(Primal *p)
{
    enum { ROUNDS = 6 };
    const YieldGrip *grip = grips_of(p);
    YieldBody *body = bodies_of(p);
    for (int round = 0; round < ROUNDS && p->yields; round++) {
        for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) {
            memcpy(body[b].direction, body[b].aim, sizeof body[b].aim);
            for (int r = 0; r < WAYS; r++)
                for (int c = 0; c < WAYS; c++) body[b].factor[r][c] = r == c;
        }
        for (uint32_t g = 0; g < state_of(p)->yield_grips; g++) add_stop(p, &grip[g], &body[grip[g].body]);
        for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) {
            cholesky_factor(body[b].factor, WAYS, 1.0);
            cholesky_forward(body[b].factor, body[b].direction, WAYS);
            cholesky_backward(body[b].factor, body[b].direction, WAYS);
            memcpy(body[b].at, body[b].direction, sizeof body[b].at);
        }
    }
    if (p->yields) move_surfaces(p, false);
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

/* ---- Matter that goes along ---- */

static int32_t matter_of(const Primal *p, int32_t block) { return ((const int32_t *)state_of(p)->bodies.of_block.data)[block]; }

static YieldPair *pairs_of(const Primal *p) { return state_of(p)->yield_pair.data; }

/* From the rigid body's centre to a block's first node [cells]. */
static void place_block(const Primal *p, const YieldPair *pair, int32_t block, double corner[3])
{
    double point[3];
    contacts_node_position(p->contacts, block, 0, point);
    for (int a = 0; a < 3; a++) corner[a] = a < p->world->grid.dimension ? (point[a] - bodies_of(p)[pair->body].obstacle->body->centre[a]) / p->contacts->cell_size : 0.0;
}

/* Pairs of bodies and of what they press. */
static void find_pairs(Primal *p)
{
    PrimalState *state = state_of(p);
    const YieldGrip *grip = grips_of(p);
    YieldPair *pair = pairs_of(p);
    state->yield_pairs = 0;
    for (uint32_t g = 0; g < state->yield_grips; g++) {
        const int32_t matter = matter_of(p, grip[g].block);
        uint32_t i = 0;
        if (!contacts_of(p)[grip[g].contact].active) continue;
        while (i < state->yield_pairs && !(pair[i].matter == matter && pair[i].body == grip[g].body)) i++;
        if (i == state->yield_pairs) pair[state->yield_pairs++] = (YieldPair){.matter = matter, .body = grip[g].body};
    }
}

static void add_place(const Primal *p, YieldPair *pair, int32_t block, const Contact *contact)
{
    const Obstacle *o = bodies_of(p)[pair->body].obstacle;
    const double along = o - p->contacts->colliders->obstacle == contact->obstacle;
    double x[3];
    place_block(p, pair, block, x);
    primal_arm(x, contact->node, x);
    pair->sum[0] += 1.0;
    pair->sum[1] += along;
    for (int a = 0; a < 3; a++) {
        pair->sum[2 + a] += x[a];
        pair->sum[5 + a] += along * x[a];
        for (int b = 0; b < 3; b++) pair->square[a][b] += x[a] * x[b];
    }
}

/* f = mean + slope.(x - middle), the best fit to 1 at the body's active contacts and 0 at those with others. */
static void fit(YieldPair *pair)
{
    static const double RIDGE = 1e-3; /* of the mean square: contacts in a line or plane say nothing of what is across */
    const double n = pair->sum[0];
    SmallMatrix m;
    double trace = 0.0;
    pair->mean = pair->sum[1] / n;
    for (int a = 0; a < 3; a++) {
        pair->middle[a] = pair->sum[2 + a] / n;
        pair->slope[a] = pair->sum[5 + a] / n - pair->mean * pair->middle[a];
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) m[a][b] = pair->square[a][b] / n - pair->middle[a] * pair->middle[b];
    for (int a = 0; a < 3; a++) trace += m[a][a];
    for (int a = 0; a < 3; a++) m[a][a] += RIDGE * (trace + 1.0);
    cholesky_factor(m, 3, 1e-12);
    cholesky_forward(m, pair->slope, 3);
    cholesky_backward(m, pair->slope, 3);
}

static void fit_pairs(Primal *p)
{
    const uint32_t *begin = p->contacts->colliders->contact_begin.data;
    YieldPair *pair = pairs_of(p);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++)
        for (uint32_t k = 0; k < state_of(p)->yield_pairs; k++)
            for (uint32_t i = begin[block]; i < begin[block + 1] && pair[k].matter == matter_of(p, block); i++)
                if (contacts_of(p)[i].active) add_place(p, &pair[k], block, contacts_of(p) + i);
    for (uint32_t k = 0; k < state_of(p)->yield_pairs; k++) fit(&pair[k]);
}

static double share_at(const YieldPair *pair, const double x[3])
{
    double share = pair->mean;
    for (int a = 0; a < 3; a++) share += pair->slope[a] * (x[a] - pair->middle[a]);
    return fmin(1.0, fmax(0.0, share));
}

/* W' (sum C' C) W, from the sums of weights, of weights times places and of their products. */
static void add_moments(const double sum[10], YieldBody *body)
{
    double m[6][6] = {{0}};
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        m[a][a] = sum[0];
        m[a][3 + b] = m[3 + b][a] = sum[1 + c]; /* w x x */
        m[a][3 + c] = m[3 + c][a] = -sum[1 + b];
        m[3 + a][3 + a] = sum[4 + b] + sum[4 + c];
        m[3 + b][3 + c] = m[3 + c][3 + b] = -sum[7 + a];
    }
    for (int r = 0; r < WAYS; r++)
        for (int c = 0; c < WAYS; c++)
            for (int i = 0; i < 6; i++)
                for (int j = 0; j < 6; j++) body->factor[r][c] += body->way[r][i] * m[i][j] * body->way[c][j];
}

static void add_moment(double weight, const double x[3], double sum[10])
{
    sum[0] += weight;
    for (int a = 0; a < 3; a++) {
        sum[1 + a] += weight * x[a];
        sum[4 + a] += weight * x[a] * x[a];
        sum[7 + a] += weight * x[(a + 1) % 3] * x[(a + 2) % 3];
    }
}

/* What it costs: see the header. */
static void weigh_pair(Primal *p, const YieldPair *pair, YieldBody *body)
{
    const float *inverse = state_of(p)->inverse.data;
    double steep = 0.0, sum[10] = {0};
    for (int a = 0; a < 3; a++) steep += pair->slope[a] * pair->slope[a] / 6.0;
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        double corner[3], x[3];
        if (matter_of(p, block) != pair->matter) continue;
        place_block(p, pair, block, corner);
        for (size_t i = 0; i < (size_t)p->floats / W; i++) {
            const size_t node = (size_t)block * (size_t)p->floats / W + i;
            const double mass = (double)p->base[node * W + 3];
            if (!(inverse[node] > 0.0f)) continue;
            primal_arm(corner, i, x);
            const double share = share_at(pair, x), weight = mass * share * share + (1.0 / (double)inverse[node] - mass) * steep;
            add_moment(weight, x, sum);
        }
    }
    add_moments(sum, body);
}

/* D. */
static void weigh(Primal *p)
{
    YieldBody *body = bodies_of(p);
    find_pairs(p);
    fit_pairs(p);
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++)
        for (int r = 0; r < WAYS; r++)
            for (int c = 0; c < WAYS; c++) body[b].factor[r][c] = r == c;
    for (uint32_t k = 0; k < state_of(p)->yield_pairs; k++) weigh_pair(p, &pairs_of(p)[k], &body[pairs_of(p)[k].body]);
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) cholesky_factor(body[b].factor, WAYS, 1.0);
}

/* Its part of what is on the right, and then of the direction. */
static void fold_along(Primal *p)
{
    for (uint32_t k = 0; k < state_of(p)->yield_pairs; k++) {
        const YieldPair *pair = &pairs_of(p)[k];
        YieldBody *body = &bodies_of(p)[pair->body];
        double sum[6] = {0}, corner[3], x[3];
        for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
            const float *right = p->right + (size_t)block * (size_t)p->floats;
            if (matter_of(p, block) != pair->matter) continue;
            place_block(p, pair, block, corner);
            for (size_t i = 0; i < (size_t)p->floats / W; i++, right += W) {
                primal_arm(corner, i, x);
                const double share = share_at(pair, x);
                for (int a = 0; a < 3; a++) {
                    const int b = (a + 1) % 3, c = (a + 2) % 3;
                    sum[a] += share * (double)right[a];
                    sum[3 + a] += share * (x[b] * (double)right[c] - x[c] * (double)right[b]);
                }
            }
        }
        for (int w = 0; w < WAYS; w++)
            for (int a = 0; a < 6; a++) body->direction[w] += body->way[w][a] * sum[a];
    }
}

/* Adds it to a block's vector. */
static void spread_along(const Primal *p, int32_t block, float *along)
{
    for (uint32_t k = 0; k < state_of(p)->yield_pairs; k++) {
        const YieldPair *pair = &pairs_of(p)[k];
        const YieldBody *body = &bodies_of(p)[pair->body];
        double motion[6] = {0}, corner[3], x[3];
        if (matter_of(p, block) != pair->matter) continue;
        for (int w = 0; w < WAYS; w++)
            for (int a = 0; a < 6; a++) motion[a] += body->way[w][a] * body->direction[w];
        place_block(p, pair, block, corner);
        for (size_t i = 0; i < (size_t)p->floats / W; i++) {
            if (!(p->base[(size_t)block * (size_t)p->floats + i * W + 3] > 0.0f)) continue;
            primal_arm(corner, i, x);
            const double share = share_at(pair, x);
            for (int a = 0; a < 3; a++) {
                const int b = (a + 1) % 3, c = (a + 2) % 3;
                along[i * W + (size_t)a] += (float)(share * (motion[a] + motion[3 + b] * x[c] - motion[3 + c] * x[b]));
            }
        }
    }
}

static bool has_pair(const Primal *p, int32_t block)
{
    for (uint32_t k = 0; k < state_of(p)->yield_pairs; k++)
        if (pairs_of(p)[k].matter == matter_of(p, block)) return true;
    return false;
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
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        const size_t begin = (size_t)block * (size_t)p->floats;
        float along[BLOCK_FLOATS] = {0};
        if (!has_pair(p, block)) continue;
        spread_along(p, block, along);
        constraints_remove_from(p->contacts, along, block);
        for (size_t j = 0; j < (size_t)p->floats; j++) {
            p->direction[begin + j] += along[j];
            for (int i = 0; i < p->pairs; i++) p->total[i] += (double)p->change[i][begin + j] * (double)along[j];
        }
    }
    for (uint32_t first = 0; first < state_of(p)->yield_grips; first = end_of_block(p, first)) {
        const size_t begin = (size_t)grips_of(p)[first].block * (size_t)p->floats;
        float in[BLOCK_FLOATS] = {0};
        for (int sweep = 0; sweep < SWEEPS; sweep++) sweep_in(p, first, in);
        for (size_t j = 0; j < (size_t)p->floats; j++)
            for (int i = 0; i < p->pairs; i++) p->total[i] += (double)p->change[i][begin + j] * (double)in[j];
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
    if (getenv("YDBG2")) fprintf(stderr, "  try share %g energy %g best %g direction %g right %g D %g pairs %d sb %g sa %g te %g\n", p->share, p->energy, body[0].best[0], body[0].direction[0], body[0].right[0], body[0].factor[0][0], p->pairs, p->slope_before, p->slope_after, p->trial_energy);
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

/* ---- Momentum ---- */

/* Whether a piece of matter touches anything but this body. */
static bool touches_others(const Primal *p, int32_t matter, uint32_t body)
{
    const int obstacle = (int)(bodies_of(p)[body].obstacle - p->contacts->colliders->obstacle);
    const uint32_t *begin = p->contacts->colliders->contact_begin.data;
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++)
        for (uint32_t i = begin[block]; i < begin[block + 1] && matter_of(p, block) == matter; i++)
            if (contacts_of(p)[i].active && contacts_of(p)[i].obstacle != obstacle) return true;
    return false;
}

static void sum_together(Primal *p, const YieldPair *pair, YieldBody *body)
{
    double moments[10] = {0}, sum[6] = {0}, corner[3], x[3], lost[3];
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        if (matter_of(p, block) != pair->matter) continue;
        place_block(p, pair, block, corner);
        for (size_t i = 0; i < (size_t)p->floats / W; i++) {
            const size_t node = (size_t)block * (size_t)p->floats + i * W;
            const double mass = (double)p->base[node + 3];
            primal_arm(corner, i, x);
            add_moment(mass, x, moments);
            for (size_t a = 0; a < 3; a++) lost[a] = mass * ((double)p->base[node + a] - (double)p->best[node + a]);
            for (int a = 0; a < 3; a++) {
                const int b = (a + 1) % 3, c = (a + 2) % 3;
                sum[a] += lost[a];
                sum[3 + a] += x[b] * lost[c] - x[c] * lost[b];
            }
        }
    }
    add_moments(moments, body);
    for (int k = 0; k < WAYS; k++)
        for (int a = 0; a < 6; a++) body->direction[k] += body->way[k][a] * sum[a];
}

static void move_together(Primal *p, const YieldPair *pair, const YieldBody *body)
{
    double motion[6] = {0}, corner[3], x[3];
    for (int k = 0; k < WAYS; k++)
        for (int a = 0; a < 6; a++) motion[a] += body->way[k][a] * body->direction[k];
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        if (matter_of(p, block) != pair->matter) continue;
        place_block(p, pair, block, corner);
        for (size_t i = 0; i < (size_t)p->floats / W; i++) {
            float *u = p->best + (size_t)block * (size_t)p->floats + i * W;
            if (!(p->base[(size_t)block * (size_t)p->floats + i * W + 3] > 0.0f)) continue;
            primal_arm(corner, i, x);
            for (int a = 0; a < 3; a++) {
                const int b = (a + 1) % 3, c = (a + 2) % 3;
                u[a] += (float)(motion[a] + motion[3 + b] * x[c] - motion[3 + c] * x[b]);
            }
        }
    }
}

/* A body and all that it touches, where that touches nothing else, go on together, without strain: what they push each other with cancels out. So the energy is least where
 *
 *     q - a + W' sum over all nodes C' m (u - u*) = 0,
 *
 * which is their momentum along the body's ways. An unfinished solution gets there by q += d, u += C W d. */
static void keep_alone(Primal *p)
{
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) {
        YieldBody *body = &bodies_of(p)[b];
        uint32_t mine = 0;
        body->alone = true;
        for (uint32_t k = 0; k < state_of(p)->yield_pairs; k++) {
            if (pairs_of(p)[k].body != b) continue;
            mine++;
            body->alone = body->alone && !touches_others(p, pairs_of(p)[k].matter, b);
        }
        if (!body->alone || mine == 0) continue;
        for (int r = 0; r < WAYS; r++) {
            body->direction[r] = body->aim[r] - body->best[r];
            for (int c = 0; c < WAYS; c++) body->factor[r][c] = r == c;
        }
        for (uint32_t k = 0; k < state_of(p)->yield_pairs; k++)
            if (pairs_of(p)[k].body == b) sum_together(p, &pairs_of(p)[k], body);
        cholesky_factor(body->factor, WAYS, 1.0);
        cholesky_forward(body->factor, body->direction, WAYS);
        cholesky_backward(body->factor, body->direction, WAYS);
        for (uint32_t k = 0; k < state_of(p)->yield_pairs; k++)
            if (pairs_of(p)[k].body == b) move_together(p, &pairs_of(p)[k], body);
        for (int k = 0; k < WAYS; k++) body->best[k] += body->direction[k];
    }
}

/* ---- Heaps: bodies and matter that touch ---- */

/* All of a heap goes along what obstacles outside of it leave open: what its members push each other with cancels out. */
static uint32_t heap_of(const Primal *p, uint32_t body)
{
    const YieldBody *bodies = bodies_of(p);
    while (bodies[body].heap != body) body = bodies[body].heap;
    return body;
}

static YieldAccount *account_of(const Primal *p, int32_t block) { return (YieldAccount *)state_of(p)->yield_account.data + matter_of(p, block); }

/* Whether the domain and its joints leave it free to go anywhere: its first ways are the axes then. */
static bool goes_anywhere(const Primal *p, const YieldBody *body)
{
    for (int k = 0; k < p->world->def.dimension; k++)
        for (int a = 0; a < 6; a++)
            if (body->way[k][a] != body->whole[k][a] || (a == k) != (body->whole[k][a] != 0.0)) return false;
    return body->obstacle->body->ways >= p->world->def.dimension;
}

static void find_heaps(Primal *p)
{
    YieldBody *bodies = bodies_of(p);
    const YieldPair *pair = pairs_of(p);
    YieldAccount *account = state_of(p)->yield_account.data;
    for (int32_t i = 0; i < state_of(p)->bodies.count; i++) account[i].heap = UINT32_MAX;
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) bodies[b].heap = b;
    for (uint32_t k = 0; k < state_of(p)->yield_pairs; k++) {
        YieldAccount *of = &account[pair[k].matter];
        const uint32_t mine = heap_of(p, pair[k].body);
        if (of->heap == UINT32_MAX) of->heap = mine;
        const uint32_t other = heap_of(p, of->heap);
        bodies[mine > other ? mine : other].heap = mine > other ? other : mine;
    }
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) bodies[b].move = (YieldHeap){.stays = false};
}

static void block_normal(YieldHeap *heap, const float *normal)
{
    double n[3] = {(double)normal[0], (double)normal[1], (double)normal[2]};
    for (int k = 0; k < heap->blocked; k++) {
        const double part = dot3(heap->normal[k], n);
        for (int a = 0; a < 3; a++) n[a] -= part * heap->normal[k][a];
    }
    const double length = sqrt(dot3(n, n));
    if (length < 1e-3 || heap->blocked == 3) return;
    for (int a = 0; a < 3; a++) heap->normal[heap->blocked][a] = n[a] / length;
    heap->blocked++;
}

static void weigh_heaps(Primal *p)
{
    YieldBody *bodies = bodies_of(p);
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) {
        YieldHeap *heap = &bodies[heap_of(p, b)].move;
        if (!goes_anywhere(p, &bodies[b])) heap->stays = true;
        for (int k = 0; k < p->world->def.dimension && !heap->stays; k++) {
            const double inverse = 1.0 / bodies[b].way[k][k];
            if (k == 0) heap->mass += inverse * inverse;
            heap->missing[k] += (bodies[b].aim[k] - bodies[b].best[k]) * inverse;
        }
    }
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        const uint32_t of = account_of(p, block)->heap;
        if (of == UINT32_MAX) continue;
        YieldHeap *heap = &bodies[heap_of(p, of)].move;
        for (size_t i = (size_t)block * (size_t)p->floats, end = i + (size_t)p->floats; i < end; i += W) {
            heap->mass += (double)p->base[i + 3];
            for (size_t a = 0; a < 3; a++) heap->missing[a] += (double)p->base[i + 3] * ((double)p->base[i + a] - (double)p->best[i + a]);
        }
    }
}

/* Calls for each contact of a heap with what is outside of it. */
typedef void HeapContact(const Primal *p, const Contact *contact, const float *u, YieldHeap *heap);

static void over_outside(Primal *p, HeapContact *visit)
{
    const uint32_t *begin = p->contacts->colliders->contact_begin.data;
    uint32_t g = 0;
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++)
        for (uint32_t i = begin[block]; i < begin[block + 1]; i++) {
            const Contact *contact = contacts_of(p) + i;
            const uint32_t of = account_of(p, block)->heap;
            const bool grips = g < state_of(p)->yield_grips && grips_of(p)[g].contact == i;
            if (grips) g++;
            if (of == UINT32_MAX || (grips && heap_of(p, grips_of(p)[g - 1].body) == heap_of(p, of))) continue;
            visit(p, contact, p->best + (size_t)block * (size_t)p->floats + (size_t)contact->node * W, &bodies_of(p)[heap_of(p, of)].move);
        }
}

static void block_contact(const Primal *p, const Contact *contact, const float *u, YieldHeap *heap)
{
    (void)p;
    const double longest = sqrt(dot3(heap->missing, heap->missing)) / fmax(heap->mass, 1e-30);
    if (!contact->active && (double)constraints_room(contact, u) > longest) return;
    if (constraints_stick(contact)) heap->stays = true;
    else block_normal(heap, contact->normal);
}

static void rub_contact(const Primal *p, const Contact *contact, const float *u, YieldHeap *heap)
{
    float moved[3], rub[3];
    for (int a = 0; a < 3; a++) moved[a] = u[a] + (float)heap->way[a];
    if (!constraints_rub(contact, moved, p->slip_min, rub)) return;
    for (int a = 0; a < 3; a++) heap->pull[a] -= (double)rub[a];
    heap->stiffness += (double)constraints_friction_stiffness(contact, moved, p->slip_min);
}

static void keep_heaps(Primal *p)
{
    enum { STEPS = 3 }; /* as primal_keep_momentum() */
    YieldBody *bodies = bodies_of(p);
    find_heaps(p);
    weigh_heaps(p);
    over_outside(p, block_contact);
    for (int step = 0; step < STEPS; step++) {
        for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) {
            YieldHeap *heap = &bodies[b].move;
            for (int a = 0; a < 3; a++) heap->pull[a] = heap->missing[a] - heap->mass * heap->way[a];
            heap->stiffness = heap->mass;
        }
        over_outside(p, rub_contact);
        for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) {
            YieldHeap *heap = &bodies[b].move;
            for (int k = 0; k < heap->blocked; k++) {
                const double part = dot3(heap->normal[k], heap->pull);
                for (int a = 0; a < 3; a++) heap->pull[a] -= part * heap->normal[k][a];
            }
            for (int a = 0; a < 3 && heap->stiffness > 0.0 && !heap->stays; a++) heap->way[a] += heap->pull[a] / heap->stiffness;
        }
    }
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        const uint32_t of = account_of(p, block)->heap;
        if (of == UINT32_MAX) continue;
        const YieldHeap *heap = &bodies[heap_of(p, of)].move;
        for (size_t i = (size_t)block * (size_t)p->floats, end = i + (size_t)p->floats; i < end && !heap->stays; i += W)
            for (size_t a = 0; a < 3 && p->base[i + 3] > 0.0f; a++) p->best[i + a] += (float)heap->way[a];
    }
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) {
        const YieldHeap *heap = &bodies[heap_of(p, b)].move;
        for (int k = 0; k < p->world->def.dimension && !heap->stays; k++) bodies[b].best[k] += heap->way[k] / bodies[b].way[k][k];
    }
    move_surfaces(p, true);
}

void primal_yield_keep_momentum(Primal *p)
{
    if (!p->yields) return;
    find_pairs(p);
    keep_heaps(p);
    keep_alone(p);
    move_surfaces(p, true);
}

/* ---- Impulses ---- */

static double size_of(const double v[3]) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

static void open_accounts(const Primal *p, const float *after, YieldAccount *account)
{
    const uint32_t *begin = p->contacts->colliders->contact_begin.data;
    const double *booked = p->contacts->colliders->impulses.contact.data;
    uint32_t g = 0;
    memset(account, 0, (size_t)state_of(p)->bodies.count * sizeof *account);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        YieldAccount *of = &account[matter_of(p, block)];
        for (size_t i = (size_t)block * (size_t)p->floats, end = i + (size_t)p->floats; i < end; i += W)
            for (size_t a = 0; a < 3; a++) of->missing[a] += (double)p->base[i + 3] * ((double)after[i + a] - (double)p->base[i + a]);
        for (uint32_t i = begin[block]; i < begin[block + 1]; i++) {
            const bool grips = g < state_of(p)->yield_grips && grips_of(p)[g].contact == i;
            for (int a = 0; a < 3; a++) of->missing[a] -= booked[3 * i + (uint32_t)a];
            of->given += size_of(booked + 3 * i);
            if (grips) g++;
            else of->slack += size_of(booked + 3 * i);
        }
    }
}

/* Contacts share what is missing: those of obstacles that yield to nothing, where there are any. */
static void share_missing(const Primal *p, const YieldAccount *account, bool with_slack)
{
    const uint32_t *begin = p->contacts->colliders->contact_begin.data;
    double *booked = p->contacts->colliders->impulses.contact.data;
    uint32_t g = 0;
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        const YieldAccount *of = &account[matter_of(p, block)];
        for (uint32_t i = begin[block]; i < begin[block + 1]; i++) {
            const bool grips = g < state_of(p)->yield_grips && grips_of(p)[g].contact == i;
            if (grips) g++;
            const double sum = with_slack ? of->slack : of->given;
            if (with_slack != (of->slack > 0.0) || (with_slack && grips) || !(sum > 0.0)) continue;
            const double share = size_of(booked + 3 * i) / sum;
            for (int a = 0; a < 3; a++) booked[3 * i + (uint32_t)a] += share * of->missing[a];
        }
    }
}

/* Whether a grip's share of what a body was given may change: what others of the same matter take then. */
static bool may_settle(const Primal *p, const YieldGrip *grip, uint32_t index, const YieldAccount *account)
{
    if (grip->body != index || !contacts_of(p)[grip->contact].active) return false;
    return bodies_of(p)[index].alone || account[matter_of(p, grip->block)].slack > 0.0;
}

/* A body was given what it went for: q - a. Of what is alone with it only the moment may be another. */
static void settle_body(const Primal *p, uint32_t index, const YieldAccount *account)
{
    const YieldGrip *grip = grips_of(p);
    static const double RIDGE = 1e-9; /* ways that change nothing of it get nothing */
    const YieldBody *body = &bodies_of(p)[index];
    double *booked = p->contacts->colliders->impulses.contact.data, owed[WAYS], mean[WAYS][3] = {{0}}, trace = 0.0, count = 0.0;
    SmallMatrix m;
    memset(m, 0, sizeof m);
    for (int k = 0; k < WAYS; k++) owed[k] = body->best[k] - body->aim[k];
    for (uint32_t g = 0; g < state_of(p)->yield_grips; g++) {
        if (grip[g].body != index) continue;
        for (int r = 0; r < WAYS; r++)
            for (int a = 0; a < 3; a++) owed[r] += grip[g].move[r][a] * booked[3 * (size_t)grip[g].contact + (size_t)a];
        if (!may_settle(p, &grip[g], index, account)) continue;
        count += 1.0;
        for (int r = 0; r < WAYS; r++)
            for (int a = 0; a < 3; a++) mean[r][a] += grip[g].move[r][a];
    }
    for (int r = 0; r < WAYS && count > 0.0; r++)
        for (int a = 0; a < 3; a++) mean[r][a] = body->alone ? mean[r][a] / count : 0.0;
    for (uint32_t g = 0; g < state_of(p)->yield_grips; g++)
        for (int r = 0; r < WAYS && may_settle(p, &grip[g], index, account); r++)
            for (int a = 0; a < 3; a++) {
                trace += grip[g].move[r][a] * grip[g].move[r][a];
                for (int c = 0; c < WAYS; c++) m[r][c] += (grip[g].move[r][a] - mean[r][a]) * (grip[g].move[c][a] - mean[c][a]);
            }
    if (!(trace > 0.0)) return;
    for (int k = 0; k < WAYS; k++) m[k][k] += RIDGE * trace;
    cholesky_factor(m, WAYS, RIDGE * trace);
    cholesky_forward(m, owed, WAYS);
    cholesky_backward(m, owed, WAYS);
    for (uint32_t g = 0; g < state_of(p)->yield_grips; g++)
        for (int k = 0; k < WAYS && may_settle(p, &grip[g], index, account); k++)
            for (int a = 0; a < 3; a++) booked[3 * (size_t)grip[g].contact + (size_t)a] -= owed[k] * (grip[g].move[k][a] - mean[k][a]);
}

void primal_yield_book(Primal *p, const float *after)
{
    YieldAccount *account = state_of(p)->yield_account.data;
    constraints_book_contacts(p->contacts, p->gradient, p->best, p->slip_min);
    open_accounts(p, after, account);
    share_missing(p, account, false);
    for (uint32_t b = 0; b < state_of(p)->yield_bodies; b++) settle_body(p, b, account);
    open_accounts(p, after, account);
    share_missing(p, account, true);
}

bool primal_yield_presses(const Primal *p, int32_t matter)
{
    for (uint32_t g = 0; p->yields && g < state_of(p)->yield_grips; g++)
        if (contacts_of(p)[grips_of(p)[g].contact].active && matter_of(p, grips_of(p)[g].block) == matter) return true;
    return false;
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
if (getenv("YDBG")) {
            const int K = atoi(getenv("YDBG"));
            double s[WAYS] = {0};
            int c = 0;
            for (uint32_t g = 0; g < state_of(p)->yield_grips; g++) c += contacts_of(p)[grips_of(p)[g].contact].active && grips_of(p)[g].body == b;
            for (uint32_t g = 0; g < state_of(p)->yield_grips; g++)
                for (int a = 0; a < 3 && grips_of(p)[g].body == b; a++) s[K] -= grips_of(p)[g].move[K][a] * ((double *)p->contacts->colliders->impulses.contact.data)[3 * grips_of(p)[g].contact + (unsigned)a];
            fprintf(stderr, "[%u] booked %g of %g it %u fail %u aim %g q %g r %g grips %u active %d alone %d pairs %u\n", b, s[K] / body[b].unit, (body[b].best[K] - body[b].aim[K]) / body[b].unit, p->world->record.iterations_used,
                    p->world->record.energy_checks_failed, body[b].aim[K] / body[b].unit, body[b].best[K] / body[b].unit, body[b].right[K] / body[b].unit, state_of(p)->yield_grips, c, body[b].alone, state_of(p)->yield_pairs);
        }
        free->met = 1;
        solid_displace(&o->end, free->centre, more);
        obstacle_set_turn(o);
    }
}
