/* Rigid motions of bodies at obstacles, as a coarse space of the primal solver's preconditioner.
 *
 * Under large stiffness no hat of a level is rigid: a few iterations would find a part of how a stiff body slides. With the rigid motions Z of
 * each body, what contacts hold taken out (Zm), and B the multilevel preconditioner the direction is (R. Nicolaides, "Deflation of conjugate
 * gradients with applications to boundary value problems", SIAM J. Numer. Anal. 24(2), 1987)
 *
 *     zc = Zm A^-1 Zm' r,   z = B (r - H zc),   z += zc - Zm A^-1 Zm' H z,   A = Zm' H Zm + (Z - Zm)' K (Z - Zm),
 *
 * H = M + the stiffness of friction: what a rigid motion costs. K, the nodes' stiffness, is what the jump at held nodes costs. With J_i the motion of
 * node i and P_i = I - n n' what its contact allows, A = Z'MZ + sum over contacts of max(K - M, 0) (J'n)(J'n)' + friction. A symmetric and
 * positive B leaves the whole so. */
#include <math.h>
#include <string.h>

#include "contact/contact_constraints.h"
#include "solvers/primal/primal_solve.h"

enum { BLOCK = K_BLOCK_AXIS };

static const double SINGULAR = 1e-9; /* share of the diagonal that is added to it */

/* Of a block's first node from the anchor [cells]: whole numbers, so a scene that is shifted by cells moves the same. */
static void corner_of(const Primal *p, int32_t block, double corner[3])
{
    const int32_t *place = (const int32_t *)p->world->grid.coordinate.data + 3 * block;
    for (int a = 0; a < 3; a++) corner[a] = a < p->world->grid.dimension ? (double)(place[a] * K_BLOCK_AXIS) : 0.0;
}

void primal_arm(const double corner[3], size_t node, double arm[3])
{
    arm[0] = corner[0] + (double)(node & 3);
    arm[1] = corner[1] + (double)(node >> 2 & 3);
    arm[2] = corner[2] + (double)(node >> 4);
}

RigidBody *primal_rigid_of(const Primal *p, int32_t block)
{
    const PrimalState *state = &p->world->primal;
    return (RigidBody *)state->rigid.data + body_of_block(&p->world->grid, block);
}

/* From the body's centre to the block's first node. */
void primal_corner(const Primal *p, int32_t block, const RigidBody *body, double corner[3])
{
    corner_of(p, block, corner);
    for (int a = 0; a < 3; a++) corner[a] -= body->centre[a];
}

/* ---- What bodies weigh ---- */

static void sum_weights(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    double corner[3], x[3];
    if (!primal_rigid_of(p, block)->turns) return;
    corner_of(p, block, corner);
    for (size_t i = begin; i < end; i += W) {
        const double mass = (double)p->base[i + 3];
        primal_arm(corner, (i - begin) / W, x);
        sum[0] += mass;
        for (int a = 0; a < 3; a++) {
            sum[1 + a] += mass * x[a];
            sum[4 + a] += mass * x[a] * x[a];
            sum[7 + a] += mass * x[(a + 1) % 3] * x[(a + 2) % 3];
        }
    }
}

/* Z'MZ about the centre, from the sums above: mass, and the tensor of inertia. */
static void weigh_body(RigidBody *body)
{
    const double *s = body->sum, mass = fmax(s[0], 1e-30);
    double square[3];
    memset(body->mass, 0, sizeof body->mass);
    for (int a = 0; a < 3; a++) body->centre[a] = s[1 + a] / mass;
    for (int a = 0; a < 3; a++) square[a] = fmax(0.0, s[4 + a] - mass * body->centre[a] * body->centre[a]);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        body->mass[a][a] = mass;
        body->mass[3 + a][3 + a] = square[b] + square[c];
        body->mass[3 + b][3 + c] = body->mass[3 + c][3 + b] = mass * body->centre[b] * body->centre[c] - s[7 + a];
    }
}

/* The sums of the last pass, per body. */
void primal_gather_rigid(Primal *p, int count)
{
    PrimalState *state = &p->world->primal;
    RigidBody *body = state->rigid.data;
    const double *sums = state->sums.data;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) memset(body[i].sum, 0, sizeof body[i].sum);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++) {
        RigidBody *of = primal_rigid_of(p, block);
        for (int k = 0; k < count; k++) of->sum[k] += sums[(size_t)block * SUMS + (size_t)k];
    }
}

void primal_find_rigid(Primal *p)
{
    PrimalState *state = &p->world->primal;
    RigidBody *body = state->rigid.data;
    const BodySum *of = state->body_sums.data;
    p->rigid = false;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        body[i].turns = !of[i].with_liquid && !of[i].held;
        body[i].kept = 1.0;
        body[i].multistep = false;
        body[i].used = of[i].meets && body[i].turns;
        p->rigid = p->rigid || body[i].used;
    }
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++)
        if (primal_is_multistep(p, block)) primal_rigid_of(p, block)->multistep = true;
    primal_over_blocks(p, sum_weights);
    primal_gather_rigid(p, 10);
    for (int32_t i = 0; i < p->world->grid.bodies; i++)
        if (body[i].turns) weigh_body(&body[i]);
}

/* ---- What turns cost ---- */

void primal_sum_products(double mass, const double x[3], const double y[3], double sum[RIGID_MODES])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        sum[a] += mass * x[a] * y[a];
        sum[3 + a] += 0.5 * mass * (x[b] * y[c] + x[c] * y[b]);
    }
}

/* A rotation w of x changes sum m/2 |R x - y|^2 by -w.l + w'H w / 2 + O(w^3): l = sum m x x y, H = tr S - S, S the symmetric part of sum m x y'. H w = l is right to
 * second order. In a plane w is the tangent of the best angle: of y = (1 + a) x + b k x x it is b / (1 + a). With y = x, H is the tensor of inertia, which knows no
 * a. But of what turns by t per substep x + u* has a = -t^2/18 with BDF2, t^2/2 with backward Euler: w is off by t^3/18 or more, and few iterations turn it no
 * further. A stiff disc lost 5 % of its rotation in ten turns at 120 Hz x 10. Where y is x turned inside out no rotation is the best, and H is not positive. */
bool primal_weigh_turns(const double products[RIGID_MODES], double m[RIGID_MODES][RIGID_MODES])
{
    double h[3][3];
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        h[a][a] = products[b] + products[c];
        h[b][c] = h[c][b] = -products[3 + a];
    }
    const double minor = h[0][0] * h[1][1] - h[0][1] * h[0][1];
    const double determinant = h[2][2] * minor - h[0][0] * h[1][2] * h[1][2] - h[1][1] * h[0][2] * h[0][2] + 2.0 * h[0][1] * h[1][2] * h[0][2];
    if (!(h[0][0] > 0.0 && minor > 0.0 && determinant > 0.0)) return false;
    for (int a = 0; a < 3; a++) memcpy(&m[3 + a][3], h[a], sizeof h[a]);
    return true;
}

/* ---- A ---- */

/* J'd: what the motion along d is made of. */
void primal_motion_along(const double arm[3], const float d[3], double out[RIGID_MODES])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        out[a] = (double)d[a];
        out[3 + a] = arm[b] * (double)d[c] - arm[c] * (double)d[b];
    }
}

static void add_square(RigidBody *body, const double v[RIGID_MODES], double factor)
{
    for (int r = 0; r < RIGID_MODES; r++)
        for (int c = 0; c <= r; c++) body->factor[r][c] += factor * v[r] * v[c];
}

void primal_add_along(RigidBody *body, const double arm[3], const float direction[3], double stiffness)
{
    double v[RIGID_MODES];
    primal_motion_along(arm, direction, v);
    add_square(body, v, stiffness);
}

/* What a contact adds: the jump it makes where it holds, and friction along the surface. */
static void add_contact(Primal *p, int32_t block, RigidBody *body, const Contact *contact)
{
    static const float axis[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const size_t node = (size_t)block * (size_t)p->floats + (size_t)contact->node * W;
    const double mass = (double)p->base[node + 3], inverse = (double)((const float *)p->world->primal.inverse.data)[node / W];
    double corner[3], arm[3];
    if (!contact->active || !(inverse > 0.0)) return;
    primal_corner(p, block, body, corner);
    primal_arm(corner, contact->node, arm);
    const double jump = fmax(0.0, 1.0 / inverse - 2.0 * mass); /* K - M */
    const double rubs = constraints_friction_stiffness(contact, p->best + node, p->slip_min);
    const bool held = constraints_stick(contact);
    for (int a = 0; a < 3 && (held || rubs > 0.0); a++) primal_add_along(body, arm, axis[a], held ? jump : rubs);
    if (!held) primal_add_along(body, arm, contact->normal, fmax(jump - rubs, 0.0));
}

/* A = L L', in place. */
void primal_factorise(RigidBody *body)
{
    double(*a)[RIGID_MODES] = body->factor;
    for (int c = 0; c < RIGID_MODES; c++) {
        double d = a[c][c] * (1.0 + SINGULAR);
        for (int k = 0; k < c; k++) d -= a[c][k] * a[c][k];
        a[c][c] = sqrt(fmax(d, SINGULAR * a[c][c] + 1e-30));
        for (int r = c + 1; r < RIGID_MODES; r++) {
            double v = a[r][c];
            for (int k = 0; k < c; k++) v -= a[r][k] * a[c][k];
            a[r][c] = v / a[c][c];
        }
    }
}

void primal_solve_modes(const RigidBody *body, double x[RIGID_MODES])
{
    for (int r = 0; r < RIGID_MODES; r++) {
        x[r] = body->sum[r];
        for (int k = 0; k < r; k++) x[r] -= body->factor[r][k] * x[k];
        x[r] /= body->factor[r][r];
    }
    for (int r = RIGID_MODES - 1; r >= 0; r--) {
        for (int k = r + 1; k < RIGID_MODES; k++) x[r] -= body->factor[k][r] * x[k];
        x[r] /= body->factor[r][r];
    }
}

void primal_weigh_rigid(Primal *p)
{
    PrimalState *state = &p->world->primal;
    RigidBody *body = state->rigid.data;
    const Colliders *colliders = p->contacts->colliders;
    const uint32_t *begin = colliders->contact_begin.data;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) memcpy(body[i].factor, body[i].mass, sizeof body[i].factor);
    for (int32_t block = 0; block < p->world->grid.node_blocks && colliders->contacts > 0; block++)
        for (uint32_t i = begin[block]; i < begin[block + 1] && primal_rigid_of(p, block)->used; i++)
            add_contact(p, block, primal_rigid_of(p, block), (const Contact *)colliders->contact.data + i);
    for (int32_t i = 0; i < p->world->grid.bodies; i++)
        if (body[i].turns) primal_factorise(&body[i]);
}

/* ---- The two corrections ---- */

/* Sums of Z'v of a block, for vectors that keep to what contacts allow. */
void primal_sum_rigid(Primal *p, int32_t block, const float *v, double *sum)
{
    const RigidBody *body = primal_rigid_of(p, block);
    double corner[3];
    if (!body->turns) return;
    float plain[W] = {0}, along[3][W] = {{0}}; /* sums of v, and of v times places in the block */
    const float *node = v;
    for (size_t k = 0; k < (size_t)p->floats / (W * BLOCK * BLOCK); k++)
        for (size_t j = 0; j < BLOCK; j++)
            for (size_t i = 0; i < BLOCK; i++, node += W)
                for (size_t c = 0; c < W; c++) {
                    plain[c] += node[c];
                    along[0][c] += (float)i * node[c];
                    along[1][c] += (float)j * node[c];
                    along[2][c] += (float)k * node[c];
                }
    primal_corner(p, block, body, corner);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        sum[a] += (double)plain[a];
        sum[3 + a] += corner[b] * (double)plain[c] - corner[c] * (double)plain[b] + (double)along[b][c] - (double)along[c][b];
    }
}

/* to = Zm y for the nodes of a block. */
static void write_motion(Primal *p, int32_t block, const RigidBody *body, float *to)
{
    const float *base = p->base + (size_t)block * (size_t)p->floats;
    const double *t = body->motion, *r = body->motion + 3;
    double x[3];
    float first[W] = {0}, step[3][W] = {{0}}; /* of the block's first node, and from one to the next */
    primal_corner(p, block, body, x);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        first[a] = (float)(t[a] + r[b] * x[c] - r[c] * x[b]);
        step[c][a] = (float)r[b];
        step[b][a] = (float)-r[c];
    }
    for (size_t k = 0; k < (size_t)p->floats / (W * BLOCK * BLOCK); k++)
        for (size_t j = 0; j < BLOCK; j++)
            for (size_t i = 0; i < BLOCK; i++, to += W, base += W) {
                const bool has = base[3] > 0.0f;
                for (size_t c = 0; c < W; c++) {
                    const float moved = first[c] + (float)i * step[0][c] + (float)j * step[1][c] + (float)k * step[2][c];
                    to[c] = has ? moved : 0.0f;
                }
            }
}

/* After a pass that summed Z'r. */
void primal_solve_rigid(Primal *p)
{
    RigidBody *body = p->world->primal.rigid.data;
    primal_gather_rigid(p, RIGID_MODES);
    for (int32_t i = 0; i < p->world->grid.bodies; i++)
        if (body[i].turns) primal_solve_modes(&body[i], body[i].motion);
}

/* The block's r -= H zc. */
void primal_deflate(Primal *p, int32_t block, size_t begin, size_t end)
{
    const RigidBody *body = primal_rigid_of(p, block);
    if (!body->used) return;
    write_motion(p, block, body, p->direction + begin);
    constraints_remove(p->contacts, p->direction, block, block + 1);
    for (size_t i = begin; i < end; i += W)
        for (size_t c = 0; c < 3; c++) p->right[i + c] -= p->base[i + 3] * p->direction[i + c];
    constraints_apply_friction_stiffness(p->contacts, p->best, p->direction, p->right, -1.0f, p->slip_min, block);
}

/* Sums of Z'Hz of a block, of z = p->direction; uses p->force. */
void primal_sum_inertia(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    if (!primal_rigid_of(p, block)->used) return;
    for (size_t i = begin; i < end; i += W)
        for (size_t c = 0; c < 3; c++) p->force[i + c] = p->base[i + 3] * p->direction[i + c];
    constraints_apply_friction_stiffness(p->contacts, p->best, p->direction, p->force, 1.0f, p->slip_min, block);
    constraints_remove(p->contacts, p->force, block, block + 1);
    primal_sum_rigid(p, block, p->force + begin, sum);
}

/* After a pass that summed Z'Hz: what is to be added, zc - Zm A^-1 Zm' H z. */
void primal_correct_rigid(Primal *p)
{
    RigidBody *body = p->world->primal.rigid.data;
    primal_gather_rigid(p, RIGID_MODES);
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        double less[RIGID_MODES];
        if (!body[i].used) continue;
        primal_solve_modes(&body[i], less);
        for (int k = 0; k < RIGID_MODES; k++) body[i].motion[k] -= less[k];
    }
}

void primal_add_rigid(Primal *p, int32_t block, size_t begin, size_t end)
{
    const RigidBody *body = primal_rigid_of(p, block);
    if (!body->used) return;
    write_motion(p, block, body, p->force + begin);
    constraints_remove(p->contacts, p->force, block, block + 1);
    for (size_t i = begin; i < end; i++) p->direction[i] += p->force[i];
}
