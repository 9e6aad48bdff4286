/* What happened in a step, for the host to poll. */
#ifndef PBMPM_SRC_WORLD_EVENTS_H
#define PBMPM_SRC_WORLD_EVENTS_H

#include "pbmpm/stats.h"

typedef struct Events {
    pbmpm_event list[PBMPM_MAX_EVENTS];
    uint32_t count;
    uint32_t missed; /* happened when the list was full */
} Events;

static inline void events_clear(Events *events) { events->count = events->missed = 0; }

static inline void events_add(Events *events, const pbmpm_event *event)
{
    if (events->count < PBMPM_MAX_EVENTS)
        events->list[events->count++] = *event;
    else
        events->missed++;
}

#endif
