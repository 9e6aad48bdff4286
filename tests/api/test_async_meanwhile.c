/* While a step runs in the background: the last state is in view, other calls are refused, and the end is safe whatever happens. */
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "calls.h"
#include "solvers.h"

void setUp(void)
{
}

static void gate_set(bool armed, bool released);

void tearDown(void)
{
    gate_set(false, true); /* a failed check may have left a step behind it */
    pbmpm_shutdown();
    pbmpm_set_log_callback(NULL, NULL);
}

/* ---- a gate that holds a step where it asks for memory ---- */

/* The first step with another solver takes memory, so it calls the allocator; there it waits until it is released. */
typedef struct gate {
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    bool armed, released;
    bool holds; /* a step waits */
} gate;

static gate door = {.mutex = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};

static void *gate_allocate(size_t size, size_t alignment, void *user)
{
    (void)user;
    pthread_mutex_lock(&door.mutex);
    while (door.armed && !door.released) {
        door.holds = true;
        pthread_cond_wait(&door.changed, &door.mutex);
    }
    pthread_mutex_unlock(&door.mutex);
    return host_allocate(size, alignment);
}

static void gate_release(void *memory, size_t size, void *user)
{
    (void)size;
    (void)user;
    host_release(memory);
}

static void use_gate(pbmpm_world_def *def, void *user)
{
    static const pbmpm_allocator gated = {sizeof gated, gate_allocate, gate_release, NULL};
    (void)user;
    def->allocator = &gated;
}

static void gate_set(bool armed, bool released)
{
    pthread_mutex_lock(&door.mutex);
    door.armed = armed;
    door.holds = false;
    door.released = released;
    pthread_cond_broadcast(&door.changed);
    pthread_mutex_unlock(&door.mutex);
}

static bool gate_holds(void)
{
    pthread_mutex_lock(&door.mutex);
    const bool holds = door.holds;
    pthread_mutex_unlock(&door.mutex);
    return holds;
}

/* Begins a step that cannot end until the gate is opened. The thread and the copies are there already. */
static void begin_behind_gate(const target *ids)
{
    OK(pbmpm_world_step_begin(ids->world, 0.001f));
    OK(pbmpm_world_step_end(ids->world, 1));
    use_way(ids->world, &ways[WAY_DUAL]);
    gate_set(true, false);
    OK(pbmpm_world_step_begin(ids->world, 0.001f));
    for (int ms = 0; !gate_holds(); ms++) {
        if (ms == 20000)
            TEST_FAIL_MESSAGE("the step took no memory; the gate never closed");
        usleep(1000);
    }
}

/* ---- views ---- */

static void expect_copy(pbmpm_world_id world, pbmpm_field field, const unsigned char *packed)
{
    const pbmpm_view view = view_of(world, field);
    uint64_t generation = 0;
    OK(pbmpm_world_generation(world, &generation));
    TEST_ASSERT_EQUAL_UINT64(generation, view.generation);
    for (uint32_t row = 0; row < view.count; row++)
        for (uint32_t c = 0; c < view.components; c++) {
            uint32_t expected;
            memcpy(&expected, packed + 4 * ((size_t)row * view.components + c), 4);
            if (expected != view_uint(&view, row, c))
                TEST_FAIL_MESSAGE("a published value differs from the state before the step");
        }
}

static unsigned char *packed_copy(pbmpm_world_id world, pbmpm_field field)
{
    const pbmpm_view view = view_of(world, field);
    unsigned char *packed = malloc((size_t)view.count * view.components * 4);
    for (uint32_t row = 0; row < view.count; row++)
        for (uint32_t c = 0; c < view.components; c++) {
            const uint32_t value = view_uint(&view, row, c);
            memcpy(packed + 4 * ((size_t)row * view.components + c), &value, 4);
        }
    return packed;
}

static const pbmpm_field all_fields[] = {PBMPM_POSITION, PBMPM_VELOCITY, PBMPM_AFFINE_VELOCITY, PBMPM_VOLUME_RATIO, PBMPM_DEFORMATION,
                                         PBMPM_MATERIAL, PBMPM_PARTICLE, PBMPM_MASS,            PBMPM_PRESSURE, PBMPM_USER_VALUE};
enum { ALL_FIELDS = sizeof all_fields / sizeof *all_fields };

static void test_views_show_the_state_before_the_step(void)
{
    const stage made = stirred_pool(2, &ways[WAY_DUAL], three_threads, NULL);
    unsigned char *copy[ALL_FIELDS];
    OK(pbmpm_world_publish(made.world, all_fields, ALL_FIELDS));
    OK(pbmpm_world_step(made.world, 0.01f)); /* from here on there are pressures */
    const uint32_t count = world_count(made.world), seven = 7;
    pbmpm_particle_id first;
    const pbmpm_view ids = view_of(made.world, PBMPM_PARTICLE);
    memcpy(&first, ids.data, sizeof first);
    OK(pbmpm_particles_set(made.world, PBMPM_USER_VALUE, &first, 1, &seven));
    for (int f = 0; f < ALL_FIELDS; f++)
        copy[f] = packed_copy(made.world, all_fields[f]);
    OK(pbmpm_world_step_begin(made.world, 0.01f));
    TEST_ASSERT_EQUAL_UINT32(count, world_count(made.world));
    for (int f = 0; f < ALL_FIELDS; f++)
        expect_copy(made.world, all_fields[f], copy[f]);
    while (pbmpm_world_step_end(made.world, 0) == PBMPM_ERROR_BUSY)
        for (int f = 0; f < ALL_FIELDS; f++) /* also while it works, and when it is done and not ended */
            expect_copy(made.world, all_fields[f], copy[f]);
    for (int f = 0; f < ALL_FIELDS; f++)
        free(copy[f]);
}

static uint64_t generation_of(pbmpm_world_id world)
{
    uint64_t generation = 0;
    OK(pbmpm_world_generation(world, &generation));
    return generation;
}

static void test_views_expire_at_the_begin_and_at_the_end(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    const uint64_t before = view_of(world, PBMPM_POSITION).generation;
    OK(pbmpm_world_step_begin(world, 0.01f));
    const uint64_t meanwhile = view_of(world, PBMPM_POSITION).generation;
    TEST_ASSERT_TRUE(before != meanwhile && meanwhile == generation_of(world));
    OK(pbmpm_world_step_end(world, 1));
    TEST_ASSERT_TRUE(meanwhile != generation_of(world));
    TEST_ASSERT_TRUE(meanwhile != view_of(world, PBMPM_POSITION).generation);
}

/* The figures of the step before, whatever the one that runs has done to them. */
static void test_figures_of_the_step_before(void)
{
    const target ids = target_create(use_gate, NULL);
    pbmpm_stats before = {.size = sizeof before}, meanwhile = before, after = before;
    begin_behind_gate(&ids);
    OK(pbmpm_world_get_step_stats(ids.world, &before));
    TEST_ASSERT_EQUAL_UINT64(1, before.step_count);
    TEST_ASSERT_TRUE(before.ms_total > 0.0f && before.particle_blocks > 0);
    OK(pbmpm_world_get_step_stats(ids.world, &meanwhile));
    TEST_ASSERT_EQUAL_MEMORY(&before, &meanwhile, sizeof before);
    gate_set(false, true);
    OK(pbmpm_world_step_end(ids.world, 1));
    OK(pbmpm_world_get_step_stats(ids.world, &after));
    TEST_ASSERT_EQUAL_UINT64(2, after.step_count);
}

static void test_only_published_fields_are_in_view(void)
{
    static const pbmpm_field two[] = {PBMPM_VELOCITY, PBMPM_DEFORMATION}, twice[] = {PBMPM_MASS, PBMPM_MASS}, odd[] = {(pbmpm_field)77};
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    pbmpm_view view = {.size = sizeof view};
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_publish(world, twice, 2));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_publish(world, odd, 1));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_publish(world, NULL, 1));
    OK(pbmpm_world_publish(world, two, 2));
    OK(pbmpm_world_step_begin(world, 0.01f));
    OK(pbmpm_particles_view(world, PBMPM_VELOCITY, &view));
    EXPECT(PBMPM_ERROR_BUSY, pbmpm_particles_view(world, PBMPM_POSITION, &view));
    EXPECT(PBMPM_ERROR_UNSUPPORTED, pbmpm_particles_view(world, PBMPM_DEFORMATION, &view));
    OK(pbmpm_world_step_end(world, 1));
    OK(pbmpm_world_publish(world, NULL, 0));
    OK(pbmpm_world_step_begin(world, 0.01f));
    EXPECT(PBMPM_ERROR_BUSY, pbmpm_particles_view(world, PBMPM_VELOCITY, &view));
    OK(pbmpm_world_step_end(world, 1));
    OK(pbmpm_particles_view(world, PBMPM_POSITION, &view));
}

/* A published frame as a renderer keeps it: the views, and what they showed at first. */
typedef struct frame {
    pbmpm_view view[3];
    unsigned char *shown[3];
} frame;

static const pbmpm_field drawn_fields[] = {PBMPM_POSITION, PBMPM_VELOCITY, PBMPM_PARTICLE};

static frame publish_frame(pbmpm_world_id world)
{
    frame made;
    OK(pbmpm_world_step_begin(world, 0.01f));
    for (int f = 0; f < 3; f++) {
        made.view[f] = view_of(world, drawn_fields[f]);
        made.shown[f] = packed_copy(world, drawn_fields[f]);
    }
    return made;
}

/* Without a call into the world. */
static void expect_frame(const frame *kept)
{
    for (int f = 0; f < 3; f++)
        for (uint32_t row = 0; row < kept->view[f].count; row++)
            for (uint32_t c = 0; c < kept->view[f].components; c++) {
                const uint32_t value = view_uint(&kept->view[f], row, c);
                if (memcmp(&value, kept->shown[f] + 4 * ((size_t)row * kept->view[f].components + c), 4) != 0)
                    TEST_FAIL_MESSAGE("a published frame has changed before the next begin but one");
            }
}

static void forget_frame(const frame *kept)
{
    for (int f = 0; f < 3; f++)
        free(kept->shown[f]);
}

/* Whatever is called: ends, edits, steps that wait, and the next begin with its step. */
static void test_a_published_frame_stays_until_the_next_begin_but_one(void)
{
    const stage made = stirred_pool(3, &ways[WAY_DUAL], three_threads, NULL);
    frame before = publish_frame(made.world);
    OK(pbmpm_world_step_end(made.world, 1));
    for (int i = 0; i < 6; i++) {
        expect_frame(&before);
        OK(pbmpm_world_step(made.world, 0.01f));
        const pbmpm_shape ball = sphere_shape(0.3f, 0.2f, 0.3f, 0.1f);
        OK(pbmpm_particles_remove_in(made.world, &ball, NULL));
        const frame next = publish_frame(made.world);
        expect_frame(&before);
        OK(pbmpm_world_step_end(made.world, 1));
        expect_frame(&before);
        forget_frame(&before);
        before = next;
    }
    forget_frame(&before);
}

/* A renderer that is a frame late reads on its own thread while the world goes on. */
typedef struct renderer {
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    frame *ready; /* null: none */
    bool quits, sees_garbage;
} renderer;

static void *draw_frames(void *user)
{
    renderer *own = user;
    pthread_mutex_lock(&own->mutex);
    for (;;) {
        while (!own->ready && !own->quits)
            pthread_cond_wait(&own->changed, &own->mutex);
        if (!own->ready)
            break;
        const frame drawn = *own->ready;
        pthread_mutex_unlock(&own->mutex);
        bool same = true;
        for (int pass = 0; pass < 3; pass++)
            for (uint32_t row = 0; row < drawn.view[0].count; row++)
                for (uint32_t c = 0; c < drawn.view[0].components; c++) {
                    const uint32_t value = view_uint(&drawn.view[0], row, c);
                    same &= memcmp(&value, drawn.shown[0] + 4 * ((size_t)row * drawn.view[0].components + c), 4) == 0;
                }
        pthread_mutex_lock(&own->mutex);
        own->sees_garbage |= !same;
        own->ready = NULL;
        pthread_cond_broadcast(&own->changed);
    }
    pthread_mutex_unlock(&own->mutex);
    return NULL;
}

static void test_a_renderer_may_be_a_frame_late(void)
{
    renderer drawer = {.mutex = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};
    const pbmpm_world_id world = stirred_pool(2, &ways[WAY_DUAL], three_threads, NULL).world;
    pthread_t thread;
    frame late = publish_frame(world);
    OK(pbmpm_world_step_end(world, 1));
    TEST_ASSERT_EQUAL_INT(0, pthread_create(&thread, NULL, draw_frames, &drawer));
    for (int i = 0; i < 20; i++) {
        pthread_mutex_lock(&drawer.mutex);
        drawer.ready = &late;
        pthread_cond_broadcast(&drawer.changed);
        pthread_mutex_unlock(&drawer.mutex);
        const frame next = publish_frame(world);
        OK(pbmpm_world_step_end(world, 1));
        pthread_mutex_lock(&drawer.mutex);
        while (drawer.ready)
            pthread_cond_wait(&drawer.changed, &drawer.mutex);
        pthread_mutex_unlock(&drawer.mutex);
        forget_frame(&late);
        late = next;
    }
    pthread_mutex_lock(&drawer.mutex);
    drawer.quits = true;
    pthread_cond_broadcast(&drawer.changed);
    pthread_mutex_unlock(&drawer.mutex);
    pthread_join(thread, NULL);
    forget_frame(&late);
    TEST_ASSERT_FALSE(drawer.sees_garbage);
}

/* Memory as documented: twice 28 bytes per particle in 2D and twice 36 in 3D, with the first begin. */
static void check_memory(int32_t dimension, uint64_t expected)
{
    static ledger book;
    enum { CAPACITY = 4096 };
    book = (ledger){0};
    pbmpm_world_def def = default_world(dimension, 0.1f, CAPACITY);
    def.allocator = ledger_allocator(&book);
    const pbmpm_world_id world = create_world(&def);
    OK(pbmpm_world_step(world, 0.01f));
    const uint64_t before = book.live_bytes;
    OK(pbmpm_world_step_begin(world, 0.01f));
    OK(pbmpm_world_step_end(world, 1));
    TEST_ASSERT_EQUAL_UINT64(expected, (book.live_bytes - before) / CAPACITY);
    const uint64_t calls = book.calls;
    for (int i = 0; i < 20; i++) {
        OK(pbmpm_world_step_begin(world, 0.01f));
        OK(pbmpm_world_step_end(world, 1));
    }
    TEST_ASSERT_EQUAL_UINT64(calls, book.calls); /* warm */
    OK(pbmpm_world_destroy(world));
    TEST_ASSERT_EQUAL_UINT64(0, book.live_bytes);
    TEST_ASSERT_EQUAL_UINT64(0, book.bad_sizes + book.overruns);
}

static void test_memory_is_as_documented(void)
{
    check_memory(2, 56);
    check_memory(3, 72);
}

/* ---- what is refused ---- */

static bool is_allowed(const char *name)
{
    static const char *const allowed[] = {"pbmpm_world_get_def", "pbmpm_world_generation", "pbmpm_particles_count", "pbmpm_particles_view", "pbmpm_particles_copy",
                                          "pbmpm_world_get_step_stats", "pbmpm_world_step_done"};
    for (size_t i = 0; i < sizeof allowed / sizeof *allowed; i++)
        if (strcmp(name, allowed[i]) == 0)
            return true;
    return false;
}

static void test_other_calls_are_refused_while_a_step_runs(void)
{
    const target ids = target_create(use_gate, NULL), twin = target_create(use_gate, NULL);
    begin_behind_gate(&twin);
    gate_set(false, true);
    OK(pbmpm_world_step_end(twin.world, 1));
    begin_behind_gate(&ids);
    EXPECT(PBMPM_ERROR_BUSY, pbmpm_world_step_end(ids.world, 0));
    for (int i = 0; i < world_call_count - 1; i++) { /* all but destroy */
        if (strcmp(world_calls[i].name, "pbmpm_world_step_end") == 0)
            continue;
        const char *expected = is_allowed(world_calls[i].name) ? "PBMPM_OK" : "PBMPM_ERROR_BUSY";
        TEST_ASSERT_EQUAL_STRING_MESSAGE(expected, pbmpm_result_name(world_calls[i].make(&ids)), world_calls[i].name);
    }
    gate_set(false, true);
    OK(pbmpm_world_step_end(ids.world, 1));
    TEST_ASSERT_EQUAL_HEX64(world_hash(twin.world), world_hash(ids.world)); /* refusals changed nothing */
}

static atomic_int lines;

static void count_line(pbmpm_log_level level, const char *message, void *user)
{
    (void)level;
    (void)message;
    (void)user;
    atomic_fetch_add(&lines, 1);
}

/* Who asks in each frame whether a step is done is answered, and nobody is told of a refusal. */
static void test_polls_write_no_line(void)
{
    const target ids = target_create(use_gate, NULL);
    int32_t done = 7;
    begin_behind_gate(&ids);
    atomic_store(&lines, 0);
    OK(pbmpm_set_log_callback(count_line, NULL));
    for (int i = 0; i < 100; i++) {
        EXPECT(PBMPM_ERROR_BUSY, pbmpm_world_step_end(ids.world, 0));
        OK(pbmpm_world_step_done(ids.world, &done));
        TEST_ASSERT_EQUAL_INT32(0, done);
    }
    TEST_ASSERT_EQUAL_STRING("the step is not done yet", pbmpm_last_error());
    TEST_ASSERT_EQUAL_INT(0, atomic_load(&lines));
    gate_set(false, true);
    for (int ms = 0; !done && ms < 20000; ms++) {
        OK(pbmpm_world_step_done(ids.world, &done));
        usleep(1000);
    }
    TEST_ASSERT_EQUAL_INT32(1, done);
    OK(pbmpm_world_step_done(ids.world, &done)); /* it is not ended by that */
    TEST_ASSERT_EQUAL_INT32(1, done);
    OK(pbmpm_world_step_end(ids.world, 0));
    TEST_ASSERT_EQUAL_INT(0, atomic_load(&lines));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step_done(ids.world, &done));
    TEST_ASSERT_EQUAL_INT32(1, done);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step_done(ids.world, NULL));
    TEST_ASSERT_EQUAL_INT(2, atomic_load(&lines)); /* mistakes are told */
    OK(pbmpm_set_log_callback(NULL, NULL));
}

static void test_bad_arguments_begin_nothing(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL);
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step_end(world, 0));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step_end(world, 1));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step_begin(world, 0.0f));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step_begin(world, 11.0f));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step_end(world, 1));
    OK(pbmpm_world_step_begin(world, 0.01f));
    OK(pbmpm_world_step_end(world, -1));
    EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step_end(world, 1)); /* ended once */
}

/* The step's failure, with its message, comes out of the end; the world is as after a failed step that waited. */
static void test_failure_of_the_step_is_its_ends(void)
{
    static ledger book;
    char message[256];
    for (int kind = 0; kind < 2; kind++) {
        book = (ledger){0};
        pbmpm_world_def def = default_world(2, 0.05f, 4096);
        def.allocator = ledger_allocator(&book);
        const pbmpm_world_id world = create_world(&def);
        const pbmpm_material_id water = create_material(world, PBMPM_LIQUID);
        OK(pbmpm_world_step_begin(world, 0.01f));
        OK(pbmpm_world_step_end(world, 1));
        fill_shape(world, water, box_shape(0, 0, 0, 0.5f, 0.5f, 0.5f), (const float[3]){0, 0, 0});
        book.fail_at = book.calls + 1;
        book.sticky = true;
        if (kind == 0) {
            EXPECT(PBMPM_ERROR_OUT_OF_MEMORY, pbmpm_world_step(world, 0.01f));
            snprintf(message, sizeof message, "%s", pbmpm_last_error());
        } else {
            OK(pbmpm_world_step_begin(world, 0.01f));
            EXPECT(PBMPM_ERROR_OUT_OF_MEMORY, pbmpm_world_step_end(world, 1));
            TEST_ASSERT_EQUAL_STRING(message, pbmpm_last_error());
        }
        book.fail_at = 0;
        book.sticky = false;
        OK(pbmpm_world_step_begin(world, 0.01f));
        OK(pbmpm_world_step_end(world, 1));
        OK(pbmpm_world_destroy(world));
        TEST_ASSERT_EQUAL_UINT64(0, book.live_bytes);
    }
}

/* No memory for the copies or the thread's book-keeping: no step was begun. */
static void test_begin_without_memory_changes_nothing(void)
{
    static ledger book;
    for (uint64_t fail_at = 1; fail_at <= 9; fail_at++) {
        book = (ledger){0};
        pbmpm_world_def def = default_world(2, 0.05f, 512);
        def.allocator = ledger_allocator(&book);
        const pbmpm_world_id world = create_world(&def);
        book.fail_at = book.calls + fail_at;
        const uint64_t before = generation_of(world);
        EXPECT(PBMPM_ERROR_OUT_OF_MEMORY, pbmpm_world_step_begin(world, 0.01f));
        TEST_ASSERT_EQUAL_UINT64(before, generation_of(world));
        EXPECT(PBMPM_ERROR_INVALID_ARGUMENT, pbmpm_world_step_end(world, 1));
        OK(pbmpm_world_step_begin(world, 0.01f));
        OK(pbmpm_world_step_end(world, 1));
        OK(pbmpm_world_destroy(world));
        TEST_ASSERT_EQUAL_UINT64(0, book.live_bytes);
    }
}

/* ---- ends ---- */

static void *open_gate(void *unused)
{
    gate_set(false, true);
    return unused;
}

static void end_with(bool shutdown)
{
    pthread_t opener;
    const target ids = target_create(use_gate, NULL);
    begin_behind_gate(&ids);
    TEST_ASSERT_EQUAL_INT(0, pthread_create(&opener, NULL, open_gate, NULL));
    OK(shutdown ? pbmpm_shutdown() : pbmpm_world_destroy(ids.world));
    pthread_join(opener, NULL);
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_world_step_end(ids.world, 1));
    EXPECT(PBMPM_ERROR_INVALID_ID, pbmpm_world_destroy(ids.world));
}

static void test_destroying_while_a_step_runs(void)
{
    end_with(false);
    for (int round = 0; round < 20; round++) { /* at any moment */
        const pbmpm_world_id world = tank_2d(three_threads, NULL);
        OK(pbmpm_world_step_begin(world, 0.01f));
        if (round % 3 == 0)
            view_of(world, PBMPM_POSITION);
        OK(pbmpm_world_destroy(world));
    }
}

static void test_shutdown_while_a_step_runs(void)
{
    end_with(true);
    for (int round = 0; round < 5; round++) {
        for (int k = 0; k < 3; k++)
            OK(pbmpm_world_step_begin(tank_2d(NULL, NULL), 0.01f));
        OK(pbmpm_shutdown());
    }
}

/* Another thread may view and end. */
static void *view_and_end(void *user)
{
    const pbmpm_world_id world = *(const pbmpm_world_id *)user;
    pbmpm_view view = {.size = sizeof view};
    const bool right = pbmpm_particles_view(world, PBMPM_POSITION, &view) == PBMPM_OK && view.count > 0 &&
                       pbmpm_world_step_end(world, 1) == PBMPM_OK;
    return right ? NULL : user;
}

static void test_threads_may_share_the_work(void)
{
    pbmpm_world_id world = tank_2d(NULL, NULL);
    for (int i = 0; i < 10; i++) {
        pthread_t thread;
        void *failed = NULL;
        OK(pbmpm_world_step_begin(world, 0.01f));
        TEST_ASSERT_EQUAL_INT(0, pthread_create(&thread, NULL, view_and_end, &world));
        pthread_join(thread, &failed);
        TEST_ASSERT_NULL(failed);
    }
    TEST_ASSERT_EQUAL_UINT64(10, world_stats(world).step_count);
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_views_show_the_state_before_the_step);
    RUN_TEST(test_views_expire_at_the_begin_and_at_the_end);
    RUN_TEST(test_figures_of_the_step_before);
    RUN_TEST(test_only_published_fields_are_in_view);
    RUN_TEST(test_a_published_frame_stays_until_the_next_begin_but_one);
    RUN_TEST(test_a_renderer_may_be_a_frame_late);
    RUN_TEST(test_memory_is_as_documented);
    RUN_TEST(test_other_calls_are_refused_while_a_step_runs);
    RUN_TEST(test_polls_write_no_line);
    RUN_TEST(test_bad_arguments_begin_nothing);
    RUN_TEST(test_failure_of_the_step_is_its_ends);
    RUN_TEST(test_begin_without_memory_changes_nothing);
    RUN_TEST(test_destroying_while_a_step_runs);
    RUN_TEST(test_shutdown_while_a_step_runs);
    RUN_TEST(test_threads_may_share_the_work);
    return UNITY_END();
}
