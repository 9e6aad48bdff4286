/* pbmpm: what a host draws to see what the library sees. */
#ifndef PBMPM_DEBUG_H
#define PBMPM_DEBUG_H

#include "world.h"

#ifdef __cplusplus
extern "C" {
#endif

/** What lines can show. Add values to choose several. */
typedef enum pbmpm_debug_part {
    PBMPM_DEBUG_DOMAIN = 1,      /**< the outlines of the closed walls; open ones are not drawn */
    PBMPM_DEBUG_COLLIDERS = 2,   /**< where they stand now */
    PBMPM_DEBUG_EMITTERS = 4,    /**< where they stand now, those that are switched off too */
    PBMPM_DEBUG_DRAINS = 8,      /**< where they stand now, those that are switched off too */
    PBMPM_DEBUG_FORCES = 16,     /**< where those stand that are switched on */
    PBMPM_DEBUG_KILL_BOUNDS = 32, /**< if they are enabled */
    PBMPM_DEBUG_BLOCKS = 64,     /**< blocks of the grid that held particles in the last substep */
    PBMPM_DEBUG_ASLEEP = 128,    /**< blocks that sleep */
    PBMPM_DEBUG_ALL = 255,       /**< everything */
    PBMPM_DEBUG_FORCE32 = 0x7fffffff
} pbmpm_debug_part;

/** A line to draw. This structure never grows. */
typedef struct pbmpm_line {
    float from[3];         /**< [m], relative to the origin; 2D: z is 0 */
    float to[3];           /**< [m], as `from` */
    pbmpm_debug_part part; /**< what it shows: one of the parts, to choose a colour by */
} pbmpm_line;

/** Lines that show obstacles, regions and the grid. Balls and capsules are drawn as circles of 24 lines, planes as a square of 20
 *  cells (2D: a line) around their position, baked solids by contours of their surface. `parts`: a sum of pbmpm_debug_part. *count
 *  is how many lines there are; the first `capacity` of them are written to `lines`, which may be null with a capacity of 0. Costs
 *  what it draws, and only when called.
 *  Errors: INVALID_ID, INVALID_ARGUMENT (null, unknown parts), BUSY, FORKED. Threads: shared. */
PBMPM_API pbmpm_result pbmpm_world_debug_lines(pbmpm_world_id world, uint32_t parts, pbmpm_line *lines, uint32_t capacity, uint32_t *count);

#ifdef __cplusplus
}
#endif
#endif
