/* How much room obstacles leave for matter. */
#ifndef PBMPM_SRC_OPEN_VOLUME_H
#define PBMPM_SRC_OPEN_VOLUME_H

#include "colliders.h"

/* The share of the support of a node [m] that the obstacles leave open at the end of the substep; never 0. */
double open_share_at(const Colliders *colliders, const double node[3], double cell_size);

/* Divides the rest volume of each node by the share of its cell that obstacles leave open, so that it is 1 where matter at rest
 * fills what is open. And marks the blocks near obstacles other than planes, see KernelArgs.edged. */
void contacts_open_volume(const ContactFrame *frame, Pool *pool, bool resting_only);

#endif
