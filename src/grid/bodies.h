/* Bodies: connected matter, as far as the grid can tell. Two particle blocks belong together if they touch the same nodes. */
#ifndef PBMPM_SRC_GRID_BODIES_H
#define PBMPM_SRC_GRID_BODIES_H

#include "grid/grid.h"

typedef struct Bodies {
    int32_t count;
    Array of_block; /* int32_t per node block: its body, in [0, count), numbered by their first blocks */
} Bodies;

/* False without memory. */
bool bodies_find(Bodies *bodies, Memory *memory, const Grid *grid);
void bodies_free(Bodies *bodies, Memory *memory);

#endif
