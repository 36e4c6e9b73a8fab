# A machine like Gradescope's, in namespaces of its own: this system's programs, the toolchain, no
# network, and an empty rest. Arguments: its root, the toolchain, and what to run there.
set -eu
root=$1 toolchain=$2
shift 2
mount --make-rprivate /
for folder in /usr /bin /sbin /lib /lib64 /etc "$toolchain"; do
    [ -d "$folder" ] || continue
    mkdir -p "$root$folder"
    mount --rbind "$folder" "$root$folder"
done
mkdir -p "$root/proc" "$root/dev" "$root/tmp" "$root/root"
mount -t proc proc "$root/proc"
mount --rbind /dev "$root/dev"
mount -t tmpfs tmpfs "$root/tmp"
exec chroot "$root" /usr/bin/env -i HOME=/root LANG=C.UTF-8 \
    PATH="$toolchain/bin:/usr/sbin:/usr/bin:/sbin:/bin" bash "$@"
