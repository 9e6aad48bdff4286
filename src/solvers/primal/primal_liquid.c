/* What liquids gain in the primal solver.
 *
 * A pressure that was not solved to the end leaves a liquid with more energy than it had, and starting again from less motion would freeze
 * it: nearly every solution of a stiff liquid is unfinished. So particles go where the solution leads, and what their body gained is taken from
 * its kinetic energy: velocities keep the share s of what they differ from the body's mean (of a body that touches something, which takes the
 * momentum: of zero),
 *
 *     s^2 = 1 - gain / kinetic energy,   gain = K(u) - m g.u + Psi(u) - K(u* - g) - Psi(0) - work of moving surfaces.
 *
 * A solution that gained more than its kinetic energy is given up for the body's start. In the joint solver pressures are the dual's, and eddies pay for what
 * they gain: eddy_damping.h. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "contact/contact_constraints.h"
#include "solvers/eddy_damping.h"
#include "solvers/passes.h"
#include "solvers/primal/primal.h"
#include "solvers/primal/primal_solve.h"
#include "world/depth.h"
#include "world/island_groups.h"
#include "world/sleep_rows.h"

/* The share by which weight compresses the bottom of a pool at most where it stands for an incompressible one. The level is too low by half of it. The stiffer it is, the less
 * of the iterations is left to solids in it: a jelly that hangs into water is 1 % off at 60 Hz x 5 with 0.02, 3 % too stiff with 0.01, 8 with 0.005. By trial. */
static const double WEIGHT_SQUEEZES = 0.02;

bool primal_is_mixed(const World *world)
{
    const uint32_t both = KIND_SOLID | KIND_LIQUID;
    return (islands_kinds(world) & both) == both;
}

/* c K with K = rho g H / WEIGHT_SQUEEZES and c = 4 dt^2 / (dx^2 rho), or what the iterations hold in any liquid. */
float primal_liquid_dilation(const World *world, const Substep *substep)
{
    const double fall = gravity_fall(world, substep);
    const double weight = fall > 0.0 && solver_holds_liquid(world) ? 4.0 * fall * liquid_depth(world) / WEIGHT_SQUEEZES : 0.0;
    return fmaxf(primal_stiffest(world->settings.iterations), (float)fmin(weight, 1e30));
}

static const double ROUNDING = 1e-6; /* of the energy before, that no velocity has to pay for */

/* The mean displacement that is left alone: primal_keep_momentum() gives that of the predictor to a body that leans on nothing. */
static double mean_of(const BodySum *body, int axis)
{
    if (!(body->mass > 0.0)) return 0.0;
    if (body->touches) return 0.0;
    return body->leans ? body->moved[axis] / body->mass : body->start[axis];
}

static double gain_of(const BodySum *body) { return body->after - body->before - body->work; }

/* Notes what the body keeps. False: its kinetic energy does not make up for what it gained. */
static bool find_share(BodySum *body)
{
    double kinetic = body->kinetic;
    const double gain = gain_of(body);
    for (int c = 0; c < 3; c++) kinetic -= 0.5 * body->mass * mean_of(body, c) * mean_of(body, c);
    body->kept = gain > 0.0 && kinetic > 0.0 ? (float)sqrt(fmax(0.0, 1.0 - gain / kinetic)) : 1.0f;
    return gain <= fmax(kinetic, 0.0) + ROUNDING * body->before;
}

static bool all_can_pay(Primal *p)
{
    BodySum *body = p->world->primal.body_sums.data;
    bool can = true;
    primal_check_bodies(p);
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        body[i].kept = 1.0f;
        body[i].failed = body[i].with_liquid && !find_share(&body[i]);
        for (int c = 0; c < 3; c++) body[i].mean[c] = (float)mean_of(&body[i], c);
        can = can && !body[i].failed;
    }
    return can;
}

/* Volume feedback that lowers J stores energy that nothing paid for, and later substeps turn it into motion: a column that slumped gained 1.5 % by it.
 * What it brings back is volume that was lost, with the energy that went with it: so in all it may store what solutions have lost. */
static void earn(Primal *p)
{
    const BodySum *body = p->world->primal.body_sums.data;
    double lost = 0.0;
    for (int32_t i = 0; i < p->world->grid.bodies; i++)
        if (body[i].with_liquid) lost += fmax(0.0, body[i].before + body[i].work - body[i].after);
    p->world->primal.credit += lost * solver_joule(p->world);
    p->world->args.primal.may_feed = p->world->primal.credit > 0.0;
}

static void spend(World *world)
{
    const float *fed = world->primal.fed.data;
    double sum = 0.0;
    for (int32_t block = 0; block < world->grid.particle_blocks; block++)
        if (!sleep_is_still(world, block)) sum += (double)fed[block];
    world->primal.credit -= sum * solver_joule(world);
}

/* The joint solver's liquids: what they gain is taken from their eddies, as the dual's. Particles keep their velocities. */
static void damp_eddies(Primal *p)
{
    BodySum *bodies = p->world->primal.body_sums.data;
    float *kept = eddy_damping_shares(p->world);
    EddyGains gains = {0};
    primal_check_bodies(p);
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        bodies[i].kept = 1.0f;
        gains.before += bodies[i].before;
        gains.left += bodies[i].before + bodies[i].work + bodies[i].fallen;
        if (bodies[i].meets) gains.gained += fmax(0.0, gain_of(&bodies[i]));
    }
    const double factor = eddy_damping_settle(p->world, &gains);
    for (int32_t block = 0; kept && block < p->world->grid.particle_blocks; block++) {
        const BodySum *body = primal_body_of(p, block);
        kept[block] = body->meets ? eddy_damping_share(factor * gain_of(body), primal_own_motion(body)) : 1.0f;
    }
}

void primal_find_kept(Primal *p)
{
    if (!solver_holds_liquid(p->world)) return;
    if (p->joint) {
        damp_eddies(p);
        return;
    }
    if (!all_can_pay(p)) {
        primal_pull_back_to(p, 0.0f);
        all_can_pay(p);
    }
    earn(p);
}

static float kept_of(const BodySum *body, int axis, float u)
{
    return body->mean[axis] + body->kept * (u - body->mean[axis]);
}

static void keep_motion(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const BodySum *body = primal_body_of(p, block);
    const bool keeps_all = !body->with_liquid || body->kept == 1.0f;
    (void)sum;
    for (size_t i = begin; i < end; i++) p->right[i] = keeps_all || i % W == 3 ? p->node[i] : kept_of(body, (int)(i % W), p->node[i]);
}

const float *primal_kept_motion(Primal *p)
{
    if (p->joint || !solver_holds_liquid(p->world)) return p->node;
    primal_over_blocks(p, keep_motion);
    return p->right;
}

static void calm_block(World *world, const BodySum *body, int32_t block)
{
    const uint32_t *begin = world->grid.block_begin.data;
    Particles *particles = &world->particles;
    const float to_cells = (float)world->substep.dt * (float)world->substep.cells_per_metre;
    for (int a = 0; a < particles->dimension; a++) {
        for (uint32_t row = begin[block]; row < begin[block + 1]; row++)
            particles->velocity[a][row] = kept_of(body, a, particles->velocity[a][row] * to_cells) / to_cells;
        for (int c = 0; c < particles->dimension; c++)
            for (uint32_t row = begin[block]; row < begin[block + 1]; row++) particles->affine[a * 3 + c][row] *= body->kept;
    }
}

/* The pressure [Pa] that J stands for, p = L J (1 - J): the dual starts from it if it takes over. */
static void note_pressures(World *world, int32_t block)
{
    const Grid *grid = &world->grid;
    const uint32_t *block_run = grid->block_run.data;
    const float *ratio = world->particles.volume_ratio;
    for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++) {
        const KernelMaterial *material = &world->materials.kernel[grid->run_key[run] >> K_RUN_CELL_BITS];
        for (uint32_t row = grid->run_begin[run]; row < grid->run_begin[run + 1] && material->kind == K_LIQUID; row++)
            world->particles.pressure[row] = material->pascal_per_multiplier * material->dilation * ratio[row] * fmaxf(0.0f, 1.0f - ratio[row]);
    }
}

static void calm_blocks(void *context, int32_t begin, int32_t end)
{
    World *world = context;
    const BodySum *bodies = world->primal.body_sums.data;
    const int32_t *of_block = world->grid.body.data;
    for (int32_t block = begin; block < end; block++) {
        const BodySum *body = &bodies[of_block[block]];
        if (body->with_liquid && body->kept < 1.0f) calm_block(world, body, block);
        if (world->args.primal.fed && world->particles.pressure && !sleep_is_still(world, block)) note_pressures(world, block);
    }
}

void primal_calm(World *world, const ContactFrame *contacts)
{
    primal_bounce(world, contacts);
    primal_turn(world);
    if (!solver_holds_liquid(world)) return;
    if (world->args.primal.fed) spend(world);
    pool_for(world->pool, world->grid.particle_blocks, 8, calm_blocks, world);
}
