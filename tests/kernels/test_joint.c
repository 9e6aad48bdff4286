/* The kernels of the joint solver, see src/joint.h, against the reference. */
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
    float *particle, *energy, *force;
} Joint;

static Joint joint_bind(DualStage *stage)
{
    World *world = stage->scene.world;
    KernelArgs *a = &world->args;
    const size_t count = world->particles.count, d = (size_t)stage->scene.step.dimension;
    const size_t nodes = (size_t)world->grid.node_blocks * (size_t)world->grid.block_cells;
    const Joint joint = {calloc((1 + d * d) * count + 64, sizeof(float)), calloc(4 * (size_t)world->grid.particle_blocks, sizeof(float)), calloc(nodes * K_NODE_WIDTH, sizeof(float))};
    a->held_stiffness = STIFFNESS;
    a->held_pressure = joint.particle;
    for (size_t r = 0; r < d; r++)
        for (size_t c = 0; c < d; c++) a->sketch[r * 3 + c] = joint.particle + (1 + r * d + c) * count;
    a->block_energy = joint.energy;
    a->node_force = joint.force;
    return joint;
}

static void joint_free(Joint *joint)
{
    free(joint->particle);
    free(joint->energy);
    free(joint->force);
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

/* held = p + k tr D. */
static void check_held(DualStage *stage)
{
    Scene *scene = &stage->scene;
    const RefGrid nodes = scene_nodes(scene);
    scene_run_particles(scene, scene->kernels->hold_pressure);
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle p = scene_particle(scene, i);
        const double pressure = (double)scene->world->args.pressure[i];
        if (p.material.kind != K_LIQUID) continue;
        check_near(pressure + (double)STIFFNESS * trace_of(&nodes, &p), (double)scene->world->args.held_pressure[i], error_of(&nodes, &p, pressure), "held pressure", (long)i);
    }
    RefGrid used = nodes;
    reference_grid_free(&used);
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
            moved += y > 0.0 && fabs(y - (double)world->args.pressure[i]) > y_error;
        }
        check_near(energy, (double)joint->energy[4 * block + 1], error + (begin[block + 1] - begin[block] + 8) * UNIT_ROUNDOFF * energy, "energy of a block", block);
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
    memset(stage->scene.world->args.sketch, 0, sizeof stage->scene.world->args.sketch);
    dual_check_iterate(stage); /* other pressures, and so other displacements */
    dual_check_push(stage);
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
                check_near(D[r * 3 + c], (double)scene->world->args.sketch[r * 3 + c][i], bound_gather(&nodes, &p).D, "gradient of the sketch", (long)i);
    }
    scene_run_particles(scene, scene->kernels->dual_iterate);
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle p = scene_particle(scene, i);
        double S[9];
        if (p.material.kind == K_LIQUID) continue;
        dual_multiplier(stage, i, S);
        for (int k = 0; k < 9; k++) check_near(0.0, S[k], 64.0 * UNIT_ROUNDOFF * (double)p.material.relaxation, "stress beside the sketch", (long)i);
    }
    memset(scene->world->args.sketch, 0, sizeof scene->world->args.sketch);
    reference_grid_free(&nodes);
    joint_free(&joint);
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
    return UNITY_END();
}
