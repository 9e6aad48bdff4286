#include "world/keyed.h"

#include "world/world.h"

uint32_t keyed_slots(const World *world, KeyedKind kind)
{
    switch (kind) {
    case KEYED_MATERIALS: return PBMPM_MAX_MATERIALS;
    case KEYED_COLLIDERS: return world->colliders.used;
    case KEYED_EMITTERS: return world->emitters.used;
    case KEYED_DRAINS: return world->sinks.used;
    case KEYED_FORCES: return world->forces.used;
    }
    return 0;
}

uint32_t keyed_generation(const World *world, KeyedKind kind, uint32_t slot)
{
    if (slot >= keyed_slots(world, kind)) return 0;
    switch (kind) {
    case KEYED_MATERIALS: return world->materials.generation[slot];
    case KEYED_COLLIDERS: return world->colliders.slot[slot].generation;
    case KEYED_EMITTERS: return world->emitters.slot[slot].generation;
    case KEYED_DRAINS: return world->sinks.slot[slot].generation;
    case KEYED_FORCES: return world->forces.slot[slot].generation;
    }
    return 0;
}

static uint64_t key_at(const World *world, KeyedKind kind, uint32_t slot)
{
    switch (kind) {
    case KEYED_MATERIALS: return world->materials.def[slot].key;
    case KEYED_COLLIDERS: return world->colliders.slot[slot].def.key;
    case KEYED_EMITTERS: return world->emitters.slot[slot].def.key;
    case KEYED_DRAINS: return world->sinks.slot[slot].def.key;
    case KEYED_FORCES: return world->forces.slot[slot].def.key;
    }
    return 0;
}

int32_t keyed_find(const World *world, KeyedKind kind, uint64_t key)
{
    for (uint32_t slot = 0; slot < keyed_slots(world, kind); slot++)
        if (keyed_generation(world, kind, slot) != 0 && key_at(world, kind, slot) == key) return (int32_t)slot;
    return -1;
}

const char *keyed_problem(const World *world, KeyedKind kind, uint64_t key, int32_t slot)
{
    if (key == 0) return NULL;
    const int32_t found = keyed_find(world, kind, key);
    return found < 0 || found == slot ? NULL : "key: another one of the same kind has it in this world";
}

const char *keyed_name(KeyedKind kind)
{
    static const char *const names[] = {"materials", "colliders", "emitters", "drains", "forces"};
    return names[kind];
}
