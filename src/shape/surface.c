#include "shape/surface.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/numbers.h"
#include "base/result.h"

const char *surface_problem(const pbmpm_mesh_def *def, bool hull)
{
    if (def->dimension != 2 && def->dimension != 3) return "mesh.dimension must be 2 or 3";
    if (def->resolution < 4 || def->resolution > 1024) return "mesh.resolution must be in [4, 1024]";
    if (!def->vertices) return "mesh.vertices is null";
    const uint32_t most = hull ? PBMPM_MAX_HULL_VERTICES : PBMPM_MAX_MESH_VERTICES;
    if (def->vertex_count < 1 || def->vertex_count > most)
        return hull ? "mesh.vertex_count must be in [1, 2^18] for a hull" : "mesh.vertex_count must be in [1, 2^22]";
    if (!all_in_range(def->vertices, (size_t)def->vertex_count * (size_t)def->dimension, -1e6, 1e6))
        return "mesh.vertices must be in [-1e6, 1e6]";
    if (hull) return def->elements || def->element_count ? "mesh.elements must be null for a hull" : NULL;
    if (!def->elements) return "mesh.elements is null";
    if (def->element_count < 1 || def->element_count > PBMPM_MAX_MESH_ELEMENTS) return "mesh.element_count must be in [1, 2^22]";
    const size_t corners = (size_t)def->element_count * (size_t)def->dimension;
    for (size_t i = 0; i < corners; i++)
        if (def->elements[i] >= def->vertex_count) return "mesh.elements names a vertex that does not exist";
    return NULL;
}

double surface_bounds(const pbmpm_mesh_def *def, double low[3], double high[3])
{
    double longest = 0.0;
    for (int a = 0; a < 3; a++) {
        low[a] = a < def->dimension ? INFINITY : 0.0;
        high[a] = a < def->dimension ? -INFINITY : 0.0;
        for (uint32_t v = 0; a < def->dimension && v < def->vertex_count; v++) {
            const double x = (double)def->vertices[(size_t)v * (size_t)def->dimension + (size_t)a];
            low[a] = fmin(low[a], x);
            high[a] = fmax(high[a], x);
        }
        longest = fmax(longest, high[a] - low[a]);
    }
    return longest;
}

/* ---- Vertices ---- */

typedef struct Placed {
    LatticePoint point;
    uint32_t index;
} Placed;

static int compare_placed(const void *a, const void *b)
{
    const Placed *p = a, *q = b;
    for (int i = 0; i < 3; i++)
        if (p->point.at[i] != q->point.at[i]) return p->point.at[i] < q->point.at[i] ? -1 : 1;
    return p->index < q->index ? -1 : p->index > q->index;
}

static void sort_and_merge(Surface *surface, Placed *placed, uint32_t count, uint32_t *merged)
{
    qsort(placed, count, sizeof *placed, compare_placed);
    for (uint32_t i = 0; i < count; i++) {
        const LatticePoint *last = &surface->vertex[surface->vertices - 1];
        if (i == 0 || memcmp(last, &placed[i].point, sizeof *last) != 0) surface->vertex[surface->vertices++] = placed[i].point;
        if (merged) merged[placed[i].index] = surface->vertices - 1;
    }
}

pbmpm_result surface_place(Surface *surface, Memory *memory, const pbmpm_mesh_def *def, int32_t lattice, uint32_t *merged)
{
    double high[3];
    const int d = def->dimension;
    *surface = (Surface){.dimension = d};
    const double longest = surface_bounds(def, surface->low, high);
    if (!(longest >= 1e-6)) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "the mesh is smaller than 1e-6 m");
    surface->unit = longest / lattice;
    Placed *placed = memory_take(memory, def->vertex_count * sizeof *placed);
    surface->vertex = memory_take(memory, def->vertex_count * sizeof *surface->vertex);
    surface->vertex_room = def->vertex_count;
    if (placed && surface->vertex) {
        for (uint32_t v = 0; v < def->vertex_count; v++) {
            placed[v].index = v;
            for (int a = 0; a < d; a++) {
                const double x = (double)def->vertices[(size_t)v * (size_t)d + (size_t)a];
                placed[v].point.at[a] = (int32_t)lround((x - surface->low[a]) / surface->unit);
            }
        }
        sort_and_merge(surface, placed, def->vertex_count, merged);
    }
    const bool ok = placed && surface->vertex;
    memory_give(memory, placed, def->vertex_count * sizeof *placed);
    return ok ? PBMPM_OK : fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for %u vertices", def->vertex_count);
}

pbmpm_result surface_reserve(Surface *surface, Memory *memory, size_t elements)
{
    surface->element = memory_take(memory, elements * sizeof *surface->element);
    surface->element_room = surface->element ? elements : 0;
    return surface->element ? PBMPM_OK : fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for %zu elements", elements);
}

void surface_free(Surface *surface, Memory *memory)
{
    memory_give(memory, surface->vertex, surface->vertex_room * sizeof *surface->vertex);
    memory_give(memory, surface->element, surface->element_room * sizeof *surface->element);
    *surface = (Surface){0};
}

/* ---- Elements ---- */

static void take_elements(Surface *surface, const pbmpm_mesh_def *def, const uint32_t *merged)
{
    const int d = def->dimension;
    for (uint32_t e = 0; e < def->element_count; e++) {
        Element element = {{0}};
        bool sound = true;
        for (int i = 0; i < d; i++) element.corner[i] = merged[def->elements[(size_t)e * (size_t)d + (size_t)i]];
        for (int i = 0; i < d; i++) sound = sound && element.corner[i] != element.corner[(i + 1) % d];
        if (sound) surface->element[surface->elements++] = element;
    }
}

/* A side that elements share: an edge between two vertices of triangles, a vertex (twice the same) of edges. */
typedef struct Side {
    uint32_t low, high;
    int32_t way; /* 1: from low to high (2D: an edge begins here), -1: the other way */
} Side;

static int compare_sides(const void *a, const void *b)
{
    const Side *p = a, *q = b;
    if (p->low != q->low) return p->low < q->low ? -1 : 1;
    return p->high < q->high ? -1 : p->high > q->high;
}

static Side side_of(const Surface *surface, const Element *element, int i)
{
    if (surface->dimension == 2) return (Side){element->corner[i], element->corner[i], i == 0 ? 1 : -1};
    const uint32_t from = element->corner[i], to = element->corner[(i + 1) % 3];
    return from < to ? (Side){from, to, 1} : (Side){to, from, -1};
}

static pbmpm_result refuse_side(const Surface *surface, const Side *side, bool open)
{
    double p[3], q[3];
    for (int a = 0; a < 3; a++) {
        p[a] = surface->low[a] + surface->unit * surface->vertex[side->low].at[a];
        q[a] = surface->low[a] + surface->unit * surface->vertex[side->high].at[a];
    }
    const char *what = open ? "open" : "wound in two ways";
    if (surface->dimension == 2) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "the polygon is %s at (%g, %g)", what, p[0], p[1]);
    return fail(PBMPM_ERROR_INVALID_ARGUMENT, "the mesh is %s at the edge from (%g, %g, %g) to (%g, %g, %g)", what, p[0], p[1], p[2], q[0],
                q[1], q[2]);
}

/* Closed: every side is gone along as often one way as the other. */
static pbmpm_result check_sides(const Surface *surface, Side *side, size_t count)
{
    qsort(side, count, sizeof *side, compare_sides);
    for (size_t first = 0, next; first < count; first = next) {
        int32_t sum = 0;
        for (next = first; next < count && compare_sides(&side[next], &side[first]) == 0; next++) sum += side[next].way;
        if (sum != 0) return refuse_side(surface, &side[first], (next - first) % 2 != 0);
    }
    return PBMPM_OK;
}

static pbmpm_result check_closed(const Surface *surface, Memory *memory)
{
    const int d = surface->dimension;
    const size_t count = (size_t)surface->elements * (size_t)d;
    Side *side = memory_take(memory, count * sizeof *side);
    if (!side) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory to check %u elements", surface->elements);
    for (uint32_t e = 0; e < surface->elements; e++)
        for (int i = 0; i < d; i++) side[(size_t)e * (size_t)d + (size_t)i] = side_of(surface, &surface->element[e], i);
    const pbmpm_result result = check_sides(surface, side, count);
    memory_give(memory, side, count * sizeof *side);
    return result;
}

/* The volume (2D: area) that is enclosed, times d!, in lattice units: the sum of determinants of the elements' corners. */
static double enclosed(const Surface *surface)
{
    double sum = 0.0;
    for (uint32_t e = 0; e < surface->elements; e++) {
        const int32_t *p[3];
        for (int i = 0; i < 3; i++) p[i] = surface->vertex[surface->element[e].corner[i]].at;
        if (surface->dimension == 2) {
            sum += (double)p[0][0] * p[1][1] - (double)p[0][1] * p[1][0];
            continue;
        }
        for (int a = 0; a < 3; a++) {
            const int b = (a + 1) % 3, c = (a + 2) % 3;
            sum += p[0][a] * ((double)p[1][b] * p[2][c] - (double)p[1][c] * p[2][b]);
        }
    }
    return sum;
}

pbmpm_result surface_from_mesh(Surface *surface, Memory *memory, const pbmpm_mesh_def *def)
{
    *surface = (Surface){0};
    uint32_t *merged = memory_take(memory, def->vertex_count * sizeof *merged);
    if (!merged) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for %u vertices", def->vertex_count);
    pbmpm_result result = surface_place(surface, memory, def, MESH_LATTICE, merged);
    if (result == PBMPM_OK) result = surface_reserve(surface, memory, def->element_count);
    if (result == PBMPM_OK) take_elements(surface, def, merged);
    memory_give(memory, merged, def->vertex_count * sizeof *merged);
    if (result == PBMPM_OK && surface->elements == 0) result = fail(PBMPM_ERROR_INVALID_ARGUMENT, "all elements of the mesh are degenerate");
    if (result == PBMPM_OK) result = check_closed(surface, memory);
    if (result != PBMPM_OK) return result;
    static const double NOTHING = 1e-9; /* of the lattice's cube; what rounding leaves of 0 */
    const double volume = enclosed(surface) / pow(MESH_LATTICE, surface->dimension);
    surface->orientation = volume < 0.0 ? -1 : 1;
    return fabs(volume) > NOTHING ? PBMPM_OK : fail(PBMPM_ERROR_INVALID_ARGUMENT, "the mesh holds no volume");
}
