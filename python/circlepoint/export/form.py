"""What every exported form is: a document for JSON and YAML, or texts with their notes."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import yaml

from circlepoint.document import generator_entry, plain
from circlepoint.export.placement import kept_nominal

if TYPE_CHECKING:
    from collections.abc import Mapping

    from circlepoint.export.placement import PlacedArm

SCHEMA_NAME = "circlepoint/export/1"


@dataclass(frozen=True)
class Export:
    """One exported form.

    Attributes
    ----------
    form : str
        What was written; ``hayati`` where the form asked for broke down.
    document : dict
        The content for JSON or YAML; for a form that is a text, the notes beside it.
    texts : dict
        Content by file ending, such as ``".urdf"``; empty where the document itself is the form.
    notes : tuple of str
        What whoever uses it must know.
    """

    form: str
    document: dict[str, Any]
    texts: Mapping[str, str] = field(default_factory=dict)
    notes: tuple[str, ...] = ()


def header(placed: PlacedArm, form: str, notes: tuple[str, ...] = ()) -> dict[str, Any]:
    """Return the fields every exported document begins with; SI units and radians."""
    arm = placed.arm
    return {
        "schema": SCHEMA_NAME,
        "form": form,
        "generator": generator_entry(),
        "arm": arm.name,
        "units": {"length": "m", "angle": "rad"},
        "joints": list(arm.joint_names),
        "joint_types": [kind.name for kind in arm.joint_types],
        "joint_positions": "raw encoder values, as recorded",
        **({"mimics": list(arm.mimics)} if arm.mimics else {}),
        "reference_configuration": plain(arm.reference),
        "base_frame": placed.base_name,
        "nominal": None if placed.nominal is None else Path(placed.nominal.source).name,
        "joint_offsets": offsets_entry(placed),
        "T_base_sensor_at_reference": plain(placed.T_base_sensor),
        "kept_nominal": kept_nominal(placed),
        "notes": list(notes),
    }


def offsets_entry(placed: PlacedArm) -> dict[str, float] | None:
    """Return each joint's zero offset: the nominal arm at q + offset is nearest the real one at encoder value q."""
    offsets = placed.joint_offsets
    return None if offsets is None else dict(zip(placed.arm.joint_names, plain(offsets), strict=True))


def json_text(document: Mapping[str, Any]) -> str:
    """Return a document as JSON."""
    return json.dumps(plain(document), indent=1, allow_nan=False, ensure_ascii=False) + "\n"


class _Dumper(yaml.SafeDumper):
    """Numbers with all their digits, rows of numbers on one line, no references."""

    def ignore_aliases(self, data: Any) -> bool:  # noqa: ARG002
        return True


def _sequence(dumper: yaml.SafeDumper, values: list[Any]) -> yaml.Node:
    flat = all(not isinstance(value, list | dict) for value in values)
    return dumper.represent_sequence("tag:yaml.org,2002:seq", values, flow_style=flat)


_Dumper.add_representer(list, _sequence)


def yaml_text(document: Mapping[str, Any]) -> str:
    """Return a document as YAML; it reads back as the same numbers."""
    text: str = yaml.dump(
        plain(document), Dumper=_Dumper, sort_keys=False, allow_unicode=True, width=110, default_flow_style=False
    )
    return text
