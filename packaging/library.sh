#!/bin/sh
# library.sh TARGET... - leaves dist/pbmpm-VERSION-TARGET.zip (Windows) or .tar.gz: the library, shared and static, headers, the CMake package and the
# licence. Targets: windows-x64, linux-x64, linux-arm64, macos-x64, macos-arm64, web (static alone), or
# none: all of them.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
. packaging/tools.sh
need_llvm
make_tools

libraries_of() {
    case $1 in
    web) echo pbmpm ;;
    *) echo pbmpm pbmpm_static ;;
    esac
}

pack() { # TARGET: the archive of what is built in build/TARGET
    name=pbmpm-$(version)-$1
    work=$(mktemp -d)
    DESTDIR='' cmake --install "build/$1" --prefix "$work/$name" >/dev/null
    cp LICENSE CHANGELOG.md samples/minimal.c "$work/$name"
    cp packaging/ARCHIVE.md "$work/$name/README.md"
    import=$work/$name/lib/libpbmpm.dll.a
    if [ -e "$import" ]; then cp "$import" "$work/$name/lib/pbmpm.lib"; fi
    if [ -e "build/$1/lib/pbmpm.pdb" ]; then cp "build/$1/lib/pbmpm.pdb" "$work/$name/bin"; fi
    rm -f "dist/$name".*
    mkdir -p dist
    case $1 in
    windows-*) (cd "$work" && "$tools/bin/python" -m zipfile -c "$name.zip" "$name") && mv "$work/$name.zip" dist ;;
    *) tar -czf "dist/$name.tar.gz" --owner=0 --group=0 -C "$work" "$name" ;;
    esac
    shared=$(basename "$(library_of "$1")")
    [ "$1" = web ] || find "$work/$name" -name "$shared" | grep -q . || stop "$shared is not in the archive"
    rm -rf "$work"
    ls -l dist/"$name".*
}

[ $# -gt 0 ] || set -- $all_targets
for target; do
    stage "The library for $target"
    quietly "configure-$target.log" cross_configure "$target" "build/$target" -DPBMPM_STATIC=ON || stop "could not configure; full text: build/configure-$target.log"
    quietly "build-$target.log" cmake --build "build/$target" --target $(libraries_of "$target") || stop "the build failed; full text: build/build-$target.log"
    pack "$target"
done
