/* minimal: a tank of liquid, one second of steps, and what the library says about it. */
#include <pbmpm/pbmpm.h>
#include <stdio.h>

int main(void)
{
    pbmpm_world_def def;
    pbmpm_world_def_init(&def, sizeof def); /* 3D, cells of 0.1 m */
    def.domain_enabled = 1;                 /* a closed box of 1 m */
    pbmpm_world_id world;
    pbmpm_result result = pbmpm_world_create(&def, &world);

    pbmpm_settings settings;
    pbmpm_settings_init(&settings, sizeof settings);
    settings.gravity[1] = -9.81f;
    if (result == PBMPM_OK)
        result = pbmpm_world_set_settings(world, &settings);

    pbmpm_material_def water;
    pbmpm_material_def_init(&water, sizeof water);
    pbmpm_fill_def fill;
    pbmpm_fill_def_init(&fill, sizeof fill); /* a box of 1 m around the origin: an eighth of it is in the tank */
    if (result == PBMPM_OK)
        result = pbmpm_material_create(world, &water, &fill.material);
    if (result == PBMPM_OK)
        result = pbmpm_particles_fill(world, &fill, NULL);

    for (int frame = 0; frame < 60 && result == PBMPM_OK; frame++)
        result = pbmpm_world_step(world, 1.0f / 60);

    pbmpm_stats stats = {.size = sizeof stats};
    if (result == PBMPM_OK)
        result = pbmpm_world_get_stats(world, &stats);
    if (result != PBMPM_OK)
        return fprintf(stderr, "%s: %s\n", pbmpm_result_name(result), pbmpm_last_error()), 1;
    printf("%u particles, %.1f kg, fastest %.2f m/s, volume error %.2f %%, %.2f ms for the last step\n", stats.particle_count, stats.mass,
           stats.max_speed, 100.0 * stats.volume_error_rms, stats.ms_total);
    return pbmpm_world_destroy(world) != PBMPM_OK;
}
