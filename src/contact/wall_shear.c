#include "contact/wall_shear.h"

#include "contact/walls.h"

enum { GRAIN = 64, WALL_ENTRY_NS = 10 };

typedef struct StageJob {
    const Walls *walls;
    const ContactFrame *frame;
    const WallStage *stage;
} StageJob;

static Span entries_of(const Walls *walls) { return (Span){(int32_t)walls->shears, GRAIN, (int64_t)walls->shears * WALL_ENTRY_NS}; }

void wall_shear_begin(const Walls *walls)
{
    WallShear *shear = walls->shear.data;
    for (uint32_t e = 0; e < walls->shears; e++) shear[e].given = shear[e].given_before = (Four){0};
}

static void hold(void *context, int32_t begin, int32_t end)
{
    const StageJob *job = context;
    const Walls *walls = job->walls;
    const ApplyJob apply = {.walls = walls, .frame = job->frame, .v = vectors_of(walls)};
    for (int32_t e = begin; e < end; e++) {
        const WallEntry *entry = (const WallEntry *)walls->entry.data + e;
        WallShear *shear = (WallShear *)walls->shear.data + e;
        const WallNode *n = (const WallNode *)walls->node.data + entry->follower;
        if (shear->face == NORMALS_MAX) continue;
        /* E~ u~ + c~0 is what the walls made of it and E (B - 1) (u~ - s); of what the node has itself, too, as give() takes B of all */
        const Four relative = mean_of(&apply, entry) - shear->surface, itself = apply.v.free[entry->follower] - shear->surface;
        float *nodes = job->frame->grid->node.data;
        shear->before = load_node(job->stage->push, n->node);
        const Four held = times(&entry->matrix, times(&shear->kept, relative) - relative) + own_of(&apply, entry->follower, times(&shear->kept, itself) - itself);
        store_node(load_node(nodes, n->node) + held, nodes, n->node);
    }
}

static void give(void *context, int32_t begin, int32_t end)
{
    const StageJob *job = context;
    const Walls *walls = job->walls;
    for (int32_t e = begin; e < end; e++) {
        WallShear *shear = (WallShear *)walls->shear.data + e;
        if (shear->face == NORMALS_MAX) continue;
        const WallNode *n = (const WallNode *)walls->node.data + ((const WallEntry *)walls->entry.data)[e].follower;
        const Four start = job->stage->last * load_node(job->stage->push, n->node) + job->stage->before * shear->before; /* the stage moved u_(j-1) to `push` */
        const Four change = load_node(job->stage->base, n->node) - start, kept = times(&shear->kept, change);
        const Four given = job->stage->last * shear->given + job->stage->before * shear->given_before + n->mass * (kept - change);
        store_node(start + kept, job->stage->base, n->node);
        store_node(start + kept, job->frame->grid->node.data, n->node);
        shear->given_before = shear->given;
        shear->given = given;
    }
}

void wall_shear_hold(const Walls *walls, const ContactFrame *frame, Loops *loops, const WallStage *stage)
{
    const StageJob job = {walls, frame, stage};
    LOOPS_ADD(loops, entries_of(walls), hold, &job);
}

void wall_shear_give(const Walls *walls, const ContactFrame *frame, Loops *loops, const WallStage *stage)
{
    const StageJob job = {walls, frame, stage};
    LOOPS_ADD(loops, entries_of(walls), give, &job);
}

void wall_shear_book(const Walls *walls, const ContactFrame *frame)
{
    const WallShear *shear = walls->shear.data;
    const double scale = contacts_momentum_scale(frame);
    for (uint32_t e = 0; e < walls->shears && frame->colliders->measures; e++) {
        if (shear[e].face == NORMALS_MAX) continue;
        const WallNode *n = (const WallNode *)walls->node.data + ((const WallEntry *)walls->entry.data)[e].follower;
        double gained[3];
        for (int a = 0; a < 3; a++) gained[a] = scale * (double)shear[e].given[a];
        walls_book_face(frame, n, shear[e].face, n, gained);
    }
}
