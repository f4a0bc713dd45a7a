"""The accelerometer model and the presets."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import circlepoint as cp
from circlepoint.sensor_presets import load_sensor, sensor_figures, sensor_names


def vectors(bound):
    return arrays(np.float64, 3, elements=st.floats(-bound, bound))


def samples(bound):
    return arrays(np.float64, (5, 3), elements=st.floats(-bound, bound))


MODELS = st.builds(
    cp.AccelerometerModel,
    bias=vectors(1.0),
    scale=vectors(0.1),
    misalignment=vectors(0.1),
    percussion_distance=vectors(0.05),
    second_order=vectors(1e-4),
)


@given(model=MODELS, force=samples(100.0), rate=samples(10.0))
def test_correct_inverts_measure(model, force, rate):
    restored = cp.correct(model, cp.measure(model, force, rate), rate)
    np.testing.assert_allclose(restored, force, rtol=1e-12, atol=1e-12 * 100.0)


def test_a_drawn_sensor_depends_on_its_seed_only_and_spreads_as_specified():
    specification = load_sensor("qa700")
    drawn = [cp.draw_accelerometer(specification, seed) for seed in range(2000)]
    again = cp.draw_accelerometer(specification, 5)
    np.testing.assert_array_equal(again.bias, drawn[5].bias)
    distance = np.array([model.percussion_distance for model in drawn])
    assert distance.mean() == pytest.approx(specification.percussion_distance, abs=2e-5)
    assert distance.std() == pytest.approx(specification.percussion_distance_std, rel=0.05)
    assert np.std([model.bias for model in drawn]) == pytest.approx(specification.bias_std, rel=0.05)


def test_wrong_layout_is_refused_not_copied():
    fortran = np.asfortranarray(np.zeros((5, 3)))
    with pytest.raises(TypeError):
        cp.measure(cp.AccelerometerModel(), fortran, fortran)


def test_different_lengths_are_refused():
    with pytest.raises(cp.InvalidInput, match="5 samples and angular_velocity has 4"):
        cp.measure(cp.AccelerometerModel(), np.zeros((5, 3)), np.zeros((4, 3)))


def test_the_presets_are_the_five_documented_ones_and_all_load():
    assert sensor_names() == ["generic", "ideal", "mems", "qa3000", "qa700"]
    assert load_sensor("qa700").percussion_distance == 0.0182
    assert load_sensor("ideal").noise_std == 0.0
    assert load_sensor("generic").percussion_distance_std >= 0.03 > load_sensor("mems").percussion_distance_std


def test_an_unknown_sensor_lists_the_presets():
    with pytest.raises(
        cp.InvalidInput, match=r"'qa7000' is neither a preset nor a file; .*generic, ideal, mems, qa3000, qa700"
    ):
        load_sensor("qa7000")


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("bias_std: -1.0\nscale_std: 0\nnoise_std: 0", "1: bias_std: is -1.0, must be a finite number of at least 0"),
        ("scale_std: 0\nnoise_std: 0", "1: bias_std: is missing; a finite number of at least 0 is needed"),
        ("bias_std: 0\nnoise_std: '0'\nscale_std: 0", "2: noise_std: is '0', must be a number"),
        ("bias_std: 0\nscale_std: .inf\nnoise_std: 0", "2: scale_std: is inf, must be a finite number"),
        (
            "bias_std: 0\nscale_std: 0\nnoise_std: 0\ncolour: red",
            "4: colour: unknown key; the keys known here are name, bias_std",
        ),
        ("bias_std: true\nscale_std: 0\nnoise_std: 0", "1: bias_std: is True, must be a number"),
        ("- 1", ": its top level is a list of 1, must be a mapping"),
        ("a: [", "1, column 5: is not valid YAML"),
    ],
)
def test_a_malformed_sensor_file_names_file_line_field_value_and_remedy(tmp_path, text, message):
    path = tmp_path / "mine.yaml"
    path.write_text(text)
    with pytest.raises(cp.InvalidInput, match=f"mine.yaml(, line )?{message}"):
        load_sensor(path)


def test_a_file_of_the_presets_form_loads(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text("bias_std: 0.01\nscale_std: 0.001\nnoise_std: 0.002\n")
    assert load_sensor(path).bias_std == 0.01
    assert load_sensor(str(path)).range == 0.0


@pytest.mark.parametrize("number", ["1e-3", "1.0e-3", "1E-3", ".1e-2", "0.001"])
def test_numbers_are_read_as_people_write_them(tmp_path, number):
    path = tmp_path / "mine.yaml"
    path.write_text(f"bias_std: {number}\nscale_std: 0\nnoise_std: 1.0e1\n")
    assert load_sensor(path).bias_std == 0.001
    assert load_sensor(path).noise_std == 10.0


@pytest.mark.parametrize("name", sensor_names())
def test_every_figure_of_a_preset_has_a_unit_and_a_source(name):
    figures = sensor_figures(name)
    assert len(figures) >= 8
    for figure in figures:
        assert figure.unit, figure
        assert figure.assumed or figure.source.startswith("paper, "), figure


def test_the_qa700_is_table_1_of_the_paper():
    kind = load_sensor("qa700")
    assert kind.range == 300.0
    assert kind.uncorrected.bias_std == pytest.approx(0.080 / 3)
    assert kind.uncorrected.bias_temperature_std[0] == pytest.approx(700e-6 / 3)
    assert kind.uncorrected.scale_temperature_std[0] == pytest.approx(200e-6 / 3)
    assert kind.current_scale_factor == pytest.approx(0.13e-3)
    assert kind.second_order_std == pytest.approx(4.8e-6)
    assert kind.resolution == pytest.approx(10e-6)
    response = [(band.low, band.high, band.tolerance) for band in kind.response_bands]
    np.testing.assert_allclose(response, [(0, 10, 0.001), (10, 200, 0.05), (200, 300, 0.10)])
    noise = [(band.low, band.high, band.rms) for band in kind.noise_bands]
    np.testing.assert_allclose(noise, [(0, 10, 80e-6), (10, 500, 800e-6)])


def test_the_qa3000_is_better_than_the_qa700_where_the_paper_says_so():
    better, worse = load_sensor("qa3000"), load_sensor("qa700")
    for name in ("bias_std", "scale_std", "misalignment_std"):
        assert getattr(better, name) < getattr(worse, name)
    assert (better.uncorrected.bias_temperature_std < worse.uncorrected.bias_temperature_std).all()
    assert all(b.rms < w.rms for b, w in zip(better.noise_bands, worse.noise_bands, strict=True))


def test_a_figure_may_carry_its_unit_source_and_number_of_sigmas(tmp_path):
    path = tmp_path / "mine.yaml"
    path.write_text(
        "bias_std: {value: 6, sigmas: 3, unit: mg, source: mine}\nscale_std: {value: 100, unit: ppm}\nnoise_std: 0.01\n"
    )
    kind = load_sensor(path)
    assert kind.bias_std == pytest.approx(2e-3 * 9.80665)
    assert kind.scale_std == pytest.approx(1e-4)
    assert [figure.source for figure in sensor_figures(path)] == ["mine", "", ""]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("bias_std: {value: 1, unit: kg}", "bias_std.unit: is 'kg', must be m/s"),
        ("bias_std: {unit: mg}", "bias_std.value: is missing"),
        ("bias_std: 0\nuncorrected: {bias_temperature_std: [1, 2]}", "must be a list of three figures"),
        (
            "bias_std: 0\nnoise_bands: [{from_hz: 10, to_hz: 5, rms: 1}]",
            "to_hz: is 5, must be a finite number above 10",
        ),
    ],
)
def test_a_malformed_figure_names_its_place(tmp_path, text, message):
    path = tmp_path / "mine.yaml"
    path.write_text(f"{text}\nscale_std: 0\nnoise_std: 0\n")
    with pytest.raises(cp.InvalidInput, match=message):
        load_sensor(path)


@given(
    model=MODELS,
    force=samples(100.0),
    rate=samples(10.0),
    temperature=arrays(np.float64, 5, elements=st.floats(-40.0, 90.0)),
    seed=st.integers(0, 1000),
)
def test_correct_inverts_measure_at_every_temperature(model, force, rate, temperature, seed):
    sheet = cp.draw_calibrated_accelerometer(load_sensor("qa700"), seed).sheet
    warm = cp.AccelerometerModel(
        bias=model.bias,
        scale=model.scale,
        misalignment=model.misalignment,
        percussion_distance=model.percussion_distance,
        second_order=model.second_order,
        temperature=sheet.temperature,
    )
    restored = cp.correct(warm, cp.measure(warm, force, rate, temperature), rate, temperature)
    np.testing.assert_allclose(restored, force, rtol=1e-12, atol=1e-10)


def test_over_temperature_a_corrected_qa700_keeps_its_residual_errors():
    kind = load_sensor("qa700")
    temperature = np.linspace(0.0, 50.0, 51)
    force, rate = np.tile([[3.0, -4.0, 8.0]], (51, 1)), np.zeros((51, 3))
    left, raw = [], []
    for seed in range(200):
        sensor = cp.draw_calibrated_accelerometer(kind, seed)
        reading = cp.measure(sensor.actual, force, rate, temperature)
        left.append(cp.correct(sensor.sheet, reading, rate, temperature) - force)
        raw.append(reading - force)
    assert np.std(np.array(left)[:, :, 0]) == pytest.approx(kind.bias_std, rel=0.15)
    assert np.std(np.array(raw)[:, :, 0]) > 10 * np.std(np.array(left)[:, :, 0])
    assert np.ptp(left, axis=1).max() < 5e-4  # constant over temperature


def test_a_current_of_one_and_a_third_milliampere_is_one_g():
    kind = load_sensor("qa700")
    reading = np.full((1, 3), 9.80665)
    current = cp.output_current(reading, kind.current_scale_factor)
    np.testing.assert_allclose(current, 1.2749e-3, rtol=1e-4)
    np.testing.assert_allclose(cp.reading_from_current(current, kind.current_scale_factor), reading, rtol=1e-15)
