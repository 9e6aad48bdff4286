/* A number that tells whether two worlds have the same state. */
#ifndef PBMPM_SRC_SERVICES_STATE_HASH_H
#define PBMPM_SRC_SERVICES_STATE_HASH_H

#include "world/world.h"

uint64_t state_hash(const World *world);

#endif
