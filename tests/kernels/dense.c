#include "dense.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static Dense dense_open(const RefGrid *base, int rows)
{
    Dense o = {.base = *base, .rows = rows};
    o.unknowns = base->size[0] * base->size[1] * base->size[2] * base->dimension;
    o.G = calloc((size_t)rows * (size_t)o.unknowns, sizeof *o.G);
    o.W = calloc((size_t)rows, sizeof *o.W);
    o.b = calloc((size_t)rows, sizeof *o.b);
    o.u = calloc((size_t)o.unknowns, sizeof *o.u);
    return o;
}

void dense_free(Dense *dense)
{
    free(dense->G);
    free(dense->W);
    free(dense->b);
    free(dense->u);
    *dense = (Dense){0};
}

/* Adds `share` of a particle's tr D = 4 sum_i w_i u_i . (x_i - x_p) to a row. */
static void add_trace(Dense *o, int row, const RefParticle *p, double share)
{
    const int n = o->base.dimension;
    const RefStencil s = reference_stencil(n, p);
    for (int i = 0; i < s.count; i++)
        for (int a = 0; a < n; a++)
            o->G[(int64_t)row * o->unknowns + reference_index(&o->base, s.node[i]) * n + a] += share * 4.0 * s.weight[i] * s.offset[i][a];
}

static double softness(const RefParticle *p) { return (double)p->material.inverse_stiffness / (p->volume_ratio * p->volume_ratio); }

Dense dense_of_particles(const Scene *scene, const RefGrid *base)
{
    Dense o = dense_open(base, (int)scene->world->particles.count);
    for (int k = 0; k < o.rows; k++) {
        const RefParticle p = scene_particle(scene, (uint32_t)k);
        o.W[k] = 0.25 * p.mass / softness(&p);
        o.b[k] = 1.0 / p.volume_ratio - 1.0 - (double)scene->world->args.dual.second_order[k];
        add_trace(&o, k, &p, 1.0);
    }
    return o;
}

/* Cells without particles have rows of zeros. */
Dense dense_of_cells(const Scene *scene, const RefGrid *base)
{
    const int n = base->dimension, cells = base->size[0] * base->size[1] * base->size[2];
    Dense o = dense_open(base, cells);
    double *mass = calloc((size_t)cells, sizeof *mass), *ratio = calloc((size_t)cells, sizeof *ratio);
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle p = scene_particle(scene, i);
        const RefCentres centres = reference_centres(n, &p);
        for (int c = 0; c < centres.count; c++) {
            const int64_t k = reference_index(base, centres.cell[c]);
            const double share = centres.weight[c] * p.mass;
            mass[k] += share;
            ratio[k] += share * p.volume_ratio;
            o.W[k] += share * softness(&p);
            add_trace(&o, (int)k, &p, share);
        }
    }
    for (int k = 0; k < cells; k++) {
        if (mass[k] == 0.0) continue;
        for (int j = 0; j < o.unknowns; j++) o.G[(int64_t)k * o.unknowns + j] /= mass[k];
        o.b[k] = fmax(mass[k] / ratio[k] - 1.0, 0.0);
        o.W[k] = 0.25 * mass[k] * mass[k] / o.W[k];
    }
    free(mass);
    free(ratio);
    return o;
}

/* Solves H x = x, overwriting both: H = L L^T. */
static void cholesky(double *H, double *x, int n)
{
    for (int j = 0; j < n; j++) {
        double *row = H + (int64_t)j * n;
        for (int k = 0; k < j; k++) {
            const double *other = H + (int64_t)k * n;
            double sum = row[k];
            for (int i = 0; i < k; i++) sum -= row[i] * other[i];
            row[k] = sum / other[k];
            row[j] -= row[k] * row[k];
        }
        row[j] = sqrt(row[j]);
        for (int k = 0; k < j; k++) x[j] -= row[k] * x[k];
        x[j] /= row[j];
    }
    for (int j = n - 1; j >= 0; j--) {
        x[j] /= H[(int64_t)j * n + j];
        for (int k = 0; k < j; k++) x[k] -= H[(int64_t)j * n + k] * x[j];
    }
}

static double excess(const Dense *o, int row)
{
    double sum = o->b[row];
    for (int j = 0; j < o->unknowns; j++) sum -= o->G[(int64_t)row * o->unknowns + j] * o->u[j];
    return sum;
}

double dense_pressure(const Dense *dense, int row) { return fmax(0.0, excess(dense, row)) * dense->W[row]; }

/* (M + sum W G G^T) u = M u* + sum W b G over the rows that press; a node without mass stays where it is. */
static void newton_step(Dense *o, const bool *presses)
{
    const int n = o->unknowns, d = o->base.dimension;
    double *H = calloc((size_t)n * (size_t)n, sizeof *H);
    for (int j = 0; j < n; j++) {
        const RefNode *node = &o->base.node[j / d];
        H[(int64_t)j * n + j] = node->mass > 0.0 ? node->mass : 1.0;
        o->u[j] = node->mass > 0.0 ? node->mass * node->u[j % d] : 0.0;
    }
    for (int k = 0; k < o->rows; k++) {
        const double *G = o->G + (int64_t)k * n;
        for (int i = 0; i < n && presses[k]; i++) {
            if (G[i] == 0.0) continue;
            o->u[i] += o->W[k] * o->b[k] * G[i];
            for (int j = 0; j <= i; j++) H[(int64_t)i * n + j] += o->W[k] * G[i] * G[j];
        }
    }
    cholesky(H, o->u, n);
    free(H);
}

bool dense_solve(Dense *dense)
{
    bool *presses = malloc((size_t)dense->rows), changed = true;
    for (int k = 0; k < dense->rows; k++) presses[k] = dense->W[k] > 0.0;
    for (int round = 0; round < 50 && changed; round++) {
        newton_step(dense, presses);
        changed = false;
        for (int k = 0; k < dense->rows; k++) {
            const bool now = dense->W[k] > 0.0 && excess(dense, k) > 0.0;
            changed = changed || now != presses[k];
            presses[k] = now;
        }
    }
    free(presses);
    return !changed;
}
