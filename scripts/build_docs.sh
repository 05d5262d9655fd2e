#!/usr/bin/env bash
# Builds the book of docs/, with each warning an error: build_docs.sh ROCKFRAG [OUT], by default into target/book. The
# reference of commands and columns comes from the program and the source.
set -euo pipefail
rockfrag=$(realpath "$1") out=$(realpath -m "${2:-target/book}")
cd "$(dirname "$0")/.."

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check -r docs/requirements.txt
cp -r docs Cargo.toml CHANGELOG.md "$work"
python3 scripts/docs_reference.py "$rockfrag" "$work/docs/reference"
"$work/venv/bin/sphinx-build" --quiet --fail-on-warning --keep-going --jobs auto "$work/docs" "$out"
echo "open $out/index.html"
