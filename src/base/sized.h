/* Public structures of any version since 0.2: a caller and the library may each know members that the other does not. docs/abi.md says
 * what is promised. */
#ifndef PBMPM_SRC_BASE_SIZED_H
#define PBMPM_SRC_BASE_SIZED_H

#include <stddef.h>
#include <stdint.h>

#include "pbmpm/pbmpm.h"

#ifndef PBMPM_SIZED_TABLE
#define PBMPM_SIZED_TABLE "base/sized_table.inc" /* a test of the ABI has one of its own */
#endif

/* SIZED_pbmpm_settings and so on: the structures that begin with their size. */
enum {
#define PBMPM_SIZED(structure, ...) SIZED_##structure,
#include PBMPM_SIZED_TABLE
#undef PBMPM_SIZED
    SIZED_COUNT
};

/* No structure is ever larger [bytes]: a size beyond is a member that nobody set. */
enum { SIZED_MAX = 4096 };

/* Both refuse a size that no version had; one that is larger than this version's is a later one's. `call` and `name` are for the message. */

/* Reads the caller's structure into `own`, which has this version's size and the values of members that the caller's version lacks. What a
 * later version added must be 0. */
pbmpm_result sized_read(int type, const char *call, const char *name, const void *given, void *own);

/* Whether `given` is a structure that can be written. */
pbmpm_result sized_check(int type, const char *call, const char *name, const void *given);

/* Writes as much of `own` as the caller's structure of `size` bytes has room for; what a later version added becomes 0. */
void sized_write(int type, void *given, uint32_t size, const void *own);

/* The same for element `index` of an array whose first element says the size of all. */
void sized_put(int type, void *array, uint32_t index, const void *own);

/* Writes defaults into a structure of `size` bytes. */
pbmpm_result sized_init(int type, const char *call, void *given, size_t size, const void *defaults);

#endif
