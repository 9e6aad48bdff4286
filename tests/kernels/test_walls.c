/* Nodes at walls: the share of them that is open, the density of a full box at rest, and what motion walls admit. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "base/cpu.h"
#include "bounds.h"
#include "check.h"
#include "contact/contacts_find.h"
#include "contact/flowing.h"
#include "contact/open_volume.h"
#include "contact/wall_bodies.h"
#include "contact/walls.h"
#include "scene.h"
#include "services/lifecycle.h"
#include "solvers/passes.h"
#include "solvers/solver.h"

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

static double share_at(const Colliders *colliders, const double node[3])
{
    const Grid grid = {.dimension = 2};
    Colliders some = *colliders;
    const ContactFrame frame = {.colliders = &some, .grid = &grid, .cell_size = CELL};
    return open_share_at(&frame, node, ALL_GROUPS);
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
            const double share = share_at(&one, node), bound = degrees % 90 == 0 ? 0.75 * 0.005 + 1e-6 : 0.01;
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
        TEST_ASSERT_DOUBLE_WITHIN(1e-12, shares[i], share_at(&one, node));
    }
}

/* Of planes that face the same way the deepest counts; planes across an edge hide volumes of their own. */
static void test_surfaces_that_lie_on_each_other_count_once(void)
{
    Obstacle planes[3] = {plane_at(0.0), plane_at(0.0), plane_at(acos(0.0))};
    const double node[3] = {0.3 * CELL, -0.2 * CELL, 0.0};
    const Colliders first = {.obstacle = planes, .obstacle_count = 1}, both = {.obstacle = planes, .obstacle_count = 2};
    const Colliders across = {.obstacle = planes + 2, .obstacle_count = 1}, all = {.obstacle = planes, .obstacle_count = 3};
    const double share = share_at(&first, node);
    TEST_ASSERT_EQUAL_DOUBLE(share, share_at(&both, node));
    TEST_ASSERT_DOUBLE_WITHIN(1e-15, share * share_at(&across, node), share_at(&all, node));
    for (int i = 0; i < 2; i++) { /* whichever is the deeper one */
        planes[i].end.position[0] = 0.25 * CELL;
        const Colliders deeper = {.obstacle = planes + i, .obstacle_count = 1};
        const double least = share_at(&deeper, node);
        TEST_ASSERT_TRUE(least < share);
        TEST_ASSERT_EQUAL_DOUBLE(least, share_at(&both, node));
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
    Scene scene = {.kernels = kernels_for(isa, dimension), .pressure_max = FLT_MAX, .growth_max = FLT_MAX, .head2 = FLT_MAX};
    const pbmpm_material_def liquid = scene_material(PBMPM_LIQUID);
    pbmpm_material_id id;
    def.dimension = dimension;
    def.cell_size = (float)CELL;
    def.particle_capacity = 16384;
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
    ContactFrame contacts = {.colliders = &world->colliders, .grid = &world->grid, .cell_size = CELL, .max_displacement = 32.0f};
    const uint32_t mode = float_mode_enter();
    solver_predict(world);
    float_mode_leave(mode);
    colliders_begin_substep(&world->colliders, &world->domain, world->def.dimension, 0, 1);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, contacts_measure(&contacts, &world->memory, world->pool));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, contacts_find(&contacts, &world->memory, world->pool));
    TEST_ASSERT_TRUE(contacts_open_volume(&contacts, &world->memory, world->pool, resting_only));
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

static void open_walls(World *world)
{
    for (int place = 0; place < DOMAIN_WALLS; place++) world->domain.wall[place].open = 1;
}

/* ---- The push of an even pressure ---- */

/* The volume that a spline at a place finds [cells^d], with all particles. */
static double volume_around(const World *world, const double place[3])
{
    const Particles *p = &world->particles;
    double sum = 0.0;
    for (uint32_t i = 0; i < p->count; i++) {
        double weight = (double)p->mass[i] / 1000.0;
        for (int a = 0; a < p->dimension; a++) weight *= spline(p->cell[a][i] + (double)p->fraction[a][i] - place[a]);
        sum += weight;
    }
    return sum;
}

/* It is the slope of that volume as the node moves, here by central differences whose error is h^2 / 6 times third derivatives: 0 but where pieces of splines meet,
 * of which each contributes up to h times the particles there. */
static void test_the_push_of_an_even_pressure_is_a_slope_of_volume(void)
{
    const double h = 1e-5;
    for (int dimension = 2; dimension <= 3; dimension++) {
        Scene scene = full_box(cpu_isa(), dimension, 0.3, 2);
        World *world = scene.world;
        int pushed = 0;
        predict(&scene);
        const ContactFrame frame = {.grid = &world->grid, .cell_size = CELL, .pressed = &world->particles, .kernel = world->materials.kernel};
        for (int32_t block = 0; block < world->grid.node_blocks; block++)
            for (int node = 0; node < world->grid.block_cells; node += dimension == 2 ? 1 : 5) {
                const FlowingSite site = {&frame, block, {node & 3, node >> 2 & 3, node >> 4}};
                double point[3], push[3];
                contacts_node_position(&frame, block, node, point);
                for (int a = 0; a < 3; a++) point[a] = round(point[a] / CELL);
                flowing_push(&site, push);
                pushed += fabs(push[0]) + fabs(push[1]) + fabs(push[2]) > 0.1;
                for (int a = 0; a < dimension; a++) {
                    double above[3] = {point[0], point[1], point[2]}, below[3] = {point[0], point[1], point[2]};
                    above[a] += h;
                    below[a] -= h;
                    TEST_ASSERT_DOUBLE_WITHIN(10.0 * h, (volume_around(world, above) - volume_around(world, below)) / (2.0 * h), push[a]);
                }
            }
        TEST_ASSERT_GREATER_THAN_INT(10, pushed);
        scene_close(&scene);
    }
}

/* On a single plane what is far from all other ends of the matter has its density, too. */
static void check_layer(int dimension, double height)
{
    enum { WIDE = 12, MARGIN = 4 };
    Scene scene = full_box(cpu_isa(), dimension, 0.0, 2);
    World *world = scene.world;
    const pbmpm_collider_def def = collider_defaults();
    pbmpm_shape floor = shape_defaults();
    pbmpm_collider_id id;
    double worst = 0.0;
    int inner = 0;
    for (int a = 0; a < dimension; a++) {
        world->domain.low[a] = a == 1 ? height * CELL : 0.0;
        world->domain.high[a] = world->domain.low[a] + (a == 1 ? 6 : WIDE) * CELL;
    }
    world->particles.count = 0;
    fill(world, 2);
    open_walls(world);
    floor.kind = PBMPM_PLANE;
    floor.position[1] = (float)(height * CELL);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, colliders_add(&world->colliders, &world->memory, &def, &floor, NULL, 1, &id));
    scene_bind(&scene, false);
    predict(&scene);
    RefGrid nodes = scene_nodes(&scene);
    for (uint32_t i = 0; i < world->particles.count; i++) {
        const RefParticle p = scene_particle(&scene, i);
        bool far = particles_coordinate(&world->particles, i, 1) < height + 3.0;
        for (int a = 0; a < dimension; a += 2) {
            const double x = particles_coordinate(&world->particles, i, a);
            far = far && x > MARGIN && x < WIDE - MARGIN;
        }
        if (!far) continue;
        worst = fmax(worst, fabs(reference_compression(&nodes, &p) - 1.0));
        inner++;
    }
    reference_grid_free(&nodes);
    TEST_ASSERT_GREATER_THAN_INT(20, inner);
    check_near(0.0, worst, 0.045, "density off by", (int)(10.0 * height));
    scene_close(&scene);
}

static void test_a_layer_on_a_plane_has_its_density(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int shift = 0; shift < 10; shift++) {
            check_subject("layer", cpu_isa(), dimension);
            check_layer(dimension, 0.1 * shift);
        }
    check_report("layer");
}

/* ---- Edges ---- */

/* A box of one cell at `place` [cells] on all axes. */
static void add_box(World *world, double place)
{
    const pbmpm_collider_def def = collider_defaults();
    pbmpm_shape shape = shape_defaults();
    pbmpm_collider_id id;
    shape.kind = PBMPM_BOX;
    for (int a = 0; a < 3; a++) {
        shape.position[a] = (float)(place * CELL);
        shape.half_extents[a] = (float)(0.5 * CELL);
    }
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, colliders_add(&world->colliders, &world->memory, &def, &shape, NULL, 1, &id));
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
    for (int32_t block = 0; block < scene->world->grid.node_blocks; block++) marked += scene->world->args.grid.edged[block] != 0;
    return marked;
}

/* Marked blocks of a full box beside a box of one cell there; none of those that feel it is missed. */
static int marked_blocks(int dimension, bool with_box, double place)
{
    Scene scene = full_box(cpu_isa(), dimension, 0.0, 2);
    if (with_box) add_box(scene.world, place);
    predict(&scene);
    for (int32_t block = 0; with_box && block < scene.world->grid.node_blocks; block++)
        if (feels(scene.world, block)) TEST_ASSERT_EQUAL_UINT32(1, scene.world->args.grid.edged[block]);
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
    open_walls(scene.world);
    predict(&scene);
    TEST_ASSERT_EQUAL_INT(0, count_marked(&scene));
    scene_close(&scene);
}

/* ---- Motion at walls ---- */

static size_t count_nodes(const Scene *scene) { return (size_t)scene->world->grid.node_blocks * (size_t)scene->world->grid.block_cells; }

/* Lists the nodes at walls of a predicted scene. `liquid`: of what walls hold; else of what they let go. */
static ContactFrame find_walls_of(Scene *scene, bool liquid)
{
    World *world = scene->world;
    world->substep = substep_of(1.0 / 60.0, CELL);
    ContactFrame frame = {.colliders = &world->colliders, .grid = &world->grid, .cell_size = CELL, .substep = &world->substep, .max_displacement = 32.0f, .liquid = liquid};
    predict(scene);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, contacts_measure(&frame, &world->memory, world->pool));
    world->colliders.contacts = 0;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, walls_find(&world->walls, &frame, &world->memory, world->pool));
    TEST_ASSERT_TRUE(walls_any(&world->walls));
    return frame;
}

static ContactFrame find_walls(Scene *scene) { return find_walls_of(scene, true); }

/* Displacements of the nodes from a pressure that is the same everywhere: q = sum_p m w (x_i - x_p), over the node's mass. */
static void press_evenly(Scene *scene)
{
    World *world = scene->world;
    float *node = world->args.grid.node;
    for (size_t i = 0; i < count_nodes(scene); i++)
        for (size_t a = 0; a < 3; a++) node[i * K_NODE_WIDTH + a] = 0.0f;
    TEST_ASSERT_TRUE(array_reserve(&world->memory, &world->dual.cells, count_nodes(scene), sizeof(float)));
    float *pressure = world->dual.cells.data;
    for (size_t i = 0; i < count_nodes(scene); i++) pressure[i] = 1.0f;
    world->args.cells.pressure = world->args.cells.pressure_old = pressure;
    for (int slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) world->materials.kernel[slot].lightness = 1.0f;
    world->args.cells.probing = 1;
    solver_over_both(world, world->kernels->cells_push, world->kernels->respond_nodes, NULL);
    world->args.cells.probing = 0;
}

static double largest(const Scene *scene)
{
    const float *node = scene->world->args.grid.node;
    double most = 0.0;
    for (size_t i = 0; i < count_nodes(scene); i++)
        for (size_t a = 0; a < 3; a++) most = fmax(most, fabs((double)node[i * K_NODE_WIDTH + a]));
    return most;
}

/* Relative error of a node's sum of terms of one sign, see bounds.h: four particles a cell and axis within three cells. */
static double rounding_of_sums(int dimension)
{
    return (pow(12, dimension) + TRANSFER_ROUNDINGS) * UNIT_ROUNDOFF;
}

/* On grid lines and midway the lattice is its own reflection; elsewhere the linear profile meets the sums of eight particles per axis to a thousandth. */
static void test_an_even_pressure_moves_nothing_in_a_full_box(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int shift = 0; shift < 10; shift++) {
            Scene scene = full_box(cpu_isa(), dimension, 0.1 * shift, 4);
            ContactFrame frame = find_walls(&scene);
            press_evenly(&scene);
            const double before = largest(&scene);
            walls_apply(&scene.world->walls, &frame, scene.world->pool, true, NULL);
            check_subject("even pressure", cpu_isa(), dimension);
            check_true(before > 0.5, "it pushes nodes", shift);
            check_near(0.0, largest(&scene), shift % 5 == 0 ? before * rounding_of_sums(dimension) : 1e-3, "moves nodes", shift);
            scene_close(&scene);
        }
    check_report("even pressure");
}

/* A full box with another box of four cells in it, both as far off the grid. */
static Scene box_in_a_box(int dimension, double shift)
{
    Scene scene = full_box(cpu_isa(), dimension, shift, 2);
    World *world = scene.world;
    const pbmpm_collider_def def = collider_defaults();
    pbmpm_shape shape = shape_defaults();
    pbmpm_collider_id id;
    uint32_t kept = 0;
    for (int a = 0; a < dimension; a++) {
        world->domain.low[a] = (shift - 4.0) * CELL;
        world->domain.high[a] = (shift + 6.0) * CELL;
        shape.position[a] = (float)((shift + 1.0) * CELL);
        shape.half_extents[a] = (float)(2.0 * CELL);
    }
    shape.kind = PBMPM_BOX;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, colliders_add(&world->colliders, &world->memory, &def, &shape, NULL, 1, &id));
    world->particles.count = 0;
    fill(world, dimension == 2 ? 4 : 2); /* its capacity bounds that */
    for (uint32_t i = 0; i < world->particles.count; i++) {
        bool inside = true;
        for (int a = 0; a < dimension; a++) inside = inside && fabs(particles_coordinate(&world->particles, i, a) - shift - 1.0) < 2.0;
        world->particles.mass[i] *= inside ? 0.0f : 1.0f;
        kept += !inside;
    }
    TEST_ASSERT_GREATER_THAN_UINT32(1000, kept);
    scene_bind(&scene, false);
    return scene;
}

/* A right-angled edge that the spline rounds loses about a quarter of a cell, as area per length. The weights that walls give at the four edges of a box in 2D add up to
 * that, wherever they lie on the grid: its sum of w (phi~ - phi) is 0.20 to 0.26 there. A flat wall gives none. */
static void test_edges_give_the_weight_that_the_spline_cuts_off(void)
{
    static const float gravity[3] = {0.0f, -1.0f, 0.0f};
    for (int shift = 0; shift < 10; shift++)
        for (int edged = 0; edged < 2; edged++) {
            Scene scene = edged ? box_in_a_box(2, 0.1 * shift) : full_box(cpu_isa(), 2, 0.1 * shift, 4);
            World *world = scene.world;
            ContactFrame frame = find_walls(&scene);
            float *node = world->args.grid.node, *base = calloc(count_nodes(&scene) * K_NODE_WIDTH, sizeof *base);
            double sum[2] = {0.0, 0.0}, full = 0.0;
            TEST_ASSERT_NOT_NULL(base);
            for (size_t i = 0; i < count_nodes(&scene); i++)
                for (size_t a = 0; a < 3; a++) node[i * K_NODE_WIDTH + a] = 0.0f;
            walls_weigh(&world->walls, &frame, gravity, base);
            for (size_t i = 0; i < count_nodes(&scene); i++) {
                const float *u = node + i * K_NODE_WIDTH;
                full = fmax(full, (double)u[3]);
                for (int a = 0; a < 2; a++) {
                    sum[a] += (double)(u[3] * u[a]);
                    TEST_ASSERT_EQUAL_FLOAT(u[a], base[i * K_NODE_WIDTH + (size_t)a]);
                }
            }
            check_subject("edges", cpu_isa(), 2);
            check_near(0.0, sum[0], 0.0, "across gravity", shift);
            check_near(edged ? -4.0 * 0.23 : 0.0, sum[1] / full, edged ? 4.0 * 0.04 : 0.0, "cut off", shift);
            free(base);
            scene_close(&scene);
        }
    check_report("edges");
}

/* Folded at walls, the density of a full box is 1 wherever the walls stand: better by far than what nodes hold over their own open shares.
 * On grid lines and midway it is off by rounding alone, of the mass and of the open share. */
static void test_the_density_at_walls_is_folded(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int shift = 0; shift < 10; shift++) {
            Scene scene = full_box(cpu_isa(), dimension, 0.1 * shift, 4);
            ContactFrame frame = find_walls(&scene);
            frame.walls = &scene.world->walls;
            solver_predict(scene.world);
            TEST_ASSERT_TRUE(contacts_open_volume(&frame, &scene.world->memory, scene.world->pool, false));
            check_subject("folded density", cpu_isa(), dimension);
            check_near(0.0, density_error(&scene), shift % 5 == 0 ? 2.0 * rounding_of_sums(dimension) : 2e-3 * dimension, "density off by", shift);
            scene_close(&scene);
        }
    check_report("folded density");
}

/* m-weighted products. */
static double product(const Scene *scene, const float *a, const float *b)
{
    const float *node = scene->world->args.grid.node;
    double sum = 0.0;
    for (size_t i = 0; i < count_nodes(scene); i++)
        for (size_t k = 0; k < 3; k++) sum += (double)node[i * K_NODE_WIDTH + 3] * (double)a[i * K_NODE_WIDTH + k] * (double)b[i * K_NODE_WIDTH + k];
    return sum;
}

static void shake(Scene *scene, Random *random)
{
    float *node = scene->world->args.grid.node;
    for (size_t i = 0; i < count_nodes(scene); i++)
        for (int a = 0; a < scene->step.dimension && node[i * K_NODE_WIDTH + 3] > 0.0f; a++)
            node[i * K_NODE_WIDTH + (size_t)a] = (float)random_in(random, -1.0, 1.0);
}

/* A plane that cuts a corner off the box, askew to all axes. */
static void add_slope(World *world)
{
    const double half[4] = {0.15, -0.2, 0.35, 0.0}, in_plane[4] = {0.0, 0.0, 0.35, 0.0}, *turn = world->def.dimension == 3 ? half : in_plane;
    const pbmpm_collider_def def = collider_defaults();
    pbmpm_shape shape = shape_defaults();
    pbmpm_collider_id id;
    double rest = 1.0;
    shape.kind = PBMPM_PLANE;
    for (int a = 0; a < 3; a++) {
        shape.position[a] = (float)((a - 2.0) * CELL);
        shape.rotation[a] = (float)turn[a];
        rest -= turn[a] * turn[a];
    }
    shape.rotation[3] = (float)sqrt(rest);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, colliders_add(&world->colliders, &world->memory, &def, &shape, NULL, 1, &id));
}

/* Lets the box in a box go: a rigid body without friction of a tenth of the water's density. */
static void set_free(World *world)
{
    const int dimension = world->def.dimension;
    const double side = 4.0 * CELL, mass = 100.0 * pow(side, dimension), inertia = mass * side * side / 6.0;
    Collider *box = &world->colliders.slot[0];
    box->def.friction = PBMPM_FRICTION_SLIP;
    FreeBody *body = collider_body(box, &world->memory);
    TEST_ASSERT_NOT_NULL(body);
    body->ways = dimension == 3 ? 6 : 3;
    for (int a = 0; a < dimension; a++) {
        body->way[a][a] = 1.0 / sqrt(mass);
        body->centre[a] = (double)box->shape.position[a];
    }
    for (int k = dimension; k < body->ways; k++) body->way[k][dimension == 3 ? k : 5] = 1.0 / sqrt(inertia);
    memcpy(body->open, body->way, sizeof body->open);
}

typedef enum WallScene { UPRIGHT, SLOPED, EDGED, FREE } WallScene;

/* Random masses and motions, and the motion that the walls make of themselves most of. */
static void check_norm(int dimension, int shift, WallScene walls, bool liquid)
{
    Random random = {5};
    Scene scene = walls >= EDGED ? box_in_a_box(dimension, 0.1 * shift) : full_box(cpu_isa(), dimension, 0.1 * shift, 2);
    if (walls == SLOPED) add_slope(scene.world);
    if (walls == FREE) set_free(scene.world);
    for (uint32_t i = 0; i < scene.world->particles.count; i++) scene.world->particles.mass[i] *= (float)random_in(&random, 0.2, 2.0);
    ContactFrame frame = find_walls_of(&scene, liquid);
    const size_t floats = count_nodes(&scene) * K_NODE_WIDTH;
    float *node = scene.world->args.grid.node, *first = malloc(floats * sizeof *first), *second = malloc(floats * sizeof *second), *of_first = malloc(floats * sizeof *first);
    TEST_ASSERT_TRUE(first && second && of_first);
    shake(&scene, &random);
    walls_apply(&scene.world->walls, &frame, scene.world->pool, false, NULL); /* those that leave are let go */
    shake(&scene, &random);
    memcpy(first, node, floats * sizeof *node);
    walls_apply(&scene.world->walls, &frame, scene.world->pool, true, NULL);
    memcpy(of_first, node, floats * sizeof *node);
    shake(&scene, &random);
    memcpy(second, node, floats * sizeof *node);
    walls_apply(&scene.world->walls, &frame, scene.world->pool, true, NULL);
    const double size = sqrt(product(&scene, first, first) * product(&scene, second, second));
    check_near(product(&scene, second, of_first), product(&scene, first, node), 1e-5 * size, "symmetric", shift);
    for (int round = 0; round < 50; round++) {
        memcpy(first, node, floats * sizeof *node);
        walls_apply(&scene.world->walls, &frame, scene.world->pool, true, NULL);
        const double before = product(&scene, first, first), norm = sqrt(product(&scene, node, node) / before);
        check_near(fmin(norm, 1.0), norm, 1e-5, "norm", shift);
    }
    free(first);
    free(second);
    free(of_first);
    scene_close(&scene);
}

/* Nodes that are held, as where matter sleeps, do not answer, whatever the walls make of the others. */
static void test_held_nodes_do_not_answer(void)
{
    enum { BLOCKS_MOST = 1000 };
    static uint64_t held[BLOCKS_MOST];
    for (int dimension = 2; dimension <= 3; dimension++) {
        Random random = {3};
        Scene scene = full_box(cpu_isa(), dimension, 0.3, 2);
        World *world = scene.world;
        ContactFrame frame = find_walls(&scene);
        TEST_ASSERT_TRUE(world->grid.node_blocks <= BLOCKS_MOST);
        for (int32_t block = 0; block < world->grid.node_blocks; block++) held[block] = 0x5a5a5a5a5a5a5a5a >> block % 2;
        frame.held = held;
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, walls_find(&world->walls, &frame, &world->memory, world->pool));
        frame.walls = &world->walls;
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, contacts_find(&frame, &world->memory, world->pool));
        shake(&scene, &random);
        walls_apply(&world->walls, &frame, world->pool, true, NULL);
        const float *node = world->args.grid.node;
        int rest = 0, move = 0;
        for (size_t i = 0; i < count_nodes(&scene); i++) {
            const size_t cells = (size_t)world->grid.block_cells;
            const float *u = node + i * K_NODE_WIDTH;
            if (!(u[3] > 0.0f)) continue;
            const bool moves = u[0] != 0.0f || u[1] != 0.0f || u[2] != 0.0f;
            if (held[i / cells] >> i % cells & 1) {
                TEST_ASSERT_FALSE_MESSAGE(moves, "a held node moves");
                rest++;
            } else {
                move += moves;
            }
        }
        TEST_ASSERT_TRUE(rest > 10 && move > 10);
        scene_close(&scene);
    }
}

/* The value of a push q, see walls_value(), with u its displacements; base and push: 4 floats per node. */
static double value_of(Scene *scene, ContactFrame *frame, const float *base, const float *push)
{
    World *world = scene->world;
    float *node = world->args.grid.node;
    double value = 0.0;
    for (size_t i = 0; i < count_nodes(scene) * K_NODE_WIDTH; i += K_NODE_WIDTH)
        for (size_t a = i; a < i + 3 && node[i + 3] > 0.0f; a++) node[a] = base[a] + push[a] / node[i + 3];
    walls_apply(&world->walls, frame, world->pool, false, NULL);
    for (size_t i = 0; i < count_nodes(scene); i++) {
        const float *u = node + i * K_NODE_WIDTH, *b = base + i * K_NODE_WIDTH, *q = push + i * K_NODE_WIDTH;
        if (walls_list(&world->walls, (uint32_t)i))
            value += (double)walls_value(&world->walls, (uint32_t)i, u, b, q);
        else
            for (int a = 0; a < 3; a++) value += 0.5 * (double)(u[3] * (u[a] - b[a]) * (u[a] - b[a])) - (double)(q[a] * u[a]);
    }
    return value;
}

/* Its slope is the displacement, its curvature the response. */
static void check_value(int dimension, int shift, bool free_box)
{
    Random random = {7};
    Scene scene = free_box ? box_in_a_box(dimension, 0.1 * shift) : full_box(cpu_isa(), dimension, 0.1 * shift, 2);
    if (free_box) set_free(scene.world);
    ContactFrame frame = find_walls(&scene);
    const size_t floats = count_nodes(&scene) * K_NODE_WIDTH;
    float *node = scene.world->args.grid.node, *base = malloc(floats * sizeof *base), *push = malloc(floats * sizeof *push), *more = malloc(floats * sizeof *more);
    TEST_ASSERT_TRUE(base && push && more);
    shake(&scene, &random);
    memcpy(base, node, floats * sizeof *base);
    shake(&scene, &random);
    for (size_t i = 0; i < floats; i++) push[i] = (i & 3) == 3 ? 0.0f : node[i] * node[i | 3];
    const double before = value_of(&scene, &frame, base, push);
    shake(&scene, &random);
    double slope = 0.0, curvature = 0.0;
    for (size_t i = 0; i < floats; i++) more[i] = (i & 3) == 3 ? 0.0f : node[i] * node[i | 3];
    walls_apply(&scene.world->walls, &frame, scene.world->pool, true, NULL);
    for (size_t i = 0; i < floats; i++) curvature -= (double)(more[i] * node[i]) * ((i & 3) != 3);
    value_of(&scene, &frame, base, push);
    for (size_t i = 0; i < floats; i++) slope -= (double)(more[i] * node[i]) * ((i & 3) != 3);
    for (size_t i = 0; i < floats; i++) more[i] += push[i];
    const double after = value_of(&scene, &frame, base, more);
    check_near(slope + 0.5 * curvature, after - before, 1e-4 * (fabs(slope) + fabs(curvature)), "value", shift);
    free(base);
    free(push);
    free(more);
    scene_close(&scene);
}

static void test_the_value_of_a_push(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int shift = 0; shift < 20; shift++) check_value(dimension, shift % 10, shift >= 10);
    check_report("value");
}

static void test_walls_are_symmetric_and_never_add_motion(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int shift = 0; shift < 10; shift++)
            for (int walls = UPRIGHT; walls <= FREE; walls++)
                for (int liquid = 0; liquid < 2; liquid++) check_norm(dimension, shift, (WallScene)walls, liquid);
    check_report("walls");
}

/* All matter of a full box goes up or down by half a cell; `part`: the least and the most that nodes below its middle go once walls are obeyed. */
static void move_all(int dimension, int shift, bool liquid, float way, double part[2])
{
    Scene scene = full_box(cpu_isa(), dimension, 0.1 * shift, 2);
    World *world = scene.world;
    ContactFrame frame = find_walls_of(&scene, liquid);
    float *node = world->args.grid.node;
    const double middle = 0.5 * (world->domain.low[1] + world->domain.high[1]);
    for (size_t i = 0; i < count_nodes(&scene); i++)
        for (size_t a = 0; a < 3; a++) node[i * K_NODE_WIDTH + a] = a == 1 && node[i * K_NODE_WIDTH + 3] > 0.0f ? way : 0.0f;
    walls_apply(&world->walls, &frame, world->pool, false, NULL);
    part[0] = INFINITY;
    part[1] = -INFINITY;
    for (size_t i = 0; i < count_nodes(&scene); i++) {
        const int cells = world->grid.block_cells;
        double point[3];
        contacts_node_position(&frame, (int32_t)i / cells, (int)i % cells, point);
        if (!(node[i * K_NODE_WIDTH + 3] > 0.0f) || point[1] > middle) continue;
        part[0] = fmin(part[0], (double)node[i * K_NODE_WIDTH + 1]);
        part[1] = fmax(part[1], (double)node[i * K_NODE_WIDTH + 1]);
    }
    scene_close(&scene);
}

static void check_shaken(int dimension, int shift)
{
    Random random = {13};
    Scene scene = full_box(cpu_isa(), dimension, 0.1 * shift, 2);
    ContactFrame frame = find_walls_of(&scene, false);
    const float *node = scene.world->args.grid.node;
    for (int round = 0; round < 20; round++) {
        shake(&scene, &random);
        const double before = product(&scene, node, node);
        walls_apply(&scene.world->walls, &frame, scene.world->pool, false, NULL);
        const double after = product(&scene, node, node);
        check_near(fmin(after, before), after, 1e-5 * before, "moves more", shift);
        check_true(after > 0.2 * before, "some of it is left", shift);
    }
    scene_close(&scene);
}

/* Where solids reach, a floor stops what comes and lets go what leaves; liquid it holds both ways. What moves anyhow never comes to move more. */
static void test_walls_push_solids_and_do_not_pull(void)
{
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int shift = 0; shift < 10; shift++) {
            double solid[2], liquid[2];
            check_subject("unilateral", cpu_isa(), dimension);
            move_all(dimension, shift, false, 0.5f, solid);
            move_all(dimension, shift, true, 0.5f, liquid);
            check_near(0.5, solid[0], 1e-6, "leaves by", shift);
            check_true(liquid[0] < 0.3, "liquid is held", shift);
            move_all(dimension, shift, false, -0.5f, solid);
            move_all(dimension, shift, true, -0.5f, liquid);
            check_near(liquid[0], solid[0], 1e-6, "comes by", shift);
            check_near(liquid[1], solid[1], 1e-6, "is stopped", shift);
            check_true(solid[1] > -0.3, "the floor stops", shift);
            check_shaken(dimension, shift);
        }
    check_report("unilateral");
}

/* What a body yields to is what its walls give, in the substep itself, also where a floor holds it. Sums of floats: a thousandth of the impulse is no rounding. */
static void test_a_body_yields_to_what_its_walls_give(void)
{
    static const double down[6] = {0.0, -1.0, 0.0, 0.0, 0.0, 0.0};
    for (int dimension = 2; dimension <= 3; dimension++)
        for (int shift = 0; shift < 10; shift++) {
            Random random = {11};
            Scene scene = box_in_a_box(dimension, 0.1 * shift);
            World *world = scene.world;
            world->colliders.slot[0].def.measures_impulse = 1;
            TEST_ASSERT_EQUAL_INT(PBMPM_OK, impulses_enable(&world->colliders.impulses, &world->memory));
            impulses_clear(&world->colliders.impulses);
            set_free(world);
            FreeBody *body = world->colliders.slot[0].body;
            if (shift % 2 == 1) free_body_hold(body, down);
            ContactFrame frame = find_walls(&scene);
            shake(&scene, &random);
            walls_apply(&world->walls, &frame, world->pool, true, NULL);
            for (int a = 0; a < 6; a++) TEST_ASSERT_EQUAL_DOUBLE(0.0, ((const WallBody *)world->walls.body.data)->yielded[a]);
            shake(&scene, &random);
            walls_apply(&world->walls, &frame, world->pool, false, NULL);
            walls_book(&world->walls, &frame);
            wall_bodies_keep(&world->walls, &frame);
            const pbmpm_impulse given = impulse_about(&world->colliders.impulses.sum[0], body->centre, dimension);
            const double impulse[6] = {given.linear[0], given.linear[1], given.linear[2]};
            double change[6], size = 0.0;
            free_body_yields_openly(body, impulse, change);
            check_subject("rigid body", cpu_isa(), dimension);
            for (int a = 0; a < dimension; a++) size = fmax(size, fabs(change[a]));
            TEST_ASSERT_TRUE(size > 0.01 && body->walled);
            for (int a = 0; a < dimension; a++) check_near(change[a], body->yielded[a], 1e-3 * size, "yields by", shift);
            scene_close(&scene);
        }
    check_report("rigid body");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_open_share_is_the_integral_of_the_spline);
    RUN_TEST(test_the_open_share_ends_at_the_support);
    RUN_TEST(test_surfaces_that_lie_on_each_other_count_once);
    RUN_TEST(test_a_full_box_has_its_density);
    RUN_TEST(test_the_push_of_an_even_pressure_is_a_slope_of_volume);
    RUN_TEST(test_a_layer_on_a_plane_has_its_density);
    RUN_TEST(test_blocks_near_edges_are_marked);
    RUN_TEST(test_marks_go_with_the_obstacle);
    RUN_TEST(test_walls_are_symmetric_and_never_add_motion);
    RUN_TEST(test_the_value_of_a_push);
    RUN_TEST(test_walls_push_solids_and_do_not_pull);
    RUN_TEST(test_an_even_pressure_moves_nothing_in_a_full_box);
    RUN_TEST(test_edges_give_the_weight_that_the_spline_cuts_off);
    RUN_TEST(test_the_density_at_walls_is_folded);
    RUN_TEST(test_held_nodes_do_not_answer);
    RUN_TEST(test_a_body_yields_to_what_its_walls_give);
    return UNITY_END();
}
