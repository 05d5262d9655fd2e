#!/usr/bin/env bash
# Makes a page of each kind with the shipped data: pages.sh PROGRAM FOLDER. The paper's is made by `rockfrag run`.
set -euo pipefail
program=$(realpath "$1")
scripts=$(realpath "$(dirname "$0")")
data=$scripts/../data
mkdir -p "$2" && cd "$2"
hazard=$data/hazard.csv,$data/hazard_sa.csv
call() { "$program" "$@" --quiet --force > /dev/null; }
evaluate() { call evaluate --hazard "$hazard" "$@"; }

evaluate --structure "name=Display case,width=0.5,height=1.9" --target 1% --out object.html
cat > objects.csv <<'CSV'
name,width (cm),depth (cm),height (cm),floor,storeys,anchored
Vase,22,22,70,3,5,no
Statue,45,40,170,G,5,no
Display case 1,50,50,190,G,5,no
Display case 2,60,60,190,3,5,no
Server rack,60,100,200,3,5,no
Bookcase,35,90,210,5,5,no
Filing cabinet,46,62,132,3,5,no
Bust on a pedestal,40,40,165,G,5,no
Autoclave,70,80,180,G,5,bolted
Oxygen cylinder,24,24,150,G,5,no
Switchgear,80,60,220,G,5,no
Vending machine,90,80,183,G,5,no
Fridge,60,65,185,5,5,no
Pallet stack,80,120,240,G,5,no
Low chest,120,60,60,G,5,no
CSV
evaluate --structures objects.csv --target 2% --out list.html
sed -e 's/,35,90,210,/,50,90,210,/; s/^Vase,22,22,70,3/Vase,22,22,70,G/; s/,45,40,170,/,60,60,170,/' objects.csv > changed.csv
evaluate --structures objects.csv --target 2% --out before.parquet
evaluate --structures changed.csv --target 2% --out after.parquet
call report --in before.parquet,after.parquet --out compared.html
evaluate --structure "name=Display case,width=0.5,height=1.9" --out object.png
evaluate --structures objects.csv --out list.xlsx
call sample-scenarios --mw 7 --re 5 --samples 12 --out scenarios.parquet
call synthesize-motions --suite csgm --in scenarios.parquet --out motions.parquet
call simulate --in motions.parquet --width 0.5 --height 1.9 --trace all --out responses.parquet
call report --in responses.trace.parquet --out responses.html
call simulate --in motions.parquet --width 0.5 --height 1.9 --trace 1 --out response.parquet
call report --in response.trace.parquet --out response.html
test "$(wc -c < response.html)" -le 200000

# The records of README.
mkdir -p tour && cd tour
python3 "$scripts/example_records.py" records
call import-motions records --out motions.parquet
call simulate --in motions.parquet --width 0.4 --height 1.6 --out responses.parquet
for event in pro pex; do call fit-$event --in responses.parquet --out $event.parquet; done
call ida --in motions.parquet --width 0.4 --height 1.6 --measure im5 --out ida.parquet
call report --in . --out ../tour.html
