/* What it costs to read a world: `reading THREADS` prints, for 51,200 particles of liquid in 3D, the wall time and the CPU time of all
 * threads per call [ms], and those of a step to compare with: medians over rounds. Times are for people: no test looks at them. */
#define _POSIX_C_SOURCE 200809L
#include <pbmpm/pbmpm.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { ROUNDS = 51, CALLS = 10, STEPS = 15 };

static pbmpm_world_id world;
static char *room;
static uint64_t room_bytes;

static void ok(pbmpm_result result)
{
    if (result == PBMPM_OK) return;
    fprintf(stderr, "reading: %s: %s\n", pbmpm_result_name(result), pbmpm_last_error());
    exit(1);
}

/* 40 x 32 x 40 lattice points, two per cell and axis, at the floor of a closed box. */
static void make_world(int32_t threads)
{
    pbmpm_world_def def;
    pbmpm_material_def water;
    pbmpm_fill_def fill;
    pbmpm_shape block;
    pbmpm_material_id material;
    pbmpm_settings settings = {.size = sizeof settings};
    ok(pbmpm_world_def_init(&def, sizeof def));
    def.cell_size = 0.05f;
    def.particle_capacity = 51200;
    def.thread_count = threads;
    def.domain_enabled = 1;
    def.domain_max[0] = 2.0f;
    ok(pbmpm_world_create(&def, &world));
    ok(pbmpm_world_get_settings(world, &settings));
    settings.gravity[1] = -9.81f;
    ok(pbmpm_world_set_settings(world, &settings));
    ok(pbmpm_material_def_init(&water, sizeof water));
    ok(pbmpm_material_create(world, &water, &material));
    ok(pbmpm_fill_def_init(&fill, sizeof fill));
    ok(pbmpm_shape_init(&block, sizeof block));
    fill.material = material;
    block.position[0] = block.half_extents[0] = block.position[2] = block.half_extents[2] = 0.5f;
    block.position[1] = block.half_extents[1] = 0.4f;
    ok(pbmpm_particles_fill(world, &fill, &block, NULL));
    room_bytes = 51200 * 28;
    room = malloc(room_bytes);
}

static void step(void) { ok(pbmpm_world_step(world, 1.0f / 240.0f)); }

static void all_stats(void)
{
    pbmpm_stats stats = {.size = sizeof stats};
    ok(pbmpm_world_get_stats(world, &stats));
}

static void step_stats(void)
{
    pbmpm_stats stats = {.size = sizeof stats};
    ok(pbmpm_world_get_step_stats(world, &stats));
}

static void copy(void)
{
    uint32_t count;
    ok(pbmpm_particles_copy(world, NULL, room, room_bytes, &count));
}

static double now(clockid_t clock)
{
    struct timespec time;
    clock_gettime(clock, &time);
    return 1e3 * (double)time.tv_sec + 1e-6 * (double)time.tv_nsec;
}

static int by_size(const void *a, const void *b) { return *(const double *)a < *(const double *)b ? -1 : 1; }

static double median(double *value, int count)
{
    qsort(value, (size_t)count, sizeof *value, by_size);
    return value[count / 2];
}

static void measure(const char *name, void (*call)(void), int rounds, int calls)
{
    double wall[ROUNDS], cpu[ROUNDS];
    call();
    for (int i = 0; i < rounds; i++) {
        const double began = now(CLOCK_MONOTONIC), used = now(CLOCK_PROCESS_CPUTIME_ID);
        for (int k = 0; k < calls; k++) call();
        cpu[i] = (now(CLOCK_PROCESS_CPUTIME_ID) - used) / calls;
        wall[i] = (now(CLOCK_MONOTONIC) - began) / calls;
    }
    printf("%-28s %9.4f ms wall, %9.4f ms CPU\n", name, median(wall, rounds), median(cpu, rounds));
}

int main(int argc, char **argv)
{
    make_world(argc > 1 ? atoi(argv[1]) : 1);
    measure("pbmpm_world_step", step, STEPS, 1);
    measure("pbmpm_world_get_stats", all_stats, ROUNDS, CALLS);
    measure("pbmpm_world_get_step_stats", step_stats, ROUNDS, CALLS);
    measure("pbmpm_particles_copy", copy, ROUNDS, CALLS);
    return pbmpm_shutdown() == PBMPM_OK ? 0 : 1;
}
