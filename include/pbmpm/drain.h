/* pbmpm: drains and kill bounds, which take matter out while the world runs, and totals of what came and went. */
#ifndef PBMPM_DRAIN_H
#define PBMPM_DRAIN_H

#include "material.h"
#include "shape.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    PBMPM_MAX_DRAINS = 256 /**< per world */
};

/** A drain of one world. */
typedef struct pbmpm_drain_id {
    uint32_t index;
    uint32_t generation;
} pbmpm_drain_id;

/** A shape that takes out the particles inside it. It looks at the end of each substep: a particle that crosses a thin drain
 *  within a substep is not seen. A particle inside several drains is counted by the one with the lowest identifier index. */
typedef struct pbmpm_drain_def {
    uint32_t size;              /**< sizeof(pbmpm_drain_def), set by pbmpm_drain_def_init() */
    int32_t enabled;            /**< 1 (default): takes; 0: rests */
    pbmpm_material_id material; /**< the material it takes, none once that is destroyed; all zero (default): every one */
    uint64_t key;       /**< unique number among the world's drains, by which snapshots match it; 0 (default): matched by the index
                             of its identifier instead, see snapshot.h */
    uint64_t user_data; /**< the host's own; the library only keeps it; default 0 */
} pbmpm_drain_def;

/** What a drain has taken since it was created. */
typedef struct pbmpm_drain_status {
    uint32_t size;       /**< sizeof(pbmpm_drain_status), set by the caller */
    uint32_t reserved;   /**< 0 */
    uint64_t drained;    /**< particles */
    double drained_mass; /**< [kg] (2D: per metre of depth) */
} pbmpm_drain_status;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any. */
PBMPM_API pbmpm_result pbmpm_drain_def_init(pbmpm_drain_def *def, size_t size);

/** Adds a drain. `shape`: any kind but PBMPM_BAKED.
 *  Errors: INVALID_ID (world, material), INVALID_ARGUMENT, CAPACITY, OUT_OF_MEMORY, UNSUPPORTED, BUSY, FORKED.
 *  Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_drain_create(pbmpm_world_id world, const pbmpm_drain_def *def, const pbmpm_shape *shape, pbmpm_drain_id *drain);

/** Takes a drain away. Errors: INVALID_ID, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_drain_destroy(pbmpm_world_id world, pbmpm_drain_id drain);

/** Whether an identifier is that of a drain of the world. *valid is then 1, else 0 (null, stale, foreign, or the world is gone),
 *  which is no error.
 *  Errors: INVALID_ARGUMENT (null), BUSY, FORKED; *valid is then as before. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_drain_is_valid(pbmpm_world_id world, pbmpm_drain_id drain, int32_t *valid);

/** Lists the drains of the world, in no particular order. *count is how many there are; the first `capacity` of them are written
 *  to `drains`, which may be null with a capacity of 0. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_get_drains(pbmpm_world_id world, pbmpm_drain_id *drains, uint32_t capacity, uint32_t *count);

/** Reads the definition and the shape. Either may be null; set `size` in what is not.
 *  Errors: INVALID_ID, UNSUPPORTED, BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_drain_get(pbmpm_world_id world, pbmpm_drain_id drain, pbmpm_drain_def *def, pbmpm_shape *shape);

/** Changes a drain (its place, too). With a null `def` or `shape` that part stays unchanged. So do members that an older caller's
 *  smaller structure lacks. The counts are kept.
 *  Errors as pbmpm_drain_create(), except CAPACITY and OUT_OF_MEMORY. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_drain_set(pbmpm_world_id world, pbmpm_drain_id drain, const pbmpm_drain_def *def, const pbmpm_shape *shape);

/** Counts since creation. `status->size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_drain_status_get(pbmpm_world_id world, pbmpm_drain_id drain, pbmpm_drain_status *status);

/** The box that particles live in. Those outside at the end of a substep are taken out, with one PBMPM_EVENT_KILLED per substep.
 *  Unlike the domain it has no walls. Without bounds, matter that falls for ever goes on using particle_capacity and time. */
typedef struct pbmpm_kill_bounds {
    uint32_t size;   /**< sizeof(pbmpm_kill_bounds), set by pbmpm_kill_bounds_init() */
    int32_t enabled; /**< 0 (default): no bounds; 1: bounds */
    float low[3];    /**< lower corner [m], relative to the origin, in [-1e9, 1e9]; default 0 */
    float high[3];   /**< upper corner [m], above the lower one per axis, in [-1e9, 1e9]; default 1 */
} pbmpm_kill_bounds;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any. */
PBMPM_API pbmpm_result pbmpm_kill_bounds_init(pbmpm_kill_bounds *bounds, size_t size);

/** Sets or removes the bounds. Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_world_set_kill_bounds(pbmpm_world_id world, const pbmpm_kill_bounds *bounds);

/** Reads the bounds. `bounds->size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_get_kill_bounds(pbmpm_world_id world, pbmpm_kill_bounds *bounds);

/** Totals since the world was created, including those of destroyed emitters and drains.
 *  Particles now = those added by calls - those removed by calls + emitted - drained - killed - pbmpm_stats.deleted_total. */
typedef struct pbmpm_flow {
    uint32_t size;       /**< sizeof(pbmpm_flow), set by the caller */
    uint32_t reserved;   /**< 0 */
    uint64_t emitted;    /**< particles */
    uint64_t refused;    /**< particles that were due and not emitted, for any reason */
    uint64_t drained;    /**< particles */
    uint64_t killed;     /**< particles that left the kill bounds */
    double emitted_mass; /**< [kg] (2D: per metre of depth) */
    double drained_mass; /**< [kg] */
    double killed_mass;  /**< [kg] */
} pbmpm_flow;

/** Reads the totals. `flow->size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_get_flow(pbmpm_world_id world, pbmpm_flow *flow);

#ifdef __cplusplus
}
#endif
#endif
