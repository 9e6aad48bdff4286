#include "sleep_pool.h"

#include <stdlib.h>

const float STILL[3] = {0, 0, 0};
const float DX = 0.05f, LENGTH = 4.0f, DT = 1.0f / 120;
const float PADDLE_X = 3.0f, PADDLE_Y = 0.56f, AT_X = 1.0f;
static const float DEPTH = 0.4f;

static void *saved; /* a snapshot of the pool asleep */
static uint64_t saved_bytes;

void change_settings(pbmpm_world_id world, void (*change)(pbmpm_settings *settings))
{
    pbmpm_settings settings = {.size = sizeof settings};
    OK(pbmpm_world_get_settings(world, &settings));
    change(&settings);
    OK(pbmpm_world_set_settings(world, &settings));
}

void to_sleep(pbmpm_settings *settings)
{
    settings->gravity[1] = -9.81f;
    settings->solver = PBMPM_SOLVER_DUAL;
    settings->iterations = 10;
    settings->sleeping = 1;
    settings->sleep_time = 0.2f;
}

pool make_pool(int32_t threads, ledger *book)
{
    pool made = {.book = book};
    pbmpm_world_def def = default_world(2, DX, MOST);
    def.domain_enabled = 1;
    def.domain_max[0] = LENGTH;
    def.domain_max[1] = 2.0f;
    def.thread_count = threads;
    if (book) def.allocator = ledger_allocator(book);
    made.world = create_world(&def);
    change_settings(made.world, to_sleep);
    made.water = create_material(made.world, PBMPM_LIQUID);
    made.paddle = create_collider(made.world, box_shape(PADDLE_X, PADDLE_Y, 0, 0.1f, 0.1f, 0.1f), true);
    made.force = create_force(made.world);
    made.emitter = create_emitter(made.world, made.water);
    return made;
}

void fill_pool(const pool *made)
{
    fill_shape(made->world, made->water, box_shape(0.5f * LENGTH, 0.5f * DEPTH, 0, 0.5f * LENGTH, 0.5f * DEPTH, 1), STILL);
}

void steps(const pool *made, int count)
{
    for (int i = 0; i < count; i++) OK(pbmpm_world_step(made->world, DT));
}

/* Steps until everything is asleep and nothing takes part any more. */
void rest(const pool *made)
{
    for (int i = 0; i < PATIENCE; i++) {
        steps(made, 1);
        const pbmpm_stats stats = world_stats(made->world);
        if (stats.particles_asleep == stats.particle_count && stats.particle_blocks == 0) return;
    }
    TEST_FAIL_MESSAGE("the pool does not fall asleep");
}

static void save(const pool *made)
{
    OK(pbmpm_snapshot_size(made->world, &saved_bytes, NULL));
    free(saved);
    saved = malloc(saved_bytes);
    OK(pbmpm_snapshot_save(made->world, saved, saved_bytes, NULL));
}

pool sleeping_pool(ledger *book)
{
    if (!saved) {
        const pool first = make_pool(1, NULL);
        fill_pool(&first);
        rest(&first);
        save(&first);
        OK(pbmpm_world_destroy(first.world));
    }
    const pool made = make_pool(1, book);
    OK(pbmpm_snapshot_restore(made.world, saved, saved_bytes, 0));
    return made;
}

void forget_pool(void)
{
    free(saved);
    saved = NULL;
}

/* ---- What wakes it ---- */

void not_at_all(pbmpm_settings *settings) { settings->sleeping = 0; }

void add_at(const pool *made, float y, float speed)
{
    const float position[] = {AT_X, y}, velocity[] = {0, speed};
    pbmpm_particles_def def;
    OK(pbmpm_particles_def_init(&def, sizeof def));
    def.material = made->water;
    def.count = 1;
    def.positions = position;
    def.velocities = velocity;
    OK(pbmpm_particles_add(made->world, &def, NULL));
}

void a_fast_particle_comes_in(const pool *made) { add_at(made, 0.45f, -2); }

void particles_are_removed(const pool *made)
{
    uint32_t removed;
    const pbmpm_shape shape = box_shape(AT_X, 0.2f, 0, 0.2f, 0.2f, 1);
    OK(pbmpm_particles_remove_in(made->world, &shape, &removed));
    TEST_ASSERT_TRUE(removed > 0);
}

void move_paddle(const pool *made, float y, bool at_once)
{
    const float position[] = {PADDLE_X, y, 0};
    OK((at_once ? pbmpm_collider_teleport : pbmpm_collider_move)(made->world, made->paddle, position, NULL));
}

void an_emitter_begins(const pool *made)
{
    const pbmpm_shape spout = sphere_shape(AT_X, 0.5f, 0, 0.05f);
    pbmpm_emitter_def def = {.size = sizeof def};
    OK(pbmpm_emitter_get(made->world, made->emitter, &def, NULL));
    def.direction[0] = 0;
    def.direction[1] = -1;
    def.speed = 1;
    def.rate = 300;
    def.budget = 10;
    OK(pbmpm_emitter_set(made->world, made->emitter, &def, &spout));
}

void a_call_wakes_a_shape(const pool *made)
{
    const pbmpm_shape shape = sphere_shape(AT_X, 0.2f, 0, 0.1f);
    OK(pbmpm_world_wake(made->world, &shape));
}

void a_call_wakes_all(const pool *made) { OK(pbmpm_world_wake(made->world, NULL)); }
