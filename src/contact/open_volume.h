/* How much room obstacles leave for matter. */
#ifndef PBMPM_SRC_CONTACT_OPEN_VOLUME_H
#define PBMPM_SRC_CONTACT_OPEN_VOLUME_H

#include "contact/contacts.h"

/* The share of the support of a node [m] that the obstacles leave open at the end of the substep; never 0. */
double open_share_at(const ContactFrame *frame, const double node[3], uint32_t groups);

/* A number for how it finds them, which differs where the shares do. */
int contacts_opened(const ContactFrame *frame, bool resting_only);

/* Divides the rest volume of each node by the share of its cell that obstacles leave open, so that it is 1 where matter at rest
 * fills what is open; near walls of frame->walls both are folded first, see walls.h. And marks the blocks near obstacles other than planes, see
 * KernelArgs.grid.edged. False: no memory. */
bool contacts_open_volume(const ContactFrame *frame, Memory *memory, Pool *pool, bool resting_only);

#endif
