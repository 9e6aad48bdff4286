/* Obstacles: what nodes in contact with them may do, and how poses follow from one step to the next. */
#include <math.h>
#include <string.h>
#include <unity.h>

#include "books.h"
#include "contact/contacts_find.h"
#include "contact/field.h"
#include "contact/push_out.h"
#include "grid/build.h"
#include "random.h"
#include "world/colliders.h"
#include "world/world.h"

void setUp(void) {}
void tearDown(void) {}

static const double CELL_SIZE = 0.5;
static const float LIMIT = 4.0f; /* max_displacement */

/* ---- One contact at one node ---- */

/* A frame with one block of nodes and one contact, which are all that contacts_apply() looks at. */
static void obey_contact(const Contact *contact, float u[3])
{
    static float nodes[64 * K_NODE_WIDTH];
    static uint32_t begin[2] = {0, 1};
    Contact copy = *contact;
    Colliders colliders = {.contact = {&copy, sizeof copy}, .contact_begin = {begin, sizeof begin}, .contacts = 1};
    Grid grid = {.dimension = 3, .block_cells = 64, .node_blocks = 1, .node = {nodes, sizeof nodes}};
    const ContactFrame frame = {.colliders = &colliders, .grid = &grid, .cell_size = CELL_SIZE, .max_displacement = LIMIT};
    for (int i = 0; i < 64 * K_NODE_WIDTH; i++) nodes[i] = (float)i;
    memcpy(nodes + contact->node * K_NODE_WIDTH, u, 3 * sizeof *u);
    contacts_apply(&frame, 0, 1);
    memcpy(u, nodes + contact->node * K_NODE_WIDTH, 3 * sizeof *u);
    for (uint32_t i = 0; i < 64 * K_NODE_WIDTH; i++)
        if (i / K_NODE_WIDTH != contact->node || i % K_NODE_WIDTH == 3) TEST_ASSERT_TRUE(nodes[i] == (float)i); /* others stay */
}

static Contact random_contact(Random *random, pbmpm_friction friction)
{
    Contact contact = {.node = random_below(random, 64), .friction = friction, .coefficient = (float)random_in(random, 0.0, 2.0)};
    double normal[3], length;
    do {
        random_array(random, normal, 3, -1.0, 1.0);
        length = sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    } while (length < 0.2);
    for (int a = 0; a < 3; a++) {
        contact.normal[a] = (float)(normal[a] / length);
        contact.surface[a] = (float)random_in(random, -0.5, 0.5);
    }
    if (random_below(random, 2)) contact.gap = (float)random_in(random, 0.0, 0.5);
    return contact;
}

/* A displacement seen from the surface: along the normal, and along the surface. */
typedef struct Relative {
    double normal, tangent[3], slip;
} Relative;

static Relative relative_to(const Contact *contact, const float u[3])
{
    Relative r = {0};
    double v[3];
    for (int a = 0; a < 3; a++) {
        v[a] = (double)u[a] - (double)contact->surface[a];
        r.normal += v[a] * (double)contact->normal[a];
    }
    for (int a = 0; a < 3; a++) {
        r.tangent[a] = v[a] - r.normal * (double)contact->normal[a];
        r.slip += r.tangent[a] * r.tangent[a];
    }
    r.slip = sqrt(r.slip);
    return r;
}

/* Calls `check` with many contacts and displacements, before and after. */
typedef void CheckContact(const Contact *contact, const float before[3], const float after[3]);

static void each_contact(pbmpm_friction friction, CheckContact *check)
{
    Random random = {(uint64_t)friction + 10};
    for (int i = 0; i < 5000; i++) {
        const Contact contact = random_contact(&random, friction);
        float u[3], before[3];
        for (int a = 0; a < 3; a++) u[a] = (float)random_in(&random, -1.0, 1.0);
        memcpy(before, u, sizeof before);
        obey_contact(&contact, u);
        check(&contact, before, u);
    }
}

static void expect_untouched(const float before[3], const float after[3]) { TEST_ASSERT_EQUAL_MEMORY(before, after, 3 * sizeof *after); }

static void check_coulomb(const Contact *contact, const float before[3], const float after[3])
{
    const Relative r = relative_to(contact, before), s = relative_to(contact, after);
    const double gap = (double)contact->gap, impulse = -gap - r.normal;
    if (impulse <= 0.0) {
        expect_untouched(before, after);
        return;
    }
    const double slip = fmax(0.0, r.slip - (double)contact->coefficient * impulse); /* the cone */
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, -gap, s.normal);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, slip, s.slip);
    for (int a = 0; a < 3; a++) TEST_ASSERT_DOUBLE_WITHIN(1e-5, r.slip > 0.0 ? r.tangent[a] * slip / r.slip : 0.0, s.tangent[a]);
}

static void check_slip(const Contact *contact, const float before[3], const float after[3])
{
    const Relative r = relative_to(contact, before), s = relative_to(contact, after);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, fmax(r.normal, -(double)contact->gap), s.normal);
    for (int a = 0; a < 3; a++) TEST_ASSERT_DOUBLE_WITHIN(1e-5, r.tangent[a], s.tangent[a]);
}

/* Inside, matter goes with the surface whatever it wants; across a gap only when it gets there. */
static void check_stick(const Contact *contact, const float before[3], const float after[3])
{
    const Relative r = relative_to(contact, before), s = relative_to(contact, after);
    const double gap = (double)contact->gap;
    if (contact->gap > 0.0f && r.normal >= -gap) {
        expect_untouched(before, after);
        return;
    }
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, -gap, s.normal);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 0.0, s.slip);
}

static void test_coulomb(void) { each_contact(PBMPM_FRICTION_COULOMB, check_coulomb); }
static void test_slip(void) { each_contact(PBMPM_FRICTION_SLIP, check_slip); }
static void test_stick(void) { each_contact(PBMPM_FRICTION_STICK, check_stick); }

static void test_leaving_is_free(void)
{
    const Contact contact = {.node = 5, .coefficient = 1.0f, .normal = {0, 1, 0}};
    float u[3] = {0.3f, 0.1f, -0.2f};
    obey_contact(&contact, u);
    TEST_ASSERT_TRUE(u[0] == 0.3f && u[1] == 0.1f && u[2] == -0.2f);
}

/* ---- Frames: particles, grid and obstacles ---- */

typedef struct Setting {
    Books books;
    Memory memory;
    Pool *pool;
    Particles particles;
    Grid grid;
    Colliders colliders;
    Domain domain;
    Substep substep;
    ContactFrame frame;
} Setting;

static void setting_open(Setting *s, int dimension, int32_t extent)
{
    *s = (Setting){0};
    s->memory = books_memory(&s->books, 0);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, pool_create(&s->memory, 1, NULL, &s->pool));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_init(&s->particles, &s->memory, dimension, 5000));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, grid_init(&s->grid, &s->memory, dimension, 5000));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, colliders_init(&s->colliders, &s->memory));
    for (int32_t z = dimension == 3 ? -extent : 0; z <= (dimension == 3 ? extent : 0); z++)
        for (int32_t y = -extent; y <= extent; y++)
            for (int32_t x = -extent; x <= extent; x++) {
                const NewParticle particle = {.position = {x, y, z}, .mass = 1.0f};
                particles_append(&s->particles, &particle, s->particles.count + 1);
            }
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, grid_build(&s->grid, &s->memory, &s->particles, s->pool, false));
    const pbmpm_world_def def = world_def_defaults();
    s->domain = domain_of(&def);
    s->substep = substep_of((double)0.01f, CELL_SIZE);
    s->frame = (ContactFrame){.colliders = &s->colliders, .grid = &s->grid, .cell_size = CELL_SIZE, .substep = &s->substep, .max_displacement = LIMIT};
}

static void setting_close(Setting *s)
{
    colliders_free(&s->colliders, &s->memory);
    grid_free(&s->grid, &s->memory);
    particles_free(&s->particles, &s->memory);
    pool_destroy(&s->memory, s->pool, true);
    books_expect_closed(&s->books, &s->memory);
}

static float *node_of(const Setting *s, int32_t block, int node)
{
    return (float *)s->grid.node.data + ((size_t)block * (size_t)s->grid.block_cells + (size_t)node) * K_NODE_WIDTH;
}

/* Gives all nodes the same displacement and a mass of 1, and sets the reach of the blocks. */
static void set_nodes(Setting *s, const float u[3])
{
    float reach = 0.0f;
    for (int a = 0; a < 3; a++) reach = fmaxf(reach, fabsf(u[a]));
    for (int32_t b = 0; b < s->grid.node_blocks; b++) {
        ((float *)s->grid.node_reach.data)[b] = reach;
        for (int i = 0; i < s->grid.block_cells; i++) {
            float *node = node_of(s, b, i);
            for (int a = 0; a < 3; a++) node[a] = a < s->grid.dimension ? u[a] : 0.0f;
            node[3] = 1.0f;
        }
    }
}

static void node_point(const Setting *s, int32_t block, int node, double point[3])
{
    const int32_t *c = (const int32_t *)s->grid.coordinate.data + 3 * block;
    const int local[3] = {node % 4, node / 4 % 4, node / 16};
    for (int a = 0; a < 3; a++)
        point[a] = a < s->grid.dimension ? (s->grid.anchor[a] + 4 * c[a] + local[a]) * CELL_SIZE : 0.0;
}

static void find_and_apply(Setting *s, int part, int parts)
{
    colliders_begin_substep(&s->colliders, &s->domain, s->grid.dimension, part, parts);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, contacts_measure(&s->frame, &s->memory, s->pool));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, contacts_find(&s->frame, &s->memory, s->pool));
    contacts_apply(&s->frame, 0, s->grid.node_blocks);
}

static pbmpm_collider_id add_collider(Setting *s, const pbmpm_shape *shape, pbmpm_friction friction)
{
    pbmpm_collider_def def = collider_defaults();
    pbmpm_collider_id id;
    def.friction = friction;
    def.kinematic = 1;
    TEST_ASSERT_NULL(collider_problem(&def));
    TEST_ASSERT_NULL(shape_problem(shape, s->grid.dimension));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, colliders_add(&s->colliders, &s->memory, &def, shape, NULL, 77, &id));
    return id;
}

/* However nodes move, after their contacts none goes deeper into a plane than it was, and those that cannot reach it move freely. */
static void check_plane(int dimension, const float u[3])
{
    static Setting s;
    pbmpm_shape plane = shape_defaults();
    double normal[3];
    setting_open(&s, dimension, 5);
    plane.kind = PBMPM_PLANE;
    plane.position[1] = 0.13f;
    plane.normal[0] = 0.4f;
    add_collider(&s, &plane, PBMPM_FRICTION_SLIP);
    set_nodes(&s, u);
    find_and_apply(&s, 0, 1);
    const Solid solid = solid_of(&plane, dimension);
    int held = 0;
    for (int32_t b = 0; b < s.grid.node_blocks; b++)
        for (int i = 0; i < s.grid.block_cells; i++) {
            const float *node = node_of(&s, b, i);
            double point[3], before, wanted, after = 0.0;
            node_point(&s, b, i, point);
            before = solid_distance(&solid, point, normal) / CELL_SIZE;
            wanted = before;
            after = before;
            for (int a = 0; a < 3; a++) {
                wanted += (double)u[a] * normal[a] * (a < dimension);
                after += (double)node[a] * normal[a];
            }
            const double allowed = fmin(before, 0.0); /* not into it, and not deeper */
            TEST_ASSERT_DOUBLE_WITHIN(1e-5, fmax(wanted, allowed), after);
            held += wanted < allowed;
        }
    TEST_ASSERT_TRUE(held > 10);
    setting_close(&s);
}

static void test_nodes_stop_at_a_plane(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        check_plane(dimension, (const float[3]){0.2f, -0.7f, 0.1f});
        check_plane(dimension, (const float[3]){0.0f, -3.0f, 0.0f});
    }
}

/* What an obstacle that moves from one pose to the next does to a node that sticks to it: exactly its own motion. */
static void check_carried(int dimension, int parts)
{
    static Setting s;
    pbmpm_shape box = shape_defaults();
    const float to[3] = {0.3f, -0.2f, dimension == 3 ? 0.25f : 0.0f}, half = 0.15f;
    const float turned[4] = {0, 0, sinf(half), cosf(half)};
    double from_pose[9], to_pose[9];
    int held = 0;
    setting_open(&s, dimension, 4);
    for (int a = 0; a < 3; a++) box.half_extents[a] = 1.6f;
    const pbmpm_collider_id id = add_collider(&s, &box, PBMPM_FRICTION_STICK);
    collider_place(colliders_find(&s.colliders, id), to, turned, false);
    for (int part = 0; part < parts; part++) {
        set_nodes(&s, (const float[3]){0.1f, 0.1f, 0.1f});
        find_and_apply(&s, part, parts);
        const Obstacle *o = &s.colliders.obstacle[0];
        const double share[2] = {(double)part / parts, (double)(part + 1) / parts};
        for (int e = 0; e < 2; e++) { /* the position goes evenly, the pose is a rotation */
            const Solid *pose = e ? &o->end : &o->start;
            for (int a = 0; a < dimension; a++) TEST_ASSERT_DOUBLE_WITHIN(1e-6, share[e] * (double)to[a], pose->position[a]);
            memcpy(e ? to_pose : from_pose, pose->rotation, sizeof to_pose);
        }
        for (int32_t b = 0; b < s.grid.node_blocks; b++)
            for (int i = 0; i < s.grid.block_cells; i++) {
                double point[3], local[3] = {0}, normal[3];
                node_point(&s, b, i, point);
                const double depth = -solid_distance(&o->start, point, normal) / CELL_SIZE;
                if (depth < 1e-5) continue; /* only what is inside is held for sure */
                held++;
                for (int a = 0; a < 3; a++)
                    for (int c = 0; c < 3; c++) local[a] += from_pose[c * 3 + a] * (point[c] - o->start.position[c]);
                for (int a = 0; a < dimension; a++) {
                    double moved = o->end.position[a];
                    for (int c = 0; c < 3; c++) moved += to_pose[a * 3 + c] * local[c];
                    TEST_ASSERT_DOUBLE_WITHIN(1e-5, (moved - point[a]) / CELL_SIZE, (double)node_of(&s, b, i)[a]);
                }
            }
    }
    TEST_ASSERT_TRUE(held > 10);
    colliders_end_step(&s.colliders);
    const Collider *collider = colliders_find(&s.colliders, id);
    TEST_ASSERT_FALSE(collider->moving);
    TEST_ASSERT_EQUAL_MEMORY(to, collider->shape.position, sizeof to);
    TEST_ASSERT_EQUAL_MEMORY(turned, collider->shape.rotation, sizeof turned);
    setting_close(&s);
}

static void test_sticking_matter_is_carried(void)
{
    for (int dimension = 2; dimension <= 3; dimension++) {
        check_carried(dimension, 1);
        check_carried(dimension, 4);
    }
}

/* An obstacle that jumps across the world pushes with max_displacement and no more. */
static void test_motion_of_obstacles_is_clamped(void)
{
    static Setting s;
    pbmpm_shape ball = shape_defaults();
    const float far_away[3] = {1e5f, 1e5f, 0};
    setting_open(&s, 2, 4);
    ball.kind = PBMPM_SPHERE;
    ball.radius = 1.6f;
    const pbmpm_collider_id id = add_collider(&s, &ball, PBMPM_FRICTION_STICK);
    collider_place(colliders_find(&s.colliders, id), far_away, NULL, false);
    set_nodes(&s, (const float[3]){0, 0, 0});
    find_and_apply(&s, 0, 1);
    float largest = 0.0f;
    for (int32_t b = 0; b < s.grid.node_blocks; b++)
        for (int i = 0; i < s.grid.block_cells; i++) largest = fmaxf(largest, hypotf(node_of(&s, b, i)[0], node_of(&s, b, i)[1]));
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, LIMIT, largest);
    setting_close(&s);
}

/* Teleported, it has no velocity. */
static void test_teleported_obstacles_do_not_push(void)
{
    static Setting s;
    pbmpm_shape ball = shape_defaults();
    const float there[3] = {0.5f, 0, 0};
    setting_open(&s, 2, 4);
    ball.kind = PBMPM_SPHERE;
    ball.radius = 1.0f;
    const pbmpm_collider_id id = add_collider(&s, &ball, PBMPM_FRICTION_STICK);
    collider_place(colliders_find(&s.colliders, id), there, NULL, true);
    set_nodes(&s, (const float[3]){0, 0, 0});
    find_and_apply(&s, 0, 1);
    TEST_ASSERT_TRUE(s.colliders.contacts > 0);
    for (int32_t b = 0; b < s.grid.node_blocks; b++)
        for (int i = 0; i < s.grid.block_cells; i++) TEST_ASSERT_TRUE(node_of(&s, b, i)[0] == 0.0f && node_of(&s, b, i)[1] == 0.0f);
    setting_close(&s);
}

/* ---- The last resort ---- */

/* Out of a wall at once, out of anything else a cell at a time; the velocity into the surface is gone, the rest stays. */
static void test_particles_are_pushed_out(void)
{
    static Setting s;
    setting_open(&s, 2, 4);
    pbmpm_world_def def = world_def_defaults();
    def.domain_enabled = 1;
    def.domain_min[0] = -1.2f;
    def.domain_min[1] = -1.3f;
    def.domain_max[0] = def.domain_max[1] = 100.0f;
    s.domain = domain_of(&def);
    pbmpm_shape ball = shape_defaults();
    ball.kind = PBMPM_SPHERE;
    ball.radius = 1.0f;
    ball.position[0] = ball.position[1] = 1.5f;
    add_collider(&s, &ball, PBMPM_FRICTION_SLIP);
    for (uint32_t i = 0; i < s.particles.count; i++) {
        s.particles.velocity[0][i] = -1.0f;
        s.particles.velocity[1][i] = -2.0f;
    }
    set_nodes(&s, (const float[3]){0, 0, 0});
    find_and_apply(&s, 0, 1);
    const Solid solid = solid_of(&ball, 2);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, contacts_prepare_push(&s.frame, &s.memory));
    contacts_push_out(&s.frame, &s.particles, 0, s.grid.particle_blocks);
    int at_wall = 0, in_ball = 0;
    for (uint32_t i = 0; i < s.particles.count; i++) {
        double point[3] = {0}, normal[3];
        for (int a = 0; a < 2; a++) {
            point[a] = particles_coordinate(&s.particles, i, a) * CELL_SIZE;
            TEST_ASSERT_TRUE(point[a] >= s.domain.low[a] - 1e-7);
            const bool on_wall = point[a] < s.domain.low[a] + 1e-6;
            if (on_wall) TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.0f, s.particles.velocity[a][i]);
            at_wall += on_wall;
        }
        in_ball += solid_distance(&solid, point, normal) < -1e-6;
    }
    TEST_ASSERT_TRUE(at_wall > 10);
    TEST_ASSERT_TRUE(in_ball > 0); /* those deeper than a cell take longer */
    contacts_push_out(&s.frame, &s.particles, 0, s.grid.particle_blocks);
    contacts_push_out(&s.frame, &s.particles, 0, s.grid.particle_blocks);
    for (uint32_t i = 0; i < s.particles.count; i++) {
        double point[3] = {0}, normal[3];
        for (int a = 0; a < 2; a++) point[a] = particles_coordinate(&s.particles, i, a) * CELL_SIZE;
        TEST_ASSERT_TRUE(solid_distance(&solid, point, normal) > -1e-6);
    }
    setting_close(&s);
}

/* A row of particles `cells` away, 2^-28 to 2^-44 cells below the surface of a floor: their fractions and speeds after a push. */
static void push_from_floor(int32_t cells, float fraction[9], float speed[9])
{
    static Setting s;
    pbmpm_shape floor = shape_defaults();
    uint32_t row[9] = {0};
    setting_open(&s, 2, 4);
    floor.kind = PBMPM_PLANE;
    floor.position[0] = floor.position[1] = (float)(cells * CELL_SIZE);
    add_collider(&s, &floor, PBMPM_FRICTION_SLIP);
    for (uint32_t i = 0; i < s.particles.count; i++) {
        if (s.particles.cell[1][i] == 0) s.particles.fraction[1][i] = -ldexpf(1.0f, -28 - 2 * (s.particles.cell[0][i] + 4));
        for (int a = 0; a < 2; a++) s.particles.cell[a][i] += cells;
        s.particles.velocity[1][i] = -1.0f;
    }
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, grid_build(&s.grid, &s.memory, &s.particles, s.pool, false));
    colliders_begin_substep(&s.colliders, &s.domain, 2, 0, 1);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, contacts_prepare_push(&s.frame, &s.memory));
    for (uint32_t i = 0; i < s.particles.count; i++)
        if (s.particles.fraction[1][i] != 0.0f) row[s.particles.cell[0][i] - cells + 4] = i;
    contacts_push_out(&s.frame, &s.particles, 0, s.grid.particle_blocks);
    for (int k = 0; k < 9; k++) {
        fraction[k] = s.particles.fraction[1][row[k]];
        speed[k] = s.particles.velocity[1][row[k]];
    }
    setting_close(&s);
}

/* Double precision ends at 2^-33 cells there: what lies less deep must be put back as it is here, to the last bit. */
static void test_a_million_cells_away_the_same_is_pushed_out(void)
{
    float here[2][9] = {{0}}, there[2][9] = {{0}};
    push_from_floor(0, here[0], here[1]);
    push_from_floor(1000000, there[0], there[1]);
    for (int i = 0; i < 9; i++) TEST_ASSERT_TRUE(here[0][i] >= 0.0f && here[1][i] == 0.0f);
    TEST_ASSERT_EQUAL_MEMORY(here, there, sizeof here);
}

/* Where each is after a push, of a row of particles through two boxes that overlap from -1/2 to 1/2 cells, as liquid that stays or not [cells]. */
static void push_between_boxes(const KernelMaterial *stays, double place[9])
{
    static Setting s;
    pbmpm_shape box = shape_defaults();
    setting_open(&s, 2, 4);
    s.frame.stays = stays;
    box.half_extents[0] = (float)(2.0 * CELL_SIZE);
    box.half_extents[1] = (float)(20.0 * CELL_SIZE);
    for (int side = -1; side <= 1; side += 2) {
        box.position[0] = (float)(1.5 * side * CELL_SIZE);
        add_collider(&s, &box, PBMPM_FRICTION_SLIP);
    }
    set_nodes(&s, (const float[3]){0, 0, 0});
    find_and_apply(&s, 0, 1);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, contacts_prepare_push(&s.frame, &s.memory));
    contacts_push_out(&s.frame, &s.particles, 0, s.grid.particle_blocks);
    for (uint32_t i = 0; i < s.particles.count; i++)
        if (fabs(particles_coordinate(&s.particles, i, 1)) < 0.1) place[s.particles.id[i].index % 9] = particles_coordinate(&s.particles, i, 0);
    setting_close(&s);
}

/* Liquid of the paper's solver stays where two boxes overlap, since the way out of each leads into the other; solids, and liquid of other solvers,
 * are put on a surface. What is deeper in one of them than its own way out is long leaves it. */
static void test_what_overlapping_boxes_trap_stays_if_it_is_liquid(void)
{
    const KernelMaterial liquid = {.kind = K_LIQUID}, solid = {.kind = K_SOLID};
    double stayed[9], pushed[9], as_solid[9];
    push_between_boxes(&liquid, stayed);
    push_between_boxes(NULL, pushed);
    push_between_boxes(&solid, as_solid);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.0, stayed[4]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 0.5, fabs(pushed[4]));
    for (int i = 0; i < 9; i++) TEST_ASSERT_DOUBLE_WITHIN(1e-9, pushed[i], as_solid[i]);
    for (int i = 0; i < 9; i++)
        if (i < 3 || i > 5) TEST_ASSERT_DOUBLE_WITHIN(1e-9, pushed[i], stayed[i]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, 3.5, stayed[7]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-5, -3.5, stayed[1]);
}

/* ---- Boxes that stand on something ---- */

/* A box on a turned plane, `above` cells over it, that goes `way` cells along the plane in the substep. */
static void open_standing_box(Setting *s, double above, float way)
{
    const float turned[4] = {0, 0, sinf(0.25f), cosf(0.25f)};
    const double along[2] = {cos(0.5), sin(0.5)}, up[2] = {-sin(0.5), cos(0.5)}, half = 4.0 * CELL_SIZE;
    setting_open(s, 2, 3);
    pbmpm_shape box = shape_defaults(), plane = shape_defaults();
    for (int a = 0; a < 3; a++) box.half_extents[a] = (float)half;
    plane.kind = PBMPM_PLANE;
    for (int a = 0; a < 2; a++) plane.normal[a] = (float)up[a];
    for (int a = 0; a < 2; a++) box.position[a] = (float)(up[a] * (half + above * CELL_SIZE));
    memcpy(box.rotation, turned, sizeof turned);
    const pbmpm_collider_id id = add_collider(s, &box, PBMPM_FRICTION_SLIP);
    add_collider(s, &plane, PBMPM_FRICTION_SLIP);
    for (int a = 0; a < 2; a++) box.position[a] += way * (float)(along[a] * CELL_SIZE);
    collider_place(colliders_find(&s->colliders, id), box.position, box.rotation, false);
    colliders_begin_substep(&s->colliders, &s->domain, 2, 0, 1);
}

/* Seen from a little above the bottom of a box, in its middle: on or in a plane the bottom bounds no open space; in the air it does. */
static void test_a_box_that_stands_has_no_bottom(void)
{
    static Setting s;
    const double above[] = {0.0, -0.5, 0.05, 0.3}, inside = 0.7;
    for (int i = 0; i < 4; i++) {
        open_standing_box(&s, above[i], 0.5f);
        const double height = (above[i] + inside) * CELL_SIZE, point[3] = {-sin(0.5) * height, cos(0.5) * height, 0.0};
        for (int k = 0; k < 2; k++) {
            Near near;
            Face face[FIELD_FACES];
            field_near(&near, &s.frame, point, 4.0, k == 1);
            const int faces = field_faces(&near, point, NODE_REACH, face);
            TEST_ASSERT_EQUAL_INT(above[i] < 0.1 ? 0 : 1, faces);
            if (faces == 0) continue;
            TEST_ASSERT_DOUBLE_WITHIN(1e-5, -inside, face[0].distance);
            TEST_ASSERT_DOUBLE_WITHIN(1e-6, -1.0, -sin(0.5) * face[0].normal[0] + cos(0.5) * face[0].normal[1]);
        }
        setting_close(&s);
    }
}

/* One that stands moves as any does. */
static void test_a_standing_box_moves(void)
{
    static Setting s;
    const double point[3] = {0.3, 0.4, 0.0};
    float motion[3];
    open_standing_box(&s, 0.0, 0.5f);
    obstacle_motion(&s.colliders.obstacle[0], point, CELL_SIZE, LIMIT, motion);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.5f * cosf(0.5f), motion[0]);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.5f * sinf(0.5f), motion[1]);
    setting_close(&s);
}

/* ---- Slots ---- */

static void test_slots_and_generations(void)
{
    static Setting s;
    const pbmpm_collider_def def = collider_defaults();
    const pbmpm_shape box = shape_defaults();
    pbmpm_collider_id id, first;
    setting_open(&s, 3, 1);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, colliders_add(&s.colliders, &s.memory, &def, &box, NULL, 5, &first));
    for (int i = 1; i < PBMPM_MAX_COLLIDERS; i++) TEST_ASSERT_EQUAL_INT(PBMPM_OK, colliders_add(&s.colliders, &s.memory, &def, &box, NULL, 5 + (uint32_t)i, &id));
    TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_CAPACITY, colliders_add(&s.colliders, &s.memory, &def, &box, NULL, 9999, &id));
    TEST_ASSERT_NOT_NULL(colliders_find(&s.colliders, first));
    colliders_find(&s.colliders, first)->generation = 0;
    TEST_ASSERT_NULL(colliders_find(&s.colliders, first));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, colliders_add(&s.colliders, &s.memory, &def, &box, NULL, 10000, &id));
    TEST_ASSERT_EQUAL_UINT32(first.index, id.index);
    TEST_ASSERT_NULL(colliders_find(&s.colliders, first));
    TEST_ASSERT_NULL(colliders_find(&s.colliders, (pbmpm_collider_id){0}));
    TEST_ASSERT_NULL(colliders_find(&s.colliders, (pbmpm_collider_id){PBMPM_MAX_COLLIDERS, 5}));
    setting_close(&s);
}

/* Whichever allocation fails, finding contacts says so and takes nothing along. */
static void test_failing_search(void)
{
    static Setting s;
    pbmpm_shape plane = shape_defaults();
    plane.kind = PBMPM_PLANE;
    pbmpm_result result = PBMPM_ERROR_OUT_OF_MEMORY;
    for (uint64_t fail = 1; result != PBMPM_OK; fail++) {
        setting_open(&s, 3, 3);
        add_collider(&s, &plane, PBMPM_FRICTION_COULOMB);
        set_nodes(&s, (const float[3]){0, -1, 0});
        colliders_begin_substep(&s.colliders, &s.domain, 3, 0, 1);
        s.books.fail_at = s.books.calls + fail;
        result = contacts_measure(&s.frame, &s.memory, s.pool);
        if (result == PBMPM_OK) result = contacts_find(&s.frame, &s.memory, s.pool);
        if (result != PBMPM_OK) {
            TEST_ASSERT_EQUAL_INT(PBMPM_ERROR_OUT_OF_MEMORY, result);
            contacts_apply(&s.frame, 0, s.grid.node_blocks); /* there are none: nothing happens */
            TEST_ASSERT_TRUE(node_of(&s, 0, 0)[1] == -1.0f);
        }
        setting_close(&s);
        TEST_ASSERT_TRUE(fail < 20);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_coulomb);
    RUN_TEST(test_slip);
    RUN_TEST(test_stick);
    RUN_TEST(test_leaving_is_free);
    RUN_TEST(test_nodes_stop_at_a_plane);
    RUN_TEST(test_sticking_matter_is_carried);
    RUN_TEST(test_motion_of_obstacles_is_clamped);
    RUN_TEST(test_teleported_obstacles_do_not_push);
    RUN_TEST(test_particles_are_pushed_out);
    RUN_TEST(test_a_million_cells_away_the_same_is_pushed_out);
    RUN_TEST(test_what_overlapping_boxes_trap_stays_if_it_is_liquid);
    RUN_TEST(test_a_box_that_stands_has_no_bottom);
    RUN_TEST(test_a_standing_box_moves);
    RUN_TEST(test_slots_and_generations);
    RUN_TEST(test_failing_search);
    return UNITY_END();
}
