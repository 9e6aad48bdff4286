#!/bin/sh
# wheel.sh - the Python packages: builds the sources and the wheel (packaging/wheel.sh), installs the wheel where there is no compiler, and the
# checkout by `pip install .` with this machine's compiler; with both the README's example runs. 10 minutes, so run by hand.
set -eu
cd "$(dirname "$0")/.."
root=$PWD
. samples/setup.sh
unset PBMPM_LIBRARY
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

example() { # VENV: the README's example, away from the sources
    python3 -c "import re, sys; print(re.search(r'\`\`\`python\n(.*?)\`\`\`', open('$root/README.md', encoding='utf-8').read(), re.DOTALL)[1])" >"$work/example.py"
    said=$(cd "$work" && env -i "PATH=$1/bin" "$1/bin/python" example.py) || stop "the README's example fails in $1"
    echo "README's example: $said"
    # A column 0.5 m wide, 1 m high, falls apart: its middle sinks from 0.5 m. It has 4 particles in each cell of 0.05 m.
    python3 -c "import sys; count, height = sys.argv[1].split(); sys.exit(not (int(count) == 800 and 0 < float(height) < 0.5))" "$said" ||
        stop "the README's example prints $said"
}

sh packaging/wheel.sh
wheel=$(ls dist/pbmpm-*-py3-none-manylinux_2_28_x86_64.whl)

stage "What the wheel holds"
python3 -m zipfile -l "$wheel" >"$work/files"
for file in pbmpm/libpbmpm.so pbmpm/_ffi.py pbmpm/py.typed 'licenses/LICENSE'; do
    grep -q "$file" "$work/files" || stop "$wheel has no $file"
done
! grep -E '\.(a|h|c|ispc|pyc) ' "$work/files" || stop "$wheel holds what a program does not need"
grep -E 'lib|LICENSE' "$work/files"

stage "The wheel, without a compiler"
python3 -m venv "$work/from-wheel"
for tool in cc gcc clang cmake ninja ispc; do # of what is on the path of the next line
    [ ! -e "$work/from-wheel/bin/$tool" ] || stop "there is a $tool"
done
env -i "PATH=$work/from-wheel/bin" "$work/from-wheel/bin/pip" -q --disable-pip-version-check install --only-binary :all: "$root/$wheel" || stop "the wheel does not install"
example "$work/from-wheel"

stage "pip install ."
python3 -m venv "$work/from-checkout"
"$work/from-checkout/bin/pip" -q --disable-pip-version-check install . || stop "pip install . fails"
example "$work/from-checkout"
echo "the wheel and pip install . work"
