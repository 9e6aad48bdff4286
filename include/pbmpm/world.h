/* pbmpm: worlds, their settings, and the step. */
#ifndef PBMPM_WORLD_H
#define PBMPM_WORLD_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    PBMPM_MAX_WORLDS = 1024,       /**< at the same time, per process */
    PBMPM_MAX_PARTICLES = 1 << 28, /**< per world */
    PBMPM_MAX_SUBSTEPS = 256,      /**< per step */
    PBMPM_MAX_ITERATIONS = 1000,   /**< per substep */
    /** Upper bound of pbmpm_settings.max_displacement [cells]. */
    PBMPM_MAX_CELLS_PER_SUBSTEP = 64,
    /** A particle farther than this from the origin along any axis [cells] is deleted, with an event. */
    PBMPM_MAX_CELL = 1 << 22
};

/** What a world keeps all its life. Fill it with pbmpm_world_def_init(), then change what differs. */
typedef struct pbmpm_world_def {
    uint32_t size;              /**< sizeof(pbmpm_world_def), set by pbmpm_world_def_init() */
    int32_t dimension;          /**< 2 or 3; default 3. 2D: positions and velocities use components 0 and 1, spins component 2. */
    float cell_size;            /**< grid spacing dx [m], in [1e-6, 1e6]; default 0.1 */
    uint32_t particle_capacity; /**< hard limit, 1 to PBMPM_MAX_PARTICLES; default 65536. Taken at creation: some 230 bytes per
                                     particle in 3D, and 0.12 MB of tables. More is taken later for fields that a solver needs, for
                                     colliders, and for occupied blocks (4^d cells). */
    double origin[3];           /**< place of the world in the host's coordinates [m]; default 0. A place is origin + position; the
                                     host adds them. The library computes without it, so scenes far from zero lose no precision.
                                     pbmpm_world_shift_origin() moves it. */
    uint64_t memory_budget;     /**< bytes that the world may hold at once; 0 (default): no limit */
    int32_t thread_count;       /**< 1 to 256, counting the caller; 0 (default): one per core of the machine. Results do not depend
                                     on it. With task hooks: how many tasks each enqueue gets; 0: one per core. */
    int32_t domain_enabled;     /**< 1: a closed box; pbmpm_domain_wall_set() opens walls. 0 (default): unbounded; what falls costs
                                     time for ever, unless kill bounds (drain.h) take it out */
    float domain_min[3];        /**< lower corner of the box [m], relative to the origin, within 2^21 cells of it; default 0 */
    float domain_max[3];        /**< upper corner, within 2^21 cells, too; at least 4 cells above domain_min per axis; default 1 */
    float domain_friction;      /**< Coulomb coefficient of the walls, in [0, 100]; default 0; see pbmpm_friction */
    int32_t domain_measures_impulse;   /**< 1: pbmpm_domain_impulse() reads what matter does to the walls; 0 (default): off */
    const pbmpm_allocator *allocator;  /**< null (default): the C library's memory. Copied at creation. */
    const pbmpm_task_hooks *tasks;     /**< null (default): the world's own threads. Copied at creation. */
    uint64_t user_data; /**< the host's own; the library only keeps it; default 0 */
} pbmpm_world_def;

/** How the equations of a substep are solved. */
typedef enum pbmpm_solver {
    PBMPM_SOLVER_PAPER = 0,      /**< the published method: N rounds of projection. Stiffness depends on N and dt, not on moduli */
    PBMPM_SOLVER_DUAL = 1,       /**< backward Euler with the materials' moduli; solves for one stress per particle. For liquids,
                                      sand, and bodies in liquids. Accelerated proximal gradients (FISTA) with restart */
    PBMPM_SOLVER_PRIMAL = 2,     /**< the same equations; solves for the displacements of grid nodes. For elastic bodies; none gains
                                      energy. L-BFGS with a multilevel preconditioner. Leave bulk_modulus of liquids at 0 with it:
                                      stiff liquids hardly move */
    PBMPM_SOLVER_EXPLICIT = 3,   /**< explicit MLS-MPM, to compare with: one pass, stable only while sound travels less than a cell
                                      per substep. Every liquid needs a bulk_modulus above 0, else steps return INVALID_ARGUMENT */
    PBMPM_SOLVER_CONVERGENT = 4, /**< default: per island of touching matter the dual, the primal or both, see docs/method.md */
    PBMPM_SOLVER_FORCE32 = 0x7fffffff
} pbmpm_solver;

/** Where the dual solver keeps the pressure of a liquid. */
typedef enum pbmpm_pressure {
    PBMPM_PRESSURE_PARTICLES = 0, /**< calm pools: each particle keeps its volume. More iterations damp fine motion more */
    PBMPM_PRESSURE_CELLS = 1,     /**< lively: each cell keeps the volume of its particles. Costs more, and pools stay restless.
                                       With PBMPM_SOLVER_CONVERGENT, liquid that touches solids uses PARTICLES all the same */
    PBMPM_PRESSURE_FORCE32 = 0x7fffffff
} pbmpm_pressure;

/** The time integration scheme. */
typedef enum pbmpm_integrator {
    PBMPM_INTEGRATOR_EULER = 0, /**< backward Euler: first order in dt, damps rotation and oscillation */
    PBMPM_INTEGRATOR_BDF2 = 1,  /**< second order: hardly damps them. Only where the primal solves without the dual, else EULER */
    PBMPM_INTEGRATOR_FORCE32 = 0x7fffffff
} pbmpm_integrator;

/** What ended the iterations of a substep. */
typedef enum pbmpm_stop {
    PBMPM_STOP_ITERATIONS = 0, /**< all iterations were done */
    PBMPM_STOP_ERROR = 1,      /**< the predicted error fell below target_error */
    PBMPM_STOP_TIME = 2,       /**< time_budget_ms was spent */
    PBMPM_STOP_FORCE32 = 0x7fffffff
} pbmpm_stop;

/** What may change between steps. State is in SI units, so dt and settings may change between any two steps. */
typedef struct pbmpm_settings {
    uint32_t size;          /**< sizeof(pbmpm_settings), set by pbmpm_settings_init() */
    int32_t substeps;       /**< equal parts that a step is cut into, 1 to PBMPM_MAX_SUBSTEPS; default 1 */
    int32_t iterations;     /**< N: of the solver, per substep, 1 to PBMPM_MAX_ITERATIONS; default 5. Ignored by
                                 PBMPM_SOLVER_EXPLICIT. */
    float gravity[3];       /**< acceleration [m/s^2], each in [-1e9, 1e9]; default 0 */
    float max_displacement; /**< largest particle displacement per substep [cells], in [0.1, PBMPM_MAX_CELLS_PER_SUBSTEP]; default
                                 32. Faster particles are slowed to it. An event and pbmpm_stats.clamped_total count them. */
    pbmpm_solver solver;    /**< default PBMPM_SOLVER_CONVERGENT */
    pbmpm_pressure pressure;     /**< for liquids that the dual solves, also within CONVERGENT; default PBMPM_PRESSURE_PARTICLES */
    pbmpm_integrator integrator; /**< default PBMPM_INTEGRATOR_EULER */
    float flip;             /**< share of the motion finer than the grid that liquids keep, in [0, 1]; default 0; 0.9 is lively. No
                                 effect on viscous liquids and with the paper's solver. (ASFLIP: Fei, Guo, Wu, Huang, Gao 2021) */
    float target_error;     /**< dual and primal, also within CONVERGENT: iterations end when the predicted error of the solution
                                 [cells] is below this, in [0, 1]; 0 (default): off */
    float time_budget_ms;   /**< as above: wall time for a step [ms], in [0, 1e6]; 0 (default): off. Of n substeps, substep k begins
                                 no iteration after k / n of it. Results then depend on the machine's speed: not deterministic. */
    int32_t sleeping;       /**< 1: blocks of matter at rest sleep and cost nothing until something wakes them, see sleep.h. 0
                                 (default): off, costs nothing */
    float sleep_speed;      /**< a block rests below this rms speed of its particles [m/s], in [0, 1e9]; default 0.05 */
    float sleep_time;       /**< how long a block and its neighbours must rest before it sleeps [s], in [0, 1e6]; default 0.5 */
} pbmpm_settings;

/** Writes the defaults. `size` is the caller's sizeof(*def). Members of a larger structure that this library does not know become
 *  0.
 *  Errors: INVALID_ARGUMENT (null), UNSUPPORTED (a size below the first version's, between two versions', or above 4096).
 *  Threads: any. */
PBMPM_API pbmpm_result pbmpm_world_def_init(pbmpm_world_def *def, size_t size);

/** Writes the defaults, as pbmpm_world_def_init() does. Errors and threads: the same. */
PBMPM_API pbmpm_result pbmpm_settings_init(pbmpm_settings *settings, size_t size);

/** Creates a world and takes its memory. On failure *world is the null identifier and nothing is held.
 *  Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, CAPACITY (worlds), UNSUPPORTED (size), UNSUPPORTED_CPU, THREAD. Threads: any. */
PBMPM_API pbmpm_result pbmpm_world_create(const pbmpm_world_def *def, pbmpm_world_id *world);

/** Destroys a world and everything in it. Its identifiers become invalid, and views of it must not be read any more. Waits for a
 *  background step.
 *  Errors: INVALID_ID (also on a second destroy), BUSY. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_world_destroy(pbmpm_world_id world);

/** Whether an identifier is that of a world: *valid is then 1, else 0, which is no error. A world that another thread or a
 *  background step is at work on is valid. Errors: INVALID_ARGUMENT (null). Threads: any. */
PBMPM_API pbmpm_result pbmpm_world_is_valid(pbmpm_world_id world, int32_t *valid);

/** Lists all worlds of the process. *count is how many there are; the first `capacity` of them are written to `worlds`, which
 *  may be null with a capacity of 0. Another thread may have destroyed one before the call returns. Errors: INVALID_ARGUMENT
 *  (null). Threads: any. */
PBMPM_API pbmpm_result pbmpm_get_worlds(pbmpm_world_id *worlds, uint32_t capacity, uint32_t *count);

/** The definition the world was made from, with origin and domain where pbmpm_world_shift_origin() left them. `allocator` and
 *  `tasks` point to the world's own copies. `def->size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED,
 *  BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_get_def(pbmpm_world_id world, pbmpm_world_def *def);

/** Reads the settings. `settings->size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_get_settings(pbmpm_world_id world, pbmpm_settings *settings);

/** Changes the settings, from the next step on.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null, a value out of range), UNSUPPORTED, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_world_set_settings(pbmpm_world_id world, const pbmpm_settings *settings);

/** Advances the world by `dt` seconds in `substeps` equal parts. `dt` must be in (0, 10]. A substep lasts at least 1e-25 s, and at
 *  least 1e-25 s per metre of cell size. Expires all views. Allocates memory only when matter occupies more blocks (4^d cells) than
 *  ever before.
 *  Errors: INVALID_ID, BUSY, FORKED; INVALID_ARGUMENT (dt out of range, or the explicit solver with a liquid without bulk_modulus);
 *  OUT_OF_MEMORY (the grid cannot grow).
 *  After OUT_OF_MEMORY earlier substeps of the call stay done, and the failed one is not. With PBMPM_SOLVER_CONVERGENT some islands
 *  may have moved by the failed substep already. Storage order may differ. Values of PBMPM_DEFORMATION that you set may be clamped
 *  to the material's range. With sleeping, what was at rest may have fallen asleep.
 *  Threads: exclusive; different worlds step at the same time. */
PBMPM_API pbmpm_result pbmpm_world_step(pbmpm_world_id world, float dt);

/** Moves the origin by the multiple of 4 cells that is nearest to `wanted` [m], and writes that to `moved`. In 2D moved[2] is 0.
 *  For scenes so large that a float is too coarse for positions.
 *  All positions are then relative to the new origin: those of particles, obstacles, emitters, drains and forces, the domain and
 *  the kill bounds. world_def.origin grows by `moved`. Subtract `moved` from positions that the host keeps, such as `position` and
 *  `point` of a pbmpm_rigid_state. Matter goes on bit for bit as it would have. The exception is where it meets obstacles, walls,
 *  emitters, drains, forces or bounds: their positions are rounded to floats. Nothing wakes. Expires all views.
 *  Restoring an older snapshot restores the old origin. In a world with a domain such a restore returns FOREIGN.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null, NaN, something would be out of its range), BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_world_shift_origin(pbmpm_world_id world, const double wanted[3], double moved[3]);

/** A number that changes whenever views expire: by steps, restores, shifts, and changes of particles. A view is valid while this
 *  number equals its `generation`. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_generation(pbmpm_world_id world, uint64_t *generation);

/** 64-bit hash of all particles in storage order: position, velocity, affine velocity, VOLUME_RATIO, DEFORMATION, PRESSURE,
 *  material, mass. Equal for the same calls on the same binary and instruction set, for any number of threads. With a strict build
 *  (pbmpm_build_is_strict()) on any instruction set.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_hash(pbmpm_world_id world, uint64_t *hash);

#ifdef __cplusplus
}
#endif
#endif
