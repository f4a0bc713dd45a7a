"""What a campaign's file may say, and what is told of a wrong one."""

import numpy as np
import pytest
from campaign_support import EXAMPLE

import circlepoint as cp
from circlepoint.campaign.config import load_campaign


def test_the_grid_is_the_product_of_what_is_swept_with_the_method_fastest(config):
    cells = load_campaign(config).cells
    assert [(cell.labels["noise"], cell.labels["method"]) for cell in cells] == [
        ("vibration 0", "joint"),
        ("vibration 0", "velocity"),
        ("vibration 0.05", "joint"),
        ("vibration 0.05", "velocity"),
    ]


def test_methods_see_the_same_recordings_and_other_cells_do_not(config):
    campaign = load_campaign(config)
    first = {batch.cell: campaign.seeds(batch) for batch in campaign.batches() if batch.index == 0}
    assert first[0] == first[1]
    assert first[2] == first[3]
    assert set(first[0]).isdisjoint(first[2])
    parent = cp.derive_seed(3, 1)
    assert first[2] == [cp.derive_seed(parent, trial) for trial in range(4)]


def test_a_trials_seed_does_not_depend_on_how_trials_are_batched(change, config):
    def seeds(campaign):
        return [seed for batch in campaign.batches() if batch.cell == 0 for seed in campaign.seeds(batch)]

    assert seeds(load_campaign(config)) == seeds(load_campaign(change("batch: 4", "batch: 5")))


def test_everything_may_be_swept_and_repeated_names_are_numbered(change, config):
    change("arm: {file: arm.yaml, up: [0.4, -0.3, 0.8]}", "arm: [arm.yaml, {file: arm.yaml, up: [1, 0, 0]}, sarcos]")
    change("sensor: qa700", "sensor: [qa700, mems]")
    change("plan: plan.yaml", "plan: [plan.yaml, paper]")
    change("{vibration: [0.0, 0.05]}", "[{name: quiet}, {white: [0.01, 0.02], encoder_counts: [0, 4096]}]")
    change("[joint, velocity]", "[joint, {name: whole-arm, sensor: unspecified}]")
    cells = load_campaign(config).cells
    assert len(cells) == 3 * 2 * 2 * 5 * 2
    assert list(dict.fromkeys(cell.labels["arm"] for cell in cells)) == ["arm (1)", "arm (2)", "sarcos"]
    assert list(dict.fromkeys(cell.labels["noise"] for cell in cells)) == [
        "quiet",
        "white 0.01, exact encoders",
        "white 0.01, 4096 counts",
        "white 0.02, exact encoders",
        "white 0.02, 4096 counts",
    ]
    assert cells[1].labels["method"] == "whole-arm, sensor unspecified"
    assert cells[1].told_sensor is None
    assert cells[2].arm.encoder_counts is None
    assert cells[4].arm.encoder_counts == (4096.0,) * 3


def test_what_is_set_reaches_the_simulation(change, config):
    change(
        "up: [0.4, -0.3, 0.8]", "up: [0, 0, 2], tool: {xyz: [0.1, 0, 0.2]}, built: {point_std: 0.002}, compliance: 1e-4"
    )
    change("{vibration: [0.0, 0.05]}", "{white: 0.03, vibration: {tangential: 0.2, orthogonal: 0.1, to_hz: 40}}")
    config.write_text(config.read_text() + "gravity: 9.81\n")
    cell = load_campaign(config).cells[0]
    experiment = cell.experiment()
    assert np.linalg.norm(experiment.up_gravity_sensor) == pytest.approx(9.81)
    assert experiment.point_std == 0.002
    assert experiment.direction_std == 0.0
    assert experiment.simulation.noise_std == 0.03
    assert experiment.simulation.vibration.tangential_amplitude == 0.2
    assert experiment.simulation.vibration.orthogonal_amplitude == 0.1
    assert experiment.simulation.vibration.frequency_max == 40.0
    np.testing.assert_allclose(experiment.simulation.compliance, [1e-4] * 3)
    np.testing.assert_allclose(experiment.start_spread, [2 * np.pi / 400_000] * 3)
    np.testing.assert_allclose(experiment.chain.home, np.eye(4), atol=1e-12)
    plain = cp.to_screws(
        cp.StandardDhChain(
            [cp.DhRow(r.a, r.alpha, r.d, r.theta) for r in cell.arm.dh.rows], [cp.JointType.revolute] * 3
        ),
        cell.plan.rest,
        cp.BaseFrame.sensor_at_reference,
    )
    # The last axis as the flange sees it, seen from 0.1 m and 0.2 m further.
    moved = plain.axes[2].line.point - np.array([0.1, 0.0, 0.2])
    expected = cp.make_line(plain.axes[2].line.direction, moved)
    np.testing.assert_allclose(experiment.chain.axes[2].line.point, expected.point, atol=1e-12)


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("trials: 6", "trials: none", ["line 6", "trials", "'none'", "whole number"]),
        ("trials: 6", "trials: 1e3", ["line 6", "trials", "'1e3'", "write 1000"]),
        ("trials: 6", "trials: 20.0", ["trials", "is 20.0", "write 20"]),
        ("trials: 6", "trials: 6\ntrials: 7", ["line 7: trials: was given on line 6 already"]),
        ("trials: 6", "trails: 6", ["trails", "unknown key", "trials"]),
        ("seed: 3\n", "", ["seed", "missing"]),
        ("seed: 3", "seed: 18446744073709551616", ["seed", "2^64"]),
        ("batch: 4", "batch: 0", ["batch", "is 0", "at least 1"]),
        ("sensor: qa700", "sensor: [qa700, qa7000]", ["line 2", "sensor[1]", "qa7000", "mems", "there is no"]),
        ("file: arm.yaml", "file: leg.yaml", ["arm", "leg.yaml", "sarcos"]),
        ("plan: plan.yaml", "plan: []", ["plan", "empty list"]),
        ("[joint, velocity]", "[joint, guess]", ["method[1]", "'guess'", "whole-arm, joint, position, velocity"]),
        ("[joint, velocity]", "{name: joint, prior: none}", ["method.prior", "unknown key"]),
        ("[0.0, 0.05]", "[0.0, -0.05]", ["noise.vibration", "-0.05", "at least 0"]),
        ("{vibration: [0.0, 0.05]}", "{vibrations: 0.1}", ["noise.vibrations", "unknown key"]),
        (
            "{vibration: [0.0, 0.05]}",
            "{vibration: {tangential: 0.1, to_hz: 70}}",
            ["70.0", "125.0", "half the sample rate"],
        ),
        ("up: [0.4, -0.3, 0.8]", "up: [0, 0, 0]", ["arm.up", "zero"]),
        ("up: [0.4, -0.3, 0.8]", "up: [0, 1]", ["arm.up", "three numbers"]),
        ("up: [0.4, -0.3, 0.8]", "built: {length: 1}", ["arm.built.length", "unknown key"]),
    ],
)
def test_a_wrong_field_is_named_with_its_value_and_what_to_do(old, new, words, change):
    path = change(old, new)
    with pytest.raises(cp.InvalidInput) as caught:
        load_campaign(path)
    message = str(caught.value)
    assert message.startswith(str(path))
    assert [word for word in words if word not in message] == []


def test_an_arm_without_nominal_parameters_cannot_be_simulated(config):
    arm = config.parent / "arm.yaml"
    arm.write_text(arm.read_text().partition("dh:")[0])
    with pytest.raises(cp.InvalidInput, match=r"arm: is 'arm.yaml', which has no `dh` or `lines`"):
        load_campaign(config)


def test_the_page_shows_the_example():
    page = (EXAMPLE.parents[1] / "docs" / "campaigns.md").read_text(encoding="utf-8")
    assert f"```yaml\n{(EXAMPLE / 'campaign.yaml').read_text(encoding='utf-8')}```" in page
