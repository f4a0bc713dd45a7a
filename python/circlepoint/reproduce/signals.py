"""What the readings look like: averaging at rest, the spectrum and its bandwidth, the path."""

from __future__ import annotations

import math
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

import circlepoint
from circlepoint.reproduce.conditions import (
    AVERAGED_STD,
    CUTOFF,
    ENVIRONMENT_STD,
    FREQUENCY,
    RATE,
    SPAN,
    Conditions,
    only,
)
from circlepoint.reproduce.estimates import METHODS, centre, static_axis
from circlepoint.reproduce.findings import Findings, Ours, exactly
from circlepoint.reproduce.one_joint import Array, draw_joint, dynamic_test, run_tests, without_errors
from circlepoint.reproduce.trials import Runner, spread_of

if TYPE_CHECKING:
    from circlepoint.reproduce.trials import Spread

SEEDS = {"averaging": 2001, "tracking": 2002, "spectrum": 2003, "figures": 5}
DRAWING_CUTOFF = 20.0  # Hz, Figures 8 and 10
_average = 1.0  # s, sec. 5
_environment_band = 12.5  # Hz: the bandwidth at which a second's mean is as quiet as the paper found
_spectrum_periods = 10
_highest_line = 50.0  # Hz
_segment = 10.0  # s: five periods, so that harmonics fall on the spectrum's lines


def averaging_trial(band: float | None, seed: int) -> float:
    """Return the mean (m/s^2) of a second of environmental noise: white, or low-passed to a band (Hz)."""
    samples = round(_average * RATE)
    random = np.random.default_rng(seed)
    if band is None:
        return float(np.mean(ENVIRONMENT_STD * random.normal(size=samples)))
    noise = circlepoint.sosfilt(circlepoint.butter(2, band, RATE), random.normal(size=4 * samples))
    return float(np.mean(noise[-samples:]) * ENVIRONMENT_STD / np.std(noise[samples:]))


def averaging(run: Runner, trials: int, found: Findings) -> None:
    """Study how far a second's mean quiets the environment."""
    run.begin("averaging at rest")

    def scatter(band: float | None) -> Spread:
        means = np.array(run.run(partial(averaging_trial, band), SEEDS["averaging"], trials))
        random = np.random.default_rng(0)
        return spread_of([float(np.std(means[random.integers(len(means), size=len(means))])) for _ in range(500)])

    coloured, white = scatter(_environment_band), scatter(None)
    found.ours["averaged_noise"] = Ours(
        coloured,
        white,
        trials,
        f"White noise of 0.5 mm/s² would average to {1e3 * white.median:.3f} mm/s² (right-hand value). The paper's "
        f"0.1 says that the environment is not white: noise of a bandwidth of {_environment_band:g} Hz averages to "
        "it, the arm's own oscillation.",
    )


def spectra(conditions: Conditions, seed: int) -> dict[str, Array]:
    """Return the spectra (F, 3) of what was read, of the motion alone and of the rest, and the harmonics' lines."""
    joint = draw_joint(conditions, seed)
    _, measured = dynamic_test(joint, conditions, seed)
    _, ideal = dynamic_test(joint, without_errors(conditions), seed)
    length = round(_segment * RATE)
    frequency, power = circlepoint.welch(measured, RATE, nperseg=length)
    _, signal = circlepoint.welch(ideal, RATE, nperseg=length)
    _, rest = circlepoint.welch(np.ascontiguousarray(measured - ideal), RATE, nperseg=length)
    lines = np.arange(1, int(_highest_line / FREQUENCY)) * FREQUENCY
    return {
        "frequency": frequency,
        "power": power,
        "floor": rest,
        "motion": signal,
        "lines": lines.astype(float),
        "signal": signal[np.searchsorted(frequency, lines - 1e-9)],
    }


def bandwidth_trial(conditions: Conditions, seed: int) -> tuple[float, float]:
    """Return the last harmonic (Hz) above noise and vibration in any channel, and what holds all but a millionth."""
    data = spectra(conditions, seed)
    at = np.searchsorted(data["frequency"], data["lines"] - 1e-9)
    floor = np.array([np.mean(data["floor"][max(i - 5, 1) : i + 6], axis=0) for i in at])
    above = np.flatnonzero(np.any(data["signal"] > floor, axis=1))
    power = data["motion"][1:].sum(axis=1)
    most = np.searchsorted(np.cumsum(power) / np.sum(power), 1.0 - 1e-6)
    return float(data["lines"][above[-1]]), float(data["frequency"][1:][most])


def spectrum(run: Runner, trials: int, found: Findings) -> None:
    """Compute the spectrum of the dynamic test, and the bandwidth it suggests."""
    run.begin("spectrum")
    conditions = replace(Conditions(), periods=_spectrum_periods)
    count = max(trials // 4, 5)
    found_at = np.array(run.run(partial(bandwidth_trial, conditions), SEEDS["spectrum"], count))
    last, most = spread_of(found_at[:, 0]), float(np.max(found_at[:, 1]))
    data = spectra(conditions, SEEDS["figures"])
    found.signals["figure7"] = {**data, "last": bandwidth_trial(conditions, SEEDS["figures"])[0]}
    found.ours["bandwidth"] = Ours(
        last,
        None,
        count,
        (
            f"The last harmonic of theta(t) above noise and vibration is at {last.median:g} Hz "
            f"[{last.low:g}, {last.high:g}], and all but a millionth of the "
            f"signal's power lies below {most:g} Hz. That is what must pass; 10 Hz keeps it "
            "with room for the filter's roll-off (below 5 Hz both centre methods lose, figure “Centre error over "
            "each condition”) and still ends below the vibration."
        ),
    )


def settings(found: Findings) -> None:
    """Read the protocol's settings back from a simulated recording."""
    conditions = replace(Conditions(), periods=4)
    joint = draw_joint(conditions, SEEDS["figures"])
    theta, _ = dynamic_test(joint, conditions, SEEDS["figures"])
    frequency, power = circlepoint.welch(theta, RATE, nperseg=len(theta))
    found.ours["fundamental"] = Ours(exactly(float(frequency[1 + int(np.argmax(power[1:]))])), None, 1)
    found.ours["span"] = Ours(exactly(float(np.ptp(theta))), None, 1)
    found.ours["rate"] = Ours(exactly(len(theta) / conditions.duration), None, 1)


def path_of(conditions: Conditions, seed: int) -> tuple[Array, Array, Array]:
    """Return the path (M, 2), m, of method 1 in O_w from where it starts, the true one, and the lever (2,) in O_w."""
    joint = draw_joint(conditions, seed)
    readings = run_tests(joint, conditions, seed)
    axis = static_axis(readings)
    result = centre(METHODS["position"], readings, axis, conditions.sensor.percussion_distance)
    lever = (circlepoint.joint_frame(axis.direction).T @ joint.lever)[:2]
    cosine, sine = np.cos(readings.theta), np.sin(readings.theta)
    turned = np.column_stack([cosine * lever[0] - sine * lever[1], sine * lever[0] + cosine * lever[1]])
    return result.path[:, :2], turned - turned[0], lever


def tracking_trial(conditions: Conditions, seed: int) -> Array:
    """Return the distance (M,), m, of the path from the true one over time."""
    path, true, _ = path_of(conditions, seed)
    return np.asarray(np.linalg.norm(path - true, axis=1))


def tracking(run: Runner, trials: int, found: Findings) -> None:
    """Study the accelerometer as a position sensor: the path of Figure 9 against the truth."""
    run.begin("position tracking")
    conditions = Conditions()
    errors = np.array(run.run(partial(tracking_trial, conditions), SEEDS["tracking"], trials))
    known = replace(conditions, sensor=only(conditions.sensor, "bias_std"))
    without = np.array(run.run(partial(tracking_trial, known), SEEDS["tracking"], trials))
    end, end_known = spread_of(errors[:, -1]), spread_of(without[:, -1])
    found.ours["tracking"] = Ours(
        end,
        end_known,
        trials,
        "Distance of the reconstructed from the true position after 2 s, one period (right: the same with a sensor "
        "that has nothing but noise and bias). The paper draws the path and states no number.",
    )
    found.signals["tracking"] = {
        "time": np.arange(errors.shape[1]) / conditions.rate,
        "quantiles": np.quantile(errors, (0.05, 0.5, 0.95), axis=0),
        "known": np.quantile(without, 0.5, axis=0),
    }


def figures(found: Findings) -> None:
    """Collect the signals of Figures 6, 8, 9 and 10."""
    conditions = Conditions()
    seed = SEEDS["figures"]
    joint = draw_joint(conditions, seed)
    readings = run_tests(joint, replace(conditions, static_noise_std=AVERAGED_STD), seed)
    found.signals["figure6"] = {"angle": readings.angle, "force": readings.force}
    low_pass = circlepoint.butter(4, DRAWING_CUTOFF, RATE)
    time = np.arange(len(readings.theta)) / RATE
    smooth = circlepoint.sosfiltfilt(low_pass, readings.theta)
    true_rate = SPAN * math.pi * FREQUENCY * np.sin(2.0 * math.pi * FREQUENCY * time)
    found.signals["figure8"] = {
        "time": time,
        "raw": readings.moving_force,
        "filtered": circlepoint.sosfiltfilt(low_pass, readings.moving_force),
    }
    found.signals["figure10"] = {"time": time, "rate": circlepoint.gradient(smooth, 1.0 / RATE), "true": true_rate}
    path, true, lever = path_of(conditions, seed)
    found.signals["figure9"] = {"path": path, "true": true, "lever": lever, "cutoff": CUTOFF}
    found.signals["joint"] = {"axis": joint.axis, "lever": joint.lever, "up": joint.up_sensor}
