/* Small positive systems by the factors of A.-L. Cholesky, m = L L^T. */
#ifndef PBMPM_SRC_BASE_CHOLESKY_H
#define PBMPM_SRC_BASE_CHOLESKY_H

#include <math.h>

enum { CHOLESKY_MOST = 6 };

typedef double SmallMatrix[CHOLESKY_MOST][CHOLESKY_MOST];

/* The lower triangle of m becomes L; the upper one is not read. `least`: of m's eigenvalues; what is left of a diagonal is no less but by rounding. */
static inline void cholesky_factor(SmallMatrix m, int count, double least)
{
    for (int c = 0; c < count; c++)
        for (int r = c; r < count; r++) {
            double rest = m[r][c];
            for (int k = 0; k < c; k++) rest -= m[r][k] * m[c][k];
            m[r][c] = r == c ? sqrt(fmax(rest, least)) : rest / m[c][c];
        }
}

/* L x = x */
static inline void cholesky_forward(const SmallMatrix l, double *x, int count)
{
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < i; k++) x[i] -= l[i][k] * x[k];
        x[i] /= l[i][i];
    }
}

/* L^T x = x */
static inline void cholesky_backward(const SmallMatrix l, double *x, int count)
{
    for (int i = count - 1; i >= 0; i--) {
        for (int k = i + 1; k < count; k++) x[i] -= l[k][i] * x[k];
        x[i] /= l[i][i];
    }
}

#endif
