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
    PBMPM_FRICTION_COULOMB = 0, /**< tangential impulse up to friction_coefficient times the normal impulse. A liquid's pressure does
                                      not rub; what holds it is its kinematic_viscosity: water slips, honey does not.
                                      Not the paper's solver and the primal: there
                                      liquid slips */
    PBMPM_FRICTION_STICK = 1,   /**< matter moves with the surface and cannot leave it; liquid, too */
    PBMPM_FRICTION_SLIP = 2,    /**< no tangential impulse, of viscous liquid neither */
    PBMPM_FRICTION_FORCE32 = 0x7fffffff
} pbmpm_friction;

/** An obstacle. Fill it with pbmpm_collider_def_init(), then change what differs. */
typedef struct pbmpm_collider_def {
    uint32_t size;              /**< sizeof(pbmpm_collider_def), set by pbmpm_collider_def_init() */
    pbmpm_friction friction;    /**< default PBMPM_FRICTION_COULOMB */
    float friction_coefficient; /**< Coulomb coefficient, in [0, 100]; default 0.2 */
    int32_t kinematic;          /**< 0 (default): never moves. 1: pbmpm_collider_move() moves it. */
    int32_t measures_impulse;   /**< 1: pbmpm_collider_impulse() tells what matter does to it; 0 (default): costs nothing */
    uint32_t meets;             /**< bits of `groups` of the materials that it acts on; 0 (default): all. Other matter passes as if it were not there.
                                     Fills, emitters, touches and pbmpm_collider_submerged() respect it; queries do not. Matter that passes
                                     is slowed within 2.5 cells of matter that is held, see docs/limits.md. */
    uint64_t key;       /**< how snapshots find it again; no two colliders of a world may share one. 0 (default): none; the index of its identifier counts,
                             see snapshot.h */
    uint64_t user_data; /**< the host's own; the library only keeps it; default 0 */
    int32_t sensor;          /**< 1: acts on nothing, for triggers; matter passes through it, so it measures no impulse. 0 (default): an obstacle */
    int32_t reports_touches; /**< 1: pbmpm_world_touches() tells what touches it; 0 (default): costs nothing */
} pbmpm_collider_def;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread. */
PBMPM_API pbmpm_result pbmpm_collider_def_init(pbmpm_collider_def *def, size_t size);

/** Adds an obstacle, with the shape's pose at the start. It may stand on top of matter: that is pushed out over the next steps.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, CAPACITY, OUT_OF_MEMORY, BUSY. */
PBMPM_API pbmpm_result pbmpm_collider_create(pbmpm_world_id world, const pbmpm_collider_def *def, const pbmpm_shape *shape,
                                             pbmpm_collider_id *collider);

/** Takes an obstacle away. Errors: INVALID_ID, BUSY. */
PBMPM_API pbmpm_result pbmpm_collider_destroy(pbmpm_world_id world, pbmpm_collider_id collider);

/** Whether an identifier is that of a collider of the world: *valid is then 1, else 0: null, stale, foreign, or the world is gone. That is no
 *  error and leaves no message. Errors: INVALID_ARGUMENT (null), BUSY, FORKED: *valid is as before. */
PBMPM_API pbmpm_result pbmpm_collider_is_valid(pbmpm_world_id world, pbmpm_collider_id collider, int32_t *valid);

/** Lists the colliders of the world. *count is how many there are; the first `capacity` of them are written to `colliders`, which may be null with a
 *  capacity of 0. The order says nothing. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY. */
PBMPM_API pbmpm_result pbmpm_world_get_colliders(pbmpm_world_id world, pbmpm_collider_id *colliders, uint32_t capacity, uint32_t *count);

/** Reads the definition, and the shape with the current pose. Either may be null; set `size` in what is not. Errors: INVALID_ID, UNSUPPORTED, BUSY. */
PBMPM_API pbmpm_result pbmpm_collider_get(pbmpm_world_id world, pbmpm_collider_id collider, pbmpm_collider_def *def, pbmpm_shape *shape);

/** Changes an obstacle, which keeps its identifier. With a null `def` or `shape` that part stays unchanged. So do members that an older caller's smaller structure lacks.
 *  A new shape is there at once, without velocity. It ends a way that pbmpm_collider_move() asked for; so does `kinematic` 0.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, OUT_OF_MEMORY, BUSY, FORKED: nothing has changed. */
PBMPM_API pbmpm_result pbmpm_collider_set(pbmpm_world_id world, pbmpm_collider_id collider, const pbmpm_collider_def *def, const pbmpm_shape *shape);

/** Where a kinematic obstacle shall be at the end of the next step. Its velocity follows from the distance; what
 *  matter feels of it is clamped to settings.max_displacement cells per substep. The pose itself is reached exactly.
 *  `rotation` may be null: unchanged. Errors: INVALID_ID, INVALID_ARGUMENT (also: not kinematic), BUSY. */
PBMPM_API pbmpm_result pbmpm_collider_move(pbmpm_world_id world, pbmpm_collider_id collider, const float position[3],
                                           const float rotation[4]);

/** Puts an obstacle somewhere at once, without velocity. Works for static ones too. Errors: INVALID_ID,
 *  INVALID_ARGUMENT, BUSY. */
PBMPM_API pbmpm_result pbmpm_collider_teleport(pbmpm_world_id world, pbmpm_collider_id collider, const float position[3],
                                               const float rotation[4]);

/** What matter gave to an obstacle in a step: the momentum that matter lost to it. A host that moves a rigid body
 *  itself adds it to the body's momentum; pbmpm_rigid_advance() does that, see rigid.h. The sum over all obstacles and walls is what matter lost,
 *  apart from gravity, forces, and deleted or slowed particles. In 2D per metre of depth. */
typedef struct pbmpm_impulse {
    uint32_t size;     /**< sizeof(pbmpm_impulse), set by the caller */
    double linear[3];  /**< [N s] */
    double angular[3]; /**< [N m s] about the obstacle's position after the step; walls: about the world's origin. 2D: only component 2 */
} pbmpm_impulse;

/** Reads the impulse of the last step, summed over its substeps. About another point p: angular + (position - p) x linear.
 *  `impulse->size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (it does not measure), UNSUPPORTED, BUSY. */
PBMPM_API pbmpm_result pbmpm_collider_impulse(pbmpm_world_id world, pbmpm_collider_id collider, pbmpm_impulse *impulse);

/** The same for a wall of the domain: that at the lower (`upper` 0) or upper (1) end of an axis. Errors: INVALID_ID, INVALID_ARGUMENT (no such
 *  wall, or world_def.domain_measures_impulse is 0), UNSUPPORTED, BUSY. */
PBMPM_API pbmpm_result pbmpm_domain_impulse(pbmpm_world_id world, int32_t axis, int32_t upper, pbmpm_impulse *impulse);

/** A wall of the domain. Read it with pbmpm_domain_wall_get(), change what differs, and give it to pbmpm_domain_wall_set(). */
typedef struct pbmpm_domain_wall {
    uint32_t size;              /**< sizeof(pbmpm_domain_wall), set by the caller */
    int32_t open;               /**< 0 (default): holds matter in. 1: there is no wall. The other walls are planes without end: a
                                     floor goes on outside. What gets out falls for ever: set kill bounds (drain.h). */
    pbmpm_friction friction;    /**< default PBMPM_FRICTION_COULOMB */
    float friction_coefficient; /**< Coulomb coefficient, in [0, 100]; default world_def.domain_friction */
} pbmpm_domain_wall;

/** Reads a wall: that at the lower (`upper` 0) or upper (1) end of an axis. `wall->size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null, or no
 *  such wall: also where world_def.domain_enabled is 0), UNSUPPORTED, BUSY. */
PBMPM_API pbmpm_result pbmpm_domain_wall_get(pbmpm_world_id world, int32_t axis, int32_t upper, pbmpm_domain_wall *wall);

/** Changes a wall; the next step knows it. Matter that is behind a wall when it closes is put back to it at once: remove it before, see
 *  pbmpm_particles_remove_in(). Wakes all matter. Errors as pbmpm_domain_wall_get(). */
PBMPM_API pbmpm_result pbmpm_domain_wall_set(pbmpm_world_id world, int32_t axis, int32_t upper, const pbmpm_domain_wall *wall);

/** What became of a touch since the call before. */
typedef enum pbmpm_touch_state {
    PBMPM_TOUCH_BEGAN = 1, /**< it is new */
    PBMPM_TOUCH_STAYS = 2, /**< it was there before */
    PBMPM_TOUCH_ENDED = 3, /**< it is no more */
    PBMPM_TOUCH_FORCE32 = 0x7fffffff
} pbmpm_touch_state;

/** Matter of a material at a collider. */
typedef struct pbmpm_touch {
    uint32_t size;               /**< sizeof(pbmpm_touch); set by the caller in the first element of an array */
    pbmpm_touch_state state;     /**< compared with the call before */
    pbmpm_collider_id collider;  /**< that is touched */
    pbmpm_material_id material;  /**< of what touches it; null when it was destroyed since */
    uint32_t particles;          /**< how many touch it now; 0 when it ended */
    uint32_t reserved;           /**< 0 */
    double impulse[3];           /**< what all matter gave to the collider in the last step [N s], see pbmpm_collider_impulse(); 0 unless it measures that */
} pbmpm_touch;

/** Which materials touch the colliders that report touches, and where that has begun or ended since the call before. A particle touches an obstacle
 *  that it is within half a cell of, and a sensor that it is in. Call it once per step: a touch that begins and ends between two calls is not
 *  seen. Nor is the end of the touches of a destroyed collider.
 *  *count is how many touches there are; the first `capacity` of them are written. If there was less room than *count, this call does not count as the call before of the next one.
 *  `touches` may be null with a capacity of 0; else touches[0].size must be set. Costs a look at the particles near those colliders.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED (size), OUT_OF_MEMORY (see query.h), BUSY. */
PBMPM_API pbmpm_result pbmpm_world_touches(pbmpm_world_id world, pbmpm_touch *touches, uint32_t capacity, uint32_t *count);

/** Particles inside an obstacle (deeper than 1/100 cell); arguments as in pbmpm_query_shape(). */
PBMPM_API pbmpm_result pbmpm_query_collider(pbmpm_world_id world, pbmpm_collider_id collider, pbmpm_particle_id *ids, uint32_t capacity,
                                            uint32_t *count);

#ifdef __cplusplus
}
#endif
#endif
