/* Bodies of heights as meshes: the heights, the same lattice again at the base, and walls between. */
#include <math.h>
#include <string.h>

#include "base/numbers.h"
#include "base/result.h"
#include "shape/bake.h"

pbmpm_heights_def heights_defaults(void)
{
    return (pbmpm_heights_def){.size = sizeof(pbmpm_heights_def), .dimension = 3, .up = 1, .spacing = {1.0f, 1.0f}, .thickness = 1.0f};
}

static uint64_t samples_of(const pbmpm_heights_def *def) { return (uint64_t)def->count[0] * (def->dimension == 3 ? def->count[1] : 1); }

static const char *heights_problem(const pbmpm_heights_def *def)
{
    if (def->dimension != 2 && def->dimension != 3) return "heights.dimension must be 2 or 3";
    if (def->up < 0 || def->up >= def->dimension) return "heights.up must be an axis";
    if (def->resolution != 0 && (def->resolution < 4 || def->resolution > 1024)) return "heights.resolution must be 0 or in [4, 1024]";
    for (int i = 0; i < def->dimension - 1; i++) {
        if (def->count[i] < 2 || def->count[i] > PBMPM_MAX_HEIGHTS) return "heights.count must be in [2, 2^20]";
        if (!in_range(def->spacing[i], 1e-6, 1e6)) return "heights.spacing must be in [1e-6, 1e6]";
        if (!in_range((double)def->spacing[i] * (def->count[i] - 1), 0.0, 1e6)) return "heights: the lattice must be within 1e6 m";
    }
    if (samples_of(def) > PBMPM_MAX_HEIGHTS) return "heights.count: at most 2^20 samples in all";
    if (!in_range(def->thickness, 1e-6, 1e6)) return "heights.thickness must be in [1e-6, 1e6]";
    if (!def->heights) return "heights.heights is null";
    return all_in_range(def->heights, samples_of(def), -1e6, 1e6) ? NULL : "heights.heights must be in [-1e6, 1e6]";
}

/* The axis of lattice direction 0 or 1. */
static int lattice_axis(const pbmpm_heights_def *def, int direction)
{
    const int first = def->up == 0 ? 1 : 0;
    return direction == 0 ? first : 3 - def->up - first;
}

/* The surface's samples, then as many at the base. */
static void make_vertices(const pbmpm_heights_def *def, float *vertex)
{
    const uint32_t samples = (uint32_t)samples_of(def);
    const int d = def->dimension;
    float lowest = def->heights[0];
    for (uint32_t s = 1; s < samples; s++) lowest = fminf(lowest, def->heights[s]);
    for (uint32_t s = 0; s < 2 * samples; s++) {
        const uint32_t place[2] = {s % samples % def->count[0], s % samples / def->count[0]};
        float *v = vertex + (size_t)s * (size_t)d;
        for (int i = 0; i < d - 1; i++) v[lattice_axis(def, i)] = (float)place[i] * def->spacing[i];
        v[def->up] = s < samples ? def->heights[s] : lowest - def->thickness;
    }
}

static void put(pbmpm_mesh_def *mesh, uint32_t *element, uint32_t a, uint32_t b, uint32_t c)
{
    const uint32_t corner[3] = {a, b, c};
    memcpy(element + (size_t)mesh->element_count++ * (size_t)mesh->dimension, corner, (size_t)mesh->dimension * sizeof *corner);
}

/* A square with corners in turn. */
static void put_square(pbmpm_mesh_def *mesh, uint32_t *element, uint32_t a, uint32_t b, uint32_t c, uint32_t d)
{
    put(mesh, element, a, b, c);
    put(mesh, element, a, c, d);
}

static void make_outline(const pbmpm_heights_def *def, pbmpm_mesh_def *mesh, uint32_t *element)
{
    const uint32_t n = def->count[0];
    for (uint32_t i = 0; i + 1 < n; i++) {
        put(mesh, element, i, i + 1, 0);
        put(mesh, element, n + i + 1, n + i, 0);
    }
    put(mesh, element, n - 1, 2 * n - 1, 0);
    put(mesh, element, n, 0, 0);
}

static void make_walls(const pbmpm_heights_def *def, pbmpm_mesh_def *mesh, uint32_t *element)
{
    const uint32_t n = def->count[0], m = def->count[1], base = n * m, last = n * (m - 1);
    for (uint32_t i = 0; i + 1 < n; i++) {
        put_square(mesh, element, i + 1, i, base + i, base + i + 1);
        put_square(mesh, element, last + i, last + i + 1, base + last + i + 1, base + last + i);
    }
    for (uint32_t j = 0; j + 1 < m; j++) {
        const uint32_t here = j * n, next = here + n, far = n - 1;
        put_square(mesh, element, here, next, base + next, base + here);
        put_square(mesh, element, next + far, here + far, base + here + far, base + next + far);
    }
}

static void make_skins(const pbmpm_heights_def *def, pbmpm_mesh_def *mesh, uint32_t *element)
{
    const uint32_t n = def->count[0], m = def->count[1], base = n * m;
    for (uint32_t j = 0; j + 1 < m; j++)
        for (uint32_t i = 0; i + 1 < n; i++) {
            const uint32_t s = j * n + i;
            put_square(mesh, element, s, s + 1, s + n + 1, s + n);
            put_square(mesh, element, base + s, base + s + n, base + s + n + 1, base + s + 1);
        }
}

static int32_t resolution_of(const pbmpm_heights_def *def, const pbmpm_mesh_def *mesh)
{
    if (def->resolution != 0) return def->resolution;
    double low[3], high[3];
    const double width = def->dimension == 3 ? fmin(def->spacing[0], def->spacing[1]) : def->spacing[0];
    return (int32_t)fmax(4.0, fmin(1024.0, ceil(surface_bounds(mesh, low, high) / width - 1e-6)));
}

pbmpm_result bake_heights(const pbmpm_heights_def *def, void *buffer, uint64_t capacity, uint64_t *bytes)
{
    const char *problem = heights_problem(def);
    if (problem) return fail(PBMPM_ERROR_INVALID_ARGUMENT, "%s", problem);
    const size_t samples = samples_of(def), d = (size_t)def->dimension;
    const size_t rim = def->count[0] + (size_t)(d == 3 ? def->count[1] : 0);
    const size_t vertex_bytes = 2 * samples * d * sizeof(float), element_bytes = 4 * (samples + rim) * d * sizeof(uint32_t);
    Memory memory;
    memory_init(&memory, NULL, 0);
    float *vertex = memory_take(&memory, vertex_bytes);
    uint32_t *element = memory_take(&memory, element_bytes);
    pbmpm_mesh_def mesh = mesh_defaults();
    mesh.dimension = def->dimension;
    mesh.vertices = vertex;
    mesh.elements = element;
    mesh.vertex_count = (uint32_t)(2 * samples);
    pbmpm_result result = vertex && element ? PBMPM_OK : fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for %zu heights", samples);
    if (result == PBMPM_OK) {
        make_vertices(def, vertex);
        if (d == 2)
            make_outline(def, &mesh, element);
        else {
            make_skins(def, &mesh, element);
            make_walls(def, &mesh, element);
        }
        mesh.resolution = resolution_of(def, &mesh);
        result = bake_mesh(&mesh, false, buffer, capacity, bytes);
    }
    memory_give(&memory, vertex, vertex_bytes);
    memory_give(&memory, element, element_bytes);
    return result;
}
