/* A process that ends while threads of the library work: nothing may crash or wait for ever. */
#include <stdio.h>

#include <pbmpm/pbmpm.h>

int main(void)
{
    pbmpm_world_def def;
    pbmpm_material_def liquid;
    pbmpm_fill_def fill;
    pbmpm_shape box;
    pbmpm_world_id world;
    pbmpm_world_def_init(&def, sizeof def);
    pbmpm_material_def_init(&liquid, sizeof liquid);
    pbmpm_fill_def_init(&fill, sizeof fill);
    pbmpm_shape_init(&box, sizeof box);
    def.thread_count = 4;
    const int failed = pbmpm_world_create(&def, &world) || pbmpm_material_create(world, &liquid, &fill.material) ||
                       pbmpm_particles_fill(world, &fill, &box, NULL) || pbmpm_world_step(world, 0.01f) || pbmpm_world_step_begin(world, 0.01f);
    if (failed) fprintf(stderr, "%s\n", pbmpm_last_error());
    return failed;
}
