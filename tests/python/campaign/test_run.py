"""A campaign in its folder: the same bytes however it is run, stopped and gone on with."""

import json
import os
import shutil
import signal
import subprocess
import sys
import termios
import time

import numpy as np
import pyarrow.parquet as pq
import pytest
from campaign_support import EXAMPLE, contents, files_no_larger_than, table_of

import circlepoint as cp
from circlepoint.campaign.config import load_campaign
from circlepoint.campaign.run import run_campaign
from circlepoint.cli import main


def run(config, out, *options):
    return main(["campaign", str(config), "--out", str(out), *options])


@pytest.fixture
def whole(finished, tmp_path):
    return shutil.copytree(finished, tmp_path / "whole")


def test_workers_do_not_change_a_byte_and_a_pipe_is_told_nothing_on_the_way(config, whole, tmp_path, capsys):
    assert run(config, tmp_path / "more", "--workers", "3") == 0
    assert capsys.readouterr().err == ""
    assert contents(tmp_path / "more") == contents(whole)
    assert len(list(whole.rglob("*.parquet"))) == 4 * 2


def test_a_table_has_a_row_a_trial_with_errors_and_their_deviations(config, whole):
    campaign = load_campaign(config)
    joint = table_of(whole, 0)
    assert joint["trial"].to_pylist() == list(range(6))
    assert joint["outcome"].to_pylist() == ["complete"] * 6
    assert joint["seed"].to_pylist() == [s for b in campaign.batches() if b.cell == 0 for s in campaign.seeds(b)]
    for name in ("pan.d1", "tilt.p2", "roll.nees", "bias_x", "percussion_distance_z", "end_point"):
        assert joint[name].null_count == 0, name
        assert np.std(joint[name]) > 0.0, name
    # The paper's methods say nothing of the sensor.
    assert table_of(whole, 1)["bias_x"].null_count == 6


def test_a_row_is_what_the_trials_own_recording_gives(config, whole):
    cell = load_campaign(config).cells[0]
    row = table_of(whole, 0).to_pylist()[2]
    trial = cp.simulate_experiment(cell.experiment(), row["seed"])
    found = cp.calibrate_joints(trial.recording, cp.segment(trial.recording), cell.conditions().method)
    errors = cp.compare_lines(found, trial.chain)
    np.testing.assert_array_equal([row[f"tilt.{name}"] for name in ("d1", "d2", "p1", "p2")], errors[1].error)
    assert row["bias_y"] == found.sensor.sensor.bias[1] - trial.sensor.bias[1]


def test_a_campaign_that_was_killed_goes_on_and_ends_with_the_same_bytes(change, config, tmp_path):
    change("trials: 6", "trials: 40")
    change("{vibration: [0.0, 0.05]}", "{white: 0.02}")
    assert run(config, tmp_path / "whole") == 0
    out = tmp_path / "killed"
    command = [sys.executable, "-m", "circlepoint", "campaign", str(config), "--out", str(out)]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    deadline = time.monotonic() + 60.0
    while len(list(out.glob("trials/*/batch-*.parquet"))) < 3:
        assert process.poll() is None
        assert time.monotonic() < deadline
        time.sleep(0.002)
    os.kill(process.pid, signal.SIGKILL)
    assert process.wait() == -signal.SIGKILL
    process.stdout.close()
    process.stderr.close()
    kept = {path: path.stat().st_mtime_ns for path in out.glob("trials/*/batch-*.parquet")}
    assert 3 <= len(kept) < 20
    assert not (out / "summary.json").exists()
    assert run(config, out) == 0
    assert contents(out) == contents(tmp_path / "whole")
    assert {path: path.stat().st_mtime_ns for path in kept} == kept


def test_what_a_killed_process_was_writing_is_taken_away(config, whole):
    half = whole / "trials" / "cell-0000" / ".batch-000001.parquet.abc.parquet"
    half.write_bytes(b"PAR1")
    run_campaign(load_campaign(config), whole)
    assert not half.exists()


def test_a_finished_campaign_is_summed_up_again_and_nothing_run(config, whole, capsys):
    before = {path: path.stat().st_mtime_ns for path in whole.rglob("*.parquet")}
    capsys.readouterr()
    assert run(config, whole, "--json") == 0
    assert json.loads(capsys.readouterr().out) == json.loads((whole / "summary.json").read_text())
    assert {path: path.stat().st_mtime_ns for path in whole.rglob("*.parquet")} == before


def test_a_table_that_a_failing_disk_damaged_is_made_again(config, whole):
    before = contents(whole)
    path = whole / "trials" / "cell-0002" / "batch-000001.parquet"
    path.write_bytes(path.read_bytes()[:100])
    run_campaign(load_campaign(config), whole)
    assert contents(whole) == before


def test_a_full_disk_is_told_with_the_file_and_costs_the_batch_in_hand(config, finished, tmp_path, capsys):
    out = tmp_path / "out"
    with files_no_larger_than(8192):
        assert run(config, out) == 2
    message = capsys.readouterr().err
    words = (str(out / "trials" / "cell-0000" / "batch-000000.parquet"), "File too large", "run it again")
    assert [word for word in words if word not in message] == []
    assert not list(out.rglob("*.parquet"))
    assert run(config, out) == 0
    assert contents(out) == contents(finished)


def test_a_table_whose_inside_is_damaged_is_named(config, whole, capsys):
    path = whole / "trials" / "cell-0002" / "batch-000001.parquet"
    content = path.read_bytes()
    path.write_bytes(content[:4] + bytes(1000) + content[1004:])
    assert run(config, whole) == 2
    message = capsys.readouterr().err
    assert [word for word in (str(path), "take it away", "run the same command again") if word not in message] == []
    path.unlink()
    assert run(config, whole) == 0
    assert path.read_bytes() == content


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("seed: 3", "seed: 4", ["seed: ", "with 3, now it is 4"]),
        ("[0.0, 0.05]", "[0.0, 0.06]", ["noise.vibration[1]", "with 0.05, now it is 0.06"]),
        ("batch: 4\n", "", ["batch", "with 4, now it is nothing"]),
        ("batch: 4", "batch: 4\ngravity: 9.81", ["gravity", "with nothing, now it is 9.81"]),
    ],
)
def test_another_campaign_in_the_same_folder_is_refused_by_its_field(old, new, words, change, whole, capsys):  # noqa: PLR0917
    path = change(old, new)
    assert run(path, whole) == 2
    message = capsys.readouterr().err
    assert [word for word in [str(path), str(whole), *words] if word not in message] == []


def test_a_changed_file_that_the_campaign_names_is_refused(config, whole, capsys):
    plan = config.parent / "plan.yaml"
    plan.write_text(plan.read_text().replace("duration: 2", "duration: 4"))
    assert run(config, whole) == 2
    assert "plan.yaml: is not what it was" in capsys.readouterr().err


def test_results_of_another_version_are_not_mixed(config, whole, capsys):
    description = whole / "campaign.json"
    content = json.loads(description.read_text())
    description.write_text(json.dumps({**content, "version": "0.0.1"}))
    assert run(config, whole) == 2
    assert "circlepoint 0.0.1" in capsys.readouterr().err


def test_a_folder_of_other_things_is_refused(config, tmp_path, capsys):
    (tmp_path / "photographs").mkdir()
    (tmp_path / "photographs" / "one.png").write_bytes(b"")
    assert run(config, tmp_path / "photographs") == 2
    assert "one.png" in capsys.readouterr().err


def test_two_processes_do_not_write_to_one_folder(change, config, tmp_path):
    change("trials: 6", "trials: 1")
    campaign = load_campaign(config)
    refused = []

    class Second:
        def begin(self, _total, _finished):
            with pytest.raises(cp.InvalidInput, match=f"process {os.getpid()}") as caught:
                run_campaign(campaign, tmp_path / "out")
            refused.append(caught.value)

        def advance(self, _trials):
            pass

    run_campaign(campaign, tmp_path / "out", watcher=Second())
    assert len(refused) == 1


def test_progress_counts_every_trial_and_what_was_finished_before(config, tmp_path):
    class Watcher:
        told = ()
        done = 0

        def begin(self, total, finished):
            self.told = (total, finished)

        def advance(self, trials):
            self.done += trials

    first, second = Watcher(), Watcher()
    run_campaign(load_campaign(config), tmp_path / "out", workers=2, watcher=first)
    assert (first.told, first.done) == ((24, 0), 24)
    (tmp_path / "out" / "trials" / "cell-0001" / "batch-000001.parquet").unlink()
    run_campaign(load_campaign(config), tmp_path / "out", watcher=second)
    assert (second.told, second.done) == ((24, 22), 2)


def test_an_interrupted_campaign_stops_and_goes_on(config, tmp_path):
    class Interrupter:
        def begin(self, _total, _finished):
            pass

        def advance(self, _trials):
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_campaign(load_campaign(config), tmp_path / "out", workers=2, watcher=Interrupter())
    assert len(run_campaign(load_campaign(config), tmp_path / "out")["cells"]) == 4


def test_a_terminal_shows_rate_and_time_left(change, config, tmp_path):
    change("trials: 6", "trials: 10")
    parent, child = os.openpty()
    termios.tcsetwinsize(child, (24, 80))
    command = [sys.executable, "-m", "circlepoint", "campaign", str(config), "--out"]
    shown = subprocess.Popen([*command, str(tmp_path / "shown")], stdout=subprocess.DEVNULL, stderr=child)
    os.close(child)
    text = b""
    while True:
        try:
            part = os.read(parent, 4096)
        except OSError:
            break
        if not part:
            break
        text += part
    os.close(parent)
    assert shown.wait() == 0
    assert b"of 40 trials" in text
    assert b"/s" in text
    assert b"left" in text


def test_the_example_runs_and_its_table_has_a_row_a_cell(tmp_path, capsys):
    assert run(EXAMPLE / "campaign.yaml", tmp_path / "out") == 0
    printed = capsys.readouterr().out
    rows = [line for line in printed.splitlines() if line.startswith("white")]
    assert [row.split("  ")[0] for row in rows] == [
        "white 0.01, vibration 0, joint",
        "white 0.01, vibration 0, velocity",
        "white 0.01, vibration 0.1, joint",
        "white 0.01, vibration 0.1, velocity",
    ]
    title = printed.splitlines()[1].split()
    assert title == [
        "noise,",
        "method",
        "trials",
        *["rmse", "predicted"],
        *["rmse", "predicted", "bias"] * 2,
        "68",
        "95",
        "lines",
    ]
    assert (tmp_path / "out" / "summary.png").read_bytes().startswith(b"\x89PNG")
    assert pq.read_metadata(tmp_path / "out" / "trials" / "cell-0003" / "batch-000001.parquet").num_rows == 10
