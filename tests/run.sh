#!/bin/sh
# run.sh - all tests from a fresh clone: sets up, builds, runs the C tests with CTest and the Python tests with pytest.
# The last line counts them; the exit status is 0 when none failed.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
takes_no_arguments "$@"

install_build_tools
has pkg-config || install_optional "the test of the pkg-config file is skipped" pkgconf
has qemu-x86_64 || install_optional "the test on emulated old CPUs is skipped" qemu-user
has valgrind || install_optional "the tests of what unused effects cost are skipped" valgrind
has abidiff || install_optional "the comparison of binary interfaces is skipped" abigail-tools
has g++ || install_optional "the tests of the C++ header with gcc are skipped" g++
{ has mcs && has mono; } || install_optional "the C# tests are skipped" mono-mcs mono-runtime

stage "Building the library and running the C tests"
library=build/tests/lib/libpbmpm.so
rm -f build/tests/ctest.xml build/pytest.xml
cmake --workflow --preset tests || [ -f build/tests/ctest.xml ] || stop "the build failed"

make_environment $library test
stage "Running the Python tests"
build/venv/bin/python -m pytest -q -n auto --dist worksteal --junitxml build/pytest.xml tests/python tests/field || true

stage "Result"
build/venv/bin/python tests/count_tests.py build/tests/ctest.xml build/pytest.xml
