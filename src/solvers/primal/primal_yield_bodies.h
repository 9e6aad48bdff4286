/* What the files of primal_yield.h share. */
#ifndef PBMPM_SRC_SOLVERS_PRIMAL_PRIMAL_YIELD_BODIES_H
#define PBMPM_SRC_SOLVERS_PRIMAL_PRIMAL_YIELD_BODIES_H

#include "base/cholesky.h"
#include "solvers/primal/primal_solve.h"

enum { WAYS = FREE_BODY_WAYS, BLOCK_FLOATS = 64 * W };

/* A contact of a body. They are in the order of contacts. */
typedef struct YieldGrip {
    int32_t block;
    uint32_t contact, body;
    float surface[3];     /* as its obstacle was sent */
    double move[WAYS][3]; /* C W */
} YieldGrip;

/* A translation of bodies and matter that touch: see primal_yield_heaps.c, and BodyMove. */
typedef struct YieldHeap {
    bool stays;
    double mass, missing[3];
    int blocked;
    double normal[3][3];
    double way[3], pull[3], stiffness;
} YieldHeap;

typedef struct YieldBody {
    Obstacle *obstacle;
    double unit;                         /* of q over that of velocities along the ways */
    double way[WAYS][6], whole[WAYS][6]; /* W; the same if walls of the domain held nothing */
    double aim[WAYS];                    /* a */
    double at[WAYS], force[WAYS];        /* where the energy was evaluated, and its gradient */
    double best[WAYS], gradient[WAYS];   /* the same where it was accepted */
    double right[WAYS], direction[WAYS]; /* r, and D^-1 r with what pairs add */
    double step[PRIMAL_MEMORY][WAYS], change[PRIMAL_MEMORY][WAYS];
    SmallMatrix factor;                  /* of D, or of another matrix while that is solved with */
    double yields;                       /* to an impulse of 1 along a contact's normal, there, at most */
    uint32_t heap;                       /* another body of its heap, or itself: then `move` is the heap's */
    YieldHeap move;
    bool alone;                          /* what it touches touches nothing else */
    int32_t level;                       /* as YieldAccount's */
} YieldBody;

/* A body and a piece of matter that it presses, which goes along by the share f: see primal_yield_along.c. */
typedef struct YieldPair {
    int32_t matter;
    uint32_t body;
    double mean, slope[3], middle[3]; /* of f */
    double sum[8], square[3][3];
} YieldPair;

/* What a piece of matter gained, and what of it contacts have not been booked for. */
typedef struct YieldAccount {
    double gained[3], missing[3];
    double sum;          /* of sizes of impulses, of those contacts that share what is missing */
    int32_t level;       /* how far from obstacles that yield to nothing: see primal_yield_book.c */
    uint32_t heap;       /* a body of it; UINT32_MAX: it touches none */
} YieldAccount;

/* All of a substep. */
typedef struct YieldList {
    uint32_t bodies, grips, pairs;
    YieldBody *body;
    YieldGrip *grip;
    YieldPair *pair;
    YieldAccount *account; /* per piece of matter */
} YieldList;

static inline PrimalState *yield_state(const Primal *p) { return &p->world->primal; }
static inline YieldList *yield_list(const Primal *p) { return p->world->walls.scratch.data; }
static inline YieldBody *yield_bodies(const Primal *p) { return p->yields ? yield_list(p)->body : NULL; }
static inline YieldGrip *yield_grips(const Primal *p) { return p->yields ? yield_list(p)->grip : NULL; }
static inline YieldPair *yield_pairs(const Primal *p) { return p->yields ? yield_list(p)->pair : NULL; }
static inline Contact *yield_contacts(const Primal *p) { return p->contacts->colliders->contact.data; }
static inline int32_t yield_matter(const Primal *p, int32_t block) { return body_of_block(&p->world->grid, block); }
static inline YieldAccount *yield_account(const Primal *p, int32_t block) { return yield_list(p)->account + yield_matter(p, block); }

/* The contacts of a block. */
static inline uint32_t yield_first(const Primal *p, int32_t block) { return ((const uint32_t *)p->contacts->colliders->contact_begin.data)[block]; }
static inline uint32_t yield_end(const Primal *p, int32_t block) { return yield_first(p, block + 1); }

/* Whether contact i is the next grip; then counts it. All contacts are asked in their order. */
static inline bool yield_takes(const Primal *p, uint32_t i, uint32_t *grips)
{
    if (*grips == yield_list(p)->grips || yield_grips(p)[*grips].contact != i) return false;
    ++*grips;
    return true;
}

/* W x, as a motion and a turn; and C of that. */
static inline void yield_motion(const YieldBody *body, const double x[WAYS], double motion[6])
{
    for (int a = 0; a < 6; a++) motion[a] = 0.0;
    for (int k = 0; k < WAYS; k++)
        for (int a = 0; a < 6; a++) motion[a] += body->way[k][a] * x[k];
}

static inline void yield_motion_at(const double motion[6], const double arm[3], double out[3])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        out[a] = motion[a] + motion[3 + b] * arm[c] - motion[3 + c] * arm[b];
    }
}

/* The transposes: a push at `arm` and its moment are added to sum; sum[k] += W' push. */
static inline void yield_add_moment(const double push[3], const double arm[3], double sum[6])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        sum[a] += push[a];
        sum[3 + a] += arm[b] * push[c] - arm[c] * push[b];
    }
}

static inline void yield_add_push(const YieldBody *body, const double push[6], double sum[WAYS])
{
    for (int k = 0; k < WAYS; k++)
        for (int a = 0; a < 6; a++) sum[k] += body->way[k][a] * push[a];
}

/* The solution of L L' x = x, L the body's factor. */
static inline void yield_solve(const YieldBody *body, double x[WAYS])
{
    cholesky_forward(body->factor, x, WAYS);
    cholesky_backward(body->factor, x, WAYS);
}

static inline void yield_begin_factor(YieldBody *body)
{
    for (int r = 0; r < WAYS; r++)
        for (int c = 0; c < WAYS; c++) body->factor[r][c] = r == c;
}

/* ---- primal_yield.c ---- */

/* Puts surfaces where bodies are accepted to be. */
void yield_move_to_best(Primal *p);

/* ---- primal_yield_along.c ---- */

/* Finds who presses what, with the contacts that are active now. */
void yield_find_pairs(Primal *p);

/* From a pair's rigid body to a block's first node [cells]. */
void yield_corner(const Primal *p, const YieldPair *pair, int32_t block, double corner[3]);

/* Sums of weights, of weights times places and of their products; W' (sum C' C) W, of which this adds to the body's factor. */
enum { YIELD_MOMENTS = 10 };
void yield_sum_moments(double weight, const double x[3], double sum[YIELD_MOMENTS]);
void yield_add_moments(const double sum[YIELD_MOMENTS], YieldBody *body);

/* D, and what goes along in r. Then what goes along in the direction: adds it to p->direction, and to `total` its products with the pairs' changes. */
void yield_weigh_along(Primal *p);
void yield_fold_along(Primal *p);
void yield_spread_along(Primal *p, double total[SUMS]);

#endif
