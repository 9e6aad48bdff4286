/* A host that loads the library at run time and unloads it again, as game engines do with plugins. */
#include <stdbool.h>
#include <string.h>

#include <pbmpm/pbmpm.h>
#include <unity.h>

#include "host.h"

/* The functions this test calls; it is not linked to the library. */
typedef struct library {
    void *handle;
    pbmpm_result (*world_def_init)(pbmpm_world_def *, size_t);
    pbmpm_result (*world_create)(const pbmpm_world_def *, pbmpm_world_id *);
    pbmpm_result (*world_step)(pbmpm_world_id, float);
    pbmpm_result (*shutdown)(void);
} library;

void setUp(void)
{
}

void tearDown(void)
{
}

/* Systems let what they find be a function; C does not, hence the copy. */
static void find(const library *loaded, const char *name, void *function)
{
    void *symbol = host_find(loaded->handle, name);
    TEST_ASSERT_NOT_NULL_MESSAGE(symbol, name);
    memcpy(function, &symbol, sizeof symbol);
}

static library load(void)
{
    library loaded = {.handle = host_load(PBMPM_TEST_LIBRARY)};
    TEST_ASSERT_NOT_NULL_MESSAGE(loaded.handle, PBMPM_TEST_LIBRARY);
    find(&loaded, "pbmpm_world_def_init", &loaded.world_def_init);
    find(&loaded, "pbmpm_world_create", &loaded.world_create);
    find(&loaded, "pbmpm_world_step", &loaded.world_step);
    find(&loaded, "pbmpm_shutdown", &loaded.shutdown);
    return loaded;
}

static void make_a_world_with_threads(const library *loaded)
{
    pbmpm_world_def def;
    pbmpm_world_id world;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, loaded->world_def_init(&def, sizeof def));
    def.thread_count = 4;
    def.particle_capacity = 1000;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, loaded->world_create(&def, &world));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, loaded->world_step(world, 0.01f));
}

static bool library_is_mapped(void) { return host_has_loaded(PBMPM_TEST_LIBRARY_NAME); }

static void test_unload_after_shutdown(void)
{
    const int threads_before = host_thread_count();
    TEST_ASSERT_FALSE(library_is_mapped());
    for (int round = 0; round < 3; round++) {
        library loaded = load();
        TEST_ASSERT_TRUE(library_is_mapped());
        make_a_world_with_threads(&loaded);
        TEST_ASSERT_EQUAL_INT(threads_before + 3, host_thread_count());
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, loaded.shutdown());
        TEST_ASSERT_EQUAL_INT(threads_before, host_thread_count());
        TEST_ASSERT_TRUE(host_unload(loaded.handle));
        TEST_ASSERT_FALSE(library_is_mapped());
    }
}

/* A host that forgets: no thread may be left in code that is gone. On Windows threads cannot be waited for there: they keep the library loaded until a
 * host that finds it again ends them. */
static void test_unload_without_shutdown(void)
{
    const int threads_before = host_thread_count();
    library loaded = load();
    make_a_world_with_threads(&loaded);
    TEST_ASSERT_TRUE(host_unload(loaded.handle));
#if defined(_WIN32)
    TEST_ASSERT_TRUE(library_is_mapped());
    loaded = load();
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, loaded.shutdown());
    TEST_ASSERT_TRUE(host_unload(loaded.handle));
#endif
    TEST_ASSERT_FALSE(library_is_mapped());
    TEST_ASSERT_EQUAL_INT(threads_before, host_thread_count());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_unload_after_shutdown);
    RUN_TEST(test_unload_without_shutdown);
    return UNITY_END();
}
