#include "contact/obstacle_cache.h"

#include <math.h>
#include <string.h>

#include "base/result.h"
#include "contact/walls.h"

typedef struct Stood {
    Solid solid;
    bool moves;
} Stood;

void obstacle_cache_free(ObstacleCache *cache, Memory *memory)
{
    Array *arrays[] = {&cache->stood, &cache->changed, &cache->coordinate, &cache->table,  &cache->from,
                       &cache->gap,   &cache->open,    &cache->marked,     &cache->begin, &cache->bound};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(memory, arrays[i]);
    obstacle_cache_forget(cache);
}

void obstacle_cache_forget(ObstacleCache *cache) { cache->blocks = 0; }

/* ---- What changed ---- */

static bool same_solid(const Solid *a, const Solid *b)
{
    return a->kind == b->kind && a->grid == b->grid && memcmp(&a->radius, &b->radius, sizeof a->radius) == 0 &&
           memcmp(a->position, b->position, sizeof a->position) == 0 && memcmp(a->rotation, b->rotation, sizeof a->rotation) == 0 && memcmp(a->half_extents, b->half_extents, sizeof a->half_extents) == 0 &&
           memcmp(a->normal, b->normal, sizeof a->normal) == 0;
}

/* Obstacles are compared place by place: where one is gone, all behind it changed. */
static bool find_changes(ObstacleCache *cache, const Colliders *colliders, Memory *memory)
{
    const int now = colliders->obstacle_count, before = cache->obstacles, most = now > before ? now : before;
    if (!array_reserve(memory, &cache->changed, 2 * (size_t)most, sizeof(Solid))) return false;
    const Stood *stood = cache->stood.data;
    Solid *changed = cache->changed.data;
    cache->changes = 0;
    for (int i = 0; i < most; i++) {
        const Obstacle *o = &colliders->obstacle[i];
        if (i < now && i < before && o->moves == stood[i].moves && same_solid(&o->start, &stood[i].solid)) continue;
        if (i < now) changed[cache->changes++] = o->start;
        if (i < before) changed[cache->changes++] = stood[i].solid;
    }
    return true;
}

static bool is_near_change(const ObstacleCache *cache, const ContactFrame *frame, int32_t block)
{
    const double reach = (0.5 * (K_BLOCK_AXIS - 1) * sqrt((double)frame->grid->dimension) + OBSTACLE_CACHE_REACH) * frame->cell_size;
    double centre[3];
    contacts_block_centre(frame, block, centre);
    for (int i = 0; i < cache->changes; i++)
        if (solid_least((const Solid *)cache->changed.data + i, centre) <= reach) return true;
    return false;
}

/* ---- Which block stood where ---- */

static uint32_t *slot_of(const ObstacleCache *cache, const int32_t place[3])
{
    const size_t mask = cache->table.bytes / sizeof(uint32_t) - 1;
    const int32_t *coordinate = cache->coordinate.data;
    uint32_t *table = cache->table.data;
    for (size_t slot = (size_t)grid_hash(place) & mask;; slot = (slot + 1) & mask)
        if (table[slot] == 0 || memcmp(coordinate + 3 * (table[slot] - 1), place, 3 * sizeof *place) == 0) return &table[slot];
}

/* Lists the blocks of the last substep in the table, which is at most half full; its size stays a power of two. */
static bool list_blocks(ObstacleCache *cache, Memory *memory)
{
    size_t slots = 64;
    while (slots < 2 * (size_t)cache->blocks) slots *= 2;
    if (slots * sizeof(uint32_t) > cache->table.bytes) {
        uint32_t *table = memory_take(memory, slots * sizeof(uint32_t));
        if (!table) return false;
        array_free(memory, &cache->table);
        cache->table = (Array){table, slots * sizeof(uint32_t)};
    }
    memset(cache->table.data, 0, cache->table.bytes);
    for (int32_t block = 0; block < cache->blocks; block++) *slot_of(cache, (const int32_t *)cache->coordinate.data + 3 * block) = (uint32_t)block + 1;
    return true;
}

/* Blocks are counted from the anchor. Where it moves by less than a block they are cut differently, and none stands where one stood. */
static bool shift_of(const ObstacleCache *cache, const Grid *grid, int32_t shift[3])
{
    for (int a = 0; a < 3; a++) {
        const int32_t cells = a < grid->dimension ? grid->anchor[a] - cache->anchor[a] : 0;
        if (cells % K_BLOCK_AXIS != 0) return false;
        shift[a] = cells / K_BLOCK_AXIS;
    }
    return true;
}

static bool find_blocks(ObstacleCache *cache, const Grid *grid, const int32_t shift[3], Memory *memory)
{
    int32_t *from = cache->from.data;
    const int32_t *coordinate = grid->coordinate.data;
    if (!list_blocks(cache, memory)) return false;
    for (int32_t block = 0; block < grid->node_blocks; block++) {
        int32_t place[3];
        for (int a = 0; a < 3; a++) place[a] = coordinate[3 * block + a] + shift[a];
        from[block] = (int32_t)*slot_of(cache, place) - 1;
    }
    return true;
}

static pbmpm_result no_memory(ObstacleCache *cache, const ContactFrame *frame)
{
    obstacle_cache_forget(cache);
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory to keep what obstacles are to %d blocks", frame->grid->node_blocks);
}

pbmpm_result obstacle_cache_open(ContactFrame *frame, ObstacleCache *cache, Memory *memory)
{
    const Grid *grid = frame->grid;
    const Colliders *colliders = frame->colliders;
    int32_t shift[3];
    const bool wanted = !frame->groups && colliders->obstacle_count > 0;
    if (!wanted || cache->first != colliders->obstacle || !shift_of(cache, grid, shift)) obstacle_cache_forget(cache);
    if (!wanted) return PBMPM_OK;
    frame->cache = cache;
    if (cache->blocks == 0) return PBMPM_OK;
    if (!array_reserve(memory, &cache->from, (size_t)grid->node_blocks, sizeof(int32_t)) || !find_changes(cache, colliders, memory) ||
        !find_blocks(cache, grid, shift, memory))
        return no_memory(cache, frame);
    int32_t *from = cache->from.data;
    for (int32_t block = 0; block < grid->node_blocks; block++)
        if (is_near_change(cache, frame, block)) from[block] = GRID_NOWHERE;
    return PBMPM_OK;
}

static void swap(Array *a, Array *b)
{
    const Array kept = *a;
    *a = *b;
    *b = kept;
}

pbmpm_result obstacle_cache_keep(const ContactFrame *frame, Walls *walls, int opened, Memory *memory)
{
    ObstacleCache *cache = frame->cache;
    Colliders *colliders = frame->colliders;
    const Grid *grid = frame->grid;
    const size_t blocks = (size_t)grid->node_blocks;
    if (!cache) return PBMPM_OK;
    obstacle_cache_forget(cache);
    if (blocks == 0) return PBMPM_OK; /* spray alone: there is no grid */
    if (!array_reserve(memory, &cache->stood, (size_t)colliders->obstacle_count, sizeof(Stood)) ||
        !array_reserve(memory, &cache->coordinate, 3 * blocks, sizeof(int32_t)) ||
        !array_reserve(memory, &cache->marked, blocks, sizeof(uint64_t)))
        return no_memory(cache, frame);
    for (int i = 0; i < colliders->obstacle_count; i++) ((Stood *)cache->stood.data)[i] = (Stood){colliders->obstacle[i].start, colliders->obstacle[i].moves};
    memcpy(cache->coordinate.data, grid->coordinate.data, 3 * blocks * sizeof(int32_t));
    memcpy(cache->anchor, grid->anchor, sizeof cache->anchor);
    swap(&cache->gap, &colliders->gap);
    if (opened) swap(&cache->open, &colliders->open);
    if (walls) {
        memcpy(cache->marked.data, walls->marked.data, blocks * sizeof(uint64_t)); /* others still ask for it */
        swap(&cache->begin, &walls->begin);
        swap(&cache->bound, &walls->bound);
    }
    cache->walled = walls != NULL;
    cache->opened = opened;
    cache->first = colliders->obstacle;
    cache->obstacles = colliders->obstacle_count;
    cache->blocks = grid->node_blocks;
    return PBMPM_OK;
}
