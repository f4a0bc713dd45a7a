"""A URDF's text with the origins of joints written anew, and every other byte as it was.

What the file says is read by `circlepoint.urdf_xml`; here the same text is only searched for where tags stand. An edit
replaces the values of the two attributes of one tag: comments, order, spaces and mesh names stay.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING
from xml.parsers import expat
from xml.sax.saxutils import quoteattr

import numpy as np

from circlepoint.transforms import inverse, rpy_of_rotation

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from circlepoint.urdf_xml import UrdfJoint

_TAG = re.compile(rb"<[^\s/>]+(?:\s+[^\s=/>]+\s*=\s*(?:\"[^\"]*\"|'[^']*'))*\s*/?>")
UNCHANGED = 1e-12
"""m, rad: an origin that would change by less keeps its text."""


def with_placements(
    text: str, chain: Sequence[UrdfJoint], placements: Sequence[NDArray[np.float64]]
) -> tuple[str, list[str]]:
    """Return the text with the moving joints of a chain placed anew, and the names of those that changed.

    Parameters
    ----------
    text : str
        The URDF the chain was read from.
    chain : sequence of UrdfJoint
        Base to tip, fixed joints included.
    placements : sequence of (4, 4) ndarray
        Each moving joint's frame in the one before; fixed joints between them stay.
    """
    origins: dict[str, tuple[bytes, bytes]] = {}
    fixed = np.eye(4)
    remaining = iter(placements)
    for joint in chain:
        if joint.fixed:
            fixed = fixed @ joint.origin
            continue
        wanted = inverse(fixed) @ next(remaining)
        fixed = np.eye(4)
        if np.max(np.abs(wanted - joint.origin)) > UNCHANGED:
            origins[joint.name] = _numbers(wanted[:3, 3]), _numbers(rpy_of_rotation(wanted[:3, :3], joint.rpy))
    return _edited(text.encode("utf-8"), origins), list(origins)


def attribute(text: str) -> str:
    """Return a text quoted as the value of an attribute."""
    return quoteattr(text)


def _edited(text: bytes, origins: Mapping[str, tuple[bytes, bytes]]) -> str:
    edits = []
    for name, (opening, origin) in _joint_tags(text).items():
        if name not in origins:
            continue
        xyz, rpy = origins[name]
        if origin is None:
            end = opening[1]
            indent = re.match(rb"\s*", text[end:])
            gap = indent.group() if indent else b""
            edits.append((end, end, gap + b'<origin xyz="%b" rpy="%b"/>' % (xyz, rpy)))
            continue
        start, end = origin
        edits.append((start, end, _with_attributes(text[start:end], {b"xyz": xyz, b"rpy": rpy})))
    for start, end, replacement in sorted(edits, reverse=True):
        text = text[:start] + replacement + text[end:]
    return text.decode("utf-8")


def _joint_tags(text: bytes) -> dict[str, tuple[tuple[int, int], tuple[int, int] | None]]:
    """Return the bytes of each joint's start tag and of its origin's, by the joint's name."""
    found: dict[str, tuple[tuple[int, int], tuple[int, int] | None]] = {}
    stack: list[str] = []
    current = ""
    parser = expat.ParserCreate("utf-8")

    def tag() -> tuple[int, int]:
        start = parser.CurrentByteIndex
        match = _TAG.match(text, start)
        assert match is not None, "expat found a start tag here"
        return start, match.end()

    def begin(name: str, attributes: dict[str, str]) -> None:
        nonlocal current
        stack.append(name)
        if stack == ["robot", "joint"]:
            current = attributes["name"]
            found[current] = tag(), None
        elif stack == ["robot", "joint", "origin"] and found[current][1] is None:
            found[current] = found[current][0], tag()

    parser.StartElementHandler = begin
    parser.EndElementHandler = lambda _name: stack.pop()
    parser.Parse(text, True)
    return found


def _with_attributes(tag: bytes, values: Mapping[bytes, bytes]) -> bytes:
    for key, value in values.items():
        tag, found = re.subn(rb"(\s%b\s*=\s*)(?:\"[^\"]*\"|'[^']*')" % key, rb'\g<1>"%b"' % value, tag, count=1)
        if not found:
            tag = re.sub(rb"(\s*/?>)$", rb' %b="%b"\g<1>' % (key, value), tag)
    return tag


def _numbers(values: Sequence[float] | NDArray[np.float64]) -> bytes:
    return " ".join(repr(float(value) + 0.0) for value in values).encode()
