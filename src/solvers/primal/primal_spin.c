/* Rotation without the chord's loss.
 *
 * A step takes points along chords: the stress P F^T at F' = (I + D) F is symmetric for small D only, so inner forces have a torque, and a stiff body that
 * turns by t per substep loses the share 1 - cos t of its angular momentum. Inner forces T_i have none, whatever the stiffness: after particles have
 * moved the body gets back sum_i x_i x T_i, as a rigid rotation, for no more energy than the substep lost, which less of it does not exceed: as much as
 * leaves all of its particles within max_displacement. */
#include <math.h>
#include <string.h>

#include "contact/contact_constraints.h"
#include "solvers/primal/primal_solve.h"
#include "world/sleep_rows.h"

static const double ROUNDING = 1e-7; /* [radians per substep]: less would not change a velocity */

/* Angular momentum of the motion, the torque of inner forces, and momentum, about the bodies' centres. */
static void sum_torque(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    double corner[3], x[3];
    const RigidBody *body = primal_rigid_of(p, block);
    const float *inverse = p->world->primal.inverse.data;
    float *inner = p->right;
    if (!body->turns || body->multistep) return;
    memcpy(inner + begin, p->gradient + begin, (end - begin) * sizeof *inner);
    if (p->rubs) constraints_friction(p->contacts, p->best, inner, -1.0f, p->slip_min, block);
    primal_corner(p, block, body, corner);
    for (size_t i = begin; i < end; i += W) {
        double motion[3], force[3];
        const double mass = (double)p->base[i + 3];
        primal_arm(corner, (i - begin) / W, x);
        for (size_t c = 0; c < 3; c++) {
            motion[c] = mass * (double)p->best[i + c];
            force[c] = (double)inner[i + c] - mass * ((double)p->best[i + c] - (double)p->base[i + c]);
            sum[6 + c] += motion[c];
        }
        for (int a = 0; a < 3; a++) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            sum[a] += x[b] * motion[c] - x[c] * motion[b];
            sum[3 + a] += x[b] * force[c] - x[c] * force[b];
        }
        if (inverse[i / W] > 0.0f) sum[15] += 1.0 / (double)inverse[i / W] - mass;
        for (int a = 0; a < 3; a++) x[a] += (double)p->best[i + (size_t)a];
        for (int a = 0; a < 3; a++) {
            sum[9 + a] += mass * x[a] * x[a];
            sum[12 + a] += mass * x[(a + 1) % 3] * x[(a + 2) % 3];
        }
    }
}

/* The solution of I w = l for the tensor of inertia in m[3..5][3..5]; a body without breadth about an axis gets none. */
static void turn_by(const double m[RIGID_MODES][RIGID_MODES], const double l[3], double w[3])
{
    double cofactor[3][3], least = 0.0, determinant = 0.0;
    for (int r = 0; r < 3; r++) {
        const int r1 = 3 + (r + 1) % 3, r2 = 3 + (r + 2) % 3;
        least = fmax(least, m[3 + r][3 + r]);
        for (int c = 0; c < 3; c++) {
            const int c1 = 3 + (c + 1) % 3, c2 = 3 + (c + 2) % 3;
            cofactor[r][c] = m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
        }
    }
    for (int c = 0; c < 3; c++) determinant += m[3][3 + c] * cofactor[0][c];
    for (int r = 0; r < 3; r++) {
        w[r] = 0.0;
        for (int c = 0; c < 3 && determinant > 1e-9 * least * least * least; c++) w[r] += cofactor[c][r] * l[c] / determinant;
    }
}

/* Of a body that is pushed a few iterations do not say the torque of inner forces. Chords take w / sqrt(1 - w^2) - w from a rotation w if they may not
 * shrink the body, which they do by w^2 / 2: as far as it withstands, k / (1 + k) with k its stiffness against that over its inertia. */
static void chord_spin(const RigidBody *body, const double l[3], double spin[3])
{
    const double *m = &body->mass[3][3], inertia = 0.5 * (m[0] + m[RIGID_MODES + 1] + m[2 * (RIGID_MODES + 1)]);
    const double withstands = body->sum[15] / (body->sum[15] + 6.0 * inertia); /* sum k: 3/2 of the second derivative, and energies are a fourth of it */
    double w[3], square = 0.0;
    turn_by(body->mass, l, w);
    for (int a = 0; a < 3; a++) square += w[a] * w[a];
    const double lost = 1.0 / sqrt(fmax(1e-2, 1.0 - square)) - 1.0;
    for (int a = 0; a < 3; a++) spin[a] = withstands * lost * w[a];
}

/* The tensor of inertia where the nodes arrive. That of the particles is not larger: no spin costs more than what follows from it. */
static void weigh_arrived(RigidBody *body)
{
    const double mass = body->mass[0][0];
    double way[3], square[3];
    for (int a = 0; a < 3; a++) way[a] = body->sum[6 + a] / mass;
    for (int a = 0; a < 3; a++) square[a] = fmax(0.0, body->sum[9 + a] - mass * way[a] * way[a]);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        body->mass[3 + a][3 + a] = square[b] + square[c];
        body->mass[3 + b][3 + c] = body->mass[3 + c][3 + b] = mass * way[b] * way[c] - body->sum[12 + a];
        body->arrives[a] = body->centre[a] + way[a];
    }
}

/* The rotation that the body gets back, from the sums above. */
static void find_spin(RigidBody *body, const BodySum *of)
{
    const double *l = body->sum, *lost = body->sum + 3, room = of->before + of->work - of->after;
    weigh_arrived(body);
    double gain = 0.0;
    if (of->meets)
        chord_spin(body, l, body->spin);
    else
        turn_by(body->mass, lost, body->spin);
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) gain += 0.5 * body->spin[a] * body->mass[3 + a][3 + b] * body->spin[b];
    for (int a = 0; a < 3; a++) gain += body->spin[a] * l[a];
    const double share = gain <= 0.0 ? 1.0 : fmin(1.0, fmax(0.0, room) / gain);
    for (int a = 0; a < 3; a++) body->spin[a] *= share;
}

void primal_find_spin(Primal *p)
{
    const PrimalState *state = &p->world->primal;
    RigidBody *body = state->rigid.data;
    const BodySum *of = state->body_sums.data;
    primal_over_blocks(p, sum_torque);
    primal_gather_rigid(p, 16);
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        memset(body[i].spin, 0, sizeof body[i].spin);
        if (body[i].turns && !body[i].multistep && body[i].mass[0][0] > 0.0) find_spin(&body[i], &of[i]);
        body[i].turns = body[i].turns && (body[i].kept < 1.0 || fabs(body[i].spin[0]) + fabs(body[i].spin[1]) + fabs(body[i].spin[2]) > ROUNDING);
    }
}

/* What a particle keeps of its velocity, and what the rotation w adds: w x r. */
static void turned(const World *world, const RigidBody *body, uint32_t row, double kept[3], double turn[3])
{
    const Particles *p = &world->particles;
    const double dt = world->substep.dt, dx = (double)world->def.cell_size;
    double r[3] = {0};
    for (int a = 0; a < p->dimension; a++) r[a] = (double)(p->cell[a][row] - world->grid.anchor[a]) + (double)p->fraction[a][row] - body->arrives[a];
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        const double mean = body->mean[a] * dx / dt, v = a < p->dimension ? (double)p->velocity[a][row] : 0.0;
        kept[a] = body->kept < 1.0 ? mean + body->kept * (v - mean) : v;
        turn[a] = (body->spin[b] * r[c] - body->spin[c] * r[b]) * dx / dt;
    }
}

/* How fast a block's particles can be at most [cells per substep], without a look at each: |v| + |w| |r|, where only v that their way became is known. */
static double fastest_turned(const World *world, const RigidBody *body, int32_t block)
{
    const int32_t *place = (const int32_t *)world->grid.coordinate.data + 3 * block;
    const double *w = body->spin, way = (double)((const float *)world->grid.travel.data)[block], half = 0.5 * K_BLOCK_AXIS;
    double middle2 = 0.0, mean2 = 0.0;
    for (int a = 0; a < world->particles.dimension; a++) {
        const double middle = (double)(place[a] * K_BLOCK_AXIS) + half - 0.5 - body->arrives[a]; /* nearest nodes are 0 to K_BLOCK_AXIS - 1 */
        middle2 += middle * middle;
        mean2 += body->mean[a] * body->mean[a];
    }
    const double arm = sqrt(middle2) + sqrt(3.0) * half + way;
    return (body->kept < 1.0 ? fmax(way, sqrt(mean2)) : way) + arm * sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
}

static double share_of_turn(World *world, const RigidBody *body, int32_t block)
{
    const uint32_t *begin = world->grid.block_begin.data;
    const double fastest = primal_fastest(world);
    double share = 1.0, kept[3], turn[3];
    const bool known = !body->multistep && body->bounce == 0.0;
    if (known && fastest_turned(world, body, block) < (double)world->settings.max_displacement) return 1.0;
    for (uint32_t row = begin[block]; row < begin[block + 1] && body->turns; row++) {
        turned(world, body, row, kept, turn);
        share = fmin(share, primal_share_within(kept, turn, fastest));
    }
    return share;
}

/* Slowed particles have not the mean motion of the nodes: they pay as against rest, and the body has less energy than it may have. */
static void limit_turns(World *world)
{
    RigidBody *body = world->primal.rigid.data;
    primal_find_shares(world, share_of_turn);
    for (int32_t i = 0; i < world->grid.bodies; i++)
        for (int a = 0; a < 3 && body[i].turns; a++) {
            body[i].spin[a] *= body[i].share;
            if (body[i].share == 0.0) body[i].mean[a] = 0.0;
        }
}

/* v += w x r, C += [w]x, of the share of v - mean and C that the body keeps. */
static void turn_block(World *world, const RigidBody *body, int32_t block)
{
    static const int next[3] = {1, 2, 0}, last[3] = {2, 0, 1};
    const uint32_t *begin = world->grid.block_begin.data;
    Particles *p = &world->particles;
    const int dimension = p->dimension;
    const double dt = world->substep.dt;
    for (uint32_t row = begin[block]; row < begin[block + 1]; row++) {
        double kept[3], turn[3];
        turned(world, body, row, kept, turn);
        for (int a = 0; a < dimension; a++) {
            p->velocity[a][row] = (float)(kept[a] + turn[a]);
            for (int c = 0; c < dimension && body->kept < 1.0; c++) p->affine[a * 3 + c][row] *= (float)body->kept;
            if (last[a] < dimension) p->affine[a * 3 + last[a]][row] += (float)(body->spin[next[a]] / dt);
            if (next[a] < dimension) p->affine[a * 3 + next[a]][row] -= (float)(body->spin[last[a]] / dt);
        }
    }
}

static void turn_blocks(void *context, int32_t begin, int32_t end)
{
    World *world = context;
    const RigidBody *bodies = world->primal.rigid.data;
    const int32_t *of_block = world->grid.body.data;
    for (int32_t block = begin; block < end; block++)
        if (bodies[of_block[block]].turns && !sleep_is_still(world, block)) turn_block(world, &bodies[of_block[block]], block);
}

void primal_turn(World *world)
{
    const RigidBody *body = world->primal.rigid.data;
    bool any = false;
    for (int32_t i = 0; i < world->grid.bodies; i++) any = any || body[i].turns;
    if (!any) return;
    limit_turns(world);
    pool_for(world->pool, world->grid.particle_blocks, 8, turn_blocks, world);
}
