/* The library as a whole, worlds, settings and the step: each public call of base.h and world.h keeps its word. */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scenes.h"

static char seen_line[256];
static int seen_count;

void setUp(void)
{
    seen_count = 0;
}

void tearDown(void)
{
    pbmpm_set_log_callback(NULL, NULL);
    pbmpm_shutdown();
}

/* ---- base.h ---- */

static void test_versions_agree_with_the_headers(void)
{
    const uint32_t expected = PBMPM_VERSION_MAJOR * 1000000u + PBMPM_VERSION_MINOR * 1000u + PBMPM_VERSION_PATCH;
    TEST_ASSERT_EQUAL_UINT32(expected, pbmpm_version());
    TEST_ASSERT_EQUAL_UINT32(PBMPM_ABI_VERSION, pbmpm_abi_version());
}

static void test_every_result_has_its_name(void)
{
    static const struct {
        pbmpm_result result;
        const char *name;
    } rows[] = {
        {PBMPM_OK, "PBMPM_OK"},
        {PBMPM_ERROR_INVALID_ARGUMENT, "PBMPM_ERROR_INVALID_ARGUMENT"},
        {PBMPM_ERROR_INVALID_ID, "PBMPM_ERROR_INVALID_ID"},
        {PBMPM_ERROR_OUT_OF_MEMORY, "PBMPM_ERROR_OUT_OF_MEMORY"},
        {PBMPM_ERROR_CAPACITY, "PBMPM_ERROR_CAPACITY"},
        {PBMPM_ERROR_BUSY, "PBMPM_ERROR_BUSY"},
        {PBMPM_ERROR_UNSUPPORTED_CPU, "PBMPM_ERROR_UNSUPPORTED_CPU"},
        {PBMPM_ERROR_UNSUPPORTED, "PBMPM_ERROR_UNSUPPORTED"},
        {PBMPM_ERROR_THREAD, "PBMPM_ERROR_THREAD"},
        {PBMPM_ERROR_IN_USE, "PBMPM_ERROR_IN_USE"},
        {PBMPM_ERROR_FORKED, "PBMPM_ERROR_FORKED"},
        {PBMPM_ERROR_DAMAGED, "PBMPM_ERROR_DAMAGED"},
        {PBMPM_ERROR_FOREIGN, "PBMPM_ERROR_FOREIGN"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        TEST_ASSERT_EQUAL_STRING(rows[i].name, pbmpm_result_name(rows[i].result));
    TEST_ASSERT_NOT_NULL(pbmpm_result_name((pbmpm_result)999));
    TEST_ASSERT_NOT_NULL(pbmpm_result_name((pbmpm_result)-1));
}

static void test_instruction_sets_have_names(void)
{
    const pbmpm_isa active = pbmpm_active_isa();
    TEST_ASSERT_TRUE(active >= PBMPM_ISA_SSE4 && active <= PBMPM_ISA_WASM);
    TEST_ASSERT_EQUAL_STRING("AVX2", pbmpm_isa_name(PBMPM_ISA_AVX2));
    for (int isa = PBMPM_ISA_NONE; isa < PBMPM_ISA_WASM; isa++)
        TEST_ASSERT_TRUE(strcmp(pbmpm_isa_name((pbmpm_isa)isa), pbmpm_isa_name((pbmpm_isa)(isa + 1))) != 0);
    TEST_ASSERT_NOT_NULL(pbmpm_isa_name((pbmpm_isa)77));
}

static void test_all_materials_are_built(void)
{
    TEST_ASSERT_EQUAL_HEX32(1u << PBMPM_LIQUID | 1u << PBMPM_ELASTIC | 1u << PBMPM_SAND | 1u << PBMPM_VISCO, pbmpm_materials_built());
}

static void *fail_on_another_thread(void *message)
{
    pbmpm_world_id none = {0, 0};
    *(bool *)message = pbmpm_last_error()[0] == '\0'; /* a fresh thread has no message */
    pbmpm_world_step(none, 1.0f);
    *(bool *)message = *(bool *)message && pbmpm_last_error()[0] != '\0';
    return NULL;
}

static void test_last_error_belongs_to_the_thread(void)
{
    char before[256];
    bool other_is_right = false;
    pthread_t other;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_create(NULL, NULL));
    snprintf(before, sizeof before, "%s", pbmpm_last_error());
    TEST_ASSERT_TRUE(strlen(before) > 0);
    TEST_ASSERT_EQUAL_INT(0, pthread_create(&other, NULL, fail_on_another_thread, &other_is_right));
    pthread_join(other, NULL);
    TEST_ASSERT_TRUE(other_is_right);
    TEST_ASSERT_EQUAL_STRING(before, pbmpm_last_error());
    default_settings(); /* a call that succeeds leaves the message alone */
    TEST_ASSERT_EQUAL_STRING(before, pbmpm_last_error());
}

/* A message tells the figures that it is about. */
static void test_last_error_tells_figures(void)
{
    static const float positions[2 * 23];
    const pbmpm_world_def def = default_world(2, 0.1f, 17);
    const pbmpm_world_id world = create_world(&def);
    pbmpm_particles_def particles;
    OK(pbmpm_particles_def_init(&particles, sizeof particles));
    particles.material = create_material(world, PBMPM_LIQUID);
    particles.positions = positions;
    particles.count = 5;
    OK(pbmpm_particles_add(world, &particles, NULL));
    particles.count = 23;
    EXPECT(PBMPM_ERROR_CAPACITY, pbmpm_particles_add(world, &particles, NULL));
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(pbmpm_last_error(), "23"), pbmpm_last_error());
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(pbmpm_last_error(), "5 of 17"), pbmpm_last_error());
}

static pbmpm_log_level seen_level;

static void remember_line(pbmpm_log_level level, const char *line, void *user)
{
    snprintf(seen_line, sizeof seen_line, "%s", line);
    seen_level = level;
    seen_count += *(int *)user;
}

static void test_log_callback_gets_refused_calls(void)
{
    int step = 1;
    OK(pbmpm_set_log_callback(remember_line, &step));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_create(NULL, NULL));
    TEST_ASSERT_EQUAL_INT(1, seen_count);
    TEST_ASSERT_EQUAL_INT(PBMPM_LOG_ERROR, seen_level);
    TEST_ASSERT_TRUE(strlen(seen_line) > 0);
    TEST_ASSERT_NULL(strchr(seen_line, '\n'));
    const pbmpm_world_def def = default_world(2, 0.1f, 10);
    create_world(&def);
    TEST_ASSERT_EQUAL_INT(PBMPM_LOG_INFO, seen_level);
    TEST_ASSERT_NOT_NULL(strstr(seen_line, "2D"));
    OK(pbmpm_set_log_callback(NULL, NULL));
    seen_count = 0;
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_create(NULL, NULL));
    TEST_ASSERT_EQUAL_INT(0, seen_count);
}

static int32_t go_on(const char *condition, const char *file, int32_t line, void *user)
{
    (void)condition, (void)file, (void)line, (void)user;
    return 0;
}

/* A host hears whether its callback can ever be called. */
static void test_assert_callback_is_taken_by_builds_with_assertions(void)
{
#ifdef PBMPM_ASSERTS
    OK(pbmpm_set_assert_callback(go_on, NULL));
    OK(pbmpm_set_assert_callback(NULL, NULL));
#else
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_set_assert_callback(go_on, NULL));
    TEST_ASSERT_NOT_NULL(strstr(pbmpm_last_error(), "PBMPM_ASSERTS"));
#endif
}

/* What happens in a step is told with its figures: here three particles are strained beyond what their material bears. */
static void test_log_callback_gets_what_a_step_deletes(void)
{
    const float positions[6] = {0, 0, 5, 0, 0, 5}, torn[12] = {5000, 0, 0, 1e-3f, 5000, 0, 0, 1e-3f, 5000, 0, 0, 1e-3f};
    const pbmpm_world_def def = default_world(2, 1.0f, 10);
    const pbmpm_world_id world = create_world(&def);
    pbmpm_material_def jelly = default_material(PBMPM_ELASTIC);
    pbmpm_particles_def particles;
    int step = 1;
    jelly.strain_policy = PBMPM_STRAIN_DELETE;
    set_solver(world, PBMPM_SOLVER_DUAL);
    OK(pbmpm_particles_def_init(&particles, sizeof particles));
    OK(pbmpm_material_create(world, &jelly, &particles.material));
    particles.positions = positions;
    particles.count = 3;
    OK(pbmpm_particles_add(world, &particles, NULL));
    OK(pbmpm_particles_set(world, PBMPM_DEFORMATION, NULL, 3, torn));
    OK(pbmpm_set_log_callback(remember_line, &step));
    OK(pbmpm_world_step(world, 1.0f / 60));
    TEST_ASSERT_EQUAL_UINT32(0, world_count(world));
    TEST_ASSERT_EQUAL_INT(1, seen_count);
    TEST_ASSERT_EQUAL_INT(PBMPM_LOG_WARNING, seen_level);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(seen_line, "3 particles"), seen_line);
}

/* Functions of the host run in the floating-point mode that the host has, and find it again afterwards. */
static uint32_t mode_seen;

static void *allocate_and_look(size_t size, size_t alignment, void *user)
{
    (void)user;
    mode_seen = host_float_mode() & ~(unsigned)HOST_FLAGS;
    return host_allocate(size, alignment);
}

static void release_and_look(void *memory, size_t size, void *user)
{
    (void)size;
    (void)user;
    mode_seen = host_float_mode() & ~(unsigned)HOST_FLAGS;
    host_release(memory);
}

static void look_at_line(pbmpm_log_level level, const char *line, void *user)
{
    (void)level;
    (void)line;
    (void)user;
    mode_seen = host_float_mode() & ~(unsigned)HOST_FLAGS;
}

static void test_functions_of_the_host_keep_its_float_mode(void)
{
    enum { UPWARD = HOST_USUAL | HOST_UP };
    const uint32_t own = host_float_mode();
    const pbmpm_allocator allocator = {sizeof allocator, allocate_and_look, release_and_look, NULL};
    pbmpm_world_def def = default_world(2, 0.1f, 10);
    pbmpm_world_id world;
    uint32_t seen[3];
    def.allocator = &allocator;
    host_set_float_mode(UPWARD);
    const pbmpm_result created = pbmpm_world_create(&def, &world);
    seen[0] = mode_seen;
    mode_seen = 0;
    pbmpm_set_log_callback(look_at_line, NULL);
    pbmpm_world_step(world, -1.0f);
    seen[1] = mode_seen;
    mode_seen = 0;
    pbmpm_world_destroy(world);
    seen[2] = mode_seen;
    const uint32_t left = host_float_mode();
    host_set_float_mode(own);
    OK(created);
    for (int i = 0; i < 3; i++) TEST_ASSERT_EQUAL_HEX32(UPWARD, seen[i]);
    TEST_ASSERT_EQUAL_HEX32(UPWARD, left & ~(unsigned)HOST_FLAGS);
}

static void test_shutdown_destroys_worlds_and_allows_a_new_start(void)
{
    static ledger book;
    book = (ledger){0};
    pbmpm_world_def def = default_world(2, 0.1f, 100);
    def.allocator = ledger_allocator(&book);
    def.thread_count = 3;
    const pbmpm_world_id first = create_world(&def);
    const pbmpm_world_id second = create_world(&def);
    TEST_ASSERT_TRUE(book.live_blocks > 0);
    OK(pbmpm_shutdown());
    ledger_expect_clean(&book, "after shutdown");
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_world_step(first, 0.01f));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_world_destroy(second));
    OK(pbmpm_shutdown());
    const pbmpm_world_id again = create_world(&def);
    OK(pbmpm_world_step(again, 0.01f));
    OK(pbmpm_world_destroy(again));
    ledger_expect_clean(&book, "after the new start");
}

/* ---- world.h: definitions ---- */

static void test_world_def_has_the_documented_defaults(void)
{
    pbmpm_world_def def;
    memset(&def, 0xA5, sizeof def);
    OK(pbmpm_world_def_init(&def, sizeof def));
    TEST_ASSERT_EQUAL_UINT32(sizeof def, def.size);
    TEST_ASSERT_EQUAL_INT32(3, def.dimension);
    TEST_ASSERT_EQUAL_FLOAT(0.1f, def.cell_size);
    TEST_ASSERT_EQUAL_UINT32(65536, def.particle_capacity);
    for (int a = 0; a < 3; a++) {
        TEST_ASSERT_TRUE(def.origin[a] == 0.0);
        TEST_ASSERT_TRUE(def.domain_min[a] == 0.0f);
        TEST_ASSERT_TRUE(def.domain_max[a] == 1.0f);
    }
    TEST_ASSERT_EQUAL_UINT64(0, def.memory_budget);
    TEST_ASSERT_EQUAL_INT32(0, def.thread_count);
    TEST_ASSERT_EQUAL_INT32(0, def.domain_enabled);
    TEST_ASSERT_TRUE(def.domain_friction == 0.0f);
    TEST_ASSERT_TRUE(!def.allocator && !def.tasks);
    TEST_ASSERT_EQUAL_INT32(0, def.domain_measures_impulse);
    TEST_ASSERT_EQUAL_UINT64(0, def.user_data);
}

static void test_settings_have_the_documented_defaults(void)
{
    pbmpm_settings settings;
    memset(&settings, 0xA5, sizeof settings);
    OK(pbmpm_settings_init(&settings, sizeof settings));
    TEST_ASSERT_EQUAL_UINT32(sizeof settings, settings.size);
    TEST_ASSERT_EQUAL_INT32(1, settings.substeps);
    TEST_ASSERT_EQUAL_INT32(5, settings.iterations);
    for (int a = 0; a < 3; a++)
        TEST_ASSERT_TRUE(settings.gravity[a] == 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(32.0f, settings.max_displacement);
}

static void test_world_returns_its_definition(void)
{
    pbmpm_world_def def = default_world(2, 0.25f, 77), read;
    def.origin[0] = 1e7;
    def.origin[2] = -3.5;
    def.memory_budget = 1u << 28;
    def.thread_count = 2;
    def.domain_enabled = 1;
    def.domain_max[0] = 9;
    def.domain_max[1] = 5;
    def.domain_friction = 0.25f;
    def.user_data = UINT64_MAX;
    const pbmpm_world_id world = create_world(&def);
    OK(pbmpm_world_def_init(&read, sizeof read));
    OK(pbmpm_world_get_def(world, &read));
    TEST_ASSERT_EQUAL_MEMORY(&def, &read, sizeof read); /* it has no padding */
}

static void *enqueue_at_once(pbmpm_task *task, int32_t count, void *context, void *user)
{
    (void)user;
    for (int32_t i = 0; i < count; i++)
        task(i, context);
    return NULL;
}

static void finish_nothing(void *handle, void *user)
{
    (void)handle, (void)user;
}

/* A world makes copies: the host's structures need not outlive the creation. */
static void test_world_returns_its_own_allocator_and_hooks(void)
{
    static ledger book;
    static pbmpm_task_hooks hooks;
    book = (ledger){0};
    hooks = (pbmpm_task_hooks){sizeof hooks, 0, enqueue_at_once, finish_nothing, &hooks};
    pbmpm_world_def def = default_world(2, 0.1f, 100), read = {.size = sizeof read};
    def.allocator = ledger_allocator(&book);
    def.tasks = &hooks;
    def.thread_count = 2;
    const pbmpm_allocator allocator = book.allocator;
    const pbmpm_task_hooks tasks = hooks;
    const pbmpm_world_id world = create_world(&def);
    memset(&book.allocator, 0xA5, sizeof allocator);
    memset(&hooks, 0xA5, sizeof hooks);
    OK(pbmpm_world_step(world, 0.01f));
    OK(pbmpm_world_get_def(world, &read));
    TEST_ASSERT_TRUE(read.allocator != def.allocator && read.tasks != def.tasks);
    TEST_ASSERT_EQUAL_UINT32(sizeof allocator, read.allocator->size);
    TEST_ASSERT_TRUE(read.allocator->allocate == allocator.allocate && read.allocator->release == allocator.release);
    TEST_ASSERT_EQUAL_PTR(&book, read.allocator->user);
    TEST_ASSERT_EQUAL_UINT32(sizeof tasks, read.tasks->size);
    TEST_ASSERT_TRUE(read.tasks->enqueue == tasks.enqueue && read.tasks->finish == tasks.finish && read.tasks->user == tasks.user);
    const pbmpm_world_id twin = create_world(&read); /* what was read makes another one */
    OK(pbmpm_world_destroy(world));
    OK(pbmpm_world_step(twin, 0.01f));
    OK(pbmpm_world_destroy(twin));
    ledger_expect_clean(&book, "a copy of the allocator");
}

static void test_world_identifiers_are_never_reused(void)
{
    enum { ROUNDS = 300 };
    static pbmpm_world_id ids[ROUNDS];
    const pbmpm_world_def def = default_world(2, 0.1f, 1);
    for (int i = 0; i < ROUNDS; i++) {
        ids[i] = create_world(&def);
        TEST_ASSERT_TRUE(ids[i].generation != 0 || ids[i].index != 0);
        OK(pbmpm_world_destroy(ids[i]));
        EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_world_destroy(ids[i]));
    }
    for (int i = 0; i < ROUNDS; i++)
        for (int j = i + 1; j < ROUNDS; j++)
            TEST_ASSERT_TRUE(ids[i].generation != ids[j].generation);
}

static void test_failed_creation_gives_the_null_identifier(void)
{
    pbmpm_world_def def = default_world(2, -1.0f, 10);
    pbmpm_world_id world = {123, 456};
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_create(&def, &world));
    TEST_ASSERT_EQUAL_UINT32(0, world.index);
    TEST_ASSERT_EQUAL_UINT32(0, world.generation);
}

/* ---- world.h: settings and the step ---- */

static void test_settings_are_read_back(void)
{
    const pbmpm_world_def def = default_world(3, 0.1f, 10);
    const pbmpm_world_id world = create_world(&def);
    pbmpm_settings written = default_settings(), read = default_settings();
    OK(pbmpm_world_get_settings(world, &read));
    TEST_ASSERT_EQUAL_MEMORY(&written, &read, sizeof read);
    written.substeps = PBMPM_MAX_SUBSTEPS;
    written.iterations = PBMPM_MAX_ITERATIONS;
    written.gravity[0] = 1;
    written.gravity[1] = -2;
    written.gravity[2] = 3;
    written.max_displacement = 0.1f;
    OK(pbmpm_world_set_settings(world, &written));
    OK(pbmpm_world_get_settings(world, &read));
    TEST_ASSERT_EQUAL_MEMORY(&written, &read, sizeof read);
}

static void test_steps_are_counted_and_cut_into_substeps(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    set_rate(world, 4, 3);
    OK(pbmpm_world_step(world, 0.02f));
    OK(pbmpm_world_step(world, 0.01f));
    const pbmpm_stats stats = world_stats(world);
    TEST_ASSERT_EQUAL_UINT64(2, stats.step_count);
    TEST_ASSERT_EQUAL_UINT32(4, stats.substeps);
    TEST_ASSERT_EQUAL_UINT32(3, stats.iterations);
    TEST_ASSERT_DOUBLE_WITHIN(1e-8, 0.03, stats.simulated_seconds);
}

/* One step of four substeps is the same as four steps of a quarter. */
static void test_substeps_equal_shorter_steps(void)
{
    const pbmpm_world_id whole = tank_2d(NULL, NULL);
    const pbmpm_world_id parts = tank_2d(NULL, NULL);
    set_rate(whole, 4, 2);
    set_rate(parts, 1, 2);
    for (int i = 0; i < 5; i++) {
        OK(pbmpm_world_step(whole, 0.03125f));
        for (int part = 0; part < 4; part++)
            OK(pbmpm_world_step(parts, 0.0078125f));
    }
    TEST_ASSERT_EQUAL_HEX64(world_hash(parts), world_hash(whole));
}

static void test_an_empty_world_steps(void)
{
    const pbmpm_world_def def = default_world(3, 0.1f, 10);
    const pbmpm_world_id world = create_world(&def);
    OK(pbmpm_world_step(world, 0.01f));
    TEST_ASSERT_EQUAL_UINT32(0, world_count(world));
    const pbmpm_view view = view_of(world, PBMPM_POSITION);
    TEST_ASSERT_EQUAL_UINT32(0, view.count);
    TEST_ASSERT_NULL(view.data);
}

static void test_generation_changes_with_the_particles_only(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    uint64_t first = 0, second = 0;
    OK(pbmpm_world_generation(world, &first));
    world_stats(world);
    world_hash(world);
    view_of(world, PBMPM_VELOCITY);
    OK(pbmpm_world_generation(world, &second));
    TEST_ASSERT_EQUAL_UINT64(first, second);
    TEST_ASSERT_EQUAL_UINT64(first, view_of(world, PBMPM_POSITION).generation);
    OK(pbmpm_world_step(world, 0.01f));
    OK(pbmpm_world_generation(world, &second));
    TEST_ASSERT_TRUE(first != second);
}

/* The hash sees every particle and each of its quantities. */
static void test_hash_sees_the_state(void)
{
    const pbmpm_world_id world = block_2d(NULL, NULL);
    const pbmpm_view view = view_of(world, PBMPM_PARTICLE);
    const pbmpm_particle_id last = {view_uint(&view, view.count - 1, 0), view_uint(&view, view.count - 1, 1)};
    static const pbmpm_field fields[] = {PBMPM_POSITION, PBMPM_VELOCITY, PBMPM_AFFINE_VELOCITY, PBMPM_DEFORMATION};
    for (size_t f = 0; f < sizeof fields / sizeof *fields; f++) {
        const float values[4] = {0.0625f, 0.03125f, 0.015625f, 0.875f};
        const uint64_t before = world_hash(world);
        OK(pbmpm_particles_set(world, fields[f], &last, 1, values));
        TEST_ASSERT_TRUE(before != world_hash(world));
    }
    TEST_ASSERT_EQUAL_HEX64(world_hash(world), world_hash(world));
}

static void test_equal_calls_give_equal_hashes_and_unequal_ones_do_not(void)
{
    const pbmpm_world_id one = tank_2d(NULL, NULL), two = tank_2d(NULL, NULL), three = tank_2d(NULL, NULL);
    for (int i = 0; i < 10; i++) {
        OK(pbmpm_world_step(one, 0.01f));
        OK(pbmpm_world_step(two, 0.01f));
        OK(pbmpm_world_step(three, 0.011f));
    }
    TEST_ASSERT_EQUAL_HEX64(world_hash(one), world_hash(two));
    TEST_ASSERT_TRUE(world_hash(one) != world_hash(three));
}

/* In 2D the third component of every vector is ignored, whatever it is. */
static void test_third_component_is_ignored_in_2d(void)
{
    const pbmpm_world_id plain = tank_2d(NULL, NULL), odd = tank_2d(NULL, NULL);
    set_gravity(odd, 0, -9.81f, NAN);
    create_collider(plain, box_shape(0.75f, 0.25f, 0, 0.1f, 0.1f, 0.5f), false);
    create_collider(odd, box_shape(0.75f, 0.25f, 9, 0.1f, 0.1f, 0.001f), false);
    for (int i = 0; i < 10; i++) {
        OK(pbmpm_world_step(plain, 0.01f));
        OK(pbmpm_world_step(odd, 0.01f));
    }
    TEST_ASSERT_EQUAL_HEX64(world_hash(plain), world_hash(odd));
}

/* Origin is for the caller's own conversion: it changes nothing inside. */
static void shift_origin(pbmpm_world_def *def, void *user)
{
    (void)user;
    def->origin[0] = 4e9;
    def->origin[1] = -1e12;
}

static void test_origin_changes_no_result(void)
{
    const pbmpm_world_id near = tank_2d(NULL, NULL), far = tank_2d(shift_origin, NULL);
    for (int i = 0; i < 10; i++) {
        OK(pbmpm_world_step(near, 0.01f));
        OK(pbmpm_world_step(far, 0.01f));
    }
    TEST_ASSERT_EQUAL_HEX64(world_hash(near), world_hash(far));
}

static void test_every_length_of_step_in_the_range_is_taken(void)
{
    static const float lengths[] = {2e-25f, 1e-12f, 1e-6f, 0.1f, 1.0f, 10.0f};
    for (size_t i = 0; i < sizeof lengths / sizeof *lengths; i++) {
        const pbmpm_world_id world = tank_2d(NULL, NULL);
        const uint32_t before = world_count(world);
        for (int step = 0; step < 3; step++)
            OK(pbmpm_world_step(world, lengths[i]));
        world_expect_finite(world, "after steps of an odd length");
        TEST_ASSERT_EQUAL_UINT64(before, world_count(world) + world_stats(world).deleted_total);
        OK(pbmpm_world_destroy(world));
    }
}

/* ---- definitions that nobody filled ---- */

static void expect_hint(pbmpm_result result, const char *call, const char *hint)
{
    char line[400];
    snprintf(line, sizeof line, "%s says \"%s\"; wanted: %s", call, pbmpm_last_error(), hint);
    TEST_ASSERT_EQUAL_STRING_MESSAGE("PBMPM_ERROR_UNSUPPORTED", pbmpm_result_name(result), line);
    TEST_ASSERT_TRUE_MESSAGE(strstr(pbmpm_last_error(), call) && strstr(pbmpm_last_error(), hint), line);
}
#define EXPECT_HINT(hint, name, ...) expect_hint(name(__VA_ARGS__), #name, hint)
#define ZERO(type) (&(type){0})

/* Who forgot to fill a definition is told by what. */
static void test_zeroed_definitions_are_told_what_fills_them(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const pbmpm_shape shape = default_shape();
    const pbmpm_collider_def collider_def = default_collider();
    pbmpm_world_def world_def = default_world(2, 0.1f, 10);
    pbmpm_world_id other;
    pbmpm_material_id material;
    pbmpm_collider_id collider;
    pbmpm_emitter_id emitter;
    pbmpm_drain_id drain;
    pbmpm_force_id force;
    pbmpm_ray_hit hit = {.size = sizeof hit};
    uint32_t count;
    uint64_t bytes;
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
    const pbmpm_emitter_id spout = create_emitter(world, water);
    const pbmpm_drain_id hole = create_drain(world, shape);
    const pbmpm_force_id wind = create_force(world);
    EXPECT_HINT("pbmpm_world_def_init()", pbmpm_world_create, ZERO(pbmpm_world_def), &other);
    world_def.allocator = ZERO(pbmpm_allocator);
    EXPECT_HINT("sizeof(pbmpm_allocator)", pbmpm_world_create, &world_def, &other);
    world_def.allocator = NULL;
    world_def.tasks = ZERO(pbmpm_task_hooks);
    EXPECT_HINT("sizeof(pbmpm_task_hooks)", pbmpm_world_create, &world_def, &other);
    EXPECT_HINT("pbmpm_settings_init()", pbmpm_world_set_settings, world, ZERO(pbmpm_settings));
    EXPECT_HINT("pbmpm_material_def_init()", pbmpm_material_create, world, ZERO(pbmpm_material_def), &material);
    EXPECT_HINT("pbmpm_material_def_init()", pbmpm_material_set, world, water, ZERO(pbmpm_material_def));
    EXPECT_HINT("pbmpm_collider_def_init()", pbmpm_collider_create, world, ZERO(pbmpm_collider_def), &shape, &collider);
    EXPECT_HINT("pbmpm_shape_init()", pbmpm_collider_create, world, &collider_def, ZERO(pbmpm_shape), &collider);
    EXPECT_HINT("pbmpm_particles_def_init()", pbmpm_particles_add, world, ZERO(pbmpm_particles_def), NULL);
    EXPECT_HINT("pbmpm_fill_def_init()", pbmpm_particles_fill, world, ZERO(pbmpm_fill_def), &shape, NULL);
    EXPECT_HINT("pbmpm_shape_init()", pbmpm_particles_remove_in, world, ZERO(pbmpm_shape), NULL);
    EXPECT_HINT("pbmpm_shape_init()", pbmpm_query_shape, world, ZERO(pbmpm_shape), NULL, 0, &count);
    EXPECT_HINT("pbmpm_shape_init()", pbmpm_query_region, world, ZERO(pbmpm_shape), NULL, 0, &count);
    EXPECT_HINT("pbmpm_shape_init()", pbmpm_world_wake, world, ZERO(pbmpm_shape));
    EXPECT_HINT("pbmpm_ray_init()", pbmpm_query_ray, world, ZERO(pbmpm_ray), &hit);
    EXPECT_HINT("pbmpm_emitter_def_init()", pbmpm_emitter_create, world, ZERO(pbmpm_emitter_def), &shape, &emitter);
    EXPECT_HINT("pbmpm_emitter_def_init()", pbmpm_emitter_set, world, spout, ZERO(pbmpm_emitter_def), NULL);
    EXPECT_HINT("pbmpm_shape_init()", pbmpm_emitter_set, world, spout, NULL, ZERO(pbmpm_shape));
    EXPECT_HINT("pbmpm_drain_def_init()", pbmpm_drain_create, world, ZERO(pbmpm_drain_def), &shape, &drain);
    EXPECT_HINT("pbmpm_drain_def_init()", pbmpm_drain_set, world, hole, ZERO(pbmpm_drain_def), NULL);
    EXPECT_HINT("pbmpm_shape_init()", pbmpm_drain_set, world, hole, NULL, ZERO(pbmpm_shape));
    EXPECT_HINT("pbmpm_force_def_init()", pbmpm_force_create, world, ZERO(pbmpm_force_def), &shape, &force);
    EXPECT_HINT("pbmpm_force_def_init()", pbmpm_force_set, world, wind, ZERO(pbmpm_force_def), NULL);
    EXPECT_HINT("pbmpm_shape_init()", pbmpm_force_set, world, wind, NULL, ZERO(pbmpm_shape));
    EXPECT_HINT("pbmpm_kill_bounds_init()", pbmpm_world_set_kill_bounds, world, ZERO(pbmpm_kill_bounds));
    EXPECT_HINT("pbmpm_mesh_def_init()", pbmpm_bake_mesh, ZERO(pbmpm_mesh_def), NULL, 0, &bytes);
    EXPECT_HINT("pbmpm_mesh_def_init()", pbmpm_bake_hull, ZERO(pbmpm_mesh_def), NULL, 0, &bytes);
    EXPECT_HINT("pbmpm_heights_def_init()", pbmpm_bake_heights, ZERO(pbmpm_heights_def), NULL, 0, &bytes);
    EXPECT_HINT("sizeof", pbmpm_world_get_stats, world, ZERO(pbmpm_stats));
    EXPECT_HINT("sizeof", pbmpm_particles_view, world, PBMPM_POSITION, ZERO(pbmpm_view));
    EXPECT_HINT("sizeof", pbmpm_world_events, world, ZERO(pbmpm_event), 1, &count, NULL);
    EXPECT_HINT("sizeof", pbmpm_query_region, world, &shape, ZERO(pbmpm_region_share), 1, &count);
    pbmpm_settings other_size = default_settings();
    other_size.size -= 1;
    EXPECT_HINT("no version of pbmpm_settings", pbmpm_world_set_settings, world, &other_size);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_versions_agree_with_the_headers);
    RUN_TEST(test_every_result_has_its_name);
    RUN_TEST(test_instruction_sets_have_names);
    RUN_TEST(test_all_materials_are_built);
    RUN_TEST(test_last_error_belongs_to_the_thread);
    RUN_TEST(test_last_error_tells_figures);
    RUN_TEST(test_log_callback_gets_refused_calls);
    RUN_TEST(test_assert_callback_is_taken_by_builds_with_assertions);
    RUN_TEST(test_log_callback_gets_what_a_step_deletes);
    RUN_TEST(test_functions_of_the_host_keep_its_float_mode);
    RUN_TEST(test_shutdown_destroys_worlds_and_allows_a_new_start);
    RUN_TEST(test_world_def_has_the_documented_defaults);
    RUN_TEST(test_settings_have_the_documented_defaults);
    RUN_TEST(test_world_returns_its_definition);
    RUN_TEST(test_world_returns_its_own_allocator_and_hooks);
    RUN_TEST(test_world_identifiers_are_never_reused);
    RUN_TEST(test_failed_creation_gives_the_null_identifier);
    RUN_TEST(test_settings_are_read_back);
    RUN_TEST(test_steps_are_counted_and_cut_into_substeps);
    RUN_TEST(test_substeps_equal_shorter_steps);
    RUN_TEST(test_an_empty_world_steps);
    RUN_TEST(test_generation_changes_with_the_particles_only);
    RUN_TEST(test_hash_sees_the_state);
    RUN_TEST(test_equal_calls_give_equal_hashes_and_unequal_ones_do_not);
    RUN_TEST(test_third_component_is_ignored_in_2d);
    RUN_TEST(test_origin_changes_no_result);
    RUN_TEST(test_every_length_of_step_in_the_range_is_taken);
    RUN_TEST(test_zeroed_definitions_are_told_what_fills_them);
    return UNITY_END();
}
