#!/bin/sh
# compare.sh PROGRAM [STEPS [SCENE]] - runs the scenes of hashes.c with the kernels of each instruction set that this CPU has, and says where their
# hashes differ: 1 if they do, 77 if there is only one set. 1,000 steps take minutes; the default is for the test suite.
set -eu
program=$1 steps=${2:-20} scene=${3:-}
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
compared=0
for isa in sse4 avx2 avx512; do
    PBMPM_ISA=$isa "$program" "$steps" "$scene" >"$folder/$isa"
    name=$(sed -n '1s/kernels: \([^,]*\),.*/\1/p' "$folder/$isa")
    [ -n "$name" ] || { echo "$program does not tell its kernels"; exit 1; }
    sed 1d "$folder/$isa" >"$folder/hashes"
    case $isa:$name in
    sse4:*) cat "$folder/$isa" && mv "$folder/hashes" "$folder/first" ;;
    avx2:AVX2 | avx512:AVX-512)
        diff "$folder/first" "$folder/hashes" || { echo "SSE4 and $name differ"; exit 1; }
        compared=$((compared + 1)) && echo "SSE4 and $name are equal" ;;
    *) echo "this CPU has no $isa" ;;
    esac
done
[ $compared -gt 0 ] || exit 77
