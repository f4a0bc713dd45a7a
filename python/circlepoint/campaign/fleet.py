"""Calibrates a fleet: every log by the same job as ``circlepoint calibrate``, every outcome a row, resumable.

DIR/results/NAME is the result folder of a log, DIR/rows/NAME.json its row: written last, it says that the log is
finished. DIR/fleet.parquet (a row a log) and DIR/joints.parquet (a row a joint) are put together from the rows.
"""

from __future__ import annotations

import contextlib
import errno
import json
import shutil
import tempfile
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import pyarrow as pa

from circlepoint._core import InvalidInput
from circlepoint.arm import load_arm
from circlepoint.atomic import write_atomically
from circlepoint.campaign import folder as folders
from circlepoint.campaign.cluster import Lost, on_cluster
from circlepoint.campaign.processes import in_processes
from circlepoint.document import Document, generator_entry
from circlepoint.failures import explain
from circlepoint.report.rounding import ABSENT, significant
from circlepoint.result_folder import CalibrationJob, calibrate_into
from circlepoint.sensor_presets import load_sensor
from circlepoint.text_table import aligned

if TYPE_CHECKING:
    from collections.abc import Generator, Sequence

    from circlepoint.campaign.fleet_config import Fleet, FleetLog
    from circlepoint.campaign.run import Watcher

SCHEMA_NAME = "circlepoint/fleet-summary/1"
_SCRATCH = ".scratch"
_DISK_FAULTS = {errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EROFS, errno.EIO}
_KILLED = "its process was killed, likely for want of memory; thin the log out, or give fewer workers"
_KILLED_THERE = (
    "every worker of the cluster that was given it was killed, likely for want of memory; thin the log out, or give "
    "the workers more memory or fewer threads"
)
COMPLETE, INCOMPLETE, FAILED = "complete", "incomplete", "failed"

_LOG_COLUMNS = {
    "name": pa.string(),
    "outcome": pa.string(),
    "error": pa.string(),
    "arm": pa.string(),
    "method": pa.string(),
    "logs": pa.list_(pa.string()),
    "joints": pa.int32(),
    "missing": pa.list_(pa.string()),
    "samples": pa.int64(),
    "duration": pa.float64(),
    "converged": pa.bool_(),
    "noise_std": pa.float64(),
    "normalised_residual_rms": pa.float64(),
    "end_point_rms": pa.float64(),
    "end_point_max": pa.float64(),
    "direction_std": pa.float64(),
    "point_std": pa.float64(),
    "direction_difference": pa.float64(),
    "point_difference": pa.float64(),
    "findings": pa.list_(pa.string()),
}
_JOINT_COLUMNS = {
    "name": pa.string(),
    "joint": pa.string(),
    "type": pa.string(),
    **{f"direction_{axis}": pa.float64() for axis in "xyz"},
    "direction_std": pa.float64(),
    **{f"point_{axis}": pa.float64() for axis in "xyz"},
    "point_std": pa.float64(),
    "direction_difference": pa.float64(),
    "point_difference": pa.float64(),
    "reason": pa.string(),
}


class Calibrated(NamedTuple):
    """What became of a log: its row, its joints' rows, and the files of its result folder.

    One that wanted memory, as one whose process was killed, is calibrated `again` when the fleet is run again.
    """

    row: Document
    joints: list[Document]
    files: dict[str, bytes]
    again: bool = False


def run_fleet(
    fleet: Fleet, out: Path, *, workers: int = 1, scheduler: str | None = None, watcher: Watcher | None = None
) -> Document:
    """Calibrate what is not finished yet, and return the summary of all.

    Parameters
    ----------
    fleet : Fleet
    out : Path
    workers : int
        Processes of this machine.
    scheduler : str, optional
        Address of a Dask scheduler; its workers must see the logs under the same paths.
    watcher : Watcher, optional

    Raises
    ------
    InvalidInput
        When a log was calibrated there otherwise, or another process is writing to the folder.
    """
    with folders.only_writer(out):
        folders.claim(out, {"config": {"fleet": True}, "files": {}}, fleet.path)
        folders.remove_unfinished(out)
        scratch = _emptied(out / _SCRATCH)
        waiting = [log for log in fleet.logs if not _is_finished(out, log, fleet.path)]
        if watcher is not None:
            watcher.begin(len(fleet.logs), len(fleet.logs) - len(waiting))
        if scheduler is not None and waiting:
            run = _there(waiting, scheduler, watcher)
        elif min(workers, len(waiting)) <= 1:
            run = ((log, calibrate_log(log, scratch)) for log in waiting)
        else:
            run = _here(waiting, min(workers, len(waiting)), scratch)
        # As they are before the calibration: what changes meanwhile has not been calibrated.
        settings = {log.name: log.settings() for log in waiting}
        try:
            with contextlib.closing(run):
                for log, calibrated in run:
                    _keep(out, log, calibrated, settings[log.name], scratch)
                    if watcher is not None:
                        watcher.advance(1)
        finally:
            shutil.rmtree(scratch, ignore_errors=True)
        return _collect(fleet, out)


def calibrate_log(log: FleetLog, scratch: Path | None = None) -> Calibrated:
    """Calibrate one log, with files on the way in `scratch`; whatever is wrong with it is a row that says so.

    Raises
    ------
    OSError
        When the disk is full or broken: no fault of the log, and the next one would meet the same.
    """
    row = _failed(log)
    with tempfile.TemporaryDirectory(prefix="circlepoint-", dir=scratch) as name:
        folder = Path(name)
        try:
            arm = load_arm(log.arm, base=log.base, tip=log.tip)
            row |= {"arm": arm.name, "joints": len(arm.joints)}
            job = CalibrationJob(
                logs=log.logs,
                arm_file=log.arm,
                base=log.base,
                tip=log.tip,
                columns=log.columns,
                method=log.method,
                sensor=None if log.sensor is None else load_sensor(log.sensor),
                gravity=log.gravity,
                joint_topic=log.joint_topic,
                imu_topic=log.imu_topic,
            )
            document = calibrate_into(folder, job, arm).document
        except Exception as error:
            if isinstance(error, OSError) and error.errno in _DISK_FAULTS:
                raise
            return Calibrated({**row, "error": explain(error)[0]}, [], {}, again=isinstance(error, MemoryError))
        files = {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    return Calibrated(
        row | _log_figures(document), [_joint_figures(log.name, joint) for joint in document["joints"]], files
    )


def format_fleet(summary: Document) -> str:
    """Return a table with a row a log."""
    rows = [("log", "arm", "outcome", "end-point, mm", "direction, mrad", "point, mm", "off nominal, mm", "")]
    for row in summary["logs"]:
        missing = f"missing: {', '.join(row['missing'])}" if row["missing"] else ""
        rows.append(
            (
                row["name"],
                row["arm"] or ABSENT,
                row["outcome"],
                *(
                    ABSENT if row[key] is None else significant(1e3 * row[key])
                    for key in ("end_point_rms", "direction_std", "point_std", "point_difference")
                ),
                row["error"] or missing,
            )
        )
    return "\n".join(aligned(rows, left={0, 1, 2, 7}))


def _log_figures(document: Document) -> Document:
    joints, fit, recording = document["joints"], document["fit"], document["recording"]
    missing = [joint["name"] for joint in joints if joint["direction_sensor"] is None]
    end_point = document["end_point"] or {}
    nominal = [joint["nominal"] for joint in joints if joint.get("nominal")]
    return {
        "outcome": INCOMPLETE if missing else COMPLETE,
        "missing": missing,
        "samples": recording["samples"],
        "duration": recording["duration"],
        "converged": fit["converged"],
        "noise_std": fit["noise_std"],
        "normalised_residual_rms": fit["normalised_residual_rms"],
        "end_point_rms": end_point.get("rms"),
        "end_point_max": end_point.get("max"),
        "direction_std": _largest(joint["direction_std"] for joint in joints),
        "point_std": _largest(joint["point_std"] for joint in joints),
        "direction_difference": _largest(entry["direction_difference"] for entry in nominal),
        "point_difference": _largest(entry["point_difference"] for entry in nominal),
        "findings": [finding["message"] for finding in document["findings"]],
    }


def _joint_figures(name: str, joint: Document) -> Document:
    nominal = joint.get("nominal") or {}
    row: Document = {"name": name, "joint": joint["name"], "type": joint["type"], "reason": joint["reason"]}
    for what in ("direction", "point"):
        vector = joint[f"{what}_sensor"] or (None, None, None)
        row |= {f"{what}_{axis}": value for axis, value in zip("xyz", vector, strict=True)}
        row |= {f"{what}_std": joint[f"{what}_std"], f"{what}_difference": nominal.get(f"{what}_difference")}
    return row


def _largest(values: Any) -> float | None:
    return max((value for value in values if value is not None), default=None)


def _row_path(out: Path, log: FleetLog) -> Path:
    return out / "rows" / f"{log.name}.json"


def _is_finished(out: Path, log: FleetLog, source: Path) -> bool:
    """Return whether a log is done; one that failed is done again when anything about it has changed."""
    path = _row_path(out, log)
    try:
        kept = json.loads(path.read_text(encoding="utf-8"))
        settings, outcome = kept["settings"], kept["row"]["outcome"]
    except FileNotFoundError:
        return False
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InvalidInput(f"{path}: is not a row of a fleet ({type(error).__name__}); take it away") from error
    now = log.settings()
    changed = [key for key in now if now[key] != settings.get(key)]
    if changed and outcome != FAILED:
        raise InvalidInput(
            f"{source}: {log.name}: {changed[0]}: is not what it was when it was calibrated in {out}; put it back, "
            f"give another folder, or take {path} away to have it calibrated again"
        )
    return not changed


def _emptied(folder: Path) -> Path:
    """Return a folder with nothing in it; what a killed process left there is taken away."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    return folder


def _keep(out: Path, log: FleetLog, calibrated: Calibrated, settings: Document, scratch: Path) -> None:
    """Write a log's result folder, then its row."""
    target = out / "results" / log.name
    fresh = scratch / log.name
    shutil.rmtree(fresh, ignore_errors=True)
    shutil.rmtree(target, ignore_errors=True)
    target.parent.mkdir(exist_ok=True)
    for name, content in calibrated.files.items():
        (fresh / name).parent.mkdir(parents=True, exist_ok=True)
        write_atomically(fresh / name, content)
    if calibrated.files:
        fresh.rename(target)
    kept = {
        "settings": {} if calibrated.again else settings,
        "row": calibrated.row,
        "joints": calibrated.joints,
    }
    path = _row_path(out, log)
    path.parent.mkdir(exist_ok=True)
    write_atomically(path, (json.dumps(kept, indent=1, ensure_ascii=False) + "\n").encode())


def _collect(fleet: Fleet, out: Path) -> Document:
    kept = [json.loads(_row_path(out, log).read_text(encoding="utf-8")) for log in fleet.logs]
    rows = [entry["row"] for entry in kept]
    folders.write_table(out / "fleet.parquet", _table(rows, _LOG_COLUMNS))
    joints = [joint for entry in kept for joint in entry["joints"]]
    folders.write_table(out / "joints.parquet", _table(joints, _JOINT_COLUMNS))
    return {
        "schema": SCHEMA_NAME,
        "generator": generator_entry(),
        "fleet": fleet.name,
        **{outcome: sum(row["outcome"] == outcome for row in rows) for outcome in (COMPLETE, INCOMPLETE, FAILED)},
        "logs": rows,
    }


def _table(rows: Sequence[Document], columns: dict[str, pa.DataType]) -> pa.Table:
    return pa.table({name: pa.array([row[name] for row in rows], kind) for name, kind in columns.items()})


def _here(logs: list[FleetLog], workers: int, scratch: Path) -> Generator[tuple[FleetLog, Calibrated]]:
    """Calibrate in processes; a log that takes its process down fails alone."""
    with contextlib.closing(in_processes(partial(calibrate_log, scratch=scratch), logs, workers)) as run:
        for log, calibrated in run:
            yield log, _killed(log, _KILLED) if isinstance(calibrated, Lost) else calibrated


def _there(logs: list[FleetLog], scheduler: str, watcher: Watcher | None) -> Generator[tuple[FleetLog, Calibrated]]:
    """Calibrate on a cluster; a log that takes its workers down fails alone."""
    tell = None if watcher is None else watcher.tell
    for log, calibrated in on_cluster(scheduler, _on_worker, None, logs, tell=tell):
        yield log, _killed(log, _KILLED_THERE) if isinstance(calibrated, Lost) else calibrated


def _on_worker(_: None, log: FleetLog) -> Calibrated:
    return calibrate_log(log)


def _killed(log: FleetLog, error: str) -> Calibrated:
    return Calibrated(_failed(log, error), [], {}, again=True)


def _failed(log: FleetLog, error: str | None = None) -> Document:
    """Return the row of a log that nothing has come of."""
    return dict.fromkeys(_LOG_COLUMNS) | {
        "name": log.name,
        "outcome": FAILED,
        "error": error,
        "method": log.method,
        "logs": [str(path) for path in log.logs],
        "missing": [],
        "findings": [],
    }
