/* The dual solver once more in double precision, from its equations and not from its kernels.
 *
 * A substep minimises E(u) = sum_i m_i/2 |u_i - u*_i|^2 + sum_p m_p/4 phi_p(D_p). Its dual iteration finds, for each particle, the
 * multiplier S' with S' = -dphi/dD at D + (S' - Y)/w. Lengths in cells; S is symmetric, and a pressure p stands for S = p I. */
#ifndef PBMPM_TESTS_DUAL_REFERENCE_H
#define PBMPM_TESTS_DUAL_REFERENCE_H

#include "reference.h"

/* Growth per substep that a crushed liquid asks for at most. */
static const double REF_GROWTH_MAX = 0.3;

/* Strain per substep that a solid is asked for at most. */
static const double REF_SUBSTEP_STRAIN = 0.6;

/* Closing per substep from which on a solid resists it by 4 c^2 y^2, y what is beyond, and c^2. */
static const double REF_CLOSING_FROM = 0.1;
static const double REF_CLOSING_VISCOSITY = 4.0;

/* The constant that makes an energy per rest volume [Pa] into phi: 4 dt^2 / (dx^2 density). */
double reference_scale(const RefStep *step, double density);

/* S' of a liquid: the root of s + L J (J (1 + tr D + d (s - y)/w) - 1) = 0, or 0 where that is tension. */
double reference_pressure(int dimension, const KernelMaterial *material, double ratio, double second, double trace, double y);

/* D with its symmetric part no longer than REF_SUBSTEP_STRAIN: where the dual solver linearises. */
void reference_near(int dimension, const double D[9], double near[9]);

/* S' of an elastic particle, of phi with the rotation R and the derivative of the determinant taken at N = reference_near(D): a linear problem
 * of d^2 unknowns, solved by elimination. What its solution closes is resisted, and REF_SUBSTEP_STRAIN at most. R may be null: that of (I + N) F. */
void reference_stress(int dimension, const KernelMaterial *material, const double F[9], const double D[9], const double Y[9],
                      const double *R, double S[9]);

/* phi at D, of both kinds: with no linearisation, as material.h states it. */
double reference_energy(int dimension, const RefParticle *p, const double D[9]);

/* -sym(dphi/dD), by central differences of reference_energy(). */
void reference_multiplier(int dimension, const RefParticle *p, const double D[9], double S[9]);

/* Adds w m S (x_i - x_p) to the nodes' u, and nothing to their masses. */
void reference_push(RefGrid *grid, const RefParticle *p, const double S[9]);

/* ---- Pressures in cells: the cell with index i has its centre half a cell above node i ---- */

typedef struct RefCentres {
    int count; /* 2^d */
    int32_t cell[8][3];
    double weight[8]; /* 1 - distance to the centre, along each axis */
} RefCentres;

RefCentres reference_centres(int dimension, const RefParticle *p);

/* What a cell holds: sums over its particles of h m times the quantity. */
typedef struct RefCell {
    double mass, ratio, softness, pressure;
} RefCell;

/* The proximal step of a cell's mean: growth asked for, mean trace, mean of 1 / (L J^2). */
double reference_cell_pressure(int dimension, double relaxation, double growth, double softness, double trace, double y);

/* ---- Bounds of the kernels' errors; see bounds.h ---- */

double bound_pressure(int dimension, const KernelMaterial *material, double ratio, double second, double trace, double y, double trace_error);

/* `error` is that of D's entries, `turned` that of R in the Frobenius norm. */
double bound_stress(int dimension, const KernelMaterial *material, const double F[9], const double D[9], const double Y[9], double error,
                    double turned);

#endif
