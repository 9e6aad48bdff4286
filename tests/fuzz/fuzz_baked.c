/* Baked solids with a checksum that fits. What inspection takes can be loaded, looked up anywhere, and be an obstacle in a step. An input is a
 * byte of choices, then a solid. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "shape/distance_grid.h"
#include "fuzz.h"

enum { KEEPS_CHECKSUM = 1, HEADER_BYTES = 72, STEPS_ONCE_IN = 256 };

static pbmpm_world_id worlds[2];
static char *sound[2]; /* snapshots */
static uint64_t sound_bytes[2];

int LLVMFuzzerInitialize(int *count, char ***arguments)
{
    fuzz_begin(*count, *arguments);
    for (int i = 0; i < 2; i++) {
        worlds[i] = fuzz_used_world(2 + i);
        HOLDS(pbmpm_snapshot_size(worlds[i], &sound_bytes[i], NULL) == PBMPM_OK);
        sound[i] = malloc(sound_bytes[i]);
        HOLDS(sound[i] && pbmpm_snapshot_save(worlds[i], sound[i], sound_bytes[i], NULL) == PBMPM_OK);
    }
    fuzz_ready();
    return 0;
}

void target_seeds(void)
{
    static const char *const names[2][3] = {{"flat_mesh", "flat_hull", "flat_heights"}, {"deep_mesh", "deep_hull", "deep_heights"}};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int form = 0; form < 3; form++) {
            uint64_t bytes;
            void *solid = fuzz_solid(dimension, form, &bytes);
            char *input = malloc(bytes + 1);
            HOLDS(input);
            input[0] = 0;
            memcpy(input + 1, solid, bytes);
            fuzz_seed(names[dimension - 2][form], input, bytes + 1);
            free(input);
            free(solid);
        }
}

/* Distances and normals at places in, at and far from the grid. */
static void look_up(const char *data, uint64_t bytes, const pbmpm_baked_info *info)
{
    static const double shares[] = {-1e6, -0.5, 0.0, 0.3, 1.0, 1.5, 1e9};
    DistanceGrid grid;
    const void *values;
    HOLDS(distance_grid_read(data, bytes, &grid, &values) == PBMPM_OK);
    float *copy = malloc(distance_grid_nodes(&grid) * sizeof(float));
    HOLDS(copy);
    memcpy(copy, values, distance_grid_nodes(&grid) * sizeof(float));
    grid.value = copy;
    for (int i = 0; i < 7 * 7; i++) {
        double place[3], normal[3];
        for (int a = 0; a < 3; a++) place[a] = grid.low[a] + shares[(a ? i / 7 + (a - 1) * i : i) % 7] * (distance_grid_high(&grid, a) - grid.low[a]);
        const double distance = distance_grid_at(&grid, place, normal);
        HOLDS(isfinite(distance) && isfinite(distance_grid_least(&grid, place)));
        HOLDS(fabs(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2] - 1.0) < 1e-6);
        HOLDS(info->dimension == 3 || normal[2] == 0.0);
    }
    free(copy);
}

static void stand_in(pbmpm_world_id world, pbmpm_baked_id baked, const pbmpm_baked_info *info, bool steps)
{
    pbmpm_collider_def def;
    pbmpm_shape shape;
    pbmpm_collider_id id;
    uint32_t inside;
    const int i = info->dimension - 2;
    HOLDS(pbmpm_collider_def_init(&def, sizeof def) == PBMPM_OK);
    HOLDS(pbmpm_shape_init(&shape, sizeof shape) == PBMPM_OK);
    shape.kind = PBMPM_BAKED;
    shape.baked = baked;
    for (int a = 0; a < 3; a++) shape.position[a] = 0.5f;
    if (pbmpm_collider_create(world, &def, &shape, &id) != PBMPM_OK) return;
    HOLDS(pbmpm_query_shape(world, &shape, NULL, 0, &inside) == PBMPM_OK && inside <= FUZZ_CAPACITY);
    if (steps) HOLDS(pbmpm_world_step(world, 1e-3f) == PBMPM_OK);
    HOLDS(pbmpm_baked_destroy(world, baked) == PBMPM_ERROR_IN_USE);
    HOLDS(pbmpm_collider_destroy(world, id) == PBMPM_OK);
    HOLDS(pbmpm_snapshot_restore(world, sound[i], sound_bytes[i], 0) == PBMPM_OK);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    pbmpm_baked_info info = {.size = sizeof info}, loaded = {.size = sizeof loaded};
    pbmpm_baked_id baked;
    if (size < 1) return 0;
    const uint64_t bytes = size - 1;
    char *solid = malloc(bytes ? bytes : 1);
    HOLDS(solid);
    memcpy(solid, data + 1, bytes);
    if (bytes >= HEADER_BYTES && (bytes - HEADER_BYTES) % 4 == 0 && !(data[0] & KEEPS_CHECKSUM)) distance_grid_seal(solid, bytes);
    const pbmpm_result result = pbmpm_baked_inspect(solid, bytes, &info);
    if (result == PBMPM_OK) {
        look_up(solid, bytes, &info);
        const pbmpm_world_id world = worlds[info.dimension - 2];
        HOLDS(pbmpm_baked_create(worlds[3 - info.dimension], solid, bytes, &baked) == PBMPM_ERROR_INVALID_ARGUMENT);
        HOLDS(pbmpm_baked_create(world, solid, bytes, &baked) == PBMPM_OK);
        HOLDS(pbmpm_baked_get(world, baked, &loaded) == PBMPM_OK && memcmp(&info, &loaded, sizeof info) == 0);
        stand_in(world, baked, &info, fuzz_chance(data, size, STEPS_ONCE_IN));
        HOLDS(pbmpm_baked_destroy(world, baked) == PBMPM_OK);
    } else {
        HOLDS(pbmpm_baked_create(worlds[0], solid, bytes, &baked) == result);
    }
    free(solid);
    return 0;
}
