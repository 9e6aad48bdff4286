/* The lattice of a surface: `subdivision` points per cell and axis. With 1 they are the nodes of the grid. With 2 they lie a quarter of a cell beside them, see field.h.
 * Its blocks have 8 points per axis, so 8 or 4 cells, and stand still: the first one begins where the world ends. */
#ifndef PBMPM_SRC_SKIN_LATTICE_H
#define PBMPM_SRC_SKIN_LATTICE_H

#include "pbmpm/world.h"

enum { BLOCK_AXIS = 8, BLOCK_NEIGHBOURS = 27, LATTICE_FIRST = -PBMPM_MAX_CELL };

static inline int32_t lattice_cells(int subdivision) { return BLOCK_AXIS / subdivision; }

/* The first cell of the blocks at a place along an axis. */
static inline int32_t lattice_first(int subdivision, int32_t place) { return LATTICE_FIRST + place * lattice_cells(subdivision); }

/* The place of the block that holds a cell. */
static inline int32_t lattice_place(int subdivision, int32_t cell) { return (cell - LATTICE_FIRST) / lattice_cells(subdivision); }

/* The first point of the blocks at a place, counted from that of cell 0. */
static inline int64_t lattice_point(int subdivision, int32_t place) { return (int64_t)subdivision * lattice_first(subdivision, place); }

#endif
