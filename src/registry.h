/* All worlds of the process, by identifier. */
#ifndef PBMPM_SRC_REGISTRY_H
#define PBMPM_SRC_REGISTRY_H

#include "world.h"

/* A number that no object of this process had before; never 0. */
uint32_t registry_next_generation(void);

/* Makes a world known. */
pbmpm_result registry_add(World *world, pbmpm_world_id *id);

/* The world, held for the calling thread until registry_leave(). */
pbmpm_result registry_enter(pbmpm_world_id id, World **world);
void registry_leave(pbmpm_world_id id);

/* Takes a world out; it is the caller's to destroy. */
pbmpm_result registry_remove(pbmpm_world_id id, World **world);

/* Destroys all worlds. */
void registry_clear(void);

/* Ends the threads of all worlds and leaves their memory alone: the host's allocator may be gone. */
void registry_stop_threads(void);

#endif
