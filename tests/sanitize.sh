#!/bin/sh
# sanitize.sh - builds and runs the C tests under the sanitizers: addresses and undefined behaviour, then threads.
# With Clang 19 the kernels are checked too, otherwise the C code alone.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh

install_build_tools
has clang-19 || install_optional "the sanitizers do not see inside the kernels" clang-19 libclang-rt-19-dev llvm-19
failed=0
for preset in asan tsan; do
    stage "Sanitizer preset $preset"
    cmake --workflow --preset $preset || failed=1
done
exit $failed
