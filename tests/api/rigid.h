/* Rigid bodies to test with: made, held, put on a floor, and advanced. */
#ifndef PBMPM_TESTS_API_RIGID_H
#define PBMPM_TESTS_API_RIGID_H

#include "pace.h"
#include "scenes.h"

extern const double PI;

/** A body, its obstacle, and the world that it is in. */
typedef struct rigid {
    pbmpm_world_id world;
    pbmpm_collider_id collider;
    pbmpm_rigid_def def;
    pbmpm_rigid_state state;
} rigid;

/** Without walls, with room for 16 particles. */
pbmpm_world_id empty_world(int32_t dimension, float dx);

pbmpm_mass_properties mass_of(pbmpm_world_id world, pbmpm_shape shape, float density);

/** Of a density, at rest, without friction; `hold` (may be null) changes how it is held. */
rigid make_rigid(pbmpm_world_id world, pbmpm_shape shape, float density, void (*hold)(pbmpm_rigid_def *def));

/** Ways to hold it: by a hinge askew beside its middle; by one along z, half a metre above it. */
void hang_on_a_hinge(pbmpm_rigid_def *def);
void short_pendulum(pbmpm_rigid_def *def);

/** A world of 40 m with a floor, whose friction a body of a shape on it shares. */
rigid put_on_floor(int32_t dimension, pbmpm_shape shape, float of_body, float of_floor);

void advance(rigid *body); /**< the body alone, by DT */
void step(rigid *body);    /**< the body, then its world */

#endif
