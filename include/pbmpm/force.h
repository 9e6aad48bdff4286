/* pbmpm: forces on matter besides gravity. */
#ifndef PBMPM_FORCE_H
#define PBMPM_FORCE_H

#include "shape.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    PBMPM_MAX_FORCES = 64 /**< per world */
};

/** A force of one world. */
typedef struct pbmpm_force_id {
    uint32_t index;
    uint32_t generation;
} pbmpm_force_id;

/** What a force does. c: the shape's position; r = x - c; s: the share that is felt at x, see pbmpm_falloff; dx: the cell size.
 *  Nearer than dx to the centre or the axis, RADIAL and VORTEX fall to 0. */
typedef enum pbmpm_force_kind {
    PBMPM_FORCE_UNIFORM = 0, /**< acceleration strength * s along `direction` */
    PBMPM_FORCE_RADIAL = 1,  /**< acceleration strength * s * r / max(|r|, dx): pushes away, or pulls when negative */
    PBMPM_FORCE_VORTEX = 2,  /**< acceleration strength * s * (n cross r) / max(|n cross r|, dx) about the axis n = `direction`
                                  through c; 2D: n points along the third axis: counter-clockwise */
    PBMPM_FORCE_DRAG = 3,    /**< acceleration -k (v - w) with k = strength * s and w = velocity + spin * (n cross r): wind, a
                                  whirl, or, with w = 0, a brake. Negative strengths are refused. */
    PBMPM_FORCE_GRAB = 4,    /**< drags matter to the velocity w (as DRAG) with k = -60 ln(1 - s) [1/s]. Where s = 1 matter has
                                  exactly w, except within a cell of obstacles. Its force has no bound; DRAG has one */
    PBMPM_FORCE_KIND_FORCE32 = 0x7fffffff
} pbmpm_force_kind;

/** The share s of a force at the distance d outside of its shape; inside of it s = 1. */
typedef enum pbmpm_falloff {
    PBMPM_FALLOFF_NONE = 0,           /**< 1 up to d = range, then 0 */
    PBMPM_FALLOFF_LINEAR = 1,         /**< 1 - d / range, not below 0 */
    PBMPM_FALLOFF_SMOOTH = 2,         /**< (1 - (d / range)^2)^2 up to d = range, then 0 */
    PBMPM_FALLOFF_INVERSE_SQUARE = 3, /**< (1 + d / range)^-2 at any distance; around a ball of radius `range`: its gravity */
    PBMPM_FALLOFF_FORCE32 = 0x7fffffff
} pbmpm_falloff;

/** A force. Fill it with pbmpm_force_def_init(), then change what differs.
 *
 *  Forces act on grid nodes at the start of each substep, before materials and obstacles. Nodes that a GRAB holds with s = 1 also
 *  keep their velocity while materials act. Blocks (4^d cells) that no force reaches cost nothing.
 *  Let v be a node's velocity as its particles give it. a is the sum of gravity and all accelerations. k is the sum of all drag
 *  coefficients, and w the mean of their velocities w, weighted by k. The velocity becomes the exact solution of v' = a - k (v - w)
 *  after the substep dt:
 *      v exp(-k dt) + w (1 - exp(-k dt)) + a (1 - exp(-k dt)) / k       (k = 0: v + a dt)
 *  So drag is stable for any k and dt, and falling matter ends at exactly w + a / k. The order of forces does not matter. The
 *  impulse of each force is what it adds to the momentum of the nodes, see pbmpm_force_status. */
typedef struct pbmpm_force_def {
    uint32_t size;         /**< sizeof(pbmpm_force_def), set by pbmpm_force_def_init() */
    pbmpm_force_kind kind; /**< default PBMPM_FORCE_UNIFORM */
    int32_t enabled;       /**< 1 (default): acts; 0: rests */
    int32_t everywhere;    /**< 1 (default): s = 1 everywhere; of the shape only the centre counts. 0: s by shape and falloff. */
    pbmpm_falloff falloff; /**< default PBMPM_FALLOFF_NONE */
    float range;           /**< of the falloff [m], in [0, 1e9], > 0 for INVERSE_SQUARE; default 0: nothing outside of the shape */
    float strength;        /**< acceleration [m/s^2], in [-1e9, 1e9]; DRAG: k [1/s], in [0, 1e9]; GRAB: unused; default 1 */
    float direction[3];    /**< in the world, whatever the shape's rotation. UNIFORM: of the acceleration; VORTEX, DRAG and GRAB in
                                3D: the axis. Any length > 1e-6; default (0, 1, 0) */
    float velocity[3];     /**< DRAG and GRAB: the even part of w [m/s], in [-1e9, 1e9]; default 0 */
    float spin;            /**< DRAG, GRAB: turns about the axis through the shape's position [rad/s], in [-1e6, 1e6]; default 0 */
    uint64_t key;       /**< unique number among the world's forces, by which snapshots match it; 0 (default): matched by the index
                             of its identifier instead, see snapshot.h */
    uint64_t user_data; /**< the host's own; the library only keeps it; default 0 */
} pbmpm_force_def;

/** What a force did in the last step. */
typedef struct pbmpm_force_status {
    uint32_t size;     /**< sizeof(pbmpm_force_status), set by the caller */
    uint32_t nodes;    /**< nodes with matter that felt it in the last substep */
    double impulse[3]; /**< what it added to the momentum of nodes, over all substeps [kg m/s] (2D: per metre of depth), before
                            materials and obstacles: m a dt, or for DRAG and GRAB -m k times the integral of v - w. GRAB with s = 1:
                            plus what its nodes take from materials. Grabs that hold the same node count equal parts of that. */
} pbmpm_force_status;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any. */
PBMPM_API pbmpm_result pbmpm_force_def_init(pbmpm_force_def *def, size_t size);

/** Adds a force that is felt around a shape of any kind but PBMPM_BAKED.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, CAPACITY, OUT_OF_MEMORY, UNSUPPORTED, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_force_create(pbmpm_world_id world, const pbmpm_force_def *def, const pbmpm_shape *shape, pbmpm_force_id *force);

/** Takes a force away. Errors: INVALID_ID, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_force_destroy(pbmpm_world_id world, pbmpm_force_id force);

/** Whether an identifier is that of a force of the world. *valid is then 1, else 0 (null, stale, foreign, or the world is gone),
 *  which is no error.
 *  Errors: INVALID_ARGUMENT (null), BUSY, FORKED; *valid is then as before. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_force_is_valid(pbmpm_world_id world, pbmpm_force_id force, int32_t *valid);

/** Lists the forces of the world, in no particular order. *count is how many there are; the first `capacity` of them are written
 *  to `forces`, which may be null with a capacity of 0. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_get_forces(pbmpm_world_id world, pbmpm_force_id *forces, uint32_t capacity, uint32_t *count);

/** Reads the definition and the shape. Either may be null; set `size` in what is not.
 *  Errors: INVALID_ID, UNSUPPORTED, BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_force_get(pbmpm_world_id world, pbmpm_force_id force, pbmpm_force_def *def, pbmpm_shape *shape);

/** Changes a force (its kind and place, too), from the next step on. With a null `def` or `shape` that part stays unchanged. So
 *  do members that an older caller's smaller structure lacks. Errors as pbmpm_force_create(), except CAPACITY and OUT_OF_MEMORY.
 *  Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_force_set(pbmpm_world_id world, pbmpm_force_id force, const pbmpm_force_def *def, const pbmpm_shape *shape);

/** Figures of the last step. `status->size` must be set.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_force_status_get(pbmpm_world_id world, pbmpm_force_id force, pbmpm_force_status *status);

#ifdef __cplusplus
}
#endif
#endif
