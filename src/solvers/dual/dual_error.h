/* How far the displacements of an unfinished dual solution are from the converged ones.
 *
 * In a mode of eigenvalue a (of "scatter stresses, gather gradients", at most 1) an error e of the displacements leaves the residual
 * R = w (a + 1/L) / sqrt(a) e, and the change of multipliers that R measures moves the nodes by U = sqrt(a) R. What is known of a solution
 * are the sums of R^2 and U^2 over all modes, and the slowest mode of the matter, s = sqrt(a_min).
 *   - Everything in the slowest mode: no error is larger, f(s) R with f(r) = r / (w (r^2 + 1/L)).
 *   - Everything in one mode, r = U / R: no error is smaller, f(r) R, since sum R^2/a >= (sum R^2)^2 / sum a R^2 (Cauchy and Schwarz).
 * Predicted is their geometric mean, which is wrong by at most the square root of their ratio either way.
 *
 * Where r < s, a part of R moves no node: there are more constraints than nodes can meet, and as particles keep their pressures each substep asks for those
 * anew. What does move is at most U / s in the slowest mode, and the error at most f(s) U / s, which is predicted. At rest it is most of R, and R alone
 * predicts too much; where modes are left that are slower than those of a pool (particles in disorder make such), U predicts half of the truth. */
#ifndef PBMPM_SRC_SOLVERS_DUAL_DUAL_ERROR_H
#define PBMPM_SRC_SOLVERS_DUAL_DUAL_ERROR_H

#include "world/world.h"

/* What a prediction needs beside the residual. */
typedef struct DualModes {
    double slowest;    /* sqrt(a) of the slowest mode */
    double relaxation; /* w */
    double softness;   /* 1/L */
    double response;   /* U / R of the last iteration whose displacements were compared; until then that of the slowest mode */
} DualModes;

/* Takes memory for the blocks of this substep. */
bool dual_error_prepare(World *world);
void dual_error_free(World *world);

/* The modes of the liquids in the grid. */
DualModes dual_modes_of(const World *world, double relaxation);

/* [cells], as the residual. */
double dual_predicted_error(const DualModes *modes, double residual);

/* The response of an iteration that left `residual` and whose displacements, extrapolated by `momentum` b, moved by `moved` (root mean square):
 * while iterations differ little, each moves by U + b of what the last one moved by, U / (1 - b) in all. */
void dual_find_response(DualModes *modes, double residual, double moved, double momentum);

/* Adds a loop that keeps the nodes' displacements. After it has run: the sum of m |change|^2 since they were kept last. */
void dual_compare_displacements(World *world, Loops *loops);
double dual_compared(const World *world);

#endif
