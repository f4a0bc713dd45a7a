"""The command: help, status, and what it says of whole recordings."""

import json
import subprocess
import sys

import numpy as np
import pytest

from circlepoint.cli import check, main


@pytest.fixture
def still_log(tmp_path):
    """A two-joint arm that never moves."""
    (tmp_path / "arm.yaml").write_text(
        "name: two\njoints:\n  - {name: pan, type: revolute}\n  - {name: tilt, type: revolute}\n"
    )
    generator = np.random.default_rng(1)
    lines = ["t,q1,q2,ax,ay,az"]
    for index in range(400):
        x, y, z = generator.normal([0.0, 0.0, 9.80665], 0.01)
        lines.append(f"{index / 100:.2f},0.5,0.25,{x:.6f},{y:.6f},{z:.6f}")
    (tmp_path / "log.csv").write_text("\n".join(lines) + "\n")
    return [str(tmp_path / "log.csv"), "--arm", str(tmp_path / "arm.yaml")]


@pytest.mark.parametrize("command", ["demo", "calibrate", "check", "simulate", "campaign"])
def test_every_command_has_help_with_examples(command, capsys):
    assert main([command, "--help"]) == 0
    printed = capsys.readouterr().out
    assert "examples:" in printed
    assert f"circlepoint {command}" in printed


def test_the_command_lists_its_commands_and_what_the_status_means(capsys):
    assert main(["--help"]) == 0
    printed = capsys.readouterr().out
    for word in ("demo", "calibrate", "check", "simulate", "exit status"):
        assert word in printed


@pytest.mark.parametrize(
    "arguments",
    [
        [],
        ["calibrate"],
        ["unheard-of"],
        ["check", "log.csv", "--arm", "arm.yaml", "--gravity", "-1"],
        ["check", "log.csv", "--arm", "arm.yaml", "--gravity", "strong"],
        ["calibrate", "log.csv", "--arm", "a", "--out", "r", "--method", "guess"],
        ["calibrate", "log.csv", "--arm", "a", "--out", "r", "--reference-configuration", "1,x"],
        ["calibrate", "log.csv", "--arm", "a", "--out", "r", "--parameter", "colour=free"],
        ["calibrate", "log.csv", "--arm", "a", "--out", "r", "--parameter", "scale=-1"],
        ["simulate", "plan.yaml", "--arm", "a", "--sensor", "ideal", "--out", "log.csv", "--seed", "-1"],
    ],
)
def test_wrong_arguments_end_with_status_2(arguments, capsys):
    assert main(arguments) == 2
    assert "usage:" in capsys.readouterr().err


def test_a_log_without_tests_says_what_to_record_of_which_joint(still_log, capsys):
    assert main(["check", *still_log]) == 1
    printed = capsys.readouterr().out
    assert "calibrate (whole-arm): cannot tell the sensor's errors from the arm's" in printed
    assert "--method joint, position, velocity: cannot find any of the 2 joints" in printed
    assert "every joint: it does not move: move it over 60 deg or more" in printed
    assert "for --method joint: every joint: no test of it alone" in printed
    assert "move it alone to and fro" in printed


def test_check_answers_programs_in_json(still_log, capsys):
    assert main(["check", *still_log, "--json"]) == 1
    answer = json.loads(capsys.readouterr().out)
    assert not answer["ready"]
    assert [joint["status"] for joint in answer["joints"]] == ["missing", "missing"]
    assert answer["sample_rate"] == pytest.approx(100.0)
    assert answer["files"][0]["samples"] == 400


def test_an_interrupt_ends_with_status_130(still_log, monkeypatch, capsys):
    def interrupt(*_, **__):
        raise KeyboardInterrupt

    monkeypatch.setattr(check, "arm_of", interrupt)
    assert main(["check", *still_log]) == 130
    assert "interrupted" in capsys.readouterr().err


def test_a_fault_of_the_program_asks_to_be_reported_and_shows_where_only_on_request(still_log, monkeypatch, capsys):
    def fail(*_, **__):
        raise ZeroDivisionError("by nothing")

    monkeypatch.setattr(check, "arm_of", fail)
    assert main(["check", *still_log]) == 2
    message = capsys.readouterr().err
    assert "please report it: ZeroDivisionError: by nothing" in message
    assert "Traceback" not in message
    assert main(["check", *still_log, "--debug"]) == 2
    assert "Traceback" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("folder", "missing"),
    [
        ("physics-arm7-sweeps-qa700", []),
        ("physics-arm6-sweeps-mems", []),
        ("physics-arm7-sweeps-coarse", []),
        ("physics-arm6-free-qa700", [f"joint{i + 1}" for i in range(6)]),
    ],
)
def test_check_finds_every_joints_tests_where_there_are_some(folder, missing, shared_data, capsys):
    folder = shared_data / folder
    assert main(["check", str(folder / "log.csv"), "--arm", str(folder / "arm.yaml"), "--json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert [joint["name"] for joint in answer["joints"] if joint["status"] == "missing"] == missing
    assert {joint["whole_arm"] for joint in answer["joints"]} == {"good"}
    assert answer["ready_alone"] == (not missing)
    if not missing:
        for joint in answer["joints"]:
            assert joint["frequency"] == pytest.approx(0.5, rel=0.1)


def test_check_says_that_joints_which_only_move_in_step_cannot_be_told_apart(shared_data, capsys):
    folder = shared_data / "real-ur5-imu-8"
    logs = [str(folder / "joints.csv"), str(folder / "sensor.csv")]
    assert main(["check", *logs, "--arm", str(folder / "arm.yaml")]) == 1
    printed = capsys.readouterr().out
    assert "every joint: they only move in step with one another" in printed
    assert "calibrate (whole-arm): cannot find any of the 6 joints" in printed
    assert len(printed.splitlines()) < 45


def test_check_names_the_joints_a_real_log_does_not_test(shared_data, capsys):
    folder = shared_data / "real-ur5-imu-6"
    logs = [str(folder / "joints.csv"), str(folder / "sensor.csv")]
    assert main(["check", *logs, "--arm", str(folder / "arm.yaml"), "--json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert not answer["ready_alone"]
    status = {joint["name"]: joint["status"] for joint in answer["joints"]}
    assert status["wrist_3_joint"] != "missing"
    assert status["shoulder_pan_joint"] != "missing"
    assert status["elbow_joint"] == "missing"
    assert len(answer["clocks"]) == 1


def test_the_module_is_the_command(still_log):
    done = subprocess.run(
        [sys.executable, "-m", "circlepoint", "check", *still_log], capture_output=True, text=True, check=False
    )
    assert done.returncode == 1
    assert "cannot find any of the 2 joints" in done.stdout
    assert not done.stderr


def test_a_closed_pipe_is_no_failure(still_log):
    command = [sys.executable, "-m", "circlepoint", "check", *still_log]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        process.stdout.close()
        message = process.stderr.read()
        assert process.wait() == 141
    assert not message
