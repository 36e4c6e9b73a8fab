# Runs a command and its child processes with half a core and 768 MiB of memory. Arguments: a file
# to write the resource usage to, and the command. Exits with 125 if control groups cannot be used.
set -eu
used=$1
shift
groups=/sys/fs/cgroup name=pathtracing-trial-$$
if [ -e "$groups/cgroup.controllers" ]; then
    echo "+cpu +memory" 2>/dev/null >"$groups/cgroup.subtree_control" || true
    set -- "$groups/$name" -- "$@"
else
    set -- "$groups/cpu/$name" "$groups/cpuacct/$name" "$groups/memory/$name" -- "$@"
fi
all=
while [ "$1" != -- ]; do
    mkdir -p "$1" 2>/dev/null || exit 125
    all="$all $1"
    shift
done
shift
# Prints the path of a control file. Which group has it depends on the version of control groups.
file() {
    for group in $all; do
        if [ -e "$group/$1" ]; then
            echo "$group/$1"
            return
        fi
    done
}
put() {
    file=$(file "$2")
    [ -z "$file" ] || echo "$1" >"$file"
}
clear() {
    for group in $all; do rmdir "$group" 2>/dev/null || true; done
}
if [ -z "$(file cpu.max)$(file cpu.cfs_quota_us)" ] || [ -z "$(file memory.max)$(file memory.limit_in_bytes)" ]; then
    clear
    exit 125
fi
memory=$((768 << 20))
put "50000 100000" cpu.max
put 100000 cpu.cfs_period_us
put 50000 cpu.cfs_quota_us
put "$memory" memory.max
put 0 memory.swap.max
put "$memory" memory.limit_in_bytes
put "$memory" memory.memsw.limit_in_bytes

code=0
GROUPS_OF_TRIAL=$all sh -c '
    for group in $GROUPS_OF_TRIAL; do echo $$ >"$group/cgroup.procs"; done
    unset GROUPS_OF_TRIAL
    exec "$@"' sh "$@" || code=$?

# Only the files of one version of control groups exist. They contain the CPU time, in microseconds
# or nanoseconds, and the peak memory in bytes. The time is written first, in microseconds.
{
    for name in cpu.stat cpuacct.usage memory.peak memory.max_usage_in_bytes; do
        file=$(file "$name")
        case "$file" in
        '') ;;
        */cpu.stat) sed -n 's/^usage_usec /cpu_us /p' "$file" ;;
        */cpuacct.usage) echo "cpu_us $(($(cat "$file") / 1000))" ;;
        *) echo "memory $(cat "$file")" ;;
        esac
    done
} >"$used"
clear
exit "$code"
