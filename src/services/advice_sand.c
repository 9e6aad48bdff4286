#include "services/advice_rules.h"

#include <math.h>

#include "world/depth.h"

/* The dual keeps the volume of sand by pressures, as that of liquids. With the others sand bears its weight by its modulus M: a heap of height H is strained by
 * rho g H / (2 M) on average. */
static double sand_figure(const Adviser *adviser, uint32_t slot, double *bound)
{
    static const double UNSEEN = 0.05; /* mean strain: a heap that is lower by a twentieth looks as it should */
    const World *world = adviser->world;
    const pbmpm_material_def *def = &world->materials.def[slot];
    const double cells = adviser->survey.heap[slot].depth, d = world->def.dimension;
    *bound = DEEPEST;
    if (adviser_solver_of(world, slot) == PBMPM_SOLVER_DUAL) return gravity_fall(world, &adviser->substep) * cells;
    const pbmpm_effective held = adviser_held_of(adviser, slot);
    const double shear = lame_of((double)held.young_modulus, (double)def->poisson_ratio).mu, wave = (double)held.bulk_modulus + 2.0 * (d - 1.0) / d * shear;
    *bound = UNSEEN;
    return 0.5 * (double)def->density * gravity_strength(world) * cells * (double)world->def.cell_size / wave;
}

void advise_sand_not_held(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (adviser->survey.heap[slot].depth == 0.0 || world->materials.def[slot].kind != PBMPM_SAND) continue;
        double bound;
        const double figure = sand_figure(adviser, slot, &bound);
        if (figure <= bound) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_SAND_NOT_HELD, .material = adviser_id_of(world, slot), .figure = (float)figure, .bound = (float)bound};
        advice.text = bound == DEEPEST ? "the sand is too deep for the rate: it is compressed by its weight, and flows too fast"
                                       : "the iterations do not hold the sand's modulus: it is crushed by its weight";
        adviser_by_substeps(adviser, sqrt(figure / bound), &advice);
        adviser_give(adviser, advice);
    }
}

/* Speed at which matter lands that falls freely from where it is, in cells per substep. */
static double landing(const Adviser *adviser, uint32_t slot, double drop)
{
    const World *world = adviser->world;
    const double cell = (double)world->def.cell_size, speed = adviser->survey.heap[slot].speed;
    return sqrt(speed * speed + 2.0 * gravity_strength(world) * drop * cell) * adviser->substep.dt / cell;
}

static const double FALLS = 4.0;   /* cells: less may be between the pieces of what falls */
static const double CRUSHED = 5.0; /* cells per substep: a second later a block of 16 cells has 0.95 to 0.98 of its volume with 4.8, 0.91 with 6 and 0.80 with 8 */
static const double POURED = 4.0;  /* the same of a stream: 0.3 s after the last of it 0.98 with 2, 0.96 with 3, 0.94 with 4, and 0.60 with 5 */

/* What lands is stopped within a substep, and crushed by its way in it (tests/granular_landing.py). */
void advise_sand_lands(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const double drop = adviser->survey.heap[slot].drop_half;
        if (!adviser_present(world, slot) || world->materials.def[slot].kind != PBMPM_SAND) continue;
        const double falls = drop < FALLS ? 0.0 : landing(adviser, slot, drop), poured = adviser_emitted_landing(adviser, slot);
        const bool stream = poured / POURED > falls / CRUSHED;
        const double cells = stream ? poured : falls, bound = stream ? POURED : CRUSHED;
        if (cells <= bound) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_SAND_NOT_HELD, .material = adviser_id_of(world, slot), .figure = (float)cells, .bound = (float)bound,
                               .text = stream ? "sand that is poured at more than four cells per substep is crushed where it lands, for a second or two"
                                              : "sand that lands at more than five cells per substep is crushed there for a second or two"};
        adviser_by_substeps(adviser, cells / bound, &advice);
        adviser_give(adviser, advice);
    }
}

/* The friction of a substep acts where its grains are at the start: what goes C cells in it is braked C cells too late. Piles of 50 and 40 degrees and columns, which slide with C of 1.2 to 2.3 at 60 Hz by the fall
 * of their mean depth, come to rest flatter than at 480 Hz by 0 to 5 degrees, half of it by 3 or more; at 120 Hz by 0 to 4.
 * What lands is another matter. Blocks that fall by 5 to 40 cells on a floor, with 1.2 to 3.3 cells per substep, end flatter than at 480 Hz by 1.6 to 2.5 degrees.
 * Heaps below funnels are nearly as steep as at 240 Hz, with 17.7 and 17.3 degrees, not 18.0 and 18.2. Where sand lands with 5.3 cells per substep they have 8.3, not 19.5
 * (tests/field/run.py pile_slumps column funnel --settings 60x5,240x5): only what is crushed, see above, spreads. */
void advise_sand_slides(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const Heap *heap = &adviser->survey.heap[slot];
        if (!adviser_present(world, slot) || world->materials.def[slot].kind != PBMPM_SAND) continue;
        const double fall = 2.0 * gravity_fall(world, &adviser->substep); /* v^2 = 2 g h */
        const double lands = sqrt(fall * heap->drop_most), slides = heap->steep > STEEP ? sqrt(fall * fmin(heap->slide, heap->depth)) : 0.0;
        const bool crushed = lands > CRUSHED;
        if (!crushed && slides <= 1.0) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_SAND_NOT_HELD, .material = adviser_id_of(world, slot), .figure = (float)(crushed ? lands : slides), .bound = (float)(crushed ? CRUSHED : 1.0),
                               .text = crushed ? "sand that lands at more than five cells per substep spreads: it comes to rest too flat, by up to ten degrees"
                                               : "sand that slides at more than a cell per substep comes to rest too flat, by up to five degrees"};
        if (heap->hole == 0.0 || !crushed) adviser_by_substeps(adviser, (double)advice.figure / (double)advice.bound, &advice); /* below a hole of four cells a heap of 30 degrees had 19 at 60 Hz, 11 with four substeps and at 240 Hz */
        adviser_give(adviser, advice);
    }
}

/* What runs out of a hole as wide as D goes by sqrt(g D) (W. Beverloo, H. Leniger, J. van de Velde, 1961), so by C cells per substep. Where it rested above the hole it runs 0.80 to 0.90 times as
 * fast as at 480 Hz with C of 1.3 to 1.9, and 0.63 to 0.88 times with 2.1 to 3.7: out of level floors and funnels of 45 degrees, which rub with 0.4. What falls in runs on: in hourglasses 0.95 to 1.05 times as
 * fast with C up to 1.8, 1.2 to 1.3 times with 1.9 to 2.6, and 2 to 3.3 times with 2.8 to 4 (tests/field/run.py silo hourglass --settings 20x5,30x5,45x5,60x5,480x5). */
void advise_sand_runs(Adviser *adviser)
{
    static const double RESTED = 2.0, FELL = 2.7; /* cells per substep: see above */
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const Heap *heap = &adviser->survey.heap[slot];
        const double cells = sqrt(gravity_fall(world, &adviser->substep) * heap->hole), bound = heap->drop_half < FALLS ? RESTED : FELL;
        if (world->materials.def[slot].kind != PBMPM_SAND || cells <= bound) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_SAND_NOT_HELD, .material = adviser_id_of(world, slot), .figure = (float)cells, .bound = (float)bound,
                               .text = bound == FELL ? "sand that falls in and runs out of a hole at more than 2.7 cells per substep runs twice too fast, or more"
                                                     : "sand that runs out of a hole at more than two cells per substep runs too slowly, by up to a third"};
        adviser_by_substeps(adviser, cells / bound, &advice);
        adviser_give(adviser, advice);
    }
}

/* Whether any of some particles or emitters of a material has no obstacle below it. */
static bool reaches_domain(const World *world, uint32_t slot)
{
    enum { SAMPLES = 64 }; /* so that advice costs the same for any number of particles */
    const Particles *p = &world->particles;
    const uint32_t stride = 1 + p->of_material[slot] / SAMPLES;
    uint32_t number = 0;
    for (uint32_t row = 0; row < p->count; row++) {
        if (p->material[row] != slot || number++ % stride != 0) continue;
        double at[3] = {0};
        for (int a = 0; a < p->dimension; a++) at[a] = particles_coordinate(p, row, a) * (double)world->def.cell_size;
        if (!adviser_lands(world, slot, at)) return true;
    }
    for (uint32_t e = 0; e < world->emitters.used; e++) {
        const Emitter *emitter = &world->emitters.slot[e];
        const double at[3] = {(double)emitter->shape.position[0], (double)emitter->shape.position[1], (double)emitter->shape.position[2]};
        if (emitter->generation != 0 && emitter->def.material.index == slot && !adviser_lands(world, slot, at)) return true;
    }
    return false;
}

/* The friction that holds a heap together acts on its base, too. */
void advise_no_friction(Adviser *adviser)
{
    static const double LITTLE = 0.05; /* coefficient: a slope of three degrees, which nobody takes for a heap */
    const World *world = adviser->world;
    const pbmpm_domain_wall *floor = adviser_wall_below(world);
    for (uint32_t slot = 0; floor && slot < PBMPM_MAX_MATERIALS; slot++) {
        if (!adviser_present(world, slot) || world->materials.def[slot].kind != PBMPM_SAND || floor->friction != PBMPM_FRICTION_COULOMB) continue;
        if ((double)floor->friction_coefficient >= LITTLE || !reaches_domain(world, slot)) continue;
        adviser_give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_NO_FRICTION, .material = adviser_id_of(world, slot), .figure = floor->friction_coefficient, .bound = (float)LITTLE,
                                             .text = "sand makes no heap on the domain's floor, which has no friction: give the domain some"});
    }
}
