#include "solvers/paper.h"

#include <float.h>
#include <math.h>

#include "solvers/passes.h"
#include "solvers/plastic.h"
#include "world/depth.h"

/* ---- The bound of the pressure ---- */

/* What all liquid is, in one pass: its rest volume [m^d], the mean square of its speed [m^2/s^2], and the density of the heaviest. */
typedef struct LiquidState {
    double volume, speed2, densest;
} LiquidState;

static const double SUM_ROUNDING = 1e-4; /* of sums over a block in single precision */

static LiquidState measure_liquid(const World *world)
{
    const Particles *p = &world->particles;
    double mass = 0.0, volume = 0.0, energy = 0.0, lightness = INFINITY;
    for (uint32_t run = 0; run < world->grid.runs; run++) {
        const KernelMaterial *material = &world->materials.kernel[world->grid.run_key[run] >> K_RUN_CELL_BITS];
        if (material->kind != K_LIQUID) continue;
        lightness = fmin(lightness, (double)material->inverse_density);
        for (uint32_t row = world->grid.run_begin[run]; row < world->grid.run_begin[run + 1]; row++) {
            float speed2 = 0.0f;
            for (int a = 0; a < p->dimension; a++) speed2 += p->velocity[a][row] * p->velocity[a][row];
            if (!(speed2 < FLT_MAX)) continue; /* about to be taken out */
            mass += (double)p->mass[row];
            volume += (double)(p->mass[row] * material->inverse_density);
            energy += (double)(p->mass[row] * speed2);
        }
    }
    for (uint32_t i = 0; i < world->sleep.asleep.count; i++) {
        const SleepBlock *block = sleep_list_block(&world->sleep.asleep, i);
        if (!(block->liquid_mass > 0.0f)) continue;
        mass += (double)block->liquid_mass;
        volume += (double)block->liquid_volume;
        const double mean = (double)block->liquid_volume / (double)block->liquid_mass;
        if (mean < (1.0 - SUM_ROUNDING) * lightness) lightness = mean;
    }
    return (LiquidState){volume * world_cell_volume(world), mass > 0.0 ? energy / mass : 0.0, 1.0 / lightness};
}

/* The weight of matter as high as it stands (or would stand as a cube: a column that has collapsed still weighs what it weighs), as a pressure
 * over density g h [m^2/s^2]. 0 without gravity or liquid. */
static double weight_head(const World *world, const LiquidState *liquid)
{
    const double strength = gravity_strength(world);
    if (strength == 0.0 || liquid->volume == 0.0) return 0.0;
    const double stands = depth_along_gravity(world) * (double)world->def.cell_size;
    return fmax(stands, strength * pow(liquid->volume, 1.0 / world->def.dimension));
}

/* The pressure over density that crushed liquid may grow with [m^2/s^2]: K_HEADS times that of its weight, and that of its motion when it is stopped, once: more would
 * feed on the speed that it makes. With 3.5 times a column of 64 cells gains 0.2 % of its energy at 30 Hz x 20, with 4 times 2 %. */
static double pressure_head(double weight, const LiquidState *liquid) { return (double)K_HEADS * weight + 0.5 * liquid->speed2; }

/* What drives crushed liquid when it grows, as the square of a way per substep [cells^2]. The pressure alone does not bound the speed: a sheet that is
 * thinner than a cell, as between walls that have closed, is as dense on the grid when it is twice as wide, so its J does not follow and it would be
 * pressed on as if it had not moved, up to tr D = 1/J - 1. Matter at a cell from the middle of what grows by tr D moves at tr D dx / dt; the weight of
 * g h, of something heavier where that presses, makes of rest sqrt(2 g h) (Torricelli). Where all is faster than that, growth may be, too; but the two
 * do not add: it is the weight that moves what grows, and growth that its own motion quickens feeds on itself. The pressure is that of K_HEADS such
 * heads, and by Bernoulli's law v^2 / 2 less where matter moves at v: else each of several cells in a row adds its growth to the speed of the last.
 * At rest nothing is lost: tr D is the motion, and a lower J bears the same pressure. */
static double growth_head2(const World *world, const LiquidState *liquid, const KernelMaterial *material, double weight)
{
    const double heavier = fmax(1.0, liquid->densest * (double)material->inverse_density), cells = world->substep.to_cells;
    return (double)K_HEADS * fmax(2.0 * weight * heavier, liquid->speed2) * cells * cells;
}

/* The same at any rate and number of iterations: as a multiple of the stiffness K/rho = w N dx^2 / (4 d dt^2). A light liquid may have to bear
 * the weight of the heaviest one, up to the pressure (1/J - 1) / J K that leaves it J = 0.73: what is crushed further gains energy when it grows. */
static double pressure_bound(const World *world, const KernelMaterial *material, double head, double densest)
{
    static const double BEARS = 0.5; /* (1/J - 1) / J at J = 0.73, see above; by trial */
    const double cells = world->substep.to_cells;
    const double stiffness = (double)material->relaxation * world->settings.iterations / (4.0 * world->def.dimension * cells * cells);
    const double own = head / stiffness, heavier = densest * (double)material->inverse_density;
    return heavier > 1.0 + SUM_ROUNDING ? fmin(own * heavier, fmax(own, BEARS)) : own;
}

/* ---- The growth of solids ---- */

/* What elastic matter stores that is pressed as flat as strain_min lets it, over Young's modulus. An iteration changes D by w X, X = 1/s - 1 at the
 * stretch s, which acts as that multiple of E and works over dD = ds/s: 1/s + ln s - 1. From w X = rebound_max on it stays the same. */
static double stored_when_flat(const KernelMaterial *material)
{
    const double flat = material->condition_max > 0.0f ? 1.0 / (double)material->condition_max : (double)material->strain_min;
    const double most = (double)material->rebound_max / (double)material->relaxation;
    const double softens = fmax(flat, 1.0 / (1.0 + most));
    return 1.0 / softens + log(softens) - 1.0 + most * log(softens / flat);
}

/* How far growth may be driven in a substep, beyond what one iteration asks for. Iterations press on matter as if it had not moved: what is thinner than a
 * cell has the inertia of one, and each has its own growth. So a few particles that were pressed flat beside others left faster than by all that these
 * stored. Matter at a cell from the middle of what grows by D moves at D dx / dt, and what it stores makes of rest sqrt(2 e E / rho), with
 * E / rho = w N dx^2 / (4 dt^2). */
static double driven_growth(const World *world, const KernelMaterial *material)
{
    const double stored = sqrt(0.5 * (double)material->relaxation * world->settings.iterations * stored_when_flat(material));
    return fmax(stored, (double)material->rebound_max);
}

/* ---- Locking ---- */

/* Each particle holds its own volume, and a stiff liquid's four per cell (eight in 3D) leave the two (three) velocities per node no way to flow: it
 * acts like a jelly (volumetric locking: C. Mast et al., "Mitigating kinematic locking in the material point method", J. Comp. Phys. 231, 2012).
 * What resists is the J that flows without divergence leave behind, different in the particles of a cell; a vortex of the wave number k (per axis)
 * is held by a spring of 0.0025 w N k^4 dx^4 / dt^2 (measured). Where J moves to the mean of its cell by a share per substep, the flow meets a
 * damping by the spring's constant times dt / share instead, which is less than that of the transfers. But a pool at rest needs the jelly:
 * without it particles that were strewn at random creep into the gaps that the grid does not see, unless 2,400 iterations per second damp that
 * (in cells of 0.2 m). So the share begins where gravity cannot move waves of less than 45 cells against that spring:
 * g k < 0.0025 (w N dx / (g dt^2)) g k^4 dx^3. */
static float even_share(const World *world, const KernelMaterial *material)
{
    static const double LOCKS = 1.5e5; /* w N dx / (g dt^2) at which waves of 45 cells stand still, see above; by trial */
    const double fall = gravity_fall(world, &world->substep);
    const double stiffness = (double)material->relaxation * world->settings.iterations / fmax(fall, 1e-12);
    const double share = fall > 0.0 ? fmin(fmax(stiffness / LOCKS - 1.0, 0.0), 1.0) : 0.0;
    return (float)share * material->volume_feedback;
}

/* ---- Parameters of the substep ---- */

/* Stiffness goes with 1/dt^2, so a dt that alternates pumps energy like a child on a swing. With the error of a mode shrinking
 * by r per substep and steps T, t in turn, the product of the two transfer matrices has |trace| <= 1 + det for every r only if
 * T/t + t/T <= 6. So when dt drops the relaxation is lowered at first: stiffness grows by at most 1/0.8^2 per substep. It drops at
 * once, and a constant dt is not touched. */
static float softening_of_step(World *world)
{
    const double dt = world->substep.dt;
    world->slow_dt = fmax(dt, 0.8 * world->slow_dt);
    const double ratio = dt / world->slow_dt;
    return (float)(ratio * ratio);
}

double paper_viscous_share(const World *world, const pbmpm_material_def *def, const Substep *substep)
{
    const double dx = (double)world->def.cell_size;
    return fmin((double)def->viscosity + 8.0 * (double)def->kinematic_viscosity * substep->dt / (world->settings.iterations * dx * dx), 1.0);
}

void paper_set_materials(World *world)
{
    const LiquidState liquid = measure_liquid(world);
    const double weight = weight_head(world, &liquid), head = pressure_head(weight, &liquid);
    const float soft = softening_of_step(world) * (float)(world->slow_iterations / (double)world->settings.iterations);
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (world->materials.generation[slot] == 0) continue;
        const pbmpm_material_def *def = &world->materials.def[slot];
        KernelMaterial *material = &world->materials.kernel[slot];
        material->relaxation = def->relaxation * soft;
        if (material->yields == K_SAND) material->volume_feedback = 0.0f;
        if (def->kind == PBMPM_VISCO) material->volume_feedback = solver_feedback_share(world, def);
        /* It answers a volume strain in full and a deviator by the share beta: 2 mu = beta (2 mu + d lambda), which needs no Poisson effect. */
        if (material->kind != K_LIQUID) {
            plastic_set(world, slot, 1.0 / fmax((double)def->elasticity_ratio, 1e-3));
            material->growth_max = (float)driven_growth(world, material);
            continue;
        }
        material->volume_feedback = def->volume_feedback;
        material->even_share = even_share(world, material);
        material->viscosity = (float)paper_viscous_share(world, def, &world->substep);
        const bool weightless = weight == 0.0;
        /* Without gravity nothing brings spray back, so crushed matter grows slowly; by a share per 1/60 s it would stop at 0.81 of its volume at 240 Hz x 20 (H04). */
        material->growth_max = weightless ? (float)CRUSHED_GROWTH : FLT_MAX;
        material->head2 = weightless ? FLT_MAX : (float)growth_head2(world, &liquid, material, weight);
        material->pressure_max = weightless ? FLT_MAX : (float)pressure_bound(world, material, head, liquid.densest);
    }
}

/* ---- The iteration ---- */

void paper_solve(World *world, const ContactFrame *contacts)
{
    const int count = world->settings.iterations;
    Loops loops;
    loops_open(&loops, world->pool);
    for (int i = 0; i < count; i++) {
        solver_add_rows(&loops, world, world->kernels->iterate, &world->args);
        solver_add_nodes(&loops, world, world->kernels->update_nodes, &world->args, contacts);
    }
    loops_run(&loops);
    world->record.iterations_used = (uint32_t)count;
}
