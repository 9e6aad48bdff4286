#!/bin/sh
# arm64.sh - builds the library and its tests for Linux on 64-bit ARM, and runs them in QEMU, some thirty times slower than a CPU: those of the kernels, and those
# of the internals and of the C interface that are short. Then strict builds of ARM and x86, whose hashes have to be equal. An hour, so run
# by hand. PBMPM_TESTS: a pattern of the tests to run.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
. packaging/tools.sh
. tests/emulated.sh
too_long='unit_(snapshot|rigid|solids)|api_(async|conservation|determinism|groups|impulses|liquid_laws|particles|plastic|random|rigid|sleep|sleep_state|snapshot|solid_laws|solids|solver_laws|solvers|stalls|threads|units)|stir'
root=/usr/aarch64-linux-gnu
qemu=$(need_tool qemu-aarch64 qemu-user)
need_tool $root/lib/ld-linux-aarch64.so.1 libc6-arm64-cross >/dev/null
need_llvm
make_tools
build_for linux-arm64 "-DCMAKE_CROSSCOMPILING_EMULATOR=$qemu;-L;$root"

stage "Running in QEMU"
ctest --test-dir build/linux-arm64 --output-on-failure -j "$(nproc)" -R "${PBMPM_TESTS:-^(kernels_|unit_|api_|samples)}" -E "$too_long"

strict_build linux-x64
strict_build linux-arm64
PBMPM_ISA=sse4 compare_hashes 20 build/strict-linux-x64/tests/hashes "$qemu -L $root build/strict-linux-arm64/tests/hashes"
