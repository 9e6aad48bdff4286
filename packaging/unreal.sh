#!/bin/sh
# unreal.sh LIBRARY... - leaves dist/Pbmpm-unreal-VERSION.zip, the plugin for Unreal with the given libraries: one that ends in .so (Linux), one that ends in .dll
# (Windows), or both. A DLL needs an import library for Unreal's linker, which LLVM's dlltool makes of the list of exports.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
[ $# -gt 0 ] || stop "name the libraries: sh packaging/unreal.sh build/release/lib/libpbmpm.so build/windows-x64/lib/pbmpm.dll"

number() { sed -n "s/^#define PBMPM_VERSION_$1 //p" include/pbmpm/version.h; }
version=$(number MAJOR).$(number MINOR).$(number PATCH)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
plugin=$work/Pbmpm
library=$plugin/Source/ThirdParty/PbmpmLibrary
binaries=$plugin/Binaries/ThirdParty/PbmpmLibrary

stage "The plugin for Unreal, $version"
cp -R bindings/unreal/Pbmpm "$plugin"
cp bindings/unreal/README.md LICENSE "$plugin"
mkdir -p "$library/include"
cp -R include/pbmpm bindings/engine/include/pbmpm_engine "$library/include"
for file; do
    [ -f "$file" ] || stop "there is no $file"
    case $file in
    *.so)
        mkdir -p "$binaries/Linux"
        cp -L "$file" "$binaries/Linux/libpbmpm.so.$(sed -n 's/^#define PBMPM_ABI_VERSION //p' include/pbmpm/version.h)" ;;
    *.dll)
        mkdir -p "$binaries/Win64" "$library/lib/Win64"
        cp -L "$file" "$binaries/Win64/pbmpm.dll"
        dlltool=$(command -v llvm-dlltool-19 || command -v llvm-dlltool) || stop "LLVM's dlltool is missing; as an administrator type: apt-get install llvm-19"
        { echo "LIBRARY pbmpm.dll"; echo EXPORTS; cat src/api/exports.txt; } >"$work/pbmpm.def"
        "$dlltool" -m i386:x86-64 -d "$work/pbmpm.def" -D pbmpm.dll -l "$library/lib/Win64/pbmpm.lib" ;;
    *) stop "$file ends in neither .so nor .dll" ;;
    esac
done
mkdir -p dist
archive=$PWD/dist/Pbmpm-unreal-$version.zip
rm -f "$archive"
(cd "$work" && python3 -m zipfile -c "$archive" Pbmpm)
ls -l "$archive"
