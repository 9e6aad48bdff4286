#include "base/cpu.h"

#include <cpuid.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <xmmintrin.h>

#include "base/platform.h"

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

pbmpm_isa cpu_isa(void)
{
    static atomic_int chosen = -1;
    int isa = atomic_load(&chosen);
    if (isa < 0) {
        const pbmpm_isa best = best_isa(), wanted = wanted_isa();
        isa = (int)(wanted < best ? wanted : best);
        atomic_store(&chosen, isa);
    }
    return (pbmpm_isa)isa;
}

const char *cpu_isa_name(pbmpm_isa isa)
{
    switch (isa) {
    case PBMPM_ISA_NONE: return "none";
    case PBMPM_ISA_SSE4: return "SSE4";
    case PBMPM_ISA_AVX2: return "AVX2";
    case PBMPM_ISA_AVX512: return "AVX-512";
    case PBMPM_ISA_FORCE32: break;
    }
    return "unknown";
}

int cpu_core_count(void)
{
    const long count = platform_core_count();
    return count < 1 ? 1 : count > 256 ? 256 : (int)count;
}

uint32_t float_mode_enter(void)
{
    enum { FTZ_DAZ_NEAREST_MASKED = 0x9fc0 };
    const uint32_t old = _mm_getcsr();
    _mm_setcsr(FTZ_DAZ_NEAREST_MASKED);
    return old;
}

void float_mode_leave(uint32_t old) { _mm_setcsr(old); }

static _Thread_local uint32_t host_mode;
static _Thread_local int depth; /* calls of the API that this thread is inside of */

uint32_t float_mode_enter_from_host(void)
{
    const uint32_t old = float_mode_enter();
    host_mode = old;
    depth++;
    return old;
}

void float_mode_leave_to_host(uint32_t old)
{
    depth--;
    host_mode = old;
    float_mode_leave(old);
}

uint32_t float_mode_of_host(void) { return host_mode; }

FloatModes float_mode_enter_for(uint32_t host)
{
    const FloatModes before = {float_mode_enter(), host_mode};
    host_mode = host;
    depth++;
    return before;
}

void float_mode_leave_for(FloatModes before)
{
    depth--;
    host_mode = before.host;
    float_mode_leave(before.own);
}

uint32_t float_mode_lend(void)
{
    const uint32_t ours = _mm_getcsr();
    if (depth > 0) _mm_setcsr(host_mode);
    return ours;
}

void float_mode_take_back(uint32_t lent) { _mm_setcsr(lent); }
