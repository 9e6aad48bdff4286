#include "base/machine.h"

/* What runs the program has refused it already if it has no SIMD128. */
pbmpm_isa machine_isa(void) { return PBMPM_ISA_WASM; }

/* WebAssembly has a single mode, in which denormals are kept, and no other threads. */
uint32_t machine_float_mode(void) { return 0; }

void machine_set_float_mode(uint32_t mode) { (void)mode; }

const uint32_t MACHINE_KERNEL_MODE = 0;

void machine_pause(void) {}
