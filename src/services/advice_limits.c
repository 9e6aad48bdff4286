#include "services/advice_rules.h"

#include <math.h>

#include "solvers/dual/dual.h"
#include "world/depth.h"

static void tell_limit(Adviser *adviser, uint32_t slot, const char *text)
{
    adviser_give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_KNOWN_LIMIT, .material = adviser_id_of(adviser->world, slot), .text = text});
}

/* Whether any liquid is lighter, or denser, than a body. */
static bool sinks(const World *world, const pbmpm_material_def *body)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (adviser_present(world, slot) && adviser_flows(&world->materials.def[slot]) && world->materials.def[slot].density < body->density) return true;
    return false;
}

/* A column runs out by 1.2 times its height over its width, in widths (G. Lube, H. Huppert, S. Sparks, M. Freundt, "Collapses of two-dimensional granular columns", Phys.
 * Rev. E 72, 2005); where it falls both ways, half its width counts. Beyond its width it is far (tests/field/run.py column tilted_tray --settings 60x5,240x5: 0.06 of the
 * volume is lost with 1.2 widths, 0.03 with 0.6). */
static bool slides_far(const Heap *heap)
{
    static const double RUN_OUT = 1.2; /* widths, by the law of Lube et al.: see above */
    return RUN_OUT * fmin(heap->slide, heap->depth) > heap->width * (heap->falls_both_ways ? 0.5 : 1.0);
}

static void limits_of_sand(Adviser *adviser, uint32_t slot)
{
    const World *world = adviser->world;
    const Heap *heap = &adviser->survey.heap[slot];
    if (adviser_any_present(world, PBMPM_LIQUID)) tell_limit(adviser, slot, "sand in liquid does not settle: both move as one mixture, and go on stirring");
    if (heap->steep > STEEP) tell_limit(adviser, slot, "sand starts to slide up to eight degrees too steep");
    if (heap->steep > STEEP && slides_far(heap)) tell_limit(adviser, slot, "sand that slides far loses up to seven percent of its volume");
}

/* What holds a body up acts on the nodes that its splines reach, up to NODE_REACH cells beyond it: a weight that lies beyond its edge by less is borne, or tips it slowly. */
static void limits_of_edges(Adviser *adviser, uint32_t slot)
{
    const World *world = adviser->world;
    const double lever = adviser->survey.heap[slot].lever;
    if (lever <= 0.0 || lever >= NODE_REACH || adviser_any_sticks(world) || adviser_any_present(world, PBMPM_LIQUID)) return; /* in liquid it may float */
    tell_limit(adviser, slot, "a body's weight lies beyond its edge by less than the grid resolves: it tips too slowly, or stands");
}

/* Motion is one per node: what lies between two of them moves with both. */
static void limits_of_bodies(Adviser *adviser, uint32_t slot)
{
    static const double FALLS = 2.0;    /* [cells] less is within the reach of splines before it lands */
    static const double FALLS_IN = 0.5; /* [cells] a body that is put afloat stands by less above its place */
    const World *world = adviser->world;
    const pbmpm_material_def *def = &world->materials.def[slot];
    const Heap *heap = &adviser->survey.heap[slot];
    const bool wet = adviser_any_present(world, PBMPM_LIQUID), loose = heap->on_matter && !adviser_any_sticks(world), falls = loose && heap->drop_least > FALLS; /* or it may hang */
    if (adviser_any_present(world, PBMPM_SAND) && falls)
        tell_limit(adviser, slot, dual_holds_solids(world, &adviser->substep) ? "a body that falls on sand may stop a cell or two above it"
                                                                             : "a body as stiff as this that falls on sand springs back, or stops a cell or two above it");
    if (heap->hangs) tell_limit(adviser, slot, "a body that nothing bears hangs on the one above it: less than two cells apart they share nodes, and do not part");
    /* A body of ten cells and 800 kg/m^3 with a film on 11 of 12 columns floats deeper by 0.06 of its height, with one on 6 of 13 by 0.01; lighter ones have one on 0 or 1 (tests/field/run.py floats). */
    if (heap->film > 0.5 && adviser_floats(world, def)) tell_limit(adviser, slot, "a film of liquid stays on a floating body, which floats deeper by the film's weight");
    if (wet && heap->narrow > 0.5) tell_limit(adviser, slot, "a body with less than five cells to the walls on both sides hangs in a liquid");
    /* A jelly of 5e4 or 2e5 Pa and ten cells that is put afloat has the strain of hydrostatics, at 60 and 240 Hz; one that fell by 1 to 12 cells two to four times that. */
    if (wet && loose && heap->drop_least > FALLS_IN) tell_limit(adviser, slot, "a body that fell into a liquid stays squeezed, by some percent more than one that was put there afloat");
    if (sinks(world, def) && !heap->lies) tell_limit(adviser, slot, "a body that sinks in a liquid stops a cell above the floor, and glides as on ice; the level errs by up to half a cell");
    if (wet && falls) tell_limit(adviser, slot, "where a body fell into a liquid, the liquid goes on moving by centimetres per second, or heaves");
}

void advise_known_limits(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const pbmpm_material_kind kind = world->materials.def[slot].kind;
        if (!adviser_present(world, slot) || kind == PBMPM_LIQUID || world->settings.solver == PBMPM_SOLVER_PAPER) continue;
        if (kind == PBMPM_SAND) limits_of_sand(adviser, slot);
        else limits_of_bodies(adviser, slot);
        limits_of_edges(adviser, slot);
    }
}
