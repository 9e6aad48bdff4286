/* Which nodes solids reach: those of the cells around each particle that is no liquid, and no others. */
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "contact/reach.h"
#include "grid/build.h"
#include "random.h"
#include "services/lifecycle.h"
#include "solvers/solver.h"

void setUp(void) {}
void tearDown(void) {}

enum { PARTICLES = 40 };

static World *open_world(int dimension)
{
    pbmpm_world_def def = world_def_defaults();
    World *world = NULL;
    def.dimension = dimension;
    def.particle_capacity = PARTICLES;
    def.thread_count = 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_create(&def, &world));
    return world;
}

/* Few enough that they leave nodes alone, and near enough that blocks have neighbours. */
static void scatter(World *world, Random *random)
{
    static const pbmpm_material_kind kinds[] = {PBMPM_LIQUID, PBMPM_ELASTIC, PBMPM_SAND, PBMPM_VISCO, PBMPM_LIQUID};
    uint32_t slot[5];
    for (int i = 0; i < 5; i++) {
        pbmpm_material_id id;
        pbmpm_material_def def = material_defaults();
        def.kind = kinds[i];
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &def, 1, &id));
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_make_room_for(world, id.index));
        slot[i] = id.index;
    }
    for (int i = 0; i < PARTICLES; i++) {
        NewParticle particle = {.mass = 1.0f, .material = slot[i % 5]};
        for (int a = 0; a < world->def.dimension; a++) particle.position[a] = random_in(random, -9.0, 9.0);
        particles_append(&world->particles, &particle, (uint32_t)i + 1);
    }
}

static bool is_reached(const World *world, const int32_t node[3])
{
    const Particles *p = &world->particles;
    for (uint32_t row = 0; row < p->count; row++) {
        bool near = material_is_solid(&world->materials, p->material[row]);
        for (int a = 0; a < world->def.dimension; a++) near = near && abs(node[a] - p->cell[a][row]) <= 1;
        if (near) return true;
    }
    return false;
}

static void check_nodes(const World *world, const ContactFrame *frame)
{
    const Grid *grid = frame->grid;
    for (int32_t block = 0; block < grid->node_blocks; block++)
        for (int32_t i = 0; i < grid->block_cells; i++) {
            const int32_t *place = (const int32_t *)grid->coordinate.data + 3 * block, local[3] = {i & 3, i >> 2 & 3, i >> 4};
            int32_t node[3];
            for (int a = 0; a < 3; a++) node[a] = grid->anchor[a] + 4 * place[a] + local[a];
            bool found = false; /* by the body that this block is of, or by another one that has the place for itself */
            for (int32_t other = 0; other < grid->node_blocks; other++)
                found = found || (memcmp(place, (const int32_t *)grid->coordinate.data + 3 * other, 3 * sizeof *place) == 0 &&
                                  reach_solid(frame, (uint32_t)(other * grid->block_cells + i)));
            TEST_ASSERT_EQUAL_INT(is_reached(world, node), found);
        }
}

static void test_the_cells_around_solids(void)
{
    Random random = {5};
    for (int i = 0; i < 20; i++) {
        World *world = open_world(2 + i % 2);
        ContactFrame frame = {.colliders = &world->colliders, .grid = &world->grid};
        scatter(world, &random);
        world->substep = world_substep(world, (double)0.01f);
        solver_bind(world, false);
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, grid_build(&world->grid, &world->memory, &world->particles, world->pool, false));
        for (int again = 0; again < 2; again++) { /* what was found before is forgotten */
            TEST_ASSERT_EQUAL_INT(PBMPM_OK, reach_find(&frame, world->materials.kernel, &world->memory));
            check_nodes(world, &frame);
        }
        world_destroy(world);
    }
}

/* Where nobody looked, walls rub as if all were solid. */
static void test_all_nodes_where_nobody_looked(void)
{
    const Grid grid = {.block_cells = 16};
    const ContactFrame frame = {.grid = &grid};
    TEST_ASSERT_TRUE(reach_solid(&frame, 0) && reach_solid(&frame, 17));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_cells_around_solids);
    RUN_TEST(test_all_nodes_where_nobody_looked);
    return UNITY_END();
}
