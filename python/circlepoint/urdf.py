"""URDF in: a serial arm from a base link to a tip link, with its nominal axes as lines.

Fixed joints are folded into the frames between; links, meshes, inertias are not looked at, and no file but the URDF is
opened. A document type, entities and inclusions are refused, as is xacro that was not expanded.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from lxml import etree

from circlepoint._core import InvalidInput, rotation_exp
from circlepoint.arm import LARGEST_LIMIT, LONGEST_LINK, Arm, Joint, NominalLine, NominalLines

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from circlepoint.arm import JointType

    FloatArray = NDArray[np.float64]

_TYPES: dict[str, JointType] = {"revolute": "revolute", "continuous": "revolute", "prismatic": "prismatic"}
_XINCLUDE = "{http://www.w3.org/2001/XInclude}"
_XACRO = ("{http://www.ros.org/wiki/xacro}", "{http://ros.org/wiki/xacro}", "{http://wiki.ros.org/xacro}")


@dataclass(frozen=True)
class _UrdfJoint:
    """A joint element and what it connects."""

    element: Any
    name: str
    type: str
    parent: str
    child: str


def read_urdf(path: str | Path, base: str | None = None, tip: str | None = None) -> Arm:
    """Read an arm from a URDF.

    Parameters
    ----------
    path : str or Path
        The file, xacro already expanded.
    base : str, optional
        Link the arm begins at; default: the root of the tree.
    tip : str, optional
        Link that carries the sensor; default: the only leaf above the base.

    Returns
    -------
    Arm
        Joints base to tip with names, types and limits, and the nominal lines at zero joint positions.

    Raises
    ------
    InvalidInput
        When the file cannot be read or is no serial arm from base to tip; the message names file, line, element,
        value and remedy.
    """
    path = Path(path)
    robot = parse_urdf(path)
    links = [_attribute(path, link, "name") for link in robot.findall("link")]
    joints = [_joint(path, element, links) for element in robot.findall("joint")]
    if not links:
        raise InvalidInput(f"{path}: has no <link>; a URDF with links and joints is needed")
    _require_tree(path, links, joints)
    chain = _chain(path, links, joints, base, tip)
    moving: list[Joint] = []
    lines: list[NominalLine] = []
    pose = np.eye(4)
    for joint in chain:
        pose = pose @ _origin(path, joint)
        if joint.type == "fixed":
            continue
        moving.append(_moving_joint(path, joint))
        direction = pose[:3, :3] @ _axis(path, joint)
        lines.append(NominalLine(_triple(direction), _triple(pose[:3, 3])))
    if not moving:
        raise InvalidInput(
            f"{path}: no joint moves between {_ends(chain, base, tip)}; choose --base and --tip further apart"
        )
    tip_pose = tuple(tuple(float(x) for x in row) for row in pose)
    return Arm(
        name=robot.get("name") or path.stem,
        joints=tuple(moving),
        lines=NominalLines((0.0,) * len(moving), tuple(lines), tip_pose),
    )


def parse_urdf(path: str | Path) -> Any:
    """Return the ``<robot>`` element of a URDF, comments kept; entities and references to other files are refused.

    Parameters
    ----------
    path : str or Path
        The file.

    Raises
    ------
    InvalidInput
        When it cannot be read, is not XML, is not a URDF, or would have to be expanded.
    """
    path = Path(path)
    parser = etree.XMLParser(resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False)
    try:
        document = etree.fromstring(path.read_bytes(), parser).getroottree()
    except OSError as error:
        raise InvalidInput(f"{path}: cannot be read ({error.strerror or error}); check the path") from error
    except etree.XMLSyntaxError as error:
        raise InvalidInput(f"{path}: is not XML that can be read ({error.msg})") from error
    if document.docinfo.doctype or document.docinfo.internalDTD is not None:
        raise InvalidInput(
            f"{path}: has a document type (<!DOCTYPE ...>), which may define entities and refer to other files; remove "
            f"it, and write out what its entities stand for"
        )
    robot = document.getroot()
    if robot.tag != "robot":
        raise InvalidInput(f"{path}, line {robot.sourceline}: <{robot.tag}> is not <robot>; a URDF is needed")
    for element in robot.iter(etree.Element):
        _require_expanded(path, element)
    return robot


def _require_expanded(path: Path, element: Any) -> None:
    place = f"{path}, line {element.sourceline}"
    if element.tag.startswith(_XINCLUDE):
        raise InvalidInput(f"{place}: includes another file; a URDF must stand alone: write it out")
    unexpanded = [f'{name}="{value}"' for name, value in element.attrib.items() if "${" in value or "$(" in value]
    if element.tag.startswith(_XACRO) or unexpanded:
        shown = unexpanded[0] if unexpanded else f"<{etree.QName(element).localname}>"
        raise InvalidInput(
            f"{place}: {shown} is xacro that was not expanded; run `xacro {path.name} > arm.urdf` and give that file"
        )


def _attribute(path: Path, element: Any, name: str) -> str:
    value = element.get(name)
    if not value:
        raise InvalidInput(f"{path}, line {element.sourceline}: <{element.tag}> has no {name}; name it")
    return str(value)


def _joint(path: Path, element: Any, links: Sequence[str]) -> _UrdfJoint:
    name = _attribute(path, element, "name")
    ends = []
    for tag in ("parent", "child"):
        end = element.find(tag)
        if end is None:
            raise _error(path, element, f"has no <{tag} link=.../>; name the link")
        link = _attribute(path, end, "link")
        if link not in links:
            raise _error(path, end, f"link {link!r} is not in the file; its links are {_listed(links)}", element)
        ends.append(link)
    return _UrdfJoint(element, name, _attribute(path, element, "type"), *ends)


def _require_tree(path: Path, links: Sequence[str], joints: Sequence[_UrdfJoint]) -> None:
    for kind, names in (("link", list(links)), ("joint", [joint.name for joint in joints])):
        twice = next((name for index, name in enumerate(names) if name in names[:index]), None)
        if twice:
            raise InvalidInput(f"{path}: two {kind}s are named {twice!r}; names must differ")
    above: dict[str, _UrdfJoint] = {}
    for joint in joints:
        if joint.child in above:
            raise _error(
                path,
                joint.element,
                f"is the second joint that carries link {joint.child!r} (the first is {above[joint.child].name!r}): a "
                f"closed loop; a serial arm is needed",
            )
        above[joint.child] = joint


def _chain(
    path: Path, links: Sequence[str], joints: Sequence[_UrdfJoint], base: str | None, tip: str | None
) -> list[_UrdfJoint]:
    """Return the joints from base to tip."""
    for option, link in (("--base", base), ("--tip", tip)):
        if link is not None and link not in links:
            raise InvalidInput(f"{path}: {option} {link!r} is not a link; its links are {_listed(links)}")
    above = {joint.child: joint for joint in joints}
    if tip is None:
        parents = {joint.parent for joint in joints}
        leaves = [link for link in links if link not in parents and (base is None or base in _way_up(link, above))]
        if len(leaves) != 1:
            raise InvalidInput(
                f"{path}: the tree ends in {len(leaves)} links; say which one carries the sensor by --tip: "
                f"{_listed(leaves or links)}"
            )
        tip = leaves[0]
    way = _way_up(tip, above)
    if base is not None and base not in way:
        raise InvalidInput(
            f"{path}: link {base!r} (--base) is not on the way from {tip!r} (--tip) to the root, which is "
            f"{', '.join(way)}; choose a base on it"
        )
    ends = way.index(base) if base is not None else len(way) - 1
    return [above[link] for link in reversed(way[:ends])]


def _way_up(link: str, above: dict[str, _UrdfJoint]) -> list[str]:
    way = [link]
    while way[-1] in above:
        parent = above[way[-1]].parent
        if parent in way:
            break  # a ring without a root: nothing else hangs from it
        way.append(parent)
    return way


def _moving_joint(path: Path, joint: _UrdfJoint) -> Joint:
    if joint.type not in _TYPES:
        raise _error(
            path,
            joint.element,
            f"is of type {joint.type!r}, which is not one line; revolute, continuous, prismatic and fixed joints can "
            f"be between --base and --tip",
        )
    mimic = joint.element.find("mimic")
    if mimic is not None:
        raise _error(
            path,
            joint.element,
            f"mimics {mimic.get('joint')!r}: it has no position of its own; choose --base and --tip so that it is not "
            f"between them, or describe the arm by its driven joints",
        )
    kind = _TYPES[joint.type]
    limit = joint.element.find("limit")
    velocity = None if limit is None else _number(path, joint, limit, "velocity", 0.0)
    return Joint(
        name=joint.name,
        type=kind,
        limits=None if limit is None or joint.type == "continuous" else _limits(path, joint, limit),
        velocity=velocity or None,
    )


def _limits(path: Path, joint: _UrdfJoint, limit: Any) -> tuple[float, float] | None:
    low, high = _number(path, joint, limit, "lower", 0.0), _number(path, joint, limit, "upper", 0.0)
    if low == high == 0.0:  # the format's defaults: not given
        return None
    if low >= high:
        raise _error(path, limit, f"the lower limit {low:g} is not below the upper, {high:g}", joint.element)
    if _TYPES[joint.type] == "revolute" and max(abs(low), abs(high)) > LARGEST_LIMIT:
        raise _error(
            path,
            limit,
            f"limits {low:g} to {high:g} look like degrees; a URDF has radians ({math.radians(low):.6f} to "
            f'{math.radians(high):.6f}); for a joint without end, type="continuous"',
            joint.element,
        )
    return low, high


def _number(path: Path, joint: _UrdfJoint, element: Any, attribute: str, default: float) -> float:
    text = element.get(attribute)
    if text is None:
        return default
    (value,) = _numbers(path, joint, element, attribute, "0")
    return value


def _numbers(path: Path, joint: _UrdfJoint, element: Any, attribute: str, default: str) -> list[float]:
    text, count = element.get(attribute, default), len(default.split())
    try:
        values = [float(part) for part in text.split()]
    except ValueError:
        values = []
    if len(values) != count or not all(map(math.isfinite, values)):
        need = "a number" if count == 1 else f"{count} numbers"
        raise _error(path, element, f'{attribute}="{text}" must be {need}, finite', joint.element)
    return values


def _origin(path: Path, joint: _UrdfJoint) -> FloatArray:
    pose = np.eye(4)
    origin = joint.element.find("origin")
    if origin is None:
        return pose
    xyz = _numbers(path, joint, origin, "xyz", "0 0 0")
    rpy = _numbers(path, joint, origin, "rpy", "0 0 0")
    if max(map(abs, xyz)) > LONGEST_LINK:
        raise _error(path, origin, f'xyz="{origin.get("xyz")}" looks like millimetres; write metres', joint.element)
    if max(map(abs, rpy)) > LARGEST_LIMIT:
        raise _error(path, origin, f'rpy="{origin.get("rpy")}" looks like degrees; write radians', joint.element)
    roll, pitch, yaw = (rotation_exp(angle * unit) for angle, unit in zip(rpy, np.eye(3), strict=True))
    pose[:3, :3] = yaw @ pitch @ roll
    pose[:3, 3] = xyz
    return pose


def _axis(path: Path, joint: _UrdfJoint) -> FloatArray:
    axis = joint.element.find("axis")
    if axis is None:
        return np.array([1.0, 0.0, 0.0])  # the format's default
    values = np.array(_numbers(path, joint, axis, "xyz", "1 0 0"))
    length = float(np.linalg.norm(values))
    if length < 1e-9:
        raise _error(path, axis, f'xyz="{axis.get("xyz")}" has no direction; give the axis', joint.element)
    return np.asarray(values / length)


def _error(path: Path, element: Any, message: str, joint: Any = None) -> InvalidInput:
    owner = element if joint is None else joint
    inside = "" if joint is None else f" <{element.tag}>"
    return InvalidInput(f"{path}, line {element.sourceline}: joint {owner.get('name')!r}{inside}: {message}")


def _ends(chain: Sequence[_UrdfJoint], base: str | None, tip: str | None) -> str:
    return f"{base or (chain[0].parent if chain else tip)} and {tip or (chain[-1].child if chain else base)}"


def _listed(names: Sequence[str]) -> str:
    return ", ".join(names[:40]) + (", ..." if len(names) > 40 else "")


def _triple(vector: FloatArray) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in vector)
    return x, y, z
