#!/bin/sh
# cost.sh unused|memory|mixed|table VALGRIND COST REDUCED - compares what scenes of COST cost; REDUCED is the same program with a library
# that was built for liquids alone. Callgrind's counts of instructions do not depend on what else the machine does.
#
#   unused  liquids cost the same instructions in both builds, and whether or not the world has everything else that it could use, unused
#   memory  ... and the same bytes
#   mixed   a block in a lake costs at most 5 % more than lake and block by themselves
#   table   nothing is compared: instructions per particle-iteration of each material with each solver
set -eu
subject=$1 valgrind=$2 full=$3 reduced=$4
counts=$(mktemp)
trap 'rm -f "$counts"' EXIT
failed=0

# instructions PROGRAM WORD...: sets `total` to those of measured_steps(), `each` to those per particle-iteration.
instructions() {
    program=$1; shift
    work=$("$valgrind" --quiet --tool=callgrind --toggle-collect=measured_steps --callgrind-out-file="$counts" "$program" steps "$@")
    total=$(awk '/^(summary|totals):/ { print $2; exit }' "$counts")
    each=$(echo "$total ${work#* }" | awk '{ printf "%.2f", $1 / $2 }')
}

# at_most PERCENT WHAT GOT WANTED: fails unless GOT differs from WANTED by at most so much; below it is always good if PERCENT begins with +.
at_most() {
    echo "$3 $4 $1" | awk -v what="$2" '{
        change = 100 * ($1 / $2 - 1)
        size = change < 0 && substr($3, 1, 1) != "+" ? -change : change
        printf "  %s: %+.2f %%, at most %s %%%s\n", what, change, $3, size <= $3 + 0 ? "" : "  FAILED"
        exit !(size <= $3 + 0) }' || failed=1
}

unused() {
    for scene in "paper 2" "paper 3" "dual 3" "explicit 3"; do
        # shellcheck disable=SC2086 # two words
        instructions "$full" liquid $scene
        plain=$total
        echo "liquid $scene: $each instructions per particle-iteration"
        # shellcheck disable=SC2086
        instructions "$full" liquid $scene unused
        at_most 1 "with everything else, unused" "$total" "$plain"
        # shellcheck disable=SC2086
        instructions "$reduced" liquid $scene
        at_most 1 "full build against liquids alone" "$plain" "$total"
    done
}

memory() {
    for scene in "paper 2" "paper 3" "dual 2" "dual 3" "explicit 3"; do
        # shellcheck disable=SC2086
        plain=$("$full" memory liquid $scene)
        echo "liquid $scene: $plain bytes per particle"
        # shellcheck disable=SC2086
        at_most 0 "with everything else, unused" "$("$full" memory liquid $scene unused)" "$plain"
        # shellcheck disable=SC2086
        at_most 0 "full build against liquids alone" "$plain" "$("$reduced" memory liquid $scene)"
    done
}

mixed() {
    for solver in paper dual; do
        parts=0
        for matter in lake block; do
            instructions "$full" $matter $solver 3
            echo "$matter $solver 3: $total instructions, $each per particle-iteration"
            parts=$((parts + total))
        done
        instructions "$full" lake+block $solver 3
        echo "lake+block $solver 3: $total instructions, $each per particle-iteration"
        at_most +5 "over its parts" "$total" "$parts"
    done
}

table() {
    echo "instructions per particle-iteration"
    for matter in liquid elastic; do
        for solver in paper dual primal explicit; do
            for dimension in 2 3; do
                instructions "$full" $matter $solver $dimension
                printf '%-8s %-9s %sD %9s\n' $matter $solver $dimension "$each"
            done
        done
    done
}

$subject
exit $failed
