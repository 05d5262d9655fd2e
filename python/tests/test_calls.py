"""A call tells how far it is, can be interrupted, and lets other threads work meanwhile."""

import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pyarrow as pa
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


FORKED = """
import multiprocessing, rockfrag
def used(_):
    return len(rockfrag.sample_scenarios(samples=1))
if __name__ == "__main__":
    used(0)
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        print(pool.map(used, [0]))
    try:
        with multiprocessing.get_context("fork").Pool(1) as pool:
            pool.map(used, [0])
    except rockfrag.RockfragError as error:
        print(error)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="processes are not forked here")
def test_a_forked_process_is_told_to_spawn(tmp_path):
    script = tmp_path / "forked.py"
    script.write_text(FORKED)
    told = subprocess.run([sys.executable, "-W", "ignore", script], capture_output=True, text=True, timeout=120, check=True)
    assert told.stdout.startswith("[35]") and "start method 'spawn'" in told.stdout, told


def test_motions_in_g_are_asked_for_their_unit():
    rng = np.random.default_rng(1)
    table = pa.table({"motion_id": ["a", "b"], "dt_s": [0.01, 0.01], "acceleration_m_s2": [list(0.2 * rng.normal(size=500)) for _ in "ab"]})
    with pytest.warns(rockfrag.RockfragWarning, match="no motion rocks: PGA is at most .* is it in g?"):
        rockfrag.simulate(table, width=0.5, height=2.0)
