/* What the rules of advice share: what is asked about, what is there, what helps and its price. */
#ifndef PBMPM_SRC_SERVICES_ADVISER_H
#define PBMPM_SRC_SERVICES_ADVISER_H

#include "pbmpm/advice.h"
#include "services/survey.h"
#include "world/world.h"

typedef struct Adviser {
    World *world;
    Substep substep; /* that is asked about */
    Survey survey;
    pbmpm_advice *array;
    uint32_t capacity, count;
} Adviser;

void adviser_give(Adviser *adviser, pbmpm_advice advice);

/* ---- What helps, and its price ---- */

static const float UNKNOWN_PRICE = -1.0f;

/* Sets the change that helps, to `factor` times what there is now, and its price. Nothing is set where that is out of reach. */
void adviser_by_substeps(const Adviser *adviser, double factor, pbmpm_advice *advice);
void adviser_by_iterations(const Adviser *adviser, double factor, pbmpm_advice *advice);
void adviser_by_cells(const Adviser *adviser, double factor, pbmpm_advice *advice);
void adviser_by_value(pbmpm_change change, double value, double price, pbmpm_advice *advice);

/* ---- What is there ---- */

/* Whether there is, or will be, matter of a material, or of a kind. */
bool adviser_present(const World *world, uint32_t slot);
bool adviser_any_present(const World *world, pbmpm_material_kind kind);

static inline bool adviser_flows(const pbmpm_material_def *def) { return def->kind == PBMPM_LIQUID; }

/* Whether any liquid is denser than a body. */
bool adviser_floats(const World *world, const pbmpm_material_def *body);

/* Which solver bears the weight of a material; whether one may have it, or any matter. */
pbmpm_solver adviser_solver_of(const World *world, uint32_t slot);
bool adviser_may_solve(const World *world, uint32_t slot, pbmpm_solver solver);
bool adviser_any_solved_with(const World *world, pbmpm_solver solver);

pbmpm_effective adviser_held_of(const Adviser *adviser, uint32_t slot);
pbmpm_material_id adviser_id_of(const World *world, uint32_t slot);

/* Whether an obstacle stands below a point. */
bool adviser_lands(const World *world, uint32_t material, const double from[3]);

/* What is hardly resolved: g dt^2 / dx [cells], per substep for liquid, per step for rigid bodies, which move once in it. By trial: a crate rocks on sand at 0.027 and rests at 0.007; water that fell over a ball goes on moving at 0.055 and calms
 * down at 0.014 (tests/field/run.py rigid_on_sand splash --settings 60x5,120x5,240x5). */
static const double COARSE_FALL = 0.02;

/* A speed [m/s] in cells per substep. */
double adviser_cells(const Adviser *adviser, double speed);

/* The fastest landing of what emitters bring of a material, on obstacles and walls [cells per substep]. */
double adviser_emitted_landing(const Adviser *adviser, uint32_t slot);

/* A wall of the domain where gravity leads, or NULL. */
const pbmpm_domain_wall *adviser_wall_below(const World *world);

/* Whether any obstacle holds matter that it touches. */
bool adviser_any_sticks(const World *world);

#endif
