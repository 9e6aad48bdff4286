/* What contacts gave where rigid bodies yielded.
 *
 * A body was given what it went for, q - a, and matter what it gained. At the solution both are what contacts push. An unfinished one leaves a difference. Given to the
 * body in the next step it would throw what is light, as if nothing had been solved for. So obstacles that yield to nothing take it: they push matter as much more as the body pushes
 * it less. Momentum is exact, and what a floor was given errs as far as the solution does.
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
    memset(yield_state(p)->yield_account.data, 0, (size_t)yield_state(p)->bodies.count * sizeof(YieldAccount));
    primal_over_blocks(p, sum_gained);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++)
        for (int a = 0; a < 3; a++) yield_account(p, block)->gained[a] += sums[(size_t)block * SUMS + (size_t)a];
}

/* What is booked, and what is missing. */
static void add_up(Primal *p)
{
    YieldAccount *account = yield_state(p)->yield_account.data;
    uint32_t g = 0;
    for (int32_t i = 0; i < yield_state(p)->bodies.count; i++) {
        memcpy(account[i].missing, account[i].gained, sizeof account[i].missing);
        account[i].given = account[i].slack = 0.0;
    }
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        YieldAccount *of = yield_account(p, block);
        for (uint32_t i = yield_first(p, block); i < yield_end(p, block); i++) {
            const double *booked = booked_at(p, i), size = size_of(booked);
            for (int a = 0; a < 3; a++) of->missing[a] -= booked[a];
            of->given += size;
            if (!yield_takes(p, i, &g)) of->slack += size;
        }
    }
}

/* Contacts share what is missing, in proportion to what they gave. `slack`: of matter that other obstacles push, these; else of all other matter. */
static void share_missing(Primal *p, bool slack)
{
    uint32_t g = 0;
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        const YieldAccount *of = yield_account(p, block);
        const double sum = slack ? of->slack : of->given;
        for (uint32_t i = yield_first(p, block); i < yield_end(p, block); i++) {
            const bool grips = yield_takes(p, i, &g);
            if (slack != (of->slack > 0.0) || (slack && grips) || !(sum > 0.0)) continue;
            const double share = size_of(booked_at(p, i)) / sum;
            for (int a = 0; a < 3; a++) booked_at(p, i)[a] += share * of->missing[a];
        }
    }
}

/* ---- Bodies ---- */

/* Whether what a grip gave may change. */
static bool may_settle(const Primal *p, const YieldGrip *grip, uint32_t index)
{
    if (grip->body != index || !yield_contacts(p)[grip->contact].active) return false;
    return yield_bodies(p)[index].alone || yield_account(p, grip->block)->slack > 0.0;
}

/* q - a less what was booked. */
static void find_owed(const Primal *p, uint32_t index, double owed[WAYS])
{
    const YieldGrip *grip = yield_grips(p);
    const YieldBody *body = &yield_bodies(p)[index];
    for (int k = 0; k < WAYS; k++) owed[k] = body->best[k] - body->aim[k];
    for (uint32_t g = 0; g < yield_state(p)->yield_grips; g++)
        for (int k = 0; k < WAYS && grip[g].body == index; k++) owed[k] += dot3(grip[g].move[k], booked_at(p, grip[g].contact));
}

/* The mean motion of grips that may settle, per way; 0 where others take what they give more. */
static void find_mean(const Primal *p, uint32_t index, double mean[WAYS][3])
{
    const YieldGrip *grip = yield_grips(p);
    double count = 0.0;
    memset(mean, 0, WAYS * sizeof *mean);
    for (uint32_t g = 0; g < yield_state(p)->yield_grips && yield_bodies(p)[index].alone; g++) {
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
    for (uint32_t g = 0; g < yield_state(p)->yield_grips; g++) {
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
    for (uint32_t g = 0; g < yield_state(p)->yield_grips; g++) {
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
    add_up(p);
    share_missing(p, false);
    for (uint32_t b = 0; b < yield_state(p)->yield_bodies; b++) settle_body(p, b);
    add_up(p);
    share_missing(p, true);
}
