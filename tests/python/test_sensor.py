"""The accelerometer model and the presets."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

import circlepoint as cp
from circlepoint.sensor_presets import load_sensor, sensor_names


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


def test_the_presets_are_the_four_documented_ones_and_all_load():
    assert sensor_names() == ["generic", "ideal", "mems", "qa700"]
    assert load_sensor("qa700").percussion_distance == 0.0182
    assert load_sensor("ideal").noise_std == 0.0
    assert load_sensor("generic").percussion_distance_std >= 0.03 > load_sensor("mems").percussion_distance_std


def test_an_unknown_sensor_lists_the_presets():
    with pytest.raises(
        cp.InvalidInput, match=r"'qa7000' is neither a preset nor a file; .*generic, ideal, mems, qa700"
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
