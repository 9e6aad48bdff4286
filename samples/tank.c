/* tank: fills half of a tank with water, lets it run for a second, and prints what the library says about it. */
#include <pbmpm/pbmpm.h>

#include <stdio.h>
#include <stdlib.h>

static void require(pbmpm_result result)
{
    if (result != PBMPM_OK) {
        fprintf(stderr, "tank: %s: %s\n", pbmpm_result_name(result), pbmpm_last_error());
        exit(1);
    }
}

/* A closed box of 2 m x 1 m, with cells of 2.5 cm. */
static pbmpm_world_id make_tank(void)
{
    pbmpm_world_def def;
    require(pbmpm_world_def_init(&def, sizeof def));
    def.dimension = 2;
    def.cell_size = 0.025f;
    def.particle_capacity = 10000;
    def.domain_enabled = 1;
    def.domain_max[0] = 2.0f;
    def.domain_max[1] = 1.0f;

    pbmpm_world_id world;
    require(pbmpm_world_create(&def, &world));

    pbmpm_settings settings;
    require(pbmpm_settings_init(&settings, sizeof settings));
    settings.gravity[1] = -9.81f;
    require(pbmpm_world_set_settings(world, &settings));
    return world;
}

/* A column of water at the left wall, 1 m wide and 0.8 m high. */
static void add_water(pbmpm_world_id world)
{
    pbmpm_material_def water;
    require(pbmpm_material_def_init(&water, sizeof water));

    pbmpm_fill_def fill;
    require(pbmpm_fill_def_init(&fill, sizeof fill));
    require(pbmpm_material_create(world, &water, &fill.material));
    fill.shape.position[0] = 0.5f;
    fill.shape.position[1] = 0.4f;
    fill.shape.half_extents[0] = 0.5f;
    fill.shape.half_extents[1] = 0.4f;
    require(pbmpm_particles_fill(world, &fill, NULL));
}

int main(void)
{
    enum { rate = 60 };

    pbmpm_world_id world = make_tank();
    add_water(world);

    double milliseconds = 0.0;
    pbmpm_stats stats = {.size = sizeof stats};
    for (int frame = 0; frame < rate; ++frame) {
        require(pbmpm_world_step(world, 1.0f / rate));
        require(pbmpm_world_get_stats(world, &stats));
        milliseconds += stats.ms_total;
    }
    printf("%u particles, %.2f s simulated in %.1f ms with %s kernels\n", stats.particle_count, stats.simulated_seconds, milliseconds,
           pbmpm_isa_name(pbmpm_active_isa()));
    printf("volume error %.2f %% (rms), fastest particle %.2f m/s\n", 100.0 * stats.volume_error_rms, stats.max_speed);

    require(pbmpm_world_destroy(world));
    return 0;
}
