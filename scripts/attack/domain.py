#!/usr/bin/env python3
"""The domain modules and their tests as a crate of its own, which builds in seconds: domain.py FOLDER (needs pyarrow).

    scripts/attack/domain.py /tmp/domain && cd /tmp/domain
    export PROPTEST_CASES=64
    cargo mutants --in-place --file 'src/rocking/**' --cargo-test-arg=--test=solver
    cargo mutants --in-place --file 'src/fragility/**' --file 'src/normal/**' --cargo-test-arg=--test=fits
    RUSTFLAGS=-Cinstrument-coverage cargo test

Files are copies. Tests are joined into a binary a subject, since a mutant costs hardly more than links and what runs. What
they read from Parquet files is laid beside them as text, so that nothing here needs Arrow. Real records, which stand beside
the repository if anywhere, are copied to the same place beside the folder.
"""

import re
import sys
import tomllib
from pathlib import Path

import pyarrow.parquet as parquet

MODULES = ["export", "fragility", "hazard", "keyword", "motion", "normal", "random", "rocking", "units", "wide"]
TESTS = {
    "solver": ["rocking", "incremental", "solver_truth", "solver_paths", "robust/numbers"],
    "motions": ["intensity", "motion_model", "records/main"],
    "fits": ["normal", "hazard", "validation", "universality", "export", "evaluate", "fits", "fits_limits", "uncertainty/main", "incremental", "coverage"],
}
DEPENDENCIES = [
    "anyhow", "blake3", "csv", "libm", "nalgebra", "pulp", "rand", "rand_chacha", "rand_distr", "rayon", "realfft", "serde", "serde_json",
    "strsim", "thiserror",
]
PROFILE = """
[profile.dev]
debug = 0
incremental = false
opt-level = 1

[profile.dev.package."*"]
opt-level = 2
"""
# What tests ask of the reader of motions, of the text that lies beside the file.
MOTIONS = """\
#![allow(missing_docs)]
use std::path::Path;

pub struct Motion {
    pub motion_id: String,
    pub dt_s: f64,
    pub acceleration_m_s2: Vec<f64>,
}

pub struct MotionBatches;

impl MotionBatches {
    #[allow(clippy::new_ret_no_self)]
    pub fn open(path: impl AsRef<Path>, _: usize) -> std::io::Result<std::vec::IntoIter<std::io::Result<Vec<Motion>>>> {
        let text = std::fs::read_to_string(path.as_ref().with_extension("txt"))?;
        let motion = |line: &str| {
            let mut words = line.split(' ');
            let mut word = || words.next().unwrap().to_string();
            let (motion_id, dt_s) = (word(), word().parse().unwrap());
            Motion { motion_id, dt_s, acceleration_m_s2: words.map(|number| number.parse().unwrap()).collect() }
        };
        Ok(vec![Ok(text.lines().map(motion).collect())].into_iter())
    }
}
"""


def write(to: Path, content: bytes) -> None:
    """A file that is as it was keeps its time: what did not change is not compiled again."""
    if not to.exists() or to.read_bytes() != content:
        to.parent.mkdir(parents=True, exist_ok=True)
        to.write_bytes(content)


def copy(source: Path, target: Path) -> None:
    for file in [source] if source.is_file() else (path for path in source.rglob("*") if path.is_file()):
        write(target / file.relative_to(source), file.read_bytes())


def modules_of(test: Path) -> list[Path]:
    """A test file, or the modules that a folder's main.rs joins."""
    if test.name != "main.rs":
        return [test]
    return [test.with_name(f"{name}.rs") for name in re.findall(r"^mod (\w+);", test.read_text(), re.MULTILINE)]


def write_motions(file: Path) -> None:
    rows = parquet.read_table(file, columns=["motion_id", "dt_s", "acceleration_m_s2"]).to_pylist()
    lines = [" ".join(map(str, [row["motion_id"], row["dt_s"], *row["acceleration_m_s2"]])) for row in rows]
    write(file.with_suffix(".txt"), "\n".join(lines).encode())


def main() -> None:
    repository, crate = Path(__file__).resolve().parents[2], Path(sys.argv[1]).resolve()
    for name in MODULES:
        source = repository / "src" / name
        source = source if source.is_dir() else source.with_suffix(".rs")
        copy(source, crate / "src" / source.name)
    copy(repository / "tests", crate / "tests")
    if not (crate / "Cargo.lock").exists():
        copy(repository / "Cargo.lock", crate / "Cargo.lock")
    records = crate.parent / "shared/records"
    copy(repository.parent / "shared/records", records)
    for file in [crate / "tests/reference/rocking/motions.parquet", *records.glob("*.parquet")]:
        write_motions(file)

    visible = {name: "mod" if name == "wide" else "pub mod" for name in MODULES}
    library = "".join(f"{kind} {name};\n" for name, kind in visible.items())
    library += "pub mod table {\n    pub mod motions;\n}\n"
    write(crate / "src/lib.rs", library.encode())
    write(crate / "src/table/motions.rs", MOTIONS.encode())

    manifest = (repository / "Cargo.toml").read_text()
    line = {name: re.search(rf"^{name} = .*$", manifest, re.MULTILINE)[0] for name in [*DEPENDENCIES, "proptest"]}
    package = tomllib.loads(manifest)["package"]
    text = f'[package]\nname = "rockfrag"\nversion = "{package["version"]}"\nedition = "{package["edition"]}"\nautotests = false\n'
    text += "\n[dependencies]\n" + "\n".join(line[name] for name in DEPENDENCIES)
    text += f"\n\n[dev-dependencies]\n{line['proptest']}\n"
    for subject, tests in TESTS.items():
        files = [module for test in tests for module in modules_of(repository / f"tests/{test}.rs")]
        joined = [f'#[path = "{file.relative_to(repository / "tests")}"]\nmod {file.stem};\n' for file in files]
        write(crate / f"tests/{subject}_joined.rs", "".join(joined).encode())
        text += f'\n[[test]]\nname = "{subject}"\npath = "tests/{subject}_joined.rs"\n'
    write(crate / "Cargo.toml", (text + PROFILE + "\n[workspace]\n").encode())


if __name__ == "__main__":
    main()
