/* Reading a world: views, statistics, hash. Nothing here changes the state. */
#ifndef PBMPM_SRC_SERVICES_INSPECT_H
#define PBMPM_SRC_SERVICES_INSPECT_H

#include "world/world.h"

pbmpm_result inspect_view(World *world, pbmpm_field field, pbmpm_view *view);

enum { INSPECT_FIELDS = PBMPM_USER_VALUE + 1 };

/* Whether there is such a field; and the refusal of one that there is not. */
bool inspect_is_field(pbmpm_field field);
pbmpm_result inspect_no_field(pbmpm_field field);

/* Values per particle of a field, and whether this world has it. */
uint32_t inspect_components(const World *world, pbmpm_field field);
bool inspect_has(const World *world, pbmpm_field field);

/* What the last step has noted, and with a pass over the particles what there is now. */
void inspect_step_stats(World *world, pbmpm_stats *stats);
void inspect_stats(World *world, pbmpm_stats *stats);

uint64_t inspect_hash(const World *world);

#endif
