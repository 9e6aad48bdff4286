/* What a survey asks of the cells, each in a file of its own. Here for survey.c alone. */
#ifndef PBMPM_SRC_SERVICES_SURVEY_PARTS_H
#define PBMPM_SRC_SERVICES_SURVEY_PARTS_H

#include "services/survey_cells.h"
#include "services/survey_heap.h"

/* Thicknesses along an axis, and each group's mean length of run, weighted by what is in it. */
void survey_runs(Cells *cells, int axis, double mean[PBMPM_MAX_MATERIALS + 1]);

/* How far the surface of liquids is from level. Columns end where their last cell is filled to, if no obstacle is there:
 * under a wall that leans they end below the surface. Thin ones may be spray. */
double survey_level(const World *world, Cells *cells, int axis, const double down[3]);

/* Which share of what holds liquids up leans against gravity's axis. Sorted by cell. */
double survey_leaning(const World *world, const Cells *cells, int axis);

/* Which share of each solid stands between obstacles along an axis. */
void survey_room(const World *world, Cells *cells, int axis, double narrow[PBMPM_MAX_MATERIALS + 1]);

/* Means over the cells inside, and how well they are known: their standard errors, as if cells were filled by chance. */
void survey_filling(Cells *cells, double filling[PBMPM_MAX_MATERIALS + 1], double error[PBMPM_MAX_MATERIALS + 1]);

/* Shares of groups that lie in cells with too much matter. Sorted by cell. */
void survey_overlaps(const Cells *cells, double overlapping[PBMPM_MAX_MATERIALS + 1]);

/* How far a solid falls, and the width of holes below it. Sorted by cell, bodies are found. */
void survey_drops(const World *world, Cells *cells, int axis, uint32_t slot, Heap *heap);

/* Whether nothing bears one of a solid's bodies, and another body is close above it. Sorted by cell, bodies are found. */
bool survey_hangs(const World *world, Cells *cells, int axis, uint32_t slot);

/* Whether each of a solid's bodies lies on an obstacle. Sorted by cell, bodies are found. */
bool survey_lies(const World *world, Cells *cells, int axis, uint32_t slot);

/* The share of a solid's upper side with liquid in its own cell or the one above, and no matter in the two above these. Sorted by cell. */
void survey_film(const World *world, const Cells *cells, int axis, uint32_t slot, Heap *heap);

/* Which share of the surface of what does not fall is too steep, and whether it is to both sides along any axis. Sorted by cell. */
void survey_slopes(const World *world, const Cells *cells, int axis, uint32_t slot, Heap *heap);

/* Which solids are round, and how far their weight lies beyond what holds them. `down`: the axis of gravity, or -1. Sorted by cell, bodies are found. */
pbmpm_result survey_bodies(World *world, Cells *cells, int down, Survey *survey);

#endif
