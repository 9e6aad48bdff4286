/* Explicit MLS-MPM. */
#ifndef PBMPM_SRC_EXPLICIT_H
#define PBMPM_SRC_EXPLICIT_H

#include "solver.h"

/* Takes memory for the blocks and particles of this substep. */
pbmpm_result explicit_prepare(World *world);

void explicit_solve(World *world, const ContactFrame *contacts);

#endif
