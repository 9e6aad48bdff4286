/* Reading a world: views, queries, statistics, hash. Nothing here changes the state. */
#ifndef PBMPM_SRC_INSPECT_H
#define PBMPM_SRC_INSPECT_H

#include "world.h"

pbmpm_result inspect_view(World *world, pbmpm_field field, pbmpm_view *view);

/* Rows of particles nearer than `margin` [m] to the inside of the solid, in storage order. */
void inspect_inside(World *world, const Solid *solid, double margin, pbmpm_particle_id *ids, uint32_t capacity, uint32_t *count);

pbmpm_result inspect_stats(World *world, pbmpm_stats *stats);
uint64_t inspect_hash(const World *world);

#endif
