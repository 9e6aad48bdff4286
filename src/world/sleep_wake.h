/* Reasons to wake. Without sleeping they do nothing. */
#ifndef PBMPM_SRC_WORLD_SLEEP_WAKE_H
#define PBMPM_SRC_WORLD_SLEEP_WAKE_H

#include "world/world.h"

void sleep_wake_all(World *world);
void sleep_wake_row(World *world, uint32_t row);
/* What is closer than `reach` cells to a solid. */
void sleep_wake_near(World *world, const Solid *solid, double reach);

/* Wakes what colliders come near to in part `part`. */
void sleep_begin_substep(World *world, int part);

/* How far [cells] a collider, and anything else that comes or goes, is felt. */
extern const double SLEEP_FELT;

/* Whether anything that measures impulses touches the block. */
bool sleep_is_measured(const World *world, const int32_t place[3]);

#endif
