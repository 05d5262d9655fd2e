#!/usr/bin/env python3
"""What a machine does to a run: faults.py ROCKFRAG [TRIES [ATTACK...]]. Prints for each attack how often it was tried and what failed.

A try fails where a stage neither ends well nor says in a line why not, where something that is no whole file stands at a
final name, where a partial file outlives the next run, or where that run does not give the bytes of an undisturbed one.
Full and read-only disks are mounted, which needs root.
"""

import os
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from contextlib import contextmanager
from pathlib import Path

ROCKFRAG = str(Path(sys.argv[1]).resolve())
TRIES = int(sys.argv[2]) if len(sys.argv) > 2 else 200
PIPELINE = """\
seed: 7
out: out
sample-scenarios: { mw: "6.5,7.5", re: "5,10", samples: 60 }
synthesize-motions: { suite: [pulse, csgm], dt: 0.01 }
simulate:
  structures:
    - { name: frame, p: 1.0, alpha: 0.15, eta: 0.92 }
    - { name: electrical-equipment, p: 2.5, alpha: 0.20, eta: 0.92 }
ida: { structures: paper, from: 1, to: 2, steps: 4 }
fit-pex: { bootstrap: 200 }
fit-pro: { bootstrap: 50 }
universality: {}
rank-ims: {}
compare-paper: {}
report: { groups: 1, motions: 3, dpi: 36 }
"""
# What a plan calls up to date where nothing is to be done.
STAGES_OF_RUN = 10
# Each stage, on the files of an undisturbed run, into the folder {o}.
FITS = "--pex {i}/pex.parquet --pro {i}/pro.parquet --structure electrical-equipment --suite csgm --p 2.5 --alpha 0.20"
STAGES = {
    "sample-scenarios": "--samples 2000 --out {o}/scenarios.parquet",
    "synthesize-motions": "--in {i}/scenarios.parquet --out {o}/motions.parquet",
    "import-motions": "{i}/../record.txt --unit g --accept-implausible --out {o}/records.parquet",
    "simulate": "--in {i}/motions.parquet --structures paper --trace 0,1 --out {o}/one.parquet",
    "fit-pex": "--in {i}/responses.parquet --bootstrap 100 --out {o}/pex.parquet",
    "fit-pro": "--in {i}/responses.parquet --out {o}/pro.parquet",
    "ida": "--in {i}/motions.parquet --structures paper --from 1 --to 2 --steps 4 --out {o}/ida.parquet",
    "universality": "--in {i}/responses.parquet --out {o}/universality.parquet",
    "rank-ims": "--in {i}/responses.parquet --out {o}/ranking.parquet",
    "compare-paper": "--pex {i}/pex.parquet --pro {i}/pro.parquet --responses {i}/responses.parquet --out {o}/paper.parquet",
    "validate": "--in {i}/responses.parquet --pex {i}/pex.parquet --pro {i}/pro.parquet --out {o}/validation.parquet",
    "evaluate": FITS + " --in {i}/motions.parquet --out {o}/evaluated.parquet",
    "report": "--in {i} --groups 1 --motions 3 --dpi 36 --out {o}/report.html",
    "export": FITS + " --to openquake --im pga --ratio 0.3 --tolerance 1e-5 --out {o}/fragility.xml",
}


# Where memory runs out while Rust makes a backtrace, it waits for its own lock for ever: a fault of its runtime, not ours.
os.environ["RUST_BACKTRACE"] = "0"


def call(arguments, **more):
    return subprocess.run([ROCKFRAG, "--quiet", *arguments.split()], capture_output=True, text=True, timeout=600, **more)


def contents(folder):
    return {str(path.relative_to(folder)): path.read_bytes() for path in Path(folder).rglob("*") if path.is_file()}


def whole(folder, right):
    """That final names hold right bytes, whatever else there is."""
    return all(content == right[name] for name, content in contents(folder).items() if not name.endswith(".partial"))


def told(run):
    """That a failed stage says why, in a line that is no accident."""
    return run.returncode in (1, 2) and "error: " in run.stderr and "panicked" not in run.stderr


class Attacks:
    def __init__(self, work):
        self.work, self.rows = Path(work), {}
        (self.work / "pipeline.yaml").write_text(PIPELINE)
        (self.work / "record.txt").write_text("".join(f"{k * 0.01:.2f} {0.3 * ((k * k) % 97 - 48) / 48}\n" for k in range(3000)))
        undisturbed = self.run_all(self.work)
        assert undisturbed.returncode == 0, undisturbed.stderr
        self.files = self.work / "out"
        self.right_files = contents(self.files)
        self.right = {}
        for stage in STAGES:
            folder = self.work / "right" / stage
            folder.mkdir(parents=True)
            run = self.stage(stage, folder)
            assert run.returncode == 0, (stage, run.stderr)
            self.right[stage] = contents(folder)

    def run_all(self, folder, **more):
        return call(f"run {folder}/pipeline.yaml", **more)

    def stage(self, stage, out, **more):
        return call(f"--force {stage} " + STAGES[stage].format(i=self.files, o=out), **more)

    def count(self, attack, failure):
        tries, failures = self.rows.setdefault(attack, [0, []])
        self.rows[attack][0] += 1
        if failure:
            failures.append(failure)
            print(f"  {attack}: {failure}", file=sys.stderr, flush=True)

    @contextmanager
    def disk(self, kilobytes):
        mount = self.work / "mount"
        mount.mkdir(exist_ok=True)
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={kilobytes}k", "tmpfs", mount], check=True)
        try:
            yield mount
        finally:
            subprocess.run(["umount", mount], check=True)

    def after(self, stage, folder, run):
        """What is wrong after a disturbed stage, and with the stage after that."""
        if run is not None and run.returncode != 0 and not told(run):
            return f"{stage}: exit {run.returncode}: {run.stderr[-300:]}"
        if not whole(folder, self.right[stage]):
            return f"{stage}: a wrong file at a final name"
        again = self.stage(stage, folder)
        if again.returncode != 0 or contents(folder) != self.right[stage]:
            return f"{stage}: run again: exit {again.returncode}, {sorted(contents(folder))} {again.stderr[-300:]}"
        return None

    def disk_full(self):
        for stage in STAGES:
            needed = sum(len(content) for content in self.right[stage].values()) // 1024
            for share in (0.0, 0.3, 0.6, 0.9):
                with self.disk(4 + int(needed * share) // 4 * 4) as mount:
                    run = self.stage(stage, mount)
                    failure = None if run.returncode == 0 or told(run) else f"{stage}: {run.returncode} {run.stderr[-300:]}"
                    left = [name for name in contents(mount) if name not in self.right[stage]]
                    failure = failure or (f"{stage}: leaves {left}" if left else None)
                    failure = failure or (None if whole(mount, self.right[stage]) else f"{stage}: a wrong file")
                    subprocess.run(["mount", "-o", "remount,size=200m", mount], check=True)
                    self.count("disk full", failure or self.after(stage, mount, None))

    def read_only(self):
        for stage in STAGES:
            with self.disk(200_000) as mount:
                subprocess.run(["mount", "-o", "remount,ro", mount], check=True)
                run = self.stage(stage, mount)
                failure = None if told(run) else f"{stage}: {run.returncode} {run.stderr[-300:]}"
                subprocess.run(["mount", "-o", "remount,rw", mount], check=True)
                self.count("read-only target", failure or self.after(stage, mount, None))

    def signals(self, how):
        folder = self.work / how.name
        for _ in range(TRIES):
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            (folder / "pipeline.yaml").write_text(PIPELINE)
            child = subprocess.Popen([ROCKFRAG, "--quiet", "run", "--force", folder / "pipeline.yaml"],
                                     stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(random.random() * self.duration)
            child.send_signal(how)
            child.wait()
            failure = None if whole(folder / "out", self.right_files) else "a wrong file at a final name"
            again = self.run_all(folder)
            if not failure and (again.returncode != 0 or contents(folder / "out") != self.right_files):
                failure = f"run again: exit {again.returncode} {sorted(contents(folder / 'out'))} {again.stderr[-300:]}"
            self.count(f"{how.name} at any moment", failure)

    def two_runs(self):
        folder = self.work / "two"
        for _ in range(TRIES // 10):
            shutil.rmtree(folder, ignore_errors=True)
            folder.mkdir()
            (folder / "pipeline.yaml").write_text(PIPELINE)
            command = [ROCKFRAG, "--quiet", "run", "--force", folder / "pipeline.yaml"]
            # The second one with another seed, so that files of both would not fit together.
            pair = []
            for seed in ("7", "8"):
                pair.append(subprocess.Popen([*command, "--seed", seed], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True))
                time.sleep(random.random() * self.duration / 2)
            codes = [(run.wait(), run.stderr.read()) for run in pair]
            ended = [code == 0 or "error: " in words for code, words in codes]
            plan = call(f"run --seed 8 --dry-run {folder}/pipeline.yaml").stdout
            failure = None if all(ended) else f"{codes}"
            fits = plan.count("up to date") == STAGES_OF_RUN or contents(folder / "out") == self.right_files
            failure = failure or (None if fits else f"files of two runs stand side by side: {plan}")
            again = call(f"run --seed 7 {folder}/pipeline.yaml")
            failure = failure or (None if contents(folder / "out") == self.right_files else f"run again: {again.stderr[-300:]}")
            self.count("two runs in a folder", failure)

    def replaced(self):
        """The motions that simulate reads are replaced, removed or cut short meanwhile."""
        folder = self.work / "replaced"
        folder.mkdir()
        other = folder / "other.parquet"
        call(f"--force sample-scenarios --seed 99 --mw 6.5,7.5 --re 5,10 --samples 60 --out {folder}/s.parquet")
        call(f"--force synthesize-motions --dt 0.01 --in {folder}/s.parquet --out {other}")
        motions, out = folder / "motions.parquet", folder / "responses.parquet"
        answers = {}
        for source in (self.files / "motions.parquet", other):
            call(f"--force simulate --structures paper --in {source} --out {out}")
            answers[source] = out.read_bytes()
        right, wrong = answers.values()
        start = time.monotonic()
        call(f"--force simulate --structures paper --in {other} --out {out}")
        duration = time.monotonic() - start
        for attempt in range(TRIES // 2):
            out.unlink(missing_ok=True)
            shutil.copy(self.files / "motions.parquet", motions)
            shutil.copy(other, folder / "next.parquet")
            child = subprocess.Popen([ROCKFRAG, "--quiet", "--force", "simulate", "--structures", "paper", "--in", motions, "--out", out],
                                     stderr=subprocess.PIPE, text=True)
            time.sleep(random.random() * duration)
            how = ("replaced", "removed", "cut short")[attempt % 3]
            if how == "replaced":
                os.rename(folder / "next.parquet", motions)
            elif how == "removed":
                motions.unlink()
            else:
                os.truncate(motions, 1000)
            words = child.communicate()[1]
            ends = child.returncode == 0 or (child.returncode == 1 and "error: " in words and "panicked" not in words)
            failure = None if ends else f"{how}: exit {child.returncode} {words[-300:]}"
            if out.exists() and out.read_bytes() not in (right, wrong):
                failure = failure or f"{how}: responses that say they are of other motions than they are"
            self.count(f"input {how} while read", failure)

    def memory(self):
        for stage in STAGES:
            for megabytes in range(40, 400, 40):
                folder = self.work / "memory"
                shutil.rmtree(folder, ignore_errors=True)
                folder.mkdir()
                limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (megabytes << 20, megabytes << 20))
                self.stage(stage, folder, preexec_fn=limit)
                # Rust ends a program that gets no memory; what counts is what it leaves behind.
                self.count("memory limit hit", self.after(stage, folder, None))

    def clock(self):
        for year in (1970, 2038, 2300):
            for path in self.files.iterdir():
                os.utime(path, (time.mktime((year, 1, 2, 0, 0, 0, 0, 0, 0)),) * 2)
            plan = call(f"run --dry-run {self.work}/pipeline.yaml").stdout
            self.count("clock set back or forward", None if plan.count("up to date") == STAGES_OF_RUN else plan)

    def all(self):
        start = time.monotonic()
        shutil.rmtree(self.work / "timed", ignore_errors=True)
        (self.work / "timed").mkdir()
        (self.work / "timed" / "pipeline.yaml").write_text(PIPELINE)
        self.run_all(self.work / "timed")
        self.duration = time.monotonic() - start
        attacks = {
            "full": self.disk_full,
            "read-only": self.read_only,
            "signals": lambda: [self.signals(how) for how in (signal.SIGKILL, signal.SIGINT, signal.SIGTERM)],
            "together": self.two_runs,
            "replaced": self.replaced,
            "memory": self.memory,
            "clock": self.clock,
        }
        for name in sys.argv[3:] or attacks:
            attacks[name]()
        print("| attack | tries | failures |\n|---|---|---|")
        for attack, (tries, failures) in self.rows.items():
            print(f"| {attack} | {tries} | {len(failures)} |")
        return any(failures for _, failures in self.rows.values())


with tempfile.TemporaryDirectory(prefix="rockfrag-faults-") as folder:
    sys.exit(Attacks(folder).all())
