"""A URDF as text that stays as it is: its chain is read, and only the origins of joints are written.

The file is parsed by expat for what stands where; an edit replaces the values of the two attributes of one tag and
leaves every other byte alone - comments, order, spaces, mesh names. Declared entities, external parts, XInclude and
macros not expanded are refused: nothing is fetched, nothing can blow up.
"""

from __future__ import annotations

import re
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NoReturn
from xml.parsers import expat
from xml.sax.saxutils import quoteattr

import numpy as np

import circlepoint
from circlepoint._core import InvalidInput
from circlepoint.export.nominal_frames import NominalFrames
from circlepoint.export.transforms import inverse, rigid, rotation_from_rpy, rpy_of_rotation

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

_TAG = re.compile(rb"<[^\s/>]+(?:\s+[^\s=/>]+\s*=\s*(?:\"[^\"]*\"|'[^']*'))*\s*/?>")
_MOVING = {
    "revolute": circlepoint.JointType.revolute,
    "continuous": circlepoint.JointType.revolute,
    "prismatic": circlepoint.JointType.prismatic,
}
UNCHANGED = 1e-12
"""m, rad: an origin that would change by less keeps its text."""


@dataclass
class UrdfJoint:
    """One joint element; `origin_at` and `open_at` are the byte ranges of its origin's and its own start tag."""

    name: str
    kind: str
    line: int
    open_at: tuple[int, int]
    parent: str = ""
    child: str = ""
    xyz: tuple[float, ...] = (0.0, 0.0, 0.0)
    rpy: tuple[float, ...] = (0.0, 0.0, 0.0)
    axis: tuple[float, ...] = (1.0, 0.0, 0.0)
    mimic: bool = False
    origin_at: tuple[int, int] | None = None

    @property
    def origin(self) -> NDArray[np.float64]:
        """(4, 4), the joint in its parent link."""
        return rigid(rotation_from_rpy(self.rpy), self.xyz)


@dataclass
class UrdfText:
    """A URDF's text and its joints.

    Attributes
    ----------
    text : bytes
        UTF-8.
    where : str
        Its name in messages.
    robot : str
        The robot's name.
    joints : list of UrdfJoint
        In the order of the file.
    """

    text: bytes
    where: str
    robot: str = ""
    joints: list[UrdfJoint] = field(default_factory=list)

    def path(self, names: Sequence[str], base: str | None = None, tip: str | None = None) -> list[UrdfJoint]:
        """Return the joints from base to tip, fixed ones included; those that move must be `names` in their order.

        Parameters
        ----------
        names : sequence of str
            The calibrated joints, base to tip.
        base, tip : str, optional
            Links. Default: the first joint's parent, the last joint's child.

        Raises
        ------
        InvalidInput
            A joint or link is not there, the links are not on one path, or others move between them.
        """
        by_name = {joint.name: joint for joint in self.joints}
        missing = [name for name in names if name not in by_name]
        if missing:
            moving = ", ".join(joint.name for joint in self.joints if joint.kind in _MOVING)
            self.fail(
                f"has no joint {', '.join(map(repr, missing))} of the calibrated arm; its moving joints are {moving}. "
                "Give the URDF of this arm, with joints named as in the recording"
            )
        links = {joint.parent for joint in self.joints} | {joint.child for joint in self.joints}
        for link in (base, tip):
            if link is not None and link not in links:
                self.fail(f"has no link {link!r}; its links are {', '.join(sorted(links))}")
        start = by_name[names[0]].parent if base is None else base
        end = by_name[names[-1]].child if tip is None else tip
        into = {joint.child: joint for joint in self.joints}
        path: list[UrdfJoint] = []
        link = end
        while link != start:
            if link not in into or len(path) > len(self.joints):
                self.fail(f"link {end!r} is not beyond link {start!r}; choose --base and --tip on one path")
            path.insert(0, into[link])
            link = into[link].parent
        moving_names = [joint.name for joint in path if joint.kind != "fixed"]
        if moving_names != list(names):
            self.fail(
                f"from {start!r} to {end!r} the joints {', '.join(moving_names) or 'none'} move, the calibrated ones "
                f"are {', '.join(names)}; choose --base and --tip so that they are the same"
            )
        for joint in path:
            if joint.kind not in {*_MOVING, "fixed"}:
                self.fail(f"joint {joint.name!r} is {joint.kind}, must be revolute, prismatic or fixed", joint)
            if joint.mimic:
                self.fail(f"joint {joint.name!r} mimics another; a calibrated joint moves by itself", joint)
        return path

    def frames(self, names: Sequence[str], base: str | None = None, tip: str | None = None) -> NominalFrames:
        """Return the frames of the path's child links; parameters and errors as in `path`."""
        path = self.path(names, base, tip)
        placements: list[NDArray[np.float64]] = []
        axes: list[NDArray[np.float64]] = []
        types: list[circlepoint.JointType] = []
        pose = np.eye(4)
        for joint in path:
            pose = pose @ joint.origin
            if joint.kind == "fixed":
                continue
            length = float(np.linalg.norm(joint.axis))
            if length < 1e-9:
                self.fail(f"joint {joint.name!r}: its axis is zero; give a direction", joint)
            placements.append(pose)
            axes.append(np.array(joint.axis) / length)
            types.append(_MOVING[joint.kind])
            pose = np.eye(4)
        return NominalFrames(
            source=self.where,
            base=path[0].parent,
            tip=path[-1].child,
            placements=tuple(placements),
            axes=tuple(axes),
            types=tuple(types),
            tip_placement=pose,
        )

    def with_placements(
        self, path: Sequence[UrdfJoint], placements: Sequence[NDArray[np.float64]]
    ) -> tuple[str, list[str]]:
        """Return the text with the moving joints of a path placed anew, and the names of those that changed.

        Parameters
        ----------
        path : sequence of UrdfJoint
        placements : sequence of (4, 4) ndarray
            Each moving joint's frame in the one before; fixed joints between them stay.
        """
        origins: dict[str, NDArray[np.float64]] = {}
        fixed = np.eye(4)
        remaining = iter(placements)
        for joint in path:
            if joint.kind == "fixed":
                fixed = fixed @ joint.origin
                continue
            wanted = inverse(fixed) @ next(remaining)
            fixed = np.eye(4)
            if np.max(np.abs(wanted - joint.origin)) > UNCHANGED:
                origins[joint.name] = wanted
        return self._edited(origins), list(origins)

    def _edited(self, origins: Mapping[str, NDArray[np.float64]]) -> str:
        edits = []
        for joint in self.joints:
            if joint.name not in origins:
                continue
            pose = origins[joint.name]
            values = {b"xyz": _numbers(pose[:3, 3]), b"rpy": _numbers(rpy_of_rotation(pose[:3, :3], joint.rpy[:3]))}
            if joint.origin_at is None:
                start, end = joint.open_at
                indent = re.match(rb"\s*", self.text[end:])
                gap = indent.group() if indent else b""
                edits.append((end, end, gap + b'<origin xyz="%b" rpy="%b"/>' % (values[b"xyz"], values[b"rpy"])))
                continue
            start, end = joint.origin_at
            edits.append((start, end, _with_attributes(self.text[start:end], values)))
        text = self.text
        for start, end, replacement in sorted(edits, reverse=True):
            text = text[:start] + replacement + text[end:]
        return text.decode("utf-8")

    def fail(self, message: str, joint: UrdfJoint | None = None) -> NoReturn:
        """Raise InvalidInput about this file."""
        raise InvalidInput(f"{self.where}{f', line {joint.line}' if joint else ''}: {message}")


def read_urdf_text(text: str, where: str = "URDF") -> UrdfText:
    """Read the joints of a URDF.

    Parameters
    ----------
    text : str
        The file's content.
    where : str
        Its name in messages.

    Raises
    ------
    InvalidInput
        It is not XML, not a URDF, or refers to anything outside itself.
    """
    return _Reader(UrdfText(text.encode("utf-8"), where)).read()


class _Reader:
    """The events of one parse: elements directly under ``robot`` count, everything else passes by."""

    def __init__(self, urdf: UrdfText) -> None:
        self.urdf = urdf
        self.stack: list[str] = []
        self.parser = expat.ParserCreate("utf-8")
        self.parser.StartElementHandler = self._start
        self.parser.EndElementHandler = self._end
        self.parser.EntityDeclHandler = self._refuse_entity
        self.parser.ExternalEntityRefHandler = self._refuse_entity
        self.parser.UnparsedEntityDeclHandler = self._refuse_entity
        self.parser.StartDoctypeDeclHandler = self._doctype

    def read(self) -> UrdfText:
        try:
            self.parser.Parse(self.urdf.text, True)
        except expat.ExpatError as error:
            self._fail(f"is not valid XML: {expat.errors.messages[error.code]}", error.lineno)
        if not self.urdf.joints:
            self._fail("has no joints; give the URDF of the arm")
        repeated = [name for name, count in Counter(joint.name for joint in self.urdf.joints).items() if count > 1]
        if repeated:
            self._fail(f"has several joints {', '.join(map(repr, repeated))}; names must differ")
        return self.urdf

    def _start(self, name: str, attributes: dict[str, str]) -> None:
        if not self.stack and name != "robot":
            self._fail(f"its top element is {name!r}, must be 'robot': a URDF is needed", self.parser.CurrentLineNumber)
        if name.startswith("xacro:"):
            self._fail(f"has the macro element {name!r}; expand it with xacro first", self.parser.CurrentLineNumber)
        if name.endswith(":include") or name == "include":
            self._fail(f"includes another file ({name!r}); give a URDF in one file", self.parser.CurrentLineNumber)
        if not self.stack:
            self.urdf.robot = attributes.get("name", "")
        self.stack.append(name)
        if self.stack == ["robot", "joint"]:
            self.urdf.joints.append(
                UrdfJoint(
                    self._attribute(attributes, "name", "joint"),
                    self._attribute(attributes, "type", "joint"),
                    self.parser.CurrentLineNumber,
                    self._tag(),
                )
            )
        elif len(self.stack) == 3 and self.stack[:2] == ["robot", "joint"]:
            self._joint_part(self.urdf.joints[-1], name, attributes)

    def _joint_part(self, joint: UrdfJoint, name: str, attributes: dict[str, str]) -> None:
        if name == "origin" and joint.origin_at is None:
            joint.origin_at = self._tag()
            joint.xyz = self._triple(attributes.get("xyz", "0 0 0"), f"joint {joint.name!r}: origin xyz")
            joint.rpy = self._triple(attributes.get("rpy", "0 0 0"), f"joint {joint.name!r}: origin rpy")
        elif name == "axis":
            joint.axis = self._triple(attributes.get("xyz", "1 0 0"), f"joint {joint.name!r}: axis xyz")
        elif name == "parent":
            joint.parent = self._attribute(attributes, "link", "parent")
        elif name == "child":
            joint.child = self._attribute(attributes, "link", "child")
        elif name == "mimic":
            joint.mimic = True

    def _end(self, name: str) -> None:
        if self.stack == ["robot", "joint"]:
            joint = self.urdf.joints[-1]
            if not joint.parent or not joint.child:
                self._fail(f"joint {joint.name!r} has no parent or no child link", joint.line)
        if self.stack.pop() != name:
            self._fail(f"element {name!r} ends out of place", self.parser.CurrentLineNumber)

    def _tag(self) -> tuple[int, int]:
        start = self.parser.CurrentByteIndex
        tag = _TAG.match(self.urdf.text, start)
        if tag is None:
            self._fail("has a tag that cannot be located", self.parser.CurrentLineNumber)
        return start, tag.end()

    def _attribute(self, attributes: Mapping[str, str], key: str, element: str) -> str:
        value = attributes.get(key, "")
        if not value:
            self._fail(f"a {element} element has no {key}", self.parser.CurrentLineNumber)
        return value

    def _triple(self, text: str, what: str) -> tuple[float, ...]:
        try:
            values = tuple(float(part) for part in text.split())
        except ValueError:
            values = ()
        if len(values) != 3 or not np.all(np.isfinite(values)):
            hint = "; expand the file with xacro first" if "${" in text else ""
            self._fail(f"{what} is {text!r}, must be three numbers{hint}", self.parser.CurrentLineNumber)
        return values

    def _doctype(self, _name: str, system: str | None, public: str | None, _internal: bool) -> None:
        if system or public:
            self._fail("its DOCTYPE names an external part, which is not read; remove the DOCTYPE line")

    def _refuse_entity(self, *_declaration: object) -> int:
        self._fail("declares entities, which are not read; write their text where they are used")

    def _fail(self, message: str, line: int | None = None) -> NoReturn:
        raise InvalidInput(f"{self.urdf.where}{f', line {line}' if line else ''}: {message}")


def _with_attributes(tag: bytes, values: Mapping[bytes, bytes]) -> bytes:
    for key, value in values.items():
        tag, found = re.subn(rb"(\s%b\s*=\s*)(?:\"[^\"]*\"|'[^']*')" % key, rb'\g<1>"%b"' % value, tag, count=1)
        if not found:
            tag = re.sub(rb"(\s*/?>)$", rb' %b="%b"\g<1>' % (key, value), tag)
    return tag


def _numbers(values: Sequence[float] | NDArray[np.float64]) -> bytes:
    return " ".join(repr(float(value) + 0.0) for value in values).encode()


def attribute(text: str) -> str:
    """Return a text quoted as the value of an attribute."""
    return quoteattr(text)
