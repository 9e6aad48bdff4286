#!/bin/sh
# with_compiler.sh COMPILER ROOT LIBRARY FOLDER - builds the test of the C++ header and the C++ sample in FOLDER, and runs them. The test is built twice:
# optimised, as the newest C++ that the compiler knows; and as a host without exceptions and RTTI does it. Warnings are errors.
set -eu
compiler=$1 root=$2 library=$3 folder=$4
tests=$root/tests/cpp
mkdir -p "$folder"
warnings="-Wall -Wextra -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -pedantic -Werror"
LD_LIBRARY_PATH=$(dirname "$library"); export LD_LIBRARY_PATH

newest=c++17
for standard in c++20 c++23; do
    echo | "$compiler" -std=$standard -x c++ -fsyntax-only - 2>/dev/null && newest=$standard
done

# build_and_run FLAG...
build_and_run() {
    "$compiler" "$@" $warnings "-I$root/include" -c "$tests/test_cpp.cpp" -o "$folder/test_cpp.o"
    "$compiler" "$folder/test_cpp.o" "$folder/scene_in_c.o" "$library" -o "$folder/test_cpp"
    "$folder/test_cpp"
}
"$compiler" -x c -std=c17 "-I$root/include" -c "$tests/scene_in_c.c" -o "$folder/scene_in_c.o"
build_and_run -std=$newest -O2 -DNDEBUG
build_and_run -std=c++17 -fno-exceptions -fno-rtti
"$compiler" -std=c++17 $warnings "-I$root/include" "$root/samples/pour.cpp" "$library" -o "$folder/pour"
"$folder/pour"
