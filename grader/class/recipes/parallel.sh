#!/usr/bin/env bash
# Grades a class on several machines with GNU parallel: each machine grades parts of the class, and
# then all parts are merged. A part that fails, or takes longer than TIME, is graded again, at most
# RETRIES times.
#
#   INPUT=export.zip OUT=/shared/graded EXAM=final.json POLICY=policy.toml SHARDS=4 \
#       SSH="--sshlogin a,b,c,d" bash parallel.sh
#
# Without SSH, everything runs on this machine, where plain `cargo class` does the same. INPUT, OUT,
# EXAM and POLICY must be on a disk that all machines share. If you run the command again, it grades
# only what is missing. OPTIONS are passed to every `cargo class`, such as "--cpu-limit 5", and LISTS
# to the merge, such as "--canvas e.csv".
set -euo pipefail

: "${INPUT:?must name the export or folder}" "${OUT:?must name the output folder}"
: "${EXAM:?must name the exam: see cargo author exam}" "${POLICY:=}"
: "${SHARDS:=4}" "${TIME:=4h}" "${RETRIES:=2}"
: "${CLASS:=cargo class}" "${OPTIONS:=}" "${LISTS:=}" "${SSH:=}"
policy=()
[[ -z "$POLICY" ]] || policy=(--policy "$POLICY")

before=$(cat "$OUT/shards/count" 2>/dev/null || true)
if [[ -n "$before" && "$before" != "$SHARDS" ]]; then
    echo "error: $OUT/shards has parts of $before; set SHARDS=$before, or remove that folder" >&2
    exit 2
fi
mkdir -p "$OUT/shards"
echo "$SHARDS" >"$OUT/shards/count"

echo "grading $SHARDS parts of $INPUT"
# shellcheck disable=SC2086 # each of these may be several words
seq "$SHARDS" | parallel --will-cite --quote --jobs 1 --timeout "$TIME" --retries "$((RETRIES + 1))" \
    $SSH --workdir "$PWD" \
    $CLASS "$INPUT" $OPTIONS --exam "$EXAM" "${policy[@]}" --shard "{}/$SHARDS" --out "$OUT/shards/{}"
# shellcheck disable=SC2086
$CLASS merge "$OUT"/shards/*/ "${policy[@]}" $LISTS --out "$OUT"
