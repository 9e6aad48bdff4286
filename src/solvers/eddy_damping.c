#include "solvers/eddy_damping.h"

#include <math.h>
#include <string.h>

#include "contact/walls.h"
#include "solvers/passes.h"
#include "world/depth.h"
#include "world/island_groups.h"

enum { GAIN, BEFORE, KINETIC, MASS, MOMENTUM, AT_OBSTACLE = MOMENTUM + 3, SUMS, BLOCK_GRAIN = 8, W = K_NODE_WIDTH };

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

static bool is_wanted(const World *world) { return solver_uses_dual(world) && (islands_kinds(world) & KIND_LIQUID) && (joint_is_chosen(world) || all_incompressible(world)); }

bool eddy_damping_prepare(World *world)
{
    EddyDamping *damping = &world->dual.eddy_damping;
    if (!is_wanted(world)) return true;
    if (!array_reserve(&world->memory, &damping->kept, (size_t)world->grid.particle_blocks, sizeof(float))) return false;
    if (joint_is_chosen(world)) return true; /* the primal's bodies and sums serve */
    return bodies_find(&damping->bodies, &world->memory, &world->grid) &&
           array_reserve(&world->memory, &damping->sums, SUMS * (size_t)world->grid.node_blocks, sizeof(double)) &&
           array_reserve(&world->memory, &damping->body_sums, SUMS * (size_t)world->grid.node_blocks, sizeof(double));
}

void eddy_damping_free(World *world)
{
    EddyDamping *damping = &world->dual.eddy_damping;
    bodies_free(&damping->bodies, &world->memory);
    Array *arrays[] = {&damping->sums, &damping->body_sums, &damping->kept};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(&world->memory, arrays[i]);
}

static bool is_at_obstacle(const World *world, int32_t block)
{
    const Colliders *colliders = &world->colliders;
    const uint32_t *begin = colliders->contact_begin.data;
    if (colliders->contacts > 0 && begin[block + 1] > begin[block]) return true;
    return walls_any(&world->walls) && ((const uint64_t *)world->walls.marked.data)[block] != 0;
}

static void sum_block(const World *world, int32_t block, double *sum)
{
    const size_t floats = (size_t)world->grid.block_cells * W, start = (size_t)block * floats;
    const float *node = (const float *)world->grid.node.data + start, *push = world->args.dual.node_push + start, *before = world->args.grid.node_before + start;
    memset(sum, 0, SUMS * sizeof *sum);
    sum[AT_OBSTACLE] = is_at_obstacle(world, block) ? 1.0 : 0.0;
    for (size_t i = 0; i < floats; i += W) {
        const double mass = (double)node[i + 3];
        if (mass == 0.0) continue;
        sum[MASS] += mass;
        for (size_t c = 0; c < 3; c++) {
            const double u = (double)node[i + c], brought = (double)before[i + c] - (double)world->args.gravity[c], away = u - brought;
            sum[BEFORE] += 0.5 * mass * brought * brought;
            sum[GAIN] += (double)push[i + c] * u - 0.5 * mass * away * away;
            sum[KINETIC] += 0.5 * mass * u * u;
            sum[MOMENTUM + c] += mass * u;
        }
    }
}

static void sum_blocks(void *context, int32_t begin, int32_t end)
{
    World *world = *(World **)context;
    double *sums = world->dual.eddy_damping.sums.data;
    for (int32_t block = begin; block < end; block++) sum_block(world, block, sums + SUMS * (size_t)block);
}

float eddy_damping_share(double gain, double kinetic) { return gain > 0.0 ? (float)sqrt(fmax(0.0, 1.0 - gain / fmax(AFFINE_PART * kinetic, gain))) : 1.0f; }

float *eddy_damping_shares(World *world)
{
    float *kept = is_wanted(world) ? world->dual.eddy_damping.kept.data : NULL;
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

static bool pays(const double *sum) { return sum[AT_OBSTACLE] > 0.0 && sum[GAIN] > 0.0; }

static float share_of(const double *sum, double factor)
{
    double kinetic = sum[KINETIC];
    if (!pays(sum)) return 1.0f;
    for (int c = 0; c < 3; c++) kinetic -= 0.5 * sum[MOMENTUM + c] * sum[MOMENTUM + c] / sum[MASS];
    return eddy_damping_share(factor * sum[GAIN], kinetic);
}

static EddyGains gains_of(const EddyDamping *damping)
{
    EddyGains gains = {0};
    const double *sum = damping->body_sums.data;
    for (int32_t i = 0; i < damping->bodies.count; i++, sum += SUMS) {
        gains.before += sum[BEFORE];
        gains.left += sum[KINETIC] - sum[GAIN];
        if (pays(sum)) gains.gained += sum[GAIN];
    }
    return gains;
}

void eddy_damping_find(World *world)
{
    EddyDamping *damping = &world->dual.eddy_damping;
    float *kept = eddy_damping_shares(world);
    if (!kept) return;
    const int32_t *of_block = damping->bodies.of_block.data;
    const double *sums = damping->sums.data;
    double *body = damping->body_sums.data;
    Loops loops;
    loops_open(&loops, world->pool);
    LOOPS_ADD(&loops, grid_nodes(&world->grid, BLOCK_GRAIN), sum_blocks, &world);
    loops_run(&loops);
    memset(body, 0, SUMS * (size_t)damping->bodies.count * sizeof *body);
    for (int32_t block = 0; block < world->grid.node_blocks; block++)
        for (size_t k = 0; k < SUMS; k++) body[SUMS * (size_t)of_block[block] + k] += sums[SUMS * (size_t)block + k];
    const EddyGains gains = gains_of(damping);
    const double factor = eddy_damping_settle(world, &gains);
    for (int32_t block = 0; block < world->grid.particle_blocks; block++) kept[block] = share_of(body + SUMS * (size_t)of_block[block], factor);
}
