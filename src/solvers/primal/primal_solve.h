/* What the files of the primal solver share: the state of a substep's solution. See primal.h. */
#ifndef PBMPM_SRC_SOLVERS_PRIMAL_PRIMAL_SOLVE_H
#define PBMPM_SRC_SOLVERS_PRIMAL_PRIMAL_SOLVE_H

#include "contact/contact_constraints.h"
#include "world/world.h"

/* In cantilevers the true error of steps was 0.5 to 1.2 residuals (medians) where 10 and 20 iterations were enough, and 1.1 to 2.5 where 2 and
 * 5 were too few. Between them, by trial. */
#define PRIMAL_ERROR_PER_RESIDUAL 1.3

/* The energy check adds up most. */
enum { W = K_NODE_WIDTH, CHECK_SUMS = 13, SUMS = CHECK_SUMS + EXCHANGE_SUMS };
_Static_assert((int)SUMS >= 2 * PRIMAL_MEMORY + 6, "a step adds up so many");

/* What a body had and has: see primal.h. */
typedef struct BodySum {
    double before, after, work;
    ContactExchange exchange; /* of moving surfaces, where all go as they are sent; in the joint solver, too, beside what stays; else `work` has it */
    ContactExchange driven;   /* of nodes that stay, where the solution began */
    double fallen;            /* work of gravity and forces, which `after` counts as a loss */
    double stiff;             /* sum of the nodes' stiffnesses */
    double still;             /* sum m/2 |u*|^2: with it the size of the energies that were compared on the way */
    double mass, momentum[3]; /* of the predictor */
    double start[3];          /* its mean displacement, as far as obstacles allow: a motion without strain */
    double elastic;           /* energy of the elastic particles */
    double pressed, pressed_rest; /* energy of the joint solver's liquid, and at D = 0 */
    double kinetic, moved[3]; /* of the solution: energy, and momentum */
    bool with_liquid, touches, failed;
    bool unsound;             /* failed at first */
    bool leans;               /* on an obstacle */
    bool held;                /* by an obstacle that sticks: it has no rigid motion */
    bool meets;               /* may meet one in this substep */
    float kept, mean[3];      /* share of its velocities beside this mean displacement that a body with liquid keeps */
} BodySum;

/* Translations along and rotations about the axes, per radian. */
enum { RIGID_MODES = 6 };

/* A body's rigid motions: see primal_rigid.c. */
typedef struct RigidBody {
    bool used;
    double centre[3];                          /* from the anchor [cells] */
    double mass[RIGID_MODES][RIGID_MODES];     /* Z'MZ */
    double factor[RIGID_MODES][RIGID_MODES];   /* L of A = L L' */
    double inertia[RIGID_MODES][RIGID_MODES];  /* of the start: see primal_weigh_turns() */
    double sum[16], motion[RIGID_MODES], start[RIGID_MODES];
    double kept, mean[3];                      /* share of its velocities beside this mean displacement that it keeps */
    bool multistep;                            /* it was solved for by BDF2, whether or not it forgets its past */
    bool shifts;                               /* the search for its start goes on */
    bool bounces;
    double bounce;                             /* see primal_bounce.c */
    double strain;                             /* energy at contacts, of `start` */
    bool turns;                                /* it may; then: it gets this back */
    double spin[3], arrives[3];                /* [radians per substep]; where its centre goes */
    double middle[3];                          /* what it is turned about, from where its centre was */
    double share;                              /* see primal_find_shares() */
} RigidBody;

/* A translation of a body, see primal_momentum.c. */
typedef struct BodyMove {
    double mass, missing[3];  /* momentum */
    double longest;           /* way */
    bool stays;
    int blocked;              /* how many directions it may not move along, and which */
    double normal[3][3];
    double way[3], pull[3], stiffness;
} BodyMove;

/* What a search does next; see primal_search.c. */
typedef enum SearchPhase {
    SEARCH_ENDED,
    SEARCH_SPENT,   /* it accepted its last step, and its residual is not known */
    SEARCH_SEEKS,   /* a direction */
    SEARCH_TRIES,   /* a step along it */
    SEARCH_ACCEPTS  /* that step */
} SearchPhase;

/* The search for the lowest energy of one body, or of those that rigid bodies join. */
typedef struct Search {
    int32_t own;           /* the body whose search it is: that of all it is joined with */
    bool with_liquid;
    bool plain;            /* its next direction begins from the gradient, without pairs */
    SearchPhase phase;
    int pairs, newest;     /* how many steps it remembers, and the place of the newest */
    uint32_t passes, most; /* evaluations */
    float share;           /* of the step that is tried */
    double product[PRIMAL_MEMORY][PRIMAL_MEMORY];       /* change i . step j, for j >= i */
    double first[PRIMAL_MEMORY], second[PRIMAL_MEMORY]; /* coefficients of the two loops; `first` begins as step . right of each pair */
    double mass, energy, trial_energy, slope_before, slope_after;
    double decrement;      /* gradient . direction */
    double total[SUMS];    /* what the last pass added up */
} Search;

/* One substep. Vectors have W floats per node; the last is not used. */
typedef struct Primal {
    World *world;
    const ContactFrame *contacts;
    int floats;                             /* per block */
    float *node, *base, *force;             /* where the energy was evaluated, the predictor, the gradient there */
    float *best, *gradient;                 /* the accepted displacements and their gradient */
    float *right, *direction;               /* what is solved for: free part of the gradient; the next step, with opposite sign */
    float *step[PRIMAL_MEMORY], *change[PRIMAL_MEMORY]; /* differences of displacements and gradients: see primal_step_of() */
    Search *search;                         /* per body */
    Search *joined;                         /* that of what touches rigid bodies that yield; null: none does */
    bool rubs;      /* there is friction */
    float slip_min; /* see constraints_slip_min() */
    bool bounces; /* a body does */
    bool turned; /* failed bodies go back to their rigid motion; else to their mean one */
    bool yields; /* rigid bodies do, see primal_yield.h */
    const struct YieldPair *pair; /* in passes of primal_yield_along.c and primal_yield_heaps.c */
    const float *after;           /* in one of primal_yield_book.c */
    bool rigid; /* a body's rigid motions are solved for */
    bool mixed;                             /* of solids and liquid */
    bool joint, sketches;                   /* the dual solves too, see joint.h, and has not yet */
    bool as_sent;                            /* all obstacles go where the host sends them */
    float share;                            /* of the way from their start that failed bodies go */
    double mass;
    double total[SUMS];                     /* what the last pass over blocks added up */
} Primal;

/* Works on the floats [begin, end) of one block; adds up into sum[SUMS]. */
typedef void BlockPass(Primal *p, int32_t block, size_t begin, size_t end, double *sum);

/* ---- primal.c ---- */

/* The sums of the blocks are added in order, to p->total, so they do not depend on the number of threads. */
void primal_over_blocks(Primal *p, BlockPass *pass);

/* Adds a pass to loops that do more. */
void primal_add_pass(Primal *p, Loops *loops, BlockPass *pass);

/* ---- primal_search.c ---- */

/* After primal_yield_open() and primal_find_leaning(). */
void primal_open_searches(Primal *p);
Search *primal_search_of(const Primal *p, int32_t block);

/* Pair i of a search, the newest first. */
float *primal_step_of(const Primal *p, const Search *search, int i);
float *primal_change_of(const Primal *p, const Search *search, int i);

/* As primal_over_blocks(), but adds up to the `total` of each search; the same for loops whose last one is a pass. */
void primal_over_searches(Primal *p, BlockPass *pass);
void primal_run_and_gather(Primal *p, Loops *loops);

/* Energy and gradient at p->node; the first time, after loops. */
void primal_evaluate(Primal *p);
void primal_evaluate_first(Primal *p, Loops *loops);

/* A pass that finds what the preconditioner needs. */
void primal_weigh_nodes(Primal *p, int32_t block, size_t begin, size_t end, double *sum);

/* Chooses bodies. Those that rigid bodies join are chosen if one of them is. */
typedef bool BodyTest(const Primal *p, int32_t body);

/* Makes p->node the accepted displacements of the chosen bodies, of all if the test is null, and forgets their pairs. */
void primal_accept(Primal *p, BodyTest *chosen);

/* Searches on for the chosen bodies, with at most `most` evaluations; if it stops, until they are close enough or the time is up. Returns how many evaluations there
 * were. */
uint32_t primal_search(Primal *p, uint32_t most, BodyTest *chosen, bool stops);

/* Each search follows p->direction if it leads down by the sum of the last pass, with at most `most` evaluations. */
void primal_follow(Primal *p, uint32_t most);

/* The residual [cells] of all, after primal_find_residual(); and where those of the chosen bodies are found without pairs. */
void primal_find_residual(Primal *p);
double primal_residual(const Primal *p);
double primal_plain_residual(Primal *p, BodyTest *chosen);

/* ---- primal_bodies.c ---- */

BodySum *primal_body_of(const Primal *p, int32_t block);

/* Whether a body failed the last energy check; whether it failed the first. */
bool primal_has_failed(const Primal *p, int32_t body);
bool primal_is_unsound(const Primal *p, int32_t body);

/* Whether the block is stepped by BDF2. */
bool primal_is_multistep(const Primal *p, int32_t block);

/* Finds the bodies at or in an obstacle, and those with liquid. */
void primal_find_leaning(Primal *p);

/* After weigh_nodes(), which sums it. */
void primal_note_stiffness(Primal *p);

/* In the joint solver, where a solution begins: what holds nodes that stay. There the liquid has the dual's pressures, so the gradient is what walls give. What springs do to
 * these nodes after that is no work of walls. Counted as such it was energy out of nothing, and heavy liquid that ran into stiff clay was thrown up to the ceiling. */
void primal_note_driven(Primal *p);

/* Kinetic energy beside the mean motion. */
double primal_own_motion(const BodySum *body);

/* Compares energies at p->best. Returns the number of bodies that gained. */
uint32_t primal_check_bodies(Primal *p);

/* Moves failed bodies to `share` of the way from their start to the solution; the others stay as they are. */
void primal_pull_back_to(Primal *p, float share);

/* Mends the bodies whose solution has more energy than there was. */
void primal_keep_energy(Primal *p);

/* ---- primal_rigid.c: rigid motions, in the order of a direction's passes ---- */

/* Finds the bodies whose rigid motions count, and what they weigh. After primal_find_leaning(). */
void primal_find_rigid(Primal *p);

/* With the contacts that are active now. */
void primal_weigh_rigid(Primal *p);

/* In a pass: sums Z'v of a block, v from its first float on. Then the motions zc follow. */
void primal_sum_rigid(Primal *p, int32_t block, const float *v, double *sum);
void primal_solve_rigid(Primal *p);

/* In a pass: p->right -= H zc; uses p->direction. */
void primal_deflate(Primal *p, int32_t block, size_t begin, size_t end);

/* In a pass: sums Z'Hz of z = p->direction. Then the motions become what is added to it. They use p->force. */
void primal_sum_inertia(Primal *p, int32_t block, size_t begin, size_t end, double *sum);
void primal_correct_rigid(Primal *p);
void primal_add_rigid(Primal *p, int32_t block, size_t begin, size_t end);

/* What the motion along d of a point at `arm` is made of; the energy of a spring there, added to body->factor; L of that; the solution of
 * L L' x = body->sum. */
void primal_motion_along(const double arm[3], const float d[3], double out[RIGID_MODES]);
void primal_add_along(RigidBody *body, const double arm[3], const float direction[3], double stiffness);
void primal_factorise(RigidBody *body);
void primal_solve_modes(const RigidBody *body, double x[RIGID_MODES]);

/* Adds up the products of places x and y: m x_a y_a, and m (x_b y_c + x_c y_b) / 2. */
void primal_sum_products(double mass, const double x[3], const double y[3], double sum[RIGID_MODES]);

/* What it costs to turn x away from y, as the rotations' part of m. False, and m as it was, where no rotation is the best one nearby. */
bool primal_weigh_turns(const double products[RIGID_MODES], double m[RIGID_MODES][RIGID_MODES]);

/* ---- primal_start.c ---- */

/* Starts bodies from their rigid motion if that has less energy than their start: what vibrates too fast for the substep would be stretched by its
 * velocity, and a few iterations would not bring it below the energy that it had. After weigh_nodes(). */
void primal_choose_start(Primal *p);

/* Where a motion takes a point, turned by the angle whose tangent it has: without strain. */
void primal_move_rigidly(const double motion[RIGID_MODES], const double x[3], double out[3]);

/* Writes those rigid motions to the nodes that have mass. */
void primal_write_rigid(Primal *p, int32_t block, size_t begin, size_t end, float *node);

/* The rigid motions of a block's body; from its centre to the block's first node, and to another one; the sums of the last pass per body. */
RigidBody *primal_rigid_of(const Primal *p, int32_t block);
void primal_corner(const Primal *p, int32_t block, const RigidBody *body, double corner[3]);
void primal_arm(const double corner[3], size_t node, double arm[3]);
void primal_gather_rigid(Primal *p, int count);

/* ---- primal_spin.c ---- */

/* Finds what bodies lose of their rotation. After all else; uses p->right. */
void primal_find_spin(Primal *p);

/* After particles have moved: gives it back. */
void primal_turn(World *world);

/* ---- primal_bounce.c ---- */

/* Finds what bodies get back of the energy that being pushed took. After constraints_book_impulses(). */
void primal_find_bounces(Primal *p);

/* After particles have moved: they get it, and contacts' impulses with them. */
void primal_bounce(World *world, const ContactFrame *contacts);

/* The largest q <= 1 with |v + q more| <= limit, or <= |v| where that is more. */
double primal_share_within(const double v[3], const double more[3], double limit);

/* The least share that blocks find, per body. It is 0 where a particle was slowed to max_displacement: what that took is not given back. */
typedef double BlockShare(World *world, const RigidBody *body, int32_t block);
void primal_find_shares(World *world, BlockShare *find);

/* What max_displacement is as a speed. */
double primal_fastest(const World *world);

/* ---- primal_liquid.c ---- */

/* Finds how much of their velocities bodies with liquid may keep, and pulls back those for which that is not enough. */
void primal_find_kept(Primal *p);

/* The displacements that make the velocities: p->node, or where bodies keep less, p->right. */
const float *primal_kept_motion(Primal *p);

/* ---- primal_gaps.c ---- */

/* Lets nodes of solids go as far into obstacles as the particles that they carry have room. Nothing has been solved for yet. */
void primal_widen_gaps(Primal *p);

/* ---- primal_momentum.c ---- */

/* Moves bodies with liquid that lean on something as a whole, as far as their forces ask for it. Uses p->right and p->direction. */
void primal_balance_momentum(Primal *p);

/* Adds a normal to the directions that a body may not move along, which are orthonormal, unless these hold it already. */
void primal_block_normal(double blocked[3][3], int *count, const float normal[3]);

/* Steps by which a body that rubs finds its way: with the secant of friction for a stiffness they fall short, never too far. The rest waits for the next substep. */
enum { RUB_STEPS = 3 };

/* Gives the chosen bodies, all if the test is null, the momentum that an unfinished solution kept from them, as far as they may move. */
void primal_keep_momentum(Primal *p, BodyTest *chosen);

#endif
