/* stir: a turning bar stirs a 3D pool with elastic balls in it. Shows kinematic colliders, views and events; with a file
 * name it writes the last positions there as text, one particle per line: x y z material. */
#include <pbmpm/pbmpm.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { rate = 60, seconds = 3, ball_count = 4 };

static const float pool_size = 2.0f;

static void require(pbmpm_result result)
{
    if (result != PBMPM_OK) {
        fprintf(stderr, "stir: %s: %s\n", pbmpm_result_name(result), pbmpm_last_error());
        exit(1);
    }
}

static pbmpm_world_id make_pool(void)
{
    pbmpm_world_def def;
    pbmpm_settings settings;
    pbmpm_world_id world;
    require(pbmpm_world_def_init(&def, sizeof def));
    def.domain_enabled = 1;
    for (int axis = 0; axis < 3; axis++)
        def.domain_max[axis] = pool_size;
    require(pbmpm_world_create(&def, &world));
    require(pbmpm_settings_init(&settings, sizeof settings));
    settings.gravity[1] = -9.81f;
    require(pbmpm_world_set_settings(world, &settings));
    return world;
}

static void fill_pool(pbmpm_world_id world)
{
    pbmpm_material_def material;
    pbmpm_fill_def fill;
    require(pbmpm_material_def_init(&material, sizeof material));
    require(pbmpm_fill_def_init(&fill, sizeof fill));
    pbmpm_shape fill_shape;
    require(pbmpm_shape_init(&fill_shape, sizeof fill_shape));
    require(pbmpm_material_create(world, &material, &fill.material));
    fill_shape.position[0] = fill_shape.position[2] = pool_size / 2;
    fill_shape.position[1] = 0.3f;
    fill_shape.half_extents[0] = fill_shape.half_extents[2] = pool_size / 2;
    fill_shape.half_extents[1] = 0.3f;
    require(pbmpm_particles_fill(world, &fill, &fill_shape, NULL));

    material.kind = PBMPM_ELASTIC;
    material.density = 500;
    require(pbmpm_material_create(world, &material, &fill.material));
    fill_shape.kind = PBMPM_SPHERE;
    fill_shape.radius = 0.2f;
    fill_shape.position[1] = 1.0f;
    for (int ball = 0; ball < ball_count; ball++) {
        const float angle = 6.2831853f * (float)ball / ball_count;
        fill_shape.position[0] = pool_size / 2 + 0.6f * cosf(angle);
        fill_shape.position[2] = pool_size / 2 + 0.6f * sinf(angle);
        require(pbmpm_particles_fill(world, &fill, &fill_shape, NULL));
    }
}

/* A horizontal bar near the floor. */
static pbmpm_collider_id add_bar(pbmpm_world_id world)
{
    pbmpm_collider_def def;
    pbmpm_collider_id bar;
    require(pbmpm_collider_def_init(&def, sizeof def));
    pbmpm_shape def_shape;
    require(pbmpm_shape_init(&def_shape, sizeof def_shape));
    def.kinematic = 1;
    def_shape.kind = PBMPM_CAPSULE;
    def_shape.half_extents[0] = 0.6f;
    def_shape.radius = 0.15f;
    def_shape.position[0] = def_shape.position[2] = pool_size / 2;
    def_shape.position[1] = 0.3f;
    require(pbmpm_collider_create(world, &def, &def_shape, &bar));
    return bar;
}

/* Asks for the pose of the bar at the end of the next step: half a turn per second about the vertical. */
static void turn_bar(pbmpm_world_id world, pbmpm_collider_id bar, double time)
{
    const float half_angle = (float)(0.5 * 3.14159265358979 * time);
    const float position[3] = {pool_size / 2, 0.3f, pool_size / 2};
    const float rotation[4] = {0, sinf(half_angle), 0, cosf(half_angle)};
    require(pbmpm_collider_move(world, bar, position, rotation));
}

/* Deletions are never silent: each is an event of the step in which it happened. */
static void report_deletions(pbmpm_world_id world)
{
    static pbmpm_event events[PBMPM_MAX_EVENTS];
    uint32_t count;
    events[0].size = sizeof *events;
    require(pbmpm_world_events(world, events, PBMPM_MAX_EVENTS, &count, NULL));
    for (uint32_t i = 0; i < count; i++)
        if (events[i].kind <= PBMPM_EVENT_DELETED_CONDITION)
            printf("step %llu: a particle was deleted at %g %g %g\n", (unsigned long long)events[i].step, (double)events[i].position[0],
                   (double)events[i].position[1], (double)events[i].position[2]);
}

static void write_positions(pbmpm_world_id world, const char *path)
{
    pbmpm_view position = {.size = sizeof position}, material = {.size = sizeof material};
    FILE *file = fopen(path, "w");
    if (!file) {
        perror(path);
        exit(1);
    }
    require(pbmpm_particles_view(world, PBMPM_POSITION, &position));
    require(pbmpm_particles_view(world, PBMPM_MATERIAL, &material));
    for (uint32_t i = 0; i < position.count; i++) {
        const char *row = (const char *)position.data + i * position.stride;
        for (uint32_t axis = 0; axis < position.components; axis++)
            fprintf(file, "%g ", (double)*(const float *)(row + axis * position.component_stride));
        fprintf(file, "%u\n", *(const uint32_t *)((const char *)material.data + i * material.stride));
    }
    if (fclose(file) != 0) {
        perror(path);
        exit(1);
    }
}

int main(int argument_count, char **arguments)
{
    const pbmpm_world_id world = make_pool();
    const pbmpm_collider_id bar = add_bar(world);
    pbmpm_stats stats = {.size = sizeof stats};
    fill_pool(world);
    for (int step = 1; step <= rate * seconds; step++) {
        turn_bar(world, bar, (double)step / rate);
        require(pbmpm_world_step(world, 1.0f / rate));
        report_deletions(world);
        require(pbmpm_world_get_stats(world, &stats));
        if (step % rate == 0)
            printf("%d s: %u particles, %.2f ms per step, at most %.2f m/s, volume error %.2f %%\n", step / rate, stats.particle_count,
                   (double)stats.ms_total, (double)stats.max_speed, 100.0 * (double)stats.volume_error_rms);
    }
    if (argument_count > 1)
        write_positions(world, arguments[1]);
    require(pbmpm_world_destroy(world));
    return 0;
}
