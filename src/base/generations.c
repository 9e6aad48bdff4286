#include "base/generations.h"

#include <stdatomic.h>

static atomic_uint last_generation, last_particle_generation;

static uint32_t next_of(atomic_uint *last)
{
    const uint32_t generation = atomic_fetch_add(last, 1) + 1;
    return generation ? generation : next_of(last);
}

uint32_t generation_next(void) { return next_of(&last_generation); }

uint32_t generation_next_of_particles(void) { return next_of(&last_particle_generation); }

bool generation_was_given(uint32_t generation) { return generation != 0 && generation <= atomic_load(&last_generation); }

bool generation_was_given_to_particles(uint32_t generation) { return generation != 0 && generation <= atomic_load(&last_particle_generation); }

void generation_skip_of_particles(uint32_t last)
{
    unsigned seen = atomic_load(&last_particle_generation);
    while (seen < last && !atomic_compare_exchange_weak(&last_particle_generation, &seen, last)) continue;
}
