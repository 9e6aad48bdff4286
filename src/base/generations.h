/* Numbers that tell what is alive from what stood in the same place before. */
#ifndef PBMPM_SRC_BASE_GENERATIONS_H
#define PBMPM_SRC_BASE_GENERATIONS_H

#include <stdbool.h>
#include <stdint.h>

/* A number that no object of this process had before; never 0. */
uint32_t generation_next(void);

/* The same for particles, which have numbers of their own: those of stored data must not use up the other ones. */
uint32_t generation_next_of_particles(void);

/* Whether an object of this process has, or had, this number; of particles. */
bool generation_was_given(uint32_t generation);
bool generation_was_given_to_particles(uint32_t generation);

/* Numbers of particles up to this are taken: they stand in stored data. */
void generation_skip_of_particles(uint32_t last);

/* What stored data may hold: so many numbers are left then that they do not begin anew while anybody keeps an old one. */
#define GENERATION_STORED_MAX (UINT32_MAX - (1u << 24))

#endif
