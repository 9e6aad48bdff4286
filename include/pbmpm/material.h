/* pbmpm: materials. J is volume over rest volume, F the deformation gradient. d is the dimension, N settings.iterations, dx the
 * cell size, dt the length of a substep.
 * Method: C. Lewin, "A Position Based Material Point Method", SIGGRAPH 2024 Talks, doi 10.1145/3641233.3664323. */
#ifndef PBMPM_MATERIAL_H
#define PBMPM_MATERIAL_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    PBMPM_MAX_MATERIALS = 256 /**< per world */
};

/** What a material resists. */
typedef enum pbmpm_material_kind {
    PBMPM_LIQUID = 0,  /**< keeps its volume: J = 1 */
    PBMPM_ELASTIC = 1, /**< keeps its shape and volume: F is a rotation */
    PBMPM_SAND = 2,    /**< resists compression, and shear up to its friction; bears tension only with `cohesion` */
    PBMPM_VISCO = 3,   /**< elastic until strained too far, then flows at constant volume: clay, dough, mud */
    PBMPM_MATERIAL_KIND_FORCE32 = 0x7fffffff
} pbmpm_material_kind;

/** What happens to an elastic particle that is strained too far. */
typedef enum pbmpm_strain_policy {
    PBMPM_STRAIN_CLAMP = 0,  /**< singular values of F are kept in [strain_min, strain_max] */
    PBMPM_STRAIN_DELETE = 1, /**< deleted, with an event, if the condition number of F exceeds condition_max (the paper's rule).
                                  Also if det F is 0 or less, or a stretch reaches 10,000 */
    PBMPM_STRAIN_POLICY_FORCE32 = 0x7fffffff
} pbmpm_strain_policy;

/** How the stress of an elastic body follows from F. Here mu = E / (2 (1 + nu)) and lambda = E nu / ((1 + nu) (1 - 2 nu)). Only
 *  with the primal and the explicit solver. The paper's solver has no such law, and the dual takes every body as fixed
 *  corotated. */
typedef enum pbmpm_elastic_model {
    PBMPM_FIXED_COROTATED = 0, /**< energy mu |F - R|^2 + lambda/2 (J - 1)^2, R the rotation of F */
    PBMPM_NEO_HOOKEAN = 1,     /**< energy mu/2 (|F|^2 - d) - mu ln J + lambda/2 (ln J)^2. Below J = 0.1 ln J is continued by its
                                    second-order expansion, so that inverted matter has a finite stress */
    PBMPM_ELASTIC_MODEL_FORCE32 = 0x7fffffff
} pbmpm_elastic_model;

/** Parameters of one material. Fill it with pbmpm_material_def_init(), then change what differs. What solvers do with them:
 *  docs/method.md, "Matter".
 *
 *  Members marked "elastic" count for sand and visco, too, except elastic_model. Sand and visco need an elasticity_ratio of at
 *  least 0.01, else INVALID_ARGUMENT.
 *
 *  With the paper's solver stiffness is no parameter: it follows from the rate. A liquid acts with the bulk modulus
 *  density * relaxation * N * dx^2 / (4 d dt^2). An elastic body acts with the Young modulus
 *  density * relaxation * N * dx^2 / (4 dt^2). The other solvers take bulk_modulus, elastic_model, young_modulus and
 *  poisson_ratio. All solvers take kinematic_viscosity. */
typedef struct pbmpm_material_def {
    uint32_t size;              /**< sizeof(pbmpm_material_def), set by pbmpm_material_def_init() */
    pbmpm_material_kind kind;   /**< default PBMPM_LIQUID; cannot be changed later */
    float density;              /**< rest density [kg/m^3] (2D: per metre of depth), in [1e-3, 1e6]; default 1000 */
    float relaxation;           /**< paper's and dual solver: share of the error removed per iteration, in (0, 2); default 1.5. With
                                     `iterations` 1 use at most 4/3, else lone elastic particles tremble. */
    float viscosity;            /**< liquid, paper's solver only: share of the deviatoric strain rate removed per iteration,
                                     in [0, 1]; default 0. Acts as a kinematic viscosity of N * viscosity * dx^2 / (8 dt). */
    float volume_feedback;      /**< liquid, visco, and sand with the dual: how fast J is corrected to the volume on the grid,
                                     in [0, 1]; default 0.1; 0: off, and torn visco keeps its gaps. Share per 1/60 s, or per substep
                                     if longer; paper's solver, liquid: per substep. docs/method.md: Liquids keep their volume */
    float elasticity_ratio;     /**< elastic, paper's solver only: in [0, 1]; default 1. 1 resists any change of shape, 0 only
                                     changes of volume; values between blend the two */
    pbmpm_strain_policy strain_policy; /**< elastic; default PBMPM_STRAIN_CLAMP */
    float strain_min;           /**< elastic: lower bound of the singular values of F, in [1e-3, 1]; default 0.1 */
    float strain_max;           /**< elastic: upper bound, in [1, 1e4]; default 20 */
    float condition_max;        /**< elastic, PBMPM_STRAIN_DELETE: largest condition number of F, in [10, 1e6]; default 1e6 */
    float rebound_max;          /**< elastic, paper's solver only: largest strain corrected per iteration, in (0, 10]; default 1.
                                     Matter that was crushed to nothing grows back at this rate instead of exploding. */
    float bulk_modulus;         /**< liquid, not the paper's solver: K [Pa] (2D: N/m) of the pressure K (1 - J), in [1e-3, 1e15], or
                                     0 (default): incompressible */
    float kinematic_viscosity;  /**< liquid: nu [m^2/s], in [0, 1e6]; default 0; honey has 0.005. Above 0 it sticks to walls and
                                     obstacles, see pbmpm_friction, not to rigid bodies (rigid.h). Paper's solver: acts like 8 nu dt
                                     / (N dx^2) more `viscosity`; the sum is capped at 1. */
    pbmpm_elastic_model elastic_model; /**< elastic, only with the primal and the explicit solver; default PBMPM_FIXED_COROTATED */
    float young_modulus;        /**< elastic, not the paper's solver: E [Pa] (2D: plane strain), in [1e-3, 1e15]; default 1e5 */
    float poisson_ratio;        /**< elastic, not the paper's solver: nu, in [0, 0.495]; default 0.3 */
    float friction_angle;       /**< sand: phi [rad], in [0, 1.4]; default pi/6; tan(phi) is the friction coefficient. Law of Mohr
                                     and Coulomb in 2D and 3D: shear stress is at most sin(phi) times the mean of the largest and
                                     smallest principal pressure. */
    float cohesion;             /**< sand: bears tension until it has grown to J = exp(cohesion), in [0, 0.5]; default 0: dry */
    uint32_t volume_correction; /**< sand: 1 (default): loosened sand regains its volume before it bears pressure, from up to 3
                                     times of it (dual: 1.15). 0: it stays loose, and a heap grows with each fall */
    float yield_strain;         /**< visco: largest norm of the deviator of the logarithmic strain (ln of the stretches) that it
                                     bears, in [0, 10]; default 0.05. The yield stress in shear is sqrt(2) mu yield_strain. */
    float flow_rate;            /**< visco [1/s]: strain beyond yield_strain shrinks by exp(-flow_rate dt) per substep, in [0, 1e9];
                                     default 100. If flow_rate dt is far below 1: a Bingham fluid of viscosity mu / flow_rate
                                     [Pa s]. The default at 60 Hz gives 1.7, so flow depends on dt. */
    uint64_t key;       /**< unique number among the world's materials, by which snapshots match it; 0 (default): matched by the
                             index of its identifier instead, see snapshot.h */
    uint64_t user_data; /**< the host's own; the library only keeps it; default 0 */
    uint32_t groups;    /**< bit set of the groups that it belongs to, see pbmpm_collider_def.meets; must not be 0; default 1. Walls
                             of the domain act on all. */
    uint32_t reserved;  /**< must be 0 */
} pbmpm_material_def;

/** How stiff a material is with a world's settings and time step. */
typedef struct pbmpm_effective {
    uint32_t size;       /**< sizeof(pbmpm_effective), set by the caller */
    float bulk_modulus;  /**< [Pa]; 0: incompressible. Paper's solver: liquid density * relaxation * N * dx^2 / (4 d dt^2); elastic
                              a third (2D: half) of young_modulus. Other solvers, elastic: lambda + 2 mu / d of the young_modulus
                              below. Other solvers, liquid: the material's own. Primal: what it used in the last step, if the
                              liquid is incompressible or CONVERGENT bounds it. */
    float young_modulus; /**< elastic [Pa]; 0 for a liquid. Paper's solver: density * relaxation * N * dx^2 / (4 dt^2). Primal and
                              explicit: the material's own. Dual: that, or what N iterations reach if that is less. Convergent: as
                              the solver of the island that the particles are in now; of several islands the softest. */
    float kinematic_viscosity; /**< liquid [m^2/s]: the material's own. Paper's solver: plus N viscosity dx^2 / (8 dt), capped at
                                    N dx^2 / (8 dt). Numerical viscosity is not included */
    float courant;       /**< cells that its pressure wave travels per substep; 0: incompressible. Explicit: must stay below 1. */
} pbmpm_effective;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any. */
PBMPM_API pbmpm_result pbmpm_material_def_init(pbmpm_material_def *def, size_t size);

/** Which kinds of materials this library was built with: bit k (1u << PBMPM_LIQUID, ...) is set for kind k. The CMake option
 *  PBMPM_MATERIALS chooses. Creating a kind that is left out is refused as UNSUPPORTED. A build with liquids alone is smaller.
 *  Threads: any. */
PBMPM_API uint32_t pbmpm_materials_built(void);

/** Adds a material to a world. One that no particle has costs neither memory nor time.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (kind or size unknown, or the kind is not built), CAPACITY, BUSY, FORKED.
 *  Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_material_create(pbmpm_world_id world, const pbmpm_material_def *def, pbmpm_material_id *material);

/** Reads a material. `def->size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_material_get(pbmpm_world_id world, pbmpm_material_id material, pbmpm_material_def *def);

/** How stiff the material is when the world is stepped by `dt` [s] with its present settings. `effective->size` must be set.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null; dt not in (0, 10]), UNSUPPORTED, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_material_effective(pbmpm_world_id world, pbmpm_material_id material, float dt, pbmpm_effective *effective);

/** Changes the parameters of a material (not its kind or density), from the next step on.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_material_set(pbmpm_world_id world, pbmpm_material_id material, const pbmpm_material_def *def);

/** Removes a material that no particle and no emitter uses. Errors: INVALID_ID, IN_USE, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_material_destroy(pbmpm_world_id world, pbmpm_material_id material);

/** Whether an identifier is that of a material of the world. *valid is then 1, else 0 (null, stale, foreign, or the world is gone),
 *  which is no error.
 *  Errors: INVALID_ARGUMENT (null), BUSY, FORKED; *valid is then as before. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_material_is_valid(pbmpm_world_id world, pbmpm_material_id material, int32_t *valid);

/** Lists the materials of the world, in no particular order. *count is how many there are; the first `capacity` of them are
 *  written to `materials`, which may be null with a capacity of 0. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY, FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_get_materials(pbmpm_world_id world, pbmpm_material_id *materials, uint32_t capacity, uint32_t *count);

#ifdef __cplusplus
}
#endif
#endif
