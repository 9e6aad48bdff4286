#include "shape/bake.h"

#include <math.h>
#include <string.h>

#include "base/numbers.h"
#include "base/result.h"
#include "shape/box_tree.h"

pbmpm_mesh_def mesh_defaults(void) { return (pbmpm_mesh_def){.size = sizeof(pbmpm_mesh_def), .dimension = 3, .resolution = 64}; }

/* ---- The grid ---- */

/* Cells as wide as the longest side takes, and the surface in the middle. */
static DistanceGrid grid_around(const pbmpm_mesh_def *def)
{
    double low[3], high[3];
    DistanceGrid grid = {.dimension = def->dimension, .count = {1, 1, 1}};
    grid.spacing = surface_bounds(def, low, high) / def->resolution;
    for (int a = 0; a < def->dimension; a++) {
        const double extent = high[a] - low[a];
        const double cells = ceil(extent / grid.spacing - 1e-9) + 2 * DISTANCE_GRID_BORDER;
        grid.count[a] = (int32_t)cells + 1;
        grid.low[a] = low[a] - 0.5 * (cells * grid.spacing - extent);
    }
    return grid;
}

/* A job: the surface on its lattice, and the grid to fill. */
typedef struct Baking {
    const Surface *surface;
    const DistanceGrid *grid;
    float *value;
    int32_t *winding; /* per node */
} Baking;

/* Where the node at `index` of an axis lies on the surface's lattice. */
static double lattice_place(const Baking *baking, int axis, int32_t index)
{
    return (baking->grid->low[axis] + index * baking->grid->spacing - baking->surface->low[axis]) / baking->surface->unit;
}

/* ---- Signs: winding numbers ----
 *
 * A line along the first axis through a row of nodes leaves the solid where it crosses an element whose normal looks forward, and
 * enters it where the normal looks back. So a node's winding number is the number of exits ahead less that of entries. Rows are moved to
 * the nearest lattice line; then all decisions are comparisons of whole numbers. */

/* Counts a crossing at x [lattice units] for all nodes of the row that lie before it. */
static void count_crossing(const Baking *baking, size_t row, double x, int sign)
{
    const int32_t nodes = baking->grid->count[0];
    const double place = (x * baking->surface->unit + baking->surface->low[0] - baking->grid->low[0]) / baking->grid->spacing;
    const int32_t before = (int32_t)fmax(0.0, fmin(nodes, ceil(place)));
    if (before > 0) baking->winding[row * (size_t)nodes + (size_t)before - 1] += sign;
}

/* The rows of an axis that may cross what lies between two places. */
static void rows_between(const Baking *baking, int axis, int32_t low, int32_t high, int32_t *first, int32_t *last)
{
    const double step = baking->grid->spacing / baking->surface->unit, start = lattice_place(baking, axis, 0);
    *first = (int32_t)fmax(0.0, floor((low - 1 - start) / step));
    *last = (int32_t)fmin(baking->grid->count[axis] - 1, ceil((high + 1 - start) / step));
}

static int64_t lattice_line(const Baking *baking, int axis, int32_t index) { return llround(lattice_place(baking, axis, index)); }

static void cross_edge(const Baking *baking, const Element *element)
{
    const int32_t *a = baking->surface->vertex[element->corner[0]].at, *b = baking->surface->vertex[element->corner[1]].at;
    int32_t first, last;
    rows_between(baking, 1, a[1] < b[1] ? a[1] : b[1], a[1] < b[1] ? b[1] : a[1], &first, &last);
    for (int32_t j = first; j <= last; j++) {
        const int64_t y = lattice_line(baking, 1, j);
        if ((a[1] > y) == (b[1] > y)) continue;
        const double share = (double)(y - a[1]) / (double)(b[1] - a[1]);
        count_crossing(baking, (size_t)j, a[0] + share * (b[0] - a[0]), b[1] > a[1] ? 1 : -1); /* outward is to the right of an edge */
    }
}

/* Twice the area of the triangle a, b, p seen along the first axis. */
static int64_t area2(const int32_t *a, const int32_t *b, int64_t y, int64_t z)
{
    return (int64_t)(b[1] - a[1]) * (z - a[2]) - (int64_t)(b[2] - a[2]) * (y - a[1]);
}

/* On which side of an edge a line is, seen along the first axis. A line that meets the edge is moved by (e, e^2) with an infinitely
 * small e: neighbours of an edge or a vertex then agree who is crossed (H. Edelsbrunner, E. Muecke, "Simulation of simplicity", ACM TOG
 * 9(1), 1990). 0: the edge lies along the axis. */
static int side_of_edge(const int32_t *a, const int32_t *b, int64_t area)
{
    if (area != 0) return area > 0 ? 1 : -1;
    if (a[2] != b[2]) return a[2] > b[2] ? 1 : -1;
    return (b[1] > a[1]) - (b[1] < a[1]);
}

static void cross_triangle_at(const Baking *baking, const int32_t *corner[3], int32_t j, int32_t k)
{
    const int64_t y = lattice_line(baking, 1, j), z = lattice_line(baking, 2, k);
    int64_t area[3];
    int side[3];
    for (int i = 0; i < 3; i++) {
        area[i] = area2(corner[i], corner[(i + 1) % 3], y, z);
        side[i] = side_of_edge(corner[i], corner[(i + 1) % 3], area[i]);
    }
    if (side[0] == 0 || side[0] != side[1] || side[0] != side[2]) return;
    double x = 0.0, whole = 0.0;
    for (int i = 0; i < 3; i++) {
        x += (double)area[i] * corner[(i + 2) % 3][0];
        whole += (double)area[i];
    }
    count_crossing(baking, (size_t)k * (size_t)baking->grid->count[1] + (size_t)j, x / whole, side[0]);
}

static void cross_triangle(const Baking *baking, const Element *element)
{
    const int32_t *corner[3];
    int32_t low[3] = {0}, high[3] = {0}, first[3], last[3];
    for (int i = 0; i < 3; i++) corner[i] = baking->surface->vertex[element->corner[i]].at;
    for (int a = 1; a < 3; a++) {
        low[a] = high[a] = corner[0][a];
        for (int i = 1; i < 3; i++) {
            low[a] = corner[i][a] < low[a] ? corner[i][a] : low[a];
            high[a] = corner[i][a] > high[a] ? corner[i][a] : high[a];
        }
        rows_between(baking, a, low[a], high[a], &first[a], &last[a]);
    }
    for (int32_t k = first[2]; k <= last[2]; k++)
        for (int32_t j = first[1]; j <= last[1]; j++) cross_triangle_at(baking, corner, j, k);
}

static pbmpm_result find_windings(const Baking *baking)
{
    const Surface *surface = baking->surface;
    const size_t nodes = distance_grid_nodes(baking->grid), row = (size_t)baking->grid->count[0];
    bool solid = false;
    for (uint32_t e = 0; e < surface->elements; e++) {
        if (surface->dimension == 2)
            cross_edge(baking, &surface->element[e]);
        else
            cross_triangle(baking, &surface->element[e]);
    }
    for (size_t begin = 0; begin < nodes; begin += row) {
        int32_t sum = 0;
        for (size_t i = begin + row; i-- > begin;) {
            sum += surface->orientation * baking->winding[i];
            baking->winding[i] = sum;
            solid = solid || sum > 0;
            if (sum < 0) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "a part of the mesh is wound the other way than the rest");
        }
    }
    return solid ? PBMPM_OK : fail(PBMPM_ERROR_INVALID_ARGUMENT,
                                   "the solid is thinner than a grid cell of %g m: raise the resolution", baking->grid->spacing);
}

/* ---- Distances ---- */

/* What a distance may be too long by [cells]. Inside a ball all elements are equally near, and only this ends the search. */
static const double SLACK = 0.01;

static void find_distances(const Baking *baking, const BoxTree *tree)
{
    const DistanceGrid *grid = baking->grid;
    const double slack = SLACK * grid->spacing / baking->surface->unit;
    const size_t nodes = distance_grid_nodes(grid);
    uint32_t near = 0; /* of the last node: hardly ever far from this one's */
    for (size_t node = 0; node < nodes; node++) {
        double point[3] = {0};
        size_t rest = node;
        for (int a = 0; a < grid->dimension; a++) {
            point[a] = lattice_place(baking, a, (int32_t)(rest % (size_t)grid->count[a]));
            rest /= (size_t)grid->count[a];
        }
        const double distance = box_tree_nearest(tree, point, slack, &near) * baking->surface->unit;
        baking->value[node] = (float)(baking->winding[node] > 0 ? -distance : distance);
    }
}

static pbmpm_result fill_grid(const Surface *surface, Memory *memory, DistanceGrid *grid, float *value)
{
    const size_t bytes = distance_grid_nodes(grid) * sizeof(int32_t);
    const Baking baking = {surface, grid, value, memory_take(memory, bytes)};
    BoxTree tree = {.surface = surface};
    pbmpm_result result = baking.winding ? find_windings(&baking) : fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a grid of %zu bytes", bytes);
    if (result == PBMPM_OK) result = box_tree_build(&tree, memory, surface);
    if (result == PBMPM_OK) {
        find_distances(&baking, &tree);
        box_tree_free(&tree, memory);
    }
    memory_give(memory, baking.winding, bytes);
    return result;
}

static pbmpm_result bake_into(const pbmpm_mesh_def *def, bool hull, Memory *memory, DistanceGrid *grid, void *buffer)
{
    Surface surface;
    const size_t bytes = distance_grid_nodes(grid) * sizeof(float);
    pbmpm_result result = hull ? surface_from_hull(&surface, memory, def) : surface_from_mesh(&surface, memory, def);
    float *value = result == PBMPM_OK ? memory_take(memory, bytes) : NULL;
    if (result == PBMPM_OK && !value) result = fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a grid of %zu bytes", bytes);
    if (result == PBMPM_OK) result = fill_grid(&surface, memory, grid, value);
    if (result == PBMPM_OK) {
        grid->value = value;
        distance_grid_write(grid, buffer);
    }
    memory_give(memory, value, bytes);
    surface_free(&surface, memory);
    return result;
}

pbmpm_result bake_mesh(const pbmpm_mesh_def *def, bool hull, void *buffer, uint64_t capacity, uint64_t *bytes)
{
    const char *problem = surface_problem(def, hull);
    if (problem) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "%s", problem);
    double low[3], high[3];
    if (!(surface_bounds(def, low, high) >= 1e-6)) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "the mesh is smaller than 1e-6 m");
    DistanceGrid grid = grid_around(def);
    if (distance_grid_nodes(&grid) > PBMPM_MAX_BAKED_NODES)
        return fail(PBMPM_ERROR_INVALID_ARGUMENT, "the grid would have %zu nodes, more than 2^27: lower mesh.resolution", distance_grid_nodes(&grid));
    *bytes = distance_grid_bytes(&grid);
    if (!buffer) return PBMPM_OK;
    if (capacity < *bytes)
        return fail(PBMPM_ERROR_CAPACITY, "the baked solid has %llu bytes, the buffer %llu", (unsigned long long)*bytes,
                    (unsigned long long)capacity);
    Memory memory;
    memory_init(&memory, NULL, 0);
    return bake_into(def, hull, &memory, &grid, buffer);
}
