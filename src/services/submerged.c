/* The volume under matter: of the solid, what lies under the plane in which the surface of the matter around goes on through it.
 *
 * The plane is found from where the solid's surface is wet. Over a closed surface the normals add up to 0, so those of the wet part add up to the area that
 * the plane cuts, looking down; and the plane passes through the middle of the line where wet ends. Neither knows gravity.
 *
 * On a lattice s is the share of a node's cell that the solid takes, and -grad s h^d by central differences is n dA. Wetness is the filling over the share of the
 * kernel that is open; it is that of the middle of the open part, somewhat outside. */
#include "services/submerged.h"

#include <math.h>
#include <string.h>

#include "base/result.h"
#include "matter/particle_tree.h"
#include "shape/mass.h"

enum { LONGEST = 64, MARGIN = 3 }; /* nodes along the solid, and around it */

/* Less open than this, a node cannot tell; less than the second, as between an obstacle and a floor, not where wet ends. */
static const double OPEN_ENOUGH = 0.25, OPEN_WIDE = 0.4;
static const float UNKNOWN = -1.0f;

/* Lengths in nodes. */
typedef struct Sounding {
    const World *world;
    const Collider *collider;
    Solid solid; /* what it is */
    int dimension, material;
    double spacing;  /* [m] */
    double first[3]; /* the lowest node [m] */
    int32_t count[3];
    size_t stride[3], nodes;
    float *inside;   /* share of the solid */
    float *raw;      /* share that no obstacle takes */
    float *open;     /* the same as the spline sees it */
    float *filling;
    float *wet;      /* in [0, 1], or UNKNOWN */
    float *spare;
    double mass, volume; /* of the matter around */
} Sounding;

/* ---- The lattice ---- */

static pbmpm_result make_lattice(Sounding *s, World *world)
{
    double low[3], high[3], longest = 0.0;
    solid_bounds(&s->solid, low, high);
    for (int a = 0; a < s->dimension; a++) longest = fmax(longest, high[a] - low[a]);
    s->spacing = fmax((double)world->def.cell_size, longest / LONGEST);
    s->nodes = 1;
    for (int a = 0; a < 3; a++) {
        const double extent = a < s->dimension ? ceil((high[a] - low[a]) / s->spacing) + 2 * MARGIN : 0.0;
        s->count[a] = (int32_t)extent + 1;
        s->first[a] = a < s->dimension ? 0.5 * (low[a] + high[a]) - 0.5 * extent * s->spacing : 0.0;
        s->stride[a] = s->nodes;
        s->nodes *= (size_t)s->count[a];
    }
    if (!array_reserve(&world->memory, &world->submersion, 6 * s->nodes, sizeof(float)))
        return fail(PBMPM_ERROR_OUT_OF_MEMORY, "no memory for a lattice of %zu nodes", s->nodes);
    float **array[] = {&s->inside, &s->raw, &s->open, &s->filling, &s->wet, &s->spare};
    for (size_t i = 0; i < sizeof array / sizeof *array; i++) *array[i] = (float *)world->submersion.data + i * s->nodes;
    return PBMPM_OK;
}

static void index_of(const Sounding *s, size_t node, int32_t index[3])
{
    for (int a = 0; a < 3; a++) {
        index[a] = (int32_t)(node % (size_t)s->count[a]);
        node /= (size_t)s->count[a];
    }
}

static void place_of(const Sounding *s, size_t node, double point[3])
{
    int32_t index[3];
    index_of(s, node, index);
    for (int a = 0; a < 3; a++) point[a] = s->first[a] + index[a] * s->spacing;
}

/* ---- What is open ---- */

/* Obstacles that stand side by side leave nothing between them: their shares add up. */
static void take(Sounding *s, size_t node, float share) { s->raw[node] = fmaxf(0.0f, s->raw[node] - share); }

/* `inside`: receives the shares, or null. */
static void close_solid(Sounding *s, const Solid *solid, bool acts, float *inside)
{
    for (size_t node = 0; node < s->nodes; node++) {
        double point[3];
        place_of(s, node, point);
        const float share = (float)share_inside(solid_gap(solid, point) / s->spacing);
        if (inside) inside[node] = share;
        if (acts) take(s, node, share);
    }
}

static void close_domain(Sounding *s, const Domain *domain)
{
    for (size_t node = 0; node < s->nodes; node++) {
        double point[3], distance = INFINITY;
        place_of(s, node, point);
        for (int a = 0; a < s->dimension; a++) distance = fmin(distance, fmin(point[a] - domain->low[a], domain->high[a] - point[a]));
        take(s, node, (float)share_inside(distance / s->spacing));
    }
}

/* What the spline sees of a function that is constant in each cell. */
static void smooth(Sounding *s, float *field)
{
    for (int a = 0; a < s->dimension; a++) {
        const size_t step = s->stride[a];
        for (size_t node = 0; node < s->nodes; node++) {
            const int32_t at = (int32_t)(node / step % (size_t)s->count[a]);
            const float before = field[at > 0 ? node - step : node], after = field[at + 1 < s->count[a] ? node + step : node];
            s->spare[node] = (before + 4.0f * field[node] + after) / 6.0f;
        }
        memcpy(field, s->spare, s->nodes * sizeof *field);
    }
}

/* The groups of the matter that may carry the solid. */
static uint32_t groups_around(const Sounding *s)
{
    const Materials *materials = &s->world->materials;
    uint32_t groups = 0;
    for (int slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        const bool there = s->world->particles.of_material[slot] > 0 && (s->material == ANY_MATERIAL || s->material == slot);
        if (there && groups_meet(s->collider->def.meets, materials->def[slot].groups)) groups |= materials->def[slot].groups;
    }
    return groups;
}

static void find_open(Sounding *s)
{
    const uint32_t groups = groups_around(s);
    double middle[3], reach2 = 0.0;
    for (int a = 0; a < 3; a++) {
        const double half = 0.5 * (s->count[a] - 1) * s->spacing;
        middle[a] = s->first[a] + half;
        reach2 += half * half;
    }
    for (size_t node = 0; node < s->nodes; node++) s->raw[node] = 1.0f;
    close_domain(s, &s->world->domain);
    const Colliders *colliders = &s->world->colliders;
    for (uint32_t slot = 0; slot < colliders->used; slot++) {
        const bool own = &colliders->slot[slot] == s->collider;
        const bool acts = collider_acts(&colliders->slot[slot]) && groups_meet(colliders->slot[slot].def.meets, groups);
        if (!acts && !own) continue;
        const Solid other = solid_among(&colliders->slot[slot].shape, s->dimension, &s->world->baked);
        if (solid_least(&other, middle) < sqrt(reach2) + s->spacing) close_solid(s, &other, acts, own ? s->inside : NULL);
    }
    memcpy(s->open, s->raw, s->nodes * sizeof *s->open);
    smooth(s, s->open);
}

/* ---- What is filled ---- */

static bool near_lattice(const ParticleBox *box, void *context)
{
    const Sounding *s = context;
    const double dx = (double)s->world->def.cell_size;
    for (int a = 0; a < s->dimension; a++) {
        const double high = s->first[a] + (s->count[a] - 1) * s->spacing, reach = NODE_REACH * s->spacing + 0.5 * dx;
        if (box->high[a] * dx < s->first[a] - reach || box->low[a] * dx > high + reach) return false;
    }
    return true;
}

/* Spreads a volume [nodes] at a place [nodes]; false if that is off the lattice. */
static bool spread(Sounding *s, const double x[3], double volume)
{
    int32_t base[3] = {0}, last[3] = {0};
    double weight[3][3] = {{1.0}, {1.0}, {1.0}};
    for (int a = 0; a < s->dimension; a++) {
        const double nearest = floor(x[a] + 0.5), r = x[a] - nearest;
        if (!(nearest >= 1.0 && nearest + 2.0 <= s->count[a])) return false; /* those at the edge need not be whole */
        base[a] = (int32_t)nearest - 1;
        last[a] = 2;
        weight[a][0] = 0.5 * (0.5 - r) * (0.5 - r);
        weight[a][1] = 0.75 - r * r;
        weight[a][2] = 0.5 * (0.5 + r) * (0.5 + r);
    }
    for (int k = 0; k <= last[2]; k++)
        for (int j = 0; j <= last[1]; j++) {
            float *row = s->filling + (size_t)base[0] + (size_t)(base[1] + j) * s->stride[1] + (size_t)(base[2] + k) * s->stride[2];
            for (int i = 0; i <= last[0]; i++) row[i] += (float)(volume * weight[0][i] * weight[1][j] * weight[2][k]);
        }
    return true;
}

static void add_matter(const ParticleBox *box, uint32_t begin, uint32_t end, void *context)
{
    (void)box;
    Sounding *s = context;
    const Particles *p = &s->world->particles;
    const double dx = (double)s->world->def.cell_size, ratio = dx / s->spacing;
    const double cell = s->dimension == 3 ? ratio * ratio * ratio : ratio * ratio;
    for (uint32_t row = begin; row < end; row++) {
        if (s->material != ANY_MATERIAL && (int)p->material[row] != s->material) continue;
        if (!groups_meet(s->collider->def.meets, s->world->materials.def[p->material[row]].groups)) continue;
        double x[3] = {0};
        for (int a = 0; a < s->dimension; a++) x[a] = (particles_coordinate(p, row, a) * dx - s->first[a]) / s->spacing;
        const double volume = (double)p->mass[row] / (double)s->world->materials.def[p->material[row]].density;
        if (!spread(s, x, volume * cell)) continue;
        s->mass += (double)p->mass[row];
        s->volume += volume;
    }
}

/* ---- What is wet ---- */

/* Half full is on the surface. What is a little loose is full, and a film is nothing. */
static float wetness(double share) { return (float)fmin(1.0, fmax(0.0, 2.0 * share - 0.5)); }

/* -grad s of a node [1 / node]; false where it is 0. */
static bool outward(const Sounding *s, size_t node, double out[3])
{
    bool any = false;
    out[2] = 0.0;
    for (int a = 0; a < s->dimension; a++) {
        const size_t step = s->stride[a];
        const int32_t at = (int32_t)(node / step % (size_t)s->count[a]);
        const bool edge = at == 0 || at + 1 == s->count[a]; /* the solid is farther away */
        out[a] = edge ? 0.0 : 0.5 * ((double)s->inside[node - step] - (double)s->inside[node + step]);
        any = any || out[a] != 0.0;
    }
    return any;
}

/* The node that is number `k` of those around one, itself included; false beyond the lattice. */
static bool neighbour(const Sounding *s, const int32_t index[3], int k, int32_t step[3], size_t *other)
{
    *other = 0;
    for (int a = 0; a < 3; a++) {
        step[a] = a < s->dimension ? k % 3 - 1 : 0;
        k /= 3;
        const int32_t at = index[a] + step[a];
        if (at < 0 || at >= s->count[a]) return false;
        *other += (size_t)at * s->stride[a];
    }
    return true;
}

/* The mean of the nodes around that know; UNKNOWN if none does. */
static float wet_around(const Sounding *s, size_t node)
{
    int32_t index[3], step[3];
    float sum = 0.0f;
    int known = 0;
    index_of(s, node, index);
    for (int k = 0; k < (s->dimension == 3 ? 27 : 9); k++) {
        size_t other;
        if (!neighbour(s, index, k, step, &other) || s->wet[other] == UNKNOWN) continue;
        sum += s->wet[other];
        known++;
    }
    return known > 0 ? sum / (float)known : UNKNOWN;
}

/* Nodes near the surface that see too little take what stands next to them, from where it is known inwards. */
static void find_wet(Sounding *s)
{
    double out[3];
    for (size_t node = 0; node < s->nodes; node++) {
        const double open = (double)s->open[node];
        s->wet[node] = open >= OPEN_ENOUGH ? wetness((double)s->filling[node] / open) : UNKNOWN;
    }
    for (bool changed = true; changed;) {
        changed = false;
        memcpy(s->spare, s->wet, s->nodes * sizeof *s->wet);
        for (size_t node = 0; node < s->nodes; node++) {
            if (s->wet[node] != UNKNOWN || !outward(s, node, out)) continue;
            s->spare[node] = wet_around(s, node);
            changed = changed || s->spare[node] != UNKNOWN;
        }
        float *known = s->spare;
        s->spare = s->wet;
        s->wet = known;
    }
}

/* ---- The plane of the surface ---- */

typedef struct Waterline {
    double place[3], up[3]; /* [m]; of length 1 */
    double area;            /* [nodes] */
    double end;             /* how much surface stands where wet ends */
    double wet;             /* share of the solid's surface */
} Waterline;

/* Where a node at the surface looks: the middle of what the spline sees of the open side. */
static void eye_at(const Sounding *s, size_t node, double point[3])
{
    double sum = 0.0, moment[3] = {0};
    int32_t index[3];
    index_of(s, node, index);
    for (int k = 0; k < (s->dimension == 3 ? 27 : 9); k++) {
        int32_t step[3];
        size_t other;
        if (!neighbour(s, index, k, step, &other)) continue;
        double share = (double)s->raw[other];
        for (int a = 0; a < s->dimension; a++) share *= step[a] == 0 ? 4.0 : 1.0;
        sum += share;
        for (int a = 0; a < s->dimension; a++) moment[a] += share * step[a];
    }
    place_of(s, node, point);
    for (int a = 0; a < s->dimension && sum > 0.0; a++) point[a] += s->spacing * moment[a] / sum;
}

/* Whether a node at the surface can tell where wet ends. */
static bool sees(const Sounding *s, size_t node, double *area)
{
    double out[3];
    if ((double)s->open[node] < OPEN_WIDE || !outward(s, node, out)) return false;
    *area = sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
    return true;
}

/* Where wet ends between a node and the next ones. Returns how much surface stands there. */
static double add_end(const Sounding *s, size_t node, double place[3])
{
    double area, of_next, weight = 0.0;
    if (!sees(s, node, &area)) return 0.0;
    for (int a = 0; a < s->dimension; a++) {
        const size_t next = node + s->stride[a];
        const int32_t at = (int32_t)(node / s->stride[a] % (size_t)s->count[a]);
        if (at + 1 == s->count[a] || !sees(s, next, &of_next)) continue;
        const double wet = (double)s->wet[node] - 0.5, wet_next = (double)s->wet[next] - 0.5;
        if ((wet > 0.0) == (wet_next > 0.0)) continue;
        double here[3], there[3];
        eye_at(s, node, here);
        eye_at(s, next, there);
        const double share = wet / (wet - wet_next), both = area + of_next;
        for (int b = 0; b < 3; b++) place[b] += both * (here[b] + share * (there[b] - here[b]));
        weight += both;
    }
    return weight;
}

static Waterline find_waterline(const Sounding *s)
{
    Waterline line = {.area = 0.0};
    double whole = 0.0;
    for (size_t node = 0; node < s->nodes; node++) {
        double out[3];
        if (!outward(s, node, out) || s->wet[node] == UNKNOWN) continue;
        const double wet = (double)s->wet[node], area = sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
        whole += area;
        line.wet += wet * area;
        for (int a = 0; a < 3; a++) line.up[a] -= wet * out[a];
        line.end += add_end(s, node, line.place);
    }
    line.area = sqrt(line.up[0] * line.up[0] + line.up[1] * line.up[1] + line.up[2] * line.up[2]);
    if (whole > 0.0) line.wet /= whole;
    for (int a = 0; a < 3 && line.end > 0.0; a++) line.place[a] /= line.end;
    for (int a = 0; a < 3 && line.area > 0.0; a++) line.up[a] /= line.area;
    return line;
}

/* A plane that cuts less than this of the area of a cube of the solid's volume, cuts off next to nothing. */
static const double LEAST_CUT = 0.1;

static void add_up(const Sounding *s, pbmpm_submersion *submersion)
{
    const Waterline line = find_waterline(s);
    const int d = s->dimension;
    double whole = 0.0, under = 0.0, first[3] = {0};
    for (size_t node = 0; node < s->nodes; node++) whole += (double)s->inside[node];
    const bool cut = line.end > 0.0 && line.area > LEAST_CUT * pow(whole, (d - 1.0) / d);
    if (!(whole > 0.0) || (!cut && line.wet < 0.5)) return;
    for (size_t node = 0; node < s->nodes; node++) {
        double point[3], above = 0.0;
        if (s->inside[node] == 0.0f) continue;
        place_of(s, node, point);
        for (int a = 0; a < d; a++) above += line.up[a] * (point[a] - line.place[a]) / s->spacing;
        const double share = (double)s->inside[node] * (cut ? share_inside(above) : 1.0);
        under += share;
        for (int a = 0; a < d; a++) first[a] += share * point[a];
    }
    if (!(under > 0.0)) return;
    submersion->share = fmin(1.0, under / whole);
    submersion->volume = submersion->share * solid_volume(&s->solid);
    for (int a = 0; a < d; a++) submersion->centre[a] = first[a] / under;
}

pbmpm_result submerged_measure(World *world, const Collider *collider, int material, pbmpm_submersion *submersion)
{
    Sounding s = {.world = world, .collider = collider, .dimension = world->def.dimension, .material = material};
    s.solid = solid_among(&collider->shape, s.dimension, &world->baked);
    pbmpm_result result = particle_tree_build(&world->particle_tree, &world->memory, &world->particles, world->generation, world->pool);
    if (result == PBMPM_OK) result = make_lattice(&s, world);
    if (result != PBMPM_OK) return result;
    find_open(&s);
    memset(s.filling, 0, s.nodes * sizeof *s.filling);
    particle_tree_visit(&world->particle_tree, near_lattice, add_matter, &s);
    *submersion = (pbmpm_submersion){.size = sizeof *submersion};
    for (int a = 0; a < 3; a++) submersion->centre[a] = s.first[a] + 0.5 * (s.count[a] - 1) * s.spacing;
    if (!(s.volume > 0.0)) return PBMPM_OK;
    submersion->density = s.mass / s.volume;
    find_wet(&s);
    add_up(&s, submersion);
    return PBMPM_OK;
}
