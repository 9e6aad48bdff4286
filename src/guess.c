#include "guess.h"

#include <math.h>
#include <string.h>

#include "result.h"

/* Arrays of cells: residual, preconditioned residual, direction, response, pressure, mask. */
enum { GUESS_ARRAYS = 6 };

pbmpm_result guess_prepare(World *world)
{
    Grid *grid = &world->grid;
    GuessState *guess = &world->guess;
    const size_t nodes = (size_t)grid->node_blocks * (size_t)grid->block_cells;
    if (array_reserve(&world->memory, &guess->cells, GUESS_ARRAYS * nodes, sizeof(float)) &&
        pyramid_build(&guess->pyramid, &world->memory, grid->dimension, grid->coordinate.data, grid->node_blocks))
        return PBMPM_OK;
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the coarse grids of %d blocks", grid->node_blocks);
}

void guess_free(World *world)
{
    array_free(&world->memory, &world->guess.cells);
    pyramid_free(&world->guess.pyramid, &world->memory);
}

/* One conjugate gradient solve. */
typedef struct Guess {
    World *world;
    const ContactFrame *contacts;
    size_t cells;
    float *residual, *better, *direction, *response, *pressure, *mask;
} Guess;

static double dot(const Guess *g, const float *a, const float *b)
{
    const float *mass = g->world->args.cell_mass;
    double sum = 0.0;
    for (size_t i = 0; i < g->cells; i++) sum += (double)(mass[i] * a[i] * b[i]);
    return sum;
}

static void hold_nodes(void *context, int32_t begin, int32_t end) { contacts_hold(context, begin, end); }

/* Displacements of the nodes from the pressures in `pressure` alone. */
static void respond(Guess *g, float *pressure)
{
    World *world = g->world;
    ContactFrame contacts = *g->contacts;
    world->args.cell_pressure = world->args.cell_pressure_old = pressure;
    solver_over_particles(world, world->kernels->cells_push);
    solver_over_nodes(world, world->kernels->respond_nodes, NULL);
    mirrors_apply(&world->mirrors, &world->grid);
    pool_for(world->pool, world->grid.node_blocks, 4, hold_nodes, &contacts);
}

/* Means of tr D of the displacements that the nodes have, into args.cell_trace. */
static void trace(Guess *g, float *out)
{
    World *world = g->world;
    world->args.cell_trace = out;
    solver_over_particles(world, world->kernels->cells_trace);
    solver_over_nodes(world, world->kernels->cells_respond, NULL);
}

/* The energy of a pressure field s is 4 sum_i m_i |u_i|^2 with m_i u_i = sum_p m w s (x_i - x_p). Where matter is all around, that is
 * -m_i grad s / 4; at a surface s itself counts, by the displacement that a pressure of 1 everywhere gives. */
static void set_energy(Guess *g)
{
    float *stiffness = g->better, *load = g->direction;
    const float *node = g->world->grid.node.data, *mass = g->world->args.cell_mass, *soft = g->world->args.cell_softness;
    for (size_t i = 0; i < g->cells; i++) g->response[i] = mass[i] > 0.0f ? 1.0f : 0.0f;
    respond(g, g->response);
    for (size_t i = 0; i < g->cells; i++) {
        const float *u = node + i * K_NODE_WIDTH;
        stiffness[i] = 0.25f * u[3];
        load[i] = 4.0f * u[3] * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) + mass[i] * soft[i];
    }
    pyramid_set_energy(&g->world->guess.pyramid, stiffness, load);
}

/* better = B residual, among the cells of the mask. */
static void precondition(Guess *g)
{
    const float *mass = g->world->args.cell_mass, *soft = g->world->args.cell_softness;
    const float own = (float)g->world->def.dimension;
    for (size_t i = 0; i < g->cells; i++) {
        g->better[i] = g->residual[i] / (own + soft[i]);
        g->response[i] = mass[i] * g->residual[i];
    }
    pyramid_precondition(&g->world->guess.pyramid, g->response, g->better);
    for (size_t i = 0; i < g->cells; i++) g->better[i] *= g->mask[i];
}

/* The residual of the present pressures, and which cells take part: those under pressure, and those that want to be. */
static void start(Guess *g, const float *start_pressure)
{
    const KernelArgs *a = &g->world->args;
    trace(g, g->response);
    for (size_t i = 0; i < g->cells; i++) {
        const float r = a->cell_growth[i] - g->response[i] - start_pressure[i] * a->cell_softness[i];
        g->mask[i] = a->cell_mass[i] > 0.0f && (start_pressure[i] > 0.0f || r > 0.0f) ? 1.0f : 0.0f;
        g->residual[i] = r * g->mask[i];
        g->pressure[i] = start_pressure[i];
    }
}

static void conjugate_gradients(Guess *g, int iterations)
{
    const float *soft = g->world->args.cell_softness;
    precondition(g);
    memcpy(g->direction, g->better, g->cells * sizeof(float));
    double rz = dot(g, g->residual, g->better);
    for (int k = 0; k < iterations && rz > 0.0 && !solver_time_is_up(g->world); k++) {
        g->world->record.iterations_used++;
        respond(g, g->direction);
        trace(g, g->response);
        for (size_t i = 0; i < g->cells; i++) g->response[i] = (g->response[i] + soft[i] * g->direction[i]) * g->mask[i];
        const double curvature = dot(g, g->direction, g->response);
        if (!(curvature > 0.0)) return;
        const float step = (float)(rz / curvature);
        for (size_t i = 0; i < g->cells; i++) {
            g->pressure[i] += step * g->direction[i];
            g->residual[i] -= step * g->response[i];
        }
        precondition(g);
        const double next = dot(g, g->residual, g->better);
        const float keep = (float)(next / rz);
        for (size_t i = 0; i < g->cells; i++) g->direction[i] = g->better[i] + keep * g->direction[i];
        rz = next;
    }
}

void guess_pressure(World *world, const ContactFrame *contacts, int iterations)
{
    KernelArgs *a = &world->args;
    float *pressure = a->cell_pressure, *pressure_old = a->cell_pressure_old, *cells = world->guess.cells.data;
    const size_t nodes = (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells;
    Guess g = {world,         contacts,          nodes,             cells,           cells + nodes,
               cells + 2 * nodes, cells + 3 * nodes, cells + 4 * nodes, cells + 5 * nodes};
    a->probing = 1;
    start(&g, pressure);
    set_energy(&g);
    conjugate_gradients(&g, iterations);
    a->probing = 0;
    a->cell_pressure = pressure;
    a->cell_pressure_old = pressure_old;
    for (size_t i = 0; i < nodes; i++) {
        const bool usable = g.pressure[i] > 0.0f && g.pressure[i] < K_INCREMENT_MAX;
        pressure[i] = pressure_old[i] = usable ? g.pressure[i] : 0.0f;
    }
}
