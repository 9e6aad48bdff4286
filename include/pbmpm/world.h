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
    /** Largest displacement of a particle in one substep [cells]. */
    PBMPM_MAX_CELLS_PER_SUBSTEP = 64,
    /** Cells per axis and direction around the origin that a particle can be in; beyond, it is deleted with an event. */
    PBMPM_MAX_CELL = 1 << 22
};

/** What a world is made of for all its life. Fill it with pbmpm_world_def_init(), then change what differs. */
typedef struct pbmpm_world_def {
    uint32_t size;              /**< sizeof(pbmpm_world_def), set by pbmpm_world_def_init() */
    int32_t dimension;          /**< 2 or 3; default 3. In 2D the third component of every vector is ignored. */
    float cell_size;            /**< grid spacing dx [m], in [1e-6, 1e6]; default 0.1 */
    uint32_t particle_capacity; /**< hard limit, 1 to PBMPM_MAX_PARTICLES; default 65536. Memory is taken at creation: some 230 bytes per particle in 3D,
                                     and 0.12 MB for the tables of 256 materials and 1024 events. Fields that a solver needs, colliders and
                                     blocks take theirs when they come. */
    double origin[3];           /**< what positions are relative to [m]; default 0. The library does not compute with it, so a scene far from
                                     zero loses no precision; the host adds it. pbmpm_world_shift_origin() moves it. */
    uint64_t memory_budget;     /**< bytes that the world may hold at once; 0 (default): no limit */
    int32_t thread_count;       /**< 1 to 256, counting the caller; 0 (default): one per core. Results do not depend on it.
                                     With task hooks: how many shares the work is cut into. */
    int32_t domain_enabled;     /**< 0 (default): unbounded: what falls, falls for ever and costs time; set kill bounds (drain.h) to take it out.
                                     1: closed box, walls that hold matter in; pbmpm_domain_wall_set() opens one. */
    float domain_min[3];        /**< lower corner of the box [m], relative to the origin; default 0 */
    float domain_max[3];        /**< upper corner; at least 4 cells above domain_min per axis; default 1 */
    float domain_friction;      /**< Coulomb coefficient of the walls, in [0, 100]; default 0; see pbmpm_friction */
    int32_t domain_measures_impulse;   /**< 1: pbmpm_domain_impulse() tells what matter does to the walls; 0 (default): costs nothing */
    const pbmpm_allocator *allocator;  /**< null (default): the C library's memory. Read at creation only. */
    const pbmpm_task_hooks *tasks;     /**< null (default): the world's own threads. Read at creation only. */
    uint64_t user_data; /**< the host's own; the library only keeps it; default 0 */
} pbmpm_world_def;

/** How the equations of a substep are solved. */
typedef enum pbmpm_solver {
    PBMPM_SOLVER_PAPER = 0,      /**< the paper's: the projections of all particles, transferred N times; its stiffness follows from N and dt */
    PBMPM_SOLVER_DUAL = 1,       /**< backward Euler with the materials' own moduli; unknown: one stress per particle. For liquids, sand, and bodies in
                                      liquids. Accelerated proximal gradients (FISTA) with restart */
    PBMPM_SOLVER_PRIMAL = 2,     /**< the same equations; unknown: the displacements of the nodes. For elastic bodies. L-BFGS with a multilevel
                                      preconditioner; no body gains energy. Leave the bulk modulus of its liquids at 0: stiff ones hardly move */
    PBMPM_SOLVER_EXPLICIT = 3,   /**< explicit MLS-MPM, to compare with: one pass, stable only while sound travels less than a cell per
                                      substep. Liquids need a bulk modulus. */
    PBMPM_SOLVER_CONVERGENT = 4, /**< default: the dual, the primal or both for each island of touching matter, see docs/method.md */
    PBMPM_SOLVER_FORCE32 = 0x7fffffff
} pbmpm_solver;

/** Where the dual solver keeps the pressure of a liquid. */
typedef enum pbmpm_pressure {
    PBMPM_PRESSURE_PARTICLES = 0, /**< calm: each particle keeps its volume; the better it is solved, the more it damps fine motion */
    PBMPM_PRESSURE_CELLS = 1,     /**< lively: each cell keeps the volume of its particles; costs more, and pools stay restless. Where
                                       PBMPM_SOLVER_CONVERGENT solves solids with liquid, particles keep it. */
    PBMPM_PRESSURE_FORCE32 = 0x7fffffff
} pbmpm_pressure;

/** How a substep follows from those before it. */
typedef enum pbmpm_integrator {
    PBMPM_INTEGRATOR_EULER = 0, /**< backward Euler: first order in dt, damps rotation and oscillation */
    PBMPM_INTEGRATOR_BDF2 = 1,  /**< second order: hardly damps them. Acts in islands that the primal solves alone; elsewhere EULER does */
    PBMPM_INTEGRATOR_FORCE32 = 0x7fffffff
} pbmpm_integrator;

/** What ended the iterations of a substep. */
typedef enum pbmpm_stop {
    PBMPM_STOP_ITERATIONS = 0, /**< all iterations were done */
    PBMPM_STOP_ERROR = 1,      /**< the predicted error fell below target_error */
    PBMPM_STOP_TIME = 2,       /**< time_budget_ms was spent */
    PBMPM_STOP_FORCE32 = 0x7fffffff
} pbmpm_stop;

/** What may change between steps. State is kept in physical units, so a change of rate changes no motion. */
typedef struct pbmpm_settings {
    uint32_t size;          /**< sizeof(pbmpm_settings), set by pbmpm_settings_init() */
    int32_t substeps;       /**< equal parts that a step is cut into, 1 to PBMPM_MAX_SUBSTEPS; default 1 */
    int32_t iterations;     /**< N: of the solver, per substep, 1 to PBMPM_MAX_ITERATIONS; default 5. Ignored by PBMPM_SOLVER_EXPLICIT. */
    float gravity[3];       /**< acceleration [m/s^2]; default 0 */
    float max_displacement; /**< largest particle displacement per substep [cells], in [0.1, PBMPM_MAX_CELLS_PER_SUBSTEP];
                                 default 32. Faster particles are slowed to it; each time is counted in the events. */
    pbmpm_solver solver;    /**< default PBMPM_SOLVER_CONVERGENT */
    pbmpm_pressure pressure;     /**< dual solver; default PBMPM_PRESSURE_PARTICLES */
    pbmpm_integrator integrator; /**< default PBMPM_INTEGRATOR_EULER */
    float flip;             /**< share alpha of the motion below the grid's resolution that liquids without viscosity keep (ASFLIP: Fei, Guo, Wu, Huang, Gao 2021;
                                 not the paper's solver), in [0, 1]; default 0. 0.9 is lively. */
    float target_error;     /**< dual and primal: iterations end when the predicted error of the solution [cells] is below this;
                                 in [0, 1], 0 (default): off */
    float time_budget_ms;   /**< dual and primal: no iteration is begun once this much wall time [ms] of the step is spent; each
                                 substep gets an equal part; in [0, 1e6], 0 (default): off. Results then depend on the machine's
                                 speed: not deterministic. */
    int32_t sleeping;       /**< 1: blocks of matter at rest fall asleep: they take no part in a step until something wakes them, see sleep.h;
                                 0 (default): off, costs nothing */
    float sleep_speed;      /**< sleeping: root mean square speed of a block's particles below which it is at rest [m/s], in
                                 [0, 1e9]; default 0.05 */
    float sleep_time;       /**< sleeping: how long a block and its neighbours must be at rest [s], in [0, 1e6]; default 0.5 */
} pbmpm_settings;

/** Writes the defaults. `size` is the caller's sizeof(*def).
 *  Errors: INVALID_ARGUMENT (null), UNSUPPORTED (a size that no version had). Any thread. */
PBMPM_API pbmpm_result pbmpm_world_def_init(pbmpm_world_def *def, size_t size);

/** Writes the defaults, as pbmpm_world_def_init() does. */
PBMPM_API pbmpm_result pbmpm_settings_init(pbmpm_settings *settings, size_t size);

/** Creates a world and takes its memory. On failure *world is the null identifier and nothing is held.
 *  Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, CAPACITY (worlds), UNSUPPORTED_CPU, THREAD. Any thread. */
PBMPM_API pbmpm_result pbmpm_world_create(const pbmpm_world_def *def, pbmpm_world_id *world);

/** Destroys a world and everything in it; views and identifiers of it become invalid.
 *  Errors: INVALID_ID (also on a second destroy), BUSY. Any thread. */
PBMPM_API pbmpm_result pbmpm_world_destroy(pbmpm_world_id world);

/** Whether an identifier is that of a world: *valid is then 1, else 0, which is no error. A world that a step or another thread is at work on is
 *  valid. Errors: INVALID_ARGUMENT (null). Any thread. */
PBMPM_API pbmpm_result pbmpm_world_is_valid(pbmpm_world_id world, int32_t *valid);

/** Lists all worlds of the process. *count is how many there are; the first `capacity` of them are written to `worlds`, which may be null with a
 *  capacity of 0. Another thread may have destroyed one before the call returns. Errors: INVALID_ARGUMENT (null). Any thread. */
PBMPM_API pbmpm_result pbmpm_get_worlds(pbmpm_world_id *worlds, uint32_t capacity, uint32_t *count);

/** The definition the world was made from, with origin and domain where pbmpm_world_shift_origin() left them. Its pointers are to copies that live as long as the world. `def->size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY. */
PBMPM_API pbmpm_result pbmpm_world_get_def(pbmpm_world_id world, pbmpm_world_def *def);

/** Reads the settings. `settings->size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY.
 *  Any thread, together with others that read. */
PBMPM_API pbmpm_result pbmpm_world_get_settings(pbmpm_world_id world, pbmpm_settings *settings);

/** Changes the settings. All or nothing. Errors as pbmpm_world_get_settings(), and INVALID_ARGUMENT. Any thread, alone in its world. */
PBMPM_API pbmpm_result pbmpm_world_set_settings(pbmpm_world_id world, const pbmpm_settings *settings);

/** Advances the world by `dt` seconds in `substeps` equal parts. Expires all views. Allocates nothing once the number
 *  of occupied blocks has stopped growing. `dt` must be in (0, 10]. A
 *  substep lasts at least 1e-25 s, and at least 1e-25 s per metre of the cell size.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, BUSY, FORKED; OUT_OF_MEMORY when the grid cannot grow. Then the substep that
 *  needed it is not done, earlier ones of the call stay done. Particles may be stored in another order. An F that
 *  was set from outside is brought into its material's range. With PBMPM_SOLVER_CONVERGENT islands that were solved before
 *  those that lacked memory stay where they went. With sleeping, what was at rest may have fallen asleep.
 *  Any thread, alone in its world; different worlds step at the same time. */
PBMPM_API pbmpm_result pbmpm_world_step(pbmpm_world_id world, float dt);

/** Moves the origin by the multiple of 4 cells that is nearest to `wanted` [m], and writes that to `moved`. For scenes so large that a float
 *  is too coarse for positions. All positions are then relative to the new origin: those of particles, obstacles, emitters, drains and forces, the
 *  domain and the kill bounds. world_def.origin grows by `moved`. Matter goes on bit for bit as it would have. The exception is where it
 *  meets obstacles, walls, emitters, drains, forces or bounds: their positions are rounded to floats. Nothing wakes. Expires all views. In 2D moved[2] is 0. What the host keeps, it moves itself: the
 *  `position` and `point` of a pbmpm_rigid_state. A snapshot from before brings its origin back, but not into a world with a domain: that is FOREIGN.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null, NaN, something would be out of its range), BUSY, FORKED: nothing has changed. */
PBMPM_API pbmpm_result pbmpm_world_shift_origin(pbmpm_world_id world, const double wanted[3], double moved[3]);

/** A number that changes with every call that moves, adds or removes particles. A view is valid while this number equals
 *  its `generation`. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY. */
PBMPM_API pbmpm_result pbmpm_world_generation(pbmpm_world_id world, uint64_t *generation);

/** 64-bit hash of the dynamic state in storage order (position, velocity, affine velocity, J, F, material, mass). Equal for
 *  the same calls on the same binary and instruction set, for any number of threads; of a strict build (pbmpm_build_is_strict()) on any
 *  instruction set. */
PBMPM_API pbmpm_result pbmpm_world_hash(pbmpm_world_id world, uint64_t *hash);

#ifdef __cplusplus
}
#endif
#endif
