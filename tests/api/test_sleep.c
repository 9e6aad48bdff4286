/* Sleeping: matter at rest falls asleep, wakes for each of its reasons and for nothing else, and what sleeps does not change by a bit. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "sleep_pool.h"

void setUp(void) {}

void tearDown(void) { pbmpm_shutdown(); }

/* ---- What changed ---- */

/* Particles by the index of their identifiers. */
typedef struct particle {
    float position[2], velocity[2], ratio;
    bool here;
} particle;

typedef struct picture {
    particle of[MOST];
} picture;

static picture picture_of(pbmpm_world_id world)
{
    picture all;
    memset(&all, 0, sizeof all);
    const pbmpm_view ids = view_of(world, PBMPM_PARTICLE), positions = view_of(world, PBMPM_POSITION);
    const pbmpm_view velocities = view_of(world, PBMPM_VELOCITY), ratios = view_of(world, PBMPM_VOLUME_RATIO);
    for (uint32_t row = 0; row < ids.count; row++) {
        particle *one = &all.of[view_uint(&ids, row, 0)];
        one->here = true;
        one->ratio = view_float(&ratios, row, 0);
        for (uint32_t a = 0; a < 2; a++) {
            one->position[a] = view_float(&positions, row, a);
            one->velocity[a] = view_float(&velocities, row, a);
        }
    }
    return all;
}

static bool is_same(const particle *a, const particle *b, bool but_for_velocity)
{
    if (!but_for_velocity) return memcmp(a, b, sizeof *a) == 0;
    return memcmp(a->position, b->position, sizeof a->position) == 0 && a->ratio == b->ratio;
}

/* Particles of both that have moved. */
static uint32_t count_moved(const picture *before, const picture *after)
{
    uint32_t moved = 0;
    for (int i = 0; i < MOST; i++)
        moved += before->of[i].here && after->of[i].here && !is_same(&before->of[i], &after->of[i], true);
    return moved;
}

/* Particles of both that are not the same to the last bit; the farthest of them from x. */
static uint32_t count_changed(const picture *before, const picture *after, float x, float *farthest)
{
    uint32_t changed = 0;
    if (farthest) *farthest = 0;
    for (int i = 0; i < MOST; i++) {
        const particle *a = &before->of[i], *b = &after->of[i];
        if (!a->here || !b->here || is_same(a, b, false)) continue;
        changed++;
        if (farthest) *farthest = fmaxf(*farthest, fabsf(a->position[0] - x));
    }
    return changed;
}

/* ---- Falling asleep ---- */

static void test_a_pool_at_rest_falls_asleep_and_stays_as_it_is(void)
{
    const pool made = sleeping_pool(NULL);
    const picture before = picture_of(made.world);
    const uint64_t hash = world_hash(made.world);
    steps(&made, 100);
    const pbmpm_stats stats = world_stats(made.world);
    const picture after = picture_of(made.world);
    TEST_ASSERT_EQUAL_UINT32(0, count_changed(&before, &after, 0, NULL));
    TEST_ASSERT_EQUAL_HEX64(hash, world_hash(made.world));
    TEST_ASSERT_EQUAL_UINT32(stats.particle_count, stats.particles_asleep);
    TEST_ASSERT_EQUAL_UINT32(0, stats.particle_blocks + stats.node_blocks + stats.blocks_drowsy + stats.blocks_woken);
    TEST_ASSERT_TRUE(stats.blocks_asleep >= 40);
    TEST_ASSERT_EQUAL_DOUBLE(0, stats.kinetic_energy);
    for (int a = 0; a < 2; a++) TEST_ASSERT_EQUAL_DOUBLE(0, stats.momentum[a]);
    TEST_ASSERT_TRUE(stats.simulated_seconds > 100 * (double)DT);
}

static void slow_only(pbmpm_settings *settings) { settings->sleep_speed = 0; }
static void long_only(pbmpm_settings *settings) { settings->sleep_time = 1e6f; }

static void test_nothing_falls_asleep_that_may_not(void)
{
    void (*const changes[])(pbmpm_settings *) = {slow_only, long_only, not_at_all};
    for (size_t i = 0; i < sizeof changes / sizeof *changes; i++) {
        const pool made = make_pool(1, NULL);
        fill_pool(&made);
        change_settings(made.world, changes[i]);
        steps(&made, 150);
        const pbmpm_stats stats = world_stats(made.world);
        TEST_ASSERT_EQUAL_UINT32(0, stats.particles_asleep + stats.blocks_asleep + stats.blocks_drowsy + stats.blocks_woken);
        OK(pbmpm_world_destroy(made.world));
    }
}

/* A load that is measured must be there at any time: the weight of the pool, less what floats nowhere. */
static void test_what_is_measured_stays_awake(void)
{
    pool made = make_pool(1, NULL);
    const pbmpm_shape shape = box_shape(1.0f, 0, 0, 0.3f, 0.1f, 1);
    pbmpm_collider_def def = default_collider();
    def.measures_impulse = 1;
    pbmpm_collider_id plate;
    OK(pbmpm_collider_create(made.world, &def, &shape, &plate));
    fill_pool(&made);
    steps(&made, PATIENCE);
    const pbmpm_stats stats = world_stats(made.world);
    pbmpm_impulse impulse = {.size = sizeof impulse};
    OK(pbmpm_collider_impulse(made.world, plate, &impulse));
    TEST_ASSERT_TRUE(stats.particles_asleep > stats.particle_count / 4 && stats.particles_asleep < stats.particle_count);
    /* At least half of the weight of the water above its top: 0.6 m wide, 0.3 m deep, 1000 kg/m^2. */
    TEST_ASSERT_TRUE(-impulse.linear[1] > 0.5 * 0.6 * 0.3 * 1000 * 9.81 * (double)DT);
}

/* ---- Reasons to wake ---- */

typedef enum reach { NOBODY, NEAR, ALL } reach;

typedef struct reason {
    const char *name;
    void (*act)(const pool *made);
    reach wakes;
    float x; /* near what */
} reason;

static void a_particle_is_put_in(const pool *made) { add_at(made, 0.2f, 0); }

static void one_is_removed(const pool *made)
{
    pbmpm_particle_id id;
    uint32_t count;
    const pbmpm_shape shape = sphere_shape(AT_X, 0.2f, 0, 0.03f);
    OK(pbmpm_query_shape(made->world, &shape, &id, 1, &count));
    TEST_ASSERT_TRUE(count > 0);
    OK(pbmpm_particles_remove(made->world, &id, 1));
}

static void one_is_pushed(const pool *made)
{
    pbmpm_particle_id id;
    uint32_t count;
    const float velocity[] = {0, 1};
    const pbmpm_shape shape = sphere_shape(AT_X, 0.2f, 0, 0.03f);
    OK(pbmpm_query_shape(made->world, &shape, &id, 1, &count));
    OK(pbmpm_particles_set(made->world, PBMPM_VELOCITY, &id, 1, velocity));
}

static void a_collider_appears(const pool *made) { create_collider(made->world, sphere_shape(AT_X, 0.3f, 0, 0.1f), false); }
static void a_collider_appears_far_off(const pool *made) { create_collider(made->world, sphere_shape(AT_X, 1.5f, 0, 0.1f), false); }
static void a_collider_goes(const pool *made) { OK(pbmpm_collider_destroy(made->world, made->paddle)); }

static void a_collider_moves(const pool *made) { move_paddle(made, 0.5f, false); }
static void a_collider_is_teleported(const pool *made) { move_paddle(made, 1.5f, true); }
static void a_collider_is_moved_to_where_it_is(const pool *made) { move_paddle(made, PADDLE_Y, false); }

static void a_collider_turns(const pool *made)
{
    const float position[] = {PADDLE_X, PADDLE_Y, 0}, turned[] = {0, 0, sinf(0.1f), cosf(0.1f)};
    OK(pbmpm_collider_move(made->world, made->paddle, position, turned));
}

static void a_drain_appears(const pool *made) { create_drain(made->world, sphere_shape(AT_X, 0.2f, 0, 0.1f)); }

static void change_force(const pool *made, bool everywhere, bool enabled)
{
    const pbmpm_shape shape = sphere_shape(AT_X, 0.2f, 0, 0.1f);
    pbmpm_force_def def = {.size = sizeof def};
    OK(pbmpm_force_get(made->world, made->force, &def, NULL));
    def.enabled = enabled;
    def.everywhere = everywhere;
    def.strength = 20;
    OK(pbmpm_force_set(made->world, made->force, &def, &shape));
}

static void a_force_is_switched_on(const pool *made) { change_force(made, false, true); }
static void a_force_acts_everywhere(const pool *made) { change_force(made, true, true); }
static void a_force_that_is_off_is_set(const pool *made) { change_force(made, true, false); }

/* It ends a cell above the water, whose outermost nodes feel it. */
static void a_force_begins_beside(const pool *made)
{
    const pbmpm_shape shape = sphere_shape(AT_X, 0.4f + DX + 0.1f, 0, 0.1f);
    pbmpm_force_def def = {.size = sizeof def};
    OK(pbmpm_force_get(made->world, made->force, &def, NULL));
    def.enabled = 1;
    def.everywhere = 0;
    OK(pbmpm_force_set(made->world, made->force, &def, &shape));
}

static void a_call_wakes_air(const pool *made)
{
    const pbmpm_shape shape = sphere_shape(AT_X, 1.5f, 0, 0.1f);
    OK(pbmpm_world_wake(made->world, &shape));
}

static void heavier(pbmpm_settings *settings) { settings->gravity[1] = -10; }
static void longer(pbmpm_settings *settings) { settings->iterations++; }
static void the_papers(pbmpm_settings *settings) { settings->solver = PBMPM_SOLVER_PAPER; }
static void in_two(pbmpm_settings *settings) { settings->substeps = 2; }
static void of_no_matter(pbmpm_settings *settings)
{
    settings->target_error = 0.01f;
    settings->time_budget_ms = 100;
    settings->sleep_speed *= 2;
    settings->sleep_time *= 2;
}
static void gravity_changes(const pool *made) { change_settings(made->world, heavier); }
static void iterations_change(const pool *made) { change_settings(made->world, longer); }
static void the_solver_changes(const pool *made) { change_settings(made->world, the_papers); }
static void substeps_change(const pool *made) { change_settings(made->world, in_two); }
static void sleeping_ends(const pool *made) { change_settings(made->world, not_at_all); }
static void settings_of_no_matter_change(const pool *made) { change_settings(made->world, of_no_matter); }

static void the_material_changes(const pool *made)
{
    pbmpm_material_def def = {.size = sizeof def};
    OK(pbmpm_material_get(made->world, made->water, &def));
    def.bulk_modulus = 1e6f;
    OK(pbmpm_material_set(made->world, made->water, &def));
}

static void kill_bounds_change(const pool *made)
{
    pbmpm_kill_bounds bounds;
    OK(pbmpm_kill_bounds_init(&bounds, sizeof bounds));
    bounds.enabled = 1;
    bounds.low[0] = bounds.low[1] = -10;
    bounds.high[0] = bounds.high[1] = 10;
    OK(pbmpm_world_set_kill_bounds(made->world, &bounds));
}

static void a_longer_step(const pool *made) { OK(pbmpm_world_step(made->world, 1.2f * DT)); }
static void a_hardly_longer_step(const pool *made) { OK(pbmpm_world_step(made->world, 1.05f * DT)); }

static void somebody_looks(const pool *made)
{
    float point[] = {AT_X, 0.2f}, filling;
    OK(pbmpm_query_points(made->world, point, 1, &filling, NULL, NULL));
    TEST_ASSERT_FLOAT_WITHIN(0.3f, 1.0f, filling);
}

static const reason reasons[] = {
    {"a fast particle comes in", a_fast_particle_comes_in, NEAR, 1.0f},
    {"a particle is put in", a_particle_is_put_in, NEAR, 1.0f},
    {"particles are removed", particles_are_removed, NEAR, 1.0f},
    {"one is removed", one_is_removed, NEAR, 1.0f},
    {"one is pushed", one_is_pushed, NEAR, 1.0f},
    {"a collider appears", a_collider_appears, NEAR, 1.0f},
    {"a collider appears far off", a_collider_appears_far_off, NOBODY, 0},
    {"a collider goes", a_collider_goes, NEAR, 3.0f},
    {"a collider moves", a_collider_moves, NEAR, 3.0f},
    {"a collider is teleported", a_collider_is_teleported, NEAR, 3.0f},
    {"a collider turns", a_collider_turns, NEAR, 3.0f},
    {"a collider is moved to where it is", a_collider_is_moved_to_where_it_is, NOBODY, 0},
    {"a drain appears", a_drain_appears, NEAR, 1.0f},
    {"a force is switched on", a_force_is_switched_on, NEAR, 1.0f},
    {"a force begins beside", a_force_begins_beside, NEAR, 1.0f},
    {"a force acts everywhere", a_force_acts_everywhere, ALL, 0},
    {"a force that is off is set", a_force_that_is_off_is_set, NOBODY, 0},
    {"an emitter begins", an_emitter_begins, NEAR, 1.0f},
    {"a call wakes a shape", a_call_wakes_a_shape, NEAR, 1.0f},
    {"a call wakes air", a_call_wakes_air, NOBODY, 0},
    {"a call wakes all", a_call_wakes_all, ALL, 0},
    {"gravity changes", gravity_changes, ALL, 0},
    {"iterations change", iterations_change, ALL, 0},
    {"the solver changes", the_solver_changes, ALL, 0},
    {"substeps change", substeps_change, ALL, 0},
    {"sleeping ends", sleeping_ends, ALL, 0},
    {"the material changes", the_material_changes, ALL, 0},
    {"kill bounds change", kill_bounds_change, ALL, 0},
    {"a longer step", a_longer_step, ALL, 0},
    {"settings of no matter change", settings_of_no_matter_change, NOBODY, 0},
    {"a hardly longer step", a_hardly_longer_step, NOBODY, 0},
    {"somebody looks", somebody_looks, NOBODY, 0},
};

static void expect_woken(const reason *why, const pool *made, const picture *before)
{
    float farthest;
    char label[120];
    bool awake = false;
    for (int i = 0; i < 12; i++) {
        steps(made, 1);
        const pbmpm_stats stats = world_stats(made->world);
        awake = awake || (why->wakes == ALL ? stats.particles_asleep == 0 : stats.particles_asleep < stats.particle_count);
        if (why->wakes == ALL) break;
    }
    const picture after = picture_of(made->world);
    const uint32_t changed = count_changed(before, &after, why->x, &farthest);
    const pbmpm_stats stats = world_stats(made->world);
    snprintf(label, sizeof label, "%s: %u changed, up to %.2f m away; %u of %u asleep", why->name, changed, (double)farthest,
             stats.particles_asleep, stats.particle_count);
    TEST_ASSERT_EQUAL_MESSAGE(why->wakes != NOBODY, awake, label);
    TEST_ASSERT_EQUAL_MESSAGE(why->wakes != NOBODY, changed > 0, label);
    /* Motion spreads by no more than the block that something is in and the next one per step. */
    if (why->wakes == NEAR) TEST_ASSERT_TRUE_MESSAGE(farthest < 1.5f && stats.particles_asleep > 0, label);
    if (why->wakes == NEAR) TEST_ASSERT_TRUE_MESSAGE(stats.particles_asleep > stats.particle_count / 4, label);
}

static void test_each_reason_wakes_what_it_touches_and_no_more(void)
{
    for (size_t i = 0; i < sizeof reasons / sizeof *reasons; i++) {
        const pool made = sleeping_pool(NULL);
        const picture before = picture_of(made.world);
        reasons[i].act(&made);
        expect_woken(&reasons[i], &made, &before);
        OK(pbmpm_world_destroy(made.world));
    }
}

/* ---- A drop ---- */

/* In every step no more particles change than are awake, and those that sleep are the same to the bit. */
static void test_a_drop_changes_nothing_that_sleeps(void)
{
    const pool made = sleeping_pool(NULL);
    picture before = picture_of(made.world);
    const picture first = before;
    uint32_t least_asleep = UINT32_MAX;
    a_fast_particle_comes_in(&made);
    for (int i = 0; i < 200; i++) {
        steps(&made, 1);
        const pbmpm_stats stats = world_stats(made.world);
        const picture after = picture_of(made.world);
        TEST_ASSERT_TRUE(count_moved(&before, &after) <= stats.particle_count - stats.particles_asleep);
        least_asleep = stats.particles_asleep < least_asleep ? stats.particles_asleep : least_asleep;
        before = after;
    }
    float farthest;
    const uint32_t changed = count_changed(&first, &before, AT_X, &farthest);
    TEST_ASSERT_TRUE(changed >= 8); /* it was felt */
    TEST_ASSERT_TRUE(farthest < 1.0f);
    TEST_ASSERT_TRUE(least_asleep > 2560 / 2);
    rest(&made); /* and all come to rest again */
}

/* Where water was taken away, the rest must not hang in the air: it flows down and fills the hole. */
static void test_a_hole_fills_up(void)
{
    const pool made = sleeping_pool(NULL);
    uint32_t removed, left;
    const pbmpm_shape whole = box_shape(1.0f, 0.2f, 0, 0.4f, 0.25f, 1), low = box_shape(1.0f, 0.05f, 0, 0.4f, 0.05f, 1);
    const picture before = picture_of(made.world);
    OK(pbmpm_particles_remove_in(made.world, &whole, &removed));
    steps(&made, 240);
    const picture after = picture_of(made.world);
    float farthest;
    count_changed(&before, &after, 1.0f, &farthest);
    OK(pbmpm_query_shape(made.world, &low, NULL, 0, &left));
    TEST_ASSERT_TRUE(removed > 400);
    /* 0.8 m by 0.1 m hold 128 particles. */
    TEST_ASSERT_TRUE(left > 96);
    /* Blocks out of which something was taken end 0.6 m away; the others woke because nothing held them. */
    TEST_ASSERT_TRUE(farthest > 0.9f);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_pool_at_rest_falls_asleep_and_stays_as_it_is);
    RUN_TEST(test_nothing_falls_asleep_that_may_not);
    RUN_TEST(test_what_is_measured_stays_awake);
    RUN_TEST(test_each_reason_wakes_what_it_touches_and_no_more);
    RUN_TEST(test_a_drop_changes_nothing_that_sleeps);
    RUN_TEST(test_a_hole_fills_up);
    forget_pool();
    return UNITY_END();
}
