#!/usr/bin/env bash
# Fuzzes what reads files: fuzz.sh [SECONDS [TARGET...]], 1200 s of processor time for each target. Any stable compiler does
# (and a C++ compiler, for libFuzzer). What crashes lands in fuzz/artifacts, and belongs into tests/robust with its cause.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-1200}
shift || true
targets=("${@:-importers configs tables}")
seeds() {
    case $1 in
        tables) echo tests/reference/files tests/reference/bombs ;;
        *) echo "fuzz/seeds/$1" ;;
    esac
}
# Processor time so far, in seconds.
spent() {
    awk -v ticks="$(getconf CLK_TCK)" '{ print int(($14 + $15) / ticks) }' "/proc/$1/stat"
}

RUSTC_WRAPPER=$PWD/scripts/attack/counters.sh nice -n 19 cargo build --profile fuzz --locked --manifest-path fuzz/Cargo.toml
# shellcheck disable=SC2068
for target in ${targets[@]}; do
    mkdir -p "fuzz/corpus/$target" "fuzz/artifacts/$target"
    # 4500 MB are what docs/robustness.md states as the most; 5 minutes without an end are no busy machine.
    # shellcheck disable=SC2046
    nice -n 19 "fuzz/target/fuzz/$target" "fuzz/corpus/$target" $(seeds "$target") -artifact_prefix="fuzz/artifacts/$target/" \
        -rss_limit_mb=4500 -timeout=300 -max_len=65536 -print_final_stats=1 2> "fuzz/artifacts/$target.log" &
    fuzzer=$!
    while used=$(spent "$fuzzer" 2> /dev/null) && [ "$used" -lt "$seconds" ]; do
        sleep 2
    done
    kill -USR1 "$fuzzer" 2> /dev/null || true
    wait "$fuzzer" || failed=1
    grep -E '^(stat::|SUMMARY)' "fuzz/artifacts/$target.log" | sed "s/^/$target /"
done
exit "${failed:-0}"
