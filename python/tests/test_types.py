"""The package is typed, and what its stubs say of the compiled part and of the stages is so."""

import pathlib
import subprocess
import sys

import pytest
import rockfrag
from rockfrag._stub import stub


CONFIG = str(pathlib.Path(__file__).parents[1] / "pyproject.toml")


@pytest.mark.parametrize(
    "check",
    [
        ["mypy.stubtest", "--mypy-config-file", CONFIG, "rockfrag._rockfrag", "rockfrag._stages"],
        ["mypy", "--config-file", CONFIG, "-p", "rockfrag"],
    ],
    ids=["the stubs", "the package"],
)
def test_types(check, tmp_path):
    done = subprocess.run([sys.executable, "-m", *check], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_stub_of_the_stages_is_up_to_date():
    file = pathlib.Path(rockfrag.__file__).with_name("_stages.pyi")
    assert file.read_text() == stub(), "python -m rockfrag._stub > python/python/rockfrag/_stages.pyi"
