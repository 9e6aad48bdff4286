#include "solids.h"

#include <stdlib.h>

Mesh mesh;
struct baked_bytes baked;

void bake_now(int32_t resolution)
{
    const pbmpm_mesh_def def = mesh_def_of(&mesh, resolution);
    free(baked.data);
    OK(pbmpm_bake_mesh(&def, NULL, 0, &baked.bytes));
    baked.data = malloc(baked.bytes);
    OK(pbmpm_bake_mesh(&def, baked.data, baked.bytes, &baked.bytes));
}

void bake_ball(int32_t dimension, double radius)
{
    mesh_clear(&mesh, dimension);
    mesh_add_ball(&mesh, 0, 0, 0, radius, 16);
    bake_now(24);
}

void bake_forget(void)
{
    free(baked.data);
    baked.data = NULL;
}

pbmpm_baked_id load_baked(pbmpm_world_id world)
{
    pbmpm_baked_id id;
    OK(pbmpm_baked_create(world, baked.data, baked.bytes, &id));
    return id;
}

pbmpm_shape baked_shape(pbmpm_baked_id id, float x, float y, float z)
{
    pbmpm_shape shape;
    OK(pbmpm_shape_init(&shape, sizeof shape));
    shape.kind = PBMPM_BAKED;
    shape.baked = id;
    shape.position[0] = x;
    shape.position[1] = y;
    shape.position[2] = z;
    return shape;
}
