/* The dual solver: backward Euler with the materials' own moduli, for liquids and for liquids and elastic bodies together.
 * The equations stand in ispc/dual.isph. */
#ifndef PBMPM_SRC_SOLVERS_DUAL_DUAL_H
#define PBMPM_SRC_SOLVERS_DUAL_DUAL_H

#include "solvers/solver.h"

/* Takes memory for the blocks and particles of this substep. */
pbmpm_result dual_prepare(World *world);

void dual_free(World *world);

void dual_solve(World *world, const ContactFrame *contacts);

/* A stress takes about as many iterations as sound takes cells per substep, which is half the root of the stiffness c (2 mu + lambda): n iterations
 * get a stiffness of (n / 2.5)^2 to about a tenth (bars and blocks). */
#define DUAL_ITERATIONS_PER_ROOT 2.5

/* Nesterov's extrapolation, restarted where it goes uphill. */
typedef struct Acceleration {
    World *world;
    double t;
} Acceleration;

Acceleration acceleration_begin(World *world);

/* Sets args.momentum for the push that follows: 0 after the last iteration. */
void acceleration_next(Acceleration *acceleration, bool uphill, bool more);

/* c (2 mu + lambda) of an elastic material: the square of twice the Courant number of its pressure wave. */
double dual_stiffness_of(const World *world, const pbmpm_material_def *def, double substep);

/* The share of an elastic material's stiffness that the iterations of a substep can hold, and the share that they are asked for. */
double dual_stiffness_share(const World *world, const pbmpm_material_def *def, double substep);
double dual_stiffness_cap(const World *world, const pbmpm_material_def *def, double substep);

/* What the dual solver keeps of sand, where 1 Pa is the multiplier c. */
void dual_set_sand(World *world, uint32_t slot, double c);

/* How many iterations solids may count on in the next substep that count on so many in this one, where more are set; see solver.c. */
double dual_stiffened(const World *world, double substep, double iterations);

/* The share of its last pressure that a liquid starts a substep from. */
double dual_carried_share(const World *world);

/* The longest relaxation that solids stay calm with in so many iterations. */
float dual_longest_relaxation(int iterations);

#endif
