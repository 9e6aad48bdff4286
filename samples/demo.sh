#!/bin/sh
# demo.sh - from a fresh clone to pictures: sets up, builds, runs a dam break in 2D, one with elastic blocks in 3D and some
# scenes at the pace of a game, and compares the first with the experiment of Martin and Moyce. Pictures: build/demo/*.png
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
takes_no_arguments "$@"

install_build_tools
stage "Building the library"
cmake --workflow --preset demo
make_environment build/release/lib/libpbmpm.so lab
pbmpm=build/venv/bin/pbmpm
mkdir -p build/demo

stage "Dam break in 2D"
$pbmpm run samples/scenes/dam_break_2d.json --output build/demo

stage "Dam break with elastic blocks in 3D"
$pbmpm run samples/scenes/dam_break_blocks_3d.json --output build/demo

for scene in glass_jelly_3d water_wheel_2d hourglass_2d boat_2d jelly_tower_2d tiled_level_2d; do
    stage "At the pace of a game: $scene"
    $pbmpm run samples/scenes/$scene.json --output build/demo
done

stage "Dam break against the experiment of Martin and Moyce (1952)"
status=0
$pbmpm accuracy dam-break --quick --chart build/demo || status=$?
[ $status -le 1 ] || exit $status # 1: some setting was not stable, as the table says

stage "Done: pictures are in build/demo"
ls build/demo/*.png
