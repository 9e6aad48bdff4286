/* pbmpm: the surface of matter as a triangle mesh, and particles as points for splatting. */
#ifndef PBMPM_SURFACE_H
#define PBMPM_SURFACE_H

#include "particles.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Surfaces are of the present state, after steps and after edits, in 3D. They change nothing: no view expires, and no later result depends on them.
 * They do not depend on the number of threads. Who asks for none pays nothing.
 *
 * The surface is where the filling (query.h) is `level`. It is closed: each edge has two triangles, each vertex one ring of them. Matter that touches a wall or an
 * obstacle ends on it, where it stands now. Obstacles that act on none of the materials do not count. Vertices are numbered block by block, as the particles lie in memory.
 *
 * What came loose, such as a jet that stretches, encloses its own volume without the air in it. What is crushed, and has less room than its volume, has no more.
 *
 * A world keeps what it worked out for the last surface: where neither matter nor obstacles changed, the next one with the same options costs little more than the writing.
 * The mesh is the same as if nothing had been kept. Other options or other materials begin anew.
 *
 * Calls take memory of the world: some 110 bytes per particle with subdivision 2, 24 with 1, and a fifth more for velocities. They use the world's threads. Several threads may
 * read the world meanwhile, but one at a time makes a surface. */

/** What a surface is of, and how fine. Fill it with pbmpm_surface_def_init(), then change what differs. */
typedef struct pbmpm_surface_def {
    uint32_t size;                      /**< sizeof(pbmpm_surface_def), set by pbmpm_surface_def_init() */
    uint32_t subdivision;               /**< points of the lattice per cell and axis: 1 (a quarter of the triangles, some half of the time) or 2 (default) */
    const pbmpm_material_id *materials; /**< of which it is: `material_count` of them, each once */
    uint32_t material_count;            /**< 0 (default): all materials */
    float level;                        /**< filling at the surface, in [0.1, 0.9]; default 0.5: where matter ends. A lower one makes it fatter. */
    int32_t keeps_thin;                 /**< 1 (default): layers and threads that are a particle thick are part of it, with about their volume. 0: they vanish */
    uint32_t index_bytes;               /**< per index: 2, for up to 65535 vertices, or 4 (default) */
} pbmpm_surface_def;

/** Where a mesh goes. Each pointer may be null: then that is not written, nor worked out. Memory is the caller's; a float or index needs no alignment. */
typedef struct pbmpm_surface_mesh {
    uint32_t size;            /**< sizeof(pbmpm_surface_mesh), set by the caller */
    uint32_t stride;          /**< bytes from one vertex to the next, a multiple of 4, in each of the following; 0: they are packed. So all may lie in one record */
    float *positions;         /**< 3 floats per vertex [m], relative to the origin */
    float *normals;           /**< 3 floats per vertex: unit vector out of the matter, smooth */
    float *velocities;        /**< 3 floats per vertex [m/s]: the mean of particles near by */
    float *weights;           /**< def.material_count floats per vertex: the share that each material has of the matter near by. They add up to 1. */
    void *indices;            /**< 3 per triangle, counterclockwise from outside, of def.index_bytes each */
    uint32_t vertex_capacity; /**< vertices that there is room for, in each of the above */
    uint32_t index_capacity;  /**< indices that there is room for */
    uint32_t vertex_count;    /**< out */
    uint32_t index_count;     /**< out */
} pbmpm_surface_mesh;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread. */
PBMPM_API pbmpm_result pbmpm_surface_def_init(pbmpm_surface_def *def, size_t size);

/** Makes the surface. `def` may be null: the defaults. With all pointers null it only counts. A host whose buffers were too small enlarges them and calls again:
 *  what the first call worked out is kept.
 *
 *  Spray is no part of it: particles that are alone, and drops of less than a cell with nothing else within some 4 cells. pbmpm_surface_points() with
 *  spray_only has them.
 *  Errors: INVALID_ID (also: a material); INVALID_ARGUMENT (null, a value out of range, weights without materials); CAPACITY: the buffers are too small, or there are more
 *  vertices than indices of 2 bytes can tell apart. Then only the counts are written. UNSUPPORTED (size; the world is in 2D); OUT_OF_MEMORY; BUSY (also: another thread
 *  makes a surface of this world, or a step runs in the background); FORKED. */
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
    int32_t colour_from_user;           /**< 1: the colour is PBMPM_USER_VALUE of the particle; 0 (default) */
    float radius_scale;                 /**< in (0, 100]; default 1. Neighbours in a lattice touch at 0.81. */
    int32_t spray_only;                 /**< 1: only particles that the surface with the defaults and these materials leaves out, in 3D; 0 (default): all */
    uint32_t reserved;                  /**< 0 */
} pbmpm_points_def;

/** Writes the defaults, as pbmpm_surface_def_init() does. */
PBMPM_API pbmpm_result pbmpm_points_def_init(pbmpm_points_def *def, size_t size);

/** Particles as points for splatting, in the order of views. `def` may be null: the defaults. *count is how many there are; `points` has room for `capacity`.
 *  Errors: as pbmpm_surface_extract(); in 2D UNSUPPORTED only with spray_only. CAPACITY: nothing is written but *count. */
PBMPM_API pbmpm_result pbmpm_surface_points(pbmpm_world_id world, const pbmpm_points_def *def, pbmpm_point *points, uint32_t capacity, uint32_t *count);

#ifdef __cplusplus
}
#endif
#endif
