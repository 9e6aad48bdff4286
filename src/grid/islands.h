/* Islands of matter: what is best to solve with depends on what touches what, not on what else the world holds.
 *
 * Particles belong to one island if a chain of nodes with mass leads from one to the other; two share a node where their cells differ by two at most along every
 * axis. An island holds some of the kinds solid, liquid and sand. Those that hold the same kinds make a group. With PBMPM_SOLVER_CONVERGENT each group is
 * solved as if it were all there is: on a grid of its own, counted from its own lowest cell, with the solver, the moduli and the iterations of such a world. So what
 * is elsewhere changes nothing, not a bit. Where all islands hold the same kinds there is one group, the grid of all particles.
 *
 * While a group is entered, world->grid is its grid and particles.of_material counts its particles. */
#ifndef PBMPM_SRC_GRID_ISLANDS_H
#define PBMPM_SRC_GRID_ISLANDS_H

#include "grid/grid.h"
#include "matter/materials.h"
#include "pbmpm/material.h"
#include "pbmpm/world.h"

struct World;
struct StepRecord;

enum { KIND_SOLID = 1, KIND_LIQUID = 2, KIND_SAND = 4, ISLAND_KINDS = 3, ISLAND_GROUPS = GRID_PARTS };
_Static_assert((int)ISLAND_GROUPS == (1 << ISLAND_KINDS) - 1, "one part per set of kinds");

typedef struct Islands {
    int groups;                      /* of the last substep; 0 or 1: all matter is one */
    Grid part[ISLAND_GROUPS];        /* of the groups from the second on; [0] is not used */
    uint32_t particles[ISLAND_GROUPS][PBMPM_MAX_MATERIALS]; /* of each group and material */
    Array cells;                     /* uint64_t per block and kind: the cells that hold such particles */
    Array up;                        /* int32_t the same: see sets.h; after that the group */
    uint32_t kinds[ISLAND_GROUPS];   /* of each group */
    uint32_t contacts;               /* of the groups before the last */
} Islands;

void islands_free(Islands *islands, Memory *memory);

/* Which of KIND_SOLID and so on the particles are that are counted in particles.of_material. */
uint32_t islands_kinds(const struct World *world);

/* The one of a material. */
uint32_t islands_kind(const Materials *materials, uint32_t slot);

/* In place of grid_build(): finds the islands and builds the grid of each group. */
pbmpm_result islands_build(struct World *world);

/* Whether more than one group may come of it: the convergent solver, and matter of several kinds. */
bool islands_wanted(const struct World *world);

/* Between steps: finds the groups that the next substep will have, without their grids. False: no memory. */
bool islands_foresee(struct World *world);

/* All that is done between them is done to one group. */
void islands_enter(struct World *world, int group);
void islands_leave(struct World *world, int group);

/* Between steps: the grid of a group of the last substep. */
const Grid *islands_grid(const struct World *world, int group);

#endif
