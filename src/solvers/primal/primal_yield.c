#include "solvers/primal/primal_yield.h"

#include <math.h>
#include <string.h>

#include "base/result.h"
#include "contact/contact_constraints.h"
#include "solvers/passes.h"
#include "solvers/primal/primal_yield_bodies.h"

enum { SWEEPS = 2 }; /* as constraints_remove() */

static size_t node_of(const Primal *p, const YieldGrip *grip)
{
    return (size_t)grip->block * (size_t)p->floats + (size_t)yield_contacts(p)[grip->contact].node * W;
}

static double product(const double a[WAYS], const double b[WAYS])
{
    double sum = 0.0;
    for (int k = 0; k < WAYS; k++) sum += a[k] * b[k];
    return sum;
}

/* ---- Listing ---- */

static bool may_yield(const Obstacle *o) { return o->body && o->body->yields; }

/* For the units see wall_bodies_list(). */
static void list_body(YieldBody *body, Obstacle *o, const ContactFrame *contacts)
{
    const double half = pow(contacts->cell_size, 0.5 * contacts->grid->dimension);
    *body = (YieldBody){.obstacle = o, .unit = contacts->substep->dt / (half * contacts->cell_size)};
    for (int k = 0; k < o->body->ways; k++)
        for (int a = 0; a < 6; a++) {
            const double scale = a < 3 ? half : half * contacts->cell_size;
            body->way[k][a] = scale * o->body->open[k][a];
            body->whole[k][a] = scale * o->body->way[k][a];
        }
}

static void list_grip(YieldGrip *grip, YieldBody *body, const Contact *contact, const ContactFrame *contacts)
{
    double arm[3], whole[3], yields = 0.0;
    memcpy(grip->surface, contact->surface, sizeof grip->surface);
    contacts_node_position(contacts, grip->block, contact->node, arm);
    for (int a = 0; a < 3; a++) arm[a] = a < contacts->grid->dimension ? (arm[a] - body->obstacle->body->begins[a]) / contacts->cell_size : 0.0;
    for (int k = 0; k < WAYS; k++) {
        double along = 0.0;
        yield_motion_at(body->way[k], arm, grip->move[k]);
        yield_motion_at(body->whole[k], arm, whole);
        for (int a = 0; a < 3; a++) along += (double)contact->normal[a] * whole[a];
        yields += along * along;
    }
    body->yields = fmax(body->yields, yields);
}

static void list_grips(YieldList *list, const ContactFrame *contacts, const uint32_t *body_of)
{
    const Contact *contact = contacts->colliders->contact.data;
    const uint32_t *begin = contacts->colliders->contact_begin.data;
    const Obstacle *obstacle = contacts->colliders->obstacle;
    for (int32_t block = 0; block < contacts->grid->node_blocks; block++)
        for (uint32_t i = begin[block]; i < begin[block + 1]; i++) {
            const uint16_t o = contact[i].obstacle;
            if (o >= contacts->colliders->obstacle_count || !may_yield(&obstacle[o])) continue;
            YieldGrip *next = &list->grip[list->grips++];
            *next = (YieldGrip){.block = block, .contact = i, .body = body_of[o]};
            list_grip(next, &list->body[next->body], &contact[i], contacts);
        }
}

/* Their memory is the scratch of walls, which nobody finds here. */
static YieldList *make_room(World *world, size_t contacts, size_t bodies)
{
    const size_t matter = (size_t)world->grid.bodies, each = sizeof(YieldGrip) + sizeof(YieldPair);
    if (!array_reserve(&world->memory, &world->walls.scratch, sizeof(YieldList) + bodies * sizeof(YieldBody) + contacts * each + matter * sizeof(YieldAccount), 1)) return NULL;
    YieldList *list = world->walls.scratch.data;
    *list = (YieldList){.body = (YieldBody *)(list + 1)};
    list->grip = (YieldGrip *)(list->body + bodies);
    list->pair = (YieldPair *)(list->grip + contacts);
    list->account = (YieldAccount *)(list->pair + contacts);
    return list;
}

pbmpm_result primal_yield_list(World *world, const ContactFrame *contacts)
{
    Colliders *colliders = contacts->colliders;
    uint32_t body_of[PBMPM_MAX_COLLIDERS + DOMAIN_WALLS + 1], bodies = 0;
    world->primal.yield_grips = 0;
    if (world->record.solver != PBMPM_SOLVER_PRIMAL || solver_holds_liquid(world) || solver_holds_sand(world) || colliders->contacts == 0) return PBMPM_OK;
    for (int i = 0; i < colliders->obstacle_count; i++)
        if (may_yield(&colliders->obstacle[i])) body_of[i] = bodies++;
    if (bodies == 0) return PBMPM_OK;
    YieldList *list = make_room(world, colliders->contacts, bodies);
    if (!list) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for %u rigid bodies on solids", bodies);
    list->bodies = bodies;
    for (int i = 0; i < colliders->obstacle_count; i++)
        if (may_yield(&colliders->obstacle[i])) list_body(&list->body[body_of[i]], &colliders->obstacle[i], contacts);
    list_grips(list, contacts, body_of);
    world->primal.yield_grips = list->grips;
    return PBMPM_OK;
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
    const YieldGrip *grip = yield_grips(p);
    uint32_t end = first;
    while (end < yield_list(p)->grips && grip[end].block == grip[first].block) end++;
    return end;
}

/* What a sweep does at a contact: `grip` is null where no body is. */
typedef void SweptContact(const Primal *p, const Contact *contact, const YieldGrip *grip, float *v);

/* It takes its part out of the vector; grips add theirs to the bodies' right side. */
static void take_part(const Primal *p, const Contact *contact, const YieldGrip *grip, float *v)
{
    float out[3];
    memcpy(out, v, sizeof out);
    constraints_take_out(contact, v);
    for (int a = 0; a < 3; a++) out[a] -= v[a];
    if (grip) add_push(grip, out, 1.0, yield_bodies(p)[grip->body].right);
}

/* It gives its part what the body's motion has: (1 - P) C W q. */
static void give_part(const Primal *p, const Contact *contact, const YieldGrip *grip, float *v)
{
    float moved[3] = {0}, along[3];
    if (grip) motion_of(grip, yield_bodies(p)[grip->body].direction, moved);
    memcpy(along, moved, sizeof along);
    constraints_take_out(contact, v);
    constraints_take_out(contact, along);
    for (int a = 0; a < 3; a++) v[a] += moved[a] - along[a];
}

/* Over the active contacts of the block of `first`. */
static void sweep(const Primal *p, uint32_t first, float *vector, SweptContact *visit)
{
    const YieldGrip *grip = yield_grips(p);
    const int32_t block = grip[first].block;
    for (int turn = 0; turn < SWEEPS; turn++) {
        uint32_t g = first;
        for (uint32_t i = yield_first(p, block); i < yield_end(p, block); i++) {
            const bool grips = yield_takes(p, i, &g);
            const Contact *contact = yield_contacts(p) + i;
            if (contact->active) visit(p, contact, grips ? &grip[g - 1] : NULL, vector + (size_t)contact->node * W);
        }
    }
}

/* W' sum C' (1 - P) v, to the bodies' right side. Uses up the vector. */
static void fold(const Primal *p, uint32_t first, float *vector) { sweep(p, first, vector, take_part); }

/* (1 - P) C W q of the bodies' directions, in one block. */
static void unfold(const Primal *p, uint32_t first, float vector[BLOCK_FLOATS])
{
    memset(vector, 0, BLOCK_FLOATS * sizeof *vector);
    sweep(p, first, vector, give_part);
}

/* ---- Energy ---- */

static void move_surfaces(Primal *p, bool to_best)
{
    const YieldGrip *grip = yield_grips(p);
    for (uint32_t g = 0; g < yield_list(p)->grips; g++) {
        const YieldBody *body = &yield_bodies(p)[grip[g].body];
        float moved[3];
        motion_of(&grip[g], to_best ? body->best : body->at, moved);
        for (int a = 0; a < 3; a++) yield_contacts(p)[grip[g].contact].surface[a] = grip[g].surface[a] + moved[a];
    }
}

void yield_move_to_best(Primal *p) { move_surfaces(p, true); }

/* Takes W' sum C' f at the displacements u from the bodies' gradients, the accepted ones or not. */
static void take_friction(Primal *p, const float *u, bool accepted)
{
    const YieldGrip *grip = yield_grips(p);
    for (uint32_t g = 0; g < yield_list(p)->grips; g++) {
        YieldBody *body = &yield_bodies(p)[grip[g].body];
        float rub[3];
        if (!constraints_rub(yield_contacts(p) + grip[g].contact, u + node_of(p, &grip[g]), p->slip_min, rub)) continue;
        add_push(&grip[g], rub, -1.0, accepted ? body->gradient : body->force);
    }
}

/* a: see the header. */
static void find_aim(const Primal *p, YieldBody *body)
{
    const Obstacle *o = body->obstacle;
    const FreeBody *free = o->body;
    const pbmpm_impulse given = impulse_about(&p->contacts->colliders->impulses.sum[o->place], free->begins, p->world->def.dimension);
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
    p->yields = !p->joint && p->world->primal.yield_grips > 0;
    for (uint32_t b = 0; p->yields && b < yield_list(p)->bodies; b++) find_aim(p, &yield_bodies(p)[b]);
}

Search *primal_yield_join(const Primal *p)
{
    const YieldGrip *grip = yield_grips(p);
    if (!p->yields) return NULL;
    const int32_t own = yield_matter(p, grip[0].block);
    for (uint32_t g = 0; g < yield_list(p)->grips; g++) p->search[yield_matter(p, grip[g].block)].own = own;
    return &p->search[own];
}

/* A contact's part in the next Newton step of a start. */
static void add_stop(const Primal *p, const YieldGrip *grip, YieldBody *body)
{
    static const double HARD = 30.0; /* times what the body weighs at the contact that it yields to most: dozens stop it, and one beside a hinge does not throw it. Balls on rubber
                                        turn by themselves the faster the more: at up to 0.3 rad/s with 10, 0.6 with 30, 1.4 with 100, and 2 with 1000; by trial */
    const Contact *contact = yield_contacts(p) + grip->contact;
    const float *u = p->node + node_of(p, grip);
    double along[WAYS] = {0}, room = (double)contact->gap;
    if (!(body->yields > 0.0)) return;
    for (int a = 0; a < 3; a++) {
        room += (double)contact->normal[a] * ((double)u[a] - (double)grip->surface[a]);
        for (int k = 0; k < WAYS; k++) along[k] += (double)contact->normal[a] * grip->move[k][a];
    }
    if (!(room < product(along, body->at))) return;
    const double hard = HARD / body->yields;
    for (int r = 0; r < WAYS; r++) {
        body->direction[r] += hard * room * along[r];
        for (int c = 0; c < WAYS; c++) body->factor[r][c] += hard * along[r] * along[c];
    }
}

/* What a body presses in before anything is solved for strains one layer of nodes alone, and pushes as nothing smooth does. So q begins with the least
 * |q - a|^2 / 2 + hard/2 sum (what goes through)^2, by Newton's method. */
void primal_yield_start(Primal *p)
{
    enum { ROUNDS = 6 };
    const YieldGrip *grip = yield_grips(p);
    YieldBody *body = yield_bodies(p);
    for (int round = 0; round < ROUNDS; round++) {
        for (uint32_t b = 0; b < yield_list(p)->bodies; b++) {
            memcpy(body[b].direction, body[b].aim, sizeof body[b].aim);
            yield_begin_factor(&body[b]);
        }
        for (uint32_t g = 0; g < yield_list(p)->grips; g++) add_stop(p, &grip[g], &body[grip[g].body]);
        for (uint32_t b = 0; b < yield_list(p)->bodies; b++) {
            cholesky_factor(body[b].factor, WAYS, 1.0);
            yield_solve(&body[b], body[b].direction);
            memcpy(body[b].at, body[b].direction, sizeof body[b].at);
        }
    }
    move_surfaces(p, false);
}

void primal_yield_evaluate(Primal *p)
{
    YieldBody *body = yield_bodies(p);
    if (!p->yields) return;
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++)
        for (int k = 0; k < WAYS; k++) body[b].force[k] = body[b].at[k] - body[b].aim[k];
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) p->joined->trial_energy += 0.5 * product(body[b].force, body[b].force);
    take_friction(p, p->node, false);
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++)
        for (int k = 0; k < WAYS; k++) {
            p->joined->slope_before += body[b].gradient[k] * (body[b].at[k] - body[b].best[k]);
            p->joined->slope_after += body[b].force[k] * (body[b].at[k] - body[b].best[k]);
        }
}

/* ---- Pairs ---- */

static void shift(double pairs[PRIMAL_MEMORY][WAYS], int to, int from)
{
    memmove(pairs[to], pairs[from], (PRIMAL_MEMORY - 1) * sizeof *pairs);
}

void primal_yield_keep_pair(Primal *p)
{
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) {
        YieldBody *body = &yield_bodies(p)[b];
        shift(body->step, 1, 0);
        shift(body->change, 1, 0);
        for (int k = 0; k < WAYS; k++) {
            body->step[0][k] = body->at[k] - body->best[k];
            body->change[0][k] = body->force[k] - body->gradient[k];
        }
        for (int i = 0; i < p->joined->pairs; i++) p->joined->total[i] += product(body->change[0], body->step[i]);
        p->joined->total[SUMS - 1] += product(body->step[0], body->step[0]);
        p->joined->total[SUMS - 2] += product(body->change[0], body->change[0]);
    }
}

void primal_yield_drop_pair(Primal *p)
{
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) {
        shift(yield_bodies(p)[b].step, 0, 1);
        shift(yield_bodies(p)[b].change, 0, 1);
    }
}

void primal_yield_accept(Primal *p)
{
    YieldBody *body = yield_bodies(p);
    if (!p->yields) return;
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) {
        memcpy(body[b].best, body[b].at, sizeof body[b].best);
        for (int k = 0; k < WAYS; k++) body[b].gradient[k] = body[b].best[k] - body[b].aim[k];
    }
    take_friction(p, p->best, true);
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) memcpy(body[b].right, body[b].gradient, sizeof body[b].right);
    for (uint32_t first = 0; first < yield_list(p)->grips; first = end_of_block(p, first)) {
        float own[BLOCK_FLOATS];
        memcpy(own, p->gradient + (size_t)yield_grips(p)[first].block * (size_t)p->floats, (size_t)p->floats * sizeof *own);
        fold(p, first, own);
    }
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++)
        for (int i = 0; i < p->joined->pairs; i++) p->joined->first[i] += product(body[b].step[i], body[b].right);
}

/* ---- The direction ---- */

void primal_yield_begin_plain(Primal *p)
{
    YieldBody *body = yield_bodies(p);
    for (uint32_t b = 0; p->yields && b < yield_list(p)->bodies; b++) memcpy(body[b].right, body[b].gradient, sizeof body[b].right);
}

void primal_yield_add_changes(Primal *p)
{
    YieldBody *body = yield_bodies(p);
    if (!p->yields) return;
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++)
        for (int i = 0; i < p->joined->pairs; i++)
            for (int k = 0; k < WAYS; k++) body[b].right[k] -= p->joined->first[i] * body[b].change[i][k];
    for (uint32_t first = 0; first < yield_list(p)->grips; first = end_of_block(p, first)) {
        const size_t begin = (size_t)yield_grips(p)[first].block * (size_t)p->floats;
        float own[BLOCK_FLOATS];
        memcpy(own, p->right + begin, (size_t)p->floats * sizeof *own);
        for (int i = 0; i < p->joined->pairs; i++)
            for (size_t j = 0; j < (size_t)p->floats; j++) own[j] -= (float)p->joined->first[i] * primal_change_of(p, p->joined, i)[begin + j];
        fold(p, first, own);
    }
}

void primal_yield_find_direction(Primal *p)
{
    YieldBody *body = yield_bodies(p);
    double total[SUMS];
    if (!p->yields) return;
    memcpy(total, p->joined->total, sizeof total);
    yield_weigh_along(p);
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) memcpy(body[b].direction, body[b].right, sizeof body[b].direction);
    yield_fold_along(p);
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) {
        yield_solve(&body[b], body[b].direction);
        for (int i = 0; i < p->joined->pairs; i++) total[i] += product(body[b].change[i], body[b].direction);
    }
    yield_spread_along(p, total);
    for (uint32_t first = 0; first < yield_list(p)->grips; first = end_of_block(p, first)) {
        const size_t begin = (size_t)yield_grips(p)[first].block * (size_t)p->floats;
        float in[BLOCK_FLOATS];
        unfold(p, first, in);
        for (size_t j = 0; j < (size_t)p->floats; j++)
            for (int i = 0; i < p->joined->pairs; i++) total[i] += (double)primal_change_of(p, p->joined, i)[begin + j] * (double)in[j];
    }
    memcpy(p->joined->total, total, sizeof total);
}

void primal_yield_add_steps(Primal *p)
{
    if (!p->yields) return;
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) {
        YieldBody *body = &yield_bodies(p)[b];
        for (int i = 0; i < p->joined->pairs; i++)
            for (int k = 0; k < WAYS; k++) body->direction[k] += p->joined->second[i] * body->step[i][k];
        p->joined->total[0] += product(body->gradient, body->direction);
    }
    for (uint32_t first = 0; first < yield_list(p)->grips; first = end_of_block(p, first)) {
        const size_t begin = (size_t)yield_grips(p)[first].block * (size_t)p->floats;
        float in[BLOCK_FLOATS];
        unfold(p, first, in);
        for (size_t j = 0; j < (size_t)p->floats; j++) {
            p->direction[begin + j] += in[j];
            p->joined->total[0] += (double)p->gradient[begin + j] * (double)in[j];
        }
    }
}

/* ---- Steps ---- */

void primal_yield_try(Primal *p)
{
    YieldBody *body = yield_bodies(p);
    if (!p->yields) return;
    const bool tries = p->joined->phase == SEARCH_TRIES;
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++)
        for (int k = 0; k < WAYS; k++) body[b].at[k] = tries ? body[b].best[k] - (double)p->joined->share * body[b].direction[k] : body[b].best[k];
    move_surfaces(p, false);
}

void primal_yield_return(Primal *p)
{
    YieldBody *body = yield_bodies(p);
    if (!p->yields) return;
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) memcpy(body[b].at, body[b].best, sizeof body[b].at);
    move_surfaces(p, true);
}

bool primal_yield_presses(const Primal *p, int32_t matter)
{
    for (uint32_t g = 0; p->yields && g < yield_list(p)->grips; g++)
        if (yield_contacts(p)[yield_grips(p)[g].contact].active && yield_matter(p, yield_grips(p)[g].block) == matter) return true;
    return false;
}

void primal_yield_close(Primal *p)
{
    const double dt = p->contacts->substep->dt;
    for (uint32_t b = 0; p->yields && b < yield_list(p)->bodies; b++) {
        const YieldBody *body = &yield_bodies(p)[b];
        FreeBody *free = body->obstacle->body;
        double more[6] = {0};
        for (int k = 0; k < free->ways; k++) {
            const double faster = body->best[k] / body->unit;
            free->change[k] += faster;
            for (int a = 0; a < 6; a++) more[a] += dt * faster * free->open[k][a];
        }
        for (int a = 0; a < 6; a++) free->pace[a] += more[a];
        free->met = 1;
        solid_displace(&body->obstacle->end, free->centre, more);
        obstacle_set_turn(body->obstacle);
    }
}
