#!/usr/bin/env bash
# The files of this version of rockfrag that all later ones must read: files.sh ROCKFRAG FOLDER. They are made once for each
# format, and never again.
set -euo pipefail
rockfrag=$(realpath "$1")
mkdir -p "$2"
cd "$2"
call() { "$rockfrag" --quiet --force "$@"; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

cat > "$work/structures.yaml" <<'YAML'
- { name: frame, p: 1.0, alpha: 0.15, eta: 0.92 }
- { name: electrical-equipment, p: 2.5, alpha: 0.20, eta: 0.92 }
YAML
# The fits need more motions than are kept.
call sample-scenarios --seed 7 --mw 6.5,7.5 --re 5,10 --samples 30 --out "$work/scenarios.parquet"
call synthesize-motions --in "$work/scenarios.parquet" --suite csgm --dt 0.02 --out "$work/motions.parquet"
call simulate --in "$work/motions.parquet" --structures "$work/structures.yaml" --out responses.parquet
call fit-pex --in responses.parquet --bootstrap 20 --out pex.parquet
call fit-pro --in responses.parquet --bootstrap 20 --out pro.parquet
call compare-paper --pex pex.parquet --pro pro.parquet --responses responses.parquet --out paper.parquet > "$work/paper.txt"
call validate --in responses.parquet --pex pex.parquet --pro pro.parquet --out validation.parquet > validation.txt
call evaluate --pex pex.parquet --pro pro.parquet --structure electrical-equipment --p 2.5 --alpha 0.20 \
    --pga 0.5 --pgv 0.6 > evaluate.txt

call sample-scenarios --seed 7 --mw 6.5 --re 5 --samples 2 --out scenarios.parquet
call synthesize-motions --in scenarios.parquet --dt 0.05 --out motions.parquet
call simulate --in motions.parquet --p 2.5 --alpha 0.2 --eta 0.92 --trace 0 --out traced.parquet
awk 'BEGIN { for (k = 0; k < 400; k++) print k * 0.01, 0.5 * sin(k * k / 900) }' > "$work/record.txt"
call import-motions "$work/record.txt" --unit g --accept-implausible --out records.parquet

# Of the stages that came later, from the files above.
call ida --in motions.parquet --from 1 --to 3 --steps 4 --p 2.5 --alpha 0.2 --eta 0.92 --out ida.parquet
call rank-ims --in responses.parquet --terms 1 --folds 4 --out ranking.parquet > "$work/ranking.txt"
call universality --in responses.parquet --out universality.parquet > "$work/universality.txt"
fits="--pex pex.parquet --pro pro.parquet --structure electrical-equipment --p 2.5 --alpha 0.20"
# shellcheck disable=SC2086
call evaluate $fits --in motions.parquet --out evaluated.parquet
for part in 0 1; do
    call synthesize-motions --in scenarios.parquet --suite pulse --dt 0.05 --partition $part/2 --out motions
done
