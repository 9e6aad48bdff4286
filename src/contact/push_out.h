/* Particles that passed through an obstacle or ended in one. */
#ifndef PBMPM_SRC_CONTACT_PUSH_OUT_H
#define PBMPM_SRC_CONTACT_PUSH_OUT_H

#include "contact/contacts.h"

/* Takes the memory that contacts_push_out() books in. */
pbmpm_result contacts_prepare_push(const ContactFrame *frame, Memory *memory);

/* Before particles move: notes where those of the particle blocks [begin, end) are that may meet an obstacle, in a spare array, for
 * contacts_push_out(). */
void contacts_keep_places(const ContactFrame *frame, const Particles *particles, int32_t begin, int32_t end);

/* Last resort: holds back particles of the particle blocks [begin, end) that passed through an obstacle, and puts those that ended
 * inside one back to its surface. */
void contacts_push_out(const ContactFrame *frame, Particles *particles, int32_t begin, int32_t end);

/* In place of that, for a block whose particles did not move. */
void contacts_pass_over(const ContactFrame *frame, int32_t block);

/* After all blocks: finishes the blocks that had no room to book in, and adds what was booked to the impulses. */
void contacts_book_push(const ContactFrame *frame, Particles *particles);

#endif
