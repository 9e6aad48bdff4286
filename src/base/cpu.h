/* What the CPU can do, and the floating-point mode the kernels run in. */
#ifndef PBMPM_SRC_BASE_CPU_H
#define PBMPM_SRC_BASE_CPU_H

#include "pbmpm/base.h"

/* The best supported instruction set, lowered by PBMPM_ISA in the environment; asked once. Runs on any CPU of the architecture. */
pbmpm_isa cpu_isa(void);
const char *cpu_isa_name(pbmpm_isa isa);
int cpu_core_count(void);

/* Sets round-to-nearest, flush-to-zero, denormals-are-zero and masked exceptions; returns the old mode. Results depend
 * on the mode, and denormals cost dearly, so every entry that computes and every worker uses this. */
uint32_t float_mode_enter(void);
void float_mode_leave(uint32_t old);

/* The same at the edge of the API: the mode of the caller is remembered for the thread, so that functions of the host that are called
 * from inside run in it: float_mode_lend() before, float_mode_take_back() with its result after. */
uint32_t float_mode_enter_from_host(void);
void float_mode_leave_to_host(uint32_t old);
uint32_t float_mode_of_host(void);

/* For work on behalf of a thread whose mode is `host`, perhaps in the midst of other such work: functions of the host are called in that mode. */
typedef struct FloatModes {
    uint32_t own, host;
} FloatModes;
FloatModes float_mode_enter_for(uint32_t host);
void float_mode_leave_for(FloatModes before);

uint32_t float_mode_lend(void);
void float_mode_take_back(uint32_t lent);

#endif
