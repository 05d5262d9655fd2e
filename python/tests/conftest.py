"""What the tests share: the command, and the small set of its files that both are compared on."""

import os
import pathlib
import subprocess

import pytest

COMMAND = pathlib.Path(os.environ.get("ROCKFRAG", pathlib.Path(__file__).parents[2] / "target/release/rockfrag"))

SCENARIOS = {"mw": "6.5,7.5", "re": "5,10", "samples": 10, "seed": 7}
MOTIONS = {"dt": 0.01, "seed": 7}
STRUCTURES = [
    {"name": "frame", "p": 1.0, "alpha": 0.15, "eta": 0.92},
    {"name": "electrical-equipment", "p": 2.5, "alpha": 0.20, "eta": 0.92},
]
PIPELINE = """\
seed: 7
out: out
sample-scenarios: { mw: "6.5,7.5", re: "5,10", samples: 10 }
synthesize-motions: { suite: [pulse, csgm], dt: 0.01 }
simulate:
  structures:
    - { name: frame, p: 1.0, alpha: 0.15, eta: 0.92 }
    - { name: electrical-equipment, p: 2.5, alpha: 0.20, eta: 0.92 }
fit-pex: {}
fit-pro: {}
"""


def command(folder, *arguments):
    """Runs the command in a folder."""
    subprocess.run([COMMAND, "--quiet", *map(str, arguments)], cwd=folder, check=True)


@pytest.fixture(scope="session")
def out(tmp_path_factory):
    """The files that the command makes of the small pipeline."""
    if not COMMAND.exists():
        pytest.fail(f"{COMMAND} is not there: cargo build first, or name it in ROCKFRAG")
    folder = tmp_path_factory.mktemp("command")
    (folder / "pipeline.yaml").write_text(PIPELINE)
    command(folder, "run")
    return folder / "out"
