"""Groups of parameters that are fixed, free or known to a standard deviation, from the command line to the result."""

import json

import jsonschema
import numpy as np
import pytest
from whole_arm_support import estimate, free, recorded, sweeps_of

import circlepoint as cp
from circlepoint.arm import Arm, Joint
from circlepoint.calibration import calibrate
from circlepoint.cli import main
from circlepoint.document import load_schema
from circlepoint.recording_files import write_recording
from circlepoint.result_document import workspace
from circlepoint.sensor_presets import load_sensor
from circlepoint.treatments import PARAMETER_GROUPS, read_treatment

ARM = Arm("three joints", tuple(Joint(name, "revolute") for name in ("shoulder", "elbow", "wrist")))
FIXED = cp.ParameterTreatment(estimated=False)


@pytest.fixture(scope="module")
def recording():
    return recorded(sweeps_of())


def document_of(recording, **treatments):
    document = calibrate(recording, ARM, sensor=load_sensor("qa700"), treatments=treatments).document
    jsonschema.Draft202012Validator(load_schema()).validate(document)
    return document


def test_every_group_of_the_options_has_its_name_and_unit():
    options = cp.WholeArmOptions()
    groups = [name for name in dir(options) if isinstance(getattr(options, name), cp.ParameterTreatment)]
    assert sorted(PARAMETER_GROUPS) == sorted(groups)


@pytest.mark.parametrize(
    ("text", "estimated", "std"),
    [("scale=fixed", False, np.inf), ("bias=free", True, np.inf), ("clock_offset=0.002", True, 0.002)],
)
def test_a_treatment_is_read(text, estimated, std):
    name, treatment = read_treatment(text)
    assert name == text.partition("=")[0]
    assert (treatment.estimated, treatment.std, treatment.where_evident) == (estimated, std, False)


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("scales=free", "'scales=free' names no group of parameters; there are bias, scale"),
        ("scale", "give scale=fixed, scale=free or scale=STD, its standard deviation in 1"),
        ("clock_offset=0", "'clock_offset=0' says nothing of clock_offset; .* in s"),
        ("clock_offset=-0.1", "says nothing"),
        ("clock_offset=nan", "says nothing"),
        ("bias=inf", "says nothing"),
    ],
)
def test_what_is_no_treatment_is_refused(text, said):
    with pytest.raises(cp.InvalidInput, match=said):
        read_treatment(text)


def test_a_group_that_is_fixed_has_no_estimate(recording):
    document = document_of(recording, scale=FIXED, clock_offset=FIXED)
    assert document["sensor"]["scale"] is None
    assert document["sensor"]["clock_offset"] is None
    assert document["sensor"]["bias"] is not None
    assert document["treatments"] == {"scale": "fixed", "clock_offset": "fixed"}


def test_a_group_that_is_free_needs_no_evidence(recording):
    calibration = calibrate(
        recording, ARM, sensor=load_sensor("qa700"), treatments={"encoder_gain": cp.ParameterTreatment()}
    )
    document = calibration.document
    assert [entry["joint"] for entry in document["encoders"]] == ["shoulder", "elbow", "wrist"]
    assert document["treatments"] == {"encoder_gain": "free"}
    # What the gains leave open is in the end-point's error.
    poses = workspace(ARM, calibration.joints.reference_configuration)
    of_lines = cp.end_point_std(calibration.chain, calibration.joints.covariance, poses)
    assert document["end_point"]["rms"] > 1.1 * np.sqrt(np.mean(np.square(of_lines)))


def test_a_prior_holds_what_the_data_cannot_show():
    recording = recorded(free())
    std = {
        prior: document_of(recording, second_order=cp.ParameterTreatment(std=prior))["sensor"]["second_order"]["std"]
        for prior in (1e-7, 1e-4)
    }
    assert max(std[1e-7]) <= 1e-7
    assert min(std[1e-4]) > 1e-6


def test_gravity_of_another_place_is_found_where_the_scale_is_known():
    there = 9.78  # m/s^2, near the equator
    sensor = cp.AccelerometerModel()
    recording = recorded(sweeps_of(), sensor=sensor, up=there * np.array([0.48, -0.6, 0.64]))
    document = document_of(recording, scale=FIXED, gravity=cp.ParameterTreatment(std=0.05))
    assert np.linalg.norm(document["gravity_sensor"]) == pytest.approx(there, abs=2e-3)
    assert document["gravity_magnitude"] == cp.STANDARD_GRAVITY
    assert document["treatments"] == {"scale": "fixed", "gravity": 0.05}


@pytest.mark.parametrize("how", [cp.ParameterTreatment(), cp.ParameterTreatment(std=0.1)], ids=["free", "prior"])
@pytest.mark.parametrize("sensor", [None, "mems"])
def test_gravitys_magnitude_that_nothing_shows_hides_no_line(recording, sensor, how):
    specification = None if sensor is None else load_sensor(sensor)
    calibration = calibrate(recording, ARM, sensor=specification, treatments={"gravity": how})
    assert calibration.joints.complete()


def test_what_cannot_be_estimated_so_is_refused(recording):
    free_clock = {"clock_offset": FIXED, "clock_rate": cp.ParameterTreatment()}
    with pytest.raises(cp.InvalidInput, match="fix both or neither"):
        calibrate(recording, ARM, treatments=free_clock)
    still = cp.make_recording(recording.time, recording.joint_positions, recording.specific_force)
    with pytest.raises(cp.InvalidInput, match="gyroscope_delay: this recording has no gyroscope"):
        calibrate(still, ARM, treatments={"gyroscope_delay": FIXED})
    with pytest.raises(cp.InvalidInput, match="scale: std is 0"):
        calibrate(recording, ARM, treatments={"scale": cp.ParameterTreatment(std=0.0)})
    with pytest.raises(cp.InvalidInput, match="encoder_gain: where_evident"):
        calibrate(recording, ARM, treatments={"encoder_gain": cp.ParameterTreatment(where_evident=True)})


def test_without_treatments_the_document_says_nothing_of_them(recording):
    assert "treatments" not in document_of(recording)


def test_treatments_of_another_method_or_name_are_refused(recording):
    with pytest.raises(cp.InvalidInput, match="treatments of scale are for the method whole-arm, asked for is joint"):
        calibrate(recording, ARM, method="joint", treatments={"scale": FIXED})
    with pytest.raises(cp.InvalidInput, match="'scales' is no group of parameters"):
        calibrate(recording, ARM, treatments={"scales": FIXED})


@pytest.mark.parametrize("group", PARAMETER_GROUPS)
def test_a_negative_standard_deviation_is_refused_by_name(recording, group):
    with pytest.raises(cp.InvalidInput, match=f"{group}: std is -1"):
        estimate(recording, **{group: cp.ParameterTreatment(std=-1.0)})


class TestCommand:
    @pytest.fixture
    def log(self, recording, tmp_path):
        write_recording(tmp_path / "log.csv", recording)
        (tmp_path / "arm.yaml").write_text(
            "name: three joints\njoints:\n"
            + "".join(f"  - {{name: {joint.name}, type: revolute}}\n" for joint in ARM.joints)
        )
        return [str(tmp_path / "log.csv"), "--arm", str(tmp_path / "arm.yaml"), "--out", str(tmp_path / "result")]

    def test_takes_treatments_into_the_result_and_its_page(self, log, tmp_path):
        asked = ["--parameter", "encoder_gain=fixed", "--parameter", "gravity=0.02"]
        assert main(["calibrate", *log, "--sensor", "qa700", *asked]) == 0
        document = json.loads((tmp_path / "result" / "calibration.json").read_text())
        assert document["treatments"] == {"encoder_gain": "fixed", "gravity": 0.02}
        page = (tmp_path / "result" / "report.html").read_text()
        assert "As asked: encoder_gain fixed; gravity known to 0.02 m/s^2." in page

    @pytest.mark.parametrize(
        ("arguments", "said"),
        [
            (["--parameter", "scale=fixed", "--parameter", "scale=free"], "says scale more than once"),
            (["--parameter", "scale=fixed", "--method", "joint"], "for --method whole-arm, not joint"),
        ],
    )
    def test_refuses_what_contradicts(self, log, arguments, said, tmp_path, capsys):
        assert main(["calibrate", *log, *arguments]) == 2
        assert said in capsys.readouterr().err
        assert not (tmp_path / "result").exists()
