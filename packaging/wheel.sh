#!/bin/sh
# wheel.sh - leaves dist/pbmpm-VERSION.tar.gz, the sources that pip builds, and from them dist/pbmpm-VERSION-py3-none-manylinux_2_28_x86_64.whl.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
. packaging/tools.sh
platform=manylinux_2_28_x86_64
make_tools
# The platform is named after the oldest C library that its wheels run with. This machine's is newer; zig links against any.
compiler=$(write_compiler x86_64-linux-gnu.2.28)

stage "Building the sources and the wheel"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
rm -f dist/pbmpm-*.tar.gz dist/pbmpm-*"$platform".whl
unset PBMPM_LIBRARY
CC=$compiler quietly packaging-build.log "$tools/bin/python" -m build --outdir "$work" . || stop "the build failed; full text: build/packaging-build.log"
# auditwheel looks whether the library needs no more than the platform has.
PATH=$tools/bin:$PATH quietly packaging-repair.log "$tools/bin/auditwheel" repair --only-plat --plat "$platform" --wheel-dir "$work/repaired" "$work"/*.whl ||
    stop "the wheel needs more than $platform has; full text: build/packaging-repair.log"
mkdir -p dist
mv "$work"/*.tar.gz "$work"/repaired/*.whl dist
ls -l dist
