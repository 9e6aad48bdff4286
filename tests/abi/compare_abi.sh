#!/bin/sh
# compare_abi.sh same|broken ABIDIFF OLD NEW [SUPPRESSIONS] - whether a library keeps the binary interface of an older one.
# abidiff's exit status: 0 nothing that is not suppressed, 4 and above a change, less an error of its own.
set -u
status=0
"$2" ${5:+--suppressions "$5"} --no-added-syms "$3" "$4" || status=$?
case $1 in
same) [ $status -eq 0 ] ;;
broken) [ $status -ge 4 ] ;;
esac
