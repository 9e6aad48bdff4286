/* What obstacles are to the nodes of the grid, from one substep to the next.
 *
 * Distances, faces and open shares at nodes are a matter of obstacles alone, and were most of what finding contacts took. A block that stands where one stood in
 * the last substep, with nothing near that changed, takes them over, bit for bit what would be found anew: what is near is asked once for a block, so its
 * place counts and not that of its nodes. What changed is found by comparison, and nobody has to tell. Groups of islands have grids of their own, so each set of
 * kinds has a cache of its own. Where an obstacle acts on some matter alone nothing is kept. */
#ifndef PBMPM_SRC_CONTACT_OBSTACLE_CACHE_H
#define PBMPM_SRC_CONTACT_OBSTACLE_CACHE_H

#include "contact/contacts.h"

struct Walls;

/* How far beyond the nodes of a block [cells] obstacles may matter to what is kept: planes at 2.5 from the reflection of a node, which is at most 1.5 behind it and
 * as far before. */
static const double OBSTACLE_CACHE_REACH = 5.5;

typedef struct ObstacleCache {
    int32_t anchor[3], blocks; /* of the grid of the last substep; no blocks: nothing is kept */
    const Obstacle *first;     /* of its list, which faces point into */
    int obstacles;
    bool walled;               /* `marked`, `begin` and `bound` are kept */
    int opened;                /* how `open` was found, see contacts_open_volume(); 0: it is not kept */
    Array stood;      /* Stood per obstacle */
    Array changed;    /* Solid: where those that changed stand, and where they stood */
    int changes;
    Array coordinate; /* as the grid's */
    Array table;      /* hash table: index of a block + 1, or 0 */
    Array from;       /* int32_t per node block of this substep: the one that it takes over from, or GRID_NOWHERE */
    Array gap, open, marked, begin, bound; /* as those of Colliders and Walls */
} ObstacleCache;

void obstacle_cache_free(ObstacleCache *cache, Memory *memory);
/* Nothing is kept any more. */
void obstacle_cache_forget(ObstacleCache *cache);

/* Finds what is taken over and sets frame->cache; it stays null if nothing is to be kept. */
pbmpm_result obstacle_cache_open(ContactFrame *frame, ObstacleCache *cache, Memory *memory);

/* Keeps what was found for the next substep. `walls` null: there are none. `opened`: as above. */
pbmpm_result obstacle_cache_keep(const ContactFrame *frame, struct Walls *walls, int opened, Memory *memory);

/* The block of the last substep that one takes over from, or GRID_NOWHERE. */
static inline int32_t obstacle_cache_from(const ContactFrame *frame, int32_t block)
{
    return frame->cache && frame->cache->blocks > 0 ? ((const int32_t *)frame->cache->from.data)[block] : GRID_NOWHERE;
}

#endif
