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
    PBMPM_EMIT_DISC = 1,   /**< on the disc of the shape's `radius` around its `position` that is perpendicular to `direction` (2D: on
                                that line); the kind of the shape does not matter */
    PBMPM_EMITTER_REGION_FORCE32 = 0x7fffffff
} pbmpm_emitter_region;

/** A source of particles. Fill it with pbmpm_emitter_def_init(), then change what differs.
 *
 *  Let V be the rest volume of a particle, (cell_size / particles_per_axis)^d. The i-th particle (from 0) is due at the time
 *  (i + 1/2) V / rate after the emitter began. So after a time T, T rate / V +- 1/2 particles were due, whatever the substeps.
 *  A particle appears at the end of the substep in which it is due. It is then where gravity has taken it since it was due, with the velocity of
 *  that fall: so a stream has no pulses. If an obstacle that acts on it is in the way it appears where it was born.
 *  Places follow a sequence that fills the region evenly.
 *
 *  A particle that is due is refused when matter at its place already fills the share `fill_limit` of the grid. Solids that are born too dense stay so.
 *  So solids are refused, too, where the matter around is this full, whatever is empty beside it. No particle may fill more than this share of a space
 *  that obstacles enclose. That space is looked for up to about four cells from the emitter. A particle is refused, too, when the budget is spent or the world has no room. Refused particles are not made up for. They are counted in pbmpm_emitter_status, and told by one PBMPM_EVENT_EMISSION_REFUSED per emitter and substep. */
typedef struct pbmpm_emitter_def {
    uint32_t size;               /**< sizeof(pbmpm_emitter_def), set by pbmpm_emitter_def_init() */
    uint32_t seed;               /**< of places and directions; equal seeds give equal particles; default 1 */
    pbmpm_material_id material;  /**< of the particles; it cannot be destroyed while the emitter exists */
    pbmpm_emitter_region region; /**< default PBMPM_EMIT_VOLUME */
    int32_t enabled;             /**< 1 (default): emits; 0: rests, and no time passes for it */
    float rate;                  /**< volume per second, not particles: rest volume [m^3/s] (2D: area [m^2/s]), in [0, 1e12]; default 0. An emitter whose
                                      cross-section along `direction` is A runs full with A * speed. Gravity and pressure may take more away. */
    float speed;                 /**< [m/s], in [0, 1e6]; default 0 */
    float direction[3];          /**< of the speed before the shape's rotation, any length > 1e-6; default (0, -1, 0) */
    float spread;                /**< largest angle between a particle's velocity and `direction` [rad], in [0, pi], evenly spread over
                                      the cone; default 0 */
    float particles_per_axis;    /**< size of the particles: so many per cell and axis, in [0.25, 16]; default 2 */
    float fill_limit;            /**< rest volume per volume of the grid where nothing more is emitted, in [0.1, 100]; default 1: full.
                                      Only what obstacles leave open counts. A source inside a pool needs more: liquid at rest measures 1 +-
                                      0.1, and at depth up to 1.2 with the paper's solver */
    uint64_t budget;             /**< particles that it may emit in its life; 0 (default): no limit */
    uint64_t key;       /**< how snapshots find it again; no two emitters of a world may share one. 0 (default): none; the index of its identifier counts,
                             see snapshot.h */
    uint64_t user_data; /**< the host's own; the library only keeps it; default 0 */
    uint32_t user_value; /**< of its particles, see PBMPM_USER_VALUE; default 0 */
    uint32_t reserved;   /**< 0 */
} pbmpm_emitter_def;

/** What an emitter has done since it was created. due = emitted + refused_full + refused_budget + refused_capacity. */
typedef struct pbmpm_emitter_status {
    uint32_t size;             /**< sizeof(pbmpm_emitter_status), set by the caller */
    uint32_t reserved;         /**< 0 */
    uint64_t emitted;          /**< particles */
    double emitted_mass;       /**< [kg] (2D: per metre of depth): emitted times the mass of a particle */
    uint64_t refused_full;     /**< particles that were due where there was no space: matter, an obstacle, or the outside of the domain */
    uint64_t refused_budget;   /**< ... after the budget was spent */
    uint64_t refused_capacity; /**< ... when the world was full */
} pbmpm_emitter_status;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread. */
PBMPM_API pbmpm_result pbmpm_emitter_def_init(pbmpm_emitter_def *def, size_t size);

/** Adds an emitter; it begins with the next step. `shape`: any kind but PBMPM_PLANE; its bounds hold at most 2^22 cells and lie within
 *  2^21 cells of the origin. Errors: INVALID_ID (world, material), INVALID_ARGUMENT, CAPACITY,
 *  OUT_OF_MEMORY, UNSUPPORTED, BUSY. */
PBMPM_API pbmpm_result pbmpm_emitter_create(pbmpm_world_id world, const pbmpm_emitter_def *def, const pbmpm_shape *shape,
                                            pbmpm_emitter_id *emitter);

/** Takes an emitter away; its particles stay. Errors: INVALID_ID, BUSY. */
PBMPM_API pbmpm_result pbmpm_emitter_destroy(pbmpm_world_id world, pbmpm_emitter_id emitter);

/** Whether an identifier is that of an emitter of the world: *valid is then 1, else 0: null, stale, foreign, or the world is gone. That is no
 *  error and leaves no message. Errors: INVALID_ARGUMENT (null), BUSY, FORKED: *valid is as before. */
PBMPM_API pbmpm_result pbmpm_emitter_is_valid(pbmpm_world_id world, pbmpm_emitter_id emitter, int32_t *valid);

/** Lists the emitters of the world. *count is how many there are; the first `capacity` of them are written to `emitters`, which may be null with a
 *  capacity of 0. The order says nothing. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY. */
PBMPM_API pbmpm_result pbmpm_world_get_emitters(pbmpm_world_id world, pbmpm_emitter_id *emitters, uint32_t capacity, uint32_t *count);

/** Reads the definition, and the shape with the current pose. Either may be null; set `size` in what is not. Errors: INVALID_ID,
 *  UNSUPPORTED, BUSY. */
PBMPM_API pbmpm_result pbmpm_emitter_get(pbmpm_world_id world, pbmpm_emitter_id emitter, pbmpm_emitter_def *def, pbmpm_shape *shape);

/** Changes an emitter. With a null `def` or `shape` that part stays unchanged. So do members that an older caller's smaller structure lacks. The counts are kept, and so is the fraction of a particle that was due. A new pose is taken at once.
 *  Errors as pbmpm_emitter_create(), but CAPACITY and OUT_OF_MEMORY. */
PBMPM_API pbmpm_result pbmpm_emitter_set(pbmpm_world_id world, pbmpm_emitter_id emitter, const pbmpm_emitter_def *def,
                                         const pbmpm_shape *shape);

/** Where the emitter shall be at the end of the next step; particles are born all along the way. They do not take on its
 *  motion. If the path crosses more than 2^22 nodes of the domain per substep the emitter jumps. `rotation` may be null: unchanged. Errors: INVALID_ID, INVALID_ARGUMENT, BUSY. */
PBMPM_API pbmpm_result pbmpm_emitter_move(pbmpm_world_id world, pbmpm_emitter_id emitter, const float position[3], const float rotation[4]);

/** Counts since creation. `status->size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY. */
PBMPM_API pbmpm_result pbmpm_emitter_status_get(pbmpm_world_id world, pbmpm_emitter_id emitter, pbmpm_emitter_status *status);

#ifdef __cplusplus
}
#endif
#endif
