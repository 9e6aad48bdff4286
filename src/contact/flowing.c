#include "contact/flowing.h"

#include <math.h>

#include "contact/field.h"
#include "matter/particles.h"

/* Does something for a particle whose nearest node lies `way` from the site. */
typedef void Visit(const FlowingSite *site, const int32_t way[3], const KernelMaterial *material, uint32_t row, double *sum);

static void visit_cell(const FlowingSite *site, const int32_t way[3], Visit *visit, double *sum)
{
    const Grid *grid = site->frame->grid;
    const int64_t node = grid_node_beside(grid, site->block, site->local, way);
    const int32_t block = (int32_t)(node / grid->block_cells);
    const uint32_t cell = (uint32_t)(node % grid->block_cells), *run = grid->block_run.data;
    if (node == GRID_NOWHERE || block >= grid->particle_blocks) return;
    for (uint32_t r = run[block]; r < run[block + 1]; r++) {
        const KernelMaterial *material = &site->frame->kernel[grid->run_key[r] >> K_RUN_CELL_BITS];
        if ((grid->run_key[r] & K_RUN_CELL_MASK) != cell || (material->kind != K_LIQUID && material->yields != K_SAND)) continue;
        for (uint32_t row = grid->run_begin[r]; row < grid->run_begin[r + 1]; row++) visit(site, way, material, row, sum);
    }
}

static void visit_around(const FlowingSite *site, Visit *visit, double *sum)
{
    const Grid *grid = site->frame->grid;
    for (int n = 0; n < grid->neighbours; n++) {
        int32_t way[3];
        grid_neighbour_offset(n, grid->dimension, way);
        visit_cell(site, way, visit, sum);
    }
}

/* A fourth of a particle's multiplier: kept by the dual, by the law of liquids with the explicit solver. */
static double pressure_of(const ContactFrame *frame, const KernelMaterial *material, uint32_t row)
{
    const double ratio = (double)frame->pressed->volume_ratio[row];
    if (frame->pressure) return 0.25 * (double)frame->pressure[row] / (double)material->pascal_per_multiplier;
    return 0.25 * (double)material->dilation * ratio * fmax(0.0, 1.0 - ratio);
}

/* sum: mass, and mass times p / rho. */
static void add_pressure(const FlowingSite *site, const int32_t way[3], const KernelMaterial *material, uint32_t row, double *sum)
{
    (void)way;
    sum[0] += (double)site->frame->pressed->mass[row];
    sum[1] += (double)site->frame->pressed->mass[row] * pressure_of(site->frame, material, row);
}

double flowing_pressure(const FlowingSite *site)
{
    double sum[2] = {0.0, 0.0};
    visit_around(site, add_pressure, sum);
    return sum[0] > 0.0 ? sum[1] / sum[0] : 0.0;
}

/* The quadratic spline at a distance [cells], and its slope. */
static double spline(double r, double *slope)
{
    const double off = fabs(r), rest = fmax(0.0, 1.5 - off);
    *slope = off < 0.5 ? -2.0 * r : r > 0.0 ? -rest : rest;
    return field_spline(r);
}

static void add_push(const FlowingSite *site, const int32_t way[3], const KernelMaterial *material, uint32_t row, double *sum)
{
    const Particles *p = site->frame->pressed;
    const double volume = (double)p->mass[row] * (double)material->inverse_density;
    double w[3] = {1.0, 1.0, 1.0}, slope[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < p->dimension; a++) w[a] = spline(way[a] + (double)p->fraction[a][row], &slope[a]);
    sum[0] -= volume * slope[0] * w[1] * w[2];
    sum[1] -= volume * w[0] * slope[1] * w[2];
    sum[2] -= volume * w[0] * w[1] * slope[2];
}

void flowing_push(const FlowingSite *site, double push[3])
{
    push[0] = push[1] = push[2] = 0.0;
    visit_around(site, add_push, push);
}
