"""How results look in a terminal and in a notebook."""

from __future__ import annotations

import html as escape
from collections.abc import Sequence

import numpy as np
import numpy.typing as npt

from ._rockfrag import Table

#: Rows and columns of a table that are shown.
ROWS, COLUMNS = 8, 8


class Summary:
    """Lines and a table, as text and as HTML."""

    def __init__(self, title: str, lines: Sequence[str], head: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
        self._title, self._lines, self._head, self._rows = title, lines, head, rows

    def __repr__(self) -> str:
        return "\n".join([self._title, *_aligned(self._head, self._rows), *self._lines])

    def _repr_html_(self) -> str:
        lines = "".join(f"<p>{escape.escape(line)}</p>" for line in self._lines)
        return f"<p><b>{escape.escape(self._title)}</b></p>{_table(self._head, self._rows)}{lines}"


def text(table: Table) -> str:
    """What a table is, and its first rows and columns."""
    head, rows = _first(table)
    return "\n".join([_title(table), *_aligned(head, rows), *_rest(table)])


def html(table: Table) -> str:
    """The same for a notebook, with all columns."""
    head, rows = _first(table, columns=None)
    return f"<p>{escape.escape(_title(table))}</p><div style='overflow-x: auto'>{_table(head, rows)}</div>"


def array(values: list[object]) -> npt.NDArray[np.generic]:
    """Values of any kind, one in each place."""
    if all(isinstance(value, (str, bool)) for value in values):
        return np.array(values)
    places = np.empty(len(values), dtype=object)
    for place, value in enumerate(values):
        places[place] = value
    return places


def number(value: float) -> str:
    """A number to read."""
    return f"{value:.4g}"


def _title(table: Table) -> str:
    (rows, columns), stage = table.shape, str(table.metadata.get("stage", ""))
    warned = table.metadata.get("warnings")
    doubts = f", {len(warned)} warning{'s' if len(warned) > 1 else ''} (metadata)" if isinstance(warned, list) and warned else ""
    parts = f", parts: {', '.join(table.parts)}" if table.parts else ""
    return f"rockfrag.Table of {stage}: {rows} rows, {columns} columns{parts}{doubts}"


def _rest(table: Table) -> list[str]:
    rest = table.columns[COLUMNS:]
    return [f"and {len(rest)} columns: {', '.join(rest)}"] if rest else []


def _first(table: Table, columns: int | None = COLUMNS) -> tuple[list[str], list[list[str]]]:
    names = table.columns[:columns]
    few = table.head(ROWS)
    cells = [[_cell(value) for value in few[name]] for name in names]
    rows = [list(row) for row in zip(*cells)]
    if len(table) > ROWS:
        rows.append(["..."] * len(names))
    return names, rows


def _cell(value: object) -> str:
    if value is None or isinstance(value, float) and value != value:
        return ""
    if isinstance(value, np.ndarray):
        return f"[{value.size} values]"
    return number(float(value)) if isinstance(value, (float, np.floating)) else str(value)


def _aligned(head: Sequence[str], rows: Sequence[Sequence[str]]) -> list[str]:
    lines = [head, *rows]
    widths = [max(map(len, column)) for column in zip(*lines)]
    return ["  ".join(cell.rjust(width) for cell, width in zip(line, widths)).rstrip() for line in lines]


def _table(head: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    return f"<table><thead>{_line(head, 'th')}</thead><tbody>{''.join(_line(row, 'td') for row in rows)}</tbody></table>"


def _line(cells: Sequence[str], tag: str) -> str:
    return "<tr>" + "".join(f"<{tag}>{escape.escape(cell)}</{tag}>" for cell in cells) + "</tr>"
