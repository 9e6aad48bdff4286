/* The state of a world as a block of bytes.
 *
 * A header, then sections: a tag, the length of the payload, the payload, padded to whole words of 8 bytes. A part of the
 * library that has state of its own describes it by a SnapshotSection and adds that to the list in snapshot.c; nothing else
 * has to know. Sections without payload are left out, so an effect that is not in the world takes no byte. */
#ifndef PBMPM_SRC_SNAPSHOT_SNAPSHOT_H
#define PBMPM_SRC_SNAPSHOT_SNAPSHOT_H

#include "world/world.h"

uint64_t snapshot_size(const World *world);
uint32_t snapshot_bytes_per_particle(const World *world);

/* There is room for snapshot_size(). */
void snapshot_save(const World *world, void *buffer);

/* Writes the checksum of a snapshot whose other bytes are final. */
void snapshot_seal(void *snapshot);

/* On failure nothing has changed. */
pbmpm_result snapshot_restore(World *world, const void *snapshot, uint64_t bytes, uint32_t flags);

#endif
