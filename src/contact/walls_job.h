/* What the loops of walls_apply() share: vectors, and what E and E^T do at one node. */
#ifndef PBMPM_SRC_CONTACT_WALLS_JOB_H
#define PBMPM_SRC_CONTACT_WALLS_JOB_H

#include "contact/walls_list.h"

/* Vectors of 4 floats: per node momentum, u~, u, and the normal impulse; per entry what goes back through it. */
typedef struct Vectors {
    Four *momentum, *free, *moved, *back;
} Vectors;

/* The vector of a node; the fourth float means nothing. */
static inline Four load_node(const float *nodes, uint32_t node)
{
    const float *u = nodes + (size_t)node * K_NODE_WIDTH;
    return (Four){u[0], u[1], u[2], u[3]};
}

/* All but the mass. */
static inline void store_node(Four u, float *nodes, uint32_t node)
{
    for (size_t a = 0; a < 3; a++) nodes[(size_t)node * K_NODE_WIDTH + a] = u[a];
}

static inline Vectors vectors_of(const Walls *walls)
{
    Four *first = walls->vector.data;
    if (walls->nodes == 0) return (Vectors){0};
    return (Vectors){first, first + walls->nodes, first + 2 * (size_t)walls->nodes, first + WALL_VECTORS * (size_t)walls->nodes};
}

typedef struct ApplyJob {
    const Walls *walls;
    const ContactFrame *frame;
    Vectors v;
    float shifted; /* 1 with the walls' own motion, 0 without */
    const uint8_t *mark;
} ApplyJob;

static inline float *job_nodes(const ApplyJob *job) { return job->frame->grid->node.data; }

/* What is new of p is taken over. */
static inline void take_momentum(const ApplyJob *job, uint32_t i)
{
    const WallMotion *n = (const WallMotion *)job->walls->motion.data + i;
    if (!job->mark || job->mark[n->node / (uint32_t)job->frame->grid->block_cells]) job->v.momentum[i] = n->mass * load_node(job_nodes(job), n->node);
}

/* Per node what bodies that yield add to c0, see wall_bodies.h. */
static inline Four *yields_at(const ApplyJob *job) { return job->v.back + job->walls->entries; }

/* The wall's own motion c0 at a node. */
static inline Four shift_of(const ApplyJob *job, const WallMotion *n)
{
    const Four shift = job->shifted * n->shift;
    return job->walls->grips == 0 ? shift : shift + yields_at(job)[n - (const WallMotion *)job->walls->motion.data];
}

/* p - m c0 */
static inline Four rest_of(const ApplyJob *job, const WallMotion *n, Four p) { return p - n->mass * shift_of(job, n); }

/* What a node has itself of a vector. */
static inline Four own_of(const ApplyJob *job, uint32_t i, Four v)
{
    const WallMotion *n = (const WallMotion *)job->walls->motion.data + i;
    if (n->own == OWN_ALL) return v;
    if (n->own == OWN_NONE) return (Four){0};
    const Columns own = symmetric_columns(((const WallNode *)job->walls->node.data)[i].own);
    return times(&own, v);
}

/* What an entry takes from: the mean of its parents' u~. */
static inline Four mean_of(const ApplyJob *job, const WallEntry *entry)
{
    const WallCorner *corner = job->walls->corner.data;
    Four mean = {0};
    for (uint32_t k = entry->corner_begin; k < entry->corner_end; k++) mean += corner[k].weight * job->v.free[corner[k].parent];
    return mean;
}

static inline void fold_back(const ApplyJob *job, uint32_t i)
{
    const WallMotion *n = (const WallMotion *)job->walls->motion.data + i;
    const WallEntry *entry = job->walls->entry.data;
    if (n->entry != NO_ENTRY) job->v.back[n->entry] = times(&entry[n->entry].matrix, rest_of(job, n, job->v.momentum[i]));
}

/* E^T (p - m c0) at one node, with its links. */
static inline Four folded(const ApplyJob *job, uint32_t i, uint32_t link_begin, uint32_t link_moving)
{
    const WallMotion *n = (const WallMotion *)job->walls->motion.data + i;
    const WallLink *link = job->walls->link.data;
    Four sum = own_of(job, i, rest_of(job, n, job->v.momentum[i]));
    for (uint32_t l = link_begin; l < link_moving; l++) sum += link[l].weight * job->v.back[link[l].from];
    return sum;
}

#endif
