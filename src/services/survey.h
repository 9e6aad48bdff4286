/* A look at where matter lies, for advice: how deep, how thick, how crowded. Made on request; nothing here is kept. */
#ifndef PBMPM_SRC_SERVICES_SURVEY_H
#define PBMPM_SRC_SERVICES_SURVEY_H

#include "services/survey_heap.h"
#include "world/world.h"

/* Along which gravity pulls most; -1 without gravity. */
int survey_axis_of_gravity(const World *world);

/* Needs some bytes per particle, which it gives back. */
pbmpm_result survey_make(World *world, Survey *survey);

#endif
