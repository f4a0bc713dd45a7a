"""The simulator against a physics engine, SciPy and its own promises."""

import mujoco
import numpy as np
import pytest
from scipy import signal, stats

import circlepoint as cp

UP = np.array([1.2, -3.1, 9.2])


def random_lines(joints, seed):
    random = np.random.default_rng(seed)
    return [
        (direction / np.linalg.norm(direction), point)
        for direction, point in zip(random.normal(size=(joints, 3)), random.normal(0, 0.3, (joints, 3)), strict=True)
    ]


def screw_chain(lines, types=None):
    axes = [
        cp.ScrewAxis(type=getattr(cp.JointType, kind), line=cp.make_line(direction, point))
        for (direction, point), kind in zip(lines, types or ["revolute"] * len(lines), strict=True)
    ]
    return cp.ScrewChain(axes=axes, reference_configuration=np.zeros(len(lines)))


def free_motion(joints, duration=10.0, rate=250.0, seed=0):
    motion = cp.MultiJointMotion(duration=duration, amplitude=np.full(joints, 1.2), seed=seed)
    return cp.joint_trajectory(np.zeros(joints), [motion], rate)


def mujoco_accelerometer(lines, types, trajectory):
    """Readings of the engine's own accelerometer at the world origin of the reference configuration."""
    body = '<site name="sensor" pos="0 0 0"/><geom size="0.01" mass="1" pos="0.05 0 0"/>'
    for (direction, point), kind in reversed(list(zip(lines, types, strict=True))):
        joint = {"revolute": "hinge", "prismatic": "slide"}[kind]
        numbers = [" ".join(f"{x:.17g}" for x in v) for v in (point, direction)]
        hinge = f'<joint type="{joint}" pos="{numbers[0]}" axis="{numbers[1]}"/>'
        body = f'<body>{hinge}<geom size="0.01" mass="1"/>{body}</body>'
    gravity = " ".join(f"{-x:.17g}" for x in UP)
    model = mujoco.MjModel.from_xml_string(
        f'<mujoco><option gravity="{gravity}"><flag contact="disable"/></option><worldbody>{body}</worldbody>'
        '<sensor><accelerometer site="sensor"/></sensor></mujoco>'
    )
    data = mujoco.MjData(model)
    readings = np.empty((trajectory.samples, 3))
    for i in range(trajectory.samples):
        data.qpos[:] = trajectory.position[i]
        data.qvel[:] = trajectory.velocity[i]
        data.qacc[:] = trajectory.acceleration[i]
        mujoco.mj_inverse(model, data)
        readings[i] = data.sensordata
    return readings


@pytest.mark.parametrize(
    "types", [["revolute"] * 7, ["revolute", "prismatic", "revolute", "revolute", "prismatic"]], ids=["7R", "RPRRP"]
)
def test_an_ideal_sensor_reads_what_a_physics_engines_accelerometer_reads(types):
    lines = random_lines(len(types), seed=3)
    trajectory = free_motion(len(types), duration=4.0)
    recording = cp.simulate(screw_chain(lines, types), UP, cp.AccelerometerModel(), trajectory)
    expected = mujoco_accelerometer(lines, types, trajectory)
    assert np.ptp(expected) > 5.0
    np.testing.assert_allclose(recording.specific_force, expected, rtol=0, atol=1e-9)


def test_the_same_seed_gives_the_same_bytes_and_another_seed_does_not():
    chain, trajectory = screw_chain(random_lines(4, seed=1)), free_motion(4)

    def recorded(seed):
        vibration = cp.VibrationOptions(tangential_amplitude=0.1, orthogonal_amplitude=0.01)
        options = cp.SimulationOptions(noise_std=1e-3, vibration=vibration, seed=seed)
        return cp.simulate(chain, UP, cp.AccelerometerModel(), trajectory, options).specific_force.tobytes()

    assert recorded(7) == recorded(7)
    assert recorded(7) != recorded(8)


def test_noise_is_white_and_normal_with_the_stated_deviation():
    chain = screw_chain(random_lines(2, seed=1))
    rest = cp.static_poses(np.zeros((20000, 2)))
    recording = cp.simulate(chain, UP, cp.AccelerometerModel(), rest, cp.SimulationOptions(noise_std=0.02, seed=4))
    noise = (recording.specific_force - UP).ravel() / 0.02
    assert stats.kstest(noise, "norm").pvalue > 1e-3
    lagged = np.corrcoef(noise[:-1], noise[1:])[0, 1]
    assert abs(lagged) < 4 / np.sqrt(noise.size)


def test_encoders_are_within_half_a_count_of_a_turn_or_a_metre():
    types = ["revolute", "prismatic", "revolute"]
    chain, trajectory = screw_chain(random_lines(3, seed=2), types), free_motion(3)
    options = cp.SimulationOptions(encoder_counts_per_revolution=[4096, 4096, 0])
    recording = cp.simulate(chain, UP, cp.AccelerometerModel(), trajectory, options)
    count = 2 * np.pi / 4096
    error = recording.joint_positions - trajectory.position
    assert 0.49 * count < np.abs(error[:, 0]).max() <= 0.5 * count * (1 + 1e-9)
    counts = recording.joint_positions[:, 0] / count
    np.testing.assert_allclose(counts, np.round(counts), rtol=0, atol=1e-9)
    assert 0.49 / 4096 < np.abs(error[:, 1]).max() <= 0.5 / 4096 * (1 + 1e-9)
    assert not error[:, 2].any()


def test_vibration_has_the_stated_amplitudes_directions_and_band_and_stops_with_the_arm():
    # One vertical axis 0.4 m along x from the sensor: the sensor moves along y.
    chain = screw_chain([(np.array([0.0, 0.0, 1.0]), np.array([0.4, 0.0, 0.0]))])
    pieces = [cp.Dwell(2.0), cp.RaisedCosine(joint=0, span=2.0, duration=60.0), cp.Dwell(2.0)]
    trajectory = cp.joint_trajectory(np.zeros(1), pieces, 500.0)
    ideal = cp.simulate(chain, UP, cp.AccelerometerModel(), trajectory)
    vibration = cp.VibrationOptions(
        tangential_amplitude=0.1, orthogonal_amplitude=0.01, frequency_min=15.0, frequency_max=40.0
    )
    options = cp.SimulationOptions(vibration=vibration, seed=2)
    shaken = cp.simulate(chain, UP, cp.AccelerometerModel(), trajectory, options)
    added = shaken.specific_force - ideal.specific_force
    moving = (trajectory.time > 2.0) & (trajectory.time < 62.0)
    assert not added[~moving].any()
    rms = np.sqrt(np.mean(added[moving] ** 2, axis=0)) * np.sqrt(2.0)
    np.testing.assert_allclose(sorted(rms), [0.01, 0.01, 0.1], rtol=0.02)
    assert np.argmax(rms) == 1
    frequency, power = signal.welch(added[moving], fs=500.0, nperseg=5000, axis=0)
    band = (frequency > 14.5) & (frequency < 40.5)
    assert (power[~band].sum(axis=0) < 1e-3 * power[band].sum(axis=0)).all()


def test_readings_clip_at_the_range_and_drift_reaches_its_stated_end():
    chain = screw_chain(random_lines(1, seed=2))
    rest = cp.static_poses(np.zeros((11, 1)))
    options = cp.SimulationOptions(range=9.0, bias_drift=[0.1, 0.0, 0.0])
    recording = cp.simulate(chain, UP, cp.AccelerometerModel(), rest, options)
    np.testing.assert_allclose(recording.specific_force[:, 0], UP[0] + np.linspace(0, 0.1, 11), rtol=0, atol=1e-12)
    assert (recording.specific_force[:, 2] == 9.0).all()


def test_the_sensors_errors_are_those_of_its_model():
    chain, trajectory = screw_chain(random_lines(1, seed=5)), free_motion(1)
    direction = random_lines(1, seed=5)[0][0]
    kind = cp.AccelerometerSpecification(
        bias_std=0.05, scale_std=0.01, misalignment_std=0.01, percussion_distance_std=0.02
    )
    sensor = cp.draw_accelerometer(kind, seed=3)
    ideal = cp.simulate(chain, UP, cp.AccelerometerModel(), trajectory)
    real = cp.simulate(chain, UP, sensor, trajectory)
    angular_velocity = trajectory.velocity * direction
    corrected = cp.correct(sensor, real.specific_force, angular_velocity)
    np.testing.assert_allclose(corrected, ideal.specific_force, rtol=0, atol=1e-12)


@pytest.mark.parametrize(
    ("options", "named"),
    [
        ({"noise_std": -1.0}, "noise_std"),
        ({"encoder_counts_per_revolution": [1.0, 2.0]}, "encoder_counts_per_revolution has 2"),
        ({"compliance": [np.nan]}, "compliance"),
        ({"vibration": cp.VibrationOptions(tangential_amplitude=1.0, frequency_max=200.0)}, "half the sample rate"),
    ],
)
def test_an_impossible_option_is_named(options, named):
    chain, trajectory = screw_chain(random_lines(1, seed=2)), free_motion(1, duration=4.0)
    with pytest.raises(cp.InvalidInput, match=named):
        cp.simulate(chain, UP, cp.AccelerometerModel(), trajectory, cp.SimulationOptions(**options))
