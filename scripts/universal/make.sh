#!/usr/bin/env bash
# The universal surface made again: scripts/universal/make.sh ROCKFRAG FOLDER. Needs Python with numpy, scipy, scikit-learn and polars;
# about an hour on one core, 2 GB of memory and 1 GB of disk.
set -euo pipefail
rockfrag=$(realpath "$1") here=$(dirname "$(realpath "$0")") root=$(realpath "$(dirname "$0")/../..")
mkdir -p "$2" && cd "$2"
call() { "$rockfrag" --config "$root/data/universal.yaml" --quiet "$@"; }

call sample-scenarios --out scenarios.parquet
call synthesize-motions --in scenarios.parquet --out rock.parquet
call synthesize-motions --in scenarios.parquet --out soil.parquet --suite csgm,hfc --site soil --seed 2
python3 "$here/motions.py" rock.parquet soil.parquet motions.parquet

# In parts: one is held in memory at a time.
python3 "$here/structures.py" structures.csv
for part in 0 1 2 3 4; do
    { head -1 structures.csv; tail -n +2 structures.csv | sed -n "$((64 * part + 1)),$((64 * part + 64))p"; } > part.csv
    call simulate --in motions.parquet --structures part.csv --out "responses_$part.parquet"
done
{ head -1 structures.csv; tail -1 structures.csv; } > part.csv
call simulate --in motions.parquet --structures part.csv --out equipment.parquet

python3 "$here/fit.py" "$root/data/universal.csv" "$root/tests/reference/fits/universal_answers.csv" motions.parquet responses_?.parquet
python3 "$here/peaks.py" "$root/data/universal.csv" rock.parquet soil.parquet

# How well it does, for docs/universal.md; on records with a file of scripts/near_fault_records.py:
#     python3 judge.py motions.parquet equipment.parquet judged.json responses_?.parquet
#     python3 compare.py motions.parquet responses_?.parquet
#     simulate --in records.parquet --structures structures.csv --out records_responses.parquet
#     python3 records.py motions.parquet equipment.parquet records_responses.parquet
