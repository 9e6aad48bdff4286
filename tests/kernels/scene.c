#include "grid/build.h"
#include "scene.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unity.h>

#include "base/cpu.h"
#include "check.h"
#include "services/lifecycle.h"
#include "solvers/solver.h"

pbmpm_material_def scene_material(pbmpm_material_kind kind)
{
    pbmpm_material_def def = material_defaults();
    def.kind = kind;
    return def;
}

/* ---- Particles ---- */

/* Mostly anywhere in the cell, sometimes on its borders or in its middle. */
static float random_fraction(Random *random)
{
    static const float special[] = {-0.5f, 0.49999997f, 0.0f, 1e-20f};
    if (random_below(random, 10) == 0) return special[random_below(random, 4)];
    return fminf((float)random_in(random, -0.5, 0.5), 0.49999997f);
}

static void near_identity(Random *random, int dimension, double *F)
{
    (void)dimension;
    random_array(random, F, 9, -0.3, 0.3);
    for (int a = 0; a < 3; a++) F[a * 4] += 1.0;
}

static void add_particle(Scene *scene, const SceneSpec *spec, Random *random, const int32_t cell[3])
{
    Particles *p = &scene->world->particles;
    const uint32_t row = p->count, slot = random_below(random, (uint32_t)spec->materials);
    const double to_velocity = 1.0 / (scene->step.dt * scene->step.cells_per_metre);
    NewParticle particle = {.mass = spec->material[slot].density * (float)random_in(random, 0.02, 0.5), .material = slot};
    double F[9];
    particles_append(p, &particle, row + 1);
    (spec->deform ? spec->deform : near_identity)(random, p->dimension, F);
    for (int a = 0; a < p->dimension; a++) {
        p->cell[a][row] = cell[a];
        p->fraction[a][row] = random_fraction(random);
        p->velocity[a][row] = (float)(random_in(random, -spec->speed, spec->speed) * to_velocity);
        for (int b = 0; b < p->dimension; b++) {
            const int k = a * 3 + b;
            p->affine[k][row] = (float)(random_in(random, -spec->gradient, spec->gradient) / scene->step.dt);
            if (p->deformation[0]) p->deformation[k][row] = (float)F[k];
        }
    }
    p->volume_ratio[row] = (float)random_in(random, spec->ratio_min, spec->ratio_max);
}

static uint32_t cells_of_a_pool(const SceneSpec *spec, int dimension)
{
    const uint32_t axis = (uint32_t)(2 * spec->spread + 1);
    return dimension == 3 ? axis * axis * axis : axis * axis;
}

static void add_pool(Scene *scene, const SceneSpec *spec, Random *random)
{
    Particles *p = &scene->world->particles;
    const uint32_t axis = (uint32_t)(2 * spec->spread + 1), per_cell = 1u << p->dimension;
    for (uint32_t i = 0; i < per_cell * cells_of_a_pool(spec, p->dimension); i++) {
        const uint32_t at = i / per_cell, row = p->count;
        const int32_t cell[3] = {spec->centre[0] + (int32_t)(at % axis) - spec->spread, spec->centre[1] + (int32_t)(at / axis % axis) - spec->spread,
                                 p->dimension == 3 ? spec->centre[2] + (int32_t)(at / axis / axis) - spec->spread : 0};
        add_particle(scene, spec, random, cell);
        p->mass[row] = scene->world->materials.def[p->material[row]].density / (float)per_cell;
        for (int a = 0; a < p->dimension; a++) p->fraction[a][row] = (float)((i >> a & 1u ? 0.25 : -0.25) + random_in(random, -0.1, 0.1));
    }
}

static void add_particles(Scene *scene, const SceneSpec *spec, uint32_t seed)
{
    Random random = {seed};
    if (spec->pool) {
        add_pool(scene, spec, &random);
        return;
    }
    if (spec->anchor) add_particle(scene, spec, &random, spec->anchor);
    for (uint32_t i = 0; i < spec->cells; i++) {
        int32_t cell[3] = {0};
        for (int a = 0; a < scene->step.dimension; a++)
            cell[a] = spec->centre[a] + (int32_t)random_below(&random, (uint32_t)(2 * spec->spread + 1)) - spec->spread;
        for (uint32_t n = 1 + random_below(&random, spec->most_per_cell); n > 0; n--) add_particle(scene, spec, &random, cell);
    }
}

/* ---- Opening and closing ---- */

static void add_materials(World *world, const SceneSpec *spec)
{
    for (int i = 0; i < spec->materials; i++) {
        pbmpm_material_id id;
        TEST_ASSERT_NULL(material_problem(&spec->material[i]));
        TEST_ASSERT_EQUAL_INT(PBMPM_OK, materials_add(&world->materials, &spec->material[i], (uint32_t)i + 1, &id));
        if (spec->material[i].kind == PBMPM_ELASTIC)
            TEST_ASSERT_EQUAL_INT(PBMPM_OK, particles_enable_deformation(&world->particles, &world->memory));
    }
}

void spec_far_apart(SceneSpec *spec)
{
    spec->most_per_cell = 1;
    spec->spread = 40;
}

void spec_crowded(SceneSpec *spec)
{
    spec->most_per_cell = 40;
    spec->spread = 3;
}

int cells_of_a_block(int dimension) { return dimension == 3 ? K_BLOCK_AXIS * K_BLOCK_AXIS * K_BLOCK_AXIS : K_BLOCK_AXIS * K_BLOCK_AXIS; }

void spec_in_cell(SceneSpec *spec, int cell)
{
    static const int32_t anchor[3] = {-8, -8, -8};
    spec->cells = 1;
    spec->most_per_cell = 3;
    spec->spread = 0;
    spec->anchor = anchor;
    spec->centre[0] = -4 + cell % K_BLOCK_AXIS;
    spec->centre[1] = cell / K_BLOCK_AXIS % K_BLOCK_AXIS;
    spec->centre[2] = 4 + cell / (K_BLOCK_AXIS * K_BLOCK_AXIS);
}

static float or_none(float bound) { return bound > 0.0f ? bound : FLT_MAX; }

Scene scene_open(const SceneSpec *spec, pbmpm_isa isa, int dimension, uint32_t seed)
{
    pbmpm_world_def def = world_def_defaults();
    Scene scene = {.kernels = kernels_for(isa, dimension), .pressure_max = or_none(spec->pressure_max), .growth_max = or_none(spec->growth_max), .head2 = or_none(spec->head2)};
    def.dimension = dimension;
    def.cell_size = CELL_SIZE;
    def.particle_capacity = spec->pool ? cells_of_a_pool(spec, dimension) << dimension : spec->cells * spec->most_per_cell + 1;
    def.thread_count = 1;
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, world_create(&def, &scene.world));
    scene.world->settings.solver = spec->solver;
    scene.world->settings.flip = spec->flip;
    if (spec->max_displacement > 0.0f) scene.world->settings.max_displacement = spec->max_displacement;
    for (int a = 0; a < dimension && !spec->weightless; a++) scene.world->settings.gravity[a] = 3.0f - 6.0f * (float)a;
    add_materials(scene.world, spec);
    scene.step = (RefStep){.dimension = dimension, .edged = spec->edged, .affine_lost = (double)spec->affine_lost, .dt = (double)TIME_STEP, .cells_per_metre = 1.0 / (double)CELL_SIZE};
    scene.gap = spec->gap;
    add_particles(&scene, spec, seed);
    scene_bind(&scene, spec->check_strain);
    return scene;
}

void scene_close(Scene *scene)
{
    world_destroy(scene->world);
    free(scene->affine_kept);
    free(scene->node_gap);
    *scene = (Scene){0};
}

/* Parameters as the test wants them, not as the paper's solver tempers them for a substep. */
static void set_materials(Scene *scene)
{
    Materials *materials = &scene->world->materials;
    for (uint32_t slot = 0; slot < PBMPM_MAX_MATERIALS; slot++) {
        if (!materials->generation[slot]) continue;
        materials_set(materials, slot, &materials->def[slot]);
        materials->kernel[slot].pressure_max = scene->pressure_max;
        materials->kernel[slot].growth_max = scene->growth_max;
        materials->kernel[slot].head2 = scene->head2;
        if (materials->kernel[slot].kind == K_LIQUID) materials->kernel[slot].volume_share = 0.5f * materials->def[slot].volume_feedback;
        materials->kernel[slot].even_share = 0.5f * materials->def[slot].volume_feedback;
    }
}

/* Nodes are what particles of these cells touch. */
static void find_extent(Scene *scene)
{
    const Particles *p = &scene->world->particles;
    for (int a = 0; a < p->dimension; a++) {
        scene->low[a] = INT32_MAX;
        scene->high[a] = INT32_MIN;
        for (uint32_t i = 0; i < p->count; i++) {
            if (p->cell[a][i] - 1 < scene->low[a]) scene->low[a] = p->cell[a][i] - 1;
            if (p->cell[a][i] + 1 > scene->high[a]) scene->high[a] = p->cell[a][i] + 1;
        }
    }
}

static void keep_affine(Scene *scene)
{
    World *world = scene->world;
    if (scene->step.affine_lost == 0.0) return;
    scene->affine_kept = realloc(scene->affine_kept, (size_t)world->grid.particle_blocks * sizeof *scene->affine_kept);
    for (int32_t block = 0; block < world->grid.particle_blocks; block++) scene->affine_kept[block] = (float)(1.0 - scene->step.affine_lost);
    world->args.dual.affine_kept = scene->affine_kept;
}

/* The node with local index i of a box of `axis` nodes per axis whose first node is `corner`. */
static void node_at(const int32_t corner[3], int axis, int i, int32_t node[3])
{
    node[0] = corner[0] + i % axis;
    node[1] = corner[1] + i / axis % axis;
    node[2] = corner[2] + i / axis / axis;
}

/* The first node of a block, or of its tile: one below. */
static void corner_of(const Scene *scene, int32_t block, int32_t below, int32_t corner[3])
{
    const Grid *grid = &scene->world->grid;
    const int32_t *coordinate = (const int32_t *)grid->coordinate.data + 3 * block;
    for (int a = 0; a < 3; a++) corner[a] = a < scene->step.dimension ? grid->anchor[a] + coordinate[a] * K_BLOCK_AXIS - below : 0;
}

/* The first block in the place of one. */
static int32_t first_there(const Grid *grid, int32_t block)
{
    const int32_t *place = grid->coordinate.data;
    int32_t first = 0;
    while (memcmp(place + 3 * first, place + 3 * block, 3 * sizeof *place) != 0) first++;
    return first;
}

/* At nodes that particles may reach; the same for all bodies. */
static void open_gaps(Scene *scene)
{
    World *world = scene->world;
    const Grid *grid = &world->grid;
    const size_t nodes = (size_t)grid->node_blocks * (size_t)grid->block_cells;
    if (scene->gap == 0.0) return;
    scene->node_gap = realloc(scene->node_gap, nodes * sizeof *scene->node_gap);
    RefGrid reached = reference_grid(scene->step.dimension, scene->low, scene->high);
    Random random = {1};
    for (size_t i = 0; i < nodes; i++) {
        int32_t corner[3], at[3];
        corner_of(scene, (int32_t)(i / (size_t)grid->block_cells), 0, corner);
        node_at(corner, K_BLOCK_AXIS, (int)(i % (size_t)grid->block_cells), at);
        const double gap = fmax(0.0, random_in(&random, -scene->gap, scene->gap));
        const size_t cells = (size_t)grid->block_cells, first = (size_t)first_there(grid, (int32_t)(i / cells)) * cells + i % cells;
        scene->node_gap[i] = first < i ? scene->node_gap[first] : reference_index(&reached, at) >= 0 ? (float)gap : 0.0f;
    }
    reference_grid_free(&reached);
    world->args.primal.node_gap = scene->node_gap;
}

void scene_bind(Scene *scene, bool check_strain)
{
    World *world = scene->world;
    const bool with_volume = materials_want_volume(&world->materials, &world->particles);
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, grid_build(&world->grid, &world->memory, &world->particles, world->pool, with_volume));
    TEST_ASSERT_EQUAL_INT(PBMPM_OK, solver_prepare(world));
    world->strain_unchecked = check_strain;
    world->substep = world_substep(world, (double)TIME_STEP);
    solver_bind(world, with_volume);
    if (world->record.solver == PBMPM_SOLVER_PAPER) set_materials(scene);
    for (int32_t block = 0; with_volume && block < world->grid.node_blocks; block++) ((uint32_t *)world->grid.edged.data)[block] = scene->step.edged;
    keep_affine(scene);
    const KernelArgs *args = &world->args;
    scene->step.dt = (double)args->dt;
    scene->step.cells_per_metre = (double)args->cells_per_metre;
    scene->step.max_displacement = (double)args->max_displacement;
    scene->step.max_cell = args->max_cell;
    scene->step.salt = args->salt;
    scene->step.with_volume = with_volume;
    scene->step.weighs = args->grid.node_density != NULL;
    scene->step.flip = (double)args->flip;
    scene->step.feedback_way = (double)args->feedback_way;
    scene->step.quiet_way = (double)args->quiet_way;
    scene->step.tensionless = world->record.solver != PBMPM_SOLVER_PAPER;
    for (int a = 0; a < 3; a++) scene->step.gravity[a] = (double)args->gravity[a];
    find_extent(scene);
    open_gaps(scene);
}

/* ---- Reading ---- */

RefParticle scene_particle(const Scene *scene, uint32_t row)
{
    const Particles *p = &scene->world->particles;
    RefParticle o = {.volume_ratio = (double)p->volume_ratio[row],
                     .mass = (double)p->mass[row],
                     .status = p->status[row],
                     .identity = p->id[row].index,
                     .material = scene->world->materials.kernel[p->material[row]]};
    for (int a = 0; a < p->dimension; a++) {
        o.cell[a] = p->cell[a][row];
        o.fraction[a] = (double)p->fraction[a][row];
        o.velocity[a] = (double)p->velocity[a][row];
        for (int b = 0; b < p->dimension; b++) {
            o.affine[a * 3 + b] = (double)p->affine[a * 3 + b][row];
            if (p->deformation[0]) o.deformation[a * 3 + b] = (double)p->deformation[a * 3 + b][row];
        }
    }
    return o;
}

RefParticle *scene_particles(const Scene *scene)
{
    const uint32_t count = scene->world->particles.count;
    RefParticle *particles = malloc(count * sizeof *particles);
    for (uint32_t row = 0; row < count; row++) particles[row] = scene_particle(scene, row);
    return particles;
}

void scene_run_particles(Scene *scene, Kernel *kernel)
{
    const uint32_t mode = float_mode_enter();
    kernel(&scene->world->args, 0, scene->world->grid.particle_blocks);
    float_mode_leave(mode);
}

void scene_run_nodes(Scene *scene, Kernel *kernel)
{
    const uint32_t mode = float_mode_enter();
    kernel(&scene->world->args, 0, scene->world->grid.node_blocks);
    float_mode_leave(mode);
}

/* A place in which several bodies have blocks has matter in one of them at most: what is not 0 counts. */
RefGrid scene_nodes_of(const Scene *scene, const float *values)
{
    const Grid *grid = &scene->world->grid;
    RefGrid out = reference_grid(scene->step.dimension, scene->low, scene->high);
    for (int32_t block = 0; block < grid->node_blocks; block++) {
        int32_t corner[3], at[3];
        corner_of(scene, block, 0, corner);
        for (int i = 0; i < grid->block_cells; i++) {
            const float *node = values + ((size_t)block * (size_t)grid->block_cells + (size_t)i) * K_NODE_WIDTH;
            node_at(corner, K_BLOCK_AXIS, i, at);
            const int64_t to = reference_index(&out, at);
            if (to >= 0 && (node[0] != 0.0f || node[1] != 0.0f || node[2] != 0.0f || node[3] != 0.0f))
                out.node[to] = (RefNode){.u = {(double)node[0], (double)node[1], (double)node[2]}, .mass = (double)node[3]};
            else if (to < 0)
                check_true(node[0] == 0.0f && node[1] == 0.0f && node[2] == 0.0f && node[3] == 0.0f, "untouched node is 0", i);
        }
    }
    return out;
}

RefGrid scene_scalars_of(const Scene *scene, const float *values)
{
    const Grid *grid = &scene->world->grid;
    RefGrid out = reference_grid(scene->step.dimension, scene->low, scene->high);
    for (int32_t block = 0; block < grid->node_blocks; block++) {
        int32_t corner[3], at[3];
        corner_of(scene, block, 0, corner);
        for (int i = 0; i < grid->block_cells; i++) {
            const double value = (double)values[(size_t)block * (size_t)grid->block_cells + (size_t)i];
            node_at(corner, K_BLOCK_AXIS, i, at);
            const int64_t to = reference_index(&out, at);
            if (to >= 0 && value != 0.0)
                out.node[to].mass = value;
            else
                check_true(value == 0.0, "untouched value is 0", i);
        }
    }
    return out;
}

RefGrid scene_nodes(const Scene *scene)
{
    const KernelArgs *args = &scene->world->args;
    RefGrid out = scene_nodes_of(scene, args->grid.node);
    if (!args->grid.node_volume) return out;
    RefGrid volumes = scene_scalars_of(scene, args->grid.node_volume);
    const size_t count = (size_t)out.size[0] * (size_t)out.size[1] * (size_t)out.size[2];
    for (size_t i = 0; i < count; i++) out.node[i].volume = volumes.node[i].mass;
    reference_grid_free(&volumes);
    if (!args->primal.node_gap) return out;
    RefGrid gaps = scene_scalars_of(scene, args->primal.node_gap);
    for (size_t i = 0; i < count; i++) out.node[i].gap = gaps.node[i].mass;
    reference_grid_free(&gaps);
    return out;
}

static void add_tile_node(RefNode *sum, RefNode *size, const float *values, double volume)
{
    for (int a = 0; a < 3; a++) {
        sum->u[a] += (double)values[a];
        size->u[a] += fabs((double)values[a]);
    }
    sum->mass += (double)values[3];
    sum->volume += volume;
    size->mass += fabs((double)values[3]);
    size->volume += fabs(volume);
}

RefGrid scene_tiles(const Scene *scene, RefGrid *sizes)
{
    const KernelArgs *args = &scene->world->args;
    const Grid *grid = &scene->world->grid;
    const size_t floats = (size_t)grid->tile_nodes * K_NODE_WIDTH + K_TILE_PAD, scalars = (size_t)grid->tile_nodes + K_TILE_PAD;
    RefGrid sum = reference_grid(scene->step.dimension, scene->low, scene->high);
    *sizes = reference_grid(scene->step.dimension, scene->low, scene->high);
    for (int32_t block = 0; block < grid->particle_blocks; block++) {
        int32_t corner[3], at[3];
        corner_of(scene, block, 1, corner);
        for (int i = 0; i < grid->tile_nodes; i++) {
            const float *values = args->grid.tile + (size_t)block * floats + (size_t)i * K_NODE_WIDTH;
            const double volume = args->grid.tile_volume ? (double)args->grid.tile_volume[(size_t)block * scalars + (size_t)i] : 0.0;
            node_at(corner, K_TILE_AXIS, i, at);
            const int64_t to = reference_index(&sum, at);
            if (to >= 0)
                add_tile_node(&sum.node[to], &sizes->node[to], values, volume);
            else
                check_true(values[0] == 0.0f && values[1] == 0.0f && values[2] == 0.0f && values[3] == 0.0f && volume == 0.0,
                           "a tile is 0 where no particle reaches", i);
        }
    }
    return sum;
}

RefGrid scene_scalar_tiles(const Scene *scene, RefGrid *sizes)
{
    const Grid *grid = &scene->world->grid;
    const size_t scalars = (size_t)grid->tile_nodes + K_TILE_PAD;
    RefGrid sum = reference_grid(scene->step.dimension, scene->low, scene->high);
    *sizes = reference_grid(scene->step.dimension, scene->low, scene->high);
    for (int32_t block = 0; block < grid->particle_blocks; block++) {
        int32_t corner[3], at[3];
        corner_of(scene, block, 1, corner);
        for (int i = 0; i < grid->tile_nodes; i++) {
            const double value = (double)scene->world->args.grid.tile[(size_t)block * scalars + (size_t)i];
            node_at(corner, K_TILE_AXIS, i, at);
            const int64_t to = reference_index(&sum, at);
            check_true(to >= 0 || value == 0.0, "a tile is 0 where no particle reaches", i);
            if (to < 0) continue;
            sum.node[to].mass += value;
            sizes->node[to].mass += fabs(value);
        }
    }
    return sum;
}
