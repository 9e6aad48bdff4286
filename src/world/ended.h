/* Which things of a world were destroyed, so that a message tells what became of an identifier. */
#ifndef PBMPM_SRC_WORLD_ENDED_H
#define PBMPM_SRC_WORLD_ENDED_H

#include <stdint.h>

/* A few, as a world is small: a host that asks for a dead thing has most often just destroyed it. */
enum { ENDED_KEPT = 32 };

typedef struct Ended {
    uint32_t generation[ENDED_KEPT]; /* of the last ones; 0: none */
    uint32_t next;
} Ended;

void ended_add(Ended *ended, uint32_t generation);

/* What is wrong with the identifier of something that is not there: the end of a sentence. */
const char *ended_tell(const Ended *ended, uint32_t generation);

#endif
