"""A fleet's file: which logs are to be calibrated, each with its arm."""

from __future__ import annotations

import glob
import hashlib
import re
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import circlepoint
from circlepoint.campaign.sections import METHODS
from circlepoint.sensor_presets import load_sensor, sensor_names
from circlepoint.yaml_io import Fields, describe, load_fields, load_yaml

if TYPE_CHECKING:
    from collections.abc import Iterator

    from circlepoint.calibration import Method

_DEFAULTS = ("sensor", "method", "gravity", "columns")
KEYS = ("name", "fleet", *_DEFAULTS)
_ENTRY = ("name", "log", "logs", "arm", "base", "tip", "joint_topic", "imu_topic", *_DEFAULTS)
_placeholder = re.compile(r"\{(\w*)\}")
_unsafe = re.compile(r"[^\w.+-]+")


@dataclass(frozen=True)
class FleetLog:
    """One recording of one arm, and how it is calibrated; paths are absolute."""

    name: str
    logs: tuple[Path, ...]
    arm: Path
    base: str | None
    tip: str | None
    columns: Path | None
    sensor: str | None
    method: Method
    gravity: float
    joint_topic: str | None
    imu_topic: str | None

    def settings(self) -> dict[str, Any]:
        """Return what decides the result, as JSON has it: settings, small files by content, logs by size and date."""
        return {
            "logs": [_stamp(path) for path in self.logs],
            "arm": _digest(self.arm),
            "base": self.base,
            "tip": self.tip,
            "columns": None if self.columns is None else _digest(self.columns),
            "sensor": self.sensor if self.sensor in (None, *sensor_names()) else _digest(Path(str(self.sensor))),
            "method": self.method,
            "gravity": self.gravity,
            "joint_topic": self.joint_topic,
            "imu_topic": self.imu_topic,
        }


@dataclass(frozen=True)
class Fleet:
    """A fleet's file, read."""

    path: Path
    name: str
    logs: tuple[FleetLog, ...]


def is_fleet(path: str | Path) -> bool:
    """Return whether a campaign's file is about the logs of a fleet."""
    return "fleet" in load_yaml(path).data


def load_fleet(path: str | Path) -> Fleet:
    """Read a fleet's file.

    Parameters
    ----------
    path : str or Path
        YAML with ``fleet``: a mapping or a list of mappings with ``log`` (a file, or a list of files that are one
        recording) or ``logs`` (a pattern: every match is a recording), ``arm``, and optionally ``name``, ``base``,
        ``tip``, ``columns``, ``sensor``, ``method``, ``gravity``, ``joint_topic``, ``imu_topic``. ``{folder}``,
        ``{parent}`` and ``{stem}`` in ``arm``, ``columns`` and ``name`` stand for the log's folder, its name, and the
        log's name without ending. ``sensor``, ``method``, ``gravity`` and ``columns`` beside ``fleet`` are defaults.

    Returns
    -------
    Fleet

    Raises
    ------
    InvalidInput
        Naming file, line, field, value and remedy. A log that is not there is not an error yet: it is told of when it
        is its turn, like any other fault of a log.
    """
    fields = load_fields(path, KEYS)
    given = fields.value("fleet", "a list of logs with their arms")
    if not isinstance(given, dict | list) or not given:
        what = describe(given) if given else "empty"
        fields.fail("fleet", f"is {what}; give a list of logs, each with its arm")
    places: list[tuple[Any, ...]] = (
        [("fleet",)] if isinstance(given, dict) else [("fleet", index) for index in range(len(given))]
    )
    logs: list[FleetLog] = []
    for place in places:
        value = given if isinstance(given, dict) else given[place[1]]
        entry = Fields.of(fields.file, place, value, _ENTRY)
        for log in _logs(fields, entry):
            if any(other.name == log.name for other in logs):
                entry.fail(
                    "name", f"{log.name!r} is the name of another log too; give each its own, as with {{parent}}"
                )
            logs.append(log)
    return Fleet(Path(path), fields.text("name", "a name", default=Path(path).stem), tuple(logs))


def _logs(fields: Fields, entry: Fields) -> Iterator[FleetLog]:
    root = fields.file.path.parent.absolute()
    for files in _recordings(entry, root):
        words = {"folder": str(files[0].parent), "parent": files[0].parent.name, "stem": _stem(files[0])}
        name = _filled(entry, "name", words) if "name" in entry else _default_name(files[0], root)
        columns = next((source for source in (entry, fields) if "columns" in source), None)
        sensor = next((source for source in (entry, fields) if "sensor" in source), None)
        method = next((source for source in (entry, fields) if "method" in source), None)
        gravity = next((source for source in (entry, fields) if "gravity" in source), None)
        yield FleetLog(
            name=_unsafe.sub("_", name).lstrip("._") or "log",
            logs=tuple(files),
            arm=root / _filled(entry, "arm", words),
            base=entry.text("base", "a link's name") if "base" in entry else None,
            tip=entry.text("tip", "a link's name") if "tip" in entry else None,
            columns=None if columns is None else root / _filled(columns, "columns", words),
            sensor=None if sensor is None else _sensor(sensor, root),
            method="whole-arm" if method is None else method.choice("method", METHODS),
            gravity=circlepoint.STANDARD_GRAVITY if gravity is None else gravity.number("gravity", above=0.0),
            joint_topic=entry.text("joint_topic", "a topic") if "joint_topic" in entry else None,
            imu_topic=entry.text("imu_topic", "a topic") if "imu_topic" in entry else None,
        )


def _recordings(entry: Fields, root: Path) -> list[list[Path]]:
    """Return the files of each recording of an entry."""
    if ("log" in entry) == ("logs" in entry):
        entry.fail("log", "or logs is needed, and not both: one recording's file or files, or a pattern of recordings")
    if "log" in entry:
        value = entry.values["log"]
        names = value if isinstance(value, list) else [value]
        if not names:
            entry.fail("log", "is an empty list; give one file at least")
        return [[root / entry.file.text((*entry.where, "log"), name) for name in names]]
    pattern = entry.text("logs", "a pattern such as site/*/log.csv")
    found = sorted(glob.glob(str(root / pattern), recursive=True))  # noqa: PTH207  (the pattern may be absolute)
    if not found:
        entry.fail("logs", f"is {pattern!r}, which no file matches in {root}; mend the pattern")
    return [[Path(name)] for name in found]


def _sensor(fields: Fields, root: Path) -> str:
    """Return a preset's name or an absolute path, seen to be readable."""
    text = fields.text("sensor", "a preset's name or a data sheet file")
    named = text if text in sensor_names() else str(root / text)
    load_sensor(named)
    return named


def _filled(entry: Fields, key: str, words: dict[str, str]) -> str:
    """Return a text with its placeholders filled in."""
    text = entry.text(key, "the arm's description, arm.yaml or a URDF" if key == "arm" else "a text")
    for word in _placeholder.findall(text):
        if word not in words:
            known = ", ".join(f"{{{name}}}" for name in words)
            entry.fail(key, f"is {text!r}; {{{word}}} is not known, {known} are")
    return _placeholder.sub(lambda found: words[found[1]], text)


def _default_name(log: Path, root: Path) -> str:
    relative = log.relative_to(root) if log.is_relative_to(root) else log.relative_to(log.anchor)
    return "_".join([*(part for part in relative.parent.parts if part != ".."), _stem(log)])


def _stem(log: Path) -> str:
    return log.name.removesuffix(".gz").rpartition(".")[0] or log.name


def _stamp(path: Path) -> list[Any]:
    try:
        found = path.stat()
    except OSError:
        return [str(path), None, None]
    return [str(path), found.st_size, found.st_mtime_ns]


def _digest(path: Path) -> list[Any]:
    try:
        return [str(path), hashlib.sha256(path.read_bytes()).hexdigest()]
    except OSError:
        return [str(path), None]
