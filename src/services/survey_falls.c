/* Where matter falls, hangs, slides, lies on a slope, or carries a film of liquid. */
#include "services/survey_parts.h"

#include <math.h>
#include <stdlib.h>

#include "world/depth.h"

/* Cells of free way along gravity's axis from the end of a body until other matter or an obstacle; infinitely many if there is none within FAR, and negative
 * where the body goes on below. Tells if it is matter. */
static double drop_of(const World *world, Cells *cells, uint32_t bottom, int axis, bool *on_matter)
{
    enum { FAR = 256 };
    const Share *share = &cells->share[bottom];
    const int way = world->settings.gravity[axis] > 0.0f ? 1 : -1;
    const uint32_t body = survey_body_of(cells, bottom);
    int32_t cell[3] = {share->cell[0], share->cell[1], share->cell[2]};
    double along[3] = {0};
    along[axis] = way;
    const double room = fmax(0.0, survey_cells_to_obstacle(world, share, along, FAR) - 0.5); /* matter reaches to the end of its cell */
    for (int step = 0; step < FAR && step <= room; step++) {
        cell[axis] += way;
        const Below below = survey_below_of(cells, cell, body);
        if (below == NOTHING) continue;
        if (below == ITSELF) return -1.0;
        *on_matter = true;
        return step;
    }
    return room < FAR ? room : INFINITY;
}

static int by_size(const void *a, const void *b)
{
    const double one = *(const double *)a, other = *(const double *)b;
    return one < other ? -1 : one > other;
}

/* So that about LOOKED_AT ends of a solid are looked at: one cell in eight is one. */
static uint32_t stride_of(const Cells *cells, uint32_t slot)
{
    uint32_t count = 0;
    for (uint32_t i = 0; i < cells->count; i++) count += cells->share[i].group == slot + 1;
    return 1 + count / (8 * LOOKED_AT);
}

/* Whether it is faster than after a free fall through a cell: a stream is no slope, however it stands. */
static bool is_falling(const World *world, const Share *share)
{
    const double strength = gravity_strength(world), speed = share->falling / (share->filling * strength);
    return speed > 0.0 && speed * speed > 2.0 * strength * (double)world->def.cell_size;
}

/* How many of these drops, which are sorted, are farther than the others by JUMP at least, if those are the fewer. */
static uint32_t count_far(const double *drop, uint32_t count)
{
    static const double JUMP = 4.0; /* [cells] less may be between pieces */
    double widest = JUMP;
    uint32_t far = 0;
    for (uint32_t i = 1; i < count && drop[i - 1] < INFINITY; i++) {
        if (drop[i] - drop[i - 1] < widest) continue;
        widest = drop[i] - drop[i - 1];
        far = count - i;
    }
    return 2 * far < count ? far : 0;
}

void survey_drops(const World *world, Cells *cells, int axis, uint32_t slot, Heap *heap)
{
    const int way = world->settings.gravity[axis] > 0.0f ? 1 : -1;
    double drops[2 * LOOKED_AT], resting[2 * LOOKED_AT]; /* of all; and of what does not fall yet, where nothing below is infinitely far */
    uint32_t number = 0, count = 0, rests = 0, ends = 0;
    for (uint32_t i = 0; i < cells->count; i++) ends += cells->share[i].group == slot + 1 && survey_group_ends(cells, &cells->share[i], axis, way);
    const uint32_t stride = 1 + ends / (2 * LOOKED_AT); /* of ends, not of cells: under deep matter they are few, and a hole is measured by them */
    for (uint32_t i = 0; i < cells->count && count < 2 * LOOKED_AT; i++) {
        if (cells->share[i].group != slot + 1 || !survey_group_ends(cells, &cells->share[i], axis, way) || number++ % stride != 0) continue;
        const double drop = drop_of(world, cells, i, axis, &heap->on_matter);
        if (drop < 0.0) continue;
        drops[count++] = drop < INFINITY ? drop : 0.0;
        if (!is_falling(world, &cells->share[i])) resting[rests++] = drop;
    }
    if (count == 0) return;
    qsort(drops, count, sizeof *drops, by_size);
    qsort(resting, rests, sizeof *resting, by_size);
    heap->drop_least = drops[0];
    heap->drop_half = drops[count / 2];
    heap->drop_most = drops[count - 1];
    const double far = (double)stride * count_far(resting, rests);
    heap->hole = world->def.dimension == 2 ? far : sqrt(far);
}

/* Whether matter, or an obstacle, lies within two cells below a share. Sorted by cell. */
static bool is_supported(const World *world, const Cells *cells, const Share *share, int axis, int down)
{
    enum { NEAR = 2 };
    int32_t cell[3] = {share->cell[0], share->cell[1], share->cell[2]};
    double along[3] = {0};
    along[axis] = down;
    for (int step = 0; step < NEAR; step++) {
        cell[axis] += down;
        if (survey_filling_at(cells, cell) > 0.0) return true;
    }
    return survey_cells_to_obstacle(world, share, along, NEAR) < INFINITY;
}

/* Cells of free way up to another body, whose surfaces are half a spacing beyond their last particles; infinitely many if there is none within two cells. Sorted by cell, bodies
 * are found. */
static double gap_above(const World *world, Cells *cells, uint32_t top, int axis, int up)
{
    enum { NEAR = 3 };
    const uint32_t body = survey_body_of(cells, top);
    const Share *share = &cells->share[top];
    Share above = {.cell = {share->cell[0], share->cell[1], share->cell[2]}};
    for (int step = 0; step < NEAR; step++) {
        const uint64_t place = survey_place_of(&above, 0, false);
        for (uint32_t i = survey_first_from(cells, place); i < cells->count && cells->share[i].place >> GROUP_BITS == place >> GROUP_BITS; i++) {
            const Share *other = &cells->share[i];
            if (other->group == 0 || world->materials.def[other->slot].kind == PBMPM_SAND || survey_body_of(cells, i) == body) continue;
            const double apart = step + (double)(up > 0 ? other->low[axis] - share->high[axis] : share->low[axis] - other->high[axis]);
            return fmax(0.0, apart - 0.5 * (share->spacing + other->spacing));
        }
        above.cell[axis] += up;
    }
    return INFINITY;
}

/* Whether the next cell has none of its body; another of the same material may begin there. Sorted by cell, bodies are found. */
static bool body_ends(Cells *cells, uint32_t i, int axis, int way)
{
    int32_t next[3] = {cells->share[i].cell[0], cells->share[i].cell[1], cells->share[i].cell[2]};
    next[axis] += way;
    return survey_below_of(cells, next, survey_body_of(cells, i)) != ITSELF;
}

bool survey_hangs(const World *world, Cells *cells, int axis, uint32_t slot)
{
    /* [cells] Nearer ones share nodes: of 1e6 Pa they hang, softer ones lag. At 2 those of 1e5 Pa fall freely (falls_from in tests/field). */
    static const double STUCK = 1.75;
    const int down = world->settings.gravity[axis] > 0.0f ? 1 : -1;
    for (uint32_t i = 0; i < cells->count; i++) {
        const Share *share = &cells->share[i];
        if (share->group == slot + 1 && body_ends(cells, i, axis, down) && is_supported(world, cells, share, axis, down)) cells->share[survey_body_of(cells, i)].borne = true;
    }
    for (uint32_t i = 0; i < cells->count; i++) {
        const Share *share = &cells->share[i];
        if (share->group != slot + 1 || cells->share[survey_body_of(cells, i)].borne || !body_ends(cells, i, axis, -down)) continue;
        if (gap_above(world, cells, i, axis, -down) < STUCK) return true;
    }
    return false;
}

/* Cells of free way down from a body's surface, which is half a spacing beyond its last particles, to an obstacle. */
static double gap_below(const World *world, const Share *share, int axis, int down)
{
    enum { FAR = 2 };
    const double last = (double)(down > 0 ? share->high[axis] : -share->low[axis]); /* below the middle of the cell */
    double along[3] = {0};
    along[axis] = down;
    return survey_cells_to_obstacle(world, share, along, FAR) - last - 0.5 * share->spacing;
}

bool survey_lies(const World *world, Cells *cells, int axis, uint32_t slot)
{
    static const double LIES = 0.5; /* [cells] halfway between what lies and what stops a cell above the floor */
    const int down = world->settings.gravity[axis] > 0.0f ? 1 : -1;
    bool all = true;
    for (uint32_t i = 0; i < cells->count; i++) {
        if (cells->share[i].group != slot + 1) continue;
        Share *first = &cells->share[survey_body_of(cells, i)];
        if (first->lies || !body_ends(cells, i, axis, down)) continue;
        first->lies = gap_below(world, &cells->share[i], axis, down) < LIES;
    }
    for (uint32_t i = 0; i < cells->count && all; i++)
        all = cells->share[i].group != slot + 1 || cells->share[survey_body_of(cells, i)].lies;
    return all;
}

void survey_film(const World *world, const Cells *cells, int axis, uint32_t slot, Heap *heap)
{
    const int up = world->settings.gravity[axis] > 0.0f ? -1 : 1;
    const uint32_t stride = stride_of(cells, slot);
    double tops = 0.0, filmed = 0.0;
    uint32_t number = 0;
    for (uint32_t i = 0; i < cells->count; i++) {
        const Share *share = &cells->share[i];
        if (share->group != slot + 1 || number++ % stride != 0 || !survey_group_ends(cells, share, axis, up)) continue;
        int32_t cell[3] = {share->cell[0], share->cell[1], share->cell[2]};
        bool wet = survey_any_of_group(cells, cell, 0), free = true;
        cell[axis] += up;
        wet = wet || survey_any_of_group(cells, cell, 0);
        for (int step = 0; step < 2; step++) {
            cell[axis] += up;
            free = free && survey_filling_at(cells, cell) == 0.0;
        }
        tops += 1.0;
        filmed += wet && free;
    }
    if (tops > 0.0) heap->film = filmed / tops;
}

/* How far it goes down beside a cell, SIDE cells away, in a direction that falls more steeply than friction bears, by a cell,
 * with no obstacle between: until matter or an obstacle [cells]. 0 if there is no room, and where nothing is below. */
static double room_below(const World *world, const Cells *cells, const Share *top, int axis, const double down[3], const double side[3])
{
    enum { SIDE = 6, FAR = 256 };
    const double angle = (double)world->materials.def[top->slot].friction_angle, deep = sin(angle) / cos(angle) * SIDE + 1.0, length = sqrt(SIDE * SIDE + deep * deep);
    double along[3] = {0}, fall[3] = {0};
    Share beside = *top;
    for (int a = 0; a < world->def.dimension; a++) {
        const double way = SIDE * side[a] + deep * down[a];
        along[a] = way / length;
        beside.cell[a] += (int32_t)floor(way + 0.5);
    }
    if (survey_cells_to_obstacle(world, top, along, length) < INFINITY || survey_filling_at(cells, beside.cell) > 0.0) return 0.0;
    fall[axis] = world->settings.gravity[axis] > 0.0f ? 1.0 : -1.0;
    const double room = survey_cells_to_obstacle(world, &beside, fall, FAR);
    int step = 0;
    for (; step < FAR && step < room && survey_filling_at(cells, beside.cell) == 0.0; step++) beside.cell[axis] += (int32_t)fall[axis];
    return step < FAR ? deep + fmin(step, room) : 0.0;
}

/* Whether what is below a cell stands on an obstacle, within two cells of its own. */
static bool is_borne(const World *world, const Cells *cells, const Share *top, int axis)
{
    enum { GAP = 2 };
    const int way = world->settings.gravity[axis] > 0.0f ? 1 : -1;
    Share last = *top;
    int32_t next[3] = {top->cell[0], top->cell[1], top->cell[2]};
    double along[3] = {0};
    along[axis] = way;
    for (next[axis] += way; survey_filling_at(cells, next) > 0.0; next[axis] += way) last.cell[axis] = next[axis];
    return survey_cells_to_obstacle(world, &last, along, GAP) < INFINITY;
}

/* To which sides along the grid a cell at the surface has room below: two bits for each axis. Keeps the deepest. */
static unsigned steep_sides(const World *world, const Cells *cells, const Share *top, int axis, const double down[3], double *deepest)
{
    unsigned sides = 0;
    for (int a = 0; a < world->def.dimension; a++)
        for (int upper = 0; upper < 2 && a != axis; upper++) {
            double side[3] = {0}, length = 0.0;
            for (int b = 0; b < world->def.dimension; b++) side[b] = (upper ? 1.0 : -1.0) * ((a == b ? 1.0 : 0.0) - down[a] * down[b]);
            for (int b = 0; b < world->def.dimension; b++) length += side[b] * side[b];
            for (int b = 0; b < world->def.dimension; b++) side[b] /= sqrt(length);
            const double room = room_below(world, cells, top, axis, down, side);
            if (room > 0.0) sides |= 1u << domain_place(a, upper);
            *deepest = fmax(*deepest, room);
        }
    return sides;
}

void survey_slopes(const World *world, const Cells *cells, int axis, uint32_t slot, Heap *heap)
{
    const int up = world->settings.gravity[axis] > 0.0f ? -1 : 1;
    const uint32_t stride = stride_of(cells, slot);
    double looked = 0.0, steep = 0.0, down[3];
    uint32_t number = 0;
    unsigned sides = 0;
    gravity_direction(world, down);
    for (uint32_t i = 0; i < cells->count; i++) {
        const Share *share = &cells->share[i];
        if (share->group != slot + 1 || number++ % stride != 0 || is_falling(world, share)) continue;
        if (!survey_group_ends(cells, share, axis, up) || !is_borne(world, cells, share, axis)) continue;
        const unsigned found = steep_sides(world, cells, share, axis, down, &heap->slide);
        looked += 1.0;
        steep += found != 0;
        sides |= found;
    }
    if (looked > 0.0) heap->steep = steep / looked;
    for (int a = 0; a < world->def.dimension; a++) heap->falls_both_ways = heap->falls_both_ways || (sides >> domain_place(a, false) & 3) == 3;
}

/* Whether an obstacle below a cell is nearer or farther a cell beside. Less than LEVEL is none, and more than STEP is an edge. From a cell higher, as what is in a last cell may end above its middle. */
static bool leans_below(const World *world, const Share *bottom, int axis, int side, bool *borne)
{
    static const double REACH = 4.0, LEVEL = 0.05, STEP = 2.0; /* [cells] */
    const int way = world->settings.gravity[axis] > 0.0f ? 1 : -1;
    Share above = *bottom;
    double down[3] = {0};
    down[axis] = way;
    above.cell[axis] -= way;
    const double here = survey_cells_to_obstacle(world, &above, down, REACH);
    above.cell[side]++;
    const double there = survey_cells_to_obstacle(world, &above, down, REACH), rise = fabs(here - there);
    *borne = *borne || here < REACH;
    return here < REACH && there < REACH && rise > LEVEL && rise < STEP;
}

double survey_leaning(const World *world, const Cells *cells, int axis)
{
    const int way = world->settings.gravity[axis] > 0.0f ? 1 : -1;
    double looked = 0.0, leaning = 0.0;
    uint32_t ends = 0, number = 0;
    for (uint32_t i = 0; i < cells->count; i++) ends += cells->share[i].group == 0 && survey_group_ends(cells, &cells->share[i], axis, way);
    const uint32_t stride = 1 + ends / LOOKED_AT;
    for (uint32_t i = 0; i < cells->count; i++) {
        const Share *share = &cells->share[i];
        bool borne = false, leans = false;
        if (share->group != 0 || !survey_group_ends(cells, share, axis, way) || number++ % stride != 0) continue;
        for (int a = 0; a < world->def.dimension; a++) leans = leans || (a != axis && leans_below(world, share, axis, a, &borne));
        looked += borne;
        leaning += leans;
    }
    return looked > 0.0 ? leaning / looked : 0.0;
}
