#include "rules.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "scenes.h"

target good;
snapshot before;

void rules_set_up(void)
{
    good = target_create(NULL, NULL);
    OK(pbmpm_world_step(good.world, 0.001f));
    const pbmpm_shape any = sphere_shape(1, 1, 0, 0.1f);
    uint32_t count;
    OK(pbmpm_query_shape(good.world, &any, NULL, 0, &count)); /* the first query takes memory */
    OK(pbmpm_collider_destroy(good.world, create_collider(good.world, any, false))); /* and so does one more obstacle */
    before = snapshot_take(good.world);
}

static void write_value(void *structure, const rule *field, double value)
{
    unsigned char *place = (unsigned char *)structure + field->offset;
    const float single = (float)value;
    /* Written so that NaN, which has no integer, becomes the lower bound. */
    const int32_t integer = (int32_t)(!(value > INT32_MIN) ? INT32_MIN : value > INT32_MAX ? INT32_MAX : value);
    const uint32_t whole = (uint32_t)(!(value > 0) ? 0 : value > UINT32_MAX ? UINT32_MAX : value);
    switch (field->type) {
    case FLOAT32: memcpy(place, &single, sizeof single); break;
    case FLOAT64: memcpy(place, &value, sizeof value); break;
    case INT32: memcpy(place, &integer, sizeof integer); break;
    case UINT32: memcpy(place, &whole, sizeof whole); break;
    }
}

/* The neighbour outside the range; beside zero the smallest normal number, for the library may flush smaller ones. */
static double next_below(const rule *field, double value)
{
    if (value == 0 && field->type == FLOAT32)
        return -(double)FLT_MIN;
    return field->type == FLOAT32 ? (double)nextafterf((float)value, -INFINITY) : field->type == FLOAT64 ? nextafter(value, -INFINITY) : value - 1;
}

static double next_above(const rule *field, double value)
{
    if (value == 0 && field->type == FLOAT32)
        return (double)FLT_MIN;
    return field->type == FLOAT32 ? (double)nextafterf((float)value, INFINITY) : field->type == FLOAT64 ? nextafter(value, INFINITY) : value + 1;
}

static void expect_use(use *apply, const void *structure, const rule *field, double value, bool taken)
{
    char label[200];
    const pbmpm_result result = apply(structure);
    const bool right = taken ? result == PBMPM_OK : result == PBMPM_ERROR_INVALID_ARGUMENT || result == PBMPM_ERROR_UNSUPPORTED;
    snprintf(label, sizeof label, "%s = %.9g gave %s", field->name, value, pbmpm_result_name(result));
    TEST_ASSERT_TRUE_MESSAGE(right, label);
    if (!taken)
        snapshot_expect_same(&before, good.world, label);
}

void check_rules(const rule *rules, size_t count, const void *sound, size_t size, use *apply)
{
    unsigned char copy[512];
    TEST_ASSERT_TRUE(size <= sizeof copy);
    for (size_t i = 0; i < count; i++) {
        const rule *field = &rules[i];
        const bool real = field->type == FLOAT32 || field->type == FLOAT64;
        const struct {
            double value;
            bool tried, taken;
        } cases[] = {
            {NAN, real, false},
            {INFINITY, real, false},
            {-INFINITY, real, false},
            {next_below(field, field->low), isfinite(field->low), false},
            {next_above(field, field->high), isfinite(field->high), false},
            {field->low, isfinite(field->low), !field->low_open},
            {field->high, isfinite(field->high), !field->high_open},
            {INT32_MIN, field->type == INT32, false},
            {INT32_MAX, field->type == INT32, false},
            {UINT32_MAX, field->type == UINT32, false},
        };
        for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
            if (!cases[k].tried)
                continue;
            memcpy(copy, sound, size);
            write_value(copy, field, cases[k].value);
            expect_use(apply, copy, field, cases[k].value, cases[k].taken);
        }
    }
}
