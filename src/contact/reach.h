/* Which nodes matter of some kind reaches. First solids: elastic matter, sand, and what yields.
 *
 * Matter rubs at walls there alone. Coulomb's friction is that of dry matter. Fed with the pressure of deep water, it holds the water at walls like
 * honey. What holds a liquid back is its viscosity, at walls that it sticks to.
 */
#ifndef PBMPM_SRC_CONTACT_REACH_H
#define PBMPM_SRC_CONTACT_REACH_H

#include "contact/contacts.h"

/* Finds frame->solid. */
pbmpm_result reach_find(ContactFrame *frame, const KernelMaterial *material, Memory *memory);

/* Finds frame->groups, if an obstacle does not act on all matter that there is; `of_material` counts its particles. */
pbmpm_result reach_find_groups(ContactFrame *frame, const pbmpm_material_def *material, const uint32_t *of_material, Memory *memory);

/* Whether solids reach a node of the grid: none where there is but liquid, all where nobody looked. */
static inline bool reach_solid(const ContactFrame *frame, uint32_t node)
{
    const uint32_t cells = (uint32_t)frame->grid->block_cells;
    if (frame->liquid) return false;
    return !frame->solid || (frame->solid[node / cells] >> (node % cells) & 1);
}

#endif
