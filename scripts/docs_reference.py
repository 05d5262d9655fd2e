"""Writes the reference of the book: docs_reference.py ROCKFRAG FOLDER

commands.md comes from the help of each command, columns.md from the declarations in src/table. The page of statuses must name
every status of a fit.
"""

import os
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
COLUMN = re.compile(r'^    (\w+)(?: = "([^"]+)")?: (\w+), "([^"]*)", "((?:[^"\\]|\\.)*)";')
TABLE = re.compile(
    r'table! \{\n((?:    ///.*\n)+)    pub struct \w+(?:<[^>]*>)? as \w+ = "([^"]+)" by "([^"]+)" \{\n((?:        .*\n)+)    \}'
)
FIELD = re.compile(r"^        (\w+): .*?(?: = (\w+))?,$")
TYPES = {"Float64": "f64", "Int64": "i64", "Int32": "i32", "Text": "text", "Samples": "list of f32"}


def help_of(program, *command):
    environment = {**os.environ, "NO_COLOR": "1", "COLUMNS": "100"}
    return subprocess.run([program, *command, "--help"], env=environment, check=True, capture_output=True, text=True).stdout


def commands(program):
    overview = help_of(program)
    listed = overview.split("Commands:\n")[1].split("\n\n")[0]
    names = [name for name in re.findall(r"^  ([a-z][a-z-]*) ", listed, re.MULTILINE) if name != "help"]
    parts = ["# Commands\n", "What `rockfrag COMMAND --help` prints.\n", f"```text\n{overview.rstrip()}\n```\n"]
    for name in names:
        text = help_of(program, name).split("\nCommon options:")[0].rstrip()
        parts.append(f"## {name}\n\n```text\n{text}\n```\n")
    return "\n".join(parts)


def dictionary():
    """Every column by the name that tables take it by: name in the file, type, unit, meaning."""
    found = {}
    for line in (ROOT / "src/table/schema/dictionary.rs").read_text().splitlines():
        if column := COLUMN.match(line):
            key, name, kind, unit, meaning = column.groups()
            found[key] = (name or key, TYPES.get(kind, kind), "" if unit == "1" else unit, meaning.replace("|", "\\|"))
    return found


def columns():
    known = dictionary()
    parts = [
        "# Columns\n",
        "Each table with its columns: type, unit and meaning. The same stands in the metadata of the fields of each Parquet file, and "
        "`rockfrag inspect FILE` prints it with the smallest and the largest value. A column may be null where it has no meaning.\n",
        "The stripes of `ida` have the columns of responses, and then those of levels. "
        "A column of spectral accelerations is called by its period: `sa_0p20_m_s2` is that at 0.2 s.\n",
    ]
    for path in sorted((ROOT / "src/table").glob("*.rs")):
        for comment, name, stage, body in TABLE.findall(path.read_text()):
            about = " ".join(line.strip().removeprefix("///").strip() for line in comment.splitlines())
            parts += [f"## {name} ({stage})\n", f"{about}\n", "| column | type | unit | meaning |", "|---|---|---|---|"]
            for line in body.splitlines():
                if field := FIELD.match(line):
                    column, kind, unit, meaning = known[field[2] or field[1]]
                    parts.append(f"| `{column}` | {kind} | {unit} | {meaning} |")
            parts.append("")
    return "\n".join(parts)


def check_statuses():
    page = (ROOT / "docs/reference/statuses.md").read_text()
    declared = re.search(r"keywords!\(FitStatus \{(.*?)\}\)", (ROOT / "src/statistics/mod.rs").read_text(), re.DOTALL)[1]
    missing = [status for status in re.findall(r'"(\w+)"', declared) if f"`{status}`" not in page]
    if missing:
        sys.exit(f"docs/reference/statuses.md: no word on {', '.join(missing)}; expected each status of a fit")


def main():
    program, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    check_statuses()
    folder.mkdir(exist_ok=True)
    (folder / "commands.md").write_text(commands(program))
    (folder / "columns.md").write_text(columns())


main()
