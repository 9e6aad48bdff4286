#!/bin/sh
# emulated_cpus.sh QEMU PROGRAM - runs the minimal sample on emulated CPUs: one below SSE4.2 must get the error, not an illegal
# instruction; one with SSE4.2 and one with AVX2 must work.
set -u
qemu=$1 program=$2

refused=$("$qemu" -cpu Penryn "$program" 2>&1) && { echo "a CPU without SSE4.2 was not refused: $refused"; exit 1; }
case $refused in
*"this CPU has no SSE4.2"*) ;;
*) echo "a CPU without SSE4.2 got: $refused"; exit 1 ;;
esac
for cpu in Nehalem Haswell; do
    said=$("$qemu" -cpu $cpu "$program" 2>&1) || { echo "$cpu: $said"; exit 1; }
done
echo "Penryn refused, Nehalem and Haswell run"
