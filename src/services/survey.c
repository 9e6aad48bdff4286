#include "services/survey.h"

#include <math.h>

#include "base/result.h"
#include "services/ray.h"
#include "services/survey_parts.h"
#include "world/depth.h"

int survey_axis_of_gravity(const World *world)
{
    int axis = -1;
    for (int a = 0; a < world->def.dimension; a++)
        if (world->settings.gravity[a] != 0.0f && (axis < 0 || fabsf(world->settings.gravity[a]) > fabsf(world->settings.gravity[axis]))) axis = a;
    return axis;
}

/* ---- Balls in liquid ---- */

/* Whether nothing stands between the middle of a cell and that of a solid. */
static bool sees(const World *world, const Share *share, const Solid *solid)
{
    const double cell = (double)world->def.cell_size;
    double from[3] = {0}, along[3] = {0}, hit[3] = {0}, distance = 0.0;
    for (int a = 0; a < world->def.dimension; a++) {
        from[a] = survey_middle_of(world, share, a);
        along[a] = solid->position[a] - from[a];
        distance += along[a] * along[a];
    }
    distance = sqrt(distance);
    for (int a = 0; a < world->def.dimension; a++) along[a] /= fmax(distance, 1e-300);
    const double way = fmin(distance, ray_to_obstacle(world, share->slot, from, along, distance));
    for (int a = 0; a < world->def.dimension; a++) hit[a] = from[a] + way * along[a];
    return solid_gap(solid, hit) < cell && ray_to_wall(world, from, along, way) == INFINITY;
}

/* Whether a ball or a capsule reaches below a cell of liquid that nothing parts from it: that flows around it, or will. *looks: lines that may still be followed. */
static bool is_ball_below(const World *world, const Cells *cells, const Solid *solid, int *looks)
{
    double lowest = 0.0, low[3] = {0}, high[3] = {0};
    if (solid->kind != PBMPM_SPHERE && solid->kind != PBMPM_CAPSULE) return false;
    solid_bounds(solid, low, high);
    for (int a = 0; a < world->def.dimension; a++) {
        const double pull = (double)world->settings.gravity[a];
        lowest -= pull * (pull > 0.0 ? high[a] : low[a]);
    }
    const uint32_t stride = 1 + cells->count / LOOKED_AT;
    for (uint32_t i = 0; i < cells->count && *looks > 0; i += stride) {
        double up = 0.0;
        for (int a = 0; a < world->def.dimension; a++) up -= (double)world->settings.gravity[a] * survey_middle_of(world, &cells->share[i], a);
        if (cells->share[i].group != 0 || up <= lowest) continue;
        if (sees(world, &cells->share[i], solid)) return true;
        (*looks)--;
    }
    return false;
}

/* Whether no liquid is within two cells of it. `distances`: how many more may be measured; without any it counts as wet. */
static bool is_dry(const World *world, const Cells *cells, const Solid *solid, uint32_t *distances)
{
    for (uint32_t i = 0; i < cells->count; i++) {
        if (cells->share[i].group != 0) continue;
        if (*distances == 0) return false;
        (*distances)--;
        double point[3] = {0};
        for (int a = 0; a < world->def.dimension; a++) point[a] = survey_middle_of(world, &cells->share[i], a);
        if (solid_gap(solid, point) < 2.0 * (double)world->def.cell_size) return false;
    }
    return true;
}

/* Rigid bodies are left out: they float. */
static void look_at_balls(const World *world, const Cells *cells, Survey *survey)
{
    enum { LOOKS = 256 };
    int looks = LOOKS;
    uint32_t distances = 1 << 16;
    for (uint32_t c = 0; c < world->colliders.used; c++) {
        const Collider *collider = &world->colliders.slot[c];
        if (!world_feels(world, collider) || (collider->def.kinematic && collider->def.measures_impulse)) continue;
        const Solid solid = solid_among(&collider->shape, world->def.dimension, &world->baked);
        if (!is_ball_below(world, cells, &solid, &looks)) continue;
        survey->ball_below = true;
        survey->ball_dry = survey->ball_dry || is_dry(world, cells, &solid, &distances);
    }
}

/* ---- Particles ---- */

/* The least and the largest singular value of F, from F^T F: its characteristic polynomial has three real roots (2D: two). */
static void stretches(const Particles *p, uint32_t row, double *least, double *most)
{
    double c[3][3] = {{0}};
    const int d = p->dimension;
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++)
            for (int k = 0; k < d; k++) c[i][j] += (double)p->deformation[k * 3 + i][row] * (double)p->deformation[k * 3 + j][row];
    double mean = 0.0, spread = 0.0;
    for (int i = 0; i < d; i++) mean += c[i][i] / d;
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++) spread += (c[i][j] - (i == j ? mean : 0.0)) * (c[i][j] - (i == j ? mean : 0.0));
    const double radius = sqrt(spread / (d * (d - 1))); /* eigenvalues are mean + 2 r cos(angle), in 2D mean +- r */
    double high = mean + radius, low = mean - radius;
    if (d == 3 && radius > 0.0) {
        for (int i = 0; i < 3; i++) c[i][i] -= mean;
        const double determinant = c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[2][1]) - c[0][1] * (c[1][0] * c[2][2] - c[1][2] * c[2][0]) +
                                   c[0][2] * (c[1][0] * c[2][1] - c[1][1] * c[2][0]);
        const double angle = acos(fmax(-1.0, fmin(1.0, 0.5 * determinant / (radius * radius * radius)))) / 3.0;
        high = mean + 2.0 * radius * cos(angle);
        low = mean + 2.0 * radius * cos(angle + 2.0 * 3.14159265358979 / 3.0);
    }
    *least = sqrt(fmax(low, 0.0));
    *most = sqrt(fmax(high, 0.0));
}

static double volume_of(const Particles *p, uint32_t row)
{
    double f[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const int d = p->dimension;
    for (int i = 0; i < d; i++)
        for (int j = 0; j < d; j++) f[i][j] = (double)p->deformation[i * 3 + j][row];
    return f[0][0] * (f[1][1] * f[2][2] - f[1][2] * f[2][1]) - f[0][1] * (f[1][0] * f[2][2] - f[1][2] * f[2][0]) +
           f[0][2] * (f[1][0] * f[2][1] - f[1][1] * f[2][0]);
}

/* Strain is cut off at the bounds once per substep, and a little moves it away again. */
static bool is_clamped(const World *world, uint32_t row)
{
    const pbmpm_material_def *def = &world->materials.def[world->particles.material[row]];
    double least, most;
    stretches(&world->particles, row, &least, &most);
    return least < 1.05 * (double)def->strain_min || most > 0.95 * (double)def->strain_max;
}

static void look_at_particles(const World *world, Survey *survey)
{
    const Particles *p = &world->particles;
    for (uint32_t row = 0; row < p->count; row++) {
        Heap *heap = &survey->heap[p->material[row]];
        double speed2 = 0.0;
        for (int a = 0; a < p->dimension; a++) speed2 += (double)p->velocity[a][row] * (double)p->velocity[a][row];
        heap->particles++;
        heap->moves += speed2;
        heap->speed = fmax(heap->speed, sqrt(speed2));
        if (!material_is_solid(&world->materials, p->material[row])) continue;
        heap->kept += volume_of(p, row);
        if (is_clamped(world, row)) heap->clamped += 1.0;
    }
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        Heap *heap = &survey->heap[slot];
        if (heap->particles == 0) continue;
        heap->moves = sqrt(heap->moves / heap->particles);
        heap->clamped /= heap->particles;
        heap->kept /= heap->particles;
    }
}

/* Whether the particle's way leads where liquid is, for a body, or a body, for a liquid, within AHEAD cells. Sorted by cell. */
static bool is_meeting(const World *world, const Cells *cells, uint32_t row, double speed)
{
    enum { AHEAD = 4 };
    const Particles *p = &world->particles;
    const bool flows = !material_is_solid(&world->materials, p->material[row]);
    int32_t first[3] = {0};
    if (!survey_near_first(p, row, first)) return false;
    for (int step = 1; step <= AHEAD; step++) {
        Share ahead = {.group = 0};
        for (int a = 0; a < p->dimension; a++) ahead.cell[a] = first[a] + (int32_t)floor(step * (double)p->velocity[a][row] / speed + 0.5);
        const uint64_t place = survey_place_of(&ahead, 0, false);
        for (uint32_t i = survey_first_from(cells, place); i < cells->count && cells->share[i].place >> GROUP_BITS == place >> GROUP_BITS; i++)
            if (flows != (cells->share[i].group == 0) && world->materials.def[cells->share[i].slot].kind != PBMPM_SAND) return true;
    }
    return false;
}

/* Of those that are faster than any that was found to meet so far; some may be passed over where many are. */
static double fastest_meeting(const World *world, const Cells *cells)
{
    enum { MOST = 1 << 14 };
    const Particles *p = &world->particles;
    const uint32_t stride = 1 + p->count / MOST;
    double fastest = 0.0;
    for (uint32_t row = 0; row < p->count; row += stride) {
        double speed2 = 0.0;
        for (int a = 0; a < p->dimension; a++) speed2 += (double)p->velocity[a][row] * (double)p->velocity[a][row];
        if (speed2 <= fastest * fastest || world->materials.def[p->material[row]].kind == PBMPM_SAND) continue;
        if (is_meeting(world, cells, row, sqrt(speed2))) fastest = sqrt(speed2);
    }
    return fastest;
}

static bool any_liquid(const World *world)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++)
        if (world->materials.generation[slot] != 0 && world->materials.def[slot].kind == PBMPM_LIQUID) return true;
    return false;
}

/* Whether solids are there, and a liquid may come to them: else it is no matter how near walls are, and no sort is spent on it. */
static bool may_float(const World *world, const Cells *cells)
{
    bool solid = false;
    for (uint32_t i = 0; i < cells->count && !solid; i++) solid = cells->share[i].group > 0;
    return solid && any_liquid(world);
}

/* What depends on which way is down: how a solid falls, hangs, slides. Sorted by cell, bodies are found. */
static void look_below(const World *world, Cells *cells, int down, bool floats, Survey *survey)
{
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        Heap *heap = &survey->heap[slot];
        if (heap->particles == 0 || !material_is_solid(&world->materials, slot)) continue;
        survey_drops(world, cells, down, slot, heap);
        if (world->materials.def[slot].kind == PBMPM_SAND) {
            survey_slopes(world, cells, down, slot, heap);
        } else {
            heap->hangs = survey_hangs(world, cells, down, slot);
            if (floats) survey_film(world, cells, down, slot, heap);
            heap->lies = floats && survey_lies(world, cells, down, slot);
        }
    }
}

/* Of each group. */
typedef struct Sizes {
    double runs[3][PBMPM_MAX_MATERIALS + 1], narrow[PBMPM_MAX_MATERIALS + 1], thickness[PBMPM_MAX_MATERIALS + 1], uneven;
    double leans;
} Sizes;

/* A body is as thick as its thickest part, but for noise: what counts is a mean that leans that far to it. */
static const double THICKEST = 4.0;

static void measure_thickness(const Cells *cells, double thickness[PBMPM_MAX_MATERIALS + 1])
{
    double weight[PBMPM_MAX_MATERIALS + 1] = {0};
    for (uint32_t i = 0; i < cells->count; i++) {
        const double part = cells->share[i].filling * pow(cells->share[i].thickness, THICKEST);
        thickness[cells->share[i].group] += part * cells->share[i].thickness;
        weight[cells->share[i].group] += part;
    }
    for (int group = 0; group <= PBMPM_MAX_MATERIALS; group++)
        if (weight[group] > 0.0) thickness[group] /= weight[group];
}

static void measure_sizes(const World *world, Cells *cells, int down, bool floats, Sizes *sizes)
{
    for (int group = 0; group <= PBMPM_MAX_MATERIALS; group++) sizes->narrow[group] = floats ? 1.0 : 0.0;
    for (int a = 0; a < cells->dimension && floats; a++)
        if (a != down) survey_room(world, cells, a, sizes->narrow);
    for (int a = 0; a < cells->dimension; a++) survey_runs(cells, a, sizes->runs[a]);
    measure_thickness(cells, sizes->thickness);
    double pull[3];
    gravity_direction(world, pull);
    if (down >= 0 && any_liquid(world)) sizes->uneven = survey_level(world, cells, down, pull);
}

static void look_at_cells(const World *world, Cells *cells, Survey *survey)
{
    double filling[PBMPM_MAX_MATERIALS + 1] = {0}, error[PBMPM_MAX_MATERIALS + 1], overlapping[PBMPM_MAX_MATERIALS + 1] = {0};
    const int down = survey_axis_of_gravity(world);
    const bool floats = may_float(world, cells);
    Sizes sizes = {0};
    measure_sizes(world, cells, down, floats, &sizes);
    survey_filling(cells, filling, error);
    if (world->step_count == 0) survey_overlaps(cells, overlapping);
    look_at_balls(world, cells, survey);
    if (floats) survey->meets = fastest_meeting(world, cells);
    if (down >= 0 && any_liquid(world)) sizes.leans = survey_leaning(world, cells, down);
    survey_find_bodies(cells);
    if (down >= 0) look_below(world, cells, down, floats, survey);
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        Heap *heap = &survey->heap[slot];
        if (heap->particles == 0) continue;
        const uint32_t group = material_is_solid(&world->materials, slot) ? slot + 1 : 0;
        heap->depth = down < 0 ? 0.0 : sizes.runs[down][group];
        heap->width = INFINITY;
        for (int a = 0; a < cells->dimension; a++)
            if (a != down) heap->width = fmin(heap->width, sizes.runs[a][group]);
        heap->thickness = sizes.thickness[group];
        heap->uneven = group == 0 ? sizes.uneven : 0.0;
        heap->leans = group == 0 ? sizes.leans : 0.0;
        heap->narrow = group > 0 ? sizes.narrow[group] : 0.0;
        heap->filling = filling[group];
        heap->filling_error = error[group];
        heap->overlapping = overlapping[group];
    }
}

pbmpm_result survey_make(World *world, Survey *survey)
{
    *survey = (Survey){0};
    const size_t bytes = world->particles.count * sizeof(Share);
    if (bytes == 0) return PBMPM_OK;
    Cells cells = {.share = memory_take(&world->memory, bytes), .dimension = world->def.dimension};
    if (!cells.share) return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory to look at %u particles", world->particles.count);
    look_at_particles(world, survey);
    survey_find_cells(world, &cells);
    look_at_cells(world, &cells, survey);
    const pbmpm_result found = survey_bodies(world, &cells, survey_axis_of_gravity(world), survey);
    memory_give(&world->memory, cells.share, bytes);
    return found;
}
