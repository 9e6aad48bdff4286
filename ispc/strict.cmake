# A strict build gives the same bits with every instruction set: no fused operations (here), sums over lanes by fours (lanes.isph) and functions
# of our own in place of the C library's (src/base/strict_math.h). ISPC's divisions and roots are exact, for nothing asks for fast maths, and its
# other functions are the same source for all. Slower, so it is an option.
include_guard(GLOBAL)
option(PBMPM_STRICT "The same results with SSE4, AVX2 and AVX-512, bit for bit; slower" OFF)
set(PBMPM_STRICT_DEFINITION PBMPM_STRICT=$<BOOL:${PBMPM_STRICT}> CACHE INTERNAL "")
set(PBMPM_STRICT_FLAGS $<$<BOOL:${PBMPM_STRICT}>:--opt=disable-fma> CACHE INTERNAL "")
