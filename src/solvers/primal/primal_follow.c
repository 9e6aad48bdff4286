#include "solvers/primal/primal_follow.h"

#include <string.h>

#include "base/result.h"
#include "contact/walls.h"
#include "solvers/primal/primal.h"

typedef struct Follower {
    uint32_t contact, node; /* of the grid */
    int parents;
    uint32_t parent[CORNERS_MAX];
    float weight[CORNERS_MAX];
    Columns matrix; /* A */
    float square;   /* its mean square */
    float shift[3]; /* c0 */
    bool unilateral;
    float scale; /* then: of the motion along the contact's normal */
} Follower;

/* Which face of the node a contact stands for. */
static int face_of(const Walls *walls, uint32_t node, const Contact *contact)
{
    uint16_t obstacle[3];
    const float *normal[3];
    int face = walls_faces(walls, node, obstacle, normal) - 1;
    while (face > 0 && !(obstacle[face] == contact->obstacle && memcmp(normal[face], contact->normal, sizeof contact->normal) == 0)) face--;
    return face;
}

pbmpm_result primal_follow_list(World *world)
{
    PrimalState *state = &world->primal;
    const Contact *contact = world->colliders.contact.data;
    const uint32_t *begin = world->colliders.contact_begin.data;
    uint32_t count = 0;
    state->followers = 0;
    for (uint32_t i = 0; i < world->colliders.contacts; i++) count += contact[i].follows;
    if (!array_reserve(&world->memory, &state->follower, count, sizeof(Follower))) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for %u nodes at walls", count);
    for (int32_t block = 0; block < world->grid.node_blocks && count > 0; block++)
        for (uint32_t i = begin[block]; i < begin[block + 1]; i++) {
            if (!contact[i].follows) continue;
            Follower *f = (Follower *)state->follower.data + state->followers++;
            f->contact = i;
            f->node = (uint32_t)(block * world->grid.block_cells + contact[i].node);
            f->parents = walls_parents(&world->walls, f->node, f->parent, f->weight, &f->matrix);
            float scale[3];
            f->unilateral = walls_scales(&world->walls, f->node, scale) > 0;
            f->scale = f->unilateral ? scale[face_of(&world->walls, f->node, &contact[i])] : 0.0f;
            f->square = 0.0f;
            for (int a = 0; a < 3; a++)
                for (int c = 0; c < 3; c++) f->square += f->matrix.column[a][c] * f->matrix.column[a][c] / (float)world->def.dimension;
        }
    return PBMPM_OK;
}

static Four mean_of_parents(const Follower *f, const float *nodes)
{
    Four mean = {0};
    for (int k = 0; k < f->parents; k++) {
        const float *u = nodes + (size_t)f->parent[k] * W;
        mean += f->weight[k] * (Four){u[0], u[1], u[2], 0.0f};
    }
    return mean;
}

/* Where its parents lead it. */
static void lead(const Follower *f, Contact *contact, const float *nodes)
{
    const Four mean = mean_of_parents(f, nodes);
    if (f->unilateral) {
        float before = 0.0f;
        for (int a = 0; a < 3; a++) before += contact->normal[a] * (mean[a] - contact->wall[a]);
        for (int a = 0; a < 3; a++) contact->surface[a] = contact->wall[a] + f->scale * before * contact->normal[a];
        return;
    }
    const Four from = times(&f->matrix, mean);
    for (int a = 0; a < 3; a++) contact->surface[a] = from[a] + f->shift[a];
}

void primal_follow_note(World *world)
{
    const float *nodes = world->grid.node.data;
    Follower *list = world->primal.follower.data;
    Contact *contacts = world->joint.contact.data;
    for (uint32_t i = 0; i < world->primal.followers; i++) {
        const Four from = times(&list[i].matrix, mean_of_parents(&list[i], nodes));
        Contact *contact = &contacts[list[i].contact];
        for (size_t a = 0; a < 3; a++) list[i].shift[a] = nodes[(size_t)list[i].node * W + a] - from[a];
        lead(&list[i], contact, nodes);
        contact->active = constraints_touch(contact, nodes + (size_t)list[i].node * W);
    }
}

static void follow(void *context, int32_t begin, int32_t end)
{
    const Primal *p = *(Primal **)context;
    const Follower *list = p->world->primal.follower.data;
    Contact *contacts = p->contacts->colliders->contact.data;
    for (int32_t i = begin; i < end; i++) {
        Contact *contact = &contacts[list[i].contact];
        lead(&list[i], contact, p->node);
        constraints_lead(contact, p->node + (size_t)list[i].node * W);
    }
}

/* What goes back to the parents of the gradient at a follower, and what its square counts for. */
static Four sent_back(const Follower *f, const Contact *contact, const float *u, const float *g, float *square)
{
    *square = f->square;
    if (!f->unilateral) return times(&f->matrix, (Four){g[0], g[1], g[2], 0.0f});
    *square = f->scale * f->scale;
    if (!constraints_push(contact, u, g)) return (Four){0};
    const float part = f->scale * (g[0] * contact->normal[0] + g[1] * contact->normal[1] + g[2] * contact->normal[2]);
    return part * (Four){contact->normal[0], contact->normal[1], contact->normal[2], 0.0f};
}

/* The motion that a follower does not have itself. */
static void led_motion(const Follower *f, const Contact *contact, const float *u, const float *best, float motion[3])
{
    for (int a = 0; a < 3; a++) motion[a] = u[a] - best[a];
    if (!f->unilateral) return;
    const float part = contact->active ? motion[0] * contact->normal[0] + motion[1] * contact->normal[1] + motion[2] * contact->normal[2] : 0.0f;
    for (int a = 0; a < 3; a++) motion[a] = part * contact->normal[a];
}

/* What the primal's search adds up of motion that followers do not have themselves is counted at their parents. */
static void fold(void *context, int32_t begin, int32_t end)
{
    const Primal *p = *(Primal **)context;
    const Follower *list = p->world->primal.follower.data;
    const Contact *contacts = p->contacts->colliders->contact.data;
    double *sums = p->world->primal.sums.data;
    (void)begin;
    (void)end;
    for (uint32_t i = 0; i < p->world->primal.followers; i++) {
        const Follower *f = &list[i];
        const Contact *contact = &contacts[f->contact];
        const size_t at = (size_t)f->node * W;
        float *g = p->force + at, motion[3], square;
        const Four back = sent_back(f, contact, p->node + at, g, &square);
        double *sum = sums + (size_t)(f->node / (uint32_t)p->world->grid.block_cells) * SUMS;
        led_motion(f, contact, p->node + at, p->best + at, motion);
        for (size_t a = 0; a < 3; a++) {
            sum[1] -= (double)(p->gradient[at + a] * motion[a]);
            g[a] -= back[a];
        }
        for (int k = 0; k < f->parents; k++) {
            float *to = p->force + (size_t)f->parent[k] * W;
            for (size_t a = 0; a < 3; a++) to[a] += f->weight[k] * back[a];
            to[3] += f->weight[k] * square * (g[3] + p->base[at + 3]);
        }
    }
}

enum { FOLLOWER_NS = 40, FOLLOWER_GRAIN = 64 };

void primal_add_follow(Primal *p, Loops *loops)
{
    const Span all = {(int32_t)p->world->primal.followers, FOLLOWER_GRAIN, (int64_t)p->world->primal.followers * FOLLOWER_NS};
    if (p->joint && all.count > 0) LOOPS_ADD(loops, all, follow, &p);
}

void primal_add_fold(Primal *p, Loops *loops)
{
    if (p->joint && p->world->primal.followers > 0) LOOPS_ADD(loops, span_once(), fold, &p);
}
