/* Nodes at walls: the share of them that is open, the density of a full box at rest, and images behind the walls. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "bounds.h"
#include "check.h"
#include "cpu.h"
#include "mirror.h"
#include "open_volume.h"
#include "scene.h"
#include "solver.h"

void setUp(void) {}
void tearDown(void) {}

static const double CELL = 0.125;

/* ---- The open share of a node ---- */

static double spline(double x)
{
    const double r = fabs(x);
    if (r <= 0.5) return 0.75 - r * r;
    return r < 1.5 ? 0.5 * (1.5 - r) * (1.5 - r) : 0.0;
}

static Obstacle plane_at(double angle)
{
    Obstacle o = {.wall = true};
    o.start = (Solid){.kind = PBMPM_PLANE, .dimension = 2, .normal = {cos(angle), sin(angle), 0.0}};
    o.end = o.start;
    return o;
}

/* The part of the spline around a node that lies on the open side of a plane, by the midpoint rule on points 1/100 apart. */
static double integrated(double angle, double distance)
{
    const double step = 0.01;
    double sum = 0.0;
    for (double x = -1.5 + step / 2; x < 1.5; x += step)
        for (double y = -1.5 + step / 2; y < 1.5; y += step)
            if (distance + cos(angle) * x + sin(angle) * y > 0.0) sum += spline(x) * spline(y) * step * step;
    return sum;
}

/* Exact where the plane lies along an axis (the rule errs by half a step of the largest weight); for others the spline is taken for one that looks
 * the same from all sides, and that is off by up to a hundredth. */
static void test_the_open_share_is_the_integral_of_the_spline(void)
{
    for (int degrees = 0; degrees <= 90; degrees += 15)
        for (double distance = -0.95; distance < 1.6; distance += 0.15) {
            const double angle = degrees * acos(-1.0) / 180.0;
            Obstacle plane = plane_at(angle);
            const Colliders one = {.obstacle = &plane, .obstacle_count = 1};
            const double node[3] = {distance * CELL * cos(angle), distance * CELL * sin(angle), 0.0};
            const double share = open_share_at(&one, node, CELL), bound = degrees % 90 == 0 ? 0.75 * 0.005 + 1e-6 : 0.01;
            TEST_ASSERT_DOUBLE_WITHIN(bound, integrated(angle, distance), share);
        }
}

static void test_the_open_share_ends_at_the_support(void)
{
    Obstacle plane = plane_at(0.0);
    const Colliders one = {.obstacle = &plane, .obstacle_count = 1};
    const double places[] = {-5.0, -1.0, 1.5, 7.0}, shares[] = {1.0 / 48.0, 1.0 / 48.0, 1.0, 1.0};
    for (int i = 0; i < 4; i++) {
        const double node[3] = {places[i] * CELL, 0.3, 0.0};
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, shares[i], open_share_at(&one, node, CELL));
    }
}

/* Of planes that face the same way the deepest counts; planes across an edge hide volumes of their own. */
static void test_surfaces_that_lie_on_each_other_count_once(void)
{
    Obstacle planes[3] = {plane_at(0.0), plane_at(0.0), plane_at(acos(0.0))};
    const double node[3] = {0.3 * CELL, -0.2 * CELL, 0.0};
    const Colliders first = {.obstacle = planes, .obstacle_count = 1}, both = {.obstacle = planes, .obstacle_count = 2};
    const Colliders across = {.obstacle = planes + 2, .obstacle_count = 1}, all = {.obstacle = planes, .obstacle_count = 3};
    const double share = open_share_at(&first, node, CELL);
    TEST_ASSERT_EQUAL_DOUBLE(share, open_share_at(&both, node, CELL));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, share * open_share_at(&across, node, CELL), open_share_at(&all, node, CELL));
    for (int i = 0; i < 2; i++) { /* whichever is the deeper one */
        planes[i].end.position[0] = 0.25 * CELL;
        const Colliders deeper = {.obstacle = planes + i, .obstacle_count = 1};
        const double least = open_share_at(&deeper, node, CELL);
        TEST_ASSERT_TRUE(least < share);
        TEST_ASSERT_EQUAL_DOUBLE(least, open_share_at(&both, node, CELL));
        planes[i].end.position[0] = 0.0;
    }
}

/* ---- A box full of liquid ---- */

/* Fills the domain with a lattice of `per_axis` particles per cell and axis, half a spacing from the walls. */
static void fill(World *world, int per_axis)
{
    const int d = world->def.dimension;
    int count[3] = {1, 1, 1}, at[3];
    for (int a = 0; a < d; a++) count[a] = (int)lround((world->domain.high[a] - world->domain.low[a]) / CELL * per_axis);
    for (at[2] = 0; at[2] < count[2]; at[2]++)
        for (at[1] = 0; at[1] < count[1]; at[1]++)
            for (at[0] = 0; at[0] < count[0]; at[0]++) {
                NewParticle particle = {.mass = 1000.0f * (float)pow(per_axis, -d)};
                for (int a = 0; a < d; a++) particle.position[a] = world->domain.low[a] / CELL + (at[a] + 0.5) / per_axis;
                particles_append(&world->particles, &particle, world->particles.count + 1);
            }
}

/* A domain of 5 cells per axis whose corner is `shift` cells off the grid, full of liquid. */
static Scene full_box(pbmpm_isa isa, int dimension, double shift, int per_axis)
{
    pbmpm_world_def def = world_def_defaults();
    Scene scene = {.kernels = kernels_for(isa, dimension), .pressure_max = FLT_MAX};
    const pbmpm_material_def liquid = scene_material(PBMPM_LIQUID);
    pbmpm_material_id id;
    def.dimension = dimension;
    def.cell_size = (float)CELL;
    def.particle_capacity = 8192;
    def.thread_count = 1;
    def.domain_enabled = 1;
    for (int a = 0; a < 3; a++) {
        def.domain_min[a] = (float)((a - 3 + shift) * CELL);
        def.domain_max[a] = (float)((a + 2 + shift) * CELL);
    }
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_create(&def, &scene.world));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&scene.world->materials, &liquid, 1, &id));
    scene.world->settings.solver = PBMPM_SOLVER_DUAL;
    scene.world->kernels = scene.kernels;
    scene.step.dimension = dimension;
    fill(scene.world, per_axis);
    scene_bind(&scene, false);
    return scene;
}

static void predict_beside(Scene *scene, bool resting_only)
{
    World *world = scene->world;
    const ContactFrame contacts = {.colliders = &world->colliders, .grid = &world->grid, .cell_size = CELL, .max_displacement = 32.0f};
    const uint32_t mode = float_mode_enter();
    solver_predict(world);
    float_mode_leave(mode);
    colliders_begin_substep(&world->colliders, &world->domain, world->def.dimension, (double)world->def.cell_size, 0, 1);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, contacts_find(&contacts, &world->memory, world->pool));
    contacts_open_volume(&contacts, world->pool, resting_only);
}

static void predict(Scene *scene) { predict_beside(scene, true); }

/* Every particle feels a density of 1, up to `bound`; the largest difference is returned. */
static double density_error(const Scene *scene)
{
    RefGrid nodes = scene_nodes(scene);
    double worst = 0.0;
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle p = scene_particle(scene, i);
        worst = fmax(worst, fabs(reference_compression(&nodes, &p) - 1.0));
    }
    reference_grid_free(&nodes);
    return worst;
}

/* With walls on grid lines a lattice of two particles per axis differs from the integral by 1/4 at nodes a cell behind the wall, whose weight is at
 * most 1/32, and by 1/190 a cell before it: 1 % per wall. Walls anywhere leave nodes that are more than a cell behind them, where the share is taken
 * for larger than it is: by up to 4.5 % per wall for particles at the wall itself. Only the walls of a corner add up. */
static void test_a_full_box_has_its_density(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int per_axis = 2; per_axis <= 4; per_axis++)
            for (int shift = 0; shift < 10; shift++) {
                Scene scene = full_box(cpu_isa(), dimension, 0.1 * shift, per_axis);
                predict(&scene);
                const double worst = density_error(&scene);
                check_subject("full box", cpu_isa(), dimension);
                check_near(0.0, worst, (shift == 0 ? 0.01 : 0.045) * dimension, "density off by", 10 * per_axis + shift);
                scene_close(&scene);
            }
    check_report("full box");
}

/* ---- Edges ---- */

/* A box of one cell at `place` [cells] on all axes. */
static void add_box(World *world, double place)
{
    pbmpm_collider_def def = collider_defaults();
    pbmpm_collider_id id;
    def.shape.kind = PBMPM_BOX;
    for (int a = 0; a < 3; a++) {
        def.shape.position[a] = (float)(place * CELL);
        def.shape.half_extents[a] = (float)(0.5 * CELL);
    }
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, colliders_add(&world->colliders, &world->memory, &def, NULL, 1, &id));
}

/* Whether a block's particles feel a node whose support the box cuts. */
static bool feels(const World *world, int32_t block)
{
    const Obstacle *box = &world->colliders.obstacle[0];
    const int32_t *at = (const int32_t *)world->grid.coordinate.data + 3 * block;
    const int d = world->def.dimension, axis = K_BLOCK_AXIS + 2;
    double normal[3];
    for (int i = 0; i < (d == 3 ? axis * axis * axis : axis * axis); i++) {
        const int node[3] = {i % axis - 1, i / axis % axis - 1, i / axis / axis - 1};
        double point[3] = {0.0};
        for (int a = 0; a < d; a++) point[a] = (world->grid.anchor[a] + at[a] * K_BLOCK_AXIS + node[a]) * CELL;
        if (obstacle_distance(box, point, normal) < 1.5 * CELL) return true;
    }
    return false;
}

static int count_marked(const Scene *scene)
{
    int marked = 0;
    for (int32_t block = 0; block < scene->world->grid.node_blocks; block++) marked += scene->world->args.edged[block] != 0;
    return marked;
}

/* Marked blocks of a full box beside a box of one cell there; none of those that feel it is missed. */
static int marked_blocks(int dimension, bool with_box, double place)
{
    Scene scene = full_box(cpu_isa(), dimension, 0.0, 2);
    if (with_box) add_box(scene.world, place);
    predict(&scene);
    for (int32_t block = 0; with_box && block < scene.world->grid.node_blocks; block++)
        if (feels(scene.world, block)) TEST_ASSERT_EQUAL_UINT32(1, scene.world->args.edged[block]);
    const int marked = count_marked(&scene);
    scene_close(&scene);
    return marked;
}

static void test_blocks_near_edges_are_marked(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        TEST_ASSERT_EQUAL_INT(0, marked_blocks(dimension, false, 0.0)); /* walls are planes */
        TEST_ASSERT_EQUAL_INT(0, marked_blocks(dimension, true, 20.0));
        for (double place = -8.0; place <= 8.0; place += 0.5) marked_blocks(dimension, true, place);
        TEST_ASSERT_GREATER_THAN_INT(0, marked_blocks(dimension, true, 0.0));
    }
}

/* A box on its way takes no room where only what rests does, and marks go with the last obstacle. */
static void test_marks_go_with_the_obstacle(void)
{
    static const float away[3] = {0.2f, 0.0f, 0.0f};
    Scene scene = full_box(cpu_isa(), 3, 0.0, 2);
    Collider *box = scene.world->colliders.slot;
    add_box(scene.world, 0.0);
    box->def.kinematic = 1;
    collider_place(box, away, NULL, false);
    predict_beside(&scene, true);
    TEST_ASSERT_EQUAL_INT(0, count_marked(&scene));
    predict_beside(&scene, false);
    TEST_ASSERT_GREATER_THAN_INT(0, count_marked(&scene));
    box->generation = 0;
    scene.world->domain.enabled = false;
    predict(&scene);
    TEST_ASSERT_EQUAL_INT(0, count_marked(&scene));
    scene_close(&scene);
}

/* ---- Images ---- */

static void shake(Scene *scene, Random *random)
{
    float *node = scene->world->args.node;
    const size_t count = (size_t)scene->world->grid.node_blocks * (size_t)scene->world->grid.block_cells;
    for (size_t i = 0; i < count; i++)
        for (int a = 0; a < scene->step.dimension && node[i * K_NODE_WIDTH + 3] > 0.0f; a++)
            node[i * K_NODE_WIDTH + (size_t)a] = (float)random_in(random, -1.0, 1.0);
}

static const RefNode *node_at(const RefGrid *grid, const int32_t at[3])
{
    const int64_t index = reference_index(grid, at);
    return index < 0 ? NULL : &grid->node[index];
}

/* Each node behind a wall is the reflection of the one as far before it: a cell, or half a cell where the wall stands between nodes. */
static void check_reflections(const Scene *scene, const Domain *domain, const RefGrid *node)
{
    int32_t at[3] = {0}, other[3];
    long pairs = 0;
    for (int axis = 0; axis < node->dimension; axis++)
        for (int upper = 0; upper < 2; upper++) {
            const long twice = lround(2.0 * (upper ? domain->high : domain->low)[axis] / CELL), apart = twice % 2 == 0 ? 2 : 1;
            for (at[2] = node->low[2]; at[2] < node->low[2] + node->size[2]; at[2]++)
                for (at[1] = node->low[1]; at[1] < node->low[1] + node->size[1]; at[1]++)
                    for (at[0] = node->low[0]; at[0] < node->low[0] + node->size[0]; at[0]++) {
                        if (2 * at[axis] != twice + (upper ? apart : -apart)) continue;
                        memcpy(other, at, sizeof other);
                        other[axis] = (int32_t)(twice - at[axis]);
                        const RefNode *image = node_at(node, at), *real = node_at(node, other);
                        if (!image || !real || image->mass == 0.0 || real->mass == 0.0) continue;
                        for (int a = 0; a < node->dimension; a++)
                            check_near(a == axis ? -real->u[a] : real->u[a], image->u[a], 4.0 * UNIT_ROUNDOFF, "image", axis * 2 + upper);
                        pairs++;
                    }
        }
    check_true(pairs > 10 * scene->step.dimension, "walls have images", pairs);
}

/* Particles of one mass on a lattice have nodes whose masses are products of one factor per axis: an edge then has the same shares along both its walls. */
static void make_uneven(Scene *scene, Random *random)
{
    Particles *p = &scene->world->particles;
    for (uint32_t i = 0; i < p->count; i++) p->mass[i] *= (float)random_in(random, 0.2, 2.0);
}

/* What the walls booked is what the nodes got; walls without friction give nothing along themselves. */
static void check_books(const Mirrors *mirrors, const RefGrid *before, const RefGrid *after)
{
    const size_t count = (size_t)after->size[0] * (size_t)after->size[1] * (size_t)after->size[2];
    double gained[3] = {0}, booked[3] = {0}, moved = 0.0;
    for (size_t i = 0; i < count; i++)
        for (int a = 0; a < after->dimension; a++) {
            const double change = after->node[i].mass * (after->node[i].u[a] - before->node[i].u[a]);
            gained[a] += change;
            moved += fabs(change);
        }
    for (int axis = 0; axis < after->dimension; axis++) {
        const double *book = mirrors->booked[axis].data;
        double along = 0.0;
        for (uint32_t i = 0; i < 6 * mirrors->count[axis]; i++) {
            booked[i % 3] += book[i];
            if ((int)(i % 3) == (axis + 1) % after->dimension) along += book[i];
        }
        check_near(0.0, along, 8.0 * UNIT_ROUNDOFF * moved, "along the wall", axis);
    }
    for (int a = 0; a < after->dimension; a++) check_near(gained[a], booked[a], 8.0 * UNIT_ROUNDOFF * moved, "booked", a);
}

/* The projection is orthogonal in the metric of the masses: what it takes is orthogonal to what it leaves, so it never adds energy, and a second
 * time it changes nothing. */
static void check_images(int dimension, double shift)
{
    Random random = {5};
    Scene scene = full_box(cpu_isa(), dimension, shift, 2);
    World *world = scene.world;
    const Domain domain = mirror_domain(&world->domain, dimension, CELL);
    make_uneven(&scene, &random);
    predict(&scene);
    RefGrid found = scene_nodes(&scene);
    TEST_ASSERT_TRUE(mirrors_find(&world->mirrors, &world->memory, &world->grid, &domain, CELL));
    TEST_ASSERT_TRUE(mirrors_any(&world->mirrors));
    TEST_ASSERT_TRUE(mirrors_measure(&world->mirrors, &world->memory, true));
    shake(&scene, &random);
    RefGrid before = scene_nodes(&scene);
    mirrors_apply(&world->mirrors, &world->grid, NULL);
    RefGrid after = scene_nodes(&scene);
    check_subject("images", cpu_isa(), dimension);
    check_reflections(&scene, &domain, &after);
    check_books(&world->mirrors, &before, &after);
    double along = 0.0, energy = 0.0;
    const size_t count = (size_t)after.size[0] * (size_t)after.size[1] * (size_t)after.size[2];
    for (size_t i = 0; i < count; i++) TEST_ASSERT_TRUE(found.node[i].mass == after.node[i].mass);
    for (size_t i = 0; i < count; i++)
        for (int a = 0; a < dimension; a++) {
            along += after.node[i].mass * (before.node[i].u[a] - after.node[i].u[a]) * after.node[i].u[a];
            energy += after.node[i].mass * before.node[i].u[a] * before.node[i].u[a];
        }
    check_near(0.0, along, 8.0 * UNIT_ROUNDOFF * energy, "orthogonal", 0);
    mirrors_apply(&world->mirrors, &world->grid, NULL);
    RefGrid again = scene_nodes(&scene);
    reference_grid_free(&found);
    for (size_t i = 0; i < count; i++)
        for (int a = 0; a < dimension; a++) check_near(after.node[i].u[a], again.node[i].u[a], 8.0 * UNIT_ROUNDOFF, "a second time", (long)i);
    reference_grid_free(&before);
    reference_grid_free(&after);
    reference_grid_free(&again);
    scene_close(&scene);
}

static void test_images_are_an_orthogonal_projection(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int k = 0; k < 4; k++) check_images(dimension, 0.25 * k);
}

/* Marked blocks hold both nodes of a pair, and their images alone are made, the same as if all were. */
static void check_marked_images(int dimension)
{
    Random random = {6};
    Scene scene = full_box(cpu_isa(), dimension, 0.0, 2);
    World *world = scene.world;
    const Grid *grid = &world->grid;
    const Domain domain = mirror_domain(&world->domain, dimension, CELL);
    const size_t block_floats = (size_t)grid->block_cells * K_NODE_WIDTH, floats = (size_t)grid->node_blocks * block_floats;
    predict(&scene);
    TEST_ASSERT_TRUE(mirrors_find(&world->mirrors, &world->memory, grid, &domain, CELL));
    shake(&scene, &random);
    float *node = grid->node.data, *start = malloc(floats * sizeof *start), *marked = malloc(floats * sizeof *marked);
    uint8_t *mark = calloc((size_t)grid->node_blocks, 1);
    TEST_ASSERT_TRUE(start && marked && mark);
    memcpy(start, node, floats * sizeof *start);
    mark[0] = 1;
    mirrors_close(&world->mirrors, grid, mark);
    mirrors_apply(&world->mirrors, grid, mark);
    memcpy(marked, node, floats * sizeof *marked);
    memcpy(node, start, floats * sizeof *start);
    mirrors_apply(&world->mirrors, grid, NULL);
    int32_t touched = 0, changed = 0;
    for (int32_t block = 0; block < grid->node_blocks; block++) {
        const size_t first = (size_t)block * block_floats;
        touched += mark[block];
        changed += memcmp(start + first, marked + first, block_floats * sizeof *start) != 0;
        TEST_ASSERT_EQUAL_MEMORY(mark[block] ? node + first : start + first, marked + first, block_floats * sizeof *start);
    }
    TEST_ASSERT_TRUE(changed > 0 && touched < grid->node_blocks);
    free(start);
    free(marked);
    free(mark);
    scene_close(&scene);
}

static void test_images_of_marked_blocks(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) check_marked_images(dimension);
}

/* On the next grid line or midpoint inside, less than half a cell away. */
static void test_where_walls_with_images_stand(void)
{
    for (int shift = 0; shift < 20; shift++) {
        Scene scene = full_box(cpu_isa(), 2, 0.1 * shift, 2);
        const Domain *domain = &scene.world->domain, inside = mirror_domain(domain, 2, CELL);
        for (int a = 0; a < 2; a++) {
            const double moved[] = {(inside.low[a] - domain->low[a]) / CELL, (domain->high[a] - inside.high[a]) / CELL};
            const double place[] = {2.0 * inside.low[a] / CELL, 2.0 * inside.high[a] / CELL};
            for (int upper = 0; upper < 2; upper++) {
                TEST_ASSERT_TRUE(moved[upper] > -0.01 && moved[upper] < 0.5);
                TEST_ASSERT_DOUBLE_WITHIN(1e-9, round(place[upper]), place[upper]);
            }
        }
        scene_close(&scene);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_open_share_is_the_integral_of_the_spline);
    RUN_TEST(test_the_open_share_ends_at_the_support);
    RUN_TEST(test_surfaces_that_lie_on_each_other_count_once);
    RUN_TEST(test_a_full_box_has_its_density);
    RUN_TEST(test_blocks_near_edges_are_marked);
    RUN_TEST(test_marks_go_with_the_obstacle);
    RUN_TEST(test_images_are_an_orthogonal_projection);
    RUN_TEST(test_images_of_marked_blocks);
    RUN_TEST(test_where_walls_with_images_stand);
    return UNITY_END();
}
