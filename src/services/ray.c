/* By spheres that no obstacle reaches into (J. Hart, "Sphere tracing", The Visual Computer 12, 1996). */
#include "services/ray.h"

#include <math.h>

static const double ARRIVED = 0.01; /* cells */

/* Metres that one can go on from a point, at least. What one goes along, or away from, within a cell of it, is looked at again a cell on. */
static double room_ahead(const World *world, uint32_t slot, const double point[3], const double along[3])
{
    static const double PARALLEL = 1e-3; /* sine: what nears a surface by less meets it a thousand cells on */
    const double cell = (double)world->def.cell_size;
    double nearest = INFINITY, ahead[3];
    for (int a = 0; a < 3; a++) ahead[a] = point[a] + ARRIVED * cell * along[a];
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *collider = &world->colliders.slot[c];
        if (!collider_acts(collider) || !groups_meet(collider->def.meets, world->materials.def[slot].groups)) continue;
        const Solid solid = solid_among(&collider->shape, world->def.dimension, &world->baked);
        double gap = solid_least(&solid, point);
        if (gap < cell && solid_least(&solid, ahead) >= gap - PARALLEL * ARRIVED * cell) gap = cell;
        nearest = fmin(nearest, gap);
    }
    return nearest;
}

double ray_to_obstacle(const World *world, uint32_t slot, const double from[3], const double along[3], double far)
{
    enum { SPHERES = 256 };
    double way = 0.0;
    for (int i = 0; i < SPHERES && way < far; i++) {
        double at[3] = {0};
        for (int a = 0; a < world->def.dimension; a++) at[a] = from[a] + way * along[a];
        const double room = room_ahead(world, slot, at, along);
        if (room < ARRIVED * (double)world->def.cell_size) return way;
        way += room;
    }
    return INFINITY;
}

double ray_to_wall(const World *world, const double from[3], const double along[3], double far)
{
    double nearest = INFINITY;
    for (int a = 0; a < world->def.dimension && world->def.domain_enabled; a++) {
        const bool upper = along[a] > 0.0;
        const double wall = (double)(upper ? world->def.domain_max[a] : world->def.domain_min[a]);
        if (along[a] == 0.0 || world->domain.wall[domain_place(a, upper)].open) continue;
        nearest = fmin(nearest, fmax(0.0, (wall - from[a]) / along[a]));
    }
    return nearest < far ? nearest : INFINITY;
}
