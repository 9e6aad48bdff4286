#!/bin/sh
# grow.sh HEADER TABLE FOLDER - writes into FOLDER the headers and the table of sizes of a library in which every structure that may grow has
# got one more field. HEADER: as the generator keeps it, a declaration on a line; TABLE: src/base/sized_table.inc.
set -eu
header=$1 table=$2 folder=$3
mkdir -p "$folder/pbmpm"
sed -e 's|^\(typedef struct pbmpm_[a-z_]* { uint32_t size; .*\) } \(pbmpm_[a-z_]*\);$|\1 uint64_t grown; } \2;|' \
    -e 's|^typedef enum pbmpm_result |#pragma GCC visibility push(default)\n&|' "$header" >"$folder/pbmpm/pbmpm.h"
grep -q 'uint64_t grown' "$folder/pbmpm/pbmpm.h"
for part in "$(dirname "$0")"/../../include/pbmpm/*.h; do
    name=$(basename "$part")
    [ "$name" = pbmpm.h ] || echo '#include "pbmpm.h"' >"$folder/pbmpm/$name"
done
sed 's|^PBMPM_SIZED(\(pbmpm_[a-z_]*\), \("[^"]*"\), |PBMPM_SIZED(\1, \2, END(\1, grown), |' "$table" >"$folder/sized_table.inc"
