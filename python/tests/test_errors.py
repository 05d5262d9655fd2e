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
        (lambda: rockfrag.simulate(motions(), structures={"q": 1}), "unknown field `q`"),
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


def test_something_that_is_no_table():
    with pytest.raises(TypeError, match="motions is int; expected a path, or a table"):
        rockfrag.simulate(3, structures="paper")


def test_a_fit_of_nothing_says_what_is_there_and_what_would_help():
    responses = rockfrag.simulate(motions(), p=2.0, alpha=0.02, eta=0.92)
    with pytest.warns(rockfrag.RockfragWarning, match="too_few|too few"), pytest.raises(rockfrag.RockfragError, match="none of 7 curves"):
        rockfrag.fit_pro(responses)
