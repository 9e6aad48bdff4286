/* The elastic laws against their definition in double precision: energies from singular values, stresses as their derivatives. */
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

static const int models[] = {K_FIXED_COROTATED, K_NEO_HOOKEAN};
static const double SHEAR = 3.0, DILATION = 5.0;

static double logarithm(double ratio)
{
    const double from = 0.1, below = (ratio - from) / from;
    return ratio >= from ? log(ratio) : log(from) + below - 0.5 * below * below;
}

/* The energy of F' = (I + D) F; see pbmpm_elastic_model. */
static double energy_of(int dimension, int model, const double *F, const double *D)
{
    double I[9], next[9], u[9], v[9], s[3] = {1.0, 1.0, 1.0}, ratio = 1.0, stretch = 0.0, square = 0.0;
    matrix_identity(I);
    for (int i = 0; i < 9; i++) I[i] += D[i];
    matrix_multiply(dimension, I, F, next);
    matrix_decompose(dimension, next, u, s, v);
    for (int a = 0; a < dimension; a++) {
        ratio *= s[a];
        stretch += (s[a] - 1.0) * (s[a] - 1.0);
        square += s[a] * s[a] - 1.0;
    }
    if (model == K_FIXED_COROTATED) return SHEAR * stretch + 0.5 * DILATION * (ratio - 1.0) * (ratio - 1.0);
    const double l = logarithm(ratio);
    return 0.5 * SHEAR * square - SHEAR * l + 0.5 * DILATION * l * l;
}

/* The derivative of the energy by an entry of D; central differences of fourth order. */
static double stress_of(int dimension, int model, const double *F, const double *D, int entry)
{
    const double h = 1e-3;
    double at[9], sum = 0.0;
    static const double weight[] = {1.0 / 12.0, -2.0 / 3.0, 2.0 / 3.0, -1.0 / 12.0};
    static const double place[] = {-2.0, -1.0, 1.0, 2.0};
    for (int k = 0; k < 4; k++) {
        memcpy(at, D, sizeof at);
        at[entry] += place[k] * h;
        sum += weight[k] * energy_of(dimension, model, F, at);
    }
    return sum / h;
}

typedef struct Sample {
    float f[NUMBERS], d[NUMBERS], stress[NUMBERS], energy[COUNT];
} Sample;

static Sample sample;

static KernelMaterial material_of(int model)
{
    return (KernelMaterial){.kind = K_SOLID, .elastic_model = model, .shear = (float)SHEAR, .dilation = (float)DILATION};
}

/* Rotated and stretched by factors in [low, high]; displacement gradients up to `gradient`. */
static void draw(Random *random, int dimension, double low, double high, double gradient)
{
    memset(&sample, 0, sizeof sample);
    for (int i = 0; i < COUNT; i++) {
        double s[3], F[9], D[9];
        random_array(random, s, 3, low, high);
        random_array(random, D, 9, -gradient, gradient);
        matrix_random_with_singular_values(random, dimension, s, F);
        for (int r = 0; r < dimension; r++)
            for (int c = 0; c < dimension; c++) {
                sample.f[9 * i + 3 * r + c] = (float)F[3 * r + c];
                sample.d[9 * i + 3 * r + c] = (float)D[3 * r + c];
            }
    }
}

static void read_matrix(const float *from, double *to)
{
    for (int k = 0; k < 9; k++) to[k] = (double)from[k];
}

/* What single precision makes of the strain: an error of some roundings of the largest entry, 2^-23 each, times `roundings`. The energy is
 * then off by its derivative times that, and by its rounding. */
static void compare(int dimension, int model, double roundings)
{
    for (int i = 0; i < COUNT; i++) {
        double F[9], D[9], largest = 0.0;
        read_matrix(sample.f + 9 * i, F);
        read_matrix(sample.d + 9 * i, D);
        const double energy = energy_of(dimension, model, F, D);
        const double strain_error = roundings * FLT_EPSILON * fmax(1.0, matrix_largest(dimension, F));
        for (int r = 0; r < dimension; r++)
            for (int c = 0; c < dimension; c++) {
                const double stress = stress_of(dimension, model, F, D, 3 * r + c);
                largest = fmax(largest, fabs(stress));
            }
        const double stiffness = 2.0 * SHEAR + 3.0 * DILATION + largest; /* near rest, and what grows with the stress */
        for (int r = 0; r < dimension; r++)
            for (int c = 0; c < dimension; c++)
                check_near(stress_of(dimension, model, F, D, 3 * r + c), (double)sample.stress[9 * i + 3 * r + c],
                           strain_error * stiffness, "stress", 9 * i + 3 * r + c);
        check_near(energy, (double)sample.energy[i], strain_error * (dimension * largest + energy) + stiffness * strain_error * strain_error,
                   "energy", i);
    }
}

static void check_range(double low, double high, double gradient, double roundings)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int m = 0; m < 2; m++)
            EACH_ISA(isa)
            {
                Random random = {17};
                const KernelMaterial material = material_of(models[m]);
                check_subject(m ? "neo-Hookean" : "fixed corotated", isa, dimension);
                draw(&random, dimension, low, high, gradient);
                probes_for(isa, dimension)->energy_all(&material, sample.f, sample.d, sample.stress, sample.energy, COUNT);
                compare(dimension, models[m], roundings);
            }
}

/* Rotations of any size with strains of 1e-4: the energy, of second order, must survive the rounding of the rotation. */
static void test_small_strain(void) { check_range(1.0 - 1e-4, 1.0 + 1e-4, 1e-4, 24.0); }

static void test_moderate_strain(void) { check_range(0.7, 1.4, 0.1, 24.0); }

static void test_large_strain(void) { check_range(0.3, 3.0, 0.3, 60.0); }

/* Without strain there is no stress and no energy, but for rounding, whatever the rotation. */
static void test_rest(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int m = 0; m < 2; m++)
            EACH_ISA(isa)
            {
                Random random = {5};
                const KernelMaterial material = material_of(models[m]);
                const double strain = 8.0 * FLT_EPSILON, stiffness = 2.0 * SHEAR + 3.0 * DILATION;
                check_subject("rest", isa, dimension);
                draw(&random, dimension, 1.0, 1.0, 0.0);
                probes_for(isa, dimension)->energy_all(&material, sample.f, sample.d, sample.stress, sample.energy, COUNT);
                for (int i = 0; i < COUNT; i++) check_near(0.0, (double)sample.energy[i], stiffness * strain * strain, "energy", i);
                for (int i = 0; i < NUMBERS; i++) check_near(0.0, (double)sample.stress[i], stiffness * strain, "stress", i);
            }
}

/* Inverted, flat, collapsed and stretched a hundred times (beyond, ln J squared overflows): all numbers, and no negative energy of the fixed corotated law. */
static void test_any_deformation_is_finite(void)
{
    static const double extremes[][3] = {{0.0, 0.0, 0.0},     {1e-30, 1e-30, 1e-30}, {-1.0, 1.0, 1.0}, {-1e-3, 1e-3, 1.0},
                                         {1e2, 1e-4, 1.0},    {-1e2, -1e2, -1e2},    {1e2, 1e2, 1e2},  {0.0, 1.0, 1.0},
                                         {-20.0, 20.0, 20.0}, {0.1, 0.1, 0.1}};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int m = 0; m < 2; m++)
            EACH_ISA(isa)
            {
                Random random = {23};
                const KernelMaterial material = material_of(models[m]);
                check_subject("extremes", isa, dimension);
                draw(&random, dimension, -5.0, 5.0, 1.0);
                for (int i = 0; i < COUNT / 2; i++)
                    for (int k = 0; k < 9; k++)
                        sample.f[9 * i + k] = k % 4 == 0 && k / 4 < dimension ? (float)extremes[i % 10][k / 4] : 0.0f;
                probes_for(isa, dimension)->energy_all(&material, sample.f, sample.d, sample.stress, sample.energy, COUNT);
                for (int i = 0; i < COUNT; i++) {
                    check_true(isfinite(sample.energy[i]), "energy is finite", i);
                    check_true(m == 1 || sample.energy[i] >= 0.0f, "energy is not negative", i);
                }
                for (int i = 0; i < NUMBERS; i++) check_true(isfinite(sample.stress[i]), "stress is finite", i);
            }
}

/* What a substep closes: 4/3 c^2 y^3 for each eigenvalue -0.1 - y of sym D, c^2 = 4, and 150 (y - 0.5)^2 beyond 0.5. See ispc/closing.isph. */
static double energy_of_closing(int dimension, const double *D)
{
    double shifted[9] = {0}, u[9], v[9], s[3], energy = 0.0;
    for (int r = 0; r < dimension; r++)
        for (int c = 0; c < dimension; c++) shifted[r * 3 + c] = 0.5 * (D[r * 3 + c] + D[c * 3 + r]);
    const double shift = matrix_norm(dimension, shifted); /* makes eigenvalues singular values */
    for (int a = 0; a < dimension; a++) shifted[a * 4] += shift;
    matrix_decompose(dimension, shifted, u, s, v);
    for (int a = 0; a < dimension; a++) {
        const double y = fmax(shift - s[a] - 0.1, 0.0), beyond = fmax(y - 0.5, 0.0);
        energy += 16.0 / 3.0 * y * y * y + 150.0 * beyond * beyond;
    }
    return energy;
}

/* In single precision an eigenvalue is off by some roundings of the matrix, whose size `gradient` is a bound of; what follows from it by the second
 * derivative. Differences by h miss what the third derivative jumps by, at 0.1 and 0.6. */
static void compare_closing(int dimension, double gradient)
{
    const double h = 1e-5, off = 40.0 * FLT_EPSILON * dimension * gradient, steepest = 300.0 + 32.0 * dimension * gradient;
    for (int i = 0; i < COUNT; i++) {
        double D[9], largest = 0.0;
        read_matrix(sample.d + 9 * i, D);
        for (int r = 0; r < dimension; r++)
            for (int c = 0; c < dimension; c++) {
                double up[9], down[9];
                memcpy(up, D, sizeof up);
                memcpy(down, D, sizeof down);
                up[r * 3 + c] += h;
                down[r * 3 + c] -= h;
                const double slope = (energy_of_closing(dimension, up) - energy_of_closing(dimension, down)) / (2.0 * h);
                largest = fmax(largest, fabs(slope));
                check_near(slope, (double)sample.stress[9 * i + 3 * r + c], steepest * (off + h), "stress", 9 * i + 3 * r + c);
            }
        const double energy = energy_of_closing(dimension, D);
        check_near(energy, (double)sample.energy[i], dimension * off * (largest + steepest * off) + 1e-6 * energy, "energy", i);
    }
}

static void test_closing(void)
{
    static const double gradients[] = {0.1, 0.3, 2.0};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int g = 0; g < 3; g++)
            EACH_ISA(isa)
            {
                Random random = {29};
                check_subject("closing", isa, dimension);
                draw(&random, dimension, 0.5, 2.0, gradients[g]);
                probes_for(isa, dimension)->close_all(sample.d, sample.stress, sample.energy, COUNT);
                compare_closing(dimension, gradients[g]);
            }
}

/* Turns close nothing, nor does what opens, nor what closes by less than a tenth. */
static void test_slow_closing_is_free(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject("slow closing", isa, dimension);
            memset(&sample, 0, sizeof sample);
            for (int i = 0; i < COUNT; i++)
                for (int r = 0; r < dimension; r++)
                    for (int c = 0; c < dimension; c++) {
                        const float turn = 0.01f * (float)(r < c ? i : -i), growth = i % 2 ? 0.01f * (float)i : -0.099f / 1.7320508f;
                        sample.d[9 * i + 3 * r + c] = r == c ? growth : turn;
                    }
            probes_for(isa, dimension)->close_all(sample.d, sample.stress, sample.energy, COUNT);
            for (int i = 0; i < COUNT; i++) check_near(0.0, (double)sample.energy[i], 0.0, "energy", i);
            for (int i = 0; i < NUMBERS; i++) check_near(0.0, (double)sample.stress[i], 0.0, "stress", i);
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_small_strain);
    RUN_TEST(test_moderate_strain);
    RUN_TEST(test_large_strain);
    RUN_TEST(test_rest);
    RUN_TEST(test_any_deformation_is_finite);
    RUN_TEST(test_closing);
    RUN_TEST(test_slow_closing_is_free);
    return UNITY_END();
}
