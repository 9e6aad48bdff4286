/* The ways to solve a substep, and a scene that all of them can run. */
#ifndef PBMPM_TESTS_API_SOLVERS_H
#define PBMPM_TESTS_API_SOLVERS_H

#include "scenes.h"

/** A choice of the settings that say how a substep is solved. */
typedef struct way {
    const char *name;
    pbmpm_solver solver;
    pbmpm_pressure pressure;
    pbmpm_integrator integrator;
    float flip;
} way;

enum { WAY_PAPER, WAY_DUAL }; /**< the first of `ways` */
extern const way ways[];
extern const int way_count;

/** Makes a world solve its substeps this way; rate and gravity stay. */
void use_way(pbmpm_world_id world, const way *chosen);

/** A soft liquid (bulk modulus 1e5 Pa) or elastic body (Young modulus 1e5 Pa), which the explicit solver can hold at 1/480 s
 *  on cells of 3 cm. */
pbmpm_material_def soft_material(pbmpm_material_kind kind);

/** A pool of water and, beside it, viscous oil in a closed tank, an elastic body that falls into it, and a paddle that stirs; more particles than are
 *  worth threads. */
stage stirred_pool(int32_t dimension, const way *chosen, scene_tweak *tweak, void *user);

/** Runs steps [from, to) of it, 1/120 s each. */
void stirred_pool_run(const stage *made, int from, int to);

#endif
