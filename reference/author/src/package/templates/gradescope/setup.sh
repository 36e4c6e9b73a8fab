#!/usr/bin/env bash
# Gradescope runs this script once, as root, when it builds the image. Only this script uses the
# network.
set -euo pipefail
umask 022
home=/opt/pathtracing

if ! type cc curl >/dev/null 2>&1; then
    apt-get update -q
    apt-get install -qy --no-install-recommends ca-certificates curl gcc libc6-dev
fi
if ! type cargo rustc >/dev/null 2>&1; then
    export RUSTUP_HOME=/opt/rust/rustup CARGO_HOME=/opt/rust/cargo PATH="/opt/rust/cargo/bin:$PATH"
    curl --proto '=https' --tlsv1.2 -sSf https://sh.rustup.rs |
        sh -s -- -y --no-modify-path --profile minimal --default-toolchain 1.95.0
fi

mkdir -p "$home"
cp -R /autograder/source/pathtracing/. "$home"
# Submissions could read the files there.
rm -rf /autograder/source/pathtracing
chown -R root:root "$home"
chmod 600 "$home/exam.json" "$home/policy.toml"
chmod -R go= "$home/reference"

# The environment in which Rust was found, for the script that grades. If the image came with Rust,
# its own settings are kept.
declare -p PATH >"$home/environment"
[[ -z ${RUSTUP_HOME:-} ]] || declare -p RUSTUP_HOME >>"$home/environment"

cd "$home"
CARGO_HOME="$home/crates" cargo build --release --locked --offline --package grader
# Compiles everything that submissions are built with. The reference must get all points.
./grade "$home/reference" --require 100 --out "$home/target/setup"
