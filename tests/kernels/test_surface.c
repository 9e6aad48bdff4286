/* The kernels of surfaces against the same sums in double precision. */
#include <math.h>
#include <string.h>

#include <unity.h>

#include "check.h"
#include "isas.h"
#include "random.h"
#include "skin/blocks.h"

/* Sums of fewer than 100 numbers of size 1, each rounded a few times. */
static const double BOUND = 1e-5;

void setUp(void) {}
void tearDown(void) {}

static void random_floats(Random *random, float *values, int count, double low, double high)
{
    for (int i = 0; i < count; i++) values[i] = (float)random_in(random, low, high);
}

static double spline(double y)
{
    const double off = fabs(y), rest = 1.5 - off;
    return off < 0.5 ? 0.75 - off * off : off < 1.5 ? 0.5 * rest * rest : 0.0;
}

/* Counts that fill gangs and that do not, and places at the ends of the block. */
static void test_splat(void)
{
    enum { MOST = 21 };
    Random random = {1};
    EACH_ISA(isa) for (int count = 0; count <= MOST; count++) {
        float place[3][MOST], amount[MOST], box[BOX_POINTS + 1];
        double right[BOX_POINTS] = {0};
        check_subject("splat", isa, 3);
        for (int a = 0; a < 3; a++) random_floats(&random, place[a], count, 0.0, BLOCK_AXIS);
        random_floats(&random, amount, count, -0.5, 1.0);
        for (int a = 0; a < 3 && count > 1; a++) {
            place[a][0] = 0.0f;
            place[a][1] = nextafterf(BLOCK_AXIS, 0.0f);
        }
        memset(box, 0, sizeof box);
        skin_kernels_for(isa)->splat(place[0], place[1], place[2], amount, count, box);
        for (int i = 0; i < BOX_POINTS; i++) {
            const int at[3] = {i % BOX_AXIS, i / BOX_AXIS % BOX_AXIS, i / (BOX_AXIS * BOX_AXIS)};
            for (int n = 0; n < count; n++) {
                double weight = (double)amount[n];
                for (int a = 0; a < 3; a++) weight *= spline(at[a] - BOX_MARGIN - (double)place[a][n]);
                right[i] += weight;
            }
            check_near(right[i], (double)box[i], BOUND, "point of the box", i);
        }
        TEST_ASSERT_EQUAL_FLOAT(0.0f, box[BOX_POINTS]);
    }
}

static const int step_of[3] = {1, BLOCK_AXIS, BLOCK_AXIS * BLOCK_AXIS};

static void test_filter(void)
{
    static const SurfaceFilter filters[2] = {{2, -1, 1, {-0.125f, 0.625f}}, {4, -4, 3, {0.1f, 0.2f, -0.3f, 0.4f}}};
    static const CellBox within = {{1, 0, 3}, {6, 7, 5}};
    Random random = {2};
    float values[3][BLOCK_POINTS];
    for (int b = 0; b < 3; b++) random_floats(&random, values[b], BLOCK_POINTS, -1.0, 1.0);
    const float *const beside[3] = {values[0], values[1], values[2]};
    EACH_ISA(isa) for (int n = 0; n < 6; n++) {
        const SurfaceFilter *filter = &filters[n / 3];
        const int axis = n % 3;
        float out[BLOCK_POINTS] = {0};
        check_subject("filter", isa, 3);
        skin_kernels_for(isa)->filter(filter, &within, axis, beside, out);
        for (int i = 0; i < BLOCK_POINTS; i++) {
            const int at[3] = {i % BLOCK_AXIS, i / BLOCK_AXIS % BLOCK_AXIS, i / (BLOCK_AXIS * BLOCK_AXIS)};
            double right = 0.0;
            /* Rows along x are written as a whole. */
            if (at[1] < within.low[1] || at[1] > within.high[1] || at[2] < within.low[2] || at[2] > within.high[2]) continue;
            for (int tap = 0; tap < 2 * filter->pairs; tap++) { /* a middle one is a pair by itself */
                const int pair = tap / 2, from = at[axis] + BLOCK_AXIS + (tap % 2 ? filter->last - pair : filter->first + pair);
                right += (double)filter->tap[pair] * (double)values[from / BLOCK_AXIS][i + (from % BLOCK_AXIS - at[axis]) * step_of[axis]];
            }
            check_near(right, (double)out[i], BOUND, "point", i);
        }
    }
}

static void test_add(void)
{
    static float values[3][BOX_POINTS];
    Random random = {3};
    for (int b = 0; b < 3; b++) random_floats(&random, values[b], BOX_POINTS, -1.0, 1.0);
    EACH_ISA(isa) for (int set = 0; set < 8; set++) {
        const float *box[3];
        float sum[BLOCK_POINTS] = {0};
        check_subject("add", isa, 3);
        for (int b = 0; b < 3; b++) box[b] = set >> b & 1 ? values[b] : NULL;
        skin_kernels_for(isa)->add(box, 2, BLOCK_AXIS, sum);
        for (int i = 0; i < BLOCK_POINTS; i++) {
            const int x = i % BLOCK_AXIS, y = i / BLOCK_AXIS % BLOCK_AXIS, row = (i / (BLOCK_AXIS * BLOCK_AXIS) * BOX_AXIS + y) * BOX_AXIS;
            double right = 0.0;
            if (y < 2 && box[0] && x < BOX_MARGIN) right += (double)box[0][row + BLOCK_AXIS + BOX_MARGIN + x];
            if (y < 2 && box[1]) right += (double)box[1][row + BOX_MARGIN + x];
            if (y < 2 && box[2] && x >= BLOCK_AXIS - BOX_MARGIN) right += (double)box[2][row + x - BLOCK_AXIS + BOX_MARGIN];
            check_near(right, (double)sum[i], BOUND, "point", i);
        }
    }
}

static void test_weigh(void)
{
    static float own[BLOCK_POINTS], more[BLOCK_POINTS], room[BLOCK_POINTS];
    const float level = 0.5f, share = 0.25f;
    Random random = {4};
    random_floats(&random, own, BLOCK_POINTS, -0.1, 1.0);
    random_floats(&random, more, BLOCK_POINTS, -0.1, 1.0);
    random_floats(&random, room, BLOCK_POINTS, 0.0, 1.0);
    memset(more + 40, 0, 100 * sizeof *more);
    EACH_ISA(isa) {
        float enclosed[THICKENINGS + 1] = {1.0f}, held = 2.0f;
        double right[THICKENINGS + 1] = {1.0}, filled = 2.0;
        check_subject("weigh", isa, 3);
        skin_kernels_for(isa)->weigh(own, more, room, level, share, enclosed, &held);
        for (int i = 0; i < BLOCK_POINTS; i++) {
            if (more[i] == 0.0f) continue;
            filled += (double)room[i] * (double)own[i];
            for (int k = 0; k <= THICKENINGS; k++)
                if ((double)own[i] + k * (double)share * (double)more[i] >= (double)level) right[k] += (double)room[i];
        }
        check_near(filled, (double)held, 1e-3, "held", 0); /* 512 numbers */
        for (int k = 0; k <= THICKENINGS; k++) check_near(right[k], (double)enclosed[k], 1e-3, "enclosed", k);
    }
}

static void test_means_and_bounds(void)
{
    static float box[BOX_POINTS];
    Random random = {5};
    random_floats(&random, box, BOX_POINTS, -1.0, 1.0);
    EACH_ISA(isa) {
        float mean[BLOCK_POINTS], least, most;
        double low = INFINITY, high = -INFINITY;
        check_subject("means", isa, 3);
        skin_kernels_for(isa)->means(box, mean);
        skin_kernels_for(isa)->bound(mean, &least, &most);
        for (int i = 0; i < BLOCK_POINTS; i++) {
            const int x = i % BLOCK_AXIS + BOX_MARGIN, y = i / BLOCK_AXIS % BLOCK_AXIS + BOX_MARGIN, z = i / (BLOCK_AXIS * BLOCK_AXIS) + BOX_MARGIN;
            double right = 0.0;
            for (int c = 0; c < 8; c++) right += 0.125 * (double)box[((z + (c >> 2)) * BOX_AXIS + y + (c >> 1 & 1)) * BOX_AXIS + x + (c & 1)];
            check_near(right, (double)mean[i], BOUND, "mean", i);
            low = fmin(low, (double)mean[i]);
            high = fmax(high, (double)mean[i]);
        }
        TEST_ASSERT_EQUAL_DOUBLE(low, (double)least);
        TEST_ASSERT_EQUAL_DOUBLE(high, (double)most);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_splat);
    RUN_TEST(test_filter);
    RUN_TEST(test_add);
    RUN_TEST(test_weigh);
    RUN_TEST(test_means_and_bounds);
    return UNITY_END();
}
