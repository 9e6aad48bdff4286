/* Every public call that takes a world, as a table: for tests that hold for all of them. */
#ifndef PBMPM_TESTS_API_CALLS_H
#define PBMPM_TESTS_API_CALLS_H

#include "scenes.h"

/** A world with one of everything. */
typedef struct target {
    pbmpm_world_id world;
    pbmpm_material_id material; /**< elastic; particles use it */
    pbmpm_material_id spare;    /**< liquid; no particle uses it */
    pbmpm_collider_id collider; /**< kinematic; measures its impulse, as the walls do */
    pbmpm_particle_id particle; /**< elastic */
    pbmpm_emitter_id emitter;   /**< of the material; its rate is 0 */
    pbmpm_drain_id drain;       /**< where there is nothing */
    pbmpm_force_id force;       /**< switched off */
    pbmpm_baked_id baked;       /**< nothing refers to it */
} target;

/** Identifiers that a call takes besides the world's. */
enum {
    USES_MATERIAL = 1, USES_SPARE = 2, USES_COLLIDER = 4, USES_PARTICLE = 8,
    USES_EMITTER = 16, USES_DRAIN = 32, USES_FORCE = 64, USES_BAKED = 128
};

typedef struct world_call {
    const char *name;
    /** Makes the call with good arguments and these identifiers. Safe on any thread. */
    pbmpm_result (*make)(const target *ids);
    unsigned uses;
} world_call;

/** pbmpm_world_destroy() is the last row; rows before it can be made in this order on one target. */
extern const world_call world_calls[];
extern const int world_call_count;

/** Loads a small baked triangle into a 2D world. */
pbmpm_result load_triangle(pbmpm_world_id world, pbmpm_baked_id *baked);

/** A 2D world in a box of 2 m with an elastic block of 256 particles, a spare material and a kinematic collider. */
target target_create(scene_tweak *tweak, void *user);

#endif
