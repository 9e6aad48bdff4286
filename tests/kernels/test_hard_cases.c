/* Particles in states that no motion should lead to: singular, reflected or infinite F, NaN anywhere. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "check.h"
#include "isas.h"
#include "matrices.h"
#include "stages.h"

void setUp(void) {}
void tearDown(void) {}

static SceneSpec hard_scene(const char *name, MakeDeformation *deform)
{
    SceneSpec spec = {.name = name,
                      .material = {scene_material(PBMPM_ELASTIC), scene_material(PBMPM_LIQUID), scene_material(PBMPM_ELASTIC)},
                      .materials = 3,
                      .cells = 40,
                      .most_per_cell = 8,
                      .spread = 3,
                      .speed = 0.3,
                      .gradient = 0.3,
                      .ratio_min = 0.05,
                      .ratio_max = 1.2,
                      .growth_max = 1.0f,
                      .deform = deform};
    spec.material[0].elasticity_ratio = 0.5f;
    spec.material[2].strain_policy = PBMPM_STRAIN_DELETE;
    spec.material[2].condition_max = 1e6f;
    return spec;
}

/* ---- F ---- */

static void reflected(Random *random, int dimension, double *F)
{
    double s[3];
    random_array(random, s, 3, 0.2, 2.0);
    s[dimension - 1] = -s[dimension - 1];
    matrix_random_with_singular_values(random, dimension, s, F);
}

static void of_low_rank(Random *random, int dimension, double *F)
{
    double s[3] = {random_in(random, 0.2, 2.0), random_below(random, 2) ? 0.5 : 0.0, 0.0};
    if (dimension == 2) s[1] = 0.0;
    matrix_random_with_singular_values(random, dimension, s, F);
}

static void all_zero(Random *random, int dimension, double *F)
{
    (void)random;
    (void)dimension;
    memset(F, 0, 9 * sizeof *F);
}

static void of_any_size(Random *random, int dimension, double *F)
{
    (void)dimension;
    random_array(random, F, 9, -2.0, 2.0);
    const double size = pow(10.0, random_in(random, -30.0, 5.6));
    for (int k = 0; k < 9; k++) F[k] *= size;
}

/* Two corrections, each at most rebound_max, on top of what the nodes say: that bounds every displacement. */
static void check_bounded(Scene *scene, double limit)
{
    RefGrid nodes = scene_nodes(scene);
    const size_t count = (size_t)nodes.size[0] * (size_t)nodes.size[1] * (size_t)nodes.size[2];
    for (size_t i = 0; i < count; i++)
        for (int a = 0; a < scene->step.dimension; a++)
            check_true(fabs(nodes.node[i].u[a]) <= limit, "displacements stay bounded", (long)i);
    reference_grid_free(&nodes);
}

static void check_finite(const Scene *scene)
{
    for (uint32_t i = 0; i < scene->world->particles.count; i++) {
        const RefParticle p = scene_particle(scene, i);
        if (p.status == K_NOT_FINITE) continue; /* it has to go */
        double sum = p.mass + p.volume_ratio;
        for (int a = 0; a < 3; a++) sum += p.fraction[a] + p.velocity[a];
        for (int k = 0; k < 9; k++) sum += p.affine[k] + p.deformation[k];
        check_true(isfinite(sum), "state is finite", (long)i);
    }
}

/* D is at most four times the largest displacement of a node, per entry, and a correction adds rebound_max (1 by default) or,
 * for a liquid, relaxation times as much as it was; a node is at most 3/2 cells away on each axis. */
static double grown(double u, int dimension)
{
    const double D = 4.0 * u, corrected = D * 2.5 + 3.0;
    return u + 1.5 * dimension * corrected;
}

static void check_hard(const char *name, MakeDeformation *deform, bool check_strain)
{
    const SceneSpec spec = hard_scene(name, deform);
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject(name, isa, dimension);
            Scene scene = scene_open(&spec, isa, dimension, 11);
            scene_bind(&scene, check_strain);
            stages_check_scatter(&scene);
            stages_check_predict(&scene);
            double limit = 0.3 + 0.3 * 1.5 * dimension + 0.1;
            for (int i = 0; i < 2; i++) {
                stages_check_iterate(&scene);
                stages_check_update(&scene);
                check_bounded(&scene, limit = grown(limit, dimension));
            }
            stages_check_integrate(&scene);
            check_finite(&scene);
            scene_close(&scene);
        }
}

static void test_reflected(void)
{
    check_hard("reflected F", reflected, false);
    check_hard("reflected F, found out", reflected, true);
}

static void test_low_rank(void)
{
    check_hard("singular F", of_low_rank, false);
    check_hard("singular F, found out", of_low_rank, true);
}

static void test_zero(void)
{
    check_hard("F = 0", all_zero, false);
    check_hard("F = 0, found out", all_zero, true);
}

/* As they may come from outside, up to 1e6: brought into range before their first use. */
static void test_any_size(void) { check_hard("F of any size", of_any_size, true); }

/* ---- NaN and infinity ---- */

typedef float *FieldOf(const Particles *p);
static float *fraction_of(const Particles *p) { return p->fraction[1]; }
static float *velocity_of(const Particles *p) { return p->velocity[0]; }
static float *affine_of(const Particles *p) { return p->affine[3]; }
static float *ratio_of(const Particles *p) { return p->volume_ratio; }
static float *mass_of(const Particles *p) { return p->mass; }
static float *deformation_of(const Particles *p) { return p->deformation[4]; }

static void run_all(Scene *scene)
{
    scene_run_particles(scene, scene->kernels->scatter);
    scene_run_nodes(scene, scene->kernels->predict_nodes);
    for (int i = 0; i < 2; i++) {
        scene_run_particles(scene, scene->kernels->iterate);
        scene_run_nodes(scene, scene->kernels->update_nodes);
    }
    scene_run_particles(scene, scene->kernels->integrate);
}

/* What a particle in quarantine is: massless, undeformed, in the middle of its cell. */
static void make_harmless(Particles *p, uint32_t row)
{
    p->mass[row] = 0.0f;
    p->volume_ratio[row] = 1.0f;
    for (int a = 0; a < p->dimension; a++) {
        p->fraction[a][row] = 0.0f;
        for (int b = 0; b < p->dimension; b++) p->deformation[a * 3 + b][row] = a == b;
    }
}

/* Member by member: what lies between members is anything. */
static bool same_bits(const RefParticle *a, const RefParticle *b)
{
    return memcmp(a->cell, b->cell, sizeof a->cell) == 0 && memcmp(a->fraction, b->fraction, sizeof a->fraction) == 0 &&
           memcmp(a->velocity, b->velocity, sizeof a->velocity) == 0 && memcmp(a->affine, b->affine, sizeof a->affine) == 0 &&
           memcmp(&a->volume_ratio, &b->volume_ratio, sizeof a->volume_ratio) == 0 && memcmp(&a->mass, &b->mass, sizeof a->mass) == 0 &&
           memcmp(a->deformation, b->deformation, sizeof a->deformation) == 0;
}

/* A bad particle is marked, and all others end up bit for bit as if it had been a harmless one. */
static void check_quarantine(Scene *bad, Scene *without, uint32_t row)
{
    run_all(bad);
    run_all(without);
    for (uint32_t i = 0; i < bad->world->particles.count; i++) {
        const RefParticle a = scene_particle(bad, i), b = scene_particle(without, i);
        if (i == row) {
            check_true(a.status == K_NOT_FINITE && a.mass == 0.0, "a bad particle is marked", (long)i);
            continue;
        }
        check_true(a.status == b.status, "others are not marked", (long)i);
        check_true(same_bits(&a, &b), "others are not affected", (long)i);
    }
    check_finite(bad);
}

static void test_quarantine(void)
{
    static FieldOf *const fields[] = {fraction_of, velocity_of, affine_of, ratio_of, mass_of, deformation_of};
    static const float values[] = {NAN, INFINITY, -INFINITY, 3e38f};
    const SceneSpec spec = hard_scene("quarantine", NULL);
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject(spec.name, isa, dimension);
            for (int k = 0; k < 24; k++) {
                Scene bad = scene_open(&spec, isa, dimension, 3), without = scene_open(&spec, isa, dimension, 3);
                Particles *p = &bad.world->particles;
                uint32_t row = (uint32_t)k * 7 % p->count;
                while (fields[k % 6] == deformation_of && bad.world->materials.kernel[p->material[row]].kind != K_SOLID) row++;
                fields[k % 6](p)[row] = values[k / 6];
                make_harmless(&without.world->particles, row);
                check_quarantine(&bad, &without, row);
                scene_close(&bad);
                scene_close(&without);
            }
        }
}

/* ---- Lanes beyond the end of a run ---- */

/* A gang reads whatever particles come after its run; what they hold must not show. Here they hold a volume ratio of 0 and
 * a singular F, which their own material can live with. */
static void test_what_follows_a_run_does_not_show(void)
{
    SceneSpec spec = hard_scene("what follows a run", of_low_rank);
    spec.most_per_cell = 3;
    for (int dimension = 2; dimension <= 3; dimension++)
        EACH_ISA(isa)
        {
            check_subject(spec.name, isa, dimension);
            Scene scene = scene_open(&spec, isa, dimension, 8);
            const Particles *p = &scene.world->particles;
            for (uint32_t i = 0; i < p->count; i++)
                if (scene.world->materials.kernel[p->material[i]].kind == K_SOLID) p->volume_ratio[i] = 0.0f;
            stages_check(&scene);
            scene_close(&scene);
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_reflected);
    RUN_TEST(test_low_rank);
    RUN_TEST(test_zero);
    RUN_TEST(test_any_size);
    RUN_TEST(test_quarantine);
    RUN_TEST(test_what_follows_a_run_does_not_show);
    return UNITY_END();
}
