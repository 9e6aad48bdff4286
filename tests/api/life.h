/* The life of a world in which every exported function is called: for tests that ask what becomes of each call. */
#ifndef PBMPM_TESTS_API_LIFE_H
#define PBMPM_TESTS_API_LIFE_H

#include "scenes.h"

typedef struct life_plan {
    const char *name;
    int32_t dimension;
    pbmpm_solver solver;
    pbmpm_integrator integrator;
    pbmpm_pressure pressure;
    bool sleeping;
    bool together; /**< all matter is one island, and none comes or goes */
    int32_t thread_count;
} life_plan;

/** What the test does about a call that was made. */
typedef enum life_turn {
    LIFE_GOES_ON,
    LIFE_TRIES_AGAIN,
    LIFE_ENDS
} life_turn;

/** Told before each call, with its text: "pbmpm_world_step(it->world, DT)". The world is null before it is created. */
typedef void life_before(const char *call, pbmpm_world_id world, void *user);
/** Told after it. A value that is no result counts as PBMPM_OK. */
typedef life_turn life_after(pbmpm_result result, pbmpm_world_id world, void *user);

typedef struct life_watch {
    life_before *before;
    life_after *after;
    void *user;
} life_watch;

typedef struct life {
    pbmpm_world_id world, twin; /**< that are left; null: none */
    uint64_t hash;              /**< of the world at its end */
    pbmpm_flow flow;            /**< what came and went until then */
} life;

/** Lives until the end, or until the watch ends it; returns whether it was the end. The worlds are left. */
bool live(const life_plan *plan, const pbmpm_allocator *allocator, const life_watch *watch, life *it);

#endif
