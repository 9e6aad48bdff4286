/* Materials: slots, generations, ranges, and what the kernels are told. */
#include <math.h>
#include <unity.h>

#include "matter/materials.h"

void setUp(void) {}
void tearDown(void) {}

static Materials materials;

static void test_slots_and_generations(void)
{
    materials = (Materials){0};
    const pbmpm_material_def def = material_defaults();
    pbmpm_material_id id, first = {0};
    for (uint32_t i = 0; i < PBMPM_MAX_MATERIALS; i++) {
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&materials, &def, i + 100, &id));
        TEST_ASSERT_TRUE(id.index == i && id.generation == i + 100);
        TEST_ASSERT_TRUE(material_is_live(&materials, id));
        if (i == 0) first = id;
    }
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_CAPACITY, materials_add(&materials, &def, 999, &id));
    materials.generation[0] = 0;
    TEST_ASSERT_FALSE(material_is_live(&materials, first));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&materials, &def, 1000, &id));
    TEST_ASSERT_EQUAL_UINT32(0, id.index);
    TEST_ASSERT_TRUE(material_is_live(&materials, id));
    TEST_ASSERT_FALSE(material_is_live(&materials, first));
    TEST_ASSERT_FALSE(material_is_live(&materials, (pbmpm_material_id){0, 0}));
    TEST_ASSERT_FALSE(material_is_live(&materials, (pbmpm_material_id){PBMPM_MAX_MATERIALS, 1000}));
}

/* Each parameter: the ends of its range are valid, just beyond them and NaN are not. */
typedef struct Range {
    float *field;
    float low, high;
} Range;

static void check_range(pbmpm_material_def *def, Range range, bool open)
{
    const float kept = *range.field;
    const float inside[] = {open ? nextafterf(range.low, range.high) : range.low, open ? nextafterf(range.high, range.low) : range.high};
    const float outside[] = {open ? range.low : nextafterf(range.low, -INFINITY),
                             open ? range.high : nextafterf(range.high, INFINITY), NAN, INFINITY, -INFINITY};
    for (int i = 0; i < 2; i++) {
        *range.field = inside[i];
        TEST_ASSERT_NULL(material_problem(def));
    }
    for (int i = 0; i < 5; i++) {
        *range.field = outside[i];
        TEST_ASSERT_NOT_NULL(material_problem(def));
    }
    *range.field = kept;
}

static void test_ranges(void)
{
    for (int kind = PBMPM_LIQUID; kind <= PBMPM_VISCO; kind++) {
        pbmpm_material_def def = material_defaults();
        def.kind = (pbmpm_material_kind)kind;
        TEST_ASSERT_NULL(material_problem(&def));
        check_range(&def, (Range){&def.density, 1e-3f, 1e6f}, false);
        check_range(&def, (Range){&def.relaxation, 0.0f, 2.0f}, true);
        check_range(&def, (Range){&def.viscosity, 0.0f, 1.0f}, false);
        check_range(&def, (Range){&def.volume_feedback, 0.0f, 1.0f}, false);
        check_range(&def, (Range){&def.elasticity_ratio, kind >= PBMPM_SAND ? 0.01f : 0.0f, 1.0f}, false);
        check_range(&def, (Range){&def.strain_min, 1e-3f, 1.0f}, false);
        check_range(&def, (Range){&def.strain_max, 1.0f, 1e4f}, false);
        check_range(&def, (Range){&def.condition_max, 10.0f, 1e6f}, false);
        check_range(&def, (Range){&def.friction_angle, 0.0f, 1.4f}, false);
        check_range(&def, (Range){&def.cohesion, 0.0f, 0.5f}, false);
        check_range(&def, (Range){&def.yield_strain, 0.0f, 10.0f}, false);
        check_range(&def, (Range){&def.flow_rate, 0.0f, 1e9f}, false);
        def.volume_correction = 2;
        TEST_ASSERT_NOT_NULL(material_problem(&def));
        def.volume_correction = 0;
        TEST_ASSERT_NULL(material_problem(&def));
        def.rebound_max = 10.0f;
        TEST_ASSERT_NULL(material_problem(&def));
        def.rebound_max = 0.0f;
        TEST_ASSERT_NOT_NULL(material_problem(&def));
    }
}

static void test_unknown_kinds_are_refused(void)
{
    pbmpm_material_def def = material_defaults();
    def.kind = (pbmpm_material_kind)4;
    TEST_ASSERT_NOT_NULL(material_problem(&def));
    def = material_defaults();
    def.strain_policy = (pbmpm_strain_policy)2;
    TEST_ASSERT_NOT_NULL(material_problem(&def));
}

/* What a kind does not have is 0 for the kernels: it must cost nothing. */
static void test_kernels_are_told_what_a_kind_has(void)
{
    pbmpm_material_def def = material_defaults();
    materials = (Materials){0};
    def.viscosity = 0.3f;
    def.volume_feedback = 0.4f;
    def.density = 250.0f;
    materials_set(&materials, 7, &def);
    const KernelMaterial *kernel = &materials.kernel[7];
    TEST_ASSERT_EQUAL_INT32(K_LIQUID, kernel->kind);
    TEST_ASSERT_EQUAL_FLOAT(0.3f, kernel->viscosity);
    TEST_ASSERT_EQUAL_FLOAT(0.4f, kernel->volume_feedback);
    TEST_ASSERT_EQUAL_FLOAT(0.004f, kernel->inverse_density);
    def.kind = PBMPM_ELASTIC;
    def.condition_max = 500.0f;
    materials_set(&materials, 7, &def);
    TEST_ASSERT_EQUAL_INT32(K_SOLID, kernel->kind);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, kernel->viscosity);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, kernel->volume_feedback);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, kernel->condition_max); /* strain is clamped */
    def.strain_policy = PBMPM_STRAIN_DELETE;
    materials_set(&materials, 7, &def);
    TEST_ASSERT_EQUAL_FLOAT(500.0f, kernel->condition_max);
}

/* Volumes on the grid are wanted by particles of liquids with feedback, by nobody else. */
static void test_who_wants_volume(void)
{
    pbmpm_material_def def = material_defaults();
    pbmpm_material_id id;
    Particles particles = {0};
    materials = (Materials){0};
    TEST_ASSERT_FALSE(materials_want_volume(&materials, &particles));
    def.kind = PBMPM_ELASTIC;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&materials, &def, 1, &id));
    particles.of_material[id.index] = 1;
    def.kind = PBMPM_LIQUID;
    def.volume_feedback = 0.0f;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&materials, &def, 2, &id));
    particles.of_material[id.index] = 1;
    TEST_ASSERT_FALSE(materials_want_volume(&materials, &particles));
    def.volume_feedback = 0.01f;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&materials, &def, 3, &id));
    TEST_ASSERT_FALSE(materials_want_volume(&materials, &particles)); /* no particle has it */
    particles.of_material[id.index] = 1;
    TEST_ASSERT_TRUE(materials_want_volume(&materials, &particles));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_slots_and_generations);
    RUN_TEST(test_ranges);
    RUN_TEST(test_unknown_kinds_are_refused);
    RUN_TEST(test_kernels_are_told_what_a_kind_has);
    RUN_TEST(test_who_wants_volume);
    return UNITY_END();
}
