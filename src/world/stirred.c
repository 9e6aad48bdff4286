#include "world/stirred.h"

#include <math.h>

void stirred_add(World *world, const Solid *solid, double reach)
{
    Stirred *stirred = &world->granular.stirred;
    double low[3] = {-INFINITY, -INFINITY, -INFINITY}, high[3] = {INFINITY, INFINITY, INFINITY};
    const double wider = reach * (double)world->def.cell_size;
    if (solid && solid->kind != PBMPM_PLANE) solid_bounds(solid, low, high);
    for (int a = 0; a < 3; a++) {
        stirred->low[a] = stirred->any ? fmin(stirred->low[a], low[a] - wider) : low[a] - wider;
        stirred->high[a] = stirred->any ? fmax(stirred->high[a], high[a] + wider) : high[a] + wider;
    }
    stirred->any = 1;
}

void stirred_shift(World *world, const double by[3])
{
    Stirred *stirred = &world->granular.stirred;
    for (int a = 0; a < 3 && stirred->any; a++) {
        stirred->low[a] -= by[a];
        stirred->high[a] -= by[a];
    }
}

void stirred_clear(World *world) { world->granular.stirred = (Stirred){0}; }

bool stirred_meets(const World *world, int32_t block)
{
    const Stirred *stirred = &world->granular.stirred;
    const Grid *grid = &world->grid;
    const int32_t *coordinate = (const int32_t *)grid->coordinate.data + 3 * block;
    const double dx = (double)world->def.cell_size;
    bool meets = stirred->any;
    for (int a = 0; a < grid->dimension; a++) {
        const double first = (grid->anchor[a] + coordinate[a] * K_BLOCK_AXIS) * dx;
        meets = meets && first <= stirred->high[a] && first + (K_BLOCK_AXIS - 1) * dx >= stirred->low[a];
    }
    return meets;
}
