"""What a call does besides its result: pictures, interrupts, processes, warnings, what it refuses."""

import copy
import os
import pickle
from pathlib import Path

import matplotlib
import numpy as np
import pandas
import polars
import pytest
from conftest import BLOCK, FRAME

import rockfrag

matplotlib.use("Agg")

SINE = 4.0 * np.sin(2 * np.pi * np.arange(0, 1.2, 0.01) / 1.2)


def test_a_response_is_drawn_and_shows_itself():
    response = rockfrag.Object(**BLOCK).response(SINE, 0.01)
    end = np.interp(1.19, response.time, response.ground_velocity)
    assert end == pytest.approx(np.trapezoid(SINE, dx=0.01), abs=1e-9)
    rotation, ground = response.plot()
    assert any(np.array_equal(line.get_ydata(), response.theta_over_alpha) for line in rotation.lines)
    assert any(np.array_equal(line.get_ydata(), response.ground_acceleration) for line in ground.lines)
    assert len(repr(response)) < 200 and "<svg" in response._repr_html_()


def test_curves_are_drawn():
    pga, asked = np.linspace(0.2, 2.0, 20), rockfrag.Object(**BLOCK)
    curve = asked.probability(pga, 0.55 * pga)
    assert np.array_equal(curve.plot().lines[0].get_ydata(), curve.p_overturning)
    assert len(repr(curve).splitlines()) == 3 and "<svg" in curve._repr_html_()
    fit = rockfrag.fit_fragility(np.linspace(0.2, 1.5, 40), np.arange(40) * 7 % 40 < np.arange(40))
    assert np.allclose(fit.plot(pga).lines[0].get_ydata(), fit.probability(pga))
    with pytest.raises(ValueError, match="no curve"):
        rockfrag.fit_fragility([1.0, 2.0], [0, 1]).plot()
    with pytest.raises(ValueError, match="no curve"):
        asked.probability(0.5, 0.6).plot()


def test_the_fragility_of_an_object_is_that_of_evaluate_and_is_drawn():
    for over, unit in [("pga", "g"), ("pgv", "m/s")]:
        curve = rockfrag.fragility(**BLOCK, over=over, magnitude=6.5)
        assert all(np.diff(curve.intensity) > 0) and all(curve.p_overturning <= curve.p_failure + 1e-9)
        rows = rockfrag.evaluate(**BLOCK, over=over, magnitude=6.5).to_polars()
        assert np.allclose(rows["p_overturning_low"], curve.p_overturning_low, rtol=1e-12)
        assert rows["overturning_beta"][0] == pytest.approx(curve.row["overturning_beta"], rel=1e-12)
        drawn = curve.plot()
        assert unit in drawn.get_xlabel() and np.array_equal(drawn.lines[0].get_ydata(), curve.p_overturning)
    assert "half of the motions" in repr(curve) and "<svg" in curve._repr_html_()


@pytest.mark.parametrize(
    ("module", "call"),
    [
        ("matplotlib", "rockfrag.Object(width=0.5, height=2.0).response([0.1, 0.2], 0.01).plot()"),
        ("pyarrow", "rockfrag.sample_scenarios(samples=1).to_pandas()"),
        ("pandas", "rockfrag.sample_scenarios(samples=1).to_pandas()"),
        ("polars", "rockfrag.sample_scenarios(samples=1).to_polars()"),
    ],
)
def test_what_is_not_installed_is_named(python, module, call):
    told = python(f"""
import sys
sys.modules[{module!r}] = None
import rockfrag
assert "<svg" not in rockfrag.fragility(width=0.5, height=2.0)._repr_html_() or {module!r} != "matplotlib"
try:
    {call}
except ImportError as error:
    print(error)
""")
    assert told.startswith(f"{module} is not installed: pip install {module}")


def test_a_result_is_a_frame_of_pandas_and_a_cell_of_a_notebook(responses):
    frame = pandas.DataFrame(responses)
    # A column without a value has no type.
    known, same = frame.dropna(axis=1, how="all"), responses.to_pandas().dropna(axis=1, how="all")
    pandas.testing.assert_frame_equal(known, same, check_dtype=False)
    assert list(frame.columns) == responses.to_polars().columns
    assert responses.summary.splitlines()[0] in responses._repr_html_()


def test_a_pickled_result_is_whole_or_refused(tmp_path, motions):
    made = rockfrag.simulate(motions, structure=FRAME, out=tmp_path / "responses.parquet", trace=["0"])
    again = pickle.loads(pickle.dumps(made))
    assert again.to_polars().equals(made.to_polars())
    assert again.part("trace").to_polars().equals(made.part("trace").to_polars())
    temporary = rockfrag.simulate(motions, structure=FRAME, trace=["0"])
    for result in (temporary, temporary.part("trace")):
        with pytest.raises(TypeError, match="expected a result with out="):
            pickle.dumps(result)
    copies = copy.copy(temporary), copy.deepcopy(temporary)
    table = temporary.to_polars()
    del temporary
    assert all(each.to_polars().equals(table) for each in copies)


@pytest.mark.filterwarnings("error")
def test_errors_and_warnings_as_errors_leave_no_folder(tmp_path, monkeypatch, motions):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with pytest.raises(ValueError):
        rockfrag.evaluate(pga=0.5, pgv=0.6)
    with pytest.raises(UserWarning):
        rockfrag.simulate(motions, p=1.5, alpha=0.15, eta=0.3)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
@pytest.mark.parametrize(
    "call",
    [
        "rockfrag.fit_fragility(im, numpy.random.default_rng(1).random(20_000) < im / 3)",
        "rockfrag.Object(width=0.5, height=2.0).probability(im[:100], 0.5)",
    ],
)
def test_a_forked_process_is_refused(python, call):
    script = f"""
import os, numpy, rockfrag
im = numpy.linspace(0.1, 3, 20_000)
{call}
pid = os.fork()
if pid == 0:
    try:
        {call}
    except rockfrag.Error as error:
        os._exit(7 if "spawn" in str(error) else 1)
    os._exit(2)
print(os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1]))
"""
    assert python(script) == "7\n"


@pytest.mark.parametrize(
    "call",
    [
        "rockfrag.evaluate(structures=frame, hazard='hazard.csv')",
        "rockfrag.export(to='openquake', structures=frame, out='x.xml')",
        "rockfrag.evaluate(rows, width=0.5, height=2.0, out='e.parquet')",
        "rockfrag.sample_scenarios(samples=500_000)",
        "rockfrag.ida(MOTIONS, out='ida.parquet', p=1.5, alpha=0.15, eta=0.92, steps=600)",
    ],
)
def test_an_interrupt_is_heard_within_a_second(tmp_path, python, motions, call):
    (tmp_path / "hazard.csv").write_bytes((Path(__file__).parents[2] / "data/hazard.csv").read_bytes())
    heard = python(f"""
import os, signal, time, pandas, rockfrag
number = range(3000)
frame = pandas.DataFrame(dict(name=[f"object {{k}}" for k in number],
    width=[0.3 + 1e-4 * k for k in number], height=[2.0] * len(number)))
rows = pandas.DataFrame(dict(pga_g=[0.2 + 1e-5 * k for k in range(60_000)], pgv_m_s=0.5))
seen = []
def progress(done, total):
    if done and not seen:
        # Of the processor, whatever else the machine does.
        seen.append(time.process_time())
        os.kill(os.getpid(), signal.SIGINT)
try:
    {call[:-1].replace("MOTIONS", repr(str(motions.path)))}, progress=progress)
except KeyboardInterrupt:
    late = (time.process_time() - seen[0]) / os.cpu_count()
    assert late < 1.0, late
    print(sorted(os.listdir(".")))
""")
    assert heard == "['hazard.csv']\n"


@pytest.mark.parametrize("table", [{"pga_g": [0.5]}, np.ones((3, 2)), [0.5, 0.6], [[0.5, 0.6]], 3])
def test_what_is_no_table_is_told(table):
    with pytest.raises(TypeError, match="expected a table .*or the path"):
        rockfrag.evaluate(table, **BLOCK)
    with pytest.raises(TypeError, match="expected a table .*or the path"):
        rockfrag.evaluate(structures=table, pga=0.5)


def test_masks_are_honoured():
    im = np.linspace(0.2, 1.5, 40)
    outcome = np.arange(40) * 7 % 40 < np.arange(40)
    hidden = np.arange(40) % 5 == 0
    wrong = np.ma.masked_array(np.where(hidden, -1.0, im), hidden)
    fit, expected = rockfrag.fit_fragility(wrong, outcome), rockfrag.fit_fragility(im[~hidden], outcome[~hidden])
    assert (fit.n, fit.theta) == (expected.n, expected.theta)
    with pytest.raises(ValueError, match="pga is NaN"):
        rockfrag.Object(**BLOCK).probability(np.ma.masked_array([0.5, 0.9], [False, True]), 0.6)
