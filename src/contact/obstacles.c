#include "contact/obstacles.h"

#include <math.h>
#include <string.h>

double obstacle_distance(const Obstacle *o, const double point[3], double normal[3]) { return solid_distance(&o->end, point, normal); }

/* x -> end + turn (x - start). */
void obstacle_motion(const Obstacle *o, const double point[3], double cell_size, float limit, float out[3])
{
    memset(out, 0, 3 * sizeof *out);
    if (!o->moves) return;
    double moved[3], length = 0.0;
    for (int r = 0; r < 3; r++) {
        moved[r] = o->end.position[r] - point[r];
        for (int c = 0; c < 3; c++) moved[r] += o->turn[r * 3 + c] * (point[c] - o->start.position[c]);
        moved[r] /= cell_size;
        length += moved[r] * moved[r];
    }
    const double scale = length > (double)limit * limit ? limit / sqrt(length) : 1.0;
    for (int r = 0; r < o->start.dimension; r++) out[r] = (float)(moved[r] * scale);
}

void free_body_yields(const FreeBody *body, const double push[6], double change[6])
{
    memset(change, 0, 6 * sizeof *change);
    for (int k = 0; k < body->ways; k++) {
        double along = 0.0;
        for (int a = 0; a < 6; a++) along += body->way[k][a] * push[a];
        for (int a = 0; a < 6; a++) change[a] += along * body->way[k][a];
    }
}
