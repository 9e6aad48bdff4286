#!/bin/sh
# wheel.sh - the Python packages: builds the sources and the wheels (packaging/wheel.sh), looks into each, installs this machine's where there is no compiler,
# and the sources and the checkout by pip with this machine's compiler; with all the README's example runs. 20 minutes, so run by hand. PBMPM_BUILT=1: dist/ is
# there (packaging/build.sh).
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

if [ -z "${PBMPM_BUILT:-}" ]; then
    sh packaging/library.sh
    sh packaging/wheel.sh
fi
. packaging/tools.sh
wheel=$(ls dist/pbmpm-*-py3-none-"$(python_platform linux-x64)".whl)

stage "What the wheels hold"
for target in $all_targets; do
    [ "$target" != web ] || continue
    for one in dist/pbmpm-*-py3-none-"$(python_platform "$target")".whl; do
        python3 -m zipfile -l "$one" >"$work/files"
        for file in "pbmpm/$(basename "$(library_of "$target")") " pbmpm/_ffi.py pbmpm/py.typed 'licenses/LICENSE'; do
            grep -q "$file" "$work/files" || stop "$one has no $file"
        done
        ! grep -E '\.(a|h|c|ispc|pyc) ' "$work/files" || stop "$one holds what a program does not need"
        python3 -m zipfile -e "$one" "$work/$target"
        cmp "$work/$target/pbmpm/$(basename "$(library_of "$target")")" "$(library_of "$target")" || stop "$one holds another library than was built"
        grep -x "Tag: py3-none-$(python_platform "$target")" "$work/$target"/*.dist-info/WHEEL || stop "$one has another tag than its name"
    done
done

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

stage "The sources, by pip"
python3 -m venv "$work/from-sources"
"$work/from-sources/bin/pip" -q --disable-pip-version-check install dist/pbmpm-"$(version)".tar.gz || stop "the sources do not install"
example "$work/from-sources"
echo "the wheel, pip install . and the sources work"
