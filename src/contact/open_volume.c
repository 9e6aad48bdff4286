#include "contact/open_volume.h"

#include <math.h>
#include <string.h>

#include "contact/field.h"
#include "contact/obstacle_cache.h"
#include "contact/walls.h"

/* Of nodes farther than a cell [cells] behind a face too little is open to tell how dense they are. Where they are folded into those before the wall that does not
 * matter. */
static const double DEEPEST = 1.0;
static const float LEAST_SHARE = 1.0f / (48.0f * 48.0f * 48.0f); /* there, in a corner */

/* Rest volume per open volume. Where nothing is open, in what overlapping obstacles closed on, nobody knows what there is room for: it counts as full. Were it counted as
 * crushed, volume feedback would ask it to grow for ever where it cannot, and its pressures drive it round: at 480 Hz x 20 at 73 m/s, four times as fast as a fall through the tank. */
static float density_of(float volume, float open) { return open > 0.0f ? volume / fmaxf(open, LEAST_SHARE) : 1.0f; }

double open_share_at(const ContactFrame *frame, const double node[3], uint32_t groups)
{
    Near near, some;
    field_near(&near, frame, node, 2.0 * NODE_REACH, true);
    return field_open_share(field_meeting(&near, groups, &some), node, DEEPEST, NULL, 0, false);
}

/* What find_open() takes per node in a box with two obstacles, measured. */
enum { OPEN_NODE_NS = 45 };

typedef struct OpenJob {
    const ContactFrame *frame;
    bool resting_only;
    float *open; /* per node */
} OpenJob;

int contacts_opened(const ContactFrame *frame, bool resting_only) { return 1 + (frame->walls != NULL) + 2 * resting_only; }

/* The shares of the last substep, if they hold; 1 where nobody asked. */
static const float *shares_before(const OpenJob *job, int32_t block)
{
    const int32_t from = obstacle_cache_from(job->frame, block);
    if (from == GRID_NOWHERE || job->frame->cache->opened != contacts_opened(job->frame, job->resting_only)) return NULL;
    return (const float *)job->frame->cache->open.data + (size_t)from * (size_t)job->frame->grid->block_cells;
}

/* Obstacles near a block that act on matter there. `edged`: one of them, near what its particles feel, is no plane: it may have edges. */
static void find_near(const OpenJob *job, int32_t block, Near *near, bool *edged)
{
    const ContactFrame *frame = job->frame;
    const double diagonal = sqrt((double)frame->grid->dimension), half_block = 0.5 * (K_BLOCK_AXIS - 1) * diagonal;
    const uint32_t groups = contacts_block_groups(frame, block);
    double centre[3];
    int kept = 0;
    contacts_block_centre(frame, block, centre);
    field_near(near, frame, centre, half_block + 2.0 * NODE_REACH, false);
    *edged = false;
    for (int i = 0; i < near->count; i++) {
        const Obstacle *o = near->obstacle[i];
        if ((job->resting_only && o->moves) || !obstacle_meets(o, groups)) continue;
        near->obstacle[kept++] = o;
        const double gap = solid_least(&o->start, centre) / frame->cell_size - half_block;
        if (gap < NODE_REACH + diagonal && o->start.kind != PBMPM_PLANE) *edged = true;
    }
    near->count = kept;
}

static void find_open(void *context, int32_t begin, int32_t end)
{
    const OpenJob *job = context;
    const Grid *grid = job->frame->grid;
    const int cells = grid->block_cells;
    uint32_t *marks = grid->edged.data;
    Near near, some;
    for (int32_t block = begin; block < end; block++) {
        const float *volume = (const float *)grid->node_volume.data + (size_t)block * (size_t)cells;
        const float *gap = job->frame->gap + (size_t)block * (size_t)cells;
        float *open = job->open + (size_t)block * (size_t)cells;
        bool edged;
        find_near(job, block, &near, &edged);
        marks[block] = edged;
        const float *before = shares_before(job, block);
        for (int node = 0; node < cells; node++) {
            double point[3];
            open[node] = 1.0f;
            const bool listed = walls_list(job->frame->walls, (uint32_t)(block * cells + node)); /* perhaps without mass */
            const bool clear = gap[node] >= NODE_REACH && gap[node] < INFINITY; /* infinite where it was not measured */
            if (near.count == 0 || clear || !(listed || (gap[node] < NODE_REACH && volume[node] > 0.0f))) continue;
            open[node] = walls_open_share(job->frame->walls, (uint32_t)(block * cells + node));
            if (open[node] >= 0.0f) continue;
            if (before && before[node] < 1.0f) {
                open[node] = before[node];
                continue;
            }
            contacts_node_position(job->frame, block, node, point);
            const Near *meeting = field_meeting(&near, contacts_node_groups(job->frame, (size_t)(block * cells + node)), &some);
            open[node] = (float)field_open_share(meeting, point, job->frame->walls ? NODE_REACH : DEEPEST, NULL, 0, false);
        }
    }
}

static void fold(void *context, int32_t begin, int32_t end)
{
    const OpenJob *job = context;
    (void)begin;
    (void)end;
    walls_fold_volume(job->frame->walls, job->frame->grid->node_volume.data, job->open);
}

static void divide(void *context, int32_t begin, int32_t end)
{
    const OpenJob *job = context;
    const size_t cells = (size_t)job->frame->grid->block_cells;
    float *volume = job->frame->grid->node_volume.data;
    for (size_t i = (size_t)begin * cells; i < (size_t)end * cells; i++) volume[i] = density_of(volume[i], job->open[i]);
}

bool contacts_open_volume(const ContactFrame *frame, Memory *memory, Pool *pool, bool resting_only)
{
    Colliders *colliders = frame->colliders;
    const Grid *grid = frame->grid;
    const size_t blocks = (size_t)grid->node_blocks;
    if (colliders->obstacle_count == 0) {
        if (blocks > 0) memset(grid->edged.data, 0, blocks * sizeof(uint32_t));
        return true;
    }
    if (!array_reserve(memory, &colliders->open, blocks * (size_t)grid->block_cells, sizeof(float))) return false;
    const OpenJob job = {frame, resting_only, colliders->open.data};
    Loops loops;
    loops_open(&loops, pool);
    const Span nodes = {grid->node_blocks, 16, (int64_t)blocks * grid->block_cells * OPEN_NODE_NS};
    LOOPS_ADD(&loops, nodes, find_open, &job);
    if (frame->walls) LOOPS_ADD(&loops, span_once(), fold, &job);
    LOOPS_ADD(&loops, grid_nodes(grid, 64), divide, &job);
    loops_run(&loops);
    return true;
}
