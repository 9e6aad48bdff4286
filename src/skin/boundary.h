/* Obstacles around matter: they end the surface, and what their insides lack is seen in a mirror.
 *
 * A kernel at a wall reaches into it, where no particles are: F falls to 1/2 there though matter is whole, and each gap between particles is a dent. A mirror image of
 * matter in the wall fills the kernel. F is symmetric in particle and point, so that of the image at x is F at the reflection of x: in one plane
 *     G(x) = F(x) + F(x - 2 d n),    d: the distance of x, n: the normal.
 * In a hollow edge or corner reflections in all sets of its planes add up. Matter on this side is nearer to x than to its reflection, so a reflection counts
 * for no more than F(x): matter behind a thin wall has no image before it.
 *
 * G does not end at the wall. The surface is that of min(G, L + s d), with the slope s that F has at a flat surface: it lies on the wall where matter touches it. */
#ifndef PBMPM_SRC_SKIN_BOUNDARY_H
#define PBMPM_SRC_SKIN_BOUNDARY_H

#include "skin/field.h"
#include "world/world.h"

typedef struct Boundary Boundary;

/* What an obstacle is to a surface. */
typedef struct Stand {
    Solid solid;
    uint32_t meets;    /* groups of materials */
    uint32_t baked;    /* the generation of its baked solid, or 0 */
    uint64_t surface;  /* the last one before which it became this */
} Stand;

/* The obstacles where they stand now. */
struct Boundary {
    Colliders colliders; /* of which this has the list of obstacles alone */
    Array obstacle, stand; /* Obstacle; Stand of each */
    int stands;
    uint64_t surface; /* counts the times that they were found */
    bool changed;     /* in the last of them */
};

/* Lists the obstacles, and notes which of them are not as they were. False: no memory. */
bool boundary_find(Boundary *boundary, World *world);
void boundary_free(Boundary *boundary, Memory *memory);

/* Makes G of F, and measures how far obstacles are where that matters: in blocks that are changed, beside them, and where obstacles changed. Those where either is not
 * what it was are changed now. */
void boundary_mirror(const FieldWork *work);

/* Ends the matter of a bounded block at the obstacles. */
void boundary_cut(const FieldWork *work, float values[BLOCK_POINTS], const float gaps[BLOCK_POINTS]);

#endif
