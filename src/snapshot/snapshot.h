/* The state of a world as a block of bytes.
 *
 * A header, then sections: a tag, the length of the payload, the payload, padded to whole words of 8 bytes. A part of the
 * library that has state of its own describes it by a SnapshotSection and adds that to the list in snapshot.c; nothing else
 * has to know. Sections without payload are left out, so an effect that is not in the world takes no byte. */
#ifndef PBMPM_SRC_SNAPSHOT_SNAPSHOT_H
#define PBMPM_SRC_SNAPSHOT_SNAPSHOT_H

#include "world/keyed.h"
#include "world/world.h"

uint64_t snapshot_size(const World *world);
uint32_t snapshot_bytes_per_particle(const World *world);

/* There is room for snapshot_size(). */
void snapshot_save(const World *world, void *buffer);

/* Writes the checksum of a snapshot whose other bytes are final. */
void snapshot_seal(void *snapshot);

/* On failure nothing has changed. */
pbmpm_result snapshot_restore(World *world, const void *snapshot, uint64_t bytes, uint32_t flags);

/* ---- For the sections ---- */

/* Where a payload goes. Without data it is only measured. */
typedef struct SnapshotOut {
    char *data;
    uint64_t at;
} SnapshotOut;

/* What the sections of one snapshot tell each other. */
typedef struct Restoring {
    bool keeps;                             /* PBMPM_RESTORE_KEEP_PARAMETERS */
    int16_t material[PBMPM_MAX_MATERIALS]; /* where a material of the snapshot stands in this world; -1: nowhere */
} Restoring;

/* A payload. A section that the snapshot does not have is empty. */
typedef struct SnapshotIn {
    const char *data;
    uint64_t bytes;
    uint64_t at;
    Restoring *restoring;
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

/* A structure that may grow at its end from version to version: its length, its bytes, padding to whole words. */
void snapshot_put_part(SnapshotOut *out, const void *part, size_t bytes);

/* Reads one of any version into `part`, which holds the values of what an older version lacks. False if the payload is shorter, or if a later
 * version wrote what is not 0. */
bool snapshot_take_part(SnapshotIn *in, void *part, size_t bytes);

/* Whether a list of things goes on. */
bool snapshot_goes_on(const SnapshotIn *in);

/* Each entry of such a list begins with the name of its thing. */
void snapshot_put_name(SnapshotOut *out, uint32_t slot, uint64_t key);

/* Which things of the world were found in the list. */
typedef struct Matched {
    uint64_t seen[PBMPM_MAX_COLLIDERS / 64];
} Matched;

/* The place of the next entry's thing in this world: that with its key, else that in its slot. -1 where there is none, which is FOREIGN unless
 * the world keeps its parameters. `saved` (may be null) becomes the slot that it had. */
pbmpm_result snapshot_take_name(const World *world, SnapshotIn *in, KeyedKind kind, Matched *matched, int32_t *place, uint32_t *saved);

/* FOREIGN if the world has more things than the list, unless it keeps its parameters. */
pbmpm_result snapshot_all_matched(const World *world, const SnapshotIn *in, KeyedKind kind, const Matched *matched);

/* A shape with the pose of another. */
pbmpm_shape snapshot_posed(const pbmpm_shape *shape, const pbmpm_shape *pose);

/* Refuses a payload that cannot be what its tag says. */
pbmpm_result snapshot_malformed(void);

#endif
