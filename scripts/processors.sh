#!/usr/bin/env bash
# The same bytes on every processor, which are this one, x86-64 without and with AVX2, and aarch64, the latter three under qemu: fingerprints of
# the science (examples/fingerprints.rs), every file of the paper's run, and all files, words and figures of tests/guard. And how many
# instructions the solver takes on aarch64 with NEON and without.
# On Debian 12, whose cross compiler and standard library are of one version:
#     dpkg --add-architecture arm64 && apt-get update
#     apt-get install rustc-web libstd-rust-web-dev:arm64 libc6:arm64 gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user-static
# Usage: scripts/processors.sh                            two hours
#        scripts/processors.sh count                      ten minutes: qemu prints a line for each instruction
#        scripts/processors.sh aarch64 | avx2 | nehalem   the files of this processor alone
set -euo pipefail
cd "$(dirname "$0")/.."
case ${1:-} in
    "" | count | aarch64 | avx2 | nehalem) ;;
    *) echo "$1: expected count, aarch64, avx2 or nehalem" >&2 && exit 2 ;;
esac

arm=aarch64-unknown-linux-gnu
target=${CARGO_TARGET_DIR:-target}
build() {
    cargo build --release --locked "$@"
    RUSTC=/usr/bin/rustc CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc cargo build --release --locked "$@" --target $arm
}
build --no-default-features --example fingerprints
here=$target/release/examples/fingerprints
there=$target/$arm/release/examples/fingerprints

# Instructions: those of solving twice as often, less those of solving once.
count() {
    local lines fifo
    fifo=$(mktemp -u) && mkfifo "$fifo"
    grep -c '^Trace' "$fifo" > "$fifo.count" &
    qemu-aarch64-static -singlestep -d exec,nochain -D "$fifo" "$there" "$1" "$2"
    wait
    lines=$(cat "$fifo.count")
    rm "$fifo" "$fifo.count"
    echo "$lines"
}
if [ "${1:-}" = count ]; then
    for simd in scalar neon; do
        echo "$simd: $(($(count $simd 2) - $(count $simd 1))) instructions"
    done
    exit
fi

# The registers of a row are those of the processor: only the prints count.
prints() { awk '{ print ($1 ~ /scalar|neon|avx/) ? "responses" : $1, $2 }' | sort -u; }
expected=$("$here" | prints)
echo "$expected"
# What qemu 7 lacks of Haswell, which it would say on stderr.
haswell=Haswell,-hle,-rtm,-invpcid,-tsc-deadline
for processor in Nehalem $haswell; do
    diff <(echo "$expected") <(qemu-x86_64-static -cpu $processor "$here" | prints)
    echo "the same fingerprints on $processor"
done
diff <(echo "$expected") <(qemu-aarch64-static "$there" | prints)
echo "the same fingerprints on aarch64"

build
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# The paper's run by a command, and the tests by the same command in place of the program.
paper() { "${@:2}" run --quiet --progress never --out "$folder/$1" > "$folder/$1.txt"; }
guard=$(cargo test --release --locked --test guard --no-run 2>&1 | grep -o "[^ (]*deps/guard-[0-9a-f]*")
paper here "$target/release/rockfrag"
same() {
    paper "$1" "${@:2}"
    diff -r "$folder/here" "$folder/$1"
    diff "$folder/here.txt" "$folder/$1.txt"
    printf '#!/bin/sh\nshift\nexec %s "$@"\n' "${*:2}" > "$folder/runner"
    chmod +x "$folder/runner"
    CARGO_TARGET_X86_64_UNKNOWN_LINUX_GNU_RUNNER=$folder/runner INSTA_UPDATE=no "$guard"
    echo "the same files, words and figures on $1"
}
program=$(realpath "$target")
for processor in ${1:-aarch64 avx2 nehalem}; do
    case $processor in
        aarch64) same aarch64 qemu-aarch64-static "$program/$arm/release/rockfrag" ;;
        avx2) same $haswell qemu-x86_64-static -cpu $haswell "$program/release/rockfrag" ;;
        nehalem) same Nehalem qemu-x86_64-static -cpu Nehalem "$program/release/rockfrag" ;;
    esac
done
