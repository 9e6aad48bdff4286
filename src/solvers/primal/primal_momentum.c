/* What an unfinished solution keeps of a body's momentum, and what contacts allow to give back.
 *
 * The energy of a body does not change under a translation t of all nodes but for sum m/2 |u + t - u*|^2 and friction, as long as t leads along the
 * surfaces that it leans on: a body in mid-air gets all of its momentum back, one on a slope that along it.
 *
 * Nor does inner energy change under a rotation of x + u. So a body that meets nothing goes on to the best one: there sum (x + u) x m (u* - u) is zero, as it
 * is of the exact solution. Only bodies with BDF2 need it, others get back what they lack by primal_spin.c. Without it a disc lost up to half as much again as BDF2 by
 * itself takes, at 120 Hz x 20, and less or more with the last bit.
 *
 * Liquid at a wall keeps the dual's motion in the joint solver, and its nodes pull at the others. So the energy changes with t, and its lowest point is
 * looked for by a step of the descent along t: there the forces on what may move are zero in sum, M t = - sum of the gradient. Without it a light solid in
 * a heavy liquid drove itself along the wall: random scene 21704 gained 45 % of its energy. */
#include <math.h>
#include <string.h>

#include "contact/contact_constraints.h"
#include "solvers/primal/primal_solve.h"

static void sum_momentum_error(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    (void)block;
    for (size_t i = begin; i < end; i += W) {
        const double mass = (double)p->base[i + 3];
        sum[0] += mass;
        for (size_t c = 0; c < 3; c++) sum[1 + c] += mass * ((double)p->base[i + c] - (double)p->best[i + c]);
    }
}

static void take_out(const double direction[3], double v[3])
{
    const double part = direction[0] * v[0] + direction[1] * v[1] + direction[2] * v[2];
    for (int a = 0; a < 3; a++) v[a] -= part * direction[a];
}

void primal_block_normal(double blocked[3][3], int *count, const float normal[3])
{
    static const double NEW = 1e-3; /* sine of the angle to what is blocked already */
    double n[3] = {(double)normal[0], (double)normal[1], (double)normal[2]};
    for (int k = 0; k < *count; k++) take_out(blocked[k], n);
    const double length = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    if (length < NEW || *count == 3) return;
    for (int a = 0; a < 3; a++) blocked[*count][a] = n[a] / length;
    ++*count;
}

static BodyMove *move_of(const Primal *p, int32_t block)
{
    const PrimalState *state = &p->world->primal;
    return (BodyMove *)state->moves.data + body_of_block(&p->world->grid, block);
}

/* Contacts that hold, and those that a body might run into. */
static void find_blocked(const Primal *p)
{
    const Colliders *colliders = p->contacts->colliders;
    const uint32_t *begin = colliders->contact_begin.data;
    for (int32_t block = 0; block < p->world->grid.node_blocks && colliders->contacts > 0; block++)
        for (uint32_t i = begin[block]; i < begin[block + 1]; i++) {
            const Contact *contact = (const Contact *)colliders->contact.data + i;
            BodyMove *move = move_of(p, block);
            const float *u = p->best + (size_t)block * (size_t)p->floats + (size_t)contact->node * W;
            if (!contact->active && (double)constraints_room(contact, u) > move->longest) continue;
            if (constraints_stick(contact)) move->blocked = 3;
            else primal_block_normal(move->normal, &move->blocked, contact->normal);
        }
}

/* A step of Newton's method for t, with friction's secant for its stiffness, which never goes too far. */
static void move_on(Primal *p)
{
    BodyMove *move = p->world->primal.moves.data;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        for (int a = 0; a < 3; a++) move[i].pull[a] = move[i].missing[a] - move[i].mass * move[i].way[a];
        move[i].stiffness = move[i].mass;
    }
    for (int32_t block = 0; block < p->world->grid.node_blocks && p->rubs; block++)
        constraints_pull(p->contacts, p->best, move_of(p, block)->way, p->slip_min, block, move_of(p, block)->pull, &move_of(p, block)->stiffness);
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        for (int k = 0; k < move[i].blocked; k++) take_out(move[i].normal[k], move[i].pull);
        for (int a = 0; a < 3 && move[i].blocked < 3 && move[i].stiffness > 0.0; a++) move[i].way[a] += move[i].pull[a] / move[i].stiffness;
    }
}

static void move_body(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const BodyMove *move = move_of(p, block);
    (void)sum;
    if (move->blocked == 3 || !(move->mass > 0.0)) return;
    for (size_t i = begin; i < end; i += W)
        for (size_t c = 0; c < 3 && p->base[i + 3] > 0.0f; c++) p->best[i + c] += (float)move->way[c];
}

/* ---- Bodies with liquid ---- */

static bool is_pulled(const BodySum *body) { return body->leans && body->with_liquid; }

static void sum_pull(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    if (!is_pulled(primal_body_of(p, block))) return;
    memcpy(p->right + begin, p->gradient + begin, (end - begin) * sizeof *p->right);
    constraints_remove(p->contacts, p->right, block, block + 1);
    for (size_t i = begin; i < end; i += W) {
        sum[0] += (double)p->base[i + 3];
        for (size_t c = 0; c < 3; c++) sum[1 + c] += (double)p->right[i + c];
    }
}

static void lead_translation(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const double *body = primal_rigid_of(p, block)->sum; /* mass and pull */
    for (size_t i = begin; i < end; i += W)
        for (size_t c = 0; c < W; c++) p->direction[i + c] = c < 3 && p->base[i + 3] > 0.0f && body[0] > 0.0 ? (float)(body[1 + c] / body[0]) : 0.0f;
    constraints_remove(p->contacts, p->direction, block, block + 1);
    for (size_t i = begin; i < end; i++) sum[0] += (double)p->gradient[i] * (double)p->direction[i];
}

void primal_balance_momentum(Primal *p)
{
    enum { EVALUATIONS = 3 }; /* one was enough in 1,406 of 1,408 substeps of quiet scenes; the others go to where the slope vanishes */
    primal_over_blocks(p, sum_pull);
    primal_gather_rigid(p, 4);
    primal_over_searches(p, lead_translation);
    primal_follow(p, EVALUATIONS);
}

/* ---- Rotations ---- */

static bool is_turned(const Primal *p, int32_t block)
{
    const RigidBody *body = primal_rigid_of(p, block);
    return body->turns && body->multistep && !primal_body_of(p, block)->meets && !move_of(p, block)->stays;
}

/* Products of x + u and x + u*, their torque, and sum m (x + u), about the body's centre. */
static void sum_turns(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    double corner[3], x[3], arrives[3], free[3];
    if (!is_turned(p, block)) return;
    primal_corner(p, block, primal_rigid_of(p, block), corner);
    for (size_t i = begin; i < end; i += W) {
        const double mass = (double)p->base[i + 3];
        primal_arm(corner, (i - begin) / W, x);
        for (size_t c = 0; c < 3; c++) {
            arrives[c] = x[c] + (double)p->best[i + c];
            free[c] = x[c] + (double)p->base[i + c];
        }
        primal_sum_products(mass, arrives, free, sum);
        for (int a = 0; a < 3; a++) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            sum[6 + a] += mass * (arrives[b] * free[c] - arrives[c] * free[b]);
            sum[9 + a] += mass * arrives[a];
        }
    }
}

/* About the centre of x + u, which is that of x + u*, too. */
static void find_turn(RigidBody *body)
{
    static const double none[RIGID_MODES];
    double *sum = body->sum, torque[RIGID_MODES] = {0.0, 0.0, 0.0, sum[6], sum[7], sum[8]};
    const double mass = body->mass[0][0];
    for (int a = 0; a < 3; a++) body->middle[a] = sum[9 + a] / mass;
    primal_sum_products(-mass, body->middle, body->middle, sum);
    memcpy(body->factor, body->mass, sizeof body->factor);
    memcpy(body->motion, none, sizeof none);
    if (!primal_weigh_turns(sum, body->factor)) return;
    memcpy(sum, torque, sizeof torque);
    primal_factorise(body);
    primal_solve_modes(body, body->motion);
}

static void turn_body(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const RigidBody *body = primal_rigid_of(p, block);
    double corner[3], x[3], way[3];
    (void)sum;
    if (!is_turned(p, block)) return;
    primal_corner(p, block, body, corner);
    for (size_t i = begin; i < end; i += W) {
        if (p->base[i + 3] == 0.0f) continue;
        primal_arm(corner, (i - begin) / W, x);
        for (int a = 0; a < 3; a++) x[a] += (double)p->best[i + (size_t)a] - body->middle[a];
        primal_move_rigidly(body->motion, x, way);
        for (size_t c = 0; c < 3; c++) p->best[i + c] += (float)way[c];
    }
}

static void keep_rotations(Primal *p)
{
    RigidBody *body = p->world->primal.rigid.data;
    bool any = false;
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) any = any || is_turned(p, block);
    if (!any) return;
    primal_over_blocks(p, sum_turns);
    primal_gather_rigid(p, 12);
    for (int32_t i = 0; i < p->world->grid.bodies; i++)
        if (body[i].turns && body[i].multistep) find_turn(&body[i]);
    primal_over_blocks(p, turn_body);
}

/* ---- All others ---- */

void primal_keep_momentum(Primal *p, BodyTest *chosen)
{
    const PrimalState *state = &p->world->primal;
    const BodySum *body = state->body_sums.data;
    BodyMove *move = state->moves.data;
    const double *sums = state->sums.data;
    bool any = false;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        const bool stays = chosen && !chosen(p, i);
        move[i] = (BodyMove){.stays = stays, .blocked = stays || (body[i].leans && body[i].with_liquid) ? 3 : 0};
        any = any || !stays;
    }
    if (!any) return;
    primal_over_blocks(p, sum_momentum_error);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        BodyMove *m = move_of(p, block);
        m->mass += sums[(size_t)block * SUMS];
        for (int c = 0; c < 3; c++) m->missing[c] += sums[(size_t)block * SUMS + 1 + (size_t)c];
    }
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        const double *m = move[i].missing;
        move[i].longest = sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]) / fmax(move[i].mass, 1e-30);
    }
    find_blocked(p);
    for (int step = 0; step < (p->rubs ? RUB_STEPS : 1); step++) move_on(p);
    primal_over_blocks(p, move_body);
    keep_rotations(p);
}
