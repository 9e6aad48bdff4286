#include "reference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "matrices.h"

static const double RATIO_MIN = 0.05, RATIO_MAX = 1.2; /* of a liquid's J */
static const double LOOSE_MAX = 1.15;                  /* where it bears no tension */

/* ---- Transfers ---- */

/* The quadratic B-spline: 3/4 - x^2 around its node, (3/2 - |x|)^2 / 2 beyond half a cell. */
static double spline(double x)
{
    const double r = fabs(x);
    if (r <= 0.5) return 0.75 - r * r;
    return r < 1.5 ? 0.5 * (1.5 - r) * (1.5 - r) : 0.0;
}

/* Its derivative. */
static double spline_slope(double x)
{
    const double r = fabs(x);
    if (r <= 0.5) return -2.0 * x;
    return r < 1.5 ? -copysign(1.5 - r, x) : 0.0;
}

RefStencil reference_stencil(int dimension, const RefParticle *p)
{
    RefStencil s = {0};
    for (int z = dimension == 3 ? -1 : 0; z <= (dimension == 3 ? 1 : 0); z++)
        for (int y = -1; y <= 1; y++)
            for (int x = -1; x <= 1; x++) {
                const int step[3] = {x, y, z};
                s.weight[s.count] = 1.0;
                for (int a = 0; a < dimension; a++) {
                    s.node[s.count][a] = p->cell[a] + step[a];
                    s.offset[s.count][a] = step[a] - p->fraction[a];
                    s.weight[s.count] *= spline(s.offset[s.count][a]);
                }
                s.count++;
            }
    return s;
}

RefGrid reference_grid(int dimension, const int32_t low[3], const int32_t high[3])
{
    RefGrid grid = {.dimension = dimension, .size = {1, 1, 1}};
    size_t count = 1;
    for (int a = 0; a < dimension; a++) {
        grid.low[a] = low[a];
        grid.size[a] = high[a] - low[a] + 1;
        count *= (size_t)grid.size[a];
    }
    grid.node = calloc(count, sizeof *grid.node);
    return grid;
}

void reference_grid_free(RefGrid *grid)
{
    free(grid->node);
    *grid = (RefGrid){0};
}

int64_t reference_index(const RefGrid *grid, const int32_t node[3])
{
    int64_t index = 0;
    for (int a = grid->dimension - 1; a >= 0; a--) {
        const int32_t local = node[a] - grid->low[a];
        if (local < 0 || local >= grid->size[a]) return -1;
        index = index * grid->size[a] + local;
    }
    return index;
}

void reference_start(const RefStep *step, const RefParticle *p, double d[3], double D[9])
{
    for (int a = 0; a < 3; a++) d[a] = p->velocity[a] * step->dt * step->cells_per_metre;
    for (int k = 0; k < 9; k++) D[k] = p->affine[k] * step->dt;
}

void reference_scatter(RefGrid *grid, const RefParticle *p, const double d[3], const double D[9])
{
    const RefStencil s = reference_stencil(grid->dimension, p);
    for (int i = 0; i < s.count; i++) {
        RefNode *node = &grid->node[reference_index(grid, s.node[i])];
        const double m = s.weight[i] * p->mass;
        node->mass += m;
        node->volume += m * (double)p->material.inverse_density;
        for (int r = 0; r < grid->dimension; r++) {
            double moved = d[r];
            for (int c = 0; c < grid->dimension; c++) moved += D[r * 3 + c] * s.offset[i][c];
            node->u[r] += m * moved;
        }
    }
}

void reference_gather(const RefGrid *grid, const RefParticle *p, double d[3], double D[9])
{
    const RefStencil s = reference_stencil(grid->dimension, p);
    memset(d, 0, 3 * sizeof *d);
    memset(D, 0, 9 * sizeof *D);
    for (int i = 0; i < s.count; i++) {
        const RefNode *node = &grid->node[reference_index(grid, s.node[i])];
        for (int r = 0; r < grid->dimension; r++) {
            d[r] += s.weight[i] * node->u[r];
            for (int c = 0; c < grid->dimension; c++) D[r * 3 + c] += 4.0 * s.weight[i] * node->u[r] * s.offset[i][c];
        }
    }
}

void reference_slopes(int dimension, const RefParticle *p, double slope[27][3])
{
    const RefStencil s = reference_stencil(dimension, p);
    for (int i = 0; i < s.count; i++)
        for (int c = 0; c < dimension; c++) {
            slope[i][c] = -1.0;
            for (int a = 0; a < dimension; a++) slope[i][c] *= a == c ? spline_slope(s.offset[i][a]) : spline(s.offset[i][a]);
        }
}

double reference_gradient(const RefGrid *grid, const RefParticle *p, double gradient[9])
{
    const int n = grid->dimension;
    double size[9] = {0}, largest = 0.0, slope[27][3];
    const RefStencil s = reference_stencil(n, p);
    reference_slopes(n, p, slope);
    memset(gradient, 0, 9 * sizeof *gradient);
    for (int i = 0; i < s.count; i++) {
        const RefNode *node = &grid->node[reference_index(grid, s.node[i])];
        for (int r = 0; r < n; r++)
            for (int c = 0; c < n; c++) {
                gradient[r * 3 + c] += slope[i][c] * node->u[r];
                size[r * 3 + c] += fabs(slope[i][c] * node->u[r]);
                largest = fmax(largest, size[r * 3 + c]);
            }
    }
    return largest;
}

double reference_compression(const RefGrid *grid, const RefParticle *p)
{
    const RefStencil s = reference_stencil(grid->dimension, p);
    double sum = 0.0;
    for (int i = 0; i < s.count; i++) sum += s.weight[i] * grid->node[reference_index(grid, s.node[i])].volume;
    return sum;
}

double reference_held(const RefStep *step, const RefGrid *grid, const RefParticle *p)
{
    const double held = reference_compression(grid, p);
    if (!step->weighs) return held;
    const RefStencil s = reference_stencil(grid->dimension, p);
    double mass = 0.0;
    for (int i = 0; i < s.count; i++) mass += s.weight[i] * grid->node[reference_index(grid, s.node[i])].mass;
    return fmin(held, fmax(1.0, mass * (double)p->material.inverse_density));
}

double reference_strain(int n, const double D[9])
{
    double sum = 0.0;
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) sum += pow(0.5 * (D[r * 3 + c] + D[c * 3 + r]), 2.0);
    return sqrt(sum);
}

/* ---- Materials ---- */

/* J (1 + tr D) = 1. A compression that goes on is stopped in full; growth is driven by no more than growth_max, nor by more than
 * what the motion d leaves of the pressure, and it presses with no more than pressure_max. Viscosity takes a share of the deviator of the symmetric part; spin and volume change stay. */
static void project_liquid(int n, const RefParticle *p, const double d[3], double D[9])
{
    const KernelMaterial *material = &p->material;
    const double trace = matrix_trace(n, D);
    double old[9];
    memcpy(old, D, sizeof old);
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) {
            const double deviator = 0.5 * (old[r * 3 + c] + old[c * 3 + r]) - (r == c ? trace / n : 0.0);
            D[r * 3 + c] -= (double)material->viscosity * deviator;
        }
    double motion2 = 0.0;
    for (int a = 0; a < n; a++) motion2 += d[a] * d[a];
    const double driven = fmin(sqrt(fmax((double)material->head2 - motion2, 0.0) / (double)K_HEADS), (double)material->growth_max);
    const double growth = fmin(1.0 / p->volume_ratio - 1.0, driven) - fmax(trace, 0.0);
    const double correction = fmin(growth, (double)material->pressure_max * p->volume_ratio) - fmin(trace, 0.0);
    for (int r = 0; r < n; r++) D[r * 4] += (double)material->relaxation / n * correction;
}

static void advance(int n, const double *D, const double *F, double *o)
{
    matrix_multiply(n, D, F, o);
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) o[r * 3 + c] += F[r * 3 + c];
}

/* F* = (I + D) F should be A = beta R + (1 - beta) F* / det(F*)^(1/d): D gets the symmetric part of the difference
 * X = (A - F*) F^-1, no longer than rebound_max. The root's argument stays within [0.1, 1000]; a singular F waits.
 * Growth is not driven beyond growth_max, in the norm of the strain of D. */
static void project_elastic(int n, const RefParticle *p, double D[9])
{
    const KernelMaterial *material = &p->material;
    const double beta = (double)material->elasticity_ratio, limit = (double)material->rebound_max;
    double next[9], rotation[9], difference[9], inverse[9], X[9], size = 0.0;
    advance(n, D, p->deformation, next);
    matrix_rotation(n, next, rotation);
    const double det = matrix_determinant(n, next);
    const double unit = copysign(pow(fmin(fmax(fabs(det), 0.1), 1000.0), -1.0 / n), det);
    for (int k = 0; k < 9; k++) difference[k] = beta * rotation[k] + (1.0 - beta) * unit * next[k] - next[k];
    if (fabs(matrix_inverse(n, p->deformation, inverse)) <= 1e-12) return;
    matrix_multiply(n, difference, inverse, X);
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) difference[r * 3 + c] = 0.5 * (double)material->relaxation * (X[r * 3 + c] + X[c * 3 + r]);
    size = matrix_norm(n, difference);
    const double given = reference_strain(n, D);
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) D[r * 3 + c] += size > limit ? difference[r * 3 + c] * limit / size : difference[r * 3 + c];
    const double reached = reference_strain(n, D), most = fmax(given, (double)material->growth_max);
    if (reached <= most || !(matrix_trace(n, D) > 0.0)) return;
    memcpy(difference, D, sizeof difference);
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) D[r * 3 + c] -= 0.5 * (1.0 - most / reached) * (difference[r * 3 + c] + difference[c * 3 + r]);
}

void reference_project(int dimension, const RefParticle *p, const double d[3], double D[9])
{
    if (p->material.kind == K_LIQUID)
        project_liquid(dimension, p, d, D);
    else
        project_elastic(dimension, p, D);
}

bool reference_limit_strain(int n, const KernelMaterial *material, double F[9])
{
    double u[9], s[3], v[9], vt[9];
    matrix_decompose(n, F, u, s, v);
    if (material->condition_max > 0.0f) return s[n - 1] > 0.0 && s[0] <= (double)material->condition_max * s[n - 1] && s[0] < 1e4;
    for (int c = 0; c < n; c++) {
        const double clamped = fmin(fmax(s[c], (double)material->strain_min), (double)material->strain_max);
        for (int r = 0; r < n; r++) u[r * 3 + c] *= clamped;
    }
    matrix_transpose(n, v, vt);
    matrix_multiply(n, u, vt, F);
    return true;
}

/* ---- Integration ---- */

/* A number in [-1/2, 1/2) that looks random: lowbias32 of C. Wellons, "Prospecting for hash functions", 2018. */
static double random_looking(uint32_t x)
{
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    x ^= x >> 16;
    return (double)(x >> 8) / 16777216.0 - 0.5;
}

/* Crowded particles are parted by up to 1/40 cell per axis, differently in each substep. */
static void nudge(const RefStep *step, RefParticle *p)
{
    for (int a = 0; a < step->dimension; a++)
        p->fraction[a] += 0.05 * random_looking(p->identity * 0x9e3779b9u + step->salt * 0x85ebca6bu + (uint32_t)a);
}

double reference_control(const RefStep *step, const RefGrid *grid, const RefParticle *p, const double D[9])
{
    const double share = fmin(100.0 * reference_strain(step->dimension, D), (double)p->material.volume_share);
    return reference_compression(grid, p) > REF_CRUSHED ? 1.0 : 1.0 - share * step->excess;
}

double reference_stale(const KernelMaterial *material) { return 1.0 - fmin((double)material->pressure_max, 0.2); }

static bool is_weightless(const RefStep *step) { return step->gravity[0] == 0.0 && step->gravity[1] == 0.0 && step->gravity[2] == 0.0; }

/* J follows tr D. With feedback, where the grid shows compression, it moves a share of the way to the room that the grid has if
 * it claims more or far less, and never exceeds that where matter is crowded. Without gravity it
 * counts as wrong by no more than the strain. */
static void integrate_liquid(const RefStep *step, const RefGrid *grid, RefParticle *p, const double D[9])
{
    const double feedback = (double)p->material.volume_feedback;
    double ratio = p->volume_ratio * (1.0 + matrix_trace(step->dimension, D));
    if (step->with_volume && feedback > 0.0) {
        ratio *= reference_control(step, grid, p, D);
        const double held = reference_compression(grid, p);
        const double seen = fmin(REF_COMPRESSED / held, 1.0);
        const double right = is_weightless(step) ? fmax(seen, ratio - reference_strain(step->dimension, D)) : seen;
        if ((seen < 1.0 && ratio > seen) || ratio < reference_stale(&p->material) * seen) ratio += feedback * (right - ratio);
        if (held > REF_CROWDED) {
            ratio = fmin(ratio, REF_CROWDED / held);
            nudge(step, p);
        }
    }
    p->volume_ratio = fmin(fmax(ratio, RATIO_MIN), RATIO_MAX);
}

/* Of volume, that is left alone: without gravity, where J would fall, what fillings have. */
double reference_noise(const RefStep *step, double missing)
{
    return !is_weightless(step) || missing >= 0.0 ? REF_WRONG_MIN : 1.0 - 1.0 / REF_CRUSHED;
}

/* Feedback is for matter that moves or whose J is wrong; the noise of a pool at rest is left alone. */
static double feedback_share(const RefStep *step, const double d[3], double missing)
{
    double way2 = 0.0;
    if (step->feedback_way == 0.0) return 1.0;
    for (int a = 0; a < step->dimension; a++) way2 += d[a] * d[a];
    const double wrong = (fabs(missing) - reference_noise(step, missing)) / (REF_WRONG_MAX - REF_WRONG_MIN);
    return fmin(fmax(fmax(sqrt(way2) / step->feedback_way, wrong), 0.0), 1.0);
}

/* The square of the way, or what is wrong beyond noise where liquid bears pressure; the rest of the share brings J > 1 back to 1. */
static double quiet_feedback(const RefStep *step, const double d[3], double ratio, double seen)
{
    double way2 = 0.0;
    for (int a = 0; a < step->dimension; a++) way2 += d[a] * d[a];
    const double missing = fabs(fmin(seen, 1.0) - fmin(ratio, 1.0));
    const double wrong = (missing - REF_WRONG_MIN) / (REF_WRONG_MAX - REF_WRONG_MIN);
    const double share = fmin(fmax(fmax(way2 / (step->quiet_way * step->quiet_way), wrong), 0.0), 1.0);
    return share * (seen - ratio) + (1.0 - share) * fmin(1.0 - ratio, 0.0);
}

/* What grows by 1 + g in all directions does so at the rate g / (1 + g) of what it is in the end; its turn stays. */
static void end_growth(int n, double D[9])
{
    const double growth = fmax(matrix_trace(n, D), 0.0), taken = growth / (1.0 + growth);
    double old[9];
    memcpy(old, D, sizeof old);
    for (int r = 0; r < n; r++)
        for (int c = 0; c < n; c++) D[r * 3 + c] -= taken * 0.5 * (old[r * 3 + c] + old[c * 3 + r]);
}

static double reference_densest(const RefGrid *grid, const RefParticle *p)
{
    const RefStencil s = reference_stencil(grid->dimension, p);
    double most = 0.0;
    for (int i = 0; i < s.count; i++) most = fmax(most, grid->node[reference_index(grid, s.node[i])].volume);
    return most;
}

static double gap_at(const RefGrid *grid, const RefParticle *p)
{
    const RefStencil s = reference_stencil(grid->dimension, p);
    double sum = 0.0;
    for (int i = 0; i < s.count; i++) sum += s.weight[i] * grid->node[reference_index(grid, s.node[i])].gap;
    return sum;
}

/* J follows the density that the grid holds: where that is above 1, its inverse; where it is below 1, up to 1.15, but 1 where
 * any node that the particle feels holds 1 (the surface of a pool), within the noise of the filling, and no gap is there. */
static void integrate_tensionless(const RefStep *step, const RefGrid *grid, RefParticle *p, const double d[3], const double D[9])
{
    const double feedback = (double)p->material.volume_feedback;
    double ratio = fmin(p->volume_ratio * (1.0 + matrix_trace(step->dimension, D)), LOOSE_MAX);
    if (step->with_volume && feedback > 0.0) {
        const double held = reference_held(step, grid, p);
        const double parted = 1.0 / fmax(1.0 - gap_at(grid, p), 1.0 / LOOSE_MAX);
        const double loose = fmax(fmin(fmax(REF_COMPRESSED / reference_densest(grid, p), 1.0), LOOSE_MAX), parted);
        ratio = fmin(reference_control(step, grid, p, D) * ratio, LOOSE_MAX);
        const double missing = fmin(1.0 / held, loose) - ratio;
        ratio += feedback * (step->quiet_way > 0.0 ? quiet_feedback(step, d, ratio, ratio + missing) : feedback_share(step, d, missing) * missing);
        if (held > REF_CROWDED) nudge(step, p);
    }
    p->volume_ratio = fmin(fmax(ratio, RATIO_MIN), LOOSE_MAX);
}

static void integrate_elastic(const RefStep *step, RefParticle *p, const double D[9])
{
    double next[9] = {0};
    advance(step->dimension, D, p->deformation, next);
    if (!reference_limit_strain(step->dimension, &p->material, next)) p->status = K_CONDITION;
    memcpy(p->deformation, next, sizeof next);
    p->volume_ratio = matrix_determinant(step->dimension, next);
}

/* No turn has a skew part above 1; faster spin is cut to that of 60 degrees per substep. */
static void limit_spin(int n, double D[9])
{
    double spin = 0.0, old[9];
    memcpy(old, D, sizeof old);
    for (int r = 0; r < n; r++)
        for (int c = r + 1; c < n; c++) spin = hypot(spin, 0.5 * (old[r * 3 + c] - old[c * 3 + r]));
    for (int r = 0; r < n && spin > REF_SPIN_MAX; r++)
        for (int c = 0; c < n; c++) D[r * 3 + c] -= (1.0 - REF_SPIN_MAX / spin) * 0.5 * (old[r * 3 + c] - old[c * 3 + r]);
}

/* `motion` is what becomes the velocity. */
static void move(const RefStep *step, RefParticle *p, const double d[3], const double motion[3])
{
    double length = 0.0;
    for (int a = 0; a < step->dimension; a++) length += d[a] * d[a];
    length = sqrt(length);
    const double slow = length > step->max_displacement ? step->max_displacement / length : 1.0;
    for (int a = 0; a < step->dimension; a++) {
        const double place = p->fraction[a] + slow * d[a], cells = floor(place + 0.5);
        p->fraction[a] = place - cells;
        p->cell[a] += (int32_t)cells;
        if (abs(p->cell[a]) > step->max_cell) p->status = K_OUT_OF_RANGE;
        p->velocity[a] = slow * motion[a] / (step->dt * step->cells_per_metre);
    }
}

bool reference_flips(const RefStep *step, const RefParticle *p)
{
    return step->base && p->material.kind == K_LIQUID && p->material.viscous_share == 0.0f;
}

/* The predictor without gravity is what the transfer to the nodes made of the particle's own displacement. */
static void keep_fine_motion(const RefStep *step, const RefParticle *p, const double D[9], double d[3], double motion[3])
{
    double carried[3], unused[9];
    reference_gather(step->base, p, carried, unused);
    for (int a = 0; a < step->dimension; a++) {
        const double own = p->velocity[a] * step->dt * step->cells_per_metre;
        const double lost = own - (carried[a] - step->gravity[a]);
        motion[a] += step->flip * lost;
        if (matrix_trace(step->dimension, D) > 0.0) d[a] += step->flip * lost; /* places follow where matter parts */
    }
}

double reference_sparsest(const RefGrid *grid, const RefParticle *p)
{
    const RefStencil s = reference_stencil(grid->dimension, p);
    double least = INFINITY;
    for (int i = 0; i < s.count; i++) least = fmin(least, grid->node[reference_index(grid, s.node[i])].volume);
    return least;
}

double reference_excess(const RefGrid *grid, const RefParticle *p, uint32_t count)
{
    double claimed = 0.0, there = 0.0;
    for (uint32_t i = 0; i < count; i++) {
        if (p[i].material.kind != K_LIQUID || p[i].material.volume_share == 0.0f || reference_sparsest(grid, &p[i]) <= REF_INNER) continue;
        const double rest = p[i].mass * (double)p[i].material.inverse_density, held = reference_compression(grid, &p[i]);
        if (held > REF_CRUSHED) continue;
        claimed += rest * p[i].volume_ratio;
        there += rest / held;
    }
    return there > 0.0 ? fmin(fmax(claimed / there - 1.0, -0.05), 0.05) : 0.0;
}

double reference_shift(const RefGrid *grid, const RefParticle *p, const double D[9], double shift[3])
{
    const double share = fmin(4.0 * reference_strain(grid->dimension, D), 0.1);
    const RefStencil s = reference_stencil(grid->dimension, p);
    double size = 0.0, slope[27][3];
    reference_slopes(grid->dimension, p, slope);
    for (int c = 0; c < grid->dimension; c++) {
        double gradient = 0.0, sizes = 0.0;
        for (int i = 0; i < s.count; i++) {
            const double volume = grid->node[reference_index(grid, s.node[i])].volume;
            gradient += slope[i][c] * fmin(fmax(volume - 1.0, 0.0), REF_CRUSHED - 1.0);
            sizes += fabs(slope[i][c]) * (volume + 1.0);
        }
        shift[c] = -fmin(fmax(share * gradient, -0.05), 0.05);
        size = fmax(size, sizes);
    }
    return size;
}

/* Crowded matter stays, and what only seems to be: at edges of obstacles. */
static bool shifts(const RefStep *step, const RefGrid *grid, const RefParticle *p)
{
    if (!step->with_volume || p->material.kind != K_LIQUID || p->material.volume_share == 0.0f) return false;
    if (step->edged && reference_densest(grid, p) > REF_CRUSHED) return false;
    return reference_compression(grid, p) <= REF_CROWDED;
}

void reference_integrate(const RefStep *step, const RefGrid *grid, RefParticle *p)
{
    double d[3], D[9], motion[3], way[3], shift[3] = {0};
    const bool is_crushed = step->with_volume && p->material.volume_feedback > 0.0f && reference_compression(grid, p) > REF_CRUSHED;
    const bool has_eddies = p->material.kind == K_LIQUID && !is_crushed;
    reference_gather(grid, p, d, D);
    if (shifts(step, grid, p)) reference_shift(grid, p, D, shift);
    memcpy(motion, d, sizeof motion);
    memcpy(way, d, sizeof way);
    if (reference_flips(step, p)) keep_fine_motion(step, p, D, d, motion);
    if (p->material.kind == K_SOLID) {
        double gradient[9];
        reference_gradient(grid, p, gradient);
        integrate_elastic(step, p, gradient);
        limit_spin(step->dimension, D);
    } else if (step->tensionless) {
        integrate_tensionless(step, grid, p, way, D);
        end_growth(step->dimension, D);
    } else {
        integrate_liquid(step, grid, p, D);
    }
    for (int a = 0; a < step->dimension; a++) p->fraction[a] += shift[a];
    move(step, p, d, motion);
    const double kept = has_eddies ? 1.0 - step->affine_lost : 1.0;
    for (int k = 0; k < 9; k++) p->affine[k] = kept * D[k] / step->dt;
}
