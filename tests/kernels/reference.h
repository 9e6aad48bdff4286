/* The kernels once more, as plain scalar code in double precision: the readable form of the maths.
 *
 * C. Lewin, "A Position Based Material Point Method", SIGGRAPH 2024 Talks. Transfers: quadratic B-splines
 * (M. Steffen, R. Kirby, M. Berzins, IJNME 76, 2008) and affine particles (C. Jiang et al., ACM TOG 34(4), 2015).
 * Lengths are in cells, displacements in cells per substep; the displacement gradient D has no unit. */
#ifndef PBMPM_TESTS_REFERENCE_H
#define PBMPM_TESTS_REFERENCE_H

#include <stdbool.h>

#include "kernel_types.h"

/* One particle. Its position is cell + fraction. */
typedef struct RefParticle {
    int32_t cell[3];
    double fraction[3];
    double velocity[3];  /* [m/s] */
    double affine[9];    /* [1/s] */
    double volume_ratio; /* J */
    double mass;         /* density * rest volume in cells */
    double deformation[9];
    int32_t status;
    uint32_t identity; /* index of its identifier */
    KernelMaterial material;
} RefParticle;

/* What one substep shares. */
typedef struct RefStep {
    int dimension;
    double dt, cells_per_metre;
    double gravity[3]; /* g dt^2 / dx */
    double max_displacement;
    int32_t max_cell;
    uint32_t salt; /* of the nudges */
    bool with_volume;
    bool edged;          /* blocks are near edges of obstacles, see KernelArgs.grid.edged */
    double excess;       /* of the volume that J claims in the block, see reference_excess() */
    bool tensionless;    /* liquids bear no tension: all solvers but the paper's */
    bool weighs;         /* liquids differ in density: they count what is lighter by its mass */
    double affine_lost;  /* share of their affine velocities that eddy damping takes from liquids */
    double flip;         /* share of the motion lost in the transfers that liquids keep */
    double feedback_way; /* [cells] that matter goes where feedback is full; 0: everywhere */
    double quiet_way;    /* the same where feedback grows with the square of the way; 0: see feedback_way */
    const struct RefGrid *base; /* the predictor; null: nothing is kept */
} RefStep;

/* The nodes a particle touches: 3 per axis around its nearest node. */
typedef struct RefStencil {
    int count; /* 3^d */
    int32_t node[27][3];
    double weight[27];
    double offset[27][3]; /* of the node from the particle */
} RefStencil;

RefStencil reference_stencil(int dimension, const RefParticle *p);

/* A node's sums, or, for a grid of displacements, its displacement. */
typedef struct RefNode {
    double u[3];
    double mass;
    double volume; /* rest volume per cell */
    double gap;    /* see KernelArgs.primal.node_gap */
} RefNode;

/* A dense box of nodes. */
typedef struct RefGrid {
    int dimension;
    int32_t low[3], size[3];
    RefNode *node;
} RefGrid;

RefGrid reference_grid(int dimension, const int32_t low[3], const int32_t high[3]); /* all zero; high is inside */
void reference_grid_free(RefGrid *grid);
int64_t reference_index(const RefGrid *grid, const int32_t node[3]); /* -1: outside */

/* D and d as the last substep left them: velocity and affine velocity times dt. */
void reference_start(const RefStep *step, const RefParticle *p, double d[3], double D[9]);

/* Adds a particle's mass, rest volume and momentum m (d + D (x_i - x_p)) to the nodes. */
void reference_scatter(RefGrid *grid, const RefParticle *p, const double d[3], const double D[9]);

/* d = sum w u and D = 4 sum w u (x_i - x_p)^T. */
void reference_gather(const RefGrid *grid, const RefParticle *p, double d[3], double D[9]);

/* grad w_i: the weight of a node is the spline of its offset, node minus particle, so the derivative by the particle's place has the other sign. */
void reference_slopes(int dimension, const RefParticle *p, double slope[27][3]);

/* The gradient of the motion x += sum w_i(x) u_i at the particle: sum u_i (grad w_i)^T. Returns the largest sum of the sizes of an entry's terms. */
double reference_gradient(const RefGrid *grid, const RefParticle *p, double gradient[9]);

/* What of J - J_grid, in size, the feedback leaves alone at rest. missing: J_grid - J. */
double reference_noise(const RefStep *step, double missing);

/* The least that a node which the particle feels holds. */
double reference_sparsest(const RefGrid *grid, const RefParticle *p);

/* The liquid of a block, away from surfaces and not crushed: the volume that its J claim over that which the grid has, less 1, within 0.05. */
double reference_excess(const RefGrid *grid, const RefParticle *p, uint32_t count);

/* Frobenius norm of the symmetric part of D. */
double reference_strain(int n, const double D[9]);

/* How liquid leaves crowded places, [cells]: -min(4 |sym D|, 0.1) sum_i clamp(V_i - 1, 0, 0.2) grad w_i, at most 0.05 per axis. Returns the largest sum of
 * the absolute values of the terms V_i grad w_i and grad w_i. */
double reference_shift(const RefGrid *grid, const RefParticle *p, const double D[9], double shift[3]);

/* Moves D towards what the particle's material allows. */
void reference_project(int dimension, const RefParticle *p, const double d[3], double D[9]);

/* Brings F into the material's range; false where the particle has to go instead. */
bool reference_limit_strain(int dimension, const KernelMaterial *material, double F[9]);

/* Whether the particle keeps a share of the motion that the transfers lost (ASFLIP). */
bool reference_flips(const RefStep *step, const RefParticle *p);

/* Moves the particle by what the nodes say and updates v, affine, J and F. */
void reference_integrate(const RefStep *step, const RefGrid *grid, RefParticle *p);

/* Rest volume per cell where a liquid counts as compressed, and as crowded. */
static const double REF_COMPRESSED = 1.1, REF_CROWDED = 1.5, REF_CRUSHED = 1.2, REF_INNER = 0.6;

/* Skew part of D that a solid's particle keeps with the paper's solver: sin 60 degrees. */
static const double REF_SPIN_MAX = 0.8660254;

/* From what error of J on feedback begins where matter rests, and is full. */
static const double REF_WRONG_MIN = 0.05, REF_WRONG_MAX = 0.15;

/* What J is multiplied with so that those of a block come to claim what the grid has. What was crushed is left out. */
double reference_control(const RefStep *step, const RefGrid *grid, const RefParticle *p, const double D[9]);

/* The share of what the grid shows below which J is raised to it. */
double reference_stale(const KernelMaterial *material);

/* The rest volume per cell around the particle. */
double reference_compression(const RefGrid *grid, const RefParticle *p);

/* The same as a liquid without tension counts it. Above 1 it is no more than the mass around the particle over its own density, or 1. */
double reference_held(const RefStep *step, const RefGrid *grid, const RefParticle *p);

#endif
