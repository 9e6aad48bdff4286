#!/bin/sh
# check.sh TARGET... - what LLVM's tools tell of the libraries in build/TARGET: that they are for that system, CPU and oldest version, need no other libraries
# than the system's, and export the functions in src/api/exports.txt.
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh
. packaging/tools.sh
need_llvm
export LC_ALL=C # in which exports.txt is sorted

# What a linker adds by itself.
ADDED='__dso_handle|_mh_dylib_header|_init|_fini|__bss_start|_edata|_end'

exports_of() { # TARGET LIBRARY
    case $1 in
    windows-*) "$(llvm llvm-readobj)" --coff-exports "$2" | sed -n '/^Export {/,/^}/s/^ *Name: //p' ;;
    macos-*) "$(llvm llvm-nm)" -gU "$2" | sed 's/.* _//' ;;
    *) "$(llvm llvm-nm)" -D --defined-only "$2" | sed 's/.* //; s/@.*//' ;;
    esac | grep -Evx "$ADDED" | sort
}

needs_of() { # TARGET LIBRARY: the libraries
    case $1 in
    windows-*) "$(llvm llvm-readobj)" --coff-imports "$2" | sed -n 's/^  Name: //p' ;;
    macos-*) "$(llvm llvm-objdump)" --macho --dylibs-used "$2" | sed -n 's/^\t\([^ ]*\) .*/\1/p' ;;
    *) "$(llvm llvm-readelf)" --needed-libs "$2" | sed -n 's/^  //p' ;;
    esac
}

KNOWN='kernel32\.dll|api-ms-win-crt-.*|/usr/lib/libSystem.B.dylib|@rpath/libpbmpm\.[0-9]*\.dylib|lib(c|m|pthread)\.so\.6|libpthread\.so\.0|ld-linux-.*'

for target; do
    [ "$target" != web ] || continue # no shared library
    library=$(library_of "$target")
    [ -e "$library" ] || stop "there is no $library: sh packaging/library.sh $target"
    exports_of "$target" "$library" | diff - src/api/exports.txt >&2 || stop "$library does not export what src/api/exports.txt lists"
    others=$(needs_of "$target" "$library" | grep -iEvx "$KNOWN" || true)
    [ -z "$others" ] || stop "$library needs $others"
    format=$("$(llvm llvm-readobj)" --file-headers "$library" | sed -n 's/^Format: //p')
    oldest=
    case $target in
    macos-*)
        oldest=", from $("$(llvm llvm-objdump)" --macho --private-headers "$library" | sed -n 's/^ *minos /macOS /p'), $("$(llvm llvm-objdump)" --macho --dylib-id "$library" | tail -n 1)"
        ;;
    linux-*)
        oldest=", from $("$(llvm llvm-readelf)" --version-info "$library" | grep -o 'GLIBC_[0-9.]*' | sort -uV | tail -n 1)"
        ;;
    esac
    echo "$target: $format$oldest; $(wc -l <src/api/exports.txt) functions; needs $(needs_of "$target" "$library" | tr '\n' ' ')"
done
