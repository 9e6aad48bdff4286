/* The extrapolation of the dual solver's iterations, and what it is worth. */
#ifndef PBMPM_SRC_SOLVERS_DUAL_ACCELERATION_H
#define PBMPM_SRC_SOLVERS_DUAL_ACCELERATION_H

#include "world/world.h"

/* A stress takes about as many iterations as sound takes cells per substep, which is half the root of the stiffness c (2 mu + lambda): n iterations
 * get a stiffness of (n / 2.5)^2 to about a tenth (bars and blocks). */
#define DUAL_ITERATIONS_PER_ROOT 2.5

/* Nesterov's extrapolation, restarted where it goes uphill. */
typedef struct Acceleration {
    World *world;
    double t;
} Acceleration;

Acceleration acceleration_begin(World *world);

/* Sets args.dual.momentum for the push that follows: 0 after the last iteration. */
void acceleration_next(Acceleration *acceleration, bool uphill, bool more);

/* The share of the stress that balances an even strain, of the stiffness M, that so many iterations reach where none goes uphill. Nobody answers to it there, so
 * each leaves M / (1 + M) of what was wrong. */
double acceleration_reached(double stiffness, int iterations);

/* The extrapolation before the last of so many iterations, where none went uphill. */
double acceleration_last(int iterations);

#endif
