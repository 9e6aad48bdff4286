#include "skin/boundary.h"

#include <math.h>
#include <string.h>

#include "contact/field.h"

enum { BOUNDARY_GRAIN = 2, PART_AXIS = 4 };

/* So far [cells] outside of a flat surface F is 0 but for a ripple of S: what is farther from a wall has no image. */
static const double IMAGE_REACH = 0.75;
/* What is farther [cells] from a point does not change what it sees. A point up to a cell deep in an obstacle sees what its reflection sees, IMAGE_REACH beside it: the
 * way there is the root of 1 + 0.75^2. */
static const double BESIDE_REACH = 1.25;
/* Of F at a flat surface, per cell: S W at 0. */
static const float FLAT_SLOPE = 29.0f / 32.0f;
/* The points that cubes at the surface have in obstacles are less deep [cells]. */
static double deepest(const FieldWork *work) { return 1.0 / work->blocks->subdivision; }

static Stand stand_of(const BakedTable *baked, const Obstacle *o)
{
    Stand stand;
    memset(&stand, 0, sizeof stand); /* its padding, too */
    memcpy(&stand.solid, &o->start, sizeof stand.solid);
    stand.meets = o->meets;
    stand.baked = baked_generation(baked, o->start.grid);
    return stand;
}

bool boundary_find(Boundary *boundary, World *world)
{
    const size_t room = world->colliders.room + DOMAIN_WALLS;
    if (!array_reserve(&world->memory, &boundary->obstacle, room, sizeof(Obstacle)) || !array_reserve(&world->memory, &boundary->stand, room, sizeof(Stand))) return false;
    boundary->colliders = world->colliders;
    boundary->colliders.obstacle = boundary->obstacle.data;
    colliders_begin_substep(&boundary->colliders, &world->domain, world->def.dimension, 0, 1);
    const int count = boundary->colliders.obstacle_count;
    boundary->changed = count != boundary->stands;
    boundary->stands = count;
    boundary->surface++;
    for (int i = 0; i < count; i++) {
        Stand *stood = (Stand *)boundary->stand.data + i, stands = stand_of(&world->baked, &boundary->colliders.obstacle[i]);
        stands.surface = stood->surface;
        if (memcmp(stood, &stands, sizeof stands) == 0) continue;
        stands.surface = boundary->surface;
        *stood = stands;
        boundary->changed = true;
    }
    return true;
}

void boundary_free(Boundary *boundary, Memory *memory)
{
    array_free(memory, &boundary->obstacle);
    array_free(memory, &boundary->stand);
}

/* ---- Distances ---- */

/* A block whose points are looked at. */
typedef struct Part {
    const FieldWork *work;
    SkinBlock *block;
    size_t point; /* its first */
    float *mirrored, *gaps; /* of the block: where they go */
    double origin[3], spacing; /* of its points [m] */
    Near around;               /* the obstacles that may hide an image of its points */
    Near close, beside;        /* those near it, and near a part of it */
} Part;

static void begin_part(Part *part, const FieldWork *work, int32_t b)
{
    const SkinBlocks *blocks = work->blocks;
    part->work = work;
    part->block = blocks_at(blocks, b);
    part->point = (size_t)b * BLOCK_POINTS;
    part->spacing = work->cell_size / blocks->subdivision;
    for (int a = 0; a < 3; a++) {
        const int64_t first = lattice_point(blocks->subdivision, part->block->place[a]);
        part->origin[a] = ((double)first - (double)field_shift(blocks)) * part->spacing;
    }
}

/* A place in points from the first point of the block, in metres. */
static void place_of(const Part *part, const double local[3], double place[3])
{
    for (int a = 0; a < 3; a++) place[a] = part->origin[a] + local[a] * part->spacing;
}

/* The middle of a cube of points, and how far its corners are [cells]. */
static double middle_of(const Part *part, const int first[3], int axis, double middle[3])
{
    const double half = 0.5 * (axis - 1), local[3] = {first[0] + half, first[1] + half, first[2] + half};
    place_of(part, local, middle);
    return sqrt(3.0) * half / part->work->blocks->subdivision;
}

/* Those of a list that are within `reach` [cells] of a place. */
static void narrow(const Near *all, const double place[3], double reach, Near *some)
{
    some->cell_size = all->cell_size;
    some->dimension = all->dimension;
    some->at_end = all->at_end;
    some->count = 0;
    for (int i = 0; i < all->count; i++)
        if (solid_gap(field_solid(all, all->obstacle[i]), place) < reach * all->cell_size) some->obstacle[some->count++] = all->obstacle[i];
}

/* A point is at most this far [cells] before or behind each plane that it is reflected in, and so an image is within twice that of all of them. What is half a point off does
 * not hide it. */
static double images_reach(const FieldWork *work) { return FIELD_FACES * 2.0 * fmax(IMAGE_REACH, deepest(work)) + 0.5 / work->blocks->subdivision; }

static void near_block(Part *part)
{
    static const int first[3] = {0, 0, 0};
    const Grid flat = {.dimension = 3};
    ContactFrame frame = {.colliders = (Colliders *)(uintptr_t)&part->work->boundary->colliders, .grid = &flat, .cell_size = part->work->cell_size};
    double middle[3];
    const double half = middle_of(part, first, BLOCK_AXIS, middle);
    field_near(&part->around, &frame, middle, half + images_reach(part->work), false);
    field_keep(&part->around, part->work->groups);
    narrow(&part->around, middle, half + BESIDE_REACH, &part->close);
}

/* False: none is. */
static bool near_part(Part *part, const int first[3])
{
    double middle[3];
    const double half = middle_of(part, first, PART_AXIS, middle);
    narrow(&part->close, middle, half + BESIDE_REACH, &part->beside);
    return part->beside.count > 0;
}

static void point_of(int i, double local[3])
{
    local[0] = i % BLOCK_AXIS;
    local[1] = i / BLOCK_AXIS % BLOCK_AXIS;
    local[2] = i / (BLOCK_AXIS * BLOCK_AXIS);
}

/* What has less than this is outside whatever it is mirrored in: three planes make it 8 times as much. */
static float least_that_counts(float level) { return 0.125f * level; }

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

/* What a point sees of obstacles. */
typedef struct Sight {
    double gap;  /* how far [cells] the nearest is */
    int count;   /* how many are within BESIDE_REACH */
    const Obstacle *nearest;
} Sight;

static Sight look_around(const Part *part, const double place[3])
{
    Sight sight = {.gap = INFINITY};
    for (int i = 0; i < part->beside.count; i++) {
        const Obstacle *o = part->beside.obstacle[i];
        const double gap = solid_gap(field_solid(&part->beside, o), place) / part->beside.cell_size;
        sight.count += gap < BESIDE_REACH;
        if (gap >= sight.gap) continue;
        sight.gap = gap;
        sight.nearest = o;
    }
    return sight;
}

/* The planes around a point: of an obstacle by itself that of its nearest place. A baked one may have hollows. */
static int planes_at(const Part *part, const Sight *sight, const double place[3], Face face[FIELD_FACES])
{
    const Solid *solid = field_solid(&part->beside, sight->nearest);
    if (sight->count > 1 || solid->grid) return field_faces(&part->beside, place, IMAGE_REACH, face);
    face[0].distance = solid_distance(solid, place, face[0].normal) / part->beside.cell_size;
    return 1;
}

/* Reflects a place in points in a set of planes. */
static void reflect(const Part *part, const Face *face, int set, const double local[3], double image[3])
{
    memcpy(image, local, 3 * sizeof *image);
    for (int f = 0; set >> f; f++)
        for (int a = 0; a < 3 && set >> f & 1; a++) image[a] -= 2.0 * face[f].distance * face[f].normal[a] * part->work->blocks->subdivision;
}

static double hidden_by(const Part *part, const Near *near, const double place[3]) { return 0.5 - field_distance(near, place) * part->work->blocks->subdivision; }

/* The share of an image that lies in obstacles: beside the end of a wall is open space, whose matter is no image. */
static float hidden_share(const Part *part, const double image[3])
{
    double place[3];
    place_of(part, image, place);
    double share = hidden_by(part, &part->beside, place);
    if (share < 1.0) share = hidden_by(part, &part->around, place); /* it is no less */
    return share < 0.0 ? 0.0f : share > 1.0 ? 1.0f : (float)share;
}

/* F at a point and at all that it is reflected to. Of a point in an obstacle it is that of its reflection before it. */
static float with_images(const Part *part, const Sight *sight, const float *values, const double local[3], const double place[3], float at_point)
{
    double image[3];
    Face face[FIELD_FACES];
    int before = 0;
    const int count = planes_at(part, sight, place, face);
    for (int f = 0; f < count; f++) before |= (face[f].distance < 0.0) << f;
    reflect(part, face, before, local, image);
    const float own = before ? field_at(part->block, values, image) : at_point;
    float sum = own;
    for (int set = 0; set < 1 << count; set++) {
        if (set == before) continue;
        reflect(part, face, set, local, image);
        const float share = hidden_share(part, image), seen = share > 0.0f ? field_at(part->block, values, image) : 0.0f;
        sum += share * (seen < own ? seen : own);
    }
    return sum;
}

/* F at a flat surface, so far before it. */
static float flat_at(float gap) { return 0.5f + FLAT_SLOPE * gap; }

static float cut_at(float level, float gap) { return level + FLAT_SLOPE * gap; }

/* Measures how far the obstacles are from a point that counts, and writes what it has with its images. */
static void mirror_point(Part *part, int i, const float *own, float *gap, float *mirrored)
{
    double local[3], place[3];
    point_of(i, local);
    place_of(part, local, place);
    const Sight sight = look_around(part, place);
    *gap = (float)sight.gap;
    part->block->bounded = true;
    if ((double)*gap <= -deepest(part->work) || (double)*gap >= IMAGE_REACH) return;
    /* Whole matter has an image like itself. */
    *mirrored = *own >= flat_at(*gap) ? *own + flat_at(-*gap) : with_images(part, &sight, part->work->filling, local, place, *own);
}

/* The first point of the n-th row of a part with this first point. */
static int row_of(const int first[3], int n) { return ((first[2] + n / PART_AXIS) * BLOCK_AXIS + first[1] + n % PART_AXIS) * BLOCK_AXIS + first[0]; }

/* Whether a part of a row has a point that counts. */
static bool counts(const float *values, float least)
{
    bool any = false;
    for (int x = 0; x < PART_AXIS; x++) any |= values[x] > least;
    return any;
}

/* From one point to the next the gap changes by no more than their distance. Points so far off that neither an image nor the cut changes them are passed over. */
static void mirror_row(Part *part, int first)
{
    const FieldWork *work = part->work;
    const double spacing = 1.0 / work->blocks->subdivision;
    const float *own = work->filling + part->point + first, least = least_that_counts(work->level);
    double at_least = -INFINITY;
    for (int x = 0; x < PART_AXIS; x++, at_least -= spacing) {
        if (own[x] <= least || (at_least >= IMAGE_REACH && cut_at(work->level, (float)at_least) >= own[x])) continue;
        mirror_point(part, first + x, &own[x], &part->gaps[first + x], &part->mirrored[first + x]);
        at_least = (double)part->gaps[first + x];
    }
}

/* The rows of a part that count; bit n is the n-th. */
static uint32_t rows_that_count(const Part *part, const int first[3])
{
    uint32_t rows = 0;
    for (int n = 0; n < PART_AXIS * PART_AXIS; n++)
        rows |= (uint32_t)counts(part->work->filling + part->point + row_of(first, n), least_that_counts(part->work->level)) << n;
    return rows;
}

static void mirror_part(Part *part, const int first[3])
{
    const uint32_t rows = rows_that_count(part, first);
    if (!rows || !near_part(part, first)) return;
    for (int n = 0; n < PART_AXIS * PART_AXIS; n++)
        if (rows >> n & 1) mirror_row(part, row_of(first, n));
}

static void mirror_parts(Part *part)
{
    part->block->bounded = false;
    for (int i = 0; i < BLOCK_POINTS; i++) part->gaps[i] = INFINITY;
    if (part->close.count > 0) memcpy(part->mirrored, part->work->filling + part->point, BLOCK_POINTS * sizeof(float));
    for (int n = 0; n < 8 && part->close.count > 0; n++) {
        const int first[3] = {(n & 1) * PART_AXIS, (n >> 1 & 1) * PART_AXIS, (n >> 2) * PART_AXIS};
        mirror_part(part, first);
    }
}

/* Of a block whose F has changed, all has. Of others it is seen when it is there. */
static void mirror_block(Part *part)
{
    const FieldWork *work = part->work;
    SkinBlock *block = part->block;
    float *mirrored = work->mirrored + part->point, *gaps = work->gaps + part->point;
    const bool changed = block->changed, was_bounded = block->bounded;
    if (!was_bounded && !block->fresh && part->close.count == 0) return;
    part->mirrored = changed ? mirrored : work->lines + part->point;
    part->gaps = changed ? gaps : work->sums + part->point;
    mirror_parts(part);
    if (changed) return;
    block->changed = block->bounded != was_bounded;
    if (block->bounded && field_store(mirrored, part->mirrored)) block->changed = true;
    if (field_store(gaps, part->gaps)) block->changed = true;
}

/* A number for the obstacles near a block as they are: others have another one. 0: there are none. */
static uint64_t print_of(const Part *part)
{
    const Boundary *boundary = part->work->boundary;
    uint64_t print = 0;
    for (int i = 0; i < part->around.count && part->close.count > 0; i++) {
        const ptrdiff_t n = part->around.obstacle[i] - (const Obstacle *)boundary->obstacle.data;
        print = blocks_mix(blocks_mix(print, (uint64_t)n + 1), ((const Stand *)boundary->stand.data)[n].surface);
    }
    return print;
}

/* Whether a block is to be worked out; then the obstacles near it are known. */
static bool is_due(Part *part)
{
    SkinBlock *block = part->block;
    part->around.count = part->close.count = 0;
    if (!block->due && !part->work->boundary->changed) return false;
    if (block->filling_most > least_that_counts(part->work->level)) near_block(part);
    const uint64_t print = print_of(part);
    const bool same = print == block->obstacles;
    block->obstacles = print;
    return block->due || !same;
}

static void mirror_blocks(void *context, int32_t begin, int32_t end)
{
    const FieldWork *work = context;
    for (int32_t i = begin; i < end; i++) {
        Part part;
        begin_part(&part, work, blocks_number(work->blocks, i));
        if (is_due(&part)) mirror_block(&part);
    }
}

void boundary_mirror(const FieldWork *work)
{
    blocks_spread(work->blocks, work->pool, offsetof(SkinBlock, changed), offsetof(SkinBlock, due));
    pool_for(work->pool, work->blocks->count, BOUNDARY_GRAIN, mirror_blocks, (void *)(uintptr_t)work);
}

void boundary_cut(const FieldWork *work, float values[BLOCK_POINTS], const float gaps[BLOCK_POINTS])
{
    for (int i = 0; i < BLOCK_POINTS; i++) {
        const float most = cut_at(work->level, gaps[i]);
        values[i] = values[i] < most ? values[i] : most;
    }
}
