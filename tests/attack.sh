#!/bin/sh
# attack.sh [SECONDS] - the long form of what run.sh and sanitize.sh do in short: coverage of src, every allocation refused, each fuzz target and damaged
# scene files for so long (3 h), and 100 faults planted in the sources. Takes hours; what was found and counted is in build/coverage, build/fuzz and build/mutants.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
seconds=${1:-10800}
failed=0
sh tests/coverage.sh --python || failed=1
stage "Every allocation refused"
build/coverage/tests/api/api_no_memory all || failed=1
sh tests/fuzz.sh "$seconds" || failed=1
stage "Damaged scene files for $seconds s"
build/venv/bin/python tests/fuzz/scenes.py --seconds "$seconds" || failed=1
stage "Faults planted in the sources"
sh tests/mutants.sh --count 100 --python || failed=1
exit $failed
