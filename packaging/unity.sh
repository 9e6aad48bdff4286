#!/bin/sh
# unity.sh - leaves dist/com.pbmpm.unity-VERSION.tgz, the package for Unity. It builds the library for Linux in build/linux-x64 unless it is there, and
# takes those of other systems that are built (build/windows-x64 and the like).
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
. packaging/tools.sh

if [ ! -e build/linux-x64/lib/libpbmpm.so ]; then
    make_tools
    compiler=$(write_compiler x86_64-linux-gnu.2.28) # runs with this C library and newer ones
    stage "Building for Linux"
    quietly unity-build.log cmake -S . -B build/linux-x64 -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER="$compiler" -DPBMPM_TESTS=OFF &&
        quietly unity-build.log cmake --build build/linux-x64 --target pbmpm || stop "the build failed; full text: build/unity-build.log"
fi
stage "The Unity package"
python3 packaging/unity.py pack
