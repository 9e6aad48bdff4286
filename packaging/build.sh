#!/bin/sh
# build.sh [TARGET...] - all packages in dist/, from a fresh clone: the library for each target (library.sh), Python's sources and wheels (wheel.sh), the
# packages for Unity and Unreal, and SHA256SUMS. Targets: windows-x64, linux-x64, linux-arm64, macos-x64, macos-arm64, web, or none: all of them.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
. packaging/tools.sh
install_build_tools
[ $# -gt 0 ] || set -- $all_targets
sh packaging/library.sh "$@"
sh packaging/wheel.sh "$@"
[ ! -e packaging/unity.sh ] || sh packaging/unity.sh
if [ -e packaging/unreal.sh ]; then
    libraries=$(for target; do case $target in linux-x64 | windows-x64) library_of "$target" ;; esac; done)
    # shellcheck disable=SC2086 # one word per library
    sh packaging/unreal.sh $libraries
fi

stage "Checking"
sh packaging/check.sh "$@"
(cd dist && rm -f SHA256SUMS && sha256sum -- * >SHA256SUMS && cat SHA256SUMS)
