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

/* The kind of a material: KIND_SOLID and so on. */
uint32_t islands_kind(const Materials *materials, uint32_t slot);

/* Finds the islands and the groups that they make. Of the grid only what it finds blocks with is changed. False: no memory. */
bool islands_find(Islands *islands, Grid *grid, Memory *memory, const Particles *p, const Materials *materials);

/* After that: lists the rows of each group as they stand, from next[] of the group on. */
void islands_list(const Islands *islands, const Grid *grid, const Particles *p, const Materials *materials, uint32_t next[ISLAND_GROUPS], uint32_t *rows);

/* Counts the particles of each group and material. */
void islands_count(Islands *islands, const Grid *grid, const Particles *p, const Materials *materials);

#endif
