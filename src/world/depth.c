#include "world/depth.h"

#include <math.h>
#include <string.h>

enum { BINS = 64, ROUNDS = 4 }; /* each round looks closer at where the ends lie, however far a lone drop flew */

/* How many particles lie how deep along gravity, in cells times |g|, between two depths. */
typedef struct Profile {
    const World *world;
    bool liquid;      /* of liquids alone */
    bool counts;      /* else the range of all particles is found */
    double low, high; /* what is counted between */
    double below, count[BINS];
    double strength; /* |g| */
    int steepest;    /* the axis that gravity pulls along most */
} Profile;

static double greater(double a, double b) { return a > b ? a : b; }
static double lesser(double a, double b) { return a < b ? a : b; }

/* Particles spread evenly over so many cells along gravity. */
static void profile_add(Profile *profile, double middle, double cells, double particles)
{
    const double length = cells * profile->strength, begin = middle - 0.5 * length, end = middle + 0.5 * length;
    if (!profile->counts) {
        profile->low = lesser(profile->low, begin);
        profile->high = greater(profile->high, end);
        return;
    }
    const double width = (profile->high - profile->low) / BINS, density = particles / length, first = (begin - profile->low) / width;
    profile->below += density * greater(0.0, lesser(end, profile->low) - begin);
    for (int bin = first > 0.0 ? (int)lesser(BINS, first) : 0; bin < BINS && profile->low + bin * width < end; bin++) {
        const double from = profile->low + bin * width;
        profile->count[bin] += density * greater(0.0, lesser(end, from + width) - greater(begin, from));
    }
}

/* Of the cells of a block whose coordinate on the steepest axis is `local`, on the average of the other axes. */
static double depth_in_block(const Profile *profile, const int32_t place[3], double local)
{
    static const double MIDDLE = 0.5 * (K_BLOCK_AXIS - 1);
    double depth = 0.0;
    for (int a = 0; a < profile->world->def.dimension; a++)
        depth += (double)profile->world->settings.gravity[a] * (place[a] * K_BLOCK_AXIS + (a == profile->steepest ? local : MIDDLE));
    return depth;
}

static void add_block(Profile *profile, int32_t block)
{
    const Grid *grid = &profile->world->grid;
    const uint32_t *block_run = grid->block_run.data;
    const int32_t *place = (const int32_t *)grid->coordinate.data + 3 * block;
    uint32_t count[K_BLOCK_AXIS] = {0};
    for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++) {
        const uint32_t key = grid->run_key[run], local = key >> (2 * profile->steepest) & (K_BLOCK_AXIS - 1);
        if (!profile->liquid || profile->world->materials.kernel[key >> K_RUN_CELL_BITS].kind == K_LIQUID) count[local] += grid->run_begin[run + 1] - grid->run_begin[run];
    }
    for (int local = 0; local < K_BLOCK_AXIS; local++)
        if (count[local] > 0) profile_add(profile, depth_in_block(profile, place, local), 1.0, count[local]);
}

static void add_flier(Profile *profile, uint32_t row)
{
    const World *world = profile->world;
    double depth = 0.0;
    if (profile->liquid && world->materials.kernel[world->particles.material[row]].kind != K_LIQUID) return;
    for (int a = 0; a < world->def.dimension; a++) depth += (double)world->settings.gravity[a] * (world->particles.cell[a][row] - world->grid.anchor[a]);
    profile_add(profile, depth, 1.0, 1.0);
}

/* Blocks that are asleep count as even. */
static void add_sleepers(Profile *profile)
{
    const World *world = profile->world;
    int32_t corner[3];
    sleep_place(&world->sleep, world->grid.anchor, world->grid.dimension, corner);
    for (uint32_t i = 0; i < world->sleep.asleep.count; i++) {
        const SleepBlock *block = sleep_list_block(&world->sleep.asleep, i);
        const int32_t place[3] = {block->place[0] - corner[0], block->place[1] - corner[1], block->place[2] - corner[2]};
        profile_add(profile, depth_in_block(profile, place, 0.5 * (K_BLOCK_AXIS - 1)), K_BLOCK_AXIS, block->rows);
    }
}

static void profile_find(Profile *profile, bool asleep_too)
{
    const Grid *grid = &profile->world->grid;
    for (int32_t block = 0; block < grid->particle_blocks; block++) add_block(profile, block);
    for (uint32_t row = grid->flight_row; row < grid->end_row; row++) add_flier(profile, row);
    if (asleep_too) add_sleepers(profile);
}

static Profile profile_of(const World *world, bool liquid)
{
    Profile profile = {.world = world, .liquid = liquid, .low = INFINITY, .high = -INFINITY, .strength = gravity_strength(world)};
    for (int a = 1; a < world->def.dimension; a++)
        if (fabsf(world->settings.gravity[a]) > fabsf(world->settings.gravity[profile.steepest])) profile.steepest = a;
    return profile;
}

/* The depth that so many particles lie above. */
static double depth_below(const Profile *profile, double particles)
{
    const double width = (profile->high - profile->low) / BINS;
    double sum = profile->below;
    int bin = 0;
    while (bin < BINS - 1 && sum + profile->count[bin] < particles) sum += profile->count[bin++];
    const double share = profile->count[bin] > 0.0 ? fmin(1.0, (particles - sum) / profile->count[bin]) : 0.0;
    return profile->low + (bin + fmax(0.0, share)) * width;
}

static double counted(const Profile *profile)
{
    double sum = 0.0;
    for (int bin = 0; bin < BINS; bin++) sum += profile->count[bin];
    return sum;
}

static double depth_of(const World *world, bool liquid, bool asleep_too)
{
    static const double TRIMMED = 0.02;    /* share of the particles at each end, which may be spray; by trial */
    static const double PER_CELL = 1024.0; /* the result is as exact: what rounding makes of another order of the blocks does not show */
    Profile profile = profile_of(world, liquid);
    double particles = 0.0, low = 0.0, high = 0.0;
    profile_find(&profile, asleep_too);
    if (!(profile.high > profile.low)) return 0.0; /* nor without gravity */
    profile.counts = true;
    for (int round = 0; round < ROUNDS; round++) {
        const double width = (profile.high - profile.low) / BINS;
        profile.below = 0.0;
        memset(profile.count, 0, sizeof profile.count);
        profile_find(&profile, asleep_too);
        if (round == 0) particles = counted(&profile);
        low = depth_below(&profile, TRIMMED * particles);
        high = depth_below(&profile, (1.0 - TRIMMED) * particles);
        if (width <= 0.5 * profile.strength) break; /* within a cell they lie evenly */
        profile.low = low - width;
        profile.high = high + width;
    }
    const double cells = (high - low) / (1.0 - 2.0 * TRIMMED) / profile.strength; /* exact where it is even */
    return round(PER_CELL * cells) / PER_CELL * profile.strength;
}

double depth_along_gravity(const World *world) { return depth_of(world, false, true); }

double gravity_strength(const World *world)
{
    double square = 0.0;
    for (int a = 0; a < world->def.dimension; a++) square += (double)world->settings.gravity[a] * (double)world->settings.gravity[a];
    return sqrt(square);
}

double gravity_direction(const World *world, double down[3])
{
    const double strength = gravity_strength(world);
    for (int a = 0; a < 3; a++) down[a] = a < world->def.dimension && strength > 0.0 ? (double)world->settings.gravity[a] / strength : 0.0;
    return strength;
}

double gravity_fall(const World *world, const Substep *substep)
{
    return gravity_strength(world) * substep->dt * substep->dt / (double)world->def.cell_size;
}

static double measured(const World *world)
{
    const double strength = gravity_strength(world);
    if (strength > 0.0) return fmax(1.0, depth_of(world, false, false) / strength);
    return pow((double)(world->grid.particle_blocks + world->grid.left_blocks) * world->grid.block_cells, 1.0 / world->def.dimension);
}

void matter_depth_find(World *world) { world->matter_depth = measured(world); }

double matter_depth(const World *world) { return world->matter_depth; }

double liquid_depth(const World *world)
{
    const double strength = gravity_strength(world);
    return strength > 0.0 ? fmax(1.0, depth_of(world, true, false) / strength) : 1.0;
}

double slowest_pressure(const World *world) { return 3.14159265358979 / (4.0 * matter_depth(world)); }
