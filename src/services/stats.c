#include "services/stats.h"

#include <math.h>
#include <string.h>

#include "services/readers.h"
#include "world/island_groups.h"

/* Sums over particles, in double precision. */
typedef struct Sums {
    double mass, momentum[3], angular[3], kinetic, potential;
    double volume_error2, volume_error_max, speed2_max;
} Sums;

/* Particles are summed in storage order in parts that depend on nothing but their number, and then the parts in order: so the threads that share them
 * change no bit. */
enum { PARTS = 64, PART_ROWS = 2048 };

typedef struct Summing {
    const World *world;
    double cell_size, cell_volume;
    uint32_t part_rows;
    Sums part[PARTS];
} Summing;

/* A NaN stays. */
static void keep_largest(double *largest, double value)
{
    if (value > *largest || isnan(value)) *largest = value;
}

/* L = sum m (x cross v + dx^2/4 axl(C - C^T)): the affine part carries angular momentum of its own (C. Jiang et al., "The
 * Affine Particle-In-Cell Method", ACM TOG 34(4), 2015, with the quadratic spline's inertia dx^2/4). */
static void add_angular(const Summing *summing, uint32_t row, double mass, const double x[3], const double v[3], Sums *sums)
{
    float *const *C = summing->world->particles.affine;
    const double inertia = 0.25 * summing->cell_size * summing->cell_size;
    for (int a = summing->world->def.dimension == 3 ? 0 : 2; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        const double spin = (double)C[c * 3 + b][row] - (double)C[b * 3 + c][row];
        sums->angular[a] += mass * (x[b] * v[c] - x[c] * v[b] + inertia * spin);
    }
}

static void add_particle(const Summing *summing, uint32_t row, Sums *sums)
{
    const Particles *p = &summing->world->particles;
    const double mass = (double)p->mass[row] * summing->cell_volume;
    const double volume_error = fabs((double)p->volume_ratio[row] - 1.0);
    double x[3] = {0}, v[3] = {0}, speed2 = 0.0, height = 0.0;
    for (int a = 0; a < p->dimension; a++) {
        x[a] = particles_coordinate(p, row, a) * summing->cell_size;
        v[a] = (double)p->velocity[a][row];
        speed2 += v[a] * v[a];
        height += (double)summing->world->settings.gravity[a] * x[a];
        sums->momentum[a] += mass * v[a];
    }
    add_angular(summing, row, mass, x, v, sums);
    sums->mass += mass;
    sums->kinetic += 0.5 * mass * speed2;
    sums->potential -= mass * height;
    keep_largest(&sums->speed2_max, speed2);
    sums->volume_error2 += volume_error * volume_error;
    keep_largest(&sums->volume_error_max, volume_error);
}

static void sum_parts(void *context, int32_t begin, int32_t end)
{
    Summing *summing = context;
    for (int32_t part = begin; part < end; part++) {
        const uint32_t first = (uint32_t)part * summing->part_rows, left = summing->world->particles.count - first;
        const uint32_t last = first + (left < summing->part_rows ? left : summing->part_rows);
        Sums sums = {0};
        for (uint32_t row = first; row < last; row++) add_particle(summing, row, &sums);
        summing->part[part] = sums;
    }
}

static void add_sums(Sums *all, const Sums *part)
{
    for (int a = 0; a < 3; a++) {
        all->momentum[a] += part->momentum[a];
        all->angular[a] += part->angular[a];
    }
    all->mass += part->mass;
    all->kinetic += part->kinetic;
    all->potential += part->potential;
    all->volume_error2 += part->volume_error2;
    keep_largest(&all->speed2_max, part->speed2_max);
    keep_largest(&all->volume_error_max, part->volume_error_max);
}

static Sums sum_particles(World *world)
{
    const uint32_t count = world->particles.count, even = count / PARTS + 1;
    Summing summing = {.world = world, .cell_size = (double)world->def.cell_size, .cell_volume = world_cell_volume(world)};
    summing.part_rows = even > PART_ROWS ? even : PART_ROWS;
    const uint32_t parts = (count + summing.part_rows - 1) / summing.part_rows;
    Sums all = {0};
    pool_for(world->pool, (int32_t)parts, 1, sum_parts, &summing);
    for (uint32_t part = 0; part < parts; part++) add_sums(&all, &summing.part[part]);
    return all;
}

/* Adds the lanes that the gangs of the runs take. */
static void add_lanes(const World *world, const Grid *grid, uint64_t *lanes, uint64_t *particles)
{
    for (uint32_t run = 0; run < grid->runs; run++) {
        const uint32_t count = grid->run_begin[run + 1] - grid->run_begin[run];
        const uint32_t gang = (uint32_t)world->kernels->lanes;
        *lanes += (count + gang - 1) / gang * gang;
        *particles += count;
    }
}

static float lane_occupancy(const World *world)
{
    uint64_t lanes = 0, particles = 0;
    for (int group = 0; group == 0 || group < world->islands.groups; group++) add_lanes(world, islands_grid(world, group), &lanes, &particles);
    return lanes ? (float)((double)particles / (double)lanes) : 0.0f;
}

static void fill_grids(const World *world, pbmpm_stats *stats)
{
    for (int group = 0; group == 0 || group < world->islands.groups; group++) {
        const Grid *grid = islands_grid(world, group);
        stats->particle_blocks += (uint32_t)grid->particle_blocks;
        stats->node_blocks += (uint32_t)grid->node_blocks;
    }
    stats->contacts = world->islands.contacts + colliders_contacts(&world->colliders);
}

void stats_of_step(World *world, pbmpm_stats *stats)
{
    const StepRecord *record = &world->record;
    *stats = (pbmpm_stats){.size = sizeof *stats, .particle_count = world->particles.count};
    stats->step_count = world->step_count;
    stats->simulated_seconds = world->simulated_seconds;
    stats->memory_bytes = readers_memory_used(world);
    fill_grids(world, stats);
    stats->substeps = record->substeps;
    stats->iterations = record->iterations;
    stats->thread_count = (uint32_t)pool_thread_count(world->pool);
    stats->ms_total = (float)record->ms_total;
    stats->ms_sort = (float)record->ms_sort;
    stats->ms_scatter = (float)record->ms_scatter;
    stats->ms_contacts = (float)record->ms_contacts;
    stats->ms_iterate = (float)record->ms_iterate;
    stats->ms_integrate = (float)record->ms_integrate;
    stats->max_displacement = record->travel;
    stats->cell_changes = record->moved;
    stats->deleted_total = world->deleted_total;
    stats->clamped_total = world->clamped_total;
    stats->solver = record->solver;
    stats->stop = record->stop;
    stats->iterations_used = record->iterations_used;
    stats->residual = (float)record->residual;
    stats->predicted_error = (float)record->predicted_error;
    stats->energy_checks_failed = record->energy_checks_failed;
    stats->particles_asleep = world->sleep.rows + world->sleep.still_rows;
    stats->blocks_asleep = world->sleep.asleep.count;
    stats->blocks_drowsy = world->sleep.still_blocks;
    stats->blocks_woken = record->blocks_woken;
}

void stats_of_world(World *world, pbmpm_stats *stats)
{
    stats_of_step(world, stats);
    stats->lane_occupancy = lane_occupancy(world);
    if (stats->particle_count == 0) return;
    const Sums sums = sum_particles(world);
    stats->mass = sums.mass;
    memcpy(stats->momentum, sums.momentum, sizeof stats->momentum);
    memcpy(stats->angular_momentum, sums.angular, sizeof stats->angular_momentum);
    stats->kinetic_energy = sums.kinetic;
    stats->potential_energy = sums.potential;
    stats->volume_error_rms = (float)sqrt(sums.volume_error2 / stats->particle_count);
    stats->volume_error_max = (float)sums.volume_error_max;
    stats->max_speed = (float)sqrt(sums.speed2_max);
}
