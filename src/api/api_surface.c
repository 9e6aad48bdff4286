/* Exported functions of surface.h: check the arguments, hold the world, forward, let go. */
#include "api/api_call.h"
#include "skin/skin.h"

static pbmpm_result only_in_3d(void) { return fail(PBMPM_ERROR_UNSUPPORTED, "surfaces are made in 3D; this world is in 2D"); }

static pbmpm_result check_materials(const World *world, const pbmpm_material_id *materials, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        if (!material_is_live(&world->materials, materials[i])) return api_gone(world, "a material of the list", materials[i].generation);
    return PBMPM_OK;
}

pbmpm_result pbmpm_surface_def_init(pbmpm_surface_def *def, size_t size)
{
    INIT(pbmpm_surface_def, def, size, skin_def_defaults());
}

pbmpm_result pbmpm_surface_extract(pbmpm_world_id world, const pbmpm_surface_def *def, pbmpm_surface_mesh *mesh)
{
    READ_OR_DEFAULT(pbmpm_surface_def, own, def, skin_def_defaults());
    READ(pbmpm_surface_mesh, made, mesh, (pbmpm_surface_mesh){.size = sizeof(pbmpm_surface_mesh)});
    HOLD_READING(world);
    if (w->def.dimension != 3) LET_GO(only_in_3d());
    const char *problem = skin_problem(&own, &made);
    if (problem) LET_GO(api_invalid(problem));
    pbmpm_result result = check_materials(w, own.materials, own.material_count);
    if (result == PBMPM_OK) result = skin_extract(w, &own, &made);
    if (result == PBMPM_OK || result == PBMPM_ERROR_CAPACITY) WRITE(pbmpm_surface_mesh, mesh, &made);
    LET_GO(result);
}

pbmpm_result pbmpm_points_def_init(pbmpm_points_def *def, size_t size)
{
    INIT(pbmpm_points_def, def, size, skin_points_defaults());
}

pbmpm_result pbmpm_surface_points(pbmpm_world_id world, const pbmpm_points_def *def, pbmpm_point *points, uint32_t capacity, uint32_t *count)
{
    READ_OR_DEFAULT(pbmpm_points_def, own, def, skin_points_defaults());
    REQUIRE(count);
    if (capacity) REQUIRE(points);
    HOLD_READING(world);
    if (own.spray_only && w->def.dimension != 3) LET_GO(only_in_3d());
    const char *problem = skin_points_problem(&own);
    if (problem) LET_GO(api_invalid(problem));
    const pbmpm_result checked = check_materials(w, own.materials, own.material_count);
    LET_GO(checked == PBMPM_OK ? skin_points(w, &own, points, capacity, count) : checked);
}
