/* Convex hulls by adding one point after the other, in whole numbers: no rounding, so no point is ever on a wrong side. */
#include <string.h>

#include "base/result.h"
#include "shape/surface.h"

/* The third component of (b - a) x (c - a): positive if a, b, c turn left. */
static int64_t turn(const LatticePoint *a, const LatticePoint *b, const LatticePoint *c)
{
    return (int64_t)(b->at[0] - a->at[0]) * (c->at[1] - a->at[1]) - (int64_t)(b->at[1] - a->at[1]) * (c->at[0] - a->at[0]);
}

static void cross(const LatticePoint *a, const LatticePoint *b, const LatticePoint *c, int64_t out[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        out[i] = (int64_t)(b->at[j] - a->at[j]) * (c->at[k] - a->at[k]) - (int64_t)(b->at[k] - a->at[k]) * (c->at[j] - a->at[j]);
    }
}

/* Six times the volume of a tetrahedron: positive if p is on the outer side of a, b, c that are wound outward. */
static int64_t height_over(const Surface *surface, const Element *face, const LatticePoint *p)
{
    const LatticePoint *a = &surface->vertex[face->corner[0]];
    int64_t normal[3], sum = 0;
    cross(a, &surface->vertex[face->corner[1]], &surface->vertex[face->corner[2]], normal);
    for (int i = 0; i < 3; i++) sum += normal[i] * (p->at[i] - a->at[i]);
    return sum;
}

/* ---- 2D: the lower chain from left to right, then the upper one back (A. Andrew, 1979) ---- */

static uint32_t extend_chain(const Surface *surface, uint32_t *chain, uint32_t count, uint32_t least, uint32_t v)
{
    const LatticePoint *vertex = surface->vertex;
    while (count >= least + 2 && turn(&vertex[chain[count - 2]], &vertex[chain[count - 1]], &vertex[v]) <= 0) count--;
    chain[count] = v;
    return count + 1;
}

static pbmpm_result wrap_plane(Surface *surface, Memory *memory)
{
    const size_t room = 2 * (size_t)surface->vertices + 2;
    uint32_t *chain = memory_take(memory, room * sizeof *chain), count = 0;
    if (!chain) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a hull of %u points", surface->vertices);
    for (uint32_t v = 0; v < surface->vertices; v++) count = extend_chain(surface, chain, count, 0, v);
    const uint32_t lower = count - 1;
    for (uint32_t v = surface->vertices - 1; v-- > 0;) count = extend_chain(surface, chain, count, lower, v);
    const uint32_t corners = count - 1; /* the first is there twice */
    pbmpm_result result = corners > 2 ? surface_reserve(surface, memory, corners)
                                      : fail(PBMPM_ERROR_INVALID_ARGUMENT, "all points of the hull lie on a line");
    for (uint32_t i = 0; i < corners && result == PBMPM_OK; i++)
        surface->element[surface->elements++] = (Element){{chain[i], chain[i + 1]}};
    memory_give(memory, chain, room * sizeof *chain);
    return result;
}

/* ---- 3D ----
 *
 * Vertices come in order of their first coordinate, so each lies outside the hull of those before it and sees a face at the last of them: what
 * it sees is found by going from face to face. Only the few that were passed over for the first tetrahedron are looked for everywhere. */

static const uint32_t NONE = UINT32_MAX;

/* A face and those beyond its sides: across[i] lies behind the side from corner i to corner i + 1. */
typedef struct Face {
    Element element;
    uint32_t across[3];
    bool live, seen;
} Face;

typedef struct Hull {
    const Surface *surface;
    Face *face;
    uint32_t faces;       /* live and dead */
    uint32_t *dead;       /* places to use again */
    uint32_t dead_count;
    uint32_t *seen;       /* faces that the new vertex sees */
    uint32_t *fresh;      /* faces that it made */
    uint32_t fresh_count;
    uint32_t *from;       /* per vertex: the fresh face whose first corner it is */
} Hull;

static bool sees(const Hull *hull, uint32_t face, uint32_t v)
{
    return height_over(hull->surface, &hull->face[face].element, &hull->surface->vertex[v]) > 0;
}

static uint32_t seen_face(const Hull *hull, uint32_t v)
{
    for (uint32_t i = 0; i < hull->fresh_count; i++)
        if (sees(hull, hull->fresh[i], v)) return hull->fresh[i];
    for (uint32_t f = 0; f < hull->faces; f++)
        if (hull->face[f].live && sees(hull, f, v)) return f;
    return NONE;
}

static uint32_t find_seen(Hull *hull, uint32_t v, uint32_t first)
{
    uint32_t count = 0;
    hull->face[first].seen = true;
    hull->seen[count++] = first;
    for (uint32_t i = 0; i < count; i++)
        for (int side = 0; side < 3; side++) {
            const uint32_t next = hull->face[hull->seen[i]].across[side];
            if (hull->face[next].seen || !sees(hull, next, v)) continue;
            hull->face[next].seen = true;
            hull->seen[count++] = next;
        }
    return count;
}

static void link_back(Hull *hull, uint32_t face, uint32_t old, uint32_t fresh)
{
    for (int side = 0; side < 3; side++)
        if (hull->face[face].across[side] == old) hull->face[face].across[side] = fresh;
}

/* A face from one side of a seen face to the new vertex. Two faces share one side at most, so link_back() finds the right one. */
static void put_face(Hull *hull, uint32_t old, int side, uint32_t v)
{
    const uint32_t place = hull->dead_count ? hull->dead[--hull->dead_count] : hull->faces++;
    const Element corners = hull->face[old].element;
    const uint32_t from = corners.corner[side], to = corners.corner[(side + 1) % 3], beyond = hull->face[old].across[side];
    hull->face[place] = (Face){.element = {{from, to, v}}, .across = {beyond, NONE, NONE}, .live = true};
    link_back(hull, beyond, old, place);
    hull->from[from] = place;
    hull->fresh[hull->fresh_count++] = place;
}

static void add_vertex(Hull *hull, uint32_t v)
{
    const uint32_t first = seen_face(hull, v);
    if (first == NONE) return;
    const uint32_t count = find_seen(hull, v, first);
    hull->fresh_count = 0;
    for (uint32_t i = 0; i < count; i++)
        for (int side = 0; side < 3; side++)
            if (!hull->face[hull->face[hull->seen[i]].across[side]].seen) put_face(hull, hull->seen[i], side, v);
    for (uint32_t i = 0; i < hull->fresh_count; i++) {
        Face *face = &hull->face[hull->fresh[i]];
        const uint32_t next = hull->from[face->element.corner[1]];
        face->across[1] = next;
        hull->face[next].across[2] = hull->fresh[i];
    }
    for (uint32_t i = 0; i < count; i++) {
        hull->face[hull->seen[i]].live = hull->face[hull->seen[i]].seen = false;
        hull->dead[hull->dead_count++] = hull->seen[i];
    }
}

/* Of the first four vertices that span a volume, wound outward; false if all lie in a plane. */
static bool first_tetrahedron(Hull *hull)
{
    const Surface *surface = hull->surface;
    int64_t normal[3] = {0}, height = 0;
    uint32_t v = 2;
    for (; v < surface->vertices && !(normal[0] || normal[1] || normal[2]); v++)
        cross(&surface->vertex[0], &surface->vertex[1], &surface->vertex[v], normal);
    const uint32_t c = v - 1;
    const Element base = {{0, 1, c}};
    for (; v < surface->vertices && height == 0; v++) height = height_over(surface, &base, &surface->vertex[v]);
    if (height == 0) return false;
    const uint32_t low = height > 0 ? c : 1, high = height > 0 ? 1 : c; /* the fourth lies below 0, low, high */
    hull->face[0] = (Face){.element = {{0, low, high}}, .across = {1, 2, 3}, .live = true};
    hull->face[1] = (Face){.element = {{low, 0, v - 1}}, .across = {0, 3, 2}, .live = true};
    hull->face[2] = (Face){.element = {{high, low, v - 1}}, .across = {0, 1, 3}, .live = true};
    hull->face[3] = (Face){.element = {{0, high, v - 1}}, .across = {0, 2, 1}, .live = true};
    hull->faces = 4;
    return true;
}

static pbmpm_result wrap(Hull *hull, Surface *surface, Memory *memory)
{
    if (surface->vertices < 4 || !first_tetrahedron(hull))
        return fail(PBMPM_ERROR_INVALID_ARGUMENT, "all points of the hull lie in a plane");
    for (uint32_t v = 0; v < surface->vertices; v++) add_vertex(hull, v); /* its own corners see no face: they lie on them */
    const pbmpm_result result = surface_reserve(surface, memory, hull->faces);
    for (uint32_t f = 0; f < hull->faces && result == PBMPM_OK; f++)
        if (hull->face[f].live) surface->element[surface->elements++] = hull->face[f].element;
    return result;
}

static pbmpm_result wrap_space(Surface *surface, Memory *memory)
{
    const size_t faces = 4 * (size_t)surface->vertices + 8; /* Euler: 2V - 4 are live, and while a hole is closed as many may be dying */
    Hull hull = {.surface = surface,
                 .face = memory_take(memory, faces * sizeof(Face)),
                 .dead = memory_take(memory, faces * sizeof(uint32_t)),
                 .seen = memory_take(memory, faces * sizeof(uint32_t)),
                 .fresh = memory_take(memory, faces * sizeof(uint32_t)),
                 .from = memory_take(memory, surface->vertices * sizeof(uint32_t))};
    const bool ok = hull.face && hull.dead && hull.seen && hull.fresh && hull.from;
    const pbmpm_result result = ok ? wrap(&hull, surface, memory)
                                   : fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a hull of %u points", surface->vertices);
    memory_give(memory, hull.face, faces * sizeof(Face));
    memory_give(memory, hull.dead, faces * sizeof(uint32_t));
    memory_give(memory, hull.seen, faces * sizeof(uint32_t));
    memory_give(memory, hull.fresh, faces * sizeof(uint32_t));
    memory_give(memory, hull.from, surface->vertices * sizeof(uint32_t));
    return result;
}

pbmpm_result surface_from_hull(Surface *surface, Memory *memory, const pbmpm_mesh_def *def)
{
    const pbmpm_result result = surface_place(surface, memory, def, HULL_LATTICE, NULL);
    surface->orientation = 1;
    if (result != PBMPM_OK) return result;
    return def->dimension == 2 ? wrap_plane(surface, memory) : wrap_space(surface, memory);
}
