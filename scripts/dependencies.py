#!/usr/bin/env python3
"""What rockfrag is made of: dependencies.py checks it, dependencies.py sbom prints it as CycloneDX, dependencies.py unsafe
counts the unsafe code in it. Only what is built into the program counts, not what tests and benchmarks need.

The check fails where a crate has a licence that is not allowed or comes from elsewhere than crates.io, where tests or the Python
package would compile it again, or where the lock file is not up to date; it names crates that are there in several versions.
"""

import json
import re
import subprocess
import sys
from pathlib import Path

ALLOWED = {
    "MIT", "Apache-2.0", "Apache-2.0 WITH LLVM-exception", "BSD-2-Clause", "BSD-3-Clause", "Zlib",
    "Unicode-3.0", "Unlicense", "BSL-1.0",
}
REGISTRY = "registry+https://github.com/rust-lang/crates.io-index"
TARGET = "x86_64-unknown-linux-gnu"
ROOT = Path(__file__).parent.parent


def cargo(*arguments):
    return subprocess.run(["cargo", *arguments, "--locked"], cwd=ROOT, check=True, capture_output=True, text=True).stdout


def packages():
    """Those of the program and its build, rockfrag itself left out: what features ask for, which the lock file goes beyond."""
    tree = cargo("tree", "--package", "rockfrag", "--edges", "normal,build", "--prefix", "none", "--target", TARGET)
    built = {tuple(line.split()[:2]) for line in tree.splitlines()}
    metadata = json.loads(cargo("metadata", "--format-version", "1", "--filter-platform", TARGET))
    found = [p for p in metadata["packages"] if (p["name"], f"v{p['version']}") in built and p["name"] != "rockfrag"]
    return sorted(found, key=lambda package: (package["name"], package["version"]))


def allowed(licence):
    """A licence expression of which one way through is allowed: no bracket in use nests."""
    alternatives = re.split(r"\s+OR\s+|/", re.sub(r"[()]", "", licence or ""))
    return any(all(part.strip() in ALLOWED for part in way.split(" AND ")) for way in alternatives)


def features(*of):
    tree = cargo("tree", *of, "--prefix", "none", "--format", "{p} {f}", "--target", TARGET)
    return {line.removesuffix(" (*)") for line in tree.splitlines()}


def compiled_twice():
    """Crates that the program needs with other features than tests and the Python package do: each would compile them again."""
    everything = features("--workspace", "--edges", "normal,build,dev")
    return sorted(features("--package", "rockfrag", "--edges", "normal,build") - everything)


def check(found):
    wrong = [f"{line}: tests and the Python package need other features, so that it is compiled again" for line in compiled_twice()]
    wrong += [f"{p['name']} {p['version']}: licence {p['license']}" for p in found if not allowed(p["license"])]
    wrong += [f"{p['name']} {p['version']}: from {p['source']}" for p in found if p["source"] != REGISTRY]
    versions = {}
    for package in found:
        versions.setdefault(package["name"], []).append(package["version"])
    doubled = {name: sorted(all) for name, all in versions.items() if len(all) > 1}
    print(f"{len(found)} crates; in several versions: " + (", ".join(f"{n} {' '.join(v)}" for n, v in doubled.items()) or "none"))
    for line in wrong:
        print(line, file=sys.stderr)
    return 1 if wrong else 0


def sbom(found):
    lock = (ROOT / "Cargo.lock").read_text()
    sums = {(n, v): c for n, v, c in re.findall(r'name = "([^"]+)"\nversion = "([^"]+)"\nsource = "[^"]+"\nchecksum = "([0-9a-f]+)"', lock)}
    own = re.search(r'^version = "([^"]+)"', (ROOT / "Cargo.toml").read_text(), re.M).group(1)
    component = lambda p: {
        "type": "library", "name": p["name"], "version": p["version"], "purl": f"pkg:cargo/{p['name']}@{p['version']}",
        "licenses": [{"expression": (p["license"] or "").replace("/", " OR ")}],
        "hashes": [{"alg": "SHA-256", "content": sums[p["name"], p["version"]]}],
    }
    root = {"type": "application", "name": "rockfrag", "version": own, "purl": f"pkg:cargo/rockfrag@{own}"}
    document = {"bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1, "metadata": {"component": root},
                "components": [component(p) for p in found]}
    print(json.dumps(document, indent=1))
    return 0


def unsafe(found):
    """Rough: the word in the crate's source, comments aside."""
    word = re.compile(r"\bunsafe\b")
    counts = []
    for package in found:
        sources = Path(package["manifest_path"]).parent.glob("src/**/*.rs")
        lines = (line.split("//")[0] for source in sources for line in source.read_text(errors="replace").splitlines())
        counts.append((sum(len(word.findall(line)) for line in lines), package["name"], package["version"]))
    counts.sort(reverse=True)
    print("\n".join(f"{count:6} {name} {version}" for count, name, version in counts if count))
    print(f"{sum(1 for count, *_ in counts if not count)} of {len(counts)} crates have none; rockfrag itself denies it")
    return 0


what = sys.argv[1] if len(sys.argv) > 1 else "check"
sys.exit({"check": check, "sbom": sbom, "unsafe": unsafe}[what](packages()))
