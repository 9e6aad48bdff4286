#include "services/collider_touches.h"

#include <string.h>

#include "base/sized.h"
#include "services/query.h"

/* [cells] Particles of matter at rest have their places a quarter of a cell from an obstacle, and then at three quarters: half way between. */
static const double TOUCH_DISTANCE = 0.5;

static bool bit(const uint64_t *bits, uint32_t slot) { return bits[slot / 64] >> slot % 64 & 1; }

static pbmpm_result count_at(World *world, const Collider *collider, uint32_t counts[PBMPM_MAX_MATERIALS])
{
    const Solid solid = solid_among(&collider->shape, world->def.dimension, &world->baked);
    return query_materials(world, &solid, collider->def.sensor ? 0.0 : TOUCH_DISTANCE * (double)world->def.cell_size, counts);
}

static pbmpm_touch touch_of(const World *world, uint32_t slot, uint32_t material, uint32_t particles)
{
    const Collider *collider = &world->colliders.slot[slot];
    const uint32_t generation = world->materials.generation[material];
    pbmpm_touch touch = {.size = sizeof touch, .collider = {slot, collider->generation}, .particles = particles};
    touch.state = particles == 0 ? PBMPM_TOUCH_ENDED : bit(collider->touched, material) ? PBMPM_TOUCH_STAYS : PBMPM_TOUCH_BEGAN;
    if (generation) touch.material = (pbmpm_material_id){material, generation};
    if (collider->def.measures_impulse) memcpy(touch.impulse, world->colliders.impulses.sum[slot].linear, sizeof touch.impulse);
    return touch;
}

/* What has become of the touches of a collider; writes those that there is room for. */
static pbmpm_result look_at(World *world, uint32_t slot, pbmpm_touch *touches, uint32_t capacity, uint32_t *count)
{
    uint32_t counts[PBMPM_MAX_MATERIALS];
    Collider *collider = &world->colliders.slot[slot];
    memset(collider->touching, 0, sizeof collider->touching);
    const pbmpm_result result = count_at(world, collider, counts);
    for (uint32_t material = 0; material < PBMPM_MAX_MATERIALS && result == PBMPM_OK; material++) {
        if (!groups_meet(collider->def.meets, world->materials.def[material].groups)) counts[material] = 0;
        if (counts[material] > 0) collider->touching[material / 64] |= (uint64_t)1 << material % 64;
        if (counts[material] == 0 && !bit(collider->touched, material)) continue;
        const pbmpm_touch touch = touch_of(world, slot, material, counts[material]);
        if (*count < capacity) sized_put(SIZED_pbmpm_touch, touches, *count, &touch);
        ++*count;
    }
    return result;
}

static bool reports(const Collider *collider) { return collider->generation != 0 && collider->def.reports_touches; }

pbmpm_result collider_touches_find(World *world, pbmpm_touch *touches, uint32_t capacity, uint32_t *count)
{
    Colliders *colliders = &world->colliders;
    pbmpm_result result = PBMPM_OK;
    uint32_t found = 0;
    for (uint32_t slot = 0; slot < colliders->used && result == PBMPM_OK; slot++)
        if (reports(&colliders->slot[slot])) result = look_at(world, slot, touches, capacity, &found);
    if (result != PBMPM_OK) return result;
    *count = found;
    if (found > capacity) return PBMPM_OK; /* not all were told */
    for (uint32_t slot = 0; slot < colliders->used; slot++) {
        Collider *collider = &colliders->slot[slot];
        if (reports(collider)) memcpy(collider->touched, collider->touching, sizeof collider->touched);
    }
    return PBMPM_OK;
}
