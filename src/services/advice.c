/* Contact of balls: H. Hertz, 1881, as in L. Landau, E. Lifshitz, Theory of Elasticity, 1986, section 9. */
#include "services/advice.h"

#include <math.h>

#include "base/sized.h"
#include "services/effective_moduli.h"
#include "services/ray.h"
#include "services/survey.h"
#include "solvers/dual/dual.h"
#include "solvers/passes.h"
#include "world/depth.h"

typedef struct Adviser {
    World *world;
    Substep substep; /* that is asked about */
    Survey survey;
    pbmpm_advice *array;
    uint32_t capacity, count;
} Adviser;

static void give(Adviser *adviser, pbmpm_advice advice)
{
    advice.size = sizeof advice;
    if (adviser->count < adviser->capacity) sized_put(SIZED_pbmpm_advice, adviser->array, adviser->count, &advice);
    adviser->count++;
}

/* ---- What helps, and its price ---- */

/* Share of a step that goes with the iterations, where none was made yet: of ten, in 3D (see docs/performance.md). */
static const double ITERATED_SHARE = 0.4;

static double iterated_share(const World *world)
{
    const StepRecord *record = &world->record;
    return record->ms_total > 0.0 ? record->ms_iterate / record->ms_total : ITERATED_SHARE;
}

static void by_substeps(const Adviser *adviser, double factor, pbmpm_advice *advice)
{
    const double now = adviser->world->settings.substeps, wanted = ceil(now * factor - 1e-6);
    if (wanted > PBMPM_MAX_SUBSTEPS) return;
    advice->change = PBMPM_CHANGE_SUBSTEPS;
    advice->value = (float)wanted;
    advice->price = (float)(100.0 * (wanted / now - 1.0));
}

static void by_iterations(const Adviser *adviser, double factor, pbmpm_advice *advice)
{
    const double now = adviser->world->settings.iterations, wanted = fmin(ceil(now * factor - 1e-6), PBMPM_MAX_ITERATIONS);
    advice->change = PBMPM_CHANGE_ITERATIONS;
    advice->value = (float)wanted;
    advice->price = (float)(100.0 * iterated_share(adviser->world) * (wanted / now - 1.0));
}

/* As many particles per cell as before. What needs less than half the cell size costs more than eight times as much: then no setting helps. */
static void by_cells(const Adviser *adviser, double factor, pbmpm_advice *advice)
{
    static const double MOST = 2.0;
    if (factor > MOST) return;
    advice->change = PBMPM_CHANGE_CELL_SIZE;
    advice->value = (float)((double)adviser->world->def.cell_size / factor);
    advice->price = (float)(100.0 * (pow(factor, adviser->world->def.dimension) - 1.0));
}

static void by_value(pbmpm_change change, double value, double price, pbmpm_advice *advice)
{
    advice->change = change;
    advice->value = (float)value;
    advice->price = (float)price;
}

static const float UNKNOWN_PRICE = -1.0f;

/* ---- What is there ---- */

static bool emitted(const World *world, uint32_t slot)
{
    const pbmpm_material_id id = {slot, world->materials.generation[slot]};
    return id.generation != 0 && emitters_use(&world->emitters, id);
}

/* Whether there is, or will be, matter of it. */
static bool present(const World *world, uint32_t slot) { return world->particles.of_material[slot] > 0 || emitted(world, slot); }

static bool flows(const pbmpm_material_def *def) { return def->kind == PBMPM_LIQUID; }

static bool any_present(const World *world, pbmpm_material_kind kind)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (present(world, slot) && world->materials.def[slot].kind == kind) return true;
    return false;
}

/* Which solver bears the weight of matter of this material. The convergent one is chosen where matter touches: a liquid that solids touch may have the other
 * one, and what that holds says held_of(). Sand beside liquid is the dual's. By itself it rests with the primal: it keeps its volume in bins of 15 to 64 cells at
 * 60 Hz x 5, even where it runs out of them, while the dual has it (tests/field/run.py bin silo weight_of_sand). */
static pbmpm_solver solver_of(const World *world, uint32_t slot)
{
    if (world->settings.solver != PBMPM_SOLVER_CONVERGENT) return world->settings.solver;
    const pbmpm_material_kind kind = world->materials.def[slot].kind;
    const bool wet = kind == PBMPM_LIQUID || (kind == PBMPM_SAND && any_present(world, PBMPM_LIQUID));
    return wet ? PBMPM_SOLVER_DUAL : PBMPM_SOLVER_PRIMAL;
}

/* Whether it may have matter of this material in some substep: sand that flows is the dual's, see solvers/granular.h. */
static bool may_solve(const World *world, uint32_t slot, pbmpm_solver solver)
{
    const bool sand = world->settings.solver == PBMPM_SOLVER_CONVERGENT && world->materials.def[slot].kind == PBMPM_SAND;
    return solver == solver_of(world, slot) || (sand && solver == PBMPM_SOLVER_DUAL);
}

/* Whether it may have any matter. */
static bool any_solved_with(const World *world, pbmpm_solver solver)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (present(world, slot) && may_solve(world, slot, solver)) return true;
    return false;
}

static pbmpm_effective held_of(const Adviser *adviser, uint32_t slot)
{
    return effective_modulus(adviser->world, slot, &adviser->substep);
}

static pbmpm_material_id id_of(const World *world, uint32_t slot) { return (pbmpm_material_id){slot, world->materials.generation[slot]}; }

/* ---- Gravity, and what falls ---- */

static void no_gravity(Adviser *adviser)
{
    const World *world = adviser->world;
    bool forced = false;
    for (uint32_t i = 0; i < world->forces.used; i++)
        forced = forced || (world->forces.slot[i].generation != 0 && world->forces.slot[i].def.kind == PBMPM_FORCE_UNIFORM);
    if (gravity_strength(world) > 0.0 || forced) return;
    pbmpm_advice advice = {.code = PBMPM_ADVICE_NO_GRAVITY, .text = "nothing falls: settings.gravity is 0, which is its default"};
    by_value(PBMPM_CHANGE_GRAVITY, 9.81, 0.0, &advice);
    give(adviser, advice);
}

/* Whether an obstacle stands below a point. */
static bool lands(const World *world, uint32_t material, const double from[3])
{
    double along[3];
    gravity_direction(world, along);
    return ray_to_obstacle(world, material, from, along, PBMPM_MAX_CELL * (double)world->def.cell_size) < INFINITY;
}

/* A wall of the domain where gravity leads, or NULL. */
static const pbmpm_domain_wall *wall_below(const World *world)
{
    for (int a = 0; a < world->def.dimension; a++) {
        const float pull = world->settings.gravity[a];
        const pbmpm_domain_wall *wall = &world->domain.wall[domain_place(a, pull > 0.0f)];
        if (pull != 0.0f && !wall->open) return wall;
    }
    return NULL;
}

static bool any_sticks(const World *world)
{
    for (uint32_t c = 0; c < world->colliders.used; c++)
        if (world_feels(world, &world->colliders.slot[c]) && world->colliders.slot[c].def.friction == PBMPM_FRICTION_STICK) return true;
    return false;
}

static void falls_forever(Adviser *adviser)
{
    enum { SAMPLES = 64 };
    static const double FEW = 0.05;
    const World *world = adviser->world;
    const Particles *p = &world->particles;
    if (world->sinks.bounds.enabled || gravity_strength(world) == 0.0 || wall_below(world)) return;
    const bool hangs = any_sticks(world);
    const uint32_t step = p->count / SAMPLES + 1;
    double looked = 0.0, falls = 0.0;
    for (uint32_t row = 0; row < p->count; row += step) {
        if (hangs && material_is_solid(&world->materials, p->material[row])) continue;
        double at[3] = {0};
        for (int a = 0; a < p->dimension; a++) at[a] = particles_coordinate(p, row, a) * (double)world->def.cell_size;
        looked += 1.0;
        falls += !lands(world, p->material[row], at);
    }
    for (uint32_t e = 0; e < world->emitters.used; e++) {
        const Emitter *emitter = &world->emitters.slot[e];
        if (emitter->generation == 0) continue;
        const double at[3] = {(double)emitter->shape.position[0], (double)emitter->shape.position[1], (double)emitter->shape.position[2]};
        looked += 1.0;
        falls += !lands(world, emitter->def.material.index, at);
    }
    if (looked == 0.0 || falls <= FEW * looked) return;
    pbmpm_advice advice = {.code = PBMPM_ADVICE_FALLS_FOREVER, .figure = (float)(falls / looked), .bound = (float)FEW,
                           .text = "matter has nothing to fall on, and no kill bounds take it out: it falls for ever at full cost"};
    by_value(PBMPM_CHANGE_KILL_BOUNDS, 0.0, 0.0, &advice);
    give(adviser, advice);
}

/* ---- Parameters that do nothing ---- */

static void ignored(Adviser *adviser, pbmpm_material_id material, pbmpm_collider_id collider, float value, float plain, const char *text)
{
    if (value == plain) return;
    pbmpm_advice advice = {.code = PBMPM_ADVICE_IGNORED, .material = material, .collider = collider, .figure = value, .bound = plain, .text = text};
    by_value(PBMPM_CHANGE_PARAMETER, (double)plain, 0.0, &advice);
    give(adviser, advice);
}

static void ignored_of_liquid(Adviser *adviser, uint32_t slot, pbmpm_solver solver)
{
    const pbmpm_material_def *def = &adviser->world->materials.def[slot], plain = material_defaults();
    const pbmpm_material_id id = id_of(adviser->world, slot);
    const pbmpm_collider_id none = {0, 0};
    if (solver == PBMPM_SOLVER_PAPER)
        ignored(adviser, id, none, def->bulk_modulus, plain.bulk_modulus, "bulk_modulus does nothing with the paper's solver: rate and iterations make its stiffness");
    else
        ignored(adviser, id, none, def->viscosity, plain.viscosity, "viscosity does nothing but with the paper's solver: kinematic_viscosity does");
}

static void ignored_of_solid(Adviser *adviser, uint32_t slot, pbmpm_solver solver)
{
    const World *world = adviser->world;
    const pbmpm_material_def *def = &world->materials.def[slot], plain = material_defaults();
    const pbmpm_material_id id = id_of(world, slot);
    const pbmpm_collider_id none = {0, 0};
    const bool elastic = def->kind == PBMPM_ELASTIC;
    if (solver == PBMPM_SOLVER_PAPER) {
        ignored(adviser, id, none, def->young_modulus, plain.young_modulus, "young_modulus does nothing with the paper's solver: rate and iterations make its stiffness");
        ignored(adviser, id, none, def->poisson_ratio, plain.poisson_ratio, "poisson_ratio does nothing with the paper's solver");
    } else {
        ignored(adviser, id, none, def->elasticity_ratio, plain.elasticity_ratio, "elasticity_ratio does nothing but with the paper's solver: young_modulus and poisson_ratio do");
        ignored(adviser, id, none, def->rebound_max, plain.rebound_max, "rebound_max does nothing but with the paper's solver");
    }
    if (!may_solve(world, slot, PBMPM_SOLVER_PAPER) && !may_solve(world, slot, PBMPM_SOLVER_DUAL))
        ignored(adviser, id, none, def->relaxation, plain.relaxation, "relaxation does nothing for solids with the primal and the explicit solver");
    if (elastic && (solver == PBMPM_SOLVER_PAPER || solver == PBMPM_SOLVER_DUAL))
        ignored(adviser, id, none, (float)def->elastic_model, (float)plain.elastic_model, "elastic_model does nothing with this solver: the paper's has none, the dual's is fixed corotated");
}

static void ignored_of_settings(Adviser *adviser)
{
    const World *world = adviser->world;
    const pbmpm_settings *now = &world->settings, plain = settings_defaults();
    const pbmpm_material_id none = {0, 0};
    const pbmpm_collider_id nowhere = {0, 0};
    const bool liquid = any_present(world, PBMPM_LIQUID), by_dual = any_solved_with(world, PBMPM_SOLVER_DUAL), by_primal = any_solved_with(world, PBMPM_SOLVER_PRIMAL);
    if (!by_dual || !liquid)
        ignored(adviser, none, nowhere, (float)now->pressure, (float)plain.pressure, "settings.pressure does nothing here: only liquids of the dual solver have it");
    if (!by_primal)
        ignored(adviser, none, nowhere, (float)now->integrator, (float)plain.integrator, "settings.integrator does nothing here: only the primal solver has a second order");
    if (now->solver == PBMPM_SOLVER_PAPER || !liquid)
        ignored(adviser, none, nowhere, now->flip, plain.flip, "settings.flip does nothing here: only liquids have it, and not with the paper's solver");
    if (by_dual || by_primal) return;
    ignored(adviser, none, nowhere, now->target_error, plain.target_error, "settings.target_error does nothing here: only the dual and the primal solver predict an error");
    ignored(adviser, none, nowhere, now->time_budget_ms, plain.time_budget_ms, "settings.time_budget_ms does nothing here: only the dual and the primal solver keep one");
}

static void ignored_of_walls(Adviser *adviser)
{
    const World *world = adviser->world;
    const pbmpm_material_id none = {0, 0};
    const float plain = collider_defaults().friction_coefficient;
    if (!world->def.domain_enabled)
        ignored(adviser, none, (pbmpm_collider_id){0, 0}, world->def.domain_friction, 0.0f, "domain_friction does nothing: domain_enabled is 0");
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *collider = &world->colliders.slot[c];
        if (!collider_acts(collider) || collider->def.friction == PBMPM_FRICTION_COULOMB) continue;
        ignored(adviser, none, (pbmpm_collider_id){c, collider->generation}, collider->def.friction_coefficient, plain,
                "friction_coefficient does nothing but with PBMPM_FRICTION_COULOMB");
    }
}

static void ignored_parameters(Adviser *adviser)
{
    const World *world = adviser->world;
    ignored_of_settings(adviser);
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (!present(world, slot)) continue;
        if (flows(&world->materials.def[slot]))
            ignored_of_liquid(adviser, slot, solver_of(world, slot));
        else
            ignored_of_solid(adviser, slot, solver_of(world, slot));
    }
    ignored_of_walls(adviser);
}

/* ---- Pools ---- */

/* Pressure has to reach the bottom of a pool: what N iterations do not bring there is missing from its volume. It costs volume beyond about 5 of
 * g dt^2 depth / dx^2, at 5 iterations (columns of 16 to 64 cells). */
static const double DEEPEST = 5.0;
/* Strain at the bottom that nobody sees; of a column that is half as much. */
static const double STRAIN_UNSEEN = 0.1;

static void pool_too_deep(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        const pbmpm_solver solver = solver_of(world, slot);
        const double depth = adviser->survey.heap[slot].depth;
        if (depth == 0.0 || !flows(def) || (solver != PBMPM_SOLVER_PAPER && solver != PBMPM_SOLVER_DUAL)) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_POOL_TOO_DEEP, .material = id_of(world, slot)};
        double figure = gravity_fall(world, &adviser->substep) * depth, bound = DEEPEST;
        advice.text = "the pool is too deep for the rate: it is compressed by its weight";
        if (solver == PBMPM_SOLVER_PAPER) {
            const double bulk = (double)held_of(adviser, slot).bulk_modulus;
            figure = (double)def->density * gravity_strength(world) * depth * (double)world->def.cell_size / bulk;
            bound = STRAIN_UNSEEN;
            advice.text = "the paper's solver is as stiff as rate and iterations make it: the pool is compressed by its weight";
        }
        if (figure <= bound) continue;
        advice.figure = (float)figure;
        advice.bound = (float)bound;
        if (solver == PBMPM_SOLVER_PAPER)
            by_value(PBMPM_CHANGE_SOLVER, PBMPM_SOLVER_CONVERGENT, (double)UNKNOWN_PRICE, &advice);
        else
            by_substeps(adviser, sqrt(figure / bound), &advice);
        give(adviser, advice);
    }
}

/* What is missing from the pressure of a step stirs a pool: its rms speed is about STILL f^2 cells per substep, with f = g dt^2 depth / dx^2, at five iterations or more.
 * Pools of 12 to 36 cells of 1.25 to 5 cm between level and upright walls, on and off the grid, at 60 Hz x 5: 0.0010 to 0.0016 of it up to f = 4, in 3D 0.0002 to 0.0007 of
 * it up to 2.6. Fewer iterations stir more, in proportion. Around what stands in the water, and bulges, pools of 12 cells have 0.0017 to 0.039 of it, ten of thirteen less than AROUND
 * (tests/field/run.py furnished_pool creased_floor ball_in_pool still_pool deep_pool --settings 60x5). Liquids that store energy have no eddy damping and count as such. */
static const double STILL = 0.0015, STILL_3D = 0.0007, AROUND = 0.012, CALM_SPEED = 0.01, CALM_ITERATIONS = 5.0;

static void pool_stirs(Adviser *adviser)
{
    const World *world = adviser->world;
    const double cell_speed = (double)world->def.cell_size / adviser->substep.dt, few = fmax(1.0, CALM_ITERATIONS / world->settings.iterations);
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        const double fall = gravity_fall(world, &adviser->substep) * adviser->survey.heap[slot].depth;
        const bool around = adviser->survey.obstructed;
        const double share = around || def->bulk_modulus > 0.0f ? AROUND : world->def.dimension == 2 ? STILL : STILL_3D;
        const double speed = share * few * fall * fall * cell_speed;
        if (!flows(def) || solver_of(world, slot) != PBMPM_SOLVER_DUAL || speed <= CALM_SPEED) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_POOL_STIRS, .material = id_of(world, slot), .figure = (float)speed, .bound = (float)CALM_SPEED,
                               .text = around ? "water goes on moving around what stands in it, at this rate"
                                              : "a pool this deep goes on circling slowly at this rate"};
        by_substeps(adviser, pow(speed / CALM_SPEED, 1.0 / 3.0), &advice); /* f falls with the square of the rate */
        give(adviser, advice);
    }
}

/* ---- Solids ---- */

/* N iterations hold a stiffness that grows with N^2 and with 1/dt^2. A softer body looks the same at any rate and costs nothing. */
static void modulus_not_held(Adviser *adviser)
{
    static const double ENOUGH = 0.8, MOST_ITERATIONS = 100.0;
    const World *world = adviser->world;
    if (world->settings.solver == PBMPM_SOLVER_PAPER) return; /* it has none, which ignored_of_solid() tells */
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        if (!present(world, slot) || flows(def) || def->kind == PBMPM_SAND) continue;
        const double held = (double)held_of(adviser, slot).young_modulus, own = (double)def->young_modulus;
        if (held >= ENOUGH * own) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_MODULUS_NOT_HELD, .material = id_of(world, slot), .figure = (float)held, .bound = (float)own,
                               .text = "the iterations do not hold the modulus: the body is softer than its material"};
        const double factor = sqrt(own / held);
        if (factor * world->settings.iterations <= MOST_ITERATIONS)
            by_iterations(adviser, factor, &advice);
        else
            by_value(PBMPM_CHANGE_YOUNG_MODULUS, held, 0.0, &advice);
        give(adviser, advice);
    }
}

/* The dual keeps the volume of sand by pressures, as that of liquids. With the others sand bears its weight by its modulus M: a heap of height H is strained by
 * rho g H / (2 M) on average. */
static double sand_figure(const Adviser *adviser, uint32_t slot, double *bound)
{
    static const double UNSEEN = 0.05;
    const World *world = adviser->world;
    const pbmpm_material_def *def = &world->materials.def[slot];
    const double cells = adviser->survey.heap[slot].depth, d = world->def.dimension;
    *bound = DEEPEST;
    if (solver_of(world, slot) == PBMPM_SOLVER_DUAL) return gravity_fall(world, &adviser->substep) * cells;
    const pbmpm_effective held = held_of(adviser, slot);
    const double shear = lame_of((double)held.young_modulus, (double)def->poisson_ratio).mu, wave = (double)held.bulk_modulus + 2.0 * (d - 1.0) / d * shear;
    *bound = UNSEEN;
    return 0.5 * (double)def->density * gravity_strength(world) * cells * (double)world->def.cell_size / wave;
}

static void sand_not_held(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (adviser->survey.heap[slot].depth == 0.0 || world->materials.def[slot].kind != PBMPM_SAND) continue;
        double bound;
        const double figure = sand_figure(adviser, slot, &bound);
        if (figure <= bound) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_SAND_NOT_HELD, .material = id_of(world, slot), .figure = (float)figure, .bound = (float)bound};
        advice.text = bound == DEEPEST ? "the sand is too deep for the rate: it is compressed by its weight, and flows too fast"
                                       : "the iterations do not hold the sand's modulus: it is crushed by its weight";
        by_substeps(adviser, sqrt(figure / bound), &advice);
        give(adviser, advice);
    }
}

/* Speed at which matter lands that falls freely from where it is, in cells per substep. */
static double landing(const Adviser *adviser, uint32_t slot, double drop)
{
    const World *world = adviser->world;
    const double cell = (double)world->def.cell_size, speed = adviser->survey.heap[slot].speed;
    return sqrt(speed * speed + 2.0 * gravity_strength(world) * drop * cell) * adviser->substep.dt / cell;
}

/* What lands in one piece is stopped within a substep, and crushed by its way in it (tests/field/run.py falls --settings 60x5,90x5,120x5,240x5). */
static void sand_lands(Adviser *adviser)
{
    static const double FALLS = 4.0; /* cells: less may be between the pieces of what falls */
    static const double CRUSHED = 4.0; /* a block of 16 cells keeps 0.994 of its volume with 3.2, and 0.88 with 4.8 */
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const double drop = adviser->survey.heap[slot].drop_half;
        if (drop < FALLS || world->materials.def[slot].kind != PBMPM_SAND) continue;
        const double cells = landing(adviser, slot, drop);
        if (cells <= CRUSHED) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_SAND_NOT_HELD, .material = id_of(world, slot), .figure = (float)cells, .bound = (float)CRUSHED,
                               .text = "sand that lands at more than four cells per substep is crushed there for a second or two"};
        by_substeps(adviser, cells / CRUSHED, &advice);
        give(adviser, advice);
    }
}

/* The fastest landing of what emitters bring. */
static double emitted_landing(const Adviser *adviser, uint32_t slot)
{
    const World *world = adviser->world;
    double fastest = 0.0, along[3];
    const double strength = gravity_direction(world, along), cell = (double)world->def.cell_size;
    for (uint32_t e = 0; e < world->emitters.used && strength > 0.0; e++) {
        const Emitter *emitter = &world->emitters.slot[e];
        if (emitter->generation == 0 || !emitter->def.enabled || emitter->def.material.index != slot) continue;
        const double from[3] = {(double)emitter->shape.position[0], (double)emitter->shape.position[1], (double)emitter->shape.position[2]};
        const double far = PBMPM_MAX_CELL * cell, speed = (double)emitter->def.speed;
        const double way = fmin(ray_to_obstacle(world, slot, from, along, far), ray_to_wall(world, from, along, far));
        if (way < far) fastest = fmax(fastest, sqrt(speed * speed + 2.0 * strength * way) * adviser->substep.dt / cell);
    }
    return fastest;
}

/* Of the surface of sand: fewer places may be a corner. */
static const double STEEP = 0.1;

/* The friction of a substep acts where its grains are at the start. What goes C cells in it is braked C cells too late, an error of the first order in C. A pile of 21 cells that
 * slides has C = 1.9 at 60 Hz and 0.5 at 240 Hz by the fall of its mean depth; with 25, 30 and 35 degrees it comes to rest flatter by 1.7, 1.9 and 2.6 degrees
 * per unit of C, at 60, 90, 120, 180 and 240 Hz (tests/field/run.py pile_slumps). One cell is a tenth of an angle of repose. */
static void sand_slides(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const Heap *heap = &adviser->survey.heap[slot];
        if (!present(world, slot) || world->materials.def[slot].kind != PBMPM_SAND) continue;
        const double drop = fmax(heap->drop_most, heap->steep > STEEP ? fmin(heap->slide, heap->depth) : 0.0);
        const double cells = fmax(sqrt(2.0 * gravity_fall(world, &adviser->substep) * drop), emitted_landing(adviser, slot)); /* v^2 = 2 g h */
        if (cells <= 1.0) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_SAND_NOT_HELD, .material = id_of(world, slot), .figure = (float)cells, .bound = 1.0f,
                               .text = "sand that slides or lands at more than a cell per substep comes to rest too flat, by up to ten degrees"};
        by_substeps(adviser, cells, &advice);
        give(adviser, advice);
    }
}

/* A spline reaches 1.5 cells: a body of fewer than three has no inside. Beside liquid about half a cell on each side is neither's. */
static void body_too_thin(Adviser *adviser)
{
    static const double INSIDE = 3.0, AFLOAT = 6.5;
    const World *world = adviser->world;
    const double bound = any_present(world, PBMPM_LIQUID) ? AFLOAT : INSIDE;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        const double thickness = adviser->survey.heap[slot].thickness;
        if (thickness == 0.0 || def->kind == PBMPM_SAND || flows(def) || thickness >= bound) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_BODY_TOO_THIN, .material = id_of(world, slot), .figure = (float)thickness, .bound = (float)bound,
                               .text = bound == AFLOAT ? "a body is thin for the grid: it floats too high or too deep, by up to a cell"
                                                       : "a body is thin for the grid: it bends and bears less truly"};
        by_cells(adviser, bound / thickness, &advice);
        give(adviser, advice);
    }
}

static const double PI = 3.14159265358979;

static double radius_of(const Adviser *adviser, uint32_t slot)
{
    return 0.5 * adviser->survey.heap[slot].thickness * (double)adviser->world->def.cell_size;
}

/* E / (1 - nu^2) */
static double contact_modulus(const pbmpm_material_def *def)
{
    return (double)def->young_modulus / (1.0 - (double)def->poisson_ratio * (double)def->poisson_ratio);
}

/* A ball of radius R that meets a wall at the speed v rests on it for 2.94 (15 m / (16 sqrt(R) E'))^(2/5) v^(-1/5) [s]. */
static double contact_of(const Adviser *adviser, uint32_t slot, double speed)
{
    const pbmpm_material_def *def = &adviser->world->materials.def[slot];
    const double radius = radius_of(adviser, slot), mass = 4.0 / 3.0 * PI * (double)def->density * radius * radius * radius;
    return 2.94 * pow(15.0 * mass / (16.0 * sqrt(radius) * contact_modulus(def)), 0.4) * pow(fmax(speed, 1e-6), -0.2);
}

/* Backward Euler takes from half a swing of n
 * substeps all but the share exp(-pi^2 / (2 n)). The primal gives bodies back what a substep took from their bounce. */
static void bounce_damped(Adviser *adviser)
{
    static const double KEPT = 0.6;
    const World *world = adviser->world;
    const double bound = PI * PI / (2.0 * log(1.0 / KEPT));
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        const double radius = radius_of(adviser, slot);
        if (radius == 0.0 || def->kind != PBMPM_ELASTIC || solver_of(world, slot) != PBMPM_SOLVER_DUAL) continue;
        const double speed = fmax(adviser->survey.heap[slot].speed, sqrt(2.0 * gravity_strength(world) * 2.0 * radius)); /* or a fall by its own height */
        const double steps = contact_of(adviser, slot, speed) / adviser->substep.dt;
        if (steps >= bound) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_BOUNCE_DAMPED, .material = id_of(world, slot), .figure = (float)steps, .bound = (float)bound,
                               .text = "a contact lasts too few substeps for the dual solver: the body bounces less than its material would"};
        by_value(PBMPM_CHANGE_SOLVER, PBMPM_SOLVER_CONVERGENT, (double)UNKNOWN_PRICE, &advice);
        give(adviser, advice);
    }
}

static bool solid_among_others(const World *world, uint32_t slot)
{
    for (uint32_t other = 0; other < PBMPM_MAX_MATERIALS; other++)
        if (other != slot && present(world, other) && world->materials.def[other].kind == PBMPM_ELASTIC) return true;
    return false;
}

/* Bodies that hit each other share nodes, and leave each other only after enough substeps: discs of 16 cells keep nothing of their speed in contacts of less than 10,
 * 0.35 in 14, 0.54 in 19, 0.62 in 23 (two discs as in tests/field/run.py collision, of 3e4 to 3e5 Pa, at 60 to 240 Hz). */
static void hit_damped(Adviser *adviser)
{
    static const double BOUND = 23.0, FAST = 0.1;
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const Heap *heap = &adviser->survey.heap[slot];
        const bool fast = heap->speed * adviser->substep.dt > FAST * (double)world->def.cell_size;
        if (!fast || radius_of(adviser, slot) == 0.0 || world->materials.def[slot].kind != PBMPM_ELASTIC || solver_of(world, slot) != PBMPM_SOLVER_PRIMAL) continue;
        const double steps = contact_of(adviser, slot, heap->speed) / adviser->substep.dt;
        if (steps >= BOUND || !solid_among_others(world, slot)) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_BOUNCE_DAMPED, .material = id_of(world, slot), .figure = (float)steps, .bound = (float)BOUND,
                               .text = "bodies that hit each other stay together: their contact lasts too few substeps"};
        by_substeps(adviser, BOUND / steps, &advice);
        give(adviser, advice);
    }
}

/* Half the width that a round body rests on: of a ball (3 F R / (4 E'))^(1/3), of a disc sqrt(4 F R / (pi E')). */
static double patch_of(const Adviser *adviser, uint32_t slot)
{
    const World *world = adviser->world;
    const pbmpm_material_def *def = &world->materials.def[slot];
    const double radius = radius_of(adviser, slot), pull = (double)def->density * gravity_strength(world), modulus = contact_modulus(def);
    if (world->def.dimension == 2) return sqrt(4.0 * PI * radius * radius * pull * radius / (PI * modulus));
    return pow(3.0 * 4.0 / 3.0 * PI * radius * radius * radius * pull * radius / (4.0 * modulus), 1.0 / 3.0);
}

static bool any_rubs(const World *world)
{
    bool rubs = false;
    for (int place = 0; place < 2 * world->def.dimension; place++) {
        const pbmpm_domain_wall *wall = &world->domain.wall[place];
        rubs = rubs || (!wall->open && wall->friction != PBMPM_FRICTION_SLIP && wall->friction_coefficient > 0.0f);
    }
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *collider = &world->colliders.slot[c];
        rubs = rubs || (world_feels(world, collider) && collider->def.friction != PBMPM_FRICTION_SLIP && collider->def.friction_coefficient > 0.0f);
    }
    return rubs;
}

/* The spline spreads a contact over more than a cell, and what turns over a wider patch than its own is braked. */
static void rolling_braked(Adviser *adviser)
{
    const World *world = adviser->world;
    if (gravity_strength(world) == 0.0 || !any_rubs(world) || solver_holds_liquid(world)) return; /* bodies among liquid may float */
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const Heap *heap = &adviser->survey.heap[slot];
        if (heap->thickness == 0.0 || !heap->round || world->materials.def[slot].kind != PBMPM_ELASTIC) continue;
        const double cells = patch_of(adviser, slot) / (double)world->def.cell_size;
        if (cells >= 1.0) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_ROLLING_BRAKED, .material = id_of(world, slot), .figure = (float)cells, .bound = 1.0f,
                               .text = "a round body rests on less than the grid resolves: it rolls too slowly"};
        by_cells(adviser, 1.0 / cells, &advice);
        if (advice.change == PBMPM_CHANGE_NONE) advice.text = "a round body rests on far less than the grid resolves: it rolls too slowly, and no setting helps";
        give(adviser, advice);
    }
}

/* ---- Obstacles ---- */

/* The farthest that a turn about its position carries a point of a shape; of planes and baked solids it is not known. */
static double reach_of(const Collider *collider)
{
    const pbmpm_shape *shape = &collider->shape;
    double sum = 0.0;
    switch (shape->kind) {
    case PBMPM_BOX:
        for (int a = 0; a < 3; a++) sum += (double)shape->half_extents[a] * (double)shape->half_extents[a];
        return sqrt(sum);
    case PBMPM_CAPSULE: return (double)shape->half_extents[0] + (double)shape->radius;
    case PBMPM_SPHERE: /* turns in its own place */
    case PBMPM_BAKED:
    case PBMPM_PLANE:
    case PBMPM_SHAPE_KIND_FORCE32: break;
    }
    return 0.0;
}

static double way_of(const Collider *collider, int dimension)
{
    double way2 = 0.0, dot = 0.0;
    for (int a = 0; a < dimension; a++) {
        const double step = (double)collider->target_position[a] - (double)collider->shape.position[a];
        way2 += step * step;
    }
    for (int a = 0; a < 4; a++) dot += (double)collider->target_rotation[a] * (double)collider->shape.rotation[a];
    const double angle = 2.0 * acos(fmin(1.0, fabs(dot)));
    return sqrt(way2) + angle * reach_of(collider);
}

static void collider_too_fast(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *collider = &world->colliders.slot[c];
        if (!world_feels(world, collider) || !collider_moves(collider)) continue;
        const double cells = way_of(collider, world->def.dimension) / ((double)world->def.cell_size * world->settings.substeps);
        if (cells <= 1.0) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_COLLIDER_TOO_FAST, .collider = {c, collider->generation}, .figure = (float)cells, .bound = 1.0f,
                               .text = "an obstacle moves by more than a cell per substep: it passes matter by, or throws it"};
        by_substeps(adviser, cells, &advice);
        give(adviser, advice);
    }
}

static double thickness_of(const Collider *collider, int dimension)
{
    const pbmpm_shape *shape = &collider->shape;
    double least = INFINITY;
    switch (shape->kind) {
    case PBMPM_BOX:
        for (int a = 0; a < dimension; a++) least = fmin(least, 2.0 * (double)shape->half_extents[a]);
        break;
    case PBMPM_SPHERE:
    case PBMPM_CAPSULE: least = 2.0 * (double)shape->radius; break;
    case PBMPM_PLANE:
    case PBMPM_BAKED: /* is not looked for in its grid */
    case PBMPM_SHAPE_KIND_FORCE32: break;
    }
    return least;
}

static void collider_too_thin(Adviser *adviser)
{
    const World *world = adviser->world;
    const double cell = (double)world->def.cell_size;
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *collider = &world->colliders.slot[c];
        if (!world_feels(world, collider)) continue;
        const double cells = thickness_of(collider, world->def.dimension) / cell;
        if (cells >= 1.0 - 1e-5) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_COLLIDER_TOO_THIN, .collider = {c, collider->generation}, .figure = (float)cells, .bound = 1.0f,
                               .text = "an obstacle is thinner than a cell: matter on one side feels what is on the other"};
        by_value(PBMPM_CHANGE_COLLIDER, cell, 0.0, &advice);
        give(adviser, advice);
    }
}

/* ---- Speed ---- */

static void step_too_long(Adviser *adviser)
{
    const World *world = adviser->world;
    const double bound = (double)world->settings.max_displacement;
    double speed = 0.0;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) speed = fmax(speed, adviser->survey.heap[slot].speed);
    for (uint32_t e = 0; e < world->emitters.used; e++)
        if (world->emitters.slot[e].generation != 0) speed = fmax(speed, (double)world->emitters.slot[e].def.speed);
    const double cells = speed * adviser->substep.dt / (double)world->def.cell_size;
    if (cells < 0.99 * bound) return; /* who was slowed to it is at it */
    pbmpm_advice advice = {.code = PBMPM_ADVICE_STEP_TOO_LONG, .figure = (float)fmax(cells, bound), .bound = (float)bound,
                           .text = "matter is faster than max_displacement allows: it is slowed"};
    by_substeps(adviser, fmax(2.0, cells / bound), &advice);
    give(adviser, advice);
}

/* ---- What came true ---- */

/* What a solid's own modulus lets its weight take of its volume. */
static double lost_to_weight(const Adviser *adviser, uint32_t slot)
{
    const World *world = adviser->world;
    const pbmpm_material_def *def = &world->materials.def[slot];
    if (flows(def)) return 0.0;
    const double depth = adviser->survey.heap[slot].depth * (double)world->def.cell_size, poisson = (double)def->poisson_ratio;
    const double bulk = (double)def->young_modulus / (3.0 * (1.0 - 2.0 * poisson));
    return 0.5 * (double)def->density * gravity_strength(world) * depth / bulk;
}

static void volume_lost(Adviser *adviser)
{
    static const double UNSEEN = 0.05, SURE = 2.0; /* standard errors: of forty means one is off by more, to one side */
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const double filling = adviser->survey.heap[slot].filling;
        if (filling == 0.0 || world->step_count == 0) continue;
        const double sure = filling - SURE * adviser->survey.heap[slot].filling_error;
        if (sure <= 1.0) continue;
        const double lost = 1.0 - 1.0 / sure - lost_to_weight(adviser, slot);
        if (lost <= UNSEEN) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_VOLUME_LOST, .material = id_of(world, slot), .figure = (float)lost, .bound = (float)UNSEEN, .came_true = 1,
                               .text = "matter takes less room than it should: its level is too low"};
        by_substeps(adviser, 2.0, &advice);
        give(adviser, advice);
    }
}

static void strain_clamped(Adviser *adviser)
{
    static const double FEW = 0.005;
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const double share = adviser->survey.heap[slot].clamped;
        if (share <= FEW) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_STRAIN_CLAMPED, .material = id_of(world, slot), .figure = (float)share, .bound = (float)FEW, .came_true = 1,
                               .text = "particles are strained to a bound of their material: they are crushed or torn"};
        by_substeps(adviser, 2.0, &advice);
        give(adviser, advice);
    }
}

/* The error of N iterations falls about as 1 / N^2. */
static void not_solved(Adviser *adviser)
{
    static const double SEEN = 0.05; /* cells per substep */
    const double error = adviser->world->record.predicted_error;
    if (error <= SEEN) return;
    pbmpm_advice advice = {.code = PBMPM_ADVICE_NOT_SOLVED, .figure = (float)error, .bound = (float)SEEN, .came_true = 1,
                           .text = any_present(adviser->world, PBMPM_LIQUID) ? "the last substep is far from solved: liquid leaves through holes too fast, and bodies are too soft"
                                                                             : "the last substep is far from solved: stiffness and contact are not what they should be"};
    by_iterations(adviser, sqrt(error / SEEN), &advice);
    give(adviser, advice);
}

/* Before the first step: later nobody can tell it from what was crushed. */
static void overlaps(Adviser *adviser)
{
    static const double FEW = 0.01;
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS && world->step_count == 0; slot++) {
        const double share = adviser->survey.heap[slot].overlapping;
        if (share <= FEW) continue;
        give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_OVERLAPS, .material = id_of(world, slot), .figure = (float)share, .bound = (float)FEW,
                                     .text = "matter was put where there is other matter: it is crushed, and bursts or loses volume"});
    }
}

/* Whether any of some particles or emitters of a material has no obstacle below it. */
static bool reaches_domain(const World *world, uint32_t slot)
{
    enum { SAMPLES = 64 };
    const Particles *p = &world->particles;
    const uint32_t stride = 1 + p->of_material[slot] / SAMPLES;
    uint32_t number = 0;
    for (uint32_t row = 0; row < p->count; row++) {
        if (p->material[row] != slot || number++ % stride != 0) continue;
        double at[3] = {0};
        for (int a = 0; a < p->dimension; a++) at[a] = particles_coordinate(p, row, a) * (double)world->def.cell_size;
        if (!lands(world, slot, at)) return true;
    }
    for (uint32_t e = 0; e < world->emitters.used; e++) {
        const Emitter *emitter = &world->emitters.slot[e];
        const double at[3] = {(double)emitter->shape.position[0], (double)emitter->shape.position[1], (double)emitter->shape.position[2]};
        if (emitter->generation != 0 && emitter->def.material.index == slot && !lands(world, slot, at)) return true;
    }
    return false;
}

/* The friction that holds a heap together acts on its base, too. */
static void no_friction(Adviser *adviser)
{
    static const double LITTLE = 0.05;
    const World *world = adviser->world;
    const pbmpm_domain_wall *floor = wall_below(world);
    for (uint32_t slot = 0; floor && slot < PBMPM_MAX_MATERIALS; slot++) {
        if (!present(world, slot) || world->materials.def[slot].kind != PBMPM_SAND || floor->friction != PBMPM_FRICTION_COULOMB) continue;
        if ((double)floor->friction_coefficient >= LITTLE || !reaches_domain(world, slot)) continue;
        give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_NO_FRICTION, .material = id_of(world, slot), .figure = floor->friction_coefficient, .bound = (float)LITTLE,
                                     .text = "sand makes no heap on the domain's floor, which has no friction: give it some by domain_friction"});
    }
}

static void tell_limit(Adviser *adviser, uint32_t slot, const char *text)
{
    give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_KNOWN_LIMIT, .material = id_of(adviser->world, slot), .text = text});
}

static bool sinks(const World *world, const pbmpm_material_def *body)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (present(world, slot) && flows(&world->materials.def[slot]) && world->materials.def[slot].density < body->density) return true;
    return false;
}

/* Whether a body moves as matter pushes it, see pbmpm_rigid_advance(). */
static bool any_rigid(const World *world)
{
    for (uint32_t slot = 0; slot < world->colliders.used; slot++) {
        const Collider *collider = &world->colliders.slot[slot];
        if (collider->generation != 0 && collider->def.kinematic && collider->def.measures_impulse) return true;
    }
    return false;
}

/* A column runs out by 1.2 times its height over its width, in widths (G. Lube, H. Huppert, S. Sparks, M. Freundt, "Collapses of two-dimensional granular columns", Phys.
 * Rev. E 72, 2005); where it falls both ways, half its width counts. Far: by its width (tests/field/run.py column tilted_tray --settings 60x5,240x5: 0.06 of the
 * volume is lost with 1.2 widths, 0.03 with 0.6). */
static bool slides_far(const Heap *heap)
{
    static const double RUN_OUT = 1.2, FAR = 1.0;
    return RUN_OUT * fmin(heap->slide, heap->depth) > FAR * heap->width * (heap->falls_both_ways ? 0.5 : 1.0);
}

static void limits_of_sand(Adviser *adviser, uint32_t slot)
{
    static const double ROCKS = 0.02; /* rigid_on_sand: at 60 Hz 0.11, at 120 Hz 0.027; at 240 Hz, 0.007, the crate rests */
    const World *world = adviser->world;
    const Heap *heap = &adviser->survey.heap[slot];
    const double substeps = world->settings.substeps, fall = gravity_fall(world, &adviser->substep) * substeps * substeps; /* in a step: a rigid body moves once in it */
    if (any_present(world, PBMPM_LIQUID)) tell_limit(adviser, slot, "sand in liquid does not settle: both move as one mixture, and go on stirring");
    if (any_rigid(world) && fall > ROCKS) tell_limit(adviser, slot, "a rigid body on sand rocks and sinks in: more steps per second hold it better, substeps hardly do");
    if (heap->steep > STEEP) tell_limit(adviser, slot, "sand starts to slide up to eight degrees too steep");
    if (heap->steep > STEEP && slides_far(heap)) tell_limit(adviser, slot, "sand that slides far loses up to seven percent of its volume");
}

/* What holds a body up acts on the nodes that its splines reach, up to 1.5 cells beyond it: a weight that lies beyond its edge by less is borne, or tips it slowly. */
static void limits_of_edges(Adviser *adviser, uint32_t slot)
{
    static const double REACH = 1.5;
    const World *world = adviser->world;
    const double lever = adviser->survey.heap[slot].lever;
    if (lever <= 0.0 || lever >= REACH || any_sticks(world) || any_present(world, PBMPM_LIQUID)) return; /* in liquid it may float */
    tell_limit(adviser, slot, "a body's weight lies beyond its edge by less than the grid resolves: it tips too slowly, or stands");
}

/* Motion is one per node: what lies between two of them moves with both. */
static void limits_of_bodies(Adviser *adviser, uint32_t slot)
{
    static const double FALLS = 2.0, FALLS_IN = 0.5;
    const World *world = adviser->world;
    const pbmpm_material_def *def = &world->materials.def[slot];
    const Heap *heap = &adviser->survey.heap[slot];
    const bool wet = any_present(world, PBMPM_LIQUID), loose = heap->on_matter && !any_sticks(world), falls = loose && heap->drop_least > FALLS; /* or it may hang */
    if (any_present(world, PBMPM_SAND) && !dual_holds_solids(world, &adviser->substep))
        tell_limit(adviser, slot, "a body as stiff as this springs back from sand, or stops a cell or two above it");
    else if (any_present(world, PBMPM_SAND) && falls)
        tell_limit(adviser, slot, "a body that falls on sand may stop a cell or two above it");
    if (wet && heap->narrow > 0.5) tell_limit(adviser, slot, "a body with less than five cells to the walls on both sides hangs in a liquid");
    /* A jelly of 5e4 or 2e5 Pa and ten cells that is put afloat has the strain of hydrostatics, at 60 and 240 Hz; one that fell by 1 to 12 cells two to four times that. */
    if (wet && loose && heap->drop_least > FALLS_IN) tell_limit(adviser, slot, "a body that fell into a liquid stays more strained than one that was put there afloat");
    if (sinks(world, def)) tell_limit(adviser, slot, "a body that sinks in a liquid stops a cell above the floor, and slides; the level may be off");
    if (sinks(world, def) && falls) tell_limit(adviser, slot, "where a heavy body fell into a liquid, the liquid goes on moving by some centimetres per second");
}

static void known_limits(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_kind kind = world->materials.def[slot].kind;
        if (!present(world, slot) || kind == PBMPM_LIQUID || world->settings.solver == PBMPM_SOLVER_PAPER) continue;
        if (kind == PBMPM_SAND) limits_of_sand(adviser, slot);
        else limits_of_bodies(adviser, slot);
        limits_of_edges(adviser, slot);
    }
}

static const struct {
    pbmpm_advice_code code;
    const char *name, *unit;
    void (*rule)(Adviser *adviser);
} rules[] = {
    {PBMPM_ADVICE_NO_GRAVITY, "PBMPM_ADVICE_NO_GRAVITY", "", no_gravity},
    {PBMPM_ADVICE_FALLS_FOREVER, "PBMPM_ADVICE_FALLS_FOREVER", "", falls_forever},
    {PBMPM_ADVICE_IGNORED, "PBMPM_ADVICE_IGNORED", "", ignored_parameters},
    {PBMPM_ADVICE_POOL_TOO_DEEP, "PBMPM_ADVICE_POOL_TOO_DEEP", "", pool_too_deep},
    {PBMPM_ADVICE_POOL_STIRS, "PBMPM_ADVICE_POOL_STIRS", "m/s", pool_stirs},
    {PBMPM_ADVICE_MODULUS_NOT_HELD, "PBMPM_ADVICE_MODULUS_NOT_HELD", "Pa", modulus_not_held},
    {PBMPM_ADVICE_SAND_NOT_HELD, "PBMPM_ADVICE_SAND_NOT_HELD", "", sand_not_held},
    {PBMPM_ADVICE_SAND_NOT_HELD, "PBMPM_ADVICE_SAND_NOT_HELD", "", sand_lands},
    {PBMPM_ADVICE_SAND_NOT_HELD, "PBMPM_ADVICE_SAND_NOT_HELD", "", sand_slides},
    {PBMPM_ADVICE_BODY_TOO_THIN, "PBMPM_ADVICE_BODY_TOO_THIN", "cells", body_too_thin},
    {PBMPM_ADVICE_BOUNCE_DAMPED, "PBMPM_ADVICE_BOUNCE_DAMPED", "substeps", bounce_damped},
    {PBMPM_ADVICE_BOUNCE_DAMPED, "PBMPM_ADVICE_BOUNCE_DAMPED", "substeps", hit_damped},
    {PBMPM_ADVICE_ROLLING_BRAKED, "PBMPM_ADVICE_ROLLING_BRAKED", "cells", rolling_braked},
    {PBMPM_ADVICE_COLLIDER_TOO_FAST, "PBMPM_ADVICE_COLLIDER_TOO_FAST", "cells", collider_too_fast},
    {PBMPM_ADVICE_COLLIDER_TOO_THIN, "PBMPM_ADVICE_COLLIDER_TOO_THIN", "cells", collider_too_thin},
    {PBMPM_ADVICE_STEP_TOO_LONG, "PBMPM_ADVICE_STEP_TOO_LONG", "cells per substep", step_too_long},
    {PBMPM_ADVICE_VOLUME_LOST, "PBMPM_ADVICE_VOLUME_LOST", "", volume_lost},
    {PBMPM_ADVICE_STRAIN_CLAMPED, "PBMPM_ADVICE_STRAIN_CLAMPED", "", strain_clamped},
    {PBMPM_ADVICE_NOT_SOLVED, "PBMPM_ADVICE_NOT_SOLVED", "cells", not_solved},
    {PBMPM_ADVICE_OVERLAPS, "PBMPM_ADVICE_OVERLAPS", "", overlaps},
    {PBMPM_ADVICE_KNOWN_LIMIT, "PBMPM_ADVICE_KNOWN_LIMIT", "", known_limits},
    {PBMPM_ADVICE_NO_FRICTION, "PBMPM_ADVICE_NO_FRICTION", "", no_friction},
};

pbmpm_result advice_give(World *world, double dt, pbmpm_advice *array, uint32_t capacity, uint32_t *count)
{
    Adviser adviser = {.world = world, .substep = world_substep(world, dt / world->settings.substeps), .array = array, .capacity = capacity};
    const pbmpm_result result = survey_make(world, &adviser.survey);
    if (result != PBMPM_OK) return result;
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++) rules[i].rule(&adviser);
    *count = adviser.count;
    return PBMPM_OK;
}

const char *advice_name(pbmpm_advice_code code)
{
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (rules[i].code == code) return rules[i].name;
    return "PBMPM_ADVICE_UNKNOWN";
}

const char *advice_unit(pbmpm_advice_code code)
{
    for (size_t i = 0; i < sizeof rules / sizeof *rules; i++)
        if (rules[i].code == code) return rules[i].unit;
    return "";
}
