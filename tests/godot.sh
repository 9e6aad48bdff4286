#!/bin/sh
# godot.sh [LIBRARY] - builds the Godot plugin, plays its samples in a real Godot 3 under Xvfb, and looks at how they end. Leaves pictures and logs in build/godot.
# LIBRARY: build/tests/lib/libpbmpm.so or build/release/lib/libpbmpm.so unless given.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
{ has godot3 && has xvfb-run && has c++; } || install_optional "the samples in Godot can not be played" godot3 xvfb xauth libgl1-mesa-dri g++
has godot3 || stop "Godot 3 is missing"

library=${1:-}
for built in build/tests/lib/libpbmpm.so build/release/lib/libpbmpm.so; do
    [ -n "$library" ] || [ ! -f "$built" ] || library=$built
done
[ -n "$library" ] || stop "there is no library; build one: cmake --workflow --preset demo"
stage "Building the plugin with $library"
sh bindings/godot/build.sh "$library"

passed=0 failed=0
out=$PWD/build/godot
rm -rf "$out"
mkdir -p "$out"

# play NAME ARGUMENT...: runs Godot, and looks at what NAME says of itself.
play() {
    name=$1; shift
    stage "Playing $name"
    PBMPM_PLAY=$out HOME=$out LC_ALL=C.UTF-8 timeout 600 xvfb-run -a -s "-screen 0 1280x720x24" godot3 --path bindings/godot --audio-driver Dummy --fixed-fps 60 "$@" \
        >"$out/$name.log" 2>&1 || echo "SCRIPT ERROR: it ended with an error" >>"$out/$name.log"
    grep -i "^$name: " "$out/$name.log" || true
    if grep -qi "^$name: as expected" "$out/$name.log" && ! grep -qE "SCRIPT ERROR|FAILED" "$out/$name.log"; then
        passed=$((passed + 1))
    else
        tail -n 20 "$out/$name.log"
        failed=$((failed + 1))
    fi
}
play faults -s res://tests/faults.gd
for sample in drink raft sandbox; do
    play $sample "res://samples/$sample.tscn"
    ! grep -q "pbmpm: " "$out/$sample.log" || stop "the library refused something; full text: build/godot/$sample.log"
done
ls "$out"/*.png
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ]
