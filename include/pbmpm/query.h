/* pbmpm: asking where matter is: in a region, at points, on a line. See also pbmpm_query_shape() and pbmpm_query_collider(). */
#ifndef PBMPM_QUERY_H
#define PBMPM_QUERY_H

#include "particles.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Queries see the present state, after steps and after edits. They change nothing: no view expires, and no later result depends on
 * them. Answers do not depend on the number of threads.
 *
 * The first query after a change of the particles builds a search tree over all of them. It takes 1/2 byte per particle. Later ones
 * reuse it and look only at what is near. That is fastest after a step, which stores neighbours side by side. Several threads may
 * query at once; the others wait while the first builds the tree.
 *
 * Fields between particles are sums over the particles p near a point x, in double precision. The weight is that of the solver's
 * transfers:
 *     W_p(x) = product over the axes a of w((x_a - x_pa) / dx),
 *     w(r) = 3/4 - r^2 for |r| < 1/2;  (3/2 - |r|)^2 / 2 for |r| < 3/2;  0 beyond.
 * One field is the filling. It is the share of space that matter takes at rest volume:
 *     filling(x) = sum_p V_p W_p(x) / dx^d,    V_p: rest volume.
 * It is about 1 inside matter, 1/2 on its surface, and 0 farther than 3/2 cells from it. At a wall it is 1/2, too, since no
 * matter lies behind. */

/** What one material has in a region. */
typedef struct pbmpm_region_share {
    uint32_t size;      /**< sizeof(pbmpm_region_share); set by the caller in the first element of an array */
    pbmpm_material_id material; /**< of which these are the figures */
    uint64_t count;     /**< particles whose centre is inside */
    double mass;        /**< of these [kg] (2D: per metre of depth) */
    double volume;      /**< present volume, rest volume times VOLUME_RATIO [m^d] */
    double rest_volume; /**< [m^d] */
} pbmpm_region_share;

/** What is inside a shape, by material: one entry for each material that has particles there, in the order of their indices. Writes
 *  up to `capacity` entries; *count is the full number. `shares` may be null when capacity is 0; otherwise shares[0].size must be
 *  set.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (size), OUT_OF_MEMORY, BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_query_region(pbmpm_world_id world, const pbmpm_shape *shape, pbmpm_region_share *shares, uint32_t capacity,
                                          uint32_t *count);

/** Fields at points. `points`: count * d floats [m]. Each of the others may be null:
 *  `filling`: count floats, as defined above;
 *  `density`: count floats, sum_p m_p W_p / dx^d [kg/m^3] (2D: kg/m^2);
 *  `velocity`: count * d floats, sum_p m_p W_p (v_p + C_p (x - x_p)) / sum_p m_p W_p [m/s], C_p the affine velocity; 0 where there
 *  is no matter. A velocity that is linear in x comes out exactly.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null points, a coordinate that is not finite), OUT_OF_MEMORY, BUSY, FORKED.
 *  Threads: shared. */
PBMPM_API pbmpm_result pbmpm_query_points(pbmpm_world_id world, const float *points, uint32_t count, float *filling, float *density,
                                          float *velocity);

/** The highest matter over (or under) points. "Up" is the unit vector u along `direction` (d floats, any length above 1e-6); null:
 *  against gravity.
 *  `points`: count * d floats [m]. `level`: filling that counts as matter, in (0, 100]; 0.5 is the surface.
 *  `heights`: count floats, the surface's coordinate u . x along u [m]; -infinity if the line through the point along u meets no
 *  matter. Samples on the line through x are x + k dx/4 u, k any integer. The surface is found between the highest sample that
 *  reaches `level` and the next, by 12 bisections.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (also: null direction without gravity), OUT_OF_MEMORY, BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_query_heights(pbmpm_world_id world, const float *points, uint32_t count, const float *direction, float level,
                                           float *heights);

/** A ray. Fill it with pbmpm_ray_init(), then change what differs. */
typedef struct pbmpm_ray {
    uint32_t size;      /**< sizeof(pbmpm_ray), set by pbmpm_ray_init() */
    float level;        /**< filling that stops the ray, in (0, 100]; default 0.5: the surface */
    float origin[3];    /**< [m]; default 0 */
    float direction[3]; /**< any length above 1e-6; default (0, -1, 0) */
    float max_distance; /**< [m], in [0, 1e9]; default 1e9 */
} pbmpm_ray;

/** Where a ray met matter. Without a hit all but `size` is 0. */
typedef struct pbmpm_ray_hit {
    uint32_t size;              /**< sizeof(pbmpm_ray_hit), set by the caller */
    int32_t hit;                /**< 1: the ray met matter */
    float distance;             /**< from the origin [m] */
    float position[3];          /**< [m] */
    float normal[3];            /**< unit vector out of the matter: against the gradient of the filling; 0 where that is 0 */
    pbmpm_material_id material; /**< of `particle` */
    pbmpm_particle_id particle; /**< nearest to `position` with W_p > 0; if several are equally near, the first in storage order */
} pbmpm_ray_hit;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Threads: any. */
PBMPM_API pbmpm_result pbmpm_ray_init(pbmpm_ray *ray, size_t size);

/** The first point along a ray where the filling reaches the level. Samples lie dx/4 apart, the first one at the origin. The point
 *  is found between the last sample below the level and the next, by 12 bisections. A ray that begins in matter hits at distance 0.
 *  `hit->size` must be set.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, OUT_OF_MEMORY, BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_query_ray(pbmpm_world_id world, const pbmpm_ray *ray, pbmpm_ray_hit *hit);

#ifdef __cplusplus
}
#endif
#endif
