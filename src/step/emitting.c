#include "step/emitting.h"

#include <math.h>
#include <string.h>

#include "base/generations.h"
#include "base/random.h"
#include "base/result.h"
#include "step/occupancy.h"

/* ---- Amounts ---- */

/* Rest volume of a particle [cells]. */
static double particle_volume(const pbmpm_emitter_def *def, int dimension)
{
    const double edge = 1.0 / (double)def->particles_per_axis;
    return dimension == 3 ? edge * edge * edge : edge * edge;
}

/* As it is stored [kg/m^d]. */
static float particle_mass(const World *world, const pbmpm_emitter_def *def)
{
    const double density = (double)world->materials.def[def->material.index].density;
    return (float)(density * particle_volume(def, world->def.dimension));
}

/* Particles per second. */
static double particle_rate(const World *world, const pbmpm_emitter_def *def)
{
    return (double)def->rate / (particle_volume(def, world->def.dimension) * world_cell_volume(world));
}

static bool works(const Emitter *emitter)
{
    return emitter->generation != 0 && emitter->def.enabled && emitter->def.rate > 0.0f;
}

/* ---- Where ---- */

/* The region at one time, and what the particles born in it do. */
typedef struct Nozzle {
    pbmpm_emitter_region region;
    Solid solid;
    double axis[3], across[2][3]; /* unit vectors: along the speed, and perpendicular to it (2D: only the first) */
} Nozzle;

/* Two unit vectors that are perpendicular to `axis` and each other; the second only in 3D. */
static void find_across(const double axis[3], int dimension, double across[2][3])
{
    memset(across, 0, 2 * sizeof *across);
    if (dimension == 2) {
        across[0][0] = -axis[1];
        across[0][1] = axis[0];
        return;
    }
    int thin = 0; /* the axis of the world that is farthest from `axis` */
    for (int a = 1; a < 3; a++)
        if (fabs(axis[a]) < fabs(axis[thin])) thin = a;
    double length = 0.0;
    for (int a = 0; a < 3; a++) {
        across[0][a] = (a == thin ? 1.0 : 0.0) - axis[thin] * axis[a];
        length += across[0][a] * across[0][a];
    }
    for (int a = 0; a < 3; a++) across[0][a] /= sqrt(length);
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        across[1][a] = axis[b] * across[0][c] - axis[c] * across[0][b];
    }
}

/* At the share `t` of the way of the step. */
static Nozzle nozzle_at(const Emitter *emitter, int dimension, float t)
{
    const pbmpm_emitter_def *def = &emitter->def;
    pbmpm_shape shape = emitter_enclosing_shape(def, &emitter->shape);
    if (emitter->moving) shape = shape_between(&shape, emitter->target_position, emitter->target_rotation, t);
    Nozzle nozzle = {.region = def->region, .solid = solid_of(&shape, dimension)};
    double length = 0.0;
    for (int a = 0; a < dimension; a++) length += (double)def->direction[a] * (double)def->direction[a];
    for (int a = 0; a < dimension; a++)
        for (int b = 0; b < dimension; b++)
            nozzle.axis[a] += nozzle.solid.rotation[a * 3 + b] * (double)def->direction[b] / sqrt(length);
    find_across(nozzle.axis, dimension, nozzle.across);
    return nozzle;
}

/* What the random numbers of an emitter are for; no two use the same one. */
enum { FOR_PLACE = 0, FOR_VELOCITY = 3, FOR_OFFSET = 5, PURPOSES = 8 };

/* In [-1/2, 1/2). */
static double random_of(const pbmpm_emitter_def *def, uint64_t number, int purpose)
{
    return random_number(def->seed, number * PURPOSES + (uint64_t)purpose);
}

/* The additive sequence with the steps 1/g, 1/g^2, .. where g^(n+1) = g + 1 for n dimensions, which fills a square or cube evenly
 * however many of its points are taken (M. Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018). In [-1, 1). */
static double sequence(const pbmpm_emitter_def *def, uint64_t number, int axis, int axes)
{
    static const double root[] = {1.6180339887498949, 1.3247179572447460, 1.2207440846057596};
    const double step = pow(root[axes - 1], -(axis + 1.0));
    const uint64_t offset = (uint64_t)((random_of(def, 0, FOR_OFFSET + axis) + 0.5) * 0x1p64);
    const uint64_t point = offset + number * (uint64_t)(step * 0x1p64); /* modulo 1, exactly */
    return (double)(point >> 11) * 0x1p-52 - 1.0;
}

/* How far the region reaches along an axis of its own [m]. */
static double half_of(const Nozzle *nozzle, int axis)
{
    const Solid *solid = &nozzle->solid;
    if (nozzle->region == PBMPM_EMIT_VOLUME && solid->kind == PBMPM_BOX) return solid->half_extents[axis];
    const bool long_axis = nozzle->region == PBMPM_EMIT_VOLUME && solid->kind == PBMPM_CAPSULE && axis == 0;
    return solid->radius + (long_axis ? solid->half_extents[0] : 0.0);
}

/* A point of the ball, capsule or box in its own axes; `u` in the cube. False: outside. */
static bool point_in_shape(const Nozzle *nozzle, const double u[3], double local[3])
{
    const Solid *solid = &nozzle->solid;
    double beyond = 0.0;
    for (int a = 0; a < solid->dimension; a++) {
        const double along = solid->kind == PBMPM_CAPSULE && a == 0 ? solid->half_extents[0] : 0.0;
        local[a] = u[a] * half_of(nozzle, a);
        const double past = fmax(0.0, fabs(local[a]) - along);
        beyond += past * past;
    }
    return solid->kind == PBMPM_BOX || beyond <= solid->radius * solid->radius;
}

static bool point_of(const Nozzle *nozzle, const double u[3], double point[3])
{
    const Solid *solid = &nozzle->solid;
    const int d = solid->dimension;
    memcpy(point, solid->position, 3 * sizeof *point);
    if (nozzle->region == PBMPM_EMIT_DISC) {
        const double length2 = u[0] * u[0] + (d == 3 ? u[1] * u[1] : 0.0);
        for (int a = 0; a < d; a++) point[a] += solid->radius * (u[0] * nozzle->across[0][a] + (d == 3 ? u[1] * nozzle->across[1][a] : 0.0));
        return length2 <= 1.0;
    }
    double local[3] = {0};
    const bool within = point_in_shape(nozzle, u, local);
    for (int a = 0; a < d; a++)
        for (int b = 0; b < d; b++) point[a] += solid->rotation[a * 3 + b] * local[b];
    return within;
}

/* What is inside shall be so after positions are rounded to floats. */
static const double EDGE = 1.0 - 0x1p-20;

/* The next point of the region. The sequence is a lattice in disguise, and shows as stripes where a stream is stretched: so each point
 * is moved at random, as those of a fill are. A ball takes half of a cube's points, so that none of 64 is in it does not happen; then it is the last.
 * `spacing`: distance of particles [m]. */
static void draw_point(Emitter *emitter, const Nozzle *nozzle, double spacing, double point[3])
{
    const int axes = nozzle->solid.dimension - (nozzle->region == PBMPM_EMIT_DISC ? 1 : 0);
    for (int attempt = 0; attempt < 64; attempt++) {
        double u[3] = {0};
        const uint64_t number = emitter->state.drawn++;
        for (int a = 0; a < axes; a++) {
            const double way = (double)PLACE_JITTER * spacing * random_of(&emitter->def, number, FOR_PLACE + a);
            u[a] = sequence(&emitter->def, number, a, axes) + way / half_of(nozzle, a);
            if (fabs(u[a]) > 1.0) u[a] = copysign(2.0 - fabs(u[a]), u[a]); /* thrown back by the end of the region */
            u[a] *= EDGE;
        }
        if (point_of(nozzle, u, point)) return;
    }
}

/* A velocity inside the cone, evenly over its solid angle (2D: its angle). */
static void draw_velocity(const Emitter *emitter, const Nozzle *nozzle, double velocity[3])
{
    const pbmpm_emitter_def *def = &emitter->def;
    const double first = random_of(def, emitter->state.born, FOR_VELOCITY) + 0.5;
    const double second = random_of(def, emitter->state.born, FOR_VELOCITY + 1);
    const bool deep = nozzle->solid.dimension == 3;
    const double cosine = deep ? 1.0 - first * (1.0 - cos((double)def->spread)) : cos((2.0 * first - 1.0) * (double)def->spread);
    const double sine = deep ? sqrt(fmax(0.0, 1.0 - cosine * cosine)) : sin((2.0 * first - 1.0) * (double)def->spread);
    const double turn = deep ? 2.0 * M_PI * second : 0.0;
    for (int a = 0; a < 3; a++)
        velocity[a] = (double)def->speed *
                      (cosine * nozzle->axis[a] + sine * (cos(turn) * nozzle->across[0][a] + sin(turn) * nozzle->across[1][a]));
}

/* ---- Whether there is space ---- */

/* The nodes that particles which appear in this part can touch: in the domain, and as far out of it as to see that its walls are closed. */
static Occupancy occupancy_bounds(const World *world, const Emitter *emitter, int part)
{
    const double dx = (double)world->def.cell_size, dt = world->substep.dt, parts = world->settings.substeps;
    double gravity2 = 0.0;
    for (int a = 0; a < world->def.dimension; a++) gravity2 += (double)world->settings.gravity[a] * (double)world->settings.gravity[a];
    const double way = ((double)emitter->def.speed + sqrt(gravity2) * dt) * dt / dx;
    const double reach = fmin(way, (double)world->settings.max_displacement) + OCCUPANCY_WIDE + 2.0;
    Occupancy occupancy = {.size = {1, 1, 1}, .groups = world->materials.def[emitter->def.material.index].groups};
    double low[2][3], high[2][3];
    for (int end = 0; end < 2; end++) {
        const Nozzle nozzle = nozzle_at(emitter, world->def.dimension, (float)((part + end) / parts));
        solid_bounds(&nozzle.solid, low[end], high[end]);
    }
    for (int a = 0; a < world->def.dimension; a++) {
        double first = fmin(low[0][a], low[1][a]) / dx - reach, last = fmax(high[0][a], high[1][a]) / dx + reach;
        const double inmost = world->domain.low[a] / dx, outmost = world->domain.high[a] / dx; /* infinite where no wall is */
        first = fmin(fmax(first, inmost - OCCUPANCY_RIM), outmost);
        last = fmax(fmin(last, outmost + OCCUPANCY_RIM), inmost);
        occupancy.low[a] = (int32_t)floor(first);
        occupancy.size[a] = (int32_t)fmax(ceil(last) - floor(first) + 1.0, 1.0);
    }
    return occupancy;
}

/* ---- Births ---- */

/* Farther from an obstacle than this [cells] all nodes that count are open: OCCUPANCY_WIDE + 1/2 and their support, 3/2, along the axes. Across them it is 4 sqrt(d), 6.93
 * in 3D: what lies beyond has hardly any weight. */
static const double FREE = 6.5;

/* A place on a surface is not inside it, whatever rounding says. */
static const double SURFACE = 0.01;

/* A particle of an emitter in one part of a step. */
typedef struct Birth {
    double since;    /* from its birth to the end of the part [s] */
    double point[3]; /* where it was born [m] */
    double velocity[3];
} Birth;

/* Whether there is space for it at the point [m]; then it is added. The mean over all nodes around a stream is less than its own filling, by what is empty beside it: alone it lets a stream of 6 by 2 cells be 1.6 (2D) to
 * 2 times (3D) as full as it should. Liquid spreads then. A solid keeps the room that it was born with as its own, so it is asked how full its own space is: that lets 1.2 times in, and all of a stream that is just full, which
 * measures 0.92 at most (6 cells wide, 0.5 to 6 m/s, 2D and 3D, without gravity). Its own nodes may hold more, by the noise of seeding. */
static bool add_if_room(World *world, Emitter *emitter, Occupancy *occupancy, const Birth *birth, const double point[3], double clear, uint32_t generation)
{
    const int d = world->def.dimension;
    const double dx = (double)world->def.cell_size;
    double place[3] = {0};
    Spot spot;
    for (int a = 0; a < d; a++) place[a] = point[a] / dx;
    if (!occupancy_find(occupancy, d, place, &spot)) return false;
    const double limit = (double)emitter->def.fill_limit;
    if (occupancy->held + particle_volume(&emitter->def, d) > limit * occupancy->room) return false;
    if (occupancy_density(occupancy, d, &spot) > (double)K_SEEDING_NOISE * limit || occupancy_filling(world, occupancy, place, clear < FREE) > limit) return false;
    if (material_is_solid(&world->materials, emitter->def.material.index) && occupancy_crowding(occupancy, d, place) > limit) return false;
    NewParticle particle = {.mass = particle_mass(world, &emitter->def), .material = emitter->def.material.index, .user_value = emitter->def.user_value};
    for (int a = 0; a < d; a++) {
        particle.position[a] = place[a];
        particle.velocity[a] = (float)(birth->velocity[a] + (double)world->settings.gravity[a] * birth->since);
    }
    particles_append(&world->particles, &particle, generation);
    occupancy_add(occupancy, d, &spot, particle_volume(&emitter->def, d));
    emitter->state.emitted++;
    return true;
}

/* Where it has come to, x + v t + g t^2 / 2, at most max_displacement; where it was born if something is in the way. */
static bool emit_particle(World *world, Emitter *emitter, Occupancy *occupancy, const Birth *birth, uint32_t generation)
{
    double point[3] = {0}, way[3] = {0}, length = 0.0;
    for (int a = 0; a < world->def.dimension; a++) {
        way[a] = (birth->velocity[a] + 0.5 * (double)world->settings.gravity[a] * birth->since) * birth->since;
        length += way[a] * way[a];
    }
    const double limit = (double)world->settings.max_displacement * (double)world->def.cell_size;
    const double slow = length > limit * limit ? limit / sqrt(length) : 1.0;
    for (int a = 0; a < world->def.dimension; a++) point[a] = birth->point[a] + slow * way[a];
    double clear = occupancy_clearance(world, occupancy, point);
    if (clear < 0.0) { /* something is in the way */
        memcpy(point, birth->point, sizeof point);
        clear = occupancy_clearance(world, occupancy, point);
    }
    if (clear < -SURFACE) return false;
    const Domain *domain = &world->domain;
    for (int a = 0; a < world->def.dimension; a++) point[a] = fmin(fmax(point[a], domain->low[a]), domain->high[a]);
    return add_if_room(world, emitter, occupancy, birth, point, clear, generation);
}

/* Particles that come due in a part of a step, counted as far as anybody can. */
static double count_due(const World *world, const Emitter *emitter)
{
    return fmin(floor(emitter->state.due + particle_rate(world, &emitter->def) * world->substep.dt), 1e15);
}

static void tell_refusals(World *world, const Emitter *emitter, uint64_t refused, int part)
{
    if (refused == 0) return;
    pbmpm_event event = {.kind = PBMPM_EVENT_EMISSION_REFUSED, .count = refused > UINT32_MAX ? UINT32_MAX : (uint32_t)refused,
                         .substep = (uint32_t)part, .step = world->step_count};
    for (int a = 0; a < world->def.dimension; a++) event.position[a] = emitter->shape.position[a];
    events_add(&world->events, &event);
    world->flow.refused += refused;
}

/* The j-th birth is when `due` passes the number j. */
static void emit(World *world, Emitter *emitter, Occupancy *occupancy, uint64_t due, int part)
{
    EmitterState *state = &emitter->state;
    const EmitterState before = *state;
    const double rate = particle_rate(world, &emitter->def), dt = world->substep.dt, parts = world->settings.substeps;
    const double spacing = (double)world->def.cell_size / (double)emitter->def.particles_per_axis;
    const uint32_t generation = generation_next_of_particles();
    const uint64_t budget = emitter->def.budget ? emitter->def.budget : UINT64_MAX;
    Nozzle nozzle = nozzle_at(emitter, world->def.dimension, (float)((part + 1) / parts));
    uint64_t j = 1;
    for (; j <= due && j <= world->particles.capacity; j++) {
        if (state->emitted >= budget || world->particles.count >= world->particles.capacity) break;
        const double after = fmin(fmax(((double)j - before.due) / rate, 0.0), dt);
        Birth birth = {.since = dt - after};
        if (emitter->moving) nozzle = nozzle_at(emitter, world->def.dimension, (float)((part + after / dt) / parts));
        draw_point(emitter, &nozzle, spacing, birth.point);
        draw_velocity(emitter, &nozzle, birth.velocity);
        state->born++;
        if (!emit_particle(world, emitter, occupancy, &birth, generation)) state->refused_full++;
    }
    const uint64_t rest = due - (j - 1);
    state->born += rest;
    *(state->emitted >= budget ? &state->refused_budget : &state->refused_capacity) += rest;
    const uint64_t emitted = state->emitted - before.emitted;
    const double mass = (double)emitted * (double)particle_mass(world, &emitter->def) * world_cell_volume(world);
    state->emitted_mass += mass;
    world->flow.emitted += emitted;
    world->flow.emitted_mass += mass;
    tell_refusals(world, emitter, due - emitted, part);
}

/* Where the way adds more nodes than there are at its end, and too many, there is none. */
static void jump_if_far(const World *world, Emitter *emitter, Occupancy *occupancy, int part)
{
    Emitter there = *emitter;
    emitter_arrive(&there);
    const Occupancy end = occupancy_bounds(world, &there, part);
    if (occupancy_nodes(occupancy) <= occupancy_nodes(&end) + EMITTER_CELLS_MAX) return;
    *emitter = there;
    *occupancy = end;
}

pbmpm_result emitters_prepare(World *world, int part)
{
    Emitters *emitters = &world->emitters;
    for (uint32_t slot = 0; slot < emitters->used; slot++) {
        Emitter *emitter = &emitters->slot[slot];
        if (!works(emitter) || count_due(world, emitter) < 1.0) continue;
        pbmpm_result room = world_make_room_for(world, emitter->def.material.index);
        if (room == PBMPM_OK && emitter->def.user_value) room = particles_enable_user_values(&world->particles, &world->memory);
        if (room != PBMPM_OK) return room;
        Occupancy occupancy = occupancy_bounds(world, emitter, part);
        if (emitter->moving && occupancy_nodes(&occupancy) > EMITTER_CELLS_MAX) jump_if_far(world, emitter, &occupancy, part);
        if (occupancy_nodes(&occupancy) > 1e9 || !array_reserve(&world->memory, &emitters->occupancy, (size_t)occupancy_nodes(&occupancy), sizeof(float)))
            return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the %.0f nodes around an emitter and its way", occupancy_nodes(&occupancy));
    }
    return PBMPM_OK;
}

void emitters_run(World *world, int part)
{
    Emitters *emitters = &world->emitters;
    for (uint32_t slot = 0; slot < emitters->used; slot++) {
        Emitter *emitter = &emitters->slot[slot];
        if (!works(emitter)) continue;
        const double due = count_due(world, emitter);
        if (due >= 1.0) {
            Occupancy occupancy = occupancy_bounds(world, emitter, part);
            occupancy.volume = emitters->occupancy.data;
            occupancy_measure(world, &occupancy);
            emit(world, emitter, &occupancy, (uint64_t)due, part);
        }
        const double total = emitter->state.due + particle_rate(world, &emitter->def) * world->substep.dt;
        emitter->state.due = total - floor(total);
    }
}
