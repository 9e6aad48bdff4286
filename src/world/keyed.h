/* Keys that a host gives to things of its world, so that a snapshot finds them again wherever they stand. */
#ifndef PBMPM_SRC_WORLD_KEYED_H
#define PBMPM_SRC_WORLD_KEYED_H

#include <stdbool.h>
#include <stdint.h>

struct World;

typedef enum KeyedKind { KEYED_MATERIALS, KEYED_COLLIDERS, KEYED_EMITTERS, KEYED_DRAINS, KEYED_FORCES } KeyedKind;

/* Slots that were ever taken are [0, this). */
uint32_t keyed_slots(const struct World *world, KeyedKind kind);

/* The generation of what stands in a slot; 0: nothing does. */
uint32_t keyed_generation(const struct World *world, KeyedKind kind, uint32_t slot);

/* The slot of what has this key, which is not 0; -1: nothing has. */
int32_t keyed_find(const struct World *world, KeyedKind kind, uint64_t key);

/* Null if the thing in `slot` (-1: a new one) may have this key, else what is wrong. */
const char *keyed_problem(const struct World *world, KeyedKind kind, uint64_t key, int32_t slot);

/* "materials" and so on. */
const char *keyed_name(KeyedKind kind);

#endif
