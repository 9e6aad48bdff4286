/* A step on a thread of its own or as a task of the host, and the copy of the particles that can be viewed meanwhile. */
#ifndef PBMPM_SRC_SERVICES_BACKGROUND_H
#define PBMPM_SRC_SERVICES_BACKGROUND_H

#include "world/world.h"

/* Null if the list is valid, else what is wrong. */
const char *background_fields_problem(const pbmpm_field *fields, uint32_t count);

pbmpm_result background_publish(World *world, const pbmpm_field *fields, uint32_t count);

/* Whether a step was begun and not ended; if so, only the functions below may be called. */
bool background_is_stepping(const World *world);

/* `dt` is valid. */
pbmpm_result background_begin(World *world, float dt);
pbmpm_result background_end(World *world, bool wait);
pbmpm_result background_done(World *world, int32_t *done);

/* Of the state that the step began with. */
pbmpm_result background_view(World *world, pbmpm_field field, pbmpm_view *view);
uint32_t background_count(const World *world);
const pbmpm_stats *background_step_stats(const World *world);
/* How long the step lasted that made this state; 0: there was none. */
float background_seconds(const World *world);
uint64_t background_generation(const World *world);

/* Waits for the step and ends the thread. Nothing may be begun after. After a fork (`here` false) there is none. */
void background_stop(World *world, bool here);
void background_free(World *world);

#endif
