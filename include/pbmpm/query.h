/* pbmpm: asking where matter is: in a region, at points, on a line. See also pbmpm_query_shape() and pbmpm_query_collider(). */
#ifndef PBMPM_QUERY_H
#define PBMPM_QUERY_H

#include "particles.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Queries see the present state, after steps and after edits. They change nothing: no view expires, and no later result depends
 * on them. The first query after a change of the particles goes once over all of them. It puts boxes around 64 neighbours in storage
 * order, and boxes around those. Each query then looks only at what is near. That is fastest after a step, which
 * stores neighbours side by side. A world takes 1/2 byte per particle for it with the first query. Answers do not depend on
 * the number of threads. Threads may ask at once: the first makes what all need.
 *
 * Fields between particles are sums over the particles p near a point x. The weight is that of the solver's transfers,
 *     W_p(x) = product over the axes a of w((x_a - x_pa) / dx),
 *     w(r) = 3/4 - r^2 for |r| < 1/2;  (3/2 - |r|)^2 / 2 for |r| < 3/2;  0 beyond,
 * and the precision double. One field is the filling, the share of space that matter takes at rest volume.
 *     filling(x) = sum_p V_p W_p(x) / dx^d,    V_p: rest volume.
 * It is about 1 inside matter, 1/2 on its surface, and 0 farther than 3/2 cells from it. Near a wall it lacks what the wall's
 * other side would have: it is 1/2 there too. */

/** What one material has in a region. */
typedef struct pbmpm_region_share {
    uint32_t size;      /**< sizeof(pbmpm_region_share); set by the caller in the first element of an array */
    pbmpm_material_id material;
    uint64_t count;     /**< particles whose centre is inside */
    double mass;        /**< of these [kg] (2D: per metre of depth) */
    double volume;      /**< present volume, rest volume times VOLUME_RATIO [m^d] */
    double rest_volume; /**< [m^d] */
} pbmpm_region_share;

/** What is inside a shape, by material: one entry for each material that has particles there, in the order of their indices.
 *  Writes up to `capacity` entries; *count is the full number. `shares` may be null when capacity is 0; otherwise shares[0].size must be set.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED (size), OUT_OF_MEMORY, BUSY, FORKED. */
PBMPM_API pbmpm_result pbmpm_query_region(pbmpm_world_id world, const pbmpm_shape *shape, pbmpm_region_share *shares, uint32_t capacity,
                                          uint32_t *count);

/** Fields at points. `points`: count * d floats [m]. Each of the others may be null:
 *  `filling`: count floats, as defined above;
 *  `density`: count floats, sum_p m_p W_p / dx^d [kg/m^3] (2D: kg/m^2);
 *  `velocity`: count * d floats, sum_p m_p W_p (v_p + C_p (x - x_p)) / sum_p m_p W_p [m/s], C_p the affine velocity; 0 where
 *  there is no matter. A velocity that is linear in x comes out exactly.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null points, a coordinate that is not finite), OUT_OF_MEMORY, BUSY, FORKED. */
PBMPM_API pbmpm_result pbmpm_query_points(pbmpm_world_id world, const float *points, uint32_t count, float *filling, float *density,
                                          float *velocity);

/** The highest matter over (or under) points. "Up" is the unit vector u along `direction` (d floats, any length above 1e-6). If that
 *  is null, it is against gravity. On the line through a point x, take the samples x + k dx/4 u for all integers k. The surface is the highest one where the
 *  filling reaches `level`, moved up by 12 halvings towards the next sample. heights[i] is its coordinate
 *  along u, u . x [m], so with u = +y it is its y; -infinity where the line meets no matter.
 *  `points`: count * d floats [m]; `level`: in (0, 100], 0.5 is the surface.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (also: null direction without gravity), OUT_OF_MEMORY, BUSY, FORKED. */
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
    pbmpm_particle_id particle; /**< nearest to the position of those that count there (W_p > 0); of equals the first in storage order */
} pbmpm_ray_hit;

/** Writes the defaults. Errors: INVALID_ARGUMENT (null), UNSUPPORTED (unknown size). Any thread. */
PBMPM_API pbmpm_result pbmpm_ray_init(pbmpm_ray *ray, size_t size);

/** The first point along a ray where the filling reaches the level. Samples lie dx/4 apart, the first one at the origin; the way
 *  from the last sample below the level to the first one that reaches it is halved 12 times. A ray that begins in matter
 *  hits at distance 0. `hit->size` must be set.
 *  Errors: INVALID_ID, INVALID_ARGUMENT, UNSUPPORTED, OUT_OF_MEMORY, BUSY, FORKED. */
PBMPM_API pbmpm_result pbmpm_query_ray(pbmpm_world_id world, const pbmpm_ray *ray, pbmpm_ray_hit *hit);

#ifdef __cplusplus
}
#endif
#endif
