#include "contact/walls_unilateral.h"

#include <string.h>

#include "contact/walls_lump.h"

enum { GRAIN = 64, UNILATERAL_NS = 40 };

/* Whether a node or one that follows it has all of these flags. */
static bool any_beside(const Walls *walls, const WallNode *node, uint32_t flags)
{
    const WallNode *list = walls->node.data;
    const WallEntry *entry = walls->entry.data;
    const WallLink *link = walls->link.data;
    bool any = (node->unilateral & flags) == flags;
    for (uint32_t l = node->link_begin; l < node->link_moving && !any; l++) any = (list[entry[link[l].from].follower].unilateral & flags) == flags;
    return any;
}

bool unilateral_beside(const Walls *walls, const WallNode *node) { return any_beside(walls, node, UNILATERAL); }

static void take(void *context, int32_t begin, int32_t end)
{
    for (int32_t i = begin; i < end; i++) take_momentum(context, (uint32_t)i);
}

static double along(const float normal[3], Four u) { return (double)(normal[0] * u[0] + normal[1] * u[1] + normal[2] * u[2]); }

/* b*: the mean of the parents that have mass. */
static Four mean_before(const ApplyJob *job, const WallEntry *entry)
{
    const WallNode *node = job->walls->node.data;
    const WallCorner *corner = job->walls->corner.data;
    Four mean = {0};
    float weight = 0.0f;
    for (uint32_t k = entry->corner_begin; k < entry->corner_end; k++) {
        const WallNode *parent = &node[corner[k].parent];
        if (!(parent->mass > 0.0f)) continue;
        mean += corner[k].weight / parent->mass * job->v.momentum[corner[k].parent];
        weight += corner[k].weight;
    }
    return weight > 0.0f ? mean / weight : mean;
}

static uint32_t held_by(const ApplyJob *job, const WallUnilateral *u, const WallNode *n)
{
    if (!(n->mass > 0.0f)) return u->held;
    const Four own = job->v.momentum[u->follower] / n->mass, before = mean_before(job, (const WallEntry *)job->walls->entry.data + n->entry);
    uint32_t held = 0;
    for (int j = 0; j < n->normals; j++) {
        const double surface = (double)u->surface[j];
        const bool pushes = along(n->normal[j], own) - surface <= (double)u->scale[j] * (along(n->normal[j], before) - surface);
        if (pushes || u->scale[j] == 1.0f) held |= 1u << j;
    }
    return held;
}

/* What the node is left with along its walls. */
static void free_part(const WallNode *n, int dimension, float part[6])
{
    const float all[6] = {1.0f, 0.0f, 0.0f, 1.0f, 0.0f, dimension == 3 ? 1.0f : 0.0f};
    for (int k = 0; k < 6; k++) part[k] = n->normals == dimension ? 0.0f : all[k]; /* else rounding would be left */
    for (int j = 0; j < n->normals && n->normals < dimension; j++)
        lump_add_product(part, -1.0, (const double[]){(double)n->normal[j][0], (double)n->normal[j][1], (double)n->normal[j][2]});
}

/* The node's A, what it has itself, c0 and grips, where the faces `held` hold it. */
static void switch_to(const Walls *walls, WallUnilateral *u, uint32_t held, int dimension)
{
    WallNode *n = (WallNode *)walls->node.data + u->follower;
    WallGrip *grip = walls->grip.data;
    float matrix[6] = {0}, own[6] = {0};
    Four shift = {0};
    u->held = held;
    free_part(n, dimension, n->slips ? own : matrix);
    for (int j = 0; j < n->normals; j++) {
        const float holds = held >> j & 1 ? 1.0f : 0.0f, share = holds * (1.0f - u->scale[j]);
        const Four normal = {n->normal[j][0], n->normal[j][1], n->normal[j][2]};
        const double along[3] = {(double)normal[0], (double)normal[1], (double)normal[2]};
        float gripped[6] = {0};
        lump_add_product(matrix, (double)(holds * u->scale[j]), along);
        lump_add_product(own, 1.0 - (double)holds, along);
        lump_add_product(gripped, (double)share, along);
        shift += share * u->surface[j] * normal;
        if (u->grip[j] != NO_GRIP) grip[u->grip[j]].share = symmetric_columns(gripped);
    }
    memcpy(n->own, own, sizeof own);
    for (int a = 0; a < 3; a++) n->shift[a] = shift[a];
    ((WallMotion *)walls->motion.data)[u->follower].shift = shift;
    ((WallEntry *)walls->entry.data)[n->entry].matrix = symmetric_columns(matrix);
}

static void decide(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    const Walls *walls = job->walls;
    for (int32_t i = begin; i < end; i++) {
        WallUnilateral *u = (WallUnilateral *)walls->unilateral.data + i;
        WallNode *n = (WallNode *)walls->node.data + u->follower;
        const uint32_t held = held_by(job, u, n);
        n->unilateral = UNILATERAL | (held != u->held ? SWITCHED : 0);
        if (held != u->held) switch_to(walls, u, held, job->frame->grid->dimension);
    }
}

static void lump_again(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    const Walls *walls = job->walls;
    for (int32_t i = begin; i < end; i++) {
        WallFree *free = (WallFree *)walls->free.data + i;
        const WallNode *n = (const WallNode *)walls->node.data + free->place;
        if (!free->unsure || !any_beside(walls, n, SWITCHED)) continue;
        walls_lump(walls, free->place, job->frame->grid->dimension);
        free->inverse = walls_inverse(n->lump);
    }
}

void unilateral_add(const ApplyJob *job, Loops *loops)
{
    const Walls *walls = job->walls;
    if (walls->unilaterals == 0) return;
    LOOPS_ADD(loops, ((Span){(int32_t)walls->nodes, GRAIN, (int64_t)walls->nodes * UNILATERAL_NS / 8}), take, job);
    LOOPS_ADD(loops, ((Span){(int32_t)walls->unilaterals, GRAIN, (int64_t)walls->unilaterals * UNILATERAL_NS}), decide, job);
    LOOPS_ADD(loops, ((Span){(int32_t)walls->frees, GRAIN, (int64_t)walls->unilaterals * UNILATERAL_NS}), lump_again, job);
}

void unilateral_begin(const Walls *walls, const ContactFrame *frame, Pool *pool)
{
    const ApplyJob job = {walls, frame, vectors_of(walls), 1.0f, NULL};
    Loops loops;
    loops_open(&loops, pool);
    unilateral_add(&job, &loops);
    loops_run(&loops);
}
