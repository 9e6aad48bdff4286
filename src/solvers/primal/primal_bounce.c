/* Bounces of elastic bodies.
 *
 * Backward Euler takes energy from whatever changes its velocity: a ball that is stopped and thrown back within ten substeps gets back a quarter of its
 * speed. What a substep lost, E, is known per body: energy before and work, less energy after and what friction took. While a body is pushed its
 * velocities get it back along their change: v + s (v - v*), v* those of the predictor, with
 *
 *     s^2/2 sum m |u - u*|^2 + s (sum m u.(u - u*) - W) = E,
 *
 * W the work of moving surfaces in the substep: what contacts give more does that much more. So E and s are the same for one who moves along. The smaller root: a body that
 * is slowed is slowed less, one that is thrown back is thrown more. All forces count 1 + s times, those of contacts too, so momentum is kept and impulses stay exact. No
 * body has more energy than before. The energy is convex in s, so less than s is no more, and a body gets as much as leaves all of its particles within max_displacement. */
#include <math.h>
#include <string.h>

#include "contact/contact_constraints.h"
#include "solvers/primal/primal.h"
#include "solvers/primal/primal_solve.h"
#include "solvers/primal/primal_yield.h"
#include "world/sleep_rows.h"

static const double IMPACT = 2.0;   /* times its load, see load_of(): what pushes a body less carries it, or it rolls; by trial */
static const double RECEDES = 30.0; /* by trial: what lost so much more than its motion along the push has was thrown back, not slowed */
static const double MOST = 1.0;     /* of the change: the velocity at the end of a step whose mean is that of the solution */

enum { STORED = 7 + EXCHANGE_SUMS, BOUNCE_SUMS = STORED + 1 };

/* The most that matter gives back of a blow [J/kg]: what it stores when it yields. Steps longer than the blow do not see it yield, and would throw clay back as if it
 * were rubber. Pressed along one axis, with free sides, by s: |dev e| = yield_strain, and the energy s^2 / 2 E is
 *     3D: e = (1, -nu, -nu) s / E:          3/2 mu yield_strain^2 / (1 + nu),
 *     2D: E / (1 - nu^2) in place of E:     2 (1 - nu) mu yield_strain^2. */
static double stored_by(const pbmpm_material_def *def, int dimension)
{
    const double nu = (double)def->poisson_ratio, shear = lame_of((double)def->young_modulus, nu).mu, strain = (double)def->yield_strain;
    if (def->kind != PBMPM_VISCO) return INFINITY;
    return (dimension == 3 ? 1.5 / (1.0 + nu) : 2.0 * (1.0 - nu)) * shear * strain * strain / (double)def->density;
}

/* The same of a block, in the units of the sums. */
static double sum_stored(const World *world, int32_t block)
{
    const Grid *grid = &world->grid;
    const uint32_t *run = grid->block_run.data;
    double sum = 0.0;
    if (block >= grid->particle_blocks) return sum;
    for (uint32_t r = run[block]; r < run[block + 1]; r++) {
        const double most = stored_by(&world->materials.def[grid->run_key[r] >> K_RUN_CELL_BITS], grid->dimension);
        for (uint32_t row = grid->run_begin[r]; row < grid->run_begin[r + 1]; row++) sum += (double)world->particles.mass[row] * most;
    }
    return sum / (world->substep.to_velocity * world->substep.to_velocity);
}

static void sum_change(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const float *before = p->world->args.grid.node_before;
    if (!primal_rigid_of(p, block)->bounces) return;
    for (size_t i = begin; i < end; i += W) {
        const double mass = (double)p->base[i + 3];
        for (size_t c = 0; c < 3; c++) {
            const double u = (double)p->best[i + c], change = u - (double)p->base[i + c], force = (double)p->base[i + c] - (double)before[i + c];
            sum[0] += mass * change * change;
            sum[1] += mass * u * change;
            sum[2] += mass * fabs(force);
            sum[4 + c] += mass * change;
        }
    }
    ContactExchange exchange = {0};
    constraints_exchange(p->contacts, p->gradient, p->best, p->slip_min, block, &exchange);
    memcpy(sum + 7, &exchange, sizeof exchange);
    sum[STORED] = sum_stored(p->world, block);
    sum[3] = constraints_friction_loss(p->contacts, p->best, p->slip_min, block);
}

static ContactExchange exchange_of(const double *sum)
{
    ContactExchange all;
    memcpy(&all, sum + 7, sizeof all);
    return all;
}

/* What a body bears at rest: its weight, and what contacts push against each other where it is squeezed. That changes no momentum, it is half of what sizes add up to
 * beyond their sum. Were it not counted, what is squeezed without gravity would swing for ever, and push with up to twice its force. */
static double load_of(const RigidBody *body, const float *g)
{
    const ContactExchange all = exchange_of(body->sum);
    const double given = sqrt(all.given[0] * all.given[0] + all.given[1] * all.given[1] + all.given[2] * all.given[2]);
    return body->mass[0][0] * sqrt((double)(g[0] * g[0] + g[1] * g[1] + g[2] * g[2])) + 0.5 * fmax(0.0, all.size - given);
}

/* Alone with a rigid body that yields, matter shares what both lost with it: its impulses count 1 + s times, too. */
static void find_bounce(RigidBody *body, const BodySum *of, const float *g, const YieldBounce *other)
{
    const ContactExchange all = exchange_of(body->sum);
    const double load = IMPACT * load_of(body, g), *push = body->sum + 4, *sum = body->sum;
    const double work = constraints_exchanged_work(&all, push), gave = other ? other->lost : work, lost = fmin(sum[STORED], of->before + gave - of->after - sum[3]);
    if (other) body->sum[0] += other->square;
    body->sum[1] += other ? other->along : -work;
    body->bounce = 0.0;
    if (push[0] * push[0] + push[1] * push[1] + push[2] * push[2] < load * load) return;
    if (!(lost > 0.0) || !(sum[0] > 0.0) || sum[2] > 0.0) return; /* other forces are not known to the particles */
    const double root = sqrt(sum[1] * sum[1] + 2.0 * sum[0] * lost);
    const bool turns_back = sum[1] >= 0.0 || 2.0 * sum[0] * lost > RECEDES * sum[1] * sum[1];
    body->bounce = (turns_back ? root - sum[1] : -sum[1] - root) / sum[0];
    body->bounce = fmin(fmax(body->bounce, -MOST), MOST);
}

void primal_find_bounces(Primal *p)
{
    const PrimalState *state = &p->world->primal;
    RigidBody *body = state->rigid.data;
    const BodySum *of = state->body_sums.data;
    p->bounces = false;
    for (int32_t i = 0; i < p->world->grid.bodies; i++) {
        body[i].bounce = 0.0;
        body[i].bounces = of[i].touches && !of[i].with_liquid && !of[i].held && !body[i].multistep && body[i].kept == 1.0;
        YieldBounce other;
        if (primal_yield_presses(p, i) && !primal_yield_bounce(p, i, &other)) body[i].bounces = false; /* what more than two lost is not known */
        p->bounces = p->bounces || body[i].bounces;
    }
    p->world->primal.bounces = p->bounces;
    if (!p->bounces) return;
    primal_over_blocks(p, sum_change);
    primal_gather_rigid(p, BOUNCE_SUMS);
    for (int32_t i = 0; i < p->world->grid.bodies; i++)
        if (body[i].bounces) {
            YieldBounce other;
            find_bounce(&body[i], &of[i], p->world->args.gravity, primal_yield_bounce(p, i, &other) ? &other : NULL);
        }
}

/* ---- What particles may get ---- */

double primal_fastest(const World *world)
{
    return (double)world->settings.max_displacement * (double)world->def.cell_size / world->substep.dt;
}

/* a q^2 + 2 b q = limit^2 - v^2, the larger root. */
double primal_share_within(const double v[3], const double more[3], double limit)
{
    double a = 0.0, b = 0.0, v2 = 0.0;
    for (int c = 0; c < 3; c++) {
        a += more[c] * more[c];
        b += more[c] * v[c];
        v2 += v[c] * v[c];
    }
    const double room = fmax(0.0, limit * limit - v2);
    if (a + 2.0 * b <= room) return 1.0;
    return fmin(1.0, fmax(0.0, (sqrt(b * b + a * room) - b) / a));
}

typedef struct ShareJob {
    World *world;
    BlockShare *find;
} ShareJob;

static void find_shares(void *context, int32_t begin, int32_t end)
{
    const ShareJob *job = context;
    World *world = job->world;
    const RigidBody *bodies = world->primal.rigid.data;
    const int32_t *of_block = world->grid.body.data;
    const uint32_t *clamped = grid_counts(&world->grid, GRID_CLAMPED);
    double *share = world->primal.sums.data;
    for (int32_t block = begin; block < end; block++) {
        share[block] = 1.0;
        if (sleep_is_still(world, block)) continue;
        share[block] = clamped[block] > 0 ? 0.0 : job->find(world, &bodies[of_block[block]], block);
    }
}

void primal_find_shares(World *world, BlockShare *find)
{
    ShareJob job = {world, find};
    RigidBody *bodies = world->primal.rigid.data;
    const int32_t *of_block = world->grid.body.data;
    const double *share = world->primal.sums.data;
    pool_for(world->pool, world->grid.particle_blocks, 8, find_shares, &job);
    for (int32_t i = 0; i < world->grid.bodies; i++) bodies[i].share = 1.0;
    for (int32_t block = 0; block < world->grid.particle_blocks; block++) {
        RigidBody *body = &bodies[of_block[block]];
        body->share = fmin(body->share, share[block]);
    }
}

static double share_of_bounce(World *world, const RigidBody *body, int32_t block)
{
    const uint32_t *rows = world->grid.block_begin.data;
    const Particles *p = &world->particles;
    const double fastest = primal_fastest(world);
    double share = 1.0, v[3] = {0}, more[3] = {0};
    for (uint32_t row = rows[block]; row < rows[block + 1] && body->bounce != 0.0; row++) {
        for (int a = 0; a < p->dimension; a++) {
            v[a] = (double)p->velocity[a][row];
            more[a] = body->bounce * (v[a] - (double)particles_spare(p, CLASS_MATRIX, a)[row]);
        }
        share = fmin(share, primal_share_within(v, more, fastest));
    }
    return share;
}

/* ---- Particles ---- */

/* The velocities before they move lie where nothing else is between two substeps' orders. */
static void each_velocity(World *world, int32_t begin, int32_t end, bool keep)
{
    const RigidBody *bodies = world->primal.rigid.data;
    const int32_t *of_block = world->grid.body.data;
    const uint32_t *rows = world->grid.block_begin.data;
    Particles *p = &world->particles;
    const float fall = (float)world->substep.dt;
    for (int32_t block = begin; block < end; block++) {
        const float bounce = (float)bodies[of_block[block]].bounce;
        if (bounce == 0.0f || sleep_is_still(world, block)) continue;
        for (int a = 0; a < p->dimension; a++) {
            float *kept = particles_spare(p, CLASS_MATRIX, a), *v = p->velocity[a];
            for (uint32_t row = rows[block]; row < rows[block + 1]; row++) {
                if (keep)
                    kept[row] = v[row] + fall * world->settings.gravity[a];
                else
                    v[row] += bounce * (v[row] - kept[row]);
            }
        }
    }
}

static void keep_velocities(void *context, int32_t begin, int32_t end) { each_velocity(context, begin, end, true); }
static void bounce_blocks(void *context, int32_t begin, int32_t end) { each_velocity(context, begin, end, false); }

void primal_before_going(World *world)
{
    if (world->primal.bounces) pool_for(world->pool, world->grid.particle_blocks, 8, keep_velocities, world);
}

void primal_bounce(World *world, const ContactFrame *contacts)
{
    RigidBody *bodies = world->primal.rigid.data;
    const int32_t *of_block = world->grid.body.data;
    if (!world->primal.bounces) return;
    primal_find_shares(world, share_of_bounce);
    for (int32_t i = 0; i < world->grid.bodies; i++) bodies[i].bounce *= bodies[i].share;
    for (int32_t block = 0; block < world->grid.node_blocks; block++) constraints_scale_impulses(contacts, block, 1.0 + bodies[of_block[block]].bounce);
    pool_for(world->pool, world->grid.particle_blocks, 8, bounce_blocks, world);
}
