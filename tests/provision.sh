#!/bin/sh
# provision.sh CACHE - makes CACHE/unity, the sources of the Unity C test framework, from Debian's signed archive
# (the package cmock carries them). No root, no change of the system; a second call finds the first one's work.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
OTHER_WAY='get the sources of Unity (ThrowTheSwitch) yourself and configure with -DUNITY_SOURCE_DIR=/path/to/Unity'
. "$here/../ispc/debian_packages.sh"

open_cache "${1:?usage: provision.sh CACHE}"
[ -f "$CACHE/unity/src/unity.c" ] && exit 0
fetch_package alone cmock
[ -f "$NEW/root/usr/share/cmock/vendor/unity/src/unity.c" ] ||
    fail "the package cmock has no Unity inside: its layout has changed" "$OTHER_WAY"
mv "$NEW"/root/usr/share/cmock/vendor/unity/* "$NEW"
rm -rf "$NEW/root"
keep unity
say "Unity is in $CACHE/unity"
