#include "services/debug_lines.h"

#include <math.h>
#include <string.h>

#include "world/island_groups.h"

#define TURN 6.283185307179586

enum { CIRCLE_LINES = 24, PLANE_CELLS = 20, CONTOUR_NODES = 4 };

/* Where lines go, and of what they are. */
typedef struct Drawing {
    pbmpm_line *lines;
    uint32_t capacity;
    uint64_t count;
    int dimension;
    pbmpm_debug_part part;
} Drawing;

static void draw(Drawing *drawing, const double from[3], const double to[3])
{
    if (drawing->count++ >= drawing->capacity) return;
    pbmpm_line line = {.part = drawing->part};
    for (int a = 0; a < drawing->dimension; a++) {
        line.from[a] = (float)from[a];
        line.to[a] = (float)to[a];
    }
    drawing->lines[drawing->count - 1] = line;
}

/* ---- Shapes, in axes of their own ---- */

static void place(const Solid *solid, const double local[3], double point[3])
{
    for (int r = 0; r < 3; r++)
        point[r] = solid->position[r] + solid->rotation[r * 3] * local[0] + solid->rotation[r * 3 + 1] * local[1] + solid->rotation[r * 3 + 2] * local[2];
}

static void draw_local(Drawing *drawing, const Solid *solid, const double from[3], const double to[3])
{
    double start[3], end[3];
    place(solid, from, start);
    place(solid, to, end);
    draw(drawing, start, end);
}

/* A part of a circle: c + r (cos u + sin v) for angles from `begin` on. */
static void draw_arc(Drawing *drawing, const Solid *solid, const double centre[3], int u, int v, double begin, int lines)
{
    double from[3], to[3];
    for (int i = 0; i <= lines; i++) {
        const double angle = begin + TURN * i / CIRCLE_LINES;
        memcpy(to, centre, sizeof to);
        to[u] += solid->radius * cos(angle);
        to[v] += solid->radius * sin(angle);
        if (i > 0) draw_local(drawing, solid, from, to);
        memcpy(from, to, sizeof from);
    }
}

/* All edges of a box along an axis, or, in 2D, the sides. */
static void draw_edges(Drawing *drawing, const Solid *solid, const double low[3], const double high[3])
{
    for (int along = 0; along < drawing->dimension; along++) {
        const int b = (along + 1) % 3, c = (along + 2) % 3;
        for (int corner = 0; corner < 4; corner++) {
            double from[3], to[3];
            from[along] = low[along];
            to[along] = high[along];
            from[b] = to[b] = corner % 2 ? high[b] : low[b];
            from[c] = to[c] = corner / 2 ? high[c] : low[c];
            const bool twice = drawing->dimension == 2 && (c == 2 ? corner / 2 : corner % 2); /* both ends of the third axis */
            if (!twice) draw_local(drawing, solid, from, to);
        }
    }
}

static void draw_ball(Drawing *drawing, const Solid *solid)
{
    const double centre[3] = {0};
    draw_arc(drawing, solid, centre, 0, 1, 0.0, CIRCLE_LINES);
    if (drawing->dimension == 2) return;
    draw_arc(drawing, solid, centre, 1, 2, 0.0, CIRCLE_LINES);
    draw_arc(drawing, solid, centre, 2, 0, 0.0, CIRCLE_LINES);
}

static void draw_capsule(Drawing *drawing, const Solid *solid)
{
    const double half = solid->half_extents[0];
    const double end[2][3] = {{-half, 0, 0}, {half, 0, 0}};
    for (int v = 1; v < drawing->dimension; v++) {
        draw_arc(drawing, solid, end[0], 0, v, 0.25 * TURN, CIRCLE_LINES / 2);
        draw_arc(drawing, solid, end[1], 0, v, -0.25 * TURN, CIRCLE_LINES / 2);
        for (int side = -1; side <= 1; side += 2) {
            double from[3] = {-half}, to[3] = {half};
            from[v] = to[v] = side * solid->radius;
            draw_local(drawing, solid, from, to);
        }
    }
    for (int k = 0; k < 2 && drawing->dimension == 3; k++) draw_arc(drawing, solid, end[k], 1, 2, 0.0, CIRCLE_LINES);
}

/* Two unit vectors in the plane. */
static void span_plane(const double normal[3], int dimension, double u[3], double v[3])
{
    const int least = dimension == 2 ? 2 : fabs(normal[0]) < fabs(normal[1]) ? (fabs(normal[0]) < fabs(normal[2]) ? 0 : 2) : fabs(normal[1]) < fabs(normal[2]) ? 1 : 2;
    double axis[3] = {0}, length = 0.0;
    axis[least] = 1.0;
    for (int a = 0; a < 3; a++) u[a] = normal[(a + 1) % 3] * axis[(a + 2) % 3] - normal[(a + 2) % 3] * axis[(a + 1) % 3];
    for (int a = 0; a < 3; a++) length += u[a] * u[a];
    for (int a = 0; a < 3; a++) u[a] /= sqrt(length);
    for (int a = 0; a < 3; a++) v[a] = normal[(a + 1) % 3] * u[(a + 2) % 3] - normal[(a + 2) % 3] * u[(a + 1) % 3];
}

static void draw_plane(Drawing *drawing, const Solid *solid, double cell_size)
{
    double u[3], v[3], corner[5][3];
    const double half = 0.5 * PLANE_CELLS * cell_size;
    span_plane(solid->normal, drawing->dimension, u, v);
    for (int k = 0; k < 5; k++)
        for (int a = 0; a < 3; a++) {
            const double across = drawing->dimension == 2 ? 0.0 : k % 4 < 2 ? -half : half;
            corner[k][a] = solid->position[a] + (k % 4 == 0 || k % 4 == 3 ? -half : half) * u[a] + across * v[a];
        }
    for (int k = 0; k < (drawing->dimension == 2 ? 1 : 4); k++) draw(drawing, corner[k], corner[k + 1]);
}

/* ---- Baked solids ---- */

static double value_at(const DistanceGrid *grid, const int32_t node[3])
{
    return (double)grid->value[((size_t)node[2] * (size_t)grid->count[1] + (size_t)node[1]) * (size_t)grid->count[0] + (size_t)node[0]];
}

/* The line in which the surface cuts a square of nodes, `wide` of them apart: where the distance changes its sign along two of its sides. Where it does so along all
 * four, the lines join neighbouring sides. */
static void contour_square(Drawing *drawing, const Solid *solid, const int32_t corner[3], int u, int v, int32_t wide)
{
    static const int32_t around[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 0}};
    const DistanceGrid *grid = solid->grid;
    double found[4][3];
    int crossings = 0;
    for (int side = 0; side < 4; side++) {
        int32_t a[3], b[3];
        memcpy(a, corner, sizeof a);
        memcpy(b, corner, sizeof b);
        a[u] += wide * around[side][0];
        a[v] += wide * around[side][1];
        b[u] += wide * around[side + 1][0];
        b[v] += wide * around[side + 1][1];
        const double from = value_at(grid, a), to = value_at(grid, b);
        if ((from < 0.0) == (to < 0.0)) continue;
        const double share = from / (from - to);
        for (int k = 0; k < 3; k++) found[crossings][k] = grid->low[k] + grid->spacing * (a[k] + share * (b[k] - a[k]));
        crossings++;
    }
    for (int k = 0; k + 1 < crossings; k += 2) draw_local(drawing, solid, found[k], found[k + 1]);
}

/* Contours in the planes of nodes across an axis. */
static void contour_planes(Drawing *drawing, const Solid *solid, int across)
{
    const DistanceGrid *grid = solid->grid;
    const int u = (across + 1) % 3, v = (across + 2) % 3;
    const int32_t wide = drawing->dimension == 3 ? 2 : 1;
    int32_t node[3];
    for (node[across] = 0; node[across] < grid->count[across]; node[across] += CONTOUR_NODES)
        for (node[u] = 0; node[u] + wide < grid->count[u]; node[u] += wide)
            for (node[v] = 0; node[v] + wide < grid->count[v]; node[v] += wide) contour_square(drawing, solid, node, u, v, wide);
}

static void draw_baked(Drawing *drawing, const Solid *solid)
{
    for (int across = drawing->dimension == 2 ? 2 : 0; across < 3; across++) contour_planes(drawing, solid, across);
}

static void draw_solid(Drawing *drawing, const Solid *solid, double cell_size)
{
    double low[3], high[3];
    switch (solid->kind) {
    case PBMPM_PLANE: draw_plane(drawing, solid, cell_size); return;
    case PBMPM_SPHERE: draw_ball(drawing, solid); return;
    case PBMPM_CAPSULE: draw_capsule(drawing, solid); return;
    case PBMPM_BAKED: draw_baked(drawing, solid); return;
    case PBMPM_BOX:
        for (int a = 0; a < 3; a++) low[a] = -(high[a] = solid->half_extents[a]);
        draw_edges(drawing, solid, low, high);
        return;
    case PBMPM_SHAPE_KIND_FORCE32: return;
    }
}

/* ---- What is in the world ---- */

static const Solid STANDS_STILL = {.rotation = {1, 0, 0, 0, 1, 0, 0, 0, 1}};

static void draw_box(Drawing *drawing, const double low[3], const double high[3]) { draw_edges(drawing, &STANDS_STILL, low, high); }

/* The face of each wall, as large as the box. */
static void draw_domain(Drawing *drawing, const World *world)
{
    for (int wall = 0; wall < 2 * drawing->dimension; wall++) {
        double low[3], high[3];
        if (world->domain.wall[wall].open) continue;
        for (int a = 0; a < 3; a++) {
            low[a] = (double)world->def.domain_min[a];
            high[a] = (double)world->def.domain_max[a];
        }
        low[wall / 2] = high[wall / 2] = wall % 2 ? high[wall / 2] : low[wall / 2];
        for (int along = 0; along < drawing->dimension; along++) {
            if (along == wall / 2) continue;
            const int other = 3 - along - wall / 2;
            for (int side = 0; side < (drawing->dimension == 2 ? 1 : 2); side++) {
                double from[3], to[3];
                memcpy(from, low, sizeof from);
                from[other] = side ? high[other] : low[other];
                memcpy(to, from, sizeof to);
                to[along] = high[along];
                draw(drawing, from, to);
            }
        }
    }
}

static void draw_colliders(Drawing *drawing, const World *world)
{
    for (uint32_t i = 0; i < world->colliders.used; i++) {
        const Collider *collider = &world->colliders.slot[i];
        if (collider->generation == 0) continue;
        const Solid solid = solid_among(&collider->shape, drawing->dimension, &world->baked);
        draw_solid(drawing, &solid, (double)world->def.cell_size);
    }
}

static void draw_emitters(Drawing *drawing, const World *world)
{
    for (uint32_t i = 0; i < world->emitters.used; i++) {
        const Solid solid = solid_of(&world->emitters.slot[i].shape, drawing->dimension);
        if (world->emitters.slot[i].generation != 0) draw_solid(drawing, &solid, (double)world->def.cell_size);
    }
}

static void draw_drains(Drawing *drawing, const World *world)
{
    for (uint32_t i = 0; i < world->sinks.used; i++)
        if (world->sinks.slot[i].generation != 0) draw_solid(drawing, &world->sinks.slot[i].solid, (double)world->def.cell_size);
}

static void draw_forces(Drawing *drawing, const World *world)
{
    for (uint32_t i = 0; i < world->forces.used; i++) {
        const Force *force = &world->forces.slot[i];
        if (force->generation != 0 && force->def.enabled) draw_solid(drawing, &force->solid, (double)world->def.cell_size);
    }
}

static void draw_bounds(Drawing *drawing, const World *world)
{
    double low[3], high[3];
    if (!world->sinks.bounds.enabled) return;
    for (int a = 0; a < 3; a++) {
        low[a] = (double)world->sinks.bounds.low[a];
        high[a] = (double)world->sinks.bounds.high[a];
    }
    draw_box(drawing, low, high);
}

/* A block, by its first cell. Cell n is around node n. */
static void draw_block(Drawing *drawing, const World *world, const int32_t cell[3])
{
    double low[3] = {0}, high[3] = {0};
    for (int a = 0; a < drawing->dimension; a++) {
        low[a] = ((double)cell[a] - 0.5) * (double)world->def.cell_size;
        high[a] = low[a] + K_BLOCK_AXIS * (double)world->def.cell_size;
    }
    draw_box(drawing, low, high);
}

static void draw_blocks(Drawing *drawing, const World *world)
{
    const int groups = world->islands.groups > 1 ? world->islands.groups : 1;
    for (int group = 0; group < groups; group++) {
        const Grid *grid = islands_grid(world, group);
        const int32_t *coordinate = grid->coordinate.data;
        for (int32_t block = 0; block < grid->particle_blocks; block++) {
            int32_t cell[3] = {0};
            for (int a = 0; a < drawing->dimension; a++) cell[a] = grid->anchor[a] + coordinate[block * 3 + a] * K_BLOCK_AXIS;
            draw_block(drawing, world, cell);
        }
    }
}

static void draw_asleep(Drawing *drawing, const World *world)
{
    for (uint32_t i = 0; i < world->sleep.asleep.count; i++) {
        const SleepBlock *block = sleep_list_block(&world->sleep.asleep, i);
        int32_t cell[3] = {0};
        for (int a = 0; a < drawing->dimension; a++) cell[a] = block->place[a] * K_BLOCK_AXIS + world->sleep.phase[a];
        draw_block(drawing, world, cell);
    }
}

uint32_t debug_lines_draw(const World *world, uint32_t parts, pbmpm_line *lines, uint32_t capacity)
{
    static const struct {
        pbmpm_debug_part part;
        void (*draw)(Drawing *drawing, const World *world);
    } all[] = {{PBMPM_DEBUG_DOMAIN, draw_domain},   {PBMPM_DEBUG_COLLIDERS, draw_colliders},   {PBMPM_DEBUG_EMITTERS, draw_emitters},
               {PBMPM_DEBUG_DRAINS, draw_drains},   {PBMPM_DEBUG_FORCES, draw_forces},         {PBMPM_DEBUG_KILL_BOUNDS, draw_bounds},
               {PBMPM_DEBUG_BLOCKS, draw_blocks},   {PBMPM_DEBUG_ASLEEP, draw_asleep}};
    Drawing drawing = {.lines = lines, .capacity = capacity, .dimension = world->def.dimension};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        drawing.part = all[i].part;
        if (parts & (uint32_t)all[i].part) all[i].draw(&drawing, world);
    }
    return drawing.count > UINT32_MAX ? UINT32_MAX : (uint32_t)drawing.count;
}
