/* The exported functions that tell what there is: whether something exists, lists, lines to draw. */
#include "api/api_call.h"
#include "services/debug_lines.h"
#include "services/registry.h"
#include "world/keyed.h"

pbmpm_result pbmpm_world_is_valid(pbmpm_world_id world, int32_t *valid)
{
    REQUIRE(valid);
    *valid = registry_has(world);
    return PBMPM_OK;
}

pbmpm_result pbmpm_get_worlds(pbmpm_world_id *worlds, uint32_t capacity, uint32_t *count)
{
    REQUIRE(count);
    if (capacity) REQUIRE(worlds);
    *count = registry_list(worlds, capacity);
    return PBMPM_OK;
}

/* Identifiers of all kinds are alike, but each is a type of its own. */
typedef struct KeyedId {
    uint32_t index, generation;
} KeyedId;

static pbmpm_result is_valid(pbmpm_world_id world, KeyedKind kind, KeyedId id, int32_t *valid)
{
    Hold held;
    if (!registry_has(world)) return *valid = 0, PBMPM_OK;
    const pbmpm_result result = api_hold(world, HOLD_TO_READ, &held);
    if (result == PBMPM_ERROR_INVALID_ID) return *valid = 0, PBMPM_OK; /* it has just been destroyed */
    if (result != PBMPM_OK) return result;
    *valid = id.generation != 0 && keyed_generation(held.world, kind, id.index) == id.generation;
    LET_GO(PBMPM_OK);
}

/* The next thing of a kind from `slot` on; its slot is the number of slots when there is none. */
static KeyedId next_from(const World *w, KeyedKind kind, uint32_t slot)
{
    while (slot < keyed_slots(w, kind) && keyed_generation(w, kind, slot) == 0) slot++;
    return (KeyedId){slot, keyed_generation(w, kind, slot)};
}

#define DEFINE_LISTS(one, many, kind)                                                                                   \
    pbmpm_result pbmpm_##one##_is_valid(pbmpm_world_id world, pbmpm_##one##_id one, int32_t *valid)                     \
    {                                                                                                                   \
        REQUIRE(valid);                                                                                                 \
        return is_valid(world, kind, (KeyedId){one.index, one.generation}, valid);                                      \
    }                                                                                                                   \
                                                                                                                        \
    pbmpm_result pbmpm_world_get_##many(pbmpm_world_id world, pbmpm_##one##_id *many, uint32_t capacity, uint32_t *count) \
    {                                                                                                                   \
        REQUIRE(count);                                                                                                 \
        if (capacity) REQUIRE(many);                                                                                    \
        HOLD_READING(world);                                                                                            \
        *count = 0;                                                                                                     \
        for (KeyedId id = next_from(w, kind, 0); id.generation != 0; id = next_from(w, kind, id.index + 1)) {           \
            if (*count < capacity) many[*count] = (pbmpm_##one##_id){id.index, id.generation};                          \
            ++*count;                                                                                                   \
        }                                                                                                               \
        LET_GO(PBMPM_OK);                                                                                               \
    }

DEFINE_LISTS(material, materials, KEYED_MATERIALS)
DEFINE_LISTS(collider, colliders, KEYED_COLLIDERS)
DEFINE_LISTS(emitter, emitters, KEYED_EMITTERS)
DEFINE_LISTS(drain, drains, KEYED_DRAINS)
DEFINE_LISTS(force, forces, KEYED_FORCES)

pbmpm_result pbmpm_world_debug_lines(pbmpm_world_id world, uint32_t parts, pbmpm_line *lines, uint32_t capacity, uint32_t *count)
{
    REQUIRE(count);
    if (capacity) REQUIRE(lines);
    HOLD_READING(world);
    if (parts & ~(uint32_t)PBMPM_DEBUG_ALL) LET_GO(api_invalid("parts: a bit is not that of a pbmpm_debug_part"));
    *count = debug_lines_draw(w, parts, lines, capacity);
    LET_GO(PBMPM_OK);
}
