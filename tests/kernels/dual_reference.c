#include "dual_reference.h"

#include <math.h>
#include <string.h>

#include "bounds.h"
#include "matrices.h"

double reference_scale(const RefStep *step, double density)
{
    const double cells = step->dt * step->cells_per_metre;
    return 4.0 * cells * cells / density;
}

/* ---- Proximal steps ---- */

/* The root of a function that is known to be linear, from its values at 0 and 1; no less than 0. */
static double linear_root(double at_0, double at_1) { return fmin(fmax(0.0, at_0 / (at_0 - at_1)), (double)K_INCREMENT_MAX); }

/* Divided by L J^2, so that it also holds for an infinite L: s / (L J^2) + tr D + d (s - y) / w - growth. The matter grows by no more than the bound: the
 * pressure is no more than one that asks for just that. */
double reference_pressure(int n, const KernelMaterial *material, double ratio, double second, double trace, double y)
{
    const double relaxation = (double)material->relaxation, soft = (double)material->inverse_stiffness / (ratio * ratio);
    const double own = reference_cell_pressure(n, relaxation, 1.0 / ratio - 1.0 - second, soft, trace, y);
    return fmin(own, reference_cell_pressure(n, relaxation, REF_GROWTH_MAX, 0.0, trace, y));
}

double reference_cell_pressure(int n, double relaxation, double growth, double softness, double trace, double y)
{
    double balance[2];
    for (int s = 0; s < 2; s++) balance[s] = s * softness + trace + n * (s - y) / relaxation - growth;
    return linear_root(balance[0], balance[1]);
}

/* (I + D) F */
static void advance(int n, const double *D, const double *F, double *o)
{
    matrix_multiply(n, D, F, o);
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) o[r * 3 + c] += F[r * 3 + c];
}

static double volume_at(int n, const double *F, const double *D)
{
    double next[9] = {0};
    advance(n, D, F, next);
    return matrix_determinant(n, next);
}

/* d det((I + X) F) / dX at D. A determinant is linear in each entry, so differences are exact. */
static void volume_derivative(int n, const double *F, const double *D, double *C)
{
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) {
            double up[9], down[9];
            memcpy(up, D, sizeof up);
            memcpy(down, D, sizeof down);
            up[r * 3 + c] += 0.5;
            down[r * 3 + c] -= 0.5;
            C[r * 3 + c] = volume_at(n, F, up) - volume_at(n, F, down);
        }
}

/* Solves A x = b for up to 9 unknowns, with pivots from the diagonal: A is symmetric and positive. */
static void eliminate(int count, double A[9][9], double *b)
{
    for (int k = 0; k < count; k++)
        for (int i = k + 1; i < count; i++) {
            const double factor = A[i][k] / A[k][k];
            for (int j = k; j < count; j++) A[i][j] -= factor * A[k][j];
            b[i] -= factor * b[k];
        }
    for (int k = count - 1; k >= 0; k--) {
        for (int j = k + 1; j < count; j++) b[k] -= A[k][j] * b[j];
        b[k] /= A[k][k];
    }
}

/* The symmetric part of a in o; returns its size. */
static double symmetric_part(int n, const double *a, double *o)
{
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) o[r * 3 + c] = 0.5 * (a[r * 3 + c] + a[c * 3 + r]);
    return matrix_norm(n, o);
}

void reference_near(int n, const double D[9], double near[9])
{
    double strain[9] = {0};
    const double size = symmetric_part(n, D, strain), kept = fmin(1.0, REF_SUBSTEP_STRAIN / fmax(size, 1e-300));
    memcpy(near, D, 9 * sizeof *near);
    for (int k = 0; k < 9; k++) near[k] -= (1.0 - kept) * strain[k];
}

/* The closing y of a principal direction, of which `asked` is asked for, where 4 c^2 y^2 = w (asked - y); by bisection. */
static double closing_left(double asked, double w)
{
    double low = 0.0, high = asked;
    for (int k = 0; k < 60; k++) {
        const double y = 0.5 * (low + high);
        if (4.0 * REF_CLOSING_VISCOSITY * y * y < w * (asked - y))
            low = y;
        else
            high = y;
    }
    return fmin(low, REF_SUBSTEP_STRAIN - REF_CLOSING_FROM);
}

/* By how much the eigenvalues of a symmetric matrix are below -REF_CLOSING_FROM, and their directions, the columns of v: those of X + |X| I are
 * its singular values. */
static void closing_of(int n, const double *X, double asked[3], double *v)
{
    const double shift = matrix_norm(n, X);
    double shifted[9], u[9], s[3];
    memcpy(shifted, X, sizeof shifted);
    for (int r = 0; r < n; r++) shifted[r * 4] += shift;
    matrix_decompose(n, shifted, u, s, v);
    for (int k = 0; k < n; k++) asked[k] = fmax(0.0, shift - REF_CLOSING_FROM - s[k]);
}

static void limit_closing(int n, double w, double *X)
{
    double asked[3], v[9];
    closing_of(n, X, asked, v);
    for (int k = 0; k < n; k++)
        for (int r = 0; r < n; r++)
            for (int c = 0; c < n; c++) X[r * 3 + c] += (asked[k] - closing_left(asked[k], w)) * v[r * 3 + k] * v[c * 3 + k];
}

/* 4 c^2 y^2 along each direction in which D closes, as far as the substep may. */
static void closing_stress(int n, const double *D, double *push)
{
    double rate[9] = {0}, asked[3], v[9];
    symmetric_part(n, D, rate);
    closing_of(n, rate, asked, v);
    for (int k = 0; k < n; k++) {
        const double y = fmin(asked[k], REF_SUBSTEP_STRAIN - REF_CLOSING_FROM);
        for (int r = 0; r < n; r++)
            for (int c = 0; c < n; c++) push[r * 3 + c] += 4.0 * REF_CLOSING_VISCOSITY * y * y * v[r * 3 + k] * v[c * 3 + k];
    }
}

/* The gradient of shear |(I + X) F - R|^2 + dilation/2 (volume + <C, X - N> - 1)^2 + w/2 |X - Z|^2 is affine in X = Z + V:
 *     2 shear ((I + Z + V) F - R) F^T + dilation (volume + <C, Z - N + V> - 1) C + w V = 0,
 * and S' = w (X' - Z), X' = sym X but for what closes too fast. */
void reference_stress(int n, const KernelMaterial *material, const double F[9], const double D[9], const double Y[9], const double *R,
                      double S[9])
{
    const double w = (double)material->relaxation, shear = 2.0 * (double)material->shear, dilation = (double)material->dilation;
    double next[9] = {0}, turn[9] = {0}, C[9] = {0}, Z[9] = {0}, near[9] = {0}, b[9], A[9][9], strain[9] = {0};
    reference_near(n, D, near);
    advance(n, near, F, next);
    double excess = matrix_determinant(n, next) - 1.0, push[9] = {0};
    closing_stress(n, D, push);
    if (R)
        memcpy(turn, R, sizeof turn);
    else
        matrix_rotation(n, next, turn);
    volume_derivative(n, F, near, C);
    for (int k = 0; k < 9; k++) {
        Z[k] = D[k] - (Y[k] - push[k]) / w;
        excess += C[k] * (Z[k] - near[k]);
    }
    advance(n, Z, F, strain);
    for (int k = 0; k < 9; k++) strain[k] -= turn[k];
    for (int i = 0; i < n * n; i++) {
        const int r = i / n, c = i % n;
        b[i] = -dilation * excess * C[r * 3 + c];
        for (int k = 0; k < n; k++) b[i] -= shear * strain[r * 3 + k] * F[c * 3 + k];
        for (int j = 0; j < n * n; j++) {
            A[i][j] = dilation * C[r * 3 + c] * C[j / n * 3 + j % n] + (i == j ? w : 0.0);
            for (int k = 0; k < n && j / n == r; k++) A[i][j] += shear * F[c * 3 + k] * F[j % n * 3 + k];
        }
    }
    eliminate(n * n, A, b);
    double X[9] = {0}, closed[9] = {0}, start[9] = {0};
    for (int i = 0; i < n * n; i++) X[i / n * 3 + i % n] = Z[i / n * 3 + i % n] + b[i] - push[i / n * 3 + i % n] / w;
    for (int k = 0; k < 9; k++) Z[k] -= push[k] / w;
    symmetric_part(n, X, closed);
    symmetric_part(n, Z, start);
    limit_closing(n, w, closed);
    for (int k = 0; k < 9; k++) S[k] = fmin(fmax(w * (closed[k] - start[k]), -(double)K_INCREMENT_MAX), (double)K_INCREMENT_MAX);
}

/* ---- Energy ---- */

static double energy_of_closing(int n, const double *D)
{
    double rate[9] = {0}, asked[3], v[9], energy = 0.0;
    symmetric_part(n, D, rate);
    closing_of(n, rate, asked, v);
    for (int k = 0; k < n; k++) energy += 4.0 / 3.0 * REF_CLOSING_VISCOSITY * asked[k] * asked[k] * asked[k];
    return energy;
}

double reference_energy(int n, const RefParticle *p, const double D[9])
{
    const KernelMaterial *material = &p->material;
    if (material->kind == K_LIQUID) {
        const double excess = p->volume_ratio * (1.0 + matrix_trace(n, D)) - 1.0;
        return 0.5 * (double)material->dilation * fmin(excess, 0.0) * fmin(excess, 0.0);
    }
    double next[9] = {0}, R[9] = {0}, strain = 0.0;
    advance(n, D, p->deformation, next);
    matrix_rotation(n, next, R);
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) strain += (next[r * 3 + c] - R[r * 3 + c]) * (next[r * 3 + c] - R[r * 3 + c]);
    const double excess = matrix_determinant(n, next) - 1.0;
    return (double)material->shear * strain + 0.5 * (double)material->dilation * excess * excess + energy_of_closing(n, D);
}

void reference_multiplier(int n, const RefParticle *p, const double D[9], double S[9])
{
    const double step = 1e-5; /* between the rounding of E, 1e-16 / step, and its third derivative, step^2 */
    double slope[9] = {0};
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) {
            double up[9], down[9];
            memcpy(up, D, sizeof up);
            memcpy(down, D, sizeof down);
            up[r * 3 + c] += step;
            down[r * 3 + c] -= step;
            slope[r * 3 + c] = (reference_energy(n, p, up) - reference_energy(n, p, down)) / (2.0 * step);
        }
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) S[r * 3 + c] = -0.5 * (slope[r * 3 + c] + slope[c * 3 + r]);
}

/* ---- Transfers ---- */

void reference_push(RefGrid *grid, const RefParticle *p, const double S[9])
{
    const RefStencil s = reference_stencil(grid->dimension, p);
    for (int i = 0; i < s.count; i++) {
        RefNode *node = &grid->node[reference_index(grid, s.node[i])];
        for (int r = 0; r < grid->dimension; r++)
            for (int c = 0; c < grid->dimension; c++) node->u[r] += p->mass * s.weight[i] * S[r * 3 + c] * s.offset[i][c];
    }
}

RefCentres reference_centres(int n, const RefParticle *p)
{
    RefCentres o = {0};
    for (int i = 0; i < 1 << n; i++) {
        double weight = 1.0;
        for (int a = 0; a < n; a++) {
            const double place = p->cell[a] + p->fraction[a];
            const int32_t below = (int32_t)floor(place - 0.5); /* the last centre at or below the particle */
            const int32_t cell = below + (i >> a & 1);
            o.cell[o.count][a] = cell;
            weight *= 1.0 - fabs(place - (cell + 0.5));
        }
        o.weight[o.count++] = weight;
    }
    return o;
}

/* ---- Bounds ---- */

/* s' = y + (growth - tr D - y soft) / (d/w + soft). The terms of the numerator are rounded a few times each, 1/J - 1 with an error of
 * 2 U / J; the denominator is a sum of positive numbers. Taking the larger of two numbers enlarges no difference. */
double bound_pressure(int n, const KernelMaterial *material, double ratio, double second, double trace, double y, double trace_error)
{
    const double soft = (double)material->inverse_stiffness / (ratio * ratio), below = n / (double)material->relaxation + soft;
    const double terms = 1.0 / ratio + 1.0 + fabs(second) + fabs(trace) + fabs(y) * soft;
    return (trace_error + 8.0 * UNIT_ROUNDOFF * terms) / below + 3.0 * UNIT_ROUNDOFF * fabs(y) + FLUSHED;
}

/* Errors of X = Q B - pull C B, with M = I + s F F^T, B = M^-1, s = 2 shear / w. |M| = 1 + s s1^2 and |B| = 1 / (1 + s sn^2) from the singular
 * values of F. A stable solution of X M = Q has an error of k U |M| |B| |X|: one condition number, and not its square, as an inverse from cofactors has
 * in 3D. Beside that, errors of Q are multiplied by |B|, and those of R by s |F| |B|. The denominator of the volume part is a sum of positive terms, so its error is relative, and what it divides is bounded by it. */
double bound_stress(int n, const KernelMaterial *material, const double F[9], const double D[9], const double Y[9], double error,
                    double turned)
{
    enum { ROUNDINGS = 24 }; /* in a product of three matrices with 3 terms per entry, and a division */
    const double each = ROUNDINGS * UNIT_ROUNDOFF, w = (double)material->relaxation;
    const double s = 2.0 * (double)material->shear / w, dilation = (double)material->dilation / w;
    double u[9], sigma[3], v[9], near[9], next[9] = {0}, C[9] = {0}, S[9], X = 0.0, Z = 0.0, D_size = 0.0;
    matrix_decompose(n, F, u, sigma, v);
    const double norm = matrix_norm(n, F), M = 1.0 + s * sigma[0] * sigma[0], B = 1.0 / (1.0 + s * sigma[n - 1] * sigma[n - 1]);
    reference_near(n, D, near);
    advance(n, near, F, next);
    volume_derivative(n, F, near, C);
    const double next_norm = matrix_norm(n, next), C_size = matrix_norm(n, C), volume = fabs(matrix_determinant(n, next));
    reference_stress(n, material, F, D, Y, NULL, S);
    D_size = matrix_norm(n, D);
    Z = D_size + matrix_norm(n, Y) / w;
    for (int a = 0; a < n; a++) /* Q B = Z B + s (R - F) F^T B, and R, F and B share their left singular vectors */
        X = fmax(X, s * fabs(sigma[a]) * (1.0 + fabs(sigma[a])) / (1.0 + s * sigma[a] * sigma[a]));
    X = sqrt(n) * X + Z;
    const double Q_error = error + each * (Z + s * norm * (sqrt(n) + norm)) + s * turned * norm;
    const double X_error = B * Q_error + each * M * B * X;
    const double C_error = pow(next_norm, n - 2) * n * bound_advance(n, F, D, error) * norm + each * pow(next_norm, n - 1) * norm;
    const double below = 1.0 + dilation * C_size * C_size / M; /* C B C^T is at least |C|^2 / |M| */
    const double excess = C_size * (X + D_size) + volume + 1.0;
    const double excess_error = C_size * (X_error + error) + (X + D_size) * C_error + each * (excess + pow(next_norm, n));
    const double q_error = each * M * B * B * C_size * C_size + 2.0 * C_error * C_size * B;
    const double pull = dilation * excess / below;
    const double pull_error = (dilation * excess_error + pull * dilation * q_error) / below + each * pull;
    const double G_error = each * M * B * B * C_size + B * C_error;
    return w * (X_error + pull_error * C_size * B + pull * G_error + error) + each * w * (X + Z + pull * C_size * B) + FLUSHED;
}
