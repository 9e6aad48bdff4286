/* Small scenes that several API tests share. */
#ifndef PBMPM_TESTS_API_SCENES_H
#define PBMPM_TESTS_API_SCENES_H

#include "support.h"

/** Changes a world definition before the world is made (allocator, threads, hooks ...). */
typedef void scene_tweak(pbmpm_world_def *def, void *user);

/** Gives it three threads. */
scene_tweak three_threads;

/** A scene that was built. */
typedef struct stage {
    pbmpm_world_id world;
    pbmpm_collider_id paddle; /**< the kinematic obstacle, or null */
} stage;

typedef struct scene {
    const char *name;
    int32_t dimension;
    float dt; /**< length of a step [s] */
    stage (*build)(scene_tweak *tweak, void *user);
    /** Called before step number `step`; null when nothing moves. */
    void (*before_step)(const stage *made, int step, float dt);
} scene;

/** The catalogue: 2D and 3D; liquid, elastic, mixed; moving obstacle; high speed; unbounded domain. */
extern const scene scenes[];
extern const int scene_count;

/** Runs steps [from, to) of a scene. */
void scene_run(const scene *plan, const stage *made, int from, int to);

/** Default definitions, checked. */
pbmpm_world_def default_world(int32_t dimension, float cell_size, uint32_t capacity);
pbmpm_settings default_settings(void);
pbmpm_material_def default_material(pbmpm_material_kind kind);
pbmpm_collider_def default_collider(void);
pbmpm_fill_def default_fill(pbmpm_material_id material);
pbmpm_shape default_shape(void); /**< a box of 1 m */
pbmpm_shape box_shape(float x, float y, float z, float half_x, float half_y, float half_z);
pbmpm_shape sphere_shape(float x, float y, float z, float radius);
pbmpm_shape plane_shape(float x, float y, float z, float nx, float ny, float nz);

pbmpm_world_id create_world(const pbmpm_world_def *def);
pbmpm_world_id papers_world(const pbmpm_world_def *def); /**< solved as the paper does */
pbmpm_material_id create_material(pbmpm_world_id world, pbmpm_material_kind kind);
pbmpm_collider_id create_collider(pbmpm_world_id world, pbmpm_shape shape, bool kinematic);
pbmpm_emitter_id create_emitter(pbmpm_world_id world, pbmpm_material_id material); /**< with the default rate, 0 */
pbmpm_drain_id create_drain(pbmpm_world_id world, pbmpm_shape shape);
pbmpm_force_id create_force(pbmpm_world_id world); /**< switched off */
uint32_t fill_shape(pbmpm_world_id world, pbmpm_material_id material, pbmpm_shape shape, const float velocity[3]);
void set_gravity(pbmpm_world_id world, float x, float y, float z);
void set_rate(pbmpm_world_id world, int32_t substeps, int32_t iterations);
void set_solver(pbmpm_world_id world, pbmpm_solver solver);

/** A 2D tank, 1 m by 1 m, dx 0.05, with a pool of liquid in it and gravity; about 800 particles. */
pbmpm_world_id tank_2d(scene_tweak *tweak, void *user);

/** A free elastic block in 2D (dx 0.1) around the origin without gravity; 256 particles. */
pbmpm_world_id block_2d(scene_tweak *tweak, void *user);

#endif
