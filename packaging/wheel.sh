#!/bin/sh
# wheel.sh TARGET... - leaves dist/pbmpm-VERSION.tar.gz, the sources that pip builds, and dist/pbmpm-VERSION-py3-none-PLATFORM.whl for each target, with the
# library of build/TARGET (packaging/library.sh makes it). Targets: windows-x64, linux-x64, linux-arm64, macos-x64, macos-arm64, or none: all of them.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
. packaging/tools.sh
need_llvm
make_tools
[ $# -gt 0 ] || set -- $all_targets
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p dist

stage "The sources"
unset PBMPM_LIBRARY
rm -f dist/pbmpm-"$(version)".tar.gz
quietly packaging-sdist.log "$tools/bin/python" -m build --sdist --outdir dist . || stop "the build failed; full text: build/packaging-sdist.log"

# The wheel under another platform's name: this machine's is no matter, for nothing in it was compiled here but the library.
tagged() { # WHEEL PLATFORM
    echo "$(dirname "$1")/$("$tools/bin/wheel" tags --remove --platform-tag "$2" "$1" | tail -n 1)"
}

# A wheel for Linux has to be named after the oldest C library that it runs with: auditwheel looks whether the library needs no more. Of other CPUs it knows
# nothing, so there the versions of the symbols are compared.
name_wheel() { # WHEEL TARGET
    case $2 in
    linux-x64)
        PATH=$tools/bin:$PATH "$tools/bin/auditwheel" repair --only-plat --plat "$(python_platform "$2")" --wheel-dir "$work/named" "$1"
        ;;
    linux-*)
        newest=$("$(llvm llvm-readelf)" --version-info "$(library_of "$2")" | grep -o 'GLIBC_[0-9.]*' | sort -uV | tail -n 1)
        printf '%s\n' "$newest" GLIBC_2.28 | sort -CV && mkdir -p "$work/named" && mv "$(tagged "$1" "$(python_platform "$2")")" "$work/named"
        ;;
    *)
        mkdir -p "$work/named" && mv "$(tagged "$1" "$(python_platform "$2")")" "$work/named"
        ;;
    esac
}

for target; do
    [ "$target" != web ] || continue
    stage "The wheel for $target"
    library=$(library_of "$target")
    [ -e "$library" ] || stop "there is no $library: sh packaging/library.sh $target"
    rm -rf "$work"/*
    PBMPM_LIBRARY=$library quietly packaging-wheel.log "$tools/bin/python" -m build --wheel --outdir "$work" . || stop "the build failed; full text: build/packaging-wheel.log"
    made=$(ls "$work"/*.whl)
    rm -f dist/*"$(python_platform "$target")".whl
    quietly packaging-repair.log name_wheel "$made" "$target" || stop "the wheel needs more than $(python_platform "$target") has; full text: build/packaging-repair.log"
    mv "$work"/named/*.whl dist
done
ls -l dist/*.whl dist/pbmpm-"$(version)".tar.gz
