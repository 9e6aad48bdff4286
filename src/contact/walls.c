#include "contact/walls.h"

#include <math.h>
#include <string.h>

#include "contact/wall_bodies.h"
#include "contact/walls_job.h"
#include "contact/walls_list.h"
#include "contact/walls_unilateral.h"

enum { GRAIN = 64, WALL_NODE_NS = 20 };

void walls_free(Walls *walls, Memory *memory)
{
    Array *arrays[] = {&walls->node, &walls->motion, &walls->free,   &walls->moved, &walls->entry, &walls->shear, &walls->mirror, &walls->corner,
                       &walls->link, &walls->place,  &walls->marked, &walls->begin, &walls->bound, &walls->vector,
                       &walls->unilateral, &walls->grip, &walls->body,   &walls->beside_body, &walls->scratch};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(memory, arrays[i]);
    walls_clear(walls);
}

void walls_clear(Walls *walls)
{
    walls->nodes = walls->frees = walls->moves = walls->entries = walls->shears = walls->mirrors = walls->corners = walls->unilaterals = walls->grips = walls->bodies = walls->beside = 0;
    walls->rubs = false;
}

int walls_faces(const Walls *walls, uint32_t node, uint16_t obstacle[3], const float *normal[3])
{
    const WallNode *n = (const WallNode *)walls->node.data + walls_place(walls, node) - 1;
    for (int k = 0; k < n->normals; k++) {
        obstacle[k] = n->obstacle[k];
        normal[k] = n->normal[k];
    }
    return n->normals;
}

int walls_parents(const Walls *walls, uint32_t node, uint32_t parent[CORNERS_MAX], float weight[CORNERS_MAX], Columns *matrix)
{
    const WallNode *list = walls->node.data;
    const WallNode *n = list + walls_place(walls, node) - 1;
    int count = 0;
    if (n->entry == NO_ENTRY) return 0;
    const WallEntry *entry = (const WallEntry *)walls->entry.data + n->entry;
    const WallCorner *corner = walls->corner.data;
    *matrix = entry->matrix;
    for (uint32_t k = entry->corner_begin; k < entry->corner_end; k++, count++) {
        parent[count] = list[corner[k].parent].node;
        weight[count] = corner[k].weight;
    }
    return count;
}

int walls_scales(const Walls *walls, uint32_t node, float scale[3])
{
    const WallUnilateral *list = walls->unilateral.data;
    const uint32_t place = walls_place(walls, node) - 1;
    const WallNode *n = (const WallNode *)walls->node.data + place;
    uint32_t low = 0, high = walls->unilaterals;
    if (!n->unilateral) return 0;
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (list[middle].follower > place) high = middle;
        else low = middle;
    }
    memcpy(scale, list[low].scale, sizeof list[low].scale);
    return n->normals;
}

void walls_motion(const Walls *walls, uint32_t node, float motion[3])
{
    memcpy(motion, ((const WallNode *)walls->node.data + walls_place(walls, node) - 1)->surface, 3 * sizeof *motion);
}

bool walls_hold(const Walls *walls, uint32_t node)
{
    const uint32_t place = walls_place(walls, node);
    return place > 0 && ((const WallNode *)walls->node.data)[place - 1].follows;
}

bool walls_follows(const Walls *walls, uint32_t node)
{
    const uint32_t place = walls_place(walls, node);
    return place > 0 && ((const WallNode *)walls->node.data)[place - 1].entry != NO_ENTRY;
}

/* ---- Making motion admissible ---- */

/* p - m c0 goes back through the entries; what is new of p is taken over. */
static void send_back(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    for (int32_t i = begin; i < end; i++) {
        take_momentum(job, (uint32_t)i);
        fold_back(job, (uint32_t)i);
    }
}

static void find_free_node(const ApplyJob *job, const WallFree *free)
{
    const uint32_t i = free->place;
    job->v.free[i] = job->v.moved[i] = times(&free->inverse, folded(job, i, free->link_begin, free->link_moving));
    store_node(job->v.free[i], job_nodes(job), ((const WallMotion *)job->walls->motion.data)[i].node);
}

static void find_free(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    for (int32_t f = begin; f < end; f++) find_free_node(job, (const WallFree *)job->walls->free.data + f);
}

/* Those beside bodies, once the bodies have yielded. */
static void find_free_again(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    const uint32_t *beside = job->walls->beside_body.data;
    for (int32_t k = begin; k < end; k++) find_free_node(job, (const WallFree *)job->walls->free.data + beside[k]);
}

static void hold_bodies(void *context, int32_t begin, int32_t end)
{
    (void)begin;
    (void)end;
    wall_bodies_hold(context);
}

static void let_yield(void *context, int32_t begin, int32_t end)
{
    (void)begin;
    (void)end;
    wall_bodies_yield(context);
}

/* Where contacts were obeyed in between. */
static void take_free(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    const WallMotion *motion = job->walls->motion.data;
    const WallFree *free = job->walls->free.data;
    for (int32_t f = begin; f < end; f++) {
        const uint32_t i = free[f].place;
        job->v.free[i] = job->v.moved[i] = load_node(job_nodes(job), motion[i].node);
    }
}

/* u = E u~ + c0, where that is not u~ itself. */
static void find_moved(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    const WallMotion *motion = job->walls->motion.data;
    const WallEntry *entry = job->walls->entry.data;
    const uint32_t *moved = job->walls->moved.data;
    for (int32_t m = begin; m < end; m++) {
        const uint32_t i = moved[m];
        const WallMotion *n = &motion[i];
        Four u = own_of(job, i, job->v.free[i]) + shift_of(job, n);
        if (n->entry != NO_ENTRY) u += times(&entry[n->entry].matrix, mean_of(job, &entry[n->entry]));
        job->v.moved[i] = u;
        store_node(u, job_nodes(job), n->node);
    }
}

/* What the wall gives to a node: m u - p, with what E^T brings to others and less what M counts of it there. The sum over all nodes is the change of momentum,
 * but for M u~ - E^T (p - m c0), which contacts and friction leave at the nodes that are free. */
static void given(const ApplyJob *job, uint32_t i, double sum[3])
{
    const WallMotion *n = (const WallMotion *)job->walls->motion.data + i;
    const Four p = job->v.momentum[i], u = job->v.moved[i];
    const Four own = own_of(job, i, rest_of(job, n, p)), still = own_of(job, i, job->v.free[i]);
    for (int a = 0; a < 3; a++) sum[a] = (double)n->mass * ((double)u[a] - (double)still[a]) - (double)p[a] + (double)own[a];
    if (n->entry == NO_ENTRY) return;
    const WallEntry *entry = (const WallEntry *)job->walls->entry.data + n->entry;
    const WallCorner *corner = job->walls->corner.data;
    const Four counted = times(&entry->matrix, times(&entry->matrix, mean_of(job, entry)));
    double weight = 0.0;
    for (uint32_t k = entry->corner_begin; k < entry->corner_end; k++) weight += (double)corner[k].weight;
    for (int a = 0; a < 3; a++) sum[a] += weight * (double)job->v.back[n->entry][a] - (double)n->mass * (double)counted[a];
}

static void press(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    const WallNode *node = job->walls->node.data;
    for (int32_t i = begin; i < end; i++) {
        double sum[3], along = 0.0;
        job->v.moved[i][3] = 0.0f;
        if (!node[i].follows) continue;
        given(job, (uint32_t)i, sum);
        for (int a = 0; a < 3; a++) along += sum[a] * (double)node[i].normal[0][a];
        job->v.moved[i][3] = (float)along;
    }
}

static void times_lump(const WallNode *n, const float v[3], float out[3])
{
    const float *m = n->lump;
    out[0] = m[0] * v[0] + m[1] * v[1] + m[2] * v[2];
    out[1] = m[1] * v[0] + m[3] * v[1] + m[4] * v[2];
    out[2] = m[2] * v[0] + m[4] * v[1] + m[5] * v[2];
}

/* Coulomb: the motion along the wall loses at most the coefficient times the normal impulse, of the nodes that follow in proportion to what they follow. Those that slip
 * have that motion, and so the loss, themselves. */
static void rub(void *context, int32_t begin, int32_t end)
{
    const ApplyJob *job = context;
    const WallNode *node = job->walls->node.data;
    const WallFree *free = job->walls->free.data;
    const WallEntry *entry = job->walls->entry.data;
    const WallLink *link = job->walls->link.data;
    for (int32_t f = begin; f < end; f++) {
        const uint32_t i = free[f].place;
        const WallNode *n = &node[i];
        Four *u = &job->v.free[i];
        float v[3], impulse = 0.0f, along = 0.0f, size2 = 0.0f;
        if (n->coefficient == 0.0f) continue;
        for (uint32_t l = n->link_begin; l < n->link_moving; l++) {
            const uint32_t follower = entry[link[l].from].follower;
            if (!node[follower].slips) impulse += link[l].weight * job->v.moved[follower][3];
        }
        if (n->slips) impulse = job->v.moved[i][3];
        const float trace = n->lump[0] + n->lump[3] + n->lump[5];
        if (!(impulse > 0.0f) || !(trace > 0.0f)) continue;
        for (int a = 0; a < 3; a++) along += ((*u)[a] - n->surface[a]) * n->normal[0][a];
        for (int a = 0; a < 3; a++) {
            v[a] = (*u)[a] - n->surface[a] - along * n->normal[0][a];
            size2 += v[a] * v[a];
        }
        if (!(size2 > 0.0f)) continue;
        float m[3];
        times_lump(n, v, m);
        const float mass = (m[0] * v[0] + m[1] * v[1] + m[2] * v[2]) / size2; /* in the direction of motion */
        const float lost = mass > 0.0f ? n->coefficient * impulse / (mass * sqrtf(size2)) : 1.0f;
        for (int a = 0; a < 3; a++) (*u)[a] -= fminf(lost, 1.0f) * v[a];
        if (n->follows) continue; /* find_moved() comes after this */
        job->v.moved[i] = *u;
        store_node(*u, job_nodes(job), n->node);
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

static Span span_of(uint32_t count) { return (Span){(int32_t)count, GRAIN, (int64_t)count * WALL_NODE_NS}; }

void walls_add(const Walls *walls, const ContactFrame *frame, Loops *loops, bool linear, const uint8_t *mark)
{
    const ApplyJob job = {walls, frame, vectors_of(walls), linear ? 0.0f : 1.0f, mark};
    const Span all = span_of(walls->nodes), free = span_of(walls->frees), moved = span_of(walls->moves);
    if (walls->grips > 0) LOOPS_ADD(loops, span_once(), hold_bodies, &job);
    if (!linear) unilateral_add(&job, loops);
    LOOPS_ADD(loops, all, send_back, &job);
    LOOPS_ADD(loops, free, find_free, &job);
    if (walls->grips > 0) {
        LOOPS_ADD(loops, span_once(), let_yield, &job);
        LOOPS_ADD(loops, span_of(walls->beside), find_free_again, &job);
    }
    if (frame->colliders->contacts > 0) {
        LOOPS_ADD(loops, grid_nodes(frame->grid, 4), obey, &job);
        LOOPS_ADD(loops, free, take_free, &job);
    }
    LOOPS_ADD(loops, moved, find_moved, &job);
    if (walls->rubs && !linear) {
        LOOPS_ADD(loops, all, press, &job);
        LOOPS_ADD(loops, free, rub, &job);
        LOOPS_ADD(loops, moved, find_moved, &job);
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
    const Four p = vectors_of(walls).momentum[walls_place(walls, node) - 1];
    return p[0] * u[0] + p[1] * u[1] + p[2] * u[2];
}

float walls_value(const Walls *walls, uint32_t node, const float *u, const float *base, const float *push)
{
    const WallNode *n = (const WallNode *)walls->node.data + walls_place(walls, node) - 1;
    float value = 0.0f;
    for (int a = 0; a < 3; a++) {
        const float free = n->mass * (base[a] - n->shift[a]) + push[a];
        value += 0.5f * n->mass * base[a] * base[a] - 0.5f * (u[a] - n->shift[a]) * free - n->shift[a] * push[a];
    }
    return value;
}

/* ---- Impulses ---- */

void walls_book_face(const ContactFrame *frame, const WallNode *n, int face, const WallNode *place, const double gained[3])
{
    const Colliders *colliders = frame->colliders;
    const Obstacle *o = &colliders->obstacle[n->obstacle[face]];
    double point[3];
    const uint32_t cells = (uint32_t)frame->grid->block_cells;
    if (!o->measures) return;
    contacts_node_position(frame, (int32_t)(place->node / cells), (int)(place->node % cells), point);
    impulse_add(&colliders->impulses.sum[o->place], point, gained);
}

void walls_book(const Walls *walls, const ContactFrame *frame)
{
    if (!frame->colliders->measures || walls->nodes == 0) return;
    const ApplyJob job = {walls, frame, vectors_of(walls), 1.0f, NULL};
    const double scale = contacts_momentum_scale(frame);
    for (uint32_t i = 0; i < walls->nodes; i++) {
        const WallNode *n = (const WallNode *)walls->node.data + i;
        double sum[3], gained[3];
        float held[3];
        given(&job, i, sum);
        const Four back = folded(&job, i, n->link_begin, n->link_moving), u = job.v.free[i];
        times_lump(n, (const float[]){u[0], u[1], u[2]}, held);
        for (int a = 0; a < 3; a++) sum[a] += (double)held[a] - (double)back[a];
        for (int j = 1; j < n->normals; j++) { /* along its own normal each wall, the rest the nearest one */
            double along = 0.0;
            for (int a = 0; a < 3; a++) along += sum[a] * (double)n->normal[j][a];
            for (int a = 0; a < 3; a++) {
                gained[a] = scale * along * (double)n->normal[j][a];
                sum[a] -= along * (double)n->normal[j][a];
            }
            walls_book_face(frame, n, j, n, gained);
        }
        for (int a = 0; a < 3; a++) gained[a] = scale * sum[a];
        if (n->normals > 0) walls_book_face(frame, n, 0, n, gained);
    }
}

/* ---- What lies behind rounded edges ---- */

/* Adds a weight to a node that is free, from the wall of `at`. */
static void push_free(const ApplyJob *job, const WallNode *at, const WallNode *to, float weight, const float gravity[3], float *base)
{
    float *u = job_nodes(job) + (size_t)to->node * K_NODE_WIDTH, *from = base + (size_t)to->node * K_NODE_WIDTH;
    double gained[3];
    for (int a = 0; a < 3; a++) {
        const float more = weight * gravity[a] / to->mass;
        u[a] += more;
        from[a] += more;
        gained[a] = (double)(to->mass * more);
    }
    if (!job->frame->colliders->measures) return;
    for (int a = 0; a < 3; a++) gained[a] *= contacts_momentum_scale(job->frame);
    walls_book_face(job->frame, at, 0, to, gained);
}

/* Mass in a full cell before a wall. */
static float density_at(const WallNode *n) { return n->mass / (n->open < 0.0f ? 1.0f : n->open); }

void walls_weigh(const Walls *walls, const ContactFrame *frame, const float gravity[3], float *base)
{
    const ApplyJob job = {walls, frame, vectors_of(walls), 1.0f, NULL};
    const WallNode *node = walls->node.data;
    const WallCorner *corner = walls->corner.data;
    for (uint32_t i = 0; i < walls->nodes; i++) {
        const WallNode *n = &node[i];
        if (n->behind == 0.0f) continue;
        if (n->entry == NO_ENTRY) {
            if (!n->follows && n->mass > 0.0f) push_free(&job, n, n, n->behind * density_at(n), gravity, base);
            continue;
        }
        const WallEntry *entry = (const WallEntry *)walls->entry.data + n->entry;
        for (uint32_t k = entry->corner_begin; k < entry->corner_end; k++) {
            const WallNode *parent = &node[corner[k].parent];
            if (parent->mass > 0.0f) push_free(&job, n, parent, corner[k].weight * n->behind * density_at(parent), gravity, base);
        }
    }
}

/* ---- Density ---- */

float walls_open_share(const Walls *walls, uint32_t node)
{
    const uint32_t place = walls_place(walls, node);
    return place > 0 ? ((const WallNode *)walls->node.data)[place - 1].open : -1.0f;
}

static void fold_scalar(const Walls *walls, const float *from, float *to)
{
    const WallNode *node = walls->node.data;
    const WallLink *link = walls->link.data;
    for (uint32_t i = 0; i < walls->nodes; i++) {
        float sum = node[i].own_mirror * from[node[i].node];
        for (uint32_t l = node[i].link_moving; l < node[i].link_end; l++) sum += link[l].weight * from[node[link[l].from].node];
        to[i] = sum;
    }
}

void walls_fold_volume(const Walls *walls, float *volume, float *open)
{
    static const float CLOSED = 1e-3f; /* less of a cell is rounding */
    const WallNode *node = walls->node.data;
    const WallMirror *mirror = walls->mirror.data;
    const WallCorner *corner = walls->corner.data;
    if (walls->nodes == 0) return;
    float *held = walls->vector.data, *room = held + walls->nodes;
    fold_scalar(walls, volume, held);
    fold_scalar(walls, open, room);
    for (uint32_t i = 0; i < walls->nodes; i++) held[i] = room[i] > CLOSED ? held[i] / room[i] : 0.0f;
    for (uint32_t i = 0; i < walls->nodes; i++) {
        float sum = node[i].own_mirror * held[i];
        for (uint32_t e = node[i].mirror_begin; e < node[i].mirror_end; e++)
            for (uint32_t k = mirror[e].corner_begin; k < mirror[e].corner_end; k++) sum += corner[k].weight * held[corner[k].parent];
        if (volume[node[i].node] > 0.0f) volume[node[i].node] = sum; /* else nobody listens */
        open[node[i].node] = 1.0f;
    }
}
