#include "skin/skin.h"

#include "base/numbers.h"
#include "base/result.h"
#include "skin/state.h"

enum { NARROW_VERTICES = 65535 }; /* the last number of 2 bytes begins a new strip for some GPUs */

pbmpm_surface_def skin_def_defaults(void)
{
    return (pbmpm_surface_def){.size = sizeof(pbmpm_surface_def), .subdivision = 2, .level = 0.5f, .keeps_thin = 1, .index_bytes = 4};
}

/* ---- Arguments ---- */

static const char *mesh_problem(const pbmpm_surface_def *def, const pbmpm_surface_mesh *mesh)
{
    const size_t vector = 3 * sizeof(float), shares = def->material_count * sizeof(float);
    if (mesh->stride % sizeof(float) != 0) return "mesh.stride must be a multiple of 4";
    if (mesh->stride && (mesh->positions || mesh->normals || mesh->velocities) && mesh->stride < vector) return "mesh.stride is less than a vertex takes";
    if (mesh->stride && mesh->weights && mesh->stride < shares) return "mesh.stride is less than the weights of a vertex take";
    if (mesh->weights && !def->material_count) return "mesh.weights needs surface.materials";
    return NULL;
}

const char *skin_problem(const pbmpm_surface_def *def, const pbmpm_surface_mesh *mesh)
{
    if (def->subdivision != 1 && def->subdivision != 2) return "surface.subdivision must be 1 or 2";
    if (!in_range(def->level, 0.1, 0.9)) return "surface.level must be in [0.1, 0.9]";
    if (def->keeps_thin != 0 && def->keeps_thin != 1) return "surface.keeps_thin must be 0 or 1";
    if (def->index_bytes != 2 && def->index_bytes != 4) return "surface.index_bytes must be 2 or 4";
    const char *problem = state_list_problem(def->materials, def->material_count);
    return problem ? problem : mesh_problem(def, mesh);
}

/* ---- The mesh ---- */

static MeshStream stream_of(const pbmpm_surface_mesh *mesh, float *base, size_t numbers)
{
    return (MeshStream){(char *)base, mesh->stride ? mesh->stride : numbers * sizeof(float)};
}

static MeshStream component_of(MeshStream stream, size_t component)
{
    return (MeshStream){stream.base + component * sizeof(float), stream.stride};
}

static void motion_of(const SkinMatter *matter, uint32_t row, uint32_t count, int axis, float *amount)
{
    field_volume(matter, row, count, axis, amount);
    for (uint32_t i = 0; i < count; i++) amount[i] *= matter->particles->velocity[axis][row + i];
}

static void share_of(const SkinMatter *matter, uint32_t row, uint32_t count, int slot, float *amount)
{
    for (uint32_t i = 0; i < count; i++) amount[i] = matter->particles->material[row + i] == (uint32_t)slot ? matter_volume(matter, row + i) : 0.0f;
}

/* Means of what particles have, over their volumes. */
static pbmpm_result write_means(World *world, Skin *skin, const pbmpm_surface_def *def, const pbmpm_surface_mesh *mesh)
{
    const size_t count = (size_t)skin->blocks.block.count * BLOCK_POINTS;
    if (!mesh->velocities && !mesh->weights) return PBMPM_OK;
    if (!state_reserve(world, &skin->volumes, count, sizeof(float)) || !state_reserve(world, &skin->values, count, sizeof(float)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for means over %d blocks", skin->blocks.count);
    const SkinMatter matter = state_matter(world, &skin->key);
    const FieldWork work = state_work(world, skin, &matter);
    const SkinMesh made = state_mesh(world, skin);
    const MeshStream velocities = stream_of(mesh, mesh->velocities, 3), weights = stream_of(mesh, mesh->weights, def->material_count);
    float *volumes = skin->volumes.data, *values = skin->values.data;
    field_make(&work, field_volume, 0, volumes);
    for (int a = 0; a < 3 && velocities.base; a++) {
        field_make(&work, motion_of, a, values);
        mesh_write_mean(&made, values, volumes, component_of(velocities, (size_t)a));
    }
    for (uint32_t m = 0; m < def->material_count && weights.base; m++) {
        field_make(&work, share_of, (int)def->materials[m].index, values);
        mesh_write_mean(&made, values, volumes, component_of(weights, m));
    }
    return PBMPM_OK;
}

/* Whether the mesh fits where it shall go. */
static pbmpm_result find_room(const Skin *skin, const pbmpm_surface_def *def, const pbmpm_surface_mesh *mesh)
{
    const bool has_vertices = mesh->positions || mesh->normals || mesh->velocities || mesh->weights;
    if (def->index_bytes == 2 && mesh->indices && skin->vertices > NARROW_VERTICES)
        return fail(PBMPM_ERROR_CAPACITY, "the surface has %u vertices; indices of 2 bytes take %d", mesh->vertex_count, NARROW_VERTICES);
    if (has_vertices && mesh->vertex_capacity < mesh->vertex_count)
        return fail(PBMPM_ERROR_CAPACITY, "the surface has %u vertices; there is room for %u", mesh->vertex_count, mesh->vertex_capacity);
    if (mesh->indices && mesh->index_capacity < mesh->index_count)
        return fail(PBMPM_ERROR_CAPACITY, "the surface has %u indices; there is room for %u", mesh->index_count, mesh->index_capacity);
    return PBMPM_OK;
}

static pbmpm_result extract(World *world, Skin *skin, const pbmpm_surface_def *def, pbmpm_surface_mesh *mesh)
{
    SkinKey key = state_key(world, def);
    pbmpm_result result = state_make(world, skin, &key);
    if (result != PBMPM_OK) return result;
    if (skin->vertices > UINT32_MAX || 3 * skin->triangles > UINT32_MAX) return fail(PBMPM_ERROR_CAPACITY, "the surface has more than 2^32 - 1 indices");
    mesh->vertex_count = (uint32_t)skin->vertices;
    mesh->index_count = (uint32_t)(3 * skin->triangles);
    result = find_room(skin, def, mesh);
    if (result == PBMPM_OK) result = write_means(world, skin, def, mesh);
    if (result != PBMPM_OK) return result;
    const SkinMesh made = state_mesh(world, skin);
    if (mesh->positions || mesh->normals) mesh_write_places(&made, stream_of(mesh, mesh->positions, 3), stream_of(mesh, mesh->normals, 3));
    if (mesh->indices) mesh_write_indices(&made, mesh->indices, def->index_bytes);
    return PBMPM_OK;
}

pbmpm_result skin_extract(World *world, const pbmpm_surface_def *def, pbmpm_surface_mesh *mesh)
{
    pbmpm_result result;
    Skin *skin = state_take(world, &result);
    if (!skin) return result;
    result = extract(world, skin, def, mesh);
    state_give(world);
    return result;
}

void skin_free(World *world) { state_free(world); }
