/* Solids to test with: a mesh that is baked and loaded. */
#ifndef PBMPM_TESTS_API_SOLIDS_H
#define PBMPM_TESTS_API_SOLIDS_H

#include "meshes.h"
#include "support.h"

/* What is being baked; tests fill it. */
extern Mesh mesh;

/* The mesh, baked; bake_forget() after each test. */
extern struct baked_bytes {
    void *data;
    uint64_t bytes;
} baked;

void bake_now(int32_t resolution);
void bake_ball(int32_t dimension, double radius);
void bake_forget(void);

/* Loads what was baked last. */
pbmpm_baked_id load_baked(pbmpm_world_id world);
pbmpm_shape baked_shape(pbmpm_baked_id id, float x, float y, float z);

#endif
