"""Probabilities by the universal surface: those of the command, of any shape."""

import json
import pickle
import subprocess
import warnings

import numpy as np
import pytest
from conftest import COMMAND

import rockfrag


def answered(*arguments):
    call = [COMMAND, "evaluate", "--quiet", "--format", "json", "--model", "universal", *map(str, arguments)]
    rows = json.loads(subprocess.run(call, check=True, capture_output=True, text=True).stdout)["rows"]
    return {row["quantity"]: row for row in rows}


@pytest.mark.parametrize("suite", ["csgm", "pulse", "hfc"])
def test_answers_are_those_of_the_command(suite):
    pga, pgv = np.array([0.1, 0.4, 0.9]), np.array([0.2, 0.6, 0.8])
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        said = rockfrag.probability(width=0.5, height=2.0, pga=pga, pgv=pgv, suite=suite, limit_state=0.2)
    for k in range(3):
        rows = answered("--width", 0.5, "--height", 2.0, "--pga", pga[k], "--pgv", pgv[k], "--suite", suite, "--limit-state", 0.2)
        for name in ("p_nr", "p_ex", "p_ro", "p_f"):
            value = rows[name]["value"]
            assert np.isnan(getattr(said, name)[k]) if value is None else getattr(said, name)[k] == pytest.approx(value, abs=1e-12)
        if rows["p_ro"]["low"] is not None:
            assert said.p_ro_low[k] == pytest.approx(rows["p_ro"]["low"], abs=1e-12)
            assert said.p_ro_high[k] == pytest.approx(rows["p_ro"]["high"], abs=1e-12)


def test_arrays_broadcast_and_a_number_is_a_number():
    grid = rockfrag.probability(p=2.5, alpha=0.2, eta=0.92, pga=np.linspace(0.3, 0.9, 4)[:, None], pgv=np.linspace(0.3, 0.9, 5))
    assert grid.p_ro.shape == grid.distance.shape == (4, 5)
    one = rockfrag.probability(p=2.5, alpha=0.2, eta=0.92, pga=0.3, pgv=0.3)
    assert one.p_ro.shape == () and float(one.p_ro) == grid.p_ro[0, 0]
    assert np.all((grid.p_ro_low < grid.p_ro) & (grid.p_ro < grid.p_ro_high))


def test_what_cannot_be_right_is_said():
    with pytest.warns(rockfrag.RockfragWarning, match="m/s2 in place of g"):
        rockfrag.probability(width=0.5, height=2.0, pga=4.9, pgv=0.6)
    with pytest.warns(rockfrag.RockfragWarning, match="in cm"):
        rockfrag.probability(width=50, height=200, pga=0.5, pgv=0.6)
    for wrong in ({"width": 600.0, "height": 2400.0}, {"p": 2.5}, {"width": 2.0, "height": 0.5}):
        with pytest.raises(rockfrag.OptionError):
            rockfrag.probability(pga=0.5, pgv=0.6, **wrong)
    with pytest.raises(rockfrag.OptionError):
        rockfrag.probability(width=0.5, height=2.0, pga=[0.5, 0.6], pgv=[0.5, 0.6, 0.7])


def test_answers_compare_and_travel():
    ask = {"width": 0.5, "height": 2.0, "pga": [0.1, 0.5], "pgv": 0.6}
    one = rockfrag.probability(**ask)
    assert one == pickle.loads(pickle.dumps(one)) and one != rockfrag.probability(**{**ask, "pgv": 0.5})
    assert isinstance(rockfrag.probability(**{**ask, "pga": 0.5}).p_f, float)
