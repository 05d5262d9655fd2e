#!/usr/bin/env bash
# Fuzzes what reads files: fuzz.sh [SECONDS], 1200 for each target (with cargo-fuzz and a nightly compiler). What crashes
# lands in fuzz/artifacts, and belongs into tests/robust with its cause.
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-1200}
seeds() {
    case $1 in
        tables) echo tests/reference/files tests/reference/bombs ;;
        *) echo "fuzz/seeds/$1" ;;
    esac
}
for target in importers configs tables; do
    mkdir -p "fuzz/corpus/$target"
    # 3 GB are more than any file of this size may take; a quarter of a minute is no endless loop on a busy machine.
    # shellcheck disable=SC2046
    nice -n 19 cargo +nightly fuzz run "$target" "fuzz/corpus/$target" $(seeds "$target") -- \
        -max_total_time="$seconds" -rss_limit_mb=3000 -timeout=15 -max_len=65536 -print_final_stats=1
done
