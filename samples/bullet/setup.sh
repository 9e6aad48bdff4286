#!/bin/sh
# Makes .venv beside this file, with pbmpm and pybullet. PBMPM_LIBRARY names the built library (default: build/lib).
set -eu
here=$(cd "$(dirname "$0")" && pwd)
root=$(cd "$here/../.." && pwd)
export PBMPM_LIBRARY="${PBMPM_LIBRARY:-$root/build/lib/libpbmpm.so}"
test -e "$PBMPM_LIBRARY" || { echo "setup.sh: build the library first, or set PBMPM_LIBRARY" >&2; exit 2; }
python3 -m venv "$here/.venv"
"$here/.venv/bin/pip" install --quiet "$root" pybullet
