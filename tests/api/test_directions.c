/* No direction and no place is special: the same fall against a wall at any end of any axis, here or there, is the same fall, with every solver. */
#include <math.h>
#include <stdio.h>

#include "solvers.h"

static const float DT = 1.0f / 60, FALL = 9.81f, WIDTH = 1.6f; /* of the domain [m] */

void setUp(void) {}
void tearDown(void) { pbmpm_shutdown(); }

/* A turn and a mirror of space: the fall's first axis becomes `axis`, the others follow it; downward is towards its upper end if `up`. */
typedef struct view_on {
    int32_t dimension;
    int axis;
    bool up;
    float away; /* along all axes [m], whole cells */
} view_on;

static void put(const view_on *view, const float from[3], float middle, float to[3])
{
    for (int a = 0; a < 3; a++) to[a] = middle;
    for (int a = 0; a < view->dimension; a++) to[(a + view->axis) % view->dimension] = from[a];
    if (view->up) to[view->axis] = 2 * middle - to[view->axis];
}

/* A box of matter that falls askew, and an obstacle in its way. The lattice has no jitter, so that all views see the same matter. */
static pbmpm_world_id open_world(const view_on *view, const way *chosen, pbmpm_material_kind kind)
{
    const float at[3] = {0.55f, 0.8f, 0.8f}, speed[3] = {-1, 0.5f, 0.25f}, pull[3] = {-FALL, 0, 0}, stone[3] = {0.1f, 1.1f, 0.9f};
    float place[3], velocity[3], gravity[3], ball[3];
    pbmpm_world_def def = default_world(view->dimension, 0.1f, 2048);
    pbmpm_material_def matter = soft_material(kind);
    pbmpm_material_id id;
    def.thread_count = 1;
    def.domain_enabled = 1;
    def.domain_friction = 0.3f;
    for (int a = 0; a < 3; a++) {
        def.domain_min[a] = view->away;
        def.domain_max[a] = view->away + WIDTH;
    }
    if (chosen->solver == PBMPM_SOLVER_PAPER) matter.bulk_modulus = 0;
    const pbmpm_world_id world = create_world(&def);
    put(view, at, 0.5f * WIDTH, place);
    put(view, speed, 0, velocity);
    put(view, pull, 0, gravity);
    put(view, stone, 0.5f * WIDTH, ball);
    for (int a = 0; a < 3; a++) {
        place[a] += view->away;
        ball[a] += view->away;
    }
    OK(pbmpm_material_create(world, &matter, &id));
    create_collider(world, sphere_shape(ball[0], ball[1], ball[2], 0.2f), false);
    pbmpm_fill_def fill = default_fill(id);
    const pbmpm_shape box = box_shape(place[0], place[1], place[2], 0.3f, 0.3f, 0.3f);
    fill.jitter = 0;
    for (int a = 0; a < 3; a++) fill.velocity[a] = velocity[a];
    OK(pbmpm_particles_fill(world, &fill, &box, NULL));
    set_gravity(world, gravity[0], gravity[1], gravity[2]);
    set_rate(world, chosen->solver == PBMPM_SOLVER_EXPLICIT ? 16 : 1, 8);
    use_way(world, chosen);
    return world;
}

/* The mean place, seen as the fall's. */
static void middle_of(pbmpm_world_id world, const view_on *view, double middle[3])
{
    const pbmpm_view x = view_of(world, PBMPM_POSITION);
    for (int a = 0; a < 3; a++) middle[a] = 0;
    for (uint32_t i = 0; i < x.count; i++)
        for (int a = 0; a < view->dimension; a++) {
            const int seen = (a + view->axis) % view->dimension;
            const double place = (double)(view_float(&x, i, (uint32_t)seen) - view->away);
            middle[a] += (seen == view->axis && view->up ? (double)WIDTH - place : place) / x.count;
        }
}

/* The primal solver's coarser grids begin at the lowest cell, and what is left of its error differs; of a splash, where particles go. */
static double tolerance_of(int32_t dimension, const way *chosen, pbmpm_material_kind kind)
{
    const bool exact = kind == PBMPM_ELASTIC && chosen->solver != PBMPM_SOLVER_PRIMAL && chosen->solver != PBMPM_SOLVER_CONVERGENT;
    return exact ? 2e-4 : dimension == 2 ? 0.03 : 0.006;
}

static void check_views(int32_t dimension, const way *chosen, pbmpm_material_kind kind, int steps)
{
    const double tolerance = tolerance_of(dimension, chosen, kind);
    double middle[3], first[3];
    for (int side = 0; side < 2 * dimension + 2; side++) {
        const view_on view = {dimension, side / 2 % dimension, side % 2, side < 2 * dimension ? 0.0f : 3.2f};
        const pbmpm_world_id world = open_world(&view, chosen, kind);
        char label[120];
        for (int step = 0; step < steps; step++) OK(pbmpm_world_step(world, DT));
        middle_of(world, &view, middle);
        for (int a = 0; a < 3 && side == 0; a++) first[a] = middle[a];
        snprintf(label, sizeof label, "%s, material %d, %dD, against the %s wall of axis %d, %.1f m away", chosen->name, (int)kind, (int)dimension, view.up ? "upper" : "lower",
                 view.axis, (double)view.away);
        for (int a = 0; a < dimension; a++) TEST_ASSERT_DOUBLE_WITHIN_MESSAGE(tolerance, first[a], middle[a], label);
        OK(pbmpm_world_destroy(world));
    }
}

static void test_falls_in_2d(void)
{
    for (int i = 0; i < way_count; i++) {
        check_views(2, &ways[i], PBMPM_ELASTIC, 30);
        if (ways[i].solver != PBMPM_SOLVER_PRIMAL) check_views(2, &ways[i], PBMPM_LIQUID, 30);
    }
}

static void test_falls_in_3d(void)
{
    for (int i = 0; i < way_count; i++) {
        if (ways[i].solver == PBMPM_SOLVER_EXPLICIT || ways[i].flip > 0.5f) continue;
        if (ways[i].solver != PBMPM_SOLVER_CONVERGENT) check_views(3, &ways[i], PBMPM_ELASTIC, 10);
        if (ways[i].solver != PBMPM_SOLVER_PRIMAL) check_views(3, &ways[i], PBMPM_LIQUID, 10);
    }
}

int main(void)
{
    support_skip_without_isa();
    UNITY_BEGIN();
    RUN_TEST(test_falls_in_2d);
    RUN_TEST(test_falls_in_3d);
    return UNITY_END();
}
