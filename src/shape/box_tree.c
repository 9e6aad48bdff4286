#include "shape/box_tree.h"

#include <math.h>

#include "base/result.h"
#include "base/vector.h"

enum { LEAF = 4, DEPTH_MAX = 128 };

/* ---- The tree ---- */

static void element_middle(const Surface *surface, uint32_t e, double middle[3])
{
    const Element *element = &surface->element[e];
    for (int a = 0; a < 3; a++) {
        middle[a] = 0.0;
        for (int i = 0; i < surface->dimension; i++) middle[a] += surface->vertex[element->corner[i]].at[a];
    }
}

static void enclose(const BoxTree *tree, Box *box, double low[3], double high[3])
{
    for (int a = 0; a < 3; a++) {
        box->low[a] = HUGE_VALF;
        box->high[a] = -HUGE_VALF;
        low[a] = HUGE_VAL;
        high[a] = -HUGE_VAL;
    }
    for (uint32_t i = box->first; i < box->first + box->count; i++) {
        double middle[3];
        element_middle(tree->surface, tree->order[i], middle);
        for (int a = 0; a < 3; a++) {
            for (int c = 0; c < tree->surface->dimension; c++) {
                const float x = (float)tree->surface->vertex[tree->surface->element[tree->order[i]].corner[c]].at[a];
                box->low[a] = fminf(box->low[a], x);
                box->high[a] = fmaxf(box->high[a], x);
            }
            low[a] = fmin(low[a], middle[a]);
            high[a] = fmax(high[a], middle[a]);
        }
    }
}

/* Puts the elements whose middle lies in the lower half first; returns their number. */
static uint32_t part(BoxTree *tree, const Box *box, int axis, double half)
{
    uint32_t *order = tree->order + box->first, lower = 0;
    for (uint32_t i = 0; i < box->count; i++) {
        double middle[3];
        element_middle(tree->surface, order[i], middle);
        if (middle[axis] > half) continue;
        const uint32_t swap = order[i];
        order[i] = order[lower];
        order[lower++] = swap;
    }
    return lower == 0 || lower == box->count ? box->count / 2 : lower; /* all middles in one place */
}

/* Halving the range of the middles, whole numbers below 2^24, at the longest axis ends after 3 * 24 levels; what is left is halved by number. */
static void divide(BoxTree *tree, uint32_t index)
{
    double low[3], high[3];
    Box *box = &tree->box[index];
    enclose(tree, box, low, high);
    if (box->count <= LEAF) return;
    int axis = 0;
    for (int a = 1; a < 3; a++)
        if (high[a] - low[a] > high[axis] - low[axis]) axis = a;
    const uint32_t lower = part(tree, box, axis, 0.5 * (low[axis] + high[axis]));
    const uint32_t child = tree->boxes;
    tree->boxes += 2;
    box->child = child;
    tree->box[child] = (Box){.first = box->first, .count = lower};
    tree->box[child + 1] = (Box){.first = box->first + lower, .count = box->count - lower};
    divide(tree, child);
    divide(tree, child + 1);
}

/* ---- Discs ---- */

static void between(const LatticePoint *a, const LatticePoint *b, double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = b->at[i] - a->at[i];
}

/* Without a normal (no area) it stands for a ball. */
static Disc disc_around(const Surface *surface, uint32_t e)
{
    Disc disc = {.radius = 0.0};
    double edge[2][3] = {{0}};
    const LatticePoint *corner[3];
    const int d = surface->dimension;
    for (int i = 0; i < d; i++) corner[i] = &surface->vertex[surface->element[e].corner[i]];
    element_middle(surface, e, disc.centre);
    for (int a = 0; a < 3; a++) disc.centre[a] /= d;
    for (int i = 0; i < d; i++) {
        double way[3];
        for (int a = 0; a < 3; a++) way[a] = corner[i]->at[a] - disc.centre[a];
        disc.radius = fmax(disc.radius, sqrt(dot3(way, way)));
    }
    for (int i = 0; i + 1 < d; i++) between(corner[i], corner[i + 1], edge[i]);
    if (d == 2) edge[1][2] = 1.0;
    cross3(edge[0], edge[1], disc.normal);
    const double length = sqrt(dot3(disc.normal, disc.normal));
    for (int a = 0; a < 3 && length > 0.0; a++) disc.normal[a] /= length;
    return disc;
}

static size_t box_room(const Surface *surface) { return 2 * (size_t)surface->elements; }

pbmpm_result box_tree_build(BoxTree *tree, Memory *memory, const Surface *surface)
{
    *tree = (BoxTree){.surface = surface,
                      .box = memory_take(memory, box_room(surface) * sizeof(Box)),
                      .order = memory_take(memory, surface->elements * sizeof(uint32_t)),
                      .disc = memory_take(memory, surface->elements * sizeof(Disc)),
                      .boxes = 1};
    if (!tree->box || !tree->order || !tree->disc) {
        box_tree_free(tree, memory);
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a tree of %u elements", surface->elements);
    }
    for (uint32_t e = 0; e < surface->elements; e++) tree->order[e] = e;
    tree->box[0] = (Box){.count = surface->elements};
    divide(tree, 0);
    for (uint32_t i = 0; i < surface->elements; i++) tree->disc[i] = disc_around(surface, tree->order[i]);
    return PBMPM_OK;
}

void box_tree_free(BoxTree *tree, Memory *memory)
{
    memory_give(memory, tree->box, box_room(tree->surface) * sizeof(Box));
    memory_give(memory, tree->order, tree->surface->elements * sizeof(uint32_t));
    memory_give(memory, tree->disc, tree->surface->elements * sizeof(Disc));
    *tree = (BoxTree){0};
}

/* ---- Distances ---- */

static double edge_distance2(const LatticePoint *a, const LatticePoint *b, const double point[3])
{
    double edge[3], way[3];
    between(a, b, edge);
    for (int i = 0; i < 3; i++) way[i] = point[i] - a->at[i];
    const double share = fmax(0.0, fmin(1.0, dot3(way, edge) / dot3(edge, edge))); /* vertices are merged: no edge has length 0 */
    for (int i = 0; i < 3; i++) way[i] -= share * edge[i];
    return dot3(way, way);
}

/* That to the plane if the foot lies inside, else that to the nearest edge. */
static double triangle_distance2(const LatticePoint *corner[3], const double point[3])
{
    double edge[3][3], way[3], normal[3], side[3];
    for (int i = 0; i < 3; i++) between(corner[i], corner[(i + 1) % 3], edge[i]);
    cross3(edge[0], edge[1], normal);
    const double normal2 = dot3(normal, normal);
    bool inside = normal2 > 0.0;
    for (int i = 0; i < 3 && inside; i++) {
        for (int a = 0; a < 3; a++) way[a] = point[a] - corner[i]->at[a];
        cross3(edge[i], way, side);
        inside = dot3(side, normal) >= 0.0;
    }
    if (inside) return dot3(way, normal) * dot3(way, normal) / normal2;
    double nearest2 = INFINITY;
    for (int i = 0; i < 3; i++) nearest2 = fmin(nearest2, edge_distance2(corner[i], corner[(i + 1) % 3], point));
    return nearest2;
}

static double element_distance2(const Surface *surface, uint32_t e, const double point[3])
{
    const LatticePoint *corner[3];
    for (int i = 0; i < surface->dimension; i++) corner[i] = &surface->vertex[surface->element[e].corner[i]];
    return surface->dimension == 2 ? edge_distance2(corner[0], corner[1], point) : triangle_distance2(corner, point);
}

static double box_distance2(const Box *box, const double point[3])
{
    double sum = 0.0;
    for (int a = 0; a < 3; a++) {
        const double out = fmax(fmax((double)box->low[a] - point[a], point[a] - (double)box->high[a]), 0.0);
        sum += out * out;
    }
    return sum;
}

/* How near an element can be, judged by its disc: its height over it, and the way to its rim. */
static double disc_least2(const Disc *disc, const double point[3])
{
    double way[3];
    for (int a = 0; a < 3; a++) way[a] = point[a] - disc->centre[a];
    const double height = dot3(way, disc->normal), lateral2 = dot3(way, way) - height * height;
    const double radius2 = disc->radius * disc->radius;
    const double beside = lateral2 > radius2 ? sqrt(lateral2) - disc->radius : 0.0;
    return height * height + beside * beside;
}

/* What a box may be away and still hold something nearer by more than the slack. */
static double reach2(double distance2, double slack)
{
    const double reach = sqrt(distance2);
    return reach > slack ? (reach - slack) * (reach - slack) : 0.0;
}

double box_tree_nearest(const BoxTree *tree, const double point[3], double slack, uint32_t *near)
{
    uint32_t stack[DEPTH_MAX];
    int waiting = 0;
    double distance2 = element_distance2(tree->surface, *near, point), reach = reach2(distance2, slack);
    stack[waiting++] = 0;
    while (waiting) {
        const Box *box = &tree->box[stack[--waiting]];
        if (box_distance2(box, point) >= reach) continue;
        if (box->child != 0) {
            const bool second = box_distance2(&tree->box[box->child + 1], point) < box_distance2(&tree->box[box->child], point);
            stack[waiting++] = second ? box->child : box->child + 1; /* the nearer one comes off the stack first */
            stack[waiting++] = second ? box->child + 1 : box->child;
            continue;
        }
        for (uint32_t i = box->first; i < box->first + box->count; i++) {
            if (disc_least2(&tree->disc[i], point) >= reach) continue;
            const double other2 = element_distance2(tree->surface, tree->order[i], point);
            if (other2 >= distance2) continue;
            distance2 = other2;
            *near = tree->order[i];
            reach = reach2(distance2, slack);
        }
    }
    return sqrt(distance2);
}
