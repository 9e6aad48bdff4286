/* What a surface takes over from the last one is what it would have found: one that is made to forget comes out the same, bit for bit. And blocks that rest cost nothing. */
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "random.h"
#include "services/registry.h"
#include "skin/state.h"
#include "world/world.h"

void setUp(void) {}
void tearDown(void) { pbmpm_shutdown(); }

#define OK(call) TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_OK, call, pbmpm_last_error())

/* ---- A pool with a film, a thread and a box in it ---- */

typedef struct Scene {
    pbmpm_world_id id;
    World *world;
    pbmpm_material_id water, jelly;
    pbmpm_collider_id box;
    pbmpm_surface_def def;
} Scene;

static pbmpm_shape shape_at(pbmpm_shape_kind kind, float x, float y, float z, float wide, float high)
{
    pbmpm_shape shape;
    OK(pbmpm_shape_init(&shape, sizeof shape));
    shape.kind = kind;
    shape.position[0] = x;
    shape.position[1] = y;
    shape.position[2] = z;
    shape.radius = shape.half_extents[0] = shape.half_extents[2] = wide;
    shape.half_extents[1] = high;
    return shape;
}

static void fill(const Scene *scene, pbmpm_material_id material, pbmpm_shape shape, float speed)
{
    pbmpm_fill_def def;
    OK(pbmpm_fill_def_init(&def, sizeof def));
    def.material = material;
    def.velocity[1] = -speed;
    OK(pbmpm_particles_fill(scene->id, &def, &shape, NULL));
}

static pbmpm_collider_id collide(const Scene *scene, pbmpm_shape shape)
{
    pbmpm_collider_def def;
    pbmpm_collider_id collider;
    OK(pbmpm_collider_def_init(&def, sizeof def));
    def.kinematic = 1;
    OK(pbmpm_collider_create(scene->id, &def, &shape, &collider));
    return collider;
}

static Scene open_scene(int32_t threads)
{
    Scene scene;
    pbmpm_world_def def;
    pbmpm_material_def material;
    memset(&scene, 0, sizeof scene);
    OK(pbmpm_world_def_init(&def, sizeof def));
    OK(pbmpm_material_def_init(&material, sizeof material));
    OK(pbmpm_surface_def_init(&scene.def, sizeof scene.def));
    def.cell_size = 0.1f;
    def.particle_capacity = 60000;
    def.domain_enabled = 1;
    def.thread_count = threads;
    for (int a = 0; a < 3; a++) {
        def.domain_min[a] = -1.65f;
        def.domain_max[a] = 1.65f;
    }
    OK(pbmpm_world_create(&def, &scene.id));
    OK(pbmpm_material_create(scene.id, &material, &scene.water));
    material.kind = PBMPM_ELASTIC;
    OK(pbmpm_material_create(scene.id, &material, &scene.jelly));
    OK(registry_enter(scene.id, &scene.world));
    registry_leave(scene.id);
    scene.box = collide(&scene, shape_at(PBMPM_BOX, -0.5f, -1.2f, 0.1f, 0.23f, 0.3f));
    fill(&scene, scene.water, shape_at(PBMPM_BOX, 0.0f, -1.45f, 0.0f, 1.65f, 0.2f), 0.0f);
    fill(&scene, scene.water, shape_at(PBMPM_BOX, 0.6f, 0.62f, -0.6f, 0.6f, 0.025f), 0.0f);
    fill(&scene, scene.jelly, shape_at(PBMPM_BOX, -0.8f, 0.3f, -0.9f, 0.025f, 0.6f), 0.0f);
    fill(&scene, scene.jelly, shape_at(PBMPM_SPHERE, 0.9f, 0.0f, 0.9f, 0.3f, 0.0f), 0.0f);
    return scene;
}

static void let_sleep(const Scene *scene)
{
    pbmpm_settings settings;
    OK(pbmpm_settings_init(&settings, sizeof settings));
    settings.sleeping = 1;
    settings.sleep_time = 0.03f;
    OK(pbmpm_world_set_settings(scene->id, &settings));
}

static void step(const Scene *scene) { OK(pbmpm_world_step(scene->id, 1.0f / 60)); }

/* ---- Meshes ---- */

typedef struct Mesh {
    pbmpm_surface_mesh counts;
    float *floats; /* nine per vertex */
    uint32_t *indices;
} Mesh;

static Mesh extract(const Scene *scene)
{
    Mesh mesh = {.counts = {.size = sizeof mesh.counts}};
    OK(pbmpm_surface_extract(scene->id, &scene->def, &mesh.counts));
    mesh.floats = calloc(9 * (size_t)mesh.counts.vertex_count + 1, sizeof *mesh.floats);
    mesh.indices = calloc(mesh.counts.index_count + 1, sizeof *mesh.indices);
    mesh.counts.vertex_capacity = mesh.counts.vertex_count;
    mesh.counts.index_capacity = mesh.counts.index_count;
    mesh.counts.positions = mesh.floats;
    mesh.counts.normals = mesh.floats + 3;
    mesh.counts.velocities = mesh.floats + 6;
    mesh.counts.stride = 9 * sizeof *mesh.floats;
    mesh.counts.indices = mesh.indices;
    OK(pbmpm_surface_extract(scene->id, &scene->def, &mesh.counts));
    return mesh;
}

static void give(Mesh *mesh)
{
    free(mesh->floats);
    free(mesh->indices);
}

static bool same(const Mesh *a, const Mesh *b)
{
    return a->counts.vertex_count == b->counts.vertex_count && a->counts.index_count == b->counts.index_count &&
           memcmp(a->floats, b->floats, 9 * sizeof(float) * a->counts.vertex_count) == 0 && memcmp(a->indices, b->indices, sizeof(uint32_t) * a->counts.index_count) == 0;
}

/* What is kept and what is made anew are the same. Returns how many blocks were worked on. */
static int32_t check(const Scene *scene)
{
    Mesh kept = extract(scene);
    const int32_t changed = scene->world->skin->changed;
    scene->world->skin->generation = 0;
    Mesh whole = extract(scene);
    TEST_ASSERT_EQUAL_INT(scene->world->skin->blocks.count, scene->world->skin->changed);
    TEST_ASSERT_TRUE_MESSAGE(same(&kept, &whole), "what is kept is not what is there");
    give(&kept);
    give(&whole);
    return changed;
}

/* Whether the surface is another one than before; and that it is the right one. */
static bool changes(const Scene *scene, Mesh *before)
{
    Mesh now = extract(scene);
    const bool other = !same(before, &now);
    give(before);
    *before = now;
    check(scene);
    return other;
}

/* ---- What rests ---- */

static void test_blocks_that_rest_are_not_worked_on(void)
{
    for (uint32_t subdivision = 1; subdivision <= 2; subdivision++) {
        Scene scene = open_scene(subdivision == 1 ? 1 : 3);
        scene.def.subdivision = subdivision;
        let_sleep(&scene);
        for (int i = 0; i < 6; i++) step(&scene);
        TEST_ASSERT_EQUAL_UINT32(scene.world->particles.count, scene.world->sleep.rows); /* without gravity all sleep */
        TEST_ASSERT_TRUE(check(&scene) > 0);
        step(&scene);
        TEST_ASSERT_EQUAL_INT(0, check(&scene));
        fill(&scene, scene.water, shape_at(PBMPM_BOX, 0.8f, -0.9f, -0.8f, 0.2f, 0.2f), 3.0f); /* into one corner of the pool */
        int calm = 0;
        for (int i = 0; i < 10; i++) {
            const uint32_t slept = scene.world->sleep.rows;
            step(&scene);
            const int32_t changed = check(&scene), blocks = scene.world->skin->blocks.count;
            TEST_ASSERT_TRUE(changed > 0);
            /* What wakes or falls asleep puts rows in another order, and the blocks of these are made anew. */
            if (scene.world->sleep.rows != slept || slept < scene.world->particles.count / 2) continue;
            calm++;
            TEST_ASSERT_TRUE(changed < (subdivision == 2 ? blocks / 2 : blocks)); /* with 1 a block is 8 cells wide, the pool 33 */
        }
        TEST_ASSERT_TRUE(calm > 0);
        OK(pbmpm_world_destroy(scene.id));
    }
}

/* ---- What changes it without a step ---- */

static void test_edits_of_particles(void)
{
    Scene scene = open_scene(1);
    Mesh mesh = extract(&scene);
    const int32_t all = check(&scene);
    fill(&scene, scene.water, shape_at(PBMPM_SPHERE, 1.2f, 1.2f, 1.2f, 0.2f, 0.0f), 0.0f);
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    const pbmpm_shape corner = shape_at(PBMPM_SPHERE, 1.5f, -1.3f, 1.5f, 0.3f, 0.0f);
    OK(pbmpm_particles_remove_in(scene.id, &corner, NULL)); /* rows move up, so what follows them is looked at once more, but comes out the same */
    TEST_ASSERT_TRUE(check(&scene) < all / 4);
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    const pbmpm_particle_id first = scene.world->particles.id[0];
    const float away[3] = {-1.2f, 1.0f, 1.2f};
    OK(pbmpm_particles_set(scene.id, PBMPM_POSITION, &first, 1, away));
    TEST_ASSERT_TRUE(check(&scene) < all / 4);
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    const float speed[3] = {0.1f, 0.0f, 0.0f};
    const pbmpm_particle_id second = scene.world->particles.id[1];
    OK(pbmpm_particles_set(scene.id, PBMPM_VELOCITY, &second, 1, speed));
    TEST_ASSERT_EQUAL_INT(0, check(&scene)); /* the velocities of vertices are not kept */
    give(&mesh);
}

static void set_groups(const Scene *scene, pbmpm_material_id id, uint32_t groups)
{
    pbmpm_material_def def = {.size = sizeof def};
    OK(pbmpm_material_get(scene->id, id, &def));
    def.groups = groups;
    OK(pbmpm_material_set(scene->id, id, &def));
}

static void test_edits_of_groups(void)
{
    Scene scene = open_scene(1);
    Mesh mesh = extract(&scene);
    pbmpm_collider_def def;
    OK(pbmpm_collider_def_init(&def, sizeof def));
    def.kinematic = 1;
    def.meets = 4; /* none of them */
    OK(pbmpm_collider_set(scene.id, scene.box, &def, NULL));
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    set_groups(&scene, scene.water, 4);
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    give(&mesh);
}

static void test_edits_of_obstacles(void)
{
    Scene scene = open_scene(1);
    Mesh mesh = extract(&scene);
    const int32_t all = check(&scene);
    const float beside[3] = {-0.4f, -1.2f, 0.1f};
    OK(pbmpm_collider_teleport(scene.id, scene.box, beside, NULL));
    TEST_ASSERT_TRUE(check(&scene) < all / 2);
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    const pbmpm_shape larger = shape_at(PBMPM_BOX, -0.4f, -1.2f, 0.1f, 0.3f, 0.3f);
    pbmpm_collider_def def;
    OK(pbmpm_collider_def_init(&def, sizeof def));
    def.kinematic = 1;
    OK(pbmpm_collider_set(scene.id, scene.box, &def, &larger));
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    const pbmpm_collider_id ball = collide(&scene, shape_at(PBMPM_SPHERE, 0.8f, -1.0f, 0.8f, 0.4f, 0.0f));
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    OK(pbmpm_collider_destroy(scene.id, scene.box)); /* the ball takes its place in the list */
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    OK(pbmpm_collider_destroy(scene.id, ball));
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    pbmpm_domain_wall wall = {.size = sizeof wall};
    OK(pbmpm_domain_wall_get(scene.id, 1, 0, &wall));
    wall.open = 1;
    OK(pbmpm_domain_wall_set(scene.id, 1, 0, &wall));
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    give(&mesh);
}

static void test_other_options(void)
{
    Scene scene = open_scene(1);
    Mesh mesh = extract(&scene);
    scene.def.level = 0.4f;
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    scene.def.keeps_thin = 0;
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    scene.def.subdivision = 1;
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    scene.def.materials = &scene.jelly;
    scene.def.material_count = 1;
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    give(&mesh);
}

static void test_other_states(void)
{
    Scene scene = open_scene(1);
    uint64_t bytes;
    Mesh mesh = extract(&scene);
    OK(pbmpm_snapshot_size(scene.id, &bytes, NULL));
    char *saved = malloc(bytes);
    OK(pbmpm_snapshot_save(scene.id, saved, bytes, NULL));
    fill(&scene, scene.water, shape_at(PBMPM_SPHERE, 1.2f, 1.2f, 1.2f, 0.2f, 0.0f), 5.0f);
    step(&scene);
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    OK(pbmpm_snapshot_restore(scene.id, saved, bytes, 0));
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    const double way[3] = {1.0, 0.0, -2.0};
    double moved[3];
    OK(pbmpm_world_shift_origin(scene.id, way, moved));
    TEST_ASSERT_TRUE(moved[0] != 0.0 || moved[2] != 0.0);
    TEST_ASSERT_TRUE(changes(&scene, &mesh));
    free(saved);
    give(&mesh);
}

/* Steps and edits in any order. */
static void test_anything(void)
{
    for (uint32_t seed = 1; seed <= 3; seed++) {
        Random random = {seed};
        Scene scene = open_scene(1 + (int32_t)seed % 2);
        if (seed == 2) let_sleep(&scene);
        scene.def.subdivision = 1 + seed % 2;
        for (int i = 0; i < 24; i++) {
            float at[3];
            for (int a = 0; a < 3; a++) at[a] = (float)random_in(&random, -1.4, 1.4);
            const double what = random_in(&random, 0.0, 6.0);
            const pbmpm_shape ball = shape_at(PBMPM_SPHERE, at[0], at[1], at[2], 0.25f, 0.0f);
            if (what < 1.0) fill(&scene, what < 0.5 ? scene.water : scene.jelly, ball, 2.0f);
            if (what > 1.0 && what < 2.0) OK(pbmpm_particles_remove_in(scene.id, &ball, NULL));
            if (what > 2.0 && what < 3.0) OK(pbmpm_collider_teleport(scene.id, scene.box, at, NULL));
            if (what > 3.0) step(&scene);
            check(&scene);
        }
        OK(pbmpm_world_destroy(scene.id));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_blocks_that_rest_are_not_worked_on);
    RUN_TEST(test_edits_of_particles);
    RUN_TEST(test_edits_of_groups);
    RUN_TEST(test_edits_of_obstacles);
    RUN_TEST(test_other_options);
    RUN_TEST(test_other_states);
    RUN_TEST(test_anything);
    return UNITY_END();
}
