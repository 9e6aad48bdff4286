/* By spheres that no obstacle reaches into (J. Hart, "Sphere tracing", The Visual Computer 12, 1996). */
#include "services/way.h"

#include <math.h>

/* Metres to the nearest obstacle, at least. */
static double room_around(const World *world, uint32_t slot, const double point[3])
{
    double nearest = INFINITY;
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *collider = &world->colliders.slot[c];
        if (!collider_acts(collider) || !groups_meet(collider->def.meets, world->materials.def[slot].groups)) continue;
        const Solid solid = solid_among(&collider->shape, world->def.dimension, &world->baked);
        nearest = fmin(nearest, solid_least(&solid, point));
    }
    return nearest;
}

double way_to_obstacle(const World *world, uint32_t slot, const double from[3], const double along[3], double far)
{
    enum { SPHERES = 256 };
    static const double TOUCHES = 0.01; /* cells */
    double way = 0.0;
    for (int i = 0; i < SPHERES && way < far; i++) {
        double at[3] = {0};
        for (int a = 0; a < world->def.dimension; a++) at[a] = from[a] + way * along[a];
        const double room = room_around(world, slot, at);
        if (room < TOUCHES * (double)world->def.cell_size) return way;
        way += room;
    }
    return way < far ? way : INFINITY;
}

double way_to_wall(const World *world, const double from[3], const double along[3], double far)
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
