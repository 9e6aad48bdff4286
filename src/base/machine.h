/* What kinds of CPUs do each in its own way: machine_x86.c, machine_arm64.c. */
#ifndef PBMPM_SRC_BASE_MACHINE_H
#define PBMPM_SRC_BASE_MACHINE_H

#include <stdint.h>

#include "pbmpm/base.h"

/* The best instruction set that has kernels and that the CPU supports, lowered by PBMPM_ISA in the environment. */
pbmpm_isa machine_isa(void);

/* The register of the floating-point mode of this thread. */
uint32_t machine_float_mode(void);
void machine_set_float_mode(uint32_t mode);

/* Round to nearest, flush to zero, denormals are zero, no traps. */
extern const uint32_t MACHINE_KERNEL_MODE;

/* For loops that wait for another thread. */
void machine_pause(void);

#endif
