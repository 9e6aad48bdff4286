#include "step/flight.h"

#include <float.h>
#include <math.h>

#include "contact/obstacles.h"
#include "solvers/passes.h"

/* How far [cells] obstacles and forces may matter to what is at a particle's nodes: obstacles beside a near one are looked at too, see look_around() in contacts_find.c. */
static const double FELT = 4.5;

static bool is_felt_everywhere(const Forces *forces)
{
    for (uint32_t slot = 0; slot < forces->used; slot++)
        if (forces->slot[slot].generation != 0 && forces->slot[slot].def.enabled && force_reach(&forces->slot[slot]) == INFINITY) return true;
    return false;
}

void flight_begin(Flight *flight, const World *world)
{
    const pbmpm_solver solver = world->settings.solver;
    const bool solved = solver == PBMPM_SOLVER_PAPER || solver == PBMPM_SOLVER_DUAL || solver == PBMPM_SOLVER_CONVERGENT;
    *flight = (Flight){.world = world,
                       .possible = solved && solver_holds_liquid(world) && !is_felt_everywhere(&world->forces)};
}

/* How it moves within the substep [cells]. */
typedef struct Motion {
    double way;    /* its own */
    double strain; /* sum of the sizes of the gradient's components */
    double growth; /* the trace */
} Motion;

static Motion motion_of(const Flight *flight, uint32_t row)
{
    const World *world = flight->world;
    const Particles *p = &world->particles;
    const Substep *substep = &world->substep;
    Motion motion = {0};
    for (int a = 0; a < p->dimension; a++) {
        const double d = ((double)p->velocity[a][row] + (double)world->settings.gravity[a] * substep->dt) * substep->to_cells;
        motion.way += d * d;
        motion.growth += (double)p->affine[a * 4][row] * substep->dt;
        for (int c = 0; c < p->dimension; c++) motion.strain += fabs((double)p->affine[a * 3 + c][row]) * substep->dt;
    }
    motion.way = sqrt(motion.way);
    return motion;
}

/* What is to fall asleep stays in the grid. */
static bool is_slow(const World *world, uint32_t row)
{
    const Particles *p = &world->particles;
    float speed2 = 0.0f;
    for (int a = 0; a < p->dimension; a++) speed2 += p->velocity[a][row] * p->velocity[a][row];
    return world->sleep.on && speed2 < world->settings.sleep_speed * world->settings.sleep_speed;
}

/* Whether it is a liquid that the solver leaves as it is: its volume does not fall below the rest volume, so it bears no pressure, and viscosity is the paper's own. All
 * comparisons fail for a NaN. */
static bool is_slack(const Flight *flight, uint32_t row, const Motion *motion)
{
    const World *world = flight->world;
    const Particles *p = &world->particles;
    const pbmpm_material_def *def = &world->materials.def[p->material[row]];
    const KernelMaterial *material = &world->materials.kernel[p->material[row]];
    const bool small = p->mass[row] * material->inverse_density <= 1.0f; /* in cells: the grid is not full of it */
    if (material->kind != K_LIQUID || !small || !(motion->way + motion->strain < (double)K_INCREMENT_MAX)) return false;
    if (!(p->volume_ratio[row] >= K_LIQUID_RATIO_MIN) || !(p->volume_ratio[row] <= K_LIQUID_RATIO_MAX)) return false;
    if (world->settings.solver == PBMPM_SOLVER_PAPER) return true;
    const double rounding = (double)FLT_EPSILON * (1.0 + motion->way); /* what the transfers make of its gradient */
    const bool holds = world->settings.pressure == PBMPM_PRESSURE_PARTICLES || motion->growth >= -rounding; /* cells ask for that alone */
    const bool pressed = p->pressure && p->pressure[row] != 0.0f;
    return holds && !pressed && def->kinematic_viscosity == 0.0f && (double)p->volume_ratio[row] * (1.0 + motion->growth) >= 1.0 - rounding;
}

/* Farther from all obstacles than it and its nodes may come, and out of reach of all forces. */
static bool is_far_from_all(const Flight *flight, uint32_t row, const Motion *motion)
{
    const World *world = flight->world;
    const Colliders *colliders = &world->colliders;
    const double dx = (double)world->def.cell_size, nodes = NODE_REACH * sqrt((double)world->def.dimension);
    const double way = fmin(motion->way + nodes * motion->strain, (double)world->settings.max_displacement);
    double point[3] = {0};
    for (int a = 0; a < world->def.dimension; a++) point[a] = particles_coordinate(&world->particles, row, a) * dx;
    for (int i = 0; i < colliders->obstacle_count; i++) {
        float surface[3];
        if (!obstacle_meets(&colliders->obstacle[i], world->materials.def[world->particles.material[row]].groups)) continue;
        obstacle_motion(&colliders->obstacle[i], point, dx, world->settings.max_displacement, surface);
        double reach = nodes + way + FELT;
        for (int a = 0; a < 3; a++) reach += fabs((double)surface[a]);
        if (!(solid_gap(&colliders->obstacle[i].start, point) > reach * dx)) return false;
    }
    for (uint32_t slot = 0; slot < world->forces.used; slot++) {
        const Force *force = &world->forces.slot[slot];
        if (force->generation == 0 || !force->def.enabled) continue;
        if (!(solid_gap(&force->solid, point) > force_reach(force) + nodes * dx)) return false;
    }
    return true;
}

bool flight_is_free(const void *context, uint32_t row)
{
    const Flight *flight = context;
    const Motion motion = motion_of(flight, row);
    return !is_slow(flight->world, row) && is_slack(flight, row, &motion) && is_far_from_all(flight, row, &motion);
}
