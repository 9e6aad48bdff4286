#include "shape/shapes.h"

#include <math.h>
#include <string.h>

#include "base/numbers.h"

pbmpm_shape shape_defaults(void)
{
    return (pbmpm_shape){.size = sizeof(pbmpm_shape),
                         .kind = PBMPM_BOX,
                         .rotation = {0.0f, 0.0f, 0.0f, 1.0f},
                         .half_extents = {0.5f, 0.5f, 0.5f},
                         .radius = 0.5f,
                         .normal = {0.0f, 1.0f, 0.0f}};
}

static double quaternion_length(const float q[4])
{
    return sqrt((double)q[0] * q[0] + (double)q[1] * q[1] + (double)q[2] * q[2] + (double)q[3] * q[3]);
}

static const char *const half_extent_problem[3] = {"shape.half_extents[0] must be in [1e-9, 1e9]", "shape.half_extents[1] must be in [1e-9, 1e9]",
                                                   "shape.half_extents[2] must be in [1e-9, 1e9]"};

static const char *geometry_problem(const pbmpm_shape *shape, int dimension, const BakedTable *table)
{
    if (!in_enum(shape->kind, PBMPM_PLANE, PBMPM_BAKED)) return "shape.kind is unknown";
    switch (shape->kind) {
    case PBMPM_PLANE: {
        double length = 0.0;
        for (int a = 0; a < dimension; a++) length += (double)shape->normal[a] * shape->normal[a];
        return all_finite(shape->normal, dimension) && length > 1e-12 ? NULL : "shape.normal must be finite and longer than 1e-6";
    }
    case PBMPM_BOX:
        for (int a = 0; a < dimension; a++)
            if (!in_range(shape->half_extents[a], 1e-9, 1e9)) return half_extent_problem[a];
        return NULL;
    case PBMPM_CAPSULE:
        if (!in_range(shape->half_extents[0], 0.0, 1e9)) return "shape.half_extents[0] must be in [0, 1e9]";
        return in_range(shape->radius, 1e-9, 1e9) ? NULL : "shape.radius must be in [1e-9, 1e9]";
    case PBMPM_SPHERE: return in_range(shape->radius, 1e-9, 1e9) ? NULL : "shape.radius must be in [1e-9, 1e9]";
    case PBMPM_BAKED:
        if (!table) return "shape.kind: baked solids are not for this call";
        return baked_find(table, shape->baked) ? NULL : "shape.baked is no baked solid of this world";
    case PBMPM_SHAPE_KIND_FORCE32: break;
    }
    return "shape.kind is unknown";
}

const char *shape_problem(const pbmpm_shape *shape, int dimension) { return shape_problem_among(shape, dimension, NULL); }

const char *shape_problem_among(const pbmpm_shape *shape, int dimension, const BakedTable *table)
{
    if (!all_in_range(shape->position, dimension, -1e9, 1e9)) return "shape.position must be in [-1e9, 1e9]";
    if (!all_finite(shape->rotation, 4) || !in_range(quaternion_length(shape->rotation), 0.5, 2.0))
        return "shape.rotation must be a quaternion of length 0.5 to 2";
    if (dimension == 2 && (shape->rotation[0] != 0.0f || shape->rotation[1] != 0.0f))
        return "shape.rotation in 2D must turn in the plane: x and y of the quaternion are 0";
    return geometry_problem(shape, dimension, table);
}

void normalise_quaternion(float q[4])
{
    const double length = quaternion_length(q);
    for (int a = 0; a < 4; a++) q[a] = (float)(q[a] / length);
}

void rotation_from_quaternion(const double q[4], double r[9])
{
    const double n = 1.0 / sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
    const double x = q[0] * n, y = q[1] * n, z = q[2] * n, w = q[3] * n;
    const double matrix[9] = {1 - 2 * (y * y + z * z), 2 * (x * y - w * z),     2 * (x * z + w * y),
                              2 * (x * y + w * z),     1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                              2 * (x * z - w * y),     2 * (y * z + w * x),     1 - 2 * (x * x + y * y)};
    memcpy(r, matrix, sizeof matrix);
}

Solid solid_of(const pbmpm_shape *shape, int dimension)
{
    Solid s = {.kind = shape->kind, .dimension = dimension, .radius = shape->radius};
    const double q[4] = {shape->rotation[0], shape->rotation[1], shape->rotation[2], shape->rotation[3]};
    rotation_from_quaternion(q, s.rotation);
    double length = 0.0;
    for (int a = 0; a < dimension; a++) {
        s.position[a] = shape->position[a];
        s.half_extents[a] = shape->half_extents[a];
        length += (double)shape->normal[a] * shape->normal[a];
    }
    for (int r = 0; r < dimension; r++)
        for (int c = 0; c < dimension; c++) s.normal[r] += s.rotation[r * 3 + c] * shape->normal[c] / sqrt(length);
    return s;
}

Solid solid_among(const pbmpm_shape *shape, int dimension, const BakedTable *table)
{
    Solid solid = solid_of(shape, dimension);
    if (shape->kind == PBMPM_BAKED) solid.grid = baked_find(table, shape->baked);
    return solid;
}

pbmpm_shape shape_between(const pbmpm_shape *start, const float position[3], const float rotation[4], float t)
{
    pbmpm_shape shape = *start;
    float dot = 0.0f;
    for (int a = 0; a < 4; a++) dot += shape.rotation[a] * rotation[a];
    for (int a = 0; a < 3; a++) shape.position[a] += t * (position[a] - shape.position[a]);
    const float sign = dot < 0.0f ? -1.0f : 1.0f;
    for (int a = 0; a < 4; a++) shape.rotation[a] += t * (sign * rotation[a] - shape.rotation[a]);
    if (t == 1.0f) { /* exactly, whatever rounding says */
        memcpy(shape.position, position, sizeof shape.position);
        memcpy(shape.rotation, rotation, sizeof shape.rotation);
    }
    return shape;
}

/* What follows is compiled for each dimension `d`, and with and without the normal, which may be null. */

static inline double length_of(const double v[3], int d)
{
    double sum = 0.0;
    for (int a = 0; a < d; a++) sum += v[a] * v[a];
    return sqrt(sum);
}

/* Distance to a point or segment's `offset` (from its nearest point), minus the radius. */
static inline double round_distance(const Solid *s, const double offset[3], double *normal, int d)
{
    const double length = length_of(offset, d);
    if (!normal) return length - s->radius;
    for (int a = 0; a < 3; a++) normal[a] = length > 0.0 ? offset[a] / length : 0.0;
    if (length == 0.0) normal[d == 2 ? 1 : 2] = 1.0; /* on the axis every direction is as good */
    return length - s->radius;
}

static inline double box_distance(const Solid *s, const double local[3], double *normal, int d)
{
    double outside[3] = {0}, deepest = -INFINITY;
    int nearest_face = 0;
    for (int a = 0; a < d; a++) {
        const double over = fabs(local[a]) - s->half_extents[a];
        outside[a] = over > 0.0 ? copysign(over, local[a]) : 0.0;
        if (over > deepest) {
            deepest = over;
            nearest_face = a;
        }
    }
    if (normal) memset(normal, 0, 3 * sizeof *normal);
    if (deepest <= 0.0) {
        if (normal) normal[nearest_face] = local[nearest_face] < 0.0 ? -1.0 : 1.0;
        return deepest;
    }
    const double length = length_of(outside, d);
    for (int a = 0; a < d && normal; a++) normal[a] = outside[a] / length;
    return length;
}

static inline double local_distance(const Solid *s, const double local[3], double *normal, int d)
{
    double unused[3], offset[3] = {local[0], local[1], local[2]};
    switch (s->kind) {
    case PBMPM_BOX: return box_distance(s, local, normal, d);
    case PBMPM_BAKED: return distance_grid_at(s->grid, local, normal ? normal : unused);
    case PBMPM_CAPSULE: offset[0] -= fmax(-s->half_extents[0], fmin(s->half_extents[0], local[0])); return round_distance(s, offset, normal, d);
    case PBMPM_SPHERE: return round_distance(s, offset, normal, d);
    case PBMPM_PLANE: /* has no frame: see distance_in() */
    case PBMPM_SHAPE_KIND_FORCE32: break;
    }
    return INFINITY;
}

static inline void to_local(const Solid *s, const double point[3], double local[3], int d)
{
    double from_centre[3];
    for (int a = 0; a < d; a++) from_centre[a] = point[a] - s->position[a];
    local[0] = local[1] = local[2] = 0.0;
    for (int a = 0; a < d; a++)
        for (int b = 0; b < d; b++) local[a] += s->rotation[b * 3 + a] * from_centre[b];
}

static inline double distance_in(const Solid *s, const double point[3], double *normal, int d)
{
    double local[3], local_normal[3], distance = 0.0;
    if (s->kind == PBMPM_PLANE) {
        for (int a = 0; a < d; a++) distance += (point[a] - s->position[a]) * s->normal[a];
        if (normal) memcpy(normal, s->normal, sizeof s->normal);
        return distance;
    }
    to_local(s, point, local, d);
    distance = local_distance(s, local, normal ? local_normal : NULL, d);
    for (int a = 0; a < 3 && normal; a++) {
        normal[a] = 0.0;
        for (int b = 0; b < d && a < d; b++) normal[a] += s->rotation[a * 3 + b] * local_normal[b];
    }
    return distance;
}

double solid_distance(const Solid *s, const double point[3], double normal[3])
{
    return s->dimension == 3 ? distance_in(s, point, normal, 3) : distance_in(s, point, normal, 2);
}

double solid_gap(const Solid *s, const double point[3]) { return s->dimension == 3 ? distance_in(s, point, NULL, 3) : distance_in(s, point, NULL, 2); }

int solid_other_faces(const Solid *s, const double point[3], double reach, double normals[2][3])
{
    double local[3], nearest[3];
    int count = 0;
    if (s->kind != PBMPM_BOX) return 0;
    to_local(s, point, local, s->dimension);
    if (box_distance(s, local, nearest, s->dimension) > 0.0) return 0;
    for (int a = 0; a < s->dimension; a++) {
        const double side = local[a] < 0.0 ? -1.0 : 1.0;
        if (nearest[a] != 0.0 || s->half_extents[a] - side * local[a] > reach) continue;
        for (int b = 0; b < 3; b++) normals[count][b] = b < s->dimension ? side * s->rotation[b * 3 + a] : 0.0;
        count++;
    }
    return count;
}

double solid_least(const Solid *s, const double point[3])
{
    double local[3];
    if (!s->grid) return solid_gap(s, point);
    to_local(s, point, local, s->dimension);
    return distance_grid_least(s->grid, local);
}

double solid_breadth(const Solid *s)
{
    double half = INFINITY;
    switch (s->kind) {
    case PBMPM_BOX:
        for (int a = 0; a < s->dimension; a++) half = fmin(half, s->half_extents[a]);
        break;
    case PBMPM_SPHERE:
    case PBMPM_CAPSULE: half = s->radius; break;
    case PBMPM_PLANE:
    case PBMPM_BAKED:
    case PBMPM_SHAPE_KIND_FORCE32: break;
    }
    return 2.0 * half;
}

/* The box around the turned grid. */
static void grid_bounds(const Solid *s, double low[3], double high[3])
{
    for (int a = 0; a < 3; a++) {
        low[a] = high[a] = s->position[a];
        for (int b = 0; b < s->dimension && a < s->dimension; b++) {
            const double one = s->rotation[a * 3 + b] * s->grid->low[b], other = s->rotation[a * 3 + b] * distance_grid_high(s->grid, b);
            low[a] += fmin(one, other);
            high[a] += fmax(one, other);
        }
    }
}

void solid_bounds(const Solid *s, double low[3], double high[3])
{
    if (s->grid) {
        grid_bounds(s, low, high);
        return;
    }
    for (int a = 0; a < 3; a++) {
        double reach = 0.0;
        for (int b = 0; b < s->dimension && a < s->dimension; b++) {
            const double extent = s->kind == PBMPM_BOX ? s->half_extents[b] : s->kind == PBMPM_CAPSULE && b == 0 ? s->half_extents[0] : 0.0;
            reach += fabs(s->rotation[a * 3 + b]) * extent;
        }
        if (s->kind != PBMPM_BOX) reach += s->radius;
        low[a] = s->position[a] - reach;
        high[a] = s->position[a] + reach;
    }
}
