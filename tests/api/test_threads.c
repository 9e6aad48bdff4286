/* Threads: one world used from two threads, many worlds at once, and the host's own job system. */
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "calls.h"
#include "scenes.h"

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

/* ---- a gate that holds one thread inside a step ---- */

/* The allocator is called from inside the first step (the grid has to grow); there the stepping thread waits while the
 * other one tries every call. */
typedef struct gate {
    ledger book;
    pbmpm_allocator gated;
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    bool armed;    /* the next allocation stops */
    bool reached;  /* the stepping thread waits in the allocator */
    bool released; /* it may go on */
} gate;

static void *gate_allocate(size_t size, size_t alignment, void *user)
{
    gate *door = user;
    pthread_mutex_lock(&door->mutex);
    if (door->armed) {
        door->armed = false;
        door->reached = true;
        pthread_cond_broadcast(&door->changed);
        while (!door->released)
            pthread_cond_wait(&door->changed, &door->mutex);
    }
    pthread_mutex_unlock(&door->mutex);
    return door->book.allocator.allocate(size, alignment, &door->book);
}

static void gate_release(void *memory, size_t size, void *user)
{
    gate *door = user;
    door->book.allocator.release(memory, size, &door->book);
}

static void use_gate(pbmpm_world_def *def, void *user)
{
    gate *door = user;
    ledger_allocator(&door->book);
    door->gated = (pbmpm_allocator){sizeof door->gated, gate_allocate, gate_release, door};
    def->allocator = &door->gated;
}

typedef struct stepper {
    pbmpm_world_id world;
    gate *door;
    pbmpm_result result;
} stepper;

static void *step_through_gate(void *user)
{
    stepper *walker = user;
    walker->result = pbmpm_world_step(walker->world, 0.001f);
    pthread_mutex_lock(&walker->door->mutex); /* if nothing was allocated, say so instead of waiting for ever */
    walker->door->armed = false;
    pthread_cond_broadcast(&walker->door->changed);
    pthread_mutex_unlock(&walker->door->mutex);
    return NULL;
}

static void test_every_call_is_refused_while_another_thread_steps(void)
{
    static gate door = {.mutex = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};
    const target ids = target_create(use_gate, &door), twin = target_create(NULL, NULL);
    stepper walker = {ids.world, &door, PBMPM_ERROR_BUSY};
    pbmpm_result results[128];
    pthread_t thread;
    TEST_ASSERT_TRUE(world_call_count <= (int)(sizeof results / sizeof *results));
    door.armed = true;
    TEST_ASSERT_EQUAL_INT(0, pthread_create(&thread, NULL, step_through_gate, &walker));
    pthread_mutex_lock(&door.mutex);
    while (!door.reached && door.armed)
        pthread_cond_wait(&door.changed, &door.mutex);
    const bool reached = door.reached;
    pthread_mutex_unlock(&door.mutex);
    for (int i = 0; i < world_call_count && reached; i++)
        results[i] = world_calls[i].make(&ids);
    const pbmpm_result elsewhere = pbmpm_world_step(twin.world, 0.001f); /* other worlds are free */
    pthread_mutex_lock(&door.mutex);
    door.released = true;
    pthread_cond_broadcast(&door.changed);
    pthread_mutex_unlock(&door.mutex);
    pthread_join(thread, NULL);
    TEST_ASSERT_TRUE_MESSAGE(reached, "the first step took no memory; the gate never closed");
    for (int i = 0; i < world_call_count; i++)
        TEST_ASSERT_EQUAL_STRING_MESSAGE("PBMPM_ERROR_BUSY", pbmpm_result_name(results[i]), world_calls[i].name);
    TEST_ASSERT_EQUAL_STRING("PBMPM_OK", pbmpm_result_name(walker.result));
    TEST_ASSERT_EQUAL_STRING("PBMPM_OK", pbmpm_result_name(elsewhere));
    TEST_ASSERT_EQUAL_HEX64(world_hash(twin.world), world_hash(ids.world)); /* refusals changed nothing */
    OK(pbmpm_world_destroy(ids.world));
}

/* ---- two threads race for one world ---- */

typedef struct racer {
    pbmpm_world_id world;
    atomic_int *busy_seen; /* of both threads */
    int done, busy, other;
} racer;

static void *race(void *user)
{
    enum { BOUND = 20000 };
    racer *self = user;
    for (int i = 0; i < BOUND && atomic_load(self->busy_seen) < 100; i++) {
        switch (pbmpm_world_step(self->world, 0.001f)) {
        case PBMPM_OK: self->done++; break;
        case PBMPM_ERROR_BUSY:
            self->busy++;
            atomic_fetch_add(self->busy_seen, 1);
            break;
        default: self->other++;
        }
    }
    return NULL;
}

static void test_racing_threads_do_no_harm(void)
{
    const pbmpm_world_id world = tank_2d(NULL, NULL), alone = tank_2d(NULL, NULL);
    atomic_int busy_seen = 0;
    racer racers[2] = {{.world = world, .busy_seen = &busy_seen}, {.world = world, .busy_seen = &busy_seen}};
    pthread_t threads[2];
    for (int i = 0; i < 2; i++)
        TEST_ASSERT_EQUAL_INT(0, pthread_create(&threads[i], NULL, race, &racers[i]));
    for (int i = 0; i < 2; i++)
        pthread_join(threads[i], NULL);
    const int done = racers[0].done + racers[1].done;
    TEST_ASSERT_EQUAL_INT(0, racers[0].other + racers[1].other);
    TEST_ASSERT_TRUE_MESSAGE(racers[0].busy + racers[1].busy > 0, "the two threads never met");
    TEST_ASSERT_EQUAL_UINT64((uint64_t)done, world_stats(world).step_count);
    for (int i = 0; i < done; i++)
        OK(pbmpm_world_step(alone, 0.001f));
    TEST_ASSERT_EQUAL_HEX64(world_hash(alone), world_hash(world));
}

/* ---- many worlds at once ---- */

enum { WORLDS = 6, WORLD_STEPS = 60 };

static void *step_a_world(void *user)
{
    const pbmpm_world_id world = *(pbmpm_world_id *)user;
    for (int i = 0; i < WORLD_STEPS; i++)
        if (pbmpm_world_step(world, 0.005f) != PBMPM_OK)
            return user;
    return NULL;
}

static void two_threads(pbmpm_world_def *def, void *user)
{
    (void)user;
    def->thread_count = 2;
}

static void test_worlds_step_at_the_same_time(void)
{
    pbmpm_world_id worlds[WORLDS];
    pthread_t threads[WORLDS];
    uint64_t right[2];
    for (int kind = 0; kind < 2; kind++) {
        const pbmpm_world_id alone = kind ? block_2d(NULL, NULL) : tank_2d(NULL, NULL);
        TEST_ASSERT_NULL(step_a_world((void *)(uintptr_t)&alone));
        right[kind] = world_hash(alone);
    }
    for (int i = 0; i < WORLDS; i++)
        worlds[i] = i % 2 ? block_2d(two_threads, NULL) : tank_2d(two_threads, NULL);
    for (int i = 0; i < WORLDS; i++)
        TEST_ASSERT_EQUAL_INT(0, pthread_create(&threads[i], NULL, step_a_world, &worlds[i]));
    for (int i = 0; i < WORLDS; i++) {
        void *failed = NULL;
        pthread_join(threads[i], &failed);
        TEST_ASSERT_NULL(failed);
    }
    for (int i = 0; i < WORLDS; i++)
        TEST_ASSERT_EQUAL_HEX64(right[i % 2], world_hash(worlds[i]));
}

static void *make_and_break_worlds(void *failed)
{
    for (int i = 0; i < 50; i++) {
        pbmpm_world_def def;
        pbmpm_world_id world;
        pbmpm_world_def_init(&def, sizeof def);
        def.dimension = 2 + i % 2;
        def.particle_capacity = 64;
        def.thread_count = 1 + i % 3;
        if (pbmpm_world_create(&def, &world) != PBMPM_OK || pbmpm_world_step(world, 0.01f) != PBMPM_OK ||
            pbmpm_world_destroy(world) != PBMPM_OK || pbmpm_world_destroy(world) != PBMPM_ERROR_INVALID_ID)
            return failed;
    }
    return NULL;
}

static void test_worlds_are_made_and_destroyed_at_the_same_time(void)
{
    static char failure_mark;
    pthread_t threads[4];
    for (int i = 0; i < 4; i++)
        TEST_ASSERT_EQUAL_INT(0, pthread_create(&threads[i], NULL, make_and_break_worlds, &failure_mark));
    for (int i = 0; i < 4; i++) {
        void *failed = NULL;
        pthread_join(threads[i], &failed);
        TEST_ASSERT_NULL(failed);
    }
}

/* A world may move from thread to thread. */
static void test_a_world_may_change_its_thread(void)
{
    const pbmpm_world_id here = tank_2d(two_threads, NULL), there = tank_2d(two_threads, NULL);
    for (int part = 0; part < 3; part++) {
        pthread_t thread;
        void *failed = NULL;
        TEST_ASSERT_NULL(step_a_world((void *)(uintptr_t)&here));
        TEST_ASSERT_EQUAL_INT(0, pthread_create(&thread, NULL, step_a_world, (void *)(uintptr_t)&there));
        pthread_join(thread, &failed);
        TEST_ASSERT_NULL(failed);
    }
    TEST_ASSERT_EQUAL_HEX64(world_hash(here), world_hash(there));
}

/* ---- the host's job system ---- */

enum { HOST_THREADS = 3 };

/* One call of enqueue: the shares still to be done. */
typedef struct host_job {
    pbmpm_task *task;
    void *context;
    int32_t count;
    atomic_int next;
    pthread_t threads[HOST_THREADS];
} host_job;

typedef struct host {
    bool threaded; /* own threads; otherwise all shares run inside enqueue, the last one first */
    int enqueued, finished, largest;
} host;

static void *run_shares(void *user)
{
    host_job *job = user;
    for (int32_t i; (i = atomic_fetch_add(&job->next, 1)) < job->count;)
        job->task(job->count - 1 - i, job->context);
    return NULL;
}

static void *host_enqueue(pbmpm_task *task, int32_t count, void *context, void *user)
{
    host *own = user;
    own->enqueued++;
    own->largest = count > own->largest ? count : own->largest;
    host_job *job = calloc(1, sizeof *job);
    *job = (host_job){.task = task, .context = context, .count = count};
    if (!own->threaded)
        run_shares(job);
    for (int i = 0; own->threaded && i < HOST_THREADS; i++)
        pthread_create(&job->threads[i], NULL, run_shares, job);
    return job;
}

static void host_finish(void *handle, void *user)
{
    host *own = user;
    host_job *job = handle;
    own->finished++;
    for (int i = 0; own->threaded && i < HOST_THREADS; i++)
        pthread_join(job->threads[i], NULL);
    free(job);
}

/* Each share at once and nothing to wait for: the handle is null. */
static void *host_enqueue_at_once(pbmpm_task *task, int32_t count, void *context, void *user)
{
    host *own = user;
    own->enqueued++;
    own->largest = count > own->largest ? count : own->largest;
    for (int32_t i = 0; i < count; i++)
        task(i, context);
    return NULL;
}

static void host_finish_nothing(void *handle, void *user)
{
    host *own = user;
    own->finished += handle == NULL;
}

static void use_host(pbmpm_world_def *def, void *user)
{
    static pbmpm_task_hooks hooks = {sizeof hooks, 0, host_enqueue, host_finish, NULL};
    hooks.user = user;
    def->tasks = &hooks;
    def->thread_count = 4;
}

static void use_host_at_once(pbmpm_world_def *def, void *user)
{
    static pbmpm_task_hooks hooks = {sizeof hooks, 0, host_enqueue_at_once, host_finish_nothing, NULL};
    hooks.user = user;
    def->tasks = &hooks;
    def->thread_count = 7;
}

static uint64_t hash_with(const scene *plan, scene_tweak *tweak, void *user)
{
    const stage made = plan->build(tweak, user);
    scene_run(plan, &made, 0, 40);
    const uint64_t hash = world_hash(made.world);
    OK(pbmpm_world_destroy(made.world));
    return hash;
}

static void test_the_hosts_job_system_gives_the_same_results(void)
{
    static host threaded = {.threaded = true}, reversed, at_once;
    for (int i = 0; i < scene_count; i++) {
        const uint64_t right = hash_with(&scenes[i], NULL, NULL);
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(right, hash_with(&scenes[i], use_host, &threaded), scenes[i].name);
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(right, hash_with(&scenes[i], use_host, &reversed), scenes[i].name);
        TEST_ASSERT_EQUAL_HEX64_MESSAGE(right, hash_with(&scenes[i], use_host_at_once, &at_once), scenes[i].name);
    }
    TEST_ASSERT_TRUE_MESSAGE(threaded.enqueued > 0, "no scene is large enough to be cut into shares");
    TEST_ASSERT_EQUAL_INT(threaded.enqueued, threaded.finished);
    TEST_ASSERT_EQUAL_INT(at_once.enqueued, at_once.finished);
    TEST_ASSERT_TRUE(threaded.largest > 1);
}

/* ---- readers share a world ---- */

/* A job system that keeps a call inside the library until it is told to let it go on. */
typedef struct holding_host {
    pthread_mutex_t mutex;
    pthread_cond_t changed;
    bool holds, released;
    int enqueued;
} holding_host;

static void *enqueue_and_hold(pbmpm_task *task, int32_t count, void *context, void *user)
{
    holding_host *own = user;
    pthread_mutex_lock(&own->mutex);
    own->enqueued++;
    own->holds = true;
    pthread_cond_broadcast(&own->changed);
    while (!own->released)
        pthread_cond_wait(&own->changed, &own->mutex);
    pthread_mutex_unlock(&own->mutex);
    for (int32_t i = 0; i < count; i++)
        task(i, context);
    return NULL;
}

static void finish_held(void *handle, void *user)
{
    (void)handle;
    (void)user;
}

static void use_holding_host(pbmpm_world_def *def, void *user)
{
    static pbmpm_task_hooks hooks = {sizeof hooks, 0, enqueue_and_hold, finish_held, NULL};
    hooks.user = user;
    def->tasks = &hooks;
    def->thread_count = 2;
}

static void *query_many_points(void *user)
{
    static const float points[2 * 64];
    float filling[64];
    return pbmpm_query_points(*(const pbmpm_world_id *)user, points, 64, filling, NULL, NULL) == PBMPM_OK ? NULL : user;
}

/* An allocator that takes its time, and knows how many are inside of it. */
typedef struct slow_memory {
    atomic_int inside, most;
    atomic_bool slow;
} slow_memory;

static void come_and_go(slow_memory *own)
{
    const int now = atomic_fetch_add(&own->inside, 1) + 1;
    if (now > atomic_load(&own->most))
        atomic_store(&own->most, now);
    if (atomic_load(&own->slow))
        usleep(50000);
    atomic_fetch_sub(&own->inside, 1);
}

static void *slow_allocate(size_t size, size_t alignment, void *user)
{
    come_and_go(user);
    return host_allocate(size, alignment);
}

static void slow_release(void *memory, size_t size, void *user)
{
    (void)size;
    come_and_go(user);
    host_release(memory);
}

/* Readers that all need what is not there yet make it once, and one at a time is at the host's memory. */
static void test_readers_take_memory_one_at_a_time(void)
{
    enum { READERS = 4 };
    static slow_memory memory;
    const pbmpm_allocator allocator = {sizeof allocator, slow_allocate, slow_release, &memory};
    pbmpm_world_def def = default_world(2, 0.1f, 1000);
    def.allocator = &allocator;
    def.thread_count = 1;
    pbmpm_world_id world = create_world(&def);
    pthread_t threads[READERS];
    fill_shape(world, create_material(world, PBMPM_LIQUID), box_shape(0, 0, 0, 0.5f, 0.5f, 0), (const float[3]){0, 0, 0});
    atomic_store(&memory.slow, true);
    for (int i = 0; i < READERS; i++)
        TEST_ASSERT_EQUAL_INT(0, pthread_create(&threads[i], NULL, query_many_points, &world));
    for (int i = 0; i < READERS; i++) {
        void *failed = NULL;
        pthread_join(threads[i], &failed);
        TEST_ASSERT_NULL(failed);
    }
    atomic_store(&memory.slow, false);
    TEST_ASSERT_EQUAL_INT(1, atomic_load(&memory.most));
    OK(pbmpm_world_destroy(world));
}

static bool only_reads(const char *name)
{
    static const char *const readers[] = {
        "pbmpm_world_get_def", "pbmpm_world_get_settings", "pbmpm_world_generation", "pbmpm_world_hash", "pbmpm_world_get_stats", "pbmpm_world_get_step_stats",
        "pbmpm_world_events", "pbmpm_material_get", "pbmpm_collider_get", "pbmpm_query_collider", "pbmpm_collider_impulse", "pbmpm_domain_impulse",
        "pbmpm_baked_get", "pbmpm_particles_count", "pbmpm_particles_view", "pbmpm_particles_copy", "pbmpm_particles_find", "pbmpm_query_shape",
        "pbmpm_query_region", "pbmpm_query_points", "pbmpm_query_heights", "pbmpm_query_ray", "pbmpm_snapshot_size", "pbmpm_snapshot_save",
        "pbmpm_emitter_get", "pbmpm_emitter_status_get", "pbmpm_drain_get", "pbmpm_drain_status_get", "pbmpm_world_get_kill_bounds", "pbmpm_world_get_flow",
        "pbmpm_force_get", "pbmpm_force_status_get", "pbmpm_domain_wall_get", "pbmpm_world_get_materials", "pbmpm_world_get_colliders",
        "pbmpm_shape_mass", "pbmpm_rigid_begin", "pbmpm_world_get_emitters", "pbmpm_world_get_drains", "pbmpm_world_get_forces", "pbmpm_world_debug_lines",
        "pbmpm_surface_extract", "pbmpm_surface_points"};
    for (size_t i = 0; i < sizeof readers / sizeof *readers; i++)
        if (strcmp(name, readers[i]) == 0)
            return true;
    return false;
}

/* While one thread is inside a query others read as they like, and whoever would change something is refused. */
static void test_readers_share_a_world(void)
{
    static holding_host gatekeeper = {.mutex = PTHREAD_MUTEX_INITIALIZER, .changed = PTHREAD_COND_INITIALIZER};
    target ids = target_create(use_holding_host, &gatekeeper);
    void *failed = NULL;
    pthread_t thread;
    int readers = 0;
    const uint64_t before = world_hash(ids.world);
    TEST_ASSERT_EQUAL_INT(0, pthread_create(&thread, NULL, query_many_points, &ids.world));
    pthread_mutex_lock(&gatekeeper.mutex);
    while (!gatekeeper.holds)
        pthread_cond_wait(&gatekeeper.changed, &gatekeeper.mutex);
    pthread_mutex_unlock(&gatekeeper.mutex);
    const pbmpm_result alone = query_many_points(&ids.world) ? PBMPM_ERROR_BUSY : PBMPM_OK; /* large enough to be shared out; the threads are taken */
    pbmpm_result results[128];
    TEST_ASSERT_TRUE(world_call_count <= (int)(sizeof results / sizeof *results));
    for (int i = 0; i < world_call_count; i++)
        results[i] = world_calls[i].make(&ids);
    pthread_mutex_lock(&gatekeeper.mutex);
    gatekeeper.released = true;
    pthread_cond_broadcast(&gatekeeper.changed);
    pthread_mutex_unlock(&gatekeeper.mutex);
    pthread_join(thread, &failed);
    TEST_ASSERT_NULL(failed);
    OK(alone);
    TEST_ASSERT_EQUAL_INT(1, gatekeeper.enqueued);
    for (int i = 0; i < world_call_count; i++) {
        if (strcmp(world_calls[i].name, "pbmpm_world_step_done") == 0)
            continue; /* it reads, but there is no step */
        const char *expected = only_reads(world_calls[i].name) ? "PBMPM_OK" : "PBMPM_ERROR_BUSY";
        readers += only_reads(world_calls[i].name);
        TEST_ASSERT_EQUAL_STRING_MESSAGE(expected, pbmpm_result_name(results[i]), world_calls[i].name);
    }
    TEST_ASSERT_EQUAL_INT(43, readers);
    TEST_ASSERT_EQUAL_HEX64(before, world_hash(ids.world));
    OK(pbmpm_world_step(ids.world, 0.001f)); /* nobody is left inside */
}

/* What one may ask a world, and all of it once. */
typedef struct answers {
    float filling[64], heights[64], copied[2000];
    double mass, kinetic;
    pbmpm_ray_hit hit;
    pbmpm_particle_id first;
    uint64_t hash;
    uint32_t inside, shares, count, row;
    float place[2], kilograms;
    pbmpm_result worst;
} answers;

static void note(answers *told, pbmpm_result result)
{
    if (result != PBMPM_OK)
        told->worst = result;
}

static void ask(pbmpm_world_id world, answers *told)
{
    float points[2 * 64];
    pbmpm_shape ball;
    pbmpm_ray ray;
    pbmpm_copy_def copy;
    pbmpm_stats stats = {.size = sizeof stats};
    pbmpm_view place = {.size = sizeof place}, mass = place;
    memset(told, 0, sizeof *told);
    for (int i = 0; i < 64; i++) {
        points[2 * i] = 0.01f * (float)i;
        points[2 * i + 1] = 0.1f + 0.003f * (float)i;
    }
    note(told, pbmpm_shape_init(&ball, sizeof ball));
    ball.position[0] = ball.position[1] = 0.3f;
    note(told, pbmpm_ray_init(&ray, sizeof ray));
    ray.origin[0] = 0.3f;
    ray.origin[1] = 3.0f;
    told->hit.size = sizeof told->hit;
    note(told, pbmpm_query_ray(world, &ray, &told->hit));
    note(told, pbmpm_query_points(world, points, 64, told->filling, NULL, NULL));
    note(told, pbmpm_query_heights(world, points, 64, (const float[]){0, 1}, 0.5f, told->heights));
    note(told, pbmpm_query_shape(world, &ball, &told->first, 1, &told->inside));
    note(told, pbmpm_query_region(world, &ball, NULL, 0, &told->shares));
    note(told, pbmpm_particles_find(world, &told->first, 1, &told->row));
    note(told, pbmpm_world_get_stats(world, &stats));
    note(told, pbmpm_world_hash(world, &told->hash));
    note(told, pbmpm_copy_def_init(&copy, sizeof copy));
    copy.alpha = 0.5f;
    copy.stride = 20;
    static _Thread_local float room[20 * 20000];
    note(told, pbmpm_particles_copy(world, &copy, room, sizeof room, &told->count));
    memcpy(told->copied, room, sizeof told->copied);
    note(told, pbmpm_particles_view(world, PBMPM_MASS, &mass));
    note(told, pbmpm_particles_view(world, PBMPM_POSITION, &place));
    if (place.count > told->row)
        memcpy(told->place, (const char *)place.data + told->row * place.stride, sizeof told->place);
    if (mass.count > 0)
        memcpy(&told->kilograms, mass.data, sizeof told->kilograms);
    told->mass = stats.mass;
    told->kinetic = stats.kinetic_energy;
    told->first.generation = told->hit.particle.generation = told->hit.material.generation = 0; /* no two worlds share them */
}

enum { ASKERS = 3, ROUNDS = 12, TIMES = 8 };

typedef struct asker {
    pbmpm_world_id world;
    pthread_barrier_t *together;
    answers right;
    const answers *wanted;
    int wrong;
} asker;

static void *ask_often(void *user)
{
    asker *self = user;
    for (int round = 0; round < ROUNDS; round++) {
        pthread_barrier_wait(self->together); /* a step was made: nothing is there yet that readers make for each other */
        for (int i = 0; i < TIMES; i++) {
            ask(self->world, &self->right);
            self->wrong += memcmp(&self->right, self->wanted, sizeof self->right) != 0;
        }
        pthread_barrier_wait(self->together);
    }
    return NULL;
}

static void check_askers(scene_tweak *tweak, void *user)
{
    static answers wanted;
    static asker askers[ASKERS];
    const pbmpm_world_id world = tank_2d(tweak, user), twin = tank_2d(tweak, user);
    pthread_t threads[ASKERS];
    pthread_barrier_t together;
    TEST_ASSERT_EQUAL_INT(0, pthread_barrier_init(&together, NULL, ASKERS + 1));
    for (int i = 0; i < ASKERS; i++) {
        askers[i] = (asker){.world = world, .together = &together, .wanted = &wanted};
        TEST_ASSERT_EQUAL_INT(0, pthread_create(&threads[i], NULL, ask_often, &askers[i]));
    }
    pbmpm_result worst = PBMPM_OK;
    for (int round = 0; round < ROUNDS; round++) {
        const pbmpm_result one = pbmpm_world_step(world, 0.005f), other = pbmpm_world_step(twin, 0.005f);
        worst = one != PBMPM_OK ? one : other != PBMPM_OK ? other : worst;
        ask(twin, &wanted);
        pthread_barrier_wait(&together);
        pthread_barrier_wait(&together);
    }
    for (int i = 0; i < ASKERS; i++)
        pthread_join(threads[i], NULL);
    pthread_barrier_destroy(&together);
    OK(worst);
    OK(wanted.worst);
    TEST_ASSERT_TRUE(wanted.inside > 0 && wanted.hit.hit && wanted.mass > 0);
    for (int i = 0; i < ASKERS; i++)
        TEST_ASSERT_EQUAL_INT_MESSAGE(0, askers[i].wrong, pbmpm_result_name(askers[i].right.worst));
}

static void test_readers_get_right_answers(void)
{
    static host reversed;
    check_askers(NULL, NULL);
    check_askers(two_threads, NULL);
    check_askers(use_host, &reversed);
}

/* ---- nodes at walls ---- */

/* Jellies in the corners of a pool and on a ball: nodes there follow several faces and, at the ball, nodes that follow others. */
static uint64_t hash_of_corners(int32_t thread_count)
{
    pbmpm_world_def def = default_world(3, 0.05f, 32768);
    pbmpm_settings settings = default_settings();
    settings.gravity[1] = -9.81f;
    def.thread_count = thread_count;
    def.domain_enabled = 1;
    for (int a = 0; a < 3; a++) {
        def.domain_min[a] = 0.013f;
        def.domain_max[a] = a == 1 ? 1.6f : 0.813f;
    }
    const pbmpm_world_id world = create_world(&def);
    OK(pbmpm_world_set_settings(world, &settings));
    const pbmpm_material_id water = create_material(world, PBMPM_LIQUID), jelly = create_material(world, PBMPM_ELASTIC);
    create_collider(world, sphere_shape(0.41f, 0.05f, 0.41f, 0.21f), false);
    fill_shape(world, water, box_shape(0.413f, 0.263f, 0.413f, 0.4f, 0.25f, 0.4f), (const float[3]){0, 0, 0});
    fill_shape(world, jelly, box_shape(0.123f, 0.623f, 0.123f, 0.11f, 0.11f, 0.11f), (const float[3]){0, -2, 0});
    fill_shape(world, jelly, box_shape(0.413f, 0.623f, 0.413f, 0.11f, 0.11f, 0.11f), (const float[3]){0, -2, 0});
    for (int i = 0; i < 30; i++) OK(pbmpm_world_step(world, 1.0f / 60));
    const uint64_t hash = world_hash(world);
    OK(pbmpm_world_destroy(world));
    return hash;
}

static void test_nodes_at_walls_do_not_depend_on_threads(void)
{
    const uint64_t right = hash_of_corners(1);
    for (int32_t threads = 2; threads < 5; threads++) TEST_ASSERT_EQUAL_HEX64(right, hash_of_corners(threads));
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_every_call_is_refused_while_another_thread_steps);
    RUN_TEST(test_readers_take_memory_one_at_a_time);
    RUN_TEST(test_readers_share_a_world);
    RUN_TEST(test_readers_get_right_answers);
    RUN_TEST(test_racing_threads_do_no_harm);
    RUN_TEST(test_worlds_step_at_the_same_time);
    RUN_TEST(test_worlds_are_made_and_destroyed_at_the_same_time);
    RUN_TEST(test_a_world_may_change_its_thread);
    RUN_TEST(test_the_hosts_job_system_gives_the_same_results);
    RUN_TEST(test_nodes_at_walls_do_not_depend_on_threads);
    return UNITY_END();
}
