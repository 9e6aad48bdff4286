#include "base/cpu.h"

#include <stdatomic.h>

#include "base/machine.h"
#include "base/platform.h"

pbmpm_isa cpu_isa(void)
{
    static atomic_int chosen = -1;
    int isa = atomic_load(&chosen);
    if (isa < 0) {
        isa = (int)machine_isa();
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
    case PBMPM_ISA_NEON: return "NEON";
    case PBMPM_ISA_WASM: return "SIMD128";
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
    const uint32_t old = machine_float_mode();
    machine_set_float_mode(MACHINE_KERNEL_MODE);
    return old;
}

void float_mode_leave(uint32_t old) { machine_set_float_mode(old); }

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
    const uint32_t ours = machine_float_mode();
    if (depth > 0) machine_set_float_mode(host_mode);
    return ours;
}

void float_mode_take_back(uint32_t lent) { machine_set_float_mode(lent); }
