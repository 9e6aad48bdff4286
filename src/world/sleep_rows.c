#include "world/sleep_rows.h"

#include <float.h>
#include <math.h>
#include <string.h>

bool sleep_is_still(const World *world, int32_t block)
{
    return block < world->grid.still_blocks && !sleep_list_block(&world->sleep.active, (uint32_t)block)->woken;
}

static bool is_to_go(const SleepBlock *block) { return block->woken || block->stage == SLEEP_DROWSY; }

/* Adds a piece behind the last. */
static void add_piece(SleepPiece *pieces, uint32_t *count, SleepPiece piece)
{
    SleepPiece *last = *count ? &pieces[*count - 1] : NULL;
    if (last && last->block == piece.block)
        last->count += piece.count;
    else
        pieces[(*count)++] = piece;
}

/* Rows that stay asleep although they stand where none will, the next ones first. */
typedef struct Stayers {
    const Sleep *sleep;
    uint32_t piece, taken;
} Stayers;

/* The next stretch of at most `most` rows. There is one. */
static SleepPiece next_stayers(Stayers *stayers, uint32_t most)
{
    const SleepPiece *piece = (const SleepPiece *)stayers->sleep->piece.data + stayers->piece;
    while (stayers->taken >= piece->count || is_to_go(sleep_list_block(&stayers->sleep->asleep, piece->block))) {
        stayers->piece++;
        stayers->taken = 0;
        piece++;
    }
    const uint32_t left = piece->count - stayers->taken;
    const SleepPiece found = {piece->block, piece->begin + stayers->taken, left < most ? left : most};
    stayers->taken += found.count;
    return found;
}

/* Rows to go that stand before `boundary` change places with rows that stay and stand behind it. */
static void part_rows(Sleep *sleep, Particles *p, uint32_t boundary)
{
    const SleepPiece *pieces = sleep->piece.data;
    SleepPiece *parted = sleep->piece_scratch.data;
    uint32_t count = 0;
    Stayers stayers = {.sleep = sleep};
    while (stayers.piece < sleep->pieces && pieces[stayers.piece].begin + pieces[stayers.piece].count <= boundary) stayers.piece++;
    if (stayers.piece < sleep->pieces && pieces[stayers.piece].begin < boundary) stayers.taken = boundary - pieces[stayers.piece].begin;
    for (uint32_t i = 0; i < sleep->pieces && pieces[i].begin < boundary; i++) {
        uint32_t at = pieces[i].begin;
        const uint32_t end = at + pieces[i].count < boundary ? at + pieces[i].count : boundary;
        if (!is_to_go(sleep_list_block(&sleep->asleep, pieces[i].block))) {
            add_piece(parted, &count, (SleepPiece){pieces[i].block, at, end - at});
            continue;
        }
        while (at < end) {
            const SleepPiece from = next_stayers(&stayers, end - at);
            particles_swap(p, at, from.begin, from.count);
            add_piece(parted, &count, (SleepPiece){from.block, at, from.count});
            at += from.count;
        }
    }
    const Array swap = sleep->piece;
    sleep->piece = sleep->piece_scratch;
    sleep->piece_scratch = swap;
    sleep->pieces = count;
}

/* Those to go become active; the others move up, and the pieces follow them. */
static void part_lists(Sleep *sleep)
{
    SleepPiece *pieces = sleep->piece.data;
    uint32_t kept = 0;
    for (uint32_t i = 0; i < sleep->asleep.count; i++) {
        SleepBlock *block = sleep_list_block(&sleep->asleep, i);
        if (!is_to_go(block)) block->index = kept++;
    }
    for (uint32_t i = 0; i < sleep->pieces; i++) pieces[i].block = sleep_list_block(&sleep->asleep, pieces[i].block)->index;
    for (uint32_t i = 0; i < sleep->asleep.count; i++) {
        SleepBlock block = *sleep_list_block(&sleep->asleep, i);
        const uint32_t place = block.index;
        block.index = 0;
        if (is_to_go(&block)) {
            SleepBlock *active = sleep_list_block(&sleep->active, sleep->active.count++);
            *active = (SleepBlock){.stage = block.woken ? SLEEP_AWAKE : SLEEP_DROWSY, .rows = block.rows, .joined = block.joined, .disturbed = block.disturbed};
            memcpy(active->place, block.place, sizeof active->place);
        } else {
            *sleep_list_block(&sleep->asleep, place) = block;
        }
    }
    sleep->asleep.count = kept;
}

void sleep_take_out(World *world)
{
    Sleep *sleep = &world->sleep;
    uint32_t rows = 0, blocks = 0;
    for (uint32_t i = 0; i < sleep->asleep.count; i++) {
        const SleepBlock *block = sleep_list_block(&sleep->asleep, i);
        if (!is_to_go(block)) continue;
        rows += block->rows;
        blocks++;
    }
    if (blocks == 0) return;
    part_rows(sleep, &world->particles, sleep->rows - rows);
    part_lists(sleep);
    sleep->rows -= rows;
    sleep_list_index(&sleep->asleep);
    sleep_list_index(&sleep->active);
}

float sleep_crossing(const World *world, uint32_t first, uint32_t count)
{
    const double block = K_BLOCK_AXIS * (double)world->def.cell_size;
    const Particles *p = &world->particles;
    float least = FLT_MAX;
    for (uint32_t row = first; row < first + count; row++) {
        const pbmpm_material_def *def = &world->materials.def[p->material[row]];
        if ((row > first && p->material[row] == p->material[row - 1]) || def->kind == PBMPM_LIQUID) continue;
        least = fminf(least, def->kind == PBMPM_SAND ? (float)(block / (material_wave_speed(def) * world->sleep.dt)) : 0.0f);
    }
    return least;
}

/* The liquid of a block that falls asleep, whose rows begin at `first`. */
static void weigh(const World *world, SleepBlock *block, uint32_t first)
{
    const Particles *p = &world->particles;
    block->liquid_volume = block->liquid_mass = 0.0f;
    for (uint32_t row = first; row < first + block->rows; row++) {
        const KernelMaterial *material = &world->materials.kernel[p->material[row]];
        if (material->kind != K_LIQUID) continue;
        block->liquid_mass += p->mass[row];
        block->liquid_volume += p->mass[row] * material->inverse_density;
    }
}

void sleep_settle(World *world)
{
    Sleep *sleep = &world->sleep;
    uint32_t leaving = 0;
    for (; leaving < sleep->active.count && sleep_list_block(&sleep->active, leaving)->stage == SLEEP_LEAVING; leaving++) {
        SleepBlock *block = sleep_list_block(&sleep->asleep, sleep->asleep.count);
        *block = *sleep_list_block(&sleep->active, leaving);
        block->stage = SLEEP_ASLEEP;
        weigh(world, block, sleep->rows);
        block->crossing = sleep_crossing(world, sleep->rows, block->rows);
        ((SleepPiece *)sleep->piece.data)[sleep->pieces++] = (SleepPiece){sleep->asleep.count++, sleep->rows, block->rows};
        sleep->rows += block->rows;
    }
    if (leaving) {
        SleepBlock *active = sleep->active.block.data;
        sleep->active.count -= leaving;
        memmove(active, active + leaving, sleep->active.count * sizeof *active);
        sleep_list_index(&sleep->asleep);
        sleep_list_index(&sleep->active);
    }
    for (uint32_t i = 0; i < sleep->active.count && sleep->stirred; i++) {
        SleepBlock *block = sleep_list_block(&sleep->active, i);
        if (!block->woken) continue;
        block->woken = 0;
        block->stage = SLEEP_AWAKE;
        block->quiet = 0.0f;
    }
    if (sleep->stirred) sleep_take_out(world);
    sleep->stirred = false;
}

static bool is_finite(const Particles *p, const Field *field, uint32_t row)
{
    for (int c = 0; c < particles_components(p, field->class); c++)
        if (!isfinite(((const float *)*field->component[c])[row])) return false;
    return true;
}

/* Rows of a block, with nothing in them that a step would have to delete: nobody looks at what sleeps. */
static bool is_in(const World *world, const int32_t place[3], uint32_t begin, uint32_t count)
{
    const Particles *p = &world->particles;
    if (begin > p->count || count > p->count - begin) return false;
    for (uint32_t row = begin; row < begin + count; row++) {
        int32_t cell[3] = {0}, there[3];
        for (int a = 0; a < p->dimension; a++) cell[a] = p->cell[a][row];
        sleep_place(&world->sleep, cell, p->dimension, there);
        if (memcmp(there, place, sizeof there) != 0) return false;
    }
    for (int i = 0; i < p->field_count; i++)
        for (uint32_t row = begin; row < begin + count && particles_is_real(p->field[i].tag); row++)
            if (!is_finite(p, &p->field[i], row)) return false;
    return true;
}

void sleep_check_rows(World *world)
{
    Sleep *sleep = &world->sleep;
    const SleepPiece *piece = sleep->piece.data;
    uint32_t leaving = sleep->rows;
    bool right = true;
    for (uint32_t i = 0; i < sleep->asleep.count; i++) sleep_list_block(&sleep->asleep, i)->index = 0;
    for (uint32_t i = 0; i < sleep->pieces && right; i++) {
        SleepBlock *block = sleep_list_block(&sleep->asleep, piece[i].block);
        right = is_in(world, block->place, piece[i].begin, piece[i].count);
        block->index += piece[i].count;
    }
    for (uint32_t i = 0; i < sleep->asleep.count && right; i++) {
        const SleepBlock *block = sleep_list_block(&sleep->asleep, i);
        right = block->index == block->rows;
    }
    for (uint32_t i = 0; i < sleep->asleep.count; i++) sleep_list_block(&sleep->asleep, i)->index = 0;
    for (uint32_t i = 0; i < sleep->active.count && right; i++) {
        const SleepBlock *block = sleep_list_block(&sleep->active, i);
        if (block->stage != SLEEP_LEAVING) break;
        right = is_in(world, block->place, leaving, block->rows);
        leaving += block->rows;
    }
    if (!right) sleep_end(sleep);
}
