#include "skin/state.h"

#include <string.h>

#include "base/cpu.h"
#include "base/result.h"
#include "skin/make.h"

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

/* The same, and what is in it stays. */
static bool grow(World *world, Array *array, size_t count, size_t size)
{
    pthread_mutex_lock(&world->making);
    const bool room = array_grow(&world->memory, array, count, size, array->bytes);
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

SkinKey state_key(const World *world, const pbmpm_surface_def *def)
{
    const Materials *materials = &world->materials;
    uint8_t chosen[PBMPM_MAX_MATERIALS] = {0};
    SkinKey key;
    memset(&key, 0, sizeof key); /* its padding, too */
    key.subdivision = (int)def->subdivision;
    key.level = def->level;
    key.keeps_thin = def->keeps_thin != 0;
    for (uint32_t i = 0; i < def->material_count; i++) chosen[def->materials[i].index] = 1;
    if (!def->material_count) memset(chosen, 1, sizeof chosen);
    for (size_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (!chosen[slot] || !materials->generation[slot]) continue;
        key.cells_per_mass[slot] = materials->kernel[slot].inverse_density;
        key.stretches[slot] = !material_flows(&materials->def[slot]);
        key.groups |= materials->def[slot].groups;
    }
    return key;
}

static bool reserve(World *world, Skin *skin, const SkinKey *key)
{
    const size_t count = (size_t)skin->blocks.block.count * BLOCK_POINTS;
    return state_reserve(world, &skin->boxes, (size_t)skin->blocks.with_rows * BOX_POINTS, sizeof(float)) &&
           state_reserve(world, &skin->sums, count, sizeof(float)) && state_reserve(world, &skin->lines, count, sizeof(float)) &&
           grow(world, &skin->filling, count, sizeof(float)) && grow(world, &skin->field, count, sizeof(float)) &&
           (!key->bounded || (grow(world, &skin->mirrored, count, sizeof(float)) && grow(world, &skin->gaps, count, sizeof(float)))) &&
           (!key->keeps_thin || grow(world, &skin->more, count, sizeof(float))) &&
           grow(world, &skin->inside, count, sizeof(uint8_t)) && grow(world, &skin->start, count, sizeof(uint16_t));
}

static bool find_blocks(World *world, Skin *skin, const SkinMatter *matter)
{
    pthread_mutex_lock(&world->making);
    const bool found = blocks_find(&skin->blocks, &world->memory, matter);
    pthread_mutex_unlock(&world->making);
    if (!found || !reserve(world, skin, &skin->key)) return false;
    skin->filling_layer = (Layer){.values = skin->filling.data};
    skin->mirrored_layer = (Layer){skin->mirrored.data, offsetof(SkinBlock, bounded), &skin->filling_layer};
    skin->field_layer = (Layer){skin->field.data, offsetof(SkinBlock, ended), &skin->mirrored_layer};
    return true;
}

SkinMatter state_matter(const World *world, const SkinKey *key)
{
    SkinMatter matter = {.particles = &world->particles};
    memcpy(matter.cells_per_mass, key->cells_per_mass, sizeof matter.cells_per_mass);
    memcpy(matter.stretches, key->stretches, sizeof matter.stretches);
    return matter;
}

FieldWork state_work(const World *world, Skin *skin, const SkinMatter *matter)
{
    const bool bounded = skin->key.bounded;
    return (FieldWork){
        .blocks = &skin->blocks,
        .matter = matter,
        .pool = world->pool,
        .kernels = skin->kernels,
        .boxes = skin->boxes.data,
        .sums = skin->sums.data,
        .lines = skin->lines.data,
        .filling = skin->filling.data,
        .mirrored = bounded ? skin->mirrored.data : NULL,
        .gaps = bounded ? skin->gaps.data : NULL,
        .more = skin->key.keeps_thin ? skin->more.data : NULL,
        .field = skin->field.data,
        .mirrored_layer = &skin->mirrored_layer,
        .boundary = &skin->boundary,
        .groups = skin->key.groups,
        .level = skin->key.level,
        .cell_size = (double)world->def.cell_size,
    };
}

SkinMesh state_mesh(const World *world, const Skin *skin)
{
    return (SkinMesh){
        .blocks = &skin->blocks,
        .cases = &skin->cases,
        .pool = world->pool,
        .field = &skin->field_layer,
        .inside = skin->inside.data,
        .start = skin->start.data,
        .level = skin->key.level,
        .spacing = (double)world->def.cell_size / skin->blocks.subdivision,
        .first = -(double)field_shift(&skin->blocks),
    };
}

/* Brings what is kept up to date. False: no memory. */
static bool make(World *world, Skin *skin)
{
    const SkinMatter matter = state_matter(world, &skin->key);
    if (!find_blocks(world, skin, &matter)) return false;
    const FieldWork work = state_work(world, skin, &matter);
    const SkinMesh mesh = state_mesh(world, skin);
    blocks_compare(&skin->blocks, world->pool, &matter);
    make_field(&work);
    skin->changed = mesh_count(&mesh, &skin->vertices, &skin->triangles);
    return true;
}

pbmpm_result state_make(World *world, Skin *skin, SkinKey *key)
{
    const uint64_t generation = skin->generation;
    skin->generation = 0;
    pthread_mutex_lock(&world->making);
    const bool found = boundary_find(&skin->boundary, world);
    pthread_mutex_unlock(&world->making);
    key->bounded = skin->boundary.stands > 0;
    const bool same = found && generation && memcmp(&skin->key, key, sizeof *key) == 0;
    if (!same) blocks_forget(&skin->blocks);
    if (!found) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the obstacles around a surface");
    skin->key = *key;
    skin->blocks.subdivision = key->subdivision;
    if ((!same || skin->boundary.changed || generation != world->generation) && !make(world, skin))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a surface of %d blocks", skin->blocks.count);
    skin->generation = world->generation;
    return PBMPM_OK;
}

void state_free(World *world)
{
    Skin *skin = world->skin;
    if (!skin) return;
    Array *arrays[] = {&skin->boxes, &skin->sums,  &skin->lines,  &skin->filling, &skin->mirrored, &skin->gaps,       &skin->more,
                       &skin->field, &skin->spray, &skin->inside, &skin->start,   &skin->volumes,  &skin->values,     &skin->chunk_begin};
    boundary_free(&skin->boundary, &world->memory);
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(&world->memory, arrays[i]);
    blocks_free(&skin->blocks, &world->memory);
    memory_give(&world->memory, skin, sizeof *skin);
    world->skin = NULL;
}
