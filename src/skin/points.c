/* Particles as points to draw. Rows are worked on in chunks: each counts its points, then writes them behind those of the chunks before. */
#include <math.h>
#include <string.h>

#include "base/numbers.h"
#include "base/result.h"
#include "skin/state.h"
#include "skin/skin.h"
#include "skin/thin.h"

enum { CHUNK_ROWS = 1024, WHITE = -1 };

pbmpm_points_def skin_points_defaults(void) { return (pbmpm_points_def){.size = sizeof(pbmpm_points_def), .radius_scale = 1.0f}; }

const char *skin_points_problem(const pbmpm_points_def *def)
{
    if (def->palette && !def->material_count) return "points.palette needs points.materials";
    if (def->colour_from_user != 0 && def->colour_from_user != 1) return "points.colour_from_user must be 0 or 1";
    if (!(def->radius_scale > 0.0f && def->radius_scale <= 100.0f)) return "points.radius_scale must be in (0, 100]";
    if (def->spray_only != 0 && def->spray_only != 1) return "points.spray_only must be 0 or 1";
    if (def->reserved != 0) return "points.reserved must be 0";
    return state_list_problem(def->materials, def->material_count);
}

typedef struct PointsJob {
    const World *world;
    SkinMatter matter;
    const pbmpm_points_def *def;
    const uint8_t *outside; /* null: all rows count */
    uint32_t *chunk_begin;
    pbmpm_point *points;
    uint32_t colour[PBMPM_MAX_MATERIALS];
} PointsJob;

static bool becomes_point(const PointsJob *job, uint32_t row) { return matter_has(&job->matter, row) && (!job->outside || job->outside[row]); }

static uint32_t chunk_end(const PointsJob *job, uint32_t begin)
{
    const uint32_t count = job->world->particles.count;
    return begin + CHUNK_ROWS < count ? begin + CHUNK_ROWS : count;
}

static void count_points(void *context, int32_t begin, int32_t end)
{
    const PointsJob *job = context;
    for (int32_t c = begin; c < end; c++) {
        const uint32_t first = (uint32_t)c * CHUNK_ROWS, last = chunk_end(job, first);
        uint32_t count = 0;
        for (uint32_t row = first; row < last; row++) count += becomes_point(job, row);
        job->chunk_begin[c] = count;
    }
}

/* Of a ball, or of a disc. */
static double radius_of(double volume, int dimension) { return dimension == 3 ? pow(0.75 / M_PI * volume, 1.0 / 3.0) : sqrt(volume / M_PI); }

static pbmpm_point point_of(const PointsJob *job, uint32_t row)
{
    const World *world = job->world;
    const Particles *p = &world->particles;
    const double dx = (double)world->def.cell_size, volume = (double)matter_volume(&job->matter, row);
    pbmpm_point point = {.radius = (float)((double)job->def->radius_scale * dx * radius_of(volume, p->dimension)), .colour = job->colour[p->material[row]]};
    for (int a = 0; a < p->dimension; a++) {
        point.position[a] = (float)(particles_coordinate(p, row, a) * dx);
        point.velocity[a] = p->velocity[a][row];
    }
    if (job->def->colour_from_user) point.colour = p->user_value ? p->user_value[row] : 0;
    return point;
}

static void write_points(void *context, int32_t begin, int32_t end)
{
    const PointsJob *job = context;
    for (int32_t c = begin; c < end; c++) {
        const uint32_t first = (uint32_t)c * CHUNK_ROWS, last = chunk_end(job, first);
        pbmpm_point *out = job->points + job->chunk_begin[c];
        for (uint32_t row = first; row < last; row++)
            if (becomes_point(job, row)) *out++ = point_of(job, row);
    }
}

static void choose_colours(PointsJob *job)
{
    for (size_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) job->colour[slot] = (uint32_t)WHITE;
    for (uint32_t i = 0; i < job->def->material_count && job->def->palette; i++) job->colour[job->def->materials[i].index] = job->def->palette[i];
}

/* Notes which particles the surface leaves out. */
static pbmpm_result find_spray(World *world, Skin *skin, SkinKey *key, PointsJob *job)
{
    const pbmpm_result result = state_make(world, skin, key);
    const uint32_t count = world->particles.count;
    if (result != PBMPM_OK) return result;
    if (!state_reserve(world, &skin->spray, count, sizeof(uint8_t))) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for the spray among %u particles", count);
    const FieldWork work = state_work(world, skin, &job->matter);
    thin_find_spray(&work, skin->spray.data);
    job->outside = skin->spray.data;
    return PBMPM_OK;
}

static pbmpm_result make_points(World *world, Skin *skin, PointsJob *job, uint32_t capacity, uint32_t *count)
{
    pbmpm_surface_def chosen = skin_def_defaults();
    chosen.materials = job->def->materials;
    chosen.material_count = job->def->material_count;
    SkinKey key = state_key(world, &chosen);
    job->matter = state_matter(world, &key);
    const pbmpm_result result = job->def->spray_only ? find_spray(world, skin, &key, job) : PBMPM_OK;
    if (result != PBMPM_OK) return result;
    const int32_t chunks = (int32_t)((world->particles.count + CHUNK_ROWS - 1) / CHUNK_ROWS);
    if (!state_reserve(world, &skin->chunk_begin, (size_t)chunks, sizeof(uint32_t))) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory to count points");
    job->chunk_begin = skin->chunk_begin.data;
    pool_for(world->pool, chunks, 1, count_points, job);
    *count = 0;
    for (int32_t c = 0; c < chunks; c++) {
        const uint32_t of_chunk = job->chunk_begin[c];
        job->chunk_begin[c] = *count;
        *count += of_chunk;
    }
    if (*count > capacity) return fail(PBMPM_ERROR_CAPACITY, "there are %u points; there is room for %u", *count, capacity);
    pool_for(world->pool, chunks, 1, write_points, job);
    return PBMPM_OK;
}

pbmpm_result skin_points(World *world, const pbmpm_points_def *def, pbmpm_point *points, uint32_t capacity, uint32_t *count)
{
    PointsJob job = {.world = world, .def = def, .points = points};
    pbmpm_result result;
    Skin *skin = state_take(world, &result);
    if (!skin) return result;
    choose_colours(&job);
    result = make_points(world, skin, &job, capacity, count);
    state_give(world);
    return result;
}
