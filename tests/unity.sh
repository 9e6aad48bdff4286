#!/bin/sh
# unity.sh [FRAMES] - the Unity package without Unity: its layout, its shaders, its own tests, its samples, and FRAMES (1000) frames of a scene, which must
# make no garbage and come to the state that the C# binding comes to. The engine is a stand-in (tests/unity). Needs build/tests (tests/run.sh). Minutes.
# PBMPM_CSC names another C# compiler than mcs, PBMPM_MONO another run time than mono.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
frames=${1:-1000}
{ has mcs && has mono; } || install_optional "nothing is compiled" mono-mcs mono-runtime
has glslangValidator || install_optional "shaders are not parsed" glslang-tools
library=$PWD/build/tests/lib
[ -e "$library/libpbmpm.so" ] || stop "there is no $library/libpbmpm.so: cmake --preset tests && cmake --build --preset tests"

work=$PWD/build/unity
rm -rf "$work"
mkdir -p "$work"
stage "The package"
python3 packaging/unity.py assemble "$work/package"
python3 tests/unity/validate.py
python3 tests/unity/validate.py "$work/package"
if has glslangValidator; then python3 tests/unity/shaders.py "$work/package/Runtime/Resources/Pbmpm"; fi

stage "Compiling"
python3 tests/unity/compile.py "$work/package" "$work/bin"

play() { program=$work/bin/$1; shift; LD_LIBRARY_PATH=$library ${PBMPM_MONO:-mono --debug} "$program" "$@"; }
stage "The package's tests"
play RunTests.exe
stage "Frames"
play Frames.exe "$frames"
play Frames.exe "$frames" background
play Frames.exe 100 litter && stop "garbage of the frames was not seen"
stage "Play, stop and play again, with and without a reload"
play Reload.exe
stage "Samples"
play Samples.exe 120
