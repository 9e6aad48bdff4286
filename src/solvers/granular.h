/* Sand of the convergent solver: which of two solvers it is solved with.
 *
 * Sand that rests: the primal solver. Its grains store strain, so what bears the heap is known exactly, whatever a few iterations leave: a pile stays. But
 * the friction of a substep is that of the pressure at its start: sand that flows through an outlet jams.
 * Sand that flows: the dual solver, see ispc/granular.isph. Each iteration knows its friction. But what falls is crushed, and heaps creep.
 * (tests/field/run.py sand jelly_on_sand, 60 Hz and 240 Hz x 5, AVX2, 2026-11-26: 159 of 192 checks with --solver dual, 153 with primal, 182 with both.)
 *
 * Both keep the same state, so that either goes on from the other. F holds what grains bear: its shape the deviator, its determinant the pressure,
 * p = -K ln det F. J stands beside it and says the volume. `pressure` is p in pascals.
 *
 * The state is that of all sand of the islands with the same set of kinds. What sand does is measured against the speed v of a fall through one cell, v^2 = 2 g dx.
 * Blocks with few grains do not count. It begins at rest if no block moves at FALLS v.
 * It flows when a block moves at FALLS v, or when one has moved at CREEPS v for SLOW seconds longer than it has not, or when an obstacle, a wall of the domain or
 * a drain beside it came, went or changed (world/stirred.h). Without gravity sand that moves flows. In a world that is told to use the dual all sand does.
 * It rests when no block has moved at SETTLES v for SLOW seconds, counted alike. Sand by itself must have its volume back, too, but for MISSING_MOST, or gain no more: the dual
 * alone gives it back. A bed that the iterations do not hold at its depth would flow for ever.
 *
 * With the dual bodies sink into sand. So sand that they touch rests as soon as it is slow. Solids that the dual would hold softer than they are would spring up
 * when the primal takes over: the sand that touches them always rests. */
#ifndef PBMPM_SRC_SOLVERS_GRANULAR_H
#define PBMPM_SRC_SOLVERS_GRANULAR_H

#include "world/world.h"

/* Whether sand of the islands with these kinds flows in the next substep. Sand that touches liquid always does: the primal does not bear the depth of that. */
bool granular_flows(const World *world, uint32_t kinds);

/* Whether what the sand of these islands does is known from the substep before. */
bool granular_goes_on(const World *world);

/* Takes memory for the blocks of this substep and the pressures; before it is asked what flows. */
pbmpm_result granular_prepare(World *world);
void granular_free(World *world);

/* Points the kernel arguments at the pressures where the primal solves sand that may come to flow, and says what the dual starts from: the means of cells, and a
 * share of what a grain has beside them, which ends after FORGETS. Where sand begins to flow, what its grains bear is in balance; with means alone a bin sinks by
 * 1.4 % at 49 mm/s. Where it flows, what grains bear beside the means is noise that friction finds: a heap below a funnel has 13.7 degrees, not 18. */
void granular_bind(World *world);

/* After the particles have moved: what their sand does. */
void granular_judge(World *world);

#endif
