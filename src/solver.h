/* The position based solver: C. Lewin, "A Position Based Material Point Method", SIGGRAPH 2024 Talks.
 *
 * Each iteration gathers the displacements of the nodes to the particles, projects each particle's displacement gradient
 * towards its material's constraint, and scatters the result back as new node displacements. */
#ifndef PBMPM_SRC_SOLVER_H
#define PBMPM_SRC_SOLVER_H

#include "world.h"

/* Points the kernel arguments at the world's arrays, for substeps of `dt` seconds. */
void solver_bind(World *world, float dt, bool with_volume);

/* First P2G and predictor. */
void solver_predict(World *world);

/* `contacts`: what the nodes obey after every grid update. */
void solver_iterate(World *world, const ContactFrame *contacts);

/* Last G2P: moves the particles and updates J and F. */
void solver_integrate(World *world);

#endif
