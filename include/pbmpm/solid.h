/* pbmpm: solids of any form, baked from meshes, point clouds and heights to a grid of signed distances.
 *
 * Baking takes seconds, no world, and is done once: its result is a block of bytes that may be kept in a file. A world that loads
 * it gives it an identifier, which any number of shapes of kind PBMPM_BAKED refer to. They share the memory, and move and turn each
 * for itself. Distances are interpolated; near edges and corners the surface is rounded by a part of a grid cell.
 *
 * Winding numbers decide what is inside: solid is where the number is 1 or more. So parts may overlap, and holes wind against the
 * outside. Vertices are rounded to 2^-22 of the mesh's longest side, so that winding numbers are exact.
 * (A. Jacobson, L. Kavan, O. Sorkine-Hornung, "Robust inside-outside segmentation using generalized winding numbers", ACM TOG
 * 32(4), 2013, for closed meshes.) */
#ifndef PBMPM_SOLID_H
#define PBMPM_SOLID_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

enum {
    PBMPM_MAX_BAKED = 256,              /**< baked solids per world */
    PBMPM_MAX_BAKED_NODES = 1 << 27,    /**< grid values of one baked solid */
    PBMPM_MAX_MESH_VERTICES = 1 << 22,  /**< of a mesh to bake */
    PBMPM_MAX_HULL_VERTICES = 1 << 18,  /**< of points to wrap in a hull */
    PBMPM_MAX_MESH_ELEMENTS = 1 << 22,  /**< triangles or edges of a mesh to bake */
    PBMPM_MAX_HEIGHTS = 1 << 20         /**< samples of a height field */
};

/** A surface to bake: triangles in 3D, the edges of polygons in 2D. Arrays are read during the call only. */
typedef struct pbmpm_mesh_def {
    uint32_t size;            /**< sizeof(pbmpm_mesh_def), set by pbmpm_mesh_def_init() */
    int32_t dimension;        /**< 2 or 3; default 3 */
    int32_t resolution;       /**< grid cells along the longest side of the mesh, in [4, 1024]; default 64 */
    uint32_t vertex_count;    /**< up to PBMPM_MAX_MESH_VERTICES (hull: PBMPM_MAX_HULL_VERTICES) */
    uint32_t element_count;   /**< up to PBMPM_MAX_MESH_ELEMENTS (hull: 0) */
    const float *vertices;    /**< vertex_count * dimension floats [m], within 1e6 */
    const uint32_t *elements; /**< element_count * dimension indices of vertices; null for a hull. The surface must be closed. All
                                   of it may be inside out; holes wind against the outside. Equal vertices count as one. */
} pbmpm_mesh_def;

/** A height field: heights over a regular lattice, solid from there down to its base. Sample (i, j) stands at i * spacing[0] and j
 *  * spacing[1] along the axes other than `up`: i along the lower one, j along the higher (up 1: x, z; 2D: i alone).
 *  Let bumpy ground go on for a cell or two inside the walls around it. Where it ends at their faces, water may keep moving.
 *  Where baked cells are wider than 1.5 cells of the world, matter may slip down there (PBMPM_ADVICE_COLLIDER_TOO_COARSE). */
typedef struct pbmpm_heights_def {
    uint32_t size;        /**< sizeof(pbmpm_heights_def), set by pbmpm_heights_def_init() */
    int32_t dimension;    /**< 2 or 3; default 3 */
    int32_t up;           /**< axis along which heights are measured, in [0, dimension); default 1 */
    int32_t resolution;   /**< grid cells along the longest side, in [4, 1024]; 0 (default): cells as wide as the lattice's */
    uint32_t count[2];    /**< samples per axis, at least 2, up to PBMPM_MAX_HEIGHTS in all; 2D: the second is not used */
    float spacing[2];     /**< of the lattice [m], in [1e-6, 1e6]; the whole is at most 1e6 m long; default 1 */
    float thickness;      /**< how far the base lies below the lowest sample [m], in [1e-6, 1e6]; default 1 */
    const float *heights; /**< count[0] * count[1] floats [m], within 1e6; sample (i, j) is heights[i + j * count[0]] */
} pbmpm_heights_def;

/** What is known of a baked solid. */
typedef struct pbmpm_baked_info {
    uint32_t size;      /**< sizeof(pbmpm_baked_info), set by the caller */
    int32_t dimension;  /**< 2 or 3 */
    uint32_t count[3];  /**< grid values per axis */
    float spacing;      /**< [m] width of a grid cell. Distances err by under half of it; midway between parts of the surface by up
                             to 0.87 of it (2D: 0.71). */
    float minimum[3];   /**< lower corner of the grid [m], in the mesh's coordinates */
    float maximum[3];   /**< upper corner; the surface lies two cells inside */
    uint64_t bytes;     /**< size of the baked data, in a file and in a world */
} pbmpm_baked_info;

/** A baked solid that a world has loaded. */
typedef struct pbmpm_baked_id {
    uint32_t index;
    uint32_t generation;
} pbmpm_baked_id;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any. */
PBMPM_API pbmpm_result pbmpm_mesh_def_init(pbmpm_mesh_def *def, size_t size);
/** Writes the defaults, as pbmpm_mesh_def_init() does. */
PBMPM_API pbmpm_result pbmpm_heights_def_init(pbmpm_heights_def *def, size_t size);

/** Bakes a closed mesh into the caller's `buffer` of `capacity` bytes. *bytes becomes the size that is needed. With a null buffer
 *  the call only says the size, at once: ask first, then bake. The memory that baking takes is the C library's and is given back.
 *  Errors: INVALID_ARGUMENT (a value out of range; a mesh that is open, partly wound the wrong way, or holds no volume: the
 *  message says where), UNSUPPORTED (size), OUT_OF_MEMORY, CAPACITY (the buffer is too small). Threads: any. */
PBMPM_API pbmpm_result pbmpm_bake_mesh(const pbmpm_mesh_def *def, void *buffer, uint64_t capacity, uint64_t *bytes);

/** Bakes the convex hull of the vertices. As pbmpm_bake_mesh(). */
PBMPM_API pbmpm_result pbmpm_bake_hull(const pbmpm_mesh_def *def, void *buffer, uint64_t capacity, uint64_t *bytes);

/** Bakes a height field. As pbmpm_bake_mesh(). */
PBMPM_API pbmpm_result pbmpm_bake_heights(const pbmpm_heights_def *def, void *buffer, uint64_t capacity, uint64_t *bytes);

/** Checks the bytes of a baked solid and tells what it is. `data` may have any alignment. `info->size` must be set.
 *  Errors: INVALID_ARGUMENT (null), DAMAGED, UNSUPPORTED (size; a format of another version). Threads: any. */
PBMPM_API pbmpm_result pbmpm_baked_inspect(const void *data, uint64_t size, pbmpm_baked_info *info);

/** Copies a baked solid into a world. `data` may have any alignment, and may be freed afterwards.
 *  Errors: INVALID_ID, DAMAGED, UNSUPPORTED (a format of another version), INVALID_ARGUMENT (also: its dimension is not the
 *  world's), CAPACITY, OUT_OF_MEMORY, BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_baked_create(pbmpm_world_id world, const void *data, uint64_t size, pbmpm_baked_id *baked);

/** What a loaded solid is. `info->size` must be set. Errors: INVALID_ID, INVALID_ARGUMENT (null), UNSUPPORTED, BUSY, FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_baked_get(pbmpm_world_id world, pbmpm_baked_id baked, pbmpm_baked_info *info);

/** Takes a solid out of the world. Errors: INVALID_ID; IN_USE (a collider refers to it); BUSY, FORKED. Threads: exclusive. */
PBMPM_API pbmpm_result pbmpm_baked_destroy(pbmpm_world_id world, pbmpm_baked_id baked);

#ifdef __cplusplus
}
#endif
#endif
