# A machine like a platform's, in namespaces of its own: this system's programs, the toolchain, no
# network, and an empty rest. Arguments: its root, the toolchain, who runs there, in which folder, and
# what, after the variables that it sees.
set -eu
root=$1 toolchain=$2 who=$3 folder=$4
shift 4
mount --make-rprivate /
for place in /usr /bin /sbin /lib /lib64 /etc "$toolchain"; do
    [ -d "$place" ] || continue
    mkdir -p "$root$place"
    mount --rbind "$place" "$root$place"
done
mkdir -p "$root/proc" "$root/dev" "$root/tmp" "$root/root"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount -t tmpfs tmpfs "$root/tmp"
chmod 1777 "$root/tmp"
case "$who" in
# Root as Docker makes it: of its rights these are left, and no namespaces can be made.
container)
    rights=-all
    for right in chown dac_override fowner fsetid kill mknod net_bind_service net_raw setfcap \
        setgid setpcap setuid sys_chroot audit_write; do
        rights=$rights,+$right
    done
    set -- --bounding-set "$rights" --inh-caps -all env -i HOME=/root "$@"
    ;;
# The user of GitHub's runners.
runner)
    chown -R 1001:1001 "$root/home/runner"
    set -- --reuid 1001 --regid 1001 --clear-groups env -i HOME=/home/runner USER=runner "$@"
    ;;
esac
exec chroot "$root" env -C "$folder" \
    PATH="$toolchain/bin:/usr/local/bin:/usr/bin:/bin:/usr/sbin:/sbin" setpriv "$@"
