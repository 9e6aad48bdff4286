#include "contact/sight.h"

#include <math.h>
#include <string.h>

#include "base/result.h"
#include "contact/walls.h"

typedef struct Stood {
    Solid solid;
    bool moves;
} Stood;

void sight_free(Sight *sight, Memory *memory)
{
    Array *arrays[] = {&sight->stood, &sight->changed, &sight->coordinate, &sight->table,  &sight->from,
                       &sight->gap,   &sight->open,    &sight->marked,     &sight->begin, &sight->bound};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(memory, arrays[i]);
    sight_forget(sight);
}

void sight_forget(Sight *sight) { sight->blocks = 0; }

/* ---- What changed ---- */

static bool same_solid(const Solid *a, const Solid *b)
{
    return a->kind == b->kind && a->grid == b->grid && memcmp(&a->radius, &b->radius, sizeof a->radius) == 0 &&
           memcmp(a->position, b->position, sizeof a->position) == 0 && memcmp(a->rotation, b->rotation, sizeof a->rotation) == 0 && memcmp(a->half_extents, b->half_extents, sizeof a->half_extents) == 0 &&
           memcmp(a->normal, b->normal, sizeof a->normal) == 0;
}

/* Obstacles are compared place by place: where one is gone, all behind it changed. */
static bool find_changes(Sight *sight, const Colliders *colliders, Memory *memory)
{
    const int now = colliders->obstacle_count, before = sight->obstacles, most = now > before ? now : before;
    if (!array_reserve(memory, &sight->changed, 2 * (size_t)most, sizeof(Solid))) return false;
    const Stood *stood = sight->stood.data;
    Solid *changed = sight->changed.data;
    sight->changes = 0;
    for (int i = 0; i < most; i++) {
        const Obstacle *o = &colliders->obstacle[i];
        if (i < now && i < before && o->moves == stood[i].moves && same_solid(&o->start, &stood[i].solid)) continue;
        if (i < now) changed[sight->changes++] = o->start;
        if (i < before) changed[sight->changes++] = stood[i].solid;
    }
    return true;
}

static bool is_near_change(const Sight *sight, const ContactFrame *frame, int32_t block)
{
    const double reach = (0.5 * (K_BLOCK_AXIS - 1) * sqrt((double)frame->grid->dimension) + SIGHT_REACH) * frame->cell_size;
    double centre[3];
    contacts_block_centre(frame, block, centre);
    for (int i = 0; i < sight->changes; i++)
        if (solid_least((const Solid *)sight->changed.data + i, centre) <= reach) return true;
    return false;
}

/* ---- Which block stood where ---- */

static uint32_t *slot_of(const Sight *sight, const int32_t place[3])
{
    const size_t mask = sight->table.bytes / sizeof(uint32_t) - 1;
    const int32_t *coordinate = sight->coordinate.data;
    uint32_t *table = sight->table.data;
    for (size_t slot = (size_t)grid_hash(place) & mask;; slot = (slot + 1) & mask)
        if (table[slot] == 0 || memcmp(coordinate + 3 * (table[slot] - 1), place, 3 * sizeof *place) == 0) return &table[slot];
}

/* Lists the blocks of the last substep in the table, which is at most half full; its size stays a power of two. */
static bool list_blocks(Sight *sight, Memory *memory)
{
    size_t slots = 64;
    while (slots < 2 * (size_t)sight->blocks) slots *= 2;
    if (slots * sizeof(uint32_t) > sight->table.bytes) {
        uint32_t *table = memory_take(memory, slots * sizeof(uint32_t));
        if (!table) return false;
        array_free(memory, &sight->table);
        sight->table = (Array){table, slots * sizeof(uint32_t)};
    }
    memset(sight->table.data, 0, sight->table.bytes);
    for (int32_t block = 0; block < sight->blocks; block++) *slot_of(sight, (const int32_t *)sight->coordinate.data + 3 * block) = (uint32_t)block + 1;
    return true;
}

/* Blocks are counted from the anchor. Where it moves by less than a block they are cut differently, and none stands where one stood. */
static bool shift_of(const Sight *sight, const Grid *grid, int32_t shift[3])
{
    for (int a = 0; a < 3; a++) {
        const int32_t cells = a < grid->dimension ? grid->anchor[a] - sight->anchor[a] : 0;
        if (cells % K_BLOCK_AXIS != 0) return false;
        shift[a] = cells / K_BLOCK_AXIS;
    }
    return true;
}

static bool find_blocks(Sight *sight, const Grid *grid, const int32_t shift[3], Memory *memory)
{
    int32_t *from = sight->from.data;
    const int32_t *coordinate = grid->coordinate.data;
    if (!list_blocks(sight, memory)) return false;
    for (int32_t block = 0; block < grid->node_blocks; block++) {
        int32_t place[3];
        for (int a = 0; a < 3; a++) place[a] = coordinate[3 * block + a] + shift[a];
        from[block] = (int32_t)*slot_of(sight, place) - 1;
    }
    return true;
}

static pbmpm_result no_memory(Sight *sight, const ContactFrame *frame)
{
    sight_forget(sight);
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory to keep what obstacles are to %d blocks", frame->grid->node_blocks);
}

pbmpm_result sight_open(ContactFrame *frame, Sight *sight, Memory *memory)
{
    const Grid *grid = frame->grid;
    const Colliders *colliders = frame->colliders;
    int32_t shift[3];
    const bool wanted = !frame->groups && colliders->obstacle_count > 0;
    if (!wanted || sight->first != colliders->obstacle || !shift_of(sight, grid, shift)) sight_forget(sight);
    if (!wanted) return PBMPM_OK;
    frame->sight = sight;
    if (sight->blocks == 0) return PBMPM_OK;
    if (!array_reserve(memory, &sight->from, (size_t)grid->node_blocks, sizeof(int32_t)) || !find_changes(sight, colliders, memory) ||
        !find_blocks(sight, grid, shift, memory))
        return no_memory(sight, frame);
    int32_t *from = sight->from.data;
    for (int32_t block = 0; block < grid->node_blocks; block++)
        if (is_near_change(sight, frame, block)) from[block] = GRID_NOWHERE;
    return PBMPM_OK;
}

static void swap(Array *a, Array *b)
{
    const Array kept = *a;
    *a = *b;
    *b = kept;
}

pbmpm_result sight_keep(const ContactFrame *frame, Walls *walls, int opened, Memory *memory)
{
    Sight *sight = frame->sight;
    Colliders *colliders = frame->colliders;
    const Grid *grid = frame->grid;
    const size_t blocks = (size_t)grid->node_blocks;
    if (!sight) return PBMPM_OK;
    sight_forget(sight);
    if (blocks == 0) return PBMPM_OK; /* spray alone: there is no grid */
    if (!array_reserve(memory, &sight->stood, (size_t)colliders->obstacle_count, sizeof(Stood)) ||
        !array_reserve(memory, &sight->coordinate, 3 * blocks, sizeof(int32_t)) ||
        !array_reserve(memory, &sight->marked, blocks, sizeof(uint64_t)))
        return no_memory(sight, frame);
    for (int i = 0; i < colliders->obstacle_count; i++) ((Stood *)sight->stood.data)[i] = (Stood){colliders->obstacle[i].start, colliders->obstacle[i].moves};
    memcpy(sight->coordinate.data, grid->coordinate.data, 3 * blocks * sizeof(int32_t));
    memcpy(sight->anchor, grid->anchor, sizeof sight->anchor);
    swap(&sight->gap, &colliders->gap);
    if (opened) swap(&sight->open, &colliders->open);
    if (walls) {
        memcpy(sight->marked.data, walls->marked.data, blocks * sizeof(uint64_t)); /* others still ask for it */
        swap(&sight->begin, &walls->begin);
        swap(&sight->bound, &walls->bound);
    }
    sight->walled = walls != NULL;
    sight->opened = opened;
    sight->first = colliders->obstacle;
    sight->obstacles = colliders->obstacle_count;
    sight->blocks = grid->node_blocks;
    return PBMPM_OK;
}
