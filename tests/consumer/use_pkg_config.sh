#!/bin/sh
# use_pkg_config.sh PREFIX COMPILER SOURCE VERSION - builds SOURCE with the flags of the installed .pc file and runs it.
set -eu
prefix=$1 compiler=$2 source=$3 version=$4
command -v pkg-config >/dev/null 2>&1 || { echo "skipped: pkg-config is not installed (package pkgconf)"; exit 77; }
library=$(find "$prefix" -name libpbmpm.so)
PKG_CONFIG_PATH=$(dirname "$library")/pkgconfig; export PKG_CONFIG_PATH
found=$(pkg-config --modversion pbmpm)
[ "$found" = "$version" ] || { echo "pkg-config says version $found, not $version"; exit 1; }
materials=$(pkg-config --variable=materials pbmpm)
[ "$materials" = "liquid elastic sand visco" ] || { echo "pkg-config says materials $materials"; exit 1; }
program=$prefix/minimal-by-pkg-config
eval "set -- $(pkg-config --cflags --libs pbmpm)" # pkg-config quotes blanks for the shell
"$compiler" "$source" -o "$program" "$@"
LD_LIBRARY_PATH=$(dirname "$library") "$program"
