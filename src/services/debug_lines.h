/* Lines that show what is in a world. */
#ifndef PBMPM_SRC_SERVICES_DEBUG_LINES_H
#define PBMPM_SRC_SERVICES_DEBUG_LINES_H

#include "pbmpm/debug.h"
#include "world/world.h"

/* Writes the first `capacity` lines of the parts; returns how many there are, at most UINT32_MAX. */
uint32_t debug_lines_draw(const World *world, uint32_t parts, pbmpm_line *lines, uint32_t capacity);

#endif
