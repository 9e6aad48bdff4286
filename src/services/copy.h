/* Particles copied for rendering, in one packed layout. */
#ifndef PBMPM_SRC_SERVICES_COPY_H
#define PBMPM_SRC_SERVICES_COPY_H

#include "world/world.h"

pbmpm_copy_def copy_def_defaults(void);

/* Null if valid, else what is wrong. */
const char *copy_problem(const pbmpm_copy_def *def);

/* While a step runs in the background: of the published fields. */
pbmpm_result copy_particles(World *world, const pbmpm_copy_def *def, void *buffer, uint64_t capacity, uint32_t *count);

#endif
