/* Adding, removing, changing and finding particles on behalf of the caller. Arguments are checked here; on failure
 * nothing has changed. */
#ifndef PBMPM_SRC_SERVICES_EDIT_PARTICLES_H
#define PBMPM_SRC_SERVICES_EDIT_PARTICLES_H

#include "world/world.h"

pbmpm_particles_def particles_def_defaults(void);
pbmpm_fill_def fill_def_defaults(void);

pbmpm_result edit_add(World *world, const pbmpm_particles_def *def, uint32_t generation, pbmpm_particle_id *ids);
pbmpm_result edit_fill(World *world, const pbmpm_fill_def *def, const pbmpm_shape *shape, uint32_t generation, uint32_t *added);
pbmpm_result edit_remove(World *world, const pbmpm_particle_id *ids, uint32_t count);
pbmpm_result edit_remove_in(World *world, const pbmpm_shape *shape, uint32_t *removed);
pbmpm_result edit_set(World *world, pbmpm_field field, const pbmpm_particle_id *ids, uint32_t count, const void *given);

/* Refuses the identifier of a particle that is not there, at a place of the caller's list. */
pbmpm_result edit_no_particle(pbmpm_particle_id id, uint32_t place);

#endif
