#include "contact/obstacles.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

double obstacle_distance(const Obstacle *o, const double point[3], double normal[3]) { return solid_distance(&o->end, point, normal); }

void obstacle_set_turn(Obstacle *o)
{
    memset(o->turn, 0, sizeof o->turn);
    for (int r = 0; r < 3; r++)
        for (int c = 0; c < 3; c++)
            for (int k = 0; k < 3; k++) o->turn[r * 3 + c] += o->end.rotation[r * 3 + k] * o->start.rotation[c * 3 + k];
}

double obstacle_breadth(const Obstacle *obstacle)
{
    const Solid *s = &obstacle->end;
    if (obstacle->wall) return INFINITY;
    return s->grid ? s->grid->spacing : solid_breadth(s);
}

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

static void yields_along(const double way[][6], int ways, const double push[6], double change[6])
{
    memset(change, 0, 6 * sizeof *change);
    for (int k = 0; k < ways; k++) {
        double along = 0.0;
        for (int a = 0; a < 6; a++) along += way[k][a] * push[a];
        for (int a = 0; a < 6; a++) change[a] += along * way[k][a];
    }
}

void free_body_yields(const FreeBody *body, const double push[6], double change[6]) { yields_along(body->way, body->ways, push, change); }

void free_body_yields_openly(const FreeBody *body, const double push[6], double change[6]) { yields_along(body->open, body->ways, push, change); }

/* In the coordinates of the ways, where the inertia is 1: open -= (open h) h^T, h the unit vector along open^T unit. */
void free_body_hold(FreeBody *body, const double unit[6])
{
    static const double HELD = 1e-12; /* share of its square that is left of a direction which is held already: rounding */
    double h[FREE_BODY_WAYS] = {0}, moved[6] = {0}, size2 = 0.0, whole2 = 0.0, late = 0.0;
    for (int k = 0; k < body->ways; k++) {
        double whole = 0.0;
        for (int a = 0; a < 6; a++) {
            h[k] += body->open[k][a] * unit[a];
            whole += body->way[k][a] * unit[a];
        }
        size2 += h[k] * h[k];
        whole2 += whole * whole;
    }
    if (size2 <= HELD * whole2) return;
    for (int k = 0; k < body->ways; k++)
        for (int a = 0; a < 6; a++) moved[a] += body->open[k][a] * h[k] / size2;
    for (int k = 0; k < body->ways; k++)
        for (int a = 0; a < 6; a++) body->open[k][a] -= moved[a] * h[k];
    for (int a = 0; a < 6; a++) late += unit[a] * body->delayed[a];
    for (int a = 0; a < 6; a++) body->delayed[a] -= late * moved[a];
}

/* By the angle whose half has the turn's half for its tangent. */
void solid_displace(Solid *solid, const double centre[3], const double way[6])
{
    const double q[4] = {0.5 * way[3], 0.5 * way[4], 0.5 * way[5], 1.0};
    double turn[9], before[9], arm[3];
    rotation_from_quaternion(q, turn);
    memcpy(before, solid->rotation, sizeof before);
    for (int a = 0; a < 3; a++) arm[a] = a < solid->dimension ? solid->position[a] - centre[a] : 0.0;
    for (int r = 0; r < 3; r++) {
        if (r < solid->dimension) solid->position[r] = centre[r] + way[r] + dot3(turn + 3 * r, arm);
        for (int c = 0; c < 3; c++) solid->rotation[3 * r + c] = turn[3 * r] * before[c] + turn[3 * r + 1] * before[3 + c] + turn[3 * r + 2] * before[6 + c];
    }
}
