/* The state of a world as a block of bytes.
 *
 * A header, then sections: a tag, the length of the payload, the payload, padded to whole words of 8 bytes. A part of the
 * library that has state of its own describes it by a SnapshotSection and adds that to the list in snapshot.c; nothing else
 * has to know. Sections without payload are left out, so an effect that is not in the world takes no byte. */
#ifndef PBMPM_SRC_SNAPSHOT_H
#define PBMPM_SRC_SNAPSHOT_H

#include "world.h"

uint64_t snapshot_size(const World *world);
uint32_t snapshot_bytes_per_particle(const World *world);

/* There is room for snapshot_size(). */
void snapshot_save(const World *world, void *buffer);

/* Writes the checksum of a snapshot whose other bytes are final. */
void snapshot_seal(void *snapshot);

/* On failure nothing has changed. */
pbmpm_result snapshot_restore(World *world, const void *snapshot, uint64_t bytes);

/* ---- For the sections ---- */

/* Where a payload goes. Without data it is only measured. */
typedef struct SnapshotOut {
    char *data;
    uint64_t at;
} SnapshotOut;

/* A payload. A section that the snapshot does not have is empty. */
typedef struct SnapshotIn {
    const char *data;
    uint64_t bytes;
    uint64_t at;
} SnapshotIn;

typedef struct SnapshotSection {
    uint32_t tag; /* never used again for something else */
    void (*save)(const World *world, SnapshotOut *out);
    /* Whether the payload may be loaded into this world. Changes nothing but scratch memory.
     * Checksums have been compared: what is wrong here is foreign or made up, and must do no harm. */
    pbmpm_result (*check)(World *world, SnapshotIn in);
    /* Takes the memory that it needs, all or none of it, when all sections were checked; null: it needs none. */
    pbmpm_result (*reserve)(World *world, SnapshotIn in);
    void (*load)(World *world, SnapshotIn in);
} SnapshotSection;

void snapshot_put(SnapshotOut *out, const void *data, size_t bytes);

/* False, and zeros, when the payload is shorter. */
bool snapshot_take(SnapshotIn *in, void *data, size_t bytes);

/* The next entry of a list of things in slots, which begins with the number of its slot (uint32_t); FOREIGN if that is not `slot`. */
pbmpm_result snapshot_take_slot(SnapshotIn *in, void *entry, size_t bytes, uint32_t slot, const char *things);

/* FOREIGN if the list goes on. */
pbmpm_result snapshot_at_end(const SnapshotIn *in, const char *things);

/* Refuses a payload that cannot be what its tag says. */
pbmpm_result snapshot_malformed(void);

#endif
