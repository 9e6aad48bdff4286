/* What an unfinished solution keeps of the momentum of rigid bodies with what touches them, and what contacts allow to give back. See primal_momentum.c for matter alone.
 *
 * What bodies and matter push each other with cancels out where they go on together. So a heap, all that is joined by active contacts, goes on as a whole: along what
 * obstacles outside of it leave open, with their friction, to where its momentum is that of the predictor. Without that towers slid across the floor, by centimetres per second.
 *
 * A body that may go anywhere, or on a hinge, and all that it touches, if that touches nothing else, go on by all of the body's ways C W d. The energy is least where
 *
 *     q - a + W' sum over nodes C' m (u - u*) = 0,
 *
 * which is their momentum along the ways; elastic energy does not change. */
#include <math.h>

#include "base/vector.h"
#include "contact/contact_constraints.h"
#include "solvers/primal/primal_yield.h"
#include "solvers/primal/primal_yield_bodies.h"

/* ---- Bodies with what touches nothing else ---- */

static bool touches_others(const Primal *p, const YieldPair *pair)
{
    const int obstacle = (int)(yield_bodies(p)[pair->body].obstacle - p->contacts->colliders->obstacle);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++)
        for (uint32_t i = yield_first(p, block); i < yield_end(p, block) && yield_matter(p, block) == pair->matter; i++)
            if (yield_contacts(p)[i].active && yield_contacts(p)[i].obstacle != obstacle) return true;
    return false;
}

/* Moments of the mass, then the momentum that is missing and its moment. */
static void sum_together(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    double corner[3], x[3], lost[3];
    if (yield_matter(p, block) != p->pair->matter) return;
    yield_corner(p, p->pair, block, corner);
    for (size_t i = begin; i < end; i += W) {
        const double mass = (double)p->base[i + 3];
        primal_arm(corner, (i - begin) / W, x);
        for (size_t a = 0; a < 3; a++) lost[a] = mass * ((double)p->base[i + a] - (double)p->best[i + a]);
        yield_sum_moments(mass, x, sum);
        yield_add_moment(lost, x, sum + YIELD_MOMENTS);
    }
}

static void move_together(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const YieldBody *body = &yield_bodies(p)[p->pair->body];
    double motion[6], corner[3], x[3], moved[3];
    (void)sum;
    if (yield_matter(p, block) != p->pair->matter) return;
    yield_motion(body, body->direction, motion);
    yield_corner(p, p->pair, block, corner);
    for (size_t i = begin; i < end; i += W) {
        if (!(p->base[i + 3] > 0.0f)) continue;
        primal_arm(corner, (i - begin) / W, x);
        yield_motion_at(motion, x, moved);
        for (size_t a = 0; a < 3; a++) p->best[i + a] += (float)moved[a];
    }
}

static void find_alone(Primal *p)
{
    YieldBody *bodies = yield_bodies(p);
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) bodies[b].alone = false;
    for (uint32_t k = 0; k < yield_list(p)->pairs; k++) bodies[yield_pairs(p)[k].body].alone = true;
    for (uint32_t k = 0; k < yield_list(p)->pairs; k++)
        if (touches_others(p, &yield_pairs(p)[k])) bodies[yield_pairs(p)[k].body].alone = false;
}

static void keep_alone(Primal *p, uint32_t index)
{
    YieldBody *body = &yield_bodies(p)[index];
    yield_begin_factor(body);
    for (int k = 0; k < WAYS; k++) body->direction[k] = body->aim[k] - body->best[k];
    for (uint32_t k = 0; k < yield_list(p)->pairs; k++) {
        p->pair = &yield_pairs(p)[k];
        if (p->pair->body != index) continue;
        primal_over_blocks(p, sum_together);
        yield_add_moments(p->total, body);
        yield_add_push(body, p->total + YIELD_MOMENTS, body->direction);
    }
    cholesky_factor(body->factor, WAYS, 1.0);
    yield_solve(body, body->direction);
    for (uint32_t k = 0; k < yield_list(p)->pairs; k++) {
        p->pair = &yield_pairs(p)[k];
        if (p->pair->body == index) primal_over_blocks(p, move_together);
    }
    for (int k = 0; k < WAYS; k++) body->best[k] += body->direction[k];
}

/* ---- Heaps ---- */

/* The body that stands for a heap. */
static uint32_t first_of(const Primal *p, uint32_t body)
{
    const YieldBody *bodies = yield_bodies(p);
    while (bodies[body].heap != body) body = bodies[body].heap;
    return body;
}

static YieldHeap *heap_of(const Primal *p, uint32_t body) { return &yield_bodies(p)[first_of(p, body)].move; }

/* Null: the block's matter presses no body. */
static YieldHeap *heap_at(const Primal *p, int32_t block)
{
    const uint32_t body = yield_account(p, block)->heap;
    return body == UINT32_MAX ? NULL : heap_of(p, body);
}

static void find_heaps(Primal *p)
{
    YieldBody *bodies = yield_bodies(p);
    YieldAccount *account = yield_list(p)->account;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) account[i].heap = UINT32_MAX;
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) {
        bodies[b].heap = b;
        bodies[b].move = (YieldHeap){.stays = false};
    }
    for (uint32_t k = 0; k < yield_list(p)->pairs; k++) {
        const YieldPair *pair = &yield_pairs(p)[k];
        YieldAccount *of = &account[pair->matter];
        const uint32_t mine = first_of(p, pair->body), other = of->heap == UINT32_MAX ? mine : first_of(p, of->heap);
        of->heap = mine;
        bodies[mine > other ? mine : other].heap = mine > other ? other : mine;
    }
}

/* Whether walls and joints leave it free to go anywhere: its first ways are along the axes then. */
static bool goes_anywhere(const Primal *p, const YieldBody *body)
{
    const int dimension = p->world->def.dimension;
    for (int k = 0; k < dimension; k++)
        for (int a = 0; a < 6; a++)
            if (body->way[k][a] != body->whole[k][a] || (a == k) != (body->whole[k][a] != 0.0)) return false;
    return true;
}

static void sum_missing(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    if (!heap_at(p, block)) return;
    for (size_t i = begin; i < end; i += W) {
        const double mass = (double)p->base[i + 3];
        sum[0] += mass;
        for (size_t a = 0; a < 3; a++) sum[1 + a] += mass * ((double)p->base[i + a] - (double)p->best[i + a]);
    }
}

static void weigh_heaps(Primal *p)
{
    const double *sums = yield_state(p)->sums.data;
    primal_over_blocks(p, sum_missing);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        YieldHeap *heap = heap_at(p, block);
        if (!heap) continue;
        heap->mass += sums[(size_t)block * SUMS];
        for (int a = 0; a < 3; a++) heap->missing[a] += sums[(size_t)block * SUMS + 1 + (size_t)a];
    }
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) {
        const YieldBody *body = &yield_bodies(p)[b];
        YieldHeap *heap = heap_of(p, b);
        if (!goes_anywhere(p, body)) heap->stays = true;
        if (heap->stays) continue;
        heap->mass += 1.0 / (body->way[0][0] * body->way[0][0]); /* W = 1 / sqrt(mass) along the axes */
        for (int k = 0; k < p->world->def.dimension; k++) heap->missing[k] += (body->aim[k] - body->best[k]) / body->way[k][k];
    }
}

typedef void HeapContact(const Primal *p, const Contact *contact, const float *u, YieldHeap *heap);

/* All contacts of heaps with what is outside of them. */
static void over_outside(Primal *p, HeapContact *visit)
{
    uint32_t g = 0;
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        YieldHeap *heap = heap_at(p, block);
        for (uint32_t i = yield_first(p, block); i < yield_end(p, block); i++) {
            const Contact *contact = yield_contacts(p) + i;
            if (yield_takes(p, i, &g) && heap == heap_of(p, yield_grips(p)[g - 1].body)) continue;
            if (heap) visit(p, contact, p->best + (size_t)block * (size_t)p->floats + (size_t)contact->node * W, heap);
        }
    }
}

/* Along what normals a heap may not go: those of contacts that hold, and of those that it might run into. */
static void block_contact(const Primal *p, const Contact *contact, const float *u, YieldHeap *heap)
{
    (void)p;
    if (!contact->active && (double)constraints_room(contact, u) > sqrt(dot3(heap->missing, heap->missing)) / fmax(heap->mass, 1e-30)) return;
    if (constraints_stick(contact)) heap->stays = true;
    primal_block_normal(heap->normal, &heap->blocked, contact->normal);
}

static void rub_contact(const Primal *p, const Contact *contact, const float *u, YieldHeap *heap)
{
    float moved[3], rub[3];
    for (int a = 0; a < 3; a++) moved[a] = u[a] + (float)heap->way[a];
    if (!constraints_rub(contact, moved, p->slip_min, rub)) return;
    for (int a = 0; a < 3; a++) heap->pull[a] -= (double)rub[a];
    heap->stiffness += (double)constraints_friction_stiffness(contact, moved, p->slip_min);
}

/* A step of Newton's method, with friction's secant for its stiffness, which never goes too far. */
static void find_way(Primal *p)
{
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) {
        YieldHeap *heap = &yield_bodies(p)[b].move;
        for (int a = 0; a < 3; a++) heap->pull[a] = heap->missing[a] - heap->mass * heap->way[a];
        heap->stiffness = heap->mass;
    }
    over_outside(p, rub_contact);
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) {
        YieldHeap *heap = &yield_bodies(p)[b].move;
        for (int k = 0; k < heap->blocked; k++) {
            const double part = dot3(heap->normal[k], heap->pull);
            for (int a = 0; a < 3; a++) heap->pull[a] -= part * heap->normal[k][a];
        }
        for (int a = 0; a < 3 && heap->stiffness > 0.0 && !heap->stays; a++) heap->way[a] += heap->pull[a] / heap->stiffness;
    }
}

static void move_heap(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const YieldHeap *heap = heap_at(p, block);
    (void)sum;
    if (!heap || heap->stays) return;
    for (size_t i = begin; i < end; i += W)
        for (size_t a = 0; a < 3 && p->base[i + 3] > 0.0f; a++) p->best[i + a] += (float)heap->way[a];
}

static void keep_heaps(Primal *p)
{
    find_heaps(p);
    weigh_heaps(p);
    over_outside(p, block_contact);
    for (int step = 0; step < RUB_STEPS; step++) find_way(p);
    primal_over_blocks(p, move_heap);
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) {
        const YieldHeap *heap = heap_of(p, b);
        YieldBody *body = &yield_bodies(p)[b];
        for (int k = 0; k < p->world->def.dimension && !heap->stays; k++) body->best[k] += heap->way[k] / body->way[k][k];
    }
    yield_move_to_best(p);
}

void primal_yield_keep_momentum(Primal *p)
{
    if (!p->yields) return;
    yield_find_pairs(p);
    find_alone(p);
    keep_heaps(p);
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++)
        if (yield_bodies(p)[b].alone) keep_alone(p, b);
    yield_move_to_best(p);
}

/* ---- Bounces ---- */

/* The pair of a piece of matter and a body that touch nothing else; null: there is none. */
static const YieldPair *only_pair(const Primal *p, int32_t matter)
{
    const YieldPair *pair = yield_pairs(p), *found = NULL;
    for (uint32_t k = 0; k < yield_list(p)->pairs; k++) {
        if (pair[k].matter != matter) continue;
        if (found || !yield_bodies(p)[pair[k].body].alone) return NULL;
        found = &pair[k];
    }
    for (uint32_t k = 0; found && k < yield_list(p)->pairs; k++)
        if (pair[k].body == found->body && &pair[k] != found) return NULL;
    return found;
}

/* How an obstacle was sent, along its body's ways: the z of W z = its motion. */
static void find_sent(const Primal *p, const YieldBody *body, double z[WAYS])
{
    static const double RIDGE = 1e-12; /* of ways that there are not */
    const Obstacle *o = body->obstacle;
    double motion[6], trace = 0.0;
    float moved[3];
    SmallMatrix m = {{0}};
    obstacle_motion(o, o->body->begins, p->contacts->cell_size, p->contacts->max_displacement, moved);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        motion[a] = (double)moved[a];
        motion[3 + a] = 0.5 * (o->turn[3 * c + b] - o->turn[3 * b + c]); /* of small turns */
    }
    for (int r = 0; r < WAYS; r++) {
        z[r] = 0.0;
        for (int a = 0; a < 6; a++) {
            z[r] += body->whole[r][a] * motion[a];
            for (int c = 0; c < WAYS; c++) m[r][c] += body->whole[r][a] * body->whole[c][a];
        }
        trace += m[r][r];
    }
    for (int k = 0; k < WAYS; k++) m[k][k] += RIDGE * trace;
    cholesky_factor(m, WAYS, RIDGE * trace);
    cholesky_forward(m, z, WAYS);
    cholesky_backward(m, z, WAYS);
}

/* Energies as those of matter: |z + a - g|^2 / 2 before, |z + q|^2 / 2 - g.(z + q) after, g what its push adds in the substep. Obstacles still are as they were sent. */
bool primal_yield_bounce(const Primal *p, int32_t matter, YieldBounce *bounce)
{
    const YieldPair *pair = p->yields ? only_pair(p, matter) : NULL;
    double z[WAYS];
    if (!pair) return false;
    const YieldBody *body = &yield_bodies(p)[pair->body];
    const FreeBody *free = body->obstacle->body;
    find_sent(p, body, z);
    *bounce = (YieldBounce){.square = 0.0};
    for (int k = 0; k < WAYS; k++) {
        const double change = body->best[k] - body->aim[k], after = z[k] + body->best[k];
        double fall = 0.0;
        for (int a = 0; a < 6; a++) fall += body->unit * p->contacts->substep->dt * free->open[k][a] * free->push[a];
        const double before = z[k] + body->aim[k] - fall;
        bounce->square += change * change;
        bounce->along += change * after;
        bounce->lost += 0.5 * (before * before - after * after) + fall * after;
    }
    return true;
}
