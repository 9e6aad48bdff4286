#include <math.h>
#include <string.h>

#include "base/result.h"
#include "base/vector.h"
#include "contact/field.h"
#include "contact/flowing.h"
#include "contact/obstacle_cache.h"
#include "contact/reach.h"
#include "contact/wall_bodies.h"
#include "contact/walls.h"
#include "contact/walls_list.h"
#include "contact/walls_lump.h"
#include "contact/walls_unilateral.h"
#include "contact/wet_side.h"

/* ---- Geometry ---- */

static float mass_of(const Grid *grid, int64_t node) { return node < 0 ? 0.0f : ((const float *)grid->node.data)[node * K_NODE_WIDTH + 3]; }

/* A node at walls: the faces that it is bound to. */
typedef struct Bound {
    uint32_t node; /* of the grid */
    int32_t block;
    int local[3];
    Face face[FIELD_FACES];
    int faces;
    bool both, thin; /* see wet_faces() */
    float open; /* share */
} Bound;

/* ---- The nodes that follow ---- */

/* The unit matrix, as WallNode.own: all of u~ is the node's own. */
static const float ALL[6] = {1.0f, 0.0f, 0.0f, 1.0f, 0.0f, 1.0f};

typedef struct Builder {
    Walls *walls;
    Memory *memory;
    const ContactFrame *frame;
    const Bound *const *bound; /* the first nodes of the list */
    uint32_t bounds;
    bool failed;
} Builder;

/* A face as a node uses it: normals made orthogonal, so that each takes its own part. */
typedef struct Profile {
    double normal[3], axis[3]; /* as it is; orthogonal to those before it */
    double distance, share;    /* share: of the mirror image */
    double bend, rounded;      /* see turn_of() */
    float surface[3];
    double foot[3];
    const Obstacle *owner;
} Profile;

/* Sine of the least angle between planes that do not count as one, see field_same_way(). */
static const double LEAST_TURN = 0.31;

/* Whether two faces are nearly back to back. */
static bool opposed(const Face *a, const Face *b) { return dot3(a->normal, b->normal) < -SAME_DIRECTION; }

/* Whether two faces are of one wall: their planes count as one, and the way from foot to foot leads along them. From a step to a parallel wall behind it the way leads across. */
static bool one_wall(const Face *a, const Face *b)
{
    double way[3];
    for (int k = 0; k < 3; k++) way[k] = a->foot[k] - b->foot[k];
    return field_same_way(a, b) && fabs(dot3(way, a->normal)) <= LEAST_TURN * sqrt(dot3(way, way));
}

/* Whether the wall at one node goes on at another: with a slight turn, or round an outer edge. Where it meets another in an inner edge, nodes have the faces of both. */
static bool wall_goes_on(const ContactFrame *frame, const Bound *here, const Bound *there)
{
    const Face *face = &here->face[0], *other = &there->face[0];
    double before = 0.0; /* the one's foot, before the other's plane */
    if (field_same_way(face, other)) return true;
    if (opposed(face, other)) return false;
    for (int k = 1; k < here->faces; k++)
        if (one_wall(&here->face[k], other)) return false;
    for (int k = 1; k < there->faces; k++)
        if (one_wall(&there->face[k], face)) return false;
    for (int a = 0; a < 3; a++) before += (face->foot[a] - other->foot[a]) * other->normal[a];
    return before < 1e-3 * frame->cell_size;
}

/* What a node of the grid is bound to; null if it is not. */
static const Bound *bound_at(const Builder *b, int64_t node)
{
    const uint32_t at = ((const uint32_t *)b->walls->place.data)[node];
    return at > 0 && at <= b->bounds ? b->bound[at - 1] : NULL;
}

/* A wall as the spline of a node sees it. */
typedef struct Turn {
    double normal[3];
    double bend, rounded; /* [cells]: by how much it sees the wall farther off; bend is 0 where the wall is not smooth */
} Turn;

/* The normal is the slope of the distances at nodes, which turns at edges as slowly as the spline does. A normal that leaps there lets an even pressure do work: it
 * drove vortices out of each blunt edge. The spline's variance is 1/4 per axis, so it sees a curved wall off by an eighth of the distances' Laplacian: by so much
 * more is open, and by so much the profile of the normal motion is too high. That is the volume between a wall and its image, see walls_weigh(). */
static Turn turn_of(const Builder *b, const Bound *bound)
{
    static const double LEAST_SLOPE = 0.5; /* by trial: a quarter of that of a plane; less is between two walls, which have no normal in common */
    static const double SMOOTH = 0.875; /* cosine of the turn per cell of a ball with a radius R of two cells, 1 - 1 / (2 R^2): smaller ones are no smooth walls. With 0.9 its lift is 9 % too large */
    const Grid *grid = b->frame->grid;
    const Face *face = &bound->face[0];
    Turn turn = {.bend = 0.0, .rounded = 0.0};
    double slope[3] = {0}, length = 0.0;
    for (int a = 0; a < grid->dimension; a++) {
        double curve = 0.0;
        bool smooth = true;
        for (int side = -1; side <= 1; side += 2) {
            int way[3] = {0};
            way[a] = side;
            const int64_t other = grid_node_beside(grid, bound->block, bound->local, way);
            const Bound *beside = other == GRID_NOWHERE ? NULL : bound_at(b, other);
            double distance = face->distance + side * face->normal[a];
            if (beside && wall_goes_on(b->frame, bound, beside)) distance = beside->face[0].distance;
            const bool across = bound->thin && distance < 0.0; /* its gap is that of the wall's other side */
            if (!beside && !across && other != GRID_NOWHERE && (double)b->frame->gap[other] < INFINITY) distance = fmax(distance, (double)b->frame->gap[other]);
            smooth = smooth && beside && dot3(face->normal, beside->face[0].normal) > SMOOTH;
            slope[a] += side * distance;
            curve += distance - face->distance;
        }
        if (smooth) turn.bend += curve / 8.0;
        turn.rounded += curve / 8.0;
    }
    for (int a = 0; a < 3; a++) length += slope[a] * slope[a];
    length = sqrt(length);
    const double inverse = length > LEAST_SLOPE ? 1.0 / length : 0.0;
    for (int a = 0; a < 3; a++) turn.normal[a] = length > LEAST_SLOPE ? slope[a] * inverse : face->normal[a];
    return turn;
}

/* Whether an even pressure works on what a normal lets through. It pushes nodes with the sum over particles of the slopes of their weights; as these lie, that leans from
 * the wall's normal by some degrees at walls that lean against the grid, and so drives eddies along them for ever. Behind the wall, and where the wall is straight along
 * an axis, that is little. */
static bool pressure_leans(const Bound *bound)
{
    static const double STRAIGHT = 0.999; /* cosine, of 2.6 degrees: nearer to an axis the push leans by less than particles' places do */
    const double *n = bound->face[0].normal;
    for (int k = 1; k < bound->faces; k++)
        if (!field_same_way(&bound->face[k], &bound->face[0]) && bound->face[k].distance < 1.5) return false; /* that one bears a part */
    return fabs(bound->face[0].distance) < WET_CLEAR && fmax(fabs(n[0]), fmax(fabs(n[1]), fabs(n[2]))) < STRAIGHT;
}

/* The normal goes half way to the push of an even pressure: along the wall's own, that does work; along the push's, matter goes through the wall. By more than planes that
 * count as one differ the push leans where more than the wall bears it: at surfaces. */
static void lean(const Builder *b, const Bound *bound, double normal[3])
{
    const FlowingSite site = {b->frame, bound->block, {bound->local[0], bound->local[1], bound->local[2]}};
    double push[3], size2 = 0.0;
    flowing_push(&site, push);
    const double size = sqrt(dot3(push, push)), along = dot3(push, normal);
    if (!(along > sqrt(1.0 - LEAST_TURN * LEAST_TURN) * size)) return;
    for (int a = 0; a < 3; a++) {
        normal[a] = field_rounded(normal[a] + push[a] / size);
        size2 += normal[a] * normal[a];
    }
    for (int a = 0; a < 3; a++) normal[a] /= sqrt(size2);
}

/* Matter that is faster than it would be after a fall of one cell, v^2 > 2 g dx, flies on where the wall turns away: a jet contracts. */
static bool clings(const ContactFrame *frame, const Bound *bound)
{
    const float *u = (const float *)frame->grid->node.data + (size_t)bound->node * K_NODE_WIDTH;
    return (double)(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) <= 2.0 * frame->fall;
}

/* Its normal without what those before it have of it, of length 1. False: no more is left than planes that count as one differ by. */
static bool make_upright(Profile *profile, int i)
{
    double *axis = profile[i].axis;
    memcpy(axis, profile[i].normal, sizeof profile[i].axis);
    for (int k = 0; k < i; k++) {
        const double along = dot3(axis, profile[k].axis);
        for (int a = 0; a < 3; a++) axis[a] -= along * profile[k].axis[a];
    }
    const double length = sqrt(dot3(axis, axis));
    if (length < LEAST_TURN) return false;
    const double inverse = 1.0 / length;
    for (int a = 0; a < 3; a++) axis[a] *= inverse;
    return true;
}

/* The nearest face and others that the node is near to. One by itself has the normal that turns. */
static int profiles_of(const Builder *b, const Bound *bound, Profile profile[NORMALS_MAX])
{
    const Face *own[NORMALS_MAX];
    int used = 0;
    for (int i = 0; i < bound->faces && used < b->frame->grid->dimension; i++) {
        const Face *face = &bound->face[i];
        Profile *p = &profile[used];
        bool differs = i == 0 || face->distance < 1.0;
        for (int k = 0; k < used; k++) differs = differs && !field_same_way(face, own[k]) && !opposed(face, own[k]);
        for (int a = 0; a < 3; a++) p->normal[a] = field_rounded(face->normal[a]);
        if (differs && make_upright(profile, used)) own[used++] = face;
    }
    const bool turns = used == 1 && clings(b->frame, bound);
    const Turn turn = turns ? turn_of(b, bound) : (Turn){.bend = 0.0, .rounded = 0.0};
    for (int a = 0; a < 3 && turns; a++) profile[0].normal[a] = field_rounded(turn.normal[a]);
    if (turns && b->frame->pressed && pressure_leans(bound)) lean(b, bound, profile[0].normal);
    for (int a = 0; a < 3 && turns; a++) profile[0].axis[a] = profile[0].normal[a];
    for (int i = 0; i < used; i++) {
        Profile *p = &profile[i];
        p->distance = field_rounded(own[i]->distance - turn.bend);
        p->bend = turn.bend;
        p->rounded = turn.rounded;
        p->share = fmin(fmax(0.5 - 0.5 * p->distance, 0.0), 1.0);
        obstacle_motion(own[i]->obstacle, own[i]->foot, b->frame->cell_size, b->frame->max_displacement, p->surface);
        memcpy(p->foot, own[i]->foot, sizeof p->foot);
        p->owner = own[i]->obstacle;
    }
    return used;
}

/* The number of a node of the grid in the list; it is added if it is new. */
static uint32_t listed(Builder *b, int64_t node)
{
    Walls *walls = b->walls;
    uint32_t *place = (uint32_t *)walls->place.data + node;
    if (*place) return *place - 1;
    const size_t kept = (size_t)walls->nodes * sizeof(WallNode);
    if (!array_grow(b->memory, &walls->node, (size_t)walls->nodes + 1, sizeof(WallNode), kept)) {
        b->failed = true;
        return 0;
    }
    WallNode *added = (WallNode *)walls->node.data + walls->nodes;
    *added = (WallNode){.node = (uint32_t)node, .entry = NO_ENTRY, .mass = mass_of(b->frame->grid, node), .own = {1, 0, 0, 1, 0, 1}, .own_mirror = 1.0f, .open = -1.0f};
    *place = ++walls->nodes;
    return *place - 1;
}

/* A place whose nodes stand for a node at a wall. */
typedef struct Image {
    double way[3]; /* from the node [cells] */
    double weight;
    bool before; /* only nodes before all faces count */
} Image;

/* How far [cells] beside a node is on it. Weights that are less are not worth a place. */
static const double ON_NODE = 1e-6;

/* Adds the nodes around an image to the corners, by multilinear weights times its own. `distance`: their mean distances from the faces of `profile`. False: there are
 * none. */
static bool add_corners(Builder *b, const Bound *bound, const Image *image, const Profile *profile, int count, double distance[NORMALS_MAX])
{
    Walls *walls = b->walls;
    const int dimension = b->frame->grid->dimension;
    int64_t node[CORNERS_MAX];
    int low[3] = {0}, corners = 1 << dimension;
    double share[CORNERS_MAX], off[CORNERS_MAX][NORMALS_MAX], sum = 0.0, part[3] = {0};
    for (int a = 0; a < dimension; a++) {
        low[a] = (int)field_whole(image->way[a] + ON_NODE);
        part[a] = fmax(image->way[a] - low[a], 0.0);
    }
    if (part[0] <= ON_NODE && part[1] <= ON_NODE && part[2] <= ON_NODE) corners = 1; /* as at walls that lie on nodes */
    for (int k = 0; k < corners; k++) {
        int offset[3] = {0};
        double of_corner = 1.0;
        share[k] = 0.0;
        for (int a = 0; a < dimension; a++) {
            offset[a] = low[a] + (k >> a & 1);
            of_corner *= k >> a & 1 ? part[a] : 1.0 - part[a];
        }
        if (of_corner <= ON_NODE) continue;
        node[k] = grid_node_beside(b->frame->grid, bound->block, bound->local, offset);
        if (node[k] == GRID_NOWHERE) continue;
        const Bound *other = bound_at(b, node[k]);
        for (int j = 0; j < count; j++) {
            const double *n = profile[j].normal;
            off[k][j] = profile[j].distance + offset[0] * n[0] + offset[1] * n[1] + offset[2] * n[2];
        }
        if (other && wall_goes_on(b->frame, bound, other)) off[k][0] = other->face[0].distance;
        bool free = !(other && other->face[0].distance < WET_CLEAR);
        for (int j = 0; j < count; j++) free = free && off[k][j] >= WET_CLEAR;
        if (image->before && !free) continue;
        share[k] = of_corner;
        sum += of_corner;
    }
    if (sum < 1e-3) return false;
    if (!array_grow(b->memory, &walls->corner, (size_t)walls->corners + CORNERS_MAX, sizeof(WallCorner), (size_t)walls->corners * sizeof(WallCorner))) {
        b->failed = true;
        return false;
    }
    for (int j = 0; j < count; j++) distance[j] = 0.0;
    for (int k = 0; k < corners; k++) {
        if (share[k] == 0.0) continue;
        const double weight = share[k] / sum;
        for (int j = 0; j < count; j++) distance[j] += weight * off[k][j];
        ((WallCorner *)walls->corner.data)[walls->corners++] = (WallCorner){listed(b, node[k]), (float)(image->weight * weight)};
    }
    return true;
}

/* Mirrors a place in the faces of a set. */
static void mirror(const Profile *profile, int count, int set, double way[3])
{
    for (int k = 0; k < count; k++) {
        if (!(set >> k & 1)) continue;
        const double distance = profile[k].distance + dot3(way, profile[k].normal);
        for (int a = 0; a < 3; a++) way[a] -= 2.0 * distance * profile[k].normal[a];
    }
}

/* The weight of the image in a set of faces. */
static double share_of_set(const Profile *profile, int count, int set)
{
    double share = 1.0;
    for (int k = 0; k < count; k++) share *= set >> k & 1 ? profile[k].share : 1.0 - profile[k].share;
    return share;
}

/* The mean of p / rho around a node of the grid. */
static double pressure_at(const ContactFrame *frame, uint32_t node)
{
    const int cell = (int)(node % (uint32_t)frame->grid->block_cells);
    const FlowingSite site = {frame, (int32_t)(node / (uint32_t)frame->grid->block_cells), {cell & 3, cell >> 2 & 3, cell >> 4}};
    return frame->pressed ? flowing_pressure(&site) : 0.0;
}

/* The normal motion of a node of the grid against the wall that a profile stands for. */
static double motion_along(const Builder *b, uint32_t node, const Profile *profile)
{
    const float *u = (const float *)b->frame->grid->node.data + (size_t)node * K_NODE_WIDTH;
    double along = 0.0;
    for (int a = 0; a < 3; a++) along += ((double)u[a] - (double)profile->surface[a]) * profile->axis[a];
    return along;
}

/* A wall pushes and does not pull. What flows along it moves off in proportion to the distance, `scale` of the motion before it; what leaves moves as what is before it
 * does. Where the node is nearer to the second, it is the pressure p before the wall that keeps matter there. By Bernoulli's law that turns what leaves no faster than
 * v^2 = 2 p / rho; a fall of one cell, the pressure that the grid does not see, counts as in clings(). Held, a sheet that slides over an edge, before whose other face
 * nothing is, would lose half of its speed there and creep round it. Let go, a box full of vortices, which has no pressures at first, would lose a third of its energy. */
static bool leaves(const Builder *b, const Bound *bound, uint32_t corner_begin, const Profile *profile, double scale)
{
    const WallNode *list = b->walls->node.data;
    const WallCorner *corner = b->walls->corner.data;
    double before = 0.0, pressure = 0.0;
    for (uint32_t k = corner_begin; k < b->walls->corners; k++) before += (double)corner[k].weight * motion_along(b, list[corner[k].parent].node, profile);
    const double beyond = motion_along(b, bound->node, profile) - scale * before;
    if (beyond <= 0.5 * (1.0 - scale) * before || beyond <= 0.0 || beyond * beyond <= 2.0 * b->frame->fall) return false;
    for (uint32_t k = corner_begin; k < b->walls->corners; k++) pressure += (double)corner[k].weight * pressure_at(b->frame, list[corner[k].parent].node);
    return beyond * beyond > 2.0 * (pressure + b->frame->fall);
}

/* The way to a place that is clear of the faces, by whole cells along their normals. In acute edges a way out of one leads to the other. */
static void way_out(const Profile *profile, int count, double way[3])
{
    for (int k = 0; k < count * count; k++) {
        const Profile *p = &profile[k % count];
        const double distance = p->distance + dot3(way, p->normal);
        for (int a = 0; a < 3 && distance < WET_CLEAR; a++) way[a] -= field_whole(distance - 0.5 + ON_NODE) * p->normal[a];
    }
}

/* The node follows the wall with the part `share` of its motion, which is more where that is a rigid body's. Returns the number of the grip, or NO_GRIP. */
static uint32_t add_grip(Builder *b, uint32_t index, const Profile *profile, const float share[6])
{
    if (!profile->owner->body) return NO_GRIP;
    const WallFoot at = {profile->owner, index, profile->foot, share};
    float moved[3];
    if (!wall_bodies_grip(b->walls, b->frame, b->memory, &at, moved)) {
        b->failed = true;
        return NO_GRIP;
    }
    for (int a = 0; a < 3; a++) ((WallNode *)b->walls->node.data)[index].shift[a] += moved[a];
    return b->walls->grips - 1;
}

static uint32_t add_grip_along(Builder *b, uint32_t index, const Profile *profile, double scale)
{
    float share[6] = {0};
    lump_add_product(share, scale, profile->axis);
    return add_grip(b, index, profile, share);
}

static void add_grip_whole(Builder *b, uint32_t index, const Profile *profile, double scale)
{
    const float s = (float)scale, share[6] = {s, 0.0f, 0.0f, s, 0.0f, b->frame->grid->dimension == 3 ? s : 0.0f};
    add_grip(b, index, profile, share);
}

/* B of wall_shear.h, for the entry that is made next. A factor greater than 1 is that of a node more than a cell behind a wall, where hardly any matter reaches. */
static void hold_viscous(Builder *b, const Profile *profile, int count, const double *scale, bool sticks)
{
    double factor[NORMALS_MAX], all = 1.0;
    float kept[6] = {0};
    int by = NORMALS_MAX;
    for (int j = count - 1; j >= 0; j--) {
        const bool holds = !sticks && !profile[j].owner->body && profile[j].owner->friction != PBMPM_FRICTION_SLIP;
        factor[j] = holds ? fmax(scale[j], -1.0) : 1.0;
        all *= factor[j];
        if (holds) by = j;
    }
    kept[0] = kept[3] = kept[5] = (float)all;
    for (int j = 0; j < count; j++) {
        double others = 1.0;
        for (int k = 0; k < count; k++) others *= k != j ? factor[k] : 1.0;
        lump_add_product(kept, others - all, profile[j].axis);
    }
    WallShear *shear = (WallShear *)b->walls->shear.data + b->walls->shears++;
    *shear = (WallShear){.kept = symmetric_columns(kept), .face = by};
    for (int a = 0; a < 3 && by < NORMALS_MAX; a++) shear->surface[a] = profile[by].surface[a];
}

/* What face `j` does to a node that solids reach, from what all faces up to it add to its shift. */
static void set_face(WallUnilateral *u, const WallNode *node, int j, double scale, uint32_t grip)
{
    double along = 0.0;
    for (int a = 0; a < 3; a++) along += (double)node->shift[a] * (double)node->normal[j][a];
    u->held = (1u << (j + 1)) - 1u;
    u->grip[j] = grip;
    u->scale[j] = (float)scale;
    u->surface[j] = scale == 1.0 ? 0.0f : (float)(along / (1.0 - scale));
}

/* Whether a node is near solids, see ContactFrame.slips: they reach it or one that it follows. At rigid bodies none is. */
static bool may_slip(const Builder *b, const Bound *bound, const Profile *profile, int count, uint32_t corner_begin)
{
    const WallNode *list = b->walls->node.data;
    const WallCorner *corner = b->walls->corner.data;
    bool near = reach_solid(b->frame, bound->node), rigid = false;
    for (uint32_t k = corner_begin; k < b->walls->corners; k++) near = near || reach_solid(b->frame, list[corner[k].parent].node);
    for (int j = 0; j < count; j++) rigid = rigid || profile[j].owner->body;
    return b->frame->slips && near && !rigid;
}

/* The motion of a node closer than half a cell to faces: of nodes before them, along each of these normals in proportion to the distance; `sticks`: so all of it. */
static void add_motion(Builder *b, const Bound *bound, uint32_t index, const Profile *profile, int count, bool sticks, const float rest[6])
{
    Image image = {.weight = 1.0, .before = true};
    double distance[NORMALS_MAX], scale[NORMALS_MAX];
    const uint32_t corner_begin = b->walls->corners;
    way_out(profile, count, image.way);
    const bool found = add_corners(b, bound, &image, profile, count, distance), slips = found && !sticks && may_slip(b, bound, profile, count, corner_begin);
    const bool unilateral = found && !sticks && (slips || reach_solid(b->frame, bound->node));
    WallNode *node = (WallNode *)b->walls->node.data + index; /* the list may have moved */
    float matrix[6] = {0};
    node->slips = slips;
    memcpy(slips ? node->own : matrix, rest, sizeof matrix);
    for (int j = 0; j < count; j++) {
        double along = 0.0;
        scale[j] = profile[j].distance >= WET_CLEAR ? 1.0 : found ? profile[j].distance / distance[j] : 0.0;
        if (found && !unilateral && leaves(b, bound, corner_begin, &profile[j], scale[j])) scale[j] = 1.0;
        lump_add_product(matrix, scale[j], profile[j].axis);
        for (int a = 0; a < 3; a++) along += (double)profile[j].surface[a] * profile[j].axis[a];
        for (int a = 0; a < 3; a++) node->shift[a] += (float)((1.0 - scale[j]) * along * profile[j].axis[a]);
        if (!found && profile[j].distance >= WET_CLEAR) lump_add_product(node->own, 1.0, profile[j].axis);
    }
    for (int k = 0; k < 6 && !found; k++) node->own[k] += rest[k];
    if (sticks) {
        for (int k = 0; k < 6; k++) matrix[k] = (float)scale[0] * ALL[k];
        for (int a = 0; a < 3; a++) node->shift[a] = (float)(1.0 - scale[0]) * profile[0].surface[a];
        memset(node->own, 0, sizeof node->own);
    }
    if (sticks) add_grip_whole(b, index, &profile[0], 1.0 - scale[0]);
    for (int j = 0; j < count && !sticks; j++) {
        const uint32_t grip = add_grip_along(b, index, &profile[j], 1.0 - scale[j]);
        if (unilateral) set_face(&((WallUnilateral *)b->walls->unilateral.data)[b->walls->unilaterals], node, j, scale[j], grip);
    }
    if (unilateral) ((WallUnilateral *)b->walls->unilateral.data)[b->walls->unilaterals++].follower = index;
    node->unilateral = unilateral ? UNILATERAL : 0;
    if (!found) return;
    if (b->frame->viscous) hold_viscous(b, profile, count, scale, sticks);
    node->entry = b->walls->entries++;
    ((WallEntry *)b->walls->entry.data)[node->entry] = (WallEntry){symmetric_columns(matrix), index, corner_begin, b->walls->corners};
}

/* The density is mirrored in each face by its share. */
static void add_mirrors(Builder *b, const Bound *bound, uint32_t index, const Profile *profile, int count)
{
    Walls *walls = b->walls;
    double unused[NORMALS_MAX];
    for (int set = 0; set < 1 << count; set++) {
        Image image = {.weight = share_of_set(profile, count, set)};
        if (image.weight < ON_NODE) continue;
        const uint32_t corner_begin = walls->corners;
        mirror(profile, count, set, image.way);
        if (set == 0 || !add_corners(b, bound, &image, profile, count, unused)) {
            ((WallNode *)walls->node.data)[index].own_mirror += (float)image.weight;
            continue;
        }
        ((WallMirror *)walls->mirror.data)[walls->mirrors++] = (WallMirror){index, corner_begin, walls->corners};
    }
}

static void add_follower(Builder *b, uint32_t index)
{
    Walls *walls = b->walls;
    const Bound *bound = b->bound[index];
    Profile profile[NORMALS_MAX];
    int count = profiles_of(b, bound, profile);
    const Obstacle *owner = profile[0].owner;
    const bool sticks = owner->friction == PBMPM_FRICTION_STICK;
    if (sticks) count = 1;
    WallNode *node = (WallNode *)walls->node.data + index;
    node->own_mirror = 0.0f;
    node->follows = bound->both;
    node->open = bound->open;
    const bool weighs = !bound->both && !sticks && count == 1; /* see walls_weigh() */
    if (weighs) node->behind = (float)(profile[0].rounded * field_spline(bound->face[0].distance));
    if (!bound->both && profile[0].bend != 0.0) node->open = (float)field_spline_below(profile[0].distance + 2.0 * profile[0].bend);
    node->normals = (uint16_t)count;
    node->coefficient = owner->friction == PBMPM_FRICTION_COULOMB && reach_solid(b->frame, node->node) ? owner->coefficient : 0.0f;
    memcpy(node->surface, profile[0].surface, sizeof node->surface);
    walls->rubs = walls->rubs || node->coefficient > 0.0f;
    float rest[6] = {1.0f, 0.0f, 0.0f, 1.0f, 0.0f, b->frame->grid->dimension == 3 ? 1.0f : 0.0f};
    for (int j = 0; j < count; j++) {
        for (int a = 0; a < 3; a++) node->normal[j][a] = (float)profile[j].axis[a];
        node->obstacle[j] = (uint16_t)(profile[j].owner - b->frame->colliders->obstacle);
        node->follows = node->follows || profile[j].distance < WET_CLEAR;
        lump_add_product(rest, -1.0, profile[j].axis);
    }
    if (count == b->frame->grid->dimension) memset(rest, 0, sizeof rest); /* else rounding would be left */
    node->mirror_begin = node->mirror_end = walls->mirrors;
    if (node->follows) memset(node->own, 0, sizeof node->own);
    if (bound->both) { /* along the wall it is free */
        double along = 0.0;
        for (int a = 0; a < 3; a++) along += (double)profile[0].surface[a] * profile[0].axis[a];
        for (int a = 0; a < 3; a++) node->shift[a] = sticks ? profile[0].surface[a] : (float)(along * profile[0].axis[a]);
        if (!sticks) memcpy(node->own, rest, sizeof rest);
        if (sticks) add_grip_whole(b, index, &profile[0], 1.0);
        else add_grip_along(b, index, &profile[0], 1.0);
        node->own_mirror = 1.0f;
        return;
    }
    if (node->follows) add_motion(b, bound, index, profile, count, sticks, rest);
    add_mirrors(b, bound, index, profile, count);
    ((WallNode *)walls->node.data)[index].mirror_end = walls->mirrors; /* the list may have moved */
}

/* ---- Finding them ---- */

typedef struct FindJob {
    Walls *walls;
    const ContactFrame *frame;
    float reach; /* [cells] from walls, of nodes that may be at them */
} FindJob;

/* A cell; but matter beyond a thin wall reaches nodes farther before it: the spline ends NODE_REACH along each axis. */
static float reach_of_walls(const ContactFrame *frame)
{
    double thinnest = INFINITY;
    for (int i = 0; i < frame->colliders->obstacle_count; i++) thinnest = fmin(thinnest, obstacle_breadth(&frame->colliders->obstacle[i]));
    return (float)fmax(1.0, NODE_REACH * sqrt((double)frame->grid->dimension) - thinnest / frame->cell_size);
}

static void look_near_block(const ContactFrame *frame, int32_t block, Near *near)
{
    double centre[3];
    contacts_block_centre(frame, block, centre);
    field_near(near, frame, centre, 0.5 * (K_BLOCK_AXIS - 1) * sqrt((double)frame->grid->dimension) + OBSTACLE_CACHE_REACH, false);
}

static bool is_held(const ContactFrame *frame, int32_t block, int node) { return frame->held && frame->held[block] >> node & 1; }

/* Which nodes are at walls, as bits. */
static void mark_blocks(void *context, int32_t begin, int32_t end)
{
    const FindJob *job = context;
    uint64_t *marks = job->walls->marked.data;
    const Grid *grid = job->frame->grid;
    for (int32_t block = begin; block < end; block++) {
        marks[block] = 0;
        for (int node = 0; node < grid->block_cells; node++)
            if (job->frame->gap[(size_t)block * (size_t)grid->block_cells + (size_t)node] < job->reach && !is_held(job->frame, block, node))
                marks[block] |= (uint64_t)1 << node;
    }
}

/* Per node who follows it: first those whose motion does, then those whose density does. */
static bool add_links(Walls *walls, Memory *memory)
{
    WallNode *node = walls->node.data;
    const WallEntry *entry = walls->entry.data;
    const WallMirror *mirror = walls->mirror.data;
    const WallCorner *corner = walls->corner.data;
    uint32_t links = 0;
    if (!array_reserve(memory, &walls->link, walls->corners, sizeof(WallLink))) return false;
    WallLink *link = walls->link.data;
    for (uint32_t i = 0; i < walls->nodes; i++) node[i].link_moving = node[i].link_end = 0;
    for (uint32_t e = 0; e < walls->entries; e++)
        for (uint32_t k = entry[e].corner_begin; k < entry[e].corner_end; k++) node[corner[k].parent].link_moving++;
    for (uint32_t e = 0; e < walls->mirrors; e++)
        for (uint32_t k = mirror[e].corner_begin; k < mirror[e].corner_end; k++) node[corner[k].parent].link_end++;
    for (uint32_t i = 0; i < walls->nodes; i++) { /* ends become places to fill from */
        const uint32_t moving = node[i].link_moving, mirrored = node[i].link_end;
        node[i].link_begin = node[i].link_moving = links;
        node[i].link_end = links + moving;
        links += moving + mirrored;
    }
    for (uint32_t e = 0; e < walls->entries; e++)
        for (uint32_t k = entry[e].corner_begin; k < entry[e].corner_end; k++) link[node[corner[k].parent].link_moving++] = (WallLink){e, corner[k].weight};
    for (uint32_t e = 0; e < walls->mirrors; e++)
        for (uint32_t k = mirror[e].corner_begin; k < mirror[e].corner_end; k++)
            link[node[corner[k].parent].link_end++] = (WallLink){mirror[e].follower, corner[k].weight};
    return true;
}

/* Nodes that are only followed rub at the wall of the first one that follows them. */
static void give_friction(Walls *walls)
{
    WallNode *node = walls->node.data;
    const WallEntry *entry = walls->entry.data;
    const WallLink *link = walls->link.data;
    for (uint32_t i = 0; i < walls->nodes; i++) {
        if (node[i].normals > 0 || node[i].link_begin == node[i].link_end) continue;
        const bool moving = node[i].link_moving > node[i].link_begin;
        const WallNode *from = &node[moving ? entry[link[node[i].link_begin].from].follower : link[node[i].link_moving].from];
        node[i].normals = 1;
        node[i].obstacle[0] = from->obstacle[0];
        node[i].coefficient = from->coefficient;
        memcpy(node[i].surface, from->surface, sizeof from->surface);
        memcpy(node[i].normal[0], from->normal[0], sizeof from->normal[0]);
    }
}

static WallOwn kind_of_own(const float own[6], int dimension)
{
    static const float none[6] = {0};
    const int depth = dimension == 3 ? 6 : 5; /* a plane has no motion along the third axis */
    if (memcmp(own, none, (size_t)depth * sizeof *own) == 0) return OWN_NONE;
    return memcmp(own, ALL, (size_t)depth * sizeof *own) == 0 ? OWN_ALL : OWN_PART;
}

/* Lists what the loops of walls_apply() need of node `i`. */
static void list_motion(Walls *walls, uint32_t i, int dimension)
{
    const WallNode *node = (const WallNode *)walls->node.data + i;
    const WallOwn own = node->unilateral ? OWN_PART : kind_of_own(node->own, dimension);
    const Four shift = {node->shift[0], node->shift[1], node->shift[2]};
    ((WallMotion *)walls->motion.data)[i] = (WallMotion){node->node, node->entry, node->mass, own, shift};
    if (node->follows) ((uint32_t *)walls->moved.data)[walls->moves++] = i;
    if (own == OWN_NONE && node->link_begin == node->link_moving) return;
    ((WallFree *)walls->free.data)[walls->frees++] =
        (WallFree){walls_inverse(node->lump), i, node->link_begin, node->link_moving, walls->unilaterals > 0 && unilateral_beside(walls, node)};
}

static void list_motions(Walls *walls, int dimension)
{
    for (uint32_t i = 0; i < walls->nodes; i++) {
        walls_lump(walls, i, dimension);
        list_motion(walls, i, dimension);
    }
}

typedef struct BindJob {
    const ContactFrame *frame;
    const uint64_t *marks;
    const uint32_t *begin; /* per block the first of its places */
    Bound *bound;
} BindJob;

static int count_bits(uint64_t bits)
{
    int count = 0;
    for (; bits; bits &= bits - 1) count++;
    return count;
}

/* What was found of a node in the last substep, if it holds: what thin walls do hangs on matter. */
static const Bound *bound_before(const ContactFrame *frame, int32_t block, int node)
{
    const ObstacleCache *cache = frame->cache;
    const int32_t from = obstacle_cache_from(frame, block);
    if (from == GRID_NOWHERE || !cache->walled) return NULL;
    const uint64_t marks = ((const uint64_t *)cache->marked.data)[from], bit = (uint64_t)1 << node;
    if (!(marks & bit)) return NULL;
    const Bound *bound = (const Bound *)cache->bound.data + ((const uint32_t *)cache->begin.data)[from] + count_bits(marks & (bit - 1));
    return bound->thin ? NULL : bound;
}

static WetSite site_of(const ContactFrame *frame, const Bound *bound)
{
    WetSite site = {.frame = frame, .block = bound->block, .mass = mass_of(frame->grid, bound->node)};
    memcpy(site.local, bound->local, sizeof site.local);
    return site;
}

/* Else its matter sees other faces, see wet_side.c. */
static bool stays_wet(const ContactFrame *frame, const Bound *bound)
{
    const WetSite site = site_of(frame, bound);
    return bound->faces == 0 || !wet_is_dry(&site, &bound->face[0]);
}

static void bind_node(const ContactFrame *frame, const Near *near, Bound *bound, int node)
{
    Near some;
    const Near *meeting = field_meeting(near, contacts_node_groups(frame, bound->node), &some);
    WetSite site = site_of(frame, bound);
    site.near = meeting;
    contacts_node_position(frame, bound->block, node, site.point);
    bound->faces = wet_faces(&site, PARENTS_REACH, bound->face, &bound->thin, &bound->both);
    if (bound->faces > 0 && bound->face[0].distance >= 1.0) bound->faces = 0;
    if (bound->faces > 0 && !bound->both) bound->open = (float)field_open_share(meeting, site.point, NODE_REACH, bound->face, bound->faces, bound->thin);
}

static void bind_blocks(void *context, int32_t first, int32_t end)
{
    const BindJob *job = context;
    const ContactFrame *frame = job->frame;
    Near near;
    for (int32_t block = first; block < end; block++) {
        if (job->marks[block] == 0) continue;
        Bound *bound = job->bound + job->begin[block];
        bool looked = false;
        for (int i = 0; i < frame->grid->block_cells; i++) {
            if (!(job->marks[block] >> i & 1)) continue;
            const Bound *before = bound_before(frame, block, i);
            const uint32_t node = (uint32_t)(block * frame->grid->block_cells + i);
            const Bound fresh = {.node = node, .block = block, .local = {i & 3, i >> 2 & 3, i >> 4}, .open = -1.0f};
            *bound = before ? *before : fresh;
            bound->node = node;
            bound->block = block;
            if (!before || !stays_wet(frame, bound)) {
                if (!looked) look_near_block(frame, block, &near);
                looked = true;
                *bound = fresh;
                bind_node(frame, &near, bound, i);
            }
            bound++;
        }
    }
}

/* In the joint solver solids push rigid bodies by contacts alone: what the dual let those yield to is not what the primal then asks for. A box made a raft below it rock. */
static bool has_contacts(const ContactFrame *frame, const Bound *bound)
{
    bool rigid = false;
    for (int k = 0; k < bound->faces; k++) rigid = rigid || (bound->face[k].distance < 1.0 && bound->face[k].obstacle->body);
    return frame->slips && rigid && reach_solid(frame, bound->node);
}

/* Finds the nodes at walls. Returns how many there are. */
static bool bind_nodes(Builder *b, Pool *pool)
{
    Walls *walls = b->walls;
    const Grid *grid = b->frame->grid;
    const size_t blocks = (size_t)grid->node_blocks;
    FindJob job = {walls, b->frame, reach_of_walls(b->frame)};
    if (!array_reserve(b->memory, &walls->marked, blocks, sizeof(uint64_t)) || !array_reserve(b->memory, &walls->begin, blocks, sizeof(uint32_t))) return false;
    const uint64_t *marks = walls->marked.data;
    uint32_t *begin = walls->begin.data, count = 0;
    pool_for(pool, grid->node_blocks, 16, mark_blocks, &job);
    for (size_t block = 0; block < blocks; block++) {
        begin[block] = count;
        count += (uint32_t)count_bits(marks[block]);
    }
    if (!array_reserve(b->memory, &walls->bound, count, sizeof(Bound)) || !array_reserve(b->memory, &walls->scratch, count, sizeof(Bound *))) return false;
    Bound *bound = walls->bound.data;
    const Bound **faced = walls->scratch.data;
    BindJob bind = {b->frame, marks, begin, bound};
    pool_for(pool, grid->node_blocks, 4, bind_blocks, &bind);
    b->bound = faced;
    for (uint32_t i = 0; i < count; i++)
        if (bound[i].faces > 0 && !has_contacts(b->frame, &bound[i])) faced[b->bounds++] = &bound[i];
    /* How many they follow hangs on how matter moves: here is room for more than walls anywhere took (1.6 nodes and 6.4 corners each), so that a warm step takes no memory. */
    if (!array_reserve(b->memory, &walls->node, 2 * (size_t)b->bounds, sizeof(WallNode))) return false;
    if (!array_reserve(b->memory, &walls->corner, CORNERS_MAX * (size_t)b->bounds, sizeof(WallCorner))) return false;
    for (uint32_t i = 0; i < b->bounds; i++) listed(b, faced[i]->node);
    return !b->failed;
}

/* A node has one entry, and a mirror image for each set of its faces but the empty one. */
static bool reserve_lists(Walls *walls, uint32_t bounds, int dimension, bool viscous, Memory *memory)
{
    const size_t images = ((size_t)1 << dimension) - 1;
    if (!array_reserve(memory, &walls->unilateral, bounds, sizeof(WallUnilateral))) return false;
    if (viscous && !array_reserve(memory, &walls->shear, bounds, sizeof(WallShear))) return false;
    return array_reserve(memory, &walls->entry, bounds, sizeof(WallEntry)) && array_reserve(memory, &walls->mirror, images * bounds, sizeof(WallMirror));
}

pbmpm_result walls_find(Walls *walls, const ContactFrame *frame, Memory *memory, Pool *pool)
{
    const Grid *grid = frame->grid;
    const size_t nodes = (size_t)grid->node_blocks * (size_t)grid->block_cells;
    Builder builder = {.walls = walls, .memory = memory, .frame = frame};
    walls_clear(walls);
    if (frame->colliders->obstacle_count == 0) return PBMPM_OK;
    bool ok = array_reserve(memory, &walls->place, nodes, sizeof(uint32_t));
    if (ok) {
        if (grid->node_blocks > 0) memset(walls->place.data, 0, nodes * sizeof(uint32_t));
        ok = wall_bodies_list(walls, frame, memory) && bind_nodes(&builder, pool) && reserve_lists(walls, builder.bounds, grid->dimension, frame->viscous, memory);
        for (uint32_t i = 0; i < builder.bounds && ok && !builder.failed; i++) add_follower(&builder, i);
        ok = ok && !builder.failed && add_links(walls, memory) &&
             array_reserve(memory, &walls->motion, walls->nodes, sizeof(WallMotion)) &&
             array_reserve(memory, &walls->free, walls->nodes, sizeof(WallFree)) && array_reserve(memory, &walls->moved, walls->nodes, sizeof(uint32_t)) &&
             array_reserve(memory, &walls->vector, (WALL_VECTORS + (walls->bodies > 0)) * (size_t)walls->nodes + walls->entries, sizeof(Four));
    }
    if (!ok) {
        walls_clear(walls);
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the nodes at walls of %d blocks", grid->node_blocks);
    }
    if (walls->nodes > 0) memset(walls->vector.data, 0, WALL_VECTORS * (size_t)walls->nodes * sizeof(Four)); /* who is not free has no u~ */
    give_friction(walls);
    list_motions(walls, grid->dimension);
    if (walls->grips > 0) unilateral_begin(walls, frame, pool);
    if (!wall_bodies_bind(walls, frame, memory)) {
        walls_clear(walls);
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for %u rigid bodies", walls->bodies);
    }
    return PBMPM_OK;
}
