/* Particles that passed an obstacle or ended inside one, and what putting them back gives it. */
#include <math.h>

#include "base/result.h"
#include "contact/field.h"
#include "contact/push_out.h"

/* Places here are counted from the grid's anchor, a whole number of cells near the matter, or from a block's first node. A place far from the origin would lose the last
 * bits of its fraction: a particle 2^-35 cells deep in a floor would lie on it a million cells away, where double precision ends at 2^-33. It would not be put back
 * there, and the same scene would end elsewhere. Differences of places are exact where a cell is a power of two. */

/* The same frame with its obstacles and matter counted from the anchor. */
typedef struct Anchored {
    ContactFrame frame;
    Colliders colliders;
} Anchored;

static void count_from_anchor(const ContactFrame *frame, Anchored *anchored)
{
    anchored->frame = *frame;
    anchored->colliders = *frame->colliders;
    anchored->colliders.obstacle = frame->colliders->anchored.data;
    anchored->frame.colliders = &anchored->colliders;
}

/* From the anchor [m]. */
static void corner_of(const ContactFrame *frame, int32_t block, double corner[3])
{
    const int32_t *coordinate = (const int32_t *)frame->grid->coordinate.data + 3 * block;
    for (int a = 0; a < 3; a++) corner[a] = a < frame->grid->dimension ? (double)(coordinate[a] * K_BLOCK_AXIS) * frame->cell_size : 0.0;
}

/* An obstacle as a block sees it, from the block's first node. */
typedef struct View {
    Obstacle local;
    int32_t cell[3];  /* of the block's first node */
    double corner[3]; /* where that is [m] */
} View;

/* The obstacle is counted from the anchor. */
static View view_from(const ContactFrame *frame, const Obstacle *o, int32_t block)
{
    const int32_t *coordinate = (const int32_t *)frame->grid->coordinate.data + 3 * block;
    double corner[3];
    View view = {.local = *o};
    corner_of(frame, block, corner);
    for (int a = 0; a < frame->grid->dimension; a++) {
        view.cell[a] = frame->grid->anchor[a] + coordinate[a] * K_BLOCK_AXIS;
        view.corner[a] = (double)view.cell[a] * frame->cell_size;
        view.local.start.position[a] -= corner[a];
        view.local.end.position[a] -= corner[a];
    }
    return view;
}

/* In cells. */
static double place_in_view(const View *view, const Particles *p, uint32_t row, int axis)
{
    return (double)(p->cell[axis][row] - view->cell[axis]) + (double)p->fraction[axis][row];
}

/* One particle of a block, in a substep. */
typedef struct Pushed {
    Particles *all;
    int32_t block;
    uint32_t row;
} Pushed;

/* Moves a particle by `way` [cells] and takes away its velocity into the surface with this normal. */
static void put_back(const ContactFrame *frame, const View *view, const Pushed *one, const double way[3], const double normal[3], ImpulseSum *sum)
{
    Particles *p = one->all;
    const uint32_t row = one->row;
    float surface[3];
    double point[3] = {0}, gained[3] = {0}, inward = 0.0;
    for (int a = 0; a < p->dimension; a++) point[a] = place_in_view(view, p, row, a) * frame->cell_size;
    obstacle_motion(&view->local, point, frame->cell_size, frame->max_displacement, surface);
    for (int a = 0; a < p->dimension; a++) inward += (p->velocity[a][row] - surface[a] * frame->substep->to_velocity) * normal[a];
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

/* Where the impulses of a block's particles are noted; null: nothing measures. */
typedef struct Book {
    PushNotes *notes; /* of the block; null in the serial pass, which adds to the sums */
} Book;

/* The sum for what an obstacle is given; null: it does not measure. False: the block has no room for another one. */
static bool find_sum(const ContactFrame *frame, const Book *book, const Obstacle *o, ImpulseSum **sum)
{
    const int obstacle = (int)(o - frame->colliders->obstacle);
    *sum = NULL;
    if (!o->measures) return true;
    if (!book->notes) {
        *sum = &frame->colliders->impulses.sum[o->place];
        return true;
    }
    PushNotes *notes = book->notes;
    for (int n = 0; n < notes->count && !*sum; n++)
        if (notes->obstacle[n] == obstacle) *sum = &notes->sum[n];
    if (*sum) return true;
    if (notes->count == PUSH_NOTES) return false;
    notes->obstacle[notes->count] = obstacle;
    notes->sum[notes->count] = (ImpulseSum){{0}, {0}};
    *sum = &notes->sum[notes->count++];
    return true;
}

/* ---- Particles inside ---- */

/* From the anchor [m]. */
static void place_of(const ContactFrame *frame, const Particles *p, uint32_t row, double point[3])
{
    for (int a = 0; a < 3; a++)
        point[a] = a < p->dimension ? ((double)(p->cell[a][row] - frame->grid->anchor[a]) + (double)p->fraction[a][row]) * frame->cell_size : 0.0;
}

/* How far a particle would have to move out through a face [cells]; up: not outside by a rounding. */
static double depth_behind(const Face *face) { return field_rounded(-face->distance + 0.5 * FIELD_ROUNDING); }

static void push_through(const ContactFrame *frame, const Face *face, double length, const Pushed *one, ImpulseSum *sum)
{
    const View view = view_from(frame, face->obstacle, one->block);
    double way[3], normal[3];
    for (int a = 0; a < 3; a++) {
        normal[a] = field_rounded(face->normal[a]);
        way[a] = length * normal[a];
    }
    put_back(frame, &view, one, way, normal, sum);
}

/* What is behind a wall of the domain comes back at once, whatever else is there. False: no room to book in. */
static bool push_inside(const ContactFrame *frame, const Near *near, const Pushed *one, const Book *book)
{
    for (int i = 0; i < near->count; i++) {
        double point[3];
        Face face = {.obstacle = near->obstacle[i]};
        ImpulseSum *sum;
        if (!near->obstacle[i]->wall) continue;
        place_of(frame, one->all, one->row, point);
        face.distance = solid_distance(field_solid(near, near->obstacle[i]), point, face.normal) / near->cell_size;
        if (face.distance >= 0.0) continue;
        if (!find_sum(frame, book, near->obstacle[i], &sum)) return false;
        push_through(frame, &face, depth_behind(&face), one, sum);
    }
    return true;
}

static bool is_behind_wall(const Near *near, const double point[3])
{
    for (int i = 0; i < near->count; i++)
        if (near->obstacle[i]->wall && solid_gap(field_solid(near, near->obstacle[i]), point) < 0.0) return true;
    return false;
}

/* Whether matter is trapped where obstacles overlap, and stays there, see ContactFrame: it is in more than one, or the surface that is nearest lies in another. */
static bool stays(const ContactFrame *frame, const Near *near, const Particles *p, uint32_t row, const double point[3], int faces)
{
    Face face;
    int in = 0;
    if (!frame->stays || frame->stays[p->material[row]].kind != K_LIQUID) return false;
    for (int i = 0; i < near->count; i++) in += solid_gap(field_solid(near, near->obstacle[i]), point) < 0.0;
    if (in > 1 || faces > 0 || !field_surface(near, point, &face)) return in > 1;
    for (int i = 0; i < near->count; i++)
        if (near->obstacle[i] != face.obstacle && !near->obstacle[i]->wall && solid_gap(field_solid(near, near->obstacle[i]), face.foot) < 0.0) return true;
    return false;
}

/* Where obstacles overlap so far that no face is near: out of the one whose surface is nearest, unless that leads behind a wall. */
static bool has_way_out(const Near *near, const double point[3], Face *face)
{
    double end[3];
    if (!field_surface(near, point, face)) return false;
    for (int a = 0; a < 3; a++) end[a] = point[a] + fmin(-face->distance, 1.0) * near->cell_size * face->normal[a];
    return !is_behind_wall(near, end);
}

/* By so many cells per substep an obstacle that lands on matter pushes it away: it does not fling it. */
static const double GENTLE = 1.0;

/* Moves a particle out through one face after the other, for what leads out of one may lead into the next: successive projection (L. Bregman, "Finding the common point
 * of convex sets by the method of successive projection", Dokl. Akad. Nauk SSSR 162, 1965). At once out of a wall, and by at most `most` cells out of anything else.
 * False: no room to book in. */
static bool push_through_all(const ContactFrame *frame, Face *face, int count, double most, const Pushed *one, const Book *book)
{
    ImpulseSum *sum[FIELD_FACES] = {NULL};
    double left[FIELD_FACES];
    for (int i = 0; i < count; i++) {
        left[i] = face[i].obstacle->wall ? INFINITY : most;
        if ((count > 1 || face[i].distance < 0.0) && !find_sum(frame, book, face[i].obstacle, &sum[i])) return false;
    }
    for (int round = 0; round < 2 * count - 1; round++)
        for (int i = 0; i < count; i++) {
            const double length = fmin(depth_behind(&face[i]), left[i]);
            if (face[i].distance >= 0.0 || length <= 0.0) continue;
            push_through(frame, &face[i], length, one, sum[i]);
            left[i] -= length;
            for (int k = 0; k < count; k++) face[k].distance += length * dot3(face[i].normal, face[k].normal);
        }
    return true;
}

/* [cells] Its neighbours may have pressed a particle so far into a joint before this substep; by trial. What obstacles squeeze between them as they close in is deeper:
 * it stays. */
static const double PRESSED = 0.5;

/* How far a particle moved in this substep [cells]. */
static double travel_of(const ContactFrame *frame, const Particles *p, uint32_t row)
{
    double sum = 0.0;
    for (int a = 0; a < p->dimension; a++) sum += (double)p->velocity[a][row] * (double)p->velocity[a][row];
    return sqrt(sum) / frame->substep->to_velocity;
}

/* A particle that ended inside obstacles is put back to the surface of their union. Its velocity into the surface is taken away. False: no room to book in. */
static bool push_particle(const ContactFrame *frame, const Near *close, const double centre[3], double reach, const Pushed *one, const Book *book)
{
    const Particles *p = one->all;
    const uint32_t row = one->row;
    Near all, some;
    double point[3];
    Face face[FIELD_FACES];
    place_of(frame, p, row, point);
    if (!field_holds(close, point)) return true;
    if (!push_inside(frame, close, one, book)) return false;
    place_of(frame, p, row, point);
    if (!field_holds(close, point)) return true;
    const double travel = travel_of(frame, p, row);
    field_near(&all, frame, centre, reach + travel + 2.0 * NODE_REACH, true);
    const Near *near = field_meeting(&all, contacts_row_groups(frame, p, row), &some);
    const bool inside = field_distance(near, point) < 0.0;
    int count = inside ? field_faces(near, point, NODE_REACH, face) : 0;
    if (inside && stays(frame, near, p, row, point, count)) return true;
    const int joint = field_joint_faces(near, point, travel + PRESSED, face); /* no farther than it fell in */
    if (joint > 0) return push_through_all(frame, face, joint, INFINITY, one, book);
    if (inside && count == 0) count = has_way_out(near, point, &face[0]);
    return push_through_all(frame, face, count, GENTLE, one, book);
}

/* The distance from a convex solid is at least that from the plane through its place that is nearest to some point, with the normal there. In cells, of places from a
 * block's first node. */
typedef struct LeastDistance {
    float normal[3], at_node;
} LeastDistance;

/* Seen from the middle of a block; false: one of the obstacles is not convex. */
static bool find_least(const ContactFrame *frame, const Near *near, const double centre[3], LeastDistance *least)
{
    static const double MIDDLE = 0.5 * (K_BLOCK_AXIS - 1);
    for (int i = 0; i < near->count; i++) {
        const Solid *solid = field_solid(near, near->obstacle[i]);
        double normal[3], distance;
        if (solid->grid) return false;
        distance = solid_distance(solid, centre, normal) / frame->cell_size;
        least[i] = (LeastDistance){{0.0f}, 0.0f};
        for (int a = 0; a < frame->grid->dimension; a++) {
            least[i].normal[a] = (float)normal[a];
            distance -= MIDDLE * normal[a];
        }
        least[i].at_node = (float)distance;
    }
    return true;
}

/* Whether a place is clear of all of them: by more than rounds off in single precision, within as many cells as a step may take, and in doubt not. */
static bool is_clear(const LeastDistance *least, int count, const float place[3])
{
    static const float ROUNDED = 1e-3f;
    for (int i = 0; i < count; i++) {
        const float *n = least[i].normal;
        if (!(least[i].at_node + n[0] * place[0] + n[1] * place[1] + n[2] * place[2] > ROUNDED)) return false;
    }
    return true;
}

/* ---- Particles that passed an obstacle ---- */

static const double AT_SURFACE = 1e-3; /* [cells] before a surface: there a way that is followed ends, and rounding does not reach back */

/* A node behind a thin wall moves as if nothing were before it, and carries along what lies before the wall: particles may arrive on the other
 * side without ever having been inside. Their way is followed through the distances of the obstacle, at the end of the substep (sphere
 * tracing: J. Hart, "Sphere tracing", The Visual Computer 12, 1996). Shorter ways than these end inside, where they are noticed. */
static const double LONGEST_UNSEEN = 0.5, LONGEST_UNSEEN_BAKED = 0.25; /* [cells]; by trial */
static const double SHALLOW = 0.75; /* of the way to the middle of an obstacle: what ends there is nearer to the face that it came through, in spite of roundings */
static const double NUDGED_MOST = 0.1; /* [cells]: what crowded particles move beside their way */
static const double CARRIED_MOST = 1.0; /* [cells per substep]: where a faster obstacle went, no node felt it, and no list has what it passed. With more a body left the domain (H16, 100 cells per step) */

/* The longest way [cells] that needs no look; infinite for what cannot be passed. */
static double longest_unseen(const ContactFrame *frame, const Obstacle *o)
{
    if (o->end.grid) return LONGEST_UNSEEN_BAKED;
    const double half = 0.5 * obstacle_breadth(o) / frame->cell_size;
    return half < INFINITY ? fmin(LONGEST_UNSEEN, SHALLOW * half) : INFINITY;
}

/* The middle of a block, from the anchor [m]. */
static void centre_of(const ContactFrame *frame, int32_t block, double centre[3])
{
    corner_of(frame, block, centre);
    for (int a = 0; a < frame->grid->dimension; a++) centre[a] += 0.5 * (K_BLOCK_AXIS - 1) * frame->cell_size;
}

static bool is_in_reach(const ContactFrame *frame, const Obstacle *o, int32_t block, double way)
{
    double centre[3];
    centre_of(frame, block, centre);
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
            const Obstacle *o = (const Obstacle *)colliders->anchored.data + i;
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
    enum { STEPS = 48 }; /* convex solids take one or two; along a baked surface steps are as short as its distance */
    double share = 0.0;
    for (int i = 0; i < STEPS && share < 1.0; i++) {
        double at[3], inward = 0.0;
        for (int a = 0; a < 3; a++) at[a] = from[a] + share * way[a] * cell_size;
        const double distance = solid_distance(solid, at, normal) / cell_size;
        for (int a = 0; a < 3; a++) inward -= way[a] * normal[a];
        if (distance <= AT_SURFACE && inward > 0.0) return share;
        if (inward <= 0.0 && !solid->grid) return 1.0; /* convex: it only gets further away */
        share += fmax(distance, AT_SURFACE) / (solid->grid ? length : inward);
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

/* False: nothing was in its way. */
static bool hold_back(const ContactFrame *frame, const View *view, const Pushed *one, double unseen, ImpulseSum *sum)
{
    const Particles *p = one->all;
    const uint32_t row = one->row;
    const Obstacle *o = &view->local;
    double from[3] = {0}, way[3] = {0}, back[3], normal[3], length2 = 0.0;
    float surface[3], carried2 = 0.0f;
    for (int a = 0; a < p->dimension; a++) {
        way[a] = (double)(place_in_block(frame, p, one->block, row, a) - particles_spare(p, CLASS_VECTOR, a)[row]);
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
        if ((double)carried2 > CARRIED_MOST * CARRIED_MOST) return false;
    }
    if (!(length2 > unseen * unseen) || !slide(frame, o, from, way, back, normal)) return false;
    put_back(frame, view, one, back, normal, sum);
    return true;
}

/* ---- Both ---- */

static bool is_near(const ContactFrame *frame, const Obstacle *o, int32_t block)
{
    return is_in_reach(frame, o, block, (double)((const float *)frame->grid->travel.data)[block]);
}

/* Holds back what passed one obstacle; false: nothing did. */
static bool hold_block(const ContactFrame *frame, const Obstacle *o, Particles *particles, int32_t block, ImpulseSum *sum)
{
    const uint32_t *begin = frame->grid->block_begin.data;
    const double unseen = longest_unseen(frame, o);
    if (!(unseen < (o->moves ? CARRIED_MOST : NUDGED_MOST) + (double)((const float *)frame->grid->travel.data)[block])) return false;
    const View view = view_from(frame, o, block);
    bool held = false;
    for (uint32_t row = begin[block]; row < begin[block + 1]; row++) {
        const Pushed one = {particles, block, row};
        if (particles->status[row] == K_ALIVE && obstacle_meets(o, contacts_row_groups(frame, particles, row))) held = hold_back(frame, &view, &one, unseen, sum) || held;
    }
    return held;
}

/* Holds back what passed obstacles, from number `first` on; `held`: those before it did. One that holds a particle back may send it through another, which is asked again
 * then. False: there is no room to book in, which comes in the first round if at all. */
static bool hold_all(const ContactFrame *frame, Particles *particles, int32_t block, int first, bool held, const Book *book)
{
    bool again = true;
    for (int round = 0; round < particles->dimension && again; round++, first = 0, held = false) {
        int asked = first; /* who waited had met several */
        for (int i = first; i < frame->colliders->obstacle_count; i++) {
            const Obstacle *o = &frame->colliders->obstacle[i];
            ImpulseSum *sum;
            if (!is_near(frame, o, block)) continue;
            if (!find_sum(frame, book, o, &sum)) {
                book->notes->resume = i;
                book->notes->held = held;
                book->notes->row = ((const uint32_t *)frame->grid->block_begin.data)[block];
                return false;
            }
            held = hold_block(frame, o, particles, block, sum) || held;
            asked++;
        }
        again = held && asked > 1;
    }
    return true;
}

/* Works on a block from the obstacle `first` on, and behind the last one from the row `row` on. `held`: see hold_all(). */
static void push_block(const ContactFrame *frame, Particles *particles, int32_t block, int first, bool held, uint32_t row, const Book *book)
{
    const Colliders *colliders = frame->colliders;
    const uint32_t *begin = frame->grid->block_begin.data;
    double centre[3];
    Near near, some;
    Anchored anchored;
    count_from_anchor(frame, &anchored);
    frame = &anchored.frame;
    if (!hold_all(frame, particles, block, first, held, book)) return;
    centre_of(frame, block, centre);
    const double reach = 0.5 * K_BLOCK_AXIS * sqrt((double)particles->dimension) + (double)((const float *)frame->grid->travel.data)[block];
    field_near(&near, frame, centre, reach, true); /* what particles can be in; what else bounds the way out is looked for where one is */
    LeastDistance least[PBMPM_MAX_COLLIDERS + DOMAIN_WALLS];
    const bool convex = find_least(frame, &near, centre, least);
    for (; row < begin[block + 1] && near.count > 0; row++) {
        float place[3] = {0.0f};
        for (int a = 0; a < particles->dimension; a++) place[a] = place_in_block(frame, particles, block, row, a);
        if (particles->status[row] != K_ALIVE || (convex && is_clear(least, near.count, place))) continue;
        const Near *meeting = field_meeting(&near, contacts_row_groups(frame, particles, row), &some);
        const Pushed one = {particles, block, row};
        if (push_particle(frame, meeting, centre, reach, &one, book)) continue;
        book->notes->resume = colliders->obstacle_count;
        book->notes->held = false;
        book->notes->row = row;
        return;
    }
}

void contacts_push_out(const ContactFrame *frame, Particles *particles, int32_t begin, int32_t end)
{
    const Colliders *colliders = frame->colliders;
    const uint32_t *rows = frame->grid->block_begin.data;
    for (int32_t block = begin; block < end && colliders->obstacle_count > 0; block++) {
        Book book = {colliders->measures ? (PushNotes *)colliders->impulses.notes.data + block : NULL};
        if (book.notes) {
            book.notes->count = 0;
            book.notes->resume = -1;
        }
        push_block(frame, particles, block, 0, false, rows[block], &book);
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
    if (!array_reserve(memory, &colliders->anchored, (size_t)colliders->obstacle_count, sizeof(Obstacle)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for %d obstacles", colliders->obstacle_count);
    for (int i = 0; i < colliders->obstacle_count; i++) {
        Obstacle *o = (Obstacle *)colliders->anchored.data + i;
        *o = colliders->obstacle[i];
        for (int a = 0; a < frame->grid->dimension; a++) {
            const double anchor = (double)frame->grid->anchor[a] * frame->cell_size;
            o->start.position[a] -= anchor;
            o->end.position[a] -= anchor;
        }
    }
    if (!colliders->measures || array_reserve(memory, &colliders->impulses.notes, blocks, sizeof(PushNotes))) return PBMPM_OK;
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the impulses of %zu blocks", blocks);
}

void contacts_book_push(const ContactFrame *frame, Particles *particles)
{
    const Colliders *colliders = frame->colliders;
    const Book sums = {NULL};
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
        if (notes->resume >= 0) push_block(frame, particles, block, notes->resume, notes->held, notes->row, &sums);
    }
}
