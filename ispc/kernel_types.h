/* Structures that C and the ISPC kernels share. Plain C and ISPC both read this file; tests compare the layouts.
 *
 * Inside the kernels lengths are in cells: a displacement of 1 is one cell per substep, and the displacement gradient D
 * has no unit. Masses are densities times volumes in cells [kg/m^d], so their size does not depend on dx. */
#ifndef PBMPM_KERNEL_TYPES_H
#define PBMPM_KERNEL_TYPES_H

#ifdef ISPC
#define K_UNIFORM uniform
typedef unsigned int32 uint32_t;
typedef int32 int32_t;
#else
#include <stdint.h>
#define K_UNIFORM
#endif

/* One pointer type for both languages: a uniform pointer to uniform data. */
#define K_PTR(type) K_UNIFORM type *K_UNIFORM
#define K_CONST_PTR(type) const K_UNIFORM type *K_UNIFORM

#define K_BLOCK_AXIS 4  /* cells (and nodes) per block and axis */
#define K_TILE_AXIS 6   /* a block's nodes and one more on either side: all that its particles touch */
#define K_ENERGIES 5    /* floats per particle block, see KernelPrimal.block_energy */
#define K_NODE_WIDTH 4  /* floats per node: displacement (x, y, z), then mass */
#define K_MAX_GANG 16   /* particle arrays are padded by this many elements: no mass, at rest volume */
#define K_DRIFT_WIDTH 5 /* floats per block that sleeps: mass, mass times displacement (x, y, z), largest square of a displacement */
#define K_TILE_PAD 8    /* floats behind each tile that a full-width add may touch */

/* A run is a stretch of sorted particles of one material in one cell: uniform stencil, uniform parameters. */
#define K_RUN_CELL_BITS 6
#define K_RUN_CELL_MASK 63

#define K_LIQUID 0
#define K_SOLID 1

/* What is built, see materials.cmake. All but liquids have a deformation gradient F and share the code for it. */
#if !defined PBMPM_WITH_LIQUID || !defined PBMPM_WITH_ELASTIC || !defined PBMPM_WITH_SAND || !defined PBMPM_WITH_VISCO
#error "the build says by PBMPM_WITH_LIQUID and so on which materials there are"
#endif
#define K_WITH_SOLIDS (PBMPM_WITH_ELASTIC || PBMPM_WITH_SAND || PBMPM_WITH_VISCO)

/* How a K_SOLID material yields. */
#define K_NO_YIELD 0
#define K_SAND 1
#define K_VISCO 2

#define K_FIXED_COROTATED 0
#define K_NEO_HOOKEAN 1

#define K_SEEDING_NOISE 1.2f     /* what is put down at random is crowded or sparse by less than this factor */
#define K_LIQUID_RATIO_MIN 0.05f /* a liquid particle's J stays above this; by trial */
#define K_LIQUID_RATIO_MAX K_SEEDING_NOISE /* and below this: spray that comes back shall not pull the pool together */

#define K_HEADS 3.0f /* crushed liquid moves as so many times its weight drives it, see growth_head2() in src/solvers/paper.c; by trial: with 4 it leaves H16 too fast */

#define K_INCREMENT_MAX 1e4f /* larger displacements [cells] and gradients are senseless, and their sums could overflow */

#define K_ALIVE 0
#define K_NOT_FINITE 1
#define K_OUT_OF_RANGE 2
#define K_CONDITION 3
#define K_REMOVED 4 /* by a call */

#ifndef __ISPC_STRUCT_KernelMaterial__
#define __ISPC_STRUCT_KernelMaterial__
struct KernelMaterial {
    int32_t kind;
    float relaxation;
    float viscosity;
    float volume_feedback;
    float elasticity_ratio;
    float strain_min;
    float strain_max;
    float condition_max; /* 0: clamp the strain instead of deleting */
    /* Of the paper's solver: */
    float rebound_max;  /* elastic: strain per iteration */
    float growth_max;   /* how far corrections may drive the strain of a substep; liquid: its trace */
    float head2;        /* liquid: the square of the way per substep [cells^2] that all its pressure drives, K_HEADS heads */
    float pressure_max; /* liquid: bound of the pressure, as a multiple of the stiffness */
    float volume_share; /* liquid: by which its J is brought back per substep, see volume_control.isph; 0: not, and it does not shift either */
    float even_share;   /* liquid of the paper's solver: by which J moves to the mean of its cell per substep */
    float inverse_density;
    /* Moduli times c = 4 dt^2 / (dx^2 density): the square of twice the Courant number of their waves. */
    int32_t elastic_model;
    float shear;              /* elastic: c mu */
    float dilation;           /* elastic: c lambda; liquid: c K, FLT_MAX if incompressible */
    float inverse_stiffness;  /* liquid: 1 / (c K); 0 if incompressible */
    float multiplier_per_pascal; /* liquid: from a pressure [Pa] to the multiplier to start from */
    float pascal_per_multiplier; /* liquid: from a multiplier to a pressure [Pa] */
    float lightness;          /* from a pressure that a cell holds to the multiplier, see cells.isph */
    float viscous_share;      /* liquid: what viscosity makes of D in a substep, see viscosity.isph */
    /* How elastic matter yields, see plastic.isph. */
    int32_t yields;
    float friction;           /* sand: sine of the friction angle */
    float cohesion;           /* sand: ln J where tension yields */
    float looseness;          /* sand: growth of ln J beyond that which is kept, and closes up before pressure is borne */
    float bulk_over_shear;    /* (2 mu + d lambda) / (2 mu) of the solver's law */
    float yield_strain;       /* visco: norm of the deviator of the logarithmic strain that is borne */
    float excess_kept;        /* visco: share of what is beyond that is left after a substep */
};
#endif

#ifndef __ISPC_STRUCT_KernelParticles__
#define __ISPC_STRUCT_KernelParticles__
/* Particles, sorted by block, cell and material; structure of arrays. */
struct KernelParticles {
    K_PTR(float) fraction[3]; /* position relative to the nearest node, in [-1/2, 1/2) */
    K_PTR(int32_t) cell[3]; /* that node */
    K_PTR(float) velocity[3];
    K_PTR(float) affine[9]; /* row-major, stride 3 in 2D too */
    K_PTR(float) volume_ratio;
    K_PTR(float) mass;
    K_PTR(float) deformation[9]; /* null without elastic materials */
    K_CONST_PTR(uint32_t) identity; /* two per particle: index and generation */
    K_PTR(float) past_velocity[3]; /* see Particles; null without BDF2 */
    K_PTR(float) past_affine[9];
    K_PTR(float) past_way[3];
    K_PTR(float) past_turn[9];
    K_PTR(float) past_dt;
    K_PTR(int32_t) status; /* K_ALIVE, or why the particle has to go */
};
#endif

#ifndef __ISPC_STRUCT_KernelGrid__
#define __ISPC_STRUCT_KernelGrid__
/* Runs, blocks and nodes. */
struct KernelGrid {
    K_CONST_PTR(uint32_t) run_begin; /* first particle of each run, and the end */
    K_CONST_PTR(uint32_t) run_key; /* cell in the block | material << K_RUN_CELL_BITS */
    K_CONST_PTR(uint32_t) block_run; /* first run of each particle block, and the end */
    K_CONST_PTR(int32_t) neighbour; /* 3^d indices per node block, x fastest; -1: not there */
    K_PTR(float) tile; /* per particle block: what its particles add to the nodes they touch */
    K_PTR(float) tile_volume; /* the same for rest volume, one float per node; null when no material asks for it */
    K_PTR(float) node; /* per node block: displacement and mass */
    K_PTR(float) node_base; /* per node block: displacement of the predictor, unconstrained, and mass; not the paper's solver */
    K_PTR(float) node_before; /* the same without forces: what particles brought, and gravity */
    K_PTR(float) node_volume; /* per node block: rest volume per cell volume */
    K_PTR(float) node_density; /* per node block: mass over rest volume of all matter there; null unless liquids differ in density */
    K_PTR(float) node_reach; /* out, per node block: largest displacement of the predictor */
    K_CONST_PTR(uint32_t) edged; /* per node block: 1 if its particles feel nodes near an obstacle that may have edges; null without rest volumes */
    K_PTR(uint32_t) clamped; /* out, per particle block: particles slowed to max_displacement */
    K_PTR(uint32_t) moved; /* out, per particle block: particles that left their cell */
    K_PTR(uint32_t) lost; /* out, per particle block: particles whose status is not K_ALIVE */
    K_PTR(float) travel; /* out, per particle block: largest displacement of a particle */
    K_PTR(float) drift; /* out, per particle block that sleeps: K_DRIFT_WIDTH floats, see drift_blocks(); null without sleeping */
    int32_t particle_blocks; /* blocks [0, particle_blocks) have particles; the rest are only touched */
};
#endif

#ifndef __ISPC_STRUCT_KernelDual__
#define __ISPC_STRUCT_KernelDual__
/* Of the dual solver. Null for the others. */
struct KernelDual {
    K_PTR(float) pressure; /* liquid: the multiplier; between substeps the pressure [Pa] */
    K_PTR(float) pressure_old; /* liquid: the multiplier one iteration before */
    K_PTR(float) second_order; /* liquid: what strain does beyond its trace, q of next_pressure(); null: nothing. All rows that iterate are written first, see dual.c */
    K_PTR(float) stress[6]; /* elastic: the multiplier, upper triangle row by row */
    K_PTR(float) stress_old[6];
    K_PTR(float) node_push; /* per node block: sum m w S (x_i - x_p) of the last iteration */
    K_PTR(float) change2; /* out, per particle block: how much the multipliers changed, see dual.isph */
    K_PTR(float) uphill; /* out, per particle block: positive where the extrapolation overshot */
    K_CONST_PTR(float) affine_kept; /* per particle block, null: 1; the share of their affine velocities that liquids keep, see src/solvers/eddy_damping.h */
    float stage_last, stage_before, stage_change; /* viscosity: coefficients of a stage */
    float momentum; /* beta of the extrapolation */
    float fine_carried; /* share that is kept of what a pressure has beside the mean of its cells */
    float grains_carried; /* the same for sand */
    float crushed_carried; /* share that is kept of a liquid's carried pressure where growth_max cuts its growth short */
    float growth_max; /* largest growth per substep that a crushed liquid is asked for */
};
#endif

#ifndef __ISPC_STRUCT_KernelPrimal__
#define __ISPC_STRUCT_KernelPrimal__
/* Of the primal, the joint and the explicit solver. Null for the others. */
struct KernelPrimal {
    K_PTR(float) node_force; /* per node block: sum m w T (x_i - x_p); after the first pass also sum m w h as fourth value */
    K_PTR(float) block_share; /* per node block, null without BDF2: share of forces, 1 or 4/9; afterwards 0: to finish without a past */
    K_PTR(float) block_energy; /* out, K_ENERGIES per particle block: m/4 phi of elastic matter, of liquids, of both at D = 0, and m/4 of -A : D */
    K_PTR(float) couple[3]; /* per particle of a solid: the entries 10, 20 and 21 of A, see balance_couple(); null without solids among liquid */
    K_CONST_PTR(uint32_t) among_liquid; /* per particle block: whether its body has liquid; null without solids among liquid */
    K_PTR(float) void_room; /* per particle of visco, see void_room(); written in the first pass; null unless there is visco and its volume is measured */
    K_PTR(float) fed; /* out, per particle block, null but for the primal solver: m/4 phi that volume feedback gave its liquid */
    K_PTR(float) held_pressure; /* per particle of a liquid, see held_energy() */
    K_PTR(float) sketch[9]; /* per particle of a solid: its gradient where the sketch ends; null without the joint solver */
    K_CONST_PTR(float) node_gap; /* per node block: what nodes that a solid reaches are short of being full; null without the joint solver */
    int32_t may_feed; /* whether volume feedback may give any */
    float held_stiffness; /* k of liquids in the joint solver; 0: they store energy */
};
#endif

#ifndef __ISPC_STRUCT_KernelCells__
#define __ISPC_STRUCT_KernelCells__
/* Pressures that stand in cells: per node block, for the cell above each node, see cells.isph. Null unless they do. */
struct KernelCells {
    K_PTR(float) mass; /* sum h l m */
    K_PTR(float) growth; /* what the mean of tr D is to become */
    K_PTR(float) solid_growth; /* share of it that solids ask for; null unless they take part in the guess */
    K_PTR(float) second_order; /* means of what the strain of liquid and sand does beyond its trace, see granular.isph; null where it is not asked for */
    K_PTR(float) softness; /* mean of 1 / (L J^2) */
    K_PTR(float) pressure;
    K_PTR(float) pressure_old;
    K_PTR(float) trace; /* out: mean of tr D */
    K_PTR(float) change2; /* out, per node block: this and `uphill` as those of KernelDual, of the cells */
    K_PTR(float) uphill;
    float settle; /* share of what sand is compressed by beyond its pressure that a substep gives back */
    int32_t elastic_guesses; /* whether `solid_growth` is of elastic bodies too, or of sand alone */
    int32_t probing; /* pressures of cells only: elastic particles are left alone, and liquids do not remember */
    float relaxation; /* w of the cells: the smallest of the liquids */
};
#endif

#ifndef __ISPC_STRUCT_KernelArgs__
#define __ISPC_STRUCT_KernelArgs__
/* By who owns what; the rest is of the substep. */
struct KernelArgs {
    struct KernelParticles particles;
    struct KernelGrid grid;
    struct KernelDual dual;
    struct KernelPrimal primal;
    struct KernelCells cells;

    K_CONST_PTR(struct KernelMaterial) material;
    int32_t iterations; /* the paper's solver; 0 with the others; see flight.isph */
    float flip; /* share of motion below the grid's resolution that liquids keep */
    float feedback_way; /* [cells] per substep from which on the volume feedback of liquids without tension is full; 0: always full */
    float quiet_way; /* the same for liquids that store energy, where it fades faster; 0: see feedback_way */
    float dt; /* [s] */
    float cells_per_metre; /* 1/dx */
    float gravity[3]; /* g dt^2 / dx: added to the predictor */
    float max_displacement; /* [cells] */
    int32_t max_cell;
    uint32_t salt; /* changes from substep to substep */
    int32_t check_strain; /* bring F into range before its first use */
};
#endif

#ifndef ISPC
typedef struct KernelMaterial KernelMaterial;
typedef struct KernelArgs KernelArgs;
#endif
#endif
