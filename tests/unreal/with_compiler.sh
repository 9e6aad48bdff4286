#!/bin/sh
# with_compiler.sh COMPILER ROOT LIBRARY FOLDER - compiles the Unreal plugin against the stubs beside this script, and runs it in a small stand-in for the engine.
# As in Unreal's unity builds all sources go into one.
set -eu
compiler=$1 root=$2 library=$3 folder=$4
source=$root/bindings/unreal/Pbmpm/Source
mkdir -p "$folder"
LD_LIBRARY_PATH=$(dirname "$library"); export LD_LIBRARY_PATH
python3 "$root/tests/unreal/generate.py" "$source" "$folder/generated"
for file in "$source"/*/Private/*.cpp "$root/tests/unreal/test_unreal.cpp"; do echo "#include \"$file\""; done >"$folder/unity.cpp"
"$compiler" -std=c++17 -Wall -Wextra -Wno-unused-parameter -Wshadow -Werror -pthread -DPBMPMRUNTIME_API= -DPBMPMNIAGARA_API= -DPBMPMSAMPLES_API= \
    "-I$root/tests/unreal/stubs" "-I$folder/generated" "-I$source/PbmpmRuntime/Public" "-I$source/PbmpmRuntime/Private" "-I$source/PbmpmNiagara/Public" \
    "-I$source/PbmpmSamples/Public" \
    -isystem "$root/include" -isystem "$root/bindings/engine/include" "$folder/unity.cpp" "$library" -o "$folder/test_unreal"
"$folder/test_unreal"
