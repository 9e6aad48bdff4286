/* What a world keeps of the last surface. One thread at a time has it. */
#ifndef PBMPM_SRC_SKIN_STATE_H
#define PBMPM_SRC_SKIN_STATE_H

#include "skin/blocks.h"
#include "skin/boundary.h"
#include "skin/cases.h"
#include "skin/field.h"
#include "skin/matter.h"
#include "skin/mesh.h"
#include "world/world.h"

/* What a field depends on beside where particles are and where obstacles stand. */
typedef struct SkinKey {
    int subdivision;
    float level;
    bool keeps_thin, bounded; /* `bounded`: there are obstacles */
    uint32_t groups;          /* of the materials */
    float cells_per_mass[PBMPM_MAX_MATERIALS]; /* see matter.h */
    uint8_t stretches[PBMPM_MAX_MATERIALS];
} SkinKey;

struct Skin {
    bool busy; /* guarded by world->making */
    uint64_t generation; /* of the particles; 0: nothing is kept */
    SkinKey key;
    SkinBlocks blocks;
    Cases cases;
    const SkinKernels *kernels;
    Array boxes, sums, lines, filling, mirrored, gaps, more, field; /* see field.h */
    Layer filling_layer, mirrored_layer, field_layer;
    Array inside, start;                  /* see mesh.h */
    Array volumes, values;                /* sums for means, per block as `field` */
    Boundary boundary;
    Array spray, chunk_begin;             /* of points, see points.c */
    uint64_t vertices, triangles;
    int32_t changed; /* blocks whose field was not what it had been, of the last time that it was made */
};

/* The state, which is the caller's until state_give(). *result says why there is none. */
Skin *state_take(World *world, pbmpm_result *result);
void state_give(World *world);

/* Room in one of its arrays. */
bool state_reserve(World *world, Array *array, size_t count, size_t size);

/* Null if a list of materials is valid, else what is wrong. */
const char *state_list_problem(const pbmpm_material_id *materials, uint32_t count);

/* A key of these; an empty list means all. Keys are compared as bytes. */
SkinKey state_key(const World *world, const pbmpm_surface_def *def);

/* Works the field out that a key tells of, where it is not what is kept, and counts the mesh. */
pbmpm_result state_make(World *world, Skin *skin, SkinKey *key);

void state_free(World *world);

SkinMatter state_matter(const World *world, const SkinKey *key);
FieldWork state_work(const World *world, Skin *skin, const SkinMatter *matter);
SkinMesh state_mesh(const World *world, const Skin *skin);

#endif
