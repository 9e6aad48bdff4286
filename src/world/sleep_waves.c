#include "world/sleep_waves.h"

#include <float.h>
#include <string.h>

#include "world/sleep_rows.h"

/* Of each block, those that are asleep first, then those of the grid: how much of the substep is left when the first wave comes to it. Waves that come later
 * by one way than by another are put right, so the order does not matter. */
typedef struct Waves {
    World *world;
    float *left;
    struct Place {
        uint32_t block;
        uint32_t waits;
    } *place; /* a ring of those whose neighbours are to be told, and per block whether it is in there */
    uint32_t blocks, begin, waiting;
} Waves;

static SleepBlock *block_of(const Waves *waves, uint32_t i)
{
    const Sleep *sleep = &waves->world->sleep;
    return i < sleep->asleep.count ? sleep_list_block(&sleep->asleep, i) : sleep_list_block(&sleep->active, i - sleep->asleep.count);
}

static void arrive(Waves *waves, uint32_t i, float left)
{
    waves->left[i] = left;
    if (waves->place[i].waits) return;
    waves->place[i].waits = 1;
    waves->place[(waves->begin + waves->waiting++) % waves->blocks].block = i;
}

/* Substeps in which it crosses a block; blocks that are awake know already. */
static float crossing_of(const Waves *waves, uint32_t i)
{
    const World *world = waves->world;
    const uint32_t asleep = world->sleep.asleep.count;
    if (i < asleep) return block_of(waves, i)->crossing;
    const uint32_t *begin = world->grid.block_begin.data, b = i - asleep;
    return b < (uint32_t)world->grid.still_blocks ? sleep_crossing(world, begin[b], begin[b + 1] - begin[b]) : FLT_MAX;
}

static void wake(Waves *waves, uint32_t i)
{
    Sleep *sleep = &waves->world->sleep;
    SleepBlock *block = block_of(waves, i);
    if (block->woken) return;
    block->woken = 1;
    sleep->woken_blocks++;
}

static void go_on(Waves *waves, uint32_t from, const int32_t there[3])
{
    const Sleep *sleep = &waves->world->sleep;
    const SleepBlock *bed = sleep_list_find(&sleep->asleep, there), *drowsy = bed ? NULL : sleep_list_find(&sleep->active, there);
    if (!bed && !drowsy) return;
    const uint32_t i = bed ? (uint32_t)(bed - sleep_list_block(&sleep->asleep, 0)) : sleep->asleep.count + (uint32_t)(drowsy - sleep_list_block(&sleep->active, 0));
    const float left = waves->left[from] - crossing_of(waves, i);
    if (left < 0.0f || (block_of(waves, i)->woken && left <= waves->left[i])) return;
    wake(waves, i);
    arrive(waves, i, left);
}

void sleep_wake_by_waves(World *world)
{
    const Sleep *sleep = &world->sleep;
    const uint32_t asleep = sleep->asleep.count;
    Waves waves = {.world = world, .left = sleep->loud.data, .place = sleep->next.data, .blocks = asleep + sleep->active.count};
    memset(waves.left, 0, waves.blocks * sizeof *waves.left);
    memset(waves.place, 0, waves.blocks * sizeof *waves.place);
    for (uint32_t b = 0; b < (uint32_t)world->grid.still_blocks; b++)
        if (sleep_list_block(&sleep->active, b)->woken) arrive(&waves, asleep + b, 1.0f);
    while (waves.waiting > 0) {
        const uint32_t from = waves.place[waves.begin].block;
        waves.place[from].waits = 0;
        waves.begin = (waves.begin + 1) % waves.blocks;
        waves.waiting--;
        for (int n = 0; n < world->grid.neighbours; n++) {
            int32_t there[3];
            grid_neighbour_offset(n, world->def.dimension, there);
            for (int a = 0; a < 3; a++) there[a] += block_of(&waves, from)->place[a];
            go_on(&waves, from, there);
        }
    }
}
