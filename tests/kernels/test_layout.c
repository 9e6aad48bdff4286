/* The structures that C and ISPC share have the same layout in both. */
#include <string.h>
#include <unity.h>

#include "isas.h"
#include "kernel_types.h"
#include "layout_fields.h"
#include "probes.h"

void setUp(void) {}
void tearDown(void) {}

typedef struct LayoutTable {
    int32_t value[LAYOUT_VALUES];
    int count;
} LayoutTable;

#define WRITE_FIELD(name)                                                                                                     \
    table.value[table.count++] = (int32_t)((const char *)&probe.name - (const char *)&probe);                                 \
    table.value[table.count++] = (int32_t)sizeof probe.name;

static LayoutTable layout_of_material(void)
{
    const KernelMaterial probe = {0};
    LayoutTable table = {{sizeof probe}, 1};
    KERNEL_MATERIAL_FIELDS(WRITE_FIELD)
    return table;
}

static LayoutTable layout_of_args(void)
{
    const KernelArgs probe = {0};
    LayoutTable table = {{sizeof probe}, 1};
    KERNEL_ARGS_FIELDS(WRITE_FIELD)
    return table;
}

static void check_same(const LayoutTable *expected, WriteLayout *write)
{
    int32_t actual[LAYOUT_VALUES];
    TEST_ASSERT_TRUE(expected->count < LAYOUT_VALUES);
    memset(actual, 0x5a, sizeof actual);
    write(actual);
    TEST_ASSERT_EQUAL_INT32_ARRAY(expected->value, actual, expected->count);
    TEST_ASSERT_EQUAL_HEX32(0x5a5a5a5a, actual[expected->count]);
}

static void test_ispc_and_c_agree(void)
{
    const LayoutTable material = layout_of_material(), args = layout_of_args();
    EACH_ISA(isa)
    {
        check_same(&material, layout_probes_for(isa)->material);
        check_same(&args, layout_probes_for(isa)->args);
    }
}

/* A field that is missing from the list would leave a gap that alignment does not explain. */
static void check_complete(const LayoutTable *table)
{
    int32_t end = 0;
    for (int i = 1; i < table->count; i += 2) {
        const int32_t offset = table->value[i], size = table->value[i + 1];
        TEST_ASSERT_TRUE(offset >= end && offset - end < (size % 8 == 0 ? 8 : 4));
        end = offset + size;
    }
    TEST_ASSERT_TRUE(table->value[0] >= end && table->value[0] - end < 8);
}

static void test_the_lists_of_fields_are_complete(void)
{
    const LayoutTable material = layout_of_material(), args = layout_of_args();
    check_complete(&material);
    check_complete(&args);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_ispc_and_c_agree);
    RUN_TEST(test_the_lists_of_fields_are_complete);
    return UNITY_END();
}
