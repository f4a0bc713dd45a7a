"""A fleet of logs: each calibrated as the command does, bad ones a row, goes on where it was stopped."""

import contextlib
import copy
import io
import json
import os
import shutil
import signal
import subprocess
import sys
import time
from importlib import resources
from pathlib import Path
from typing import NamedTuple

import jsonschema
import pyarrow.parquet as pq
import pytest
from campaign_support import (
    EXAMPLE,
    PLAN,
    calibrate_on_worker_or_die,
    calibrate_or_die,
    contents,
    files_no_larger_than,
)

import circlepoint as cp
from circlepoint.campaign.fleet_config import load_fleet
from circlepoint.cli import main


@pytest.fixture(scope="module")
def recorded(tmp_path_factory):
    """Two whole logs, one in which two joints never move alone, and one that is none."""
    root = tmp_path_factory.mktemp("fleet")
    (root / "plan.yaml").write_text(PLAN)
    (root / "part.yaml").write_text(PLAN.replace("joint: all", "joint: roll"))
    for number, (place, plan) in enumerate((("a", "plan"), ("b", "plan"), ("c", "part")), 1):
        (root / place).mkdir()
        shutil.copy(EXAMPLE / "arm.yaml", root / place / "arm.yaml")
        arguments = [str(root / f"{plan}.yaml"), "--arm", str(root / place / "arm.yaml"), "--sensor", "qa700"]
        assert main(["simulate", *arguments, "--out", str(root / place / "log.csv"), "--seed", str(number)]) == 0
    (root / "d").mkdir()
    shutil.copy(EXAMPLE / "arm.yaml", root / "d" / "arm.yaml")
    (root / "d" / "log.csv").write_text("t,colour\n0,red\n")
    return root


FLEET = 'fleet: {logs: "*/log.csv", arm: "{folder}/arm.yaml", name: "{parent}"}\nsensor: qa700\nmethod: joint\n'


@pytest.fixture
def fleet(recorded, tmp_path):
    root = tmp_path / "site"
    shutil.copytree(recorded, root, ignore=shutil.ignore_patterns("out"))
    path = root / "fleet.yaml"
    path.write_text(FLEET)
    return path


class Run(NamedTuple):
    out: Path
    status: int
    printed: str
    complaints: str


@pytest.fixture(scope="module")
def finished(recorded):
    """The whole fleet, calibrated one after the other; not to be changed."""
    (recorded / "fleet.yaml").write_text(FLEET)
    printed, complaints = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(complaints):
        status = run(recorded / "fleet.yaml", recorded / "out", "--workers", "1")
    return Run(recorded / "out", status, printed.getvalue(), complaints.getvalue())


def run(config, out, *options):
    return main(["campaign", str(config), "--out", str(out), *options])


def rows(out):
    return {row["name"]: row for row in pq.read_table(out / "fleet.parquet").to_pylist()}


def test_every_log_is_a_row_and_a_bad_one_does_not_stop_the_rest(finished):
    assert finished.status == 1
    assert "2 of 4 logs not whole: c, d" in finished.complaints
    found = rows(finished.out)
    assert [found[name]["outcome"] for name in "abcd"] == ["complete", "complete", "incomplete", "failed"]
    assert found["c"]["missing"] == ["pan", "tilt"]
    assert str(finished.out.parent / "d" / "log.csv") in found["d"]["error"]
    assert found["d"]["error"] in finished.printed
    assert 0.0 < found["a"]["end_point_rms"] < 1e-2
    assert 0.0 < found["a"]["point_difference"] < 1e-2
    joints = [
        (row["name"], row["joint"], row["reason"]) for row in pq.read_table(finished.out / "joints.parquet").to_pylist()
    ]
    assert joints[:4] == [("a", "pan", None), ("a", "tilt", None), ("a", "roll", None), ("b", "pan", None)]
    assert len(joints) == 9
    assert joints[6][2]
    assert not (finished.out / "results" / "d").exists()


def test_the_summary_follows_its_schema(finished):
    text = resources.files("circlepoint").joinpath("schema/fleet-summary-1.json").read_text(encoding="utf-8")
    schema = json.loads(text)
    jsonschema.Draft202012Validator.check_schema(schema)
    summary = json.loads((finished.out / "summary.json").read_text())
    assert [row["outcome"] for row in summary["logs"]] == ["complete", "complete", "incomplete", "failed"]
    jsonschema.validate(summary, schema)
    for row, field, wrong in ((0, "error", "none"), (0, "samples", None), (2, "missing", []), (3, "error", None)):
        other = copy.deepcopy(summary)
        other["logs"][row][field] = wrong
        with pytest.raises(jsonschema.ValidationError):
            jsonschema.validate(other, schema)
    described = schema["properties"]["logs"]["items"]["properties"]
    assert list(described) == pq.read_schema(finished.out / "fleet.parquet").names


def test_a_full_disk_ends_the_run_and_is_no_fault_of_the_logs(fleet, finished, tmp_path, capsys):
    out = tmp_path / "out"
    shutil.rmtree(fleet.parent / "b")
    shutil.rmtree(fleet.parent / "c")
    with files_no_larger_than(8192):
        assert run(fleet, out, "--workers", "1") == 2
    message = capsys.readouterr().err
    assert [word for word in (str(out), "File too large", "run it again") if word not in message] == []
    assert not list(out.rglob("*.parquet"))
    assert sorted(path.name for path in out.iterdir()) == [".lock", "campaign.json"]
    assert run(fleet, out, "--workers", "1") == 1
    assert [row["outcome"] for row in rows(out).values()] == ["complete", "failed"]
    names = sorted(path.name for path in (out / "results" / "a").iterdir())
    assert names == sorted(path.name for path in (finished.out / "results" / "a").iterdir())
    assert not (out / ".scratch").exists()


def test_an_interrupted_fleet_leaves_no_process_no_traceback_and_no_scratch(fleet, tmp_path):
    out = tmp_path / "out"
    # What a shell runs in the background ignores the signal, and so would its children.
    handler = signal.signal(signal.SIGINT, signal.default_int_handler)
    process = subprocess.Popen(
        [sys.executable, "-m", "circlepoint", "campaign", str(fleet), "--out", str(out), "--workers", "2"],
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        start_new_session=True,
    )
    signal.signal(signal.SIGINT, handler)
    deadline = time.monotonic() + 300.0
    while not (out / ".scratch").exists():
        assert process.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.002)
    time.sleep(0.3)  # into the start of the workers
    os.killpg(process.pid, signal.SIGINT)
    printed, _ = process.communicate(timeout=300.0)  # ends when no process has its end of the pipe any more
    assert printed == "circlepoint: interrupted; what is finished is kept, and the same command goes on with the rest\n"
    assert process.returncode == 130
    assert not (out / ".scratch").exists()


def test_a_log_that_kills_its_process_fails_alone_and_is_calibrated_again(fleet, tmp_path, monkeypatch):
    out = tmp_path / "out"
    shutil.rmtree(fleet.parent / "b")
    with monkeypatch.context() as patched:
        patched.setattr("circlepoint.campaign.fleet.calibrate_log", calibrate_or_die)
        assert run(fleet, out, "--workers", "2") == 1
    killed = rows(out)
    assert [killed[name]["outcome"] for name in "acd"] == ["complete", "incomplete", "failed"]
    assert "its process was killed" in killed["d"]["error"]
    kept = (out / "rows" / "a.json").stat().st_mtime_ns
    assert run(fleet, out) == 1
    assert "its process was killed" not in rows(out)["d"]["error"]
    assert (out / "rows" / "a.json").stat().st_mtime_ns == kept


def test_a_log_that_kills_its_workers_fails_alone_on_a_cluster(finished, recorded, tmp_path, scheduler, monkeypatch):
    out = tmp_path / "out"
    with monkeypatch.context() as patched:
        patched.setattr("circlepoint.campaign.fleet._on_worker", calibrate_on_worker_or_die)
        assert run(recorded / "fleet.yaml", out, "--scheduler", scheduler) == 1
    killed = rows(out)
    assert [killed[name]["outcome"] for name in "abcd"] == ["complete", "complete", "incomplete", "failed"]
    assert "every worker of the cluster that was given it was killed" in killed["d"]["error"]
    # Run again where it is not killed, it is as if there had been no cluster.
    assert run(recorded / "fleet.yaml", out, "--scheduler", scheduler) == 1
    assert contents(out) == contents(finished.out)


def test_a_result_is_that_of_the_command_calibrate(finished, recorded, tmp_path):
    site, alone = recorded / "b", tmp_path / "alone"
    options = ["--arm", str(site / "arm.yaml"), "--sensor", "qa700", "--method", "joint", "--out", str(alone)]
    assert main(["calibrate", str(site / "log.csv"), *options]) == 0
    result = finished.out / "results" / "b"
    ours, theirs = (
        {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
        for folder in (result, alone)
    )
    assert ours == theirs
    assert len(ours) > 3


def test_a_killed_fleet_goes_on_and_ends_with_the_same_tables(fleet, finished, tmp_path):
    out = tmp_path / "killed"
    shutil.rmtree(fleet.parent / "c")
    process = subprocess.Popen(
        [sys.executable, "-m", "circlepoint", "campaign", str(fleet), "--out", str(out), "--workers", "1"],
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    deadline = time.monotonic() + 300.0
    while not (out / "rows" / "a.json").exists():
        assert process.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.002)
    os.kill(process.pid, signal.SIGKILL)
    assert process.wait() == -signal.SIGKILL
    kept = (out / "rows" / "a.json").stat().st_mtime_ns
    assert not (out / "fleet.parquet").exists()
    assert run(fleet, out, "--workers", "2") == 1
    assert (out / "rows" / "a.json").stat().st_mtime_ns == kept
    again = [{**row, "logs": [], "error": None} for row in rows(out).values()]
    assert again == [{**row, "logs": [], "error": None} for name, row in rows(finished.out).items() if name != "c"]
    joints, theirs = (pq.read_table(folder / "joints.parquet").to_pylist() for folder in (out, finished.out))
    assert joints == theirs[:6]


def test_a_log_that_failed_is_calibrated_once_it_is_mended(fleet, tmp_path, capsys):
    out, site = tmp_path / "out", fleet.parent
    shutil.rmtree(site / "b")
    shutil.rmtree(site / "c")
    assert run(fleet, out, "--workers", "1") == 1
    kept = (out / "rows" / "a.json").stat().st_mtime_ns
    shutil.copy(site / "a" / "log.csv", site / "d" / "log.csv")
    capsys.readouterr()
    assert run(fleet, out, "--workers", "1", "--json") == 0
    summary = json.loads(capsys.readouterr().out)
    assert [row["name"] for row in summary["logs"]] == ["a", "d"]
    assert (summary["complete"], summary["incomplete"], summary["failed"]) == (2, 0, 0)
    assert (out / "rows" / "a.json").stat().st_mtime_ns == kept


def test_a_log_calibrated_otherwise_is_refused_by_its_field(finished, recorded, tmp_path, capsys):
    out = shutil.copytree(finished.out, tmp_path / "out")
    other = recorded / "other.yaml"
    other.write_text(FLEET.replace("method: joint", "method: velocity"))
    assert run(other, out) == 2
    message = capsys.readouterr().err
    assert "a: method: is not what it was" in message
    assert str(out / "rows" / "a.json") in message


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("fleet: []", ["fleet", "is empty"]),
        ("fleet: 3", ["fleet", "is 3", "give a list of logs"]),
        ("fleet: {arm: a/arm.yaml}", ["fleet.log", "needed"]),
        ("fleet: {log: a/log.csv}", ["fleet.arm", "missing"]),
        ('fleet: {logs: "*/log.bag", arm: a/arm.yaml}', ["fleet.logs", "no file matches"]),
        ('fleet: [{log: a/log.csv, arm: "{place}/arm.yaml"}]', ["line 1", "fleet[0].arm", "{place}", "{folder}"]),
        ('fleet: {logs: "?/log.csv", arm: a/arm.yaml, name: "{stem}"}', ["fleet.name", "'log'", "another log"]),
        ("fleet: {log: a/log.csv, arm: a/arm.yaml}\nmethod: guess", ["line 2", "method", "'guess'"]),
        ("fleet: {log: a/log.csv, arm: a/arm.yaml}\nsensor: qa7000", ["qa7000", "neither a preset nor a file"]),
        ("fleet: {log: a/log.csv, arm: a/arm.yaml}\ntrials: 3", ["trials", "unknown key"]),
    ],
)
def test_a_wrong_field_is_named_with_its_value_and_what_to_do(text, words, fleet):
    fleet.write_text(text + "\n")
    with pytest.raises(cp.InvalidInput) as caught:
        load_fleet(fleet)
    assert [word for word in words if word not in str(caught.value)] == []


def test_no_name_leads_out_of_the_folder_or_hides_in_it(fleet):
    fleet.write_text(
        "fleet:\n  - {log: ../away/log.csv, arm: a/arm.yaml}\n"
        '  - {log: ../log.csv, arm: a/arm.yaml, name: "{parent}"}\n'
    )
    names = [log.name for log in load_fleet(fleet).logs]
    assert not any(name.startswith(".") or "/" in name for name in names)


def test_a_log_that_is_not_there_is_a_row(fleet, tmp_path):
    fleet.write_text("fleet: {log: lost.csv, arm: a/arm.yaml}\n")
    assert run(fleet, tmp_path / "out", "--workers", "1") == 1
    found = rows(tmp_path / "out")
    assert found["lost"]["outcome"] == "failed"
    assert "lost.csv" in found["lost"]["error"]
