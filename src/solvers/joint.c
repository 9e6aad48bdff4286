#include "solvers/joint.h"

#include <math.h>
#include <string.h>

#include "base/result.h"
#include "contact/contacts_find.h"
#include "contact/wall_bodies.h"
#include "contact/walls.h"
#include "solvers/dual/dual.h"
#include "solvers/moduli.h"
#include "solvers/passes.h"
#include "solvers/primal/primal.h"

enum { W = K_NODE_WIDTH, BLOCK_GRAIN = 8 };

/* Most of c (2 mu + lambda) per square of the iterations. Of what is stiffer the iterations find too little: light bodies of 1e8 Pa burst at 60 Hz x 5. At that rate
 * 20 cells of water press what is held so by less than a hundredth. By trial. */
static const double STIFFEST = 64.0;

/* k over what N iterations hold: sound travels N / 2 cells per substep. What the primal's part compresses the dual brings back in the next substep, which drives a pool.
 * With 1, 2 and 4 pools of 20 cells over a body move at 8 to 10 mm/s in the mean at 60 Hz x 5, with 16 at 42. Of 40 cells they lose 2 to 4 cells with 4, 2 to 11 with 1 and
 * 2. By trial. */
static const float HELD = 4.0f;

double joint_stiffness_share(const World *world, const pbmpm_material_def *def, const Substep *substep)
{
    const double n = (double)world->settings.iterations;
    return fmin(1.0, STIFFEST * n * n / dual_stiffness_of(def, substep));
}

void joint_set_materials(World *world) { dual_set_materials(world); }

static size_t nodes_of(const World *world) { return (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells; }

pbmpm_result joint_prepare(World *world)
{
    JointState *joint = &world->joint;
    const size_t d = (size_t)world->def.dimension;
    if (!array_reserve(&world->memory, &joint->base, nodes_of(world) * W, sizeof(float)) || !array_reserve(&world->memory, &joint->node, nodes_of(world) * W, sizeof(float)) ||
        !array_reserve(&world->memory, &joint->gap, nodes_of(world), sizeof(float)) ||
        !array_reserve(&world->memory, &joint->particle, (1 + d * d) * world->particles.count + K_MAX_GANG, sizeof(float)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the joint solver on %d blocks", world->grid.node_blocks);
    const pbmpm_result result = dual_prepare(world);
    return result == PBMPM_OK ? primal_prepare(world) : result;
}

void joint_free(World *world)
{
    JointState *joint = &world->joint;
    Array *arrays[] = {&joint->contact, &joint->contact_begin, &joint->base, &joint->node, &joint->particle, &joint->gap};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) array_free(&world->memory, arrays[i]);
}

/* ---- Contacts of the primal's parts ---- */

/* Puts them in the place of the dual's, or back. */
static void exchange_contacts(World *world)
{
    Colliders *colliders = &world->colliders;
    JointState *joint = &world->joint;
    const Array contact = colliders->contact, begin = colliders->contact_begin;
    const uint32_t contacts = colliders->contacts;
    colliders->contact = joint->contact;
    colliders->contact_begin = joint->contact_begin;
    colliders->contacts = joint->contacts;
    joint->contact = contact;
    joint->contact_begin = begin;
    joint->contacts = contacts;
}

pbmpm_result joint_find_contacts(World *world, const ContactFrame *contacts)
{
    ContactFrame frame = *contacts;
    frame.walls = NULL;
    frame.leaders = &world->walls;
    exchange_contacts(world);
    pbmpm_result result = contacts_find(&frame, &world->memory, world->pool);
    if (result == PBMPM_OK) result = primal_list_followers(world);
    exchange_contacts(world);
    return result;
}

/* Does something to each contact whose node stays. */
static void for_staying(World *world, void (*act)(const World *world, Contact *contact, size_t at))
{
    const uint32_t *begin = world->colliders.contact_begin.data;
    for (int32_t block = 0; block < world->grid.node_blocks && world->colliders.contacts > 0; block++)
        for (uint32_t i = begin[block]; i < begin[block + 1]; i++) {
            Contact *contact = (Contact *)world->colliders.contact.data + i;
            if (contact->stays) act(world, contact, ((size_t)block * (size_t)world->grid.block_cells + contact->node) * W);
        }
}

static void stay_here(const World *world, Contact *contact, size_t at)
{
    memcpy(contact->surface, (const float *)world->grid.node.data + at, sizeof contact->surface);
}

/* ---- The sketch ---- */

typedef void BlockPass(World *world, int32_t block, size_t begin, size_t end);

typedef struct PassJob {
    World *world;
    BlockPass *pass;
} PassJob;

static void run_pass(void *context, int32_t begin, int32_t end)
{
    const PassJob *job = context;
    const size_t floats = (size_t)job->world->grid.block_cells * W;
    for (int32_t block = begin; block < end; block++) job->pass(job->world, block, (size_t)block * floats, ((size_t)block + 1) * floats);
}

static void over_blocks(World *world, BlockPass *pass)
{
    PassJob job = {world, pass};
    pool_for(world->pool, world->grid.node_blocks, BLOCK_GRAIN, run_pass, &job);
}

/* Whether nothing holds the group: seen from what falls along, there is no gravity. */
static bool falls_freely(const World *world) { return world->joint.contacts == 0 && !walls_any(&world->walls); }

/* Solids start as they were moving: pressed by the liquid but without their own stress they would be far off. */
static void start_solids(World *world, int32_t block, size_t begin, size_t end)
{
    const uint64_t *solid = world->colliders.solid.data;
    const float held = falls_freely(world) ? 0.0f : 1.0f;
    float *node = world->grid.node.data, *before = world->joint.node.data;
    memcpy(before + begin, node + begin, (end - begin) * sizeof *node);
    for (size_t i = begin; i < end; i += W)
        for (size_t c = 0; c < 3 && solid[block] >> (i - begin) / W & 1; c++)
            node[i + c] = node[i + 3] > 0.0f ? world->args.grid.node_before[i + c] - held * world->args.gravity[c] : 0.0f;
}

/* A body whose sketch gained energy goes where the push of the pressures leads. */
static void leave_sketch(World *world, int32_t block, size_t begin, size_t end)
{
    if (primal_sketch_gained(world, block)) memcpy((float *)world->grid.node.data + begin, (const float *)world->joint.node.data + begin, (end - begin) * sizeof(float));
}

static void move_predictor(World *world, int32_t block, size_t begin, size_t end)
{
    const float *node = world->grid.node.data, *before = world->joint.node.data;
    float *base = world->grid.node_base.data, *kept = world->joint.base.data;
    (void)block;
    memcpy(kept + begin, base + begin, (end - begin) * sizeof *base);
    for (size_t i = begin; i < end; i++)
        if (i % W != 3) base[i] += node[i] - before[i];
}

/* What a node that stayed gets of the impulse that the liquid's k has for it. Let go, a spring gives its mass the velocity r / omega of a force r within the substep if
 * omega > 1, not r: more would be more than its energy. omega^2 = k sum_p m_p 4 (w x_a)^2 / sum_p m_p w along an axis a, in full cells 43/140 by a, 11/20 by each other
 * axis (the integrals of 4 w^2 x^2 and of w^2). With all of it stiff discs in water gained a thousandfold at 30 Hz x 20. */
static float released_share(const World *world)
{
    const double omega2 = (double)world->args.primal.held_stiffness * 43.0 / 140.0 * pow(11.0 / 20.0, world->def.dimension - 1);
    return (float)(1.0 / sqrt(fmax(1.0, omega2)));
}

/* Nodes that stay feel the force m (u - u*) - gradient. The dual knows a part of it: its own push. */
static void push_staying(const World *world, Contact *contact, size_t at)
{
    const float *u = (const float *)world->grid.node.data + at, *gradient = primal_gradient(world) + at;
    const float share = released_share(world);
    float *base = (float *)world->grid.node_base.data + at;
    if (contact->follows) return; /* its parents got its part */
    if (primal_sketch_gained(world, (int32_t)(at / W / (size_t)world->grid.block_cells))) return;
    for (size_t c = 0; c < 3 && base[3] > 0.0f; c++) base[c] += share * ((u[c] - base[c]) - (gradient[c] + world->args.dual.node_push[at + c]) / base[3]);
}

/* As stiff as the primal holds them among liquid. */
static void set_solids(World *world)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (world->materials.generation[slot] != 0 && world->materials.kernel[slot].kind != K_LIQUID)
            moduli_set_solid(world, slot, joint_stiffness_share(world, &world->materials.def[slot], &world->substep));
}

static void begin_primal(World *world)
{
    exchange_contacts(world);
    for_staying(world, stay_here);
    set_solids(world);
    solver_over_particles(world, world->kernels->hold_pressure);
}

static void sketch(World *world, const ContactFrame *contacts)
{
    primal_note_followers(world);
    over_blocks(world, start_solids);
    begin_primal(world);
    if (primal_sketch(world, contacts) > 0) over_blocks(world, leave_sketch);
    solver_over_particles(world, world->kernels->end_sketch);
    over_blocks(world, move_predictor);
    for_staying(world, push_staying);
    exchange_contacts(world);
    dual_set_solids(world);
}

/* ---- The substep ---- */

/* Of nodes that a solid reaches; a liquid's surface elsewhere is none. */
static void find_gaps(World *world, int32_t block, size_t begin, size_t end)
{
    const uint64_t *solid = world->colliders.solid.data;
    const float *volume = world->grid.node_volume.data;
    float *gap = world->joint.gap.data;
    for (size_t i = begin / W; i < end / W; i++) gap[i] = solid[block] >> (i - begin / W) & 1 ? fmaxf(0.0f, 1.0f - volume[i]) : 0.0f;
}

static void bind(World *world)
{
    if (world->args.grid.node_volume) {
        over_blocks(world, find_gaps);
        world->args.primal.node_gap = world->joint.gap.data;
    }
    const size_t count = world->particles.count, d = (size_t)world->def.dimension;
    float *array = world->joint.particle.data;
    world->args.primal.held_stiffness = HELD * primal_stiffest(world->settings.iterations);
    world->args.primal.held_pressure = array;
    for (size_t r = 0; r < d; r++)
        for (size_t c = 0; c < d; c++) world->args.primal.sketch[r * 3 + c] = array + (1 + r * d + c) * count;
}

/* What ended both; residual and error are the primal's, for it goes on from what the dual left of solids. */
static void note_dual(StepRecord *record, const StepRecord *dual)
{
    if (record->stop == PBMPM_STOP_ERROR || dual->stop == PBMPM_STOP_TIME) record->stop = dual->stop;
    record->iterations_used = dual->iterations_used > record->iterations_used ? dual->iterations_used : record->iterations_used;
}

void joint_solve(World *world, const ContactFrame *contacts)
{
    const size_t bytes = nodes_of(world) * W * sizeof(float);
    bind(world);
    dual_solve_with(world, contacts, sketch);
    const StepRecord dual = world->record;
    memcpy(world->grid.node_base.data, world->joint.base.data, bytes);
    world->record.iterations_used = 0;
    primal_note_followers(world);
    begin_primal(world);
    wall_bodies_keep(&world->walls, contacts);
    walls_clear(&world->walls); /* contacts book what they give */
    primal_solve(world, contacts);
    note_dual(&world->record, &dual);
}
