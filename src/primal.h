/* The convergent solver for elastic bodies. */
#ifndef PBMPM_SRC_PRIMAL_H
#define PBMPM_SRC_PRIMAL_H

#include "solver.h"

/* Takes memory for the blocks and particles of this substep. */
pbmpm_result primal_prepare(World *world);

void primal_solve(World *world, const ContactFrame *contacts);

#endif
