/* The kernels of the dual solver with pressures on particles: each against the reference, and what their equations promise. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "bounds.h"
#include "check.h"
#include "dual_stages.h"
#include "isas.h"
#include "matrices.h"
#include "probes.h"
#include "stages.h"

void setUp(void) {}
void tearDown(void) {}

/* Liquids, one incompressible and one soft, and elastic bodies, one of them stiffer than the iterations can hold. */
static SceneSpec mixed_scene(const char *name)
{
    SceneSpec spec = {.name = name,
                      .material = {scene_material(PBMPM_LIQUID), scene_material(PBMPM_ELASTIC), scene_material(PBMPM_LIQUID),
                                   scene_material(PBMPM_ELASTIC)},
                      .materials = 4,
                      .cells = 60,
                      .most_per_cell = 12,
                      .spread = 5,
                      .speed = 0.4,
                      .gradient = 0.2,
                      .ratio_min = 0.6,
                      .ratio_max = 1.2,
                      .solver = PBMPM_SOLVER_DUAL};
    spec.material[1].poisson_ratio = 0.45f;
    spec.material[2].bulk_modulus = 3e4f;
    spec.material[2].density = 700.0f;
    spec.material[2].relaxation = 0.8f;
    spec.material[3].young_modulus = 1e8f;
    spec.material[3].density = 2500.0f;
    return spec;
}

static const double momenta[] = {0.0, 0.28, 0.43, 0.9};

/* ---- Kernel by kernel ---- */

static void check_iterations(DualStage *stage)
{
    for (size_t k = 0; k < sizeof momenta / sizeof *momenta; k++) {
        dual_check_iterate(stage);
        stage->scene.world->args.dual.momentum = (float)momenta[k];
        dual_check_push(stage);
        dual_check_displacements(stage, momenta[k]);
    }
}

static void check_rounds(DualStage *stage)
{
    dual_check_begin(stage);
    dual_check_push(stage);
    check_iterations(stage);
    stage->scene.step.base = &stage->base;
    stages_check_integrate(&stage->scene);
}

/* As after a guess, which has found what strain does beyond its trace. */
static void check_rounds_of_second_order(DualStage *stage)
{
    dual_check_begin(stage);
    dual_check_push(stage);
    cells_check_second_order(stage);
    check_iterations(stage);
}

static void test_second_order(void)
{
    SceneSpec spec = mixed_scene("second order");
    dual_check_spec(&spec, 2, check_rounds_of_second_order);
    spec.gradient = 0.6;
    dual_check_spec(&spec, 1, check_rounds_of_second_order);
    spec_crowded(&spec);
    dual_check_spec(&spec, 1, check_rounds_of_second_order);
}

static void test_mixed_materials(void)
{
    const SceneSpec spec = mixed_scene("dual: mixed materials");
    dual_check_spec(&spec, 3, check_rounds);
}

static void test_single_particles_far_apart(void)
{
    SceneSpec spec = mixed_scene("dual: single particles far apart");
    spec_far_apart(&spec);
    dual_check_spec(&spec, 1, check_rounds);
}

static void test_crowded_cells(void)
{
    SceneSpec spec = mixed_scene("dual: crowded cells");
    spec_crowded(&spec);
    dual_check_spec(&spec, 1, check_rounds);
}

/* From crushed to torn. */
static void test_all_densities(void)
{
    SceneSpec spec = mixed_scene("dual: all densities");
    spec.ratio_min = 0.05;
    spec.gradient = 0.8;
    dual_check_spec(&spec, 2, check_rounds);
}

/* The feedback of matter at rest and on its way to where it is full, 0.01 cells per substep. */
static void check_calm_liquid(const char *name, double ratio_min, CheckDual *check)
{
    static const double ways[] = {0.0, 1e-3, 1e-2, 3e-2};
    for (int i = 0; i < 4; i++) {
        SceneSpec spec = mixed_scene(name);
        spec.speed = ways[i];
        spec.gradient = 0.1 * ways[i];
        spec.ratio_min = ratio_min;
        spec.ratio_max = 1.1;
        dual_check_spec(&spec, 1, check);
    }
}

static void test_calm_liquid(void) { check_calm_liquid("dual: calm liquid", 0.9, check_rounds); }

/* Without gravity what a filling may have of noise is left alone where J would fall. */
static void check_weightless(DualStage *stage)
{
    memset(stage->scene.world->args.gravity, 0, sizeof stage->scene.world->args.gravity);
    memset(stage->scene.step.gravity, 0, sizeof stage->scene.step.gravity);
    check_rounds(stage);
}

static void test_calm_liquid_without_gravity(void) { check_calm_liquid("dual: calm liquid without gravity", 0.6, check_weightless); }

/* That of liquids that store energy: the same kernel with the primal solver's way, down to where J is wrong at rest. */
static void check_quiet_feedback(DualStage *stage)
{
    KernelArgs *args = &stage->scene.world->args;
    stage->scene.step.quiet_way = (double)(args->quiet_way = args->feedback_way);
    stage->scene.step.base = &stage->base;
    stages_check_integrate(&stage->scene);
}

static void test_quiet_liquid(void) { check_calm_liquid("quiet liquid", 0.6, check_quiet_feedback); }

/* ---- ASFLIP ---- */

static void test_fine_motion(void)
{
    static const float shares[] = {0.0f, 0.4f, 1.0f};
    for (int i = 0; i < 3; i++) {
        SceneSpec spec = mixed_scene("dual: fine motion");
        spec.flip = shares[i];
        spec.material[2].kinematic_viscosity = 1e-3f; /* a viscous liquid loses it on purpose */
        dual_check_spec(&spec, 1, check_rounds);
    }
}

/* Without any force on the nodes, a liquid that keeps all of its motion keeps its velocity, whatever the transfers lost; only gravity is
 * added. A velocity is compared in its own rounding, and that of the transfer of the largest one: 0.4 cells per substep. */
static void check_lost_velocity(DualStage *stage)
{
    const Scene *scene = &stage->scene;
    const RefStep *step = &scene->step;
    RefParticle *before = scene_particles(scene);
    scene_run_particles(&stage->scene, scene->kernels->integrate);
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle after = scene_particle(scene, i);
        const double cell = 1.0 / step->cells_per_metre, bound = 100.0 * UNIT_ROUNDOFF * cell / step->dt;
        if (before[i].material.kind != K_LIQUID) continue;
        for (int a = 0; a < step->dimension; a++)
            check_near(before[i].velocity[a] + step->gravity[a] * cell / step->dt, after.velocity[a], bound, "kept velocity", (long)i);
    }
    free(before);
}

static void test_all_fine_motion_is_all_of_the_velocity(void)
{
    SceneSpec spec = mixed_scene("dual: all of the velocity");
    spec.flip = 1.0f;
    dual_check_spec(&spec, 2, check_lost_velocity);
}

/* ---- Proximal steps ---- */

enum { BATCH = 1024 }; /* whole gangs */

typedef struct Batch {
    int dimension;
    KernelMaterial material;
    float f[BATCH * 9], d[BATCH * 9], y[BATCH * 9], s[BATCH * 9], rotation[BATCH * 9];
} Batch;

typedef void MakeParticle(Random *random, int dimension, double F[9], double D[9], double Y[9]);

static void widen(const float *from, double *to)
{
    for (int k = 0; k < 9; k++) to[k] = (double)from[k];
}

static void fill_batch(Batch *batch, Random *random, MakeParticle *make)
{
    for (int i = 0; i < BATCH; i++) {
        double F[9] = {0}, D[9] = {0}, Y[9] = {0};
        make(random, batch->dimension, F, D, Y);
        for (int r = 0; r < 3; r++)
            for (int c = 0; c < 3; c++) {
                const int k = 9 * i + r * 3 + c;
                batch->f[k] = (float)F[r * 3 + c];
                batch->d[k] = (float)D[r * 3 + c];
                batch->y[k] = (float)(Y[r * 3 + c] + Y[c * 3 + r]) * 0.5f;
            }
    }
}

static void run_batch(Batch *batch, pbmpm_isa isa)
{
    const Probes *probes = probes_for(isa, batch->dimension);
    const uint32_t mode = float_mode_enter();
    probes->stress_all(&batch->material, batch->f, batch->d, batch->y, batch->s, BATCH);
    probes->rotate_all(batch->f, batch->rotation, BATCH);
    float_mode_leave(mode);
}

/* Compares with the reference. Where F has no rotation of its own, D is 0, and R is taken from the kernels: another copy of the same code,
 * which may round it differently. */
static void check_batch(const Batch *batch, bool at_rest)
{
    const int n = batch->dimension;
    for (int i = 0; i < BATCH; i++) {
        double F[9], D[9], Y[9], R[9], S[9], expected[9] = {0}, next[9] = {0};
        widen(batch->f + 9 * i, F);
        widen(batch->d + 9 * i, D);
        widen(batch->y + 9 * i, Y);
        widen(batch->s + 9 * i, S);
        widen(batch->rotation + 9 * i, R);
        double near[9];
        reference_near(n, D, near);
        matrix_multiply(n, near, F, next);
        for (int k = 0; k < 9; k++) next[k] += F[k];
        const double turned = bound_rotation(n, next, at_rest ? 0.0 : bound_advance(n, F, near, 0.0));
        const double bound = bound_stress(n, &batch->material, F, D, Y, 0.0, turned);
        reference_stress(n, &batch->material, F, D, Y, at_rest ? R : NULL, expected);
        for (int r = 0; r < n; r++)
            for (int c = 0; c < n; c++) {
                check_near(expected[r * 3 + c], S[r * 3 + c], bound, "stress", i);
                check_true(S[r * 3 + c] == S[c * 3 + r], "a stress is symmetric", i);
            }
    }
}

static const float moduli[] = {1e-3f, 1.0f, 30.0f, 1e3f, 1e5f}; /* the last: 1000 iterations */

static void check_stress(const char *name, MakeParticle *make, bool at_rest)
{
    static Batch batch;
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            Random random = {7};
            check_subject(name, isa, dimension);
            for (size_t k = 0; k < 3 * sizeof moduli / sizeof *moduli; k++) {
                static const float ratios[] = {0.0f, 1.0f, 40.0f};
                batch.dimension = dimension;
                batch.material = (KernelMaterial){
                    .kind = K_SOLID, .relaxation = k % 2 ? 1.5f : 1.0f, .shear = moduli[k / 3], .dilation = moduli[k / 3] * ratios[k % 3]};
                fill_batch(&batch, &random, make);
                run_batch(&batch, isa);
                check_batch(&batch, at_rest);
            }
        }
    check_report(name);
}

static void moderate(Random *random, int n, double F[9], double D[9], double Y[9])
{
    double s[3];
    random_array(random, s, 3, 0.5, 2.0);
    matrix_random_with_singular_values(random, n, s, F);
    random_array(random, D, 9, -0.2, 0.2);
    random_array(random, Y, 9, -0.5, 0.5);
}

/* What would fly apart or through itself. */
static void fast(Random *random, int n, double F[9], double D[9], double Y[9])
{
    double s[3];
    random_array(random, s, 3, 0.5, 2.0);
    matrix_random_with_singular_values(random, n, s, F);
    random_array(random, D, 9, -2.0, 2.0);
    random_array(random, Y, 9, -0.5, 0.5);
}

static void strained(Random *random, int n, double F[9], double D[9], double Y[9])
{
    double s[3];
    (void)D;
    for (int a = 0; a < 3; a++) s[a] = pow(10.0, random_in(random, -1.0, 1.3)); /* 0.1 to 20 */
    matrix_random_with_singular_values(random, n, s, F);
    random_array(random, Y, 9, -0.5, 0.5);
}

static void twentyfold(Random *random, int n, double F[9], double D[9], double Y[9])
{
    const double s[3] = {20.0, 20.0, 20.0};
    (void)D;
    matrix_random_with_singular_values(random, n, s, F);
    random_array(random, Y, 9, -0.5, 0.5);
}

static void inverted(Random *random, int n, double F[9], double D[9], double Y[9])
{
    double s[3];
    (void)D;
    random_array(random, s, 3, 0.2, 2.0);
    s[n - 1] = -s[n - 1];
    matrix_random_with_singular_values(random, n, s, F);
    random_array(random, Y, 9, -0.5, 0.5);
}

static void singular(Random *random, int n, double F[9], double D[9], double Y[9])
{
    double s[3] = {random_in(random, 0.2, 2.0), random_below(random, 2) ? 0.5 : 0.0, 0.0};
    (void)D;
    if (n == 2) s[1] = 0.0;
    matrix_random_with_singular_values(random, n, s, F);
    random_array(random, Y, 9, -0.5, 0.5);
}

static void nothing(Random *random, int n, double F[9], double D[9], double Y[9])
{
    (void)n;
    (void)F;
    (void)D;
    random_array(random, Y, 9, -0.5, 0.5);
}

static void test_stress_of_moderate_strain(void) { check_stress("moderate strain", moderate, false); }
static void test_stress_of_fast_strain(void) { check_stress("up to 2 per substep", fast, false); }
static void test_stress_of_large_strain(void) { check_stress("singular values from 0.1 to 20", strained, true); }
static void test_stress_of_twentyfold_strain(void) { check_stress("20 I, turned", twentyfold, true); }
static void test_stress_of_inverted_matter(void) { check_stress("inverted", inverted, true); }
static void test_stress_of_singular_matter(void) { check_stress("singular", singular, true); }
static void test_stress_of_no_matter(void) { check_stress("F = 0", nothing, true); }

/* Matter that hardly resists is left alone, X = sym(D + (S' - Y) / w) = sym(D - Y / w), but that what closes is resisted, and no eigenvalue is below -REF_SUBSTEP_STRAIN. Turns
 * are no closing: those by a radian and more change nothing. */
static void check_closing(Batch *batch, pbmpm_isa isa)
{
    const int n = batch->dimension;
    Random random = {11};
    fill_batch(batch, &random, fast);
    for (int i = 0; i < BATCH; i += 2)
        for (int r = 0; r < n; r++)
            for (int c = 0; c < n; c++) {
                batch->d[9 * i + 3 * r + c] = r == c ? 0.0f : (r < c ? 1.0f : -1.0f);
                batch->y[9 * i + 3 * r + c] = 0.0f;
            }
    run_batch(batch, isa);
    for (int i = 0; i < BATCH; i++) {
        double left[9] = {0}, u[9], s[3], v[9];
        for (int r = 0; r < n; r++)
            for (int c = 0; c < n; c++) {
                const int k = 9 * i + 3 * r + c, t = 9 * i + 3 * c + r;
                const double D = 0.5 * ((double)batch->d[k] + (double)batch->d[t]);
                left[3 * r + c] = D + ((double)batch->s[k] - (double)batch->y[k]) / (double)batch->material.relaxation;
                if (i % 2 == 0) check_near(0.0, left[3 * r + c], 1e-5, "a turn is left alone", i);
            }
        const double shift = matrix_norm(n, left);
        for (int a = 0; a < n; a++) left[4 * a] += shift;
        matrix_decompose(n, left, u, s, v);
        check_true(s[n - 1] - shift > -REF_SUBSTEP_STRAIN - 1e-5, "closed too far", i); /* 50 roundings of what is shifted by up to 6 */
    }
}

static void test_no_step_closes_matter(void)
{
    static Batch batch;
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject("closing", isa, dimension);
            batch.dimension = dimension;
            batch.material = (KernelMaterial){.kind = K_SOLID, .relaxation = 1.5f, .shear = 1e-7f};
            check_closing(&batch, isa);
        }
    check_report("closing");
}

/* A particle whose multiplier is the stress of its strain keeps it: the step's fixed point is the energy's derivative. Taking only the
 * symmetric part of a stress that is skew by strain times D, 0.015 times 1e-3, changes it where F F^T is no multiple of I: times 0.03. */
static void check_fixed_point(Batch *batch, pbmpm_isa isa, uint32_t seed)
{
    const int n = batch->dimension;
    Random random = {seed};
    for (int i = 0; i < BATCH; i++) {
        RefParticle p = {.material = batch->material};
        double s[3], S[9] = {0}, D[9] = {0};
        random_array(&random, s, 3, 0.99, 1.01);
        matrix_random_with_singular_values(&random, n, s, p.deformation);
        random_array(&random, D, 9, -1e-3, 1e-3);
        reference_multiplier(n, &p, D, S);
        for (int k = 0; k < 9; k++) {
            batch->f[9 * i + k] = (float)p.deformation[k];
            batch->d[9 * i + k] = (float)D[k];
            batch->y[9 * i + k] = (float)S[k];
        }
    }
    run_batch(batch, isa);
    const double modulus = 2.0 * n * (double)(batch->material.shear + batch->material.dilation);
    for (int i = 0; i < BATCH * 9; i++)
        if (i % 3 < n && i / 3 % 3 < n) check_near((double)batch->y[i], (double)batch->s[i], (4.5e-7 + 16.0 * UNIT_ROUNDOFF) * modulus, "stress at rest", i / 9);
}

static void test_the_stress_is_that_of_the_energy(void)
{
    static Batch batch;
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject("fixed point", isa, dimension);
            batch.dimension = dimension;
            batch.material = (KernelMaterial){.kind = K_SOLID, .relaxation = 1.5f, .shear = 3.0f};
            check_fixed_point(&batch, isa, 1);
            batch.material.dilation = 7.0f;
            check_fixed_point(&batch, isa, 2);
            batch.material.shear = 0.0f;
            check_fixed_point(&batch, isa, 3);
        }
    check_report("fixed point");
}

/* J over all of its range, expansion and compression, incompressible and soft, and all that strain may do beyond its trace. */
static void test_pressure(void)
{
    static float ratio[BATCH], second[BATCH], trace[BATCH], y[BATCH], s[BATCH];
    static const float stiffness[] = {0.0f, 1e-4f, 0.3f, 1.0f, 1e3f};
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            Random random = {9};
            check_subject("pressure", isa, dimension);
            for (int k = 0; k < 10; k++) {
                const KernelMaterial material = {.relaxation = 0.3f + 0.16f * (float)k, .inverse_stiffness = stiffness[k % 5]};
                for (int i = 0; i < BATCH; i++) {
                    ratio[i] = (float)random_in(&random, 0.05, 1.2);
                    second[i] = i % 4 ? (float)random_in(&random, -REF_GROWTH_MAX, REF_GROWTH_MAX) : 0.0f;
                    trace[i] = (float)random_in(&random, -1.0, 1.0);
                    y[i] = (float)random_in(&random, -0.2, 1.0);
                }
                const uint32_t mode = float_mode_enter();
                probes_for(isa, dimension)->pressure_all(&material, ratio, second, trace, y, s, BATCH);
                float_mode_leave(mode);
                for (int i = 0; i < BATCH; i++) {
                    const double r = (double)ratio[i], q = (double)second[i], t = (double)trace[i], given = (double)y[i];
                    check_near(reference_pressure(dimension, &material, r, q, t, given), (double)s[i],
                               bound_pressure(dimension, &material, r, q, t, given, 0.0), "pressure", i);
                }
            }
        }
    check_report("pressure");
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_mixed_materials);
    RUN_TEST(test_second_order);
    RUN_TEST(test_single_particles_far_apart);
    RUN_TEST(test_crowded_cells);
    RUN_TEST(test_all_densities);
    RUN_TEST(test_calm_liquid);
    RUN_TEST(test_calm_liquid_without_gravity);
    RUN_TEST(test_quiet_liquid);
    RUN_TEST(test_fine_motion);
    RUN_TEST(test_all_fine_motion_is_all_of_the_velocity);
    RUN_TEST(test_stress_of_moderate_strain);
    RUN_TEST(test_stress_of_fast_strain);
    RUN_TEST(test_stress_of_large_strain);
    RUN_TEST(test_no_step_closes_matter);
    RUN_TEST(test_stress_of_twentyfold_strain);
    RUN_TEST(test_stress_of_inverted_matter);
    RUN_TEST(test_stress_of_singular_matter);
    RUN_TEST(test_stress_of_no_matter);
    RUN_TEST(test_the_stress_is_that_of_the_energy);
    RUN_TEST(test_pressure);
    return UNITY_END();
}
