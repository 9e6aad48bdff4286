#include "snapshot/snapshot_flow.h"

#include <string.h>

#include "base/numbers.h"
#include "base/result.h"

/* ---- Materials of emitters and drains: where they stand in this world, with this world's generation ---- */

typedef enum SavedMaterial { NO_MATERIAL, LIVE_MATERIAL, DESTROYED_MATERIAL } SavedMaterial;

static uint32_t material_state(const World *world, pbmpm_material_id id)
{
    if (id.generation == 0) return NO_MATERIAL;
    return material_is_live(&world->materials, id) ? LIVE_MATERIAL : DESTROYED_MATERIAL;
}

static bool material_fits(const SnapshotIn *in, pbmpm_material_id id, uint32_t state)
{
    return state != LIVE_MATERIAL || (id.index < PBMPM_MAX_MATERIALS && in->restoring->material[id.index] >= 0);
}

static pbmpm_material_id own_material(const World *world, const SnapshotIn *in, pbmpm_material_id id, uint32_t state)
{
    if (state == NO_MATERIAL) return (pbmpm_material_id){0, 0};
    if (state != LIVE_MATERIAL) return (pbmpm_material_id){id.index, UINT32_MAX};
    const uint32_t place = (uint32_t)in->restoring->material[id.index];
    return (pbmpm_material_id){place, world->materials.generation[place]};
}

/* ---- Emitters ---- */

typedef struct EmitterMotion {
    uint32_t moving, material;
    float target_position[3], target_rotation[4];
} EmitterMotion;

typedef struct SavedEmitter {
    pbmpm_emitter_def def;
    pbmpm_shape shape;
    EmitterMotion motion;
    EmitterState state;
} SavedEmitter;

static void save_emitters(const World *world, SnapshotOut *out)
{
    for (uint32_t slot = 0; slot < world->emitters.used; slot++) {
        const Emitter *emitter = &world->emitters.slot[slot];
        if (emitter->generation == 0) continue;
        EmitterMotion motion = {.moving = emitter->moving, .material = material_state(world, emitter->def.material)};
        memcpy(motion.target_position, emitter->target_position, sizeof motion.target_position);
        memcpy(motion.target_rotation, emitter->target_rotation, sizeof motion.target_rotation);
        snapshot_put_name(out, slot, emitter->def.key);
        snapshot_put_part(out, &emitter->def, sizeof emitter->def);
        snapshot_put_part(out, &emitter->shape, sizeof emitter->shape);
        snapshot_put_part(out, &motion, sizeof motion);
        snapshot_put_part(out, &emitter->state, sizeof emitter->state);
    }
}

static bool take_emitter(SnapshotIn *in, SavedEmitter *saved)
{
    *saved = (SavedEmitter){.def = emitter_defaults(), .shape = shape_defaults()};
    const bool whole = snapshot_take_part(in, &saved->def, sizeof saved->def) && snapshot_take_part(in, &saved->shape, sizeof saved->shape) &&
                       snapshot_take_part(in, &saved->motion, sizeof saved->motion) && snapshot_take_part(in, &saved->state, sizeof saved->state);
    saved->def.size = sizeof saved->def;
    saved->shape.size = sizeof saved->shape;
    return whole;
}

/* What the world's emitter becomes: with its own parameters, or with those of the snapshot; its names stay. */
static void settle_emitter(const World *world, const SnapshotIn *in, const Emitter *own, SavedEmitter *saved)
{
    if (in->restoring->keeps) {
        const int32_t enabled = saved->def.enabled;
        saved->shape = snapshot_posed(&own->shape, &saved->shape);
        saved->def = own->def;
        saved->def.enabled = enabled;
        return;
    }
    saved->def.material = own_material(world, in, saved->def.material, saved->motion.material);
    saved->def.key = own->def.key;
    saved->def.user_data = own->def.user_data;
}

static bool emitter_fits(const World *world, const SavedEmitter *saved)
{
    pbmpm_shape target = saved->shape;
    if (saved->motion.moving) {
        memcpy(target.position, saved->motion.target_position, sizeof target.position);
        memcpy(target.rotation, saved->motion.target_rotation, sizeof target.rotation);
    }
    const int dimension = world->def.dimension;
    const double dx = (double)world->def.cell_size;
    return !emitter_problem(&saved->def, &saved->shape, dimension, dx) && !emitter_problem(&saved->def, &target, dimension, dx) &&
           in_range(saved->state.due, 0.0, 1.0);
}

static pbmpm_result check_emitters(World *world, SnapshotIn in)
{
    Matched matched = {0};
    while (snapshot_goes_on(&in)) {
        int32_t place;
        SavedEmitter saved;
        const pbmpm_result result = snapshot_take_name(world, &in, KEYED_EMITTERS, &matched, &place, NULL);
        if (result != PBMPM_OK) return result;
        if (!take_emitter(&in, &saved)) return snapshot_malformed();
        if (place < 0) continue;
        if (saved.motion.material != LIVE_MATERIAL || !material_fits(&in, saved.def.material, saved.motion.material)) return snapshot_malformed();
        settle_emitter(world, &in, &world->emitters.slot[place], &saved);
        if (!emitter_fits(world, &saved)) return snapshot_malformed();
    }
    return snapshot_all_matched(world, &in, KEYED_EMITTERS, &matched);
}

static void load_emitters(World *world, SnapshotIn in)
{
    Matched matched = {0};
    int32_t place;
    SavedEmitter saved;
    while (snapshot_goes_on(&in)) {
        snapshot_take_name(world, &in, KEYED_EMITTERS, &matched, &place, NULL);
        take_emitter(&in, &saved);
        if (place < 0) continue;
        Emitter *emitter = &world->emitters.slot[place];
        settle_emitter(world, &in, emitter, &saved);
        emitter->def = saved.def;
        emitter->shape = saved.shape;
        memcpy(emitter->target_position, saved.motion.target_position, sizeof saved.motion.target_position);
        memcpy(emitter->target_rotation, saved.motion.target_rotation, sizeof saved.motion.target_rotation);
        emitter->moving = saved.motion.moving != 0;
        emitter->state = saved.state;
    }
}

/* ---- Drains ---- */

typedef struct DrainBook {
    uint64_t drained;
    double drained_mass;
    uint64_t material;
} DrainBook;

typedef struct SavedDrain {
    pbmpm_drain_def def;
    pbmpm_shape shape;
    DrainBook book;
} SavedDrain;

static void save_drains(const World *world, SnapshotOut *out)
{
    for (uint32_t slot = 0; slot < world->sinks.used; slot++) {
        const Drain *drain = &world->sinks.slot[slot];
        if (drain->generation == 0) continue;
        const DrainBook book = {drain->drained, drain->drained_mass, material_state(world, drain->def.material)};
        snapshot_put_name(out, slot, drain->def.key);
        snapshot_put_part(out, &drain->def, sizeof drain->def);
        snapshot_put_part(out, &drain->shape, sizeof drain->shape);
        snapshot_put_part(out, &book, sizeof book);
    }
}

static bool take_drain(SnapshotIn *in, SavedDrain *saved)
{
    *saved = (SavedDrain){.def = drain_defaults(), .shape = shape_defaults()};
    const bool whole = snapshot_take_part(in, &saved->def, sizeof saved->def) && snapshot_take_part(in, &saved->shape, sizeof saved->shape) &&
                       snapshot_take_part(in, &saved->book, sizeof saved->book);
    saved->def.size = sizeof saved->def;
    saved->shape.size = sizeof saved->shape;
    return whole;
}

static void settle_drain(const World *world, const SnapshotIn *in, const Drain *own, SavedDrain *saved)
{
    if (in->restoring->keeps) {
        const int32_t enabled = saved->def.enabled;
        saved->shape = snapshot_posed(&own->shape, &saved->shape);
        saved->def = own->def;
        saved->def.enabled = enabled;
        return;
    }
    saved->def.material = own_material(world, in, saved->def.material, (uint32_t)saved->book.material);
    saved->def.key = own->def.key;
    saved->def.user_data = own->def.user_data;
}

static pbmpm_result check_drains(World *world, SnapshotIn in)
{
    Matched matched = {0};
    while (snapshot_goes_on(&in)) {
        int32_t place;
        SavedDrain saved;
        const pbmpm_result result = snapshot_take_name(world, &in, KEYED_DRAINS, &matched, &place, NULL);
        if (result != PBMPM_OK) return result;
        if (!take_drain(&in, &saved)) return snapshot_malformed();
        if (place < 0) continue;
        if (!material_fits(&in, saved.def.material, (uint32_t)saved.book.material)) return snapshot_malformed();
        settle_drain(world, &in, &world->sinks.slot[place], &saved);
        if (drain_problem(&saved.def, &saved.shape, world->def.dimension)) return snapshot_malformed();
    }
    return snapshot_all_matched(world, &in, KEYED_DRAINS, &matched);
}

static void load_drains(World *world, SnapshotIn in)
{
    Matched matched = {0};
    int32_t place;
    SavedDrain saved;
    while (snapshot_goes_on(&in)) {
        snapshot_take_name(world, &in, KEYED_DRAINS, &matched, &place, NULL);
        take_drain(&in, &saved);
        if (place < 0) continue;
        Drain *drain = &world->sinks.slot[place];
        settle_drain(world, &in, drain, &saved);
        drain_set(drain, &saved.def, &saved.shape, world->def.dimension);
        drain->drained = saved.book.drained;
        drain->drained_mass = saved.book.drained_mass;
    }
}

/* ---- Forces ---- */

typedef struct SavedForce {
    pbmpm_force_def def;
    pbmpm_shape shape;
} SavedForce;

static void save_forces(const World *world, SnapshotOut *out)
{
    for (uint32_t slot = 0; slot < world->forces.used; slot++) {
        const Force *force = &world->forces.slot[slot];
        if (force->generation == 0) continue;
        snapshot_put_name(out, slot, force->def.key);
        snapshot_put_part(out, &force->def, sizeof force->def);
        snapshot_put_part(out, &force->shape, sizeof force->shape);
    }
}

static bool take_force(SnapshotIn *in, SavedForce *saved)
{
    *saved = (SavedForce){.def = force_defaults(), .shape = shape_defaults()};
    const bool whole = snapshot_take_part(in, &saved->def, sizeof saved->def) && snapshot_take_part(in, &saved->shape, sizeof saved->shape);
    saved->def.size = sizeof saved->def;
    saved->shape.size = sizeof saved->shape;
    return whole;
}

static void settle_force(const SnapshotIn *in, const Force *own, SavedForce *saved)
{
    if (in->restoring->keeps) {
        const int32_t enabled = saved->def.enabled;
        saved->shape = snapshot_posed(&own->shape, &saved->shape);
        saved->def = own->def;
        saved->def.enabled = enabled;
        return;
    }
    saved->def.key = own->def.key;
    saved->def.user_data = own->def.user_data;
}

static pbmpm_result check_forces(World *world, SnapshotIn in)
{
    Matched matched = {0};
    while (snapshot_goes_on(&in)) {
        int32_t place;
        SavedForce saved;
        const pbmpm_result result = snapshot_take_name(world, &in, KEYED_FORCES, &matched, &place, NULL);
        if (result != PBMPM_OK) return result;
        if (!take_force(&in, &saved)) return snapshot_malformed();
        if (place < 0) continue;
        settle_force(&in, &world->forces.slot[place], &saved);
        if (force_problem(&saved.def, &saved.shape, world->def.dimension)) return snapshot_malformed();
    }
    return snapshot_all_matched(world, &in, KEYED_FORCES, &matched);
}

static void load_forces(World *world, SnapshotIn in)
{
    Matched matched = {0};
    int32_t place;
    SavedForce saved;
    while (snapshot_goes_on(&in)) {
        snapshot_take_name(world, &in, KEYED_FORCES, &matched, &place, NULL);
        take_force(&in, &saved);
        if (place < 0) continue;
        settle_force(&in, &world->forces.slot[place], &saved);
        force_set(&world->forces.slot[place], &saved.def, &saved.shape, world->def.dimension);
    }
    forces_begin_step(&world->forces); /* nothing has been done by them yet */
}

/* ---- Kill bounds and the account ---- */

typedef struct SavedFlow {
    pbmpm_kill_bounds bounds;
    pbmpm_flow flow;
} SavedFlow;

static void save_flow(const World *world, SnapshotOut *out)
{
    snapshot_put_part(out, &world->sinks.bounds, sizeof world->sinks.bounds);
    snapshot_put_part(out, &world->flow, sizeof world->flow);
}

static bool take_flow(SnapshotIn in, SavedFlow *saved)
{
    *saved = (SavedFlow){.bounds = kill_bounds_defaults()};
    const bool whole = snapshot_take_part(&in, &saved->bounds, sizeof saved->bounds) && snapshot_take_part(&in, &saved->flow, sizeof saved->flow);
    saved->bounds.size = sizeof saved->bounds;
    saved->flow.size = sizeof saved->flow;
    return whole && !snapshot_goes_on(&in);
}

static pbmpm_result check_flow(World *world, SnapshotIn in)
{
    SavedFlow saved;
    return take_flow(in, &saved) && !kill_bounds_problem(&saved.bounds, world->def.dimension) ? PBMPM_OK : snapshot_malformed();
}

static void load_flow(World *world, SnapshotIn in)
{
    SavedFlow saved;
    take_flow(in, &saved);
    if (!in.restoring->keeps) world->sinks.bounds = saved.bounds;
    world->flow = saved.flow;
}

const SnapshotSection emitters_section = {7, save_emitters, check_emitters, NULL, load_emitters};
const SnapshotSection drains_section = {8, save_drains, check_drains, NULL, load_drains};
const SnapshotSection forces_section = {9, save_forces, check_forces, NULL, load_forces};
const SnapshotSection flow_section = {10, save_flow, check_flow, NULL, load_flow};
