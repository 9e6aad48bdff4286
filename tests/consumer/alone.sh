#!/bin/sh
# alone.sh PROGRAM - whether a program runs without the shared library: it holds the static one.
set -eu
needs=$(ldd "$1")
case $needs in
    *libpbmpm*) echo "$1 needs the shared library: $needs"; exit 1 ;;
esac
"$1"
