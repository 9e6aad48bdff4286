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
    bool woke;
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

/* Substeps in which it crosses a block. */
static float crossing_of(const Waves *waves, uint32_t i)
{
    const World *world = waves->world;
    const uint32_t asleep = world->sleep.asleep.count, *begin = world->grid.block_begin.data;
    if (i < asleep) return block_of(waves, i)->crossing;
    return sleep_crossing(world, begin[i - asleep], begin[i - asleep + 1] - begin[i - asleep]);
}

static void wake(Waves *waves, uint32_t i)
{
    Sleep *sleep = &waves->world->sleep;
    SleepBlock *block = block_of(waves, i);
    block->quiet = 0.0f;
    if (block->stage == SLEEP_AWAKE || block->woken) return;
    block->woken = 1;
    sleep->woken_blocks++;
    waves->woke = true;
}

static void go_on(Waves *waves, uint32_t from, const int32_t there[3])
{
    const Sleep *sleep = &waves->world->sleep;
    const SleepBlock *bed = sleep_list_find(&sleep->asleep, there), *drowsy = bed ? NULL : sleep_list_find(&sleep->active, there);
    if (!bed && !drowsy) return;
    const uint32_t i = bed ? (uint32_t)(bed - sleep_list_block(&sleep->asleep, 0)) : sleep->asleep.count + (uint32_t)(drowsy - sleep_list_block(&sleep->active, 0));
    const float left = waves->left[from] - crossing_of(waves, i);
    if (left < 0.0f || left <= waves->left[i]) return;
    wake(waves, i);
    arrive(waves, i, left);
}

bool sleep_wake_by_waves(World *world)
{
    const Sleep *sleep = &world->sleep;
    const uint32_t asleep = sleep->asleep.count;
    Waves waves = {.world = world, .left = sleep->loud.data, .place = sleep->next.data, .blocks = asleep + sleep->active.count};
    for (uint32_t i = 0; i < waves.blocks; i++) waves.left[i] = -1.0f; /* none has come */
    memset(waves.place, 0, waves.blocks * sizeof *waves.place);
    for (uint32_t b = 0; b < sleep->active.count; b++) {
        SleepBlock *block = sleep_list_block(&sleep->active, b);
        if ((block->woken || block->disturbed) && crossing_of(&waves, asleep + b) < FLT_MAX) arrive(&waves, asleep + b, 1.0f);
        block->disturbed = 0;
    }
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
    return waves.woke;
}
