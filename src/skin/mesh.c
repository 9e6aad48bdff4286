#include "skin/mesh.h"

#include <math.h>
#include <string.h>

enum { MESH_GRAIN = 2, CORNER_AXIS = BLOCK_AXIS + 1, CORNERS = CORNER_AXIS * CORNER_AXIS * CORNER_AXIS };

static int point_at(int x, int y, int z) { return (z * BLOCK_AXIS + y) * BLOCK_AXIS + x; }

static const int box_step[3] = {1, BOX_AXIS, BOX_AXIS * BOX_AXIS};

/* Point (x, y, z) of the block in its box. */
static int box_at(int x, int y, int z) { return ((z + BOX_MARGIN) * BOX_AXIS + y + BOX_MARGIN) * BOX_AXIS + x + BOX_MARGIN; }

/* Bit a: the edge along axis a from the first corner of a cube is cut. Corners 1, 2 and 4 are the ends of those. */
static uint8_t cut_edges(uint8_t inside)
{
    const int ends = (inside >> 1 & 3) | (inside >> 2 & 4);
    return (uint8_t)(inside & 1 ? ends ^ 7 : ends);
}

static const uint8_t ones[8] = {0, 1, 1, 2, 1, 2, 2, 3};

/* Whether the surface passes all cubes of a row by: their corners are all inside, or all outside. */
static bool row_is_whole(const uint8_t *inside)
{
    uint64_t row;
    memcpy(&row, inside, sizeof row);
    return row == 0 || row == UINT64_MAX;
}

/* ---- Counting ---- */

/* Whether the surface passes between points of the block and those above them. */
static bool may_cut(const SkinMesh *mesh, const SkinBlock *block)
{
    bool below = false, above = false;
    for (int n = 0; n < BLOCK_NEIGHBOURS; n++) {
        if (n % 3 == 0 || n / 3 % 3 == 0 || n / 9 == 0) continue;
        const int32_t other = block->neighbour[n];
        below |= other == GRID_NOWHERE || blocks_at(mesh->blocks, other)->least < mesh->level;
        above |= other != GRID_NOWHERE && blocks_at(mesh->blocks, other)->most >= mesh->level;
    }
    return below && above;
}

/* Per cube of the block: its inside corners. */
static void find_cases(const SkinMesh *mesh, const float box[BOX_POINTS], uint8_t cases[BLOCK_POINTS])
{
    uint8_t inside[CORNERS];
    for (int z = 0, at = 0; z < CORNER_AXIS; z++)
        for (int y = 0; y < CORNER_AXIS; y++)
            for (int x = 0; x < CORNER_AXIS; x++, at++) inside[at] = box[box_at(x, y, z)] >= mesh->level;
    for (int z = 0; z < BLOCK_AXIS; z++)
        for (int y = 0; y < BLOCK_AXIS; y++)
            for (int x = 0; x < BLOCK_AXIS; x++) {
                const uint8_t *low = &inside[(z * CORNER_AXIS + y) * CORNER_AXIS + x], *high = low + CORNER_AXIS * CORNER_AXIS;
                cases[point_at(x, y, z)] = (uint8_t)(low[0] | low[1] << 1 | low[CORNER_AXIS] << 2 | low[CORNER_AXIS + 1] << 3 | high[0] << 4 |
                                                     high[1] << 5 | high[CORNER_AXIS] << 6 | high[CORNER_AXIS + 1] << 7);
            }
}

static void count_blocks(void *context, int32_t begin, int32_t end)
{
    const SkinMesh *mesh = context;
    for (int32_t b = begin; b < end; b++) {
        SkinBlock *block = blocks_at(mesh->blocks, b);
        uint8_t *inside = mesh->inside + (size_t)b * BLOCK_POINTS;
        uint16_t *start = mesh->start + (size_t)b * BLOCK_POINTS;
        float box[BOX_POINTS];
        block->vertices = block->triangles = 0;
        if (!may_cut(mesh, block)) continue;
        blocks_gather(block, mesh->field, box);
        find_cases(mesh, box, inside);
        for (int row = 0; row < BLOCK_POINTS; row += BLOCK_AXIS)
            for (int i = row; i < row + BLOCK_AXIS && !row_is_whole(inside + row); i++) {
                start[i] = (uint16_t)block->vertices;
                block->vertices += ones[cut_edges(inside[i])];
                block->triangles += mesh->cases->triangles[inside[i]];
            }
    }
}

void mesh_count(const SkinMesh *mesh, uint64_t *vertices, uint64_t *triangles)
{
    *vertices = *triangles = 0;
    pool_for(mesh->pool, mesh->blocks->count, MESH_GRAIN, count_blocks, (void *)mesh);
    for (int32_t b = 0; b < mesh->blocks->count; b++) {
        SkinBlock *block = blocks_at(mesh->blocks, b);
        block->first_vertex = (uint32_t)*vertices;
        block->first_triangle = (uint32_t)*triangles;
        *vertices += block->vertices;
        *triangles += block->triangles;
    }
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
    uint32_t vertex = blocks_at(mesh->blocks, b)->first_vertex;
    const uint8_t *inside = mesh->inside + (size_t)b * BLOCK_POINTS;
    for (int i = 0; i < BLOCK_POINTS; i++) {
        if (i % BLOCK_AXIS == 0 && row_is_whole(inside + i)) {
            i += BLOCK_AXIS - 1;
            continue;
        }
        const uint8_t cut = cut_edges(inside[i]);
        for (int a = 0; a < 3 && cut >> a; a++) {
            if (!(cut >> a & 1)) continue;
            CutEdge edge = {.vertex = vertex++, .point = {i % BLOCK_AXIS, i / BLOCK_AXIS % BLOCK_AXIS, i / (BLOCK_AXIS * BLOCK_AXIS)}, .axis = a};
            edge.from = box_at(edge.point[0], edge.point[1], edge.point[2]);
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
        const int64_t point = ((int64_t)mesh->blocks->anchor[a] * mesh->blocks->subdivision) + (int64_t)job->block->place[a] * BLOCK_AXIS + edge->point[a];
        position[a] = (float)(mesh->spacing * ((double)point + mesh->first + (a == edge->axis ? (double)edge->share : 0.0)));
    }
    put(job->positions, edge->vertex, position, 3);
    if (!job->normals.base) return;
    normal_at(job->box, edge, normal);
    put(job->normals, edge->vertex, normal, 3);
}

static void write_places(void *context, int32_t begin, int32_t end)
{
    for (int32_t b = begin; b < end; b++) {
        PlacesJob job = *(const PlacesJob *)context;
        float box[BOX_POINTS];
        job.block = blocks_at(job.mesh->blocks, b);
        job.box = box;
        if (!job.block->vertices) continue;
        blocks_gather(job.block, job.mesh->field, box);
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
    for (int32_t b = begin; b < end; b++) {
        MeanJob job = *(const MeanJob *)context;
        float box[BOX_POINTS], value_box[BOX_POINTS], weight_box[BOX_POINTS];
        const SkinBlock *block = blocks_at(job.mesh->blocks, b);
        if (!block->vertices) continue;
        blocks_gather(block, job.mesh->field, box);
        blocks_gather(block, job.values, value_box);
        blocks_gather(block, job.weights, weight_box);
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

/* How many edges of a point are cut before that along an edge's axis. */
static uint32_t cut_before(uint8_t inside, int edge) { return ones[cut_edges(inside) & ((1 << case_axis(edge)) - 1)]; }

/* The number of the vertex on an edge of the cube above a point. */
static uint32_t vertex_on(const SkinMesh *mesh, int32_t b, const int point[3], int edge)
{
    int at[3], side[3];
    for (int a = 0; a < 3; a++) {
        at[a] = point[a] + (case_corner(edge) >> a & 1);
        side[a] = at[a] == BLOCK_AXIS ? 2 : 1;
        at[a] %= BLOCK_AXIS;
    }
    const int32_t owner = blocks_at(mesh->blocks, b)->neighbour[(side[2] * 3 + side[1]) * 3 + side[0]];
    const size_t i = (size_t)owner * BLOCK_POINTS + (size_t)point_at(at[0], at[1], at[2]);
    return blocks_at(mesh->blocks, owner)->first_vertex + mesh->start[i] + cut_before(mesh->inside[i], edge);
}

/* The same where the cube has all its corners in the block. */
static uint32_t vertex_within(const SkinMesh *mesh, int32_t b, int point, int edge)
{
    const int corner = case_corner(edge);
    const size_t i = (size_t)b * BLOCK_POINTS + (size_t)(point + point_at(corner & 1, corner >> 1 & 1, corner >> 2));
    return blocks_at(mesh->blocks, b)->first_vertex + mesh->start[i] + cut_before(mesh->inside[i], edge);
}

static void put_index(const IndicesJob *job, size_t place, uint32_t index)
{
    const uint16_t narrow = (uint16_t)index;
    if (job->index_bytes == 2)
        memcpy((char *)job->indices + place * 2, &narrow, sizeof narrow);
    else
        memcpy((char *)job->indices + place * 4, &index, sizeof index);
}

static void write_indices(void *context, int32_t begin, int32_t end)
{
    const IndicesJob *job = context;
    const SkinMesh *mesh = job->mesh;
    for (int32_t b = begin; b < end; b++) {
        const SkinBlock *block = blocks_at(mesh->blocks, b);
        const uint8_t *inside = mesh->inside + (size_t)b * BLOCK_POINTS;
        size_t place = (size_t)block->first_triangle * 3;
        if (!block->triangles) continue;
        for (int i = 0; i < BLOCK_POINTS; i++) {
            if (i % BLOCK_AXIS == 0 && row_is_whole(inside + i)) {
                i += BLOCK_AXIS - 1;
                continue;
            }
            const int point[3] = {i % BLOCK_AXIS, i / BLOCK_AXIS % BLOCK_AXIS, i / (BLOCK_AXIS * BLOCK_AXIS)};
            const bool within = point[0] < BLOCK_AXIS - 1 && point[1] < BLOCK_AXIS - 1 && point[2] < BLOCK_AXIS - 1;
            for (int e = 0; e < 3 * mesh->cases->triangles[inside[i]]; e++) {
                const int edge = mesh->cases->edge[inside[i]][e];
                put_index(job, place++, within ? vertex_within(mesh, b, i, edge) : vertex_on(mesh, b, point, edge));
            }
        }
    }
}

void mesh_write_indices(const SkinMesh *mesh, void *indices, uint32_t index_bytes)
{
    IndicesJob job = {mesh, indices, index_bytes};
    pool_for(mesh->pool, mesh->blocks->count, MESH_GRAIN, write_indices, &job);
}
