#!/bin/sh
# use_pkg_config.sh PREFIX COMPILER SOURCE VERSION - builds SOURCE with the flags of the installed .pc file and runs it.
set -eu
command -v pkg-config >/dev/null 2>&1 || { echo "skipped: pkg-config is not installed (package pkgconf)"; exit 77; }
pc=$(find "$1" -name pbmpm.pc)
PKG_CONFIG_PATH=$(dirname "$pc"); export PKG_CONFIG_PATH
found=$(pkg-config --modversion pbmpm)
[ "$found" = "$4" ] || { echo "pkg-config says version $found, not $4"; exit 1; }
program=$1/tank-by-pkg-config
# Unquoted on purpose: the flags are several words.
"$2" "$3" -o "$program" $(pkg-config --cflags --libs pbmpm)
LD_LIBRARY_PATH=$(pkg-config --variable=libdir pbmpm) "$program"
