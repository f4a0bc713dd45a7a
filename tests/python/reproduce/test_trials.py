"""Trials of one joint and their statistics: what each error does, and that nothing depends on the threads."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest

import circlepoint
from circlepoint.reproduce.accuracy import joint_trial
from circlepoint.reproduce.arm_trial import HANDLE, arm_trial, draw_arm
from circlepoint.reproduce.conditions import ACQUISITION, SHORT, Conditions, acquired, as_measured, only
from circlepoint.reproduce.estimates import (
    METHODS,
    TWO_CORRECTIONS,
    Centre,
    aligned,
    chart_axis,
    reading_delay,
    static_axis,
)
from circlepoint.reproduce.one_joint import draw_joint, run_tests, without_errors
from circlepoint.reproduce.recorded_arm import whole_arm_trial
from circlepoint.reproduce.signals import path_of
from circlepoint.reproduce.trials import Runner, summarise

BASE = Conditions()


def rms(trials, method):
    """Root mean square centre error, mm."""
    return 1e3 * np.sqrt(np.mean([trial.centre[method] ** 2 for trial in trials]))


def run(conditions, methods=METHODS, count=16, jobs=2):
    runner = Runner(jobs, lambda _: None)
    try:
        return runner.run(partial(joint_trial, conditions, methods), 7, count)
    finally:
        runner.close()


def test_any_number_of_threads_gives_the_same_numbers():
    assert run(BASE, count=6, jobs=1) == run(BASE, count=6, jobs=3)


def test_without_errors_every_method_finds_the_axis_and_the_centre():
    exact = replace(without_errors(BASE), sensor=only(BASE.sensor))
    for trial in run(exact, count=6):
        assert trial.axis < 1e-7
        assert trial.axis_best < 1e-6
        assert trial.centre["velocity"] < 0.2e-3
        assert trial.centre["position"] < 0.5e-3
        assert trial.centre["regression"] < 0.05e-3


def test_the_scale_factors_make_the_axis_error_and_the_percussion_distance_that_of_the_centre():
    quiet = run(replace(BASE, sensor=only(BASE.sensor, "bias_std")))
    scaled = run(replace(BASE, sensor=only(BASE.sensor, "bias_std", "scale_std")))
    distant = run(replace(BASE, sensor=only(BASE.sensor, "bias_std", "percussion_distance_std")))
    axis = [1e3 * np.sqrt(np.mean([trial.axis**2 for trial in trials])) for trials in (quiet, scaled, distant)]
    assert axis[0] < 0.05
    assert 0.06 < axis[1] < 0.25
    assert axis[2] == pytest.approx(axis[0], rel=0.05)
    assert rms(quiet, "position") < 0.9
    assert 0.9 < rms(distant, "position") < 3.0
    assert rms(distant, "regression") < 0.5 * rms(distant, "velocity")


def test_a_bias_that_stays_is_no_error_and_one_that_moves_is():
    bias = run(replace(BASE, sensor=only(BASE.sensor, "bias_std")))
    none = run(replace(BASE, sensor=only(BASE.sensor)))
    moved = run(replace(BASE, sensor=only(BASE.sensor), bias_change=5e-3))
    assert rms(bias, "position") == pytest.approx(rms(none, "position"), rel=0.05)
    assert rms(moved, "position") > 2.0 * rms(none, "position")


def test_correcting_for_the_centre_of_percussion_shrinks_the_error_step_by_step_and_more_slowly_when_near():
    methods = {str(count): Centre("position", corrections=count) for count in (0, 1, 2, 3)}
    far, near = (run(replace(BASE, distance=distance), methods) for distance in ((0.8, 1.0), SHORT))
    errors = [rms(far, str(count)) for count in range(4)]
    assert errors[0] > 50.0
    assert errors[1] < 0.25 * errors[0]
    assert errors[2] < 0.5 * errors[1]
    assert errors[2] < 4.0
    assert rms(near, "2") > 2.0 * errors[2]


def test_the_wrong_sign_of_the_percussion_distance_is_far_off():
    joint = draw_joint(BASE, 3)
    readings = run_tests(joint, BASE, 3)
    axis = static_axis(readings)
    options = circlepoint.CenterOptions()
    errors = []
    for distance in (0.0182, -0.0182):
        options.percussion_distance = distance
        center = circlepoint.center_by_velocity(
            readings.theta, readings.moving_force, readings.rate, axis.direction, axis.gravity, options
        )
        errors.append(np.linalg.norm(center.lever_sensor - joint.lever))
    assert errors[0] < 1.5e-3
    assert errors[1] > 10e-3


def test_the_measured_case_is_of_the_measured_size():
    methods = {**METHODS, "two": TWO_CORRECTIONS}
    trials = run(as_measured(replace(BASE, distance=SHORT)), methods, count=24)
    assert 7.0 < rms(trials, "two") < 60.0
    assert rms(trials, "regression") < 2.0


def test_the_acquisition_chain_and_held_joints_leave_a_usable_recording():
    chain = replace(BASE, acquisition=ACQUISITION, held_frequency=5.0)
    joint = draw_joint(chain, 5)
    readings = run_tests(joint, chain, 5)
    plain = run_tests(joint, BASE, 5)
    assert len(readings.moving_force) == len(plain.moving_force)
    assert 0.01 < np.abs(readings.theta - plain.theta).max() < 0.5  # the loop lags


def test_the_delay_of_the_readings_is_that_of_the_filter():
    chain = replace(without_errors(BASE), acquisition=("filter",), held_frequency=5.0, margin=0.25)
    for seed in range(3):
        readings = run_tests(draw_joint(chain, seed), chain, seed)
        assert reading_delay(readings) == pytest.approx(np.sqrt(2.0) / (2.0 * np.pi * 250.0), rel=0.05)
        shifted = aligned(readings, 1e-3)
        assert reading_delay(shifted) == pytest.approx(reading_delay(readings) - 1e-3, abs=2e-5)


def test_the_acquisition_chain_spoils_method_1_by_its_delay_alone():
    methods = {"position": METHODS["position"], "aligned": replace(METHODS["position"], aligned=True)}
    plain, chain = (run(conditions, methods) for conditions in (replace(BASE, margin=0.25), acquired(BASE)))
    assert rms(chain, "position") > 3.0 * rms(plain, "position")
    assert rms(chain, "aligned") < 2.0 * rms(plain, "aligned")
    assert rms(chain, "regression") < 1.5 * rms(plain, "regression")


def test_everything_at_once_from_one_log_beats_the_papers_methods_on_the_same_arms():
    for seed in range(2):
        whole, joints = whole_arm_trial(BASE, seed), arm_trial(BASE, seed)
        assert whole.end_point < 0.3e-3
        assert whole.end_point < 0.3 * min(joints.end_point["position"], joints.end_point["velocity_means"])
        assert whole.axis.max() < 0.2e-3
        assert whole.centre.max() < 0.3e-3


def test_the_papers_chart_and_the_sphere_find_the_same_axis():
    compared = 0
    for seed in range(20):
        readings = run_tests(draw_joint(BASE, seed), BASE, seed)
        chart, arrived = chart_axis(readings)
        if arrived:
            compared += 1
            assert np.linalg.norm(chart - static_axis(readings).direction) < 1e-6
    assert compared >= 17


def test_the_path_of_the_accelerometer_follows_the_true_one():
    path, true, lever = path_of(BASE, 11)
    assert path.shape == true.shape
    assert np.abs(path[0]).max() < 1e-5
    assert np.linalg.norm(path - true, axis=1).max() < 0.02
    assert np.linalg.norm(true, axis=1).max() > 1.5 * np.linalg.norm(lever)


def test_the_arm_has_its_handle_and_every_lever_is_long_enough():
    assert np.linalg.norm(HANDLE) == pytest.approx(0.5, abs=1e-3)
    chain, up = draw_arm(4)
    assert len(chain) == 7
    for axis in chain.axes:
        assert np.linalg.norm(axis.line.point) > 0.4
        assert np.linalg.norm(np.cross(axis.line.direction, up)) > 0.5 * circlepoint.STANDARD_GRAVITY


def test_the_whole_arm_by_the_best_method_beats_the_papers():
    arms = [arm_trial(BASE, seed) for seed in range(4)]
    best = np.mean([arm.end_point["regression"] for arm in arms])
    assert best < 0.6e-3
    assert np.mean([arm.end_point["position"] for arm in arms]) > 4.0 * best
    assert np.mean([arm.axis_best for arm in arms]) < 0.6 * np.mean([arm.axis for arm in arms])


def test_statistics_of_groups_of_ten():
    errors = np.abs(np.random.default_rng(0).normal(size=400))
    summary = summarise(errors)
    assert summary.rms_of_ten.low < 1.0 < summary.rms_of_ten.high
    assert summary.rms_low < summary.rms < summary.rms_high
    assert summary.std_of_ten.median == pytest.approx(errors.std(ddof=1), rel=0.1)
    assert summary.std_of_ten.low < summary.std_of_ten.median < summary.std_of_ten.high
    assert summary.max_of_ten.high <= summary.max == errors.max()
    assert summarise(np.full(10, 2.0)).std_of_ten.high == 0.0
