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

/* What lands in one piece is stopped within a substep, and crushed by its way in it (tests/field/run.py falls --settings 60x5,90x5,120x5,240x5). So is a stream: of what an emitter 8 cells wide
 * brings nothing is lost with 2, 3 and 4 cells per substep, 0.15 with 5 and 0.28 with 6. */
void advise_sand_lands(Adviser *adviser)
{
    static const double FALLS = 4.0; /* cells: less may be between the pieces of what falls */
    static const double CRUSHED = 4.0; /* a block of 16 cells keeps 0.994 of its volume with 3.2, and 0.88 with 4.8 */
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const double drop = adviser->survey.heap[slot].drop_half;
        if (!adviser_present(world, slot) || world->materials.def[slot].kind != PBMPM_SAND) continue;
        const double cells = fmax(drop < FALLS ? 0.0 : landing(adviser, slot, drop), adviser_emitted_landing(adviser, slot));
        if (cells <= CRUSHED) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_SAND_NOT_HELD, .material = adviser_id_of(world, slot), .figure = (float)cells, .bound = (float)CRUSHED,
                               .text = "sand that lands at more than four cells per substep is crushed there for a second or two"};
        adviser_by_substeps(adviser, cells / CRUSHED, &advice);
        adviser_give(adviser, advice);
    }
}

/* The friction of a substep acts where its grains are at the start. What goes C cells in it is braked C cells too late, an error of the first order in C. A pile of 21 cells that
 * slides has C = 1.9 at 60 Hz and 0.5 at 240 Hz by the fall of its mean depth; with 25, 30 and 35 degrees it comes to rest flatter by 1.7, 1.9 and 2.6 degrees
 * per unit of C, at 60, 90, 120, 180 and 240 Hz (tests/field/run.py pile_slumps). One cell is a tenth of an angle of repose. */
void advise_sand_slides(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const Heap *heap = &adviser->survey.heap[slot];
        if (!adviser_present(world, slot) || world->materials.def[slot].kind != PBMPM_SAND) continue;
        const double drop = fmax(heap->drop_most, heap->steep > STEEP ? fmin(heap->slide, heap->depth) : 0.0);
        const double cells = fmax(sqrt(2.0 * gravity_fall(world, &adviser->substep) * drop), adviser_emitted_landing(adviser, slot)); /* v^2 = 2 g h */
        if (cells <= 1.0) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_SAND_NOT_HELD, .material = adviser_id_of(world, slot), .figure = (float)cells, .bound = 1.0f,
                               .text = "sand that slides or lands at more than a cell per substep comes to rest too flat, by up to ten degrees"};
        if (heap->hole == 0.0) adviser_by_substeps(adviser, cells, &advice); /* below a hole of four cells a heap of 30 degrees had 19 at 60 Hz, 11 with four substeps and at 240 Hz */
        adviser_give(adviser, advice);
    }
}

/* What runs out of a hole as wide as D goes by sqrt(g D) (W. Beverloo, H. Leniger, J. van de Velde, 1961), so by C cells per substep, and is braked too late, see above. Between boards that
 * lean by 50 degrees it runs 1.49, 1.55 times as fast as at 240 Hz with C = 1.3, 1.6, and 1.03, 1.13 times with 0.9, 0.7. Over a level floor it is uneven: 1.15, 1.12 times as fast later with
 * 1.9, 1.3, and 0.92, 1.05 times with 0.5, 0.3 (tests/field/run.py silo --settings 60x5,240x5). */
void advise_sand_runs(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const double cells = sqrt(gravity_fall(world, &adviser->substep) * adviser->survey.heap[slot].hole);
        if (world->materials.def[slot].kind != PBMPM_SAND || cells <= 1.0) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_SAND_NOT_HELD, .material = adviser_id_of(world, slot), .figure = (float)cells, .bound = 1.0f,
                               .text = "sand that runs out of a hole at more than a cell per substep runs unevenly, and up to 1.6 times too fast"};
        adviser_by_substeps(adviser, cells, &advice);
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
