#!/usr/bin/env bash
# The same bits on every processor: fingerprints (examples/fingerprints.rs) on this one, on x86-64 without and with AVX2, and on
# aarch64, the latter three under qemu; and how many instructions the solver takes on aarch64 with NEON and without.
# On Debian 12, whose cross compiler and standard library are of one version:
#     dpkg --add-architecture arm64 && apt-get update
#     apt-get install rustc-web libstd-rust-web-dev:arm64 gcc-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user-static
# Usage: scripts/processors.sh [count]      count takes ten minutes: qemu prints a line for each instruction
set -euo pipefail
cd "$(dirname "$0")/.."

arm=aarch64-unknown-linux-gnu
target=${CARGO_TARGET_DIR:-target}
build=(cargo build --release --locked --no-default-features --example fingerprints)
"${build[@]}"
RUSTC=/usr/bin/rustc CARGO_TARGET_AARCH64_UNKNOWN_LINUX_GNU_LINKER=aarch64-linux-gnu-gcc "${build[@]}" --target $arm
here=$target/release/examples/fingerprints
there=$target/$arm/release/examples/fingerprints
emulate=(qemu-aarch64-static -L /usr/aarch64-linux-gnu)

# Instructions: those of solving twice as often, less those of solving once.
count() {
    local lines fifo
    fifo=$(mktemp -u) && mkfifo "$fifo"
    grep -c '^Trace' "$fifo" > "$fifo.count" &
    "${emulate[@]}" -singlestep -d exec,nochain -D "$fifo" "$there" "$1" "$2"
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
for processor in Nehalem Haswell; do
    diff <(echo "$expected") <(qemu-x86_64-static -cpu $processor "$here" 2> /dev/null | prints)
    echo "the same on $processor"
done
diff <(echo "$expected") <("${emulate[@]}" "$there" | prints)
echo "the same on aarch64"
