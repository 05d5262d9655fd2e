"""Writes the reference of the book: docs_reference.py ROCKFRAG FOLDER

commands.md comes from the help of each command, columns.md from the declarations in src/table, python.md from the docstrings and
the stub of the Python package. The page of statuses must name every status of a fit.
"""

import ast
import os
import pathlib
import re
import subprocess
import sys
import textwrap

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
        # What all commands share stands in the overview.
        text = re.sub(r"\nCommon options:\n(?: .*\n)+", "", help_of(program, name)).rstrip()
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


def signature(function):
    """A function as it is called, an argument a line if there are many."""
    name, arguments = function.name, ast.unparse(function.args)
    result = f" -> {ast.unparse(function.returns)}" if function.returns else ""
    if len(arguments) > 80:
        parts = re.split(r", (?=\*|\w+: )", arguments)
        arguments = "\n    " + ",\n    ".join(parts) + ",\n"
    return f"```python\n{name}({arguments}){result}\n```\n"


def text_of(node):
    """A docstring in Markdown."""
    text = ast.get_docstring(node) or ""
    text = re.sub(r":\w+:`~?([^`]+)`", r"`\1`", text).replace("``", "`")
    text = re.sub(r"^(Args|Returns):$", r"\1:\n", text, flags=re.MULTILINE)
    text = re.sub(r"^    (\w+): (?=.*)", r"* `\1`: ", text, flags=re.MULTILINE)
    text = re.sub(r"(?<=Returns:\n\n)    ", "* ", text)
    return re.sub(r"::\n\n((?:(?:    .*)?\n)+)", lambda code: f":\n\n```python\n{textwrap.dedent(code[1]).strip()}\n```\n\n", text + "\n")


def python():
    folder = ROOT / "python/python/rockfrag"
    tree = {name: ast.parse((folder / name).read_text()) for name in ("__init__.py", "_stages.pyi", "_rocking.py", "errors.py", "ray.py")}
    of = lambda file, kind: [node for node in tree[file].body if isinstance(node, kind) and not node.name.startswith("_")]
    parts = ["# Python functions\n", text_of(tree["__init__.py"]), "## Stages\n"]
    for function in of("_stages.pyi", ast.FunctionDef):
        command = function.name.replace("_", "-")
        parts += [f"### {function.name}\n", signature(function), f"The options are those of the command [{command}](commands.md#{command}).\n"]
    parts.append("## One response over time\n")
    for function in of("_rocking.py", ast.FunctionDef):
        parts += [f"### {function.name}\n", signature(function), text_of(function)]
    lines = (folder / "_rocking.py").read_text().splitlines()
    for item in of("_rocking.py", ast.ClassDef):
        parts += [f"### {item.name}\n", text_of(item), "| attribute | meaning |", "|---|---|"]
        fields = [node for node in item.body if isinstance(node, ast.AnnAssign)]
        parts += [f"| `{field.target.id}` | {lines[field.lineno - 2].strip().removeprefix('#:').strip()} |" for field in fields]
        parts.append("")
    parts.append("## Errors and warnings\n")
    parts += [f"`{item.name}`\n: {' '.join(text_of(item).split())}\n" for item in of("errors.py", ast.ClassDef)]
    parts += ["## rockfrag.ray\n", text_of(tree["ray.py"])]
    for function in of("ray.py", ast.FunctionDef):
        parts += [f"### ray.{function.name}\n", signature(function), text_of(function)]
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
    (folder / "python.md").write_text(python())


main()
