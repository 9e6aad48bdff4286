/* What forces do to the nodes of the predictor. */
#ifndef PBMPM_SRC_STEP_FORCING_H
#define PBMPM_SRC_STEP_FORCING_H

#include "contact/contacts.h"
#include "world/world.h"

/* Changes the predictor of a substep. On failure (no memory) it is as it was. */
pbmpm_result forces_apply(World *world);
/* That substep is done, and what its contacts gave is booked: what the forces did in it counts. */
void forces_account(World *world, const ContactFrame *contacts);

#endif
