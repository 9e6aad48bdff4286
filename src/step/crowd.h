/* How full the surroundings of an emitter are: the rest volume on its nodes, as the grid will see it. */
#ifndef PBMPM_SRC_STEP_CROWD_H
#define PBMPM_SRC_STEP_CROWD_H

#include "world/world.h"

enum {
    CROWD_WIDE = 2,            /* nodes to either side of a particle's own that count */
    CROWD_RIM = CROWD_WIDE + 3 /* outside of the domain: two that do not know all of their particles, and one that is closed; and what rounding takes */
};

typedef struct Crowd {
    int32_t low[3];
    int32_t size[3]; /* nodes */
    uint32_t groups; /* of the emitter's material */
    float *volume;
    double held; /* rest volume of all particles [cells] */
    double room; /* what a closed room around the nodes has [cells]; infinite where it is open */
} Crowd;

/* A point between the nodes of the crowd. */
typedef struct Spot {
    size_t corner; /* of its stencil */
    double w[3][3];
} Spot;

double crowd_nodes(const Crowd *crowd);

/* Adds up the volumes of all particles that touch the nodes, and finds the room that there is. */
void crowd_measure(const World *world, Crowd *crowd);

/* False: some node that a particle there touches is not in the crowd. `place` in cells. */
bool crowd_find(const Crowd *crowd, int dimension, const double place[3], Spot *spot);

/* Adds a particle of a rest volume [cells]. */
void crowd_add(Crowd *crowd, int dimension, const Spot *spot, double volume);

/* Rest volume per volume that obstacles leave open, of the nodes up to CROWD_WIDE away. Obstacles are looked at only if `walled`. */
double crowd_filling(const World *world, const Crowd *crowd, const double place[3], bool walled);

/* Rest volume per volume of the nodes that a particle there touches, obstacles or not. */
double crowd_density(const Crowd *crowd, int dimension, const Spot *spot);

/* How near the next obstacle is to a point [m], in cells; negative inside. */
double crowd_clearance(const World *world, const Crowd *crowd, const double point[3]);

#endif
