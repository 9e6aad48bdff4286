/* Sand and viscoplastic matter: what the return leaves of a strain, and what is cut off stresses, against the laws in double precision. */
#include <float.h>
#include <math.h>
#include <string.h>
#include <unity.h>

#include "check.h"
#include "isas.h"
#include "matrices.h"
#include "probes.h"

void setUp(void) {}
void tearDown(void) {}

enum { COUNT = 400, NUMBERS = 9 * COUNT };

static const double SINE = 0.5, RATIO = 2.5, YIELD = 0.05, KEPT = 0.3;
static const double CLOSING = 2e-3; /* what three rounds leave of a strain of up to ln 2 */

static float before[NUMBERS], after[NUMBERS];

static KernelMaterial sand(double cohesion, double looseness)
{
    return (KernelMaterial){.kind = K_SOLID, .yields = K_SAND, .friction = (float)SINE, .cohesion = (float)cohesion,
                            .looseness = (float)looseness, .bulk_over_shear = (float)RATIO};
}

static KernelMaterial visco(void)
{
    return (KernelMaterial){.kind = K_SOLID, .yields = K_VISCO, .yield_strain = (float)YIELD, .excess_kept = (float)KEPT};
}

static void read_matrix(const float *from, double *to)
{
    for (int k = 0; k < 9; k++) to[k] = (double)from[k];
}

/* Principal logarithmic strains, largest first. */
static void strains_of(int dimension, const float *f, double e[3])
{
    double F[9], u[9], v[9], s[3];
    read_matrix(f, F);
    matrix_decompose(dimension, F, u, s, v);
    for (int a = 0; a < 3; a++) e[a] = a < dimension ? log(s[a]) : 0.0;
}

static double sum_of(int dimension, const double *e) { return e[0] + e[1] + (dimension == 3 ? e[2] : 0.0); }

/* The size of the deviator. */
static double deviator_of(int dimension, const double *e)
{
    const double mean = sum_of(dimension, e) / dimension;
    double square = 0.0;
    for (int a = 0; a < dimension; a++) square += (e[a] - mean) * (e[a] - mean);
    return sqrt(square);
}

static void draw(int dimension, double low, double high, unsigned seed)
{
    Random random = {seed};
    for (int i = 0; i < COUNT; i++) {
        double s[3], F[9];
        random_array(&random, s, 3, low, high);
        matrix_random_with_singular_values(&random, dimension, s, F);
        for (int k = 0; k < 9; k++) before[9 * i + k] = k / 3 < dimension && k % 3 < dimension ? (float)F[k] : 0.0f;
    }
}

/* Roundings of a decomposition: some units in the last place of strains, whatever they are. */
static const double ROUNDING = 40.0 * FLT_EPSILON;

typedef void Rule(int dimension, const double *was, const double *is, long i);

static void check_all(const char *name, const KernelMaterial *material, double low, double high, Rule *rule)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject(name, isa, dimension);
            draw(dimension, low, high, 11);
            probes_for(isa, dimension)->yield_all(material, before, after, COUNT);
            for (int i = 0; i < COUNT; i++) {
                double was[3], is[3];
                strains_of(dimension, before + 9 * i, was);
                strains_of(dimension, after + 9 * i, is);
                rule(dimension, was, is, i);
            }
        }
}

/* Mohr and Coulomb in principal stresses: (t1 - t3) + (t1 + t3) sin(phi), 0 at yield, of Hencky's law with 2 mu = 1. */
static double mohr_coulomb(int dimension, const double *e, double cohesion)
{
    const double trace = sum_of(dimension, e), mean = trace / dimension;
    const double pressure = -RATIO * (trace - cohesion) / dimension;
    const double first = e[0] - mean - pressure, last = e[dimension - 1] - mean - pressure;
    return first - last + (first + last) * SINE;
}

/* On or inside the pyramid; the trace and the direction of the deviator stay; what was inside is what it was. */
static void obeys_friction(int dimension, const double *was, const double *is, long i)
{
    const double trace = sum_of(dimension, was), size = deviator_of(dimension, was), left = deviator_of(dimension, is);
    check_near(trace, sum_of(dimension, is), ROUNDING, "trace", i);
    if (trace >= 0.0) {
        check_near(0.0, left, ROUNDING, "no shear at the tip", i);
        return;
    }
    /* the bound's relative error, of the arcus sine, is 1e-5 at the most */
    const double excess = mohr_coulomb(dimension, is, 0.0);
    check_true(excess <= 4.0 * ROUNDING + 1e-5 * RATIO * -trace, "inside the pyramid", i);
    if (mohr_coulomb(dimension, was, 0.0) > 1e-4) check_near(0.0, excess, 4.0 * ROUNDING + 1e-5 * RATIO * -trace, "on the pyramid", i);
    if (mohr_coulomb(dimension, was, 0.0) < -1e-4) check_near(size, left, ROUNDING, "untouched inside", i);
    for (int a = 0; a < dimension && size > 0.01; a++)
        check_near((was[a] - trace / dimension) * left / size, is[a] - trace / dimension, 2.0 * ROUNDING, "direction", i);
}

static void test_sand_shears_as_far_as_friction_lets_it(void)
{
    const KernelMaterial material = sand(0.0, 10.0);
    check_all("sand", &material, 0.7, 1.25, obeys_friction);
}

static void forgets_expansion(int dimension, const double *was, const double *is, long i)
{
    const double trace = sum_of(dimension, was);
    check_near(fmin(trace, 0.1), sum_of(dimension, is), ROUNDING, "trace", i);
    if (trace > 0.02) check_near(0.0, deviator_of(dimension, is), ROUNDING, "no shear at the tip", i);
}

static void test_sand_forgets_expansion_beyond_a_bound(void)
{
    const KernelMaterial material = sand(0.02, 0.08);
    check_all("loose sand", &material, 0.9, 1.5, forgets_expansion);
}

static void bears_tension(int dimension, const double *was, const double *is, long i)
{
    if (mohr_coulomb(dimension, was, 0.2) < -1e-4)
        check_near(deviator_of(dimension, was), deviator_of(dimension, is), ROUNDING, "cohesion holds", i);
    check_near(sum_of(dimension, was), sum_of(dimension, is), ROUNDING, "trace", i);
}

static void test_cohesion_holds_sand_together(void)
{
    const KernelMaterial material = sand(0.2, 1.0);
    check_all("cohesive sand", &material, 0.98, 1.06, bears_tension);
}

/* The volume stays, and of what is beyond the yield strain the share KEPT. */
static void relaxes(int dimension, const double *was, const double *is, long i)
{
    const double size = deviator_of(dimension, was), left = size > YIELD ? YIELD + KEPT * (size - YIELD) : size;
    check_near(sum_of(dimension, was), sum_of(dimension, is), ROUNDING, "trace", i);
    check_near(left, deviator_of(dimension, is), ROUNDING, "deviator", i);
    check_true(is[0] <= was[0] + ROUNDING && is[dimension - 1] >= was[dimension - 1] - ROUNDING, "no strain grows", i);
}

static void test_visco_relaxes_at_constant_volume(void)
{
    const KernelMaterial material = visco();
    check_all("visco", &material, 0.5, 1.6, relaxes);
}

/* Below yield not a bit changes. */
static void test_nothing_changes_below_yield(void)
{
    const KernelMaterial materials[] = {visco(), sand(0.0, 0.14)};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int m = 0; m < 2; m++)
            EACH_ISA(isa)
            {
                check_subject("below yield", isa, dimension);
                draw(dimension, m ? 0.88 : 0.99, m ? 0.90 : 1.01, 3);
                probes_for(isa, dimension)->yield_all(&materials[m], before, after, COUNT);
                for (int i = 0; i < NUMBERS; i++)
                    if (i % 9 / 3 < dimension && i % 3 < dimension) check_true(before[i] == after[i], "the same bits", i);
            }
}

/* ---- Crowded matter ---- */

/* det F goes a share of the way to what there is room for, at least to .67; the shape, F / det F^(1/d), stays, and so do the bits of what has room. */
static void test_crowded_visco_gives_up_volume(void)
{
    static float room[COUNT];
    KernelMaterial material = visco();
    material.volume_feedback = 0.3f;
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            Random random = {5};
            int gave = 0;
            check_subject("crowded visco", isa, dimension);
            draw(dimension, 0.6, 1.5, 21);
            for (int i = 0; i < COUNT; i++) room[i] = (float)random_in(&random, 0.1, 1.5);
            probes_for(isa, dimension)->give_up_all(&material, room, before, after, COUNT);
            for (int i = 0; i < COUNT; i++) {
                double was[9], is[9];
                read_matrix(before + 9 * i, was);
                read_matrix(after + 9 * i, is);
                const double volume = matrix_determinant(dimension, was), least = fmax((double)room[i], 1.0 / 1.5);
                const bool claims = room[i] < 1.0f && volume > least * (1.0 + ROUNDING);
                const double next = claims ? volume + 0.3 * (least - volume) : volume;
                gave += claims;
                for (int k = 0; k < 9; k++)
                    if (k / 3 < dimension && k % 3 < dimension)
                        check_near(was[k] * pow(next / volume, 1.0 / dimension), is[k], claims ? ROUNDING : ROUNDING * FLT_EPSILON, "F", i);
            }
            check_true(gave > COUNT / 4 && gave < COUNT, "some give up volume, some do not", gave);
        }
}

/* ---- Voids ---- */

/* The stress along each direction over 2 mu, of a strain that is borne. */
static void stress_of(int dimension, const double *e, double *stress)
{
    const double mean = sum_of(dimension, e) / dimension;
    for (int a = 0; a < dimension; a++) stress[a] = RATIO * mean + e[a] - mean;
}

/* Voids close by no more than there are; as long as some are left there is no pressure, and what closed bears none. Then the deviator relaxes. */
static void test_voids_close_before_visco_bears_pressure(void)
{
    static float room[COUNT];
    KernelMaterial material = visco();
    material.bulk_over_shear = (float)RATIO;
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            Random random = {5};
            int kinds[3] = {0};
            check_subject("voids", isa, dimension);
            draw(dimension, 0.6, 1.5, 21);
            for (int i = 0; i < COUNT; i++) room[i] = i % 3 ? (float)random_in(&random, 0.05, 1.0) : 0.0f;
            probes_for(isa, dimension)->close_voids_all(&material, room, before, after, COUNT);
            for (int i = 0; i < COUNT; i++) {
                double was[3], is[3], stress[3];
                strains_of(dimension, before + 9 * i, was);
                strains_of(dimension, after + 9 * i, is);
                stress_of(dimension, is, stress);
                const double closed = sum_of(dimension, is) - sum_of(dimension, was), least = fmin(stress[dimension - 1], fmin(stress[0], stress[1]));
                check_true(closed > -CLOSING && closed < (double)room[i] + CLOSING, "what voids there are", i);
                if (closed < (double)room[i] - CLOSING) check_true(least > -CLOSING, "no pressure while there are voids", i);
                if (closed > CLOSING && closed < (double)room[i] - CLOSING) check_near(0.0, least, CLOSING, "what closed", i);
                kinds[closed < CLOSING ? 0 : (closed < (double)room[i] - CLOSING ? 1 : 2)]++;
            }
            for (int kind = 0; kind < 3; kind++) check_true(kinds[kind] > COUNT / 20, "closed not at all, in part, for good", kind);
        }
}

/* ---- What no strain should be ---- */

/* Every seventh matrix becomes one that a step would have caught before: no number, infinite, nothing at all, turned inside out. */
static bool is_bad(int i) { return i % 7 == 3; }

static void spoil(int dimension, float value)
{
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < 9 && is_bad(i); k++)
            before[9 * i + k] = k / 3 < dimension && k % 3 < dimension ? (k % 4 == 0 ? value : 0.0f) : 0.0f;
}

/* Bad lanes change no others, and what is finite stays so. */
static void check_bad_lanes(const KernelMaterial *material, bool stresses)
{
    static const float values[] = {NAN, INFINITY, -INFINITY, 0.0f, -1.0f, 1e-30f, 1e-3f, 1e4f};
    static float clean[NUMBERS];
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            const Probes *probes = probes_for(isa, dimension);
            check_subject("bad lanes", isa, dimension);
            draw(dimension, 0.6, 1.5, 5);
            (stresses ? probes->cut_all : probes->yield_all)(material, before, clean, COUNT);
            for (size_t v = 0; v < sizeof values / sizeof *values; v++) {
                draw(dimension, 0.6, 1.5, 5);
                spoil(dimension, values[v]);
                (stresses ? probes->cut_all : probes->yield_all)(material, before, after, COUNT);
                for (int i = 0; i < NUMBERS; i++) {
                    if (i % 9 / 3 >= dimension || i % 3 >= dimension) continue;
                    if (!is_bad(i / 9)) check_true(clean[i] == after[i], "other lanes keep every bit", i);
                    if (is_bad(i / 9) && isfinite(values[v])) check_true(isfinite(after[i]), "finite", i);
                }
            }
        }
}

static void test_bad_lanes_disturb_nobody(void)
{
    KernelMaterial materials[] = {sand(0.0, 0.14), visco()};
    for (int m = 0; m < 2; m++) {
        materials[m].shear = 3.0f;
        materials[m].dilation = 5.0f;
        materials[m].relaxation = 1.5f;
        check_bad_lanes(&materials[m], false);
        check_bad_lanes(&materials[m], true);
    }
}

/* At the ends of what a clamp leaves, with the third at any place between: by the law in double precision, or at least inside it. */
static void test_extreme_strains_obey_the_law(void)
{
    const KernelMaterial materials[] = {sand(0.0, 0.14), visco()};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int m = 0; m < 2; m++)
            EACH_ISA(isa)
            {
                Random random = {17};
                check_subject("extreme strain", isa, dimension);
                for (int i = 0; i < COUNT; i++) {
                    double s[3], F[9];
                    for (int a = 0; a < 3; a++) s[a] = exp(random_in(&random, log(0.1), log(20.0))); /* the default bounds */
                    matrix_random_with_singular_values(&random, dimension, s, F);
                    for (int k = 0; k < 9; k++) before[9 * i + k] = k / 3 < dimension && k % 3 < dimension ? (float)F[k] : 0.0f;
                }
                probes_for(isa, dimension)->yield_all(&materials[m], before, after, COUNT);
                for (int i = 0; i < COUNT; i++) {
                    double was[3], is[3];
                    strains_of(dimension, before + 9 * i, was);
                    strains_of(dimension, after + 9 * i, is);
                    /* a singular value 200 times smaller than the largest is off by 200 roundings */
                    const double rounding = 200.0 * 8.0 * FLT_EPSILON, trace = sum_of(dimension, was);
                    check_near(m ? trace : fmin(trace, 0.14), sum_of(dimension, is), 3.0 * rounding, "trace", i);
                    if (m) {
                        const double size = deviator_of(dimension, was);
                        check_near(size > YIELD ? YIELD + KEPT * (size - YIELD) : size, deviator_of(dimension, is), 3.0 * rounding, "deviator", i);
                    } else {
                        const double most = trace < 0.0 ? 1e-5 * RATIO * -trace : 0.0;
                        check_true(trace >= 0.0 ? deviator_of(dimension, is) < 3.0 * rounding : mohr_coulomb(dimension, is, 0.0) <= 6.0 * rounding + most,
                                   "inside the pyramid", i);
                    }
                }
            }
}

/* ---- Stresses with opposite sign, in the iterations ---- */

/* Symmetric, with principal values in [low, high]. */
static void draw_stresses(int dimension, double low, double high)
{
    Random random = {29};
    for (int i = 0; i < COUNT; i++) {
        double s[3], Q[9], scaled[9], turned[9], S[9];
        random_array(&random, s, 3, low, high);
        matrix_random_rotation(&random, dimension, Q);
        for (int k = 0; k < 9; k++) scaled[k] = Q[k] * s[k % 3];
        matrix_transpose(dimension, Q, turned);
        matrix_multiply(dimension, scaled, turned, S);
        for (int k = 0; k < 9; k++) before[9 * i + k] = k / 3 < dimension && k % 3 < dimension ? (float)S[k] : 0.0f;
    }
}

/* Largest and smallest pressure, by the decomposition of S + 10 I, which is positive. */
static void pressures_of(int dimension, const float *from, double *largest, double *smallest)
{
    double S[9], u[9], v[9], s[3];
    read_matrix(from, S);
    for (int a = 0; a < dimension; a++) S[a * 4] += 10.0;
    matrix_decompose(dimension, S, u, s, v);
    *largest = s[0] - 10.0;
    *smallest = s[dimension - 1] - 10.0;
}

static void test_stress_in_the_iterations_obeys_friction(void)
{
    KernelMaterial material = sand(0.0, 0.14);
    material.shear = 3.0f;
    material.dilation = 5.0f;
    material.relaxation = 1.5f;
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject("stress", isa, dimension);
            draw_stresses(dimension, -1.0, 2.0);
            probes_for(isa, dimension)->cut_all(&material, before, after, COUNT);
            for (int i = 0; i < COUNT; i++) {
                double was[9], is[9], largest, smallest, high, low;
                read_matrix(before + 9 * i, was);
                read_matrix(after + 9 * i, is);
                pressures_of(dimension, before + 9 * i, &largest, &smallest);
                pressures_of(dimension, after + 9 * i, &high, &low);
                const double trace = matrix_trace(dimension, was), bound = 1e-4;
                check_near(fmax(trace, 0.0), matrix_trace(dimension, is), 1e-5, "dry sand bears no tension", i);
                check_true(high - low <= (high + low) * SINE + bound, "inside the pyramid", i);
                const bool yields = trace > 0.0 && largest - smallest > (largest + smallest) * SINE + bound;
                if (yields) check_near((high + low) * SINE, high - low, bound, "on the pyramid", i);
                if (trace > 0.0 && !yields) check_near(matrix_norm(dimension, was), matrix_norm(dimension, is), bound, "untouched", i);
            }
        }
}

static double size_of_deviator(int dimension, const float *from)
{
    double A[9];
    read_matrix(from, A);
    const double trace = matrix_trace(dimension, A), norm = matrix_norm(dimension, A);
    return sqrt(fmax(0.0, norm * norm - trace * trace / dimension));
}

/* Iterated as the dual solver does, at a strain whose elastic stress is T, the multiplier comes to what is borne: within the bound T itself,
 * beyond it the bound and the share KEPT of the excess; pressure stays. */
static void test_multipliers_come_to_what_visco_bears(void)
{
    static float target[NUMBERS];
    KernelMaterial material = visco();
    material.shear = 3.0f;
    material.dilation = 5.0f;
    material.relaxation = 1.5f;
    const float k = 2.0f * material.shear / material.relaxation;
    const double bound = 2.0 * (double)material.shear * YIELD, error = 1e-4; /* roundings of 100 iterations, and (k / (1 + k))^100 = 2e-10 */
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject("multiplier", isa, dimension);
            draw_stresses(dimension, -0.6, 0.6);
            memcpy(target, before, sizeof target);
            memset(after, 0, sizeof after);
            for (int iteration = 0; iteration < 100; iteration++) {
                for (int i = 0; i < NUMBERS; i++) before[i] = (k * after[i] + target[i]) / (1.0f + k);
                probes_for(isa, dimension)->cut_all(&material, before, after, COUNT);
            }
            for (int i = 0; i < COUNT; i++) {
                double T[9], S[9];
                read_matrix(target + 9 * i, T);
                read_matrix(after + 9 * i, S);
                check_near(matrix_trace(dimension, T), matrix_trace(dimension, S), error, "pressure", i);
                const double elastic = size_of_deviator(dimension, target + 9 * i);
                check_near(elastic > bound ? bound + KEPT * (elastic - bound) : elastic, size_of_deviator(dimension, after + 9 * i), error, "borne", i);
            }
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_sand_shears_as_far_as_friction_lets_it);
    RUN_TEST(test_sand_forgets_expansion_beyond_a_bound);
    RUN_TEST(test_cohesion_holds_sand_together);
    RUN_TEST(test_visco_relaxes_at_constant_volume);
    RUN_TEST(test_nothing_changes_below_yield);
    RUN_TEST(test_crowded_visco_gives_up_volume);
    RUN_TEST(test_voids_close_before_visco_bears_pressure);
    RUN_TEST(test_bad_lanes_disturb_nobody);
    RUN_TEST(test_extreme_strains_obey_the_law);
    RUN_TEST(test_stress_in_the_iterations_obeys_friction);
    RUN_TEST(test_multipliers_come_to_what_visco_bears);
    return UNITY_END();
}
