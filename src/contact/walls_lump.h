/* The masses of nodes at walls, with those of the nodes that follow them; see walls.h. */
#ifndef PBMPM_SRC_CONTACT_WALLS_LUMP_H
#define PBMPM_SRC_CONTACT_WALLS_LUMP_H

#include "contact/walls_list.h"

/* M = sum m W A^2 of a listed node, what it has itself included. */
void walls_lump(const Walls *walls, uint32_t place, int dimension);

/* m += scale a a', of a symmetric matrix its upper part by rows. */
static inline void lump_add_product(float m[6], double scale, const double a[3])
{
    int k = 0;
    for (int r = 0; r < 3; r++)
        for (int c = r; c < 3; c++) m[k++] += (float)(scale * a[r] * a[c]);
}

/* M^-1 where it has mass; 0 elsewhere. */
Columns walls_inverse(const float lump[6]);

#endif
