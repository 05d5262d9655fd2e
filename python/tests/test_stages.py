"""Every stage is a function that does what the command does, with the same options."""

import inspect
import pydoc
import subprocess
import sys
from pathlib import Path

import pytest
from conftest import FRAME

import rockfrag
from rockfrag import _stages


def test_a_stage_writes_the_bytes_of_the_command(tmp_path, command):
    structure = "--structure=name=frame,p=1.5,alpha=0.15,eta=0.92"
    before = None
    for stage, flags, options, name in [
        ("sample-scenarios", ["--samples=3", "--mw=6:7:0.5"], {"samples": 3, "mw": "6:7:0.5"}, "scenarios"),
        ("synthesize-motions", ["--suite=pulse,csgm"], {"suite": ["pulse", "csgm"]}, "motions"),
        ("simulate", [structure], {"structure": [FRAME]}, "responses"),
        ("fit-pro", ["--pairs=im4:im5", "--all"], {"pairs": "im4:im5", "all": True}, "pro"),
    ]:
        done = command(stage, *flags)
        assert done.returncode == 0, done.stderr
        given = [before.path] if before else []
        before = getattr(rockfrag, stage.replace("-", "_"))(
            *given, out=tmp_path / f"py/{name}.parquet", **options
        )
        assert before.path.read_bytes() == (tmp_path / f"{name}.parquet").read_bytes()
        assert before.summary == done.stdout


@pytest.mark.parametrize(
    ("options", "error", "message"),
    [
        ({"alpah": 0.15}, TypeError, "unexpected keyword argument 'alpah'"),
        ({"p": "x", "alpha": 0.15, "eta": 0.92}, ValueError, "p is x; expected"),
        ({"p": float("nan"), "alpha": 0.15, "eta": 0.92}, ValueError, "simulate: an option is NaN"),
        ({"p": 1.5, "alpha": 15, "eta": 0.92}, ValueError, "alpha is 15; .*is it in degrees"),
        ({"structures": "none.csv"}, FileNotFoundError, "none.csv"),
        ({"structure": FRAME, "threads": 20_000}, ValueError, "threads"),
        ({"p": object(), "alpha": 0.15, "eta": 0.92}, TypeError, "is no option"),
    ],
)
def test_a_wrong_option_is_told(motions, options, error, message):
    with pytest.raises(error, match=message):
        rockfrag.simulate(motions, **options)


def test_too_many_threads_of_the_environment_are_refused(monkeypatch):
    monkeypatch.setenv("RAYON_NUM_THREADS", "100000")
    with pytest.raises(ValueError, match="RAYON_NUM_THREADS"):
        rockfrag.sample_scenarios(samples=2)


def test_a_damaged_file_is_named(tmp_path):
    (tmp_path / "bad.parquet").write_bytes(b"PAR1 no Parquet")
    with pytest.raises(rockfrag.Error, match="bad.parquet: not a readable Parquet file"):
        rockfrag.simulate(tmp_path / "bad.parquet", structure=FRAME)


@pytest.mark.parametrize("stage", _stages.__all__)
def test_help_has_each_argument_and_fits_on_a_screen(stage):
    function = getattr(rockfrag, stage)
    lines = pydoc.render_doc(function, renderer=pydoc.plaintext).splitlines()[3:]
    assert max(map(len, lines)) <= 115
    for name in inspect.signature(function).parameters:
        assert sum(name in line.split(":")[0].replace(" = ", ", ").split(", ") for line in map(str.strip, lines)) == 1


def test_a_file_that_is_up_to_date_is_left_as_it_is(tmp_path, motions):
    out = tmp_path / "responses.parquet"
    first = rockfrag.simulate(motions, out=out, structure=FRAME)
    before = out.stat().st_mtime_ns
    again = rockfrag.simulate(motions, out=out, structure=FRAME)
    assert (out.stat().st_mtime_ns, again.summary) == (before, first.summary)
    rockfrag.simulate(motions, out=out, structure=FRAME, force=True)
    assert out.stat().st_mtime_ns > before


def test_a_run_is_that_of_the_command(tmp_path, command):
    (tmp_path / "pipeline.yaml").write_text(
        "sample-scenarios: { samples: 2, mw: '6.5' }\nsynthesize-motions: { suite: pulse }\n"
        "simulate: { structure: [{ name: frame, p: 1, alpha: 0.15, eta: 0.92 }] }\n"
    )
    results = rockfrag.run(tmp_path / "pipeline.yaml", seed=3)
    assert list(results) == ["sample_scenarios", "synthesize_motions", "simulate"]
    assert command("run", "--seed=3", "--quiet", "--out=again").returncode == 0
    for result in results.values():
        assert result.path.read_bytes() == (tmp_path / "again" / result.path.name).read_bytes()
    seen = rockfrag.inspect(results["simulate"].path)
    assert (seen["rows"], seen["made"]["stage"]) == (14, "simulate")
    section = rockfrag.simulate(results["synthesize_motions"], config=tmp_path / "pipeline.yaml")
    assert section.to_polars().equals(results["simulate"].to_polars())


def test_progress_is_told(motions, capfd):
    steps: list[tuple[int, ...]] = []
    rockfrag.simulate(motions, structure=FRAME, threads=1, progress=lambda *step: steps.append(step))
    assert steps[-1] == (280, 280)
    rockfrag.simulate(motions, structure=FRAME, progress=True)
    assert capfd.readouterr().err.endswith("simulate: 280 of 280\n")


def test_types_of_the_package_and_of_its_users(tmp_path):
    def mypy(*words: str) -> str:
        done = [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(tmp_path / "cache"), *words]
        return subprocess.run(done, cwd=tmp_path, capture_output=True, text=True, check=False).stdout

    package = Path(__file__).parents[1]
    found = mypy("--config-file", str(package / "pyproject.toml"), str(package / "python" / "rockfrag"))
    assert found.startswith("Success"), found
    (tmp_path / "user.py").write_text(
        "import rockfrag\n"
        "made: rockfrag.Result = rockfrag.simulate('motions.parquet', p=1.5, alpha=0.15, eta=0.92)\n"
        "rockfrag.simulate('motions.parquet', alpah=0.15)\n"
        "rockfrag.Object(width='a', height=2)\n"
        "rockfrag.evaluate(suite='nonsense', width=0.5, height=2.0)\n"
        "cabinet = rockfrag.Object(width=0.5, height=2.0, base='stone')\n"
        "p: float = cabinet.rate(rockfrag.Site(pga=([0.1, 1], [1e-2, 1e-4]))).overturning_per_year\n"
    )
    found = mypy("user.py")
    assert 'user.py:3: error: Unexpected keyword argument "alpah" for "simulate"' in found
    assert [line.split(":")[1] for line in found.splitlines() if " error: " in line] == ["3", "4", "5"]
