#include "guess.h"

#include <math.h>
#include <string.h>

#include "depth.h"
#include "result.h"

/* Arrays of cells: residual, preconditioned residual, direction, response, pressure before, mask, softness. */
enum { GUESS_ARRAYS = 7 };

pbmpm_result guess_prepare(World *world)
{
    Grid *grid = &world->grid;
    GuessState *guess = &world->guess;
    const size_t nodes = (size_t)grid->node_blocks * (size_t)grid->block_cells;
    if (array_reserve(&world->memory, &guess->cells, GUESS_ARRAYS * nodes, sizeof(float)) &&
        multilevel_build(&guess->multilevel, &world->memory, grid, 1, LEVELS_BEYOND))
        return PBMPM_OK;
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the coarse grids of %d blocks", grid->node_blocks);
}

void guess_free(World *world)
{
    array_free(&world->memory, &world->guess.cells);
    multilevel_free(&world->guess.multilevel, &world->memory);
}

/* All pressures yield a little, a tenth as much as the slowest mode of matter n cells deep, whose eigenvalue is (pi / 4n)^2: a guess that is
 * exact there answers the errors of the last substep with its full weight, and so they may grow. */
static float least_softness(const World *world)
{
    const double root = 3.14159265358979 / (4.0 * matter_depth(world));
    return (float)(0.1 * root * root);
}

/* Volume that is missing is given back in 1/60 s, and crushed matter grows by no more than GUESS_GROWTH_MAX per substep: the guess acts on all of a body at
 * once, and what it gives back in one substep becomes a velocity, missing volume * depth / dt. */
static const float GUESS_GROWTH_MAX = 0.05f;

static float growth_share(const World *world) { return fminf(1.0f, 60.0f * world->args.dt); }

/* The arrays of the conjugate gradients, one value per cell. */
typedef struct Guess {
    World *world;
    const ContactFrame *contacts;
    size_t cells;
    float *residual, *better, *direction, *response, *before, *mask, *soft;
} Guess;

static Guess guess_of(World *world, const ContactFrame *contacts)
{
    const size_t n = (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells;
    float *cells = world->guess.cells.data;
    return (Guess){world,         contacts,      n,             cells,         cells + n,
                   cells + 2 * n, cells + 3 * n, cells + 4 * n, cells + 5 * n, cells + 6 * n};
}

static double dot(const Guess *g, const float *a, const float *b)
{
    const float *mass = g->world->args.cell_mass;
    double sum = 0.0;
    for (size_t i = 0; i < g->cells; i++) sum += (double)(mass[i] * a[i] * b[i]);
    return sum;
}

static void hold_nodes(void *context, int32_t begin, int32_t end) { contacts_hold(context, begin, end); }

/* Displacements of the nodes from the pressures `of` alone. */
static void respond(const Guess *g, float *of)
{
    World *world = g->world;
    KernelArgs *a = &world->args;
    ContactFrame contacts = *g->contacts;
    float *pressure = a->cell_pressure, *pressure_old = a->cell_pressure_old;
    a->cell_pressure = a->cell_pressure_old = of;
    solver_over_particles(world, world->kernels->cells_push);
    solver_over_nodes(world, world->kernels->respond_nodes, NULL);
    mirrors_apply(&world->mirrors, &world->grid, NULL);
    pool_for(world->pool, world->grid.node_blocks, 4, hold_nodes, &contacts);
    a->cell_pressure = pressure;
    a->cell_pressure_old = pressure_old;
}

/* response = means of tr D of the displacements that the nodes have. */
static void trace(const Guess *g)
{
    World *world = g->world;
    world->args.cell_trace = g->response;
    world->args.probing = 1;
    solver_over_particles(world, world->kernels->cells_trace);
    solver_over_nodes(world, world->kernels->cells_respond, NULL);
    world->args.probing = 0;
}

/* In a closed box that is full a constant pressure moves nothing, and no pressure answers to a volume that does not fit: the solution would
 * grow without bound. The surface of matter n cells deep gives a constant pressure an energy of about 0.45 / n per mass. */
static bool is_closed(const Guess *g, const float *load)
{
    double energy = 0.0, mass = 0.0;
    for (size_t i = 0; i < g->cells; i++) {
        energy += (double)load[i];
        mass += (double)g->world->args.cell_mass[i];
    }
    return energy * matter_depth(g->world) < 0.05 * mass;
}

/* Takes the mean over the mask from a field, if the box is closed. */
static void take_mean(const Guess *g, float *field)
{
    if (!g->world->guess.closed) return;
    const double mean = dot(g, field, g->mask) / fmax(dot(g, g->mask, g->mask), 1e-300);
    for (size_t i = 0; i < g->cells; i++) field[i] -= (float)mean * g->mask[i];
}

/* The energy of a pressure field s is 4 sum_i m_i |u_i|^2 with m_i u_i = sum_p m w s (x_i - x_p). Where matter is all around, that is
 * -m_i grad s / 4; at a surface s itself counts, by the displacement that a pressure of 1 everywhere gives. */
void guess_begin(World *world, const ContactFrame *contacts)
{
    const Guess g = guess_of(world, contacts);
    float *stiffness = g.better, *load = g.direction;
    const float *node = world->grid.node.data, *mass = world->args.cell_mass;
    const float least = least_softness(world);
    for (size_t i = 0; i < g.cells; i++) g.response[i] = mass[i] > 0.0f ? 1.0f : 0.0f;
    respond(&g, g.response);
    for (size_t i = 0; i < g.cells; i++) {
        const float *u = node + i * K_NODE_WIDTH;
        g.soft[i] = world->args.cell_softness[i] + least;
        stiffness[i] = u[3];
        load[i] = 4.0f * u[3] * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) + mass[i] * g.soft[i];
    }
    multilevel_weigh(&world->guess.multilevel, world->pool, load, stiffness, 1.0);
    world->guess.closed = is_closed(&g, load);
}

/* better = B residual, among the cells of the mask. */
static void precondition(const Guess *g)
{
    const float *mass = g->world->args.cell_mass;
    const float own = (float)g->world->def.dimension;
    for (size_t i = 0; i < g->cells; i++) {
        g->better[i] = g->residual[i] / (own + g->soft[i]);
        g->response[i] = mass[i] * g->residual[i];
    }
    multilevel_add(&g->world->guess.multilevel, g->world->pool, g->response, g->better);
    for (size_t i = 0; i < g->cells; i++) g->better[i] *= g->mask[i];
    take_mean(g, g->better);
}

double guess_measure(World *world, const ContactFrame *contacts)
{
    const Guess g = guess_of(world, contacts);
    const KernelArgs *a = &world->args;
    const float share = growth_share(world);
    trace(&g);
    for (size_t i = 0; i < g.cells; i++) {
        const float growth = fminf(share * a->cell_growth[i], GUESS_GROWTH_MAX) + (a->cell_strain ? a->cell_strain[i] : 0.0f);
        const float r = growth - g.response[i] - a->cell_pressure[i] * a->cell_softness[i];
        g.mask[i] = a->cell_mass[i] > 0.0f && (a->cell_pressure[i] > 0.0f || r > 0.0f) ? 1.0f : 0.0f;
        g.residual[i] = r * g.mask[i];
    }
    take_mean(&g, g.residual);
    precondition(&g);
    return dot(&g, g.residual, g.better);
}

static void conjugate_gradients(const Guess *g, int iterations, double size)
{
    float *pressure = g->world->args.cell_pressure;
    memcpy(g->direction, g->better, g->cells * sizeof(float));
    for (int k = 0; k < iterations && size > 0.0 && !solver_time_is_up(g->world); k++) {
        g->world->record.iterations_used++;
        respond(g, g->direction);
        trace(g);
        for (size_t i = 0; i < g->cells; i++) g->response[i] = (g->response[i] + g->soft[i] * g->direction[i]) * g->mask[i];
        const double curvature = dot(g, g->direction, g->response);
        if (!(curvature > 0.0)) return;
        const float step = (float)(size / curvature);
        for (size_t i = 0; i < g->cells; i++) {
            pressure[i] += step * g->direction[i];
            g->residual[i] -= step * g->response[i];
        }
        precondition(g);
        const double next = dot(g, g->residual, g->better);
        const float keep = (float)(next / size);
        for (size_t i = 0; i < g->cells; i++) g->direction[i] = g->better[i] + keep * g->direction[i];
        size = next;
    }
}

void guess_solve(World *world, const ContactFrame *contacts, int iterations, double size)
{
    const Guess g = guess_of(world, contacts);
    float *pressure = world->args.cell_pressure;
    memcpy(g.before, pressure, g.cells * sizeof(float));
    conjugate_gradients(&g, iterations, size);
    for (size_t i = 0; i < g.cells; i++) {
        const bool usable = pressure[i] > 0.0f && pressure[i] < K_INCREMENT_MAX;
        pressure[i] = world->args.cell_pressure_old[i] = usable ? pressure[i] : 0.0f;
    }
}

void guess_take_back(World *world)
{
    const Guess g = guess_of(world, NULL);
    memcpy(world->args.cell_pressure, g.before, g.cells * sizeof(float));
    memcpy(world->args.cell_pressure_old, g.before, g.cells * sizeof(float));
}
