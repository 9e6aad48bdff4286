/* Where sleeping particles stand: blocks by place, and rows that are parted when some of them wake; and who falls asleep. */
#include <math.h>
#include <string.h>
#include <unity.h>

#include "random.h"
#include "services/lifecycle.h"
#include "step/occupancy.h"
#include "step/sleep.h"
#include "step/step.h"
#include "world/sleep_rows.h"
#include "world/world.h"

void setUp(void) {}
void tearDown(void) {}

enum { BLOCKS = 40, MOST_ROWS = 9, CAPACITY = BLOCKS * MOST_ROWS, ROUNDS = 60 };

/* ---- Places ---- */

static void test_every_cell_is_in_one_block(void)
{
    Random random = {3};
    for (int i = 0; i < 1000; i++) {
        Sleep sleep = {.phase = {(int32_t)random_below(&random, 4), (int32_t)random_below(&random, 4), (int32_t)random_below(&random, 4)}};
        int32_t cell[3], place[3];
        for (int a = 0; a < 3; a++) cell[a] = (int32_t)random_below(&random, 200) - 100;
        sleep_place(&sleep, cell, 2 + i % 2, place);
        for (int a = 0; a < 2 + i % 2; a++) {
            const int32_t first = place[a] * K_BLOCK_AXIS + sleep.phase[a];
            TEST_ASSERT_TRUE(cell[a] >= first && cell[a] < first + K_BLOCK_AXIS);
        }
        if (i % 2 == 0) TEST_ASSERT_EQUAL_INT32(0, place[2]);
    }
}

static World *open_world(int dimension)
{
    pbmpm_world_def def = world_def_defaults();
    World *world = NULL;
    def.dimension = dimension;
    def.particle_capacity = CAPACITY;
    def.thread_count = 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_create(&def, &world));
    world->sleep.on = world->sleep.phased = true;
    return world;
}

/* Block number i of a crooked row of blocks. */
static void place_of(int i, int32_t place[3])
{
    place[0] = 7 * i - 100;
    place[1] = i * i % 11 - 5;
    place[2] = 0;
}

/* What was put into a list is found, also after it grew; nothing else is. */
static void test_blocks_are_found_by_their_place(void)
{
    World *world = open_world(2);
    SleepList *list = &world->sleep.asleep;
    for (uint32_t count = 1; count <= 400; count = 2 * count + 1) {
        TEST_ASSERT_TRUE(sleep_list_reserve(list, &world->memory, count));
        for (uint32_t i = 0; i < list->count; i++) { /* those of before are still there */
            int32_t place[3];
            place_of((int)i, place);
            TEST_ASSERT_TRUE(sleep_list_find(list, place) == sleep_list_block(list, i));
        }
        for (; list->count < count; list->count++) {
            SleepBlock *block = sleep_list_block(list, list->count);
            *block = (SleepBlock){.stage = SLEEP_ASLEEP};
            place_of((int)list->count, block->place);
        }
        sleep_list_index(list);
        for (uint32_t i = 0; i < count; i++) {
            int32_t place[3];
            place_of((int)i, place);
            TEST_ASSERT_TRUE(sleep_list_find(list, place) == sleep_list_block(list, i));
            place[1] += 100;
            TEST_ASSERT_NULL(sleep_list_find(list, place));
        }
    }
    list->count = 0;
    sleep_list_index(list);
    TEST_ASSERT_NULL(sleep_list_find(list, (const int32_t[3]){-100, -5, 0}));
    world_destroy(world);
}

/* ---- Rows ---- */

/* Particles of BLOCKS blocks, one block after the other. The mass tells who a particle is, the cell where it belongs. */
static uint32_t fill_blocks(World *world, Random *random)
{
    Particles *p = &world->particles;
    for (int i = 0; i < BLOCKS; i++) {
        int32_t place[3];
        place_of(i, place);
        for (uint32_t n = 1 + random_below(random, MOST_ROWS); n > 0; n--) {
            NewParticle particle = {.mass = (float)(p->count + 1), .material = 0};
            for (int a = 0; a < p->dimension; a++) particle.position[a] = place[a] * K_BLOCK_AXIS + (int32_t)random_below(random, K_BLOCK_AXIS);
            particles_append(p, &particle, p->count + 1);
        }
    }
    return p->count;
}

static void place_of_row(const World *world, uint32_t row, int32_t place[3])
{
    int32_t cell[3] = {0};
    for (int a = 0; a < world->particles.dimension; a++) cell[a] = world->particles.cell[a][row];
    sleep_place(&world->sleep, cell, world->particles.dimension, place);
}

/* Sorts the rows that are not asleep by block, as a grid would, and makes their blocks leaving. */
static void make_leaving(World *world)
{
    Sleep *sleep = &world->sleep;
    Particles *p = &world->particles;
    sleep->active.count = 0;
    for (uint32_t row = sleep->rows; row < p->count;) {
        SleepBlock *block = sleep_list_block(&sleep->active, sleep->active.count++);
        *block = (SleepBlock){.stage = SLEEP_LEAVING};
        place_of_row(world, row, block->place);
        for (uint32_t other = row; other < p->count; other++) {
            int32_t place[3];
            place_of_row(world, other, place);
            if (memcmp(place, block->place, sizeof place) != 0) continue;
            if (other != row) particles_swap(p, row, other, 1);
            block->rows++;
            row++;
        }
    }
    sleep_list_index(&sleep->active);
}

static float mass_of(const World *world, const int32_t place[3])
{
    float mass = 0.0f;
    for (uint32_t row = 0; row < world->particles.count; row++) {
        int32_t there[3];
        place_of_row(world, row, there);
        if (memcmp(there, place, sizeof there) == 0) mass += world->particles.mass[row];
    }
    return mass;
}

/* Everybody is there once; pieces cover the sleeping rows in order, and each is of its block; each block knows its rows and its mass. */
static void check_rows(const World *world, uint32_t count)
{
    const Sleep *sleep = &world->sleep;
    const SleepPiece *piece = sleep->piece.data;
    bool seen[CAPACITY + 1] = {false};
    uint32_t rows[BLOCKS] = {0}, covered = 0;
    TEST_ASSERT_EQUAL_UINT32(count, world->particles.count);
    for (uint32_t row = 0; row < count; row++) {
        const uint32_t who = (uint32_t)world->particles.mass[row];
        TEST_ASSERT_TRUE(who >= 1 && who <= count && !seen[who]);
        seen[who] = true;
    }
    for (uint32_t i = 0; i < sleep->pieces; i++) {
        TEST_ASSERT_EQUAL_UINT32(covered, piece[i].begin);
        TEST_ASSERT_TRUE(piece[i].count > 0 && piece[i].block < sleep->asleep.count);
        for (uint32_t row = piece[i].begin; row < piece[i].begin + piece[i].count; row++) {
            int32_t place[3];
            place_of_row(world, row, place);
            TEST_ASSERT_EQUAL_MEMORY(sleep_list_block(&sleep->asleep, piece[i].block)->place, place, sizeof place);
        }
        rows[piece[i].block] += piece[i].count;
        covered += piece[i].count;
    }
    TEST_ASSERT_EQUAL_UINT32(sleep->rows, covered);
    for (uint32_t i = 0; i < sleep->asleep.count; i++) {
        const SleepBlock *block = sleep_list_block(&sleep->asleep, i);
        TEST_ASSERT_EQUAL_UINT32(block->rows, rows[i]);
        TEST_ASSERT_EQUAL_INT(SLEEP_ASLEEP, block->stage);
        TEST_ASSERT_TRUE(sleep_list_find(&sleep->asleep, block->place) == block);
        TEST_ASSERT_TRUE(block->liquid_mass == mass_of(world, block->place)); /* sums of small integers: exact */
        TEST_ASSERT_TRUE(block->liquid_volume == 0.5f * block->liquid_mass);
    }
}

/* Who does not wake stays in its row unless the row is wanted: as many particles change places as wake at most. */
static uint32_t count_moved(const World *world, const float *mass_before, uint32_t rows)
{
    uint32_t moved = 0;
    for (uint32_t row = 0; row < rows; row++) moved += world->particles.mass[row] != mass_before[row];
    return moved;
}

static void wake_some_and_back(World *world, Random *random, uint32_t count)
{
    Sleep *sleep = &world->sleep;
    static float before[CAPACITY];
    uint32_t leave = 0, blocks = 0;
    const uint32_t share = 1 + random_below(random, 8);
    for (uint32_t i = 0; i < sleep->asleep.count; i++) {
        SleepBlock *block = sleep_list_block(&sleep->asleep, i);
        if (random_below(random, share) != 0) continue;
        if (random_below(random, 2)) block->woken = 1;
        else block->stage = SLEEP_DROWSY; /* called */
        leave += block->rows;
        blocks++;
    }
    memcpy(before, world->particles.mass, count * sizeof *before);
    const uint32_t rows = sleep->rows - leave, asleep = sleep->asleep.count - blocks, active = sleep->active.count + blocks;
    sleep_take_out(world);
    TEST_ASSERT_EQUAL_UINT32(rows, sleep->rows);
    TEST_ASSERT_EQUAL_UINT32(asleep, sleep->asleep.count);
    TEST_ASSERT_EQUAL_UINT32(active, sleep->active.count);
    TEST_ASSERT_TRUE(count_moved(world, before, rows) <= leave);
    check_rows(world, count);
    make_leaving(world);
    TEST_ASSERT_TRUE(sleep_reserve(sleep, &world->memory, BLOCKS, sleep->pieces));
    sleep_settle(world);
    TEST_ASSERT_EQUAL_UINT32(count, sleep->rows);
    TEST_ASSERT_EQUAL_UINT32(BLOCKS, sleep->asleep.count);
    check_rows(world, count);
    sleep_check_rows(world);
    TEST_ASSERT_TRUE(sleep->on); /* it agrees */
}

static void test_rows_are_parted_and_nobody_is_lost(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        Random random = {dimension};
        World *world = open_world(dimension);
        world->materials.kernel[0] = (KernelMaterial){.kind = K_LIQUID, .inverse_density = 0.5f};
        const uint32_t count = fill_blocks(world, &random);
        TEST_ASSERT_TRUE(sleep_reserve(&world->sleep, &world->memory, BLOCKS, 0));
        make_leaving(world);
        sleep_settle(world);
        check_rows(world, count);
        for (int round = 0; round < ROUNDS; round++) wake_some_and_back(world, &random, count);
        world_destroy(world);
    }
}

/* A block whose particles are elsewhere, or not as many, does not pass for asleep. */
static void test_rows_that_are_wrong_wake_all(void)
{
    for (int wrong = 0; wrong < 3; wrong++) {
        Random random = {9};
        World *world = open_world(2);
        Sleep *sleep = &world->sleep;
        fill_blocks(world, &random);
        TEST_ASSERT_TRUE(sleep_reserve(sleep, &world->memory, BLOCKS, 0));
        make_leaving(world);
        sleep_settle(world);
        if (wrong == 0) world->particles.cell[0][5] += K_BLOCK_AXIS;
        if (wrong == 1) sleep_list_block(&sleep->asleep, 3)->rows++;
        sleep_check_rows(world);
        TEST_ASSERT_EQUAL_INT(wrong == 2, sleep->on);
        TEST_ASSERT_TRUE(wrong == 2 || sleep->rows + sleep->asleep.count + sleep->pieces == 0);
        world_destroy(world);
    }
}

/* ---- What others see of it ---- */

/* Matter that sleeps fills the surroundings of an emitter as if it were awake, wherever the borders of its blocks are. */
static void test_matter_fills_as_much_asleep(void)
{
    enum { SIZE = 9, NODES = SIZE * SIZE * SIZE, REGIONS = 200 };
    for (int dimension = 2; dimension <= 3; dimension++) {
        static float awake[REGIONS][NODES], asleep[NODES];
        double held[REGIONS], most = 0.0;
        Random random = {11};
        World *world = open_world(dimension);
        Occupancy occupancy = {.size = {SIZE, SIZE, dimension == 3 ? SIZE : 1}};
        fill_blocks(world, &random);
        world->materials.kernel[0].inverse_density = 1.0f;
        TEST_ASSERT_TRUE(sleep_reserve(&world->sleep, &world->memory, BLOCKS, 0));
        for (int lie = 0; lie < 2; lie++) {
            Random same = {12};
            for (int i = 0; i < REGIONS; i++) {
                int32_t place[3];
                place_of((int)random_below(&same, BLOCKS), place);
                for (int a = 0; a < dimension; a++) occupancy.low[a] = place[a] * K_BLOCK_AXIS + (int32_t)random_below(&same, 20) - 12;
                occupancy.volume = lie ? asleep : awake[i];
                occupancy_measure(world, &occupancy);
                if (lie) TEST_ASSERT_DOUBLE_WITHIN(1e-3, held[i], occupancy.held);
                for (int n = 0; n < NODES && lie; n++) TEST_ASSERT_FLOAT_WITHIN(1e-3f, awake[i][n], asleep[n]);
                held[i] = occupancy.held;
                most = fmax(most, occupancy.held);
            }
            make_leaving(world);
            sleep_settle(world);
        }
        TEST_ASSERT_TRUE(most > 0.0 && world->sleep.rows == world->particles.count);
        world_destroy(world);
    }
}

/* ---- Falling asleep ---- */

/* A particle at rest, and one that moves `offset` blocks from it for longer than it takes to fall asleep. Returns how many sleep then. */
static uint32_t sleepers_beside(int dimension, const int offset[3])
{
    World *world = open_world(dimension);
    pbmpm_material_def def = material_defaults();
    pbmpm_material_id id;
    def.kind = PBMPM_ELASTIC;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &def, 1, &id));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_make_room_for(world, id.index));
    world->sleep.on = world->sleep.phased = false;
    world->settings.sleeping = 1;
    world->settings.sleep_speed = 0.01f;
    world->settings.sleep_time = 0.03f;
    NewParticle particle = {.mass = 1.0f, .material = id.index};
    particles_append(&world->particles, &particle, 1);
    for (int a = 0; a < 3; a++) particle.position[a] = K_BLOCK_AXIS * offset[a];
    particle.velocity[0] = 0.1f;
    particles_append(&world->particles, &particle, 2);
    for (int step = 0; step < 6; step++) TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_step(world, 0.01f));
    const uint32_t sleepers = world->sleep.rows + world->sleep.still_rows;
    world_destroy(world);
    return sleepers;
}

/* Matter falls asleep when its block and all blocks beside it, at corners too, were at rest for long enough. */
static void test_only_what_has_quiet_neighbours_falls_asleep(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int n = 0; n < (dimension == 2 ? 25 : 125); n++) {
            const int offset[3] = {n % 5 - 2, n / 5 % 5 - 2, dimension == 3 ? n / 25 - 2 : 0};
            bool beside = true;
            for (int a = 0; a < 3; a++) beside = beside && offset[a] >= -1 && offset[a] <= 1;
            TEST_ASSERT_EQUAL_UINT32(beside ? 0 : 1, sleepers_beside(dimension, offset));
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_every_cell_is_in_one_block);
    RUN_TEST(test_blocks_are_found_by_their_place);
    RUN_TEST(test_rows_are_parted_and_nobody_is_lost);
    RUN_TEST(test_rows_that_are_wrong_wake_all);
    RUN_TEST(test_matter_fills_as_much_asleep);
    RUN_TEST(test_only_what_has_quiet_neighbours_falls_asleep);
    return UNITY_END();
}
