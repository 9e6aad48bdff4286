#!/bin/sh
# provision.sh CACHE - makes CACHE/ispc/bin/ispc, the ISPC compiler with all that it needs, from Debian's signed archive.
# No root, no change of the system; a second call finds the first one's work.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
OTHER_WAY='install ISPC 1.22 or newer yourself and configure with -DCMAKE_ISPC_COMPILER=/path/to/ispc'
. "$here/debian_packages.sh"

# The compiler runs with the C library that came with it, so it also works where the system's is older.
write_launcher() {
    root=$CACHE/ispc/root
    loader=$(cd "$NEW/root" && find . -type f -name 'ld-linux*.so.*' | sort | head -n 1)
    [ -n "$loader" ] || fail "the package libc6 has no loader: its layout has changed" "$OTHER_WAY"
    libraries=$(cd "$NEW/root" && find . -name '*.so*' -exec dirname {} \; | sort -u | sed "s|^\.|$root|" | paste -sd: -)
    mkdir "$NEW/bin"
    cat >"$NEW/bin/ispc" <<END
#!/bin/sh
exec $root/${loader#./} --library-path $libraries $root/usr/bin/ispc "\$@"
END
    chmod 755 "$NEW/bin/ispc"
}

compiles() {
    [ -x "$CACHE/ispc/bin/ispc" ] &&
        echo 'export void f(uniform float a[], uniform int n) { foreach (i = 0 ... n) a[i] = sqrt(a[i]); }' |
            "$CACHE/ispc/bin/ispc" --pic -O2 --target=sse4-i32x4 - -o "$NEW.o" >"$NEW.log" 2>&1
}

open_cache "${1:?usage: provision.sh CACHE}"
compiles && exit 0
fetch_package closure ispc
(cd "$NEW/root" && rm -rf usr/share etc var sbin usr/sbin usr/lib/*/gconv usr/lib/*/perl*)
write_launcher
keep ispc
compiles || { cat "$NEW.log" >&2; fail "the unpacked ISPC does not run here" "$OTHER_WAY"; }
say "$("$CACHE/ispc/bin/ispc" --version) is in $CACHE/ispc"
