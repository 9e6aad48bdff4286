/* What is inside a shape. */
#include <math.h>
#include <string.h>

#include "base/sized.h"
#include "matter/particle_tree.h"
#include "services/query.h"
#include "services/readers.h"

/* A box that is surely on one side by more than this share of a cell is not looked into: far above rounding. */
static const double SURELY = 1e-6;

typedef struct Region {
    const World *world;
    const Solid *solid;
    double margin; /* [m] */
    bool whole;    /* the box that was tested last lies inside */
    void *result;
    void (*add)(const World *world, uint32_t row, void *result);
} Region;

/* A signed distance changes by at most the way that one goes, so from the middle of a box it tells about all of it. */
static bool touches_region(const ParticleBox *box, void *context)
{
    Region *region = context;
    const double dx = (double)region->world->def.cell_size;
    double middle[3] = {0}, reach2 = 0.0;
    for (int a = 0; a < region->world->def.dimension; a++) {
        const double half = 0.5 * ((double)box->high[a] - box->low[a]) + 0.5; /* a particle is within 1/2 of its cell's node */
        middle[a] = 0.5 * ((double)box->low[a] + box->high[a]) * dx;
        reach2 += half * half * dx * dx;
    }
    const double distance = solid_gap(region->solid, middle) - region->margin, reach = sqrt(reach2) + SURELY * dx;
    region->whole = distance < -reach;
    return distance < reach;
}

static void add_rows(const ParticleBox *box, uint32_t begin, uint32_t end, void *context)
{
    (void)box;
    Region *region = context;
    const World *world = region->world;
    for (uint32_t row = begin; row < end; row++) {
        double point[3] = {0};
        for (int a = 0; a < world->def.dimension && !region->whole; a++)
            point[a] = particles_coordinate(&world->particles, row, a) * (double)world->def.cell_size;
        if (region->whole || solid_gap(region->solid, point) <= region->margin) region->add(world, row, region->result);
    }
}

static pbmpm_result visit_region(World *world, Region *region)
{
    const pbmpm_result result = readers_build_particle_tree(world);
    if (result == PBMPM_OK) particle_tree_visit(&world->particle_tree, touches_region, add_rows, region);
    return result;
}

/* ---- Identifiers ---- */

typedef struct Found {
    pbmpm_particle_id *ids;
    uint32_t capacity, count;
} Found;

static void add_id(const World *world, uint32_t row, void *result)
{
    Found *found = result;
    if (found->count < found->capacity) found->ids[found->count] = world->particles.id[row];
    found->count++;
}

pbmpm_result query_inside(World *world, const Solid *solid, double margin, pbmpm_particle_id *ids, uint32_t capacity, uint32_t *count)
{
    Found found = {ids, capacity, 0};
    Region region = {.world = world, .solid = solid, .margin = margin, .result = &found, .add = add_id};
    const pbmpm_result result = visit_region(world, &region);
    if (result == PBMPM_OK) *count = found.count;
    return result;
}

static void count_material(const World *world, uint32_t row, void *result) { ((uint32_t *)result)[world->particles.material[row]]++; }

pbmpm_result query_materials(World *world, const Solid *solid, double margin, uint32_t counts[PBMPM_MAX_MATERIALS])
{
    Region region = {.world = world, .solid = solid, .margin = margin, .result = counts, .add = count_material};
    memset(counts, 0, PBMPM_MAX_MATERIALS * sizeof *counts);
    return visit_region(world, &region);
}

/* ---- Shares of materials ---- */

static void add_share(const World *world, uint32_t row, void *result)
{
    const uint32_t slot = world->particles.material[row];
    pbmpm_region_share *share = (pbmpm_region_share *)result + slot;
    const double mass = (double)world->particles.mass[row] * world_cell_volume(world);
    const double rest = mass / (double)world->materials.def[slot].density;
    share->count++;
    share->mass += mass;
    share->rest_volume += rest;
    share->volume += rest * (double)world->particles.volume_ratio[row];
}

pbmpm_result query_region(World *world, const Solid *solid, pbmpm_region_share *shares, uint32_t capacity, uint32_t *count)
{
    pbmpm_region_share all[PBMPM_MAX_MATERIALS] = {0};
    Region region = {.world = world, .solid = solid, .result = all, .add = add_share};
    const pbmpm_result result = visit_region(world, &region);
    if (result != PBMPM_OK) return result;
    *count = 0;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (all[slot].count == 0) continue;
        all[slot].material = (pbmpm_material_id){slot, world->materials.generation[slot]};
        if (*count < capacity) sized_put(SIZED_pbmpm_region_share, shares, *count, &all[slot]);
        ++*count;
    }
    return PBMPM_OK;
}
