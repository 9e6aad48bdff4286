#include "contact/walls_lump.h"

#include <math.h>
#include <string.h>

/* The inverse where M has mass; what is left of a direction after the others is left at rest where it is rounding. */
static void invert(const float m[6], float out[6])
{
    static const double LEAST = 1e-5; /* of the trace: lumped in single precision */
    if (m[1] == 0.0f && m[2] == 0.0f && m[4] == 0.0f) { /* for speed: walls along the axes give diagonals, whose inverse by the same law is this */
        const float least_of_all = (float)LEAST * fmaxf(m[0] + m[3] + m[5], 0.0f);
        for (int k = 0; k < 6; k++) out[k] = (k == 0 || k == 3 || k == 5) && m[k] > least_of_all ? 1.0f / m[k] : 0.0f;
        return;
    }
    double a[3][3] = {{m[0], m[1], m[2]}, {m[1], m[3], m[4]}, {m[2], m[4], m[5]}}, inverse[3][3] = {{0}};
    const double least = LEAST * fmax(a[0][0] + a[1][1] + a[2][2], 0.0);
    int order[3], count = 0;
    bool used[3] = {false, false, false};
    double l[3][3] = {{0}};
    memset(out, 0, 6 * sizeof *out);
    for (;;) { /* Cholesky with the largest pivot first */
        int best = -1;
        for (int i = 0; i < 3; i++)
            if (!used[i] && (best < 0 || a[i][i] > a[best][best])) best = i;
        if (best < 0 || !(a[best][best] > least)) break;
        used[best] = true;
        order[count] = best;
        const double root = sqrt(a[best][best]);
        for (int i = 0; i < 3; i++) l[i][count] = used[i] && i != best ? 0.0 : a[i][best] / root;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                if (!used[i] && !used[j]) a[i][j] -= l[i][count] * l[j][count];
        for (int i = 0; i < 3; i++)
            if (!used[i]) a[i][best] = a[best][i] = 0.0;
        count++;
    }
    for (int e = 0; e < count; e++) { /* columns of the inverse, among the pivots */
        double y[3], x[3];
        for (int i = 0; i < count; i++) {
            y[i] = i == e ? 1.0 : 0.0;
            for (int k = 0; k < i; k++) y[i] -= l[order[i]][k] * y[k];
            y[i] /= l[order[i]][i];
        }
        for (int i = count - 1; i >= 0; i--) {
            x[i] = y[i];
            for (int k = i + 1; k < count; k++) x[i] -= l[order[k]][i] * x[k];
            x[i] /= l[order[i]][i];
        }
        for (int i = 0; i < count; i++) inverse[order[i]][order[e]] = x[i];
    }
    int k = 0;
    for (int r = 0; r < 3; r++)
        for (int c = r; c < 3; c++) out[k++] = (float)(0.5 * (inverse[r][c] + inverse[c][r]));
}

Columns walls_inverse(const float lump[6])
{
    float inverse[6];
    invert(lump, inverse);
    return symmetric_columns(inverse);
}

static void square(const Columns *m, float out[6])
{
    const Four *row = m->column;
    int k = 0;
    for (int r = 0; r < 3; r++)
        for (int c = r; c < 3; c++) out[k++] = row[r][0] * row[c][0] + row[r][1] * row[c][1] + row[r][2] * row[c][2];
}

void walls_lump(const Walls *walls, uint32_t place, int dimension)
{
    WallNode *node = walls->node.data;
    const WallEntry *entry = walls->entry.data;
    const WallLink *link = walls->link.data;
    float *m = node[place].lump, part[6];
    for (int k = 0; k < 6; k++) m[k] = node[place].mass * node[place].own[k];
    for (uint32_t l = node[place].link_begin; l < node[place].link_moving; l++) {
        const WallEntry *e = &entry[link[l].from];
        const float mass = node[e->follower].mass * link[l].weight;
        square(&e->matrix, part);
        for (int k = 0; k < 6; k++) m[k] += mass * part[k];
    }
    if (dimension == 2) m[2] = m[4] = m[5] = 0.0f;
}
