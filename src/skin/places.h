/* Things that are found by the place of their block: an array of them, and a hash table of their places. */
#ifndef PBMPM_SRC_SKIN_PLACES_H
#define PBMPM_SRC_SKIN_PLACES_H

#include <stdint.h>

#include "base/memory.h"

/* Each begins with its place: int32_t[3]. A number stays with a thing until it is dropped. */
typedef struct Places {
    size_t size;           /* of a thing; set by the owner */
    int32_t count;         /* numbers that were given */
    int32_t free, dropped; /* numbers to be given again, and how many; each holds the next one + 1 */
    int32_t slots;
    Array thing, table;
} Places;

static inline void *places_at(const Places *places, int32_t number) { return (char *)places->thing.data + (size_t)number * places->size; }

/* GRID_NOWHERE: there is none. */
int32_t places_find(const Places *places, const int32_t place[3]);
/* The thing at a place; made there, with all else 0, if there is none. GRID_NOWHERE: no memory. */
int32_t places_want(Places *places, Memory *memory, const int32_t place[3]);
void places_drop(Places *places, int32_t number);
/* Drops all; memory stays. */
void places_clear(Places *places);
void places_free(Places *places, Memory *memory);

#endif
