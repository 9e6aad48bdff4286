#include "contact/contacts.h"

#include <math.h>

/* ---- Nodes ---- */

void contacts_node_position(const ContactFrame *frame, int32_t block, int node, double point[3])
{
    const int32_t *corner = (const int32_t *)frame->grid->coordinate.data + 3 * block;
    const int local[3] = {node & 3, node >> 2 & 3, node >> 4};
    for (int a = 0; a < 3; a++)
        point[a] = a < frame->grid->dimension ? (double)(frame->grid->anchor[a] + corner[a] * K_BLOCK_AXIS + local[a]) * frame->cell_size : 0.0;
}

void contacts_block_centre(const ContactFrame *frame, int32_t block, double centre[3])
{
    contacts_node_position(frame, block, 0, centre);
    for (int a = 0; a < frame->grid->dimension; a++) centre[a] += 0.5 * (K_BLOCK_AXIS - 1) * frame->cell_size;
}

uint32_t contacts_block_groups(const ContactFrame *frame, int32_t block)
{
    const size_t cells = (size_t)frame->grid->block_cells;
    uint32_t groups = 0;
    for (size_t i = 0; frame->groups && i < cells; i++) groups |= frame->groups[(size_t)block * cells + i];
    return !frame->groups ? ALL_GROUPS : groups ? groups : frame->present;
}

uint32_t colliders_contacts(const Colliders *colliders)
{
    const Contact *contact = colliders->contact.data;
    uint32_t count = 0;
    for (uint32_t i = 0; i < colliders->contacts; i++) count += contact[i].obstacle < colliders->obstacle_count;
    return count;
}

/* ---- Obeying contacts ---- */

/* Relative to the surface the node may approach by the gap and no further: u.n >= -gap. The impulse that this takes limits
 * the friction: the tangential part loses at most coefficient times as much (Coulomb's cone). */
static void obey(const Contact *contact, float *u)
{
    const float *n = contact->normal, *s = contact->surface;
    float v[3], normal_part = 0.0f, tangent2 = 0.0f;
    for (int a = 0; a < 3; a++) {
        v[a] = u[a] - s[a];
        normal_part += v[a] * n[a];
    }
    const bool held = contact->friction == PBMPM_FRICTION_STICK;
    const float impulse = -contact->gap - normal_part;
    if (impulse <= 0.0f && !(held && contact->gap == 0.0f)) return;
    for (int a = 0; a < 3; a++) {
        v[a] -= normal_part * n[a];
        tangent2 += v[a] * v[a];
    }
    float keep = contact->friction == PBMPM_FRICTION_SLIP ? 1.0f : 0.0f;
    if (contact->friction == PBMPM_FRICTION_COULOMB) {
        const float lost = contact->coefficient * impulse;
        keep = tangent2 > lost * lost ? 1.0f - lost / sqrtf(tangent2) : 0.0f;
    }
    for (int a = 0; a < 3; a++) u[a] = s[a] - contact->gap * n[a] + keep * v[a];
}

/* The same, with the change of the node's momentum written down. */
static void obey_and_book(const Impulses *impulses, const Contact *contact, uint32_t index, float *u)
{
    double *booked = (double *)impulses->contact.data + 3 * (size_t)index;
    const float before[3] = {u[0], u[1], u[2]};
    obey(contact, u);
    for (int a = 0; a < 3; a++) booked[a] = (impulses->adds_up ? booked[a] : 0.0) + (double)u[3] * ((double)u[a] - (double)before[a]);
}

void contacts_apply(const ContactFrame *frame, int32_t begin, int32_t end)
{
    const Colliders *colliders = frame->colliders;
    if (colliders->contacts == 0) return;
    const Grid *grid = frame->grid;
    const uint32_t *contact_begin = colliders->contact_begin.data;
    for (int32_t block = begin; block < end; block++) {
        float *node = (float *)grid->node.data + (size_t)block * (size_t)grid->block_cells * K_NODE_WIDTH;
        for (uint32_t i = contact_begin[block]; i < contact_begin[block + 1]; i++) {
            const Contact *contact = (const Contact *)colliders->contact.data + i;
            if (colliders->measures && !contact->walled)
                obey_and_book(&colliders->impulses, contact, i, node + contact->node * K_NODE_WIDTH);
            else
                obey(contact, node + contact->node * K_NODE_WIDTH);
        }
    }
}

void contacts_apply_walled(const ContactFrame *frame, int32_t begin, int32_t end)
{
    const uint32_t *contact_begin = frame->colliders->contact_begin.data;
    for (int32_t block = begin; block < end; block++) {
        float *node = (float *)frame->grid->node.data + (size_t)block * (size_t)frame->grid->block_cells * K_NODE_WIDTH;
        for (uint32_t i = contact_begin[block]; i < contact_begin[block + 1]; i++) {
            const Contact *contact = (const Contact *)frame->colliders->contact.data + i;
            if (contact->walled) obey(contact, node + contact->node * K_NODE_WIDTH);
        }
    }
}

void contacts_hold(const ContactFrame *frame, int32_t begin, int32_t end)
{
    const Colliders *colliders = frame->colliders;
    if (colliders->contacts == 0) return;
    const uint32_t *contact_begin = colliders->contact_begin.data;
    for (int32_t block = begin; block < end; block++) {
        float *node = (float *)frame->grid->node.data + (size_t)block * (size_t)frame->grid->block_cells * K_NODE_WIDTH;
        for (uint32_t i = contact_begin[block]; i < contact_begin[block + 1]; i++) {
            const Contact *contact = (const Contact *)colliders->contact.data + i;
            if (contact->gap > 0.0f) continue;
            float *u = node + contact->node * K_NODE_WIDTH, along = 0.0f;
            const bool held = contact->friction == PBMPM_FRICTION_STICK;
            for (int a = 0; a < 3; a++) along += u[a] * contact->normal[a];
            for (int a = 0; a < 3; a++) u[a] = held ? 0.0f : u[a] - along * contact->normal[a];
        }
    }
}

double contacts_momentum_scale(const ContactFrame *frame)
{
    return pow(frame->cell_size, frame->grid->dimension) * frame->cell_size / frame->substep->dt;
}

bool contacts_held_gain(const ContactFrame *frame, int32_t block, int node, double gained[3])
{
    const Colliders *colliders = frame->colliders;
    if (colliders->contacts == 0 || !frame->grabbed || !(frame->grabbed[block] >> node & 1)) return false;
    const uint32_t *begin = (const uint32_t *)colliders->contact_begin.data + block;
    const double *booked = colliders->impulses.contact.data;
    for (uint32_t i = begin[0]; i < begin[1]; i++) {
        const Contact *contact = (const Contact *)colliders->contact.data + i;
        if (contact->node != node || contact->obstacle != colliders->obstacle_count) continue;
        for (int a = 0; a < 3; a++) gained[a] = contacts_momentum_scale(frame) * booked[3 * (size_t)i + (size_t)a];
        return true;
    }
    return false;
}

void contacts_book(const ContactFrame *frame)
{
    const Colliders *colliders = frame->colliders;
    if (!colliders->measures || colliders->contacts == 0) return;
    const uint32_t *contact_begin = colliders->contact_begin.data;
    const double *booked = colliders->impulses.contact.data;
    const double scale = contacts_momentum_scale(frame);
    for (int32_t block = 0; block < frame->grid->node_blocks; block++)
        for (uint32_t i = contact_begin[block]; i < contact_begin[block + 1]; i++) {
            const Contact *contact = (const Contact *)colliders->contact.data + i;
            const Obstacle *o = &colliders->obstacle[contact->obstacle];
            if (!o->measures) continue;
            double point[3], gained[3];
            contacts_node_position(frame, block, contact->node, point);
            for (int a = 0; a < 3; a++) gained[a] = scale * booked[3 * (size_t)i + (size_t)a];
            impulse_add(&colliders->impulses.sum[o->place], point, gained);
        }
}
