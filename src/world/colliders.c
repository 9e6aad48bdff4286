#include "world/colliders.h"

#include <math.h>
#include <string.h>

#include "base/assertion.h"
#include "base/numbers.h"
#include "base/result.h"
#include "contact/reach.h"
#include "contact/walls.h"
#include "shape/concave.h"

/* Colliders, walls, and what holds nodes. */
enum { OBSTACLES = PBMPM_MAX_COLLIDERS + DOMAIN_WALLS + 1 };

static size_t obstacle_bytes(uint32_t room) { return (room + DOMAIN_WALLS + 1) * sizeof(Obstacle); }

/* Makes room for so many colliders and their obstacles. On failure nothing has changed. */
static pbmpm_result make_room(Colliders *colliders, Memory *memory, uint32_t room)
{
    Collider *slot = memory_take(memory, room * sizeof(Collider));
    Obstacle *obstacle = slot ? memory_take(memory, obstacle_bytes(room)) : NULL;
    if (!obstacle) {
        memory_give(memory, slot, room * sizeof(Collider));
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for %u colliders", room);
    }
    if (colliders->used > 0) memcpy(slot, colliders->slot, colliders->used * sizeof(Collider));
    if (colliders->obstacle) memcpy(obstacle, colliders->obstacle, obstacle_bytes(colliders->room));
    memory_give(memory, colliders->slot, colliders->room * sizeof(Collider));
    memory_give(memory, colliders->obstacle, obstacle_bytes(colliders->room));
    colliders->slot = slot;
    colliders->obstacle = obstacle;
    colliders->room = room;
    return PBMPM_OK;
}

pbmpm_result colliders_init(Colliders *colliders, Memory *memory)
{
    *colliders = (Colliders){0};
    return make_room(colliders, memory, 1);
}

void colliders_free(Colliders *colliders, Memory *memory)
{
    memory_give(memory, colliders->slot, colliders->room * sizeof(Collider));
    memory_give(memory, colliders->obstacle, obstacle_bytes(colliders->room));
    array_free(memory, &colliders->contact);
    array_free(memory, &colliders->contact_begin);
    array_free(memory, &colliders->solid);
    array_free(memory, &colliders->open);
    array_free(memory, &colliders->groups);
    array_free(memory, &colliders->gap);
    impulses_free(&colliders->impulses, memory);
    *colliders = (Colliders){0};
}

pbmpm_collider_def collider_defaults(void)
{
    return (pbmpm_collider_def){.size = sizeof(pbmpm_collider_def),
                                .friction = PBMPM_FRICTION_COULOMB,
                                .friction_coefficient = 0.2f};
}

bool friction_known(pbmpm_friction friction)
{
    return friction == PBMPM_FRICTION_COULOMB || friction == PBMPM_FRICTION_STICK || friction == PBMPM_FRICTION_SLIP;
}

const char *collider_problem(const pbmpm_collider_def *def)
{
    if (!friction_known(def->friction)) return "collider.friction is unknown";
    if (!in_range(def->friction_coefficient, 0.0, 100.0)) return "collider.friction_coefficient must be in [0, 100]";
    if (def->kinematic != 0 && def->kinematic != 1) return "collider.kinematic must be 0 or 1";
    if (def->measures_impulse != 0 && def->measures_impulse != 1) return "collider.measures_impulse must be 0 or 1";
    if (def->sensor != 0 && def->sensor != 1) return "collider.sensor must be 0 or 1";
    if (def->reports_touches != 0 && def->reports_touches != 1) return "collider.reports_touches must be 0 or 1";
    if (def->sensor && def->measures_impulse) return "a collider that is a sensor gets no impulse to measure";
    return NULL;
}

pbmpm_result colliders_add(Colliders *colliders, Memory *memory, const pbmpm_collider_def *def, const pbmpm_shape *shape, const DistanceGrid *grid,
                           uint32_t generation, pbmpm_collider_id *id)
{
    uint32_t slot = 0;
    while (slot < colliders->used && colliders->slot[slot].generation != 0) slot++;
    if (slot == PBMPM_MAX_COLLIDERS) return fail(PBMPM_ERROR_CAPACITY, "a world holds at most %d colliders", PBMPM_MAX_COLLIDERS);
    pbmpm_result result = def->measures_impulse ? impulses_enable(&colliders->impulses, memory) : PBMPM_OK;
    if (result == PBMPM_OK && slot == colliders->room) result = make_room(colliders, memory, 2 * slot);
    if (result != PBMPM_OK) return result;
    colliders->slot[slot] = (Collider){.generation = generation, .def = *def, .shape = *shape, .grid = grid};
    collider_place(&colliders->slot[slot], shape->position, shape->rotation, true);
    if (slot >= colliders->used) colliders->used = slot + 1;
    if (colliders->impulses.sum) colliders->impulses.sum[slot] = (ImpulseSum){{0}, {0}};
    *id = (pbmpm_collider_id){slot, generation};
    return PBMPM_OK;
}

pbmpm_result colliders_set(Colliders *colliders, Memory *memory, Collider *collider, const pbmpm_collider_def *def, const pbmpm_shape *shape,
                           const DistanceGrid *grid)
{
    const bool begins = def->measures_impulse && !collider->def.measures_impulse;
    const pbmpm_result result = begins ? impulses_enable(&colliders->impulses, memory) : PBMPM_OK;
    if (result != PBMPM_OK) return result;
    if (begins) colliders->impulses.sum[collider - colliders->slot] = (ImpulseSum){{0}, {0}};
    if (def->reports_touches && !collider->def.reports_touches) memset(collider->touched, 0, sizeof collider->touched);
    collider->def = *def;
    if (shape) {
        collider->shape = *shape;
        collider->grid = grid;
    }
    if (shape || !def->kinematic) collider_place(collider, collider->shape.position, collider->shape.rotation, true);
    return PBMPM_OK;
}

void colliders_forget_material(Colliders *colliders, uint32_t material)
{
    for (uint32_t slot = 0; slot < colliders->used; slot++) colliders->slot[slot].touched[material / 64] &= ~((uint64_t)1 << material % 64);
}

bool colliders_use(const Colliders *colliders, const DistanceGrid *grid)
{
    for (uint32_t slot = 0; slot < colliders->used; slot++)
        if (colliders->slot[slot].generation != 0 && colliders->slot[slot].grid == grid) return true;
    return false;
}

Collider *colliders_find(const Colliders *colliders, pbmpm_collider_id id)
{
    if (id.index >= colliders->used || id.generation == 0) return NULL;
    Collider *collider = &colliders->slot[id.index];
    return collider->generation == id.generation ? collider : NULL;
}

void collider_place(Collider *collider, const float position[3], const float *rotation, bool at_once)
{
    pbmpm_shape *shape = &collider->shape;
    memmove(collider->target_position, position, sizeof collider->target_position);
    memmove(collider->target_rotation, rotation ? rotation : shape->rotation, sizeof collider->target_rotation);
    normalise_quaternion(collider->target_rotation); /* so that poses between two are evenly spaced */
    collider->moving = !at_once;
    if (!at_once) return;
    memcpy(shape->position, collider->target_position, sizeof shape->position);
    memcpy(shape->rotation, collider->target_rotation, sizeof shape->rotation);
}

/* ---- Obstacles of a substep ---- */

/* The pose at the share `t` of the way. */
static pbmpm_shape pose_between(const Collider *collider, float t)
{
    return shape_between(&collider->shape, collider->target_position, collider->target_rotation, t);
}

static Solid solid_at(const Collider *collider, const pbmpm_shape *shape, int dimension)
{
    Solid solid = solid_of(shape, dimension);
    solid.grid = collider->grid;
    return solid;
}

bool collider_moves(const Collider *collider)
{
    const pbmpm_shape *shape = &collider->shape;
    return collider->generation != 0 && collider->moving &&
           (memcmp(shape->position, collider->target_position, sizeof shape->position) != 0 ||
            memcmp(shape->rotation, collider->target_rotation, sizeof shape->rotation) != 0);
}

Obstacle collider_obstacle(const Collider *collider, int dimension, int part, int parts)
{
    const pbmpm_collider_def *def = &collider->def;
    Obstacle o = {.moves = collider->moving, .friction = def->friction, .coefficient = def->friction_coefficient, .measures = def->measures_impulse,
                  .meets = def->meets};
    if (!collider->moving) {
        o.start = o.end = solid_at(collider, &collider->shape, dimension);
        return o;
    }
    const pbmpm_shape start = pose_between(collider, (float)part / (float)parts);
    const pbmpm_shape end = pose_between(collider, (float)(part + 1) / (float)parts);
    o.start = solid_at(collider, &start, dimension);
    o.end = solid_at(collider, &end, dimension);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++) o.turn[r * 3 + c] += o.end.rotation[r * 3 + k] * o.start.rotation[c * 3 + k];
    return o;
}

static Obstacle domain_wall(const Domain *domain, int dimension, int axis, bool upper)
{
    const pbmpm_domain_wall *wall = &domain->wall[domain_place(axis, upper)];
    Obstacle o = {.wall = true, .friction = wall->friction, .coefficient = wall->friction_coefficient, .measures = domain->measures};
    o.start = (Solid){.kind = PBMPM_PLANE, .dimension = dimension};
    o.start.position[axis] = upper ? domain->high[axis] : domain->low[axis];
    o.start.normal[axis] = upper ? -1.0 : 1.0;
    o.place = (uint16_t)(PBMPM_MAX_COLLIDERS + domain_place(axis, upper));
    o.end = o.start;
    return o;
}

void colliders_begin_substep(Colliders *colliders, const Domain *domain, int dimension, int part, int parts)
{
    int count = 0;
    colliders->measures = domain && domain->measures;
    for (uint32_t slot = 0; slot < colliders->used; slot++) {
        if (!collider_acts(&colliders->slot[slot])) continue;
        Obstacle *o = &colliders->obstacle[count++];
        *o = collider_obstacle(&colliders->slot[slot], dimension, part, parts);
        o->place = (uint16_t)slot;
        colliders->measures = colliders->measures || o->measures;
    }
    for (int place = 0; domain && place < 2 * dimension; place++)
        if (!domain->wall[place].open) colliders->obstacle[count++] = domain_wall(domain, dimension, place / 2, place % 2);
    colliders->obstacle_count = count;
}

void colliders_end_step(Colliders *colliders)
{
    for (uint32_t slot = 0; slot < colliders->used; slot++) {
        Collider *collider = &colliders->slot[slot];
        if (collider->generation != 0 && collider->moving)
            collider_place(collider, collider->target_position, collider->target_rotation, true);
    }
}

double obstacle_distance(const Obstacle *o, const double point[3], double normal[3]) { return solid_distance(&o->end, point, normal); }

/* x -> end + turn (x - start). */
void obstacle_motion(const Obstacle *o, const double point[3], double cell_size, float limit, float out[3])
{
    memset(out, 0, 3 * sizeof *out);
    if (!o->moves) return;
    double moved[3], length = 0.0;
    for (int r = 0; r < 3; r++) {
        moved[r] = o->end.position[r] - point[r];
        for (int c = 0; c < 3; c++) moved[r] += o->turn[r * 3 + c] * (point[c] - o->start.position[c]);
        moved[r] /= cell_size;
        length += moved[r] * moved[r];
    }
    const double scale = length > (double)limit * limit ? limit / sqrt(length) : 1.0;
    for (int r = 0; r < o->start.dimension; r++) out[r] = (float)(moved[r] * scale);
}

/* ---- Finding contacts ---- */

typedef struct FindJob {
    const ContactFrame *frame;
    bool write; /* first pass counts, second writes */
} FindJob;

void contacts_node_position(const ContactFrame *frame, int32_t block, int node, double point[3])
{
    const int32_t *corner = (const int32_t *)frame->grid->coordinate.data + 3 * block;
    const int local[3] = {node & 3, node >> 2 & 3, node >> 4};
    for (int a = 0; a < 3; a++)
        point[a] = a < frame->grid->dimension ? (double)(frame->grid->anchor[a] + corner[a] * K_BLOCK_AXIS + local[a]) * frame->cell_size : 0.0;
}

/* What the iterations may add to the way of a node [cells]. Nodes that walls leave free stand half a cell before them, and those behind follow: iterations do not add
 * to that. */
static const double WAY_MARGIN = 1.0, WAY_MARGIN_AT_WALLS = 0.25;

void contacts_block_centre(const ContactFrame *frame, int32_t block, double centre[3])
{
    contacts_node_position(frame, block, 0, centre);
    for (int a = 0; a < frame->grid->dimension; a++) centre[a] += 0.5 * (K_BLOCK_AXIS - 1) * frame->cell_size;
}

/* How close [cells] a node must be to an obstacle to be able to meet it: what it may move, what the obstacle moves, and
 * the margin. */
static double reach_of(const ContactFrame *frame, const Obstacle *o, int32_t block, const double centre[3])
{
    float surface[3];
    obstacle_motion(o, centre, frame->cell_size, frame->max_displacement, surface);
    double motion = 0.0;
    for (int a = 0; a < 3; a++) motion += fabs((double)surface[a]);
    const double node = ((const float *)frame->grid->node_reach.data)[block] * sqrt((double)frame->grid->dimension);
    return fmin(node, frame->max_displacement) + motion + (frame->walls && !frame->apart ? WAY_MARGIN_AT_WALLS : WAY_MARGIN);
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

/* Whether the way of a node, as predicted, passes the obstacle at more than the margin: then it needs no contact, which would
 * brake it although nothing is in its way. The solid is convex, so along the way the distance is a convex function, and
 * lies above its tangents at both ends. */
static bool way_passes(const ContactFrame *frame, const Obstacle *o, const float *u, const double point[3], double distance,
                       const double normal[3])
{
    float surface[3];
    double end[3] = {0}, end_normal[3], leaving = 0.0, arriving = 0.0;
    if (distance <= WAY_MARGIN) return false;
    obstacle_motion(o, point, frame->cell_size, frame->max_displacement, surface);
    for (int a = 0; a < frame->grid->dimension; a++) end[a] = point[a] + ((double)u[a] - surface[a]) * frame->cell_size;
    const double end_distance = solid_distance(&o->start, end, end_normal) / frame->cell_size;
    for (int a = 0; a < frame->grid->dimension; a++) {
        leaving += ((double)u[a] - surface[a]) * normal[a];
        arriving += ((double)u[a] - surface[a]) * end_normal[a];
    }
    if (end_distance <= WAY_MARGIN) return false;
    if (leaving >= 0.0 || arriving <= 0.0) return true; /* nearest at one of the ends */
    const double crossing = (end_distance - arriving - distance) / (leaving - arriving);
    return distance + crossing * leaving > WAY_MARGIN;
}

/* Contacts of a node with an obstacle of any form; written if `out` is not null. */
static uint32_t contacts_in_hollow(const ContactFrame *frame, const Obstacle *o, const float *u, const double point[3], int node,
                                   double distance, const double normal[3], Contact *out)
{
    float surface[3];
    double way[3];
    Plane plane[PLANES_MAX];
    obstacle_motion(o, point, frame->cell_size, frame->max_displacement, surface);
    for (int a = 0; a < 3; a++) way[a] = (double)u[a] - (double)surface[a];
    const int count = concave_planes(&o->start, frame->cell_size, point, distance, normal, way, WAY_MARGIN, plane);
    for (int i = 0; i < count && out; i++) out[i] = contact_at(frame, o, point, node, plane[i].gap, plane[i].normal);
    return (uint32_t)count;
}

/* How deep [cells] in an obstacle a node is more than on its surface. */
static const double INSIDE = 1e-3;

/* The obstacles around a block, and how close to each a node must be; `most`: to any. */
typedef struct Around {
    Near near;
    double reach[OBSTACLES], most;
} Around;

uint32_t contacts_block_groups(const ContactFrame *frame, int32_t block)
{
    const size_t cells = (size_t)frame->grid->block_cells;
    uint32_t groups = 0;
    for (size_t i = 0; frame->groups && i < cells; i++) groups |= frame->groups[(size_t)block * cells + i];
    return !frame->groups ? ALL_GROUPS : groups ? groups : frame->present;
}

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
        if (!field_surface(&around->near, point, &face) || face.obstacle->start.grid) return 0;
        if (out) out[0] = contact_at(frame, face.obstacle, point, node, face.distance, face.normal);
        return 1;
    }
    for (int k = 0; k < around->near.count; k++) {
        const Obstacle *o = around->near.obstacle[k];
        double normal[3];
        if (o->start.grid) continue;
        const double distance = solid_distance(&o->start, point, normal) / frame->cell_size;
        if (distance > 0.0) continue;
        if (out) out[count] = contact_at(frame, o, point, node, distance, normal);
        count++;
    }
    return count;
}

/* Contacts of a node with the planes around it. In a box near its outer edge the other faces of the edge hold it, too: were it held by one alone, what presses on the
 * other would push past it, and a floating box would lie too deep in the water. */
static uint32_t contacts_with_faces(const ContactFrame *frame, const Around *around, const float *u, const double point[3], int node, Contact *out)
{
    Face face[FIELD_FACES];
    uint32_t count = 0;
    int faces = field_faces(&around->near, point, around->most, face);
    if (faces == 0) return contacts_deep_inside(frame, around, point, node, out);
    if (face[0].distance < -INSIDE) faces = field_outer_faces(&around->near, point, NODE_REACH, face, faces);
    for (int i = 0; i < faces; i++) {
        const Obstacle *o = face[i].obstacle;
        int k = 0;
        while (around->near.obstacle[k] != o) k++;
        if (o->start.grid || face[i].distance > around->reach[k] || way_passes(frame, o, u, point, face[i].distance, face[i].normal)) continue;
        if (out) out[count] = contact_at(frame, o, point, node, face[i].distance, face[i].normal);
        count++;
    }
    return count;
}

/* Whether a node stays where it was taken; see joint.h. */
static bool node_stays(const ContactFrame *frame, int32_t block, int node)
{
    const uint32_t at = (uint32_t)(block * frame->grid->block_cells + node);
    return walls_list(frame->staying, at) && !reach_solid(frame, at);
}

/* In an edge each wall but the nearest books what it gives along its own normal, the nearest the rest. */
static uint32_t contacts_that_stay(const ContactFrame *frame, int32_t block, int node, Contact *out)
{
    uint16_t obstacle[3] = {(uint16_t)frame->colliders->obstacle_count};
    const float *normal[3];
    const int faces = walls_faces(frame->staying, (uint32_t)(block * frame->grid->block_cells + node), obstacle, normal);
    uint32_t count = 0;
    for (int k = faces - 1; k > 0; k--, count++)
        if (out) {
            out[count] = (Contact){.node = (uint16_t)node, .obstacle = obstacle[k], .friction = PBMPM_FRICTION_SLIP, .stays = true};
            memcpy(out[count].normal, normal[k], sizeof out[count].normal);
        }
    if (out) out[count] = (Contact){.node = (uint16_t)node, .obstacle = obstacle[0], .friction = PBMPM_FRICTION_STICK, .stays = true};
    return count + 1;
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
        double point[3], normal[3];
        if (u[3] == 0.0f || walls_hold(frame->walls, (uint32_t)(block * grid->block_cells + i))) continue; /* no mass, nobody listens */
        if (node_stays(frame, block, i)) {
            count += contacts_that_stay(frame, block, i, out ? out + count : NULL);
            continue;
        }
        const size_t at = (size_t)block * (size_t)grid->block_cells + (size_t)i;
        const Around *around = around_node(frame, all, at, &some);
        if ((double)frame->gap[at] > around->most) continue;
        const Near *near = &around->near;
        contacts_node_position(frame, block, i, point);
        count += contacts_with_faces(frame, around, u, point, i, out ? out + count : NULL);
        for (int k = 0; k < near->count; k++) {
            const Obstacle *o = near->obstacle[k];
            if (!o->start.grid) continue;
            const double distance = solid_distance(&o->start, point, normal) / frame->cell_size;
            if (distance <= around->reach[k]) count += contacts_in_hollow(frame, o, u, point, i, distance, normal, out ? out + count : NULL);
        }
        const bool walled = walls_list(frame->walls, (uint32_t)(block * grid->block_cells + i));
        const bool rubs = reach_solid(frame, (uint32_t)(block * grid->block_cells + i));
        for (uint32_t k = first; k < count && out; k++) {
            out[k].walled = walled;
            if (!rubs) out[k].coefficient = 0.0f;
        }
    }
    return count;
}

static void look_around(const ContactFrame *frame, int32_t block, Around *around)
{
    static const double BESIDE = 4.5; /* [cells]: how far obstacles matter to a node in another one: those beside it, seen from its reflection */
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

/* Nodes that are held stick to an obstacle that does not move. */
static uint32_t contacts_of_held(const ContactFrame *frame, int32_t block, Contact *out)
{
    const Grid *grid = frame->grid;
    const float *node = (const float *)grid->node.data + (size_t)block * (size_t)grid->block_cells * K_NODE_WIDTH;
    uint32_t count = 0;
    for (int i = 0; i < grid->block_cells; i++) {
        if (!(frame->held[block] >> i & 1) || node[i * K_NODE_WIDTH + 3] == 0.0f) continue;
        if (out)
            out[count] = (Contact){.node = (uint16_t)i, .obstacle = (uint16_t)frame->colliders->obstacle_count, .friction = PBMPM_FRICTION_STICK};
        count++;
    }
    return count;
}

uint32_t colliders_contacts(const Colliders *colliders)
{
    const Contact *contact = colliders->contact.data;
    uint32_t count = 0;
    for (uint32_t i = 0; i < colliders->contacts; i++) count += contact[i].obstacle < colliders->obstacle_count;
    return count;
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
        look_around(frame, block, &around);
        if (around.near.count > 0) contacts = contacts_of_block(frame, &around, block, listed ? (Contact *)colliders->contact.data + contact_begin[block] : NULL);
        if (frame->held && frame->held[block]) {
            contacts += contacts_of_held(frame, block, listed ? (Contact *)colliders->contact.data + contact_begin[block] + contacts : NULL);
        }
        if (!job->write) contact_begin[block + 1] = contacts;
    }
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
        for (size_t i = 0; i < cells; i++) {
            double point[3];
            gap[i] = INFINITY;
            if (around.near.count == 0 || !(node[i * K_NODE_WIDTH + 3] > 0.0f)) continue;
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
    if (colliders->obstacle_count == 0 && !frame->held) return PBMPM_OK;
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

/* ---- Obeying contacts ---- */

/* Relative to the surface the node may approach by the gap and no further: u.n >= -gap. The impulse that this takes limits
 * the friction: the tangential part loses at most coefficient times as much (Coulomb's cone). */
static void obey(const Contact *contact, float *u)
{
    const float *n = contact->normal, *s = contact->surface;
    float v[3], normal_part = 0.0f, tangent2 = 0.0f;
    for (int a = 0; a < 3; a++) {
        v[a] = u[a] - s[a];
        normal_part += v[a] * n[a];
    }
    const bool held = contact->friction == PBMPM_FRICTION_STICK;
    const float impulse = -contact->gap - normal_part;
    if (impulse <= 0.0f && !(held && contact->gap == 0.0f)) return;
    for (int a = 0; a < 3; a++) {
        v[a] -= normal_part * n[a];
        tangent2 += v[a] * v[a];
    }
    float keep = contact->friction == PBMPM_FRICTION_SLIP ? 1.0f : 0.0f;
    if (contact->friction == PBMPM_FRICTION_COULOMB) {
        const float lost = contact->coefficient * impulse;
        keep = tangent2 > lost * lost ? 1.0f - lost / sqrtf(tangent2) : 0.0f;
    }
    for (int a = 0; a < 3; a++) u[a] = s[a] - contact->gap * n[a] + keep * v[a];
}

/* The same, with the change of the node's momentum written down. */
static void obey_and_book(const Impulses *impulses, const Contact *contact, uint32_t index, float *u)
{
    double *booked = (double *)impulses->contact.data + 3 * (size_t)index;
    const float before[3] = {u[0], u[1], u[2]};
    obey(contact, u);
    for (int a = 0; a < 3; a++) booked[a] = (impulses->adds_up ? booked[a] : 0.0) + (double)u[3] * ((double)u[a] - (double)before[a]);
}

void contacts_apply(const ContactFrame *frame, int32_t begin, int32_t end)
{
    const Colliders *colliders = frame->colliders;
    if (colliders->contacts == 0) return;
    const Grid *grid = frame->grid;
    const uint32_t *contact_begin = colliders->contact_begin.data;
    for (int32_t block = begin; block < end; block++) {
        float *node = (float *)grid->node.data + (size_t)block * (size_t)grid->block_cells * K_NODE_WIDTH;
        for (uint32_t i = contact_begin[block]; i < contact_begin[block + 1]; i++) {
            const Contact *contact = (const Contact *)colliders->contact.data + i;
            if (colliders->measures && !contact->walled)
                obey_and_book(&colliders->impulses, contact, i, node + contact->node * K_NODE_WIDTH);
            else
                obey(contact, node + contact->node * K_NODE_WIDTH);
        }
    }
}

void contacts_apply_walled(const ContactFrame *frame, int32_t begin, int32_t end)
{
    const uint32_t *contact_begin = frame->colliders->contact_begin.data;
    for (int32_t block = begin; block < end; block++) {
        float *node = (float *)frame->grid->node.data + (size_t)block * (size_t)frame->grid->block_cells * K_NODE_WIDTH;
        for (uint32_t i = contact_begin[block]; i < contact_begin[block + 1]; i++) {
            const Contact *contact = (const Contact *)frame->colliders->contact.data + i;
            if (contact->walled) obey(contact, node + contact->node * K_NODE_WIDTH);
        }
    }
}

void contacts_hold(const ContactFrame *frame, int32_t begin, int32_t end)
{
    const Colliders *colliders = frame->colliders;
    if (colliders->contacts == 0) return;
    const uint32_t *contact_begin = colliders->contact_begin.data;
    for (int32_t block = begin; block < end; block++) {
        float *node = (float *)frame->grid->node.data + (size_t)block * (size_t)frame->grid->block_cells * K_NODE_WIDTH;
        for (uint32_t i = contact_begin[block]; i < contact_begin[block + 1]; i++) {
            const Contact *contact = (const Contact *)colliders->contact.data + i;
            if (contact->gap > 0.0f) continue;
            float *u = node + contact->node * K_NODE_WIDTH, along = 0.0f;
            const bool held = contact->friction == PBMPM_FRICTION_STICK;
            for (int a = 0; a < 3; a++) along += u[a] * contact->normal[a];
            for (int a = 0; a < 3; a++) u[a] = held ? 0.0f : u[a] - along * contact->normal[a];
        }
    }
}

double contacts_momentum_scale(const ContactFrame *frame, double dt)
{
    return pow(frame->cell_size, frame->grid->dimension) * frame->cell_size / dt;
}

void contacts_book(const ContactFrame *frame, double dt)
{
    const Colliders *colliders = frame->colliders;
    if (!colliders->measures || colliders->contacts == 0) return;
    const uint32_t *contact_begin = colliders->contact_begin.data;
    const double *booked = colliders->impulses.contact.data;
    const double scale = contacts_momentum_scale(frame, dt);
    for (int32_t block = 0; block < frame->grid->node_blocks; block++)
        for (uint32_t i = contact_begin[block]; i < contact_begin[block + 1]; i++) {
            const Contact *contact = (const Contact *)colliders->contact.data + i;
            const Obstacle *o = &colliders->obstacle[contact->obstacle];
            if (!o->measures) continue;
            double point[3], gained[3];
            contacts_node_position(frame, block, contact->node, point);
            for (int a = 0; a < 3; a++) gained[a] = scale * booked[3 * (size_t)i + (size_t)a];
            impulse_add(&colliders->impulses.sum[o->place], point, gained);
        }
}
