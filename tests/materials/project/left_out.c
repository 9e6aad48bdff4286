/* left_out MATERIAL - what is said and done by a library that has this material alone. */
#include <math.h>
#include <pbmpm/pbmpm.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void expect(int true_or_not, const char *what)
{
    if (true_or_not) return;
    fprintf(stderr, "left_out: not so: %s (%s)\n", what, pbmpm_last_error());
    exit(1);
}

static pbmpm_world_id open_world(int dimension, pbmpm_solver solver)
{
    pbmpm_world_def def;
    pbmpm_settings settings;
    pbmpm_world_id world;
    expect(!pbmpm_world_def_init(&def, sizeof def) && !pbmpm_settings_init(&settings, sizeof settings), "defaults");
    def.dimension = dimension;
    def.domain_enabled = 1;
    settings.gravity[1] = -9.81f;
    settings.solver = solver;
    expect(!pbmpm_world_create(&def, &world) && !pbmpm_world_set_settings(world, &settings), "a world");
    return world;
}

static pbmpm_result create(pbmpm_world_id world, int kind, pbmpm_material_id *material)
{
    pbmpm_material_def def;
    expect(!pbmpm_material_def_init(&def, sizeof def), "defaults of a material");
    def.kind = (pbmpm_material_kind)kind;
    def.bulk_modulus = 1e5f; /* for the explicit solver */
    return pbmpm_material_create(world, &def, material);
}

/* Every kind that the header has, and one that it has not. */
static void check_kinds(const char *const names[], int kinds, int built)
{
    const pbmpm_world_id world = open_world(2, PBMPM_SOLVER_PAPER);
    pbmpm_material_id material;
    expect(pbmpm_materials_built() == 1u << built, "the library tells what it was built with");
    for (int kind = 0; kind <= kinds; kind++) {
        const pbmpm_result result = create(world, kind, &material);
        expect((result == PBMPM_OK) == (kind == built), "the one material can be created, no other");
        if (kind == built) continue;
        expect(result == PBMPM_ERROR_UNSUPPORTED && material.generation == 0, "what is left out is unsupported");
        if (kind == kinds) continue;
        expect(strstr(pbmpm_last_error(), names[kind]) && strstr(pbmpm_last_error(), "PBMPM_MATERIALS"), "the message names material and option");
    }
    expect(!pbmpm_world_destroy(world), "the world ends");
}

/* A block falls to the floor: no particle is lost, and momentum is that of the fall until it lands. */
static void check_fall(int dimension, pbmpm_solver solver, int built)
{
    enum { STEPS = 12 };
    const double dt = 1.0 / 240.0;
    const pbmpm_world_id world = open_world(dimension, solver);
    pbmpm_fill_def fill;
    pbmpm_shape shape;
    pbmpm_stats stats = {.size = sizeof stats};
    expect(!pbmpm_fill_def_init(&fill, sizeof fill) && !pbmpm_shape_init(&shape, sizeof shape), "defaults of a filling");
    expect(!create(world, built, &fill.material), "the material");
    for (int a = 0; a < 3; a++) {
        shape.position[a] = 0.5f;
        shape.half_extents[a] = 0.2f;
    }
    expect(!pbmpm_particles_fill(world, &fill, &shape, NULL), "particles");
    for (int step = 0; step < STEPS; step++) expect(!pbmpm_world_step(world, (float)dt), "a step");
    expect(!pbmpm_world_get_stats(world, &stats), "statistics");
    expect(stats.particle_count == (dimension == 3 ? 512 : 64) && stats.deleted_total == 0, "all particles are there");
    expect(fabs(stats.momentum[1] + stats.mass * 9.81 * STEPS * dt) < 1e-4 * stats.mass, "they fall freely");
    for (int step = 0; step < 60; step++) expect(!pbmpm_world_step(world, (float)dt), "a step");
    expect(!pbmpm_world_get_stats(world, &stats), "statistics");
    expect(stats.deleted_total == 0 && stats.max_speed < 5.0f, "they land");
    expect(!pbmpm_world_destroy(world), "the world ends");
}

int main(int count, char **words)
{
    static const char *const names[] = {[PBMPM_LIQUID] = "liquid", [PBMPM_ELASTIC] = "elastic", [PBMPM_SAND] = "sand", [PBMPM_VISCO] = "visco"};
    enum { KINDS = sizeof names / sizeof *names };
    int built = 0;
    while (count == 2 && built < KINDS && strcmp(names[built], words[1]) != 0) built++;
    if (count != 2 || built == KINDS) return fprintf(stderr, "usage: left_out MATERIAL\n"), 2;
    check_kinds(names, KINDS, built);
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int solver = PBMPM_SOLVER_PAPER; solver <= PBMPM_SOLVER_CONVERGENT; solver++) check_fall(dimension, (pbmpm_solver)solver, built);
    return pbmpm_shutdown();
}
