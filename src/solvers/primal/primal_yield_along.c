/* Matter that goes along with what it presses.
 *
 * Were nodes at contacts alone to follow a rigid body, each of its steps would strain one layer of cells. That is stiff, and steps would be short: a plank on crates took ten
 * times the iterations. So nodes behind follow, too, by a share f: u += f C W q. f is the linear function of place that fits best to 1 at contacts with the body and to 0 at
 * all other active ones, within [0, 1]. So what is pressed between two is strained evenly; and what touches nothing else goes along as a whole.
 *
 * Its cost per q is, with k_i the nodes' stiffnesses of the preconditioner, the even strain's energy for the slope b of f:
 *
 *     D = 1 + sum over nodes W' C' (m f^2 + k |b|^2 / 6) C W.
 *
 * Of a strain E phi'' is about m_p/4 (2 mu + lambda) E:E, and k_i = sum m_p w_ip h_p with h_p = 3/2 (2 mu + ...): a sixth of it. It errs on the stiff side. */
#include <math.h>
#include <string.h>

#include "contact/contact_constraints.h"
#include "solvers/primal/primal_yield_bodies.h"

void yield_find_pairs(Primal *p)
{
    YieldList *list = yield_list(p);
    const YieldGrip *grip = yield_grips(p);
    YieldPair *pair = yield_pairs(p);
    list->pairs = 0;
    for (uint32_t g = 0; g < list->grips; g++) {
        const int32_t matter = yield_matter(p, grip[g].block);
        uint32_t i = 0;
        if (!yield_contacts(p)[grip[g].contact].active) continue;
        while (i < list->pairs && !(pair[i].matter == matter && pair[i].body == grip[g].body)) i++;
        if (i == list->pairs) pair[list->pairs++] = (YieldPair){.matter = matter, .body = grip[g].body};
    }
}

void yield_corner(const Primal *p, const YieldPair *pair, int32_t block, double corner[3])
{
    const double *centre = yield_bodies(p)[pair->body].obstacle->body->begins;
    contacts_node_position(p->contacts, block, 0, corner);
    for (int a = 0; a < 3; a++) corner[a] = a < p->world->grid.dimension ? (corner[a] - centre[a]) / p->contacts->cell_size : 0.0;
}

/* ---- The share f ---- */

static void add_place(const Primal *p, YieldPair *pair, int32_t block, const Contact *contact)
{
    const double along = yield_bodies(p)[pair->body].obstacle - p->contacts->colliders->obstacle == contact->obstacle;
    double x[3];
    yield_corner(p, pair, block, x);
    primal_arm(x, contact->node, x);
    pair->sum[0] += 1.0;
    pair->sum[1] += along;
    for (int a = 0; a < 3; a++) {
        pair->sum[2 + a] += x[a];
        pair->sum[5 + a] += along * x[a];
        for (int b = 0; b < 3; b++) pair->square[a][b] += x[a] * x[b];
    }
}

/* f = mean + slope.(x - middle), by least squares. */
static void fit(YieldPair *pair)
{
    static const double RIDGE = 1e-3; /* of the mean square: contacts in a line or plane say nothing of what is across */
    const double n = pair->sum[0];
    SmallMatrix m;
    double trace = 1.0;
    pair->mean = pair->sum[1] / n;
    for (int a = 0; a < 3; a++) {
        pair->middle[a] = pair->sum[2 + a] / n;
        pair->slope[a] = pair->sum[5 + a] / n - pair->mean * pair->middle[a];
    }
    for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) m[a][b] = pair->square[a][b] / n - pair->middle[a] * pair->middle[b];
    for (int a = 0; a < 3; a++) trace += m[a][a];
    for (int a = 0; a < 3; a++) m[a][a] += RIDGE * trace;
    cholesky_factor(m, 3, RIDGE);
    cholesky_forward(m, pair->slope, 3);
    cholesky_backward(m, pair->slope, 3);
}

static void fit_pairs(Primal *p)
{
    YieldPair *pair = yield_pairs(p);
    for (int32_t block = 0; block < p->world->grid.node_blocks; block++)
        for (uint32_t k = 0; k < yield_list(p)->pairs; k++)
            for (uint32_t i = yield_first(p, block); i < yield_end(p, block) && pair[k].matter == yield_matter(p, block); i++)
                if (yield_contacts(p)[i].active) add_place(p, &pair[k], block, yield_contacts(p) + i);
    for (uint32_t k = 0; k < yield_list(p)->pairs; k++) fit(&pair[k]);
}

static double share_at(const YieldPair *pair, const double x[3])
{
    double share = pair->mean;
    for (int a = 0; a < 3; a++) share += pair->slope[a] * (x[a] - pair->middle[a]);
    return fmin(1.0, fmax(0.0, share));
}

/* ---- D ---- */

void yield_sum_moments(double weight, const double x[3], double sum[YIELD_MOMENTS])
{
    sum[0] += weight;
    for (int a = 0; a < 3; a++) {
        sum[1 + a] += weight * x[a];
        sum[4 + a] += weight * x[a] * x[a];
        sum[7 + a] += weight * x[(a + 1) % 3] * x[(a + 2) % 3];
    }
}

/* C' C = (1, [x]'; [x], -[x][x]), of w x x = -[x] w. */
void yield_add_moments(const double sum[YIELD_MOMENTS], YieldBody *body)
{
    double m[6][6] = {{0}};
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        m[a][a] = sum[0];
        m[a][3 + b] = m[3 + b][a] = sum[1 + c];
        m[a][3 + c] = m[3 + c][a] = -sum[1 + b];
        m[3 + a][3 + a] = sum[4 + b] + sum[4 + c];
        m[3 + b][3 + c] = m[3 + c][3 + b] = -sum[7 + a];
    }
    for (int c = 0; c < WAYS; c++) {
        double moved[6] = {0};
        for (int i = 0; i < 6; i++)
            for (int j = 0; j < 6; j++) moved[i] += m[i][j] * body->way[c][j];
        for (int r = 0; r < WAYS; r++)
            for (int i = 0; i < 6; i++) body->factor[r][c] += body->way[r][i] * moved[i];
    }
}

static void sum_cost(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    const YieldPair *pair = p->pair;
    const float *inverse = yield_state(p)->inverse.data;
    const double steep = (pair->slope[0] * pair->slope[0] + pair->slope[1] * pair->slope[1] + pair->slope[2] * pair->slope[2]) / 6.0;
    double corner[3], x[3];
    if (yield_matter(p, block) != pair->matter) return;
    yield_corner(p, pair, block, corner);
    for (size_t i = begin; i < end; i += W) {
        const double mass = (double)p->base[i + 3];
        if (!(inverse[i / W] > 0.0f)) continue;
        primal_arm(corner, (i - begin) / W, x);
        const double share = share_at(pair, x);
        yield_sum_moments(mass * share * share + (1.0 / (double)inverse[i / W] - mass) * steep, x, sum);
    }
}

void yield_weigh_along(Primal *p)
{
    YieldBody *body = yield_bodies(p);
    yield_find_pairs(p);
    fit_pairs(p);
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) yield_begin_factor(&body[b]);
    for (uint32_t k = 0; k < yield_list(p)->pairs; k++) {
        p->pair = &yield_pairs(p)[k];
        primal_over_blocks(p, sum_cost);
        yield_add_moments(p->total, &body[p->pair->body]);
    }
    for (uint32_t b = 0; b < yield_list(p)->bodies; b++) cholesky_factor(body[b].factor, WAYS, 1.0);
}

/* ---- Going along ---- */

static void sum_along(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    double corner[3], x[3], push[3];
    if (yield_matter(p, block) != p->pair->matter) return;
    yield_corner(p, p->pair, block, corner);
    for (size_t i = begin; i < end; i += W) {
        primal_arm(corner, (i - begin) / W, x);
        const double share = share_at(p->pair, x);
        for (size_t a = 0; a < 3; a++) push[a] = share * (double)p->right[i + a];
        yield_add_moment(push, x, sum);
    }
}

void yield_fold_along(Primal *p)
{
    for (uint32_t k = 0; k < yield_list(p)->pairs; k++) {
        p->pair = &yield_pairs(p)[k];
        YieldBody *body = &yield_bodies(p)[p->pair->body];
        primal_over_blocks(p, sum_along);
        yield_add_push(body, p->total, body->direction);
    }
}

static void spread_block(const Primal *p, const YieldPair *pair, int32_t block, float *along)
{
    const float *base = p->base + (size_t)block * (size_t)p->floats;
    const YieldBody *body = &yield_bodies(p)[pair->body];
    double motion[6], corner[3], x[3], moved[3];
    yield_motion(body, body->direction, motion);
    yield_corner(p, pair, block, corner);
    for (size_t i = 0; i < (size_t)p->floats; i += W) {
        if (!(base[i + 3] > 0.0f)) continue;
        primal_arm(corner, i / W, x);
        yield_motion_at(motion, x, moved);
        const double share = share_at(pair, x);
        for (size_t a = 0; a < 3; a++) along[i + a] += (float)(share * moved[a]);
    }
}

static void spread(Primal *p, int32_t block, size_t begin, size_t end, double *sum)
{
    float along[BLOCK_FLOATS] = {0};
    bool any = false;
    for (uint32_t k = 0; k < yield_list(p)->pairs; k++) {
        if (yield_pairs(p)[k].matter != yield_matter(p, block)) continue;
        spread_block(p, &yield_pairs(p)[k], block, along);
        any = true;
    }
    if (!any) return;
    constraints_remove_from(p->contacts, along, block);
    for (size_t i = begin; i < end; i++) {
        p->direction[i] += along[i - begin];
        for (int k = 0; k < p->joined->pairs; k++) sum[k] += (double)primal_change_of(p, p->joined, k)[i] * (double)along[i - begin];
    }
}

void yield_spread_along(Primal *p, double total[SUMS])
{
    primal_over_blocks(p, spread);
    for (int k = 0; k < p->joined->pairs; k++) total[k] += p->total[k];
}
