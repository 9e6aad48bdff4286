/* What sections of a snapshot are made of: payloads, and lists of named things in them. */
#ifndef PBMPM_SRC_SNAPSHOT_PAYLOAD_H
#define PBMPM_SRC_SNAPSHOT_PAYLOAD_H

#include "world/keyed.h"
#include "world/world.h"

/* Payloads are padded to whole words. */
enum { SNAPSHOT_WORD = 8 };
static inline uint64_t snapshot_padded(uint64_t bytes) { return (bytes + SNAPSHOT_WORD - 1) / SNAPSHOT_WORD * SNAPSHOT_WORD; }

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
