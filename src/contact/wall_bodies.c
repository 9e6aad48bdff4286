#include "contact/wall_bodies.h"

#include <math.h>
#include <string.h>

#include "base/cholesky.h"

enum { WAYS = FREE_BODY_WAYS, WORDS = (PBMPM_MAX_COLLIDERS + 63) / 64 };

/* ---- Nodes that follow ---- */

static Four grip_motion(const WallGrip *grip, const double motion[6])
{
    const Four way = {(float)motion[0], (float)motion[1], (float)motion[2]}, spin = {(float)motion[3], (float)motion[4], (float)motion[5]};
    return times(&grip->share, way + cross(spin, grip->arm));
}

/* Its transpose: adds what a push on the node is to the body. */
static void grip_push(const WallGrip *grip, Four push, double sum[6])
{
    const Four force = times(&grip->share, push), moment = cross(grip->arm, force);
    for (int a = 0; a < 3; a++) {
        sum[a] += (double)force[a];
        sum[3 + a] += (double)moment[a];
    }
}

/* w: to gravity, the host, what came late, and what it yielded to in the substeps before. Not what walls of the domain hold: matter followed the fall of a stone that lay on the floor. */
static void find_before(const ContactFrame *frame, const Obstacle *o, double motion[6])
{
    const FreeBody *body = o->body;
    double impulse[6];
    for (int a = 0; a < 6; a++) impulse[a] = body->push[a] * frame->substep->dt * (o->part + 1);
    free_body_yields_openly(body, impulse, motion);
    for (int a = 0; a < 6; a++) {
        motion[a] += body->yielded[a] + body->delayed[a] * (o->part + 1) / o->parts;
        motion[a] *= a < 3 ? frame->substep->to_cells : frame->substep->dt;
    }
}

bool wall_bodies_list(Walls *walls, const ContactFrame *frame, Memory *memory)
{
    const Colliders *colliders = frame->colliders;
    uint32_t count = 0;
    for (int i = 0; i < colliders->obstacle_count; i++) count += colliders->obstacle[i].body != NULL;
    if (count == 0) return true;
    if (!array_reserve(memory, &walls->body, count, sizeof(WallBody))) return false;
    /* nodes count a momentum J as J / scale and moments in cells, motions in cells: with a^2 = scale dt / dx and b^2 = scale dt dx all of B B^T has its unit */
    const double momentum = contacts_momentum_scale(frame) * frame->substep->dt;
    const double to_move = sqrt(momentum / frame->cell_size), to_turn = sqrt(momentum * frame->cell_size);
    for (int i = 0; i < colliders->obstacle_count; i++) {
        const Obstacle *o = &colliders->obstacle[i];
        if (!o->body) continue;
        WallBody *body = (WallBody *)walls->body.data + walls->bodies++;
        *body = (WallBody){.free = o->body, .obstacle = i};
        for (int k = 0; k < o->body->ways; k++)
            for (int a = 0; a < 6; a++) body->way[k][a] = (a < 3 ? to_move : to_turn) * o->body->open[k][a];
        find_before(frame, o, body->before);
    }
    return true;
}

/* Bodies are listed in the order of their obstacles. */
static uint32_t body_of(const Walls *walls, int obstacle)
{
    const WallBody *body = walls->body.data;
    uint32_t first = 0, end = walls->bodies;
    while (end - first > 1) {
        const uint32_t middle = first + (end - first) / 2;
        if (body[middle].obstacle <= obstacle)
            first = middle;
        else
            end = middle;
    }
    return first;
}

bool wall_bodies_grip(Walls *walls, const ContactFrame *frame, Memory *memory, const WallFoot *at, float moved[3])
{
    if (!array_grow(memory, &walls->grip, (size_t)walls->grips + 1, sizeof(WallGrip), (size_t)walls->grips * sizeof(WallGrip))) return false;
    WallBody *body = walls->body.data;
    WallGrip grip = {.share = symmetric_columns(at->share), .follower = at->follower};
    grip.body = body_of(walls, (int)(at->obstacle - frame->colliders->obstacle));
    for (int a = 0; a < frame->grid->dimension; a++) grip.arm[a] = (float)((at->foot[a] - at->obstacle->body->centre[a]) / frame->cell_size);
    ((WallGrip *)walls->grip.data)[walls->grips++] = grip;
    body[grip.body].gripped = true;
    const Four motion = grip_motion(&grip, body[grip.body].before);
    for (int a = 0; a < 3; a++) moved[a] = motion[a];
    return true;
}

/* ---- S ---- */

/* S is a difference of sums of floats. Where less is left of it than this share, a body that weighs next to nothing would answer to rounding. */
static const double S_ROUNDING = 1e-6;

/* A free node that a body moves: E^T m C of each of the body's ways. */
typedef struct Trace {
    uint32_t free;
    Four part[WAYS];
} Trace;

typedef struct Binder {
    const ApplyJob *job;
    uint32_t *free_of; /* per node of the list: which of the free ones it is */
    uint32_t *place;   /* per free node: its trace + 1 */
    uint32_t *owner;   /* per free node: the first body that moves it + 1 */
    uint32_t *grip;    /* the grips, body by body */
    uint32_t *end;     /* per body: where its grips end */
    uint64_t *meets;   /* per body a bit for each body */
    Trace *trace;      /* of one body */
    uint32_t traces;
} Binder;

static void note_owner(Binder *b, uint32_t body, uint32_t free)
{
    Walls *walls = (Walls *)b->job->walls;
    if (b->owner[free] == 0) {
        b->owner[free] = body + 1;
        ((uint32_t *)walls->beside_body.data)[walls->beside++] = free;
    }
    const uint32_t other = b->owner[free] - 1;
    if (other == body) return;
    b->meets[body * WORDS + other / 64] |= (uint64_t)1 << other % 64;
    b->meets[other * WORDS + body / 64] |= (uint64_t)1 << body % 64;
}

static Trace *trace_of(Binder *b, uint32_t body, uint32_t node)
{
    const uint32_t free = b->free_of[node];
    if (b->place[free] == 0) {
        b->trace[b->traces++] = (Trace){.free = free};
        b->place[free] = b->traces;
        note_owner(b, body, free);
    }
    return &b->trace[b->place[free] - 1];
}

/* Adds one node's share: C^T m C to S, and E^T m C to the traces. `moved`: C of each way. */
static void add_follower(Binder *b, uint32_t body, uint32_t node, int ways, const Four moved[WAYS], double s[WAYS][WAYS])
{
    const Walls *walls = b->job->walls;
    const WallMotion *n = (const WallMotion *)walls->motion.data + node;
    for (int r = 0; r < ways; r++)
        for (int c = 0; c < ways; c++)
            for (int a = 0; a < 3; a++) s[r][c] += (double)n->mass * (double)moved[r][a] * (double)moved[c][a];
    if (n->own != OWN_NONE) {
        Trace *own = trace_of(b, body, node);
        for (int k = 0; k < ways; k++) own->part[k] += own_of(b->job, node, n->mass * moved[k]);
    }
    if (n->entry == NO_ENTRY) return;
    const WallEntry *entry = (const WallEntry *)walls->entry.data + n->entry;
    for (uint32_t i = entry->corner_begin; i < entry->corner_end; i++) {
        const WallCorner *corner = (const WallCorner *)walls->corner.data + i;
        Trace *parent = trace_of(b, body, corner->parent);
        for (int k = 0; k < ways; k++) parent->part[k] += corner->weight * times(&entry->matrix, n->mass * moved[k]);
    }
}

static void sort_grips(Binder *b)
{
    const Walls *walls = b->job->walls;
    const WallGrip *grip = walls->grip.data;
    for (uint32_t g = 0; g < walls->grips; g++)
        if (grip[g].body + 1 < walls->bodies) b->end[grip[g].body + 1]++;
    for (uint32_t i = 1; i < walls->bodies; i++) b->end[i] += b->end[i - 1];
    for (uint32_t g = 0; g < walls->grips; g++) b->grip[b->end[grip[g].body]++] = g;
}

static void find_s(Binder *b, uint32_t index, double s[WAYS][WAYS])
{
    const Walls *walls = b->job->walls;
    const WallBody *body = (const WallBody *)walls->body.data + index;
    const WallGrip *grip = walls->grip.data;
    const int ways = body->free->ways;
    b->traces = 0;
    for (uint32_t i = index == 0 ? 0 : b->end[index - 1]; i < b->end[index];) { /* a node may follow two faces of a body */
        const uint32_t follower = grip[b->grip[i]].follower;
        Four moved[WAYS] = {{0}};
        for (; i < b->end[index] && grip[b->grip[i]].follower == follower; i++)
            for (int k = 0; k < ways; k++) moved[k] += grip_motion(&grip[b->grip[i]], body->way[k]);
        add_follower(b, index, follower, ways, moved, s);
    }
    for (uint32_t t = 0; t < b->traces; t++) {
        const Trace *trace = &b->trace[t];
        const WallFree *free = (const WallFree *)walls->free.data + trace->free;
        b->place[trace->free] = 0;
        for (int c = 0; c < ways; c++) {
            const Four u = times(&free->inverse, trace->part[c]);
            for (int r = 0; r < ways; r++)
                for (int a = 0; a < 3; a++) s[r][c] -= (double)trace->part[r][a] * (double)u[a];
        }
    }
}

static int neighbours(const Binder *b, uint32_t body)
{
    int count = 0;
    for (int w = 0; w < WORDS; w++)
        for (uint64_t bits = b->meets[body * WORDS + (uint32_t)w]; bits; bits &= bits - 1) count++;
    return count;
}

static void bind_all(Binder *b)
{
    const Walls *walls = b->job->walls;
    WallBody *body = walls->body.data;
    sort_grips(b);
    for (uint32_t i = 0; i < walls->bodies; i++) find_s(b, i, body[i].factor); /* S for now */
    for (uint32_t i = 0; i < walls->bodies; i++) {
        const double times_s = 1.0 + neighbours(b, i);
        double most = 0.0;
        for (int r = 0; r < WAYS; r++)
            for (int c = 0; c < WAYS; c++) body[i].factor[r][c] = times_s * body[i].factor[r][c] + (r == c ? 1.0 : 0.0);
        for (int k = 0; k < WAYS; k++) most = fmax(most, body[i].factor[k][k]);
        cholesky_factor(body[i].factor, body[i].free->ways, fmax(1.0, S_ROUNDING * most));
    }
}

bool wall_bodies_bind(Walls *walls, const ContactFrame *frame, Memory *memory)
{
    if (walls->grips == 0) return true;
    const size_t indices = (size_t)walls->nodes + 2 * (size_t)walls->frees + walls->grips + walls->bodies;
    const size_t bytes = indices * sizeof(uint32_t) + (size_t)walls->bodies * WORDS * sizeof(uint64_t) + (size_t)walls->frees * sizeof(Trace);
    if (!array_reserve(memory, &walls->beside_body, walls->frees, sizeof(uint32_t))) return false;
    if (!array_reserve(memory, &walls->scratch, bytes, 1)) return false;
    Trace *trace = walls->scratch.data;
    uint64_t *meets = (uint64_t *)(trace + walls->frees);
    uint32_t *index = (uint32_t *)(meets + (size_t)walls->bodies * WORDS);
    memset(meets, 0, bytes - (size_t)walls->frees * sizeof(Trace));
    const ApplyJob job = {walls, frame, vectors_of(walls), 0.0f, NULL};
    Binder binder = {.job = &job, .free_of = index, .meets = meets, .trace = trace};
    binder.place = binder.free_of + walls->nodes;
    binder.owner = binder.place + walls->frees;
    binder.grip = binder.owner + walls->frees;
    binder.end = binder.grip + walls->grips;
    for (uint32_t f = 0; f < walls->frees; f++) binder.free_of[((const WallFree *)walls->free.data)[f].place] = f;
    bind_all(&binder);
    memset(yields_at(&job), 0, walls->nodes * sizeof(Four));
    return true;
}

/* ---- Yielding ---- */

void wall_bodies_hold(const ApplyJob *job)
{
    const WallGrip *grip = job->walls->grip.data;
    for (uint32_t g = 0; g < job->walls->grips; g++) yields_at(job)[grip[g].follower] = (Four){0};
}

/* G. */
static void find_given(const ApplyJob *job)
{
    const Walls *walls = job->walls;
    const WallGrip *grip = walls->grip.data;
    const WallMotion *motion = walls->motion.data;
    const WallEntry *entry = walls->entry.data;
    WallBody *body = walls->body.data;
    for (uint32_t b = 0; b < walls->bodies; b++) memset(body[b].given, 0, sizeof body[b].given);
    for (uint32_t g = 0; g < walls->grips; g++) {
        const uint32_t i = grip[g].follower;
        const WallMotion *n = &motion[i];
        Four u = own_of(job, i, job->v.free[i]) + shift_of(job, n);
        if (n->entry != NO_ENTRY) u += times(&entry[n->entry].matrix, mean_of(job, &entry[n->entry]));
        grip_push(&grip[g], job->v.momentum[i] - n->mass * u, body[grip[g].body].given);
    }
}

/* y = B (1 + B^T S B)^-1 B^T G */
static void find_yield(WallBody *body, double yield[6])
{
    double q[WAYS] = {0};
    for (int k = 0; k < body->free->ways; k++)
        for (int a = 0; a < 6; a++) q[k] += body->way[k][a] * body->given[a];
    cholesky_forward(body->factor, q, body->free->ways);
    cholesky_backward(body->factor, q, body->free->ways);
    memset(yield, 0, 6 * sizeof *yield);
    for (int k = 0; k < body->free->ways; k++)
        for (int a = 0; a < 6; a++) yield[a] += q[k] * body->way[k][a];
}

void wall_bodies_yield(const ApplyJob *job)
{
    const WallGrip *grip = job->walls->grip.data;
    WallBody *body = job->walls->body.data;
    find_given(job);
    for (uint32_t b = 0; b < job->walls->bodies; b++) {
        find_yield(&body[b], body[b].yield);
        if (job->shifted != 0.0f) memcpy(body[b].yielded, body[b].yield, sizeof body[b].yield);
    }
    for (uint32_t g = 0; g < job->walls->grips; g++) yields_at(job)[grip[g].follower] += grip_motion(&grip[g], body[grip[g].body].yield);
    for (uint32_t g = 0; g < job->walls->grips; g++) fold_back(job, grip[g].follower);
}

void wall_bodies_keep(const Walls *walls, const ContactFrame *frame)
{
    const WallBody *body = walls->body.data;
    for (uint32_t b = 0; b < walls->bodies; b++) {
        FreeBody *free = body[b].free;
        if (body[b].gripped) free->walled = 1;
        for (int a = 0; a < 6; a++) free->yielded[a] += body[b].yielded[a] * (a < 3 ? frame->substep->to_velocity : 1.0 / frame->substep->dt);
    }
}
