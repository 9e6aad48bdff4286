#!/bin/sh
# build.sh LIBRARY - builds the plugin against a shared library of pbmpm, and leaves both in addons/pbmpm/bin. Needs a C++ compiler and nothing of Godot's.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$here/../..
library=$1
bin=$here/addons/pbmpm/bin
mkdir -p "$bin"
cp -L "$library" "$bin/libpbmpm.so.1"
"${CXX:-c++}" -std=c++17 -O2 -fPIC -shared -fvisibility=hidden -Wall -Wextra -Werror "-I$root/include" "-I$root/bindings/engine/include" \
    "$here/native/pbmpm_godot.cpp" "$bin/libpbmpm.so.1" -Wl,-rpath,'$ORIGIN' -o "$bin/libpbmpm_godot.so"
