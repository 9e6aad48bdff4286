/* What obstacles and matter give each other: impulses, per collider and wall of the domain.
 *
 * All that changes the momentum of nodes or particles on behalf of an obstacle is booked where it is done: obeying contacts, images at walls, and
 * putting particles back. A node's displacement that changes by du changes momentum by m dx^d (dx/dt) du. What of it counts depends on the
 * solver: in the paper's each contact adds up over the iterations; the others compute u = project(u* + q/m) anew in each
 * iteration, so the last one is the impulse, and q, whose sum is 0, has none. Particles' velocities count as they change. */
#ifndef PBMPM_SRC_CONTACT_IMPULSES_H
#define PBMPM_SRC_CONTACT_IMPULSES_H

#include "contact/domain.h"
#include <stdbool.h>
#include <stdint.h>

#include "base/memory.h"
#include "pbmpm/collider.h"

enum { IMPULSE_PLACES = PBMPM_MAX_COLLIDERS + DOMAIN_WALLS, PUSH_NOTES = 4 };

/* What matter gave to an obstacle: [kg m/s], and about the world's origin [kg m^2/s]. */
typedef struct ImpulseSum {
    double linear[3], angular[3];
} ImpulseSum;

/* What one particle block's particles gave to obstacles by being put back. A block that meets more than PUSH_NOTES obstacles that
 * measure waits for the serial pass: at the obstacle `resume` that particles may have passed, or, behind the last one, at the row that may be inside. */
typedef struct PushNotes {
    ImpulseSum sum[PUSH_NOTES];
    int32_t obstacle[PUSH_NOTES];
    int32_t count;
    int32_t resume; /* -1: done */
    bool held;      /* something was held back by those before it */
    uint32_t row;
} PushNotes;

typedef struct Impulses {
    ImpulseSum *sum;    /* IMPULSE_PLACES: colliders by slot, then walls by 2 * axis + (1 if upper); null until something measures */
    bool adds_up;       /* over the iterations: the paper's solver */
    Array contact;      /* double[3] per contact: mass times change of displacement, in the kernels' units */
    Array notes;        /* PushNotes per particle block */
} Impulses;

/* Takes memory for sums. */
pbmpm_result impulses_enable(Impulses *impulses, Memory *memory);
void impulses_free(Impulses *impulses, Memory *memory);

/* All sums to 0: a step begins. */
void impulses_clear(Impulses *impulses);

/* Takes the momentum that matter at `point` [m] gained from the obstacle's sum. */
void impulse_add(ImpulseSum *sum, const double point[3], const double gained[3]);

/* The world's origin goes by `way` [m]. */
void impulses_shift(Impulses *impulses, const double way[3]);

/* The sum of a collider (by slot) or wall about a point [m]. */
pbmpm_impulse impulse_about(const ImpulseSum *sum, const double point[3], int dimension);

#endif
