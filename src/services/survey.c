#include "services/survey.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/result.h"
#include "services/ray.h"
#include "world/depth.h"

/* What a group of matter has in one cell. Liquids are one group, each solid is its own. */
typedef struct Share {
    uint64_t place;   /* group, then two axes, then the axis that runs go along */
    int32_t cell[3];  /* from the lowest */
    uint32_t group;
    uint32_t slot;    /* a material of the group */
    double filling;   /* rest volume over cell volume */
    double falling;   /* the same times its speed along gravity [m^2/s^3] */
    double thickness; /* least so far */
    uint32_t body;    /* an earlier share of the same body, or itself */
    bool held;        /* an obstacle is where it ends, or other matter below */
} Share;

enum { AXIS_BITS = 18, GROUP_BITS = 9, FEW = 8, HALF = 1 << (AXIS_BITS - 1) };

typedef struct Cells {
    Share *share;
    uint32_t count;
    int dimension;
} Cells;

/* ---- Cells ---- */

static uint64_t place_of(const Share *share, int last, bool grouped)
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

static void sort_along(Cells *cells, int axis, bool grouped)
{
    for (uint32_t i = 0; i < cells->count; i++) cells->share[i].place = place_of(&cells->share[i], axis, grouped);
    qsort(cells->share, cells->count, sizeof(Share), by_place);
}

/* The cell that a particle is in, and whether it is near enough to the first's. */
static bool near_first(const Particles *p, uint32_t row, int32_t cell[3])
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
}

/* One share per cell and group. Particles that are 2^18 cells from the first are left out. Most of those in a cell are stored together: few are left to sort. */
static void find_cells(const World *world, Cells *cells)
{
    const Particles *p = &world->particles;
    for (uint32_t row = 0; row < p->count; row++) {
        const uint32_t slot = p->material[row];
        Share share = {.slot = slot, .group = material_is_solid(&world->materials, slot) ? slot + 1 : 0, .thickness = INFINITY};
        const bool near = near_first(p, row, share.cell);
        share.filling = (double)p->mass[row] / (double)world->materials.def[slot].density;
        for (int a = 0; a < p->dimension; a++) share.falling += share.filling * (double)(p->velocity[a][row] * world->settings.gravity[a]);
        share.place = place_of(&share, 0, true);
        if (near) put_share(cells, &cells->count, &share);
    }
    sort_along(cells, 0, true);
    uint32_t kept = 0;
    for (uint32_t i = 0; i < cells->count; i++) put_share(cells, &kept, &cells->share[i]);
    cells->count = kept;
}

/* ---- Runs: cells of a group, one behind the other ---- */

/* How long matter is that fills cells so far: their sum, over the share of a cell's width that it has. Noise fills some cells more than full. */
static double run_length(const Share *run, uint32_t count)
{
    double sum = 0.0, most = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        sum += run[i].filling;
        most = fmax(most, run[i].filling);
    }
    return most > 0.0 ? sum / fmin(1.0, most) : 0.0;
}

static uint32_t run_from(const Cells *cells, uint32_t first)
{
    uint32_t end = first + 1;
    while (end < cells->count && cells->share[end].place == cells->share[end - 1].place + 1) end++;
    return end - first;
}

/* Thicknesses along an axis, and each group's mean length of run, weighted by what is in it. */
static void measure_runs(Cells *cells, int axis, double mean[PBMPM_MAX_MATERIALS + 1])
{
    double weight[PBMPM_MAX_MATERIALS + 1] = {0};
    memset(mean, 0, (PBMPM_MAX_MATERIALS + 1) * sizeof *mean);
    sort_along(cells, axis, true);
    for (uint32_t first = 0, count; first < cells->count; first += count) {
        Share *run = &cells->share[first];
        count = run_from(cells, first);
        const double length = run_length(run, count);
        for (uint32_t i = 0; i < count; i++) {
            run[i].thickness = fmin(run[i].thickness, length);
            weight[run->group] += run[i].filling;
            mean[run->group] += run[i].filling * length;
        }
    }
    for (int group = 0; group <= PBMPM_MAX_MATERIALS; group++)
        if (weight[group] > 0.0) mean[group] /= weight[group];
}

/* ---- Room ---- */

/* Cells beside a run in which an obstacle counts as near, and runs that are looked at, along an axis. */
enum { ROOM = 5, LOOKED_AT = 64 };

static double middle_of(const World *world, const Share *share, int axis)
{
    return (double)(share->cell[axis] + world->particles.cell[axis][0] - HALF) * (double)world->def.cell_size;
}

/* Cells from the middle of a cell to the first obstacle, or infinitely many if there is none within `far`. `along`: of length 1. */
static double cells_to_obstacle(const World *world, const Share *share, const double along[3], double far)
{
    const double cell = (double)world->def.cell_size;
    double from[3] = {0};
    for (int a = 0; a < world->def.dimension; a++) from[a] = middle_of(world, share, a);
    return fmin(ray_to_obstacle(world, share->slot, from, along, far * cell), ray_to_wall(world, from, along, far * cell)) / cell;
}

/* How far the surface of liquids is from level. Columns end where their last cell is filled to, if no obstacle is there: under a wall that leans they end below the surface. Thin ones may be spray. */
static double measure_level(const World *world, Cells *cells, int axis, const double down[3])
{
    enum { COLUMN = 3, FREE = 2 };
    const int up = down[axis] > 0.0 ? -1 : 1;
    double sum = 0.0, square = 0.0, columns = 0.0, along[3] = {0};
    uint32_t runs = 0, number = 0;
    along[axis] = up;
    sort_along(cells, axis, true);
    for (uint32_t first = 0; first < cells->count; first += run_from(cells, first)) runs += cells->share[first].group == 0;
    const uint32_t stride = 1 + runs / LOOKED_AT;
    for (uint32_t first = 0, count; first < cells->count; first += count) {
        const Share *run = &cells->share[first];
        count = run_from(cells, first);
        if (run->group != 0 || count < COLUMN || number++ % stride != 0) continue;
        const Share *top = up > 0 ? &run[count - 1] : run, *inside = &run[count / 2]; /* the middle of the top may lie beyond a thin wall */
        const double to_top = abs(top->cell[axis] - inside->cell[axis]);
        double height = 0.0;
        if (cells_to_obstacle(world, inside, along, to_top + FREE) < INFINITY) continue;
        for (int a = 0; a < cells->dimension; a++) height -= down[a] * (top->cell[a] - HALF + (a == axis ? up * (fmin(top->filling, 1.0) - 0.5) : 0.0));
        columns += 1.0;
        sum += height;
        square += height * height;
    }
    return columns > 0.0 ? sqrt(fmax(0.0, square / columns - sum / columns * (sum / columns))) : 0.0;
}

/* Whether an obstacle stands closer than ROOM cells to an end of a run, which is known to half a cell. */
static bool is_shut(const World *world, const Share *end, int axis, int way)
{
    double along[3] = {0};
    along[axis] = way;
    return cells_to_obstacle(world, end, along, ROOM - 0.5) < INFINITY;
}

/* Which share of each solid stands between obstacles along an axis. */
static void measure_room(const World *world, Cells *cells, int axis, double narrow[PBMPM_MAX_MATERIALS + 1])
{
    double all[PBMPM_MAX_MATERIALS + 1] = {0}, shut[PBMPM_MAX_MATERIALS + 1] = {0};
    uint32_t runs = 0, number = 0;
    sort_along(cells, axis, true);
    for (uint32_t first = 0; first < cells->count; first += run_from(cells, first)) runs += cells->share[first].group > 0;
    const uint32_t stride = 1 + runs / LOOKED_AT;
    for (uint32_t first = 0, count; first < cells->count; first += count) {
        const Share *run = &cells->share[first];
        count = run_from(cells, first);
        if (run->group == 0 || number++ % stride != 0) continue;
        all[run->group] += count;
        if (is_shut(world, run, axis, -1) && is_shut(world, run + count - 1, axis, 1)) shut[run->group] += count;
    }
    for (int group = 1; group <= PBMPM_MAX_MATERIALS; group++) narrow[group] = all[group] > 0.0 ? fmin(narrow[group], shut[group] / all[group]) : 0.0;
}

/* ---- Crowding ---- */

/* The first share at a place or behind it. Sorted by cell. */
static uint32_t first_from(const Cells *cells, uint64_t place)
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

/* The filling of all groups in a cell, 0 if there is none. Sorted by cell. */
static double filling_at(const Cells *cells, const int32_t cell[3])
{
    const Share wanted = {.cell = {cell[0], cell[1], cell[2]}};
    const uint64_t place = place_of(&wanted, 0, false);
    const uint32_t low = first_from(cells, place);
    double sum = 0.0;
    for (uint32_t i = low; i < cells->count && cells->share[i].place >> GROUP_BITS == place >> GROUP_BITS; i++) sum += cells->share[i].filling;
    return sum;
}

/* A cell is inside if matter is in all next to it: walls and surfaces leave room there that nobody else takes. */
static bool is_inside(const Cells *cells, const Share *share)
{
    for (int a = 0; a < cells->dimension; a++)
        for (int step = -1; step <= 1; step += 2) {
            int32_t cell[3] = {share->cell[0], share->cell[1], share->cell[2]};
            cell[a] += step;
            if (filling_at(cells, cell) == 0.0) return false;
        }
    return true;
}

/* Means over the cells inside, and how well they are known: their standard errors, as if cells were filled by chance. */
static void measure_filling(Cells *cells, double filling[PBMPM_MAX_MATERIALS + 1], double error[PBMPM_MAX_MATERIALS + 1])
{
    uint32_t inside[PBMPM_MAX_MATERIALS + 1] = {0};
    double square[PBMPM_MAX_MATERIALS + 1] = {0};
    sort_along(cells, 0, false);
    for (uint32_t i = 0; i < cells->count; i++) {
        const Share *share = &cells->share[i];
        const double all = filling_at(cells, share->cell);
        if (share->filling < 0.5 * all || !is_inside(cells, share)) continue;
        filling[share->group] += all;
        square[share->group] += all * all;
        inside[share->group]++;
    }
    for (int group = 0; group <= PBMPM_MAX_MATERIALS; group++) {
        const double cells_inside = inside[group], mean = inside[group] < FEW ? 0.0 : filling[group] / cells_inside;
        filling[group] = mean;
        error[group] = mean > 0.0 ? sqrt(fmax(0.0, square[group] / cells_inside - mean * mean) / (cells_inside - 1.0)) : 0.0;
    }
}

/* On the mean of a cell, counted twice, and those next to it: by chance a single one holds up to twice what fits. */
static const double TOO_FULL = 1.6;

static bool is_too_full(const Cells *cells, const Share *share)
{
    double sum = 2.0 * filling_at(cells, share->cell);
    for (int a = 0; a < cells->dimension; a++)
        for (int step = -1; step <= 1; step += 2) {
            int32_t cell[3] = {share->cell[0], share->cell[1], share->cell[2]};
            cell[a] += step;
            sum += filling_at(cells, cell);
        }
    return sum > TOO_FULL * (2.0 + 2.0 * cells->dimension);
}

/* Sorted by cell. */
static void measure_overlaps(const Cells *cells, double overlapping[PBMPM_MAX_MATERIALS + 1])
{
    double volume[PBMPM_MAX_MATERIALS + 1] = {0};
    for (uint32_t i = 0; i < cells->count; i++) {
        const Share *share = &cells->share[i];
        volume[share->group] += share->filling;
        if (is_too_full(cells, share)) overlapping[share->group] += share->filling;
    }
    for (int group = 0; group <= PBMPM_MAX_MATERIALS; group++) overlapping[group] /= fmax(volume[group], 1e-300);
}

/* ---- Bodies ---- */

static uint32_t find_share(const Cells *cells, uint64_t place)
{
    const uint32_t low = first_from(cells, place);
    return low < cells->count && cells->share[low].place == place ? low : cells->count;
}

static uint32_t body_of(Cells *cells, uint32_t i)
{
    while (cells->share[i].body != i) {
        cells->share[i].body = cells->share[cells->share[i].body].body;
        i = cells->share[i].body;
    }
    return i;
}

/* Joins cells of a solid that share a face, in 2D an edge. Sorted by cell. */
static void find_bodies(Cells *cells)
{
    for (uint32_t i = 0; i < cells->count; i++) cells->share[i].body = i;
    for (uint32_t i = 0; i < cells->count; i++) {
        if (cells->share[i].group == 0) continue;
        for (int a = 0; a < cells->dimension; a++) {
            Share next = cells->share[i];
            next.cell[a]++;
            const uint32_t other = find_share(cells, place_of(&next, 0, false));
            if (other == cells->count) continue;
            const uint32_t one = body_of(cells, i), two = body_of(cells, other);
            cells->share[one > two ? one : two].body = one > two ? two : one;
        }
    }
}

/* ---- Falling, sliding ---- */

int survey_axis_of_gravity(const World *world)
{
    int axis = -1;
    for (int a = 0; a < world->def.dimension; a++)
        if (world->settings.gravity[a] != 0.0f && (axis < 0 || fabsf(world->settings.gravity[a]) > fabsf(world->settings.gravity[axis]))) axis = a;
    return axis;
}

/* Sorted by cell. */
static bool any_of_group(const Cells *cells, const int32_t cell[3], uint32_t group)
{
    Share wanted = {.cell = {cell[0], cell[1], cell[2]}, .group = group};
    return find_share(cells, place_of(&wanted, 0, false)) < cells->count;
}

typedef enum Below { NOTHING, ITSELF, OTHER } Below;

/* What of matter is in a cell: a body's own before others'. */
static Below below_of(Cells *cells, const int32_t cell[3], uint32_t body)
{
    const Share wanted = {.cell = {cell[0], cell[1], cell[2]}};
    const uint64_t place = place_of(&wanted, 0, false);
    Below below = NOTHING;
    for (uint32_t i = first_from(cells, place); i < cells->count && cells->share[i].place >> GROUP_BITS == place >> GROUP_BITS; i++) {
        if (body_of(cells, i) == body) return ITSELF;
        below = OTHER;
    }
    return below;
}

/* Cells of free way along gravity's axis from the end of a body until other matter or an obstacle; infinitely many if there is none within FAR, and negative
 * where the body goes on below. Tells if it is matter. */
static double drop_of(const World *world, Cells *cells, uint32_t bottom, int axis, bool *on_matter)
{
    enum { FAR = 256 };
    const Share *share = &cells->share[bottom];
    const int way = world->settings.gravity[axis] > 0.0f ? 1 : -1;
    const uint32_t body = body_of(cells, bottom);
    int32_t cell[3] = {share->cell[0], share->cell[1], share->cell[2]};
    double along[3] = {0};
    along[axis] = way;
    const double room = fmax(0.0, cells_to_obstacle(world, share, along, FAR) - 0.5); /* matter reaches to the end of its cell */
    for (int step = 0; step < FAR && step <= room; step++) {
        cell[axis] += way;
        const Below below = below_of(cells, cell, body);
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

/* Whether its own matter ends there, whatever lies beside it. */
static bool is_end(const Cells *cells, const Share *share, int axis, int way)
{
    int32_t next[3] = {share->cell[0], share->cell[1], share->cell[2]};
    next[axis] += way;
    return !any_of_group(cells, next, share->group);
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

/* Sorted by cell, bodies are found. */
static void measure_drops(const World *world, Cells *cells, int axis, uint32_t slot, Heap *heap)
{
    const int way = world->settings.gravity[axis] > 0.0f ? 1 : -1;
    double drops[2 * LOOKED_AT], resting[2 * LOOKED_AT]; /* of all; and of what does not fall yet, where nothing below is infinitely far */
    uint32_t number = 0, count = 0, rests = 0, ends = 0;
    for (uint32_t i = 0; i < cells->count; i++) ends += cells->share[i].group == slot + 1 && is_end(cells, &cells->share[i], axis, way);
    const uint32_t stride = 1 + ends / (2 * LOOKED_AT); /* of ends, not of cells: under deep matter they are few, and a hole is measured by them */
    for (uint32_t i = 0; i < cells->count && count < 2 * LOOKED_AT; i++) {
        if (cells->share[i].group != slot + 1 || !is_end(cells, &cells->share[i], axis, way) || number++ % stride != 0) continue;
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

/* Whether matter, or an obstacle, lies within two cells of a share along an axis; `bodies`: other solids than sand alone. Sorted by cell. */
static bool is_beside(const World *world, const Cells *cells, const Share *share, int axis, int way, bool bodies)
{
    enum { NEAR = 2 };
    int32_t cell[3] = {share->cell[0], share->cell[1], share->cell[2]};
    double along[3] = {0};
    bool found = false;
    along[axis] = way;
    for (int step = 0; step < NEAR && !found; step++) {
        cell[axis] += way;
        found = !bodies && filling_at(cells, cell) > 0.0;
        for (uint32_t other = 0; other < PBMPM_MAX_MATERIALS && bodies && !found; other++)
            found = other != share->slot && world->particles.of_material[other] > 0 && material_is_solid(&world->materials, other) &&
                    world->materials.def[other].kind != PBMPM_SAND && any_of_group(cells, cell, other + 1);
    }
    return found || (!bodies && cells_to_obstacle(world, share, along, NEAR) < INFINITY);
}

/* Sorted by cell. */
static bool does_hang(const World *world, const Cells *cells, int axis, uint32_t slot)
{
    const int down = world->settings.gravity[axis] > 0.0f ? 1 : -1;
    bool hangs = false;
    for (uint32_t i = 0; i < cells->count; i++) {
        const Share *share = &cells->share[i];
        if (share->group != slot + 1) continue;
        if (is_end(cells, share, axis, down) && is_beside(world, cells, share, axis, down, false)) return false;
        hangs = hangs || (is_end(cells, share, axis, -down) && is_beside(world, cells, share, axis, -down, true));
    }
    return hangs;
}

/* The share of a solid's upper side with liquid in its own cell or the one above, and no matter in the two above these. Sorted by cell. */
static void measure_film(const World *world, const Cells *cells, int axis, uint32_t slot, Heap *heap)
{
    const int up = world->settings.gravity[axis] > 0.0f ? -1 : 1;
    const uint32_t stride = stride_of(cells, slot);
    double tops = 0.0, filmed = 0.0;
    uint32_t number = 0;
    for (uint32_t i = 0; i < cells->count; i++) {
        const Share *share = &cells->share[i];
        if (share->group != slot + 1 || number++ % stride != 0 || !is_end(cells, share, axis, up)) continue;
        int32_t cell[3] = {share->cell[0], share->cell[1], share->cell[2]};
        bool wet = any_of_group(cells, cell, 0), free = true;
        cell[axis] += up;
        wet = wet || any_of_group(cells, cell, 0);
        for (int step = 0; step < 2; step++) {
            cell[axis] += up;
            free = free && filling_at(cells, cell) == 0.0;
        }
        tops += 1.0;
        filmed += wet && free;
    }
    if (tops > 0.0) heap->film = filmed / tops;
}

/* How far it goes down beside a cell, SIDE cells away, in a direction that falls more steeply than friction bears, by a cell, with no obstacle between: until matter or an
 * obstacle [cells]. 0 if there is no room, and where nothing is below. */
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
    if (cells_to_obstacle(world, top, along, length) < INFINITY || filling_at(cells, beside.cell) > 0.0) return 0.0;
    fall[axis] = world->settings.gravity[axis] > 0.0f ? 1.0 : -1.0;
    const double room = cells_to_obstacle(world, &beside, fall, FAR);
    int step = 0;
    for (; step < FAR && step < room && filling_at(cells, beside.cell) == 0.0; step++) beside.cell[axis] += (int32_t)fall[axis];
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
    for (next[axis] += way; filling_at(cells, next) > 0.0; next[axis] += way) last.cell[axis] = next[axis];
    return cells_to_obstacle(world, &last, along, GAP) < INFINITY;
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

/* Which share of the surface of what does not fall is too steep, and whether it is to both sides along any axis. Sorted by cell. */
static void measure_slopes(const World *world, const Cells *cells, int axis, uint32_t slot, Heap *heap)
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
        if (!is_end(cells, share, axis, up) || !is_borne(world, cells, share, axis)) continue;
        const unsigned found = steep_sides(world, cells, share, axis, down, &heap->slide);
        looked += 1.0;
        steep += found != 0;
        sides |= found;
    }
    if (looked > 0.0) heap->steep = steep / looked;
    for (int a = 0; a < world->def.dimension; a++) heap->falls_both_ways = heap->falls_both_ways || (sides >> domain_place(a, false) & 3) == 3;
}

/* ---- Balls in liquid ---- */

/* Whether nothing stands between the middle of a cell and that of a solid. */
static bool sees(const World *world, const Share *share, const Solid *solid)
{
    const double cell = (double)world->def.cell_size;
    double from[3] = {0}, along[3] = {0}, hit[3] = {0}, distance = 0.0;
    for (int a = 0; a < world->def.dimension; a++) {
        from[a] = middle_of(world, share, a);
        along[a] = solid->position[a] - from[a];
        distance += along[a] * along[a];
    }
    distance = sqrt(distance);
    for (int a = 0; a < world->def.dimension; a++) along[a] /= fmax(distance, 1e-300);
    const double way = fmin(distance, ray_to_obstacle(world, share->slot, from, along, distance));
    for (int a = 0; a < world->def.dimension; a++) hit[a] = from[a] + way * along[a];
    return solid_gap(solid, hit) < cell && ray_to_wall(world, from, along, way) == INFINITY;
}

/* Whether a ball or a capsule reaches below a cell of liquid that nothing parts from it: that flows around it, or will. *looks: lines that may still be followed. */
static bool is_ball_below(const World *world, const Cells *cells, const Solid *solid, int *looks)
{
    double lowest = 0.0, low[3] = {0}, high[3] = {0};
    if (solid->kind != PBMPM_SPHERE && solid->kind != PBMPM_CAPSULE) return false;
    solid_bounds(solid, low, high);
    for (int a = 0; a < world->def.dimension; a++) {
        const double pull = (double)world->settings.gravity[a];
        lowest -= pull * (pull > 0.0 ? high[a] : low[a]);
    }
    const uint32_t stride = 1 + cells->count / LOOKED_AT;
    for (uint32_t i = 0; i < cells->count && *looks > 0; i += stride) {
        double up = 0.0;
        for (int a = 0; a < world->def.dimension; a++) up -= (double)world->settings.gravity[a] * middle_of(world, &cells->share[i], a);
        if (cells->share[i].group != 0 || up <= lowest) continue;
        if (sees(world, &cells->share[i], solid)) return true;
        (*looks)--;
    }
    return false;
}

/* Whether no liquid is within two cells of it. `distances`: how many more may be measured; without any it counts as wet. */
static bool is_dry(const World *world, const Cells *cells, const Solid *solid, uint32_t *distances)
{
    for (uint32_t i = 0; i < cells->count; i++) {
        if (cells->share[i].group != 0) continue;
        if (*distances == 0) return false;
        (*distances)--;
        double point[3] = {0};
        for (int a = 0; a < world->def.dimension; a++) point[a] = middle_of(world, &cells->share[i], a);
        if (solid_gap(solid, point) < 2.0 * (double)world->def.cell_size) return false;
    }
    return true;
}

/* Rigid bodies are left out: they float. */
static void look_at_balls(const World *world, const Cells *cells, Survey *survey)
{
    enum { LOOKS = 256 };
    int looks = LOOKS;
    uint32_t distances = 1 << 16;
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *collider = &world->colliders.slot[c];
        if (!world_feels(world, collider) || (collider->def.kinematic && collider->def.measures_impulse)) continue;
        const Solid solid = solid_among(&collider->shape, world->def.dimension, &world->baked);
        if (!is_ball_below(world, cells, &solid, &looks)) continue;
        survey->ball_below = true;
        survey->ball_dry = survey->ball_dry || is_dry(world, cells, &solid, &distances);
    }
}

/* ---- What is round, what tips ---- */

typedef struct Extent {
    uint64_t particles;
    double mean[3], square, most; /* of particles [cells] */
    double foot[3], feet;         /* sum over the cells that something holds up, and their number */
    double lever;                 /* see Heap */
} Extent;

/* A ball's farthest point is 1.29 as far from its middle as the root of its mean square distance, a disc's 1.41, a cylinder's as long as it is wide 1.55; that of a cube or a square 1.73. */
static const double ROUNDEST = 1.6;

/* Sorted by cell, bodies are found. Most particles lie in the cell of the one before. */
static void measure_extents(const World *world, Cells *cells, Extent *extent)
{
    const Particles *p = &world->particles;
    uint32_t found = cells->count;
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t row = 0; row < p->count; row++) {
            const uint32_t slot = p->material[row];
            Share share = {.group = slot + 1};
            if (!material_is_solid(&world->materials, slot) || !near_first(p, row, share.cell)) continue;
            const uint64_t place = place_of(&share, 0, false);
            if (found == cells->count || cells->share[found].place != place) found = find_share(cells, place);
            if (found == cells->count) continue;
            Extent *of = &extent[body_of(cells, found)];
            double square = 0.0;
            of->particles += pass == 0;
            for (int a = 0; a < p->dimension; a++) {
                const double at = particles_coordinate(p, row, a);
                if (pass == 0) of->mean[a] += at;
                else square += (at - of->mean[a] / (double)of->particles) * (at - of->mean[a] / (double)of->particles);
            }
            of->square += square;
            of->most = fmax(of->most, square);
        }
}

static bool is_round(const Extent *of) { return of->most * (double)of->particles < ROUNDEST * ROUNDEST * of->square; }

/* Whether an obstacle is within two cells of where a solid ends, in a direction of the grid, or other matter below. */
static bool is_held(const World *world, Cells *cells, uint32_t i, int down)
{
    enum { GAP = 2 };
    const Share *share = &cells->share[i];
    for (int a = 0; a < cells->dimension; a++)
        for (int way = -1; way <= 1; way += 2) {
            int32_t next[3] = {share->cell[0], share->cell[1], share->cell[2]};
            double along[3] = {0};
            if (!is_end(cells, share, a, way)) continue;
            along[a] = way;
            if (cells_to_obstacle(world, share, along, GAP) < INFINITY) return true;
            const bool below = a == down && (way > 0) == (world->settings.gravity[a] > 0.0f);
            for (int step = 0; step < GAP && below; step++) {
                next[a] += way;
                if (below_of(cells, next, body_of(cells, i)) == OTHER) return true;
            }
        }
    return false;
}

/* From what holds a share to where its body's weight is, across gravity [cells]. */
static void arm_of(const World *world, const Extent *of, const double foot[3], double arm[3])
{
    double along = 0.0, down[3];
    gravity_direction(world, down);
    for (int a = 0; a < world->def.dimension; a++) arm[a] = of->mean[a] / (double)of->particles - foot[a];
    for (int a = 0; a < world->def.dimension; a++) along += arm[a] * down[a];
    for (int a = 0; a < world->def.dimension; a++) arm[a] -= along * down[a];
}

/* By how much the weight of bodies lies beyond all that holds them, seen from its middle. */
static void measure_levers(const World *world, Cells *cells, int down, Extent *extent)
{
    const double cell = (double)world->def.cell_size;
    for (int pass = 0; pass < 2; pass++)
        for (uint32_t i = 0; i < cells->count; i++) {
            Share *share = &cells->share[i];
            const bool elastic = share->group > 0 && world->materials.def[share->slot].kind == PBMPM_ELASTIC;
            Extent *of = &extent[elastic ? body_of(cells, i) : i];
            if (pass == 0) share->held = elastic && is_held(world, cells, i, down);
            if (!share->held || of->particles == 0) continue;
            double foot[3] = {0}, middle[3] = {0}, arm[3] = {0}, out[3] = {0}, length = 0.0, lever = 0.0;
            for (int a = 0; a < cells->dimension; a++) foot[a] = middle_of(world, share, a) / cell;
            if (pass == 0) {
                for (int a = 0; a < cells->dimension; a++) of->foot[a] += foot[a];
                of->feet += 1.0;
                of->lever = INFINITY;
                continue;
            }
            for (int a = 0; a < cells->dimension; a++) middle[a] = of->foot[a] / of->feet;
            arm_of(world, of, middle, out);
            arm_of(world, of, foot, arm);
            for (int a = 0; a < cells->dimension; a++) {
                length += out[a] * out[a];
                lever += arm[a] * out[a];
            }
            of->lever = fmin(of->lever, length > 0.0 ? lever / sqrt(length) : 0.0);
        }
}

static pbmpm_result look_at_bodies(World *world, Cells *cells, Survey *survey)
{
    const size_t bytes = cells->count * sizeof(Extent);
    Extent *extent = memory_take(&world->memory, bytes);
    if (!extent) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory to look at %u bodies", cells->count);
    for (uint32_t i = 0; i < cells->count; i++) extent[i] = (Extent){0};
    measure_extents(world, cells, extent);
    if (survey_axis_of_gravity(world) >= 0) measure_levers(world, cells, survey_axis_of_gravity(world), extent);
    double round[PBMPM_MAX_MATERIALS] = {0};
    for (uint32_t i = 0; i < cells->count; i++) {
        const Extent *of = &extent[i];
        Heap *heap = &survey->heap[cells->share[i].slot];
        if (of->particles == 0) continue;
        if (is_round(of)) round[cells->share[i].slot] += (double)of->particles;
        else if (of->feet > 0.0 && of->lever > 0.0) heap->lever = heap->lever > 0.0 ? fmin(heap->lever, of->lever) : of->lever;
    }
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) survey->heap[slot].round = round[slot] > 0.5 * survey->heap[slot].particles;
    memory_give(&world->memory, extent, bytes);
    return PBMPM_OK;
}

/* ---- Particles ---- */

/* The least and the largest singular value of F, from F^T F: its characteristic polynomial has three real roots (2D: two). */
static void stretches(const Particles *p, uint32_t row, double *least, double *most)
{
    double c[3][3] = {{0}};
    const int d = p->dimension;
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++)
            for (int k = 0; k < d; k++) c[i][j] += (double)p->deformation[k * 3 + i][row] * (double)p->deformation[k * 3 + j][row];
    double mean = 0.0, spread = 0.0;
    for (int i = 0; i < d; i++) mean += c[i][i] / d;
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++) spread += (c[i][j] - (i == j ? mean : 0.0)) * (c[i][j] - (i == j ? mean : 0.0));
    const double radius = sqrt(spread / (d * (d - 1))); /* eigenvalues are mean + 2 r cos(angle), in 2D mean +- r */
    double high = mean + radius, low = mean - radius;
    if (d == 3 && radius > 0.0) {
        for (int i = 0; i < 3; i++) c[i][i] -= mean;
        const double determinant = c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1]) - c[0][1] * (c[1][0] * c[2][2] - c[1][2] * c[2][0]) +
                                   c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0]);
        const double angle = acos(fmax(-1.0, fmin(1.0, 0.5 * determinant / (radius * radius * radius)))) / 3.0;
        high = mean + 2.0 * radius * cos(angle);
        low = mean + 2.0 * radius * cos(angle + 2.0 * 3.14159265358979 / 3.0);
    }
    *least = sqrt(fmax(low, 0.0));
    *most = sqrt(fmax(high, 0.0));
}

/* Strain is cut off at the bounds once per substep, and a little moves it away again. */
static bool is_clamped(const World *world, uint32_t row)
{
    const pbmpm_material_def *def = &world->materials.def[world->particles.material[row]];
    double least, most;
    stretches(&world->particles, row, &least, &most);
    return least < 1.05 * (double)def->strain_min || most > 0.95 * (double)def->strain_max;
}

static void look_at_particles(const World *world, Survey *survey)
{
    const Particles *p = &world->particles;
    for (uint32_t row = 0; row < p->count; row++) {
        Heap *heap = &survey->heap[p->material[row]];
        double speed2 = 0.0;
        for (int a = 0; a < p->dimension; a++) speed2 += (double)p->velocity[a][row] * (double)p->velocity[a][row];
        heap->particles++;
        heap->moves += speed2;
        heap->speed = fmax(heap->speed, sqrt(speed2));
        if (material_is_solid(&world->materials, p->material[row]) && is_clamped(world, row)) heap->clamped += 1.0;
    }
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        Heap *heap = &survey->heap[slot];
        if (heap->particles == 0) continue;
        heap->moves = sqrt(heap->moves / heap->particles);
        heap->clamped /= heap->particles;
    }
}

/* Whether the particle's way leads where liquid is, for a body, or a body, for a liquid, within AHEAD cells. Sorted by cell. */
static bool is_meeting(const World *world, const Cells *cells, uint32_t row, double speed)
{
    enum { AHEAD = 4 };
    const Particles *p = &world->particles;
    const bool flows = !material_is_solid(&world->materials, p->material[row]);
    int32_t first[3] = {0};
    if (!near_first(p, row, first)) return false;
    for (int step = 1; step <= AHEAD; step++) {
        Share ahead = {.group = 0};
        for (int a = 0; a < p->dimension; a++) ahead.cell[a] = first[a] + (int32_t)floor(step * (double)p->velocity[a][row] / speed + 0.5);
        const uint64_t place = place_of(&ahead, 0, false);
        for (uint32_t i = first_from(cells, place); i < cells->count && cells->share[i].place >> GROUP_BITS == place >> GROUP_BITS; i++)
            if (flows != (cells->share[i].group == 0) && world->materials.def[cells->share[i].slot].kind != PBMPM_SAND) return true;
    }
    return false;
}

/* Of those that are faster than any that was found to meet so far; some may be passed over where many are. */
static double fastest_meeting(const World *world, const Cells *cells)
{
    enum { MOST = 1 << 14 };
    const Particles *p = &world->particles;
    const uint32_t stride = 1 + p->count / MOST;
    double fastest = 0.0;
    for (uint32_t row = 0; row < p->count; row += stride) {
        double speed2 = 0.0;
        for (int a = 0; a < p->dimension; a++) speed2 += (double)p->velocity[a][row] * (double)p->velocity[a][row];
        if (speed2 <= fastest * fastest || world->materials.def[p->material[row]].kind == PBMPM_SAND) continue;
        if (is_meeting(world, cells, row, sqrt(speed2))) fastest = sqrt(speed2);
    }
    return fastest;
}

static bool any_liquid(const World *world)
{
    bool liquid = false;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) liquid = liquid || (world->materials.generation[slot] != 0 && world->materials.def[slot].kind == PBMPM_LIQUID);
    return liquid;
}

/* Whether solids are there, and a liquid may come to them: else it is no matter how near walls are, and no sort is spent on it. */
static bool may_float(const World *world, const Cells *cells)
{
    bool solid = false;
    for (uint32_t i = 0; i < cells->count && !solid; i++) solid = cells->share[i].group > 0;
    return solid && any_liquid(world);
}

/* A body is as thick as its thickest part, but for noise: what counts is a mean that leans that far to it. */
static const double THICKEST = 4.0;

static void look_at_cells(const World *world, Cells *cells, Survey *survey)
{
    double runs[3][PBMPM_MAX_MATERIALS + 1], filling[PBMPM_MAX_MATERIALS + 1] = {0}, overlapping[PBMPM_MAX_MATERIALS + 1] = {0}, thickness[PBMPM_MAX_MATERIALS + 1] = {0};
    double weight[PBMPM_MAX_MATERIALS + 1] = {0}, narrow[PBMPM_MAX_MATERIALS + 1], error[PBMPM_MAX_MATERIALS + 1];
    const int down = survey_axis_of_gravity(world);
    const bool floats = may_float(world, cells);
    for (int group = 0; group <= PBMPM_MAX_MATERIALS; group++) narrow[group] = floats ? 1.0 : 0.0;
    for (int a = 0; a < cells->dimension && floats; a++)
        if (a != down) measure_room(world, cells, a, narrow);
    for (int a = 0; a < cells->dimension; a++) measure_runs(cells, a, runs[a]);
    double pull[3], uneven = 0.0;
    gravity_direction(world, pull);
    if (down >= 0 && any_liquid(world)) uneven = measure_level(world, cells, down, pull);
    measure_filling(cells, filling, error);
    if (world->step_count == 0) measure_overlaps(cells, overlapping);
    look_at_balls(world, cells, survey);
    if (floats) survey->meets = fastest_meeting(world, cells);
    find_bodies(cells);
    for (uint32_t slot = 0; down >= 0 && slot < PBMPM_MAX_MATERIALS; slot++) {
        Heap *heap = &survey->heap[slot];
        if (heap->particles == 0 || !material_is_solid(&world->materials, slot)) continue;
        measure_drops(world, cells, down, slot, heap);
        if (world->materials.def[slot].kind == PBMPM_SAND) measure_slopes(world, cells, down, slot, heap);
        else heap->hangs = does_hang(world, cells, down, slot);
        if (floats && world->materials.def[slot].kind != PBMPM_SAND) measure_film(world, cells, down, slot, heap);
    }
    for (uint32_t i = 0; i < cells->count; i++) {
        const double part = cells->share[i].filling * pow(cells->share[i].thickness, THICKEST);
        thickness[cells->share[i].group] += part * cells->share[i].thickness;
        weight[cells->share[i].group] += part;
    }
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (survey->heap[slot].particles == 0) continue;
        const uint32_t group = material_is_solid(&world->materials, slot) ? slot + 1 : 0;
        survey->heap[slot].depth = down < 0 ? 0.0 : runs[down][group];
        survey->heap[slot].width = INFINITY;
        for (int a = 0; a < cells->dimension; a++)
            if (a != down) survey->heap[slot].width = fmin(survey->heap[slot].width, runs[a][group]);
        survey->heap[slot].uneven = group == 0 ? uneven : 0.0;
        survey->heap[slot].filling = filling[group];
        survey->heap[slot].filling_error = error[group];
        survey->heap[slot].overlapping = overlapping[group];
        survey->heap[slot].narrow = group > 0 ? narrow[group] : 0.0;
        if (weight[group] > 0.0) survey->heap[slot].thickness = thickness[group] / weight[group];
    }
}

pbmpm_result survey_make(World *world, Survey *survey)
{
    *survey = (Survey){0};
    const size_t bytes = world->particles.count * sizeof(Share);
    if (bytes == 0) return PBMPM_OK;
    Cells cells = {.share = memory_take(&world->memory, bytes), .dimension = world->def.dimension};
    if (!cells.share) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory to look at %u particles", world->particles.count);
    look_at_particles(world, survey);
    find_cells(world, &cells);
    look_at_cells(world, &cells, survey);
    const pbmpm_result found = look_at_bodies(world, &cells, survey);
    memory_give(&world->memory, cells.share, bytes);
    return found;
}
