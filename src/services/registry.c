#include "services/registry.h"

#include <stdatomic.h>
#include <unistd.h>

#include "base/assertion.h"
#include "base/generations.h"
#include "base/platform.h"
#include "base/result.h"
#include "services/background.h"
#include "services/lifecycle.h"

/* A slot lives forever, so an identifier can be looked at without a lock whatever became of its world. There is no lock at all: one that another
 * thread has while a process forks stays locked in the child. */
typedef struct Slot {
    atomic_bool taken;      /* by a world, or by one that comes or goes */
    atomic_uint generation; /* of the world in it; 0: none */
    atomic_ullong holders;  /* the process of which threads are inside calls, and how many readers: see hold_of(); 0: none are */
    World *world;
} Slot;

static Slot slots[PBMPM_MAX_WORLDS];

pbmpm_result registry_add(World *world, pbmpm_world_id *id)
{
    for (uint32_t i = 0; i < PBMPM_MAX_WORLDS; i++) {
        if (atomic_load(&slots[i].taken) || atomic_exchange(&slots[i].taken, true)) continue;
        *id = (pbmpm_world_id){i, generation_next()};
        slots[i].world = world;
        atomic_store(&slots[i].generation, id->generation);
        return PBMPM_OK;
    }
    return fail(PBMPM_ERROR_CAPACITY, "there are already %d worlds", PBMPM_MAX_WORLDS);
}

bool registry_has(pbmpm_world_id id)
{
    return id.index < PBMPM_MAX_WORLDS && id.generation != 0 && atomic_load(&slots[id.index].generation) == id.generation;
}

uint32_t registry_list(pbmpm_world_id *ids, uint32_t capacity)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < PBMPM_MAX_WORLDS; i++) {
        const pbmpm_world_id id = {i, atomic_load(&slots[i].generation)};
        if (id.generation == 0) continue;
        if (count < capacity) ids[count] = id;
        count++;
    }
    return count;
}

/* ---- Holds ---- */

/* In place of a number of readers: one that may write, and is alone. */
static const uint32_t WRITER = UINT32_MAX;

typedef unsigned long long Holders;

static Holders hold_of(uint32_t process, uint32_t readers) { return (Holders)process << 32 | readers; }

static uint32_t process_of(Holders holders) { return (uint32_t)(holders >> 32); }

static uint32_t readers_of(Holders holders) { return (uint32_t)holders; }

/* False: threads of this process have it, and do not share it. What threads of the parent had when the process forked is `orphaned`: nobody will
 * give it back. */
static bool hold(Slot *slot, bool shared, bool *orphaned)
{
    const uint32_t self = (uint32_t)getpid();
    Holders before = atomic_load(&slot->holders), after;
    do {
        const bool ours = process_of(before) == self;
        if (ours && (!shared || readers_of(before) >= WRITER - 1)) return false;
        *orphaned = before != 0 && !ours;
        after = hold_of(self, !shared ? WRITER : ours ? readers_of(before) + 1 : 1);
    } while (!atomic_compare_exchange_weak(&slot->holders, &before, after));
    return true;
}

static void let_go(Slot *slot)
{
    Holders before = atomic_load(&slot->holders), after;
    do {
        const uint32_t readers = readers_of(before);
        ASSERT(readers > 0);
        after = readers == WRITER || readers == 1 ? 0 : before - 1;
    } while (!atomic_compare_exchange_weak(&slot->holders, &before, after));
}

static pbmpm_result no_world(pbmpm_world_id id)
{
    const char *const problem = id.generation == 0 ? "is null" : generation_was_given(id.generation) ? "was destroyed" : "never existed: its identifier is made up";
    return fail(PBMPM_ERROR_INVALID_ID, "this world %s", problem);
}

static pbmpm_result enter(pbmpm_world_id id, bool shared, World **world)
{
    bool orphaned;
    if (!registry_has(id)) return no_world(id);
    Slot *slot = &slots[id.index];
    if (!hold(slot, shared, &orphaned))
        return fail(PBMPM_ERROR_BUSY, shared ? "another thread is changing this world" : "another thread is using this world");
    if (atomic_load(&slot->generation) != id.generation) { /* destroyed in the meantime */
        let_go(slot);
        return no_world(id);
    }
    *world = slot->world;
    if (orphaned) (*world)->frozen = true;
    return PBMPM_OK;
}

pbmpm_result registry_enter(pbmpm_world_id id, World **world) { return enter(id, false, world); }

pbmpm_result registry_enter_to_read(pbmpm_world_id id, World **world) { return enter(id, true, world); }

void registry_leave(pbmpm_world_id id) { let_go(&slots[id.index]); }

/* ---- All worlds ---- */

pbmpm_result registry_remove(pbmpm_world_id id, World **world)
{
    const pbmpm_result result = registry_enter(id, world);
    if (result != PBMPM_OK) return result;
    atomic_store(&slots[id.index].generation, 0);
    registry_leave(id);
    atomic_store(&slots[id.index].taken, false);
    return PBMPM_OK;
}

void registry_clear(void)
{
    for (uint32_t i = 0; i < PBMPM_MAX_WORLDS; i++) {
        World *world = NULL;
        const pbmpm_world_id id = {i, atomic_load(&slots[i].generation)};
        if (id.generation != 0 && registry_remove(id, &world) == PBMPM_OK) world_destroy(world);
    }
}

void registry_clear_at_unload(void)
{
    if (platform_has_lost_its_threads()) return; /* what they held stays locked, what they wrote half written */
    for (uint32_t i = 0; i < PBMPM_MAX_WORLDS; i++) {
        World *world = NULL;
        const pbmpm_world_id id = {i, atomic_load(&slots[i].generation)};
        if (id.generation == 0 || registry_remove(id, &world) != PBMPM_OK) continue;
        if (!world->def.allocator) {
            world_destroy(world);
        } else if (world->owner == getpid()) {
            background_stop(world, true);
            pool_stop(world->pool);
        }
    }
}
