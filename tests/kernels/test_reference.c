/* The reference itself: what the maths promises, checked to double precision. */
#include <math.h>
#include <string.h>
#include <unity.h>

#include "matrices.h"
#include "reference.h"

void setUp(void) {}
void tearDown(void) {}

static const int32_t low[3] = {-4, -4, -4}, high[3] = {4, 4, 4};

static RefParticle random_particle(Random *random)
{
    RefParticle p = {.mass = random_in(random, 0.1, 10.0), .volume_ratio = random_in(random, 0.5, 1.2)};
    for (int a = 0; a < 3; a++) p.cell[a] = (int32_t)random_below(random, 5) - 2;
    random_array(random, p.fraction, 3, -0.5, 0.5);
    random_array(random, p.deformation, 9, -0.3, 0.3);
    for (int a = 0; a < 3; a++) p.deformation[a * 4] += 1.0;
    p.material = (KernelMaterial){.relaxation = 1.0f, .elasticity_ratio = 1.0f, .rebound_max = 10.0f, .growth_max = 10.0f, .head2 = 1e6f, .pressure_max = 1e6f,
                                  .strain_min = 0.1f, .strain_max = 20.0f, .inverse_density = 0.5f};
    return p;
}

/* sum w = 1, sum w x = 0, sum w x x^T = I/4: what makes D = 4 sum w u x^T a gradient. */
static void test_moments_of_the_splines(void)
{
    Random random = {1};
    for (int d = 2; d <= 3; d++)
        for (int i = 0; i < 200; i++) {
            const RefParticle p = random_particle(&random);
            const RefStencil s = reference_stencil(d, &p);
            double sum = 0.0, first[3] = {0}, second[9] = {0};
            for (int n = 0; n < s.count; n++) {
                TEST_ASSERT_TRUE(s.weight[n] >= 0.0);
                sum += s.weight[n];
                for (int a = 0; a < d; a++) {
                    first[a] += s.weight[n] * s.offset[n][a];
                    for (int b = 0; b < d; b++) second[a * 3 + b] += s.weight[n] * s.offset[n][a] * s.offset[n][b];
                }
            }
            TEST_ASSERT_DOUBLE_WITHIN(1e-14, 1.0, sum);
            for (int a = 0; a < d; a++) {
                TEST_ASSERT_DOUBLE_WITHIN(1e-14, 0.0, first[a]);
                for (int b = 0; b < d; b++) TEST_ASSERT_DOUBLE_WITHIN(1e-14, a == b ? 0.25 : 0.0, second[a * 3 + b]);
            }
        }
}

/* Displacements u = d + D x on the grid come back as they are. */
static void test_affine_fields_are_gathered_exactly(void)
{
    Random random = {2};
    for (int n = 2; n <= 3; n++)
        for (int i = 0; i < 50; i++) {
            const RefParticle p = random_particle(&random);
            const RefStencil s = reference_stencil(n, &p);
            RefGrid grid = reference_grid(n, low, high);
            double d[3], D[9], found_d[3], found_D[9];
            random_array(&random, d, 3, -1.0, 1.0);
            random_array(&random, D, 9, -1.0, 1.0);
            for (int k = 0; k < s.count; k++)
                for (int r = 0; r < n; r++) {
                    double *u = &grid.node[reference_index(&grid, s.node[k])].u[r];
                    *u = d[r];
                    for (int c = 0; c < n; c++) *u += D[r * 3 + c] * s.offset[k][c];
                }
            reference_gather(&grid, &p, found_d, found_D);
            for (int r = 0; r < n; r++) {
                TEST_ASSERT_DOUBLE_WITHIN(1e-13, d[r], found_d[r]);
                for (int c = 0; c < n; c++) TEST_ASSERT_DOUBLE_WITHIN(1e-13, D[r * 3 + c], found_D[r * 3 + c]);
            }
            reference_grid_free(&grid);
        }
}

/* The gradient of the motion is that of differences: over 1e-6 they have the rounding of 1e-16 / 1e-6, and quadratic splines no error but their jump
 * of curvature. */
static void test_the_gradient_is_that_of_the_motion(void)
{
    Random random = {8};
    for (int n = 2; n <= 3; n++)
        for (int i = 0; i < 50; i++) {
            RefParticle p = random_particle(&random);
            RefGrid grid = reference_grid(n, low, high);
            const size_t count = (size_t)grid.size[0] * (size_t)grid.size[1] * (size_t)grid.size[2];
            double gradient[9], unused[9];
            for (size_t k = 0; k < count; k++) random_array(&random, grid.node[k].u, 3, -1.0, 1.0);
            for (int a = 0; a < n; a++) p.fraction[a] *= 0.999;
            reference_gradient(&grid, &p, gradient);
            for (int c = 0; c < n; c++) {
                double d[2][3];
                for (int side = 0; side < 2; side++) {
                    RefParticle moved = p;
                    moved.fraction[c] += side ? 1e-6 : -1e-6;
                    reference_gather(&grid, &moved, d[side], unused);
                }
                for (int r = 0; r < n; r++) TEST_ASSERT_DOUBLE_WITHIN(1e-9, (d[1][r] - d[0][r]) / 2e-6, gradient[r * 3 + c]);
            }
            reference_grid_free(&grid);
        }
}

/* Linear momentum, and angular momentum about the origin, of a grid of momenta. */
static void momentum_of(const RefGrid *grid, double linear[3], double angular[3])
{
    memset(linear, 0, 3 * sizeof *linear);
    memset(angular, 0, 3 * sizeof *angular);
    int32_t at[3];
    for (at[2] = low[2]; at[2] <= high[2]; at[2]++)
        for (at[1] = low[1]; at[1] <= high[1]; at[1]++)
            for (at[0] = low[0]; at[0] <= high[0]; at[0]++) {
                const double *p = grid->node[reference_index(grid, at)].u;
                for (int a = 0; a < 3; a++) {
                    const int b = (a + 1) % 3, c = (a + 2) % 3;
                    linear[a] += p[a];
                    angular[a] += at[b] * p[c] - at[c] * p[b];
                }
            }
}

/* Every projection changes D by a symmetric matrix: linear and angular momentum on the grid stay. */
static void test_projections_conserve_momentum(void)
{
    Random random = {3};
    for (int i = 0; i < 400; i++) {
        RefParticle p = random_particle(&random);
        RefGrid before = reference_grid(3, low, high), after = reference_grid(3, low, high);
        double d[3], D[9], linear[2][3], angular[2][3];
        p.material.kind = i % 2 ? K_LIQUID : K_SOLID;
        p.material.viscosity = 0.4f;
        p.material.elasticity_ratio = (float)(i % 3) * 0.5f;
        random_array(&random, d, 3, -1.0, 1.0);
        random_array(&random, D, 9, -0.5, 0.5);
        reference_scatter(&before, &p, d, D);
        reference_project(3, &p, d, D);
        reference_scatter(&after, &p, d, D);
        momentum_of(&before, linear[0], angular[0]);
        momentum_of(&after, linear[1], angular[1]);
        for (int a = 0; a < 3; a++) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-12 * p.mass, linear[0][a], linear[1][a]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-11 * p.mass, angular[0][a], angular[1][a]);
        }
        reference_grid_free(&before);
        reference_grid_free(&after);
    }
}

/* What already satisfies its constraint is left alone; relaxation 1 reaches the liquid's constraint at once. */
static void test_fixed_points(void)
{
    static const double still[3];
    Random random = {4};
    for (int n = 2; n <= 3; n++)
        for (int i = 0; i < 200; i++) {
            RefParticle p = random_particle(&random);
            double D[9], kept[9], inverse[9], goal[9], s[3] = {0.8, 1.25, 1.0};
            random_array(&random, D, 9, -0.5, 0.5);
            p.material.kind = K_LIQUID;
            reference_project(n, &p, still, D);
            TEST_ASSERT_DOUBLE_WITHIN(1e-12, 1.0, p.volume_ratio * (1.0 + matrix_trace(n, D)));
            memcpy(kept, D, sizeof kept);
            reference_project(n, &p, still, D);
            for (int k = 0; k < 9; k++) TEST_ASSERT_DOUBLE_WITHIN(1e-12, kept[k], D[k]);
            p.material.kind = K_SOLID;
            p.material.elasticity_ratio = (float)(i % 2);
            if (i % 2) /* a rotation, or any shape of unit volume */
                matrix_random_rotation(&random, n, goal);
            else
                matrix_random_with_singular_values(&random, n, s, goal);
            matrix_inverse(n, p.deformation, inverse);
            matrix_multiply(n, goal, inverse, D);
            for (int a = 0; a < n; a++) D[a * 4] -= 1.0;
            memcpy(kept, D, sizeof kept);
            reference_project(n, &p, still, D);
            for (int r = 0; r < n; r++)
                for (int c = 0; c < n; c++) TEST_ASSERT_DOUBLE_WITHIN(1e-11, kept[r * 3 + c], D[r * 3 + c]);
        }
}

/* No other rotation has a larger tr(R^T A), and the factors multiply to the matrix. */
static void test_decomposition(void)
{
    Random random = {5};
    for (int n = 2; n <= 3; n++)
        for (int i = 0; i < 300; i++) {
            double A[9], R[9], Q[9], u[9], s[3], v[9], vt[9], product[9], best = 0.0;
            random_array(&random, A, 9, -2.0, 2.0);
            matrix_rotation(n, A, R);
            matrix_decompose(n, A, u, s, v);
            for (int r = 0; r < n; r++)
                for (int c = 0; c < n; c++) {
                    best += R[r * 3 + c] * A[r * 3 + c];
                    u[r * 3 + c] *= s[c];
                }
            matrix_transpose(n, v, vt);
            matrix_multiply(n, u, vt, product);
            for (int r = 0; r < n; r++)
                for (int c = 0; c < n; c++) TEST_ASSERT_DOUBLE_WITHIN(1e-13, A[r * 3 + c], product[r * 3 + c]);
            TEST_ASSERT_DOUBLE_WITHIN(1e-13, 1.0, matrix_determinant(n, R));
            for (int k = 0; k < 50; k++) {
                double other = 0.0;
                matrix_random_rotation(&random, n, Q);
                for (int r = 0; r < n; r++)
                    for (int c = 0; c < n; c++) other += Q[r * 3 + c] * A[r * 3 + c];
                TEST_ASSERT_TRUE(other <= best + 1e-12);
            }
        }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_moments_of_the_splines);
    RUN_TEST(test_affine_fields_are_gathered_exactly);
    RUN_TEST(test_the_gradient_is_that_of_the_motion);
    RUN_TEST(test_projections_conserve_momentum);
    RUN_TEST(test_fixed_points);
    RUN_TEST(test_decomposition);
    return UNITY_END();
}
