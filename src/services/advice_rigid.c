#include "services/advice_rules.h"

#include <math.h>

#include "base/vector.h"
#include "services/rigid.h"
#include "shape/mass.h"
#include "shape/shapes.h"
#include "world/depth.h"

/* A body that pbmpm_rigid_advance() moved; null if there is none in this place. */
static const Collider *body_at(const World *world, uint32_t place)
{
    const Collider *collider = &world->colliders.slot[place];
    return collider->generation != 0 && collider->body ? collider : NULL;
}

static Solid solid_where(const World *world, const Collider *collider)
{
    Solid solid = solid_of(&collider->shape, world->def.dimension);
    solid.grid = collider->grid;
    return solid;
}

/* Whether its centre does, by the last advance: columns that it has not are 0. */
static bool moves(const Collider *body)
{
    for (int k = 0; k < FREE_BODY_WAYS; k++)
        if (dot3(body->body->way[k], body->body->way[k]) > 0.0) return true;
    return false;
}

/* ---- On elastic bodies ---- */

/* The mass that gravity has to move [kg], by the last advance (its other columns are 0); infinite where it moves nothing. */
static double mass_of(const World *world, const Collider *collider)
{
    double down[3], yields = 0.0;
    gravity_direction(world, down);
    for (int k = 0; k < FREE_BODY_WAYS; k++) {
        const double along = dot3(collider->body->way[k], down);
        yields += along * along;
    }
    return yields > 0.0 ? 1.0 / yields : INFINITY;
}

/* Whether matter of a material is as near as splines reach from one to the other. */
static bool touches(const World *world, uint32_t slot, const Collider *collider)
{
    const Particles *p = &world->particles;
    const Solid solid = solid_where(world, collider);
    for (uint32_t row = 0; row < p->count; row++) {
        double at[3] = {0};
        if (p->material[row] != slot) continue;
        for (int a = 0; a < p->dimension; a++) at[a] = particles_coordinate(p, row, a) * (double)world->def.cell_size;
        if (solid_gap(&solid, at) < NODE_REACH * (double)world->def.cell_size) return true;
    }
    return false;
}

static double mass_of_material(const World *world, uint32_t slot)
{
    const Particles *p = &world->particles;
    double sum = 0.0;
    for (uint32_t row = 0; row < p->count; row++) sum += p->material[row] == slot ? (double)p->mass[row] : 0.0;
    return sum * world_cell_volume(world);
}

/* Whether all solids of islands that bodies touch are the primal's, to which they yield at once: see primal_yield.h. */
static bool yields_at_once(const World *world)
{
    const pbmpm_solver solver = world->settings.solver;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (adviser_present(world, slot) && (adviser_flows(&world->materials.def[slot]) || world->materials.def[slot].kind == PBMPM_SAND)) return false;
    return solver == PBMPM_SOLVER_CONVERGENT || solver == PBMPM_SOLVER_PRIMAL;
}

/* Beside liquid and sand a rigid body yields to solids one step after they pushed it. Such a pair gains energy from k dt^2 / m = 4 on, as a spring whose force is a step old. Pressed matter of the thickness T
 * and the mass M has k = E A / T = M (c / T)^2 with the speed of sound c, c^2 = E / rho. Planks and boxes on crates were thrown off at 3 to 40, and calm at 2.5. */
static void thrown_off_by(Adviser *adviser, uint32_t slot)
{
    static const double HOLDS = 2.5; /* by trial: see above; theory says 4 of one spring and one mass */
    const World *world = adviser->world;
    const pbmpm_material_def *def = &world->materials.def[slot];
    const double dt = adviser->substep.dt * world->settings.substeps, thickness = adviser->survey.heap[slot].thickness * (double)world->def.cell_size;
    if (yields_at_once(world)) return;
    const double crossings = dt * sqrt((double)def->young_modulus / (double)def->density) / fmax(thickness, (double)world->def.cell_size);
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *collider = &world->colliders.slot[c];
        if (collider->generation == 0 || !collider->body) continue;
        if (crossings * crossings * mass_of_material(world, slot) <= HOLDS * mass_of(world, collider) || !touches(world, slot, collider)) continue;
        adviser_give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_KNOWN_LIMIT, .material = adviser_id_of(world, slot), .collider = {c, collider->generation},
                                             .text = "a rigid body that touches matter as stiff as this is thrown off: more steps per second hold it, substeps and iterations do not"});
    }
}

void advise_rigid_thrown_off(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (adviser_present(world, slot) && world->materials.def[slot].kind == PBMPM_ELASTIC && world->settings.solver != PBMPM_SOLVER_PAPER) thrown_off_by(adviser, slot);
}

/* ---- On sand ---- */

/* Whether matter of a material lies below a body: under the box around it, along the axis of gravity. */
static bool stands_over(const World *world, const Collider *body, uint32_t slot)
{
    const Particles *p = &world->particles;
    const Solid solid = solid_where(world, body);
    const int down = survey_axis_of_gravity(world);
    const double cell = (double)world->def.cell_size, way = world->settings.gravity[down] > 0.0f ? 1.0 : -1.0;
    double low[3], high[3];
    solid_bounds(&solid, low, high);
    for (uint32_t row = 0; row < p->count; row++) {
        bool below = p->material[row] == slot;
        for (int a = 0; a < p->dimension && below; a++) {
            const double at = particles_coordinate(p, row, a) * cell;
            below = a == down ? way * (at - 0.5 * (low[a] + high[a])) > 0.0 : at > low[a] && at < high[a];
        }
        if (below) return true;
    }
    return false;
}

/* Only bodies that pbmpm_rigid_advance() moves: what the host moves, or what turns about a pivot, stands wherever it is put. */
void advise_rigid_on_sand(Adviser *adviser)
{
    const World *world = adviser->world;
    const double substeps = world->settings.substeps, fall = gravity_fall(world, &adviser->substep) * substeps * substeps; /* in a step: a rigid body moves once in it */
    if (survey_axis_of_gravity(world) < 0 || fall <= COARSE_FALL || world->settings.solver == PBMPM_SOLVER_PAPER) return;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        for (uint32_t place = 0; place < world->colliders.used && world->materials.def[slot].kind == PBMPM_SAND && adviser_present(world, slot); place++) {
            const Collider *body = body_at(world, place);
            if (!body || !moves(body) || !stands_over(world, body, slot)) continue;
            adviser_give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_KNOWN_LIMIT, .material = adviser_id_of(world, slot), .collider = {place, body->generation},
                                                 .text = "a rigid body on sand rocks and sinks in: more steps per second hold it better, substeps hardly do"});
        }
}

/* ---- In liquid ---- */

/* [kg/m^3] of the densest liquid that a body touches, or of all without a body; 0: there is none. */
static double densest_liquid(const World *world, const Collider *body)
{
    double densest = 0.0;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const double density = (double)world->materials.def[slot].density;
        if (adviser_present(world, slot) && adviser_flows(&world->materials.def[slot]) && density > densest && (!body || touches(world, slot, body))) densest = density;
    }
    return densest;
}

/* The grid rounds corners: of the liquid that a body displaces it misses a layer of about a tenth of a cell, the share 2 d / 10 s of a cube with sides of s cells. Held cubes and balls, turned and off the
 * grid, lack up to 0.24 of their lift with 3 cells in 3D, 0.10 with 4, 0.09 with 6 and 0.08 with 8; in 2D 0.10 with 3, 0.12 with 4 and 0.09 with 6
 * (tests/rigid_in_water.py). */
static double lift_missing(int dimension, double cells)
{
    static const double LAYER = 0.1; /* [cells] see above */
    return 2.0 * dimension * LAYER / cells;
}

/* What floats by less than the grid misses of its lift sinks. */
void advise_rigid_sinks(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t place = 0; place < world->colliders.used && world->settings.solver != PBMPM_SOLVER_PAPER; place++) {
        const Collider *body = body_at(world, place);
        if (!body || !moves(body)) continue;
        const Solid solid = solid_where(world, body);
        const double liquid = densest_liquid(world, body), cells = solid_breadth(&solid) / (double)world->def.cell_size;
        const double floats = liquid > 0.0 ? 1.0 - mass_of(world, body) / (liquid * solid_volume(&solid)) : 0.0, missing = lift_missing(world->def.dimension, cells);
        if (floats <= 0.0 || missing <= floats) continue;
        pbmpm_advice advice = {.code = PBMPM_ADVICE_BODY_TOO_THIN, .collider = {place, body->generation}, .figure = (float)cells, .bound = (float)(cells * missing / floats),
                               .text = "a rigid body is nearly as dense as the liquid and too small for the grid, which misses some of its lift: it may sink"};
        adviser_by_cells(adviser, missing / floats, &advice);
        adviser_give(adviser, advice);
    }
}

/* At faces oblique to the grid an even pressure has a moment about a ball's centre. Balls of half of water's density turn at 0.4 to 1.6 rad/s with 4 to 16 cells, and at 0.1 with 24
 * (tests/rigid_in_water.py). */
void advise_rigid_turns(Adviser *adviser)
{
    static const double SLOWLY = 24.0; /* cells: see above */
    const World *world = adviser->world;
    for (uint32_t place = 0; place < world->colliders.used && world->settings.solver != PBMPM_SOLVER_PAPER; place++) {
        const Collider *body = body_at(world, place);
        if (!body || !moves(body) || body->shape.kind != PBMPM_SPHERE || 2.0 * (double)body->shape.radius >= SLOWLY * (double)world->def.cell_size || densest_liquid(world, body) == 0.0) continue;
        adviser_give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_KNOWN_LIMIT, .collider = {place, body->generation},
                                             .text = "a rigid ball in liquid turns by itself: slowly only from 24 cells on"});
    }
}

/* ---- On the domain's floor ---- */

/* How far a body is from the wall where gravity leads [cells]. */
static double gap_to_floor(const World *world, const Collider *collider)
{
    const Solid solid = solid_where(world, collider);
    double low[3], high[3], down[3], gap = INFINITY, most = 0.0;
    solid_bounds(&solid, low, high);
    gravity_direction(world, down);
    for (int a = 0; a < world->def.dimension; a++) {
        if (fabs(down[a]) <= most) continue;
        most = fabs(down[a]);
        gap = down[a] > 0.0 ? world->domain.high[a] - high[a] : low[a] - world->domain.low[a];
    }
    return gap / (double)world->def.cell_size;
}

/* Walls stop a body where it touches, but for rounding. */
static bool lies_on_floor(const World *world, const Collider *collider)
{
    static const double ROUNDING = 1e-3; /* cells: of places of 1e4 cells in floats */
    return fabs(gap_to_floor(world, collider)) < ROUNDING;
}

void advise_rigid_glides(Adviser *adviser)
{
    const World *world = adviser->world;
    const pbmpm_domain_wall *floor = adviser_wall_below(world);
    for (uint32_t place = 0; floor && place < world->colliders.used; place++) {
        const Collider *body = body_at(world, place);
        if (!body || rigid_friction(&body->def, floor) > 0.0 || !lies_on_floor(world, body)) continue;
        adviser_give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_NO_FRICTION, .collider = {place, body->generation},
                                             .text = "a rigid body glides without end on the domain's floor: there is no friction between them"});
    }
}

/* The grid shows no liquid in a narrow gap, and what stands above presses the body down. In a room that fills, crates of 400 kg/m^3 that start less than two cells above the
 * floor stay on it. */
void advise_rigid_stays_down(Adviser *adviser)
{
    static const double NARROW = 1.0; /* [cells] of the gap: a body that fell so far stays */
    const World *world = adviser->world;
    for (uint32_t place = 0; adviser_wall_below(world) && place < world->colliders.used; place++) {
        const Collider *body = body_at(world, place);
        if (!body || !moves(body) || gap_to_floor(world, body) >= NARROW) continue;
        const Solid solid = solid_where(world, body);
        if (mass_of(world, body) >= densest_liquid(world, NULL) * solid_volume(&solid)) continue;
        adviser_give(adviser, (pbmpm_advice){.code = PBMPM_ADVICE_KNOWN_LIMIT, .collider = {place, body->generation},
                                             .text = "a light rigid body on the domain's floor stays there when liquid comes: let it start two cells above"});
    }
}

/* ---- Among obstacles ---- */

/* Whether a point of a lattice in the box around what both share is inside of both. */
static bool enters(const Solid *body, const Solid *other)
{
    enum { POINTS = 5 };
    double low[3] = {0}, high[3] = {0}, from[3] = {0}, to[3] = {0};
    const int dimension = body->dimension;
    solid_bounds(body, low, high);
    if (other->kind != PBMPM_PLANE) solid_bounds(other, from, to);
    for (int a = 0; a < dimension && other->kind != PBMPM_PLANE; a++) {
        low[a] = fmax(low[a], from[a]);
        high[a] = fmin(high[a], to[a]);
        if (low[a] >= high[a]) return false;
    }
    for (int k = 0; k < (dimension == 3 ? POINTS * POINTS * POINTS : POINTS * POINTS); k++) {
        const int index[3] = {k % POINTS, k / POINTS % POINTS, k / (POINTS * POINTS)};
        double at[3] = {0};
        for (int a = 0; a < dimension; a++) at[a] = low[a] + (high[a] - low[a]) * (index[a] + 0.5) / POINTS;
        if (solid_gap(body, at) < 0.0 && solid_gap(other, at) < 0.0) return true;
    }
    return false;
}

/* Whether a body is in another, or would be so many cells further down. A pair of bodies is told once. */
static bool is_in_another(const World *world, uint32_t place, double further)
{
    Solid body = solid_where(world, &world->colliders.slot[place]);
    double down[3];
    gravity_direction(world, down);
    for (int a = 0; a < world->def.dimension; a++) body.position[a] += further * down[a] * (double)world->def.cell_size;
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *other = &world->colliders.slot[c];
        if (c == place || other->generation == 0 || (c < place && body_at(world, c) && moves(other))) continue;
        const Solid solid = solid_where(world, other);
        if (enters(&body, &solid)) return true;
    }
    return false;
}

void advise_rigid_enters(Adviser *adviser)
{
    const World *world = adviser->world;
    for (uint32_t place = 0; place < world->colliders.used; place++) {
        const Collider *body = body_at(world, place);
        if (!body || !moves(body) || !is_in_another(world, place, 1.0)) continue; /* what turns about a pivot alone may be in its bearing */
        pbmpm_advice advice = {.code = PBMPM_ADVICE_KNOWN_LIMIT, .collider = {place, body->generation},
                               .text = "a rigid body has entered another obstacle: bodies feel matter and the domain's walls alone; a physics engine keeps them apart"};
        if (!is_in_another(world, place, 0.0)) advice.text = "a rigid body lies on another obstacle and falls through it: bodies feel matter and the domain's walls alone; a physics engine keeps them apart";
        adviser_give(adviser, advice);
    }
}
