/* What contacts gave where rigid bodies yielded.
 *
 * A body was given what it went for, q - a, and matter what it gained. At the solution both are what contacts push. An unfinished one leaves a difference. Given to the
 * body in the next step it would throw what is light, as if nothing had been solved for. So obstacles that yield to nothing take it: they push matter as much more as the body pushes
 * it less. Momentum is exact, and what a floor was given errs as far as the solution does. In a tower it goes down from body to matter to body, until there is a floor.
 *
 * What touches nothing but one body has that body's momentum, see primal_yield_heaps.c. There only the moment is made right, by pushes that add up to nothing. */
#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "contact/contact_constraints.h"
#include "solvers/primal/primal_yield.h"
#include "solvers/primal/primal_yield_bodies.h"

static double size_of(const double v[3]) { return sqrt(dot3(v, v)); }

static double *booked_at(const Primal *p, uint32_t contact) { return (double *)p->contacts->colliders->impulses.contact.data + 3 * (size_t)contact; }

static void sum_gained(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    (void)block;
    for (size_t i = begin; i < end; i += W)
        for (size_t a = 0; a < 3; a++) sum[a] += (double)p->base[i + 3] * ((double)p->after[i + a] - (double)p->base[i + a]);
}

static void open_accounts(Primal *p)
{
    const double *sums = yield_state(p)->sums.data;
    memset(yield_list(p)->account, 0, (size_t)p->world->grid.bodies * sizeof(YieldAccount));
    primal_over_blocks(p, sum_gained);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++)
        for (int a = 0; a < 3; a++) yield_account(p, block)->gained[a] += sums[(size_t)block * SUMS + (size_t)a];
}

static void add_up(Primal *p)
{
    YieldAccount *account = yield_list(p)->account;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) memcpy(account[i].missing, account[i].gained, sizeof account[i].missing);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++)
        for (uint32_t i = yield_first(p, block); i < yield_end(p, block); i++)
            for (int a = 0; a < 3; a++) yield_account(p, block)->missing[a] -= booked_at(p, i)[a];
}

/* ---- Levels: matter that other obstacles push has 0, bodies that press it 1, other matter that presses these 2, and so on; NOWHERE where no other obstacle is ---- */

enum { NOWHERE = INT32_MAX };

static void begin_levels(Primal *p)
{
    YieldAccount *account = yield_list(p)->account;
    uint32_t g = 0;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) account[i].level = NOWHERE;
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) yield_bodies(p)[b].level = NOWHERE;
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++)
        for (uint32_t i = yield_first(p, block); i < yield_end(p, block); i++)
            if (!yield_takes(p, i, &g) && size_of(booked_at(p, i)) > 0.0) yield_account(p, block)->level = 0;
}

/* Goes on from what has a level. Returns the last one. */
static int32_t spread_levels(Primal *p)
{
    const YieldGrip *grip = yield_grips(p);
    int32_t last = 0;
    for (bool changed = true; changed;) {
        changed = false;
        for (uint32_t g = 0; g < yield_list(p)->grips; g++) {
            int32_t *matter = &yield_account(p, grip[g].block)->level, *body = &yield_bodies(p)[grip[g].body].level;
            if (!yield_contacts(p)[grip[g].contact].active) continue;
            int32_t *far = *matter < *body ? body : matter;
            const int32_t next = *matter < *body ? *matter : *body;
            if (next == NOWHERE || *far <= next + 1) continue;
            *far = next + 1;
            changed = true;
        }
    }
    for (uint32_t g = 0; g < yield_list(p)->grips; g++) {
        const int32_t matter = yield_account(p, grip[g].block)->level, body = yield_bodies(p)[grip[g].body].level;
        if (matter != NOWHERE && matter > last) last = matter;
        if (body != NOWHERE && body > last) last = body;
    }
    return last;
}

/* What flies freely has its momentum, see primal_yield_heaps.c: then the first body of a heap ends the chain. */
static int32_t find_levels(Primal *p)
{
    begin_levels(p);
    int32_t last = spread_levels(p);
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) {
        YieldBody *body = &yield_bodies(p)[b];
        if (body->level != NOWHERE || body->alone) continue;
        body->level = 1;
        last = spread_levels(p);
    }
    return last;
}

/* ---- Matter ---- */

/* Whether a contact shares what is missing of matter at this level: towards those at the next lower one. */
static bool may_share(const Primal *p, const YieldAccount *of, const YieldGrip *grip, int32_t level)
{
    if (of->level != level) return false;
    if (level == 0) return !grip;
    return level == NOWHERE || (grip && yield_bodies(p)[grip->body].level == level - 1);
}

/* In proportion to what they gave. */
static void share_missing(Primal *p, int32_t level)
{
    YieldAccount *account = yield_list(p)->account;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) account[i].sum = 0.0;
    for (int pass = 0; pass < 2; pass++) {
        uint32_t g = 0;
        for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
            YieldAccount *of = yield_account(p, block);
            for (uint32_t i = yield_first(p, block); i < yield_end(p, block); i++) {
                const YieldGrip *grip = yield_takes(p, i, &g) ? &yield_grips(p)[g - 1] : NULL;
                const double size = size_of(booked_at(p, i));
                if (!may_share(p, of, grip, level)) continue;
                if (pass == 0) of->sum += size;
                for (int a = 0; a < 3 && pass == 1 && of->sum > 0.0; a++) booked_at(p, i)[a] += size / of->sum * of->missing[a];
            }
        }
    }
}

/* ---- Bodies ---- */

/* Whether what a grip gave may change. */
static bool may_settle(const Primal *p, const YieldGrip *grip, uint32_t index)
{
    if (grip->body != index || !yield_contacts(p)[grip->contact].active) return false;
    return yield_bodies(p)[index].alone || yield_account(p, grip->block)->level == yield_bodies(p)[index].level - 1;
}

/* q - a less what was booked. */
static void find_owed(const Primal *p, uint32_t index, double owed[WAYS])
{
    const YieldGrip *grip = yield_grips(p);
    const YieldBody *body = &yield_bodies(p)[index];
    for (int k = 0; k < WAYS; k++) owed[k] = body->best[k] - body->aim[k];
    for (uint32_t g = 0; g < yield_list(p)->grips; g++)
        for (int k = 0; k < WAYS && grip[g].body == index; k++) owed[k] += dot3(grip[g].move[k], booked_at(p, grip[g].contact));
}

/* The mean motion of grips that may settle, per way; 0 where others take what they give more. */
static void find_mean(const Primal *p, uint32_t index, double mean[WAYS][3])
{
    const YieldGrip *grip = yield_grips(p);
    double count = 0.0;
    memset(mean, 0, WAYS * sizeof *mean);
    for (uint32_t g = 0; g < yield_list(p)->grips && yield_bodies(p)[index].alone; g++) {
        if (!may_settle(p, &grip[g], index)) continue;
        count += 1.0;
        for (int k = 0; k < WAYS; k++)
            for (int a = 0; a < 3; a++) mean[k][a] += grip[g].move[k][a];
    }
    for (int k = 0; k < WAYS && count > 0.0; k++)
        for (int a = 0; a < 3; a++) mean[k][a] /= count;
}

static void own_moves(const YieldGrip *grip, const double mean[WAYS][3], double move[WAYS][3])
{
    for (int k = 0; k < WAYS; k++)
        for (int a = 0; a < 3; a++) move[k][a] = grip->move[k][a] - mean[k][a];
}

/* The least changes of what grips gave, d_i = -M_i x with sum M_i' M_i x = owed, M the motions by the ways. */
static void settle_body(Primal *p, uint32_t index)
{
    static const double RIDGE = 1e-9; /* ways that change nothing of it get nothing */
    const YieldGrip *grip = yield_grips(p);
    double owed[WAYS], mean[WAYS][3], move[WAYS][3], whole = 0.0;
    SmallMatrix m = {{0}};
    find_owed(p, index, owed);
    find_mean(p, index, mean);
    for (uint32_t g = 0; g < yield_list(p)->grips; g++) {
        if (!may_settle(p, &grip[g], index)) continue;
        own_moves(&grip[g], mean, move);
        for (int r = 0; r < WAYS; r++) {
            whole += dot3(grip[g].move[r], grip[g].move[r]);
            for (int c = 0; c < WAYS; c++) m[r][c] += dot3(move[r], move[c]);
        }
    }
    if (!(whole > 0.0)) return;
    for (int k = 0; k < WAYS; k++) m[k][k] += RIDGE * whole;
    cholesky_factor(m, WAYS, RIDGE * whole);
    cholesky_forward(m, owed, WAYS);
    cholesky_backward(m, owed, WAYS);
    for (uint32_t g = 0; g < yield_list(p)->grips; g++) {
        if (!may_settle(p, &grip[g], index)) continue;
        own_moves(&grip[g], mean, move);
        for (int k = 0; k < WAYS; k++)
            for (int a = 0; a < 3; a++) booked_at(p, grip[g].contact)[a] -= owed[k] * move[k][a];
    }
}

void primal_yield_book(Primal *p, const float *after)
{
    p->after = after;
    constraints_book_contacts(p->contacts, p->gradient, p->best, p->slip_min);
    open_accounts(p);
    const int32_t last = find_levels(p);
    add_up(p);
    share_missing(p, NOWHERE);
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++)
        if (yield_bodies(p)[b].alone) settle_body(p, b);
    for (int32_t level = last; level >= 0; level--) {
        for (uint32_t b = 0; b < yield_list(p)->bodies && level % 2 == 1; b++)
            if (yield_bodies(p)[b].level == level && !yield_bodies(p)[b].alone) settle_body(p, b);
        if (level % 2 == 1) continue;
        add_up(p);
        share_missing(p, level);
    }
}
