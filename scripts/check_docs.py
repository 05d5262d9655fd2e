"""Runs the commands of README.md and docs with an environment that has the wheel: check_docs.py BIN

    ```sh         run, and must end with exit code 0
    ```text       after ```sh: an output, perhaps in part; its lines must stand in what came out, in this order
    ```python     run as one script a page, but for those with "# not run"
    ```console    not run: what installs, compiles, or needs a cluster
    `scripts/...` and the like, and links: must exist

Each page has a folder of its own with data, scripts, python and pipeline.yaml of the repository.
"""

import functools
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
# Scripts, tests and data that make the numbers of a page, and pages and pictures that it links.
NAMED = re.compile(r"`((?:scripts|core|tests|data)/[\w./]+)|\]\((?!http)([^)#]+)")
BLOCK = re.compile(r"^```(\w+)\n(.*?)^```$", re.MULTILINE | re.DOTALL)


def missing(shown, output):
    """The first line shown that does not follow in the output; None if all do."""
    lines = lambda text: [" ".join(line.split()) for line in text.splitlines() if line.strip()]
    found = iter(lines(output))
    return next((line for line in lines(shown) if line not in found), None)


def faults(page, environment):
    """What is wrong with a page."""
    text = page.read_text()
    for name in map("".join, NAMED.findall(text)):
        if not any((folder / name).exists() for folder in (ROOT, page.parent)):
            yield f"there is no {name}"
    blocks = [(match[1], match[2], text[: match.start()].count("\n") + 1) for match in BLOCK.finditer(text)]
    with tempfile.TemporaryDirectory() as folder:
        both = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True}
        run = functools.partial(subprocess.run, cwd=folder, env=environment, **both)
        for name in ["data", "scripts", "python", "pipeline.yaml"]:
            os.symlink(ROOT / name, pathlib.Path(folder) / name)
        done = None
        for language, content, line in blocks:
            if language == "sh":
                done = run(["bash", "-euo", "pipefail", "-c", content])
                if done.returncode:
                    yield f"line {line}: exit code {done.returncode}\n{done.stdout}"
            elif language != "text":
                done = None
            elif done and (other := missing(content, done.stdout)) is not None:
                yield f"line {line}: '{other}' is not in the output\n{done.stdout}"
        of_python = (content for language, content, _ in blocks if language == "python")
        scripts = [content for content in of_python if not content.startswith("# not run")]
        done = run(["python", "-c", "\n".join(scripts)])
        if done.returncode:
            yield f"python: exit code {done.returncode}\n{done.stdout}"


path = f"{os.path.abspath(sys.argv[1])}{os.pathsep}{os.environ['PATH']}"
environment = {**os.environ, "PATH": path, "MPLBACKEND": "Agg"}
pages = [ROOT / "README.md", *sorted(ROOT.glob("docs/**/*.md"))]
wrong = [f"{page}, {fault}" for page in pages for fault in faults(page, environment)]
if wrong:
    sys.exit("\n".join(wrong))
print(f"{len(pages)} pages: every command runs, and prints the lines that are shown")
