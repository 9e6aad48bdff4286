/* Small matrices in double precision: row-major with stride 3, entries outside dimension 2 unused there. */
#ifndef PBMPM_TESTS_MATRICES_H
#define PBMPM_TESTS_MATRICES_H

#include "random.h"

void matrix_identity(double *o);
void matrix_multiply(int dimension, const double *a, const double *b, double *o); /* o = a b; o may be neither */
void matrix_transpose(int dimension, const double *a, double *o);
double matrix_trace(int dimension, const double *a);
double matrix_determinant(int dimension, const double *a);
double matrix_norm(int dimension, const double *a); /* Frobenius */
double matrix_largest(int dimension, const double *a); /* largest entry */

/* a = u diag(s) v^T with u and v rotations and s[0] >= s[1] >= |s[2]|; the last value has the sign of det a. */
void matrix_decompose(int dimension, const double *a, double *u, double s[3], double *v);

/* The rotation r that maximises tr(r^T a). */
void matrix_rotation(int dimension, const double *a, double *r);

/* a^-1; returns the determinant of a, which must not be 0. */
double matrix_inverse(int dimension, const double *a, double *o);

/* A random rotation, evenly distributed. */
void matrix_random_rotation(Random *random, int dimension, double *o);

/* u diag(s) v^T with random rotations u and v. */
void matrix_random_with_singular_values(Random *random, int dimension, const double s[3], double *o);

#endif
