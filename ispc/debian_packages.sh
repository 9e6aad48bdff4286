# debian_packages.sh - functions that put Debian packages under a private directory. Sourced, not run.
#
# Nothing on the system changes and no root is needed. The archive's address comes from the machine's own apt
# (`apt-get indextargets`), the keys from its archive keyring; every file is checked against the signed index.
#
#   open_cache DIR      the directory for all tools; takes its lock until the shell ends
#   fetch_package MODE PACKAGE
#                       unpacks PACKAGE into $NEW/root and lists what it took in $NEW/manifest.txt;
#                       MODE is "alone" or "closure" (with everything it depends on, the C library included)
#   keep NAME           makes $NEW the directory DIR/NAME, whole or not at all
LC_ALL=C; export LC_ALL
umask 022
SUITE=${PBMPM_SUITE:-trixie} # the Debian release that has an ISPC new enough

say() { echo "pbmpm: $*"; }
fail() {
    echo "pbmpm: error: $1" >&2; shift
    for line in "$@"; do echo "pbmpm:   $line" >&2; done
    exit 1
}

open_cache() {
    CACHE=$1
    case $CACHE in
        /*) ;;
        *) fail "the cache directory '$CACHE' is not an absolute path" ;;
    esac
    case $CACHE in
        *[!A-Za-z0-9._/+@=-]*) fail "the cache directory '$CACHE' has a blank or an unusual character in its path" \
            "apt's option files need a plain path; choose another one: PBMPM_CACHE_DIR=/plain/path" ;;
    esac
    mkdir -p "$CACHE" 2>/dev/null && [ -w "$CACHE" ] ||
        fail "cannot write to the cache directory $CACHE" "choose another one: PBMPM_CACHE_DIR=/path"
    command -v flock >/dev/null 2>&1 || fail "'flock' (package util-linux) is not on this machine" "$OTHER_WAY"
    exec 9>"$CACHE/.lock"
    flock -w 900 9 || fail "another set-up has held $CACHE/.lock for 15 minutes"
    NEW=$CACHE/.new
    trap 'rm -rf "$NEW" "$NEW.o" "$NEW.log"' EXIT
    rm -rf "$NEW"; mkdir -p "$NEW/root"
}

# Finds the archive that this machine uses and the keys that verify it.
find_archive() {
    for tool in apt-get apt-cache dpkg dpkg-deb sha256sum awk xargs; do
        command -v $tool >/dev/null 2>&1 || fail "this is no Debian machine ('$tool' is missing)" "$OTHER_WAY"
    done
    ARCH=$(dpkg --print-architecture)
    URI=$(apt-get indextargets --format '$(ORIGIN)|$(LABEL)|$(REPO_URI)|$(COMPONENT)' 'Created-By: Packages' 2>/dev/null |
        awk -F'|' '$1 == "Debian" && $2 == "Debian" && $4 == "main" { print $3; exit }')
    [ -n "$URI" ] || fail "apt on this machine lists no Debian 'main' archive" \
        "on a Debian machine run this once as root: apt-get update" "$OTHER_WAY"
    for KEYRING in /usr/share/keyrings/debian-archive-keyring.pgp /usr/share/keyrings/debian-archive-keyring.gpg ''; do
        [ -r "$KEYRING" ] && return
    done
    fail "no archive keyring in /usr/share/keyrings" "run this once as root: apt-get install debian-archive-keyring"
}

# Writes the configuration of an apt of our own: own state, one source, nothing unsigned, the machine's proxies.
configure_apt() {
    APT=$CACHE/apt-$SUITE
    mkdir -p "$APT/lists/partial" "$APT/archives/partial" "$APT/log"
    : >"$APT/status" # an empty system, so that apt leaves no dependency out
    echo "deb [arch=$ARCH signed-by=$KEYRING target=Packages] $URI $SUITE main" >"$APT/sources.list"
    cat >"$APT/apt.conf" <<END
#clear APT::Update::Pre-Invoke;
#clear APT::Update::Post-Invoke;
#clear APT::Update::Post-Invoke-Success;
#clear DPkg::Pre-Install-Pkgs;
#clear DPkg::Post-Invoke;
#clear APT::Default-Release;
Dir::State "$APT";
Dir::State::lists "$APT/lists";
Dir::State::status "$APT/status";
Dir::State::extended_states "$APT/extended_states";
Dir::Cache "$APT";
Dir::Cache::archives "$APT/archives";
Dir::Cache::pkgcache "";
Dir::Cache::srcpkgcache "";
Dir::Log "$APT/log";
Dir::Etc::sourcelist "$APT/sources.list";
Dir::Etc::sourceparts "/dev/null";
Dir::Etc::preferences "/dev/null";
Dir::Etc::preferencesparts "/dev/null";
APT::Architecture "$ARCH";
APT::Architectures { "$ARCH"; };
APT::Sandbox::User "";
APT::Install-Recommends "false";
APT::Get::AllowUnauthenticated "false";
APT::Update::Error-Mode "any";
Acquire::AllowInsecureRepositories "false";
Acquire::AllowWeakRepositories "false";
Acquire::AllowDowngradeToInsecureRepositories "false";
Acquire::Languages "none";
Acquire::GzipIndexes "true";
Acquire::Retries "3";
END
}

# own_apt LOG-NAME COMMAND ARGUMENTS...: runs an apt command on our own configuration; its errors are shown if it fails.
own_apt() {
    log=$APT/log/$1.log; tool=$2; shift 2
    (cd "$APT/archives" && "$tool" -c "$APT/apt.conf" "$@") >"$log" 2>&1 && return
    sed -n 's/^[EW]: /pbmpm:   /p' "$log" >&2
    return 1
}

download() {
    say "reading the index of Debian '$SUITE' ($ARCH) from this machine's archive"
    own_apt update apt-get -q update ||
        fail "could not read Debian '$SUITE'; full text: $APT/log/update.log" \
            "if a key is missing, upgrade the package debian-archive-keyring" "$OTHER_WAY"
    say "downloading $2"
    rm -f "$APT"/archives/*.deb
    case $1 in
        alone) own_apt download apt-get -q download "$2" ;;
        closure) own_apt download apt-get -q -y --download-only install "$2" ;;
    esac || fail "could not fetch the package '$2' for $ARCH; full text: $APT/log/download.log" "$OTHER_WAY"
}

# Unpacks the downloaded files, each only after its checksum was found in the signed index.
unpack() {
    for file in "$APT"/archives/*.deb; do
        echo "$(dpkg-deb -f "$file" Package)=$(dpkg-deb -f "$file" Version) $file"
    done >"$APT/downloaded"
    cut -d' ' -f1 "$APT/downloaded" | xargs -d '\n' "$(command -v apt-cache)" -c "$APT/apt.conf" show 2>/dev/null |
        awk '$1 == "Package:" { p = $2 } $1 == "Version:" { v = $2 } $1 == "SHA256:" { print p "=" v " " $2 }' >"$APT/sums"
    echo "suite $SUITE $ARCH" >"$NEW/manifest.txt"
    while read -r package file; do
        sum=$(sha256sum "$file" | cut -d' ' -f1)
        grep -qxF "$package $sum" "$APT/sums" || fail "$(basename "$file") does not match the signed index; run again"
        dpkg -x "$file" "$NEW/root"
        echo "$package $sum" >>"$NEW/manifest.txt"
    done <"$APT/downloaded"
    rm -rf "$APT/archives"
}

fetch_package() {
    find_archive
    configure_apt
    download "$1" "$2"
    unpack
}

keep() {
    rm -rf "${CACHE:?}/$1"
    mv "$NEW" "$CACHE/$1"
}
