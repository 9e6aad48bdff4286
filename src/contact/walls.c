#include "contact/walls.h"

#include <math.h>

#include "contact/walls_list.h"

enum { GRAIN = 64, WALL_NODE_NS = 20 };

/* Vectors of 4 floats: per node momentum, u~, u, and the normal impulse; per entry what goes back through it. */
typedef struct Vectors {
    float (*momentum)[4], (*free)[4], (*moved)[4], (*back)[4];
} Vectors;

static Vectors vectors_of(const Walls *walls)
{
    float(*first)[4] = walls->vector.data;
    if (walls->nodes == 0) return (Vectors){NULL, NULL, NULL, NULL};
    return (Vectors){first, first + walls->nodes, first + 2 * (size_t)walls->nodes, first + VECTORS * (size_t)walls->nodes};
}

void walls_free(Walls *walls, Memory *memory)
{
    Array *arrays[] = {&walls->node, &walls->entry, &walls->link, &walls->place, &walls->marked, &walls->begin, &walls->bound, &walls->vector};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(memory, arrays[i]);
    walls_clear(walls);
}

void walls_clear(Walls *walls)
{
    walls->nodes = walls->entries = walls->links = 0;
    walls->rubs = false;
}

static uint32_t place_of(const Walls *walls, uint32_t node)
{
    return walls && walls->nodes > 0 ? ((const uint32_t *)walls->place.data)[node] : 0;
}

bool walls_list(const Walls *walls, uint32_t node) { return place_of(walls, node) > 0; }

int walls_faces(const Walls *walls, uint32_t node, uint16_t obstacle[3], const float *normal[3])
{
    const WallNode *n = (const WallNode *)walls->node.data + place_of(walls, node) - 1;
    for (int k = 0; k < n->normals; k++) {
        obstacle[k] = n->obstacle[k];
        normal[k] = n->normal[k];
    }
    return n->normals;
}

bool walls_hold(const Walls *walls, uint32_t node)
{
    const uint32_t place = place_of(walls, node);
    return place > 0 && ((const WallNode *)walls->node.data)[place - 1].follows;
}

static void times(const float m[6], const float v[4], float out[4])
{
    out[0] = m[0] * v[0] + m[1] * v[1] + m[2] * v[2];
    out[1] = m[1] * v[0] + m[3] * v[1] + m[4] * v[2];
    out[2] = m[2] * v[0] + m[4] * v[1] + m[5] * v[2];
}

/* ---- Making motion admissible ---- */

typedef struct ApplyJob {
    const Walls *walls;
    const ContactFrame *frame;
    Vectors v;
    float shifted; /* 1 with the walls' own motion, 0 without */
    const uint8_t *mark;
} ApplyJob;

static float *node_at(const ApplyJob *job, const WallNode *n) { return (float *)job->frame->grid->node.data + (size_t)n->node * K_NODE_WIDTH; }

/* p - m c0 goes back through the entries; what is new of p is taken over. */
static void send_back(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    const WallNode *node = job->walls->node.data;
    const WallEntry *entry = job->walls->entry.data;
    for (int32_t i = begin; i < end; i++) {
        const float *u = node_at(job, &node[i]);
        float *p = job->v.momentum[i], rest[4];
        if (!job->mark || job->mark[node[i].node / (uint32_t)job->frame->grid->block_cells])
            for (int a = 0; a < 3; a++) p[a] = node[i].mass * u[a];
        for (int a = 0; a < 3; a++) rest[a] = p[a] - job->shifted * node[i].mass * node[i].shift[a];
        for (uint32_t e = node[i].entry_begin; e < node[i].entry_moving; e++) times(entry[e].matrix, rest, job->v.back[e]);
    }
}

/* E^T (p - m c0) at one node. */
static void folded(const ApplyJob *job, uint32_t i, float sum[4])
{
    const WallNode *n = (const WallNode *)job->walls->node.data + i;
    const WallLink *link = job->walls->link.data;
    float rest[4];
    for (int a = 0; a < 3; a++) rest[a] = job->v.momentum[i][a] - job->shifted * n->mass * n->shift[a];
    times(n->own, rest, sum);
    for (uint32_t l = n->link_begin; l < n->link_moving; l++)
        for (int a = 0; a < 3; a++) sum[a] += link[l].weight * job->v.back[link[l].entry][a];
}

static void find_free(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    const WallNode *node = job->walls->node.data;
    for (int32_t i = begin; i < end; i++) {
        float sum[4], *u = node_at(job, &node[i]);
        folded(job, (uint32_t)i, sum);
        times(node[i].inverse, sum, job->v.free[i]);
        for (int a = 0; a < 3; a++) u[a] = job->v.free[i][a];
    }
}

/* u = E u~ + c0 at one node. */
static void spread(const ApplyJob *job, uint32_t i, float u[4])
{
    const WallNode *n = (const WallNode *)job->walls->node.data + i;
    times(n->own, job->v.free[i], u);
    for (int a = 0; a < 3; a++) u[a] += job->shifted * n->shift[a];
    for (uint32_t e = n->entry_begin; e < n->entry_moving; e++) {
        const WallEntry *entry = (const WallEntry *)job->walls->entry.data + e;
        float mean[4] = {0}, part[4];
        for (int k = 0; k < CORNERS_MAX; k++) {
            const float *from = job->v.free[entry->parent[k]];
            for (int a = 0; a < 3; a++) mean[a] += entry->weight[k] * from[a];
        }
        times(entry->matrix, mean, part);
        for (int a = 0; a < 3; a++) u[a] += part[a];
    }
}

static void take_free(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    const WallNode *node = job->walls->node.data;
    for (int32_t i = begin; i < end; i++)
        for (int a = 0; a < 3; a++) job->v.free[i][a] = node_at(job, &node[i])[a];
}

static void find_moved(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    const WallNode *node = job->walls->node.data;
    for (int32_t i = begin; i < end; i++) {
        float *u = node_at(job, &node[i]);
        spread(job, (uint32_t)i, job->v.moved[i]);
        for (int a = 0; a < 3; a++) u[a] = job->v.moved[i][a];
    }
}

/* What the wall gives to a node: m u - p, with what E^T brings to others and less what M counts of it there. The sum over all nodes is the change of momentum,
 * but for M u~ - E^T (p - m c0), which contacts and friction leave at the nodes that are free. */
static void given(const ApplyJob *job, uint32_t i, double sum[3])
{
    const WallNode *n = (const WallNode *)job->walls->node.data + i;
    const float *p = job->v.momentum[i], *u = job->v.moved[i];
    float rest[4], own[4], still[4];
    for (int a = 0; a < 3; a++) rest[a] = p[a] - job->shifted * n->mass * n->shift[a];
    times(n->own, rest, own);
    times(n->own, job->v.free[i], still);
    for (int a = 0; a < 3; a++) sum[a] = (double)n->mass * ((double)u[a] - (double)still[a]) - (double)p[a] + (double)own[a];
    for (uint32_t e = n->entry_begin; e < n->entry_moving; e++) {
        const WallEntry *entry = (const WallEntry *)job->walls->entry.data + e;
        float mean[4] = {0}, part[4];
        double weight = 0.0;
        for (int k = 0; k < CORNERS_MAX; k++) {
            weight += (double)entry->weight[k];
            for (int a = 0; a < 3; a++) mean[a] += entry->weight[k] * job->v.free[entry->parent[k]][a];
        }
        times(entry->matrix, mean, part);
        times(entry->matrix, part, mean);
        for (int a = 0; a < 3; a++) sum[a] += weight * (double)job->v.back[e][a] - (double)n->mass * (double)mean[a];
    }
}

static void press(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    const WallNode *node = job->walls->node.data;
    for (int32_t i = begin; i < end; i++) {
        double sum[3], along = 0.0;
        given(job, (uint32_t)i, sum);
        for (int a = 0; a < 3; a++) along += sum[a] * (double)node[i].normal[0][a];
        job->v.moved[i][3] = node[i].follows ? (float)along : 0.0f;
    }
}

/* Coulomb: the motion along the wall loses at most the coefficient times the normal impulse, of the nodes that follow in proportion to what they follow. */
static void rub(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    const WallNode *node = job->walls->node.data;
    const WallEntry *entry = job->walls->entry.data;
    const WallLink *link = job->walls->link.data;
    for (int32_t i = begin; i < end; i++) {
        const WallNode *n = &node[i];
        float *u = job->v.free[i], v[3], impulse = 0.0f, along = 0.0f, size2 = 0.0f;
        if (n->coefficient == 0.0f) continue;
        for (uint32_t l = n->link_begin; l < n->link_moving; l++) impulse += link[l].weight * job->v.moved[entry[link[l].entry].follower][3];
        const float trace = n->lump[0] + n->lump[3] + n->lump[5];
        if (!(impulse > 0.0f) || !(trace > 0.0f)) continue;
        for (int a = 0; a < 3; a++) along += (u[a] - n->surface[a]) * n->normal[0][a];
        for (int a = 0; a < 3; a++) {
            v[a] = u[a] - n->surface[a] - along * n->normal[0][a];
            size2 += v[a] * v[a];
        }
        if (!(size2 > 0.0f)) continue;
        float mv[4] = {v[0], v[1], v[2]}, m[4];
        times(n->lump, mv, m);
        const float mass = (m[0] * v[0] + m[1] * v[1] + m[2] * v[2]) / size2; /* in the direction of motion */
        const float lost = mass > 0.0f ? n->coefficient * impulse / (mass * sqrtf(size2)) : 1.0f;
        for (int a = 0; a < 3; a++) u[a] -= fminf(lost, 1.0f) * v[a];
    }
}

static void obey(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    for (int32_t block = begin; block < end; block++) {
        if (job->shifted == 0.0f)
            contacts_hold(job->frame, block, block + 1);
        else if (!job->mark || job->mark[block])
            contacts_apply(job->frame, block, block + 1);
        else
            contacts_apply_walled(job->frame, block, block + 1);
    }
}

void walls_add(const Walls *walls, const ContactFrame *frame, Loops *loops, bool linear, const uint8_t *mark)
{
    const ApplyJob job = {walls, frame, vectors_of(walls), linear ? 0.0f : 1.0f, mark};
    const Span all = {(int32_t)walls->nodes, GRAIN, (int64_t)walls->nodes * WALL_NODE_NS};
    LOOPS_ADD(loops, all, send_back, &job);
    LOOPS_ADD(loops, all, find_free, &job);
    if (frame->colliders->contacts > 0) LOOPS_ADD(loops, grid_nodes(frame->grid, 4), obey, &job);
    LOOPS_ADD(loops, all, take_free, &job);
    LOOPS_ADD(loops, all, find_moved, &job);
    if (walls->rubs && !linear) {
        LOOPS_ADD(loops, all, press, &job);
        LOOPS_ADD(loops, all, rub, &job);
        LOOPS_ADD(loops, all, find_moved, &job);
    }
}

void walls_apply(const Walls *walls, const ContactFrame *frame, Pool *pool, bool linear, const uint8_t *mark)
{
    Loops loops;
    loops_open(&loops, pool);
    walls_add(walls, frame, &loops, linear, mark);
    loops_run(&loops);
}

float walls_work(const Walls *walls, uint32_t node, const float *u)
{
    const float *p = vectors_of(walls).momentum[place_of(walls, node) - 1];
    return p[0] * u[0] + p[1] * u[1] + p[2] * u[2];
}

float walls_value(const Walls *walls, uint32_t node, const float *u, const float *base, const float *push)
{
    const WallNode *n = (const WallNode *)walls->node.data + place_of(walls, node) - 1;
    float value = 0.0f;
    for (int a = 0; a < 3; a++) {
        const float free = n->mass * (base[a] - n->shift[a]) + push[a];
        value += 0.5f * n->mass * base[a] * base[a] - 0.5f * (u[a] - n->shift[a]) * free - n->shift[a] * push[a];
    }
    return value;
}

/* ---- Impulses ---- */

static void book(const ApplyJob *job, const WallNode *n, int j, const double gained[3])
{
    const Colliders *colliders = job->frame->colliders;
    const Obstacle *o = &colliders->obstacle[n->obstacle[j]];
    double point[3];
    const uint32_t cells = (uint32_t)job->frame->grid->block_cells;
    if (!o->measures) return;
    contacts_node_position(job->frame, (int32_t)(n->node / cells), (int)(n->node % cells), point);
    impulse_add(&colliders->impulses.sum[o->place], point, gained);
}

void walls_book(const Walls *walls, const ContactFrame *frame, double dt)
{
    if (!frame->colliders->measures || walls->nodes == 0) return;
    const ApplyJob job = {walls, frame, vectors_of(walls), 1.0f, NULL};
    const double scale = contacts_momentum_scale(frame, dt);
    for (uint32_t i = 0; i < walls->nodes; i++) {
        const WallNode *n = (const WallNode *)walls->node.data + i;
        double sum[3], gained[3];
        float back[4], held[4];
        given(&job, i, sum);
        folded(&job, i, back);
        times(n->lump, job.v.free[i], held);
        for (int a = 0; a < 3; a++) sum[a] += (double)held[a] - (double)back[a];
        for (int j = 1; j < n->normals; j++) { /* along its own normal each wall, the rest the nearest one */
            double along = 0.0;
            for (int a = 0; a < 3; a++) along += sum[a] * (double)n->normal[j][a];
            for (int a = 0; a < 3; a++) {
                gained[a] = scale * along * (double)n->normal[j][a];
                sum[a] -= along * (double)n->normal[j][a];
            }
            book(&job, n, j, gained);
        }
        for (int a = 0; a < 3; a++) gained[a] = scale * sum[a];
        if (n->normals > 0) book(&job, n, 0, gained);
    }
}

/* ---- Density ---- */

float walls_open_share(const Walls *walls, uint32_t node)
{
    const uint32_t place = place_of(walls, node);
    return place > 0 ? ((const WallNode *)walls->node.data)[place - 1].open : -1.0f;
}

static void fold_scalar(const Walls *walls, const float *from, float *to)
{
    const WallNode *node = walls->node.data;
    const WallEntry *entry = walls->entry.data;
    const WallLink *link = walls->link.data;
    for (uint32_t i = 0; i < walls->nodes; i++) {
        float sum = node[i].own_mirror * from[node[i].node];
        for (uint32_t l = node[i].link_moving; l < node[i].link_end; l++) sum += link[l].weight * from[node[entry[link[l].entry].follower].node];
        to[i] = sum;
    }
}

void walls_fold_volume(const Walls *walls, float *volume, float *open)
{
    static const float CLOSED = 1e-3f; /* less of a cell is rounding */
    const WallNode *node = walls->node.data;
    const WallEntry *entry = walls->entry.data;
    if (walls->nodes == 0) return;
    float *held = walls->vector.data, *room = held + walls->nodes;
    fold_scalar(walls, volume, held);
    fold_scalar(walls, open, room);
    for (uint32_t i = 0; i < walls->nodes; i++) held[i] = room[i] > CLOSED ? held[i] / room[i] : 0.0f;
    for (uint32_t i = 0; i < walls->nodes; i++) {
        float sum = node[i].own_mirror * held[i];
        for (uint32_t e = node[i].entry_begin; e < node[i].entry_end; e++)
            for (int k = 0; k < CORNERS_MAX && entry[e].mirrored; k++) sum += entry[e].weight[k] * held[entry[e].parent[k]];
        if (volume[node[i].node] > 0.0f) volume[node[i].node] = sum; /* else nobody listens */
        open[node[i].node] = 1.0f;
    }
}
