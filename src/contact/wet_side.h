/* The faces that a node is bound to. In a thin wall, thinner than two reaches of a node's spline, it is not the nearest but that before which the matter is: taken for the
 * other, matter that leans on the wall would be drawn into it. */
#ifndef PBMPM_SRC_CONTACT_WET_SIDE_H
#define PBMPM_SRC_CONTACT_WET_SIDE_H

#include "contact/field.h"

/* Nodes before a wall that are at least so far off [cells] move along its normal freely; half a cell, with what walls are rounded by. */
static const double WET_CLEAR = 0.4999;

/* Where a node looks from. */
typedef struct WetSite {
    const ContactFrame *frame;
    const Near *near;
    int32_t block;
    int local[3]; /* of the node in its block */
    double point[3];
    float mass;
} WetSite;

/* Those faces, the nearest first, and others within `reach` [cells]; returns their number. `thin`: there is open space behind, too. `both`: matter is on both sides, and
 * the face is one, the other side's behind it in face[1]. */
int wet_faces(const WetSite *site, double reach, Face face[FIELD_FACES], bool *thin, bool *both);

#endif
