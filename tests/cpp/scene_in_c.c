/* The scene of test_cpp.cpp, in C. */
#include <pbmpm/pbmpm.h>

uint64_t hash_of_the_scene_in_c(void);

/* 0 on failure. */
uint64_t hash_of_the_scene_in_c(void)
{
    pbmpm_world_def def;
    pbmpm_settings settings;
    pbmpm_material_def water;
    pbmpm_fill_def fill;
    pbmpm_shape box;
    pbmpm_world_id world;
    uint64_t hash = 0;
    pbmpm_world_def_init(&def, sizeof def);
    pbmpm_settings_init(&settings, sizeof settings);
    pbmpm_material_def_init(&water, sizeof water);
    pbmpm_fill_def_init(&fill, sizeof fill);
    pbmpm_shape_init(&box, sizeof box);
    def.dimension = 2;
    def.cell_size = 0.05f;
    def.particle_capacity = 2000;
    def.domain_enabled = 1;
    settings.gravity[1] = -9.81f;
    box.position[0] = 0.5f;
    box.position[1] = box.half_extents[1] = 0.25f;
    if (pbmpm_world_create(&def, &world)) return 0;
    int failed = pbmpm_world_set_settings(world, &settings) || pbmpm_material_create(world, &water, &fill.material) ||
                 pbmpm_particles_fill(world, &fill, &box, NULL);
    for (int i = 0; i < 10 && !failed; i++) failed = pbmpm_world_step(world, 1.0f / 60);
    if (failed || pbmpm_world_hash(world, &hash)) hash = 0;
    pbmpm_world_destroy(world);
    return hash;
}
