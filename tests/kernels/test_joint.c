/* The kernels of the joint solver, see src/solvers/joint.h, against the reference. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "bounds.h"
#include "check.h"
#include "dual_stages.h"

void setUp(void) {}
void tearDown(void) {}

static const float STIFFNESS = 1.3f; /* k */

static SceneSpec scene_of(const char *name, pbmpm_material_kind second)
{
    SceneSpec spec = {.name = name,
                      .material = {scene_material(PBMPM_LIQUID), scene_material(second)},
                      .materials = 2,
                      .cells = 60,
                      .most_per_cell = 12,
                      .spread = 5,
                      .speed = 0.4,
                      .gradient = 0.2,
                      .ratio_min = 0.6,
                      .ratio_max = 1.2,
                      .solver = PBMPM_SOLVER_DUAL};
    spec.material[1].density = 700.0f;
    return spec;
}

/* Arrays of the joint solver, bound. */
typedef struct Joint {
    float *particle, *energy, *force, *couple;
    uint32_t *among_liquid;
} Joint;

static Joint joint_bind(DualStage *stage)
{
    World *world = stage->scene.world;
    KernelArgs *a = &world->args;
    const size_t count = world->particles.count, d = (size_t)stage->scene.step.dimension;
    const size_t nodes = (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells;
    const Joint joint = {.particle = calloc((1 + d * d) * count + 64, sizeof(float)),
                         .energy = calloc(K_ENERGIES * (size_t)world->grid.particle_blocks, sizeof(float)),
                         .force = calloc(nodes * K_NODE_WIDTH, sizeof(float)),
                         .couple = calloc(3 * count + 64, sizeof(float)),
                         .among_liquid = calloc((size_t)world->grid.particle_blocks, sizeof(uint32_t))};
    a->primal.held_stiffness = STIFFNESS;
    a->primal.held_pressure = joint.particle;
    for (size_t r = 0; r < d; r++)
        for (size_t c = 0; c < d; c++) a->primal.sketch[r * 3 + c] = joint.particle + (1 + r * d + c) * count;
    a->primal.block_energy = joint.energy;
    a->primal.node_force = joint.force;
    for (size_t k = 0; k < 3; k++) a->primal.couple[k] = joint.couple + k * count;
    a->primal.among_liquid = joint.among_liquid;
    return joint;
}

static void joint_free(Joint *joint)
{
    free(joint->particle);
    free(joint->energy);
    free(joint->force);
    free(joint->couple);
    free(joint->among_liquid);
}

static double trace_of(const RefGrid *nodes, const RefParticle *p)
{
    double d[3], D[9];
    reference_gather(nodes, p, d, D);
    return D[0] + D[4] + (nodes->dimension == 3 ? D[8] : 0.0);
}

/* Rounding of k tr D, and of what it is added to. */
static double error_of(const RefGrid *nodes, const RefParticle *p, double to)
{
    const double k = (double)STIFFNESS;
    return k * nodes->dimension * bound_gather(nodes, p).D + 4.0 * UNIT_ROUNDOFF * (fabs(to) + k * fabs(trace_of(nodes, p)));
}

/* held = p + k tr D; where p = 0, tr D is at most what the liquid lacks of its volume. */
static void check_held(DualStage *stage)
{
    Scene *scene = &stage->scene;
    const RefGrid nodes = scene_nodes(scene);
    long bounded = 0;
    for (uint32_t i = 0; i < scene->world->particles.count; i += 3) scene->world->args.dual.pressure[i] = 0.0f;
    scene_run_particles(scene, scene->kernels->hold_pressure);
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle p = scene_particle(scene, i);
        const double pressure = (double)scene->world->args.dual.pressure[i], lacks = fmax(0.0, 1.0 / p.volume_ratio - 1.0);
        if (p.material.kind != K_LIQUID) continue;
        const double led = trace_of(&nodes, &p), start = pressure > 0.0 ? led : fmin(led, lacks);
        const double rounding = error_of(&nodes, &p, pressure) + 4.0 * UNIT_ROUNDOFF * (double)STIFFNESS * (1.0 + lacks);
        bounded += start < led;
        check_near(pressure + (double)STIFFNESS * start, (double)scene->world->args.primal.held_pressure[i], rounding, "held pressure", (long)i);
    }
    check_true(bounded > 0, "some liquid that bears nothing grows beyond its volume", bounded);
    RefGrid used = nodes;
    reference_grid_free(&used);
}

/* phi at D = 0, which the energy check compares with: held is not p there where liquid expands or bears nothing. */
static void check_rest(DualStage *stage, const Joint *joint)
{
    Scene *scene = &stage->scene;
    const World *world = scene->world;
    const uint32_t *begin = world->grid.block_begin.data;
    scene_run_particles(scene, scene->kernels->force_first);
    for (int32_t block = 0; block < world->grid.particle_blocks; block++) {
        double energy = 0.0;
        for (uint32_t i = begin[block]; i < begin[block + 1]; i++) {
            const double held = fmax(0.0, (double)joint->particle[i]);
            energy += 0.25 * scene_particle(scene, i).mass * held * held / (2.0 * (double)STIFFNESS);
        }
        check_near(energy, (double)joint->energy[K_ENERGIES * block + 3], (begin[block + 1] - begin[block] + 8) * UNIT_ROUNDOFF * energy, "energy at D = 0", block);
    }
}

/* phi = y^2 / (2 k) with y = max(0, held - k tr D), and its gradient, which pushes with the stress -y. */
static void check_energy(DualStage *stage, const Joint *joint)
{
    Scene *scene = &stage->scene;
    const World *world = scene->world;
    const uint32_t *begin = world->grid.block_begin.data;
    RefGrid nodes = scene_nodes(scene), expected = reference_grid(scene->step.dimension, scene->low, scene->high), sizes;
    BoundNode *bounds = calloc((size_t)nodes.size[0] * (size_t)nodes.size[1] * (size_t)nodes.size[2], sizeof *bounds);
    scene_run_particles(scene, scene->kernels->force);
    long moved = 0;
    for (int32_t block = 0; block < world->grid.particle_blocks; block++) {
        double energy = 0.0, error = 0.0;
        for (uint32_t i = begin[block]; i < begin[block + 1]; i++) {
            const RefParticle p = scene_particle(scene, i);
            const double k = (double)STIFFNESS, held = (double)joint->particle[i], y = fmax(0.0, held - k * trace_of(&nodes, &p));
            const double y_error = error_of(&nodes, &p, held), S[9] = {-y, 0, 0, 0, -y, 0, 0, 0, scene->step.dimension == 3 ? -y : 0.0};
            reference_push(&expected, &p, S);
            bound_push(&expected, bounds, &p, S, y_error);
            energy += 0.25 * p.mass * y * y / (2.0 * k);
            error += 0.25 * p.mass * (y * y_error + y_error * y_error) / k;
            moved += y > 0.0 && fabs(y - (double)world->args.dual.pressure[i]) > y_error;
        }
        check_near(energy, (double)joint->energy[K_ENERGIES * block + 1], error + (begin[block + 1] - begin[block] + 8) * UNIT_ROUNDOFF * energy, "energy of a block", block);
    }
    check_true(moved > 0, "some pressures are not those of the dual", moved);
    RefGrid sum = scene_tiles(scene, &sizes);
    for (size_t i = 0; i < (size_t)sum.size[0] * (size_t)sum.size[1] * (size_t)sum.size[2]; i++)
        for (int a = 0; a < 3; a++) check_near(expected.node[i].u[a], sum.node[i].u[a], bound_of_sum(&bounds[i], a), "push of the liquid", (long)i);
    free(bounds);
    reference_grid_free(&nodes);
    reference_grid_free(&expected);
    reference_grid_free(&sizes);
    reference_grid_free(&sum);
}

static void check_liquids(DualStage *stage)
{
    dual_check_begin(stage);
    dual_check_push(stage);
    Joint joint = joint_bind(stage);
    check_held(stage);
    memset(stage->scene.world->args.primal.sketch, 0, sizeof stage->scene.world->args.primal.sketch);
    dual_check_iterate(stage); /* other pressures, and so other displacements */
    dual_check_push(stage);
    check_rest(stage, &joint);
    check_energy(stage, &joint);
    joint_free(&joint);
}

/* What solids are strained by where the sketch ends is no strain for the dual: from there they push with nothing. A step's X and Z are about 1; their
 * difference, times w, is the stress. */
static void check_solids(DualStage *stage)
{
    Scene *scene = &stage->scene;
    const int n = scene->step.dimension;
    dual_check_begin(stage);
    dual_check_push(stage);
    Joint joint = joint_bind(stage);
    RefGrid nodes = scene_nodes(scene);
    scene_run_particles(scene, scene->kernels->end_sketch);
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle p = scene_particle(scene, i);
        double d[3], D[9];
        if (p.material.kind == K_LIQUID) continue;
        reference_gather(&nodes, &p, d, D);
        for (int r = 0; r < n; r++)
            for (int c = 0; c < n; c++)
                check_near(D[r * 3 + c], (double)scene->world->args.primal.sketch[r * 3 + c][i], bound_gather(&nodes, &p).D, "gradient of the sketch", (long)i);
    }
    scene_run_particles(scene, scene->kernels->dual_iterate);
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle p = scene_particle(scene, i);
        double S[9];
        if (p.material.kind == K_LIQUID) continue;
        dual_multiplier(stage, i, S);
        for (int k = 0; k < 9; k++) check_near(0.0, S[k], 64.0 * UNIT_ROUNDOFF * (double)p.material.relaxation, "stress beside the sketch", (long)i);
    }
    memset(scene->world->args.primal.sketch, 0, sizeof scene->world->args.primal.sketch);
    reference_grid_free(&nodes);
    joint_free(&joint);
}

/* ---- Couples ---- */

/* Sums of at most so many pushes round by one unit of the largest each. */
enum { TERMS = 512 };

static void set_among_liquid(const DualStage *stage, Joint *joint, uint32_t every)
{
    for (int32_t block = 0; block < stage->scene.world->grid.particle_blocks; block++) joint->among_liquid[block] = every == 1 || (every > 1 && (uint32_t)block % every == 0);
}

static RefGrid forces_by(Scene *scene, Kernel *kernel, double *largest)
{
    RefGrid sizes;
    scene_run_particles(scene, kernel);
    RefGrid sum = scene_tiles(scene, &sizes);
    *largest = 0.0;
    for (size_t i = 0; i < (size_t)sum.size[0] * (size_t)sum.size[1] * (size_t)sum.size[2]; i++)
        for (int a = 0; a < 3; a++) *largest = fmax(*largest, fabs(sizes.node[i].u[a]));
    reference_grid_free(&sizes);
    return sum;
}

/* Sum over the nodes of x times force. */
static void torque_of(const RefGrid *force, double torque[3])
{
    memset(torque, 0, 3 * sizeof *torque);
    for (int z = 0; z < force->size[2]; z++)
        for (int y = 0; y < force->size[1]; y++)
            for (int x = 0; x < force->size[0]; x++) {
                const double at[3] = {x, y, z}, *f = force->node[((size_t)z * (size_t)force->size[1] + (size_t)y) * (size_t)force->size[0] + (size_t)x].u;
                for (int a = 0; a < 3; a++) torque[a] += at[(a + 1) % 3] * f[(a + 2) % 3] - at[(a + 2) % 3] * f[(a + 1) % 3];
            }
}

static double largest_torque(const RefGrid *force)
{
    double torque[3];
    torque_of(force, torque);
    return fmax(fabs(torque[0]), fmax(fabs(torque[1]), fabs(torque[2])));
}

/* Displacements become smaller by this: what is of second order is less by as much again. */
static const float SMALL = 1.0f / 64.0f;

static void shrink(const Scene *scene)
{
    const Grid *grid = &scene->world->grid;
    float *node = scene->world->grid.node.data;
    for (size_t i = 0; i < (size_t)grid->node_blocks * (size_t)grid->block_cells * K_NODE_WIDTH; i++)
        if (i % K_NODE_WIDTH != 3) node[i] *= SMALL;
}

/* Inner forces turn nothing, to first order of the displacements: what is left is a share of about SMALL, eight times that allowed. Without couples all is left. */
static void check_torque(DualStage *stage, Joint *joint)
{
    Scene *scene = &stage->scene;
    double largest;
    shrink(scene);
    set_among_liquid(stage, joint, 0);
    RefGrid plain = forces_by(scene, scene->kernels->force_first, &largest);
    const double arm = plain.size[0] + plain.size[1] + plain.size[2], rounding = 64.0 * UNIT_ROUNDOFF * largest * arm, before = largest_torque(&plain);
    check_true(before > 4.0 * rounding, "stresses have a torque", 0);
    reference_grid_free(&plain);
    set_among_liquid(stage, joint, 1);
    RefGrid balanced = forces_by(scene, scene->kernels->force_first, &largest);
    double torque[3];
    torque_of(&balanced, torque);
    for (int a = 0; a < 3; a++) check_near(0.0, torque[a], rounding + 8.0 * (double)SMALL * before, "torque of inner forces", a);
    reference_grid_free(&balanced);
}

/* The transpose of reference_gradient(), times m / 4. */
static void push_by_slopes(RefGrid *force, const RefParticle *p, const double S[9])
{
    double slope[27][3];
    const RefStencil s = reference_stencil(force->dimension, p);
    reference_slopes(force->dimension, p, slope);
    for (int i = 0; i < s.count; i++)
        for (int r = 0; r < force->dimension; r++)
            for (int c = 0; c < force->dimension; c++) force->node[reference_index(force, s.node[i])].u[r] += 0.25 * p->mass * S[r * 3 + c] * slope[i][c];
}

/* From there on: the forces of a block among liquid are less by those of the stress A, and the energy by A : D. */
static void check_couples(DualStage *stage, Joint *joint)
{
    Scene *scene = &stage->scene;
    World *world = scene->world;
    const int n = scene->step.dimension;
    const uint32_t *begin = world->grid.block_begin.data;
    double largest;
    RefGrid nodes = scene_nodes(scene);
    set_among_liquid(stage, joint, 0);
    RefGrid expected = forces_by(scene, scene->kernels->force, &largest);
    set_among_liquid(stage, joint, 2);
    for (int32_t block = 0; block < world->grid.particle_blocks; block += 2) {
        double energy = 0.0, size = 0.0;
        for (uint32_t i = begin[block]; i < begin[block + 1]; i++) {
            const RefParticle p = scene_particle(scene, i);
            double gradient[9], S[9] = {0};
            if (p.material.kind == K_LIQUID) continue;
            const double terms = reference_gradient(&nodes, &p, gradient);
            for (int r = 1; r < n; r++)
                for (int c = 0; c < r; c++) {
                    const double skew = (double)world->args.primal.couple[r + c - 1][i];
                    S[r * 3 + c] = -skew;
                    S[c * 3 + r] = skew;
                    energy -= 0.25 * p.mass * skew * (gradient[r * 3 + c] - gradient[c * 3 + r]);
                    size += 0.5 * p.mass * fabs(skew) * terms;
                }
            push_by_slopes(&expected, &p, S);
        }
        joint->energy[K_ENERGIES * block + 4] = -1.0f;
        scene->kernels->force(&world->args, block, block + 1);
        check_near(energy, (double)joint->energy[K_ENERGIES * block + 4], TERMS * UNIT_ROUNDOFF * size, "energy of couples", block);
    }
    RefGrid sum = forces_by(scene, scene->kernels->force, &largest);
    for (size_t i = 0; i < (size_t)sum.size[0] * (size_t)sum.size[1] * (size_t)sum.size[2]; i++)
        for (int a = 0; a < n; a++) check_near(expected.node[i].u[a], sum.node[i].u[a], TERMS * UNIT_ROUNDOFF * largest, "push with couples", (long)i);
    reference_grid_free(&nodes);
    reference_grid_free(&expected);
    reference_grid_free(&sum);
}

static void check_balance(DualStage *stage)
{
    dual_check_begin(stage);
    dual_check_push(stage);
    Joint joint = joint_bind(stage);
    memset(stage->scene.world->args.primal.sketch, 0, sizeof stage->scene.world->args.primal.sketch);
    check_torque(stage, &joint);
    dual_check_iterate(stage); /* other displacements */
    dual_check_push(stage);
    check_couples(stage, &joint);
    joint_free(&joint);
}

static void test_solids_among_liquid_have_no_torque_where_they_begin(void)
{
    const SceneSpec spec = scene_of("joint: couples", PBMPM_ELASTIC);
    dual_check_spec(&spec, 3, check_balance);
}

static void test_liquids_keep_the_pressures_of_the_dual(void)
{
    const SceneSpec spec = scene_of("joint: liquids", PBMPM_LIQUID);
    dual_check_spec(&spec, 3, check_liquids);
}

static void test_solids_count_from_the_sketch(void)
{
    const SceneSpec spec = scene_of("joint: solids", PBMPM_ELASTIC);
    dual_check_spec(&spec, 3, check_solids);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_liquids_keep_the_pressures_of_the_dual);
    RUN_TEST(test_solids_count_from_the_sketch);
    RUN_TEST(test_solids_among_liquid_have_no_torque_where_they_begin);
    return UNITY_END();
}
