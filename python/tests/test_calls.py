"""A call tells how far it is, can be interrupted, and lets other threads work meanwhile."""

import os
import signal
import subprocess
import sys
import threading
import time

import pytest
import rockfrag


def test_progress_rises_to_all(out):
    told = []
    rockfrag.synthesize_motions(out / "scenarios.parquet", progress=lambda done, of: told.append((done, of)))
    assert told == sorted(told)
    assert told[-1] == (40, 40)


def test_an_exception_in_the_callback_ends_the_call(out):
    def stop(done, of):
        raise RuntimeError("enough")

    scenarios = rockfrag.sample_scenarios(samples=300)
    with pytest.raises(RuntimeError, match="enough"):
        rockfrag.synthesize_motions(scenarios, progress=stop)


def test_other_threads_work_meanwhile():
    ticks = []
    over = threading.Event()

    def tick():
        while not over.is_set():
            ticks.append(time.perf_counter())
            time.sleep(0.005)

    thread = threading.Thread(target=tick)
    thread.start()
    start = time.perf_counter()
    rockfrag.synthesize_motions(rockfrag.sample_scenarios(samples=20), threads=1)
    end = time.perf_counter()
    over.set()
    thread.join()
    assert sum(start < tick < end for tick in ticks) > 3


def interrupted(begin, call):
    """Sends an interrupt to a process in the midst of a call; what it prints of it."""
    code = (
        f"import rockfrag\n{begin}\nprint('begun', flush=True)\n"
        f"try:\n    {call}\nexcept KeyboardInterrupt:\n    print('interrupted')\n"
    )
    called = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, text=True)
    assert called.stdout.readline() == "begun\n"
    time.sleep(0.5)
    called.send_signal(signal.SIGINT)
    return called.communicate(timeout=120)[0]


def test_control_c_ends_a_call_and_leaves_nothing(tmp_path):
    scenarios, motions = str(tmp_path / "scenarios.parquet"), str(tmp_path / "motions.parquet")
    told = interrupted(
        f"rockfrag.sample_scenarios(samples=20000, out={scenarios!r})",
        f"rockfrag.synthesize_motions({scenarios!r}, out={motions!r})",
    )
    assert told == "interrupted\n"
    assert os.listdir(tmp_path) == ["scenarios.parquet"]


def test_control_c_ends_refits(out):
    responses = str(out / "responses.parquet")
    assert interrupted("", f"rockfrag.fit_pex({responses!r}, bootstrap=1_000_000)") == "interrupted\n"
