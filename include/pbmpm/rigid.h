/* pbmpm: rigid bodies, which matter pushes and which push matter.
 *
 * A rigid body is a kinematic obstacle that measures impulses, with a mass. The host keeps its definition and its state. Before
 * each step
 *
 *     pbmpm_rigid_advance(world, collider, &def, &state, dt);
 *     pbmpm_world_step(world, dt);
 *
 * pbmpm_rigid_advance() applies the last step's impulse, gravity and the host's forces. It then moves the obstacle. Bodies feel
 * matter, the walls of the domain and their own joint. They feel neither each other nor other obstacles. A physics engine does
 * that: it takes pbmpm_collider_impulse() and pbmpm_collider_submerged() instead of these calls.
 *
 * Walls of the domain stop a body without bounce. The coefficient of friction is the geometric mean of the body's and the wall's.
 * The wall's is 0 by default (world_def.domain_friction): a body then glides without end. If either has PBMPM_FRICTION_SLIP there
 * is no friction. Else, if either has PBMPM_FRICTION_STICK, the body does not slide.
 *
 * Motion. Velocities change first, then poses, each with the new velocities: first order in dt. A fall from rest is at
 * g dt^2 n (n + 1) / 2 after n steps, its velocity is exact. Turning keeps the angular momentum at any dt, so the spin of a body
 * that nothing touches does not grow. A step's rotation is computed in parts of at most 1/8 rad, or in 64 parts; the energy errs by
 * the fourth power of a part's angle.
 *
 * Light bodies. With the dual, the explicit and the convergent solver, body and liquid are solved for together ("the body yields").
 * So it may weigh far less than the liquid that it moves (docs/method.md, Walls). Beside liquid, impulses from solids move it one
 * step later. Liquid slips on it unless its friction is PBMPM_FRICTION_STICK.
 *
 * With the primal and the convergent solver, body and solids are solved for together, too. Beside liquid or sand they are not. See
 * docs/method.md, The primal solver. Then `state` is a prediction: it assumes contact impulses as in the last step, at most what
 * gravity and the host give. The step corrects the obstacle's pose; the next pbmpm_rigid_advance() copies it into `state`. To draw
 * the body, read its pose by pbmpm_collider_get().
 *
 * In all other cases matter feels the body's velocity one step later than the body feels matter. A body that is lighter than the
 * matter that moves along would then oscillate more and more, at any dt. So each change of its velocity is smoothed:
 *
 *     change = (what the impulses ask for + b * last change) / (1 + b),    b = V / mass,    V = density * volume * share,
 *
 * with the density, volume and share of its pbmpm_submersion. V is a virtual mass; in equilibrium it changes nothing. Motion is
 * stable while V is above (A - mass) / 2, A the added mass of the matter. A body that turns about its pivot turns with the same
 * b. The rotation of a free body is not smoothed. */
#ifndef PBMPM_RIGID_H
#define PBMPM_RIGID_H

#include "collider.h"

#ifdef __cplusplus
extern "C" {
#endif

/** How far a body may move, or turn. */
typedef enum pbmpm_freedom {
    PBMPM_FREEDOM_ALL = 0,   /**< in every direction */
    PBMPM_FREEDOM_AXIS = 1,  /**< along, or about, the axis alone */
    PBMPM_FREEDOM_PLANE = 2, /**< in every direction but along, or about, the axis */
    PBMPM_FREEDOM_NONE = 3,  /**< not at all */
    PBMPM_FREEDOM_FORCE32 = 0x7fffffff
} pbmpm_freedom;

/** Volume, mass and inertia of a shape of even density. In 2D per metre of depth. */
typedef struct pbmpm_mass_properties {
    uint32_t size;      /**< sizeof(pbmpm_mass_properties), set by the caller */
    uint32_t reserved;  /**< 0 */
    double volume;      /**< [m^d] */
    double mass;        /**< [kg] */
    double centre[3];   /**< centre of mass [m], from the shape's position, in the shape's own frame */
    double inertia[3];  /**< moments xx, yy, zz about the centre [kg m^2], in the shape's own frame; 2D: only zz, else 0 */
    double products[3]; /**< elements xy, yz, zx of the same tensor: -(integral of x y dm) and so on */
} pbmpm_mass_properties;

/** Mass properties of a shape. Boxes, balls and capsules: exact. Baked solids: sums over the nodes of the grid, in which a cell
 *  that the surface crosses counts by its share; a solid 64 cells long errs by less than 1/100. `mass->size` must be set.
 *  `density`: [kg/m^3], in [1e-6, 1e9].
 *  Errors: INVALID_ID, INVALID_ARGUMENT (also: a plane, which has no volume), UNSUPPORTED, BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_shape_mass(pbmpm_world_id world, const pbmpm_shape *shape, float density, pbmpm_mass_properties *mass);

/** The part of an obstacle that is under matter. */
typedef struct pbmpm_submersion {
    uint32_t size;     /**< sizeof(pbmpm_submersion), set by the caller */
    uint32_t reserved; /**< 0 */
    double share;      /**< share of the obstacle's volume that is under, in [0, 1] */
    double volume;     /**< volume that is under [m^d]; 2D: per metre of depth */
    double centre[3];  /**< centre of that volume [m], in the world; if it is 0, the obstacle's centre */
    double density;    /**< of the matter around, at rest volume [kg/m^3]; 0 if there is none */
} pbmpm_submersion;

/** How much of an obstacle is under matter. The surface of the matter around it is continued through the obstacle as a plane; what
 *  lies on the matter's side is under. No gravity is needed, and the plane may lie at any slope. `material`: null counts all
 *  matter, a load on top included; else only that material. So name the liquid where a raft carries a load of another material.
 *
 *  Measured on a lattice of the world's cells around the obstacle; for obstacles longer than 64 cells the lattice is coarser.
 *  Matter at a node is the filling of query.h, divided by the share that obstacles and walls leave open there. Where they leave
 *  nothing open, the nodes next to it count. For obstacles 8 cells long the volume errs by less than a layer of 0.4 cells. On a
 *  floor it errs by less than 0.8. A thin jet at one side counts for nothing. But under a film of half a cell or more nearly all of
 *  the obstacle counts, see docs/limits.md.
 *  `submersion->size` must be set. The first call takes memory of the world, and keeps it.
 *  Errors: INVALID_ID (also: the material), INVALID_ARGUMENT (also: a plane), UNSUPPORTED, OUT_OF_MEMORY, BUSY, FORKED.
 *  Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_collider_submerged(pbmpm_world_id world, pbmpm_collider_id collider, const pbmpm_material_id *material,
                                                pbmpm_submersion *submersion);

/** What a rigid body is. Fill it with pbmpm_rigid_def_init(), then change what differs; mass, centre, inertia and products are
 *  those of a pbmpm_mass_properties, or the host's own. It may change from call to call. In 2D positions and forces use components
 *  0 and 1, inertia and torque component 2.
 *
 *  A hinge: `moves` NONE, `turns` AXIS. A ball joint: `moves` NONE, `turns` ALL (2D: a hinge). A slider: `moves` AXIS, `turns`
 *  NONE. */
typedef struct pbmpm_rigid_def {
    uint32_t size;         /**< sizeof(pbmpm_rigid_def), set by pbmpm_rigid_def_init() */
    int32_t stays_inside;  /**< 1 (default): the domain's walls stop its corners and round parts (baked: its box). 0: off. Not with
                                `moves` NONE */
    pbmpm_freedom moves;   /**< how its centre of mass may move; NONE: its `pivot` stays in place instead. Default ALL */
    pbmpm_freedom turns;   /**< how it may turn. 2D: NONE, or else about the third axis. Default ALL */
    double mass;           /**< [kg] (2D: per metre of depth), in [1e-12, 1e15]; default 1 */
    double centre[3];      /**< centre of mass [m], from the shape's position, in the shape's own frame; within 1e9; default 0 */
    double inertia[3];     /**< as in pbmpm_mass_properties; positive definite, within 1e30. 2D: only zz counts. Default 1, 1, 1 */
    double products[3];    /**< see pbmpm_mass_properties; default 0 */
    double pivot[3];       /**< [m] `moves` NONE: the point that stays, from the shape's position, in its frame; within 1e9, default
                                0 */
    double move_axis[3];   /**< of `moves`, in the world, any length from 1e-6 to 1e9; default (0, 1, 0) */
    double turn_axis[3];   /**< of `turns`, in the world, any length from 1e-6 to 1e9; not used in 2D; default (0, 0, 1) */
    double force[3];       /**< the host's, beside gravity and matter, at the centre of mass [N]; within 1e30; default 0 */
    double torque[3];      /**< the host's, such as a motor's or a brake's [N m]; within 1e30; default 0 */
} pbmpm_rigid_def;

/** Pose and motion of a rigid body. In 2D angular velocities use component 2, positions and velocities 0 and 1.
 *  pbmpm_rigid_begin() fills it; the host may set velocities. Snapshots do not hold it: keep a copy beside each snapshot. */
typedef struct pbmpm_rigid_state {
    uint32_t size;                     /**< sizeof(pbmpm_rigid_state), set by the caller before pbmpm_rigid_begin() */
    uint32_t reserved;                 /**< must be 0 */
    double position[3];                /**< of the shape [m] at the end of the next step; within 1e9. After
                                            pbmpm_world_shift_origin() subtract `moved`. */
    double rotation[4];                /**< quaternion (x, y, z, w) of length 0.5 to 2; 2D: x and y are 0 */
    double velocity[3];                /**< of the centre of mass [m/s]; within 1e9 */
    double angular_velocity[3];        /**< [rad/s], in the world; within 1e9 */
    double velocity_change[3];         /**< by which the last call changed `velocity` [m/s]; the next call smooths with it */
    double angular_velocity_change[3]; /**< the same of `angular_velocity` [rad/s] */
    double point[3];                   /**< [m] `moves` NONE: where the pivot stays. AXIS, PLANE: a point of the centre of mass's
                                            line or plane. ALL: unused. After pbmpm_world_shift_origin() subtract `moved`. */
    double virtual_mass;               /**< V of the last call [kg], 0 if the body yielded; the library never reads it */
} pbmpm_rigid_state;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any. */
PBMPM_API pbmpm_result pbmpm_rigid_def_init(pbmpm_rigid_def *def, size_t size);

/** Fills `state` for a body at rest at its obstacle's pose, `point` included. `state->size` must be set. Changes nothing in the
 *  world.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (also: the obstacle is a plane, not kinematic or measures no impulse), UNSUPPORTED, BUSY,
 *  FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_rigid_begin(pbmpm_world_id world, pbmpm_collider_id collider, const pbmpm_rigid_def *def, pbmpm_rigid_state *state);

/** Advances a body by `dt` seconds, the same as of the pbmpm_world_step() that follows, and its obstacle by pbmpm_collider_move().
 *  Call it once before each step; a second call would apply the last step's impulse again. Only `state` and the obstacle's target
 *  change.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (as pbmpm_rigid_begin() and pbmpm_world_step(); also a place out of range), UNSUPPORTED,
 *  OUT_OF_MEMORY, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_rigid_advance(pbmpm_world_id world, pbmpm_collider_id collider, const pbmpm_rigid_def *def, pbmpm_rigid_state *state, float dt);

#ifdef __cplusplus
}
#endif
#endif
