/* Rigid bodies at walls of the domain. */
#include <math.h>
#include <string.h>

#include "base/numbers.h"
#include "base/vector.h"
#include "services/rigid.h"

/* The box around the solid itself: a baked one's grid is wider. */
static void box_around(const Solid *solid, double low[3], double high[3])
{
    solid_bounds(solid, low, high);
    for (int a = 0; a < solid->dimension && solid->grid; a++)
        for (int b = 0; b < solid->dimension; b++) {
            const double border = DISTANCE_GRID_BORDER * solid->grid->spacing * fabs(solid->rotation[3 * a + b]);
            low[a] += border;
            high[a] -= border;
        }
}

/* A direction in which a wall acts on a point of a body. */
typedef struct WallRow {
    double unit[6];     /* with its moment about the body's centre */
    double response[6]; /* of the velocities, to an impulse of 1 against it */
    double yields;      /* of the point's speed along it */
    double given;       /* impulse so far */
} WallRow;

/* A point of a body at a wall, or as near that it may reach it in the next step. */
typedef struct WallTouch {
    WallRow out, along[2]; /* through the wall; and in its plane, in 2D the first alone */
    int alongs;
    double room;     /* speed that it may have outwards */
    double friction; /* Coulomb's coefficient; infinite where it sticks */
} WallTouch;

enum { CORNERS = 8, TOUCHES = RIGID_STOPS, WALL_ROUNDS = 400 }; /* 0.9^400 is rounding */

/* Where a solid may touch a wall that lies along `axis`: corners, or the nearest points of a ball or of a capsule's ends. Of a baked solid the box alone is known: it
 * touches before its centre of mass, where the wall does not turn it. */
static int touching_points(const Solid *solid, const double centre[3], int axis, double side, double point[CORNERS][3])
{
    double from[3] = {0}, reach[3] = {0}, low[3], high[3];
    int axes = 0;
    memcpy(from, solid->position, sizeof from);
    if (solid->kind == PBMPM_BAKED) {
        box_around(solid, low, high);
        memcpy(from, centre, sizeof from);
        from[axis] = side > 0.0 ? high[axis] : low[axis];
    }
    if (solid->kind == PBMPM_BOX) axes = solid->dimension;
    if (solid->kind == PBMPM_CAPSULE) axes = 1;
    for (int b = 0; b < axes; b++) reach[b] = solid->half_extents[b];
    for (int k = 0; k < 1 << axes; k++) {
        for (int a = 0; a < 3; a++) {
            point[k][a] = from[a];
            for (int b = 0; b < axes; b++) point[k][a] += (k >> b & 1 ? 1.0 : -1.0) * solid->rotation[3 * a + b] * reach[b];
        }
        if (solid->kind == PBMPM_CAPSULE || solid->kind == PBMPM_SPHERE) point[k][axis] += side * solid->radius;
    }
    return 1 << axes;
}

static WallRow row_of(const FreeBody *body, const double point[3], int axis, double side)
{
    WallRow row = {.yields = 0.0};
    double arm[3];
    for (int a = 0; a < 3; a++) arm[a] = point[a] - body->centre[a];
    row.unit[axis] = side;
    cross3(arm, row.unit, row.unit + 3);
    free_body_yields(body, row.unit, row.response);
    for (int a = 0; a < 6; a++) row.yields += row.unit[a] * row.response[a];
    return row;
}

static WallTouch touch_of(const FreeBody *body, const double point[3], int axis, double side, int dimension)
{
    WallTouch touch = {.out = row_of(body, point, axis, side)};
    for (int a = 0; a < dimension; a++)
        if (a != axis) touch.along[touch.alongs++] = row_of(body, point, a, 1.0);
    return touch;
}

static double speed_along(const WallRow *row, const pbmpm_rigid_state *state)
{
    return dot3(row->unit, state->velocity) + dot3(row->unit + 3, state->angular_velocity);
}

/* Returns by how much it changed the point's speed. */
static double give(WallRow *row, double given, pbmpm_rigid_state *state)
{
    const double more = given - row->given;
    row->given = given;
    for (int a = 0; a < 3; a++) {
        state->velocity[a] -= more * row->response[a];
        state->angular_velocity[a] -= more * row->response[3 + a];
    }
    return fabs(more) * row->yields;
}

/* The impulse that would leave the point no more than `room` of its speed along the row. */
static double stopping(const WallRow *row, double room, const pbmpm_rigid_state *state)
{
    return row->yields > 0.0 ? row->given + (speed_along(row, state) - room) / row->yields : 0.0;
}

/* Impulses in the wall's plane stop the point there, up to Coulomb's cone about what the wall gives outwards. */
static double rub(WallTouch *touch, pbmpm_rigid_state *state)
{
    double wanted[2] = {0}, most = 0.0;
    for (int k = 0; k < touch->alongs; k++) wanted[k] = stopping(&touch->along[k], 0.0, state);
    const double length = sqrt(wanted[0] * wanted[0] + wanted[1] * wanted[1]), bound = touch->out.given > 0.0 ? touch->friction * touch->out.given : 0.0;
    const double share = length > bound ? bound / length : 1.0;
    for (int k = 0; k < touch->alongs; k++) most = fmax(most, give(&touch->along[k], share * wanted[k], state));
    return most;
}

/* One round of Gauss and Seidel. Returns by how much it changed the speed of a point at most. */
static double stop_once(WallTouch *touch, int count, pbmpm_rigid_state *state)
{
    double most = 0.0;
    for (int k = 0; k < count; k++) {
        WallTouch *t = &touch[k];
        if (t->friction > 0.0) most = fmax(most, rub(t, state));
        most = fmax(most, give(&t->out, fmax(0.0, stopping(&t->out, t->room, state)), state));
    }
    return most;
}

/* Inelastic impulses J_k >= 0 that leave no point faster outwards than its room, with friction (E. Catto, "Iterative Dynamics with Temporal Coherence", 2005), down to
 * rounding. The points of a plank's short end are nearly one: there a round leaves nine tenths. */
static void stop_at_touches(WallTouch *touch, int count, pbmpm_rigid_state *state)
{
    static const double ROUNDING = 1e-15;
    const double first = stop_once(touch, count, state);
    for (int round = 1; round < WALL_ROUNDS && stop_once(touch, count, state) > ROUNDING * first; round++) {}
}

/* Takes a body back by `over` along an axis, the way that its centre may go: that of what a push there would do to it. */
static void go_back(const FreeBody *body, double mass, pbmpm_rigid_state *state, int axis, double over)
{
    double push[6] = {0}, back[6];
    push[axis] = mass;
    free_body_yields(body, push, back);
    const double share = back[axis]; /* the square of the way's length, too */
    if (share < 1e-6) return;
    const double last = dot3(state->velocity_change, back) / share;
    for (int a = 0; a < 3; a++) {
        state->position[a] -= over / share * back[a];
        if (last * over > 0.0) state->velocity_change[a] -= last * back[a];
    }
}

static Solid solid_at(const Collider *collider, const pbmpm_rigid_state *state, int dimension)
{
    Solid solid = solid_of(&collider->shape, dimension);
    solid.grid = collider->grid;
    memcpy(solid.position, state->position, sizeof solid.position);
    rotation_from_quaternion(state->rotation, solid.rotation);
    return solid;
}

/* Between two surfaces: none where one slips, else a hold where one sticks, else the geometric mean (as Box2D mixes them), so a wall without any stays so. */
double rigid_friction(const pbmpm_collider_def *body, const pbmpm_domain_wall *wall)
{
    if (body->friction == PBMPM_FRICTION_SLIP || wall->friction == PBMPM_FRICTION_SLIP) return 0.0;
    if (body->friction == PBMPM_FRICTION_STICK || wall->friction == PBMPM_FRICTION_STICK) return INFINITY;
    return sqrt((double)body->friction_coefficient * (double)wall->friction_coefficient);
}

static bool keeps_inside(const pbmpm_rigid_def *def) { return def->stays_inside && def->moves != PBMPM_FREEDOM_NONE; }

static FreeBody body_of(const pbmpm_rigid_def *def, const pbmpm_rigid_state *state, int dimension)
{
    static const double no_gravity[3] = {0};
    return rigid_free_body(def, state, no_gravity, dimension);
}

void rigid_slow_at_walls(const pbmpm_rigid_def *def, pbmpm_rigid_state *state, const Collider *collider, const Domain *domain, int dimension, double dt, RigidStops *stops)
{
    if (!keeps_inside(def)) return;
    double low[3], high[3], point[CORNERS][3];
    const Solid solid = solid_at(collider, state, dimension);
    const FreeBody body = body_of(def, state, dimension);
    WallTouch touch[TOUCHES];
    int touches = 0;
    box_around(&solid, low, high);
    for (int a = 0; a < dimension; a++) {
        const double side = high[a] - domain->high[a] > domain->low[a] - low[a] ? 1.0 : -1.0; /* the nearer wall */
        const int count = touching_points(&solid, body.centre, a, side, point);
        const double friction = rigid_friction(&collider->def, &domain->wall[domain_place(a, side > 0.0)]);
        for (int k = 0; k < count; k++, touches++) {
            const double room = side > 0.0 ? domain->high[a] - point[k][a] : point[k][a] - domain->low[a];
            touch[touches] = touch_of(&body, point[k], a, side, dimension);
            touch[touches].room = fmax(0.0, room) / dt;
            touch[touches].friction = friction;
        }
    }
    stop_at_touches(touch, touches, state);
    for (int k = 0; k < touches && stops->count < RIGID_STOPS; k++)
        if (touch[k].out.given > 0.0) memcpy(stops->unit[stops->count++], touch[k].out.unit, sizeof touch[k].out.unit);
}

void rigid_stop_at_walls(const pbmpm_rigid_def *def, pbmpm_rigid_state *state, const Collider *collider, const Domain *domain, int dimension, double dt, RigidStops *stops)
{
    if (!keeps_inside(def)) return;
    double low[3], high[3];
    const Solid solid = solid_at(collider, state, dimension);
    const FreeBody body = body_of(def, state, dimension);
    box_around(&solid, low, high);
    for (int a = 0; a < dimension; a++) {
        if (high[a] > domain->high[a]) go_back(&body, def->mass, state, a, high[a] - domain->high[a]);
        else if (low[a] < domain->low[a]) go_back(&body, def->mass, state, a, low[a] - domain->low[a]);
    }
    rigid_slow_at_walls(def, state, collider, domain, dimension, dt, stops);
}
