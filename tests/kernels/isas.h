/* A loop over the instruction sets that the CPU has, up to the one in PBMPM_ISA. */
#ifndef PBMPM_TESTS_ISAS_H
#define PBMPM_TESTS_ISAS_H

#include "base/cpu.h"

#if defined(__aarch64__)
#define LOWEST_ISA PBMPM_ISA_NEON
#else
#define LOWEST_ISA PBMPM_ISA_SSE4
#endif

#define EACH_ISA(isa) for (pbmpm_isa isa = LOWEST_ISA; isa <= cpu_isa(); isa = (pbmpm_isa)(isa + 1))

#endif
