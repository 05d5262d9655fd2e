#!/usr/bin/env python3
"""Which mutants the tests catch, all in a few builds: mutants.py CRATE TEST RESULTS FILE... (with cargo-mutants in the path).

    git worktree add /tmp/copy
    scripts/attack/mutants.py /tmp/copy solver /tmp/solver.jsonl 'src/rocking/**'
    scripts/attack/mutants.py /tmp/copy fits /tmp/fits.jsonl 'src/fragility/**' 'src/statistics/**' 'src/normal/**'

The mutants are those of cargo-mutants, but a build holds many: each function becomes a match over the number of the mutant that
is wanted, which an environment variable says. What is always inlined is mutated in a build of its own, or copies would
multiply; constants and functions that return `impl Trait` are mutated one by one. A mutant that does not end counts as caught once
it has used several times the processor time of all tests. Results are appended, one JSON object a line; what stands there
already is not tried again. `--only REGEX` takes those whose names match, `--sample N` so many of them by chance. Of a sample there are few
copies: `--inlined file` takes those of functions that are always inlined, with a build for each file, or `folder`.
"""

import argparse
import itertools
import json
import os
import random
import re
import resource
import signal
import subprocess
import sys
from collections import defaultdict
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

# Tests that take most of the time: run last, on what is still alive.
DEAR = {
    "solver": ["outcomes_and_peaks_agree", "an_answer_does_not_depend", "registers_of_any_width"],
    "fits": ["limits_hold_the_truth_as_often"],
    "motion": [],
    "uncertainty": [],
}
SECONDS = 8  # of processor time; twice to three times that for the dear ones
SWITCH = """
#[doc(hidden)]
#[inline(always)]
pub fn active_mutant() -> u32 {
    let active = ACTIVE.load(std::sync::atomic::Ordering::Relaxed);
    if active == u32::MAX { wanted_mutant() } else { active }
}
static ACTIVE: std::sync::atomic::AtomicU32 = std::sync::atomic::AtomicU32::new(u32::MAX);
#[cold]
#[inline(never)]
fn wanted_mutant() -> u32 {
    let wanted = std::env::var("MUTANT").map_or(0, |number| number.parse().unwrap());
    ACTIVE.store(wanted, std::sync::atomic::Ordering::Relaxed);
    wanted
}
"""


class Source:
    """A file as it was, and where its lines begin."""

    def __init__(self, path: Path):
        self.path, self.text = path, path.read_text()
        self.starts = [0, *(match.end() for match in re.finditer("\n", self.text))]

    def at(self, place: dict) -> int:
        return self.starts[place["line"] - 1] + place["column"] - 1

    def range(self, span: dict) -> tuple[int, int]:
        return self.at(span["start"]), self.at(span["end"])

    def body(self, function: dict) -> tuple[int, int]:
        """What stands between the braces of a function."""
        start, end = self.range(function["span"])
        tokens = re.compile(r'//[^\n]*|"(?:\\.|[^"\\])*"|\'(?:\\.[^\']*|[^\'\\])\'|[{}]')
        opened = []
        for token in tokens.finditer(self.text, start, end):
            if token[0] == "{":
                opened.append(token.end())
            elif token[0] == "}":
                begin = opened.pop()
                if not opened and token.end() == end:
                    return begin, token.start()
        raise ValueError(f"{self.path}: no body of {function['function_name']}")

    def mutated(self, mutant: dict, start: int, end: int) -> str:
        low, high = self.range(mutant["span"])
        return self.text[start:low] + mutant["replacement"] + " " + self.text[high:end]


def cargo(crate: Path, *arguments: str) -> tuple[bool, list[dict]]:
    command = ["cargo", *arguments, "--offline", "--message-format=json"]
    result = subprocess.run(command, cwd=crate, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    return result.returncode == 0, [json.loads(line) for line in result.stdout.splitlines() if line.startswith("{")]


def expansions(span: dict) -> Iterator[dict]:
    """The place of an error, and where the macro was called that it lies in."""
    yield span
    if span["expansion"]:
        yield from expansions(span["expansion"]["span"])


class Build:
    """Some mutants behind a switch; `number` of each is its place in the list, from 1."""

    def __init__(self, crate: Path, mutants: list[dict], switched: bool):
        self.crate, self.mutants, self.switched = crate, mutants, switched
        self.unviable: set[int] = set()
        self.arms: dict[str, list[tuple[int, int, int]]] = {}
        self.sources = {name: Source(crate / name) for name in {mutant["file"] for mutant in mutants}}
        self.library = Source(crate / "src/lib.rs")

    def write(self) -> None:
        if not self.switched:
            (mutant,) = self.mutants
            source = self.sources[mutant["file"]]
            source.path.write_text(source.mutated(mutant, 0, len(source.text)))
            return
        self.library.path.write_text("#![allow(warnings)]\n" + self.library.text + SWITCH)
        for name, source in self.sources.items():
            bodies = defaultdict(list)
            for number, mutant in enumerate(self.mutants, 1):
                if mutant["file"] == name and number not in self.unviable:
                    bodies[source.body(mutant["function"])].append((number, mutant))
            text, last, arms = "", 0, []
            for (start, end), members in sorted(bodies.items(), key=lambda item: item[0]):
                assert start >= last, f"{name}: a function within a function"
                text += source.text[last:start] + "match crate::active_mutant() {\n"
                for number, mutant in members:
                    begin = text.count("\n") + 1
                    text += f"{number} => {{\n{source.mutated(mutant, start, end)}\n}}\n"
                    arms.append((begin, text.count("\n"), number))
                text += "_ => {\n" + source.text[start:end] + "\n}\n}\n"
                last = end
            self.arms[name] = arms
            source.path.write_text(text + source.text[last:])

    def make(self, test: str) -> str | None:
        """The test binary, without the mutants that do not compile."""
        while True:
            self.write()
            good, messages = cargo(self.crate, "check", "--lib")
            if good:
                break
            spans = [
                span
                for message in messages
                if message.get("reason") == "compiler-message" and message["message"]["level"] == "error"
                for span in message["message"]["spans"]
                if span["is_primary"]
                for span in expansions(span)
            ]
            found = {
                number
                for span in spans
                for low, high, number in self.arms.get(span["file_name"], [(0, 10**9, 1)] if not self.switched else [])
                if low <= span["line_start"] <= high
            }
            self.unviable |= found
            if not self.switched:
                return None
            if not found:
                print(*{message["message"]["rendered"] for message in messages if "message" in message}, sep="\n")
                raise SystemExit("what does not compile is no mutant")
        good, messages = cargo(self.crate, "test", "--no-run", f"--test={test}")
        if not good:
            print(*{message["message"]["rendered"] for message in messages if "message" in message}, sep="\n")
            raise SystemExit("the tests do not compile")
        return next(message["executable"] for message in messages if message.get("executable"))

    def restore(self) -> None:
        for source in [*self.sources.values(), self.library]:
            source.path.write_text(source.text)


def limited() -> None:
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    resource.setrlimit(resource.RLIMIT_AS, (8 << 30, 8 << 30))


def outcome(executable: str, test: str, number: int, folder: Path) -> tuple[str, str]:
    """How the tests end with this mutant, and the first that fails."""
    alone = {"RUST_BACKTRACE": "0", "RUST_TEST_THREADS": "1", "RAYON_NUM_THREADS": "1", "MUTANT": str(number)}
    env = {"PROPTEST_CASES": "64", **os.environ, **alone, "PROPTEST_MAX_SHRINK_ITERS": "0", "PROPTEST_RNG_SEED": "1"}
    dear = DEAR[test]
    rounds = [([*itertools.chain(*(("--skip", name) for name in dear))], SECONDS)]
    rounds += [(dear, 3 * SECONDS)] if dear else []
    for arguments, seconds in rounds:
        command = ["bash", "-c", f'ulimit -t {seconds}; exec "$@"', "-", executable, *arguments]
        # Failures that proptest would keep for the next run are written nowhere: the folder has no sources.
        run = subprocess.run(command, cwd=folder, env=env, preexec_fn=limited, capture_output=True, text=True, errors="replace", check=False)
        if run.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
            return "timeout", ""
        if run.returncode != 0:
            failed = re.findall(r"^test (\S+) .*FAILED", run.stdout, re.MULTILINE)
            return "caught", failed[0] if failed else f"status {run.returncode}"
    return "missed", ""


def builds(crate: Path, mutants: list[dict]) -> list[Build]:
    """All that can share a build, functions that are always inlined one at a time, and the rest one by one."""
    together, inlined, single = sorted_out(crate, mutants)
    groups = ([together] if together else []) + list(inlined.values())
    return [Build(crate, group, True) for group in groups] + [Build(crate, [mutant], False) for mutant in single]


def inlined_builds(crate: Path, mutants: list[dict], sample: int | None, together: str) -> list[Build]:
    """Some of the mutants of functions that are always inlined."""
    found = list(itertools.chain(*sorted_out(crate, mutants)[1].values()))
    groups = defaultdict(list)
    for mutant in sampled(found, sample):
        file = Path(mutant["file"])
        groups[file if together == "file" else file.parent].append(mutant)
    return [Build(crate, group, True) for group in groups.values()]


def sampled(mutants: list[dict], number: int | None) -> list[dict]:
    return mutants if number is None else random.Random(1).sample(mutants, min(number, len(mutants)))


def sorted_out(crate: Path, mutants: list[dict]) -> tuple[list[dict], dict[tuple, list[dict]], list[dict]]:
    """Those that can share a build, those of each function that is always inlined, and the rest."""
    together, inlined, single = [], defaultdict(list), []
    sources = {}
    for mutant in mutants:
        source = sources.setdefault(mutant["file"], Source(crate / mutant["file"]))
        function = mutant["function"]
        if function is None:
            single.append(mutant)
            continue
        head = source.text[source.at(function["span"]["start"]) : source.body(function)[0]]
        if re.search(r"-> impl|const fn", head):
            single.append(mutant)
        elif "inline(always)" in head:
            inlined[mutant["file"], source.body(function)].append(mutant)
        else:
            together.append(mutant)
    return together, inlined, single


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("crate", type=Path)
    parser.add_argument("test", choices=DEAR)
    parser.add_argument("results", type=Path)
    parser.add_argument("files", nargs="+")
    parser.add_argument("--only", default="")
    parser.add_argument("--sample", type=int, help="so many of them, by chance")
    parser.add_argument("--inlined", choices=["file", "folder"], help="those that are always inlined, a build for each")
    parser.add_argument("--jobs", type=int, default=2)
    options = parser.parse_args()
    crate = options.crate.resolve()
    listed = ["cargo", "mutants", "--list", "--json", *itertools.chain(*(("--file", file) for file in options.files))]
    mutants = json.loads(subprocess.run(listed, cwd=crate, capture_output=True, text=True, check=True).stdout)
    done = options.results.read_text().splitlines() if options.results.exists() else []
    done = {json.loads(line)["name"] for line in done}
    mutants = [mutant for mutant in mutants if mutant["name"] not in done and re.search(options.only, mutant["name"])]
    if options.inlined:
        wanted = inlined_builds(crate, mutants, options.sample, options.inlined)
    else:
        wanted = builds(crate, sampled(mutants, options.sample))
    folder = options.results.resolve().with_suffix(".empty")
    folder.mkdir(parents=True, exist_ok=True)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit("ended"))  # so that the sources are put back
    with options.results.open("a") as results:

        def say(mutant: dict, how: str, by: str = "") -> None:
            results.write(json.dumps({"name": mutant["name"], "outcome": how, "by": by}) + "\n")
            results.flush()

        for build in wanted:
            try:
                executable = build.make(options.test)
                numbered = [(n, mutant) for n, mutant in enumerate(build.mutants, 1) if n not in build.unviable]
                if executable is None:
                    numbered = []
                elif outcome(executable, options.test, 0, folder)[0] != "missed":
                    raise SystemExit("tests fail without a mutant")
                for number in build.unviable:
                    say(build.mutants[number - 1], "unviable")
                random.Random(1).shuffle(numbered)  # so that what is done when time is up is a sample
                with ThreadPoolExecutor(options.jobs) as pool:
                    for (_, mutant), (how, by) in zip(
                        numbered, pool.map(lambda item: outcome(executable, options.test, item[0], folder), numbered)
                    ):
                        say(mutant, how, by)
            finally:
                build.restore()
            print(f"{len(build.mutants)} mutants, {len(build.unviable)} of them no program", file=sys.stderr, flush=True)


if __name__ == "__main__":
    main()
