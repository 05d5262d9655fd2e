#!/usr/bin/env bash
# Holds the exports against OpenQuake and pelicun themselves: scripts/check_exports.sh ROCKFRAG
# ROCKFRAG is the binary. Each program is installed from PyPI into an environment of its own,
# which is removed afterwards; without a registry the check is skipped, and says so.
set -euo pipefail
cd "$(dirname "$0")/.."
rockfrag=$(realpath "$1")

python=$(mktemp -d)
trap 'rm -rf "$python"' EXIT
for program in openquake pelicun; do
    python3 -m venv "$python/$program"
done
if ! "$python/pelicun/bin/pip" download --quiet --no-deps --dest "$python" pelicun==3.10.0 2> "$python/refusal"; then
    echo "check_exports: SKIPPED, no package registry to install OpenQuake and pelicun from: $(tail -n 1 "$python/refusal")"
    exit 0
fi

"$python/pelicun/bin/pip" install --quiet pelicun==3.10.0
"$python/pelicun/bin/python" scripts/check_exports.py "$rockfrag" pelicun

# The engine alone, and what its reader and its fragility functions import: all it asks for includes GDAL, which pip would
# have to compile.
"$python/openquake/bin/pip" install --quiet --no-deps openquake.engine==3.26.2
"$python/openquake/bin/pip" install --quiet 'numpy<2.3' scipy pandas h5py psutil toml 'decorator~=5.1.1' 'numba~=0.61.2' \
    shapely 'pyproj~=3.7.2' requests h3 'alpha_shapes~=1.1.0' 'pyzmq~=26.0' 'fiona~=1.10.1' 2> "$python/conflicts" ||
    { cat "$python/conflicts" >&2; exit 1; }
"$python/openquake/bin/python" scripts/check_exports.py "$rockfrag" openquake
