#!/bin/sh
# Stands for `cargo` and `rustc` of an image in which rustup has installed Rust in its default
# folder. Like rustup's proxies, it finds the toolchain through RUSTUP_HOME or the home folder.
home=${RUSTUP_HOME:-$HOME/.rustup}
tool=$home/toolchains/default/bin/${0##*/}
if [ ! -x "$tool" ]; then
    echo "error: rustup could not choose a version of ${0##*/} to run: there is none in $home" >&2
    exit 1
fi
exec "$tool" "$@"
