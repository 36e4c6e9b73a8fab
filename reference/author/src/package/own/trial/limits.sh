# Half of a core and 768 MiB, for a command and all that it starts. Arguments: a file for what was
# used, and the command. Ends with 125 where there is no control group to be had.
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
# The one that has such a file: it is another one in each version.
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

# Of each the version that there is: CPU time in microseconds or nanoseconds, the most memory in bytes.
{
    for name in cpu.stat cpuacct.usage memory.peak memory.max_usage_in_bytes; do
        file=$(file "$name")
        case "$file" in
        '') ;;
        */cpu.stat) sed -n 's/^usage_usec /cpu_us /p' "$file" ;;
        */cpuacct.usage) echo "cpu_ns $(cat "$file")" ;;
        *) echo "memory $(cat "$file")" ;;
        esac
    done
} >"$used"
clear
exit "$code"
