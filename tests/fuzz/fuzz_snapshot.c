/* Snapshots that are sound by their checksum. What is refused changes nothing; what is taken can be saved and taken again, and the world steps
 * on. An input is a byte of choices, then a snapshot; its checksum and length are mended. */
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"
#include "snapshot/snapshot.h"

enum { HEADER_BYTES = 32, LENGTH_AT = 16, IN_3D = 1, KEEPS_PARAMETERS = 64, KEEPS_LENGTH = 2, STEPS_ONCE_IN = 256, COMPARES_ONCE_IN = 16 };

typedef struct Stage {
    pbmpm_world_id world;
    uint64_t bytes, hash;
    char *sound; /* a snapshot of it */
} Stage;

static Stage stages[2];

static char *save(pbmpm_world_id world, uint64_t *bytes)
{
    HOLDS(pbmpm_snapshot_size(world, bytes, NULL) == PBMPM_OK);
    char *saved = malloc(*bytes);
    HOLDS(saved && pbmpm_snapshot_save(world, saved, *bytes, NULL) == PBMPM_OK);
    return saved;
}

static uint64_t hash_of(pbmpm_world_id world)
{
    uint64_t hash;
    HOLDS(pbmpm_world_hash(world, &hash) == PBMPM_OK);
    return hash;
}

int LLVMFuzzerInitialize(int *count, char ***arguments)
{
    fuzz_begin(*count, *arguments);
    for (int i = 0; i < 2; i++) {
        Stage *stage = &stages[i];
        stage->world = fuzz_used_world(2 + i);
        stage->sound = save(stage->world, &stage->bytes);
        HOLDS(pbmpm_snapshot_restore(stage->world, stage->sound, stage->bytes, 0) == PBMPM_OK);
        stage->hash = hash_of(stage->world);
    }
    fuzz_ready();
    return 0;
}

void target_seeds(void)
{
    for (int i = 0; i < 2; i++) {
        char *input = malloc(stages[i].bytes + 1);
        HOLDS(input);
        memcpy(input + 1, stages[i].sound, stages[i].bytes);
        input[0] = (char)i;
        fuzz_seed(i ? "deep" : "flat", input, stages[i].bytes + 1);
        free(input);
    }
}

static void use(const Stage *stage, bool steps)
{
    uint64_t bytes;
    const uint64_t hash = hash_of(stage->world);
    char *again = save(stage->world, &bytes);
    HOLDS(pbmpm_snapshot_restore(stage->world, again, bytes, 0) == PBMPM_OK);
    HOLDS(hash_of(stage->world) == hash);
    free(again);
    if (steps) {
        pbmpm_settings settings = {.size = sizeof settings};
        pbmpm_stats stats = {.size = sizeof stats};
        HOLDS(pbmpm_world_get_settings(stage->world, &settings) == PBMPM_OK);
        settings.substeps = 1; /* many take long */
        settings.iterations = settings.iterations % 3 + 1;
        settings.time_budget_ms = 0.0f;
        HOLDS(pbmpm_world_set_settings(stage->world, &settings) == PBMPM_OK);
        HOLDS(pbmpm_world_step(stage->world, 1e-3f) == PBMPM_OK);
        HOLDS(pbmpm_world_get_stats(stage->world, &stats) == PBMPM_OK);
        HOLDS(stats.particle_count <= FUZZ_CAPACITY);
    }
    HOLDS(pbmpm_snapshot_restore(stage->world, stage->sound, stage->bytes, 0) == PBMPM_OK);
    HOLDS(hash_of(stage->world) == stage->hash);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    uint64_t before, after;
    if (size < 1) return 0;
    const Stage *stage = &stages[data[0] & IN_3D];
    const uint64_t bytes = size - 1, whole = bytes / 8 * 8;
    char *forged = malloc(bytes ? bytes : 1); /* exactly as large: what reads beyond is seen */
    HOLDS(forged);
    memcpy(forged, data + 1, bytes);
    if (bytes >= HEADER_BYTES && !(data[0] & KEEPS_LENGTH)) {
        memcpy(forged, stage->sound, 8);
        memcpy(forged + LENGTH_AT, &whole, sizeof whole);
        snapshot_seal(forged);
    }
    HOLDS(pbmpm_world_generation(stage->world, &before) == PBMPM_OK);
    const pbmpm_result result = pbmpm_snapshot_restore(stage->world, forged, bytes, data[0] & KEEPS_PARAMETERS ? PBMPM_RESTORE_KEEP_PARAMETERS : 0);
    free(forged);
    if (result == PBMPM_OK) {
        use(stage, fuzz_chance(data, size, STEPS_ONCE_IN));
        return 0;
    }
    HOLDS(pbmpm_world_generation(stage->world, &after) == PBMPM_OK && after == before);
    if (fuzz_chance(data, size, COMPARES_ONCE_IN)) HOLDS(hash_of(stage->world) == stage->hash);
    return 0;
}
