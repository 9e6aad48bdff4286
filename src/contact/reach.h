/* Which nodes matter of some kind reaches. First solids: elastic matter, sand, and what yields.
 *
 * In the joint solver matter rubs at walls there alone. Coulomb's friction is that of dry matter. Fed with the pressure of deep water, it held the water at
 * walls like honey: a jelly did not sink in a glass. What holds a liquid back is its viscosity, at walls that it sticks to. Liquid by itself still rubs:
 * without friction, what boxes had crushed left them a third faster than it may. */
#ifndef PBMPM_SRC_CONTACT_REACH_H
#define PBMPM_SRC_CONTACT_REACH_H

#include "contact/contacts.h"

/* Finds frame->solid. */
pbmpm_result reach_find(ContactFrame *frame, const KernelMaterial *material, Memory *memory);

/* Finds frame->groups, if an obstacle does not act on all matter that there is; `of_material` counts its particles. */
pbmpm_result reach_find_groups(ContactFrame *frame, const pbmpm_material_def *material, const uint32_t *of_material, Memory *memory);

/* Whether solids reach a node of the grid; of all of them where nobody looked. */
static inline bool reach_solid(const ContactFrame *frame, uint32_t node)
{
    const uint32_t cells = (uint32_t)frame->grid->block_cells;
    return !frame->solid || (frame->solid[node / cells] >> (node % cells) & 1);
}

#endif
