#include "bounds.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "matrices.h"

BoundParticle bound_gather(const RefGrid *grid, const RefParticle *p)
{
    const RefStencil s = reference_stencil(grid->dimension, p);
    double d[3] = {0}, D[9] = {0};
    for (int i = 0; i < s.count; i++) {
        const RefNode *node = &grid->node[reference_index(grid, s.node[i])];
        for (int r = 0; r < grid->dimension; r++) {
            d[r] += s.weight[i] * fabs(node->u[r]);
            for (int c = 0; c < grid->dimension; c++) D[r * 3 + c] += 4.0 * s.weight[i] * fabs(node->u[r] * s.offset[i][c]);
        }
    }
    const double each = TRANSFER_ROUNDINGS * UNIT_ROUNDOFF;
    return (BoundParticle){each * fmax(d[0], fmax(d[1], d[2])) + FLUSHED, each * matrix_largest(grid->dimension, D) + FLUSHED};
}

/* Error of the root of (head2 - |d|^2) / K_HEADS: that of its argument over the sum of both roots, which are no farther apart than the root of it. */
static double bound_driven(int n, const KernelMaterial *material, const double d[3], double error)
{
    double motion2 = 0.0, off = 0.0;
    for (int a = 0; a < n; a++) motion2 += d[a] * d[a], off += error * (2.0 * fabs(d[a]) + error);
    const double left = fmax((double)material->head2 - motion2, 0.0) / (double)K_HEADS;
    off = (off + 4.0 * UNIT_ROUNDOFF * ((double)material->head2 + motion2)) / (double)K_HEADS;
    return left > 0.0 ? fmin(off / sqrt(left), sqrt(off)) + UNIT_ROUNDOFF * sqrt(left) : sqrt(off);
}

/* The update is linear in D. In the largest entry: viscosity changes D by at most 2 nu |D|, the correction by relaxation
 * times |D|. 1/J - 1 is computed with an error of U (1/J + 1), and all of it with a few roundings of its terms. */
static double bound_liquid(int n, const RefParticle *p, const double d[3], double largest, BoundParticle error)
{
    const KernelMaterial *material = &p->material;
    const double gain = 1.0 + 2.0 * (double)material->viscosity + (double)material->relaxation;
    const double wanted = fmin(1.0 / p->volume_ratio + 1.0, (double)material->growth_max + 2.0);
    const double driven = (double)material->head2 < FLT_MAX ? bound_driven(n, material, d, error.d) : 0.0;
    return gain * error.D + (double)material->relaxation * (8.0 * UNIT_ROUNDOFF * wanted + driven) + 8.0 * UNIT_ROUNDOFF * gain * largest;
}

/* Frobenius norm of the rotation's error. The rotation that maximises tr(R^T A) turns by |dA| times 2 over the smallest sum of
 * two of A's signed singular values; no two rotations are farther apart than 2 sqrt 2. The kernel's own round-off is that
 * of a matrix that differs by a few units: 16 operations from the matrix to the turned one, three entries each. */
double bound_rotation(int n, const double *A, double error)
{
    double u[9], s[3], v[9];
    matrix_decompose(n, A, u, s, v);
    const double gap = s[n - 2] + s[n - 1], own = 48.0 * UNIT_ROUNDOFF;
    const double turned = gap > 0.0 ? 2.0 * (error + own * matrix_norm(n, A)) / gap : INFINITY;
    return fmin(turned + own, 2.0 * sqrt(2.0));
}

/* Relative error of |det|^(-1/d) within its clamp, given that of A: |d det| <= |cof A| |dA|. */
static double bound_root(int n, const double *A, double error)
{
    const double norm = matrix_norm(n, A), det = fabs(matrix_determinant(n, A));
    const double det_error = pow(norm, n - 1) * (error + 8.0 * UNIT_ROUNDOFF * norm);
    if (det_error > 0.5 * det) return det > 0.2 ? 1.0 : 2.0; /* even the sign may differ */
    return 2.0 * det_error / (n * fmax(det, 0.1)) + 8.0 * UNIT_ROUNDOFF;
}

static bool growth_is_unclear(int n, const RefParticle *p, const double D[9], double error)
{
    static const double still[3];
    RefParticle unbound = *p;
    double driven[9];
    memcpy(driven, D, sizeof driven);
    unbound.material.growth_max = FLT_MAX;
    reference_project(n, &unbound, still, driven);
    return fabs(matrix_trace(n, driven)) <= error;
}

/* X = (A - F*) cof(F)^T / det F. Errors of A, of F* and of the inverse are multiplied by the size of the other factor; taking
 * the symmetric part and bounding the length never enlarge a difference. Two corrections differ by 2 rebound_max at most. So it is where growth is not
 * driven beyond growth_max, but what was given differs, too: by up to d times as much as its entries. Where it is unclear what grows either may be. */
static double bound_elastic(int n, const RefParticle *p, const double D[9], double error)
{
    const KernelMaterial *material = &p->material;
    const double *F = p->deformation;
    const double beta = (double)material->elasticity_ratio, limit = (double)material->rebound_max;
    double next[9] = {0}, inverse[9];
    matrix_multiply(n, D, F, next);
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) next[r * 3 + c] += F[r * 3 + c];
    const double size = matrix_norm(n, next), norm = matrix_norm(n, F), next_error = bound_advance(n, F, D, error);
    const double det = fabs(matrix_inverse(n, F, inverse));
    if (!(det > 1e-11)) return error + 2.0 * limit; /* at the limit of what the kernel inverts */
    const double root = pow(fmin(fmax(fabs(matrix_determinant(n, next)), 0.1), 1000.0), -1.0 / n);
    const double shape = beta * bound_rotation(n, next, next_error) +
                         (1.0 - beta) * root * (next_error + bound_root(n, next, next_error) * size);
    const double target = beta * sqrt(n) + (1.0 - beta) * root * size;
    const double difference_error = shape + next_error + 8.0 * UNIT_ROUNDOFF * (target + size);
    const double det_share = 8.0 * UNIT_ROUNDOFF * pow(norm, n) / det;
    const double inverse_norm = matrix_norm(n, inverse);
    const double inverse_error = 8.0 * UNIT_ROUNDOFF * pow(norm, n - 1) / det + 2.0 * inverse_norm * (det_share + 4.0 * UNIT_ROUNDOFF);
    const double change = (double)material->relaxation * (inverse_norm * difference_error + (target + size) * inverse_error);
    const double correction = fmin((double)material->relaxation * (target + size) * inverse_norm, limit);
    const double reached = error + fmin(change + 8.0 * UNIT_ROUNDOFF * correction, 2.0 * limit) + 2.0 * UNIT_ROUNDOFF * (matrix_largest(n, D) + limit);
    if (!(material->growth_max < FLT_MAX)) return reached;
    const double bounded = n * (reached + error) + 16.0 * UNIT_ROUNDOFF * (matrix_norm(n, D) + limit);
    return bounded + (growth_is_unclear(n, p, D, n * reached) ? matrix_norm(n, D) + limit : 0.0);
}

double bound_project(int dimension, const RefParticle *p, const double d[3], const double D[9], BoundParticle error)
{
    if (p->material.kind == K_LIQUID) return bound_liquid(dimension, p, d, matrix_largest(dimension, D), error);
    return bound_elastic(dimension, p, D, error.D);
}

void bound_scatter(const RefGrid *grid, BoundNode *bounds, const RefParticle *p, const double d[3], const double D[9],
                   BoundParticle error)
{
    const RefStencil s = reference_stencil(grid->dimension, p);
    for (int i = 0; i < s.count; i++) {
        BoundNode *node = &bounds[reference_index(grid, s.node[i])];
        const double m = s.weight[i] * p->mass;
        node->terms++;
        for (int r = 0; r < grid->dimension; r++) {
            double carried = error.d, size = fabs(d[r]);
            for (int c = 0; c < grid->dimension; c++) {
                carried += error.D * fabs(s.offset[i][c]);
                size += fabs(D[r * 3 + c] * s.offset[i][c]);
            }
            node->carried[r] += m * carried + FLUSHED * p->mass * (1.0 + size);
            node->size[r] += m * size;
        }
    }
}

/* Whether two nodes of a stencil are neighbours along the axis, of which the first is the middle one. */
static bool is_middle_beside(const RefStencil *s, int i, int outer, int axis)
{
    for (int b = 0; b < 3; b++)
        if (abs(s->node[i][b] - s->node[outer][b]) != (b == axis)) return false;
    return fabs(s->offset[i][axis]) <= 0.5 && fabs(s->offset[outer][axis]) > 0.5;
}

/* What the links of a particle carry along an axis at its nodes: for the outer ones w |x_i - x_p|, for the middle ones what both neighbours have. */
static double link_size(const RefStencil *s, int i, int axis)
{
    double size = 0.0;
    for (int outer = 0; outer < s->count; outer++)
        if (is_middle_beside(s, i, outer, axis)) size += s->weight[outer] * fabs(s->offset[outer][axis]);
    return size > 0.0 ? size : s->weight[i] * fabs(s->offset[i][axis]);
}

double bound_trace(const RefGrid *grid, const RefParticle *p)
{
    const RefStencil s = reference_stencil(grid->dimension, p);
    double size = 0.0;
    for (int i = 0; i < s.count; i++)
        for (int axis = 0; axis < grid->dimension; axis++)
            size += 4.0 * link_size(&s, i, axis) * fabs(grid->node[reference_index(grid, s.node[i])].u[axis]);
    return TRANSFER_ROUNDINGS * UNIT_ROUNDOFF * size + FLUSHED;
}

static bool is_pressure(int n, const double S[9])
{
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++)
            if (S[r * 3 + c] != (r == c ? S[0] : 0.0)) return false;
    return true;
}

void bound_push(const RefGrid *grid, BoundNode *bounds, const RefParticle *p, const double S[9], double error)
{
    const RefStencil s = reference_stencil(grid->dimension, p);
    const double none[3] = {0};
    bound_scatter(grid, bounds, p, none, S, (BoundParticle){.D = error});
    if (!is_pressure(grid->dimension, S)) return;
    for (int i = 0; i < s.count; i++)
        for (int axis = 0; axis < grid->dimension; axis++) {
            BoundNode *node = &bounds[reference_index(grid, s.node[i])];
            const double more = p->mass * (link_size(&s, i, axis) - s.weight[i] * fabs(s.offset[i][axis]));
            node->size[axis] += more * fabs(S[0]);
            node->carried[axis] += more * error + FLUSHED * p->mass * (1.0 + fabs(S[0]));
        }
}

double bound_of_sum(const BoundNode *node, int axis)
{
    return node->carried[axis] + (TRANSFER_ROUNDINGS + node->terms) * UNIT_ROUNDOFF * node->size[axis];
}

double bound_advance(int n, const double *F, const double D[9], double error)
{
    return matrix_norm(n, F) * (n * error + 8.0 * UNIT_ROUNDOFF * (1.0 + matrix_norm(n, D)));
}

/* The clamp maps signed singular values s to f(s). In the directions of the singular vectors a difference grows by
 * |f'| <= 1, between them by (f(si) - f(sj)) / (si - sj) <= 1 and (f(si) + f(sj)) / (si + sj). */
double strain_limit_sensitivity(int n, const KernelMaterial *material, const double *F)
{
    double u[9], s[3], v[9], worst = 1.0;
    if (material->condition_max > 0.0f) return 1.0;
    matrix_decompose(n, F, u, s, v);
    for (int i = 0; i < n; i++)
        for (int j = i + 1; j < n; j++) {
            const double low = (double)material->strain_min, high = (double)material->strain_max;
            const double limited = fmin(fmax(s[i], low), high) + fmin(fmax(s[j], low), high);
            worst = fmax(worst, s[i] + s[j] > 0.0 ? limited / (s[i] + s[j]) : INFINITY);
        }
    return worst;
}
