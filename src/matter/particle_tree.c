#include "matter/particle_tree.h"

#include <math.h>

#include "base/result.h"

enum { STRETCH = 64, FAN = 8, BOX_GRAIN = 64 };

/* ---- Building ---- */

typedef struct BuildJob {
    ParticleTree *tree;
    const Particles *particles;
    int level;
} BuildJob;

static ParticleBox *boxes_of(const ParticleTree *tree, int level) { return (ParticleBox *)tree->box.data + tree->begin[level]; }

static ParticleBox empty_box(void)
{
    return (ParticleBox){{INT32_MAX, INT32_MAX, INT32_MAX}, {INT32_MIN, INT32_MIN, INT32_MIN}};
}

static void bound_rows(void *context, int32_t begin, int32_t end)
{
    const BuildJob *job = context;
    const Particles *p = job->particles;
    for (int32_t b = begin; b < end; b++) {
        const uint32_t first = (uint32_t)b * STRETCH, last = first + STRETCH < p->count ? first + STRETCH : p->count;
        ParticleBox box = {{0}, {0}};
        for (int a = 0; a < p->dimension; a++) {
            const int32_t *cell = p->cell[a];
            int32_t low = cell[first], high = cell[first];
            for (uint32_t i = first + 1; i < last; i++) {
                low = cell[i] < low ? cell[i] : low;
                high = cell[i] > high ? cell[i] : high;
            }
            box.low[a] = low;
            box.high[a] = high;
        }
        boxes_of(job->tree, 0)[b] = box;
    }
}

static void bound_boxes(void *context, int32_t begin, int32_t end)
{
    const BuildJob *job = context;
    const ParticleTree *tree = job->tree;
    const ParticleBox *below = boxes_of(tree, job->level - 1);
    const uint32_t count = tree->count[job->level - 1];
    for (int32_t b = begin; b < end; b++) {
        ParticleBox box = empty_box();
        for (uint32_t i = (uint32_t)b * FAN; i < ((uint32_t)b + 1) * FAN && i < count; i++) {
            for (int a = 0; a < 3; a++) {
                box.low[a] = below[i].low[a] < box.low[a] ? below[i].low[a] : box.low[a];
                box.high[a] = below[i].high[a] > box.high[a] ? below[i].high[a] : box.high[a];
            }
        }
        boxes_of(tree, job->level)[b] = box;
    }
}

/* Sets the levels up and returns how many boxes they have. */
static uint32_t plan_levels(ParticleTree *tree, uint32_t rows)
{
    uint32_t total = 0, count = (rows + STRETCH - 1) / STRETCH;
    tree->levels = 0;
    while (count > 0) {
        tree->begin[tree->levels] = total;
        tree->count[tree->levels++] = count;
        total += count;
        count = count == 1 ? 0 : (count + FAN - 1) / FAN;
    }
    return total;
}

pbmpm_result particle_tree_build(ParticleTree *tree, Memory *memory, const Particles *p, uint64_t generation, Pool *pool)
{
    if (tree->generation == generation) return PBMPM_OK;
    tree->generation = 0; /* no world has this one */
    tree->rows = p->count;
    tree->dimension = p->dimension;
    const uint32_t boxes = plan_levels(tree, p->count);
    if (!array_reserve(memory, &tree->box, boxes, sizeof(ParticleBox)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory to look particles up in %u boxes", boxes);
    BuildJob job = {tree, p, 0};
    for (; job.level < tree->levels; job.level++)
        pool_for(pool, (int32_t)tree->count[job.level], BOX_GRAIN, job.level ? bound_boxes : bound_rows, &job);
    tree->generation = generation;
    return PBMPM_OK;
}

void particle_tree_free(ParticleTree *tree, Memory *memory)
{
    array_free(memory, &tree->box);
    *tree = (ParticleTree){0};
}

/* ---- Visiting ---- */

typedef struct Visit {
    const ParticleTree *tree;
    ParticleBoxTest *test;
    ParticleBoxRows *rows;
    void *context;
} Visit;

static void visit_box(const Visit *visit, int level, uint32_t b)
{
    const ParticleTree *tree = visit->tree;
    const ParticleBox *box = boxes_of(tree, level) + b;
    if (!visit->test(box, visit->context)) return;
    if (level == 0) {
        const uint32_t first = b * STRETCH, last = first + STRETCH < tree->rows ? first + STRETCH : tree->rows;
        visit->rows(box, first, last, visit->context);
        return;
    }
    for (uint32_t i = b * FAN; i < (b + 1) * FAN && i < tree->count[level - 1]; i++) visit_box(visit, level - 1, i);
}

void particle_tree_visit(const ParticleTree *tree, ParticleBoxTest *test, ParticleBoxRows *rows, void *context)
{
    const Visit visit = {tree, test, rows, context};
    if (tree->levels > 0) visit_box(&visit, tree->levels - 1, 0);
}

/* ---- Lines ---- */

typedef struct Line {
    const ParticleTree *tree;
    const Particles *particles;
    double start[3], inverse[3]; /* 1 / direction; infinite along axes that it does not move along */
    double from, margin;
    double nearest; /* so far */
} Line;

/* When the line is in a widened box for the first time at or after `from`, or INFINITY; and when it leaves it. */
static double entry_of(const Line *line, const ParticleBox *box, double *left)
{
    double enter = line->from, leave = INFINITY;
    for (int a = 0; a < line->tree->dimension; a++) {
        const double low = box->low[a] - line->margin - line->start[a], high = box->high[a] + line->margin - line->start[a];
        if (isinf(line->inverse[a])) {
            if (low > 0.0 || high < 0.0) return INFINITY;
            continue;
        }
        const double one = low * line->inverse[a], other = high * line->inverse[a];
        enter = fmax(enter, fmin(one, other));
        leave = fmin(leave, fmax(one, other));
    }
    *left = leave;
    return enter <= leave ? enter : INFINITY;
}

/* The box around a stretch of spray may be kilometres of nothing. Where the way through it is longer than its particles would be in a row, one
 * per cell, the line enters with the first of their cells, else with the box. */
static void enter_stretch(Line *line, uint32_t b, double entry, double left)
{
    const Particles *p = line->particles;
    const uint32_t first = b * STRETCH, last = first + STRETCH < line->tree->rows ? first + STRETCH : line->tree->rows;
    if (left - entry <= (last - first) + 2.0 * line->margin) {
        line->nearest = entry;
        return;
    }
    for (uint32_t row = first; row < last && line->nearest > line->from; row++) {
        ParticleBox cell = {{0}, {0}};
        for (int a = 0; a < line->tree->dimension; a++) cell.low[a] = cell.high[a] = p->cell[a][row];
        line->nearest = fmin(line->nearest, entry_of(line, &cell, &left));
    }
}

static void enter_box(Line *line, int level, uint32_t b)
{
    const ParticleTree *tree = line->tree;
    double left;
    const double entry = entry_of(line, boxes_of(tree, level) + b, &left);
    if (!(entry < line->nearest)) return;
    if (level == 0) {
        enter_stretch(line, b, entry, left);
        return;
    }
    for (uint32_t i = b * FAN; i < (b + 1) * FAN && i < tree->count[level - 1]; i++) enter_box(line, level - 1, i);
}

double particle_tree_entry(const ParticleTree *tree, const Particles *particles, const double start[3], const double direction[3], double from,
                           double margin)
{
    Line line = {.tree = tree, .particles = particles, .from = from, .margin = margin, .nearest = INFINITY};
    for (int a = 0; a < tree->dimension; a++) {
        line.start[a] = start[a];
        line.inverse[a] = 1.0 / direction[a];
    }
    if (tree->levels > 0) enter_box(&line, tree->levels - 1, 0);
    return line.nearest;
}
