#include "contact/field.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"
#include "shape/tangent_planes.h"

/* How far before an exact face [cells] the space must be open. By trial. */
static const double BEFORE = 0.1;
/* Surfaces that are meant to meet differ by rounding: what is nearer than this [cells] is on a surface. And what is farther off than that is clear of it. */
static const double ON_SURFACE = 1e-3, CLEAR_OF = 0.01;

/* point + length [cells] * normal */
static void ahead(const Near *near, const double point[3], double length, const double normal[3], double out[3])
{
    for (int a = 0; a < 3; a++) out[a] = point[a] + length * near->cell_size * normal[a];
}

void field_near(Near *near, const ContactFrame *frame, const double centre[3], double reach, bool at_end)
{
    near->cell_size = frame->cell_size;
    near->dimension = frame->grid->dimension;
    near->at_end = at_end;
    near->count = 0;
    for (int i = 0; i < frame->colliders->obstacle_count; i++) {
        const Obstacle *o = &frame->colliders->obstacle[i];
        if (solid_least(field_solid(near, o), centre) <= reach * near->cell_size) near->obstacle[near->count++] = o;
    }
}

const Near *field_meeting(const Near *near, uint32_t groups, Near *some)
{
    int meet = 0;
    if (groups == ALL_GROUPS) return near;
    for (int i = 0; i < near->count; i++) meet += obstacle_meets(near->obstacle[i], groups);
    if (meet == near->count) return near;
    some->cell_size = near->cell_size;
    some->dimension = near->dimension;
    some->at_end = near->at_end;
    some->count = near->count;
    memcpy(some->obstacle, near->obstacle, (size_t)near->count * sizeof near->obstacle[0]);
    field_keep(some, groups);
    return some;
}

void field_keep(Near *near, uint32_t groups)
{
    int kept = 0;
    for (int i = 0; i < near->count; i++)
        if (obstacle_meets(near->obstacle[i], groups)) near->obstacle[kept++] = near->obstacle[i];
    near->count = kept;
}

double field_distance(const Near *near, const double point[3])
{
    double least = INFINITY;
    for (int i = 0; i < near->count; i++) {
        const double distance = solid_gap(field_solid(near, near->obstacle[i]), point);
        least = distance < least ? distance : least;
    }
    return least / near->cell_size;
}

/* Half a step of the grid of a baked solid [cells]: by so much its edges are rounded. 0 for other solids, which are exact. */
static double rounding_of(const Near *near, const Obstacle *o)
{
    const DistanceGrid *grid = field_solid(near, o)->grid;
    return grid ? 0.5 * grid->spacing / near->cell_size : 0.0;
}

static bool is_open(const Near *near, const double point[3])
{
    for (int i = 0; i < near->count; i++)
        if (solid_gap(field_solid(near, near->obstacle[i]), point) <= ON_SURFACE * near->cell_size) return false;
    return true;
}

/* Moves a place to where the surface of a solid seems to be; the normal is that before it moved. */
static void to_surface(const Near *near, const Obstacle *o, double place[3], double normal[3])
{
    const double distance = solid_distance(field_solid(near, o), place, normal) / near->cell_size;
    ahead(near, place, -distance, normal, place);
}

/* Axes along a face with this normal. */
static void axes_along(int dimension, const double normal[3], double along[2][3])
{
    int least = 0;
    double axis[3] = {0};
    for (int a = 1; a < 3; a++) least = fabs(normal[a]) < fabs(normal[least]) ? a : least;
    axis[dimension == 3 ? least : 2] = 1.0;
    cross3(normal, axis, along[0]);
    const double size = sqrt(dot3(along[0], along[0]));
    for (int a = 0; a < 3; a++) along[0][a] /= size;
    cross3(normal, along[0], along[1]);
}

/* At an edge the grid of distances has normals between those of the faces that meet there: walls that lean so drove water at their feet at up to 0.8 m/s. So a face has to
 * go on a step and a half of the grid beside a place on it, along each of its axes: where it does to one side alone, it is taken from there. False: it does not. */
static bool leave_edge(const Near *near, const Obstacle *o, double place[3], double normal[3])
{
    static const double GOES_ON = 0.9; /* cosine: at an edge of a right angle it is 0.7, on a ball whose radius is three steps 0.94 */
    static const double PAST_CELL = 1.5; /* grid steps: from anywhere in the grid's cell at the edge a place beyond it */
    const double step = PAST_CELL * field_solid(near, o)->grid->spacing / near->cell_size;
    double along[2][3];
    axes_along(near->dimension, normal, along);
    for (int k = 0; k + 1 < near->dimension; k++) {
        double beside[2][3], there[2][3];
        bool goes_on[2];
        for (int side = 0; side < 2; side++) {
            ahead(near, place, side == 0 ? -step : step, along[k], beside[side]);
            to_surface(near, o, beside[side], there[side]);
            goes_on[side] = dot3(there[side], normal) >= GOES_ON;
        }
        if (!goes_on[0] && !goes_on[1]) return false;
        if (goes_on[0] && goes_on[1]) continue;
        memcpy(normal, there[goes_on[1]], sizeof there[0]);
        memcpy(place, beside[goes_on[1]], sizeof beside[0]);
    }
    return true;
}

/* Whether a place near the surface of a solid is at an edge that a grid of distances rounds off. */
static bool is_at_edge(const Near *near, const Obstacle *o, const double place[3])
{
    double there[3] = {place[0], place[1], place[2]}, normal[3], before[3];
    if (fabs(solid_distance(field_solid(near, o), place, normal)) > rounding_of(near, o) * near->cell_size) return false;
    memcpy(before, normal, sizeof before);
    return !leave_edge(near, o, there, normal) || memcmp(before, normal, sizeof before) != 0;
}

/* Whether the space is open before a place where these faces meet. A face may lie farther out by as much as the edge there is rounded. At the rounded edge of another solid, which is
 * flush with a face, the space seems open just before it: a step of its grid farther off it has its true distance again. */
static bool is_open_before(const Near *near, const double place[3], const Face *const *face, int count)
{
    double rounded[PBMPM_MAX_COLLIDERS + DOMAIN_WALLS], owners = 0.0;
    for (int i = 0; i < near->count; i++) {
        const Obstacle *o = near->obstacle[i];
        rounded[i] = field_solid(near, o)->grid && is_at_edge(near, o, place) ? rounding_of(near, o) : 0.0;
        for (int k = 0; k < count; k++) owners = face[k]->obstacle == o ? fmax(owners, rounded[i]) : owners;
    }
    for (int i = 0; i < near->count; i++) {
        const double length = BEFORE + fmax(owners, 2.0 * rounded[i]);
        double before[3] = {place[0], place[1], place[2]};
        for (int k = 0; k < count; k++) ahead(near, before, length, face[k]->normal, before);
        if (solid_gap(field_solid(near, near->obstacle[i]), before) <= ON_SURFACE * near->cell_size) return false;
    }
    return true;
}

static double distance_to(const Near *near, const Face *face, const double point[3])
{
    double sum = 0.0;
    for (int a = 0; a < 3; a++) sum += (point[a] - face->foot[a]) * face->normal[a];
    return sum / near->cell_size;
}

/* ---- Faces of single obstacles ---- */

static Face face_at(const Near *near, const Obstacle *o, const double point[3], double distance, const double normal[3])
{
    Face face = {.distance = distance, .obstacle = o};
    memcpy(face.normal, normal, sizeof face.normal);
    ahead(near, point, -distance, normal, face.foot);
    return face;
}

/* Coordinates of a point along the axes of a box. */
static void along_axes(const Solid *s, const double point[3], double local[3])
{
    local[0] = local[1] = local[2] = 0.0;
    for (int a = 0; a < s->dimension; a++)
        for (int b = 0; b < s->dimension; b++) local[a] += s->rotation[3 * b + a] * (point[b] - s->position[b]);
}

static void box_normal(const Solid *s, int axis, double side, double normal[3])
{
    normal[0] = normal[1] = normal[2] = 0.0;
    for (int a = 0; a < s->dimension; a++) normal[a] = side * s->rotation[3 * a + axis];
}

/* Faces within reach whose plane may bound the space around a point in or behind obstacles. */
enum { CANDIDATES = 32 };

static int box_faces(const Near *near, const Obstacle *o, const double point[3], double reach, Face *face, int room)
{
    const Solid *s = field_solid(near, o);
    double local[3], normal[3];
    int count = 0;
    along_axes(s, point, local);
    for (int axis = 0; axis < s->dimension; axis++)
        for (double side = -1.0; side < 2.0; side += 2.0) {
            const double distance = (side * local[axis] - s->half_extents[axis]) / near->cell_size;
            if (fabs(distance) > reach || count == room) continue;
            box_normal(s, axis, side, normal);
            face[count++] = face_at(near, o, point, distance, normal);
        }
    return count;
}

static bool is_known(const Face *face, int count, const double normal[3])
{
    bool known = false;
    for (int i = 0; i < count; i++) known = known || dot3(face[i].normal, normal) > SAME_DIRECTION;
    return known;
}

/* The plane through a place on a solid, seen from a point. */
static Face plane_through(const Near *near, const Obstacle *o, const double point[3], const double place[3], const double normal[3])
{
    double way[3];
    for (int a = 0; a < 3; a++) way[a] = (point[a] - place[a]) / near->cell_size;
    return face_at(near, o, point, dot3(way, normal), normal);
}

/* The faces of a baked solid that are nearest to a point, and to places a reach away in each direction: where the nearest face lies on a floor, another one bounds the
 * space. What is rounder than the grid tells has its nearest face alone. */
static int baked_faces(const Near *near, const Obstacle *o, const double point[3], double reach, Face *face, int room)
{
    static const double STEPS[3] = {0.0, -1.0, 1.0};
    const int ways = near->dimension == 3 ? 27 : 9;
    int count = 0;
    for (int way = 0; way < ways && count < room; way++) {
        const double offset[3] = {reach * STEPS[way % 3], reach * STEPS[way / 3 % 3], reach * STEPS[way / 9]};
        double place[3], normal[3];
        ahead(near, point, 1.0, offset, place);
        to_surface(near, o, place, normal);
        if (is_known(face, count, normal)) continue;
        to_surface(near, o, place, normal); /* behind a ridge the first normal was one between those of its faces */
        if (!leave_edge(near, o, place, normal)) continue;
        const Face found = plane_through(near, o, point, place, normal);
        if (fabs(found.distance) <= reach && !is_known(face, count, normal)) face[count++] = found;
    }
    if (count > 0 || room == 0) return count;
    double normal[3];
    const double distance = solid_distance(field_solid(near, o), point, normal) / near->cell_size;
    if (fabs(distance) <= reach) face[count++] = face_at(near, o, point, distance, normal);
    return count;
}

static int faces_around(const Near *near, const double point[3], double reach, Face *face)
{
    int count = 0;
    for (int i = 0; i < near->count; i++) {
        const Obstacle *o = near->obstacle[i];
        double normal[3];
        const double distance = solid_distance(field_solid(near, o), point, normal) / near->cell_size;
        if (distance > reach) continue;
        if (field_solid(near, o)->kind == PBMPM_BOX)
            count += box_faces(near, o, point, reach, face + count, CANDIDATES - count);
        else if (field_solid(near, o)->grid)
            count += baked_faces(near, o, point, reach, face + count, CANDIDATES - count);
        else if (fabs(distance) <= reach && count < CANDIDATES)
            face[count++] = face_at(near, o, point, distance, normal);
    }
    return count;
}

/* Whether a place on the plane of a face lies on the face; those of round solids are tangent planes. */
static bool is_on_face(const Near *near, const Face *face, const double place[3])
{
    const Solid *s = field_solid(near, face->obstacle);
    const bool flat = s->kind == PBMPM_BOX || s->grid;
    return !flat || fabs(solid_gap(s, place)) <= fmax(ON_SURFACE, rounding_of(near, face->obstacle)) * near->cell_size;
}

static bool bounds_space(const Near *near, const Face *face)
{
    return is_on_face(near, face, face->foot) && is_open_before(near, face->foot, &face, 1);
}

/* Of a point, in cells: the distances of the two obstacles that it is deepest in, and by how much the surfaces there may be off. */
typedef struct Depths {
    double least, second, tolerance;
} Depths;

static Depths depths_at(const Near *near, const double point[3])
{
    Depths depths = {INFINITY, INFINITY, ON_SURFACE};
    for (int i = 0; i < near->count; i++) {
        const Obstacle *o = near->obstacle[i];
        const double gap = solid_gap(field_solid(near, o), point) / near->cell_size, rounding = rounding_of(near, o);
        depths.second = fmin(depths.second, fmax(depths.least, gap));
        depths.least = fmin(depths.least, gap);
        if (gap <= rounding) depths.tolerance = fmax(depths.tolerance, rounding);
    }
    return depths;
}

/* Whether faces of two obstacles lie on each other near a point. */
static bool is_by_flush_faces(const Near *near, const double point[3], double tolerance)
{
    Face all[CANDIDATES];
    const int count = faces_around(near, point, NODE_REACH, all);
    for (int i = 0; i < count; i++)
        for (int j = i + 1; j < count; j++) {
            const Face *a = &all[i], *b = &all[j];
            if (a->obstacle == b->obstacle || dot3(a->normal, b->normal) > -SAME_DIRECTION) continue;
            if (fabs(a->distance) > tolerance || fabs(a->distance + b->distance) > CLEAR_OF) continue;
            if (is_on_face(near, a, a->foot) && is_on_face(near, b, b->foot)) return true;
        }
    return false;
}

/* Obstacles that stand flush end at their joint, which is inside of their union. There no surface that is within the tolerance has the space open before it. Slits and
 * wedges have such surfaces, too, but no faces that lie on each other: there matter stays. */
static bool is_in_joint(const Near *near, const double point[3], const Depths *depths)
{
    if (depths->least < -depths->tolerance || depths->second > depths->tolerance) return false;
    for (int i = 0; i < near->count; i++) {
        const Obstacle *o = near->obstacle[i];
        double normal[3];
        const double distance = solid_distance(field_solid(near, o), point, normal) / near->cell_size;
        const Face nearest = face_at(near, o, point, distance, normal), *face = &nearest;
        if (distance <= depths->tolerance && is_open_before(near, nearest.foot, &face, 1)) return false;
    }
    return is_by_flush_faces(near, point, depths->tolerance);
}

bool field_holds(const Near *near, const double point[3])
{
    const Depths depths = depths_at(near, point);
    return depths.least < 0.0 || is_in_joint(near, point, &depths);
}

/* ---- Inside: the shallowest way out ---- */

/* The place nearest to a point that lies on `count` planes, relative to the point [cells]: sum_i x_i n_i with n_j . sum_i x_i n_i = -d_j. False: they are nearly
 * parallel. */
static bool meet(const Face *const *face, int count, double place[3])
{
    double g[3][4];
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++) g[i][j] = dot3(face[i]->normal, face[j]->normal);
        g[i][count] = -face[i]->distance;
    }
    for (int i = 0; i < count; i++) { /* the matrix is positive definite */
        if (g[i][i] < 0.04) return false;
        for (int r = i + 1; r < count; r++)
            for (int c = count; c >= i; c--) g[r][c] -= g[r][i] / g[i][i] * g[i][c];
    }
    place[0] = place[1] = place[2] = 0.0;
    for (int i = count - 1; i >= 0; i--) {
        for (int c = i + 1; c < count; c++) g[i][count] -= g[i][c] * g[c][count];
        g[i][count] /= g[i][i];
        for (int a = 0; a < 3; a++) place[a] += g[i][count] * face[i]->normal[a];
    }
    return true;
}

/* A hollow edge or corner of these faces; its distance from the point, or infinity where the faces do not meet in the open. */
static double corner_distance(const Near *near, const double point[3], const Face *const *face, int count)
{
    double way[3], place[3];
    if (!meet(face, count, way)) return INFINITY;
    ahead(near, point, 1.0, way, place);
    for (int i = 0; i < count; i++)
        if (!is_on_face(near, face[i], place)) return INFINITY;
    return is_open_before(near, place, face, count) ? sqrt(dot3(way, way)) : INFINITY;
}

static int faces_inside(const Near *near, const double point[3], const Depths *depths, double reach, Face face[FIELD_FACES])
{
    const double tolerance = depths->tolerance; /* what is no farther before a surface is behind it */
    Face all[CANDIDATES];
    const int candidates = faces_around(near, point, reach, all);
    double best = INFINITY;
    int count = 0;
    for (int i = 0; i < candidates; i++) {
        if (all[i].distance > ON_SURFACE || -all[i].distance >= best || !bounds_space(near, &all[i])) continue;
        best = -all[i].distance;
        face[0] = all[i];
        count = 1;
    }
    for (int i = 0; i < candidates; i++)
        for (int j = i + 1; j < candidates; j++) {
            const Face *edge[3] = {&all[i], &all[j], NULL};
            if (all[i].distance > tolerance || all[j].distance > tolerance) continue;
            if (fmax(-all[i].distance, -all[j].distance) >= best) continue;
            double distance = corner_distance(near, point, edge, 2);
            if (distance < best - ON_SURFACE) {
                best = distance;
                face[0] = all[i];
                face[1] = all[j];
                count = 2;
            }
            for (int k = j + 1; k < candidates && near->dimension == 3; k++) {
                edge[2] = &all[k];
                if (all[k].distance > tolerance || -all[k].distance >= best) continue;
                distance = corner_distance(near, point, edge, 3);
                if (distance >= best - ON_SURFACE) continue;
                best = distance;
                face[0] = all[i];
                face[1] = all[j];
                face[2] = all[k];
                count = 3;
            }
        }
    return count;
}

/* ---- Outside: what is seen ---- */

/* How far beside an edge [cells] an obstacle is asked whether the space is open there: past the rounding of its own edges. */
static double beside_edge(const Near *near, const Obstacle *o) { return BEFORE + rounding_of(near, o); }

/* Whether other obstacles leave the space open beside an edge, before each of the two faces that meet there. */
static bool is_edge_open(const Near *near, const double edge[3], const Face *const face[2])
{
    for (int i = 0; i < near->count; i++) {
        const Obstacle *o = near->obstacle[i];
        const double length = beside_edge(near, o);
        if (o == face[0]->obstacle) continue;
        for (int before = 0; before < 2; before++) {
            double beside[3] = {edge[0], edge[1], edge[2]};
            for (int k = 0; k < 2; k++) ahead(near, beside, k == before ? length : -length, face[k]->normal, beside);
            if (solid_gap(field_solid(near, o), beside) <= ON_SURFACE * near->cell_size) return false;
        }
    }
    return true;
}

/* Whether other obstacles hide the edge of a baked solid that `nearest` lies on. `all`: its faces there. */
static bool is_edge_hidden(const Near *near, const Face *nearest, const Face *all, int count)
{
    const double step = 2.0 * rounding_of(near, nearest->obstacle) * near->cell_size; /* so far a place on a rounded edge may be from the edge */
    for (int i = 0; i < count; i++)
        for (int j = i + 1; j < count; j++) {
            const Face *edge[2] = {&all[i], &all[j]};
            double way[3], place[3], off[3];
            if (!meet(edge, 2, way)) continue;
            for (int a = 0; a < 3; a++) {
                place[a] = all[i].foot[a] + (all[i].distance * all[i].normal[a] + way[a]) * near->cell_size; /* from the point that both were seen from */
                off[a] = place[a] - nearest->foot[a];
            }
            if (dot3(off, off) <= step * step && is_on_face(near, &all[i], place) && !is_edge_open(near, place, edge)) return true;
        }
    return false;
}

/* Whether the nearest place of an exact obstacle, seen from outside, is one that matter may meet: on a face that is open, or on an edge both of whose faces are. The edge of
 * a tile beside another one is none. */
static bool is_exposed(const Near *near, const Face *face, const double point[3])
{
    const Solid *s = field_solid(near, face->obstacle);
    double before[3], local[3];
    int outside = 0;
    if (face->distance > BEFORE && !is_open_before(near, face->foot, &face, 1)) return false;
    if (s->kind != PBMPM_BOX) return true;
    along_axes(s, point, local);
    for (int a = 0; a < s->dimension; a++) outside += fabs(local[a]) > s->half_extents[a] + ON_SURFACE * near->cell_size;
    for (int axis = 0; axis < s->dimension && outside > 1; axis++) {
        if (fabs(local[axis]) <= s->half_extents[axis]) continue;
        memcpy(before, face->foot, sizeof before);
        for (int other = 0; other < s->dimension; other++) {
            double normal[3];
            if (fabs(local[other]) <= s->half_extents[other]) continue;
            box_normal(s, other, local[other] < 0.0 ? -1.0 : 1.0, normal);
            ahead(near, before, other == axis ? BEFORE : -BEFORE, normal, before);
        }
        if (!is_open(near, before)) return false;
    }
    return true;
}

/* Adds a plane unless one that faces the same way is nearer. */
static int add_face(Face face[FIELD_FACES], int count, const Face *seen, int most)
{
    for (int i = 0; i < count; i++) {
        if (!field_same_way(&face[i], seen)) continue;
        if (seen->distance < face[i].distance) face[i] = *seen;
        return count;
    }
    if (count < most) {
        face[count] = *seen;
        return count + 1;
    }
    int farthest = 0;
    for (int i = 1; i < count; i++)
        if (face[i].distance > face[farthest].distance) farthest = i;
    if (seen->distance < face[farthest].distance) face[farthest] = *seen;
    return count;
}

/* The nearest face of a baked solid, and those of its hollows. Where a point is as near to two of these, the grid of distances has a normal between them, and its foot is on
 * no surface: then it is left out. */
static int add_baked(const Near *near, const Face *first, const double point[3], double reach, Face face[FIELD_FACES], int count)
{
    const int most = near->dimension;
    const Solid *s = field_solid(near, first->obstacle);
    Plane plane[PLANES_MAX];
    const Plane nearest = {.normal = {first->normal[0], first->normal[1], first->normal[2]}, .gap = first->distance};
    const int planes = tangent_planes(s, near->cell_size, point, &nearest, reach, plane);
    const bool between = planes > 2 && fabs(solid_gap(s, first->foot)) > rounding_of(near, first->obstacle) * near->cell_size;
    if (!between) count = add_face(face, count, first, most);
    for (int i = 1; i < planes; i++) {
        const Face hollow = face_at(near, first->obstacle, point, plane[i].gap, plane[i].normal);
        count = add_face(face, count, &hollow, most);
    }
    return count;
}

/* Whether the foot on one of the faces of a baked solid lies beyond an outer edge of it. Its distance does not tell, if that is less than edges are rounded: but farther from there the
 * distance grows, while along an inner edge the face goes on. */
static bool is_beyond_edge(const Near *near, const Face *all, int count, const Face *face)
{
    const Solid *s = field_solid(near, face->obstacle);
    const double rounding = rounding_of(near, face->obstacle);
    for (int j = 0; j < count; j++) {
        const double before = distance_to(near, &all[j], face->foot);
        double farther[3];
        if (before <= ON_SURFACE || before > rounding || dot3(all[j].normal, face->normal) > SAME_DIRECTION) continue;
        ahead(near, face->foot, 2.0 * rounding, all[j].normal, farther);
        if (solid_gap(s, farther) > rounding * near->cell_size) return true;
    }
    return false;
}

/* What is seen of a baked solid: its nearest face, and those of hollows. Where the nearest place is on an edge that others hide, that has a normal between those of the faces: then the
 * faces, none of which a point in the open is behind by more than edges are rounded. */
static int add_seen_of_baked(const Near *near, const Face *nearest, const double point[3], double reach, Face face[FIELD_FACES], int count)
{
    const bool open = is_open_before(near, nearest->foot, &nearest, 1);
    const bool rounded = near->count > 1 && is_at_edge(near, nearest->obstacle, nearest->foot);
    if (open && !rounded) return add_baked(near, nearest, point, reach, face, count);
    Face all[CANDIDATES];
    const int candidates = baked_faces(near, nearest->obstacle, point, fmin(reach, PARENTS_REACH), all, CANDIDATES);
    if (open && !is_edge_hidden(near, nearest, all, candidates)) return add_baked(near, nearest, point, reach, face, count);
    for (int i = 0; i < candidates; i++)
        if (all[i].distance >= -rounding_of(near, nearest->obstacle) && bounds_space(near, &all[i]) && !is_beyond_edge(near, all, candidates, &all[i]))
            count = add_face(face, count, &all[i], near->dimension);
    return count;
}

/* The planes that are seen from a point in the open. The foot on one may lie behind another: then their edge has to be open. */
static int faces_seen(const Near *near, const double point[3], double reach, Face face[FIELD_FACES])
{
    Face hidden[CANDIDATES];
    int count = 0, hides = 0;
    for (int i = 0; i < near->count; i++) {
        const Obstacle *o = near->obstacle[i];
        double normal[3];
        const double distance = solid_distance(field_solid(near, o), point, normal) / near->cell_size;
        if (distance > reach) continue;
        const Face seen = face_at(near, o, point, distance, normal);
        if (field_solid(near, o)->grid)
            count = add_seen_of_baked(near, &seen, point, reach, face, count);
        else if (is_exposed(near, &seen, point))
            count = add_face(face, count, &seen, near->dimension);
        else if (hides < CANDIDATES)
            hidden[hides++] = seen;
    }
    const int seen = count;
    for (int i = 0; i < hides; i++)
        for (int k = 0; k < seen; k++) {
            const Face *edge[2] = {&hidden[i], &face[k]};
            if (hidden[i].obstacle == face[k].obstacle) continue;
            if (dot3(hidden[i].normal, face[k].normal) >= 0.0 && corner_distance(near, point, edge, 2) <= reach) count = add_face(face, count, &hidden[i], near->dimension);
        }
    return count;
}

/* The reflection of a point in the planes that it is behind, clear of them. */
static void reflect(const Near *near, const Face *face, int count, double point[3])
{
    for (int i = 0; i < count; i++) {
        const double distance = distance_to(near, &face[i], point);
        if (distance <= ON_SURFACE) ahead(near, point, -2.0 * distance + CLEAR_OF, face[i].normal, point);
    }
}

static void swap_faces(Face *a, Face *b)
{
    const Face swap = *a;
    *a = *b;
    *b = swap;
}

static void sort_by_distance(Face *face, int begin, int count)
{
    for (int i = begin; i < count; i++)
        for (int j = i + 1; j < count; j++)
            if (face[j].distance < face[i].distance) swap_faces(&face[i], &face[j]);
}

/* Behind an inner edge of a baked solid the nearest place is the edge, where faces meet that are seen from before it. */
static bool is_edge(const Near *near, const Face *nearest, const Face *seen, int count)
{
    const double rounding = rounding_of(near, nearest->obstacle);
    int meet = 0;
    for (int i = 0; i < count && rounding > 0.0; i++) meet += fabs(distance_to(near, &seen[i], nearest->foot)) < rounding;
    return meet > 1;
}

/* Adds what is seen from the reflection of a point in an obstacle. */
static int add_beside(const Near *near, const double point[3], double reach, Face face[FIELD_FACES], int count)
{
    int first = count;
    double open[3] = {point[0], point[1], point[2]};
    Face around[FIELD_FACES];
    for (int tries = 0; tries < 3 && field_distance(near, open) <= ON_SURFACE; tries++) reflect(near, face, count, open);
    if (field_distance(near, open) <= ON_SURFACE) return count;
    const int seen = faces_seen(near, open, reach, around);
    if (is_edge(near, &face[0], around, seen)) first = count = 0;
    for (int i = 0; i < seen; i++) {
        bool known = count == near->dimension;
        for (int k = 0; k < count && !known; k++) known = field_same_way(&around[i], &face[k]);
        if (known) continue;
        around[i].distance = distance_to(near, &around[i], point);
        face[count++] = around[i];
    }
    sort_by_distance(face, first, count);
    return count;
}

int field_faces(const Near *near, const double point[3], double reach, Face face[FIELD_FACES])
{
    const Depths depths = depths_at(near, point);
    const bool outside = depths.least > ON_SURFACE && !is_in_joint(near, point, &depths);
    const int count = outside ? faces_seen(near, point, reach, face) : faces_inside(near, point, &depths, NODE_REACH, face);
    if (outside) sort_by_distance(face, 0, count);
    return outside || count == 0 ? count : add_beside(near, point, reach, face, count);
}

int field_joint_faces(const Near *near, const double point[3], double reach, Face face[FIELD_FACES])
{
    const Depths depths = depths_at(near, point);
    return is_in_joint(near, point, &depths) ? faces_inside(near, point, &depths, reach + depths.tolerance, face) : 0;
}

int field_faces_from(const Near *near, const double place[3], const double point[3], double reach, Face face[FIELD_FACES])
{
    if (field_distance(near, place) <= ON_SURFACE) return 0;
    const int count = faces_seen(near, place, reach, face);
    for (int i = 0; i < count; i++) face[i].distance = distance_to(near, &face[i], point);
    int behind = 0; /* those that the point is behind come first, in the order of their obstacles, as in field_faces() */
    for (int i = 0; i < count; i++)
        if (face[i].distance <= ON_SURFACE) {
            for (int k = i; k > behind; k--) swap_faces(&face[k], &face[k - 1]);
            behind++;
        }
    sort_by_distance(face, behind, count);
    return count;
}

bool field_is_between(const Near *near, const double place[3], const double point[3], const Face *face)
{
    const double before = distance_to(near, face, place), behind = distance_to(near, face, point);
    double hit[3];
    if (before <= 0.0 || behind >= 0.0) return false;
    for (int a = 0; a < 3; a++) hit[a] = place[a] + (point[a] - place[a]) * before / (before - behind);
    return solid_gap(field_solid(near, face->obstacle), hit) <= BEFORE * near->cell_size;
}

bool field_surface(const Near *near, const double point[3], Face *face)
{
    bool found = false;
    for (int i = 0; i < near->count; i++) {
        const Obstacle *o = near->obstacle[i];
        double normal[3];
        const double distance = solid_distance(field_solid(near, o), point, normal) / near->cell_size;
        const bool nearer = !found || (o->wall && !face->obstacle->wall) || (o->wall == face->obstacle->wall && distance > face->distance);
        if (distance >= 0.0 || !nearer) continue;
        *face = face_at(near, o, point, distance, normal);
        found = true;
    }
    return found;
}

int field_outer_faces(const Near *near, const double point[3], double reach, Face face[FIELD_FACES], int count)
{
    Face all[2 * 3];
    const Obstacle *o = face[0].obstacle;
    if (count == 0 || field_solid(near, o)->kind != PBMPM_BOX || face[0].distance >= 0.0) return count;
    const int faces = box_faces(near, o, point, reach, all, 2 * near->dimension);
    for (int i = 0; i < faces; i++) {
        bool known = all[i].distance > 0.0 || count == near->dimension;
        for (int k = 0; k < count && !known; k++) known = fabs(dot3(all[i].normal, face[k].normal)) > SAME_DIRECTION;
        if (!known && bounds_space(near, &all[i])) face[count++] = all[i];
    }
    return count;
}

bool field_opposite(const Near *near, const double point[3], const Face *face, Face *other)
{
    Face all[CANDIDATES];
    const int candidates = faces_around(near, point, NODE_REACH, all);
    bool found = false;
    for (int i = 0; i < candidates; i++) {
        if (all[i].distance > 0.5 || dot3(all[i].normal, face->normal) > -SAME_DIRECTION || !bounds_space(near, &all[i])) continue;
        if (found && all[i].distance <= other->distance) continue;
        *other = all[i];
        found = true;
    }
    if (found || !field_solid(near, face->obstacle)->grid) return found;
    for (double way = 0.5; way <= NODE_REACH && !found; way += 0.5) { /* through the skin of a baked solid */
        double beyond[3], normal[3];
        ahead(near, point, -way, face->normal, beyond);
        const double distance = solid_distance(field_solid(near, face->obstacle), beyond, normal) / near->cell_size;
        if (distance <= 0.0 || dot3(normal, face->normal) > -SAME_DIRECTION) continue;
        *other = face_at(near, face->obstacle, beyond, distance, normal);
        other->distance = distance_to(near, other, point);
        found = is_open(near, beyond);
    }
    return found;
}

/* ---- Open shares ---- */

double field_spline_below(double x)
{
    if (x >= NODE_REACH) return 1.0;
    if (x <= -NODE_REACH) return 0.0;
    const double rest = NODE_REACH - fabs(x);
    if (x > 0.5) return 1.0 - rest * rest * rest / 6.0;
    if (x < -0.5) return rest * rest * rest / 6.0;
    return 0.5 + x * (0.75 - x * x / 3.0);
}

double field_spline(double x)
{
    const double off = fabs(x), rest = fmax(0.0, NODE_REACH - off);
    return off < 0.5 ? 0.75 - off * off : 0.5 * rest * rest;
}

/* The share of a node's weight that a box takes: along each of its axes what lies between its two faces, or all that is behind `before`. The spline is nearly the same
 * along turned axes. */
static double box_share(const Near *near, const Solid *s, const double point[3], const Face *before)
{
    double local[3], normal[3], share = 1.0;
    along_axes(s, point, local);
    for (int a = 0; a < s->dimension; a++) {
        box_normal(s, a, 1.0, normal);
        const double along = before ? dot3(normal, before->normal) : 0.0;
        const double high = along < -SAME_DIRECTION ? INFINITY : s->half_extents[a], low = along > SAME_DIRECTION ? -INFINITY : -s->half_extents[a];
        share *= field_spline_below((high - local[a]) / near->cell_size) - field_spline_below((low - local[a]) / near->cell_size);
    }
    return share;
}

/* A box by itself takes its own share. Of several obstacles the planes around the point tell: those in a hollow leave the product of what each leaves. */
double field_open_share(const Near *near, const double point[3], double deepest, const Face *known, int count, bool one_sided)
{
    Face face[FIELD_FACES];
    const Obstacle *only = NULL;
    double least = INFINITY, share = 1.0;
    int close = 0;
    for (int i = 0; i < near->count; i++) {
        const double distance = solid_gap(field_solid(near, near->obstacle[i]), point) / near->cell_size;
        least = fmin(least, distance);
        if (distance >= NODE_REACH * sqrt((double)near->dimension)) continue;
        only = near->obstacle[i];
        close++;
    }
    if (least >= NODE_REACH) return 1.0;
    const bool in_corner = one_sided && count > 1; /* what is open beyond the other faces does not count either */
    if (close == 1 && field_solid(near, only)->kind == PBMPM_BOX && !in_corner) return fmax(1.0 - box_share(near, field_solid(near, only), point, one_sided ? known : NULL), field_spline_below(-deepest));
    if (!known) count = field_faces(near, point, NODE_REACH, face);
    for (int i = 0; i < count; i++) share *= field_spline_below(fmax((known ? known : face)[i].distance, -deepest));
    return count > 0 || least > 0.0 ? share : field_spline_below(-deepest);
}
