#!/bin/sh
# with_compiler.sh COMPILER ROOT LIBRARY FOLDER - builds the test of the layer for engines in FOLDER as engines build: without exceptions and RTTI. Then runs it.
set -eu
compiler=$1 root=$2 library=$3 folder=$4
mkdir -p "$folder"
LD_LIBRARY_PATH=$(dirname "$library"); export LD_LIBRARY_PATH
"$compiler" -std=c++17 -fno-exceptions -fno-rtti -O1 -Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -pedantic -Werror \
    "-I$root/include" "-I$root/bindings/engine/include" "$root/tests/engine/test_engine.cpp" "$library" -o "$folder/test_engine"
"$folder/test_engine"
