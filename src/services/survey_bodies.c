/* Which bodies are round, and which tip. */
#include "services/survey_parts.h"

#include <math.h>

#include "base/result.h"
#include "world/depth.h"

typedef struct Extent {
    uint64_t particles;
    double mean[3], square, most; /* of particles [cells] */
    double foot[3], feet;         /* sum over the cells that something holds up, and their number */
    double lever;                 /* see Heap */
} Extent;

/* A ball's farthest point is 1.29 as far from its middle as the root of its mean square distance,
 * a disc's 1.41, a cylinder's as long as it is wide 1.55; that of a cube or a square 1.73. */
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
            if (!material_is_solid(&world->materials, slot) || !survey_near_first(p, row, share.cell)) continue;
            const uint64_t place = survey_place_of(&share, 0, false);
            if (found == cells->count || cells->share[found].place != place) found = survey_find_share(cells, place);
            if (found == cells->count) continue;
            Extent *of = &extent[survey_body_of(cells, found)];
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
            if (!survey_group_ends(cells, share, a, way)) continue;
            along[a] = way;
            if (survey_cells_to_obstacle(world, share, along, GAP) < INFINITY) return true;
            const bool below = a == down && (way > 0) == (world->settings.gravity[a] > 0.0f);
            for (int step = 0; step < GAP && below; step++) {
                next[a] += way;
                if (survey_below_of(cells, next, survey_body_of(cells, i)) == OTHER) return true;
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
            Extent *of = &extent[elastic ? survey_body_of(cells, i) : i];
            if (pass == 0) share->held = elastic && is_held(world, cells, i, down);
            if (!share->held || of->particles == 0) continue;
            double foot[3] = {0}, middle[3] = {0}, arm[3] = {0}, out[3] = {0}, length = 0.0, lever = 0.0;
            for (int a = 0; a < cells->dimension; a++) foot[a] = survey_middle_of(world, share, a) / cell;
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

pbmpm_result survey_bodies(World *world, Cells *cells, int down, Survey *survey)
{
    const size_t bytes = cells->count * sizeof(Extent);
    Extent *extent = memory_take(&world->memory, bytes);
    if (!extent) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory to look at %u bodies", cells->count);
    for (uint32_t i = 0; i < cells->count; i++) extent[i] = (Extent){0};
    measure_extents(world, cells, extent);
    if (down >= 0) measure_levers(world, cells, down, extent);
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
