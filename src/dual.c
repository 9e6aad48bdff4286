#include "dual.h"

#include <math.h>
#include <string.h>

#include "result.h"

/* Pressure carried over in full is integral control: unstable where the solution is truncated. Half of it is stable at any number of
 * iterations that was tried, and worth twice as many. */
static const double CARRIED_SHARE = 0.5;

/* Displacement errors were 0.25 to 1.4 times this many residuals in columns, dam breaks and jittered lattices. */
static const double ERROR_PER_RESIDUAL = 20.0;

pbmpm_result dual_prepare(World *world)
{
    DualState *dual = &world->dual;
    const Grid *grid = &world->grid;
    const size_t blocks = (size_t)grid->particle_blocks;
    const size_t floats = (size_t)grid->node_blocks * (size_t)grid->block_cells * K_NODE_WIDTH;
    const bool ok = array_reserve(&world->memory, &dual->node_push, floats, sizeof(float)) &&
                    array_reserve(&world->memory, &dual->change2, blocks, sizeof(float)) &&
                    array_reserve(&world->memory, &dual->uphill, blocks, sizeof(float));
    if (!ok) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the dual solver on %d blocks", grid->node_blocks);
    return particles_enable_pressure(&world->particles, &world->memory);
}

/* The multipliers of elastic particles and what an iteration changed need memory for this substep only: the spare arrays, which
 * nobody uses between the sort and the next. */
static void bind(World *world)
{
    KernelArgs *a = &world->args;
    Particles *p = &world->particles;
    const double ratio = world->dual.pressure_dt > 0.0 ? (double)a->dt / world->dual.pressure_dt : 0.0;
    a->pressure = p->pressure;
    a->pressure_old = particles_spare(p, CLASS_SCALAR, 0);
    a->node_push = world->dual.node_push.data;
    a->change2 = world->dual.change2.data;
    a->uphill = world->dual.uphill.data;
    a->momentum = 0.0f;
    a->carried = (float)(CARRIED_SHARE * fmin(ratio * ratio, 1.0)); /* a multiplier is a stress times dt^2 */
    const int d = p->dimension, parts = d * (d + 1) / 2;
    for (int i = 0; i < 2 * parts && p->deformation[0]; i++) {
        float *array = i < d * d ? particles_spare(p, CLASS_MATRIX, i) : particles_spare(p, CLASS_VECTOR, i - d * d);
        if (i < parts)
            a->stress[i] = array;
        else
            a->stress_old[i - parts] = array;
    }
    world->dual.pressure_dt = (double)a->dt;
}

static double sum_blocks(const Array *array, int32_t blocks)
{
    const float *value = array->data;
    double sum = 0.0;
    for (int32_t block = 0; block < blocks; block++) sum += (double)value[block];
    return sum;
}

void dual_solve(World *world, const ContactFrame *contacts)
{
    const Kernels *kernels = world->kernels;
    const int32_t blocks = world->grid.particle_blocks;
    bind(world);
    solver_over_particles(world, kernels->dual_begin);
    const double mass = fmax(sum_blocks(&world->dual.change2, blocks), 1e-300);
    solver_over_nodes(world, kernels->push_nodes, contacts);
    double t = 1.0;
    bool more = true;
    while (more) {
        solver_over_particles(world, kernels->dual_iterate);
        world->record.iterations_used++;
        world->record.residual = sqrt(sum_blocks(&world->dual.change2, blocks) / mass);
        more = solver_may_go_on(world, ERROR_PER_RESIDUAL * world->record.residual);
        const double next = 0.5 * (1.0 + sqrt(1.0 + 4.0 * t * t));
        const bool restart = sum_blocks(&world->dual.uphill, blocks) > 0.0;
        world->args.momentum = restart || !more ? 0.0f : (float)((t - 1.0) / next);
        t = restart ? 1.0 : next;
        solver_over_nodes(world, kernels->push_nodes, contacts);
    }
}

double dual_stiffness_share(const World *world, const pbmpm_material_def *def, double substep)
{
    const double cells = substep / (double)world->def.cell_size, poisson = (double)def->poisson_ratio;
    const double shear = 0.5 * (double)def->young_modulus / (1.0 + poisson);
    const double lambda = 2.0 * shear * poisson / (1.0 - 2.0 * poisson);
    const double stiffness = 4.0 * cells * cells / (double)def->density * (2.0 * shear + lambda);
    const double held = world->settings.iterations / 2.5;
    return fmin(1.0, held * held / stiffness);
}
