/* How a surface cuts a cube of which some corners are inside: the triangles of marching cubes.
 *
 * W. Lorensen, H. Cline, "Marching Cubes", SIGGRAPH 1987. Their table leaves holes where a side has its inside corners across from each other; R. Wenger,
 * "Isosurfaces", CRC Press 2013, chapter 2, says what closes them. The table is worked out here, from two rules:
 *
 * 1. On a side of the cube, lines cut off each stretch of inside corners by itself. A side's lines follow from its own corners, so both cubes at it have
 *    the same: the surface is closed. At each edge of a cube that is cut, a line comes in on one side and goes out on the other: lines join to loops.
 * 2. A loop becomes a fan of triangles none of whose diagonals lies in a side. So a diagonal belongs to no other cube, and each edge of the surface has
 *    two triangles: it is a manifold. For each loop there is such a fan; tests/unit/test_skin.c tries all 256 cases. */
#ifndef PBMPM_SRC_SKIN_CASES_H
#define PBMPM_SRC_SKIN_CASES_H

#include <stdint.h>

enum { CUBE_CORNERS = 8, CUBE_EDGES = 12, CUBE_CASES = 256, CASE_TRIANGLES = 5 };

/* Corner k is at (k & 1, k >> 1 & 1, k >> 2). Edge e goes along axis e / 4 from case_corner(e). */
typedef struct Cases {
    uint8_t triangles[CUBE_CASES];              /* per set of inside corners, bit k: corner k */
    uint8_t edge[CUBE_CASES][CASE_TRIANGLES * 3]; /* three per triangle, counterclockwise from outside */
    uint16_t corner[CUBE_EDGES];                  /* case_corner() in digits */
    uint8_t before[CUBE_CASES][3];                /* per axis: how many edges from corner 0 are cut along the axes before */
} Cases;

static inline int case_axis(int edge) { return edge / 4; }

static inline int case_corner(int edge)
{
    const int axis = case_axis(edge);
    return (edge & 1) << (axis + 1) % 3 | (edge >> 1 & 1) << (axis + 2) % 3;
}

/* Bit a: the edge along axis a from corner 0 is cut. Corners 1, 2 and 4 are the ends of those. */
static inline int case_cuts(int inside)
{
    const int ends = (inside >> 1 & 3) | (inside >> 2 & 4);
    return inside & 1 ? ends ^ 7 : ends;
}

/* A place as a hexadecimal digit per axis: so places are added. */
static inline unsigned case_digits(unsigned x, unsigned y, unsigned z) { return x | y << 4 | z << 8; }

void cases_make(Cases *cases);

#endif
