"""Objects, sites and arrays: the numbers of the stages."""

import pickle
from pathlib import Path

import numpy as np
import polars
import pytest
from conftest import BLOCK, FRAME

import rockfrag

DATA = Path(__file__).parents[2] / "data"
STATES = ["p_rocking", *(f"p_{of}{end}" for of in ("failure", "overturning") for end in ("", "_low", "_high"))]
OBJECTS = [
    BLOCK,
    {**BLOCK, "depth": 0.4, "base": "stone", "centre_height": 0.8, "centre_height_sd": 0.1},
    {**BLOCK, "period": 0.6, "level": 0.5, "wall": True},
    {"p": 1.5, "alpha": "8.6deg", "eta": 0.92},
    {**BLOCK, "pedestal_width": 0.6, "pedestal_height": 0.8, "mass": 90, "pedestal_mass": 200, "fixed_to_pedestal": True},
]


def expect_same(found, row, names, of=lambda value: value):
    for name in names:
        known = np.nan if row.get(name) is None else row[name]
        assert of(getattr(found, name)) == pytest.approx(known, rel=1e-12, nan_ok=True)


@pytest.mark.parametrize("fields", OBJECTS)
def test_probabilities_and_rates_are_those_of_evaluate(fields):
    asked = pickle.loads(pickle.dumps(rockfrag.Object(suite="recorded", limit_state=0.2, **fields)))
    options = {**fields, "suite": "recorded", "limit_state": 0.2}
    pga, pgv = np.array([0.1, 0.5, 0.9])[:, None], np.array([0.3, 0.6])
    found = asked.probability(pga, pgv, [[6.5]])
    assert found.p_rocking.shape == (3, 2)
    row = rockfrag.evaluate(pga=0.5, pgv=0.6, magnitude=6.5, **options).to_polars().row(0, named=True)
    expect_same(found, row, STATES, lambda array: array[1, 1])
    row = rockfrag.evaluate(pgv=0.6, vs30=300, **{**options, "suite": None}).to_polars().row(0, named=True)
    expect_same(rockfrag.Object(limit_state=0.2, **fields).probability(pgv=0.6, vs30=300), row, STATES)
    files = [DATA / "hazard.csv", DATA / "hazard_sa.csv"]
    rate = asked.rate(rockfrag.Site.read(*files, magnitude=6.5), years=100)
    row = rockfrag.evaluate(hazard=files, magnitude=6.5, years=100, **options).to_polars().row(0, named=True)
    per_year = [name for name in row if "per_year" in name or "years" in name]
    expect_same(rate, row, [*STATES, *per_year, "share_extrapolated"])
    assert len(per_year) == 9


def test_many_probabilities_are_each_of_them():
    asked, pga = rockfrag.Object(**BLOCK), np.linspace(0.0, 1.5, 500)
    with pytest.warns(UserWarning, match="answered at that limit"):
        assert np.ptp(asked.probability(0.05, [0.1, 1.45, 1.5]).p_failure[1:]) < 0.02
    many = asked.probability(pga, 0.9 * pga)
    assert many.p_overturning[77] == asked.probability(pga[77], 0.9 * pga[77]).p_overturning
    assert np.isfinite(many.p_overturning).all() and many.p_overturning[0] == 0


def test_curves_are_the_site_of_their_files():
    files = [DATA / "hazard.csv", DATA / "hazard_sa.csv"]
    curves = [polars.read_csv(file, comment_prefix="#").to_numpy().T for file in files]
    asked, site = rockfrag.Object(**BLOCK), rockfrag.Site(pga=curves[0], sa_1s=tuple(curves[1]))
    of_files = asked.rate(rockfrag.Site.read(*files)).overturning_per_year_high
    assert asked.rate(site).overturning_per_year_high == pytest.approx(of_files, rel=1e-12)


def test_records_are_the_rows_of_simulate(motions):
    structures = {"frame": FRAME, "block": {**BLOCK, "name": "block"}}
    rows = rockfrag.simulate(motions, structure=list(structures.values())).to_polars()
    table, counts = motions.to_numpy(), []
    objects = [rockfrag.Object(**fields) for fields in structures.values()]
    solved = rockfrag.simulate_motions(
        table["acceleration_m_s2"], table["dt_s"], objects, threads=2, progress=lambda *step: counts.append(step)
    )
    assert np.array_equal(solved.edp, rows["edp"].to_numpy().reshape(-1, 2), equal_nan=True)
    assert np.array_equal(solved.overturned.ravel(), rows["outcome"] == "overturning")
    assert counts[-1] == (280, 280)
    one = rockfrag.simulate_motions(np.stack([table["acceleration_m_s2"][0]] * 2), table["dt_s"][0], objects[1])
    assert one.edp.tolist() == [solved.edp[0, 1]] * 2


def test_one_response_is_the_row_and_trace_of_the_stage(motions):
    trace = rockfrag.simulate(motions, structure=FRAME, trace=["1"])
    motion = motions.to_polars().row(by_predicate=polars.col("motion_id") == "1", named=True)
    solved = rockfrag.Object(**FRAME).response(motion["acceleration_m_s2"], motion["dt_s"])
    row = trace.to_polars().row(by_predicate=polars.col("motion_id") == "1", named=True)
    assert (solved.outcome, solved.edp, solved.impacts) == (row["outcome"], row["edp"], row["impacts"])
    traced = trace.part("trace").to_polars()
    for name, array in [("time_s", solved.time), ("theta_rad", solved.theta), ("theta_dot_rad_s", solved.theta_dot)]:
        assert np.array_equal(array, traced[name])
    assert np.allclose(solved.theta_over_alpha, traced["theta_over_alpha"])
    assert [event for _, event in solved.events] == traced["solver_event"].drop_nulls().to_list()


CURVE = ([0.1, 0.5, 1.0], [1e-2, 1e-3, 1e-4])
ASKED = rockfrag.Object(**BLOCK)


@pytest.mark.parametrize(
    ("call", "error", "message"),
    [
        (lambda: rockfrag.Object(width=50, height=2), ValueError, "width is 50; .* the height"),
        (lambda: rockfrag.Object(widht=0.5), TypeError, "'widht' .*did you mean 'width'"),
        (lambda: rockfrag.Object(), ValueError, "expected p, alpha and eta, or width and height"),
        (lambda: rockfrag.Object(**BLOCK, suite="csmg"), ValueError, "suite: .*csmg"),
        (lambda: rockfrag.Object(**BLOCK, fits="nowhere"), FileNotFoundError, "nowhere"),
        (lambda: ASKED.probability(-1, 0.5), ValueError, "^pga is -1; expected g"),
        (lambda: ASKED.probability(0.8, 90.0), ValueError, "^pgv is 90.*cm/s"),
        (lambda: ASKED.probability(0.5, [0.5, np.nan]), ValueError, "^pgv is NaN"),
        (lambda: ASKED.probability([0.5, 0.6], [0.5, 0.6, 0.7]), ValueError, "shape"),
        (lambda: ASKED.probability(), TypeError, "pga"),
        (lambda: ASKED.rate(rockfrag.Site(pga=CURVE), years=-1), ValueError, "years is -1"),
        (lambda: rockfrag.Site(sa_1s=CURVE), ValueError, "PGA"),
        (lambda: rockfrag.Site(pga=(CURVE[0], [1e-3, 1e-2, 1e-4])), ValueError, "pga: point 2"),
        (lambda: rockfrag.Site(pga=CURVE, vs30=30), ValueError, "vs30 is 30"),
        (lambda: rockfrag.Site.read("nowhere.csv"), FileNotFoundError, "nowhere.csv"),
        (lambda: ASKED.fragility("pgd"), ValueError, "over: .*pgd"),
        (lambda: rockfrag.Object(**BLOCK, limit_state=0), ValueError, "limit_state is 0"),
        (lambda: ASKED.response([0.1, np.nan], 0.01), ValueError, "sample 1 of the acceleration is NaN"),
        (lambda: ASKED.response([[0.1, 0.2]], 0.01), ValueError, "2 dimensions"),
        (lambda: ASKED.response(400 * np.ones(9), 0.01), ValueError, "acceleration reaches 40.8 g"),
        (lambda: rockfrag.simulate_motions([[0.1], [0.2]], 5.0, ASKED), ValueError, r"ons\[0\]: dt is 5"),
        (lambda: rockfrag.Object(**OBJECTS[2]).response([0.1, 0.2], 0.01), ValueError, "level, period"),
        (lambda: rockfrag.run("nowhere.yaml"), FileNotFoundError, "nowhere.yaml"),
        (lambda: ASKED.probability(np.ma.masked_array([0.5, 0.9], [False, True]), 0.6), ValueError, "pga is NaN"),
    ],
)
def test_what_is_wrong_is_named(call, error, message):
    with pytest.raises(error, match=message):
        call()


def test_probabilities_come_from_fits_too(tmp_path, responses):
    rockfrag.fit_pex(responses, out=tmp_path / "pex.parquet")
    rockfrag.fit_pro(responses, out=tmp_path / "pro.parquet")
    fitted = rockfrag.Object(fits=tmp_path, suite="csgm", **FRAME).probability(0.5, 0.6)
    rows = rockfrag.evaluate(pga=0.5, pgv=0.6, fits=tmp_path, suite="csgm", structure=FRAME).to_polars()
    expect_same(fitted, rows.row(0, named=True), STATES)
    assert fitted.p_overturning != rockfrag.Object(suite="csgm", **FRAME).probability(0.5, 0.6).p_overturning


def test_what_is_implausible_is_a_warning_of_python():
    with pytest.warns(UserWarning, match="PGA 3") as told:
        ASKED.response(3 * 9.81 * np.cos(4 * np.pi * np.arange(0, 5, 0.01)), 0.01)
    assert [warning.filename for warning in told] == [__file__]
    with pytest.warns(UserWarning) as told:
        assert len(ASKED.probability([3.0, 0.5], 0.6).warnings) == len(told)
