#include "solvers/granular.h"

#include <math.h>

#include "base/result.h"
#include "solvers/dual/dual.h"
#include "solvers/passes.h"
#include "world/depth.h"
#include "world/island_groups.h"
#include "world/sleep_rows.h"
#include "world/stirred.h"

enum { BLOCK_GRAIN = 8 };

/* Shares of v. FALLS is a fall by a quarter of a cell. Between the others sand may do either: it creeps by a cell in seconds, or trembles as iterations leave it. By trial, on
 * the sand of tests/field. */
static const double FALLS = 0.5, CREEPS = 0.003, SETTLES = 0.07;
static const double SLOW = 0.3;                                  /* [s] longer than what settles or strikes lasts; by trial */
static const double FORGETS = 1.0;                               /* [s] what grains bear beside the means of cells: as long as a bin takes to begin; by trial */
static const double MISSING_MOST = 0.03;                         /* of the volume of sand that rests: as much as random places make the grid miss */
static const double RETURNS = 0.1;                               /* of what is missing, per second: what gains less stays as it is, pressed by what the iterations leave; by trial */
static const double FEW = 0.25;                                  /* of the grains of the fullest block: what has fewer is its rim, or spray; by trial */

/* The grains of a block. */
typedef struct GranularBlock {
    uint32_t grains;
    float speed;   /* of their mean motion [m/s] */
    float missing; /* sum of 1 - J where that is positive */
} GranularBlock;

/* ---- The state ---- */

/* Whether it was judged in the substep before; else it is not known. */
static bool goes_on(const World *world, const GranularState *state) { return state->judged > 0 && state->judged >= world->step_count; }

bool granular_goes_on(const World *world) { return goes_on(world, &world->granular.of[islands_kinds(world)]); }

bool granular_flows(const World *world, uint32_t kinds)
{
    const GranularState *state = &world->granular.of[kinds];
    return (kinds & KIND_LIQUID) || (goes_on(world, state) && state->flows);
}

/* ---- What the blocks do ---- */

static bool is_judged(const World *world)
{
    const pbmpm_solver solver = world->settings.solver;
    return (solver == PBMPM_SOLVER_CONVERGENT || solver == PBMPM_SOLVER_DUAL) && solver_holds_sand(world) && !solver_holds_liquid(world);
}

static GranularBlock measure(const World *world, int32_t block)
{
    const Grid *grid = &world->grid;
    const Particles *p = &world->particles;
    const uint32_t *block_run = grid->block_run.data;
    GranularBlock of = {0, 0.0f, 0.0f};
    double sum[3] = {0.0}, speed2 = 0.0;
    for (uint32_t run = block_run[block]; run < block_run[block + 1]; run++) {
        if (world->materials.kernel[grid->run_key[run] >> K_RUN_CELL_BITS].yields != K_SAND) continue;
        for (uint32_t row = grid->run_begin[run]; row < grid->run_begin[run + 1]; row++) {
            of.grains++;
            of.missing += fmaxf(0.0f, 1.0f - p->volume_ratio[row]);
            for (int a = 0; a < p->dimension; a++) sum[a] += (double)p->velocity[a][row];
        }
    }
    for (int a = 0; a < 3 && of.grains > 0; a++) speed2 += sum[a] * sum[a] / ((double)of.grains * (double)of.grains);
    of.speed = sleep_is_still(world, block) ? 0.0f : (float)sqrt(speed2);
    return of;
}

static void measure_blocks(void *context, int32_t begin, int32_t end)
{
    World *world = context;
    GranularBlock *blocks = world->granular.blocks.data;
    for (int32_t block = begin; block < end; block++) blocks[block] = measure(world, block);
}

/* ---- A substep ---- */

void granular_free(World *world) { array_free(&world->memory, &world->granular.blocks); }

/* What the dual starts from beside means, see granular.h. */
static float carried(const World *world)
{
    const GranularState *state = &world->granular.of[islands_kinds(world)];
    return goes_on(world, state) ? (float)fmax(0.0, 1.0 - state->flowed / FORGETS) : 0.0f;
}

void granular_bind(World *world)
{
    if (is_judged(world)) world->args.dual.pressure = world->particles.pressure;
    world->args.dual.grains_carried = carried(world);
}

/* Counts for how much longer it has done than not done what ends its state, and ends it: what an unfinished solution holds up moves by fits and starts. */
static void change_state(GranularState *state, bool leaves, bool at_once, const Substep *substep)
{
    state->seconds = fmax(0.0, state->seconds + (leaves ? substep->dt : -substep->dt));
    if (!at_once && state->seconds < SLOW) return;
    state->flows = !state->flows;
    state->seconds = 0.0;
}

/* The fastest block that counts, and what is missing of a grain on average. */
static GranularBlock measure_all(World *world)
{
    const GranularBlock *blocks = world->granular.blocks.data;
    const int32_t count = world->grid.particle_blocks;
    GranularBlock all = {0, 0.0f, 0.0f};
    uint32_t fullest = 0;
    double missing = 0.0;
    pool_for(world->pool, count, BLOCK_GRAIN, measure_blocks, world);
    for (int32_t block = 0; block < count; block++) {
        if (blocks[block].grains > fullest) fullest = blocks[block].grains;
        all.grains += blocks[block].grains;
        missing += (double)blocks[block].missing;
    }
    for (int32_t block = 0; block < count; block++)
        if ((double)blocks[block].grains > FEW * (double)fullest) all.speed = fmaxf(all.speed, blocks[block].speed);
    all.missing = (float)(missing / fmax(1.0, (double)all.grains));
    return all;
}

/* [m/s] at the end of a fall through one cell. */
static double fall_of(const World *world) { return sqrt(2.0 * gravity_strength(world) * (double)world->def.cell_size); }

/* Whether what it stood on may be gone. */
static bool is_stirred(const World *world)
{
    const GranularBlock *blocks = world->granular.blocks.data;
    bool stirred = false;
    for (int32_t block = 0; world->granular.stirred.any && block < world->grid.particle_blocks && !stirred; block++)
        stirred = blocks[block].grains > 0 && stirred_meets(world, block);
    return stirred;
}

/* What was not judged in the substep before flows from the start if it falls. What slept rests as it did. */
static void begin(World *world, uint32_t kinds)
{
    GranularState *state = &world->granular.of[kinds];
    if (granular_goes_on(world)) return;
    const bool flows = dual_holds_solids(world, &world->substep) && (double)measure_all(world).speed > FALLS * fall_of(world);
    const bool slept = state->judged > 0 && state->flowed == 0.0 && !flows;
    *state = (GranularState){.flowed = slept ? 0.0 : FORGETS, .judged = world->step_count + 1, .flows = flows, .swells = 1};
}

pbmpm_result granular_prepare(World *world)
{
    if (!is_judged(world)) return PBMPM_OK;
    if (!array_reserve(&world->memory, &world->granular.blocks, (size_t)world->grid.particle_blocks, sizeof(GranularBlock)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for what sand does in %d blocks", world->grid.particle_blocks);
    const pbmpm_result result = particles_enable_pressure(&world->particles, &world->memory);
    if (result == PBMPM_OK) begin(world, islands_kinds(world));
    return result;
}

static void note(GranularState *state, double missing, bool swells)
{
    state->swells = swells;
    state->missing = (float)missing;
    state->waited = 0.0f;
}

/* Whether sand by itself that is slow gets volume back; noted every FORGETS. */
static bool swells(GranularState *state, double missing, bool slow, double dt)
{
    state->waited += (float)dt;
    if (!slow)
        note(state, missing, true);
    else if ((double)state->waited >= FORGETS)
        note(state, missing, (double)state->missing - missing > RETURNS * missing * (double)state->waited);
    return missing > MISSING_MOST && state->swells;
}

static void follow(World *world, GranularState *state, uint32_t kinds, bool rested)
{
    const GranularBlock all = measure_all(world);
    const double fall = fall_of(world), speed = (double)all.speed;
    if (state->flows) {
        const bool slow = speed < SETTLES * fall, waits = swells(state, (double)all.missing, slow, world->substep.dt) && kinds == KIND_SAND;
        change_state(state, slow && !waits, false, &world->substep);
    } else {
        change_state(state, speed > CREEPS * fall, speed > FALLS * fall || (rested && is_stirred(world)), &world->substep);
        note(state, (double)all.missing, true);
    }
}

void granular_judge(World *world)
{
    if (!is_judged(world)) return;
    const uint32_t kinds = islands_kinds(world);
    GranularState *state = &world->granular.of[kinds];
    const bool dual = world->settings.solver == PBMPM_SOLVER_DUAL, may_flow = dual || dual_holds_solids(world, &world->substep), rested = state->flowed == 0.0;
    if (!may_flow) *state = (GranularState){0};
    state->judged = world->step_count + 1;
    state->flowed = dual || state->flows ? state->flowed + world->substep.dt : 0.0;
    if (may_flow && !dual) follow(world, state, kinds, rested);
}
