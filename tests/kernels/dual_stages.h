/* The kernels of the dual solver compared with the reference one by one, each on what the kernel before it left. */
#ifndef PBMPM_TESTS_DUAL_STAGES_H
#define PBMPM_TESTS_DUAL_STAGES_H

#include "dual_reference.h"
#include "scene.h"

enum { DUAL_ARRAYS = 26 };

/* A scene bound to arrays of the test's own, filled with what must not be read: NaN. */
typedef struct DualStage {
    Scene scene;
    float *memory[DUAL_ARRAYS];
    RefGrid base; /* the predictor */
    float *strain; /* for args.cells.solid_growth, which is null: solids take no part in the guess */
    float *second_order; /* for args.dual.second_order, which is null: what strain does beyond its trace is not asked for */
} DualStage;

/* Opens a scene, sets its particles' pressures [Pa] at random and runs the kernels up to the predictor. */
DualStage dual_open(const SceneSpec *spec, pbmpm_isa isa, int dimension, uint32_t seed);
void dual_close(DualStage *stage);

typedef void CheckDual(DualStage *stage);

/* Runs a check on a scene, with `seeds` sets of particles, in 2D and 3D, for each instruction set, and reports. */
void dual_check_spec(const SceneSpec *spec, int seeds, CheckDual *check);
/* The same without the report, on one set. */
void dual_check_once(const SceneSpec *spec, pbmpm_isa isa, int dimension, uint32_t seed, CheckDual *check);

/* The multiplier of a particle, and Y = S + momentum (S - S_old). */
void dual_multiplier(const DualStage *stage, uint32_t row, double S[9]);
void dual_multiplier_before(const DualStage *stage, uint32_t row, double S[9]); /* the one before */
void dual_extrapolated(const DualStage *stage, uint32_t row, double Y[9]);

/* What a particle of this pressure [Pa] starts from: 4 dt^2 / (dx^2 density) times it, and the share that is carried, see dual_carried_share(). */
double dual_first_pressure(const DualStage *stage, uint32_t row, float pascal);

/* Runs a kernel that makes the next multipliers, and compares them, of liquids too if asked, and what blocks report of them. */
void dual_check_multipliers(DualStage *stage, Kernel *kernel, bool liquids);

/* That tiles hold the scatter of the multipliers that the particles have now. */
void dual_check_tiles(const DualStage *stage, const char *what);

/* Pressures on particles. */
void dual_check_begin(DualStage *stage);
void dual_check_push(DualStage *stage);
void dual_check_iterate(DualStage *stage);

/* Pressures in cells. */
void cells_check_begin(DualStage *stage);
void cells_check_mean(DualStage *stage);
void cells_check_solids(DualStage *stage);
void cells_check_push(DualStage *stage);
void cells_check_carry(DualStage *stage, float fine);
void cells_check_add(DualStage *stage, Random *random);
void cells_check_trace(DualStage *stage);
void cells_check_guess_trace(DualStage *stage);
void cells_check_second_order(DualStage *stage); /* leaves it bound, for the iterations */
void cells_check_update(DualStage *stage);

/* Node displacements after a push: the predictor and the scatter of all extrapolated multipliers, with nothing kept in between. */
void dual_check_displacements(DualStage *stage, double momentum);

#endif
