#!/bin/sh
# windows.sh [FOLDER] - builds pbmpm.dll, its import library and the C samples for 64-bit Windows in FOLDER (build/windows), on Linux.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
. packaging/tools.sh
has llc-19 || has llc-20 || has llc || stop "LLVM's llc is missing; as an administrator type: apt-get install llvm-19"
make_tools
compiler=$(write_compiler x86_64-windows-gnu)

stage "Building for Windows"
cmake -S . -B "${1:-build/windows}" -G Ninja -DCMAKE_SYSTEM_NAME=Windows -DCMAKE_SYSTEM_PROCESSOR=AMD64 -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_C_COMPILER="$compiler" -DCMAKE_RC_COMPILER=llvm-windres -DPBMPM_TESTS=OFF
cmake --build "${1:-build/windows}"
