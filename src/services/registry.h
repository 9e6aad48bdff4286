/* All worlds of the process, by identifier. */
#ifndef PBMPM_SRC_SERVICES_REGISTRY_H
#define PBMPM_SRC_SERVICES_REGISTRY_H

#include "world/world.h"

/* Makes a world known. */
pbmpm_result registry_add(World *world, pbmpm_world_id *id);

/* Whether there is such a world. */
bool registry_has(pbmpm_world_id id);

/* Writes the identifiers of the first `capacity` worlds, and returns how many there are. */
uint32_t registry_list(pbmpm_world_id *ids, uint32_t capacity);

/* The world, held until registry_leave(): for the calling thread alone, or for it and others that only read. BUSY if that cannot be. */
pbmpm_result registry_enter(pbmpm_world_id id, World **world);
pbmpm_result registry_enter_to_read(pbmpm_world_id id, World **world);
void registry_leave(pbmpm_world_id id);

/* Takes a world out; it is the caller's to destroy. */
pbmpm_result registry_remove(pbmpm_world_id id, World **world);

/* Destroys all worlds. */
void registry_clear(void);

/* The same at unloading: worlds with the host's allocator, which may be gone by now, lose their threads alone. */
void registry_clear_at_unload(void);

#endif
