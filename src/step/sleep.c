/* Who sleeps in a substep. */
#include "step/sleep.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/result.h"
#include "grid/build.h"
#include "solvers/passes.h"
#include "world/sleep_rows.h"
#include "world/sleep_wake.h"
#include "world/sleep_waves.h"

/* ---- Beginning and ending ---- */

void sleep_begin_step(World *world)
{
    const double dt = world->substep.dt;
    Sleep *sleep = &world->sleep;
    static const double SAME = 1.1; /* factor between lengths of substeps with which matter at rest stays at rest; by trial */
    if (!world->settings.sleeping) {
        if (sleep->on) sleep_end(sleep);
        return;
    }
    if (!sleep->on) sleep->dt = dt;
    sleep->on = true;
    if (dt > SAME * sleep->dt || sleep->dt > SAME * dt) {
        sleep_wake_all(world);
        sleep->dt = dt;
    }
}

/* ---- Deciding ---- */

/* A block may take in this share of its particles while it sleeps: slow ones that come over from a neighbour. By trial. */
static const uint32_t JOINED_MOST = 16;

typedef struct Decision {
    World *world;
    Sleep *sleep;
    float speed2;
    int32_t corner[3]; /* place of the grid's anchor */
    uint32_t rows;     /* first row that was in the grid when it was decided */
    SleepBlock *next;  /* per block in order of discovery */
    float *loud;       /* the same: 1: its particles are not at rest */
} Decision;

static FoundBlock *found_block(const World *world, uint32_t i) { return (FoundBlock *)world->grid.found.data + i; }

/* The lattice stands as the first blocks did, so a scene that is shifted by whole cells sleeps the same. */
static bool drop_anchor(World *world, int32_t anchor[3])
{
    Sleep *sleep = &world->sleep;
    const Particles *p = &world->particles;
    bool any = sleep->rows < p->count;
    anchor[2] = 0;
    for (int a = 0; a < p->dimension; a++) {
        int32_t lowest = INT32_MAX;
        for (uint32_t i = sleep->rows; i < p->count; i++) lowest = p->cell[a][i] < lowest ? p->cell[a][i] : lowest;
        if (!sleep->phased) sleep->phase[a] = lowest & (K_BLOCK_AXIS - 1);
        for (uint32_t i = 0; i < sleep->active.count; i++) {
            const int32_t cell = sleep_list_block(&sleep->active, i)->place[a] * K_BLOCK_AXIS + sleep->phase[a];
            lowest = cell < lowest ? cell : lowest;
        }
        /* Neighbours that are called come from the block before, and touch the one before that. */
        anchor[a] = lowest - ((lowest - sleep->phase[a]) & (K_BLOCK_AXIS - 1)) - 2 * K_BLOCK_AXIS;
    }
    any = any || sleep->active.count > 0;
    sleep->phased = sleep->phased || any;
    return any;
}

/* Sums and the largest of the squared speeds of the particles of each block; the latter go to `loud`. */
static void measure_speeds(const Decision *d, uint32_t blocks)
{
    const Particles *p = &d->world->particles;
    for (uint32_t f = 0; f < blocks; f++) d->next[f].quiet = d->loud[f] = 0.0f;
    for (uint32_t row = d->rows; row < p->count; row++) {
        const int32_t f = d->world->grid.block_of[row];
        float speed2 = 0.0f;
        for (int a = 0; a < p->dimension; a++) speed2 += p->velocity[a][row] * p->velocity[a][row];
        d->next[f].quiet += speed2;
        d->loud[f] = speed2 <= d->loud[f] ? d->loud[f] : speed2; /* a NaN stays */
    }
}

/* Whether a block that slept in the last substep does so in this one. */
static bool sleeps_on(const Decision *d, const SleepBlock *before, SleepBlock *now, float fastest2)
{
    if (before->stage == SLEEP_AWAKE || now->rows < before->rows) return false;
    now->joined = before->joined + (now->rows - before->rows);
    return fastest2 <= d->speed2 && now->joined * JOINED_MOST <= now->rows;
}

/* Blocks as the last substep left them, and what has come into them since. */
static void look_back(const Decision *d, uint32_t blocks)
{
    for (uint32_t f = 0; f < blocks; f++) {
        const FoundBlock *found = found_block(d->world, f);
        SleepBlock *now = &d->next[f];
        const float sum2 = now->quiet, fastest2 = d->loud[f];
        *now = (SleepBlock){.stage = SLEEP_AWAKE, .rows = found->particles};
        for (int a = 0; a < 3; a++) now->place[a] = d->corner[a] + found->coordinate[a];
        SleepBlock *bed = sleep_list_find(&d->sleep->asleep, now->place);
        const SleepBlock *before = sleep_list_find(&d->sleep->active, now->place);
        d->loud[f] = !(sum2 < d->speed2 * (float)now->rows);
        now->moved = fastest2 != 0.0f;
        now->disturbed = d->loud[f] != 0.0f || (before && before->disturbed);
        if (bed) { /* something came into a block that was asleep, or was put there */
            bed->woken = 1;
            d->sleep->woken_blocks++;
        } else if (before && sleeps_on(d, before, now, fastest2)) {
            now->stage = SLEEP_DROWSY;
            memcpy(now->gained, before->gained, sizeof now->gained);
        } else if (before) {
            now->joined = 0;
            now->quiet = before->stage == SLEEP_AWAKE ? before->quiet : 0.0f;
            d->sleep->woken_blocks += before->stage != SLEEP_AWAKE;
        }
    }
}

/* The neighbour of a place, as it is counted in the grid. */
static FoundBlock *neighbour_of(const Decision *d, const int32_t place[3], int n, int32_t there[3])
{
    int32_t inside[3];
    grid_neighbour_offset(n, d->world->def.dimension, there);
    for (int a = 0; a < 3; a++) {
        there[a] += place[a];
        inside[a] = there[a] - d->corner[a];
    }
    return grid_found(&d->world->grid, inside);
}

static uint32_t index_of(const Decision *d, const FoundBlock *found) { return (uint32_t)(found - found_block(d->world, 0)); }

static bool is_quiet_around(const Decision *d, const SleepBlock *block)
{
    for (int n = 0; n < d->world->grid.neighbours; n++) {
        int32_t there[3];
        const FoundBlock *found = neighbour_of(d, block->place, n, there);
        if (found && d->loud[index_of(d, found)] != 0.0f) return false;
    }
    return true;
}

static void fall_asleep(const Decision *d, uint32_t blocks)
{
    for (uint32_t f = 0; f < blocks; f++) {
        SleepBlock *block = &d->next[f];
        if (block->stage != SLEEP_AWAKE) continue;
        block->quiet = is_quiet_around(d, block) ? block->quiet + (float)d->world->substep.dt : 0.0f;
        if (!(block->quiet > d->world->settings.sleep_time) || sleep_is_measured(d->world, block->place)) continue;
        block->stage = SLEEP_DROWSY;
        block->moved = 1;
    }
}

/* What an awake block does to one of its neighbours: `found` is the neighbour if it is in the grid. */
typedef void Touch(const Decision *d, const int32_t there[3], FoundBlock *found);

static void touch_around(const Decision *d, const int32_t place[3], Touch *touch)
{
    for (int n = 0; n < d->world->grid.neighbours; n++) {
        int32_t there[3];
        FoundBlock *found = neighbour_of(d, place, n, there);
        touch(d, there, found);
    }
}

/* Around blocks that are awake, and around those that were and are empty now. */
static void touch_all(const Decision *d, uint32_t blocks, Touch *touch)
{
    for (uint32_t f = 0; f < blocks; f++)
        if (d->next[f].stage == SLEEP_AWAKE) touch_around(d, d->next[f].place, touch);
    for (uint32_t i = 0; i < d->sleep->active.count; i++) {
        const SleepBlock *before = sleep_list_block(&d->sleep->active, i);
        int32_t inside[3];
        for (int a = 0; a < 3; a++) inside[a] = before->place[a] - d->corner[a];
        if (before->stage == SLEEP_AWAKE && !grid_found(&d->world->grid, inside)) touch_around(d, before->place, touch);
    }
}

static void call(const Decision *d, const int32_t there[3], FoundBlock *found)
{
    SleepBlock *bed = sleep_list_find(&d->sleep->asleep, there);
    if (!bed || bed->woken) return;
    bed->stage = SLEEP_DROWSY;
    (void)found;
}

static void keep(const Decision *d, const int32_t there[3], FoundBlock *found)
{
    (void)there;
    if (found && d->next[index_of(d, found)].stage != SLEEP_AWAKE) found->rank = GRID_STILL;
}

static void rank(const Decision *d, uint32_t blocks)
{
    for (uint32_t f = 0; f < blocks; f++)
        found_block(d->world, f)->rank = d->next[f].stage == SLEEP_AWAKE ? GRID_MOVING : GRID_LEAVING;
    touch_all(d, blocks, keep);
}

/* ---- Building ---- */

/* Brings those that were called into the grid. False: no memory. */
static bool bring_in(const Decision *d, uint32_t blocks)
{
    World *world = d->world;
    touch_all(d, blocks, call);
    sleep_take_out(world);
    if (!grid_add_rows(&world->grid, &world->memory, &world->particles, d->sleep->rows, d->rows)) return false;
    for (uint32_t f = blocks; f < world->grid.found_count; f++) {
        SleepBlock *block = &d->next[f];
        *block = (SleepBlock){.stage = SLEEP_DROWSY, .rows = found_block(world, f)->particles};
        for (int a = 0; a < 3; a++) block->place[a] = d->corner[a] + found_block(world, f)->coordinate[a];
        const SleepBlock *before = sleep_list_find(&d->sleep->active, block->place);
        block->joined = before ? before->joined : 0;
    }
    for (uint32_t f = 0; f < blocks; f++) d->next[f].rows = found_block(world, f)->particles;
    return true;
}

static void lay_down(World *world, int32_t block)
{
    Particles *p = &world->particles;
    const uint32_t *begin = world->grid.block_begin.data;
    for (uint32_t row = begin[block]; row < begin[block + 1]; row++) {
        particles_forget(p, row);
        for (int a = 0; a < p->dimension; a++) {
            p->velocity[a][row] = 0.0f;
            for (int c = 0; c < p->dimension; c++) p->affine[a * 3 + c][row] = 0.0f;
        }
    }
}

/* The blocks of the grid become the active ones. */
static void commit(const Decision *d, uint32_t blocks)
{
    World *world = d->world;
    Sleep *sleep = d->sleep;
    const uint32_t *begin = world->grid.block_begin.data;
    sleep->active.count = (uint32_t)world->grid.particle_blocks;
    for (uint32_t f = 0; f < blocks; f++) {
        const FoundBlock *found = found_block(world, f);
        if (found->particles == 0) continue; /* they all fly */
        SleepBlock *block = sleep_list_block(&sleep->active, (uint32_t)found->index);
        *block = d->next[f];
        block->rows = found->particles;
        if (block->stage != SLEEP_AWAKE) block->stage = found->rank == GRID_LEAVING ? SLEEP_LEAVING : SLEEP_DROWSY;
        if (block->stage != SLEEP_AWAKE && block->moved) lay_down(world, found->index);
        block->moved = 0;
    }
    sleep->still_rows = begin[world->grid.still_blocks] - sleep->rows;
    sleep->still_blocks = (uint32_t)world->grid.still_blocks;
    sleep_list_index(&sleep->active);
}

/* Bits of the nodes that a block's neighbour at this offset has in common with it. */
static uint64_t common_nodes(const Grid *grid, const int32_t offset[3])
{
    uint64_t bits = 0;
    for (int i = 0; i < grid->block_cells; i++) {
        const int local[3] = {i & 3, i >> 2 & 3, i >> 4};
        bool common = true;
        for (int a = 0; a < grid->dimension; a++)
            common = common && (offset[a] == 0 || local[a] == (offset[a] < 0 ? 0 : K_BLOCK_AXIS - 1));
        bits |= (uint64_t)common << i;
    }
    return bits;
}

static void hold_nodes(const Decision *d)
{
    const Grid *grid = &d->world->grid;
    uint64_t common[27], *held = d->sleep->held.data;
    int32_t offset[27][3];
    for (int n = 0; n < grid->neighbours; n++) {
        grid_neighbour_offset(n, grid->dimension, offset[n]);
        common[n] = common_nodes(grid, offset[n]);
    }
    d->sleep->holds = false;
    for (int32_t b = 0; b < grid->node_blocks && d->sleep->rows > 0; b++) {
        const int32_t *own = (const int32_t *)grid->coordinate.data + 3 * b;
        held[b] = 0;
        for (int n = 0; n < grid->neighbours; n++) {
            const int32_t other = ((const int32_t *)grid->neighbour.data)[b * grid->neighbours + n];
            int32_t there[3];
            if (other >= 0 && other < grid->particle_blocks) continue; /* in the grid */
            for (int a = 0; a < 3; a++) there[a] = d->corner[a] + own[a] + offset[n][a];
            if (sleep_list_find(&d->sleep->asleep, there)) held[b] |= common[n];
        }
        d->sleep->holds = d->sleep->holds || held[b];
    }
}

static pbmpm_result no_memory(World *world)
{
    grid_clear(&world->grid);
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the sleep of %u blocks", world->grid.found_count + world->sleep.asleep.count);
}

/* Takes all memory but the grid's: what follows it cannot fail. */
static bool reserve(World *world)
{
    Sleep *sleep = &world->sleep;
    Memory *memory = &world->memory;
    const uint32_t blocks = world->grid.found_count + sleep->asleep.count + sleep->active.count;
    return sleep_reserve(sleep, memory, blocks, sleep->pieces) && array_reserve(memory, &sleep->next, blocks, sizeof(SleepBlock)) &&
           array_reserve(memory, &sleep->loud, blocks, sizeof(float)) &&
           array_reserve(memory, &sleep->drift, (size_t)blocks * K_DRIFT_WIDTH, sizeof(float));
}

pbmpm_result sleep_build(World *world, bool with_volume)
{
    Sleep *sleep = &world->sleep;
    Grid *grid = &world->grid;
    Decision d = {.world = world, .sleep = sleep, .speed2 = world->settings.sleep_speed * world->settings.sleep_speed};
    int32_t anchor[3];
    sleep_settle(world);
    grid_clear(grid);
    sleep->holds = false;
    sleep->still_rows = sleep->still_blocks = 0;
    if (!drop_anchor(world, anchor)) return PBMPM_OK;
    d.rows = sleep->rows;
    if (!grid_begin(grid, &world->memory, anchor) || !grid_add_rows(grid, &world->memory, &world->particles, d.rows, world->particles.count) ||
        !reserve(world))
        return no_memory(world);
    d.next = sleep->next.data;
    d.loud = sleep->loud.data;
    sleep_place(sleep, anchor, world->def.dimension, d.corner);
    uint32_t blocks = grid->found_count;
    measure_speeds(&d, blocks);
    look_back(&d, blocks);
    fall_asleep(&d, blocks);
    if (!bring_in(&d, blocks)) return no_memory(world);
    blocks = grid->found_count;
    if (blocks == 0) {
        sleep->active.count = 0;
        return PBMPM_OK;
    }
    rank(&d, blocks);
    const pbmpm_result result = grid_finish(grid, &world->memory, &world->particles, world->pool, with_volume, sleep->rows);
    if (result != PBMPM_OK) return result;
    if (!array_reserve(&world->memory, &sleep->held, (size_t)grid->node_blocks, sizeof(uint64_t))) return no_memory(world);
    commit(&d, blocks);
    hold_nodes(&d);
    return PBMPM_OK;
}

/* ---- The solution ---- */

pbmpm_result sleep_prepare(World *world)
{
    Sleep *sleep = &world->sleep;
    const Particles *p = &world->particles;
    world->args.grid.drift = sleep->drift.data;
    if (!p->pressure || sleep->still_rows == 0) return PBMPM_OK;
    if (!array_reserve(&world->memory, &sleep->pressure, sleep->still_rows, sizeof(float)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the pressures of %u particles that sleep", sleep->still_rows);
    memcpy(sleep->pressure.data, p->pressure + sleep->rows, sleep->still_rows * sizeof(float));
    return PBMPM_OK;
}

/* What a drowsy block would get in a time t, without moving, is t times the acceleration that it bears. What solvers that stop early leave of
 * a pool's balance was below 1.2 m/s^2 in 99 of 100 drowsy blocks (paper's solver, 240 Hz x 10), most of it the same in every substep;
 * with the default sleep_speed a block bears 1.7 m/s^2. */
static const double MEMORY = 0.03; /* [s] in which what 99 of 100 blocks lack of balance makes less than sleep_speed */

static bool would_move(const World *world, SleepBlock *block, const float *drift)
{
    const double to_velocity = world->substep.to_velocity, limit = (double)world->settings.sleep_speed;
    const double mass = fmax((double)drift[0], FLT_MIN);
    double gained2 = 0.0;
    for (int a = 0; a < 3; a++) {
        block->gained[a] = (float)((double)block->gained[a] * exp(-world->substep.dt / MEMORY) + (double)drift[1 + a] / mass * to_velocity);
        gained2 += (double)block->gained[a] * (double)block->gained[a];
    }
    const double fastest = sqrt((double)drift[4]) * to_velocity;
    return !(gained2 <= limit * limit && fastest <= limit);
}

/* Still blocks that would move wake, and their bodies with them. */
static void find_moving(World *world)
{
    Sleep *sleep = &world->sleep;
    bool any = false;
    solver_over_still(world, world->kernels->drift);
    for (int32_t b = 0; b < world->grid.still_blocks; b++) {
        SleepBlock *block = sleep_list_block(&sleep->active, (uint32_t)b);
        if (!would_move(world, block, (const float *)sleep->drift.data + (size_t)b * K_DRIFT_WIDTH)) continue;
        block->woken = 1;
        sleep->woken_blocks++;
        any = true;
    }
    if (sleep_wake_by_waves(world) || any) sleep->stirred = true;
}

void sleep_judge(World *world)
{
    Sleep *sleep = &world->sleep;
    Particles *p = &world->particles;
    const uint32_t *begin = world->grid.block_begin.data;
    find_moving(world);
    for (int32_t b = 0; b < world->grid.still_blocks; b++) {
        const SleepBlock *block = sleep_list_block(&sleep->active, (uint32_t)b);
        if (block->woken) {
            sleep->still_rows -= block->rows;
            sleep->still_blocks--;
        } else if (p->pressure) {
            const uint32_t first = begin[b] - sleep->rows;
            memcpy(p->pressure + begin[b], (const float *)sleep->pressure.data + first, (begin[b + 1] - begin[b]) * sizeof(float));
        }
    }
}
