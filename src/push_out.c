/* Particles that ended inside an obstacle, and what putting them back gives it. */
#include <math.h>

#include "colliders.h"
#include "result.h"

/* A particle is moved to the surface at once out of a wall, and at most a cell per substep out of anything else, so that an
 * obstacle that lands on matter does not fling it. Its velocity into the surface is taken away. */
static void push_particle(const ContactFrame *frame, const Obstacle *o, Particles *p, uint32_t row, float dt, ImpulseSum *sum)
{
    double point[3] = {0}, normal[3];
    for (int a = 0; a < p->dimension; a++) point[a] = particles_coordinate(p, row, a) * frame->cell_size;
    double depth = -solid_distance(&o->end, point, normal) / frame->cell_size;
    if (depth <= 0.0) return;
    if (!o->wall) depth = fmin(depth, 1.0);
    float surface[3];
    double way[3], gained[3] = {0}, inward = 0.0;
    obstacle_motion(o, point, frame->cell_size, frame->max_displacement, surface);
    const double to_velocity = frame->cell_size / (double)dt;
    for (int a = 0; a < p->dimension; a++) {
        way[a] = depth * normal[a];
        inward += (p->velocity[a][row] - surface[a] * to_velocity) * normal[a];
    }
    particles_shift(p, row, way);
    particles_forget(p, row);
    const double mass = (double)p->mass[row] * pow(frame->cell_size, p->dimension);
    for (int a = 0; a < p->dimension && inward < 0.0; a++) {
        const float before = p->velocity[a][row];
        p->velocity[a][row] -= (float)(inward * normal[a]);
        gained[a] = mass * ((double)p->velocity[a][row] - (double)before);
        point[a] += way[a] * frame->cell_size;
    }
    if (sum && inward < 0.0) impulse_add(sum, point, gained);
}

static bool is_near(const ContactFrame *frame, const Obstacle *o, int32_t block)
{
    double centre[3];
    contacts_block_centre(frame, block, centre);
    const double half_diagonal = 0.5 * K_BLOCK_AXIS * sqrt((double)frame->grid->dimension);
    return solid_least(&o->end, centre) / frame->cell_size <= half_diagonal + (double)((const float *)frame->grid->travel.data)[block];
}

static void push_block(const ContactFrame *frame, const Obstacle *o, Particles *particles, float dt, int32_t block, ImpulseSum *sum)
{
    const uint32_t *begin = frame->grid->block_begin.data;
    for (uint32_t row = begin[block]; row < begin[block + 1]; row++)
        if (particles->status[row] == K_ALIVE) push_particle(frame, o, particles, row, dt, sum);
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
