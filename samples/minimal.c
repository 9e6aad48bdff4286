/* minimal: a tank of liquid for one second. */
#include <pbmpm/pbmpm.h>
#include <stdio.h>

int main(void)
{
    pbmpm_world_def tank;
    pbmpm_settings settings;
    pbmpm_material_def water;
    pbmpm_fill_def fill;
    pbmpm_shape box;
    pbmpm_world_id world;
    pbmpm_stats stats = {.size = sizeof stats};
    pbmpm_world_def_init(&tank, sizeof tank); /* 3D, cells of 0.1 m */
    pbmpm_settings_init(&settings, sizeof settings);
    pbmpm_material_def_init(&water, sizeof water);
    pbmpm_fill_def_init(&fill, sizeof fill);
    pbmpm_shape_init(&box, sizeof box); /* of 1 m around the origin */
    tank.domain_enabled = 1;            /* closed, from 0 to 1 m */
    box.position[0] = box.position[2] = 0.5f; /* its middle is on the floor: only its upper half is in the tank */
    settings.gravity[1] = -9.81f;
    int failed = pbmpm_world_create(&tank, &world) || pbmpm_world_set_settings(world, &settings) ||
                 pbmpm_material_create(world, &water, &fill.material) || pbmpm_particles_fill(world, &fill, &box, NULL);
    for (int frame = 0; frame < 60 && !failed; frame++) failed = pbmpm_world_step(world, 1.0f / 60);
    if (failed || pbmpm_world_get_stats(world, &stats)) return fprintf(stderr, "%s\n", pbmpm_last_error()), 1;
    printf("%u particles, at most %.2f m/s, %.2f ms per step, ", stats.particle_count, stats.max_speed, stats.ms_total);
    printf("level %.3f m\n", 2.0 * stats.potential_energy / (9.81 * stats.mass)); /* twice the height of the centre of mass */
    return pbmpm_world_destroy(world);
}
