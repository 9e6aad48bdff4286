#include "holds.h"

#include <math.h>
#include <string.h>

/* How far from a surface [cells] a node that was put onto it may be, by rounding. */
static const float TOUCH = 1e-5f;

static bool is_held(const Contact *contact) { return contact->friction == PBMPM_FRICTION_STICK && contact->gap == 0.0f; }

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

static void put_back(const Contact *contact, float *u)
{
    if (is_held(contact)) {
        for (int a = 0; a < 3; a++) u[a] = contact->surface[a];
        return;
    }
    const float excess = excess_of(contact, u);
    for (int a = 0; a < 3 && excess > 0.0f; a++) u[a] += excess * contact->normal[a];
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

void holds_project(const ContactFrame *frame, float *displacement, int32_t begin, int32_t end)
{
    if (frame->colliders->contacts == 0) return;
    for (int32_t block = begin; block < end; block++) {
        const BlockContacts list = contacts_of(frame, block);
        for (int sweep = 0; sweep < 2; sweep++) /* a corner between slanted surfaces */
            for (uint32_t i = list.begin; i < list.end; i++) put_back(&list.contact[i], node_of(&list, i, displacement));
    }
}

void holds_find(const ContactFrame *frame, const float *displacement, float *gradient, int32_t begin, int32_t end)
{
    if (frame->colliders->contacts == 0) return;
    for (int32_t block = begin; block < end; block++) {
        const BlockContacts list = contacts_of(frame, block);
        for (uint32_t i = list.begin; i < list.end; i++) {
            Contact *contact = &list.contact[i];
            const float *u = displacement + list.node + contact->node * K_NODE_WIDTH;
            float *g = node_of(&list, i, gradient);
            const bool pushes = !is_held(contact) && excess_of(contact, u) > -TOUCH && along(g, contact->normal) > 0.0f;
            contact->active = pushes || is_held(contact);
            if (contact->active) take_out(contact, g);
        }
    }
}

void holds_remove(const ContactFrame *frame, float *vector, int32_t begin, int32_t end)
{
    if (frame->colliders->contacts == 0) return;
    for (int32_t block = begin; block < end; block++) {
        const BlockContacts list = contacts_of(frame, block);
        for (int sweep = 0; sweep < 2; sweep++)
            for (uint32_t i = list.begin; i < list.end; i++)
                if (list.contact[i].active) take_out(&list.contact[i], node_of(&list, i, vector));
    }
}

/* As obey() in colliders.c, with the normal impulse that the solution found. */
static void rub(const Contact *contact, float impulse, float *u)
{
    float v[3], tangent2 = 0.0f;
    for (int a = 0; a < 3; a++) v[a] = u[a] - contact->surface[a];
    const float normal_part = along(v, contact->normal);
    for (int a = 0; a < 3; a++) {
        v[a] -= normal_part * contact->normal[a];
        tangent2 += v[a] * v[a];
    }
    const float lost = contact->coefficient * impulse;
    const float keep = contact->friction == PBMPM_FRICTION_STICK || tangent2 <= lost * lost ? 0.0f : 1.0f - lost / sqrtf(tangent2);
    for (int a = 0; a < 3; a++) u[a] = contact->surface[a] + normal_part * contact->normal[a] + keep * v[a];
}

void holds_rub(const ContactFrame *frame, const float *gradient, const float *mass_node, float *displacement,
               int32_t begin, int32_t end)
{
    if (frame->colliders->contacts == 0) return;
    for (int32_t block = begin; block < end; block++) {
        const BlockContacts list = contacts_of(frame, block);
        for (uint32_t i = list.begin; i < list.end; i++) {
            const Contact *contact = &list.contact[i];
            const size_t node = list.node + contact->node * K_NODE_WIDTH;
            if (!list.contact[i].active || is_held(contact) || contact->friction == PBMPM_FRICTION_SLIP) continue;
            const float mass = mass_node[node + 3];
            if (mass > 0.0f) rub(contact, along(gradient + node, contact->normal) / mass, displacement + node);
        }
    }
}

static void book_contact(const BlockContacts *list, uint32_t i, float *gradient, float *before, const float *after, const float *base, double *booked)
{
    const size_t node = list->node + list->contact[i].node * K_NODE_WIDTH;
    const float held[3] = {gradient[node], gradient[node + 1], gradient[node + 2]};
    if (!list->contact[i].active) return;
    take_out(&list->contact[i], gradient + node);
    for (size_t a = 0; a < 3; a++) {
        const double rubbed = (double)base[node + 3] * ((double)after[node + a] - (double)before[node + a]);
        booked[a] += (double)held[a] - (double)gradient[node + a] + rubbed;
        before[node + a] = after[node + a];
    }
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

void holds_book(const ContactFrame *frame, float *gradient, float *before, const float *after, const float *base)
{
    const Colliders *colliders = frame->colliders;
    double *booked = colliders->impulses.contact.data, missing[3];
    if (!colliders->measures || colliders->contacts == 0) return;
    memset(booked, 0, 3 * (size_t)colliders->contacts * sizeof *booked);
    for (int32_t block = 0; block < frame->grid->node_blocks; block++) {
        const BlockContacts list = contacts_of(frame, block);
        for (int sweep = 0; sweep < 2; sweep++)
            for (uint32_t i = list.begin; i < list.end; i++) book_contact(&list, i, gradient, before, after, base, booked + 3 * (size_t)i);
    }
    sum_gained(frame->grid, after, base, missing);
    for (uint32_t i = 0; i < colliders->contacts; i++)
        for (size_t a = 0; a < 3; a++) missing[a] -= booked[3 * (size_t)i + a];
    share_missing(frame, missing, after, base);
}

double holds_work(const ContactFrame *frame, const float *gradient, int32_t block)
{
    double work = 0.0;
    if (frame->colliders->contacts == 0) return work;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        const float *g = gradient + list.node + list.contact[i].node * K_NODE_WIDTH;
        if (list.contact[i].active) work += fmax(0.0, (double)along(g, list.contact[i].surface));
    }
    return work;
}

void holds_turn_aside(const ContactFrame *frame, int32_t block, double displacement[3])
{
    if (frame->colliders->contacts == 0) return;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) {
        const Contact *contact = &list.contact[i];
        if (!contact->active) continue;
        double inward = 0.0;
        for (int a = 0; a < 3; a++) inward += (displacement[a] - (double)contact->surface[a]) * (double)contact->normal[a];
        for (int a = 0; a < 3; a++) {
            if (is_held(contact)) displacement[a] = 0.0;
            if (inward < 0.0) displacement[a] -= inward * (double)contact->normal[a];
        }
    }
}

uint32_t holds_touching(const ContactFrame *frame, int32_t block)
{
    uint32_t count = 0;
    if (frame->colliders->contacts == 0) return 0;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++) count += list.contact[i].active && !is_held(&list.contact[i]);
    return count;
}

bool holds_any(const ContactFrame *frame, int32_t block)
{
    if (frame->colliders->contacts == 0) return false;
    const BlockContacts list = contacts_of(frame, block);
    for (uint32_t i = list.begin; i < list.end; i++)
        if (list.contact[i].gap <= 0.0f) return true;
    return false;
}

void holds_share(const ContactFrame *frame, float *share, int32_t begin, int32_t end)
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
