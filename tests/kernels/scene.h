/* A world full of random particles, whose kernels run one by one. */
#ifndef PBMPM_TESTS_SCENE_H
#define PBMPM_TESTS_SCENE_H

#include "random.h"
#include "reference.h"
#include "world/world.h"

enum { SCENE_MATERIALS = 4 };

/* Makes the deformation gradient of a particle. */
typedef void MakeDeformation(Random *random, int dimension, double *F);

static const float CELL_SIZE = 0.05f, TIME_STEP = 0.004f; /* [m], [s] of all scenes */

typedef struct SceneSpec {
    const char *name;
    pbmpm_material_def material[SCENE_MATERIALS];
    int materials;
    uint32_t cells;         /* cells with particles; some are drawn twice */
    uint32_t most_per_cell; /* each cell has 1 to this many */
    int32_t centre[3], spread; /* cells are within `spread` of the centre */
    const int32_t *anchor;  /* cell of one more particle, or null; the lowest cell of all is where blocks begin */
    double speed;           /* displacements up to this many cells per substep and axis */
    double gradient;        /* entries of the displacement gradient up to this */
    double ratio_min, ratio_max; /* of J */
    MakeDeformation *deform; /* null: the identity with entries up to 0.3 added */
    float max_displacement; /* 0: the default */
    float pressure_max;     /* this and the next two: see KernelMaterial; 0: none */
    float growth_max, head2;
    bool check_strain, weightless;
    pbmpm_solver solver; /* default: the paper's */
    float flip;
    float affine_lost; /* 1 - KernelArgs.dual.affine_kept, of all blocks */
    double gap;        /* KernelArgs.primal.node_gap, up to this; 0: null */
    bool pool;  /* instead of cells by chance: full ones up to `spread` from the centre, two particles per axis, each up to a tenth of a cell off its place */
    bool edged; /* all blocks are, see KernelArgs.grid.edged */
} SceneSpec;

typedef struct Scene {
    World *world;
    const Kernels *kernels;
    float pressure_max, growth_max, head2;
    RefStep step;
    float *affine_kept, *node_gap; /* see KernelArgs; null without */
    double gap;
    int32_t low[3], high[3]; /* nodes that particles touch */
} Scene;

/* A liquid or elastic material with the defaults, in one line. */
pbmpm_material_def scene_material(pbmpm_material_kind kind);

/* Layouts that a scene's particles can have instead of its own: one by one far apart; many in few cells. */
void spec_far_apart(SceneSpec *spec);
void spec_crowded(SceneSpec *spec);

/* A few particles in one cell of a block, and one far below, which tells where blocks begin. Each of the `cells_of_a_block()` cells touches
 * another set of neighbours. */
void spec_in_cell(SceneSpec *spec, int cell);
int cells_of_a_block(int dimension);

/* `seed` chooses the particles; they do not depend on the instruction set. */
Scene scene_open(const SceneSpec *spec, pbmpm_isa isa, int dimension, uint32_t seed);
void scene_close(Scene *scene);

/* Sorts the particles, takes the solver's memory and points the kernels' arguments at them; after any change of the particles. */
void scene_bind(Scene *scene, bool check_strain);

RefParticle scene_particle(const Scene *scene, uint32_t row);
RefParticle *scene_particles(const Scene *scene); /* all; to be freed */

void scene_run_particles(Scene *scene, Kernel *kernel);
void scene_run_nodes(Scene *scene, Kernel *kernel);

/* The nodes' displacements, masses and volumes. */
RefGrid scene_nodes(const Scene *scene);
/* The same of another array of nodes, without volumes. */
RefGrid scene_nodes_of(const Scene *scene, const float *values);
/* One float per node, as masses. */
RefGrid scene_scalars_of(const Scene *scene, const float *values);

/* The sums over all tiles, and, unless null, the sums of sizes. */
RefGrid scene_tiles(const Scene *scene, RefGrid *sizes);
/* The same where tiles hold one float per node, as masses. */
RefGrid scene_scalar_tiles(const Scene *scene, RefGrid *sizes);

#endif
