#!/bin/sh
# imports.sh NM LIBRARY - a strict build takes no function from the C library that CPUs round differently: see src/base/strict_math.h. acos is
# in what advice says alone.
set -eu
wrong=$("$1" -D --undefined-only "$2" | sed 's/.* U //; s/@.*//' |
    grep -Ex '((exp|log|pow|sin|cos|tan|atan|asin|cbrt|hypot|erf|tgamma|lgamma)[a-z0-9]*|fmaf?)' || true)
[ -z "$wrong" ] || { echo "the library asks the C library for: $wrong"; exit 1; }
echo "nothing that CPUs round differently"
