/* From particles to what a surface is cut out of, in stages: F (field.h), G (boundary.h), T and k (thin.h), then min(G + k T, L + s d).
 *
 * Each stage works only where what it starts from has changed since the last surface, in a block or beside it; and blocks whose numbers came out as they were have not
 * changed for the next one. So the outcome is, bit for bit, that of a surface of which nothing is kept. Of changes beside a block it is enough to know of those next to it:
 * no stage looks farther. */
#ifndef PBMPM_SRC_SKIN_MAKE_H
#define PBMPM_SRC_SKIN_MAKE_H

#include "skin/field.h"

/* The blocks are found and compared. Those whose field is not what it was are `changed` after. */
void make_field(const FieldWork *work);

#endif
