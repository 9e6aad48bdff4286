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

static const double CALM_SPEED = 0.01; /* [m/s] a fifth of a cell of 5 cm per second, which no eye sees */

/* What is missing from the pressure of a step stirs a pool. With f = g dt^2 depth / dx^2 its rms speed is about RESTS f cells per substep, or 0.0013 g dt per cell of depth:
 * pools of 6 to 48 cells of 1.25 to 10 cm behind upright walls off the grid have 0.0009 to 0.0025 of f, at 60 and 120 Hz, in 2D and 3D, with 2 to 20 iterations. Where gravity is
 * oblique to the grid, by 10, 20 and 45 degrees, it is 0.0018 to 0.019 of f (tests/field/run.py still_pool deep_pool --settings 60x5). Around steps, shelves, ridges and balls it is 0.0006
 * to 0.0014 in ten of sixteen pools and up to 0.018, which nobody foretells; advise_pool_moves() tells it.
 * On floors that lean or curve it is 0.006 to 0.033 of f in eight of ten pools, 0.016 in the median (145 pools of 4 to 16 cells in valleys of 5 to 30 degrees and on waves of terrain, six
 * seconds after they were filled; tests/field/run.py lake). With two substeps it is a tenth to a third.
 * Above SHALLOW the pressures of five iterations do not reach the bottom: the speed is about DEEP f^2, with 3 iterations four times as much, with 10 and 20 hardly more. */
static const double RESTS = 0.0013, OBLIQUE = 0.0045, LEANING = 0.016, SHALLOW = 3.0, DEEP = 0.0015, DEEP_ITERATIONS = 5.0;

/* Liquids that store energy have no eddy damping: that share of f^2 [cells per substep]; by trial. */
static const double STORES = 0.012;

/* Whether gravity pulls along no axis of the grid. */
static bool pulls_obliquely(const World *world)
{
    int axes = 0;
    for (int a = 0; a < world->def.dimension; a++) axes += world->settings.gravity[a] != 0.0f;
    return axes > 1;
}

/* The share of f at which a pool that is not too deep goes on. */
static double rests_at(const Adviser *adviser, uint32_t slot)
{
    static const double MUCH = 0.25; /* of the floor: in a pool of four cells one column is beside a wall */
    if (pulls_obliquely(adviser->world)) return OBLIQUE;
    return adviser->survey.heap[slot].leans > MUCH ? LEANING : RESTS;
}

/* The rms speed [m/s] that is foreseen where f falls by the square of `factor`, see above. */
static double stirring(const Adviser *adviser, uint32_t slot, double factor)
{
    const World *world = adviser->world;
    const double f = gravity_fall(world, &adviser->substep) * adviser->survey.heap[slot].depth / (factor * factor);
    const double cell_speed = factor * (double)world->def.cell_size / adviser->substep.dt, few = fmax(1.0, DEEP_ITERATIONS / world->settings.iterations);
    if (world->materials.def[slot].bulk_modulus > 0.0f) return STORES * f * f * cell_speed;
    const double rests = rests_at(adviser, slot) * f;
    return (f > SHALLOW ? fmax(rests, DEEP * few * few * f * f) : rests) * cell_speed;
}

/* What runs out does not rest anyway. */
static bool is_drained(const World *world)
{
    bool drained = false;
    for (uint32_t d = 0; d < world->sinks.used; d++) drained = drained || (world->sinks.slot[d].generation != 0 && world->sinks.slot[d].def.enabled);
    return drained;
}

void advise_pool_stirs(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS && !is_drained(world); slot++) {
        const double speed = stirring(adviser, slot, 1.0);
        const bool leaning = rests_at(adviser, slot) == LEANING;
        if (!adviser_flows(&world->materials.def[slot]) || adviser_solver_of(world, slot) != PBMPM_SOLVER_DUAL || speed <= CALM_SPEED) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_POOL_STIRS, .material = adviser_id_of(world, slot), .figure = (float)speed, .bound = (float)CALM_SPEED,
                               .text = leaning ? "a pool this deep over a floor that leans goes on circling: steps are too long for it" : "a pool this deep goes on circling slowly: steps are too long for it"};
        double factor = 1.0;
        const double substeps = world->settings.substeps;
        while (stirring(adviser, slot, factor) > CALM_SPEED && factor * substeps <= PBMPM_MAX_SUBSTEPS) factor += 1.0 / substeps;
        adviser_by_substeps(adviser, factor, &advice);
        adviser_give(adviser, advice);
    }
}

/* Whether a body may drive liquid. What floats rocks for long, and is slow while it turns. What is heavier does not
 * swing: it drives as it moves. */
static bool body_drives(const Adviser *adviser, uint32_t slot)
{
    const pbmpm_material_def *def = &adviser->world->materials.def[slot];
    const bool moves = adviser->survey.heap[slot].moves > CALM_SPEED;
    if (!adviser_present(adviser->world, slot) || adviser_flows(def)) return false;
    return moves || def->kind == PBMPM_SAND || adviser_floats(adviser->world, def);
}

static bool any_body(const World *world)
{
    return adviser_any_present(world, PBMPM_ELASTIC) || adviser_any_present(world, PBMPM_VISCO);
}

/* Whether something else than gravity moves liquid. */
static bool is_driven(const Adviser *adviser)
{
    const World *world = adviser->world;
    bool driven = is_drained(world);
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) driven = driven || body_drives(adviser, slot);
    for (uint32_t e = 0; e < world->emitters.used; e++) driven = driven || (world->emitters.slot[e].generation != 0 && world->emitters.slot[e].def.enabled);
    for (uint32_t i = 0; i < world->forces.used; i++) driven = driven || (world->forces.slot[i].generation != 0 && world->forces.slot[i].def.enabled);
    for (uint32_t c = 0; c < world->colliders.used; c++) driven = driven || (world_feels(world, &world->colliders.slot[c]) && world->colliders.slot[c].def.kinematic);
    return driven;
}

/* The largest rms speed of water under a standing wave of the height a is a sqrt(g / (2 depth)) [m/s] (G. Airy, 1845: its energy is rho g a^2 / 4 per area). That of half a cell, which
 * particles do not show. */
static double unseen_wave(const Adviser *adviser, uint32_t slot)
{
    const double cell = (double)adviser->world->def.cell_size, depth = adviser->survey.heap[slot].depth * cell;
    return depth > 0.0 ? 0.5 * cell * sqrt(gravity_strength(adviser->world) / (2.0 * depth)) : 0.0;
}

/* A standing wave of a cell, which shows, is 2^(-1/2) cells from level when it turns, root mean square, and the ends of columns are known to a quarter of a cell. Pools that stir measure 0.1 to 0.52
 * (tests/field/run.py still_pool furnished_pool creased_floor). */
static const double LEVEL = 0.75; /* [cells] (1/2 + 1/16)^(1/2): see above */

/* A pool whose surface is level, and that moves all the same. A wave is slow while it turns, and its surface is then farthest from level. Pools that stand at several levels are not told.
 * Those that come to rest are slower than CALM_SPEED 1 to 5 s after they were filled (tests/field/run.py still_pool trough). */
void advise_pool_moves(Adviser *adviser)
{
    static const double SETTLES = 5.0; /* [s] see above */
    const World *world = adviser->world;
    const double age = (double)world->step_count * world->settings.substeps * adviser->substep.dt;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS && age >= SETTLES && !is_driven(adviser); slot++) {
        const double moves = adviser->survey.heap[slot].moves;
        if (!adviser_flows(&world->materials.def[slot]) || moves <= CALM_SPEED || moves >= unseen_wave(adviser, slot)) continue;
        if (adviser->survey.heap[slot].uneven > LEVEL) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_POOL_STIRS, .material = adviser_id_of(world, slot), .figure = (float)moves, .bound = (float)CALM_SPEED, .came_true = 1,
                               .text = "the pool lies level, and its liquid moves on at this speed"};
        if (!any_body(world)) adviser_by_substeps(adviser, moves / CALM_SPEED, &advice); /* by RESTS, above; of pools alone */
        adviser_give(adviser, advice);
    }
}

/* At 60 Hz water that fell over a ball moves for more than 30 s, and faster later; at 120 Hz and at 240 Hz it calms down (tests/field/run.py splash). */
void advise_ball_stirs(Adviser *adviser)
{
    const World *world = adviser->world;
    const double fall = gravity_fall(world, &adviser->substep);
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS && adviser->survey.ball_below && fall > COARSE_FALL; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        const double moves = adviser->survey.heap[slot].moves, seen = unseen_wave(adviser, slot);
        if (seen == 0.0 || !adviser_flows(def) || def->kinematic_viscosity > 0.0f || adviser_solver_of(world, slot) != PBMPM_SOLVER_DUAL) continue;
        if (moves < seen && !adviser->survey.ball_dry) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_POOL_STIRS, .material = adviser_id_of(world, slot), .figure = (float)fmax(moves, seen), .bound = (float)CALM_SPEED,
                               .text = "water that splashes over a ball goes on moving: steps are too long for it"};
        adviser_by_substeps(adviser, sqrt(fall / COARSE_FALL), &advice);
        adviser_give(adviser, advice);
    }
}
