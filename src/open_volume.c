#include "open_volume.h"

#include <math.h>
#include <string.h>

/* The share of a node's weight that lies outside an obstacle whose surface is at `distance` [cells]: the integral of the quadratic spline
 * up to there, as the surface is nearly flat over a cell. At least what is left one cell inside, 1/48: behind that nothing is known. */
static double open_share(double distance)
{
    if (distance >= NODE_REACH) return 1.0;
    if (distance <= -1.0) return 1.0 / 48.0;
    const double rest = NODE_REACH - fabs(distance);
    if (distance > 0.5) return 1.0 - rest * rest * rest / 6.0;
    if (distance < -0.5) return rest * rest * rest / 6.0;
    return 0.5 + distance * (0.75 - distance * distance / 3.0);
}

/* Surfaces near a node. Those that face the same way, a plane on the floor of the domain or boxes side by side, hide the same volume, so
 * that of the deepest counts; what others hide is independent of it, as at an edge or in a corner. */
enum { SURFACES = 8 };
typedef struct Shade {
    int count;
    double share[SURFACES], normal[SURFACES][3];
} Shade;

static const double SAME_WAY = 0.7; /* cosine of the angle between normals: 45 degrees, halfway to an edge */

static void shade_add(Shade *shade, double distance, const double normal[3])
{
    const double share = open_share(distance);
    if (share == 1.0) return;
    int i = 0;
    while (i < shade->count) {
        const double *other = shade->normal[i];
        if (normal[0] * other[0] + normal[1] * other[1] + normal[2] * other[2] > SAME_WAY) break;
        i++;
    }
    if (i == SURFACES || (i < shade->count && shade->share[i] <= share)) return;
    shade->count = i < shade->count ? shade->count : i + 1;
    shade->share[i] = share;
    for (int a = 0; a < 3; a++) shade->normal[i][a] = normal[a];
}

static double shade_share(const Shade *shade)
{
    double share = 1.0;
    for (int i = 0; i < shade->count; i++) share *= shade->share[i];
    return share;
}

double open_share_at(const Colliders *colliders, const double node[3], double cell_size)
{
    Shade shade = {0};
    for (int i = 0; i < colliders->obstacle_count; i++) {
        double normal[3];
        const double distance = obstacle_distance(&colliders->obstacle[i], node, normal) / cell_size;
        shade_add(&shade, distance, normal);
    }
    return shade_share(&shade);
}

typedef struct OpenJob {
    const ContactFrame *frame;
    bool resting_only;
} OpenJob;

/* Obstacles near a block. `edged`: one of them, near what its particles feel, is no plane: it may have edges. */
typedef struct Near {
    int count;
    bool edged;
    const Obstacle *obstacle[PBMPM_MAX_COLLIDERS + DOMAIN_WALLS];
} Near;

static void find_near(const OpenJob *job, int32_t block, Near *near)
{
    const ContactFrame *frame = job->frame;
    const double diagonal = sqrt((double)frame->grid->dimension), half_block = 0.5 * (K_BLOCK_AXIS - 1) * diagonal;
    double centre[3];
    near->count = 0;
    near->edged = false;
    contacts_block_centre(frame, block, centre);
    for (int i = 0; i < frame->colliders->obstacle_count; i++) {
        const Obstacle *o = &frame->colliders->obstacle[i];
        if (job->resting_only && o->moves) continue;
        const double gap = solid_least(&o->start, centre) / frame->cell_size - half_block;
        if (gap < NODE_REACH) near->obstacle[near->count++] = o;
        if (gap < NODE_REACH + diagonal && o->start.kind != PBMPM_PLANE) near->edged = true;
    }
}

static void open_block(const ContactFrame *frame, const Near *near, int32_t block)
{
    const int cells = frame->grid->block_cells;
    float *volume = (float *)frame->grid->node_volume.data + (size_t)block * (size_t)cells;
    for (int node = 0; node < cells; node++) {
        double point[3], normal[3];
        Shade shade = {0};
        if (volume[node] == 0.0f) continue;
        contacts_node_position(frame, block, node, point);
        for (int i = 0; i < near->count; i++) {
            const double distance = solid_distance(&near->obstacle[i]->start, point, normal) / frame->cell_size;
            shade_add(&shade, distance, normal);
        }
        volume[node] /= (float)shade_share(&shade);
    }
}

static void open_blocks(void *context, int32_t begin, int32_t end)
{
    const OpenJob *job = context;
    uint32_t *edged = job->frame->grid->edged.data;
    Near near;
    for (int32_t block = begin; block < end; block++) {
        find_near(job, block, &near);
        edged[block] = near.edged;
        if (near.count) open_block(job->frame, &near, block);
    }
}

void contacts_open_volume(const ContactFrame *frame, Pool *pool, bool resting_only)
{
    OpenJob job = {frame, resting_only};
    if (frame->colliders->obstacle_count == 0)
        memset(frame->grid->edged.data, 0, (size_t)frame->grid->node_blocks * sizeof(uint32_t));
    else
        pool_for(pool, frame->grid->node_blocks, 16, open_blocks, &job);
}
