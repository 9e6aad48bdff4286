#!/bin/sh
# mutants.sh [OPTION...] - plants faults in src and ispc, one at a time, and lists those that no test finds; see mutants/mutate.py --help. It
# takes hours, can be stopped, and goes on where it was.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh

install_build_tools
case " $* " in *" --python "*) [ -f build/tests/lib/libpbmpm.so ] || cmake --workflow --preset demo; make_environment build/$([ -f build/tests/lib/libpbmpm.so ] && echo tests || echo release)/lib/libpbmpm.so test ;; esac
exec python3 tests/mutants/mutate.py "$@"
