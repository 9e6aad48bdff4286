/* The minimiser of a liquid's substep, by dense linear algebra in double precision.
 *
 * E(u) = sum_i m_i/2 |u_i - u*_i|^2 + sum_k W_k/2 max(0, b_k - G_k u)^2: each particle (or cell) is a row G that gives the trace of D, with the
 * growth b that it asks for and the stiffness W = m/4 L J^2 (a cell: m/4 over the mean of 1 / (L J^2)). */
#ifndef PBMPM_TESTS_DENSE_H
#define PBMPM_TESTS_DENSE_H

#include "dual_reference.h"
#include "scene.h"

typedef struct Dense {
    RefGrid base;     /* u* and masses */
    int unknowns;     /* of all nodes of the box, also of those without mass */
    int rows;
    double *G, *W, *b; /* rows * unknowns, rows, rows */
    double *u;         /* the minimiser */
} Dense;

/* Rows of particles, or of cells. All liquids are compressible, and miss less than the bound of growth. */
Dense dense_of_particles(const Scene *scene, const RefGrid *base);
Dense dense_of_cells(const Scene *scene, const RefGrid *base);

/* Newton's method on the rows that press, until they are the same: exact, because E is piecewise quadratic. False: they go round. */
bool dense_solve(Dense *dense);

/* max(0, b - G u) W, what row k presses with. */
double dense_pressure(const Dense *dense, int row);

void dense_free(Dense *dense);

#endif
