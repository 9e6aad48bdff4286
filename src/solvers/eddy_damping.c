#include "solvers/eddy_damping.h"

#include <math.h>
#include <string.h>

#include "solvers/dual/dual_gains.h"
#include "solvers/passes.h"
#include "world/depth.h"
#include "world/island_groups.h"

/* (k h)^2 / 4 of eddies of two cells, the smallest that the grid knows: k h = pi / 2. What it does at 60 Hz x 5 (tests/field, standing_wave and still_pool): with
 * 0.2 a wave keeps 0.83 of its height in nine periods, with 0.4 and 0.617 it keeps 0.90, with 1 it keeps 0.94; but with 1 pools that stand turned go on at 16 to
 * 24 mm/s, with less at 4 to 7. */
static const double AFFINE_PART = 0.617;

/* A liquid with a bulk modulus stores energy: what its pressures give back is its own. In the joint solver it counts as gain, or it would stir beside a body for ever.
 * What solids give back counts as gain, too: a tank with all materials stirs at 24 to 41 mm/s so, at 42 to 63 where worlds with solids are left out (all_in_a_tank).
 * The price is that liquids beside a body that springs lose some affine velocity. */
static bool all_incompressible(const World *world)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        if (world->particles.of_material[slot] > 0 && def->kind == PBMPM_LIQUID && def->bulk_modulus > 0.0f) return false;
    }
    return true;
}

bool eddy_damping_acts(const World *world) { return solver_uses_dual(world) && (islands_kinds(world) & KIND_LIQUID) && (joint_is_chosen(world) || all_incompressible(world)); }

bool eddy_damping_prepare(World *world)
{
    EddyDamping *damping = &world->dual.eddy_damping;
    if (!eddy_damping_acts(world)) return true;
    return array_reserve(&world->memory, &damping->kept, (size_t)world->grid.particle_blocks, sizeof(float));
}

void eddy_damping_free(World *world) { array_free(&world->memory, &world->dual.eddy_damping.kept); }

float eddy_damping_share(double gain, double kinetic) { return gain > 0.0 ? (float)sqrt(fmax(0.0, 1.0 - gain / fmax(AFFINE_PART * kinetic, gain))) : 1.0f; }

float *eddy_damping_shares(World *world)
{
    float *kept = eddy_damping_acts(world) ? world->dual.eddy_damping.kept.data : NULL;
    world->args.dual.affine_kept = kept;
    return kept;
}

/* ---- Debts ---- */

static uint64_t particles_of_group(const World *world)
{
    uint64_t count = 0;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) count += world->particles.of_material[slot];
    return count;
}

/* The share of a credit that is left after a substep. Matter falls through its depth in sqrt(2 depth / fall) substeps. Without gravity nothing rises, and what is lost
 * does not come back: with credit from its start a block that turned in a full box drove the water to 1.5 times its speed. */
static double credit_kept(const World *world)
{
    const double fall = gravity_fall(world, &world->substep);
    return fall > 0.0 ? exp(-0.5 * sqrt(fall / (2.0 * matter_depth(world)))) : 0.0;
}

double eddy_damping_settle(World *world, const EddyGains *gains)
{
    EddyAccount *account = &world->dual.eddy_damping.account[islands_kinds(world)];
    const uint64_t particles = particles_of_group(world);
    const double unit = solver_joule(world);
    const double carried = account->debt < 0.0 ? credit_kept(world) * account->debt : account->debt;
    account->debt = account->particles == particles ? carried + unit * gains->before - account->left : 0.0;
    account->left = unit * gains->left;
    account->particles = particles;
    return gains->gained > 0.0 ? 1.0 + fmax(0.0, account->debt) / (unit * gains->gained) : 1.0;
}

double eddy_damping_owed(const World *world) { return fmax(0.0, world->dual.eddy_damping.account[islands_kinds(world)].debt) / solver_joule(world); }

void eddy_damping_forget(World *world) { memset(world->dual.eddy_damping.account, 0, sizeof world->dual.eddy_damping.account); }

/* ---- The dual's bodies ---- */

static bool pays(const DualGain *body) { return body->at_obstacle > 0.0 && body->gain > 0.0; }

static float share_of(const DualGain *body, double factor)
{
    double kinetic = body->kinetic;
    if (!pays(body)) return 1.0f;
    for (int c = 0; c < 3; c++) kinetic -= 0.5 * body->momentum[c] * body->momentum[c] / body->mass;
    return eddy_damping_share(factor * body->gain, kinetic);
}

static EddyGains gains_of(const World *world)
{
    EddyGains gains = {0};
    for (int32_t i = 0; i < world->grid.bodies; i++) {
        const DualGain *body = dual_gain(world, i);
        gains.before += body->brought;
        gains.left += body->kinetic - body->gain;
        if (pays(body)) gains.gained += body->gain;
    }
    return gains;
}

void eddy_damping_find(World *world)
{
    float *kept = eddy_damping_shares(world);
    if (!kept) return;
    const EddyGains gains = gains_of(world);
    const double factor = eddy_damping_settle(world, &gains);
    for (int32_t block = 0; block < world->grid.particle_blocks; block++) kept[block] = share_of(dual_gain_in(world, block), factor);
}
