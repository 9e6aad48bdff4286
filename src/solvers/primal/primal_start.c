/* The start of bodies that are too stiff for a substep, as if they were rigid.
 *
 * A body that vibrates or turns is stretched by its velocities, and a few iterations do not bring it below the energy that it had. So a body starts from
 * the rigid motion y with the least
 *
 *     1/2 |Z y - u*|^2_M + sum over contacts of K/2 min(0, n.v + gap)^2 + friction,   v = (Z y)_i - surface,
 *
 * K much more than the stiffness of a node, if that promises less energy. Found by Newton's method: a few sums over contacts. */
#include <math.h>
#include <string.h>

#include "contact/contact_constraints.h"
#include "solvers/primal/primal_solve.h"

/* Nodes' stiffnesses times this: what contacts give way by is strain, and what was strained before resists that at once. With 1 bodies at rest started with more energy than
 * they had; 30 mended half of that. By trial. */
static const double RIGID = 1000.0;

/* Of Newton's method; a start that is not found by then is judged by its energy like any other. */
enum { ROUNDS = 6 };
static const double FOUND = 1e-4; /* [cells], [radians] where Newton's method ends: less is no strain that a body notices */

/* Z'M u*, and the products of x and x + u*. Uses p->force. */
static void sum_predicted(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const RigidBody *body = primal_rigid_of(p, block);
    double corner[3], x[3], free[3];
    if (!body->turns) return;
    primal_corner(p, block, body, corner);
    for (size_t i = begin; i < end; i += W) {
        const float mass = p->base[i + 3];
        primal_arm(corner, (i - begin) / W, x);
        for (size_t c = 0; c < 3; c++) {
            p->force[i + c] = mass * p->base[i + c];
            free[c] = x[c] + (double)p->base[i + c];
        }
        primal_sum_products((double)mass, x, free, sum + RIGID_MODES);
    }
    primal_sum_rigid(p, block, p->force + begin, sum);
}

/* Where the motion w takes a point, turned by the angle whose tangent is |w|, as a step projects velocities: without strain. With s = cos = (1 + w^2)^-1/2
 * and sin = |w| s, (R - I) x = s w x x + (1 - s) / w^2 w x (w x x). */
void primal_move_rigidly(const double motion[RIGID_MODES], const double x[3], double out[3])
{
    const double *t = motion, *w = motion + 3;
    const double s = 1.0 / sqrt(1.0 + w[0] * w[0] + w[1] * w[1] + w[2] * w[2]), q = s * s / (1.0 + s);
    const double v[3] = {w[1] * x[2] - w[2] * x[1], w[2] * x[0] - w[0] * x[2], w[0] * x[1] - w[1] * x[0]};
    const double a[3] = {w[1] * v[2] - w[2] * v[1], w[2] * v[0] - w[0] * v[2], w[0] * v[1] - w[1] * v[0]};
    for (int c = 0; c < 3; c++) out[c] = t[c] + s * v[c] + q * a[c];
}

/* A contact's part in the next Newton step, at body->start. What a rotation does beside w x x counts as a motion of the surface, back. */
static void add_push(Primal *p, int32_t block, RigidBody *body, const Contact *contact)
{
    static const float axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const size_t node = (size_t)block * (size_t)p->floats + (size_t)contact->node * W;
    const double mass = (double)p->base[node + 3], inverse = (double)((const float *)p->world->primal.inverse.data)[node / W];
    const double *t = body->start, *w = body->start + 3;
    double corner[3], x[3], v[RIGID_MODES];
    if (!(inverse > 0.0)) return;
    const double stiffness = RIGID * fmax(mass, 1.0 / inverse - mass);
    primal_corner(p, block, body, corner);
    primal_arm(corner, contact->node, x);
    const double u[3] = {t[0] + w[1] * x[2] - w[2] * x[1], t[1] + w[2] * x[0] - w[0] * x[2], t[2] + w[0] * x[1] - w[1] * x[0]};
    double turned[3], surface[3];
    primal_move_rigidly(body->start, x, turned);
    for (int a = 0; a < 3; a++) surface[a] = (double)contact->surface[a] - (turned[a] - u[a]);
    double depth = -(double)contact->gap, along = 0.0, slip2 = 0.0;
    for (int a = 0; a < 3; a++) along += (u[a] - surface[a]) * (double)contact->normal[a];
    depth -= along;
    const bool held = constraints_stick(contact);
    if (depth <= 0.0 && !held) return;
    for (int a = 0; a < 3; a++) {
        const double slip = u[a] - surface[a] - along * (double)contact->normal[a];
        slip2 += slip * slip;
    }
    const double rubs = held ? stiffness : (double)constraints_friction_coefficient(contact) * stiffness * depth / fmax(sqrt(slip2), (double)p->slip_min);
    double to = (stiffness - rubs) * -(double)contact->gap; /* along the normal, beside what friction takes along */
    for (int a = 0; a < 3; a++) to += (stiffness - rubs) * surface[a] * (double)contact->normal[a];
    if (held) to = 0.0;
    for (int a = 0; a < 3 && rubs > 0.0; a++) {
        const double goal = rubs * (surface[a] - (held ? 0.0 : (double)contact->gap * (double)contact->normal[a]));
        primal_motion_along(x, axis[a], v);
        for (int k = 0; k < RIGID_MODES; k++) body->sum[k] += goal * v[k];
        primal_add_along(body, x, axis[a], rubs);
    }
    primal_motion_along(x, contact->normal, v);
    for (int k = 0; k < RIGID_MODES; k++) body->sum[k] += to * v[k];
    if (!held) primal_add_along(body, x, contact->normal, stiffness - rubs);
    body->strain += 0.5 * stiffness * depth * depth;
}

/* One Newton step for all bodies that meet something; `strain` is that of the motion before. */
static void push_bodies(Primal *p)
{
    PrimalState *state = &p->world->primal;
    RigidBody *body = state->rigid.data;
    const Colliders *colliders = p->contacts->colliders;
    const uint32_t *begin = colliders->contact_begin.data;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        memcpy(body[i].factor, body[i].inertia, sizeof body[i].factor);
        memcpy(body[i].sum, body[i].motion, RIGID_MODES * sizeof *body[i].sum);
        body[i].strain = 0.0;
    }
    for (int32_t block = 0; block < p->world->grid.node_blocks && colliders->contacts > 0; block++)
        for (uint32_t i = begin[block]; i < begin[block + 1] && primal_rigid_of(p, block)->used; i++)
            add_push(p, block, primal_rigid_of(p, block), (const Contact *)colliders->contact.data + i);
}

static void fit_bodies(Primal *p)
{
    PrimalState *state = &p->world->primal;
    RigidBody *body = state->rigid.data;
    primal_over_blocks(p, sum_predicted);
    primal_gather_rigid(p, 2 * RIGID_MODES);
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        if (!body[i].turns) continue;
        memcpy(body[i].inertia, body[i].mass, sizeof body[i].inertia);
        primal_weigh_turns(body[i].sum + RIGID_MODES, body[i].inertia); /* what is thrown inside out keeps that of small motions */
        memcpy(body[i].motion, body[i].sum, sizeof body[i].motion);
        memcpy(body[i].factor, body[i].inertia, sizeof body[i].factor);
        primal_factorise(&body[i]);
        primal_solve_modes(&body[i], body[i].start);
    }
    bool moves = p->rigid;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) body[i].shifts = body[i].used;
    for (int round = 0; round < ROUNDS && moves; round++) {
        push_bodies(p);
        moves = false;
        for (int32_t i = 0; i < p->world->grid.bodies; i++) {
            double next[RIGID_MODES];
            if (!body[i].shifts) continue;
            primal_factorise(&body[i]);
            primal_solve_modes(&body[i], next);
            body[i].shifts = false;
            for (int k = 0; k < RIGID_MODES; k++) body[i].shifts = body[i].shifts || fabs(next[k] - body[i].start[k]) > FOUND;
            memcpy(body[i].start, next, sizeof next);
            moves = moves || body[i].shifts;
        }
    }
    push_bodies(p);
}

/* What the start costs more than the rigid motion, of sum m/2 |u - u*|^2. */
static void sum_start(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const RigidBody *body = primal_rigid_of(p, block);
    double corner[3], x[3], u[3];
    if (!body->turns) return;
    primal_corner(p, block, body, corner);
    for (size_t i = begin; i < end; i += W) {
        if (p->base[i + 3] == 0.0f) continue;
        primal_arm(corner, (i - begin) / W, x);
        primal_move_rigidly(body->start, x, u);
        for (size_t c = 0; c < 3; c++) {
            const double free = (double)p->base[i + c], away = (double)p->best[i + c] - free;
            sum[0] += 0.5 * (double)p->base[i + 3] * (away * away - (u[c] - free) * (u[c] - free));
        }
    }
}

void primal_write_rigid(Primal *p, int32_t block, size_t begin, size_t end, float *node)
{
    const RigidBody *body = primal_rigid_of(p, block);
    double corner[3], x[3], u[3];
    primal_corner(p, block, body, corner);
    for (size_t i = begin; i < end; i += W) {
        if (p->base[i + 3] == 0.0f) continue;
        primal_arm(corner, (i - begin) / W, x);
        primal_move_rigidly(body->start, x, u);
        for (size_t c = 0; c < 3; c++) node[i + c] = (float)u[c];
    }
}

/* After add_strain(). */
static bool starts_rigidly(const Primal *p, int32_t body)
{
    const RigidBody *of = (const RigidBody *)p->world->primal.rigid.data + body;
    return of->turns && of->sum[0] > 0.0;
}

static void start_rigidly(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    (void)sum;
    memcpy(p->node + begin, p->best + begin, (end - begin) * sizeof *p->node);
    if (!starts_rigidly(p, body_of_block(&p->world->grid, block))) return;
    primal_write_rigid(p, block, begin, end, p->node);
    constraints_project(p->contacts, p->node, block, block + 1);
}

/* What the start stretches beside what was stretched, and the rigid motion at contacts. Only bodies without liquid ask, which have no couples. */
static void add_strain(Primal *p)
{
    const float *energy = p->world->primal.block_energy.data;
    RigidBody *body = p->world->primal.rigid.data;
    for (int32_t block = 0; block < p->world->grid.particle_blocks; block++) {
        const float *e = energy + K_ENERGIES * block;
        primal_rigid_of(p, block)->sum[0] += (double)e[0] + (double)e[1] - (double)e[2] - (double)e[3];
    }
    for (int32_t i = 0; i < p->world->grid.bodies; i++) body[i].sum[0] -= body[i].strain;
}

void primal_choose_start(Primal *p)
{
    bool any = false;
    fit_bodies(p);
    primal_over_blocks(p, sum_start);
    primal_gather_rigid(p, 1);
    add_strain(p);
    for (int32_t i = 0; i < p->world->grid.bodies; i++) any = any || starts_rigidly(p, i);
    if (!any) return;
    primal_over_blocks(p, start_rigidly);
    primal_evaluate(p);
    primal_accept(p, starts_rigidly);
}
