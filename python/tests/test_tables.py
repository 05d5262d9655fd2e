"""Tables come and go as Arrow."""

import numpy as np
import pandas
import polars
import pyarrow
import pytest
from conftest import FRAME
from polars.testing import assert_frame_equal

import rockfrag

SHARED = ["motion_id", "structure", "outcome", "edp", "impacts", "im1"]


@pytest.mark.parametrize(
    "convert",
    [
        lambda table: table.to_polars(),
        lambda table: table.to_pandas(),
        lambda table: table.to_pyarrow(),
        lambda table: pyarrow.RecordBatchReader.from_stream(table),
        lambda table: table.to_polars().with_columns(polars.col("suite").cast(polars.Categorical)),
        lambda table: table.to_polars().with_columns(polars.col("motion_id").cast(polars.Int32)),
        lambda table: str(table.path),
    ],
    ids=["polars", "pandas", "pyarrow", "stream", "categories", "whole numbers", "path"],
)
def test_a_table_in_is_the_file_that_it_was(motions, responses, convert):
    again = rockfrag.simulate(convert(motions), structure=FRAME)
    assert_frame_equal(again.to_polars().select(SHARED), responses.to_polars().select(SHARED))


def test_a_table_out_is_the_same_in_all_libraries(responses):
    frame, table, data = responses.to_polars(), responses.to_pyarrow(), responses.to_pandas()
    assert isinstance(data, pandas.DataFrame)
    assert frame.columns == table.column_names == list(data.columns)
    assert_frame_equal(polars.DataFrame(table), frame)
    assert_frame_equal(polars.from_pandas(data).cast(frame.schema), frame)
    assert responses.columns == frame.columns and len(responses) == frame.height
    arrays = responses.head(3)
    assert arrays["outcome"].tolist() == frame["outcome"][:3].to_list()
    assert np.array_equal(responses.to_numpy(["edp"])["edp"], frame["edp"].to_numpy(), equal_nan=True)
    assert table.schema.field("pga_m_s2").metadata[b"unit"] == b"m/s2"
    assert_frame_equal(polars.read_parquet(responses.path), frame)


def test_motions_of_ones_own_are_solved_unrounded():
    sine = [4.0 * (-1) ** (k // 40) for k in range(400)]
    own = polars.DataFrame({"motion_id": ["a"], "dt_s": [0.01], "acceleration_m_s2": [sine]})
    edp = rockfrag.simulate(own, structure=FRAME).to_polars()["edp"][0]
    assert edp == rockfrag.Object(**FRAME).response(sine, 0.01).edp


def test_lists_of_people_are_tables_too(motions):
    people = pandas.DataFrame({"name": ["a", "b"], "width": [0.5, 0.3], "height": [2.0, 1.5]})
    made = rockfrag.simulate(motions, structures=people).to_polars()
    assert made["structure"].unique().sort().to_list() == ["a", "b"]
    assert rockfrag.simulate(motions, structures="paper").to_polars().height == 560
    with pytest.warns(UserWarning, match="column 'Frcition'"):
        rockfrag.simulate(motions, structures=people.assign(Frcition=0.1))


def test_a_part_stands_beside_its_table(responses):
    made = rockfrag.fit_pro(responses)
    assert "theta" in made.part("parameters").to_polars()["parameter"]
    assert "parameters" in made.parts
    with pytest.raises(ValueError, match="fit-pro has no part 'none'; expected one of .*parameters"):
        made.part("none")


def test_a_temporary_file_goes_when_its_result_does(motions):
    made = rockfrag.simulate(motions, structure=FRAME, trace=["0"])
    path, part = made.path, made.part("trace")
    del made
    assert path.exists()
    assert part.to_polars()["theta_over_alpha"].abs().max() > 0
    del part
    assert not path.parent.exists()


def test_a_result_is_not_that_of_another_call(tmp_path, motions):
    made = rockfrag.simulate(motions, structure=FRAME, out=tmp_path / "responses.parquet")
    table = made.to_polars()
    rockfrag.simulate(motions, structure=FRAME, out=made.path)
    assert made.to_polars().equals(table)
    rockfrag.simulate(motions, structures="paper", out=made.path)
    with pytest.raises(rockfrag.Error, match="responses.parquet: changed since simulate wrote it"):
        made.to_polars()


def test_a_table_that_cannot_be_right_is_told_without_a_path(motions):
    with pytest.raises(rockfrag.Error, match="^input: no column 'dt_s'"):
        rockfrag.simulate(motions.to_polars().drop("dt_s"), structure=FRAME)
