#!/bin/sh
# use_pkg_config.sh NAME PREFIX COMPILER SOURCE VERSION MATERIALS [WORD...] - builds SOURCE with the flags of the installed NAME.pc and runs it with
# the words.
set -eu
name=$1 prefix=$2 compiler=$3 source=$4 version=$5 built=$6
shift 6
command -v pkg-config >/dev/null 2>&1 || { echo "skipped: pkg-config is not installed (package pkgconf)"; exit 77; }
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name "$name.pc")"); export PKG_CONFIG_PATH
found=$(pkg-config --modversion "$name")
[ "$found" = "$version" ] || { echo "pkg-config says version $found, not $version"; exit 1; }
materials=$(pkg-config --variable=materials "$name")
[ "$materials" = "$built" ] || { echo "pkg-config says materials $materials"; exit 1; }
program=$prefix/by-pkg-config-$name
flags=$(pkg-config --cflags --libs "$name")
(eval "set -- $flags" && "$compiler" "$source" -o "$program" "$@" -lm) # pkg-config quotes blanks for the shell
LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH") "$program" "$@"
