#include "services/survey_cells.h"

#include <math.h>
#include <stdlib.h>

#include "services/ray.h"

uint64_t survey_place_of(const Share *share, int last, bool grouped)
{
    const uint64_t a = (uint64_t)share->cell[(last + 1) % 3], b = (uint64_t)share->cell[(last + 2) % 3], c = (uint64_t)share->cell[last];
    const uint64_t cell = ((a << AXIS_BITS | b) << AXIS_BITS) | c;
    return grouped ? (uint64_t)share->group << 3 * AXIS_BITS | cell : cell << GROUP_BITS | share->group;
}

static int by_place(const void *a, const void *b)
{
    const uint64_t one = ((const Share *)a)->place, other = ((const Share *)b)->place;
    return one < other ? -1 : one > other;
}

void survey_sort_along(Cells *cells, int axis, bool grouped)
{
    for (uint32_t i = 0; i < cells->count; i++) cells->share[i].place = survey_place_of(&cells->share[i], axis, grouped);
    qsort(cells->share, cells->count, sizeof(Share), by_place);
}

bool survey_near_first(const Particles *p, uint32_t row, int32_t cell[3])
{
    bool near = true;
    for (int a = 0; a < p->dimension; a++) {
        cell[a] = p->cell[a][row] - p->cell[a][0] + HALF;
        near = near && cell[a] > 0 && cell[a] < 2 * HALF - 1;
    }
    return near;
}

/* Adds a share to the last one if that has the same place, else behind it. */
static void put_share(Cells *cells, uint32_t *count, const Share *share)
{
    Share *last = *count > 0 ? &cells->share[*count - 1] : NULL;
    if (!last || last->place != share->place) {
        cells->share[(*count)++] = *share;
        return;
    }
    last->filling += share->filling;
    last->falling += share->falling;
    last->spacing = fmax(last->spacing, share->spacing);
    for (int a = 0; a < 3; a++) {
        last->low[a] = fminf(last->low[a], share->low[a]);
        last->high[a] = fmaxf(last->high[a], share->high[a]);
    }
}

void survey_find_cells(const World *world, Cells *cells)
{
    const Particles *p = &world->particles;
    for (uint32_t row = 0; row < p->count; row++) {
        const uint32_t slot = p->material[row];
        Share share = {.slot = slot, .group = material_is_solid(&world->materials, slot) ? slot + 1 : 0, .thickness = INFINITY};
        const bool near = survey_near_first(p, row, share.cell);
        share.filling = (double)p->mass[row] / (double)world->materials.def[slot].density;
        share.spacing = pow(share.filling, 1.0 / p->dimension);
        for (int a = 0; a < p->dimension; a++) {
            share.falling += share.filling * (double)(p->velocity[a][row] * world->settings.gravity[a]);
            share.low[a] = share.high[a] = p->fraction[a][row];
        }
        share.place = survey_place_of(&share, 0, true);
        if (near) put_share(cells, &cells->count, &share);
    }
    survey_sort_along(cells, 0, true);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < cells->count; i++) put_share(cells, &kept, &cells->share[i]);
    cells->count = kept;
}

uint32_t survey_run_from(const Cells *cells, uint32_t first)
{
    uint32_t end = first + 1;
    while (end < cells->count && cells->share[end].place == cells->share[end - 1].place + 1) end++;
    return end - first;
}

double survey_middle_of(const World *world, const Share *share, int axis)
{
    return (double)(share->cell[axis] + world->particles.cell[axis][0] - HALF) * (double)world->def.cell_size;
}

double survey_cells_to_obstacle(const World *world, const Share *share, const double along[3], double far)
{
    const double cell = (double)world->def.cell_size;
    double from[3] = {0};
    for (int a = 0; a < world->def.dimension; a++) from[a] = survey_middle_of(world, share, a);
    return fmin(ray_to_obstacle(world, share->slot, from, along, far * cell), ray_to_wall(world, from, along, far * cell)) / cell;
}

uint32_t survey_first_from(const Cells *cells, uint64_t place)
{
    uint32_t low = 0, high = cells->count;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (cells->share[middle].place < place)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

double survey_filling_at(const Cells *cells, const int32_t cell[3])
{
    const Share wanted = {.cell = {cell[0], cell[1], cell[2]}};
    const uint64_t place = survey_place_of(&wanted, 0, false);
    const uint32_t low = survey_first_from(cells, place);
    double sum = 0.0;
    for (uint32_t i = low; i < cells->count && cells->share[i].place >> GROUP_BITS == place >> GROUP_BITS; i++) sum += cells->share[i].filling;
    return sum;
}

uint32_t survey_find_share(const Cells *cells, uint64_t place)
{
    const uint32_t low = survey_first_from(cells, place);
    return low < cells->count && cells->share[low].place == place ? low : cells->count;
}

uint32_t survey_body_of(Cells *cells, uint32_t i)
{
    while (cells->share[i].body != i) {
        cells->share[i].body = cells->share[cells->share[i].body].body;
        i = cells->share[i].body;
    }
    return i;
}

/* Whether one body reaches across the face between two cells. Its particles lie one spacing apart: where two spacings are between them, one of them is free. */
static bool is_one_body(const Share *share, const Share *next, int axis)
{
    const double apart = 1.0 + (double)next->low[axis] - (double)share->high[axis];
    return apart < 2.0 * fmax(share->spacing, next->spacing);
}

void survey_find_bodies(Cells *cells)
{
    for (uint32_t i = 0; i < cells->count; i++) cells->share[i].body = i;
    for (uint32_t i = 0; i < cells->count; i++) {
        if (cells->share[i].group == 0) continue;
        for (int a = 0; a < cells->dimension; a++) {
            Share next = cells->share[i];
            next.cell[a]++;
            const uint32_t other = survey_find_share(cells, survey_place_of(&next, 0, false));
            if (other == cells->count || !is_one_body(&cells->share[i], &cells->share[other], a)) continue;
            const uint32_t one = survey_body_of(cells, i), two = survey_body_of(cells, other);
            cells->share[one > two ? one : two].body = one > two ? two : one;
        }
    }
}

bool survey_any_of_group(const Cells *cells, const int32_t cell[3], uint32_t group)
{
    Share wanted = {.cell = {cell[0], cell[1], cell[2]}, .group = group};
    return survey_find_share(cells, survey_place_of(&wanted, 0, false)) < cells->count;
}

Below survey_below_of(Cells *cells, const int32_t cell[3], uint32_t body)
{
    const Share wanted = {.cell = {cell[0], cell[1], cell[2]}};
    const uint64_t place = survey_place_of(&wanted, 0, false);
    Below below = NOTHING;
    for (uint32_t i = survey_first_from(cells, place); i < cells->count && cells->share[i].place >> GROUP_BITS == place >> GROUP_BITS; i++) {
        if (survey_body_of(cells, i) == body) return ITSELF;
        below = OTHER;
    }
    return below;
}

bool survey_group_ends(const Cells *cells, const Share *share, int axis, int way)
{
    int32_t next[3] = {share->cell[0], share->cell[1], share->cell[2]};
    next[axis] += way;
    return !survey_any_of_group(cells, next, share->group);
}
