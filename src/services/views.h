/* Views of the particles' fields. Nothing here changes the state. */
#ifndef PBMPM_SRC_SERVICES_VIEWS_H
#define PBMPM_SRC_SERVICES_VIEWS_H

#include "world/world.h"

pbmpm_result views_get(World *world, pbmpm_field field, pbmpm_view *view);

enum { VIEW_FIELDS = PBMPM_USER_VALUE + 1 };

/* Whether there is such a field; and the refusal of one that there is not. */
bool views_is_field(pbmpm_field field);
pbmpm_result views_no_field(pbmpm_field field);

/* Values per particle of a field, and whether this world has it. */
uint32_t views_components(const World *world, pbmpm_field field);
bool views_has(const World *world, pbmpm_field field);

#endif
