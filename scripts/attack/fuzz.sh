#!/usr/bin/env bash
# Fuzzes what reads files of records: fuzz.sh [SECONDS], 1200 s of processor time unless told. Any stable compiler does (and a C++
# compiler, for libFuzzer). What crashes lands in fuzz/artifacts, and belongs into tests/records with its cause.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-1200}
# Processor time so far, in seconds.
spent() {
    awk -v ticks="$(getconf CLK_TCK)" '{ print int(($14 + $15) / ticks) }' "/proc/$1/stat"
}

RUSTC_WRAPPER=$PWD/scripts/attack/counters.sh nice -n 19 cargo build --profile fuzz --locked --manifest-path fuzz/Cargo.toml
mkdir -p fuzz/corpus fuzz/artifacts
# 4500 MB are what docs/robustness.md states as the most; 5 minutes without an end are no busy machine.
nice -n 19 fuzz/target/fuzz/importers fuzz/corpus fuzz/seeds/importers -artifact_prefix=fuzz/artifacts/ \
    -rss_limit_mb=4500 -timeout=300 -max_len=65536 -print_final_stats=1 2> fuzz/artifacts/importers.log &
fuzzer=$!
while used=$(spent "$fuzzer" 2> /dev/null) && [ "$used" -lt "$seconds" ]; do
    sleep 2
done
kill -USR1 "$fuzzer" 2> /dev/null || true
wait "$fuzzer" || failed=1
grep -E '^(stat::|SUMMARY)' fuzz/artifacts/importers.log
exit "${failed:-0}"
