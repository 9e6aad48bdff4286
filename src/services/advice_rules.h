/* The rules of advice, by what they look at. Each gives what it finds. */
#ifndef PBMPM_SRC_SERVICES_ADVICE_RULES_H
#define PBMPM_SRC_SERVICES_ADVICE_RULES_H

#include "services/adviser.h"

/* Pressure has to reach the bottom of a pool: what N iterations do not bring there is missing from its volume. It costs volume beyond about 5 of
 * g dt^2 depth / dx^2, at 5 iterations (columns of 16 to 64 cells). */
static const double DEEPEST = 5.0;

/* Of the surface of sand: fewer places may be a corner. */
static const double STEEP = 0.1;

/* advice_scene.c: gravity, speed, emitters, what came true */
void advise_no_gravity(Adviser *adviser);
void advise_falls_forever(Adviser *adviser);
void advise_step_too_long(Adviser *adviser);
void advise_enters_bodies(Adviser *adviser);
void advise_slips(Adviser *adviser);
void advise_emitter_outside(Adviser *adviser);
void advise_emitter_refused(Adviser *adviser);
void advise_volume_lost(Adviser *adviser);
void advise_strain_clamped(Adviser *adviser);
void advise_not_solved(Adviser *adviser);
void advise_overlaps(Adviser *adviser);

/* advice_obstacles.c: speed, thickness, baked grids */
void advise_collider_too_fast(Adviser *adviser);
void advise_collider_too_thin(Adviser *adviser);
void advise_collider_too_coarse(Adviser *adviser);

/* advice_ignored.c: parameters that do nothing */
void advise_ignored_parameters(Adviser *adviser);

/* advice_liquids.c: pools */
void advise_pool_too_deep(Adviser *adviser);
void advise_pool_stirs(Adviser *adviser);
void advise_pool_moves(Adviser *adviser);
void advise_ball_stirs(Adviser *adviser);

/* advice_solids.c: bodies. Whether the iterations hold enough of a solid's modulus. */
bool advice_holds_modulus(const Adviser *adviser, uint32_t slot);
void advise_modulus_not_held(Adviser *adviser);
void advise_body_too_thin(Adviser *adviser);
void advise_bounce_damped(Adviser *adviser);
void advise_hit_damped(Adviser *adviser);
void advise_ball_damped(Adviser *adviser);
void advise_soft_bounce(Adviser *adviser);
void advise_rolling_braked(Adviser *adviser);

/* advice_sand.c: heaps */
void advise_sand_not_held(Adviser *adviser);
void advise_sand_lands(Adviser *adviser);
void advise_sand_slides(Adviser *adviser);
void advise_sand_runs(Adviser *adviser);
void advise_no_friction(Adviser *adviser);

/* advice_rigid.c: bodies that pbmpm_rigid_advance() moves */
void advise_rigid_thrown_off(Adviser *adviser);
void advise_rigid_on_sand(Adviser *adviser);
void advise_rigid_sinks(Adviser *adviser);
void advise_rigid_turns(Adviser *adviser);
void advise_rigid_glides(Adviser *adviser);
void advise_rigid_stays_down(Adviser *adviser);
void advise_rigid_enters(Adviser *adviser);

/* advice_limits.c: what no setting mends */
void advise_known_limits(Adviser *adviser);

#endif
