/* A world: all that one simulation owns. */
#ifndef PBMPM_SRC_WORLD_WORLD_H
#define PBMPM_SRC_WORLD_WORLD_H

#include <pthread.h>
#include <sys/types.h>

#include "base/memory.h"
#include "base/pool.h"
#include "base/substep.h"
#include "contact/obstacle_cache.h"
#include "contact/walls.h"
#include "grid/bodies.h"
#include "grid/grid.h"
#include "grid/islands.h"
#include "grid/kernels.h"
#include "grid/multilevel.h"
#include "matter/materials.h"
#include "matter/particle_tree.h"
#include "matter/particles.h"
#include "pbmpm/pbmpm.h"
#include "world/colliders.h"
#include "world/emitters.h"
#include "world/ended.h"
#include "world/events.h"
#include "world/forces.h"
#include "world/sinks.h"
#include "world/sleep_list.h"

/* In StepRecord.solver: the dual and the primal together. Statistics tell it by the number of the setting that leads to it. */
#define SOLVER_JOINT PBMPM_SOLVER_CONVERGENT

/* Costs and counts of the last step, summed over its substeps. */
typedef struct StepRecord {
    double ms_total, ms_sort, ms_scatter, ms_contacts, ms_iterate, ms_integrate;
    uint32_t substeps, iterations;
    /* Of the last substep; of several groups of islands see step.c. */
    pbmpm_solver solver;
    pbmpm_stop stop;
    uint32_t iterations_used, energy_checks_failed;
    double residual, predicted_error; /* [cells] */
    double deadline_ms;               /* of this substep, see now_ms(); with a time budget */
    uint32_t blocks_woken;            /* of the step */
    float seconds; /* of the step */
    float moved;  /* share of particles that left their cell in the last substep */
    float travel; /* the largest displacement in it [cells] */
} StepRecord;

/* Blocks with solids and those of the nodes that they touch; see rounds.h. */
typedef struct RoundsState {
    Array solid, touched; /* int32_t: their numbers */
    Array mark;           /* uint8_t per node block: touched */
    int32_t solids, touches;
    int64_t rows; /* particles in the blocks with solids */
} RoundsState;

/* Of the matter of a group, see eddy_damping.h. */
typedef struct EddyAccount {
    double debt;       /* [J]; below 0: credit */
    double left;       /* energy that its last substep left, less what it gained [J] */
    uint64_t particles; /* 0: there is no account */
} EddyAccount;

/* See eddy_damping.h. */
typedef struct EddyDamping {
    EddyAccount account[ISLAND_GROUPS + 1]; /* of each set of kinds */
    Array kept; /* see KernelArgs.dual.affine_kept */
} EddyDamping;

/* See dual_gains.h. */
typedef struct DualGains {
    Array of_block, of_body; /* DualGain per node block, and per body */
} DualGains;

/* Sand of the islands with one set of kinds, see granular.h. */
typedef struct GranularState {
    double seconds;  /* for which it has done what ends its state, less those for which it has not */
    double flowed;   /* for how long it has [s]; 0: it rested in the last substep that was judged */
    uint64_t judged : 62; /* the step after that in which it was; 0: never */
    uint64_t flows : 1;   /* or rests */
    uint64_t swells : 1;  /* whether it gets back what is missing, by the last two notes */
    float waited;         /* while it flows: for how long it has been slow since `missing` was noted [s] */
    float missing;        /* volume that a grain lacked on average then */
} GranularState;

/* The box around what stirred.h speaks of. */
typedef struct Stirred {
    double low[3], high[3]; /* [m] */
    uint64_t any;
} Stirred;

/* Of all of them. */
typedef struct Granular {
    GranularState of[ISLAND_GROUPS + 1]; /* each set of kinds */
    Stirred stirred;
    Array blocks;                        /* see granular.c */
} Granular;

/* What the dual solver keeps. */
typedef struct DualState {
    Array node_push, change2, uphill, cells, cell_solid_growth, cell_second_order, cell_change2, cell_uphill; /* see KernelArgs */
    Array kept, moved2; /* displacements and, per node block, what they changed; see dual_error.h */
    Array bounds; /* see granular_bound.c */
    RoundsState rounds;
    DualGains gains;
    EddyDamping eddy_damping;
} DualState;

/* What a guess may ask of the matter in a cell. */
typedef struct GuessAsked {
    float share, fallen2; /* of what is missing; times what is missing, the square of the most */
} GuessAsked;

/* Of a substep. */
typedef struct GuessMeasures {
    GuessAsked asked;
    float density; /* see guess_density() */
    float little;  /* cells with less mass are not asked */
    float least;   /* softness that all cells have */
} GuessMeasures;

/* What the guess of the pressure keeps. */
typedef struct GuessState {
    Array cells, sums; /* see pressure_guess.c */
    Multilevel multilevel;
    bool closed; /* matter fills a closed box */
    GuessMeasures measures;
} GuessState;

/* A step on a thread of its own; see background.c. */
typedef struct Background Background;
/* What was worked out for surfaces; see skin/state.h. */
typedef struct Skin Skin;
/* Pairs of steps that the primal solver remembers. */
enum { PRIMAL_MEMORY = 5 };

/* What the primal and the explicit solver keep. */
typedef struct PrimalState {
    Array force, block_energy; /* see KernelArgs */
    Array vectors;             /* all other vectors, see primal.c */
    Array accepted_energy;     /* of the accepted displacements, as block_energy */
    Array fed;                 /* see KernelArgs */
    double credit;             /* [J] what solutions with liquid lost and volume feedback has not stored yet: see primal_liquid.c */
    Array inverse;             /* per node 1 / (m + k) */
    Array kept, among_liquid;  /* per particle couple and void_room of KernelArgs; the latter: see there, of islands of solids and liquid */
    Array sums;                /* what passes add up, per node block */
    Array body_sums;           /* per body */
    Array searches;            /* per body, see primal_search.c */
    Array rigid, friction, moves;   /* per body, see primal_rigid.c, contact_constraints.h and primal_momentum.c */
    bool bounces;              /* a body of this substep, see primal_bounce.c */
    uint32_t yield_grips;      /* contacts with bodies that yield, see primal_yield.h */
    Array follower;            /* see primal_followers.h */
    uint32_t followers, led_once;
    Array block_share;         /* see KernelArgs; with BDF2 */
    Array body_share;          /* the same per body */
    Multilevel multilevel;
} PrimalState;

/* What the joint solver keeps. */
typedef struct JointState {
    Array contact, contact_begin; /* of the primal's parts, as those of Colliders */
    uint32_t contacts;
    Array base, node;             /* the predictor, and displacements where a part begins */
    Array particle;               /* held_pressure, then sketch of KernelArgs */
    Array gap;                    /* see node_gap of KernelArgs */
} JointState;

typedef struct World {
    pbmpm_world_def def; /* its pointers: to memory.allocator and tasks */
    pbmpm_task_hooks tasks;
    pbmpm_settings settings;
    Domain domain;
    Memory memory;
    pid_t owner; /* process that created it; threads do not survive a fork */
    bool frozen; /* by a fork in the middle of a call of the parent's */
    Pool *pool;
    const Kernels *kernels;

    Particles particles;
    Materials materials;
    Colliders colliders;
    BakedTable baked;
    Emitters emitters;
    Sinks sinks;
    Forces forces;
    Ended ended;
    pbmpm_flow flow; /* what emitters and sinks did */
    Grid grid;
    Islands islands;
    Substep substep; /* of the present substep, or the last one */
    KernelArgs args;
    DualState dual;
    GuessState guess;
    Walls walls;
    ObstacleCache obstacle_cache[ISLAND_GROUPS + 1]; /* of each set of kinds */
    PrimalState primal;
    JointState joint;
    Granular granular;
    Sleep sleep;
    double slow_dt;        /* [s] follows dt up at once and down slowly, see paper.c */
    double slow_iterations; /* follows the iterations down at once and up slowly, see solver.c; 0 before the first substep */
    double matter_depth;   /* [cells] of the present substep, see depth.h */
    bool strain_unchecked; /* F was set from outside and not looked at since */

    pthread_mutex_t making; /* see readers.h */
    ParticleTree particle_tree; /* of queries; empty until the first */
    Array submersion;       /* see submerged.c; empty until it is first asked for */
    Skin *skin;             /* null until a surface is asked for, see src/skin */
    Background *background; /* null until a step is begun in the background */

    Events events;
    StepRecord record;
    uint64_t step_count;
    double simulated_seconds;
    uint64_t deleted_total, clamped_total;
    uint64_t generation; /* of views */
} World;

pbmpm_world_def world_def_defaults(void);
pbmpm_settings settings_defaults(void);

/* Null if valid, else what is wrong. */
const char *world_def_problem(const pbmpm_world_def *def);
const char *settings_problem(const pbmpm_settings *settings, int dimension);

/* Whether matter at rest under one may move under the other. */
bool settings_change_motion(const pbmpm_settings *before, const pbmpm_settings *after);

/* Whether a collider acts on any of the matter that there is. */
bool world_feels(const World *world, const Collider *collider);

/* The cells that particles may be in; the neighbours of the last block are in range too. */
enum { CELL_LIMIT = PBMPM_MAX_CELL - 2 * K_BLOCK_AXIS };

/* Kilograms per unit of Particles.mass [m^d]. */
static inline double world_cell_volume(const World *world)
{
    const double dx = (double)world->def.cell_size;
    return world->def.dimension == 3 ? dx * dx * dx : dx * dx;
}

/* Of substeps of so many seconds. */
static inline Substep world_substep(const World *world, double dt) { return substep_of(dt, (double)world->def.cell_size); }

/* To be called before the first particle of a live material is added; does nothing the second time. */
pbmpm_result world_make_room_for(World *world, uint32_t material);

/* To be called when the particles are no longer what they were. */
static inline void world_expire_views(World *world) { world->generation++; }

#endif
