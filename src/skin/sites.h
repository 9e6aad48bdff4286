/* Where the particles of a surface are: the blocks that hold them, and their rows. They are found anew for each surface. */
#ifndef PBMPM_SRC_SKIN_SITES_H
#define PBMPM_SRC_SKIN_SITES_H

#include "skin/lattice.h"
#include "skin/matter.h"
#include "skin/places.h"

/* Rows of particles that follow one another in a block. */
typedef struct SiteRun {
    int32_t site;
    uint32_t begin, end;
} SiteRun;

typedef struct Site {
    int32_t place[3];
    uint8_t cells[3]; /* per axis, bit k: a particle is in cell k */
    bool spray;       /* it and those beside it have less than a cell of matter */
    uint32_t first_run, runs;
    float volume; /* of its particles [cells] */
} Site;

typedef struct Sites {
    Places site; /* Site, in the order of rows */
    int32_t runs;
    Array found, run; /* SiteRun, in the order of rows, and by site; those of spray are no part of the latter */
} Sites;

static inline Site *sites_at(const Sites *sites, int32_t s) { return places_at(&sites->site, s); }

/* Finds the sites of the rows that count. What is scattered far and wide is spray and has no blocks: so it takes no memory. False: no memory. */
bool sites_find(Sites *sites, Memory *memory, const SkinMatter *matter, int subdivision);
void sites_free(Sites *sites, Memory *memory);

#endif
