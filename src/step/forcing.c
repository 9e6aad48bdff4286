#include "step/forcing.h"

#include <math.h>
#include <string.h>

#include "base/result.h"

enum { BLOCK_GRAIN = 8 };

/* What one force did to the nodes of one block. */
typedef struct ForceShare {
    double impulse[3]; /* [kg m/s] */
    double nodes;
} ForceShare;

static bool is_drag(const pbmpm_force_def *def) { return def->kind == PBMPM_FORCE_DRAG || def->kind == PBMPM_FORCE_GRAB; }

/* ---- At a point ---- */

/* See pbmpm_falloff. `point` in metres. */
static double share_at(const Force *force, const double point[3])
{
    const pbmpm_force_def *def = &force->def;
    double normal[3];
    if (def->everywhere) return 1.0;
    const double distance = solid_distance(&force->solid, point, normal), range = (double)def->range;
    if (distance <= 0.0) return 1.0;
    const double part = distance / range; /* infinite if the range is 0 */
    switch (def->falloff) {
    case PBMPM_FALLOFF_LINEAR: return fmax(0.0, 1.0 - part);
    case PBMPM_FALLOFF_SMOOTH: return part < 1.0 ? (1.0 - part * part) * (1.0 - part * part) : 0.0;
    case PBMPM_FALLOFF_INVERSE_SQUARE: return 1.0 / ((1.0 + part) * (1.0 + part));
    case PBMPM_FALLOFF_NONE:
    case PBMPM_FALLOFF_FORCE32: break;
    }
    return distance <= range ? 1.0 : 0.0;
}

/* n cross r, r from the centre to the point. */
static void around_axis(const Force *force, const double point[3], double out[3])
{
    double r[3];
    for (int a = 0; a < 3; a++) r[a] = point[a] - force->solid.position[a];
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        out[a] = force->axis[b] * r[c] - force->axis[c] * r[b];
    }
}

static void acceleration_at(const Force *force, const double point[3], double share, double cell_size, double out[3])
{
    double way[3], length = 0.0;
    const double strength = (double)force->def.strength * share;
    if (force->def.kind == PBMPM_FORCE_UNIFORM) {
        for (int a = 0; a < 3; a++) out[a] = strength * force->axis[a];
        return;
    }
    around_axis(force, point, way);
    for (int a = 0; a < 3; a++) {
        if (force->def.kind == PBMPM_FORCE_RADIAL) way[a] = point[a] - force->solid.position[a];
        length += way[a] * way[a];
    }
    for (int a = 0; a < 3; a++) out[a] = strength * way[a] / fmax(sqrt(length), cell_size);
}

static void wind_at(const Force *force, const double point[3], double out[3])
{
    double turning[3];
    around_axis(force, point, turning);
    for (int a = 0; a < 3; a++) out[a] = (double)force->def.velocity[a] + (double)force->def.spin * turning[a];
    if (force->solid.dimension == 2) out[2] = 0.0;
}

/* k dt where it is infinite: what is left of a velocity is then 0, and of an acceleration a billionth. */
static const double INFINITE_DRAG = 1e9;

static double drag_at(const Force *force, double share, const Substep *substep)
{
    const double rate = force->def.kind == PBMPM_FORCE_DRAG ? (double)force->def.strength * share : -REFERENCE_RATE * log1p(-share);
    return fmin(rate * substep->dt, INFINITE_DRAG);
}

/* ---- At a node ---- */

/* The forces that reach a block. */
typedef struct Reaching {
    int count;
    int place[PBMPM_MAX_FORCES]; /* among those that are on */
    const Force *force[PBMPM_MAX_FORCES];
} Reaching;

/* What they do at one node, as velocities: changes over the substep [m/s]. */
typedef struct Felt {
    double share[PBMPM_MAX_FORCES];
    double change[PBMPM_MAX_FORCES][3]; /* accelerations: a dt; drags: the wind w */
    double drag[PBMPM_MAX_FORCES];      /* k dt; 0 for accelerations */
    double acceleration[3];             /* sum of a dt */
    double total_drag, wind[3];         /* sum of k dt; mean of w */
    bool any;
} Felt;

static void feel(const World *world, const Reaching *reaching, const double point[3], Felt *felt)
{
    const Substep *substep = &world->substep;
    felt->any = false;
    felt->total_drag = 0.0;
    for (int a = 0; a < 3; a++) felt->acceleration[a] = felt->wind[a] = 0.0;
    for (int i = 0; i < reaching->count; i++) {
        const Force *force = reaching->force[i];
        const double share = felt->share[i] = share_at(force, point);
        felt->drag[i] = 0.0;
        if (share == 0.0) continue;
        felt->any = true;
        if (is_drag(&force->def)) {
            wind_at(force, point, felt->change[i]);
            felt->drag[i] = drag_at(force, share, substep);
            felt->total_drag += felt->drag[i];
            for (int a = 0; a < 3; a++) felt->wind[a] += felt->drag[i] * felt->change[i][a];
            continue;
        }
        acceleration_at(force, point, share, (double)world->def.cell_size, felt->change[i]);
        for (int a = 0; a < 3; a++) felt->acceleration[a] += felt->change[i][a] *= substep->dt;
    }
    for (int a = 0; a < 3 && felt->total_drag > 0.0; a++) felt->wind[a] /= felt->total_drag;
}

/* The impulse of each force on a node of the mass m that gained `gained` besides gravity: an acceleration's is m a dt. That of a
 * drag is -m k_i times the integral of v - w_i. As v' = a - k (v - w), k times the integral of v - w is a dt - gained, with gravity
 * in both a dt and gained; so with k_i = share k it is m (share (gained - a dt) + k_i dt (w_i - w)). Hands of infinite k that want different things would
 * pull with infinite forces, whose sum is 0: the last term does not count. */
static void add_impulses(const Reaching *reaching, const Felt *felt, const double gained[3], double mass, ForceShare *shares)
{
    int drags = 0;
    for (int i = 0; i < reaching->count; i++) drags += felt->drag[i] > 0.0;
    for (int i = 0; i < reaching->count; i++) {
        ForceShare *out = &shares[reaching->place[i]];
        if (felt->share[i] == 0.0) continue;
        out->nodes += 1.0;
        for (int a = 0; a < 3; a++) {
            double part = is_drag(&reaching->force[i]->def) ? 0.0 : felt->change[i][a];
            if (felt->drag[i] > 0.0) part = felt->drag[i] / felt->total_drag * (gained[a] - felt->acceleration[a]);
            if (felt->drag[i] > 0.0 && drags > 1 && felt->total_drag < INFINITE_DRAG) part += felt->drag[i] * (felt->change[i][a] - felt->wind[a]);
            out->impulse[a] += mass * part;
        }
    }
}

typedef struct ForceJob {
    World *world;
    const Force *force[PBMPM_MAX_FORCES]; /* that are on */
    uint32_t on;
} ForceJob;

/* The displacement of a node in the predictor [cells], changed by what it feels; see pbmpm_force_def. `pull`: of gravity. */
static void change_node(const ForceJob *job, const Felt *felt, float *u, double gained[3])
{
    const double drag = felt->total_drag, lost = -expm1(-drag), to_velocity = job->world->substep.to_velocity, to_cells = 1.0 / to_velocity;
    for (int a = 0; a < job->world->def.dimension; a++) {
        const double pull = (double)job->world->args.gravity[a], before = (double)u[a];
        if (drag == 0.0) {
            u[a] += (float)(felt->acceleration[a] * to_cells);
        } else {
            const double free = before - pull, pushed = pull + felt->acceleration[a] * to_cells;
            u[a] = (float)(free + (felt->wind[a] * to_cells - free) * lost + pushed * (lost / drag));
        }
        u[a] = fmaxf(-K_INCREMENT_MAX, fminf(K_INCREMENT_MAX, u[a]));
        gained[a] = ((double)u[a] - before) * to_velocity;
    }
}

/* ---- Over blocks ---- */

static double block_distance(const World *world, const Force *force, const double corner[3])
{
    double centre[3] = {0};
    for (int a = 0; a < world->def.dimension; a++) centre[a] = corner[a] + 0.5 * (K_BLOCK_AXIS - 1) * (double)world->def.cell_size;
    const double half_diagonal = 0.5 * (K_BLOCK_AXIS - 1) * sqrt((double)world->def.dimension) * (double)world->def.cell_size;
    return solid_gap(&force->solid, centre) - half_diagonal;
}

static Reaching reaching_block(const ForceJob *job, const double corner[3])
{
    Reaching reaching = {.count = 0};
    for (uint32_t i = 0; i < job->on; i++) {
        const double reach = force_reach(job->force[i]);
        if (reach < INFINITY && block_distance(job->world, job->force[i], corner) > reach) continue;
        reaching.place[reaching.count] = (int)i;
        reaching.force[reaching.count++] = job->force[i];
    }
    return reaching;
}

/* Returns which nodes are held, as Forces.held says. */
static uint64_t change_block(const ForceJob *job, int32_t block, const double corner[3], const Reaching *reaching, ForceShare *shares)
{
    uint64_t held = 0;
    const World *world = job->world;
    const double dx = (double)world->def.cell_size;
    const size_t first = (size_t)block * (size_t)world->grid.block_cells * K_NODE_WIDTH;
    float *node = (float *)world->grid.node.data + first, reach = 0.0f;
    for (int i = 0; i < world->grid.block_cells; i++) {
        float *u = node + i * K_NODE_WIDTH;
        const double local[3] = {i & 3, i >> 2 & 3, i >> 4};
        double point[3] = {0}, gained[3] = {0};
        Felt felt;
        if (u[3] == 0.0f) continue;
        for (int a = 0; a < world->def.dimension; a++) point[a] = corner[a] + local[a] * dx;
        feel(world, reaching, point, &felt);
        held |= (uint64_t)(felt.total_drag >= INFINITE_DRAG) << i;
        if (felt.any) {
            change_node(job, &felt, u, gained);
            add_impulses(reaching, &felt, gained, (double)u[3] * world_cell_volume(world), shares);
        }
        for (int a = 0; a < world->def.dimension; a++) reach = fmaxf(reach, fabsf(u[a]));
    }
    ((float *)world->grid.node_reach.data)[block] = reach;
    if (world->args.grid.node_base) memcpy(world->args.grid.node_base + first, node, (size_t)world->grid.block_cells * K_NODE_WIDTH * sizeof(float));
    return held;
}

static void block_corner(const World *world, int32_t block, double corner[3])
{
    const int32_t *place = (const int32_t *)world->grid.coordinate.data + 3 * block;
    for (int a = 0; a < 3; a++)
        corner[a] = a < world->grid.dimension ? (double)(world->grid.anchor[a] + place[a] * K_BLOCK_AXIS) * (double)world->def.cell_size : 0.0;
}

static void change_blocks(void *context, int32_t begin, int32_t end)
{
    const ForceJob *job = context;
    ForceShare *shares = job->world->forces.share.data;
    uint64_t *held = job->world->forces.held;
    for (int32_t block = begin; block < end; block++) {
        double corner[3];
        ForceShare *own = shares + (size_t)block * job->on;
        memset(own, 0, job->on * sizeof *own);
        block_corner(job->world, block, corner);
        const Reaching reaching = reaching_block(job, corner);
        held[block] = reaching.count ? change_block(job, block, corner, &reaching, own) : 0;
    }
}

static pbmpm_result take_memory(World *world, uint32_t on, size_t floats, bool keep)
{
    Forces *forces = &world->forces;
    const size_t blocks = (size_t)world->grid.node_blocks, shares = blocks * on * sizeof(ForceShare);
    if (array_reserve(&world->memory, &forces->share, shares + blocks * sizeof(uint64_t), 1) &&
        (!keep || array_reserve(&world->memory, &forces->before, floats, sizeof(float)))) {
        forces->held = (uint64_t *)((char *)forces->share.data + shares);
        return PBMPM_OK;
    }
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the forces on %d blocks", world->grid.node_blocks);
}

static uint32_t forces_that_are_on(World *world, ForceJob *job)
{
    Forces *forces = &world->forces;
    *job = (ForceJob){.world = world};
    for (uint32_t slot = 0; slot < forces->used; slot++)
        if (forces->slot[slot].generation != 0 && forces->slot[slot].def.enabled) job->force[job->on++] = &forces->slot[slot];
    return job->on;
}

pbmpm_result forces_apply(World *world)
{
    Forces *forces = &world->forces;
    ForceJob job;
    forces->on = forces_that_are_on(world, &job);
    forces->holds = false;
    if (job.on == 0) return PBMPM_OK;
    const size_t floats = (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells * K_NODE_WIDTH;
    const bool keep = world->args.grid.node_base != NULL;
    const pbmpm_result result = take_memory(world, job.on, floats, keep);
    if (result != PBMPM_OK) return result;
    if (keep) {
        memcpy(forces->before.data, world->args.grid.node_base, floats * sizeof(float));
        world->args.grid.node_before = forces->before.data;
    }
    pool_for(world->pool, world->grid.node_blocks, BLOCK_GRAIN, change_blocks, &job);
    for (int32_t block = 0; block < world->grid.node_blocks; block++) forces->holds = forces->holds || forces->held[block];
    return PBMPM_OK;
}

/* ---- Accounts ---- */

/* What the solution took from or gave to the nodes that a block's grabs hold. Grabs that hold the same node bear it alike, as they share its wind. */
static void account_held(World *world, const ForceJob *job, const ContactFrame *contacts, int32_t block)
{
    ForceShare *shares = (ForceShare *)world->forces.share.data + (size_t)block * job->on;
    double corner[3];
    block_corner(world, block, corner);
    const Reaching reaching = reaching_block(job, corner);
    for (int i = 0; i < world->grid.block_cells; i++) {
        double point[3], gained[3], share[PBMPM_MAX_FORCES], all = 0.0;
        if (!contacts_held_gain(contacts, block, i, gained)) continue;
        contacts_node_position(contacts, block, i, point);
        for (int k = 0; k < reaching.count; k++) {
            const Force *force = reaching.force[k];
            const bool holds = is_drag(&force->def) && drag_at(force, share_at(force, point), &world->substep) >= INFINITE_DRAG;
            all += share[k] = holds ? 1.0 : 0.0;
        }
        for (int k = 0; k < reaching.count && all > 0.0; k++)
            for (int a = 0; a < 3; a++) shares[reaching.place[k]].impulse[a] += share[k] / all * gained[a];
    }
}

void forces_account(World *world, const ContactFrame *contacts)
{
    Forces *forces = &world->forces;
    const int32_t node_blocks = world->grid.node_blocks;
    const uint64_t *held = forces->held;
    ForceJob job;
    if (forces->holds && forces_that_are_on(world, &job))
        for (int32_t block = 0; block < node_blocks; block++)
            if (held[block]) account_held(world, &job, contacts, block);
    const ForceShare *shares = forces->share.data;
    uint32_t place = 0;
    for (uint32_t slot = 0; slot < forces->used && forces->on; slot++) {
        Force *force = &forces->slot[slot];
        if (force->generation == 0 || !force->def.enabled) continue;
        double nodes = 0.0;
        for (int32_t block = 0; block < node_blocks; block++) {
            const ForceShare *share = &shares[(size_t)block * forces->on + place];
            nodes += share->nodes;
            for (int a = 0; a < 3; a++) force->impulse[a] += share->impulse[a];
        }
        force->nodes += (uint32_t)nodes;
        place++;
    }
}
