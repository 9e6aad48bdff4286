#include "skin/state.h"

#include <string.h>

#include "base/cpu.h"
#include "base/result.h"
#include "skin/thin.h"

Skin *state_take(World *world, pbmpm_result *result)
{
    pthread_mutex_lock(&world->making);
    if (!world->skin) {
        world->skin = memory_take(&world->memory, sizeof *world->skin);
        if (world->skin) {
            world->skin->kernels = skin_kernels_for(cpu_isa());
            cases_make(&world->skin->cases);
        }
    }
    Skin *skin = world->skin;
    const bool busy = skin && skin->busy;
    if (skin && !busy) skin->busy = true;
    pthread_mutex_unlock(&world->making);
    *result = PBMPM_OK;
    if (!skin) *result = fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a surface");
    if (busy) *result = fail(PBMPM_ERROR_BUSY, "another thread makes a surface of this world");
    return busy ? NULL : skin;
}

void state_give(World *world)
{
    pthread_mutex_lock(&world->making);
    world->skin->busy = false;
    pthread_mutex_unlock(&world->making);
}

/* Others who read may take memory, too. */
bool state_reserve(World *world, Array *array, size_t count, size_t size)
{
    pthread_mutex_lock(&world->making);
    const bool room = array_reserve(&world->memory, array, count, size);
    pthread_mutex_unlock(&world->making);
    return room;
}

const char *state_list_problem(const pbmpm_material_id *materials, uint32_t count)
{
    uint8_t chosen[PBMPM_MAX_MATERIALS] = {0};
    if (count > PBMPM_MAX_MATERIALS) return "material_count is more than there can be materials";
    if (count && !materials) return "materials is null";
    for (uint32_t i = 0; i < count; i++) {
        if (materials[i].index < PBMPM_MAX_MATERIALS && chosen[materials[i].index]++) return "materials has one twice";
    }
    return NULL;
}

SkinKey state_key(const pbmpm_surface_def *def)
{
    SkinKey key;
    memset(&key, 0, sizeof key); /* its padding, too */
    key.subdivision = (int)def->subdivision;
    key.level = def->level;
    key.keeps_thin = def->keeps_thin != 0;
    for (uint32_t i = 0; i < def->material_count; i++) key.chosen[def->materials[i].index] = 1;
    if (!def->material_count) memset(key.chosen, 1, sizeof key.chosen);
    return key;
}

static bool find_blocks(World *world, Skin *skin, const SkinMatter *matter)
{
    pthread_mutex_lock(&world->making);
    const bool found = blocks_find(&skin->blocks, &world->memory, matter);
    pthread_mutex_unlock(&world->making);
    if (!found) return false;
    const size_t count = (size_t)skin->blocks.count * BLOCK_POINTS;
    return state_reserve(world, &skin->boxes, (size_t)skin->blocks.with_rows * BOX_POINTS, sizeof(float)) &&
           state_reserve(world, &skin->sums, count, sizeof(float)) && state_reserve(world, &skin->lines, count, sizeof(float)) &&
           state_reserve(world, &skin->field, count, sizeof(float)) &&
           (skin->boundary.stands == 0 || state_reserve(world, &skin->gaps, count, sizeof(float))) &&
           state_reserve(world, &skin->spray, world->particles.count, sizeof(uint8_t)) &&
           state_reserve(world, &skin->inside, count, sizeof(uint8_t)) && state_reserve(world, &skin->start, count, sizeof(uint16_t));
}

SkinMatter state_matter(const World *world, const SkinKey *key)
{
    SkinMatter matter = {.particles = &world->particles};
    for (size_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (!key->chosen[slot] || !world->materials.generation[slot]) continue;
        matter.cells_per_mass[slot] = world->materials.kernel[slot].inverse_density;
        matter.stretches[slot] = !material_flows(&world->materials.def[slot]);
    }
    return matter;
}

FieldWork state_work(const World *world, Skin *skin, const SkinMatter *matter)
{
    uint32_t groups = 0;
    for (size_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (matter->cells_per_mass[slot] != 0.0f) groups |= world->materials.def[slot].groups;
    return (FieldWork){
        .blocks = &skin->blocks,
        .matter = matter,
        .pool = world->pool,
        .kernels = skin->kernels,
        .boxes = skin->boxes.data,
        .sums = skin->sums.data,
        .lines = skin->lines.data,
        .gaps = skin->gaps.data,
        .spray = skin->spray.data,
        .boundary = &skin->boundary,
        .groups = groups,
        .cell_size = (double)world->def.cell_size,
    };
}

SkinMesh state_mesh(const World *world, const Skin *skin)
{
    return (SkinMesh){
        .blocks = &skin->blocks,
        .cases = &skin->cases,
        .pool = world->pool,
        .field = skin->field.data,
        .inside = skin->inside.data,
        .start = skin->start.data,
        .level = skin->key.level,
        .spacing = (double)world->def.cell_size / skin->blocks.subdivision,
        .first = -(double)field_shift(&skin->blocks),
    };
}

pbmpm_result state_make(World *world, Skin *skin, SkinKey *key)
{
    bool moved;
    key->generation = world->generation;
    pthread_mutex_lock(&world->making);
    const bool bounded = boundary_find(&skin->boundary, world, &moved);
    pthread_mutex_unlock(&world->making);
    if (!bounded) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the obstacles around a surface");
    if (!moved && memcmp(&skin->key, key, sizeof *key) == 0) return PBMPM_OK;
    skin->key.generation = 0;
    skin->blocks.subdivision = key->subdivision;
    const SkinMatter matter = state_matter(world, key);
    if (!find_blocks(world, skin, &matter)) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a surface of %d blocks", skin->blocks.count);
    const FieldWork work = state_work(world, skin, &matter);
    blocks_link(&skin->blocks, world->pool);
    if (world->particles.count > 0) memset(skin->spray.data, 1, world->particles.count); /* blocks of spray are left out of the field */
    field_make(&work, field_volume, 0, false, skin->field.data);
    if (skin->boundary.stands) boundary_mirror(&work, key->level, skin->field.data);
    if (key->keeps_thin) thin_add(&work, key->level, skin->field.data);
    if (skin->boundary.stands) boundary_cut(&work, key->level, skin->field.data);
    skin->key = *key;
    const SkinMesh mesh = state_mesh(world, skin);
    mesh_count(&mesh, &skin->vertices, &skin->triangles);
    return PBMPM_OK;
}

void state_free(World *world)
{
    Skin *skin = world->skin;
    if (!skin) return;
    Array *arrays[] = {&skin->boxes,   &skin->sums,   &skin->lines,   &skin->field,   &skin->inside,     &skin->start,
                       &skin->volumes, &skin->values, &skin->gaps,   &skin->spray, &skin->chunk_begin};
    boundary_free(&skin->boundary, &world->memory);
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(&world->memory, arrays[i]);
    blocks_free(&skin->blocks, &world->memory);
    memory_give(&world->memory, skin, sizeof *skin);
    world->skin = NULL;
}
