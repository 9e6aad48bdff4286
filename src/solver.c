#include "solver.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { BLOCK_GRAIN = 2 };

/* ---- The bound of the pressure ---- */

/* What all liquid is, in one pass: its rest volume [m^d], and the mean square of its speed [m^2/s^2]. */
typedef struct LiquidState {
    double volume, speed2;
} LiquidState;

static LiquidState measure_liquid(const World *world)
{
    const Particles *p = &world->particles;
    double mass = 0.0, volume = 0.0, energy = 0.0;
    for (uint32_t run = 0; run < world->grid.runs; run++) {
        const KernelMaterial *material = &world->materials.kernel[world->grid.run_key[run] >> K_RUN_CELL_BITS];
        if (material->kind != K_LIQUID) continue;
        for (uint32_t row = world->grid.run_begin[run]; row < world->grid.run_begin[run + 1]; row++) {
            float speed2 = 0.0f;
            for (int a = 0; a < p->dimension; a++) speed2 += p->velocity[a][row] * p->velocity[a][row];
            if (!(speed2 < FLT_MAX)) continue; /* about to be taken out */
            mass += (double)p->mass[row];
            volume += (double)(p->mass[row] * material->inverse_density);
            energy += (double)(p->mass[row] * speed2);
        }
    }
    return (LiquidState){volume * world_cell_volume(world), mass > 0.0 ? energy / mass : 0.0};
}

/* How far a block lies along gravity, in blocks times |g|. */
static double block_depth(const World *world, int32_t block)
{
    double along = 0.0;
    for (int a = 0; a < world->def.dimension; a++)
        along += (double)world->settings.gravity[a] * ((const int32_t *)world->grid.coordinate.data)[3 * block + a];
    return along;
}

/* The depths between which all but a fiftieth of the particles at either end lie: narrowed by histograms, so that a stray
 * particle far away does not count. */
static double trimmed_depth(const World *world)
{
    enum { BINS = 64, ROUNDS = 4 };
    const uint32_t *begin = world->grid.block_begin.data;
    const double trim = 0.02 * world->particles.count;
    double low = INFINITY, high = -INFINITY;
    for (int32_t block = 0; block < world->grid.particle_blocks; block++) {
        low = fmin(low, block_depth(world, block));
        high = fmax(high, block_depth(world, block));
    }
    for (int round = 0; round < ROUNDS && high > low; round++) {
        double count[BINS] = {0}, below = 0.0;
        const double width = (high - low) / BINS;
        for (int32_t block = 0; block < world->grid.particle_blocks; block++) {
            const double bin = (block_depth(world, block) - low) / width;
            if (bin < 0.0) below += begin[block + 1] - begin[block];
            if (bin >= 0.0 && bin <= BINS) count[bin < BINS ? (int)bin : BINS - 1] += begin[block + 1] - begin[block];
        }
        int first = 0;
        double sum = below;
        while (first < BINS - 1 && sum + count[first] < trim) sum += count[first++];
        int last = first;
        while (last < BINS - 1 && sum + count[last] < world->particles.count - trim) sum += count[last++];
        high = low + (last + 1) * width;
        low = low + first * width;
    }
    return high - low;
}

/* The pressure over density that crushed liquid may grow with [m^2/s^2]: three times that of the weight of matter as high as it
 * stands (or would stand as a cube: a column that has collapsed still weighs what it weighs), and that of its motion when it is
 * stopped, once: more would feed on the speed that it makes. 0 without gravity or liquid. */
static double pressure_head(const World *world)
{
    double strength = 0.0;
    for (int a = 0; a < world->def.dimension; a++) strength += (double)world->settings.gravity[a] * (double)world->settings.gravity[a];
    if (strength == 0.0) return 0.0;
    const LiquidState liquid = measure_liquid(world);
    if (liquid.volume == 0.0) return 0.0;
    const double stands = trimmed_depth(world) * K_BLOCK_AXIS * (double)world->def.cell_size;
    const double weight = fmax(stands, sqrt(strength) * pow(liquid.volume, 1.0 / world->def.dimension));
    return 3.0 * weight + 0.5 * liquid.speed2;
}

/* The same at any rate and number of iterations: as a multiple of the stiffness K/rho = w N dx^2 / (4 d dt^2). */
static double pressure_bound(const World *world, float relaxation, float dt, double head)
{
    const double cells = (double)dt / (double)world->def.cell_size;
    const double stiffness = (double)relaxation * world->settings.iterations / (4.0 * world->def.dimension * cells * cells);
    return head / stiffness;
}

/* ---- Parameters of the substep ---- */

/* Stiffness goes with 1/dt^2, so a dt that alternates pumps energy like a child on a swing. With the error of a mode shrinking
 * by r per substep and steps T, t in turn, the product of the two transfer matrices has |trace| <= 1 + det for every r only if
 * T/t + t/T <= 6. So when dt drops the relaxation is lowered at first: stiffness grows by at most 1/0.8^2 per substep. It drops at
 * once, and a constant dt is not touched. */
static float softening(World *world, float dt)
{
    world->slow_dt = fmax((double)dt, 0.8 * world->slow_dt);
    const double ratio = (double)dt / world->slow_dt;
    return (float)(ratio * ratio);
}

/* Without gravity nothing brings spray back, so crushed matter grows slowly. */
static const float WEIGHTLESS_REBOUND = 0.3f;

static void set_materials(World *world, float dt)
{
    const double head = pressure_head(world);
    const float soft = softening(world, dt);
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (world->materials.generation[slot] == 0) continue;
        const pbmpm_material_def *def = &world->materials.def[slot];
        KernelMaterial *material = &world->materials.kernel[slot];
        material->relaxation = def->relaxation * soft;
        if (material->kind != K_LIQUID) continue;
        const bool weightless = head == 0.0;
        material->rebound_max = weightless ? WEIGHTLESS_REBOUND : FLT_MAX;
        material->pressure_max = weightless ? FLT_MAX : (float)pressure_bound(world, material->relaxation, dt, head);
    }
}

/* ---- Running kernels ---- */

void solver_bind(World *world, float dt, bool with_volume)
{
    Particles *p = &world->particles;
    Grid *grid = &world->grid;
    KernelArgs *a = &world->args;
    const double cells_per_metre = 1.0 / (double)world->def.cell_size;
    *a = (KernelArgs){.volume_ratio = p->volume_ratio,
                      .mass = p->mass,
                      .identity = (const uint32_t *)(const void *)p->id,
                      .status = p->status,
                      .run_begin = grid->run_begin,
                      .run_key = grid->run_key,
                      .block_run = grid->block_run.data,
                      .neighbour = grid->neighbour.data,
                      .particle_blocks = grid->particle_blocks,
                      .tile = grid->tile.data,
                      .tile_volume = with_volume ? grid->tile_volume.data : NULL,
                      .node = grid->node.data,
                      .node_volume = with_volume ? grid->node_volume.data : NULL,
                      .node_reach = grid->node_reach.data,
                      .clamped = grid->clamped.data,
                      .moved = grid->moved.data,
                      .lost = grid->lost.data,
                      .travel = grid->travel.data,
                      .material = world->materials.kernel,
                      .dt = dt,
                      .cells_per_metre = (float)cells_per_metre,
                      .max_displacement = world->settings.max_displacement,
                      .max_cell = CELL_LIMIT,
                      .salt = (uint32_t)world->step_count * PBMPM_MAX_SUBSTEPS + world->record.substeps,
                      .check_strain = world->strain_unchecked};
    set_materials(world, dt);
    memcpy(a->fraction, p->fraction, sizeof a->fraction);
    memcpy(a->cell, p->cell, sizeof a->cell);
    memcpy(a->velocity, p->velocity, sizeof a->velocity);
    memcpy(a->affine, p->affine, sizeof a->affine);
    memcpy(a->deformation, p->deformation, sizeof a->deformation);
    for (int k = 0; k < world->def.dimension; k++) {
        const double pull = (double)world->settings.gravity[k] * dt * dt * cells_per_metre;
        a->gravity[k] = fmaxf(-K_INCREMENT_MAX, fminf(K_INCREMENT_MAX, (float)pull));
    }
}

typedef struct KernelJob {
    Kernel *kernel;
    KernelArgs *args;
    const ContactFrame *contacts; /* for kernels that update nodes; else null */
} KernelJob;

static void run_kernel(void *context, int32_t begin, int32_t end)
{
    const KernelJob *job = context;
    job->kernel(job->args, begin, end);
    if (job->contacts) contacts_apply(job->contacts, begin, end);
}

static void over_particle_blocks(World *world, Kernel *kernel)
{
    KernelJob job = {kernel, &world->args, NULL};
    pool_for(world->pool, world->grid.particle_blocks, BLOCK_GRAIN, run_kernel, &job);
}

static void over_node_blocks(World *world, Kernel *kernel, const ContactFrame *contacts)
{
    KernelJob job = {kernel, &world->args, contacts};
    pool_for(world->pool, world->grid.node_blocks, 2 * BLOCK_GRAIN, run_kernel, &job);
}

void solver_predict(World *world)
{
    over_particle_blocks(world, world->kernels->scatter);
    over_node_blocks(world, world->kernels->predict_nodes, NULL);
    world->strain_unchecked = false;
}

void solver_iterate(World *world, const ContactFrame *contacts)
{
    contacts_apply(contacts, 0, world->grid.node_blocks); /* the predictor obeys them too */
    for (int i = 0; i < world->settings.iterations; i++) {
        over_particle_blocks(world, world->kernels->iterate);
        over_node_blocks(world, world->kernels->update_nodes, contacts);
    }
}

void solver_integrate(World *world) { over_particle_blocks(world, world->kernels->integrate); }
