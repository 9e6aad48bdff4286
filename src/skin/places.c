#include "skin/places.h"

#include <string.h>

#include "grid/grid.h"

enum { SLOTS_LEAST = 256 };

static int32_t slot_of(const Places *places, const int32_t place[3])
{
    const int32_t *table = places->table.data;
    const uint64_t mask = (uint64_t)places->slots - 1;
    uint64_t slot = grid_hash(place) & mask;
    while (table[slot] && memcmp(places_at(places, table[slot] - 1), place, 3 * sizeof *place) != 0) slot = (slot + 1) & mask;
    return (int32_t)slot;
}

int32_t places_find(const Places *places, const int32_t place[3])
{
    return places->slots ? ((const int32_t *)places->table.data)[slot_of(places, place)] - 1 : GRID_NOWHERE;
}

/* Twice as many slots. */
static bool grow_table(Places *places, Memory *memory)
{
    const Array old = places->table;
    const int32_t slots = places->slots, *number = old.data;
    places->table = (Array){0};
    places->slots = slots ? 2 * slots : SLOTS_LEAST;
    if (!array_reserve(memory, &places->table, (size_t)places->slots, sizeof(int32_t))) {
        places->table = old;
        places->slots = slots;
        return false;
    }
    memset(places->table.data, 0, (size_t)places->slots * sizeof(int32_t));
    for (int32_t s = 0; s < slots; s++)
        if (number[s]) ((int32_t *)places->table.data)[slot_of(places, places_at(places, number[s] - 1))] = number[s];
    Array given = old;
    array_free(memory, &given);
    return true;
}

/* A number that no thing has. */
static int32_t take_number(Places *places, Memory *memory)
{
    if (places->free) {
        const int32_t number = places->free - 1;
        memcpy(&places->free, places_at(places, number), sizeof places->free);
        places->dropped--;
        return number;
    }
    const size_t count = (size_t)places->count;
    if (!array_grow(memory, &places->thing, count + 1, places->size, count * places->size)) return GRID_NOWHERE;
    return places->count++;
}

int32_t places_want(Places *places, Memory *memory, const int32_t place[3])
{
    const int32_t found = places_find(places, place), things = places->count - places->dropped;
    if (found != GRID_NOWHERE) return found;
    if (places->slots < 2 * (things + 1) && !grow_table(places, memory)) return GRID_NOWHERE; /* half of the slots stay free */
    const int32_t number = take_number(places, memory);
    if (number == GRID_NOWHERE) return GRID_NOWHERE;
    memset(places_at(places, number), 0, places->size);
    memcpy(places_at(places, number), place, 3 * sizeof *place);
    ((int32_t *)places->table.data)[slot_of(places, place)] = number + 1;
    return number;
}

/* What stands behind an empty slot and belongs before it moves up, or it would not be found. */
static void close_gap(Places *places, uint64_t gap)
{
    int32_t *table = places->table.data;
    const uint64_t mask = (uint64_t)places->slots - 1;
    for (uint64_t slot = (gap + 1) & mask; table[slot]; slot = (slot + 1) & mask) {
        const uint64_t home = grid_hash(places_at(places, table[slot] - 1)) & mask;
        if (((slot - home) & mask) < ((slot - gap) & mask)) continue;
        table[gap] = table[slot];
        table[slot] = 0;
        gap = slot;
    }
}

void places_drop(Places *places, int32_t number)
{
    const int32_t slot = slot_of(places, places_at(places, number));
    ((int32_t *)places->table.data)[slot] = 0;
    close_gap(places, (uint64_t)slot);
    memset(places_at(places, number), 0, places->size);
    memcpy(places_at(places, number), &places->free, sizeof places->free);
    places->free = number + 1;
    places->dropped++;
}

void places_clear(Places *places)
{
    if (places->slots) memset(places->table.data, 0, (size_t)places->slots * sizeof(int32_t));
    places->count = places->free = places->dropped = 0;
}

void places_free(Places *places, Memory *memory)
{
    array_free(memory, &places->thing);
    array_free(memory, &places->table);
    places->count = places->free = places->dropped = places->slots = 0;
}
