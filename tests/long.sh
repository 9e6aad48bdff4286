#!/bin/sh
# long.sh - the tests that run.sh leaves out: SSE4 and AVX-512, 3D hard cases, builds without some materials, emulated CPUs,
# what unused effects cost; then field cases on other instruction sets, and the sanitizers. An hour on two cores.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
. tests/suite.sh
takes_no_arguments "$@"

install_build_tools
has pkg-config || install_optional "the test of the pkg-config file is skipped" pkgconf
has qemu-x86_64 || install_optional "the test on emulated old CPUs is skipped" qemu-user
has valgrind || install_optional "the tests of what unused effects cost are skipped" valgrind
failed=0
run_tests long long || failed=1
for isa in sse4 avx2; do
    stage "Scenes of the field with $isa"
    PBMPM_ISA=$isa build/venv/bin/python -m pytest -q -n auto tests/field || failed=1
done
sh tests/sanitize.sh || failed=1
exit $failed
