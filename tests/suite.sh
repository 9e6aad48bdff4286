# suite.sh - what run.sh and long.sh have in common. Sourced after samples/setup.sh.
#
#   run_tests PRESET MARKED      builds, runs the C tests of CMake's PRESET and the Python tests that pytest calls MARKED, and counts them

run_tests() {
    library=build/tests/lib/libpbmpm.so
    c_report=build/$1/ctest.xml python_report=build/$1/pytest.xml
    rm -f "$c_report" "$python_report"

    stage "Building the library and running the C tests"
    cmake --workflow --preset "$1" || [ -f "$c_report" ] || stop "the build failed"

    make_environment $library test
    stage "Running the Python tests"
    build/venv/bin/python -m pytest -q -n auto --dist worksteal -m "$2" --junitxml "$python_report" tests/python tests/field || true

    stage "Result"
    build/venv/bin/python tests/count_tests.py "$c_report" "$python_report"
}
