"""Runs what README.md, CONTRIBUTING.md and docs print, and compares: check_docs.py ROCKFRAG [--update] [--python PYTHON] [PAGE...]

Fenced blocks are read by the words after their language:

    ```console                     commands after "$ ", each with its output below; "..." stands for any text of a line, and
                                   alone on a line for any lines; seconds are not compared
    ```console not-run: REASON     commands that cannot run here
    ```LANGUAGE write: FILE        the block is a file that commands below read
    ```python                      run as one script a page, by --python (a Python with the package); not without it

Each page has a folder of its own with data, scripts and pipeline.yaml of the repository. The comment <!-- before: COMMAND -->
runs a command there first; pages with the same one share what it makes. A command may fail where its output shows an error.
--update writes what came out into the pages. Anything else that looks like a command is a mistake.
"""

import argparse
import difflib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
FENCE = re.compile(r"(`{3,})(.*)")
BEFORE = re.compile(r"<!-- before: (.*) -->")
COMMAND = re.compile(r"\s*(\$ |(rockfrag|cargo|pip|git|make|python3?|sbatch|docker) )")
SECONDS = re.compile(r"\b\d+\.\d+ s\b")


class Block:
    """A fenced block: its language, the words after it, and its lines from `start` on."""

    def __init__(self, info, start, lines):
        self.language, _, self.words = info.strip().partition(" ")
        self.start, self.lines = start, lines

    def note(self, key):
        return self.words.removeprefix(f"{key}: ") if self.words.startswith(f"{key}: ") else None

    def commands(self):
        """Pairs of a command and the output expected below it, both as lines."""
        pairs, rest = [], list(self.lines)
        while rest:
            command = [rest.pop(0)]
            if not command[0].startswith("$ "):
                raise ValueError(f"line {self.start}: expected '$ ' before the first command, found {command[0]!r}")
            while command[-1].endswith("\\"):
                command.append(rest.pop(0))
            output = []
            while rest and not rest[0].startswith("$ "):
                output.append(rest.pop(0))
            pairs.append((command, output))
        return pairs


def blocks_of(lines):
    """The fenced blocks of a page; raises where a command stands outside of those that are run."""
    blocks, number = [], 0
    while number < len(lines):
        fence = FENCE.fullmatch(lines[number])
        if not fence:
            if lines[number].startswith("    ") and COMMAND.match(lines[number]):
                raise ValueError(f"line {number + 1}: a command in an indented block; expected a console block")
            number += 1
            continue
        end = lines.index(fence[1], number + 1)
        block = Block(fence[2], number + 1, lines[number + 1 : end])
        inert = block.note("write") or block.language in ("console", "python") or block.language.startswith("{")
        if not inert and any(COMMAND.match(line) for line in block.lines):
            raise ValueError(f"line {block.start}: a command in a block of '{block.language}'; expected a console block")
        blocks.append(block)
        number = end + 1
    return blocks


def matches(expected, actual):
    """Whether the output is the expected one, in which '...' elides."""
    pattern = []
    for line in expected:
        if line == "...":
            pattern.append(r"(?:.*\n)*?")
        else:
            pattern.append(r".*?".join(re.escape(part) for part in line.split("...")) + r"\n")
    return re.fullmatch("".join(pattern), "".join(line + "\n" for line in actual)) is not None


def elided(expected, actual):
    """The new output with as much left out as before."""

    def kept(part, lines):
        return [old if matches([old], [new]) else new for old, new in zip(part, lines)] + lines[len(part) :]

    if "..." not in expected:
        return kept(expected, actual)
    parts = [[]]
    for line in expected:
        if line == "...":
            parts.append([])
        else:
            parts[-1].append(line)
    first, middle, last = parts[0], parts[1:-1], parts[-1]
    lines, at, end = kept(first, actual[: len(first)]), len(first), len(actual) - len(last)
    for part in middle:
        places = range(at, max(at, end - len(part)) + 1)
        alike = lambda place: difflib.SequenceMatcher(None, "\n".join(part), "\n".join(actual[place : place + len(part)])).ratio()
        at = max(places, key=alike)
        lines += ["...", *kept(part, actual[at : at + len(part)])]
        at += len(part)
    return [*lines, "...", *kept(last, actual[max(end, 0) :])] if last else [*lines, "..."]


class Folders:
    """Makes the folder of each page."""

    def __init__(self, root, program):
        self.root, self.made = root, {}
        self.environment = {
            **os.environ,
            "PATH": f"{program.parent}:{os.environ['PATH']}",
            "NO_COLOR": "1",
            "LC_ALL": "C.UTF-8",
            "PYTHONDONTWRITEBYTECODE": "1",
        }

    def run(self, command, folder):
        return subprocess.run(
            ["bash", "-c", command],
            cwd=folder,
            env=self.environment,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
        )

    def fresh(self, before):
        """A folder in which `before` has been run, once for all pages that ask for it."""
        if before not in self.made:
            folder = self.root / f"before-{len(self.made)}"
            folder.mkdir()
            for name in ("data", "scripts"):
                shutil.copytree(ROOT / name, folder / name, ignore=shutil.ignore_patterns("__pycache__"))
            shutil.copy(ROOT / "pipeline.yaml", folder)
            if before and (done := self.run(before, folder)).returncode:
                raise ValueError(f"before: {before}\n{done.stdout}")
            self.made[before] = folder
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.root))
        shutil.copytree(self.made[before], folder, dirs_exist_ok=True, copy_function=os.link)
        return folder


class Page:
    """A page, what it prints and what came out."""

    def __init__(self, path):
        self.path, self.name = path, str(path.relative_to(ROOT))
        self.lines = path.read_text().splitlines()
        self.printed = self.ran = self.wrong = self.scripts = 0

    def check(self, folders, python, update):
        before = next((found[1] for line in self.lines if (found := BEFORE.fullmatch(line))), "")
        blocks = blocks_of(self.lines)
        folder = folders.fresh(before) if any(block.language in ("console", "python") for block in blocks) else None
        script, replaced = [], []
        for block in blocks:
            if name := block.note("write"):
                (folder / name).unlink(missing_ok=True)
                (folder / name).write_text("".join(line + "\n" for line in block.lines))
            elif block.language == "python" and not block.words:
                script += block.lines
            elif block.language == "console":
                replaced.append((block, self.console(block, folders, folder)))
        if script:
            self.scripts = 1
            if python:
                self.script(python, "\n".join(script), folders, folder)
        if update:
            for block, lines in reversed(replaced):
                self.lines[block.start : block.start + len(block.lines)] = lines
            self.path.write_text("\n".join(self.lines) + "\n")

    def console(self, block, folders, folder):
        """Runs a block and returns it as it should be."""
        pairs = block.commands()
        self.printed += len(pairs)
        if block.note("not-run"):
            return block.lines
        if block.words:
            raise ValueError(f"line {block.start}: console {block.words}; expected nothing, or not-run: REASON")
        lines = []
        for command, expected in pairs:
            self.ran += 1
            text = "\n".join(command).removeprefix("$ ")
            done = folders.run(text, folder)
            actual = [SECONDS.sub("... s", line).rstrip() for line in done.stdout.splitlines()]
            if done.returncode and not any(line.startswith("error:") for line in expected):
                print(f"{self.name}: exit code {done.returncode} of: {text}\n{done.stdout}", file=sys.stderr)
                self.wrong += 1
            same = matches(expected, actual)
            if not same:
                expected_now = elided(expected, actual)
                print(f"{self.name}, line {block.start}: {text}", file=sys.stderr)
                for line in difflib.unified_diff(expected, expected_now, "printed", "came out", n=1, lineterm=""):
                    print(f"    {line}", file=sys.stderr)
                self.wrong += 1
                expected = expected_now
            lines += [*command, *expected]
        return lines

    def script(self, python, text, folders, folder):
        (folder / "page.py").write_text(text + "\n")
        done = folders.run(f"MPLBACKEND=agg '{python}' page.py", folder)
        if done.returncode:
            print(f"{self.name}: its Python fails:\n{done.stdout}", file=sys.stderr)
            self.wrong += 1


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rockfrag", type=pathlib.Path)
    parser.add_argument("pages", nargs="*", type=pathlib.Path)
    parser.add_argument("--update", action="store_true")
    parser.add_argument("--python")
    arguments = parser.parse_intermixed_args()
    pages = arguments.pages or [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
    printed = ran = wrong = 0
    with tempfile.TemporaryDirectory() as root:
        folders = Folders(pathlib.Path(root), arguments.rockfrag.resolve())
        for page in [Page(path.resolve()) for path in pages]:
            start = time.monotonic()
            try:
                page.check(folders, arguments.python, arguments.update)
            except ValueError as error:
                print(f"{page.name}: {error}", file=sys.stderr)
                page.wrong += 1
            python = f", python {'run' if arguments.python else 'not run'}" if page.scripts else ""
            if page.printed or python or page.wrong:
                print(f"{page.name}: {page.printed} commands, {page.ran} run, {page.wrong} wrong{python}, {time.monotonic() - start:.0f} s", flush=True)
            printed, ran, wrong = printed + page.printed, ran + page.ran, wrong + page.wrong
    print(f"{printed} commands printed, {ran} run, {wrong} wrong")
    sys.exit(1 if wrong and not arguments.update else 0)


main()
