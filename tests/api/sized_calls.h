/* Which calls take which structures that begin with their size, as tables: for tests that hold for all of them. */
#ifndef PBMPM_TESTS_API_SIZED_CALLS_H
#define PBMPM_TESTS_API_SIZED_CALLS_H

#include "calls.h"

/** What all rows are called with. Set anew for each test. */
extern target world;

/** Writes the defaults. */
typedef struct sized_init {
    const char *structure, *call;
    size_t size; /**< of the structure */
    pbmpm_result (*make)(void *structure, size_t size);
} sized_init;

/** A structure that a call reads. */
typedef struct sized_input {
    const char *structure, *call;
    size_t size;
    /** Fills a structure of this version with sound values that are not all defaults. */
    void (*fill)(void *structure);
    /** Makes the call. `outcome` becomes what is read back, a structure of the same type whose size is set, or a uint64_t (0 before) that says
     *  what came of the call. */
    pbmpm_result (*make)(const void *structure, void *outcome);
    bool reads_back;
} sized_input;

/** A structure that a call writes. */
typedef struct sized_output {
    const char *structure, *call;
    size_t size;
    pbmpm_result (*make)(void *structure);
} sized_output;

/** An array of structures that a call writes. */
typedef struct sized_array {
    const char *structure, *call;
    size_t size;
    pbmpm_result (*make)(void *array, uint32_t capacity, uint32_t *count);
} sized_array;

extern const sized_init sized_inits[];
extern const sized_input sized_inputs[];
extern const sized_output sized_outputs[];
extern const sized_array sized_arrays[];
extern const int sized_init_count, sized_input_count, sized_output_count, sized_array_count;

/** Gives the world something for each array: 3 to 8 elements. */
void make_arrays_busy(void);

#endif
