"""The study as one self-contained page and as Markdown."""

from __future__ import annotations

from typing import TYPE_CHECKING

from circlepoint.report.html import Column, asset, escaped, paragraph, section, table
from circlepoint.report.style import inline_svg, page_variables
from circlepoint.reproduce.presentation import (
    ASSUMED,
    COLUMNS,
    FIGURES,
    SOURCE,
    TITLE,
    VERDICTS,
    made,
    statement_rows,
    table_cells,
    verdict,
)

if TYPE_CHECKING:
    from collections.abc import Mapping

    from circlepoint.reproduce.findings import Table
    from circlepoint.reproduce.study import Reproduction

_policy = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"
_style = "tbody th{white-space:normal;min-width:22ch}tbody th small{white-space:nowrap}dt{flex-basis:260px}"
_colours = {"agrees": "good", "smaller": "warn", "larger": "warn", "no number": "soft"}


def render_page(reproduction: Reproduction, drawings: Mapping[str, str]) -> str:
    """Return the page; `drawings` are the figures as SVG."""
    links = (
        ("numbers", "Numbers"),
        ("reasons", "What was found"),
        ("figures", "Figures"),
        ("tables", "Tables"),
        ("assumed", "What is assumed"),
    )
    navigation = "".join(f'<a href="#{target}">{escaped(text)}</a>' for target, text in links)
    figures = "".join(
        f"<figure><h3>{escaped(title)}</h3>{inline_svg(drawings[name], name, escaped(caption))}"
        f"<figcaption>{escaped(caption)}</figcaption></figure>"
        for name, (title, caption) in FIGURES.items()
    )
    assumed = "".join(f'<li class="next">{escaped(text)}</li>' for text in ASSUMED)
    sections = (
        section("numbers", "The paper's numbers and ours", [_numbers(reproduction)]),
        section("reasons", "What was found", [_reasons(reproduction)]),
        section("figures", "Figures", [figures]),
        section("tables", "Tables", [_table(each) for each in reproduction.findings.tables]),
        section("assumed", "What the paper does not say, and what was taken", [f"<ul class=findings>{assumed}</ul>"]),
    )
    return (
        f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{escaped(TITLE)}</title>'
        '<meta name="viewport" content="width=device-width, initial-scale=1">'
        f'<meta http-equiv="Content-Security-Policy" content="{_policy}">'
        f"<style>{page_variables()}{asset('page.css')}{_style}</style></head><body>"
        f"<header><p class=kicker>{escaped(SOURCE)}</p><h1>{escaped(TITLE)}</h1>"
        f"{paragraph(verdict(reproduction), 'verdict')}{paragraph(made(reproduction), 'soft')}"
        f"<nav>{navigation}</nav></header><main>{''.join(sections)}</main>"
        f"<footer>{paragraph('Made by circlepoint reproduce. The same numbers are in reproduction.json.')}</footer>"
        "</body></html>\n"
    )


def render_markdown(reproduction: Reproduction) -> str:
    """Return the study as Markdown; its figures are files beside it."""
    rows = statement_rows(reproduction)
    lines = [f"# {TITLE}", "", SOURCE, "", verdict(reproduction), made(reproduction), ""]
    lines += ["## The paper's numbers and ours", ""]
    lines += _markdown_table(
        COLUMNS, [(r.section, r.what, r.paper, r.by_paper, r.by_best, VERDICTS[r.verdict]) for r in rows]
    )
    lines += ["", "## What was found", ""]
    lines += [f"- **{row.what}** ({row.how}). {row.remark}".rstrip() for row in rows]
    lines += ["", "## Figures", ""]
    for name, (title, caption) in FIGURES.items():
        lines += [f"### {title}", f"![{title}](figures/{name}.svg)", "", caption, ""]
    lines += ["## Tables", ""]
    for each in reproduction.findings.tables:
        lines += [f"### {each.title}", "", each.explanation, f"Unit: {each.unit}.", ""]
        lines += _markdown_table(("", *each.columns), [(label, *cells) for label, cells in table_cells(each)])
        lines.append("")
    lines += ["## What the paper does not say, and what was taken", ""]
    lines += [f"- {text}" for text in ASSUMED]
    return "\n".join(lines) + "\n"


def _numbers(reproduction: Reproduction) -> str:
    rows = statement_rows(reproduction)
    columns = [
        Column("what", [f"{escaped(row.what)} <small>sec. {escaped(row.section)}</small>" for row in rows], "name"),
        Column("paper", [escaped(row.paper) for row in rows]),
        Column("by the paper's method", [_bold(row.by_paper) for row in rows], group="ours"),
        Column("by the best method", [_bold(row.by_best) for row in rows], group="ours"),
        Column("", [f'<span class="{_colours[r.verdict]}">{VERDICTS[r.verdict]}</span>' for r in rows], "name"),
    ]
    return table(columns, "Median, and in brackets what 95 % of groups of ten trials give")


def _reasons(reproduction: Reproduction) -> str:
    merged: dict[str, list[str]] = {}
    for row in statement_rows(reproduction):
        if row.remark:
            merged.setdefault(row.remark, []).append(row.what)
    items = "".join(
        f"<div><dt>{escaped('; '.join(whats))}</dt><dd>{escaped(remark)}</dd></div>" for remark, whats in merged.items()
    )
    return f"<dl>{items}</dl>"


def _table(each: Table) -> str:
    cells = table_cells(each)
    columns = [Column(escaped(each.unit), [escaped(label) for label, _ in cells], "name")]
    columns += [
        Column(escaped(title), [_bold(values[i]) for _, values in cells]) for i, title in enumerate(each.columns)
    ]
    return f"<h3>{escaped(each.title)}</h3>{paragraph(each.explanation)}{table(columns, '')}"


def _bold(text: str) -> str:
    """Return a statistic with its interval paler."""
    value, bracket, interval = text.partition(" [")
    return f"{escaped(value)} <small>[{escaped(interval)}</small>" if bracket else escaped(value)


def _markdown_table(titles: tuple[str, ...], rows: list[tuple[str, ...]]) -> list[str]:
    head = ["| " + " | ".join(titles) + " |", "|" + "---|" * len(titles)]
    return head + ["| " + " | ".join(cell.replace("|", "\\|") for cell in row) + " |" for row in rows]
