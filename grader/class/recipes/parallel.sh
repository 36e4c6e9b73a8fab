#!/usr/bin/env bash
# A class on several machines by GNU parallel: a part of it on each, then all parts merged.
#
#   INPUT=export.zip OUT=/shared/graded SHARDS=4 SSH="--sshlogin a,b,c,d" bash parallel.sh
#
# Without SSH, on this machine alone, where plain `cargo class` does the same. The folders are to be
# on a disk that all machines see. The same command again grades only what is missing. OPTIONS go to
# every `cargo class`, such as "--exam final.json", and LISTS to the merge, such as "--canvas e.csv".
set -euo pipefail

: "${INPUT:?the export or folder}" "${OUT:?the folder for the results}"
: "${SHARDS:=4}" "${CLASS:=cargo class}" "${OPTIONS:=}" "${LISTS:=}" "${SSH:=}"

# shellcheck disable=SC2086 # these are several words each
seq "$SHARDS" | parallel --will-cite --quote --jobs 1 $SSH --workdir "$PWD" \
    $CLASS "$INPUT" $OPTIONS --shard "{}/$SHARDS" --out "$OUT/shards/{}"
# shellcheck disable=SC2086
$CLASS merge "$OUT"/shards/* $LISTS --out "$OUT"
