/* Scenes whose hashes compare.sh compares between instruction sets: they are equal in a strict build (PBMPM_STRICT).
 *
 * hashes STEPS [SCENE [EVERY]]
 *
 * Prints one line per scene: its name, its particles after STEPS steps, and the hash of its state; with EVERY that many steps apart, to find the
 * first step in which two differ. SCENE: part of the names of those to run. Nothing here but the library computes: no functions of the C library. */
#include <pbmpm/pbmpm.h>
#include <inttypes.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void ok(pbmpm_result result)
{
    if (result == PBMPM_OK) return;
    fprintf(stderr, "hashes: %s: %s\n", pbmpm_result_name(result), pbmpm_last_error());
    exit(1);
}

/* ---- The catalogue ---- */

typedef enum Matter { NOTHING, WATER, OIL, SPRINGY, JELLY, RUBBER, CLAY, SAND, DAMP_SAND, MATTERS } Matter;

/* What stands or happens in a scene beside its matter. */
enum { BALL = 1, POST = 2, TERRAIN = 4, PADDLE = 8, TAP = 16, SINK = 32, FORCES = 64, SLEEP = 128, DROP = 256, ERROR_STOP = 512 };

typedef struct Body {
    Matter matter;
    float at[3], half[3]; /* a box */
    float velocity[3];
} Body;

enum { BODIES = 5 };

typedef struct Scene {
    const char *name;
    int dimension;
    pbmpm_solver solver;
    pbmpm_pressure pressure;
    pbmpm_integrator integrator;
    float flip;
    int rate, substeps, iterations;
    unsigned things;
    Body body[BODIES];
} Scene;

#define SOLVED(solver, pressure, integrator, flip) PBMPM_SOLVER_##solver, PBMPM_PRESSURE_##pressure, PBMPM_INTEGRATOR_##integrator, flip
#define BOX(matter, x, y, z, half_x, half_y, half_z) {matter, {x, y, z}, {half_x, half_y, half_z}, {0, 0, 0}}
#define THROWN(matter, x, y, z, half_x, half_y, half_z, vx, vy, vz) {matter, {x, y, z}, {half_x, half_y, half_z}, {vx, vy, vz}}
#define PLAIN(solver) SOLVED(solver, PARTICLES, EULER, 0)

/* All in a closed box of 1 m. */
static const Scene catalogue[] = {
    {"paper_dam_2d", 2, PLAIN(PAPER), 240, 1, 5, 0, {BOX(WATER, 0.2f, 0.4f, 0, 0.2f, 0.4f, 0)}},
    {"paper_all_2d", 2, PLAIN(PAPER), 240, 1, 5, PADDLE | BALL | TAP | SINK,
     {BOX(WATER, 0.15f, 0.3f, 0, 0.15f, 0.3f, 0), BOX(JELLY, 0.7f, 0.8f, 0, 0.1f, 0.1f, 0), BOX(SAND, 0.85f, 0.2f, 0, 0.15f, 0.2f, 0), BOX(CLAY, 0.45f, 0.75f, 0, 0.1f, 0.1f, 0)}},
    {"dual_dam_2d", 2, PLAIN(DUAL), 60, 1, 5, BALL, {BOX(WATER, 0.2f, 0.4f, 0, 0.2f, 0.4f, 0)}},
    {"dual_lively_2d", 2, SOLVED(DUAL, CELLS, EULER, 0.9f), 120, 1, 8, PADDLE, {BOX(WATER, 0.5f, 0.2f, 0, 0.5f, 0.2f, 0), BOX(JELLY, 0.6f, 0.7f, 0, 0.1f, 0.1f, 0)}},
    {"dual_oil_2d", 2, PLAIN(DUAL), 60, 2, 5, FORCES | POST,
     {BOX(WATER, 0.3f, 0.2f, 0, 0.3f, 0.2f, 0), BOX(OIL, 0.8f, 0.2f, 0, 0.2f, 0.2f, 0), BOX(SPRINGY, 0.5f, 0.6f, 0, 0.2f, 0.1f, 0)}},
    {"dual_sand_2d", 2, PLAIN(DUAL), 60, 1, 10, BALL, {BOX(SAND, 0.5f, 0.5f, 0, 0.15f, 0.4f, 0), BOX(DAMP_SAND, 0.85f, 0.3f, 0, 0.1f, 0.3f, 0)}},
    {"dual_hurled_2d", 2, PLAIN(DUAL), 60, 1, 5, 0,
     {THROWN(RUBBER, 0.3f, 0.5f, 0, 0.15f, 0.15f, 0, 20, 3, 0), THROWN(JELLY, 0.75f, 0.55f, 0, 0.15f, 0.15f, 0, -20, 0, 0)}},
    {"primal_bodies_2d", 2, SOLVED(PRIMAL, PARTICLES, BDF2, 0), 60, 1, 10, BALL,
     {THROWN(JELLY, 0.25f, 0.6f, 0, 0.15f, 0.15f, 0, 1, 0, 0), THROWN(RUBBER, 0.7f, 0.5f, 0, 0.2f, 0.1f, 0, -1, 2, 0)}},
    {"primal_flow_2d", 2, PLAIN(PRIMAL), 60, 1, 5, PADDLE,
     {BOX(SPRINGY, 0.5f, 0.1f, 0, 0.5f, 0.1f, 0), BOX(CLAY, 0.3f, 0.6f, 0, 0.1f, 0.3f, 0), BOX(SAND, 0.75f, 0.6f, 0, 0.1f, 0.2f, 0)}},
    {"convergent_all_2d", 2, PLAIN(CONVERGENT), 60, 1, 5, BALL | TERRAIN,
     {BOX(WATER, 0.2f, 0.4f, 0, 0.2f, 0.2f, 0), BOX(JELLY, 0.3f, 0.8f, 0, 0.1f, 0.1f, 0), BOX(SAND, 0.85f, 0.6f, 0, 0.1f, 0.2f, 0), BOX(CLAY, 0.6f, 0.75f, 0, 0.1f, 0.1f, 0)}},
    {"convergent_tap_2d", 2, SOLVED(CONVERGENT, PARTICLES, BDF2, 0.5f), 120, 1, 5, TAP | SINK | FORCES | PADDLE | ERROR_STOP,
     {BOX(WATER, 0.5f, 0.15f, 0, 0.5f, 0.15f, 0), BOX(JELLY, 0.25f, 0.6f, 0, 0.1f, 0.1f, 0)}},
    {"asleep_2d", 2, PLAIN(CONVERGENT), 60, 1, 5, SLEEP | DROP, {BOX(WATER, 0.5f, 0.2f, 0, 0.5f, 0.2f, 0)}},
    {"explicit_2d", 2, PLAIN(EXPLICIT), 480, 4, 1, BALL | PADDLE,
     {BOX(SPRINGY, 0.3f, 0.2f, 0, 0.3f, 0.2f, 0), BOX(JELLY, 0.75f, 0.6f, 0, 0.1f, 0.1f, 0), BOX(CLAY, 0.3f, 0.7f, 0, 0.1f, 0.1f, 0), BOX(SAND, 0.9f, 0.2f, 0, 0.1f, 0.2f, 0)}},
    {"paper_all_3d", 3, PLAIN(PAPER), 240, 1, 3, PADDLE | TAP,
     {BOX(WATER, 0.2f, 0.3f, 0.5f, 0.2f, 0.3f, 0.4f), BOX(JELLY, 0.7f, 0.8f, 0.5f, 0.15f, 0.15f, 0.2f), BOX(SAND, 0.85f, 0.2f, 0.5f, 0.15f, 0.2f, 0.3f)}},
    {"dual_dam_3d", 3, PLAIN(DUAL), 60, 1, 5, BALL, {BOX(WATER, 0.2f, 0.4f, 0.5f, 0.2f, 0.4f, 0.5f)}},
    {"dual_cells_3d", 3, SOLVED(DUAL, CELLS, EULER, 0), 60, 2, 5, PADDLE,
     {BOX(WATER, 0.3f, 0.2f, 0.5f, 0.3f, 0.2f, 0.5f), BOX(OIL, 0.8f, 0.2f, 0.5f, 0.2f, 0.2f, 0.5f), BOX(JELLY, 0.5f, 0.7f, 0.5f, 0.15f, 0.15f, 0.15f)}},
    {"dual_hurled_3d", 3, PLAIN(DUAL), 60, 1, 5, 0,
     {THROWN(RUBBER, 0.3f, 0.5f, 0.5f, 0.2f, 0.15f, 0.2f, 20, 3, 1), THROWN(JELLY, 0.75f, 0.55f, 0.4f, 0.15f, 0.15f, 0.2f, -20, 0, 0)}},
    {"primal_bodies_3d", 3, SOLVED(PRIMAL, PARTICLES, BDF2, 0), 60, 1, 5, POST,
     {THROWN(JELLY, 0.25f, 0.7f, 0.5f, 0.15f, 0.15f, 0.2f, 1, 0, 0), THROWN(RUBBER, 0.7f, 0.5f, 0.4f, 0.2f, 0.1f, 0.2f, -1, 2, 0), BOX(CLAY, 0.3f, 0.2f, 0.5f, 0.2f, 0.2f, 0.2f)}},
    {"convergent_all_3d", 3, PLAIN(CONVERGENT), 60, 1, 5, POST | FORCES | TAP | SINK,
     {BOX(WATER, 0.2f, 0.3f, 0.5f, 0.2f, 0.3f, 0.4f), BOX(JELLY, 0.3f, 0.8f, 0.5f, 0.15f, 0.15f, 0.2f), BOX(SAND, 0.85f, 0.3f, 0.5f, 0.1f, 0.3f, 0.3f)}},
    {"explicit_3d", 3, PLAIN(EXPLICIT), 240, 4, 1, BALL,
     {BOX(SPRINGY, 0.3f, 0.2f, 0.5f, 0.3f, 0.2f, 0.5f), BOX(JELLY, 0.75f, 0.6f, 0.5f, 0.15f, 0.1f, 0.15f), BOX(SAND, 0.85f, 0.2f, 0.5f, 0.15f, 0.2f, 0.3f)}},
};
enum { SCENES = sizeof catalogue / sizeof *catalogue };

/* ---- Building ---- */

static pbmpm_material_id material_of(pbmpm_world_id world, Matter matter)
{
    static const pbmpm_material_kind kinds[MATTERS] = {PBMPM_LIQUID, PBMPM_LIQUID, PBMPM_LIQUID, PBMPM_LIQUID, PBMPM_ELASTIC,
                                                       PBMPM_ELASTIC, PBMPM_VISCO, PBMPM_SAND, PBMPM_SAND};
    pbmpm_material_def def;
    pbmpm_material_id material;
    ok(pbmpm_material_def_init(&def, sizeof def));
    def.kind = kinds[matter];
    def.young_modulus = 5e4f;
    if (matter == OIL) {
        def.density = 700;
        def.kinematic_viscosity = 2e-3f;
    }
    if (matter == SPRINGY) def.bulk_modulus = 1e5f;
    if (matter == RUBBER) {
        def.elastic_model = PBMPM_NEO_HOOKEAN;
        def.density = 1300;
    }
    if (matter == DAMP_SAND) def.cohesion = 0.01f;
    ok(pbmpm_material_create(world, &def, &material));
    return material;
}

static pbmpm_shape shape_at(pbmpm_shape_kind kind, float x, float y, float z)
{
    pbmpm_shape shape;
    ok(pbmpm_shape_init(&shape, sizeof shape));
    shape.kind = kind;
    shape.position[0] = x;
    shape.position[1] = y;
    shape.position[2] = z;
    return shape;
}

static pbmpm_shape box_at(const float at[3], const float half[3])
{
    pbmpm_shape shape = shape_at(PBMPM_BOX, at[0], at[1], at[2]);
    for (int a = 0; a < 3; a++)
        if (half[a] > 0) shape.half_extents[a] = half[a];
    return shape;
}

static pbmpm_collider_id add_obstacle(pbmpm_world_id world, pbmpm_shape shape, bool moves)
{
    pbmpm_collider_def def;
    pbmpm_collider_id collider;
    ok(pbmpm_collider_def_init(&def, sizeof def));
    def.kinematic = moves;
    def.measures_impulse = moves;
    ok(pbmpm_collider_create(world, &def, &shape, &collider));
    return collider;
}

/* Hills, in 2D, baked. */
static void add_terrain(pbmpm_world_id world)
{
    static const float heights[] = {0.1f, 0.2f, 0.05f, 0.15f, 0.3f, 0.1f, 0.12f, 0.1f, 0.1f};
    pbmpm_heights_def def;
    pbmpm_shape shape = shape_at(PBMPM_BAKED, -0.2f, 0, 0);
    uint64_t bytes;
    ok(pbmpm_heights_def_init(&def, sizeof def));
    def.dimension = 2;
    def.heights = heights;
    def.count[0] = sizeof heights / sizeof *heights;
    def.spacing[0] = 0.2f;
    def.resolution = 64;
    ok(pbmpm_bake_heights(&def, NULL, 0, &bytes));
    void *solid = malloc((size_t)bytes);
    if (!solid) exit(1);
    ok(pbmpm_bake_heights(&def, solid, bytes, &bytes));
    ok(pbmpm_baked_create(world, solid, bytes, &shape.baked));
    free(solid);
    add_obstacle(world, shape, false);
}

static void add_force(pbmpm_world_id world, pbmpm_force_kind kind, float x, float y, float radius, float strength)
{
    pbmpm_force_def def;
    pbmpm_force_id force;
    ok(pbmpm_force_def_init(&def, sizeof def));
    def.kind = kind;
    def.everywhere = 0;
    pbmpm_shape ball = shape_at(PBMPM_SPHERE, x, y, 0.5f);
    ball.radius = radius;
    def.falloff = PBMPM_FALLOFF_SMOOTH;
    def.range = 0.2f;
    def.strength = strength;
    def.spin = 3;
    if (kind == PBMPM_FORCE_VORTEX) def.direction[2] = 1;
    ok(pbmpm_force_create(world, &def, &ball, &force));
}

static void add_forces(pbmpm_world_id world)
{
    add_force(world, PBMPM_FORCE_VORTEX, 0.4f, 0.3f, 0.2f, 20);
    add_force(world, PBMPM_FORCE_RADIAL, 0.8f, 0.3f, 0.1f, -15);
    add_force(world, PBMPM_FORCE_DRAG, 0.2f, 0.6f, 0.2f, 4);
    add_force(world, PBMPM_FORCE_GRAB, 0.6f, 0.7f, 0.05f, 1);
}

static void add_tap(pbmpm_world_id world, pbmpm_material_id water)
{
    pbmpm_emitter_def def;
    pbmpm_emitter_id emitter;
    ok(pbmpm_emitter_def_init(&def, sizeof def));
    def.material = water;
    pbmpm_shape nozzle = shape_at(PBMPM_SPHERE, 0.5f, 0.9f, 0.5f);
    nozzle.radius = 0.06f;
    def.region = PBMPM_EMIT_DISC;
    def.rate = 0.02f;
    def.speed = 1.5f;
    def.spread = 0.4f;
    def.direction[0] = 0.3f;
    ok(pbmpm_emitter_create(world, &def, &nozzle, &emitter));
    def.region = PBMPM_EMIT_VOLUME;
    nozzle.position[0] = 0.1f;
    def.budget = 200;
    ok(pbmpm_emitter_create(world, &def, &nozzle, &emitter));
}

static void add_sink(pbmpm_world_id world)
{
    pbmpm_drain_def def;
    pbmpm_drain_id drain;
    ok(pbmpm_drain_def_init(&def, sizeof def));
    pbmpm_shape hole = shape_at(PBMPM_SPHERE, 0.95f, 0.05f, 0.5f);
    hole.radius = 0.08f;
    ok(pbmpm_drain_create(world, &def, &hole, &drain));
}

static void settle(pbmpm_world_id world, const Scene *scene)
{
    pbmpm_settings settings;
    ok(pbmpm_settings_init(&settings, sizeof settings));
    settings.gravity[1] = -9.81f;
    settings.solver = scene->solver;
    settings.pressure = scene->pressure;
    settings.integrator = scene->integrator;
    settings.flip = scene->flip;
    settings.substeps = scene->substeps;
    settings.iterations = scene->iterations;
    if (scene->things & SLEEP) settings.sleeping = 1;
    if (scene->things & ERROR_STOP) settings.target_error = 1e-3f;
    ok(pbmpm_world_set_settings(world, &settings));
}

typedef struct Stage {
    pbmpm_world_id world;
    pbmpm_collider_id paddle;
    pbmpm_material_id water;
} Stage;

static void fill(pbmpm_world_id world, pbmpm_material_id material, const Body *body)
{
    pbmpm_fill_def def;
    ok(pbmpm_fill_def_init(&def, sizeof def));
    def.material = material;
    const pbmpm_shape box = box_at(body->at, body->half);
    memcpy(def.velocity, body->velocity, sizeof def.velocity);
    ok(pbmpm_particles_fill(world, &def, &box, NULL));
}

static Stage build(const Scene *scene)
{
    Stage stage;
    pbmpm_world_def def;
    ok(pbmpm_world_def_init(&def, sizeof def));
    def.dimension = scene->dimension;
    def.cell_size = scene->dimension == 2 ? 0.04f : 0.1f;
    def.particle_capacity = 16384;
    def.thread_count = 1;
    def.domain_enabled = 1;
    def.domain_friction = 0.3f;
    ok(pbmpm_world_create(&def, &stage.world));
    settle(stage.world, scene);
    if (scene->solver != PBMPM_SOLVER_EXPLICIT) stage.water = material_of(stage.world, WATER); /* it takes no liquid without a bulk modulus */
    for (const Body *body = scene->body; body < scene->body + BODIES && body->matter != NOTHING; body++)
        fill(stage.world, body->matter == WATER ? stage.water : material_of(stage.world, body->matter), body);
    if (scene->things & BALL) {
        pbmpm_shape ball = shape_at(PBMPM_SPHERE, 0.6f, 0.15f, 0.5f);
        ball.radius = 0.13f;
        add_obstacle(stage.world, ball, false);
    }
    if (scene->things & POST) {
        pbmpm_shape post = shape_at(PBMPM_CAPSULE, 0.55f, 0.3f, 0.5f);
        post.half_extents[0] = 0.1f;
        post.radius = 0.11f;
        post.rotation[2] = 0.6f;
        post.rotation[3] = 0.8f;
        add_obstacle(stage.world, post, false);
    }
    if (scene->things & TERRAIN) add_terrain(stage.world);
    if (scene->things & PADDLE) stage.paddle = add_obstacle(stage.world, box_at((const float[3]){0.3f, 0.2f, 0.5f}, (const float[3]){0.04f, 0.15f, 0.3f}), true);
    if (scene->things & TAP) add_tap(stage.world, stage.water);
    if (scene->things & SINK) add_sink(stage.world);
    if (scene->things & FORCES) add_forces(stage.world);
    return stage;
}

/* ---- Running ---- */

/* To and fro, leaning as it goes. */
static void move_paddle(const Stage *stage, int step)
{
    const float phase = (float)(step % 240) / 120.0f, swing = phase < 1 ? phase : 2 - phase; /* 0 to 1 and back */
    const float position[3] = {0.25f + 0.5f * swing, 0.2f, 0.5f}, rotation[4] = {0, 0, 0.2f * swing, 1};
    ok(pbmpm_collider_move(stage->world, stage->paddle, position, rotation));
}

static void report(const Scene *scene, pbmpm_world_id world, int step)
{
    uint64_t hash;
    pbmpm_stats stats = {.size = sizeof stats};
    ok(pbmpm_world_hash(world, &hash));
    ok(pbmpm_world_get_stats(world, &stats));
    printf("%-18s %5d steps %6u particles %016" PRIx64 "\n", scene->name, step, stats.particle_count, hash);
    fflush(stdout);
}

static void run(const Scene *scene, int steps, int every)
{
    static const Body drop = BOX(WATER, 0.5f, 0.7f, 0.5f, 0.05f, 0.05f, 0.05f);
    const Stage stage = build(scene);
    for (int step = 0; step < steps; step++) {
        if (scene->things & PADDLE) move_paddle(&stage, step);
        if (scene->things & DROP && step % 300 == 299) fill(stage.world, stage.water, &drop);
        ok(pbmpm_world_step(stage.world, 1.0f / (float)scene->rate));
        if (every && (step + 1) % every == 0) report(scene, stage.world, step + 1);
    }
    if (!every || steps % every) report(scene, stage.world, steps);
    ok(pbmpm_world_destroy(stage.world));
}

int main(int count, char **argument)
{
    const int steps = count > 1 ? atoi(argument[1]) : 0, every = count > 3 ? atoi(argument[3]) : 0;
    if (steps < 1 || every < 0) return fprintf(stderr, "usage: hashes STEPS [SCENE [EVERY]]\n"), 2;
    printf("kernels: %s, %s build\n", pbmpm_isa_name(pbmpm_active_isa()), pbmpm_build_is_strict() ? "strict" : "ordinary");
    for (int s = 0; s < SCENES; s++)
        if (count < 3 || strstr(catalogue[s].name, argument[2])) run(&catalogue[s], steps, every);
    return 0;
}
