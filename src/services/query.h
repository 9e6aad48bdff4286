/* Questions about matter between particles: regions, points, heights, rays. Definitions stand in pbmpm/query.h. Arguments
 * have been checked. Nothing here changes the state; the first query after a change makes the tree. */
#ifndef PBMPM_SRC_SERVICES_QUERY_H
#define PBMPM_SRC_SERVICES_QUERY_H

#include "pbmpm/query.h"
#include "world/world.h"

pbmpm_ray query_ray_defaults(void);

/* Null if valid, else what is wrong. */
const char *query_points_problem(const World *world, const float *points, uint32_t count);
const char *query_level_problem(float level);
const char *query_ray_problem(const World *world, const pbmpm_ray *ray);

/* The unit vector along `direction`, or against gravity if that is null; false if there is none. */
bool query_direction(const World *world, const float *direction, double unit[3]);

/* Rows of particles nearer than `margin` [m] to the inside of the solid, in storage order. */
pbmpm_result query_inside(World *world, const Solid *solid, double margin, pbmpm_particle_id *ids, uint32_t capacity, uint32_t *count);

/* How many of those rows there are of each material. */
pbmpm_result query_materials(World *world, const Solid *solid, double margin, uint32_t counts[PBMPM_MAX_MATERIALS]);

pbmpm_result query_region(World *world, const Solid *solid, pbmpm_region_share *shares, uint32_t capacity, uint32_t *count);
pbmpm_result query_points(World *world, const float *points, uint32_t count, float *filling, float *density, float *velocity);
pbmpm_result query_heights(World *world, const float *points, uint32_t count, const double up[3], float level, float *heights);
pbmpm_result query_ray(World *world, const pbmpm_ray *ray, pbmpm_ray_hit *hit);

#endif
