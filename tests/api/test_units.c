/* Whoever measures mass in other units sees the same motion: no law knows how heavy a kilogram is. A factor that is a power of two changes no rounding. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "solvers.h"

#ifdef PBMPM_SANITIZED
enum { EACH = 3 }; /* ways to solve */
#else
enum { EACH = 1 };
#endif

void setUp(void)
{
}

void tearDown(void)
{
    pbmpm_shutdown();
}

/* A column of liquid that slumps onto a step, and a body that falls into it; masses and moduli by a factor. */
static pbmpm_world_id slump(int32_t dimension, const way *chosen, pbmpm_material_kind kind, float factor)
{
    pbmpm_world_def def = default_world(dimension, 0.1f, 8000);
    pbmpm_material_def material = soft_material(kind);
    pbmpm_material_id id;
    def.thread_count = 1;
    def.domain_enabled = 1;
    def.domain_max[0] = def.domain_max[1] = 1.6f;
    def.domain_max[2] = 0.5f;
    const pbmpm_world_id world = create_world(&def);
    use_way(world, chosen);
    set_rate(world, chosen->solver == PBMPM_SOLVER_EXPLICIT ? 8 : 1, 5);
    set_gravity(world, 0, -9.81f, 0);
    material.density *= factor;
    material.young_modulus *= factor;
    material.bulk_modulus *= factor;
    OK(pbmpm_material_create(world, &material, &id));
    create_collider(world, box_shape(1.0f, 0.05f, 0.25f, 0.2f, 0.12f, 1), false);
    fill_shape(world, id, box_shape(0.3f, 0.6f, 0.25f, 0.3f, 0.5f, 0.25f), (const float[3]){0.5f, 0, 0});
    return world;
}

static void run(pbmpm_world_id world)
{
    for (int i = 0; i < 40; i++)
        OK(pbmpm_world_step(world, 1.0f / 60));
}

static void check(pbmpm_world_id one, pbmpm_world_id other, const char *label)
{
    const pbmpm_field fields[] = {PBMPM_POSITION, PBMPM_VELOCITY};
    for (int f = 0; f < 2; f++) {
        const pbmpm_view left = view_of(one, fields[f]), right = view_of(other, fields[f]);
        uint32_t differ = 0;
        double most = 0.0;
        TEST_ASSERT_EQUAL_UINT32_MESSAGE(left.count, right.count, label);
        for (uint32_t row = 0; row < left.count; row++)
            for (uint32_t c = 0; c < left.components; c++) {
                const float a = view_float(&left, row, c), b = view_float(&right, row, c);
                differ += a != b;
                most = fmax(most, fabs((double)a - (double)b));
            }
        char text[200];
        snprintf(text, sizeof text, "%s: %u of %u values of field %d differ, by %g at most", label, differ, left.count * left.components, (int)fields[f], most);
        TEST_ASSERT_TRUE_MESSAGE(differ == 0, text);
    }
}

static void test_units_of_mass_change_no_motion(void)
{
    static const pbmpm_material_kind kinds[] = {PBMPM_LIQUID, PBMPM_ELASTIC, PBMPM_SAND, PBMPM_VISCO};
    static const char *const names[] = {"liquid", "elastic", "sand", "visco"};
    static const float factors[] = {1.0f / 8192.0f, 256.0f};
    for (int w = 0; w < way_count; w += EACH)
        for (int k = 0; k < 4; k++) {
            const int32_t dimension = 2 + (w + k) % 2;
            const pbmpm_world_id one = slump(dimension, &ways[w], kinds[k], 1.0f), other = slump(dimension, &ways[w], kinds[k], factors[k % 2]);
            char label[100];
            snprintf(label, sizeof label, "%s, %s in %dD", ways[w].name, names[k], (int)dimension);
            run(one);
            run(other);
            check(one, other, label);
            OK(pbmpm_shutdown());
        }
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_units_of_mass_change_no_motion);
    return UNITY_END();
}
