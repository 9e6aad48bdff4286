/* The field of obstacles: what of the surfaces of all colliders and of the domain's walls bounds the space that is open.
 *
 * Obstacles overlap, and stand flush beside and on each other. A face that lies in another obstacle, or on one's face, bounds nothing: taken one by one,
 * the obstacles would press matter into their joints. Here a face counts if the space right before it is open. Around a point in the open the space
 * looks like the one before up to three planes: that of the nearest place on a surface, and in hollow edges and corners those of the others. */
#ifndef PBMPM_SRC_CONTACT_FIELD_H
#define PBMPM_SRC_CONTACT_FIELD_H

#include <math.h>

#include "base/vector.h"
#include "contact/contacts.h"

enum { FIELD_FACES = 3 };

/* [cells] Parents of a node in a hollow lie so far off. */
static const double PARENTS_REACH = 2.5;

/* A plane that bounds the open space. Lengths in cells. */
typedef struct Face {
    double normal[3];  /* into the open */
    double distance;   /* of the point that was asked for: negative behind the plane */
    double foot[3];    /* [m] the place on the surface */
    const Obstacle *obstacle;
} Face;

/* The obstacles that are near enough to matter. */
typedef struct Near {
    double cell_size;
    int dimension, count;
    bool at_end; /* of the substep; else at its start */
    const Obstacle *obstacle[PBMPM_MAX_COLLIDERS + DOMAIN_WALLS];
} Near;

/* Those within `reach` [cells] of `centre` [m]. */
void field_near(Near *near, const ContactFrame *frame, const double centre[3], double reach, bool at_end);

/* Those of them that act on matter of these groups: `near` itself if all do, else `some`. */
const Near *field_meeting(const Near *near, uint32_t groups, Near *some);

/* Leaves those out that do not. */
void field_keep(Near *near, uint32_t groups);

static inline const Solid *field_solid(const Near *near, const Obstacle *o) { return near->at_end ? &o->end : &o->start; }

/* floor() without a call, of what 64 bits hold. */
static inline double field_whole(double value)
{
    const double whole = (double)(int64_t)value;
    return whole > value ? whole - 1.0 : whole;
}

/* The same scene elsewhere has other roundings; they do not get past this. */
static const double FIELD_ROUNDING = 1.0 / 4194304.0;
static inline double field_rounded(double value)
{
    if (!(fabs(value) < 1e12)) return value; /* the world is smaller */
    return field_whole(value / FIELD_ROUNDING + 0.5) * FIELD_ROUNDING;
}

/* How far [cells] the next surface is, negative inside of an obstacle: of the obstacle that the point is deepest in, which need not be the union's. */
double field_distance(const Near *near, const double point[3]);

/* Whether a point is in the union of the obstacles. It may be in none of them, but in a joint: exactly between some that stand flush. */
bool field_holds(const Near *near, const double point[3]);

/* The planes around a point, the nearest first; those beside it lie within `reach` [cells]. 0: none is near, or the point is deeper in obstacles than the
 * spline of a node reaches. */
int field_faces(const Near *near, const double point[3], double reach, Face face[FIELD_FACES]);

/* For a point in a joint: the planes around the place where it came in, at most `reach` [cells] away. 0: it is in none, or deeper. */
int field_joint_faces(const Near *near, const double point[3], double reach, Face face[FIELD_FACES]);

/* The planes that are seen from a place in the open, the nearest to `point` first: that may be behind them. 0: the place is in an obstacle, or sees none. */
int field_faces_from(const Near *near, const double place[3], const double point[3], double reach, Face face[FIELD_FACES]);

/* Whether a face that is seen from `place` stands between it and `point`. */
bool field_is_between(const Near *near, const double place[3], const double point[3], const Face *face);

/* Normals of one baked solid are guesses: planes count as two from 45 degrees on, halfway to an edge. */
static const double SAME_DIRECTION_BAKED = 0.7;

/* Whether two planes count as one, the nearest. Exact normals have to differ by SAME_DIRECTION: of a blunter inner edge the stretch where matter is close to both planes
 * would be as long as a block. Blunter ones are rounded, see walls_find.c. */
static inline bool field_same_way(const Face *a, const Face *b)
{
    const bool guessed = a->obstacle == b->obstacle && a->obstacle->start.grid;
    return dot3(a->normal, b->normal) > (guessed ? SAME_DIRECTION_BAKED : SAME_DIRECTION);
}

/* Of the obstacles that a point is in, the surface that is nearest, walls of the domain first: where they overlap too far for field_faces(). False: it is in none. */
bool field_surface(const Near *near, const double point[3], Face *face);

/* Other faces of the box that face[0] belongs to, within `reach`, where the point is in that box: at an outer edge the space is open beyond them, too. Written
 * behind the `count` first; returns how many there are in all. */
int field_outer_faces(const Near *near, const double point[3], double reach, Face face[FIELD_FACES], int count);

/* In a thin wall the nearest face may be that on the dry side: the open face opposite to `face`, seen from a point in the wall. False: none within the reach of a
 * node's spline. */
bool field_opposite(const Near *near, const double point[3], const Face *face, Face *other);

/* The integral of the quadratic spline from -1.5 to x: the share of a node's weight that is open, x cells before a plane. */
double field_spline_below(double x);

/* The quadratic spline, x cells from its node. */
double field_spline(double x);

/* The share of a node's weight that is open. Farther than `deepest` [cells] behind a face the same is taken to be open as there. `known`: the planes around it, if the
 * caller has them, `count` of them; else null. `one_sided`: what is open behind the first of them, across a thin wall, does not count. */
double field_open_share(const Near *near, const double point[3], double deepest, const Face *known, int count, bool one_sided);

#endif
