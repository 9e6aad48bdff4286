/* pbmpm: shapes, shared by colliders, fills, removals and queries. */
#ifndef PBMPM_SHAPE_H
#define PBMPM_SHAPE_H

#include "base.h"
#include "solid.h"

#ifdef __cplusplus
extern "C" {
#endif

/** The kind of a shape. Members of pbmpm_shape that a kind does not name are ignored. */
typedef enum pbmpm_shape_kind {
    PBMPM_PLANE = 0,   /**< half space behind the plane (2D: behind the line) through `position` with the outward `normal` */
    PBMPM_BOX = 1,     /**< box with `half_extents` (2D: rectangle) */
    PBMPM_SPHERE = 2,  /**< ball with `radius` (2D: disc) */
    PBMPM_CAPSULE = 3, /**< all points within `radius` of the segment of half length half_extents[0] along the local first axis */
    PBMPM_BAKED = 4,   /**< solid of any form, see solid.h; not for emitters, drains and forces (INVALID_ARGUMENT) */
    PBMPM_SHAPE_KIND_FORCE32 = 0x7fffffff
} pbmpm_shape_kind;

/** A solid shape with its pose. Lengths in metres, positions relative to the world's origin. */
typedef struct pbmpm_shape {
    uint32_t size;         /**< sizeof(pbmpm_shape), set by pbmpm_shape_init() */
    pbmpm_shape_kind kind; /**< default PBMPM_BOX */
    float position[3];     /**< centre, or a point of the plane, each in [-1e9, 1e9]; default 0 */
    float rotation[4];     /**< unit quaternion (x, y, z, w); normalised by the library, length in [0.5, 2]; default (0, 0, 0, 1).
                                2D: a turn by the angle a is (0, 0, sin(a/2), cos(a/2)); x and y must be 0. */
    float half_extents[3]; /**< box: each in [1e-9, 1e9]; capsule: [0] in [0, 1e9]; default 0.5 */
    float radius;          /**< sphere, capsule: in [1e-9, 1e9]; default 0.5 */
    float normal[3];       /**< plane: outward direction before rotation, any length > 1e-6; default (0, 1, 0) */
    pbmpm_baked_id baked;  /**< baked: the solid, of the same world; `position` is where its mesh's origin stands; default null */
} pbmpm_shape;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any. */
PBMPM_API pbmpm_result pbmpm_shape_init(pbmpm_shape *shape, size_t size);

#ifdef __cplusplus
}
#endif
#endif
