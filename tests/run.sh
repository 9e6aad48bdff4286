#!/bin/sh
# run.sh - the tests from a fresh clone: sets up, builds, runs the C tests with CTest and the Python tests with pytest.
# Those marked long are left to long.sh. The last line counts tests; the exit status is 0 when none failed.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
. tests/suite.sh
takes_no_arguments "$@"

install_build_tools
has pkg-config || install_optional "the test of the pkg-config file is skipped" pkgconf
has abidiff || install_optional "the comparison of binary interfaces is skipped" abigail-tools
has g++ || install_optional "the tests of the C++ header with gcc are skipped" g++
{ has mcs && has mono; } || install_optional "the C# tests are skipped" mono-mcs mono-runtime
run_tests tests "not long"
