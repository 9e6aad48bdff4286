/* What the files of exported functions share: checking arguments, holding a world for the length of a call, refusing. */
#ifndef PBMPM_SRC_API_CALL_H
#define PBMPM_SRC_API_CALL_H

#include "result.h"
#include "world.h"

#define REQUIRE(pointer)                                                                                                \
    if (!(pointer)) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "%s: " #pointer " is null", __func__)

#define REQUIRE_SIZE(structure)                                                                                         \
    REQUIRE(structure);                                                                                                 \
    if ((structure)->size != sizeof *(structure))                                                                       \
        return fail(PBMPM_ERROR_UNSUPPORTED, "%s: the size in " #structure " is not known to this version", __func__)

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
