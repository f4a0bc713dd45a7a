"""Writing the study: page, Markdown, JSON and figures, each whole or not at all."""

from __future__ import annotations

import json
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

import circlepoint
from circlepoint.atomic import write_atomically
from circlepoint.report.style import png_bytes, svg_text
from circlepoint.reproduce.figures import DRAWINGS
from circlepoint.reproduce.geometry_figures import draw_figure1, draw_figure2
from circlepoint.reproduce.page import render_markdown, render_page
from circlepoint.reproduce.study import Reproduction, agreement, rows

if TYPE_CHECKING:
    from pathlib import Path

    from circlepoint.reproduce.trials import Spread

SCHEMA = "circlepoint/reproduction/1"


def document(reproduction: Reproduction) -> dict[str, Any]:
    """Return the study as plain data, SI units; its JSON Schema is `schema/reproduction-1.json`."""
    return {
        "schema": SCHEMA,
        "generator": {"name": "circlepoint", "version": circlepoint.__version__},
        "trials": reproduction.trials,
        "statements": [
            {
                "id": stated.id,
                "section": stated.section,
                "quantity": stated.quantity,
                "printed": stated.printed,
                "paper": stated.value,
                "unit": stated.unit,
                "how": stated.how,
                "paper_method": _spread(ours.paper_method),
                "best_method": _spread(ours.best_method),
                "trials": ours.trials,
                "agreement": agreement(stated, ours),
                "remark": ours.remark,
            }
            for stated, ours in rows(reproduction)
        ],
        "tables": [
            {
                "id": table.id,
                "title": table.title,
                "explanation": table.explanation,
                "columns": list(table.columns),
                "rows": [
                    {"label": label, "values": [_spread(value) for value in values]} for label, values in table.rows
                ],
            }
            for table in reproduction.findings.tables
        ],
    }


def write_reproduction(directory: Path, reproduction: Reproduction) -> dict[str, Any]:
    """Write the study and return its document.

    Parameters
    ----------
    directory : Path
        Gets `reproduction.html`, `reproduction.md`, `reproduction.json` and `figures/` with SVG and PNG; made if it is
        not there.
    reproduction : Reproduction
    """
    figures = directory / "figures"
    figures.mkdir(parents=True, exist_ok=True)
    drawings = {}
    for name, draw in {"figure1": draw_figure1, "figure2": draw_figure2, **DRAWINGS}.items():
        figure = draw(reproduction.findings.signals)
        drawings[name] = svg_text(figure)
        write_atomically(figures / f"{name}.svg", drawings[name].encode())
        write_atomically(figures / f"{name}.png", png_bytes(figure))
    content = document(reproduction)
    write_atomically(directory / "reproduction.md", render_markdown(reproduction).encode())
    write_atomically(directory / "reproduction.html", render_page(reproduction, drawings).encode())
    text = json.dumps(content, indent=1, allow_nan=False, ensure_ascii=False) + "\n"
    write_atomically(directory / "reproduction.json", text.encode())
    return content


def _spread(spread: Spread | None) -> dict[str, float] | None:
    return None if spread is None else asdict(spread)
