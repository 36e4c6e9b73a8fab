#!/usr/bin/env bash
# Grades a class on a Slurm cluster: each task of an array grades a part, and then all parts are
# merged.
#
#   INPUT=export.zip OUT=/shared/graded SHARDS=16 bash slurm.sh
#
# INPUT and OUT must be on a disk that all nodes share. If something fails, run the command again:
# it grades only what is missing. OPTIONS are passed to every `cargo class`, such as "--exam
# final.json --policy p.toml", and LISTS to the merge, such as "--roster people.csv --canvas
# export.csv".
set -euo pipefail

: "${INPUT:?must name the export or folder}" "${OUT:?must name the output folder}"
: "${SHARDS:=8}" "${CLASS:=cargo class}" "${OPTIONS:=}" "${LISTS:=}"
export INPUT OUT SHARDS CLASS OPTIONS LISTS

# shellcheck disable=SC2086 # each of these may be several words
case "${STEP:-submit}" in
submit)
    export STEP=shard
    array=$(sbatch --parsable --array="1-$SHARDS" "$0")
    export STEP=merge
    sbatch --parsable --dependency="afterok:$array" "$0"
    ;;
shard)
    $CLASS "$INPUT" $OPTIONS --shard "$SLURM_ARRAY_TASK_ID/$SHARDS" --out "$OUT/shards/$SLURM_ARRAY_TASK_ID"
    ;;
merge)
    $CLASS merge "$OUT"/shards/* $LISTS --out "$OUT"
    ;;
esac
