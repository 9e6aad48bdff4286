/* Fields between particles: at points and along lines. Lengths are in cells in here. */
#include "services/query.h"

#include <float.h>
#include <math.h>

#include "base/numbers.h"
#include "base/pool.h"
#include "base/result.h"
#include "matter/particle_tree.h"
#include "services/readers.h"

/* A particle counts nearer than NODE_REACH along each axis, and it is within 1/2 of the node that it is stored at. */
static const double CELL_REACH = NODE_REACH + 0.5;

static const double SAMPLE = 0.25; /* from one sample on a line to the next */
/* Of a sample: then a crossing is found to 6e-5 cells, about what a float holds of a place 1,000 cells away. */
enum { HALVINGS = 12 };
enum { POINT_GRAIN = 16 };

/* ---- Arguments ---- */

pbmpm_ray query_ray_defaults(void)
{
    return (pbmpm_ray){.size = sizeof(pbmpm_ray), .level = 0.5f, .direction = {0.0f, -1.0f, 0.0f}, .max_distance = 1e9f};
}

const char *query_points_problem(const World *world, const float *points, uint32_t count)
{
    if (count > INT32_MAX) return "more than 2^31 - 1 points at once";
    return all_finite(points, count * (size_t)world->def.dimension) ? NULL : "a point is not finite";
}

const char *query_level_problem(float level)
{
    return level > 0.0f && level <= 100.0f ? NULL : "the level must be in (0, 100]";
}

static bool normalise(const float *vector, int dimension, double sign, double unit[3])
{
    double length2 = 0.0;
    for (int a = 0; a < dimension; a++) length2 += (double)vector[a] * (double)vector[a];
    const double length = sqrt(length2);
    for (int a = 0; a < 3; a++) unit[a] = a < dimension ? sign * (double)vector[a] / length : 0.0;
    return length > 1e-6 && all_finite(vector, (size_t)dimension);
}

bool query_direction(const World *world, const float *direction, double unit[3])
{
    if (direction) return normalise(direction, world->def.dimension, 1.0, unit);
    return normalise(world->settings.gravity, world->def.dimension, -1.0, unit);
}

const char *query_ray_problem(const World *world, const pbmpm_ray *ray)
{
    double unit[3];
    const char *problem = query_level_problem(ray->level);
    if (!problem) problem = query_points_problem(world, ray->origin, 1);
    if (!problem && !normalise(ray->direction, world->def.dimension, 1.0, unit)) problem = "ray.direction must be finite and longer than 1e-6";
    if (!problem && !in_range(ray->max_distance, 0.0, 1e9)) problem = "ray.max_distance must be in [0, 1e9]";
    return problem;
}

/* ---- Weights ---- */

static double spline(double r)
{
    const double distance = fabs(r);
    if (distance < 0.5) return 0.75 - r * r;
    return distance < NODE_REACH ? 0.5 * (NODE_REACH - distance) * (NODE_REACH - distance) : 0.0;
}

static double spline_slope(double r)
{
    if (fabs(r) < 0.5) return -2.0 * r;
    return fabs(r) < NODE_REACH ? (r < 0.0 ? NODE_REACH + r : r - NODE_REACH) : 0.0;
}

static double weight(const double from[3], const double to[3], int dimension)
{
    double w = 1.0;
    for (int a = 0; a < dimension && w != 0.0; a++) w *= spline(to[a] - from[a]);
    return w;
}

static void position_of(const World *world, uint32_t row, double position[3])
{
    for (int a = 0; a < 3; a++) position[a] = a < world->def.dimension ? particles_coordinate(&world->particles, row, a) : 0.0;
}

/* The rest volume of a particle, in cells. */
static double rest_volume(const World *world, uint32_t row)
{
    return (double)world->particles.mass[row] / (double)world->materials.def[world->particles.material[row]].density;
}

/* ---- Points ---- */

typedef struct Sample {
    const World *world;
    double point[3];
    double filling, density, momentum[3];
} Sample;

static bool near_point(const ParticleBox *box, void *context)
{
    const Sample *sample = context;
    for (int a = 0; a < sample->world->def.dimension; a++)
        if (sample->point[a] < box->low[a] - CELL_REACH || sample->point[a] > box->high[a] + CELL_REACH) return false;
    return true;
}

static void add_to_sample(const ParticleBox *box, uint32_t begin, uint32_t end, void *context)
{
    (void)box;
    Sample *sample = context;
    const World *world = sample->world;
    const Particles *p = &world->particles;
    for (uint32_t row = begin; row < end; row++) {
        double x[3];
        position_of(world, row, x);
        const double w = weight(x, sample->point, p->dimension), m = w * (double)p->mass[row];
        if (w == 0.0) continue;
        sample->filling += w * rest_volume(world, row);
        sample->density += m;
        for (int a = 0; a < p->dimension; a++) {
            double v = (double)p->velocity[a][row];
            for (int c = 0; c < p->dimension; c++)
                v += (double)p->affine[a * 3 + c][row] * (sample->point[c] - x[c]) * (double)world->def.cell_size;
            sample->momentum[a] += m * v;
        }
    }
}

typedef struct PointsJob {
    const World *world;
    const float *points;
    float *filling, *density, *velocity;
} PointsJob;

static void sample_points(void *context, int32_t begin, int32_t end)
{
    const PointsJob *job = context;
    const size_t d = (size_t)job->world->def.dimension;
    for (size_t i = (size_t)begin; i < (size_t)end; i++) {
        Sample sample = {.world = job->world};
        for (size_t a = 0; a < d; a++) sample.point[a] = (double)job->points[i * d + a] / (double)job->world->def.cell_size;
        particle_tree_visit(&job->world->particle_tree, near_point, add_to_sample, &sample);
        if (job->filling) job->filling[i] = (float)sample.filling;
        if (job->density) job->density[i] = (float)sample.density;
        for (size_t a = 0; a < d && job->velocity; a++)
            job->velocity[i * d + a] = sample.density > 0.0 ? (float)(sample.momentum[a] / sample.density) : 0.0f;
    }
}

pbmpm_result query_points(World *world, const float *points, uint32_t count, float *filling, float *density, float *velocity)
{
    const pbmpm_result result = readers_build_particle_tree(world);
    if (result != PBMPM_OK) return result;
    PointsJob job = {world, points, filling, density, velocity};
    pool_for(world->pool, (int32_t)count, POINT_GRAIN, sample_points, &job);
    return PBMPM_OK;
}

/* ---- Lines ---- */

enum { PATCH_CAPACITY = 1024 };
static const double PATCH_LENGTH = 2.0; /* [cells] that one look for particles covers: what comes out is the same with any */

/* A particle near a stretch of a line. */
typedef struct Candidate {
    double position[3], volume;
} Candidate;

/* A line start + t direction, and the particles near the stretch of it that is being looked at. */
typedef struct Line {
    const World *world;
    double start[3], direction[3], level;
    double from, to; /* the stretch */
    bool overflow;   /* more candidates than there is room for: all boxes are searched for each sample */
    int count;
    Candidate candidate[PATCH_CAPACITY];
} Line;

static void point_on(const Line *line, double t, double point[3])
{
    for (int a = 0; a < 3; a++) point[a] = line->start[a] + t * line->direction[a];
}

static bool near_stretch(const ParticleBox *box, void *context)
{
    const Line *line = context;
    for (int a = 0; a < line->world->def.dimension; a++) {
        const double one = line->start[a] + line->from * line->direction[a], other = line->start[a] + line->to * line->direction[a];
        if (fmax(one, other) < box->low[a] - CELL_REACH || fmin(one, other) > box->high[a] + CELL_REACH) return false;
    }
    return true;
}

static void add_candidates(const ParticleBox *box, uint32_t begin, uint32_t end, void *context)
{
    (void)box;
    Line *line = context;
    const int d = line->world->def.dimension;
    for (uint32_t row = begin; row < end && !line->overflow; row++) {
        Candidate candidate = {.volume = rest_volume(line->world, row)};
        bool near = true;
        position_of(line->world, row, candidate.position);
        for (int a = 0; a < d; a++) {
            const double one = line->start[a] + line->from * line->direction[a], other = line->start[a] + line->to * line->direction[a];
            near &= candidate.position[a] > fmin(one, other) - NODE_REACH && candidate.position[a] < fmax(one, other) + NODE_REACH;
        }
        if (!near) continue;
        line->overflow = line->count == PATCH_CAPACITY;
        if (!line->overflow) line->candidate[line->count++] = candidate;
    }
}

static void look_at(Line *line, double from, double to)
{
    line->from = from;
    line->to = to;
    line->count = 0;
    line->overflow = false;
    particle_tree_visit(&line->world->particle_tree, near_stretch, add_candidates, line);
}

/* The filling on the line; the same sum in the same order whether from candidates or from boxes. */
static double filling_at(const Line *line, double t)
{
    Sample sample = {.world = line->world};
    point_on(line, t, sample.point);
    if (line->overflow) {
        particle_tree_visit(&line->world->particle_tree, near_point, add_to_sample, &sample);
        return sample.filling;
    }
    for (int i = 0; i < line->count; i++)
        sample.filling += weight(line->candidate[i].position, sample.point, line->world->def.dimension) * line->candidate[i].volume;
    return sample.filling;
}

/* The first t = i * SAMPLE, i >= first and t <= last, at which the filling reaches the level, moved towards the sample before; or
 * INFINITY. Where no particle is near, the filling is 0 and samples are left out. */
static double first_crossing(Line *line, double first, double last)
{
    double i = first;
    line->from = line->to = -INFINITY;
    for (;;) {
        if (!(i * SAMPLE <= line->to)) {
            const double entry = particle_tree_entry(&line->world->particle_tree, &line->world->particles, line->start, line->direction, i * SAMPLE, CELL_REACH);
            if (!(entry <= last) || isinf(entry)) return INFINITY;
            i = fmax(i, floor(entry / SAMPLE));
            look_at(line, (i - 1.0) * SAMPLE, i * SAMPLE + PATCH_LENGTH);
        }
        if (i * SAMPLE > last || i + 1.0 == i) return INFINITY; /* or so far that samples cannot be told apart */
        if (filling_at(line, i * SAMPLE) >= line->level) break;
        i += 1.0;
    }
    double above = i * SAMPLE, below = (i - 1.0) * SAMPLE;
    for (int k = 0; k < HALVINGS && i > first; k++) {
        const double middle = 0.5 * (below + above);
        if (filling_at(line, middle) >= line->level)
            above = middle;
        else
            below = middle;
    }
    return above;
}

/* ---- Heights ---- */

typedef struct HeightsJob {
    const World *world;
    const float *points;
    const double *up;
    double level;
    float *heights;
} HeightsJob;

/* Moves the start by whole samples to where the line passes the origin, so that t counts finely wherever the point was. Returns how far along
 * the line the start is then. Exact along an axis: fmod is, and so is the multiple of SAMPLE that it leaves. */
static double start_near_origin(Line *line)
{
    double along = 0.0, now = 0.0;
    for (int a = 0; a < line->world->def.dimension; a++) along += line->start[a] * line->direction[a];
    const double whole = along - fmod(along, SAMPLE);
    for (int a = 0; a < line->world->def.dimension; a++) {
        line->start[a] -= whole * line->direction[a];
        now += line->start[a] * line->direction[a];
    }
    return now;
}

static void find_heights(void *context, int32_t begin, int32_t end)
{
    const HeightsJob *job = context;
    const double dx = (double)job->world->def.cell_size;
    const size_t d = (size_t)job->world->def.dimension;
    Line line = {.world = job->world, .level = job->level};
    for (size_t a = 0; a < d; a++) line.direction[a] = -job->up[a];
    for (size_t i = (size_t)begin; i < (size_t)end; i++) {
        for (size_t a = 0; a < d; a++) line.start[a] = (double)job->points[i * d + a] / dx;
        const double along = -start_near_origin(&line);
        const double top = particle_tree_entry(&job->world->particle_tree, &job->world->particles, line.start, line.direction, -INFINITY, CELL_REACH);
        const double t = top < INFINITY ? first_crossing(&line, floor(top / SAMPLE) - 1.0, INFINITY) : INFINITY;
        job->heights[i] = (float)((along - t) * dx);
    }
}

pbmpm_result query_heights(World *world, const float *points, uint32_t count, const double up[3], float level, float *heights)
{
    const pbmpm_result result = readers_build_particle_tree(world);
    if (result != PBMPM_OK) return result;
    HeightsJob job = {world, points, up, (double)level, heights};
    pool_for(world->pool, (int32_t)count, POINT_GRAIN, find_heights, &job);
    return PBMPM_OK;
}

/* ---- Rays ---- */

/* The nearest particle that counts at a point, and the gradient of the filling there. */
typedef struct Touch {
    Sample sample;
    double gradient[3], nearest2;
    uint32_t row;
} Touch;

static void add_to_touch(const ParticleBox *box, uint32_t begin, uint32_t end, void *context)
{
    (void)box;
    Touch *touch = context;
    const World *world = touch->sample.world;
    const int d = world->def.dimension;
    for (uint32_t row = begin; row < end; row++) {
        double x[3], w[3] = {1.0, 1.0, 1.0}, slope[3] = {0}, distance2 = 0.0;
        position_of(world, row, x);
        for (int a = 0; a < d; a++) {
            const double r = touch->sample.point[a] - x[a];
            w[a] = spline(r);
            slope[a] = spline_slope(r);
            distance2 += r * r;
        }
        if (w[0] * w[1] * w[2] == 0.0) continue;
        const double volume = rest_volume(world, row);
        for (int a = 0; a < d; a++) touch->gradient[a] += volume * slope[a] * w[(a + 1) % 3] * w[(a + 2) % 3];
        if (distance2 >= touch->nearest2) continue;
        touch->nearest2 = distance2;
        touch->row = row;
    }
}

/* near_point() on the sample that a touch begins with. */
static bool near_touch(const ParticleBox *box, void *context) { return near_point(box, &((Touch *)context)->sample); }

static void describe_hit(const Line *line, double t, pbmpm_ray_hit *hit)
{
    const World *world = line->world;
    const int d = world->def.dimension;
    Touch touch = {.sample = {.world = world}, .nearest2 = INFINITY};
    point_on(line, t, touch.sample.point);
    particle_tree_visit(&world->particle_tree, near_touch, add_to_touch, &touch);
    double length2 = 0.0;
    for (int a = 0; a < d; a++) length2 += touch.gradient[a] * touch.gradient[a];
    for (int a = 0; a < d; a++) {
        hit->position[a] = (float)(touch.sample.point[a] * (double)world->def.cell_size);
        hit->normal[a] = length2 > 0.0 ? (float)(-touch.gradient[a] / sqrt(length2)) : 0.0f;
    }
    const uint32_t slot = world->particles.material[touch.row];
    hit->hit = 1;
    hit->distance = (float)(t * (double)world->def.cell_size);
    hit->material = (pbmpm_material_id){slot, world->materials.generation[slot]};
    hit->particle = world->particles.id[touch.row];
}

pbmpm_result query_ray(World *world, const pbmpm_ray *ray, pbmpm_ray_hit *hit)
{
    const pbmpm_result result = readers_build_particle_tree(world);
    if (result != PBMPM_OK) return result;
    Line line = {.world = world, .level = (double)ray->level};
    query_direction(world, ray->direction, line.direction);
    for (int a = 0; a < world->def.dimension; a++) line.start[a] = (double)ray->origin[a] / (double)world->def.cell_size;
    const double t = first_crossing(&line, 0.0, (double)ray->max_distance / (double)world->def.cell_size);
    *hit = (pbmpm_ray_hit){.size = sizeof *hit};
    if (t < INFINITY) describe_hit(&line, t, hit);
    return PBMPM_OK;
}
