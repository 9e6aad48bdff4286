#include "services/advice_rules.h"

#include <math.h>

#include "world/depth.h"

/* ---- Gravity, and what falls ---- */

void advise_no_gravity(Adviser *adviser)
{
    const World *world = adviser->world;
    bool forced = false;
    for (uint32_t i = 0; i < world->forces.used; i++) {
        const pbmpm_force_def *def = &world->forces.slot[i].def;
        forced = forced || (world->forces.slot[i].generation != 0 && def->enabled && def->kind == PBMPM_FORCE_UNIFORM);
    }
    if (gravity_strength(world) > 0.0 || forced) return;
    pbmpm_advice advice = {.code = PBMPM_ADVICE_NO_GRAVITY, .text = "nothing falls: gravity is 0, which is its default"};
    adviser_by_value(PBMPM_CHANGE_GRAVITY, 9.81, 0.0, &advice);
    adviser_give(adviser, advice);
}

static const uint32_t GOLDEN = 2654435769u; /* 2^32 times the golden ratio's fraction */

/* Of so many particles, and of the emitters if they count, the share that has nothing below it. */
static double share_that_falls(const World *world, uint32_t samples, bool with_emitters)
{
    const Particles *p = &world->particles;
    const bool hangs = adviser_any_sticks(world);
    const uint32_t looks = p->count < samples ? p->count : samples;
    double looked = 0.0, falls = 0.0;
    for (uint32_t i = 0; i < looks; i++) {
        const uint32_t row = (uint32_t)((uint64_t)(i * GOLDEN) * p->count >> 32); /* evenly spread, and out of step with any lattice */
        if (hangs && material_is_solid(&world->materials, p->material[row])) continue;
        double at[3] = {0};
        for (int a = 0; a < p->dimension; a++) at[a] = particles_coordinate(p, row, a) * (double)world->def.cell_size;
        looked += 1.0;
        falls += !adviser_lands(world, p->material[row], at);
    }
    for (uint32_t e = 0; with_emitters && e < world->emitters.used; e++) {
        const Emitter *emitter = &world->emitters.slot[e];
        if (emitter->generation == 0) continue;
        const double at[3] = {(double)emitter->shape.position[0], (double)emitter->shape.position[1], (double)emitter->shape.position[2]};
        looked += 1.0;
        falls += !adviser_lands(world, emitter->def.material.index, at);
    }
    return looked > 0.0 ? falls / looked : 0.0;
}

/* With kill bounds, before the first step: a small share that has nothing below it sticks out behind a wall, by mistake. */
static void advise_sticks_out(Adviser *adviser)
{
    enum { SAMPLES = 1024 }; /* once in a scene */
    static const double ROW = 0.005, MEANT = 0.5; /* fewer than a row of particles at a wall; more are meant to fall */
    const double share = adviser->world->step_count == 0 ? share_that_falls(adviser->world, SAMPLES, false) : 0.0;
    if (share <= ROW || share >= MEANT) return;
    adviser_give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_FALLS_FOREVER, .figure = (float)share, .bound = (float)ROW,
                                         .text = "this share of matter was put where nothing is below it, behind a wall perhaps: it falls until the kill bounds take it out"});
}

void advise_falls_forever(Adviser *adviser)
{
    enum { SAMPLES = 64 }; /* so that advice costs the same for any number of particles */
    static const double SPRAY = 0.05; /* share of the samples: three of 64, which may be spray */
    const World *world = adviser->world;
    if (gravity_strength(world) == 0.0 || adviser_wall_below(world)) return;
    if (world->sinks.bounds.enabled) {
        advise_sticks_out(adviser);
        return;
    }
    const double share = share_that_falls(world, SAMPLES, true);
    if (share <= SPRAY) return;
    pbmpm_advice advice = {.code = PBMPM_ADVICE_FALLS_FOREVER, .figure = (float)share, .bound = (float)SPRAY,
                           .text = "this share of matter and emitters has nothing to fall on, and no kill bounds take it out: it falls for ever at full cost"};
    adviser_by_value(PBMPM_CHANGE_KILL_BOUNDS, 0.0, 0.0, &advice);
    adviser_give(adviser, advice);
}

/* ---- Speed ---- */

/* Whether what is so fast [m/s] has nothing below it that stops it, and no kill bounds. */
static bool falls_without_end(const Adviser *adviser, double speed)
{
    enum { LOOKS = 64 }; /* so many lines down */
    const World *world = adviser->world;
    const Particles *p = &world->particles;
    int looks = 0;
    if (world->sinks.bounds.enabled || gravity_strength(world) == 0.0 || adviser_wall_below(world)) return false;
    for (uint32_t row = 0; row < p->count && looks < LOOKS; row++) {
        double at[3] = {0}, speed2 = 0.0;
        for (int a = 0; a < p->dimension; a++) speed2 += (double)p->velocity[a][row] * (double)p->velocity[a][row];
        if (speed2 < speed * speed) continue;
        for (int a = 0; a < p->dimension; a++) at[a] = particles_coordinate(p, row, a) * (double)world->def.cell_size;
        if (adviser_lands(world, p->material[row], at)) return false;
        looks++;
    }
    return looks > 0;
}

void advise_step_too_long(Adviser *adviser)
{
    const World *world = adviser->world;
    const double bound = (double)world->settings.max_displacement;
    const double slowed = 0.99 * bound / adviser_cells(adviser, 1.0); /* [m/s] who was slowed to the bound is at it */
    double speed = 0.0, jet = 0.0;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) speed = fmax(speed, adviser->survey.heap[slot].speed);
    for (uint32_t e = 0; e < world->emitters.used; e++)
        if (world->emitters.slot[e].generation != 0) jet = fmax(jet, (double)world->emitters.slot[e].def.speed);
    const double cells = adviser_cells(adviser, fmax(speed, jet));
    if (cells < 0.99 * bound) return;
    pbmpm_advice advice = {.code = PBMPM_ADVICE_STEP_TOO_LONG, .figure = (float)fmax(cells, bound), .bound = (float)bound,
                           .text = "matter is faster than max_displacement allows: it is slowed"};
    if (jet < slowed && falls_without_end(adviser, slowed)) {
        advice.text = "matter falls for ever, by now as fast as max_displacement allows";
        adviser_by_value(PBMPM_CHANGE_KILL_BOUNDS, 0.0, 0.0, &advice);
    } else {
        adviser_by_substeps(adviser, fmax(2.0, cells / bound), &advice);
    }
    adviser_give(adviser, advice);
}

/* Matter that nears other matter by more than two cells in a substep steps over the nodes that both would share: of a block of
 * water of 8 cells that meets a jelly of 12 nothing is inside of it at up to 1.5 cells per substep, 0 to 0.05 at 2, 0.05 to 0.18 at 2.5 and 3, 0.2 at 5, at 60 and 240 Hz. */
void advise_enters_bodies(Adviser *adviser)
{
    static const double MEETS = 2.0; /* cells per substep: see above */
    const double cells = adviser_cells(adviser, adviser->survey.meets);
    if (cells <= MEETS) return;
    pbmpm_advice advice = {.code = PBMPM_ADVICE_STEP_TOO_LONG, .figure = (float)cells, .bound = (float)MEETS,
                           .text = "liquid and bodies that meet at more than two cells per substep enter each other"};
    adviser_by_substeps(adviser, cells / MEETS, &advice);
    adviser_give(adviser, advice);
}

/* ---- Viscous liquids ---- */

/* Whether a wall holds viscous liquid: see wall_shear.h. The paper's solver and the primal, which the convergent one is at one iteration, know what sticks alone. */
static bool holds_viscous(const World *world, pbmpm_friction friction)
{
    const pbmpm_solver solver = world->settings.solver;
    const bool follows = solver != PBMPM_SOLVER_PAPER && solver != PBMPM_SOLVER_PRIMAL && (solver != PBMPM_SOLVER_CONVERGENT || world->settings.iterations > 1);
    return friction == PBMPM_FRICTION_STICK || (follows && friction != PBMPM_FRICTION_SLIP);
}

/* Whether there are walls for matter of these groups, and none of them holds it. */
static bool all_slip(const World *world, uint32_t groups)
{
    bool any = false, holds = false;
    for (int place = 0; place < 2 * world->def.dimension; place++) {
        const pbmpm_domain_wall *wall = &world->domain.wall[place];
        any = any || !wall->open;
        holds = holds || (!wall->open && holds_viscous(world, wall->friction));
    }
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *collider = &world->colliders.slot[c];
        if (!world_feels(world, collider) || !groups_meet(collider->def.meets, groups)) continue;
        any = true;
        holds = holds || holds_viscous(world, collider->def.friction);
    }
    return any && !holds;
}

void advise_slips(Adviser *adviser)
{
    const World *world = adviser->world;
    if (gravity_strength(world) == 0.0) return;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        if (!adviser_present(world, slot) || def->kind != PBMPM_LIQUID || def->kinematic_viscosity == 0.0f || !all_slip(world, def->groups)) continue;
        adviser_give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_NO_FRICTION, .material = adviser_id_of(world, slot),
                                             .text = "a viscous liquid slips on every wall here: walls that stick hold it; with the dual, and with two or more iterations of the convergent solver, those with Coulomb friction do, too"});
    }
}

/* ---- Emitters ---- */

/* How far beyond a wall of the domain the whole of an emitter stands [m]; 0 or less if any of it may be inside. */
static double way_outside(const World *world, const Emitter *emitter)
{
    const pbmpm_shape shape = emitter_enclosing_shape(&emitter->def, &emitter->shape);
    const Solid solid = solid_of(&shape, world->def.dimension);
    double low[3], high[3], most = 0.0;
    solid_bounds(&solid, low, high);
    for (int a = 0; a < world->def.dimension; a++) most = fmax(most, fmax(world->domain.low[a] - high[a], low[a] - world->domain.high[a]));
    return most;
}

void advise_emitter_outside(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t e = 0; e < world->emitters.used; e++) {
        const Emitter *emitter = &world->emitters.slot[e];
        const double way = emitter->generation != 0 ? way_outside(world, emitter) : 0.0;
        if (way <= 0.0) continue;
        adviser_give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_EMITTER_OUTSIDE, .material = emitter->def.material, .figure = (float)(way / (double)world->def.cell_size),
                                             .text = "an emitter stands outside of the domain: it emits nothing"});
    }
}

/* An emitter whose place was full gave less than its rate, all in all. Nearly all of it is refused where a tank is full, as it should be. */
void advise_emitter_refused(Adviser *adviser)
{
    static const double MANY = 0.1; /* by trial: a tenth of a stream is what people miss */
    const World *world = adviser->world;
    for (uint32_t e = 0; e < world->emitters.used; e++) {
        const Emitter *emitter = &world->emitters.slot[e];
        const EmitterState *state = &emitter->state;
        const double due = (double)(state->emitted + state->refused_full), refused = due > 0.0 ? (double)state->refused_full / due : 0.0;
        if (emitter->generation == 0 || refused <= MANY || refused >= 1.0 - MANY) continue;
        adviser_give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_EMITTER_REFUSED, .material = emitter->def.material, .figure = (float)refused, .bound = (float)MANY, .came_true = 1,
                                             .text = "an emitter found its place full and gave less than its rate: lift it off the matter, or raise fill_limit"});
    }
}

/* ---- What came true ---- */

/* What an elastic body's strain says that it lacks: 1 - mean det F. If the iterations hold its modulus, that bears what
 * presses it, by its weight or by a plate, and no more substeps bear it better. Cells are filled by 1 / det F then, and
 * their mean over equal rooms is 1 / mean det F. */
static double lost_to_strain(const Adviser *adviser, uint32_t slot)
{
    const bool elastic = adviser->world->materials.def[slot].kind == PBMPM_ELASTIC;
    return elastic && advice_holds_modulus(adviser, slot) ? fmax(0.0, 1.0 - adviser->survey.heap[slot].kept) : 0.0;
}

/* What a solid's own modulus lets its weight take of its volume. */
static double lost_to_weight(const Adviser *adviser, uint32_t slot)
{
    const World *world = adviser->world;
    const pbmpm_material_def *def = &world->materials.def[slot];
    if (adviser_flows(def)) return 0.0;
    const double depth = adviser->survey.heap[slot].depth * (double)world->def.cell_size, poisson = (double)def->poisson_ratio;
    const double bulk = (double)def->young_modulus / (3.0 * (1.0 - 2.0 * poisson));
    return 0.5 * (double)def->density * gravity_strength(world) * depth / bulk;
}

void advise_volume_lost(Adviser *adviser)
{
    static const double UNSEEN = 0.05, SURE = 2.0; /* standard errors: of forty means one is off by more, to one side */
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const double filling = adviser->survey.heap[slot].filling;
        if (filling == 0.0 || world->step_count == 0) continue;
        const double sure = filling - SURE * adviser->survey.heap[slot].filling_error;
        if (sure <= 1.0) continue;
        const double lost = 1.0 - 1.0 / sure - fmax(lost_to_weight(adviser, slot), lost_to_strain(adviser, slot));
        if (lost <= UNSEEN) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_VOLUME_LOST, .material = adviser_id_of(world, slot), .figure = (float)lost, .bound = (float)UNSEEN, .came_true = 1,
                               .text = "matter takes less room than it should, by this share: it is crushed"};
        if (world->materials.def[slot].kind != PBMPM_SAND) adviser_by_substeps(adviser, 2.0, &advice); /* heaps below a hole are crushed as much at 120 and 240 Hz as at 60 */
        adviser_give(adviser, advice);
    }
}

void advise_strain_clamped(Adviser *adviser)
{
    static const double SPLASHED = 0.005; /* share of particles: single ones are strained to a bound in any splash */
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const double share = adviser->survey.heap[slot].clamped;
        if (share <= SPLASHED) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_STRAIN_CLAMPED, .material = adviser_id_of(world, slot), .figure = (float)share, .bound = (float)SPLASHED, .came_true = 1,
                               .text = "particles are strained to a bound of their material: they are crushed or torn"};
        adviser_by_substeps(adviser, 2.0, &advice);
        adviser_give(adviser, advice);
    }
}

/* What all matter moves by in a substep, root mean square [cells]. */
static double moved(const Adviser *adviser)
{
    double square = 0.0, particles = 0.0;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const Heap *heap = &adviser->survey.heap[slot];
        square += heap->particles * heap->moves * heap->moves;
        particles += heap->particles;
    }
    return adviser_cells(adviser, sqrt(square / fmax(particles, 1.0)));
}

/* Pressures and stresses hold motion back: what is unfinished moves too far, and is wrong by at most what moves. Where matter rests the prediction counts what moves nothing, see
 * solvers/dual/dual_error.h: 0.1 cells in a pool that moves by 0.02.
 * In a body the error falls as 1 / N with N iterations (jellies and clay that land, of 5 to 20). A liquid's falls as N^-0.4 with 5 to 40 iterations, and as s^-1.25 with 1 to 4 substeps (pools,
 * rafts, slots and waterfalls: powers of 0.9 to 1.6), a body's as s^-1.3 (a block of 1e7 Pa that lands at 20 m/s: 1.22 cells, 0.20 with four substeps). What runs through slots is nearer to the truth with substeps, too (tests/field/run.py slot --settings 60x5,60x20,120x5,240x5). */
void advise_not_solved(Adviser *adviser)
{
    static const double SEEN = 0.05, POWER = 1.25; /* cells per substep; see above */
    const double error = fmin(adviser->world->record.predicted_error, moved(adviser));
    const bool wet = adviser_any_present(adviser->world, PBMPM_LIQUID);
    const bool bodies = adviser_any_present(adviser->world, PBMPM_ELASTIC) || adviser_any_present(adviser->world, PBMPM_VISCO);
    if (error <= SEEN) return;
    pbmpm_advice advice = {.code = PBMPM_ADVICE_NOT_SOLVED, .figure = (float)error, .bound = (float)SEEN, .came_true = 1,
                           .text = wet && bodies ? "the last substep is far from solved: liquid flows as if pressed less, and bodies are too soft"
                                   : wet         ? "the last substep is far from solved: liquid flows as if pressed less"
                                                 : "the last substep is far from solved: stiffness and contact are not what they should be"};
    if (wet) adviser_by_substeps(adviser, pow(error / SEEN, 1.0 / POWER), &advice);
    else adviser_by_iterations(adviser, error / SEEN, &advice);
    if (advice.change == PBMPM_CHANGE_NONE) adviser_by_substeps(adviser, pow(error / SEEN, 1.0 / POWER), &advice);
    if (advice.change == PBMPM_CHANGE_NONE) advice.text = "the last substep is far from solved, and no setting that pays holds it: matter is too fast or too stiff, or too much is asked of it at once";
    adviser_give(adviser, advice);
}

/* Before the first step: later nobody can tell it from what was crushed. */
void advise_overlaps(Adviser *adviser)
{
    static const double JITTER = 0.01; /* share of the matter: fills that are flush overlap by the jitter of their places */
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS && world->step_count == 0; slot++) {
        const double share = adviser->survey.heap[slot].overlapping;
        if (share <= JITTER) continue;
        adviser_give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_OVERLAPS, .material = adviser_id_of(world, slot), .figure = (float)share, .bound = (float)JITTER,
                                             .text = "matter was put where there is other matter: it is crushed, and bursts or loses volume"});
    }
}
