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


def test_overturning_of_all_motions_is_nothing_without_rocking():
    said = rockfrag.probability(width=0.5, height=2.0, pga=[0.1, 0.5], pgv=0.6)
    assert said.p_o[0] == said.p_o_low[0] == said.p_o_high[0] == 0.0 and np.isnan(said.p_ro[0])
    assert (said.p_o[1], said.p_o_low[1], said.p_o_high[1]) == (said.p_ro[1], said.p_ro_low[1], said.p_ro_high[1])
    frame = said.to_pandas()
    assert len(frame) == 2 and frame["p_f"].tolist() == said.p_f.tolist()


@pytest.mark.parametrize(
    "wrong, message",
    [
        ({"pga": np.ma.array([0.3, 0.5], mask=[False, True])}, "pga has 1 masked values; expected numbers"),
        ({"pga": [True, False]}, "pga: case 0 is True; expected numbers"),
        ({"pgv": np.array([True])}, "pgv: case 0 is True; expected numbers"),
        ({"pga": [0.5, 0.6], "pgv": [0.5, 0.6, 0.7]}, r"shapes do not go together: pga \(2,\), pgv \(3,\)"),
        ({"height": None}, "width without height; expected a Structure"),
        ({"width": None, "height": None, "p": 2.0, "alpha": 0.2}, "p and alpha without eta; expected a Structure"),
    ],
)
def test_what_is_no_number_or_missing_is_named(wrong, message):
    with pytest.raises(rockfrag.OptionError, match=message):
        rockfrag.probability(**{"width": 0.5, "height": 2.0, "pga": 0.5, "pgv": 0.6, **wrong})


def test_no_mask_is_no_harm():
    plain = rockfrag.probability(width=0.5, height=2.0, pga=[0.3, 0.5], pgv=0.6)
    assert rockfrag.probability(width=0.5, height=2.0, pga=np.ma.array([0.3, 0.5]), pgv=0.6) == plain


def test_without_a_velocity_there_is_no_probability_as_for_the_command():
    assert answered("--width", 0.5, "--height", 2.0, "--pga", 0.5, "--pgv", 0)["p_f"]["value"] is None
    ask = lambda pga, pgv: rockfrag.probability(width=0.5, height=2.0, pga=pga, pgv=pgv)
    with pytest.warns(rockfrag.RockfragWarning, match="^the surface needs a velocity: give pgv above 0$"):
        assert np.isnan(ask(0.5, 0.0).p_f)
    with pytest.warns(rockfrag.RockfragWarning, match="^2 of 4, the first element 2: the surface needs a velocity"):
        said = ask(0.5, [0.6, 0.5, 0.0, 0.0])
    assert np.isnan(said.p_f).tolist() == [False, False, True, True]
    with pytest.warns(rockfrag.RockfragWarning, match=r"^1 of 4, the first element \(1, 0\): the surface"):
        ask(np.array([[0.4], [0.5]]), np.array([[0.6, 0.5], [0.0, 0.7]]))
    # What does not move neither overturns nor fails, and needs no velocity.
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert ask([0.0, 0.1], 0.0).p_f.tolist() == [0.0, 0.0]


@pytest.mark.parametrize(
    "wrong, message",
    [
        ({"pga": [0.5, 0.4, -1.0, -2.0]}, "^element 2: pga is -1; expected 0 g or more, up to 20"),
        ({"pga": [[0.5], [None]], "pgv": [0.5, 0.6]}, r"^element \(1, 0\): pga is NaN"),
        ({"width": [0.5, -1.0]}, "^element 1: structure .*: width is -1"),
        ({"pgv": -1.0}, "^pgv is -1"),
    ],
)
def test_an_element_that_cannot_be_is_named(wrong, message):
    with pytest.raises(rockfrag.OptionError, match=message):
        rockfrag.probability(**{"width": 0.5, "height": 2.0, "pga": 0.5, "pgv": 0.6, **wrong})


def test_answers_are_shown_in_words_with_their_limits():
    one = rockfrag.probability(width=0.5, height=2.0, pga=0.5, pgv=0.6)
    limits = f"{one.p_ro:.4g} ({one.p_ro_low:.4g} to {one.p_ro_high:.4g})"
    for text in (repr(one), one._repr_html_()):
        assert limits in text and "overturning, given rocking" in text and "95 % limits" in text
    many = repr(rockfrag.probability(width=0.5, height=2.0, pga=np.linspace(0.1, 0.9, 9), pgv=0.6))
    assert "of shape (9,)" in many and "[3]" in many and "[4]" not in many and many.endswith("and 5 more")
    assert len(many.splitlines()) < 10 and " - " in many and "nan" not in many
