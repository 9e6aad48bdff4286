/* Free flight: particles of liquids that share no node with another one, whose pressure is 0, and that nothing is near. What the grid would give them is known,
 * see ispc/flight.isph; so they take no part in it. */
#ifndef PBMPM_SRC_STEP_FLIGHT_H
#define PBMPM_SRC_STEP_FLIGHT_H

#include <stdbool.h>
#include <stdint.h>

struct World;

typedef struct Flight {
    const struct World *world;
    bool possible; /* for some particle */
} Flight;

/* The obstacles of the substep are known. */
void flight_begin(Flight *flight, const struct World *world);

/* A GridFlies; `context`: a Flight that is possible. */
bool flight_is_free(const void *context, uint32_t row);

#endif
