"""`circlepoint simulate`: a recording that reads back, with its ground truth beside it."""

import json

import numpy as np
import pytest
from arm_files import TWO_TURNS

from circlepoint.arm import load_arm
from circlepoint.cli import main
from circlepoint.recording_io import read_recording

PLAN = """\
rate_hz: 100
rest_deg: 20
tests:
  - joint: all
    static: {steps: 4, span_deg: 60, dwell: 0.8, move: 0.6}
    dynamic: {frequency_hz: 0.5, span_deg: 60, duration: 2}
"""


@pytest.fixture
def arguments(tmp_path):
    (tmp_path / "arm.yaml").write_text(TWO_TURNS)
    (tmp_path / "plan.yaml").write_text(PLAN)
    return ["simulate", str(tmp_path / "plan.yaml"), "--arm", str(tmp_path / "arm.yaml"), "--sensor", "ideal"]


@pytest.mark.parametrize("name", ["log.csv", "log.csv.gz", "log.parquet"])
def test_the_recording_reads_back_with_its_truth_beside_it(name, arguments, tmp_path, capsys):
    assert main([*arguments, "--out", str(tmp_path / name), "--seed", "1"]) == 0
    assert name in capsys.readouterr().out
    recording = read_recording(tmp_path / name, load_arm(tmp_path / "arm.yaml")).recording
    truth = json.loads((tmp_path / "log.truth.json").read_text())
    np.testing.assert_allclose(truth["gravity_sensor"], recording.specific_force[0], atol=1e-3)
    pan, tilt = truth["joints"]
    np.testing.assert_allclose(pan["direction_sensor"], np.array(truth["gravity_sensor"]) / 9.80665, atol=1e-9)
    np.testing.assert_allclose(tilt["direction_sensor"], [0.0, 0.0, 1.0], atol=1e-9)
    np.testing.assert_allclose(tilt["point_sensor"], [-0.25, 0.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(truth["reference_configuration"], np.radians([20.0, 20.0]))


def test_the_same_seed_gives_the_same_bytes_and_another_seed_another_sensor(arguments, tmp_path):
    arguments[-1] = "mems"
    written = []
    for name, seed in (("a.csv", "1"), ("b.csv", "1"), ("c.csv", "2")):
        assert main([*arguments, "--out", str(tmp_path / name), "--seed", seed]) == 0
        written.append((tmp_path / name).read_bytes())
    assert written[0] == written[1]
    assert written[0] != written[2]


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"--out": "log.txt"}, ["log.txt", ".csv"]),
        ({"--sensor": "unheard-of"}, ["unheard-of"]),
        ({"--arm": "bare.yaml"}, ["bare.yaml", "`dh`"]),
    ],
)
def test_what_cannot_be_simulated_is_refused(change, words, arguments, tmp_path, capsys):
    (tmp_path / "bare.yaml").write_text(TWO_TURNS[: TWO_TURNS.index("dh:")])
    options = {"--arm": "arm.yaml", "--sensor": "ideal", "--out": "log.csv", "--seed": "1", **change}
    for key in ("--arm", "--out"):
        options[key] = str(tmp_path / options[key])
    before = sorted(tmp_path.iterdir())
    assert main([*arguments[:2], *(word for pair in options.items() for word in pair)]) == 2
    message = capsys.readouterr().err
    for word in words:
        assert word in message
    assert sorted(tmp_path.iterdir()) == before
