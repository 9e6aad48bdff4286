#include "contact/contact_constraints.h"

#include <math.h>
#include <string.h>

#include "base/vector.h"

/* How far from a surface [cells] a node that was put onto it may be, by rounding. */
static const float SURFACE_ROUNDING = 1e-5f;

/* Two particles a cell and axis stand a quarter of a cell inside their body: so near, what they weigh on touches [cells]. */
static const float STICK_DISTANCE = 0.25f;

static bool is_held(const Contact *contact) { return contact->friction == PBMPM_FRICTION_STICK && contact->gap < STICK_DISTANCE; }

static float along(const float *vector, const float *normal)
{
    return vector[0] * normal[0] + vector[1] * normal[1] + vector[2] * normal[2];
}

/* How far the node goes beyond what the contact allows [cells]. */
static float excess_of(const Contact *contact, const float *u)
{
    const float relative[3] = {u[0] - contact->surface[0], u[1] - contact->surface[1], u[2] - contact->surface[2]};
    return -contact->gap - along(relative, contact->normal);
}

static void put_on_surface(const Contact *contact, float *u)
{
    const float excess = excess_of(contact, u);
    for (int a = 0; a < 3; a++) u[a] += excess * contact->normal[a];
}

static void put_back(const Contact *contact, float *u)
{
    if (is_held(contact)) memcpy(u, contact->surface, sizeof contact->surface);
    else if (excess_of(contact, u) > 0.0f) put_on_surface(contact, u);
}

static void take_out(const Contact *contact, float *vector)
{
    const bool all = is_held(contact);
    const float part = along(vector, contact->normal);
    for (int a = 0; a < 3; a++) vector[a] = all ? 0.0f : vector[a] - part * contact->normal[a];
}

/* The contacts of a block, and where its nodes begin in an array of nodes. */
typedef struct BlockContacts {
    Contact *contact;
    uint32_t begin, end;
    size_t node;
} BlockContacts;

static BlockContacts contacts_of(const ContactFrame *frame, int32_t block)
{
    const uint32_t *begin = frame->colliders->contact_begin.data;
    return (BlockContacts){frame->colliders->contact.data, begin[block], begin[block + 1],
                           (size_t)block * (size_t)frame->grid->block_cells * K_NODE_WIDTH};
}

static float *node_of(const BlockContacts *list, uint32_t i, float *nodes) { return nodes + list->node + list->contact[i].node * K_NODE_WIDTH; }

void constraints_project(const ContactFrame *frame, float *displacement, int32_t begin, int32_t end)
{
    if (frame->colliders->contacts == 0) return;
    for (int32_t block = begin; block < end; block++) {
        const BlockContacts list = contacts_of(frame, block);
        for (int sweep = 0; sweep < 2; sweep++) /* a corner between slanted surfaces */
            for (uint32_t i = list.begin; i < list.end; i++)
                if (!list.contact[i].follows) put_back(&list.contact[i], node_of(&list, i, displacement));
    }
}

bool constraints_touch(const Contact *contact, const float *u) { return is_held(contact) || excess_of(contact, u) > -SURFACE_ROUNDING; }

bool constraints_push(const Contact *contact, const float *u, const float *gradient)
{
    return !is_held(contact) && constraints_touch(contact, u) && along(gradient, contact->normal) > 0.0f;
}

void constraints_lead(const Contact *contact, float *u)
{
    if (!is_held(contact) && contact->active) put_on_surface(contact, u);
    else put_back(contact, u);
}

void constraints_find_active(const ContactFrame *frame, const float *displacement, float *gradient, int32_t begin, int32_t end)
{
    if (frame->colliders->contacts == 0) return;
    for (int32_t block = begin; block < end; block++) {
        const BlockContacts list = contacts_of(frame, block);
        for (uint32_t i = list.begin; i < list.end; i++) {
            Contact *contact = &list.contact[i];
            const float *u = displacement + list.node + contact->node * K_NODE_WIDTH;
            float *g = node_of(&list, i, gradient);
            contact->active = is_held(contact) || constraints_push(contact, u, g);
            if (contact->active) take_out(contact, g);
        }
    }
}

void constraints_remove(const ContactFrame *frame, float *vector, int32_t begin, int32_t end)
{
    if (frame->colliders->contacts == 0) return;
    for (int32_t block = begin; block < end; block++) {
        const BlockContacts list = contacts_of(frame, block);
        for (int sweep = 0; sweep < 2; sweep++)
            for (uint32_t i = list.begin; i < list.end; i++)
                if (list.contact[i].active) take_out(&list.contact[i], node_of(&list, i, vector));
    }
}

void constraints_remove_led(const ContactFrame *frame, float *vector, int32_t block)
{
    if (frame->colliders->contacts == 0) return;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++)
        if (is_held(&list.contact[i]) || (list.contact[i].follows && list.contact[i].active)) take_out(&list.contact[i], node_of(&list, i, vector));
}

void constraints_remove_from(const ContactFrame *frame, float *vector, int32_t block)
{
    const BlockContacts list = contacts_of(frame, block);
    for (int sweep = 0; sweep < 2; sweep++)
        for (uint32_t i = list.begin; i < list.end; i++)
            if (list.contact[i].active) take_out(&list.contact[i], vector + list.contact[i].node * K_NODE_WIDTH);
}

void constraints_take_out(const Contact *contact, float *vector) { take_out(contact, vector); }

/* ---- Friction ---- */

/* Below this slip [cells per 1/60 s] friction grows with it: a kink that iterations could not find. By trial. */
static const float SLIP_MIN = 1e-4f;

/* What sticks rubs like this: the most that a collider may be given. */
static const float STICKS = 100.0f;

/* A body's momentum changes by what its contacts give, so this bounds what an unfinished solution says of their impulses. By trial: without a bound a crate on sand leans by
 * 5 degrees, not by 1 (tests/field/run.py rigid_on_sand --settings 60x5). */
static const double SCALE_MAX = 20.0;

bool constraints_stick(const Contact *contact) { return is_held(contact); }

float constraints_friction_coefficient(const Contact *contact)
{
    if (is_held(contact) || contact->friction == PBMPM_FRICTION_SLIP) return 0.0f;
    return contact->friction == PBMPM_FRICTION_STICK ? STICKS : contact->coefficient;
}

/* The slip of a node along the surface, and its length. */
static float slip_of(const Contact *contact, const float *u, float slip[3])
{
    float length2 = 0.0f;
    for (int a = 0; a < 3; a++) slip[a] = u[a] - contact->surface[a];
    const float part = along(slip, contact->normal);
    for (int a = 0; a < 3; a++) {
        slip[a] -= part * contact->normal[a];
        length2 += slip[a] * slip[a];
    }
    return sqrtf(length2);
}

/* Friction over slip. */
static float rub_of(const Contact *contact, float length, float least) { return contact->limit / fmaxf(length, least); }

float constraints_slip_min(const Substep *substep) { return SLIP_MIN * (float)substep->reference_steps; }

bool constraints_rub(const Contact *contact, const float *u, float least, float rub[3])
{
    if (!(contact->limit > 0.0f)) return false;
    const float factor = rub_of(contact, slip_of(contact, u, rub), least);
    for (int a = 0; a < 3; a++) rub[a] *= factor;
    return true;
}

float constraints_friction_stiffness(const Contact *contact, const float *u, float least)
{
    float slip[3];
    return contact->active && contact->limit > 0.0f ? rub_of(contact, slip_of(contact, u, slip), least) : 0.0f;
}

double constraints_friction(const ContactFrame *frame, const float *u, float *gradient, float sign, float least, int32_t block)
{
    double energy = 0.0;
    if (frame->colliders->contacts == 0) return energy;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        const Contact *contact = &list.contact[i];
        float slip[3];
        if (!(contact->limit > 0.0f)) continue;
        const float length = slip_of(contact, u + list.node + contact->node * K_NODE_WIDTH, slip);
        const float rub = rub_of(contact, length, least);
        float *g = node_of(&list, i, gradient);
        for (int a = 0; a < 3; a++) g[a] += sign * rub * slip[a];
        energy += (double)contact->limit * (length < least ? 0.5 * (double)(length * length / least) : (double)length - 0.5 * (double)least);
    }
    return energy;
}

void constraints_apply_friction_stiffness(const ContactFrame *frame, const float *u, const float *vector, float *to, float sign, float least, int32_t block)
{
    if (frame->colliders->contacts == 0) return;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        const Contact *contact = &list.contact[i];
        const size_t node = list.node + contact->node * K_NODE_WIDTH;
        const float rub = sign * constraints_friction_stiffness(contact, u + node, least), part = along(vector + node, contact->normal);
        for (size_t a = 0; a < 3 && rub != 0.0f; a++) to[node + a] += rub * (vector[node + a] - part * contact->normal[a]);
    }
}

void constraints_friction_diagonal(const ContactFrame *frame, const float *u, float *weight, float least, int32_t block)
{
    if (frame->colliders->contacts == 0) return;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        const Contact *contact = &list.contact[i];
        const size_t node = list.node + contact->node * K_NODE_WIDTH;
        const float rub = constraints_friction_stiffness(contact, u + node, least);
        for (size_t a = 0; a < 3 && rub > 0.0f; a++) weight[node + a] += rub * (1.0f - contact->normal[a] * contact->normal[a]);
    }
}

void constraints_soften(const ContactFrame *frame, const float *u, const float *inverse, float *vector, float least, int32_t block)
{
    if (frame->colliders->contacts == 0) return;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        const Contact *contact = &list.contact[i];
        const size_t node = list.node + contact->node * K_NODE_WIDTH;
        const float rub = constraints_friction_stiffness(contact, u + node, least), part = along(vector + node, contact->normal);
        const float less = rub > 0.0f ? 1.0f / (1.0f + rub * inverse[node / K_NODE_WIDTH]) - 1.0f : 0.0f;
        for (size_t a = 0; a < 3 && rub > 0.0f; a++) vector[node + a] += less * (vector[node + a] - part * contact->normal[a]);
    }
}

void constraints_pull(const ContactFrame *frame, const float *u, const double way[3], float least, int32_t block, double pull[3], double *stiffness)
{
    if (frame->colliders->contacts == 0) return;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        const Contact *contact = &list.contact[i];
        float moved[3], slip[3];
        if (!(contact->limit > 0.0f)) continue;
        for (int a = 0; a < 3; a++) moved[a] = u[list.node + contact->node * K_NODE_WIDTH + (size_t)a] + (float)way[a];
        const float rub = rub_of(contact, slip_of(contact, moved, slip), least);
        for (int a = 0; a < 3; a++) pull[a] -= (double)(rub * slip[a]);
        *stiffness += (double)rub;
    }
}

bool constraints_have_friction(const ContactFrame *frame)
{
    const Contact *contact = frame->colliders->contact.data;
    for (uint32_t i = 0; i < frame->colliders->contacts; i++)
        if (constraints_friction_coefficient(&contact[i]) > 0.0f) return true;
    return false;
}

static int group_for(BodyFriction *body, const float *normal)
{
    int nearest = 0;
    float most = -2.0f;
    for (int g = 0; g < body->groups; g++) {
        const float cosine = along(normal, body->group[g].normal);
        if (cosine > most) nearest = g;
        most = fmaxf(most, cosine);
    }
    if (most >= (float)SAME_DIRECTION || body->groups == FRICTION_GROUPS) return nearest; /* of a plane, a side of a box, a part of a ball */
    memcpy(body->group[body->groups].normal, normal, sizeof body->group->normal);
    return body->groups++;
}

void constraints_group(const ContactFrame *frame, const int32_t *body_of_block, BodyFriction *body)
{
    if (frame->colliders->contacts == 0) return;
    for (int32_t block = 0; block < frame->grid->node_blocks; block++) {
        const BlockContacts list = contacts_of(frame, block);
        for (uint32_t i = list.begin; i < list.end; i++)
            if (!is_held(&list.contact[i])) list.contact[i].group = (uint8_t)group_for(&body[body_of_block[block]], list.contact[i].normal);
    }
}

void constraints_sum_push(const ContactFrame *frame, const float *u, const float *gradient, float least, int32_t block, BodyFriction *body)
{
    if (frame->colliders->contacts == 0) return;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        Contact *contact = &list.contact[i];
        const size_t node = list.node + contact->node * K_NODE_WIDTH;
        float slip[3];
        body->held = body->held || (is_held(contact) && contact->active);
        if (is_held(contact)) continue;
        const double push = contact->active ? fmax(0.0, (double)along(gradient + node, contact->normal)) : 0.0;
        const float rub = contact->limit > 0.0f ? rub_of(contact, slip_of(contact, u + node, slip), least) : 0.0f;
        for (int a = 0; a < 3; a++) {
            body->group[contact->group].push[a] += push * (double)contact->normal[a];
            if (rub > 0.0f) body->gained[a] += (double)(rub * slip[a]);
        }
        contact->limit = (float)push; /* constraints_set_limits() makes it the limit */
    }
}

/* The scales s_k that change what groups of contacts push, R_k, least and make the body's momentum change by what they push: the least
 * |sum s_k R_k - gained|^2 + NEAR sum |R_k|^2 (s_k - before_k)^2. Twice, so that what NEAR keeps back is its square. */
void constraints_scale(BodyFriction *body)
{
    static const double NEAR = 1e-3; /* weight of keeping the scales: less is singular where groups push alike, and each round leaves the square of it */
    const int n = body->groups;
    for (int k = 0; k < n; k++) body->group[k].scale = 1.0;
    for (int round = 0; round < 2 && !body->held; round++) {
        double a[FRICTION_GROUPS][FRICTION_GROUPS + 1], missing[3];
        for (int c = 0; c < 3; c++) {
            missing[c] = body->gained[c];
            for (int k = 0; k < n; k++) missing[c] -= body->group[k].scale * body->group[k].push[c];
        }
        for (int r = 0; r < n; r++) {
            const double *push = body->group[r].push;
            for (int k = 0; k < n; k++) {
                const double *other = body->group[k].push;
                a[r][k] = push[0] * other[0] + push[1] * other[1] + push[2] * other[2];
            }
            a[r][n] = push[0] * missing[0] + push[1] * missing[1] + push[2] * missing[2];
            a[r][r] = a[r][r] > 0.0 ? a[r][r] * (1.0 + NEAR) : 1.0;
        }
        for (int k = 0; k < n; k++) /* positive definite: no pivots */
            for (int r = k + 1; r < n; r++)
                for (int c = n; c >= k; c--) a[r][c] -= a[r][k] / a[k][k] * a[k][c];
        for (int r = n - 1; r >= 0; r--) {
            for (int k = r + 1; k < n; k++) a[r][n] -= a[r][k] * a[k][n];
            a[r][n] /= a[r][r];
            body->group[r].scale += a[r][n];
        }
    }
    for (int k = 0; k < n; k++) body->group[k].scale = fmin(fmax(body->group[k].scale, 0.0), SCALE_MAX);
}

void constraints_set_limits(const ContactFrame *frame, int32_t block, const BodyFriction *body)
{
    if (frame->colliders->contacts == 0) return;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        Contact *contact = &list.contact[i];
        contact->limit *= is_held(contact) ? 0.0f : constraints_friction_coefficient(contact) * (float)body->group[contact->group].scale;
    }
}

/* ---- Impulses ---- */

static void book_contact(const BlockContacts *list, uint32_t i, float *gradient, const float *u, float least, bool rubs, double *booked)
{
    const Contact *contact = &list->contact[i];
    const size_t node = list->node + contact->node * K_NODE_WIDTH;
    const float held[3] = {gradient[node], gradient[node + 1], gradient[node + 2]};
    float slip[3];
    if (!contact->active) return;
    take_out(contact, gradient + node);
    const float rub = rubs && contact->limit > 0.0f ? rub_of(contact, slip_of(contact, u + node, slip), least) : 0.0f;
    for (size_t a = 0; a < 3; a++) booked[a] += (double)held[a] - (double)gradient[node + a] - (rub > 0.0f ? (double)(rub * slip[a]) : 0.0);
}

/* Momentum that the substep added to that of the predictor. */
static void sum_gained(const Grid *grid, const float *after, const float *base, double gained[3])
{
    const size_t floats = (size_t)grid->node_blocks * (size_t)grid->block_cells * K_NODE_WIDTH;
    gained[0] = gained[1] = gained[2] = 0.0;
    for (size_t i = 0; i < floats; i += K_NODE_WIDTH)
        for (size_t a = 0; a < 3; a++) gained[a] += (double)base[i + 3] * ((double)after[i + a] - (double)base[i + a]);
}

static double size_of(const double *v) { return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

/* What a contact answers for of momentum that no contact gave: in proportion to what it gave itself, or `by_gain` to what its node gained. */
static double weight_of(const BlockContacts *list, uint32_t i, const double *given, const float *after, const float *base, bool by_gain)
{
    const size_t node = list->node + list->contact[i].node * K_NODE_WIDTH;
    double gained[3];
    for (size_t a = 0; a < 3; a++) gained[a] = (double)base[node + 3] * ((double)after[node + a] - (double)base[node + a]);
    return size_of(by_gain ? gained : given);
}

/* An unfinished solution may change the momentum of matter that is beside a wall and no longer pushes it: then what the nodes gained decides. */
static void share_missing(const ContactFrame *frame, const double missing[3], const float *after, const float *base)
{
    double *booked = frame->colliders->impulses.contact.data, sum[2] = {0.0, 0.0};
    for (int32_t block = 0; block < frame->grid->node_blocks; block++) {
        const BlockContacts list = contacts_of(frame, block);
        for (uint32_t i = list.begin; i < list.end; i++)
            for (int k = 0; k < 2; k++) sum[k] += weight_of(&list, i, booked + 3 * (size_t)i, after, base, k == 1);
    }
    const bool by_gain = sum[0] == 0.0;
    for (int32_t block = 0; block < frame->grid->node_blocks && sum[by_gain] > 0.0; block++) {
        const BlockContacts list = contacts_of(frame, block);
        for (uint32_t i = list.begin; i < list.end; i++) {
            double *given = booked + 3 * (size_t)i;
            const double share = weight_of(&list, i, given, after, base, by_gain) / sum[by_gain];
            for (size_t a = 0; a < 3; a++) given[a] += share * missing[a];
        }
    }
}

void constraints_book_contacts(const ContactFrame *frame, float *gradient, const float *u, float least)
{
    const Colliders *colliders = frame->colliders;
    double *booked = colliders->impulses.contact.data;
    memset(booked, 0, 3 * (size_t)colliders->contacts * sizeof *booked);
    for (int32_t block = 0; block < frame->grid->node_blocks; block++) {
        const BlockContacts list = contacts_of(frame, block);
        for (int sweep = 0; sweep < 2; sweep++)
            for (uint32_t i = list.begin; i < list.end; i++) book_contact(&list, i, gradient, u, least, sweep == 0, booked + 3 * (size_t)i);
    }
}

void constraints_book_impulses(const ContactFrame *frame, float *gradient, const float *u, const float *after, const float *base, float least)
{
    const Colliders *colliders = frame->colliders;
    const double *booked = colliders->impulses.contact.data;
    double missing[3];
    if (!colliders->measures || colliders->contacts == 0) return;
    constraints_book_contacts(frame, gradient, u, least);
    sum_gained(frame->grid, after, base, missing);
    for (uint32_t i = 0; i < colliders->contacts; i++)
        for (size_t a = 0; a < 3; a++) missing[a] -= booked[3 * (size_t)i + a];
    share_missing(frame, missing, after, base);
}

void constraints_scale_impulses(const ContactFrame *frame, int32_t block, double factor)
{
    if (!frame->colliders->measures || frame->colliders->contacts == 0 || factor == 1.0) return;
    const BlockContacts list = contacts_of(frame, block);
    double *booked = frame->colliders->impulses.contact.data;
    for (size_t i = 3 * (size_t)list.begin; i < 3 * (size_t)list.end; i++) booked[i] *= factor;
}

double constraints_friction_loss(const ContactFrame *frame, const float *u, float least, int32_t block)
{
    double sum = 0.0;
    if (frame->colliders->contacts == 0) return sum;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        const Contact *contact = &list.contact[i];
        float slip[3];
        if (!(contact->limit > 0.0f)) continue;
        const float length = slip_of(contact, u + list.node + contact->node * K_NODE_WIDTH, slip);
        sum += (double)(rub_of(contact, length, least) * length * length);
    }
    return sum;
}

/* What an active contact gives its node. */
static void given_by(const Contact *contact, const float *gradient, const float *u, float least, float given[3])
{
    float slip[3];
    const float rub = contact->limit > 0.0f ? rub_of(contact, slip_of(contact, u, slip), least) : 0.0f;
    for (int a = 0; a < 3; a++) given[a] = gradient[a] - (rub > 0.0f ? rub * slip[a] : 0.0f);
}

/* What moves as the obstacle does: the surface, but for nodes that follow others. */
static const float *wall_of(const Contact *contact) { return contact->follows ? contact->wall : contact->surface; }

double constraints_work(const ContactFrame *frame, const float *gradient, const float *u, float least, int32_t block)
{
    double work = 0.0;
    if (frame->colliders->contacts == 0) return work;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        const Contact *contact = &list.contact[i];
        const size_t node = list.node + contact->node * K_NODE_WIDTH;
        float given[3];
        if (contact->stays || !contact->active) continue;
        given_by(contact, gradient + node, u + node, least, given);
        work += fmax(0.0, (double)along(given, wall_of(contact)));
    }
    return work;
}

/* Adds an impulse to what moves so. The motion of the surfaces is the mean of `surface`. */
static void add_exchange(const float given[3], const float moved[3], const float surface[3], ContactExchange *sum)
{
    const double size = sqrt((double)along(given, given));
    sum->work += (double)along(given, moved);
    sum->size += size;
    for (int a = 0; a < 3; a++) {
        sum->given[a] += (double)given[a];
        sum->surface[a] += size * (double)surface[a];
    }
}

void constraints_exchange(const ContactFrame *frame, const float *gradient, const float *u, float least, int32_t block, ContactExchange *sum)
{
    if (frame->colliders->contacts == 0) return;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        const Contact *contact = &list.contact[i];
        const size_t node = list.node + contact->node * K_NODE_WIDTH;
        float given[3];
        if (contact->stays || !contact->active) continue;
        given_by(contact, gradient + node, u + node, least, given);
        add_exchange(given, wall_of(contact), wall_of(contact), sum);
    }
}

void constraints_exchange_staying(const ContactFrame *frame, const float *gradient, int32_t block, ContactExchange *sum)
{
    if (frame->colliders->contacts == 0) return;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        const Contact *contact = &list.contact[i];
        const float *given = gradient + list.node + contact->node * K_NODE_WIDTH;
        if (!contact->stays || !is_held(contact)) continue;
        add_exchange(given, wall_of(contact), contact->wall, sum);
    }
}

double constraints_exchanged_work(const ContactExchange *all, const double gained[3])
{
    double work = all->work;
    for (int c = 0; c < 3 && all->size > 0.0; c++) work += (gained[c] - all->given[c]) * all->surface[c] / all->size;
    return work;
}

void constraints_turn_aside(const ContactFrame *frame, int32_t block, double displacement[3])
{
    if (frame->colliders->contacts == 0) return;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        const Contact *contact = &list.contact[i];
        if (!contact->active) continue;
        double inward = 0.0;
        for (int a = 0; a < 3; a++) inward += (displacement[a] - (double)contact->surface[a]) * (double)contact->normal[a];
        for (int a = 0; a < 3; a++) {
            if (is_held(contact)) displacement[a] = (double)contact->surface[a];
            if (inward < 0.0) displacement[a] -= inward * (double)contact->normal[a];
        }
    }
}

double constraints_free_share(const ContactFrame *frame, int32_t block, const double displacement[3])
{
    double share = 1.0;
    if (frame->colliders->contacts == 0) return share;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        const Contact *contact = &list.contact[i];
        double inward = 0.0, room = (double)contact->gap;
        for (int a = 0; a < 3; a++) {
            inward -= displacement[a] * (double)contact->normal[a];
            room -= (double)contact->surface[a] * (double)contact->normal[a];
        }
        if (inward > 0.0 && room < share * inward) share = fmax(0.0, room) / inward;
    }
    return share;
}

uint32_t constraints_active(const ContactFrame *frame, int32_t block)
{
    uint32_t count = 0;
    if (frame->colliders->contacts == 0) return 0;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) count += list.contact[i].active && !is_held(&list.contact[i]);
    return count;
}

uint32_t constraints_count(const ContactFrame *frame, int32_t block)
{
    if (frame->colliders->contacts == 0) return 0;
    const BlockContacts list = contacts_of(frame, block);
    return list.end - list.begin;
}

bool constraints_any_stick(const ContactFrame *frame, int32_t block)
{
    if (frame->colliders->contacts == 0) return false;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++)
        if (is_held(&list.contact[i])) return true;
    return false;
}

float constraints_room(const Contact *contact, const float *u) { return -excess_of(contact, u); }

uint64_t constraints_within(const ContactFrame *frame, float most, int32_t block)
{
    uint64_t nodes = 0;
    if (frame->colliders->contacts == 0) return nodes;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) nodes |= (uint64_t)(list.contact[i].gap <= most) << list.contact[i].node;
    return nodes;
}

void constraints_held_share(const ContactFrame *frame, float *share, int32_t begin, int32_t end)
{
    if (frame->colliders->contacts == 0) return;
    for (int32_t block = begin; block < end; block++) {
        const BlockContacts list = contacts_of(frame, block);
        for (uint32_t i = list.begin; i < list.end; i++) {
            const Contact *contact = &list.contact[i];
            float *s = node_of(&list, i, share);
            for (int a = 0; a < 3 && list.contact[i].active; a++) {
                const float held = is_held(contact) ? 1.0f : contact->normal[a] * contact->normal[a];
                s[a] = fminf(1.0f, s[a] + held);
            }
        }
    }
}
