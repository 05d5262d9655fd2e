"""Runs the commands of README.md and docs: check_docs.py ROCKFRAG [--python PYTHON] [PAGE...]

    ```sh         run, and must end with exit code 0
    ```text       after ```sh: an output, perhaps in part; its lines must stand in what came out, in this order
    ```python     run as one script a page by --python (a Python with the package), but for those with "# not run"
    ```console    not run: what installs, compiles, or needs a cluster

Each page has a folder of its own with data, scripts, python and pipeline.yaml of the repository.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def missing(shown, output):
    """The first line shown that does not follow in the output; None if all do."""
    lines = lambda text: [" ".join(line.split()) for line in text.splitlines() if line.strip()]
    found = iter(lines(output))
    return next((line for line in lines(shown) if line not in found), None)


def run(command, folder, environment):
    """The exit code of a command, and what it prints."""
    both = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
    done = subprocess.run(command, cwd=folder, env=environment, **both)
    return done.returncode, done.stdout


def faults(page, environment, python):
    """What is wrong with a page."""
    text = page.read_text()
    blocks = [(match[1], match[2], text[: match.start()].count("\n") + 1) for match in BLOCK.finditer(text)]
    with tempfile.TemporaryDirectory() as folder:
        for name in ["data", "scripts", "python", "pipeline.yaml"]:
            os.symlink(ROOT / name, pathlib.Path(folder) / name)
        output = None
        for language, content, line in blocks:
            if language == "sh":
                code, output = run(["bash", "-euo", "pipefail", "-c", content], folder, environment)
                if code:
                    yield f"line {line}: exit code {code}\n{output}"
            elif language == "text" and output is not None:
                other = missing(content, output)
                if other is not None:
                    yield f"line {line}: '{other}' is not in the output\n{output}"
            if language not in ("sh", "text"):
                output = None
        of_python = (content for language, content, _ in blocks if language == "python")
        scripts = [content for content in of_python if not content.startswith("# not run")]
        if python and scripts:
            code, output = run([python, "-c", "\n".join(scripts)], folder, environment)
            if code:
                yield f"python: exit code {code}\n{output}"


parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("rockfrag", type=pathlib.Path)
parser.add_argument("--python", type=pathlib.Path)
parser.add_argument("pages", nargs="*", type=pathlib.Path)
options = parser.parse_intermixed_args()
path = f"{options.rockfrag.absolute().parent}:{os.environ['PATH']}"
environment = {**os.environ, "PATH": path, "MPLBACKEND": "Agg"}
pages = options.pages or [ROOT / "README.md", *sorted(ROOT.glob("docs/**/*.md"))]
python = options.python and options.python.absolute()
wrong = [f"{page}, {fault}" for page in pages for fault in faults(page, environment, python)]
if wrong:
    sys.exit("\n".join(wrong))
print(f"{len(pages)} pages: every command runs, and prints the lines that are shown")
