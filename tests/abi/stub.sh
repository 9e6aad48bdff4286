#!/bin/sh
# stub.sh HEADER EDIT OUTPUT - writes the C source of a library that has the functions of a kept header and does nothing: what abidiff compares
# with. EDIT: a sed script that is applied to the header first.
set -eu
sed -f "$2" "$1" >"$3.h"
{
    cat "$3.h"
    sed -n '/^typedef/!s/^\([^ ].*[ *]pbmpm_[a-z_0-9]*(.*)\);$/\1 { __builtin_trap(); }/p' "$3.h"
} >"$3"
