/* How full the surroundings of an emitter are: the rest volume on its nodes, as the grid will see it. */
#ifndef PBMPM_SRC_STEP_OCCUPANCY_H
#define PBMPM_SRC_STEP_OCCUPANCY_H

#include "world/world.h"

enum {
    OCCUPANCY_WIDE = 2, /* nodes to either side of a particle's own that count; by trial */
    OCCUPANCY_RIM = OCCUPANCY_WIDE + 3 /* outside of the domain: two that do not know all of their particles, and one that is closed; and what rounding takes */
};

typedef struct Occupancy {
    int32_t low[3];
    int32_t size[3]; /* nodes */
    uint32_t groups; /* of the emitter's material */
    float *volume;
    double held; /* rest volume of all particles [cells] */
    double room; /* what a closed room around the nodes has [cells]; infinite where it is open */
} Occupancy;

/* A place between those nodes. */
typedef struct Spot {
    size_t corner; /* of its stencil */
    double w[3][3];
} Spot;

double occupancy_nodes(const Occupancy *occupancy);

/* Adds up the volumes of all particles that touch the nodes, and finds the room that there is. */
void occupancy_measure(const World *world, Occupancy *occupancy);

/* False: some node that a particle there touches is not among them. `place` in cells. */
bool occupancy_find(const Occupancy *occupancy, int dimension, const double place[3], Spot *spot);

/* Adds a particle of a rest volume [cells]. */
void occupancy_add(Occupancy *occupancy, int dimension, const Spot *spot, double volume);

/* Rest volume per volume that obstacles leave open, of the nodes up to OCCUPANCY_WIDE away. Obstacles are looked at only if `walled`. */
double occupancy_filling(const World *world, const Occupancy *occupancy, const double place[3], bool walled);

/* How full the space is that matter takes around a place, whatever is empty beside it. */
double occupancy_crowding(const Occupancy *occupancy, int dimension, const double place[3]);

/* Rest volume per volume of the nodes that a particle there touches, obstacles or not. */
double occupancy_density(const Occupancy *occupancy, int dimension, const Spot *spot);

/* How near the next obstacle is to a point [m], in cells; negative inside. */
double occupancy_clearance(const World *world, const Occupancy *occupancy, const double point[3]);

#endif
