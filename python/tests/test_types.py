"""The package is typed, and what its stubs say of the compiled part and of the stages is so."""

import pathlib
import re
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


USE = """\
from pathlib import Path

import matplotlib.axes
import numpy as np
import rockfrag

scenarios: rockfrag.Table = rockfrag.sample_scenarios(seed=np.random.default_rng(1))
file: Path = rockfrag.synthesize_motions(scenarios, suite=["csgm"], partition=(0, 3), out="motions")
structures = [{"name": "other", "p": 2.5, "alpha": 0.2, "eta": 0.92}]
responses: rockfrag.Table = rockfrag.simulate(file, structures=structures)
responses = rockfrag.simulate(file, structures=[rockfrag.Structure.block(0.5, 2.0), rockfrag.Structure(2.5, 0.2, "housner")])
curve = rockfrag.fit_fragility([1.0, 2.0], [True, False], link="logit")
axes: matplotlib.axes.Axes = curve.plot()
rates = rockfrag.evaluate(width=0.5, height=2.0, hazard=rockfrag.datasets.load_hazard())
rockfrag.ray.simulate("motions", "responses", structures="paper")
"""
WRONG = {
    'rockfrag.fit_pro(responses, link="cauchit")': "call-overload",
    "rockfrag.simulate(responses, structure=3)": "call-overload",
    'rockfrag.synthesize_motions(scenarios, suite="record")': "arg-type",
    'rockfrag.fit_fragility([1.0], [True], estimator="bayes")': "arg-type",
    "rockfrag.Structure(2.5, 0.2)": "call-arg",
    "rockfrag.fit_curve": "attr-defined",
}


def test_a_user_is_told_of_slips_by_the_type_checker(tmp_path):
    file = tmp_path / "use.py"
    file.write_text(USE + "".join(f"{line}\n" for line in WRONG))
    check = [sys.executable, "-m", "mypy", "--config-file", CONFIG, file]
    told = subprocess.run(check, cwd=tmp_path, capture_output=True, text=True).stdout
    slips = re.findall(r"use\.py:(\d+): error: .*\[([a-z-]+)\]", told)
    first = USE.count("\n") + 1
    assert {int(line): kind for line, kind in slips} == dict(enumerate(WRONG.values(), first)), told
