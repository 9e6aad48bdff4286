/* Contact of balls: H. Hertz, 1881, as in L. Landau, E. Lifshitz, Theory of Elasticity, 1986, section 9. */
#include "services/advice_rules.h"

#include <math.h>

#include "solvers/passes.h"
#include "world/depth.h"

bool advice_holds_modulus(const Adviser *adviser, uint32_t slot)
{
    static const double ENOUGH = 0.8; /* share of a modulus: a body that is softer by a fifth looks as it should */
    const double own = (double)adviser->world->materials.def[slot].young_modulus;
    return (double)adviser_held_of(adviser, slot).young_modulus >= ENOUGH * own;
}

/* N iterations hold a stiffness that grows with N^2 and with 1/dt^2. A softer body looks the same at any rate and costs nothing. */
void advise_modulus_not_held(Adviser *adviser)
{
    static const double MOST_ITERATIONS = 100.0; /* what takes more is dearer than smaller cells */
    const World *world = adviser->world;
    if (world->settings.solver == PBMPM_SOLVER_PAPER) return; /* it has none, which ignored_of_solid() tells */
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        if (!adviser_present(world, slot) || adviser_flows(def) || def->kind == PBMPM_SAND) continue;
        const double held = (double)adviser_held_of(adviser, slot).young_modulus, own = (double)def->young_modulus;
        if (advice_holds_modulus(adviser, slot)) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_MODULUS_NOT_HELD, .material = adviser_id_of(world, slot), .figure = (float)held, .bound = (float)own,
                               .text = "the iterations do not hold the modulus: the body is softer than its material"};
        const double factor = sqrt(own / held);
        if (factor * world->settings.iterations <= MOST_ITERATIONS) adviser_by_iterations(adviser, factor, &advice);
        if (advice.change == PBMPM_CHANGE_NONE) adviser_by_value(PBMPM_CHANGE_YOUNG_MODULUS, held, 0.0, &advice);
        adviser_give(adviser, advice);
    }
}

/* A spline reaches 1.5 cells: a body of fewer than three has no inside. Thicker ones float too high among what the grid blurs of the liquid. */
void advise_body_too_thin(Adviser *adviser)
{
    static const double INSIDE = 3.0; /* [cells] twice a reach */
    static const double AFLOAT = 6.5; /* [cells] by trial: bodies of six float too high, of seven right (tests/field/run.py floats) */
    const World *world = adviser->world;
    const double bound = adviser_any_present(world, PBMPM_LIQUID) ? AFLOAT : INSIDE;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        const double thickness = adviser->survey.heap[slot].thickness;
        if (thickness == 0.0 || def->kind == PBMPM_SAND || adviser_flows(def) || thickness >= bound) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_BODY_TOO_THIN, .material = adviser_id_of(world, slot), .figure = (float)thickness, .bound = (float)bound,
                               .text = bound == AFLOAT ? "a body is thin for the grid: it floats too high or too deep, by up to a cell"
                                                       : "a body is thin for the grid: it bends and bears less truly"};
        adviser_by_cells(adviser, ceil(bound) / thickness, &advice);
        adviser_give(adviser, advice);
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
void advise_bounce_damped(Adviser *adviser)
{
    static const double KEPT = 0.6; /* share of a bounce's speed: less is seen */
    const World *world = adviser->world;
    const double bound = PI * PI / (2.0 * log(1.0 / KEPT));
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_def *def = &world->materials.def[slot];
        const double radius = radius_of(adviser, slot);
        if (radius == 0.0 || def->kind != PBMPM_ELASTIC || adviser_solver_of(world, slot) != PBMPM_SOLVER_DUAL) continue;
        const double speed = fmax(adviser->survey.heap[slot].speed, sqrt(2.0 * gravity_strength(world) * 2.0 * radius)); /* or a fall by its own height */
        const double steps = contact_of(adviser, slot, speed) / adviser->substep.dt;
        if (steps >= bound) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_BOUNCE_DAMPED, .material = adviser_id_of(world, slot), .figure = (float)steps, .bound = (float)bound,
                               .text = "a contact lasts too few substeps for the dual solver: the body bounces less than its material would"};
        adviser_by_value(PBMPM_CHANGE_SOLVER, PBMPM_SOLVER_CONVERGENT, (double)UNKNOWN_PRICE, &advice);
        adviser_give(adviser, advice);
    }
}

/* What its own weight flattens a ball by (Hertz): (3 m g / (4 E' sqrt(R)))^(2/3) [m]. */
static double sag_of(const Adviser *adviser, uint32_t slot)
{
    const pbmpm_material_def *def = &adviser->world->materials.def[slot];
    const double radius = radius_of(adviser, slot), weight = 4.0 / 3.0 * PI * (double)def->density * radius * radius * radius * gravity_strength(adviser->world);
    return pow(3.0 * weight / (4.0 * contact_modulus(def) * sqrt(radius)), 2.0 / 3.0);
}

/* Whether bodies of a material are round, the primal's, and fall freely onto obstacles. */
static bool falls_as_ball(const Adviser *adviser, uint32_t slot)
{
    static const double FALLS = 2.0; /* [cells] less is within the reach of splines before it lands */
    const Heap *heap = &adviser->survey.heap[slot];
    const bool ball = heap->round && heap->thickness > 0.0 && adviser->world->materials.def[slot].kind == PBMPM_ELASTIC;
    return ball && !heap->on_matter && heap->drop_least >= FALLS && adviser_solver_of(adviser->world, slot) == PBMPM_SOLVER_PRIMAL;
}

/* Balls of eight cells and 3e4 to 1e6 Pa that fell by 0.8 and 1.7 sags bounce with nothing of their speed, by 2.7 to 3.8 with 0.46 to 0.57, by 5 with 0.65 and by 20 and more with 0.69 to 0.88, at
 * 60 Hz x 5 (as tests/field/run.py bouncing_ball); by 0.8 sags at 240 Hz with 0.46. */
void advise_soft_bounce(Adviser *adviser)
{
    static const double SAGS = 4.0; /* see above */
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (world->def.dimension != 3 || !falls_as_ball(adviser, slot)) continue;
        if (adviser->survey.heap[slot].drop_least * (double)world->def.cell_size >= SAGS * sag_of(adviser, slot)) continue;
        adviser_give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_KNOWN_LIMIT, .material = adviser_id_of(world, slot),
                                             .text = "a ball that falls by less than four times what its own weight flattens it hardly bounces"});
    }
}

/* The primal gives a body back what a substep took from it while it is pushed, but a contact of few substeps is found late and let go late. Balls and discs of twelve cells and 1e5 to 1e7 Pa that fall by
 * 0.4 to 2.5 m bounce, by the substeps that Hertz's contact lasts, with this share of the speed that they have at 960 Hz x 10: 0.74 to 0.87 with 2 to 7.5, 0.80 to 0.88 with 7.5 to 9, 0.88 to 0.96 with
 * 9.5 to 12, 0.94 and more from 13 on; with 1.5 to 2, 0.78 to 0.95. */
void advise_ball_damped(Adviser *adviser)
{
    static const double SHORT = 7.5; /* substeps: with fewer a ball rises less than three quarters as high, see above */
    static const double LONG = 10.0; /* substeps: with more it rises nine tenths as high */
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (!falls_as_ball(adviser, slot)) continue;
        const Heap *heap = &adviser->survey.heap[slot];
        const double speed = sqrt(heap->speed * heap->speed + 2.0 * gravity_strength(world) * heap->drop_least * (double)world->def.cell_size);
        const double steps = contact_of(adviser, slot, speed) / adviser->substep.dt;
        if (steps >= SHORT) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_BOUNCE_DAMPED, .material = adviser_id_of(world, slot), .figure = (float)steps, .bound = (float)SHORT,
                               .text = "a ball's contact lasts too few substeps: it bounces with up to a quarter less speed than it should"};
        adviser_by_substeps(adviser, LONG / steps, &advice);
        adviser_give(adviser, advice);
    }
}

static bool solid_among_others(const World *world, uint32_t slot)
{
    for (uint32_t other = 0; other < PBMPM_MAX_MATERIALS; other++)
        if (other != slot && adviser_present(world, other) && world->materials.def[other].kind == PBMPM_ELASTIC) return true;
    return false;
}

/* Bodies that hit each other share nodes, and leave each other only after enough substeps: discs of 16 cells keep nothing of their speed in contacts of less than 10,
 * 0.35 in 14, 0.54 in 19, 0.62 in 23 (two discs as in tests/field/run.py collision, of 3e4 to 3e5 Pa, at 60 to 240 Hz). */
void advise_hit_damped(Adviser *adviser)
{
    static const double BOUND = 23.0; /* substeps of a contact: with them discs kept 0.62, see above */
    static const double FAST = 0.1;   /* [cells per substep] slower bodies do not hit, they settle */
    const World *world = adviser->world;
    if (solver_holds_liquid(world)) return; /* there bodies do not bounce anyway: what they have to push away takes their speed */
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const Heap *heap = &adviser->survey.heap[slot];
        const bool fast = heap->speed * adviser->substep.dt > FAST * (double)world->def.cell_size;
        if (!fast || radius_of(adviser, slot) == 0.0 || world->materials.def[slot].kind != PBMPM_ELASTIC || adviser_solver_of(world, slot) != PBMPM_SOLVER_PRIMAL) continue;
        const double steps = contact_of(adviser, slot, heap->speed) / adviser->substep.dt;
        if (steps >= BOUND || !solid_among_others(world, slot)) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_BOUNCE_DAMPED, .material = adviser_id_of(world, slot), .figure = (float)steps, .bound = (float)BOUND,
                               .text = "bodies that hit each other stay together: their contact lasts too few substeps"};
        adviser_by_substeps(adviser, BOUND / steps, &advice);
        adviser_give(adviser, advice);
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
void advise_rolling_braked(Adviser *adviser)
{
    const World *world = adviser->world;
    if (gravity_strength(world) == 0.0 || !any_rubs(world) || solver_holds_liquid(world)) return; /* bodies among liquid may float */
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const Heap *heap = &adviser->survey.heap[slot];
        if (heap->thickness == 0.0 || !heap->round || world->materials.def[slot].kind != PBMPM_ELASTIC) continue;
        const double cells = patch_of(adviser, slot) / (double)world->def.cell_size;
        if (cells >= 1.0) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_ROLLING_BRAKED, .material = adviser_id_of(world, slot), .figure = (float)cells, .bound = 1.0f,
                               .text = "a round body rests on less than the grid resolves: it rolls too slowly"};
        adviser_by_cells(adviser, 1.0 / cells, &advice);
        if (advice.change == PBMPM_CHANGE_NONE) advice.text = "a round body rests on far less than the grid resolves: it rolls too slowly, and no setting helps";
        adviser_give(adviser, advice);
    }
}
