/* Every piece of memory that a step asks for may be missing, with each solver and effect: the step says so, the world lives on, and everything is given
 * back in the end. */
#include <stdio.h>
#include <string.h>
#include <unity.h>

#include "books.h"
#include "step.h"
#include "world.h"

enum { EACH = 60, STEPS = 4, MOST = 2000 };

typedef struct Case {
    const char *name;
    pbmpm_solver solver;
    pbmpm_integrator integrator;
    pbmpm_pressure pressure;
    bool liquids, solids, sleeping, deep;
} Case;

static const Case cases[] = {
    {"paper", PBMPM_SOLVER_PAPER, 0, 0, true, true, false, false},
    {"paper, sleeping", PBMPM_SOLVER_PAPER, 0, 0, true, true, true, false},
    {"dual", PBMPM_SOLVER_DUAL, 0, 0, true, true, false, true},
    {"dual, sleeping", PBMPM_SOLVER_DUAL, 0, 0, true, false, true, false},
    {"dual in cells", PBMPM_SOLVER_DUAL, 0, PBMPM_PRESSURE_CELLS, true, true, false, false},
    {"primal", PBMPM_SOLVER_PRIMAL, 0, 0, true, true, false, true},
    {"primal, BDF2", PBMPM_SOLVER_PRIMAL, PBMPM_INTEGRATOR_BDF2, 0, false, true, false, false},
    {"explicit", PBMPM_SOLVER_EXPLICIT, 0, 0, true, true, false, false},
    {"convergent", PBMPM_SOLVER_CONVERGENT, 0, 0, true, true, false, false},
    {"convergent, sleeping", PBMPM_SOLVER_CONVERGENT, 0, 0, true, true, true, false},
};

static World *world;
static Books books;

void setUp(void) { world = NULL; }
void tearDown(void)
{
    if (world) world_destroy(world);
}

static void add_matter(pbmpm_material_kind kind, double x, double y)
{
    pbmpm_material_def def = material_defaults();
    pbmpm_material_id id;
    def.kind = kind;
    def.bulk_modulus = 1e5f;
    def.volume_feedback = kind == PBMPM_LIQUID;
    def.kinematic_viscosity = kind == PBMPM_LIQUID ? 0.1f : 0.0f;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &def, 1, &id));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_make_room_for(world, id.index));
    for (int i = 0; i < EACH; i++) {
        const NewParticle particle = {{x + 0.5 * (i % 8), y + 0.5 * (i / 8), 1.0}, {0, 0, 0}, 0.25f, id.index, 0};
        particles_append(&world->particles, &particle, (uint32_t)(i + 1));
    }
}

/* Two blocks of matter beside an obstacle that measures impulses, a force and an emitter. */
static void open_world(const Case *plan)
{
    pbmpm_world_def def = world_def_defaults();
    pbmpm_collider_def ball = collider_defaults();
    pbmpm_force_def force = force_defaults();
    pbmpm_emitter_def emitter = emitter_defaults();
    pbmpm_drain_def drain = drain_defaults();
    const pbmpm_shape box = shape_defaults();
    pbmpm_collider_id collider_id;
    pbmpm_force_id force_id;
    pbmpm_emitter_id emitter_id;
    pbmpm_drain_id drain_id;
    def.dimension = plan->deep ? 3 : 2;
    def.particle_capacity = 5 * EACH;
    def.thread_count = 1;
    def.domain_enabled = def.domain_measures_impulse = 1;
    for (int a = 0; a < 3; a++) def.domain_max[a] = 3.0f;
    const Memory memory = books_memory(&books, 0);
    def.allocator = &memory.allocator;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_create(&def, &world));
    world->settings.solver = plan->solver;
    world->settings.integrator = plan->integrator;
    world->settings.pressure = plan->pressure;
    world->settings.sleeping = plan->sleeping;
    world->settings.sleep_time = 0.01f;
    world->settings.sleep_speed = 1e6f;
    world->settings.iterations = 2;
    world->settings.gravity[1] = -1.0f;
    if (plan->liquids) add_matter(PBMPM_LIQUID, 5.5, 1.0);
    if (plan->solids) add_matter(PBMPM_ELASTIC, 9.5, 1.0);
    if (plan->solids) add_matter(PBMPM_ELASTIC, 18.0, 1.0);
    if (!plan->liquids || !plan->solids) add_matter(PBMPM_SAND, 14.0, 1.0);
    ball.measures_impulse = 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, colliders_add(&world->colliders, &world->memory, &ball, &box, NULL, 1, &collider_id));
    if (plan->sleeping) return; /* what acts on matter keeps it awake */
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, forces_add(&world->forces, &world->memory, &force, &box, def.dimension, 1, &force_id));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, sinks_add(&world->sinks, &world->memory, &drain, &box, def.dimension, 1, &drain_id));
    emitter.material = (pbmpm_material_id){0, 1};
    emitter.rate = 0.1f;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, emitters_add(&world->emitters, &world->memory, &emitter, &box, 1, &emitter_id));
}

/* Whether the allocation number `place` of the steps was asked for; it is refused. */
static bool fails_at(const Case *plan, uint64_t place)
{
    char what[100];
    snprintf(what, sizeof what, "%s, allocation %u", plan->name, (unsigned)place);
    open_world(plan);
    const uint64_t refused = books.calls + place;
    books.fail_at = refused;
    int failures = 0;
    for (int step = 0; step < STEPS; step++) {
        const pbmpm_result result = world_step(world, 0.01f);
        if (result == PBMPM_OK) continue;
        TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_ERROR_OUT_OF_MEMORY, result, what);
        failures++;
    }
    const bool asked = books.calls >= refused;
    TEST_ASSERT_EQUAL_INT_MESSAGE(asked, failures, what);
    books.fail_at = 0;
    TEST_ASSERT_EQUAL_INT_MESSAGE(PBMPM_OK, world_step(world, 0.01f), what);
    world_destroy(world);
    world = NULL;
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(0, books.live_blocks, what);
    TEST_ASSERT_EQUAL_UINT64_MESSAGE(0, books.live_bytes, what);
    return asked;
}

static void test_any_allocation_of_a_step_may_fail(void)
{
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        uint64_t place = 1;
        while (place < MOST && fails_at(&cases[i], place)) place++;
        TEST_ASSERT_TRUE_MESSAGE(place > 10 && place < MOST, cases[i].name);
    }
}

/* The first emitter and drain of a world take memory for all. */
static void test_no_slots_without_memory(void)
{
    Memory memory = books_memory(&books, 0);
    Emitters emitters = {0};
    Sinks sinks = {0};
    const pbmpm_emitter_def emitter = emitter_defaults();
    const pbmpm_drain_def drain = drain_defaults();
    const pbmpm_shape box = shape_defaults();
    pbmpm_emitter_id emitter_id;
    pbmpm_drain_id drain_id;
    books.fail_at = 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_OUT_OF_MEMORY, emitters_add(&emitters, &memory, &emitter, &box, 1, &emitter_id));
    books.fail_at = 2;
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_OUT_OF_MEMORY, sinks_add(&sinks, &memory, &drain, &box, 2, 1, &drain_id));
    TEST_ASSERT_TRUE(emitters.used == 0 && sinks.used == 0);
    books_expect_closed(&books, &memory);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_any_allocation_of_a_step_may_fail);
    RUN_TEST(test_no_slots_without_memory);
    return UNITY_END();
}
