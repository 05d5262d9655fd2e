"""Each stage gives what the command gives: the same values to the bit, from tables and from files."""

import pathlib

import matplotlib
import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
import rockfrag
from conftest import MOTIONS, PIPELINE, SCENARIOS, STRUCTURES, command


def same(table, file):
    expected = pq.read_table(file).replace_schema_metadata(None)
    table = pa.table(table).replace_schema_metadata(None)
    assert table.schema == expected.schema
    assert table.equals(expected)


def test_scenarios(out):
    scenarios = rockfrag.sample_scenarios(**SCENARIOS)
    assert len(scenarios) == 40
    same(scenarios, out / "scenarios.parquet")


@pytest.mark.parametrize("threads", [1, 2])
def test_motions_from_a_table_and_from_a_file(out, threads):
    for scenarios in [rockfrag.sample_scenarios(**SCENARIOS), out / "scenarios.parquet"]:
        same(rockfrag.synthesize_motions(scenarios, threads=threads, **MOTIONS), out / "motions.parquet")


@pytest.mark.parametrize("threads", [1, 2])
def test_responses_from_a_table_and_from_a_file(out, threads):
    for motions in [pq.read_table(out / "motions.parquet"), out / "motions.parquet"]:
        responses = rockfrag.simulate(motions, structures=STRUCTURES, threads=threads)
        same(responses, out / "responses.parquet")


def test_fits_from_a_table_and_from_a_file(out):
    for responses in [pq.read_table(out / "responses.parquet"), str(out / "responses.parquet")]:
        pex = rockfrag.fit_pex(responses, seed=7)
        same(pex, out / "pex.parquet")
        same(pex.parts["scan"], out / "pex.scan.parquet")
        same(rockfrag.fit_pro(responses, seed=7), out / "pro.parquet")


def test_a_whole_chain_in_memory(out):
    motions = rockfrag.synthesize_motions(rockfrag.sample_scenarios(**SCENARIOS), **MOTIONS)
    responses = rockfrag.simulate(motions, structures=STRUCTURES)
    same(rockfrag.fit_pro(responses, seed=7), out / "pro.parquet")


def test_evaluation(out, tmp_path):
    fits = {"suite": "csgm", "structure": "electrical-equipment"}
    options = [f"--{name}={value}" for name, value in fits.items()]
    files = ["--pex", out / "pex.parquet", "--pro", out / "pro.parquet"]
    univariate = ["--model", "univariate", "--measure", "im5", "--p", "2.0", "--alpha", "0.25"]
    command(tmp_path, "evaluate", "--in", out / "motions.parquet", "--out", "e.parquet", *files, *options, *univariate)
    tables = [pq.read_table(out / f"{name}.parquet") for name in ["pex", "pro", "motions"]]
    with pytest.warns(rockfrag.RockfragWarning):
        answers = rockfrag.evaluate(*tables, **fits, model="univariate", measure="im5", p=2.0, alpha=0.25)
    same(answers, tmp_path / "e.parquet")


def test_limits_from_resamples(out, tmp_path):
    fits = {"suite": "csgm", "structure": "electrical-equipment", "model": "univariate", "measure": "im5"}
    options = {"bootstrap": 50, "seed": 7}
    pex = rockfrag.fit_pex(out / "responses.parquet", out=tmp_path / "pex.parquet", **options)
    pro = rockfrag.fit_pro(out / "responses.parquet", out=tmp_path / "pro.parquet", **options)
    call = [f"--{name}={value}" for name, value in (fits | {"limits": "percentile", "p": 2.5, "alpha": 0.2}).items()]
    command(tmp_path, "evaluate", "--in", out / "motions.parquet", "--out", "e.parquet", *call)
    answers = rockfrag.evaluate(pex, pro, out / "motions.parquet", **fits, limits="percentile", p=2.5, alpha=0.2)
    same(answers, tmp_path / "e.parquet")
    with pytest.raises(rockfrag.OptionError, match="limits by resamples need the files"):
        rockfrag.evaluate(pq.read_table(pex), pro, out / "motions.parquet", **fits, limits="percentile")


def test_imported_records(out, tmp_path):
    record = tmp_path / "record.csv"
    motion = pq.read_table(out / "motions.parquet")["acceleration_m_s2"][0].as_py()
    record.write_text("\n".join(f"{value:.9g}" for value in motion))
    options = ["--unit", "m/s2", "--dt", "0.01", "--column", "1"]
    command(tmp_path, "import-motions", record, "--out", "m.parquet", *options)
    same(rockfrag.import_motions(record, unit="m/s2", dt=0.01, column=1), tmp_path / "m.parquet")


def test_a_file_is_that_of_the_command_and_not_made_twice(out, tmp_path):
    made = rockfrag.simulate(out / "motions.parquet", structures=STRUCTURES, out=tmp_path / "r.parquet")
    assert made == tmp_path / "r.parquet"
    assert (tmp_path / "r.parquet").read_bytes() == (out / "responses.parquet").read_bytes()
    time = (tmp_path / "r.parquet").stat().st_mtime_ns
    rockfrag.simulate(out / "motions.parquet", structures=STRUCTURES, out=tmp_path / "r.parquet")
    assert (tmp_path / "r.parquet").stat().st_mtime_ns == time
    rockfrag.simulate(out / "motions.parquet", structures=STRUCTURES, out=tmp_path / "r.parquet", force=True)
    assert (tmp_path / "r.parquet").stat().st_mtime_ns > time


def test_a_file_of_tables_in_memory_is_that_of_files(out, tmp_path):
    motions = rockfrag.synthesize_motions(out / "scenarios.parquet", **MOTIONS)
    made = rockfrag.simulate(motions, structures=STRUCTURES, out=tmp_path / "r.parquet")
    assert made.read_bytes() == (out / "responses.parquet").read_bytes()
    frame = rockfrag.simulate(motions, structures=STRUCTURES).to_polars()
    fits = [rockfrag.fit_pro(frame, seed=7, out=tmp_path / "pro.parquet") for _ in range(2)]
    time = fits[0].stat().st_mtime_ns
    rockfrag.fit_pro(frame, seed=7, out=tmp_path / "pro.parquet")
    assert fits[0].stat().st_mtime_ns == time
    rockfrag.fit_pro(frame[1:], seed=7, out=tmp_path / "pro.parquet")
    assert fits[0].stat().st_mtime_ns > time


def test_a_run_and_a_look_into_its_files(out, tmp_path):
    (tmp_path / "pipeline.yaml").write_text(PIPELINE)
    assert "would run" in rockfrag.run(tmp_path / "pipeline.yaml", dry_run=True)
    files = rockfrag.run(tmp_path / "pipeline.yaml")
    for name in ["motions", "responses", "pro"]:
        assert (tmp_path / f"out/{name}.parquet").read_bytes() == (out / f"{name}.parquet").read_bytes()
    assert files["simulate"] == [tmp_path / "out/responses.parquet"]
    info = rockfrag.inspect(tmp_path / "out/responses.parquet")
    assert (info.stage, info.rows, info.columns[0].name) == ("simulate", 160, "motion_id")
    assert "made by simulate" in str(info) and "<table>" in info._repr_html_()
    assert rockfrag.run(tmp_path / "pipeline.yaml", seed=8, out=tmp_path / "other")["fit-pro"][0].parent == tmp_path / "other"
    assert rockfrag.inspect(tmp_path / "other/scenarios.parquet").parameters["seed"] == 8


def test_partitions_are_the_whole(out, tmp_path):
    for index in range(3):
        call = {"partition": (index, 3), "out": tmp_path / "motions"}
        made = rockfrag.synthesize_motions(out / "scenarios.parquet", **MOTIONS, **call)
        assert made == tmp_path / f"motions/part-0000{index}.parquet"
    made = rockfrag.simulate(tmp_path / "motions", structures=STRUCTURES, out=tmp_path / "responses")
    assert made == tmp_path / "responses" and {file.suffix for file in made.iterdir()} == {".parquet"}
    same(pq.read_table(tmp_path / "responses"), out / "responses.parquet")
    same(rockfrag.simulate(tmp_path / "motions", structures=STRUCTURES), out / "responses.parquet")


def test_the_five_lines_of_the_readme():
    readme = (pathlib.Path(__file__).parents[2] / "README.md").read_text()
    lines = readme.split("```python\n")[1].split("```")[0].splitlines()
    assert len(lines) == 5
    matplotlib.use("Agg")
    names = {}
    with pytest.warns(rockfrag.RockfragWarning):
        exec("\n".join(lines), names)
    (curve,) = names["plt"].gca().lines
    assert (np.diff(curve.get_ydata()) > -1e-3).all() and curve.get_ydata()[-1] > 0.9
