/* How long, wide and level matter is, how much room it has, and how full its cells are. */
#include "services/survey_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

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

void survey_runs(Cells *cells, int axis, double mean[PBMPM_MAX_MATERIALS + 1])
{
    double weight[PBMPM_MAX_MATERIALS + 1] = {0};
    memset(mean, 0, (PBMPM_MAX_MATERIALS + 1) * sizeof *mean);
    survey_sort_along(cells, axis, true);
    for (uint32_t first = 0, count; first < cells->count; first += count) {
        Share *run = &cells->share[first];
        count = survey_run_from(cells, first);
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

enum { ROOM = 5 }; /* cells beside a run in which an obstacle counts as near */

double survey_level(const World *world, Cells *cells, int axis, const double down[3])
{
    enum { COLUMN = 3, FREE = 2 };
    const int up = down[axis] > 0.0 ? -1 : 1;
    double sum = 0.0, square = 0.0, columns = 0.0, along[3] = {0};
    uint32_t runs = 0, number = 0;
    along[axis] = up;
    survey_sort_along(cells, axis, true);
    for (uint32_t first = 0; first < cells->count; first += survey_run_from(cells, first)) runs += cells->share[first].group == 0;
    const uint32_t stride = 1 + runs / LOOKED_AT;
    for (uint32_t first = 0, count; first < cells->count; first += count) {
        const Share *run = &cells->share[first];
        count = survey_run_from(cells, first);
        if (run->group != 0 || count < COLUMN || number++ % stride != 0) continue;
        const Share *top = up > 0 ? &run[count - 1] : run, *inside = &run[count / 2]; /* the middle of the top may lie beyond a thin wall */
        const double to_top = abs(top->cell[axis] - inside->cell[axis]);
        double height = 0.0;
        if (survey_cells_to_obstacle(world, inside, along, to_top + FREE) < INFINITY) continue;
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
    return survey_cells_to_obstacle(world, end, along, ROOM - 0.5) < INFINITY;
}

void survey_room(const World *world, Cells *cells, int axis, double narrow[PBMPM_MAX_MATERIALS + 1])
{
    double all[PBMPM_MAX_MATERIALS + 1] = {0}, shut[PBMPM_MAX_MATERIALS + 1] = {0};
    uint32_t runs = 0, number = 0;
    survey_sort_along(cells, axis, true);
    for (uint32_t first = 0; first < cells->count; first += survey_run_from(cells, first)) runs += cells->share[first].group > 0;
    const uint32_t stride = 1 + runs / LOOKED_AT;
    for (uint32_t first = 0, count; first < cells->count; first += count) {
        const Share *run = &cells->share[first];
        count = survey_run_from(cells, first);
        if (run->group == 0 || number++ % stride != 0) continue;
        all[run->group] += count;
        if (is_shut(world, run, axis, -1) && is_shut(world, run + count - 1, axis, 1)) shut[run->group] += count;
    }
    for (int group = 1; group <= PBMPM_MAX_MATERIALS; group++) narrow[group] = all[group] > 0.0 ? fmin(narrow[group], shut[group] / all[group]) : 0.0;
}

/* ---- Crowding ---- */

/* A cell is inside if matter is in all next to it: walls and surfaces leave room there that nobody else takes. */
static bool is_inside(const Cells *cells, const Share *share)
{
    for (int a = 0; a < cells->dimension; a++)
        for (int step = -1; step <= 1; step += 2) {
            int32_t cell[3] = {share->cell[0], share->cell[1], share->cell[2]};
            cell[a] += step;
            if (survey_filling_at(cells, cell) == 0.0) return false;
        }
    return true;
}

enum { FEW = 8 }; /* cells: fewer inside make no mean */

void survey_filling(Cells *cells, double filling[PBMPM_MAX_MATERIALS + 1], double error[PBMPM_MAX_MATERIALS + 1])
{
    uint32_t inside[PBMPM_MAX_MATERIALS + 1] = {0};
    double square[PBMPM_MAX_MATERIALS + 1] = {0};
    survey_sort_along(cells, 0, false);
    for (uint32_t i = 0; i < cells->count; i++) {
        const Share *share = &cells->share[i];
        const double all = survey_filling_at(cells, share->cell);
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
    double sum = 2.0 * survey_filling_at(cells, share->cell);
    for (int a = 0; a < cells->dimension; a++)
        for (int step = -1; step <= 1; step += 2) {
            int32_t cell[3] = {share->cell[0], share->cell[1], share->cell[2]};
            cell[a] += step;
            sum += survey_filling_at(cells, cell);
        }
    return sum > TOO_FULL * (2.0 + 2.0 * cells->dimension);
}

void survey_overlaps(const Cells *cells, double overlapping[PBMPM_MAX_MATERIALS + 1])
{
    double volume[PBMPM_MAX_MATERIALS + 1] = {0};
    for (uint32_t i = 0; i < cells->count; i++) {
        const Share *share = &cells->share[i];
        volume[share->group] += share->filling;
        if (is_too_full(cells, share)) overlapping[share->group] += share->filling;
    }
    for (int group = 0; group <= PBMPM_MAX_MATERIALS; group++) overlapping[group] /= fmax(volume[group], 1e-300);
}
