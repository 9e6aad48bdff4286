#!/bin/sh
# web.sh - a strict build of the library for WebAssembly, and one for this machine: the hashes of the scenes have to be equal, but for one that differs from
# its fifth step on: it stops by its error, which differs (docs/platforms.md). Runs in Node 20 or newer.
# 10 minutes, so run by hand.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
. packaging/tools.sh
. tests/emulated.sh
node=$(need_tool node nodejs)
"$node" -e 'process.exit(parseInt(process.versions.node) < 20 ? 1 : 0)' || stop "Node 20 or newer is needed; this is $("$node" --version)"
need_llvm
make_tools
strict_build linux-x64
strict_build web
built=build/strict-web
"$tools/bin/cc-wasm32-wasi" -O2 -msimd128 -DPBMPM_STATIC -Iinclude -Isrc tests/strict/hashes.c $built/lib/libpbmpm.a -lwasi-emulated-getpid \
    -Wl,-z,stack-size=8388608 -o $built/hashes.wasm
PBMPM_ISA=sse4 compare_hashes 20 build/strict-linux-x64/tests/hashes "$node --no-warnings tests/web.mjs $built/hashes.wasm" convergent_tap_2d
