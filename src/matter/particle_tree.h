/* Finding particles by place: boxes around stretches of the storage order, boxes around those, and so on. A step sorts the
 * particles by block and cell, so a stretch is a lump; after edits the boxes may be large, but they are right. */
#ifndef PBMPM_SRC_MATTER_PARTICLE_TREE_H
#define PBMPM_SRC_MATTER_PARTICLE_TREE_H

#include "base/memory.h"
#include "matter/particles.h"

enum { PARTICLE_TREE_LEVELS = 10 }; /* 64 * 8^8 particles are more than there can be */

/* The cells that rows of particles are in, both ends included. */
typedef struct ParticleBox {
    int32_t low[3], high[3];
} ParticleBox;

typedef struct ParticleTree {
    uint64_t generation; /* of the particles that it was made for */
    uint32_t rows;
    int dimension;
    int levels;
    uint32_t begin[PARTICLE_TREE_LEVELS], count[PARTICLE_TREE_LEVELS]; /* of the boxes of a level; level 0: stretches of rows */
    Array box;
} ParticleTree;

/* Makes the boxes, unless they are those of this generation. */
pbmpm_result particle_tree_build(ParticleTree *tree, Memory *memory, const Particles *particles, uint64_t generation, Pool *pool);
void particle_tree_free(ParticleTree *tree, Memory *memory);

/* Whether anything in a box can be of interest. */
typedef bool ParticleBoxTest(const ParticleBox *box, void *context);
/* The rows [begin, end), which fill a box of interest. */
typedef void ParticleBoxRows(const ParticleBox *box, uint32_t begin, uint32_t end, void *context);

/* Visits the stretches of interest in storage order. */
void particle_tree_visit(const ParticleTree *tree, ParticleBoxTest *test, ParticleBoxRows *rows, void *context);

/* The smallest t >= `from` at which start + t direction (cells; of length 1) is nearer than `margin` to a particle's cell along every axis, or a
 * little less: no more cells than a stretch has rows. INFINITY if there is none. `particles` are those that it was made for. */
double particle_tree_entry(const ParticleTree *tree, const Particles *particles, const double start[3], const double direction[3], double from,
                           double margin);

#endif
