# setup.sh - sets up a machine for samples/demo.sh and tests/run.sh. Sourced from the top folder, not run.
#
#   takes_no_arguments "$@"  stops the script that was given any
#   install_build_tools     CMake, Ninja, a C compiler and Python's venv: installed when missing and root, else named
#   install_optional WHY PACKAGE...
#                           installs packages when root; otherwise one line says what is left out for want of them
#   make_environment LIBRARY [EXTRA]
#                           build/venv, a Python environment whose bin/pbmpm runs the given shared library

stage() { printf '\n=== %s\n' "$*"; }
stop() { echo "pbmpm: error: $*" >&2; exit 1; }
takes_no_arguments() { [ $# -eq 0 ] || stop "unknown argument '$1': $(basename "$0") knows no arguments"; }

has() { command -v "$1" >/dev/null 2>&1; }
is_root() { [ "$(id -u)" -eq 0 ] && has apt-get; }

# quietly LOG COMMAND...: output to a file, shown only when the command fails.
quietly() {
    log=build/$1; shift
    mkdir -p build
    "$@" >"$log" 2>&1 && return
    tail -n 30 "$log" >&2
    return 1
}

apt_knows_archive() { apt-get indextargets --format '$(ORIGIN)' 'Created-By: Packages' 2>/dev/null | grep -q .; }

apt_install() {
    apt_knows_archive || quietly apt-update.log apt-get -q update || return 1
    install="env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends install"
    quietly apt-install.log $install "$@" 2>/dev/null && return
    # An old index names files that are no longer in the archive.
    quietly apt-update.log apt-get -q update && quietly apt-install.log $install "$@"
}

missing_packages() {
    has cmake || echo cmake
    has ninja || echo ninja-build
    { has cc || has gcc || has clang; } || echo gcc libc6-dev
    python3 -c 'import ensurepip, venv' >/dev/null 2>&1 || echo python3 python3-venv
}

install_build_tools() {
    missing=$(missing_packages | tr '\n' ' ')
    if [ -n "$missing" ]; then
        is_root || stop "some tools are missing; as an administrator type: apt-get install $missing"
        stage "Installing $missing"
        # shellcheck disable=SC2086 # one word per package
        apt_install $missing || stop "could not install $missing"
    elif is_root && ! apt_knows_archive; then
        quietly apt-update.log apt-get -q update || echo "pbmpm: apt has no package index and could not read one"
    fi
    cmake --workflow --help 2>&1 | grep -q preset || stop "CMake 3.25 or newer is needed; this is $(cmake --version | head -n 1)"
    python3 -c 'import sys; sys.exit(sys.version_info < (3, 10))' || stop "Python 3.10 or newer is needed; this is $(python3 --version)"
}

install_optional() {
    why=$1; shift
    if is_root; then
        stage "Installing $*"
        apt_install "$@" && return
    fi
    echo "pbmpm: $why; to have it, as an administrator type: apt-get install $*"
}

make_environment() {
    stage "Python environment build/venv"
    build/venv/bin/pip --version >/dev/null 2>&1 || quietly venv.log python3 -m venv --clear build/venv ||
        stop "could not make a Python environment in build/venv"
    PBMPM_LIBRARY=$PWD/$1 quietly pip.log build/venv/bin/pip --disable-pip-version-check install ".${2:+[$2]}" ||
        stop "could not install the Python binding into build/venv; full text: build/pip.log"
}
