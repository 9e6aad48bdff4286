#!/bin/sh
# demo.sh - from a fresh clone to pictures: sets up, builds, runs a dam break in 2D and one with elastic blocks in 3D,
# and compares the first with the experiment of Martin and Moyce. Pictures: build/demo/*.png
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh

install_build_tools
stage "Building the library"
cmake --workflow --preset demo
make_environment build/release/lib/libpbmpm.so
pbmpm=build/venv/bin/pbmpm
mkdir -p build/demo

stage "Done: pictures are in build/demo"
ls build/demo/*.png
