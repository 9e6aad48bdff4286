/* Bit-identical results for any number of threads and any floating-point mode of the caller. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "scenes.h"

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

/* ---- number of threads ---- */

#ifdef PBMPM_SANITIZED
enum { STEPS = 20 }; /* some fifty times slower */
#else
enum { STEPS = 500 };
#endif
enum { CHECKS = 5, CHECK_EVERY = STEPS / CHECKS };

static void use_threads(pbmpm_world_def *def, void *user)
{
    def->thread_count = *(const int32_t *)user;
}

/* Runs a scene and notes the hash every so often; returns the largest number of shares it was cut into. */
static uint32_t run_hashed(const scene *plan, int32_t thread_count, uint64_t hashes[CHECKS])
{
    uint32_t shares = 0;
    const stage made = plan->build(use_threads, &thread_count);
    for (int check = 0; check < CHECKS; check++) {
        scene_run(plan, &made, check * CHECK_EVERY, (check + 1) * CHECK_EVERY);
        hashes[check] = world_hash(made.world);
        const pbmpm_stats stats = world_stats(made.world);
        shares = stats.thread_count > shares ? stats.thread_count : shares;
    }
    world_expect_finite(made.world, plan->name);
    OK(pbmpm_world_destroy(made.world));
    return shares;
}

static void test_any_number_of_threads_gives_the_same_hash(void)
{
    static const int32_t thread_counts[] = {2, 3, 4, 8};
    for (int s = 0; s < scene_count; s++) {
        uint64_t right[CHECKS], hashes[CHECKS];
        run_hashed(&scenes[s], 1, right);
        TEST_ASSERT_TRUE(right[0] != right[CHECKS - 1]);
        for (size_t t = 0; t < sizeof thread_counts / sizeof *thread_counts; t++) {
            const uint32_t shares = run_hashed(&scenes[s], thread_counts[t], hashes);
            char label[96];
            snprintf(label, sizeof label, "%s, %d threads (%u shares)", scenes[s].name, (int)thread_counts[t], (unsigned)shares);
            TEST_ASSERT_EQUAL_HEX64_ARRAY_MESSAGE(right, hashes, CHECKS, label);
            TEST_ASSERT_TRUE_MESSAGE(shares > 1, label);
        }
    }
}

/* ---- floating-point mode of the caller ---- */

static const unsigned modes[] = {
    HOST_USUAL, HOST_USUAL | HOST_FLUSH, HOST_USUAL | HOST_DOWN, HOST_USUAL | HOST_UP | HOST_FLUSH, HOST_USUAL | HOST_TO_ZERO, HOST_USUAL | HOST_FLAGS, HOST_TRAPS,
};
enum { MODES = sizeof modes / sizeof *modes };

/* Makes a call in the given mode; fails if the register is not the same afterwards. */
#define IN_MODE(mode, call)                                                                                                                  \
    do {                                                                                                                                     \
        const unsigned own_mode = host_float_mode();                                                                                              \
        host_set_float_mode(mode);                                                                                                                    \
        const pbmpm_result mode_result = (call);                                                                                             \
        const unsigned mode_after = host_float_mode();                                                                                            \
        host_set_float_mode(own_mode);                                                                                                                \
        support_expect(PBMPM_OK, mode_result, #call, __LINE__);                                                                              \
        TEST_ASSERT_EQUAL_HEX32_MESSAGE((mode), mode_after, #call);                                                                          \
    } while (0)

/* A life of a world in which each call that computes is made in the given mode. */
static uint64_t hash_in_mode(unsigned mode, int32_t thread_count)
{
    pbmpm_world_def def = default_world(3, 0.1f, 8192);
    pbmpm_settings settings = default_settings();
    pbmpm_material_def liquid = default_material(PBMPM_LIQUID), elastic = default_material(PBMPM_ELASTIC);
    pbmpm_collider_def obstacle = default_collider();
    pbmpm_shape slab = box_shape(0.1f, -0.8f, 0, 0.7f, 0.1f, 0.7f), ball = sphere_shape(0, 0, 0, 0.37f);
    pbmpm_collider_id collider;
    pbmpm_fill_def fill = default_fill((pbmpm_material_id){0, 0});
    pbmpm_world_id world;
    pbmpm_stats stats = {.size = sizeof stats};
    pbmpm_view view = {.size = sizeof view};
    const float position[3] = {0.31f, -0.77f, 0.1f}, rotation[4] = {0.1f, 0.2f, 0.3f, 1.0f};
    pbmpm_shape region = sphere_shape(0.3f, 0.3f, 0.3f, 0.21f);
    uint32_t count;
    uint64_t hash = 0;
    def.thread_count = thread_count;
    settings.gravity[1] = -9.81f;
    slab.rotation[0] = 0.3f;
    obstacle.kinematic = 1;
    IN_MODE(mode, pbmpm_world_create(&def, &world));
    IN_MODE(mode, pbmpm_world_set_settings(world, &settings));
    IN_MODE(mode, pbmpm_collider_create(world, &obstacle, &slab, &collider));
    IN_MODE(mode, pbmpm_material_create(world, &liquid, &fill.material));
    IN_MODE(mode, pbmpm_particles_fill(world, &fill, &ball, NULL));
    IN_MODE(mode, pbmpm_material_create(world, &elastic, &fill.material));
    ball.position[1] = 1.0f;
    IN_MODE(mode, pbmpm_particles_fill(world, &fill, &ball, NULL));
    for (int i = 0; i < 30; i++) {
        IN_MODE(mode, pbmpm_collider_move(world, collider, position, rotation));
        IN_MODE(mode, pbmpm_world_step(world, 1.0f / 90));
    }
    IN_MODE(mode, pbmpm_particles_remove_in(world, &region, &count));
    IN_MODE(mode, pbmpm_query_shape(world, &region, NULL, 0, &count));
    IN_MODE(mode, pbmpm_query_collider(world, collider, NULL, 0, &count));
    IN_MODE(mode, pbmpm_world_get_stats(world, &stats));
    IN_MODE(mode, pbmpm_particles_view(world, PBMPM_POSITION, &view));
    IN_MODE(mode, pbmpm_world_step(world, 1e-20f));
    IN_MODE(mode, pbmpm_world_hash(world, &hash));
    IN_MODE(mode, pbmpm_world_destroy(world));
    return hash;
}

static void test_any_mode_of_the_caller_gives_the_same_hash(void)
{
    const uint64_t right = hash_in_mode(modes[0], 1);
    for (int32_t thread_count = 1; thread_count <= 3; thread_count += 2)
        for (int i = 0; i < MODES; i++) {
            char label[64];
            snprintf(label, sizeof label, "mode %04x, %d threads", modes[i], (int)thread_count);
            TEST_ASSERT_EQUAL_HEX64_MESSAGE(right, hash_in_mode(modes[i], thread_count), label);
        }
}

/* Refused calls leave the register alone as well, and a NaN raises no trap in a caller that has not masked it. */
static void test_refusals_restore_the_mode(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL), none = {0, 0};
    const float nowhere[3] = {NAN, INFINITY, -1e38f};
    pbmpm_settings bad = default_settings();
    pbmpm_shape shape = sphere_shape(0.5f, 0.5f, 0, 0.1f);
    bad.gravity[0] = NAN;
    shape.radius = NAN;
    const pbmpm_view identity = view_of(world, PBMPM_PARTICLE);
    const pbmpm_particle_id id = {view_uint(&identity, 0, 0), view_uint(&identity, 0, 1)};
    for (int i = 0; i < MODES; i++) {
        const unsigned own = host_float_mode();
        host_set_float_mode(modes[i]);
        const pbmpm_result results[] = {
            pbmpm_world_step(none, 0.01f),
            pbmpm_world_create(NULL, NULL),
            pbmpm_world_step(world, nowhere[0]),
            pbmpm_world_set_settings(world, &bad),
            pbmpm_particles_remove_in(world, &shape, NULL),
            pbmpm_particles_set(world, PBMPM_POSITION, &id, 1, nowhere),
        };
        const unsigned after = host_float_mode();
        host_set_float_mode(own);
        TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_INVALID_ID, results[0]);
        for (int k = 1; k < 6; k++)
            TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_INVALID_ARGUMENT, results[k]);
        TEST_ASSERT_EQUAL_HEX32(modes[i], after);
    }
}

/* ---- functions of the host ---- */

static unsigned seen_in_host; /* the mode that the host's functions found, or'd together */
static int host_calls;

static void note_mode(void)
{
    seen_in_host |= host_float_mode();
    host_calls++;
}

static void *noting_allocate(size_t size, size_t alignment, void *user)
{
    (void)user;
    note_mode();
    return host_allocate(size, alignment);
}

static void noting_release(void *memory, size_t size, void *user)
{
    (void)size;
    (void)user;
    note_mode();
    host_release(memory);
}

static void *noting_enqueue(pbmpm_task *task, int32_t count, void *context, void *user)
{
    (void)user;
    note_mode();
    for (int32_t i = 0; i < count; i++)
        task(i, context);
    return NULL;
}

static void noting_finish(void *handle, void *user)
{
    (void)handle;
    (void)user;
    note_mode();
}

static void noting_log(pbmpm_log_level level, const char *message, void *user)
{
    (void)level;
    (void)message;
    (void)user;
    note_mode();
}

static void test_functions_of_the_host_run_in_its_mode(void)
{
    const unsigned own = host_float_mode() & ~(unsigned)HOST_FLAGS;
    pbmpm_world_def def = default_world(2, 0.05f, 8192);
    def.allocator = &(pbmpm_allocator){sizeof(pbmpm_allocator), noting_allocate, noting_release, NULL};
    def.tasks = &(pbmpm_task_hooks){sizeof(pbmpm_task_hooks), 0, noting_enqueue, noting_finish, NULL};
    def.thread_count = 2;
    seen_in_host = 0;
    host_calls = 0;
    OK(pbmpm_set_log_callback(noting_log, NULL));
    const pbmpm_world_id world = create_world(&def);
    fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0, 0, 0, 0.7f, 0.7f, 0), (const float[3]){0, 0, 0});
    OK(pbmpm_world_step(world, 1.0f / 60));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step(world, -1));
    OK(pbmpm_world_destroy(world));
    OK(pbmpm_set_log_callback(NULL, NULL));
    TEST_ASSERT_TRUE(host_calls > 20);
    TEST_ASSERT_EQUAL_HEX32(own, seen_in_host & ~(unsigned)HOST_FLAGS);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_any_number_of_threads_gives_the_same_hash);
    RUN_TEST(test_any_mode_of_the_caller_gives_the_same_hash);
    RUN_TEST(test_refusals_restore_the_mode);
    RUN_TEST(test_functions_of_the_host_run_in_its_mode);
    return UNITY_END();
}
