/* What a substep takes over from the last one is what it would have found: a world that is made to forget before each step ends the same, bit for bit. */
#include <stdlib.h>
#include <unity.h>

#include "services/registry.h"
#include "world/world.h"

void setUp(void) {}
void tearDown(void) { pbmpm_shutdown(); }

#define OK(call) TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_OK, call, pbmpm_last_error())

/* A pool of 2 m with a box and a ball in it, off the grid. */
typedef struct Scene {
    pbmpm_world_id id;
    pbmpm_collider_id box, ball;
    char *saved; /* by save() */
    uint64_t bytes;
    World *world;
} Scene;

static pbmpm_shape shape_at(pbmpm_shape_kind kind, float x, float y, float size)
{
    pbmpm_shape shape;
    OK(pbmpm_shape_init(&shape, sizeof shape));
    shape.kind = kind;
    shape.position[0] = x;
    shape.position[1] = y;
    shape.radius = size;
    for (int a = 0; a < 3; a++) shape.half_extents[a] = size;
    return shape;
}

static pbmpm_collider_id add(pbmpm_world_id id, pbmpm_shape shape)
{
    pbmpm_collider_def def;
    pbmpm_collider_id collider;
    OK(pbmpm_collider_def_init(&def, sizeof def));
    def.kinematic = 1;
    OK(pbmpm_collider_create(id, &def, &shape, &collider));
    return collider;
}

static Scene open_scene(pbmpm_solver solver, float speed)
{
    Scene scene = {.saved = NULL};
    pbmpm_world_def def;
    pbmpm_settings settings;
    pbmpm_material_def liquid;
    pbmpm_fill_def fill;
    const pbmpm_shape full = shape_at(PBMPM_BOX, 1.0f, 0.0f, 0.8f);
    OK(pbmpm_world_def_init(&def, sizeof def));
    OK(pbmpm_settings_init(&settings, sizeof settings));
    OK(pbmpm_material_def_init(&liquid, sizeof liquid));
    OK(pbmpm_fill_def_init(&fill, sizeof fill));
    def.dimension = 2;
    def.cell_size = 0.05f;
    def.domain_enabled = 1;
    def.thread_count = 1;
    def.domain_max[0] = 2.03f;
    def.domain_max[1] = 2.0f;
    settings.gravity[1] = -9.81f;
    settings.solver = solver;
    fill.velocity[0] = speed;
    OK(pbmpm_world_create(&def, &scene.id));
    OK(pbmpm_world_set_settings(scene.id, &settings));
    scene.box = add(scene.id, shape_at(PBMPM_BOX, 0.517f, 0.203f, 0.15f));
    scene.ball = add(scene.id, shape_at(PBMPM_SPHERE, 1.424f, 0.397f, 0.2f));
    OK(pbmpm_material_create(scene.id, &liquid, &fill.material));
    OK(pbmpm_particles_fill(scene.id, &fill, &full, NULL));
    OK(registry_enter(scene.id, &scene.world));
    registry_leave(scene.id);
    return scene;
}

static void save(Scene *scene)
{
    OK(pbmpm_snapshot_size(scene->id, &scene->bytes, NULL));
    scene->saved = malloc(scene->bytes);
    TEST_ASSERT_NOT_NULL(scene->saved);
    OK(pbmpm_snapshot_save(scene->id, scene->saved, scene->bytes, NULL));
}

static uint64_t hash_of(const Scene *scene)
{
    uint64_t hash;
    OK(pbmpm_world_hash(scene->id, &hash));
    return hash;
}

/* Node blocks that take over. */
static int32_t taken_over(const Scene *scene)
{
    const ObstacleCache *cache = &scene->world->obstacle_cache[KIND_LIQUID];
    int32_t count = 0;
    for (int32_t block = 0; block < scene->world->grid.node_blocks; block++) count += ((const int32_t *)cache->from.data)[block] != GRID_NOWHERE;
    return count;
}

/* ---- What happens between two steps ---- */

typedef void Happening(Scene *scene, int step);

static void nothing(Scene *scene, int step) { (void)scene, (void)step; }

static void set_shape(Scene *scene, int step)
{
    const pbmpm_shape larger = shape_at(PBMPM_BOX, 0.517f, 0.203f, 0.18f);
    if (step == 6) OK(pbmpm_collider_set(scene->id, scene->box, &scene->world->colliders.slot[scene->box.index].def, &larger));
}

static void move(Scene *scene, int step)
{
    const float away[3] = {1.424f + 0.03f * (float)step, 0.397f, 0.0f};
    if (step >= 4 && step < 8) OK(pbmpm_collider_move(scene->id, scene->ball, away, NULL));
}

static void leap(Scene *scene, int step)
{
    const float away[3] = {1.01f, 0.4f, 0.0f};
    if (step == 6) OK(pbmpm_collider_teleport(scene->id, scene->ball, away, NULL));
}

static void take_away(Scene *scene, int step)
{
    if (step == 6) OK(pbmpm_collider_destroy(scene->id, scene->box)); /* the ball takes its place in the list */
}

static void put_in(Scene *scene, int step)
{
    if (step == 4 || step == 7) add(scene->id, shape_at(PBMPM_SPHERE, 0.2f * (float)step, 0.6f, 0.1f)); /* the second time there is room in the list */
}

static void open_wall(Scene *scene, int step)
{
    pbmpm_domain_wall wall = {.size = sizeof wall};
    if (step != 5 && step != 8) return;
    OK(pbmpm_domain_wall_get(scene->id, 0, 1, &wall));
    wall.open = step == 5;
    OK(pbmpm_domain_wall_set(scene->id, 0, 1, &wall));
}

static void shift(Scene *scene, int step)
{
    const double wanted[3] = {0.8, -0.4, 0.0};
    double moved[3];
    if (step == 6) OK(pbmpm_world_shift_origin(scene->id, wanted, moved));
}

static void go_back(Scene *scene, int step)
{
    const float away[3] = {1.01f, 0.4f, 0.0f};
    if (step == 3) save(scene);
    if (step == 5) OK(pbmpm_collider_teleport(scene->id, scene->ball, away, NULL));
    if (step == 8) OK(pbmpm_snapshot_restore(scene->id, scene->saved, scene->bytes, 0));
}

/* The lowest cell is then a whole block farther on. */
static void cut_off(Scene *scene, int step)
{
    pbmpm_shape left = shape_at(PBMPM_BOX, 0.0f, 0.0f, 0.35f);
    left.half_extents[1] = 2.0f;
    if (step == 6) OK(pbmpm_particles_remove_in(scene->id, &left, NULL));
}

static void change_solver(Scene *scene, int step)
{
    static const pbmpm_solver solvers[] = {PBMPM_SOLVER_PAPER, PBMPM_SOLVER_PRIMAL, PBMPM_SOLVER_DUAL, PBMPM_SOLVER_CONVERGENT};
    pbmpm_settings settings = scene->world->settings;
    settings.solver = solvers[step / 2 % 4];
    OK(pbmpm_world_set_settings(scene->id, &settings));
    const float *place = scene->world->colliders.slot[scene->ball.index].shape.position;
    OK(pbmpm_collider_move(scene->id, scene->ball, place, NULL)); /* what moves takes no room in the paper's */
}

/* ---- Two that go together ---- */

static void check_alike(Happening *happens, pbmpm_solver solver, float speed)
{
    Scene keeps = open_scene(solver, speed), forgets = open_scene(solver, speed);
    for (int step = 0; step < 12; step++) {
        happens(&keeps, step);
        happens(&forgets, step);
        for (int kinds = 0; kinds <= ISLAND_GROUPS; kinds++) obstacle_cache_forget(&forgets.world->obstacle_cache[kinds]);
        OK(pbmpm_world_step(keeps.id, 1.0f / 60));
        OK(pbmpm_world_step(forgets.id, 1.0f / 60));
        TEST_ASSERT_EQUAL_HEX64(hash_of(&forgets), hash_of(&keeps));
    }
    free(keeps.saved);
    free(forgets.saved);
    pbmpm_shutdown();
}

static void test_what_happens_to_obstacles(void)
{
    static Happening *const happenings[] = {nothing, set_shape, move, leap, take_away, put_in, open_wall, shift, go_back, cut_off, change_solver};
    for (size_t i = 0; i < sizeof happenings / sizeof *happenings; i++) check_alike(happenings[i], PBMPM_SOLVER_CONVERGENT, 0.0f);
}

static void test_all_solvers(void)
{
    static const pbmpm_solver solvers[] = {PBMPM_SOLVER_PAPER, PBMPM_SOLVER_DUAL, PBMPM_SOLVER_PRIMAL};
    for (size_t i = 0; i < sizeof solvers / sizeof *solvers; i++) check_alike(move, solvers[i], 0.0f);
}

/* Matter that leaves a wall: blocks are counted from its lowest cell. */
static void test_blocks_that_move_along(void)
{
    check_alike(nothing, PBMPM_SOLVER_CONVERGENT, 2.0f);
    check_alike(nothing, PBMPM_SOLVER_CONVERGENT, 12.0f);
}

/* All that stands is taken over; what moves costs the blocks that it is near to alone. */
static void test_how_much_is_taken_over(void)
{
    Scene scene = open_scene(PBMPM_SOLVER_CONVERGENT, 0.0f);
    const float away[3] = {1.45f, 0.42f, 0.0f};
    for (int step = 0; step < 3; step++) OK(pbmpm_world_step(scene.id, 1.0f / 60));
    const int32_t still = taken_over(&scene);
    TEST_ASSERT_GREATER_THAN_INT32(scene.world->grid.node_blocks * 3 / 4, still);
    OK(pbmpm_collider_move(scene.id, scene.ball, away, NULL));
    OK(pbmpm_world_step(scene.id, 1.0f / 60));
    TEST_ASSERT_LESS_THAN_INT32(still, taken_over(&scene));
    TEST_ASSERT_GREATER_THAN_INT32(0, taken_over(&scene));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_happens_to_obstacles);
    RUN_TEST(test_all_solvers);
    RUN_TEST(test_blocks_that_move_along);
    RUN_TEST(test_how_much_is_taken_over);
    return UNITY_END();
}
