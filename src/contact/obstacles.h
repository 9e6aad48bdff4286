/* Obstacles during a substep, and their motion. */
#ifndef PBMPM_SRC_CONTACT_OBSTACLES_H
#define PBMPM_SRC_CONTACT_OBSTACLES_H

#include "pbmpm/collider.h"
#include "shape/shapes.h"

/* An obstacle that is a rigid body yields to what pushes it: its velocity [m/s] and spin [rad/s] change by B B^T times an impulse and its moment about the centre. */
enum { FREE_BODY_WAYS = 6 };
typedef struct FreeBody {
    int32_t ways;  /* degrees of freedom; 0: it yields to nothing */
    int32_t walled; /* matter followed its walls in the last step */
    double way[FREE_BODY_WAYS][6]; /* the columns of B */
    double centre[3];  /* [m]: what it turns about */
    double push[6];    /* gravity and the host: force, and moment about the centre */
    double yielded[6]; /* by how much it yielded to matter at its walls in this step so far */
    double delayed[6]; /* what contacts gave in the last step, and it yields to in this one */

    /* Among solids alone, see primal_yield.h. */
    int32_t yields; /* to solids, too */
    int32_t met;    /* it had contacts with them in this step */
    int32_t part;   /* the substep that `pace` is of */
    double open[FREE_BODY_WAYS][6]; /* the columns of B without what walls of the domain hold */
    double expected[6]; /* impulse of matter in this step, and its moment about the centre, that its velocity has already */
    double expects[6];  /* the velocity */
    double change[FREE_BODY_WAYS]; /* of its velocity by what matter gave instead, along `open` */
    double went[6];     /* where that took it before this substep [m], [rad] */
    double pace[6];     /* and in this substep */
    double begins[3];   /* where the centre is when a substep begins, on average [m]: there contacts with solids turn it */
} FreeBody;

/* B B^T times an impulse and its moment. */
void free_body_yields(const FreeBody *body, const double push[6], double change[6]);

/* The same where walls of the domain hold it: of `open`. */
void free_body_yields_openly(const FreeBody *body, const double push[6], double change[6]);

/* Takes out of `open` and `delayed` what a wall holds: motion along `unit`, outwards, with its moment about the centre. */
void free_body_hold(FreeBody *body, const double unit[6]);

/* Moves a solid by a way and a turn [rad] about a centre. */
void solid_displace(Solid *solid, const double centre[3], const double way[6]);

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
    FreeBody *body;  /* null: it goes its way */
    int part, parts; /* which substep of how many this is */
} Obstacle;

/* Whether what `meets` these groups acts on matter of those; see pbmpm_collider_def. */
static const uint32_t ALL_GROUPS = UINT32_MAX;
static inline bool groups_meet(uint32_t meets, uint32_t groups) { return meets == 0 || (meets & groups) != 0; }
static inline bool obstacle_meets(const Obstacle *obstacle, uint32_t groups) { return groups_meet(obstacle->meets, groups); }

/* Finds `turn`. */
void obstacle_set_turn(Obstacle *obstacle);

/* Distance [m] of a point from an obstacle at the end of the substep, negative inside, and the outward normal. */
double obstacle_distance(const Obstacle *obstacle, const double point[3], double normal[3]);

/* How thick [m] it is where it is thinnest; of what is baked the least that its grid can show. */
double obstacle_breadth(const Obstacle *obstacle);

/* Where the obstacle carries a point of its own in the substep [cells], at most `limit`. */
void obstacle_motion(const Obstacle *obstacle, const double point[3], double cell_size, float limit, float out[3]);

#endif
