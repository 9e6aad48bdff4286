/* Advice: what the present scene and settings will not hold. Each rule stands beside the law that it follows from. */
#ifndef PBMPM_SRC_SERVICES_ADVICE_H
#define PBMPM_SRC_SERVICES_ADVICE_H

#include "pbmpm/advice.h"
#include "world/world.h"

/* The arguments have been checked. */
pbmpm_result advice_give(World *world, double dt, pbmpm_advice *array, uint32_t capacity, uint32_t *count);

const char *advice_name(pbmpm_advice_code code);
const char *advice_unit(pbmpm_advice_code code);

#endif
