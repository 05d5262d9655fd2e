"""What cannot be done says so: which file or table, row and column, and what was expected."""

import polars as pl
import pytest
import rockfrag


def motions(**columns):
    fine = {"motion_id": [1], "dt_s": [0.01], "acceleration_m_s2": [[0.0, 1.0]]}
    return pl.DataFrame({name: value for name, value in {**fine, **columns}.items() if value is not None})


def test_a_missing_file():
    with pytest.raises(FileNotFoundError, match="nowhere.parquet: no such file") as caught:
        rockfrag.simulate("nowhere.parquet", structures="paper")
    assert isinstance(caught.value, rockfrag.RockfragError)


SCENARIOS = rockfrag.sample_scenarios(mw=6.5, re=5, samples=1)


@pytest.mark.parametrize(
    "call",
    [
        lambda missing: rockfrag.evaluate(width=0.5, height=2.0, hazard=missing),
        lambda missing: rockfrag.evaluate(intensities=missing, width=0.5, height=2.0),
        lambda missing: rockfrag.simulate(motions(), structures=missing),
        lambda missing: rockfrag.synthesize_motions(SCENARIOS, site=missing),
        lambda missing: rockfrag.import_motions([missing, __file__]),
        lambda missing: rockfrag.validate(motions(), hazard=missing),
        lambda missing: rockfrag.run(missing),
        lambda missing: rockfrag.seed_spread(missing),
        rockfrag.fit_pro,
        rockfrag.inspect,
    ],
)
def test_a_missing_file_of_any_kind(call, tmp_path):
    with pytest.raises(FileNotFoundError, match="nowhere.csv") as caught:
        call(tmp_path / "nowhere.csv")
    assert isinstance(caught.value, rockfrag.MissingFileError)


def test_a_folder_in_place_of_a_file(tmp_path):
    with pytest.raises(rockfrag.FileError, match="expected a hazard"):
        rockfrag.evaluate(width=0.5, height=2.0, hazard=tmp_path)


def test_a_file_that_is_none(tmp_path):
    (tmp_path / "m.parquet").write_text("no parquet")
    with pytest.raises(OSError, match="m.parquet: not a Parquet file"):
        rockfrag.simulate(tmp_path / "m.parquet", structures="paper")


@pytest.mark.parametrize(
    "wrong, message",
    [
        ({"dt_s": None}, "motions: no column 'dt_s'"),
        ({"dt_s": ["x"]}, "motions: column 'dt_s' is"),
        ({"dt_s": [-1.0]}, "motions: row 0, column 'dt_s'.*above 0 s"),
        ({"acceleration_m_s2": [[0.0, float("nan")]]}, "row 0, column 'acceleration_m_s2': sample 1"),
    ],
)
def test_a_table_that_is_no_table_of_motions(wrong, message):
    with pytest.raises(rockfrag.TableError, match=message) as caught:
        rockfrag.simulate(motions(**wrong), structures="paper")
    assert isinstance(caught.value, ValueError)


def test_a_table_without_rows():
    with pytest.raises(rockfrag.TableError, match="motions: the table is empty"):
        rockfrag.simulate(motions().clear(), structures="paper")


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: rockfrag.sample_scenarios(samples=0), "samples is 0"),
        (lambda: rockfrag.sample_scenarios(mw=[7, 6]), "rising numbers"),
        (lambda: rockfrag.sample_scenarios(design="grid"), "grid.*lhs"),
        (lambda: rockfrag.sample_scenarios(threads=0), "threads is 0"),
        (lambda: rockfrag.simulate(motions(), alpha=3.0), "alpha"),
        (lambda: rockfrag.simulate(motions(), structures={"q": 1}), "'q' is no parameter of a structure; expected name, p"),
        (lambda: rockfrag.simulate(motions(), structures="paper", partition=(3, 3)), "from 0 to n - 1"),
        (lambda: rockfrag.simulate(motions()), "no structure; expected"),
        (lambda: rockfrag.Structure.block(-0.5, 2.0), "width"),
        (lambda: rockfrag.fit_pro(motions(), link="cauchit"), "cauchit"),
        (lambda: rockfrag.response([0.0, 1.0], -1.0, {"p": 2, "alpha": 0.2, "eta": 0.9}), "dt_s is -1"),
    ],
)
def test_an_option_that_is_out_of_range(call, message):
    with pytest.raises(rockfrag.OptionError, match=message):
        call()


FORTY = rockfrag.datasets.load_outcomes()
BLOCK = {"width": 0.5, "height": 2.0}


@pytest.mark.parametrize(
    "call, message",
    [
        (lambda: rockfrag.sample_scenarios(samples="ten"), "samples is 'ten'; expected a whole number, 0 or more"),
        (lambda: rockfrag.sample_scenarios(samples=2.5), "samples is 2.5; expected a whole number"),
        (lambda: rockfrag.sample_scenarios(samples=float("nan")), "samples is nan; expected a whole number"),
        (lambda: rockfrag.sample_scenarios(mw="abc"), "mw: 'abc': expected a number, numbers separated by commas"),
        (lambda: rockfrag.sample_scenarios(mw={}), "mw is {}; expected text, a number, or several"),
        (lambda: rockfrag.sample_scenarios(design=3), "design: '3' is none of lhs, random"),
        (lambda: rockfrag.sample_scenarios(seed=1.5), "seed is 1.5; expected a whole number"),
        (lambda: rockfrag.sample_scenarios(threads="two"), "threads is 'two'; expected a whole number, 1 or more"),
        (lambda: rockfrag.sample_scenarios(progress=3), "progress is 3; expected a function"),
        (lambda: rockfrag.sample_scenarios(force="no"), "force is 'no'; expected True or False"),
        (lambda: rockfrag.sample_scenarios(out=3), "out is 3; expected a path"),
        (lambda: rockfrag.synthesize_motions("s.parquet", dt="fast"), "dt is 'fast'; expected a finite number"),
        (lambda: rockfrag.synthesize_motions("s.parquet", suite=["puls"]), "suite: 'puls' is none of pulse, csgm"),
        (lambda: rockfrag.synthesize_motions("s.parquet", partition=3), r"partition is 3; expected \(i, n\)"),
        (lambda: rockfrag.simulate(motions(), structures=3), "structures is 3; expected a Structure, several, or the path"),
        (lambda: rockfrag.simulate(motions(), structures={"p": "x", "alpha": 0.2}), "p is 'x'; expected a finite number"),
        (lambda: rockfrag.simulate(motions(), structures={"width": 1, "beam_mass_ratio": 2}), "with beam_mass_ratio for a frame"),
        (lambda: rockfrag.import_motions([3]), "files is 3; expected a path"),
        (lambda: rockfrag.evaluate(**BLOCK, pga=[0.5, 0.6], pgv=0.6), r"pga is \[0.5, 0.6\]; expected a finite number"),
        (lambda: rockfrag.evaluate(**BLOCK, pga=0.5), r"expected pga \(g\) and pgv \(m/s\); or intensities=TABLE"),
        (lambda: rockfrag.evaluate(structure=rockfrag.Structure.block(0.5, 2.0), pga=0.5, pgv=0.6), "give a Structure as structures="),
        (lambda: rockfrag.fit_fragility([True] * 40, FORTY["overturned"]), "im: case 0 is True; expected finite numbers above 0"),
        (lambda: rockfrag.evaluate(**BLOCK, hazard=3), "hazard is 3; expected a path, a table"),
        (lambda: rockfrag.evaluate(**BLOCK, hazard={"pga_g": [1, 2], "rate": [1]}), r"different lengths \(pga_g 2, rate 1\)"),
        (lambda: rockfrag.response([[1.0, 2.0]], 0.01, BLOCK), r"shape \(1, 2\); expected one motion, shape \(n,\)"),
        (lambda: rockfrag.response([0.0, 1.0], "x", BLOCK), "dt_s is 'x'; expected a finite number"),
        (lambda: rockfrag.response([0.0, 1.0], 0.01, 3), "structure is 3; expected a Structure, or a mapping"),
        (lambda: rockfrag.Structure("two", 0.2, 0.92), "p is 'two'; expected a finite number"),
        (lambda: rockfrag.Structure(2.0, 0.2, "hausner"), "eta is 'hausner'; expected a finite number, or 'housner'"),
        (lambda: rockfrag.probability(**BLOCK, pga="a", pgv=0.6), "pga is 'a'; expected numbers"),
        (lambda: rockfrag.probability(3, pga=0.5, pgv=0.6), "structure is 3; expected a Structure"),
        (lambda: rockfrag.fit_fragility(["a"] * 40, FORTY["overturned"]), "im: case 0 is 'a'; expected finite numbers above 0"),
        (lambda: rockfrag.fit_fragility(FORTY["pgv_m_s"], ["yes"] * 40), "outcome: case 0 is 'yes'; expected bool, or 0 and 1"),
        (lambda: rockfrag.fit_fragility(FORTY["pgv_m_s"], FORTY["overturned"], link=3), "link is 3; expected one of probit, logit"),
        (lambda: rockfrag.fit_demand(FORTY["pgv_m_s"], FORTY["edp"], limit_state="LS2"), "limit_state is 'LS2'; expected a demand"),
        (lambda: rockfrag.inspect(3), "file is 3; expected a path"),
        (lambda: rockfrag.run(3), "pipeline is 3; expected a path"),
        (lambda: rockfrag.seed_spread(seeds=-1), "seeds is -1; expected a whole number, 1 or more"),
    ],
)
def test_a_wrong_type_is_told_in_words_of_python(call, message):
    with pytest.raises(rockfrag.OptionError, match=message) as caught:
        call()
    assert not [word for word in ["usize", "f64", "u64", "enum", "at line", "invalid type"] if word in str(caught.value)]


def test_text_may_be_a_path(tmp_path):
    file = tmp_path / "site.csv"
    file.write_text("frequency_hz,factor\n0.1,1.0\n50,1.0\n")
    scenarios = rockfrag.sample_scenarios(mw=6.5, re=10, samples=1)
    flat, rock = (rockfrag.synthesize_motions(scenarios, suite="csgm", site=site) for site in (file, "none"))
    assert flat["pga_m_s2"] == pytest.approx(rock["pga_m_s2"])


def test_a_hazard_in_memory_is_called_so():
    with pytest.raises(rockfrag.RockfragError, match="^hazard: columns a, b; expected pga_g"):
        rockfrag.evaluate(**BLOCK, hazard={"a": [1.0, 2.0], "b": [1.0, 2.0]})


def test_something_that_is_no_table():
    with pytest.raises(TypeError, match="motions is int; expected a path, or a table"):
        rockfrag.simulate(3, structures="paper")


def test_a_fit_of_nothing_says_what_is_there_and_what_would_help():
    responses = rockfrag.simulate(motions(), p=2.0, alpha=0.02, eta=0.92)
    with pytest.warns(rockfrag.RockfragWarning, match="none of 7 curves can be fitted: overturning in") as told:
        curves = rockfrag.fit_pro(responses)
    assert not any("--estimator" in str(warning.message) for warning in told)
    assert set(curves.to_polars()["status"]) == {"too_few_events"}


def test_an_unknown_argument_is_named_with_the_nearest():
    with pytest.raises(TypeError, match="^fit_pex has no argument 'limit_stat'; did you mean 'limit_state'"):
        rockfrag.fit_pex(motions(), limit_stat=0.2)
    with pytest.raises(TypeError, match="^simulate has no argument 'qqq'; help"):
        rockfrag.simulate(motions(), qqq=1)


def test_sizes_in_a_table_of_intensities_are_not_passed_over_in_silence():
    blocks = pl.DataFrame({"pga_m_s2": [5.0], "pgv_m_s": [0.6], "width": [0.5], "height": [2.0]})
    with pytest.warns(rockfrag.RockfragWarning, match="intensities: columns width and height are not read.*p_rad_s and alpha_rad"):
        rockfrag.evaluate(intensities=blocks, p=2.5, alpha=0.2, eta=0.92)
