#include "matrices.h"

#include <math.h>
#include <string.h>

void matrix_identity(double *o)
{
    for (int i = 0; i < 9; i++) o[i] = i % 4 == 0;
}

void matrix_multiply(int d, const double *a, const double *b, double *o)
{
    for (int r = 0; r < d; r++)
        for (int c = 0; c < d; c++) {
            o[r * 3 + c] = 0.0;
            for (int k = 0; k < d; k++) o[r * 3 + c] += a[r * 3 + k] * b[k * 3 + c];
        }
}

void matrix_transpose(int d, const double *a, double *o)
{
    for (int r = 0; r < d; r++)
        for (int c = 0; c < d; c++) o[r * 3 + c] = a[c * 3 + r];
}

double matrix_trace(int d, const double *a)
{
    double sum = 0.0;
    for (int i = 0; i < d; i++) sum += a[i * 4];
    return sum;
}

double matrix_determinant(int d, const double *a)
{
    if (d == 2) return a[0] * a[4] - a[1] * a[3];
    return a[0] * (a[4] * a[8] - a[5] * a[7]) - a[1] * (a[3] * a[8] - a[5] * a[6]) + a[2] * (a[3] * a[7] - a[4] * a[6]);
}

double matrix_norm(int d, const double *a)
{
    double sum = 0.0;
    for (int r = 0; r < d; r++)
        for (int c = 0; c < d; c++) sum += a[r * 3 + c] * a[r * 3 + c];
    return sqrt(sum);
}

double matrix_largest(int d, const double *a)
{
    double largest = 0.0;
    for (int r = 0; r < d; r++)
        for (int c = 0; c < d; c++) largest = fmax(largest, fabs(a[r * 3 + c]));
    return largest;
}

/* Column c of a scaled to length 1, or, where it is too short to have a direction, one orthogonal to the c columns before. */
static void unit_column(int d, double *a, int c, double tiny)
{
    double length = 0.0;
    for (int r = 0; r < d; r++) length += a[r * 3 + c] * a[r * 3 + c];
    length = sqrt(length);
    for (int axis = 0; length <= tiny && axis < d; axis++) {
        double e[3] = {axis == 0, axis == 1, axis == 2}, rest = 0.0;
        for (int k = 0; k < c; k++) {
            const double along = a[axis * 3 + k];
            for (int r = 0; r < d; r++) e[r] -= along * a[r * 3 + k];
        }
        for (int r = 0; r < d; r++) rest += e[r] * e[r];
        if (rest < 0.25) continue;
        for (int r = 0; r < d; r++) a[r * 3 + c] = e[r];
        length = sqrt(rest);
    }
    for (int r = 0; r < d; r++) a[r * 3 + c] /= length;
}

/* Turns columns i and j of b and v until those of b are orthogonal; returns whether they were not. */
static int orthogonalise(int d, double *b, double *v, int i, int j)
{
    double ii = 0.0, jj = 0.0, ij = 0.0;
    for (int r = 0; r < d; r++) {
        ii += b[r * 3 + i] * b[r * 3 + i];
        jj += b[r * 3 + j] * b[r * 3 + j];
        ij += b[r * 3 + i] * b[r * 3 + j];
    }
    if (fabs(ij) <= 1e-15 * sqrt(ii * jj)) return 0;
    const double angle = 0.5 * atan2(2.0 * ij, ii - jj), cs = cos(angle), sn = sin(angle);
    for (int r = 0; r < d; r++) {
        const double bi = b[r * 3 + i], bj = b[r * 3 + j], vi = v[r * 3 + i], vj = v[r * 3 + j];
        b[r * 3 + i] = cs * bi + sn * bj;
        b[r * 3 + j] = cs * bj - sn * bi;
        v[r * 3 + i] = cs * vi + sn * vj;
        v[r * 3 + j] = cs * vj - sn * vi;
    }
    return 1;
}

static double column_length(int d, const double *a, int c)
{
    double sum = 0.0;
    for (int r = 0; r < d; r++) sum += a[r * 3 + c] * a[r * 3 + c];
    return sqrt(sum);
}

static void exchange_columns(int d, double *a, int i, int j)
{
    for (int r = 0; r < d; r++) {
        const double kept = a[r * 3 + i];
        a[r * 3 + i] = a[r * 3 + j];
        a[r * 3 + j] = -kept; /* keeps the determinant */
    }
}

void matrix_decompose(int d, const double *a, double *u, double s[3], double *v)
{
    const double scale = matrix_largest(d, a);
    memcpy(u, a, 9 * sizeof *u);
    for (int i = 0; i < 9 && scale > 0.0; i++) u[i] /= scale;
    matrix_identity(v);
    for (int sweep = 0, turned = 1; turned && sweep < 40; sweep++) {
        turned = 0;
        for (int i = 0; i < d; i++)
            for (int j = i + 1; j < d; j++) turned |= orthogonalise(d, u, v, i, j);
    }
    for (int pass = 0; pass < d; pass++)
        for (int i = 0; i + 1 < d; i++)
            if (column_length(d, u, i) < column_length(d, u, i + 1)) {
                exchange_columns(d, u, i, i + 1);
                exchange_columns(d, v, i, i + 1);
            }
    s[2] = 0.0;
    for (int c = 0; c < d; c++) {
        s[c] = column_length(d, u, c) * scale;
        unit_column(d, u, c, 1e-14);
    }
    if (matrix_determinant(d, u) > 0.0) return;
    s[d - 1] = -s[d - 1];
    for (int r = 0; r < d; r++) u[r * 3 + d - 1] = -u[r * 3 + d - 1];
}

static void compose(int d, const double *u, const double s[3], const double *v, double *o)
{
    double scaled[9], vt[9];
    for (int r = 0; r < d; r++)
        for (int c = 0; c < d; c++) scaled[r * 3 + c] = u[r * 3 + c] * s[c];
    matrix_transpose(d, v, vt);
    matrix_multiply(d, scaled, vt, o);
}

void matrix_rotation(int d, const double *a, double *r)
{
    double u[9], s[3], v[9];
    matrix_decompose(d, a, u, s, v);
    compose(d, u, (const double[3]){1.0, 1.0, 1.0}, v, r);
}

double matrix_inverse(int d, const double *a, double *o)
{
    const double det = matrix_determinant(d, a);
    for (int r = 0; r < d; r++)
        for (int c = 0; c < d; c++) {
            const int r1 = (c + 1) % 3, r2 = (c + 2) % 3, c1 = (r + 1) % 3, c2 = (r + 2) % 3;
            const double cofactor = d == 3   ? a[r1 * 3 + c1] * a[r2 * 3 + c2] - a[r1 * 3 + c2] * a[r2 * 3 + c1]
                                    : r == c ? a[(1 - r) * 4]
                                             : -a[r * 3 + c];
            o[r * 3 + c] = cofactor / det;
        }
    return det;
}

void matrix_random_rotation(Random *random, int d, double *o)
{
    double q[4], length;
    do { /* a point in the unit ball of quaternions */
        random_array(random, q, 4, -1.0, 1.0);
        if (d == 2) q[1] = q[2] = 0.0;
        length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    } while (length > 1.0 || length < 0.1);
    const double w = q[0] / length, x = q[1] / length, y = q[2] / length, z = q[3] / length;
    const double rotation[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                                2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                                2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
    memcpy(o, rotation, sizeof rotation);
}

void matrix_random_with_singular_values(Random *random, int d, const double s[3], double *o)
{
    double u[9], v[9];
    matrix_random_rotation(random, d, u);
    matrix_random_rotation(random, d, v);
    compose(d, u, s, v, o);
}
