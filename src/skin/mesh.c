#include "skin/mesh.h"

#include <math.h>
#include <string.h>

enum { MESH_GRAIN = 2, OCTANTS = 8 };

static const int box_step[3] = {1, BOX_AXIS, BOX_AXIS * BOX_AXIS};

/* Point (x, y, z) of the block in its box. */
static int box_at(int x, int y, int z) { return ((z + BOX_MARGIN) * BOX_AXIS + y + BOX_MARGIN) * BOX_AXIS + x + BOX_MARGIN; }

static const uint8_t ones[8] = {0, 1, 1, 2, 1, 2, 2, 3};

/* The block itself and those above it: bit a of the number tells of axis a. */
static int32_t block_above(const SkinBlock *block, int octant)
{
    return block->neighbour[BLOCK_NEIGHBOURS / 2 + (octant & 1) + (octant >> 1 & 1) * 3 + (octant >> 2) * 9];
}

/* The number of the lowest bit that is set, which is taken away. */
static int take_bit(uint64_t *bits)
{
    const int bit = __builtin_ctzll(*bits);
    *bits &= *bits - 1;
    return bit;
}

/* ---- Points inside ---- */

/* From eight bytes that are 0 or 1, one bit each: byte i goes to bit 56 + i. */
static uint64_t bits_of(const uint8_t *bytes)
{
    uint64_t row;
    memcpy(&row, bytes, sizeof row);
    return row * 0x0102040810204080u >> 56;
}

static void find_inside(const float values[BLOCK_POINTS], float level, uint64_t plane[BLOCK_AXIS])
{
    uint8_t inside[BLOCK_POINTS];
    for (int i = 0; i < BLOCK_POINTS; i++) inside[i] = values[i] >= level;
    memset(plane, 0, BLOCK_AXIS * sizeof *plane);
    for (int row = 0; row < BLOCK_AXIS * BLOCK_AXIS; row++) plane[row / BLOCK_AXIS] |= bits_of(inside + row * BLOCK_AXIS) << row % BLOCK_AXIS * BLOCK_AXIS;
}

static void mark_blocks(void *context, int32_t begin, int32_t end)
{
    const SkinMesh *mesh = context;
    for (int32_t i = begin; i < end; i++) {
        const int32_t b = blocks_number(mesh->blocks, i);
        SkinBlock *block = blocks_at(mesh->blocks, b);
        if (!block->changed) continue;
        if (block->least < mesh->level && block->most >= mesh->level)
            find_inside(blocks_layer(mesh->blocks, mesh->field, b), mesh->level, block->inside);
        else
            memset(block->inside, block->most >= mesh->level ? 0xFF : 0, sizeof block->inside);
    }
}

/* ---- Counting ---- */

/* Whether the surface passes between points of the block and those above them. */
static bool may_cut(const SkinMesh *mesh, const SkinBlock *block)
{
    bool below = false, above = false;
    for (int octant = 0; octant < OCTANTS; octant++) {
        const int32_t other = block_above(block, octant);
        below |= other == GRID_NOWHERE || blocks_at(mesh->blocks, other)->least < mesh->level;
        above |= other != GRID_NOWHERE && blocks_at(mesh->blocks, other)->most >= mesh->level;
    }
    return below && above;
}

/* A plane of points, moved by one along x: the last of a row is the first of the plane beside it. */
static uint64_t one_along_x(uint64_t plane, uint64_t beside) { return (plane >> 1 & 0x7f7f7f7f7f7f7f7fu) | (beside << 7 & 0x8080808080808080u); }

static uint64_t one_along_y(uint64_t plane, uint64_t beside) { return plane >> BLOCK_AXIS | beside << (BLOCK_POINTS / BLOCK_AXIS - BLOCK_AXIS); }

/* Which are inside of the points of plane z, and of those one along x, along y and along both. */
static void see_plane(const SkinMesh *mesh, const SkinBlock *block, int z, uint64_t corner[4])
{
    uint64_t beside[4];
    for (int side = 0; side < 4; side++) {
        const int32_t other = block_above(block, side + z / BLOCK_AXIS * 4);
        beside[side] = other == GRID_NOWHERE ? 0 : blocks_at(mesh->blocks, other)->inside[z % BLOCK_AXIS];
    }
    corner[0] = beside[0];
    corner[1] = one_along_x(beside[0], beside[1]);
    corner[2] = one_along_y(beside[0], beside[2]);
    corner[3] = one_along_y(corner[1], one_along_x(beside[2], beside[3]));
}

/* Of the cubes above the points of a plane: those that have corners on both sides. */
static uint64_t cut_cubes(const uint64_t corner[CUBE_CORNERS])
{
    uint64_t any = 0, all = UINT64_MAX;
    for (int c = 0; c < CUBE_CORNERS; c++) {
        any |= corner[c];
        all &= corner[c];
    }
    return any & ~all;
}

static void count_block(const SkinMesh *mesh, int32_t b)
{
    SkinBlock *block = blocks_at(mesh->blocks, b);
    uint64_t corner[CUBE_CORNERS];
    see_plane(mesh, block, 0, corner + 4);
    for (int z = 0; z < BLOCK_AXIS; z++) {
        memcpy(corner, corner + 4, 4 * sizeof *corner);
        see_plane(mesh, block, z + 1, corner + 4);
        block->cut[z] = cut_cubes(corner);
        for (uint64_t cubes = block->cut[z]; cubes;) {
            const int bit = take_bit(&cubes);
            const size_t i = (size_t)b * BLOCK_POINTS + (size_t)(z * BLOCK_AXIS * BLOCK_AXIS + bit);
            uint8_t inside = 0;
            for (int c = 0; c < CUBE_CORNERS; c++) inside |= (uint8_t)((corner[c] >> bit & 1) << c);
            mesh->inside[i] = inside;
            mesh->start[i] = (uint16_t)block->vertices;
            block->vertices += ones[case_cuts(inside)];
            block->triangles += mesh->cases->triangles[inside];
        }
    }
}

static void count_blocks(void *context, int32_t begin, int32_t end)
{
    const SkinMesh *mesh = context;
    for (int32_t i = begin; i < end; i++) {
        const int32_t b = blocks_number(mesh->blocks, i);
        SkinBlock *block = blocks_at(mesh->blocks, b);
        if (!block->due) continue;
        block->vertices = block->triangles = 0;
        memset(block->cut, 0, sizeof block->cut);
        if (may_cut(mesh, block)) count_block(mesh, b);
    }
}

int32_t mesh_count(const SkinMesh *mesh, uint64_t *vertices, uint64_t *triangles)
{
    int32_t changed = 0;
    *vertices = *triangles = 0;
    blocks_spread(mesh->blocks, mesh->pool, offsetof(SkinBlock, changed), offsetof(SkinBlock, due)); /* cubes have corners in the blocks above */
    pool_for(mesh->pool, mesh->blocks->count, MESH_GRAIN, mark_blocks, (void *)mesh);
    pool_for(mesh->pool, mesh->blocks->count, MESH_GRAIN, count_blocks, (void *)mesh);
    for (int32_t i = 0; i < mesh->blocks->count; i++) {
        SkinBlock *block = blocks_at(mesh->blocks, blocks_number(mesh->blocks, i));
        block->first_vertex = (uint32_t)*vertices;
        block->first_triangle = (uint32_t)*triangles;
        *vertices += block->vertices;
        *triangles += block->triangles;
        changed += block->changed;
    }
    return changed;
}

/* ---- Vertices ---- */

/* A cut edge, as it is in the box of its block. */
typedef struct CutEdge {
    uint32_t vertex;
    int point[3], axis, from, to;
    float share; /* of the way */
} CutEdge;

typedef void WithEdge(const CutEdge *edge, void *context);

static void visit_edges(const SkinMesh *mesh, int32_t b, const float box[BOX_POINTS], WithEdge *with, void *context)
{
    const SkinBlock *block = blocks_at(mesh->blocks, b);
    uint32_t vertex = block->first_vertex;
    for (int z = 0; z < BLOCK_AXIS; z++)
        for (uint64_t cubes = block->cut[z]; cubes;) {
            const int bit = take_bit(&cubes), x = bit % BLOCK_AXIS, y = bit / BLOCK_AXIS;
            const int cut = case_cuts(mesh->inside[(size_t)b * BLOCK_POINTS + (size_t)(z * BLOCK_AXIS * BLOCK_AXIS + bit)]);
            for (int a = 0; a < 3 && cut >> a; a++) {
                if (!(cut >> a & 1)) continue;
                CutEdge edge = {.vertex = vertex++, .point = {x, y, z}, .axis = a, .from = box_at(x, y, z)};
                edge.to = edge.from + box_step[a];
                edge.share = (mesh->level - box[edge.from]) / (box[edge.to] - box[edge.from]);
                with(&edge, context);
            }
        }
}

static float at_share(const CutEdge *edge, float from, float to) { return from + edge->share * (to - from); }

static void put(MeshStream out, uint32_t vertex, const float *values, size_t count)
{
    if (out.base) memcpy(out.base + vertex * out.stride, values, count * sizeof *values);
}

typedef struct PlacesJob {
    const SkinMesh *mesh;
    MeshStream positions, normals;
    const SkinBlock *block;
    const float *box;
} PlacesJob;

/* Against the gradient of F, by differences over two points at both ends; where that is 0, along the edge. */
static void normal_at(const float box[BOX_POINTS], const CutEdge *edge, float normal[3])
{
    float length2 = 0.0f;
    for (int a = 0; a < 3; a++) {
        const int step = box_step[a];
        normal[a] = at_share(edge, box[edge->from - step] - box[edge->from + step], box[edge->to - step] - box[edge->to + step]);
        length2 += normal[a] * normal[a];
    }
    if (length2 > 0.0f) {
        for (int a = 0; a < 3; a++) normal[a] /= sqrtf(length2);
        return;
    }
    normal[edge->axis] = box[edge->from] > box[edge->to] ? 1.0f : -1.0f;
}

static void write_place(const CutEdge *edge, void *context)
{
    const PlacesJob *job = context;
    const SkinMesh *mesh = job->mesh;
    float position[3], normal[3];
    for (int a = 0; a < 3; a++) {
        const int64_t point = lattice_point(mesh->blocks->subdivision, job->block->place[a]) + edge->point[a];
        position[a] = (float)(mesh->spacing * ((double)point + mesh->first + (a == edge->axis ? (double)edge->share : 0.0)));
    }
    put(job->positions, edge->vertex, position, 3);
    if (!job->normals.base) return;
    normal_at(job->box, edge, normal);
    put(job->normals, edge->vertex, normal, 3);
}

static void write_places(void *context, int32_t begin, int32_t end)
{
    for (int32_t i = begin; i < end; i++) {
        const int32_t b = blocks_number(((const PlacesJob *)context)->mesh->blocks, i);
        PlacesJob job = *(const PlacesJob *)context;
        float box[BOX_POINTS];
        job.block = blocks_at(job.mesh->blocks, b);
        job.box = box;
        if (!job.block->vertices) continue;
        blocks_gather(job.mesh->blocks, job.block, job.mesh->field, box);
        visit_edges(job.mesh, b, box, write_place, &job);
    }
}

void mesh_write_places(const SkinMesh *mesh, MeshStream positions, MeshStream normals)
{
    PlacesJob job = {.mesh = mesh, .positions = positions, .normals = normals};
    pool_for(mesh->pool, mesh->blocks->count, MESH_GRAIN, write_places, &job);
}

typedef struct MeanJob {
    const SkinMesh *mesh;
    const float *values, *weights;
    MeshStream out;
    const float *value_box, *weight_box;
} MeanJob;

static void write_mean(const CutEdge *edge, void *context)
{
    const MeanJob *job = context;
    const float weight = at_share(edge, job->weight_box[edge->from], job->weight_box[edge->to]);
    const float mean = at_share(edge, job->value_box[edge->from], job->value_box[edge->to]) / weight;
    put(job->out, edge->vertex, &mean, 1);
}

static void write_means(void *context, int32_t begin, int32_t end)
{
    for (int32_t i = begin; i < end; i++) {
        const int32_t b = blocks_number(((const MeanJob *)context)->mesh->blocks, i);
        MeanJob job = *(const MeanJob *)context;
        float box[BOX_POINTS], value_box[BOX_POINTS], weight_box[BOX_POINTS];
        const SkinBlock *block = blocks_at(job.mesh->blocks, b);
        if (!block->vertices) continue;
        blocks_gather(job.mesh->blocks, block, job.mesh->field, box);
        blocks_gather(job.mesh->blocks, block, &(Layer){.values = job.values}, value_box);
        blocks_gather(job.mesh->blocks, block, &(Layer){.values = job.weights}, weight_box);
        job.value_box = value_box;
        job.weight_box = weight_box;
        visit_edges(job.mesh, b, box, write_mean, &job);
    }
}

void mesh_write_mean(const SkinMesh *mesh, const float *values, const float *weights, MeshStream out)
{
    MeanJob job = {.mesh = mesh, .values = values, .weights = weights, .out = out};
    pool_for(mesh->pool, mesh->blocks->count, MESH_GRAIN, write_means, &job);
}

/* ---- Triangles ---- */

typedef struct IndicesJob {
    const SkinMesh *mesh;
    void *indices;
    uint32_t index_bytes;
} IndicesJob;

/* Where the numbers of vertices come from: of a block and of those above it. */
typedef struct Numbers {
    uint32_t first[OCTANTS];
    const uint16_t *start[OCTANTS];
    const uint8_t *inside[OCTANTS];
} Numbers;

static void find_numbers(const SkinMesh *mesh, const SkinBlock *block, Numbers *numbers)
{
    for (int octant = 0; octant < OCTANTS; octant++) {
        const int32_t other = block_above(block, octant);
        if (other == GRID_NOWHERE) continue; /* it has no vertices */
        numbers->first[octant] = blocks_at(mesh->blocks, other)->first_vertex;
        numbers->start[octant] = mesh->start + (size_t)other * BLOCK_POINTS;
        numbers->inside[octant] = mesh->inside + (size_t)other * BLOCK_POINTS;
    }
}

/* The number of the vertex on an edge of the cube above a point, as case_digits() has it: bit 3 of a digit tells that it is in the next block. */
static uint32_t vertex_on(const Cases *cases, const Numbers *numbers, unsigned point, int edge)
{
    const unsigned at = point + cases->corner[edge];
    const unsigned octant = (at >> 3 & 1) | (at >> 6 & 2) | (at >> 9 & 4), i = (at & 7) | (at >> 1 & 070) | (at >> 2 & 0700);
    return numbers->first[octant] + numbers->start[octant][i] + cases->before[numbers->inside[octant][i]][case_axis(edge)];
}

static void put_index(const IndicesJob *job, size_t place, uint32_t index)
{
    const uint16_t narrow = (uint16_t)index;
    if (job->index_bytes == 2)
        memcpy((char *)job->indices + place * 2, &narrow, sizeof narrow);
    else
        memcpy((char *)job->indices + place * 4, &index, sizeof index);
}

static void write_block(const IndicesJob *job, int32_t b)
{
    const SkinMesh *mesh = job->mesh;
    const SkinBlock *block = blocks_at(mesh->blocks, b);
    size_t place = (size_t)block->first_triangle * 3;
    Numbers numbers = {0};
    find_numbers(mesh, block, &numbers);
    for (unsigned z = 0; z < BLOCK_AXIS; z++)
        for (uint64_t cubes = block->cut[z]; cubes;) {
            const unsigned bit = (unsigned)take_bit(&cubes), point = case_digits(bit % BLOCK_AXIS, bit / BLOCK_AXIS, z);
            const uint8_t inside = numbers.inside[0][z * BLOCK_AXIS * BLOCK_AXIS + bit];
            const uint8_t *edge = mesh->cases->edge[inside];
            for (int e = 0; e < 3 * mesh->cases->triangles[inside]; e++) put_index(job, place++, vertex_on(mesh->cases, &numbers, point, edge[e]));
        }
}

static void write_indices(void *context, int32_t begin, int32_t end)
{
    const IndicesJob *job = context;
    for (int32_t i = begin; i < end; i++) {
        const int32_t b = blocks_number(job->mesh->blocks, i);
        if (blocks_at(job->mesh->blocks, b)->triangles) write_block(job, b);
    }
}

void mesh_write_indices(const SkinMesh *mesh, void *indices, uint32_t index_bytes)
{
    IndicesJob job = {mesh, indices, index_bytes};
    pool_for(mesh->pool, mesh->blocks->count, MESH_GRAIN, write_indices, &job);
}
