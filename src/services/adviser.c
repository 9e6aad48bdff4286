#include "services/adviser.h"

#include <math.h>

#include "base/sized.h"
#include "services/effective_moduli.h"
#include "services/ray.h"
#include "world/depth.h"

void adviser_give(Adviser *adviser, pbmpm_advice advice)
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

/* Halving the cell size in 3D makes a step eight times as dear. Nobody takes what costs more: then no setting helps. */
static const double MOST = 8.0; /* times a step */

void adviser_by_substeps(const Adviser *adviser, double factor, pbmpm_advice *advice)
{
    const double now = adviser->world->settings.substeps, wanted = ceil(now * factor - 1e-6);
    if (wanted > PBMPM_MAX_SUBSTEPS || wanted > MOST * now) return;
    advice->change = PBMPM_CHANGE_SUBSTEPS;
    advice->value = (float)wanted;
    advice->price = (float)(100.0 * (wanted / now - 1.0));
}

void adviser_by_iterations(const Adviser *adviser, double factor, pbmpm_advice *advice)
{
    const double now = adviser->world->settings.iterations, wanted = ceil(now * factor - 1e-6), more = iterated_share(adviser->world) * (wanted / now - 1.0);
    if (wanted > PBMPM_MAX_ITERATIONS || more > MOST - 1.0) return;
    advice->change = PBMPM_CHANGE_ITERATIONS;
    advice->value = (float)wanted;
    advice->price = (float)(100.0 * more);
}

/* As many particles per cell as before. */
void adviser_by_cells(const Adviser *adviser, double factor, pbmpm_advice *advice)
{
    static const double FINEST = 2.0; /* factor: see above */
    if (factor > FINEST) return;
    advice->change = PBMPM_CHANGE_CELL_SIZE;
    advice->value = (float)((double)adviser->world->def.cell_size / factor);
    advice->price = (float)(100.0 * (pow(factor, adviser->world->def.dimension) - 1.0));
}

void adviser_by_value(pbmpm_change change, double value, double price, pbmpm_advice *advice)
{
    advice->change = change;
    advice->value = (float)value;
    advice->price = (float)price;
}

/* ---- What is there ---- */

static bool emitted(const World *world, uint32_t slot)
{
    const pbmpm_material_id id = {slot, world->materials.generation[slot]};
    return id.generation != 0 && emitters_use(&world->emitters, id);
}

bool adviser_present(const World *world, uint32_t slot) { return world->particles.of_material[slot] > 0 || emitted(world, slot); }

bool adviser_any_present(const World *world, pbmpm_material_kind kind)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (adviser_present(world, slot) && world->materials.def[slot].kind == kind) return true;
    return false;
}

bool adviser_floats(const World *world, const pbmpm_material_def *body)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (adviser_present(world, slot) && adviser_flows(&world->materials.def[slot]) && world->materials.def[slot].density > body->density) return true;
    return false;
}

/* Which solver bears the weight of matter of this material. The convergent one is chosen where matter touches: a liquid that solids touch may have the other
 * one, and what that holds says adviser_held_of(). Sand beside liquid is the dual's. By itself it rests with the primal: it keeps its volume in bins of 15 to 64 cells at
 * 60 Hz x 5, even where it runs out of them, while the dual has it (tests/field/run.py bin silo weight_of_sand). */
pbmpm_solver adviser_solver_of(const World *world, uint32_t slot)
{
    if (world->settings.solver != PBMPM_SOLVER_CONVERGENT) return world->settings.solver;
    const pbmpm_material_kind kind = world->materials.def[slot].kind;
    const bool wet = kind == PBMPM_LIQUID || (kind == PBMPM_SAND && adviser_any_present(world, PBMPM_LIQUID));
    return wet ? PBMPM_SOLVER_DUAL : PBMPM_SOLVER_PRIMAL;
}

/* Whether it may have matter of this material in some substep: sand that flows is the dual's, see solvers/granular.h. */
bool adviser_may_solve(const World *world, uint32_t slot, pbmpm_solver solver)
{
    const bool sand = world->settings.solver == PBMPM_SOLVER_CONVERGENT && world->materials.def[slot].kind == PBMPM_SAND;
    return solver == adviser_solver_of(world, slot) || (sand && solver == PBMPM_SOLVER_DUAL);
}

bool adviser_any_solved_with(const World *world, pbmpm_solver solver)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (adviser_present(world, slot) && adviser_may_solve(world, slot, solver)) return true;
    return false;
}

pbmpm_effective adviser_held_of(const Adviser *adviser, uint32_t slot)
{
    return effective_modulus(adviser->world, slot, &adviser->substep);
}

pbmpm_material_id adviser_id_of(const World *world, uint32_t slot) { return (pbmpm_material_id){slot, world->materials.generation[slot]}; }

bool adviser_lands(const World *world, uint32_t material, const double from[3])
{
    double along[3];
    gravity_direction(world, along);
    return ray_to_obstacle(world, material, from, along, PBMPM_MAX_CELL * (double)world->def.cell_size) < INFINITY;
}

double adviser_cells(const Adviser *adviser, double speed) { return speed * adviser->substep.dt / (double)adviser->world->def.cell_size; }

double adviser_emitted_landing(const Adviser *adviser, uint32_t slot)
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

const pbmpm_domain_wall *adviser_wall_below(const World *world)
{
    for (int a = 0; a < world->def.dimension; a++) {
        const float pull = world->settings.gravity[a];
        const pbmpm_domain_wall *wall = &world->domain.wall[domain_place(a, pull > 0.0f)];
        if (pull != 0.0f && !wall->open) return wall;
    }
    return NULL;
}

bool adviser_any_sticks(const World *world)
{
    for (uint32_t c = 0; c < world->colliders.used; c++)
        if (world_feels(world, &world->colliders.slot[c]) && world->colliders.slot[c].def.friction == PBMPM_FRICTION_STICK) return true;
    return false;
}
