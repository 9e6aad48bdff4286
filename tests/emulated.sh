# emulated.sh - what windows.sh and arm64.sh have in common. Sourced after samples/setup.sh and packaging/tools.sh.
#
#   need_tool PATH PACKAGE          prints the path, a command or a file; without it the package is installed when root, else named
#   build_for TARGET [OPTION...]    the library and its tests in build/TARGET
#   strict_build TARGET             the program of the hashes in build/strict-TARGET; for the web the library
#   compare_hashes STEPS LEFT RIGHT [SCENE]
#                                   runs two commands that take a number of steps (tests/strict/hashes.c); stops if their hashes differ, but for SCENE

need_tool() {
    command -v "$1" || {
        is_root && apt_install "$2" >&2 && command -v "$1"
    } || [ -e "$1" ] || stop "$1 is missing; as an administrator type: apt-get install $2"
}

build_for() {
    target=$1 && shift
    stage "Building for $target"
    quietly "configure-$target.log" cross_configure "$target" "build/$target" -DPBMPM_TESTS=ON "$@" ||
        stop "could not configure; full text: build/configure-$target.log"
    quietly "build-$target.log" cmake --build "build/$target" || stop "the build failed; full text: build/build-$target.log"
}

strict_build() {
    stage "Building for $1, strictly"
    case $1 in
    web) wanted=pbmpm ;;
    *) wanted=hashes ;;
    esac
    quietly configure-strict.log cross_configure "$1" "build/strict-$1" -DPBMPM_TESTS=ON -DPBMPM_STRICT=ON ||
        stop "could not configure; full text: build/configure-strict.log"
    quietly build-strict.log cmake --build "build/strict-$1" --target $wanted || stop "the build failed; full text: build/build-strict.log"
}

compare_hashes() {
    $2 "$1" | tr -d '\r' >build/left.txt
    $3 "$1" | tr -d '\r' >build/right.txt
    kernels=$(sed -n '1s/kernels: \([^,]*\),.*/\1/p' build/left.txt)
    sed "1d; /^${4:-none}/d" build/left.txt >build/left.hashes
    sed "1d; /^${4:-none}/d" build/right.txt | diff build/left.hashes - || stop "the hashes differ: $(head -n 1 build/left.txt); $(head -n 1 build/right.txt)"
    echo "$kernels and $(sed -n '1s/kernels: \([^,]*\),.*/\1/p' build/right.txt): $(wc -l <build/left.hashes) scenes of $1 steps are equal"
}
