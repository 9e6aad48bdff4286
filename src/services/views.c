#include "services/views.h"

#include "base/numbers.h"
#include "base/result.h"
#include "services/readers.h"

/* A field whose components lie `apart` bytes from each other. */
static pbmpm_view planes(const void *first, uint32_t components, size_t apart)
{
    return (pbmpm_view){.data = first, .components = components, .component_stride = (uint32_t)apart, .stride = 4};
}

/* A field whose components lie side by side. */
static pbmpm_view packed(const void *first, uint32_t components)
{
    return (pbmpm_view){.data = first, .components = components, .component_stride = 4, .stride = 4 * components};
}

uint32_t views_components(const World *world, pbmpm_field field)
{
    const uint32_t d = (uint32_t)world->def.dimension;
    switch (field) {
    case PBMPM_POSITION:
    case PBMPM_VELOCITY: return d;
    case PBMPM_AFFINE_VELOCITY:
    case PBMPM_DEFORMATION: return d * d;
    case PBMPM_PARTICLE: return 2;
    case PBMPM_VOLUME_RATIO:
    case PBMPM_MATERIAL:
    case PBMPM_MASS:
    case PBMPM_PRESSURE:
    case PBMPM_USER_VALUE:
    case PBMPM_FIELD_FORCE32: break;
    }
    return 1;
}

bool views_is_field(pbmpm_field field) { return in_enum(field, PBMPM_POSITION, VIEW_FIELDS - 1); }

pbmpm_result views_no_field(pbmpm_field field) { return fail(PBMPM_ERROR_INVALID_ARGUMENT, "field %d does not exist", (int)field); }

bool views_has(const World *world, pbmpm_field field)
{
    const Particles *p = &world->particles;
    switch (field) {
    case PBMPM_DEFORMATION: return p->deformation[0];
    case PBMPM_PRESSURE: return p->pressure;
    case PBMPM_USER_VALUE: return p->user_value;
    case PBMPM_POSITION:
    case PBMPM_VELOCITY:
    case PBMPM_AFFINE_VELOCITY:
    case PBMPM_VOLUME_RATIO:
    case PBMPM_MATERIAL:
    case PBMPM_PARTICLE:
    case PBMPM_MASS:
    case PBMPM_FIELD_FORCE32: break;
    }
    return true;
}

pbmpm_result views_get(World *world, pbmpm_field field, pbmpm_view *view)
{
    Particles *p = &world->particles;
    const uint32_t d = (uint32_t)p->dimension;
    pbmpm_view found;
    switch (field) {
    case PBMPM_POSITION: found = packed(readers_positions(world), d); break;
    case PBMPM_VELOCITY: found = planes(p->velocity[0], d, p->array_bytes); break;
    case PBMPM_AFFINE_VELOCITY: found = planes(p->affine[0], d * d, p->array_bytes); break;
    case PBMPM_VOLUME_RATIO: found = packed(p->volume_ratio, 1); break;
    case PBMPM_DEFORMATION:
        if (!p->deformation[0])
            return fail(PBMPM_ERROR_UNSUPPORTED, "a world that never had a particle of anything but liquid has no deformation gradients");
        found = planes(p->deformation[0], d * d, p->array_bytes);
        break;
    case PBMPM_MATERIAL: found = packed(p->material, 1); break;
    case PBMPM_PARTICLE: found = packed(p->id, 2); break;
    case PBMPM_MASS: found = packed(readers_kilograms(world), 1); break;
    case PBMPM_PRESSURE:
        if (!p->pressure) return fail(PBMPM_ERROR_UNSUPPORTED, "a world has pressures only once the dual solver was used");
        found = packed(p->pressure, 1);
        break;
    case PBMPM_USER_VALUE:
        if (!p->user_value) return fail(PBMPM_ERROR_UNSUPPORTED, "a world has user values only once a particle was given one");
        found = packed(p->user_value, 1);
        break;
    case PBMPM_FIELD_FORCE32:
    default: return views_no_field(field);
    }
    found.size = sizeof found;
    found.count = p->count;
    found.generation = world->generation;
    if (p->count == 0) found.data = NULL;
    *view = found;
    return PBMPM_OK;
}
