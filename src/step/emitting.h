/* What emitters do in a step. */
#ifndef PBMPM_SRC_STEP_EMITTING_H
#define PBMPM_SRC_STEP_EMITTING_H

#include "world/world.h"

/* Takes the memory that emitters_run() needs for part `part` of a step. */
pbmpm_result emitters_prepare(World *world, int part);
/* Adds what is due in that part, at its end. The obstacles are those of that part. */
void emitters_run(World *world, int part);

#endif
