/* pbmpm: emitters, which add matter while the world runs. */
#ifndef PBMPM_EMITTER_H
#define PBMPM_EMITTER_H

#include "material.h"
#include "shape.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    PBMPM_MAX_EMITTERS = 256 /**< per world */
};

/** An emitter of one world. */
typedef struct pbmpm_emitter_id {
    uint32_t index;
    uint32_t generation;
} pbmpm_emitter_id;

/** Where an emitter's particles are born. */
typedef enum pbmpm_emitter_region {
    PBMPM_EMIT_VOLUME = 0, /**< anywhere inside the shape */
    PBMPM_EMIT_DISC = 1,   /**< on the disc of the shape's `radius` around its `position`, perpendicular to `direction` (2D: on that
                                line); the kind of the shape does not matter */
    PBMPM_EMITTER_REGION_FORCE32 = 0x7fffffff
} pbmpm_emitter_region;

/** A source of particles. Fill it with pbmpm_emitter_def_init(), then change what differs.
 *
 *  Let V be the rest volume of a particle, (cell_size / particles_per_axis)^d. The i-th particle (from 0) is due at the time
 *  (i + 1/2) V / rate after the emitter began. So after a time T, T rate / V +- 1/2 particles were due, whatever the substeps. A
 *  particle appears at the end of the substep in which it is due. By then it has moved and fallen as if born when it was due, so
 *  the stream has no pulses. If an obstacle that acts on it is in the way it appears where it was born.
 *  Places follow a sequence that fills the region evenly.
 *
 *  A particle that is due is refused
 *    - when the matter at its place fills more than `fill_limit`;
 *    - when it is solid and only the matter around it is this dense, empty space aside: solids that are born too dense stay so;
 *    - when obstacles enclose the space, and all matter in there would fill more than `fill_limit` of it. The emitter looks for
 *      such a space up to about four cells away;
 *    - when an obstacle or the outside of the domain is there;
 *    - when the budget is spent or the world has no room.
 *  Refused particles are lost. pbmpm_emitter_status counts them, and each emitter tells them by one PBMPM_EVENT_EMISSION_REFUSED
 *  per substep. */
typedef struct pbmpm_emitter_def {
    uint32_t size;               /**< sizeof(pbmpm_emitter_def), set by pbmpm_emitter_def_init() */
    uint32_t seed;               /**< of places and directions; equal seeds give equal particles; default 1 */
    pbmpm_material_id material;  /**< of the particles; it cannot be destroyed while the emitter exists */
    pbmpm_emitter_region region; /**< default PBMPM_EMIT_VOLUME */
    int32_t enabled;             /**< 1 (default): emits; 0: rests, and no time passes for it */
    float rate;                  /**< rest volume per second, not particles [m^3/s] (2D: [m^2/s]), in [0, 1e12]; default 0. A full
                                      stream needs A * speed, A the area of the region seen along `direction`. Where gravity or
                                      pressure carries matter off faster, more gets out. */
    float speed;                 /**< of the particles [m/s], in [0, 1e6]; default 0 */
    float direction[3];          /**< of the velocity, in the shape's own frame, any length > 1e-6; default (0, -1, 0) */
    float spread;                /**< largest angle between a particle's velocity and `direction` [rad], in [0, pi], evenly spread
                                      over the cone; default 0 */
    float particles_per_axis;    /**< size of the particles: so many per cell and axis, in [0.25, 16]; default 2 */
    float fill_limit;            /**< nothing is emitted where matter fills more than this share of the open space, in [0.1, 100];
                                      default 1. Inside a pool set more than 1.1, which resting liquid measures; with the paper's
                                      solver more than 1.2, which it measures at depth. */
    uint64_t budget;             /**< particles that it may emit in its life; 0 (default): no limit */
    uint64_t key;       /**< unique number among the world's emitters, by which snapshots match it; 0 (default): matched by the
                             index of its identifier instead, see snapshot.h */
    uint64_t user_data; /**< the host's own; the library only keeps it; default 0 */
    uint32_t user_value; /**< of its particles, see PBMPM_USER_VALUE; default 0 */
    uint32_t reserved;   /**< must be 0 */
} pbmpm_emitter_def;

/** What an emitter has done since it was created. due = emitted + refused_full + refused_budget + refused_capacity. */
typedef struct pbmpm_emitter_status {
    uint32_t size;             /**< sizeof(pbmpm_emitter_status), set by the caller */
    uint32_t reserved;         /**< 0 */
    uint64_t emitted;          /**< particles */
    double emitted_mass;       /**< [kg] (2D: per metre of depth) */
    uint64_t refused_full;     /**< particles for which there was no space: matter, an obstacle, or the outside of the domain */
    uint64_t refused_budget;   /**< those due after the budget was spent */
    uint64_t refused_capacity; /**< those due while the world was full */
} pbmpm_emitter_status;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any. */
PBMPM_API pbmpm_result pbmpm_emitter_def_init(pbmpm_emitter_def *def, size_t size);

/** Adds an emitter; it begins with the next step. `shape`: a box, ball or capsule (with PBMPM_EMIT_DISC any kind). Its bounds hold
 *  at most 2^22 cells and lie within 2^21 cells of the origin.
 *  Errors: INVALID_ID (world, material), INVALID_ARGUMENT, CAPACITY, OUT_OF_MEMORY, UNSUPPORTED, BUSY, FORKED.
 *  Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_emitter_create(pbmpm_world_id world, const pbmpm_emitter_def *def, const pbmpm_shape *shape,
                                            pbmpm_emitter_id *emitter);

/** Takes an emitter away; its particles stay. Errors: INVALID_ID, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_emitter_destroy(pbmpm_world_id world, pbmpm_emitter_id emitter);

/** Whether an identifier is that of an emitter of the world. *valid is then 1, else 0 (null, stale, foreign, or the world is gone),
 *  which is no error.
 *  Errors: INVALID_ARGUMENT (null), BUSY, FORKED; *valid is then as before. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_emitter_is_valid(pbmpm_world_id world, pbmpm_emitter_id emitter, int32_t *valid);

/** Lists the emitters of the world, in no particular order. *count is how many there are; the first `capacity` of them are
 *  written to `emitters`, which may be null with a capacity of 0. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_get_emitters(pbmpm_world_id world, pbmpm_emitter_id *emitters, uint32_t capacity, uint32_t *count);

/** Reads the definition, and the shape with the current pose. Either may be null; set `size` in what is not.
 *  Errors: INVALID_ID, UNSUPPORTED, BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_emitter_get(pbmpm_world_id world, pbmpm_emitter_id emitter, pbmpm_emitter_def *def, pbmpm_shape *shape);

/** Changes an emitter. With a null `def` or `shape` that part stays unchanged. So do members that an older caller's smaller
 *  structure lacks. The counts are kept, and so is the fraction of a particle that was due. A new pose is taken at once. It cancels
 *  a pending pbmpm_emitter_move().
 *  Errors as pbmpm_emitter_create(), except CAPACITY and OUT_OF_MEMORY. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_emitter_set(pbmpm_world_id world, pbmpm_emitter_id emitter, const pbmpm_emitter_def *def,
                                         const pbmpm_shape *shape);

/** Moves an emitter to a pose during the next step; particles are born all along the way. Their velocity does not include the
 *  emitter's own. If its way adds more than 2^22 grid nodes in a substep, it jumps to the pose at once. `rotation` may be null:
 *  unchanged.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_emitter_move(pbmpm_world_id world, pbmpm_emitter_id emitter, const float position[3], const float rotation[4]);

/** Counts since creation. `status->size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_emitter_status_get(pbmpm_world_id world, pbmpm_emitter_id emitter, pbmpm_emitter_status *status);

#ifdef __cplusplus
}
#endif
#endif
