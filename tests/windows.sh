#!/bin/sh
# windows.sh - builds the library for Windows (packaging/windows.sh) and runs it under Wine: the sample, and 20 scenes, whose hashes have to be those of
# Linux with each instruction set that this CPU has. Needs wine64 and build/tests (tests/run.sh); minutes, so run by hand.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
. packaging/tools.sh
wine=$(command -v wine64 || ls /usr/lib/wine/wine64 2>/dev/null) || stop "as an administrator type: apt-get install wine64"
linux=build/tests/tests/strict/hashes
[ -x "$linux" ] || stop "there is no $linux: cmake --preset tests && cmake --build --preset tests"
built=build/windows
sh packaging/windows.sh $built

stage "Running under Wine"
export WINEDEBUG=-all WINEPREFIX="$PWD/build/wine" WINEPATH="$PWD/$built/lib"
"$wine" $built/samples/minimal.exe
"$tools/bin/cc-x86_64-windows-gnu" -std=gnu17 -O2 -Iinclude -Isrc tests/strict/hashes.c $built/lib/libpbmpm.dll.a -o $built/hashes.exe
for isa in sse4 avx2 avx512; do
    PBMPM_ISA=$isa $linux 60 >$built/linux.txt
    PBMPM_ISA=$isa "$wine" $built/hashes.exe 60 | tr -d '\r' >$built/windows.txt
    diff $built/linux.txt $built/windows.txt || stop "Windows differs from Linux with $isa"
    echo "$(head -n 1 $built/windows.txt): $(($(wc -l <$built/windows.txt) - 1)) scenes as on Linux"
done
