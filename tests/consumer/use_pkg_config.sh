#!/bin/sh
# use_pkg_config.sh PREFIX COMPILER SOURCE VERSION MATERIALS [WORD...] - builds SOURCE with the flags of the installed .pc file and runs it with
# the words.
set -eu
prefix=$1 compiler=$2 source=$3 version=$4 built=$5
shift 5
command -v pkg-config >/dev/null 2>&1 || { echo "skipped: pkg-config is not installed (package pkgconf)"; exit 77; }
PKG_CONFIG_PATH=$(dirname "$(find "$prefix" -name pbmpm.pc)"); export PKG_CONFIG_PATH
found=$(pkg-config --modversion pbmpm)
[ "$found" = "$version" ] || { echo "pkg-config says version $found, not $version"; exit 1; }
materials=$(pkg-config --variable=materials pbmpm)
[ "$materials" = "$built" ] || { echo "pkg-config says materials $materials"; exit 1; }
program=$prefix/by-pkg-config
flags=$(pkg-config --cflags --libs pbmpm)
(eval "set -- $flags" && "$compiler" "$source" -o "$program" "$@" -lm) # pkg-config quotes blanks for the shell
LD_LIBRARY_PATH=$(dirname "$PKG_CONFIG_PATH") "$program" "$@"
