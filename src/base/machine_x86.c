#include "base/machine.h"

#include <cpuid.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <xmmintrin.h>

/* As in Intel's Software Developer's Manual, volume 1, chapters 14 and 15: the CPU has it, and the system saves its registers. The compiler's
 * __builtin_cpu_supports() reads a table of its run time, which not every tool chain fills in. */
enum { XMM_YMM_STATE = 0x06, ZMM_STATE = 0xe0 }; /* bits of XCR0 */

static uint32_t saved_state(void)
{
    uint32_t low, high;
    __asm__ volatile("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return low;
}

static bool all_of(uint32_t bits, uint32_t wanted) { return (bits & wanted) == wanted; }

static pbmpm_isa best_isa(void)
{
    uint32_t a, b, c, d, seven = 0;
    if (!__get_cpuid(1, &a, &b, &c, &d) || !all_of(c, bit_SSE4_2)) return PBMPM_ISA_NONE;
    const uint32_t one = c, state = all_of(one, bit_OSXSAVE) ? saved_state() : 0;
    const bool known = __get_cpuid_count(7, 0, &a, &seven, &c, &d);
    if (!known || !all_of(state, XMM_YMM_STATE) || !all_of(one, bit_FMA) || !all_of(seven, bit_AVX2)) return PBMPM_ISA_SSE4;
    const uint32_t avx512 = bit_AVX512F | bit_AVX512DQ | bit_AVX512CD | bit_AVX512BW | bit_AVX512VL;
    return all_of(state, ZMM_STATE) && all_of(seven, avx512) ? PBMPM_ISA_AVX512 : PBMPM_ISA_AVX2;
}

static pbmpm_isa wanted_isa(void)
{
    const char *name = getenv("PBMPM_ISA");
    if (name && strcmp(name, "sse4") == 0) return PBMPM_ISA_SSE4;
    if (name && strcmp(name, "avx2") == 0) return PBMPM_ISA_AVX2;
    return PBMPM_ISA_AVX512;
}

pbmpm_isa machine_isa(void)
{
    const pbmpm_isa best = best_isa(), wanted = wanted_isa();
    return wanted < best ? wanted : best;
}

uint32_t machine_float_mode(void) { return _mm_getcsr(); }

void machine_set_float_mode(uint32_t mode) { _mm_setcsr(mode); }

const uint32_t MACHINE_KERNEL_MODE = 0x9fc0;

void machine_pause(void) { _mm_pause(); }
