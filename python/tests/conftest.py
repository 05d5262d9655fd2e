"""Small tables that the tests share."""

import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

import rockfrag

BLOCK = {"width": 0.5, "height": 2.0}
FRAME = {"name": "frame", "p": 1.5, "alpha": 0.15, "eta": 0.92}


@pytest.fixture(scope="session")
def motions() -> rockfrag.Result:
    return rockfrag.synthesize_motions(rockfrag.sample_scenarios(samples=4, seed=7))


@pytest.fixture(scope="session")
def responses(motions: rockfrag.Result) -> rockfrag.Result:
    return rockfrag.simulate(motions, structure=FRAME)


@pytest.fixture
def command(tmp_path: Path) -> Callable[..., subprocess.CompletedProcess[str]]:
    """Runs the command of the wheel in the test's folder."""

    def run(*words: object) -> subprocess.CompletedProcess[str]:
        program = Path(sys.executable).with_name("rockfrag")
        return subprocess.run(
            [program, *map(str, words)], cwd=tmp_path, capture_output=True, text=True, check=False
        )

    return run


@pytest.fixture
def python(tmp_path: Path) -> Callable[[str], str]:
    """Runs a script by an interpreter of its own in the test's folder, and gives what it prints."""

    def run(script: str) -> str:
        words = [sys.executable, "-c", script]
        done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, check=False, timeout=300)
        assert done.returncode == 0, done.stderr
        return done.stdout

    return run
