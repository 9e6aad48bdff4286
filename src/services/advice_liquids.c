#include "services/advice_rules.h"

#include <math.h>

#include "world/depth.h"

/* Strain at the bottom that nobody sees; of a column that is half as much. */
static const double STRAIN_UNSEEN = 0.1;

void advise_pool_too_deep(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        const pbmpm_solver solver = adviser_solver_of(world, slot);
        const double depth = adviser->survey.heap[slot].depth;
        if (depth == 0.0 || !adviser_flows(def) || (solver != PBMPM_SOLVER_PAPER && solver != PBMPM_SOLVER_DUAL)) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_POOL_TOO_DEEP, .material = adviser_id_of(world, slot)};
        double figure = gravity_fall(world, &adviser->substep) * depth, bound = DEEPEST;
        advice.text = "the pool is too deep for the rate: it is compressed by its weight";
        if (solver == PBMPM_SOLVER_PAPER) {
            const double bulk = (double)adviser_held_of(adviser, slot).bulk_modulus;
            figure = (double)def->density * gravity_strength(world) * depth * (double)world->def.cell_size / bulk;
            bound = STRAIN_UNSEEN;
            advice.text = "the paper's solver is as stiff as rate and iterations make it: the pool is compressed by its weight";
        }
        if (figure <= bound) continue;
        advice.figure = (float)figure;
        advice.bound = (float)bound;
        if (solver == PBMPM_SOLVER_PAPER)
            adviser_by_value(PBMPM_CHANGE_SOLVER, PBMPM_SOLVER_CONVERGENT, (double)UNKNOWN_PRICE, &advice);
        else
            adviser_by_substeps(adviser, sqrt(figure / bound), &advice);
        adviser_give(adviser, advice);
    }
}

/* What is missing from the pressure of a step stirs a pool: its rms speed is about STILL f^2 cells per substep, with f = g dt^2 depth / dx^2, at five iterations or more.
 * Pools of 12 to 36 cells of 1.25 to 5 cm between level and upright walls, on and off the grid, at 60 Hz x 5: 0.0010 to 0.0016 of it up to f = 4, in 3D 0.0002 to 0.0007 of
 * it up to 2.6. Fewer iterations stir more, in proportion. Around what stands in the water, and bulges, pools of 12 cells have 0.0017 to 0.039 of it, ten of thirteen less than AROUND
 * (tests/field/run.py furnished_pool creased_floor ball_in_pool still_pool deep_pool --settings 60x5). Liquids that store energy have no eddy damping and count as such. */
static const double STILL = 0.0015, STILL_3D = 0.0007, AROUND = 0.012, CALM_SPEED = 0.01, CALM_ITERATIONS = 5.0;

void advise_pool_stirs(Adviser *adviser)
{
    const World *world = adviser->world;
    const double cell_speed = (double)world->def.cell_size / adviser->substep.dt, few = fmax(1.0, CALM_ITERATIONS / world->settings.iterations);
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        const double fall = gravity_fall(world, &adviser->substep) * adviser->survey.heap[slot].depth;
        const bool around = adviser->survey.obstructed;
        const double share = around || def->bulk_modulus > 0.0f ? AROUND : world->def.dimension == 2 ? STILL : STILL_3D;
        const double speed = share * few * fall * fall * cell_speed;
        if (!adviser_flows(def) || adviser_solver_of(world, slot) != PBMPM_SOLVER_DUAL || speed <= CALM_SPEED) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_POOL_STIRS, .material = adviser_id_of(world, slot), .figure = (float)speed, .bound = (float)CALM_SPEED,
                               .text = around ? "water goes on moving around what stands in it, at this rate"
                                              : "a pool this deep goes on circling slowly at this rate"};
        adviser_by_substeps(adviser, pow(speed / CALM_SPEED, 1.0 / 3.0), &advice); /* f falls with the square of the rate */
        adviser_give(adviser, advice);
    }
}
