#include "contact/contacts_find.h"

#include <math.h>
#include <string.h>

#include "base/assertion.h"
#include "base/result.h"
#include "base/vector.h"
#include "contact/field.h"
#include "contact/obstacle_cache.h"
#include "contact/reach.h"
#include "contact/walls.h"
#include "contact/wet_side.h"
#include "shape/tangent_planes.h"

/* Colliders, walls, and what holds nodes. */
enum { OBSTACLES = PBMPM_MAX_COLLIDERS + DOMAIN_WALLS + 1 };

typedef struct FindJob {
    const ContactFrame *frame;
    bool write; /* first pass counts, second writes */
} FindJob;

/* What the iterations may add to the way of a node [cells]. Nodes that walls leave free stand half a cell before them, and those behind follow: iterations do not add
 * to that. By trial. */
static const double WAY_MARGIN = 1.0, WAY_MARGIN_AT_WALLS = 0.25;

/* How close [cells] a node must be to an obstacle to be able to meet it: what it may move, what the obstacle moves, and
 * the margin. */
static double reach_of(const ContactFrame *frame, const Obstacle *o, int32_t block, const double centre[3])
{
    float surface[3];
    obstacle_motion(o, centre, frame->cell_size, frame->max_displacement, surface);
    double motion = 0.0;
    for (int a = 0; a < 3; a++) motion += fabs((double)surface[a]);
    const double node = ((const float *)frame->grid->node_reach.data)[block] * sqrt((double)frame->grid->dimension);
    return fmin(node, frame->max_displacement) + motion + (frame->walls ? WAY_MARGIN_AT_WALLS : WAY_MARGIN);
}

static Contact contact_at(const ContactFrame *frame, const Obstacle *o, const double point[3], int node, double distance,
                          const double normal[3])
{
    Contact contact = {.node = (uint16_t)node, .friction = o->friction, .coefficient = o->coefficient};
    contact.obstacle = (uint16_t)(o - frame->colliders->obstacle);
    contact.gap = distance > 0.0 ? (float)distance : 0.0f;
    for (int a = 0; a < 3; a++) contact.normal[a] = (float)normal[a];
    obstacle_motion(o, point, frame->cell_size, frame->max_displacement, contact.surface);
    return contact;
}

/* The way of a node, as predicted, as an obstacle sees it [cells]. */
static void way_past(const ContactFrame *frame, const Obstacle *o, const float *u, const double point[3], double way[3])
{
    float surface[3];
    obstacle_motion(o, point, frame->cell_size, frame->max_displacement, surface);
    for (int a = 0; a < 3; a++) way[a] = (double)u[a] - (double)surface[a];
}

/* Whether the way of a node passes the obstacle at more than the margin: then it needs no contact, which would brake it although nothing is in its way. If the
 * solid is convex, the distance along the way is a convex function, and lies above its tangents at both ends. */
static bool way_passes(const ContactFrame *frame, const Obstacle *o, const float *u, const double point[3], double distance,
                       const double normal[3])
{
    double way[3], end[3] = {0}, end_normal[3];
    Plane unused;
    if (distance <= WAY_MARGIN) return false;
    way_past(frame, o, u, point, way);
    if (o->start.grid) return !plane_on_way(&o->start, frame->cell_size, &(Way){.point = point, .way = way}, WAY_MARGIN, &unused);
    for (int a = 0; a < frame->grid->dimension; a++) end[a] = point[a] + way[a] * frame->cell_size;
    const double end_distance = solid_distance(&o->start, end, end_normal) / frame->cell_size;
    const double leaving = dot3(way, normal), arriving = dot3(way, end_normal);
    if (end_distance <= WAY_MARGIN) return false;
    if (leaving >= 0.0 || arriving <= 0.0) return true; /* nearest at one of the ends */
    const double crossing = (end_distance - arriving - distance) / (leaving - arriving);
    return distance + crossing * leaving > WAY_MARGIN;
}

/* The contact that a baked obstacle gives a node whose way is longer than NODE_REACH, beside the planes around it: with what it meets there, the far wall of a hollow. */
static uint32_t contact_ahead(const ContactFrame *frame, const Obstacle *o, const float *u, int node, const Way *known, Contact *out)
{
    Way way = *known;
    Plane plane;
    double past[3];
    way_past(frame, o, u, way.point, past);
    way.way = past;
    if (dot3(past, past) <= NODE_REACH * NODE_REACH || !plane_on_way(&o->start, frame->cell_size, &way, WAY_MARGIN, &plane)) return 0;
    if (out) *out = contact_at(frame, o, way.point, node, plane.gap, plane.normal);
    return 1;
}

/* How deep [cells] in an obstacle a node is more than on its surface. */
static const double INSIDE = 1e-3;

/* The obstacles around a block, and how close to each a node must be; `most`: to any. */
typedef struct Around {
    Near near;
    double reach[OBSTACLES], most;
} Around;

/* Those that act on what is at a node of the grid: `around` itself if all do, else `some`. */
static const Around *around_node(const ContactFrame *frame, const Around *around, size_t node, Around *some)
{
    const uint32_t groups = contacts_node_groups(frame, node);
    if (field_meeting(&around->near, groups, &some->near) == &around->near) return around;
    int kept = 0;
    some->most = 0.0;
    for (int k = 0; k < around->near.count; k++) {
        if (!obstacle_meets(around->near.obstacle[k], groups)) continue;
        some->most = fmax(some->most, around->reach[k]);
        some->reach[kept++] = around->reach[k];
    }
    return some;
}

/* Contacts of a node that is deeper inside than its spline reaches, or where obstacles have closed on matter: with that whose surface is nearest, or where liquid stays
 * between them with each that it is in. */
static uint32_t contacts_deep_inside(const ContactFrame *frame, const Around *around, const double point[3], int node, Contact *out)
{
    Face face;
    uint32_t count = 0;
    if (!frame->stays) {
        if (!field_surface(&around->near, point, &face)) return 0;
        if (out) out[0] = contact_at(frame, face.obstacle, point, node, face.distance, face.normal);
        return 1;
    }
    for (int k = 0; k < around->near.count; k++) {
        const Obstacle *o = around->near.obstacle[k];
        double normal[3];
        const double distance = solid_distance(&o->start, point, normal) / frame->cell_size;
        if (distance > 0.0) continue;
        if (out) out[count] = contact_at(frame, o, point, node, distance, normal);
        count++;
    }
    return count;
}

/* Contacts of a node with the planes around it. In a box near its outer edge the other faces of the edge hold it, too: were it held by one alone, what presses on the
 * other would push past it, and a floating box would lie too deep in the water. */
static uint32_t contacts_with_faces(const ContactFrame *frame, const Around *around, const float *u, const double point[3], int32_t block, int node, Contact *out)
{
    Face face[FIELD_FACES];
    WetSite site = {frame, &around->near, block, {node & 3, node >> 2 & 3, node >> 4}, {point[0], point[1], point[2]}, u[3]};
    uint32_t count = 0;
    bool thin, both;
    int faces = wet_faces(&site, around->most, face, &thin, &both);
    if (faces == 0) count = contacts_deep_inside(frame, around, point, node, out);
    if (both)
        faces = 2;
    else if (faces > 0 && face[0].distance < -INSIDE) faces = field_outer_faces(&around->near, point, NODE_REACH, face, faces);
    bool meets[FIELD_FACES] = {false};
    for (int i = 0; i < faces; i++) {
        const Obstacle *o = face[i].obstacle;
        int k = 0;
        while (around->near.obstacle[k] != o) k++;
        const double reach = o->start.grid ? fmin(around->reach[k], NODE_REACH) : around->reach[k]; /* farther off the normal of a grid is not exact enough: see contact_ahead() */
        meets[i] = face[i].distance <= reach && !way_passes(frame, o, u, point, face[i].distance, face[i].normal);
        if (meets[i] && out) out[count] = contact_at(frame, o, point, node, face[i].distance, face[i].normal);
        count += meets[i];
    }
    for (int k = 0; k < around->near.count; k++) {
        const Obstacle *o = around->near.obstacle[k];
        Plane known[FIELD_FACES];
        Way way = {.point = point, .known = known};
        if (!o->start.grid) continue;
        for (int i = 0; i < faces; i++)
            if (meets[i] && face[i].obstacle == o) known[way.count++] = (Plane){.normal = {face[i].normal[0], face[i].normal[1], face[i].normal[2]}, .gap = face[i].distance};
        count += contact_ahead(frame, o, u, node, &way, out ? out + count : NULL);
    }
    return count;
}

/* Whether a node is led by walls: it stays where it was taken, or follows; see joint.h. A node before them that a solid reaches has contacts as elsewhere. */
static bool is_led(const ContactFrame *frame, uint32_t at)
{
    if (!walls_list(frame->leaders, at)) return false;
    return !reach_solid(frame, at) || walls_follows(frame->leaders, at);
}

/* Whether solids reach it, or a node that it follows: then it goes where that leads it. */
static bool follows_solid(const ContactFrame *frame, uint32_t at)
{
    uint32_t parent[CORNERS_MAX];
    float weight[CORNERS_MAX];
    Columns matrix;
    bool follows = reach_solid(frame, at);
    for (int k = walls_parents(frame->leaders, at, parent, weight, &matrix) - 1; k >= 0; k--) follows = follows || reach_solid(frame, parent[k]);
    return follows;
}

/* In an edge each wall but the nearest books what it gives along its own normal, the nearest the rest. */
static uint32_t contacts_that_stay(const ContactFrame *frame, int32_t block, int node, Contact *out)
{
    uint16_t obstacle[3] = {(uint16_t)frame->colliders->obstacle_count};
    const float *normal[3];
    const uint32_t at = (uint32_t)(block * frame->grid->block_cells + node);
    const int faces = walls_faces(frame->leaders, at, obstacle, normal);
    uint32_t count = 0;
    for (int k = faces - 1; k > 0; k--, count++)
        if (out) {
            out[count] = (Contact){.node = (uint16_t)node, .obstacle = obstacle[k], .friction = PBMPM_FRICTION_SLIP, .stays = true};
            memcpy(out[count].normal, normal[k], sizeof out[count].normal);
        }
    if (out) {
        out[count] = (Contact){.node = (uint16_t)node, .obstacle = obstacle[0], .friction = PBMPM_FRICTION_STICK, .stays = true, .follows = follows_solid(frame, at)};
        walls_motion(frame->leaders, at, out[count].wall);
    }
    return count + 1;
}

/* A node near solids: a contact per face. The surface of those that hold it is where the nodes before it lead it. */
static uint32_t contacts_that_follow(const ContactFrame *frame, const double point[3], int node, uint32_t at, Contact *out)
{
    uint16_t obstacle[3];
    const float *normal[3];
    float scale[3];
    const int faces = walls_scales(frame->leaders, at, scale);
    walls_faces(frame->leaders, at, obstacle, normal);
    for (int k = 0; k < faces && out; k++) {
        const Obstacle *o = &frame->colliders->obstacle[obstacle[k]];
        const double along[3] = {(double)normal[k][0], (double)normal[k][1], (double)normal[k][2]};
        double unused[3];
        out[k] = contact_at(frame, o, point, node, scale[k] < 1.0f ? 0.0 : solid_distance(&o->start, point, unused) / frame->cell_size, along);
        out[k].follows = scale[k] < 1.0f;
        if (out[k].friction == PBMPM_FRICTION_STICK) out[k].friction = PBMPM_FRICTION_SLIP; /* only the nearest face may stick, see walls_find.c */
        if (!reach_solid(frame, at)) out[k].coefficient = 0.0f;
        memcpy(out[k].wall, out[k].surface, sizeof out[k].wall);
    }
    return (uint32_t)faces;
}

/* Contacts of one block's nodes; writes them if `out` is not null, and returns their number. */
static uint32_t contacts_of_block(const ContactFrame *frame, const Around *all, int32_t block, Contact *out)
{
    const Grid *grid = frame->grid;
    Around some;
    const float *node = (const float *)grid->node.data + (size_t)block * (size_t)grid->block_cells * K_NODE_WIDTH;
    uint32_t count = 0;
    for (int i = 0; i < grid->block_cells; i++) {
        const float *u = node + i * K_NODE_WIDTH;
        const uint32_t first = count;
        double point[3];
        if (u[3] == 0.0f || walls_hold(frame->walls, (uint32_t)(block * grid->block_cells + i))) continue; /* no mass, nobody listens */
        const size_t at = (size_t)block * (size_t)grid->block_cells + (size_t)i;
        if (is_led(frame, (uint32_t)at)) {
            float unused[3];
            contacts_node_position(frame, block, i, point);
            if (walls_scales(frame->leaders, (uint32_t)at, unused) > 0) count += contacts_that_follow(frame, point, i, (uint32_t)at, out ? out + count : NULL);
            else count += contacts_that_stay(frame, block, i, out ? out + count : NULL);
            continue;
        }
        const Around *around = around_node(frame, all, at, &some);
        if ((double)frame->gap[at] > around->most) continue;
        contacts_node_position(frame, block, i, point);
        count += contacts_with_faces(frame, around, u, point, block, i, out ? out + count : NULL);
        const bool walled = walls_list(frame->walls, (uint32_t)(block * grid->block_cells + i));
        const bool rubs = reach_solid(frame, (uint32_t)(block * grid->block_cells + i));
        for (uint32_t k = first; k < count && out; k++) {
            out[k].walled = walled;
            if (!rubs) out[k].coefficient = 0.0f;
        }
    }
    return count;
}

/* How far obstacles [cells] matter to a node in another one: those beside it, seen from its reflection. */
static const double BESIDE = 4.5;

static void look_around(const ContactFrame *frame, int32_t block, Around *around)
{
    const double half_diagonal = 1.5 * sqrt((double)frame->grid->dimension);
    double centre[3];
    const uint32_t groups = contacts_block_groups(frame, block);
    contacts_block_centre(frame, block, centre);
    around->most = 0.0;
    for (int i = 0; i < frame->colliders->obstacle_count; i++)
        if (obstacle_meets(&frame->colliders->obstacle[i], groups))
            around->most = fmax(around->most, reach_of(frame, &frame->colliders->obstacle[i], block, centre));
    field_near(&around->near, frame, centre, half_diagonal + fmax(around->most, BESIDE), false);
    field_keep(&around->near, groups);
    for (int i = 0; i < around->near.count; i++) around->reach[i] = reach_of(frame, around->near.obstacle[i], block, centre);
}

static bool is_grabbed(const ContactFrame *frame, int32_t block, int node)
{
    if (!frame->grabbed || !(frame->grabbed[block] >> node & 1)) return false;
    return !frame->gap || frame->gap[(size_t)block * (size_t)frame->grid->block_cells + (size_t)node] >= 1.0f;
}

/* Nodes that are held stick to an obstacle that is nowhere: those that sleep stay, those that are grabbed go where the predictor put them. At obstacles, these come
 * first. */
static uint32_t contacts_of_held(const ContactFrame *frame, int32_t block, Contact *out)
{
    const Grid *grid = frame->grid;
    const float *node = (const float *)grid->node.data + (size_t)block * (size_t)grid->block_cells * K_NODE_WIDTH;
    uint32_t count = 0;
    for (int i = 0; i < grid->block_cells; i++) {
        const float *u = node + i * K_NODE_WIDTH;
        const bool sleeps = frame->held && frame->held[block] >> i & 1;
        const bool grabbed = !sleeps && is_grabbed(frame, block, i);
        if (!(sleeps || grabbed) || u[3] == 0.0f) continue;
        if (out) {
            out[count] = (Contact){.node = (uint16_t)i, .obstacle = (uint16_t)frame->colliders->obstacle_count, .friction = PBMPM_FRICTION_STICK};
            for (int a = 0; a < 3 && grabbed; a++) out[count].surface[a] = u[a];
        }
        count++;
    }
    return count;
}

/* Whether an obstacle is near to a node of a block. */
static bool may_touch(const ContactFrame *frame, int32_t block)
{
    if (frame->colliders->obstacle_count == 0) return false;
    const size_t cells = (size_t)frame->grid->block_cells;
    const float *gap = frame->gap + (size_t)block * cells;
    float least = INFINITY;
    if (frame->groups || frame->leaders) return true; /* there it hangs on the node */
    for (size_t i = 0; i < cells; i++) least = gap[i] < least ? gap[i] : least;
    return least < INFINITY;
}

static void find_in_blocks(void *context, int32_t begin, int32_t end)
{
    const FindJob *job = context;
    const ContactFrame *frame = job->frame;
    Colliders *colliders = frame->colliders;
    uint32_t *contact_begin = colliders->contact_begin.data;
    Around around;
    for (int32_t block = begin; block < end; block++) {
        const bool listed = job->write && colliders->contact.data;
        uint32_t contacts = 0;
        if (job->write && contact_begin[block + 1] == contact_begin[block]) continue;
        around.near.count = 0;
        if (may_touch(frame, block)) look_around(frame, block, &around);
        if (around.near.count > 0) contacts = contacts_of_block(frame, &around, block, listed ? (Contact *)colliders->contact.data + contact_begin[block] : NULL);
        if ((frame->held && frame->held[block]) || (frame->grabbed && frame->grabbed[block])) {
            contacts += contacts_of_held(frame, block, listed ? (Contact *)colliders->contact.data + contact_begin[block] + contacts : NULL);
        }
        if (!job->write) contact_begin[block + 1] = contacts;
    }
}

/* The distances of the last substep, if they hold; infinite at nodes that had no mass then. */
static const float *gaps_before(const ContactFrame *frame, int32_t block)
{
    const int32_t from = obstacle_cache_from(frame, block);
    return from == GRID_NOWHERE ? NULL : (const float *)frame->cache->gap.data + (size_t)from * (size_t)frame->grid->block_cells;
}

static void measure_blocks(void *context, int32_t begin, int32_t end)
{
    const FindJob *job = context;
    const ContactFrame *frame = job->frame;
    const size_t cells = (size_t)frame->grid->block_cells;
    Around around;
    Near some;
    for (int32_t block = begin; block < end; block++) {
        const float *node = (const float *)frame->grid->node.data + (size_t)block * cells * K_NODE_WIDTH;
        float *gap = (float *)frame->colliders->gap.data + (size_t)block * cells;
        look_around(frame, block, &around);
        const float *before = around.most <= BESIDE ? gaps_before(frame, block) : NULL; /* else obstacles matter that are farther off */
        for (size_t i = 0; i < cells; i++) {
            double point[3];
            gap[i] = INFINITY;
            if (around.near.count == 0 || !(node[i * K_NODE_WIDTH + 3] > 0.0f)) continue;
            if (before && before[i] < INFINITY) {
                gap[i] = before[i];
                continue;
            }
            contacts_node_position(frame, block, (int)i, point);
            gap[i] = (float)field_distance(field_meeting(&around.near, contacts_node_groups(frame, (size_t)block * cells + i), &some), point);
        }
    }
}

pbmpm_result contacts_measure(ContactFrame *frame, Memory *memory, Pool *pool)
{
    Colliders *colliders = frame->colliders;
    const size_t nodes = (size_t)frame->grid->node_blocks * (size_t)frame->grid->block_cells;
    FindJob job = {frame, false};
    frame->gap = NULL;
    if (colliders->obstacle_count == 0) return PBMPM_OK;
    if (!array_reserve(memory, &colliders->gap, nodes, sizeof(float)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the distances of %d blocks", frame->grid->node_blocks);
    pool_for(pool, frame->grid->node_blocks, 16, measure_blocks, &job);
    frame->gap = colliders->gap.data;
    return PBMPM_OK;
}

static bool contact_is_sound(const ContactFrame *frame, const Contact *contact)
{
    const float *n = contact->normal, length2 = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
    const bool has_normal = contact->friction != PBMPM_FRICTION_STICK; /* others that stick need none */
    return contact->node < frame->grid->block_cells && contact->obstacle <= frame->colliders->obstacle_count && contact->gap >= 0.0f &&
           (!has_normal || fabsf(length2 - 1.0f) < 1e-3f);
}

pbmpm_result contacts_find(const ContactFrame *frame, Memory *memory, Pool *pool)
{
    Colliders *colliders = frame->colliders;
    const int32_t blocks = frame->grid->node_blocks;
    colliders->contacts = 0;
    if (colliders->obstacle_count == 0 && !frame->held && !frame->grabbed) return PBMPM_OK;
    colliders->obstacle[colliders->obstacle_count] = (Obstacle){0};
    const size_t ends = (size_t)blocks + 1;
    if (!array_reserve(memory, &colliders->contact_begin, ends, sizeof(uint32_t)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the contacts of %d blocks", blocks);
    uint32_t *contact_begin = colliders->contact_begin.data;
    FindJob job = {frame, false};
    pool_for(pool, blocks, 16, find_in_blocks, &job);
    contact_begin[0] = 0;
    for (int32_t b = 0; b < blocks; b++) contact_begin[b + 1] += contact_begin[b];
    if (!array_reserve(memory, &colliders->contact, contact_begin[blocks], sizeof(Contact)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for %u contacts", contact_begin[blocks]);
    if (colliders->measures && !array_reserve(memory, &colliders->impulses.contact, 3 * (size_t)contact_begin[blocks], sizeof(double)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the impulses of %u contacts", contact_begin[blocks]);
    job.write = true;
    pool_for(pool, blocks, 16, find_in_blocks, &job);
    colliders->contacts = contact_begin[blocks];
    for (uint32_t i = 0; ASSERTS && i < colliders->contacts; i++) ASSERT(contact_is_sound(frame, (const Contact *)colliders->contact.data + i));
    if (colliders->measures && colliders->contacts) memset(colliders->impulses.contact.data, 0, 3 * colliders->contacts * sizeof(double));
    return PBMPM_OK;
}
