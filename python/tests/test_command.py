"""The command that the package brings is the program: the same words, files, messages and exit codes."""

import importlib.metadata
import os
import pathlib
import signal
import subprocess
import sys
import time

import pytest
from conftest import COMMAND

OURS = [sys.executable, "-m", "rockfrag"]


def both(*arguments, cwd):
    def outcome(program):
        done = subprocess.run([*program, *map(str, arguments)], cwd=cwd, capture_output=True, text=True)
        return done.returncode, done.stdout, done.stderr

    return outcome(OURS), outcome([COMMAND])


@pytest.mark.parametrize(
    "arguments, code",
    [
        (["--version"], 0),
        (["--help"], 0),
        (["fit-pro", "--help"], 0),
        ([], 2),
        (["nonsense"], 2),
        (["evaluate", "--width", "0.5", "--height", "2.0", "--pga", "0.5", "--pgv", "0.6"], 0),
        (["evaluate", "--width", "0.5", "--height", "2.0", "--pga", "0.5", "--pgv", "0.6", "--format", "json"], 0),
        (["evaluate", "--pga", "0.5", "--pgv", "60"], 2),
        (["fit-pro", "--link", "cauchit"], 2),
        (["inspect", "nowhere.parquet"], 1),
        (["--threads", "0", "sample-scenarios"], 2),
    ],
)
def test_codes_and_messages_are_the_programs(arguments, code, tmp_path):
    ours, theirs = both(*arguments, cwd=tmp_path)
    assert ours == theirs
    assert ours[0] == code


def test_files_are_the_programs(tmp_path):
    for name, program in [("ours", OURS), ("theirs", [COMMAND])]:
        (tmp_path / name).mkdir()
        subprocess.run([*program, "--quiet", "sample-scenarios", "--samples", "2"], cwd=tmp_path / name, check=True)
    files = [(tmp_path / name / "scenarios.parquet").read_bytes() for name in ("ours", "theirs")]
    assert files[0] == files[1]


@pytest.mark.skipif(os.name == "nt", reason="signals")
def test_control_c_ends_it_as_it_ends_the_program(tmp_path):
    for program in (OURS, [COMMAND]):
        subprocess.run([*program, "--quiet", "sample-scenarios", "--samples", "20000", "--out", "s.parquet", "--force"], cwd=tmp_path, check=True)
        called = subprocess.Popen([*program, "synthesize-motions", "--in", "s.parquet", "--out", "m.parquet"], cwd=tmp_path)
        time.sleep(1.5)
        called.send_signal(signal.SIGINT)
        assert called.wait(timeout=10) == -signal.SIGINT
        assert not (tmp_path / "m.parquet").exists()


def test_a_reader_that_has_seen_enough_is_no_error(tmp_path):
    done = subprocess.run(
        f'"{sys.executable}" -m rockfrag --help | head -1; exit ${{PIPESTATUS[0]}}', shell=True, executable="/bin/bash", capture_output=True
    )
    assert done.returncode == 0 and done.stderr == b""


def test_it_is_installed_under_its_name():
    try:
        package = importlib.metadata.distribution("rockfrag")
    except importlib.metadata.PackageNotFoundError:
        pytest.skip("the package is not installed, but on the path")
    (entry,) = package.entry_points.select(group="console_scripts")
    assert (entry.name, entry.value) == ("rockfrag", "rockfrag.__main__:main")
    program = pathlib.Path(sys.executable).with_name("rockfrag")
    assert subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout.startswith("rockfrag ")
