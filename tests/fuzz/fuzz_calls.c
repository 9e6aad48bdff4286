/* Calls of all exported functions in any order, with arguments out of bytes; calls.inc has them, made from the headers. A result is one of the
 * enumeration, a refusal has a message and leaves every world as it was, and what was taken can be given back. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"

enum {
    ARRAY = 16,        /* structures of an array */
    REALS = 256,       /* numbers of one: 16 matrices, or 16 by 16 heights */
    MEMORY = 1 << 15,  /* bytes of a snapshot or baked solid */
    MOST_CALLS = 40,
    MOST_STEPS = 2,
    MOST_WORLDS = 3,
    KEPT = 4
};

/* What an input has done so far. */
static struct {
    int steps, worlds;
    bool compares;
} so_far;

/* What bakes and snapshots are written to and read from. */
static struct {
    char *data;
    uint64_t stored;
} memory;

/* ---- Numbers ---- */

static uint32_t whole(Bytes *in)
{
    const uint8_t choice = bytes_u8(in);
    if (choice < 128) return choice % 8;
    if (choice < 192) return choice;
    if (choice < 200) return UINT32_MAX - choice % 4;
    return bytes_u32(in);
}

static uint32_t raw_enum(Bytes *in) { return whole(in); }

static float real(Bytes *in)
{
    static const float common[] = {0.0f, 0.1f, 0.25f, 0.5f, 1.0f, 2.0f, -1.0f, 10.0f, 1e-3f, 0.3f, 1000.0f, 0.05f, 0.75f, -0.5f, 1.2f, 1e5f};
    static const float rare[] = {1e-6f, 1e6f, 1e9f, -1e9f, INFINITY, -INFINITY, NAN, FLT_MAX, -FLT_MAX, FLT_MIN, 1e-40f, -0.0f, 1e-25f, 64.0f, 1e12f, 1e30f};
    const uint8_t choice = bytes_u8(in);
    if (choice < 192) return common[choice % 16];
    if (choice < 224) return rare[choice % 16];
    float value;
    bytes_take(in, &value, sizeof value);
    return value;
}

static uint32_t amount(Bytes *in, uint32_t most)
{
    const uint8_t choice = bytes_u8(in);
    return choice >= 240 ? most : choice >= 192 ? 0 : most > 255 ? most - choice : choice % (most + 1);
}

static uint64_t stored(Bytes *in)
{
    const uint8_t choice = bytes_u8(in);
    return choice < 224 ? memory.stored : choice % 128;
}

/* Sizes above that of the structure are a later version's, up to 4096: the library may read and write as much. */
static uint32_t odd_size(Bytes *in, size_t size)
{
    const uint8_t choice = bytes_u8(in);
    const uint32_t odd = choice < 250 ? (uint32_t)size : choice == 250 ? 0 : choice == 251 ? (uint32_t)size - 8 : bytes_u32(in);
    return odd > size && odd <= 4096 ? (uint32_t)size : odd;
}

static uint32_t changes(Bytes *in) { return bytes_u8(in) % 8; }

enum { MOST_ARRAYS = 8 }; /* of a call */
static uint32_t *arrays[MOST_ARRAYS];
static uint32_t array_count;

/* An array that ends where it ends, good until the call is done. */
static const void *array_of(Bytes *in, bool reals)
{
    if (bytes_u8(in) >= 248 || array_count == MOST_ARRAYS) return NULL;
    uint32_t **array = &arrays[array_count++];
    *array = malloc(REALS * sizeof **array);
    HOLDS(*array);
    const uint32_t pattern = 1 + bytes_u8(in) % 32;
    for (uint32_t i = 0; i < REALS; i++) {
        const float number = reals && i < pattern ? real(in) : 0.0f;
        if (i >= pattern) (*array)[i] = (*array)[i - pattern];
        else if (reals) memcpy(&(*array)[i], &number, sizeof number);
        else (*array)[i] = whole(in);
    }
    return *array;
}

static const float *array_of_reals(Bytes *in) { return array_of(in, true); }
static const uint32_t *array_of_wholes(Bytes *in) { return array_of(in, false); }

#define maybe(in, pointer) (bytes_u8(in) >= 250 ? NULL : (pointer))

/* ---- Identifiers: those that calls gave, live or not ---- */

typedef struct Kept {
    uint32_t index[KEPT], generation[KEPT], count;
} Kept;

static Kept kept[16];

static void keep(uint32_t pool, uint32_t index, uint32_t generation)
{
    Kept *k = &kept[pool];
    if (generation == 0) return;
    k->index[k->count % KEPT] = index;
    k->generation[k->count % KEPT] = generation;
    k->count++;
}

static void pick(Bytes *in, uint32_t pool, uint32_t *index, uint32_t *generation)
{
    const uint8_t choice = bytes_u8(in);
    const Kept *k = &kept[choice < 240 ? pool : choice % 8];
    const uint32_t there = k->count < KEPT ? k->count : KEPT;
    *index = *generation = 0;
    if (choice >= 252) {
        *index = whole(in);
        *generation = whole(in);
    } else if (there > 0) {
        *index = k->index[choice % there];
        *generation = k->generation[choice % there];
    }
}

/* ---- Functions that the library calls ---- */

static uint32_t refused_after; /* allocations; 0: none is refused */

static void *allocate(size_t size, size_t alignment, void *user)
{
    (void)user;
    if (refused_after > 0 && --refused_after == 0) return NULL;
    return aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

static void release(void *block, size_t size, void *user)
{
    (void)size;
    (void)user;
    free(block);
}

static void hooks_pbmpm_allocator(Bytes *in, pbmpm_allocator *it)
{
    *it = (pbmpm_allocator){odd_size(in, sizeof *it), allocate, release, NULL};
    refused_after = bytes_u8(in) % 64;
}

static void *enqueue(pbmpm_task *task, int32_t count, void *context, void *user)
{
    (void)user;
    for (int32_t i = count - 1; i >= 0; i--) task(i, context);
    return context;
}

static void finish(void *handle, void *user)
{
    (void)handle;
    (void)user;
}

static void hooks_pbmpm_task_hooks(Bytes *in, pbmpm_task_hooks *it)
{
    *it = (pbmpm_task_hooks){odd_size(in, sizeof *it), (int32_t)bytes_u8(in) % 4 - 1, enqueue, finish, NULL};
}

static size_t told;

static void log_line(pbmpm_log_level level, const char *message, void *user)
{
    (void)user;
    (void)level;
    told += strlen(message);
}

/* What does not hold ends the program, as a fault does. */
static pbmpm_assert_callback *callback_pbmpm_assert_callback(Bytes *in)
{
    (void)in;
    return NULL;
}

static pbmpm_log_callback *callback_pbmpm_log_callback(Bytes *in) { return bytes_u8(in) % 2 ? log_line : NULL; }

/* ---- Bounds on what would take long or much memory ---- */

static void limit_float(float *value, float most)
{
    if (*value > most && *value <= 1e9f) *value = most;
}

static void limit_pbmpm_world_def(pbmpm_world_def *def)
{
    if (def->particle_capacity > 512 && def->particle_capacity <= PBMPM_MAX_PARTICLES) def->particle_capacity %= 512;
    if (def->thread_count == 0 || (def->thread_count > 2 && def->thread_count <= 256)) def->thread_count = 2;
    if (def->cell_size < 0.05f && def->cell_size > 0.0f) def->cell_size = 0.05f;
}

static void limit_pbmpm_settings(pbmpm_settings *settings)
{
    if (settings->substeps > 2 && settings->substeps <= PBMPM_MAX_SUBSTEPS) settings->substeps = 2;
    if (settings->iterations > 3 && settings->iterations <= PBMPM_MAX_ITERATIONS) settings->iterations = 3;
}

static void limit_pbmpm_shape(pbmpm_shape *shape)
{
    for (int a = 0; a < 3; a++) limit_float(&shape->half_extents[a], 0.4f);
    limit_float(&shape->radius, 0.4f);
}

static void limit_pbmpm_fill_def(pbmpm_fill_def *def) { limit_float(&def->particles_per_axis, 4.0f); }
static void limit_pbmpm_ray(pbmpm_ray *ray) { limit_float(&ray->max_distance, 10.0f); }

static void limit_pbmpm_mesh_def(pbmpm_mesh_def *def)
{
    if (def->resolution > 6 && def->resolution <= 1024) def->resolution = 6;
}

static void limit_pbmpm_heights_def(pbmpm_heights_def *def)
{
    if (def->resolution == 0 || (def->resolution > 6 && def->resolution <= 1024)) def->resolution = 6;
}

static void limit_nothing(void *it) { (void)it; }

#define LIMIT(name, it)                                                                                                                     \
    _Generic((it), pbmpm_world_def *: limit_pbmpm_world_def, pbmpm_settings *: limit_pbmpm_settings, pbmpm_shape *: limit_pbmpm_shape,       \
             pbmpm_fill_def *: limit_pbmpm_fill_def, pbmpm_ray *: limit_pbmpm_ray, pbmpm_mesh_def *: limit_pbmpm_mesh_def,                    \
             pbmpm_heights_def *: limit_pbmpm_heights_def, default: limit_nothing)(it)

/* ---- What a call left ---- */

static volatile uint64_t seen;

static void read_bytes(const void *data, size_t size)
{
    for (size_t i = 0; i < size; i++) seen += ((const unsigned char *)data)[i];
}

static void read_text(const char *text)
{
    HOLDS(text);
    read_bytes(text, strlen(text));
}

/* All that a view shows can be read. */
static void look_at_view(const pbmpm_view *view)
{
    for (uint32_t i = 0; i < view->count; i++)
        for (uint32_t c = 0; c < view->components; c++) read_bytes((const char *)view->data + i * view->stride + c * (size_t)view->component_stride, 4);
}

static void look_at_nothing(const void *it) { (void)it; }

#define LOOK(name, it) _Generic((it), pbmpm_view *: look_at_view, default: look_at_nothing)(it)

static uint64_t hash_before[KEPT];
static pbmpm_result known_before[KEPT];

static pbmpm_result hash_of(uint32_t i, uint64_t *hash)
{
    return pbmpm_world_hash((pbmpm_world_id){kept[0].index[i], kept[0].generation[i]}, hash);
}

static bool begin(const char *name)
{
    if (strncmp(name, "pbmpm_world_step", 16) == 0 && strcmp(name, "pbmpm_world_step_end") != 0 && strcmp(name, "pbmpm_world_step_done") != 0 &&
        so_far.steps++ >= MOST_STEPS)
        return false;
    if (strcmp(name, "pbmpm_world_create") == 0 && so_far.worlds++ >= MOST_WORLDS) return false;
    for (uint32_t i = 0; i < KEPT && i < kept[0].count && so_far.compares; i++) known_before[i] = hash_of(i, &hash_before[i]);
    return true;
}

static void end(const char *name, pbmpm_result result)
{
    HOLDS(result >= PBMPM_OK && result <= PBMPM_ERROR_FOREIGN);
    if (result == PBMPM_OK) return;
    HOLDS(*pbmpm_last_error());
    if (strncmp(name, "pbmpm_world_step", 16) == 0) return; /* one that runs out of memory stays where it was */
    for (uint32_t i = 0; i < KEPT && i < kept[0].count && so_far.compares; i++) {
        uint64_t hash;
        if (known_before[i] == PBMPM_OK) HOLDS(hash_of(i, &hash) == PBMPM_OK && hash == hash_before[i]);
    }
}

#define BEGIN(name) \
    if (!begin(name)) break
#define END(name, result) end(name, result)

#include "calls.inc"

_Static_assert(POOL_pbmpm_world_id == 0 && POOLS <= sizeof kept / sizeof *kept, "pools");

/* ---- The target ---- */

int LLVMFuzzerInitialize(int *count, char ***arguments)
{
    fuzz_begin(*count, *arguments);
    memory.data = malloc(MEMORY);
    HOLDS(memory.data);
    fuzz_ready();
    return 0;
}

/* Each call by itself, and all of them, on each kind of start. */
void target_seeds(void)
{
    uint8_t input[4096];
    char name[32];
    for (uint32_t start = 0; start < 4; start++) {
        for (uint32_t call = 0; call < CALLS; call++) {
            memset(input, 0, sizeof input);
            input[0] = (uint8_t)start;
            input[1] = (uint8_t)call;
            snprintf(name, sizeof name, "start%u_call%u", start, call);
            fuzz_seed(name, input, 64);
        }
    }
}

static void open_world(uint8_t start)
{
    FuzzIds ids;
    if (start % 4 == 0) return;
    const pbmpm_world_id world = fuzz_world(start % 4 == 3 ? 3 : 2, &ids);
    keep(POOL_pbmpm_world_id, world.index, world.generation);
    keep(POOL_pbmpm_material_id, ids.material.index, ids.material.generation);
    for (int i = 0; i < 2; i++) keep(POOL_pbmpm_collider_id, ids.collider[i].index, ids.collider[i].generation);
    keep(POOL_pbmpm_baked_id, ids.baked.index, ids.baked.generation);
    keep(POOL_pbmpm_emitter_id, ids.emitter.index, ids.emitter.generation);
    keep(POOL_pbmpm_drain_id, ids.drain.index, ids.drain.generation);
    keep(POOL_pbmpm_force_id, ids.force.index, ids.force.generation);
    pbmpm_view view = {.size = sizeof view};
    uint32_t first[2];
    HOLDS(pbmpm_particles_view(world, PBMPM_PARTICLE, &view) == PBMPM_OK && view.count > 0);
    memcpy(&first[0], view.data, 4);
    memcpy(&first[1], (const char *)view.data + view.component_stride, 4);
    keep(POOL_pbmpm_particle_id, first[0], first[1]);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    Bytes in = {data, size};
    memset(kept, 0, sizeof kept);
    memset(&so_far, 0, sizeof so_far);
    refused_after = 0;
    memory.stored = 0;
    HOLDS(pbmpm_set_log_callback(NULL, NULL) == PBMPM_OK);
    const uint8_t start = bytes_u8(&in);
    so_far.compares = start & 4;
    open_world(start);
    for (int call = 0; call < MOST_CALLS && in.left > 0; call++) {
        make_call(&in, bytes_u8(&in) % CALLS);
        while (array_count > 0) free(arrays[--array_count]);
    }
    HOLDS(pbmpm_shutdown() == PBMPM_OK);
    return 0;
}
