/* pbmpm: the surface of matter as a triangle mesh, and particles as points for splatting. */
#ifndef PBMPM_SURFACE_H
#define PBMPM_SURFACE_H

#include "particles.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Surfaces are of the present state, after steps and after edits, in 3D. They change nothing: no view expires, and no later result
 * depends on them. They do not depend on the number of threads. A world that asks for none pays nothing.
 *
 * The surface is where the filling (query.h) is `level`. The mesh is a closed manifold: each edge belongs to exactly two triangles.
 * At walls and obstacles the surface follows the present face of the obstacle. Obstacles that act on none of the materials do not
 * count. Vertex order follows storage order, so it may change with every step.
 *
 * Around loose matter, such as a stretching jet, the surface encloses only the matter's own volume. The air in it does not count.
 * Around crushed matter it encloses the smaller room that the matter takes.
 *
 * A world keeps what it computed for the last surface. Where neither matter nor obstacles changed, the next one with the same
 * options costs little more than the writing. The mesh is the same as if nothing had been kept. Other options or other materials
 * begin anew.
 *
 * Calls take memory of the world: some 110 bytes per particle with subdivision 2, 24 with 1, and a fifth more for velocities.
 * They use the world's threads. Several threads may read the world meanwhile, but only one at a time makes a surface or points;
 * others get BUSY. */

/** What a surface is of, and how fine. Fill it with pbmpm_surface_def_init(), then change what differs. */
typedef struct pbmpm_surface_def {
    uint32_t size;                      /**< sizeof(pbmpm_surface_def), set by pbmpm_surface_def_init() */
    uint32_t subdivision;               /**< lattice points per cell and axis: 2 (default) or 1 (quarter of the triangles, half the
                                             time) */
    const pbmpm_material_id *materials; /**< the surface is of these: `material_count` of them, each once */
    uint32_t material_count;            /**< 0 (default): all materials */
    float level;                        /**< filling at the surface, in [0.1, 0.9]; default 0.5: where matter ends. Lower: fatter */
    int32_t keeps_thin;                 /**< 1 (default): layers and threads that are a particle thick are part of it, with about
                                             their volume. 0: they vanish */
    uint32_t index_bytes;               /**< per index: 2, for up to 65535 vertices, or 4 (default) */
} pbmpm_surface_def;

/** Where a mesh goes. A null pointer skips that output and its cost. Memory is the caller's; a float or index needs no
 *  alignment. */
typedef struct pbmpm_surface_mesh {
    uint32_t size;            /**< sizeof(pbmpm_surface_mesh), set by the caller */
    uint32_t stride;          /**< bytes between vertices in the four float arrays, a multiple of 4; 0: packed. One record may
                                   hold all four. */
    float *positions;         /**< 3 floats per vertex [m], relative to the origin */
    float *normals;           /**< 3 floats per vertex: unit vector out of the matter, smooth */
    float *velocities;        /**< 3 floats per vertex [m/s]: the mean of nearby particles */
    float *weights;           /**< def.material_count floats per vertex: shares of the nearby matter, which add up to 1 */
    void *indices;            /**< 3 per triangle, counterclockwise from outside, of def.index_bytes each */
    uint32_t vertex_capacity; /**< room in each vertex array [vertices] */
    uint32_t index_capacity;  /**< room in `indices` [indices] */
    uint32_t vertex_count;    /**< out: vertices of the mesh */
    uint32_t index_count;     /**< out: indices of the mesh, 3 per triangle */
} pbmpm_surface_mesh;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any. */
PBMPM_API pbmpm_result pbmpm_surface_def_init(pbmpm_surface_def *def, size_t size);

/** Makes the surface. `def` may be null: the defaults. `mesh->size` must be set. With all pointers null it only counts. A host
 *  whose buffers were too small enlarges them and calls again: what the first call computed is kept.
 *
 *  Spray is no part of it: particles that are alone, and drops of less than a cell with nothing else within some 4 cells.
 *  pbmpm_surface_points() with spray_only gives them.
 *  Errors: INVALID_ID (also: a material); INVALID_ARGUMENT (null, a value out of range, weights without materials); CAPACITY
 *  (the buffers are too small, or there are more than 65535 vertices for indices of 2 bytes; only the counts are written);
 *  UNSUPPORTED (size; the world is in 2D); OUT_OF_MEMORY; BUSY (also: another thread makes a surface of this world, or a
 *  background step runs); FORKED. Threads: shared, but see above. */
PBMPM_API pbmpm_result pbmpm_surface_extract(pbmpm_world_id world, const pbmpm_surface_def *def, pbmpm_surface_mesh *mesh);

/** A particle to draw: 32 bytes, the layout of {vec3, float, vec3, uint} in GLSL's std430. This structure never grows. */
typedef struct pbmpm_point {
    float position[3]; /**< [m], relative to the origin; 2D: z is 0 */
    float radius;      /**< [m] of a ball (2D: a disc) of the particle's present volume, times def.radius_scale */
    float velocity[3]; /**< [m/s]; 2D: z is 0 */
    uint32_t colour;   /**< 4 bytes: red, green, blue, opacity, in this order in memory */
} pbmpm_point;

/** Which particles become points, and how they look. Fill it with pbmpm_points_def_init(), then change what differs. */
typedef struct pbmpm_points_def {
    uint32_t size;                      /**< sizeof(pbmpm_points_def), set by pbmpm_points_def_init() */
    uint32_t material_count;            /**< of `materials`; 0 (default): all */
    const pbmpm_material_id *materials; /**< whose particles become points, each once */
    const uint32_t *palette;            /**< the colour of each of `materials`, or null (default): opaque white */
    int32_t colour_from_user;           /**< 1: the colour is PBMPM_USER_VALUE (0 in a world without). 0 (default): by `palette` */
    float radius_scale;                 /**< in (0, 100]; default 1. At 0.81 neighbours of an even lattice in 3D just touch. */
    int32_t spray_only;                 /**< 1 (3D only): spray, which the default surface of `materials` leaves out; 0 (default) */
    uint32_t reserved;                  /**< must be 0 */
} pbmpm_points_def;

/** Writes the defaults, as pbmpm_surface_def_init() does. */
PBMPM_API pbmpm_result pbmpm_points_def_init(pbmpm_points_def *def, size_t size);

/** Particles as points for splatting, in the order of views. `def` may be null: the defaults. *count becomes their number; `points`
 *  has room for
 *  `capacity` of them, and may be null with a capacity of 0.
 *  Errors as pbmpm_surface_extract(), but in 2D UNSUPPORTED only with spray_only. CAPACITY: only *count is written.
 *  Threads: shared, but see above. */
PBMPM_API pbmpm_result pbmpm_surface_points(pbmpm_world_id world, const pbmpm_points_def *def, pbmpm_point *points, uint32_t capacity, uint32_t *count);

#ifdef __cplusplus
}
#endif
#endif
