/* The position based solver: C. Lewin, "A Position Based Material Point Method", SIGGRAPH 2024 Talks.
 *
 * Each iteration gathers the displacements of the nodes to the particles, projects each particle's displacement gradient
 * towards its material's constraint, and scatters the result back as new node displacements. */
#ifndef PBMPM_SRC_PAPER_H
#define PBMPM_SRC_PAPER_H

#include "solver.h"

/* What the projections need to know about a substep of `dt` seconds. */
void paper_set_materials(World *world, float dt);

void paper_solve(World *world, const ContactFrame *contacts);

#endif
