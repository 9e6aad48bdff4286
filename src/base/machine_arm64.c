#include "base/machine.h"

/* Every 64-bit ARM has NEON. */
pbmpm_isa machine_isa(void) { return PBMPM_ISA_NEON; }

/* FPCR, as in the Arm Architecture Reference Manual: its upper half is reserved. */
uint32_t machine_float_mode(void)
{
    uint64_t mode;
    __asm__ volatile("mrs %0, fpcr" : "=r"(mode));
    return (uint32_t)mode;
}

void machine_set_float_mode(uint32_t mode) { __asm__ volatile("msr fpcr, %0" : : "r"((uint64_t)mode)); }

const uint32_t MACHINE_KERNEL_MODE = 1u << 24; /* FZ: operands and results */

void machine_pause(void) { __asm__ volatile("yield"); }
