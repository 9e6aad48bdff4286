/* What the files of exported functions share: checking arguments, holding a world for the length of a call, refusing. */
#ifndef PBMPM_SRC_API_CALL_H
#define PBMPM_SRC_API_CALL_H

#include "result.h"
#include "world.h"

#define REQUIRE(pointer)                                                                                                \
    if (!(pointer)) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "%s: " #pointer " is null", __func__)

/* A structure that the call writes: the caller says how large it is. */
#define REQUIRE_SIZE(structure)                                                                                         \
    REQUIRE(structure);                                                                                                 \
    if ((structure)->size != sizeof *(structure))                                                                       \
        return api_unknown_size(__func__, #structure, "set it to its sizeof", (structure)->size, sizeof *(structure))

/* One that it reads: it was filled by a function of its own. */
#define REQUIRE_FILLED(structure, init)                                                                                 \
    REQUIRE(structure);                                                                                                 \
    if ((structure)->size != sizeof *(structure))                                                                       \
        return api_unknown_size(__func__, #structure, "fill it by " #init "()", (structure)->size, sizeof *(structure))

/* Refuses a structure; `remedy` says what was probably forgotten. */
pbmpm_result api_unknown_size(const char *call, const char *structure, const char *remedy, uint32_t size, size_t known);

/* A world that a call holds, in the floating-point mode of the kernels. */
typedef struct Hold {
    pbmpm_world_id id;
    World *world;
    uint32_t float_mode;
} Hold;

pbmpm_result api_hold(pbmpm_world_id id, Hold *held);
pbmpm_result api_let_go(const Hold *held, pbmpm_result result);

#define HOLD(id)                                                                                                        \
    Hold held;                                                                                                          \
    const pbmpm_result hold_result = api_hold(id, &held);                                                               \
    if (hold_result != PBMPM_OK) return hold_result;                                                                    \
    World *w = held.world

/* The same for the few calls that a world takes while a step runs in the background. */
pbmpm_result api_hold_stepping(pbmpm_world_id id, Hold *held);

#define HOLD_STEPPING(id)                                                                                               \
    Hold held;                                                                                                          \
    const pbmpm_result hold_result = api_hold_stepping(id, &held);                                                      \
    if (hold_result != PBMPM_OK) return hold_result;                                                                    \
    World *w = held.world

#define LET_GO(result) return api_let_go(&held, result)

/* Writes the defaults of a structure whose first member is its size. */
pbmpm_result api_init_structure(void *structure, size_t size, const void *defaults, size_t known);

#define INIT(structure, size, defaults)                                                                                 \
    return api_init_structure(structure, size, &(defaults), sizeof(defaults))

/* Null if a step of this length is allowed, else what is wrong. */
const char *api_step_problem(const World *world, float dt);

pbmpm_result api_invalid(const char *problem);

#endif
