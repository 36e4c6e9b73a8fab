#!/usr/bin/env bash
# Grades a class on several machines with GNU parallel: each machine grades parts of the class, and
# then all parts are merged.
#
#   INPUT=export.zip OUT=/shared/graded SHARDS=4 SSH="--sshlogin a,b,c,d" bash parallel.sh
#
# Without SSH, everything runs on this machine, where plain `cargo class` does the same. The folders
# must be on a disk that all machines share. If you run the command again, it grades only what is
# missing. OPTIONS are passed to every `cargo class`, such as "--exam final.json", and LISTS to the
# merge, such as "--canvas e.csv".
set -euo pipefail

: "${INPUT:?must name the export or folder}" "${OUT:?must name the output folder}"
: "${SHARDS:=4}" "${CLASS:=cargo class}" "${OPTIONS:=}" "${LISTS:=}" "${SSH:=}"

# shellcheck disable=SC2086 # each of these may be several words
seq "$SHARDS" | parallel --will-cite --quote --jobs 1 $SSH --workdir "$PWD" \
    $CLASS "$INPUT" $OPTIONS --shard "{}/$SHARDS" --out "$OUT/shards/{}"
# shellcheck disable=SC2086
$CLASS merge "$OUT"/shards/* $LISTS --out "$OUT"
