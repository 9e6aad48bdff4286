/* Vectors of three numbers; in 2D the last is 0. */
#ifndef PBMPM_SRC_BASE_VECTOR_H
#define PBMPM_SRC_BASE_VECTOR_H

/* Cosine of 18 degrees: normals that differ by less count as one direction. */
static const double SAME_DIRECTION = 0.95;

static inline double dot3(const double a[3], const double b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

static inline void cross3(const double a[3], const double b[3], double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

#endif
