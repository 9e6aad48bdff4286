#include "services/rigid.h"

#include <math.h>
#include <string.h>

#include "base/cholesky.h"
#include "base/numbers.h"
#include "base/vector.h"

/* A turn in one part [rad]: the method below errs by its fifth power over 120, 2.5e-7. And parts of a step. */
static const double LARGEST_TURN = 0.125;
enum { MOST_PARTS = 64 };

/* ---- Definitions and states ---- */

pbmpm_rigid_def rigid_defaults(void)
{
    return (pbmpm_rigid_def){.size = sizeof(pbmpm_rigid_def),
                             .stays_inside = 1,
                             .mass = 1.0,
                             .inertia = {1.0, 1.0, 1.0},
                             .move_axis = {0.0, 1.0, 0.0},
                             .turn_axis = {0.0, 0.0, 1.0}};
}

static bool within(const double *values, int count, double most)
{
    for (int i = 0; i < count; i++)
        if (!(fabs(values[i]) <= most)) return false;
    return true;
}

static bool axis_is_valid(const double axis[3], int dimension)
{
    double length2 = 0.0;
    for (int a = 0; a < dimension; a++) length2 += axis[a] * axis[a];
    return length2 >= 1e-12 && length2 <= 1e18;
}

static void inertia_of(const pbmpm_rigid_def *def, double m[3][3])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3;
        m[a][a] = def->inertia[a];
        m[a][b] = m[b][a] = def->products[a];
    }
}

/* Whether all leading minors are (J. J. Sylvester). */
static bool is_positive(const double m[3][3])
{
    const double two = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    double three[3];
    cross3(m[0], m[1], three);
    return m[0][0] > 0.0 && two > 0.0 && dot3(three, m[2]) > 0.0;
}

static const char *inertia_problem(const pbmpm_rigid_def *def, int dimension)
{
    if (dimension == 2) return def->inertia[2] > 0.0 && def->inertia[2] <= 1e30 ? NULL : "rigid.inertia[2] must be above 0, up to 1e30";
    double inertia[3][3];
    if (!within(def->inertia, 3, 1e30) || !within(def->products, 3, 1e30)) return "rigid.inertia and products must be within 1e30";
    inertia_of(def, inertia);
    return is_positive(inertia) ? NULL : "rigid.inertia with products must be a positive tensor";
}

const char *rigid_def_problem(const pbmpm_rigid_def *def, int dimension)
{
    if (def->stays_inside != 0 && def->stays_inside != 1) return "rigid.stays_inside must be 0 or 1";
    if (!in_enum(def->moves, PBMPM_FREEDOM_ALL, PBMPM_FREEDOM_NONE)) return "rigid.moves is unknown";
    if (!in_enum(def->turns, PBMPM_FREEDOM_ALL, PBMPM_FREEDOM_NONE)) return "rigid.turns is unknown";
    if (!(def->mass >= 1e-12 && def->mass <= 1e15)) return "rigid.mass must be in [1e-12, 1e15]";
    if (!within(def->centre, dimension, 1e9) || !within(def->pivot, dimension, 1e9)) return "rigid.centre and pivot must be within 1e9";
    if (!within(def->force, 3, 1e30) || !within(def->torque, 3, 1e30)) return "rigid.force and torque must be within 1e30";
    if (!axis_is_valid(def->move_axis, dimension)) return "rigid.move_axis must be 1e-6 to 1e9 long";
    if (dimension == 3 && !axis_is_valid(def->turn_axis, 3)) return "rigid.turn_axis must be 1e-6 to 1e9 long";
    return inertia_problem(def, dimension);
}

const char *rigid_state_problem(const pbmpm_rigid_state *state, int dimension)
{
    if (state->reserved != 0) return "state.reserved must be 0";
    if (!within(state->position, dimension, 1e9) || !within(state->point, dimension, 1e9)) return "state.position and point must be within 1e9";
    if (!within(state->velocity, dimension, 1e9) || !within(state->angular_velocity, 3, 1e9)) return "state's velocities must be within 1e9";
    if (!within(state->velocity_change, dimension, 1e9) || !within(state->angular_velocity_change, 3, 1e9))
        return "state's changes of velocity must be within 1e9";
    double length2 = 0.0;
    for (int i = 0; i < 4; i++) length2 += state->rotation[i] * state->rotation[i];
    if (!(length2 >= 0.25 && length2 <= 4.0)) return "state.rotation must be a quaternion of length 0.5 to 2";
    if (dimension == 2 && (state->rotation[0] != 0.0 || state->rotation[1] != 0.0))
        return "state.rotation in 2D must turn in the plane: x and y of the quaternion are 0";
    return NULL;
}

/* ---- What a body may do ---- */

/* The directions, at right angles to each other, in which it may move or turn. */
typedef struct Ways {
    double way[3][3];
    int count;
} Ways;

static void add_way(Ways *ways, const double direction[3], double length)
{
    for (int a = 0; a < 3; a++) ways->way[ways->count][a] = direction[a] / length;
    ways->count++;
}

/* The directions across one, in `dimension` dimensions. */
static void add_across(Ways *ways, const double axis[3], int dimension)
{
    if (dimension == 2) {
        const double across[3] = {-axis[1], axis[0], 0.0};
        add_way(ways, across, sqrt(dot3(axis, axis)));
        return;
    }
    int least = 0;
    for (int a = 1; a < 3; a++)
        if (fabs(axis[a]) < fabs(axis[least])) least = a;
    double unit[3] = {0}, one[3], other[3];
    unit[least] = 1.0;
    cross3(axis, unit, one);
    cross3(axis, one, other);
    add_way(ways, one, sqrt(dot3(one, one)));
    add_way(ways, other, sqrt(dot3(other, other)));
}

static Ways ways_of(pbmpm_freedom freedom, const double axis[3], int dimension)
{
    Ways ways = {.count = 0};
    double own[3] = {0};
    memcpy(own, axis, (size_t)dimension * sizeof *own);
    if (freedom == PBMPM_FREEDOM_AXIS) add_way(&ways, own, sqrt(dot3(own, own)));
    if (freedom == PBMPM_FREEDOM_PLANE) add_across(&ways, own, dimension);
    for (int a = 0; a < dimension && freedom == PBMPM_FREEDOM_ALL; a++) {
        const double unit[3] = {a == 0, a == 1, a == 2};
        add_way(&ways, unit, 1.0);
    }
    return ways;
}

static Ways ways_to_move(const pbmpm_rigid_def *def, int dimension) { return ways_of(def->moves, def->move_axis, dimension); }

static Ways ways_to_turn(const pbmpm_rigid_def *def, int dimension)
{
    static const double third[3] = {0.0, 0.0, 1.0};
    if (dimension == 3) return ways_of(def->turns, def->turn_axis, 3);
    return ways_of(def->turns == PBMPM_FREEDOM_NONE ? PBMPM_FREEDOM_NONE : PBMPM_FREEDOM_AXIS, third, 3);
}

/* What of a vector lies along the ways. */
static void keep_ways(const Ways *ways, double v[3])
{
    double kept[3] = {0};
    for (int i = 0; i < ways->count; i++) {
        const double along = dot3(ways->way[i], v);
        for (int a = 0; a < 3; a++) kept[a] += along * ways->way[i][a];
    }
    memcpy(v, kept, sizeof kept);
}

/* ---- Inertia ---- */

static bool is_held(const pbmpm_rigid_def *def) { return def->moves == PBMPM_FREEDOM_NONE; }

/* A vector of the body's frame in the world. */
static void to_world(const double turn[9], const double own[3], double out[3])
{
    for (int r = 0; r < 3; r++) out[r] = turn[3 * r] * own[0] + turn[3 * r + 1] * own[1] + turn[3 * r + 2] * own[2];
}

/* From what the body turns about to its centre of mass, in its own frame: its pivot, or the centre itself. */
static void own_lever(const pbmpm_rigid_def *def, int dimension, double lever[3])
{
    for (int a = 0; a < 3; a++) lever[a] = is_held(def) && a < dimension ? def->centre[a] - def->pivot[a] : 0.0;
}

/* About what it turns about, in its own frame (J. Steiner's theorem). */
static void whole_inertia(const pbmpm_rigid_def *def, int dimension, double inertia[3][3])
{
    double lever[3];
    own_lever(def, dimension, lever);
    inertia_of(def, inertia);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++) inertia[r][c] += def->mass * ((r == c ? dot3(lever, lever) : 0.0) - lever[r] * lever[c]);
}

/* The body as it turns: what is the same all through a step. */
typedef struct Spinner {
    Ways ways;
    double inertia[3][3]; /* in its own frame */
} Spinner;

static Spinner spinner_of(const pbmpm_rigid_def *def, int dimension)
{
    Spinner spinner = {.ways = ways_to_turn(def, dimension)};
    whole_inertia(def, dimension, spinner.inertia);
    return spinner;
}

/* The inertia along the ways, of a body turned by `turn`. */
static void inertia_along_ways(const Spinner *spinner, const double turn[9], SmallMatrix m)
{
    double own[3][3];
    for (int i = 0; i < spinner->ways.count; i++)
        for (int a = 0; a < 3; a++) {
            own[i][a] = 0.0;
            for (int b = 0; b < 3; b++) own[i][a] += turn[3 * b + a] * spinner->ways.way[i][b];
        }
    for (int i = 0; i < spinner->ways.count; i++)
        for (int j = 0; j < spinner->ways.count; j++) {
            const double half[3] = {dot3(spinner->inertia[0], own[j]), dot3(spinner->inertia[1], own[j]), dot3(spinner->inertia[2], own[j])};
            m[i][j] = dot3(own[i], half);
        }
}

/* The velocity that a body with this angular momentum along its ways turns with. */
static void spin_of(const Spinner *spinner, const double rotation[4], const double momentum[3], double spin[3])
{
    double turn[9], x[3];
    SmallMatrix m;
    rotation_from_quaternion(rotation, turn);
    inertia_along_ways(spinner, turn, m);
    memcpy(x, momentum, sizeof x);
    cholesky_factor(m, spinner->ways.count, 0.0);
    cholesky_forward(m, x, spinner->ways.count);
    cholesky_backward(m, x, spinner->ways.count);
    for (int a = 0; a < 3; a++) {
        spin[a] = 0.0;
        for (int i = 0; i < spinner->ways.count; i++) spin[a] += x[i] * spinner->ways.way[i][a];
    }
}

/* The angular momentum along the ways. */
static void momentum_of(const Spinner *spinner, const double rotation[4], const double spin[3], double momentum[3])
{
    double turn[9];
    SmallMatrix m;
    rotation_from_quaternion(rotation, turn);
    inertia_along_ways(spinner, turn, m);
    for (int i = 0; i < spinner->ways.count; i++) {
        momentum[i] = 0.0;
        for (int j = 0; j < spinner->ways.count; j++) momentum[i] += m[i][j] * dot3(spinner->ways.way[j], spin);
    }
}

/* ---- How it yields ---- */

/* Adds the columns (L^-1)^T of what turns it, with L L^T the inertia along its ways: the inverse of the inertia is their product. */
static void add_turns(const Spinner *spinner, const double turn[9], FreeBody *body)
{
    const int count = spinner->ways.count;
    SmallMatrix l;
    inertia_along_ways(spinner, turn, l);
    cholesky_factor(l, count, 0.0);
    for (int c = 0; c < count; c++, body->ways++) {
        double x[3] = {0};
        x[c] = 1.0;
        cholesky_backward(l, x, count);
        for (int a = 0; a < 3; a++)
            for (int i = 0; i < count; i++) body->way[body->ways][3 + a] += x[i] * spinner->ways.way[i][a];
    }
}

void rigid_centre(const pbmpm_rigid_def *def, const pbmpm_rigid_state *state, int dimension, double centre[3])
{
    double turn[9], own[3], arm[3];
    rotation_from_quaternion(state->rotation, turn);
    for (int a = 0; a < 3; a++) own[a] = a >= dimension ? 0.0 : is_held(def) ? def->pivot[a] : def->centre[a];
    to_world(turn, own, arm);
    for (int a = 0; a < 3; a++) centre[a] = a < dimension ? state->position[a] + arm[a] : 0.0;
}

FreeBody rigid_free_body(const pbmpm_rigid_def *def, const pbmpm_rigid_state *state, const double gravity[3], int dimension)
{
    FreeBody body = {.ways = 0};
    const Ways moves = ways_to_move(def, dimension);
    const Spinner spinner = spinner_of(def, dimension);
    double turn[9], own[3], lever[3], of_weight[3];
    rotation_from_quaternion(state->rotation, turn);
    for (; body.ways < moves.count; body.ways++)
        for (int a = 0; a < 3; a++) body.way[body.ways][a] = moves.way[body.ways][a] / sqrt(def->mass);
    add_turns(&spinner, turn, &body);
    rigid_centre(def, state, dimension, body.centre);
    own_lever(def, dimension, own);
    to_world(turn, own, lever);
    for (int a = 0; a < 3; a++) {
        body.push[a] = def->mass * gravity[a] + def->force[a];
    }
    cross3(lever, body.push, of_weight);
    for (int a = 0; a < 3; a++) body.push[3 + a] = of_weight[a] + def->torque[a];
    return body;
}

/* ---- Velocities ---- */

/* What the impulses ask for, held back by the virtual mass. */
static void change(const double asked[3], double heavier, double last[3], double velocity[3])
{
    for (int a = 0; a < 3; a++) {
        last[a] = (asked[a] + heavier * last[a]) / (1.0 + heavier);
        velocity[a] += last[a];
    }
}

/* The size of an impulse along a body's ways. */
static double size_along(const FreeBody *body, const double impulse[6])
{
    double size2 = 0.0;
    for (int k = 0; k < body->ways; k++) {
        double along = 0.0;
        for (int a = 0; a < 6; a++) along += body->way[k][a] * impulse[a];
        size2 += along * along;
    }
    return sqrt(size2);
}

/* The share of what solids gave in the last step that they are likely to give again. What rests is given what gravity and the host give it: all of it counts. Of an impact
 * as much counts, and no more. */
static double share_expected(const FreeBody *body, const double impulse[6], double dt)
{
    double weight[6];
    for (int a = 0; a < 6; a++) weight[a] = dt * body->push[a];
    const double given = size_along(body, impulse), most = size_along(body, weight);
    return given > most ? most / given : 1.0;
}

void rigid_change_velocity(const pbmpm_rigid_def *def, pbmpm_rigid_state *state, RigidPush *push, int dimension, double dt)
{
    const FreeBody body = rigid_free_body(def, state, push->gravity, dimension);
    const Ways moves = ways_to_move(def, dimension), turns = ways_to_turn(def, dimension);
    const double heavier = push->met ? 0.0 : push->virtual_mass / def->mass; /* who met solids has yielded to them in the step itself */
    double impulse[6], asked[6], of_matter[6];
    for (int a = 0; a < 3; a++) {
        impulse[a] = push->linear[a];
        impulse[3 + a] = push->angular[a];
    }
    free_body_yields(&body, impulse, of_matter);
    const double share = push->met && !push->walled ? share_expected(&body, impulse, dt) : 0.0;
    for (int a = 0; a < 6; a++) push->expected[a] = share * impulse[a];
    for (int a = 0; a < 6; a++) impulse[a] += dt * body.push[a];
    free_body_yields(&body, impulse, asked);
    for (int a = 0; a < 6; a++) {
        push->later[a] = push->walled ? of_matter[a] - push->yielded[a] : 0.0;
        asked[a] += push->delayed[a] - push->later[a] - push->expects[a];
        push->expects[a] = share * of_matter[a];
        asked[a] += push->expects[a];
    }
    keep_ways(&turns, state->angular_velocity);
    keep_ways(&turns, state->angular_velocity_change);
    change(asked + 3, is_held(def) ? heavier : 0.0, state->angular_velocity_change, state->angular_velocity); /* free bodies turn without: see the header */
    keep_ways(&moves, state->velocity);
    keep_ways(&moves, state->velocity_change);
    change(asked, heavier, state->velocity_change, state->velocity);
    state->virtual_mass = push->met ? 0.0 : push->virtual_mass;
}

/* ---- Poses ---- */

/* How fast a quaternion changes under a spin: half the product of the spin and it. */
static void slope_of(const double spin[3], const double q[4], double slope[4])
{
    double turned[3];
    cross3(spin, q, turned);
    for (int a = 0; a < 3; a++) slope[a] = 0.5 * (spin[a] * q[3] + turned[a]);
    slope[3] = -0.5 * dot3(spin, q);
}

static void normalise(double q[4])
{
    const double length = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    for (int i = 0; i < 4; i++) q[i] /= length;
}

/* The method of Runge and Kutta of order 4 for the rotation alone: the momentum along the ways stays what it is. */
static void turn_part(const Spinner *spinner, const double momentum[3], double q[4], double dt)
{
    static const double ahead[4] = {0.0, 0.5, 0.5, 1.0}, weight[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
    double slope[4] = {0}, sum[4] = {0};
    for (int k = 0; k < 4; k++) {
        double at[4], spin[3];
        for (int i = 0; i < 4; i++) at[i] = q[i] + ahead[k] * dt * slope[i];
        spin_of(spinner, at, momentum, spin);
        slope_of(spin, at, slope);
        for (int i = 0; i < 4; i++) sum[i] += weight[k] * slope[i];
    }
    for (int i = 0; i < 4; i++) q[i] += dt * sum[i];
    normalise(q);
}

static void turn_body(const Spinner *spinner, pbmpm_rigid_state *state, double dt)
{
    double momentum[3] = {0};
    const double angle = sqrt(dot3(state->angular_velocity, state->angular_velocity)) * dt;
    const int parts = (int)fmax(1.0, fmin(MOST_PARTS, ceil(angle / LARGEST_TURN)));
    momentum_of(spinner, state->rotation, state->angular_velocity, momentum);
    for (int i = 0; i < parts && angle > 0.0; i++) turn_part(spinner, momentum, state->rotation, dt / parts);
    spin_of(spinner, state->rotation, momentum, state->angular_velocity);
}

/* The place in the world of a point of the body, from its position. */
static void arm_of(const pbmpm_rigid_state *state, const double own[3], int dimension, double arm[3])
{
    double turn[9], flat[3] = {0};
    memcpy(flat, own, (size_t)dimension * sizeof *flat);
    rotation_from_quaternion(state->rotation, turn);
    to_world(turn, flat, arm);
}

/* Puts the centre of mass back on the line or plane that it moves on: rounding would add up. */
static void keep_on_way(const pbmpm_rigid_def *def, const pbmpm_rigid_state *state, int dimension, double centre[3])
{
    const Ways ways = ways_to_move(def, dimension);
    double away[3] = {0};
    if (def->moves == PBMPM_FREEDOM_ALL) return;
    for (int a = 0; a < dimension; a++) away[a] = centre[a] - state->point[a];
    keep_ways(&ways, away);
    for (int a = 0; a < dimension; a++) centre[a] = state->point[a] + away[a];
}

void rigid_change_pose(const pbmpm_rigid_def *def, pbmpm_rigid_state *state, int dimension, double dt)
{
    const Spinner spinner = spinner_of(def, dimension);
    double centre[3] = {0}, arm[3];
    arm_of(state, def->centre, dimension, arm);
    for (int a = 0; a < dimension; a++) centre[a] = state->position[a] + arm[a] + dt * state->velocity[a];
    turn_body(&spinner, state, dt);
    if (is_held(def)) {
        double lever[3], own[3];
        arm_of(state, def->pivot, dimension, arm);
        for (int a = 0; a < dimension; a++) state->position[a] = state->point[a] - arm[a];
        own_lever(def, dimension, own);
        arm_of(state, own, dimension, lever);
        cross3(state->angular_velocity, lever, state->velocity);
        return;
    }
    keep_on_way(def, state, dimension, centre);
    arm_of(state, def->centre, dimension, arm);
    for (int a = 0; a < dimension; a++) state->position[a] = centre[a] - arm[a];
}

pbmpm_rigid_state rigid_at(const Collider *collider, const pbmpm_rigid_def *def, int dimension)
{
    pbmpm_rigid_state state = {.size = sizeof state};
    double arm[3];
    for (int a = 0; a < dimension; a++) state.position[a] = (double)collider->shape.position[a];
    for (int i = 0; i < 4; i++) state.rotation[i] = (double)collider->shape.rotation[i];
    normalise(state.rotation);
    arm_of(&state, is_held(def) ? def->pivot : def->centre, dimension, arm);
    for (int a = 0; a < dimension; a++) state.point[a] = state.position[a] + arm[a];
    return state;
}

void rigid_follow(const pbmpm_rigid_def *def, pbmpm_rigid_state *state, const double went[6], int dimension)
{
    double arm[3], spin[3] = {went[3], went[4], went[5]}, slope[4];
    arm_of(state, is_held(def) ? def->pivot : def->centre, dimension, arm);
    for (int a = 0; a < dimension; a++) state->position[a] += arm[a] + went[a];
    slope_of(spin, state->rotation, slope);
    for (int i = 0; i < 4; i++) state->rotation[i] += slope[i];
    normalise(state->rotation);
    arm_of(state, is_held(def) ? def->pivot : def->centre, dimension, arm);
    for (int a = 0; a < dimension; a++) state->position[a] -= arm[a];
}
