#include "contact/wet_side.h"

#include <math.h>
#include <string.h>

/* Below this share of the other side's matter a side of a thin wall counts as dry. */
static const float DRY = 0.02f;

/* Matter before a face: the heavier of the nodes next to the places 0.6 and 1.4 cells before it. */
static float wetness(const WetSite *site, const Face *face)
{
    const Grid *grid = site->frame->grid;
    const float *node = grid->node.data;
    float most = 0.0f;
    for (double before = 0.6; before < 1.5; before += 0.8) {
        int way[3];
        for (int a = 0; a < 3; a++) way[a] = (int)field_whole((before - face->distance) * face->normal[a] + 0.5);
        const int64_t there = grid_node_beside(grid, site->block, site->local, way);
        if (there >= 0) most = fmaxf(most, node[there * K_NODE_WIDTH + 3]);
    }
    return most;
}

bool wet_is_dry(const WetSite *site, const Face *face) { return face->distance < WET_CLEAR && site->mass > 0.0f && wetness(site, face) <= DRY * site->mass; }

/* Where thin walls meet, the nearest way out of a node in them leads past the corner to the dry side: taken for that, it would let matter into the corner. The next
 * ways out are tried until there is matter before one. Returns the number of its faces; 0: there is none. */
static int find_wet_faces(const WetSite *site, double reach, const Face *nearest, Face face[FIELD_FACES])
{
    enum { MOST = 6 }; /* faces of a corner of three walls */
    Face passed[MOST];
    int passes = 0;
    for (passed[passes++] = *nearest; passes <= MOST; passed[passes++] = face[0]) {
        const int faces = field_other_faces(site->near, site->point, reach, passed, passes, face);
        if (faces == 0 || !wet_is_dry(site, &face[0])) return faces;
        if (passes == MOST) return 0;
    }
    return 0;
}

int wet_faces(const WetSite *site, double reach, Face face[FIELD_FACES], bool *thin, bool *both)
{
    Face other, wet[FIELD_FACES];
    double behind[3];
    const int faces = field_faces(site->near, site->point, reach, face);
    *both = *thin = false;
    if (faces == 0 || face[0].distance >= WET_CLEAR) return faces;
    for (int a = 0; a < 3; a++) behind[a] = site->point[a] - NODE_REACH * site->near->cell_size * face[0].normal[a];
    *thin = field_distance(site->near, behind) > 0.0 && field_opposite(site->near, site->point, &face[0], &other);
    if (!*thin) {
        const int wets = wet_is_dry(site, &face[0]) ? find_wet_faces(site, reach, &face[0], wet) : 0;
        *thin = wets > 0;
        if (wets == 0) return faces;
        memcpy(face, wet, sizeof wet);
        return wets;
    }
    const float here = wetness(site, &face[0]), there = wetness(site, &other);
    if (there <= DRY * here) return faces;
    *both = here > DRY * there;
    if (*both) {
        face[1] = other;
        return 1;
    }
    face[0] = other;
    return field_faces_beside(site->near, site->point, reach, face);
}
