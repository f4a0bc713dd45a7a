"""One look for every figure and for the page: colours, sizes, and how a figure follows light and dark.

Colours are roles. A figure is drawn in the light palette; where the page takes it in, each role's colour becomes a
style-sheet variable, so the same drawing is read on white and on black. The data colours are Okabe and Ito's (safe for
colour-blind readers), lightened for the dark page.
"""

from __future__ import annotations

import io
import re
import warnings
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

import matplotlib as mpl

if TYPE_CHECKING:
    from collections.abc import Iterator

    from matplotlib.figure import Figure

# role: (light, dark). Light colours are distinct, because they name the role in a drawing.
palette = {
    "paper": ("#fefefe", "#15181d"),
    "panel": ("#f6f7f9", "#1c2027"),
    "ink": ("#1b1f24", "#e6e9ee"),
    "soft": ("#5b6470", "#a3acb8"),
    "grid": ("#dfe3e8", "#303742"),
    "accent": ("#0b5cad", "#6db3f2"),
    "x": ("#0072b2", "#56b4e9"),
    "y": ("#d55e00", "#f2884b"),
    "z": ("#00876c", "#37c2a0"),
    "dwell": ("#c9d6e6", "#33475e"),
    "motion": ("#f5cf9f", "#6b4a1d"),
    "good": ("#00704f", "#46c79b"),
    "warn": ("#9a5b00", "#f0b35a"),
    "bad": ("#b3261e", "#ff8a80"),
}
axis_colours = tuple(palette[axis][0] for axis in "xyz")
# Base to tip along one ramp (matplotlib's plasma, without its ends), so that order can be seen without the hue.
joint_colours = ("#1b068d", "#5102a3", "#8104a7", "#a72197", "#c6417d", "#d2524f", "#dc6a2e", "#c98a12")
joint_colours_dark = ("#a78bfa", "#c084fc", "#e07be0", "#f472b6", "#fb8a8a", "#fca15f", "#fcc34a", "#f3e35a")
_figure_settings: dict[str, Any] = {
    "svg.fonttype": "none",
    "svg.hashsalt": "circlepoint",
    "font.family": "DejaVu Sans",
    "font.size": 10.5,
    "axes.titlesize": 10.5,
    "axes.titleweight": "normal",
    "axes.titlelocation": "left",
    "axes.labelsize": 10.0,
    "xtick.labelsize": 9.5,
    "ytick.labelsize": 9.5,
    "legend.fontsize": 10.0,
    "legend.frameon": False,
    "text.color": palette["ink"][0],
    "axes.labelcolor": palette["soft"][0],
    "axes.titlecolor": palette["ink"][0],
    "axes.edgecolor": palette["soft"][0],
    "xtick.color": palette["soft"][0],
    "ytick.color": palette["soft"][0],
    "axes.facecolor": "none",
    "figure.facecolor": palette["paper"][0],
    "grid.color": palette["grid"][0],
    "grid.linewidth": 0.6,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.linewidth": 0.6,
    "axes.formatter.useoffset": False,
    "axes.unicode_minus": True,
    "lines.linewidth": 1.0,
    "lines.solid_capstyle": "round",
    "path.simplify": True,
    "savefig.dpi": 170,
}


@contextmanager
def figure_style() -> Iterator[None]:
    """Draw with this look, whatever the user's own settings are."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(_figure_settings)  # type: ignore[arg-type]
        yield


def shortened(name: str, longest: int = 24) -> str:
    """Return a name that fits a drawing: its beginning and its end, which tells joints apart."""
    if len(name) <= longest:
        return name
    tail = (longest - 1) // 2 + 1
    return f"{name[: longest - 1 - tail]}\N{HORIZONTAL ELLIPSIS}{name[-tail:]}"


def plain(name: str, longest: int = 24) -> str:
    """Return a short name as matplotlib can show it: nothing in it is read as mathematics."""
    return "".join(c if c.isprintable() else " " for c in shortened(name, longest)).replace("$", r"\$")


def svg_text(figure: Figure) -> str:
    """Return a figure as SVG, the same text for the same figure."""
    stream = io.StringIO()
    with figure_style(), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")
        figure.savefig(stream, format="svg", metadata={"Date": None, "Creator": None})
    return stream.getvalue()


def png_bytes(figure: Figure) -> bytes:
    """Return a figure as PNG, the same bytes for the same figure."""
    stream = io.BytesIO()
    with figure_style(), warnings.catch_warnings():
        warnings.filterwarnings("ignore", message="Glyph .* missing from font")
        figure.savefig(stream, format="png", metadata={"Software": None})
    return stream.getvalue()


def inline_svg(svg: str, prefix: str, label: str) -> str:
    """Return a figure's SVG for taking into the page: its own ids, colours by role, no reference to anything outside.

    Parameters
    ----------
    svg : str
        As written by `svg_text`.
    prefix : str
        Put before every id, so that several drawings share a page.
    label : str
        What the picture shows, already escaped, for those who do not see it.
    """
    body = svg[svg.index("<svg") :]
    body = re.sub(r"<metadata>.*?</metadata>", "", body, flags=re.DOTALL)
    view_box = re.search(r'viewBox="([^"]+)"', body)
    body = body[body.index(">") + 1 :]
    body = body.replace("xlink:href=", "href=")
    body = re.sub(r'\bid="([^"]+)"', rf'id="{prefix}-\1"', body)
    body = re.sub(r'href="#([^"]+)"', rf'href="#{prefix}-\1"', body)
    body = re.sub(r"url\(#([^)]+)\)", rf"url(#{prefix}-\1)", body)
    for role, (light, _) in palette.items():
        body = body.replace(light, f"var(--{role})")
    body = re.sub(r"font: ([\d.]+)px [^;\"]*", r"font-size: \1px", body)
    body = re.sub(r"\n\s*", "\n", body)
    return f'<svg viewBox="{view_box[1] if view_box else ""}" role="img" aria-label="{label}">{body}'


def page_variables() -> str:
    """Return the style sheet's colour variables for light, dark and print."""

    def declare(column: int) -> str:
        roles = [f"--{role}:{colours[column]}" for role, colours in palette.items()]
        joints = (joint_colours, joint_colours_dark)[column]
        return ";".join(roles + [f"--joint{i}:{colour}" for i, colour in enumerate(joints)])

    return (
        f":root{{color-scheme:light dark;{declare(0)}}}\n"
        f"@media screen and (prefers-color-scheme:dark){{:root{{{declare(1)}}}}}\n"
    )
