#!/bin/sh
# compare_runs.sh CLIENT FOLDER FOLDER - the client says the same with the library of each folder.
set -eu
one=$(LD_LIBRARY_PATH="$2" "$1")
other=$(LD_LIBRARY_PATH="$3" "$1")
echo "$one"
[ "$one" = "$other" ] || { printf 'with the other library:\n%s\n' "$other"; exit 1; }
