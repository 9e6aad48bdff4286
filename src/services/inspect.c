#include "services/inspect.h"

#include <math.h>
#include <string.h>

#include "base/numbers.h"
#include "base/result.h"
#include "services/readers.h"
#include "world/island_groups.h"

/* ---- Views ---- */

/* A field whose components lie `apart` bytes from each other. */
static pbmpm_view planes(const void *first, uint32_t components, size_t apart)
{
    return (pbmpm_view){.data = first, .components = components, .component_stride = (uint32_t)apart, .stride = 4};
}

/* A field whose components lie side by side. */
static pbmpm_view packed(const void *first, uint32_t components)
{
    return (pbmpm_view){.data = first, .components = components, .component_stride = 4, .stride = 4 * components};
}

uint32_t inspect_components(const World *world, pbmpm_field field)
{
    const uint32_t d = (uint32_t)world->def.dimension;
    switch (field) {
    case PBMPM_POSITION:
    case PBMPM_VELOCITY: return d;
    case PBMPM_AFFINE_VELOCITY:
    case PBMPM_DEFORMATION: return d * d;
    case PBMPM_PARTICLE: return 2;
    case PBMPM_VOLUME_RATIO:
    case PBMPM_MATERIAL:
    case PBMPM_MASS:
    case PBMPM_PRESSURE:
    case PBMPM_USER_VALUE:
    case PBMPM_FIELD_FORCE32: break;
    }
    return 1;
}

bool inspect_is_field(pbmpm_field field) { return in_enum(field, PBMPM_POSITION, INSPECT_FIELDS - 1); }

pbmpm_result inspect_no_field(pbmpm_field field) { return fail(PBMPM_ERROR_INVALID_ARGUMENT, "field %d does not exist", (int)field); }

bool inspect_has(const World *world, pbmpm_field field)
{
    const Particles *p = &world->particles;
    switch (field) {
    case PBMPM_DEFORMATION: return p->deformation[0];
    case PBMPM_PRESSURE: return p->pressure;
    case PBMPM_USER_VALUE: return p->user_value;
    case PBMPM_POSITION:
    case PBMPM_VELOCITY:
    case PBMPM_AFFINE_VELOCITY:
    case PBMPM_VOLUME_RATIO:
    case PBMPM_MATERIAL:
    case PBMPM_PARTICLE:
    case PBMPM_MASS:
    case PBMPM_FIELD_FORCE32: break;
    }
    return true;
}

pbmpm_result inspect_view(World *world, pbmpm_field field, pbmpm_view *view)
{
    Particles *p = &world->particles;
    const uint32_t d = (uint32_t)p->dimension;
    pbmpm_view found;
    switch (field) {
    case PBMPM_POSITION: found = packed(readers_positions(world), d); break;
    case PBMPM_VELOCITY: found = planes(p->velocity[0], d, p->array_bytes); break;
    case PBMPM_AFFINE_VELOCITY: found = planes(p->affine[0], d * d, p->array_bytes); break;
    case PBMPM_VOLUME_RATIO: found = packed(p->volume_ratio, 1); break;
    case PBMPM_DEFORMATION:
        if (!p->deformation[0])
            return fail(PBMPM_ERROR_UNSUPPORTED, "a world that never had a particle of anything but liquid has no deformation gradients");
        found = planes(p->deformation[0], d * d, p->array_bytes);
        break;
    case PBMPM_MATERIAL: found = packed(p->material, 1); break;
    case PBMPM_PARTICLE: found = packed(p->id, 2); break;
    case PBMPM_MASS: found = packed(readers_kilograms(world), 1); break;
    case PBMPM_PRESSURE:
        if (!p->pressure) return fail(PBMPM_ERROR_UNSUPPORTED, "a world has pressures only once the dual solver was used");
        found = packed(p->pressure, 1);
        break;
    case PBMPM_USER_VALUE:
        if (!p->user_value) return fail(PBMPM_ERROR_UNSUPPORTED, "a world has user values only once a particle was given one");
        found = packed(p->user_value, 1);
        break;
    case PBMPM_FIELD_FORCE32:
    default: return inspect_no_field(field);
    }
    found.size = sizeof found;
    found.count = p->count;
    found.generation = world->generation;
    if (p->count == 0) found.data = NULL;
    *view = found;
    return PBMPM_OK;
}

/* ---- Statistics ---- */

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

void inspect_step_stats(World *world, pbmpm_stats *stats)
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

void inspect_stats(World *world, pbmpm_stats *stats)
{
    inspect_step_stats(world, stats);
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

/* ---- Hash ---- */

static uint64_t mix(uint64_t hash, const void *array, uint32_t count)
{
    const uint32_t *words = array;
    for (uint32_t i = 0; i < count; i++) {
        hash = (hash ^ words[i]) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

/* A world that has room for pressures, but none yet, is as one that has no room. */
static bool any_pressure(const Particles *p)
{
    for (uint32_t i = 0; i < p->count && p->pressure; i++)
        if (p->pressure[i] != 0.0f) return true;
    return false;
}

uint64_t inspect_hash(const World *world)
{
    const Particles *p = &world->particles;
    uint64_t hash = mix(0x243f6a8885a308d3u, &p->count, 1);
    for (int a = 0; a < p->dimension; a++) {
        hash = mix(hash, p->cell[a], p->count);
        hash = mix(hash, p->fraction[a], p->count);
        hash = mix(hash, p->velocity[a], p->count);
        for (int c = 0; c < p->dimension; c++) {
            hash = mix(hash, p->affine[a * 3 + c], p->count);
            if (p->deformation[0]) hash = mix(hash, p->deformation[a * 3 + c], p->count);
        }
    }
    hash = mix(hash, p->volume_ratio, p->count);
    if (any_pressure(p)) hash = mix(hash, p->pressure, p->count);
    hash = mix(hash, p->material, p->count);
    return mix(hash, p->mass, p->count);
}
