#!/usr/bin/env bash
# Grades a class on several machines with GNU parallel: each machine grades parts of the class, and
# then all parts are merged. A part that fails, or takes longer than TIME (default: 4h), is graded
# again, at most RETRIES times (default: 2). After WAIT (default: 7d), everything is stopped.
#
#   INPUT=export.zip OUT=/shared/graded EXAM=final.json POLICY=policy.toml SHARDS=4 \
#       SSH="--sshlogin a,b,c,d" bash parallel.sh
#
# Without SSH, everything runs on this machine, where plain `cargo class` does the same. INPUT, OUT,
# EXAM and POLICY must be on a disk that all machines share. If you run the command again, it grades
# only what is missing. A part starts on a machine with MEMORY to spare (default: 1G), and uses CORES
# cores there (default: all). OPTIONS are passed to every `cargo class`, such as "--cpu-limit 5", and
# LISTS to the merge, such as "--canvas e.csv".
set -euo pipefail

: "${INPUT:?must name the export or folder}" "${OUT:?must name the output folder}"
: "${EXAM:?must name the exam: see cargo author exam}" "${POLICY:=}"
: "${SHARDS:=4}" "${CORES:=}" "${MEMORY:=1G}" "${TIME:=4h}" "${WAIT:=7d}" "${RETRIES:=2}"
: "${CLASS:=cargo class}" "${OPTIONS:=}" "${LISTS:=}" "${SSH:=}"
policy=() cores=()
[[ -z "$POLICY" ]] || policy=(--policy "$POLICY")
[[ -z "$CORES" ]] || cores=(--jobs "$CORES")

if [[ "$(realpath -m "$OUT")/" == "$(realpath "$INPUT")"/* ]]; then
    echo "error: OUT is inside INPUT, so the results would be mistaken for submissions: choose a different OUT" >&2
    exit 2
fi
before=$(cat "$OUT/shards/count" 2>/dev/null || true)
if [[ -n "$before" && "$before" != "$SHARDS" ]]; then
    echo "error: $OUT/shards was graded with SHARDS=$before: set SHARDS=$before, or remove that folder" >&2
    exit 2
fi
mkdir -p "$OUT/shards"
echo "$SHARDS" >"$OUT/shards/count"

echo "grading $SHARDS parts of $INPUT; the results of each part are in $OUT/shards"
# shellcheck disable=SC2086 # each of these may be several words
if ! seq "$SHARDS" | timeout --foreground "$WAIT" \
    parallel --will-cite --quote --jobs 1 --memfree "$MEMORY" --timeout "$TIME" \
    --retries "$((RETRIES + 1))" $SSH --workdir "$PWD" \
    $CLASS "$INPUT" $OPTIONS --exam "$EXAM" "${policy[@]}" "${cores[@]}" \
    --shard "{}/$SHARDS" --out "$OUT/shards/{}"; then
    echo "error: some parts were not graded: see above, and run the command again" >&2
    exit 3
fi
# shellcheck disable=SC2086
$CLASS merge "$OUT"/shards/*/ "${policy[@]}" $LISTS --out "$OUT"
