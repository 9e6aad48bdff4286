#include "solvers/primal/primal_followers.h"

#include <string.h>

#include "base/result.h"
#include "contact/walls.h"
#include "solvers/primal/primal.h"

/* A contact that follows. Those of one node stand together. */
typedef struct Follower {
    uint32_t contact, node; /* of the grid */
    int parents;
    uint32_t parent[CORNERS_MAX];
    float weight[CORNERS_MAX];
    float borne[CORNERS_MAX], all; /* weights of those that bear a part: not of parents that stay; and their sum */
    bool sticks;
    float scale;    /* k */
    Columns matrix; /* where it sticks: A, */
    float shift[3]; /* c0, */
    float square;   /* and the mean square of A; else that of k */
} Follower;

/* ---- The list ---- */

/* Which face of the node a contact stands for. */
static int face_of(const Walls *walls, uint32_t node, const Contact *contact)
{
    uint16_t obstacle[3];
    const float *normal[3];
    int face = walls_faces(walls, node, obstacle, normal) - 1;
    while (face > 0 && !(obstacle[face] == contact->obstacle && memcmp(normal[face], contact->normal, sizeof contact->normal) == 0)) face--;
    return face;
}

/* Whether a parent is moved in the primal's parts: a solid reaches it, or it follows others itself. */
static bool is_moved(const World *world, uint32_t node)
{
    const uint32_t cells = (uint32_t)world->grid.block_cells;
    const uint64_t *solid = world->colliders.solid.data;
    return (solid[node / cells] >> (node % cells) & 1) || walls_hold(&world->walls, node);
}

static Follower follower_of(const World *world, uint32_t contact, uint32_t node)
{
    const Contact *of = (const Contact *)world->colliders.contact.data + contact;
    Follower f = {.contact = contact, .node = node};
    float scale[3];
    f.parents = walls_parents(&world->walls, node, f.parent, f.weight, &f.matrix);
    for (int k = 0; k < f.parents; k++) {
        f.borne[k] = is_moved(world, f.parent[k]) ? f.weight[k] : 0.0f;
        f.all += f.borne[k];
    }
    f.sticks = walls_scales(&world->walls, node, scale) == 0;
    f.scale = f.sticks ? 0.0f : scale[face_of(&world->walls, node, of)];
    f.square = f.scale * f.scale;
    for (int a = 0; a < 3 && f.sticks; a++)
        for (int c = 0; c < 3; c++) f.square += f.matrix.column[a][c] * f.matrix.column[a][c] / (float)world->def.dimension;
    return f;
}

/* At curved walls a parent may follow others itself. */
static bool is_led_twice(const World *world, const Follower *f)
{
    bool twice = false;
    for (int k = 0; k < f->parents; k++) twice = twice || walls_hold(&world->walls, f->parent[k]);
    return twice;
}

pbmpm_result primal_list_followers(World *world)
{
    PrimalState *state = &world->primal;
    const Contact *contact = world->colliders.contact.data;
    const uint32_t *begin = world->colliders.contact_begin.data;
    uint32_t count = 0, led[2] = {0};
    for (uint32_t i = 0; i < world->colliders.contacts; i++) count += contact[i].follows;
    state->followers = state->led_once = 0;
    if (!array_reserve(&world->memory, &state->follower, count, sizeof(Follower)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for %u nodes at walls", count);
    for (int twice = 0; twice < 2 && count > 0; twice++) {
        for (int32_t block = 0; block < world->grid.node_blocks; block++)
            for (uint32_t i = begin[block]; i < begin[block + 1]; i++) {
                if (!contact[i].follows) continue;
                const Follower f = follower_of(world, i, (uint32_t)(block * world->grid.block_cells + contact[i].node));
                if (is_led_twice(world, &f) == (twice == 1)) ((Follower *)state->follower.data)[state->followers++] = f;
            }
        led[twice] = state->followers;
    }
    state->led_once = led[0];
    return PBMPM_OK;
}

/* ---- Motion ---- */

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
    const Four mean = mean_of_parents(f, nodes), stuck = times(&f->matrix, mean);
    float along = 0.0f;
    for (int a = 0; a < 3; a++) along += contact->normal[a] * (mean[a] - contact->wall[a]);
    for (int a = 0; a < 3; a++) contact->surface[a] = f->sticks ? stuck[a] + f->shift[a] : contact->wall[a] + f->scale * along * contact->normal[a];
}

void primal_note_followers(World *world)
{
    const float *nodes = world->grid.node.data;
    Contact *contacts = world->joint.contact.data;
    Follower *list = world->primal.follower.data;
    for (uint32_t i = 0; i < world->primal.followers; i++) {
        Contact *contact = &contacts[list[i].contact];
        const float *u = nodes + (size_t)list[i].node * W;
        const Four stuck = times(&list[i].matrix, mean_of_parents(&list[i], nodes));
        for (int a = 0; a < 3; a++) list[i].shift[a] = u[a] - stuck[a];
        lead(&list[i], contact, nodes);
        contact->active = constraints_touch(contact, u);
    }
}

/* Followers from `first` on. */
typedef struct FollowJob {
    Primal *p;
    uint32_t first, end;
} FollowJob;

static Contact *contact_of(const Primal *p, const Follower *f) { return (Contact *)p->contacts->colliders->contact.data + f->contact; }

static void lead_range(void *context, int32_t begin, int32_t end)
{
    const FollowJob *job = context;
    const Follower *list = (const Follower *)job->p->world->primal.follower.data + job->first;
    for (int32_t i = begin; i < end; i++) lead(&list[i], contact_of(job->p, &list[i]), job->p->node);
}

/* Whoever comes to the first contact of a node moves it. */
static void move_range(void *context, int32_t begin, int32_t end)
{
    const FollowJob *job = context;
    const Follower *list = (const Follower *)job->p->world->primal.follower.data + job->first;
    const int32_t all = (int32_t)(job->end - job->first);
    for (int32_t i = begin; i < end; i++)
        for (int32_t k = i; (i == 0 || list[i - 1].node != list[i].node) && k < all && list[k].node == list[i].node; k++)
            constraints_lead(contact_of(job->p, &list[k]), job->p->node + (size_t)list[k].node * W);
}

enum { FOLLOWER_NS = 20, FOLLOWER_GRAIN = 64 };

void primal_add_followers(Primal *p, Loops *loops)
{
    const PrimalState *state = &p->world->primal;
    const FollowJob jobs[2] = {{p, 0, state->led_once}, {p, state->led_once, state->followers}};
    for (int k = 0; k < 2 && p->joint; k++) {
        const int32_t count = (int32_t)(jobs[k].end - jobs[k].first);
        const Span span = {count, FOLLOWER_GRAIN, (int64_t)count * FOLLOWER_NS};
        if (count == 0) continue;
        LOOPS_ADD(loops, span, lead_range, &jobs[k]);
        LOOPS_ADD(loops, span, move_range, &jobs[k]);
    }
}

/* ---- The gradient ---- */

/* What its parents bear of the gradient at a follower. */
static Four borne(const Follower *f, const Contact *contact, const float *u, const float *g)
{
    if (f->sticks) return times(&f->matrix, (Four){g[0], g[1], g[2], 0.0f});
    if (!constraints_push(contact, u, g)) return (Four){0};
    const float part = f->scale * (g[0] * contact->normal[0] + g[1] * contact->normal[1] + g[2] * contact->normal[2]);
    return part * (Four){contact->normal[0], contact->normal[1], contact->normal[2], 0.0f};
}

/* Of a follower's way from `best`, what it does not go by itself. */
static void led_way(const Follower *f, const Contact *contact, const float *u, const float *best, float way[3])
{
    float along = 0.0f;
    for (int a = 0; a < 3; a++) along += (u[a] - best[a]) * contact->normal[a];
    for (int a = 0; a < 3; a++) way[a] = f->sticks ? u[a] - best[a] : contact->active ? along * contact->normal[a] : 0.0f;
}

/* What a search adds up of ways that followers do not go by themselves counts at their parents. From the last on: those that are led twice come first. */
static void fold(void *context, int32_t begin, int32_t end)
{
    const Primal *p = *(Primal **)context;
    double *sums = p->world->primal.sums.data;
    (void)begin;
    (void)end;
    for (uint32_t i = p->world->primal.followers; i-- > 0;) {
        const Follower *f = (const Follower *)p->world->primal.follower.data + i;
        const Contact *contact = contact_of(p, f);
        const size_t at = (size_t)f->node * W;
        float *g = p->force + at, way[3];
        const Four back = borne(f, contact, p->node + at, g);
        double *sum = sums + (size_t)(f->node / (uint32_t)p->world->grid.block_cells) * SUMS;
        led_way(f, contact, p->node + at, p->best + at, way);
        for (size_t a = 0; a < 3; a++) {
            sum[1] -= (double)(p->gradient[at + a] * way[a]);
            g[a] -= f->all * back[a];
        }
        for (int k = 0; k < f->parents; k++) {
            float *to = p->force + (size_t)f->parent[k] * W;
            if (f->borne[k] == 0.0f) continue;
            for (size_t a = 0; a < 3; a++) to[a] += f->borne[k] * back[a];
            if (f->square > 0.0f) to[3] += f->borne[k] * f->square * (g[3] + p->base[at + 3]); /* 0 of what has no bound is no number */
        }
    }
}

void primal_add_fold(Primal *p, Loops *loops)
{
    if (p->joint && p->world->primal.followers > 0) LOOPS_ADD(loops, span_once(), fold, &p);
}
