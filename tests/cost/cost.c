/* A scene for cost.sh, which counts the instructions of measured_step() with callgrind.
 *
 * cost steps|memory MATTER SOLVER DIMENSION [unused]
 *
 * MATTER: the name of a material: a column of it that collapses in a closed box; lake: a pool with a hole; block: an elastic block where the
 * hole is; lake+block: both. SOLVER: paper, dual, primal or explicit. unused: the world also has one of everything else that a world
 * can have, switched off or without particles.
 *
 * steps: calls measured_step() with 5 iterations, and from the same state with 10; the difference is what iterations cost by themselves.
 * Prints the particles. memory: prints the bytes that a particle takes, its share of
 * the grid included: by how much this world and one of finer cells differ, per particle that the other has more. */
#include <pbmpm/pbmpm.h>
#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define DT (1.0f / 240.0f)
enum { WARM_STEPS = 1, ITERATIONS = 5 };

typedef struct Options {
    const char *matter;
    pbmpm_solver solver;
    int dimension;
    bool unused;
} Options;

static void ok(pbmpm_result result)
{
    if (result == PBMPM_OK) return;
    fprintf(stderr, "cost: %s: %s\n", pbmpm_result_name(result), pbmpm_last_error());
    exit(result == PBMPM_ERROR_UNSUPPORTED ? 3 : 1);
}

/* ---- The world ---- */

static pbmpm_material_id add_material(pbmpm_world_id world, pbmpm_material_kind kind)
{
    pbmpm_material_def def;
    pbmpm_material_id material;
    ok(pbmpm_material_def_init(&def, sizeof def));
    def.kind = kind;
    def.bulk_modulus = 1e5f; /* for the explicit solver */
    def.young_modulus = 2e4f;
    ok(pbmpm_material_create(world, &def, &material));
    return material;
}

static pbmpm_shape box(const float centre[3], const float half[3])
{
    pbmpm_shape shape;
    ok(pbmpm_shape_init(&shape, sizeof shape));
    memcpy(shape.position, centre, sizeof shape.position);
    memcpy(shape.half_extents, half, sizeof shape.half_extents);
    return shape;
}

static void fill(pbmpm_world_id world, pbmpm_material_id material, const pbmpm_shape *shape)
{
    pbmpm_fill_def def;
    ok(pbmpm_fill_def_init(&def, sizeof def));
    def.material = material;
    ok(pbmpm_particles_fill(world, &def, shape, NULL));
}

/* How many particles there will be, at most. */
static uint32_t capacity_of(const Options *options, float cell)
{
    const bool pool = strncmp(options->matter, "lake", 4) == 0;
    return (uint32_t)((pool ? 1.0 : 0.5) * pow(2.0 / (double)cell, options->dimension)) + 64;
}

static void set_iterations(pbmpm_world_id world, const Options *options, int iterations)
{
    pbmpm_settings settings;
    ok(pbmpm_settings_init(&settings, sizeof settings));
    settings.solver = options->solver;
    settings.iterations = iterations;
    settings.gravity[1] = -9.81f;
    ok(pbmpm_world_set_settings(world, &settings));
}

static pbmpm_world_id open_box(const Options *options, float cell)
{
    pbmpm_world_def def;
    pbmpm_world_id world;
    ok(pbmpm_world_def_init(&def, sizeof def));
    def.dimension = options->dimension;
    def.cell_size = cell;
    def.particle_capacity = capacity_of(options, cell);
    def.thread_count = 1;
    def.domain_enabled = 1;
    def.domain_max[0] = 2.0f;
    ok(pbmpm_world_create(&def, &world));
    set_iterations(world, options, ITERATIONS);
    return world;
}

static pbmpm_material_kind kind_named(const char *name)
{
    static const struct {
        const char *name;
        pbmpm_material_kind kind;
    } kinds[] = {{"liquid", PBMPM_LIQUID}, {"elastic", PBMPM_ELASTIC}, {"sand", PBMPM_SAND}, {"visco", PBMPM_VISCO}};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (strcmp(kinds[i].name, name) == 0) return kinds[i].kind;
    fprintf(stderr, "cost: there is no matter %s\n", name);
    exit(2);
}

/* A pool over the whole floor and a block in its surface that is as heavy as the liquid it takes the place of. */
static void fill_lake(pbmpm_world_id world, bool lake, bool block)
{
    const pbmpm_shape pool = box((const float[]){1.0f, 0.25f, 0.5f}, (const float[]){1.0f, 0.25f, 0.5f});
    const pbmpm_shape hole = box((const float[]){1.0f, 0.4f, 0.5f}, (const float[]){0.2f, 0.1f, 0.2f});
    if (lake) {
        fill(world, add_material(world, PBMPM_LIQUID), &pool);
        ok(pbmpm_particles_remove_in(world, &hole, NULL));
    }
    if (block) fill(world, add_material(world, PBMPM_ELASTIC), &hole);
}

static void add_matter(pbmpm_world_id world, const char *matter)
{
    const pbmpm_shape column = box((const float[]){0.5f, 0.25f, 0.5f}, (const float[]){0.5f, 0.25f, 0.5f});
    const bool both = strcmp(matter, "lake+block") == 0;
    if (both || strcmp(matter, "lake") == 0 || strcmp(matter, "block") == 0)
        fill_lake(world, both || strcmp(matter, "lake") == 0, both || strcmp(matter, "block") == 0);
    else
        fill(world, add_material(world, kind_named(matter)), &column);
}

/* ---- What is there and not used ---- */

static void add_unused_materials(pbmpm_world_id world)
{
    pbmpm_material_def def;
    pbmpm_material_id material;
    ok(pbmpm_material_def_init(&def, sizeof def));
    def.viscosity = 0.5f;
    def.kinematic_viscosity = 0.01f;
    def.bulk_modulus = 1e5f;
    def.relaxation = 0.5f;
    for (int kind = 0; kind < 32; kind++) {
        def.kind = (pbmpm_material_kind)kind;
        if (pbmpm_materials_built() >> kind & 1) ok(pbmpm_material_create(world, &def, &material));
    }
}

static void add_unused_baked(pbmpm_world_id world, int dimension)
{
    static const float heights[16] = {0.1f, 0.2f, 0.1f, 0.3f};
    pbmpm_heights_def def;
    pbmpm_baked_id baked;
    uint64_t bytes;
    ok(pbmpm_heights_def_init(&def, sizeof def));
    def.dimension = dimension;
    def.count[0] = def.count[1] = 4;
    def.heights = heights;
    ok(pbmpm_bake_heights(&def, NULL, 0, &bytes));
    void *buffer = malloc(bytes);
    ok(pbmpm_bake_heights(&def, buffer, bytes, &bytes));
    ok(pbmpm_baked_create(world, buffer, bytes, &baked));
    free(buffer);
}

static void add_unused(pbmpm_world_id world, int dimension)
{
    pbmpm_shape shape;
    pbmpm_emitter_def emitter;
    pbmpm_emitter_id emitter_id;
    pbmpm_drain_def drain;
    pbmpm_drain_id drain_id;
    pbmpm_force_def force;
    pbmpm_force_id force_id;
    add_unused_materials(world);
    add_unused_baked(world, dimension);
    ok(pbmpm_shape_init(&shape, sizeof shape));
    ok(pbmpm_emitter_def_init(&emitter, sizeof emitter));
    emitter.material = add_material(world, PBMPM_LIQUID);
    emitter.rate = 1.0f;
    emitter.enabled = 0;
    ok(pbmpm_emitter_create(world, &emitter, &shape, &emitter_id));
    ok(pbmpm_drain_def_init(&drain, sizeof drain));
    drain.enabled = 0;
    ok(pbmpm_drain_create(world, &drain, &shape, &drain_id));
    ok(pbmpm_force_def_init(&force, sizeof force));
    force.enabled = 0;
    ok(pbmpm_force_create(world, &force, &shape, &force_id));
}

/* ---- Measuring ---- */

static pbmpm_world_id open_scene(const Options *options, float cell)
{
    const pbmpm_world_id world = open_box(options, cell);
    add_matter(world, options->matter);
    if (options->unused) add_unused(world, options->dimension);
    for (int step = 0; step < WARM_STEPS; step++) ok(pbmpm_world_step(world, DT));
    return world;
}

/* The name that callgrind is told. */
void measured_step(pbmpm_world_id world);

__attribute__((noinline)) void measured_step(pbmpm_world_id world) { ok(pbmpm_world_step(world, DT)); }

static pbmpm_stats stats_of(pbmpm_world_id world)
{
    pbmpm_stats stats = {.size = sizeof stats};
    ok(pbmpm_world_get_stats(world, &stats));
    return stats;
}

static pbmpm_solver solver_named(const char *name)
{
    static const char *const names[] = {[PBMPM_SOLVER_PAPER] = "paper", [PBMPM_SOLVER_DUAL] = "dual",
                                        [PBMPM_SOLVER_PRIMAL] = "primal", [PBMPM_SOLVER_EXPLICIT] = "explicit"};
    for (int i = 0; i < (int)(sizeof names / sizeof *names); i++)
        if (strcmp(names[i], name) == 0) return (pbmpm_solver)i;
    fprintf(stderr, "cost: there is no solver %s\n", name);
    exit(2);
}

static void print_steps(const Options *options, float cell)
{
    const pbmpm_world_id world = open_scene(options, cell);
    uint64_t bytes;
    uint32_t each;
    ok(pbmpm_snapshot_size(world, &bytes, &each));
    void *state = malloc(bytes);
    ok(pbmpm_snapshot_save(world, state, bytes, &bytes));
    measured_step(world);
    ok(pbmpm_snapshot_restore(world, state, bytes, 0));
    free(state);
    set_iterations(world, options, 2 * ITERATIONS);
    measured_step(world);
    printf("%u\n", stats_of(world).particle_count);
}

static void print_memory(const Options *options, float cell)
{
    const pbmpm_stats coarse = stats_of(open_scene(options, cell)), fine = stats_of(open_scene(options, 0.75f * cell));
    printf("%.1f\n", (double)(fine.memory_bytes - coarse.memory_bytes) / (fine.particle_count - coarse.particle_count));
}

int main(int count, char **words)
{
    if (count < 5 || count > 6 || (count == 6 && strcmp(words[5], "unused") != 0))
        return fprintf(stderr, "usage: cost steps|memory MATTER SOLVER DIMENSION [unused]\n"), 2;
    const Options options = {words[2], solver_named(words[3]), atoi(words[4]), count == 6};
    const float cell = options.dimension == 3 ? 1.0f / 12.0f : 1.0f / 64.0f;
    if (strcmp(words[1], "steps") == 0)
        print_steps(&options, cell);
    else
        print_memory(&options, cell);
    return pbmpm_shutdown();
}
