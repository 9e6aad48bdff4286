#include "world/ended.h"

#include "base/generations.h"

void ended_add(Ended *ended, uint32_t generation)
{
    ended->generation[ended->next] = generation;
    ended->next = (ended->next + 1) % ENDED_KEPT;
}

const char *ended_tell(const Ended *ended, uint32_t generation)
{
    if (generation == 0) return "is null";
    for (int i = 0; i < ENDED_KEPT; i++)
        if (ended->generation[i] == generation) return "was destroyed";
    return generation_was_given(generation) ? "is of another world, or was destroyed long ago" : "never existed: its identifier is made up";
}
