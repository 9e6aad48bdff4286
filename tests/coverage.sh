#!/bin/sh
# coverage.sh [--python] - builds src with counters, runs the C tests (and with --python those of Python), and prints which share of lines and
# branches of each file ran, and every line that did not, with its reason from coverage_reasons.txt. The exit status is 1 when less than
# 97 % of the lines ran, or a test failed.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh

install_build_tools
has gcov || install_optional "there is no coverage" gcc
make_coverage_environment() {
    build/coverage-venv/bin/gcovr --version >/dev/null 2>&1 && return
    stage "gcovr in build/coverage-venv"
    quietly coverage-venv.log python3 -m venv --clear build/coverage-venv || stop "could not make a Python environment"
    quietly coverage-pip.log build/coverage-venv/bin/pip --disable-pip-version-check install "gcovr>=8.3" || stop "could not install gcovr; full text: build/coverage-pip.log"
}
make_coverage_environment

stage "Building and running the C tests"
cmake --preset coverage -DCMAKE_C_COMPILER=gcc && cmake --build --preset coverage || stop "the build failed"
find build/coverage -name '*.gcda' -delete
failed=0
ctest --preset coverage || failed=1
if [ "${1:-}" = --python ]; then
    make_environment build/coverage/lib/libpbmpm.so test
    stage "Running the Python tests"
    build/venv/bin/python -m pytest -q -n auto --dist worksteal tests/python || failed=1
fi

stage "Coverage of src"
build/coverage-venv/bin/gcovr --root . --filter src/ --object-directory build/coverage --merge-mode-functions separate --gcov-suspicious-hits-threshold 0 \
    --json build/coverage/coverage.json build/coverage/src
python3 tests/coverage_report.py build/coverage/coverage.json tests/coverage_reasons.txt || failed=1
exit $failed
