/* The distance from a point to the nearest element of a surface. */
#ifndef PBMPM_SRC_SHAPE_BOX_TREE_H
#define PBMPM_SRC_SHAPE_BOX_TREE_H

#include "shape/surface.h"

/* A tree of boxes around elements. Boxes lie in pairs: the children of a box are `child` and the next. */
typedef struct Box {
    float low[3], high[3]; /* lattice units, exact: they are below 2^24 */
    uint32_t child;        /* 0: none; then its elements are order[first] to order[first + count - 1] */
    uint32_t first, count;
} Box;

/* The disc around an element. */
typedef struct Disc {
    double centre[3], normal[3], radius;
} Disc;

typedef struct BoxTree {
    const Surface *surface;
    Box *box;
    uint32_t boxes;
    uint32_t *order;
    Disc *disc; /* in the same order */
} BoxTree;

pbmpm_result box_tree_build(BoxTree *tree, Memory *memory, const Surface *surface);
void box_tree_free(BoxTree *tree, Memory *memory);

/* The distance of a point, at most `slack` too long; all in lattice units. *near: an element that may be near, and then the one that is. */
double box_tree_nearest(const BoxTree *tree, const double point[3], double slack, uint32_t *near);

#endif
