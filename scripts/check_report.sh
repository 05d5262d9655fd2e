#!/usr/bin/env bash
# Looks at a report in a headless Chromium: check_report.sh ROCKFRAG DIR, where DIR holds the files of a run; then at the
# book, if scripts/build_docs.sh has built it into target/book. Needs Debian's chromium and
# chromium-driver (installed when they are missing and it may), Python with venv, and npm for axe-core. Where none of this
# can be had it says so and leaves the pages unchecked.
set -euo pipefail
rockfrag=$(realpath "$1") run=$(realpath "$2")
cd "$(dirname "$0")"

skip() {
    echo "check_report: the page is NOT checked: $1" >&2
    exit 0
}

if ! command -v chromium > /dev/null || ! command -v chromedriver > /dev/null; then
    [ "$(id -u)" = 0 ] || skip "no chromium and chromium-driver, and only root may install them"
    { apt-get update && apt-get install -y --no-install-recommends chromium chromium-driver; } > /dev/null 2>&1 ||
        skip "apt-get cannot install chromium and chromium-driver"
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet selenium || skip "pip cannot install selenium"
npm install --silent --no-fund --no-audit --prefix "$work" axe-core > /dev/null 2>&1 || skip "npm cannot install axe-core"
axe=$work/node_modules/axe-core/axe.min.js book=../target/book
"$rockfrag" report --quiet --force --in "$run" --out "$work/report/report.html"
"$work/venv/bin/python" check_book.py "$work/report" "$axe"
[ ! -d "$book" ] || "$work/venv/bin/python" check_book.py "$book" "$axe"
