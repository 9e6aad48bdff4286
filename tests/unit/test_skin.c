/* The cases of marching cubes: all 256, and all pairs of cubes that share a side. */
#include <stdbool.h>
#include <string.h>

#include <unity.h>

#include "skin/cases.h"

static Cases cases;

void setUp(void) { cases_make(&cases); }
void tearDown(void) {}

static bool is_inside(int set, int corner) { return set >> corner & 1; }
static bool is_cut(int set, int edge)
{
    const int low = case_corner(edge), high = low | 1 << case_axis(edge);
    return is_inside(set, low) != is_inside(set, high);
}

/* Whether two edges lie in the side at `end` of an axis. */
static bool in_side(int edge, int axis, int end) { return case_axis(edge) != axis && (case_corner(edge) >> axis & 1) == end; }

/* How often a case's triangles go from one edge to another. */
static void count_ways(int set, int way[CUBE_EDGES][CUBE_EDGES])
{
    memset(way, 0, sizeof(int[CUBE_EDGES][CUBE_EDGES]));
    for (int t = 0; t < cases.triangles[set]; t++)
        for (int k = 0; k < 3; k++) way[cases.edge[set][3 * t + k]][cases.edge[set][3 * t + (k + 1) % 3]]++;
}

/* Each cut edge has triangles and no other has; a line between two vertices has two triangles, or one if it lies in a side, where the neighbour has the other. */
static void test_each_case_is_a_piece_of_a_closed_surface(void)
{
    for (int set = 0; set < CUBE_CASES; set++) {
        int way[CUBE_EDGES][CUBE_EDGES];
        count_ways(set, way);
        for (int e = 0; e < CUBE_EDGES; e++) {
            int used = 0;
            for (int f = 0; f < CUBE_EDGES; f++) {
                bool side = false;
                for (int s = 0; s < 6; s++) side |= in_side(e, s / 2, s % 2) && in_side(f, s / 2, s % 2);
                used += way[e][f];
                TEST_ASSERT_TRUE(way[e][f] <= 1);
                if (side)
                    TEST_ASSERT_TRUE(way[e][f] + way[f][e] <= 1);
                else
                    TEST_ASSERT_EQUAL_INT(way[e][f], way[f][e]);
            }
            TEST_ASSERT_EQUAL_INT(is_cut(set, e), used > 0);
        }
    }
}

/* The same edge as the neighbour across a side has it. */
static int across(int edge, int axis)
{
    for (int e = 0; e < CUBE_EDGES; e++)
        if (case_axis(e) == case_axis(edge) && case_corner(e) == (case_corner(edge) ^ 1 << axis)) return e;
    return -1;
}

/* What two cubes have in the side between them: the lines of one are those of the other, in the opposite direction. */
static void test_cubes_meet(void)
{
    for (int axis = 0; axis < 3; axis++)
        for (int one = 0; one < CUBE_CASES; one++)
            for (int other = 0; other < CUBE_CASES; other++) {
                int way[CUBE_EDGES][CUBE_EDGES], back[CUBE_EDGES][CUBE_EDGES];
                bool fits = true;
                for (int c = 0; c < CUBE_CORNERS; c++) fits &= !(c >> axis & 1) || is_inside(one, c) == is_inside(other, c ^ 1 << axis);
                if (!fits) continue;
                count_ways(one, way);
                count_ways(other, back);
                for (int e = 0; e < CUBE_EDGES; e++)
                    for (int f = 0; f < CUBE_EDGES; f++)
                        if (in_side(e, axis, 1) && in_side(f, axis, 1)) TEST_ASSERT_EQUAL_INT(way[e][f], back[across(f, axis)][across(e, axis)]);
            }
}

/* A corner that alone is inside gets a triangle that faces away from it. */
static void test_triangles_face_outwards(void)
{
    for (int c = 0; c < CUBE_CORNERS; c++) {
        double p[3][3], six = 0.0;
        TEST_ASSERT_EQUAL_INT(1, cases.triangles[1 << c]);
        for (int k = 0; k < 3; k++) {
            const int e = cases.edge[1 << c][k];
            for (int a = 0; a < 3; a++) p[k][a] = (a == case_axis(e) ? 0.5 : case_corner(e) >> a & 1) - (c >> a & 1);
        }
        for (int a = 0; a < 3; a++) six += p[0][a] * (p[1][(a + 1) % 3] * p[2][(a + 2) % 3] - p[1][(a + 2) % 3] * p[2][(a + 1) % 3]);
        TEST_ASSERT_TRUE(six > 0.0);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_each_case_is_a_piece_of_a_closed_surface);
    RUN_TEST(test_cubes_meet);
    RUN_TEST(test_triangles_face_outwards);
    return UNITY_END();
}
