/* What the fuzz targets share. A target is LLVMFuzzerInitialize(), LLVMFuzzerTestOneInput() and target_seeds(), in a file of its own. It is
 * linked to libFuzzer (preset "fuzz") or to replay.c, which runs it once on every file it is given. */
#ifndef PBMPM_TESTS_FUZZ_H
#define PBMPM_TESTS_FUZZ_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "pbmpm/pbmpm.h"

int LLVMFuzzerInitialize(int *count, char ***arguments);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Hands sound inputs to fuzz_seed(), one by one. */
void target_seeds(void);
void fuzz_seed(const char *name, const void *data, size_t size);

/* For LLVMFuzzerInitialize(): before any other call of the library, and when the target's worlds are there. Chooses the SSE4 kernels, which the
 * sanitizers see best. With the arguments "--seeds FOLDER" fuzz_ready() writes the seeds there and ends the program. */
void fuzz_begin(int count, char **arguments);
void fuzz_ready(void);

/* Ends the program with a line that says what does not hold. */
#define HOLDS(condition) ((condition) ? (void)0 : fuzz_stop(#condition, __FILE__, __LINE__))
_Noreturn void fuzz_stop(const char *what, const char *file, int line);

/* Whether an input is one of `of` that pays for what takes long; the same for the same bytes. */
bool fuzz_chance(const uint8_t *data, size_t size, uint32_t of);

/* Bytes of an input, taken from its beginning; zeros once it is used up. */
typedef struct Bytes {
    const uint8_t *data;
    size_t left;
} Bytes;

void bytes_take(Bytes *bytes, void *to, size_t size);
uint8_t bytes_u8(Bytes *bytes);
uint32_t bytes_u32(Bytes *bytes);

/* ---- Worlds ---- */

enum { FUZZ_CAPACITY = 64 };

/* What is in a world of these. */
typedef struct FuzzIds {
    pbmpm_material_id material;
    pbmpm_collider_id collider[2]; /* a kinematic ball, and the baked solid */
    pbmpm_baked_id baked;
    pbmpm_emitter_id emitter;
    pbmpm_drain_id drain;
    pbmpm_force_id force;
} FuzzIds;

/* A small world with one of everything: all materials, obstacles (one of them baked), an emitter, a drain, a force. */
pbmpm_world_id fuzz_world(int dimension, FuzzIds *ids);
/* The same; all solvers have run, and matter may sleep. */
pbmpm_world_id fuzz_used_world(int dimension);

/* A small solid, baked; the caller frees it. `form`: 0 a triangle or tetrahedron, 1 a hull, 2 heights. */
void *fuzz_solid(int dimension, int form, uint64_t *bytes);

#endif
