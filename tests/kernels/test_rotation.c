/* Rotations and singular values of the kernels, for matrices of every sort.
 *
 * Bounds: 1e-5 for what has size 1 and 1e-5 |f| for what scales with f. That is what the solver needs (a strain of
 * 1e-5 is far below what a substep corrects) and some 170 units of round-off, more than either method adds up. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "check.h"
#include "isas.h"
#include "matrices.h"
#include "probes.h"

void setUp(void) {}
void tearDown(void) {}

static const double TOLERANCE = 1e-5;

enum { BATCH = 1024 }; /* whole gangs */

/* Matrices in, results out; nine floats each. */
typedef struct Batch {
    int dimension, count;
    float f[BATCH * 9], rotation[BATCH * 9], u[BATCH * 9], s[BATCH * 3], v[BATCH * 9];
} Batch;

/* The largest errors seen. */
typedef struct Worst {
    double orthonormal, determinant, trace, skew, reproduced, factors;
} Worst;

static void run_batch(Batch *batch, pbmpm_isa isa)
{
    const Probes *probes = probes_for(isa, batch->dimension);
    const uint32_t mode = float_mode_enter();
    probes->rotate_all(batch->f, batch->rotation, batch->count);
    probes->decompose_all(batch->f, batch->u, batch->s, batch->v, batch->count);
    float_mode_leave(mode);
}

static void widen(const float *from, double *to, int count)
{
    for (int i = 0; i < count; i++) to[i] = (double)from[i];
}

/* |r^T r - I| and |det r - 1| are within the tolerance. */
static double check_rotation(int d, const float *values, const char *what, long index, double *determinant)
{
    double r[9], rt[9], product[9], worst = 0.0;
    widen(values, r, 9);
    matrix_transpose(d, r, rt);
    matrix_multiply(d, rt, r, product);
    for (int a = 0; a < d; a++)
        for (int b = 0; b < d; b++) {
            check_near(a == b, product[a * 3 + b], TOLERANCE, what, index);
            worst = fmax(worst, fabs(product[a * 3 + b] - (a == b)));
        }
    check_near(1.0, matrix_determinant(d, r), TOLERANCE, what, index);
    *determinant = fmax(*determinant, fabs(matrix_determinant(d, r) - 1.0));
    return worst;
}

/* tr(r^T f) reaches its maximum, the sum of the signed singular values; and r^T f is symmetric: no turn makes it larger.
 * The trace alone would let pass a rotation that is off by the root of the tolerance. */
static double check_maximal(int d, const double *f, const float *values, const double s[3], long index, double *skew)
{
    double r[9], rt[9], product[9];
    widen(values, r, 9);
    matrix_transpose(d, r, rt);
    matrix_multiply(d, rt, f, product);
    const double norm = matrix_norm(d, f), expected = s[0] + s[1] + s[2];
    check_near(expected, matrix_trace(d, product), TOLERANCE * norm, "tr(R^T F)", index);
    for (int a = 0; a < d; a++)
        for (int b = 0; b < a; b++) {
            check_near(product[a * 3 + b], product[b * 3 + a], TOLERANCE * norm, "symmetry of R^T F", index);
            *skew = fmax(*skew, norm > 0.0 ? fabs(product[a * 3 + b] - product[b * 3 + a]) / norm : 0.0);
        }
    return norm > 0.0 ? fabs(expected - matrix_trace(d, product)) / norm : 0.0;
}

static double check_reproduced(int d, const double *f, const float *u32, const float *s32, const float *v32, const double s[3],
                               long index)
{
    double u[9], v[9], vt[9], product[9], worst = 0.0;
    const double norm = matrix_norm(d, f);
    widen(u32, u, 9);
    widen(v32, v, 9);
    for (int r = 0; r < d; r++)
        for (int c = 0; c < d; c++) u[r * 3 + c] *= (double)s32[c];
    matrix_transpose(d, v, vt);
    matrix_multiply(d, u, vt, product);
    for (int r = 0; r < d; r++) {
        check_near(s[r], (double)s32[r], TOLERANCE * norm, "singular value", index);
        for (int c = 0; c < d; c++) {
            check_near(f[r * 3 + c], product[r * 3 + c], TOLERANCE * norm, "U S V^T", index);
            worst = fmax(worst, norm > 0.0 ? fabs(f[r * 3 + c] - product[r * 3 + c]) / norm : 0.0);
        }
    }
    return worst;
}

static void check_batch(Batch *batch, pbmpm_isa isa, Worst *worst)
{
    run_batch(batch, isa);
    for (int i = 0; i < batch->count; i++) {
        const int d = batch->dimension;
        double f[9], u[9], s[3], v[9];
        widen(batch->f + 9 * i, f, 9);
        matrix_decompose(d, f, u, s, v);
        worst->orthonormal = fmax(worst->orthonormal, check_rotation(d, batch->rotation + 9 * i, "R", i, &worst->determinant));
        worst->factors = fmax(worst->factors, check_rotation(d, batch->u + 9 * i, "U", i, &worst->determinant));
        worst->factors = fmax(worst->factors, check_rotation(d, batch->v + 9 * i, "V", i, &worst->determinant));
        worst->trace = fmax(worst->trace, check_maximal(d, f, batch->rotation + 9 * i, s, i, &worst->skew));
        worst->reproduced = fmax(worst->reproduced, check_reproduced(d, f, batch->u + 9 * i, batch->s + 3 * i, batch->v + 9 * i, s, i));
    }
}

static void add_matrix(Batch *batch, const double *f)
{
    for (int k = 0; k < 9; k++) batch->f[batch->count * 9 + k] = (float)f[k];
    batch->count++;
}

/* ---- Random matrices ---- */

typedef void MakeMatrix(Random *random, int d, double *f);

static void make_uniform(Random *random, int d, double *f)
{
    (void)d;
    random_array(random, f, 9, -2.0, 2.0);
}

static void make_near_identity(Random *random, int d, double *f)
{
    const double size = pow(10.0, random_in(random, -8.0, -1.0));
    (void)d;
    random_array(random, f, 9, -size, size);
    for (int i = 0; i < 3; i++) f[i * 4] += 1.0;
}

static void make_stretched(Random *random, int d, double *f)
{
    double s[3];
    for (int i = 0; i < 3; i++) s[i] = pow(10.0, random_in(random, -4.0, 4.0));
    matrix_random_with_singular_values(random, d, s, f);
}

static void make_reflected(Random *random, int d, double *f)
{
    double s[3];
    random_array(random, s, 3, 0.1, 3.0);
    s[d - 1] = -s[d - 1];
    matrix_random_with_singular_values(random, d, s, f);
}

static void make_equal(Random *random, int d, double *f)
{
    const double a = random_in(random, 0.1, 10.0), b = random_in(random, 0.1, 10.0);
    const double patterns[4][3] = {{a, a, a}, {a, a, b}, {a, b, b}, {a, b, -b}};
    matrix_random_with_singular_values(random, d, patterns[random_below(random, 4)], f);
}

static void make_singular(Random *random, int d, double *f)
{
    const double size = pow(10.0, random_in(random, -3.0, 3.0)), noise = pow(10.0, random_in(random, -12.0, -3.0));
    double s[3] = {size, random_below(random, 2) ? size * random_in(random, 0.0, 1.0) : 0.0, 0.0}, extra[9];
    if (d == 2) s[1] = 0.0;
    matrix_random_with_singular_values(random, d, s, f);
    random_array(random, extra, 9, -noise, noise);
    for (int k = 0; k < 9; k++) f[k] += size * extra[k];
}

static void make_scaled(Random *random, int d, double *f)
{
    const double size = pow(10.0, random_in(random, -28.0, 30.0));
    (void)d;
    random_array(random, f, 9, -size, size);
}

static void check_random(const char *label, MakeMatrix *make)
{
    static Batch batch;
    Worst worst = {0};
    for (int d = 2; d <= 3; d++) {
        EACH_ISA(isa)
        {
            Random random = {42};
            check_subject(label, isa, d);
            for (int round = 0; round < 8; round++) {
                batch.dimension = d;
                batch.count = 0;
                while (batch.count < BATCH) {
                    double f[9];
                    make(&random, d, f);
                    add_matrix(&batch, f);
                }
                check_batch(&batch, isa, &worst);
            }
        }
    }
    printf("%-14s R^T R - I %.1e, det - 1 %.1e, tr(R^T F) %.1e, its skew part %.1e, U and V %.1e, U S V^T %.1e\n", label, worst.orthonormal,
           worst.determinant, worst.trace, worst.skew, worst.factors, worst.reproduced);
}

static void test_uniform_matrices(void) { check_random("uniform", make_uniform); }
static void test_matrices_near_the_identity(void) { check_random("near identity", make_near_identity); }
static void test_stretched_matrices(void) { check_random("stretched", make_stretched); }
static void test_reflected_matrices(void) { check_random("reflected", make_reflected); }
static void test_equal_singular_values(void) { check_random("equal values", make_equal); }
static void test_singular_matrices(void) { check_random("singular", make_singular); }
static void test_matrices_of_all_sizes(void) { check_random("all sizes", make_scaled); }

/* ---- Special matrices ---- */

/* Diagonals with every sign, permutations, and ranks 0 to 3, times `size`. */
static void add_special(Batch *batch, double size)
{
    static const double diagonals[][3] = {{1, 1, 1}, {1, 1, 0}, {1, 0, 0}, {0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {3, 2, 1}, {1, 2, 3}};
    for (size_t i = 0; i < sizeof diagonals / sizeof *diagonals; i++)
        for (int signs = 0; signs < 8; signs++) {
            double f[9] = {0}, turned[9] = {0};
            for (int a = 0; a < 3; a++) {
                f[a * 4] = size * (signs >> a & 1 ? -diagonals[i][a] : diagonals[i][a]);
                turned[a * 3 + (a + 1) % batch->dimension % 3] = f[a * 4];
            }
            add_matrix(batch, f);
            add_matrix(batch, turned);
        }
    for (int k = 0; k < 9; k++) {
        double one[9] = {0}, all[9];
        one[k] = size;
        for (int j = 0; j < 9; j++) all[j] = j < k ? -size : size;
        add_matrix(batch, one);
        add_matrix(batch, all);
    }
}

static void test_special_matrices(void)
{
    static Batch batch;
    static const double sizes[] = {1.0, 1e-4, 1e4, 1e-12, 1e12, 1e-28, 1e30};
    Worst worst = {0};
    for (int d = 2; d <= 3; d++)
        EACH_ISA(isa)
        {
            check_subject("special matrices", isa, d);
            batch = (Batch){.dimension = d};
            for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
                batch.count = 0;
                add_special(&batch, sizes[i]);
                check_batch(&batch, isa, &worst);
            }
        }
}

/* At the ends of what a float holds results stay rotations, whatever they mean there. */
static void test_extreme_matrices_give_rotations(void)
{
    static Batch batch;
    static const double sizes[] = {1e-30, 1e-36, FLT_MIN, 1e-45, 1e37, FLT_MAX};
    double worst = 0.0;
    for (int d = 2; d <= 3; d++)
        EACH_ISA(isa)
        {
            for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
                char label[32];
                snprintf(label, sizeof label, "size %.3g", sizes[i]);
                check_subject(label, isa, d);
                batch = (Batch){.dimension = d};
                add_special(&batch, fmin(sizes[i], FLT_MAX / 3.0));
                if (sizes[i] == FLT_MAX)
                    for (int k = 0; k < batch.count * 9; k++) batch.f[k] *= 3.0f;
                for (int k = 0; k < batch.count * 9; k++) batch.f[k] = fmaxf(-FLT_MAX, fminf(FLT_MAX, batch.f[k]));
                run_batch(&batch, isa);
                for (int m = 0; m < batch.count; m++) {
                    check_rotation(d, batch.rotation + 9 * m, "R", m, &worst);
                    check_rotation(d, batch.u + 9 * m, "U", m, &worst);
                    check_rotation(d, batch.v + 9 * m, "V", m, &worst);
                }
            }
        }
}

/* What is not finite must come back; what comes back does not matter. Neighbours in the gang are not affected. */
static void test_nan_and_infinity_come_back(void)
{
    static Batch batch, clean;
    for (int d = 2; d <= 3; d++)
        EACH_ISA(isa)
        {
            Random random = {7};
            batch = (Batch){.dimension = d};
            while (batch.count < 64) {
                double f[9];
                make_uniform(&random, d, f);
                add_matrix(&batch, f);
            }
            clean = batch;
            for (int m = 0; m < batch.count; m += 2)
                for (int k = 0; k < 9; k++)
                    if (m == 0 || k == m % 9) batch.f[m * 9 + k] = m % 3 == 0 ? NAN : m % 3 == 1 ? INFINITY : -INFINITY;
            run_batch(&batch, isa);
            run_batch(&clean, isa);
            for (int m = 1; m < batch.count; m += 2) {
                TEST_ASSERT_EQUAL_MEMORY(clean.rotation + 9 * m, batch.rotation + 9 * m, 9 * sizeof(float));
                TEST_ASSERT_EQUAL_MEMORY(clean.u + 9 * m, batch.u + 9 * m, 9 * sizeof(float));
                TEST_ASSERT_EQUAL_MEMORY(clean.s + 3 * m, batch.s + 3 * m, 3 * sizeof(float));
            }
        }
}

/* A result depends on its matrix alone, not on those that share its gang: what a particle does must not depend on which
 * others happen to be sorted next to it. */
static void test_results_do_not_depend_on_the_gang(void)
{
    static MakeMatrix *const makers[] = {make_uniform, make_stretched, make_reflected, make_singular};
    static Batch batch, moved;
    for (int d = 2; d <= 3; d++)
        EACH_ISA(isa)
        {
            Random random = {9};
            check_subject("gangs", isa, d);
            batch = (Batch){.dimension = d};
            while (batch.count < BATCH - 16) {
                double f[9];
                (random_below(&random, 8) ? make_near_identity : makers[random_below(&random, 4)])(&random, d, f);
                add_matrix(&batch, f);
            }
            moved = batch;
            moved.count = BATCH; /* everyone sits in another lane, with other neighbours */
            for (int k = 0; k < batch.count * 9; k++) moved.f[k + 27] = batch.f[k];
            run_batch(&batch, isa);
            run_batch(&moved, isa);
            for (int m = 0; m < batch.count; m++) {
                check_true(memcmp(batch.rotation + 9 * m, moved.rotation + 9 * (m + 3), 9 * sizeof(float)) == 0, "same rotation", m);
                check_true(memcmp(batch.s + 3 * m, moved.s + 3 * (m + 3), 3 * sizeof(float)) == 0, "same singular values", m);
            }
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_uniform_matrices);
    RUN_TEST(test_matrices_near_the_identity);
    RUN_TEST(test_stretched_matrices);
    RUN_TEST(test_reflected_matrices);
    RUN_TEST(test_equal_singular_values);
    RUN_TEST(test_singular_matrices);
    RUN_TEST(test_matrices_of_all_sizes);
    RUN_TEST(test_special_matrices);
    RUN_TEST(test_extreme_matrices_give_rotations);
    RUN_TEST(test_results_do_not_depend_on_the_gang);
    RUN_TEST(test_nan_and_infinity_come_back);
    return UNITY_END();
}
