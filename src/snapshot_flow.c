#include "snapshot_flow.h"

#include <string.h>

#include "numbers.h"
#include "result.h"

/* ---- Materials of emitters and drains: the same index, with this world's generation ---- */

typedef enum SavedMaterial { NO_MATERIAL, LIVE_MATERIAL, DESTROYED_MATERIAL } SavedMaterial;

static SavedMaterial material_state(const World *world, pbmpm_material_id id)
{
    if (id.generation == 0) return NO_MATERIAL;
    return material_is_live(&world->materials, id) ? LIVE_MATERIAL : DESTROYED_MATERIAL;
}

static bool material_fits(const World *world, pbmpm_material_id id, uint32_t state)
{
    return state != LIVE_MATERIAL || (id.index < PBMPM_MAX_MATERIALS && world->materials.generation[id.index] != 0);
}

static pbmpm_material_id own_material(const World *world, pbmpm_material_id id, uint32_t state)
{
    if (state == NO_MATERIAL) return (pbmpm_material_id){0, 0};
    return (pbmpm_material_id){id.index, state == LIVE_MATERIAL ? world->materials.generation[id.index] : UINT32_MAX};
}

/* ---- Emitters ---- */

typedef struct SavedEmitter {
    uint32_t slot, moving, material;
    float target_position[3], target_rotation[4];
    pbmpm_emitter_def def;
    EmitterState state;
} SavedEmitter;

static void save_emitters(const World *world, SnapshotOut *out)
{
    for (uint32_t slot = 0; slot < world->emitters.used; slot++) {
        const Emitter *emitter = &world->emitters.slot[slot];
        if (emitter->generation == 0) continue;
        SavedEmitter saved;
        memset(&saved, 0, sizeof saved); /* the padding, too */
        saved.slot = slot;
        saved.moving = emitter->moving;
        saved.material = material_state(world, emitter->def.material);
        memcpy(saved.target_position, emitter->target_position, sizeof saved.target_position);
        memcpy(saved.target_rotation, emitter->target_rotation, sizeof saved.target_rotation);
        saved.def = emitter->def;
        saved.state = emitter->state;
        snapshot_put(out, &saved, sizeof saved);
    }
}

static bool emitter_fits(const World *world, const SavedEmitter *saved)
{
    pbmpm_emitter_def target = saved->def;
    if (saved->moving) {
        memcpy(target.shape.position, saved->target_position, sizeof target.shape.position);
        memcpy(target.shape.rotation, saved->target_rotation, sizeof target.shape.rotation);
    }
    const int dimension = world->def.dimension;
    const double dx = (double)world->def.cell_size;
    return saved->material == LIVE_MATERIAL && material_fits(world, saved->def.material, saved->material) &&
           !emitter_problem(&saved->def, dimension, dx) && !emitter_problem(&target, dimension, dx) &&
           in_range(saved->state.due, 0.0, 1.0);
}

static pbmpm_result check_emitters(World *world, SnapshotIn in)
{
    for (uint32_t slot = 0; slot < world->emitters.used; slot++) {
        if (world->emitters.slot[slot].generation == 0) continue;
        SavedEmitter saved;
        const pbmpm_result result = snapshot_take_slot(&in, &saved, sizeof saved, slot, "emitters");
        if (result != PBMPM_OK) return result;
        if (!emitter_fits(world, &saved)) return snapshot_malformed();
    }
    return snapshot_at_end(&in, "emitters");
}

static void load_emitters(World *world, SnapshotIn in)
{
    SavedEmitter saved;
    while (snapshot_take(&in, &saved, sizeof saved)) {
        Emitter *emitter = &world->emitters.slot[saved.slot];
        emitter->def = saved.def;
        emitter->def.material = own_material(world, saved.def.material, saved.material);
        memcpy(emitter->target_position, saved.target_position, sizeof saved.target_position);
        memcpy(emitter->target_rotation, saved.target_rotation, sizeof saved.target_rotation);
        emitter->moving = saved.moving != 0;
        emitter->state = saved.state;
    }
}

/* ---- Drains ---- */

typedef struct SavedDrain {
    uint32_t slot, material;
    pbmpm_drain_def def;
    uint64_t drained;
    double drained_mass;
} SavedDrain;

static void save_drains(const World *world, SnapshotOut *out)
{
    for (uint32_t slot = 0; slot < world->sinks.used; slot++) {
        const Drain *drain = &world->sinks.slot[slot];
        if (drain->generation == 0) continue;
        SavedDrain saved;
        memset(&saved, 0, sizeof saved);
        saved.slot = slot;
        saved.material = material_state(world, drain->def.material);
        saved.def = drain->def;
        saved.drained = drain->drained;
        saved.drained_mass = drain->drained_mass;
        snapshot_put(out, &saved, sizeof saved);
    }
}

static pbmpm_result check_drains(World *world, SnapshotIn in)
{
    for (uint32_t slot = 0; slot < world->sinks.used; slot++) {
        if (world->sinks.slot[slot].generation == 0) continue;
        SavedDrain saved;
        const pbmpm_result result = snapshot_take_slot(&in, &saved, sizeof saved, slot, "drains");
        if (result != PBMPM_OK) return result;
        if (!material_fits(world, saved.def.material, saved.material) || drain_problem(&saved.def, world->def.dimension))
            return snapshot_malformed();
    }
    return snapshot_at_end(&in, "drains");
}

static void load_drains(World *world, SnapshotIn in)
{
    SavedDrain saved;
    while (snapshot_take(&in, &saved, sizeof saved)) {
        Drain *drain = &world->sinks.slot[saved.slot];
        saved.def.material = own_material(world, saved.def.material, saved.material);
        drain_set(drain, &saved.def, world->def.dimension);
        drain->drained = saved.drained;
        drain->drained_mass = saved.drained_mass;
    }
}

/* ---- Forces ---- */

typedef struct SavedForce {
    uint32_t slot;
    pbmpm_force_def def;
} SavedForce;

static void save_forces(const World *world, SnapshotOut *out)
{
    for (uint32_t slot = 0; slot < world->forces.used; slot++) {
        if (world->forces.slot[slot].generation == 0) continue;
        const SavedForce saved = {slot, world->forces.slot[slot].def};
        snapshot_put(out, &saved, sizeof saved);
    }
}

static pbmpm_result check_forces(World *world, SnapshotIn in)
{
    for (uint32_t slot = 0; slot < world->forces.used; slot++) {
        if (world->forces.slot[slot].generation == 0) continue;
        SavedForce saved;
        const pbmpm_result result = snapshot_take_slot(&in, &saved, sizeof saved, slot, "forces");
        if (result != PBMPM_OK) return result;
        if (force_problem(&saved.def, world->def.dimension)) return snapshot_malformed();
    }
    return snapshot_at_end(&in, "forces");
}

static void load_forces(World *world, SnapshotIn in)
{
    SavedForce saved;
    while (snapshot_take(&in, &saved, sizeof saved)) force_set(&world->forces.slot[saved.slot], &saved.def, world->def.dimension);
    forces_begin_step(&world->forces); /* nothing has been done by them yet */
}

/* ---- Kill bounds and the account ---- */

typedef struct SavedFlow {
    pbmpm_kill_bounds bounds;
    pbmpm_flow flow;
} SavedFlow;

static void save_flow(const World *world, SnapshotOut *out)
{
    const SavedFlow saved = {world->sinks.bounds, world->flow};
    snapshot_put(out, &saved, sizeof saved);
}

static pbmpm_result check_flow(World *world, SnapshotIn in)
{
    SavedFlow saved;
    if (in.bytes != sizeof saved || !snapshot_take(&in, &saved, sizeof saved)) return snapshot_malformed();
    if (saved.flow.size != sizeof saved.flow || kill_bounds_problem(&saved.bounds, world->def.dimension)) return snapshot_malformed();
    return PBMPM_OK;
}

static void load_flow(World *world, SnapshotIn in)
{
    SavedFlow saved;
    snapshot_take(&in, &saved, sizeof saved);
    world->sinks.bounds = saved.bounds;
    world->flow = saved.flow;
}

const SnapshotSection emitters_section = {7, save_emitters, check_emitters, NULL, load_emitters};
const SnapshotSection drains_section = {8, save_drains, check_drains, NULL, load_drains};
const SnapshotSection forces_section = {9, save_forces, check_forces, NULL, load_forces};
const SnapshotSection flow_section = {10, save_flow, check_flow, NULL, load_flow};
