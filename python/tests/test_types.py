"""The package is typed, and what its stub says of the compiled part is so."""

import subprocess
import sys

import pytest


@pytest.mark.parametrize(
    "check",
    [["mypy.stubtest", "rockfrag._rockfrag"], ["mypy", "--strict", "--ignore-missing-imports", "-p", "rockfrag"]],
    ids=["the stub", "the package"],
)
def test_types(check, tmp_path):
    done = subprocess.run([sys.executable, "-m", *check], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
