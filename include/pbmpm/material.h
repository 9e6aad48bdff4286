/* pbmpm: materials. J is volume over rest volume, F the deformation gradient. d is the dimension, N settings.iterations, dx the cell size, dt a substep.
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
    PBMPM_SAND = 2,    /**< an elastic body that shears as far as friction lets it and bears no tension */
    PBMPM_VISCO = 3,   /**< an elastic body that flows where it is strained too far, at constant volume: clay, dough, mud */
    PBMPM_MATERIAL_KIND_FORCE32 = 0x7fffffff
} pbmpm_material_kind;

/** What happens to an elastic particle that is strained beyond all measure. */
typedef enum pbmpm_strain_policy {
    PBMPM_STRAIN_CLAMP = 0,  /**< singular values of F are kept in [strain_min, strain_max] */
    PBMPM_STRAIN_DELETE = 1, /**< deleted, with an event: when F has a condition number above condition_max (the paper's
                                     rule), is a reflection, or stretches by 10,000 */
    PBMPM_STRAIN_POLICY_FORCE32 = 0x7fffffff
} pbmpm_strain_policy;

/** How the stress of an elastic body follows from F. Here mu = E / (2 (1 + nu)) and lambda = E nu / ((1 + nu) (1 - 2 nu)).
 *  Not used by the paper's solver; the dual solver takes every body as fixed corotated. */
typedef enum pbmpm_elastic_model {
    PBMPM_FIXED_COROTATED = 0, /**< energy mu |F - R|^2 + lambda/2 (J - 1)^2, R the rotation of F */
    PBMPM_NEO_HOOKEAN = 1,     /**< energy mu/2 (|F|^2 - d) - mu ln J + lambda/2 (ln J)^2; below J = 0.1 ln J is continued by its
                                    second-order expansion, so that inverted matter has a finite stress */
    PBMPM_ELASTIC_MODEL_FORCE32 = 0x7fffffff
} pbmpm_elastic_model;

/** Parameters of one material. Fill it with pbmpm_material_def_init(), then change what differs. What solvers do with them: docs/method.md, "Matter".
 *
 *  Sand and visco are elastic bodies with one more law. What is said of elastic ones holds for them, except elastic_model. Their elasticity_ratio is
 *  at least 0.01.
 *
 *  With the paper's solver stiffness is no parameter: it follows from the rate. A liquid acts with the bulk modulus
 *  density * relaxation * N * dx^2 / (4 d dt^2). An elastic body acts with the Young modulus density * relaxation * N * dx^2 / (4 dt^2).
 *  The other solvers take bulk_modulus, elastic_model, young_modulus and poisson_ratio. All solvers take kinematic_viscosity. */
typedef struct pbmpm_material_def {
    uint32_t size;              /**< sizeof(pbmpm_material_def), set by pbmpm_material_def_init() */
    pbmpm_material_kind kind;   /**< default PBMPM_LIQUID; cannot be changed later */
    float density;              /**< rest density [kg/m^3] (2D: per metre of depth), in [1e-3, 1e6]; default 1000 */
    float relaxation;           /**< share of the constraint error removed per iteration, in (0, 2); default 1.5. With one
                                     iteration lone elastic particles tremble above 4/3. */
    float viscosity;            /**< liquid: share, with the paper's solver alone, of the deviatoric strain rate removed per iteration, in [0, 1]; default 0.
                                     Acts as a kinematic viscosity of N * viscosity * dx^2 / (8 dt). */
    float volume_feedback;      /**< liquid, visco, and sand with the dual solver: share by which J follows the volume that the grid holds, in [0, 1];
                                     default 0.1. Per substep with the paper's solver, else per 1/60 s, or per substep if that is longer. 0 switches it off,
                                     which costs nothing. What it does, and where: docs/method.md, "Liquids keep their volume". Visco that came apart closes up
                                     again before it bears pressure, unless this is 0 */
    float elasticity_ratio;     /**< elastic, the paper's solver: beta in [0, 1]; default 1. 1 resists any change of shape, 0 that of volume alone; between it
                                     is beta * rotation + (1 - beta) * the shape at unit volume */
    pbmpm_strain_policy strain_policy; /**< elastic; default PBMPM_STRAIN_CLAMP */
    float strain_min;           /**< elastic: lower bound of the singular values of F, in [1e-3, 1]; default 0.1 */
    float strain_max;           /**< elastic: upper bound, in [1, 1e4]; default 20 */
    float condition_max;        /**< elastic, PBMPM_STRAIN_DELETE: largest condition number of F, in [10, 1e6]; default 1e6 */
    float rebound_max;          /**< elastic: largest strain that the constraint asks for per iteration, in (0, 10]; default 1.
                                     Matter that was crushed to nothing grows back at this rate instead of exploding. */
    float bulk_modulus;         /**< liquid, not the paper's solver: K [Pa] (2D: N/m) of the pressure K (1 - J), in [1e-3, 1e15], or 0
                                     (default): incompressible */
    float kinematic_viscosity;  /**< liquid: nu [m^2/s], in [0, 1e6]; default 0. Honey has about 0.005. It does not slip on obstacles and walls, but for
                                     rigid bodies (rigid.h) and those with PBMPM_FRICTION_SLIP; with the primal as with the paper's
                                     solver it does. The paper's solver adds a share of 8 nu dt / (N dx^2) to
                                     `viscosity`. Together they are at most 1: nu up to N dx^2 / (8 dt) */
    pbmpm_elastic_model elastic_model; /**< elastic, not the paper's solver; default PBMPM_FIXED_COROTATED */
    float young_modulus;        /**< elastic, not the paper's solver: E [Pa] (2D: plane strain), in [1e-3, 1e15]; default 1e5 */
    float poisson_ratio;        /**< elastic, not the paper's solver: nu, in [0, 0.495]; default 0.3 */
    float friction_angle;       /**< sand: phi [rad], in [0, 1.4]; default pi/6; tan(phi) is the friction coefficient. Mohr and Coulomb's law in 2D and
                                     3D: a shear stress is at most sin(phi) times the mean of the largest and the smallest pressure. */
    float cohesion;             /**< sand: ln of the volume ratio J up to which it bears tension, in [0, 0.5]; default 0: dry */
    uint32_t volume_correction; /**< sand: 1 (default): sand that came apart closes up again before it bears pressure, from up to three times its volume (dual solver: 1.15
                                     times); 0: it does not, and a heap grows with each fall */
    float yield_strain;         /**< visco: largest norm of the deviator of the logarithmic strain (ln of the stretches) that it bears, in
                                     [0, 10]; default 0.05. The yield stress in shear is sqrt(2) mu yield_strain. */
    float flow_rate;            /**< visco [1/s]: strain beyond that shrinks by exp(-flow_rate dt), in [0, 1e9]; default 100. Flows like a
                                     Bingham fluid with the viscosity mu / flow_rate [Pa s], if flow_rate dt is far below 1. The default at 60 Hz has 1.7.
                                     Then the rate decides, too. */
    uint64_t key;       /**< how snapshots find it again; no two materials of a world may share one. 0 (default): none; the index of its identifier counts,
                             see snapshot.h */
    uint64_t user_data; /**< the host's own; the library only keeps it; default 0 */
    uint32_t groups;    /**< bit by bit, the groups that it belongs to, not 0; default 1. See pbmpm_collider_def.meets. Walls of the domain act on all. */
    uint32_t reserved;  /**< 0 */
} pbmpm_material_def;

/** How stiff a material is with a world's settings and rate. */
typedef struct pbmpm_effective {
    uint32_t size;       /**< sizeof(pbmpm_effective), set by the caller */
    float bulk_modulus;  /**< [Pa]; 0: incompressible. Paper's solver, liquid: density * relaxation * N * dx^2 / (4 d dt^2); elastic: a third (2D: half)
                              of young_modulus. Other solvers: the material's own. The primal solves an incompressible liquid as a
                              compressible one: then the modulus that it used in the last step. */
    float young_modulus; /**< elastic [Pa]; 0 for a liquid. Paper's solver: density * relaxation * N * dx^2 / (4 dt^2). Dual: the material's own or
                              what N iterations reach, whichever is less. Primal and explicit: the material's own. Convergent: as the
                              solver of the island that the particles are in now; of several islands the softest. */
    float kinematic_viscosity; /**< liquid [m^2/s]: the material's own; paper's solver: with N viscosity dx^2 / (8 dt) added, and at most
                                    N dx^2 / (8 dt); without what the transfers add */
    float courant;       /**< cells that its pressure wave travels per substep; 0: incompressible. Explicit: must stay below 1. */
} pbmpm_effective;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread. */
PBMPM_API pbmpm_result pbmpm_material_def_init(pbmpm_material_def *def, size_t size);

/** Which kinds of materials this library was built with: bit k (1u << PBMPM_LIQUID, ...) is set for kind k. What the CMake option
 *  PBMPM_MATERIALS leaves out has no kernels in the library, and creating it is refused as UNSUPPORTED. All kinds but liquids
 *  share the code of the deformation gradient: without any of them it is left out, too. Any thread. */
PBMPM_API uint32_t pbmpm_materials_built(void);

/** Adds a material to a world. Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (kind or size unknown, or the kind is not built), CAPACITY,
 *  BUSY. A material that no particle has costs nothing: neither memory nor time. */
PBMPM_API pbmpm_result pbmpm_material_create(pbmpm_world_id world, const pbmpm_material_def *def, pbmpm_material_id *material);

/** Reads a material. `def->size` must be set. Errors: INVALID_ID, UNSUPPORTED, BUSY. */
PBMPM_API pbmpm_result pbmpm_material_get(pbmpm_world_id world, pbmpm_material_id material, pbmpm_material_def *def);

/** How stiff the material is when the world is stepped by `dt` [s] with its present settings. `effective->size` must be set.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null; dt not in (0, 10]), UNSUPPORTED, BUSY. */
PBMPM_API pbmpm_result pbmpm_material_effective(pbmpm_world_id world, pbmpm_material_id material, float dt, pbmpm_effective *effective);

/** Changes the parameters of a material (not its kind or density); takes effect with the next step.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, BUSY. */
PBMPM_API pbmpm_result pbmpm_material_set(pbmpm_world_id world, pbmpm_material_id material, const pbmpm_material_def *def);

/** Removes a material that no particle uses. Errors: INVALID_ID, IN_USE, BUSY. */
PBMPM_API pbmpm_result pbmpm_material_destroy(pbmpm_world_id world, pbmpm_material_id material);

/** Whether an identifier is that of a material of the world: *valid is then 1, else 0: null, stale, foreign, or the world is gone. That is no
 *  error and leaves no message. Errors: INVALID_ARGUMENT (null), BUSY, FORKED: *valid is as before. */
PBMPM_API pbmpm_result pbmpm_material_is_valid(pbmpm_world_id world, pbmpm_material_id material, int32_t *valid);

/** Lists the materials of the world. *count is how many there are; the first `capacity` of them are written to `materials`, which may be null with a
 *  capacity of 0. The order says nothing. Errors: INVALID_ID, INVALID_ARGUMENT (null), BUSY. */
PBMPM_API pbmpm_result pbmpm_world_get_materials(pbmpm_world_id world, pbmpm_material_id *materials, uint32_t capacity, uint32_t *count);

#ifdef __cplusplus
}
#endif
#endif
