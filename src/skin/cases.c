#include "skin/cases.h"

#include <stdbool.h>

enum { NO_EDGE = -1 };

static int edge_between(int a, int b)
{
    const int low = a & b, axis = (a ^ b) == 1 ? 0 : (a ^ b) == 2 ? 1 : 2;
    return axis * 4 + (low >> (axis + 1) % 3 & 1) + 2 * (low >> (axis + 2) % 3 & 1);
}

/* The corners of a side, counterclockwise from outside the cube. */
static void go_round(int axis, int end, int corner[4])
{
    static const int ring[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int k = 0; k < 4; k++) {
        const int *at = ring[end ? k : 3 - k];
        corner[k] = end << axis | at[0] << u | at[1] << v;
    }
}

/* Adds the lines of a side: from where a stretch of inside corners begins to where it ends. */
static void cut_side(int inside, const int corner[4], int next[CUBE_EDGES])
{
    for (int k = 0; k < 4; k++) {
        if (inside >> corner[k] & 1 || !(inside >> corner[(k + 1) % 4] & 1)) continue;
        int last = k + 1;
        while (inside >> corner[(last + 1) % 4] & 1) last++;
        next[edge_between(corner[k], corner[(k + 1) % 4])] = edge_between(corner[last % 4], corner[(last + 1) % 4]);
    }
}

static bool share_side(int e, int f)
{
    for (int axis = 0; axis < 3; axis++)
        if (axis != case_axis(e) && axis != case_axis(f) && (case_corner(e) >> axis & 1) == (case_corner(f) >> axis & 1)) return true;
    return false;
}

/* Whether no diagonal from loop[first] lies in a side. */
static bool can_fan(const int *loop, int length, int first)
{
    for (int k = 2; k < length - 1; k++)
        if (share_side(loop[first], loop[(first + k) % length])) return false;
    return true;
}

static void add_fan(Cases *cases, int inside, const int *loop, int length)
{
    int first = 0;
    while (first < length - 1 && !can_fan(loop, length, first)) first++;
    for (int k = 1; k < length - 1; k++) {
        uint8_t *edge = &cases->edge[inside][cases->triangles[inside]++ * 3];
        edge[0] = (uint8_t)loop[first];
        edge[1] = (uint8_t)loop[(first + k) % length];
        edge[2] = (uint8_t)loop[(first + k + 1) % length];
    }
}

static void make_case(Cases *cases, int inside)
{
    int next[CUBE_EDGES], corner[4], loop[CUBE_EDGES];
    for (int e = 0; e < CUBE_EDGES; e++) next[e] = NO_EDGE;
    for (int side = 0; side < 6; side++) {
        go_round(side / 2, side % 2, corner);
        cut_side(inside, corner, next);
    }
    for (int e = 0; e < CUBE_EDGES; e++) {
        int length = 0;
        for (int at = e, after; next[at] != NO_EDGE; at = after) {
            loop[length++] = at;
            after = next[at];
            next[at] = NO_EDGE;
        }
        if (length) add_fan(cases, inside, loop, length);
    }
}

void cases_make(Cases *cases)
{
    *cases = (Cases){0};
    for (int edge = 0; edge < CUBE_EDGES; edge++) {
        const unsigned corner = (unsigned)case_corner(edge);
        cases->corner[edge] = (uint16_t)case_digits(corner & 1, corner >> 1 & 1, corner >> 2);
    }
    for (int inside = 0; inside < CUBE_CASES; inside++) {
        make_case(cases, inside);
        for (int axis = 1; axis < 3; axis++) cases->before[inside][axis] = (uint8_t)(cases->before[inside][axis - 1] + (case_cuts(inside) >> (axis - 1) & 1));
    }
}
