/* The motion of a rigid body; pbmpm/rigid.h says what it is. */
#ifndef PBMPM_SRC_SERVICES_RIGID_H
#define PBMPM_SRC_SERVICES_RIGID_H

#include "pbmpm/rigid.h"
#include "world/colliders.h"

pbmpm_rigid_def rigid_defaults(void);

/* Null if valid, else what is wrong. */
const char *rigid_def_problem(const pbmpm_rigid_def *def, int dimension);
const char *rigid_state_problem(const pbmpm_rigid_state *state, int dimension);

/* At rest where the obstacle is. */
pbmpm_rigid_state rigid_at(const Collider *collider, const pbmpm_rigid_def *def, int dimension);

/* What it turns about: its centre of mass, or its pivot. */
void rigid_centre(const pbmpm_rigid_def *def, const pbmpm_rigid_state *state, int dimension, double centre[3]);

/* How it yields to what pushes it, where `state` has it. */
FreeBody rigid_free_body(const pbmpm_rigid_def *def, const pbmpm_rigid_state *state, const double gravity[3], int dimension);

/* What changes a body's velocities in a step. */
typedef struct RigidPush {
    double gravity[3];
    double linear[3], angular[3]; /* what matter gave; the second about the body's centre, where matter met it */
    bool walled;         /* matter followed the body's walls: it has yielded to a part of that in the step itself, and */
    double yielded[6];   /* to how much */
    double delayed[6];   /* what it was given to yield to later, and */
    double later[6];     /* found: what it is given so now */
    bool met;            /* solids made it yield in the step itself; see primal_yield.h */
    double went[6];      /* where to */
    double expects[6];   /* what its velocities have for what they would give; then for what they will */
    double expected[6];  /* found: the impulse of that, and its moment about the centre */
    double virtual_mass;
} RigidPush;

void rigid_change_velocity(const pbmpm_rigid_def *def, pbmpm_rigid_state *state, RigidPush *push, int dimension, double dt);
void rigid_change_pose(const pbmpm_rigid_def *def, pbmpm_rigid_state *state, int dimension, double dt);

/* Where solids made it go beside where it was sent. */
void rigid_follow(const pbmpm_rigid_def *def, pbmpm_rigid_state *state, const double went[6], int dimension);

/* Coulomb's coefficient between a body and a wall; infinite where it does not slide. */
double rigid_friction(const pbmpm_collider_def *body, const pbmpm_domain_wall *wall);

/* Motions that walls stop, outwards, with their moment about the centre. */
enum { RIGID_STOPS = 24 };
typedef struct RigidStops {
    double unit[RIGID_STOPS][6];
    int count;
} RigidStops;

/* Stops what of a body touches walls, and would pass them in a step. Notes what was stopped. */
void rigid_slow_at_walls(const pbmpm_rigid_def *def, pbmpm_rigid_state *state, const Collider *collider, const Domain *domain, int dimension, double dt, RigidStops *stops);

/* Puts a body that passed walls back to them, along what way it may move, and stops what of it touches them: it may still turn about a corner, until it lies flat. */
void rigid_stop_at_walls(const pbmpm_rigid_def *def, pbmpm_rigid_state *state, const Collider *collider, const Domain *domain, int dimension, double dt, RigidStops *stops);

#endif
