"""What lies between the simulated sensor and the log, measured on the log."""

import numpy as np
import pytest
from arm_files import TWO_TURNS
from scipy import signal

import circlepoint as cp
from circlepoint.acquisition import Acquisition
from circlepoint.arm import load_arm
from circlepoint.cli import main
from circlepoint.protocol import load_plan
from circlepoint.recording_io import read_recording
from circlepoint.sensor_presets import load_sensor

UP = np.array([1.2, -3.1, 9.2])


def one_joint():
    line = cp.make_line(np.array([0.0, 0.6, 0.8]), np.array([0.3, 0.0, 0.1]))
    axis = cp.ScrewAxis(type=cp.JointType.revolute, line=line)
    return cp.ScrewChain(axes=[axis], reference_configuration=np.zeros(1))


def at_rest(duration, rate):
    return cp.joint_trajectory(np.zeros(1), [cp.Dwell(duration)], rate)


def sliding(frequency, amplitude, duration, rate):
    """A prismatic joint along (1, 1, 1): the same sine in every channel."""
    line = cp.make_line(np.ones(3) / np.sqrt(3.0), np.zeros(3))
    axis = cp.ScrewAxis(type=cp.JointType.prismatic, line=line)
    chain = cp.ScrewChain(axes=[axis], reference_configuration=np.zeros(1))
    time = np.arange(round(duration * rate) + 1) / rate
    omega = 2 * np.pi * frequency
    acceleration = amplitude * np.sqrt(3.0) * np.sin(omega * time)[:, None]
    velocity = -amplitude * np.sqrt(3.0) / omega * np.cos(omega * time)[:, None]
    trajectory = cp.JointTrajectory(time, -acceleration / omega**2, velocity, acceleration, rate)
    return chain, trajectory


def tone(values, time, frequency):
    """Return complex amplitude of a tone by least squares, beside a constant."""
    omega = 2 * np.pi * frequency * time
    columns = np.column_stack([np.sin(omega), np.cos(omega), np.ones_like(time)])
    sine, cosine, _ = np.linalg.lstsq(columns, values, rcond=None)[0]
    return sine + 1j * cosine


def band_rms(values, rate, low, high):
    frequency, power = signal.welch(values, fs=rate, nperseg=int(8 * rate), axis=0, detrend=False)
    inside = (frequency >= low) & (frequency < high)
    return np.sqrt(power[inside].sum(axis=0) * (frequency[1] - frequency[0]))


@pytest.mark.parametrize("preset", ["qa700", "qa3000"])
def test_noise_has_the_stated_rms_in_every_band_by_welch(preset):
    bands = load_sensor(preset).noise_bands
    noise = np.concatenate([cp.band_noise(bands, 400_000, 2000.0, seed) for seed in range(3)], axis=1)
    for band in bands:
        measured = band_rms(noise, 2000.0, band.low, band.high)
        assert np.sqrt(np.mean(measured**2)) == pytest.approx(band.rms, rel=0.03)
    assert band_rms(noise, 2000.0, 510.0, 1000.0).max() < 0.02 * bands[-1].rms


def test_sampled_noise_folds_back_and_keeps_its_power():
    bands = [cp.NoiseBand(0.0, 10.0, 80e-6), cp.NoiseBand(10.0, 500.0, 800e-6)]
    noise = cp.band_noise(bands, 500_000, 500.0, 1)
    assert np.sqrt(np.mean(noise**2)) == pytest.approx(np.hypot(80e-6, 800e-6), rel=0.02)


def test_the_recorded_noise_of_a_resting_qa700_is_its_bands_through_the_signal_filter():
    sensor = load_sensor("qa700")
    acquisition = cp.AcquisitionOptions(oversampling=8, noise_bands=sensor.noise_bands, signal_cutoff=250.0)
    options = cp.SimulationOptions(acquisition=acquisition, seed=4)
    recording = cp.simulate(one_joint(), UP, cp.AccelerometerModel(), at_rest(200.0, 4000.0), options)
    noise = recording.specific_force - UP
    assert recording.sample_rate == 500.0
    # Between 10 and 50 Hz the filter passes all, and the 450 to 500 Hz that fold onto it lose all but a twelfth.
    density = 800e-6**2 / 490.0
    frequency = np.linspace(10.0, 50.0, 400)
    sections = signal.butter(2, 250.0, fs=4000.0, output="sos")
    gains = [np.abs(signal.sosfreqz(sections, at, fs=4000.0)[1]) ** 2 for at in (frequency, 500.0 - frequency)]
    expected = np.sqrt(np.mean(gains[0] + gains[1]) * density * 40.0)
    measured = np.sqrt(np.mean(band_rms(noise, 500.0, 10.0, 50.0) ** 2))
    assert measured == pytest.approx(expected, rel=0.04)


def test_the_converters_skew_is_the_phase_between_channels():
    chain, trajectory = sliding(20.0, 3.0, 4.0, 4000.0)
    acquisition = cp.AcquisitionOptions(oversampling=8, channel_skew=25e-6)
    recording = cp.simulate(
        chain, UP, cp.AccelerometerModel(), trajectory, cp.SimulationOptions(acquisition=acquisition)
    )
    phases = [np.angle(tone(recording.specific_force[:, k], recording.time, 20.0)) for k in range(3)]
    delays = np.diff(phases) / (2 * np.pi * 20.0)
    np.testing.assert_allclose(delays, 25e-6, rtol=1e-3)


@pytest.mark.parametrize("frequency", [5.0, 50.0, 150.0])
def test_the_signal_filter_has_the_gain_and_phase_of_a_causal_butterworth(frequency):
    chain, trajectory = sliding(frequency, 3.0, 4.0, 4000.0)
    acquisition = cp.AcquisitionOptions(oversampling=8, signal_cutoff=250.0)
    recording = cp.simulate(
        chain, UP, cp.AccelerometerModel(), trajectory, cp.SimulationOptions(acquisition=acquisition)
    )
    late = recording.time > 0.5
    gain = tone(recording.specific_force[late, 1], recording.time[late], frequency) / 3.0
    sections = signal.butter(2, 250.0, fs=4000.0, output="sos")
    expected = signal.sosfreqz(sections, [frequency], fs=4000.0)[1][0]
    np.testing.assert_allclose(gain, expected, rtol=1e-4)


@pytest.mark.parametrize("frequency", [8.0, 100.0, 180.0])
def test_the_sensors_gain_keeps_within_its_bands(frequency):
    bands = load_sensor("qa700").response_bands
    chain, trajectory = sliding(frequency, 3.0, 2.0, 4000.0)
    gains = []
    for seed in range(10):
        acquisition = cp.AcquisitionOptions(oversampling=4, response_bands=bands)
        options = cp.SimulationOptions(acquisition=acquisition, seed=seed)
        recording = cp.simulate(chain, UP, cp.AccelerometerModel(), trajectory, options)
        late = recording.time > 0.5
        gains += [abs(tone(recording.specific_force[late, k], recording.time[late], frequency)) / 3.0 for k in range(3)]
    tolerance = next(band.tolerance for band in bands if frequency < band.high)
    assert np.abs(np.array(gains) - 1.0).max() <= 1.05 * tolerance
    assert np.ptp(gains) > 0.05 * tolerance


def test_clipping_is_the_sensors_before_the_filter():
    chain, trajectory = sliding(10.0, 50.0, 2.0, 4000.0)
    acquisition = cp.AcquisitionOptions(oversampling=8, signal_cutoff=250.0)
    options = cp.SimulationOptions(range=30.0, acquisition=acquisition)
    recording = cp.simulate(chain, UP, cp.AccelerometerModel(), trajectory, options)
    # A clipped sine through a second-order Butterworth overshoots by less than its step response.
    assert 30.0 < np.abs(recording.specific_force).max() < 31.5


def test_pick_up_is_a_sine_at_the_mains_frequency():
    acquisition = cp.AcquisitionOptions(pickup_amplitude=0.02)
    options = cp.SimulationOptions(acquisition=acquisition, seed=2)
    recording = cp.simulate(one_joint(), UP, cp.AccelerometerModel(), at_rest(4.0, 500.0), options)
    for k in range(3):
        assert abs(tone(recording.specific_force[:, k], recording.time, 60.0)) == pytest.approx(0.02, rel=1e-9)


def test_the_temperature_filter_delays_a_warm_up_and_its_thermometer_adds_an_offset():
    profile = cp.TemperatureProfile(start=20.0, rise=10.0, time_constant=2.0, sensor_offset=0.5)
    acquisition = cp.AcquisitionOptions(temperature_cutoff=1.0)
    options = cp.SimulationOptions(acquisition=acquisition, temperature=profile)
    recording = cp.simulate(one_joint(), UP, cp.AccelerometerModel(), at_rest(20.0, 500.0), options)
    assert recording.temperature[0] == 20.5
    assert recording.temperature[-1] == pytest.approx(profile.at(20.0) + 0.5, abs=1e-2)
    halfway = np.interp(25.5, recording.temperature, recording.time) - 2.0 * np.log(2.0)
    assert halfway == pytest.approx(np.sqrt(2.0) / (2 * np.pi), rel=0.15)  # the filter's delay at rest


def test_a_plan_without_the_section_is_recorded_as_before(tmp_path):
    path = tmp_path / "plan.yaml"
    path.write_text("rate_hz: 100\nrest_deg: 0\ntests:\n  - free: {duration: 5, amplitude_deg: 20}\n")
    plan = load_plan(path, ["a", "b"])
    assert plan.acquisition is None
    assert plan.trajectory().sample_rate == 100.0


PLAN = """\
rate_hz: 250
rest_deg: 10
tests:
  - joint: all
    static: {steps: 4, span_deg: 60}
    dynamic: {frequency_hz: 0.5, span_deg: 60, duration: 2}
acquisition:
  temperature: {start: 20, rise: 5, time_constant: 10}
  gyroscope: {noise: 0.001}
  joints: {natural_frequency_hz: [4, 5], stiffness: 20000, mass: 1.4}
"""


def test_what_a_plan_leaves_out_is_the_papers_chain(tmp_path):
    path = tmp_path / "plan.yaml"
    path.write_text(PLAN)
    plan = load_plan(path, ["pan", "tilt"])
    assert isinstance(plan.acquisition, Acquisition)
    assert plan.trajectory().sample_rate == 2000.0
    options = plan.acquisition.options(load_sensor("qa700"))
    paper = cp.paper_acquisition()
    for name in ("signal_cutoff", "temperature_cutoff", "channel_skew", "converter_bits", "encoder_rate"):
        assert getattr(options, name) == pytest.approx(getattr(paper, name))
    assert plan.acquisition.noise_std(load_sensor("qa700")) == 0.0
    assert [band.rms for band in options.noise_bands] == pytest.approx([80e-6, 800e-6])


@pytest.mark.parametrize(
    ("line", "message"),
    [
        ("  oversampling: 0", "acquisition.oversampling: is 0"),
        ("  colour: red", "acquisition.colour: unknown key"),
        ("  corrected: maybe", "acquisition.corrected: is 'maybe', must be true or false"),
        ("  converter: {bits: -1}", "acquisition.converter.bits: is -1"),
        ("  cable: {noise: -0.1}", "acquisition.cable.noise: is -0.1"),
    ],
)
def test_an_impossible_section_names_its_field(line, message, tmp_path):
    path = tmp_path / "plan.yaml"
    path.write_text(f"{PLAN}{line}\n")
    with pytest.raises(cp.InvalidInput, match=message):
        load_plan(path, ["pan", "tilt"])


def test_simulate_writes_gyroscope_and_temperature_and_they_read_back(tmp_path):
    (tmp_path / "plan.yaml").write_text(PLAN)
    (tmp_path / "arm.yaml").write_text(TWO_TURNS)
    arguments = ["simulate", str(tmp_path / "plan.yaml"), "--arm", str(tmp_path / "arm.yaml"), "--sensor", "qa700"]
    for name in ("a.csv", "b.csv"):
        assert main([*arguments, "--out", str(tmp_path / name), "--seed", "3"]) == 0
    assert (tmp_path / "a.csv").read_bytes() == (tmp_path / "b.csv").read_bytes()
    recording = read_recording(tmp_path / "a.csv", load_arm(tmp_path / "arm.yaml")).recording
    assert recording.sample_rate == pytest.approx(250.0)
    assert recording.angular_velocity.shape == (recording.samples, 3)
    assert np.abs(recording.angular_velocity).max() > 1.0
    assert 20.0 <= recording.temperature.min() < 21.0
    assert 24.0 < recording.temperature.max() < 25.01
    still = slice(0, 100)
    # The sheet has removed the raw bias (27 mm/s^2 one sigma) and the warm-up; 5 mm/s^2 one sigma is left.
    magnitude = np.linalg.norm(recording.specific_force[still].mean(axis=0))
    assert magnitude == pytest.approx(9.80665, abs=0.03)
