"""From a result folder to a file: which form, which nominal arm, written whole or not at all."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from circlepoint._core import InvalidInput
from circlepoint.arm import Arm, is_urdf, load_arm
from circlepoint.atomic import require_writable_folder, write_atomically
from circlepoint.export.dh import export_dh
from circlepoint.export.form import Export, json_text, yaml_text
from circlepoint.export.hayati import export_hayati
from circlepoint.export.kdl import export_kdl
from circlepoint.export.nominal_frames import frames_of_arm, frames_of_urdf
from circlepoint.export.pinocchio import export_pinocchio
from circlepoint.export.placement import place
from circlepoint.export.poe import export_poe
from circlepoint.export.result import CalibratedArm, calibrated_arm, load_result
from circlepoint.export.table import export_table
from circlepoint.export.ur import export_ur
from circlepoint.export.urdf import export_urdf, minimal_urdf
from circlepoint.urdf_xml import parse_urdf, read_urdf_file

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping
    from pathlib import Path

    from circlepoint.export.placement import PlacedArm

FORMS = ("urdf", "dh", "mdh", "hayati", "poe", "ur", "kdl", "pinocchio", "table")
KEPT_DESCRIPTIONS = ("nominal.urdf", "arm.yaml")
"""Names in a result folder under which the arm's description is looked for."""
_DOCUMENT_ENDINGS = (".yaml", ".yml", ".json")
_PLAIN_FORMS: dict[str, Callable[[PlacedArm], Export]] = {
    "dh": lambda placed: export_dh(placed, "standard"),
    "mdh": lambda placed: export_dh(placed, "modified"),
    "hayati": export_hayati,
    "poe": export_poe,
    "kdl": export_kdl,
    "pinocchio": export_pinocchio,
    "table": export_table,
}


@dataclass(frozen=True)
class Description:
    """The arm's nominal description: an ``arm.yaml`` or a URDF's text."""

    path: Path
    arm: Arm | None = None
    urdf_text: str | None = None


def export_result(
    folder: Path,
    form: str,
    *,
    arm: Path | None = None,
    base: str | None = None,
    tip: str | None = None,
    checksum: str | None = None,
) -> Export:
    """Export a result folder's arm.

    Parameters
    ----------
    folder : Path
        Holds ``calibration.json``.
    form : str
        One of `FORMS`.
    arm : Path, optional
        The nominal description, ``arm.yaml`` or URDF; by default the one kept in the folder, if any.
    base, tip : str, optional
        Links of a URDF; by default those it was calibrated with.
    checksum : str, optional
        For the form ``ur``: the controller's.

    Raises
    ------
    InvalidInput
        A file or name does not fit; the message says what.
    NotIdentifiable
        A joint's axis is missing.
    """
    calibrated = load_result(folder)
    description = _description(folder, arm)
    if arm is None and base is None and tip is None:
        base, tip = calibrated.base, calibrated.tip
    if form == "urdf" and description is not None and description.urdf_text is not None:
        return export_urdf(calibrated, description.urdf_text, str(description.path), base=base, tip=tip)
    placed = _placed(calibrated, description, base, tip)
    if form == "urdf":
        return minimal_urdf(placed, description.arm if description else None)
    if form == "ur":
        return export_ur(placed, checksum)
    if form not in _PLAIN_FORMS:
        raise InvalidInput(f"form {form!r} is not known; choose one of {', '.join(FORMS)}")
    return _PLAIN_FORMS[form](placed)


def write_export(export: Export, folder: Path, asked: str, out: Path | None = None) -> list[Path]:
    """Write an export, each file whole or not at all.

    Parameters
    ----------
    export : Export
    folder : Path
        Where files go without `out`: ``arm.urdf`` with its notes ``arm.urdf.yaml``, ``table.md`` and ``table.csv``,
        ``ur_kinematics.yaml``, else ``<form>.yaml``.
    asked : str
        The form that was asked for: names the file.
    out : Path, optional
        The file instead; its ending chooses among the form's.

    Returns
    -------
    list of Path
        What was written.

    Raises
    ------
    InvalidInput
        The form is not written with such an ending, or the folder cannot be written.
    """
    files: dict[Path, str] = {}
    if out is not None:
        files[out] = _content(export, out)
        if export.form == "urdf" and out.suffix == ".urdf":
            files = {out.with_name(f"{out.name}.yaml"): yaml_text(export.document), **files}
    elif export.form == "urdf":
        files = {folder / "arm.urdf.yaml": yaml_text(export.document), folder / "arm.urdf": export.texts[".urdf"]}
    elif export.form == "ur":
        files = {folder / "ur_kinematics.yaml": export.texts[".yaml"]}
    elif export.texts:
        files = {folder / f"{asked}{ending}": text for ending, text in export.texts.items()}
    else:
        files = {folder / f"{asked}.yaml": yaml_text(export.document)}
    for path in files:
        require_writable_folder(path.parent)
    for path, text in files.items():
        path.parent.mkdir(parents=True, exist_ok=True)
        write_atomically(path, text.encode("utf-8"))
    return list(files)


def write_description(
    folder: Path,
    description: Path,
    calibration_document: Mapping[str, Any],
    *,
    base: str | None = None,
    tip: str | None = None,
) -> list[Path]:
    """Keep an arm's nominal description in its result folder, and write the calibrated URDF where a URDF came in.

    Parameters
    ----------
    folder : Path
        The result folder; it exists.
    description : Path
        The file the arm was read from: kept as ``arm.yaml`` or ``nominal.urdf``, where `export_result` finds it.
    calibration_document : mapping
        The content of ``calibration.json``; with a joint missing no URDF is written.
    base, tip : str, optional
        Links of the URDF.

    Returns
    -------
    list of Path
        What was written.
    """
    urdf_came = is_urdf(description)
    kept = folder / (KEPT_DESCRIPTIONS[0] if urdf_came else KEPT_DESCRIPTIONS[1])
    if not (kept.exists() and kept.samefile(description)):
        write_atomically(kept, description.read_bytes())
    if not urdf_came or not calibration_document["complete"]:
        return [kept]
    text = read_urdf_file(description)
    export = export_urdf(calibrated_arm(calibration_document), text, str(description), base=base, tip=tip)
    return [kept, *write_export(export, folder, "urdf")]


def _content(export: Export, out: Path) -> str:
    ending = out.suffix.lower()
    if ending in export.texts:
        return export.texts[ending]
    if ending == ".json":
        return json_text(export.document)
    if ending in {".yaml", ".yml"}:
        return export.texts.get(".yaml") or yaml_text(export.document)
    known = ", ".join(dict.fromkeys([*export.texts, *_DOCUMENT_ENDINGS]))
    fault = f"the form {export.form} is not written as {ending!r}" if ending else "the file's name has no ending"
    raise InvalidInput(f"{out}: {fault}; use {known}")


def _description(folder: Path, given: Path | None) -> Description | None:
    path = given
    if path is None:
        path = next((folder / name for name in KEPT_DESCRIPTIONS if (folder / name).is_file()), None)
    if path is None:
        return None
    if not is_urdf(path):
        return Description(path, arm=load_arm(path))
    return Description(path, urdf_text=read_urdf_file(path))


def _placed(arm: CalibratedArm, description: Description | None, base: str | None, tip: str | None) -> PlacedArm:
    if description is None:
        return place(arm)
    if description.urdf_text is not None:
        urdf = parse_urdf(description.urdf_text, str(description.path))
        return place(arm, frames_of_urdf(urdf.chain_of(arm.joint_names, base, tip), urdf.where))
    if description.arm is not None and description.arm.joint_names != arm.joint_names:
        raise InvalidInput(
            f"{description.path}: has the joints {', '.join(description.arm.joint_names)}, the calibrated arm has "
            f"{', '.join(arm.joint_names)}; give the description it was calibrated with"
        )
    return place(arm, None if description.arm is None else frames_of_arm(description.arm, str(description.path)))
