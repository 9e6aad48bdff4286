#!/bin/sh
# compare_symbols.sh library NM LIBRARY EXPORTS    the shared library's dynamic symbols against the list
# compare_symbols.sh archive NM LIBRARY EXPORTS    what programs see of the static library against the list
# compare_symbols.sh headers FOLDER EXPORTS        the functions that the headers declare against the list
# compare_symbols.sh calls NM OBJECT EXPORTS       the functions that a compiled file calls against the list
# Prints the difference and fails if there is one.
set -eu
LC_ALL=C; export LC_ALL
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

case $1 in
    library)
        exports=$4
        "$2" -D --defined-only "$3" | awk '{ print $NF }' | sort >"$work/found"
        ;;
    archive)
        exports=$4
        "$2" -g --defined-only "$3" | awk 'NF == 3 { print $NF }' | sort >"$work/found"
        ;;
    calls)
        exports=$4
        "$2" -u "$3" | awk '$NF ~ /^pbmpm_/ { print $NF }' | sort >"$work/found"
        ;;
    headers)
        exports=$3
        cat "$2"/*.h | sed -n 's/^PBMPM_API .*[ *]\(pbmpm_[a-z0-9_]*\)(.*/\1/p' | sort >"$work/found"
        declared=$(cat "$2"/*.h | grep -c '^ *PBMPM_API ')
        [ "$declared" -eq "$(wc -l <"$work/found")" ] || {
            echo "$declared declarations begin with PBMPM_API, but not each has its name on the same line"
            exit 1
        }
        ;;
    *) echo "usage: see the head of $0" >&2; exit 2 ;;
esac

[ -s "$work/found" ] || { echo "no functions found"; exit 1; }
sort -u -c "$exports" || { echo "$exports is not sorted"; exit 1; }
diff -u "$exports" "$work/found" && echo "$(wc -l <"$exports") functions agree"
