"""Pieces of HTML as strings. Whatever comes from a file or a name goes through `escaped`; the pieces return markup."""

from __future__ import annotations

import html
import json
from importlib import resources
from typing import TYPE_CHECKING, Any, NamedTuple

from circlepoint.report.rounding import MINUS, align_decimals

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

_figure_space, _punctuation_space = "\N{FIGURE SPACE}", "\N{PUNCTUATION SPACE}"


class Column(NamedTuple):
    """One column of markup cells under a title; `group` is a title above, shared by neighbours that have the same."""

    title: str
    cells: list[str]
    kind: str = "number"
    group: str = ""


def escaped(text: object) -> str:
    """Return text as markup that shows it."""
    return html.escape(str(text), quote=True)


def asset(name: str) -> str:
    """Return the text of a file that ships with this package."""
    return resources.files("circlepoint.report").joinpath("assets", name).read_text(encoding="utf-8")


def script_data(identifier: str, data: Any) -> str:
    """Return data for a script of the page; no text in it can end the element."""
    text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return f'<script type="application/json" id="{identifier}">{text}</script>'


def numbers(texts: Sequence[str]) -> list[str]:
    """Return a column of numbers as cells whose decimal points stand under each other when set right-aligned."""
    cells = []
    for text in align_decimals(list(texts)):
        body = text.rstrip(" ")
        padding = len(text) - len(body)
        if padding and "." not in body:
            body, padding = body + _punctuation_space, padding - 1
        cells.append(escaped(body.replace("-", MINUS) + _figure_space * padding))
    return cells


def table(columns: Sequence[Column], caption: str) -> str:
    """Return a table; the first column names its rows."""
    groups = "".join(_group_cells(columns)) if any(column.group for column in columns) else ""
    titles = "".join(f'<th scope="col" class="{column.kind}">{column.title}</th>' for column in columns)
    body = []
    for row in zip(*(column.cells for column in columns), strict=True):
        cells = [f'<th scope="row">{row[0]}</th>']
        cells += [f'<td class="{column.kind}">{cell}</td>' for column, cell in zip(columns[1:], row[1:], strict=True)]
        body.append(f"<tr>{''.join(cells)}</tr>")
    head = (f"<tr>{groups}</tr>" if groups else "") + f"<tr>{titles}</tr>"
    return (
        f'<div class="wide"><table><caption>{caption}</caption><thead>{head}</thead>'
        f"<tbody>{''.join(body)}</tbody></table></div>"
    )


def section(identifier: str, title: str, parts: Iterable[str]) -> str:
    """Return a section of the page with its heading."""
    return f'<section id="{identifier}"><h2>{escaped(title)}</h2>{"".join(parts)}</section>'


def paragraph(text: str, kind: str = "") -> str:
    """Return a paragraph of text (escaped here)."""
    return f"<p{f' class={kind}' if kind else ''}>{escaped(text)}</p>"


def definitions(entries: Iterable[tuple[str, str]]) -> str:
    """Return a list of terms and what they mean (escaped here)."""
    items = "".join(f"<div><dt>{escaped(term)}</dt><dd>{escaped(text)}</dd></div>" for term, text in entries)
    return f"<dl>{items}</dl>"


def _group_cells(columns: Sequence[Column]) -> Iterable[str]:
    start = 0
    while start < len(columns):
        end = start + 1
        while end < len(columns) and columns[end].group == columns[start].group:
            end += 1
        group = columns[start].group
        kind = ' class="group"' if group else ""
        yield f'<td colspan="{end - start}"{kind}>{group}</td>'
        start = end
