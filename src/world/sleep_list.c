#include "world/sleep_list.h"

#include <string.h>

#include "grid/grid.h"

/* At most half full. */
static uint32_t slots_for(uint32_t blocks)
{
    uint32_t slots = 64;
    while (slots < 2 * blocks) slots *= 2;
    return slots;
}

bool sleep_list_reserve(SleepList *list, Memory *memory, uint32_t blocks)
{
    const bool room = array_grow(memory, &list->block, blocks, sizeof(SleepBlock), list->count * sizeof(SleepBlock));
    const size_t before = list->slot.bytes;
    if (!room || !array_reserve(memory, &list->slot, slots_for(blocks), sizeof(uint32_t))) return false;
    if (list->slot.bytes != before) sleep_list_index(list); /* the table was lost when it grew */
    return true;
}

static uint32_t *slot_of(const SleepList *list, const int32_t place[3])
{
    uint32_t *slots = list->slot.data;
    for (uint32_t i = (uint32_t)grid_hash(place) & list->mask;; i = (i + 1) & list->mask) {
        if (slots[i] == 0) return &slots[i];
        const int32_t *other = sleep_list_block(list, slots[i] - 1)->place;
        if (other[0] == place[0] && other[1] == place[1] && other[2] == place[2]) return &slots[i];
    }
}

void sleep_list_index(SleepList *list)
{
    const uint32_t slots = slots_for(list->count);
    list->mask = slots - 1;
    if (list->slot.bytes) memset(list->slot.data, 0, slots * sizeof(uint32_t));
    for (uint32_t i = 0; i < list->count; i++) *slot_of(list, sleep_list_block(list, i)->place) = i + 1;
}

SleepBlock *sleep_list_find(const SleepList *list, const int32_t place[3])
{
    if (list->count == 0) return NULL;
    const uint32_t slot = *slot_of(list, place);
    return slot ? sleep_list_block(list, slot - 1) : NULL;
}

/* Until the next substep blocks only go from one list to the other. Each time that some are taken out the pieces become at most one more, and
 * there is one block less to take out. */
static size_t most_pieces(uint32_t blocks, uint32_t pieces) { return 2 * ((size_t)pieces + 2 * (size_t)blocks) + 4; }

bool sleep_reserve(Sleep *sleep, Memory *memory, uint32_t blocks, uint32_t pieces)
{
    const size_t most = most_pieces(blocks, pieces);
    return sleep_list_reserve(&sleep->asleep, memory, blocks) && sleep_list_reserve(&sleep->active, memory, blocks) &&
           array_grow(memory, &sleep->piece, most, sizeof(SleepPiece), sleep->pieces * sizeof(SleepPiece)) &&
           array_reserve(memory, &sleep->piece_scratch, most, sizeof(SleepPiece));
}

bool sleep_renew(Sleep *sleep, Memory *memory, uint32_t blocks, uint32_t pieces)
{
    Sleep other = {0};
    Array *const mine[] = {&sleep->asleep.block, &sleep->asleep.slot, &sleep->active.block, &sleep->active.slot, &sleep->piece, &sleep->piece_scratch};
    Array *const room[] = {&other.asleep.block, &other.asleep.slot, &other.active.block, &other.active.slot, &other.piece, &other.piece_scratch};
    bool enough = true;
    const size_t most = most_pieces(blocks, pieces) * sizeof(SleepPiece), slots = slots_for(blocks) * sizeof(uint32_t);
    const size_t needed[] = {blocks * sizeof(SleepBlock), slots, blocks * sizeof(SleepBlock), slots, most, most};
    for (int i = 0; i < 6; i++) enough = enough && mine[i]->bytes >= needed[i];
    if (enough) return true;
    if (!sleep_reserve(&other, memory, blocks, pieces)) {
        sleep_free(&other, memory);
        return false;
    }
    sleep_end(sleep);
    for (int i = 0; i < 6; i++) {
        array_free(memory, mine[i]);
        *mine[i] = *room[i];
    }
    return true;
}

void sleep_free(Sleep *sleep, Memory *memory)
{
    Array *arrays[] = {&sleep->asleep.block,  &sleep->asleep.slot, &sleep->active.block, &sleep->active.slot, &sleep->piece, &sleep->piece_scratch,
                       &sleep->next,          &sleep->loud,        &sleep->pressure,     &sleep->drift,       &sleep->held};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(memory, arrays[i]);
    *sleep = (Sleep){0};
}

void sleep_end(Sleep *sleep)
{
    sleep->on = sleep->stirred = sleep->phased = sleep->holds = false;
    sleep->rows = sleep->pieces = sleep->still_rows = sleep->still_blocks = sleep->woken_blocks = sleep->asleep.count = sleep->active.count = 0;
}

void sleep_place(const Sleep *sleep, const int32_t cell[3], int dimension, int32_t place[3])
{
    place[2] = 0;
    for (int a = 0; a < dimension; a++) {
        const int32_t from = cell[a] - sleep->phase[a];
        place[a] = (from - (from & (K_BLOCK_AXIS - 1))) / K_BLOCK_AXIS;
    }
}
