/* Finding the nodes that obstacles may meet in a substep. */
#ifndef PBMPM_SRC_CONTACT_CONTACTS_FIND_H
#define PBMPM_SRC_CONTACT_CONTACTS_FIND_H

#include "contact/contacts.h"

/* Finds frame->gap, which the others need. */
pbmpm_result contacts_measure(ContactFrame *frame, Memory *memory, Pool *pool);

/* Lists the contacts of all blocks; needs node_reach of the predictor. */
pbmpm_result contacts_find(const ContactFrame *frame, Memory *memory, Pool *pool);

#endif
