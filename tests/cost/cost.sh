#!/bin/sh
# cost.sh unused|memory|mixed|table VALGRIND COST REDUCED - compares what scenes of COST cost; REDUCED is the same program with a library
# that was built for liquids alone. Callgrind's counts of instructions do not depend on what else the machine does.
#
#   unused  liquids cost no more instructions in the full build than in theirs, and the same whether or not the world has everything else that it could use, unused
#   memory  ... and the same bytes
#   mixed   a block in a lake costs at most 5 % more than lake and block by themselves
#   table   nothing is compared: instructions of each material with each solver
set -eu
subject=$1 valgrind=$2 full=$3 reduced=$4
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0

# instructions PROGRAM WORD...: sets `step` to those of a step of 5 iterations, `more` to those of 5 more, and `figures` to both per particle
# and iteration.
instructions() {
    program=$1; shift
    rm -f "$folder"/*
    particles=$("$valgrind" --quiet --tool=callgrind --toggle-collect=measured_step --dump-after=measured_step \
        --callgrind-out-file="$folder/counts" "$program" steps "$@")
    step=$(awk '/^totals:/ { print $2 }' "$folder/counts.1")
    more=$(awk -v step="$step" '/^totals:/ { print $2 - step }' "$folder/counts.2")
    figures=$(echo "$step $more $particles" | awk '{ printf "%8.1f of a step, %7.1f of iterations", $1 / $3 / 5, $2 / $3 / 5 }')
}

# at_most PERCENT WHAT GOT WANTED: fails unless GOT differs from WANTED by at most so much; below it is always good if PERCENT begins with +.
at_most() {
    echo "$3 $4 $1" | awk -v what="$2" '{
        change = 100 * ($1 / $2 - 1)
        size = change < 0 && substr($3, 1, 1) != "+" ? -change : change
        printf "  %s: %+.2f %%, at most %s %%%s\n", what, change, $3, size <= $3 + 0 ? "" : "  FAILED"
        exit !(size <= $3 + 0) }' || failed=1
}

# like PERCENT WHAT STEP MORE: as `step` and `more` are now, to so much as at_most() takes. The explicit solver does not iterate.
like() {
    at_most "$1" "$2, step" "$3" "$step"
    [ "$more" -lt $((step / 100)) ] || at_most "$1" "$2, iterations" "$4" "$more"
}

unused() {
    for scene in "paper 2" "paper 3" "dual 3" "explicit 3"; do
        # shellcheck disable=SC2086 # two words
        instructions "$full" liquid $scene unused
        unused_step=$step unused_more=$more
        # shellcheck disable=SC2086
        instructions "$full" liquid $scene
        full_step=$step full_more=$more
        echo "liquid $scene: $figures"
        like 1 "with everything else, unused" "$unused_step" "$unused_more"
        # shellcheck disable=SC2086
        instructions "$reduced" liquid $scene
        like +1 "full build against liquids alone" "$full_step" "$full_more"
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
            echo "$matter $solver 3: $figures; $step in all"
            parts=$((parts + step))
        done
        instructions "$full" lake+block $solver 3
        echo "lake+block $solver 3: $figures; $step in all"
        at_most +5 "over its parts" "$step" "$parts"
    done
}

table() {
    echo "instructions per particle and iteration: of a step of 5 iterations with all that belongs to it, and of iterations by themselves"
    for matter in liquid elastic sand visco; do
        for solver in paper dual primal explicit; do
            for dimension in 2 3; do
                instructions "$full" $matter $solver $dimension
                printf '%-8s %-9s %sD %s\n' $matter $solver $dimension "$figures"
            done
        done
    done
}

$subject
exit $failed
