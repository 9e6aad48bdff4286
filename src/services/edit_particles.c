#include "services/edit_particles.h"

#include <math.h>
#include <string.h>

#include "base/generations.h"
#include "base/numbers.h"
#include "base/random.h"
#include "base/result.h"
#include "contact/field.h"
#include "services/views.h"
#include "solvers/eddy_damping.h"
#include "world/sleep_rows.h"
#include "world/sleep_wake.h"

static const double VALUE_LIMIT = 1e9; /* of velocities and their gradients: far above any use, far below float overflow */

pbmpm_particles_def particles_def_defaults(void) { return (pbmpm_particles_def){.size = sizeof(pbmpm_particles_def)}; }

pbmpm_fill_def fill_def_defaults(void)
{
    return (pbmpm_fill_def){.size = sizeof(pbmpm_fill_def),
                            .seed = 1,
                            .particles_per_axis = 2.0f,
                            .jitter = PLACE_JITTER};
}

static bool position_is_valid(const World *world, const float *position)
{
    const double limit = (double)CELL_LIMIT * (double)world->def.cell_size;
    for (int a = 0; a < world->def.dimension; a++) {
        if (!in_range(position[a], -limit, limit)) return false;
        if (!in_range(position[a], world->domain.low[a], world->domain.high[a])) return false;
    }
    return true;
}

static pbmpm_result no_room(World *world, uint64_t wanted)
{
    const Particles *p = &world->particles;
    const uint32_t count = wanted > UINT32_MAX ? UINT32_MAX : (uint32_t)wanted;
    const pbmpm_event event = {.kind = PBMPM_EVENT_CAPACITY, .count = count, .step = world->step_count};
    events_add(&world->events, &event);
    const unsigned long long needed = (unsigned long long)wanted + p->count;
    return fail(PBMPM_ERROR_CAPACITY,
                "no room for %llu more particles: %u of %u in use; make the world with a capacity of at least %llu",
                (unsigned long long)wanted, p->count, p->capacity, needed);
}

/* ---- Adding ---- */

static pbmpm_result check_particles(const World *world, const pbmpm_particles_def *def)
{
    if (!material_is_live(&world->materials, def->material)) return fail(PBMPM_ERROR_INVALID_ID, "particles.material %s", ended_tell(&world->ended, def->material.generation));
    if (def->count && !def->positions) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "particles.positions is null");
    if (!def->volumes && !in_range(def->volume, 0.0, 1e27)) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "particles.volume must be in [0, 1e27]");
    if (!def->volumes && def->volume > 0.0f && !in_range(def->volume / world_cell_volume(world), 1e-6, 1e6))
        return fail(PBMPM_ERROR_INVALID_ARGUMENT, "particles.volume must be between 1e-6 and 1e6 cells");
    return PBMPM_OK;
}

static pbmpm_result check_values(const World *world, const pbmpm_particles_def *def)
{
    const int d = world->def.dimension;
    const double cell = world_cell_volume(world);
    for (uint32_t i = 0; i < def->count; i++) {
        if (!position_is_valid(world, def->positions + (size_t)i * d))
            return fail(PBMPM_ERROR_INVALID_ARGUMENT, "position of particle %u is not finite or outside the domain", i);
        if (def->velocities && !all_in_range(def->velocities + (size_t)i * d, d, -VALUE_LIMIT, VALUE_LIMIT))
            return fail(PBMPM_ERROR_INVALID_ARGUMENT, "velocity of particle %u is not finite or above 1e9 m/s", i);
        if (def->volumes && !in_range(def->volumes[i] / cell, 1e-6, 1e6))
            return fail(PBMPM_ERROR_INVALID_ARGUMENT, "volume of particle %u must be between 1e-6 and 1e6 cells", i);
    }
    return PBMPM_OK;
}

pbmpm_result edit_add(World *world, const pbmpm_particles_def *def, uint32_t generation, pbmpm_particle_id *ids)
{
    Particles *p = &world->particles;
    pbmpm_result checked = check_particles(world, def);
    if (checked != PBMPM_OK) return checked;
    if (def->count > p->capacity - p->count) return no_room(world, def->count); /* before the arrays are read */
    checked = check_values(world, def);
    if (checked == PBMPM_OK && def->count) checked = world_make_room_for(world, def->material.index);
    if (checked == PBMPM_OK && def->count && def->user_values) checked = particles_enable_user_values(p, &world->memory);
    if (checked != PBMPM_OK) return checked;
    const int d = world->def.dimension;
    const double dx = (double)world->def.cell_size, cell = world_cell_volume(world);
    const double usual = def->volume > 0.0f ? def->volume / cell : d == 3 ? 0.125 : 0.25; /* [cells] */
    const double density = (double)world->materials.def[def->material.index].density;
    for (uint32_t i = 0; i < def->count; i++) {
        const double volume = def->volumes ? def->volumes[i] / cell : usual;
        NewParticle particle = {.mass = (float)(density * volume), .material = def->material.index};
        if (def->user_values) particle.user_value = def->user_values[i];
        for (int a = 0; a < d; a++) {
            particle.position[a] = (double)def->positions[(size_t)i * d + a] / dx;
            if (def->velocities) particle.velocity[a] = def->velocities[(size_t)i * d + a];
        }
        const pbmpm_particle_id id = particles_append(p, &particle, generation);
        if (ids) ids[i] = id;
    }
    world_expire_views(world);
    return PBMPM_OK;
}

/* ---- Filling shapes ---- */

/* The part of a lattice that is looked at holds a shape that may fill little of it; beyond this a fill is a mistake. */
static const double LATTICE_LIMIT = 4.0 * PBMPM_MAX_PARTICLES;

/* A lattice centred on the shape, so that a symmetric shape gets a symmetric filling. Lengths in metres. */
typedef struct Lattice {
    Solid solid;
    double first[3];
    double spacing;
    uint64_t size[3];
    uint64_t begin[3], end[3]; /* of it, where particles may be */
    double low[3], high[3];    /* where particles may be [m] */
    bool whole;                /* all points there are where particles may be */
    const Near *near;          /* obstacles that the shape may overlap; null: none */
} Lattice;

static double lattice_coordinate(const Lattice *lattice, int axis, uint64_t i) { return lattice->first[axis] + (double)i * lattice->spacing; }

/* Leaves the points of an axis that are where particles may be. */
static void clip_lattice(const World *world, Lattice *lattice, int a)
{
    const double limit = (double)CELL_LIMIT * (double)world->def.cell_size, size = (double)lattice->size[a];
    const double low = lattice->low[a] = fmax(world->domain.low[a], -limit), high = lattice->high[a] = fmin(world->domain.high[a], limit);
    const double begin = floor((low - lattice->first[a]) / lattice->spacing) - 1.0, end = ceil((high - lattice->first[a]) / lattice->spacing) + 2.0;
    lattice->begin[a] = (uint64_t)fmin(fmax(begin, 0.0), size);
    lattice->end[a] = (uint64_t)fmin(fmax(end, (double)lattice->begin[a]), size);
    while (lattice->begin[a] < lattice->end[a] && !in_range(lattice_coordinate(lattice, a, lattice->begin[a]), low, high))
        lattice->begin[a]++;
    while (lattice->begin[a] < lattice->end[a] && !in_range(lattice_coordinate(lattice, a, lattice->end[a] - 1), low, high))
        lattice->end[a]--;
}

static bool make_lattice(const World *world, const pbmpm_fill_def *def, const pbmpm_shape *shape, Lattice *lattice)
{
    double low[3], high[3], points = 1.0;
    *lattice = (Lattice){.solid = solid_among(shape, world->def.dimension, &world->baked),
                         .spacing = (double)world->def.cell_size / (double)def->particles_per_axis,
                         .size = {1, 1, 1},
                         .end = {1, 1, 1},
                         .whole = true};
    solid_bounds(&lattice->solid, low, high);
    for (int a = 0; a < world->def.dimension; a++) {
        const double size = fmax(1.0, floor((high[a] - low[a]) / lattice->spacing + 0.5));
        lattice->size[a] = (uint64_t)size;
        lattice->first[a] = 0.5 * (low[a] + high[a]) - 0.5 * (size - 1.0) * lattice->spacing;
        clip_lattice(world, lattice, a);
        points *= (double)(lattice->end[a] - lattice->begin[a]);
    }
    return points <= LATTICE_LIMIT;
}

/* Points that lie on an obstacle are not in it, by rounding [cells]. */
static const double ON_OBSTACLE = 1e-4;

/* Obstacles where they stand now; matter that is put into them would be pushed out to where there may be no room. */
static void look_for_obstacles(World *world, uint32_t groups, Lattice *lattice, Near *near)
{
    Near all;
    const ContactFrame frame = {.colliders = &world->colliders, .grid = &world->grid, .cell_size = (double)world->def.cell_size};
    double centre[3] = {0}, reach = 0.0;
    for (int a = 0; a < world->def.dimension; a++) {
        if (lattice->begin[a] == lattice->end[a]) return;
        const double low = lattice_coordinate(lattice, a, lattice->begin[a]), high = lattice_coordinate(lattice, a, lattice->end[a] - 1);
        centre[a] = 0.5 * (low + high);
        reach += 0.25 * (high - low) * (high - low);
    }
    colliders_begin_substep(&world->colliders, NULL, world->def.dimension, 0, 1);
    field_near(&all, &frame, centre, sqrt(reach) / frame.cell_size + 1.0, false);
    all.dimension = world->def.dimension; /* the grid of a new world has none yet */
    const Near *meeting = field_meeting(&all, groups, near);
    if (meeting->count == 0) return;
    if (meeting == &all) *near = all;
    lattice->near = near;
    lattice->whole = false;
}

/* Moves a lattice point at random, never out of where particles may be. False: it is in an obstacle then. */
static bool jitter_point(const World *world, const Lattice *lattice, const pbmpm_fill_def *def, const uint64_t index[3], double point[3])
{
    const uint64_t number = (index[2] * lattice->size[1] + index[1]) * lattice->size[0] + index[0];
    for (int a = 0; a < world->def.dimension; a++) {
        point[a] += (double)def->jitter * lattice->spacing * random_number(def->seed, number * 3 + (uint64_t)a);
        point[a] = fmin(fmax(point[a], lattice->low[a]), lattice->high[a]);
    }
    return !lattice->near || field_distance(lattice->near, point) >= -ON_OBSTACLE;
}

static double lattice_distance(const Lattice *lattice, const uint64_t index[3], double point[3])
{
    for (int a = 0; a < 3; a++) point[a] = lattice_coordinate(lattice, a, index[a]);
    return solid_gap(&lattice->solid, point);
}

/* A point counts up to this far outside of the shape [spacings]. */
static const double LATTICE_EDGE = 1e-6;

/* How many points from this one on along a row lie outside of the shape: its distance changes by no more than the way. */
static uint64_t outside_from(const Lattice *lattice, const double point[3], double distance)
{
    const double least = lattice->solid.grid ? solid_least(&lattice->solid, point) : distance;
    return 1 + (uint64_t)fmax(0.0, least / lattice->spacing - 2.0 * LATTICE_EDGE);
}

static uint64_t count_row(const World *world, const Lattice *lattice, const pbmpm_fill_def *def, uint64_t index[3], int along)
{
    const bool leaps = lattice->whole && !lattice->solid.grid; /* distances of a grid err */
    uint64_t count = 0, step;
    for (index[along] = lattice->begin[along]; index[along] < lattice->end[along]; index[along] += step) {
        double point[3];
        const double distance = lattice_distance(lattice, index, point);
        step = 1;
        if (distance > LATTICE_EDGE * lattice->spacing) {
            step = outside_from(lattice, point, distance);
        } else if (leaps) {
            const uint64_t inside = 1 + (uint64_t)fmax(0.0, -distance / lattice->spacing), left = lattice->end[along] - index[along];
            step = inside < left ? inside : left;
            count += step;
        } else {
            count += jitter_point(world, lattice, def, index, point);
        }
    }
    return count;
}

/* Counts along the longest rows: of the others there are fewest. */
static uint64_t count_points(const World *world, const Lattice *lattice, const pbmpm_fill_def *def)
{
    int along = 0;
    for (int a = 1; a < 3; a++)
        if (lattice->end[a] - lattice->begin[a] > lattice->end[along] - lattice->begin[along]) along = a;
    const int b = (along + 1) % 3, c = (along + 2) % 3;
    uint64_t index[3], count = 0;
    for (index[b] = lattice->begin[b]; index[b] < lattice->end[b]; index[b]++)
        for (index[c] = lattice->begin[c]; index[c] < lattice->end[c]; index[c]++) count += count_row(world, lattice, def, index, along);
    return count;
}

static void append_point(World *world, const pbmpm_fill_def *def, double volume, const double point[3], uint32_t generation)
{
    const double density = (double)world->materials.def[def->material.index].density;
    NewParticle particle = {.mass = (float)(density * volume), .material = def->material.index, .user_value = def->user_value};
    for (int a = 0; a < world->def.dimension; a++) {
        particle.position[a] = point[a] / (double)world->def.cell_size;
        particle.velocity[a] = def->velocity[a];
    }
    particles_append(&world->particles, &particle, generation);
}

/* In the order of the lattice. */
static void append_points(World *world, const Lattice *lattice, const pbmpm_fill_def *def, uint32_t generation)
{
    const double per_cell = lattice->spacing / (double)world->def.cell_size;
    const double volume = world->def.dimension == 3 ? per_cell * per_cell * per_cell : per_cell * per_cell;
    uint64_t index[3], step;
    for (index[2] = lattice->begin[2]; index[2] < lattice->end[2]; index[2]++)
        for (index[1] = lattice->begin[1]; index[1] < lattice->end[1]; index[1]++)
            for (index[0] = lattice->begin[0]; index[0] < lattice->end[0]; index[0] += step) {
                double point[3];
                const double distance = lattice_distance(lattice, index, point);
                step = 1;
                if (distance > LATTICE_EDGE * lattice->spacing)
                    step = outside_from(lattice, point, distance);
                else if (jitter_point(world, lattice, def, index, point))
                    append_point(world, def, volume, point, generation);
            }
}

static pbmpm_result check_fill(const World *world, const pbmpm_fill_def *def, const pbmpm_shape *shape)
{
    if (!material_is_live(&world->materials, def->material)) return fail(PBMPM_ERROR_INVALID_ID, "fill.material %s", ended_tell(&world->ended, def->material.generation));
    const char *problem = shape_problem_among(shape, world->def.dimension, &world->baked);
    if (problem) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "fill: %s", problem);
    if (shape->kind == PBMPM_PLANE) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "fill.shape: a plane has no end");
    if (!in_range(def->particles_per_axis, 0.25, 16.0))
        return fail(PBMPM_ERROR_INVALID_ARGUMENT, "fill.particles_per_axis must be in [0.25, 16]");
    if (!in_range(def->jitter, 0.0, 1.0)) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "fill.jitter must be in [0, 1]");
    if (!all_in_range(def->velocity, (size_t)world->def.dimension, -VALUE_LIMIT, VALUE_LIMIT))
        return fail(PBMPM_ERROR_INVALID_ARGUMENT, "fill.velocity must be finite and at most 1e9 m/s");
    return PBMPM_OK;
}

pbmpm_result edit_fill(World *world, const pbmpm_fill_def *def, const pbmpm_shape *shape, uint32_t generation, uint32_t *added)
{
    pbmpm_result checked = check_fill(world, def, shape);
    if (checked != PBMPM_OK) return checked;
    Lattice lattice;
    Near near;
    if (!make_lattice(world, def, shape, &lattice))
        return fail(PBMPM_ERROR_INVALID_ARGUMENT, "fill.shape is too large: more than 2^30 lattice points in the domain");
    look_for_obstacles(world, world->materials.def[def->material.index].groups, &lattice, &near);
    const uint64_t count = count_points(world, &lattice, def);
    if (added) *added = count > UINT32_MAX ? UINT32_MAX : (uint32_t)count;
    if (count > world->particles.capacity - world->particles.count) return no_room(world, count);
    if (count == 0) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "fill.shape: no point of its lattice is inside of it and of the domain, and outside of all obstacles");
    checked = world_make_room_for(world, def->material.index);
    if (checked == PBMPM_OK && def->user_value) checked = particles_enable_user_values(&world->particles, &world->memory);
    if (checked != PBMPM_OK) return checked;
    append_points(world, &lattice, def, generation);
    world_expire_views(world);
    return PBMPM_OK;
}

pbmpm_result edit_no_particle(pbmpm_particle_id id, uint32_t place)
{
    return fail(PBMPM_ERROR_INVALID_ID, "particle %u of the list %s", place,
                generation_was_given_to_particles(id.generation) ? "is gone, or of another world" : "never existed");
}

/* ---- Removing ---- */

pbmpm_result edit_remove(World *world, const pbmpm_particle_id *ids, uint32_t count)
{
    Particles *p = &world->particles;
    uint32_t row;
    for (uint32_t i = 0; i < count; i++)
        if (!particles_row(p, ids[i], &row)) return edit_no_particle(ids[i], i);
    if (count == 0) return PBMPM_OK; /* rows stay where they are */
    for (uint32_t i = 0; i < count && world->sleep.on; i++) {
        particles_row(p, ids[i], &row);
        sleep_wake_row(world, row);
    }
    if (world->sleep.on) sleep_settle(world); /* rows that sleep stay where they are */
    for (uint32_t i = 0; i < count; i++) {
        particles_row(p, ids[i], &row);
        p->status[row] = K_REMOVED;
    }
    particles_compact(p, world->sleep.rows);
    world_expire_views(world);
    return PBMPM_OK;
}

static bool is_inside(const World *world, const Solid *solid, uint32_t row)
{
    double point[3] = {0};
    for (int a = 0; a < world->def.dimension; a++) point[a] = particles_coordinate(&world->particles, row, a) * (double)world->def.cell_size;
    return solid_gap(solid, point) <= 0.0;
}

pbmpm_result edit_remove_in(World *world, const pbmpm_shape *shape, uint32_t *removed)
{
    const char *problem = shape_problem_among(shape, world->def.dimension, &world->baked);
    if (problem) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "%s", problem);
    const Solid solid = solid_among(shape, world->def.dimension, &world->baked);
    Particles *p = &world->particles;
    uint32_t count = 0;
    for (uint32_t row = 0; row < p->count; row++) {
        if (!is_inside(world, &solid, row)) continue;
        if (world->sleep.on) sleep_wake_row(world, row);
        count++;
    }
    if (removed) *removed = count;
    if (count == 0) return PBMPM_OK; /* rows stay where they are */
    if (world->sleep.on) sleep_settle(world);
    for (uint32_t row = world->sleep.rows; row < p->count; row++)
        if (is_inside(world, &solid, row)) p->status[row] = K_REMOVED;
    particles_compact(p, world->sleep.rows);
    world_expire_views(world);
    return PBMPM_OK;
}

/* ---- Changing ---- */

static bool is_solid(const World *world, uint32_t row) { return material_is_solid(&world->materials, world->particles.material[row]); }

/* 0 for what cannot be set. */
static uint32_t settable_components(const World *world, pbmpm_field field)
{
    switch (field) {
    case PBMPM_POSITION:
    case PBMPM_VELOCITY:
    case PBMPM_AFFINE_VELOCITY:
    case PBMPM_DEFORMATION:
    case PBMPM_VOLUME_RATIO:
    case PBMPM_USER_VALUE:
    case PBMPM_PRESSURE: return views_components(world, field);
    case PBMPM_MATERIAL:
    case PBMPM_PARTICLE:
    case PBMPM_MASS:
    case PBMPM_FIELD_FORCE32: break;
    }
    return 0;
}

/* Whether row may take these values; fails with a message otherwise. */
static pbmpm_result check_value(const World *world, pbmpm_field field, uint32_t row, const float *values, uint32_t components)
{
    switch (field) {
    case PBMPM_USER_VALUE: return PBMPM_OK;
    case PBMPM_POSITION:
        if (position_is_valid(world, values)) return PBMPM_OK;
        return fail(PBMPM_ERROR_INVALID_ARGUMENT, "a position is not finite or outside the domain");
    case PBMPM_VOLUME_RATIO:
        if (is_solid(world, row)) return fail(PBMPM_ERROR_UNSUPPORTED, "the volume ratio of an elastic particle follows from F");
        if (in_range(*values, K_LIQUID_RATIO_MIN, K_LIQUID_RATIO_MAX)) return PBMPM_OK;
        return fail(PBMPM_ERROR_INVALID_ARGUMENT, "a volume ratio must be in [0.05, 1.2]");
    case PBMPM_PRESSURE:
        if (is_solid(world, row)) return fail(PBMPM_ERROR_UNSUPPORTED, "only liquid particles have a pressure");
        if (in_range(*values, 0.0, 1e30)) return PBMPM_OK;
        return fail(PBMPM_ERROR_INVALID_ARGUMENT, "a pressure must be in [0, 1e30]");
    case PBMPM_DEFORMATION:
        if (!is_solid(world, row)) return fail(PBMPM_ERROR_UNSUPPORTED, "only elastic particles have a deformation gradient");
        if (all_in_range(values, components, -1e6, 1e6)) return PBMPM_OK;
        return fail(PBMPM_ERROR_INVALID_ARGUMENT, "a deformation gradient is not finite or has an entry above 1e6");
    case PBMPM_VELOCITY:
    case PBMPM_AFFINE_VELOCITY:
    case PBMPM_MATERIAL:
    case PBMPM_PARTICLE:
    case PBMPM_MASS:
    case PBMPM_FIELD_FORCE32: break;
    }
    if (all_in_range(values, components, -VALUE_LIMIT, VALUE_LIMIT)) return PBMPM_OK;
    return fail(PBMPM_ERROR_INVALID_ARGUMENT, "a value is not finite or above 1e9");
}

static void write_value(World *world, pbmpm_field field, uint32_t row, const float *values)
{
    Particles *p = &world->particles;
    const int d = p->dimension;
    if (field == PBMPM_USER_VALUE) { /* matter does not feel it */
        memcpy(&p->user_value[row], values, sizeof *p->user_value);
        return;
    }
    sleep_wake_row(world, row);
    particles_forget(p, row);
    eddy_damping_forget(world);
    if (field == PBMPM_POSITION) {
        double position[3];
        for (int a = 0; a < d; a++) position[a] = (double)values[a] / (double)world->def.cell_size;
        particles_set_position(p, row, position);
    } else if (field == PBMPM_VOLUME_RATIO) {
        p->volume_ratio[row] = *values;
    } else if (field == PBMPM_PRESSURE) {
        p->pressure[row] = *values;
    } else if (field == PBMPM_VELOCITY) {
        for (int a = 0; a < d; a++) p->velocity[a][row] = values[a];
    } else {
        float **matrix = field == PBMPM_DEFORMATION ? p->deformation : p->affine;
        for (int r = 0; r < d; r++)
            for (int c = 0; c < d; c++) matrix[r * 3 + c][row] = values[r * d + c];
    }
}

pbmpm_result edit_set(World *world, pbmpm_field field, const pbmpm_particle_id *ids, uint32_t count, const void *given)
{
    Particles *p = &world->particles;
    const float *values = given; /* of 4 bytes each, whatever they are */
    if (!views_is_field(field)) return views_no_field(field);
    const uint32_t components = settable_components(world, field);
    if (components == 0) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "this field cannot be set");
    if (!ids && count != p->count) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "%u values for %u particles", count, p->count);
    uint32_t row;
    for (uint32_t i = 0; i < count; i++) {
        row = i;
        if (ids && !particles_row(p, ids[i], &row)) return edit_no_particle(ids[i], i);
        const pbmpm_result checked = check_value(world, field, row, values + (size_t)i * components, components);
        if (checked != PBMPM_OK) return checked;
    }
    pbmpm_result room = PBMPM_OK;
    if (field == PBMPM_PRESSURE) room = particles_enable_pressure(p, &world->memory);
    if (field == PBMPM_USER_VALUE) room = particles_enable_user_values(p, &world->memory);
    if (room != PBMPM_OK) return room;
    for (uint32_t i = 0; i < count; i++) {
        row = i;
        if (ids) particles_row(p, ids[i], &row);
        write_value(world, field, row, values + (size_t)i * components);
    }
    world->strain_unchecked |= field == PBMPM_DEFORMATION;
    particles_changed(p);
    world_expire_views(world);
    return PBMPM_OK;
}
