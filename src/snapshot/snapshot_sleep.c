/* Who sleeps, in a snapshot. A world without sleeping saves nothing. */
#include <math.h>
#include <string.h>

#include "base/result.h"
#include "snapshot/snapshot_flow.h"
#include "world/world.h"

/* What the payload begins with. Then: the blocks that are asleep, the active ones, the pieces. */
typedef struct Contents {
    int32_t phase[3];
    uint32_t phased, stirred;
    uint32_t rows, still_rows, woken_blocks;
    uint32_t asleep, active, pieces;
    uint32_t still_blocks;
    double dt;
} Contents;

static void save_sleep(const World *world, SnapshotOut *out)
{
    const Sleep *sleep = &world->sleep;
    const Contents contents = {.phase = {sleep->phase[0], sleep->phase[1], sleep->phase[2]},
                               .phased = sleep->phased,
                               .stirred = sleep->stirred,
                               .rows = sleep->rows,
                               .still_rows = sleep->still_rows,
                               .still_blocks = sleep->still_blocks,
                               .woken_blocks = sleep->woken_blocks,
                               .asleep = sleep->asleep.count,
                               .active = sleep->active.count,
                               .pieces = sleep->pieces,
                               .dt = sleep->dt};
    if (!sleep->on) return;
    snapshot_put(out, &contents, sizeof contents);
    snapshot_put(out, sleep->asleep.block.data, sleep->asleep.count * sizeof(SleepBlock));
    snapshot_put(out, sleep->active.block.data, sleep->active.count * sizeof(SleepBlock));
    snapshot_put(out, sleep->piece.data, sleep->pieces * sizeof(SleepPiece));
}

/* The pieces cover the rows in order, and belong to blocks that there are. */
static bool pieces_fit(const Contents *contents, SnapshotIn in)
{
    uint32_t covered = 0;
    for (uint32_t i = 0; i < contents->pieces; i++) {
        SleepPiece piece;
        snapshot_take(&in, &piece, sizeof piece);
        if (piece.block >= contents->asleep || piece.begin != covered || piece.count == 0 || piece.count > contents->rows - covered) return false;
        covered += piece.count;
    }
    return covered == contents->rows;
}

/* Where particles may be, and the place of a grid's anchor beside the lowest of them. */
static bool block_fits(const World *world, const SleepBlock *block)
{
    const int32_t most = (CELL_LIMIT + 1) / K_BLOCK_AXIS + 2;
    for (int a = 0; a < 3; a++)
        if (block->place[a] < -most || block->place[a] > most || (a >= world->def.dimension && block->place[a] != 0)) return false;
    const float sum = block->quiet + fabsf(block->gained[0]) + fabsf(block->gained[1]) + fabsf(block->gained[2]);
    return isfinite(sum) && isfinite(block->liquid_volume) && isfinite(block->liquid_mass);
}

/* Stages in the order of a grid; nothing is asleep among the active, and nothing else among those that are. */
static bool blocks_fit(const World *world, const Contents *contents, SnapshotIn in)
{
    SleepStage last = SLEEP_LEAVING;
    for (uint32_t i = 0; i < contents->asleep + contents->active; i++) {
        SleepBlock block;
        snapshot_take(&in, &block, sizeof block);
        if (!block_fits(world, &block)) return false;
        if (i < contents->asleep) {
            if (block.stage != SLEEP_ASLEEP || block.rows == 0) return false;
            continue;
        }
        if (block.stage < SLEEP_AWAKE || block.stage > last) return false;
        last = block.stage;
    }
    return true;
}

static pbmpm_result check_sleep(World *world, SnapshotIn in)
{
    Contents contents;
    if (in.bytes == 0) return PBMPM_OK;
    if (!snapshot_take(&in, &contents, sizeof contents)) return snapshot_malformed();
    const uint64_t blocks = (uint64_t)contents.asleep + contents.active, capacity = world->particles.capacity;
    bool fits = contents.rows <= capacity && contents.asleep <= capacity && contents.active <= capacity && contents.pieces <= capacity &&
                in.bytes - in.at == blocks * sizeof(SleepBlock) + contents.pieces * (uint64_t)sizeof(SleepPiece) && contents.dt > 0.0 && isfinite(contents.dt) &&
                contents.still_rows <= capacity - contents.rows && contents.still_blocks <= capacity;
    for (int a = 0; a < 3; a++) fits = fits && contents.phase[a] >= 0 && contents.phase[a] < K_BLOCK_AXIS;
    if (!fits || !blocks_fit(world, &contents, in)) return snapshot_malformed();
    SnapshotIn pieces = in;
    pieces.at += blocks * sizeof(SleepBlock);
    return pieces_fit(&contents, pieces) ? PBMPM_OK : snapshot_malformed();
}

static pbmpm_result reserve_sleep(World *world, SnapshotIn in)
{
    Contents contents;
    if (!snapshot_take(&in, &contents, sizeof contents)) return PBMPM_OK;
    const uint32_t blocks = contents.asleep + contents.active;
    if (sleep_renew(&world->sleep, &world->memory, blocks, contents.pieces)) return PBMPM_OK;
    return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the sleep of %u blocks", blocks);
}

static void load_sleep(World *world, SnapshotIn in)
{
    Sleep *sleep = &world->sleep;
    Contents contents;
    sleep_end(sleep);
    if (!snapshot_take(&in, &contents, sizeof contents)) return;
    sleep->on = true;
    sleep->phased = contents.phased != 0;
    sleep->stirred = contents.stirred != 0;
    memcpy(sleep->phase, contents.phase, sizeof sleep->phase);
    sleep->dt = contents.dt;
    sleep->rows = contents.rows;
    sleep->still_rows = contents.still_rows;
    sleep->still_blocks = contents.still_blocks;
    sleep->woken_blocks = contents.woken_blocks;
    sleep->asleep.count = contents.asleep;
    sleep->active.count = contents.active;
    sleep->pieces = contents.pieces;
    snapshot_take(&in, sleep->asleep.block.data, contents.asleep * sizeof(SleepBlock));
    snapshot_take(&in, sleep->active.block.data, contents.active * sizeof(SleepBlock));
    snapshot_take(&in, sleep->piece.data, contents.pieces * sizeof(SleepPiece));
    sleep_list_index(&sleep->asleep);
    sleep_list_index(&sleep->active);
}

const SnapshotSection sleep_section = {11, save_sleep, check_sleep, reserve_sleep, load_sleep};
