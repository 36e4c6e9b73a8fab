#!/usr/bin/env bash
# Grades a class on a Slurm cluster: each task of an array grades a part, and then all parts are
# merged. A part that fails is graded again, on any node.
#
#   INPUT=export.zip OUT=/shared/graded SHARDS=16 EXAM=final.json POLICY=policy.toml bash slurm.sh
#
# INPUT, OUT, EXAM and POLICY must be on a disk that all nodes share; only the owner needs to read
# EXAM. If something fails in the end, run the command again: it grades only what is missing.
#
# CORES, MEMORY and TIME are requested for each part (default: 2 cores, 4G, 4 hours). A part that has
# not ended after WAIT (default: 7days), for example because no node has that much memory, is
# cancelled. RETRIES is the number of times that a failed part is graded again (default: 2), and
# SBATCH contains more options for sbatch, such as "--partition=short --account=cs". OPTIONS are passed to
# every `cargo class`, such as "--cpu-limit 5", and LISTS to the merge, such as "--roster people.csv
# --canvas export.csv".
set -euo pipefail

: "${INPUT:?must name the export or folder}" "${OUT:?must name the output folder}"
: "${EXAM:?must name the exam: see cargo author exam}" "${POLICY:=}"
: "${SHARDS:=8}" "${CORES:=2}" "${MEMORY:=4G}" "${TIME:=4:00:00}" "${WAIT:=7days}" "${RETRIES:=2}"
: "${CLASS:=cargo class}" "${OPTIONS:=}" "${LISTS:=}" "${SBATCH:=}"
: "${SCRIPT:=$(realpath "$0")}" "${TRY:=0}" "${PARTS:=1-$SHARDS}"
export INPUT OUT EXAM POLICY SHARDS CORES MEMORY TIME WAIT RETRIES CLASS OPTIONS LISTS SBATCH SCRIPT
policy=()
[[ -z "$POLICY" ]] || policy=(--policy "$POLICY")

# Submits an array for these parts, and a merge that starts when all of them have ended.
submit() {
    local array merge
    mkdir -p "$OUT/shards" "$OUT/logs"
    # shellcheck disable=SC2086 # SBATCH may be several words
    array=$(STEP=shard TRY=$2 sbatch --parsable --job-name=pathtracing --array="$1" --requeue \
        --cpus-per-task="$CORES" --mem="$MEMORY" --time="$TIME" --deadline="now+$WAIT" \
        --output="$OUT/logs/%A-%a.txt" $SBATCH "$SCRIPT")
    # shellcheck disable=SC2086
    merge=$(STEP=merge TRY=$2 sbatch --parsable --job-name=pathtracing-merge --requeue \
        --dependency="afterany:$array" --kill-on-invalid-dep=yes --mem="$MEMORY" --time="$TIME" \
        --output="$OUT/logs/%j-merge.txt" $SBATCH "$SCRIPT")
    echo "submitted the parts $1 as job $array, and their merge as job $merge; logs are in $OUT/logs"
}

# Prints the parts that are not graded completely, separated by commas.
unfinished() {
    local part parts=()
    for ((part = 1; part <= SHARDS; part++)); do
        grep -qs '"state": "finished"' "$OUT/shards/$part/run.json" || parts+=("$part")
    done
    local IFS=,
    echo "${parts[*]}"
}

# shellcheck disable=SC2086 # OPTIONS, LISTS and CLASS may be several words
case "${STEP:-submit}" in
submit)
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
    submit "$PARTS" 0
    ;;
shard)
    part=$SLURM_ARRAY_TASK_ID
    $CLASS "$INPUT" $OPTIONS --exam "$EXAM" "${policy[@]}" --jobs "$CORES" \
        --shard "$part/$SHARDS" --out "$OUT/shards/$part"
    ;;
merge)
    failed=$(unfinished)
    if [[ -n "$failed" && "$TRY" -lt "$RETRIES" ]]; then
        echo "parts $failed are not finished and will be graded again"
        submit "$failed" "$((TRY + 1))"
        exit
    fi
    # If a part is still unfinished, the merge says which.
    $CLASS merge "$OUT"/shards/*/ "${policy[@]}" $LISTS --out "$OUT"
    ;;
esac
