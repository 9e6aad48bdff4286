/* What the files of exported functions share: checking arguments, holding a world for the length of a call, refusing. */
#ifndef PBMPM_SRC_API_API_CALL_H
#define PBMPM_SRC_API_API_CALL_H

#include "base/result.h"
#include "base/sized.h"
#include "world/world.h"

#define REQUIRE(pointer)                                                                                                \
    if (!(pointer)) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "%s: " #pointer " is null", __func__)

/* A public structure that the call reads: `own` is a copy of this version's, and members that the caller's version lacks are those of
 * `base`. */
#define READ(type, own, given, base)                                                                                    \
    type own = (base);                                                                                                  \
    do {                                                                                                                \
        const pbmpm_result read_result = sized_read(SIZED_##type, __func__, #given, given, &own);                       \
        if (read_result != PBMPM_OK) return read_result;                                                                \
    } while (0)

/* The same while a world is held. */
#define READ_HELD(type, own, given, base)                                                                               \
    type own = (base);                                                                                                  \
    do {                                                                                                                \
        const pbmpm_result read_result = sized_read(SIZED_##type, __func__, #given, given, &own);                       \
        if (read_result != PBMPM_OK) LET_GO(read_result);                                                               \
    } while (0)

/* ... that may be null: then all is as in `base`. */
#define READ_OR_DEFAULT(type, own, given, base)                                                                         \
    type own = (base);                                                                                                  \
    do {                                                                                                                \
        const pbmpm_result read_result = (given) ? sized_read(SIZED_##type, __func__, #given, given, &own) : PBMPM_OK;  \
        if (read_result != PBMPM_OK) return read_result;                                                                \
    } while (0)

/* ... while a world is held. */
#define READ_OR_KEEP(type, own, given, base)                                                                            \
    type own = (base);                                                                                                  \
    do {                                                                                                                \
        const pbmpm_result read_result = (given) ? sized_read(SIZED_##type, __func__, #given, given, &own) : PBMPM_OK;  \
        if (read_result != PBMPM_OK) LET_GO(read_result);                                                               \
    } while (0)

/* One that the call writes: the caller says how large it is. */
#define REQUIRE_SIZE(type, given)                                                                                       \
    do {                                                                                                                \
        const pbmpm_result size_result = sized_check(SIZED_##type, __func__, #given, given);                            \
        if (size_result != PBMPM_OK) return size_result;                                                                \
    } while (0)

#define WRITE(type, given, own) sized_write(SIZED_##type, given, (given)->size, own)

/* A world that a call holds, in the floating-point mode of the kernels. */
typedef struct Hold {
    pbmpm_world_id id;
    World *world;
    uint32_t float_mode;
} Hold;

/* How a call holds a world. */
typedef enum HoldKind {
    HOLD_ALONE = 0,
    HOLD_TO_READ = 1,      /* with others that read: the call changes nothing but what readers.h makes */
    HOLD_WHILE_STEPPING = 2 /* also while a step runs in the background */
} HoldKind;

pbmpm_result api_hold(pbmpm_world_id id, int kind, Hold *held);
pbmpm_result api_let_go(const Hold *held, pbmpm_result result);

#define HOLD_AS(id, kind)                                                                                               \
    Hold held;                                                                                                          \
    const pbmpm_result hold_result = api_hold(id, kind, &held);                                                         \
    if (hold_result != PBMPM_OK) return hold_result;                                                                    \
    World *w = held.world

#define HOLD(id) HOLD_AS(id, HOLD_ALONE)
#define HOLD_READING(id) HOLD_AS(id, HOLD_TO_READ)
#define HOLD_STEPPING(id) HOLD_AS(id, HOLD_WHILE_STEPPING)
#define HOLD_READING_STEPPING(id) HOLD_AS(id, HOLD_TO_READ | HOLD_WHILE_STEPPING)

#define LET_GO(result) return api_let_go(&held, result)

#define INIT(type, given, size, defaults)                                                                                \
    const type own = (defaults);                                                                                        \
    return sized_init(SIZED_##type, __func__, given, size, &own)

/* Null if a step of this length is allowed, else what is wrong. */
const char *api_step_problem(const World *world, float dt);

pbmpm_result api_invalid(const char *problem);
/* Refuses the identifier of something that is not there. `what`: "this collider". */
pbmpm_result api_gone(const World *world, const char *what, uint32_t generation);

#endif
