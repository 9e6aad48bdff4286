/* Obstacles during a substep, and their motion. */
#ifndef PBMPM_SRC_CONTACT_OBSTACLES_H
#define PBMPM_SRC_CONTACT_OBSTACLES_H

#include "pbmpm/collider.h"
#include "shape/shapes.h"

/* How an obstacle that is a rigid body answers to impulses in a step: by B B^T, with one column of B per degree of freedom: velocity [m/s] and spin [rad/s] per root of
 * the energy's unit. */
enum { BODY_WAYS = 6 };
typedef struct BodyAnswer {
    int count;                /* of columns; 0: it goes its way whatever pushes it */
    double way[BODY_WAYS][6];
    double centre[3];         /* [m]: what it turns about */
    double push[6];           /* by gravity and the host: force and torque about the centre */
    double other[6];          /* what else changed its velocity and spin in the last step: contacts that walls do not see */
    bool walled; /* matter followed its walls */
    double answered[6];       /* what walls made of it in this step so far, and after the step in all */
} BodyAnswer;

/* An obstacle during one substep: a collider, or a wall of the domain. */
typedef struct Obstacle {
    Solid start, end;
    double turn[9]; /* rotation from start to end */
    bool moves;
    bool wall; /* of the domain: particles are always put back inside at once */
    pbmpm_friction friction;
    float coefficient;
    bool measures;
    uint16_t place; /* of its impulse, see Impulses.sum */
    uint32_t meets; /* groups of materials; 0: all */
    BodyAnswer answer;
    double elapsed, parts; /* substeps of this step, with this one; and in all */
} Obstacle;

/* Whether what `meets` these groups acts on matter of those; see pbmpm_collider_def. */
static const uint32_t ALL_GROUPS = UINT32_MAX;
static inline bool groups_meet(uint32_t meets, uint32_t groups) { return meets == 0 || (meets & groups) != 0; }
static inline bool obstacle_meets(const Obstacle *obstacle, uint32_t groups) { return groups_meet(obstacle->meets, groups); }

/* Distance [m] of a point from an obstacle at the end of the substep, negative inside, and the outward normal. */
double obstacle_distance(const Obstacle *obstacle, const double point[3], double normal[3]);

/* Where the obstacle carries a point of its own in the substep [cells], at most `limit`. */
void obstacle_motion(const Obstacle *obstacle, const double point[3], double cell_size, float limit, float out[3]);

#endif
