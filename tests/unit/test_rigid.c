/* Rigid motions of bodies: the system of their six modes, what stiffens it, how far speeds may rise, and impulses about a point. */
#include <float.h>
#include <math.h>
#include <string.h>
#include <unity.h>

#include "contact/impulses.h"
#include "solvers/primal/primal_solve.h"
#include "random.h"

void setUp(void) {}
void tearDown(void) {}

enum { ROUNDS = 200 };

static void random_vector(Random *random, double size, double *v, int count)
{
    for (int a = 0; a < count; a++) v[a] = random_in(random, -size, size);
}

/* The motion of a point at `arm`: translation and rotation, a mode each. */
static void motion_of_point(const double arm[3], const double mode[RIGID_MODES], double motion[3])
{
    for (int a = 0; a < 3; a++) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        motion[a] = mode[a] + mode[3 + b] * arm[c] - mode[3 + c] * arm[b];
    }
}

/* Springs at random points along random directions: the forces of the solution's motion are those that were asked for. */
static void test_modes_are_solved_for(void)
{
    enum { SPRINGS = 12 };
    Random random = {3};
    for (int round = 0; round < ROUNDS; round++) {
        RigidBody body = {.used = true};
        double arm[SPRINGS][3], stiffness[SPRINGS], wanted[RIGID_MODES], found[RIGID_MODES], force[RIGID_MODES] = {0};
        float way[SPRINGS][3];
        for (int s = 0; s < SPRINGS; s++) {
            random_vector(&random, 3.0, arm[s], 3);
            for (int a = 0; a < 3; a++) way[s][a] = (float)random_in(&random, -1.0, 1.0);
            stiffness[s] = random_in(&random, 0.5, 2.0);
            primal_add_along(&body, arm[s], way[s], stiffness[s]);
        }
        random_vector(&random, 1.0, wanted, RIGID_MODES);
        memcpy(body.sum, wanted, sizeof wanted);
        primal_factorise(&body);
        primal_solve_modes(&body, found);
        for (int s = 0; s < SPRINGS; s++) {
            double motion[3], along = 0.0, moment[3];
            motion_of_point(arm[s], found, motion);
            for (int a = 0; a < 3; a++) along += motion[a] * (double)way[s][a];
            for (int a = 0; a < 3; a++) moment[a] = stiffness[s] * along * (double)way[s][a];
            for (int a = 0; a < 3; a++) {
                const int b = (a + 1) % 3, c = (a + 2) % 3;
                force[a] += moment[a];
                force[3 + a] += arm[s][b] * moment[c] - arm[s][c] * moment[b];
            }
        }
        for (int m = 0; m < RIGID_MODES; m++) TEST_ASSERT_DOUBLE_WITHIN(1e-3, wanted[m], force[m]);
    }
}

/* The largest share of a change with which a speed stays within its limit. */
static void test_speeds_rise_to_their_limit_and_no_further(void)
{
    Random random = {4};
    int cut = 0;
    for (int round = 0; round < ROUNDS; round++) {
        double v[3], more[3], limit = random_in(&random, 1.0, 3.0), reached2 = 0.0, full2 = 0.0;
        random_vector(&random, 0.5, v, 3);
        random_vector(&random, 2.0, more, 3);
        const double share = primal_share_within(v, more, limit);
        for (int a = 0; a < 3; a++) reached2 += (v[a] + share * more[a]) * (v[a] + share * more[a]);
        for (int a = 0; a < 3; a++) full2 += (v[a] + more[a]) * (v[a] + more[a]);
        if (full2 <= limit * limit) {
            TEST_ASSERT_TRUE(share == 1.0);
        } else {
            TEST_ASSERT_DOUBLE_WITHIN(1e-9, limit, sqrt(reached2));
            cut++;
        }
    }
    TEST_ASSERT_TRUE(cut > ROUNDS / 10 && cut < ROUNDS);
    const double fast[3] = {5, 0, 0}, faster[3] = {1, 0, 0}, slower[3] = {-6, 0, 0};
    TEST_ASSERT_TRUE(primal_share_within(fast, faster, 2.0) == 0.0); /* who is too fast gets no faster */
    TEST_ASSERT_TRUE(primal_share_within(fast, slower, 2.0) == 1.0);
}

/* What matter gains obstacles lose, and the moment about any point follows from where that was. */
static void test_impulses_about_any_point(void)
{
    Random random = {5};
    for (int round = 0; round < ROUNDS; round++) {
        ImpulseSum sum = {0};
        double linear[3] = {0}, angular[3] = {0}, about[3];
        random_vector(&random, 4.0, about, 3);
        for (int k = 0; k < 5; k++) {
            double point[3], gained[4] = {[3] = 1e3}; /* what follows it is not read */
            random_vector(&random, 4.0, point, 3);
            random_vector(&random, 2.0, gained, 3);
            impulse_add(&sum, point, gained);
            for (int a = 0; a < 3; a++) {
                const int b = (a + 1) % 3, c = (a + 2) % 3;
                linear[a] -= gained[a];
                angular[a] -= (point[b] - about[b]) * gained[c] - (point[c] - about[c]) * gained[b];
            }
        }
        for (int dimension = 2; dimension <= 3; dimension++) {
            const pbmpm_impulse impulse = impulse_about(&sum, about, dimension);
            for (int a = 0; a < 3; a++) {
                TEST_ASSERT_DOUBLE_WITHIN(1e-12, linear[a], impulse.linear[a]);
                TEST_ASSERT_DOUBLE_WITHIN(1e-10, dimension == 2 && a < 2 ? 0.0 : angular[a], impulse.angular[a]);
            }
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_modes_are_solved_for);
    RUN_TEST(test_speeds_rise_to_their_limit_and_no_further);
    RUN_TEST(test_impulses_about_any_point);
    return UNITY_END();
}
