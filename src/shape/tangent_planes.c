#include "shape/tangent_planes.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

/* A node looking around. Offsets are from it; all lengths in cells. */
typedef struct Lookout {
    const Solid *solid;
    double cell_size;
    const double *point; /* [m] */
    double distance;     /* at the node */
    double margin;
    Plane *plane;
    int count;
} Lookout;

/* What is seen from an offset. */
typedef struct Sample {
    double distance, normal[3];
    double gap; /* from the node along the normal to the plane that touches the surface there */
} Sample;

static void point_at(const Lookout *l, const double offset[3], double point[3])
{
    for (int a = 0; a < 3; a++) point[a] = a < l->solid->dimension ? l->point[a] + offset[a] * l->cell_size : 0.0;
}

static Sample look(const Lookout *l, const double offset[3])
{
    Sample sample;
    double point[3];
    point_at(l, offset, point);
    sample.distance = solid_distance(l->solid, point, sample.normal) / l->cell_size;
    sample.gap = sample.distance - dot3(sample.normal, offset);
    return sample;
}

static bool is_known(const Plane *known, int count, const double normal[3])
{
    for (int i = 0; i < count; i++)
        if (dot3(known[i].normal, normal) > SAME_DIRECTION) return true;
    return false;
}

static Plane plane_of(const Sample *sample)
{
    return (Plane){.normal = {sample->normal[0], sample->normal[1], sample->normal[2]}, .gap = fmax(sample->gap, 0.0)};
}

static void add_plane(Lookout *l, const Sample *sample)
{
    if (l->count < PLANES_MAX) l->plane[l->count++] = plane_of(sample);
}

/* Whether going through a plane along the first one leads into the solid, or deeper into it. So it does in a hollow; round a bulge or an
 * edge it leads away, and the plane must not hold the node. */
static bool cuts(const Lookout *l, const Sample *sample)
{
    const double *first = l->plane[0].normal, along = dot3(sample->normal, first);
    double way[3];
    for (int a = 0; a < 3; a++) way[a] = -(sample->normal[a] - along * first[a]);
    const double slope = sqrt(dot3(way, way));
    if (slope < 0.1) return false;
    const double length = fmax(sample->gap, 0.0) / slope + 0.5;
    for (int a = 0; a < 3; a++) way[a] *= length / slope;
    return look(l, way).distance < fmin(l->distance, 0.0) - 0.05 * length;
}

/* Beside the nearest surface, others that a cell in each direction is nearest to. */
static void look_around(Lookout *l, const double normal[3])
{
    Sample nearest = {.distance = l->distance, .gap = l->distance};
    memcpy(nearest.normal, normal, sizeof nearest.normal);
    add_plane(l, &nearest);
    if (l->distance < -1.5) return; /* beyond the support of any particle outside */
    for (int i = 0; i < 2 * l->solid->dimension; i++) {
        double offset[3] = {0};
        offset[i / 2] = i % 2 ? 1.0 : -1.0;
        const Sample sample = look(l, offset);
        if (sample.gap <= l->margin && !is_known(l->plane, l->count, sample.normal) && cuts(l, &sample)) add_plane(l, &sample);
    }
}

int tangent_planes(const Solid *solid, double cell_size, const double point[3], const Plane *nearest, double margin, Plane planes[PLANES_MAX])
{
    Lookout l = {.solid = solid, .cell_size = cell_size, .point = point, .distance = nearest->gap, .margin = margin, .plane = planes};
    if (nearest->gap <= margin) look_around(&l, nearest->normal);
    return l.count;
}

/* From distance to distance, less the margin, at least half a cell. */
bool plane_on_way(const Solid *solid, double cell_size, const Way *way, double margin, Plane *plane)
{
    const Lookout l = {.solid = solid, .cell_size = cell_size, .point = way->point, .distance = solid_gap(solid, way->point) / cell_size};
    const double length = sqrt(dot3(way->way, way->way));
    Sample best = {.distance = INFINITY};
    double gone = fmax(l.distance - margin, 0.5);
    for (bool last = false; !last && l.distance > 0.0;) {
        double offset[3], there[3];
        last = gone >= length;
        for (int a = 0; a < 3; a++) offset[a] = length > 0.0 ? way->way[a] * fmin(gone / length, 1.0) : 0.0;
        const Sample sample = look(&l, offset);
        if (sample.distance < 0.0) break;
        if (sample.distance < best.distance && dot3(sample.normal, way->way) < 0.0 && !is_known(way->known, way->count, sample.normal)) best = sample;
        point_at(&l, offset, there);
        gone += fmax(solid_least(solid, there) / cell_size - margin, 0.5);
    }
    if (best.distance > margin) return false;
    *plane = plane_of(&best);
    return true;
}
