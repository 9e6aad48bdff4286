#include "services/advice_rules.h"

#include <math.h>

/* ---- Speed and thickness ---- */

/* The farthest that a turn about its position carries a point of a shape; of planes and baked solids it is not known. */
static double reach_of(const Collider *collider)
{
    const pbmpm_shape *shape = &collider->shape;
    double sum = 0.0;
    switch (shape->kind) {
    case PBMPM_BOX:
        for (int a = 0; a < 3; a++) sum += (double)shape->half_extents[a] * (double)shape->half_extents[a];
        return sqrt(sum);
    case PBMPM_CAPSULE: return (double)shape->half_extents[0] + (double)shape->radius;
    case PBMPM_SPHERE: /* turns in its own place */
    case PBMPM_BAKED:
    case PBMPM_PLANE:
    case PBMPM_SHAPE_KIND_FORCE32: break;
    }
    return 0.0;
}

static double way_of(const Collider *collider, int dimension)
{
    double way2 = 0.0, dot = 0.0;
    for (int a = 0; a < dimension; a++) {
        const double step = (double)collider->target_position[a] - (double)collider->shape.position[a];
        way2 += step * step;
    }
    for (int a = 0; a < 4; a++) dot += (double)collider->target_rotation[a] * (double)collider->shape.rotation[a];
    const double angle = 2.0 * acos(fmin(1.0, fabs(dot)));
    return sqrt(way2) + angle * reach_of(collider);
}

void advise_collider_too_fast(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *collider = &world->colliders.slot[c];
        if (!world_feels(world, collider) || !collider_moves(collider)) continue;
        const double cells = way_of(collider, world->def.dimension) / ((double)world->def.cell_size * world->settings.substeps);
        if (cells <= 1.0) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_COLLIDER_TOO_FAST, .collider = {c, collider->generation}, .figure = (float)cells, .bound = 1.0f,
                               .text = "an obstacle moves by more than a cell per substep: it passes matter by, or throws it"};
        adviser_by_substeps(adviser, cells, &advice);
        if (advice.change == PBMPM_CHANGE_NONE) advice.text = "an obstacle moves by far more than a cell per substep: it passes matter by, and no number of substeps that pays holds it";
        adviser_give(adviser, advice);
    }
}

/* Whether matter is within reach of a box's two widest faces. What is round has matter all around, or may have it soon. */
static bool parts_matter(const World *world, const Collider *collider)
{
    const Particles *p = &world->particles;
    const double cell = (double)world->def.cell_size;
    if (collider->shape.kind != PBMPM_BOX) return true;
    const Solid solid = solid_of(&collider->shape, p->dimension);
    int thin = 0;
    bool found[2] = {false, false};
    for (int a = 1; a < p->dimension; a++) thin = solid.half_extents[a] < solid.half_extents[thin] ? a : thin;
    for (uint32_t row = 0; row < p->count && !(found[0] && found[1]); row++) {
        double away[3] = {0}, local[3] = {0};
        bool beside = true;
        for (int a = 0; a < p->dimension; a++) away[a] = particles_coordinate(p, row, a) * cell - solid.position[a];
        for (int a = 0; a < p->dimension; a++)
            for (int b = 0; b < p->dimension; b++) local[a] += solid.rotation[3 * b + a] * away[b];
        for (int a = 0; a < p->dimension; a++) beside = beside && fabs(local[a]) <= solid.half_extents[a] + (a == thin ? NODE_REACH * cell : 0.0);
        if (beside) found[local[thin] > 0.0] = true;
    }
    return found[0] && found[1];
}

/* How thick [cells] an obstacle has to be. Splines reach into a box from both sides: water rests beside one of three cells, and stirs at 0.3 m/s beside one of two. What is
 * round parts nothing: water flows round it. */
static double thickness_needed(const Collider *collider) { return collider->shape.kind == PBMPM_BOX ? 2.0 * NODE_REACH : 1.0; }

void advise_collider_too_thin(Adviser *adviser)
{
    const World *world = adviser->world;
    const double cell = (double)world->def.cell_size;
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *collider = &world->colliders.slot[c];
        if (!world_feels(world, collider)) continue;
        const Solid solid = solid_of(&collider->shape, world->def.dimension);
        const double cells = solid_breadth(&solid) / cell, needed = thickness_needed(collider);
        if (cells >= needed - 1e-5 || !parts_matter(world, collider)) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_COLLIDER_TOO_THIN, .collider = {c, collider->generation}, .figure = (float)cells, .bound = (float)needed,
                               .text = "an obstacle is too thin to part matter: one side feels the other, and water there stirs"};
        adviser_by_value(PBMPM_CHANGE_COLLIDER, needed * cell, 0.0, &advice);
        adviser_give(adviser, advice);
    }
}

/* ---- Baked obstacles ---- */

typedef struct Room {
    double low[3], high[3];
} Room;

static void room_take(Room *room, const double at[3])
{
    for (int a = 0; a < 3; a++) {
        room->low[a] = fmin(room->low[a], at[a]);
        room->high[a] = fmax(room->high[a], at[a]);
    }
}

/* What runs through gaps: liquid and sand. */
static bool pours(const World *world, uint32_t slot) { return world->materials.def[slot].kind == PBMPM_LIQUID || world->materials.def[slot].kind == PBMPM_SAND; }

/* Where what pours is, and where it comes from. */
static Room room_of_poured(const World *world)
{
    const Particles *p = &world->particles;
    Room room = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (uint32_t row = 0; row < p->count; row++) {
        double at[3] = {0};
        if (!pours(world, p->material[row])) continue;
        for (int a = 0; a < p->dimension; a++) at[a] = particles_coordinate(p, row, a) * (double)world->def.cell_size;
        room_take(&room, at);
    }
    for (uint32_t e = 0; e < world->emitters.used; e++) {
        const Emitter *emitter = &world->emitters.slot[e];
        const float *from = emitter->shape.position;
        if (emitter->generation == 0 || !pours(world, emitter->def.material.index)) continue;
        room_take(&room, (const double[3]){(double)from[0], (double)from[1], world->def.dimension == 3 ? (double)from[2] : 0.0});
    }
    return room;
}

/* Whether a point lies so deep in other obstacles, or beyond a wall of the domain. */
static bool is_buried(const World *world, const Collider *but, const double point[3], double deep)
{
    double normal[3];
    for (int a = 0; a < world->def.dimension; a++)
        if (point[a] < world->domain.low[a] - deep || point[a] > world->domain.high[a] + deep) return true;
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *other = &world->colliders.slot[c];
        if (other == but || !world_feels(world, other)) continue;
        const Solid solid = solid_among(&other->shape, world->def.dimension, &world->baked);
        if (solid_distance(&solid, point, normal) <= -deep) return true;
    }
    return false;
}

/* Whether what flows may come to an edge of the box around a baked solid that no other obstacle hides: along an edge of the box so many points. */
static bool shows_edge(const World *world, const Collider *collider, const Solid *solid, const Room *room)
{
    enum { POINTS = 9 };
    const DistanceGrid *grid = solid->grid;
    const double margin = DISTANCE_GRID_BORDER * grid->spacing;
    const int dimension = world->def.dimension, edges = dimension == 2 ? 1 : 3, points = dimension == 2 ? 1 : POINTS;
    for (int corner = 0; corner < 1 << dimension; corner++)
        for (int along = 0; along < edges; along++)
            for (int i = 0; i < points; i++) {
                double at[3] = {0};
                bool near = true;
                for (int b = 0; b < dimension; b++) {
                    const double low = grid->low[b] + margin, high = distance_grid_high(grid, b) - margin;
                    const double local = dimension == 3 && b == along ? low + (high - low) * i / (POINTS - 1) : corner >> b & 1 ? high : low;
                    for (int a = 0; a < dimension; a++) at[a] += solid->rotation[3 * a + b] * local;
                }
                for (int a = 0; a < dimension; a++) {
                    at[a] += solid->position[a];
                    near = near && at[a] > room->low[a] - margin && at[a] < room->high[a] + margin;
                }
                if (near && !is_buried(world, collider, at, grid->spacing)) return true;
            }
    return false;
}

/* A grid of distances rounds edges. With cells of up to 1.5 of the world's water rests beside them. With two it moves for ever, see
 * tests/field/run.py mesh_wall --settings 60x5. Where the edges are, the box around the solid tells. */
void advise_collider_too_coarse(Adviser *adviser)
{
    static const double WIDEST = 1.5; /* cells of the world: see above */
    static const double NEARLY = 1.01; /* who asked for that need not hit it exactly: the longest side of a grid is a whole number of its cells */
    const World *world = adviser->world;
    const double cell = (double)world->def.cell_size;
    Room room;
    bool found = false;
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *collider = &world->colliders.slot[c];
        if (!world_feels(world, collider) || collider->shape.kind != PBMPM_BAKED) continue;
        const Solid solid = solid_among(&collider->shape, world->def.dimension, &world->baked);
        const double cells = solid.grid->spacing / cell;
        if (cells <= WIDEST * NEARLY) continue;
        if (!found) room = room_of_poured(world);
        found = true;
        if (!shows_edge(world, collider, &solid, &room)) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_COLLIDER_TOO_COARSE, .collider = {c, collider->generation}, .figure = (float)cells, .bound = (float)WIDEST,
                               .text = "a baked obstacle's grid is too coarse at an edge that liquid or sand comes to: it moves there for ever, or slips through"};
        adviser_by_value(PBMPM_CHANGE_BAKED_SPACING, WIDEST * cell, 0.0, &advice);
        adviser_give(adviser, advice);
    }
}
