#!/bin/sh
# windows.sh - builds the library and its tests for 64-bit Windows on Linux, and runs them under Wine: the internals, the C interface, the samples, the C#
# binding with .NET Core for Windows, a process that ends with threads at work, many times, and 20 scenes, whose hashes have to be those of Linux with each
# instruction set that this CPU has. Needs build/tests (tests/run.sh). Half an hour, so run by hand. PBMPM_TESTS: a pattern of the tests to run.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
. packaging/tools.sh
. tests/emulated.sh
linux=build/tests/tests/strict/hashes
[ -x "$linux" ] || stop "there is no $linux: cmake --preset tests && cmake --build --preset tests"
wine=$(need_tool /usr/lib/wine/wine64 wine64)
need_tool mcs mono-mcs >/dev/null
need_llvm
make_tools

stage ".NET Core for Windows in build/dotnet"
dotnet=$PWD/build/dotnet/dotnetcore2/bin/dotnet.exe
[ -e "$dotnet" ] || quietly dotnet.log "$tools/bin/pip" --disable-pip-version-check install --target build/dotnet --platform win_amd64 --only-binary :all: --no-deps \
    dotnetcore2==3.1.23 || stop "could not fetch .NET Core; full text: build/dotnet.log"

build_for windows-x64 "-DCMAKE_CROSSCOMPILING_EMULATOR=$wine" "-DPBMPM_DOTNET=$dotnet"
built=build/windows-x64

stage "Running under Wine"
# Wine's folder has a link to /, so it cannot lie among the sources.
export WINEDEBUG=-all WINEPREFIX="${XDG_CACHE_HOME:-$HOME/.cache}/pbmpm/wine" WINEPATH="$PWD/$built/lib"
mkdir -p "$WINEPREFIX"
"$wine" wineboot -i >/dev/null 2>&1
# One at a time: under Wine threads that wait for each other cost those of other tests dearly.
ctest --test-dir $built --output-on-failure -R "${PBMPM_TESTS:-^(api_|unit_|csharp|samples)}" -E '\.(sse4|avx512)$'
for round in $(seq 50); do
    "$wine" $built/tests/api/leave.exe >/dev/null || stop "a process that ends with threads at work failed in round $round"
done
echo "50 processes ended with threads at work"
for isa in sse4 avx2 avx512; do
    PBMPM_ISA=$isa compare_hashes 60 $linux "$wine $built/tests/hashes.exe"
done
