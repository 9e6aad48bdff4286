/* Particles that passed an obstacle or ended inside one, and what putting them back gives it. */
#include <math.h>

#include "colliders.h"
#include "result.h"

/* An obstacle as a block sees it. Places are relative to the block's first node: the products and differences that lead there are exact in double
 * precision, while a place far from the origin would lose the last bits of its fraction, and the same scene a million cells away end elsewhere. */
typedef struct View {
    const Obstacle *obstacle; /* in the world */
    Obstacle local;
    int32_t cell[3];  /* of the block's first node */
    double corner[3]; /* where that is [m] */
} View;

static View view_from(const ContactFrame *frame, const Obstacle *o, int32_t block)
{
    const int32_t *corner = (const int32_t *)frame->grid->coordinate.data + 3 * block;
    View view = {.obstacle = o, .local = *o};
    for (int a = 0; a < frame->grid->dimension; a++) {
        view.cell[a] = frame->grid->anchor[a] + corner[a] * K_BLOCK_AXIS;
        view.corner[a] = (double)view.cell[a] * frame->cell_size;
        view.local.start.position[a] -= view.corner[a];
        view.local.end.position[a] -= view.corner[a];
    }
    return view;
}

/* In cells. */
static double place_in_view(const View *view, const Particles *p, uint32_t row, int axis)
{
    return (double)(p->cell[axis][row] - view->cell[axis]) + (double)p->fraction[axis][row];
}

/* Moves a particle by `way` [cells] and takes away its velocity into the surface with this normal. */
static void put_back(const ContactFrame *frame, const View *view, Particles *p, uint32_t row, float dt, const double way[3], const double normal[3],
                     ImpulseSum *sum)
{
    float surface[3];
    double point[3] = {0}, gained[3] = {0}, inward = 0.0;
    for (int a = 0; a < p->dimension; a++) point[a] = place_in_view(view, p, row, a) * frame->cell_size;
    obstacle_motion(&view->local, point, frame->cell_size, frame->max_displacement, surface);
    const double to_velocity = frame->cell_size / (double)dt;
    for (int a = 0; a < p->dimension; a++) inward += (p->velocity[a][row] - surface[a] * to_velocity) * normal[a];
    particles_shift(p, row, way);
    particles_forget(p, row);
    const double mass = (double)p->mass[row] * pow(frame->cell_size, p->dimension);
    for (int a = 0; a < p->dimension && inward < 0.0; a++) {
        const float before = p->velocity[a][row];
        p->velocity[a][row] -= (float)(inward * normal[a]);
        gained[a] = mass * ((double)p->velocity[a][row] - (double)before);
        point[a] += way[a] * frame->cell_size + view->corner[a];
    }
    if (sum && inward < 0.0) impulse_add(sum, point, gained);
}

static const double TOUCH = 1e-3; /* [cells] */

/* Whether the way out of an obstacle, to a point [m], leads into another one: where they overlap there is none. Walls do not count: what gets behind
 * them comes back at once. */
static bool leads_into_another(const ContactFrame *frame, const Obstacle *o, const double point[3])
{
    double normal[3];
    for (int i = 0; i < frame->colliders->obstacle_count; i++) {
        const Obstacle *other = &frame->colliders->obstacle[i];
        if (other == o || other->wall) continue;
        if (solid_distance(&other->end, point, normal) < -TOUCH * frame->cell_size) return true;
    }
    return false;
}

/* A particle is moved to the surface at once out of a wall, and at most a cell per substep out of anything else, so that an
 * obstacle that lands on matter does not fling it. Its velocity into the surface is taken away. */
static void push_particle(const ContactFrame *frame, const View *view, Particles *p, uint32_t row, float dt, ImpulseSum *sum)
{
    const Obstacle *o = &view->local;
    double point[3] = {0}, normal[3];
    for (int a = 0; a < p->dimension; a++) point[a] = place_in_view(view, p, row, a) * frame->cell_size;
    double depth = -solid_distance(&o->end, point, normal) / frame->cell_size;
    if (depth <= 0.0) return;
    double way[3] = {0}, out[3] = {0};
    for (int a = 0; a < p->dimension; a++) out[a] = view->corner[a] + point[a] + depth * frame->cell_size * normal[a];
    const bool stays = frame->stays && !o->wall && frame->stays[p->material[row]].kind == K_LIQUID;
    if (stays && leads_into_another(frame, view->obstacle, out)) return;
    if (!o->wall) depth = fmin(depth, 1.0);
    for (int a = 0; a < p->dimension; a++) way[a] = depth * normal[a];
    put_back(frame, view, p, row, dt, way, normal, sum);
}

/* ---- Particles that passed an obstacle ---- */

/* A node behind a thin wall moves as if nothing were before it, and carries along what lies before the wall: particles may arrive on the other
 * side without ever having been inside. Their way is followed through the distances of the obstacle, at the end of the substep (sphere
 * tracing: J. Hart, "Sphere tracing", The Visual Computer 12, 1996). Shorter ways than these end inside, where they are noticed. */
static const double LONGEST_UNSEEN = 0.5, LONGEST_UNSEEN_BAKED = 0.25; /* [cells] */
static const double NUDGED_MOST = 0.1; /* [cells]: what crowded particles move beside their way */
static const double CARRIED_MOST = 1.0; /* [cells per substep]: what an obstacle that is faster lands on is not carried along */

/* The longest way [cells] that needs no look; infinite for what cannot be passed. */
static double longest_unseen(const ContactFrame *frame, const Obstacle *o)
{
    const Solid *s = &o->end;
    if (o->wall || s->kind == PBMPM_PLANE) return INFINITY;
    if (s->grid) return LONGEST_UNSEEN_BAKED;
    double half = s->kind == PBMPM_BOX ? s->half_extents[0] : s->radius;
    for (int a = 1; a < s->dimension && s->kind == PBMPM_BOX; a++) half = fmin(half, s->half_extents[a]);
    return fmin(LONGEST_UNSEEN, half / frame->cell_size);
}

static bool is_in_reach(const ContactFrame *frame, const Obstacle *o, int32_t block, double way)
{
    double centre[3];
    contacts_block_centre(frame, block, centre);
    const double half_diagonal = 0.5 * K_BLOCK_AXIS * sqrt((double)frame->grid->dimension);
    return solid_least(&o->end, centre) / frame->cell_size <= half_diagonal + way;
}

/* Relative to the block's first node. */
static float place_in_block(const ContactFrame *frame, const Particles *p, int32_t block, uint32_t row, int axis)
{
    const int32_t *corner = (const int32_t *)frame->grid->coordinate.data + 3 * block;
    return (float)(p->cell[axis][row] - frame->grid->anchor[axis] - corner[axis] * K_BLOCK_AXIS) + p->fraction[axis][row];
}

void contacts_keep_places(const ContactFrame *frame, const Particles *p, int32_t begin, int32_t end)
{
    const Colliders *colliders = frame->colliders;
    const uint32_t *rows = frame->grid->block_begin.data;
    for (int32_t block = begin; block < end; block++) {
        bool wanted = false;
        for (int i = 0; i < colliders->obstacle_count && !wanted; i++) {
            const Obstacle *o = &colliders->obstacle[i];
            wanted = longest_unseen(frame, o) < INFINITY && is_in_reach(frame, o, block, frame->max_displacement);
        }
        for (int a = 0; wanted && a < p->dimension; a++) {
            float *kept = particles_spare(p, CLASS_VECTOR, a);
            for (uint32_t row = rows[block]; row < rows[block + 1]; row++) kept[row] = place_in_block(frame, p, block, row, a);
        }
    }
}

/* The share of the way [cells] from `from` [m] at which it runs into the solid, with the normal there; 1: it does not. A convex solid lies behind the
 * plane through its nearest point, so the way to that plane is free, and a way that grazes a wall arrives after one step; steps as long as the
 * distance alone would need ever more of them, the flatter it is. */
static double share_until_hit(const Solid *solid, const double from[3], const double way[3], double length, double cell_size, double normal[3])
{
    enum { STEPS = 48 };
    double share = 0.0;
    for (int i = 0; i < STEPS && share < 1.0; i++) {
        double at[3], inward = 0.0;
        for (int a = 0; a < 3; a++) at[a] = from[a] + share * way[a] * cell_size;
        const double distance = solid_distance(solid, at, normal) / cell_size;
        for (int a = 0; a < 3; a++) inward -= way[a] * normal[a];
        if (distance <= TOUCH && inward > 0.0) return share;
        if (inward <= 0.0 && !solid->grid) return 1.0; /* convex: it only gets further away */
        share += fmax(distance, TOUCH) / (solid->grid ? length : inward);
    }
    return 1.0;
}

/* What is missing from the way [cells] of a particle that started at `from` [m] so that it slides along the surface it runs into instead of
 * passing through. False: nothing. */
static bool slide(const ContactFrame *frame, const Obstacle *o, const double from[3], const double way[3], double back[3], double normal[3])
{
    double length = 0.0, inward = 0.0;
    for (int a = 0; a < 3; a++) length += way[a] * way[a];
    length = sqrt(length);
    const double left = 1.0 - share_until_hit(&o->end, from, way, length, frame->cell_size, normal);
    if (left <= 0.0) return false;
    for (int a = 0; a < 3; a++) inward -= left * way[a] * normal[a];
    for (int a = 0; a < 3; a++) back[a] = inward * normal[a];
    return true;
}

static void hold_back(const ContactFrame *frame, const View *view, Particles *p, int32_t block, uint32_t row, double unseen, float dt, ImpulseSum *sum)
{
    const Obstacle *o = &view->local;
    double from[3] = {0}, way[3] = {0}, back[3], normal[3], length2 = 0.0;
    float surface[3], carried2 = 0.0f;
    for (int a = 0; a < p->dimension; a++) {
        way[a] = (double)(place_in_block(frame, p, block, row, a) - particles_spare(p, CLASS_VECTOR, a)[row]);
        from[a] = (place_in_view(view, p, row, a) - way[a]) * frame->cell_size;
        length2 += way[a] * way[a];
    }
    if (o->moves) {
        obstacle_motion(o, from, frame->cell_size, frame->max_displacement, surface);
        length2 = 0.0;
        for (int a = 0; a < p->dimension; a++) {
            carried2 += surface[a] * surface[a];
            from[a] += (double)surface[a] * frame->cell_size;
            way[a] -= (double)surface[a];
            length2 += way[a] * way[a];
        }
        if ((double)carried2 > CARRIED_MOST * CARRIED_MOST) return;
    }
    if (length2 > unseen * unseen && slide(frame, o, from, way, back, normal)) put_back(frame, view, p, row, dt, back, normal, sum);
}

/* ---- Both ---- */

static bool is_near(const ContactFrame *frame, const Obstacle *o, int32_t block)
{
    return is_in_reach(frame, o, block, (double)((const float *)frame->grid->travel.data)[block]);
}

static void push_block(const ContactFrame *frame, const Obstacle *o, Particles *particles, float dt, int32_t block, ImpulseSum *sum)
{
    const uint32_t *begin = frame->grid->block_begin.data;
    const View view = view_from(frame, o, block);
    const double unseen = longest_unseen(frame, o);
    const bool watched = unseen < (o->moves ? CARRIED_MOST : NUDGED_MOST) + (double)((const float *)frame->grid->travel.data)[block];
    for (uint32_t row = begin[block]; row < begin[block + 1]; row++) {
        if (particles->status[row] != K_ALIVE) continue;
        if (watched) hold_back(frame, &view, particles, block, row, unseen, dt, sum);
        push_particle(frame, &view, particles, row, dt, sum);
    }
}

/* The note to book an obstacle's impulse in; null when all are taken. */
static ImpulseSum *take_note(PushNotes *notes, int obstacle)
{
    if (notes->count == PUSH_NOTES) return NULL;
    notes->obstacle[notes->count] = obstacle;
    notes->sum[notes->count] = (ImpulseSum){{0}, {0}};
    return &notes->sum[notes->count++];
}

static void push_and_note(const ContactFrame *frame, Particles *particles, float dt, int32_t block, PushNotes *notes)
{
    const Colliders *colliders = frame->colliders;
    notes->count = 0;
    notes->resume = -1;
    for (int i = 0; i < colliders->obstacle_count; i++) {
        const Obstacle *o = &colliders->obstacle[i];
        if (!is_near(frame, o, block)) continue;
        ImpulseSum *sum = o->measures ? take_note(notes, i) : NULL;
        if (o->measures && !sum) {
            notes->resume = i;
            return;
        }
        push_block(frame, o, particles, dt, block, sum);
    }
}

void contacts_push_out(const ContactFrame *frame, Particles *particles, float dt, int32_t begin, int32_t end)
{
    const Colliders *colliders = frame->colliders;
    for (int32_t block = begin; block < end; block++) {
        if (colliders->measures) {
            push_and_note(frame, particles, dt, block, (PushNotes *)colliders->impulses.notes.data + block);
            continue;
        }
        for (int i = 0; i < colliders->obstacle_count; i++)
            if (is_near(frame, &colliders->obstacle[i], block)) push_block(frame, &colliders->obstacle[i], particles, dt, block, NULL);
    }
}

void contacts_pass_over(const ContactFrame *frame, int32_t block)
{
    if (!frame->colliders->measures) return;
    PushNotes *notes = (PushNotes *)frame->colliders->impulses.notes.data + block;
    notes->count = 0;
    notes->resume = -1;
}

pbmpm_result contacts_prepare_push(const ContactFrame *frame, Memory *memory)
{
    Colliders *colliders = frame->colliders;
    const size_t blocks = (size_t)frame->grid->particle_blocks;
    if (!colliders->measures || array_reserve(memory, &colliders->impulses.notes, blocks, sizeof(PushNotes))) return PBMPM_OK;
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the impulses of %zu blocks", blocks);
}

void contacts_book_push(const ContactFrame *frame, Particles *particles, float dt)
{
    const Colliders *colliders = frame->colliders;
    if (!colliders->measures) return;
    for (int32_t block = 0; block < frame->grid->particle_blocks; block++) {
        const PushNotes *notes = (const PushNotes *)colliders->impulses.notes.data + block;
        for (int n = 0; n < notes->count; n++) {
            ImpulseSum *sum = &colliders->impulses.sum[colliders->obstacle[notes->obstacle[n]].place];
            for (int a = 0; a < 3; a++) {
                sum->linear[a] += notes->sum[n].linear[a];
                sum->angular[a] += notes->sum[n].angular[a];
            }
        }
        for (int i = notes->resume; i >= 0 && i < colliders->obstacle_count; i++) {
            const Obstacle *o = &colliders->obstacle[i];
            if (is_near(frame, o, block)) push_block(frame, o, particles, dt, block, o->measures ? &colliders->impulses.sum[o->place] : NULL);
        }
    }
}
