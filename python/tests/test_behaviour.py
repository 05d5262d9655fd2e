"""What a call does besides its result: pictures, interrupts, processes, warnings, what it refuses."""

import os
import pickle
from pathlib import Path

import matplotlib
import numpy as np
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
    assert len(repr(response)) < 200


def test_the_fragility_of_an_object_is_that_of_evaluate_and_is_drawn():
    for over, unit in [("pga", "g"), ("pgv", "m/s")]:
        curve = rockfrag.Object(**BLOCK).fragility(over, magnitude=6.5)
        assert all(np.diff(curve.intensity) > 0) and all(curve.p_overturning <= curve.p_failure + 1e-9)
        rows = rockfrag.evaluate(**BLOCK, over=over, magnitude=6.5).to_polars()
        assert np.allclose(rows["p_overturning_low"], curve.p_overturning_low, rtol=1e-12)
        assert rows["overturning_beta"][0] == pytest.approx(curve.row["overturning_beta"], rel=1e-12)
        drawn = curve.plot()
        assert unit in drawn.get_xlabel() and np.array_equal(drawn.lines[0].get_ydata(), curve.p_overturning)
    assert "median PGV" in repr(curve)


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
try:
    {call}
except ImportError as error:
    print(error)
""")
    assert told.startswith(f"{module} is not installed: pip install {module}")


def test_a_pickled_result_is_whole_or_refused(tmp_path, motions):
    made = rockfrag.simulate(motions, structure=FRAME, out=tmp_path / "responses.parquet", trace=["0"])
    again = pickle.loads(pickle.dumps(made))
    assert again.to_polars().equals(made.to_polars())
    assert again.part("trace").to_polars().equals(made.part("trace").to_polars())
    temporary = rockfrag.simulate(motions, structure=FRAME, trace=["0"])
    for result in (temporary, temporary.part("trace")):
        with pytest.raises(TypeError, match="expected a result with out="):
            pickle.dumps(result)


@pytest.mark.filterwarnings("error")
def test_errors_and_warnings_as_errors_leave_no_folder(tmp_path, monkeypatch, motions):
    monkeypatch.setattr("tempfile.tempdir", str(tmp_path))
    with pytest.raises(ValueError):
        rockfrag.evaluate(pga=0.5, pgv=0.6)
    with pytest.raises(UserWarning):
        rockfrag.simulate(motions, p=1.5, alpha=0.15, eta=0.3)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork here")
def test_a_forked_process_is_refused(python):
    script = """
import os, numpy, rockfrag
many = lambda: rockfrag.Object(width=0.5, height=2.0).probability(numpy.linspace(0.1, 1, 100), 0.5)
many()
pid = os.fork()
if pid == 0:
    try:
        many()
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
