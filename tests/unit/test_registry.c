/* The registry: identifiers are never reused, and a world is held by one caller that writes, or by readers. The registry never looks into a
 * world, except when it destroys all. */
#include <pthread.h>
#include <unity.h>

#include "base/generations.h"
#include "services/lifecycle.h"
#include "services/registry.h"

void setUp(void) {}
void tearDown(void) {}

static World worlds[4];

static void test_generations_are_new(void)
{
    uint32_t last = generation_next();
    for (int i = 0; i < 1000; i++) {
        const uint32_t generation = generation_next();
        TEST_ASSERT_TRUE(generation != 0 && generation > last);
        last = generation;
    }
}

static pbmpm_world_id add(World *world)
{
    pbmpm_world_id id;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, registry_add(world, &id));
    TEST_ASSERT_TRUE(id.generation != 0);
    return id;
}

static void remove_again(pbmpm_world_id id, const World *expected)
{
    World *world;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, registry_remove(id, &world));
    TEST_ASSERT_EQUAL_PTR(expected, world);
}

static void test_identifiers_lead_to_their_worlds(void)
{
    pbmpm_world_id ids[4];
    for (int i = 0; i < 4; i++) ids[i] = add(&worlds[i]);
    for (int i = 0; i < 4; i++) {
        World *world;
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, registry_enter(ids[i], &world));
        TEST_ASSERT_EQUAL_PTR(&worlds[i], world);
        registry_leave(ids[i]);
    }
    for (int i = 0; i < 4; i++) remove_again(ids[i], &worlds[i]);
}

static void expect_unknown(pbmpm_world_id id)
{
    World *world;
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_INVALID_ID, registry_enter(id, &world));
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_INVALID_ID, registry_remove(id, &world));
}

static void test_stale_and_made_up_identifiers_are_refused(void)
{
    const pbmpm_world_id first = add(&worlds[0]);
    remove_again(first, &worlds[0]);
    expect_unknown(first);
    const pbmpm_world_id second = add(&worlds[1]); /* may sit in the same slot */
    TEST_ASSERT_TRUE(second.generation != first.generation);
    expect_unknown(first);
    expect_unknown((pbmpm_world_id){0});
    expect_unknown((pbmpm_world_id){second.index, second.generation + 1});
    expect_unknown((pbmpm_world_id){second.index + 1, second.generation});
    expect_unknown((pbmpm_world_id){PBMPM_MAX_WORLDS, second.generation});
    expect_unknown((pbmpm_world_id){UINT32_MAX, UINT32_MAX});
    remove_again(second, &worlds[1]);
}

static void *try_to_enter(void *context)
{
    World *world;
    const pbmpm_world_id *id = context;
    const pbmpm_result result = registry_enter(*id, &world);
    if (result == PBMPM_OK) registry_leave(*id);
    return (void *)(intptr_t)result;
}

static pbmpm_result result_on_another_thread(pbmpm_world_id id)
{
    pthread_t thread;
    void *result;
    TEST_ASSERT_EQUAL_INT(0, pthread_create(&thread, NULL, try_to_enter, &id));
    pthread_join(thread, &result);
    return (pbmpm_result)(intptr_t)result;
}

static void test_a_world_is_held_by_one_caller(void)
{
    const pbmpm_world_id id = add(&worlds[0]), other = add(&worlds[1]);
    World *world;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, registry_enter(id, &world));
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_BUSY, result_on_another_thread(id));
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_BUSY, registry_remove(id, &world));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, result_on_another_thread(other));
    registry_leave(id);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, result_on_another_thread(id));
    remove_again(id, &worlds[0]);
    remove_again(other, &worlds[1]);
}

static void test_capacity(void)
{
    static pbmpm_world_id ids[PBMPM_MAX_WORLDS];
    pbmpm_world_id extra;
    for (int i = 0; i < PBMPM_MAX_WORLDS; i++) ids[i] = add(&worlds[i % 4]);
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_CAPACITY, registry_add(&worlds[0], &extra));
    remove_again(ids[17], &worlds[17 % 4]);
    const pbmpm_world_id again = add(&worlds[2]);
    TEST_ASSERT_EQUAL_UINT32(ids[17].index, again.index);
    expect_unknown(ids[17]);
    ids[17] = again;
    for (int i = 0; i < PBMPM_MAX_WORLDS; i++) remove_again(ids[i], &worlds[i == 17 ? 2 : i % 4]);
}

static void test_clear_destroys_all(void)
{
    pbmpm_world_def def = world_def_defaults();
    pbmpm_world_id ids[3];
    def.particle_capacity = 10;
    for (int i = 0; i < 3; i++) {
        World *world;
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_create(&def, &world));
        ids[i] = add(world);
    }
    registry_clear();
    for (int i = 0; i < 3; i++) expect_unknown(ids[i]);
}

static void test_readers_share_and_writers_do_not(void)
{
    const pbmpm_world_id id = add(&worlds[0]);
    World *world;
    for (int i = 0; i < 3; i++) TEST_ASSERT_EQUAL_INT(PBMPM_OK, registry_enter_to_read(id, &world));
    TEST_ASSERT_EQUAL_PTR(&worlds[0], world);
    for (int i = 0; i < 3; i++) { /* until the last has left */
        TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_BUSY, registry_enter(id, &world));
        TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_BUSY, registry_remove(id, &world));
        registry_leave(id);
    }
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, registry_enter(id, &world));
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_BUSY, registry_enter_to_read(id, &world));
    registry_leave(id);
    TEST_ASSERT_FALSE(worlds[0].frozen);
    remove_again(id, &worlds[0]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_generations_are_new);
    RUN_TEST(test_identifiers_lead_to_their_worlds);
    RUN_TEST(test_stale_and_made_up_identifiers_are_refused);
    RUN_TEST(test_a_world_is_held_by_one_caller);
    RUN_TEST(test_capacity);
    RUN_TEST(test_clear_destroys_all);
    RUN_TEST(test_readers_share_and_writers_do_not);
    return UNITY_END();
}
