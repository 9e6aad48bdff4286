/* The faces that a node is bound to. Matter beyond a wall that is thinner than a node's spline reaches the node through it. So the nearest face is not always the right one:
 * taken for the other side's, matter that leans on the wall would be pressed through it. A node is bound to the faces that its matter sees. */
#ifndef PBMPM_SRC_CONTACT_WET_SIDE_H
#define PBMPM_SRC_CONTACT_WET_SIDE_H

#include "contact/field.h"

/* Nodes before a wall that are at least so far off [cells] move along its normal freely; half a cell, with what walls are rounded by. */
static const double WET_CLEAR = 0.4999;

/* Where a node looks from. */
typedef struct WetSite {
    const ContactFrame *frame;
    const Near *near; /* wet_is_dry() does not ask */
    int32_t block;
    int local[3]; /* of the node in its block */
    double point[3];
    float mass;
} WetSite;

/* Those faces, the nearest first, and others within `reach` [cells]; returns their number. `thin`: matter beyond a wall may reach the node, so they
 * hang on where matter is. `both`: matter is on both sides; then the face is one, and the other side's stands behind it in face[1]. */
int wet_faces(const WetSite *site, double reach, Face face[FIELD_FACES], bool *thin, bool *both);

/* Whether the matter that reaches a node in an obstacle is elsewhere than before this face: near an edge, before the next one. */
bool wet_is_dry(const WetSite *site, const Face *face);

#endif
