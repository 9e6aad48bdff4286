#include "skin/boundary.h"

#include <math.h>
#include <string.h>

#include "contact/field.h"

enum { BOUNDARY_GRAIN = 2, PART_AXIS = 4 };

/* So far [cells] outside of a flat surface F is 0 but for a ripple of S: what is farther from a wall has no image. */
static const double IMAGE_REACH = 0.75;
/* Of F at a flat surface, per cell: S W at 0. */
static const float FLAT_SLOPE = 29.0f / 32.0f;

bool boundary_find(Boundary *boundary, World *world, bool *changed)
{
    const size_t room = world->colliders.room + DOMAIN_WALLS;
    if (!array_reserve(&world->memory, &boundary->obstacle, room, sizeof(Obstacle)) || !array_reserve(&world->memory, &boundary->stood, room, sizeof(Solid))) return false;
    boundary->colliders = world->colliders;
    boundary->colliders.obstacle = boundary->obstacle.data;
    colliders_begin_substep(&boundary->colliders, &world->domain, world->def.dimension, 0, 1);
    const int count = boundary->colliders.obstacle_count;
    *changed = count != boundary->stands;
    boundary->stands = count;
    for (int i = 0; i < count; i++) {
        Solid *stood = (Solid *)boundary->stood.data + i;
        const Solid *stands = &boundary->colliders.obstacle[i].start;
        *changed = *changed || memcmp(stood, stands, sizeof *stands) != 0;
        *stood = *stands;
    }
    return true;
}

void boundary_free(Boundary *boundary, Memory *memory)
{
    array_free(memory, &boundary->obstacle);
    array_free(memory, &boundary->stood);
}

/* ---- Distances ---- */

typedef struct BoundaryJob {
    const FieldWork *work;
    float level, *values;
} BoundaryJob;

/* A place in points from the first point of a block, in metres. */
static void place_of(const FieldWork *work, const SkinBlock *block, const double local[3], double place[3])
{
    const SkinBlocks *blocks = work->blocks;
    for (int a = 0; a < 3; a++) {
        const int64_t first = (int64_t)blocks->anchor[a] * blocks->subdivision + (int64_t)block->place[a] * BLOCK_AXIS;
        place[a] = ((double)first + local[a] - (double)field_shift(blocks)) * work->cell_size / blocks->subdivision;
    }
}

static void near_block(const FieldWork *work, const SkinBlock *block, Near *near)
{
    const double middle[3] = {0.5 * (BLOCK_AXIS - 1), 0.5 * (BLOCK_AXIS - 1), 0.5 * (BLOCK_AXIS - 1)};
    const Grid flat = {.dimension = 3};
    ContactFrame frame = {.colliders = (Colliders *)(uintptr_t)&work->boundary->colliders, .grid = &flat, .cell_size = work->cell_size};
    double place[3];
    place_of(work, block, middle, place);
    field_near(near, &frame, place, sqrt(3.0) * middle[0] / work->blocks->subdivision + IMAGE_REACH, false);
    field_keep(near, work->groups);
}

static void point_of(int i, double local[3])
{
    local[0] = i % BLOCK_AXIS;
    local[1] = i / BLOCK_AXIS % BLOCK_AXIS;
    local[2] = i / (BLOCK_AXIS * BLOCK_AXIS);
}

/* Whether a part of a block with these first points is near enough to an obstacle. */
static bool part_is_near(const FieldWork *work, const SkinBlock *block, const Near *near, const int first[3])
{
    const double half = 0.5 * (PART_AXIS - 1);
    double middle[3], place[3];
    for (int a = 0; a < 3; a++) middle[a] = first[a] + half;
    place_of(work, block, middle, place);
    return field_distance(near, place) < sqrt(3.0) * half / work->blocks->subdivision + IMAGE_REACH;
}

/* What has less than this is outside whatever it is mirrored in: three planes make it 8 times as much. */
static float least_that_counts(float level) { return 0.125f * level; }

static void measure_part(const BoundaryJob *job, SkinBlock *block, const Near *near, const int first[3])
{
    const size_t b = (size_t)(block - blocks_at(job->work->blocks, 0)) * BLOCK_POINTS;
    for (int n = 0; n < PART_AXIS * PART_AXIS * PART_AXIS; n++) {
        const int x = first[0] + n % PART_AXIS, y = first[1] + n / PART_AXIS % PART_AXIS, z = first[2] + n / (PART_AXIS * PART_AXIS);
        const int i = (z * BLOCK_AXIS + y) * BLOCK_AXIS + x;
        double local[3], place[3];
        if (job->values[b + (size_t)i] <= least_that_counts(job->level)) continue;
        point_of(i, local);
        place_of(job->work, block, local, place);
        job->work->gaps[b + (size_t)i] = (float)field_distance(near, place);
        block->bounded = true;
    }
}

static void measure_block(const BoundaryJob *job, SkinBlock *block, const Near *near)
{
    for (int n = 0; n < 8; n++) {
        const int first[3] = {(n & 1) * PART_AXIS, (n >> 1 & 1) * PART_AXIS, (n >> 2) * PART_AXIS};
        if (part_is_near(job->work, block, near, first)) measure_part(job, block, near, first);
    }
}

/* ---- The mirror ---- */

/* F at a place in points from the first point of a block, which is in that block or in one beside it. */
static float field_at(const SkinBlock *block, const float *values, const double local[3])
{
    static const unsigned neighbour_step[3] = {1, 3, 9}, point_step[3] = {1, BLOCK_AXIS, BLOCK_AXIS * BLOCK_AXIS};
    unsigned neighbour[3][2], at[3][2]; /* per axis, of the points on either side */
    float weight[3][2], sum = 0.0f;
    for (int a = 0; a < 3; a++) {
        const double from = local[a] + BLOCK_AXIS; /* counted from the first point of the block before */
        if (!(from >= 0.0 && from < 3 * BLOCK_AXIS - 1)) return 0.0f;
        const unsigned first = (unsigned)from;
        weight[a][1] = (float)(from - first);
        weight[a][0] = 1.0f - weight[a][1];
        for (unsigned up = 0; up < 2; up++) {
            neighbour[a][up] = (first + up) / BLOCK_AXIS * neighbour_step[a];
            at[a][up] = (first + up) % BLOCK_AXIS * point_step[a];
        }
    }
    for (int c = 0; c < 8; c++) {
        const int x = c & 1, y = c >> 1 & 1, z = c >> 2;
        const int32_t other = block->neighbour[neighbour[0][x] + neighbour[1][y] + neighbour[2][z]];
        if (other != GRID_NOWHERE) sum += weight[0][x] * weight[1][y] * weight[2][z] * values[(size_t)other * BLOCK_POINTS + at[0][x] + at[1][y] + at[2][z]];
    }
    return sum;
}

/* The planes around a point: of an obstacle by itself that of its nearest place. A baked one may have hollows. */
static int planes_at(const Near *near, const double place[3], Face face[FIELD_FACES])
{
    const Solid *solid = field_solid(near, near->obstacle[0]);
    if (near->count > 1 || solid->grid) return field_faces(near, place, IMAGE_REACH, face);
    face[0].distance = solid_distance(solid, place, face[0].normal) / near->cell_size;
    return 1;
}

/* Reflects a place in points in a set of planes. */
static void reflect(const FieldWork *work, const Face *face, int set, const double local[3], double image[3])
{
    memcpy(image, local, 3 * sizeof *image);
    for (int f = 0; set >> f; f++)
        for (int a = 0; a < 3 && set >> f & 1; a++) image[a] -= 2.0 * face[f].distance * face[f].normal[a] * work->blocks->subdivision;
}

/* The share of an image that lies in obstacles: beside the end of a wall is open space, whose matter is no image. */
static float hidden_share(const FieldWork *work, const SkinBlock *block, const Near *near, const double image[3])
{
    double place[3];
    place_of(work, block, image, place);
    const double share = 0.5 - field_distance(near, place) * work->blocks->subdivision;
    return share < 0.0 ? 0.0f : share > 1.0 ? 1.0f : (float)share;
}

/* F at a point and at all that it is reflected to. Of a point in an obstacle it is that of its reflection before it. */
static float with_images(const BoundaryJob *job, const SkinBlock *block, const Near *near, int i, float at_point)
{
    double local[3], place[3], image[3];
    Face face[FIELD_FACES];
    int before = 0;
    point_of(i, local);
    place_of(job->work, block, local, place);
    const int count = planes_at(near, place, face);
    for (int f = 0; f < count; f++) before |= (face[f].distance < 0.0) << f;
    reflect(job->work, face, before, local, image);
    const float own = before ? field_at(block, job->values, image) : at_point;
    float sum = own;
    for (int set = 0; set < 1 << count; set++) {
        if (set == before) continue;
        reflect(job->work, face, set, local, image);
        const float share = hidden_share(job->work, block, near, image), seen = share > 0.0f ? field_at(block, job->values, image) : 0.0f;
        sum += share * (seen < own ? seen : own);
    }
    return sum;
}

/* F at a flat surface, so far before it. */
static float flat_at(float gap) { return 0.5f + FLAT_SLOPE * gap; }

static float cut_at(float level, float gap) { return level + FLAT_SLOPE * gap; }

static void mirror_blocks(void *context, int32_t begin, int32_t end)
{
    const BoundaryJob *job = context;
    const float deepest = 1.0f / (float)job->work->blocks->subdivision; /* the points that cubes at the surface have in obstacles */
    for (int32_t b = begin; b < end; b++) {
        SkinBlock *block = blocks_at(job->work->blocks, b);
        const size_t first = (size_t)b * BLOCK_POINTS;
        Near near;
        block->bounded = false;
        for (int i = 0; i < BLOCK_POINTS; i++) job->work->gaps[first + (size_t)i] = INFINITY;
        if (block->most <= least_that_counts(job->level)) continue;
        near_block(job->work, block, &near);
        if (near.count == 0) continue;
        measure_block(job, block, &near);
        if (!block->bounded) continue;
        memcpy(job->work->lines + first, job->values + first, BLOCK_POINTS * sizeof(float));
        for (int i = 0; i < BLOCK_POINTS; i++) {
            const float gap = job->work->gaps[first + (size_t)i], own = job->values[first + (size_t)i];
            if (gap <= -deepest || gap >= (float)IMAGE_REACH) continue;
            /* Whole matter has an image like itself. */
            job->work->lines[first + (size_t)i] = own >= flat_at(gap) ? own + flat_at(-gap) : with_images(job, block, &near, i, own);
        }
    }
}

static void take_mirrored(void *context, int32_t begin, int32_t end)
{
    const BoundaryJob *job = context;
    for (int32_t b = begin; b < end; b++) {
        SkinBlock *block = blocks_at(job->work->blocks, b);
        const size_t first = (size_t)b * BLOCK_POINTS;
        if (!block->bounded) continue;
        memcpy(job->values + first, job->work->lines + first, BLOCK_POINTS * sizeof(float)); /* it grew, so the least is no more than it is */
    }
}

void boundary_mirror(const FieldWork *work, float level, float *values)
{
    BoundaryJob job = {work, level, values};
    pool_for(work->pool, work->blocks->count, BOUNDARY_GRAIN, mirror_blocks, &job);
    pool_for(work->pool, work->blocks->count, BOUNDARY_GRAIN, take_mirrored, &job);
}

static void cut_blocks(void *context, int32_t begin, int32_t end)
{
    const BoundaryJob *job = context;
    for (int32_t b = begin; b < end; b++) {
        SkinBlock *block = blocks_at(job->work->blocks, b);
        const size_t first = (size_t)b * BLOCK_POINTS;
        if (!block->bounded) continue;
        for (size_t i = first; i < first + BLOCK_POINTS; i++) {
            const float most = cut_at(job->level, job->work->gaps[i]);
            job->values[i] = job->values[i] < most ? job->values[i] : most;
        }
        field_bound(block, job->values + first);
    }
}

void boundary_cut(const FieldWork *work, float level, float *values)
{
    BoundaryJob job = {work, level, values};
    pool_for(work->pool, work->blocks->count, BOUNDARY_GRAIN, cut_blocks, &job);
}
