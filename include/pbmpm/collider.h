/* pbmpm: solid obstacles. */
#ifndef PBMPM_COLLIDER_H
#define PBMPM_COLLIDER_H

#include "particles.h"
#include "shape.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    PBMPM_MAX_COLLIDERS = 1024 /**< per world */
};

/** What an obstacle does to motion along its surface. */
typedef enum pbmpm_friction {
    PBMPM_FRICTION_COULOMB = 0, /**< solids: tangential impulse of at most friction_coefficient times the normal impulse. Liquid
                                     ignores the coefficient: it sticks if kinematic_viscosity is above 0, else slips. With the
                                     paper's and the primal solver liquid always slips */
    PBMPM_FRICTION_STICK = 1,   /**< matter moves with the surface and cannot leave it; liquid, too */
    PBMPM_FRICTION_SLIP = 2,    /**< no tangential impulse, not even on viscous liquid */
    PBMPM_FRICTION_FORCE32 = 0x7fffffff
} pbmpm_friction;

/** An obstacle. Fill it with pbmpm_collider_def_init(), then change what differs. */
typedef struct pbmpm_collider_def {
    uint32_t size;              /**< sizeof(pbmpm_collider_def), set by pbmpm_collider_def_init() */
    pbmpm_friction friction;    /**< default PBMPM_FRICTION_COULOMB */
    float friction_coefficient; /**< Coulomb coefficient, in [0, 100]; default 0.2 */
    int32_t kinematic;          /**< 0 (default): never moves. 1: pbmpm_collider_move() moves it. */
    int32_t measures_impulse;   /**< 1: pbmpm_collider_impulse() tells what matter does to it; 0 (default): costs nothing */
    uint32_t meets;             /**< acts on materials whose `groups` share a bit with it; 0 (default): on all. Others pass through
                                     it, slowed within 2.5 cells of matter that is held, see docs/limits.md. Fills, emitters,
                                     touches and pbmpm_collider_submerged() respect it; queries do not. */
    uint64_t key;       /**< unique number among the world's colliders, by which snapshots match it; 0 (default): matched by the
                             index of its identifier instead, see snapshot.h */
    uint64_t user_data; /**< the host's own; the library only keeps it; default 0 */
    int32_t sensor;          /**< 1: a trigger that matter passes through; measures_impulse must be 0. 0 (default): an obstacle */
    int32_t reports_touches; /**< 1: pbmpm_world_touches() tells what touches it; 0 (default): costs nothing */
} pbmpm_collider_def;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any. */
PBMPM_API pbmpm_result pbmpm_collider_def_init(pbmpm_collider_def *def, size_t size);

/** Adds an obstacle, with the shape's pose at the start. It may stand on top of matter: that is pushed out over the next steps.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, CAPACITY, OUT_OF_MEMORY, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_collider_create(pbmpm_world_id world, const pbmpm_collider_def *def, const pbmpm_shape *shape,
                                             pbmpm_collider_id *collider);

/** Takes an obstacle away. Errors: INVALID_ID, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_collider_destroy(pbmpm_world_id world, pbmpm_collider_id collider);

/** Whether an identifier is that of a collider of the world. *valid is then 1, else 0 (null, stale, foreign, or the world is gone),
 *  which is no error.
 *  Errors: INVALID_ARGUMENT (null), BUSY, FORKED; *valid is then as before. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_collider_is_valid(pbmpm_world_id world, pbmpm_collider_id collider, int32_t *valid);

/** Lists the colliders of the world, in no particular order. *count is how many there are; the first `capacity` of them are
 *  written to `colliders`, which may be null with a capacity of 0. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_get_colliders(pbmpm_world_id world, pbmpm_collider_id *colliders, uint32_t capacity, uint32_t *count);

/** Reads the definition, and the shape with the current pose. Either may be null; set `size` in what is not.
 *  Errors: INVALID_ID, UNSUPPORTED, BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_collider_get(pbmpm_world_id world, pbmpm_collider_id collider, pbmpm_collider_def *def, pbmpm_shape *shape);

/** Changes an obstacle, which keeps its identifier. With a null `def` or `shape` that part stays unchanged. So do members that an
 *  older caller's smaller structure lacks. A new shape is there at once, without velocity. It cancels a pending
 *  pbmpm_collider_move(), as `kinematic` 0 does.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, OUT_OF_MEMORY, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_collider_set(pbmpm_world_id world, pbmpm_collider_id collider, const pbmpm_collider_def *def, const pbmpm_shape *shape);

/** Moves a kinematic obstacle to a pose during the next step, and reaches it exactly. After that step it rests, so call this before
 *  every step. Its velocity follows from the distance; what matter feels of it is clamped to settings.max_displacement cells per
 *  substep.
 *  `rotation` may be null: unchanged.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (also: not kinematic), BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_collider_move(pbmpm_world_id world, pbmpm_collider_id collider, const float position[3],
                                           const float rotation[4]);

/** Puts an obstacle somewhere at once, without velocity. Works for static ones too. `rotation` may be null: unchanged.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_collider_teleport(pbmpm_world_id world, pbmpm_collider_id collider, const float position[3],
                                               const float rotation[4]);

/** What matter gave to an obstacle in a step: the momentum that matter lost to it. A host that moves a rigid body itself adds it
 *  to the body's momentum; pbmpm_rigid_advance() does that, see rigid.h. The sum over all obstacles and walls is what matter
 *  lost, apart from gravity, forces, and deleted or slowed particles. In 2D per metre of depth. */
typedef struct pbmpm_impulse {
    uint32_t size;     /**< sizeof(pbmpm_impulse), set by the caller */
    double linear[3];  /**< [N s] */
    double angular[3]; /**< [N m s] about the obstacle's position after the step; walls: about the origin. 2D: only component 2 */
} pbmpm_impulse;

/** Reads the impulse of the last step, summed over its substeps. About another point p it is angular + (position - p) x linear.
 *  `impulse->size` must be set.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null; it does not measure), UNSUPPORTED, BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_collider_impulse(pbmpm_world_id world, pbmpm_collider_id collider, pbmpm_impulse *impulse);

/** The same for a wall of the domain: that at the lower (`upper` 0) or upper (1) end of an axis.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null, no such wall, or world_def.domain_measures_impulse is 0), UNSUPPORTED, BUSY, FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_domain_impulse(pbmpm_world_id world, int32_t axis, int32_t upper, pbmpm_impulse *impulse);

/** A wall of the domain. Read it with pbmpm_domain_wall_get(), change what differs, and give it to pbmpm_domain_wall_set(). */
typedef struct pbmpm_domain_wall {
    uint32_t size;              /**< sizeof(pbmpm_domain_wall), set by the caller */
    int32_t open;               /**< 1: there is no wall. 0 (default): holds matter in. Walls are infinite planes, so a floor goes
                                     on outside. Matter that leaves never comes back by itself: set kill bounds (drain.h). */
    pbmpm_friction friction;    /**< default PBMPM_FRICTION_COULOMB */
    float friction_coefficient; /**< Coulomb coefficient, in [0, 100]; default world_def.domain_friction */
} pbmpm_domain_wall;

/** Reads a wall: that at the lower (`upper` 0) or upper (1) end of an axis. `wall->size` must be set.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null, or no such wall: also where world_def.domain_enabled is 0), UNSUPPORTED, BUSY,
 *  FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_domain_wall_get(pbmpm_world_id world, int32_t axis, int32_t upper, pbmpm_domain_wall *wall);

/** Changes a wall from the next step on. Closing it moves matter from behind it onto it at once: remove that matter before, see
 *  pbmpm_particles_remove_in(). Wakes all matter. Errors as pbmpm_domain_wall_get(). Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_domain_wall_set(pbmpm_world_id world, int32_t axis, int32_t upper, const pbmpm_domain_wall *wall);

/** What became of a touch since the last call of pbmpm_world_touches(). */
typedef enum pbmpm_touch_state {
    PBMPM_TOUCH_BEGAN = 1, /**< it is new */
    PBMPM_TOUCH_STAYS = 2, /**< it was there before */
    PBMPM_TOUCH_ENDED = 3, /**< it is over */
    PBMPM_TOUCH_FORCE32 = 0x7fffffff
} pbmpm_touch_state;

/** One material that touches one collider. */
typedef struct pbmpm_touch {
    uint32_t size;               /**< sizeof(pbmpm_touch); set by the caller in the first element of an array */
    pbmpm_touch_state state;     /**< compared with the last call */
    pbmpm_collider_id collider;  /**< what is touched */
    pbmpm_material_id material;  /**< what touches it; null if it was destroyed since */
    uint32_t particles;          /**< how many touch it now; 0 if the touch ended */
    uint32_t reserved;           /**< 0 */
    double impulse[3];           /**< of all matter on the collider in the last step [N s], see pbmpm_collider_impulse(); or 0 */
} pbmpm_touch;

/** Which materials touch the colliders that report touches, and where that has begun or ended since the last call. A particle
 *  touches an obstacle within half a cell of it, and a sensor that it is inside. Call it once per step: a touch that begins and
 *  ends between two calls is not seen. Destroying a collider ends its touches without an ENDED record.
 *  *count is how many touches there are; the first `capacity` of them are written. `touches` may be null with a capacity of 0; else
 *  touches[0].size must be set. If `capacity` is below *count, the next call still compares with the call before this one. Costs a
 *  look at the particles near those colliders.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED (size), OUT_OF_MEMORY (see query.h), BUSY, FORKED.
 *  Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_world_touches(pbmpm_world_id world, pbmpm_touch *touches, uint32_t capacity, uint32_t *count);

/** Particles inside a collider (deeper than 1/100 cell), sensors included. Arguments as in pbmpm_query_shape().
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null), OUT_OF_MEMORY (see query.h), BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_query_collider(pbmpm_world_id world, pbmpm_collider_id collider, pbmpm_particle_id *ids, uint32_t capacity,
                                            uint32_t *count);

#ifdef __cplusplus
}
#endif
#endif
