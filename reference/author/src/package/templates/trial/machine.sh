# Runs a command on a simulated machine, in separate namespaces. The machine has this system's
# programs and the toolchain, but no network and no other files. Arguments: the machine's root, the
# toolchain, the user, the working directory, the environment variables, and the command.
set -eu
root=$1 toolchain=$2 user=$3 folder=$4
shift 4
mount --make-rprivate /
for path in /usr /bin /sbin /lib /lib64 /etc "$toolchain"; do
    [ -d "$path" ] || continue
    mkdir -p "$root$path"
    mount --rbind "$path" "$root$path"
done
mkdir -p "$root/proc" "$root/dev" "$root/tmp" "$root/root"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount -t tmpfs tmpfs "$root/tmp"
chmod 1777 "$root/tmp"
case "$user" in
# Root as in a Docker container, with the capabilities that Docker keeps: it cannot create
# namespaces.
container)
    capabilities=-all
    for capability in chown dac_override fowner fsetid kill mknod net_bind_service net_raw setfcap \
        setgid setpcap setuid sys_chroot audit_write; do
        capabilities=$capabilities,+$capability
    done
    set -- --bounding-set "$capabilities" --inh-caps -all env -i HOME=/root "$@"
    ;;
# The user of GitHub's runners.
runner)
    chown -R 1001:1001 "$root/home/runner"
    set -- --reuid 1001 --regid 1001 --clear-groups env -i HOME=/home/runner USER=runner "$@"
    ;;
esac
exec chroot "$root" env -C "$folder" \
    PATH="$toolchain/bin:/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin" setpriv "$@"
