#include "world/colliders.h"

#include <string.h>

#include "base/numbers.h"
#include "base/result.h"
#include "base/vector.h"

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
    for (uint32_t slot = 0; slot < colliders->used; slot++) memory_give(memory, colliders->slot[slot].body, sizeof(FreeBody));
    memory_give(memory, colliders->slot, colliders->room * sizeof(Collider));
    memory_give(memory, colliders->obstacle, obstacle_bytes(colliders->room));
    array_free(memory, &colliders->contact);
    array_free(memory, &colliders->contact_begin);
    array_free(memory, &colliders->solid);
    array_free(memory, &colliders->open);
    array_free(memory, &colliders->groups);
    array_free(memory, &colliders->anchored);
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
    FreeBody *body = slot < colliders->used ? colliders->slot[slot].body : NULL; /* of who stood there before */
    if (body) *body = (FreeBody){.ways = 0};
    colliders->slot[slot] = (Collider){.generation = generation, .def = *def, .shape = *shape, .grid = grid, .body = body};
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

FreeBody *collider_body(Collider *collider, Memory *memory)
{
    if (!collider->body) collider->body = memory_take(memory, sizeof *collider->body);
    return collider->body;
}

static bool collider_yields(const Collider *collider) { return collider->body && collider->body->ways > 0; }

void collider_place(Collider *collider, const float position[3], const float *rotation, bool at_once)
{
    pbmpm_shape *shape = &collider->shape;
    memmove(collider->target_position, position, sizeof collider->target_position);
    memmove(collider->target_rotation, rotation ? rotation : shape->rotation, sizeof collider->target_rotation);
    normalise_quaternion(collider->target_rotation); /* so that poses between two are evenly spaced */
    collider->moving = !at_once;
    if (collider->body) {
        collider->body->ways = 0;
        memset(collider->body->went, 0, sizeof collider->body->went); /* the host knows where it is */
    }
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
    obstacle_set_turn(&o);
    return o;
}

/* ---- Rigid bodies that solids made yield ---- */

/* What a body did in the last substep belongs to the way that it has gone. */
static void go_on(FreeBody *body, int part)
{
    if (body->part == part) return;
    for (int a = 0; a < 6; a++) body->went[a] += body->pace[a];
    body->part = part;
}

/* From where it was sent. */
static void yield(Obstacle *o)
{
    const FreeBody *body = o->body;
    double way[6];
    for (int a = 0; a < 6; a++) way[a] = body->went[a] + body->pace[a];
    solid_displace(&o->start, body->centre, body->went);
    solid_displace(&o->end, body->centre, way);
    obstacle_set_turn(o);
}

/* The target is where it was sent, and as much farther as it yielded. */
static void yield_at_last(Collider *collider)
{
    FreeBody *body = collider->body;
    double went[6], q[4], turn[3];
    Solid solid = solid_of(&collider->shape, 3);
    for (int a = 0; a < 6; a++) went[a] = body->went[a] + body->pace[a];
    for (int a = 0; a < 3; a++) solid.position[a] = (double)collider->target_position[a];
    solid_displace(&solid, body->centre, went);
    for (int i = 0; i < 4; i++) q[i] = (double)collider->target_rotation[i];
    cross3(went + 3, q, turn);
    for (int a = 0; a < 3; a++) {
        collider->target_position[a] = (float)solid.position[a];
        collider->target_rotation[a] = (float)(q[a] + 0.5 * (went[3 + a] * q[3] + turn[a]));
    }
    collider->target_rotation[3] = (float)(q[3] - 0.5 * dot3(went + 3, q));
    collider_place(collider, collider->target_position, collider->target_rotation, true);
    memcpy(body->went, went, sizeof went);
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
        o->body = collider_yields(&colliders->slot[slot]) ? colliders->slot[slot].body : NULL;
        o->part = part;
        o->parts = parts;
        if (o->body) go_on(o->body, part);
        if (o->body && o->body->met) yield(o);
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
        if (collider->body) collider->body->ways = 0;
        if (collider->generation != 0 && collider->moving && collider->body && collider->body->met)
            yield_at_last(collider);
        else if (collider->generation != 0 && collider->moving)
            collider_place(collider, collider->target_position, collider->target_rotation, true);
    }
}
