#include "contact/wet_side.h"

#include <math.h>
#include <string.h>

/* How far [nodes] along each axis a node looks for its matter: what it feels lies within 1.5 cells, and is heaviest at nodes up to two off. */
enum { LOOKS = 2 };

/* The middle of the matter around a node, of the masses of the nodes around it. A node has its matter from particles that may all be beyond a thin wall. */
static void middle_of_matter(const WetSite *site, double middle[3])
{
    const Grid *grid = site->frame->grid;
    const float *node = grid->node.data;
    const int deep = grid->dimension == 3 ? LOOKS : 0;
    double sum = 0.0, moment[3] = {0};
    for (int z = -deep; z <= deep; z++)
        for (int y = -LOOKS; y <= LOOKS; y++)
            for (int x = -LOOKS; x <= LOOKS; x++) {
                const int way[3] = {x, y, z};
                const int64_t there = grid_node_beside(grid, site->block, site->local, way);
                if (there < 0) continue;
                const double mass = (double)node[there * K_NODE_WIDTH + 3];
                sum += mass;
                for (int a = 0; a < 3; a++) moment[a] += way[a] * mass;
            }
    for (int a = 0; a < 3; a++) middle[a] = site->point[a] + (sum > 0.0 ? moment[a] / sum * site->near->cell_size : 0.0);
}

/* Below this share of a node's matter the space before a face counts as dry. By trial. */
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

/* Whether matter beyond an obstacle may reach the node. What is baked is at least as thick as its grid can show, and how thick it is a look through it tells. */
static bool may_be_beyond(const WetSite *site)
{
    const Near *near = site->near;
    for (int i = 0; i < near->count; i++) {
        const Solid *solid = field_solid(near, near->obstacle[i]);
        double n[3], beyond[3];
        const double distance = solid_distance(solid, site->point, n);
        const double reach = NODE_REACH * (fabs(n[0]) + fabs(n[1]) + fabs(n[2])) * near->cell_size; /* of the spline along n */
        if (distance + obstacle_breadth(near->obstacle[i]) >= reach) continue;
        for (int a = 0; a < 3; a++) beyond[a] = site->point[a] - reach * n[a];
        if (!solid->grid || solid_gap(solid, beyond) > 0.0) return true;
    }
    return false;
}

int wet_faces(const WetSite *site, double reach, Face face[FIELD_FACES], bool *thin, bool *both)
{
    double middle[3];
    Face seen[FIELD_FACES], other;
    const int faces = field_faces(site->near, site->point, reach, face);
    *both = *thin = false;
    if (faces == 0 || site->mass <= 0.0f || !(may_be_beyond(site) || wet_is_dry(site, &face[0]))) return faces;
    *thin = true;
    middle_of_matter(site, middle);
    const int count = field_faces_from(site->near, middle, site->point, reach, seen);
    if (count > 0) {
        bool apart = face[0].distance <= 0.0; /* in a wall */
        for (int i = 0; i < count && !apart; i++) apart = field_is_between(site->near, middle, site->point, &seen[i]);
        if (!apart) return faces;
        memcpy(face, seen, sizeof seen);
        return count;
    }
    *both = face[0].distance < WET_CLEAR && field_opposite(site->near, site->point, &face[0], &other);
    if (!*both) return faces;
    face[1] = other;
    return 1;
}
