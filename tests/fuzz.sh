#!/bin/sh
# fuzz.sh [SECONDS|keep [TARGET...]] - builds the fuzz targets with Clang's libFuzzer and the sanitizers for addresses and undefined behaviour, and runs
# each for so long (60); several at once where there are cores. What they find stays in build/fuzz/work; the corpus grows there from run to run. The last
# lines count the executions. Inputs that broke something belong into tests/fuzz/corpus/TARGET, where every test run tries them; "keep" puts there what of
# the corpus reaches code that nothing else in the tree does, up to 90 kB per target. What it holds of snapshots and calls means less once their layout
# changes.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh

install_build_tools
has clang-19 || install_optional "fuzzing needs it" clang-19 libclang-rt-19-dev llvm-19
has clang-19 || has clang || stop "there is no Clang"
seconds=${1:-60}
[ $# -eq 0 ] || shift
stage "Building the fuzz targets"
cmake --preset fuzz && cmake --build --preset fuzz || stop "the build failed"
[ $# -gt 0 ] || set -- $(cd tests/fuzz && ls fuzz_*.c | sed 's/\.c$//')

cores=$(getconf _NPROCESSORS_ONLN 2>/dev/null || echo 1)
at_once=$((cores / $# > 1 ? cores / $# : 1))
run_target() {
    work=build/fuzz/work/$1
    mkdir -p "$work/seeds" "$work/corpus"
    build/fuzz/tests/fuzz/"$1" --seeds "$work/seeds"
    given=$(ls -d tests/fuzz/corpus/"$1" 2>/dev/null || true)
    rm -f "$work"/run.*.log
    i=0
    while [ $i -lt $at_once ]; do
        # shellcheck disable=SC2086 # no folder, or one without blanks
        build/fuzz/tests/fuzz/"$1" -max_total_time="$seconds" -timeout=60 -max_len=8192 -len_control=10 -reload=1 -print_final_stats=1 -artifact_prefix="$work/" \
            "$work/corpus" "$work/seeds" $given >"$work/run.$i.log" 2>&1 &
        i=$((i + 1))
    done
}

# What reaches code that neither seeds nor kept inputs do, the largest first, which do most, while there is room.
keep_some() {
    work=build/fuzz/work/$1 kept=tests/fuzz/corpus/$1 room=90000
    rm -rf "$work/merged" && mkdir -p "$kept" "$work/merged" "$work/corpus" "$work/seeds"
    build/fuzz/tests/fuzz/"$1" --seeds "$work/seeds"
    find "$kept" "$work/seeds" -type f -exec cp -t "$work/merged" {} +
    build/fuzz/tests/fuzz/"$1" -set_cover_merge=1 "$work/merged" "$work/corpus" 2>&1 | tail -n 1
    room=$((room - $(cat "$kept"/* 2>/dev/null | wc -c)))
    for input in $(ls -S "$work/merged"); do
        size=$(wc -c <"$work/merged/$input")
        [ ! -e "$kept/$input" ] && [ ! -e "$work/seeds/$input" ] && [ "$size" -le $room ] || continue
        cp "$work/merged/$input" "$kept" && room=$((room - size))
    done
    echo "$1: $(ls "$kept" | wc -l) inputs of $(cat "$kept"/* | wc -c) bytes are kept"
}

if [ "$seconds" = keep ]; then
    for target in "$@"; do keep_some "$target"; done
    exit 0
fi
stage "Fuzzing for $seconds s: $*"
for target in "$@"; do run_target "$target"; done
wait
failed=0 total=0
for target in "$@"; do
    work=build/fuzz/work/$target
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$work"/run.*.log | awk '{ sum += $1 } END { printf "%d", sum }')
    total=$((total + runs))
    echo "$target: $runs executions, $(ls "$work/corpus" | wc -l) inputs in the corpus"
    for artifact in "$work"/crash-* "$work"/leak-* "$work"/timeout-* "$work"/oom-*; do
        [ -e "$artifact" ] || continue
        echo "    found: $artifact" && failed=1
    done
    grep -hE '^SUMMARY|does not hold' "$work"/run.*.log | sed 's/^/    /' || true
done
echo "$total executions"
exit $failed
