#!/bin/sh
# arm64.sh - builds the library and its tests for Linux on 64-bit ARM, and runs them in QEMU, some thirty times slower than a CPU: those of the kernels, those of
# the internals and of the C interface that are short, and the C# binding with Debian's Mono for ARM. Then strict builds of ARM and x86, whose hashes have to be equal. Half an hour, so run
# by hand. PBMPM_TESTS: a pattern of the tests to run. Not api_fork: QEMU 7.2 stops by an assertion of its own where a process forks beside its threads.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
. packaging/tools.sh
. tests/emulated.sh
too_long='unit_(snapshot|rigid|solids)|api_(async|conservation|determinism|fork|groups|impulses|liquid_laws|particles|plastic|random|rigid|sleep|sleep_state|snapshot|solid_laws|solids|solver_laws|solvers|stalls|threads|units)|stir'
root=/usr/aarch64-linux-gnu
qemu=$(need_tool qemu-aarch64 qemu-user)
need_tool $root/lib/ld-linux-aarch64.so.1 libc6-arm64-cross >/dev/null
need_tool mcs mono-mcs >/dev/null
need_llvm
make_tools

# Nothing of it is installed, so no administrator is needed.
mono=$PWD/build/mono-arm64
fetch_mono() {
    mkdir -p "$mono/state/lists/partial" "$mono/cache/archives/partial"
    : >"$mono/state/status"
    set -- -o APT::Architecture=arm64 -o APT::Architectures=arm64 -o "Dir::State=$mono/state" -o "Dir::State::status=$mono/state/status" -o "Dir::Cache=$mono/cache"
    apt-get "$@" update || return 1
    apt-get "$@" install -y --download-only --no-install-recommends mono-runtime libmono-corlib4.5-cil libmono-system-core4.0-cil libmono-system-numerics4.0-cil || return 1
    for package in "$mono"/cache/archives/*.deb; do dpkg -x "$package" "$mono/root" || return 1; done
}
stage "Mono for ARM in build/mono-arm64"
[ -e "$mono/root/usr/bin/mono-sgen" ] || quietly mono-arm64.log fetch_mono || stop "could not fetch Mono for ARM; full text: build/mono-arm64.log"
build_for linux-arm64 "-DCMAKE_CROSSCOMPILING_EMULATOR=$qemu;-L;$root" "-DPBMPM_MONO_ROOT=$mono/root"

stage "Running in QEMU"
ctest --test-dir build/linux-arm64 --output-on-failure -j "$(nproc)" -R "${PBMPM_TESTS:-^(kernels_|unit_|api_|csharp|samples)}" -E "$too_long"

strict_build linux-x64
strict_build linux-arm64
PBMPM_ISA=sse4 compare_hashes 20 build/strict-linux-x64/tests/hashes "$qemu -L $root build/strict-linux-arm64/tests/hashes"
