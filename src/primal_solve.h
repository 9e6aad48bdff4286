/* What the files of the primal solver share: the state of a substep's solution. See primal.h. */
#ifndef PBMPM_SRC_PRIMAL_SOLVE_H
#define PBMPM_SRC_PRIMAL_SOLVE_H

#include "primal.h"

/* In cantilevers the true error of steps was 0.5 to 1.2 residuals (medians) where 10 and 20 iterations were enough, and 1.1 to 2.5 where 2 and
 * 5 were too few. */
#define PRIMAL_ERROR_PER_RESIDUAL 1.3
#define PRIMAL_ENERGY_ROUNDING 5e-7 /* of sums of energies in single precision */

enum { W = K_NODE_WIDTH, SUMS = 2 * PRIMAL_MEMORY + 4 };

/* What a body had and has: see primal.h. */
typedef struct BodySum {
    double before, after, work;
    double fallen;            /* work of gravity and forces, which `after` counts as a loss */
    double mass, momentum[3]; /* of the predictor */
    double start[3];          /* its mean displacement, as far as obstacles allow: a motion without strain */
    double elastic;           /* energy of the elastic particles */
    double liquid;            /* energy of the liquid particles */
    double kinetic, moved[3]; /* of the solution: energy, and momentum */
    bool with_liquid, touches, failed;
    bool unsound;             /* failed at first */
    bool leans;               /* on an obstacle */
    float kept, mean[3];      /* share of its velocities beside this mean displacement that a body with liquid keeps */
} BodySum;

/* One substep. Vectors have W floats per node; the last is not used. */
typedef struct Primal {
    World *world;
    const ContactFrame *contacts;
    int floats;                             /* per block */
    float *node, *base, *force;             /* where the energy was evaluated, the predictor, the gradient there */
    float *best, *gradient;                 /* the accepted displacements and their gradient */
    float *right, *direction;               /* what is solved for: free part of the gradient; the next step, with opposite sign */
    float *step[PRIMAL_MEMORY], *change[PRIMAL_MEMORY]; /* differences of displacements and gradients, newest first */
    double product[PRIMAL_MEMORY][PRIMAL_MEMORY];       /* change i . step j, for j >= i */
    int pairs;
    double first[PRIMAL_MEMORY], second[PRIMAL_MEMORY]; /* coefficients of the two loops */
    bool mixed;                             /* of solids and liquid */
    float share;                            /* of the step that is tried */
    double mass, energy, trial_energy, slope_before, slope_after;
    double total[SUMS];                     /* what the last pass added up */
} Primal;

/* Works on the floats [begin, end) of one block; adds up into sum[SUMS]. */
typedef void BlockPass(Primal *p, int32_t block, size_t begin, size_t end, double *sum);

/* ---- primal.c ---- */

/* The sums of the blocks are added in order, to p->total, so they do not depend on the number of threads. */
void primal_over_blocks(Primal *p, BlockPass *pass);

/* Energy and gradient at p->node. */
void primal_evaluate(Primal *p);

/* Makes p->node the accepted displacements. */
void primal_accept(Primal *p, bool with_pair);

/* p->direction from p->right; p->first holds step . right of each pair. Returns gradient . direction. */
double primal_find_direction(Primal *p);

/* The same without the pairs, from the gradient. */
double primal_find_plain_direction(Primal *p);

/* Goes on along p->direction, without stop rules. */
void primal_descend_further(Primal *p);

/* ---- primal_bodies.c ---- */

BodySum *primal_body_of(const Primal *p, int32_t block);

/* Whether the block is stepped by BDF2. */
bool primal_is_multistep(const Primal *p, int32_t block);

/* Finds the bodies at or in an obstacle, and those with liquid. */
void primal_find_leaning(Primal *p);

/* Compares energies at p->best. Returns the number of bodies that gained. */
uint32_t primal_check_bodies(Primal *p);

/* Moves failed bodies to `share` of the way from their start to the solution; the others stay as they are. */
void primal_pull_back_to(Primal *p, float share);

/* Mends the bodies whose solution has more energy than there was. */
void primal_keep_energy(Primal *p);

/* ---- primal_liquid.c ---- */

/* Takes from loose liquid what an unfinished solution moves it by that no force does. */
void primal_let_fly(Primal *p);

/* Finds how much of their velocities bodies with liquid may keep, and pulls back those for which that is not enough. */
void primal_find_kept(Primal *p);

/* The displacements that make the velocities: p->node, or where bodies keep less, p->right. */
const float *primal_kept_motion(Primal *p);

/* ---- primal_bodies.c ---- */

/* Gives bodies that lean on nothing the momentum that an unfinished solution kept from them. */
void primal_keep_momentum(Primal *p);

#endif
