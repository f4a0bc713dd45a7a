"""A URDF as a tree of links and joints: the one place where its XML is read, and what cannot be used is refused.

Only the file itself is opened: a document type, entities and inclusions are refused, as is xacro that was not expanded.
A joint's numbers are read when they are asked for, so that what is not between base and tip does not matter.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from lxml import etree

from circlepoint._core import InvalidInput, JointType
from circlepoint.arm import LARGEST_LIMIT, LONGEST_LINK
from circlepoint.transforms import rigid, rotation_from_rpy

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    FloatArray = NDArray[np.float64]

_TYPES = {
    "revolute": JointType.revolute,
    "continuous": JointType.revolute,
    "prismatic": JointType.prismatic,
}
_XINCLUDE = "{http://www.w3.org/2001/XInclude}"
_XACRO = ("{http://www.ros.org/wiki/xacro}", "{http://ros.org/wiki/xacro}", "{http://wiki.ros.org/xacro}")


@dataclass(frozen=True)
class UrdfJoint:
    """A joint element and what it connects.

    Attributes
    ----------
    where : str
        The file, for messages.
    element : lxml element
    name, type, parent, child : str
        As in the file.
    """

    where: str
    element: Any
    name: str
    type: str
    parent: str
    child: str

    @property
    def fixed(self) -> bool:
        """Whether it never moves."""
        return self.type == "fixed"

    @property
    def joint_type(self) -> JointType:
        """How it moves: about or along one line."""
        if self.type not in _TYPES:
            raise self.error(
                f"is of type {self.type!r}, which is not one line; revolute, continuous, prismatic and fixed joints "
                f"can be between --base and --tip"
            )
        return _TYPES[self.type]

    @property
    def rpy(self) -> list[float]:
        """Roll, pitch and yaw of its origin, rad."""
        origin = self.element.find("origin")
        if origin is None:
            return [0.0, 0.0, 0.0]
        rpy = self.numbers(origin, "rpy", "0 0 0")
        if max(map(abs, rpy)) > LARGEST_LIMIT:
            raise self.error(f'rpy="{origin.get("rpy")}" looks like degrees; write radians', origin)
        return rpy

    @property
    def origin(self) -> FloatArray:
        """(4, 4), the joint in its parent link."""
        origin = self.element.find("origin")
        if origin is None:
            return np.eye(4)
        xyz = self.numbers(origin, "xyz", "0 0 0")
        if max(map(abs, xyz)) > LONGEST_LINK:
            raise self.error(f'xyz="{origin.get("xyz")}" looks like millimetres; write metres', origin)
        return rigid(rotation_from_rpy(self.rpy), xyz)

    @property
    def axis(self) -> FloatArray:
        """(3,), unit, in the joint's frame."""
        axis = self.element.find("axis")
        if axis is None:
            return np.array([1.0, 0.0, 0.0])  # the format's default
        values = np.array(self.numbers(axis, "xyz", "1 0 0"))
        length = float(np.linalg.norm(values))
        if length < 1e-9:
            raise self.error(f'xyz="{axis.get("xyz")}" has no direction; give the axis', axis)
        return np.asarray(values / length)

    @property
    def limits(self) -> tuple[float, float] | None:
        """Lowest and highest position, rad or m; None without."""
        limit = self.element.find("limit")
        if limit is None or self.type == "continuous":
            return None
        low, high = self.number(limit, "lower", 0.0), self.number(limit, "upper", 0.0)
        if low == high == 0.0:  # the format's defaults: not given
            return None
        if low >= high:
            raise self.error(f"the lower limit {low:g} is not below the upper, {high:g}", limit)
        if self.joint_type == JointType.revolute and max(abs(low), abs(high)) > LARGEST_LIMIT:
            raise self.error(
                f"limits {low:g} to {high:g} look like degrees; a URDF has radians ({math.radians(low):.6f} to "
                f'{math.radians(high):.6f}); for a joint without end, type="continuous"',
                limit,
            )
        return low, high

    @property
    def velocity(self) -> float | None:
        """Largest speed, rad/s or m/s; None without."""
        limit = self.element.find("limit")
        return (None if limit is None else self.number(limit, "velocity", 0.0)) or None

    @property
    def mimic(self) -> tuple[str, float, float] | None:
        """Name of the joint whose position it follows, multiplier and offset; None for one that moves by itself."""
        mimic = self.element.find("mimic")
        if mimic is None:
            return None
        multiplier = self.number(mimic, "multiplier", 1.0)
        if multiplier == 0.0:
            raise self.error('multiplier="0" lets it never move; make it type="fixed"', mimic)
        return required_attribute(self.where, mimic, "joint"), multiplier, self.number(mimic, "offset", 0.0)

    def number(self, element: Any, attribute: str, default: float) -> float:
        """Return a number of one of its elements, or the default where there is none."""
        return default if element.get(attribute) is None else self.numbers(element, attribute, "0")[0]

    def numbers(self, element: Any, attribute: str, default: str) -> list[float]:
        """Return as many numbers of one of its elements as the default has."""
        text, count = element.get(attribute, default), len(default.split())
        try:
            values = [float(part) for part in text.split()]
        except ValueError:
            values = []
        if len(values) != count or not all(map(math.isfinite, values)):
            need = "a number" if count == 1 else f"{count} numbers"
            raise self.error(f'{attribute}="{text}" must be {need}, finite', element)
        return values

    def error(self, message: str, element: Any = None) -> InvalidInput:
        """Return an InvalidInput about the joint, or about one of its elements."""
        inside = "" if element is None else f" <{element.tag}>"
        line = (self.element if element is None else element).sourceline
        return InvalidInput(f"{self.where}, line {line}: joint {self.name!r}{inside}: {message}")


@dataclass(frozen=True)
class Urdf:
    """A robot's links and joints, checked to be a tree.

    Attributes
    ----------
    where : str
        The file, for messages.
    robot : str
        The robot's name; empty without.
    links : tuple of str
    joints : tuple of UrdfJoint
        In the file's order.
    """

    where: str
    robot: str
    links: tuple[str, ...]
    joints: tuple[UrdfJoint, ...]

    def joint(self, name: str) -> UrdfJoint | None:
        """Return the joint of a name; None without."""
        return next((joint for joint in self.joints if joint.name == name), None)

    def chain(self, base: str | None = None, tip: str | None = None) -> list[UrdfJoint]:
        """Return the joints from base to tip, fixed ones included.

        Parameters
        ----------
        base : str, optional
            Link it begins at; default: the root of the tree.
        tip : str, optional
            Link it ends at; default: the only leaf above the base.
        """
        for option, link in (("--base", base), ("--tip", tip)):
            if link is not None and link not in self.links:
                raise InvalidInput(f"{self.where}: {option} {link!r} is not a link; its links are {listed(self.links)}")
        above = {joint.child: joint for joint in self.joints}
        if tip is None:
            parents = {joint.parent for joint in self.joints}
            ends = [link for link in self.links if link not in parents and (base is None or base in _up(link, above))]
            if len(ends) != 1:
                raise InvalidInput(
                    f"{self.where}: the tree ends in {len(ends)} links; say which one carries the sensor by --tip: "
                    f"{listed(ends or self.links)}"
                )
            tip = ends[0]
        way = _up(tip, above)
        if base is not None and base not in way:
            raise InvalidInput(
                f"{self.where}: link {base!r} (--base) is not on the way from {tip!r} (--tip) to the root, which is "
                f"{', '.join(way)}; choose a base on it"
            )
        first = way.index(base) if base is not None else len(way) - 1
        return [above[link] for link in reversed(way[:first])]

    def chain_of(self, names: Sequence[str], base: str | None = None, tip: str | None = None) -> list[UrdfJoint]:
        """Return the chain whose moving joints are `names`, in their order.

        Parameters
        ----------
        names : sequence of str
            The calibrated joints, base to tip.
        base, tip : str, optional
            Links. Default: the first joint's parent, the last joint's child.
        """
        found = [self.joint(name) for name in names]
        missing = [name for name, joint in zip(names, found, strict=True) if joint is None]
        if missing:
            moving = ", ".join(joint.name for joint in self.joints if not joint.fixed)
            raise InvalidInput(
                f"{self.where}: has no joint {', '.join(map(repr, missing))} of the calibrated arm; its moving joints "
                f"are {moving}. Give the URDF of this arm, with joints named as in the recording"
            )
        first, last = found[0], found[-1]
        assert first is not None, "no name is missing"
        assert last is not None, "no name is missing"
        chain = self.chain(first.parent if base is None else base, last.child if tip is None else tip)
        moving_names = [joint.name for joint in chain if not joint.fixed]
        if moving_names != list(names):
            ends = f"from {chain[0].parent!r} to {chain[-1].child!r} " if chain else ""
            raise InvalidInput(
                f"{self.where}: {ends}the joints {', '.join(moving_names) or 'none'} move, the calibrated ones are "
                f"{', '.join(names)}; choose --base and --tip so that they are the same"
            )
        return chain


def read_urdf_file(path: str | Path) -> str:
    """Return the text of a URDF; InvalidInput where it cannot be read."""
    path = Path(path)
    try:
        return path.read_bytes().decode("utf-8")
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be read ({error.strerror or error}); check the path") from error
    except UnicodeDecodeError as error:
        raise InvalidInput(f"{path}: is not UTF-8 text (byte {error.start}); save the URDF as UTF-8") from error


def parse_urdf(text: str, where: str = "URDF") -> Urdf:
    """Read a URDF's links and joints.

    Parameters
    ----------
    text : str
        The file's content.
    where : str
        Its name in messages.

    Raises
    ------
    InvalidInput
        When it is not XML, is not a URDF, would have to be expanded, or is no tree.
    """
    robot = _parse_xml(text, where)
    links = tuple(required_attribute(where, link, "name") for link in robot.findall("link"))
    if not links:
        raise InvalidInput(f"{where}: has no <link>; a URDF with links and joints is needed")
    joints = tuple(_joint(where, element, links) for element in robot.findall("joint"))
    _require_tree(where, links, joints)
    return Urdf(where, robot.get("name") or "", links, joints)


def _parse_xml(text: str, where: str) -> Any:
    """Return the root element; entities and references to other files are refused."""
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False, encoding="utf-8")
    try:
        document = etree.fromstring(text.encode("utf-8"), parser).getroottree()
    except etree.XMLSyntaxError as error:
        hint = (
            "; it is xacro that was not expanded: run `xacro` and give what it prints" if "xacro" in error.msg else ""
        )
        raise InvalidInput(f"{where}: is not XML that can be read ({error.msg}){hint}") from error
    if document.docinfo.doctype or document.docinfo.internalDTD is not None:
        raise InvalidInput(
            f"{where}: has a document type (<!DOCTYPE ...>), which may define entities and refer to other files; "
            f"remove it, and write out what its entities stand for"
        )
    robot = document.getroot()
    if robot.tag != "robot":
        raise InvalidInput(f"{where}, line {robot.sourceline}: <{robot.tag}> is not <robot>; a URDF is needed")
    for element in robot.iter(etree.Element):
        _require_expanded(where, element)
    return robot


def _require_expanded(where: str, element: Any) -> None:
    place = f"{where}, line {element.sourceline}"
    if element.tag.startswith(_XINCLUDE):
        raise InvalidInput(f"{place}: includes another file; a URDF must stand alone: write it out")
    unexpanded = [f'{name}="{value}"' for name, value in element.attrib.items() if "${" in value or "$(" in value]
    if element.tag.startswith(_XACRO) or unexpanded:
        shown = unexpanded[0] if unexpanded else f"<{etree.QName(element).localname}>"
        raise InvalidInput(
            f"{place}: {shown} is xacro that was not expanded; run `xacro {Path(where).name} > arm.urdf` and give that "
            f"file"
        )


def required_attribute(where: str, element: Any, name: str) -> str:
    """Return an attribute's text; InvalidInput without."""
    value = element.get(name)
    if not value:
        raise InvalidInput(f"{where}, line {element.sourceline}: <{element.tag}> has no {name}; name it")
    return str(value)


def listed(names: Sequence[str]) -> str:
    """Return names for a message, not too many of them."""
    return ", ".join(names[:40]) + (", ..." if len(names) > 40 else "")


def _joint(where: str, element: Any, links: Sequence[str]) -> UrdfJoint:
    joint = UrdfJoint(
        where, element, required_attribute(where, element, "name"), required_attribute(where, element, "type"), "", ""
    )
    ends = []
    for tag in ("parent", "child"):
        end = element.find(tag)
        if end is None:
            raise joint.error(f"has no <{tag} link=.../>; name the link")
        link = required_attribute(where, end, "link")
        if link not in links:
            raise joint.error(f"link {link!r} is not in the file; its links are {listed(links)}", end)
        ends.append(link)
    return UrdfJoint(where, element, joint.name, joint.type, *ends)


def _require_tree(where: str, links: Sequence[str], joints: Sequence[UrdfJoint]) -> None:
    for kind, names in (("link", list(links)), ("joint", [joint.name for joint in joints])):
        twice = next((name for index, name in enumerate(names) if name in names[:index]), None)
        if twice:
            raise InvalidInput(f"{where}: two {kind}s are named {twice!r}; names must differ")
    above: dict[str, UrdfJoint] = {}
    for joint in joints:
        if joint.child in above:
            raise joint.error(
                f"is the second joint that carries link {joint.child!r} (the first is {above[joint.child].name!r}): a "
                f"closed loop; a serial arm is needed"
            )
        above[joint.child] = joint


def _up(link: str, above: dict[str, UrdfJoint]) -> list[str]:
    """Return the links from one to the root."""
    way = [link]
    while way[-1] in above:
        parent = above[way[-1]].parent
        if parent in way:
            break  # a ring without a root: nothing else hangs from it
        way.append(parent)
    return way
