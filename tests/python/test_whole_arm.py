"""The whole-arm estimate: any motion, every unknown, an honest account of what the data show."""

import numpy as np
import pytest
from scipy.interpolate import CubicSpline
from whole_arm_support import (
    LINES,
    RATE,
    REVOLUTE,
    START,
    UP,
    assert_found,
    chain_of,
    errors_and_std,
    estimate,
    free,
    recorded,
    sweeps_of,
    value,
)

import circlepoint as cp
from circlepoint.sensor_presets import load_sensor


@pytest.mark.parametrize("pieces", [sweeps_of(), free()], ids=["tests", "all joints at once"])
def test_every_line_is_found_from_tests_and_from_free_motion_without_a_nominal_arm(pieces):
    result = estimate(recorded(pieces))
    assert result.converged
    assert_found(result, chain_of(LINES))
    assert result.rank == len(result.parameters)


def test_single_joint_statistics_and_the_general_model_agree():
    recording = recorded(sweeps_of())
    options = cp.JointCalibrationOptions()
    options.sensor = load_sensor("qa700")
    options.reference_configuration = START
    alone = cp.calibrate_joints(recording, cp.segment(recording), options)
    whole = estimate(recording)
    for one, all_of_them in zip(alone.joints, whole.joints.joints, strict=True):
        difference = cp.local_coordinates(one.axis.screw.line, all_of_them.axis.screw.line)
        std = np.sqrt(np.diag(one.axis.covariance) + np.diag(all_of_them.axis.covariance))
        assert np.abs(difference / std).max() < 4.5


def test_the_result_does_not_depend_on_the_number_of_threads():
    recording = recorded(free(20.0))
    one, four = estimate(recording, threads=1), estimate(recording, threads=4)
    np.testing.assert_array_equal(one.covariance, four.covariance)
    assert [p.value for p in one.parameters] == [p.value for p in four.parameters]


def test_a_delay_of_the_sensor_is_found():
    recording = recorded(free())
    late = 0.002
    shifted = cp.make_recording(
        recording.time,
        np.ascontiguousarray(
            np.stack(
                [np.interp(recording.time + late, recording.time, q) for q in np.asarray(recording.joint_positions).T],
                axis=1,
            )
        ),
        recording.specific_force,
    )
    result = estimate(shifted, clock_offset=cp.ParameterTreatment(std=0.01))
    assert value(result, "clock_offset").value == pytest.approx(late, abs=2e-5)
    assert_found(result, chain_of(LINES), 1e-3)


def test_jittered_stamps_cost_nothing():
    fine = recorded(sweeps_of(), noise=0.0, rate=1000.0)
    random = np.random.default_rng(2)
    time = np.sort(np.arange(0.01, fine.time[-1] - 0.01, 0.005))
    time = np.sort(time + 5e-4 * random.standard_normal(time.size))
    positions = CubicSpline(fine.time, fine.joint_positions)(time)
    force = CubicSpline(fine.time, fine.specific_force)(time) + 0.005 * random.standard_normal((time.size, 3))
    assert_found(estimate(cp.make_recording(time, positions, force)), chain_of(LINES))


def test_a_scale_error_of_three_percent_is_found():
    sensor = cp.AccelerometerModel(scale=[0.03, -0.01, 0.02])
    result = estimate(
        recorded(sweeps_of(), sensor=sensor),
        sensor="ideal",
        scale=cp.ParameterTreatment(),
        bias=cp.ParameterTreatment(),
    )
    found = [value(result, f"scale_{axis}").value for axis in "xyz"]
    np.testing.assert_allclose(found, [0.03, -0.01, 0.02], atol=1e-4)
    assert_found(result, chain_of(LINES), 3e-4)


def test_a_vertical_base_joint_is_found_where_the_others_tilt_the_sensor():
    up = cp.STANDARD_GRAVITY * np.array([0.0, 0.0, 1.0])
    lines = [([0.0, 0.0, 1.0], [0.1, 0.5, -0.3]), *LINES[1:]]
    lines[1] = ([0.0, 1.0, 0.1], [-0.4, 0.1, 0.1])
    result = estimate(recorded(sweeps_of(), chain=chain_of(lines), up=up))
    assert_found(result, chain_of(lines), 3e-4)


def test_parallel_axes_cost_nothing():
    lines = [
        ([0.0, 1.0, 0.0], [0.0, 0.0, 0.8]),
        ([0.0, 1.0, 0.0], [0.0, 0.1, 0.4]),
        ([0.9, 0.0, 0.3], [0.05, 0.0, 0.1]),
    ]
    result = estimate(recorded(sweeps_of(), chain=chain_of(lines)))
    assert_found(result, chain_of(lines))


def test_a_sliding_joint_in_the_chain_is_found():
    types = [REVOLUTE, cp.JointType.prismatic, REVOLUTE]
    chain = chain_of(LINES, types)
    pieces = [
        *sweeps_of([0]),
        cp.RaisedCosine(joint=1, span=0.3, frequency=0.5, duration=6.0),
        *sweeps_of([2]),
    ]
    recording = recorded(pieces, chain=chain)
    segmentation = cp.segment(recording, cp.SegmentationOptions(joint_types=types))
    result = estimate(recording, segmentation=segmentation, joint_types=types)
    slide = result.joints.joints[1].axis
    assert slide.screw.type == cp.JointType.prismatic
    error = cp.local_coordinates(slide.screw.line, cp.make_line(chain.axes[1].line.direction, slide.screw.line.point))
    assert np.abs(error[:2]).max() < 2e-4
    assert np.abs(error[:2] / np.sqrt(np.diag(slide.covariance)[:2])).max() < 4.5


def test_a_gyroscope_helps_and_its_own_errors_are_found():
    motion = cp.joint_trajectory(START, free(20.0), RATE, 0.6)
    options = cp.SimulationOptions(noise_std=0.02, seed=4, angular_velocity_noise_std=0.002)
    recording = cp.simulate(chain_of(LINES), UP, cp.AccelerometerModel(bias=[0.02, 0.01, -0.03]), motion, options)
    with_it = estimate(recording, sensor="mems")
    without = estimate(recording, sensor="mems", use_gyroscope=False)
    assert with_it.gyroscope_used
    assert not without.gyroscope_used
    assert_found(with_it, chain_of(LINES), 2e-3)
    np.testing.assert_allclose(with_it.gyroscope_matrix, np.eye(3), atol=2e-3)
    for mine, theirs in zip(with_it.joints.joints, without.joints.joints, strict=True):
        assert mine.axis.direction_std() <= 1.02 * theirs.axis.direction_std()


def test_a_gyroscope_behind_the_accelerometer_is_found_and_does_no_harm():
    late = 0.003
    motion = cp.joint_trajectory(START, free(20.0), RATE, 0.6)
    options = cp.SimulationOptions(noise_std=0.02, seed=5, angular_velocity_noise_std=0.002)
    recording = cp.simulate(chain_of(LINES), UP, cp.AccelerometerModel(), motion, options)
    rate = CubicSpline(recording.time, recording.angular_velocity)(recording.time - late)
    behind = cp.make_recording(
        recording.time,
        np.ascontiguousarray(recording.joint_positions),
        np.ascontiguousarray(recording.specific_force),
        angular_velocity=rate,
    )
    result = estimate(behind, sensor="mems")
    delay = value(result, "gyroscope_delay")
    assert result.gyroscope_delay == delay.value
    assert abs(delay.value - late) < 4.5 * delay.std < 0.5e-3
    assert_found(result, chain_of(LINES), 2e-3)
    none = estimate(recording, sensor="mems")
    assert abs(none.gyroscope_delay) < 4.5 * value(none, "gyroscope_delay").std
    fixed = estimate(behind, sensor="mems", gyroscope_delay=cp.ParameterTreatment(False))
    assert fixed.gyroscope_delay == 0.0
    # Both sensors' clocks taken for one, neither is met.
    assert abs(result.clock_offset) < 4.5 * value(result, "clock_offset").std
    assert abs(fixed.clock_offset) > 10.0 * value(fixed, "clock_offset").std


def test_a_joint_that_never_moves_has_no_line_and_the_others_do():
    result = estimate(recorded(sweeps_of([0, 2])))
    assert [joint.axis is not None for joint in result.joints.joints] == [True, False, True]
    assert "never moves" in result.joints.joints[1].reason


def test_nothing_moves_is_an_error_that_says_so():
    with pytest.raises(cp.NotIdentifiable, match="no joint moves"):
        estimate(recorded([cp.Dwell(5.0)]))


def test_a_short_arc_is_known_badly_and_said_to_be():
    short = estimate(recorded(sweeps_of(span=0.12), noise=0.05))
    wide = estimate(recorded(sweeps_of(), noise=0.05))
    for one, other in zip(short.joints.joints, wide.joints.joints, strict=True):
        assert one.axis is None or one.axis.direction_std() > 5 * other.axis.direction_std()
    assert all(joint.reason for joint in short.joints.joints if joint.axis is None)
    guessed = estimate(recorded(sweeps_of(span=0.12), noise=0.05), sensor_is_known=False)
    assert all(joint.axis is None and joint.reason for joint in guessed.joints.joints)
    assert short.weak
    assert all(";" in weak.description for weak in short.weak)


def test_gravity_that_does_not_turn_leaves_no_line():
    # One joint about the vertical: bias and gravity are one.
    up = cp.STANDARD_GRAVITY * np.array([0.0, 0.0, 1.0])
    chain = cp.ScrewChain(
        [cp.ScrewAxis(REVOLUTE, cp.make_line(np.array([0.0, 0.0, 1.0]), np.array([0.4, 0.0, 0.0])))], START[:1]
    )
    motion = cp.joint_trajectory(
        START[:1], [cp.RaisedCosine(joint=0, span=2.4, frequency=0.5, duration=6.0)], RATE, 0.6
    )
    recording = cp.simulate(
        chain, up, cp.AccelerometerModel(bias=[0.02, 0.0, 0.0]), motion, cp.SimulationOptions(noise_std=0.005)
    )
    options = cp.WholeArmOptions()
    options.sensor = load_sensor("mems")
    result = cp.calibrate_whole_arm(recording, cp.segment(recording), options)
    joint = result.joints.joints[0]
    assert joint.axis is None or joint.axis.direction_std() > 1e-3


def test_one_joint_alone_is_found_as_well_as_the_sensors_data_sheet_allows():
    # Bias and tilt are one where the sensor turns about one axis only; what is known of the bias decides.
    recording = recorded(sweeps_of([2]))
    known = estimate(recording).joints.joints[2].axis
    error = cp.local_coordinates(known.screw.line, chain_of(LINES).axes[2].line)
    assert np.all(np.abs(error) < 4.0 * np.sqrt(np.diag(known.covariance)))
    assert known.direction_std() < 2e-4
    guessed = estimate(recording, sensor_is_known=False)
    assert guessed.joints.joints[2].axis is None
    assert "about one axis only" in guessed.joints.joints[2].reason
    assert any("joint3.d1" in weak.description and "gravity" in weak.description for weak in guessed.weak)


def test_knocks_are_cut_out_and_counted():
    recording = recorded(sweeps_of())
    force = np.array(recording.specific_force)
    moving = np.flatnonzero(np.abs(np.gradient(np.asarray(recording.joint_positions)[:, 0])) > 0.01)
    for at in moving[100::400]:
        force[at : at + 4] += [3.0, -2.0, 4.0]
    knocked = cp.make_recording(recording.time, recording.joint_positions, force)
    result = estimate(knocked)
    assert result.outliers > 0
    assert_found(result, chain_of(LINES), 2e-4)


def test_knocks_in_motion_of_all_joints_are_cut_out_too():
    # No rests: every knock splits a stretch, and nothing else is there to be mistaken for one.
    recording = recorded(free(40.0))
    force = np.array(recording.specific_force)
    for at in range(700, 7500, 900):
        force[at : at + 4] += [3.0, -2.0, 4.0]
    result = estimate(cp.make_recording(recording.time, recording.joint_positions, force))
    assert result.outliers > 10
    assert result.noise_inflation < 1.6
    assert_found(result, chain_of(LINES))


def test_residuals_on_data_not_used_are_those_of_the_noise():
    result = estimate(recorded(sweeps_of()))
    assert {stretch.name for stretch in result.stretches} == {"joint 1", "joint 2", "joint 3", "dwells"}
    for stretch in result.stretches:
        assert 0.8 < stretch.held_out_normalized_rms < 1.3
        assert stretch.held_out_rms >= 0.99 * stretch.residual_rms


def test_intervals_are_honest_in_free_motion_with_vibration():
    # 12 coordinates a seed, 20 seeds: the mean normalised square is 1 +- 0.09 where they are independent.
    squares = []
    for seed in range(20):
        vibration = cp.VibrationOptions(tangential_amplitude=0.05, orthogonal_amplitude=0.005, frequency_max=60.0)
        errors, std = errors_and_std(
            estimate(recorded(free(20.0), seed=seed, noise=0.01, vibration=vibration)), chain_of(LINES)
        )
        squares.append(np.mean((errors / std) ** 2))
    assert 0.6 < np.mean(squares) < 1.5


def test_stretches_that_disagree_with_each_other_widen_the_intervals():
    recording = recorded(free(60.0))
    positions = np.array(recording.joint_positions)
    positions[:, 1] += 2e-3 * np.cos(8.0 * positions[:, 1])  # a gear's error, which the model does not know
    honest = estimate(recording)
    wrong = estimate(cp.make_recording(recording.time, positions, recording.specific_force))
    assert 1.0 <= honest.noise_inflation < 1.4
    assert wrong.noise_inflation > 1.2 * honest.noise_inflation
    errors, std = errors_and_std(wrong, chain_of(LINES))
    assert np.mean((errors / std) ** 2) < 2.5


def test_what_the_model_lacks_is_not_averaged_out_by_repeating_the_motion():
    recording = recorded(free(20.0) * 4, noise=0.002)
    positions = np.array(recording.joint_positions)
    positions[:, 1] += 2e-3 * np.cos(8.0 * positions[:, 1])  # the same error in each of the four rounds
    result = estimate(cp.make_recording(recording.time, positions, recording.specific_force))
    errors, std = errors_and_std(result, chain_of(LINES))
    assert result.noise_inflation > 3.0
    assert np.mean((errors / std) ** 2) < 3.0  # 9 if each round counted by itself


@pytest.mark.parametrize(
    ("field", "bad", "words"),
    [
        ("cutoff", 500.0, "half the sample rate"),
        ("encoder_resolution", np.ones(2), "one per joint"),
        ("gravity_magnitude", -9.8, "local magnitude"),
        ("max_passes", 0, "give 1 or more"),
    ],
)
def test_options_that_do_not_fit_are_refused(field, bad, words):
    with pytest.raises(cp.InvalidInput, match=words):
        estimate(recorded(free(10.0)), **{field: bad})


def test_an_arm_that_rings_on_after_it_has_stopped_is_not_in_motion():
    pieces = [cp.MultiJointMotion(duration=6.0, amplitude=np.full(3, 0.8), seed=seed) for seed in range(4)]
    motion = cp.joint_trajectory(START, pieces, 250.0, 3.0)
    sensor = cp.draw_accelerometer(load_sensor("qa700"), 1)
    log = cp.simulate(chain_of(LINES), UP, sensor, motion, cp.SimulationOptions(noise_std=0.01, seed=1))
    time, force = np.array(log.time), np.array(log.specific_force)
    moves = np.abs(np.array(motion.velocity)).max(axis=1) > 1e-6
    for end in np.flatnonzero(moves[:-1] & ~moves[1:]):
        since = time[end:] - time[end]
        force[end:] += np.outer(0.5 * np.exp(-since / 0.3) * np.sin(2 * np.pi * 7.0 * since), [1.0, -0.5, 0.3])
    rings = cp.make_recording(time, np.array(log.joint_positions), force)
    options = cp.WholeArmOptions()
    options.sensor = load_sensor("qa700")
    quiet, ringing = (cp.calibrate_whole_arm(r, cp.segment(r), options) for r in (log, rings))
    several = [next(s for s in result.stretches if s.name == "several joints") for result in (quiet, ringing)]
    assert several[1].residual_rms < 1.5 * several[0].residual_rms
    assert np.all(np.sqrt(np.diag(ringing.joints.covariance)) < 1.3 * np.sqrt(np.diag(quiet.joints.covariance)))
